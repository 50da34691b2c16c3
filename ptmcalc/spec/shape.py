"""Structure of the models of a description: the keys of each model, their types and examples."""

import difflib
import inspect
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache, lru_cache
from types import MappingProxyType, UnionType
from typing import Any, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from ptmcalc.base.span import KeyPath, dotted
from ptmcalc.base.words import quote
from ptmcalc.spec.fields import Measure
from ptmcalc.spec.synonyms import as_a_word, by_meaning, meanings

Model = type[BaseModel]
USUAL = "usual.txt"
_MOST_PLACES = 3
"""Blocks that a hint names for a key that is in several."""


@cache
def keys_of(model: Model) -> Mapping[str, FieldInfo]:
    """The fields of a model by their keys in the file."""
    return MappingProxyType({field.alias or name: field for name, field in model.model_fields.items()})


def keys_at(model: Model, path: KeyPath, data: object) -> Mapping[str, FieldInfo]:
    """The fields, by their keys in the file, of the model that describes the mapping at `path`."""
    annotation = annotation_at(model, path, data)
    found = model_of(annotation, value_at(data, path))
    return keys_of(found) if found else {}


def names_at(model: Model, path: KeyPath, data: object) -> tuple[str, ...]:
    """The keys, with their other names, that the mapping at `path` may have."""
    found = model_of(annotation_at(model, path, data), value_at(data, path))
    return (*keys_of(found), *aliases_of(found)) if found else ()


def annotation_at(model: Model, path: KeyPath, data: object) -> Any:
    """What a model says of the value at `path`; `data` tells which of several models is meant on the way."""
    annotation: Any = model
    for index, step in enumerate(path):
        annotation = inner(annotation, step, value_at(data, path[:index]))
    return annotation


def value_at(data: object, path: KeyPath) -> object:
    """The value at `path` in plain data, None where there is none."""
    for step in path:
        if isinstance(data, dict):
            data = data.get(step)
        elif isinstance(data, list) and isinstance(step, int) and step < len(data):
            data = data[step]
        else:
            return None
    return data


def inner(annotation: Any, step: str | int, node: object) -> Any:
    """What stands behind a key or at an index of a value of which `annotation` speaks and `node` is the data."""
    model = model_of(annotation, node)
    if model is not None:
        field = keys_of(model).get(str(step))
        return field.annotation if field else _extra(model)
    for option in _options(annotation):
        if get_origin(option) in (tuple, list):
            return get_args(option)[0]
        if get_origin(option) is dict:
            return get_args(option)[1]
    return None


def _extra(model: Model) -> Any:
    """What stands behind the open keys of a model."""
    for base in model.__mro__:
        if found := inspect.get_annotations(base).get("__pydantic_extra__"):
            return inner(found, "", None)
    return None


def models_of(annotation: Any) -> list[Model]:
    """The models among the options of an annotation; more than one are told apart by their `type`."""
    return [option for option in _options(annotation) if isinstance(option, type) and issubclass(option, BaseModel)]


def model_of(annotation: Any, node: object) -> Model | None:
    """The model among the options of an annotation; of several, the one whose `type` the data names."""
    models = models_of(annotation)
    named = node.get("type") if isinstance(node, dict) else None
    return next((model for model in models if named in _types(model)), models[0] if models else None)


def _types(model: Model) -> tuple[object, ...]:
    field = model.model_fields.get("type")
    return get_args(field.annotation) if field else ()


def _options(annotation: Any) -> list[Any]:
    """The members of a union, through Annotated."""
    origin = get_origin(annotation)
    if hasattr(annotation, "__metadata__"):
        return _options(get_args(annotation)[0])
    if origin in (Union, UnionType):
        return [option for part in get_args(annotation) for option in _options(part)]
    return [annotation]


def measure_of(field: FieldInfo) -> Measure | None:
    """Quantity and range of a field, or None when it is no number with a quantity."""
    return next((part for part in (*field.metadata, *_metadata(field.annotation)) if isinstance(part, Measure)), None)


def is_whole(field: FieldInfo) -> bool:
    """Whether a field is a whole number, which has no quantity."""
    return measure_of(field) is None and int in map(_bare, _options(field.annotation))


def _bare(annotation: Any) -> Any:
    return get_args(annotation)[0] if hasattr(annotation, "__metadata__") else annotation


@dataclass(frozen=True, slots=True)
class Also:
    """Annotation of a field: other names under which a file may write its key, the standard terms of the field."""

    names: tuple[str, ...]

    def __init__(self, *names: str) -> None:
        object.__setattr__(self, "names", names)


@cache
def aliases_of(model: Model) -> Mapping[str, str]:
    """The key of a model by each of its other names."""
    found = ((key, one) for key, field in keys_of(model).items() for one in field.metadata if isinstance(one, Also))
    return MappingProxyType({name: key for key, also in found for name in also.names})


def meant_key(word: str, model: Model) -> str:
    """The key of a model that a misspelt word, or a misspelt other name of the key, is likely to mean."""
    aliases = aliases_of(model)
    close = meant(word, (*keys_of(model), *aliases))
    return aliases.get(close, close)


def _metadata(annotation: Any) -> list[Any]:
    found = list(getattr(annotation, "__metadata__", ()))
    if get_origin(annotation) in (Union, UnionType):
        found += [part for option in get_args(annotation) for part in _metadata(option)]
    return found


def words_of(annotation: Any) -> list[str]:
    """The words of which one is to be written."""
    return [value for option in _options(annotation) for value in get_args(option) if isinstance(value, str)]


@cache
def usual(model: Model, key: str) -> str:
    """A usual value of a key, as a design file writes it, or an empty text.

    Each package lists those of its models, and of the packages in it, in `usual.txt`; each folder of a topic may list
    those that only its topic reads. The files are read for hints and schemas only.
    """
    listed = (_usual_values(one.__module__).get(f"{one.__name__}.{key}", "") for one in model.__mro__)
    return next((value for value in listed if value), "")


def _usual_values(module: str) -> Mapping[str, str]:
    return _usual_values_of(module.rpartition(".")[0])


@cache
def _usual_values_of(package: str) -> Mapping[str, str]:
    if not package:
        return {}
    from ptmcalc.spec.rooms import texts_in  # for hints and schemas only

    try:
        texts = texts_in(package, USUAL)
    except (ImportError, TypeError, OSError):  # a model that is in no package
        return {}
    above = _usual_values_of(package.rpartition(".")[0])
    if package not in texts:
        return above
    lines = (line for text in texts.values() for line in text.splitlines() if not line.startswith("#"))
    return MappingProxyType({**above, **{name: value for name, _, value in (line.partition(": ") for line in lines)}})


def example_at(model: Model | None, key: str) -> str:
    """A value that can be copied behind a key of a model: a usual one of that very key where one is listed."""
    field = keys_of(model).get(key) if model else None
    if model and field and not field.examples and (listed := usual(model, key)):
        return listed
    return example_of(field)


def example_of(field: FieldInfo | None) -> str:
    """A value of the form a key takes, whatever model it is of."""
    if field and field.examples:
        return str(field.examples[0])
    measure = measure_of(field) if field else None
    return measure.quantity.example if measure else example_like(field.annotation if field else None)


def example_like(annotation: Any, word: object = None) -> str:
    """A value of the form an annotation asks for; `word` is what the file has instead, perhaps the `type` meant."""
    if int in _options(annotation):
        return "1"
    if words := words_of(annotation):
        return words[0]
    models = models_of(annotation)
    if not models:
        return "..."
    model = next((model for model in models if word in _types(model)), models[0])
    told_apart = [f"type: {_types(model)[0]}"] if len(models) > 1 else []
    keys = {key: field for key, field in keys_of(model).items() if key != "type" or not told_apart}
    entries = [(f"{key}: {example_at(model, key)}", field.is_required()) for key, field in keys.items()]
    shown = told_apart + [entry for entry, needed in entries if needed] or [entry for entry, _ in entries[:1]]
    return "{" + ", ".join(shown) + "}"


@lru_cache(maxsize=1 << 15)  # every key of a file of the largest size
def meant(word: str, known: tuple[str, ...]) -> str:
    """The known word that a misspelt one is likely to mean, or an empty text."""
    folded = {name.lower(): name for name in known}
    return next((folded[name] for name in difflib.get_close_matches(word.lower(), folded, 1, 0.55)), "")


@cache
def _places(model: Model) -> Mapping[str, Mapping[KeyPath, str]]:
    """Of each key and each word of a description, the blocks it is in, next to the top first, and how it is written."""
    found: dict[str, dict[KeyPath, str]] = {}
    seen = {model}
    level: list[tuple[KeyPath, Model]] = [((), model)]
    while level:
        below: list[tuple[KeyPath, Model]] = []
        for path, block in level:
            for key, field in keys_of(block).items():
                found.setdefault(key, {})[path] = key
                for word in words_of(field.annotation):
                    found.setdefault(as_a_word(word), {})[path] = f"{key}: {word}"
                for inside in _inside(field.annotation):
                    if inside not in seen:
                        seen.add(inside)
                        below.append(((*path, key), inside))
        level = below
    return MappingProxyType(found)


def _inside(annotation: Any) -> Iterator[Model]:
    """The models that stand behind a key, in lists and mappings too."""
    yield from models_of(annotation)
    for option in _options(annotation):
        if get_origin(option) in (tuple, list, dict):
            for part in get_args(option):
                if part is not Ellipsis:
                    yield from _inside(part)


def models_inside(model: Model) -> Iterator[Model]:
    """A model and all that stand behind its keys, each once."""
    seen, left = {model}, [model]
    while left:
        yield (one := left.pop())
        for about in keys_of(one).values():
            new = set(_inside(about.annotation)) - seen
            seen |= new
            left += new


def elsewhere(word: str, model: Model) -> str:
    """A hint for a word of the field, or a key, that stands in another block of the description; empty for others."""
    places, means = _places(model), meanings(word)
    for meaning in (*means, word):
        *block, key = meaning.split(".")
        blocks = {path: text for path, text in places.get(key, {}).items() if not block or path[-1:] == (block[0],)}
        if blocks:
            text, *_ = blocks.values()
            where = [f"under `{dotted(path)}`" if path else "at the top of the file" for path in blocks]
            more = " ..." if len(where) > _MOST_PLACES else ""
            return f"did you mean `{text}` {', or '.join(where[:_MOST_PLACES])}{more}?"
    return f"this machine kind has no key for {quote(word)} in this version" if means else ""


def did_you_mean(word: str, known: Iterable[str], otherwise: str = "") -> str:
    """A hint for a word that is not known: the one that is meant, else `otherwise` with the list of them."""
    choice = tuple(known)
    if close := by_meaning(word, choice) or meant(word, choice):
        return f"did you mean `{close}`?"
    return f"{otherwise}{', '.join(choice)}"


def unknown_key(word: str, known: Iterable[str], model: Model, otherwise: str) -> str:
    """A hint for a key that its block does not have: by meaning here, then in another block, then by spelling."""
    choice = tuple(known)
    if meanings(word) and not by_meaning(word, choice):
        return elsewhere(word, model)
    if by_meaning(word, choice) or meant(word, choice):
        return did_you_mean(word, choice, otherwise)
    return elsewhere(word, model) or did_you_mean(word, choice, otherwise)
