"""A travelling crane as a file writes it: what it says, and what it answers where something is wrong."""

from typing import Any

import pytest
import yaml
from support.travelling import BRIDGE, crane, crane_of

from ptmcalc.base.diagnostic import Diagnostic
from ptmcalc.engine.load import load_text

BUFFERS = {"type": "linear", "stiffness": "100 kN/m", "stroke": "150 mm"}


def problems(data: dict[str, Any]) -> list[Diagnostic]:
    return list(load_text(yaml.safe_dump(data, sort_keys=False).encode(), "case.yaml").diagnostics)


def faulty(data: dict[str, Any], *path: str | int) -> Diagnostic:
    """The only error of a file, at a place that has a line."""
    found = [one for one in problems(data) if one.severity == "error"]
    assert [one.path for one in found] == [path], [(one.path, one.message) for one in found]
    assert found[0].span is not None
    assert found[0].hint
    return found[0]


def test_the_bridge_crane_is_sound() -> None:
    assert problems(BRIDGE) == []
    assert [scene.label for scene in crane_of(BRIDGE).all_scenes] == ["start_loaded"]


def test_scenes_come_from_what_the_file_has() -> None:
    data = crane(
        scenes=None,
        suspension__hoist_speed="0.1 m/s",
        buffers=BUFFERS,
        rail__step="1 mm",
        guide={"clearance": "20 mm"},
        wind={"area": "20 m^2", "pressure": "50 Pa", "pressure_storm": "500 Pa"},
        runway={"edition": "EN 1991-3:2006"},
    )
    labels = [scene.type for scene in crane_of(data).all_scenes]
    assert labels == [
        "run", "start", "start", "brake", "brake", "hoist_while_travelling", "collision", "rail_step", "skew", "storm",
        "runway",
    ]  # fmt: skip


@pytest.mark.parametrize("key", ["nearest", "farthest"])
def test_a_trolley_beyond_the_bridge(key: str) -> None:
    found = faulty(
        crane(**{f"trolley__{key}": "30 m"}, **({"trolley__farthest": None} if key == "nearest" else {})),
        "trolley",
        key,
    )
    assert "beyond the bridge" in found.message
    assert f"{key}: 21.4 m" in found.hint


def test_a_trolley_before_the_bridge_unless_on_a_cantilever() -> None:
    assert "beyond the bridge" in faulty(crane(trolley__nearest="-3 m"), "trolley", "nearest").message
    reach = {"trolley__nearest": "-3 m", "trolley__farthest": "26 m"}
    assert problems(crane(travels="gantry", bridge__cantilever_a="4 m", bridge__cantilever_b="4 m", **reach)) == []


def test_a_trolley_that_stops_before_it_starts() -> None:
    found = faulty(crane(trolley__nearest="15 m", trolley__farthest="3 m"), "trolley", "farthest")
    assert "closer to rail A" in found.message


def test_a_trolley_only_on_the_far_half() -> None:
    assert "farthest" in faulty(crane(trolley__nearest="15 m", trolley__farthest=None), "trolley", "nearest").hint


def test_a_centre_of_gravity_beyond_the_bridge() -> None:
    assert "beyond the bridge" in faulty(crane(bridge__centre="30 m"), "bridge", "centre").message


@pytest.mark.parametrize(("path", "value"), [("load", "-1 t"), ("load", "0 t"), ("speed", "0 m/s")])
def test_numbers_out_of_range(path: str, value: str) -> None:
    assert faulty(crane(**{path: value}), path).code == "SPC110"


def test_a_negative_area_in_the_wind() -> None:
    found = faulty(crane(wind={"area": "-5 m^2", "pressure": "100 Pa"}), "wind", "area")
    assert found.code == "SPC110"
    assert "at least 0 m^2" in found.hint


@pytest.mark.parametrize("value", ["nan m", ".inf", "1e300 m", "0 m"])
def test_a_wheel_without_a_size(value: str) -> None:
    assert faulty(crane(wheels__diameter=value), "wheels", "diameter").hint


def test_winds_rise() -> None:
    found = faulty(
        crane(wind={"area": "5 m^2", "pressure": "300 Pa", "pressure_max": "100 Pa"}), "wind", "pressure_max"
    )
    assert "below" in found.message


def test_a_bridge_crane_without_its_bridge() -> None:
    assert "needs its `bridge`" in faulty(crane(bridge=None)).message


def test_a_trolley_has_no_bridge() -> None:
    data = crane(travels="trolley", trolley={"mass": "2 t", "gauge": "2 m"})
    assert faulty(data, "bridge").hint == "delete `bridge`"


def test_a_trolley_needs_its_gauge() -> None:
    data = crane(travels="trolley", bridge=None, trolley={"mass": "2 t"})
    assert "gauge: 2 m" in faulty(data, "trolley").hint


def test_nothing_stops_it() -> None:
    found = faulty(crane(drive__brake=None, drive__deceleration=None), "drive")
    assert "the machine has no brake" in found.message


def test_a_brake_that_is_not_there() -> None:
    data = crane(drive__brake=None, scenes=[{"type": "brake", "by": "brake"}])
    assert "no `brake`" in faulty(data, "scenes", 0).message


@pytest.mark.parametrize(
    ("scene", "key"),
    [
        ("collision", "buffers"),
        ("storm", "wind.pressure_storm"),
        ("hoist_while_travelling", "hoist_speed"),
        ("skew", "guide"),
        ("runway", "runway"),
    ],
)
def test_scenes_that_lack_something(scene: str, key: str) -> None:
    assert key in faulty(crane(scenes=[{"type": scene}]), "scenes", 0).message


def test_a_rail_without_steps() -> None:
    assert "neither `step` nor `gap`" in faulty(crane(scenes=[{"type": "rail_step"}]), "scenes", 0).message


def test_hoisting_through_the_trolley() -> None:
    data = crane(suspension__hoist_speed="1 m/s", scenes=[{"type": "hoist_while_travelling", "time": "20 s"}])
    found = faulty(data, "scenes", 0, "time")
    assert "time: 7.2 s" in found.hint


@pytest.mark.parametrize(
    ("changes", "path"),
    [
        ({"stiffness": None}, ("buffers",)),
        ({"force": "20 kN"}, ("buffers", "force")),
        ({"type": "hydraulic"}, ("buffers",)),
    ],
)
def test_each_buffer_has_its_own_number(changes: dict[str, Any], path: tuple[str, ...]) -> None:
    buffers = {key: value for key, value in {**BUFFERS, **changes}.items() if value is not None}
    found = [one.path for one in problems(crane(buffers=buffers)) if one.severity == "error"]
    assert path in found


def test_corners_have_names() -> None:
    assert faulty(crane(wheels__driven=["A1", "C1"]), "wheels", "driven", 1).code == "SPC112"
    assert "named twice" in faulty(crane(wheels__driven=["A1", "A1"]), "wheels", "driven", 1).message


def test_more_driven_wheels_than_wheels() -> None:
    assert "1 wheel only" in faulty(crane(wheels__driven_per_corner=2), "wheels", "driven_per_corner").message


def test_resistance_in_two_ways() -> None:
    assert "not both" in faulty(crane(rolling__lever_arm="0.5 mm"), "rolling", "lever_arm").message
    assert "part of the `coefficient`" in faulty(crane(rolling__flange_factor=1.5), "rolling", "flange_factor").message


def test_speeds_that_do_not_fit() -> None:
    found = [one for one in problems(crane(drive__motor__speed="2800 rpm")) if one.severity == "warning"]
    assert [one.path for one in found] == [("speed",)]
    assert "a travel speed of 2.099 m/s" in found[0].message


def test_all_problems_at_once() -> None:
    data = crane(load="-1 t", wheels__diameter="0 m", trolley__nearest="40 m", trolley__farthest="50 m", rail__slope=2)
    paths = {one.path for one in problems(data)}
    assert {
        ("load",),
        ("wheels", "diameter"),
        ("trolley", "nearest"),
        ("trolley", "farthest"),
        ("rail", "slope"),
    } <= paths


def test_a_gear_that_locks_itself() -> None:
    found = faulty(crane(drive__gear__efficiency=0.45), "drive", "gear", "efficiency")
    assert "self-locking" in found.message
    assert problems(crane(drive__gear={"ratio": 22, "efficiency": 0.45, "reverse_efficiency": 0.2})) == []
    negative = crane(drive__gear={"ratio": 22, "efficiency": 0.45, "reverse_efficiency": -0.2})
    assert faulty(negative, "drive", "gear", "reverse_efficiency").code == "SPC110"


RUNWAY = {"edition": "EN 1991-3:2006"}


def test_a_runway_needs_its_edition() -> None:
    assert "edition: EN 1991-3:2006" in faulty(crane(runway={"fatigue_class": "S3"}), "runway", "edition").hint
    assert "EN 1991-3:2006" in faulty(crane(runway={"edition": "EN 1991-3:2026"}), "runway", "edition").hint


def test_a_trolley_has_no_runway() -> None:
    data = crane(travels="trolley", bridge=None, trolley={"mass": "2 t", "gauge": "2 m"}, runway=RUNWAY)
    assert "bridge or gantry" in faulty(data, "runway").message


@pytest.mark.parametrize("key", ["load", "trolley"])
def test_a_runway_is_of_all_loads_and_positions(key: str) -> None:
    scene = {"type": "runway", key: {"load": "empty", "trolley": "near"}[key]}
    assert faulty(crane(runway=RUNWAY, scenes=[scene]), "scenes", 0, key).hint == f"delete `{key}`"


def test_a_fatigue_factor_needs_its_class() -> None:
    found = faulty(crane(runway=RUNWAY | {"fatigue_factor": "larger"}), "runway", "fatigue_factor")
    assert "fatigue_class: S3" in found.hint


@pytest.mark.parametrize(
    ("key", "value"),
    [("phi1", 0), ("phi2", -1), ("phi3", 2), ("phi4", 11), ("phi5", "1 m"), ("phi6", "x"), ("phi7", 0),
     ("skew_angle", "0 rad"), ("skew_angle", "1 m"), ("speed_share", 0), ("speed_share", 2), ("K_with_phi", 3),
     ("contact", "wood"), ("fatigue_class", "S10"), ("fatigue_factor", 2), ("suspension", "stiff")],
)  # fmt: skip
def test_values_of_a_runway_out_of_range(key: str, value: object) -> None:
    faulty(crane(runway=RUNWAY | {"fatigue_class": "S3", key: value}), "runway", key)


def test_a_least_clearance_of_the_runway() -> None:
    """EN 1991-3 has a least clearance where EN 13001-2 takes the stated one; with the angle there is none."""
    data = crane(guide={"clearance": "4 mm"}, runway=RUNWAY)

    def told(data: dict[str, Any]) -> list[str]:
        return [one.hint for one in problems(data) if one.path == ("guide", "clearance")]

    assert any("skew_angle" in hint for hint in told(data))
    assert told(data | {"runway": RUNWAY | {"skew_angle": "0.003 rad"}}) == []
