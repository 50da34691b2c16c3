"""A scene in which the belt moves, as its cells, drums, drives and brakes over time.

Sums along a strand come from `model.Strand`; drums stand at the head in the order in which the belt meets them, and
at the tail. Before a start the drums are held (by friction, brake or backstop) until the drives pull harder than the
belt does.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ptmcalc.laws import capstan, start_profile
from ptmcalc.machines.conveyor.model import (
    BeltLine,
    FloatArray,
    Strand,
    belt_line,
    drive_force,
    drive_mass,
    filled,
)
from ptmcalc.machines.conveyor.spec import (
    Brake,
    Coast,
    Conveyor,
    ConveyorScene,
    EmergencyStop,
    Jam,
    PlacedDrive,
    Start,
    Stop,
    Stopping,
)
from ptmcalc.numerics.belt.course import Course, Reach, lay_out
from ptmcalc.numerics.belt.march import place_at
from ptmcalc.numerics.belt.station import Drum, Station, TakeUp

_FAST = 1e30
_MOST_GRIP = 700.0
"""mu alpha above which no tension makes a drum slip: exp of it is the largest number there is."""
_CONTOURS = 2.0
"""Times a wave goes round the belt that are looked at after it has come to rest, or after a drum has jammed."""
_LATE = 1.25
"""How much longer than the rigid body the belt may take to come to rest."""


@dataclass(frozen=True, slots=True)
class Braking:
    """What a brake does at the rim over time: full force [N], delay and rise [s]."""

    force: float
    delay: float
    rise: float

    def at(self, time: float) -> float:
        """Capacity at a time [N]."""
        if time <= self.delay:
            return 0.0
        return self.force * (min((time - self.delay) / self.rise, 1.0) if self.rise > 0 else 1.0)


def brakes_of(spec: Conveyor, scene: ConveyorScene) -> dict[str, Brake]:
    """The brakes that act in a scene."""
    acts = isinstance(scene, EmergencyStop) or (isinstance(scene, Stop) and scene.brakes == "on")
    return dict(spec.brakes) if acts else {}


def braking(spec: Conveyor, brake: Brake) -> Braking:
    """A brake at the rim: a brake on the motor shaft is driven through the gear, whose losses add to it.

    F = M/R   (drum shaft)        F = M i/(eta R)   (motor shaft)

    It acts on the last drive there; at a tail without one, on the tail drum.
    """
    there = [drive for drive in spec.all_drives.values() if drive.at == brake.at]
    if not there:
        diameter = spec.tail_drum.diameter or spec.main_drive.drum.diameter
        return Braking(brake.torque * 2 / diameter, brake.delay, brake.rise_time)
    drive = there[-1]
    force = brake.torque * 2 / drive.drum.diameter
    if brake.shaft == "motor":
        force *= drive.gear.ratio / filled(drive.gear.efficiency)
    return Braking(force, brake.delay, brake.rise_time)


@dataclass(frozen=True, slots=True)
class Moving:
    """A scene in numbers: the belt, its window, and what sets it in motion or stops it.

    `forces` gives the rim force of every drive over time [N], `imposed` the speed of all drums where the drives
    control it.
    """

    spec: Conveyor
    scene: ConveyorScene
    line: BeltLine
    pulls: dict[str, Callable[[FloatArray], FloatArray]]
    imposed: Callable[[float], float] | None
    speed: float
    window: float
    rigid_time: float
    """when the rigid body reaches rated speed, or rest [s]"""
    rigid_way: float
    """what it goes by then [m]"""

    @property
    def begins_loose(self) -> bool:
        """Whether the belt lies without friction in it at the start."""
        return isinstance(self.scene, Start) and self.scene.belt == "relaxed"

    @property
    def brings_to_rest(self) -> bool:
        """Whether the scene ends with a belt at rest."""
        return isinstance(self.scene, Stopping)


def share(spec: Conveyor) -> dict[str, float]:
    """Part of the whole driving force that each drive has."""
    forces = {name: drive_force(drive) for name, drive in spec.all_drives.items()}
    whole = sum(forces.values())
    return {name: force / whole for name, force in forces.items()}


def running(spec: Conveyor, scene: ConveyorScene) -> BeltLine:
    """The belt in steady motion: drives at the tail take their share of the resistance there."""
    line = belt_line(spec, scene)
    shares = share(spec)
    tail = sum(shares[name] for name, drive in spec.all_drives.items() if drive.at == "tail")
    return replace(line, tail_pull=tail * line.static_resistance) if tail else line


def moving(spec: Conveyor, scene: ConveyorScene) -> Moving:
    """A scene of this conveyor in motion."""
    line = running(spec, scene)
    names = list(spec.all_drives)
    whole = line.static_resistance + line.tail_pull
    if isinstance(scene, Start):
        return _start(spec, scene, line)
    held = {name: share(spec)[name] * whole for name in names}
    if isinstance(scene, Jam):
        there = [name for name in names if spec.all_drives[name].at != scene.at]
        pulls = {name: _constant(held[name] if name in there else 0.0) for name in names}
        return Moving(spec, scene, line, pulls, None, spec.speed, scene.duration or _CONTOURS * line.contour_time, 0, 0)
    assert isinstance(scene, Stop | EmergencyStop | Coast)
    time, way = rigid_stop(spec, scene, line)
    window = (_LATE * time if math.isfinite(time) else 2 * line.contour_time) + _CONTOURS * line.contour_time
    return Moving(spec, scene, line, {name: _constant(0.0) for name in names}, None, spec.speed, window, time, way)


def _constant(force: float) -> Callable[[FloatArray], FloatArray]:
    return lambda times: np.full(np.shape(times), force)


def moving_mass(line: BeltLine) -> float:
    """Everything that moves, at the rim [kg]."""
    belt = line.carry.line_mass * line.carry.length + line.back.line_mass * line.back.length
    return belt + line.tail_mass + line.drive_mass


def rigid_stop(spec: Conveyor, scene: ConveyorScene, line: BeltLine) -> tuple[float, float]:
    """Time and way of the rigid body from full speed to rest; infinite where nothing stops it.

    M v' = -(W + sum B(t)), brakes with delay and straight rise: pieces of constant or linear force, solved piece by
    piece.
    """
    mass, resistance = moving_mass(line), line.static_resistance + line.tail_pull
    brakes = [braking(spec, brake) for brake in brakes_of(spec, scene).values()]
    marks = sorted({0.0, *(b.delay for b in brakes), *(b.delay + b.rise for b in brakes)})
    speed, way = line.speed, 0.0
    for begin, end in zip(marks, [*marks[1:], math.inf], strict=True):
        # force over the piece: r0 + r1 t
        middle = begin + (1.0 if math.isinf(end) else (end - begin) / 2)
        r0 = resistance + sum(b.at(begin + 1e-12 * max(begin, 1.0)) if b.rise <= 0 else b.at(begin) for b in brakes)
        r1 = (resistance + sum(b.at(middle) for b in brakes) - r0) / (middle - begin)
        rest = _first_rest(mass * speed, r0, r1)
        length = min(rest, end - begin)
        if math.isinf(length):
            return math.inf, math.inf
        way += speed * length - (r0 * length**2 / 2 + r1 * length**3 / 6) / mass
        if rest <= end - begin:
            return begin + rest, way
        speed -= (r0 * length + r1 * length**2 / 2) / mass
    return math.inf, math.inf


def deceleration(spec: Conveyor, scene: ConveyorScene, line: BeltLine) -> float:
    """Largest deceleration of the rigid body with all brakes of the scene [m/s^2]."""
    brakes = sum(braking(spec, brake).force for brake in brakes_of(spec, scene).values())
    return abs(line.static_resistance + line.tail_pull + brakes) / moving_mass(line)


def rough_utilisation(spec: Conveyor, scene: ConveyorScene) -> float:
    """Most of any drum's grip in use by the rigid body's tensions, the dynamic part taken twice.

    From the slack side on, every drum of the head adds its own drive's force (start) or takes its share of what the
    belt gives (stop); a jammed drum takes all of it.
    """
    line = running(spec, scene)
    if isinstance(scene, Jam):
        return math.inf
    shares = share(spec)
    whole = line.static_resistance + line.tail_pull
    belt = line.carry.line_mass * line.carry.length + line.back.line_mass * line.back.length
    behind, worst = line.run_off, 0.0
    for name, drive in reversed(list(spec.all_drives.items())):
        if drive.at == "tail":
            continue
        added = (
            drive_force(drive)
            if isinstance(scene, Start)
            else shares[name] * (whole - 2 * belt * deceleration(spec, scene, line))
        )
        above = behind + added
        if drive.drum.friction is not None:
            tight, slack = max(above, behind), min(above, behind)
            exponent = drive.drum.friction * drive.drum.wrap
            worst = max(worst, float(capstan.slip_utilisation(tight, slack, line.centrifugal_at_speed, exponent)))
        behind = above
    return worst


def _first_rest(momentum: float, force: float, rate: float) -> float:
    """Smallest t > 0 with force t + rate t^2/2 = momentum."""
    if abs(rate) * momentum <= 1e-14 * force**2:
        return momentum / force if force > 0 else math.inf
    root = force**2 + 2 * rate * momentum
    if root < 0:
        return math.inf
    bottom = force + math.sqrt(root)
    return 2 * momentum / bottom if bottom > 0 else math.inf


# -- starts ---------------------------------------------------------------------------------------------------------


def _start(spec: Conveyor, scene: Start, line: BeltLine) -> Moving:
    profile = scene.profile
    rise = profile.time or 0.0
    if profile.imposes_speed:
        window = rise + 4 * line.contour_time

        def imposed(time: float) -> float:
            return line.speed * float(start_profile.rise(profile.shape, rise, time))

        pulls = {name: _constant(0.0) for name in spec.all_drives}
        return Moving(spec, scene, line, pulls, imposed, 0.0, window, rise, math.nan)
    pulls = {name: _pull(scene, drive, rise) for name, drive in spec.all_drives.items()}
    time, way = _rigid_start(spec, scene, line, pulls)
    return Moving(spec, scene, line, pulls, None, 0.0, time, time, way)


def _pull(scene: Start, drive: PlacedDrive, rise: float) -> Callable[[FloatArray], FloatArray]:
    """Rim force of a drive over a start [N]."""
    full, shape, delay = drive_force(drive), scene.profile.shape, drive.delay
    aborted = scene.aborted
    again = aborted.run + aborted.pause if aborted else 0.0

    def since(times: FloatArray) -> FloatArray:
        on = times >= 0
        return np.where(on, full * start_profile.rise(shape, rise, np.maximum(times, 0.0)), 0.0)

    def force(times: FloatArray) -> FloatArray:
        times = np.asarray(times, float)
        second = since(times - again - delay)
        if not aborted:
            return second
        return np.where(times < aborted.run, since(times - delay), second)

    return force


def _rigid_start(
    spec: Conveyor, scene: Start, line: BeltLine, pulls: dict[str, Callable[[FloatArray], FloatArray]]
) -> tuple[float, float]:
    """When the mean speed of all that moves is the rated one, and the way by then, by the trapezium rule.

    v = x - min(x so far),  x = integral of (F - W)/M dt: the mean of all that moves, whatever waves there are
    """
    mass, resistance = moving_mass(line), line.static_resistance + line.tail_pull
    full = sum(drive_force(drive) for drive in spec.all_drives.values())
    if full <= resistance:
        return 0.0, 0.0
    latest = max(drive.delay for drive in spec.all_drives.values()) + (scene.profile.time or 0.0)
    latest += (scene.aborted.run + scene.aborted.pause) if scene.aborted else 0.0
    end = latest + mass * line.speed / (full - resistance)
    times = np.linspace(0.0, end, 20_001)
    force = sum((pull(times) for pull in pulls.values()), np.zeros_like(times)) - resistance
    gained = np.concatenate([[0.0], np.cumsum(force[1:] + force[:-1])]) * (times[1] / 2 / mass)
    speed = gained - np.minimum.accumulate(gained)  # it never turns back: what would pull it back is held
    fast = int(np.argmax(speed >= line.speed)) or len(times) - 1
    part = min((line.speed - speed[fast - 1]) / (speed[fast] - speed[fast - 1]), 1.0) * times[1]
    way = float((speed[1:fast] + speed[: fast - 1]).sum()) * times[1] / 2
    return float(times[fast - 1] + part), way + float((speed[fast - 1] + line.speed) / 2 * part)


# -- cells and stations ---------------------------------------------------------------------------------------------


def reaches(line: BeltLine, strand: Strand) -> list[Reach]:
    """Reaches of uniform mass of a strand."""
    found = []
    first = 0
    for last in range(1, len(strand.marks)):
        if last < len(strand.masses) and strand.masses[last] == strand.masses[first]:
            continue
        part = slice(first, last + 1)
        marks, friction, climb = (np.array(values[part]) for values in (strand.marks, strand.friction, strand.climb))
        found.append(
            Reach(
                strand.masses[first],
                line.stiffness,
                marks - marks[0],
                friction - friction[0],
                np.zeros(len(marks)),
                climb - climb[0],
            )
        )
        first = last
    return found


@dataclass(frozen=True, slots=True)
class Set:
    """A scene ready to march: cells, stations, tensions of the cells at the start [N]."""

    course: Course
    head: Station
    tail: Station
    tension: FloatArray


def set_up(case: Moving, carried: frozenset[str], cells: int) -> Set:
    """Cells and stations of a scene, with the effects it carries."""
    spec, line = case.spec, case.line
    back, carry = reaches(line, line.back), reaches(line, line.carry)
    course = lay_out((*back, *carry), len(back), cells)
    steps = math.ceil(case.window / course.step) + 2
    times = np.arange(steps, dtype=np.float64) * course.step
    at_head, at_tail = place_at(course, 0, line.belt_line_mass), place_at(course, course.tail, line.belt_line_mass)
    at_tail = replace(at_tail, friction_on=at_tail.friction_on + max(line.tail_force, 0.0))
    tension = _tensions(case, course)
    takeup = None
    if not line.fixed_length:
        mass = spec.takeup.mass or 0.0 if "takeup_mass" in carried else 0.0
        takeup = TakeUp(line.takeup_tension, mass)
    pulled = {"head": 0.0, "tail": 0.0}
    if isinstance(case.scene, Start):
        pulled["head"] = float(tension[-1] + course.climb[-1]) - float(tension[0])
        pulled["tail"] = float(tension[course.tail - 1] - tension[course.tail])
    head = Station(
        at_head,
        _drums(case, carried, "head", times, pulled["head"]),
        takeup,
        _imposed(case, "head"),
        _shares(spec, "head"),
    )
    tail = Station(
        at_tail,
        _drums(case, carried, "tail", times, pulled["tail"]),
        None,
        _imposed(case, "tail"),
        _shares(spec, "tail"),
    )
    return Set(course, head, tail, tension)


def _imposed(case: Moving, at: str) -> Callable[[float], float] | None:
    """Speed at which drums are held: by a jam, or by drives that control it."""
    if isinstance(case.scene, Jam):
        return (lambda time: 0.0) if case.scene.at == at else None
    driven = any(drive.at == at for drive in case.spec.all_drives.values())
    return case.imposed if driven else None


def _shares(spec: Conveyor, at: str) -> tuple[float, ...]:
    forces = [drive_force(drive) for drive in spec.all_drives.values() if drive.at == at]
    return tuple(force / sum(forces) for force in forces)


def _tensions(case: Moving, course: Course) -> FloatArray:
    """Tension of every cell at the start, less gravity's part: of the running belt, or even all round."""
    line = case.line
    if case.begins_loose:
        if not line.fixed_length:
            return np.full(course.cells, line.takeup_tension)
        lengths = np.diff(course.places)
        mean = float(course.climb_within @ lengths) / float(lengths.sum())
        return np.full(course.cells, line.takeup_tension - mean)
    found: FloatArray = line.run_off + np.cumsum(course.friction)[:-1]
    found[course.tail :] += line.tail_step
    return found


def _drums(case: Moving, carried: frozenset[str], at: str, times: FloatArray, pulled: float) -> list[Drum]:
    spec, line = case.spec, case.line
    drives = [(name, drive) for name, drive in spec.all_drives.items() if drive.at == at]
    brakes = [braking(spec, brake).at for brake in brakes_of(spec, case.scene).values() if brake.at == at]
    backstop = at == "head" and spec.backstop is not None
    if not drives:
        return [Drum("tail", line.tail_mass, brake=lambda time: sum((brake(time) for brake in brakes), 0.0))]
    forces = {name: case.pulls[name](times) for name, _ in drives}
    together = sum(forces.values(), np.zeros_like(times))
    held = np.where(together < pulled, _FAST, 0.0) if isinstance(case.scene, Start) else np.zeros_like(times)
    held[np.argmax(held == 0) :] = 0.0  # once loose they stay loose
    step = float(times[1])
    drums = []
    for index, (name, drive) in enumerate(drives):
        last = index == len(drives) - 1
        mass = drive_mass(drive) + (line.tail_mass if at == "tail" and index == 0 else 0.0)
        exponent = drive.drum.friction * drive.drum.wrap if drive.drum.friction is not None else None
        drums.append(
            Drum(
                name,
                mass,
                _read(forces[name], step),
                _braked(held, step, brakes if last else ()),
                exponent if "slip" in carried and exponent is not None and exponent < _MOST_GRIP else None,
                one_way=backstop,
            )
        )
    return drums


def _read(values: FloatArray, step: float) -> Callable[[float, float], tuple[float, float]]:
    """A force sampled on the grid of time."""
    table = values.tolist()
    return lambda time, speed: (table[round(time / step)], 0.0)


def _braked(held: FloatArray, step: float, brakes: Sequence[Callable[[float], float]]) -> Callable[[float], float]:
    table = held.tolist()
    return lambda time: table[round(time / step)] + sum((brake(time) for brake in brakes), 0.0)
