"""Which files a command is about: names, folders, patterns and lists to design files."""

import itertools
import os
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from glob import glob, has_magic
from pathlib import Path, PurePath, PurePosixPath
from typing import TYPE_CHECKING

from ptmcalc.base.errors import UsageError
from ptmcalc.base.words import quote
from ptmcalc.text.document import MAX_BYTES
from ptmcalc.text.source import beginning_of

if TYPE_CHECKING:
    from pathspec import GitIgnoreSpec

SUFFIXES = (".yaml", ".yml")
_IGNORED = ".gitignore"
_KIND, _TYPE = (re.compile(b"^%s:[ \\t]*[\"']?([a-z_]+)" % key, re.MULTILINE) for key in (b"kind", b"type"))
_MOST_STARS = 4
"""Number of `*` inside one part of a pattern that is refused. A numerical choice: the time of a name that does not
match grows with the power of the number. A larger number allows patterns that take very long."""


@dataclass(frozen=True, slots=True)
class Excludes:
    """What a walk through a folder leaves out: patterns as `.gitignore` writes them, and those of such files."""

    patterns: tuple[str, ...] = ()
    files: bool = False
    """whether the `.gitignore` of a folder, and of those above it up to the top of its repository, count"""


@dataclass(frozen=True, slots=True)
class Chosen:
    """The files of a run, each once; folders and patterns without any; how many were left out; links that are not
    followed."""

    files: tuple[Path, ...]
    empty: tuple[str, ...] = ()
    excluded: int = 0
    outside: tuple[Path, ...] = ()
    """links in folders that lead out of them, and out of their repository: who named the folder did not name those"""


@dataclass(slots=True)
class _Walk:
    """One walk through a folder; the rules of an inner `.gitignore` are stronger than those of an outer one."""

    excludes: Excludes
    left_out: int = 0
    found: list[Path] = field(default_factory=list)
    outside: list[Path] = field(default_factory=list)
    top: Path = field(default_factory=Path)

    def into(self, folder: Path) -> None:
        above: list[_Rules] = []
        self.top = _top(folder)
        if self.excludes.files:
            above = [rules for place in _above(folder) if (rules := _ignored_in(place))]
        if _said(folder, above, is_folder=True):  # it is named: what leaves it out as a whole does not count
            above = []
        spec = _spec(self.excludes.patterns)
        self._walk(folder, [(folder, spec), (Path.cwd(), spec)] if spec else [], above)

    def _walk(self, folder: Path, asked: "list[_Rules]", rules: "list[_Rules]") -> None:
        """Into a folder, by the patterns asked for and, where they say nothing, by those of files."""
        if self.excludes.files and (own := _ignored_in(folder)):
            rules = [*rules, own]
        try:
            entries = sorted(os.scandir(folder), key=lambda entry: entry.name)
        except OSError:
            self.found.append(folder)  # reported as unreadable
            return
        for entry in entries:
            is_folder = entry.is_dir(follow_symlinks=False)
            if entry.name.startswith(".") or not (is_folder or _is_called_so(entry.name)):
                continue
            path = Path(entry.path)
            if not (is_folder or entry.is_file(follow_symlinks=False) or _is_design_file(path)):
                continue
            said = _said(path, asked, is_folder=is_folder)
            if said or (said is None and _said(path, rules, is_folder=is_folder)):
                self.left_out += sum(1 for _ in _all_in(path)) if is_folder else 1
            elif is_folder:
                self._walk(path, asked, rules)
            elif entry.is_symlink() and not _leads_to(path).is_relative_to(self.top):
                self.outside.append(path)
            else:
                self.found.append(path)


_Rules = tuple[Path, "GitIgnoreSpec"]
"""Patterns, and the folder they are seen from."""


def design_files(folder: Path) -> list[Path]:
    """All design files in a folder and below it, sorted; hidden ones are left out, folders behind links too. A link
    to a file that leads nowhere is among them: it is reported as unreadable, not passed over."""
    return sorted(_all_in(folder))


def chosen_files(paths: Sequence[str], excludes: Excludes, listed: Iterable[str] = ()) -> Chosen:
    """The files that words of a command line name: files, folders, patterns (`**` goes into folders), and `-` for
    those `listed`. What is named stands in its order, what a word stands for by path.

    A file that is named, or that a pattern or a list gives, is never left out.
    """
    found: dict[Path, None] = {}
    outside: dict[Path, None] = {}
    empty: list[str] = []
    left_out = 0
    for word in (name for path in paths for name in ([path] if path != "-" else listed)):
        path = Path(word)
        if path.is_dir():
            walk = _Walk(excludes)
            walk.into(path)
            left_out += walk.left_out
            some: Sequence[Path] = walk.found
            out: Sequence[Path] = walk.outside
        elif not os.path.lexists(path) and has_magic(word):
            matching = [one for one in map(Path, glob(word, recursive=True)) if _is_design_file(one)]
            top = _top(_without_magic(path))
            out = [one for one in matching if not _leads_to(one).is_relative_to(top)]
            some = [one for one in matching if one not in out]
        else:
            some, out = [path], []
        outside |= dict.fromkeys(out)
        if not some and not out:
            empty.append(word)
        found |= dict.fromkeys(sorted(some, key=by_path))
    return Chosen(tuple(found), tuple(empty), left_out, tuple(outside))


def files_below(path: Path) -> Iterator[Path]:
    """The design files in a folder and below it, in any order, hidden ones left out; a file itself."""
    return _all_in(path) if path.is_dir() else iter([path])


def machine_in(raw: bytes) -> bytes:
    """The kind, and behind a dot the type, that a text seems to name, without reading it; empty where it does not."""
    kind, type_ = _KIND.search(raw), _TYPE.search(raw)
    return (kind[1] if kind else b"") + (b"." + type_[1] if kind and type_ else b"")


def by_path(path: PurePath | str) -> tuple[str, ...]:
    """What sorts files: the parts of their paths, so that a folder's files stay together."""
    return PurePosixPath(path).parts if isinstance(path, str) else path.parts


def part(files: Sequence[Path], text: str) -> tuple[Path, ...]:
    """The files of a shard `i/n`, every n-th: each file is in exactly one of the n.

    Raises:
        UsageError: the text is no shard.
    """
    index, separator, number = text.partition("/")
    if not separator or not (index.isdecimal() and number.isdecimal()) or not 1 <= int(index) <= int(number):
        raise UsageError(f"`--shard {text}` is not a part of a run", "write i/n with i from 1 to n, e.g. --shard 1/4")
    return tuple(files[int(index) - 1 :: int(number)])


def _all_in(folder: Path) -> Iterator[Path]:
    for place, inner, names in os.walk(folder):
        inner[:] = [name for name in inner if not name.startswith(".")]
        for path in (Path(place, name) for name in names if not name.startswith(".")):
            if _is_design_file(path):
                yield path


def _is_called_so(name: str) -> bool:
    return os.path.splitext(name)[1].lower() in SUFFIXES


def _is_design_file(path: Path) -> bool:
    return _is_called_so(path.name) and (path.is_file() or (path.is_symlink() and not path.exists()))


def _leads_to(path: Path) -> Path:
    """Where a link leads in the end; one that leads in a circle, to itself, which cannot be read."""
    return Path(os.path.realpath(path))


def _above(folder: Path) -> list[Path]:
    """The folders above one up to the top of its repository, outermost first; none where it is in no repository."""
    here = folder.resolve()
    places = [here, *here.parents]
    top = next((index for index, place in enumerate(places) if (place / ".git").exists()), 0)
    return places[top:0:-1]


def _top(folder: Path) -> Path:
    """The top of the repository a folder is in, else the folder itself."""
    return next(iter(_above(folder)), folder.resolve())


def _without_magic(pattern: Path) -> Path:
    """The folder in which a pattern begins to be one."""
    return Path(*itertools.takewhile(lambda part: not has_magic(part), pattern.parts))


def _spec(lines: Sequence[str]) -> "GitIgnoreSpec | None":
    if not lines:
        return None
    for line in lines:
        if any(part.strip("*").count("*") >= _MOST_STARS for part in line.split("/")):
            raise UsageError(f"the pattern {quote(line)} has too many `*`", "it could match in very many variants")
    from pathspec import GitIgnoreSpec

    try:
        return GitIgnoreSpec.from_lines(lines)
    except ValueError as error:
        raise UsageError(f"a pattern to exclude is none: {error}", "patterns are those of .gitignore") from None


def _ignored_in(folder: Path) -> _Rules | None:
    try:
        lines = beginning_of(folder / _IGNORED, MAX_BYTES).decode("utf-8", "replace").splitlines()
    except OSError:
        return None
    spec = _spec([line for line in lines if line.strip() and not line.startswith("#")])
    return (folder, spec) if spec is not None else None


def _said(path: Path, rules: "Sequence[_Rules]", *, is_folder: bool) -> bool | None:
    """Whether a path is left out by the innermost rule that says anything of it; None where none does."""
    for place, spec in reversed(rules):
        seen = _seen_from(place, path)
        if seen is None:
            continue
        said = spec.check_file(f"{seen}/" if is_folder else seen).include
        if said is not None:
            return said
    return None


def _seen_from(place: Path, path: Path) -> str | None:
    try:
        return path.relative_to(place).as_posix()
    except ValueError:
        pass
    try:
        return (path.parent.resolve() / path.name).relative_to(place.resolve()).as_posix()
    except ValueError:
        return None
