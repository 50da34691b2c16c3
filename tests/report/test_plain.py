"""The plain lines: one `file:line:column: verdict CODE ...` each, for editors, logs and grep."""

import re
from dataclasses import replace

import pytest
from support.command import report_of_file
from support.samples import SAMPLES

from ptmcalc.base.diagnostic import Diagnostic
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.report import FileReport
from ptmcalc.report import Format, render

FILES = ("specs/conveyor.yaml", "tests/cli/specs/slipping.yaml", "tests/cli/specs/faulty.yaml")
LINE = re.compile(
    r"(?P<file>[^:\s]+):(?P<line>[1-9][0-9]*):(?P<column>[1-9][0-9]*): "
    r"(?P<verdict>fail|undecided|not_checked|waived|pass|error|warning|note) (?P<code>[A-Z]{3}[0-9]{3}) (?P<rest>\S.*)"
)
RANK = ["fail", "undecided", "not_checked", "waived", "pass", "off"]


def lines(name: str) -> list[str]:
    *found, _ = render(Format.PLAIN, [SAMPLES[name]]).splitlines()
    return found


@pytest.mark.parametrize("path", FILES)
def test_every_line_has_its_place_verdict_and_code(path: str) -> None:
    *found, summary = render(Format.PLAIN, [report_of_file(path)]).splitlines()
    assert found
    for line in found:
        match = LINE.fullmatch(line)
        assert match is not None, line
        assert match["file"] == path
    assert summary.startswith("1 file, ")


@pytest.mark.parametrize("path", FILES[:2])
def test_the_worst_come_first(path: str) -> None:
    matches = [LINE.fullmatch(line) for line in render(Format.PLAIN, [report_of_file(path)]).splitlines()]
    ranks = [RANK.index(match["verdict"]) for match in matches if match and match["verdict"] in RANK]
    assert ranks == sorted(ranks)
    assert len(ranks) > 5


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        (
            "failing",
            [
                "toy.yaml:2:7: fail TOY101 weight on the hook [gust]: 13.2 kN, limit ≤ 10 kN;"
                " hook is overloaded; passes with load = 9.09 kN",
                "toy.yaml:2:7: pass TOY101 weight on the hook [calm]: 6.6 kN, limit ≤ 10 kN",
            ],
        ),
        (
            "undecided",
            [  # blamed on the key that is not written: where its parent, the whole file, begins
                "toy.yaml:1:1: undecided TOY101 weight on the hook [hang]: 9.35 kN, limit ≤ 10 kN;"
                " fail if `shock` is 1.2: give its value"
            ],
        ),
        (
            "open_bar",
            [
                "toy.yaml:2:7: undecided TOY101 weight on the hook [hang]: 8 kN (no bound), limit ≤ 10 kN;"
                " `pull`: no error bound, `hanging` neglects `waves`"
            ],
        ),
        (
            "not_checked",
            ["toy.yaml:3:11: not_checked TOY101 weight on the hook [hang]: `strength` is not given"],
        ),
        (
            "switched_off",
            [
                "toy.yaml:5:3: warning SPC204 nothing was checked: every check that applies is switched off (1);"
                " delete an `off`",
                "toy.yaml:6:12: off TOY101 weight on the hook [hang]: a show piece",
            ],
        ),
        (
            "passing",
            ["toy.yaml:2:7: pass TOY101 weight on the hook [hang]: 9.00 ±0.25 kN, limit ≤ 10 kN; without rain"],
        ),
        (
            "moving",
            [
                "toy.yaml:2:7: pass TOY101 weight on the hook: rope [gust]: 9 kN, limit ≤ 10 kN",
                "toy.yaml:2:7: pass TOY101 weight on the hook: hook [gust]: 8 kN, limit ≤ 10 kN",
                "toy.yaml:2:7: pass TOY101 weight on the hook: rope [calm]: 4.5 kN, limit ≤ 10 kN",
                "toy.yaml:2:7: pass TOY101 weight on the hook: hook [calm]: 4 kN, limit ≤ 10 kN",
            ],
        ),
        (
            "warned",
            [
                "toy.yaml:2:7: warning NUM104 the rope was slack for a moment; hang it gently",
                "toy.yaml:2:7: pass TOY101 weight on the hook [hang]: 9 kN, limit ≤ 10 kN",
            ],
        ),
    ],
)
def test_a_line_says_what_a_reader_needs(name: str, expected: list[str]) -> None:
    assert lines(name) == expected


def test_findings_of_a_file_without_a_place_name_the_file_alone() -> None:
    nowhere = FileReport("specs", diagnostics=(Diagnostic("TXT102", "the folder holds no design file"),))
    assert render(Format.PLAIN, [nowhere]).splitlines()[0] == "specs: error TXT102 the folder holds no design file"


@pytest.mark.parametrize(
    ("names", "summary"),
    [
        ((), "0 files, 0 checks passed"),
        (("infinite",), "1 file, 2 checks passed"),
        (("failing", "undecided", "passing"), "3 files, 2 checks passed, 1 failed, 1 undecided"),
        (("invalid", "not_checked"), "2 files, 0 checks passed, 1 invalid, 1 not checked"),
    ],
)
def test_the_last_line_counts(names: tuple[str, ...], summary: str) -> None:
    assert render(Format.PLAIN, [SAMPLES[name] for name in names]).splitlines()[-1] == summary


@pytest.mark.parametrize(("value", "printed"), [(10_000.4, "10.0004"), (10_400.0, "10.4"), (10_000.0, "10")])
def test_a_value_that_is_not_its_limit_does_not_read_like_it(value: float, printed: str) -> None:
    report = SAMPLES["failing"]
    (first, *others) = report.scenes
    judged = replace(first.checks[0], value=Estimate.exact(value))
    text = render(Format.PLAIN, [replace(report, scenes=(replace(first, checks=(judged,)), *others))])
    assert f": {printed} kN, limit ≤ 10 kN" in text
