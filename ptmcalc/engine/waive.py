"""What a file says of checks that may fail for a while: by whom it is known, why, and until when."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from datetime import date

from ptmcalc.base.diagnostic import Diagnostic, Severity, Verdict
from ptmcalc.contract.report import Judgement, SceneReport
from ptmcalc.spec.machine import MachineSpec, Waiver
from ptmcalc.text.document import Document

_BAD = (Verdict.FAIL, Verdict.UNDECIDED, Verdict.NOT_CHECKED)


def waived(spec: MachineSpec, scenes: Sequence[SceneReport], today: date) -> tuple[SceneReport, ...]:
    """The scenes with every bad verdict waived that the file has a waiver for; an expired one hides nothing."""
    valid = {waiver.check: waiver for waiver in spec.waive if waiver.until >= today}
    return tuple(
        replace(scene, checks=tuple(_waived(judgement, valid.get(judgement.code)) for judgement in scene.checks))
        for scene in scenes
    )


def _waived(judgement: Judgement, waiver: Waiver | None) -> Judgement:
    if waiver is None or judgement.verdict not in _BAD:
        return judgement
    said = f"{judgement.verdict.value}, waived until {waiver.until.isoformat()}: {waiver.reason}"
    return replace(judgement, verdict=Verdict.WAIVED, reason="; ".join(filter(None, (said, judgement.reason))))


def about_waivers(
    spec: MachineSpec, scenes: Sequence[SceneReport], today: date, document: Document, *, whole: bool
) -> Iterator[Diagnostic]:
    """Waivers that have expired, and of a `whole` file those that nothing needs, as the verdicts stand without them."""
    needed = {judgement.code for scene in scenes for judgement in scene.checks if judgement.verdict in _BAD}
    for index, waiver in enumerate(spec.waive):
        if waiver.until < today:
            path = ("waive", index, "until")
            message = f"the waiver of {waiver.check} ended with {waiver.until.isoformat()}"
            hint = "correct the design, or renew `until` with its reason"
            yield Diagnostic("SPC202", message, document.value_span(path), path, hint, Severity.WARNING)
        elif whole and waiver.check not in needed:
            path = ("waive", index, "check")
            message = f"the waiver of {waiver.check} is unused: the check does not fail"
            yield Diagnostic("SPC203", message, document.value_span(path), path, "delete it", Severity.WARNING)
