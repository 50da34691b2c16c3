"""Tests of error bars: loads with their bars, of seeded random machines, against exact values.

A coverage test draws machines by number (`numbers`) and evaluates each by `tried`. A `Trial` contains: the loads of
every method with their error bars (`claims`), the exact loads by an independent reference or a much finer run with more
effects (`truth`), the verdicts of the program (`said`), and those with the exact loads (`right`). Every other machine
has a limit within three error bars of a load (`near`). The test then requires:

* `misses` is empty: every exact value is within its error bar; with a third of the bars it is not empty;
* `wide` is at most `WIDEST`: the median of error bar over true error, of loads that checks read; 0 if no check does;
* `opposites` is empty: no verdict is `pass` where the exact loads fail, or the reverse.

A module names the solvers and effects that it tests so in `ON_TRIAL`, and those without an error bar except rounding,
for which a third of the bar means nothing, in `WITHOUT_BARS`. `tests/house/test_bars.py` finds those that no module
names.
"""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from statistics import median
from typing import Any, NamedTuple

import numpy as np
import pytest

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Sense
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.result import Result, family
from ptmcalc.contract.solver import AnySolver
from ptmcalc.engine.judge import Ruling, judge
from ptmcalc.engine.plan import Rung, ScenePlan, plan_scene
from ptmcalc.engine.run import settle
from ptmcalc.engine.widen import widen
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.spec.scene import Scene

MACHINES = 200
"""Machines of a sample; where one costs much, a part of them runs always and all of them as a study."""
BARS = 3.0
"""How far a limit may stand from a claim, in bars of it."""
THIRD = 1 / 3
WIDEST = 10.0
"""The median bar over the true error, of machines whose true error counts."""
KNOWN_WIDE = {
    "belt_damping": 30.0,
    "emergency_stop": 20.0,
    "moving_belt": 20.0,
    "network": 15.0,
    "takeup_weight": 12.0,
}
"""Ways whose bars hold but are wider than wanted, and how wide they may be at most until somebody sharpens them."""
COUNTS = 1e-3
"""True error that counts, as a share of the load."""
ROUNDING = 1e-9
_NO_BAR = 0.2
"""Of a load, in place of a bar that is infinite or rounding."""

Loads = Mapping[str, Estimate]


@dataclass(frozen=True)
class Limit:
    """A limit that a file can set for a load: its key, or what else puts it; `least` and `most` are what it may be."""

    load: str
    at: KeyPath | Callable[[Any, float], MachineSpec]
    least: float = -math.inf
    most: float = math.inf

    def put(self, spec: MachineSpec, value: float) -> MachineSpec | None:
        """The machine with this limit, if it may be."""
        if not (math.isfinite(value) and self.least <= value <= self.most):
            return None
        return self.at(spec, value) if callable(self.at) else spec.with_value(self.at, value)


@dataclass(frozen=True)
class Trial:
    """A machine: what each way claims, what is exact, what the ladder says, and what is right.

    `judged` are the families of loads that checks read.
    """

    number: int
    near: bool
    spec: MachineSpec
    judged: frozenset[str]
    claims: Mapping[str, Loads]
    truth: Loads
    said: tuple[Ruling, ...]
    right: tuple[Ruling, ...]


class Miss(NamedTuple):
    """A load whose exact value, less what that itself is good for, lies outside a claim."""

    number: int
    load: str
    low: float
    high: float
    exact: float


def numbers(always: int, all_of_them: int = MACHINES) -> list[Any]:
    """Parameters of a sample: the machines that are always tried, and all of them as a study."""
    if always >= all_of_them:
        return [pytest.param(range(all_of_them), id=f"all-{all_of_them}")]
    whole = pytest.param(range(all_of_them), id=f"all-{all_of_them}", marks=pytest.mark.study)
    return [pytest.param(range(always), id=f"some-{always}"), whole]


def known_to(share: float, value: float) -> Estimate:
    """What a reference finds, good to a share of it; exactly where it is without end."""
    return Estimate.exact(value) if math.isinf(value) else Estimate.within(value, share * abs(value))


def claim(
    kind: AnyKind, spec: MachineSpec, scene: Scene, solver: AnySolver, carried: Iterable[str] = (), level: int = 0
) -> dict[str, Estimate]:
    """Loads of a run with the bounds of all that it leaves out, as the ladder takes them."""
    return claim_of(plan_scene(kind, spec, scene), spec, solver, carried, level)


def claim_of(
    plan: ScenePlan, spec: MachineSpec, solver: AnySolver, carried: Iterable[str] = (), level: int = 0
) -> dict[str, Estimate]:
    """The same of a scene that is planned."""
    rung = Rung(solver, frozenset(carried), level, 0.0)
    result: Result = solver.run(spec, plan.scene, rung.carried, level)
    return widen(plan, spec, rung, result)


def claim_within(
    plan: ScenePlan, spec: MachineSpec, solver: AnySolver, carried: Iterable[str] = (), level: int = 0
) -> dict[str, Estimate]:
    """The same of what happens in the window of the run: what another run of that window is held against."""
    rung = Rung(solver, frozenset(carried), level, 0.0)
    result: Result = solver.run(spec, plan.scene, rung.carried, level)
    return widen(plan, spec, rung, replace(result, beyond={}))


def tried(
    number: int,
    rng: np.random.Generator,
    kind: AnyKind,
    spec: MachineSpec,
    scene: Scene,
    claims: Mapping[str, Loads],
    truth: Loads,
    limits: Sequence[Limit] = (),
    *,
    climbs: bool = True,
) -> Trial:
    """A machine put on trial: every other one with a limit within three bars of what one of its ways claims.

    The ladder then climbs as `check` lets it; what is right, the checks say of the exact loads. Where no other way
    gives the loads that are on trial and the ones beside them cost much, it need not climb: the claims are judged.
    """
    near = False
    if number % 2 == 0:
        moved = _near(spec, claims, limits, rng)
        near, spec = moved is not None, moved or spec
    if climbs:
        said = settle(kind, spec, plan_scene(kind, spec, scene)).rulings
    else:
        said = judge(kind, spec, scene, {name: one for loads in claims.values() for name, one in loads.items()})
    judged = frozenset(family(load) for check in kind.checks for load in check.loads)
    return Trial(number, near, spec, judged, claims, truth, said, judge(kind, spec, scene, truth))


def _near(
    spec: MachineSpec, claims: Mapping[str, Loads], limits: Sequence[Limit], rng: np.random.Generator
) -> MachineSpec | None:
    """The machine with one limit within three bars of a claim; bars that are more than rounding come first."""
    known = [
        (limit, loads[limit.load])
        for limit in limits
        for loads in claims.values()
        if limit.load in loads and math.isfinite(loads[limit.load].value)
    ]
    known = [known[k] for k in rng.permutation(len(known))]
    known.sort(key=lambda one: not _worth(one[1]))
    for limit, one in known:
        bar = one.bar if _worth(one) else _NO_BAR * abs(one.value)
        for _ in range(4):
            moved = limit.put(spec, one.value + float(rng.uniform(-BARS, BARS)) * bar)
            if moved is not None:
                return moved
    return None


def _worth(one: Estimate) -> bool:
    """Whether a bar is finite and more than rounding."""
    return one.bounded and one.bar > 1e3 * ROUNDING * abs(one.value)


def misses(trials: Iterable[Trial], way: str, share: float = 1.0, ignored: Iterable[str] = ()) -> list[Miss]:
    """Loads whose exact value lies outside a share of what a way claims; a claim without an end holds anything."""
    missed = []
    for trial in trials:
        for name, one, exact in _pairs(trial, way, ignored):
            if not math.isfinite(one.value) or not math.isfinite(exact.value):
                if one.value != exact.value and one.low == one.high:
                    missed.append(Miss(trial.number, name, one.low, one.high, exact.value))
                continue
            low, high = (one.value + share * (end - one.value) for end in (one.low, one.high))
            slack = exact.bar + ROUNDING * abs(exact.value)
            if not low - slack <= exact.value <= high + slack:
                missed.append(Miss(trial.number, name, low, high, exact.value))
    return missed


def _pairs(trial: Trial, way: str, ignored: Iterable[str]) -> Iterable[tuple[str, Estimate, Estimate]]:
    """Loads that a way claims and that are known exactly."""
    claims, out = trial.claims.get(way, {}), set(ignored)
    for name in claims.keys() & trial.truth.keys():
        one, exact = claims[name], trial.truth[name]
        known = not math.isnan(exact.value) and (exact.bounded or math.isinf(exact.value))
        if family(name) not in out and known and not math.isnan(one.value):
            yield name, one, exact


def ratios(trials: Iterable[Trial], way: str, ignored: Iterable[str] = ()) -> dict[str, list[float]]:
    """Bar over true error by family of loads, of machines whose true error counts and is more than what the exact value
    itself is good for."""
    found: dict[str, list[float]] = {}
    for trial in trials:
        for name, one, exact in _pairs(trial, way, ignored):
            if not (one.bounded and math.isfinite(exact.value)):
                continue
            error = abs(one.value - exact.value)
            if error > max(COUNTS * abs(exact.value), 2 * exact.bar):
                found.setdefault(family(name), []).append(one.bar / error)
    return found


def wide(trials: Sequence[Trial], way: str, ignored: Iterable[str] = ()) -> float:
    """The median bar over the true error of the loads that checks read; 0 where no error counts."""
    judged = frozenset().union(*(trial.judged for trial in trials))
    found = [ratio for load, some in ratios(trials, way, ignored).items() if load in judged for ratio in some]
    return median(found) if found else 0.0


def widest(way: str) -> float:
    """What the median bar over the true error may be."""
    return KNOWN_WIDE.get(way, WIDEST)


def bounded(trials: Iterable[Trial], way: str, load: str) -> float:
    """Share of the claims of a load that have ends: a sample whose intervals are infinite proves nothing."""
    claims = [trial.claims[way][load] for trial in trials if load in trial.claims.get(way, {})]
    return sum(one.bounded for one in claims) / len(claims) if claims else 0.0


def near(trials: Sequence[Trial]) -> float:
    """Share of the machines that stand within three bars of a limit."""
    return sum(trial.near for trial in trials) / len(trials)


def opposites(trials: Iterable[Trial]) -> list[tuple[int, str, Verdict, Verdict]]:
    """Verdicts of the ladder that say pass where the exact loads say fail, or the other way round.

    A reserve that is below 1 in truth fails by what a run found, however low the limit that is drawn for it.
    """
    wrong = []
    for trial in trials:
        for said, right in zip(trial.said, trial.right, strict=True):
            if said.found and right.value is not None and right.value.high < 1 and said.check.sense is Sense.AT_LEAST:
                continue
            if {said.verdict, right.verdict} == {Verdict.PASS, Verdict.FAIL}:
                wrong.append((trial.number, said.check.code, said.verdict, right.verdict))
    return wrong


def verdicts(trials: Iterable[Trial], *codes: str) -> list[Verdict]:
    """What the ladder says, of some checks or of all."""
    return [one.verdict for trial in trials for one in trial.said if not codes or one.check.code in codes]


def told(trials: Sequence[Trial], ignored: Iterable[str] = ()) -> str:
    """The outcome in words, a line for every way: claims held, the largest share of a bar that was needed, the median
    bar over the true error by family."""
    lines = []
    for way in sorted({way for trial in trials for way in trial.claims}):
        here = [pair for trial in trials for pair in _pairs(trial, way, ignored)]
        ends = [pair for pair in here if pair[1].bounded]
        needed = max((_needed(one, exact) for _, one, exact in ends), default=0.0)
        by = {load: f"{median(found):.3g} ({len(found)})" for load, found in ratios(trials, way, ignored).items()}
        lines.append(
            f"{way}: {len(ends)} of {len(here)} bounded, {len(misses(trials, way, 1.0, ignored))} missed, needed"
            f" {needed:.3f}, median {wide(trials, way, ignored):.3g}, by load {by}"
        )
    return "\n".join(lines)


def _needed(one: Estimate, exact: Estimate) -> float:
    """Part of a bar that the exact value takes at least."""
    off = exact.value - one.value
    room = one.high - one.value if off > 0 else one.value - one.low
    needed = max(abs(off) - exact.bar - ROUNDING * abs(exact.value), 0.0)
    return needed / room if room > 0 else math.inf if needed > 0 else 0.0
