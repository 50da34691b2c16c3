"""The whole belt in time: transport along the cells, friction at the nodes, the stations at head and tail.

At a node between cells the arriving waves give the belt speed with friction that sticks or slides, event-free:

    q = P - N,   v = sgn q max(|q| - W, 0)/(Z_u + Z_d + K),   N + 2 Z_u v goes upstream, P - 2 Z_d v downstream

**Error** exact transport; second order in the step while all of the belt slides, first order where a front of sticking
or slipping moves.
"""

import math
from dataclasses import dataclass

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.belt import compiled
from ptmcalc.numerics.belt.compiled import address, check, library
from ptmcalc.numerics.belt.course import Course, FloatArray
from ptmcalc.numerics.belt.give import Give
from ptmcalc.numerics.belt.station import Place, Station, Track
from ptmcalc.numerics.belt.travel import Travel
from ptmcalc.numerics.free_waves import Row

MOST_UPDATES = 4_000_000_000
_AT_ONCE = 200_000
"""Cell updates from one return to Python to the next, some milliseconds: only there does an interrupt end the run."""
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
    head: Track
    tail: Track
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
    lost_grip: bool = False
    """whether the march ended since a slipping drum lost its belt (`Until.presses`)"""


@dataclass(frozen=True, slots=True)
class Until:
    """What ends a march before its window, by what the head does."""

    rests_for: float = math.inf
    """so long after the belt there first came to rest [s]"""
    grips_from: float = math.inf
    """from this time on, as soon as no drum turns at another speed than the belt [s]"""
    presses: float = -math.inf
    """as soon as a drum slips with a tension below this beside it [N]: grip below 0 would drive the belt"""


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
    until: Until = Until(),
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
        until: ends the march early.
        give: spans that sag and rubber that yields, None for a straight elastic belt.
        travel: what the running belt carries along, None where its waves run both ways at one speed.

    Raises:
        NumericsError: NUM101 when the window needs too many cell updates, or a step has no solution.
        UsageError: the steps are not compiled.
    """
    step, cells = course.step, course.cells
    steps = int(np.ceil(window / step - 1e-9))
    if steps * cells > MOST_UPDATES:
        raise NumericsError("NUM101", f"the belt would need {steps} steps of {cells} cells")
    one = _March(course, (head, tail), tension, speed, until, give, travel)
    one.run(steps)
    return one.drawn()


class _March:
    """A belt on its way through a window: the arrays that `march.c` works on."""

    def __init__(
        self,
        course: Course,
        stations: tuple[Station, Station],
        tension: FloatArray,
        speed: float,
        until: Until,
        give: Give | None,
        travel: Travel | None,
    ) -> None:
        self.course, self.give = course, give
        self.head, self.tail = head, tail = stations
        cells, impedance, at, step = course.cells, course.cell_impedance, course.tail - 1, course.step
        self.speeds_now = travel.running(tension, speed) if travel else np.full(cells, float(speed))
        self.waves = tension + impedance * self.speeds_now, tension - impedance * self.speeds_now
        against, along = self.waves
        before, after, drags = course.before[1:-1], course.after[1:-1], course.drag[1:-1]
        friction, drag = course.friction[1:-1].copy(), drags.copy()
        friction[at] = drag[at] = 0.0  # the tail's own station has them
        self.speeds, self.doubled = np.zeros((2, cells - 1)), np.zeros((2, cells))
        ways = np.full(cells - 1, speed * step / 2)  # trapezoidal rule: the first speed counts half
        self.longest, self.longest_at = np.maximum(ways, 0.0), np.zeros(cells - 1)
        self.highest, self.highest_at = np.full(cells, -np.inf), np.zeros(cells)
        self.lowest, self.lowest_at = np.full(cells, np.inf), np.zeros(cells)
        if travel:
            head.creep = travel.creep(speed, float(tension[-1] + course.climb[-1]), float(tension[0]))
            tail.creep = travel.creep(speed, float(tension[at]), float(tension[at + 1]))
        head.begin(speed, along[-1], against[0])
        tail.begin(speed, along[at], against[at + 1])
        if give:
            give.begin((tension[:-1] + tension[1:]) / 2)
        given = 2 * before, 2 * after, friction, drag, 1 / (before + after + drags), impedance, course.climb_within
        made = *self.waves, *self.speeds, *self.doubled, np.zeros(cells - 1), ways
        seen = self.highest, self.highest_at, self.lowest, self.lowest_at, self.longest, self.longest_at
        self._alive = given, made
        parts = give.at if give else None, travel.at if travel else None, head.at, tail.at
        self.state = state = compiled.March(
            cells, course.tail, 0, step, *map(address, given), *parts, *map(address, made), *map(address, seen)
        )
        state.rests_for, state.grips_from, state.presses = until.rests_for, until.grips_from, until.presses
        state.rested = -1.0
        self.at = compiled.address_of(state)
        self.rows: list[list[FloatArray]] = []
        self._make_room(1)
        library().belt_start(self.at)
        self.stored, self.length = library().belt_energy(self.at), self._length()
        self.swings = float(((against - along) ** 2 / (8 * impedance)).sum()) * step

    def _make_room(self, steps: int) -> None:
        """Rows for the tensions and stations of so many steps."""
        widths = 2, Track.width(len(self.head.drums)), Track.width(len(self.tail.drums))
        rows = [np.empty((steps, width)) for width in widths]
        self.rows.append(rows)
        self.state.lows, self.state.head_row, self.state.tail_row = map(address, rows)

    def run(self, steps: int) -> None:
        """So many steps, or until the march ends."""
        state, most = self.state, max(_AT_ONCE // self.course.cells, 1)
        while state.k < steps and not state.ended:
            first, many = state.k, min(most, steps - state.k)
            self._make_room(many)
            fault = library().belt_march(self.at, many)
            check(fault, state.k * self.course.step, self.head.raised or self.tail.raised)
            self.rows[-1] = made = [part[: state.k - first] for part in self.rows[-1]]
            if any(np.isnan(part).any() for part in made):
                check(compiled.NOT_FINITE, state.k * self.course.step)

    def _length(self) -> float:
        """Elongation of the belt: sum (P + N)/(2 Z) dt."""
        against, along = self.waves
        whole = float(((against + along) / 2 / self.course.cell_impedance).sum()) * self.course.step
        return whole + (self.give.length if self.give else 0.0)

    def _residual(self, lost: float) -> float:
        """What the energy balance leaves over, relative to all that was turned over [1]."""
        step, state = self.course.step, self.state
        change = library().belt_energy(self.at) - self.stored - state.carried
        turnover = self.swings + abs(change) + (lost + state.exchanged) * step + _ROUNDING * self.stored
        return abs(change + lost * step - state.flow * step) / turnover if turnover else 0.0

    def drawn(self) -> Drawn:
        """What the belt did."""
        course, step, state, k = self.course, self.course.step, self.state, self.state.k
        lows, head, tail = (np.concatenate(parts) for parts in zip(*self.rows, strict=True))
        lost = state.lost + (self.give.lost / step if self.give else 0.0)
        now, then = k % 2, (k - 1) % 2 if k else 0
        if k < 2:  # the row of the start, from which the last rates are taken
            self.speeds[then] = (self.speeds_now[:-1] + self.speeds_now[1:]) / 2
        pulls = self.doubled[1 - now], self.doubled[1 - then]  # the start has a row of its own
        tops, bottoms = self.highest / 2 + course.climb_within, self.lowest / 2 + course.climb_within
        back, carry = slice(0, course.tail), slice(course.tail, course.cells)
        top, low = Track(head, len(self.head.drums)), Track(tail, len(self.tail.drums))
        return Drawn(
            times=np.arange(k + 1, dtype=np.float64) * step,
            head=top,
            tail=low,
            back_max=self._extreme(tops, self.highest_at, back, 1),
            back_min=self._extreme(bottoms, self.lowest_at, back, -1),
            carry_max=self._extreme(tops, self.highest_at, carry, 1),
            carry_min=self._extreme(bottoms, self.lowest_at, carry, -1),
            friction_work=(lost + state.rubbed) * step,
            energy_residual=self._residual(lost),
            stretched=self._length() - self.length,
            updates=k * course.cells,
            highest=tops,
            lowest=bottoms,
            lows=lows,
            longest_way=self._longest(),
            row=_row(
                course, (self.head, top), (self.tail, low), (pulls, (self.speeds[now], self.speeds[then])), self.give
            ),
            lost_grip=state.ended == compiled.LOST_GRIP,
        )

    def _extreme(self, values: FloatArray, when: FloatArray, part: slice, sense: int) -> Extreme:
        """The largest tension of some cells or, by `sense` -1, the smallest."""
        cell = part.start + int((sense * values[part]).argmax())
        time = (float(when[cell]) + 0.5) * self.course.step
        return Extreme(float(values[cell]), time, float(self.course.middles[cell]))

    def _longest(self) -> Extreme:
        """The largest displacement of nodes between the stations [m]; the tail's node counts at its station."""
        inside = self.longest.copy()
        inside[self.course.tail - 1] = 0.0
        node = int(inside.argmax())
        time = float(self.longest_at[node]) * self.course.step
        return Extreme(float(inside[node]), time, float(self.course.places[node + 1]))


def _row(
    course: Course,
    head: tuple[Station, Track],
    tail: tuple[Station, Track],
    rows: tuple[tuple[FloatArray, FloatArray], tuple[FloatArray, FloatArray]],
    give: Give | None,
) -> Row:
    """The belt at the end as a row of masses, its rates by differences over the last step; `rows` are twice the
    tensions and the speeds, of the last step and of the one before. A take-up at the tail cuts the row there."""
    (top, track), (low, lows), step = head, tail, course.step
    (doubled, doubled_then), inside = rows
    cut, drum = course.tail if low.takeup else 0, course.cells

    def speeds(back: int) -> FloatArray:
        seen = track[-min(back, len(track))]
        found = np.concatenate([[seen.behind], inside[back - 1], [seen.belt]])
        there = lows[-min(back, len(lows))]
        found[course.tail] = there.belt
        return np.append(found, there.behind) if cut else found

    masses = (course.before + course.after) / 2 * step
    masses[0], masses[drum] = course.after[0] / 2 * step, course.before[-1] / 2 * step
    compliances = step / course.cell_impedance
    if give:
        compliances[1:] += give.compliance / 2
        compliances[:-1] += give.compliance / 2
    masses[0] += top.takeup.mass / 4 if top.takeup else 0.0
    held, tie = [drum] if top.takeup else [0, drum], 0.0
    if cut:
        masses[cut] = course.before[cut] / 2 * step
        masses, tie = np.append(masses, course.after[cut] / 2 * step), (low.takeup.mass if low.takeup else 0.0) / 4
    if not low.imposes:
        masses[course.tail] += sum(drum.mass for drum in low.drums)
    else:
        held.append(course.tail)
    pulls, rates = (doubled - doubled_then) / 2 / step, (speeds(1) - speeds(2)) / step
    moving = masses.copy()
    moving[held] = 0.0
    if not top.imposes:
        moving[drum] = masses[drum] + sum(drum.mass for drum in top.drums)
    rate_energy = float(compliances @ pulls**2 + moving @ rates**2) / 2
    rate_energy += tie * float(rates[cut] - rates[-1]) ** 2 / 2
    last = speeds(1)
    pull = doubled / 2 + course.climb_within
    return Row(masses, compliances, last - last[drum], pull, tuple(held), rate_energy, cut, tie)
