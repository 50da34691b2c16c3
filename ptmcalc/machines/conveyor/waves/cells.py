"""A scene in motion as cells and stations, ready to march.

Sums along a strand come from `model.Strand`; drums stand at the head in the order in which the belt meets them, and
at the tail. Before a start the drums are held (by friction, brake or backstop) until the drives pull harder than the
belt does.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.machine.brakes import Braking, brakes_of, braking
from ptmcalc.machines.conveyor.machine.keys.converter import leaders
from ptmcalc.machines.conveyor.machine.model import BeltLine, FloatArray, Strand, drive_force, drive_masses
from ptmcalc.machines.conveyor.machine.motion import Moving
from ptmcalc.machines.conveyor.machine.scenes import Jam, Start
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.numerics.belt.compiled import OverTime
from ptmcalc.numerics.belt.course import Course, Reach, lay_out
from ptmcalc.numerics.belt.give import Give, Rubber
from ptmcalc.numerics.belt.march import place_at
from ptmcalc.numerics.belt.station import Drum, Station, TakeUp, follow, no_brake
from ptmcalc.numerics.belt.travel import Travel

_FAST = 1e30
"""Friction that locks the drive pulley until its drives overcome the static tension [N]: larger than any tension. A
numerical choice: infinity would leave differences undefined; a value near the tensions would release the pulley
early."""
_MOST_GRIP = 700.0
"""Exponent mu alpha above which a pulley does not slip at any tension [1]. Resolution of the floating point: e^710
overflows. A smaller value would treat strong friction as no slip."""


def reaches(line: BeltLine, strand: Strand, stiffness: float, speed_share: float, sags: bool) -> list[Reach]:
    """Reaches of uniform mass of a strand; a part of its resistance goes with the speed."""
    found = []
    first = 0
    spans = strand.span_weights if sags and strand.span_weights else (0.0,) * len(strand.masses)
    for last in range(1, len(strand.marks)):
        if last < len(spans) and all(parts[last] == parts[first] for parts in (strand.masses, strand.goes, spans)):
            continue
        part = slice(first, last + 1)
        marks, friction, climb = (np.array(values[part]) for values in (strand.marks, strand.friction, strand.climb))
        found.append(
            Reach(
                strand.masses[first],
                stiffness,
                marks - marks[0],
                (1 - speed_share) * (friction - friction[0]),
                speed_share / line.speed * (friction - friction[0]),
                climb - climb[0],
                spans[first],
                strand.goes[first],
            )
        )
        first = last
    return found


@dataclass(frozen=True, slots=True)
class Set:
    """A scene ready to march: cells, stations, tensions of the cells at the start [N], what the belt gives besides, and
    what it carries along."""

    course: Course
    head: Station
    tail: Station
    tension: FloatArray
    give: Give | None
    travel: Travel | None


def set_up(case: Moving, carried: frozenset[str], cells: int) -> Set:
    """Cells and stations of a scene, with the effects it carries."""
    spec, line = case.spec, case.line
    grows = line.speed_share if "viscous_idlers" in carried else 0.0
    rubber = rubber_of(case, cells) if "belt_damping" in carried else None
    stiffness, sags = line.stiffness * (1 + (rubber.stiffer if rubber else 0.0)), "sag" in carried
    back, carry = (reaches(line, strand, stiffness, grows, sags) for strand in (line.back, line.carry))
    course = lay_out((*back, *carry), len(back), cells)
    steps = math.ceil(case.window / course.step) + 2
    times = np.arange(steps, dtype=np.float64) * course.step
    at_head, at_tail = place_at(course, 0, line.belt_line_mass), place_at(course, course.tail, line.belt_line_mass)
    at_tail = replace(at_tail, friction_on=at_tail.friction_on + max(line.tail_force, 0.0))
    tension = _tensions(case, course)
    takeup = None
    if not line.fixed_length:
        mass = spec.takeup_weight if "takeup_mass" in carried else 0.0
        takeup = TakeUp(line.static_ends(CARRY if line.weight_at_tail else RETURN)[0], mass)
    pulled = {"head": 0.0, "tail": 0.0}
    if isinstance(case.scene, Start):
        pulled["head"] = float(tension[-1] + course.climb[-1]) - float(tension[0])
        pulled["tail"] = float(tension[course.tail - 1] - tension[course.tail])
    head = Station(
        at_head,
        _drums(case, carried, "head", times, pulled["head"]),
        None if line.weight_at_tail else takeup,
        _imposed(case, "head", times),
        _shares(spec, "head"),
    )
    tail = Station(
        at_tail,
        _drums(case, carried, "tail", times, pulled["tail"]),
        takeup if line.weight_at_tail else None,
        _imposed(case, "tail", times),
        _shares(spec, "tail"),
    )
    follow(head, tail)
    give = Give(course, rubber, line.stiffness) if rubber or course.sag.any() else None
    travel = Travel(course, line.stiffness, line.speed) if "moving_belt" in carried else None
    return Set(course, head, tail, tension, give, travel)


def rubber_of(case: Moving, cells: int) -> Rubber | None:
    """The damping of the belt as so many cells have it; None for an elastic belt."""
    damping = case.spec.belt.damping
    if damping is None:
        return None
    if damping.stiffening is None:
        return Rubber.voigt(damping.time, case.line.contour_time, cells)
    return Rubber(damping.stiffening, damping.time)


def _imposed(case: Moving, at: str, times: FloatArray) -> OverTime | None:
    """Speed at which drums are held: by a jam, or by drives that control it."""
    if isinstance(case.scene, Jam):
        imposed = _blocked(case.speed, case.scene.time) if case.scene.at == at else None
    else:
        imposed = case.imposed if any(drive.at == at for drive in case.spec.all_drives.values()) else None
    if imposed is None:
        return None
    return OverTime(imposed(times), float(times[1]))


def _blocked(speed: float, time: float) -> Callable[[FloatArray], FloatArray]:
    """Speed of a drum that comes to rest evenly in a time [s]."""
    return lambda times: speed * np.maximum(1 - times / time, 0.0) if time else np.zeros_like(times)


def _shares(spec: Conveyor, at: str) -> tuple[float, ...]:
    forces = [drive_force(drive) for drive in spec.all_drives.values() if drive.at == at]
    return tuple(force / sum(forces) for force in forces)


def _tensions(case: Moving, course: Course) -> FloatArray:
    """Tension of every cell at the start, less gravity's part: of the running belt, or even all round."""
    line = case.line
    if case.begins_loose:
        if not line.fixed_length:
            above = float(course.climb[course.tail]) if line.weight_at_tail else 0.0
            return np.full(course.cells, line.takeup_tension - above)
        lengths = np.diff(course.places)
        mean = float(course.climb_within @ lengths) / float(lengths.sum())
        return np.full(course.cells, line.takeup_tension - mean)
    found: FloatArray = line.run_off + np.cumsum(course.friction + course.drag * case.speed)[:-1]
    found[course.tail :] += line.tail_step
    return found


def _drums(case: Moving, carried: frozenset[str], at: str, times: FloatArray, pulled: float) -> list[Drum]:
    spec, line = case.spec, case.line
    drives = [(name, drive) for name, drive in spec.all_drives.items() if drive.at == at]
    brakes = [braking(spec, brake) for brake in brakes_of(spec, case.scene).values() if brake.at == at]
    backstop = at == "head" and spec.backstop is not None
    if not drives:
        return [Drum("tail", line.tail_mass, brake=_braked(np.zeros_like(times), float(times[1]), brakes))]
    forces = {name: case.pulls[name](times) for name, _ in drives}
    together = sum(forces.values(), np.zeros_like(times))
    held = np.where(together < pulled, _FAST, 0.0) if isinstance(case.scene, Start) else np.zeros_like(times)
    held[np.argmax(held == 0) :] = 0.0  # once loose they stay loose
    step, masses, followed = float(times[1]), drive_masses(spec, case.scene), leaders(spec.all_drives)
    drums = []
    for index, (name, drive) in enumerate(drives):
        last = index == len(drives) - 1
        mass = masses[name] + (line.tail_mass if at == "tail" and index == 0 else 0.0)
        exponent = drive.drum.friction * drive.drum.wrap if drive.drum.friction is not None else None
        drums.append(
            Drum(
                name,
                mass,
                case.curves.get(name) or OverTime(forces[name], step),
                _braked(held, step, brakes if last else ()),
                exponent if "slip" in carried and exponent is not None and exponent < _MOST_GRIP else None,
                one_way=backstop,
                hold=line.speed if _holds(case, name) else math.inf,
                leader=followed.get(name, "") if name in case.curves else "",
            )
        )
    return drums


def _holds(case: Moving, name: str) -> bool:
    """Whether a drive pulls with a mean torque: its motor turns no faster than its own speed."""
    return isinstance(case.scene, Start) and case.imposed is None and name not in case.curves


def _braked(held: FloatArray, step: float, brakes: Sequence[Braking]) -> OverTime | Callable[[float], float]:
    """Capacity of brakes over time, and of friction that holds a pulley before a start."""
    if not brakes and not held.any():
        return no_brake
    return OverTime(held, step, tuple((brake.force, brake.delay, brake.rise) for brake in brakes))
