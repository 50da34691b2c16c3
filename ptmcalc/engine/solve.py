"""The value of one key at which a check just passes, by bracketing on the clearance of its verdict."""

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from ptmcalc.base.errors import UsageError
from ptmcalc.base.span import KeyPath, dotted
from ptmcalc.base.units import Quantity, display_unit, unit_of
from ptmcalc.contract.check import AnyCheck, Sense
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.report import AssumedReport
from ptmcalc.engine.judge import Ruling
from ptmcalc.engine.load import measure_at
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.run import settle
from ptmcalc.spec.fields import Measure
from ptmcalc.spec.machine import MachineSpec

_DECADES = 3
_STEPS_PER_DECADE = 4
_MOST_STEPS = 60
REPAIR_SECONDS = 6.0
"""Predicted work that looking for a repair may take; `solve`, which is asked for one, has no such limit."""

Clearance = Callable[[float], float]
"""How far the whole error bar lies on the sound side of the limit; the check passes from 0 up."""


@dataclass(frozen=True, slots=True)
class Solution:
    """A value of a key, SI, at which the check passes in every scene it applies to."""

    path: KeyPath
    value: float
    quantity: Quantity


@dataclass(frozen=True, slots=True)
class _Wanted:
    """How closely a value is looked for: digits, the bracket they need, and the finest setting a run may have (near
    the limit every refinement would run, which no digit of the value is worth)."""

    digits: int

    @property
    def width(self) -> float:
        return 3 * 10.0**-self.digits

    @property
    def finest(self) -> int:
        return max(self.digits - 3, 0)


def variants(spec: MachineSpec, assumed: Iterable[AssumedReport]) -> Iterator[tuple[AssumedReport, float, MachineSpec]]:
    """The machine with each assumed value at each end of its interval: (the value, that end, the machine)."""
    for value in assumed:
        for end in dict.fromkeys((value.interval.low, value.interval.high)):
            if end != value.value:
                yield value, end, spec.with_value(value.path, end)


def solve(
    kind: AnyKind,
    spec: MachineSpec,
    check: AnyCheck,
    path: KeyPath,
    scene_name: str = "",
    assumed: Iterable[AssumedReport] = (),
    *,
    digits: int = 4,
    seconds: float = math.inf,
) -> Solution | None:
    """The value nearest to the present one at which the check just passes, or None when there is none within 3 decades.

    Values at growing distances on both sides of the present one are tried, the first change between pass and fail is
    narrowed down, and the value is rounded to so many digits of its unit towards the passing side. It is a value at
    which the check was seen to pass, error bar included, with every assumed value at both ends of its interval. None
    too when the search is predicted to take more than `seconds`.

    Raises:
        UsageError: the key is not a number of this file.
    """
    present, measure = spec.value_at(path), measure_at(spec, path)
    if measure is None or not isinstance(present, int | float) or isinstance(present, bool) or present == 0:
        raise UsageError(
            f"`{dotted(path)}` is not a number that can be varied", "name a key with a value, as in the file"
        )
    wanted = _Wanted(digits)
    decisive = spec.model_copy(update={"accuracy": None})  # a verdict is wanted, not digits
    machines = [decisive, *(machine for value, _, machine in variants(decisive, assumed) if value.path != path)]
    purse = _Purse(seconds)
    clearances = [_clearance(kind, one, check, path, measure, scene_name, wanted.finest, purse) for one in machines]
    clearance: Clearance | None = clearances[0]
    try:
        for _ in clearances:
            if clearance is None:
                break
            bracket = _bracket(clearance, float(present))
            if bracket is None:
                return None
            good = _rounded(clearance, *_narrow(clearance, *bracket, wanted.width), measure.quantity, digits)
            clearance = next((other for other in clearances if other(good) < 0), None)
    except _SpentError:
        return None
    return Solution(path, good, measure.quantity) if clearance is None else None


class _SpentError(Exception):
    """A search has no seconds left."""


@dataclass
class _Purse:
    """Predicted seconds that a search may still spend."""

    left: float

    def pay(self, seconds: float) -> None:
        self.left -= seconds
        if self.left < 0:
            raise _SpentError


def _clearance(
    kind: AnyKind,
    spec: MachineSpec,
    check: AnyCheck,
    path: KeyPath,
    measure: Measure,
    scene_name: str,
    finest: int,
    purse: _Purse,
) -> Clearance:
    """The worst clearance of the check over its scenes as a function of the key; remembers what it has tried."""
    tried: dict[float, float] = {}
    scenes = [
        index
        for index, scene in enumerate(spec.all_scenes)
        if check.applies_to(scene) and scene_name in ("", scene.label)
    ]

    def clearance(value: float) -> float:
        if value not in tried:
            tried[value] = -math.inf
            if not measure.broken_by(value):
                changed = spec.with_value(path, value)
                tried[value] = min(
                    (_of_scene(kind, changed, check, index, finest, purse) for index in scenes), default=-math.inf
                )
        return tried[value]

    return clearance


def _of_scene(kind: AnyKind, spec: MachineSpec, check: AnyCheck, index: int, finest: int, purse: _Purse) -> float:
    scene = plan_scene(kind, spec, spec.all_scenes[index])
    settled = settle(kind, spec, scene, only=check, until=lambda rung: rung.level <= finest)
    purse.pay(sum(max(run.rung.seconds, run.result.spent) for run in settled.runs))
    return min((_of_ruling(ruling) for ruling in settled.rulings), default=-math.inf)


def _of_ruling(ruling: Ruling) -> float:
    if ruling.value is None or ruling.limit is None:
        return -math.inf
    if ruling.check.sense is Sense.AT_LEAST:
        clearance = ruling.value.low - ruling.limit.high
    else:
        clearance = ruling.limit.low - ruling.value.high
    return -math.inf if math.isnan(clearance) else clearance


def _bracket(clearance: Clearance, present: float) -> tuple[float, float] | None:
    """(a value that fails, one that passes), neighbours in a search outwards on both sides in equal ratios."""
    passes = clearance(present) >= 0
    reached = [present, present]
    for step in range(1, _DECADES * _STEPS_PER_DECADE + 1):
        for side, sign in ((0, 1), (1, -1)):
            candidate = present * 10 ** (sign * step / _STEPS_PER_DECADE)
            if (clearance(candidate) >= 0) is not passes:
                return (candidate, reached[side]) if passes else (reached[side], candidate)
            reached[side] = candidate
    return None


def _narrow(clearance: Clearance, bad: float, good: float, relative: float) -> tuple[float, float]:
    """A narrow bracket round the change from fail to pass: secant steps kept away from its ends,
    halved where the clearance is not finite."""
    weight = 1.0
    for _ in range(_MOST_STEPS):
        width = good - bad
        if abs(width) <= relative * abs(good):
            break
        below, above = clearance(bad) * weight, clearance(good)
        share = 0.5
        if math.isfinite(below) and math.isfinite(above):
            share = min(max(below / (below - above), 0.02), 0.98)
        middle = bad + share * width
        if clearance(middle) >= 0:
            good, weight = middle, weight / 2  # the failing end stays: give it less weight (Illinois)
        else:
            bad, weight = middle, 1.0
    return bad, good


def _rounded(clearance: Clearance, bad: float, good: float, quantity: Quantity, digits: int) -> float:
    """The passing value with few digits, in the unit it is shown in, if that still passes."""
    factor = unit_of(display_unit(good, quantity))[0]
    shown = good / factor
    places = digits - 1 - math.floor(math.log10(abs(shown)))
    towards = math.ceil if good >= bad else math.floor
    for extra in range(3):
        scale = 10.0 ** (places + extra)
        candidate = towards(shown * scale) / scale * factor
        if clearance(candidate) >= 0:
            return candidate
    return good
