"""Defaults of `check` in the files of a project."""

from pathlib import Path

import pytest
from support.command import Done, ptmcalc

SLIPPING = Path(__file__).parent / "specs" / "slipping.yaml"


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a design file two folders below, where commands are run."""
    inside = tmp_path / "machines" / "belts"
    inside.mkdir(parents=True)
    (inside / "one.yaml").write_bytes(SLIPPING.read_bytes())
    monkeypatch.chdir(inside)
    return tmp_path


def checked(*options: str) -> Done:
    return ptmcalc("check", "one.yaml", *options)


def last(done: Done, told: str = "") -> str:
    """The summary; of a file that hides findings it is told which one that is."""
    assert done.err == (f"ptmcalc: {told}\n" if told else "")
    return done.out.splitlines()[-1]


def test_the_nearest_file_upward_counts(project: Path) -> None:
    assert checked().status == 1
    (project / "pyproject.toml").write_text('[tool.ptmcalc]\nignore = ["CNV101", "CNV102"]\nselect = ["CNV"]\n')
    assert last(checked(), "`../../pyproject.toml` sets ignore, select") == "1 file, 4 checks passed, 4 ignored"
    (project / "machines" / "pyproject.toml").write_text('[project]\nname = "x"\n', encoding="utf-8")
    assert last(checked(), "`../../pyproject.toml` sets ignore, select").endswith("4 ignored"), "it says nothing of us"
    (project / "machines" / "ptmcalc.toml").write_text('ignore = ["CNV101"]\n', encoding="utf-8")
    assert last(checked(), "`../ptmcalc.toml` sets ignore") == "1 file, 6 checks passed, 2 ignored"


def test_the_command_line_is_stronger(project: Path) -> None:
    (project / "ptmcalc.toml").write_text('ignore = ["CNV"]\nexit-zero = true\nformat = "github"\n', encoding="utf-8")
    said = last(checked("--ignore", "CNV102"), "`../../ptmcalc.toml` sets ignore, exit-zero")
    assert said == "1 file, 4 checks passed, 1 failed, 1 undecided, 2 ignored"
    assert checked("--ignore", "CNV102").out.startswith("::error file=one.yaml")
    assert checked("--format", "plain", "--ignore", "CNV102").out.startswith("one.yaml:25:15: fail")
    assert checked("--ignore", "CNV102").status == 0


def test_every_default_reaches_its_option(project: Path) -> None:
    (project / "ptmcalc.toml").write_text(
        'select = ["CNV101"]\naccuracy = "1 %"\nbudget = "0.3 s"\nrepairs = false\neffects = ["sag=off"]\n'
        'fail-level = "warning"\nformat = "plain"\n',
        encoding="utf-8",
    )
    by_file = checked()
    (project / "ptmcalc.toml").unlink()
    options = ("--select", "CNV101", "--accuracy", "1 %", "--budget", "0.3 s", "--no-repairs", "--effects", "sag=off")
    by_hand = checked(*options, "--fail-level", "warning", "--format", "plain")
    assert (by_file.status, by_file.out, by_hand.err) == (by_hand.status, by_hand.out, "")
    assert "without sag" in by_file.out
    assert last(by_file, "`../../ptmcalc.toml` sets select").endswith("7 ignored"), (
        "that so little work does not bring the accuracy is one more"
    )
    assert "passes with" not in by_file.out


def test_a_baseline_is_named_from_the_folder_of_the_file(project: Path) -> None:
    assert checked("--write-baseline", str(project / "known.json")).status == 0
    (project / "ptmcalc.toml").write_text('baseline = "known.json"\n', encoding="utf-8")
    assert last(checked(), "`../../ptmcalc.toml` sets baseline") == "1 file, 6 checks passed, 2 waived"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("ignore = [", "cannot be read"),
        ('ignored = ["CNV"]', "unknown key `ignored` (keys: format, "),
        ('ignore = "CNV"', "`ignore` is not of its form (write a list of texts"),
        ("ignore = [1]", "`ignore` is not of its form"),
        ('exit-zero = "yes"', "`exit-zero` is not of its form (write true or false)"),
        ('ignore = ["CVN"]', "no code begins with `CVN`"),
        ('format = "pdf"', "'pdf'"),
        ('fail-level = "loud"', "'loud'"),
        ('baseline = "none.json"', "cannot be read"),
    ],
)
def test_a_faulty_file_is_wrong_usage(text: str, said: str, project: Path) -> None:
    (project / "ptmcalc.toml").write_text(text, encoding="utf-8")
    done = checked()
    assert (done.status, done.out) == (2, "")
    assert said in " ".join(done.err.split())


def test_a_table_is_asked_for(project: Path) -> None:
    (project / "pyproject.toml").write_text("[tool]\nptmcalc = 1\n", encoding="utf-8")
    assert "`tool.ptmcalc` is not a table" in checked().err


def test_other_commands_do_not_look_for_it(project: Path) -> None:
    (project / "ptmcalc.toml").write_text("nonsense", encoding="utf-8")
    assert ptmcalc("kinds").status == 0


def test_the_defaults_of_a_batch_reach_their_options(project: Path) -> None:
    """A store lies beside the file that names it."""
    (project / "ptmcalc.toml").write_text(
        'exclude = ["one.*"]\ngitignore = false\njobs = "1"\nstore = "kept"\nrepairs = false\n', encoding="utf-8"
    )
    (project / "machines" / "belts" / ".gitignore").write_text("*.yml\n", encoding="utf-8")
    (project / "machines" / "belts" / "two.yml").write_bytes(SLIPPING.read_bytes())
    done = ptmcalc("check", ".")
    assert done.out.splitlines()[-1] == "1 file, 6 checks passed, 1 failed, 1 undecided"
    assert done.out.startswith("two.yml:25:15: fail CNV101")
    assert done.err == (
        "ptmcalc: 1 design file is left out by --exclude or .gitignore\nptmcalc: 0 of 1 files known from `../../kept`\n"
    )
    assert (project / "kept").is_file()
