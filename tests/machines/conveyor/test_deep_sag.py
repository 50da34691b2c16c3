"""Belts that sag on the way: nonlinear elements with sag agree, and beyond the parabola what came before is certain."""

import math
from dataclasses import replace
from typing import Any

import pytest
from support.belt_scenes import Brake, Drive, Rig
from support.machines import changed, check_of, load_of, report_of, scene_of
from support.sagging_scenes import swing

from ptmcalc.base.diagnostic import Verdict

PITCHES = (1.2, 3.0)
BRAKED = Rig(
    sections=((500.0, 10.0),), drives={"head": Drive(torque=2400.0)}, brakes=(Brake(30e3, 0.3, 0.5),), tension=45e3
)


def data_of(rig: Rig, scene: dict[str, Any], **more: Any) -> dict[str, Any]:
    data = rig.data(scene, **more)
    data["belt"] |= {"breaking_force": "3 MN", "carcass": "textile"}
    for row, pitch in zip(("carry", "return"), PITCHES, strict=True):
        data["idlers"][row]["pitch"] = f"{pitch!r} m"
    return data


@pytest.mark.parametrize("rigid", [False, True], ids=["gravity", "rigid"])
def test_a_belt_that_sags_deep_is_simulated_and_elements_with_sag_agree(rigid: bool) -> None:
    rig = replace(BRAKED, rigid=rigid, tension=52e3 if rigid else 62e3, drives={"head": Drive(2400.0, friction=None)})
    data = changed(data_of(rig, {"type": "stop"}), belt__damping={"model": "kelvin_voigt", "time": "20 ms"})
    report = report_of(data)
    assert not [d for d in report.diagnostics if d.code == "NUM102"]
    high, low = (load_of(scene_of(report), name).estimate for name in ("tension_max", "tension_min"))
    straight, truth = (
        swing(rig, PITCHES, 6.0, 200, sags=sags, force=None, relaxed=False, retardation=0.02) for sags in (False, True)
    )
    assert low.low < truth.lowest < low.high
    assert high.low < truth.highest < high.high
    assert abs(low.value - truth.lowest) < 0.05 * truth.lowest
    assert abs(straight.lowest - truth.lowest) > 2 * abs(low.value - truth.lowest), "sag does matter here"


@pytest.mark.parametrize("rigid", [False, True], ids=["gravity", "rigid"])
def test_what_came_before_it_sagged_too_deep_is_certain(rigid: bool) -> None:
    rig = replace(BRAKED, rigid=rigid, tension=22e3 if rigid else 30e3, drives={"head": Drive(2400.0, friction=None)})
    report = report_of(data_of(rig, {"type": "stop"}))
    scene = scene_of(report)
    (said,) = [d for d in report.diagnostics if d.code == "NUM102"]
    assert "are reliable" in said.message
    high, low, margin = (load_of(scene, name).estimate for name in ("tension_max", "tension_min", "slack_margin_min"))
    assert high.high == math.inf
    assert low.low == margin.low == -math.inf
    truth = swing(rig, PITCHES, 6.0, 200, sags=True, force=None, relaxed=False)
    assert 0 < truth.lowest < low.high
    assert 0.75 * truth.run_on < high.low < 1.01 * truth.highest


def test_a_belt_that_is_torn_before_it_sags_is_torn() -> None:
    """The check was left open although no later moment can mend it."""
    rig = replace(BRAKED, tension=30e3, drives={"head": Drive(2400.0, friction=None)})
    data = changed(data_of(rig, {"type": "stop"}), belt__breaking_force="150 kN")
    assert check_of(scene_of(report_of(data)), "CNV102").verdict is Verdict.FAIL
    assert check_of(scene_of(report_of(changed(data, belt__breaking_force="3 MN"))), "CNV102").verdict is (
        Verdict.UNDECIDED
    )


def test_a_jam_that_leaves_the_belt_slack_at_once_says_that_no_peak_is_certain() -> None:
    rig = Rig(sections=((500.0, 10.0),), drives={"head": Drive(torque=2400.0)}, tension=45e3)
    report = report_of(data_of(rig, {"type": "jam", "at": "tail"}))
    (said,) = [d for d in report.diagnostics if d.code == "NUM102"]
    assert "goes slack" in said.message
    assert said.path == ("takeup", "tension")
    assert said.span is not None
    slack = check_of(scene_of(report), "CNV105")
    assert slack.verdict is Verdict.FAIL, "it is slack beyond doubt, whatever its peaks are"
    assert "higher `tension`" in slack.reason
    assert load_of(scene_of(report), "tension_max").estimate.high == math.inf


def test_with_the_tension_that_is_asked_for_the_belt_is_simulated_to_the_end() -> None:
    report = report_of(changed(data_of(BRAKED, {"type": "stop"}), takeup__tension="200 kN"))
    assert not [d for d in report.diagnostics if d.code == "NUM102"]
    assert check_of(scene_of(report), "CNV102").verdict is Verdict.PASS
