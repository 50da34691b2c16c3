"""Start profiles by points: what is missing or out of order, where it is blamed, and what would do."""

import pytest

from ptmcalc.base.span import dotted
from ptmcalc.engine.load import load_text
from ptmcalc.machines.conveyor.machine.scenes import Start
from ptmcalc.machines.conveyor.machine.spec import Conveyor

MACHINE = """\
kind: conveyor
route: {length: 200 m, lift: 10 m}
belt: {width: 800 mm, mass: 12 kg/m, stiffness: 4 MN}
idlers: {carry: {line_mass: 12 kg/m}, return: {line_mass: 5 kg/m}}
load: {mass: 80 kg/m}
resistance: {coefficient: 0.022, secondary: 1.4}
speed: 2 m/s
drive:
  motor: {inertia: 1 kg*m^2, mean_starting_torque: 900 N*m}
  gear: {ratio: 20}
  drum: {diameter: 600 mm, wrap: 200 deg, friction: 0.35}
takeup: {type: gravity, tension: 20 kN}
scenes:
  - type: start
    profile: PROFILE
"""
GOOD = "{shape: table, points: [{time: 0 s, share: 0}, {time: 3 s, share: 0.2}, {time: 9 s, share: 1}]}"
START = "scenes[0].profile"


def faults(profile: str) -> list[tuple[str, str, str]]:
    """Code, path and hint of what is wrong with a machine that starts so."""
    loaded = load_text(MACHINE.replace("PROFILE", profile).encode(), "belt.yaml")
    return [(one.code, dotted(one.path), one.hint) for one in loaded.diagnostics]


def start_of(profile: str) -> Start:
    loaded = load_text(MACHINE.replace("PROFILE", profile).encode(), "belt.yaml")
    assert isinstance(loaded.spec, Conveyor)
    (scene,) = loaded.spec.all_scenes
    assert isinstance(scene, Start)
    return scene


def test_a_table_is_of_speed_unless_it_says_torque() -> None:
    assert faults(GOOD) == []
    profile = start_of(GOOD).profile
    assert profile.imposes_speed
    assert profile.rise_time == 9
    assert profile.rise == ((0.0, 0.0), (3 / 9, 0.2), (1.0, 1.0))
    assert not start_of(GOOD.replace("points", "control: torque, points")).profile.imposes_speed


def test_a_torque_may_be_there_at_once() -> None:
    there = GOOD.replace("share: 0}", "share: 0.1}")
    assert faults(there) == [("SPC113", f"{START}.points[0].share", "write `share: 0`, or `control: torque`")]
    assert faults(there.replace("points", "control: torque, points")) == []


@pytest.mark.parametrize(
    ("old", "new", "path", "hint"),
    [
        ("time: 0 s", "time: 1 s", ".points[0].time", "write `time: 0 s`"),
        ("time: 3 s", "time: 9 s", ".points[2].time", "sort the points by time, and give each time once"),
        ("share: 0.2", "share: 0", ".points[2].share", ""),
        ("share: 1}", "share: 0.1}", ".points[2].share", "a start profile only increases: sort the shares"),
        ("share: 1}", "share: 0.9}", ".points[2].share", "write `share: 1`"),
        ("points", "time: 9 s, points", ".time", "delete `time`: the last point states it"),
        ("shape: table, ", "", ".points", "write `shape: table`"),
        ("table", "ramp, time: 9 s", ".points", "write `shape: table`"),
    ],
)
def test_a_fault_is_blamed_where_it_stands(old: str, new: str, path: str, hint: str) -> None:
    found = faults(GOOD.replace(old, new))
    if not hint:  # a plateau is no fault
        assert found == []
        return
    assert ("SPC113", START + path, hint) in found


def test_a_table_without_points_gets_some_to_copy() -> None:
    ((code, path, hint),) = faults("{shape: table}")
    assert (code, path) == ("SPC113", START)
    assert faults("{shape: table, " + hint.removeprefix("add `").removesuffix("`") + "}") == []


@pytest.mark.parametrize("share", ["1.2", "-0.1", "3 s", ".nan"])
def test_a_share_is_a_number_from_0_to_1(share: str) -> None:
    found = faults(GOOD.replace("share: 0.2", f"share: {share}"))
    assert [path for _, path, _ in found] == [f"{START}.points[1].share"]


def test_a_table_of_torque_can_be_broken_off_and_one_of_speed_cannot() -> None:
    aborted = GOOD + "\n    aborted: {run: 2 s}"
    assert [path for _, path, _ in faults(aborted)] == ["scenes[0].aborted"]
    assert faults(aborted.replace("points", "control: torque, points")) == []
