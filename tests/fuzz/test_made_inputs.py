"""Inputs that nobody wrote: sound files changed key by key and byte by byte, and YAML from nothing.

Twenty thousand in ten parts, of which each commit takes another one (`support.turns`). All of them, and a million:
`python -m pytest tests/fuzz -n 2 --dist load -m study`.
"""

import re
import warnings
from collections import Counter

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st
from support import fuzz
from support.fuzz import FORMS, MAKERS, failures, in_wrong_forms, left_out, made, said, slots, sound, trees, written
from support.turns import in_turn

from ptmcalc.base.diagnostic import BROKEN
from ptmcalc.engine import load
from ptmcalc.engine.check import Options, check
from ptmcalc.report import json as report_json
from ptmcalc.spec import problems

FIRST, IN_CI, ALL, PART = 1_000, 19_500, 1_000_000, 1_850
"""The first ones are separated below and must hold too; hypothesis makes 100 more."""


@pytest.mark.parametrize("first", in_turn(range(FIRST, IN_CI, PART)))
def test_no_input_breaks_the_program_or_hangs_it(first: int) -> None:
    assert failures(range(first, first + PART)) == []


@pytest.mark.study
@pytest.mark.parametrize("first", range(IN_CI, ALL, 10_000))
def test_no_input_of_a_million_breaks_the_program_or_hangs_it(first: int) -> None:
    assert failures(range(first, min(first + 10_000, ALL))) == []


# -- every key in every wrong form, or left out -----------------------------------------------------------------------


@pytest.mark.parametrize("part", in_turn(range(4)))
def test_no_key_of_any_kind_breaks_the_program_in_a_wrong_form(part: int) -> None:
    """A mapping, a list, a list of mappings, and one of the others in turn."""
    worst = ({}, [], [{}])
    for number, slot in enumerate(slots()):
        if number % 4 == part:
            for raw in in_wrong_forms(slot, (*worst, FORMS[number // 4 % len(FORMS)])):
                found = load.load_text(raw, "fuzz.yaml")
                assert found.spec is not None or found.diagnostics, slot


@pytest.mark.study
@pytest.mark.parametrize("part", range(20))
def test_no_key_of_any_kind_breaks_the_program_in_any_form(part: int) -> None:
    for slot in slots()[part::20]:
        for raw in in_wrong_forms(slot):
            assert said(raw).status in (0, 1, 2, 3), slot


@pytest.mark.parametrize("part", in_turn(range(24)))
def test_anything_may_be_left_out(part: int) -> None:
    """What is then refused is told why; what is not can be planned and run, every scene of it."""
    for raw in sorted(set(left_out()))[part::24]:
        found = load.load_text(raw, "fuzz.yaml")
        if found.spec is None:
            assert found.diagnostics
        else:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                report = check(found, Options(budget=fuzz.BUDGET, repairs=False))
            assert BROKEN not in {d.code for d in report.diagnostics}, raw


def test_the_wrong_forms_are_of_every_key() -> None:
    """A key of a scene, of one of several types of a block, of a part by name, and of a check are among them."""
    keys = {".".join(map(str, path)) for _, path, _ in slots()}
    assert keys >= {
        "scenes.0.name",
        "waive.0.until",
        "checks.irregularity",
        "inertia.crank_radius",
        "drives.part.delay",
    }
    assert len(keys) > 500


# -- YAML of any shape, which hypothesis makes and shrinks ----------------------------------------------------------

WORDS = st.sampled_from(sorted({key for tree in trees() for key, _ in tree} | {"<<", "type", "", "\x1b[0m", "a.b"}))
SCALARS = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.floats(),
    st.text(max_size=20),
    st.sampled_from((*fuzz.ODD_NUMBERS, *fuzz.ODD_UNITS)),
    st.builds("{} {}".format, st.floats(allow_nan=False), st.sampled_from(sorted(fuzz.UNITS))),
)
VALUES = st.recursive(
    SCALARS, lambda inner: st.lists(inner, max_size=4) | st.dictionaries(WORDS, inner, max_size=4), max_leaves=12
)


@settings(max_examples=100, deadline=None)
@given(
    kind=st.sampled_from([*load.kind_names(), ""]),
    body=st.dictionaries(WORDS, VALUES, max_size=8),
    flow=st.booleans(),
)
def test_any_yaml_is_answered(kind: str, body: dict[str, object], flow: bool) -> None:
    text = yaml.safe_dump({"kind": kind} | body, default_flow_style=flow, allow_unicode=True, sort_keys=False)
    said(text.encode("utf-8", "surrogatepass"))


# -- what the inputs are --------------------------------------------------------------------------------------------


def test_inputs_are_made_again_by_their_numbers_and_differ() -> None:
    numbers = range(400)
    assert [made(n) for n in numbers] == [made(n) for n in numbers]
    assert len({made(n) for n in numbers}) > 0.95 * len(numbers)


def test_every_sound_file_is_written_again_from_its_tree() -> None:
    for (name, raw), tree in zip(sound(), trees(), strict=True):
        first, again = (load.load_text(text, name).spec for text in (raw, written(tree)))
        assert first is not None
        assert first == again, name


def test_the_inputs_reach_every_floor() -> None:
    """Some are no text, some no machine, some a machine, of each way in which they are made; most kinds of faults are
    among them."""
    found: Counter[tuple[str, bool]] = Counter()
    codes: set[str] = set()
    for number in range(FIRST):
        answer = said(made(number), number)
        found[MAKERS[number % len(MAKERS)].__name__, answer.valid] += 1
        codes |= set(answer.codes)
    assert found["from_tree", True] > 50
    assert found["from_tree", False] > 50
    assert found["from_bytes", True] > 50
    assert found["from_bytes", False] > 50
    assert found["from_grammar", False] > 50
    refused = {f"TXT{n}" for n in (103, 104, 105, 106, 110)} | {f"SPC{n}" for n in (*range(101, 107), *range(108, 115))}
    assert codes >= refused


# -- the watch itself -----------------------------------------------------------------------------------------------


def test_an_input_that_hangs_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    def forever(*_: object) -> None:
        while True:
            pass

    monkeypatch.setattr(fuzz, "load_text", forever)
    monkeypatch.setattr(fuzz, "HUNG", 0.05)
    (found,) = failures(range(1))
    assert "HungError" in found


def test_an_input_that_breaks_the_program_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(report_json, "finite", lambda value: value / 0)
    monkeypatch.setattr(problems, "problems_of", lambda *_: iter([None]))
    found = failures(range(40))
    assert found
    assert all(re.match(r"made\([0-9]+\): [A-Za-z]+Error in \w+\.py:[0-9]+ ", one) for one in found)
