"""What a belt carries along as it runs: its own tension, speed and retarded strain go with it.

Seen from the frame, a belt that runs with speed w and stretches by little obeys

    dS/dt + w dS/dx = EA dw/dx          rho dw/dt + rho_b w dw/dx = dS/dx - friction - climb

with rho_b the mass per length that goes with the belt (idlers turn where they are). The cells solve both without the
second terms on the left; those are made up for every few steps, by taking each value from where the belt came from:

    S(x) <- S(x - w t)          w(x) <- w(x - b w t),   b = rho_b/rho

on a parabola through the neighbours, held between a value and that of the neighbour it came from, so that a front does
not ring. As much belt comes onto a drum as leaves it, so behind one it is faster by w (S_off - S_on)/EA: its creep.

**Range** strains far below 1; a belt slower than its waves.
**Error** first order in the time between two such steps, second in the cells where the tension is smooth.
**Source** balance of mass and momentum of a moving string; derived.
"""

from dataclasses import dataclass

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.belt.course import Course, FloatArray
from ptmcalc.numerics.belt.give import Give
from ptmcalc.numerics.belt.station import Seen

_WAY = 0.25
"""Largest part of a cell by which the belt goes on from one time of carrying to the next."""
_SELDOM = 4
"""Most steps of the waves from one time of carrying to the next."""


class Travel:
    """What the cells carry along.

    Args:
        course: the cells.
        stiffness: EA of the relaxed belt [N].
        speed: at which the belt is to run [m/s].

    Raises:
        NumericsError: NUM102 when the belt is not slower than its waves in every cell.
    """

    def __init__(self, course: Course, stiffness: float, speed: float) -> None:
        slowest = float((np.diff(course.places) / course.step).min())
        if speed >= slowest:
            raise NumericsError(
                "NUM102", f"the belt runs at {speed:.3g} m/s and its waves at {slowest:.3g} m/s: none comes back"
            )
        self.course, self.stiffness = course, stiffness
        part = speed * course.step / float(np.diff(course.places).min())
        self.every = int(min(max(_WAY / part, 1), _SELDOM))
        self._strands = tuple(
            _Strand.cut(course, first, last) for first, last in ((0, course.tail), (course.tail, course.cells))
        )

    def creep(self, speed: float, on: float, off: float) -> float:
        """By how much a belt of one speed before a drum is faster behind it, by its tensions there [m/s]."""
        return speed * (off - on) / self.stiffness

    def creep_at(self, seen: Seen) -> float:
        """The creep of a station as it was seen last [m/s]."""
        return self.creep(seen.belt, seen.tensions[0], seen.tensions[-1])

    def running(self, tension: FloatArray, speed: float) -> FloatArray:
        """Speeds of the cells of a belt that comes onto its head with one speed and runs evenly [m/s], by its tensions
        less gravity's part."""
        course = self.course
        whole = tension + course.climb_within
        on = tension[-1] + course.climb[-1]
        speeds: FloatArray = speed * (1 + (whole - on) / self.stiffness)
        return speeds

    def carry(
        self,
        against: FloatArray,
        along: FloatArray,
        head: tuple[Seen, Seen],
        tail: tuple[Seen, Seen],
        give: Give | None,
    ) -> None:
        """Carry all on by the way the belt goes in `every` steps; the waves of the cells change in place. Of head and
        tail it takes how they were seen one step before and now."""
        course = self.course
        tension = (against + along) / 2 + course.climb_within
        speed = (against - along) / (2 * course.cell_impedance)
        way = speed * (self.every * course.step)
        strain = give.strain if give and give.settled else None
        for strand, behind, before in zip(
            self._strands, (_soon(head), _soon(tail)), (_soon(tail), _soon(head)), strict=True
        ):
            cells, nodes = strand.cells, strand.nodes
            tension[cells] = strand.middles.shifted(tension[cells], behind.off, before.on, way[cells])
            moved = course.goes[cells] * way[cells]
            speed[cells] = strand.middles.shifted(speed[cells], behind.leaves, before.comes, moved)
            if give and strain is not None:
                there = (way[:-1] + way[1:])[nodes] / 2
                ends = give.settled * behind.off, give.settled * before.on
                strain[nodes] = strand.places.shifted(strain[nodes], *ends, there)
        tension -= course.climb_within
        speed *= course.cell_impedance
        np.add(tension, speed, out=against)
        np.subtract(tension, speed, out=along)
        if give and strain is not None:
            give.restrain(strain)


@dataclass(frozen=True, slots=True)
class _End:
    """A station half a step from now, to which the cells refer: tensions before and behind it, speeds of the belt."""

    on: float
    off: float
    comes: float
    leaves: float


def _soon(seen: tuple[Seen, Seen]) -> _End:
    earlier, now = seen

    def later(before: float, after: float) -> float:
        return 1.5 * after - 0.5 * before

    return _End(
        later(earlier.tensions[0], now.tensions[0]),
        later(earlier.tensions[-1], now.tensions[-1]),
        later(earlier.belt, now.belt),
        later(earlier.behind, now.behind),
    )


@dataclass(frozen=True, slots=True)
class _Strand:
    """A strand between head and tail: its cells, and the nodes within it."""

    cells: slice
    middles: "_Line"
    nodes: slice
    places: "_Line"

    @classmethod
    def cut(cls, course: Course, first: int, last: int) -> "_Strand":
        cells, nodes = slice(first, last), slice(first, last - 1)
        ends = float(course.places[first]), float(course.places[last])
        inner = course.places[first + 1 : last]
        return cls(cells, _Line(course.middles[cells], *ends), nodes, _Line(inner, *ends))


class _Line:
    """Places along a strand and its ends, all in order [m]."""

    def __init__(self, places: FloatArray, start: float, end: float) -> None:
        gaps = np.diff(np.concatenate([[start], places, [end]]))
        self.back, self.ahead = gaps[:-1], gaps[1:]

    def shifted(self, values: FloatArray, start: float, end: float, way: FloatArray) -> FloatArray:
        """Values that were so far behind each place, none of them farther than its neighbours."""
        whole = np.concatenate([[start], values, [end]])
        slopes = np.diff(whole) / np.concatenate([self.back, self.ahead[-1:]])
        way = np.clip(way, -self.ahead, self.back)
        bend = (slopes[1:] - slopes[:-1]) / (self.back + self.ahead)
        found = values - way * (slopes[:-1] + (self.back - way) * bend)
        origin = np.where(way > 0, whole[:-2], whole[2:])
        shifted: FloatArray = np.clip(found, np.minimum(values, origin), np.maximum(values, origin))
        return shifted
