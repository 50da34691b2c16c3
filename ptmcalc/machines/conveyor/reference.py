"""The second method for belts that move: finite elements, which no plan offers.

Shared with the solvers: what the file says as numbers (masses, resistances and static tensions of the strands, forces
of drives and brakes over time, the window). The belt's waves, friction that holds, drums that slip and what is read of
a run are its own.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result, family, of
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.conveyor.machine import tension_loads
from ptmcalc.machines.conveyor.machine.brakes import brakes_of, braking
from ptmcalc.machines.conveyor.machine.loads import DRIVE, OF_NETWORK, PER_DRIVE
from ptmcalc.machines.conveyor.machine.model import FloatArray, Strand, drive_force, drive_masses
from ptmcalc.machines.conveyor.machine.motion import MOST_ROUNDS, Moving, moving
from ptmcalc.machines.conveyor.machine.scenes import IN_MOTION, ConveyorScene, Jam, Start
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.waves.network import CELLS
from ptmcalc.reference import belt
from ptmcalc.reference.belt import Length, Motion, Plan, Roller

_ELEMENTS = (160, 320, 640)
"""Elements of the finest of three meshes by level; a numerical choice. Twice the number takes four times as long and
halves the error at first order."""
_FAST = 1e30
"""Friction that locks the drive pulley until its drives overcome the static tension [N]: larger than any tension. A
numerical choice: infinity would leave differences undefined; a value near the tensions would release the pulley
early."""
_A_STEP, _AN_ELEMENT = 1.1e-4, 5e-8
"""Predicted seconds per step (`_A_STEP`), and per step and element (`_AN_ELEMENT`); the rates of a measurement of which
no record is kept. Wrong values change the choice of runs within a work budget, no load."""
_MARGIN = 3.0
"""Safety factor on the difference of two meshes [1]. A numerical choice: at first order the rest is no larger than the
difference. A smaller value weakens the reference; a larger one hides errors of the method it tests."""
_LONGER = 3
"""Windows that a stop is simulated in, each twice the one before; a numerical choice. More follow a belt that stops
later than the rigid body; each doubles the time."""
_SHORT = 0.02
"""Length of a loading zone relative to its strand [1] up to which its force acts at one place; a numerical choice. A
smaller value keeps more short lengths, whose single elements shorten all steps of time."""
Readings = dict[str, float]


def run(spec: Conveyor, scene: ConveyorScene, carried: frozenset[str], level: int) -> Result:
    """Loads of a scene in which the belt moves, from three meshes.

        m ds v' = dS - w ds sgn v - c ds v - dz,   S' = K/ds dv,   central differences, friction by return map

    **Range** any scene in motion of a taut belt; without sag, damping and wave convection.
    **Error** three times the difference to a mesh with half as many elements, or half of the difference of the two
    coarser meshes (two may agree by chance): fronts converge at least with the first order, so that the remaining error
    is at most that difference.
    **Source** lumped elements: Nordell and Ciozda; Moreau's time stepping of friction; derived in `reference.belt`.
    """
    case = moving(spec, scene)
    found, steps, end = [], 0, 0.0
    for elements in _meshes(level):
        seen = case
        for _ in range(_LONGER):
            motion = _moved(seen, carried, elements)
            if not case.brings_to_rest or math.isinf(case.rigid_time) or (np.array(motion.head.belt) <= 0).any():
                break
            seen = replace(seen, window=2 * seen.window)
        found.append(_readings(case, motion))
        steps, end = steps + len(motion.times), float(motion.times[-1])
    return Result(_with_bars(*found), work=steps, window=(0.0, end))


def _meshes(level: int) -> tuple[int, int, int]:
    return _ELEMENTS[level] // 4, _ELEMENTS[level] // 2, _ELEMENTS[level]


def _with_bars(coarsest: Readings, coarse: Readings, fine: Readings) -> dict[str, Found]:
    """Loads of the finest mesh; tensions, sums of the same waves, all with the largest of their bars."""
    known = {}
    for name, value in fine.items():
        one, two = coarsest.get(name, math.inf), coarse.get(name, math.inf)
        apart = max(abs(value - two), abs(two - one) / 2) if all(map(math.isfinite, (one, two, value))) else math.inf
        same = one == two == value
        known[name] = Estimate.exact(value) if same else Estimate.unknown(value)
        if math.isfinite(apart) and not same:
            known[name] = Estimate.within(value, _MARGIN * apart)
    most = max((one.bar for name, one in known.items() if family(name).startswith("tension")), default=0.0)
    return {
        name: Found(Estimate.within(one.value, most) if family(name).startswith("tension") and one.bounded else one)
        for name, one in known.items()
    }


def _moved(case: Moving, carried: frozenset[str], elements: int) -> Motion:
    line, spec, scene = case.line, case.spec, case.scene
    share = line.speed_share if "viscous_idlers" in carried else 0.0
    back, carry = (_lengths(strand, line.stiffness, share, line.speed) for strand in (line.back, line.carry))
    lengths = (*back, *carry)
    counts = belt.shared_out(lengths, elements)
    pieces = [(one, one.length / n) for one, n in zip(lengths, counts, strict=True) for _ in range(n)]
    rubbed = np.array([(one.friction + one.drag * case.speed) * way for one, way in pieces])
    rubbed = rubbed + belt.lumps_of(lengths, counts)
    climbed, ways = np.array([one.climb * way for one, way in pieces]), np.array([way for _, way in pieces])
    first = sum(counts[: len(back)])
    tension = _tension(case, rubbed, climbed, ways, first)
    pulled = {"head": 0.0, "tail": 0.0}
    if isinstance(scene, Start):
        pulled["head"] = float(tension[-1] - tension[0] + climbed.sum())
        pulled["tail"] = float(tension[first - 1] - tension[first])
    takeup = None
    if not line.fixed_length:
        mass = spec.takeup_weight if "takeup_mass" in carried else 0.0
        takeup = (line.takeup_tension, mass)
    plan = Plan(
        lengths,
        len(back),
        _rollers(case, carried, "head", pulled["head"]),
        _rollers(case, carried, "tail", pulled["tail"]),
        takeup,
        _imposed(case, "head"),
        _imposed(case, "tail"),
        line.belt_line_mass,
        max(line.tail_force, 0.0),
    )
    after = 2 * line.contour_time if case.brings_to_rest else math.inf
    return belt.simulate(plan, elements, case.window, tension, case.speed, after)


def _lengths(strand: Strand, stiffness: float, share: float, speed: float) -> list[Length]:
    """Uniform lengths of a strand; a part of its resistance goes with the speed. A loading zone is much shorter than an
    element: it belongs to the length behind it, whose first element has the force of the zone."""
    found: list[Length] = []
    zone: Length | None = None
    for k, mass in enumerate(strand.masses):
        length = strand.marks[k + 1] - strand.marks[k]
        rubs = (strand.friction[k + 1] - strand.friction[k]) / length
        climbs = (strand.climb[k + 1] - strand.climb[k]) / length
        one = Length(length, mass, stiffness, (1 - share) * rubs, climbs, share * rubs / speed)
        if zone is not None and _goes_on(zone, one):
            more = zone.length * (zone.friction - one.friction) / (1 - share) + zone.lump
            one = replace(one, length=zone.length + length, lump=more)
        elif zone is not None:
            found.append(zone)
        zone = one if one.length < _SHORT * strand.length else None
        if zone is None:
            found.append(one)
    return found if zone is None else [*found, zone]


def _goes_on(zone: Length, one: Length) -> bool:
    """Whether a short length differs in friction alone from the one behind it."""
    return zone.line_mass == one.line_mass and math.isclose(zone.climb, one.climb, rel_tol=1e-9, abs_tol=1e-9)


def _tension(case: Moving, rubbed: FloatArray, climbed: FloatArray, ways: FloatArray, first: int) -> FloatArray:
    """Tension of every element at the start, less gravity's part.

    A running belt begins in balance: half the elements beside head and tail rub at the next node within, and so does
    the belt's force at the tail. One node off, and a pulse as high as that force sets out from there: the shorter the
    finer the mesh, but never lower.
    """
    line = case.line
    if case.begins_loose:
        if not line.fixed_length:
            return np.full(len(rubbed), line.takeup_tension)
        inside = np.cumsum(climbed) - climbed / 2
        return np.full(len(rubbed), line.takeup_tension - float(inside @ ways) / float(ways.sum()))
    found: FloatArray = line.run_off + np.cumsum(rubbed) - rubbed / 2
    found[first:] += line.tail_step
    found[first - 1] = found[first] + line.tail_pull
    found[0], found[-1] = line.run_off, found[-1] + rubbed[-1] / 2
    return found


def _imposed(case: Moving, at: str) -> Callable[[float], float] | None:
    scene = case.scene
    if isinstance(scene, Jam):
        speed, time = case.speed, scene.time
        if scene.at != at:
            return None
        return lambda now: speed * max(1 - now / time, 0.0) if time else 0.0
    imposed = case.imposed
    if imposed is None or all(drive.at != at for drive in case.spec.all_drives.values()):
        return None
    return lambda now: float(imposed(np.asarray(now)))


def _rollers(case: Moving, carried: frozenset[str], at: str, pulled: float) -> tuple[Roller, ...]:
    spec, line = case.spec, case.line
    drives = [(name, drive) for name, drive in spec.all_drives.items() if drive.at == at]
    brakes = [braking(spec, brake).at for brake in brakes_of(spec, case.scene).values() if brake.at == at]
    together = _sum(brakes)
    if not drives:
        return (Roller(line.tail_mass, hold=together),)
    masses = drive_masses(spec, case.scene)
    pulls = [_pull(case, name) for name, _ in drives]
    loose: list[bool] = [] if isinstance(case.scene, Start) and case.imposed is None else [True]

    def held(time: float) -> float:
        if not loose and sum(pull(time, 0.0) for pull in pulls) < pulled * (1 - 1e-12):
            return _FAST
        loose.append(True)
        return 0.0

    found = []
    for index, (name, drive) in enumerate(drives):
        mass = masses[name] + (line.tail_mass if at == "tail" and index == 0 else 0.0)
        grip = drive.drum.friction * drive.drum.wrap if drive.drum.friction is not None else None
        slips = "slip" in carried and grip is not None and grip < 700
        hold = _sum([held, *brakes]) if index == len(drives) - 1 else held
        one_way = at == "head" and spec.backstop is not None
        pulls_evenly = isinstance(case.scene, Start) and case.imposed is None and name not in case.curves
        rated = line.speed if pulls_evenly else math.inf
        found.append(Roller(mass, pulls[index], hold, grip if slips else None, one_way, drive_force(drive), rated))
    return tuple(found)


def _sum(parts: Sequence[Callable[[float], float]]) -> Callable[[float], float]:
    return lambda time: sum((part(time) for part in parts), 0.0)


def _pull(case: Moving, name: str) -> Callable[[float, float], float]:
    """Force of a drive at the rim over time and speed."""
    curve, force = case.curves.get(name), case.pulls[name]
    if curve is not None:
        return lambda time, speed: curve(time, speed)[0]
    return lambda time, speed: float(force(np.array([time]))[0])


# -- what is read ----------------------------------------------------------------------------------------------------


def _readings(case: Moving, motion: Motion) -> Readings:
    line, head, step = case.line, motion.head, float(motion.times[1])
    on, off, speeds = (np.array(part) for part in (head.on, head.off, head.belt))
    found: Readings = {
        "tension_run_on_max": float(on.max()),
        "tension_dynamic_run_on_max": float(on.max()) - line.run_on,
        "tension_run_off_min": float(off.min()),
    }
    tail_on, tail_off = np.array(motion.tail.on), np.array(motion.tail.off)
    first = motion.tail_element
    highs = (motion.highest[:first].max(), motion.highest[first:].max(), on.max(), off.max(), tail_on.max())
    lows = (
        min(float(motion.lowest[:first].min()), float(off.min()), float(tail_on.min())),
        min(float(motion.lowest[first:].min()), float(on.min()), float(tail_off.min())),
    )
    between = [np.array(spot.between) for spot in (head, motion.tail)]
    high = max(*map(float, highs), float(tail_off.max()), *(float(one.max()) for one in between))
    found |= {"tension_max": high, "tension_min": min(*lows, *(float(one.min()) for one in between))}
    found |= tension_loads.derived_loads(line, high, lows)
    if line.by_length:  # of the tension and load of each length, which is not known here
        found = {name: value for name, value in found.items() if name not in ("sag_relative_max", "slack_margin_min")}
    for at, tensions, spot in (("head", between[0], head), ("tail", between[1], motion.tail)):
        names = [name for name, drive in case.spec.all_drives.items() if drive.at == at]
        for j, name in enumerate(names):
            found |= _of_drive(case, name, tensions[:, j], tensions[:, j + 1], np.array(spot.belt), bool(spot.slid[j]))
    used = [value for name, value in found.items() if name.startswith("slip_utilisation_max[")]
    left = [value for name, value in found.items() if name.startswith("slip_reserve_min[")]
    if used:
        found |= {"slip_utilisation_max": max(used), "slip_reserve_min": min(left)}
    if not line.fixed_length:
        way = np.concatenate([[0.0], np.cumsum(speeds - motion.behind)]) * step / 2
        found["takeup_movement"] = float(way.max() - way.min())
    if case.brings_to_rest:
        found |= _rest(case, speeds, step)
    return found


def _of_drive(case: Moving, name: str, on: FloatArray, off: FloatArray, speed: FloatArray, slipped: bool) -> Readings:
    """Loads of a drum that has a drive."""
    found = {of("tension_run_on_max", name): float(on.max()), of("tension_run_off_min", name): float(off.min())}
    drum = case.spec.all_drives[name].drum
    if drum.friction is None or slipped:
        return found
    exponent = drum.friction * drum.wrap
    tight, slack = np.maximum(on, off), np.minimum(on, off)
    lift = case.line.belt_line_mass * speed**2
    if (slack <= lift).any() or (slack <= 0).any():
        return found
    used = (tight - lift) / (slack - lift) * math.exp(-exponent)
    at_rest = float((tight / slack).max()) - 1  # centrifugal tension has no part in what the drum transmits
    found[of("slip_utilisation_max", name)] = float(used.max())
    held = at_rest * math.exp(-exponent)  # over e^(mu alpha), which is beyond all numbers for a rope of many turns
    found[of("slip_reserve_min", name)] = -math.expm1(-exponent) / held if held > 0 else math.inf
    return found


def _rest(case: Moving, speeds: FloatArray, step: float) -> Readings:
    """When and where the belt at the head comes to rest for the first time."""
    name = "coast_distance" if case.scene.type == "coast" else "stop_distance"
    stopped = np.flatnonzero(speeds <= 0)
    if not len(stopped):
        return {"stop_time": math.inf, name: math.inf}
    last = int(stopped[0])
    if not last:
        return {"stop_time": 0.0, name: 0.0}
    before, after = float(speeds[last - 1]), float(speeds[last])
    part = before / (before - after) * step
    way = float((speeds[1:last] + speeds[: last - 1]).sum()) / 2 * step + before * part / 2
    return {"stop_time": (last - 1) * step + part, name: way}


# -- what it costs, and where it holds -------------------------------------------------------------------------------


def cost(spec: Conveyor, scene: ConveyorScene, carried: frozenset[str], level: int) -> float:
    """Seconds predicted from the steps of both meshes."""
    case = moving(spec, scene)
    rounds, seconds = case.window / case.line.contour_time, 1e-3
    for elements in _meshes(level):
        seconds += elements / belt.COURANT * rounds * (_A_STEP + elements * _AN_ELEMENT)
    return seconds


def valid(spec: Conveyor, scene: ConveyorScene) -> Criterion | None:
    """Whether there is a motion to simulate.

        n, rounds of a wave in the time of the scene: at 1000 simulating it takes a minute;   1 for a weight at the tail

    **Range** any scene in motion, a take-up weight at the head or none.
    **Error** exact.
    **Source** as `solvers.network`.
    """
    case = moving(spec, scene)
    if case.line.weight_at_tail:
        return Criterion("tail", 1.0, 1.0, "a take-up weight at the tail is not in the elements", "the file")
    if case.window <= 0:
        return Criterion("W/F", 1.0, 1.0, "static resistance / drive force: the belt does not move", "Newton")
    rounds = case.window / case.line.contour_time
    return Criterion("n", rounds, MOST_ROUNDS, "wave circuits during the scene: too much work", "cost")


ELEMENTS: Solver[Conveyor, ConveyorScene] = Solver(
    name="elements",
    title="finite elements, whole belt (reference)",
    fidelity=Fidelity.TRANSIENT,
    scenes=IN_MOTION,
    represents=frozenset(
        {"belt_wave", "tail_jump", "tail_mass", "slip", "coulomb_idlers", "takeup_mass", "viscous_idlers"}
    ),
    gives=OF_NETWORK.union(PER_DRIVE, DRIVE),
    run=run,
    cost=cost,
    source="lumped elements with Moreau's time stepping; derived in ptmcalc.reference.belt",
    valid=valid,
    always=frozenset({"belt_wave", "tail_jump", "tail_mass", "coulomb_idlers"}),
    levels=len(_ELEMENTS),
)

REFERENCE_METHODS = (CELLS, ELEMENTS)
