"""The value of one key at which a check just passes, by bracketing on the clearance of its verdict."""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, partial
from itertools import islice

from ptmcalc.base.errors import UsageError
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.progress import step
from ptmcalc.base.span import KeyPath, dotted
from ptmcalc.base.units import RATIO, Quantity, display_unit, show, unit_of
from ptmcalc.contract.check import AnyCheck, Sense
from ptmcalc.contract.report import AssumedReport
from ptmcalc.engine.judge import Ruling
from ptmcalc.engine.load import Loaded, changed, measure_at
from ptmcalc.engine.plan import RungKey, plan_scene
from ptmcalc.engine.run import settle
from ptmcalc.spec.machine import MachineSpec

_DECADES = (0.01, 0.03, 0.1, *(0.25 * step for step in range(1, 13)))
"""How far from the present value others are tried, in decades on either side."""
FARTHEST = 1e3
"""Largest ratio of a solution to the present value, or of the present value to it [1]. An engineering choice: a larger
value finds solutions that no machine has; a smaller one reports that there is none."""
_MOST_STEPS = 60
"""Steps that narrow a bracket; a numerical choice. Halving alone reduces it by 2^60, beyond the resolution of the
floating point. Fewer steps may end with a wider bracket; more take longer where a clearance is not smooth."""
_CLOSE_ENOUGH = 5e-3
"""Relative width of a bracket [1] that is an answer where the budget is used up. A numerical choice: a larger value
gives rough answers; a smaller one reports more searches as unfinished."""
FINEST = 1
"""Maximum level of a run while a value is searched. A numerical choice: near the limit every level would run. A larger
value takes longer; 0 finds rough values."""
_STEP = 0.01
"""Relative step of the search for the last value that passes at all levels [1]. A numerical choice: a smaller value
finds that value more closely and takes longer."""
REPAIR_SECONDS = 10.0
"""Predicted seconds of the search for a repair, and as many of its refinement; `solve` has no such limit. A numerical
choice: a larger value finds more repairs and takes longer."""

Clearance = Callable[[float], float]
"""How far the whole error bar lies on the sound side of the limit, and of the margin that is wanted beside it; the
check passes from 0 up."""
Spare = Callable[[Estimate], float]
"""The margin wanted beside a limit."""
Bracket = tuple[float, float]
"""A value that fails and one that passes, neighbours among those tried."""


@dataclass(frozen=True, slots=True)
class Solution:
    """A value of a key, SI, at which the check passes in every scene it applies to.

    `other` is the value at the far edge of the band, where that is what the check forbids.
    """

    path: KeyPath
    value: float
    quantity: Quantity
    other: float | None = None


def variants(spec: MachineSpec, assumed: Iterable[AssumedReport]) -> Iterator[tuple[AssumedReport, float, MachineSpec]]:
    """The machine with each assumed value at each end of its interval: (the value, that end, the machine)."""
    for value in assumed:
        for end in dict.fromkeys((value.interval.low, value.interval.high)):
            if end != value.value:
                yield value, end, spec.with_value(value.path, end)


def solve(
    loaded: Loaded,
    check: AnyCheck,
    path: KeyPath,
    scenes: str | tuple[str, ...] = (),
    *,
    digits: int = 4,
    purse: "SearchPurse | None" = None,
    spare: Spare = lambda limit: 0.0,
) -> Solution | None:
    """The value nearest to the present one at which the check just passes in some scenes, all by default, or None when
    there is none within 3 decades.

    Values at growing distances on both sides of the present one are tried, the first change between pass and fail is
    narrowed down, and the value is rounded to so many digits of its unit (a count to a whole number) towards the
    passing side. It is a value at which the check was seen to pass by `spare`, error bar included, with every assumed
    value at both ends of its interval, and which the file may have. Near the limit every refinement would run, which
    no digit of the value is worth; but 1 % the wrong way all of them may, and what passes there too is no answer yet.
    None too when the search is predicted to take more than the `purse` has.

    Raises:
        UsageError: the key is not a number of this file.
    """
    spec = loaded.spec
    assert spec is not None, "only a machine can be solved for"
    grid = grid_of(spec, path, digits)
    if grid is None:
        raise UsageError(
            f"`{dotted(path)}` is not a number that can be varied", "name a key with a value, as in the file"
        )
    names = (scenes,) if isinstance(scenes, str) and scenes else tuple(scenes)
    search = _Search(loaded, check, path, names, spare, purse or SearchPurse(math.inf))
    try:
        edges = _edges(search, float(spec.value_at(path)), grid)
    except SpentError:
        return None
    return Solution(path, edges[0], grid.quantity, *edges[1:]) if edges else None


def boundary(
    loaded: Loaded,
    check: AnyCheck,
    path: KeyPath,
    along: KeyPath,
    values: Sequence[float],
    scene_name: str = "",
    spare: Spare = lambda limit: 0.0,
) -> Iterator[tuple[float, Solution | None]]:
    """The solution for `path` at each value (SI) of a second key: the curve on which the check just passes.

    Raises:
        UsageError: a key is not a number of this file.
    """
    for value in values:
        other = changed(loaded, along, value)
        yield value, solve(other, check, path, scene_name, spare=spare) if other.spec is not None else None


class SpentError(Exception):
    """A search has no seconds left."""


@dataclass
class SearchPurse:
    """Predicted seconds that a search may spend, and those that it has."""

    most: float
    spent: float = 0.0

    def pay(self, seconds: float) -> None:
        """Take what a run cost.

        Raises:
            SpentError: there is no more.
        """
        self.spent += seconds
        if self.spent > self.most:
            raise SpentError


@dataclass(frozen=True, slots=True)
class Grid:
    """How closely a value is looked for: digits of its unit, or whole numbers."""

    quantity: Quantity
    digits: int
    counts: bool

    def close(self, bad: float, good: float) -> bool:
        """Whether a bracket needs no narrowing: neighbours in the last digit, or as close."""
        near = 0.0 if self.counts else 3 * 10.0**-self.digits * abs(good)
        return abs(good - bad) <= max(1.001 * self._step(good), near)

    def on(self, value: float) -> float:
        """The nearest value that can be tried: one of few digits, so that the last one tried is the answer."""
        return float(round(value)) if self.counts else self._cut(value, round)

    def between(self, bad: float, good: float, share: float) -> float:
        """A value inside a bracket, so far from its bad end."""
        wanted = bad + share * (good - bad)
        middle = self.on(wanted)
        if middle in (bad, good):
            step = math.copysign(self._step(good), good - bad)
            middle = self.on(good - step if middle == good else bad + step)
        return middle if min(bad, good) < middle < max(bad, good) else wanted

    def stride(self, value: float, share: float) -> float:
        """So large a share of a value, or a whole number."""
        size = share * abs(value)
        return max(math.floor(size), 1) if self.counts else size

    def _step(self, value: float) -> float:
        """One in the last digit."""
        factor, places = self._places(value)
        return 1.0 if self.counts else factor * 10.0**-places

    def rounded(self, clearance: Clearance, bad: float, good: float) -> float:
        """The passing value with few digits, in the unit it is shown in, if that still passes."""
        if self.counts:
            return good
        towards = math.ceil if good >= bad else math.floor
        for extra in range(3):
            candidate = self._cut(good, towards, extra)
            if clearance(candidate) >= 0:
                return candidate
        return good

    def _cut(self, value: float, whole: Callable[[float], int], extra: int = 0) -> float:
        """A value with few digits in the unit it is shown in; one that has no more is left as it is."""
        factor, places = self._places(value)
        shown = value / factor * 10.0 ** (places + extra)
        if math.isclose(shown, round(shown), rel_tol=1e-12):
            return value
        return whole(shown) / 10.0 ** (places + extra) * factor

    def _places(self, value: float) -> tuple[float, int]:
        """The unit a value is shown in, and behind how many decimals its last digit stands there."""
        factor = unit_of(display_unit(value, self.quantity))[0]
        return factor, self.digits - 1 - math.floor(math.log10(abs(value / factor)))


def grid_of(spec: MachineSpec, path: KeyPath, digits: int) -> Grid | None:
    """How the number at a key is varied; None where there is no number, or one without a size, as 0."""
    present = spec.value_at(path)
    measure = measure_at(spec, path)
    counts = measure is None and isinstance(present, int) and not isinstance(present, bool) and present > 0
    known = measure is not None and isinstance(present, int | float) and present != 0
    return Grid(measure.quantity if measure else RATIO, digits, counts) if counts or known else None


@dataclass(frozen=True, slots=True)
class _Search:
    """The clearances of a check as functions of a key: of the machine, and with each assumed value at each end."""

    loaded: Loaded
    check: AnyCheck
    path: KeyPath
    scenes: tuple[str, ...]
    """those asked about; all where there is none"""
    spare: Spare
    purse: SearchPurse
    later: dict[str, set[RungKey]] = field(default_factory=dict)
    """by scene, runs that did not decide at a value tried before: they come last at the next one"""

    def clearances(self, finest: float) -> list[Clearance]:
        """Of runs with so many refinements at most: of the machine as it is first."""
        spec = self.loaded.spec
        assert spec is not None
        ends = [
            (one.path, end)
            for one, end, _ in variants(spec, self.loaded.assumed)
            if one.path != self.path and one.read_by(self.check)
        ]
        return [cache(partial(self._at, end=end, finest=finest)) for end in (None, *ends)]

    def _at(self, value: float, end: tuple[KeyPath, float] | None, finest: float) -> float:
        """The worst over the scenes of the check; a scene that does not ask for it, as one without a load, is not in
        the way, but one at least has to."""
        before = self.loaded.spec
        measure = measure_at(before, self.path) if before is not None else None
        if measure is not None and measure.broken_by(value):
            return -math.inf
        step(f"{dotted(self.path)} = {show(value, measure.quantity if measure else RATIO)}, {self.check.code}")
        spec = changed(self.loaded, self.path, value if measure else int(value)).spec
        if spec is None:
            return -math.inf
        if self.path != ("accuracy",):
            spec = spec.model_copy(update={"accuracy": None})  # a verdict is wanted, not digits
        if end is not None:
            spec = spec.with_value(*end)
        wanted = [
            index
            for index, scene in enumerate(spec.all_scenes)
            if self.check.applies_to(scene) and (not self.scenes or scene.label in self.scenes)
        ]
        return min((one for index in wanted for one in self._of_scene(spec, index, finest)), default=-math.inf)

    def _of_scene(self, spec: MachineSpec, index: int, finest: float) -> list[float]:
        kind = self.loaded.kind
        assert kind is not None
        scene = plan_scene(kind, spec, spec.all_scenes[index])
        later = self.later.setdefault(scene.scene.label, set())
        settled = settle(kind, spec, scene, only=self.check, until=lambda rung: rung.level <= finest, later=later)
        later.update(settled.superseded)
        self.purse.pay(settled.spent)
        return [self._of_ruling(ruling) for ruling in settled.rulings]

    def _of_ruling(self, ruling: Ruling) -> float:
        if ruling.found or ruling.value is None or ruling.limit is None:
            return -math.inf
        if ruling.check.sense is Sense.AT_LEAST:
            clearance = ruling.value.low - ruling.limit.high
        else:
            clearance = ruling.limit.low - ruling.value.high
        return -math.inf if math.isnan(clearance) else clearance - self.spare(ruling.limit)


def _edges(search: _Search, present: float, grid: Grid) -> list[float]:
    """Where the check just passes, whatever is assumed: next to the present value, and where the check forbids a band
    on the other side too."""
    clearances = search.clearances(FINEST)
    found: list[float] = []
    for place in range(2 if search.check.forbids_band else 1):
        bracket = _passing(clearances, present, grid, place)
        if bracket is None:
            return found
        bad, good = bracket
        farthest = present * (FARTHEST if abs(bad) > abs(good) else 1 / FARTHEST)
        edge = _weakest(search, good, farthest, grid)
        if edge is None:
            return found
        found.append(edge)
    return found


def _passing(clearances: Sequence[Clearance], present: float, grid: Grid, place: int) -> Bracket | None:
    """The value next to the present one from which all clearances pass, behind one that fails: by the first of them,
    then by one that fails there. The second such value, on the other side, at `place` 1. None where there is none."""
    clearance = clearances[0]
    for _ in clearances:
        bracket = next(islice(_brackets(clearance, present, grid), place, None), None)
        if bracket is None:
            return None
        bad, good = _narrow(clearance, *bracket, grid)
        good = grid.rounded(clearance, bad, good)
        failing = next((other for other in clearances if other(good) < 0), None)
        if failing is None:
            return bad, good
        clearance = failing
    return None


def _weakest(search: _Search, good: float, farthest: float, grid: Grid) -> float | None:
    """The last value that passes, to 1 % or a whole number, by all refinements there are: where a key matters little,
    or a bar is wide, they move the edge by more than that. It may take as many seconds again as the search.
    None where they pass as far as values are looked at.

    Raises:
        SpentError: it has found the edge to move, and has no seconds to find where to.
    """
    finish = replace(search, purse=SearchPurse(search.purse.most))
    clearances = finish.clearances(math.inf)

    def passes(value: float) -> bool:
        return all(clearance(value) >= 0 for clearance in clearances)

    def narrowed(good: float, bad: float) -> float:
        while abs(bad - good) > grid.stride(good, _STEP):
            middle = grid.on((good + bad) / 2)
            good, bad = (middle, bad) if passes(middle) else (good, middle)
        return good

    share = 0.95 * _STEP  # so that halves of what is passed over are narrow enough
    step = math.copysign(1.0, farthest - good)
    try:
        while good != farthest:
            further = grid.on(good + step * grid.stride(good, share))
            if (further - farthest) * step > 0:
                further = farthest
            if not passes(further):
                return narrowed(good, further)
            good, share = further, 2 * share
        return None
    finally:
        search.purse.spent += finish.purse.spent


def _brackets(clearance: Clearance, present: float, grid: Grid) -> Iterator[Bracket]:
    """Changes between fail and pass, one on each side of the present value, as they are met in steps outwards."""
    passes = clearance(present) >= 0
    reached = {1: present, -1: present}
    for decades in _DECADES:
        for side in tuple(reached):
            candidate = grid.on(present * 10 ** (side * decades))
            if (clearance(candidate) >= 0) is not passes:
                yield (candidate, reached[side]) if passes else (reached[side], candidate)
                del reached[side]
            else:
                reached[side] = candidate


def _narrow(clearance: Clearance, bad: float, good: float, grid: Grid) -> Bracket:
    """A narrow bracket round the change from fail to pass: secant steps kept away from its ends,
    halved where the clearance is not finite, or 0 as that of a count at its limit."""
    weight = 1.0
    for _ in range(_MOST_STEPS):
        if grid.close(bad, good):
            break
        below, above = clearance(bad) * weight, clearance(good)
        share = 0.5
        if math.isfinite(below) and math.isfinite(above) and above > 0:
            share = min(max(below / (below - above), 0.02), 0.98)
        middle = grid.between(bad, good, share)
        try:
            passes = clearance(middle) >= 0
        except SpentError:
            if abs(good - bad) <= _CLOSE_ENOUGH * abs(good):
                break
            raise
        if passes:
            good, weight = middle, weight / 2  # the failing end stays: give it less weight (Illinois)
        else:
            bad, weight = middle, 1.0
    return bad, good
