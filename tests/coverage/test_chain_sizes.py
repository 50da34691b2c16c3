"""Closed forms of the choice of a chain against lengths, levers and wear of their own.

They claim no bar but rounding: what they say is what the reference finds, and no verdict is another.
"""

import math

import numpy as np
import pytest
from support.bars import MACHINES, Limit, Trial, claim, misses, near, numbers, opposites, tried, verdicts
from support.chain_sizes import Sizes, random_sizes
from support.machines import loaded

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.chain_drive.selection.solver import CHAIN_SELECTION

WITHOUT_BARS = {"chain_drive": ("chain_selection",)}
KIND = load_kind("chain_drive")
WAY = CHAIN_SELECTION.name
SEED, REFERENCE = 1919, 1e-9
CLIMBED = 20
"""Every so many a chain is run over its teeth as well, whose loads are not on trial here."""
LIMITS = (
    Limit("safety_static", ("checks", "safety_static"), 0.01),
    Limit("life", ("checks", "life"), 1.0),
    Limit("wrap", ("checks", "wrap"), 0.1, 6.0),
    Limit("ratio", ("checks", "ratio"), 0.1),
    Limit("design_power", ("layout", "rated_power"), 1.0),
)
JUDGED = ("CHN103", "CHN106", "CHN108", "CHN109", "CHN110", "CHN111", "CHN112", "CHN113")


def trial_of(index: int) -> Trial:
    rng = np.random.default_rng((SEED, index))
    data = random_sizes(rng)
    spec = loaded(data).spec
    assert spec is not None
    (scene,) = spec.all_scenes
    truth = {
        name: Estimate.exact(value) if math.isinf(value) else Estimate.within(value, REFERENCE * abs(value))
        for name, value in Sizes(data).run().items()
    }
    claims = {WAY: claim(KIND, spec, scene, CHAIN_SELECTION)}
    return tried(index, rng, KIND, spec, scene, claims, truth, LIMITS, climbs=index % CLIMBED == 0)


@pytest.fixture(scope="module", params=numbers(MACHINES))
def trials(request: pytest.FixtureRequest) -> list[Trial]:
    return [trial_of(index) for index in request.param]


def test_what_is_claimed_is_what_the_reference_finds(trials: list[Trial]) -> None:
    assert misses(trials, WAY) == []
    assert all(trial.claims[WAY].keys() == trial.truth.keys() for trial in trials)


def test_no_verdict_is_another(trials: list[Trial]) -> None:
    assert opposites(trials) == []
    assert near(trials) >= 0.45
    said = verdicts(trials, *JUDGED)
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.05 * len(said)
