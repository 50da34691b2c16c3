"""The steady cycle of a shaft: the motion that closes after a cycle, found as a root and never by running long."""

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.machines.shaft.machine.model import Machine, split
from ptmcalc.numerics.cycle import Grid, Orbit, Rate, solve
from ptmcalc.numerics.distinct import distinct

FloatArray = NDArray[np.float64]

FINE, COARSE = 12, 8  # nodes of a stretch, and of the run the bar is read from
_LONGEST = math.pi / 8
"""Longest stretch of the first grid [rad], 1/16 turn; at most a quarter of the cycle. A numerical choice: refinement
divides stretches where needed. A larger value may miss narrow changes of the torque; a smaller one costs time in
proportion."""
_SHORTEST = 1e-11  # of the cycle
_TOLERANCE, _ROUNDING = 1e-12, 1e-15
"""Last coefficients up to which a stretch is not divided, relative to the largest rate and to the largest e = w^2/2
[1]. A numerical choice: 1e-12 is below the reported accuracy, 1e-15 is a few units of the resolution of floating-point
numbers. Larger values reduce the accuracy; smaller ones divide rounding."""
_UNSEEN = 16 * float(np.finfo(float).eps)  # of e: what its last digits make of its rate is no tail, 0.4 to 3 of eps
_ON_EDGE, _NEAR_EDGE = 1e-9, 0.05  # shares of a stretch
_MOST_STRETCHES, _MOST_REFINED, _MOST_SECANTS = 3_000, 10_000, 40
"""Stretches of a cycle, stretches of all refinements together, and root-finding steps for a corner of the torque [1]. A
numerical choice: smaller values end the refinement early and may refuse a cycle with NUM101. Larger ones allow longer
runs."""
_STARTS, _MOST_MARCHED = 28, 1000
"""Initial speeds tried for a steady cycle, and stretches tried one by one in that search [1]. A numerical choice: fewer
initial speeds may miss a cycle in a narrow speed range. Fewer stretches refuse the search early with NUM103; more of
both cost time."""
_ROUGH = 1e-7  # of the value at the beginning of a stretch, where only the way to the cycle is looked for
_SAMPLES = np.linspace(0.0, 1.0, 41)


@dataclass(frozen=True)
class Cycle:
    """A closed motion with enough stretches that it is known to rounding, and the same with fewer nodes."""

    machine: Machine
    orbit: Orbit
    rough: Orbit
    work: int
    known: dict[bool, tuple[float, float]] = field(default_factory=dict, compare=False)
    """largest kinetic energy and its angle, with the mean inertia or not, once somebody asked"""

    def speeds(self, order: int = 16) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Angles, speeds and weights of a quadrature over the cycle."""
        angle, e, weight = self.orbit.sample(order)
        return angle, np.sqrt(2 * e), weight

    def speed_at(self, angle: float) -> float:
        """Speed at an angle [rad/s]."""
        return math.sqrt(2 * float(self.orbit.at(angle % self.machine.period)))


@dataclass(frozen=True, slots=True)
class Law:
    """What acts besides the machine itself, long after the start or the command to stop: the stage of the motor (None:
    switched off) and the torque of the brake [N*m]."""

    stage: int | None
    brake: float = 0.0


def running(machine: Machine) -> Law:
    """The motor in its last stage, the brake open."""
    return Law(len(machine.drive.stages) - 1)


def rate(machine: Machine, grid: Grid, law: Law) -> Rate:
    """de/dphi at the nodes of a grid, and its derivative by e = w^2/2."""
    low, high = grid.edges[:-1, None], grid.edges[1:, None]
    angles = grid.angles
    inertia, slope, static = machine.fields(angles, low, high)
    drive, ratio = machine.drive, machine.drive.ratio
    static, stage = static + law.brake, law.stage
    off = np.zeros(static.shape)

    def of(e: FloatArray) -> tuple[FloatArray, FloatArray]:
        w = np.sqrt(2 * e)
        torque, rise = (off, off) if stage is None else (drive.torque(stage, w), drive.slope(stage, w))
        resistance = static + machine.viscous * w + slope * e
        factor = drive.factor(torque, inertia, resistance)
        whole = machine.total_inertia(inertia, factor)
        f = (ratio * factor * torque - resistance) / whole
        g = ((ratio * factor * rise - machine.viscous) / w - slope) / whole
        return f, g

    return of


def closed_cycle(machine: Machine, near: Orbit | None = None) -> Cycle | None:
    """The steady cycle of a machine, the fastest one that is found; None where the motor stalls.

    `near` is the motion of a machine that differs little.

    Raises:
        NumericsError: the speed is not determined, or the motor would race without end.
    """
    law = running(machine)
    work = 0
    if near is not None:
        orbit = solve(near.grid, rate(machine, near.grid, law), near.nodes)
        work += near.grid.angles.size
        if orbit is not None and orbit.multiplier < 1:
            return _finished(machine, orbit, work)
    if not machine.sound:
        raise NumericsError("NUM102", "the inertia is not above 0 at every angle")
    if machine.races:
        raise NumericsError("NUM102", "the drive exceeds all resistance at any speed: there is no steady cycle")
    grid = first_grid(machine, FINE)
    for speed in machine.working_speeds:
        orbit = solve(grid, rate(machine, grid, law), np.full(grid.angles.shape, speed**2 / 2))
        work += 8 * grid.angles.size
        if orbit is not None and orbit.multiplier < 1:
            return _finished(machine, orbit, work)
    if surely_stalls(machine):
        return None
    orbit = _from_the_map(machine, grid)
    return _finished(machine, orbit, work + 200 * grid.angles.size) if orbit is not None else None


def first_grid(machine: Machine, order: int) -> Grid:
    """Stretches between the breaks of a cycle."""
    return Grid(split(machine.corners, min(_LONGEST, machine.period / 4)), order)


def _finished(machine: Machine, orbit: Orbit, work: int) -> Cycle:
    """The cycle to its last digits, and the same with fewer nodes.

    Raises:
        NumericsError: it does not settle.
    """
    law = running(machine)
    found = refined(machine, law, orbit)
    if found is not None and found[0].multiplier < 1:
        fine, used = found
        grid = fine.grid.with_order(COARSE)
        rough = solve(grid, rate(machine, grid, law), fine.at(grid.angles))
        if rough is not None:
            return Cycle(machine, fine, rough, work + used + 4 * grid.angles.size)
    raise NumericsError("NUM101", "the steady cycle is not found with full accuracy")


def light_cycle(machine: Machine, near: Orbit) -> Cycle | None:
    """The steady cycle of a machine that differs little from another, on the stretches of the other's; None where
    Newton's method finds none from there."""
    orbit = solve(near.grid, rate(machine, near.grid, running(machine)), near.nodes)
    if orbit is None or orbit.multiplier >= 1:
        return None
    return Cycle(machine, orbit, orbit, 6 * near.grid.angles.size)


# -- where to look --------------------------------------------------------------------------------------------------


def surely_stalls(machine: Machine) -> bool:
    """Whether the largest torque of the motor all over a cycle does less work than the load and constant losses."""
    drive = machine.drive
    most = float(np.max(drive.torque(len(drive.stages) - 1, np.append(machine.tried_speeds, 0.0))))
    if drive.breakdown_torque is not None:
        most = max(most, drive.breakdown_torque)
    gained = drive.ratio * drive.efficiency * max(most, 0.0)
    return drive.motor_inertia == 0 and gained <= machine.survey.static_mean


# -- the Poincare map -----------------------------------------------------------------------------------------------


@dataclass(slots=True)
class _Map:
    """Motions over a cycle from any speed at its beginning; each is looked for on the stretches of the one before."""

    machine: Machine
    grid: Grid
    left: int
    """how many stretches may still be tried one by one"""
    last: Orbit | None = None

    def gain(self, speed: float) -> float:
        """P(w) - w; minus infinity where the shaft stalls on the way."""
        orbit = self.run(speed**2 / 2)
        return -math.inf if orbit is None else math.sqrt(2 * float(orbit.within([1.0])[-1, 0])) - speed

    def run(self, e: float) -> Orbit | None:
        """The motion from its value at the first edge; None where the shaft stalls.

        Raises:
            NumericsError: it calls for too many stretches.
        """
        found = self._solved(self.last.grid, self.last.nodes, e) if self.last is not None else None
        if found is None:
            found = self._marched(e)
        self.last = found or self.last
        return found

    def _solved(self, grid: Grid, guess: FloatArray, e: float) -> Orbit | None:
        orbit = solve(grid, rate(self.machine, grid, running(self.machine)), guess, start=e)
        return orbit if orbit is not None and np.all(orbit.tail() <= _ROUGH * orbit.start) else None

    def _marched(self, e: float) -> Orbit | None:
        """Stretch by stretch, each divided where one does not do."""
        done: list[Orbit] = []
        for low, high in zip(self.grid.edges[:-1].tolist(), self.grid.edges[1:].tolist(), strict=True):
            begin, ends, shortest = low, [high], (high - low) * 1e-5
            while ends:
                self.left -= 1
                if self.left < 0:
                    raise NumericsError("NUM103", f"no steady cycle is found within {_MOST_MARCHED} segments")
                piece = self._solved(Grid(np.array([begin, ends[-1]]), FINE), np.full((1, FINE), e), e)
                if piece is not None:
                    done.append(piece)
                    begin, e = ends.pop(), float(piece.within([1.0])[0, 0])
                elif ends[-1] - begin > shortest:
                    ends.append((begin + ends[-1]) / 2)
                else:
                    return None
        edges = np.array([self.grid.edges[0], *(piece.grid.edges[1] for piece in done)])
        start, slopes = np.concatenate([one.start for one in done]), np.concatenate([one.slopes for one in done])
        return Orbit(Grid(edges, FINE), start, slopes, math.nan)


def _from_the_map(machine: Machine, grid: Grid) -> Orbit | None:
    """The cycle from a change of sign of P(w) - w, with P the speed a cycle later, looked for from above.

    P rises with w, as motions over the angle do not cross; where it lies below w at every speed, there is no cycle.
    From below a speed that stalls every other one stalls, too.
    """
    top = next(iter(machine.working_speeds), None) or machine.drive.free_speed or float(machine.tried_speeds[-1])
    starts = [1.5 * top * (1 - k / _STARTS) for k in range(_STARTS)]
    back, gains = _Map(machine, grid, _MOST_MARCHED), list[float]()
    for k, speed in enumerate(starts):
        gains.append(back.gain(speed))
        if gains[-1] > 0:
            return _bracketed(back, speed, starts[k - 1]) if k else None
        if gains[-1] == -math.inf:
            break
    if gains[0] == -math.inf:
        return None
    best = int(np.argmax(gains))
    low, high = starts[min(best + 1, _STARTS - 1)], starts[max(best - 1, 0)]
    for _ in range(24):  # a gain that peaks between two starts
        thirds = low + (high - low) / 3, high - (high - low) / 3
        both = [back.gain(speed) for speed in thirds]
        for speed, gain in zip(thirds, both, strict=True):
            if gain > 0:
                return _bracketed(back, speed, starts[0])
        low, high = (thirds[0], high) if both[1] >= both[0] else (low, thirds[1])
    return None


def _bracketed(back: _Map, low: float, high: float) -> Orbit:
    """The cycle between a speed that a cycle raises and one that it lowers, on the stretches it was passed by.

    Raises:
        NumericsError: Newton's method does not close it: there is one, but it is not found.
    """
    at_low, at_high = back.gain(low), back.gain(high)
    for _ in range(80):
        middle = high - at_high * (high - low) / (at_high - at_low)
        if not low < middle < high:
            middle = (low + high) / 2
        gain = back.gain(middle)
        if gain > 0:
            low, at_low, at_high = middle, gain, at_high / 2
        else:
            high, at_high, at_low = middle, gain, at_low / 2
        if high - low <= 1e-9 * high or gain == 0:
            break
    near = back.run(low**2 / 2)
    if near is not None:
        orbit = solve(near.grid, rate(back.machine, near.grid, running(back.machine)), near.nodes)
        if orbit is not None and orbit.multiplier < 1:
            return orbit
    raise NumericsError("NUM101", "the steady cycle exists but is not found with full accuracy")


# -- refinement -----------------------------------------------------------------------------------------------------


def refined(machine: Machine, law: Law, orbit: Orbit, start: float | None = None) -> tuple[Orbit, int] | None:
    """A motion over the angle with its stretches cut at every corner of the torque and divided until none has a tail
    left, and the evaluations that took; None where it is lost on the way or no end is in sight."""
    work, left = 0, _MOST_REFINED
    while (edges := _better_edges(machine, law, orbit)) is not None:
        left -= len(edges)
        if left < 0:  # corners that do not come to rest, and rates of mere rounding, call for more without end
            return None
        grid = Grid(edges, orbit.grid.order)
        finer = solve(grid, rate(machine, grid, law), orbit.at(grid.angles), start)
        work += 4 * grid.angles.size
        if finer is None:
            return None
        orbit = finer
    return orbit, work


def _better_edges(machine: Machine, law: Law, orbit: Orbit) -> FloatArray | None:
    """Edges with those next to a corner moved onto it, new ones where a corner lies inside a stretch, and stretches
    with a tail halved; None where nothing is to be done."""
    grid = orbit.grid
    edges, lengths = grid.edges.copy(), grid.lengths
    crossings = _crossings(machine, law, orbit)
    new: list[float] = []
    cut: set[int] = set()  # a stretch with a corner on its edge may hold another one that is not seen yet
    changed = False
    for k, place in crossings:
        at = float(edges[k] + place * lengths[k])
        beside = k if place < 0.5 else k + 1
        away = min(place, 1 - place)
        if away <= _ON_EDGE:
            continue
        fixed = np.any(np.abs(machine.corners - grid.edges[beside]) <= _SHORTEST * machine.period)
        if away < _NEAR_EDGE and not fixed:
            edges[beside] = at
        elif at - grid.edges[k] > _SHORTEST * machine.period < grid.edges[k + 1] - at:
            new.append(at)
        else:
            continue
        changed = True
        cut.add(k)
    nodes = orbit.nodes
    steep = np.abs(rate(machine, grid, law)(nodes)[1] * nodes).max(axis=1)
    least = _TOLERANCE * float(np.abs(orbit.rates).max()) + _ROUNDING * float(orbit.start.max())
    bad = orbit.tail() > least + _UNSEEN * steep * lengths
    for k in np.flatnonzero(bad & (lengths > _SHORTEST * machine.period)).tolist():
        if k not in cut and len(lengths) < _MOST_STRETCHES:
            new.append(float((grid.edges[k] + grid.edges[k + 1]) / 2))
            changed = True
    return distinct(np.append(edges, new)) if changed else None


def _crossings(machine: Machine, law: Law, orbit: Orbit) -> list[tuple[int, float]]:
    """Places in stretches at which a mark changes its sign, the first one of each mark and stretch."""
    low, high = orbit.grid.edges[:-1, None], orbit.grid.edges[1:, None]
    values = marks(machine, law, low + (high - low) * _SAMPLES, orbit.within(_SAMPLES), low, high)
    which, cells, first, ends = [], [], [], []
    for number, sampled in enumerate(values):
        above = sampled > 0
        turns = above[:, 1:] != above[:, :-1]
        for k in np.flatnonzero(turns.any(axis=1)).tolist():
            i = int(np.argmax(turns[k]))
            which.append(number)
            cells.append(k)
            first.append(float(_SAMPLES[i]))
            ends.append((float(sampled[k, i]), float(sampled[k, i + 1])))
    if not cells:
        return []
    places = _roots(machine, law, orbit, np.array(which), np.array(cells), np.array(first), np.array(ends))
    return list(zip(cells, places.tolist(), strict=True))


def _roots(
    machine: Machine,
    law: Law,
    orbit: Orbit,
    which: NDArray[np.intp],
    cells: NDArray[np.intp],
    first: FloatArray,
    ends: FloatArray,
) -> FloatArray:
    """The changes of sign behind some samples, all at once, by false position on the polynomials (Illinois)."""
    begin, end = orbit.grid.edges[cells][:, None], orbit.grid.edges[cells + 1][:, None]
    left, right = first.copy(), first + float(_SAMPLES[1])
    at_left, at_right = ends.T.copy()
    place = right.copy()
    for _ in range(_MOST_SECANTS):
        steep = at_right - at_left
        share = np.where(steep != 0, at_right / np.where(steep != 0, steep, 1.0), 0.5)
        place = np.clip(right - share * (right - left), left, right)
        angle = begin + place[:, None] * (end - begin)
        at = np.array(marks(machine, law, angle, orbit.at(angle), begin, end))[which, np.arange(len(cells)), 0]
        on_right = (at > 0) == (at_right > 0)
        at_left, at_right = (
            np.where(on_right, at_left / 2, at),
            np.where(on_right, at, at_right / 2),
        )
        moved = np.where(on_right, right - place, place - left)
        left, right = np.where(on_right, left, place), np.where(on_right, place, right)
        if np.all((np.abs(at) == 0) | (moved <= 1e-13) | (right - left <= 1e-13)):
            break
    return place


def marks(
    machine: Machine, law: Law, angle: FloatArray, e: FloatArray, low: ArrayLike, high: ArrayLike
) -> list[FloatArray]:
    """Values whose sign changes at a corner of the motor's curve, and where the power through the gear turns."""
    drive = machine.drive
    w = np.sqrt(2 * np.maximum(e, 0.0))
    found = []
    if law.stage is not None:
        found += [w - knot for knot in drive.knots(law.stage)]
    if drive.lossy_both_ways and (law.stage is not None or drive.motor_inertia > 0):
        inertia, slope, static = machine.fields(angle, low, high)
        resistance = static + law.brake + w * (machine.viscous + slope * w / 2)
        torque = drive.torque(law.stage, w) if law.stage is not None else np.zeros(w.shape)
        found.append(torque + drive.motor_inertia * drive.ratio / inertia * resistance)
    return found
