"""The JSON of `check`: the contract other tools read, held by a JSON Schema written from the design."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator
from support.command import report_of_file
from support.samples import SAMPLES

from ptmcalc import __version__
from ptmcalc.base.units import unit_of
from ptmcalc.contract.report import FileReport
from ptmcalc.report import Format, render

SCHEMA = json.loads(Path(__file__).with_name("check.schema.json").read_text("utf-8"))
FILES = ("specs/conveyor.yaml", "tests/cli/specs/slipping.yaml", "tests/cli/specs/faulty.yaml")


def refuse(constant: str) -> float:
    raise AssertionError(f"{constant} is not JSON")


def document(*reports: FileReport) -> dict[str, Any]:
    found = json.loads(render(Format.JSON, reports), parse_constant=refuse)
    assert isinstance(found, dict)
    return found


def only_file(name: str) -> dict[str, Any]:
    (found,) = document(SAMPLES[name])["files"]
    assert isinstance(found, dict)
    return found


def only_scene(name: str) -> dict[str, Any]:
    (found,) = only_file(name)["scenes"]
    assert isinstance(found, dict)
    return found


def everywhere(node: Any, key: str) -> Iterator[Any]:
    """All values of a key, however deep."""
    if isinstance(node, dict):
        yield from (value for name, value in node.items() if name == key)
    for child in node.values() if isinstance(node, dict) else node if isinstance(node, list) else ():
        yield from everywhere(child, key)


def faults(found: dict[str, Any]) -> list[str]:
    return [f"{error.json_path}: {error.message}" for error in Draft202012Validator(SCHEMA).iter_errors(found)]


def test_the_schema_is_a_schema() -> None:
    Draft202012Validator.check_schema(SCHEMA)
    assert faults({}) != []


@pytest.mark.parametrize("name", SAMPLES)
def test_every_sort_of_report_keeps_the_contract(name: str) -> None:
    assert faults(document(SAMPLES[name])) == []


@pytest.mark.parametrize("path", FILES)
def test_real_machines_keep_the_contract(path: str) -> None:
    assert faults(document(report_of_file(path))) == []


@pytest.mark.parametrize("path", FILES)
def test_units_are_si_units_of_the_closed_table(path: str) -> None:
    for unit in set(everywhere(document(report_of_file(path)), "unit")):
        assert unit_of(unit)[0] == 1.0


def test_the_schema_refuses_what_the_contract_forbids() -> None:
    found = document(SAMPLES["passing"])
    found["files"][0]["scenes"][0]["loads"][0]["value"] = None
    assert any("unbounded" in fault for fault in faults(found))


def test_the_tool_and_its_version_are_named() -> None:
    found = document()
    assert found["tool"] == {"name": "ptmcalc", "version": __version__}
    assert found["schema_version"] == "1"


def test_verdicts_and_files_are_counted() -> None:
    found = document(*SAMPLES.values())
    verdicts = [check["verdict"] for file in found["files"] for scene in file["scenes"] for check in scene["checks"]]
    expected = {name: verdicts.count(name) for name in ("pass", "fail", "undecided", "not_checked", "waived", "off")}
    assert found["summary"] == {"files": len(SAMPLES), "invalid": 2, "ignored": 0} | expected
    assert expected == {"pass": 9, "fail": 1, "undecided": 3, "not_checked": 1, "waived": 0, "off": 1}


@pytest.mark.parametrize(
    ("name", "verdict"),
    [
        ("passing", "pass"),
        ("failing", "fail"),
        ("undecided", "undecided"),
        ("open_bar", "undecided"),
        ("not_checked", "undecided"),
        ("switched_off", "undecided"),
        ("infinite", "pass"),
        ("moving", "pass"),
        ("warned", "pass"),
        ("broken", "undecided"),
        ("invalid", "invalid"),
        ("unreadable", "invalid"),
    ],
)
def test_a_file_has_one_verdict(name: str, verdict: str) -> None:
    assert only_file(name)["verdict"] == verdict


def test_a_load_carries_its_bar_place_window_and_textbook() -> None:
    (load,) = only_scene("passing")["loads"]
    assert (load["name"], load["unit"], load["solver"], load["source"]) == ("pull", "N", "rich", "told so")
    assert (load["value"], load["low"], load["high"]) == pytest.approx((9000, 8750, 9200))
    assert (load["numerical_error"], load["model_error"]) == pytest.approx((100, 150))
    assert (load["at"], load["window"]) == ({"time": 1.5}, [0.0, 4.0])
    assert load["formula"] == {"name": "textbook", "value": 12000.0, "ratio": pytest.approx(0.75)}
    assert "unbounded" not in load


def test_a_load_of_a_part_is_named_with_it_and_carries_its_history() -> None:
    scene = only_file("moving")["scenes"][0]
    hook, rope = scene["loads"]
    assert (hook["name"], rope["name"]) == ("pull[hook]", "pull[rope]")
    assert hook["history"] == {"t": [0.0, 0.5, 1.0], "value": [0.0, 8000.0, 1 / 3], "unit": "N"}
    assert "history" not in rope
    assert [check["element"] for check in scene["checks"]] == ["hook", "rope"]
    assert "element" not in only_scene("passing")["checks"][0]


@pytest.mark.parametrize("name", ["pull[", "pull[]", "pull[a]b", "[a]", "pull[a[b]]"])
def test_the_schema_refuses_other_names_of_parts(name: str) -> None:
    found = document(SAMPLES["moving"])
    found["files"][0]["scenes"][0]["loads"][0]["name"] = name
    assert any("does not match" in fault for fault in faults(found))


def test_every_event_is_listed_in_its_order() -> None:
    gust, calm = only_file("moving")["scenes"]
    assert len(gust["events"]) == 35
    assert gust["events"][1] == {"time": 0.0123456789, "element": "rope", "from": "slack", "to": "taut"}
    assert [event["time"] for event in gust["events"]] == sorted(event["time"] for event in gust["events"])
    assert calm["events"] == []


def test_an_infinite_load_is_null_and_unbounded() -> None:
    load = next(load for load in only_scene("infinite")["loads"] if load["name"] == "reserve")
    assert (load["value"], load["unbounded"]) == (None, True)


def test_an_infinite_bar_leaves_the_value_and_is_unbounded() -> None:
    (load,) = only_scene("open_bar")["loads"]
    assert (load["value"], load["low"], load["high"], load["unbounded"]) == (8000.0, None, None, True)
    assert load["model_error"] is None


def test_an_infinite_criterion_is_null() -> None:
    (effect,) = only_scene("open_bar")["effects"]
    assert effect["criterion"]["value"] is None


def test_the_ledger_of_effects() -> None:
    effects = {effect["name"]: effect for effect in only_scene("passing")["effects"]}
    assert {name: effect["state"] for name, effect in effects.items()} == {
        "waves": "simulated",
        "sag": "simulated",
        "wind": "skipped",
        "frost": "bounded",
        "rain": "skipped",
        "fog": "skipped",
    }
    assert [name for name, effect in effects.items() if effect["forced"]] == ["rain"]
    assert effects["fog"]["criterion"] is None
    assert effects["sag"]["change_without"] == {"load": "pull", "relative": pytest.approx(8.8 / 9 - 1)}
    assert "change_without" not in effects["waves"]


def test_a_failed_check_names_the_line_and_the_value_that_passes() -> None:
    checks = [check for scene in only_file("failing")["scenes"] for check in scene["checks"]]
    failed = next(check for check in checks if check["verdict"] == "fail")
    assert failed["blame"] == {"path": ["load"], "line": 2, "column": 7}
    assert failed["repair"] == {"path": ["load"], "value": pytest.approx(9090), "unit": "N"}
    assert (failed["value"], failed["limit"], failed["margin"]) == pytest.approx((13200, 10000, -3200))
    assert (failed["sense"], failed["unit"]) == ("at_most", "N")
    assert all("repair" not in check for check in checks if check["verdict"] == "pass")


def test_a_verdict_without_a_forced_effect_says_so() -> None:
    assert only_scene("passing")["checks"][0]["without"] == ["rain"]
    assert "without" not in only_scene("open_bar")["checks"][0]


def test_assumed_values_are_listed_with_interval_and_source() -> None:
    assert only_file("undecided")["assumed"] == [
        {"path": ["shock"], "value": 1.1, "unit": "1", "interval": [1.0, 1.2], "source": "a smooth crane driver"}
    ]


def test_findings_keep_their_place_and_hint() -> None:
    (found,) = only_file("warned")["diagnostics"]
    assert found == {
        "code": "NUM104",
        "severity": "warning",
        "message": "the rope was slack for a moment",
        "line": 2,
        "column": 7,
        "path": ["load"],
        "hint": "hang it gently",
    }


def test_a_file_that_cannot_be_read_still_has_an_entry() -> None:
    found = only_file("unreadable")
    assert (found["kind"], found["name"], found["scenes"]) == ("", "", [])
    assert [diagnostic["code"] for diagnostic in found["diagnostics"]] == ["TXT104"]


@pytest.mark.parametrize("path", FILES)
def test_the_same_report_gives_the_same_bytes(path: str) -> None:
    first, second = (render(Format.JSON, [report_of_file(path)]) for _ in range(2))
    assert first == second
    assert first.endswith("}\n")


def test_text_stays_readable() -> None:
    assert "±" in render(Format.JSON, [FileReport("±.yaml")])
