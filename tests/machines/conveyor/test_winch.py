"""Take-up by a winch: it keeps the leaving tension in steady running and the length of the belt in starts and stops."""

from dataclasses import replace
from typing import Any

import pytest
import yaml
from support.belt_scenes import Brake, Drive, Rig, loads_of
from support.machines import changed, check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.engine.load import load_text

RIG = Rig(
    sections=((200.0, 5.0), (300.0, 24.0)),
    drives={"head": Drive(friction=None)},
    tension=90e3,
    brakes=(Brake(14e3, 0.3, 0.5),),
)


def mean_tension(rig: Rig, loaded: str) -> float:
    """Mean of the tensions of the running belt with the leaving tension of the winch [N]."""
    area = length = 0.0
    tension = rig.tension
    for part in rig.lengths(loaded):
        rise = part.length * (part.friction + part.climb)
        area, length, tension = area + part.length * (tension + rise / 2), length + part.length, tension + rise
    return area / length


def winched(*scenes: dict[str, Any], **takeup: Any) -> dict[str, Any]:
    data = changed(RIG.data(*scenes, accuracy="1 %"), resistance__stop_factor=1)
    return data | {"takeup": {"type": "winch", "tension": f"{RIG.tension} N", "deviation": 0} | takeup}


@pytest.mark.parametrize("loaded", ["full", "empty"])
def test_it_keeps_the_leaving_tension_in_steady_running(loaded: str) -> None:
    scene = scene_of(report_of(winched({"type": "run", "load": loaded})))
    assert load_of(scene, "tension_run_off_min").estimate.value == pytest.approx(RIG.tension, rel=1e-12)
    on = RIG.tension + RIG.resistance(loaded)
    assert load_of(scene, "tension_run_on_max").estimate.value == pytest.approx(on, rel=1e-9)


@pytest.mark.parametrize("loaded", ["full", "empty"])
def test_a_stop_is_that_of_a_belt_of_fixed_length(loaded: str) -> None:
    scene = scene_of(report_of(winched({"type": "stop", "load": loaded})))
    window = load_of(scene, "tension_max").window
    assert window is not None
    fixed = replace(RIG, rigid=True, tension=mean_tension(RIG, loaded))
    right = loads_of(fixed, fixed.stopped(window[1], 400, loaded)).loads
    for name in ("tension_run_on_max", "tension_run_off_min", "tension_max", "tension_min", "stop_distance"):
        one = load_of(scene, name).estimate
        assert one.bounded, name
        assert one.low - 0.005 * abs(right[name]) <= right[name] <= one.high + 0.005 * abs(right[name]), name


def test_a_start_is_that_of_a_screw_with_the_tension_of_the_running_belt() -> None:
    rise = {"type": "start", "profile": {"shape": "ramp", "time": "8 s"}}
    scene = scene_of(report_of(winched(rise)))
    screw = RIG.data(rise, accuracy="1 %") | {"takeup": {"type": "rigid", "tension": f"{mean_tension(RIG, 'full')} N"}}
    same = scene_of(report_of(changed(screw, resistance__stop_factor=1)))
    for name in ("tension_run_on_max", "tension_run_off_min", "tension_max", "tension_min"):
        value = load_of(same, name).estimate.value
        assert load_of(scene, name).estimate.value == pytest.approx(value, rel=1e-9), name


def test_the_dead_band_is_tried_at_both_ends() -> None:
    """A low tension at which the belt sags too much only at the lower end of the dead band."""
    sags = {"carry": {"pitch": "1.2 m", "set_mass": "20 kg"}, "return": {"pitch": "3 m", "set_mass": "20 kg"}}

    def judged(**takeup: Any) -> Verdict:
        data = winched({"type": "run"}, **takeup) | {"idlers": sags, "checks": {"sag": "0.25 %"}}
        takeup = data["takeup"]
        if "deviation" in takeup and takeup["deviation"] is None:
            del takeup["deviation"]
        return check_of(scene_of(report_of(data)), "CNV103").verdict

    assert judged() is Verdict.PASS
    assert judged(deviation=-0.1) is Verdict.FAIL
    assert judged(deviation=None) is Verdict.UNDECIDED
    assert judged(deviation=None, dead_band=0.01) is Verdict.PASS


@pytest.mark.parametrize(
    ("takeup", "told"),
    [
        ({"at": "tail"}, "leaving tension of the drive pulley"),
        ({"mass": "3000 kg"}, "does not move"),
        ({"position": "1 m", "stroke": "3 m"}, "no weight with a position"),
        ({"type": "gravity"}, "only a winch has it"),
    ],
)
def test_what_a_winch_does_not_have(takeup: dict[str, Any], told: str) -> None:
    text = yaml.safe_dump(winched({"type": "run"}, **takeup), sort_keys=False)
    assert any(told in one.message for one in load_text(text.encode(), "case.yaml").diagnostics)
