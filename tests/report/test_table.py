"""The whole table, and what it has in common with the short one: what a designer must find in it, on any screen."""

import re
from collections.abc import Mapping
from dataclasses import replace

import pytest
from support.command import ROOT, report_of_file
from support.samples import SAMPLES

from ptmcalc.contract.report import FileReport
from ptmcalc.report import Format, render

CONVEYOR, SLIPPING = "specs/conveyor.yaml", "tests/cli/specs/slipping.yaml"
HEADINGS = ("Loads", "Checks", "Effects", "Events", "Solvers", "Assumptions (not given in the file)")


def table(report: FileReport, width: int = 120, *, verbose: bool = True) -> str:
    return render(Format.TABLE, [report], width=width, verbose=verbose)


def parts(text: str) -> Mapping[str, list[str]]:
    """The lines under each heading, blank ones left out."""
    found: dict[str, list[str]] = {"": []}
    for line in text.splitlines():
        if line in HEADINGS:
            found[line] = []
        elif line.strip():
            found[list(found)[-1]].append(line)
    return found


def cells(line: str) -> list[str]:
    """The cells of a row: two spaces or more stand between them."""
    return re.split(r"\s{2,}", line.strip())


def rows(report: FileReport, heading: str, width: int = 120) -> list[list[str]]:
    """The rows of one table; the first is its head."""
    return [cells(line) for line in parts(table(report, width))[heading] if not set(line) <= set(" ─")]


def with_a_ledger(report: FileReport) -> FileReport:
    """The same report with the ledger of another."""
    (other,) = SAMPLES["passing"].scenes
    return replace(report, scenes=tuple(replace(scene, effects=other.effects) for scene in report.scenes))


@pytest.mark.parametrize("path", [CONVEYOR, SLIPPING])
def test_the_worst_verdict_comes_first_and_then_the_smallest_margin(path: str) -> None:
    _, *found = rows(report_of_file(path), "Checks")
    checks = [row for row in found if re.fullmatch("fail|undecided|not checked|waived|pass", row[0])]
    order = ["fail", "undecided", "not checked", "waived", "pass", "off"]
    ranks = [order.index(row[0]) for row in checks]
    assert ranks == sorted(ranks)
    margins = [float(row[-1].removesuffix(" %")) for row in checks if row[0] == "pass" and row[-1].endswith("%")]
    assert margins == sorted(margins)
    assert len(margins) > 3


def test_a_failed_check_shows_the_line_to_blame_and_the_value_that_passes() -> None:
    text = " ".join(table(report_of_file(SLIPPING)).split())
    about = "fail CNV101 drive pulley traction reserve, run_loaded: 0.4348, limit ≥ 1.2, margin -63.8 %;"
    assert (
        f"{about} governing key: drive.drum.friction ({SLIPPING}:25:15); belt slips at the drive pulley; passes with"
        in text
    )
    assert f"undecided CNV101 start_empty: governing key: resistance.start_factor ({SLIPPING}:15:1); fail if" in text
    assert re.search(r"passes with takeup\.tension = 82\.\d+ kN", text)


def test_the_line_to_blame_is_the_one_in_the_file() -> None:
    line = (ROOT / SLIPPING).read_text("utf-8").splitlines()[25 - 1]
    assert line.strip() == "friction: 0.10"
    assert line[15 - 1 :] == "0.10"


def test_an_undecided_check_names_the_key_to_supply() -> None:
    text = " ".join(table(SAMPLES["undecided"]).split())
    assert "undecided TOY101 weight on the hook, hang: " in text
    assert "governing key: shock (toy.yaml:1:1); fail if `shock` is 1.2: give its value" in text


def test_a_check_not_made_names_the_missing_key() -> None:
    text = " ".join(table(SAMPLES["not_checked"]).split())
    assert "not checked TOY101 weight on the hook, hang: " in text
    assert "governing key: strength (toy.yaml:3:11); `strength` is not given" in text


def test_the_textbook_stands_beside_the_load_with_its_ratio() -> None:
    head, row = rows(SAMPLES["passing"], "Loads")
    assert head == ["hang", "textbook"]
    assert row == ["pull on the hook", "kN", "9.00 ±0.25", "12 ×0.750"]


def test_scenes_stand_side_by_side_in_the_order_of_the_file() -> None:
    head, row = rows(SAMPLES["failing"], "Loads")
    assert head == ["gust", "calm"]
    assert row == ["pull on the hook", "kN", "13.2", "6.6"]


def test_value_limit_and_margin_of_a_check() -> None:
    head, failed, passed = [row for row in rows(SAMPLES["failing"], "Checks") if len(row) == 6]
    assert head == ["verdict", "check", "scene", "value", "limit", "margin"]
    assert failed == ["fail", "TOY101 weight on the hook", "gust", "13.2 kN", "≤ 10 kN", "-32.0 %"]
    assert passed == ["pass", "TOY101 weight on the hook", "calm", "6.6 kN", "≤ 10 kN", "+34.0 %"]


def test_the_ledger_shows_every_effect_with_the_number_that_decided() -> None:
    _, *found = rows(SAMPLES["passing"], "Effects", width=160)
    ledger = {row[1]: row[2:] for row in found if row[0] == "hang"}
    assert ledger["waves"] == ["simulated", "x = 3 ≥ 0.1", "a number"]
    assert ledger["sag"] == ["simulated", "x = 0.15 ≥ 0.1", "a number", "pull -2.2 %, within the bars"]
    assert ledger["wind"] == ["skipped", "x = 0.01 < 0.1", "a number"]
    assert ledger["frost"] == ["bounded", "x = 5 ≥ 0.1", "a number"]
    assert ledger["rain"] == ["skipped (forced)", "x = 5 ≥ 0.1", "a number; forced off by the file"]
    assert ledger["fog"][0] == "skipped"
    assert "a required input is not given" in " ".join(ledger["fog"])


def test_a_verdict_without_a_forced_effect_says_so() -> None:
    assert "pass TOY101 hang: without rain" in table(SAMPLES["passing"])


def test_solvers_show_what_they_carried_and_what_the_next_one_costs() -> None:
    _, *found = rows(SAMPLES["passing"], "Solvers")
    assert ["hang", "rich", "sag, waves", "1000", "rich, 12 ms"] in found
    assert ["hang", "textbook (shown only)", "1"] in found


def test_events_stand_with_time_and_states_at_most_30_a_scene() -> None:
    head, *found = rows(SAMPLES["moving"], "Events")
    assert head == ["scene", "time", "element", "from", "to"]
    assert found[:3] == [
        ["gust", "0 s", "rope", "taut", "slack"],
        ["gust", "0.012346 s", "rope", "slack", "taut"],
        ["gust", "0.024691 s", "rope", "taut", "slack"],
    ]
    assert len(found) == 31
    assert found[-1] == ["gust", "... and 5 more"]


def test_events_stand_between_effects_and_solvers() -> None:
    headings = [line for line in table(with_a_ledger(SAMPLES["moving"])).splitlines() if line in HEADINGS]
    assert headings == ["Loads", "Checks", "Effects", "Events", "Solvers"]


def test_30_events_are_all_shown() -> None:
    gust = SAMPLES["moving"].scenes[0]
    found = replace(SAMPLES["moving"], scenes=(replace(gust, events=gust.events[:30]),))
    assert len(rows(found, "Events")) == 31
    assert "more" not in "".join(parts(table(found))["Events"])


@pytest.mark.parametrize("name", [name for name in SAMPLES if name != "moving"])
def test_a_file_without_events_has_no_table_of_them(name: str) -> None:
    assert "Events" not in table(SAMPLES[name])


def test_assumed_values_stand_with_interval_and_source() -> None:
    _, row = rows(SAMPLES["undecided"], "Assumptions (not given in the file)")[:2]
    assert row == ["shock", "1.1", "1 to 1.2", "a smooth crane driver"]
    assert "Assumed" not in table(SAMPLES["failing"])


def test_findings_stand_above_the_tables_with_place_and_hint() -> None:
    above = [line.strip() for line in parts(table(SAMPLES["warned"]))[""]]
    assert "2:7  warning NUM104  the rope was slack for a moment" in above
    assert "hang it gently" in above


@pytest.mark.parametrize(
    ("name", "verdict"),
    [
        ("passing", "PASS"),
        ("failing", "FAIL"),
        ("undecided", "UNDECIDED"),
        ("not_checked", "UNDECIDED"),
        ("invalid", "INVALID"),
    ],
)
def test_the_first_line_is_file_kind_name_and_verdict(name: str, verdict: str) -> None:
    first = table(SAMPLES[name]).splitlines()[0]
    assert first.startswith(SAMPLES[name].path)
    assert first.endswith(f"  {verdict}")
    assert SAMPLES[name].name in first
    assert table(SAMPLES[name], verbose=False).splitlines()[0] == first


@pytest.mark.parametrize("verbose", [False, True])
@pytest.mark.parametrize("width", [80, 100, 120, 200])
@pytest.mark.parametrize("name", SAMPLES)
def test_no_line_is_wider_than_the_screen(name: str, width: int, verbose: bool) -> None:
    assert max(map(len, table(SAMPLES[name], width, verbose=verbose).splitlines())) <= width


@pytest.mark.parametrize("verbose", [False, True])
@pytest.mark.parametrize("width", [80, 100, 120])
@pytest.mark.parametrize("path", [CONVEYOR, SLIPPING])
def test_no_line_of_a_real_machine_is_wider_than_the_screen(path: str, width: int, verbose: bool) -> None:
    assert max(map(len, table(report_of_file(path), width, verbose=verbose).splitlines())) <= width


@pytest.mark.parametrize("verbose", [False, True])
@pytest.mark.parametrize("width", [80, 120])
@pytest.mark.parametrize("path", [CONVEYOR, SLIPPING])
def test_nothing_is_cut_off_on_a_narrow_screen(path: str, width: int, verbose: bool) -> None:
    """An ellipsis would hide which scene a column is of, or which load a number."""
    cut = [line for line in table(report_of_file(path), width, verbose=verbose).splitlines() if "…" in line]
    assert cut == []


@pytest.mark.parametrize("verbose", [False, True])
@pytest.mark.parametrize("name", SAMPLES)
def test_no_line_ends_in_spaces_and_no_colour_leaks(name: str, verbose: bool) -> None:
    text = table(SAMPLES[name], verbose=verbose)
    assert all(line == line.rstrip() for line in text.splitlines())
    assert "\x1b" not in text


@pytest.mark.parametrize("verbose", [False, True])
def test_colour_is_only_paint(verbose: bool) -> None:
    painted = render(Format.TABLE, [SAMPLES["failing"]], color=True, verbose=verbose)
    assert "\x1b[" in painted
    plain = re.sub(r"\x1b\[[0-9;]*m", "", painted)
    assert [line.rstrip() for line in plain.splitlines()] == table(SAMPLES["failing"], verbose=verbose).splitlines()
