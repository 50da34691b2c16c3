"""Checks of weights, carriage and drives."""

from ptmcalc.contract.check import AnyCheck

CHECKS_OF_STATICS: tuple[AnyCheck, ...] = ()
