"""Emergency stops of the rigid drive: a published case, integration in time on seeded hoists, limits."""

import math
from typing import Any

import numpy as np
import pytest
import yaml
from support.hoist_stops import Stops, random_stop
from support.machines import changed, check_of, load_of, loaded, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import SceneReport
from ptmcalc.engine.load import load_text
from ptmcalc.machines.hoist.braking.solver import run

HOIST: dict[str, Any] = yaml.safe_load(f"""
kind: hoist
load: {210 / 9.81 / (0.125 / 4 / 12)!r} kg
height: 8 m
least_fall: 1 m
speed: {{drum: {152 / 12!r} rad/s}}
reeving: {{falls: 4, sheave_efficiency: 1}}
rope: {{diameter: 14 mm, area: 90 mm^2, modulus: 105 GPa, mass: 1e-12 kg/m}}
drum: {{diameter: 236 mm, length: 2 m, pitch: 16 mm, dead_wraps: 3, inertia: 0 kg*m^2}}
gearbox: {{ratio: 12, efficiency: 1, reverse_efficiency: 1}}
motor:
  inertia: {1.35 - 210 / 9.81 * 0.125 / 4 / 12!r} kg*m^2
  coupling_inertia: 0 kg*m^2
  mean_starting_torque: 400 N*m
brake:
  torque: 380 N*m
  delay: 0.12 s
  rise_time: 0.18 s
  disc_mass: 38 kg
  specific_heat: 500 J/kg*K
  cooling_time: 2400 s
  stops_per_hour: 90
scenes: [{{type: emergency_stop, hook_height: 5 m}}]
""")
"""Case E4a: 1.35 kg m^2 with the load, 210 N m of the load, 152 rad/s, 0.0125/4.8 m of the hook per radian."""
MACHINES = 64


def stopped(**changes: Any) -> SceneReport:
    return scene_of(report_of(changed(HOIST, **changes)))


def test_the_published_case_is_reproduced() -> None:
    scene = stopped()
    expected = {
        "emergency_stop_time": 1.67647059,
        "emergency_speed_max": 178.403509,
        "emergency_travel": 170.374118,
        "emergency_descent": 0.443682598,
        "brake_heat": 51373.7647,
        "brake_temperature_one": 2.70388235,
        "brake_temperature_max": 163.588638,
        "brake_reserve_static": 1.80952381,
    }
    for name, value in expected.items():
        one = load_of(scene, name).estimate
        assert one.value == pytest.approx(value, rel=1e-6), name
        assert one.low <= value * (1 + 1e-6), name
        assert one.high >= value * (1 - 1e-6), name
    assert load_of(scene, "emergency_speed_max").estimate.bar < 0.01 * 178


def test_the_rigid_drive_is_that_of_its_integration() -> None:
    """Either direction, either shaft, linear and exponential rise, brakes that do not hold, several layers."""
    never = back = 0
    for index in range(MACHINES):
        data = random_stop(np.random.default_rng((2711, index)))
        spec = loaded(data).spec
        assert spec is not None
        right = Stops(data).emergency_stop(data["scenes"][0])
        found = run(spec, spec.all_scenes[0], frozenset(), 0).loads  # type: ignore[arg-type]
        assert found.keys() == right.keys()
        for name, value in right.items():
            assert found[name].estimate.value == pytest.approx(value, rel=1e-6, abs=1e-9), (index, name)
        never += math.isinf(right["emergency_stop_time"])
        back += "emergency_rise" in right and 0 < right["emergency_descent"] < math.inf
    assert never > 0
    assert back > 0


@pytest.mark.parametrize(
    ("code", "passing", "failing"),
    [
        ("HST128", {"checks": {"stop_distance": "450 mm"}}, {"checks": {"stop_distance": "430 mm"}}),
        ("HST129", {"brake__stop_heat": "52 kJ"}, {"brake__stop_heat": "49 kJ"}),
        ("HST130", {"brake__temperature_rise": "166 K"}, {"brake__temperature_rise": "160 K"}),
        (
            "HST131",
            {"brake__friction_work": "60 MJ", "brake__stops_per_service": 1100},
            {"brake__friction_work": "60 MJ", "brake__stops_per_service": 1200},
        ),
    ],
)
def test_a_limit_turns_the_verdict(code: str, passing: dict[str, Any], failing: dict[str, Any]) -> None:
    assert check_of(stopped(**passing), code).verdict is Verdict.PASS
    assert check_of(stopped(**failing), code).verdict is Verdict.FAIL


def test_the_energy_of_the_stop_is_that_of_drive_and_load() -> None:
    """Q = J w_0^2/2 + M_L phi, not the energy of the drive alone."""
    scene = stopped()
    travel = load_of(scene, "emergency_travel").estimate.value
    heat = load_of(scene, "brake_heat").estimate.value
    assert heat == pytest.approx(1.35 * 152**2 / 2 + 210 * travel, rel=1e-9)


def test_a_load_that_is_hoisted_sinks_before_a_late_brake() -> None:
    """At rest after w_0 J/M_L = 0.977 s; a brake after 1.2 s finds it sinking."""
    up = {"type": "emergency_stop", "direction": "up", "hook_height": "5 m"}
    early = stopped(scenes=[up], brake__delay="0.5 s")
    assert load_of(early, "emergency_descent").estimate.value == 0
    late = stopped(scenes=[up], brake__delay="1.2 s", brake__rise_time="0 s")
    rest, rate = 152 * 1.35 / 210, 210 / 1.35
    assert load_of(late, "emergency_rise").estimate.value == pytest.approx(152 * rest / 2 * 0.125 / 48, rel=1e-9)
    sunk = rate * (1.2 - rest) ** 2 / 2 * (1 + 210 / 170) * 0.125 / 48
    assert load_of(late, "emergency_descent").estimate.value == pytest.approx(sunk, rel=1e-9)


def test_a_brake_weaker_than_the_load_fails() -> None:
    scene = stopped(brake__torque="200 N*m", brake__stop_heat="1 MJ")
    for code in ("HST118", "HST128", "HST129"):
        judged = check_of(scene, code)
        assert judged.verdict is Verdict.FAIL
    assert "does not stop" in check_of(scene, "HST128").reason or math.isinf(
        load_of(scene, "emergency_descent").estimate.value
    )


def test_data_of_the_heat_add_the_scene() -> None:
    """A file without scenes is checked for it; one without such data is what it was."""
    given = changed(HOIST)
    del given["scenes"]
    labels = [scene.name for scene in report_of(given).scenes]
    assert labels[-1] == "emergency_stop_down_loaded"
    for key in ("disc_mass", "specific_heat", "cooling_time", "stops_per_hour"):
        del given["brake"][key]
    assert "emergency_stop_down_loaded" not in [scene.name for scene in report_of(given).scenes]


def test_what_is_assumed_of_the_discs_is_tried_at_both_ends() -> None:
    """163.6 K with the assumed values; 20 to 60 min and 460 to 540 J/(kg K) reach from 77 to 267 K."""
    data = changed(HOIST, brake__temperature_rise="200 K")
    for key in ("specific_heat", "cooling_time"):
        del data["brake"][key]
    assert check_of(scene_of(report_of(data)), "HST130").verdict is Verdict.UNDECIDED
    for limit, verdict in (("300 K", Verdict.PASS), ("70 K", Verdict.FAIL)):
        data["brake"]["temperature_rise"] = limit
        assert check_of(scene_of(report_of(data)), "HST130").verdict is verdict


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"brake__disc_mass": "0 kg"}, "greater than 0 kg"),
        ({"brake__specific_heat": "500 J/(kg*K)"}, "J/kg*K"),
        ({"brake__stops_per_hour": 4000}, "at most 3600"),
        ({"brake__cooling_time": "0 s"}, "greater than 0"),
        ({"scenes": [{"type": "emergency_stop", "motor_speed": "0 rpm"}]}, "greater than 0"),
    ],
)
def test_bad_values_are_refused_with_one_message(changes: dict[str, Any], said: str) -> None:
    result = load_text(yaml.safe_dump(changed(HOIST, **changes)).encode(), "case.yaml")
    found = [one for one in result.diagnostics if one.severity.rank == 2]
    assert len(found) == 1
    assert said in found[0].message + found[0].hint


def test_without_a_distance_or_a_hook_height_the_descent_is_not_checked() -> None:
    """The load might hang just above the ground."""
    scene = {"type": "emergency_stop"}
    report = report_of(changed(HOIST, scenes=[scene], checks={}))
    (found,) = (one for _, one in report.judgements if one.code == "HST128")
    assert found.verdict is Verdict.NOT_CHECKED
    assert "checks.stop_distance" in found.reason
