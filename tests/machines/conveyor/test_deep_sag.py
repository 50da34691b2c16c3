"""A belt that sags too deep on the way: what came before is certain, and nonlinear elements with sag agree."""

import math
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
def test_what_came_before_is_certain_and_elements_with_sag_agree(rigid: bool) -> None:
    rig = Rig(**{**vars(BRAKED), "rigid": rigid, "tension": 60e3 if rigid else 45e3})
    report = report_of(data_of(rig, {"type": "stop"}))
    scene = scene_of(report)
    (said,) = [d for d in report.diagnostics if d.code == "NUM102"]
    assert "is certain" in said.message
    high, low, margin = (load_of(scene, name).estimate for name in ("tension_max", "tension_min", "slack_margin_min"))
    assert high.high == math.inf
    assert low.low == margin.low == -math.inf
    truth = swing(rig, PITCHES, 6.0, 200, sags=True, force=None, relaxed=False)
    assert 0 < truth.lowest < low.high
    assert high.low < 1.01 * truth.highest, "elements know their ends half an element off"
    assert high.low > 0.9 * truth.highest, "the bound is no empty claim"


def test_a_belt_that_is_torn_before_it_sags_is_torn() -> None:
    """The check was left open although no later moment can mend it."""
    data = changed(data_of(BRAKED, {"type": "stop"}), belt__breaking_force="200 kN")
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
    assert check_of(scene_of(report), "CNV105").verdict is Verdict.UNDECIDED


def test_with_the_tension_that_is_asked_for_the_belt_is_simulated_to_the_end() -> None:
    report = report_of(changed(data_of(BRAKED, {"type": "stop"}), takeup__tension="200 kN"))
    assert not [d for d in report.diagnostics if d.code == "NUM102"]
    assert check_of(scene_of(report), "CNV102").verdict is Verdict.PASS
