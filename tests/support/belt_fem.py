"""Finite elements of a whole belt with drums that slip, brakes and idlers that stick: an independent reference.

Imports nothing from `ptmcalc`. Lumped masses and springs in equal steps of travel time, central differences in time at
half the limit of stability (so waves disperse a little, which characteristics do not). Coulomb friction is never
smoothed: at an idler the return map v = sgn v* max(|v*| - W dt/m, 0) gives the impulse that holds or slides; at a
place with drums every combination of sticking and slipping, moving and held is solved as a small linear system until
one agrees with its own inequalities (Moreau's time stepping). Drums stand in the order in which the belt meets them.

Nodes 0 and -1 are at the head: one point where the loop is closed, two with a weight that takes up between them.
Half an element's friction beside head and tail goes to the next node within.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import product

import numpy as np

COURANT = 0.5
_ROUNDING = 1e-9


def no_pull(time: float, speed: float) -> float:
    """A drum without a motor."""
    return 0.0


def no_hold(time: float) -> float:
    """A drum without a brake."""
    return 0.0


@dataclass(frozen=True)
class Length:
    """A uniform length of belt: m, kg/m, N, and friction N/m, drag N*s/m^2, climb N/m."""

    length: float
    line_mass: float
    stiffness: float
    friction: float = 0.0
    climb: float = 0.0
    drag: float = 0.0


@dataclass(frozen=True)
class Roller:
    """A drum: rim mass, rim force over time and speed, brake over time, grip exponent, and whether it may turn back.

    Its motor holds it at `rated` speed once it has it, for as long as it is switched on; motors of one place, whose
    drums stick, then share what the belt asks as their `strength`.
    """

    mass: float
    pull: Callable[[float, float], float] = no_pull
    hold: Callable[[float], float] = no_hold
    exponent: float | None = None
    one_way: bool = False
    rated: float = math.inf
    strength: float = 1.0


@dataclass(frozen=True)
class Plan:
    """A belt: lengths from the head's run-off on, the tail after so many, drums, take-up (tension, mass) or None."""

    lengths: tuple[Length, ...]
    tail_after: int
    head: tuple[Roller, ...]
    tail: tuple[Roller, ...] = ()
    takeup: tuple[float, float] | None = None
    head_speed: Callable[[float], float] | None = None
    tail_speed: Callable[[float], float] | None = None
    belt_line_mass: float = 0.0


@dataclass
class Spot:
    """What a place with drums did, at the samples of time."""

    on: list[float] = field(default_factory=list)
    off: list[float] = field(default_factory=list)
    between: list[list[float]] = field(default_factory=list)
    belt: list[float] = field(default_factory=list)
    drums: list[list[float]] = field(default_factory=list)
    slips: list[tuple[int, ...]] = field(default_factory=list)
    slid: np.ndarray = field(default_factory=lambda: np.zeros(0))
    heat: np.ndarray = field(default_factory=lambda: np.zeros(0))

    def at(self, name: str, times: np.ndarray, when: np.ndarray) -> np.ndarray:
        """A history at given times."""
        return np.interp(when, times, np.asarray(getattr(self, name), float))


@dataclass
class Motion:
    """Histories at head and tail, speed behind the take-up, extremes and last tensions of every element, and how far
    every node went from where it was."""

    times: np.ndarray
    head: Spot
    tail: Spot
    behind: np.ndarray
    highest: np.ndarray
    lowest: np.ndarray
    last: np.ndarray
    tail_element: int
    farthest: np.ndarray


class _Place:
    """Drums at one point of the belt: speeds after a step from the tensions before it."""

    def __init__(
        self, rollers: Sequence[Roller], speed: float, imposed: Callable[[float], float] | None, line_mass: float
    ) -> None:
        self.rollers, self.imposed, self.line_mass = tuple(rollers), imposed, line_mass
        n, whole = len(self.rollers), sum(roller.strength for roller in rollers)
        self.shares = [roller.strength / whole for roller in self.rollers]
        self.rated = max((roller.rated for roller in self.rollers), default=math.inf)
        self.at_rated = False
        self.speeds = [speed] * n
        self.drives: list[float] = []
        self.ahead = [speed] * n  # speeds at the time of the forces, half a step on
        self.state: tuple[tuple[int, ...], str] = ((0,) * n, "free")
        self.spot = Spot(slid=np.zeros(n), heat=np.zeros(n))

    def step(
        self,
        time: float,
        dt: float,
        mass: float,
        belt: float,
        on: float,
        off: float,
        weight: tuple[float, float, float, float] | None = None,
    ) -> tuple[float, float | None]:
        """Belt speed after the step, and that behind the take-up: `weight` is (tension, mass, node's mass, speed)."""
        lift = self.line_mass * belt**2
        self.drives = [roller.pull(time, ahead) for roller, ahead in zip(self.rollers, self.ahead, strict=True)]
        on_mains = any(drive > 0 for drive in self.drives)
        self.at_rated = self.at_rated and on_mains
        for senses, way in self._states(time):
            found = self._try(senses, way, time, dt, mass, belt, on, off, weight, lift)
            if found is not None and found[0] > self.rated and not all(senses) and on_mains and not self.at_rated:
                break
            if found is not None:
                new, behind, drums, pulls, tensions = found
                for j, sense in enumerate(senses):
                    if sense:
                        self.spot.slid[j] += abs(drums[j] - new) * dt
                        self.spot.heat[j] += abs(drums[j] - new) * abs(pulls[j]) * dt
                self.spot.on.append(on)
                self.spot.off.append(tensions[-1])
                self.spot.between.append(tensions)
                self.spot.belt.append((belt + new) / 2)
                self.spot.drums.append([(a + b) / 2 for a, b in zip(self.speeds, drums, strict=True)])
                self.spot.slips.append(senses)
                self.ahead = [b + (b - a) / 2 for a, b in zip(self.speeds, drums, strict=True)]
                self.speeds, self.state = drums, (senses, way)
                return new, behind
        if on_mains and not self.at_rated and math.isfinite(self.rated):  # no state below rated speed is left
            self.at_rated = True
            return self.step(time, dt, mass, belt, on, off, weight)
        raise RuntimeError(f"no state of the drums holds at {time:.6g} s")

    def _states(self, time: float) -> list[tuple[tuple[int, ...], str]]:
        if self.imposed is not None or self.at_rated:
            ways = ["imposed"]
        elif any(r.hold(time) > 0 for r in self.rollers):
            ways = ["forward", "held", "backward"] + (["stopped"] if any(r.one_way for r in self.rollers) else [])
        elif any(r.one_way for r in self.rollers):
            ways = ["free", "stopped"]
        else:
            ways = ["free"]
        choices = [(0,) if r.exponent is None else (0, 1, -1) for r in self.rollers]
        states = [(senses, way) for senses in product(*choices) for way in ways]
        if self.state in states and not self.at_rated:
            states.remove(self.state)
            states.insert(0, self.state)
        return states

    def _try(
        self,
        senses: tuple[int, ...],
        way: str,
        time: float,
        dt: float,
        mass: float,
        belt: float,
        on: float,
        off: float,
        weight: tuple[float, float, float, float] | None,
        lift: float,
    ) -> tuple[float, float | None, list[float], list[float], list[float]] | None:
        n = len(self.rollers)
        stuck = [j for j in range(n) if not senses[j]]
        if (way in ("forward", "backward", "held", "stopped") or self.at_rated) and not stuck:
            way = "free"  # what holds a drum does not hold the belt
        V, H, R, T, W, F = 0, 1, 2, 3, 4, 4 + n
        a, b = np.zeros((4 + 2 * n, 4 + 2 * n)), np.zeros(4 + 2 * n)
        # belt: m v'/dt - sum f - T = m v/dt - S_on
        a[0, V], a[0, T] = mass / dt, -1.0
        a[0, F : F + n] = -1.0
        b[0] = mass * belt / dt - on
        # what is behind the drums
        a[1, T] = 1.0
        b[1] = off
        a[2, R] = 1.0
        if weight:
            tension, heavy, node, back = weight
            a[1, V], a[1, R], b[1] = heavy / 4 / dt, -heavy / 4 / dt, tension + heavy / 4 / dt * (belt - back)
            a[2, R], a[2, T], b[2] = node / dt, 1.0, off + node * back / dt
        # how what holds works: h is the share of the brakes, the backstop's force, or the whole driving force
        if way == "imposed" and self.at_rated:
            a[3, V], b[3] = 1.0, self.rated
        elif way == "imposed":
            assert self.imposed is not None
            a[3, V], b[3] = 1.0, self.imposed(time + dt / 2)
        elif way in ("held", "stopped"):
            a[3, V] = 1.0
        else:
            a[3, H], b[3] = 1.0, {"forward": 1.0, "backward": -1.0, "free": 0.0}[way]
        first_way = next((j for j in stuck if self.rollers[j].one_way), None)
        for j, (roller, sense) in enumerate(zip(self.rollers, senses, strict=True)):
            row, grip_row, w, f = 4 + j, 4 + n + j, W + j, F + j
            # drum: m w'/dt + f + what holds = F + m w/dt
            a[row, w], a[row, f] = roller.mass / dt, 1.0
            b[row] = self.drives[j] + roller.mass * self.speeds[j] / dt
            if way == "imposed" and self.at_rated:
                a[row, H] = 0.0 if sense else -self.shares[j]
                b[row] -= 0.0 if sense else self.drives[j]
            elif way == "imposed":
                a[row, H] = -1.0 / n
            elif way == "stopped":
                a[row, H] = -1.0 if j == first_way else 0.0
            elif not sense:
                a[row, H] = roller.hold(time)
            if not sense:
                a[grip_row, w], a[grip_row, V] = 1.0, -1.0
            else:
                grown = math.exp(sense * (roller.exponent or 0.0)) - 1
                a[grip_row, f], a[grip_row, T] = 1.0, -grown
                a[grip_row, f + 1 : F + n] = -grown
                b[grip_row] = -grown * lift
        try:
            x = np.linalg.solve(a, b)
        except np.linalg.LinAlgError:
            return None
        new, held, behind = float(x[V]), float(x[H]), float(x[R]) if weight else None
        drums, pulls = [float(v) for v in x[W : W + n]], [float(f) for f in x[F : F + n]]
        if way in ("held", "stopped"):
            new = 0.0
        if way == "imposed" and self.at_rated:
            new = self.rated
        if (way == "forward" and new < 0) or (way == "backward" and new > 0):
            return None
        if (way == "held" and abs(held) > 1 + _ROUNDING) or (way == "stopped" and held < -_ROUNDING):
            return None
        if way in ("free", "backward") and new < 0 and first_way is not None:
            return None
        tensions = [float(x[T])]
        for f in reversed(pulls):
            tensions.insert(0, tensions[0] + f)
        for j, (roller, sense) in enumerate(zip(self.rollers, senses, strict=True)):
            if sense:
                free = self.speeds[j] + dt / roller.mass * (self.drives[j] - pulls[j])
                drums[j] = math.copysign(max(abs(free) - dt * roller.hold(time) / roller.mass, 0.0), free)
                drums[j] = max(drums[j], 0.0) if roller.one_way else drums[j]
                drums[j] = min(drums[j], roller.rated) if self.drives[j] > 0 else drums[j]
                drums[j] = self.rated if self.at_rated else drums[j]
                if sense * (drums[j] - new) < 0:
                    return None
            else:
                drums[j] = new
                if roller.exponent is not None:
                    above, below, e = tensions[j] - lift, tensions[j + 1] - lift, math.exp(roller.exponent)
                    if max(above - e * below, below - e * above) > _ROUNDING * (abs(above) + abs(below)):
                        return None
        return new, behind, drums, pulls, tensions


def simulate(plan: Plan, elements: int, window: float, tension: np.ndarray | float, speed: float = 0.0) -> Motion:
    """March the plan; `tension` is that of every element (or all) less gravity's part at the start."""
    transit = [one.length * math.sqrt(one.line_mass / one.stiffness) for one in plan.lengths]
    counts = [max(round(elements * t / sum(transit)), 1) for t in transit]
    h = min(t / n for t, n in zip(transit, counts, strict=True))
    k, m, w, d, c = (
        np.concatenate([np.full(n, of(one, one.length / n)) for one, n in zip(plan.lengths, counts, strict=True)])
        for of in (
            lambda one, ds: one.stiffness / ds,
            lambda one, ds: one.line_mass * ds,
            lambda one, ds: one.friction * ds,
            lambda one, ds: one.drag * ds,
            lambda one, ds: one.climb * ds,
        )
    )
    count, tail = len(k), sum(counts[: plan.tail_after])
    rise = np.concatenate([[0.0], np.cumsum(c)])
    middle = (rise[1:] + rise[:-1]) / 2
    mass, hold, drag = (np.concatenate([x, [0.0]]) / 2 + np.concatenate([[0.0], x]) / 2 for x in (m, w, d))
    for at, to in ((0, 1), (count, count - 1), (tail, tail - 1)):
        hold[to], hold[at] = hold[to] + hold[at], 0.0
        drag[to], drag[at] = drag[to] + drag[at], 0.0
    start = np.broadcast_to(np.asarray(tension, float), (count,)) + middle
    dt = COURANT * h
    steps = math.ceil(window / dt)
    u, v = np.zeros(count + 1), np.full(count + 1, float(speed))
    head = _Place(plan.head, speed, plan.head_speed, plan.belt_line_mass)
    low = _Place(plan.tail, speed, plan.tail_speed, plan.belt_line_mass)
    highest, lowest, behind, farthest = start.copy(), start.copy(), np.zeros(steps), np.zeros(count + 1)
    lumps = np.diff(middle)
    s = start
    for n in range(steps):
        time, part = n * dt, dt if n else dt / 2  # speeds live half a step later than places
        s = start + k * np.diff(u)
        np.maximum(highest, s, out=highest)
        np.minimum(lowest, s, out=lowest)
        free = v[1:-1] + part / mass[1:-1] * (np.diff(s) - lumps)
        new = np.empty_like(v)
        new[1:-1] = np.copysign(np.maximum(np.abs(free) - part * hold[1:-1] / mass[1:-1], 0.0), free)
        new[1:-1] /= 1 + part * drag[1:-1] / mass[1:-1]
        on, off = float(s[-1] + rise[-1] - middle[-1]), float(s[0] - middle[0])
        if plan.takeup:
            weight = (*plan.takeup, float(mass[0]), float(v[0]))
            belt, back = head.step(time, part, float(mass[-1]), float(v[-1]), on, off, weight)
            assert back is not None
            new[0], new[-1] = back, belt
        else:
            belt, _ = head.step(time, part, float(mass[-1] + mass[0]), float(v[-1]), on, off)
            new[0] = new[-1] = belt
        before = float(s[tail - 1] + rise[tail] - middle[tail - 1])
        after = float(s[tail] + rise[tail] - middle[tail])
        new[tail], _ = low.step(time, part, float(mass[tail]), float(v[tail]), before, after)
        behind[n] = (v[0] + new[0]) / 2
        v = new
        u = u + dt * v
        np.maximum(farthest, u, out=farthest)
    return Motion(np.arange(steps) * dt, head.spot, low.spot, behind, highest, lowest, s, tail, farthest)
