"""Rule 1: each number that a design file may leave out is an assumption, a limit, an absent part, one of several ways
to give the same, or a setting of the computation. What is none of these would decide a verdict unseen."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, get_args

import pytest
import yaml
from pydantic import BaseModel
from pydantic.fields import FieldInfo
from support.random_machines import KINDS, texts, written

from ptmcalc.base.span import KeyPath, dotted
from ptmcalc.contract.machine import AnyKind
from ptmcalc.engine.load import load_text
from ptmcalc.spec.optional import Absent, Assumed, Declared, OneOf, Setting, declaration_of
from ptmcalc.spec.shape import measure_of

EDGES = Path(__file__).parent
PLATES = (
    "chain_drive/rating-plate.yaml",
    "conveyor/rating-plate.yaml",
    "conveyor/drives-and-winch.yaml",
    "hoist/emergency-stop.yaml",
)
"""More files whose keys are left out."""


@dataclass(frozen=True)
class Key:
    """An optional number of a fragment, and a path to it in the file."""

    model: type[BaseModel]
    name: str
    field: FieldInfo
    path: str

    @property
    def declared(self) -> Declared | None:
        return declaration_of(self.field)


def optional_numbers(kind: AnyKind) -> list[Key]:
    """Each optional number of each fragment of a kind, once."""
    found: dict[tuple[type[BaseModel], str], Key] = {}

    def walk(model: type[BaseModel], path: str, seen: frozenset[type[BaseModel]]) -> None:
        if model in seen:
            return
        for name, field in model.model_fields.items():
            key = field.alias or name
            if not field.is_required() and (measure_of(field) is not None or _counts(field.annotation)):
                found.setdefault((model, key), Key(model, key, field, f"{path}{key}"))
            for inner in _models(field.annotation):
                walk(inner, f"{path}{key}.", seen | {model})

    walk(kind.spec, "", frozenset())
    return list(found.values())


def _counts(annotation: Any) -> bool:
    return annotation is int or int in get_args(annotation)


def _models(annotation: Any) -> Iterator[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for part in get_args(annotation):
        yield from _models(part)


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.label)
def test_every_optional_number_is_declared(kind: AnyKind) -> None:
    missing = [f"{one.path} ({one.model.__name__})" for one in optional_numbers(kind) if one.declared is None]
    assert missing == []


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.label)
def test_declarations_give_their_reason(kind: AnyKind) -> None:
    for one in optional_numbers(kind):
        declared = one.declared
        if isinstance(declared, Absent | Setting):
            assert len(declared.reason.split()) >= 3, one.path
        if isinstance(declared, OneOf):
            assert declared.others, one.path
        if isinstance(declared, Assumed) and not declared.derived:
            assert declared.low <= declared.value <= declared.high, one.path
            assert declared.low < declared.high, f"{one.path}: nothing is varied"
            assert one.field.default in (None, declared.value), f"{one.path}: computed with another value"


def without(data: Any, path: KeyPath) -> Any:
    """A copy of plain data without one key."""
    step, rest = path[0], path[1:]
    if isinstance(data, list):
        return [without(one, rest) if rest and index == step else one for index, one in enumerate(data)]
    return {key: without(one, rest) if key == step else one for key, one in data.items() if rest or key != step}


def paths_of(data: Any, path: KeyPath = ()) -> Iterator[KeyPath]:
    items = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in items:
        yield (*path, key)
        yield from paths_of(value, (*path, key))


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.label)
def test_every_assumption_is_listed_where_its_key_is_left_out(kind: AnyKind) -> None:
    """Each key declared as assumed is taken out of the design files of the kind: the loader lists it with an interval
    that has two ends. A key that no design file can do without is none of them. Types of one kind share fragments: it
    is enough that one of them lists it."""
    derived = {
        (one.model, one.name): one.path
        for one in optional_numbers(kind)
        if isinstance(one.declared, Assumed) and one.declared.derived
    }
    listed: set[tuple[type[BaseModel], str]] = set()
    more = [(EDGES / path).read_text("utf-8") for path in PLATES if path.startswith(kind.name)]
    for text in (*more, *(text for one in KINDS if one.name == kind.name for text in texts(one))):
        data = yaml.load(text, yaml.BaseLoader)
        for path in [(), *paths_of(data)]:
            if path and not (isinstance(path[-1], str) and path[-1] in {name for _, name in derived}):
                continue
            changed = without(data, path) if path else data
            loaded = load_text(written(changed), "changed.yaml")
            if loaded.spec is None:
                continue
            for one in loaded.assumed:
                assert one.interval.low <= one.value <= one.interval.high, dotted(one.path)
                assert one.source, dotted(one.path)
                listed.add((type(loaded.spec.value_at(one.path[:-1])), str(one.path[-1])))
    assert sorted(path for key, path in derived.items() if key not in listed) == []


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.label)
def test_what_a_kind_assumes_is_declared_at_its_key(kind: AnyKind) -> None:
    declared = {(one.model, one.name) for one in optional_numbers(kind) if isinstance(one.declared, Assumed)}
    for text in texts(kind):
        loaded = load_text(text.encode(), "spec.yaml")
        assert loaded.spec is not None
        for one in loaded.assumed:
            owner = type(loaded.spec.value_at(one.path[:-1]))
            assert any((model, str(one.path[-1])) in declared for model in owner.__mro__), dotted(one.path)
