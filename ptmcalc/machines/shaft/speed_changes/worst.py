"""The angle of the cycle at which a run-out begins worst, and the brake that would do.

Runs from some angles tell by what factor the closed form with the kinetic energy of the angle is off. Between them that
factor is interpolated, so that every corner of the energy over the angle is seen without a run of its own. Its bend
between the runs tells what the interpolation may hide; where that could be worse than the worst run, more runs follow.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.estimate import Estimate
from ptmcalc.machines.shaft.speed_changes import run_out_bounds
from ptmcalc.machines.shaft.speed_changes.cases import Departure
from ptmcalc.machines.shaft.speed_changes.motion import ORDERS, Run, run_out
from ptmcalc.numerics.distinct import distinct

FloatArray = NDArray[np.float64]

TIME, ANGLE = 0, 1
"""What is worst: the time of the run-out, or the angle turned; the index in what `Stop.ended` gives."""

_STARTS, _ANGLES = 9, 144
"""First run-outs of a cycle, and angles at which their values are interpolated [1]. A numerical choice: `_told` adds
runs where the interpolation may hide a worse one. Fewer widen the error bar; more cost time in proportion."""
_QUICK = (7, 1e-5)
"""Nodes [1] and tolerance [1] of the run-outs that are interpolated. A numerical choice: 1e-5 is below `_ENOUGH`, the
share not resolved. A smaller tolerance costs time; a larger one makes the search follow errors of the runs."""
_MARGIN = 2.0
"""Factor [1] on the estimated interpolation error and on the difference of two runs. A numerical choice: a larger value
widens the error bar and adds runs. Below 1 the bar may exclude the coarser run."""
_MORE, _ENOUGH = 24, 3e-5
"""Runs that may be added to the first ones, and the share of the worst value that need not be told."""
_FLOOR = 1e-10
"""Relative rounding of a run [1], added to every error bar, as `FLOOR` of the results. A numerical choice: it is above
the tolerance of the fine run, 1e-11. A larger value widens every bar."""
_NAMES = ("time", "angle")
_MOST_ROUNDS, _MOST_SECANTS, _MOST_BISECTIONS = 4, 12, 60
"""Changes of the worst angle, secant steps and bisections of a brake torque [1]. A numerical choice: smaller values
widen the error bar or report that no brake suffices. Larger ones cost time."""
_LARGEST = 1e15
"""Brake torque [N*m] above which no brake suffices. An engineering choice, equal to the largest number of a design
file. A smaller value reports an infinite torque for large machines; a larger one only costs time."""
_LEAST = 1e-9
"""Smallest brake torque of the bisection [N*m]; also the relative gain [1] from which another angle is worse. A
numerical choice: both are above rounding. A larger value misses weak brakes and slightly worse angles."""
_SPARE = 1e-3
"""Reserve [1] of a limit from which a quick run proves that a torque is sufficient. A numerical choice: it is above the
error of a quick run. A larger value computes the torque of the second limit more often."""


def measured(run: Run, which: int) -> float:
    """The time of a run [s] or the angle it turned [rad]."""
    return (run.time, run.angle)[which]


@dataclass(frozen=True)
class Worst:
    """The run-out that is worst in some respect: with its value and bar, and the angle it begins at."""

    value: Estimate
    angle: float
    run: Run


class Search:
    """Run-outs of one machine from all angles of its cycle. `work` counts what they evaluated."""

    def __init__(self, start: Departure) -> None:
        self.start, self.work = start, 0
        self._closed: dict[float | None, FloatArray] = {}
        period = start.machine.period
        angles = np.linspace(0.0, period, _ANGLES, endpoint=False)
        breaks = [angle for angle in (*start.cycle.machine.breaks, *start.machine.breaks) if angle < period]
        top = start.largest_energy()[1] % period
        self.angles = distinct(np.concatenate([angles, breaks, [top]]))
        self.energies = start.energies(self.angles)
        self.picked = distinct(np.append(np.linspace(0.0, period, _STARTS, endpoint=False), top))
        self._runs = [self.run(float(angle), _QUICK) for angle in self.picked]

    def run(self, angle: float, setting: tuple[int, float], brake: float | None = None) -> Run:
        """The run-out from an angle, with the brake of the file or of another torque."""
        machine = self.start.machine if brake is None else self.start.machine.with_brake_torque(brake)
        made = run_out(machine, angle, self.start.cycle.speed_at(angle), setting)
        self.work += made.work
        return made

    @property
    def runs(self) -> tuple[Run, ...]:
        """The run-outs made so far."""
        return tuple(self._runs)

    def closed(self, which: int, brake: float | None = None) -> FloatArray:
        """The closed form from all angles; the energy itself where it has no end."""
        if brake not in self._closed:
            machine = self.start.machine
            stops = (run_out_bounds.Stop(machine, e, machine.brake is not None) for e in self.energies.tolist())
            self._closed[brake] = np.array([stop.ended(0, changing=False, brake=brake) for stop in stops]).T
        found = self._closed[brake][which]
        return np.asarray(found if np.all(np.isfinite(found)) and np.all(found > 0) else self.energies)

    def factor(self, which: int) -> tuple[FloatArray, FloatArray]:
        """By what the closed form is to be multiplied, at all angles, and what a straight line between two runs may
        miss of that: an eighth of the square of their distance times the second derivative, by the larger of the two
        divided differences around, taken twice."""
        period = self.start.machine.period
        values = np.array([measured(run, which) for run in self._runs])
        known = values / np.interp(self.picked, self.angles, self.closed(which), period=period)
        apart = np.diff(np.append(self.picked, self.picked[0] + period))
        slopes = np.diff(np.append(known, known[0])) / apart
        bends = 2 * np.abs(slopes - np.roll(slopes, 1)) / (apart + np.roll(apart, 1))
        missed = _MARGIN * apart**2 / 8 * np.maximum(bends, np.roll(bends, -1))
        between = (np.searchsorted(self.picked, self.angles, "right") - 1) % len(self.picked)
        return np.asarray(np.interp(self.angles, self.picked, known, period=period)), missed[between]

    def _told(self, which: int) -> FloatArray:
        """Values that no angle exceeds, after runs from all angles that could be worse than the worst one so far."""
        for _ in range(_MORE):
            factor, missed = self.factor(which)
            most = self.closed(which) * (factor + missed)
            top = int(np.argmax(most))
            values = [measured(run, which) for run in self._runs]
            if not most[top] > max(values) * (1 + _ENOUGH) or not all(map(math.isfinite, values)):
                break
            self._add(float(self.angles[top]))
        factor, missed = self.factor(which)
        return np.asarray(self.closed(which) * (factor + missed))

    def _add(self, angle: float) -> None:
        """A run from between two others: from the angle, or from the middle where it is next to one of them."""
        period = self.start.machine.period
        at = int(np.searchsorted(self.picked, angle, "right"))
        low = float(self.picked[at - 1])
        high = float(self.picked[at]) if at < len(self.picked) else float(self.picked[0]) + period
        if min(angle - low, high - angle) < (high - low) / 4:
            angle = (low + high) / 2 % period
        at = int(np.searchsorted(self.picked, angle))
        self.picked = np.insert(self.picked, at, angle)
        self._runs.insert(at, self.run(angle, _QUICK))

    def worst(self, which: int) -> Worst:
        """The largest value over all angles."""
        values = np.array([measured(run, which) for run in self._runs])
        if not np.all(np.isfinite(values)):
            top = int(np.argmax(values))
            return Worst(Estimate.exact(math.inf), float(self.picked[top]), self._runs[top])
        most = self._told(which)
        predicted = self.closed(which) * self.factor(which)[0]
        found = self._exact(float(self.angles[int(np.argmax(predicted))]), which)
        values = np.array([measured(run, which) for run in self._runs])
        top = int(np.argmax(values))
        if values[top] > found.value.high:
            found = self._exact(float(self.picked[top]), which)
        value, at = found.value, int(np.argmin(np.abs(self.angles - found.angle)))
        missed = abs(value.value - float(predicted[at])) + _hidden(predicted)
        unseen = max(float(most.max()) + missed - value.value, 0.0)
        bar = Estimate(value.value, value.low, value.high + unseen, value.numerical + unseen)
        return Worst(bar, found.angle, found.run)

    def _exact(self, angle: float, which: int) -> Worst:
        fine, rough = (self.run(angle, setting) for setting in ORDERS)
        value = measured(fine, which)
        numerical = _MARGIN * abs(value - measured(rough, which)) + _FLOOR * value
        return Worst(Estimate.within(value, numerical), angle, fine)


def _hidden(predicted: FloatArray) -> float:
    """What the top of a hill between two angles may stand out by: an eighth of the bend of its smooth side."""
    if not np.all(np.isfinite(predicted)):
        return math.inf
    around = np.concatenate([predicted[-2:], predicted, predicted[:2]])
    bend = np.abs(np.diff(around, 2))
    top = int(np.argmax(predicted)) + 1  # of the bends, the one at the top
    return float(min(bend[top - 1], bend[top + 1])) / 8


def torque_needed(
    start: Departure, wanted: Mapping[str, float], angle: float | None, search: Search | None
) -> tuple[Estimate, int]:
    """Brake torque with which the run-out from an angle, or from the worst one, keeps the wanted time and angle."""
    roots = {which: _Root(start, which, wanted[name]) for which, name in enumerate(_NAMES) if name in wanted}
    at = angle if angle is not None or search is None else search.worst(TIME).angle
    order = sorted(roots, key=lambda which: roots[which].guess(at or 0.0), reverse=True)
    found, used = _for_limit(roots[order[0]], angle, search)
    for which in order[1:]:  # the other limit asks for less, as a rule
        if found.value == 0 or (math.isfinite(found.value) and not roots[which].kept(at or 0.0, found.value)):
            other, more = _for_limit(roots[which], angle, search)
            used += more
            found = max(found, other, key=lambda one: one.value)
    return found, used


def _for_limit(root: "_Root", angle: float | None, search: Search | None) -> tuple[Estimate, int]:
    """The torque for one limit, from an angle or from the one that is worst with that torque."""
    if angle is not None or search is None:
        return root.at(angle if angle is not None else 0.0), root.work
    which, limit = root.which, root.limit
    at = search.worst(which).angle
    factor, missed = search.factor(which)
    found = Estimate.exact(math.inf)
    for _ in range(_MOST_ROUNDS):
        found = root.at(at)
        if not math.isfinite(found.value) or found.value == 0:
            return found, root.work
        predicted = search.closed(which, found.value) * factor
        here = int(np.argmin(np.abs(search.angles - at)))
        top = int(np.argmax(predicted))
        if predicted[top] <= predicted[here] * (1 + _LEAST):
            break
        at = float(search.angles[top])
    most = float((search.closed(which, found.value) * (factor + missed)).max())
    unseen = max(most + _hidden(predicted) + abs(limit - float(predicted[here])) - limit, 0.0)
    extra = unseen / root.fall if root.fall > 0 else 0.0
    return Estimate(found.value, found.low, found.high + extra, found.numerical + extra), root.work


class _Root:
    """The brake torque at which a run-out comes to a limit. `fall` is that of the value with the torque at the root."""

    def __init__(self, start: Departure, which: int, limit: float) -> None:
        self.start, self.which, self.limit = start, which, limit
        self.work, self.fall = 0, 0.0

    def _measured(self, angle: float, torque: float, setting: tuple[int, float]) -> float:
        """Time or angle of the run-out with a torque."""
        machine = self.start.machine.with_brake_torque(torque)
        run = run_out(machine, angle, self.start.cycle.speed_at(angle), setting)
        self.work += run.work
        return measured(run, self.which)

    def _excess(self, angle: float, torque: float, setting: tuple[int, float]) -> float:
        """The limit over the value less 1: nearly a straight line over the torque."""
        value = self._measured(angle, torque, setting)
        return self.limit / value - 1 if math.isfinite(value) and value > 0 else -1.0

    def guess(self, angle: float) -> float:
        """The torque by the closed form, corrected by what a quick run with the brake of the file tells."""
        energy = float(self.start.energies(np.array([angle]))[0])
        stop = run_out_bounds.Stop(self.start.machine, energy, True)
        present = self.start.machine.brake_most
        closed = stop.ended(0, changing=False)[self.which]
        factor = self._measured(angle, present, _QUICK) / closed if present > 0 and closed > 0 else 1.0
        usable = math.isfinite(closed) and 0 < factor < math.inf
        wanted = {_NAMES[self.which]: self.limit / (factor if usable else 1.0)}
        return run_out_bounds.torque_needed(stop, wanted, 0, changing=False)

    def kept(self, angle: float, torque: float) -> bool:
        """Whether a torque keeps the limit with something to spare."""
        return self._excess(angle, torque, _QUICK) > _SPARE

    def at(self, angle: float) -> Estimate:
        """The torque for the run-out from an angle; infinite where no brake does, 0 where none is needed."""
        guess = self.guess(angle)
        if guess == 0 and self._ends_without() and self._excess(angle, 0.0, _QUICK) >= 0:
            return Estimate.exact(0.0)
        found = self._by_secants(angle, guess) if 0 < guess < math.inf else None
        if found is None:
            near = self._bracketed(angle)
            found = self._by_secants(angle, near) if near is not None else None
        return found if found is not None else Estimate.exact(math.inf)

    def _ends_without(self) -> bool:
        return self.start.machine.survey.static_low > 0

    def _by_secants(self, angle: float, guess: float) -> Estimate | None:
        """From a torque near the one looked for; None where the steps lead nowhere."""
        fine = ORDERS[0]
        before, torque = guess, guess * (1 + 1e-4)
        at_before, at = (self._excess(angle, one, fine) for one in (before, torque))
        for _ in range(_MOST_SECANTS):
            if not (at != at_before and (at - at_before) / (torque - before) > 0):
                return None
            slope = (at - at_before) / (torque - before)
            if abs(at) <= 1e-11:
                break
            following = torque - at / slope
            if not 0.2 * torque < following < 5 * torque:
                return None
            if abs(following - torque) <= 1e-12 * torque:
                break
            before, at_before, torque = torque, at, following
            at = self._excess(angle, torque, fine)
        else:
            return None
        self.fall = self.limit * slope
        off = abs(at) + abs(at - self._excess(angle, torque, ORDERS[1]))
        return Estimate.within(torque, _MARGIN * off / slope + _FLOOR * torque)

    def _bracketed(self, angle: float) -> float | None:
        """A torque near the one looked for, by bisection; None where even the strongest brake does not do."""
        low, high = 0.0, max(self.start.machine.brake_most, _LEAST)
        while self._excess(angle, high, _QUICK) < 0:
            low, high = high, 16 * high
            if high > _LARGEST:
                return None
        for _ in range(_MOST_BISECTIONS):
            middle = (low + high) / 2 if low > 0 else high / 16
            if high - low <= 1e-3 * high or middle < _LEAST:
                break
            low, high = (low, middle) if self._excess(angle, middle, _QUICK) >= 0 else (middle, high)
        return high
