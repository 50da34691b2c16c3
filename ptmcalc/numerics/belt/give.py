"""What a belt gives besides its elastic stretch: spans that sag, and rubber that yields in its own time.

Lumped at the nodes like the idlers, in series with the cells: one tension S = N + Z_u v_u + W sgn v_u passes through,
and the belt behind the node is faster than before it by what the node gives, v_d - v_u = e_s' + e_r':

    sag of the spans        S = sqrt(k/-e_s) + q e_s',    k = sum (w l)^2 h/24      (Ernst's law, integrated)
    retarded strain         S = e_r/(J h) + t_s e_r'/(J h)                          (Zener, standard linear solid)

Both stand at half steps, e' = (e+ - e-)/dt, with the mean tension that their energy asks for, (U+ - U-)/(e+ - e-): a
step neither makes nor loses energy. For sag that is the harmonic mean 2/(1/S- + 1/S+), which no front may exceed; so a
part of S+ itself is mixed in. Waves of a belt that sags steepen to fronts, which lumps answer by ringing: there, and
only there, q = Z/sqrt(f) damps them, f the give of a lump over that of its cell. Both vanish with the step.

A Kelvin-Voigt belt of retardation time t_r is the limit g -> inf, g t_x = t_r of a Zener belt with relaxed stiffness EA
and g EA more for short: its cells take g = t_r n/T with T/n the elastic travel time of a cell.

**Error** first order in the step for sag and for Kelvin-Voigt, second for Zener.
"""

from dataclasses import dataclass

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.belt import compiled
from ptmcalc.numerics.belt.compiled import address, check, library
from ptmcalc.numerics.belt.course import Course, FloatArray

_DAMPED = 1.0
"""Viscosity of the spans in a front over what just keeps neighbouring lumps from ringing."""


@dataclass(frozen=True, slots=True)
class Rubber:
    """A belt of two stiffnesses: `stiffer` times its own on top for short times, and its relaxation time [s]."""

    stiffer: float
    time: float

    @classmethod
    def voigt(cls, retardation: float, contour_time: float, cells: int) -> "Rubber":
        """What stands for a Kelvin-Voigt belt in so many cells."""
        travel = contour_time / cells
        return cls(retardation / travel, travel)


class Give:
    """The nodes between cells, and what they give. The steps are those of `march.c`.

    Args:
        course: the cells, with `sag` (w l)^2 h/24 of their spans [N^2*m].
        rubber: None for an elastic belt.
        stiffness: EA of the relaxed belt [N].
    """

    def __init__(self, course: Course, rubber: Rubber | None, stiffness: float) -> None:
        nodes, step = slice(1, -1), course.step
        self.before, self.after, self.climb = (
            np.ascontiguousarray(one[nodes]) for one in (course.before, course.after, course.climb)
        )
        self.sags = _at_nodes(course.sag, course.tail)
        hang = (self.sags > 0).astype(float)
        between = np.zeros_like(hang)
        between[1:-1] = hang[2:] * hang[1:-1] * hang[:-2]
        damped = _DAMPED * np.sqrt(self.sags * ((self.before + self.after) / 2) / (2 * step))
        stiffer, time = (rubber.stiffer, rubber.time) if rubber else (0.0, 1.0)
        lengths = _at_nodes(np.diff(course.places), course.tail)
        self.lengths = np.where(lengths > 0, lengths, 1.0)
        self.settled = stiffer / (1 + stiffer) / stiffness
        """retarded strain over tension, in the end [1/N]"""
        self.yields = lengths * self.settled
        """retarded strain over tension, in the end [m/N]"""
        slow = time * (1 + stiffer)
        eager = 1 / (slow + step / 2)
        heats = np.divide(slow, self.yields, out=np.zeros_like(self.yields), where=self.yields > 0)
        count = len(self.sags)
        self.tension, self.slackness, self.viscous, late, self.retarded, *room = np.zeros((8, count))
        """tension of the spans with gravity's part [N], one over it [1/N], their viscosity, retarded strain [m]"""
        given = (
            self.before, self.after, self.climb, self.sags, self.sags / step, hang, between, damped, self.yields,
            self.yields * eager, heats, self.lengths,
        )  # fmt: skip
        self._alive = (*given, self.tension, self.slackness, self.viscous, late, self.retarded, *room)
        self.state = compiled.Give(count, step, eager, self.settled, *map(address, self._alive))
        self.at = compiled.address_of(self.state)
        """where C finds it"""

    def begin(self, tension: FloatArray) -> None:
        """At rest in itself under tensions at the nodes, less gravity's part, shape (nodes,) [N].

        Raises:
            NumericsError: NUM102 when spans that sag have no tension.
        """
        whole = np.where(self.sags > 0, tension + self.climb, 1.0)
        if (whole <= 0).any():
            raise NumericsError("NUM102", "the belt is slack at the start: its spans have no shape")
        library().belt_hang(self.at, address(whole))
        self.retarded[:] = self.yields * tension
        self.state.span_heat = self.state.rubber_heat = 0.0

    def pass_on(
        self, into: FloatArray, out: FloatArray, friction: FloatArray, drag: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Speeds of the belt before and behind every node where `into` arrives from upstream and `out` from
        downstream, with friction and drag on the belt before it.

        Raises:
            NumericsError: NUM101 when no tension of the spans is found.
        """
        before, behind = np.empty((2, len(into)))
        given = [np.ascontiguousarray(one, float) for one in (into, out, friction, drag)]
        check(library().belt_pass_on(self.at, *map(address, (*given, before, behind))), 0.0)
        return before, behind

    @property
    def rounds(self) -> int:
        """Rounds of Newton's rule in the last step, of the node that took most."""
        return int(self.state.rounds)

    @property
    def strain(self) -> FloatArray:
        """Retarded strain at the nodes, that of gravity's tension included."""
        return self.retarded / self.lengths + self.settled * self.climb

    def restrain(self, strain: FloatArray) -> None:
        """Give the nodes another retarded strain."""
        self.retarded[:] = (strain - self.settled * self.climb) * self.lengths

    @property
    def lost(self) -> float:
        """Energy that damping has taken so far, that of the numbers included [J]."""
        return float(self.state.rubber_heat + self.state.span_heat)

    @property
    def stored(self) -> float:
        """Energy in spans and retarded strain [J]."""
        return float(library().belt_given(self.at))

    @property
    def compliance(self) -> FloatArray:
        """What the spans at the nodes give per tension as they hang now, 2 k/S^3 [m/N]."""
        compliance: FloatArray = 2 * self.sags * self.slackness**3
        return compliance

    @property
    def length(self) -> float:
        """What they give now [m]; of the spans less than nothing."""
        return float(self.retarded.sum()) - float(self.sags @ self.slackness**2)


def _at_nodes(cells: FloatArray, tail: int) -> FloatArray:
    """Half of every cell's part at either end; what would come to head and tail goes to the next node within."""
    found: FloatArray = (cells[:-1] + cells[1:]) / 2
    found[0] += cells[0] / 2
    found[-1] += cells[-1] / 2
    at, last = tail - 1, len(found) - 1
    if last:  # a strand of one cell has no node within; of two such strands the tail is the only node there is
        found[at - 1 if at else 1] += found[at] - cells[at + 1] / 2
        found[at + 1 if at < last else at - 1] += cells[at + 1] / 2
        found[at] = 0.0
    return found
