"""Waivers of a file: what they hide, for how long, and what is said of those that hide nothing."""

from datetime import date, timedelta

import pytest
from support.design_files import place, problem_in, problems_in
from support.toy_kind import STATICS
from support.toys import kind_of, loaded

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import FileReport, count, exit_status
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text
from ptmcalc.engine.registry import load_kind

LAST = date(2027, 6, 30)
WAIVER = {"check": "TOY101", "reason": "the new hook comes in May", "until": LAST.isoformat()}
GUST, CALM = {"type": "hang", "name": "gust", "share": 1}, {"type": "hang", "name": "calm", "share": 0.5}


def report(today: date = LAST, load: str = "12 kN", scenes: tuple[str, ...] = (), **more: object) -> FileReport:
    """A hook that is overloaded in a gust, with a waiver."""
    machine = loaded(kind_of(STATICS), load=load, scenes=[GUST, CALM], **({"waive": [WAIVER]} | more))
    return check(machine, Options(today=today, scenes=scenes))


def said(found: FileReport) -> list[str]:
    return [one.code for one in found.diagnostics]


def test_a_waiver_hides_what_fails_and_is_counted() -> None:
    found = report()
    assert [judgement.verdict for _, judgement in found.judgements] == [Verdict.WAIVED, Verdict.PASS]
    assert next(found.judgements)[1].reason.startswith("fail, waived until 2027-06-30: the new hook comes in May")
    assert (found.verdict, exit_status((found,)), said(found)) == ("pass", 0, [])
    assert (count((found,))["waived"], count((found,))["fail"]) == (1, 0)
    assert report(waive=[]).verdict == "fail"


def test_it_holds_on_its_last_day_and_no_longer() -> None:
    late = report(today=LAST + timedelta(days=1))
    assert (late.verdict, exit_status((late,)), said(late)) == ("fail", 1, ["SPC202"])
    assert late.diagnostics[0].path == ("waive", 0, "until")
    assert report(today=LAST - timedelta(days=400)).verdict == "pass"


def test_what_is_not_checked_can_be_waived_too() -> None:
    found = report(strength=None)
    assert {judgement.verdict for _, judgement in found.judgements} == {Verdict.WAIVED}
    assert found.verdict == "pass"
    assert report(strength=None, waive=[]).verdict == "undecided"


def test_a_waiver_nothing_needs_is_told_once_the_whole_file_was_looked_at() -> None:
    idle = report(load="1 kN")
    assert (idle.verdict, said(idle)) == ("pass", ["SPC203"])
    assert idle.diagnostics[0].path == ("waive", 0, "check")
    assert said(report(scenes=("calm",))) == []
    assert said(report(load="1 kN", today=LAST + timedelta(days=1))) == ["SPC202"], "not both"


TEMPLATE = load_kind("conveyor").template
SOUND = '  - {check: CNV101, reason: "new drum", until: 2027-06-30}\n'


@pytest.mark.parametrize(
    ("waivers", "code", "at", "words"),
    [
        ("  - {check: CNV999, reason: x, until: 2027-06-30}\n", "SPC112", (2, 13), "no check has the code `CNV999`"),
        ("  - {check: CNV101, reason: x, until: 30.6.2027}\n", "SPC111", (2, 39), "expected a day, found `30.6.2027`"),
        ("  - {check: CNV101, reason: x, until: 2027-02-30}\n", "SPC111", (2, 39), "expected a day"),
        ("  - {check: CNV101, reason: x, until: 20270630}\n", "SPC111", (2, 39), "expected a day"),
        ('  - {check: CNV101, reason: "", until: 2027-06-30}\n', "SPC110", (2, 29), "at least 1 character"),
        ("  - {check: CNV101, until: 2027-06-30}\n", "SPC103", (2, 5), "`reason` is missing under `waive[0]`"),
        ("  - {check: CNV101, reason: x}\n", "SPC103", (2, 5), "`until` is missing under `waive[0]`"),
        ("  - {check: CNV101, reason: x, untill: 2027-06-30}\n", "SPC104", (2, 32), "did you mean `until`?"),
        ("  - CNV101\n", "SPC111", (2, 5), "a mapping"),
        (SOUND + SOUND, "SPC113", (3, 5), "`CNV101` is waived twice"),
    ],
)
def test_a_faulty_waiver_is_told_at_its_place(waivers: str, code: str, at: tuple[int, int], words: str) -> None:
    found = problem_in(f"waive:\n{waivers}{TEMPLATE}")
    assert (found.code, place(found)) == (code, at)
    assert words in f"{found.message} {found.hint}"


def test_all_faults_of_waivers_are_told_at_once() -> None:
    text = f"waive:\n  - {{check: CNV999, reason: x, until: soon}}\n  - {{check: CNV101, reason: x}}\n{TEMPLATE}"
    assert [one.code for one in problems_in(text)] == ["SPC112", "SPC111", "SPC103"]


def test_every_kind_takes_waivers() -> None:
    read = load_text(f"waive:\n{SOUND}{TEMPLATE}".encode(), "x.yaml")
    assert read.spec is not None
    assert read.spec.waive[0].until == LAST
