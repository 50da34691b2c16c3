"""Which files a command is about: folders, patterns, lists, what `.gitignore` leaves out, and shards."""

import os
from pathlib import Path

import pytest

from ptmcalc.base.errors import UsageError
from ptmcalc.engine.files import Chosen, Excludes, chosen_files, design_files, part

ALL = ("a.yaml", "b/one.yml", "b/two.yaml", "b/deep/three.yaml", "c.YAML")


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder `specs` with design files and others, inside a repository; commands are run beside it."""
    for name in (*ALL, ".hidden.yaml", ".git/x.yaml", "b/.cache/y.yaml", "b/notes.txt"):
        path = tmp_path / "specs" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("kind: conveyor\n", encoding="utf-8")
    (tmp_path / ".git").mkdir()
    (tmp_path / "specs" / ".git" / "x.yaml").unlink()
    (tmp_path / "specs" / ".git").rmdir()
    monkeypatch.chdir(tmp_path)
    return tmp_path / "specs"


def names(chosen: Chosen) -> list[str]:
    return [path.as_posix() for path in chosen.files]


def inside(*found: str) -> list[str]:
    return [f"specs/{name}" for name in found]


IN_ORDER = ("a.yaml", "b/deep/three.yaml", "b/one.yml", "b/two.yaml", "c.YAML")


def test_a_folder_stands_for_its_design_files_by_path(place: Path) -> None:
    chosen = chosen_files(["specs"], Excludes())
    assert (names(chosen), chosen.empty, chosen.excluded) == (inside(*IN_ORDER), (), 0)
    assert [path.as_posix() for path in design_files(Path("specs"))] == names(chosen)


def test_what_is_named_stands_in_its_order_and_once(place: Path) -> None:
    chosen = chosen_files(["specs/c.YAML", "specs/b", "specs", "specs/./a.yaml"], Excludes())
    assert names(chosen) == inside("c.YAML", "b/deep/three.yaml", "b/one.yml", "b/two.yaml", "a.yaml")


def test_a_pattern_goes_into_folders_and_takes_design_files_only(place: Path) -> None:
    assert names(chosen_files(["specs/**/t*"], Excludes())) == inside("b/deep/three.yaml", "b/two.yaml")
    assert names(chosen_files(["specs/b/*"], Excludes())) == inside("b/one.yml", "b/two.yaml")
    assert chosen_files(["specs/*.json"], Excludes()).empty == ("specs/*.json",)


def test_a_file_whose_name_looks_like_a_pattern_is_a_file(place: Path) -> None:
    (place / "[1].yaml").write_text("kind: conveyor\n", encoding="utf-8")
    assert names(chosen_files(["specs/[1].yaml"], Excludes())) == inside("[1].yaml")


def test_a_list_stands_where_its_dash_stands(place: Path) -> None:
    chosen = chosen_files(["specs/c.YAML", "-", "specs/a.yaml"], Excludes(), ["specs/b/two.yaml", "specs/b/deep"])
    assert names(chosen) == inside("c.YAML", "b/two.yaml", "b/deep/three.yaml", "a.yaml")


@pytest.mark.parametrize(
    ("patterns", "left"),
    [
        (("b/",), ("a.yaml", "c.YAML")),
        (("*.yml", "deep"), ("a.yaml", "b/two.yaml", "c.YAML")),
        (("/specs/b/*", "!two.yaml"), ("a.yaml", "b/two.yaml", "c.YAML")),
        (("/b/*.yaml",), ("a.yaml", "b/deep/three.yaml", "b/one.yml", "c.YAML")),
        (("t*.yaml", "!**/deep/three.yaml"), ("a.yaml", "b/deep/three.yaml", "b/one.yml", "c.YAML")),
        (("nothing",), IN_ORDER),
    ],
    ids=str,
)
def test_patterns_leave_out_of_folders_what_gitignore_would(
    place: Path, patterns: tuple[str, ...], left: tuple[str, ...]
) -> None:
    """Seen from where the command is run, or from the folder."""
    chosen = chosen_files(["specs"], Excludes(patterns))
    assert names(chosen) == inside(*left)
    assert chosen.excluded == len(IN_ORDER) - len(left)


def test_the_gitignore_of_the_folder_of_those_above_and_below_count(place: Path) -> None:
    (place.parent / ".gitignore").write_text("# generated\n\n*.yml\nspecs/c.*\n", encoding="utf-8")
    (place / "b" / ".gitignore").write_text("!one.yml\n/deep/\n", encoding="utf-8")
    chosen = chosen_files(["specs"], Excludes(files=True))
    assert names(chosen) == inside("a.yaml", "b/one.yml", "b/two.yaml")
    assert chosen.excluded == 2
    assert names(chosen_files(["specs"], Excludes())) == inside(*IN_ORDER)


def test_a_gitignore_above_the_repository_does_not_count(place: Path) -> None:
    (place / ".git").mkdir()
    (place.parent / ".gitignore").write_text("*.yaml\n", encoding="utf-8")
    assert names(chosen_files(["specs"], Excludes(files=True))) == inside(*IN_ORDER)


def test_what_is_named_is_never_left_out(place: Path) -> None:
    (place.parent / ".gitignore").write_text("specs/\n", encoding="utf-8")
    every = Excludes(("*.yaml",), files=True)
    assert names(chosen_files(["specs/a.yaml", "specs/b/*.yaml"], every)) == inside("a.yaml", "b/two.yaml")
    assert names(chosen_files(["specs"], Excludes(files=True))) == inside(*IN_ORDER)


def test_the_command_line_is_stronger_than_files(place: Path) -> None:
    (place / ".gitignore").write_text("*\n!b/\n", encoding="utf-8")
    assert names(chosen_files(["specs"], Excludes(("!a.yaml",), files=True))) == inside("a.yaml")


def test_a_folder_of_which_all_is_left_out_is_told(place: Path) -> None:
    chosen = chosen_files(["specs/b"], Excludes(("*",)))
    assert (chosen.files, chosen.empty, chosen.excluded) == ((), ("specs/b",), 3)


def test_links_are_followed_to_files_and_not_to_folders(place: Path) -> None:
    os.symlink(place / "a.yaml", place / "b" / "link.yaml")
    os.symlink(place / "nowhere.yaml", place / "b" / "lost.yaml")
    os.symlink(place, place / "b" / "loop")
    found = inside("b/deep/three.yaml", "b/link.yaml", "b/lost.yaml", "b/one.yml", "b/two.yaml")
    assert names(chosen_files(["specs/b"], Excludes())) == found


def test_a_link_that_leads_in_a_circle_is_there_to_be_told_as_unreadable(place: Path) -> None:
    os.symlink("circle.yaml", place / "b" / "circle.yaml")
    for word in ("specs/b", "specs/b/c*.yaml"):
        chosen = chosen_files([word], Excludes())
        assert Path("specs/b/circle.yaml") in chosen.files
        assert chosen.outside == ()


@pytest.mark.parametrize("number", [1, 2, 3, 7])
def test_every_file_is_in_exactly_one_shard(number: int) -> None:
    files = [Path(f"{index}.yaml") for index in range(5)]
    parts = [part(files, f"{index}/{number}") for index in range(1, number + 1)]
    assert sorted(file for one in parts for file in one) == files
    assert max(map(len, parts)) - min(map(len, parts)) <= 1


@pytest.mark.parametrize("text", ["0/2", "3/2", "1", "1/", "/2", "a/b", "1/0", "-1/2", "1/2/3", "²/3"])
def test_what_is_no_shard_is_refused(text: str) -> None:
    with pytest.raises(UsageError, match="not a part of a run"):
        part([], text)
