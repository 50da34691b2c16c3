"""Actions on the runway against balances of their own: what is claimed is what they find, and no verdict is another."""

import numpy as np
import pytest
from support.bars import Trial, claim, misses, numbers, opposites, tried, verdicts
from support.machines import loaded
from support.runway_balances import Balances, random_runway

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.crane.travelling.runway.runway_actions import RUNWAY_ACTIONS

WITHOUT_BARS = {"crane": ("runway_actions",)}
KIND = next(one for one in load_kind("crane").types if one.type == "travelling")
SEED, ALWAYS = 20061, 80
KNOWN = 1e-9
"""What the reference is good for, as a share: of forces, which are differences of larger ones, of the wheel load."""
NUMBERS = ("runway_skew_angle", "runway_skew_share")


def trial_of(index: int) -> Trial:
    rng = np.random.default_rng((SEED, index))
    data = random_runway(rng)
    spec, found = loaded(data).spec, Balances(data).runway()
    assert spec is not None
    (scene,) = spec.all_scenes
    size = found["runway_wheel_max[1]"]
    truth = {
        name: Estimate.within(value, KNOWN * (abs(value) if name in NUMBERS else max(abs(value), size)))
        for name, value in found.items()
    }
    claims = {"runway": claim(KIND, spec, scene, RUNWAY_ACTIONS)}
    return tried(index, rng, KIND, spec, scene, claims, truth)


@pytest.fixture(scope="module", params=numbers(ALWAYS))
def machines(request: pytest.FixtureRequest) -> list[Trial]:
    return [trial_of(index) for index in request.param]


def test_what_is_claimed_is_what_the_reference_finds(machines: list[Trial]) -> None:
    assert misses(machines, "runway") == []
    for trial in machines:
        assert trial.claims["runway"].keys() == trial.truth.keys()


def test_no_verdict_is_another(machines: list[Trial]) -> None:
    assert opposites(machines) == []
    for code in ("CRN176", "CRN177"):
        said = verdicts(machines, code)
        assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.05 * len(said), code
