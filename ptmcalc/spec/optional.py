"""Meaning of an optional number, declared at its key as `Annotated[Type, Absent("...")] = 0.0`.

A number that is not given must not decide a verdict without notice. So each optional number of a kind is declared as
one of the classes below; a test walks the keys of all kinds and fails on one that is not.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from ptmcalc.base.span import KeyPath
from ptmcalc.spec.fields import Measure
from ptmcalc.spec.shape import measure_of


@dataclass(frozen=True, slots=True)
class Assumed:
    """A value is assumed: the report lists it, and verdicts are evaluated at both ends of its interval, SI.

    With a `source` the default is the declared `value`. Without arguments value, interval and source depend on the
    machine, and `assumptions` of the kind returns them for this key.
    """

    value: float = 0.0
    low: float = 0.0
    high: float = 0.0
    source: str = ""
    only_with: tuple[str, str] | None = None
    """field of the block and its word with which alone the value is used; used with any when left out"""

    @property
    def derived(self) -> bool:
        """Whether the kind's own `assumptions` return the value."""
        return not self.source


@dataclass(frozen=True, slots=True)
class Limit:
    """A limit, a rating or another requirement that only checks read.

    A default names its source in the comment of the key; where there is none, a check without its limit is `not
    checked` or does not apply, and says so. No repair is offered by changing such a key alone.
    """


@dataclass(frozen=True, slots=True)
class Checked:
    """A size or strength of a part, or how often it is used, that only checks read: the breaking force of a rope.

    A check without it is `not checked` or does not apply, and says so. Unlike a limit it belongs to the machine: a
    repair may offer another one.
    """


@dataclass(frozen=True, slots=True)
class Absent:
    """An omitted key means that the part, motion or load is absent: `reason` states why this is neutral or safe."""

    reason: str


@dataclass(frozen=True, slots=True)
class OneOf:
    """One of several keys for the same quantity; a file without any of them (`others`) is rejected, or the number is
    derived from them exactly."""

    others: str


@dataclass(frozen=True, slots=True)
class Setting:
    """A setting of the computation, not a property of the machine, such as a window or an accuracy; the default is
    printed in the report or covers the worst case (`reason`)."""

    reason: str


Declared = Assumed | Limit | Checked | Absent | OneOf | Setting
"""Possible declarations of an optional number."""


def declaration_of(field: FieldInfo) -> Declared | None:
    """What a key declares of its number."""
    return next((one for one in field.metadata if isinstance(one, Declared)), None)


def constants_of(node: Any, path: KeyPath = ()) -> Iterator[tuple[KeyPath, Assumed, Measure]]:
    """The keys with an assumption of a constant value that a machine's file does not write."""
    if isinstance(node, BaseModel):
        constants = _constants(type(node))
        for name, field in type(node).model_fields.items():
            key = field.alias or name
            if name in constants:
                declared, measure = constants[name]
                if name not in node.model_fields_set and _used(node, declared):
                    yield (*path, key), declared, measure
            elif isinstance(one := getattr(node, name), _NODES):
                yield from constants_of(one, (*path, key))
    elif isinstance(node, dict):
        for key, one in node.items():
            yield from constants_of(one, (*path, key))
    elif isinstance(node, tuple | list):
        for index, one in enumerate(node):
            yield from constants_of(one, (*path, index))


def _used(node: BaseModel, declared: Assumed) -> bool:
    """Whether a block uses a value that is assumed."""
    return declared.only_with is None or getattr(node, declared.only_with[0]) == declared.only_with[1]


_NODES = (BaseModel, dict, tuple, list)


@cache
def _constants(model: type[BaseModel]) -> Mapping[str, tuple[Assumed, Measure]]:
    """The fields of a model that assume a constant value."""
    return {
        name: (declared, measure)
        for name, field in model.model_fields.items()
        if isinstance(declared := declaration_of(field), Assumed)
        and not declared.derived
        and (measure := measure_of(field)) is not None
    }
