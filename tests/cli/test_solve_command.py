"""`ptmcalc solve`: a margin, what the other checks say, and the curve over a second key; held against `check`."""

import json
from pathlib import Path
from typing import Any

import pytest
import yaml
from support.command import ROOT, Done, ptmcalc

PASSING = str(ROOT / "specs" / "short_conveyor.yaml")
STRENGTH = ("solve", PASSING, "--check", "CNV102", "--vary", "belt.strength", "--scene", "run_loaded")


def answer(done: Done) -> Any:
    assert done.status in (0, 1), done.err
    return json.loads(done.out)


def rewritten(place: Path, *keys_and_value: str) -> str:
    """The spec with another value at a key, in a file of its own."""
    *keys, value = keys_and_value
    data = yaml.safe_load(Path(PASSING).read_text(encoding="utf-8"))
    node = data
    for key in keys[:-1]:
        node = node[key]
    node[keys[-1]] = value
    file = place / "changed.yaml"
    file.write_text(yaml.safe_dump(data), encoding="utf-8")
    return str(file)


def judged(path: str, scene: str) -> dict[str, Any]:
    document = answer(ptmcalc("check", path, "--scene", scene, "--format", "json"))
    return {check["code"]: check for check in document["files"][0]["scenes"][0]["checks"]}


def test_a_wanted_margin_is_kept_and_hardly_more(tmp_path: Path) -> None:
    found = answer(ptmcalc(*STRENGTH, "--margin", "25%", "--format", "json"))
    there = judged(rewritten(tmp_path, "belt", "strength", f"{found['value']!r} N/m"), "run_loaded")["CNV102"]
    bar = (there["high"] - there["low"]) / 2
    assert 0.25 * there["limit"] <= there["margin"] <= 0.2505 * there["limit"] + bar


def test_the_other_checks_are_told_as_a_check_of_that_file_tells_them(tmp_path: Path) -> None:
    found = answer(ptmcalc(*STRENGTH, "--format", "json"))
    there = judged(rewritten(tmp_path, "belt", "strength", f"{found['value']!r} N/m"), "run_loaded")
    told = {row["code"]: (row["verdict"], row["value"], row["margin"]) for row in found["checks"]}
    assert len(told) >= 3
    assert told == {code: (one["verdict"], one["value"], one["margin"]) for code, one in there.items()}


def test_a_verdict_that_changes_on_the_way_is_marked() -> None:
    """A take-up as weak as the belt's grip allows lets the belt sag too much: that check has passed before."""
    arguments = ("solve", PASSING, "--check", "CNV105", "--vary", "takeup.tension", "--scene", "run_loaded")
    rows = answer(ptmcalc(*arguments, "--format", "json"))["checks"]
    changed = {row["code"]: (row["was"], row["verdict"]) for row in rows if row["was"] != row["verdict"]}
    assert changed.get("CNV103") == ("pass", "fail")
    assert "fail      pass" in ptmcalc(*arguments).out


def test_the_curve_over_a_second_key_is_made_of_solutions(tmp_path: Path) -> None:
    """The strength a belt needs goes with its tension; at the second key's own value it is that of the first alone."""
    data = yaml.safe_load(Path(PASSING).read_text(encoding="utf-8"))
    own = data["takeup"]["tension"]
    curve = answer(ptmcalc(*STRENGTH, "--vary", f"takeup.tension={own}:{own}:1", "--format", "json"))["rows"]
    alone = answer(ptmcalc(*STRENGTH, "--format", "json"))
    assert curve[0]["solution"] == {key: alone[key] for key in ("path", "value", "unit")}
    rows = answer(ptmcalc(*STRENGTH, "--vary", "takeup.tension=20 kN:60 kN:3", "--format", "json"))["rows"]
    assert [row["along"]["value"] for row in rows] == [20e3, 40e3, 60e3]
    strengths = [row["solution"]["value"] for row in rows]
    assert strengths == sorted(strengths)
    assert strengths[0] < strengths[2]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--margin", "wide"), "`--margin wide` is not a margin"),
        (("--margin", "-5%"), "`--margin -5%` is not a margin"),
        (("--margin", "nan%"), "`--margin nan%` is not a margin"),
        (("--margin", "3 kg"), "`--margin 3 kg` is not a margin"),
        (("--vary", "belt.mass"), "one key is solved for"),
        (("--vary", "belt.mass=1 kg/m:2 kg/m"), "is not a range"),
        (("--vary", "belt.mas=1 kg/m:2 kg/m:3"), "belt.mas"),
    ],
)
def test_what_cannot_be_asked_is_told(arguments: tuple[str, ...], message: str) -> None:
    done = ptmcalc(*STRENGTH, *arguments)
    assert done.status == 2
    assert message in done.err


def test_a_share_of_a_limit_of_nothing_is_no_margin() -> None:
    done = ptmcalc("solve", PASSING, "--check", "CNV105", "--vary", "takeup.tension", "--margin", "10%")
    assert done.status == 2
    assert "no share of it is a margin" in done.err
