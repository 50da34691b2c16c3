"""Checks of the column's motion."""

from ptmcalc.contract.check import AnyCheck

CHECKS_OF_MAST: tuple[AnyCheck, ...] = ()
