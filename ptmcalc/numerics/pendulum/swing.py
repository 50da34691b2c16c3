"""The motion of a load under a trolley or a jib at any angle, through all events.

Between two events the equations (`equations`) are smooth. A step (`steps`) is a polynomial whose derivative is exact at
the nodes of a Radau rule, found by Newton's method; it is as long as the last Legendre coefficients stay below the
tolerance. Events are roots of the guards (`guards`) on that polynomial; what follows them is in `march`. Everything is
done twice, the second time coarser, in longer steps of a lower order: what differs is the bar of every number.
"""

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.collocation import gauss, radau
from ptmcalc.numerics.pendulum.equations import SIGNALS, WORKS
from ptmcalc.numerics.pendulum.march import March
from ptmcalc.numerics.pendulum.parts import CONSTANT, LINEAR, ORIFICE, Case, Follow, Jib, Peak, Rail, Straight
from ptmcalc.numerics.pendulum.pieces import Pieces
from ptmcalc.numerics.pendulum.track import PLACES, Step, Track, states_of
from ptmcalc.numerics.record import Event

FloatArray = NDArray[np.float64]

TOLERANCE = 1e-11
MOST_STEPS = 20_000
_SEEN = 64 * float(np.finfo(float).eps)
"""Share of the energies at both ends below which rounding hides what is left over."""
_COARSER, _FINE, _COARSE = 300.0, 12, 10
"""Tolerance of the second run over the first one's; nodes of both."""
_DUST = 1e-12
"""Rounding of a peak as a share of the largest value."""
_GAUSS = 20
_STEEPEST = math.radians(89.9)


@dataclass(frozen=True, slots=True)
class Works:
    """Work of everything that acts [J], and what the energy balance leaves over as a share of what was turned over."""

    works: dict[str, float]
    stored: float
    """energy at the end less that at the start"""
    residual: float


@dataclass(frozen=True, slots=True)
class Swing:
    """A motion, computed twice.

    `at`, `largest`, `smallest` and `farthest` know the signals listed in `parts`.
    """

    case: Case
    end: float
    """time at which it ends: the one asked for, or that of a buffer that became solid"""
    events: tuple[Event, ...]
    solid: bool
    """whether a buffer became solid: the speed that was left is that at the end"""
    steps: int
    _fine: Track = field(repr=False)
    _coarse: Track = field(repr=False)

    @property
    def settled(self) -> bool:
        """Whether both runs met the same events; if not, what follows the first other one is uncertain."""
        one, two = ([(e.element, e.after) for e in track.events] for track in (self._fine, self._coarse))
        return one == two and self._fine.finished == self._coarse.finished

    def at(self, name: str, time: ArrayLike) -> FloatArray:
        """A signal at times from 0 to the end, any shape."""
        t = np.asarray(time, float)
        return np.asarray(self.signals((name,), t.ravel())[0].reshape(t.shape))

    def signals(self, names: tuple[str, ...], times: FloatArray) -> FloatArray:
        """Several signals at times from 0 to the end, shape (names, times)."""
        return self._fine.at(names, times)

    def known(self, name: str, time: float) -> Peak:
        """A signal at a time, with its bar."""
        one, two = (float(track.at((name,), np.array([time]))[0, 0]) for track in (self._fine, self._coarse))
        return Peak(one, time, abs(one - two) + _DUST * abs(one))

    def largest(self, name: str, since: float = 0.0, until: float = math.inf) -> Peak:
        """Largest value of a signal in a stretch of time; both sides of a jump count."""
        return self._extremes(name, (1,), since, until)[0]

    def smallest(self, name: str, since: float = 0.0, until: float = math.inf) -> Peak:
        """Smallest value of a signal in a stretch of time."""
        return self._extremes(name, (-1,), since, until)[0]

    def farthest(self, name: str, since: float = 0.0, until: float = math.inf) -> Peak:
        """Largest magnitude of a signal in a stretch of time, with its sign."""
        top, bottom = self._extremes(name, (1, -1), since, until)
        return top if top.value >= -bottom.value else bottom

    def crossing(self, name: str, level: float, since: float = 0.0, rising: bool = True) -> Peak | None:
        """When a signal first goes through a level, with the bar of that time; None where it never does.

        A signal that only touches the level between two places that are looked at may go unseen.
        """
        one, two = (track.crossing(name, level, since, rising) for track in (self._fine, self._coarse))
        if one is None:
            return None
        return Peak(level, one, abs(one - two) + _DUST * self.end if two is not None else math.inf)

    def history(self, names: tuple[str, ...] = SIGNALS) -> tuple[FloatArray, FloatArray]:
        """Times of all places that were looked at, and signals there, shape (names, times)."""
        times, values = [], []
        for leg, steps in self._fine.runs(0.0, self.end):
            t, z, _ = _spread(steps, PLACES)
            times.append(t)
            values.append(leg.signals(names, t, z))
        return np.concatenate(times), np.concatenate(values, axis=1)

    def works(self) -> Works:
        """The energy balance, by Gauss's quadrature of the powers, at places of its own."""
        nodes, weights = gauss(_GAUSS)
        total, turned = np.zeros(len(WORKS)), np.zeros(len(WORKS))
        for leg, steps in self._fine.runs(0.0, self.end):
            t, z, spans = _spread(steps, nodes)
            power = leg.powers(t, z) * (spans[:, None] * weights).ravel()
            total += power.sum(axis=1)
            turned += np.abs(power).sum(axis=1)
        sudden = np.array([self._fine.jerks[name] for name in WORKS])
        total, turned = total + sudden, turned + np.abs(sudden)
        first, last = self._fine.steps[0], self._fine.steps[-1]
        begins = first.leg.stored(np.array([first.start]), first.states(np.zeros(1)))
        ends = last.leg.stored(np.array([last.end]), last.last()[:, None])
        moving = max(float(begins[0][0]), float(ends[0][0]))
        change = float(ends[0][0] + ends[1][0] - begins[0][0] - begins[1][0])
        scale = max(float(turned.max()), moving, 1e-300)
        unseen = _SEEN * sum(abs(float(part[0])) for part in (*begins, *ends))  # of the height of a load on its rope
        residual = max(abs(float(total.sum()) - change) - unseen, 0.0) / scale
        return Works(dict(zip(WORKS, total.tolist(), strict=True)), change, residual)

    def _extremes(self, name: str, signs: tuple[int, ...], since: float, until: float) -> list[Peak]:
        until = min(until, self.end)
        runs, size = [], 0.0
        for track in (self._coarse, self._fine):
            found, size = track.extremes(name, signs, since, min(until, track.steps[-1].end))
            runs.append([(track.polished(name, value, time, since, until), time) for value, time in found])
        return [Peak(one, time, abs(one - two) + _DUST * size) for (two, _), (one, time) in zip(*runs, strict=True)]


def _spread(steps: list[Step], places: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Times and states at places of what each step was used for, and how long that was."""
    begin, length, used = np.array([(step.start, step.length, step.used) for step in steps]).T
    spans = used * length
    times = begin[:, None] + spans[:, None] * places
    return times.ravel(), states_of(steps, used[:, None] * places), spans


def swing(case: Case, end: float, *, tolerance: float = TOLERANCE, most_steps: int = MOST_STEPS) -> Swing:
    """The motion from time 0 on.

    Args:
        case: what swings, and what moves its pivot.
        end: time to look until; a buffer that becomes solid ends it earlier [s].
        tolerance: largest tail of a step, of the angle in radians.
        most_steps: where a motion is given up.

    Returns:
        the motion.

    **Range** a taut rope without mass, a load as a point. A sudden change of the speed of rope or radius is an impulse
    that moves the load and an axis free to give way, but is no signal; where it would have to push, as when hoisting
    stops at once, a real rope goes slack: give such a length a ramp, and it is told.
    **Error** told with every number: the difference of two runs, of tolerances 300 apart.
    **Source** equations of motion (`equations`), Radau collocation.

    Raises:
        NumericsError: NUM102 for a rope that goes slack or a case that cannot be; NUM101 or NUM103 for a motion that no
            step resolves, or too many.
    """
    _refuse(case, end)
    runs = [
        March(case, end, kept, radau(order), most_steps).go()
        for kept, order in ((tolerance, _FINE), (tolerance * _COARSER, _COARSE))
    ]
    fine, coarse = runs
    return Swing(case, min(fine.steps[-1].end, end), fine.events, bool(fine.finished), len(fine.steps), fine, coarse)


def _refuse(case: Case, end: float) -> None:
    axis, load, gear = case.axis, case.load, case.axis.gear

    def refuse(when: bool, why: str) -> None:
        if when:
            raise NumericsError("NUM102", why)

    refuse(not (case.gravity > 0 and math.isfinite(case.gravity)), "a load does not swing without gravity")
    refuse(not (math.isfinite(end) and end > 0), "a motion ends at a time after 0")
    refuse(not load.mass > 0, "a load has a mass")
    refuse(load.length.jumps or not min(_values(load.length, end)) > 0, "a rope has a length, without jumps")
    refuse(not axis.inertia >= 0 or not gear.rotor >= 0, "an inertia is not below 0")
    refuse(not axis.inertia + gear.rotor > 0, "an axis has an inertia")
    refuse(not axis.friction >= 0, "friction is not below 0")
    refuse(not (0 < gear.forward <= 1 and 0 < gear.reverse <= 1), "a gear that locks itself does not swing")
    refuse(any(min(_values(one, end)) < 0 for one in (axis.brake, gear.brake)), "a brake holds nothing below 0")
    refuse(
        any(b.law not in (LINEAR, CONSTANT, ORIFICE) or b.side not in (1, -1) or not b.size > 0 for b in axis.buffers),
        "a buffer is linear, constant or an orifice, ahead or behind, and has a size",
    )
    refuse(isinstance(axis.drive, Straight), "a law belongs into a push")
    steep = max(abs(load.along), abs(load.across))
    plane = load.across == 0 == load.across_rate and isinstance(case.pivot, Rail)
    refuse(not plane and not steep < _STEEPEST, "angles at the start lie below a right one")
    refuse(isinstance(case.pivot, Jib) and case.pivot.radius.jumps, "a radius does not jump")
    if isinstance(axis.drive, Follow) and math.isinf(axis.drive.limit):
        first = float(axis.drive.speed.at(0.0))
        refuse(
            abs(first - axis.speed) > 1e-9 * max(abs(first), abs(axis.speed)),
            "an imposed speed starts at the axis's own",
        )
        refuse(axis.drive.speed.jumps, "an imposed speed does not jump")


def _values(pieces: Pieces, end: float) -> list[float]:
    starts = [start for start in pieces.starts if start < end]
    times = np.concatenate([np.linspace(a, b, 9) for a, b in zip(starts, [*starts[1:], end], strict=True)])
    return [float(x) for x in pieces.at(times[:-1])] + [float(pieces.within(pieces.piece(starts[-1]), end))]
