"""Defaults of `check` that a project keeps in `ptmcalc.toml`, or in `[tool.ptmcalc]` of its `pyproject.toml`."""

import os
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ptmcalc.base.errors import UsageError
from ptmcalc.cli.output import say

_OPTIONS: Mapping[str, tuple[str, type]] = {
    "format": ("form", str),
    "accuracy": ("accuracy", str),
    "effects": ("effects", list),
    "budget": ("budget", str),
    "repairs": ("repairs", bool),
    "fail-level": ("fail_level", str),
    "select": ("select", list),
    "ignore": ("ignore", list),
    "baseline": ("baseline", str),
    "exit-zero": ("exit_zero", bool),
    "exclude": ("exclude", list),
    "gitignore": ("gitignore", bool),
    "jobs": ("jobs", str),
    "store": ("store", str),
}
"""Keys of the file: the parameter of `check` and the form of its value."""
_HIDING = ("select", "ignore", "baseline", "exit-zero")
"""Keys that keep findings out of the report or of the exit status: who reads the report may not know the file."""
_FORMS = {str: 'text, e.g. "..."', bool: "true or false", list: 'a list of texts, e.g. ["..."]'}


def defaults(folder: Path) -> dict[str, Any]:
    """Defaults for the parameters of `check` in a folder: those of the nearest file here or above it.

    Raises:
        UsageError: the file is not TOML, or says what `check` does not know.
    """
    for place in (folder, *folder.parents):
        for name in ("ptmcalc.toml", "pyproject.toml"):
            path = place / name
            if path.is_file():
                found = _read(path)
                if found is not None:
                    given = _parameters(found, path)
                    _tell(path, [key for key in found if key in _HIDING and found[key]])
                    return given
    return {}


def _tell(path: Path, hiding: Sequence[str]) -> None:
    if hiding:
        say(f"ptmcalc: `{os.path.relpath(path)}` sets {', '.join(hiding)}\n", err=True)


def _read(path: Path) -> Any:
    """What a file says of ptmcalc; None where it says nothing."""
    try:
        document: Any = tomllib.loads(path.read_text("utf-8"))
    except (OSError, ValueError) as error:
        raise UsageError(f"`{path}` cannot be read: {error}") from None
    if path.name == "ptmcalc.toml":
        return document
    tools = document.get("tool", {})
    return tools.get("ptmcalc") if isinstance(tools, dict) else None


def _parameters(found: Any, path: Path) -> dict[str, Any]:
    if not isinstance(found, dict):
        raise UsageError(f"`{path}`: `tool.ptmcalc` is not a table", "write `[tool.ptmcalc]`")
    given = {}
    for key, value in found.items():
        if key not in _OPTIONS:
            raise UsageError(f"`{path}`: unknown key `{key}`", f"keys: {', '.join(_OPTIONS)}")
        name, form = _OPTIONS[key]
        texts = isinstance(value, list) and all(isinstance(item, str) for item in value)
        if not (texts if form is list else isinstance(value, form)):
            raise UsageError(f"`{path}`: `{key}` is not of its form", f"write {_FORMS[form]}")
        given[name] = os.path.relpath(path.parent / value) if key in ("baseline", "store") and value else value
    return given
