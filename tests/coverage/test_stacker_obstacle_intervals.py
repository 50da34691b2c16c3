"""Bars of a collision by energy, and of one without weights, against the column in modes with its weights."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from support.bars import (
    THIRD,
    WIDEST,
    Limit,
    Loads,
    Trial,
    claim_of,
    misses,
    near,
    numbers,
    opposites,
    tried,
    verdicts,
    wide,
)
from support.machines import changed, loaded
from support.stacker_masts import OVERHEAD

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.crane.stacking.collision.obstacle_energy import OBSTACLE_BOUND
from ptmcalc.machines.crane.stacking.mast.modal import COLLISION_MODAL

ON_TRIAL = {"crane": ("obstacle_contact", "mast_gravity", "obstacle_bound", "collision_modal")}
KIND = next(one for one in load_kind("crane").types if one.type == "overhead_stacker")
SEED, ALWAYS = 255, 40
WAYS = {
    "energy": (OBSTACLE_BOUND, OBSTACLE_BOUND.always, 0),
    "without weights": (COLLISION_MODAL, COLLISION_MODAL.always, 0),
    "coarse": (COLLISION_MODAL, COLLISION_MODAL.represents, 0),
}
LIMITS = (
    Limit("collision_force", ("checks", "column_force"), 1.0),
    Limit("contact_force", ("checks", "contact_force"), 1.0),
)


def random_collision(rng: np.random.Generator) -> dict[str, Any]:
    """A trolley whose column runs into a post, soft or hard, braked or driven or rolling."""
    stiff, length = 10 ** rng.uniform(4.5, 6.2), rng.uniform(3, 9)
    scene = {"type": "obstacle", "mechanism": "trolley", "speed_share": float(rng.uniform(0.2, 1))}
    scene |= ({"drive": "on"}, {"brake": "on"}, {"brake": "off"})[int(rng.integers(3))]
    return changed(
        OVERHEAD,
        load=f"{10 ** rng.uniform(2.3, 3.3)!r} kg",
        trolley__mass=f"{10 ** rng.uniform(3, 4)!r} kg",
        column={
            "length": f"{length!r} m",
            "mass": f"{10 ** rng.uniform(2.3, 3.3)!r} kg",
            "stiffness": f"{stiff!r} N/m",
        },
        obstacle={"stiffness": f"{stiff * 10 ** rng.uniform(-0.5, 2)!r} N/m"},
        scenes=[scene],
    )


def trial_of(index: int) -> Trial:
    rng = np.random.default_rng((SEED, index))
    spec = loaded(random_collision(rng)).spec
    assert spec is not None
    (scene,) = spec.all_scenes
    plan = plan_scene(KIND, spec, scene)
    claims: dict[str, Loads] = {name: claim_of(plan, spec, *way) for name, way in WAYS.items()}
    finer = COLLISION_MODAL if index % 5 == 0 else None
    truth = claim_of(plan, spec, finer, finer.represents, 1) if finer else claims["coarse"]
    cheap = {name: claims[name] for name in ("energy", "without weights")}
    return replace(tried(index, rng, KIND, spec, scene, cheap, truth, LIMITS), claims=claims)


@pytest.fixture(scope="module", params=numbers(ALWAYS))
def trials(request: pytest.FixtureRequest) -> list[Trial]:
    return [trial_of(index) for index in request.param]


@pytest.mark.parametrize("way", WAYS)
def test_every_bar_holds_the_column_in_modes(trials: list[Trial], way: str) -> None:
    assert misses(trials, way) == []


@pytest.mark.parametrize("way", ["energy", "without weights"])
def test_a_third_of_it_would_not_and_it_is_not_much_wider_than_the_error(trials: list[Trial], way: str) -> None:
    assert misses(trials, way, THIRD)
    assert 0 < wide(trials, way) <= WIDEST


def test_the_ladder_never_says_the_opposite(trials: list[Trial]) -> None:
    assert opposites(trials) == []
    assert near(trials) >= 0.45
    said = verdicts(trials, "CRN255", "CRN256")
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.1 * len(trials)


def test_of_a_contact_nothing_is_known_without_the_weights(trials: list[Trial]) -> None:
    """On fresh machines weights moved its largest force by three times what they change of the stiffness, twice."""
    assert not any(trial.claims["without weights"]["contact_force"].bounded for trial in trials)
