"""Starts and stops that are not over at the end of their window: never, or later."""

import math
from collections.abc import Callable, Container, Iterator
from dataclasses import dataclass, field, replace

from ptmcalc.base import units
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.result import Failure, Found, Result, family, of
from ptmcalc.machines.drivetrain.machine.model import REACHED, Case, Part, brake_of, case_of, rigid
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain, Run, TrainScene
from ptmcalc.machines.drivetrain.motion import announced, bars, overhauled_motors, simulation
from ptmcalc.machines.drivetrain.motion.course import Course
from ptmcalc.numerics.train.parts import Governed, Grip
from ptmcalc.numerics.train.signals import Signal

_PROGRESS = 1e-3
"""Minimum share of the remaining speed that a start or stop gains while its time doubles [1]. A numerical choice: an
induction motor near synchronous speed still gains some percent. A larger value reports slow starts as endless."""
_FADED = 20.0
"""Time constants of a decay after which it has no effect [1]: below 1e-8 of its beginning. A numerical choice. A larger
value takes longer windows."""
_TOLERANCE = 1e-6
"""Relative tolerance of the rigid run that looks ahead [1]. A numerical choice: it decides only whether a start or stop
ends. A smaller value takes longer; a larger one misses small gains of speed."""
_OF_SPEEDS = 1e-9
"""Relative tolerance of the rigid run whose rising speeds are evaluated [1]. A numerical choice below the error bars of
these speeds. A larger value reports rounding as growth."""


@dataclass(frozen=True, slots=True)
class Ending:
    """What is known of a start or stop that is not over at the end of the window."""

    failures: tuple[Failure, ...] = ()
    loads: dict[str, Found] = field(default_factory=dict)
    state: str = ""
    work: int = 0


_LOOKS = 12
"""Runs of the rigid train, each twice as long: the last takes 2048 windows. A numerical choice: more find later ends
and take longer."""
_LONGER = 1.2
"""Time in which an elastic train ends its start or stop, relative to the rigid one [1], as in its window. A numerical
choice. A larger value takes longer; a smaller one may omit the end."""
_OF_MAIN = frozenset({"start_time", "start_share", "stop_time", "stop_angle", "stop_speed_share"})
DOUBLINGS = 2
"""Doublings of a window with a torque peak in its second half. A numerical choice: more find later peaks and take
longer."""
APPROACHES = 4
"""Extensions of a window for a contact that the motion approaches. A numerical choice: more find later contacts and
take longer."""
_CREEP, _MORE = 0.01, 4.0
"""Peaks that still grow; numerical choices [1]. `_CREEP`: relative growth up to which undamped modes are the reason.
`_MORE`: later growth relative to the last, as the peak of a sum of sines grows ever more slowly. A larger `_CREEP` or a
smaller `_MORE` loses the safety of the bound."""
_PEAKS = frozenset({"torque_peak", "motor_torque_peak"})
_SPEEDS = frozenset({"speed_max", "speed_min"})

_OF_THE_WINDOW = frozenset({"motor_torque_rms", "speed_end", "angle_end", "torque_steady"})
"""Loads of the end or the mean of the scene: of a start or stop without `duration` they would be those of the window
that happens to be computed, but for a part at rest."""


def steady_runs(
    spec: Drivetrain, scene: TrainScene, case: Case, end: float, tolerance: float, doublings: int = DOUBLINGS
) -> tuple[tuple[Course, ...], dict[str, Interval], str]:
    """Runs over a window after which no torque and no speed grows, and what can still change after it.

    A start or stop whose torque peaks lie in the second half of the window, or whose extreme speeds do and grow on as
    those of the rigid train, is computed over twice the time until none grows; a `duration` of the file stays as it is.
    Where an event that the file announces lies after the window, each load that it can change has no bound.
    """
    runs = bars.played(case, end, tolerance)
    if scene.duration is not None or isinstance(scene, Run):
        return runs, {}, ""
    runs = _past_approached(scene, case, runs, tolerance)
    end = runs[0].record.time
    later = _announced_later(runs[0])
    if later:
        return runs, _by_anything(spec, runs[0]), later
    ahead = _speeds_ahead(spec, scene, runs[0])
    rising = {name for name, (more, size) in ahead.items() if not more < _CREEP * size}
    grown: dict[str, float] = dict.fromkeys(rising, math.inf)
    for _ in range(doublings):
        before = simulation.readings(spec, runs[0])
        late = [
            name
            for name, (_, at) in before.items()
            if (name in rising or family(name) in _PEAKS) and at is not None and at > end / 2
        ]
        if not late or simulation.seconds(case, 2 * end) > simulation.LONG:
            break
        known = bars.loads(spec, *runs)
        end *= 2
        runs = bars.played(case, end, tolerance)
        after = simulation.readings(spec, runs[0])
        grown = {name: abs(after[name][0] - before[name][0]) for name in late}
        grown = {name: more for name, more in grown.items() if more > known[name].estimate.bar}
        if not grown:
            break
    last = simulation.readings(spec, runs[0])
    beyond = {name: _outward(name, more) for name, (more, _) in ahead.items() if name not in rising}
    beyond |= {
        name: _outward(name, more if more < _CREEP * abs(last[name][0]) else math.inf) for name, more in grown.items()
    }
    restless = simulation.chattering(runs[0])
    beyond |= {of("torque_peak", name): Interval(0.0, math.inf) for name in restless if name in spec.links}
    named = [*(name for name in restless if name in spec.links), *sorted(grown)]
    return runs, beyond, f"`{named[0]}` is not steady" if named else ""


def _past_approached(scene: TrainScene, case: Case, runs: tuple[Course, ...], tolerance: float) -> tuple[Course, ...]:
    """Runs that contain the places which the motion approaches, each followed by the usual window.

    The runs stay as they are where a longer one takes more than `simulation.LONG` seconds.
    """
    for _ in range(APPROACHES):
        places = announced.approached(runs[0])
        if not places:
            break
        end = max(places.values()) + simulation.usual_window(scene, case)
        if not simulation.seconds(case, end) <= simulation.LONG:
            break
        runs = bars.played(case, end, tolerance)
    return runs


def _announced_later(course: Course) -> str:
    """The first event that the file announces and the run does not contain; empty without one."""
    end = course.record.time
    times = {name: time for name, time in announced.times(course.case).items() if time > end}
    if times:
        name = min(times, key=times.__getitem__)
        return f"`{name}` acts at {units.show(times[name], units.TIME)}"
    places = announced.approached(course)
    return f"`{min(places, key=places.__getitem__)}` is not reached" if places else ""


def _by_anything(spec: Drivetrain, course: Course) -> dict[str, Interval]:
    """What an event after the window can add to each load: anything, except to a start that is over."""
    names = set(simulation.readings(spec, course)) | {
        of(load, name) for load in ("torque_steady", "dynamic_factor") for name in (*spec.links, *spec.gears)
    }
    over = set[str]()
    if not course.case.stopping:
        for part in course.case.parts:
            if part.until is not None and math.isfinite(simulation.over(course, part)):
                over |= {_name(course.case, part, "start_time"), _name(course.case, part, "start_share")}
    signed = _SPEEDS | {"speed_end", "angle_end"}
    return {
        name: Interval(-math.inf if family(name) in signed else 0.0, math.inf) for name in names if name not in over
    }


def _outward(name: str, more: float) -> Interval:
    """What later windows may add to an extreme that has grown by so much in the last one."""
    return Interval(-_MORE * more, 0.0) if family(name) == "speed_min" else Interval(0.0, _MORE * more)


def _speeds_ahead(spec: Drivetrain, scene: TrainScene, course: Course) -> dict[str, tuple[float, float]]:
    """Growth of the extreme speeds of the rigid train while the time doubles, and their size, by the name of the load.

    Those of a run which lie in the second half of its window: a motor above the speed that ends its start goes on to
    the speed of no surplus. The growth is infinite where the rigid train is not computed.
    """
    end = course.record.time
    found = {
        name: (math.inf, abs(value))
        for name, (value, at) in simulation.readings(spec, course).items()
        if family(name) in _SPEEDS and at is not None and at > end / 2
    }
    case = rigid(case_of(spec, scene, backlash=False))
    if not found or simulation.seconds(case, 2 * end) > simulation.BESIDE:
        return found
    try:
        once, twice = (
            simulation.run(case, time, _OF_SPEEDS, most_work=simulation.most_work(case, time))
            for time in (end, 2 * end)
        )
    except NumericsError:
        return found
    before, after = simulation.readings(spec, once), simulation.readings(spec, twice)
    grown = {name: (abs(after[name][0] - before[name][0]), size) for name, (_, size) in found.items()}
    return {name: (more, size) for name, (more, size) in grown.items() if more > _OF_SPEEDS * size}


def completed(result: Result, spec: Drivetrain, scene: TrainScene, course: Course, tolerance: float) -> Result:
    """A result with what its run tells of the end of the start or stop.

    A motion that gains nothing while its time doubles never ends: the check of it fails. One that goes on is followed
    to its end where that takes no long run and the file gives no `duration`; else it has a time between the window and
    infinity.
    """
    if scene.duration is None:
        stopped = course.case.stopping and math.isfinite(simulation.ended(course))
        main = course.case.bodies[course.case.main]
        kept = {of("speed_end", main), of("angle_end", main)} if stopped else set[str]()
        defined = {
            name: one for name, one in result.loads.items() if family(name) not in _OF_THE_WINDOW or name in kept
        }
        result = replace(result, loads=defined)
    if len(course.case.train.springs) == len(spec.links):  # not a train whose links are made rigid
        reserves, failures = overhauled_motors.seen(spec, scene, course)
        result = replace(result, loads={**result.loads, **reserves}, failures=(*result.failures, *failures))
    for found in _endings(spec, scene, course, tolerance):
        loads = {name: found.loads.get(name, one) for name, one in result.loads.items()}
        failures = (*result.failures, *found.failures)
        work, state = result.work + found.work, found.state or result.open_end
        result = replace(result, loads=loads, failures=failures, open_end=state, work=work)
    return result


def _endings(spec: Drivetrain, scene: TrainScene, course: Course, tolerance: float) -> Iterator[Ending]:
    """The ends of all parts and clutches that the run does not contain."""
    for part in course.case.parts:
        if course.case.stopping or part.until is not None:
            found = _ending(spec, scene, course, tolerance, part)
            if found is not None:
                yield found
    for grip in course.case.clutches:
        if simulation.slip(course, grip) > 0:
            yield _slipping(spec, scene, course, tolerance, grip)


def _name(case: Case, part: Part, load: str) -> str:
    """Name of a load of the main part or of another one."""
    return load if part.body == case.main else of(f"part_{load}", case.bodies[part.body])


def _element(case: Case, part: Part) -> str:
    """The element of the checks of a part: none where there is one part only."""
    return case.bodies[part.body] if case.others else ""


def _ending(spec: Drivetrain, scene: TrainScene, course: Course, tolerance: float, part: Part) -> Ending | None:
    case, end = course.case, course.record.time
    if math.isfinite(simulation.over(course, part)):
        back = None if case.stopping else _driven_back(spec, course, part)
        return Ending((back,)) if back is not None else None
    ahead = _ahead(rigid(case_of(spec, scene, backlash=False)), end, _of_part(part))
    if ahead.stuck is not None:
        failure = replace(_failure(spec, case, part, ahead.stuck), element=_element(case, part))
        return Ending((failure,), dict(_growing(course, part, ahead.stuck)))
    if math.isfinite(ahead.over) and scene.duration is None:
        names = {load if part.body == case.main else _name(case, part, load) for load in _OF_MAIN}
        until = max(2 * end, _LONGER * ahead.over)
        followed = _followed(spec, scene, case, until, tolerance, lambda one: simulation.over(one, part), names)
        if followed is not None:
            return followed
    speed = simulation.speeds(course, part.body)[0]
    return Ending(loads=dict(_later(case, course, end, part)), state=_state(spec, case, part, speed))


def _slipping(spec: Drivetrain, scene: TrainScene, course: Course, tolerance: float, grip: Grip) -> Ending:
    """A clutch that slips at the end of a start: it never locks, or later."""
    case, end, name = course.case, course.record.time, of("clutch_slip", grip.name)
    slip = simulation.slip(course, grip)
    assert grip.second is not None
    sides = [
        f"`{case.bodies[body]}` at {units.show(abs(simulation.speeds(course, body)[0]), _quantity(spec, case, body))}"
        for body in (grip.first, grip.second)
    ]
    ahead = _ahead(rigid(case_of(spec, scene, backlash=False)), end, _of_clutch(grip))
    if ahead.stuck is not None:
        message = f"the clutch slips permanently: {sides[0]}, {sides[1]}"
        failure = Failure("DRV112", message, ("brakes", grip.name, "torque"), "increase the clutch torque", grip.name)
        return Ending((failure,), {name: Found(Estimate(slip, 0.0, math.inf, model=math.inf))})
    if math.isfinite(ahead.over) and scene.duration is None:
        until = max(2 * end, _LONGER * ahead.over)
        followed = _followed(spec, scene, case, until, tolerance, lambda one: _locked(one, grip), {name})
        if followed is not None:
            return followed
    note = f"the clutch may lock after {units.show(end, units.TIME)}: {sides[0]}, {sides[1]}"
    return Ending(loads={name: Found(Estimate(slip, 0.0, math.inf, model=math.inf), note=note)})


def _driven_back(spec: Drivetrain, course: Course, part: Part) -> Failure | None:
    """A start that reaches its speed and ends backward: a later load exceeds the torque of the motors."""
    case, name = course.case, course.case.bodies[part.body]
    speed = simulation.speeds(course, part.body)[0]
    assert part.until is not None
    on = [drive.name for drive in case.train.drives if drive.name in spec.motors and drive.gate.values == (1.0,)]
    if speed * part.until >= 0 or not on:
        return None
    now = units.show(abs(speed), _quantity(spec, case, part.body))
    message = f"`{name}` reaches its target speed and is driven back at {now} later"
    cure = "increase the motor torque above the maximum load, or reduce the load"
    return Failure("DRV109", message, _motor_path(spec, name), cure, _element(case, part))


def _quantity(spec: Drivetrain, case: Case, body: int) -> units.Quantity:
    """Of the speed of a body."""
    return units.ANGULAR_SPEED if spec.turns(case.bodies[body]) else units.SPEED


def _motor_path(spec: Drivetrain, body: str) -> KeyPath:
    """The motor on a body, or else the first one."""
    names = [name for name, one in spec.motors.items() if one.at == body] or list(spec.motors)
    return ("motors", names[0]) if names else ("inertias",)


def _growing(course: Course, part: Part, later: float) -> Iterator[tuple[str, Found]]:
    """The speed left by a stop that gains speed: it depends on the end of the window, and has no upper bound."""
    speed, before = simulation.speeds(course, part.body)
    if course.case.stopping and abs(later) > (1 + _PROGRESS) * abs(speed):
        share = simulation.share(speed, before) if part.body == course.case.main else 1.0
        name = _name(course.case, part, "stop_speed_share")
        yield name, Found(Estimate(share, min(share, 1.0), math.inf, model=math.inf))


@dataclass(frozen=True, slots=True)
class _Ahead:
    """How a rigid train goes on: when it is over, infinite where that is not known, and the speed that it keeps."""

    over: float = math.inf
    stuck: float | None = None


Aim = tuple[Callable[[Course], float], Callable[[Course], tuple[float, float]]]
"""When a run is over, and the speed at its end with the one that is wanted."""


def _of_part(part: Part) -> Aim:
    wanted = 0.0 if part.until is None else part.until
    return (lambda one: simulation.over(one, part)), lambda one: (simulation.speeds(one, part.body)[0], wanted)


def _of_clutch(grip: Grip) -> Aim:
    def apart(course: Course) -> tuple[float, float]:
        assert grip.second is not None
        return simulation.speeds(course, grip.first)[0] - simulation.speeds(course, grip.second)[0], 0.0

    return (lambda one: _locked(one, grip)), apart


def _locked(course: Course, grip: Grip) -> float:
    """When a clutch of this name locked in a run of the elastic or the rigid train [s]."""
    return simulation.locked(course, next(one for one in course.case.train.grips if one.name == grip.name))


def _ahead(case: Case, end: float, aim: Aim) -> _Ahead:
    """How the rigid train goes on after a window, looked at over twice the time again and again.

    From the last change of a torque with time on its motion is that of one speed, which rises or falls for good: where
    it comes no nearer to the one that is wanted it never has it.
    """
    changes = _last_change(case)
    if not math.isfinite(changes):
        return _Ahead()
    end, before = max(end, changes), None
    over, speeds = aim
    for look in range(_LOOKS):
        if look > 1 and simulation.seconds(case, end) > simulation.BESIDE:
            break
        try:
            course = simulation.run(case, end, _TOLERANCE, most_work=simulation.most_work(case, end))
        except NumericsError:
            break
        if math.isfinite(over(course)):
            return _Ahead(over=max(over(course), changes))
        speed, wanted = speeds(course)
        if before is not None and not _gains(wanted, before, speed):
            return _Ahead(stuck=speed)
        end, before = 2 * end, speed
    return _Ahead()


def _followed(
    spec: Drivetrain,
    scene: TrainScene,
    case: Case,
    end: float,
    tolerance: float,
    over: Callable[[Course], float],
    names: Container[str],
) -> Ending | None:
    """These loads of a start or stop that ends beyond its window; None where it takes a long run, or is not found."""
    work = 0
    for _ in range(DOUBLINGS):
        if not simulation.seconds(case, end) <= simulation.BESIDE:
            return None
        try:
            runs = bars.played(case, end, tolerance)
        except NumericsError:
            return None
        work += sum(course.record.steps for course in runs)
        if simulation.untrusted(spec, scene, runs[0], tolerance) is not None:
            return None
        if all(math.isfinite(over(course)) for course in runs):
            loads = bars.loads(spec, *runs)
            return Ending(loads={name: one for name, one in loads.items() if name in names}, work=work)
        end *= 2
    return None


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
    laws = [stage.law for drive in train.drives if not drive.name.startswith(REACHED) for stage in drive.stages]
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


def _failure(spec: Drivetrain, case: Case, part: Part, speed: float) -> Failure:
    name = case.bodies[part.body]
    quantity = _quantity(spec, case, part.body)
    now = units.show(abs(speed), quantity)
    if not case.stopping:
        until = part.until or 0.0
        wanted = units.show(abs(until), quantity)
        at_rest = not speed
        backward = speed * until < 0
        how = "stays at rest" if at_rest else f"is driven back at {now}" if backward else f"stays at {now}"
        cure = (
            "increase the motor torque at standstill"
            if at_rest or backward
            else "increase the motor torque at this speed"
        )
        message = f"`{name}` {how} and never reaches {wanted}"
        return Failure("DRV109", message, _motor_path(spec, name), f"{cure}, or reduce load and resistance")
    brake = brake_of(spec, case, part.body)
    path: KeyPath = ("brakes", brake, "torque") if brake is not None else ("inertias",)
    message = f"`{name}` does not come to rest: it still moves at {now}, and no torque decelerates it"
    cure = (
        "increase the brake torque above the driving torque of the load"
        if brake is not None
        else "add a `brakes` block"
    )
    return Failure("DRV110", message, path, cure)


def _later(case: Case, course: Course, end: float, part: Part) -> Iterator[tuple[str, Found]]:
    """Loads of a start or stop that goes on: at least what they are so far."""
    after = Found(Estimate(end, end, math.inf, model=math.inf))
    if case.stopping:
        yield _name(case, part, "stop_time"), after
        share = simulation.share(*simulation.speeds(course, part.body))
        if part.body == case.main:
            place = course.index("position", case.bodies[case.main])
            assert place is not None
            moved = abs(float(course.record.last[place] - course.record.first[place]))
            yield "stop_angle", Found(Estimate(moved, 0.0, math.inf, model=math.inf))
        else:
            share = simulation.share_of_fastest(course, part.body)
        yield _name(case, part, "stop_speed_share"), Found(Estimate(share, 0.0, math.inf))
    else:
        reached = simulation.reached_share(course, part)
        yield _name(case, part, "start_time"), after
        yield _name(case, part, "start_share"), Found(Estimate(reached, reached, 1.0, model=1.0 - reached))


def _state(spec: Drivetrain, case: Case, part: Part, speed: float) -> str:
    name = case.bodies[part.body]
    quantity = _quantity(spec, case, part.body)
    now = units.show(abs(speed), quantity)
    if part.until is None:
        return f"`{name}` still at {now}"
    return f"`{name}` at {now} of {units.show(abs(part.until), quantity)}"
