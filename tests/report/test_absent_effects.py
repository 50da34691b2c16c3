"""An effect that a machine does not have is in no report that a person reads: one more effect of a kind changes only
the reports of machines that have it. The JSON lists every effect of the kind."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from support.command import ROOT, ptmcalc
from support.samples import SAMPLES
from support.toy_kind import STATICS
from support.toys import KN, effect, kind_of, loaded

from ptmcalc.base.estimate import NOTHING, Interval
from ptmcalc.contract.effect import AnyEffect, EffectState
from ptmcalc.contract.report import FileReport
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import Loaded, load_file
from ptmcalc.report import Format, html, render

FILES = ("specs/drivetrain.yaml", "specs/hoist/winding_paper/height_25_rope_17_5.yaml", "tests/cli/specs/slipping.yaml")


def with_effect(file: Loaded, more: AnyEffect) -> Loaded:
    """A machine of a kind that has one more effect, in all scenes."""
    assert file.kind is not None
    assert file.spec is not None
    scenes = frozenset(type(scene) for scene in file.spec.all_scenes)
    return replace(file, kind=replace(file.kind, effects=(*file.kind.effects, replace(more, scenes=scenes))))


def everything(report: FileReport) -> dict[str, str]:
    """The report in each format for people."""
    forms = {form.value: render(form, [report]) for form in Format if form is not Format.JSON}
    return forms | {"verbose": render(Format.TABLE, [report], verbose=True), "html": html.page(report, "")}


@pytest.mark.parametrize("path", FILES)
def test_one_more_effect_that_a_machine_does_not_have_changes_no_report(path: str) -> None:
    file = load_file(ROOT / path, path)
    more = with_effect(file, effect("ghost", 0.0, NOTHING))
    before, after = (check(one, Options(ledger=True)) for one in (file, more))
    assert everything(after) == everything(before)


@pytest.mark.parametrize("path", FILES)
def test_the_plan_lists_it_in_json_alone(path: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def read(place: Path, name: str, *others: Any) -> Loaded:
        return with_effect(load_file(place, name, *others), effect("ghost", 0.0, NOTHING))

    before = ptmcalc("plan", ROOT / path).out
    monkeypatch.setattr("ptmcalc.cli.listing.load_file", read)
    assert ptmcalc("plan", ROOT / path).out == before
    rows = json.loads(ptmcalc("plan", ROOT / path, "--format", "json").out)["rows"]
    assert {row["absent"] for row in rows if row["effect"] == "ghost"} == {True}


def test_a_simulated_effect_of_number_0_is_in_no_list() -> None:
    """Neither among the effects nor among those of a run; the JSON has it in both."""
    report = SAMPLES["passing"]
    (scene,) = report.scenes
    ghost = replace(scene.effects[0], name="ghost", state=EffectState.SIMULATED, absent=True, change=None)
    solvers = tuple(replace(one, effects=(*one.effects, "ghost")) for one in scene.solvers)
    haunted = replace(report, scenes=(replace(scene, effects=(*scene.effects, ghost), solvers=solvers),))
    assert everything(haunted) == everything(report)
    (found,) = json.loads(render(Format.JSON, [haunted]))["files"][0]["scenes"]
    assert [one["name"] for one in found["effects"] if one.get("absent")] == ["ghost"]
    assert all("ghost" in solver["effects"] for solver in found["solvers"])


SMALL = Interval(-1e-6 * KN, 0.0)


@pytest.mark.parametrize(
    ("make", "wish"),
    [
        (lambda: effect("ghost", 1e-300, NOTHING), "auto"),
        (lambda: effect("ghost", 0.0, SMALL), "auto"),
        (lambda: effect("ghost", 0.0, NOTHING), "off"),
        (lambda: effect("ghost", None, NOTHING), "auto"),
    ],
    ids=["small", "widens an error bar", "switched off", "input missing"],
)
def test_an_effect_that_is_left_out_for_another_reason_is_listed(make: Callable[[], AnyEffect], wish: str) -> None:
    report = check(loaded(kind_of(STATICS, effects=[make()]), effects={"ghost": wish}), Options())
    for name in ("table", "verbose", "html", "junit"):
        assert "ghost" in everything(report)[name], name
    (found,) = json.loads(render(Format.JSON, [report]))["files"][0]["scenes"]
    assert "absent" not in found["effects"][0]
