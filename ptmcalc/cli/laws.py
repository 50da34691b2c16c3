"""Pages of the formula library: `explain laws` lists its modules, `explain vibration` the formulas of one, and
`explain damped_frequency` prints one formula.

The text of the modules is read; none of them is imported.
"""

import ast
import inspect
import re
import textwrap
from collections.abc import Iterator, Mapping
from functools import cache
from importlib import resources

from ptmcalc.cli.explain import Explanation, Part, part_of

_PACKAGE = "laws"
_BLOCKS = re.compile(r"^(Args|Returns|Raises):\n((?: {4}.*\n?|\n)*)", re.MULTILINE)
_HEADINGS = {"Args": "Inputs", "Returns": "Result", "Raises": "Errors"}
_MARKS = ("Range", "Error", "Source")
_FIRST = re.compile(r"\s*(.*?)(?:\.\s|\.?\Z|\n\n)", re.DOTALL)
"""First sentence of a docstring."""
_Formula = ast.FunctionDef | ast.ClassDef


@cache
def modules() -> Mapping[str, ast.Module]:
    """The modules of the formula library by name."""
    folder = resources.files("ptmcalc").joinpath(_PACKAGE)
    files = sorted((file for file in folder.iterdir() if file.name.endswith(".py")), key=lambda file: file.name)
    texts = {file.name.removesuffix(".py"): file.read_text("utf-8") for file in files if file.name != "__init__.py"}
    return {name: ast.parse(text) for name, text in texts.items()}


def formulas(module: ast.Module) -> Iterator[_Formula]:
    """The public functions and classes of a module."""
    for node in module.body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and not node.name.startswith("_"):
            yield node


def names() -> dict[str, None]:
    """Names of all modules and formulas."""
    return dict.fromkeys(
        [_PACKAGE, *modules(), *(one.name for module in modules().values() for one in formulas(module))]
    )


def pages(name: str) -> list[Explanation]:
    """The pages of a name: `laws`, a module (`vibration`), a formula (`damped_frequency`, or
    `vibration.damped_frequency`), each also with `laws.` before it; none if nothing has that name."""
    if name == _PACKAGE:
        return [_of_all()]
    found = []
    for module, node in _places(name):
        found.append(_of_module(module) if node is None else _of_formula(module, node))
    return found


def places(name: str) -> list[str]:
    """File and line of the module or the formulas."""
    return [
        f"ptmcalc/{_PACKAGE}/{module}.py:{1 if node is None else node.lineno}: "
        + (f"formulas of laws.{module}" if node is None else f"formula {node.name}")
        for module, node in _places(name)
    ]


def _places(name: str) -> Iterator[tuple[str, _Formula | None]]:
    """Module, and the formula in it; no formula for the module itself."""
    wanted, _, inside = name.removeprefix(f"{_PACKAGE}.").partition(".")
    if wanted in modules() and not inside:
        yield wanted, None
        return
    for module, tree in modules().items():
        for node in formulas(tree):
            if (node.name == inside and module == wanted) if inside else node.name == wanted:
                yield module, node


def _of_all() -> Explanation:
    lines = "\n".join(f"{name}: {_split(ast.get_docstring(tree) or '')[0]}" for name, tree in modules().items())
    return Explanation(_PACKAGE, "formula library", "", (Part("Modules", lines, displayed=True),))


def _of_module(module: str) -> Explanation:
    tree = modules()[module]
    title, text = _split(ast.get_docstring(tree) or "")
    lines = "\n".join(f"{node.name}: {_split(ast.get_docstring(node) or '')[0]}" for node in formulas(tree))
    parts = [*([Part("", text)] if text else []), Part("Formulas", lines, displayed=True)]
    return Explanation(module, title, f"formulas, laws.{module}", tuple(parts))


def _of_formula(module: str, node: _Formula) -> Explanation:
    title, text = _split(ast.get_docstring(node) or "")
    marked = text.find("**Range**")
    said = text[:marked] if marked >= 0 else text
    body = _BLOCKS.sub("", said).strip("\n")
    blocks = [(match[1], textwrap.dedent(match[2]).strip("\n")) for match in _BLOCKS.finditer(said)]
    parts = [
        *([Part("", body)] if body.strip() else []),
        *(Part(_HEADINGS[name], lines, displayed=True) for name, lines in blocks),
        *(Part(mark, one) for mark in _MARKS if (one := part_of(text, mark))),
    ]
    return Explanation(node.name, title, f"formula, laws.{module}", tuple(parts))


def _split(docstring: str) -> tuple[str, str]:
    """The first sentence of a docstring, and what follows."""
    text = inspect.cleandoc(docstring)
    match = _FIRST.match(text)
    assert match is not None
    return " ".join(match[1].split()), text[match.end() :].strip("\n")
