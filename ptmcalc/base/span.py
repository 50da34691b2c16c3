"""Where something stands in a file, and what it is called."""

from dataclasses import dataclass, field

KeyPath = tuple[str | int, ...]
"""The way from the top of a document to a value: `("drive", "motor", "inertia")`, `("scenes", 0, "load")`."""


@dataclass(frozen=True, slots=True, order=True)
class Span:
    """A place in a text; line and column count characters and start at 1."""

    line: int
    column: int
    end: int | None = field(default=None, compare=False, repr=False)
    """column behind a word that ends in its line; of what goes on below nothing is known"""


def dotted(path: KeyPath) -> str:
    """`scenes[0].profile.time` for `("scenes", 0, "profile", "time")`."""
    text = ""
    for step in path:
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
