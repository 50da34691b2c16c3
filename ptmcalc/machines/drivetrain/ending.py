"""Starts and stops that are not over at the end of their window: never, or later."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from ptmcalc.base import units
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.result import Failure, Found, Result, family, of
from ptmcalc.machines.drivetrain import bars, motion
from ptmcalc.machines.drivetrain.model import REACHED, Case, case_of, rigid
from ptmcalc.machines.drivetrain.spec import Drivetrain, Run, TrainScene
from ptmcalc.numerics.train.parts import Governed
from ptmcalc.numerics.train.signals import Signal

_PROGRESS = 1e-3
"""Least share of what is missing that a start or a stop that ends gains while its time doubles: an induction motor
next to its synchronous speed still gains some per cent of it."""
_FADED = 20.0
"""Time constants after which a decay is below 1e-8 of its beginning."""
_TOLERANCE = 1e-6


@dataclass(frozen=True, slots=True)
class Ending:
    """What is known of a start or stop that is not over at the end of the window."""

    failures: tuple[Failure, ...] = ()
    loads: dict[str, Found] = field(default_factory=dict)
    state: str = ""


_DOUBLINGS = 2
"""Times that a window is doubled in which a torque has its peak in the second half."""
_SECONDS = 5.0
"""Predicted seconds of a run up to which a window is doubled."""
_CREEP, _MORE = 0.01, 4.0
"""Growth of a peak, relative to it, up to which undamped modes that meet later are the reason; what later windows may
add is then at most some times the last growth, as the peak of a sum of sines grows ever slower."""
_PEAKS = frozenset({"torque_peak", "motor_torque_peak"})

_OF_THE_WINDOW = frozenset({"motor_torque_rms", "speed_end", "angle_end", "torque_steady"})
"""Loads of the end or the mean of the scene: of a start or stop without `duration` they would be those of the window
that happens to be computed, but for a part at rest."""


def steady_runs(
    spec: Drivetrain, scene: TrainScene, case: Case, tolerance: float
) -> tuple[tuple[motion.Course, ...], dict[str, Interval], str]:
    """Runs over a window after which no torque grows, and what can still change after it.

    A start or stop whose torque peaks lie in the second half of the window is computed over twice the time, until no
    peak grows any more; a `duration` of the file stays as it is.
    """
    end = motion.window(scene, case)
    runs = bars.played(case, end, tolerance)
    if scene.duration is not None or isinstance(scene, Run):
        return runs, {}, ""
    grown: dict[str, float] = {}
    for _ in range(_DOUBLINGS):
        before = motion.readings(spec, runs[0])
        late = [name for name, (_, at) in before.items() if family(name) in _PEAKS and at is not None and at > end / 2]
        if not late or motion.seconds(case, 2 * end) > _SECONDS:
            break
        known = bars.loads(spec, *runs)
        end *= 2
        runs = bars.played(case, end, tolerance)
        after = motion.readings(spec, runs[0])
        grown = {name: after[name][0] - before[name][0] for name in late}
        grown = {name: more for name, more in grown.items() if more > known[name].estimate.bar}
        if not grown:
            break
    beyond = {
        name: Interval(0.0, _MORE * more if more < _CREEP * motion.readings(spec, runs[0])[name][0] else math.inf)
        for name, more in grown.items()
    }
    restless = motion.chattering(runs[0])
    beyond |= {of("torque_peak", name): Interval(0.0, math.inf) for name in restless if name in spec.links}
    named = [*(name for name in restless if name in spec.links), *grown]
    return runs, beyond, f"`{named[0]}` is not steady" if named else ""


def completed(result: Result, spec: Drivetrain, scene: TrainScene, course: motion.Course) -> Result:
    """A result with what its run tells of the end of the start or stop.

    A motion that gains nothing while its time doubles never ends: the check of it fails. One that goes on has a time
    between the window and infinity.
    """
    if scene.duration is None:
        stopped = course.case.stopping and math.isfinite(motion.ended(course))
        main = course.case.bodies[course.case.main]
        kept = {of("speed_end", main), of("angle_end", main)} if stopped else set[str]()
        defined = {
            name: one for name, one in result.loads.items() if family(name) not in _OF_THE_WINDOW or name in kept
        }
        result = replace(result, loads=defined)
    found = _ending(spec, scene, course)
    if found is None:
        return result
    loads = {name: found.loads.get(name, one) for name, one in result.loads.items()}
    failures = (*result.failures, *found.failures)
    return replace(result, loads=loads, failures=failures, open_end=found.state or result.open_end)


def _ending(spec: Drivetrain, scene: TrainScene, course: motion.Course) -> Ending | None:
    case, end = course.case, course.record.time
    if (not case.stopping and case.until is None) or math.isfinite(motion.ended(course)):
        return None
    whole = rigid(case_of(spec, scene, backlash=False))
    speeds = _twice(whole, end)
    wanted = 0.0 if case.until is None else case.until
    if speeds is not None and not _gains(wanted, *speeds):
        return Ending((_failure(spec, case, speeds[1]),))
    return Ending(loads=dict(_later(case, course, end)), state=_state(spec, case, motion.speeds(course, case.main)[0]))


def _twice(case: Case, end: float) -> tuple[float, float] | None:
    """Speed of the main inertia of the rigid train at the end of a window, and of one twice as long, from where no
    torque changes with time any more; None where one does, or where the runs are not made."""
    changes = _last_change(case)
    if not math.isfinite(changes):
        return None
    end = max(end, changes)
    found = []
    for time in (end, 2 * end):
        try:
            course = motion.run(case, time, _TOLERANCE, most_work=motion.most_work(case, time))
        except NumericsError:
            return None
        found.append(motion.speeds(course, case.main)[0])
    return found[0], found[1]


def _gains(wanted: float, speed: float, later: float) -> bool:
    """Whether the speed comes nearer to the one that is wanted."""
    left = abs(wanted - speed)
    return left - abs(wanted - later) > _PROGRESS * left


def _last_change(case: Case) -> float:
    """Time after which no torque depends on the time any more; infinite under a sine or what waits for a trigger."""
    train = case.train
    signals = [drive.gate for drive in train.drives]
    signals += [grip.capacity for grip in train.grips]
    signals += [guide.acceleration for guide in train.guides]
    laws = [stage.law for drive in train.drives if drive.name != REACHED for stage in drive.stages]
    signals += [law for law in laws if isinstance(law, Signal)]
    signals += [law.reference for law in laws if isinstance(law, Governed)]
    last = max([impulse.time for impulse in train.impulses], default=0.0)
    for drive in train.drives:
        last = max([last, *(stage.until_time for stage in drive.stages if stage.until_time is not None)])
    for signal in signals:
        if signal.sines or (signal.slopes and signal.slopes[-1] != 0):
            return math.inf
        last = max(last, signal.times[-1], signal.decay_start + _FADED * signal.decay_time if signal.decay else 0.0)
    return last


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
