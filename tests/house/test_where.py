"""`explain NAME --where` prints the line that defines the name.

The interpreter itself is the reference: in a fresh process every check, effect, solver, load and figure keeps the line
of the module that created it.
"""

import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from support.command import ROOT, ptmcalc, python
from support.each import over
from support.examples import names

from ptmcalc.base.diagnostic import CODES
from ptmcalc.engine.registry import kind_names, load_kind

PROBE = """
import json, sys
from ptmcalc.contract.check import Check
from ptmcalc.contract.effect import Effect
from ptmcalc.contract.figure import Figure
from ptmcalc.contract.result import LoadInfo
from ptmcalc.contract.solver import Solver

made = {}  # by identity of the object, which is kept
kept = []

def watch(cls, key):
    create = cls.__init__
    def init(self, *values, **named):
        create(self, *values, **named)
        frame = sys._getframe(1)
        while frame is not None and frame.f_code.co_name != "<module>":
            frame = frame.f_back
        kept.append(self)
        if frame is not None:
            word = cls.__name__.lower().removesuffix("info")
            made[id(self)] = word, getattr(self, key), frame.f_code.co_filename, frame.f_lineno
    cls.__init__ = init

watch(Check, "code")
for cls in (Effect, Figure, LoadInfo, Solver):
    watch(cls, "name")

from ptmcalc.engine.registry import kind_names, load_kind
found = []
for kind in (one for name in kind_names() for one in load_kind(name).manifests):
    checks = (one for one in kind.checks if not one.types or kind.type in one.types)
    for one in (*checks, *kind.effects, *kind.solvers, *kind.reference_methods, *kind.loads, *kind.figures):
        word, name, file, line = made[id(one)]
        lines = {other[3] for other in made.values() if other[:3] == (word, name, file)}
        found.append((word, name, kind.label, file, sorted(lines)))
print(json.dumps(found))
"""
ALL = ptmcalc("explain", "--all", "--where").out.splitlines()
LINES = {line: tuple(re.fullmatch(r"(\S+\.py):(\d+): (.+)", line).groups()) for line in ALL}  # type: ignore[union-attr]
SOURCES = {file: (ROOT / file).read_text("utf-8").splitlines() for file, _, _ in LINES.values()}


def created() -> Iterator[tuple[str, str, str, str, list[int]]]:
    """(word, name, label of the type, file, lines) of every object of every kind, as the interpreter ran them.

    There are several lines where a decorator or a factory creates the object anew.
    """
    done = python("-c", PROBE)
    assert done.err == ""
    for word, name, label, file, lines in json.loads(done.out):
        yield word, name, label, Path(file).relative_to(ROOT).as_posix(), lines


def test_every_definition_is_the_line_that_created_the_object() -> None:
    """Every name of every type of every kind; a load that no solver of the type finds has no page and no line."""
    printed: dict[tuple[str, str, str], set[tuple[str, int]]] = {}
    for file, line, what in LINES.values():
        match = re.fullmatch(r"(check|effect|figure|load|solver) (\w+), (\w+) ?(.*)", what)
        for one in match[4].split(", ") if match else ():
            printed.setdefault((match[1], match[2], f"{match[3]} {one}".strip()), set()).add((file, int(line)))
    wrong = []
    seen = set()
    for word, name, label, file, lines in created():
        key = (word, name, label)
        seen.add(key)
        places = printed.get(key, set())
        if not places <= {(file, line) for line in lines} or not (places or word == "load"):
            wrong.append(f"{key}: created at {file}:{lines}, printed {sorted(places)}")
    assert not wrong, "\n".join(wrong)
    assert set(printed) <= seen


def test_every_name_has_a_line() -> None:
    named = {what.partition(", ")[0].split()[-1] for _, _, what in LINES.values()}
    kinds = list(map(load_kind, kind_names()))
    figures = {figure.name for kind in kinds for figure in kind.figures}
    assert named >= {*CODES, *figures, *(name for kind in kinds for name in names(kind))}


@over({line: parts for line, parts in LINES.items() if parts[2].startswith("finding ")})
def test_a_finding_is_a_key_of_its_table(file: str, line: str, what: str) -> None:
    assert SOURCES[file][int(line) - 1].strip() == f'"{what.split()[1]}": CodeText('


@over({line: parts for line, parts in LINES.items() if " of " in parts[2]})
def test_the_line_of_a_function_is_its_def(file: str, line: str, what: str) -> None:
    function = what.rpartition(", ")[2].rpartition(".")[2]
    text = SOURCES[file][int(line) - 1]
    assert "lambda" in text if function == "<lambda>" else re.match(rf"\s*def {function}\(", text)


@pytest.mark.parametrize(
    ("name", "lines"),
    [
        ("cnv101", ("check CNV101, conveyor", "value of CNV101, _slip_value")),
        ("CNV102", ("check CNV102, conveyor", "limit of CNV102, safety_limit")),
        (
            "belt_wave",
            ("effect belt_wave, conveyor", "criterion of belt_wave, wave_criterion", "bound of belt_wave, wave_bound"),
        ),
        ("network", ("solver network, conveyor", "run of network, run")),
        ("SPC104", ("finding SPC104",)),
        ("starting_reserve", ("load starting_reserve, conveyor", "load starting_reserve, crane travelling")),
    ],
)
def test_the_lines_of_a_name(name: str, lines: tuple[str, ...]) -> None:
    done = ptmcalc("explain", name, "--where")
    assert done.status == 0
    for line in lines:
        assert re.search(rf"^ptmcalc/[\w/]+\.py:[0-9]+: {re.escape(line)}", done.out, re.MULTILINE)


def test_a_name_that_nothing_has() -> None:
    done = ptmcalc("explain", "CNV1O1", "--where")
    assert done.status == 2
    assert "did you mean `CNV101`?" in done.err
