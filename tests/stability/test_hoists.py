"""Hoists at the edge of what a file may say: no traceback, no number that is none, none outside its bar."""

import math
import warnings

import numpy as np
import pytest
import yaml
from support.hoist_samples import absurd_hoist
from support.hoists import CRANE, PAPER, hoist_scene, value
from support.machines import changed
from support.turns import first_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text

SEED = 2718


@pytest.mark.parametrize("seed", first_of(6, range(16)))
def test_absurd_sizes_through_a_whole_check(seed: int) -> None:
    data = absurd_hoist(np.random.default_rng([SEED, seed]))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        report = check(load_text(yaml.safe_dump(data).encode(), "case.yaml"), Options())
    assert [(d.path, d.message) for d in report.diagnostics if d.severity == "error"] == []
    for scene in report.scenes:
        for load in scene.loads:
            one = load.estimate
            assert not any(math.isnan(part) for part in (one.value, one.low, one.high)), load.info.name
            assert one.low <= one.value <= one.high, (load.info.name, one)
        assert all(judgement.verdict is not Verdict.UNDECIDED or judgement.reason for judgement in scene.checks)


@pytest.mark.parametrize("scale", [1e-6, 1e-3, 1e3])
def test_masses_and_forces_in_other_sizes(scale: float) -> None:
    """Everything that has a mass in it so many times: the same ratios, reserves and turns."""

    def times(text: str) -> str:
        number, unit = text.split()
        return f"{float(number) * scale!r} {unit}"

    keys = {
        "load": CRANE["load"],
        "hook_block": CRANE["hook_block"],
        "rope__mass": CRANE["rope"]["mass"],
        "rope__modulus": CRANE["rope"]["modulus"],
        "rope__breaking_force": CRANE["rope"]["breaking_force"],
        "drum__inertia": CRANE["drum"]["inertia"],
        "motor__inertia": CRANE["motor"]["inertia"],
        "motor__coupling_inertia": CRANE["motor"]["coupling_inertia"],
        "motor__power": CRANE["motor"]["power"],
        "motor__mean_starting_torque": CRANE["motor"]["mean_starting_torque"],
        "brake__torque": CRANE["brake"]["torque"],
    }
    plain = hoist_scene(CRANE)
    scaled = hoist_scene(changed(CRANE, **{key: times(text) for key, text in keys.items()}))
    for name in (
        "rope_safety",
        "static_stretch",
        "drum_turns",
        "fleet_angle",
        "starting_reserve",
        "start_time",
        "heating_utilisation",
        "brake_reserve_static",
    ):
        assert value(scaled, name) == pytest.approx(value(plain, name), rel=1e-9), name


def test_a_tackle_of_many_falls_and_a_rope_of_a_hair() -> None:
    scene = hoist_scene(changed(CRANE, reeving__falls=64, rope__diameter="0.1 mm", drum__pitch="0.11 mm"))
    assert value(scene, "drum_turns") > 0
    assert all(math.isfinite(load.estimate.value) for load in scene.loads)


def test_a_drum_far_too_short_for_its_rope_has_very_many_layers() -> None:
    scene = hoist_scene(changed(PAPER, height="10 km", drum__length="60 mm"))
    assert value(scene, "drum_layers") > 100
    assert scene.checks[0].verdict is Verdict.FAIL


def test_a_stall_looked_at_for_longer_than_its_rope_lasts_is_unknown_not_nan() -> None:
    """The window takes all of a rope as soft as rubber at the set speed: its shortening has no bound."""
    data = changed(PAPER, rope__modulus="10 MPa", motor__speed="960 rpm", scenes=[{"type": "lift"}])
    scene = hoist_scene(data)
    loads = {load.info.name: load.estimate for load in scene.loads}
    assert loads["lift_off_time"].value == math.inf
    assert loads["rope_force_max"].high == math.inf
    assert not any(math.isnan(part) for one in loads.values() for part in (one.value, one.low, one.high))
    assert {judgement.code: judgement.verdict for judgement in scene.checks}["HST121"] is Verdict.FAIL
