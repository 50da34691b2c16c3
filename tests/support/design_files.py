"""Design files as text: edited line by line, and what is said about them and where."""

from typing import Any

import yaml

from ptmcalc.base.diagnostic import Diagnostic, Severity
from ptmcalc.base.span import dotted
from ptmcalc.engine.load import Loaded, load_text


def read(text: str) -> Loaded:
    return load_text(text.encode(), "case.yaml")


def edited(machine: str, *edits: tuple[str, str]) -> str:
    """A machine with the first line of such words replaced, without its indentation; an empty text deletes it."""
    lines = machine.splitlines()
    for old, new in edits:
        number = next(index for index, line in enumerate(lines) if line.strip() == old)
        indent = lines[number][: -len(old)]
        lines[number : number + 1] = [indent + line for line in new.splitlines()]
    return "\n".join(lines) + "\n"


def problems_in(text: str) -> tuple[Diagnostic, ...]:
    """What is said about a faulty file."""
    result = read(text)
    assert result.spec is None
    return result.diagnostics


def problems_of(data: dict[str, Any]) -> tuple[Diagnostic, ...]:
    """The same of data."""
    return problems_in(yaml.safe_dump(data, sort_keys=False))


def problem_in(text: str, severity: Severity = Severity.ERROR) -> Diagnostic:
    """The one thing said about a file, which only an error makes a faulty one."""
    result = read(text)
    assert (result.spec is None) == (severity is Severity.ERROR)
    assert len(result.diagnostics) == 1, [(d.code, dotted(d.path), d.message) for d in result.diagnostics]
    assert result.diagnostics[0].severity is severity
    return result.diagnostics[0]


def place(problem: Diagnostic) -> tuple[int, int]:
    """Line and column of what is shown."""
    assert problem.span is not None
    return problem.span.line, problem.span.column
