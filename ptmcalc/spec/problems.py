"""Faults of validation as diagnostics: each fault once, at its position, in the words of the file."""

import re
from collections.abc import Iterator
from typing import Any

from pydantic import ValidationError
from pydantic_core import ErrorDetails, PydanticCustomError

from ptmcalc.base.diagnostic import Diagnostic
from ptmcalc.base.span import KeyPath, dotted
from ptmcalc.base.units import is_of
from ptmcalc.base.words import quote
from ptmcalc.spec.fields import describe, out_of_range, problem
from ptmcalc.spec.shape import (
    Model,
    annotation_at,
    did_you_mean,
    example_at,
    example_like,
    inner,
    keys_at,
    keys_of,
    meant_key,
    measure_of,
    model_of,
    models_of,
    names_at,
    unknown_key,
    value_at,
)
from ptmcalc.text.document import Document, Unread

_LIMITS = {
    "greater_than": "greater than {gt}",
    "greater_than_equal": "at least {ge}",
    "less_than": "less than {lt}",
    "less_than_equal": "at most {le}",
}
_LENGTHS = {
    "string_too_short": ("at least", "min_length", "character"),
    "string_too_long": ("at most", "max_length", "character"),
    "too_short": ("at least", "min_length", "item"),
    "too_long": ("at most", "max_length", "item"),
}
_COUNTS = 1e6
"""No count of a machine is as large."""
_FORMS = {
    "model_type": "a mapping",
    "model_attributes_type": "a mapping",
    "dict_type": "a mapping",
    "tuple_type": "a list",
    "list_type": "a list",
    "string_type": "text",
    "int_type": "a whole number",
    "int_from_float": "a whole number",
    "string_pattern_mismatch": "a word of letters, digits, `_`, `.` and `-`",
}


def problems_of(error: ValidationError, model: Model, document: Document) -> Iterator[Diagnostic]:
    """One diagnostic per fault, without those that only follow from another one."""
    faults = error.errors(include_url=False)
    for fault in faults:
        path = path_of(fault["loc"], model)
        only_empty_now = fault["type"] == "too_short" and any(
            other["loc"][: len(fault["loc"])] == fault["loc"] != other["loc"] for other in faults
        )
        if not only_empty_now and value_at(document.data, path) is not Unread.VALUE:
            yield from _problem(fault, path, model, document)


def path_of(location: tuple[int | str, ...], model: Model) -> KeyPath:
    """A location of pydantic without the tags of unions, which are no keys of the file."""
    path: KeyPath = ()
    annotation: Any = model
    for step in location:
        if len(models_of(annotation)) > 1:
            annotation = model_of(annotation, {"type": step})
        else:
            path, annotation = (*path, step), inner(annotation, step, None)
    return path


def _problem(fault: ErrorDetails, path: KeyPath, model: Model, document: Document) -> Iterator[Diagnostic]:
    kind, given, context = fault["type"], fault["input"], fault.get("ctx", {})
    if kind == "missing":
        yield _missing(path, model, document)
    elif kind == "union_tag_not_found":
        yield _missing((*path, _discriminator(fault)), model, document)
    elif kind == "extra_forbidden":
        yield _unknown(path, model, document)
    elif kind == "literal_error":
        yield from _choice(path, given, context["expected"], document)
    elif kind == "union_tag_invalid":
        path = (*path, _discriminator(fault))
        yield from _choice(path, value_at(document.data, path), context["expected_tags"], document)
    elif kind == "ptmcalc":
        hint = _with_own_example(context["hint"], path, model, document)
        yield _said(problem(**context | {"hint": hint}), path, document)
    elif kind in _LIMITS:
        yield _said(out_of_range(given, _LIMITS[kind].format(**context)), path, document)
    elif kind in _LENGTHS:
        side, bound, unit = _LENGTHS[kind]
        limit = f"{side} {context[bound]} {unit}{'s' * (context[bound] != 1)}"
        yield _said(problem("SPC110", f"it must have {limit}, not {len(given)}", f"write {limit}"), path, document)
    else:
        yield _wrong_form(path, given, _FORMS.get(kind, "another form"), model, document)


def _model_above(path: KeyPath, model: Model, document: Document) -> Model | None:
    """The model that has the key at the end of a path."""
    return model_of(annotation_at(model, path[:-1], document.data), value_at(document.data, path[:-1]))


def _example(path: KeyPath, model: Model, document: Document) -> str:
    """A value that can be copied behind the key at the end of a path."""
    return example_at(_model_above(path, model, document), str(path[-1]))


def _with_own_example(hint: str, path: KeyPath, model: Model, document: Document) -> str:
    """A hint of a quantity, with a value of that very key where it shows one that is usual elsewhere."""
    field = keys_at(model, path[:-1], document.data).get(str(path[-1])) if path else None
    measure = measure_of(field) if field else None
    if measure is None:
        return hint
    for quantity in (measure.quantity, measure.or_else):
        own = _example(path, model, document)
        if quantity is not None and is_of(own, quantity):
            hint = hint.replace(f"e.g. `{quantity.example}`", f"e.g. `{own}`")
    return hint


def _discriminator(fault: ErrorDetails) -> str:
    return str(fault["ctx"]["discriminator"]).strip("'")


def _said(error: PydanticCustomError, path: KeyPath, document: Document) -> Diagnostic:
    """A fault that knows its code, reason and hint. Keys that do not go together are blamed, else the value is."""
    context = error.context or {}
    span = document.key_span(path) if context["code"] == "SPC113" else document.value_span(path)
    about = f"{quote(dotted(path))}: " if path else ""
    return Diagnostic(context["code"], about + context["reason"], span, path, context["hint"])


def _missing(path: KeyPath, model: Model, document: Document) -> Diagnostic:
    """A missing key, or the misspelt one that it is missing for."""
    parent, key = path[:-1], str(path[-1])
    above, block = _model_above(path, model, document), value_at(document.data, parent)
    for slip in block if isinstance(block, dict) else ():
        if above and slip not in keys_of(above) and meant_key(slip, above) == key:
            return _unknown((*parent, slip), model, document)
    where = f" under {quote(dotted(parent))}" if parent else ""
    hint = f"add `{key}: {_example(path, model, document)}`"
    return Diagnostic("SPC103", f"`{key}` is missing{where}", document.key_span(parent), path, hint)


def _unknown(path: KeyPath, model: Model, document: Document) -> Diagnostic:
    known = names_at(model, path[:-1], document.data)
    hint = unknown_key(str(path[-1]), known, model, "keys here: ") if known else "delete it"
    return Diagnostic("SPC104", f"unknown key {quote(dotted(path))}", document.key_span(path), path, hint)


def _choice(path: KeyPath, given: object, expected: str, document: Document) -> Iterator[Diagnostic]:
    if given is Unread.VALUE:
        return
    words = re.findall(r"'([^']*)'", expected) or re.findall(r"\d+", expected)
    reason = f"{quote(dotted(path))} is {describe(given)}, not one of {', '.join(f'`{word}`' for word in words)}"
    hint = did_you_mean(given if isinstance(given, str) else "", words, "write one of ")
    yield Diagnostic("SPC112", reason, document.value_span(path), path, hint)


def _wrong_form(path: KeyPath, given: object, form: str, model: Model, document: Document) -> Diagnostic:
    reason = f"{quote(dotted(path)) if path else 'the file'} takes {form}, found {describe(given)}"
    field = keys_at(model, path[:-1], document.data).get(str(path[-1])) if path else None
    example = (
        _example(path, model, document) if field else example_like(annotation_at(model, path, document.data), given)
    )
    if form == _FORMS["int_type"]:
        if isinstance(given, str) and given.strip().isdecimal():
            example = given.strip()
        elif isinstance(given, float) and 1 <= given < _COUNTS:  # a nearby count, not any one
            example = str(round(given))
    key = f"{path[-1]}: " if path and isinstance(path[-1], str) else ""
    return Diagnostic("SPC111", reason, document.value_span(path), path, f"write `{key}{example}`")
