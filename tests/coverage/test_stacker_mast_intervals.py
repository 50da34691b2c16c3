"""Bars of a column of two masses, and of one without weights, against one with all its modes: they hold, and are
needed."""

import math
from collections.abc import Mapping

import numpy as np
import pytest
from support.decades import Seeded, overhead_stacker
from support.machines import loaded
from support.stacker_masts import random_stacker

from ptmcalc.base.estimate import NOTHING, Estimate, Interval
from ptmcalc.contract.result import Result
from ptmcalc.machines.crane.stacking.effects_mast import gravity_bound, modes_bound
from ptmcalc.machines.crane.stacking.names_mast import GRAVITY
from ptmcalc.machines.crane.stacking.solvers.mast_beam import MAST_BEAM
from ptmcalc.machines.crane.stacking.solvers.mast_modal import COLLISION_MODAL, MAST_MODAL
from ptmcalc.machines.crane.stacking.solvers.mast_two_mass import MAST_TWO_MASS
from ptmcalc.machines.crane.stacking.spec import Stacker

SEED, MACHINES, WEIGHED, TIGHTER = 101, 60, 12, 1 / 3
BLOWS, OF_A_BLOW = 24, ("collision_force", "collision_deflection", "mast_moment_max")
LOADS = ("mast_deflection_max", "mast_force_max", "mast_moment_max", "settling_time", "brake_time")


def estimates(result: Result) -> dict[str, Estimate]:
    return {name: one.estimate for name, one in result.loads.items()}


def uses(
    cheap: Mapping[str, Estimate], offsets: Mapping[str, Interval], rich: Mapping[str, Estimate]
) -> dict[str, float]:
    """How much of its bar each load needs; a run that settles never must say so in both."""
    found = {}
    for name in LOADS:
        if name not in cheap:
            continue
        here, there = cheap[name].value, rich[name].value
        if not (math.isfinite(here) and math.isfinite(there)):
            assert here == there
            continue
        offset = there - here
        told = offsets.get(name, NOTHING)
        room = told.high if offset > 0 else -told.low
        found[name] = (abs(offset) / room if room > 0 else math.inf) if offset else 0.0
    return found


@pytest.fixture(scope="module")
def sample() -> dict[str, list[dict[str, float]]]:
    """Uses of the bars for the modes and for the weights, machine by machine."""
    rng = np.random.default_rng(SEED)
    found: dict[str, list[dict[str, float]]] = {"modes": [], "weights": []}
    for number in range(MACHINES):
        spec = loaded(random_stacker(rng)).spec
        assert isinstance(spec, Stacker)
        scene = spec.all_scenes[0]
        two = estimates(MAST_TWO_MASS.run(spec, scene, MAST_TWO_MASS.always, 0))
        all_modes = estimates(MAST_MODAL.run(spec, scene, MAST_MODAL.always, 0))
        found["modes"].append(uses(two, modes_bound(spec, scene, two), all_modes))
        if number < WEIGHED:
            heavy = estimates(MAST_MODAL.run(spec, scene, MAST_MODAL.always | {GRAVITY}, 0))
            found["weights"].append(uses(all_modes, gravity_bound(spec, scene, all_modes), heavy))
            beam = estimates(MAST_BEAM.run(spec, scene, frozenset(), 0))
            spread = gravity_bound(spec, scene, beam)
            for name, one in beam.items():
                if name.startswith("natural_frequency"):
                    offset = spread[name]
                    assert one.value + offset.low * (1 + 1e-6) <= heavy[name].value, (number, name)
                    assert heavy[name].low <= one.value + offset.high + 1e-6 * one.value, (number, name)
    return found


@pytest.mark.parametrize("what", ["modes", "weights"])
def test_every_load_lies_in_its_bar(sample: dict[str, list[dict[str, float]]], what: str) -> None:
    assert len(sample[what]) == (MACHINES if what == "modes" else WEIGHED)
    outside = [(k, name, use) for k, one in enumerate(sample[what]) for name, use in one.items() if use > 1]
    assert outside == []


@pytest.mark.parametrize("what", ["modes", "weights"])
@pytest.mark.parametrize("name", LOADS[:3])
def test_a_third_of_the_bar_would_not_hold(sample: dict[str, list[dict[str, float]]], what: str, name: str) -> None:
    assert max(one.get(name, 0.0) for one in sample[what]) > TIGHTER


def test_a_third_of_the_bar_of_the_settling_time_would_not_hold(sample: dict[str, list[dict[str, float]]]) -> None:
    settled = [one["settling_time"] for one in sample["modes"] if "settling_time" in one]
    assert len(settled) > 5
    assert max(settled) > TIGHTER


@pytest.fixture(scope="module")
def weighed() -> dict[str, list[float]]:
    """How much of the bar for the weights each load of a collision needs, blow by blow."""
    found: dict[str, list[float]] = {name: [] for name in OF_A_BLOW}
    for seed in range(BLOWS):
        data = overhead_stacker(Seeded(seed), decades=0.3)
        data["scenes"] = [{"type": "obstacle", "mechanism": ("bridge", "trolley")[seed % 2]}]
        spec = loaded(data).spec
        assert isinstance(spec, Stacker)
        scene = spec.all_scenes[0]
        light = estimates(COLLISION_MODAL.run(spec, scene, COLLISION_MODAL.always, 0))
        heavy = estimates(COLLISION_MODAL.run(spec, scene, COLLISION_MODAL.always | {GRAVITY}, 0))
        spread = gravity_bound(spec, scene, light)
        for name, needs in found.items():
            needs.append(abs(heavy[name].value - light[name].value) / spread[name].high)
    return found


@pytest.mark.parametrize("name", OF_A_BLOW)
def test_every_load_of_a_blow_lies_in_its_bar_for_the_weights(weighed: dict[str, list[float]], name: str) -> None:
    assert len(weighed[name]) == BLOWS
    assert max(weighed[name]) <= 1


def test_a_third_of_the_bar_of_the_moment_of_a_blow_would_not_hold(weighed: dict[str, list[float]]) -> None:
    assert max(weighed["mast_moment_max"]) > TIGHTER
