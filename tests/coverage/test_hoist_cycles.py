"""Heating of a hoist motor by a cycle of given torques against quadrature, and integration until it repeats.

The closed forms claim no bar but rounding; the reference of the temperature is good to 1e-4.
"""

import numpy as np
import pytest
import yaml
from support.bars import Trial, claim, known_to, misses, numbers, opposites, tried, verdicts
from support.hoist_cycles import random_cycle, reference
from support.machines import changed, loaded

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.hoist.drive.cycle import SOLVER

WITHOUT_BARS = {"hoist": ("motor_cycle",)}
KIND = load_kind("hoist")
SEED, MACHINES = 53, 64
WAY = "motor_cycle"
HOIST = yaml.safe_load("""
kind: hoist
load: 5 t
height: 8 m
least_fall: 5 m
speed: {main: 0.2 m/s}
reeving: {falls: 4, sheave_efficiency: 0.98}
rope: {diameter: 14 mm, area: 90 mm^2, modulus: 105 GPa, mass: 0.8 kg/m}
drum: {diameter: 315 mm, length: 1 m, pitch: 16 mm, dead_wraps: 3, inertia: 5 kg*m^2}
gearbox: {ratio: 30, efficiency: 0.93, reverse_efficiency: 0.92}
motor: {inertia: 0.2 kg*m^2, coupling_inertia: 0.03 kg*m^2, mean_starting_torque: 200 N*m}
duty: {type: S1}
scenes: [{type: run}]
""")


def trial_of(index: int) -> Trial:
    rng = np.random.default_rng((SEED, index))
    data = changed(HOIST, **random_cycle(rng))
    spec = loaded(data).spec
    assert spec is not None
    scene = spec.all_scenes[0]
    right = reference(data)
    truth = {name: known_to(1e-4 if "temperature" in name else 1e-7, value) for name, value in right.items()}
    return tried(index, rng, KIND, spec, scene, {WAY: claim(KIND, spec, scene, SOLVER)}, truth)


@pytest.fixture(scope="module", params=numbers(16, MACHINES))
def machines(request: pytest.FixtureRequest) -> list[Trial]:
    return [trial_of(index) for index in request.param]


def test_what_is_claimed_is_what_quadrature_finds(machines: list[Trial]) -> None:
    assert misses(machines, WAY) == []
    for trial in machines:
        assert trial.claims[WAY].keys() == trial.truth.keys()


def test_no_verdict_is_another(machines: list[Trial]) -> None:
    assert opposites(machines) == []
    for code in ("HST133", "HST134", "HST135"):
        said = verdicts(machines, code)
        assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.05 * len(said)
