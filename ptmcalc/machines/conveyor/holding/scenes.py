"""Scenes in which a loaded belt that climbs can run back."""

from ptmcalc.base.memory import kept_for
from ptmcalc.components.run_back import checked_elsewhere, rollback_scene
from ptmcalc.machines.conveyor.machine.scenes import ConveyorScene, Hold, Run, Start, Stopping
from ptmcalc.machines.conveyor.machine.spec import Conveyor

AT_REST = 0.5
"""Share of the idler resistance that certainly acts at standstill, by default [1]; practice for backstops. A larger
value reduces the required backstop torque, a smaller one increases it."""


def rest_factor(spec: Conveyor) -> float:
    """Part of the idler resistance at rest; the assumption fills it in where a file asks for the rollback torque."""
    given = spec.resistance.rest_factor
    return AT_REST if given is None else given


def asks_for_hold(spec: Conveyor, scene: ConveyorScene) -> bool:
    """Whether a scene is one in which the rollback torque is checked."""
    return isinstance(scene, Hold) or scene == _asked_in(spec)


def held_forward(spec: Conveyor, scene: ConveyorScene) -> bool:
    """Whether a scene is one in which the forward torque is checked: a belt that stands, with a falling section."""
    return isinstance(scene, Hold) and any(part.lift < 0 for part in spec.route.parts)


@kept_for(64)
def _asked_in(spec: Conveyor) -> ConveyorScene | None:
    """The scene in which the rollback torque of a belt that climbs is checked without a `backstop` scene."""
    if not any(part.lift > 0 for part in spec.route.parts):
        return None
    return rollback_scene(spec.all_scenes, ("full", "uphill"), Hold, lambda scene: _can_run_back(spec, scene))


def _can_run_back(spec: Conveyor, scene: ConveyorScene) -> bool:
    if isinstance(scene, Start):
        rises = scene.profile.rise_time > 0 or any(drive.delay > 0 for drive in spec.all_drives.values())
        return scene.aborted is not None or (rises and not scene.profile.imposes_speed)
    return isinstance(scene, Stopping) or (spec.scenes is None and isinstance(scene, Run))


elsewhere = checked_elsewhere(asks_for_hold)
