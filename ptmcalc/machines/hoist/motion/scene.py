"""A scene of a hoist played through, and the loads read from it with their bars."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.result import Event, Finding, Found, History, Result
from ptmcalc.machines.hoist.machine.spec import Lift, Release, Start
from ptmcalc.machines.hoist.motion.after_window import over, ringing_on
from ptmcalc.machines.hoist.motion.course import Course, first_event, first_rest, lift_off_time, play, stopped
from ptmcalc.machines.hoist.motion.scene_failures import failures, outlasts, remarks
from ptmcalc.machines.hoist.motion.train import (
    DRIVE,
    FLANK,
    GEARBOX,
    HOOK,
    LEAST_LEFT,
    LOAD,
    LONGEST,
    ROPE,
    SHAFT,
    STRUCTURE,
    TOLERANCES,
    Case,
    Moving,
)
from ptmcalc.numerics.flow import FADED
from ptmcalc.numerics.record import PANEL
from ptmcalc.numerics.train.modes import frequencies

_COMPARED = (0.7, 0.85)
"""Length of intervals and panels of the compared runs, relative to the run that counts [1]. A numerical choice: the
difference gives the error bar. Values near 1 compare runs whose errors agree; smaller ones take longer."""
_MARGIN = 3.0
"""Safety factor on the difference of runs with other time steps [1]; a numerical choice. A smaller value loses the
safety of the error bar; a larger one widens it."""
_UNSEEN = FADED + 3e-12
"""Error of a reading relative to the largest value [1]: components that have faded, and the signal between the nodes. A
numerical choice above the resolution 2e-16 of the floating point. A larger value widens bars that are otherwise
rounding."""
_CLOSES = 1e-9
"""Residual of the energy balance of a motion without a smooth torque curve [1] above which NUM101 is reported; a
numerical choice. A larger value accepts wrong runs; a smaller one refuses rounding."""
_LONGER = 4
"""Doublings of the window of a stop that is not finished; a numerical choice. The last window is 16 times the first.
More follow late stops and take longer."""
_FORCES = frozenset({"rope_force_max", "rope_force_min", "bridge_force_max", "bridge_force_min"})
_LENGTHS = frozenset({"stop_distance", "stop_distance_lowering"})
Readings = dict[str, tuple[float, float | None]]
"""Value of each load, and the time at which it occurs where there is one."""


def readings(scene: Moving, course: Course) -> Readings:
    """The loads of a run."""
    case = course.case
    rope = case.named("link", ROPE)
    assert rope is not None
    found: Readings = {"rope_force_max": course.top("link", rope)}
    structure = case.named("link", STRUCTURE)
    found["bridge_force_max"] = course.top("link", structure) if structure is not None else found["rope_force_max"]
    if isinstance(scene, Lift):
        found |= _of_the_lift(course)
    else:
        found["rope_force_min"] = course.bottom("link", rope)
        found["bridge_force_min"] = (
            course.bottom("link", structure) if structure is not None else found["rope_force_min"]
        )
    if not isinstance(scene, Release):
        peak, time = _gear_torque(course)
        found |= {"backlash_torque_peak": (peak, time), "gear_impact_factor": (peak / case.even_torque, time)}
    if case.stops:
        found |= _of_the_stop(course)
    return found


def _gear_torque(course: Course) -> tuple[float, float]:
    """Largest torque of the gear on the drum shaft."""
    shaft = course.case.named("link", SHAFT)
    if shaft is not None:
        flank = course.case.named("link", FLANK)
        found = [course.largest("link", index) for index in (shaft, flank) if index is not None]
        return max(found)
    mesh = course.case.named("mesh", GEARBOX)
    assert mesh is not None
    return course.largest("mesh", mesh)


def _of_the_lift(course: Course) -> Readings:
    lifted = lift_off_time(course)
    if not math.isfinite(lifted) or course.case.weak:
        return {"lift_off_speed": (0.0, None), "lift_off_time": (math.inf, None), "tension_time": (math.inf, None)}
    taut = first_event(course, ROPE, "closed")
    hook = course.case.named("body", HOOK)
    assert hook is not None
    until = play(course.case, TOLERANCES[1], end=lifted) if lifted > 0 else course
    speed = float(until.record.last[until.system.watched["speed", hook]])
    return {
        "lift_off_speed": (speed, lifted),
        "lift_off_time": (lifted, None),
        "tension_time": (lifted - (taut if taut <= lifted else 0.0), None),
    }


def _of_the_stop(course: Course) -> Readings:
    load = course.case.named("body", LOAD)
    assert load is not None
    time = first_rest(course) if math.isfinite(stopped(course)) else math.inf
    edge = course.bottom("position", load) if course.case.lowers else course.top("position", load)
    way = (abs(edge[0]), edge[1]) if math.isfinite(time) else (math.inf, None)
    return {"stop_time": (time, None), "stop_distance_lowering" if course.case.lowers else "stop_distance": way}


def loads(scene: Moving, course: Course, others: tuple[Course, ...], coarser: Course | None = None) -> dict[str, Found]:
    """The loads of a run, with bars from others that divide time otherwise and from one with fewer chords."""
    compared, chords = [readings(scene, other) for other in others], readings(scene, coarser) if coarser else None
    return with_bars(scene, course.case, readings(scene, course), compared, chords)


def with_bars(
    scene: Moving,
    case: Case,
    own: Readings,
    compared: Sequence[Readings],
    coarser: Readings | None = None,
    unseen: float = _UNSEEN,
) -> dict[str, Found]:
    """Loads with bars from those of runs that divide time otherwise.

        bar = 3 max |x - x'| over the other runs, and over the loads of one kind as shares of the largest of them

    Without a nonlinear torque all runs are exact and what differs is rounding; with one, stretches 0.7 and 0.85 times
    as long have errors 25 and 4 times as small or as large (the ninth power), so two runs differ by nearly the larger
    error. Added is what reading a signal may miss, and the difference to a run with half as many chords of a smooth
    rise: it is three times the error of the chords, which is of second order.
    """
    apart, chords = _apart(own, compared), _apart(own, [coarser] if coarser else [])
    if coarser:
        apart = {name: apart[name] + chords[name] / _MARGIN for name in apart.keys() & chords.keys()}
    shares = {kind: _share(own, apart, kind) for kind in (_FORCES, _LENGTHS)}
    found = {}
    for name, (value, time) in own.items():
        at = {"time": time} if time is not None else {}
        if name not in apart:
            same = all(other[name][0] == value for other in (*compared, *([coarser] if coarser else [])))
            found[name] = Found(Estimate.exact(value) if same else Estimate.unknown(value), at)
            continue
        kind = next((kind for kind in shares if name in kind), None)
        size = max(abs(own[other][0]) for other in kind if other in apart) if kind is not None else abs(value)
        bar = _MARGIN * max(apart[name], shares[kind] * size if kind is not None else 0.0) + unseen * size
        found[name] = Found(Estimate.within(value, bar if bar > 0 or not value else unseen * abs(value)), at)
    weight = case.weight
    for factor, force in (("lift_off_factor", "rope_force_max"), ("bridge_factor", "bridge_force_max")):
        found[factor] = over(found[force], weight)
    if not isinstance(scene, Lift):
        found["rope_force_share"] = over(found["rope_force_min"], weight)
    return _named_by_scene(scene, found)


def _apart(own: Readings, others: Sequence[Readings]) -> dict[str, float]:
    """Largest difference of each load from those of other runs, where all of them know it."""
    apart: dict[str, float] = {}
    for name, (value, _) in own.items():
        differences = [abs(value - other[name][0]) for other in others if math.isfinite(other[name][0])]
        if math.isfinite(value) and len(differences) == len(others):
            apart[name] = max(differences, default=0.0)
    return apart


def _named_by_scene(scene: Moving, found: dict[str, Found]) -> dict[str, Found]:
    """The factor on the weight goes by the name of what happens."""
    factor = found.pop("lift_off_factor")
    if isinstance(scene, Lift):
        found["lift_off_factor"] = factor
    elif isinstance(scene, Release):
        found["release_factor"] = _over_itself(found)
    elif isinstance(scene, Start):
        found["start_factor"] = factor
    elif scene.type == "lower_brake" or scene.direction == "down":
        found["lowering_brake_factor"] = factor
    else:
        found["stop_factor"] = factor
    return found


def _over_itself(found: dict[str, Found]) -> Found:
    """The smallest force in the rope over the weight before."""
    return found["rope_force_share"]


def _slowly(found: dict[str, Found], case: Case) -> dict[str, Found]:
    """Loads of a release whose slowness nobody knows: between those of a quick one and of one without any swing."""
    swung = {}
    for name, one in found.items():
        still = case.left_weight / (1.0 if "_force_m" in name else case.weight)
        low, high = min(one.estimate.low, still), max(one.estimate.high, still)
        swung[name] = Found(Estimate((low + high) / 2, low, high, one.estimate.numerical, (high - low) / 2), one.at)
    return swung


def _with_a_hook(found: dict[str, Found], case: Case) -> dict[str, Found]:
    """Loads of a release of everything, which leaves a hook of our own: its weight, swinging, is in doubt."""
    doubt = {}
    for name, one in found.items():
        size = 2 * case.left_weight / (1.0 if "_force_m" in name else case.weight)
        doubt[name] = Found(one.estimate.widened(Interval(-size, size)), one.at)
    return doubt


def _share(own: Readings, apart: dict[str, float], kind: frozenset[str]) -> float:
    """Largest difference of loads of one kind, over the largest of them."""
    size = max((abs(own[name][0]) for name in kind if name in apart), default=0.0)
    return max((apart[name] for name in kind if name in apart), default=0.0) / size if size else 0.0


def spent(course: Course) -> float:
    """Seconds of a run by its panels and crossings: a load that jumps on its rope has hundreds."""
    record = course.record
    return 1e-2 + PANEL * record.work


def _lowest_frequency(case: Case) -> float:
    """Of the train with one flank of its gear touching: under a load the other does not [rad/s]."""
    springs = tuple(one for one in case.train.springs if one.name != FLANK)
    return float(frequencies(replace(case.train, springs=springs)).min(initial=math.inf))


def result(scene: Moving, case: Case, level: int) -> Result:
    """Loads, findings and histories of a case at a refinement."""
    tolerance = TOLERANCES[level]
    course = play(case, tolerance)
    for _ in range(_LONGER if case.holds else 0):  # a load that jumps on its rope slips through the brake at each catch
        if math.isfinite(stopped(course)):
            break
        case = replace(case, window=2 * case.window)
        course = play(case, tolerance)
    while isinstance(scene, Lift) and (longer := until_lifted(case, lift_off_time(course))):
        if math.isfinite(first_event(course, DRIVE, "started")):  # the limiter ends the lift
            break
        case = replace(case, window=longer)
        course = play(case, tolerance)
    others = tuple(play(case, tolerance, refined) for refined in (_COMPARED if case.smooth else _COMPARED[:1]))
    coarser = play(replace(case.coarser, window=case.window), tolerance) if case.coarser else None
    found = loads(scene, course, others, coarser)
    found = ringing_on(case, course.system, course.record, found)
    if case.left_weight <= LEAST_LEFT * case.weight:
        found = _with_a_hook(found, case)
    if isinstance(scene, Release) and scene.manner == "slow":
        found = _slowly(found, case)
    if isinstance(scene, Lift) and outlasts(case) and not math.isfinite(lift_off_time(course)):
        found = {name: Found(Estimate.unknown(one.estimate.value), one.at) for name, one in found.items()}
    found["natural_frequency"] = Found(Estimate.exact(_lowest_frequency(case)))
    findings = list(remarks(scene, course))
    closes = 10 * tolerance if case.smooth else _CLOSES
    residual = course.ledger.residual
    if residual > closes:
        findings.append(
            Finding(
                "NUM101",
                f"scene `{scene.label}`: the energy balance has a residual of {residual:.1e},"
                f" more than {closes:.0e}; the"
                " numbers are not reliable",
            )
        )
        found = {name: Found(Estimate.unknown(one.estimate.value), one.at) for name, one in found.items()}
    found["energy_residual"] = Found(Estimate.exact(residual))
    return Result(
        found,
        work=sum(one.record.steps for one in (course, *others)),
        spent=sum(spent(one) for one in (course, *others)),
        window=(0.0, course.record.time),
        health={"energy_residual": residual, "steps": float(course.record.steps)},
        findings=tuple(findings),
        events=tuple(Event(float(e.time), e.element, e.before, e.after) for e in course.record.events),
        histories=lambda: histories(scene, case, tolerance),
        failures=tuple(failures(scene, course)),
    )


def until_lifted(case: Case, lifted: float) -> float:
    """Longer window of a lift that ends before the load has left the ground, or before it has oscillated after that;
    0 where the window is long enough [s]."""
    if case.weak or case.window >= LONGEST:
        return 0.0
    if math.isinf(lifted):
        return min(2 * case.window, LONGEST)
    needed = min(lifted + case.ringing, LONGEST)
    return needed if needed > case.window * (1 + 1e-9) else 0.0


def histories(scene: Moving, case: Case, tolerance: float) -> Mapping[str, History]:
    """Forces, torque and ways over time, from a run that keeps them."""
    course = play(case, tolerance, keep=True)
    samples = course.record.samples
    assert samples is not None
    times = np.maximum.accumulate(np.concatenate(samples.times)).tolist()  # an event may move by a rounding
    values = np.concatenate(samples.values)
    signals = {"rope_force_max": (units.FORCE, "link", case.named("link", ROPE))}
    signals["bridge_force_max"] = (units.FORCE, "link", case.named("link", STRUCTURE))
    signals["lift_off_speed"] = (units.SPEED, "speed", case.named("body", HOOK))
    signals["backlash_torque_peak"] = (units.TORQUE, "link", case.named("link", SHAFT))
    return {
        name: History(quantity, times, values[:, course.system.watched[what, index]].tolist())
        for name, (quantity, what, index) in signals.items()
        if index is not None
    }
