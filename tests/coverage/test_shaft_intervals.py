"""Error bars are claims: those of the closed forms, of the tables and of the exact motions of a shaft hold the truth.

Truth is an integration of its own. Every other machine has a limit within three bars of a claim; no verdict is the
opposite of the truth.
"""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from support.bars import THIRD, Limit, Trial, claim_of, misses, near, opposites, tried, verdicts, wide, widest
from support.machines import changed
from support.shaft_samples import Truth, gentle_shaft, lively_shaft, text
from support.shafts import spec_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.engine.run import settle

ON_TRIAL = {
    "shaft": (
        "speed_quadrature",
        "work_balance",
        "energy_step",
        "stop_formula",
        "closed_mean_cycle",
        "closed_cycle",
        "mean_tachogram_up",
        "tachogram_up",
        "mean_tachogram_out",
        "tachogram_out",
        "varying_inertia",
        "motor_slope",
    )
}
KIND = load_kind("shaft")
SORTS: dict[str, Callable[[np.random.Generator], dict[str, Any]]] = {"gentle": gentle_shaft, "lively": lively_shaft}
TOP = {"run_up": "tachogram_up", "steady": "closed_cycle", "run_out": "tachogram_out"}
WAYS = {
    "run_up": ("speed_quadrature", "mean_tachogram_up"),
    "steady": ("work_balance", "energy_step", "energy_step 1", "energy_step 2", "closed_mean_cycle"),
    "run_out": ("stop_formula", "mean_tachogram_out"),
}
GOVERNING = {
    "run_up": ("run_up_time", "run_up_angle"),
    "steady": ("irregularity", "speed_mean", "speed_min", "speed_max", "torque_motor_rms", "torque_motor_max",
               "cycle_efficiency", "loss_factor", "work_drive", "work_loss", "work_useful"),
    "run_out": ("run_out_time", "run_out_angle", "speed_run_out"),
}  # fmt: skip
LIMITS = (
    Limit("irregularity", ("checks", "irregularity"), least=1e-9),
    Limit("run_up_time", ("checks", "run_up_time"), least=1e-9),
    Limit("run_out_angle", ("checks", "stop_angle"), least=1e-9),
    Limit("run_out_time", ("checks", "stop_time"), least=1e-9),
)
REFERENCE = 3e-9
"""What the independent integration is good for, relative."""
SEED = 20261124
Scenes = dict[str, list[Trial]]
SAMPLES = [
    pytest.param(("gentle", 5), id="gentle-some"),
    pytest.param(("lively", 5), id="lively-some"),
    *(pytest.param((sort, 100), id=f"{sort}-all", marks=pytest.mark.study) for sort in SORTS),
]


def machine_of(sort: str, number: int) -> tuple[dict[str, Any], Truth]:
    """A machine whose motor drives it, and the truth about it."""
    rng = np.random.default_rng((SEED, list(SORTS).index(sort), number))
    while True:
        data = SORTS[sort](rng)
        truth = Truth(data)
        if truth.of("steady"):
            return data, truth


def _known(truth: Truth, scene: str) -> dict[str, Estimate]:
    found = truth.of(scene)
    names = set(GOVERNING[scene]) & set(found)
    if not truth.works_on_the_stable_branch():
        names -= {"torque_motor_max"}
    return {
        name: Estimate.within(found[name], REFERENCE * abs(found[name]) + 1e-12)
        if math.isfinite(found[name])
        else Estimate.exact(found[name])
        for name in names
    }


def trials_of(sort: str, number: int) -> dict[str, Trial]:
    data, truth = machine_of(sort, number)
    spec, rng, found = spec_of(data), np.random.default_rng((SEED, 7, number)), {}
    for scene in spec.all_scenes:
        plan, claims = plan_scene(KIND, spec, scene), {}
        for rung in plan.rungs:
            name = rung.solver.name if rung.level == 0 else f"{rung.solver.name} {rung.level}"
            try:
                claims[name] = claim_of(plan, spec, rung.solver, rung.carried, rung.level)
            except NumericsError:
                continue
        found[scene.label] = tried(number, rng, KIND, spec, scene, claims, _known(truth, scene.label), LIMITS)
    return found


@pytest.fixture(scope="module", params=SAMPLES)
def sample(request: pytest.FixtureRequest) -> Scenes:
    sort, count = request.param
    machines = [trials_of(sort, number) for number in range(count)]
    return {scene: [machine[scene] for machine in machines if scene in machine] for scene in TOP}


@pytest.mark.parametrize("scene", TOP)
def test_the_exact_motions_agree_with_an_independent_integration(sample: Scenes, scene: str) -> None:
    assert misses(sample[scene], TOP[scene]) == []
    for trial in sample[scene]:
        known = trial.claims[TOP[scene]]
        finite = [known[load] for load in GOVERNING[scene] if load in known and math.isfinite(known[load].value)]
        assert all(one.bounded and one.bar <= 1e-7 * abs(one.value) for one in finite)


@pytest.mark.parametrize(("scene", "way"), [(scene, way) for scene, ways in WAYS.items() for way in ways])
def test_a_bar_holds_the_truth_on_every_machine(sample: Scenes, scene: str, way: str) -> None:
    assert misses(sample[scene], way) == []


@pytest.mark.parametrize(("scene", "way"), [(scene, way) for scene, ways in WAYS.items() for way in ways])
def test_it_is_not_much_wider_than_the_true_error(sample: Scenes, scene: str, way: str) -> None:
    assert wide(sample[scene], way) <= widest(way)


def test_a_third_of_it_would_not(sample: Scenes) -> None:
    missed = [scene for scene in TOP if any(misses(sample[scene], way, THIRD) for way in WAYS[scene])]
    assert missed != []


def test_no_verdict_is_the_opposite_of_the_truth(sample: Scenes) -> None:
    trials = [trial for scene in sample.values() for trial in scene]
    assert opposites(trials) == []
    assert near(trials) >= 0.45
    codes = ("SHF102", "SHF103", "SHF104", "SHF105", "SHF106", "SHF107")
    said = [
        ruling.verdict
        for trial in trials
        for ruling in trial.said
        if ruling.check.code in codes and ruling.limit is not None and math.isfinite(ruling.limit.value)
    ]
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.1 * len(said)
    assert said.count(Verdict.UNDECIDED) == 0
    assert set(verdicts(sample["steady"], "SHF101")) == {Verdict.PASS}, "there is a cycle"


def test_the_brake_that_is_needed_is_the_one_that_stops_in_time() -> None:
    """The interval of the torque for a wanted angle holds the root of the independent runs."""
    for number, sort in ((3, "gentle"), (6, "lively")):
        plain, truth = machine_of(sort, number)
        wanted = 0.8 * truth.of("run_out")["run_out_angle"]
        data = changed(plain, checks={"stop_angle": text(wanted, "rad")}, accuracy="0.01 %")
        spec = spec_of(data)
        (scene,) = [one for one in spec.all_scenes if one.label == "run_out"]
        needed = settle(KIND, spec, plan_scene(KIND, spec, scene)).estimates["brake_torque_needed"]
        assert needed.bounded
        assert needed.value > 0
        exact = truth.brake_for(wanted)
        assert needed.low * (1 - 1e-7) <= exact <= needed.high * (1 + 1e-7), number


def test_the_flywheel_that_is_needed_makes_it_as_even_as_wanted() -> None:
    data = gentle_shaft(np.random.default_rng(SEED + 9))
    truth = Truth(data)
    wanted = 0.6 * truth.of("steady")["irregularity"]
    spec = spec_of(changed(data, checks={"irregularity": wanted}, accuracy="0.01 %"))
    (scene,) = [one for one in spec.all_scenes if one.label == "steady"]
    needed = settle(KIND, spec, plan_scene(KIND, spec, scene)).estimates["flywheel_inertia"]
    assert needed.bounded
    exact = truth.reference.flywheel(wanted)
    assert exact > 0
    assert needed.low * (1 - 1e-7) <= exact <= needed.high * (1 + 1e-7)
