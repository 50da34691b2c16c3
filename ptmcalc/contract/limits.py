"""Limits of checks that compute nothing: the value of a key of the design file, or a constant.

    limit=key("checks.sag", meaning="Permissible relative sag", valid="any section"),
    limit=fixed(0.0, meaning="0: below zero the rope is slack", valid="any rope", source="equilibrium"),

`explain` prints the texts as it prints the docstring of a limit that is computed. They have no full stop at their end.
"""

import math
import textwrap

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath, key_path
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.spec.scene import Scene

_WIDTH = 116
"""Columns of a docstring that is set in by four in a line of 120."""
_QUOTES = '"""'
"""Where its first line begins."""


class Limit:
    """The value at `path` of the design file; `otherwise` where the file has none, or without a path."""

    def __init__(self, path: KeyPath, otherwise: float, text: str) -> None:
        self.path = path
        self.otherwise = otherwise
        self.__doc__ = text

    def __call__(self, spec: MachineSpec, scene: Scene) -> Estimate:
        value = spec.value_at(self.path) if self.path else None
        return Estimate.exact(self.otherwise if value is None else value)


def key(
    path: str,
    *,
    meaning: str,
    valid: str,
    error: str = "none: a chosen limit",
    source: str = "the file",
    absent: float = math.inf,
) -> Limit:
    """The value of a key; `absent` where the file leaves it out, by default an infinite limit."""
    return Limit(key_path(path), absent, _text(meaning, valid, error, source))


def fixed(value: float, *, meaning: str, valid: str, source: str, error: str = "none") -> Limit:
    """The same value for every machine."""
    return Limit((), value, _text(meaning, valid, error, source))


def _text(meaning: str, valid: str, error: str, source: str) -> str:
    parts = (f"**Range** {valid}", f"**Error** {error}", f"**Source** {source}")
    return f"{_filled(meaning, _QUOTES)}\n\n" + "\n".join(map(_filled, parts))


def _filled(text: str, before: str = "") -> str:
    whole = f"{before}{text}."
    lines = whole if len(whole) <= _WIDTH else textwrap.fill(whole, _WIDTH)  # `fill` takes long: start-up is a feature
    return lines.removeprefix(before)
