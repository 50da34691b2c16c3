"""Hoists on a rope with mass and on one that gets shorter: beside the train without either, and what they decide."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import yaml
from scipy.linalg import eigh
from support.hoists import CRANE, hoist_of
from support.machines import changed, check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.laws import rope_rod
from ptmcalc.machines.hoist.motion import rope_case, rope_scene
from ptmcalc.machines.hoist.motion import scene as motion
from ptmcalc.machines.hoist.motion.cases import case_of

TALL: dict[str, Any] = yaml.safe_load("""
kind: hoist
name: A tall hoist
load: 5 t
height: 300 m
speed: {main: 0.8 m/s}
reeving: {falls: 1, sheave_efficiency: 0.98}
rope: {diameter: 26 mm, area: 290 mm^2, modulus: 105 GPa, mass: 2.6 kg/m}
drum:
  diameter: 800 mm
  length: 1500 mm
  layers: 4
  flange_height: 160 mm
  inertia: 180 kg*m^2
  dead_wraps: 3
  pitch: 29.12 mm
gearbox: {ratio: 50, efficiency: 0.93, reverse_efficiency: 0.924731182795699, damping: 0.03}
motor: {inertia: 0.7 kg*m^2, coupling_inertia: 0.2 kg*m^2, mean_starting_torque: 800 N*m}
brake: {torque: 1000 N*m, delay: 0.1 s, rise_time: 0.1 s}
class: {mechanism: M5, hoisting: HC1}
checks: {lift_off_factor: 1.6}
scenes: [{type: lift}]
""")
SCENES: list[dict[str, Any]] = [
    {"type": "lift"},
    {"type": "lift", "slack": "50 mm"},
    {"type": "lift", "rope": "taut", "profile": {"shape": "ramp", "time": "1 s"}},
    {"type": "start", "direction": "down"},
    {"type": "start", "profile": {"shape": "ramp", "time": "1 s", "control": "torque"}},
    {"type": "stop", "direction": "up"},
    {"type": "lower_brake"},
]
LONGER = 1e4


@pytest.mark.parametrize("structure", [None, {"stiffness": "6 MN/m", "mass": "6500 kg"}, {"stiffness": "6 MN/m"}])
@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: "_".join(map(str, scene.values()))[:30])
def test_a_rope_whose_length_hardly_changes_is_that_of_the_train(
    scene: dict[str, Any], structure: dict[str, Any] | None
) -> None:
    """The same stiffness on a rope ten thousand times as long: two solvers that share no equation of motion."""
    spec = hoist_of(changed(CRANE, scenes=[scene], structure=structure))
    one: Any = spec.all_scenes[0]
    rope = rope_case.hauled(spec, one)
    long = replace(
        rope,
        extensional=rope.extensional * LONGER,
        length=rope.length * LONGER,
        wound_strain=rope.wound_strain / LONGER,
    )
    theirs = motion.result(one, case_of(spec, one, frozenset({"structure"})), 0).loads
    ours = rope_scene.result(spec, one, long, 0).loads
    compared = [name for name in theirs if name not in ("energy_residual", "natural_frequency")]
    assert set(compared) <= set(ours)
    for name in compared:
        if name in ("backlash_torque_peak", "gear_impact_factor") and one.type == "stop":
            continue  # at rest the losses have no direction: the train keeps that of the last motion
        assert ours[name].estimate.value == pytest.approx(theirs[name].estimate.value, rel=1e-6, abs=1e-9), name


def test_waves_decide_what_their_bound_leaves_open() -> None:
    """The bar of a rope without mass straddles the limit; with its waves the load is lifted off too hard."""
    scene = scene_of(report_of(TALL))
    check = check_of(scene, "HST120")
    assert check.verdict is Verdict.FAIL
    factor = load_of(scene, "lift_off_factor")
    assert factor.solver == "rope_waves"
    assert factor.estimate.low > 1.6
    without = scene_of(report_of(changed(TALL, effects={"rope_mass": "off"})))
    assert check_of(without, "HST120").verdict is Verdict.PASS
    assert load_of(without, "lift_off_factor").estimate.high < 1.5


def test_a_rope_that_gets_shorter_is_carried_where_the_file_asks() -> None:
    data = changed(TALL, effects={"rope_mass": "off", "rope_shortening": "on"}, height="60 m")
    scene = scene_of(report_of(data))
    assert load_of(scene, "lift_off_factor").solver == "rope_hauled"
    off = scene_of(report_of(changed(data, effects={"rope_mass": "off", "rope_shortening": "off"})))
    ours, theirs = (load_of(one, "lift_off_factor").estimate for one in (scene, off))
    assert ours.bar < 1e-6
    assert abs(ours.value - theirs.value) > 1e-4


def test_a_slack_rope_with_mass_is_said_and_decides_only_that_nothing_pulls() -> None:
    brake = {"torque": "2000 N*m"}
    data = changed(TALL, speed={"main": "2.5 m/s"}, brake=brake, scenes=[{"type": "stop", "direction": "up"}])
    spec = hoist_of(data)
    one: Any = spec.all_scenes[0]
    found = rope_scene.result(spec, one, rope_case.rod(spec, one), 0)
    assert any("goes slack" in finding.message for finding in found.findings)
    sure = {name for name, load in found.loads.items() if load.estimate.bounded}
    assert sure == {"natural_frequency", "energy_residual", "rope_force_min", "rope_force_share"}
    assert found.loads["rope_force_share"].estimate.high == 0
    alone = changed(data, effects={"rope_shortening": "off"})
    assert check_of(scene_of(report_of(alone)), "HST124").verdict is Verdict.FAIL


@pytest.mark.parametrize(("damping", "gear"), [(0.02, None), (0.0, "2 MN*m/rad")])
def test_damped_ropes_and_elastic_gears_have_no_waves(damping: float, gear: str | None) -> None:
    data = changed(TALL, rope__damping=damping, gearbox__stiffness=gear, scenes=[{"type": "lower_brake"}])
    assert "rope_waves" not in [one.name for one in scene_of(report_of(data)).solvers]


@pytest.mark.parametrize("share", [0.02, 0.3])
def test_the_frequency_of_the_rod_is_exact(share: float) -> None:
    spec = hoist_of(changed(CRANE, scenes=[{"type": "lift"}], structure={"stiffness": "6 MN/m", "mass": "6500 kg"}))
    one: Any = spec.all_scenes[0]
    haul, k = rope_case.haul(spec, one), rope_case.rod(spec, one).stiffness
    mass = np_chain(haul.motor_mass + haul.drum_mass, haul.load_mass, 6500.0, k, 6e6, share * haul.load_mass, 60)
    theirs = eigh(*mass, eigvals_only=True)[1] ** 0.5
    ours = rope_rod.framed_rod_frequency(
        k, share * haul.load_mass, haul.motor_mass + haul.drum_mass, haul.load_mass, 6e6, 6500.0
    )
    assert ours == pytest.approx(theirs, rel=1e-4)


def np_chain(drive: float, load: float, frame: float, k: float, kb: float, rope: float, pieces: int) -> tuple[Any, Any]:
    n = pieces + 2
    mass, stiff = np.zeros((n, n)), np.zeros((n, n))
    for i in range(pieces):
        rows = [i, i + 1]
        mass[np.ix_(rows, rows)] += rope / pieces / 6 * np.array([[2.0, 1.0], [1.0, 2.0]])
        stiff[np.ix_(rows, rows)] += k * pieces * np.array([[1.0, -1.0], [-1.0, 1.0]])
    turn = np.eye(n)
    turn[0, -1] = -1.0
    mass[pieces, pieces] += load
    mass, stiff = turn.T @ mass @ turn, turn.T @ stiff @ turn
    mass[0, 0] += drive
    mass[-1, -1] += frame
    stiff[-1, -1] += kb
    return stiff, mass


PROFILES: dict[str, dict[str, Any]] = {
    "step": {},
    "ramp of torque": {"shape": "ramp", "time": "0.3 s", "control": "torque"},
    "ramp of speed": {"shape": "ramp", "time": "0.3 s"},
    "curve": {"shape": "curve"},
}


@pytest.mark.parametrize("profile", PROFILES)
def test_a_limiter_cuts_every_drive(profile: str) -> None:
    """An overload: the drive is off and the brake closes after the delay, as a second solver has it, too."""
    curve = {"type": "linear", "starting_torque": "900 N*m", "no_load_speed": "1500 rpm", "rated_torque": "150 N*m"}
    torque: dict[str, Any] = {"mean_starting_torque": "900 N*m"} if profile != "curve" else {"curve": curve}
    data = changed(
        CRANE,
        scenes=[{"type": "lift", "slack": "20 mm", "profile": PROFILES[profile]}],
        limiter={"factor": 1.02, "delay": "0.05 s"},
        speed={"main": "0.4 m/s"},
        gearbox__ratio=35,
        motor={"inertia": "0.13 kg*m^2", "coupling_inertia": "0.03 kg*m^2"} | torque,
        duty=None,
    )
    spec = hoist_of(data)
    one: Any = spec.all_scenes[0]
    rope = rope_case.hauled(spec, one)
    strain = rope.wound_strain / LONGER
    long = replace(rope, extensional=rope.extensional * LONGER, length=rope.length * LONGER, wound_strain=strain)
    theirs = motion.result(one, case_of(spec, one, frozenset({"structure"})), 0)
    ours = rope_scene.result(spec, one, long, 0)
    assert any("limiter trips" in finding.message for finding in theirs.findings)
    assert any("limiter trips" in finding.message for finding in ours.findings)
    for name in ("rope_force_max", "lift_off_time", "lift_off_speed"):
        assert ours.loads[name].estimate.value == pytest.approx(theirs.loads[name].estimate.value, rel=1e-5), name
    without = motion.result(one, case_of(hoist_of(changed(data, limiter=None)), one, frozenset({"structure"})), 0)
    assert theirs.loads["rope_force_max"].estimate.value < without.loads["rope_force_max"].estimate.value
