"""The documentation runs: every file it shows is written, every command executed, every output compared.

To write the outputs anew, and then to read the difference before it is committed:

    python tests/update.py docs
"""

import ast
import os
import re
import shutil
from pathlib import Path

import pytest
from support import validation
from support.command import ROOT
from support.pages import in_a_fresh_one, in_process, play, steps

from ptmcalc.engine.registry import kind_names, load_kind

DOCS = sorted((ROOT / "docs").rglob("*.md"))
RUNNING = [path for path in [ROOT / "README.md", *DOCS] if any(True for _ in steps(path.read_text("utf-8")))]
CHANGES_THE_PACKAGE = "extend.md"
UPDATE = bool(os.environ.get("PTMCALC_UPDATE"))


def named(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


@pytest.mark.parametrize("path", RUNNING, ids=named)
def test_a_page_does_what_it_says(path: Path, tmp_path: Path) -> None:
    """In a copy of the design files; the page that adds a kind and an effect, in a copy of the package."""
    run = in_process
    for files in ("specs", "tests/questions"):
        shutil.copytree(ROOT / files, tmp_path / files, ignore=shutil.ignore_patterns("*.py", "__pycache__"))
    if path.name == CHANGES_THE_PACKAGE:
        shutil.copytree(ROOT / "ptmcalc", tmp_path / "ptmcalc", ignore=shutil.ignore_patterns("__pycache__"))
        run = in_a_fresh_one
    page = path.read_text("utf-8")
    played = play(page, tmp_path, run)
    assert "ptmcalc: internal error" not in played, "no page shows a fault of the program"
    if UPDATE:
        path.write_text(played, encoding="utf-8")
    else:
        assert played == page


@pytest.mark.parametrize("path", [ROOT / "README.md", *DOCS], ids=named)
def test_no_page_shows_a_bug_of_ours(path: Path) -> None:
    """An update writes whatever a command prints."""
    assert "internal error" not in path.read_text("utf-8")


def test_there_is_a_tutorial_for_every_kind_and_type() -> None:
    told = {path.stem for path in DOCS if path.parent.name == "tutorials"}
    wanted = {one.label.replace(" ", "_") for name in kind_names() for one in load_kind(name).manifests}
    assert told == wanted
    for path in (ROOT / "docs" / "tutorials" / f"{name}.md" for name in wanted):
        page = path.read_text("utf-8")
        assert "**The question.**" in page
        assert "**What to change.**" in page or "solve " in page
        assert re.search(r": (fail|not_checked) [A-Z]{3}[0-9]{3}", page), f"{path.name} shows no failing check"
        assert re.search(r": pass [A-Z]{3}[0-9]{3}", page), f"{path.name} shows no way out"


@pytest.mark.parametrize("path", [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *DOCS], ids=named)
def test_links_lead_somewhere(path: Path) -> None:
    """Links to pages of the project, and to their headings."""
    page = path.read_text("utf-8")
    for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"```.*?```", "", page, flags=re.DOTALL)):
        if re.match("https?:", target):
            continue
        file, _, heading = target.partition("#")
        linked = (path.parent / file).resolve() if file else path
        assert linked.exists(), f"{named(path)}: {target}"
        if heading:
            heads = re.findall(r"^#+ (.*)$", linked.read_text("utf-8"), re.MULTILINE)
            anchors = {re.sub(r"[^\w\- ]", "", one.lower()).replace(" ", "-") for one in heads}
            assert heading in anchors, f"{named(path)}: {target}"


def test_the_site_shows_every_page() -> None:
    config = (ROOT / "mkdocs.yml").read_text("utf-8")
    shown = set(re.findall(r": ([\w/]+\.md)$", config, re.MULTILINE))
    assert {path.relative_to(ROOT / "docs").as_posix() for path in DOCS} <= shown


def test_names_that_the_disagreements_lean_on_exist() -> None:
    """Solvers, effects and checks, laws, and files of tests."""
    page = (ROOT / "docs" / "disagreements.md").read_text("utf-8")
    where = [line.rstrip(" |").rpartition("|")[2] for line in page.splitlines() if line.startswith("| ")]
    names = [name for cell in where for name in re.findall(r"`([^`]+)`", cell)]
    assert len(names) > 30
    parts = {one.name for kind in map(load_kind, kind_names()) for one in (*kind.effects, *kind.solvers)}
    parts |= {check.code for kind in map(load_kind, kind_names()) for check in kind.checks}
    for name in names:
        if name.startswith("tests/"):
            assert (ROOT / name).exists(), name
        elif name.startswith("laws."):
            _, module, *law = name.split(".")
            text = (ROOT / "ptmcalc" / "laws" / f"{module}.py").read_text("utf-8")
            assert not law or f"def {law[0]}(" in text, name
        elif name not in ("check", "gap_extremes"):
            assert name in parts, name


# -- validation -----------------------------------------------------------------------------------------------------


def test_every_worked_case_is_on_the_validation_page_and_no_other() -> None:
    """The rows are held by the tests that compare them (`tests/reference/conftest.py`); here, none is left over."""
    there: dict[str, set[str]] = {}
    for path in sorted((ROOT / "tests" / "reference").glob("test_*.py")):
        for node in ast.parse(path.read_text("utf-8")).body:
            of_class = node.body if isinstance(node, ast.ClassDef) else [node]
            case = f"{node.name}::" if isinstance(node, ast.ClassDef) else ""
            for one in of_class:
                if isinstance(one, ast.FunctionDef) and one.name.startswith("test_"):
                    there.setdefault(path.stem, set()).add(validation.words(f"{case}{one.name}"))
    shown: dict[str, set[str]] = {}
    for module, titles in validation.sections().items():
        shown[module] = {title.partition(" [")[0] for title in titles}
    assert set(shown) == set(there), "a module of worked cases is missing on the page"
    for module, titles in shown.items():
        assert titles <= there[module], f"{module}: {titles - there[module]}"
    rows = sum(len(lines) for titles in validation.sections().values() for lines in titles.values())
    assert rows > 600


def test_a_row_of_the_page_is_held() -> None:
    """The comparison itself: rounding passes, a changed number does not."""
    row = "| `top` | 189504 | 189505 | +5e-06 | 2e-05 |"
    assert validation.alike(row, row)
    assert validation.alike(row, "| `top` | 189504 | 189505 | +6e-06 | 2e-05 |")
    assert not validation.alike(row, "| `top` | 189504 | 189510 | +3e-05 | 2e-05 |")
    assert not validation.alike(row, "| `top` | 189504 | 189505 | +5e-06 | 2e-04 |")
    assert not validation.alike(row, "| `end` | 189504 | 189505 | +5e-06 | 2e-05 |")
