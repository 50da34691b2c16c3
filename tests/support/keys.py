"""All keys of all kinds: the models of their descriptions, block by block."""

from collections.abc import Iterator
from typing import Any, get_args, get_origin

from pydantic import BaseModel

from ptmcalc.contract.machine import AnyKind
from ptmcalc.engine.registry import kind_names, load_kind
from ptmcalc.spec.shape import Model, keys_of, models_of

TYPES = {one.label: one for name in kind_names() for one in load_kind(name).manifests}


def blocks(model: Model, seen: set[Model]) -> Iterator[Model]:
    """A model and all that stand behind its keys."""
    if model not in seen:
        seen.add(model)
        yield model
        for field in keys_of(model).values():
            for inside in behind(field.annotation):
                yield from blocks(inside, seen)


def behind(annotation: Any) -> Iterator[Model]:
    yield from models_of(annotation)
    for part in get_args(annotation):
        if isinstance(part, type) and issubclass(part, BaseModel):
            yield part
        elif get_origin(part) is not None:
            yield from behind(part)


def fields_of(kind: AnyKind) -> Iterator[tuple[Model, str]]:
    return ((model, key) for model in blocks(kind.spec, set()) for key in keys_of(model))
