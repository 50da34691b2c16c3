"""Pages that run: the files they show are written, their commands executed, and what they print is compared.

    ```yaml title="sledge.yaml"       a file, written where the page's commands run
    ```console                        `$ command`, then what it prints; `...` stands for any lines
    ```

A page runs in a folder of its own with copies of `specs/` and what else it names. `ptmcalc` runs in this process, or
in fresh ones where the page changes the package itself; everything else goes to a shell. Decimals may differ by one
unit of their last digit, as another processor makes them.
"""

import os
import re
import shlex
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import chdir
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path

from support.command import Done, environment, ptmcalc

_BLOCK = re.compile(r"^```(\w+)(?: title=\"([^\"]+)\")?\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_NUMBER = re.compile(r"[0-9]+\.[0-9]+(?:e[-+][0-9]+)?")


@dataclass(frozen=True)
class Step:
    """A file to write, or a command with what it prints."""

    line: int
    file: str = ""
    text: str = ""
    command: str = ""


def steps(page: str) -> Iterator[Step]:
    """The files and commands of a page, in its order."""
    for match in _BLOCK.finditer(page):
        language, title, text = match[1], match[2], match[3]
        line = page.count("\n", 0, match.start()) + 1
        if title:
            yield Step(line, file=title, text=text)
        elif language == "console":
            commands = re.split(r"^\$ ", text, flags=re.MULTILINE)
            assert not commands[0], f"line {line}: a console block begins with a command"
            for one in commands[1:]:
                command, _, printed = one.partition("\n")
                yield Step(line, command=command, text=printed)


def in_process(words: list[str]) -> Done:
    """The command line in this process."""
    return ptmcalc(*words)


def in_a_fresh_one(words: list[str]) -> Done:
    """The command line of the package in the present folder."""
    done = subprocess.run(
        [sys.executable, "-m", "ptmcalc", *words],
        env=environment(Path.cwd(), COLUMNS="120"),
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=False,
    )
    return Done(done.returncode, done.stdout, done.stderr)


def play(page: str, folder: Path, run: Callable[[list[str]], Done] = in_process) -> str:
    """Does what a page says in a folder; the page as it would have to be, unchanged where all came out as printed."""
    place, new = 0, page
    with chdir(folder):
        for step in steps(page):
            if step.file:
                path = Path(step.file)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(step.text, encoding="utf-8")
                continue
            place = new.index(f"$ {step.command}\n", place) + len(f"$ {step.command}\n")
            printed = _done(step.command, run)
            if not alike(printed, step.text):
                tidy = "".join(f"{line.rstrip()}\n" for line in printed.rstrip().splitlines())
                new = new[:place] + tidy + new[place + len(step.text) :]
    return new


def _done(command: str, run: Callable[[list[str]], Done]) -> str:
    """What a command prints on both streams; a `> FILE` behind it takes the output."""
    words, _, target = command.partition(" > ")
    if words.startswith("ptmcalc ") and "|" not in words:
        done = run(shlex.split(words)[1:])
        if target:
            Path(target).write_text(done.out, encoding="utf-8")
            return done.err
        return done.out + done.err
    shell = subprocess.run(
        ["bash", "-c", command], capture_output=True, text=True, check=False, env=os.environ | {"LC_ALL": "C.UTF-8"}
    )
    return shell.stdout + shell.stderr


def alike(found: str, printed: str) -> bool:
    """Whether a text is the printed one, but for the last digits of its decimals and lines left out with `...`."""
    lines = [line.rstrip() for line in found.rstrip().splitlines()]
    pattern = [line.rstrip() for line in printed.rstrip().splitlines()]
    return _matches(lines, pattern)


def _matches(lines: list[str], pattern: list[str]) -> bool:
    if not pattern:
        return not lines
    if pattern[0] == "...":
        return any(_matches(lines[skip:], pattern[1:]) for skip in range(len(lines) + 1))
    return bool(lines) and _same(lines[0], pattern[0]) and _matches(lines[1:], pattern[1:])


def _same(line: str, pattern: str) -> bool:
    if line == pattern:
        return True
    if _NUMBER.sub("#", line) != _NUMBER.sub("#", pattern):
        return False
    pairs = zip(_NUMBER.findall(line), _NUMBER.findall(pattern), strict=True)
    return all(abs(Decimal(one) - Decimal(other)) <= _unit(other) for one, other in pairs)


def _unit(number: str) -> Decimal:
    exponent = Decimal(number).as_tuple().exponent
    assert isinstance(exponent, int)
    return Decimal(1).scaleb(exponent)
