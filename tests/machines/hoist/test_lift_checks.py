"""Checks of a lift: editions of the standard, empty hooks, stalls; names of scenes."""

from typing import Any

import pytest
from support.hoists import PAPER, hoist_of
from support.machines import changed, check_of, load_of, loaded, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict

LIFT = changed(PAPER, scenes=[{"type": "lift"}], **{"class": {"mechanism": "M5", "hoisting": "HC2", "drive": "HD1"}})
SPEED = 12 * 2 * 3.141592653589793 / 60 * 0.15875 / 4
"""Of the hook."""
SHORT = 0.1
"""Predicted seconds: no run of the finest solvers, which the factor of a standard does not need."""


def factor(data: dict[str, Any]) -> float:
    formulas = load_of(scene_of(report_of(data, budget=SHORT)), "lift_off_factor").formulas
    return next(one.value for one in formulas if one.name == "standard_phi2")


@pytest.mark.parametrize(
    ("drive", "edition", "combination", "least", "speed"),
    [
        ("HD1", "by_class", "regular", 1.10, 1.0),
        ("HD1", "by_drive", "regular", 1.10, 1.0),
        ("HD1", "raised", "regular", 1.20, 1.0),
        ("HD4", "raised", "regular", 1.10, 0.5),
        ("HD5", "by_class", "regular", 1.10, 0.0),
        ("HD5", "by_drive", "regular", 1.05, 0.0),
        ("HD5", "by_drive", "exceptional", 1.05, 0.5),
        ("HD4", "by_class", "exceptional", 1.10, 1.0),
    ],
)
def test_the_edition_and_the_combination_of_the_file_count(
    drive: str, edition: str, combination: str, least: float, speed: float
) -> None:
    given = {"hoisting": "HC2", "drive": drive, "edition": edition, "combination": combination}
    data = changed(LIFT, **{"class": given})
    assert factor(data) == pytest.approx(least + 0.34 * speed * SPEED, rel=1e-9)
    scene = scene_of(report_of(data, budget=SHORT))
    assert check_of(scene, "HST120").limit.value == pytest.approx(factor(data), rel=1e-12)


@pytest.mark.parametrize(("drive", "differ"), [("HD1", False), ("HD2", False), ("HD5", True)])
def test_editions_that_differ_are_told_where_the_file_names_none(drive: str, differ: bool) -> None:
    speed = {"drum": "12 rpm", "creep": "0.002 m/s"}
    data = changed(LIFT, speed=speed, **{"class": {"hoisting": "HC2", "drive": drive}})
    assert any("editions" in one.message for one in loaded(data).diagnostics) is differ
    data["class"]["edition"] = "by_class"
    assert not any("editions" in one.message for one in loaded(data).diagnostics)


def test_the_factor_is_not_asked_of_an_empty_hook() -> None:
    scene = scene_of(report_of(changed(LIFT, hook_block="60 kg", scenes=[{"type": "lift", "load": "empty"}])))
    assert [one.code for one in scene.checks] == ["HST121"]


def test_a_stall_fails_once_and_says_what_would_lift() -> None:
    known = changed(LIFT, gearbox__reverse_efficiency=0.913, gearbox__damping=0.03, brake__delay="0 s")
    report = report_of(changed(known, motor__mean_starting_torque="20 N*m"), repairs=True)
    scene = scene_of(report)
    assert [one.code for one in scene.checks] == ["HST121"]
    check = check_of(scene, "HST121")
    assert check.verdict is Verdict.FAIL
    assert check.repair is not None
    torque = check.repair.value
    lifted = scene_of(report_of(changed(known, motor__mean_starting_torque=f"{torque} N*m")))
    assert check_of(lifted, "HST121").verdict is Verdict.PASS
    assert "stalls" in check.reason
    assert not any("stalls" in one.message for one in report.diagnostics)


@pytest.mark.parametrize("structure", [None, {"stiffness": "2 MN/m", "mass": "900 kg"}])
def test_a_stall_is_told_once_whatever_solvers_meet_it(structure: dict[str, str] | None) -> None:
    gear = {"ratio": 80, "efficiency": 0.92, "stiffness": "400 kN*m/rad"}
    data = changed(LIFT, motor__mean_starting_torque="20 N*m", structure=structure, gearbox=gear)
    report = report_of(data)
    assert [one.code for _, one in report.judgements if "stalls" in one.reason] == ["HST121"]
    assert not any("stalls" in one.message for one in report.diagnostics)


def test_scenes_up_and_down_have_names_of_their_own() -> None:
    scenes = [{"type": what, "direction": way} for what in ("start", "stop") for way in ("up", "down")]
    labels = [scene.label for scene in hoist_of(changed(PAPER, scenes=scenes)).all_scenes]
    assert labels == ["start_loaded", "start_down_loaded", "stop_loaded", "stop_down_loaded"]


@pytest.mark.parametrize(
    ("structure", "hoisting"), [("10 MN/m", "HC4"), ("200 kN/m", "HC3"), ("100 kN/m", "HC2"), ("50 kN/m", "HC1")]
)
def test_the_stretch_under_the_load_gives_a_class_too(structure: str, hoisting: str) -> None:
    data = changed(LIFT, structure={"stiffness": structure})
    formulas = load_of(scene_of(report_of(data, budget=SHORT)), "lift_off_factor").formulas
    found = next(one.value for one in formulas if one.name == "phi2_by_deflection")
    assert found == pytest.approx(factor(changed(data, class__hoisting=hoisting)), rel=1e-12)
