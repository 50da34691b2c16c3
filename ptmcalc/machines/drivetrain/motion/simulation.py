"""A scene played through, and the loads read from it."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import chain

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.memory import remembered
from ptmcalc.contract.result import Event, Finding, History, of
from ptmcalc.machines.drivetrain.links import loads as link_loads
from ptmcalc.machines.drivetrain.machine.model import REACHED, Case, Part, rigid
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain, TrainScene
from ptmcalc.machines.drivetrain.motion import announced
from ptmcalc.machines.drivetrain.motion import loads as motion_loads
from ptmcalc.machines.drivetrain.motion.course import Course, is_smooth
from ptmcalc.machines.drivetrain.motors import loads as motor_loads
from ptmcalc.numerics.piecewise import JAMMED, march
from ptmcalc.numerics.record import PANEL
from ptmcalc.numerics.train import price
from ptmcalc.numerics.train.ledger import ledger
from ptmcalc.numerics.train.modes import frequencies
from ptmcalc.numerics.train.parts import Grip
from ptmcalc.numerics.train.state import NO_FRICTION
from ptmcalc.numerics.train.system import TrainSystem

_CLOSES = 1e-9
"""Residual of the energy balance of a motion without a smooth torque curve [1] above which NUM101 is reported; a
numerical choice. A larger value accepts wrong runs; a smaller one refuses rounding."""
_LONGEST, _FIRST = 4096.0, 0.25
"""Windows of the rigid run that finds the time of a start or stop [s]; numerical choices. `_FIRST`: the first one; each
further is 4 times longer. `_LONGEST`: the last one; without an end 1/64 of it is the time. A longer last window finds
slower machines and takes longer."""
_CHATTER, _LAST_PART = 60, 0.05
"""Chatter (NUM106); engineering choices. `_LAST_PART`: last part of the scene that counts [1]. `_CHATTER`: changes of
state in it that are still accepted. A larger number reports less chatter, a smaller one normal friction."""
_PERIODS = 10
"""Periods of the lowest natural frequency in the window after the rigid start or stop [1]. A numerical choice: more
periods take longer, fewer leave more of the vibration after the window."""
_EVENTS, _ROUNDS = 5e-3, 3.0
"""Cost of a run. `_EVENTS`: predicted seconds of the events of a backlash. `_ROUNDS`: cost of a smooth torque curve
relative to a linear motion [1]. Rates of a measurement of which no record is kept; wrong values change the order of the
solvers and the length of windows."""
BESIDE = 0.3
"""Predicted seconds of a rigid run up to which it is made for criteria and later ends. A numerical choice: a larger
value bounds more loads and takes longer."""
LONG = 5.0
"""Predicted seconds of a run up to which its window is made longer. A numerical choice: a larger value follows later
events and takes longer."""
MOST_BESIDE = BESIDE / PANEL
"""Panels at which such a run is given up that was predicted to take less."""
_LEAST_WORK, _MOST_TIMES = 2e5, 30.0
"""Limit of the work of a run; numerical choices. `_LEAST_WORK`: panels that any run may take. `_MOST_TIMES`: panels
beyond, relative to those predicted [1]. Larger values allow long runs; smaller ones refuse runs that the prediction
underestimates."""
_DUST = 1e-11
"""Reading relative to the largest of its kind [1] that is set to 0 as rounding. A numerical choice above the resolution
2e-16 of the floating point. A larger value suppresses real small loads; a smaller one reports rounding as loads."""


def run(
    case: Case, end: float, tolerance: float, refined: float = 1.0, *, keep: bool = False, most_work: float = math.inf
) -> Course:
    """One run of a case to a time.

    Raises:
        NumericsError: it cannot be made, or takes more than `most_work` panels.
    """
    system = TrainSystem(case.train)
    start = system.start()
    mode, state = start
    record = march(
        system,
        mode,
        state,
        end,
        tolerance=tolerance,
        refined=refined,
        keep=keep,
        most_work=most_work,
        unsought=system.unsought,
    )
    return Course(case, system, record, ledger(system, start, record))


# -- how long -------------------------------------------------------------------------------------------------------


def window(scene: TrainScene, case: Case) -> float:
    """How long a scene is computed [s].

    The `duration` of the file; else the usual window, and after the last time that the file announces once more the
    usual window, where that is computed within `LONG` seconds.
    """
    if scene.duration is not None:
        return scene.duration
    usual = usual_window(scene, case)
    last = max(announced.times(case).values(), default=0.0)
    if last + _ringing(case) <= usual or seconds(case, last + usual) > LONG:
        return usual
    return last + usual


def usual_window(scene: TrainScene, case: Case) -> float:
    """Time in which a start or stop takes place and its last oscillation reaches its peak [s].

    1.2 times the rigid train's start or stop and ten periods of the lowest natural frequency, times `window_factor`.
    """
    return getattr(scene, "window_factor", 1.0) * (1.2 * _rigid_time_of(_Identity(case)) + _ringing(case))


def _ringing(case: Case) -> float:
    """Ten periods of the lowest natural frequency [s]."""
    lowest = float(frequencies(case.train).min(initial=math.inf))
    return _PERIODS * 2 * math.pi / lowest if math.isfinite(lowest) else 0.0


@remembered(64)
def _rigid_time_of(key: "_Identity") -> float:
    case, end, main = rigid(key.case), _FIRST, math.inf
    while end <= _LONGEST:
        try:
            course = run(case, end, 1e-6, most_work=most_work(case, end))
        except NumericsError:  # the solver that meets it says so; a plan only needs some time
            break
        found, main = settled(course), ended(course)
        if math.isfinite(found):
            return max(found, 1e-3)
        end *= 4
    # a part that never comes to its end is followed without its links (`ending`)
    return max(main, 1e-3) if math.isfinite(main) else _LONGEST / 64


@dataclass(frozen=True, slots=True)
class _Identity:
    case: Case

    def __hash__(self) -> int:
        return id(self.case.train)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Identity) and self.case is other.case


def ended(course: Course) -> float:
    """When the start or stop of the main part was over [s]; infinite where it was not."""
    return over(course, course.case.parts[0])


def settled(course: Course) -> float:
    """When the start or stop of all parts was over and all clutches of a start were locked [s]; infinite before."""
    parts = [over(course, part) for part in course.case.parts]
    return max([*parts, *(locked(course, grip) for grip in course.case.clutches)])


def over(course: Course, part: Part) -> float:
    """When the start or stop of a part was over [s]; infinite where it was not."""
    if course.case.stopping:
        return stopped(course, part.body)
    times = (event.time for event in course.record.events if event.element == part.event and event.after == "started")
    return float(next(times, math.inf))


def stopped(course: Course, body: int) -> float:
    """When a body came to rest until the end; 0 where it never moved, infinite where it still does.

    What only a clutch holds is at rest while the clutch is locked and its other side is at rest.
    """
    system = course.system
    group = system.groups.of[body]
    turning = course.record.mode.turning[group]
    if turning == NO_FRICTION:
        return _stopped_by_clutch(course, group)
    if turning != 0:
        return math.inf
    return _last_event(course, system.friction_name(group), "at rest")


def _stopped_by_clutch(course: Course, group: int) -> float:
    of = course.system.groups.of
    for index, slip in zip(course.system.clutches, course.record.mode.clutches, strict=True):
        grip = course.case.train.grips[index]
        assert grip.second is not None
        sides = (of[grip.first], of[grip.second])
        if group in sides and slip == 0:
            other = sides[0] if sides[1] == group else sides[1]
            if course.record.mode.turning[other] == 0:
                rest = _last_event(course, course.system.friction_name(other), "at rest")
                return max(_last_event(course, grip.name, "locked"), rest)
    return math.inf


def locked(course: Course, grip: Grip) -> float:
    """When a clutch locked until the end [s]; 0 where it never slipped, infinite where it still does."""
    for index, slip in zip(course.system.clutches, course.record.mode.clutches, strict=True):
        if course.case.train.grips[index] is grip:
            return math.inf if slip else _last_event(course, grip.name, "locked")
    return 0.0


def _last_event(course: Course, element: str, after: str) -> float:
    times = [event.time for event in course.record.events if event.element == element and event.after == after]
    return float(times[-1]) if times else 0.0


def slip(course: Course, grip: Grip) -> float:
    """Slip speed of a clutch at the end, relative to the speed of its faster side; 0 where it is locked."""
    assert grip.second is not None
    one, two = speeds(course, grip.first)[0], speeds(course, grip.second)[0]
    return abs(one - two) / max(abs(one), abs(two)) if math.isinf(locked(course, grip)) else 0.0


# -- what is read ---------------------------------------------------------------------------------------------------

Readings = dict[str, tuple[float, float | None]]
"""Value of each load, and the time at which it occurs where there is one."""


def readings(spec: Drivetrain, course: Course) -> Readings:
    """The loads of a run."""
    record, case = course.record, course.case
    found: Readings = {}
    for name in (*spec.links, *spec.gears):
        index = course.torque(name)
        if index is not None:
            found[of("torque_peak", name)] = course.largest(index)
    for name in spec.inertias:
        index, place = course.index("speed", name), course.index("position", name)
        assert index is not None
        assert place is not None
        top, bottom = record.top, record.bottom
        found[of("speed_max", name)] = float(top.values[index]), float(top.at[index])
        found[of("speed_min", name)] = float(bottom.values[index]), float(bottom.at[index])
        found[of("speed_end", name)] = float(record.last[index]), None
        found[of("angle_end", name)] = float(record.last[place]), None
    for name in spec.motors:
        index = course.index("drive", name)
        if index is not None:
            found[of("motor_torque_peak", name)] = course.largest(index)
            number = [drive.name for drive in case.train.drives].index(name)
            square = record.integrals[list(course.system.works).index(("square", number))]
            time = spec.checks.cycle_time or record.time
            found[of("motor_torque_rms", name)] = math.sqrt(max(float(square), 0.0) / time), None
    if case.stopping:
        found["stop_time"] = ended(course), None
        place = course.index("position", case.bodies[case.main])
        assert place is not None
        moved = abs(float(record.last[place] - record.first[place]))
        rests = math.isfinite(found["stop_time"][0])
        found["stop_angle"] = moved if rests else math.inf, None
        found["stop_speed_share"] = 0.0 if rests else share(*speeds(course, case.main)), None
    elif case.until is not None:
        found["start_time"] = ended(course), None
        found["start_share"] = reached_share(course, case.parts[0]), None
    for part in case.others:
        time = over(course, part)
        if case.stopping:
            left = 0.0 if math.isfinite(time) else share_of_fastest(course, part.body)
            found[of("part_stop_time", case.bodies[part.body])] = time, None
            found[of("part_stop_speed_share", case.bodies[part.body])] = left, None
        else:
            found[of("part_start_time", case.bodies[part.body])] = time, None
            found[of("part_start_share", case.bodies[part.body])] = reached_share(course, part), None
    for grip in case.clutches:
        found[of("clutch_slip", grip.name)] = slip(course, grip), None
    return {name: _without_dust(name, found) for name in found}


def speeds(course: Course, body: int) -> tuple[float, float]:
    """Speed of a body at the end and at the beginning of a run [rad/s or m/s]."""
    index = course.index("speed", course.case.bodies[body])
    assert index is not None
    return float(course.record.last[index]), float(course.record.first[index])


def share(speed: float, of: float) -> float:
    """A speed relative to another one; infinite where that is 0."""
    return abs(speed / of) if of else math.inf


def share_of_fastest(course: Course, body: int) -> float:
    """Speed of a body at the end relative to its largest speed."""
    index = course.index("speed", course.case.bodies[body])
    assert index is not None
    return share(float(course.record.last[index]), course.largest(index)[0])


def reached_share(course: Course, part: Part) -> float:
    """Largest speed of a part towards the one that ends its start, relative to it; 1 where it is reached."""
    if math.isfinite(over(course, part)):
        return 1.0
    index, until = course.index("speed", course.case.bodies[part.body]), part.until
    assert index is not None
    assert until is not None
    extreme = course.record.top if until > 0 else course.record.bottom
    return min(max(float(extreme.values[index]) / until, 0.0), 1.0)


def _without_dust(name: str, found: Readings) -> tuple[float, float | None]:
    """A reading, 0 where it is no more than rounding beside the largest one of its kind."""
    value, time = found[name]
    if "[" not in name:
        return value, time
    alike = [abs(one) for other, (one, _) in found.items() if part_of(other) == part_of(name)]
    return (0.0 if math.isfinite(value) and abs(value) <= _DUST * max(alike) else value), time


def part_of(name: str) -> tuple[str, str]:
    """What is read and of which part: the largest, smallest and last speed of a body are alike."""
    family, _, part = name.partition("[")
    return family.removesuffix("_max").removesuffix("_min").removesuffix("_end"), part


def untrusted(spec: Drivetrain, scene: TrainScene, course: Course, tolerance: float) -> Finding | None:
    """What there is to say of a run whose energy ledger does not close."""
    closes = 10 * tolerance if course.smooth else _CLOSES
    if course.ledger.residual <= closes:
        return None
    return Finding(
        "NUM101",
        f"scene `{scene.label}`: the energy balance has a residual of {course.ledger.residual:.1e},"
        f" more than {closes:.0e};"
        " the numbers are not reliable",
    )


def remarks(scene: TrainScene, course: Course) -> Iterator[Finding]:
    """What happened on the way that a reader must know."""
    for event in course.record.events:
        if event.after == JAMMED:
            yield Finding(
                "NUM104",
                f"scene `{scene.label}`: {event.element} locks at {event.time:.4g} s: a self-locking gear cannot be"
                " braked from its motor's side against this load inertia; an immediate stop is assumed",
                ("gears", event.element),
            )
    for name, times in chattering(course).items():
        yield Finding(
            "NUM106",
            f"scene `{scene.label}`: {name} changes its state {times} times in the last part of the scene",
        )


def chattering(course: Course) -> dict[str, int]:
    """Parts that still change their state often at the end of a run, and how often in the last part of it."""
    late = (1 - _LAST_PART) * course.record.time
    counted: dict[str, int] = {}
    for event in course.record.events:
        if event.time >= late:
            counted[event.element] = counted.get(event.element, 0) + 1
    return {name: times for name, times in counted.items() if times > _CHATTER}


def events(course: Course) -> tuple[Event, ...]:
    """The events of a run, for the report."""
    bodies = {part.event: course.case.bodies[part.body] for part in course.case.parts}
    return tuple(
        Event(float(one.time), bodies[one.element], "starting", "at speed")
        if one.element.startswith(REACHED)
        else Event(float(one.time), one.element, one.before, one.after)
        for one in course.record.events
    )


def histories(spec: Drivetrain, case: Case, end: float, tolerance: float) -> Mapping[str, History]:
    """Torques, speeds and angles over time, from a run that keeps them."""
    course = run(case, end, tolerance, keep=True, most_work=most_work(case, end))
    samples = course.record.samples
    assert samples is not None
    times = np.maximum.accumulate(np.concatenate(samples.times)).tolist()  # an event may move by a rounding
    values = np.concatenate(samples.values)
    known = chain(link_loads.parts(spec), motion_loads.parts(spec), motor_loads.parts(spec))
    quantities = {info.name: info.quantity for info in known}
    signals = {of("torque_peak", name): course.torque(name) for name in (*spec.links, *spec.gears)}
    signals |= {of("speed_max", name): course.index("speed", name) for name in spec.inertias}
    signals |= {of("angle_end", name): course.index("position", name) for name in spec.inertias}
    signals |= {of("motor_torque_peak", name): course.index("drive", name) for name in spec.motors}
    return {
        name: History(quantities[name], times, values[:, index].tolist())
        for name, index in signals.items()
        if index is not None
    }


def most_work(case: Case, end: float) -> float:
    """Panels after which a run is given up: many times what was predicted, so that no run takes far longer."""
    return _LEAST_WORK + _MOST_TIMES * seconds(case, end) / PANEL


def seconds(case: Case, end: float) -> float:
    """Predicted seconds of one run and of that it is compared with: what rings, and a few events for every play."""
    smooth = is_smooth(case)
    ringing = price.RADIAN * price.radians(case.train, end) if smooth else price.linear(case.train, end)
    plays = 1 + sum(spring.play > 0 for spring in case.train.springs)
    return 2 * (_ROUNDS if smooth else 1.0) * (ringing + _EVENTS * plays)
