"""The mutation check itself: which faults it draws, and that it tells a fault that is seen from one that is not.

The check as a whole is a study: `python -m tests.mutation` (see there).
"""

import ast
import sys
import tomllib
import types
from pathlib import Path

import pytest
from support.command import ROOT, python

from mutation import __main__ as tool
from mutation.mutants import mutants, population
from mutation.reach import speaking
from mutation.warm import change

SOURCE = '''"""A law of 2 + 2."""

__all__ = ["law"]
_TINY: float = 1e-9


def law(x: "float[3]", share: float = 0.5) -> float:
    """Half of 8."""
    if x <= 0 or x is None:
        raise ValueError(f"{x * 2} is below {-1 + 1}")
    y = [x, 1.0][-1]
    y += sum((x, y), axis=1 + 0)
    return -x**2 / share + 3
'''


@pytest.fixture
def law(tmp_path: Path) -> Path:
    path = tmp_path / "laws" / "toy.py"
    path.parent.mkdir()
    path.write_text(SOURCE, "utf-8")
    return path


def test_operators_and_numbers_are_drawn_but_nothing_that_is_said(law: Path) -> None:
    assert [(m.function, m.lines[1]) for m in mutants(law)] == [
        ("laws.toy:", "_TINY: float = 1e-05"),
        ("laws.toy:law", 'def law(x: "float[3]", share: float = 0.505) -> float:'),
        ("laws.toy:law", "if x > 0 or x is None:"),
        ("laws.toy:law", "if x <= 1 or x is None:"),
        ("laws.toy:law", "y = [x, 1.01][-1]"),
        ("laws.toy:law", "y -= sum((x, y), axis=1 + 0)"),
        ("laws.toy:law", "return x**2 / share + 3"),
        ("laws.toy:law", "return -x*2 / share + 3"),
        ("laws.toy:law", "return -x**2.02 / share + 3"),
        ("laws.toy:law", "return -x**2 * share + 3"),
        ("laws.toy:law", "return -x**2 / share - 3"),
        ("laws.toy:law", "return -x**2 / share + 4"),
    ]


def test_every_fault_is_another_program() -> None:
    drawn = list(population(ROOT / "ptmcalc"))
    assert len(drawn) > 5000
    rooms = {mutant.path.relative_to(ROOT / "ptmcalc").parts[:-1] for mutant in drawn}
    assert rooms >= {("laws",), ("numerics",), ("numerics", "rope"), ("numerics", "train")}
    for mutant in drawn[::200]:
        changed = ast.dump(ast.parse(mutant.source))
        assert changed != ast.dump(ast.parse(mutant.path.read_bytes())), mutant


def test_a_function_says_that_it_runs(law: Path) -> None:
    noted: set[str] = set()
    space: dict[str, object] = {"__noted__": noted}
    exec(compile(speaking(law), law, "exec"), space)
    assert noted == set()
    with pytest.raises(ValueError, match="is below"):
        space["law"](-1.0)
    assert noted == {"laws.toy:law"}


def test_the_nearest_tests_come_first_and_of_a_dear_file_only_what_reaches(law: Path) -> None:
    mutant = mutants(law)[-1]
    reach = {
        "tests/machines/test_a.py::dear": (9.0, {"laws.toy:law"}),
        "tests/machines/test_a.py::beside": (9.0, set()),
        "tests/laws/test_b.py::other": (0.1, {"laws.toy:other"}),
        "tests/laws/test_toy.py::one": (0.1, {"laws.toy:law"}),
        "tests/laws/test_toy.py::cached": (0.1, set()),
        "tests/laws/test_c.py::three": (0.2, {"laws.toy:law"}),
    }
    near = ["tests/laws/test_toy.py::one", "tests/laws/test_toy.py::cached", "tests/laws/test_c.py::three"]
    assert tool.batches(mutant, reach, 100.0) == [[*near, "tests/machines/test_a.py::dear"]]
    assert tool.batches(mutant, reach, 1.0) == [near]


def test_what_is_explained_still_stands_in_the_source_and_is_drawn() -> None:
    """Each is a fault that the check can draw, once; and each reason says something."""
    drawn: dict[str, set[tuple[str, str]]] = {}
    listed = []
    for entry in tomllib.loads(tool.EQUIVALENT.read_text("utf-8"))["mutant"]:
        assert entry["because"]
        if entry["file"] not in drawn:
            drawn[entry["file"]] = {mutant.lines for mutant in mutants(ROOT / entry["file"])}
        several = entry["becomes"] if isinstance(entry["becomes"], list) else [entry["becomes"]]
        for becomes in several:
            assert (entry["line"], becomes) in drawn[entry["file"]], entry
            listed.append((entry["file"], entry["line"], becomes))
    assert len(set(listed)) == len(listed)
    assert set(tool.reasons()) == set(listed)


TRY = """
import sys
from pathlib import Path
from tests.mutation import __main__ as tool
from tests.mutation.mutants import mutants

place = Path(sys.argv[1])
tool.copy_project(place)
path = tool.ROOT / "ptmcalc" / "laws" / "capstan.py"
tests = [["tests/laws/test_capstan.py::TestUtilisation::test_without_friction_any_difference_slips"]]
for k, mutant in enumerate(m for m in mutants(path) if m.lines[1] in sys.argv[2:]):
    print(tool.attempt(mutant, tests, place, {tests[0][0]: (0.1, set())}, 10**9 + k))
"""


def test_a_fault_that_is_seen_is_told_from_one_that_is_not(tmp_path: Path) -> None:
    """Two faults of one law, tried for real: without friction the sign of its exponent does not show."""
    faults = (
        "return over((tight - centrifugal) * np.exp(exponent), slack - centrifugal)",
        "return over((tight - centrifugal) * np.exp(-exponent), slack + centrifugal)",
    )
    done = python("-c", TRY, tmp_path, *faults)
    assert done.err == ""
    survived, killed = (line for line in done.out.splitlines() if not line.startswith(" "))
    assert survived.startswith("survived   ptmcalc/laws/capstan.py:")
    assert killed.startswith("killed     ptmcalc/laws/capstan.py:")
    assert "test_without_friction_any_difference_slips" in killed
    law = "laws/capstan.py"
    assert (tmp_path / "ptmcalc" / law).read_bytes() == (ROOT / "ptmcalc" / law).read_bytes()


TRY_ALL = """
import sys
from pathlib import Path
from tests.mutation import __main__ as tool
from tests.mutation.mutants import mutants

place = Path(sys.argv[1])
tool.copy_project(place)
capstan, sag = (tool.ROOT / "ptmcalc" / "laws" / name for name in ("capstan.py", "sag.py"))
drawn = [m for m in mutants(capstan) if m.lines[1] in sys.argv[2:]] + mutants(sag)[:1]
test = "tests/laws/test_capstan.py::TestUtilisation::test_without_friction_any_difference_slips"
other = "tests/laws/test_sag.py::TestSoftening::test_is_infinite_without_tension[0.0]"
reach = {test: (0.1, {"laws.capstan:slip_utilisation"}), other: (0.1, {"laws.sag:softening"})}
found = tool.attempt_all(list(enumerate(drawn)), place, reach, 9.0)
print("told", [found[k].end if k in found else "stale" for k in range(len(drawn))])
"""


def test_faults_in_forks_of_one_process_end_as_in_one_of_their_own(tmp_path: Path) -> None:
    """The two faults from above, and a number of a module that another one took while it was imported."""
    faults = (
        "return over((tight - centrifugal) * np.exp(exponent), slack - centrifugal)",
        "return over((tight - centrifugal) * np.exp(-exponent), slack + centrifugal)",
    )
    done = python("-c", TRY_ALL, tmp_path, *faults)
    assert done.err == ""
    assert done.out.splitlines()[-1] == "told ['survived', 'killed', 'stale']"
    for law in ("laws/capstan.py", "laws/sag.py"):
        assert (tmp_path / "ptmcalc" / law).read_bytes() == (ROOT / "ptmcalc" / law).read_bytes()


def test_a_module_is_changed_under_those_who_hold_its_functions() -> None:
    """Functions, methods and numbers, whoever took them; what is unchanged stays the same object."""
    source = """
from dataclasses import dataclass
from functools import cache

SIZE = 2.0
NAMES = ("a", "b")

@dataclass(frozen=True)
class Thing:
    width: float = 3.0

    @property
    def area(self):
        return self.width * SIZE

@cache
def slow(x):
    return x + 1

def law(x, y=5.0):
    return slow(x) * y
"""
    module, holder = types.ModuleType("toy_of_mutation"), types.ModuleType("holder_of_mutation")
    module.__file__ = "toy.py"
    sys.modules |= {module.__name__: module, holder.__name__: holder}
    try:
        exec(compile(source, "toy.py", "exec"), vars(module))
        for name in ("SIZE", "NAMES", "Thing", "law", "slow"):
            setattr(holder, name, getattr(module, name))
        thing, names = module.Thing(), module.NAMES
        assert (holder.law(1.0), thing.area) == (10.0, 6.0)
        assert not change(module.__name__, source.replace("x + 1", "x + 2").replace("* SIZE", "/ SIZE").encode())
        assert (holder.law(1.0), thing.area) == (15.0, 1.5)
        assert not change(module.__name__, source.replace("y=5.0", "y=6.0").replace("= 3.0", "= 4.0").encode())
        assert (holder.law(1.0), holder.Thing().area, thing.area) == (12.0, 8.0, 6.0)
        assert change(module.__name__, source.replace("SIZE = 2.0", "SIZE = 7.0").encode())
        assert (holder.SIZE, thing.area) == (7.0, 21.0)
        assert isinstance(thing, module.Thing)
        assert module.NAMES is names
    finally:
        del sys.modules[module.__name__], sys.modules[holder.__name__]
