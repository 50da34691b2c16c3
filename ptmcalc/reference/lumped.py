"""A train integrated by eighth-order Runge-Kutta steps (scipy's DOP853) from event to event: a reference.

An event is bracketed on a grid inside every step by the step's own polynomial, and met again by a step of its own.
What differs between a run and one of a hundredth of its tolerance is the larger one's error.
"""

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.train.parts import Train
from ptmcalc.reference.friction import Friction, Rest
from ptmcalc.reference.law_pieces import piece_of
from ptmcalc.reference.lumped_history import Happened, History, summit, turns
from ptmcalc.reference.mechanism import Equations, Mechanism
from ptmcalc.reference.mechanism_coordinates import OPEN, FloatArray, State
from ptmcalc.reference.mechanism_inputs import Inputs

TOLERANCES = (1e-6, 1e-8, 1e-10)
_SAMPLES = np.linspace(0.0, 1.0, 9)
_CLOSER = 41
_BOOLE = np.array([7, 32, 12, 32, 14, 32, 12, 32, 7]) * 4 / 45 / 8 / 2
_MOST_EVENTS = 400
_MOST_STEPS = 12_000
_MOST_AT_ONCE = 60
"""Events at one time, after which something chatters."""
_STICKS = 1e-9


def simulate(train: Train, end: float, tolerance: float) -> History:
    """The motion of a train from time 0 to `end`.

    Raises:
        NumericsError: no state of friction fits, or too many events or steps.
    """
    return _Run(train, tolerance).go(end)


def twice(train: Train, end: float, level: int) -> tuple[History, History]:
    """Two runs of a train, the second with a hundredth of the tolerance of the first."""
    return simulate(train, end, TOLERANCES[level]), simulate(train, end, TOLERANCES[level + 1])


class _Run:
    def __init__(self, train: Train, tolerance: float) -> None:
        self.train, self.tolerance = train, tolerance
        self.one = Mechanism(train)
        self.friction = Friction(self.one)
        signals = self.one.signals
        waves = [sine.frequency for signal in signals for sine in signal.sines]
        self.longest = 2.0 / max(waves, default=1e-9)
        self.history = History(self.one, squares=np.zeros(len(train.drives)))
        self.inside = 0.0
        self.sizes = [0.0, 0.0]

    # -- from event to event ---------------------------------------------------------------------------------------

    def go(self, end: float) -> History:
        one, history = self.one, self.history
        y = np.zeros(2 * one.count)
        for b, body in enumerate(self.train.bodies):
            if body.speed:
                y[one.count + one.of[b]] = body.speed / one.ratio[b]
        t, state = 0.0, self._first(y)
        y, state = self._struck(t, y, state)
        self._enter(t, end, state)
        state = self._start(t, y, state, self._rest(y, None))
        self._seen(t, y, state, history.first)
        at_once = crossed = 0
        while t < end:
            stop = min([end, *(time for time in one.breaks(state) if time > t)])
            since = t
            t, y, fired = self._advance(t, y, stop, state)
            at_once = at_once + 1 if t <= since else 0
            if at_once > _MOST_AT_ONCE:
                raise NumericsError("NUM101", f"the second method meets a chattering contact at {t:.6g} s")
            crossed += fired is not None
            if max(len(history.events), crossed) > _MOST_EVENTS:  # a mesh that turns its torque again and again
                raise NumericsError("NUM101", f"the second method meets more than {_MOST_EVENTS} events")
            before = state
            rest, ahead = self._rest(y, state), None
            if fired is None:
                state = self._staged(t, y, state)
                y, state = self._struck(t, y, state)
                rest = self._rest(y, state)
            else:
                y, state, rest, ahead = self._fired(t, y, state, fired)
            self._enter(t, end, state)
            state = self._start(t, y, state, rest, ahead)
            self._noted(t, before, state)
            waiting = any(time > t for time in one.breaks(state))
            if self.train.rest_ends and all(turn == 0 for turn in state.turning) and not waiting:
                break
        history.time, history.turning = t, state.turning
        self._seen(t, y, state, history.last)
        return history

    def _first(self, y: FloatArray) -> State:
        one = self.one
        started = tuple(None if signal.trigger else 0.0 for signal in one.signals)
        speeds = y[one.count :]
        slips = []
        for k in one.clutches:
            grip = self.train.grips[k]
            slips.append(int(np.sign(one.group_row(grip.first, grip.second) @ speeds)))
        return State(
            branches=tuple(("full", 0) if spring.law == "linear" else OPEN for spring in self.train.springs),
            turning=tuple(int(np.sign(speeds[g])) if one.rough[g] else None for g in range(one.count)),
            slips=tuple(slips),
            meshes=(1,) * len(one.lossy),
            drives=tuple((0, self._piece(drive.body, drive.stages[0].law, y)) for drive in self.train.drives),
            started=started,
        )

    def _piece(self, body: int, law: object, y: FloatArray) -> int:
        one = self.one
        group, ratio = one.of[body], one.ratio[body]
        return piece_of(law, ratio * y[one.count + group], one.origin[body] + ratio * y[group])

    def _enter(self, t: float, end: float, state: State) -> None:
        after = min([end, *(time for time in self.one.breaks(state) if time > t)])
        self.inside = (t + after) / 2

    def _inputs(self, state: State) -> Inputs:
        return self.one.inputs(state, self.inside).gated(self.inside)

    def _wide(self, t: float, y: FloatArray, state: State) -> FloatArray:
        return self._inputs(state).wide(t, y)

    def _rest(self, y: FloatArray, state: State | None) -> Rest:
        """What stands still; what is held does so whatever rounding says."""
        one = self.one
        speeds = y[one.count :]
        largest = float(np.abs(speeds).max(initial=0.0))
        groups = [abs(speed) <= 1e-13 * largest for speed in speeds]
        clutches = []
        for k in one.clutches:
            grip = self.train.grips[k]
            clutches.append(abs(float(one.group_row(grip.first, grip.second) @ speeds)) <= 1e-13 * largest)
        if state is not None:
            groups = [turn == 0 or (still and turn is None) for still, turn in zip(groups, state.turning, strict=True)]
            clutches = [slip == 0 for slip in state.slips]  # what has just begun to slip is slow, but slips
        return Rest(tuple(groups), tuple(clutches))

    def _start(
        self, t: float, y: FloatArray, state: State, rest: Rest, ahead: tuple[float, FloatArray] | None = None
    ) -> State:
        soon, later = ahead or (t, y)
        for _ in range(4):
            before = state
            state = self.friction.decide(state, self._wide(soon, later, state), rest, self.inside)
            state = self.friction.settle(state, self._wide(t, y, state), self.inside)
            if state == before:
                break
        return state

    def _staged(self, t: float, y: FloatArray, state: State) -> State:
        """Stages that end by time."""
        drives = list(state.drives)
        for k, (drive, (number, _)) in enumerate(zip(self.train.drives, state.drives, strict=True)):
            until = drive.stages[number].until_time
            if until is not None and until <= t and number + 1 < len(drive.stages):
                drives[k] = (number + 1, self._piece(drive.body, drive.stages[number + 1].law, y))
        return state._replace(drives=tuple(drives))

    def _struck(self, t: float, y: FloatArray, state: State) -> tuple[FloatArray, State]:
        """Impulses that strike at this time."""
        one = self.one
        for impulse in self.train.impulses:
            group = one.of[impulse.body]
            if impulse.time == t and group not in one.guided:
                y = y.copy()
                y[one.count + group] += impulse.size * one.ratio[impulse.body] / one.weights[group]
                state = self._turned(y, state, [group])
        return y, state

    def _fired(
        self, t: float, y: FloatArray, state: State, fired: int
    ) -> tuple[FloatArray, State, Rest, tuple[float, FloatArray] | None]:
        one, now = self.one, self.one.equations(state, self.inside)
        if fired < 0:
            return y, state, self._rest(y, state), self._overcome(t, y, state)
        exit_ = now.exits[fired]
        rest, ahead = self._rest(y, state), None
        if exit_.kind == "link":
            assert exit_.to is not None
            y, state = self._linked(y, state, exit_.index, (str(exit_.to[0]), exit_.to[1]))
            rest = self._rest(y, state)
        elif exit_.kind == "drive":
            assert exit_.to is not None
            number, piece = exit_.to
            assert isinstance(number, int)
            drive, drives = self.train.drives[exit_.index], list(state.drives)
            if number != drives[exit_.index][0]:
                piece = self._piece(drive.body, drive.stages[number].law, y)
            drives[exit_.index] = (number, piece)
            state = state._replace(drives=tuple(drives))
        elif exit_.kind == "signal":
            started = list(state.started)
            started[exit_.index] = t
            state = state._replace(started=tuple(started))
        elif exit_.kind == "turning":
            y[one.count + exit_.index] = 0.0
            still = Rest(tuple(g == exit_.index or held for g, held in enumerate(rest.groups)), rest.clutches)
            rest = self._meeting(y, state, still)
        elif exit_.kind == "slip":
            grip = self.train.grips[exit_.index]
            row = one.group_row(grip.first, grip.second)
            movable = [g for g in np.flatnonzero(row) if g not in one.guided] or list(np.flatnonzero(row))
            moved = max(movable, key=lambda g: abs(y[one.count + g]))
            y[one.count + moved] -= float(row @ y[one.count :]) / row[moved]
            place = one.clutches.index(exit_.index)
            rest = Rest(rest.groups, tuple(k == place or still for k, still in enumerate(rest.clutches)))
        elif exit_.kind == "mesh":
            signs = list(state.meshes)
            signs[exit_.index] *= -1
            state = state._replace(meshes=tuple(signs))
        else:
            ahead = self._overcome(t, y, state)
        return y, state, rest, ahead

    def _meeting(self, y: FloatArray, state: State, rest: Rest) -> Rest:
        """What stands still, with the clutches whose sides have come to the same speed by that."""
        one, speeds = self.one, y[self.one.count :]
        clutches = []
        for k, still in zip(one.clutches, rest.clutches, strict=True):
            row = one.group_row(self.train.grips[k].first, self.train.grips[k].second)
            apart = abs(float(row @ speeds)) <= 1e-13 * float(np.abs(row) @ np.abs(speeds))
            clutches.append(still or apart)
        return Rest(rest.groups, tuple(clutches))

    def _turned(self, y: FloatArray, state: State, groups: list[int]) -> State:
        """Directions after a blow; clutches slip as the speeds are then."""
        one, turning = self.one, list(state.turning)
        speeds = y[one.count :]
        for group in groups:
            if turning[group] is not None:
                turning[group] = int(np.sign(speeds[group]))
        slips = []
        for k in one.clutches:
            row = one.group_row(self.train.grips[k].first, self.train.grips[k].second)
            apart = float(row @ speeds)
            slips.append(int(np.sign(apart)) if abs(apart) > 1e-13 * float(np.abs(row) @ np.abs(speeds)) else 0)
        return state._replace(turning=tuple(turning), slips=tuple(slips))

    def _linked(self, y: FloatArray, state: State, k: int, to: tuple[str, int]) -> tuple[FloatArray, State]:
        """A link on its next branch; a rigid one is struck."""
        one, branches = self.one, list(state.branches)
        branches[k] = to
        if to[0] == "shut":
            row = one.rows[k]
            mobile = np.array([0.0 if g in one.guided else 1.0 / one.weights[g] for g in range(one.count)])
            if any(name == "shut" for name, _ in state.branches):
                raise NumericsError("NUM101", "the second method does not follow impacts of several bodies at once")
            closing = float(row @ y[one.count :])
            rebound = self.train.springs[k].restitution
            if abs(closing) * rebound <= _STICKS * float(np.abs(row) @ np.abs(y[one.count :])):
                rebound = 0.0
            y = y.copy()
            y[one.count :] -= (1 + rebound) * closing * mobile * row / float(mobile @ row**2)
            state = self._turned(y, state, np.flatnonzero(row).tolist())
            if rebound:
                branches[k] = OPEN
        return y, state._replace(branches=tuple(branches))

    def _overcome(self, t: float, y: FloatArray, state: State) -> tuple[float, FloatArray]:
        """A moment so soon after friction is overcome that nothing has moved, and forces tell what will."""
        one, now = self.one, self.one.equations(state, self.inside)
        inputs = self._inputs(state)
        rate = _rate(one, now, inputs.wide(t, y))
        step = 1e-10 * max(t, 1.0)
        while step < 1e-2:
            later = y + step * rate
            w = inputs.wide(t + step, later)
            broken = self.friction.spare(state, w, self.inside) < -1e-7
            broken |= any(
                float(e.row @ w) < -1e-7 * float(np.abs(e.row) @ np.abs(w)) for e in now.exits if e.kind == "hold"
            )
            if broken:
                return t + step, later
            step *= 4
        return t, y

    def _noted(self, t: float, before: State, after: State) -> None:
        """What has changed, as events."""
        events = self.history.events
        for kind, old, new in (
            ("link", before.branches, after.branches),
            ("turning", before.turning, after.turning),
            ("slip", before.slips, after.slips),
            ("drive", before.drives, after.drives),
            ("signal", before.started, after.started),
        ):
            for k, (one, other) in enumerate(zip(old, new, strict=True)):
                if one != other:
                    events.append(Happened(t, kind, k, other))

    # -- one interval ----------------------------------------------------------------------------------------------

    def _advance(self, t: float, y: FloatArray, stop: float, state: State) -> tuple[float, FloatArray, int | None]:
        """On to the first event, or to `stop`; -1 where friction at rest is overcome."""
        from scipy.integrate import DOP853

        one, now, inputs = self.one, self.one.equations(state, self.inside), self._inputs(state)
        count, matrix = one.count, now.acceleration

        def rates(time: float, at: FloatArray) -> FloatArray:
            return np.concatenate([at[count:], matrix @ inputs.wide(time, at)])

        rows = np.array([e.row for e in now.exits]).reshape(-1, one.width)
        holds = any(turn == 0 and g not in one.guided for g, turn in enumerate(state.turning))
        small = self._small(y)
        solver = DOP853(rates, t, y, stop, rtol=self.tolerance, atol=small, max_step=self.longest)
        watched, names = self._watched(state, now)
        squares = slice(len(names) - len(self.train.drives), len(names))
        speeds = np.array([exit_.kind in ("turning", "slip") for exit_ in now.exits], dtype=bool)
        sizes = np.where(speeds, np.abs(rows).sum(axis=1) * self.sizes[1], 0.0)  # next to the fastest so far
        while solver.status == "running":
            solver.step()
            self.history.steps += 1
            if solver.status == "failed" or self.history.steps > _MOST_STEPS:
                raise NumericsError("NUM101", "the second method takes too many steps")
            dense, start, span = solver.dense_output(), float(solver.t_old), float(solver.t - solver.t_old)
            times = start + _SAMPLES * span
            states = dense(times)
            w = inputs.columns(times, states)
            values = rows @ w
            sizes = np.maximum(sizes, (np.abs(rows) @ np.abs(w)).max(axis=1, initial=0.0))
            hit = self._first_hit(values, sizes, times, rows, inputs, dense)
            if holds and (hit is None or hit[0] > start):
                hit = self._let_go(state, inputs, dense, times, w, hit)
            until = hit[0] if hit is not None else float(solver.t)
            if hit is not None:
                times = start + _SAMPLES * (until - start)
                w = inputs.columns(times, dense(times))
            self._watch(names, watched, times, w, inputs, dense, squares)
            if hit is not None:
                row = rows[hit[1]] if hit[1] >= 0 else None
                return *self._met(rates, start, dense(start), until, row, inputs), hit[1]
        return stop, np.array(solver.y), None

    def _first_hit(
        self, values: FloatArray, sizes: FloatArray, times: FloatArray, rows: FloatArray, inputs: Inputs, dense: Any
    ) -> tuple[float, int] | None:
        """The first row that falls below 0, and when."""
        below = values < -1e-13 * sizes[:, None]
        best: tuple[float, int] | None = None
        for k in np.flatnonzero(below[:, 1:].any(axis=1)):
            first = int(np.argmax(below[k, 1:])) + 1
            left, right = float(times[first - 1]), float(times[first])
            if values[k, first - 1] <= 0:
                at = left
            else:
                row = rows[k]
                at = _root(lambda s, row=row: float(row @ inputs.wide(s, dense(s))), left, right)  # type: ignore[misc]
            if best is None or at < best[0]:
                best = (at, int(k))
        return best

    def _let_go(
        self, state: State, inputs: Inputs, dense: Any, times: FloatArray, w: FloatArray, hit: tuple[float, int] | None
    ) -> tuple[float, int] | None:
        """The same, with the moment at which friction at rest is overcome, if it comes first."""
        for k in range(1, len(times)):
            if hit is not None and times[k - 1] >= hit[0]:
                break
            if self.friction.spare(state, w[:, k], self.inside) < -1e-9:
                left, right = float(times[k - 1]), float(times[k])

                def left_over(s: float) -> float:
                    return self.friction.spare(state, inputs.wide(s, dense(s)), self.inside)

                at = left if left_over(left) <= 0 else _root(left_over, left, right)
                return (at, -1) if hit is None or at < hit[0] else hit
        return hit

    def _met(
        self, rates: Any, start: float, y: FloatArray, at: float, row: FloatArray | None, inputs: Inputs
    ) -> tuple[float, FloatArray]:
        """Time and state of an event, by steps of their own and Newton's method from there."""
        from scipy.integrate import solve_ivp

        state = np.array(y)
        if at > start:
            found = solve_ivp(
                rates, (start, at), y, method="DOP853", rtol=self.tolerance, atol=self._small(np.array(y))
            )
            state = np.asarray(found.y[:, -1], float)
        if row is None:
            return at, state
        step = 1e-6 * (at - start)
        for _ in range(2 if step > 0 else 0):
            rate = rates(at, state)
            ahead, back = (row @ inputs.wide(at + way * step, state + way * step * rate) for way in (1, -1))
            slope = float(ahead - back) / (2 * step)
            change = -float(row @ inputs.wide(at, state)) / slope if slope else 0.0
            if not abs(change) < 1e-3 * (at - start):
                break
            state, at = state + change * rate, at + change
        return at, state

    def _small(self, y: FloatArray) -> FloatArray:
        """What an error may come to of a state that is next to 0: a share of the largest travel or speed so far."""
        count = self.one.count
        here = [float(np.abs(part).max(initial=0.0)) for part in (y[:count], y[count:])]
        self.sizes = [max(one, other) for one, other in zip(self.sizes, here, strict=True)]
        shares = [1e-2 * self.tolerance * (size or max(*self.sizes, 1e-9)) for size in self.sizes]
        return np.repeat(shares, count)

    # -- what is watched -------------------------------------------------------------------------------------------

    def _watched(self, state: State, now: Equations) -> tuple[FloatArray, list[tuple[str, int]]]:
        one, train = self.one, self.train
        names: list[tuple[str, int]] = []
        rows: list[FloatArray] = []
        for b in range(one.count_bodies):
            held = state.turning[one.of[b]] == 0
            names += [("speed", b), ("position", b)]
            rows += [0 * one.one if held else one.body_speed(b), one.body_position(b)]
        pushes = {which: row for (what, which), row in zip(now.holds, now.holding, strict=True) if what == "contact"}
        for k in range(len(train.springs)):
            names.append(("link", k))
            rows.append(-pushes[k] if k in pushes else now.links[k])
        for k in range(len(train.meshes)):
            names.append(("mesh", k))
            rows.append(now.mesh[k])
        for k in range(len(train.drives)):
            names.append(("drive", k))
            rows.append(now.torques[k])
        return np.array(rows), names

    def _seen(self, t: float, y: FloatArray, state: State, into: dict[tuple[str, int], float]) -> None:
        rows, names = self._watched(state, self.one.equations(state, self.inside))
        values = rows @ self._wide(t, y, state)
        into.update(zip(names, values.tolist(), strict=True))
        for name, value in zip(names, values.tolist(), strict=True):
            self.history.highest[name] = max(self.history.highest.get(name, -math.inf), value)
            self.history.lowest[name] = min(self.history.lowest.get(name, math.inf), value)

    def _watch(
        self,
        names: list[tuple[str, int]],
        rows: FloatArray,
        times: FloatArray,
        w: FloatArray,
        inputs: Inputs,
        dense: Any,
        squares: slice,
    ) -> None:
        """Extremes between two times: of samples, and where they turn of a parabola through much closer ones."""
        values, history = rows @ w, self.history
        history.squares += (values[squares] ** 2) @ _BOOLE * (times[-1] - times[0])
        for sign, best in ((1, history.highest), (-1, history.lowest)):
            heights = sign * values
            tops = heights.max(axis=1)
            steep = np.abs(np.diff(heights, axis=1)).max(axis=1)
            known = sign * np.array([best.get(name, -sign * math.inf) for name in names])
            for k in np.flatnonzero(tops + steep > known):
                row, top = heights[k], float(tops[k])
                index = min(max(int(row.argmax()), 1), len(times) - 2)
                if turns(row[index - 1 : index + 2]):
                    near = np.linspace(times[index - 1], times[index + 1], _CLOSER)
                    closer = sign * (rows[k] @ inputs.columns(near, dense(near)))
                    middle = min(max(int(closer.argmax()), 1), len(near) - 2)
                    top = max(top, float(closer.max()), summit(closer[middle - 1 : middle + 2]))
                if top > known[k]:
                    best[names[k]] = sign * top


def _rate(one: Mechanism, now: Equations, w: FloatArray) -> FloatArray:
    return np.concatenate([w[one.count : 2 * one.count], now.acceleration @ w])


def _root(f: Callable[[float], float], left: float, right: float) -> float:
    from scipy.optimize import brentq

    return float(brentq(f, left, right, xtol=1e-15, rtol=1e-14))
