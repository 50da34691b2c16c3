"""Closed forms of a hoist against balances of every sheave, turns laid one by one, and power through the gear.

They claim no bar but rounding: what they say is what the reference finds, and no verdict of the ladder is another.
"""

import numpy as np
import pytest
from support.bars import Limit, Trial, claim, known_to, misses, near, numbers, opposites, tried, verdicts
from support.hoist_statics import Statics, random_hoist
from support.machines import loaded

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.hoist.drive.solver import HOLDING, STARTING
from ptmcalc.machines.hoist.statics.solver import HOIST_STATICS

WITHOUT_BARS = {"hoist": ("hoist_statics", "holding_brake", "starting_reserve")}
KIND = load_kind("hoist")
SEED, ALWAYS = 1911, 30
REFERENCE = 1e-10
WAYS = {"run": HOIST_STATICS, "start": STARTING, "lower_brake": HOLDING}
LIMITS = {
    "run": (
        Limit("rope_safety", ("checks", "rope_safety"), 0.01),
        Limit("drum_ratio", ("checks", "drum_ratio"), 0.01),
        Limit("hoop_stress", ("checks", "hoop_stress"), 1.0),
        Limit("starting_reserve", ("checks", "motor_reserve"), 0.01),
        Limit("brake_reserve_static", ("checks", "brake_reserve"), 0.01),
    ),
    "start": (Limit("starting_reserve", ("checks", "motor_reserve"), 0.01),),
    "lower_brake": (Limit("brake_reserve_static", ("checks", "brake_reserve"), 0.01),),
}
JUDGED = {
    "run": ("HST101", "HST102", "HST106", "HST111", "HST112", "HST114", "HST116", "HST118"),
    "start": ("HST114",),
    "lower_brake": ("HST118",),
}


def trials_of(index: int) -> dict[str, Trial]:
    rng = np.random.default_rng((SEED, index))
    data = random_hoist(rng)
    spec, reference, found = loaded(data).spec, Statics(data), {}
    assert spec is not None
    for scene, asked in zip(spec.all_scenes, data["scenes"], strict=True):
        truth = {name: known_to(REFERENCE, value) for name, value in getattr(reference, scene.type)(asked).items()}
        claims = {scene.type: claim(KIND, spec, scene, WAYS[scene.type])}
        found[scene.type] = tried(index, rng, KIND, spec, scene, claims, truth, LIMITS[scene.type])
    return found


@pytest.fixture(scope="module", params=numbers(ALWAYS))
def machines(request: pytest.FixtureRequest) -> list[dict[str, Trial]]:
    return [trials_of(index) for index in request.param]


@pytest.mark.parametrize("scene", WAYS)
def test_what_is_claimed_is_what_the_reference_finds(machines: list[dict[str, Trial]], scene: str) -> None:
    trials = [machine[scene] for machine in machines]
    assert misses(trials, scene) == []
    for trial in trials:
        assert trial.claims[scene].keys() == trial.truth.keys()


@pytest.mark.parametrize("scene", WAYS)
def test_no_verdict_is_another(machines: list[dict[str, Trial]], scene: str) -> None:
    trials = [machine[scene] for machine in machines]
    assert opposites(trials) == []
    assert near(trials) >= 0.45
    said = verdicts(trials, *JUDGED[scene])
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.05 * len(said)
