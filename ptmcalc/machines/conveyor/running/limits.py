"""Limits of checks of single parts."""

from collections.abc import Callable

from ptmcalc.base.estimate import Estimate
from ptmcalc.machines.conveyor.spec import Conveyor, ConveyorScene


def given(limit: float) -> Callable[[Conveyor, ConveyorScene], Estimate]:
    """The limit of a part, a number of the file."""
    return lambda spec, scene: Estimate.exact(limit)
