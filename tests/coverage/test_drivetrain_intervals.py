"""Error bars are claims: those of one rigid shaft, of a train without play and of every refinement hold the truth.

Truth is the finest run with everything in it, and on every machine an independent integration beside it. Half of the
machines stand within three bars of a limit; the ladder never says of one the opposite of the finest run.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from support.drivetrain_samples import linear_train, loads_of, motor_train, train_with_play
from support.drivetrains import spec_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import family
from ptmcalc.engine.judge import Ruling, judge
from ptmcalc.engine.plan import Rung, plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.engine.run import Settled, settle, widen
from ptmcalc.machines.drivetrain.solvers.elastic import ELASTIC
from ptmcalc.machines.drivetrain.solvers.reduced import REDUCED
from ptmcalc.machines.drivetrain.spec import Drivetrain

KIND = load_kind("drivetrain")
EVERYTHING = frozenset({"elasticity", "backlash"})
Loads = dict[str, Estimate]
SORTS: dict[str, Callable[[np.random.Generator], dict[str, Any]]] = {
    "linear": linear_train,
    "play": train_with_play,
    "motor": motor_train,
}
RUNGS = {
    "one shaft": Rung(REDUCED, frozenset(), 0, 0.0),
    "without play": Rung(ELASTIC, frozenset({"elasticity"}), 0, 0.0),
    "first refinement": Rung(ELASTIC, EVERYTHING, 0, 0.0),
    "second refinement": Rung(ELASTIC, EVERYTHING, 1, 0.0),
    "finest": Rung(ELASTIC, EVERYTHING, 2, 0.0),
}
TRIED = {
    "linear": ("one shaft", "first refinement", "finest"),
    "play": ("one shaft", "without play", "first refinement", "finest"),
    "motor": ("one shaft", "first refinement", "second refinement", "finest"),
}
MORE_THAN_ROUNDING = {
    "linear": [("one shaft",)],
    "play": [("without play",)],
    "motor": [("first refinement", "second refinement")],
}
"""Kinds of bars that are more than rounding on a sort of machines."""
REFERENCE = 3e-9
"""What the independent integration is good for, as a share of the largest load of a kind."""
SEED = 20261122
SAMPLES = [
    pytest.param(("linear", 60, SEED), id="linear"),
    pytest.param(("play", 36, SEED + 1), id="play"),
    pytest.param(("motor", 30, SEED + 2), id="motor"),
    *(
        pytest.param((sort, 400, SEED + 10 * k), id=f"{sort}-{k}", marks=pytest.mark.study)
        for sort in SORTS
        for k in range(1, 4)
    ),
]


@dataclass(frozen=True)
class Case:
    """A machine: what each rung claims of it, what an independent integration finds, how the ladder settled, and the
    verdicts from the finest run alone."""

    index: int
    claims: dict[str, Loads]
    reference: dict[str, float]
    ladder: Settled
    exact: tuple[Ruling, ...]


def _claims(spec: Drivetrain, sort: str) -> dict[str, Loads]:
    plan = plan_scene(KIND, spec, spec.all_scenes[0])
    found = {}
    for name in TRIED[sort]:
        rung = RUNGS[name]
        result = rung.solver.run(spec, plan.scene, rung.carried, rung.level)
        found[name] = {load: value for load, value in widen(plan, spec, rung, result).items() if _moves(load)}
    return found


def _moves(load: str) -> bool:
    """Whether a load comes from the motion, and not from the rigid train whatever the rung."""
    return family(load) not in ("torque_steady", "energy_residual")


def _near_a_limit(spec: Drivetrain, claims: dict[str, Loads], rng: np.random.Generator) -> Drivetrain:
    """The same machine with the limit of one link within three bars of what some rung claims of it."""
    link = str(rng.choice(list(spec.links)))
    claim = claims[str(rng.choice(list(claims)[:-1]))][f"torque_peak[{link}]"]
    bar = claim.bar if claim.bounded else 0.2 * claim.value
    limit = claim.value + rng.uniform(-3, 3) * bar
    return spec.with_value(("links", link, "limit"), limit) if limit > 0 else spec


@pytest.fixture(scope="module", params=SAMPLES)
def sample(request: pytest.FixtureRequest) -> tuple[str, list[Case]]:
    sort, number, seed = request.param
    rng = np.random.default_rng(seed)
    found = []
    for index in range(number):
        data = SORTS[sort](rng)
        spec = spec_of(data)
        claims = _claims(spec, sort)
        if index % 2 == 0:
            spec = _near_a_limit(spec, claims, rng)
        (scene,) = spec.all_scenes
        ladder = settle(KIND, spec, plan_scene(KIND, spec, scene))
        found.append(Case(index, claims, loads_of(data), ladder, judge(KIND, spec, scene, claims["finest"])))
    return sort, found


def _size(load: str, loads: dict[str, float]) -> float:
    """Largest load of a kind."""
    kind = family(load).partition("_")[0]
    return max(abs(value) for name, value in loads.items() if family(name).partition("_")[0] == kind)


def _misses(case: Case, rung: str, share: float) -> list[str]:
    """Loads whose truth, less its own bar, lies outside a share of the claimed interval."""
    missed, truth = [], case.claims["finest"]
    for name, exact in truth.items():
        claim = case.claims.get(rung, {}).get(name)
        if claim is None or not (claim.bounded and exact.bounded):
            continue
        low, high = (claim.value + share * (end - claim.value) for end in (claim.low, claim.high))
        slack = exact.bar + 1e-11 * abs(exact.value)
        if not low - slack <= exact.value <= high + slack:
            missed.append(name)
    return missed


def test_the_finest_run_agrees_with_an_independent_integration(sample: tuple[str, list[Case]]) -> None:
    _, cases = sample
    wrong = {}
    for case in cases:
        assert len(case.reference) > 5
        for name, value in case.reference.items():
            claim = case.claims["finest"][name]
            slack = claim.bar + REFERENCE * (_size(name, case.reference) + 1e-3)
            if abs(claim.value - value) > slack:
                wrong[case.index, name] = (claim.value, value)
    assert wrong == {}


@pytest.mark.parametrize("rung", list(RUNGS)[:-1])
def test_a_bar_holds_the_truth_on_every_machine(sample: tuple[str, list[Case]], rung: str) -> None:
    _, cases = sample
    assert {case.index: missed for case in cases if (missed := _misses(case, rung, 1.0))} == {}


def test_a_third_of_it_would_not(sample: tuple[str, list[Case]]) -> None:
    sort, cases = sample
    for rungs in MORE_THAN_ROUNDING[sort]:
        assert any(_misses(case, rung, 1 / 3) for case in cases for rung in rungs), rungs


def test_the_claims_are_worth_something(sample: tuple[str, list[Case]]) -> None:
    """A sample whose intervals are infinite proves nothing."""
    sort, cases = sample
    rung = MORE_THAN_ROUNDING[sort][0][0]
    least = {"linear": 0.9, "play": 0.3, "motor": 0.95}[sort]
    peaks = [case.claims[rung][name] for case in cases for name in case.claims[rung] if family(name) == "torque_peak"]
    assert sum(one.bounded for one in peaks) > least * len(peaks)
    if sort != "motor":
        assert sum(one.bar > 1e-6 * abs(one.value) for one in peaks) > 0.2 * len(peaks)


def test_the_ladder_never_says_the_opposite_of_the_finest_run(sample: tuple[str, list[Case]]) -> None:
    sort, cases = sample
    pairs = [
        (case.index, ruling.check.code, ruling.verdict, exact.verdict)
        for case in cases
        for ruling, exact in zip(case.ladder.rulings, case.exact, strict=True)
    ]
    assert [pair for pair in pairs if set(pair[2:]) == {Verdict.PASS, Verdict.FAIL}] == []
    said = [verdict for *_, verdict, _ in pairs]
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.1 * len(cases)
    assert said.count(Verdict.UNDECIDED) < 0.1 * len(said)
    if sort == "linear":
        assert sum(not case.ladder.carried for case in cases) > 0.03 * len(cases), "one rigid shaft decides some"
