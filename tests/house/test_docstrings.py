"""Every law, effect, solver and limit says its range, its error and its source, and names the unit of every number."""

import importlib
import inspect
import pkgutil
import re
from collections.abc import Callable, Iterator
from typing import Any

from support.each import over

from ptmcalc import laws
from ptmcalc.base.units import unit_of
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.solver import always_valid
from ptmcalc.engine.registry import kind_names, load_kind
from ptmcalc.laws import start_profile

KINDS = [load_kind(name) for name in kind_names()]
PARTS = ("Range", "Error", "Source")
ARGUMENT = re.compile(r"^    (\w+): (.*(?:\n {8}.*)*)", re.MULTILINE)
UNIT = re.compile(r"\[([^\]\s]+)\]")
NO_NUMBER = (bool, int, str, start_profile.Shape)  # flags, names of strands and shapes of profiles have no unit

Function = Callable[..., Any]


def public_laws() -> Iterator[tuple[str, Function]]:
    for module in pkgutil.walk_packages(laws.__path__, f"{laws.__name__}."):
        content = importlib.import_module(module.name)
        for name, member in vars(content).items():
            if inspect.isfunction(member) and member.__module__ == module.name and not name.startswith("_"):
                yield f"{module.name.removeprefix('ptmcalc.')}.{name}", member


def parts_of_kinds() -> Iterator[tuple[str, Function]]:
    """Everything of a kind whose docstring `explain` prints."""
    for kind in KINDS:
        for effect in kind.effects:
            yield f"{effect.name}: criterion", effect.criterion
            yield f"{effect.name}: bound", effect.bound
        for solver in (*kind.solvers, *kind.reference_methods):
            yield f"{solver.name}: run", solver.run
            if solver.valid is not always_valid:
                yield f"{solver.name}: valid", solver.valid
        for check in kind.checks:
            yield f"{check.code}: limit", check.limit
            if check.value is not None:
                yield f"{check.code}: value", check.value


LAWS = dict(public_laws())
OF_KINDS = dict(parts_of_kinds())


def test_there_are_laws_and_kinds_to_look_at() -> None:
    assert len(LAWS) > 20
    assert len(OF_KINDS) > 20


@over(LAWS | OF_KINDS)
def test_range_error_and_source_are_told(function: Function) -> None:
    text = inspect.getdoc(function) or ""
    for part in PARTS:
        told = re.search(rf"^\*\*{part}\*\* (\S.*)", text, re.MULTILINE)
        assert told is not None, f"no **{part}**"
        assert len(told[1]) > 3
    positions = [text.index(f"**{part}**") for part in PARTS]
    assert positions == sorted(positions)


@over(LAWS | OF_KINDS)
def test_the_first_sentence_stands_on_its_own(function: Function) -> None:
    """`explain` and an editor show it: it ends within its paragraph, before any equation."""
    first = (inspect.getdoc(function) or "").partition("\n\n")[0]
    assert first.endswith((".", ":"))
    assert "**" not in first


@over(LAWS)
def test_a_law_shows_its_equation(function: Function) -> None:
    """In front of the arguments; a table is a law too, C = C(L)."""
    head = (inspect.getdoc(function) or "").partition("Args:")[0]
    assert re.search(r"\S[^\n]*( = |/|\^|: )[^\n]*\S", head), head


@over(LAWS)
def test_a_law_names_every_argument_in_order_with_its_unit(function: Function) -> None:
    text = inspect.getdoc(function) or ""
    told = dict(ARGUMENT.findall(text.partition("Args:")[2].partition("Returns:")[0]))
    parameters = inspect.signature(function).parameters
    assert list(told) == list(parameters)
    for name, parameter in parameters.items():
        annotation = parameter.annotation
        number = annotation not in NO_NUMBER and not getattr(annotation, "__module__", "").startswith("ptmcalc")
        assert UNIT.search(told[name]) or not number, f"{name} has no unit in brackets"


@over(LAWS)
def test_a_law_says_what_it_returns(function: Function) -> None:
    text = inspect.getdoc(function) or ""
    returned = text.partition("Returns:\n")[2].partition("**Range**")[0]
    assert returned.strip()
    numbers = "float" in str(inspect.signature(function).return_annotation)
    assert UNIT.search(returned) or not numbers, returned


@over(LAWS)
def test_units_in_brackets_are_units(function: Function) -> None:
    text = inspect.getdoc(function) or ""
    block = text.partition("Args:")[2].partition("**Range**")[0]
    for unit in UNIT.findall(block):
        assert unit_of(unit)[0] == 1.0, f"[{unit}] is not an SI unit of the table"


@over(LAWS)
def test_no_description_of_a_machine_stands_in_the_signature_of_a_law(function: Function) -> None:
    for annotation in inspect.get_annotations(function, eval_str=True).values():
        assert "ptmcalc.spec" not in str(annotation)
        assert "ptmcalc.machines" not in str(annotation)


@over(dict(zip(kind_names(), KINDS, strict=True)))
def test_what_explain_prints_besides_docstrings_is_written(kind: AnyKind) -> None:
    for check in kind.checks:
        for text in (check.title, check.what, check.why, check.formula, check.source):
            assert text.strip(), check.code
    for solver in kind.solvers:
        assert solver.title.strip()
        assert solver.source.strip()
    for effect in kind.effects:
        assert effect.title.strip()
