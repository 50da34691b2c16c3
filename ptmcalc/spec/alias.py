"""Alternative names of keys: a file may use them, the program uses the keys.

A key declares its other names as `Annotated[Type, Also("pulley")]`. Before validation each of them is replaced by its
key, at the place it is written; afterwards the messages name the key as the file does.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any

from ptmcalc.base.diagnostic import Diagnostic
from ptmcalc.base.span import KeyPath, Span, dotted, key_path
from ptmcalc.base.words import quote
from ptmcalc.spec.shape import Model, aliases_of, inner, model_of, models_inside
from ptmcalc.text.document import Document

_BY_PATH = "tolerances"
"""The block whose keys are paths of other keys."""


def key_of(path: KeyPath, model: Model, data: object) -> KeyPath:
    """A path with each other name replaced by its key."""
    annotation: Any = model
    found: list[str | int] = []
    for step in path:
        here = model_of(annotation, data)
        key = aliases_of(here).get(str(step), step) if here else step
        found.append(key)
        annotation = inner(annotation, key, data)
        if isinstance(data, dict):
            data = data.get(key)
        else:
            data = data[key] if isinstance(data, list) and isinstance(key, int) and key < len(data) else None
    return tuple(found)


def with_keys(document: Document, model: Model) -> Document:
    """A document in which each other name is replaced by its key. Two names of one key are a problem of the file."""
    other = _names(model)
    if not any(path[-1] in other or path[0] == _BY_PATH for path in document.keys):
        return document
    writing = _Writing(document)
    data = writing.node(document.data, model, (), ())
    tolerances = data.get(_BY_PATH) if isinstance(data, dict) else None
    if isinstance(tolerances, dict):
        names = {name: dotted(key_of(key_path(name), model, data)) for name in tolerances}
        if any(name != key for name, key in names.items()):
            writing = _Writing(document, names)
            data = writing.node(document.data, model, (), ())
    if not (writing.aliased or writing.problems):
        return document
    return replace(
        document,
        data=data,
        keys=writing.keys,
        values=writing.values,
        problems=(*document.problems, *writing.problems),
        aliased=writing.aliased,
    )


@cache
def _names(model: Model) -> frozenset[str]:
    """The other names of all keys of a description."""
    return frozenset(name for one in models_inside(model) for name in aliases_of(one))


@dataclass(slots=True)
class _Writing:
    """A document as it is written anew with its keys."""

    old: Document
    tolerances: Mapping[str, str] = field(default_factory=dict)
    keys: dict[KeyPath, Span] = field(default_factory=dict)
    values: dict[KeyPath, Span] = field(default_factory=dict)
    aliased: dict[KeyPath, str] = field(default_factory=dict)
    problems: list[Diagnostic] = field(default_factory=list)

    def node(self, data: object, annotation: Any, was: KeyPath, path: KeyPath) -> Any:
        """A value of the file at `was`, which is at `path` from now on."""
        self.values[path] = self.old.values[was]
        if isinstance(data, list):
            return [
                self.node(one, inner(annotation, index, data), (*was, index), (*path, index))
                for index, one in enumerate(data)
            ]
        if not isinstance(data, dict):
            return data
        model = model_of(annotation, data)
        aliases = aliases_of(model) if model else self.tolerances if path == (_BY_PATH,) else {}
        chosen = self._chosen(data, aliases, was)
        found = {}
        for name, value in data.items():
            key = aliases.get(name, name)
            if chosen.get(key, name) != name:
                continue
            self.keys[*path, key] = self.old.keys[*was, name]
            if key != name:
                self.aliased[*path, key] = name
            found[key] = self.node(value, inner(annotation, key, data), (*was, name), (*path, key))
        return found

    def _chosen(self, data: Mapping[str, Any], aliases: Mapping[str, str], was: KeyPath) -> Mapping[str, str]:
        """By key, the name that counts where a mapping has several: its own ones before those that `<<` brings."""
        names: dict[str, list[str]] = {}
        for name in data:
            names.setdefault(aliases.get(name, name), []).append(name)
        chosen = {key: several[0] for key, several in names.items() if len(several) > 1}
        for several in names.values():
            first, *others = several
            for name in others:
                if (*was, name) not in self.old.merged:
                    reason = f"{quote(dotted((*was, name)))}: give it or {quote(first)}, not both: they are one key"
                    place = self.old.keys[*was, name]
                    self.problems.append(Diagnostic("SPC113", reason, place, (*was, name), f"delete {quote(name)}"))
        return chosen


def as_written(text: str, document: Document, path: KeyPath = ()) -> str:
    """A message about the block at `path` that names keys as the file does."""
    for names, pattern in _patterns(document, path):
        text = pattern.sub(names, text)
    return text


def _patterns(document: Document, path: KeyPath) -> Iterator[tuple[str, re.Pattern[str]]]:
    """For each other name that the file writes: its whole path, and its key alone where the message is about its block.

    A key that is one word is replaced between backquotes, or before a dot and another key.
    """
    for key in document.aliased:
        name, known = dotted(document.as_written(key)), re.escape(dotted(key))
        if len(key) > 1:
            yield name, re.compile(rf"(?<![\w.\]]){known}(?!\w)")
        else:
            yield name, re.compile(rf"(?<=`){known}(?=[`:.=\[])|(?<![\w.]){known}(?=\.\w)")
        if len(key) > 1 and key[:-1] in (path, path[:-1], path[:-2]):
            yield document.aliased[key], re.compile(rf"(?<=`){re.escape(str(key[-1]))}(?=[`:])")


def said_as_written(found: Diagnostic, document: Document) -> Diagnostic:
    """A diagnostic that names keys as the file does."""
    if not document.aliased:
        return found
    message, hint = (as_written(text, document, found.path) for text in (found.message, found.hint))
    return replace(found, message=message, hint=hint, path=document.as_written(found.path))
