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
from ptmcalc.numerics.belt.course import Course, FloatArray

_DAMPED = 1.0
"""Viscosity of the spans in a front over what just keeps neighbouring lumps from ringing."""
_LATE, _LATEST = 0.3, 0.02
"""Weight of the end of a step in the mean tension of a span, in a front and where there is none."""
_ROUNDS = 60
_CLOSE = 1e-6
"""Relative change of every tension below which Newton's rule is at its end: the next one would be its square."""
_LEAP = 1.5
"""Largest change of the logarithm of a tension in one round."""
_TOGETHER = 2
"""Rounds of all nodes; later ones are of those that have not settled."""


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
    """The nodes between cells, and what they give.

    Args:
        course: the cells, with `sag` (w l)^2 h/24 of their spans [N^2*m].
        rubber: None for an elastic belt.
        stiffness: EA of the relaxed belt [N].
    """

    def __init__(self, course: Course, rubber: Rubber | None, stiffness: float) -> None:
        nodes = slice(1, -1)
        self.before, self.after = course.before[nodes], course.after[nodes]
        self.step = course.step
        self.spans = _Spans(
            _at_nodes(course.sag, course.tail), course.climb[nodes], (self.before + self.after) / 2, course.step
        )
        stiffer, time = (rubber.stiffer, rubber.time) if rubber else (0.0, 1.0)
        lengths = _at_nodes(np.diff(course.places), course.tail)
        self.lengths, self.climb = np.where(lengths > 0, lengths, 1.0), course.climb[nodes]
        self.settled = stiffer / (1 + stiffer) / stiffness
        """retarded strain over tension, in the end [1/N]"""
        self.yields = lengths * self.settled
        """retarded strain over tension, in the end [m/N]"""
        slow = time * (1 + stiffer)
        self.eager = 1 / (slow + course.step / 2)
        self.heats = np.divide(slow, self.yields, out=np.zeros_like(self.yields), where=self.yields > 0)

    def begin(self, tension: FloatArray) -> None:
        """At rest in itself under tensions at the nodes, less gravity's part, shape (nodes,) [N].

        Raises:
            NumericsError: NUM102 when spans that sag have no tension.
        """
        self.spans.begin(tension)
        self.retarded = self.yields * tension
        self.heat = 0.0

    def pass_on(
        self, into: FloatArray, out: FloatArray, friction: FloatArray, drag: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Speeds of the belt before and behind every node where `into` arrives from upstream and `out` from
        downstream, with friction and drag on the belt before it.

        Raises:
            NumericsError: NUM101 when no tension of the spans is found.
        """
        spans, inner, own = self.spans, self.yields * self.eager, -self.retarded * self.eager
        rows = np.array((*spans.rows(), into, out, friction, self.before + drag, self.after, inner, own))
        tried = spans.tension
        v, tension, change = _round(rows, tried)
        for _ in range(1, _TOGETHER):
            tried = tried * np.exp(change)
            v, tension, change = _round(rows, tried)
        late = np.flatnonzero(~(np.abs(change) <= _CLOSE))  # what is no number never settles
        if len(late):
            rows, tried = rows[:, late], tried.copy()
            for _ in range(_ROUNDS):
                tried[late] *= np.exp(change[late])
                v[late], tension[late], change[late] = _round(rows, tried[late])
                if (np.abs(change[late]) <= _CLOSE).all():
                    break
            else:
                raise NumericsError("NUM101", "the spans of the belt find no tension")
        gives = spans.settle(tried * (1 + change), tension)
        retards = inner * tension + own
        self.retarded = self.retarded + self.step * retards
        self.heat += self.step * float(self.heats @ (retards * retards))
        return v, v + gives + retards

    @property
    def strain(self) -> FloatArray:
        """Retarded strain at the nodes, that of gravity's tension included."""
        return self.retarded / self.lengths + self.settled * self.climb

    def restrain(self, strain: FloatArray) -> None:
        """Give the nodes another retarded strain."""
        self.retarded = (strain - self.settled * self.climb) * self.lengths

    @property
    def lost(self) -> float:
        """Energy that damping has taken so far, that of the numbers included [J]."""
        return self.heat + self.spans.heat

    @property
    def stored(self) -> float:
        """Energy in spans and retarded strain [J]."""
        rubber = np.divide(self.retarded**2, 2 * self.yields, out=np.zeros_like(self.yields), where=self.yields > 0)
        return self.spans.stored + float(rubber.sum())

    @property
    def compliance(self) -> FloatArray:
        """What the spans at the nodes give per tension as they hang now, 2 k/S^3 [m/N]."""
        compliance: FloatArray = 2 * self.spans.sags * self.spans.slackness**3
        return compliance

    @property
    def length(self) -> float:
        """What they give now [m]; of the spans less than nothing."""
        return float(self.retarded.sum()) + self.spans.length


class _Spans:
    """Spans that sag. Their state is the tension at the last half step, gravity's included."""

    def __init__(self, sags: FloatArray, climb: FloatArray, impedance: FloatArray, step: float) -> None:
        self.sags, self.climb, self.step, self.rate = sags, climb, step, sags / step
        self.hang = (sags > 0).astype(float)
        self.between = np.zeros_like(sags)
        self.between[1:-1] = self.hang[2:] * self.hang[1:-1] * self.hang[:-2]
        self.damped = _DAMPED * np.sqrt(sags * impedance / (2 * step))

    def begin(self, tension: FloatArray) -> None:
        whole = np.where(self.sags > 0, tension + self.climb, 1.0)
        if (whole <= 0).any():
            raise NumericsError("NUM102", "the belt is slack at the start: its spans have no shape")
        self._stand(whole)
        self.heat = 0.0

    def _stand(self, tension: FloatArray) -> None:
        self.tension, self.slackness = tension, 1 / tension
        front = np.zeros_like(tension)
        front[1:-1] = np.abs(tension[2:] - tension[:-2]) * self.slackness[1:-1]
        front *= self.between
        np.minimum(front, 1.0, out=front)
        self.viscous = self.damped * tension * np.sqrt(tension) * front
        self.late = np.maximum(_LATE * front, _LATEST)
        self.stored = float((self.sags * self.slackness * (self.climb * self.slackness - 2)).sum())
        """energy U - climb e = -2 k/S + climb k/S^2 [J]"""

    def rows(self) -> tuple[FloatArray, ...]:
        """What `_round` asks of the spans."""
        return self.rate, self.climb, self.hang, self.slackness, self.viscous, self.late

    def settle(self, tension: FloatArray, passed: FloatArray) -> FloatArray:
        """Go to the tensions of the next half step, `passed` on by the nodes meanwhile; what the spans give [m/s]."""
        before, slack = self.stored, self.slackness
        self._stand(tension)
        gives: FloatArray = self.rate * (slack**2 - self.slackness**2)
        self.heat += float(passed @ gives) * self.step - (self.stored - before)
        return gives

    @property
    def length(self) -> float:
        return -float(self.sags @ self.slackness**2)


def _round(rows: FloatArray, tried: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """One round of Newton's rule at some nodes: speed before them, tension that they pass on, and the change of the
    logarithm of the `tried` tensions of their spans.

    A span is taken as a line: it gives `known` + `soft` times its tension.
    """
    rate, climb, hang, slackness, viscous, late, into, out, friction, against, after, inner, own = rows
    slack = 1 / tried
    square = slack * slack
    drawn, slope = slackness * slackness - square, 2 * slack * square
    whole = 1 / (1 + tried * slackness)
    mean = 2 * (1 - late) * whole
    held = tried * (mean + late) + viscous * drawn - climb
    stiff = mean * whole + late + viscous * slope
    soft = rate * slope / stiff
    share = 1 / (1 + after * (inner + soft))
    behaves = after * share
    arrives = out * share - behaves * (own + rate * drawn - soft * held)
    q = arrives - into
    v = np.copysign(np.maximum(np.abs(q) - friction, 0.0), q) / (against + behaves)
    tension = arrives - behaves * v
    change = np.minimum(np.maximum((tension - held) * slack / stiff * hang, -_LEAP), _LEAP)
    return v, tension, change


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
