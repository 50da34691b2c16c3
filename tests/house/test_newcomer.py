"""CONTRIBUTING.md and docs/architecture.md describe the project as it is."""

import re
import runpy
import tomllib

from support.command import ROOT
from support.each import over

from ptmcalc.engine.load import load_file
from ptmcalc.engine.plan import plan
from ptmcalc.engine.run import settle
from ptmcalc.machines.conveyor.machine.model import drive_force

GUIDE = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
PAGE = (ROOT / "docs" / "architecture.md").read_text("utf-8")
CI = (ROOT / ".ci" / "run").read_text("utf-8")
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
DERIVED = runpy.run_path(str(ROOT / "tests" / "update.py"))["DERIVED"]


# -- CONTRIBUTING.md ------------------------------------------------------------------------------------------------


def commands(heading: str) -> list[str]:
    """The shell commands under a heading."""
    section = GUIDE.partition(f"\n## {heading}\n")[2].partition("\n## ")[0]
    return re.findall(r"^```sh\n(.*?)\n```$", section, re.MULTILINE | re.DOTALL)


def test_the_guide_fits_on_a_screen() -> None:
    assert len(GUIDE.splitlines()) <= 60


def test_one_command_each() -> None:
    """The test command is that of the README, the lint commands are those of CI."""
    assert commands("Tests") == ["python -m pytest"]
    assert "python -m pytest" in CI or 'command_of "Install and test"' in CI or "command_of 'Install and test'" in CI
    (lint,) = commands("Lint")
    checks = CI.partition('say "lint, types, contracts"')[2].partition('say "all green"')[0]
    assert lint.split(" && ") == [line for line in checks.splitlines() if line and not line.startswith("python -m pip")]


def test_the_set_up_installs_extras_that_exist() -> None:
    (command,) = commands("Set-up")
    extras = re.fullmatch(r'python -m pip install -e "\.\[([\w,]+)\]"', command)
    assert extras is not None
    assert set(extras[1].split(",")) <= set(PROJECT["project"]["optional-dependencies"])


def test_derived_files_have_one_command() -> None:
    assert commands("Derived files") == ["python tests/update.py"]
    assert all((ROOT / path).exists() for paths in DERIVED.values() for path in paths)


def paths(page: str) -> list[str]:
    """The paths of the project that a page names in backticks, without those with a word to fill in."""
    named = sorted(set(re.findall(r"`((?:ptmcalc|tests|docs|specs|\.ci)/[\w/.-]*)`", page)))
    return [path for path in named if not re.search(r"\b(?:KIND|SUBJECT)\b", path)]


@over(paths(GUIDE))
def test_a_path_of_the_guide_exists(path: str) -> None:
    assert (ROOT / path).exists()


def test_the_example_of_a_subject_follows_its_rule() -> None:
    (subject,) = re.findall(r"full stop: `([^`]+)`", GUIDE)
    rooms = re.findall(r"[a-z]+", GUIDE.partition("Rooms:")[2].partition(".")[0])
    assert len(subject) <= 72
    assert subject.partition(":")[0] in rooms


# -- docs/architecture.md -------------------------------------------------------------------------------------------


def rows(heading: str) -> list[list[str]]:
    """The cells of the first table under a heading, without its head."""
    section = PAGE.partition(f"\n## {heading}\n")[2].partition("\n## ")[0]
    table = re.search(r"^\|.*(?:\n\|.*)*", section, re.MULTILINE)
    assert table is not None
    return [[cell.strip() for cell in line.strip("|").split(" | ")] for line in table[0].splitlines()[2:]]


def test_the_rooms_are_the_layers_of_the_import_contract() -> None:
    """In order of import, the lowest layer first."""
    layers = PROJECT["tool"]["importlinter"]["contracts"][0]["layers"]
    wanted = [sorted(name.strip().removeprefix("ptmcalc.") for name in layer.split("|")) for layer in reversed(layers)]
    assert [sorted(re.findall(r"`(\w+)`", room)) for room, _ in rows("Rooms of the package")] == wanted
    folders = {path.name for path in (ROOT / "ptmcalc").iterdir() if (path / "__init__.py").is_file()}
    assert folders == {name for layer in wanted for name in layer}


@over(paths(PAGE))
def test_a_path_of_the_architecture_exists(path: str) -> None:
    assert (ROOT / path).exists()


@over({step: (files, functions) for step, files, functions, _ in rows("From a YAML line to a verdict")})
def test_a_step_is_made_by_the_function_of_that_file(files: str, functions: str) -> None:
    for file in re.findall(r"`([^`]+)`", files):
        text = (ROOT / file).read_text("utf-8")
        for function in re.findall(r"`([^`]+)`", functions):
            assert f"def {function}(" in text, (file, function)


def test_the_numbers_of_the_path_are_computed() -> None:
    """The value at line 26 of the conveyor, the force at the pulley, and every run with its error bar."""
    loaded = load_file(ROOT / "specs" / "conveyor.yaml", "specs/conveyor.yaml")
    assert loaded.kind is not None
    assert loaded.spec is not None
    key = ("drive", "motor", "mean_starting_torque")
    place = loaded.document.value_span(key)
    assert f"line {place.line}, column {place.column}" in PAGE
    assert loaded.spec.value_at(key) == 3150.0
    assert f"= {drive_force(loaded.spec.drive) / 1e3:.1f} kN" in PAGE  # type: ignore[attr-defined]
    assumed = next(one for one in loaded.assumed if one.path == ("takeup", "mass"))
    tonnes = [one / 1e3 for one in (assumed.value, assumed.interval.low, assumed.interval.high)]
    assert "assumed: {:.2f} t, from {:.2f} t to {:.2f} t".format(*tonnes) in PAGE
    (scene,) = (one for one in plan(loaded.kind, loaded.spec).scenes if one.scene.label == "start_loaded")
    settled = settle(loaded.kind, loaded.spec, scene)
    printed = re.findall(r"^\| `(\w+)` \| ([^|]*) \| ([^|]*) \|$", PAGE.partition("Each run is")[2], re.MULTILINE)
    runs = [run for run in settled.runs if "slip_reserve_min" in run.estimates]
    assert [name for name, _, _ in printed] == [run.rung.solver.name for run in runs]
    carried: set[str] = set()
    for (_, effects, found), run in zip(printed, runs, strict=True):
        carried |= set(re.findall(r"`(\w+)`", effects))
        assert carried == run.rung.carried
        known = run.estimates["slip_reserve_min"]
        if not known.bounded:
            shown = f"{known.value:.3f}, unbounded"
        elif known.bar > 0.01:
            shown = f"{known.value:.3f}, from {known.low:.3f} to {known.high:.3f}"
        else:
            shown = f"{known.value:.4f} ± {known.bar:.4f}"
        assert found.startswith(shown)


def test_the_ratios_are_those_of_the_tutorial() -> None:
    tutorial = (ROOT / "docs" / "tutorials" / "conveyor.md").read_text("utf-8")
    for load, ratio in (("T1 entering drive pulley, maximum", "1.032"), ("T1 dynamic component, maximum", "1.316")):
        assert re.search(rf"^{re.escape(load)} .* ×{ratio}$", tutorial, re.MULTILINE)
        assert ratio in PAGE
