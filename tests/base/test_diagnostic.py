"""Codes that are not checks: what `explain` says of each, and the order of severities and verdicts."""

import ast
import re
from pathlib import Path

import pytest

import ptmcalc
from ptmcalc.base.diagnostic import BROKEN, CODES, Severity, Verdict

SOURCES = Path(ptmcalc.__file__).parent
USED = re.compile(r"(?:TXT|SPC|NUM)[0-9]{3}")


@pytest.mark.parametrize("code", CODES)
def test_a_code_is_three_letters_and_three_digits(code: str) -> None:
    assert re.fullmatch(r"(TXT|SPC|NUM|BUG)[1-9][0-9]{2}", code)


@pytest.mark.parametrize("code", CODES)
def test_a_title_finishes_the_question_is_there(code: str) -> None:
    title = CODES[code].title
    assert title[:1].islower()
    assert not title.endswith(".")
    assert not re.search(r"\ba [aeio]", title)


@pytest.mark.parametrize("code", CODES)
def test_reason_and_fix_are_sentences(code: str) -> None:
    for text in (CODES[code].why, CODES[code].fix):
        assert re.match(r"[A-Z`]", text)
        assert text.endswith(".")


def test_titles_tell_the_codes_apart() -> None:
    titles = [text.title for text in CODES.values()]
    assert len(set(titles)) == len(titles)


def test_no_code_stands_twice_in_the_table() -> None:
    """Of two equal keys in a dict display Python keeps the last without a word."""
    tree = ast.parse((SOURCES / "base" / "diagnostic.py").read_text("utf-8"))
    keys = [key.value for node in ast.walk(tree) if isinstance(node, ast.Dict) for key in node.keys if key]
    assert sorted(keys) == sorted(CODES)


def test_every_code_the_program_gives_is_explained_and_none_is_idle() -> None:
    sources = [file for file in SOURCES.rglob("*.py") if file.name != "diagnostic.py"]
    texts = [file.read_text("utf-8") for file in sources]
    used = {code for text in texts for code in USED.findall(text)}
    assert used == set(CODES) - {BROKEN}
    assert any("Diagnostic(BROKEN" in text for text in texts)


def test_severities_rise_from_note_to_error() -> None:
    assert sorted(Severity, key=lambda severity: severity.rank) == [Severity.NOTE, Severity.WARNING, Severity.ERROR]


def test_verdicts_are_ranked_from_the_worst() -> None:
    assert sorted(Verdict, key=lambda verdict: verdict.rank) == [
        Verdict.FAIL,
        Verdict.UNDECIDED,
        Verdict.NOT_CHECKED,
        Verdict.WAIVED,
        Verdict.PASS,
        Verdict.OFF,
    ]
