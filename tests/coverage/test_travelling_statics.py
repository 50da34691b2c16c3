"""Closed forms of a travelling crane against balances of their own and the motion of a crane on its buffers.

They claim no bar but rounding: what they say is what the reference finds, and no verdict of the ladder is another.
"""

import numpy as np
import pytest
from support.bars import Limit, Trial, claim, known_to, misses, near, numbers, opposites, tried, verdicts
from support.machines import loaded
from support.travelling_statics import Statics, random_crane

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.solver import AnySolver
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.crane.travelling.buffers.buffer_collision import BUFFER_COLLISION
from ptmcalc.machines.crane.travelling.rail.rail_response import RAIL_RESPONSE
from ptmcalc.machines.crane.travelling.skewing.skewing import SKEWING
from ptmcalc.machines.crane.travelling.statics.travel_statics import STARTING, TRAVEL_STATICS
from ptmcalc.machines.crane.travelling.storm.storm_parking import STORM_PARKING

WITHOUT_BARS = {
    "crane": (
        "travel_statics",
        "travel_starting_reserve",
        "storm_parking",
        "skewing",
        "buffer_collision",
        "rail_response",
        "rail_unevenness",
    ),
}
KIND = next(one for one in load_kind("crane").types if one.type == "travelling")
SEED, ALWAYS = 1909, 40
WAYS: dict[str, AnySolver] = {
    "run": TRAVEL_STATICS,
    "start": STARTING,
    "storm": STORM_PARKING,
    "skew": SKEWING,
    "collision": BUFFER_COLLISION,
    "rail_step": RAIL_RESPONSE,
}
KNOWN = {"run": 1e-9, "start": 1e-9, "storm": 1e-9, "skew": 1e-8, "collision": 2e-4, "rail_step": 1e-9}
"""What the reference is good for, as a share; a root that is searched for, and a motion that is followed, to less."""
COARSE = {"wheel_spectrum_factor": 1e-8, "skew_force_slip": 1e-7}
"""A mean over many places; a balance that is met to 1e-9 of the weight."""
LIMITS = {
    "run": (
        Limit("starting_reserve", ("checks", "motor_reserve"), 0.01),
        Limit("wheel_load_max", ("wheels", "rating"), 1.0),
    ),
    "start": (Limit("starting_reserve", ("checks", "motor_reserve"), 0.01),),
    "storm": (
        Limit("storm_reserve", ("checks", "wind_reserve"), 0.01),
        Limit("wheel_load_max", ("wheels", "rating"), 1.0),
    ),
    "skew": (Limit("skew_force", ("guide", "rating"), 1.0),),
    "collision": (
        Limit("collision_speed", ("checks", "collision_speed"), 0.01),
        Limit("buffer_force", ("buffers", "rating"), 1.0),
    ),
    "rail_step": (Limit("phi4", ("declared", "phi4"), 0.1, 9.0),),
}
JUDGED = {
    "run": ("CRN157", "CRN160", "CRN161", "CRN162", "CRN163", "CRN164"),
    "start": ("CRN160",),
    "storm": ("CRN157", "CRN175"),
    "skew": ("CRN174",),
    "collision": ("CRN170", "CRN171", "CRN172"),
    "rail_step": ("CRN173", "CRN183"),
}


def trials_of(index: int) -> dict[str, Trial]:
    rng = np.random.default_rng((SEED, index))
    data = random_crane(rng)
    spec, reference, found = loaded(data).spec, Statics(data), {}
    assert spec is not None
    for scene, asked in zip(spec.all_scenes, data["scenes"], strict=True):
        known = KNOWN[scene.type]
        truth = {
            name: known_to(max(known, COARSE.get(name, 0.0)), value)
            for name, value in getattr(reference, scene.type)(asked).items()
        }
        claims = {scene.type: claim(KIND, spec, scene, WAYS[scene.type], WAYS[scene.type].always)}
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
        assert trial.claims[scene].keys() >= trial.truth.keys()
        assert trial.judged & trial.claims[scene].keys() <= trial.truth.keys() | {
            "skid_reserve_min",
            "stability_reserve",
        }


@pytest.mark.parametrize("scene", WAYS)
def test_no_verdict_is_another(machines: list[dict[str, Trial]], scene: str) -> None:
    trials = [machine[scene] for machine in machines]
    assert opposites(trials) == []
    assert near(trials) >= 0.45
    said = verdicts(trials, *JUDGED[scene])
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.05 * len(said)
