"""Small machines of `tests/edges` and what is reported of them."""

from dataclasses import replace
from functools import cache
from pathlib import Path

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.report import FileReport, Judgement
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text
from ptmcalc.engine.run import WORK_BUDGET

EDGES = Path(__file__).parents[1] / "edges"


@cache
def report_on(
    name: str, *changes: tuple[str, str], folder: Path = EDGES, budget: float = WORK_BUDGET, ends: bool = True
) -> FileReport:
    """The report of a machine, `conveyor/takeup-mass`, with some texts of its file replaced.

    A test of loads alone may leave out the `ends` of assumed values, which change none, and solvers beyond a budget.
    """
    text = (folder / f"{name}.yaml").read_text(encoding="utf-8")
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new)
    loaded = load_text(text.encode(), f"{name}.yaml")
    return check(loaded if ends else replace(loaded, assumed=()), Options(repairs=False, budget=budget))


def judged(found: FileReport, code: str, scene: str = "", element: str | None = None) -> Judgement:
    """The verdict of a check in a scene, and of an element; of the only one, where none is named."""
    named = [
        one
        for where, one in found.judgements
        if one.code == code and scene in ("", where.name) and element in (None, one.element)
    ]
    assert len(named) == 1, [(one.code, one.element) for one in named]
    return named[0]


def verdict(found: FileReport, code: str, scene: str = "") -> Verdict:
    """The verdict of a check in a scene."""
    return judged(found, code, scene).verdict


def load(found: FileReport, name: str, scene: str = "") -> Estimate:
    """A load of a scene; of the only one that has it, where none is named."""
    known = [
        one.estimate
        for where in found.scenes
        for one in where.loads
        if one.info.name == name and scene in ("", where.name)
    ]
    assert len(known) == 1, name
    return known[0]


def codes(found: FileReport) -> set[str]:
    """The codes of what is said besides verdicts."""
    return {one.code for one in found.diagnostics}
