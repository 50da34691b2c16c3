"""Cranes driven beyond the curve of their motors, stalls while hoisting, and buffers that bottom out.

Right values by balances written out here.
"""

import math
from typing import Any

import pytest
import yaml
from support.machines import changed, check_of, load_of, loaded, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.span import dotted

GRAVITY = 9.81
GANTRY: dict[str, Any] = yaml.safe_load("""
kind: crane
type: travelling
travels: gantry
load: 20 t
hook_block: 500 kg
bridge: {mass: 30 t, span: 20 m, height: 7 m}
trolley: {mass: 5 t, nearest: 2 m, height: 10 m}
wheels: {diameter: 500 mm, base: 6 m, per_corner: 2, driven: [A1, A2, B1, B2], rating: 150 kN, inertia: 4 kg*m^2}
rolling: {coefficient: 0.006}
rail: {slope: 0.002, adhesion: 0.14}
speed: 0.8 m/s
drive:
  motor: {count: 2, inertia: 0.06 kg*m^2, coupling_inertia: 0.01 kg*m^2, speed: 960 rpm}
  gear: {ratio: 31.4, efficiency: 0.92, reverse_efficiency: 0.91}
  brake: {torque: 120 N*m, delay: 0.3 s, rise_time: 0.2 s}
suspension: {length: 9 m}
wind: {area: 40 m^2, load_area: 10 m^2, pressure: 150 Pa, pressure_max: 200 Pa, shape: 1.6, load_shape: 1.2}
""")
SLEWING: dict[str, Any] = yaml.safe_load("""
kind: crane
type: slewing
load: {mass: 3 t, hook_block: 60 kg, radius: 12 m, rope_length: 9 m}
slewing_part: {mass: 8 t, radius: 0.3 m, inertia: 9000 kg*m^2}
counterweight: {mass: 5 t, radius: 2.6 m, inertia: 1000 kg*m^2}
jib: {mass: 1.8 t, length: 12 m}
speed: 1 rpm
friction: 1.5 kN*m
wind: {steady: 8 kN*m, maximum: 9 kN*m}
motor: {inertia: 0.1 kg*m^2, coupling_factor: 1.7, speed: 900 rpm}
gear: {ratio: 900, efficiency: 0.72, reverse_efficiency: 0.6, open: {ratio: 9, efficiency: 0.95}}
brake: {torque: 16 N*m, delay: 0.1 s}
cycle: {rotation: 180 deg, brake_angle: 45 deg}
scenes: [{type: slew}]
""")


def table(*points: tuple[float, float]) -> dict[str, Any]:
    return {"type": "table", "points": [{"speed": f"{n} rpm", "torque": f"{m} N*m"} for n, m in points]}


def induction(power: float, overload: float) -> dict[str, Any]:
    rated = {"power": f"{power} kW", "speed": "960 rpm", "synchronous_speed": "1000 rpm"}
    return {"type": "induction", **rated, "overload": overload}


WEAK, STRONG = (table((0, 80), (960, 78), (1000, 0), (1050, -most)) for most in (4, 60))


def on_motors(pressure: float, wind: int, slope: int) -> float:
    """Torque with which wind and slope, 1 from behind and down, drive the motors of the gantry [N*m]."""
    weight, angle = 55500 * GRAVITY, math.atan(0.002)
    blows = pressure * (1.6 * 40 + 1.2 * 10)
    force = wind * blows + slope * weight * math.sin(angle) - 0.006 * weight
    return force * 0.25 * 0.91 / 31.4


@pytest.mark.parametrize(
    ("wind", "slope"), [("with", "with"), ("with", "against"), ("with", "none"), ("none", "with"), ("against", "with")]
)
@pytest.mark.parametrize(("curve", "braking"), [(WEAK, 4.0), (STRONG, 60.0), (induction(4, 2.0), None)])
def test_wind_and_slope_may_drive_a_crane_beyond_its_motors(
    curve: dict[str, Any], braking: float | None, wind: str, slope: str
) -> None:
    most = braking if braking is not None else 2.0 * 4000 / (960 * math.pi / 30)
    scenes = [{"type": "run"}, {"type": "start", "wind": wind, "slope": slope}]
    report = report_of(changed(GANTRY, drive__motor__curve=curve, scenes=scenes))
    signs = {"with": 1, "none": 0, "against": -1}
    asked = {"run_loaded": on_motors(200, 1, 1), "start_loaded": on_motors(150, signs[wind], signs[slope])}
    for label, torque in asked.items():
        judged = [one for one in scene_of(report, label).checks if one.code == "CRN165"]
        if torque <= 0:
            assert judged == []
            continue
        expected = 2 * most / torque
        value = load_of(scene_of(report, label), "overhauling_reserve").estimate.value
        assert value == pytest.approx(expected, rel=1e-5)  # cosine of the slope
        assert judged[0].verdict is (Verdict.PASS if expected >= 1 else Verdict.FAIL)
        assert judged[0].blame.path == ("drive", "motor", "curve")


def test_a_slope_alone_drives_a_crane() -> None:
    steep = changed(GANTRY, rail__slope=0.03, wind=None, drive__motor__curve=WEAK, scenes=[{"type": "run"}])
    angle = math.atan(0.03)
    weight = 55500 * GRAVITY
    force = weight * (math.sin(angle) - 0.006 * math.cos(angle))
    scene = scene_of(report_of(steep))
    expected = 8 / (force * 0.25 * 0.91 / 31.4)
    assert load_of(scene, "overhauling_reserve").estimate.value == pytest.approx(expected, rel=1e-4)
    assert check_of(scene, "CRN165").verdict is Verdict.FAIL


def test_a_motor_that_holds_the_crane_is_offered() -> None:
    weak = changed(GANTRY, drive__motor__curve=induction(1.2, 2.0), scenes=[{"type": "run"}])
    for data, key in ((weak, "power"), (changed(weak, drive__motor__power="1.2 kW"), "overload")):
        judged = check_of(scene_of(report_of(data, repairs=True)), "CRN165")
        assert judged.verdict is Verdict.FAIL
        assert judged.repair is not None
        assert judged.repair.path == ("drive", "motor", "curve", key)
        value = f"{judged.repair.value!r} W" if key == "power" else judged.repair.value
        mended = report_of(changed(data, **{f"drive__motor__curve__{key}": value}))
        assert check_of(scene_of(mended), "CRN165").verdict is Verdict.PASS


def test_nothing_is_asked_of_motors_without_a_curve() -> None:
    plain = changed(GANTRY, drive__motor__mean_starting_torque="80 N*m", scenes=[{"type": "run"}])
    assert "CRN165" not in {one.code for one in scene_of(report_of(plain)).checks}
    slews = changed(SLEWING, motor__mean_starting_torque="32 N*m")
    assert "CRN120" not in {one.code for one in scene_of(report_of(slews)).checks}


@pytest.mark.parametrize("most", [0.0, 4.0, 6.0])
def test_wind_may_drive_a_slewing_crane_beyond_its_motor(most: float) -> None:
    curve = table((0, 32), (900, 30), (1000, 0), (1050, -most))
    scene = scene_of(report_of(changed(SLEWING, motor__curve=curve)))
    expected = most / ((9000 - 1500) * 0.6 / 900)
    assert load_of(scene, "overhauling_reserve").estimate.value == pytest.approx(expected, rel=1e-12)
    judged = check_of(scene, "CRN120")
    assert judged.verdict is (Verdict.PASS if expected >= 1 else Verdict.FAIL)
    assert judged.blame.path == ("motor", "curve")


def test_friction_holds_a_slewing_crane() -> None:
    curve = table((0, 32), (900, 30), (1000, 0))
    calm = changed(SLEWING, motor__curve=curve, wind={"steady": "1 kN*m", "maximum": "1.4 kN*m"})
    assert "CRN120" not in {one.code for one in scene_of(report_of(calm)).checks}


def test_a_stall_is_told_where_the_hoisted_load_has_no_rope_left() -> None:
    """The mean of the curve moves the crane too slowly for its rope, its smallest torque not at all."""
    hoists = {"type": "hoist_while_travelling", "wind": "against", "slope": "against"}
    curve = table((0, 80), (850, 80), (960, 40), (1000, 0))
    mean = (850 * 80 + 110 * 60) / 960
    needs = (150 * (1.6 * 40 + 12) + 0.002 * 55500 * GRAVITY + 0.006 * 55500 * GRAVITY) * 0.25 / 31.4 / 0.92
    data = changed(GANTRY, drive__motor__curve=curve, suspension__hoist_speed="4 m/s", scenes=[hoists])
    assert 2 * 40 < needs < 2 * mean
    report = report_of(data)
    scene = scene_of(report)
    assert math.isinf(load_of(scene, "start_time").estimate.value)
    assert check_of(scene, "CRN150").verdict is Verdict.FAIL
    assert all(one.verdict is not Verdict.UNDECIDED for one in scene.checks)
    assert not [one for one in report.diagnostics if "rope" in one.message]
    assert [one for one in report.diagnostics if one.message.endswith("against friction, wind and slope")]


@pytest.mark.parametrize("stroke", [0.05, 0.1, 0.4])
def test_a_buffer_that_takes_less_than_the_energy_fails_for_its_force(stroke: float) -> None:
    """35 t and the rotors at 0.8 m/s on two springs of 300 kN/m, each rail with half at least."""
    buffers = {"type": "linear", "count": 2, "stiffness": "300 kN/m", "stroke": f"{stroke} m", "rating": "200 kN"}
    motor = {"drive__motor__mean_starting_torque": "80 N*m"}
    data = changed(GANTRY, **motor, buffers=buffers, scenes=[{"type": "collision"}])
    energy, takes = 35000 * 0.8**2 / 2, 2 * 300e3 * stroke**2 / 2
    scene = scene_of(report_of(data, repairs=True))
    judged = check_of(scene, "CRN171")
    if takes < energy:
        assert judged.verdict is Verdict.FAIL
        assert judged.blame.path == ("buffers", "stroke")
        assert judged.repair is not None
        longer = changed(data, buffers__stroke=f"{judged.repair.value!r} m")
        assert check_of(scene_of(report_of(longer)), "CRN171").verdict is Verdict.PASS
    else:
        assert judged.verdict is Verdict.PASS
    if stroke == 0.05:
        unrated = scene_of(report_of(changed(data, buffers__rating=None)))
        assert check_of(unrated, "CRN171").verdict is Verdict.NOT_CHECKED


@pytest.mark.parametrize(
    ("buffers", "assumed"),
    [
        ({"type": "linear", "stiffness": "300 kN/m"}, False),
        ({"stiffness": "300 kN/m"}, False),
        ({"type": "constant", "force": "60 kN"}, False),
        ({"type": "hydraulic", "orifice": "30 t/m"}, False),
        ({"type": "progressive", "end_force": "80 kN"}, True),
        ({"type": "progressive", "end_force": "80 kN", "power": 2.5}, False),
    ],
)
def test_the_power_of_a_curve_is_assumed_of_progressive_buffers_alone(buffers: dict[str, Any], assumed: bool) -> None:
    data = changed(GANTRY, drive__motor__mean_starting_torque="80 N*m", buffers=buffers | {"stroke": "200 mm"})
    assert ("buffers.power" in {dotted(one.path) for one in loaded(data).assumed}) is assumed


def test_the_rating_of_a_curve_is_that_of_the_motors() -> None:
    duty = {"type": "S3", "factor": "40 %"}
    data = changed(GANTRY, drive__motor__curve=induction(9, 2.2), duty=duty, scenes=[{"type": "run"}])
    both = changed(data, drive__motor__power="9 kW")
    used = [load_of(scene_of(report_of(one, ends=False)), "heating_utilisation").estimate.value for one in (data, both)]
    assert used[0] == pytest.approx(used[1], rel=1e-12)
    assert check_of(scene_of(report_of(data, ends=False)), "CRN162").blame.path == ("drive", "motor", "curve", "power")
    slews = changed(SLEWING, motor__curve=induction(3.5, 2.4), motor__speed="960 rpm")
    both = changed(slews, motor__power="3.5 kW")
    used = [
        load_of(scene_of(report_of(one, ends=False)), "heating_utilisation").estimate.value for one in (slews, both)
    ]
    assert used[0] == pytest.approx(used[1], rel=1e-12)
