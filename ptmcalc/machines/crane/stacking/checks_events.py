"""Checks of buffers, fork, rail and safety gear."""

from ptmcalc.contract.check import AnyCheck

CHECKS_OF_EVENTS: tuple[AnyCheck, ...] = ()
