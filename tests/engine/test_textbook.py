"""A textbook formula that is far off is said, once a scene; one inside the bar or near it is not."""

import pytest
from support.machines import changed, load_of, report_of, scene_of, template

from ptmcalc.base.diagnostic import Diagnostic, Severity
from ptmcalc.contract.report import FileReport
from ptmcalc.engine.textbook import FAR

START = {"type": "start"}


def notes(report: FileReport) -> list[Diagnostic]:
    return [found for found in report.diagnostics if found.code == "NUM107"]


def test_a_formula_that_is_far_off_is_named_with_both_values() -> None:
    """The direct wave alone against the waves with their echoes."""
    report = report_of(changed(template(), scenes=[START], accuracy="1 %"))
    (note,) = notes(report)
    load = load_of(scene_of(report), "tension_dynamic_run_on_max")
    assert load.formula is not None
    assert load.estimate.low / load.formula.value > 1 + FAR
    assert note.severity is Severity.NOTE
    for word in ("start_loaded", load.info.title, "first_wave", "kN"):
        assert word in note.message
    assert note.path == ("scenes",)


@pytest.mark.parametrize("scene", [{"type": "run"}, {"type": "start", "profile": {"shape": "cosine", "time": "60 s"}}])
def test_nothing_is_said_where_no_formula_is_far_off(scene: dict[str, object]) -> None:
    assert notes(report_of(changed(template(), scenes=[scene]))) == []


def test_one_note_a_scene_and_no_verdict_changes() -> None:
    scenes = [START, START | {"load": "empty", "name": "empty"}]
    data = changed(template(), takeup__tension="120 kN", belt__strength="2000 N/mm", scenes=scenes, accuracy="1 %")
    report = report_of(data)
    assert len(notes(report)) <= 2
    assert report.verdict == "pass"
