"""Error bars of steady running are claims: every cheaper run holds what the richest finds, and that what finite
elements in time find."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from support.chain_samples import usual_chain
from support.chains import Witness, chain_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.engine.run import settle, widen

KIND = load_kind("chain_drive")
SEED = 20260711
RICH = ("distributed_strand", "chain_modes")
BOUNDS = {"tension_polygon_bound"}
"""What is no load but a bound of one."""
SAMPLES = [
    pytest.param((10, SEED), id="few"),
    *(pytest.param((120, SEED + k), id=f"many-{k}", marks=pytest.mark.study) for k in (1, 2)),
]
Loads = dict[str, Estimate]


@dataclass(frozen=True)
class Case:
    """A machine: what each run claims, and the claims of the richest."""

    data: dict[str, Any]
    claims: dict[str, Loads]
    truth: Loads


def case_of(data: dict[str, Any]) -> Case:
    spec = chain_of(data)
    scene = plan_scene(KIND, spec, spec.all_scenes[0])
    claims, truth, most = {}, {}, {}
    for rung in scene.rungs:
        result = rung.solver.run(spec, spec.all_scenes[0], rung.carried, rung.level)
        found = widen(scene, spec, rung, result)
        claims[f"{rung.solver.name} {sorted(rung.carried)} {rung.level}"] = found
        rank = (len(rung.carried), rung.level)
        if rung.solver.name in RICH and rank >= most.get(rung.solver.name, (0, 0)):
            most[rung.solver.name] = rank
            truth |= found
    return Case(data, claims, truth)


@pytest.fixture(scope="module", params=SAMPLES)
def sample(request: pytest.FixtureRequest) -> list[Case]:
    count, seed = request.param
    rng = np.random.default_rng(seed)
    return [case_of(usual_chain(rng)) for _ in range(count)]


def misses(cases: list[Case], share: float = 1.0) -> tuple[int, list[str]]:
    """(claims compared, those that a share of their bar would not hold)."""
    seen, missed = 0, []
    for index, case in enumerate(cases):
        for run, loads in case.claims.items():
            for name in (loads.keys() & case.truth.keys()) - BOUNDS:
                claim, truth = loads[name], case.truth[name]
                if not claim.bounded or not truth.bounded or claim.bar <= 1.01 * truth.bar:
                    continue
                seen += 1
                low, high = (claim.value + share * (end - claim.value) for end in (claim.low, claim.high))
                slack = truth.bar + 1e-9 * abs(truth.value)
                if not low - slack <= truth.value <= high + slack:
                    missed.append(f"{index} {run} {name}: {truth.value} not in [{low}, {high}]")
    return seen, missed


def test_every_interval_holds_the_richest_run(sample: list[Case]) -> None:
    seen, missed = misses(sample)
    assert missed == []
    assert seen > 10 * len(sample)


def test_a_third_of_the_bars_would_not(sample: list[Case]) -> None:
    assert misses(sample, 1 / 3)[1] != []


def test_the_bound_is_never_exceeded(sample: list[Case]) -> None:
    for case in sample:
        bound = case.truth["tension_polygon_bound"].value
        for name in ("tension_dynamic_polygon", "tension_dynamic_polygon_min", "tension_dynamic_polygon_far"):
            assert abs(case.truth[name].value) <= bound * (1 + 1e-9)


def test_no_verdict_is_the_opposite_of_the_richest(sample: list[Case]) -> None:
    """The strength is put within the bars of a cheap run, where they matter."""
    rng = np.random.default_rng(SEED)
    decided = 0
    for case in sample:
        cheap = next(loads for run, loads in case.claims.items() if run.startswith("chain_statics"))["tension_design"]
        tension = rng.uniform(cheap.low, cheap.high) if cheap.bounded else cheap.value
        limit = 7.0 if case.data["layout"]["type"] == "conveyor" else 5.0
        case.data["chain"]["breaking_load"] = f"{max(tension, 1.0) * limit!r} N"
        spec = chain_of(case.data)
        settled = settle(KIND, spec, plan_scene(KIND, spec, spec.all_scenes[0]))
        ruling = next(one for one in settled.rulings if one.check.code == "CHN102")
        sound = case.truth["tension_design"].value <= max(tension, 1.0)
        assert ruling.verdict in ((Verdict.PASS if sound else Verdict.FAIL), Verdict.UNDECIDED)
        decided += ruling.verdict is not Verdict.UNDECIDED
    assert decided >= 0.9 * len(sample)


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
        truth = case_of(data).truth
        force = Witness(data, 100).force
        swing = max(force.max(), -force.min())
        for name, expected in (
            ("tension_dynamic_polygon", force.max()),
            ("tension_dynamic_polygon_min", force.min()),
        ):
            claim = truth[name]
            assert claim.low - 3e-3 * swing <= expected <= claim.high + 3e-3 * swing, (name, data)
            assert claim.bar < 0.02 * swing
        compared += 1
