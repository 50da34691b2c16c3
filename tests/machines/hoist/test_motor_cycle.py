"""Heating by a cycle of given torques: a published case, limits, bad values."""

import math
from typing import Any

import pytest
import yaml
from support.machines import changed, check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import SceneReport
from ptmcalc.engine.load import load_text

HOIST: dict[str, Any] = yaml.safe_load("""
kind: hoist
load: 5 t
height: 8 m
least_fall: 5 m
speed: {main: 0.2 m/s}
reeving: {falls: 4, sheave_efficiency: 0.98, sheave_diameter: 320 mm}
rope: {diameter: 14 mm, area: 90 mm^2, modulus: 105 GPa, mass: 0.8 kg/m, breaking_force: 140 kN}
drum: {diameter: 315 mm, length: 1 m, pitch: 16 mm, dead_wraps: 3, inertia: 5 kg*m^2}
gearbox: {ratio: 30, efficiency: 0.93}
motor:
  inertia: 0.2 kg*m^2
  coupling_inertia: 0.03 kg*m^2
  mean_starting_torque: 200 N*m
  rated_torque: 118 N*m
duty:
  type: S1
  losses: {constant: 620 W, copper: 1480 W, temperature_rise: 80 K, time_constant: 1800 s}
  cycle:
    - {torque: 230 N*m, to: 190 N*m, time: 1.2 s, phase: starting}
    - {torque: 102 N*m, time: 14 s}
    - {torque: -40 N*m, time: 0.6 s, phase: starting}
    - {torque: 0 N*m, time: 25 s, phase: rest}
    - {torque: 30 N*m, time: 0.8 s, phase: starting}
    - {torque: -78 N*m, time: 13 s}
    - {torque: -160 N*m, to: -120 N*m, time: 0.9 s, phase: starting}
    - {torque: 0 N*m, time: 38 s, phase: rest}
brake: {torque: 250 N*m}
class: {mechanism: M1}
scenes: [{type: run}]
""")
"""Cycle and motor of case E5a."""


def run_of(**changes: Any) -> SceneReport:
    return scene_of(report_of(changed(HOIST, **changes)))


def test_the_published_case_is_reproduced() -> None:
    scene = run_of()
    expected = {
        "cycle_torque_weighted": 77.0157202,
        "cycle_torque_whole": 56.385609,
        "cycle_torque_running": 98.7243222,
        "cycle_duty_factor": 0.326203209,
        "cycle_loss_mean": 1007.77175,
        "cycle_loss_utilisation": 0.479891311,
    }
    for name, value in expected.items():
        assert load_of(scene, name).estimate.value == pytest.approx(value, rel=1e-6), name
    assert load_of(scene, "cycle_temperature_max").estimate.value == pytest.approx(38.5290322, rel=1e-3)


@pytest.mark.parametrize(
    ("code", "passing", "failing"),
    [
        ("HST133", {"motor__rated_torque": "78 N*m"}, {"motor__rated_torque": "76 N*m"}),
        ("HST135", {"duty__losses__time_constant": "1800 s"}, {"duty__losses__time_constant": "2 s"}),
        ("HST134", {"duty__losses__copper": "300 W"}, {"motor__rated_torque": "50 N*m"}),
    ],
)
def test_a_value_turns_the_verdict(code: str, passing: dict[str, Any], failing: dict[str, Any]) -> None:
    assert check_of(run_of(**passing), code).verdict is Verdict.PASS
    assert check_of(run_of(**failing), code).verdict is Verdict.FAIL


def test_a_rating_at_a_duty_factor_contains_its_pauses() -> None:
    """118 N*m at 40 % are 118 sqrt(0.4/(0.4 + 0.33 x 0.6)) in continuous duty."""
    used = load_of(run_of(motor__rated_duty=0.4), "cycle_utilisation").estimate.value
    assert used == pytest.approx(77.0157202 / (118 * math.sqrt(0.4 / (0.4 + 0.33 * 0.6))), rel=1e-6)


def test_without_a_cycle_nothing_changes() -> None:
    data = changed(HOIST)
    del data["duty"]["cycle"]
    codes = {one.code for one in scene_of(report_of(data)).checks}
    assert not codes & {"HST133", "HST134", "HST135"}


@pytest.mark.parametrize(
    ("part", "said"),
    [
        ({"torque": "50 N*m", "time": "1 s", "phase": "rest"}, "write `torque: 0 N*m`"),
        ({"torque": "50 N*m", "time": "0 s"}, "greater than 0"),
        ({"torque": "50 N*m"}, "time"),
    ],
)
def test_bad_parts_are_refused_with_one_message(part: dict[str, Any], said: str) -> None:
    result = load_text(yaml.safe_dump(changed(HOIST, duty__cycle=[part])).encode(), "case.yaml")
    found = [one for one in result.diagnostics if one.severity.rank == 2]
    assert len(found) == 1
    assert said in found[0].message + found[0].hint
