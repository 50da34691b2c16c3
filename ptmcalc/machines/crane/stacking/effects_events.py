"""Effects of buffers, fork, rail and safety gear."""

from ptmcalc.contract.effect import AnyEffect

EFFECTS_OF_EVENTS: tuple[AnyEffect, ...] = ()
