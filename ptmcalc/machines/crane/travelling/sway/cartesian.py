"""A start or stop with the load in Cartesian coordinates, by Runge-Kutta steps from event to event: for the reference.

    d'' = g + f/M - x'' e + lambda d,   lambda = (L'^2 - |d'|^2 - d.(g + f/M - x'' e))/L^2
    (m + k m_r) x'' = k F - W + (-M lambda d).e

d is the offset of the load from where its rope is held, along the rail (e) and square to it; k is the gear's factor by
the direction of the power through it, F what acts in front of it, W what acts behind it. The pull of the rope,
-M lambda d, is no unknown: the rope keeps its length. Where the hoist stops at once the rope gives an impulse.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.machines.crane.travelling.machine.model import State

FloatArray = NDArray[np.float64]
Signal = Callable[[FloatArray], FloatArray]
"""What is looked at, over the rows of `Seen`."""

ACCELERATION, PULL, WEIGHT, TRACTION, ANGLE = range(5)
_ROWS = 5
"""Number of the signals above [1]. Derived: one for each name; another value does not match the rows of the samples."""
_SAMPLES, _CLOSER, _TOPS = 17, 33, 8
"""Looks in a step, around a top, and at so many of the highest tops."""
_MOST_CHANGES = 400
"""Integration phases [1] of a motion after which it is refused with NUM101. A numerical choice: a smaller value refuses
motions with many stops, a larger one allows longer runs."""
_NOISE = 1e-11
"""Share [1] of forces and speeds below which a difference counts as rounding. A numerical choice: it is above the
rounding of a sum of forces, about 1e-15. A smaller value starts a crane at rest by rounding; a larger one holds it
against a real force."""
_LONGEST_STEP = 4.0
"""Radians of the swing, at a tolerance of 1; it goes with the eighth root, so that two runs take other steps."""


@dataclass(frozen=True, slots=True)
class Numbers:
    """The crane and its load in SI; forces along the rail positive against the travel."""

    body: float
    """what travels besides the load, as the driven wheels' force on the rails moves it"""
    turning: float
    """of it and of what turns behind the gear"""
    rotor: float
    """in front of the gear, by the ratio alone"""
    forward: float
    reverse: float
    rolling: float
    outside: float
    """wind and slope on what travels"""
    load: float
    down: tuple[float, float]
    """gravity and wind on the load over its mass, along and square to the rail"""
    plumb: float
    """angle of the plumb line from the square to the rail"""
    gravity: float
    length: float
    hoisting: float
    hoisted: float
    """when hoisting ends"""
    brake: float
    """of all brakes, in front of the gear"""
    delay: float
    rise: float

    def rope(self, time: float) -> tuple[float, float]:
        """Length and its rate, of the piece a time lies in."""
        if time >= self.hoisted:
            return self.length - self.hoisting * self.hoisted, 0.0
        return self.length - self.hoisting * time, -self.hoisting

    def through(self, force: float, side: int) -> float:
        """What comes out of the gear for a force into it, moving to a side."""
        return force * self.forward if force * side >= 0 else force / self.reverse


Force = Callable[[float], float]
"""In front of the gear, over the speed of travel."""


@dataclass(frozen=True, slots=True)
class Mode:
    """What moves the crane: an imposed acceleration, or a force; to which side it goes, 0 at rest."""

    imposed: float | None
    force: Force
    side: int


def no_force(speed: float) -> float:
    """A drive that is switched off."""
    return 0.0


@dataclass(frozen=True, slots=True)
class Step:
    """A step of the integration, and the mode in it."""

    start: float
    end: float
    at: Callable[[FloatArray], FloatArray]
    mode: Mode
    inside: float
    """a time in it that tells the piece of what changes over time"""


@dataclass
class Journey:
    """The state (x, x', d, d') from event to event, and the steps that led there."""

    numbers: Numbers
    tolerance: float
    speed: float = 0.0
    time: float = 0.0
    state: FloatArray = field(init=False)
    steps: list[Step] = field(default_factory=list)
    changes: int = 0
    inside: float = 0.0

    def __post_init__(self) -> None:
        one = self.numbers
        size = math.hypot(*one.down)
        d = np.array([one.length * one.down[0] / size, one.length * one.down[1] / size])
        rate = -one.hoisting if one.hoisted > 0 else 0.0
        self.state = np.concatenate([[0.0, self.speed], d, rate * d / one.length])

    # -- equations ---------------------------------------------------------------------------------------------------

    def motion(self, time: float, y: Sequence[float], mode: Mode) -> tuple[float, float]:
        """Acceleration of the crane, and lambda."""
        one = self.numbers
        length, rate = self._rope(time)
        _, v, dx, dz, ux, uz = y
        square = length * length
        fixed = (rate * rate - ux * ux - uz * uz - dx * one.down[0] - dz * one.down[1]) / square
        grows = dx / square
        if mode.imposed is not None:
            return mode.imposed, fixed + grows * mode.imposed
        if mode.side == 0:
            return 0.0, fixed
        into = mode.force(v) - mode.side * self._held(time)
        outer = -mode.side * one.rolling - one.outside - one.load * fixed * dx
        found = 0.0
        for factor, way in ((one.forward, 1), (1 / one.reverse, -1)):
            found = (factor * into + outer) / (one.turning + factor * one.rotor + one.load * grows * dx)
            if way * mode.side * (into - one.rotor * found) >= 0:
                break
        return found, fixed + grows * found

    def _rope(self, time: float) -> tuple[float, float]:
        """Length and its rate in the piece of this step, also at its very end."""
        one = self.numbers
        if self.inside >= one.hoisted:
            return one.rope(one.hoisted)
        return one.length - one.hoisting * time, -one.hoisting

    def _held(self, time: float) -> float:
        """What the brakes hold, in front of the gear."""
        one = self.numbers
        if self.inside <= one.delay or not one.brake:
            return 0.0
        return one.brake * (time - one.delay) / one.rise if self.inside < one.delay + one.rise else one.brake

    def rates(self, time: float, y: Sequence[float], mode: Mode) -> list[float]:
        """Of the state."""
        one = self.numbers
        a, pull = self.motion(time, y, mode)
        return [y[1], a, y[4], y[5], one.down[0] - a + pull * y[2], one.down[1] + pull * y[3]]

    def asked(self, time: float, y: Sequence[float], acceleration: float) -> float:
        """Force in front of the gear for an acceleration on the way forward."""
        one = self.numbers
        _, pull = self.motion(time, y, Mode(acceleration, no_force, 1))
        behind = one.turning * acceleration + one.rolling + one.outside + one.load * pull * y[2]
        return (behind / one.forward if behind >= 0 else behind * one.reverse) + one.rotor * acceleration

    def lacks(self, time: float, y: Sequence[float], force: float) -> tuple[float, float]:
        """What would move a crane at rest ahead, and back, less what holds it: below 0 where it stays."""
        one = self.numbers
        _, pull = self.motion(time, y, Mode(None, no_force, 0))
        outer, held = -one.outside - one.load * pull * y[2], self._held(time)
        ahead = outer + one.through(force - held, 1) - one.rolling
        return ahead, -outer - one.through(force + held, -1) - one.rolling

    # -- from event to event -----------------------------------------------------------------------------------------

    def go(self, mode: Mode, until: float, events: Sequence[Callable[[float, Any], float]] = ()) -> int | None:
        """On to a time, or to where an event rises through 0; which one."""
        from scipy.integrate import solve_ivp

        self._counted()
        one = self.numbers
        watched = [_terminal(event) for event in events]
        while self.time < until:
            breaks = (one.hoisted, one.delay, one.delay + one.rise)
            stop = min([until, *(time for time in breaks if time > self.time)])
            self.inside = (self.time + min(stop, self.time + 1.0)) / 2
            length = min(one.rope(self.time)[0], one.rope(stop)[0])
            step = _LONGEST_STEP * self.tolerance ** (1 / 8) * math.sqrt(length / one.gravity)
            scale = np.array([1.0, 1.0, one.length, one.length, one.length, one.length])
            run: Any = solve_ivp(
                lambda t, y: self.rates(t, y.tolist(), mode),
                (self.time, stop),
                self.state,
                method="DOP853",
                rtol=self.tolerance,
                atol=1e-3 * self.tolerance * scale,
                max_step=step,
                events=watched,
                dense_output=True,
            )
            if run.status < 0:
                raise NumericsError("NUM101", f"the second method stops at {self.time:.6g} s: {run.message}")
            pieces = zip(run.t[:-1], run.t[1:], run.sol.interpolants, strict=True)
            self.steps += [Step(a, b, sol, mode, self.inside) for a, b, sol in pieces if b > a]
            self.time, self.state = float(run.t[-1]), np.asarray(run.y[:, -1], float)
            fired = next((k for k, times in enumerate(run.t_events or ()) if len(times)), None)
            if fired is not None:
                return fired
            if one.hoisting and self.time == one.hoisted:
                self._jerk(mode)
                fired = next((k for k, event in enumerate(events) if event(self.time, self.state) > 0), None)
                if fired is not None:
                    return fired
        return None

    def _counted(self) -> None:
        self.changes += 1
        if self.changes > _MOST_CHANGES:
            raise NumericsError("NUM101", f"the second method meets more than {_MOST_CHANGES} events")

    def _jerk(self, mode: Mode) -> None:
        """The rope's length stops changing: an impulse along it, which a crane that is free takes too."""
        one, y = self.numbers, self.state
        d, free = y[2:4], mode.imposed is None and mode.side != 0
        n = d / np.hypot(*d)
        radial = -float(n @ y[4:6])  # rate of the length afterwards, less that before
        acceleration = self.motion(self.time, y.tolist(), mode)[0]
        into = mode.force(float(y[1])) - mode.side * self._held(self.time) - one.rotor * acceleration
        factor = one.forward if into * mode.side >= 0 else 1 / one.reverse
        inertia = one.turning + factor * one.rotor
        impulse = radial / (1 + one.load * float(n[0]) ** 2 / inertia) if free else radial
        change = -one.load * impulse * float(n[0]) / inertia if free else 0.0
        y[1] += change
        y[4:6] += impulse * n
        y[4] -= change

    def freely(self, force: Force, until: float, speed: float = math.inf, rest_ends: bool = False) -> bool:
        """Under a force, through all stops, to a time, a speed, or where the crane stays at rest; whether it came
        there."""

        def stops(side: int) -> Callable[[float, Any], float]:
            return lambda t, y: -side * float(y[1])

        def ahead(t: float, y: Any) -> float:
            return self.lacks(t, y, force(0.0))[0]

        def back(t: float, y: Any) -> float:
            return self.lacks(t, y, force(0.0))[1]

        side = (1 if self.state[1] > 0 else -1) if self.state[1] else self._side(force)
        while self.time < until:
            if side == 0:
                if rest_ends:
                    return True
                fired = self.go(Mode(None, force, 0), until, (ahead, back))
                side = 0 if fired is None else (1, -1)[fired]
                continue
            events = (stops(side), lambda t, y: float(y[1]) - speed)
            fired = self.go(Mode(None, force, side), until, events)
            if fired == 1:
                self.state[1] = speed
                return True
            if fired == 0:
                self.state[1] = 0.0
                side = self._side(force)
        return False

    def _side(self, force: Force) -> int:
        one = self.numbers
        self.inside = math.nextafter(self.time, math.inf)
        ahead, back = self.lacks(self.time, self.state.tolist(), force(0.0))
        noise = _NOISE * (one.rolling + one.load * one.gravity + abs(one.outside))
        return 1 if ahead > noise else -1 if back > noise else 0

    def following(self, reaches: float, rises: float, limit: float, until: float, full_ends: bool) -> bool:
        """After a speed that rises evenly, as far as a limit of the force lets it; whether it has it for good."""

        def wanted(t: float) -> float:
            return reaches * min(t / rises, 1.0) if rises else reaches

        while self.time < until:
            rising = self.time < rises
            slope = reaches / rises if rising else 0.0
            stop = min(until, rises) if rising else until
            self.inside = math.nextafter(self.time, math.inf)
            missing = wanted(self.time) - float(self.state[1])
            asked = self.asked(self.time, self.state.tolist(), slope)
            if abs(missing) <= _NOISE * reaches and abs(asked) <= limit * (1 + _NOISE):
                self.state[1] = wanted(self.time)
                if full_ends and not rising:
                    return True
                most = limit * (1 + _NOISE)
                fired = self.go(
                    Mode(slope, no_force, 1),
                    stop,
                    (
                        lambda t, y: self.asked(t, y, slope) - most,  # noqa: B023 - called before the next turn
                        lambda t, y: -self.asked(t, y, slope) - most,  # noqa: B023
                    ),
                )
                if fired is not None:
                    self.freely_to((1, -1)[fired], limit, stop, wanted)
                continue
            way = 1 if (missing if abs(missing) > _NOISE * reaches else asked) > 0 else -1
            self.freely_to(way, limit, stop, wanted)
        return False

    def freely_to(self, way: int, limit: float, until: float, wanted: Callable[[float], float]) -> None:
        """With the drive at its limit until the speed that is wanted is met."""
        side = (1 if self.state[1] > 0 else -1) if self.state[1] else self._side(lambda v: way * limit)
        events: list[Callable[[float, Any], float]] = [lambda t, y: way * (float(y[1]) - wanted(t))]
        mode = Mode(None, lambda v: way * limit, side)
        if side == 0:
            events += [lambda t, y: self.lacks(t, y, way * limit)[0], lambda t, y: self.lacks(t, y, way * limit)[1]]
        else:
            events.append(lambda t, y: -side * float(y[1]))
        fired = self.go(mode, until, events)
        if fired == 0:
            self.state[1] = wanted(self.time)
        elif fired == 1 and side:
            self.state[1] = 0.0


def _terminal(event: Callable[[float, Any], float]) -> Callable[[float, Any], float]:
    def watched(t: float, y: Any) -> float:
        return event(t, y)

    watched.terminal = True  # type: ignore[attr-defined]
    watched.direction = 1  # type: ignore[attr-defined]
    return watched


# -- what was seen -----------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Seen:
    """All looks at a journey: times of shape (steps, looks), and rows over them."""

    journey: Journey
    times: FloatArray
    rows: FloatArray

    @classmethod
    def of(cls, journey: Journey) -> "Seen":
        """Looks at every step."""
        times = np.array([np.linspace(step.start, step.end, _SAMPLES) for step in journey.steps])
        rows = np.array([_looks(journey, step, at) for step, at in zip(journey.steps, times, strict=True)])
        return cls(journey, times, rows.transpose(1, 0, 2))

    def top(self, of: Signal, since: float = 0.0) -> tuple[float, float, FloatArray]:
        """Largest value from a time on, its time, and the rows there."""
        values = np.where(self.times >= since, of(self.rows.reshape(_ROWS, -1)).reshape(self.times.shape), -math.inf)
        best: tuple[float, float, FloatArray] = (-math.inf, 0.0, self.rows[:, 0, 0])
        for step, look in self._highest(values):
            times, rows = self.times[step], self.rows[:, step]
            for _ in range(2):
                low, high = times[max(look - 1, 0)], times[min(look + 1, len(times) - 1)]
                times = np.linspace(max(low, since), high, _CLOSER)
                rows = _looks(self.journey, self.journey.steps[step], times)
                look = int(of(rows).argmax())
            found = float(of(rows)[look])
            if found > best[0]:
                best = found, float(times[look]), rows[:, look]
        return best

    def _highest(self, values: FloatArray) -> list[tuple[int, int]]:
        """Steps and looks of the highest tops."""
        edge = np.full((len(values), 1), -math.inf)
        before, after = np.hstack([edge, values[:, :-1]]), np.hstack([values[:, 1:], edge])
        tops = np.argwhere((values >= before) & (values >= after) & np.isfinite(values))
        if not len(tops):
            return [(int(k), int(j)) for k, j in [np.unravel_index(int(values.argmax()), values.shape)]]
        order = np.argsort(-values[tops[:, 0], tops[:, 1]], kind="stable")[:_TOPS]
        return [(int(k), int(j)) for k, j in tops[order]]


def _looks(journey: Journey, step: Step, times: FloatArray) -> FloatArray:
    """Rows at some times of a step."""
    one, mode = journey.numbers, step.mode
    journey.inside = step.inside
    states = step.at(times)
    moves = [journey.motion(float(t), y, mode) for t, y in zip(times, states.T.tolist(), strict=True)]
    a, pulled = np.array(moves).T
    pull, weight = one.load * pulled * states[2], one.load * pulled * states[3]
    traction = one.body * a + mode.side * one.rolling + one.outside + pull
    return np.array([a, pull, weight, traction, np.arctan2(states[2], -states[3]) - one.plumb])


def state_of(rows: FloatArray, wind: float) -> State:
    """Rows as the reading of loads knows them."""
    return State(rows[ACCELERATION], rows[PULL], rows[WEIGHT], rows[TRACTION], np.full(rows.shape[1:], wind))


def amplitude(journey: Journey) -> float:
    """Largest angle of the free swing that would follow if the crane went on steadily."""
    one = journey.numbers
    x, z, ux, uz = journey.state[2:]
    angle = math.atan2(x, -z) - one.plumb
    height = 2 * math.sin(angle / 2) ** 2 + (ux * ux + uz * uz) / (2 * one.gravity * math.hypot(x, z))
    return 2 * math.asin(min(math.sqrt(height / 2), 1.0))
