"""Titles and labels use the standard terms of the field."""

import re
from collections.abc import Iterator

import pytest
from support.random_machines import KINDS

from ptmcalc.base.diagnostic import CODES
from ptmcalc.contract.check import LimitState

HOUSE_WORDS = (
    "askew|bears|blow|caught|dear|even|evenly|grip|honest|hollow|ledger|march|play|purse|rim|rung|sound|stray|strays"
    "|surely|told|way|witness|run-on|run-off"
)
"""Words that mean something else in this field, or nothing."""
_WORDS = re.compile(rf"\b({HOUSE_WORDS})\b", re.IGNORECASE)
_NO_TITLE = re.compile(r"^(a|an|the|too|what|who|that)\b", re.IGNORECASE)


def titles() -> Iterator[tuple[str, str]]:
    """(name, title) of every check, load, effect, solver and finding."""
    for kind in KINDS:
        for check in kind.checks:
            yield f"{kind.label} {check.code}", check.title
        for group in (kind.loads, kind.effects, kind.solvers):
            yield from ((f"{kind.label} {one.name}", one.title) for one in group)
    yield from ((code, text.title) for code, text in CODES.items())


def sentences() -> Iterator[tuple[str, str]]:
    """(code, text) of the question, the meaning of a failure and the limit state of every check."""
    for kind in KINDS:
        for check in kind.checks:
            state = check.limit_state or LimitState("")
            yield from ((check.code, text) for text in (check.question, check.failure, state.text) if text)


def test_titles_have_no_house_word() -> None:
    assert [(name, title) for name, title in (*titles(), *sentences()) if _WORDS.search(title)] == []


def test_titles_are_noun_phrases_without_article() -> None:
    assert [(name, title) for name, title in titles() if _NO_TITLE.search(title) or title.endswith(".")] == []


def test_a_check_asks_one_question_and_says_what_its_failure_means() -> None:
    for kind in KINDS:
        for check in kind.checks:
            assert check.question.endswith("?"), check.code
            assert check.failure, check.code
            assert not check.failure.endswith("."), check.code


@pytest.mark.parametrize("title", ["a slack belt", "way of the stop", "reserve of grip"])
def test_a_house_word_is_found(title: str) -> None:
    assert _WORDS.search(title) or _NO_TITLE.search(title)
