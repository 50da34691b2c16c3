"""Bad input of stacker cranes: one clear message at its place, with a way out; all of them at once."""

import math
from typing import Any

import pytest
import yaml
from support.machines import changed, report_of

from ptmcalc.base.diagnostic import Diagnostic, Verdict
from ptmcalc.engine.load import load_text
from ptmcalc.engine.registry import load_kind

OVERHEAD, RACK = "overhead_stacker", "rack_stacker"


def template(word: str) -> dict[str, Any]:
    kind = next(one for one in load_kind("crane").types if one.type == word)
    data = yaml.safe_load(kind.template)
    assert isinstance(data, dict)
    return data


def faults(data: dict[str, Any]) -> list[Diagnostic]:
    """What is said of a file, each at a line and with a way out."""
    found = load_text(yaml.safe_dump(data, sort_keys=False).encode(), "case.yaml").diagnostics
    errors = [one for one in found if one.severity == "error"]
    assert all(one.span is not None and one.hint for one in errors)
    return errors


def only(word: str, **changes: Any) -> Diagnostic:
    found = faults(changed(template(word), **changes))
    assert len(found) == 1, [(one.code, one.message) for one in found]
    return found[0]


@pytest.mark.parametrize("word", [OVERHEAD, RACK])
def test_a_template_is_sound(word: str) -> None:
    assert faults(template(word)) == []


@pytest.mark.parametrize(
    ("word", "changes", "path", "says"),
    [
        (OVERHEAD, {"trolley__position": "17 m"}, ("trolley", "position"), "beyond the bridge"),
        (OVERHEAD, {"trolley__position": "16.5 m"}, ("trolley", "position"), "beyond the bridge"),
        (OVERHEAD, {"carriage__lowest": "0.2 m"}, ("carriage", "lowest"), "below the mast"),
        (OVERHEAD, {"column__foot": "0 m", "carriage__lowest": "-0.2 m"}, ("carriage", "lowest"), "at least 0 m"),
        (OVERHEAD, {"carriage__highest": "6.5 m"}, ("carriage", "highest"), "above the mast head at 6.3 m"),
        (RACK, {"carriage__lowest": "0.1 m"}, ("carriage", "lowest"), "below the mast"),
        (RACK, {"carriage__lowest": "9 m", "carriage__highest": "4 m"}, ("carriage", "highest"), "not above `lowest`"),
        (OVERHEAD, {"bridge__girder_vertical": None}, ("bridge",), "`girder_vertical` of one girder is missing"),
        (OVERHEAD, {"column__second_moment": None}, ("column",), "give `second_moment`"),
        (RACK, {"column__stiffness": "150 kN/m"}, ("column", "second_moment"), "not both"),
        (OVERHEAD, {"column__top_guide": {"rating": "5 kN"}}, ("column", "top_guide"), "suspended"),
        (RACK, {"base__column": "5 m"}, ("base", "column"), "beyond the wheels"),
        (RACK, {"base__centre": "5 m"}, ("base", "centre"), "beyond the wheels"),
        (RACK, {"travel__driving_force": "5 kN"}, ("travel", "driving_force"), "not both"),
        (RACK, {"travel__deceleration": None}, ("travel",), "no brake"),
        (
            OVERHEAD,
            {"bridge_travel__braking_force": None, "bridge_travel__braking_rise": None},
            ("bridge_travel",),
            "no brake",
        ),
        (OVERHEAD, {"bridge_travel__ramp_rise": "1 s"}, ("bridge_travel", "ramp_rise"), "no ramp"),
        (RACK, {"travel__braking_rise": "1 s"}, ("travel", "braking_rise"), "no `braking_force`"),
        (
            RACK,
            {"hoisting__rope__falls": 3, "hoisting__rope__ropes": 2},
            ("hoisting", "rope", "falls"),
            "be divided",
        ),
        (RACK, {"hoisting__rope__efficiency": 0.9, "hoisting__rope__sheave_efficiency": 0.9}, None, "not both"),
        (RACK, {"hoisting__rope__area": "60 mm^2"}, ("hoisting", "rope"), "`length` is missing"),
        (RACK, {"hoisting__drive": {"largest_force": "5 kN"}}, ("hoisting", "drive"), "reduced_mass"),
        (RACK, {"hoisting__drive": {"inertia": "0.1 kg*m^2", "ratio": 20}}, ("hoisting", "drive"), "drum_diameter"),
        (RACK, {"settling__wait": "3 s"}, ("settling",), "`window` is missing"),
        (OVERHEAD, {"obstacle": {}}, ("obstacle",), "needs its stiffness"),
        (OVERHEAD, {"obstacle": {"contact": "plastic", "stiffness": "1 MN/m"}}, ("obstacle", "stiffness"), "has none"),
        (
            RACK,
            {"safety_gear": {"type": "progressive", "force": "30 kN"}},
            ("safety_gear", "stroke"),
            "`stroke` is missing",
        ),
        (RACK, {"safety_gear": {"type": "progressive", "stroke": "1 m"}}, ("safety_gear",), "needs its `force`"),
        (RACK, {"safety_gear": {"type": "instantaneous", "stroke": "1 m"}}, ("safety_gear",), "needs its `stiffness`"),
    ],
)
def test_what_does_not_go_together(word: str, changes: dict[str, Any], path: Any, says: str) -> None:
    found = only(word, **changes)
    assert says in found.message
    assert path is None or found.path == path


@pytest.mark.parametrize("value", ["0 cm^4", "-1 cm^4", "nan cm^4", "inf cm^4", "1e30 cm^4", "1 cm^3"])
def test_a_column_without_a_stiffness_that_can_be(value: str) -> None:
    assert only(OVERHEAD, column__second_moment=value).path == ("column", "second_moment")


@pytest.mark.parametrize("key", ["stiffness", "root_stiffness"])
def test_a_stiffness_of_zero(key: str) -> None:
    unit = "N/m" if key == "stiffness" else "N*m/rad"
    changes = {f"column__{key}": f"0 {unit}"} | ({"column__second_moment": None} if key == "stiffness" else {})
    assert only(RACK, **changes).path == ("column", key)


@pytest.mark.parametrize(
    ("word", "scene", "block"),
    [
        (OVERHEAD, {"type": "obstacle"}, "obstacle"),
        (OVERHEAD, {"type": "start", "mechanism": "trolley"}, "trolley_travel"),
        (OVERHEAD, {"type": "brake", "mechanism": "rotation"}, "rotation"),
        (OVERHEAD, {"type": "buffer"}, "buffers"),
        (RACK, {"type": "fork_push"}, "fork"),
        (RACK, {"type": "rail"}, "rail"),
        (RACK, {"type": "safety_gear"}, "safety_gear"),
        (RACK, {"type": "buffer"}, "buffers"),
    ],
)
def test_a_scene_without_its_block_names_it_and_how_to_write_it(word: str, scene: dict[str, Any], block: str) -> None:
    found = only(word, scenes=[scene])
    assert found.path == ("scenes", 0)
    assert f"`{block}`" in found.message
    assert f"`{block}: {{" in found.hint
    added = yaml.safe_load(found.hint.split("`")[1])
    data = changed(template(word), scenes=[scene])
    target = data["bridge_travel" if word == OVERHEAD else "travel"] if block == "buffers" else data
    target.update(added)
    if block == "fork":
        assert "add `rack: {stiffness_push: 500 kN/m}`" in faults(data)[0].hint
        data["rack"] = {"stiffness_push": "500 kN/m"}
    assert faults(data) == []


def test_a_caught_fork_needs_a_drive_and_a_rope_that_gives() -> None:
    found = faults(changed(template(RACK), scenes=[{"type": "fork_caught"}]))
    assert [one.path for one in found] == [("scenes", 0)] * 2


@pytest.mark.parametrize(
    ("height", "says"),
    [("0.1 m", "below the mast"), ("13 m", "above the mast"), ("11.9 m", "its path is from 0.5 m to 11 m")],
)
def test_a_scene_with_the_carriage_where_it_does_not_come(height: str, says: str) -> None:
    scene = {"type": "brake", "height": height}
    found = only(RACK, scenes=[scene], carriage__highest="11 m")
    assert says in found.message
    assert found.path[-1] == "height"


@pytest.mark.parametrize(
    ("word", "mechanism"), [(OVERHEAD, "travel"), (RACK, "bridge"), (RACK, "trolley"), (RACK, "rotation")]
)
def test_a_mechanism_of_the_other_machine(word: str, mechanism: str) -> None:
    found = only(word, scenes=[{"type": "brake", "mechanism": mechanism}])
    assert "has no mechanism" in found.message


def test_nothing_starts_a_bridge_that_only_stops() -> None:
    data = changed(template(OVERHEAD), bridge_travel__driving_force=None, bridge_travel__driving_rise=None)
    assert faults(data) == []
    assert "the bridge has no drive" in faults({**data, "scenes": [{"type": "start"}]})[0].message


def test_all_faults_are_said_at_once() -> None:
    data = changed(
        template(OVERHEAD),
        trolley__position="18 m",
        column__second_moment="0 cm^4",
        carriage__lowest="0.1 m",
        safety_gear={"type": "progressive", "force": "30 kN"},
        scenes=[{"type": "obstacle"}],
    )
    assert len(faults(data)) == 5


def test_a_scene_of_the_other_table_is_unknown() -> None:
    assert only(OVERHEAD, scenes=[{"type": "fork_push"}]).path[0] == "scenes"


@pytest.mark.parametrize("number", [math.nan, math.inf, True, [], {}, "many"])
def test_no_value_is_a_traceback(number: Any) -> None:
    for key in ("load", "column__length", "hoisting__rope__falls", "carriage__rollers", "scenes", "bridge"):
        assert faults(changed(template(OVERHEAD), **{key: number}))


@pytest.mark.parametrize("word", [OVERHEAD, RACK])
def test_what_new_prints_passes(word: str) -> None:
    """As `ptmcalc new crane overhead_stacker` does."""
    report = report_of(template(word))
    assert report.verdict == "pass", [(one.code, one.reason) for _, one in report.judgements]
    assert {judgement.verdict for _, judgement in report.judgements} == {Verdict.PASS}
