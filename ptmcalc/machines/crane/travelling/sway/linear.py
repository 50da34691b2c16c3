"""A start or a stop with a load that swings in small angles: exact, piece by piece."""

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.machines.crane.travelling.sway.course import Course, Phase
from ptmcalc.machines.crane.travelling.sway.moving import Motion, stalls
from ptmcalc.numerics.pendulum import linear
from ptmcalc.numerics.pendulum.linear import LinearCase, LinearSwing, linear_swing
from ptmcalc.numerics.pendulum.pieces import Pieces

FloatArray = NDArray[np.float64]

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)
_LOOKS = 64
"""Looks at the speed in a swing: it is reached or lost between two of them."""
_DOUBLINGS = 40
"""Doublings of the simulated time [1] until the crane reaches its speed, 2^39 times the first estimate at most. A
numerical choice: fewer refuse a slow start with NUM103, more only delay the refusal."""
_SHOWN = 120
"""Samples of a plotted time history in each phase [1]. An engineering choice: more samples draw smoother curves and
enlarge the output. No load depends on it."""


@dataclass(frozen=True, slots=True)
class _Stretch:
    """A swing under one drive, and where it begins."""

    name: str
    start: float
    swing: LinearSwing
    force: float
    """of drive or brake at the rims, in the direction of travel, when the stretch ends [N]"""
    rotor: float

    @property
    def end(self) -> float:
        return self.start + self.swing.end


@dataclass(slots=True)
class _Journey:
    """The stretches so far, and the state at the end of the last one."""

    motion: Motion
    lengths: Pieces
    stretches: list[_Stretch]
    time: float = 0.0
    angle: float = 0.0
    rate: float = 0.0
    speed: float = 0.0

    def go(self, name: str, push: Pieces, ratio: float, lasts: float, force: float, rotor: float) -> LinearSwing:
        """Go on for so long under a push."""
        swing = linear_swing(self._case(push, ratio), lasts)
        self.stretches.append(_Stretch(name, self.time, swing, force, rotor))
        self.time += lasts
        end = np.array(lasts)
        self.angle, self.rate = float(swing.at(linear.ANGLE, end)), float(swing.at(linear.RATE, end))
        self.speed = float(swing.at(linear.SPEED, end))
        return swing

    def go_until(
        self, name: str, push: Pieces, ratio: float, speed: float, force: float, rotor: float, guess: float
    ) -> LinearSwing:
        """Go on until the crane has a speed."""
        case, reach, up = self._case(push, ratio), guess, speed > self.speed
        for _ in range(_DOUBLINGS):
            tried = linear_swing(case, reach)
            found = _crossing(tried, speed, up, self._period(ratio))
            if found is not None:
                return self.go(name, push, ratio, found, force, rotor)
            reach *= 2
        raise NumericsError("NUM103", f"the crane does not reach {speed:g} m/s by {reach:.3g} s")

    def _case(self, push: Pieces, ratio: float) -> LinearCase:
        left = _from(self.lengths, self.time)
        return LinearCase(self.motion.gravity, left, push, ratio, self.angle, self.rate, self.speed)

    def _period(self, ratio: float) -> float:
        shortest = min(float(self.lengths.at(self.time)), self.lengths.coefficients[-1][0])
        return 2 * math.pi * math.sqrt(shortest / (self.motion.gravity * (1 + ratio)))


def linear_course(motion: Motion) -> Course:
    """A start or a stop.

        L u'' + g u = -L a,   or L u'' + g (1 + M/m) u = -L F/m with m x'' = F + M g u/L;   without `drive_reaction`
        (m + M) x'' = F

    **Range** small angles; resistances that do not change; a crane that does not turn round before it has its speed.
    **Error** told by `numerics.pendulum.linear`; what finite angles change is not in it.
    **Source** `numerics.pendulum.linear`.

    Raises:
        NumericsError: a load so heavy that it pulls the crane back before it has its speed.
    """
    if stalls(motion):
        return stalled(motion)
    return _course(*_travelled(motion))


def over_time(motion: Motion) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Times [s], angle of the load from the plumb line [rad], and its pull on the crane along its travel [N]."""
    journey, _, _ = _travelled(motion)
    looks = [np.linspace(0.0, stretch.swing.end, _SHOWN) for stretch in journey.stretches]
    times = [stretch.start + look for stretch, look in zip(journey.stretches, looks, strict=True)]
    angles = [stretch.swing.at(linear.ANGLE, look) for stretch, look in zip(journey.stretches, looks, strict=True)]
    angle = np.concatenate(angles)
    pull = motion.load * motion.gravity * angle - motion.on_load
    return np.concatenate(times), angle + motion.lean, pull


def _travelled(motion: Motion) -> tuple[_Journey, float, float]:
    """The whole way with a swing after it, when full speed or rest is reached, and for how long it is hoisted then."""
    journey = _Journey(motion, _lengths(motion), [])
    if motion.starts:
        _start(journey)
    else:
        _stop(journey)
    reached, hoisted = journey.time, motion.hoist_time
    standing = "travel" if motion.starts else "standing"
    journey.speed = motion.speed if motion.starts else 0.0
    ends = float(journey.lengths.coefficients[-1][0])
    rest = max(hoisted - reached, 0.0) + 2 * math.pi * math.sqrt(ends / motion.gravity)
    rest += (motion.looks - 1) * (reached + rest)
    journey.go(standing, Pieces.constant(0.0), 0.0, rest, 0.0, 0.0)
    return journey, reached, max(hoisted - reached, 0.0)


def stalled(motion: Motion) -> Course:
    """A start that does not get it going, or a stop that does not hold it: it never comes to its end."""
    weight = motion.load * motion.gravity
    pull, never = Estimate.exact(motion.on_load), Estimate.exact(math.inf)
    force, rotor = (motion.force, motion.rotor) if motion.starts else (-motion.force, motion.rotor_braked)
    name = "standing" if motion.starts else "stop"
    lean = Estimate.exact(abs(motion.lean))
    still = phase(motion, name, (pull, pull), Interval(weight, weight), force, rotor)
    way = Estimate.exact(0.0) if motion.starts else never
    return Course(never, way, lean, Estimate.exact(0.0), (still,))


def _lengths(motion: Motion) -> Pieces:
    if not motion.hoisting:
        return Pieces.constant(motion.length)
    end = motion.length - motion.hoisting * motion.hoist_time
    if end <= 0:
        raise NumericsError(
            "NUM102", f"no rope is left at {motion.length / motion.hoisting:.3g} s: reduce the hoisting time"
        )
    return Pieces.through(((0.0, motion.length), (motion.hoist_time, end)))


def _from(pieces: Pieces, time: float) -> Pieces:
    """The same from a time on."""
    starts, coefficients = [0.0], [pieces.around(time)]
    for start, row in zip(pieces.starts, pieces.coefficients, strict=True):
        if start > time:
            starts.append(start - time)
            coefficients.append(row)
    return Pieces(tuple(starts), tuple(coefficients))


def _start(journey: _Journey) -> None:
    motion = journey.motion
    if motion.ramp is not None:
        journey.go("start", Pieces.constant(motion.ramp), 0.0, motion.speed / motion.ramp, 0.0, 0.0)
        return
    mass = motion.body + motion.rotor + motion.carried
    push = (motion.force - motion.rolling - motion.outside) / mass
    swing = journey.go_until(
        "start",
        Pieces.constant(push),
        _pulling(motion) / mass,
        motion.speed,
        motion.force,
        motion.rotor,
        motion.rigid_time,
    )
    _turned_round(swing)


def _stop(journey: _Journey) -> None:
    motion = journey.motion
    journey.speed = motion.speed
    if motion.ramp is not None:
        journey.go("stop", Pieces.constant(-motion.ramp), 0.0, motion.speed / motion.ramp, 0.0, 0.0)
        return
    drag = motion.rolling + motion.outside
    if motion.delay:
        mass = motion.body + motion.rotor + motion.carried
        journey.go("delay", Pieces.constant(-drag / mass), _pulling(motion) / mass, motion.delay, 0.0, motion.rotor)
        if min(float(journey.stretches[-1].swing.smallest(linear.SPEED).value), journey.speed) <= 0:
            raise NumericsError("NUM102", "it coasts to standstill before its brakes act")
    mass = motion.body + motion.rotor_braked + motion.carried
    push = Pieces.constant(-(motion.force + drag) / mass)
    force = motion.force
    if motion.rise:
        push = Pieces.through(((0.0, -drag / mass), (motion.rise, -(force + drag) / mass)))
    guess = motion.rise + motion.rigid_time
    swing = journey.go_until("stop", push, _pulling(motion) / mass, 0.0, -force, motion.rotor_braked, guess)
    if motion.rise > swing.end:  # it stands before its brakes are fully applied
        reached = -force * swing.end / motion.rise
        journey.stretches[-1] = replace(journey.stretches[-1], force=reached)
    journey.speed = 0.0


def _pulling(motion: Motion) -> float:
    """Mass of a load whose pull moves the crane as it swings [kg]."""
    return motion.load if motion.reacts else 0.0


def _crossing(swing: LinearSwing, speed: float, up: bool, period: float) -> float | None:
    """The first time at which the crane has a speed."""
    count = min(max(math.ceil(swing.end / period * _LOOKS), _LOOKS), 400_000)
    times = np.linspace(0.0, swing.end, count + 1)
    past = swing.at(linear.SPEED, times) - speed
    passed = np.flatnonzero(past >= 0 if up else past <= 0)
    if not len(passed):
        return None
    low, high = float(times[max(passed[0] - 1, 0)]), float(times[passed[0]])
    for _ in range(200):
        middle = (low + high) / 2
        if not low < middle < high:
            break
        there = float(swing.at(linear.SPEED, np.array(middle))) - speed
        low, high = (low, middle) if (there >= 0) == up else (middle, high)
    return high


def _turned_round(swing: LinearSwing) -> None:
    if swing.smallest(linear.SPEED).value < -1e-9 * abs(swing.largest(linear.SPEED).value):
        raise NumericsError("NUM102", "the load pulls the crane back before it reaches its speed")


# -- what is read off -----------------------------------------------------------------------------------------------


def _course(journey: _Journey, reached: float, hoisted: float) -> Course:
    motion = journey.motion
    *moving, last = journey.stretches
    bar = float(last.swing.bar(hoisted))
    residual = float(last.swing.amplitude(np.array(hoisted)))
    lean = motion.lean
    angles = [one for stretch in journey.stretches for one in _angles(stretch)]
    low, high = min(one.low for one in angles) + lean, max(one.high for one in angles) + lean
    inner = max(abs(min(one.value for one in angles) + lean), abs(max(one.value for one in angles) + lean))
    outer = max(abs(low), abs(high))
    slack = outer - inner
    sway = Estimate(inner, inner - slack, outer, slack)
    if not motion.load:
        sway, residual, bar = Estimate.exact(0.0), 0.0, 0.0
    distance = sum(_way(stretch) for stretch in moving)
    time = _time_bar(journey, reached)
    return Course(
        time,
        Estimate.within(distance, time.bar * motion.speed),
        sway,
        Estimate(residual, max(residual - bar, 0.0), residual + bar, bar),
        tuple(_phases(journey)),
        sum(len(stretch.swing.parts) for stretch in journey.stretches),
    )


def _time_bar(journey: _Journey, reached: float) -> Estimate:
    if journey.motion.ramp is not None:
        return Estimate.exact(reached)
    last = journey.stretches[-2].swing
    slope = abs(float(last.at(linear.ACCELERATION, np.array(last.end)))) or 1.0
    per_angle = last.case.mass_ratio * math.sqrt(journey.motion.gravity * journey.motion.length)
    return Estimate.within(reached, last.bar(last.end) * per_angle / slope + 1e-12 * reached)


def _angles(stretch: _Stretch) -> tuple[Estimate, Estimate]:
    least, most = stretch.swing.smallest(linear.ANGLE), stretch.swing.largest(linear.ANGLE)
    return Estimate.within(float(least.value), float(least.bar)), Estimate.within(float(most.value), float(most.bar))


def _way(stretch: _Stretch) -> float:
    """By the integral of the speed."""
    swing, total = stretch.swing, 0.0
    omega = math.sqrt(swing.case.gravity * (1 + swing.case.mass_ratio) / float(swing.case.length.coefficients[-1][0]))
    corners = [0.0, *(t for t in (*swing.case.push.starts, *swing.case.length.starts) if 0 < t < swing.end), swing.end]
    corners = sorted(set(corners))
    for low, high in itertools.pairwise(corners):
        count = min(max(math.ceil((high - low) * omega), 1), 200_000)
        step = (high - low) / count
        middles = low + step * (np.arange(count) + 0.5)
        speeds = swing.at(linear.SPEED, middles[:, None] + step / 2 * _NODES)
        total += float((speeds @ _WEIGHTS).sum()) * step / 2
    return total


def _phases(journey: _Journey) -> Iterator[Phase]:
    motion = journey.motion
    weight = motion.load * motion.gravity
    for stretch in journey.stretches:
        least, most = _angles(stretch)
        pulls = tuple(
            Estimate.within(motion.on_load - weight * one.value, weight * one.numerical) for one in (most, least)
        )
        yield phase(motion, stretch.name, (pulls[0], pulls[1]), Interval(weight, weight), stretch.force, stretch.rotor)


def phase(
    motion: Motion, name: str, pulls: tuple[Estimate, Estimate], weight: Interval, force: float, rotor: float
) -> Phase:
    """A phase of a start or stop in which a force acts at the rims, or a ramp is kept, or nothing is asked."""
    body, against = motion.body, motion.wind
    rest_weight = motion.load * motion.gravity
    acceleration, rolling = 0.0, 0.0
    if name == "travel":
        acceleration, rolling = 0.0, motion.rolling
    elif name != "standing" and motion.ramp is not None:
        acceleration, rolling = motion.ramp if motion.starts else -motion.ramp, motion.rolling
    elif name != "standing":

        def free(pull: FloatArray) -> FloatArray:
            if not motion.reacts:  # the load travels with the crane: its swing pulls at nothing
                net = force - motion.rolling - motion.outside
                return np.full(len(pull), net / (body + rotor + motion.load))
            return np.asarray((force - motion.rolling - against - pull) / (body + rotor))

        return Phase(
            name, pulls, weight, rest_weight, free, lambda pull: np.asarray(force - rotor * free(pull)), against
        )
    return Phase(
        name,
        pulls,
        weight,
        rest_weight,
        lambda pull: np.full(len(pull), acceleration),
        lambda pull: np.asarray(body * acceleration + rolling + against + pull),
        against,
    )
