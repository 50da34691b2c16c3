"""Starts and stops that are not over at the end of their window: never, or later."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from ptmcalc.base import units
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.result import Failure, Found, Result, family, of
from ptmcalc.machines.drivetrain import announced, bars, left_behind, motion
from ptmcalc.machines.drivetrain.announced import Ahead
from ptmcalc.machines.drivetrain.model import Case, case_of, rigid
from ptmcalc.machines.drivetrain.spec import Drivetrain, Run, TrainScene

_PROGRESS = 1e-3
"""Least share of what is missing that a start or a stop that ends gains while its time doubles: an induction motor
next to its synchronous speed still gains some per cent of it."""
_FADED = 20.0
"""Time constants after which a decay is below 1e-8 of its beginning."""
_TOLERANCE = 1e-6
_OF_SPEEDS = 1e-9
"""Tolerance of the rigid train whose growing speeds are looked at: less than the bars of these speeds."""


@dataclass(frozen=True, slots=True)
class Ending:
    """What is known of a start or stop that is not over at the end of the window."""

    failures: tuple[Failure, ...] = ()
    loads: dict[str, Found] = field(default_factory=dict)
    state: str = ""
    work: int = 0


_LOOKS = 12
"""Times that the rigid train is looked at, over twice the time each: 2048 windows."""
_LONGER = 1.2
"""Time in which an elastic train is taken to end its start or stop, over that of the rigid one, as of its window."""
_OF_THE_END = frozenset({"start_time", "start_share", "stop_time", "stop_angle", "stop_speed_share"})
"""Loads that are about the end of a start or stop, whenever it is."""
DOUBLINGS = 2
"""Times that a window is doubled in which a torque has its peak in the second half."""
_EXTENSIONS = 3
"""Times that a window is extended to what the file announces for later."""
_SECONDS = 5.0
"""Predicted seconds of a run up to which a window is doubled."""
_CREEP, _MORE = 0.01, 4.0
"""Growth of a peak, relative to it, up to which undamped modes that meet later are the reason; what later windows may
add is then at most some times the last growth, as the peak of a sum of sines grows ever slower."""
_PEAKS = frozenset({"torque_peak", "motor_torque_peak"})
_SPEEDS = frozenset({"speed_max", "speed_min"})

_OF_THE_WINDOW = frozenset({"motor_torque_rms", "speed_end", "angle_end", "torque_steady"})
"""Loads of the end or the mean of the scene: of a start or stop without `duration` they would be those of the window
that happens to be computed, but for a part at rest."""


def steady_runs(
    spec: Drivetrain, scene: TrainScene, case: Case, end: float, tolerance: float, doublings: int = DOUBLINGS
) -> tuple[tuple[motion.Course, ...], dict[str, Interval], str]:
    """Runs over a window after which no torque and no speed grows, and what can still change after it.

    A start or stop whose torque peaks lie in the second half of the window, or whose extreme speeds do and grow on as
    those of the rigid train, is computed over twice the time until none grows; a `duration` of the file stays as it is.
    """
    if scene.duration is not None or isinstance(scene, Run):
        return bars.played(case, end, tolerance), {}, ""
    runs, later = _with_what_comes(case, end, tolerance)
    if later is not None:
        unknown = {
            name: _outward(name, math.inf)
            for name in motion.readings(spec, runs[0])
            if name not in ("start_time", "start_share")
        }
        return runs, unknown, f"{later.what} acts after the computed window"
    end = runs[0].record.time
    ahead = _speeds_ahead(spec, scene, runs[0])
    rising = {name for name, (more, size) in ahead.items() if not more < _CREEP * size}
    grown: dict[str, float] = dict.fromkeys(rising, math.inf)
    if rising and not doublings:  # torques that grow with a speed that grows
        peaks = motion.readings(spec, runs[0]).items()
        grown |= {
            name: math.inf for name, (_, at) in peaks if family(name) in _PEAKS and at is not None and at > end / 2
        }
    for _ in range(doublings):
        before = motion.readings(spec, runs[0])
        late = [
            name
            for name, (_, at) in before.items()
            if (name in rising or family(name) in _PEAKS) and at is not None and at > end / 2
        ]
        if not late or motion.seconds(case, 2 * end) > _SECONDS:
            break
        known = bars.loads(spec, *runs)
        end *= 2
        runs = bars.played(case, end, tolerance)
        after = motion.readings(spec, runs[0])
        grown = {name: abs(after[name][0] - before[name][0]) for name in late}
        grown = {name: more for name, more in grown.items() if more > known[name].estimate.bar}
        if not grown:
            break
    last = motion.readings(spec, runs[0])
    beyond = {name: _outward(name, more) for name, (more, _) in ahead.items() if name not in rising}
    beyond |= {
        name: _outward(name, more if more < _CREEP * abs(last[name][0]) else math.inf) for name, more in grown.items()
    }
    restless = motion.chattering(runs[0])
    beyond |= {of("torque_peak", name): Interval(0.0, math.inf) for name in restless if name in spec.links}
    named = [*(name for name in restless if name in spec.links), *sorted(grown)]
    return runs, beyond, f"`{named[0]}` is not steady" if named else ""


def _with_what_comes(case: Case, end: float, tolerance: float) -> tuple[tuple[motion.Course, ...], Ahead | None]:
    """Runs over a window with all in it that the file announces; what comes later where that would take long."""
    coming = announced.over_time(case)
    runs: tuple[motion.Course, ...] = ()
    for _ in range(_EXTENSIONS):
        if runs and coming.until <= end:
            return runs, None
        if coming.until > end and motion.seconds(case, coming.until) > _SECONDS:
            break
        end = max(end, coming.until)
        runs = bars.played(case, end, tolerance)
        coming = announced.over_motion(case, runs[0])
    return runs or bars.played(case, end, tolerance), coming


def _outward(name: str, more: float) -> Interval:
    """What later windows may add to an extreme that has grown by so much in the last one."""
    return Interval(-_MORE * more, 0.0) if family(name) == "speed_min" else Interval(0.0, _MORE * more)


def _speeds_ahead(spec: Drivetrain, scene: TrainScene, course: motion.Course) -> dict[str, tuple[float, float]]:
    """Growth of the extreme speeds of the rigid train while the time doubles, and their size, by the name of the load.

    Those of a run which lie in the second half of its window: a motor above the speed that ends its start goes on to
    the speed of no surplus. The growth is infinite where the rigid train is not computed.
    """
    end = course.record.time
    found = {
        name: (math.inf, abs(value))
        for name, (value, at) in motion.readings(spec, course).items()
        if family(name) in _SPEEDS and at is not None and at > end / 2
    }
    case = rigid(case_of(spec, scene, backlash=False))
    if not found or motion.seconds(case, 2 * end) > motion.BESIDE:
        return found
    try:
        once, twice = (
            motion.run(case, time, _OF_SPEEDS, most_work=motion.most_work(case, time)) for time in (end, 2 * end)
        )
    except NumericsError:
        return found
    before, after = motion.readings(spec, once), motion.readings(spec, twice)
    grown = {name: (abs(after[name][0] - before[name][0]), size) for name, (_, size) in found.items()}
    return {name: (more, size) for name, (more, size) in grown.items() if more > _OF_SPEEDS * size}


def completed(result: Result, spec: Drivetrain, scene: TrainScene, course: motion.Course, tolerance: float) -> Result:
    """A result with what its run tells of the end of the start or stop.

    A motion that gains nothing while its time doubles never ends: the check of it fails. One that goes on is followed
    to its end where that takes no long run and the file gives no `duration`; else it has a time between the window and
    infinity.
    """
    if scene.duration is None:
        stopped = course.case.stopping and math.isfinite(motion.ended(course))
        main = course.case.bodies[course.case.main]
        kept = {of("speed_end", main), of("angle_end", main)} if stopped else set[str]()
        defined = {
            name: one for name, one in result.loads.items() if family(name) not in _OF_THE_WINDOW or name in kept
        }
        result = replace(result, loads=defined)
    for left in (
        left_behind.of_motors(spec, scene, course.record.time, _goes_on),
        left_behind.of_clutches(spec, scene, course),
    ):
        result = replace(result, loads={**result.loads, **left.loads}, failures=(*result.failures, *left.failures))
    found = _ending(spec, scene, course, tolerance)
    if found is None:
        return result
    loads = {name: found.loads.get(name, one) for name, one in result.loads.items()}
    failures = (*result.failures, *found.failures)
    work, state = result.work + found.work, found.state or result.open_end
    return replace(result, loads=loads, failures=failures, open_end=state, work=work)


def _ending(spec: Drivetrain, scene: TrainScene, course: motion.Course, tolerance: float) -> Ending | None:
    case, end = course.case, course.record.time
    if (not case.stopping and case.until is None) or math.isfinite(motion.ended(course)):
        return None
    ahead = _ahead(rigid(case_of(spec, scene, backlash=False)), end)
    if ahead.stuck is not None:
        left = motion.share(*motion.speeds(course, case.main))
        kept = {"stop_speed_share": Found(Estimate(left, 0.0, math.inf, model=math.inf))} if case.stopping else {}
        return Ending((_failure(spec, case, ahead.stuck),), kept)
    if math.isfinite(ahead.over) and scene.duration is None:
        followed = _followed(spec, scene, case, max(2 * end, _LONGER * ahead.over), tolerance)
        if followed is not None:
            return followed
    return Ending(loads=dict(_later(case, course, end)), state=_state(spec, case, motion.speeds(course, case.main)[0]))


@dataclass(frozen=True, slots=True)
class _Ahead:
    """How a rigid train goes on: when it is over, infinite where that is not known, and the speed that it keeps."""

    over: float = math.inf
    stuck: float | None = None


def _ahead(case: Case, end: float) -> _Ahead:
    """How the rigid train goes on after a window, looked at over twice the time again and again.

    From the last change of a torque with time on its motion is that of one speed, which rises or falls for good: where
    it comes no nearer to the one that is wanted it never has it.
    """
    changes = _last_change(case)
    if not math.isfinite(changes):
        return _Ahead()
    end, before = max(end, changes), None
    wanted = 0.0 if case.until is None else case.until
    for look in range(_LOOKS):
        if look > 1 and motion.seconds(case, end) > motion.BESIDE:
            break
        try:
            course = motion.run(case, end, _TOLERANCE, most_work=motion.most_work(case, end))
        except NumericsError:
            break
        if math.isfinite(motion.ended(course)):
            return _Ahead(over=max(motion.ended(course), changes))
        speed = motion.speeds(course, case.main)[0]
        if before is not None and not _gains(wanted, before, speed):
            return _Ahead(stuck=speed)
        end, before = 2 * end, speed
    return _Ahead()


def _goes_on(case: Case, end: float) -> tuple[float, float | None]:
    """When a rigid train is over with its start, and the speed that it keeps instead."""
    ahead = _ahead(case, end / 2)
    return ahead.over, ahead.stuck


def _followed(spec: Drivetrain, scene: TrainScene, case: Case, end: float, tolerance: float) -> Ending | None:
    """The end of a start or stop beyond its window; None where it takes a long run, or is not found."""
    work = 0
    for _ in range(DOUBLINGS):
        if not motion.seconds(case, end) <= motion.BESIDE:
            return None
        try:
            runs = bars.played(case, end, tolerance)
        except NumericsError:
            return None
        work += sum(course.record.steps for course in runs)
        if motion.untrusted(spec, scene, runs[0], tolerance) is not None:
            return None
        if all(math.isfinite(motion.ended(course)) for course in runs):
            loads = bars.loads(spec, *runs)
            return Ending(loads={name: one for name, one in loads.items() if name in _OF_THE_END}, work=work)
        end *= 2
    return None


def _gains(wanted: float, speed: float, later: float) -> bool:
    """Whether the speed comes nearer to the one that is wanted."""
    left = abs(wanted - speed)
    return left - abs(wanted - later) > _PROGRESS * left


def _last_change(case: Case) -> float:
    """Time after which no torque depends on the time any more; infinite under a sine."""
    signals = announced.signals_of(case)
    if any(signal.sines or (signal.slopes and signal.slopes[-1] != 0) for signal in signals):
        return math.inf
    stages = [stage for drive in case.train.drives for stage in drive.stages]
    times = [stage.until_time for stage in stages if stage.until_time is not None]
    return max([0.0, *times, *(impulse.time for impulse in case.train.impulses), *map(announced.last_of, signals)])


def _failure(spec: Drivetrain, case: Case, speed: float) -> Failure:
    name = case.bodies[case.main]
    quantity = units.ANGULAR_SPEED if spec.turns(name) else units.SPEED
    now = units.show(abs(speed), quantity)
    if not case.stopping:
        wanted = units.show(abs(case.until or 0.0), quantity)
        motor = next(iter(spec.motors), None)
        path: KeyPath = ("motors", motor) if motor is not None else ("inertias",)
        at_rest = not speed
        backward = speed * (case.until or 0.0) < 0
        how = "stays at rest" if at_rest else f"is driven back at {now}" if backward else f"stays at {now}"
        cure = "more motor torque at rest" if at_rest or backward else "more motor torque at this speed"
        return Failure(
            "DRV109", f"`{name}` {how} and never reaches {wanted}", path, f"{cure}, or less load and resistance"
        )
    brake = next(iter(spec.brakes), None)
    path = ("brakes", brake, "torque") if brake is not None else ("inertias",)
    message = f"`{name}` does not come to rest: it still moves at {now}, and no torque slows it down"
    cure = "more brake torque than the load drives with" if brake is not None else "add a `brakes` block"
    return Failure("DRV110", message, path, cure)


def _later(case: Case, course: motion.Course, end: float) -> Iterator[tuple[str, Found]]:
    """Loads of a start or stop that goes on: at least what they are so far."""
    after = Found(Estimate(end, end, math.inf, model=math.inf))
    if case.stopping:
        place = course.index("position", case.bodies[case.main])
        assert place is not None
        moved = abs(float(course.record.last[place] - course.record.first[place]))
        yield "stop_time", after
        yield "stop_angle", Found(Estimate(moved, 0.0, math.inf, model=math.inf))
        yield "stop_speed_share", Found(Estimate(motion.share(*motion.speeds(course, case.main)), 0.0, math.inf))
    else:
        assert case.until is not None
        reached = motion.reached_share(course, case.until)
        yield "start_time", after
        yield "start_share", Found(Estimate(reached, reached, 1.0, model=1.0 - reached))


def _state(spec: Drivetrain, case: Case, speed: float) -> str:
    name = case.bodies[case.main]
    quantity = units.ANGULAR_SPEED if spec.turns(name) else units.SPEED
    now = units.show(abs(speed), quantity)
    if case.until is None:
        return f"`{name}` still at {now}"
    return f"`{name}` at {now} of {units.show(abs(case.until), quantity)}"
