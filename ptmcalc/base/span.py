"""Where something stands in a file, and what it is called."""

from dataclasses import dataclass, field
from typing import Self

KeyPath = tuple[str | int, ...]
"""The way from the top of a document to a value: `("drive", "motor", "inertia")`, `("scenes", 0, "load")`."""


class AliasedKey(str):
    """A key that the file writes by one of its other names: equal to the key, and shown as it is written."""

    written: str

    def __new__(cls, key: str, written: str = "") -> Self:
        """`written` is set by unpickling where it is left out."""
        made = super().__new__(cls, key)
        made.written = written or key
        return made


@dataclass(frozen=True, slots=True, order=True)
class Span:
    """A place in a text; line and column count characters and start at 1."""

    line: int
    column: int
    end: int | None = field(default=None, compare=False, repr=False)
    """column behind a word that ends in its line; of what goes on below nothing is known"""


def known(path: KeyPath) -> KeyPath:
    """A path of keys alone, whatever the file calls them."""
    return tuple(step if isinstance(step, int) else str(step) for step in path)


def dotted(path: KeyPath) -> str:
    """`scenes[0].profile.time` for `("scenes", 0, "profile", "time")`; keys by the names that the file writes."""
    text = ""
    for step in path:
        if isinstance(step, AliasedKey):
            step = step.written
        text += f"[{step}]" if isinstance(step, int) else f".{step}" if text else step
    return text


def key_path(text: str) -> KeyPath:
    """The inverse of `dotted`."""
    steps: list[str | int] = []
    for step in text.replace("[", ".[").split("."):
        if step.startswith("[") and step.endswith("]") and step[1:-1].isdigit():
            steps.append(int(step[1:-1]))
        elif step:
            steps.append(step)
    return tuple(steps)
