"""Every formula of the library is reached from the command line: as a page, by its name and by its module."""

import importlib
import inspect
import pkgutil
from types import ModuleType
from typing import Any

from support.command import ptmcalc

from ptmcalc import laws as library
from ptmcalc.cli import laws
from ptmcalc.cli.explain import explanation

MODULES: list[ModuleType] = [
    importlib.import_module(f"{library.__name__}.{one.name}") for one in pkgutil.iter_modules(library.__path__)
]


def public(module: ModuleType) -> dict[str, Any]:
    return {
        name: one
        for name, one in vars(module).items()
        if not name.startswith("_") and getattr(one, "__module__", "") == module.__name__ and hasattr(one, "__code__")
    }


def test_every_formula_has_a_page_with_its_source() -> None:
    """Imported here, read as text there."""
    assert sum(len(public(module)) for module in MODULES) > 400
    for module in MODULES:
        short = module.__name__.rpartition(".")[2]
        listed = explanation(f"laws.{short}")
        for name, function in public(module).items():
            assert f"\n    {name}: " in listed
            (page,) = laws.pages(f"{short}.{name}")
            text, code = inspect.getdoc(function) or "", page.plain
            assert "\nSource: " in code or "**Source**" not in text, name
            for line in text.splitlines()[1:]:
                if line.startswith("    "):
                    assert line.strip() in code, (name, line)


def test_a_formula_is_found_by_its_name_alone() -> None:
    done = ptmcalc("explain", "damped_frequency")
    assert done.status == 0
    assert "w_d = w_0 (1 - zeta^2)^(1/2)" in done.out
    assert "natural_frequency: w_0 [rad/s]." in done.out
    assert "Source: roots of m s^2 + b s + c = 0." in done.out


def test_the_library_and_a_module_are_listed() -> None:
    listed = ptmcalc("explain", "laws").out
    assert listed.count("\n    ") == len(MODULES)
    assert "transmissibility: " in ptmcalc("explain", "vibration").out


def test_its_line_is_found() -> None:
    place, _, said = ptmcalc("explain", "vibration.damped_frequency", "--where").out.partition(": ")
    file, _, line = place.rpartition(":")
    assert said == "formula damped_frequency\n"
    source = inspect.getsource(importlib.import_module("ptmcalc.laws.vibration")).splitlines()
    assert file == "ptmcalc/laws/vibration.py"
    assert source[int(line) - 1].startswith("def damped_frequency(")


def test_a_page_in_markdown_is_a_section() -> None:
    assert ptmcalc("explain", "coulomb_slide", "--format", "markdown").out.startswith("### coulomb_slide: ")


def test_a_name_nearly_right_is_suggested() -> None:
    done = ptmcalc("explain", "damped_frequenci")
    assert done.status == 2
    assert "did you mean `damped_frequency`?" in done.err


def test_checks_loads_and_terms_come_first() -> None:
    assert ptmcalc("explain", "cnv101").out.startswith("CNV101: ")
    assert "term of the field" in ptmcalc("explain", "S-curve").out
