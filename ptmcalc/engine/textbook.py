"""Where a textbook formula, used within its own range, is far from what was computed."""

import math

from ptmcalc.base.diagnostic import Diagnostic, Severity
from ptmcalc.base.units import show
from ptmcalc.contract.report import LoadReport, SceneReport
from ptmcalc.engine.load import Loaded

OF_TEXTBOOKS = frozenset({"NUM107", "NUM108"})
"""Findings about a textbook's formula, not about a number of ours."""
FAR = 0.1
"""Difference from a textbook value beyond the error bar, relative to that value [1], from which on it is reported. An
engineering choice: a smaller value reports usual simplifications; a larger one hides wrong formulas."""


def far_from_textbook(loaded: Loaded, scene: SceneReport) -> Diagnostic | None:
    """A note on the governing load of a scene that differs most from its textbook formula; None where none is far off.

    A formula is only shown where its solver calls itself valid.
    """
    load = max(scene.loads, key=_apart, default=None)
    if load is None or load.formula is None or _apart(load) <= FAR:
        return None
    textbook, found = (show(value, load.info.quantity) for value in (load.formula.value, load.estimate.value))
    message = (
        f"scene `{scene.name}`: {load.info.title}: computed {found}, textbook formula `{load.formula.name}` {textbook};"
        " use the computed value"
    )
    written = isinstance(loaded.document.data, dict) and "scenes" in loaded.document.data
    path = ("scenes",) if written else ()
    return Diagnostic("NUM107", message, loaded.document.value_span(path), path, "", Severity.NOTE)


def _apart(load: LoadReport) -> float:
    """How far the formula lies outside the error bar, over the formula."""
    if not load.formulas or not load.info.headline or not load.estimate.bounded:
        return 0.0
    formula, known = load.formulas[-1], load.estimate
    if not formula.value or not math.isfinite(formula.value):
        return 0.0
    return abs(min(max(formula.value, known.low), known.high) / formula.value - 1)
