"""What a process of a batch does: texts in, answers out. Importing this module imports all that a check needs."""

import math
from collections.abc import Sequence
from datetime import date

from ptmcalc.engine.batch import Answer, fresh_within, record_of, spent
from ptmcalc.engine.check import Options
from ptmcalc.report import json


def with_text(texts: Sequence[bytes], options: Options, patience: float = math.inf) -> list[Answer]:
    """Records of some design files with their JSON."""
    return [_answer(raw, options, patience) for raw in texts]


def only_text(texts: Sequence[bytes], options: Options, patience: float = math.inf) -> list[Answer]:
    """The JSON of some design files, and of their records no more than that needs."""
    return [_answer(raw, options, patience, whole=False) for raw in texts]


def without_text(texts: Sequence[bytes], options: Options, patience: float = math.inf) -> list[Answer]:
    """Records of some design files."""
    return [_answer(raw, options, patience, in_json=False) for raw in texts]


def _answer(raw: bytes, options: Options, patience: float, *, in_json: bool = True, whole: bool = True) -> Answer:
    report = fresh_within(raw, options, patience)
    if isinstance(report, float):
        return Answer(report)
    text = json.part_of(report).encode() if in_json else b""
    return Answer(spent(report), record_of(report, raw, options.today or date.today(), text, whole=whole))
