"""Every code is explained with formula, symbols, range, source and an example that runs (`ptmcalc explain`).

Examples of checks, effects, solvers and loads are in `examples.json` of each kind. Those that show a file of `specs/`
are held by `test_specs.py`, which checks those files anyway; those with a design file of their own are run here. To
write them anew after numbers have changed on purpose, and to find some for names that are new:

    python tests/update.py examples
"""

import re
import subprocess
from contextlib import chdir
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest
from support.command import ROOT, ptmcalc
from support.examples import UPDATE, again, as_said, from_blocks, keep, names, pages_of, stored

from ptmcalc.base.diagnostic import BROKEN, CODES
from ptmcalc.base.units import unit_of
from ptmcalc.cli import examples
from ptmcalc.cli.explain import _everything, explanation, of_check, of_effect, of_solver, terms
from ptmcalc.contract.example import SYMBOLS, Symbol, symbols_in
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.topic import Topic
from ptmcalc.engine.registry import kind_names, load_kind
from ptmcalc.report import formula
from ptmcalc.spec.synonyms import folded

KINDS = [load_kind(name) for name in kind_names()]
TYPES = {one.label: (whole, one) for whole in KINDS for one in whole.manifests}

of_every_kind = pytest.mark.parametrize("kind", KINDS, ids=kind_names())
of_every_type = pytest.mark.parametrize("kind", [one for _, one in TYPES.values()], ids=TYPES)


# -- findings -------------------------------------------------------------------------------------------------------


def test_every_finding_has_an_example_and_no_other() -> None:
    assert set(examples.EXAMPLES) == set(CODES)


@pytest.mark.parametrize("code", [code for code in CODES if code not in (BROKEN, "NUM111")])  # faults of our own
def test_the_example_of_a_finding_brings_it_up(code: str, tmp_path: Path) -> None:
    """In a folder with the design files of the project; what `sed` does to a template is done by its like here."""
    example = examples.EXAMPLES[code]
    (tmp_path / "design.yaml").write_text(example.file, encoding="latin-1" if code == "TXT103" else "utf-8")
    for name in ("specs", "tests", "docs"):
        (tmp_path / name).symlink_to(ROOT / name, target_is_directory=True)
    command = example.command
    made = re.fullmatch(r"ptmcalc new (\w+) \| sed 's/(.*)/(.*)/' > design.yaml && (.*)", command)
    if made:
        template = load_kind(made[1]).template
        changed = re.sub(made[2], made[3], template)
        assert changed != template
        (tmp_path / "design.yaml").write_text(changed, encoding="utf-8")
        command = made[4]
    *before, command = command.split(" && ")
    with chdir(tmp_path):
        for line in before:
            subprocess.run(line.split(), check=True)
        done = ptmcalc(*command.split()[1:])
    assert code in example.says
    assert example.says in done.out + done.err
    assert "internal error" not in done.err


def test_a_file_of_an_example_has_one_fault() -> None:
    """The finding it is for, and none besides that a reader would wonder about."""
    for code, example in examples.EXAMPLES.items():
        if code.startswith(("TXT", "SPC")) and example.file and code != "TXT113":
            assert example.command == "ptmcalc check design.yaml", code


# -- checks, effects, solvers, loads --------------------------------------------------------------------------------


def _letters(kind: AnyKind) -> dict[str, set[str]]:
    """By page, the letters of all its formulas."""
    pages = {check.code: of_check(check) for check in kind.checks}
    pages |= {effect.name: of_effect(effect) for effect in kind.effects}
    pages |= {solver.name: of_solver(solver) for solver in (*kind.solvers, *kind.reference_methods)}
    return {name: set(formula.letters(text)) for name, text in pages.items()}


@of_every_type
def test_every_letter_of_every_page_has_a_line_of_its_own(kind: AnyKind) -> None:
    """By page: a letter that means one thing on a page may mean another one on the next."""
    listed = kind.symbols()
    letters = {(name, letter) for name, of_page in _letters(kind).items() for letter in of_page}
    missing = {f"{name} {letter}" for name, letter in letters - listed.keys()}
    assert missing == set(), (
        "by page, symbols without a meaning: add `SYMBOL: meaning [unit]`, and the page name below it after four"
        " spaces, to symbols.txt of the topic or kind, or to `symbols` of its `Topic`"
    )


@of_every_type
def test_units_of_symbols_are_units(kind: AnyKind) -> None:
    for (name, letter), symbol in kind.symbols().items():
        factor, _ = unit_of(symbol.unit)
        assert factor == 1.0 or symbol.unit == "1/h", f"{name} {letter}: [{symbol.unit}] is not an SI unit of the table"
        if "circular" in symbol.meaning or "angular speed" in symbol.meaning:
            assert symbol.unit == "rad/s", f"{name} {letter}: {symbol.meaning} [{symbol.unit}]"


def test_no_line_of_symbols_is_of_nothing() -> None:
    """Types of a kind may share one list; each of its lines is of a page of one of them."""
    letters: dict[str, dict[str, set[str]]] = {}
    for whole, one in TYPES.values():
        letters.setdefault(whole.name, {}).update(_letters(one))
    for whole, one in TYPES.values():
        for name, letter in one.symbols():
            assert letter in letters[whole.name].get(name, ()), f"{name} {letter} is of nothing"


def _pages_of_topics(folder: Path) -> set[str]:
    """Names of the checks, effects and solvers of the topics that the modules in a folder define."""
    files = [path.relative_to(ROOT).with_suffix("") for path in folder.rglob("*.py")]
    modules = [import_module(".".join(path.parts).removesuffix(".__init__")) for path in files]
    topics = [one for module in modules for one in vars(module).values() if isinstance(one, Topic)]
    pieces = [piece for topic in topics for piece in (*topic.effects, *topic.solvers)]
    return {piece.name for piece in pieces} | {check.code for topic in topics for check in topic.checks}


TOPIC_FILES = [
    path for path in sorted((ROOT / "ptmcalc" / "machines").rglob(SYMBOLS)) if (path.parent.parent / SYMBOLS).is_file()
]


@pytest.mark.parametrize("path", TOPIC_FILES, ids=lambda path: f"{path.parts[-3]}-{path.parts[-2]}")
def test_a_topic_lists_symbols_of_its_own_pages(path: Path) -> None:
    """Those of other pages are in the folder of the kind."""
    lines = [line for line in path.read_text("utf-8").splitlines() if line.startswith("    ")]
    listed = {name for line in lines for name in line.split()}
    assert listed
    assert listed <= _pages_of_topics(path.parent)


def test_topics_list_symbols() -> None:
    assert len(TOPIC_FILES) > len(TYPES)


def test_a_letter_with_two_meanings_on_a_page_is_refused_across_topics(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    top = tmp_path / "some_machine"
    for folder, text in ((top, "S: tension [N]\n    XYZ101\n"), (top / "topic", "S: area [m^2]\n    XYZ102\n")):
        folder.mkdir()
        (folder / "__init__.py").touch()
        (folder / SYMBOLS).write_text(text, "utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    read = symbols_in("some_machine")
    assert read() == {("XYZ101", "S"): Symbol("tension", "N"), ("XYZ102", "S"): Symbol("area", "m^2")}
    (top / "topic" / SYMBOLS).write_text("S: area [m^2]\n    XYZ101\n", "utf-8")
    with pytest.raises(ValueError, match=r"some_machine\.topic: `S` has a meaning on page `XYZ101` already"):
        read()


def test_a_topic_of_one_file_lists_its_symbols_itself(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    top = tmp_path / "one_file_machine"
    top.mkdir()
    (top / "__init__.py").touch()
    (top / SYMBOLS).write_text("S: tension [N]\n    XYZ101\n", "utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    own: Topic[Any] = Topic(symbols="A: area [m^2]\n    XYZ101\n")
    expected = {("XYZ101", "S"): Symbol("tension", "N"), ("XYZ101", "A"): Symbol("area", "m^2")}
    assert symbols_in("one_file_machine", (own,))() == expected
    with pytest.raises(ValueError, match=r"`symbols` of a topic of one_file_machine: `A` has a meaning on page"):
        symbols_in("one_file_machine", (own, own))()


@pytest.mark.parametrize(
    ("name", "line"),
    [
        ("two_mass", "M: mass of the load [kg]"),
        (
            "mast_handbook",
            "k: share of the mast mass at its end: 0.236 for a rigid root, 0.305 for a compliant root [1]",
        ),
        ("HST140", "k: natural circular frequency of the load on its ropes [rad/s]"),
        ("CRN207", "a: acceleration of the base [m/s^2]"),
        ("CRN207", "e: arm of the load weight [m]"),
    ],
)
def test_a_letter_is_explained_as_on_its_page(name: str, line: str) -> None:
    assert f"\n    {line}\n" in explanation(name)


@pytest.mark.parametrize(
    ("name", "of_types"),
    [
        ("CRN207", "crane rack_stacker; scenes: brake, start"),
        ("CRN210", "crane overhead_stacker; "),
        ("CRN201", "crane overhead_stacker, rack_stacker; "),
        ("safety_gear_force", "crane rack_stacker; load"),
        ("column_stiffness", "crane overhead_stacker, rack_stacker; load"),
        ("natural_frequency", "hoist; load"),
    ],
)
def test_a_page_names_all_types_that_have_it(name: str, of_types: str) -> None:
    assert f"({of_types}" in explanation(name)


def test_loads_of_one_name_that_differ_by_type_are_explained_one_by_one() -> None:
    assert explanation("starting_reserve").count("\nstarting_reserve: ") + 1 >= 2


@of_every_kind
def test_every_check_effect_solver_and_load_has_an_example(kind: AnyKind) -> None:
    found = stored(kind)
    missing = [name for name in names(kind) if name not in found]
    if UPDATE and missing:
        keep(kind, found | from_blocks(kind, missing, pages_of(kind, missing)))
        found = stored(kind)
    assert set(found) == set(names(kind)), (
        "run `python tests/update.py examples`; a name that then still has no example is in no design file of specs/ or"
        f" tests/machines/{kind.name}/*.md: add one that contains it"
    )


@of_every_kind
def test_an_example_with_a_file_of_its_own_says_what_is_said(kind: AnyKind) -> None:
    found = stored(kind)
    now = again(kind, found)
    if UPDATE:
        keep(kind, found | now)
    wrong = {name: line for name, (_, line, _) in now.items() if not as_said(line, found[name][1])}
    assert wrong == {}


@of_every_kind
def test_everything_of_a_kind_is_explained_in_both_formats(kind: AnyKind) -> None:
    for check in kind.checks:
        text, page = explanation(check.code), explanation(check.code, "markdown")
        for part in ("Formula", "In LaTeX", "Reads", "Source", "Example\n    $ ptmcalc "):
            assert part in text, (check.code, part)
        for part in ("**Formula**", "$$\n", "**Reads**", "**Range**", "**Source**", "**Example**"):
            assert part in page, (check.code, part)
    for effect in kind.effects:
        assert "Example\n    $ ptmcalc " in explanation(effect.name)
    for load in kind.loads:
        assert f"[{load.quantity.si}]" in explanation(load.name)


def test_the_handbook_has_them_all() -> None:
    page = ptmcalc("explain", "--all", "--format", "markdown").out
    titles = re.findall(r"^### (\w+): ", page, re.MULTILINE)
    assert set(titles) == {*CODES, *(name for kind in KINDS for name in names(kind))}
    assert page.startswith("# Handbook\n")


@pytest.mark.parametrize("arguments", [(), ("CNV101", "--all")])
def test_a_name_or_all(arguments: tuple[str, ...]) -> None:
    done = ptmcalc("explain", *arguments)
    assert done.status == 2
    assert "explain takes a name, or --all" in done.err


# -- terms of the field ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "name", ["VFD", "converter", "fluid coupling", "S-curve", "s_curve", "holdback", "load sharing", "take-up travel"]
)
def test_a_term_of_the_field_is_explained_by_what_a_file_writes(name: str) -> None:
    told = explanation(name)
    assert "term of the field" in told
    assert "`" in told


def test_terms_name_entries_that_exist_and_none_twice() -> None:
    known = {key for key, _ in _everything()}
    listed = [name for term in {id(one): one for one in terms().values()}.values() for name in term.names]
    assert len({folded(name) for name in listed}) == len(listed)
    assert not known & set(listed)
    assert {entry for term in terms().values() for entry in term.entries} <= known
