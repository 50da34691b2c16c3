"""What a command may import: start-up is a feature, and some packages cost more than a whole check.

Counted in fresh processes by what is in `sys.modules` at the end; no clock is asked.
"""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from support.command import ROOT, environment, python
from support.libraries import READY

PROBE = """
import json, sys
from ptmcalc.cli.start import main
result, *sys.argv[1:] = sys.argv[1:]
status = 0
try:
    main()
except SystemExit as stop:
    status = stop.code or 0
with open(result, "w", encoding="utf-8") as file:
    json.dump([status, sorted(sys.modules)], file)
"""

HEAVY = {"scipy", "matplotlib", "jinja2", "dask", "distributed", "numba", "pint"}
OF_A_MACHINE = {"numpy", "pydantic", "yaml"}
COMMANDS = (
    "check",
    "diff",
    "merge",
    "plan",
    "cost",
    "solve",
    "improve",
    "scale",
    "sweep",
    "new",
    "explain",
    "schema",
    "kinds",
    "solvers",
)


def modules(result: Path, *arguments: str) -> set[str]:
    """The modules a command that succeeds has imported."""
    done = python("-c", PROBE, result, *arguments, env=environment(ROOT))
    assert done.err == ""
    status, names = json.loads(result.read_text("utf-8"))
    assert status == 0
    return set(names)


def packages(result: Path, *arguments: str) -> set[str]:
    """The top-level packages a command that succeeds has imported."""
    return {name.partition(".")[0] for name in modules(result, *arguments)}


@pytest.mark.parametrize(
    "arguments",
    [
        ("check", "specs/conveyor.yaml"),
        ("check", "specs/hoist/winding_paper", "--jobs", "1", "--format", "summary"),
        ("plan", "specs/conveyor.yaml"),
        ("solve", "specs/conveyor.yaml", "--check", "CNV101", "--vary", "takeup.tension", "--scene", "run_loaded"),
        ("scale", "specs/conveyor.yaml", "--length", "1:10", "--law", "geometric", "--scene", "run_loaded"),
        ("cost", "specs/hoist/winding_paper/height_25_rope_17_5.yaml"),
        ("sweep", "specs/conveyor.yaml", "--vary", "speed=3 m/s:4 m/s:3", "--scene", "run_loaded"),
        ("schema",),
        ("explain", "belt_wave"),
        ("solvers",),
    ],
    ids=lambda arguments: arguments[0],
)
def test_no_command_imports_what_costs_more_than_a_check(arguments: tuple[str, ...], tmp_path: Path) -> None:
    found = packages(tmp_path / "modules.json", *arguments)
    assert found & HEAVY == set()
    assert "ptmcalc" in found


def test_the_line_of_a_name_needs_no_more_than_its_explanation(tmp_path: Path) -> None:
    plain, where = (modules(tmp_path / "modules.json", "explain", "belt_wave", *more) for more in ((), ("--where",)))
    assert where - plain == {"ptmcalc.cli.where"}


def test_one_file_needs_nothing_of_a_batch(tmp_path: Path) -> None:
    found = packages(tmp_path / "modules.json", "check", "specs/hoist/winding_paper/height_25_rope_17_5.yaml")
    assert found & {"sqlite3", "pathspec", "multiprocessing", "concurrent"} == set()


@pytest.mark.parametrize("option", ["--version", "--help"])
def test_version_and_help_import_nothing_a_machine_needs(option: str, tmp_path: Path) -> None:
    assert packages(tmp_path / "modules.json", option) & (HEAVY | OF_A_MACHINE) == set()


@pytest.mark.parametrize("command", COMMANDS)
def test_help_of_a_command_imports_no_numerics(command: str, tmp_path: Path) -> None:
    """Typer itself may read the options of a command with pydantic."""
    assert packages(tmp_path / "modules.json", command, "--help") & (HEAVY | OF_A_MACHINE - {"pydantic"}) == set()


def test_the_probe_sees_what_is_imported(tmp_path: Path) -> None:
    """The deny-lists above would be worth nothing if a machine left no trace."""
    assert packages(tmp_path / "modules.json", "solvers") >= OF_A_MACHINE


# -- how much is imported -------------------------------------------------------------------------------------------

CLOSED = "specs/hoist/winding_paper/height_25_rope_17_5.yaml"
"""A file that closed forms decide."""
COUNT = "\nimport sys; print(len(sys.modules))"


def count_of(program: str) -> int:
    done = subprocess.run([sys.executable, "-c", program + COUNT], capture_output=True, text=True, check=True)
    return int(done.stdout)


def test_a_check_that_closed_forms_decide_imports_few_modules(tmp_path: Path) -> None:
    """Beyond the libraries as they are when one model and one command are at work, our own alone, and of these no more
    than the kind calls for: neither its second methods nor what draws tables, nor masked arrays and polynomials
    of numpy."""
    found = modules(tmp_path / "modules.json", "check", CLOSED, "--format", "plain")
    ours = {name for name in found if name.partition(".")[0] == "ptmcalc"}
    assert not [name for name in found if name.startswith(("rich.console", "rich.table", "numpy.ma."))]
    assert len(found) - len(ours) <= count_of(READY) + 25
    assert len(ours) <= 172
    assert not [name for name in ours if name.startswith("ptmcalc.machines.") and ".hoist" not in name]
    assert not [name for name in ours if "reference" in name]


def test_help_imports_little_more_than_typer_and_rich(tmp_path: Path) -> None:
    """No panels: they would import a parser of Markdown and a highlighter of programs."""
    found = modules(tmp_path / "modules.json", "--help")
    assert not {name.partition(".")[0] for name in found} & {"markdown_it", "pygments", "attr"}
    assert len(found) <= count_of("import typer, rich") + 20


def test_a_process_begins_before_its_first_import() -> None:
    """What `start` sets holds for all imports: it imports the command line itself only when it is called."""
    program = "import sys, ptmcalc.cli.start; assert not {'typer', 'numpy', 'pydantic'} & set(sys.modules)"
    assert python("-c", program).status == 0


def test_a_crane_of_one_type_imports_no_other(tmp_path: Path) -> None:
    found = modules(tmp_path / "modules.json", "check", "specs/crane_travelling.yaml", "--format", "plain")
    types = {name.split(".")[3] for name in found if name.startswith("ptmcalc.machines.crane.")}
    assert types == {"travelling"}
