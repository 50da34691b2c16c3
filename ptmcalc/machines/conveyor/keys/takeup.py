"""The key of the take-up tension, as checks name it."""

from collections.abc import Mapping

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.machines.conveyor.spec import Conveyor, ConveyorScene

TENSION: KeyPath = ("takeup", "tension")


def takeup_tension(spec: Conveyor, scene: ConveyorScene) -> KeyPath:
    return TENSION


def blame_tension(spec: Conveyor, scene: ConveyorScene, loads: Mapping[str, Estimate]) -> KeyPath:
    return TENSION
