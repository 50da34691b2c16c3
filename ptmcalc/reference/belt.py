"""Finite elements of a whole belt with drums that slip, brakes and idlers that stick: a reference.

Shares nothing with the characteristics in `numerics.belt`. Lumped masses and springs in equal steps of travel time,
central differences in time next to the limit of stability, where fronts disperse least.
Coulomb friction is never smoothed: at an idler the return map v = sgn v* max(|v*| - W dt/m, 0) gives the impulse that
holds or slides; at a place with drums every combination of sticking and slipping, moving and held is solved as a small
linear system until one agrees with its own inequalities (Moreau's time stepping). Drums stand in the order in which
the belt meets them.

Nodes 0 and -1 are at the head: one point where the loop is closed, two with a weight that takes up between them.
Half an element's friction beside head and tail goes to the next node within.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import product

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.errors import NumericsError

FloatArray = NDArray[np.float64]
COURANT = 1 - 1e-6
"""Step over the time in which a wave crosses an element: at 1 a uniform belt has no dispersion."""
_ROUNDING = 1e-9
_BELT, _HOLDING, _BEHIND, _TENSION, _DRUMS = range(5)
"""Unknowns of a step: belt speed, what holds, speed behind the take-up, tension behind the drums; from the last on the
speeds of the drums, and behind them their pulls."""


def no_pull(time: float, speed: float) -> float:
    """A drum without a motor."""
    return 0.0


def no_hold(time: float) -> float:
    """A drum without a brake."""
    return 0.0


@dataclass(frozen=True, slots=True)
class Length:
    """A uniform length of belt: m, kg/m, N, and friction N/m, drag N*s/m^2, climb N/m; `lump` is friction at its
    beginning [N]."""

    length: float
    line_mass: float
    stiffness: float
    friction: float = 0.0
    climb: float = 0.0
    drag: float = 0.0
    lump: float = 0.0


@dataclass(frozen=True, slots=True)
class Roller:
    """A drum: rim mass, rim force over time and speed, brake over time, grip exponent, and whether it may turn back."""

    mass: float
    pull: Callable[[float, float], float] = no_pull
    hold: Callable[[float], float] = no_hold
    exponent: float | None = None
    one_way: bool = False
    share: float = 1.0
    """of the whole force where the speed of all drums there is imposed, as a number beside those of the others"""
    rated: float = math.inf
    """speed at which the motor holds the drum once it has it [m/s], while it is on"""


@dataclass(frozen=True, slots=True)
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
    at_tail: float = 0.0
    """friction of the belt at the tail [N]"""


@dataclass
class Spot:
    """What a place with drums did, at the samples of time."""

    on: list[float] = field(default_factory=list)
    off: list[float] = field(default_factory=list)
    between: list[list[float]] = field(default_factory=list)
    belt: list[float] = field(default_factory=list)
    drums: list[list[float]] = field(default_factory=list)
    slips: list[tuple[int, ...]] = field(default_factory=list)
    slid: FloatArray = field(default_factory=lambda: np.zeros(0))
    heat: FloatArray = field(default_factory=lambda: np.zeros(0))


@dataclass
class Motion:
    """Histories at head and tail, speed behind the take-up, extremes and last tensions of every element."""

    times: FloatArray
    head: Spot
    tail: Spot
    behind: FloatArray
    highest: FloatArray
    lowest: FloatArray
    last: FloatArray
    tail_element: int


class _Place:
    """Drums at one point of the belt: speeds after a step from the tensions before it."""

    def __init__(
        self, rollers: Sequence[Roller], speed: float, imposed: Callable[[float], float] | None, line_mass: float
    ) -> None:
        self.rollers, self.imposed, self.line_mass = tuple(rollers), imposed, line_mass
        n = len(self.rollers)
        self.rated, self.at_rated = max((roller.rated for roller in self.rollers), default=math.inf), False
        self.speeds = [speed] * n
        self.drives: list[float] = []
        self.ahead = [speed] * n  # speeds at the time of the forces, half a step on
        self.state: tuple[tuple[int, ...], str] = ((0,) * n, "free")
        self.spot = Spot(slid=np.zeros(n), heat=np.zeros(n))

    def step(
        self,
        time: float,
        dt: float,
        masses: tuple[float, float],
        belt: float,
        on: float,
        off: float,
        weight: tuple[float, float, float, float] | None = None,
    ) -> tuple[float, float | None]:
        """Belt speed after the step, and that behind the take-up: `weight` is (tension, mass, node's mass, speed).

        `masses` are those of the half elements before and behind the drums: what slips between them passes on what the
        one behind takes to speed up as well, e times. All of it before the drums instead would make a slipping place
        too stiff for its mass: next to the limit of stability it then chatters between sticking and slipping.
        """
        lift = self.line_mass * belt**2
        self.drives = [roller.pull(time, ahead) for roller, ahead in zip(self.rollers, self.ahead, strict=True)]
        on_mains = any(drive > 0 for drive in self.drives)
        self.at_rated = self.at_rated and on_mains
        for senses, way in self._states(time):
            found = self._try(senses, way, time, dt, masses, belt, on, off, weight, lift)
            if found is not None and found[0] > self.rated and not all(senses) and on_mains and not self.at_rated:
                break
            if found is not None:
                new, behind, drums, pulls, tensions = found
                for j, sense in enumerate(senses):
                    if sense:
                        self.spot.slid[j] += abs(drums[j] - new) * dt
                        self.spot.heat[j] += abs(drums[j] - new) * abs(pulls[j]) * dt
                self.spot.on.append(tensions[0])
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
            return self.step(time, dt, masses, belt, on, off, weight)
        raise NumericsError("NUM101", f"elements: no state of the drums holds at {time:.6g} s")

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
        masses: tuple[float, float],
        belt: float,
        on: float,
        off: float,
        weight: tuple[float, float, float, float] | None,
        lift: float,
    ) -> tuple[float, float | None, list[float], list[float], list[float]] | None:
        """Belt speed, speed behind the take-up, and speeds, pulls and tensions of the drums; None in a state that does
        not fit."""
        n = len(self.rollers)
        stuck = [j for j in range(n) if not senses[j]]
        if (way in ("forward", "backward", "held", "stopped") or self.at_rated) and not stuck:
            way = "free"  # what holds a drum does not hold the belt
        first_way = next((j for j in stuck if self.rollers[j].one_way), None)
        a, b = np.zeros((_DRUMS + 2 * n, _DRUMS + 2 * n)), np.zeros(_DRUMS + 2 * n)
        self._belt_rows(a, b, dt, masses, belt, on, off, weight)
        self._holding_row(a, b, way, time + dt / 2)
        self._drum_rows(a, b, senses, way, first_way, time, dt, lift)
        try:
            x = np.linalg.solve(a, b)
        except np.linalg.LinAlgError:
            return None
        new, held, behind = float(x[_BELT]), float(x[_HOLDING]), float(x[_BEHIND]) if weight else None
        drums, pulls = [float(v) for v in x[_DRUMS : _DRUMS + n]], [float(f) for f in x[_DRUMS + n :]]
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
        tensions = [float(x[_TENSION])]
        for pull in reversed(pulls):
            tensions.insert(0, tensions[0] + pull)
        fits = self._drums_fit(senses, time, dt, lift, new, drums, pulls, tensions)
        return (new, behind, drums, pulls, tensions) if fits else None

    def _belt_rows(
        self,
        a: FloatArray,
        b: FloatArray,
        dt: float,
        masses: tuple[float, float],
        belt: float,
        on: float,
        off: float,
        weight: tuple[float, float, float, float] | None,
    ) -> None:
        """Balance of the belt before and behind the drums, and of the node behind the take-up."""
        n, (before, after) = len(self.rollers), masses
        # belt before the drums: m v'/dt - sum f - S_behind = m v/dt - S_on
        a[0, _BELT], a[0, _TENSION] = before / dt, -1.0
        a[0, _DRUMS + n :] = -1.0
        b[0] = before * belt / dt - on
        # belt behind them: m v'/dt + S_behind = m v/dt + S_off, or the weight
        a[1, _TENSION], a[1, _BELT] = 1.0, after / dt
        b[1] = off + after * belt / dt
        a[2, _BEHIND] = 1.0
        if weight:
            tension, heavy, node, back = weight
            a[1, _BELT], a[1, _BEHIND] = heavy / 4 / dt, -heavy / 4 / dt
            b[1] = tension + heavy / 4 / dt * (belt - back)
            a[2, _BEHIND], a[2, _TENSION], b[2] = node / dt, 1.0, off + node * back / dt

    def _holding_row(self, a: FloatArray, b: FloatArray, way: str, middle: float) -> None:
        """How what holds works: the share of the brakes, the backstop's force, or the whole driving force."""
        if way == "imposed" and self.at_rated:
            a[3, _BELT], b[3] = 1.0, self.rated
        elif way == "imposed":
            assert self.imposed is not None
            a[3, _BELT], b[3] = 1.0, self.imposed(middle)
        elif way in ("held", "stopped"):
            a[3, _BELT] = 1.0
        else:
            a[3, _HOLDING], b[3] = 1.0, {"forward": 1.0, "backward": -1.0, "free": 0.0}[way]

    def _drum_rows(
        self,
        a: FloatArray,
        b: FloatArray,
        senses: tuple[int, ...],
        way: str,
        first_way: int | None,
        time: float,
        dt: float,
        lift: float,
    ) -> None:
        """Balance of every drum, and its grip: one speed with the belt, or a pull by the friction law."""
        n = len(self.rollers)
        for j, (roller, sense) in enumerate(zip(self.rollers, senses, strict=True)):
            row, grip_row, w, f = _DRUMS + j, _DRUMS + n + j, _DRUMS + j, _DRUMS + n + j
            # drum: m w'/dt + f + what holds = F + m w/dt
            a[row, w], a[row, f] = roller.mass / dt, 1.0
            b[row] = self.drives[j] + roller.mass * self.speeds[j] / dt
            if way == "imposed" and self.at_rated and not sense:
                b[row] -= self.drives[j]
            if way == "imposed" and not (self.at_rated and sense):
                a[row, _HOLDING] = -roller.share / sum(one.share for one in self.rollers)
            elif way == "stopped":
                a[row, _HOLDING] = -1.0 if j == first_way else 0.0
            elif not sense:
                a[row, _HOLDING] = roller.hold(time)
            if not sense:
                a[grip_row, w], a[grip_row, _BELT] = 1.0, -1.0
            else:
                grown = math.exp(sense * (roller.exponent or 0.0)) - 1
                a[grip_row, f], a[grip_row, _TENSION] = 1.0, -grown
                a[grip_row, f + 1 :] = -grown
                b[grip_row] = -grown * lift

    def _drums_fit(
        self,
        senses: tuple[int, ...],
        time: float,
        dt: float,
        lift: float,
        new: float,
        drums: list[float],
        pulls: list[float],
        tensions: list[float],
    ) -> bool:
        """Whether every drum slips the way it is taken to, or sticks within its grip; sets the speeds of the drums."""
        for j, (roller, sense) in enumerate(zip(self.rollers, senses, strict=True)):
            if sense:
                free = self.speeds[j] + dt / roller.mass * (self.drives[j] - pulls[j])
                drums[j] = math.copysign(max(abs(free) - dt * roller.hold(time) / roller.mass, 0.0), free)
                drums[j] = max(drums[j], 0.0) if roller.one_way else drums[j]
                drums[j] = min(drums[j], roller.rated) if self.drives[j] > 0 else drums[j]
                drums[j] = self.rated if self.at_rated else drums[j]
                if sense * (drums[j] - new) < 0:
                    return False
            else:
                drums[j] = new
                if roller.exponent is not None:
                    above, below, e = tensions[j] - lift, tensions[j + 1] - lift, math.exp(roller.exponent)
                    if max(above - e * below, below - e * above) > _ROUNDING * (abs(above) + abs(below)):
                        return False
        return True


def simulate(
    plan: Plan, elements: int, window: float, tension: FloatArray, speed: float = 0.0, after_rest: float = math.inf
) -> Motion:
    """March the plan, no longer than `after_rest` behind the first rest of the belt at the head; `tension` is that of
    every element less gravity's part at the start."""
    transit = [one.length * math.sqrt(one.line_mass / one.stiffness) for one in plan.lengths]
    counts = shared_out(plan.lengths, elements)
    h = min(t / n for t, n in zip(transit, counts, strict=True))
    pieces = [(one, one.length / n) for one, n in zip(plan.lengths, counts, strict=True) for _ in range(n)]
    k = np.array([one.stiffness / ds for one, ds in pieces])
    m, w, d, c = (
        np.array([getattr(one, name) * ds for one, ds in pieces]) for name in ("line_mass", "friction", "drag", "climb")
    )
    w = w + lumps_of(plan.lengths, counts)
    count, tail = len(k), sum(counts[: plan.tail_after])
    rise = np.concatenate([[0.0], np.cumsum(c)])
    middle = (rise[1:] + rise[:-1]) / 2
    mass, hold, drag = (np.concatenate([x, [0.0]]) / 2 + np.concatenate([[0.0], x]) / 2 for x in (m, w, d))
    for at, to in ((0, 1), (count, count - 1), (tail, tail - 1)):
        hold[to], hold[at] = hold[to] + hold[at], 0.0
        drag[to], drag[at] = drag[to] + drag[at], 0.0
    hold[tail - 1] += plan.at_tail
    start = tension + middle
    dt = COURANT * h
    steps = math.ceil(window / dt)
    u, v = np.zeros(count + 1), np.full(count + 1, float(speed))
    head = _Place(plan.head, speed, plan.head_speed, plan.belt_line_mass)
    low = _Place(plan.tail, speed, plan.tail_speed, plan.belt_line_mass)
    highest, lowest, behind = start.copy(), start.copy(), np.zeros(steps)
    lumps, around = np.diff(middle), (float(m[tail - 1]) / 2, float(m[tail]) / 2)
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
            belt, back = head.step(time, part, (float(mass[-1]), 0.0), float(v[-1]), on, off, weight)
            assert back is not None
            new[0], new[-1] = back, belt
        else:
            belt, _ = head.step(time, part, (float(mass[-1]), float(mass[0])), float(v[-1]), on, off)
            new[0] = new[-1] = belt
        before = float(s[tail - 1] + rise[tail] - middle[tail - 1])
        after = float(s[tail] + rise[tail] - middle[tail])
        new[tail], _ = low.step(time, part, around, float(v[tail]), before, after)
        behind[n] = (v[0] + new[0]) / 2
        v = new
        u = u + dt * v
        if head.spot.belt[-1] <= 0 and time > 0:
            window = min(window, time + after_rest)
        if time >= window:
            steps = n + 1
            break
    times = np.arange(steps, dtype=np.float64) * dt
    return Motion(times, head.spot, low.spot, behind[:steps], highest, lowest, s, tail)


def lumps_of(lengths: Sequence[Length], counts: Sequence[int]) -> FloatArray:
    """Lumps of friction of every element [N]: those of the first one of each length."""
    return np.array([one.lump if k == 0 else 0.0 for one, n in zip(lengths, counts, strict=True) for k in range(n)])


def shared_out(lengths: Sequence[Length], elements: int) -> list[int]:
    """Elements of every length."""
    transit = [one.length * math.sqrt(one.line_mass / one.stiffness) for one in lengths]
    return [max(round(elements * time / sum(transit)), 1) for time in transit]
