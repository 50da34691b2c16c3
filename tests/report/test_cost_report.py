"""What `cost` prints: a table of 80 columns, JSON, a page whose points are those of the table, and one sentence."""

import itertools
import json
import math
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest

from ptmcalc.contract.cost import Choice, CostReport, Held, LoadCost, Outcome, Role, Setting
from ptmcalc.report import cost, work_precision


def load(bar: float | None, error: float | None = None, resolution: float = 0.0, held: Held | None = None) -> LoadCost:
    if error is None:
        return LoadCost("pull[head]", 8e3, bar)
    return LoadCost("pull[head]", 8e3, bar, "fine 0", 8.1e3, error, resolution, held)


def setting(solver: str, seconds: float | None, *loads: LoadCost, **parts: object) -> Setting:
    whole: dict[str, object] = {
        "scene": "start_loaded",
        "solver": solver,
        "method": solver,
        "fidelity": "transient",
        "role": Role.LADDER,
        "effects": ("waves",),
        "level": 0,
        "variant": "",
        "predicted_seconds": 2e-3,
        "outcome": Outcome.MEASURED,
        "seconds": seconds,
        "runs": 3,
        "work": 10,
        "loads": loads,
    }
    return Setting(**whole | parts)  # type: ignore[arg-type]


ROUGH = setting("rough", 1e-3, load(0.2, 0.1, 0.001, Held.YES), front_of_bars=True)
FINE = setting("fine", 0.25, load(1e-4, 0.1, 0.2, Held.OPEN), front_of_bars=True, front_of_errors=True)
BOOK = setting("book", 1e-5, load(None, 0.3, 0.001), role=Role.FORMULA)
BROKEN = setting("broken", None, outcome=Outcome.FAILED, reason="NUM101 it does not converge")
DEAR = setting("dear", None, outcome=Outcome.NOT_RUN, reason="beyond the budget", predicted_seconds=30.0)
ALONE = setting("alone", 0.5, load(0.01))
ENDLESS = setting("endless", 0.5, load(None))


def choice(target: str, *settings: str, seconds: float | None = None, missing: tuple[str, ...] = ()) -> Choice:
    return Choice("start_loaded", target, None, settings, seconds, missing)


CHOICES = (
    choice("5 %", "fine 0", seconds=0.25),
    choice("1 %", "fine 0", seconds=0.25),
    choice("0.1 %", missing=("pull[head]",)),
    choice("margins", "rough 0", seconds=1e-3),
)
REPORT = CostReport(
    "specs/a.yaml", "toy", (ROUGH, FINE, BOOK, BROKEN, DEAR, ALONE, ENDLESS), CHOICES, ("CNV101", -0.123)
)


@pytest.mark.parametrize("width", [80, 120])
def test_no_line_is_wider_than_the_screen(width: int) -> None:
    assert max(map(len, cost.table(REPORT, width).splitlines())) <= width


def test_every_setting_is_a_line_with_its_numbers() -> None:
    text = cost.table(REPORT, 120)
    for line in (
        r"1\*\s+rough 0\s+1 ms\s+2 ms\s+10 %\s+20 %\s+yes\s+2",
        r"2\*o\s+fine 0\s+250 ms\s+2 ms\s+≤ 30 %\s+0.01 %\s+open\s+2",
        r"3\s+book 0 f\s+0.01 ms\s+2 ms\s+30 %\s+2",
        r"4\s+broken 0\s+failed\s+2 ms\s*$",
        r"5\s+dear 0\s+not run\s+30 s\s*$",
        r"6\s+alone 0\s+500 ms\s+2 ms\s+1 %\s+-",
        r"7\s+endless 0\s+500 ms\s+2 ms\s+∞\s+-",
    ):
        assert re.search(line, text, re.MULTILINE), line
    assert "broken 0 failed: NUM101 it does not converge" in text


def test_what_to_choose_stands_below_with_targets_of_one_answer_together() -> None:
    text = cost.table(REPORT, 120)
    assert re.search(r"start_loaded\s+5 %, 1 %\s+fine 0\s+250 ms", text)
    assert re.search(r"start_loaded\s+0.1 %\s+not reached: pull\[head\]", text)
    assert re.search(r"start_loaded\s+this file's margins\s+rough 0\s+1 ms", text)


def test_the_sentence_says_what_the_table_says() -> None:
    said = cost.conclusion(REPORT)
    assert said.endswith(".")
    assert said.count(". ") == 0
    for part in (
        "Every check of this file (the closest, CNV101, 12 % from its limit) is decided in 1 ms by rough",
        "5 % costs 250 ms; 1 % costs 250 ms",
        "0.1 % cannot be reached in start_loaded (no bar of pull[head] below 0.01 %)",
        "1 of 2 compared settings cover the true error with their bars",
        "1 are known closer than by any other method",
        "for 2 there is no other method",
        "1 setting failed",
        "1 setting beyond the budget would take 30 s",
    ):
        assert part in said


def test_a_bar_that_does_not_hold_cannot_be_overlooked() -> None:
    missed = setting("missed", 1e-3, load(0.01, 0.1, 0.001, Held.NO))
    found = CostReport("a.yaml", "toy", (missed, FINE), CHOICES, None)
    assert "1 DO NOT" in cost.conclusion(found)
    assert re.search(r"missed 0 .* NO ", cost.table(found, 120))


def test_what_is_undecided_is_said_instead_of_a_price() -> None:
    found = CostReport("a.yaml", "toy", (ROUGH,), (choice("margins", missing=("CNV101",)),), None)
    assert cost.conclusion(found).startswith("Nothing that ran decides CNV101 in start_loaded")


def test_the_json_has_a_row_a_setting_and_no_infinity() -> None:
    found = json.loads(cost.document([REPORT]))
    assert set(found) == {"schema_version", "rows", "choices", "conclusion"}
    assert found["conclusion"] == cost.conclusion(REPORT)
    rows = {row["setting"]: row for row in found["rows"]}
    assert len(rows) == len(REPORT.settings)
    assert (rows["rough 0"]["true_error"], rows["rough 0"]["covered"], rows["rough 0"]["reference"]) == (
        0.1,
        "yes",
        "fine 0",
    )
    assert rows["rough 0"]["pareto"] == {"bar": True, "true_error": False}
    assert (rows["broken 0"]["outcome"], rows["broken 0"]["seconds"]) == ("failed", None)
    assert rows["endless 0"]["bar"] is None
    assert [(one["target"], one["reached"]) for one in found["choices"]][2:] == [("0.1 %", False), ("margins", True)]


def test_the_sentences_of_several_files_name_them() -> None:
    found = json.loads(cost.document([REPORT, REPORT]))
    assert found["conclusion"].count("specs/a.yaml: Every check") == 2


def test_the_table_of_all_files_has_a_line_a_file() -> None:
    text = cost.markdown([REPORT, REPORT])
    head, rule, *rows = text.splitlines()
    assert head == "| file | kind | its margins | 5 % | 1 % | 0.1 % | confirmed bars |"
    assert rule.count("---") == head.count("|") - 1
    assert rows == ["| `specs/a.yaml` | toy | 1 ms | 250 ms | 250 ms | - | 1 of 1 |"] * 2


def page(report: CostReport) -> ElementTree.Element:
    return ElementTree.fromstring(work_precision.render(report).partition("\n")[2])


def circles(report: CostReport, kind: str) -> dict[str, tuple[float, float]]:
    found = {}
    for one in page(report).iter("circle"):
        title = one.find("title")
        if one.get("class") == kind and title is not None and title.text:
            found[title.text.partition(":")[0]] = (float(one.get("cx", "nan")), float(one.get("cy", "nan")))
    return found


def test_the_page_draws_what_was_measured_and_lists_the_rest() -> None:
    """A method that failed is no point; nor is a bar without bound; a formula has an error and no bar."""
    bars, errors = circles(REPORT, "bar"), circles(REPORT, "error")
    assert set(bars) == {"rough 0", "fine 0", "alone 0"}
    assert set(errors) == {"rough 0", "fine 0", "book 0"}
    listed = " ".join(one.text or "" for one in page(REPORT).iter("li"))
    for part in ("broken 0 failed", "dear 0 not run", "endless 0, 500 ms: no bound"):
        assert part in listed


def test_the_page_has_the_style_of_all_pages_and_tells_its_numbers_to_those_who_cannot_see_it() -> None:
    found = page(REPORT)
    style = "".join(one.text or "" for one in found.iter("style"))
    assert (Path(work_precision.__file__).parent / "html" / "style.css").read_text("utf-8") in style
    assert "prefers-color-scheme: dark" in style
    (picture,) = found.iter("svg")
    assert picture.get("role") == "img"
    assert REPORT.scenes[0] in str(picture.get("aria-label"))
    table = next(found.iter("table"))
    assert [row.findtext("th") for row in table.findall("tbody/tr")] == sorted(
        {*circles(REPORT, "bar"), *circles(REPORT, "error")},
        key=lambda name: next(one.seconds or 0.0 for one in REPORT.settings if one.name == name),
    )
    assert "#" not in "".join(one.get("stroke", "") + one.get("fill", "") for one in picture.iter())


def test_both_axes_are_logarithmic() -> None:
    """Ten times the seconds, or a tenth of the bar, is the same way everywhere."""
    steps = [setting(f"s{k}", 10.0 ** (k - 4), load(10.0**-k)) for k in range(1, 5)]
    at = [circles(CostReport("a", "toy", tuple(steps), (), None), "bar")[one.name] for one in steps]
    across = [second[0] - first[0] for first, second in itertools.pairwise(at)]
    down = [second[1] - first[1] for first, second in itertools.pairwise(at)]
    assert across == pytest.approx([across[0]] * 3, abs=0.2)
    assert down == pytest.approx([down[0]] * 3, abs=0.2)
    assert min(*across, *down) > 20


def test_an_exact_number_stays_on_the_page() -> None:
    ((_, y),) = circles(CostReport("a", "toy", (setting("s", 1e-3, load(0.0)),), (), None), "bar").values()
    assert math.isfinite(y)


def test_names_of_the_file_are_escaped() -> None:
    found = work_precision.render(CostReport("<b>.yaml", "toy", (ROUGH,), CHOICES, None))
    assert "<b>" not in found
    assert "&lt;b&gt;.yaml" in found
