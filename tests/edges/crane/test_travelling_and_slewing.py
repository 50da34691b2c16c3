"""Edges at which travelling and slewing cranes once passed, or were told without saying so; right values by a sum or an
integration of its own."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from scipy.integrate import quad, solve_ivp
from support.machines import changed, load_of, loaded, report_of
from support.random_machines import written

from ptmcalc.contract.report import FileReport, SceneReport
from ptmcalc.engine.registry import load_kind

HERE = Path(__file__).parent
BRIDGE: dict[str, Any] = {
    "kind": "crane",
    "type": "travelling",
    "load": "10 t",
    "hook_block": "250 kg",
    "bridge": {"mass": "13 t", "span": "22.5 m", "height": "0.6 m"},
    "trolley": {"mass": "2.2 t", "nearest": "1.1 m", "farthest": "21.2 m", "height": "1.1 m"},
    "wheels": {
        "diameter": "315 mm",
        "base": "3.6 m",
        "driven": ["A1", "B1"],
        "rating": "120 kN",
        "inertia": "0 kg*m^2",
    },
    "rolling": {"coefficient": 0.008},
    "rail": {"adhesion": 0.14},
    "speed": "63 m/min",
    "drive": {
        "motor": {
            "count": 2,
            "inertia": "0.006 kg*m^2",
            "coupling_inertia": "0.002 kg*m^2",
            "mean_starting_torque": "32 N*m",
        },
        "gear": {"ratio": 22, "efficiency": 0.9},
        "brake": {"torque": "16 N*m", "delay": "0.1 s", "rise_time": "0.1 s"},
        "acceleration": "0.13 m/s^2",
        "deceleration": "0.15 m/s^2",
    },
    "suspension": {"length": "8 m"},
    "buffers": {"type": "linear", "count": 2, "stiffness": "400 kN/m", "stroke": "1 m", "rating": "500 kN"},
}
ROTORS = 2 * 0.008 * 22**2 * 0.9 / 0.1575**2


def file(name: str) -> dict[str, Any]:
    data = yaml.load((HERE / f"{name}.yaml").read_text("utf-8"), yaml.BaseLoader)
    assert isinstance(data, dict)
    plain = yaml.safe_load(written(data))  # `on` and `off` stay words
    assert isinstance(plain, dict)
    return plain


def scene(report: FileReport, label: str) -> SceneReport:
    return next(one for one in report.scenes if one.name == label)


def verdicts(report: FileReport) -> dict[tuple[str, str], str]:
    return {(one.name, judged.code): judged.verdict.value for one, judged in report.judgements}


# -- buffers ---------------------------------------------------------------------------------------------------------


def on_buffers(place: float, guided: bool, load: float = 10250.0) -> tuple[float, float]:
    """Largest force of a buffer [N] and the force of an even split: an even rod, a point for the trolley."""
    span, speed, c = 22.5, 1.05, 4e5
    parts = [(13000.0, 0.5, 1 / 12), (2200.0, place / span, 0.0), (ROTORS / 2, 0.0, 0.0), (ROTORS / 2, 1.0, 0.0)]
    if guided:
        parts.append((load, place / span, 0.0))
    mass = np.zeros((2, 2))
    for m, x, spread in parts:
        mass += m * (np.outer([1 - x, x], [1 - x, x]) + spread * np.array([[1, -1], [-1, 1]]))
    inverse, share = np.linalg.inv(mass), np.array([1 - place / span, place / span])
    swings, omega = (0.0 if guided else load), math.sqrt(9.81 / 8)

    def rates(t: float, y: Any) -> Any:
        lean = omega**2 * (y[2] - share @ y[:2])
        return [*y[3:], *(inverse @ (share * swings * lean - c * np.maximum(y[:2], 0.0))), -lean]

    run: Any = solve_ivp(rates, (0.0, 0.6), [0.0] * 3 + [speed] * 3, rtol=1e-10, atol=1e-12, max_step=5e-4)
    return c * float(run.y[:2].max()), speed * math.sqrt(c * mass.sum() / 2)


@pytest.mark.parametrize(("suspension", "more"), [("swinging", 1.12), ("guided", 1.35)])
def test_a_buffer_beside_the_trolley_takes_more_than_half(suspension: str, more: float) -> None:
    data = BRIDGE | {"scenes": [{"type": "collision", "suspension": suspension}]}
    force = load_of(scene(report_of(data), "collision_loaded"), "buffer_force").estimate
    places = [on_buffers(place, suspension == "guided") for place in (1.1, 21.2)]
    right, even = max(places)
    assert force.value == pytest.approx(right, rel=1e-5)
    assert force.low <= right * (1 + 1e-6)
    assert force.high >= right * (1 - 1e-6)
    assert right / even == pytest.approx(more, abs=0.02)


def test_the_load_that_swings_pulls_as_the_crane_stops() -> None:
    data = BRIDGE | {"scenes": [{"type": "collision", "trolley": "middle"}, {"type": "collision", "load": "empty"}]}
    report = report_of(changed(data, hook_block="0 kg", scenes__1__trolley="middle"))
    loaded_force, empty = (load_of(one, "buffer_force").estimate.value for one in report.scenes)
    assert 1.001 < loaded_force / empty < 1.01


def test_buffers_that_bottom_out_beside_the_trolley_fail() -> None:
    """An even split would need 146 mm of the stroke of 150 mm."""
    data = changed(BRIDGE, buffers__stroke="150 mm") | {"scenes": [{"type": "collision"}]}
    assert verdicts(report_of(data))["collision_loaded", "CRN170"] == "fail"


# -- skewing ---------------------------------------------------------------------------------------------------------


def test_the_wear_of_the_guide_is_assumed_at_a_tenth_of_the_rail() -> None:
    data = BRIDGE | {"guide": {"clearance": "20 mm"}, "scenes": [{"type": "skew"}]}
    new = load_of(scene(report_of(changed(data, guide__wear="0 mm")), "skew_loaded"), "skew_force").estimate.value
    worn = load_of(scene(report_of(data), "skew_loaded"), "skew_force").estimate.value
    assert new == pytest.approx(27.16e3, rel=1e-3)
    assert worn == pytest.approx(30.18e3, rel=1e-3)
    grows = [1 - math.exp(-250 * (0.015 / 3.6 + wear / 3.6 + 0.001)) for wear in (0.0, 0.005)]
    assert worn / new == pytest.approx(grows[1] / grows[0], rel=1e-6)
    assumed = next(one for one in loaded(data).assumed if one.path == ("guide", "wear"))
    assert assumed.interval.low <= 0.005 <= assumed.interval.high


def test_a_play_below_the_least_of_the_standard_is_told() -> None:
    report = report_of(file("silent_least_play"))
    told = next(one for one in report.diagnostics if one.path == ("guide", "clearance"))
    assert "0 mm of clearance is below the minimum" in told.message
    assert "10 mm" in told.message


# -- effects that a file forces on -----------------------------------------------------------------------------------


def test_a_forced_effect_takes_no_verdict_away() -> None:
    data = file("forced_effect_loses_bound")
    forced, free = (verdicts(report_of(one, ends=False)) for one in (data | {"effects": {"large_sway": "on"}}, data))
    assert forced == free
    assert "undecided" not in forced.values()


def test_a_rigid_slewing_crane_starts_along_the_curve_of_its_motor() -> None:
    data = file("motor_curve_on_is_bounded")
    found = load_of(report_of(data).scenes[0], "start_time")
    slip, overload = 0.06, 2.4
    rated, no_load = 1100 / (940 * math.pi / 30), 1000 * math.pi / 30
    ends = data["motor"]["curve"]
    assert (ends["speed"], ends["overload"]) == ("940 rpm", overload)
    spec = loaded(data).spec
    assert spec is not None
    curve = spec.value_at(("motor", "curve"))
    assert float(curve.torque(940 * math.pi / 30)) == pytest.approx(rated, rel=1e-9)
    assert slip == pytest.approx(1 - 940 * math.pi / 30 / no_load)
    inertia = 95000 + 0.7 * 610**2 * 0.055 * 1.15
    whole = quad(lambda w: inertia / (0.7 * 610 * float(curve.torque(610 * w)) - 2900), 0.0, 0.158143997404)[0]
    assert whole == pytest.approx(3.3222, rel=2e-5)
    assert found.estimate.value == pytest.approx(whole, rel=1e-8)
    assert found.estimate.bounded


# -- motors, grip, stability -----------------------------------------------------------------------------------------


def test_a_travel_motor_is_judged_by_the_least_of_its_curve() -> None:
    """Strong at rest, weaker than the resistance at speed: the mean would start the crane."""
    points = [{"speed": "0 rpm", "torque": "60 N*m"}, {"speed": "1500 rpm", "torque": "1 N*m"}]
    data = changed(BRIDGE, drive__motor__mean_starting_torque=None, drive__acceleration=None)
    data = changed(data, drive__motor__curve={"type": "table", "points": points}, rail__adhesion=0.5)
    found = verdicts(report_of(data | {"scenes": [{"type": "run"}, {"type": "start"}]}))
    assert found["run_loaded", "CRN160"] == found["start_loaded", "CRN160"] == "fail"
    assert found["start_loaded", "CRN150"] == "fail"


def test_the_mean_of_a_curve_starts_no_empty_crane() -> None:
    """With nothing on its rope no solver follows the curve: nothing is said of the time."""
    points = [{"speed": f"{n} rpm", "torque": f"{m} N*m"} for n, m in ((0, 45), (900, 10), (1400, 45))]
    curve = {"type": "table", "points": points}
    data = changed(BRIDGE, drive__motor__curve=curve, drive__acceleration=None)
    data = changed(data, drive__motor__mean_starting_torque=None, hook_block="0 kg", rail__adhesion=0.5)
    (scene,) = report_of(data | {"scenes": [{"type": "start", "load": "empty"}]}).scenes
    assert not load_of(scene, "start_time").estimate.bounded
    assert {one.verdict.value for one in scene.checks if one.code == "CRN150"} == {"undecided"}


def test_wheels_that_slide_fail_whatever_reserve_the_file_asks() -> None:
    data = changed(BRIDGE, drive__acceleration="0.9 m/s^2", checks={"skid_reserve": 0.1})
    report = report_of(data | {"scenes": [{"type": "start"}]})
    assert verdicts(report)["start_loaded", "CRN155"] == "fail"


def test_a_load_on_a_cantilever_tips_with_its_partial_factors() -> None:
    """The moments alone are in balance at 1.2; with 1.34 on the load and 0.9 on what helps the crane tips."""
    gantry = changed(BRIDGE, travels="gantry", bridge__cantilever_a="6 m", trolley__nearest="-5 m")
    gantry = changed(gantry, bridge__span="10 m", trolley__farthest="9 m", rail__adhesion=0.14)
    gantry["scenes"] = [{"type": "run", "trolley": "near"}]
    gantry = changed(gantry, bridge__mass="15 t", buffers=None)
    found = load_of(report_of(gantry).scenes[0], "stability_reserve").estimate.value
    assert found == pytest.approx(0.9 * 15000 * 5 / (1.22 * 2200 * 5 + 1.34 * 10250 * 5), rel=1e-9)
    assert pytest.approx(1.2, abs=0.01) == 15000 * 5 / (12450 * 5)
    told = verdicts(report_of(gantry))
    assert told["run_loaded", "CRN159"] == "fail"


# -- scenes nobody asked for -----------------------------------------------------------------------------------------


def test_cranes_start_and_stop_loaded_and_empty() -> None:
    labels = {one.name for one in report_of({k: v for k, v in BRIDGE.items() if k != "buffers"}).scenes}
    assert {"start_loaded", "start_empty", "brake_loaded", "brake_empty"} <= labels
    slewing = next(one for one in load_kind("crane").manifests if one.type == "slewing")
    labels = {one.name for one in report_of(yaml.safe_load(slewing.template)).scenes}
    assert labels == {"slew_loaded", "slew_empty"}
