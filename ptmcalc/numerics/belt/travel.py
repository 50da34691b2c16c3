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

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.belt import compiled
from ptmcalc.numerics.belt.compiled import address, library
from ptmcalc.numerics.belt.course import Course, FloatArray
from ptmcalc.numerics.belt.give import Give
from ptmcalc.numerics.belt.station import Seen

_WAY = 0.25
"""Largest part of a cell by which the belt goes on from one time of carrying to the next."""
_SELDOM = 4
"""Most steps of the waves from one time of carrying to the next."""


class Travel:
    """What the cells carry along. The steps are those of `march.c`.

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
        cell_back, cell_ahead, node_back, node_ahead = gaps = np.zeros((4, course.cells))
        for first, last in ((0, course.tail), (course.tail, course.cells)):
            start, end = course.places[first], course.places[last]
            cell_back[first:last], cell_ahead[first:last] = _gaps(start, course.middles[first:last], end)
            nodes = slice(first, last - 1)
            node_back[nodes], node_ahead[nodes] = _gaps(start, course.places[first + 1 : last], end)
        given = course.climb_within, course.cell_impedance, course.goes
        self._alive = (*map(np.ascontiguousarray, given), *gaps, *np.zeros((4, course.cells)))
        self.state = compiled.Travel(
            course.cells, course.tail, self.every, 0, course.step, stiffness, *map(address, self._alive)
        )
        self.at = compiled.address_of(self.state)
        """where C finds it"""

    def creep(self, speed: float, on: float, off: float) -> float:
        """By how much a belt of one speed before a drum is faster behind it, by its tensions there [m/s]."""
        return speed * (off - on) / self.stiffness

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
        ends = [(compiled.End * 2)(*map(_end, seen)) for seen in (head, tail)]
        library().belt_carry(
            self.at,
            address(against),
            address(along),
            compiled.address_of(ends[0]),
            compiled.address_of(ends[1]),
            give.at if give else None,
        )

    @property
    def carried(self) -> int:
        """How often all was carried on so far."""
        return int(self.state.carried)


def _end(seen: Seen) -> compiled.End:
    return compiled.End(seen.tensions[0], seen.tensions[-1], seen.belt, seen.behind)


def _gaps(start: float, places: FloatArray, end: float) -> tuple[FloatArray, FloatArray]:
    """Distances of places along a strand from the one before and the one behind each, all in order [m]."""
    gaps = np.diff(np.concatenate([[start], places, [end]]))
    return gaps[:-1], gaps[1:]
