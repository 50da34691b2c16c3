"""What a command may import: start-up is a feature, and some packages cost more than a whole check.

Counted in fresh processes by what is in `sys.modules` at the end; no clock is asked.
"""

import json
from pathlib import Path

import pytest
from support.command import ROOT, environment, python

PROBE = """
import json, sys
from ptmcalc.cli.app import main
result, *sys.argv[1:] = sys.argv[1:]
status = 0
try:
    main()
except SystemExit as stop:
    status = stop.code or 0
with open(result, "w", encoding="utf-8") as file:
    json.dump([status, sorted({name.partition(".")[0] for name in sys.modules})], file)
"""

HEAVY = {"scipy", "matplotlib", "jinja2", "dask", "distributed", "numba", "pint"}
OF_A_MACHINE = {"numpy", "pydantic", "yaml"}
COMMANDS = ("check", "diff", "merge", "plan", "cost", "solve", "scale", "new", "explain", "schema", "kinds", "solvers")


def packages(result: Path, *arguments: str) -> set[str]:
    """The top-level packages a command that succeeds has imported."""
    done = python("-c", PROBE, result, *arguments, env=environment(ROOT))
    assert done.err == ""
    status, names = json.loads(result.read_text("utf-8"))
    assert status == 0
    return set(names)


@pytest.mark.parametrize(
    "arguments",
    [
        ("check", "specs/conveyor.yaml"),
        ("check", "specs/hoist/winding_paper", "--jobs", "1", "--format", "summary"),
        ("plan", "specs/conveyor.yaml"),
        ("solve", "specs/conveyor.yaml", "--check", "CNV101", "--vary", "takeup.tension", "--scene", "run_loaded"),
        ("scale", "specs/conveyor.yaml", "--length", "1:10", "--law", "geometric", "--scene", "run_loaded"),
        ("cost", "specs/hoist/winding_paper/height_25_rope_17_5.yaml"),
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
