"""Scenes in which a loaded chain that climbs can run back."""

from ptmcalc.contract.effect import Criterion
from ptmcalc.machines.chain_drive.layout import ConveyorLayout
from ptmcalc.machines.chain_drive.spec import ChainDrive, ChainScene, Hold, Run, Start, Stopping


def asks_for_hold(spec: ChainDrive, scene: ChainScene) -> bool:
    """Whether a scene is the one in which the rollback torque is checked.

    Each `backstop` scene is. Without one it is, of a conveyor that climbs, the first loaded scene that ends at rest or
    begins with less than the full torque; of a file without scenes, the loaded run.
    """
    loaded = [one for one in spec.all_scenes if one.load == "full"]
    if isinstance(scene, Hold) or any(isinstance(one, Hold) for one in loaded):
        return isinstance(scene, Hold)
    if not isinstance(spec.layout, ConveyorLayout) or spec.layout.lift <= 0:
        return False
    return scene == next((one for one in loaded if _can_run_back(spec, one)), None)


def _can_run_back(spec: ChainDrive, scene: ChainScene) -> bool:
    if isinstance(scene, Start):
        return scene.profile.rise_time > 0 and not scene.profile.imposes_speed
    return isinstance(scene, Stopping) or (spec.scenes is None and isinstance(scene, Run))


def elsewhere(spec: ChainDrive, scene: ChainScene) -> Criterion:
    """Whether the rollback torque is checked in other scenes only: 1, else 0.

    **Range** any scene.
    **Error** exact.
    **Source** `asks_for_hold`.
    """
    meaning = "0 in the scene in which the rollback torque is checked, else 1"
    return Criterion("rollback", float(not asks_for_hold(spec, scene)), 1.0, meaning, "the scenes of the file")
