"""Error bars are claims: the rigid body's interval holds the exact value, and the ladder never contradicts it.

Exact is the run with every effect at once, on two grids. Half of the machines stand within three bars of a limit.
"""

import math
from dataclasses import dataclass

import numpy as np
import pytest
from support.conveyors import random_conveyor

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.engine.plan import Rung, ScenePlan, plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.engine.run import Settled, settle, widen
from ptmcalc.machines.conveyor.model import start_case
from ptmcalc.machines.conveyor.solvers import rigid
from ptmcalc.machines.conveyor.spec import Conveyor

KIND = load_kind("conveyor")
MACHINES, SEED = 200, 20261121
ALL = tuple(range(MACHINES))
SOME = (*range(60), 155)
"""A bounded part, and a machine whose first wave meets a belt that sags: its bound was once that of a straight one."""
SLOW = {"moving_belt": "off"}  # what a running belt carries along has a test of its own
MOST_CONTOURS = 20  # longer starts cost more and say no more


@dataclass(frozen=True)
class Case:
    """A machine: what the rigid body claims, what is exact, and how the ladder settled."""

    index: int
    takeup: str
    near: bool
    claimed: dict[str, Estimate]
    exact: Settled
    ladder: Settled


def _machine(rng: np.random.Generator) -> Conveyor:
    while True:
        spec = Conveyor.model_validate(random_conveyor(rng) | {"effects": SLOW})
        case = start_case(spec, spec.all_scenes[0])
        if case.moves and case.window < MOST_CONTOURS * case.line.contour_time:
            return spec


def _claims(spec: Conveyor, plan: ScenePlan) -> dict[str, Estimate]:
    result = rigid.RIGID.run(spec, plan.scene, frozenset(), 0)
    return widen(plan, spec, Rung(rigid.RIGID, frozenset(), 0, 0.0), result)


def _near_a_limit(spec: Conveyor, claims: dict[str, Estimate], rng: np.random.Generator) -> Conveyor:
    """The same machine with the limit of one check within three bars of its value; drawn until it is allowed."""
    keys = [("checks", "slip", "reserve"), ("checks", "belt_safety_starting")]
    loads = ["slip_reserve_min", "belt_safety_min"]
    for which in (int(rng.integers(2)), 0, 1):
        claim = claims[loads[which]]
        bar = claim.bar if math.isfinite(claim.bar) else 0.2 * claim.value
        limit = claim.value + rng.uniform(-3, 3) * bar
        if math.isfinite(limit) and limit >= (1.0 if which == 0 else 0.1):
            return spec.with_value(keys[which], limit)
    return spec


@pytest.fixture(
    scope="module",
    params=[pytest.param(SOME, id="some"), pytest.param(ALL, id="all", marks=pytest.mark.study)],
)
def cases(request: pytest.FixtureRequest) -> list[Case]:
    rng = np.random.default_rng(SEED)
    found = []
    for index in range(max(request.param) + 1):
        spec = _machine(rng)
        scene, near = spec.all_scenes[0], index % 2 == 0
        claims = _claims(spec, plan_scene(KIND, spec, scene))
        if near:
            spec = _near_a_limit(spec, claims, rng)
        if index not in request.param:
            continue
        plan = plan_scene(KIND, spec, scene)
        always = spec.model_copy(update={"effects": {effect.name: "on" for effect in KIND.effects} | SLOW})
        exact = settle(KIND, always, plan_scene(KIND, always, scene))
        found.append(Case(index, spec.takeup.type, near, claims, exact, settle(KIND, spec, plan)))
    return found


def _misses(case: Case, share: float) -> list[str]:
    """Loads whose exact value, less its own bar, lies outside a share of the claimed interval."""
    missed = []
    for name, exact in case.exact.estimates.items():
        claim = case.claimed.get(name)
        if claim is None or not exact.bounded or not math.isfinite(claim.value):
            continue
        low, high = (claim.value + share * (end - claim.value) for end in (claim.low, claim.high))
        slack = exact.bar + 1e-9 * abs(exact.value)
        if exact.value + slack < low or exact.value - slack > high:
            missed.append(name)
    return missed


def test_the_sample_has_both_takeups_and_both_kinds_of_belt(cases: list[Case]) -> None:
    count = {kind: sum(case.takeup == kind for case in cases) for kind in ("gravity", "rigid")}
    assert min(count.values()) > 0.3 * len(cases)
    bounded = sum(case.claimed["tension_run_on_max"].bounded for case in cases)
    assert bounded > 0.5 * len(cases), "a sample whose intervals are infinite proves nothing"


def test_the_rigid_interval_holds_the_exact_value_on_every_machine(cases: list[Case]) -> None:
    assert {case.index: missed for case in cases if (missed := _misses(case, 1.0))} == {}


@pytest.mark.parametrize("takeup", ["gravity", "rigid"])
def test_a_third_of_the_interval_would_not(cases: list[Case], takeup: str) -> None:
    assert any(_misses(case, 1 / 3) for case in cases if case.takeup == takeup)


def test_the_ladder_never_says_the_opposite_of_always_exact(cases: list[Case]) -> None:
    wrong = [
        (case.index, ruling.check.code, ruling.verdict, exact.verdict)
        for case in cases
        for ruling, exact in zip(case.ladder.rulings, case.exact.rulings, strict=True)
        if {ruling.verdict, exact.verdict} == {Verdict.PASS, Verdict.FAIL}
    ]
    assert wrong == []


def test_hardly_a_verdict_is_left_open(cases: list[Case]) -> None:
    verdicts = [ruling.verdict for case in cases for ruling in case.ladder.rulings]
    assert verdicts.count(Verdict.UNDECIDED) < 0.03 * len(verdicts)
    assert {Verdict.PASS, Verdict.FAIL} <= set(verdicts)


def test_the_ladder_does_less_work_than_always_exact(cases: list[Case]) -> None:
    ladder, always = ([run for one in kind for run in one.runs] for kind in _both(cases))
    assert sum(run.result.work for run in ladder) < 0.8 * sum(run.result.work for run in always)
    assert sum(run.rung.seconds for run in ladder) < 0.75 * sum(run.rung.seconds for run in always)
    assert sum(len(case.ladder.runs) == 1 for case in cases) > 0.2 * len(cases), "closed forms decide many machines"


def _both(cases: list[Case]) -> tuple[list[Settled], list[Settled]]:
    return [case.ladder for case in cases], [case.exact for case in cases]
