"""The motion of a load under a trolley or a jib at any angle, through all events.

Between two events the equations (`equations`) are smooth. A step is a polynomial whose derivative is exact at the nodes
of a Radau rule, found by Newton's method; it is as long as the last Legendre coefficients stay below the tolerance.
Events are roots of the guards on that polynomial. Everything is done twice, the second time coarser, in longer steps of
a lower order: what differs is the bar of every number.
"""

import math
from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics import panels
from ptmcalc.numerics.collocation import Rule, gauss, integrals, radau
from ptmcalc.numerics.extremes import Extremes
from ptmcalc.numerics.pendulum.equations import (
    HIGH,
    KEEP,
    LAW,
    LOW,
    OFF,
    POSITION,
    SIGNALS,
    SPEED,
    STATES,
    WORKS,
    Held,
    Leg,
    Mode,
    N,
    W,
    kept_speed,
)
from ptmcalc.numerics.pendulum.parts import CONSTANT, LINEAR, ORIFICE, Case, Follow, Jib, Peak, Push, Rail, Straight
from ptmcalc.numerics.pendulum.pieces import Pieces
from ptmcalc.numerics.record import Event

FloatArray = NDArray[np.float64]

TOLERANCE = 1e-11
MOST_STEPS = 20_000
_COARSER, _FINE, _COARSE = 300.0, 12, 10
"""Tolerance of the second run over the first one's; nodes of both."""
_HALVES = 2
"""Panels that are looked at in a step."""
_FIRST, _SHORTEST = 0.3, 1e-12
"""Share of 1/omega that is tried first; shortest step over 1/omega."""
_LONGEST = 4.0
_MOST_ITERATIONS = 14
_MOST_AT_ONCE = 60
"""Events without progress in time."""
_NOISE = 1e-11
_DUST = 1e-12
"""Rounding of a peak as a share of the largest value."""
_GAUSS = 20
_PLACES = np.concatenate([(k + panels.NODES) / _HALVES for k in range(_HALVES)])
_FURTHER = 0.9
_SWINGS = 0.05
"""Speed of the pivot over (g L)^(1/2) that its load may give it, for the scale."""
_STEEPEST = math.radians(89.9)


@dataclass(frozen=True, slots=True)
class Works:
    """Work of everything that acts [J], and what the energy balance leaves over as a share of what was turned over."""

    works: dict[str, float]
    stored: float
    """energy at the end less that at the start"""
    residual: float


@dataclass(frozen=True, slots=True)
class _Step:
    leg: Leg
    start: float
    length: float
    used: float
    """share of it up to the event that ended it"""
    state: FloatArray
    row: FloatArray
    """Legendre coefficients of the derivative, shape (states, nodes)"""

    @property
    def end(self) -> float:
        return self.start + self.used * self.length

    def states(self, share: FloatArray) -> FloatArray:
        """States at shares of the step, shape (states, shares)."""
        moved = self.row @ integrals(self.row.shape[1], share).T
        return np.asarray(self.state[:, None] + self.length * moved)


@dataclass(frozen=True, slots=True)
class _Track:
    """One run."""

    steps: list[_Step]
    events: tuple[Event, ...]
    finished: str
    _starts: list[float] = field(repr=False)
    jerks: dict[str, float]
    """work done at once"""

    def index(self, time: float) -> int:
        return min(max(bisect_right(self._starts, time) - 1, 0), len(self.steps) - 1)

    def runs(self, since: float, until: float) -> Iterator[tuple[Leg, list[_Step]]]:
        """Steps that share their equations."""
        row: list[_Step] = []
        for step in self.steps[self.index(since) : self.index(until) + 1]:
            if row and row[-1].leg is not step.leg:
                yield row[-1].leg, row
                row = []
            row.append(step)
        if row:
            yield row[-1].leg, row

    def at(self, names: tuple[str, ...], times: FloatArray) -> FloatArray:
        """Signals at times, shape (names, times); the later side at an event."""
        result = np.empty((len(names), len(times)))
        where = np.clip(np.searchsorted(self._starts, times, "right") - 1, 0, len(self.steps) - 1)
        for index in np.unique(where):
            step, inside = self.steps[index], where == index
            share = (times[inside] - step.start) / step.length if step.length else np.zeros(int(inside.sum()))
            states = step.states(np.clip(share, 0.0, step.used))
            result[:, inside] = step.leg.signals(names, times[inside], states)
        return result

    def extreme(self, name: str, sign: int, since: float, until: float) -> tuple[float, float, float]:
        """Value, time, and the largest magnitude met."""
        found, size = Extremes.of(1, sign), 0.0
        for leg, steps in self.runs(since, until):
            starts, lengths, states, times = [], [], [], []
            for step in steps:
                low, high = max(since, step.start), min(until, step.end)
                if high < low:
                    continue
                span = (high - low) / _HALVES
                share = (low - step.start + (high - low) * _PLACES) / step.length if step.length else 0 * _PLACES
                states.append(step.states(np.clip(share, 0.0, step.used)))
                times.append(low + (high - low) * _PLACES)
                starts += [low + k * span for k in range(_HALVES)]
                lengths += [span] * _HALVES
            if not starts:
                continue
            values = leg.signals((name,), np.concatenate(times), np.concatenate(states, axis=1))[0]
            size = max(size, float(np.abs(values).max()))
            by_panel = values.reshape(len(starts), panels.COUNT)
            found.see(np.array(starts), np.array(lengths), by_panel[:, :, None])
        found.settle()
        return float(found.values[0]), float(found.at[0]), size

    def polished(self, name: str, value: float, time: float, since: float, until: float) -> float:
        """The signal itself at the place of a peak, from whichever side is nearer to what was seen."""
        best = math.inf, value
        for index in {self.index(time), self.index(np.nextafter(time, -math.inf))}:
            step = self.steps[index]
            if step.start <= time <= step.end and since <= time <= until and step.length:
                share = np.array([min((time - step.start) / step.length, step.used)])
                seen = float(step.leg.signals((name,), np.array([time]), step.states(share))[0, 0])
                best = min(best, (abs(seen - value), seen))
        return best[1]


@dataclass(frozen=True, slots=True)
class Swing:
    """A motion, computed twice.

    `at`, `largest`, `smallest` and `farthest` know the signals listed in `parts`.
    """

    case: Case
    end: float
    """time at which it ends: the one asked for, or that of a buffer that became solid"""
    events: tuple[Event, ...]
    solid: bool
    """whether a buffer became solid: the speed that was left is that at the end"""
    steps: int
    _fine: _Track = field(repr=False)
    _coarse: _Track = field(repr=False)

    @property
    def settled(self) -> bool:
        """Whether both runs met the same events; if not, what follows the first other one is uncertain."""
        one, two = ([(e.element, e.after) for e in track.events] for track in (self._fine, self._coarse))
        return one == two and self._fine.finished == self._coarse.finished

    def at(self, name: str, time: ArrayLike) -> FloatArray:
        """A signal at times from 0 to the end, any shape."""
        t = np.asarray(time, float)
        return np.asarray(self._fine.at((name,), t.ravel())[0].reshape(t.shape))

    def known(self, name: str, time: float) -> Peak:
        """A signal at a time, with its bar."""
        one, two = (float(track.at((name,), np.array([time]))[0, 0]) for track in (self._fine, self._coarse))
        return Peak(one, time, abs(one - two) + _DUST * abs(one))

    def largest(self, name: str, since: float = 0.0, until: float = math.inf) -> Peak:
        """Largest value of a signal in a stretch of time; both sides of a jump count."""
        return self._extreme(name, 1, since, until)

    def smallest(self, name: str, since: float = 0.0, until: float = math.inf) -> Peak:
        """Smallest value of a signal in a stretch of time."""
        return self._extreme(name, -1, since, until)

    def farthest(self, name: str, since: float = 0.0, until: float = math.inf) -> Peak:
        """Largest magnitude of a signal in a stretch of time, with its sign."""
        top, bottom = self.largest(name, since, until), self.smallest(name, since, until)
        return top if top.value >= -bottom.value else bottom

    def history(self, names: tuple[str, ...] = SIGNALS) -> tuple[FloatArray, FloatArray]:
        """Times of all places that were looked at, and signals there, shape (names, times)."""
        times, values = [], []
        for leg, steps in self._fine.runs(0.0, self.end):
            t = np.concatenate([step.start + step.used * step.length * _PLACES for step in steps])
            z = np.concatenate([step.states(step.used * _PLACES) for step in steps], axis=1)
            times.append(t)
            values.append(leg.signals(names, t, z))
        return np.concatenate(times), np.concatenate(values, axis=1)

    def works(self) -> Works:
        """The energy balance, by Gauss's quadrature of the powers, at places of its own."""
        nodes, weights = gauss(_GAUSS)
        total, turned = np.zeros(len(WORKS)), np.zeros(len(WORKS))
        for leg, steps in self._fine.runs(0.0, self.end):
            t = np.concatenate([step.start + step.used * step.length * nodes for step in steps])
            z = np.concatenate([step.states(step.used * nodes) for step in steps], axis=1)
            spans = np.repeat([step.used * step.length for step in steps], _GAUSS)
            power = leg.powers(t, z) * spans * np.tile(weights, len(steps))
            total += power.sum(axis=1)
            turned += np.abs(power).sum(axis=1)
        sudden = np.array([self._fine.jerks[name] for name in WORKS])
        total, turned = total + sudden, turned + np.abs(sudden)
        first, last = self._fine.steps[0], self._fine.steps[-1]
        begins = first.leg.stored(np.array([first.start]), first.states(np.zeros(1)))
        ends = last.leg.stored(np.array([last.end]), last.states(np.array([last.used])))
        moving = max(float(begins[0][0]), float(ends[0][0]))
        change = float(ends[0][0] + ends[1][0] - begins[0][0] - begins[1][0])
        scale = max(float(turned.max()), moving, 1e-300)
        residual = abs(float(total.sum()) - change) / scale
        return Works(dict(zip(WORKS, total.tolist(), strict=True)), change, residual)

    def _extreme(self, name: str, sign: int, since: float, until: float) -> Peak:
        until = min(until, self.end)
        values = []
        for track in (self._fine, self._coarse):
            value, time, size = track.extreme(name, sign, since, min(until, track.steps[-1].end))
            values.append((track.polished(name, value, time, since, until), time, size))
        (one, time, size), (two, _, _) = values
        return Peak(one, time, abs(one - two) + _DUST * size)


def swing(case: Case, end: float, *, tolerance: float = TOLERANCE, most_steps: int = MOST_STEPS) -> Swing:
    """The motion from time 0 on.

    Args:
        case: what swings, and what moves its pivot.
        end: time to look until; a buffer that becomes solid ends it earlier [s].
        tolerance: largest tail of a step, of the angle in radians.
        most_steps: where a motion is given up.

    Returns:
        the motion.

    **Range** a taut rope without mass, a load as a point. A sudden change of the hoisting speed pulls the rope, but its
    jerk is no signal.
    **Error** told with every number: the difference of two runs, of tolerances 300 apart.
    **Source** equations of motion (`equations`), Radau collocation.

    Raises:
        NumericsError: NUM102 for a rope that goes slack or a case that cannot be; NUM101 or NUM103 for a motion that no
            step resolves, or too many.
    """
    _refuse(case, end)
    runs = [
        _March(case, end, tolerance * coarser, radau(order), most_steps).go()
        for coarser, order in ((1.0, _FINE), (_COARSER, _COARSE))
    ]
    fine, coarse = runs
    return Swing(case, min(fine.steps[-1].end, end), fine.events, bool(fine.finished), len(fine.steps), fine, coarse)


class _March:
    def __init__(self, case: Case, end: float, tolerance: float, rule: Rule, most_steps: int) -> None:
        self.case, self.end, self.tolerance, self.rule, self.most_steps = case, end, tolerance, rule, most_steps
        self.kept = kept_speed(case)
        self.omega = math.sqrt(case.gravity / float(case.load.length.at(0.0)))
        self.scale = self._scales()
        self.speeds = self.scale[SPEED]
        self.places = [buffer.place for buffer in case.axis.buffers]
        self.stage = self._first_stage()
        self.events: list[Event] = []
        self.jerks = dict.fromkeys(WORKS, 0.0)
        self.reach = _FIRST / self.omega
        self.inverse: tuple[Leg, float, FloatArray] | None = None
        self.to_panels = integrals(rule.order, _PLACES)
        self.eye = np.eye(rule.order * STATES)

    # --- the way ------------------------------------------------------------------------------------------------

    def go(self) -> _Track:
        time, state, finished = 0.0, self._start(), ""
        steps: list[_Step] = []
        still, mode = 0, None
        mode, state = self._choose(time, state, None, {})
        leg = self._leg(mode, time)
        while True:
            stop = min(self.end, self._next_break(time))
            step, fired = self._advance(leg, time, state, stop)
            steps.append(step)
            if len(steps) > self.most_steps:
                raise NumericsError("NUM103", f"more than {self.most_steps} steps by {time:.6g} s")
            still = still + 1 if step.end <= time * (1 + 4e-16) else 0
            if still > _MOST_AT_ONCE:
                raise NumericsError("NUM101", f"contacts change without end at {time:.6g} s")
            reached = step.used == 1.0 and time + step.length >= stop
            time = stop if reached and fired is None else step.end
            state = step.states(np.array([step.used]))[:, 0]
            self._normalise(state)
            if fired == "solid":
                finished = fired
                self._tell(time, "buffer", "pressed", "solid")
                break
            if fired is not None:
                before = mode
                mode, state = self._react(time, state, mode, fired)
                self._say(time, before, mode)
                leg = self._leg(mode, time)
            elif time >= self.end:
                break
            elif time >= stop:
                before = mode
                self._jerk(time, leg, state)
                mode, state = self._choose(time, state, mode, {})
                self._say(time, before, mode)
                leg = self._leg(mode, time)
        return _Track(steps, tuple(self.events), finished, [step.start for step in steps], self.jerks)

    def _jerk(self, time: float, leg: Leg, state: FloatArray) -> None:
        """A sudden change of the rope's or the radius' speed: the impulse in the rope, what it does to an axis that is
        free to give way, and its work, mean speeds times impulse."""
        case, n, mass = self.case, state[N], self.case.load.mass
        after = self._leg(leg.mode, time)
        arm, out = 1.0, 0.0
        rope = _rate(after.length, time) - _rate(leg.length, time)
        reel = _rate(after.length, time) + _rate(leg.length, time)
        if leg.radius is not None and after.radius is not None:
            arm = float(np.ravel(leg.radius(np.array([time])))[0])
            out = _rate(after.radius, time) - _rate(leg.radius, time)
        if abs(rope) + abs(out) <= _NOISE * (abs(reel) + abs(out)):
            return
        free = leg.mode.side != 0 and leg.mode.drive != KEEP
        pull = -rope - out * float(n[1])
        gear = case.axis.gear
        whole = case.axis.inertia + leg.factor * gear.rotor + mass * (arm * float(n[0])) ** 2
        change = mass * arm * float(n[0]) * pull / whole if free else 0.0
        impulse = mass * (pull - arm * float(n[0]) * change)
        pivot = np.array([arm * change, out, 0.0])
        length = float(case.load.length.at(time))
        state[W] -= (pivot - float(n @ pivot) * n) / length
        v = float(state[SPEED]) + change / 2
        state[SPEED] += change
        self.jerks["hoist"] -= impulse * reel / 2
        if leg.radius is not None and after.radius is not None:
            self.jerks["luff"] -= impulse * float(n[1]) * (_rate(after.radius, time) + _rate(leg.radius, time)) / 2
        self.jerks["gear"] -= (leg.factor - 1) * gear.rotor * change * v if free else 0.0
        self.jerks["motor"] -= 0.0 if free else impulse * float(n[0]) * arm * v

    def _advance(self, leg: Leg, time: float, state: FloatArray, stop: float) -> tuple[_Step, str | None]:
        """One step, up to the first event in it."""
        rule, left = self.rule, stop - time
        if left <= 0:
            return _Step(leg, time, 0.0, 1.0, state, np.zeros((STATES, rule.order))), None
        length = min(self.reach, _LONGEST / self.omega)
        if left <= 1.3 * length:
            length = left
        while True:
            row, tail = self._solve(leg, time, state, length)
            if row is not None and tail <= self.tolerance:
                break
            shrink = _FURTHER * (self.tolerance / tail) ** (1 / rule.order) if row is not None else 0.4
            length *= min(max(shrink, 0.2), 0.8)
            if length < _SHORTEST / self.omega:
                raise NumericsError("NUM101", f"the motion could not be resolved by any step at {time:.6g} s")
        assert row is not None
        grow = _FURTHER * (self.tolerance / max(tail, 1e-30)) ** (1 / rule.order)
        reach = length * min(max(grow, 0.3), 2.5)
        if length < left or reach < self.reach:
            self.reach = reach
        step = _Step(leg, time, length, 1.0, state, row)
        fired = self._first_event(step)
        if fired is None:
            return step, None
        share, name = fired
        return _Step(leg, time, length, share, state, row), name

    def _solve(self, leg: Leg, time: float, state: FloatArray, length: float) -> tuple[FloatArray | None, float]:
        """Legendre coefficients of the derivative over a step, and its tail."""
        rule, scale = self.rule, self.scale[:, None]
        times = time + length * rule.nodes
        first = leg.rate(np.array([time]), state[:, None])
        slopes = np.repeat(first, rule.order, axis=1)
        inverse = self._inverse(leg, time, state, length, first)
        before = math.inf
        for _ in range(_MOST_ITERATIONS):
            states = state[:, None] + length * (slopes @ rule.integral.T)
            miss = leg.rate(times, states) - slopes
            change = (inverse @ (miss / scale).ravel()).reshape(miss.shape) * scale
            slopes = slopes + change
            size = float(np.abs(change / scale).max()) * length
            if not math.isfinite(size) or size > 1e3:
                return None, math.inf
            if size <= 1e-3 * self.tolerance or (size >= 0.5 * before and size <= 0.1 * self.tolerance):
                row = slopes @ rule.to_legendre.T
                return row, float(rule.tail(row / scale).max()) * length
            if size > 2 * before and size > self.tolerance:
                return None, math.inf
            before = size
        return None, math.inf

    def _inverse(self, leg: Leg, time: float, state: FloatArray, length: float, first: FloatArray) -> FloatArray:
        """Of I - h A J in scaled variables, J by differences at the start; kept while the step stays."""
        kept = self.inverse
        if kept is not None and kept[0] is leg and abs(kept[1] - length) <= 0.02 * length:
            return kept[2]
        nudge = 1e-7 * self.scale
        shifted = np.repeat(state[:, None], STATES, axis=1) + np.diag(nudge)
        jacobian = (leg.rate(np.full(STATES, time), shifted) - first) / nudge
        jacobian = jacobian * self.scale / self.scale[:, None]
        inverse = np.linalg.inv(self.eye - length * np.kron(jacobian, self.rule.integral))
        self.inverse = leg, length, inverse
        return inverse

    # --- events -------------------------------------------------------------------------------------------------

    def _first_event(self, step: _Step) -> tuple[float, str] | None:
        states = step.state[:, None] + step.length * (step.row @ self.to_panels.T)
        names, values = self._guards(step.leg, step.start + step.length * _PLACES, states)
        sizes = np.abs(values).max(axis=1)
        noise = _NOISE * np.maximum(sizes, self._sizes(names))
        by_panel = values.reshape(len(names), _HALVES, panels.COUNT)
        controls = by_panel @ panels.TO_BERNSTEIN.T
        low = (controls < -noise[:, None, None]).any(axis=2)
        if not low.any():
            return None
        for half in range(_HALVES):
            found = []
            for k in np.flatnonzero(low[:, half]).tolist():
                place = panels.crossing(by_panel[k, half], float(noise[k]))
                if place is not None:
                    found.append((self._polished(step, names[k], (half + place) / _HALVES), names[k]))
            if found:
                share, name = min(found)
                return share, name
        return None

    def _polished(self, step: _Step, name: str, share: float) -> float:
        """A root of a guard on the step's polynomial itself, by the secant rule from that of the panel."""
        names = self._guards(step.leg, np.array([step.start]), step.state[:, None])[0]
        k = names.index(name)

        def value(x: float) -> float:
            at = np.array([x])
            return float(self._guards(step.leg, step.start + step.length * at, step.states(at))[1][k, 0])

        one = max(share - 1e-5, 0.0)
        two = share
        if one == two:
            return share
        f_one, f_two = value(one), value(two)
        for _ in range(4):
            if f_two == f_one:
                break
            following = two - f_two * (two - one) / (f_two - f_one)
            if not abs(following - share) <= 1e-5:
                break
            one, f_one, two = two, f_two, min(max(following, 0.0), 1.0)
            if two == one:
                break
            f_two = value(two)
        return two

    def _guards(self, leg: Leg, time: FloatArray, z: FloatArray) -> tuple[list[str], FloatArray]:
        """What stays at 0 or above as long as the mode holds."""
        mode, axis = leg.mode, self.case.axis
        now = leg.now(time, z)
        v, s = z[SPEED], z[POSITION]
        found: dict[str, FloatArray] = {"tension": leg.tension(now, z)}
        if mode.drive == KEEP:
            if math.isfinite(leg.limit):
                motor = leg.forces(time, z, now)[1]
                found["high"], found["low"] = leg.limit - motor, leg.limit + motor
            if mode.side:
                found["stop"] = mode.side * v
        else:
            if mode.side:
                if leg.sided:
                    found["stop"] = mode.side * v
                if leg.lossy:
                    into = leg.into_gear(time, z, now) * mode.side
                    found["gear"] = into if mode.forward else -into
            else:
                found["ahead"], found["back"] = leg.margins(time, z)
            if mode.drive in (HIGH, LOW):
                assert leg.kept is not None
                found["met"] = (leg.kept(time) - v) * (1 if mode.drive == HIGH else -1)
            elif mode.drive == LAW and isinstance(axis.drive, Push):
                if axis.drive.reaches is not None:
                    found["reached"] = (axis.drive.reaches - v) * self.approach
                if isinstance(axis.drive.law, Straight):
                    knots = axis.drive.law.knots
                    if mode.piece >= 0:
                        found["knot_down"] = v - knots[mode.piece]
                    if mode.piece + 1 < len(knots):
                        found["knot_up"] = knots[mode.piece + 1] - v
        for k, (buffer, met) in enumerate(zip(axis.buffers, mode.contacts, strict=True)):
            way = buffer.side * (s - self.places[k])
            if not met:
                found[f"buffer {k}"] = -way
            else:
                if buffer.law == LINEAR:
                    found[f"buffer {k}"] = way
                if math.isfinite(buffer.stroke):
                    found["solid"] = buffer.stroke - buffer.side * (s - buffer.place)
        return list(found), np.stack([np.zeros_like(v) + one for one in found.values()])

    def _sizes(self, names: list[str]) -> FloatArray:
        """What a guard is small against."""
        of = {"tension": self.weight, "stop": self.speeds, "met": self.speeds, "reached": self.speeds,
              "knot_down": self.speeds, "knot_up": self.speeds}  # fmt: skip
        return np.array([of.get(name, self.scale[POSITION] if name[:6] == "buffer" else self.force) for name in names])

    # --- what follows -------------------------------------------------------------------------------------------

    def _react(self, time: float, state: FloatArray, mode: Mode, fired: str) -> tuple[Mode, FloatArray]:
        if fired == "tension":
            raise NumericsError("NUM102", f"the rope goes slack at {time:.6g} s")
        forced: dict[str, object] = {}
        state = state.copy()
        if fired == "stop":
            state[SPEED] = 0.0
        elif fired in ("ahead", "back"):
            forced["side"] = 1 if fired == "ahead" else -1
        elif fired == "gear":
            forced["forward"] = not mode.forward
            forced["side"] = mode.side
        elif fired in ("high", "low"):
            forced["drive"] = HIGH if fired == "high" else LOW
            if mode.side:
                forced["side"] = mode.side
        elif fired in ("met", "reached"):
            state[SPEED] = self._kept(time)
            if fired == "reached":
                self.stage = KEEP if self._limit() > 0 else OFF
                self._tell(time, "drive", LAW, "speed reached")
        elif fired.startswith("knot"):
            forced["piece"] = mode.piece + (1 if fired == "knot_up" else -1)
            if mode.side:
                forced["side"] = mode.side
        elif fired.startswith("buffer"):
            k = int(fired.split()[1])
            met = not mode.contacts[k]
            forced["contacts"] = tuple(met if i == k else one for i, one in enumerate(mode.contacts))
            if mode.side:
                forced["side"] = mode.side
        return self._choose(time, state, mode, forced)

    def _choose(
        self, time: float, state: FloatArray, before: Mode | None, forced: dict[str, object]
    ) -> tuple[Mode, FloatArray]:
        """The mode that holds from now on."""
        axis = self.case.axis
        contacts = forced.get("contacts", before.contacts if before else self._first_contacts(state))
        assert isinstance(contacts, tuple)
        drive = forced.get("drive") or self._drive(time, state)
        assert isinstance(drive, str)
        at, z = np.array([time]), state[:, None]
        if drive == KEEP:
            state = state.copy()
            state[SPEED] = self._kept(time)
            z = state[:, None]
            mode = Mode(KEEP, 0, self._heading(time), True, contacts)
            if math.isfinite(self._limit()):
                leg = self._leg(mode, time)
                motor = float(leg.forces(at, z, leg.now(at, z))[1][0])
                if abs(motor) > self._limit() * (1 + _NOISE):
                    drive = HIGH if motor > 0 else LOW
            if drive == KEEP:
                return mode, state
        piece = -1
        if drive == LAW and isinstance(axis.drive, Push) and isinstance(axis.drive.law, Straight):
            piece = bisect_right(axis.drive.law.knots, float(state[SPEED])) - 1
            if "piece" in forced:
                assert isinstance(forced["piece"], int)
                piece = forced["piece"]
        side = forced.get("side")
        if side is None:
            side = self._side(time, state, Mode(drive, piece, 0, True, contacts))
        assert isinstance(side, int)
        contacts = self._released(state, side, contacts)
        if (
            piece >= 0
            and "piece" not in forced
            and isinstance(axis.drive, Push)
            and isinstance(axis.drive.law, Straight)
        ):
            leg = self._leg(Mode(drive, piece, side, True, contacts), time)
            slows = float(leg.now(at, z).acceleration[0]) < 0
            if state[SPEED] == axis.drive.law.knots[piece] and (slows or (side < 0 and state[SPEED] == 0)):
                piece -= 1
        mode = Mode(drive, piece, side, True, contacts)
        gear = axis.gear
        if side and (gear.forward != 1 or gear.reverse != 1):
            forward = forced.get("forward")
            if forward is None:
                leg = self._leg(mode, time)
                forward = float(leg.into_gear(at, z, leg.now(at, z))[0]) * side >= 0
            mode = mode._replace(forward=bool(forward))
        return mode, state

    def _below_knot(self, time: float, state: FloatArray, mode: Mode) -> int:
        """1 on a knot of the drive's law from which the motion goes down, else 0."""
        drive = self.case.axis.drive
        assert isinstance(drive, Push)
        assert isinstance(drive.law, Straight)
        if state[SPEED] != drive.law.knots[mode.piece]:
            return 0
        now = self._leg(mode, time).now(np.array([time]), state[:, None])
        return int(float(now.acceleration[0]) < 0 or (mode.side < 0 and state[SPEED] == 0))

    def _side(self, time: float, state: FloatArray, rest: Mode) -> int:
        """Sign of the motion that goes on; at rest, where friction does not hold it, where it is pushed to."""
        leg, v = self._leg(rest, time), float(state[SPEED])
        if not leg.sided:
            return 1
        if abs(v) > 1e-14 * self.speeds:
            return 1 if v > 0 else -1
        state[SPEED] = 0.0
        ahead, back = leg.margins(np.array([time]), state[:, None])
        noise = _NOISE * self.force
        if ahead[0] < -noise:
            return 1
        return -1 if back[0] < -noise else 0

    def _released(self, state: FloatArray, side: int, contacts: tuple[bool, ...]) -> tuple[bool, ...]:
        """Buffers that do not push back stay where they were pressed to."""
        kept = list(contacts)
        for k, buffer in enumerate(self.case.axis.buffers):
            if contacts[k] and buffer.law != LINEAR:
                self.places[k] = float(state[POSITION])
                kept[k] = side != -buffer.side
        return tuple(kept)

    def _first_contacts(self, state: FloatArray) -> tuple[bool, ...]:
        return tuple(buffer.side * (state[POSITION] - buffer.place) > 0 for buffer in self.case.axis.buffers)

    def _first_stage(self) -> str:
        drive = self.case.axis.drive
        self.approach = 1
        if isinstance(drive, Push):
            if drive.reaches is not None:
                self.approach = 1 if self.case.axis.speed < drive.reaches else -1
                if self.case.axis.speed == drive.reaches:
                    return KEEP if drive.limit > 0 else OFF
            return LAW
        return KEEP if drive is not None else OFF

    def _drive(self, time: float, state: FloatArray) -> str:
        drive = self.case.axis.drive
        if drive is None or time >= drive.until or self.stage == OFF:
            return OFF
        if self.stage == LAW:
            return LAW
        if isinstance(drive, Push) and not any(drive.gate.coefficients[drive.gate.piece(time)]):
            return OFF
        off = float(state[SPEED]) - self._kept(time)
        if abs(off) <= _NOISE * self.speeds:
            return KEEP
        if not math.isfinite(drive.limit):
            raise NumericsError("NUM102", f"a drive without a limit cannot take up a jump of its speed at {time:.6g} s")
        return HIGH if off < 0 else LOW

    def _kept(self, time: float) -> float:
        assert self.kept is not None
        return float(self.kept.at(time))

    def _heading(self, time: float) -> int:
        """Sign of the kept speed from now on, by its first derivative that is not 0."""
        assert self.kept is not None
        for k, c in enumerate(self.kept.around(time)):
            if abs(c) > _NOISE * self.speeds * self.omega**k:
                return 1 if c > 0 else -1
        return 0

    def _limit(self) -> float:
        drive = self.case.axis.drive
        return drive.limit if drive is not None else 0.0

    def _leg(self, mode: Mode, time: float) -> Leg:
        return Leg(self.case, mode, time, tuple(self.places), self.kept)

    def _next_break(self, time: float) -> float:
        case, axis = self.case, self.case.axis
        pieces = [
            case.load.length,
            case.load.wind_along,
            case.load.wind_across,
            axis.outer,
            axis.brake,
            axis.gear.brake,
        ]
        if isinstance(case.pivot, Jib):
            pieces.append(case.pivot.radius)
        if isinstance(axis.drive, Push):
            pieces.append(axis.drive.gate)
        if self.kept is not None:
            pieces.append(self.kept)
        breaks = [one.next_break(time) for one in pieces]
        if axis.drive is not None and axis.drive.until > time:
            breaks.append(axis.drive.until)
        return min(breaks)

    def _tell(self, time: float, element: str, before: str, after: str) -> None:
        self.events.append(Event(time, element, before, after))

    def _say(self, time: float, before: Mode, after: Mode) -> None:
        """What has changed."""
        if before.drive != after.drive:
            self._tell(time, "drive", before.drive, after.drive)
        if before.side != after.side:
            words = {0: "rest", 1: "forward", -1: "backward"}
            self._tell(time, "axis", words[before.side], words[after.side])
        for k, (one, two) in enumerate(zip(before.contacts, after.contacts, strict=True)):
            if one != two:
                self._tell(time, f"buffer {k}", "met" if one else "free", "met" if two else "free")

    # --- the start ----------------------------------------------------------------------------------------------

    def _scales(self) -> FloatArray:
        """Sizes of the states, of forces on the axis and of the rope's pull."""
        axis, load = self.case.axis, self.case.load
        arm = max((abs(c[0]) for c in self.case.pivot.radius.coefficients), default=1.0) if isinstance(
            self.case.pivot, Jib) else 1.0  # fmt: skip
        self.weight = load.mass * self.case.gravity
        drive, speeds, forces = axis.drive, [abs(axis.speed)], [axis.friction]
        for pieces in (axis.outer, axis.brake, axis.gear.brake):
            forces += [abs(c[0]) for c in pieces.coefficients]
        if isinstance(drive, Follow):
            speeds += [abs(c[0]) for c in drive.speed.coefficients]
        elif isinstance(drive, Push):
            speeds.append(abs(drive.reaches or 0.0))
            if isinstance(drive.law, Straight):
                forces += [abs(value) for value in drive.law.values]
            else:
                forces.append(abs(drive.law) if isinstance(drive.law, int | float) else drive.law.size)
        self.force = max([*forces, 1e-3 * self.weight * arm])
        if max(speeds) == 0:
            whole = axis.inertia + axis.gear.rotor
            speeds.append(max(forces) / (whole * self.omega) if whole > 0 else 0.0)
        speed = max([*speeds, _SWINGS * self.case.gravity / self.omega / arm])
        w = self.omega
        return np.array([speed / w, speed, 1.0, 1.0, 1.0, w, w, w])

    def _start(self) -> FloatArray:
        load, axis = self.case.load, self.case.axis
        g = Leg(self.case, Mode(OFF, 0, 0, True, (False,) * len(self.places)), 0.0, (), None).gravity(
            np.array([axis.position])
        )
        down = np.array([float(np.ravel(one)[0]) for one in g])
        along = load.along + math.atan2(down[0], -down[2])
        across = load.across + math.atan2(down[1], -down[2])
        if across == 0 == load.across_rate:
            n = np.array([math.sin(along), 0.0, -math.cos(along)])
            rate = load.along_rate * np.array([math.cos(along), 0.0, math.sin(along)])
        else:
            straight = np.array([math.tan(along), math.tan(across), -1.0])
            turned = np.array([load.along_rate / math.cos(along) ** 2, load.across_rate / math.cos(across) ** 2, 0.0])
            size = float(np.linalg.norm(straight))
            n = straight / size
            rate = (turned - n * float(n @ turned)) / size
        z = np.concatenate([[axis.position, axis.speed], n, rate])
        if isinstance(self.case.pivot, Jib):
            z[5] += axis.speed * n[1]
            z[6] -= axis.speed * n[0]
        return z

    @staticmethod
    def _normalise(state: FloatArray) -> None:
        """Back onto the sphere, from which rounding and the step have led a little."""
        n = state[N] / np.linalg.norm(state[N])
        state[N] = n
        state[W] -= float(n @ state[W]) * n


def _rate(held: Held, time: float) -> float:
    return float(np.ravel(held(np.array([time]), 1))[0])


def _refuse(case: Case, end: float) -> None:
    axis, load, gear = case.axis, case.load, case.axis.gear

    def refuse(when: bool, why: str) -> None:
        if when:
            raise NumericsError("NUM102", why)

    refuse(not (case.gravity > 0 and math.isfinite(case.gravity)), "a load does not swing without gravity")
    refuse(not (math.isfinite(end) and end > 0), "a motion ends at a time after 0")
    refuse(not load.mass > 0, "a load has a mass")
    refuse(load.length.jumps or not min(_values(load.length, end)) > 0, "a rope has a length, without jumps")
    refuse(not axis.inertia >= 0 or not gear.rotor >= 0, "an inertia is not below 0")
    refuse(not axis.inertia + gear.rotor > 0, "an axis has an inertia")
    refuse(not axis.friction >= 0, "friction is not below 0")
    refuse(not (0 < gear.forward <= 1 and 0 < gear.reverse <= 1), "a gear that locks itself does not swing")
    refuse(any(min(_values(one, end)) < 0 for one in (axis.brake, gear.brake)), "a brake holds nothing below 0")
    refuse(
        any(b.law not in (LINEAR, CONSTANT, ORIFICE) or b.side not in (1, -1) or not b.size > 0 for b in axis.buffers),
        "a buffer is linear, constant or an orifice, ahead or behind, and has a size",
    )
    refuse(isinstance(axis.drive, Straight), "a law belongs into a push")
    steep = max(abs(load.along), abs(load.across))
    plane = load.across == 0 == load.across_rate and isinstance(case.pivot, Rail)
    refuse(not plane and not steep < _STEEPEST, "angles at the start lie below a right one")
    refuse(isinstance(case.pivot, Jib) and case.pivot.radius.jumps, "a radius does not jump")
    if isinstance(axis.drive, Follow) and math.isinf(axis.drive.limit):
        first = float(axis.drive.speed.at(0.0))
        refuse(
            abs(first - axis.speed) > 1e-9 * max(abs(first), abs(axis.speed)),
            "an imposed speed starts at the axis's own",
        )
        refuse(axis.drive.speed.jumps, "an imposed speed does not jump")


def _values(pieces: Pieces, end: float) -> list[float]:
    starts = [start for start in pieces.starts if start < end]
    times = np.concatenate([np.linspace(a, b, 9) for a, b in zip(starts, [*starts[1:], end], strict=True)])
    return [float(x) for x in pieces.at(times[:-1])] + [float(pieces.within(pieces.piece(starts[-1]), end))]
