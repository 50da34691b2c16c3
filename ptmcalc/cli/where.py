"""Source lines that `explain NAME --where` prints: of the definition of a name, and of the functions behind it.

A check, effect, solver, load or figure is an object that a module creates when it is imported. The line is found in the
text of that module, as the call with the name as its first argument or as its `code` or `name`. A finding is a key of
`CODES`. Modules are those that are imported already.
"""

import ast
import inspect
import sys
from collections.abc import Callable, Iterator, Sequence
from functools import cache, partial
from types import FunctionType, ModuleType
from typing import Any

from ptmcalc.base import diagnostic
from ptmcalc.cli.explain import known_as, label_of, pieces_of
from ptmcalc.contract.machine import AnyKind
from ptmcalc.engine.registry import kind_names, load_kind, package_of

_FUNCTIONS = ("value", "limit", "criterion", "bound", "run", "marks")
"""Attributes of a check, an effect, a solver or a figure that compute its numbers."""
_NAMING = ("code", "name")
_DEFERRED = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)
"""Parts of a module that do not run when it is imported."""

Place = tuple[ModuleType, int]


def whereabouts(name: str = "") -> str:
    """The text of `explain NAME --where`, or that of every name.

    Raises:
        UsageError: nothing has that name.
    """
    everything = list(_everything())
    known = {one: None for one, _ in everything}
    if name and name not in known and name.upper() not in known:
        from ptmcalc.cli import laws  # reads the text of all formulas

        if found := laws.places(name):
            return "".join(f"{line}\n" for line in found)
        known |= laws.names()
    wanted = known_as(name, known) if name else ""
    lines = [line for one, lines in everything if one == wanted or not name for line in lines()]
    return "".join(f"{line}\n" for line in dict.fromkeys(lines))


def _everything() -> Iterator[tuple[str, Callable[[], Iterator[str]]]]:
    """Names, and the lines of each: only those that are requested are searched."""
    for code in diagnostic.CODES:
        yield code, partial(_of_finding, code)
    for kind in map(load_kind, kind_names()):
        for chapter, of_chapter in pieces_of(kind).items():
            for name, all_ in of_chapter.items():
                for one in all_:
                    yield name, partial(_of_pieces, kind, chapter, name, one.kinds)
        for name in dict.fromkeys(figure.name for one in kind.manifests for figure in one.figures):
            yield name, partial(_of_pieces, kind, "figures", name, kind.manifests)


def _of_finding(code: str) -> Iterator[str]:
    keys = [
        key.lineno
        for node in ast.walk(_tree(diagnostic))
        if isinstance(node, ast.Dict)
        for key in node.keys
        if isinstance(key, ast.Constant) and key.value == code
    ]
    yield from (f"{_shown(diagnostic, line)}: finding {code}" for line in keys)


def _of_pieces(kind: AnyKind, chapter: str, name: str, types: Sequence[AnyKind]) -> Iterator[str]:
    """The definition of what some types of a kind call by a name, then its functions. Each type may have its own."""
    having: dict[int, tuple[Any, list[AnyKind]]] = {}
    for one in types:
        pieces = (*one.solvers, *one.reference_methods) if chapter == "solvers" else getattr(one, chapter)
        for piece in pieces:
            if name in (getattr(piece, attribute, None) for attribute in _NAMING):
                having.setdefault(id(piece), (piece, []))[1].append(one)
    for piece, of_types in having.values():
        place = definition(kind, name, piece)
        if place is not None:
            yield f"{_shown(*place)}: {chapter.removesuffix('s')} {name}, {label_of(of_types)}"
        for attribute in _FUNCTIONS:
            function = _plain(getattr(piece, attribute, None))
            module = sys.modules.get(function.__module__) if function else None
            if function and module:
                yield f"{_shown(module, _line_of(function))}: {attribute} of {name}, {function.__qualname__}"


def definition(kind: AnyKind, name: str, piece: Any) -> Place | None:
    """Module and line of the call that creates a piece of a kind; None where its source text is not available.

    Names are equal in several modules where types of a kind define loads of their own: the module counts that holds the
    piece. A call of the class of the piece counts before one of a function that makes it.
    """
    found = [
        (not _holds(module, piece), by_function, number, line, module)
        for number, module in enumerate(_modules(package_of(kind.name)))
        for by_function, line in _calls(module, name, type(piece).__name__)
    ]
    if not found:
        return None
    *_, line, module = min(found, key=lambda one: one[:4])
    return module, line


def _modules(package: str) -> Iterator[ModuleType]:
    for name, module in list(sys.modules.items()):
        if name == package or name.startswith(f"{package}."):
            yield module


def _calls(module: ModuleType, name: str, cls: str) -> Iterator[tuple[bool, int]]:
    """Lines of the calls in the top level of a module that may create the object called `name`.

    Returns:
        For each call, True if it calls a function and not the class itself; its line.
    """
    constants = {word for word, value in vars(module).items() if isinstance(value, str) and value == name}
    if f'"{name}"' not in _text(module) and not constants:
        return

    def names_it(node: ast.expr) -> bool:
        return (isinstance(node, ast.Constant) and node.value == name) or (
            isinstance(node, ast.Name) and node.id in constants
        )

    waiting: list[ast.AST] = [_tree(module)]
    while waiting:
        node = waiting.pop()
        waiting += [one for one in ast.iter_child_nodes(node) if not isinstance(one, _DEFERRED)]
        if not isinstance(node, ast.Call):
            continue
        called = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
        naming = [*node.args[:1], *(word.value for word in node.keywords if word.arg in _NAMING)]
        if any(map(names_it, naming)) and (called == cls or called[:1] in "_abcdefghijklmnopqrstuvwxyz"):
            yield called != cls, node.lineno


def _holds(module: ModuleType, piece: Any) -> bool:
    """True if a name of the module is the piece, or a tuple or list with it."""
    return any(
        value is piece or (isinstance(value, (tuple, list)) and any(one is piece for one in value))
        for value in vars(module).values()
    )


def _plain(function: Any) -> FunctionType | None:
    """The function with the source text behind a callable."""
    while isinstance(function, partial):
        function = function.func
    function = inspect.unwrap(function) if callable(function) else None
    function = getattr(function, "__func__", function)
    return function if isinstance(function, FunctionType) else None


def _line_of(function: FunctionType) -> int:
    """The line of `def`, behind the decorators."""
    first = function.__code__.co_firstlineno
    module = sys.modules[function.__module__]
    for number, line in enumerate(_text(module).splitlines()[first - 1 :], first):
        if "def " in line or "lambda" in line:
            return number
    return first


@cache
def _text(module: ModuleType) -> str:
    try:
        return inspect.getsource(module)
    except (OSError, TypeError):  # compiled, or without any text
        return ""


@cache
def _tree(module: ModuleType) -> ast.Module:
    return ast.parse(_text(module))


def _shown(module: ModuleType, line: int) -> str:
    """The line of a module with the path from the folder that holds its top package."""
    path = module.__name__.replace(".", "/")
    return f"{path}/__init__.py:{line}" if hasattr(module, "__path__") else f"{path}.py:{line}"
