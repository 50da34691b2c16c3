"""`ptmcalc cost`: from a file to a table, JSON and a page; the numbers of a run differ, its structure does not."""

import json
from pathlib import Path
from typing import Any

import pytest
from support.command import ROOT, Done, ptmcalc, unpainted

WINDING = ROOT / "specs" / "hoist" / "winding_paper"
ONE = WINDING / "height_25_rope_17_5.yaml"
SHAFT = ROOT / "specs" / "shaft.yaml"


def answer(done: Done) -> Any:
    assert (done.status, done.err) == (0, "")
    return json.loads(done.out)


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("cost") / "shaft.html"


@pytest.fixture(scope="module")
def shaft(page: Path) -> Any:
    return answer(ptmcalc("cost", SHAFT, "--scene", "run_up", "--format", "json", "--plot", page))


def test_the_json_is_a_row_a_setting_with_a_sentence(shaft: Any) -> None:
    assert shaft["schema_version"] == "1"
    assert [row["setting"] for row in shaft["rows"]] == [
        "step_table 0",
        "speed_quadrature 0",
        "tachogram_up 0",
        "runge_kutta_up 0",
    ]
    assert {row["scene"] for row in shaft["rows"]} == {"run_up"}
    for row in shaft["rows"]:
        assert row["seconds"] > 0
        assert row["predicted_seconds"] > 0
        assert row["reference"] != row["setting"]
    assert [one["target"] for one in shaft["choices"]] == ["5 %", "1 %", "0.1 %", "margins"]
    assert shaft["conclusion"].startswith("Every check of this file")


def test_the_page_is_written_beside_what_is_printed(shaft: Any, page: Path) -> None:
    text = page.read_text("utf-8")
    assert text.startswith("<!DOCTYPE html>")
    assert shaft["conclusion"].partition(" is decided")[0] in text
    assert text.count("<svg") == 1


def test_the_table_is_what_is_printed_without_a_wish() -> None:
    done = ptmcalc("cost", ONE, "--accuracy", "2%")
    assert (done.status, done.err) == (0, "")
    for part in ("winding_loaded", "winding_map 0", "winding_paper 0 f", "The fastest settings", "2 %", "margins"):
        assert part in done.out
    assert "0.1 %, " not in done.out


def test_a_line_a_file_of_a_folder() -> None:
    done = ptmcalc("cost", "--all", WINDING, "--format", "markdown")
    assert (done.status, done.err) == (0, "")
    assert len(done.out.splitlines()) == 2 + len(list(WINDING.glob("*.yaml")))
    shown = ptmcalc("cost", "--all", ONE)
    assert "height_25_rope_17_5.yaml" in shown.out.replace("\n", "")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ((), "no design file is named"),
        ((ONE, "--plot", "a.png"), "is not a page"),
        ((ONE, "--plot", "no/such/folder/a.html"), "cannot write"),
        ((WINDING, "--plot", "a.html"), "one page shows one machine"),
        ((ONE, "--accuracy", "0 %"), "not between 0 and 100 %"),
        ((ONE, "--accuracy", "1 kg"), "--accuracy"),
        ((ONE, "--scene", "start"), "unknown scene"),
        ((ONE, "--budget", "two"), "--budget"),
    ],
)
def test_wrong_usage_is_one_sentence(arguments: tuple[str | Path, ...], said: str) -> None:
    done = ptmcalc("cost", *arguments)
    assert done.status == 2
    assert said in unpainted(done.err)
    assert done.out == ""


def test_a_faulty_file_is_told_and_the_others_are_measured(tmp_path: Path) -> None:
    bad = tmp_path / "bad.yaml"
    bad.write_text("kind: hoist\n", encoding="utf-8")
    done = ptmcalc("cost", bad, ONE)
    assert done.status == 2
    assert "bad.yaml" in done.err
    assert "winding_map 0" in done.out


def test_a_reference_and_a_shared_method_are_explained() -> None:
    assert "Reference method, never used for a verdict" in ptmcalc("explain", "cells").out
    assert "It uses the method of two_mass" in ptmcalc("explain", "hoist_train").out
    assert "It uses the method of" not in ptmcalc("explain", "characteristics").out
