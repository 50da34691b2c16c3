"""Emergency stops of hoists: bars of the rigid train against the load on its elastic rope, integrated in time."""

from typing import Any

import numpy as np
import pytest
from support.bars import Limit, Trial, claim, known_to, misses, near, numbers, opposites, tried, verdicts, wide, widest
from support.hoist_stops import Stops, random_stop
from support.machines import loaded
from support.travelling_statics import number, text

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.hoist.braking.solver import EMERGENCY

ON_TRIAL = {"hoist": ("emergency_stop",)}
KIND = load_kind("hoist")
SEED, MACHINES = 2811, 64
REFERENCE = 2e-6
WAY = "emergency_stop"
LIMITS = (
    Limit("brake_heat", ("brake", "stop_heat"), 1.0),
    Limit("emergency_descent", ("checks", "stop_distance"), 1e-3),
)


def machine(rng: np.random.Generator) -> dict[str, Any]:
    """A hoist whose brake holds, with a heavy rotor in most files: a rope that goes slack has no bar."""
    data = random_stop(rng)
    data["motor"]["inertia"] = text(number(data["motor"]["inertia"]) * rng.uniform(1, 8), "kg*m^2")
    data["brake"]["torque"] = text(number(data["brake"]["torque"]) * rng.uniform(1, 2), "N*m")
    data["scenes"][0]["hook_height"] = text(number(data["height"]) * rng.uniform(0.1, 0.9), "m")
    data["brake"]["stop_heat"] = text(number(data["brake"]["stop_heat"]) * np.exp(rng.uniform(0, 5)), "J")
    data["brake"]["stops_per_service"] *= float(rng.uniform(0.05, 1))
    data["checks"]["stop_distance"] = text(np.exp(rng.uniform(-4, 1)), "m")
    return data


def trial_of(index: int) -> Trial:
    rng = np.random.default_rng((SEED, index))
    data = machine(rng)
    spec, scene = loaded(data).spec, data["scenes"][0]
    assert spec is not None
    stops = Stops(data)
    height = number(scene["hook_height"])
    found = stops.at(scene, height)
    if np.isfinite(found["brake_heat"]):
        found = stops.elastic(scene, height)
    truth = {name: known_to(REFERENCE, value) for name, value in stops.of_the_disc(found).items()}
    claims = {WAY: claim(KIND, spec, spec.all_scenes[0], EMERGENCY)}
    return tried(index, rng, KIND, spec, spec.all_scenes[0], claims, truth, LIMITS)


@pytest.fixture(scope="module", params=numbers(16, MACHINES))
def machines(request: pytest.FixtureRequest) -> list[Trial]:
    return [trial_of(index) for index in request.param]


def test_no_bar_misses_the_oscillating_load(machines: list[Trial]) -> None:
    assert misses(machines, WAY) == []
    for trial in machines:
        assert trial.claims[WAY].keys() == trial.truth.keys()


def test_bars_are_worth_their_width(machines: list[Trial]) -> None:
    """A third of one does not suffice, and most machines have one."""
    assert misses(machines, WAY, 1 / 3) != []
    assert wide(machines, WAY) < widest(WAY)
    finite = [trial.claims[WAY]["brake_heat"] for trial in machines]
    assert np.mean([one.bounded or np.isinf(one.value) for one in finite]) >= 0.6


def test_no_verdict_is_another(machines: list[Trial]) -> None:
    assert opposites(machines) == []
    assert near(machines) >= 0.25
    for code in ("HST128", "HST129", "HST130", "HST131"):
        said = verdicts(machines, code)
        assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.03 * len(said)
