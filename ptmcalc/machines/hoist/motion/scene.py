"""A scene of a hoist played through, and the loads read from it with their bars."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.result import Event, Failure, Finding, Found, History, Result
from ptmcalc.machines.hoist.motion.after_window import over, ringing_on
from ptmcalc.machines.hoist.motion.train import (
    BRAKE,
    DRIVE,
    FLANK,
    GEARBOX,
    GROUND,
    HOOK,
    LEAST_LEFT,
    LOAD,
    LONGEST,
    MOTOR,
    ROPE,
    SHAFT,
    STRUCTURE,
    TOLERANCES,
    Case,
    Moving,
)
from ptmcalc.machines.hoist.spec import Lift, Release, Start
from ptmcalc.numerics.flow import FADED
from ptmcalc.numerics.piecewise import JAMMED, march
from ptmcalc.numerics.record import LONG, PANEL, Record, most_work
from ptmcalc.numerics.train import price
from ptmcalc.numerics.train.ledger import Ledger, ledger
from ptmcalc.numerics.train.modes import frequencies
from ptmcalc.numerics.train.system import TrainSystem

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
_MOST_EVENTS = 2000
"""Events after which a run ends because of chatter; a numerical choice. Without damping chatter never ends. More take
longer; fewer refuse runs with many real events."""
_LONGER = 4
"""Doublings of the window of a stop that is not finished; a numerical choice. The last window is 16 times the first.
More follow late stops and take longer."""
_FORCES = frozenset({"rope_force_max", "rope_force_min", "bridge_force_max", "bridge_force_min"})
_LENGTHS = frozenset({"stop_distance", "stop_distance_lowering"})


@dataclass(frozen=True, slots=True)
class Course:
    """One run of a case."""

    case: Case
    system: TrainSystem
    record: Record
    ledger: Ledger

    def top(self, what: str, index: int) -> tuple[float, float]:
        """Largest value of a watched signal and its time."""
        place = self.system.watched[what, index]
        return float(self.record.top.values[place]), float(self.record.top.at[place])

    def bottom(self, what: str, index: int) -> tuple[float, float]:
        """Smallest value of a watched signal and its time."""
        place = self.system.watched[what, index]
        return float(self.record.bottom.values[place]), float(self.record.bottom.at[place])

    def largest(self, what: str, index: int) -> tuple[float, float]:
        """Largest magnitude of a watched signal and its time."""
        high, low = self.top(what, index), self.bottom(what, index)
        return high if high[0] >= -low[0] else (-low[0], low[1])


def play(case: Case, tolerance: float, refined: float = 1.0, *, end: float = 0.0, keep: bool = False) -> Course:
    """One run of a case, over its window or to another end."""
    system = TrainSystem(case.train)
    start = system.start()
    end, most = end or case.window, most_work(cost(case, TOLERANCES.index(tolerance)))
    record = march(
        system,
        *start,
        end,
        tolerance=tolerance,
        refined=refined,
        keep=keep,
        most_events=_MOST_EVENTS,
        most_work=most,
        most_looks=most / LONG,
        unsought=system.unsought,
    )
    return Course(case, system, record, ledger(system, start, record))


# -- what is read ---------------------------------------------------------------------------------------------------

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


def first_event(course: Course, element: str, after: str) -> float:
    """When an element first came to a state; infinite where it never did [s]."""
    times = (event.time for event in course.record.events if event.element == element and event.after == after)
    return float(next(times, math.inf))


def lift_off_time(course: Course) -> float:
    """When the load left the ground; infinite where it never did [s]."""
    return first_event(course, GROUND, "open")


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


def _braked_group(course: Course) -> int:
    """What turns with the shaft of the brake."""
    brake = course.case.named("grip", BRAKE)
    return course.system.groups.of[course.case.train.grips[brake].first if brake is not None else 0]


def stopped(course: Course) -> float:
    """When the shaft of the brake came to rest for good; infinite where it still turns [s]."""
    group = _braked_group(course)
    if course.record.mode.turning[group] != 0:
        return math.inf
    name = course.system.friction_name(group)
    times = [event.time for event in course.record.events if event.element == name and event.after == "at rest"]
    return float(times[-1]) if times else 0.0


def first_rest(course: Course) -> float:
    """When the shaft of the brake first came to rest; a swinging load may pull it through once more [s]. A gear that
    jams stops both its shafts."""
    if not any(body.speed for body in course.case.train.bodies):
        return 0.0
    name = course.system.friction_name(_braked_group(course))
    return min(first_event(course, name, "at rest"), first_event(course, GEARBOX, JAMMED))


def _of_the_stop(course: Course) -> Readings:
    load = course.case.named("body", LOAD)
    assert load is not None
    time = first_rest(course) if math.isfinite(stopped(course)) else math.inf
    edge = course.bottom("position", load) if course.case.lowers else course.top("position", load)
    way = (abs(edge[0]), edge[1]) if math.isfinite(time) else (math.inf, None)
    return {"stop_time": (time, None), "stop_distance_lowering" if course.case.lowers else "stop_distance": way}


# -- bars -----------------------------------------------------------------------------------------------------------


def loads(scene: Moving, course: Course, others: tuple[Course, ...]) -> dict[str, Found]:
    """The loads of a run, with bars from others that divide time otherwise."""
    return with_bars(scene, course.case, readings(scene, course), [readings(scene, other) for other in others])


def with_bars(
    scene: Moving, case: Case, own: Readings, compared: Sequence[Readings], unseen: float = _UNSEEN
) -> dict[str, Found]:
    """Loads with bars from those of runs that divide time otherwise.

        bar = 3 max |x - x'| over the other runs, and over the loads of one kind as shares of the largest of them

    Without a nonlinear torque all runs are exact and what differs is rounding; with one, stretches 0.7 and 0.85 times
    as long have errors 25 and 4 times as small or as large (the ninth power), so two runs differ by nearly the larger
    error. Added is what reading a signal may miss.
    """
    apart: dict[str, float] = {}
    for name, (value, _) in own.items():
        differences = [abs(value - other[name][0]) for other in compared if math.isfinite(other[name][0])]
        if math.isfinite(value) and len(differences) == len(compared):
            apart[name] = max(differences, default=0.0)
    shares = {kind: _share(own, apart, kind) for kind in (_FORCES, _LENGTHS)}
    found = {}
    for name, (value, time) in own.items():
        at = {"time": time} if time is not None else {}
        if name not in apart:
            same = all(other[name][0] == value for other in compared)
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


def cost(case: Case, level: int) -> float:
    """Seconds predicted of a run and those it is compared with: what rings, as long as it has to be looked at, and a
    few events."""
    if case.smooth:
        ringing = price.RADIAN * price.radians(case.train, case.window)
        return 4e-3 + 2 * (ringing + 5e-3) * (1 + level / 2)
    return 4e-3 + 2 * (price.linear(case.train, case.window) + 5e-3)


def spent(course: Course) -> float:
    """Seconds of a run by its panels and crossings: a load that jumps on its rope has hundreds."""
    record = course.record
    return 1e-2 + PANEL * record.work


# -- a whole solver run ---------------------------------------------------------------------------------------------


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
    found = loads(scene, course, others)
    found = ringing_on(case, course.system, course.record, found)
    if case.left_weight <= LEAST_LEFT * case.weight:
        found = _with_a_hook(found, case)
    if isinstance(scene, Release) and scene.manner == "slow":
        found = _slowly(found, case)
    if isinstance(scene, Lift) and outlasts(case) and not math.isfinite(lift_off_time(course)):
        found = {name: Found(Estimate.unknown(one.estimate.value), one.at) for name, one in found.items()}
    found["natural_frequency"] = Found(Estimate.exact(_lowest_frequency(case)))
    findings = list(_remarks(scene, course))
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
        failures=tuple(_failures(scene, course)),
    )


def _remarks(scene: Moving, course: Course) -> list[Finding]:
    """What happened on the way that a reader must know."""
    said = []
    label, case = scene.label, course.case
    if isinstance(scene, Lift) and not math.isfinite(lift_off_time(course)):
        said += not_seen(scene, case)
    time = first_event(course, DRIVE, "started")
    if math.isfinite(time):
        said.append(tripped(scene, time))
    said += [
        Finding(
            "NUM104",
            f"scene `{label}`: {event.element} locks at {event.time:.4g} s: a self-locking gear cannot be braked from"
            " its motor's side against this load inertia; an immediate stop is assumed",
            ("gearbox",),
        )
        for event in course.record.events
        if event.after == JAMMED
    ]
    return said


def _failures(scene: Moving, course: Course) -> list[Failure]:
    """What the run found to fail: a motor that stalls or lowers the load it lifts, a brake that does not hold it."""
    case, found = course.case, []
    trips = math.isfinite(first_event(course, DRIVE, "started"))
    if isinstance(scene, Lift):
        rope = case.named("link", ROPE)
        assert rope is not None
        lifted = math.isfinite(lift_off_time(course))
        found += tripped_early(scene) if trips and not lifted else stalls(case, lifted, course.top("link", rope))
    if isinstance(scene, Start) and not case.lowers and _sinks(course):
        reason = "the motor stalls under the suspended load: the load descends and drives the motor"
        found.append(Failure("HST114", reason, _TORQUE, "a stronger motor, a larger gear ratio, or less load"))
    if case.stops and math.isinf(stopped(course)):
        found += not_held(case)
    if isinstance(scene, Release) and scene.manner == "quick":
        found += gone_slack(first_event(course, ROPE, "open"))
    return found


def gone_slack(time: float) -> list[Failure]:
    """A rope that goes slack at a time, after a part of the load has come off."""
    if not math.isfinite(time):
        return []
    return [
        Failure(
            "HST126",
            f"the rope goes slack at {time:.3g} s",
            (),
            "release a smaller part of the load, or release it slowly",
        )
    ]


_TORQUE = ("motor",)


def not_held(case: Case) -> list[Failure]:
    """A load that its brake does not hold, or not for long."""
    way = units.show(case.drop, units.SPAN)
    reason = f"the brake does not hold the load: it descends to the ground, or to the end of the rope, by up to {way}"
    if case.holds:
        reason = "the load rebounds on its rope, and the brake slips each time the rope becomes taut"
    return [Failure(code, reason, ("brake", "torque"), "a stronger brake") for code in ("HST118", "HST122")]


def tripped(scene: Moving, time: float) -> Finding:
    """A limiter that has tripped: it works as it should."""
    return Finding("NUM113", f"scene `{scene.label}`: the limiter trips at {time:.3g} s and stops the hoist")


def tripped_early(scene: Moving) -> list[Failure]:
    """A limiter that trips before the load leaves the ground."""
    reason, hint = "the limiter trips before the load leaves the ground", "a larger factor or delay of the limiter"
    return [Failure("HST121", reason, ("limiter", "factor"), hint)]


def until_lifted(case: Case, lifted: float) -> float:
    """Longer window of a lift that ends before the load has left the ground, or before it has oscillated after that;
    0 where the window is long enough [s]."""
    if case.weak or case.window >= LONGEST:
        return 0.0
    if math.isinf(lifted):
        return min(2 * case.window, LONGEST)
    needed = min(lifted + case.ringing, LONGEST)
    return needed if needed > case.window * (1 + 1e-9) else 0.0


def outlasts(case: Case) -> bool:
    """Whether a lift by a drive that is strong enough may take longer than anything is looked at."""
    return case.window >= LONGEST and not case.weak


def not_seen(scene: Lift, case: Case) -> list[Finding]:
    """A lift that takes longer than is computed."""
    if not outlasts(case):
        return []
    reason = f"the load is still on the ground at the end of the longest window, {case.window:.3g} s"
    return [Finding("NUM103", f"scene `{scene.label}`: {reason}", ("speed",), "increase the speed")]


def stalls(case: Case, lifted: bool, largest: tuple[float, float | None]) -> list[Failure]:
    """A drive that stalls in a lift, with its phase; `largest` is the largest force of the rope and its time."""
    if (lifted and not case.weak) or (not lifted and outlasts(case)):
        return []
    force, time = largest[0], largest[1] or 0.0
    phase = "taking up the slack" if force <= 0 else "tensioning the rope"
    if lifted:
        phase = "holding the load, which only its oscillation lifted off the ground"
    reached = units.show(force, units.FORCE)
    weight = units.show(case.weight, units.FORCE)
    reason = (
        f"the motor stalls while {phase}: the rope force reaches {reached} at {time:.3g} s, the load weighs {weight}"
    )
    return [Failure("HST121", reason, _TORQUE, "a stronger motor, a larger gear ratio, or less load")]


def _sinks(course: Course) -> bool:
    """Whether the drum of a start upward turns down in the end."""
    motor = course.case.named("body", MOTOR)
    assert motor is not None
    return float(course.record.last[course.system.watched["speed", motor]]) < 0


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
