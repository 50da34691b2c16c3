"""Speed of a motor that a lowered load drives along its curve: a published case, the equivalent circuit, limits."""

import math
from typing import Any

import numpy as np
import pytest
import yaml
from scipy.optimize import brentq
from support.machines import changed, check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.components.motor import InductionMotor, LinearMotor, TableMotor
from ptmcalc.components.motor_torque import carrying_speed

ARM = 0.125 / 48
MASS = 180 / 9.81 / ARM
SLIP = 0.14 / (2.5 + math.sqrt(2.5**2 - 1))
RATED = 157.0796 * (1 - SLIP)
HOIST: dict[str, Any] = yaml.safe_load(f"""
kind: hoist
load: {MASS!r} kg
height: 8 m
least_fall: 1 m
speed: {{drum: {157.0796 / 12!r} rad/s}}
reeving: {{falls: 4, sheave_efficiency: 1}}
rope: {{diameter: 14 mm, area: 90 mm^2, modulus: 105 GPa, mass: 1e-12 kg/m}}
drum: {{diameter: 236 mm, length: 2 m, pitch: 16 mm, dead_wraps: 3, inertia: 0 kg*m^2}}
gearbox: {{ratio: 12, efficiency: 0.9, reverse_efficiency: 0.9}}
motor:
  inertia: {1.1 - 0.9 * MASS * ARM**2!r} kg*m^2
  coupling_inertia: 0 kg*m^2
  curve:
    type: induction
    power: {168 * RATED!r} W
    speed: {RATED!r} rad/s
    synchronous_speed: 157.0796 rad/s
    overload: 2.5
brake: {{torque: 400 N*m, delay: 0.2 s}}
scenes: [{{type: run, hook_height: 5 m}}, {{type: emergency_stop, hook_height: 5 m}}]
""")
"""Case E4c: breakdown torque 420 N m at a slip of 0.14, 180 N m of the load, 0.9 of it at the motor, 1.1 kg m^2."""


def test_the_published_case_is_reproduced() -> None:
    report = report_of(HOIST)
    run, stop = (scene_of(report, name) for name in ("run_loaded", "emergency_stop_down_loaded"))
    expected = {
        "lowering_speed": (run, 161.491447),
        "lowering_speed_ratio": (run, 1.0280867),
        "emergency_speed_max": (stop, 190.945993),
        "emergency_speed_ratio": (stop, 1.2156002),
        "emergency_stop_time": (stop, 1.0825235),
        "emergency_travel": (stop, 119.500907),
    }
    for name, (scene, value) in expected.items():
        assert load_of(scene, name).estimate.value == pytest.approx(value, rel=1e-6), name
    runaway = 180 * load_of(run, "overhauling_reserve").estimate.value
    assert runaway == pytest.approx(466.666667, rel=1e-6)


def circuit(breakdown: float, slip: float, ratio: float, speed: float, field: float) -> float:
    """Torque of the equivalent circuit: R_2'/s in series with R_1 and X, scaled to the breakdown torque."""
    s = (field - speed) / field
    r2 = 1.0
    r1 = ratio * r2
    x = math.sqrt((r2 / slip) ** 2 - r1**2)

    def power(one: float) -> float:
        return (r2 / one) / ((r1 + r2 / one) ** 2 + x**2)

    return breakdown * power(s) / power(slip) if s else 0.0


def test_the_speed_is_that_of_the_equivalent_circuit() -> None:
    """Motors with and without the resistance of the stator, and loads that none of them holds."""
    away = 0
    for index in range(60):
        rng = np.random.default_rng((31, index))
        field, slip, overload = rng.uniform(70, 320), rng.uniform(0.01, 0.08), rng.uniform(1.6, 3.2)
        ratio = float(rng.choice([0.0, rng.uniform(0.2, 1.2)]))
        rated = field * (1 - slip)
        given = {
            "type": "induction",
            "power": f"{rng.uniform(2e3, 9e4)!r} W",
            "speed": f"{rated!r} rad/s",
            "synchronous_speed": f"{field!r} rad/s",
            "overload": overload,
        } | ({"formula": "full", "stator_ratio": ratio} if ratio else {})
        curve = InductionMotor.model_validate(given)
        breakdown, s_k = curve.power / rated * overload, curve.breakdown_slip
        lowest = circuit(breakdown, s_k, ratio, field * (1 + s_k), field)
        load = float(rng.uniform(-1.3, 1.2)) * breakdown
        found = carrying_speed(curve, load)
        if load < lowest:
            away += 1
            assert found == math.inf
        elif load > breakdown:
            assert found == 0
        else:
            ends = (field * (1 - s_k), field * (1 + s_k))
            right = brentq(lambda w, f=field, m=load: circuit(breakdown, s_k, ratio, w, f) - m, *ends, xtol=1e-11)  # noqa: B023
            assert found == pytest.approx(right, rel=1e-9), index
    assert away > 0


def test_tables_and_lines_are_followed() -> None:
    table = TableMotor.model_validate(
        {
            "type": "table",
            "points": [
                {"speed": f"{n} rad/s", "torque": f"{m} N*m"} for n, m in ((0, 300), (130, 330), (150, 0), (170, -80))
            ],
        }
    )
    assert carrying_speed(table, -40.0) == pytest.approx(160)
    assert carrying_speed(table, -81.0) == math.inf
    line = LinearMotor.model_validate({"type": "linear", "starting_torque": "400 N*m", "no_load_speed": "150 rad/s"})
    assert carrying_speed(line, -800.0) == pytest.approx(450)


@pytest.mark.parametrize(
    ("overspeed", "run", "stop"), [(1.3, "pass", "pass"), (1.2, "pass", "fail"), (1.05, "fail", "fail")]
)
def test_the_permissible_speed_turns_the_verdict(overspeed: float, run: str, stop: str) -> None:
    report = report_of(changed(HOIST, checks={"overspeed": overspeed}))
    for name, code, verdict in (("run_loaded", "HST132", run), ("emergency_stop_down_loaded", "HST136", stop)):
        assert check_of(scene_of(report, name), code).verdict is Verdict(verdict)


def test_the_delay_of_the_brake_turns_the_verdict() -> None:
    for delay, verdict in (("0.1 s", Verdict.PASS), ("0.25 s", Verdict.FAIL)):
        scene = scene_of(report_of(changed(HOIST, brake__delay=delay)), "emergency_stop_down_loaded")
        assert check_of(scene, "HST136").verdict is verdict


def test_a_load_that_the_motor_does_not_hold_has_no_speed() -> None:
    weak = {**HOIST["motor"]["curve"], "overload": 1.01, "power": f"{120 * RATED} W"}
    scene = scene_of(report_of(changed(HOIST, motor__curve=weak)), "run_loaded")
    assert math.isinf(load_of(scene, "lowering_speed").estimate.value)
    assert check_of(scene, "HST132").verdict is Verdict.FAIL


def test_without_a_curve_nothing_is_said_of_steady_lowering() -> None:
    plain = changed(HOIST, motor__curve=None, motor__mean_starting_torque="320 N*m")
    codes = {one.code for one in scene_of(report_of(plain), "run_loaded").checks}
    assert "HST132" not in codes
