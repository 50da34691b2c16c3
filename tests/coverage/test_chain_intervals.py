"""Error bars of steady running are claims: every cheaper run, and every effect left out alone, holds what the richest
finds, and that what finite elements in time find. Half of the machines stand within three bars of a limit."""

from collections.abc import Iterable
from typing import Any

import numpy as np
import pytest
from support.bars import THIRD, WIDEST, Limit, Trial, claim_of, misses, near, numbers, opposites, tried, verdicts, wide
from support.chain_samples import usual_chain
from support.chains import Reference, chain_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.engine.plan import ScenePlan, plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive

ON_TRIAL = {
    "chain_drive": (
        "chain_statics",
        "chain_modes",
        "polygon_bound",
        "distributed_strand",
        "polygon",
        "far_polygon",
        "weak_drive",
    )
}
KIND = load_kind("chain_drive")
SOLVERS = {solver.name: solver for solver in KIND.solvers}
SEED = 20260711
RICH = ("distributed_strand", "chain_modes")
BOUNDS = ("tension_polygon_bound",)
"""What is no load but a bound of one."""
EFFECTS = ("polygon", "far_polygon", "weak_drive")
WAYS = (
    "chain_statics",
    "chain_modes",
    "polygon_bound",
    "distributed_strand",
    "without far_polygon",
    "without weak_drive",
)
LIMITS = (
    Limit("safety_dynamic", ("checks", "safety_dynamic"), least=1e-6),
    Limit("tension_min", ("checks", "least_tension")),
)


def called_for(spec: ChainDrive) -> tuple[ScenePlan, set[str]]:
    """The plan of the one scene of a drive, and the effects that are to be had in it."""
    (scene,) = spec.all_scenes
    plan = plan_scene(KIND, spec, scene)
    return plan, {one.effect.name for one in plan.effects if not one.excluded}


def trial_of(number: int, data: dict[str, Any] | None = None) -> Trial:
    rng = np.random.default_rng((SEED, number))
    spec = chain_of(data or usual_chain(rng))
    plan, here = called_for(spec)
    scene = plan.scene

    def claim(name: str, level: int = 0, without: Iterable[str] = ()) -> dict[str, Estimate]:
        solver = SOLVERS[name]
        found = claim_of(plan, spec, solver, (here & solver.represents) - set(without), level)
        return {load: one for load, one in found.items() if load not in BOUNDS}

    claims = {name: claim(name) for name in WAYS if name in SOLVERS}
    for name in here & {"far_polygon", "weak_drive"}:
        claims[f"without {name}"] = claim("distributed_strand", 1, [name])
    truth = claim("distributed_strand", 1) | {
        name: one for name, one in claim("chain_modes").items() if name not in claims["distributed_strand"]
    }
    return tried(number, rng, KIND, spec, scene, claims, truth, LIMITS)


@pytest.fixture(scope="module", params=numbers(30))
def trials(request: pytest.FixtureRequest) -> list[Trial]:
    return [trial_of(number) for number in request.param]


@pytest.mark.parametrize("way", WAYS)
def test_every_interval_holds_the_richest_run(trials: list[Trial], way: str) -> None:
    assert misses(trials, way) == []


@pytest.mark.parametrize("way", ["chain_statics", "polygon_bound", "without far_polygon", "without weak_drive"])
def test_a_third_of_the_bars_would_not(trials: list[Trial], way: str) -> None:
    assert misses(trials, way, THIRD) != []


@pytest.mark.parametrize("way", WAYS)
def test_they_are_not_much_wider_than_the_true_error(trials: list[Trial], way: str) -> None:
    assert wide(trials, way) <= WIDEST


def test_no_verdict_is_the_opposite_of_the_richest(trials: list[Trial]) -> None:
    assert opposites(trials) == []
    assert near(trials) >= 0.45
    said = verdicts(trials, "CHN102", "CHN105")
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.1 * len(trials)
    assert said.count(Verdict.UNDECIDED) < 0.1 * len(said)


def test_the_bound_is_never_exceeded(trials: list[Trial]) -> None:
    solver = SOLVERS["polygon_bound"]
    for trial in trials:
        assert isinstance(trial.spec, ChainDrive)
        plan, here = called_for(trial.spec)
        bound = claim_of(plan, trial.spec, solver, here & solver.represents)["tension_polygon_bound"].value
        for name in ("tension_dynamic_polygon", "tension_dynamic_polygon_min", "tension_dynamic_polygon_far"):
            assert abs(trial.truth[name].value) <= bound * (1 + 1e-9)


def test_the_richest_run_holds_finite_elements_in_time() -> None:
    """Conveyors with a constant tension at the run-off, Kelvin-Voigt damping, and a drive of no given inertia."""
    rng, compared = np.random.default_rng(SEED), 0
    while compared < 5:
        data = usual_chain(rng)
        layout, chain = data["layout"], data["chain"]
        if layout["type"] != "conveyor" or layout["tail"].get("driven") == "on":
            continue
        if layout["takeup"]["type"] != "gravity" or "mass" in layout["takeup"]:
            continue
        data.pop("drive", None)
        chain["damping"] = {"ratio": float(rng.uniform(0.02, 0.1))}
        truth = trial_of(2 * compared + 1, data).truth
        force = Reference(data, 100).force
        swing = max(force.max(), -force.min())
        for name, expected in (
            ("tension_dynamic_polygon", force.max()),
            ("tension_dynamic_polygon_min", force.min()),
        ):
            claim = truth[name]
            assert claim.low - 3e-3 * swing <= expected <= claim.high + 3e-3 * swing, (name, data)
            assert claim.bar < 0.02 * swing
        compared += 1
