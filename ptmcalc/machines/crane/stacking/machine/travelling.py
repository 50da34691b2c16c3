"""What starts or stops the base of a column, whichever of the two a scene is about."""

import math

from ptmcalc.contract.effect import Criterion
from ptmcalc.machines.crane.stacking.machine import model
from ptmcalc.machines.crane.stacking.machine.model import Push
from ptmcalc.machines.crane.stacking.machine.scenes import StackerScene, Start
from ptmcalc.machines.crane.stacking.machine.spec import Stacker


def push_of(spec: Stacker, scene: StackerScene) -> Push:
    """What starts or stops the mechanism of a scene."""
    return model.driving(spec, scene) if isinstance(scene, Start) else model.stopping(spec, scene)


def turns(spec: Stacker, scene: StackerScene) -> bool:
    """Whether the column turns about its own axis: nothing then bends it."""
    return model.mechanism(spec, scene) == "rotation"


def travels(spec: Stacker, scene: StackerScene) -> Criterion | None:
    """Out of range where the column only turns about its own axis.

    **Range** every start and stop.
    **Error** none.
    **Source** what moves.
    """
    if not turns(spec, scene):
        return None
    return Criterion("ω", math.inf, 1.0, "the mast rotates about its own axis and does not bend", "what moves")


def evenly(spec: Stacker, scene: StackerScene) -> Criterion | None:
    """Out of range in a start along a motor's curve: the force that swings the column is not even.

    **Range** every start and stop.
    **Error** none.
    **Source** the curve of the file.
    """
    if not model.uneven(spec, scene):
        return travels(spec, scene)
    reason = "the start follows a motor curve; a mast is computed under a constant force or a ramp"
    return Criterion("ΔM/M", math.inf, 1.0, reason, "the motor's curve")
