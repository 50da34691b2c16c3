"""The README says what is so: its commands are those CI runs, its report is what the program prints."""

import math
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from importlib import metadata
from pathlib import Path

import pytest
from support.command import ROOT, ptmcalc, unpainted
from support.peers import COLUMNS, METHODS
from support.problems import PROBLEMS

from ptmcalc.base.units import SHARE, show
from ptmcalc.cli.app import app
from ptmcalc.contract.cost import Choice, CostReport
from ptmcalc.engine.cost import ACCURACIES, MARGINS
from ptmcalc.engine.files import design_files
from ptmcalc.engine.load import load_file
from ptmcalc.engine.registry import kind_names
from ptmcalc.report.cost import summary

README = (ROOT / "README.md").read_text("utf-8")
COMMANDS_PAGE = (ROOT / "docs" / "commands.md").read_text("utf-8")
ACCURACY = (ROOT / "docs" / "accuracy.md").read_text("utf-8")
PERFORMANCE = (ROOT / "docs" / "performance.md").read_text("utf-8")
CI = (ROOT / ".ci" / "run").read_text("utf-8")
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
LOCK = tomllib.loads((ROOT / "uv.lock").read_text("utf-8"))

COMMANDS = {
    "Install and run": "python -m pip install . && ptmcalc check specs/",
    "Install and test": 'python -m pip install -e ".[test]" && python -m pytest',
}
TOP = {
    ".ci",
    ".gitignore",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    ".pre-commit-hooks.yaml",
    "LICENSE",
    "README.md",
    "docs",
    "hatch_build.py",
    "mkdocs.yml",
    "ptmcalc",
    "pyproject.toml",
    "specs",
    "tests",
    "uv.lock",
}


def tracked() -> list[str]:
    """The files under version control, or all that a source archive holds."""
    listed = subprocess.run(
        ["git", "-C", str(ROOT), "ls-files", "-z"], capture_output=True, text=True, encoding="utf-8", check=False
    )
    if listed.returncode == 0 and listed.stdout:
        return listed.stdout.rstrip("\0").split("\0")
    files = (path.relative_to(ROOT) for path in ROOT.rglob("*") if path.is_file())
    return [path.as_posix() for path in files if path.parts[0] in TOP and "__pycache__" not in path.parts]


# -- commands -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("heading", "command"), COMMANDS.items(), ids=COMMANDS)
def test_a_command_of_the_readme_stands_alone_under_its_heading(heading: str, command: str) -> None:
    section = README.partition(f"\n## {heading}\n")[2].partition("\n## ")[0]
    assert re.findall(r"```sh\n(.*?)```", section, re.DOTALL) == [f"{command}\n"]


def test_ci_runs_the_commands_of_the_readme_and_no_others_of_its_own() -> None:
    """With the very lines of `.ci/run` that take them out of the README."""
    assert re.findall(r"command_of '([^']+)'", CI) == list(COMMANDS)
    found = re.search(r"^command_of\(\).*?<<'PY'\n(.*?)^PY$", CI, re.MULTILINE | re.DOTALL)
    assert found is not None
    for heading, command in COMMANDS.items():
        taken = subprocess.run(
            [sys.executable, "-", heading], input=found[1], cwd=ROOT, capture_output=True, text=True, check=True
        )
        assert taken.stdout.strip() == command


def test_ci_runs_the_commands_as_a_user_does_and_the_tests_once_more_where_versions_differ(tmp_path: Path) -> None:
    """A version that only the lock file knows hid what every fresh machine met."""
    before, _, after = CI.partition("export PIP_CONSTRAINT=")
    assert before.count('bash -euc "$') == 2
    assert after.count('bash -euc "$tests"') == 1
    found = re.search(r"^others\(\).*?<<'PY'\n(.*?)^PY$", CI, re.MULTILINE | re.DOTALL)
    assert found is not None
    pins = tmp_path / "pinned.txt"
    own = metadata.version("pyyaml")
    for text, said in (
        (f"pyyaml=={own}\n", ""),
        ("unheard-of==1.0\n", ""),
        ("pyyaml==1.0 ; (python_full_version < '3')\n", f"PyYAML {own}, locked 1.0\n"),
        (f"pyyaml==1.0 ; (a)\npyyaml=={own} ; (b)\n", ""),
    ):
        pins.write_text(text, encoding="utf-8")
        done = subprocess.run([sys.executable, "-", pins], input=found[1], capture_output=True, text=True, check=True)
        assert done.stdout.lower() == said.lower()


def test_ci_is_executable_and_checks_lint_types_and_contracts() -> None:
    assert (ROOT / ".ci" / "run").stat().st_mode & 0o111
    for command in ("ruff check", "ruff format --check", "mypy", "lint-imports"):
        assert re.search(rf"^{command}", CI, re.MULTILINE), command


def test_the_table_names_every_command_and_no_other() -> None:
    rows = re.findall(r"^\| (`ptmcalc .*?) \|", README, re.MULTILINE)
    named = {name for row in rows for name in re.findall(r"`ptmcalc (\w+)", row)}
    assert named == {
        command.name or command.callback.__name__ for command in app.registered_commands if command.callback
    }


OPTIONS = sorted(
    set(
        re.findall(
            r"(?<!\w)(--?[a-z][a-z-]*)[ =`]",
            COMMANDS_PAGE.partition("# Commands")[2] + README.partition("## Commands")[2],
        )
    )
)


@pytest.mark.parametrize("option", OPTIONS)
def test_an_option_the_readme_names_exists(option: str) -> None:
    helps = [
        unpainted(ptmcalc(command, "--help").out)
        for command in ("check", "cost", "solve", "improve", "scale", "sweep", "tolerances", "explain")
    ]
    assert any(re.search(rf"(?<!\S){option}\b", text) for text in helps)


def test_the_table_of_costs_is_of_the_files_there_are() -> None:
    """Its structure, not its seconds: a line a file, in the columns `cost --all` writes today."""
    section = ACCURACY.partition("\n## Cost of every design file\n")[2]
    head, rule, *lines = [line for line in section.splitlines() if line.startswith("|")]
    short = README.partition("\n## Cost of accuracy\n")[2].partition("\n## ")[0]
    shown = [line for line in short.partition("\n\nSix problems")[0].splitlines() if line.startswith("|")]
    assert shown[:2] == [head, rule]
    assert set(shown[2:]) <= set(lines), "the README shows lines of the whole table"
    columns, _ = summary([CostReport("", "", (), tuple(choices()), None)])
    assert [cell.strip() for cell in head.strip("|").split("|")] == list(columns)
    assert rule == f"|{' --- |' * len(columns)}"
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    assert [row[0].strip("`") for row in rows] == [
        path.relative_to(ROOT).as_posix() for path in design_files(ROOT / "specs")
    ]
    for path, kind, *prices, held in rows:
        assert load_file(ROOT / path.strip("`"), path).kind.label == kind  # type: ignore[union-attr]
        assert all(re.fullmatch(r"-|[\d.]+ m?s( \(\d+/\d+\))?", price) for price in prices), path
        found = re.fullmatch(r"-|(\d+) of (\d+)", held)
        assert found is not None
        assert found[1] == found[2], "a bar that does not hold is a fault"


def test_the_table_of_peers_is_of_the_problems_and_methods_there_are() -> None:
    """Its structure, not its seconds: the rows and columns the command prints today, and the unit they are in."""
    section = PERFORMANCE
    head, rule, *lines = [line for line in section.splitlines() if line.startswith("|")]
    assert [cell.strip() for cell in head.strip("|").split("|")] == list(COLUMNS)
    assert rule == "|" + " --- |" * len(COLUMNS)
    rows = [[cell.strip() for cell in line[1:-1].split("|")] for line in lines]
    settings = [(problem, word) for problem in PROBLEMS.values() for word, _ in problem.settings]
    assert [(row[0], row[1]) for row in rows] == [(f"{one.name} {one.title}", word) for one, word in settings]
    for row, (problem, word) in zip(rows, settings, strict=True):
        assert len(row) == len(COLUMNS)
        assert row[5] == (f"{problem.target:g} ms" if problem.target < math.inf else "-")
        peers = row[-len(METHODS) :]
        if word == problem.settings[-1][0]:
            assert all(re.fullmatch(r"breaks down|(-|[\d,.]+ times) at \de[-+]\d\d", cell) for cell in peers), row
        else:
            assert not any(peers)
    finest = {row[0]: row for row in rows}.values()
    short = [
        f"| {' | '.join([row[0], row[2], row[4], *(cell.partition(' times')[0] for cell in row[-len(METHODS) :])])} |"
        for row in finest
    ]
    assert [line for line in README.splitlines() if re.match(r"\| P\d ", line)] == short
    unit = re.search(r"unit[^.]*\s(\d+\.\d ms)", section)
    assert unit is not None
    assert unit[1] in README
    assert "tests/bench/test_problems.py" in section


def choices() -> Iterator[Choice]:
    for target in (*(show(one, SHARE) for one in ACCURACIES), MARGINS):
        yield Choice("scene", target, None, (), 0.0)


def test_a_report_and_every_kind_are_shown() -> None:
    """What the commands print is held by `test_docs.py`."""
    consoles = re.findall(r"```console\n(.*?)```", README, re.DOTALL)
    assert any("--format table" in one and "Effects" in one for one in consoles)
    for name in kind_names():
        assert any(f"specs/{name}" in one or f"_{name}" in one for one in consoles), name


def test_the_python_the_readme_asks_for_is_the_one_the_package_asks_for() -> None:
    (version,) = re.findall(r"Python (\d\.\d+) or newer", README)
    assert PROJECT["requires-python"] == f">={version}"


# -- what stands where ----------------------------------------------------------------------------------------------


def test_the_top_of_the_project_holds_what_belongs_there() -> None:
    assert {name.partition("/")[0] for name in tracked()} == TOP


def test_no_file_knows_the_machine_it_was_written_on() -> None:
    machine = re.compile(r"(?<![\w.}])/(?:home|work|root|tmp|Users)/")
    found = []
    for name in tracked():
        if name == "uv.lock" or not (ROOT / name).is_file():
            continue
        text = (ROOT / name).read_bytes().decode("utf-8", "replace")
        found += [f"{name}:{number}" for number, line in enumerate(text.splitlines(), 1) if machine.search(line)]
    assert found == []


# -- the lock file --------------------------------------------------------------------------------------------------


def plain(requirement: str) -> str:
    """The name of a requirement, as registries write it."""
    name = re.match(r"[A-Za-z0-9._-]+", requirement)
    assert name is not None
    return re.sub(r"[-_.]+", "-", name[0]).lower()


def test_the_lock_names_every_dependency() -> None:
    wanted = {plain(one) for one in PROJECT["dependencies"]}
    wanted |= {plain(one) for extra in PROJECT["optional-dependencies"].values() for one in extra}
    locked = {package["name"] for package in LOCK["package"]}
    assert wanted - locked == set()
    (ours,) = (package for package in LOCK["package"] if package["name"] == PROJECT["name"])
    assert ours["version"] == PROJECT["version"]
    assert {one["name"] for one in ours["metadata"]["requires-dist"]} == wanted


def test_the_lock_knows_one_registry() -> None:
    sources = [package["source"] for package in LOCK["package"] if package["name"] != PROJECT["name"]]
    assert sources
    assert all(source == {"registry": "https://pypi.org/simple"} for source in sources)
    urls = re.findall(r'url = "(https?://[^/"]+/)', (ROOT / "uv.lock").read_text("utf-8"))
    assert set(urls) == {"https://files.pythonhosted.org/"}
