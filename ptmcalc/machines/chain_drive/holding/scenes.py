"""Scenes in which a loaded chain that climbs can run back."""

from ptmcalc.components.run_back import checked_elsewhere, rollback_scene
from ptmcalc.machines.chain_drive.machine.layout import ConveyorLayout
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, ChainScene, Hold, Run, Start, Stopping


def asks_for_hold(spec: ChainDrive, scene: ChainScene) -> bool:
    """Whether a scene is the one in which the rollback torque is checked.

    Each `backstop` scene is. Without one it is, of a conveyor that climbs, the first loaded scene that ends at rest or
    begins with less than the full torque; of a file without scenes, the loaded run.
    """
    if isinstance(scene, Hold):
        return True
    if not isinstance(spec.layout, ConveyorLayout) or spec.layout.lift <= 0:
        return False
    return scene == rollback_scene(spec.all_scenes, ("full",), Hold, lambda one: _can_run_back(spec, one))


def _can_run_back(spec: ChainDrive, scene: ChainScene) -> bool:
    if isinstance(scene, Start):
        return scene.profile.rise_time > 0 and not scene.profile.imposes_speed
    return isinstance(scene, Stopping) or (spec.scenes is None and isinstance(scene, Run))


elsewhere = checked_elsewhere(asks_for_hold)
