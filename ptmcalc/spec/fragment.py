"""A part of a description: its keys and the conditions between them.

What holds between keys is said of the mapping as the file writes it, key by key, and not of a finished model: so it
is looked at beside faults in other keys, and a file shows all its faults in one run.
"""

import itertools
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache
from typing import Any, Self

from pydantic import ConfigDict, ModelWrapValidatorHandler, ValidationError, model_validator
from pydantic_core import ErrorDetails, InitErrorDetails, PydanticCustomError

from ptmcalc.base.span import KeyPath
from ptmcalc.spec.described import Described
from ptmcalc.spec.fields import Measure, problem
from ptmcalc.spec.shape import Model, example_at, inner, keys_of, meant_key, measure_of, model_of, words_of

_NAME = re.compile(r"[\w-]+")
_MOST_SLIPS = 100
"""Unknown keys of a block that may mean known ones: what has more is no slip."""


@dataclass(frozen=True, slots=True)
class Conflict:
    """Conflicting keys of a block: the key at fault relative to the block, the reason and the remedy.

    The empty path stands for the block, which lacks a key.
    """

    path: KeyPath
    reason: str
    hint: str


@dataclass(frozen=True, slots=True)
class Given:
    """The contents of a block in the file. A misspelt key counts as the intended one and is reported once."""

    model: Model
    raw: dict[str, Any]
    _written: dict[str, Any] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        known = keys_of(self.model)
        written = {key: value for key, value in self.raw.items() if value is not None}
        for slip in [key for key in written if key not in known][:_MOST_SLIPS]:
            written.setdefault(meant_key(slip, self.model), written[slip])
        object.__setattr__(self, "_written", written)

    def __contains__(self, key: str) -> bool:
        return key in self._written

    def number(self, key: str) -> float | None:
        """The SI value of a number or its default; None where there is none, or only a faulty one."""
        about = _about(self.model, key)
        if key not in self or about.measure is None:
            return about.default if isinstance(about.default, float) else None
        try:
            return about.measure.read(self._written[key])
        except PydanticCustomError:
            return None

    def word(self, key: str) -> str | None:
        """One of the words a key takes, or its default; None where there is none, or only an unknown one."""
        about = _about(self.model, key)
        word = self._written.get(key, about.default)
        return word if word in about.words else None

    def block(self, key: str) -> "Given | None":
        """What the file writes in a block of this one, nothing where it leaves it out; None where it is no block."""
        return _given(keys_of(self.model)[key].annotation, self._written.get(key, {}))

    def blocks(self, key: str) -> "list[Given | None]":
        """What the file writes in each block of a list, as `block` says it."""
        about, raw = keys_of(self.model).get(key), self._written.get(key)
        if about is None or not isinstance(raw, list):
            return []
        return [_given(inner(about.annotation, index, raw), item) for index, item in enumerate(raw)]

    def missing(self, key: str, reason: str) -> Conflict:
        """The conflict of a block that lacks a key."""
        return Conflict((), reason, f"add `{key}: {example_at(self.model, key)}`")


@dataclass(frozen=True, slots=True)
class _About:
    """What a model says of one of its keys: default, quantity and range of a number, the words it takes."""

    default: Any
    measure: Measure | None
    words: tuple[str, ...]


@cache
def _about(model: Model, key: str) -> _About:
    field = keys_of(model)[key]
    return _About(field.default, measure_of(field), tuple(words_of(field.annotation)))


def _given(annotation: Any, raw: object) -> Given | None:
    model = model_of(annotation, raw)
    return Given(model, raw) if model and isinstance(raw, dict) else None


def exactly_one(given: Given, *keys: str) -> Iterator[Conflict]:
    """Of keys for the same quantity, exactly one is required."""
    if not any(key in given for key in keys):
        yield given.missing(keys[0], f"give {' or '.join(f'`{key}`' for key in keys)}")
    yield from at_most_one(given, *keys)


def at_most_one(given: Given, *keys: str) -> Iterator[Conflict]:
    """Of keys for the same quantity, at most one is permitted."""
    written = [key for key in keys if key in given]
    for key in written[1:]:
        yield Conflict((key,), f"give it or `{written[0]}`, not both: they state the same quantity", f"delete `{key}`")


def together(given: Given, key: str, other: str, reason: str) -> Iterator[Conflict]:
    """A key that requires another key."""
    if key in given and other not in given:
        yield given.missing(other, f"{reason}: `{other}` is missing")


def names_of_parts(given: Given, *keys: str) -> Iterator[Conflict]:
    """What a file calls the parts of a machine, which loads (`slip_distance[head]`) and paths (`drives.head.delay`)
    are read by: one word, without brackets, dots or spaces."""
    for key in keys:
        parts = given.raw.get(key)
        taken = {str(name) for name in parts} if isinstance(parts, dict) else set()
        for name in sorted(taken):
            if _NAME.fullmatch(name):
                continue
            plain = re.sub(r"[^\w-]+", "_", name).strip("_") or "part"
            taken.add(word := next(word for word in _numbered(plain) if word not in taken))
            reason = "a name is one word of letters, digits, `_` and `-`: loads and paths use it"
            yield Conflict((key, name), reason, f"write `{word}:`")


def _numbered(word: str) -> Iterator[str]:
    yield word
    yield from (f"{word}_{number}" for number in itertools.count(2))


class Fragment(Described):
    """A part of a description: immutable, and nothing in it is read without being known."""

    model_config = ConfigDict(extra="forbid", frozen=True, defer_build=True)

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The conflicts of this block."""
        yield from ()

    @model_validator(mode="wrap")
    @classmethod
    def _with_conflicts(cls, raw: Any, handler: ModelWrapValidatorHandler[Self]) -> Self:
        """The faults of the keys and of what holds between them, all at once."""
        alone = cls.conflicts.__func__ is Fragment.conflicts.__func__  # type: ignore[attr-defined]
        conflicts = list(cls.conflicts(Given(cls, raw))) if isinstance(raw, dict) and not alone else []
        faults = [
            InitErrorDetails(type=problem("SPC113", one.reason, one.hint), loc=one.path, input=raw) for one in conflicts
        ]
        try:
            read = handler(raw)
        except ValidationError as error:
            faults += [_again(fault) for fault in error.errors(include_url=False)]
        if faults:
            raise ValidationError.from_exception_data(cls.__name__, faults)
        return read


def _again(fault: ErrorDetails) -> InitErrorDetails:
    """A fault in the form in which pydantic takes it back."""
    context = fault.get("ctx", {})
    kind = problem(**context) if fault["type"] == "ptmcalc" else fault["type"]
    return InitErrorDetails(type=kind, loc=fault["loc"], input=fault["input"], ctx=context)
