"""A start or a stop with a load of any angle, the motor's curve and the direction of power: simulated."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base import units
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Event, Finding, History
from ptmcalc.machines.crane.travelling.machine import model
from ptmcalc.machines.crane.travelling.machine.model import State, filled
from ptmcalc.machines.crane.travelling.machine.scenes import Moving
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.sway.course import Course, Reading, Worst
from ptmcalc.machines.crane.travelling.sway.drive_laws import drive_laws
from ptmcalc.machines.crane.travelling.sway.linear import linear_course, stalled
from ptmcalc.machines.crane.travelling.sway.moving import Motion, motion_of, stalls
from ptmcalc.numerics.distinct import distinct
from ptmcalc.numerics.pendulum.parts import Axis, Case, Follow, Gear, Load, Rail
from ptmcalc.numerics.pendulum.pieces import Pieces, braking
from ptmcalc.numerics.pendulum.swing import Swing, swing

FloatArray = NDArray[np.float64]
SIGNALS = ("acceleration", "pull_along", "tension")
_DOUBLINGS = 3
"""Attempts [1] to reach a speed or standstill, each with twice the simulated time: up to 5.2 times the first estimate.
A numerical choice: fewer refuse slow starts with NUM103, more allow longer runs."""
_SHOWN = 400
"""Samples of a plotted time history in each phase [1]. An engineering choice: more samples draw smoother curves and
enlarge the output. No load depends on it."""
_MOST_STEPS = 3000
"""Of a swing: starts of cranes take 2 to 60 radians, and a step is one or two of them."""
_BETWEEN = np.arange(8) / 8
"""Looks from node to node of the swing, the first one at it."""
_SIDE = 1e-12
"""Share of the time by which a look goes to either side of an event."""
_MET = 1e-9
"""Share of full speed by which a crane on its ramp may have missed it."""
_TOPS = 12
"""Of the highest ones that are told apart."""
_BENDS = 1.25
"""For a second derivative that changes between the looks that tell it."""
_SIDES = {"forward": 1.0, "rest": 0.0, "backward": -1.0}
"""Sign of the travel [1] in each state of the axis. Derived: it is the sense of the rolling resistance; another value
reverses or scales that force."""
_APART = 1e-3
"""Share of the mean time from look to look by which looks are apart that tell how bent a course is between them."""


@dataclass(frozen=True, slots=True)
class Leg:
    """A swing under one law of the drive, from a time on and for so long."""

    start: float
    swing: Swing
    lasts: float

    @property
    def end(self) -> float:
        return self.start + self.lasts


@dataclass(frozen=True, slots=True)
class Simulated(Course):
    """A course read from states over time: extremes of the looks, with what may lie between them as a bar."""

    times: FloatArray | None = None
    seen: State | None = None
    breaks: tuple[float, ...] = ()
    """times at which something changes at once"""
    phases_of: tuple[tuple[float, str], ...] = ()
    """when each phase begins, and its name"""
    share: float = 0.0
    """numerical bar of the pull over its size"""
    later: State | None = None
    """bounds of the states in which a crane that stands is dragged again after the window"""

    def extreme(self, of: Reading, largest: bool) -> Worst:
        assert self.seen is not None
        assert self.times is not None
        values = np.asarray(of(self.seen), float)
        heights = values if largest else -values
        k = int(heights.argmax())
        value = float(values[k])
        bar = self._unseen(heights, k) + self.share * abs(value) if math.isfinite(value) else 0.0
        estimate = Estimate.exact(value) if bar == 0 else Estimate.within(value, bar)
        if self.later is not None:
            estimate = _with_later(estimate, np.asarray(of(self.later), float), largest)
        time = float(self.times[k])
        phase = [name for begins, name in self.phases_of if begins <= time][-1]
        state = State(*(np.atleast_1d(np.asarray(part))[[k]] for part in self.seen))
        return Worst(estimate, phase, state)

    def _unseen(self, heights: FloatArray, highest: int) -> float:
        """Most by which the top may stand higher between the looks than at the highest one: beside that, or beside
        another top that was looked at less closely."""
        assert self.times is not None
        among = (self.times[:-1, None] <= self.breaks) & (self.breaks <= self.times[1:, None])
        parted = np.concatenate([[True], among.any(axis=1), [True]])
        edge = np.concatenate([[-math.inf], heights, [-math.inf]])
        before = np.where(parted[:-1], -math.inf, edge[:-2])
        after = np.where(parted[1:], -math.inf, edge[2:])
        turns = (heights >= before) & (heights >= after) & ((heights > before) | (heights > after))
        tops = np.flatnonzero(turns & np.isfinite(heights))
        tops = tops[np.argsort(-heights[tops])][:_TOPS]
        return max(float(heights[k]) - float(heights[highest]) + self._above(heights, k) for k in (highest, *tops))

    def _above(self, values: FloatArray, k: int) -> float:
        """Most by which a top stands above the look nearest to it.

        A quarter of what the looks beside it fall short of it; where it is the first or last of a smooth stretch the
        top may stand in the middle between two looks of one height, f'' s^2/8 above them.
        """
        assert self.times is not None
        beside = [j for j in (k - 1, k + 1) if 0 <= j < len(values) and not self._parted(k, j)]
        gap = max((abs(float(values[j]) - float(values[k])) for j in beside), default=0.0)
        near = [*self._apart(k, -1)[::-1], k, *self._apart(k, 1)]
        times, heights = self.times[near], values[near]
        slopes = np.diff(heights) / np.diff(times)
        bends = 2 * np.abs(np.diff(slopes)) / (times[2:] - times[:-2])
        at = near.index(k)
        longest = float(np.diff(times)[max(at - 1, 0) : at + 1].max(initial=0.0))
        return max(gap / 4, _BENDS * float(bends.max(initial=0.0)) * longest**2 / 8)

    def _apart(self, k: int, way: int) -> list[int]:
        """The next two looks to a side that are apart, in the same smooth stretch."""
        assert self.times is not None
        least = _APART * float(self.times[-1] - self.times[0]) / len(self.times)
        found: list[int] = []
        last, j = k, k + way
        while 0 <= j < len(self.times) and len(found) < 2 and not self._parted(k, j):
            if abs(float(self.times[j] - self.times[last])) > least:
                found.append(j)
                last = j
            j += way
        return found

    def _parted(self, k: int, j: int) -> bool:
        """Whether something changes at once between two looks."""
        assert self.times is not None
        low, high = sorted((float(self.times[k]), float(self.times[j])))
        return any(low <= time <= high for time in self.breaks)


@dataclass(frozen=True, slots=True)
class Run:
    """A simulated start or stop, and what it says of itself."""

    course: Course
    legs: tuple[Leg, ...] = ()
    findings: tuple[Finding, ...] = ()
    energy: float = 0.0

    @property
    def window(self) -> tuple[float, float] | None:
        """The time that was looked at."""
        return (0.0, self.legs[-1].end) if self.legs else None

    def histories(self) -> Mapping[str, History]:
        """Angle, pull and speed over time."""
        if not self.legs:
            return {}
        looks = [np.linspace(0.0, leg.lasts, _SHOWN) for leg in self.legs]
        times = np.concatenate([leg.start + look for leg, look in zip(self.legs, looks, strict=True)]).tolist()

        def over_time(signal: str) -> list[float]:
            seen = [leg.swing.at(signal, look) for leg, look in zip(self.legs, looks, strict=True)]
            return [float(value) for value in np.concatenate(seen)]

        return {
            "sway_angle_max": History(units.ANGLE, times, over_time("along")),
            "horizontal_force": History(units.FORCE, times, over_time("pull_along")),
        }

    @property
    def events(self) -> tuple[Event, ...]:
        """Changes of state, in time."""
        return tuple(
            Event(leg.start + event.time, event.element, event.before, event.after)
            for leg in self.legs
            for event in leg.swing.events
            if event.time <= leg.lasts
        )


def turns(spec: Travelling, scene: Moving) -> float:
    """Radians through which the load swings in a start or stop, with two swings after it; 0 where nothing is simulated.

    It is what a simulation costs.
    """
    motion = motion_of(spec, scene)
    if not motion.load or stalls(motion):
        return 0.0
    lasts = max(motion.rigid_time, motion.hoist_time) + motion.delay + motion.rise + motion.rising
    shortest = min(motion.length, motion.length - motion.hoisting * motion.hoist_time)
    if shortest <= 0:
        return math.inf
    mass = motion.body + motion.rotor
    stiffer = 1.0 if motion.ramp is not None else 1 + motion.load / mass
    return motion.looks * (lasts * math.sqrt(motion.gravity / shortest * stiffer) + 4 * math.pi)


def simulate(spec: Travelling, scene: Moving, tolerance: float) -> Run:
    """A start or a stop as it happens.

    **Range** a taut rope; a drive that does not slip on the rails; motors that keep full speed once they have it.
    **Error** every number with the difference of two runs of other steps and orders (`numerics.pendulum.swing`), and
    of what lies between the looks at it.
    **Source** `numerics.pendulum.swing`.
    """
    motion = motion_of(spec, scene)
    if not motion.load or stalls(motion):
        return Run(linear_course(motion))
    if motion.least_force <= motion.rolling + motion.outside and motion.starts and motion.ramp is None:
        return Run(stalled(motion))
    reached, legs = _until_speed(spec, scene, motion, tolerance)
    begins = max(reached, motion.hoist_time)
    length = motion.length - motion.hoisting * motion.hoist_time
    window = motion.looks * (begins + 1.2 * 2 * math.pi * math.sqrt(length / motion.gravity))
    legs = _lengthened(tolerance, legs, window)
    there = None if motion.ramp is not None else _there(motion, legs[-1].swing)
    if there is not None:  # a longer run comes there at its own time: before it the crane moves, after it it does not
        reached = legs[-1].start + there
    return _read(motion, legs, reached, begins, window)


def _until_speed(spec: Travelling, scene: Moving, motion: Motion, tolerance: float) -> tuple[float, list[Leg]]:
    """Legs until full speed or rest, and when that is."""
    guess = motion.rigid_time + (motion.rising if motion.starts else motion.delay + motion.rise)
    legs: list[Leg] = []
    case, time = _case(spec, scene, motion), 0.0
    drives = drive_laws(spec, motion)
    for index, (drive, until, switched) in enumerate(drives):
        last = index == len(drives) - 1
        case = replace(case, axis=replace(case.axis, drive=drive))
        if switched is None:
            leg = _reaching(motion, case, time, until, last, max(guess, 1e-6), tolerance)
        else:
            found = swing(case, switched - time, tolerance=tolerance, most_steps=_MOST_STEPS)
            there = _there(motion, found)
            last, leg = there is not None, Leg(time, found, switched - time if there is None else there)
        legs.append(leg)
        time = leg.end
        if last:
            break
        case = continued(case, leg)
    return time, legs


def _reaching(
    motion: Motion, case: Case, start: float, until: float | None, last: bool, guess: float, tolerance: float
) -> Leg:
    """A leg until the axis has a speed, or stands; of a ramp until it is over."""
    if motion.ramp is not None and last:
        lasts = motion.speed / motion.ramp
        return Leg(start, swing(case, 1.05 * lasts, tolerance=tolerance, most_steps=_MOST_STEPS), lasts)
    reach = 1.3 * guess
    for _ in range(_DOUBLINGS):
        found = swing(case, reach, tolerance=tolerance, most_steps=_MOST_STEPS)
        there = _there(motion, found)
        if there is not None:
            return Leg(start, found, there)
        reach *= 2
    what = f"come to {until or motion.speed:.3g} m/s" if motion.starts else "come to rest"
    raise NumericsError("NUM103", f"the crane does not {what} by {reach / 2:.3g} s")


def _there(motion: Motion, found: Swing) -> float | None:
    """When a swing has come to full speed or rest; along a ramp with a limit of the force not before its end."""
    drive, since = found.case.axis.drive, 0.0
    if isinstance(drive, Follow) and motion.starts:
        since = drive.speed.starts[-1]
        if since <= found.end and abs(float(found.at("speed", since)) / motion.speed - 1) <= _MET:
            return since
    element, after = ("drive", "keep") if motion.starts else ("axis", "rest")
    came = (event.time for event in found.events if (event.element, event.after) == (element, after))
    return next((time for time in came if time >= since), None)


def _lengthened(tolerance: float, legs: list[Leg], window: float) -> list[Leg]:
    """The legs with the last one run on to the end of the window."""
    last = legs[-1]
    if last.start + last.swing.end >= window:
        return [*legs[:-1], replace(last, lasts=window - last.start)]
    found = swing(last.swing.case, window - last.start, tolerance=tolerance, most_steps=_MOST_STEPS)
    return [*legs[:-1], Leg(last.start, found, window - last.start)]


def _case(spec: Travelling, scene: Moving, motion: Motion) -> Case:
    drive = spec.drive
    ratio = model.rim_ratio(spec)
    wheels = model.driven_wheels(spec) * filled(spec.wheels.inertia) / model.radius(spec) ** 2
    free = motion.ramp is not None
    brake = drive.brake
    held = braking(brake.torque * ratio, 0.0, brake.delay, brake.rise_time) if brake is not None else None
    gear = Gear(
        0.0 if free else drive.inertia * ratio**2,
        drive.efficiency,
        drive.reverse_efficiency,
        held if held is not None and not motion.starts and not free else Pieces.constant(0.0),
    )
    length = Pieces.constant(motion.length)
    if motion.hoisting:
        end = motion.length - motion.hoisting * motion.hoist_time
        length = Pieces.through(((0.0, motion.length), (motion.hoist_time, end)))
    inertia = motion.body + (0.0 if free else wheels)
    turning = inertia - sum(body.mass for body in model.bodies(spec, 0.0))  # a slope pulls at masses alone
    axis = Axis(
        inertia,
        friction=motion.rolling,
        outer=Pieces.constant(turning * motion.gravity * math.sin(motion.slope) - motion.wind_on_body),
        gear=gear,
        speed=0.0 if motion.starts else motion.speed,
    )
    load = Load(motion.load, length, along=motion.lean, wind_along=Pieces.constant(-motion.wind_on_load))
    return Case(motion.gravity, Rail(motion.slope), axis, load)


def continued(case: Case, leg: Leg) -> Case:
    """The case that goes on where a leg ends."""
    from_there = {name: leg.swing.known(name, leg.lasts).value for name in ("along", "along_rate", "speed", "position")}
    length = case.load.length
    after = [k for k, start in enumerate(length.starts) if start > leg.lasts]
    starts = (0.0, *(length.starts[k] - leg.lasts for k in after))
    rows = (length.around(leg.lasts), *(length.coefficients[k] for k in after))
    load = replace(
        case.load, length=Pieces(starts, rows), along=from_there["along"], along_rate=from_there["along_rate"]
    )
    axis = replace(case.axis, speed=from_there["speed"], position=from_there["position"])
    return replace(case, axis=axis, load=load)


def _with_later(seen: Estimate, later: FloatArray, largest: bool) -> Estimate:
    """An extreme with what it can still come to after the window."""
    far = float(later.max() if largest else later.min())
    if not (far > seen.high if largest else far < seen.low):
        return seen
    low, high = (seen.low, far) if largest else (far, seen.high)
    return replace(seen, low=low, high=high, model=seen.model + abs(far - (seen.high if largest else seen.low)))


def _read(motion: Motion, legs: list[Leg], reached: float, begins: float, window: float) -> Run:
    last = legs[-1]
    sways = [leg.swing.largest("sway", 0.0, leg.lasts) for leg in legs]
    top = max(sways, key=lambda peak: peak.value)
    since = begins - last.start
    if motion.wind_on_load:
        ends = last.swing.largest("along", since, last.lasts), last.swing.smallest("along", since, last.lasts)
        residual = Estimate.within((ends[0].value - ends[1].value) / 2, (ends[0].bar + ends[1].bar) / 2)
    else:
        left = last.swing.known("amplitude", min(since * (1 + _SIDE) + 1e-12, last.lasts))
        residual = Estimate(left.value, max(left.value - left.bar, 0.0), left.value + left.bar, left.bar)
    at = reached - last.start
    way, settled = last.swing.known("position", at), all(leg.swing.settled for leg in legs)
    bar = _time_bar(motion, last, at)
    times, state, breaks = _states(motion, legs, reached)
    pulls = [leg.swing.farthest("pull_along", 0.0, leg.lasts) for leg in legs]
    share = max(peak.bar / abs(peak.value) if peak.value else 0.0 for peak in pulls)
    named = ((0.0, "start"), (reached, "travel")) if motion.starts else ((0.0, "stop"), (reached, "standing"))
    findings: tuple[Finding, ...] = ()
    if not settled:
        findings = (Finding("NUM102", "two runs have different events: later results are uncertain"),)
        bar = math.inf
    energy = max(leg.swing.works().residual for leg in legs)
    exact = motion.ramp is not None
    course = Simulated(
        time=Estimate.exact(reached) if exact else Estimate.within(reached, bar),
        distance=Estimate.within(way.value, way.bar + (0.0 if exact else bar * motion.speed)),
        sway=Estimate.within(top.value, top.bar),
        residual=residual,
        phases=(),
        work=sum(leg.swing.steps for leg in legs),
        times=times,
        seen=state,
        breaks=breaks,
        phases_of=named,
        share=share,
        later=_dragged_again(motion, last, times, state),
    )
    return Run(course, tuple(legs), findings, energy)


def _dragged_again(motion: Motion, last: Leg, times: FloatArray, seen: State) -> State | None:
    """Bounds of the states in which a load that swings on drags the standing crane after the window; none where the
    last period shows that it does not.

    The pull P at which the brakes or the friction give way is the same every time. The swing only loses energy, until
    its amplitude just reaches P: the vertical part of the rope force goes from what it was to

        m g (1 + sqrt(1 - (2 P/(m g))^2))/2

    With wind on the load or on a slope, it stays within a share 2 a^2 of what it was (to order a^2; a: the largest
    angle of the last period).
    """
    period = 2 * math.pi * math.sqrt(motion.length / motion.gravity)
    since = max(last.lasts - period, 0.0)
    moves = [one.time for one in last.swing.events if one.before == "rest" and since <= one.time <= last.lasts]
    if motion.ramp is not None or motion.starts or not moves:
        return None
    marks = [int(np.searchsorted(times, (last.start + mark) * (1 - 2 * _SIDE))) for mark in moves]
    at = State(*(np.atleast_1d(np.asarray(part))[marks] for part in seen))
    if motion.wind_on_load or motion.slope:
        angle = last.swing.farthest("along", since, last.lasts)
        share = 2 * (abs(angle.value) + angle.bar) ** 2
        bounds = [at.weight * (1 - share), at.weight * (1 + share)]
    else:
        weight = motion.load * motion.gravity
        bounds = [weight * (1 + np.sqrt(np.maximum(1 - (2 * at.pull / weight) ** 2, 0.0))) / 2]
    return State(*(np.concatenate([part] * len(bounds)) for part in at))._replace(weight=np.concatenate(bounds))


def _time_bar(motion: Motion, last: Leg, at: float) -> float:
    """By the bar of the speed over the acceleration there."""
    if motion.ramp is not None:
        return 0.0
    just = at * (1 - 1e-6)
    speed = last.swing.known("speed", just)
    slope = abs(last.swing.known("acceleration", just).value)
    return speed.bar / slope + 1e-9 * at if slope else math.inf


def _states(motion: Motion, legs: list[Leg], reached: float) -> tuple[FloatArray, State, tuple[float, ...]]:
    """Time and state at all looks."""
    times, parts, moves, breaks = [], [], [], [reached]
    for leg in legs:
        marks = sorted({event.time for event in leg.swing.events if event.time <= leg.lasts})
        breaks += [leg.start + mark for mark in marks]
        looks, _ = leg.swing.history(("speed",))
        marked = [*marks, reached - leg.start]
        edges = [0.0, leg.lasts, *(mark * (1 + side) for mark in marked for side in (-_SIDE, _SIDE))]
        looks = distinct(np.clip(np.concatenate([looks, np.array(edges)]), 0.0, leg.lasts))
        looks = np.append((looks[:-1, None] + np.diff(looks)[:, None] * _BETWEEN).ravel(), looks[-1])
        times.append(leg.start + looks)
        parts.append(leg.swing.signals(SIGNALS, looks))
        moves.append(_moves(leg, looks))
    time, (acceleration, along, tension) = np.concatenate(times), np.concatenate(parts, axis=1)
    pull = -along
    weight = np.sqrt(np.maximum(tension**2 - along**2, 0.0))
    rolling = motion.rolling * np.concatenate(moves)
    traction = motion.body * acceleration + rolling + motion.wind + pull
    order = np.argsort(time, kind="stable")
    wind = np.full(len(time), motion.wind)
    state = State(acceleration[order], pull[order], weight[order], traction[order], wind)
    return time[order], state, tuple(sorted(breaks))


def _moves(leg: Leg, looks: FloatArray) -> FloatArray:
    """To which side the crane goes, 0 where it stands."""
    turns = [event for event in leg.swing.events if event.element == "axis"]
    sides = [_SIDES[turns[0].before] if turns else 1.0, *(_SIDES[event.after] for event in turns)]
    return np.array(sides)[np.searchsorted([event.time for event in turns], looks, side="right")]
