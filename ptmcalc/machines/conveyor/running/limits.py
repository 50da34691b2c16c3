"""Limits of checks of single parts."""

from collections.abc import Callable

from ptmcalc.base.estimate import Estimate
from ptmcalc.machines.conveyor.machine.scenes import ConveyorScene
from ptmcalc.machines.conveyor.machine.spec import Conveyor


def given(limit: float) -> Callable[[Conveyor, ConveyorScene], Estimate]:
    """The limit of a part, a number of the file."""
    return lambda spec, scene: Estimate.exact(limit)
