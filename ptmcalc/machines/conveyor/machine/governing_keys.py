"""Keys to which verdicts of several topics point."""

from collections.abc import Mapping

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.machines.conveyor.machine.scenes import ConveyorScene
from ptmcalc.machines.conveyor.machine.spec import Conveyor

TENSION: KeyPath = ("takeup", "tension")


def takeup_tension(spec: Conveyor, scene: ConveyorScene) -> KeyPath:
    """The key of the take-up tension, for a repair."""
    return TENSION


def blame_tension(spec: Conveyor, scene: ConveyorScene, loads: Mapping[str, Estimate]) -> KeyPath:
    """The key of the take-up tension, for a verdict."""
    return TENSION


def starting_torque_key(spec: Conveyor, path: KeyPath = ()) -> KeyPath:
    """The key of the starting torque the file uses."""
    path = path or spec.main_path
    one = spec.value_at(path).motor
    return (*path, "motor", one.starting_key)
