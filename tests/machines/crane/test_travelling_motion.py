"""Starts and stops of a travelling crane against an integration of its own, and what the acceptance asks of them."""

import math
from typing import Any

import numpy as np
import pytest
from support import travel_ode
from support.machines import changed, check_of, load_of, report_of, scene_of
from support.travel_ode import Machine
from support.travelling import BRIDGE, as_file, crane, crane_of, scene_report, value

from ptmcalc.contract.report import Judgement
from ptmcalc.contract.result import Found
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.crane.travelling.machine.scenes import Moving
from ptmcalc.machines.crane.travelling.sway.sway_exact import SWAY_EXACT
from ptmcalc.machines.crane.travelling.sway.sway_linear import SWAY_LINEAR
from ptmcalc.machines.crane.travelling.sway.sway_simulated import SWAY_SIMULATED

RAMP = Machine(True, 1.0, 1e4, 2e4, 8.0, 1500.0, ramp=0.15)
STEEP = Machine(False, 2.0, 1e4, 2e4, 5.0, 1500.0, ramp=1.5)
PUSHED = Machine(True, 1.0, 1e4, 2e4, 8.0, 1500.0, 2000.0, 500.0, force=9000.0, rotor=5000.0)
HEAVY = Machine(True, 1.0, 3e4, 2e4, 12.0, 1500.0, force=9000.0, rotor=3000.0)
BRAKED = Machine(
    False, 1.0, 1e4, 2e4, 8.0, 1500.0, -2000.0, -500.0, force=9000.0, rotor=5000.0, rotor_braked=5000.0, delay=0.2,
    rise=0.3,
)  # fmt: skip
HOISTED = Machine(True, 1.0, 1e4, 2e4, 8.0, 1500.0, hoisting=0.3, ramp=0.25)
LOWERED = Machine(True, 1.0, 1e4, 2e4, 3.0, 1500.0, hoisting=-0.3, ramp=0.25)


def run(solver: Any, data: dict[str, Any], level: int = 0) -> dict[str, Found]:
    spec = crane_of(data)
    scene: Moving = spec.all_scenes[0]  # type: ignore[assignment]
    assert solver.usable_for(spec, scene)
    return dict(solver.run(spec, scene, solver.represents, level).loads)


@pytest.mark.parametrize("one", [RAMP, STEEP, PUSHED, HEAVY, BRAKED, HOISTED, LOWERED])
def test_simulated_as_integrated(one: Machine) -> None:
    seen, loads = travel_ode.travel(one), run(SWAY_SIMULATED, as_file(one), 1)
    time = loads["start_time" if one.starts else "brake_time"].estimate.value
    way = loads["start_distance" if one.starts else "brake_distance"].estimate.value
    assert time == pytest.approx(seen.time, rel=1e-6)
    assert way == pytest.approx(seen.distance, rel=1e-6)
    assert loads["sway_angle_max"].estimate.value == pytest.approx(seen.sway, rel=1e-6)
    assert loads["horizontal_force"].estimate.value == pytest.approx(max(map(abs, seen.pulls)), rel=1e-5)
    if not one.wind_on_load:
        assert loads["sway_residual"].estimate.value == pytest.approx(seen.residual, rel=1e-5)


@pytest.mark.parametrize("one", [RAMP, STEEP])
def test_the_closed_form_is_the_truth_of_a_ramp(one: Machine) -> None:
    seen, loads = travel_ode.travel(one), run(SWAY_EXACT, as_file(one))
    assert loads["sway_angle_max"].estimate.value == pytest.approx(seen.sway, rel=1e-6)
    assert loads["sway_residual"].estimate.value == pytest.approx(seen.residual, rel=1e-5)
    assert loads["horizontal_force"].estimate.value == pytest.approx(max(map(abs, seen.pulls)), rel=1e-5)


def test_the_largest_pull_of_a_violent_ramp_is_exact_inside_its_swing() -> None:
    """Beyond 30 degrees the horizontal pull is largest before the end of the swing."""
    one = Machine(**{**RAMP.__dict__, "ramp": 6.0, "speed": 20.0})
    gravity, angles = 9.81, np.linspace(0.0, 2 * math.atan(6.0 / 9.81), 2_000_001)
    pulls = one.load * (3 * gravity * np.cos(angles) + 18.0 * np.sin(angles) - 2 * gravity) * np.sin(angles)
    found = run(SWAY_EXACT, as_file(one))["horizontal_force"].estimate
    assert found.value == pytest.approx(float(pulls.max()), rel=1e-12)


@pytest.mark.parametrize("one", [RAMP, PUSHED, HEAVY, BRAKED, HOISTED, LOWERED])
def test_linear_and_simulated_agree_where_angles_are_small(one: Machine) -> None:
    tame = Machine(**{**one.__dict__, "ramp": one.ramp and one.ramp / 10, "hoisting": one.hoisting / 10})
    if one.ramp is None:
        tame = Machine(
            **{**one.__dict__, "speed": 0.02, "force": 3500.0, "wind": 0.0, "wind_on_load": 0.0, "rise": 0.0}
        )
    linear, simulated = (run(solver, as_file(tame)) for solver in (SWAY_LINEAR, SWAY_SIMULATED))
    for name, found in linear.items():
        assert found.estimate.value == pytest.approx(simulated[name].estimate.value, rel=5e-3, abs=1e-6), name


def ramp_of_a_period(**changes: Any) -> dict[str, Any]:
    period = 2 * math.pi * math.sqrt(8 / 9.81)
    return crane(drive__acceleration=None, drive__ramp_time=f"{period!r} s", **changes)


def test_a_ramp_of_one_period_leaves_no_swing_in_small_angles() -> None:
    data = ramp_of_a_period()
    assert run(SWAY_LINEAR, data)["sway_residual"].estimate.value < 1e-9
    assert 1e-9 < run(SWAY_EXACT, data)["sway_residual"].estimate.value < 1e-5
    assert run(SWAY_SIMULATED, data, 1)["sway_residual"].estimate.value == pytest.approx(
        run(SWAY_EXACT, data)["sway_residual"].estimate.value, rel=1e-5
    )


def test_the_ramp_that_cancels_the_swing_is_reported_and_does() -> None:
    """8.1 s at 0.13 m/s^2 are more than one period: two of them."""
    ramp = value(BRIDGE, "sway_free_ramp")
    assert ramp == pytest.approx(4 * math.pi * math.sqrt(8 / 9.81))
    data = crane(drive__acceleration=None, drive__ramp_time=f"{ramp!r} s")
    assert value(data, "sway_residual") < 1e-3 * value(BRIDGE, "sway_residual")


def test_wheels_and_grip_by_levers_of_ones_own() -> None:
    """All of it once by hand: the trolley at the far end, the load at its largest angle."""
    scene = scene_report(crane(scenes=[{"type": "start", "trolley": "far"}], effects={"large_sway": "on"}))
    g, a, load, bridge, trolley, span, base = 9.81, 0.13, 10250.0, 13000.0, 2200.0, 22.5, 3.6
    sway = 2 * math.atan(a / g)
    tension = load * g  # at rest at its largest angle, the rope carries the weight of the load
    pull, weight = tension * math.sin(sway), tension * math.cos(sway)
    left = 1 - 21.2 / span
    half = (bridge * g / 2 + (trolley * g + weight) * left) / 2
    transfer = (bridge * a * 0.6 / 2 + (trolley * a * 1.1 + pull * 1.1) * left) / base
    front = half - transfer
    traction = (bridge + trolley) * a + 0.01 * (bridge + trolley + load) * g + pull
    assert load_of(scene, "skid_reserve[A1]").estimate.value == pytest.approx(0.14 * front / (traction / 2), rel=2e-3)
    assert load_of(scene, "traction_max").estimate.value == pytest.approx(traction, rel=2e-3)


def test_one_wheel_skids_where_the_mean_of_all_would_hold() -> None:
    data = crane(drive__acceleration="0.2 m/s^2", scenes=[{"type": "start", "trolley": "near"}])
    scene = scene_report(data)
    grip = load_of(scene, "skid_reserve_min")
    verdicts = {one.code: one.verdict for one in scene.checks}
    assert verdicts["CRN155"] == "fail"
    assert grip.estimate.high < 1.2
    assert grip.formula is not None
    assert grip.formula.value > 2
    assert "corner B1" in grip.note
    assert load_of(scene, "skid_reserve[A1]").estimate.low > 1.2


def test_wheels_on_one_shaft_hold_together() -> None:
    data = crane(
        drive__acceleration="0.2 m/s^2", drive__wheels="coupled", scenes=[{"type": "start", "trolley": "near"}]
    )
    assert value(data, "skid_reserve_min") > 1.2


def test_hoisting_while_it_swings_swings_farther() -> None:
    data = crane(
        suspension__hoist_speed="8 m/min", scenes=[{"type": "start"}, {"type": "hoist_while_travelling", "hoist": "up"}]
    )
    start, hoisted = (value(data, "sway_angle_max", name) for name in ("start_loaded", "hoist_while_travelling_loaded"))
    assert hoisted > 1.05 * start


def test_a_motor_curve_is_followed() -> None:
    curve = {
        "type": "linear",
        "starting_torque": "60 N*m",
        "no_load_speed": "220 rad/s",
        "rated_torque": "15 N*m",
    }
    slow = changed(
        BRIDGE,
        rail__adhesion=0.9,
        drive__acceleration=None,
        drive__motor={"count": 2, "inertia": "0.006 kg*m^2", "coupling_inertia": "0.002 kg*m^2", "curve": curve},
    )
    scene = scene_report(slow)
    states = {effect.name: effect.state.value for effect in scene.effects}
    assert states["torque_curve"] == "simulated"
    found = load_of(scene, "start_time")
    assert found.estimate.bounded
    assert found.formula is not None
    assert abs(found.formula.ratio or 0) != 1


def test_a_motor_that_does_not_come_to_full_speed_stalls() -> None:
    curve = {"type": "linear", "starting_torque": "60 N*m", "no_load_speed": "160 rad/s", "rated_torque": "15 N*m"}
    motor = {"count": 2, "inertia": "0.006 kg*m^2", "coupling_inertia": "0.002 kg*m^2", "curve": curve}
    scene = scene_report(changed(BRIDGE, drive__acceleration=None, drive__motor=motor))
    assert "stall" in load_of(scene, "start_time").note
    assert {one.code: one.verdict for one in scene.checks}["CRN150"] == "fail"


def test_a_curve_too_weak_is_told_the_number_it_grows_with() -> None:
    """A straight line from 20 N*m: the torque that brings the crane to speed in time, and 1 % less does not."""

    def judged(torque: float) -> Judgement:
        curve = {"type": "linear", "starting_torque": f"{torque} N*m", "no_load_speed": "220 rad/s"}
        motor = {"count": 2, "inertia": "0.006 kg*m^2", "coupling_inertia": "0.002 kg*m^2", "curve": curve}
        data = changed(BRIDGE, rail__adhesion=0.9, drive__acceleration=None, drive__motor=motor)
        return check_of(scene_report(data | {"checks": {"start_time": "5 s"}}, repairs=True), "CRN150")

    failing = judged(20)
    assert failing.verdict == "fail"
    assert failing.repair is not None
    assert failing.repair.path == ("drive", "motor", "curve", "starting_torque")
    assert judged(failing.repair.value).verdict == "pass"
    assert judged(0.99 * failing.repair.value).verdict != "pass"


def test_a_rheostat_start_changes_over_from_step_to_step() -> None:
    curve = {
        "type": "rheostat",
        "power": "3 kW",
        "speed": "945 rpm",
        "synchronous_speed": "1000 rpm",
        "overload": 2.6,
        "steps": [6, 2.5],
        "smallest_torque": "35 N*m",
    }
    data = changed(
        BRIDGE,
        speed="0.9 m/s",
        drive__acceleration=None,
        drive__gear={"ratio": 16, "efficiency": 0.9},
        drive__motor={"count": 2, "inertia": "0.02 kg*m^2", "coupling_inertia": "0.01 kg*m^2", "curve": curve},
        rail__adhesion=0.9,
    )
    scene = scene_report(data)
    assert load_of(scene, "start_time").estimate.bounded
    assert 0 < load_of(scene, "start_time").estimate.value < 10


def test_a_start_torque_below_friction_stalls() -> None:
    data = crane(drive__acceleration=None, drive__motor__mean_starting_torque="4 N*m")
    scene = scene_report(data)
    verdicts = {one.code: one.verdict for one in scene.checks}
    assert verdicts["CRN160"] == "fail"
    assert verdicts["CRN150"] == "fail"
    assert math.isinf(load_of(scene, "start_time").estimate.value)
    assert "stall" in load_of(scene, "starting_reserve").note


def test_an_empty_hook_without_a_block_does_not_swing() -> None:
    data = crane(hook_block="0 kg", scenes=[{"type": "start", "load": "empty"}])
    scene = scene_report(data)
    assert load_of(scene, "sway_angle_max").estimate.value == 0
    assert all(one.code != "CRN153" for one in scene.checks)


def test_the_history_of_a_swing(tmp_path: Any) -> None:
    scene = scene_report(
        crane(
            effects={"large_sway": "on"}, suspension__hoist_speed="8 m/min", scenes=[{"type": "hoist_while_travelling"}]
        ),
        histories=True,
    )
    sway = load_of(scene, "sway_angle_max")
    assert sway.history is not None
    assert np.max(np.abs(sway.history.values)) == pytest.approx(sway.estimate.value, rel=1e-3)


def test_a_load_on_a_cantilever_lifts_the_other_rail() -> None:
    """By levers: 10.25 t and 2.2 t 3 m beyond rail A of 22.5 m, 13 t in the middle."""
    data = crane(travels="gantry", bridge__cantilever_a="4 m", trolley__nearest="-3 m", scenes=[{"type": "run"}])
    far_rail = (13000 / 2 - 12450 * 3 / 22.5) * 9.81 / 2
    assert value(data, "wheel_load_min") == pytest.approx(far_rail)


def test_the_files_to_start_from_pass() -> None:
    template = next(one for one in load_kind("crane").types if one.type == "travelling").template
    report = check(load_text(template.encode(), "crane.yaml"), Options())
    assert report.verdict == "pass"
    assert [one.message for one in report.diagnostics if one.severity != "note"] == []


def test_a_hit_buffer_that_is_too_short_tells_the_speed_left() -> None:
    buffers = {"type": "linear", "stiffness": "100 kN/m", "stroke": "100 mm", "rating": "60 kN"}
    data = crane(buffers=buffers, scenes=[{"type": "collision", "load": "empty", "trolley": "middle"}])
    scene = scene_report(data | {"hook_block": "1 g"})
    mass = 15200 + 2 * 0.008 * 22**2 * 0.9 / 0.1575**2
    left = math.sqrt(1.05**2 - 2e5 * 0.1**2 / mass)
    assert load_of(scene, "buffer_speed_left").estimate.value == pytest.approx(left, rel=5e-4)
    assert "at the end of their stroke" in load_of(scene, "buffer_stroke").note
    assert {one.code: one.verdict for one in scene.checks}["CRN170"] == "fail"


def test_two_cranes_that_meet_are_a_wall_to_each_other() -> None:
    """Equal ones at equal speeds; a crane at rest takes half of the speed."""
    buffers = {"type": "linear", "stiffness": "100 kN/m", "stroke": "1 m", "rating": "600 kN"}
    mass = 15200 + 2 * 0.008 * 22**2 * 0.9 / 0.1575**2
    scenes = [
        {"type": "collision"},
        {"type": "collision", "other_mass": f"{mass!r} kg", "other_speed": "1.05 m/s", "name": "equal"},
        {"type": "collision", "other_mass": f"{mass!r} kg", "name": "standing"},
    ]
    data = crane(buffers=buffers, scenes=scenes)
    wall, equal, standing = (value(data, "buffer_force", name) for name in ("collision_loaded", "equal", "standing"))
    assert equal == pytest.approx(wall)
    assert standing == pytest.approx(wall / 2)


def test_wheels_that_slide_are_said_once() -> None:
    report = report_of(crane(drive__acceleration="0.9 m/s^2"))
    said = [one.message for one in report.diagnostics if one.code == "NUM102"]
    assert len(said) == 1
    assert "driven wheels slip" in said[0]


def test_brakes_that_do_not_stop_it_are_said_once() -> None:
    wind = {"area": "200 m^2", "pressure": "250 Pa"}
    data = crane(wind=wind, drive__brake__torque="4 N*m", scenes=[{"type": "brake", "by": "brake"}])
    report = report_of(data)
    assert [one.code for one in report.diagnostics if one.severity == "warning"] == ["NUM110"]
    assert {one.code: one.verdict for one in scene_of(report).checks}["CRN151"] == "fail"


def test_a_crane_that_coasts_to_rest_before_its_brakes_act() -> None:
    """m v^2/2 is what the wheels take; the load takes and gives back a little."""
    data = crane(drive__brake={"torque": "16 N*m", "delay": "60 s"}, scenes=[{"type": "brake", "by": "brake"}])
    scene = scene_report(data)
    rotor = 2 * 0.008 * 22**2 * 0.9 / 0.1575**2
    coasts = (25450 + rotor) * 1.05 / (0.01 * 25450 * 9.81)
    assert load_of(scene, "brake_time").estimate.value == pytest.approx(coasts, rel=0.1)
    assert load_of(scene, "brake_time").estimate.bounded
