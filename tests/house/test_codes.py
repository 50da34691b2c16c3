"""Codes and names: unique, of one form, and known to `explain`."""

import re
from collections import Counter

from support.each import over

from ptmcalc.base.diagnostic import CODES
from ptmcalc.cli.explain import explanation
from ptmcalc.contract.machine import AnyKind
from ptmcalc.engine.registry import kind_names, load_kind

KINDS = [load_kind(name) for name in kind_names()]
CHECKS = [check for kind in KINDS for check in kind.checks]
EFFECTS = [effect for kind in KINDS for effect in kind.effects]
SOLVERS = [solver for kind in KINDS for solver in kind.solvers]
NAMES = [*(effect.name for effect in EFFECTS), *(solver.name for solver in SOLVERS)]
TITLES = {code: text.title for code, text in CODES.items()} | {check.code: check.title for check in CHECKS}

of_every_kind = over(dict(zip(kind_names(), KINDS, strict=True)))


def test_codes_are_unique_over_all_kinds_and_findings() -> None:
    counted = Counter([*CODES, *(check.code for check in CHECKS)])
    assert [code for code, times in counted.items() if times > 1] == []


@over(TITLES.keys())
def test_a_code_is_three_letters_and_three_digits(code: str) -> None:
    assert re.fullmatch("[A-Z]{3}[0-9]{3}", code)


@over({code: (code, title) for code, title in TITLES.items()})
def test_a_title_is_a_noun_phrase(code: str, title: str) -> None:
    """`drive pulley traction reserve`: no sentence of its own, and nothing that cannot be there."""
    assert title == title.strip()
    assert re.match("[a-z0-9]|YAML", title), title
    assert title[-1] not in ".?!"
    assert not re.match(r"(the|is|are|there|no|not)\b", title)
    assert len(title) <= 60


@over(CODES.keys())
def test_a_finding_says_why_and_what_to_do_in_sentences(code: str) -> None:
    for text in (CODES[code].why, CODES[code].fix):
        assert text.endswith(".")
        assert text[0].isupper() or text[0] == "`"


@of_every_kind
def test_the_checks_of_a_kind_share_letters_of_their_own(kind: AnyKind) -> None:
    letters = {check.code[:3] for check in kind.checks}
    assert len(letters) == 1
    others = {code[:3] for code in CODES} | {check.code[:3] for one in KINDS if one is not kind for check in one.checks}
    assert letters.isdisjoint(others)


@of_every_kind
def test_names_of_a_kind_are_words_and_unique(kind: AnyKind) -> None:
    for names in (
        [effect.name for effect in kind.effects],
        [solver.name for solver in kind.solvers],
        [load.name for load in kind.loads],
    ):
        assert len(names) == len(set(names))
        assert all(re.fullmatch("[a-z][a-z0-9_]*", name) for name in names)


def test_no_name_means_two_things_to_explain() -> None:
    counted = Counter(NAMES)
    assert [name for name, times in counted.items() if times > 1] == []


@of_every_kind
def test_the_parts_of_a_kind_fit_together(kind: AnyKind) -> None:
    """Loads, effects and scenes are joined by name; a slip of the pen would be a check that is never made."""
    loads, effects = {load.name for load in kind.loads}, {effect.name for effect in kind.effects}
    for solver in kind.solvers:
        assert solver.gives <= loads, solver.name
        assert solver.represents <= effects, solver.name
        assert solver.levels >= 1
    for check in kind.checks:
        assert set(check.loads) <= loads, check.code
        assert check.loads
    for effect in kind.effects:
        assert effect.part_of in effects | {""}
    for check in kind.checks:
        for scene in check.scenes:
            given = {load for one in kind.solvers if one.decides and scene in one.scenes for load in one.gives}
            assert set(check.loads) <= given, f"{check.code} in {scene.__name__}"


EXPLAINED = [*TITLES, *NAMES]


@over(EXPLAINED)
def test_everything_that_has_a_name_is_explained(name: str) -> None:
    text = explanation(name)
    assert text.startswith(f"{name}: ")
    assert text.endswith("\n")
    assert len(text.splitlines()) >= 3


@over(TITLES.keys())
def test_a_code_is_found_in_small_letters_too(code: str) -> None:
    assert explanation(code.lower()) == explanation(code)
    assert explanation(code).startswith(f"{code}: {TITLES[code]}")


@over([*NAMES, *(check.code for check in CHECKS)])
def test_range_error_and_source_are_explained(name: str) -> None:
    for part in ("**Range**", "**Error**", "**Source**"):
        assert part in explanation(name)
