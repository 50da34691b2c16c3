"""Scenes in which a loaded belt that climbs can run back."""

from ptmcalc.base.memory import kept_for
from ptmcalc.contract.effect import Criterion
from ptmcalc.machines.conveyor.spec import Conveyor, ConveyorScene, Hold, Run, Start, Stopping

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


@kept_for(64)
def _asked_in(spec: Conveyor) -> ConveyorScene | None:
    """The scene in which the rollback torque is checked without a `backstop` scene.

    Of a belt that climbs, it is the first loaded scene that ends at rest or begins with less than the full torque; of a
    file without scenes, the loaded run.
    """
    loaded = [one for one in spec.all_scenes if one.load in ("full", "uphill")]
    for one in loaded:
        if isinstance(one, Hold):
            return None
    for part in spec.route.parts:
        if part.lift > 0:
            return next((one for one in loaded if _can_run_back(spec, one)), None)
    return None


def _can_run_back(spec: Conveyor, scene: ConveyorScene) -> bool:
    if isinstance(scene, Start):
        rises = scene.profile.rise_time > 0 or any(drive.delay > 0 for drive in spec.all_drives.values())
        return scene.aborted is not None or (rises and not scene.profile.imposes_speed)
    return isinstance(scene, Stopping) or (spec.scenes is None and isinstance(scene, Run))


def elsewhere(spec: Conveyor, scene: ConveyorScene) -> Criterion:
    """Whether the rollback torque is checked in other scenes only: 1, else 0.

    **Range** any scene.
    **Error** exact.
    **Source** `asks_for_hold`.
    """
    meaning = "0 in the scene in which the rollback torque is checked, else 1"
    return Criterion("rollback", float(not asks_for_hold(spec, scene)), 1.0, meaning, "the scenes of the file")
