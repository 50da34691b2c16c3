"""Hoists whose load overcomes the braking torque of the motor, with two ratings, or a curve that brakes in the mean.

Right values by the balance of every sheave, gear and motor shaft, written out here.
"""

import math
from typing import Any

import pytest
import yaml
from support.machines import changed, check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.engine.load import load_text

HOIST: dict[str, Any] = yaml.safe_load("""
kind: hoist
load: 8 t
hook_block: 150 kg
height: 10 m
least_fall: 1 m
speed: {main: 0.2 m/s}
reeving: {falls: 4, ropes: 1, sheave_efficiency: 0.98}
rope: {diameter: 14 mm, area: 90 mm^2, modulus: 105 GPa, mass: 0.8 kg/m}
drum: {diameter: 315 mm, length: 900 mm, pitch: 16 mm, dead_wraps: 3, inertia: 5 kg*m^2}
gearbox: {ratio: 30, efficiency: 0.93, reverse_efficiency: 0.92}
motor:
  inertia: 0.15 kg*m^2
  coupling_inertia: 0.03 kg*m^2
  speed: 1400 rpm
  rated_duty: 40 %
  curve: {type: induction, power: 15 kW, speed: 1400 rpm, synchronous_speed: 1500 rpm, overload: 2.6}
brake: {torque: 220 N*m, delay: 0.15 s, rise_time: 0.1 s}
class: {mechanism: M4, hoisting: HC2}
scenes: [{type: run}, {type: start, direction: down}]
""")
DUTY = {"type": "S3", "factor": "40 %"}
RPM = math.pi / 30


def table(*points: tuple[float, float]) -> dict[str, Any]:
    return {"type": "table", "points": [{"speed": f"{n} rpm", "torque": f"{m} N*m"} for n, m in points]}


def driving(load: float) -> float:
    """Torque on the motor shaft of a mass that is lowered from the lowest hook position [N*m]."""
    eta, fall = 0.98, 0.8 * 11.0 * 9.81

    def lifted(at_drum: float) -> float:
        """Sum of the falls at the hook block, from the force at the drum: sheaves take of the falls' own weight too."""
        first = at_drum - fall
        second = first / eta
        third = (second + fall) / eta - fall
        return first + second + third + third / eta

    zero, slope = lifted(0.0), lifted(1.0) - lifted(0.0)
    return (load * 9.81 - zero) / slope * 0.1645 * 0.92 / 30


def faults(data: dict[str, Any]) -> list[str]:
    result = load_text(yaml.safe_dump(data, sort_keys=False).encode(), "case.yaml")
    return [f"{one.message}; {one.hint}" for one in result.diagnostics if one.code == "SPC113"]


@pytest.mark.parametrize(
    ("curve", "braking"),
    [
        (table((0, 330), (1300, 330), (1500, 0), (1600, -60)), 60.0),
        (table((0, 330), (1300, 330), (1500, 0), (1600, -130)), 130.0),
        (table((0, 330), (1300, 330), (1500, 0)), 0.0),
        ({**HOIST["motor"]["curve"], "power": "9 kW", "overload": 1.5}, 1.5 * 9000 / (1400 * RPM)),
        (HOIST["motor"]["curve"], 2.6 * 15000 / (1400 * RPM)),
        ({"type": "linear", "starting_torque": "400 N*m", "no_load_speed": "1500 rpm"}, math.inf),
    ],
)
@pytest.mark.parametrize("count", [1, 2])
def test_a_load_that_the_motors_do_not_hold_fails(curve: dict[str, Any], braking: float, count: int) -> None:
    report = report_of(changed(HOIST, motor__curve=curve, motor__count=count))
    for label in ("run_loaded", "start_down_loaded"):
        scene = scene_of(report, label)
        expected = count * braking / driving(8150.0)
        assert load_of(scene, "overhauling_reserve").estimate.value == pytest.approx(expected, rel=1e-9)
        judged = check_of(scene, "HST127")
        assert judged.verdict is (Verdict.PASS if expected >= 1 else Verdict.FAIL)
        assert judged.blame.path == ("motor", "curve")


@pytest.mark.parametrize(
    ("power", "key"), [({}, ("motor", "curve", "power")), ({"power": "9 kW"}, ("motor", "curve", "overload"))]
)
def test_a_motor_that_holds_the_load_is_offered(power: dict[str, Any], key: tuple[str, ...]) -> None:
    """A power that the file gives twice does not change in one place."""
    curve = {**HOIST["motor"]["curve"], "power": "9 kW", "overload": 1.5}
    data = changed(HOIST, motor__curve=curve)
    data["motor"] |= power
    repair = check_of(scene_of(report_of(data, repairs=True), "run_loaded"), "HST127").repair
    assert repair is not None
    assert repair.path == key
    value = f"{repair.value!r} W" if key[-1] == "power" else repair.value
    mended = report_of(changed(data, **{"__".join(key): value}))
    assert check_of(scene_of(mended, "run_loaded"), "HST127").verdict is Verdict.PASS


def test_nothing_is_asked_of_a_motor_that_lifts_or_has_no_curve() -> None:
    plain = changed(HOIST, motor__curve=None, motor__mean_starting_torque="250 N*m")
    up = changed(HOIST, scenes=[{"type": "start", "direction": "up"}])
    for data in (plain, up):
        codes = {one.code for scene in report_of(data).scenes for one in scene.checks}
        assert "HST127" not in codes


def test_the_rating_of_the_curve_is_that_of_the_motor() -> None:
    """108 % of 15 kW, with the power of the curve alone and with the same given besides."""
    alone = changed(HOIST, duty=DUTY, scenes=[{"type": "run"}])
    both = changed(alone, motor__power="15 kW")
    used = [load_of(scene_of(report_of(data)), "heating_utilisation").estimate.value for data in (alone, both)]
    scene = scene_of(report_of(alone))
    rms = load_of(scene, "torque_motor_rms").estimate.value
    assert used == [pytest.approx(rms / (15000 / (1400 * RPM)), rel=1e-12)] * 2
    assert check_of(scene, "HST116").blame.path == ("motor", "curve", "power")
    assert check_of(scene_of(report_of(both)), "HST116").blame.path == ("motor", "power")


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"motor__power": "22 kW"}, "write `power: 15 kW`"),
        ({"motor__power": "15.3 kW"}, "write `power: 15 kW`"),
        ({"motor__speed": "5600 rpm"}, "write `speed: 1400 rpm`"),
        ({"motor__rated_torque": "150 N*m"}, "write `rated_torque: 102.3 N*m`"),
        (
            {"motor__power": "15 kW", "motor__curve": {**table((0, 300), (1500, 0)), "rated_torque": "150 N*m"}},
            "write `rated_torque: 102.3 N*m`",
        ),
    ],
)
def test_two_ratings_of_one_motor_are_refused(changes: dict[str, Any], said: str) -> None:
    found = faults(changed(HOIST, **changes))
    assert len(found) == 1
    assert said in found[0]


@pytest.mark.parametrize(
    "changes",
    [
        {"motor__power": "15 kW"},
        {"motor__power": "14.9 kW"},
        {"motor__speed": "1410 rpm"},
        {"motor__rated_torque": "102 N*m"},
        {
            "motor__power": "15 kW",
            "motor__curve": {
                "type": "converter",
                "power": "15 kW",
                "speed": "1000 rpm",
                "rated_speed": "1400 rpm",
                "ramp_time": "2 s",
                "torque_limit": "250 N*m",
                "slip": 0.05,
            },
        },
    ],
)
def test_ratings_that_agree_are_read(changes: dict[str, Any]) -> None:
    """To 1 %; the speed of a converter's curve is the one asked for."""
    assert faults(changed(HOIST, **changes)) == []


def test_a_curve_that_brakes_in_the_mean_crashes_nothing() -> None:
    """Up to a rated speed of 5600 rpm this table brakes: its start is simulated, and its reserve is below 0."""
    curve = table((0, 330), (1300, 330), (1500, 0), (1700, -330))
    scenes = [
        {"type": "run"},
        {"type": "lift", "slack": "100 mm"},
        {"type": "start", "direction": "up", "profile": {"shape": "ramp", "time": "1 s", "control": "torque"}},
        {"type": "start", "direction": "up", "profile": {"shape": "curve"}, "name": "along"},
        {"type": "start", "direction": "down"},
    ]
    report = report_of(changed(HOIST, motor__speed="5600 rpm", motor__curve=curve, scenes=scenes))
    speeds = [0, 1300, 1500, 1700, 5600]
    torques = [330, 330, 0, -330, -330]
    mean = (
        sum((a + b) / 2 * (n - m) for a, b, m, n in zip(torques, torques[1:], speeds, speeds[1:], strict=False)) / 5600
    )
    scene = scene_of(report, "run_loaded")
    assert check_of(scene, "HST114").verdict is Verdict.FAIL
    up = load_of(scene, "torque_motor_static_up").estimate.value
    assert load_of(scene, "starting_reserve").estimate.value == pytest.approx(mean / up, rel=5e-3)
    stalled = check_of(scene_of(report, "start_loaded"), "HST114")
    assert stalled.verdict is Verdict.FAIL
