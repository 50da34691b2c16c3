"""Error bars are claims: the rigid body's interval holds the exact value, and the ladder never contradicts it.

Exact is the run with every effect at once, on two grids. Half of the machines stand within three bars of a limit.
"""

import math
from dataclasses import dataclass

import numpy as np
import pytest
from support.bars import THIRD, WIDEST, Trial, claim_of, misses, near, opposites, wide
from support.conveyors import random_conveyor, text

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.engine.plan import ScenePlan, plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.engine.run import settle
from ptmcalc.engine.settled import Settled
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.machine.start_case import start_case
from ptmcalc.machines.conveyor.starting.rigid import RIGID
from ptmcalc.machines.conveyor.waves.two_interval import TWO_INTERVAL

ON_TRIAL = {"conveyor": ("rigid", "two_interval", "belt_wave", "slip")}
KIND = load_kind("conveyor")
MACHINES, SEED = 200, 20261121
ALL = tuple(range(MACHINES))
SOME = (*range(60), 155)
"""A bounded part, and a machine whose first wave meets a belt that sags: its bound was once that of a straight one."""
JUDGED = {load for check in KIND.checks for load in check.loads}
SLOW = {"moving_belt": "off", "takeup_mass": "off"}  # what they change has tests of its own
TAUT = 2.5
MOST_CONTOURS = 20  # longer starts cost more and say no more


@dataclass(frozen=True)
class Case:
    """A machine on trial: how the ladder settled, and how with everything in every run."""

    trial: Trial
    takeup: str
    exact: Settled
    ladder: Settled


def _machine(rng: np.random.Generator) -> Conveyor:
    """A machine whose take-up keeps most belts taut and most drums in grip when the torque falls at rated speed."""
    while True:
        data = random_conveyor(rng) | {"effects": SLOW}
        data["takeup"]["tension"] = text(TAUT * float(data["takeup"]["tension"].split()[0]), "N")
        spec = Conveyor.model_validate(data)
        case = start_case(spec, spec.all_scenes[0])
        if case.moves and case.window < MOST_CONTOURS * case.line.contour_time:
            return spec


def _claims(spec: Conveyor, plan: ScenePlan) -> dict[str, dict[str, Estimate]]:
    """What the closed forms claim."""
    found = {"rigid": claim_of(plan, spec, RIGID)}
    if TWO_INTERVAL.usable_for(spec, plan.scene):
        found["two_interval"] = claim_of(plan, spec, TWO_INTERVAL, {"belt_wave"})
    return found


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
        scene, plain = spec.all_scenes[0], spec
        claims = _claims(spec, plan_scene(KIND, spec, scene))
        if index % 2 == 0:
            spec = _near_a_limit(spec, claims["rigid"], rng)
        if index not in request.param:
            continue
        moved = spec is not plain
        plan = plan_scene(KIND, spec, scene)
        always = spec.model_copy(update={"effects": {effect.name: "on" for effect in KIND.effects} | SLOW})
        exact = settle(KIND, always, plan_scene(KIND, always, scene))
        ladder, judged = settle(KIND, spec, plan), frozenset(JUDGED)
        truth = {name: best.result.loads[name].estimate for name, best in exact.loads.items()}  # in the window it has
        trial = Trial(index, moved, spec, judged, claims, truth, ladder.rulings, exact.rulings)
        found.append(Case(trial, spec.takeup.type, exact, ladder))
    return found


@pytest.fixture(scope="module")
def trials(cases: list[Case]) -> list[Trial]:
    return [case.trial for case in cases]


def test_the_sample_has_both_takeups_and_both_kinds_of_belt(cases: list[Case]) -> None:
    count = {kind: sum(case.takeup == kind for case in cases) for kind in ("gravity", "rigid")}
    assert min(count.values()) > 0.3 * len(cases)
    bounded = sum(case.trial.claims["rigid"]["tension_run_on_max"].bounded for case in cases)
    assert bounded > 0.5 * len(cases), "a sample whose intervals are infinite proves nothing"


@pytest.mark.parametrize("way", ["rigid", "two_interval"])
def test_the_interval_holds_the_exact_value_on_every_machine(trials: list[Trial], way: str) -> None:
    assert misses(trials, way) == []


@pytest.mark.parametrize("takeup", ["gravity", "rigid"])
def test_a_third_of_the_interval_would_not(cases: list[Case], takeup: str) -> None:
    assert misses([case.trial for case in cases if case.takeup == takeup], "rigid", THIRD) != []


def test_the_interval_is_not_much_wider_than_the_true_error(trials: list[Trial]) -> None:
    assert wide(trials, "rigid") <= WIDEST


def test_the_ladder_never_says_the_opposite_of_always_exact(trials: list[Trial]) -> None:
    assert opposites(trials) == []
    assert near(trials) >= 0.45


def test_hardly_a_verdict_is_left_open(cases: list[Case]) -> None:
    verdicts = [ruling.verdict for case in cases for ruling in case.ladder.rulings]
    assert verdicts.count(Verdict.UNDECIDED) < 0.03 * len(verdicts)
    assert {Verdict.PASS, Verdict.FAIL} <= set(verdicts)


def test_the_ladder_does_less_work_than_always_exact(cases: list[Case]) -> None:
    """Of machines that were not put next to a limit, where the best run must come in the end."""
    far = [case for case in cases if not case.trial.near]
    ladder, always = ([run for one in kind for run in one.runs] for kind in _both(far))
    assert sum(run.result.work for run in ladder) < 0.8 * sum(run.result.work for run in always)
    assert sum(run.rung.seconds for run in ladder) < 0.75 * sum(run.rung.seconds for run in always)
    assert sum(len(case.ladder.runs) == 1 for case in cases) > 0.2 * len(cases), "closed forms decide many machines"


def _both(cases: list[Case]) -> tuple[list[Settled], list[Settled]]:
    return [case.ladder for case in cases], [case.exact for case in cases]
