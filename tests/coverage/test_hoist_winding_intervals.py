"""Bars of one climb, with the bound of the layer's map, against the whole layer, on seeded hoists near their limit."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from support.bars import (
    MACHINES,
    THIRD,
    WIDEST,
    Limit,
    Trial,
    bounded,
    claim_of,
    misses,
    near,
    opposites,
    tried,
    verdicts,
    wide,
)
from support.machines import changed
from support.winding import PAPER, hoist

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.errors import NumericsError
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.hoist.winding.corrected import WINDING_CORRECTED
from ptmcalc.machines.hoist.winding.map import WINDING_MAP

ON_TRIAL = {"hoist": ("layer_map", "winding_corrected", "winding_map")}
KIND, SEED = load_kind("hoist"), 6_140
LIMITS = (Limit("winding_stress_ratio", ("checks", "winding_stress_ratio"), 1e-6),)


def random_hoist(rng: np.random.Generator) -> dict[str, Any]:
    """From slow cranes to fast one-fall hoists, hardly and well damped, anywhere on their way."""
    ropes = int(rng.integers(1, 3))
    falls, height = ropes * int(rng.integers(1, 5)), float(rng.uniform(20, 120))
    d = float(rng.uniform(0.008, 0.036))
    hook, drum = float(rng.uniform(0, 0.9)) * height, d * float(rng.uniform(16, 30))
    scene = {"type": "winding", "layer": int(rng.integers(2, 5)), "hook_height": f"{hook!r} m"}
    return changed(
        PAPER,
        load=f"{10 ** rng.uniform(2.5, 4.5)!r} kg",
        height=f"{height!r} m",
        least_fall=f"{rng.uniform(2, 20)!r} m",
        gravity=f"{rng.uniform(9.7, 9.9)!r} m/s^2",
        speed={"drum": f"{10 ** rng.uniform(-1, 1.2)!r} rad/s"},
        reeving__falls=falls,
        reeving__ropes=ropes,
        rope__diameter=f"{d!r} m",
        rope__area=f"{0.5 * math.pi / 4 * d * d!r} m^2",
        rope__damping=float(rng.choice([0.0, 0.005, 0.05, 0.3])),
        drum__diameter=f"{drum!r} m",
        drum__length=f"{d * rng.uniform(15, 60)!r} m",
        drum__pitch=f"{d * rng.uniform(1, 1.15)!r} m",
        drum__flange_height=f"{8 * d!r} m",
        winding={"packing": str(rng.choice(["nested", "square"])), "crossovers": int(rng.integers(1, 4))},
        winding__crossover=f"{rng.uniform(20, 100)!r} deg",
        scenes=[scene],
    )


def trial_of(index: int) -> Trial | None:
    """A climb on trial; None where the drum takes in all of the rope."""
    rng = np.random.default_rng((SEED, index))
    spec = hoist(random_hoist(rng))
    (scene,) = spec.all_scenes
    plan = plan_scene(KIND, spec, scene)
    try:
        truth = claim_of(plan, spec, WINDING_MAP, WINDING_MAP.represents)
    except NumericsError:
        return None
    claims = {"one climb": claim_of(plan, spec, WINDING_CORRECTED)}
    return replace(tried(index, rng, KIND, spec, scene, claims, truth, LIMITS), claims={**claims, "layer": truth})


@pytest.fixture(scope="module")
def trials() -> list[Trial]:
    return [trial for index in range(220) if (trial := trial_of(index)) is not None]


def test_one_climb_holds_the_whole_layer_and_a_third_of_its_bar_would_not(trials: list[Trial]) -> None:
    assert len(trials) >= MACHINES
    assert misses(trials, "one climb") == []
    assert {"winding_stress_max", "winding_displacement_max"} <= {
        miss.load for miss in misses(trials, "one climb", THIRD)
    }
    assert bounded(trials, "one climb", "winding_stress_max") > 0.9


def test_its_bar_is_not_much_wider_than_its_error(trials: list[Trial]) -> None:
    assert 0 < wide(trials, "one climb") <= WIDEST


def test_the_ladder_never_says_the_opposite(trials: list[Trial]) -> None:
    assert opposites(trials) == []
    assert near(trials) >= 0.45
    said = verdicts(trials, "HST140")
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.1 * len(trials)
