"""Additions of `explain` to a check, an effect, a solver or a load: symbols and a runnable example.

Both are files in the folder of a kind, read only on request. `symbols.txt` is written by hand. A line
`S: tension of the belt [N]` is followed by the names of the pages on which the letter has that meaning, set in by four
columns. A letter has no meaning on any other page. `examples.json` is written by the test that holds it
(`tests/house/test_explain.py`).
"""

import json
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass

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


def symbols_in(package: str) -> Callable[[], Symbols]:
    """The `symbols.txt` in the folder of a kind."""

    def read() -> Symbols:
        lines = [line for line in _file(package, SYMBOLS).splitlines() if line and not line.startswith("#")]
        found: dict[tuple[str, str], Symbol] = {}
        letter, symbol = "", None
        for line in lines:
            if line.startswith("    ") and symbol is not None:
                places = [(name, letter) for name in line.split()]
                if found.keys() & set(places):
                    raise ValueError(
                        f"{SYMBOLS} of {package}: `{letter}` has a meaning on each page of `{line}` already"
                    )
                found |= dict.fromkeys(places, symbol)
                continue
            match = _LINE.fullmatch(line)
            if match is None:
                raise ValueError(f"{SYMBOLS} of {package}: `{line}` is no `symbol: meaning [unit]`")
            letter, symbol = match[1], Symbol(match[2], match[3])
        return found

    return read


def examples_in(package: str) -> Callable[[], Mapping[str, Example]]:
    """The `examples.json` in the folder of a kind."""

    def read() -> Mapping[str, Example]:
        return {name: Example(*one) for name, one in json.loads(_file(package, EXAMPLES)).items()}

    return read


def _file(package: str, name: str) -> str:
    from importlib import resources

    return resources.files(package).joinpath(name).read_text("utf-8")
