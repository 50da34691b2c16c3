"""Effects of the column's motion."""

from ptmcalc.contract.effect import AnyEffect

EFFECTS_OF_MAST: tuple[AnyEffect, ...] = ()
