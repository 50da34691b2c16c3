"""JUnit, SARIF, workflow commands of GitHub and Markdown: schemas, places, counts, fingerprints, and hostile names."""

import json
import re
from dataclasses import replace
from functools import reduce
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as Xml

import pytest
import yaml
from jsonschema import Draft4Validator, Draft202012Validator
from support.command import ROOT, report_of_file
from support.samples import SAMPLES
from support.xsd import Schema

from ptmcalc.base.diagnostic import Diagnostic, Severity, Verdict
from ptmcalc.base.span import Span
from ptmcalc.contract.report import FileReport, count
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text
from ptmcalc.report import Format, render
from ptmcalc.text.document import parse, resolve

JUNIT = Schema(Path(__file__).with_name("junit-10.xsd").read_text("utf-8"))
"""The schema of Jenkins (MIT, see its head)."""
SARIF = Draft202012Validator(json.loads(Path(__file__).with_name("sarif.schema.json").read_text("utf-8")))
"""What of SARIF we write, with the rules that no schema of its authors holds."""
OFFICIAL = Draft4Validator(json.loads(Path(__file__).with_name("sarif-2.1.0-rtm.5.json").read_text("utf-8")))
"""The schema of its authors (MIT, see the text beside it)."""
FILES = ("specs/conveyor.yaml", "tests/cli/specs/slipping.yaml", "tests/cli/specs/faulty.yaml")
HOSTILE = "a\n::error::b\r%0A,x:y|`c`\x1b[31m<script>&\"'*_[l](http://h)_@me #1 www.x ]]> \ufffe\x00"


def waived() -> FileReport:
    """A failed check that was waived."""
    failed = SAMPLES["failing"]
    (scene, *others) = failed.scenes
    checks = tuple(replace(one, verdict=Verdict.WAIVED, reason="tested on the machine") for one in scene.checks)
    return replace(failed, scenes=(replace(scene, checks=checks), *others))


def hostile() -> FileReport:
    """Names that every format must keep from meaning anything."""
    failed = SAMPLES["failing"]
    (scene, *others) = failed.scenes
    checks = tuple(replace(one, reason=HOSTILE, element=HOSTILE, title=HOSTILE) for one in scene.checks)
    odd = replace(scene, name=HOSTILE, checks=checks)
    said = Diagnostic("SPC104", HOSTILE, hint=HOSTILE, severity=SAMPLES["warned"].diagnostics[0].severity)
    return replace(failed, path=f"{HOSTILE}.yaml", name=HOSTILE, diagnostics=(said,), scenes=(odd, *others))


REPORTS = [pytest.param((report,), id=name) for name, report in SAMPLES.items()]
REPORTS += [
    pytest.param((), id="nothing"),
    pytest.param((waived(),), id="waived"),
    pytest.param((hostile(),), id="hostile"),
    pytest.param(tuple(SAMPLES.values()), id="all"),
]


def junit(reports: tuple[FileReport, ...]) -> Xml.Element:
    return Xml.fromstring(render(Format.JUNIT, reports))


def sarif(*reports: FileReport) -> dict[str, Any]:
    found = json.loads(render(Format.SARIF, reports))
    (run,) = found["runs"]
    assert isinstance(run, dict)
    return run


def places(path: str, code: str, kind: str) -> set[tuple[int, int]]:
    """Where SARIF shows the findings of a code."""
    return {
        (region["startLine"], region["startColumn"])
        for one in sarif(report_of_file(path))["results"]
        if (one["ruleId"], one["kind"]) == (code, kind)
        for region in (one["locations"][0]["physicalLocation"]["region"],)
    }


# -- JUnit ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("reports", REPORTS)
def test_junit_keeps_its_schema(reports: tuple[FileReport, ...]) -> None:
    assert list(JUNIT.problems(junit(reports))) == []


@pytest.mark.parametrize(
    "text",
    [
        "<testsuite/>",
        "<testsuites><testcase name='x'/></testsuites>",
        "<testsuite tests='1'><testcase name='x' colour='red'/></testsuite>",
        "<testsuite tests='1'>words</testsuite>",
        "<testsuite tests='1'><testcase name='x'><failed/></testcase></testsuite>",
        "<testcase name='x'><system-out><b/></system-out></testcase>",
    ],
)
def test_the_schema_of_junit_refuses(text: str) -> None:
    assert list(JUNIT.problems(Xml.fromstring(text))) != []


@pytest.mark.parametrize("reports", REPORTS)
def test_junit_counts_as_the_summary_does(reports: tuple[FileReport, ...]) -> None:
    root, totals = junit(reports), count(reports)
    cases = list(root.iter("testcase"))

    def outcomes(tag: str) -> int:
        return sum(case.find(tag) is not None for case in cases)

    assert int(root.attrib["tests"]) == len(cases)
    assert int(root.attrib["failures"]) == outcomes("failure") == totals["fail"]
    errors = totals["undecided"] + totals["not_checked"] + totals["invalid"]
    assert int(root.attrib["errors"]) == outcomes("error") == errors
    left_out = sum(one.state == "skipped" for report in reports for scene in report.scenes for one in scene.present)
    assert (
        sum(int(suite.attrib["skipped"]) for suite in root)
        == outcomes("skipped")
        == totals["waived"] + totals["off"] + left_out
    )
    made = sum(totals[name] for name in ("pass", "fail", "undecided", "not_checked", "waived", "off"))
    assert len(cases) == totals["files"] + made + left_out


def test_a_failure_of_junit_names_file_line_and_numbers() -> None:
    (suite,) = junit((report_of_file(FILES[1]),))
    (case,) = (case for case in suite if case.find("failure") is not None)
    assert (case.attrib["file"], case.attrib["line"]) == (FILES[1], "25")
    failure = case.find("failure")
    assert failure is not None
    assert "limit ≥ 1.2" in failure.attrib["message"]
    assert str(failure.text).startswith("25:15: CNV101 drive pulley traction reserve [run_loaded]")


# -- SARIF ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("reports", REPORTS)
def test_sarif_keeps_its_schema(reports: tuple[FileReport, ...]) -> None:
    found = json.loads(render(Format.SARIF, reports))
    assert [error.message for schema in (OFFICIAL, SARIF) for error in schema.iter_errors(found)] == []
    (run,) = found["runs"]
    rules = [rule["id"] for rule in run["tool"]["driver"]["rules"]]
    assert all(rules[one["ruleIndex"]] == one["ruleId"] for one in run["results"])
    assert run["properties"]["summary"] == count(reports)


@pytest.mark.parametrize(
    "wrong",
    [
        {"level": "severe"},
        {"message": {}},
        {"locations": [{"physicalLocation": {"region": {"startLine": 0}}}]},
        {"suppressions": [{"kind": "nowhere"}]},
        {"ruleindex": 1},
    ],
    ids=str,
)
def test_the_schema_of_sarif_refuses(wrong: dict[str, Any]) -> None:
    result = {"message": {"text": "x"}}
    for one, sound in ((result, True), (result | wrong, False)):
        log = {"version": "2.1.0", "runs": [{"tool": {"driver": {"name": "x"}}, "results": [one]}]}
        assert OFFICIAL.is_valid(log) is sound


def test_a_result_that_passes_has_no_level() -> None:
    faulty = {"version": "2.1.0", "runs": [{"tool": {"driver": {"name": "x"}}, "results": []}]}
    assert SARIF.is_valid(faulty)
    faulty["runs"][0]["results"] = [{"message": {"text": "x"}, "kind": "pass", "level": "error"}]  # type: ignore[index]
    assert not SARIF.is_valid(faulty)


def test_a_failed_check_an_undecided_one_and_a_faulty_unit_stand_in_their_regions() -> None:
    lines = (ROOT / FILES[1]).read_text("utf-8").splitlines()
    assert places(FILES[1], "CNV101", "fail") == {(25, 15)}
    assert lines[24][14:].startswith("0."), "the coefficient of friction itself"
    assert places(FILES[1], "CNV101", "review") == {(15, 1)}
    assert lines[14].startswith("resistance"), "its key is not written: the block it belongs into"
    assert places(FILES[2], "SPC106", "fail") == {(17, 8)}
    assert (ROOT / FILES[2]).read_text("utf-8").splitlines()[16][7:].startswith("2.5")


def cut(text: str, span: Span) -> str:
    """What stands at a place whose end is known."""
    return text.splitlines()[span.line - 1][span.column - 1 : (span.end or 0) - 1]


def unmeasured() -> tuple[str, str]:
    """A chain whose modulus nobody measured, near a resonance: the page it stands on, and its text there."""
    page = (ROOT / "tests/machines/chain_drive/resonance.md").read_text("utf-8")
    (text,) = re.findall("## A modulus that nobody measured\n.*?```yaml\n(.*?)```", page, re.DOTALL)
    return "chain.yaml", text


def faulty(name: str) -> tuple[str, str]:
    """A file, and its text."""
    return name, (ROOT / name).read_text("utf-8")


@pytest.mark.parametrize(
    ("file", "code", "kind", "stands"),
    [
        (faulty(FILES[1]), "CNV101", "fail", "0.10"),
        (unmeasured(), "CHN101", "review", "chain"),
        (faulty(FILES[2]), "SPC106", "fail", "2.5"),
    ],
    ids=["failed belt slip", "undecided resonance", "number without its unit"],
)
def test_a_region_holds_the_word_that_governs_and_no_more(
    file: tuple[str, str], code: str, kind: str, stands: str
) -> None:
    name, text = file
    report = check(load_text(text.encode(), name), Options(repairs=False))
    (found,) = (one for one in sarif(report)["results"] if (one["ruleId"], one["kind"]) == (code, kind))
    region = found["locations"][0]["physicalLocation"]["region"]
    assert region["startLine"] == region["endLine"]
    assert text.splitlines()[region["startLine"] - 1][region["startColumn"] - 1 : region["endColumn"] - 1] == stands


def test_places_of_all_words_of_a_file_end_where_the_words_end() -> None:
    for path in sorted((ROOT / "specs").glob("*.yaml")):
        text = path.read_text("utf-8")
        document = parse(text.encode(), path.name)
        for where, span in document.keys.items():
            assert cut(text, span) == where[-1]
        ended = {where: cut(text, span) for where, span in document.values.items() if span.end}
        assert len(ended) > 10
        for where, word in ended.items():
            value = reduce(lambda data, step: data[step], where, document.data)  # type: ignore[index, arg-type, return-value]
            assert yaml.safe_load(word) == value or resolve(word) == value


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("a: 4 m  # far", "4 m"),
        ("{name: \"重 ü\", a: '4 m', b: 1}", "'4 m'"),
        ("b: &x 4 m\r\na: *x\r\n", "4 m"),
        ("\ufeffa: 4 m", "4 m"),
    ],
)
def test_a_word_ends_where_it_ends_whatever_stands_beside_it(text: str, word: str) -> None:
    span = parse(text.encode(), "x.yaml").values["a",]
    assert cut(text.removeprefix("\ufeff"), span).removeprefix("&x ") == word


@pytest.mark.parametrize("text", ["a: 4\n  m", "a: |\n  4 m\n", "a: {b: 1}", "a: [1]", "a:\n  b: 1"])
def test_of_what_goes_on_below_no_end_is_told(text: str) -> None:
    span = parse(text.encode(), "x.yaml").values["a",]
    assert span.end is None


def test_a_check_without_its_input_is_open_and_a_waived_one_is_suppressed() -> None:
    (one,) = sarif(SAMPLES["not_checked"])["results"]
    assert (one["kind"], one["level"]) == ("open", "none")
    suppressed = [one for one in sarif(waived())["results"] if "suppressions" in one]
    assert [one["suppressions"][0]["kind"] for one in suppressed] == ["inSource"]
    assert "tested on the machine" in suppressed[0]["suppressions"][0]["justification"]


def test_fingerprints_outlive_edits_that_change_no_finding() -> None:
    text = (ROOT / FILES[1]).read_text("utf-8")
    moved = "# a comment\n\n" + text.replace("friction: 0.", "friction:   0.", 1)
    assert moved.count("\n") == text.count("\n") + 2

    def prints(raw: str) -> dict[str, tuple[int, str]]:
        run = sarif(check(load_text(raw.encode(), FILES[1]), Options(repairs=False)))
        return {
            one["partialFingerprints"]["ptmcalc/v1"]: (
                one["locations"][0]["physicalLocation"]["region"]["startLine"],
                one["ruleId"],
            )
            for one in run["results"]
        }

    before, after = prints(text), prints(moved)
    assert len(before) == sum(1 for _ in report_of_file(FILES[1]).judgements), "no two share one"
    assert {key: (line + 2, code) for key, (line, code) in before.items()} == after


# -- GitHub and Markdown --------------------------------------------------------------------------------------------

COMMAND = re.compile(
    r"::(error|warning|notice) file=[^,:\s]*(,line=[1-9][0-9]*,col=[1-9][0-9]*)?,title=[^,:\r\n]+::[^\r\n]+"
)


def test_a_command_names_file_line_column_and_code() -> None:
    first, *_ = render(Format.GITHUB, [report_of_file(FILES[1])]).splitlines()
    assert first.startswith(f"::error file={FILES[1]},line=25,col=15,title=fail CNV101 drive pulley traction reserve ")


@pytest.mark.parametrize("reports", [REPORTS[-1].values[0], (waived(),)], ids=["all", "waived"])
def test_every_line_but_the_last_is_a_command(reports: tuple[FileReport, ...]) -> None:
    *commands, summary = render(Format.GITHUB, reports).splitlines()
    assert all(COMMAND.fullmatch(line) for line in commands)
    assert not summary.startswith("::")
    totals = count(reports)
    findings = sum(one.severity is not Severity.NOTE for report in reports for one in report.diagnostics)
    assert len(commands) == findings + sum(totals[key] for key in ("fail", "undecided", "not_checked", "waived", "off"))


def test_hostile_names_stay_inside_their_command() -> None:
    *commands, _ = render(Format.GITHUB, [hostile()]).splitlines()
    assert len(commands) == 2
    for line in commands:
        properties, _, message = line[2:].partition("::")
        assert properties.count(",") == 1 + 2 * ("line=" in properties)
        assert "%250A" in message, "an escape of the file is no escape of ours"


def test_hostile_names_are_no_markup_of_a_comment() -> None:
    text = render(Format.MARKDOWN, [hostile()])
    assert "<script" not in text
    assert "@me" not in text
    assert "http://" not in text
    assert re.search(r"(?<!&)#1", text) is None
    assert "www." not in text
    assert "\x1b" not in text
    for line in text.splitlines():
        if line.startswith("|"):
            assert len(re.findall(r"(?<!\\)\|", line)) in (5, 10), "as many cells as the head has"


def test_hostile_names_come_back_from_xml_as_a_reader_sees_them() -> None:
    (suite,) = junit((hostile(),))
    (case,) = (case for case in suite if case.find("failure") is not None)
    assert "<script>&\"'" in case.attrib["name"]
    assert "\\x1b" in case.attrib["name"]
    assert "\n" not in case.attrib["name"]


def test_a_comment_says_what_does_not_pass_and_counts_the_rest() -> None:
    text = render(Format.MARKDOWN, [report_of_file(path) for path in FILES])
    assert "3 files, " in text
    assert "| **fail** | CNV101 drive pulley traction reserve \\[run\\_loaded\\] | 25:15 | 0.4348, limit ≥ 1.2" in text
    assert "**pass**" not in text
    assert f"### {FILES[0]}" not in text, "all of it passes"


def test_a_comment_stays_below_what_a_comment_may_be() -> None:
    many = tuple(replace(SAMPLES["failing"], path=f"folder/machine_{number}.yaml") for number in range(500))
    text = render(Format.MARKDOWN, many)
    assert len(text) < 65_536
    assert "300 more findings are not shown" in text
    assert "300 more files" in text
