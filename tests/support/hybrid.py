"""Trains of inertias, integrated by a state machine of its own: a reference for exact propagation with events.

Eighth-order Runge-Kutta steps (scipy's DOP853, relative tolerance 1e-12) run from event to event; an event is
bracketed on a dense grid inside every step and polished by Newton's method on a step of its own. What sticks and what
slips is decided as a linear programme over all friction forces and mesh torques at once, so a held train is held
because forces that hold it exist.
"""

import itertools
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace

import numpy as np
from scipy.integrate import DOP853, solve_ivp
from scipy.optimize import brentq, linprog

RTOL = 1e-12
SAMPLES = np.linspace(0.0, 1.0, 9)
MOST_EVENTS = 2000


@dataclass(frozen=True)
class Course:
    """A value over time: straight pieces (time, value, slope), and sines (size, frequency, phase)."""

    pieces: tuple[tuple[float, float, float], ...] = ((0.0, 0.0, 0.0),)
    sines: tuple[tuple[float, float, float], ...] = ()

    @classmethod
    def constant(cls, value: float) -> "Course":
        return cls(((0.0, value, 0.0),))

    def at(self, time: float, inside: float) -> float:
        """The value at a time, on the piece that holds `inside` an interval without breaks."""
        start, value, slope = [piece for piece in self.pieces if piece[0] <= inside][-1]
        waves = sum(size * np.sin(frequency * time + phase) for size, frequency, phase in self.sines)
        return value + slope * (time - start) + waves

    @property
    def breaks(self) -> tuple[float, ...]:
        return tuple(piece[0] for piece in self.pieces)


@dataclass(frozen=True)
class Link:
    """Spring and damper of extension x_first - x_second - rest, with one of the laws of contact."""

    first: int
    second: int | None
    stiffness: float
    damping: float = 0.0
    play: float = 0.0
    law: str = "linear"
    side: int = 0
    rest: float = 0.0
    dissipation: float = 0.0
    exponent: float = 1.0

    def force(self, branch: tuple[str, int], x: float | np.ndarray, v: float | np.ndarray) -> float | np.ndarray:
        """On a branch: nothing, all of spring and damper, or twice the spring (damper limited to it)."""
        name, side = branch
        if name in ("open", "none"):
            return 0.0
        depth, closing = side * x - self.play / 2, side * v
        if self.law == "linear":
            return self.stiffness * x + self.damping * v
        if name == "twice":
            return 2 * side * self.stiffness * depth
        if self.law == "hunt_crossley":
            elastic = self.stiffness * np.maximum(depth, 0.0) ** self.exponent
            return side * elastic * (1 + 1.5 * self.dissipation * closing)
        return side * (self.stiffness * depth + self.damping * closing)

    def exits(self, branch: tuple[str, int]) -> Iterator[tuple[tuple[float, float, float], tuple[str, int]]]:
        """(a, b, c) of a x + b v + c, which stays above 0 on a branch, and the branch that follows."""
        name, side = branch
        half = self.play / 2
        if self.law == "linear":
            return
        if name == "open":
            for one in (self.side,) if self.side else (1, -1):
                yield (-one, 0.0, half), ("full", one)
            return
        depth = (float(side), 0.0, -half)
        pull = (side * self.stiffness, side * self.damping, -self.stiffness * half)
        excess = (side * self.stiffness, -side * self.damping, -self.stiffness * half)
        if self.law == "hunt_crossley":
            pull = (0.0, 1.5 * self.dissipation * side, 1.0)
        if self.law == "kelvin" or (self.damping == 0 and self.law != "hunt_crossley"):
            yield depth, ("open", 0)
        elif name == "full":
            if self.law == "hunt_crossley":
                yield depth, ("open", 0)
            yield pull, ("none", side)
            if self.law == "clamped":
                yield excess, ("twice", side)
        elif name == "twice":
            yield tuple(-one for one in excess), ("full", side)  # type: ignore[misc]
        else:
            yield tuple(-one for one in pull), ("full", side)  # type: ignore[misc]
            yield depth, ("open", 0)


@dataclass(frozen=True)
class Gear:
    """x_inner' = ratio x_outer', with its efficiency forward (inner to outer) and back."""

    inner: int
    outer: int
    ratio: float
    forward: float = 1.0
    reverse: float = 1.0

    def share(self, power: int) -> float:
        """Inner torque over outer torque, for power that flows outward (1) or inward (-1)."""
        return 1 / (self.ratio * self.forward) if power > 0 else self.reverse / self.ratio


@dataclass(frozen=True)
class Brake:
    """Friction between two bodies or against the ground, sliding capacity over time, more by `static` at rest."""

    first: int
    second: int | None
    capacity: Course
    static: float = 1.0


@dataclass(frozen=True)
class Torque:
    """A torque on a body: over time, plus a smooth function of its (position, speed) between knots of each."""

    body: int
    course: Course = Course()
    over: Callable[[float, float], float] | None = None
    speed_knots: tuple[float, ...] = ()
    position_knots: tuple[float, ...] = ()


@dataclass(frozen=True)
class Machine:
    inertias: tuple[float, ...]
    positions: tuple[float, ...]
    speeds: tuple[float, ...]
    links: tuple[Link, ...] = ()
    gears: tuple[Gear, ...] = ()
    brakes: tuple[Brake, ...] = ()
    torques: tuple[Torque, ...] = ()


@dataclass(frozen=True)
class Friction:
    """What turns which way (0 held, None free of friction), what slips, and the signs of the outer mesh torques."""

    turning: tuple[int | None, ...]
    slips: tuple[int, ...]
    meshes: tuple[int, ...]


@dataclass
class History:
    """What a run found; extremes by (what, index)."""

    time: float = 0.0
    positions: np.ndarray = field(default_factory=lambda: np.empty(0))
    speeds: np.ndarray = field(default_factory=lambda: np.empty(0))
    events: list[tuple[float, str, int, object]] = field(default_factory=list)
    highest: dict[tuple[str, int], float] = field(default_factory=dict)
    lowest: dict[tuple[str, int], float] = field(default_factory=dict)

    def times(self, kind: str, index: int | None = None, to: object = None) -> list[float]:
        """Times of the events of one kind, of one element, to one state."""
        return [
            event[0]
            for event in self.events
            if event[1] == kind and index in (None, event[2]) and (to is None or event[3] == to)
        ]


class Groups:
    """Bodies that gears tie together, and their speeds over those of the first of each group."""

    def __init__(self, machine: Machine) -> None:
        count = len(machine.inertias)
        self.of, self.ratio = [-1] * count, np.ones(count)
        for body in range(count):
            if self.of[body] < 0:
                self.of[body] = max(self.of) + 1
                self._spread(machine, body)
        self.count = max(self.of) + 1

    def _spread(self, machine: Machine, body: int) -> None:
        for gear in machine.gears:
            for one, other, factor in ((gear.inner, gear.outer, 1 / gear.ratio), (gear.outer, gear.inner, gear.ratio)):
                if one == body and self.of[other] < 0:
                    self.of[other] = self.of[body]
                    self.ratio[other] = self.ratio[body] * factor
                    self._spread(machine, other)

    def row(self, first: int, second: int | None) -> np.ndarray:
        row = np.zeros(self.count)
        row[self.of[first]] += self.ratio[first]
        if second is not None:
            row[self.of[second]] -= self.ratio[second]
        return row


class _Run:
    def __init__(self, machine: Machine) -> None:
        self.machine, self.groups = machine, Groups(machine)
        self.bodies = len(machine.inertias)
        of = self.groups.of
        self.inertia = np.array(machine.inertias)
        self.origin = np.array(machine.positions)
        self.lossy = [k for k, gear in enumerate(machine.gears) if gear.forward != 1 or gear.reverse != 1]
        self.clutches = [
            k
            for k, brake in enumerate(machine.brakes)
            if brake.second is not None and of[brake.first] != of[brake.second]
        ]
        self.rough = [
            any(of[brake.first] == g for k, brake in enumerate(machine.brakes) if k not in self.clutches)
            or any(of[machine.gears[k].inner] == g for k in self.lossy)
            for g in range(self.groups.count)
        ]
        times = [time for torque in machine.torques for time in torque.course.breaks]
        times += [time for brake in machine.brakes for time in brake.capacity.breaks]
        self.breaks = sorted(set(times))
        courses = [torque.course for torque in machine.torques] + [brake.capacity for brake in machine.brakes]
        self.longest = 0.4 / max([wave[1] for course in courses for wave in course.sines], default=1e-3)
        self.inside = 0.0
        self._solved: dict[Friction, tuple[np.ndarray, np.ndarray, np.ndarray, list[tuple[str, int]]]] = {}
        self.branches: list[tuple[str, int]] = [
            ("full", 0) if link.law == "linear" else ("open", 0) for link in machine.links
        ]

    # -- kinematics and forces ------------------------------------------------------------------------------------

    def split(self, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Positions and speeds of the bodies."""
        n, of, ratio = self.groups.count, self.groups.of, self.groups.ratio
        return self.origin + ratio * y[:n][of], ratio * y[n:][of]

    def extension(self, link: Link, x: np.ndarray) -> float:
        second = 0.0 if link.second is None else x[link.second]
        return float(x[link.first] - second - link.rest)

    @staticmethod
    def between(first: int, second: int | None, v: np.ndarray) -> float:
        return float(v[first] - (0.0 if second is None else v[second]))

    def applied(self, t: float, y: np.ndarray) -> np.ndarray:
        """Forces of links and torques on the bodies."""
        x, v = self.split(y)
        force = np.zeros(self.bodies)
        for link, branch in zip(self.machine.links, self.branches, strict=True):
            pull = link.force(branch, self.extension(link, x), self.between(link.first, link.second, v))
            force[link.first] -= pull
            if link.second is not None:
                force[link.second] += pull
        for torque in self.machine.torques:
            force[torque.body] += torque.course.at(t, self.inside)
            if torque.over is not None:
                force[torque.body] += torque.over(float(x[torque.body]), float(v[torque.body]))
        return force

    def slip_of(self, k: int, friction: Friction) -> int | None:
        """Direction in which a brake or clutch slips, 0 where it holds, None where it cannot act."""
        brake = self.machine.brakes[k]
        if k in self.clutches:
            return friction.slips[self.clutches.index(k)]
        turn = friction.turning[self.groups.of[brake.first]]
        row = self.groups.row(brake.first, brake.second)[self.groups.of[brake.first]]
        return None if turn is None else int(np.sign(turn * row))

    def sliding(self, t: float, friction: Friction) -> np.ndarray:
        """Forces of the friction that slips."""
        force = np.zeros(self.bodies)
        for k, brake in enumerate(self.machine.brakes):
            slip = self.slip_of(k, friction)
            if slip:
                size = slip * brake.capacity.at(t, self.inside)
                force[brake.first] -= size
                if brake.second is not None:
                    force[brake.second] += size
        return force

    def share(self, k: int, friction: Friction) -> float:
        gear = self.machine.gears[k]
        if k not in self.lossy:
            return 1 / gear.ratio
        turn = friction.turning[self.groups.of[gear.inner]] or 0
        direction = friction.meshes[self.lossy.index(k)] * turn * np.sign(self.groups.ratio[gear.outer])
        return gear.share(1 if direction > 0 else -1)

    def solved(self, friction: Friction) -> tuple[np.ndarray, np.ndarray, np.ndarray, list[tuple[str, int]]]:
        """Accelerations, outer mesh torques and holding forces as matrices on the forces on the bodies."""
        if friction not in self._solved:
            machine, groups = self.machine, self.groups
            holds: list[tuple[str, int]] = []
            rows: list[np.ndarray] = []
            wanted = [("group", g, np.eye(groups.count)[g]) for g, turn in enumerate(friction.turning) if turn == 0]
            for k, slip in zip(self.clutches, friction.slips, strict=True):
                if slip == 0:
                    brake = machine.brakes[k]
                    wanted.append(("clutch", k, groups.row(brake.first, brake.second)))
            for what, which, row in wanted:
                if np.linalg.matrix_rank(np.array([*rows, row])) > len(rows):
                    rows.append(row)
                    holds.append((what, which))
            n, m = groups.count, len(machine.gears)
            matrix = np.zeros((self.bodies + len(holds), n + m + len(holds)))
            for b in range(self.bodies):
                matrix[b, groups.of[b]] = self.inertia[b] * groups.ratio[b]
            for k, gear in enumerate(machine.gears):
                matrix[gear.inner, n + k] += self.share(k, friction)
                matrix[gear.outer, n + k] -= 1
            for j, ((what, which), row) in enumerate(zip(holds, rows, strict=True)):
                matrix[self.bodies + j, :n] = row
                if what == "group":
                    matrix[groups.of.index(which), n + m + j] = -1
                else:
                    brake = machine.brakes[which]
                    matrix[brake.first, n + m + j] = -1
                    matrix[brake.second, n + m + j] = 1
            inverse = np.linalg.inv(matrix)[:, : self.bodies]
            self._solved[friction] = (inverse[:n], inverse[n : n + m], inverse[n + m :], holds)
        return self._solved[friction]

    def rates(self, friction: Friction) -> Callable[[float, np.ndarray], np.ndarray]:
        acceleration, n = self.solved(friction)[0], self.groups.count
        held = np.array([turn == 0 for turn in friction.turning])

        def of(t: float, y: np.ndarray) -> np.ndarray:
            a = acceleration @ (self.applied(t, y) + self.sliding(t, friction))
            a[held] = 0.0
            return np.concatenate([y[n:], a])

        return of

    # -- what sticks ----------------------------------------------------------------------------------------------

    def feasible(self, t: float, applied: np.ndarray, friction: Friction, rest: "_Rest", spare: bool = False) -> float:
        """Whether forces within their limits exist that give this state of friction (1, else -1); with `spare` the
        most by which every holding limit can be undercut, as a share of it."""
        machine, groups = self.machine, self.groups
        n, m, j = groups.count, len(machine.gears), len(machine.brakes)
        width = n + 2 * m + j + 1  # accelerations, outer and inner torques, friction forces, spare
        capacities = [brake.capacity.at(t, self.inside) for brake in machine.brakes]
        size = max(float(np.abs(applied).max(initial=0.0)), 1e-30, *capacities)
        equal, right = np.zeros((self.bodies, width)), np.array(applied) / size
        bounds: list[tuple[float | None, float | None]] = [(None, None)] * width
        above: list[np.ndarray] = []  # rows that must stay at or below 0, with their right side
        limit: list[float] = []
        heaviest = self.inertia * groups.ratio**2
        for b in range(self.bodies):
            weight = float(heaviest[[one == groups.of[b] for one in groups.of]].sum())
            equal[b, groups.of[b]] = self.inertia[b] * groups.ratio[b] / weight  # accelerations in units of size/weight
        weights = np.array([heaviest[[one == g for one in groups.of]].sum() for g in range(n)])
        for k, gear in enumerate(machine.gears):
            equal[gear.inner, n + m + k] += 1
            equal[gear.outer, n + k] -= 1
        more: list[np.ndarray] = []
        for k, gear in enumerate(machine.gears):
            turn = friction.turning[groups.of[gear.inner]]
            row = np.zeros(width)
            if k not in self.lossy or turn != 0:
                row[n + m + k], row[n + k] = 1, -self.share(k, friction)
                more.append(row)
                if k in self.lossy:
                    sign = friction.meshes[self.lossy.index(k)]
                    bounds[n + k] = (0, None) if sign > 0 else (None, 0)
            else:  # at rest anything between both efficiencies
                sign = friction.meshes[self.lossy.index(k)]
                bounds[n + k] = (0, None) if sign > 0 else (None, 0)
                shares = sorted(sign * gear.share(way) for way in (1, -1))
                for least, way in zip(shares, (-1, 1), strict=True):
                    row = np.zeros(width)
                    row[n + m + k], row[n + k] = way, -way * least * sign
                    above.append(row)
                    limit.append(0.0)
        for k, brake in enumerate(machine.brakes):
            column, capacity = n + 2 * m + k, capacities[k] / size
            equal[brake.first, column] -= 1
            if brake.second is not None:
                equal[brake.second, column] += 1
            slip = self.slip_of(k, friction)
            if slip:
                bounds[column] = (-slip * capacity, -slip * capacity)
            elif slip is None:
                bounds[column] = (0, 0)
            elif spare:
                for way in (1, -1):
                    row = np.zeros(width)
                    row[column], row[-1] = way, 1.0
                    above.append(row)
                    limit.append(brake.static * capacity)
            else:
                bounds[column] = (-brake.static * capacity, brake.static * capacity)
        for g, turn in enumerate(friction.turning):
            if turn == 0:
                bounds[g] = (0, 0)
            elif turn is not None and rest.groups[g]:
                bounds[g] = (0, None) if turn > 0 else (None, 0)
        for k, slip in zip(self.clutches, friction.slips, strict=True):
            row = np.zeros(width)
            row[:n] = groups.row(machine.brakes[k].first, machine.brakes[k].second) / weights
            if slip == 0:
                more.append(row)
            elif rest.clutches[self.clutches.index(k)]:
                above.append(-slip * row)
                limit.append(0.0)
        bounds[-1] = (None, 10.0) if spare else (0, 0)
        cost = np.zeros(width)
        cost[-1] = -1.0
        found = linprog(
            cost,
            A_ub=np.array(above) if above else None,
            b_ub=np.array(limit) if above else None,
            A_eq=np.vstack([equal, *more]),
            b_eq=np.concatenate([right, np.zeros(len(more))]),
            bounds=bounds,
            method="highs",
            options={"primal_feasibility_tolerance": 1e-10, "dual_feasibility_tolerance": 1e-10},
        )
        if found.status != 0:
            return -1.0
        return float(found.x[-1]) if spare else 1.0

    def decide(self, t: float, y: np.ndarray, now: Friction, rest: "_Rest") -> Friction:
        """The state of friction with forces that fit it, what sticks tried first."""
        applied, n = self.applied(t, y), self.groups.count
        turning: list[tuple[int | None, ...]] = []
        for g, turn in enumerate(now.turning):
            if turn is None:
                turning.append((None,))
            else:
                turning.append((0, 1, -1) if rest.groups[g] else (int(np.sign(y[n + g])),))
        slips = []
        _, v = self.split(y)
        for k, still in zip(self.clutches, rest.clutches, strict=True):
            brake = self.machine.brakes[k]
            slips.append((0, 1, -1) if still else (int(np.sign(self.between(brake.first, brake.second, v))),))
        signs = [now.meshes, *(one for one in itertools.product((1, -1), repeat=len(self.lossy)) if one != now.meshes)]
        for chosen in itertools.product(*turning, *slips):
            for meshes in signs:
                friction = Friction(chosen[:n], chosen[n:], meshes)  # type: ignore[arg-type]
                if self.feasible(t, applied, friction, rest) > 0:
                    return friction
        raise AssertionError(f"no state of friction fits at {t}")

    def spare(self, t: float, y: np.ndarray, friction: Friction) -> float:
        """By how much what holds holds; below 0 it does not."""
        still = _Rest(tuple(turn == 0 for turn in friction.turning), tuple(slip == 0 for slip in friction.slips))
        stuck = [g for g, turn in enumerate(friction.turning) if turn == 0]
        force = self.applied(t, y) + self.sliding(t, friction)
        locked = [k for k, slip in zip(self.clutches, friction.slips, strict=True) if slip == 0]
        if not locked and not (self.lossy and stuck):  # plain brakes: what each group needs against what it has
            left = 1.0
            for g in stuck:
                members = [b for b, one in enumerate(self.groups.of) if one == g]
                need = abs(sum(self.groups.ratio[b] * force[b] for b in members))
                has = 0.0
                for k, brake in enumerate(self.machine.brakes):
                    if k not in self.clutches and self.groups.of[brake.first] == g:
                        arm = abs(self.groups.row(brake.first, brake.second)[g])
                        has += arm * brake.static * brake.capacity.at(t, self.inside)
                left = min(left, (has - need) / max(has, need, 1e-30))
            return left
        if locked and not stuck:
            _, _, holding, holds = self.solved(friction)
            found = holding @ force
            left = 1.0
            for j, (_, k) in enumerate(holds):
                has = self.machine.brakes[k].static * self.machine.brakes[k].capacity.at(t, self.inside)
                left = min(left, (has - abs(found[j])) / max(has, abs(found[j]), 1e-30))
            return left
        applied = self.applied(t, y)
        signs = itertools.product((1, -1), repeat=len(self.lossy))
        if not self.machine.brakes:
            return max(self.feasible(t, applied, replace(friction, meshes=one), still) for one in signs)
        return max(self.feasible(t, applied, replace(friction, meshes=one), still, spare=True) for one in signs)

    # -- the run --------------------------------------------------------------------------------------------------

    def guards(self, friction: Friction) -> list[tuple[str, int, object, Callable[[float, np.ndarray], float]]]:
        """(kind, index, next, function that stays above 0)."""
        found: list[tuple[str, int, object, Callable[[float, np.ndarray], float]]] = []
        for k, (link, branch) in enumerate(zip(self.machine.links, self.branches, strict=True)):
            for plane, to in link.exits(branch):
                found.append(("link", k, to, self._plane(link, plane)))
        n = self.groups.count
        for g, turn in enumerate(friction.turning):
            if turn:
                found.append(("turning", g, None, lambda t, y, g=g, turn=turn: turn * y[n + g]))
        for k, slip in zip(self.clutches, friction.slips, strict=True):
            if slip:
                row = self.groups.row(self.machine.brakes[k].first, self.machine.brakes[k].second)
                found.append(("slip", k, None, lambda t, y, row=row, slip=slip: slip * float(row @ y[n:])))
        _, mesh, _, _ = self.solved(friction)
        for i, k in enumerate(self.lossy):
            if friction.turning[self.groups.of[self.machine.gears[k].inner]]:
                found.append(("mesh", k, None, self._through(friction.meshes[i] * mesh[k], friction)))
        if 0 in friction.turning or 0 in friction.slips:
            found.append(("hold", 0, None, lambda t, y: self.spare(t, y, friction)))
        return found

    def _through(self, row: np.ndarray, friction: Friction) -> Callable[[float, np.ndarray], float]:
        return lambda t, y: float(row @ (self.applied(t, y) + self.sliding(t, friction)))

    def _plane(self, link: Link, plane: tuple[float, float, float]) -> Callable[[float, np.ndarray], float]:
        a, b, c = plane

        def of(t: float, y: np.ndarray) -> float:
            x, v = self.split(y)
            return a * self.extension(link, x) + b * self.between(link.first, link.second, v) + c

        return of

    def knots(self) -> Iterator[Callable[[float, np.ndarray], float]]:
        """Functions whose change of sign is a kink of a torque."""
        for torque in self.machine.torques:
            for level in torque.speed_knots:
                yield lambda t, y, b=torque.body, level=level: float(self.split(y)[1][b]) - level
            for level in torque.position_knots:
                yield lambda t, y, b=torque.body, level=level: float(self.split(y)[0][b]) - level

    def settle(self, t: float, y: np.ndarray, friction: Friction) -> None:
        """Branches of links that hold just after an instant."""
        for _ in range(20):
            rate = self.rates(friction)(t, y)
            changed = False
            x, v = self.split(y)
            n = self.groups.count
            a = self.groups.ratio * rate[n:][self.groups.of]
            for k, link in enumerate(self.machine.links):
                for (p, q, c), to in link.exits(self.branches[k]):
                    e, s, b = self.extension(link, x), *(self.between(link.first, link.second, z) for z in (v, a))
                    value, slope = p * e + q * s + c, p * s + q * b
                    small = 1e-11 * (abs(p * e) + abs(q * s) + abs(c)) + 1e-15 * (abs(p) + abs(q))
                    if value < -small or (value <= small and slope < 0):
                        self.branches[k] = to
                        changed = True
                        break
            if not changed:
                return
        raise AssertionError(f"links chatter at {t}")

    def go(self, end: float) -> History:
        history, n = History(), self.groups.count
        y = np.zeros(2 * n)
        for b, speed in enumerate(self.machine.speeds):
            if speed:
                y[n + self.groups.of[b]] = speed / self.groups.ratio[b]
        rest = self.rest(y)
        friction = Friction(
            tuple(int(np.sign(y[n + g])) if self.rough[g] else None for g in range(n)),
            tuple(
                int(np.sign(self.between(b.first, b.second, self.split(y)[1])))
                for b in (self.machine.brakes[k] for k in self.clutches)
            ),
            (1,) * len(self.lossy),
        )
        t = 0.0
        self._enter(t, end)
        friction = self._start(t, y, friction, rest)
        self._see(history, y)
        while t < end:
            stop = min([end, *(time for time in self.breaks if time > t)])
            t, y, fired = self.advance(t, y, stop, friction, history)
            if len(history.events) > MOST_EVENTS:
                raise AssertionError("chattering")
            if fired is None:
                self._enter(t, end)
                friction = self._start(t, y, friction, self.rest(y, friction))
                continue
            kind, index, to = fired
            ahead = (t, y)
            rest = self.rest(y, friction)
            if kind == "link":
                self.branches[index] = to  # type: ignore[assignment]
            elif kind == "turning":
                y[n + index] = 0.0
                rest = self.rest(y, friction)
            elif kind == "slip":
                brake = self.machine.brakes[index]
                row = self.groups.row(brake.first, brake.second)
                moved = max(np.flatnonzero(row), key=lambda g: abs(y[n + g]))
                y[n + moved] -= float(row @ y[n:]) / row[moved]
                rest = replace(
                    self.rest(y, friction),
                    clutches=tuple(
                        k == index or still
                        for k, still in zip(self.clutches, self.rest(y, friction).clutches, strict=True)
                    ),
                )
            elif kind == "hold":
                ahead = self.overcome(t, y, friction)
            elif kind == "mesh":
                signs = list(friction.meshes)
                signs[self.lossy.index(index)] *= -1
                friction = replace(friction, meshes=tuple(signs))
            friction = self._start(t, y, friction, rest, ahead)
            history.events.append((t, kind, index, to if kind == "link" else friction))
        history.time = t
        history.positions, history.speeds = self.split(y)
        return history

    def rest(self, y: np.ndarray, friction: Friction | None = None) -> "_Rest":
        """What stands still; held groups and locked clutches do so whatever rounding says."""
        n = self.groups.count
        largest = float(np.abs(y[n:]).max(initial=0.0))
        _, v = self.split(y)
        groups = [abs(y[n + g]) <= 1e-13 * largest for g in range(n)]
        clutches = [
            abs(self.between(b.first, b.second, v)) <= 1e-13 * largest
            for b in (self.machine.brakes[k] for k in self.clutches)
        ]
        if friction is not None:
            groups = [one or turn == 0 for one, turn in zip(groups, friction.turning, strict=True)]
            clutches = [one or slip == 0 for one, slip in zip(clutches, friction.slips, strict=True)]
        return _Rest(tuple(groups), tuple(clutches))

    def _enter(self, t: float, end: float) -> None:
        after = min([end, *(time for time in self.breaks if time > t)])
        self.inside = (t + after) / 2

    def _start(
        self, t: float, y: np.ndarray, friction: Friction, rest: "_Rest", ahead: tuple[float, np.ndarray] | None = None
    ) -> Friction:
        soon, later = ahead or (t, y)
        friction = self.decide(soon, later, friction, rest)
        self.settle(t, y, friction)
        return self.decide(soon, later, friction, rest)

    def overcome(self, t: float, y: np.ndarray, friction: Friction) -> tuple[float, np.ndarray]:
        """A moment so soon after friction is overcome that nothing has moved, and forces tell what will."""
        rate = self.rates(friction)(t, y)
        for step in 10.0 ** np.arange(-10.0, -1.0):
            later = y + step * rate
            if self.spare(t + step, later, friction) < -1e-6:
                return t + step, later
        raise AssertionError(f"friction is not overcome at {t}")

    def advance(
        self, t: float, y: np.ndarray, stop: float, friction: Friction, history: History
    ) -> tuple[float, np.ndarray, tuple[str, int, object] | None]:
        """On to the first event or to `stop`."""
        rates, guards = self.rates(friction), self.guards(friction)
        kinks = [(f, f(t, y) >= 0) for f in self.knots()]
        scale = np.maximum(np.abs(y), 1e-6 * np.abs(y).max(initial=0.0))
        small = 1e-14 * max(float(scale.max(initial=0.0)), 1e-3)
        solver = DOP853(rates, t, y, stop, rtol=RTOL, atol=small, max_step=self.longest)
        sizes = [abs(f(t, y)) for *_, f in guards]
        values = [f(t, y) for *_, f in guards]
        while solver.status == "running":
            solver.step()
            assert solver.status != "failed"
            dense, start, span = solver.dense_output(), solver.t_old, solver.t - solver.t_old
            hits: list[tuple[float, int]] = []
            for number, (kind, _, _, f) in enumerate(guards):
                grid = SAMPLES[1:] if kind != "hold" else SAMPLES[-1:]
                times = [start, *(start + share * span for share in grid)]
                seen = [values[number], *(f(here, dense(here)) for here in times[1:])]
                values[number] = seen[-1]
                sizes[number] = max(sizes[number], *map(abs, seen))
                small = 1e-9 if kind == "hold" else 1e-13 * sizes[number]
                first = next((i for i, value in enumerate(seen) if i and value < -small), None)
                if first is not None:
                    left = times[first - 1]
                    hits.append((left if seen[first - 1] <= 0 else _root(f, dense, left, times[first]), number))
            for number, (f, positive) in enumerate(kinks):
                value = f(solver.t, solver.y)
                if (value >= 0) != positive and abs(value) > 1e-14:
                    at = _root(f, dense, start, solver.t)
                    if at > t + 1e-13:
                        hits.append((at, -1 - number))
                    kinks[number] = (f, value >= 0)
            if hits:
                at, number = min(hits)
                at, state = self._polished(rates, start, dense(start), at, guards[number][3] if number >= 0 else None)
                self._watch(history, start, at, dense)
                if number < 0:
                    return self.advance(at, state, stop, friction, history) if at < stop else (at, state, None)
                return at, state, guards[number][:3]
            self._watch(history, start, solver.t, dense)
        return stop, solver.y, None

    def _polished(
        self,
        rates: Callable[[float, np.ndarray], np.ndarray],
        start: float,
        y: np.ndarray,
        at: float,
        guard: Callable[[float, np.ndarray], float] | None,
    ) -> tuple[float, np.ndarray]:
        if at <= start:
            return start, y
        state = solve_ivp(rates, (start, at), y, method="DOP853", rtol=RTOL, atol=1e-16).y[:, -1]
        if guard is None:
            return at, state
        step = 1e-6 * (at - start)
        for _ in range(2):
            rate = rates(at, state)
            slope = (guard(at + step, state + step * rate) - guard(at - step, state - step * rate)) / (2 * step)
            change = -guard(at, state) / slope if slope else 0.0
            if not abs(change) < 1e-6 * (at - start):
                break
            state, at = state + change * rate, at + change
        return at, state

    # -- extremes -------------------------------------------------------------------------------------------------

    def signals(self, y: np.ndarray) -> dict[tuple[str, int], np.ndarray]:
        """What is watched, from states in columns."""
        n, of, ratio = self.groups.count, self.groups.of, self.groups.ratio[:, None]
        x, v = self.origin[:, None] + ratio * y[:n][of], ratio * y[n:][of]
        found = {("speed", b): v[b] for b in range(self.bodies)} | {("position", b): x[b] for b in range(self.bodies)}
        for k, (link, branch) in enumerate(zip(self.machine.links, self.branches, strict=True)):
            extension = x[link.first] - (0.0 if link.second is None else x[link.second]) - link.rest
            rate = v[link.first] - (0.0 if link.second is None else v[link.second])
            found["link", k] = link.force(branch, extension, rate) + 0 * extension
        return found

    def _see(self, history: History, y: np.ndarray) -> None:
        for name, (value,) in self.signals(y[:, None]).items():
            history.highest[name] = max(history.highest.get(name, -np.inf), float(value))
            history.lowest[name] = min(history.lowest.get(name, np.inf), float(value))

    def _watch(self, history: History, start: float, stop: float, dense: Callable[[np.ndarray], np.ndarray]) -> None:
        """Extremes between two times: of samples, and where they turn of a parabola through much closer ones."""
        times = start + SAMPLES * (stop - start)
        for name, values in self.signals(dense(times)).items():
            for sign, best in ((1, history.highest), (-1, history.lowest)):
                heights = sign * values
                top = max(sign * best.get(name, -sign * np.inf), heights.max())
                index = min(max(int(heights.argmax()), 1), len(times) - 2)
                if heights[index] + np.abs(np.diff(heights)).max() > top and _turns(heights[index - 1 : index + 2]):
                    near = np.linspace(times[index - 1], times[index + 1], 41)
                    closer = sign * self.signals(dense(near))[name]
                    middle = min(max(int(closer.argmax()), 1), len(near) - 2)
                    top = max(top, closer.max(), _summit(closer[middle - 1 : middle + 2]))
                best[name] = float(sign * top)


def _root(
    f: Callable[[float, np.ndarray], float], dense: Callable[[float], np.ndarray], left: float, right: float
) -> float:
    return float(brentq(lambda s: f(s, dense(s)), left, right, xtol=1e-15, rtol=1e-14))


def _turns(heights: np.ndarray) -> bool:
    """Whether the parabola through three equally spaced values has its summit among them."""
    slope, bend = (heights[2] - heights[0]) / 2, heights[2] - 2 * heights[1] + heights[0]
    return bool(bend < 0 and abs(slope) <= 1.2 * abs(bend))


def _summit(heights: np.ndarray) -> float:
    """Summit of the parabola through three equally spaced values; the largest of them where it has none inside."""
    slope, bend = (heights[2] - heights[0]) / 2, heights[2] - 2 * heights[1] + heights[0]
    if bend < 0 and abs(slope) <= abs(bend):
        return float(heights[1] - slope**2 / (2 * bend))
    return float(heights.max())


@dataclass(frozen=True)
class _Rest:
    """Which groups stand still and which clutches turn alike."""

    groups: tuple[bool, ...]
    clutches: tuple[bool, ...]


def simulate(machine: Machine, end: float) -> History:
    """The motion of a machine from time 0 to `end`."""
    return _Run(machine).go(end)
