"""What a process of a batch does: texts in, answers out. Importing this module imports all that a check needs."""

import math
from collections.abc import Sequence
from contextlib import nullcontext
from datetime import date

from ptmcalc.engine.batch import Answer, fresh_within, record_of, spent
from ptmcalc.engine.check import Options
from ptmcalc.engine.keep import Keeper
from ptmcalc.report import json


def with_text(texts: Sequence[bytes], options: Options, patience: float = math.inf, place: str = "") -> list[Answer]:
    """Records of some design files with their JSON; each is in the store at `place` soon after it is made."""
    return _answers(texts, options, patience, place)


def only_text(texts: Sequence[bytes], options: Options, patience: float = math.inf, place: str = "") -> list[Answer]:
    """The JSON of some design files, and of their records no more than that needs."""
    return _answers(texts, options, patience, place, whole=False)


def without_text(texts: Sequence[bytes], options: Options, patience: float = math.inf, place: str = "") -> list[Answer]:
    """Records of some design files."""
    return _answers(texts, options, patience, place, in_json=False)


def _answers(
    texts: Sequence[bytes],
    options: Options,
    patience: float,
    place: str,
    *,
    in_json: bool = True,
    whole: bool = True,
) -> list[Answer]:
    answers = []
    with Keeper(place, options) if place and len(texts) > 1 else nullcontext() as keeper:
        for raw in texts:
            answers.append(_answer(raw, options, patience, in_json=in_json, whole=whole))
            record = answers[-1].record
            if keeper is not None and record is not None:
                keeper.add(raw, record)
    return answers


def _answer(raw: bytes, options: Options, patience: float, *, in_json: bool, whole: bool) -> Answer:
    report = fresh_within(raw, options, patience)
    if isinstance(report, float):
        return Answer(report)
    text = json.part_of(report).encode() if in_json else b""
    return Answer(spent(report), record_of(report, raw, options.today or date.today(), text, whole=whole))
