"""All findings and verdicts of a file as one list, for the formats of continuous integration."""

import hashlib
import json
from collections.abc import Iterator
from dataclasses import dataclass

from ptmcalc.base.diagnostic import CODES, Severity, Verdict
from ptmcalc.base.span import KeyPath, Span
from ptmcalc.contract.check import Sense
from ptmcalc.contract.report import FileReport, Judgement
from ptmcalc.report import words

_RELATION = {Sense.AT_LEAST: "≥", Sense.AT_MOST: "≤"}


@dataclass(frozen=True, slots=True)
class Entry:
    """One diagnostic, or the verdict of one check in one scene."""

    state: Severity | Verdict
    code: str
    title: str
    message: str
    span: Span | None
    path: KeyPath
    scene: str = ""
    element: str = ""
    baseline: bool = False
    """True if a baseline waives it, not the file"""

    @property
    def fingerprint(self) -> str:
        """Stays the same while lines, numbers and words change: of code, scene, part of the machine and key."""
        what = json.dumps([self.code, self.scene, self.element, list(self.path)])
        return hashlib.sha256(what.encode()).hexdigest()[:32]

    @property
    def about(self) -> str:
        """Code, title and scene on one line."""
        where = f" [{self.scene}]" if self.scene else ""
        return f"{self.code} {self.title}{where}"


def entries(report: FileReport) -> Iterator[Entry]:
    """Diagnostics as they stand in the file, then verdicts, the worst first."""
    for one in report.diagnostics:
        text = CODES.get(one.code)
        message = f"{one.message}; {one.hint}" if one.hint else one.message
        yield Entry(one.severity, one.code, text.title if text else one.code, message, one.span, one.path)
    for scene, judgement in words.worst_first(report):
        yield Entry(
            judgement.verdict,
            judgement.code,
            words.subject(judgement),
            said(judgement) or judgement.verdict.value,
            judgement.blame.span,
            judgement.blame.path,
            scene,
            judgement.element,
            judgement.baseline,
        )


def said(judgement: Judgement) -> str:
    """The numbers of a verdict, and what it rests on besides them."""
    parts = []
    if judgement.value is not None and judgement.limit is not None:
        limit = words.amount(judgement.limit, judgement.quantity)
        value = words.value(judgement)
        parts.append(f"{value}, limit {_RELATION[judgement.sense]} {limit}")
    parts.append(words.remark(judgement))
    return "; ".join(filter(None, parts))
