"""What accuracy costs on this machine: every setting measured, and held against a setting of another method."""

import gc
import math
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.memory import forget
from ptmcalc.base.units import SHARE, TIME, show
from ptmcalc.contract.cost import Choice, CostReport, Held, LoadCost, Outcome, Role, Setting
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.result import Result, family
from ptmcalc.contract.solver import AnySolver, Fidelity
from ptmcalc.engine.judge import Ruling, judge
from ptmcalc.engine.plan import Plan, Rung, ScenePlan, plan
from ptmcalc.engine.widen import widen
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.spec.scene import Scene

ACCURACIES = (0.05, 0.01, 0.001)
"""Relative accuracies for which `ptmcalc cost` names the fastest setting by default [1]. An engineering choice: rough,
usual and fine design. Others are requested on the command line; no load depends on them."""
MARGINS = "margins"
WORK_BUDGET = 10.0
"""Predicted seconds of one run of every setting of a file; settings of higher cost are named, not run. A numerical
choice: a larger value measures more settings and takes longer."""
_REFERENCE_SHARE = 0.25
"""Share of that budget for the reference methods of a scene [1]. A numerical choice: a larger value allows finer
references and leaves less for the settings."""
MOST_RUNS = 5
"""Repetitions of a fast run whose shortest time is reported. A numerical choice: more reduce the scatter of the time
and take longer."""
_ENOUGH, _LONG = 0.2, 0.5
"""Repetition of a run [s]; numerical choices. `_ENOUGH`: total time after which it is not repeated again. `_LONG`: time
of a run that is made once. Larger values reduce the scatter of the time and take longer."""
_SMALL = 1e-3
"""Minimum reference of a relative error, relative to the largest load of its quantity [1]. A numerical choice: a load
near 0 would have an infinite relative error. A larger value hides errors of small loads."""
_ROUNDING = 1e-9
"""Rounding relative to the value [1] within which an interval contains its reference, above the resolution 2e-16 of the
floating point. A smaller value reports rounding as a violated bound; a larger one hides small violations."""
_UNTRUSTED = ("NUM101", "NUM102")

Loads = Mapping[str, Estimate]
Clock = Callable[[], float]


@dataclass(frozen=True, slots=True)
class _Watch:
    """What time is taken with, and how often a setting is run at most."""

    clock: Clock
    most_runs: int


@dataclass(frozen=True, slots=True)
class _Measured:
    """A setting that was tried, with its loads."""

    setting: Setting
    rung: Rung
    loads: Loads

    @property
    def decides(self) -> bool:
        """Whether the check could rest on it."""
        return self.setting.role is Role.LADDER and self.setting.outcome is Outcome.MEASURED


def cost(
    path: str,
    kind: AnyKind,
    spec: MachineSpec,
    scenes: Sequence[Scene] | None = None,
    *,
    budget: float = WORK_BUDGET,
    accuracies: Sequence[float] = ACCURACIES,
    most_runs: int = MOST_RUNS,
    clock: Clock = time.perf_counter,
) -> CostReport:
    """Measure every setting of every scene, and compare it with the best one of another method.

    The true error of a load is its distance from the value of the setting of another method that has the smallest bar,
    effects that a run left out included, for the reference is taken with its own whole bar. A method is never held
    against itself: of a load that only one method knows no error is told.
    """
    begun, watch = clock(), _Watch(clock, most_runs)
    made = plan(kind, spec, scenes)
    asked = sorted({*accuracies, *([spec.accuracy] if spec.accuracy else [])}, reverse=True)
    chosen = _affordable(made, budget)
    settings: list[Setting] = []
    choices: list[Choice] = []
    margins: list[tuple[str, float]] = []
    for scene in made.scenes:
        tried = [_measured(spec, scene, one, chosen, watch) for one in _candidates(kind, spec, scene, budget)]
        of_scene = _compared(kind, spec, scene, tried)
        settings += _fronts([one.setting for one in of_scene])
        choices += _choices(kind, spec, scene, of_scene, asked)
        margins += _margins(kind, spec, scene, of_scene)
    closest = min(margins, key=lambda one: abs(one[1]), default=None)
    return CostReport(path, kind.label, tuple(settings), tuple(choices), closest, clock() - begun)


# -- which settings --------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Candidate:
    """A setting before it is run."""

    rung: Rung
    role: Role
    variant: str = ""
    reason: str = ""
    """why it is not run"""


def _candidates(kind: AnyKind, spec: MachineSpec, scene: ScenePlan, budget: float) -> Iterator[_Candidate]:
    """The rungs of the ladder, cheap to dear, the formulas shown beside them, and the reference methods of the kind;
    where none of these can tell anything, they stand there with the reason."""
    for solver in scene.formulas:
        yield _Candidate(
            Rung(solver, solver.represents, 0, solver.cost(spec, scene.scene, frozenset(), 0)), Role.FORMULA
        )
    for rung in scene.rungs:
        sets = [one.carried for one in scene.rungs if one.solver is rung.solver and one.level == rung.level]
        fuller = len(sets) > 1 and len(rung.carried) == max(map(len, sets))
        yield _Candidate(rung, Role.LADDER, " all" if fuller else "")
    seen = [
        one
        for method in kind.reference_methods
        if type(scene.scene) in method.scenes
        for one in _of_method(method, spec, scene, _REFERENCE_SHARE * budget)
    ]
    yield from (one for one in seen if not one.reason or all(other.reason for other in seen))


def _of_method(method: AnySolver, spec: MachineSpec, scene: ScenePlan, most: float) -> Iterator[_Candidate]:
    """A reference method with all it can carry, at its finest affordable refinement; or why it can tell nothing
    here."""
    allowed = frozenset(planned.effect.name for planned in scene.effects) - scene.excluded
    if not method.always <= allowed:
        return
    carried = allowed & method.represents
    beyond = method.valid(spec, scene.scene)
    if beyond is not None and beyond.exceeded:
        yield _Candidate(Rung(method, carried, 0, 0.0), Role.REFERENCE, reason=beyond.meaning)
        return
    rungs = [
        Rung(method, carried, level, method.cost(spec, scene.scene, carried, level)) for level in range(method.levels)
    ]
    cheap = next((rung for rung in reversed(rungs) if rung.seconds <= most), None)
    if cheap is None:
        yield _Candidate(
            rungs[0], Role.REFERENCE, reason=f"more than the {show(most, TIME, 2)} a second method may take"
        )
    else:
        yield _Candidate(cheap, Role.REFERENCE)


def _affordable(made: Plan, budget: float) -> float:
    """The dearest predicted seconds a setting may have so that all up to it stay within the budget."""
    spent, most = 0.0, 0.0
    for seconds in sorted(rung.seconds for scene in made.scenes for rung in scene.rungs):
        spent += seconds
        if spent > budget:
            break
        most = seconds
    return most


# -- measuring -------------------------------------------------------------------------------------------------------


def _measured(spec: MachineSpec, scene: ScenePlan, one: _Candidate, most: float, watch: _Watch) -> _Measured:
    """A setting run as often as it is cheap, each time from nothing, and the shortest of those times."""
    rung = one.rung
    row = Setting(
        scene=scene.scene.label,
        solver=rung.solver.name,
        method=rung.solver.way,
        fidelity=rung.solver.fidelity.value,
        role=one.role,
        effects=tuple(sorted(rung.carried)),
        level=rung.level,
        variant=one.variant,
        predicted_seconds=rung.seconds,
        outcome=Outcome.NOT_RUN,
    )
    if one.reason:
        return _Measured(replace(row, reason=one.reason), rung, {})
    if one.role is Role.LADDER and rung.seconds > most:
        return _Measured(replace(row, reason="beyond the budget"), rung, {})
    try:
        seconds, runs, result, loads = _timed(spec, scene, rung, one.role, watch)
    except NumericsError as error:
        return _Measured(replace(row, outcome=Outcome.FAILED, reason=f"{error.code} {error.message}"), rung, {})
    row = replace(row, seconds=seconds, runs=runs, work=result.work)
    wrong = _broken(result, loads, one.role)
    if wrong:
        return _Measured(replace(row, outcome=Outcome.FAILED, reason=wrong), rung, {})
    return _Measured(replace(row, outcome=Outcome.MEASURED), rung, loads)


def _timed(
    spec: MachineSpec, scene: ScenePlan, rung: Rung, role: Role, watch: _Watch
) -> tuple[float, int, Result, Loads]:
    """Least seconds of several runs, and what they found: the run itself, and the bounds of what it leaves out."""
    best, spent, runs = math.inf, 0.0, 0
    collecting = gc.isenabled()
    while True:
        forget()
        gc.disable()
        try:
            start = watch.clock()
            result = rung.solver.run(spec, scene.scene, rung.carried, rung.level)
            loads: Loads = (
                {name: found.estimate for name, found in result.loads.items()}
                if role is Role.FORMULA
                else widen(scene, spec, rung, result)
            )
            seconds = watch.clock() - start
        finally:
            if collecting:
                gc.enable()
        best, spent, runs = min(best, seconds), spent + seconds, runs + 1
        if runs >= watch.most_runs or seconds > _LONG or (runs > 1 and spent > _ENOUGH):
            return best, runs, result, loads


def _broken(result: Result, loads: Loads, role: Role) -> str:
    """Why a run is no point of the table: a number that is none, or a finding after which no load has a bar."""
    lost = [name for name, estimate in loads.items() if math.isnan(estimate.value)]
    if lost:
        return f"NUM101 {', '.join(lost)} not a number"
    said = next((one for one in result.findings if one.code in _UNTRUSTED), None)
    if said is not None and role is not Role.FORMULA and not any(one.bounded for one in loads.values()):
        return f"{said.code} {said.message}"
    return ""


# -- comparing -------------------------------------------------------------------------------------------------------


def _compared(kind: AnyKind, spec: MachineSpec, scene: ScenePlan, tried: Sequence[_Measured]) -> list[_Measured]:
    """The settings with the errors of their governing loads."""
    names = _of_interest(kind, spec, scene, tried)
    scales = _scales(kind, spec, names, tried)
    return [replace(one, setting=replace(one.setting, loads=_loads(one, tried, scales))) for one in tried]


def _of_interest(kind: AnyKind, spec: MachineSpec, scene: ScenePlan, tried: Sequence[_Measured]) -> list[str]:
    """Loads that govern, or that a check of the file reads, without those that a closed form gives exactly; all of
    them where it gives all exactly."""
    read = {name for check in kind.checks if check.applies_to(scene.scene) for name in _read(check.loads)}
    known = {name for one in tried if one.decides for name in one.loads}
    governing = [
        info.name
        for info in kind.loads_of(spec)
        if info.name in known and (info.governing or info.name in read or family(info.name) in read)
    ]
    exact = {
        name
        for one in tried
        if one.decides and one.rung.solver.fidelity is Fidelity.FORMULA
        for name, estimate in one.loads.items()
        if estimate.low == estimate.high
    }
    return [name for name in governing if name not in exact] or governing


def _read(loads: Iterable[str]) -> Iterator[str]:
    for name in loads:
        yield name
        yield family(name)


def _scales(kind: AnyKind, spec: MachineSpec, names: Sequence[str], tried: Sequence[_Measured]) -> dict[str, float]:
    """What a load is compared with where it is next to nothing: a thousandth of the largest of its quantity."""
    largest: dict[str, float] = {}
    quantities = {name: kind.load_info(spec, name).quantity.name for name in names}
    for one in tried:
        for name in names:
            value = abs(one.loads[name].value) if name in one.loads and one.decides else 0.0
            if math.isfinite(value):
                largest[quantities[name]] = max(largest.get(quantities[name], 0.0), value)
    return {name: _SMALL * largest.get(quantities[name], 0.0) for name in names}


def _loads(one: _Measured, tried: Sequence[_Measured], scales: Mapping[str, float]) -> tuple[LoadCost, ...]:
    """The loads of a setting, each against the best known value of another method."""
    found = []
    for name, least in scales.items():
        estimate = one.loads.get(name)
        if estimate is None:
            continue
        reference = _reference(one, name, tried)
        found.append(_load(name, estimate, one.setting.role, reference, least))
    return tuple(found)


def _reference(one: _Measured, name: str, tried: Sequence[_Measured]) -> tuple[str, Estimate] | None:
    """The setting of another method that knows the load most closely; the dearer of two that know it alike."""
    others = [
        (other.loads[name].bar, -(other.setting.seconds or 0.0), other.setting.name, other.loads[name])
        for other in tried
        if other.setting.method != one.setting.method
        and other.setting.role is not Role.FORMULA
        and name in other.loads
        and other.loads[name].bounded
    ]
    if not others:
        return None
    _, _, reference, estimate = min(others, key=lambda part: part[:3])
    return reference, estimate


def _load(name: str, own: Estimate, role: Role, reference: tuple[str, Estimate] | None, least: float) -> LoadCost:
    bounded = own.bounded and role is not Role.FORMULA
    truth = reference[1] if reference else None
    bar = own.bar / (max(abs(own.value), least) or 1.0) if bounded else None
    if reference is None or truth is None or not math.isfinite(own.value):
        return LoadCost(name, own.value, bar)
    scale = max(abs(truth.value), least) or 1.0
    error, resolution = abs(own.value - truth.value) / scale, truth.bar / scale
    held = _held(own, truth, scale) if bounded else None
    return LoadCost(name, own.value, bar, reference[0], truth.value, error, resolution, held)


def _held(own: Estimate, truth: Estimate, scale: float) -> Held:
    """Whether the interval of a setting holds the truth, as far as the reference knows it."""
    slack = _ROUNDING * scale
    if own.low - slack <= truth.value <= own.high + slack:
        return Held.YES
    apart = truth.low > own.high + slack or truth.high < own.low - slack
    return Held.NO if apart else Held.OPEN


def _fronts(settings: Sequence[Setting]) -> list[Setting]:
    """The settings with marks on those that no other one beats, in true error and in what the bar proves.

    One setting beats another that gives no more of the loads, and is neither cheaper nor closer.
    """
    runs = [one for one in settings if one.role is Role.LADDER and one.outcome is Outcome.MEASURED and one.loads]
    errors = {id(one): one.error_at_most for one in runs}
    bars = {id(one): one.bar for one in runs}
    return [
        replace(one, front_of_errors=_unbeaten(one, runs, errors), front_of_bars=_unbeaten(one, runs, bars))
        for one in settings
    ]


def _unbeaten(one: Setting, runs: Sequence[Setting], measure: Mapping[int, float | None]) -> bool:
    own = measure.get(id(one))
    if own is None or not math.isfinite(own):
        return False
    names = {load.name for load in one.loads}
    for other in runs:
        its = measure[id(other)]
        if other is one or its is None or not names <= {load.name for load in other.loads}:
            continue
        better = (other.seconds or 0.0) < (one.seconds or 0.0) or its < own
        if better and (other.seconds or 0.0) <= (one.seconds or 0.0) and its <= own:
            return False
    return True


# -- choosing --------------------------------------------------------------------------------------------------------

Enough = Callable[[Loads], list[str]]
"""What is still missing with these loads: nothing when they do."""


def _choices(
    kind: AnyKind, spec: MachineSpec, scene: ScenePlan, tried: Sequence[_Measured], accuracies: Sequence[float]
) -> Iterator[Choice]:
    """The cheapest settings for each accuracy, by what their bars prove, and for the verdicts of this file."""
    names = _of_interest(kind, spec, scene, tried)
    scales = _scales(kind, spec, names, tried)
    for accuracy in accuracies:

        def accurate(loads: Loads, asked: float = accuracy) -> list[str]:
            return [name for name in names if not _within(loads.get(name), scales[name], asked)]

        yield _cheapest(scene, show(accuracy, SHARE), accuracy, tried, accurate)
    yield _cheapest(scene, MARGINS, None, tried, lambda loads: _undecided(judge(kind, spec, scene.scene, loads)))


def _within(estimate: Estimate | None, least: float, asked: float) -> bool:
    return estimate is not None and estimate.bounded and estimate.bar <= asked * max(abs(estimate.value), least)


def _undecided(rulings: Iterable[Ruling]) -> list[str]:
    return [one.check.code for one in rulings if one.verdict is Verdict.UNDECIDED]


def _cheapest(
    scene: ScenePlan, target: str, accuracy: float | None, tried: Sequence[_Measured], missing: Enough
) -> Choice:
    """The cheapest set of settings with nothing missing: all up to the first that suffices, without those it can
    spare, or one alone with the closed forms, whichever costs less."""
    runs = sorted((one for one in tried if one.decides), key=lambda one: one.setting.seconds or 0.0)
    formulas = [one for one in runs if one.rung.solver.fidelity is Fidelity.FORMULA and one.rung.level == 0]
    label = scene.scene.label
    if not missing({}):
        return Choice(label, target, accuracy, (), 0.0)
    best = next((runs[:count] for count in range(1, len(runs) + 1) if not missing(_merged(runs[:count]))), None)
    if best is None:
        return Choice(label, target, accuracy, (), None, tuple(missing(_merged(runs))) or ("nothing ran",))
    best = _spared(best, missing)
    for one in runs:
        alone = [*(part for part in formulas if part is not one), one]
        if (one.setting.seconds or 0.0) < _seconds(best) and not missing(_merged(alone)):
            best = min(best, _spared(alone, missing), key=_seconds)
    return Choice(label, target, accuracy, tuple(one.setting.name for one in best), _seconds(best))


def _spared(runs: Sequence[_Measured], missing: Enough) -> list[_Measured]:
    """The settings without those that are not needed, the dearest left out first."""
    kept = list(runs)
    for one in sorted(runs, key=lambda part: -(part.setting.seconds or 0.0)):
        fewer = [part for part in kept if part is not one]
        if not missing(_merged(fewer)):
            kept = fewer
    return kept


def _seconds(runs: Iterable[_Measured]) -> float:
    return sum(one.setting.seconds or 0.0 for one in runs)


def _merged(runs: Iterable[_Measured]) -> dict[str, Estimate]:
    """Of each load the one with the smallest bar."""
    found: dict[str, Estimate] = {}
    for one in runs:
        for name, estimate in one.loads.items():
            if name not in found or estimate.bar <= found[name].bar:
                found[name] = estimate
    return found


def _margins(
    kind: AnyKind, spec: MachineSpec, scene: ScenePlan, tried: Sequence[_Measured]
) -> Iterator[tuple[str, float]]:
    """The relative margins of the scene's checks, as far as the settings know them."""
    for ruling in judge(kind, spec, scene.scene, _merged(one for one in tried if one.decides)):
        if ruling.margin is not None and ruling.limit is not None and ruling.value is not None:
            scale = abs(ruling.limit.value) or abs(ruling.value.value)
            if scale and math.isfinite(ruling.margin):
                yield ruling.check.code, ruling.margin / scale
