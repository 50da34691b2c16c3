"""What happens to a stacker crane, integrated from event to event by DOP853; nothing of ptmcalc is used here."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

_RTOL, _ATOL = 1e-11, 1e-13
State = np.ndarray
_HELD, _SLIPS = "held", "slips"


def _crossing(of: Callable[[State], float], direction: int) -> Callable[[float, State], float]:
    def event(_: float, y: State) -> float:
        return of(y)

    event.terminal, event.direction = True, direction  # type: ignore[attr-defined]
    return event


@dataclass(frozen=True)
class Caught:
    """A hoist whose fork is caught: drive, rope, carriage, rack; motor of a straight line, limiter and brake."""

    drive: float
    carriage: float
    weight: float
    rope: float
    rack: float
    speed: float
    force: float
    slope: float
    trips: float = math.inf
    reaction: float = 0.0
    brake: float = 0.0

    def motor(self, speed: float) -> float:
        return min(self.force, self.weight + self.slope * (self.speed - speed)) if self.slope else self.force

    def peaks(self, end: float) -> tuple[float, float]:
        """Largest forces of rope and rack until a time: phases between which nothing jumps."""
        y = np.array([0.0, 0.0, self.speed, self.speed])
        t, off, braked = 0.0, math.inf, False
        taut, touched = True, True
        best = [self.weight, 0.0]
        stuck = False
        while t < end:
            knee = self.speed - (self.force - self.weight) / self.slope if self.slope else -math.inf
            flat = bool(self.slope) and y[2] < knee

            def rope(y: State, taut: bool = taut) -> Any:
                return self.weight + self.rope * (y[0] - y[1]) if taut else 0.0 * y[0]

            def rack(y: State, touched: bool = touched) -> Any:
                return self.rack * y[1] if touched else 0.0 * y[1]

            way = 0 if stuck else (1 if y[2] > 0 else -1)

            def rate(_: float, y: State, way: int = way, flat: bool = flat, on: bool = not braked) -> list[float]:
                pull = 0.0
                if on:
                    pull = self.force if flat or not self.slope else self.weight + self.slope * (self.speed - y[2])
                pull -= rope(y) + (self.brake * way if not on else 0.0)
                force = 0.0 if not on and way == 0 else pull / self.drive
                return [y[2], y[3], force, (rope(y) - self.weight - rack(y)) / self.carriage]

            events = [
                _crossing(lambda y: self.weight + self.rope * float(y[0] - y[1]), -1 if taut else 1),
                _crossing(lambda y: float(y[1]), -1 if touched else 1),
            ]
            names = ["taut", "touched"]
            if math.isinf(off):
                events.append(_crossing(lambda y: rope(y) - self.trips, 1))
                names.append("trips")
            if self.slope and not braked and math.isfinite(knee):
                events.append(_crossing(lambda y: float(y[2]) - knee, 1 if flat else -1))  # noqa: B023
                names.append("knee")
            if braked and not stuck:
                events.append(_crossing(lambda y: float(y[2]), -way))
                names.append("stops")
            if stuck:
                events.append(_crossing(lambda y: abs(rope(y)) - self.brake, 1))
                names.append("slips")
            stop = min(end, off) if not braked else end
            run = solve_ivp(rate, (t, stop), y, method="DOP853", rtol=_RTOL, atol=_ATOL, events=events,
                            dense_output=True)  # fmt: skip
            best[0] = max(best[0], self._top(run, rope))
            best[1] = max(best[1], self._top(run, rack))
            t, y = float(run.t[-1]), run.y[:, -1].copy()
            hit = next((name for name, times in zip(names, run.t_events, strict=True) if len(times)), None)
            if hit is None:
                if t >= end:
                    break
                braked = True
                continue
            if hit == "taut":
                taut = not taut
            elif hit == "touched":
                touched = not touched
            elif hit == "trips":
                off = t + self.reaction
                if not self.reaction:
                    braked = True
            elif hit == "stops":
                y[2] = 0.0
                stuck = rope(y) <= self.brake
                if not stuck:
                    y[2] = -1e-15
            elif hit == "slips":
                stuck, y[2] = False, -1e-15
        return best[0], best[1]

    @staticmethod
    def _top(run: Any, of: Callable[[State], Any]) -> float:
        """Largest value of a signal in a phase: the best of many samples, again and again between its neighbours."""
        low, high = run.t[0], run.t[-1]
        for count in (max(401, 40 * len(run.t)), *5 * (401,)):  # of many peaks alike the tallest
            times = np.linspace(low, high, count)
            values = of(run.sol(times))
            k = int(np.argmax(values))
            low, high = times[max(k - 1, 0)], times[min(k + 1, count - 1)]
        return float(values.max())


def pushed(mass: float, carriage: float, rack: float, support: float, speed: float, force: float, end: float) -> float:
    """Largest force of a fork on the rack whose carriage leans on a spring; the fork may leave the rack."""
    y, t, touched, best = np.array([0.0, 0.0, speed, 0.0]), 0.0, True, 0.0
    longest = 0.3 / math.sqrt(rack / mass + (rack + support) / carriage)  # its peaks are read between the steps

    while t < end:

        def rate(_: float, y: State, on: bool = touched) -> list[float]:
            push = rack * (y[0] - y[1]) if on else 0.0
            return [y[2], y[3], (force - push) / mass, (push - support * y[1]) / carriage]

        leaves = _crossing(lambda y: float(y[0] - y[1]), -1 if touched else 1)
        run = solve_ivp(rate, (t, end), y, method="DOP853", rtol=_RTOL, atol=_ATOL, events=leaves, dense_output=True,
                        max_step=longest)  # fmt: skip
        if touched:
            best = max(best, Caught._top(run, lambda y: rack * (y[0] - y[1])))
        t, y, touched = float(run.t[-1]), run.y[:, -1].copy(), not touched
        if t < end and not len(run.t_events[0]):
            break
    return best


def caught_carriage(
    speed: float, ratio: float, reaction: float, mass: float, force: float, stiffness: float, gravity: float = 9.81
) -> tuple[float, float, float, float]:
    """Fall and catch: (speed as the gear holds, way of the fall, way of the catch, force at its end)."""
    tripped = _crossing(lambda y: float(y[1]) - ratio * speed, 1)
    fall = solve_ivp(lambda t, y: [y[1], gravity], (0, 10), [0, speed], rtol=_RTOL, atol=_ATOL, events=tripped)
    on = solve_ivp(
        lambda t, y: [y[1], gravity], (0, reaction), fall.y[:, -1], rtol=_RTOL, atol=_ATOL
    ) if reaction else fall  # fmt: skip
    way, begins = (float(one) for one in on.y[:, -1])
    rests = _crossing(lambda y: float(y[1]), -1)
    stop = solve_ivp(
        lambda t, y: [y[1], gravity - (force + stiffness * y[0]) / mass],
        (0, 60), [0, begins], method="DOP853", rtol=_RTOL, atol=1e-14, events=rests,
    )  # fmt: skip
    deep = float(stop.y[0, -1])
    return begins, way, deep, force + stiffness * deep


def rolled(
    frequency: float, speed: float, radius: float, step: float, gravity: float, up: bool, end: float
) -> tuple[float, float]:
    """Largest and least wheel load over the static one, as a wheel that may leave the rail climbs a step."""
    lasts = math.sqrt(2 * step * radius) / speed
    size, rate_of = (math.pi / 2 * speed) ** 2 / radius * (1 if up else -1), math.pi / lasts
    y, t, on, high, low = np.array([-gravity / frequency**2, 0.0]), 0.0, True, 1.0, 1.0
    while t < end:

        def rate(t: float, y: State, on: bool = on) -> list[float]:
            moved = size * math.cos(rate_of * t) if t < lasts else 0.0
            return [y[1], (-(frequency**2) * y[0] if on else 0.0) - gravity - moved]

        stop = lasts if t < lasts else end
        leaves = _crossing(lambda y: float(y[0]), 1 if on else -1)
        run = solve_ivp(rate, (t, stop), y, method="DOP853", rtol=_RTOL, atol=_ATOL, events=leaves, dense_output=True,
                        max_step=lasts / 7)  # fmt: skip
        if on:
            high = max(high, Caught._top(run, lambda y: -(frequency**2) * y[0] / gravity))
            low = min(low, -Caught._top(run, lambda y: frequency**2 * y[0] / gravity))
        t, y = float(run.t[-1]), run.y[:, -1].copy()
        if len(run.t_events[0]):
            on = not on
        elif t == lasts:
            t = math.nextafter(t, math.inf)
    return high, max(low, 0.0)


def tilted(
    frequency: float, driven: float, base: float, speed: float, radius: float, step: float, gap: float, end: float
) -> float:
    """Largest swing of a column's mode over a base whose wheels run over a step, or a gap, one after the other."""
    way = gap or math.sqrt(2 * step * radius)
    lasts, turns, side = way / speed, 2 if gap else 1, -1.0 if gap else 1.0
    size = side * driven * (math.pi / 2 * speed) ** 2 / radius / base
    y, best = np.zeros(2), 0.0
    corners = [0.0, lasts, base / speed, base / speed + lasts, base / speed + lasts + end]
    for begin, stop, sign in zip(corners, corners[1:], (-1.0, 0.0, 1.0, 0.0), strict=False):

        def rate(t: float, y: State, begin: float = begin, sign: float = sign) -> list[float]:
            push = sign * size * math.cos(turns * math.pi * (t - begin) / lasts)
            return [y[1], push - frequency**2 * y[0]]

        run = solve_ivp(rate, (begin, stop), y, method="DOP853", rtol=_RTOL, atol=1e-15, dense_output=True)
        best = max(best, Caught._top(run, lambda y: np.abs(y[0])))
        y = run.y[:, -1]
    return best
