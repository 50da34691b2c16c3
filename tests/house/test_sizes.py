"""How long a module and a function may be: a reader sees them as a whole."""

import ast

import pytest
from support.command import ROOT

MODULE, FUNCTION = 500, 60
"""Most lines of a module, and most lines of code in the body of a function: without docstring, comments and blanks."""
MODULES = sorted(ROOT.joinpath("ptmcalc").rglob("*.py"))


def lines_of_code(text: list[str], function: ast.FunctionDef) -> int:
    body = function.body[1:] if ast.get_docstring(function, clean=False) is not None else function.body
    if not body:
        return 0
    lines = (line.strip() for line in text[body[0].lineno - 1 : function.end_lineno])
    return sum(bool(line) and not line.startswith("#") for line in lines)


def test_no_module_is_longer_than_a_reader_keeps_in_mind() -> None:
    assert len(MODULES) > 400
    lengths = {path.relative_to(ROOT).as_posix(): len(path.read_text("utf-8").splitlines()) for path in MODULES}
    assert {path: length for path, length in lengths.items() if length > MODULE} == {}


def test_no_function_is_longer_than_a_screen() -> None:
    found = {}
    for path in MODULES:
        text = path.read_text("utf-8")
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.FunctionDef):
                length = lines_of_code(text.splitlines(), node)
                if length > FUNCTION:
                    found[f"{path.relative_to(ROOT).as_posix()}:{node.lineno} {node.name}"] = length
    assert found == {}


@pytest.mark.parametrize(
    ("lines", "length"), [(['    """Said."""', "    return 1"], 1), (["    # why", "", "    a = 1"], 1)]
)
def test_lines_of_code_are_counted(lines: list[str], length: int) -> None:
    text = ["def f():", *lines]
    (function,) = ast.parse("\n".join(text)).body
    assert isinstance(function, ast.FunctionDef)
    assert lines_of_code(text, function) == length
