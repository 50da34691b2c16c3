"""Number, revision and names of a project stand at the head of every report that people sign."""

import hashlib
import json

from ptmcalc.contract.report import FileReport
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text
from ptmcalc.report import Format, html, render

HEAD = "project: {number: P-2031, revision: B, checked_by: C. <Checker>}\n"
BELT = """
kind: conveyor
route: {length: 30 m, lift: 0 m}
belt: {width: 1000 mm, mass: 20 kg/m, modulus: 7000 N/mm, strength: 800 N/mm, carcass: textile}
idlers: {carry: {pitch: 1 m, set_mass: 20 kg}, return: {pitch: 3 m, set_mass: 18 kg}}
load: {mass: 100 kg/m}
resistance: {coefficient: 0.025, secondary: 2.0}
speed: 1 m/s
drive:
  motor: {inertia: 0.2 kg*m^2, speed: 1480 rpm, mean_starting_torque: 300 N*m}
  gear: {ratio: 49, efficiency: 0.94}
  drum: {diameter: 630 mm, wrap: 180 deg, friction: 0.3, inertia: 20 kg*m^2}
takeup: {type: gravity, tension: 1 kN}
scenes: [{type: run}]
"""


def report(text: str) -> FileReport:
    return check(load_text(text.encode(), "belt.yaml"), Options(repairs=False))


def test_the_head_stands_in_every_report_that_is_signed() -> None:
    found = report(HEAD + BELT)
    assert render(Format.TABLE, [found]).splitlines()[1] == " project P-2031, revision B, checked by C. <Checker>"
    assert "project P-2031, revision B, checked by C. &lt;Checker&gt;" in render(Format.MARKDOWN, [found])
    (file,) = json.loads(render(Format.JSON, [found]))["files"]
    assert file["project"] == {"number": "P-2031", "revision": "B", "checked_by": "C. <Checker>"}
    page = html.page(found, HEAD + BELT)
    for label, text in (("project", "P-2031"), ("revision", "B"), ("checked by", "C. &lt;Checker&gt;")):
        assert f"<dt>{label}</dt><dd>{text}</dd>" in page
    assert hashlib.sha256((HEAD + BELT).encode()).hexdigest() in page


def test_a_file_without_it_has_no_head_and_the_same_verdicts() -> None:
    with_head, without = report(HEAD + BELT), report(BELT)
    assert "project" not in render(Format.TABLE, [without])
    assert '"project"' not in render(Format.JSON, [without])
    assert [j.verdict for _, j in with_head.judgements] == [j.verdict for _, j in without.judgements]


def test_a_page_says_what_the_worst_check_means() -> None:
    page = html.page(report(BELT), BELT)
    assert "Is there" not in page
    assert "belt tension above slack limit: <b>belt tension falls below the slack limit</b>" in page


def test_a_wrong_key_of_the_head_is_named() -> None:
    (said,) = report(HEAD.replace("number", "numbr") + BELT).diagnostics
    assert "did you mean `number`" in said.message + said.hint
