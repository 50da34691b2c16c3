"""Closed forms of stacker cranes against balances of the carriage, beams, weights, and the motion on the buffers.

They claim no bar but rounding: what they say is what the reference finds, and no verdict of the ladder is another. The
carriage has one where its file does not say how the rollers of both planes are put together: it holds both ways.
"""

import math

import numpy as np
import pytest
from support.bars import (
    MACHINES,
    THIRD,
    Limit,
    Trial,
    claim,
    known_to,
    misses,
    near,
    numbers,
    opposites,
    tried,
    verdicts,
    wide,
    widest,
)
from support.machines import loaded
from support.stacker_statics import Statics, random_stacker

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.solver import AnySolver
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.crane.stacking.collision.buffer_stop import BUFFER_STOP
from ptmcalc.machines.crane.stacking.mechanisms.carriage_statics import CARRIAGE_STATICS
from ptmcalc.machines.crane.stacking.safety_gear.catch import GEAR_CATCH
from ptmcalc.machines.crane.stacking.strength.weights import WEIGHTS

ON_TRIAL = {"crane": ("carriage_statics",)}
WITHOUT_BARS = {"crane": ("weights", "buffer_stop", "safety_gear_catch", "safety_gear")}
KINDS = {one.type: one for one in load_kind("crane").types}
SEED = 1917
WAYS: dict[str, AnySolver] = {
    "hoist_up": CARRIAGE_STATICS,
    "hoist_down": CARRIAGE_STATICS,
    "stand": WEIGHTS,
    "buffer": BUFFER_STOP,
    "safety_gear": GEAR_CATCH,
}
KNOWN = {"hoist_up": 1e-10, "hoist_down": 1e-10, "stand": 1e-10, "buffer": 1e-7, "safety_gear": 1e-7}
"""What the reference is good for, as a share."""
_HOIST = (
    Limit("roller_load", ("carriage", "rollers", "rating"), 1.0),
    Limit("rope_safety", ("checks", "rope_safety"), 0.01),
)
LIMITS = {
    "hoist_up": _HOIST,
    "hoist_down": (*_HOIST, Limit("jamming", ("checks", "self_jamming"), 0.001, 1.0)),
    "stand": (
        Limit("stability_reserve", ("checks", "stability"), 0.01),
        Limit("column_stress", ("checks", "column_stress"), 1.0),
        Limit("bridge_stress", ("checks", "bridge_stress"), 1.0),
    ),
    "buffer": (Limit("buffer_force", ("travel", "buffers", "rating"), 1.0),),
    "safety_gear": (
        Limit("safety_gear_deceleration", ("checks", "catch_deceleration"), 0.1),
        Limit("column_stress", ("checks", "column_stress"), 1.0),
    ),
}
JUDGED = {
    "hoist_up": ("CRN201", "CRN203", "CRN206"),
    "hoist_down": ("CRN201", "CRN202", "CRN203"),
    "stand": ("CRN207", "CRN208", "CRN209", "CRN210"),
    "buffer": ("CRN281", "CRN282"),
    "safety_gear": ("CRN209", "CRN290", "CRN291", "CRN292"),
}


def trials_of(index: int) -> dict[str, Trial]:
    """Both kinds in turn, every second pair of them with joint rollers where the file does not say."""
    rng = np.random.default_rng((SEED, index))
    kind = KINDS["rack_stacker" if index % 3 else "overhead_stacker"]
    data, found = random_stacker(rng, str(kind.type)), {}
    reference, spec = Statics(data, joint=bool(rng.random() < 0.5)), loaded(data).spec
    assert spec is not None
    for scene, asked in zip(spec.all_scenes, data["scenes"], strict=True):
        name = "_".join([asked["type"], *([asked["direction"]] if "direction" in asked else [])])
        truth = {load: known_to(KNOWN[name], value) for load, value in getattr(reference, asked["type"])(asked).items()}
        claims = {name: claim(kind, spec, scene, WAYS[name], WAYS[name].always)}
        found[name] = tried(index, rng, kind, spec, scene, claims, truth, LIMITS[name])
    return found


@pytest.fixture(scope="module", params=numbers(MACHINES))
def machines(request: pytest.FixtureRequest) -> list[dict[str, Trial]]:
    return [trials_of(index) for index in request.param]


def of(machines: list[dict[str, Trial]], scene: str) -> list[Trial]:
    return [machine[scene] for machine in machines if scene in machine]


@pytest.mark.parametrize("scene", WAYS)
def test_what_is_claimed_holds_what_the_reference_finds(machines: list[dict[str, Trial]], scene: str) -> None:
    trials = of(machines, scene)
    assert misses(trials, scene) == []
    for trial in trials:
        assert trial.claims[scene].keys() == trial.truth.keys()
        if not scene.startswith("hoist"):
            ends = [(one.low, one.high) for load, one in trial.claims[scene].items() if math.isfinite(one.high)]
            assert all(high - low <= 1e-12 * abs(high) for low, high in ends)


@pytest.mark.parametrize("scene", ["hoist_up", "hoist_down"])
def test_the_bar_of_unsaid_rollers_is_needed(machines: list[dict[str, Trial]], scene: str) -> None:
    assert misses(of(machines, scene), scene, THIRD) != []
    assert wide(of(machines, scene), scene) <= widest(scene)


@pytest.mark.parametrize("scene", WAYS)
def test_no_verdict_is_another(machines: list[dict[str, Trial]], scene: str) -> None:
    trials = of(machines, scene)
    assert opposites(trials) == []
    assert near(trials) >= 0.4
    said = verdicts(trials, *JUDGED[scene])
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.05 * len(said)
