"""The whole belt in time: transport along the cells, friction at the nodes, the stations at head and tail.

At a node between cells the arriving waves give the belt speed with friction that sticks or slides, event-free:

    q = P - N,   v = sgn q max(|q| - W, 0)/(Z_u + Z_d + K),   N + 2 Z_u v goes upstream, P - 2 Z_d v downstream

**Error** exact transport; second order in the step while all of the belt slides, first order where a front of sticking
or slipping moves.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.belt.course import Course, FloatArray
from ptmcalc.numerics.belt.give import Give
from ptmcalc.numerics.belt.station import Place, Seen, Station
from ptmcalc.numerics.belt.travel import Travel
from ptmcalc.numerics.free_waves import Row

MOST_UPDATES = 4_000_000_000
_BLOCK = 64
_ROUNDING = 1e-8
"""Share of the energy in a belt below which what it exchanges is rounding."""


@dataclass(frozen=True, slots=True)
class Extreme:
    """A value [N], its time [s] and its place along the belt from the head's run-off [m]."""

    value: float
    time: float
    place: float


@dataclass(frozen=True, slots=True)
class Drawn:
    """What a belt did: histories at the stations, extremes of the tension on both strands, sums."""

    times: FloatArray
    head: tuple[Seen, ...]
    tail: tuple[Seen, ...]
    back_max: Extreme
    back_min: Extreme
    carry_max: Extreme
    carry_min: Extreme
    friction_work: float
    """what friction and drag took, those lumped at head and tail included [J]"""
    energy_residual: float
    stretched: float
    """change of the elongation of the belt from start to end [m]"""
    updates: int
    highest: FloatArray
    """largest tension of every cell, gravity's part included [N]"""
    lowest: FloatArray
    """smallest tension of every cell, gravity's part included [N]"""
    lows: FloatArray
    """smallest tension on return and carry strand in every step, shape (steps, 2) [N]"""
    longest_way: Extreme
    """largest displacement of any point between the stations [m], its time and place"""
    row: Row
    """the belt at the end from the head's run-off to its run-on, its pulls whole and its speeds over that at the head;
    a station that no speed is imposed on moves with its drums"""


def place_at(course: Course, node: int, belt_line_mass: float) -> Place:
    """The place of a station: at the tail's node, or at the head (node 0), where the first and the last node meet."""
    if node == 0:
        return Place(
            float(course.before[-1]),
            float(course.after[0]),
            float(course.climb[-1]),
            0.0,
            float(course.friction[-1]),
            float(course.friction[0]),
            float(course.drag[-1]),
            float(course.drag[0]),
            belt_line_mass,
        )
    before, after, climb = float(course.before[node]), float(course.after[node]), float(course.climb[node])
    friction, drag = float(course.friction[node]), float(course.drag[node])
    return Place(before, after, climb, climb, friction, 0.0, drag, 0.0, belt_line_mass)


def march(
    course: Course,
    head: Station,
    tail: Station,
    tension: FloatArray,
    speed: float,
    window: float,
    still: Callable[[float, Seen], bool] | None = None,
    give: Give | None = None,
    travel: Travel | None = None,
) -> Drawn:
    """Carry the belt from its tensions in every cell (without gravity's part) and one speed through the window [s].

    Args:
        course: cells of the belt.
        head: drums at the head.
        tail: drums at the tail.
        tension: tension of every cell less that of gravity, shape (cells,) [N].
        speed: belt speed at the start [m/s].
        window: time to march [s].
        still: ends the march early.
        give: spans that sag and rubber that yields, None for a straight elastic belt.
        travel: what the running belt carries along, None where its waves run both ways at one speed.

    Raises:
        NumericsError: NUM101 when the window needs too many cell updates.
    """
    step, cells = course.step, course.cells
    steps = int(np.ceil(window / step - 1e-9))
    if steps * cells > MOST_UPDATES:
        raise NumericsError("NUM101", f"the belt would need {steps} steps of {cells} cells")
    one = _March(course, (head, tail), tension, speed, give, travel)
    one.run(steps, still)
    return one.drawn()


class _March:
    """A belt on its way through a window: its waves, what is recorded of them, and the sums of work."""

    def __init__(
        self,
        course: Course,
        stations: tuple[Station, Station],
        tension: FloatArray,
        speed: float,
        give: Give | None,
        travel: Travel | None,
    ) -> None:
        self.course, self.give, self.travel = course, give, travel
        self.head, self.tail = head, tail = stations
        cells, impedance = course.cells, course.cell_impedance
        self.at = at = course.tail - 1
        self.speeds_now = travel.running(tension, speed) if travel else np.full(cells, float(speed))
        self.against, self.along = tension + impedance * self.speeds_now, tension - impedance * self.speeds_now
        self.friction, self.drag = course.friction[1:-1].copy(), course.drag[1:-1].copy()
        self.friction[at] = self.drag[at] = 0.0  # the tail's own station has them
        self.tops, self.bottoms, self.ways = _Watch(course, 1), _Watch(course, -1), _Ways(course, speed)
        self.lows: list[FloatArray] = []
        self.block, self.speeds = np.empty((_BLOCK, cells)), np.zeros((_BLOCK, cells - 1))
        if travel:
            head.creep = travel.creep(speed, float(tension[-1] + course.climb[-1]), float(tension[0]))
            tail.creep = travel.creep(speed, float(tension[at]), float(tension[at + 1]))
        self.seen_head = [head.begin(speed, self.along[-1], self.against[0])]
        self.seen_tail = [tail.begin(speed, self.along[at], self.against[at + 1])]
        if give:
            give.begin((tension[:-1] + tension[1:]) / 2)
        self.stored, self.length = self._energy(), self._length()
        self.swings = float(((self.against - self.along) ** 2 / (8 * impedance)).sum()) * course.step
        self.lost = self.rubbed = self.flow = self.exchanged = self.carried = 0.0
        self.k, self.filled = 0, 1
        np.add(self.against, self.along, out=self.block[0])

    def _energy(self) -> float:
        return _energy(self.against, self.along, self.course.cell_impedance, self.course.step, self.give)

    def _length(self) -> float:
        return _length(self.against, self.along, self.course.cell_impedance, self.course.step, self.give)

    def run(self, steps: int, still: Callable[[float, Seen], bool] | None) -> None:
        """So many steps, or until `still`; the loop keeps what it reads at every step in variables of its own."""
        course, head, tail, give, travel = self.course, self.head, self.tail, self.give, self.travel
        seen_head, seen_tail, block, speeds = self.seen_head, self.seen_tail, self.block, self.speeds
        friction, drag, at, step = self.friction, self.drag, self.at, course.step
        before, after = 2 * course.before[1:-1], 2 * course.after[1:-1]
        yields = 1 / (course.before[1:-1] + course.after[1:-1] + course.drag[1:-1])
        within, backward = np.empty(course.cells - 1), -friction
        against, along, filled, k = self.against, self.along, self.filled, self.k
        for k in range(1, steps + 1):
            time = k * step
            n_on, p_off = along[-1], against[0]
            into, out = along[:-1], against[1:]
            if give:
                v, behind = give.pass_on(into, out, friction, drag)
                speeds[filled] = v
            else:
                v = speeds[filled]
                np.subtract(out, into, out=v)
                np.minimum(v, friction, out=within)
                np.maximum(within, backward, out=within)
                v -= within
                v *= yields
                behind = v.copy() if travel else v
            if travel:
                head.creep, tail.creep = travel.creep_at(seen_head[-1]), travel.creep_at(seen_tail[-1])
            now = tail.advance(time, float(into[at]), float(out[at]), step)
            seen_tail.append(now)
            v[at], behind[at] = now.belt, now.behind
            top = head.advance(time, float(n_on), float(p_off), step)
            seen_head.append(top)
            self._work(top, now, (float(n_on), float(p_off), float(into[at]), float(out[at])))
            np.multiply(before, v, out=within)
            into += within
            np.multiply(after, behind, out=within)
            out -= within
            along[-1] = n_on + 2 * head.place.before * top.belt
            against[0] = p_off - 2 * head.place.after * top.behind
            against, along = along, against  # each wave went on by a cell
            if travel and k % travel.every == 0:
                self.against, self.along = against, along
                self._carry(travel, top, now)
            np.add(against, along, out=block[filled])
            filled += 1
            if filled == _BLOCK:
                self._record(filled, k)
                filled = 0
            if still is not None and still(time, top):
                break
        self.against, self.along, self.filled, self.k = against, along, filled, k
        if filled:
            self._record(filled, k)

    def _work(self, top: Seen, now: Seen, waves: tuple[float, float, float, float]) -> None:
        """Count what the stations rub off and give in a step."""
        head, tail = self.head.place, self.tail.place
        self.rubbed += _rubbed(top, head) + _rubbed(now, tail)
        given = _flow(top, now, head, tail, waves)
        self.flow, self.exchanged = self.flow + given, self.exchanged + abs(given)

    def _carry(self, travel: Travel, top: Seen, now: Seen) -> None:
        """Let the running belt carry its waves along, and count the energy that this adds."""
        before = self._energy()
        travel.carry(self.against, self.along, (self.seen_head[-2], top), (self.seen_tail[-2], now), self.give)
        self.carried += self._energy() - before

    def _record(self, filled: int, k: int) -> None:
        """Take extremes, ways and losses of the last steps from the block that holds them."""
        seen, speeds, first = self.block[:filled], self.speeds[:filled], k - filled + 1
        self.tops.see(seen, first)
        self.bottoms.see(seen, first)
        climb = self.course.climb_within
        self.lows.append(np.minimum.reduceat(seen / 2 + climb, (0, self.course.tail), axis=1))
        self.lost += _lost(speeds, self.friction, self.drag)
        self.ways.see(speeds, first)

    def _residual(self, lost: float) -> float:
        """What the energy balance leaves over, relative to all that was turned over [1]."""
        step = self.course.step
        change = self._energy() - self.stored - self.carried
        turnover = self.swings + abs(change) + (lost + self.exchanged) * step + _ROUNDING * self.stored
        return abs(change + lost * step - self.flow * step) / turnover if turnover else 0.0

    def drawn(self) -> Drawn:
        """What the belt did."""
        course, step, k, filled = self.course, self.course.step, self.k, self.filled
        back, carry = slice(0, course.tail), slice(course.tail, course.cells)
        lost = self.lost + (self.give.lost / step if self.give else 0.0)
        if k < 2:  # the row of the start, from which the last rates are taken
            self.speeds[0] = (self.speeds_now[:-1] + self.speeds_now[1:]) / 2
        last = self.block, self.speeds, (filled - 1, filled - 1 - min(k, 1))
        return Drawn(
            times=np.arange(len(self.seen_head), dtype=np.float64) * step,
            head=tuple(self.seen_head),
            tail=tuple(self.seen_tail),
            back_max=self.tops.extreme(back),
            back_min=self.bottoms.extreme(back),
            carry_max=self.tops.extreme(carry),
            carry_min=self.bottoms.extreme(carry),
            friction_work=(lost + self.rubbed) * step,
            energy_residual=self._residual(lost),
            stretched=self._length() - self.length,
            updates=k * course.cells,
            highest=self.tops.best / 2 + course.climb_within,
            lowest=course.climb_within - self.bottoms.best / 2,
            lows=np.concatenate(self.lows),
            longest_way=self.ways.longest(),
            row=_row(course, (self.head, self.seen_head), self.tail, last, self.give),
        )


def _row(
    course: Course,
    head: tuple[Station, list[Seen]],
    low: Station,
    rows: tuple[FloatArray, FloatArray, tuple[int, int]],
    give: Give | None,
) -> Row:
    """The belt at the end as a row of masses, its rates by differences over the last step; `rows` are the blocks of
    twice the tensions and of the speeds, and which of their rows are those of the last step and of the one before."""
    (top, top_seen), step = head, course.step
    doubled, inside, (now, then) = rows

    def speeds(back: int, row: int) -> FloatArray:
        seen = top_seen[-min(back, len(top_seen))]
        return np.concatenate([[seen.behind], inside[row], [seen.belt]])

    masses = (course.before + course.after) / 2 * step
    masses[0], masses[-1] = course.after[0] / 2 * step, course.before[-1] / 2 * step
    compliances = step / course.cell_impedance
    if give:
        compliances[1:] += give.compliance / 2
        compliances[:-1] += give.compliance / 2
    masses[0] += top.takeup.mass / 4 if top.takeup else 0.0
    held = [-1] if top.takeup else [0, -1]
    if low.imposed is None:
        masses[course.tail] += sum(drum.mass for drum in low.drums)
    else:
        held.append(course.tail)
    pulls, rates = (doubled[now] - doubled[then]) / 2 / step, (speeds(1, now) - speeds(2, then)) / step
    moving = masses.copy()
    moving[held] = 0.0
    if top.imposed is None:
        moving[-1] = masses[-1] + sum(drum.mass for drum in top.drums)
    rate_energy = float(compliances @ pulls**2 + moving @ rates**2) / 2
    last = speeds(1, now)
    return Row(masses, compliances, last - last[-1], doubled[now] / 2 + course.climb_within, tuple(held), rate_energy)


def _energy(against: FloatArray, along: FloatArray, impedance: FloatArray, step: float, give: Give | None) -> float:
    """Kinetic and elastic energy of the belt: sum (P^2 + N^2)/(4 Z) dt."""
    return float(((against**2 + along**2) / (4 * impedance)).sum()) * step + (give.stored if give else 0.0)


def _length(against: FloatArray, along: FloatArray, impedance: FloatArray, step: float, give: Give | None) -> float:
    """Elongation of the belt: sum (P + N)/(2 Z) dt."""
    return float(((against + along) / 2 / impedance).sum()) * step + (give.length if give else 0.0)


def _lost(speeds: FloatArray, friction: FloatArray, drag: FloatArray) -> float:
    """Power that friction and drag at the nodes take, summed over steps; speeds of shape (steps, nodes)."""
    moved = np.abs(speeds)
    lost = float((moved @ friction).sum())
    return lost + float((np.square(moved, out=moved) @ drag).sum()) if drag.any() else lost


def _flow(top: Seen, low: Seen, head: Place, tail: Place, waves: tuple[float, float, float, float]) -> float:
    """Power the drums and the take-up give to the belt, by the waves that leave and arrive."""
    n_on, p_off, n_tail, p_tail = waves
    given = (n_on + head.before * top.belt) * top.belt - (p_off - head.after * top.behind) * top.behind
    given += (n_tail + tail.before * low.belt) * low.belt - (p_tail - tail.after * low.behind) * low.behind
    return given


def _rubbed(seen: Seen, place: Place) -> float:
    """Power that friction and drag lumped at a station take."""
    on, off = abs(seen.belt), abs(seen.behind)
    return (place.friction_on + place.drag_on * on) * on + (place.friction_off + place.drag_off * off) * off


class _Watch:
    """Largest (or smallest) tension of every cell so far, and when."""

    def __init__(self, course: Course, sense: int) -> None:
        self.course, self.sense = course, sense
        self.best = np.full(course.cells, -np.inf)
        self.when = np.zeros(course.cells, dtype=np.intp)

    def see(self, block: FloatArray, first: int) -> None:
        """Take in twice the tensions of cells, shape (steps, cells)."""
        signed = block if self.sense > 0 else -block
        at = signed.argmax(axis=0)
        value = signed[at, np.arange(block.shape[1])]
        better = value > self.best
        self.best[better] = value[better]
        self.when[better] = first + at[better]

    def extreme(self, part: slice) -> Extreme:
        """The extreme of some cells, gravity's part included."""
        course = self.course
        value = self.best[part] / 2 + self.sense * course.climb_within[part]
        cell = int(value.argmax())
        index = (part.start or 0) + cell
        time = (float(self.when[index]) + 0.5) * course.step
        return Extreme(self.sense * float(value[cell]), time, float(course.middles[index]))


class _Ways:
    """Displacement of every node between the stations, and the largest so far; the tail's own node is that of its
    station and counts there."""

    def __init__(self, course: Course, speed: float) -> None:
        self.course = course
        self.now = np.full(course.cells - 1, speed * course.step / 2)  # trapezoidal rule: the first speed counts half
        self.best = np.zeros(course.cells - 1)
        self.when = np.zeros(course.cells - 1, dtype=np.intp)

    def see(self, speeds: FloatArray, first: int) -> None:
        """Take in the speeds of nodes, shape (steps, nodes), where the first row of the first block is that of the
        begin and 0."""
        ways = np.cumsum(speeds, axis=0)
        ways *= self.course.step
        ways += self.now
        at = ways.argmax(axis=0)
        value = ways[at, np.arange(ways.shape[1])]
        better = value > self.best
        self.best[better] = value[better]
        self.when[better] = first + at[better]
        self.now = ways[-1].copy()

    def longest(self) -> Extreme:
        """The largest displacement [m]."""
        inside = self.best.copy()
        inside[self.course.tail - 1] = 0.0
        node = int(inside.argmax())
        return Extreme(
            float(inside[node]), float(self.when[node]) * self.course.step, float(self.course.places[node + 1])
        )
