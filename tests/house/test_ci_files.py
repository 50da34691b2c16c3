"""What others copy into their CI: the hooks, and the examples of docs/ci.md, are parsed and run as they stand."""

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest
import yaml
from support.command import ROOT, Done, environment, ptmcalc

HOOKS = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text("utf-8"))
CI = (ROOT / "docs" / "ci.md").read_text("utf-8")
CONFIG, WORKFLOW, GITLAB = (yaml.safe_load(text) for text in re.findall(r"```yaml\n(.*?)```", CI, re.DOTALL))
SPECS = ROOT / "tests" / "cli" / "specs"
PASSING = (SPECS / "passing.yaml").read_text("utf-8")
SLIPPING = PASSING.replace("friction: 0.35", "friction: 0.09").replace("30 kN", "28 kN")


@pytest.fixture
def repository(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Design files as they are, some of which were others before."""
    for state, second in (("", SLIPPING), ("old", PASSING)):
        folder = tmp_path / state / "specs"
        folder.mkdir(parents=True)
        (folder / "a.yaml").write_text(PASSING, "utf-8")
        (folder / "b.yaml").write_text(second, "utf-8")
    (tmp_path / "specs" / "c.yaml").write_text("kind: conveyor\nspeed: 2.5\n", "utf-8")
    program = tmp_path / "bin" / "ptmcalc"
    program.parent.mkdir()
    program.write_text(f'#!/bin/sh\nexec {shlex.quote(sys.executable)} -m ptmcalc "$@"\n', "utf-8")
    program.chmod(0o755)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def shell(line: str, folder: Path) -> Done:
    """A line of a workflow, as a runner runs it."""
    env = environment(ROOT, PATH=f"{folder / 'bin'}{os.pathsep}{os.environ['PATH']}")
    done = subprocess.run(["bash", "-e", "-c", line], cwd=folder, env=env, capture_output=True, text=True, check=False)
    return Done(done.returncode, done.stdout, done.stderr)


def filled(line: str, **values: object) -> str:
    """A line in which the server has filled in what it knows."""
    for name, value in values.items():
        line = line.replace(f"${{{{ {name.replace('__', '.')} }}}}", str(value))
    assert "${{" not in line
    return line


def runs(job: str) -> list[str]:
    """The lines of a job that call ptmcalc."""
    lines = [step["run"] for step in WORKFLOW["jobs"][job]["steps"] if "run" in step]
    return [line for line in lines if line.startswith("ptmcalc")]


# -- pre-commit -----------------------------------------------------------------------------------------------------


def test_the_hooks_have_what_pre_commit_asks_for() -> None:
    assert [hook["id"] for hook in HOOKS] == ["ptmcalc", "ptmcalc-validate"]
    known = {"id", "name", "description", "entry", "language", "types", "files", "require_serial"}
    for hook in HOOKS:
        assert hook.keys() <= known
        assert all(hook[key] for key in ("id", "name", "entry"))
        assert (hook["language"], hook["types"]) == ("python", ["yaml"])
        assert re.search(hook["files"], "specs/a.yaml")
        assert re.search(hook["files"], "plant/specs/b/a.yml")
        assert not re.search(hook["files"], "myspecs/a.yaml")
    assert [hook["id"] for hook in CONFIG["repos"][0]["hooks"]] == ["ptmcalc-validate", "ptmcalc"]


@pytest.mark.parametrize(
    ("hook", "files", "status"),
    [
        ("ptmcalc", ["specs/a.yaml"], 0),
        ("ptmcalc", ["specs/a.yaml", "specs/b.yaml"], 1),
        ("ptmcalc", ["specs/a.yaml", "specs/b.yaml", "specs/c.yaml"], 2),
        ("ptmcalc-validate", ["specs/a.yaml", "specs/b.yaml"], 0),
        ("ptmcalc-validate", ["specs/a.yaml", "specs/c.yaml"], 2),
    ],
)
def test_a_hook_runs_as_pre_commit_runs_it(hook: str, files: list[str], status: int, repository: Path) -> None:
    """The entry, the arguments of the repository's own configuration, the files that are committed."""
    (entry,) = (one["entry"] for one in HOOKS if one["id"] == hook)
    (args,) = (one.get("args", []) for one in CONFIG["repos"][0]["hooks"] if one["id"] == hook)
    program, *words = shlex.split(entry)
    assert program == "ptmcalc"
    done = ptmcalc(*words, *args, *files)
    assert (done.status, done.err) == (status, "")
    computed = "checks passed" in done.out and not done.out.splitlines()[-1].startswith(f"{len(files)} files, 0 ")
    assert computed is (hook == "ptmcalc")


def test_validation_computes_nothing(repository: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(*_: object, **__: object) -> None:
        raise AssertionError("nothing is planned")

    monkeypatch.setattr("ptmcalc.engine.check.plan", refused)
    assert ptmcalc("check", "specs/b.yaml", "--validate-only").out == "1 file, 0 checks passed\n"


# -- GitHub ---------------------------------------------------------------------------------------------------------


def test_the_workflow_checks_in_shards_merges_them_and_comments(repository: Path) -> None:
    for job in WORKFLOW["jobs"].values():
        assert all(("uses" in step) != ("run" in step) for step in job["steps"])
    (check,) = runs("check")
    shards = WORKFLOW["jobs"]["check"]["strategy"]["matrix"]["shard"]
    for shard in shards:
        done = shell(filled(check, matrix__shard=shard), repository)
        assert (done.status, done.err) == (0, "")
    assert "::error file=specs/b.yaml," in done.out
    made = [f"part-{shard}.{form}" for shard in shards for form in ("json", "sarif")]
    assert sorted(path.name for path in repository.glob("part-*")) == sorted(made)
    (merge,) = runs("verdict")
    done = shell(filled(merge), repository)
    assert (done.status, done.out, done.err) == (2, "", ""), "that of the invalid file"
    whole = shell("ptmcalc check specs --format json", repository)
    assert (repository / "report.json").read_text("utf-8") == whole.out
    (diff,) = runs("comment")
    done = shell(filled(diff), repository)
    assert (done.status, done.out, done.err) == (0, "", "")
    comment = (repository / "comment.md").read_text("utf-8")
    assert comment.startswith("## ptmcalc diff\n\n**")
    assert "It passes with `takeup.tension` = " in comment


def test_a_job_goes_on_where_a_check_fails_and_not_where_the_program_breaks(repository: Path) -> None:
    (check,) = runs("check")
    for status, wanted in ((0, 0), (1, 0), (2, 0), (3, 0), (4, 1)):
        (repository / "bin" / "ptmcalc").write_text(f"#!/bin/sh\nexit {status}\n", "utf-8")
        assert shell(filled(check, matrix__shard=1), repository).status == wanted


# -- GitLab ---------------------------------------------------------------------------------------------------------


def test_the_job_of_gitlab_writes_the_report_it_names(repository: Path) -> None:
    (line,) = (line for line in GITLAB["design"]["script"] if line.startswith("ptmcalc"))
    done = shell(line, repository)
    assert done.status == 2
    assert (repository / GITLAB["design"]["artifacts"]["reports"]["junit"]).exists()
