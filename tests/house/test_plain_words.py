"""Texts for users use the standard terms of the field, and titles are noun phrases."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from support.command import ROOT
from support.random_machines import KINDS

from ptmcalc.base.diagnostic import CODES
from ptmcalc.contract.check import LimitState
from ptmcalc.contract.machine import AnyKind

HOUSE_WORDS = (
    "askew|bears|blow|caught|dear|even|evenly|give|grip|honest|hollow|ledger|march|play|purse|rim|rung|sound|stray|strays"
    "|surely|told|way|witness|run-on|run-off"
)
"""Words that mean something else in this field, or nothing."""
NOWHERE = (
    "askew|asked|asks? for|bears|besides?|blows?|cheap(?:er|est)?|comes? up|dear(?:er|est)?|evenly|for good|goes by"
    "|goes with|go by|grips?|hardly|honest(?:ly)?|in step|ladders?|ledgers?|lies|look(?:s|ed|ing)? at|march(?:es|ing)?"
    "|mend(?:s|ed)?|next to no(?:thing)?|nobody|play|purses?|richer|richest|rims?(?!, web)|run-offs?|run-ons?|rungs?"
    "|said|says?|somebody|strays?|surely|tells?|told|wanted|wants|ways?|who|whoever|witness(?:es)?"
    "|comes? off|cut to pieces|feels?|fewest|for room|for want of|gives? way|half as (?:many|much) again|hardest"
    "|lets? go|makers?|nothing is known|of ours|out of reach|pulsates?|put right|snatch(?:es)?|stands? still"
    "|stopped dead|strangers?|tackles?|that gives|throws?|turns? round"
)
"""House words that no text for users has: titles, messages, hints, templates, help and pages."""
_NOWHERE = re.compile(rf"(?<!one-)(?<![.\w/-])\b({NOWHERE})\b(?![-\w]*[_.(]\w)", re.IGNORECASE)
DERIVED = "validation.md"
"""This page is made of the texts of tests."""
PAGES = [ROOT / "README.md", *sorted(path for path in (ROOT / "docs").rglob("*.md") if path.name != DERIVED)]
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


def texts_of(module: Path) -> Iterator[tuple[int, str]]:
    """(line, text) of every text of several words in a module: messages, hints, help, meanings. Docstrings only of
    commands."""
    tree = ast.parse(module.read_text("utf-8"))
    below = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    for node in ast.walk(tree):  # names of the members of a struct are no text
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "_members":
            below |= {id(word.value) for word in node.keywords}
    for node in ast.walk(tree):
        if (
            isinstance(node, ast.Constant)
            and isinstance(node.value, str)
            and " " in node.value
            and id(node) not in below
        ):
            yield node.lineno, node.value
        if isinstance(node, ast.FunctionDef) and node.decorator_list and module.match("cli/*.py"):
            yield node.lineno, ast.get_docstring(node) or ""


def found_in(text: str) -> list[str]:
    return [match[0].lower() for match in _NOWHERE.finditer(text)]


def test_messages_hints_and_help_have_no_house_word() -> None:
    package = ROOT / "ptmcalc"
    found = [
        (path.relative_to(ROOT).as_posix(), line, words)
        for path in sorted(package.rglob("*.py"))
        for line, text in texts_of(path)
        if (words := found_in(text))
    ]
    assert found == []


@pytest.mark.parametrize("form", ["*.yaml", "*.jinja"])
def test_templates_have_no_house_word(form: str) -> None:
    found = [
        (path.relative_to(ROOT).as_posix(), number, words)
        for path in sorted((ROOT / "ptmcalc").rglob(form))
        for number, line in enumerate(path.read_text("utf-8").splitlines(), 1)
        if (words := found_in(re.sub(r"{%.*?%}|{{.*?}}", "", line) if form == "*.jinja" else line))
    ]
    assert found == []


def descriptions(node: Any) -> Iterator[str]:
    """What an editor shows of the keys."""
    if isinstance(node, dict):
        if isinstance(node.get("description"), str):
            yield node["description"]
        node = list(node.values())
    for one in node if isinstance(node, list) else ():
        yield from descriptions(one)


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.label)
def test_keys_are_described_without_house_words(kind: AnyKind) -> None:
    texts = descriptions(kind.spec.model_json_schema())
    assert [(text, words) for text in texts if (words := found_in(text))] == []


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_pages_have_no_house_word(page: Path) -> None:
    """Names in backticks are those of the code."""
    lines = enumerate(re.sub(r"`[^`\n]*`", "", page.read_text("utf-8")).splitlines(), 1)
    assert [(number, words) for number, line in lines if (words := found_in(line))] == []


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("The finding is told at its place.", ["told"]),
        ("no default is honest", ["honest"]),
        ("next to nothing of it", ["next to nothing"]),
        ("a rack that gives", ["that gives"]),
        ("efficiency of the tackle", ["tackle"]),
        ("a one-way clutch", []),
        ("derived in ptmcalc.numerics.rope.march", []),
        ("the file states the speed", []),
    ],
)
def test_a_house_word_is_found_in_a_sentence(text: str, words: list[str]) -> None:
    assert found_in(text) == words
