"""What the bounds of several effects share."""

import math
from collections.abc import Mapping

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.result import family
from ptmcalc.machines.conveyor.machine.loads import CHANGED_BY_MOTION, DRIVE, DRIVE_OF_STOP, OF_STOP
from ptmcalc.machines.conveyor.machine.model import BeltLine
from ptmcalc.machines.conveyor.machine.plain_start import slides_at_rest
from ptmcalc.machines.conveyor.machine.rigid_stop import deceleration
from ptmcalc.machines.conveyor.machine.scenes import ControlledStop, ConveyorScene, Start, Stopping
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.machine.start_case import StartCase, start_case
from ptmcalc.machines.conveyor.waves import load_errors, start_enclosure
from ptmcalc.machines.conveyor.waves.load_errors import Change

Loads = Mapping[str, Estimate]
Offsets = Mapping[str, Interval]


def anything(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """No bound for any load that the motion of the belt can change; a belt that never stops does so whatever its waves
    are."""
    drives = (isinstance(scene, Start) and scene.profile.imposes_speed) or isinstance(scene, ControlledStop)
    return {
        name: load_errors.anything(name, load)
        for name, load in loads.items()
        if (family(name) in CHANGED_BY_MOTION and not (family(name) in OF_STOP and load.low == math.inf))
        or (drives and name in DRIVE_OF_STOP.union(DRIVE))
    }


def moved_by(
    spec: Conveyor, scene: ConveyorScene, line: BeltLine, loads: Loads, change: float | Change, off: bool = False
) -> Offsets:
    """Offsets of the loads of any scene when tensions may be off by a change, every one by the same [N] if it is a
    number. The tension at the run-off is constant only where a take-up weight has no inertia."""
    off = off or spec.takeup_weight > 0
    slowing = deceleration(spec, scene, line) if isinstance(scene, Stopping) else 0.0
    asked = 0
    if isinstance(scene, ControlledStop) or (isinstance(scene, Start) and scene.profile.imposes_speed):
        asked = len({drive.at for drive in spec.all_drives.values()})
    parts = change if isinstance(change, Change) else Change.any_time(change)
    return load_errors.moved(spec, line, loads, parts, slowing, off, asked)


def small_change(
    spec: Conveyor, scene: ConveyorScene, loads: Loads, share: float, known: bool, factor: float
) -> Offsets:
    if not known or not isinstance(scene, Start):
        return anything(spec, scene, loads)
    if share == 0:
        return {}
    case = start_case(spec, scene)
    change = share * case.acceleration * case.masses.belt_mass + grown(case, factor * share)
    return load_errors.spread(case, loads, change)


def grown(case: StartCase, share: float) -> float:
    """A share of the largest stray that grows with the root of the echoes, capped by two strays [N]."""
    contours = case.window / case.line.contour_time
    return min(share * math.sqrt(1 + contours), 2.0) * start_enclosure.largest_stray(case)


def belt_mass(line: BeltLine) -> float:
    return line.carry.line_mass * line.carry.length + line.back.line_mass * line.back.length


def slides_first(spec: Conveyor, scene: ConveyorScene) -> bool:
    """Whether the belt slides back on its drum before a start: its idlers' friction turns round."""
    return isinstance(scene, Start) and slides_at_rest(spec, scene).exceeded
