"""Additions of `explain` to a check, an effect, a solver or a load: symbols and a runnable example.

Both are files in the folder of a kind, read only on request. `symbols.txt` is written by hand, in the folder of a topic
for pages of that topic alone, otherwise in that of the kind. A topic of one file may have the lines in `symbols` of its
`Topic` instead. A line `S: tension of the belt [N]` is followed by the names of the pages on which the letter has that
meaning, set in by four columns. A letter has no meaning on any other page. `examples.json` is written by the test that
holds it (`tests/house/test_explain.py`).
"""

import json
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from ptmcalc.contract.topic import Topic

SYMBOLS, EXAMPLES = "symbols.txt", "examples.json"
_LINE = re.compile(r"([^\s:]+): (.+) \[([^\[\]\s]+)\]")


@dataclass(frozen=True, slots=True)
class Symbol:
    """A symbol of a formula: meaning and unit."""

    meaning: str
    unit: str


@dataclass(frozen=True, slots=True)
class Example:
    """A shell command for the top folder of the project, and the relevant output.

    `file` is the text of `design.yaml` if the command reads one.
    """

    command: str
    says: str
    file: str = ""


Symbols = Mapping[tuple[str, str], Symbol]
"""By the name of the page whose formula it is in, and the letter."""


def no_symbols() -> Symbols:
    """For a kind that lists none."""
    return {}


def no_examples() -> Mapping[str, Example]:
    """For a kind that lists none."""
    return {}


def symbols_in(package: str, topics: Iterable[Topic[Any]] = ()) -> Callable[[], Symbols]:
    """Each `symbols.txt` in the folder of a kind and in those of its topics, and the `symbols` of the topics."""

    def read() -> Symbols:
        from ptmcalc.spec.rooms import texts_in

        found: dict[tuple[str, str], Symbol] = {}
        texts = [(f"{SYMBOLS} of {room}", text) for room, text in texts_in(package, SYMBOLS).items()]
        texts += [(f"`symbols` of a topic of {package}", topic.symbols) for topic in topics]
        for where, text in texts:
            for place, symbol in _symbols(where, text):
                if place in found:
                    raise ValueError(f"{where}: `{place[1]}` has a meaning on page `{place[0]}` already")
                found[place] = symbol
        return found

    return read


def _symbols(where: str, text: str) -> Iterator[tuple[tuple[str, str], Symbol]]:
    """Page, letter and meaning, from the lines of a text."""
    letter, symbol = "", None
    for line in text.splitlines():
        if not line or line.startswith("#"):
            continue
        if line.startswith("    ") and symbol is not None:
            for name in line.split():
                yield (name, letter), symbol
            continue
        match = _LINE.fullmatch(line)
        if match is None:
            raise ValueError(f"{where}: `{line}` is no `symbol: meaning [unit]`")
        letter, symbol = match[1], Symbol(match[2], match[3])


def examples_in(package: str) -> Callable[[], Mapping[str, Example]]:
    """The `examples.json` in the folder of a kind."""

    def read() -> Mapping[str, Example]:
        from importlib import resources

        text = resources.files(package).joinpath(EXAMPLES).read_text("utf-8")
        return {name: Example(*one) for name, one in json.loads(text).items()}

    return read
