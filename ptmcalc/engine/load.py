"""Document -> spec: validation with every problem at its place, and assumptions filled in."""

import difflib
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import UnionType
from typing import Any, Union, get_args, get_origin

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from ptmcalc.base.diagnostic import Diagnostic, Severity
from ptmcalc.base.errors import UsageError
from ptmcalc.base.span import KeyPath, dotted
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.report import AssumedReport
from ptmcalc.engine.registry import kind_names, load_kind
from ptmcalc.spec.fields import Measure, describe
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.text.document import Document, parse

_CHECK_CODE = re.compile(r"[A-Z]{3}[0-9]{3}")


@dataclass(frozen=True, slots=True)
class Loaded:
    """A design file as far as it could be read: the kind and the filled-in spec, or the problems."""

    document: Document
    kind: AnyKind | None = None
    spec: MachineSpec | None = None
    assumed: tuple[AssumedReport, ...] = ()
    diagnostics: tuple[Diagnostic, ...] = ()


def load_file(path: Path, name: str, effects: Mapping[str, str] | None = None, accuracy: str = "") -> Loaded:
    """Read one design file; `effects` and `accuracy` replace what the file says of them."""
    try:
        raw = path.read_bytes()
    except OSError as error:
        reason = error.strerror or str(error)
        problem = Diagnostic("TXT101", f"the file cannot be read: {reason}", hint="check the path and its permissions")
        return Loaded(Document(name, None), diagnostics=(problem,))
    return load_text(raw, name, effects, accuracy)


def load_text(raw: bytes, name: str, effects: Mapping[str, str] | None = None, accuracy: str = "") -> Loaded:
    """Read a design file from its bytes."""
    document = parse(raw, name)
    problems = list(document.problems)
    if not isinstance(document.data, dict):
        return Loaded(document, diagnostics=tuple(problems))
    data = dict(document.data)
    kind, trouble = _kind_of(document, data)
    if kind is None:
        return Loaded(document, diagnostics=(*problems, *trouble))
    if effects and isinstance(data.get("effects", {}), dict):
        data["effects"] = {**data.get("effects", {}), **effects}
    if accuracy:
        data["accuracy"] = accuracy
    try:
        spec = kind.spec.model_validate(data)
    except ValidationError as error:
        problems += _validation_problems(error.errors(), kind, document)
        problems += _open_key_problems(kind, data, document)
        return Loaded(document, kind, diagnostics=tuple(_in_file_order(problems)))
    problems += _open_key_problems(kind, data, document)
    problems += _scene_name_problems(spec, document)
    if problems:
        return Loaded(document, kind, diagnostics=tuple(_in_file_order(problems)))
    spec, assumed = fill(kind, spec)
    notes = tuple(
        Diagnostic(
            finding.code,
            finding.message,
            document.value_span(finding.path),
            finding.path,
            finding.hint,
            Severity.WARNING,
        )
        for finding in kind.inspect(spec)
    )
    return Loaded(document, kind, spec, assumed, notes)


def fill(kind: AnyKind, spec: MachineSpec) -> tuple[MachineSpec, tuple[AssumedReport, ...]]:
    """The spec with every assumption in place, and the list of them."""
    assumed = []
    for assumption in kind.assumptions:
        if spec.value_at(assumption.path) is not None:
            continue
        value = assumption.value(spec)
        if value is not None:
            interval = assumption.interval(spec)
            assumed.append(AssumedReport(assumption.path, value, assumption.quantity, interval, assumption.source))
            spec = spec.with_value(assumption.path, value)
    return spec, tuple(assumed)


def _kind_of(document: Document, data: Mapping[str, Any]) -> tuple[AnyKind | None, list[Diagnostic]]:
    names = kind_names()
    kinds = f"kinds: {', '.join(names)}"
    if "kind" not in data:
        return None, [
            Diagnostic("SPC101", "`kind` is missing", document.value_span(()), (), f"add `kind: ...`; {kinds}")
        ]
    named = data["kind"]
    if named not in names:
        close = difflib.get_close_matches(str(named), names, 1)
        hint = f"did you mean `{close[0]}`?" if close else kinds
        return None, [
            Diagnostic(
                "SPC102",
                f"no machine kind is called `{named}`",
                document.value_span(("kind",)),
                ("kind",),
                hint,
            )
        ]
    try:
        return load_kind(named), []
    except UsageError as error:
        return None, [Diagnostic("SPC102", error.message, document.value_span(("kind",)), ("kind",), error.hint)]


def _in_file_order(problems: Iterable[Diagnostic]) -> list[Diagnostic]:
    unique = {(p.code, p.span, p.path, p.message): p for p in problems}
    return sorted(unique.values(), key=lambda p: (p.span.line if p.span else 0, p.span.column if p.span else 0, p.code))


def _validation_problems(errors: list[ErrorDetails], kind: AnyKind, document: Document) -> list[Diagnostic]:
    """One diagnostic per error, without those that only follow from another one."""
    places = [error["loc"] for error in errors]
    problems = []
    for error in errors:
        here = error["loc"]
        if error["type"] == "too_short" and any(place[: len(here)] == here != place for place in places):
            continue  # the list is only empty because its items are faulty
        if here[:1] == ("checks",) and len(here) > 1 and str(here[1]) in _unknown_checks(kind, document.data):
            continue
        problems.append(_problem(error, kind.spec, document))
    return problems


def _problem(error: ErrorDetails, model: type[BaseModel], document: Document) -> Diagnostic:
    """One pydantic error as a diagnostic with our code, at the place of its key or value."""
    path = _path_in_file(error["loc"], document)
    kind, given, context = error["type"], error.get("input"), error.get("ctx", {})
    at_value, name = document.value_span(path), dotted(path) or "the file"
    if kind == "ptmcalc":
        reason = f"`{dotted(path)}`: {context['reason']}" if path else str(context["reason"])
        return Diagnostic(context["code"], reason, at_value, path, context["hint"])
    if kind in ("missing", "union_tag_not_found"):
        key = str(error["loc"][-1]) if kind == "missing" else str(context["discriminator"]).strip("'")
        parent = path if kind == "union_tag_not_found" else _path_in_file(error["loc"][:-1], document)
        field = fields_at(model, parent, document.data).get(key)
        hint = f"add `{key}: {example_of(field)}`"
        where = f" under `{dotted(parent)}`" if parent else ""
        return Diagnostic("SPC103", f"`{key}` is missing{where}", document.key_span(parent), (*parent, key), hint)
    if kind == "extra_forbidden":
        parent, key = path[:-1], str(path[-1])
        known = fields_at(model, parent, document.data)
        if key[:1].isdigit():
            reason = f"a decimal comma splits the value in front of `{key}`"
            return Diagnostic("SPC107", reason, document.key_span(path), path, f"write a decimal point: `.{key}`")
        return Diagnostic("SPC104", f"unknown key `{name}`", document.key_span(path), path, _did_you_mean(key, known))
    if kind in ("literal_error", "union_tag_invalid"):
        tag = kind == "union_tag_invalid"
        path = (*path, str(context["discriminator"]).strip("'")) if tag else path
        wrong = context["tag"] if tag else given
        expected = re.findall(r"'([^']*)'", context["expected_tags" if tag else "expected"])
        close = difflib.get_close_matches(str(wrong), expected, 1)
        choice = ", ".join(f"`{word}`" for word in expected)
        hint = f"did you mean `{close[0]}`?" if close else f"write one of {choice}"
        reason = f"`{dotted(path)}` is {describe(wrong)}, not one of {choice}"
        return Diagnostic("SPC112", reason, document.value_span(path), path, hint)
    if kind in (
        "too_long",
        "too_short",
        "greater_than_equal",
        "less_than_equal",
        "string_too_long",
        "string_too_short",
    ):
        message = error["msg"].replace("Input", "the value").replace("Tuple", "the list")
        return Diagnostic("SPC110", f"`{name}`: {message}", at_value, path)
    field = fields_at(model, path[:-1], document.data).get(str(path[-1])) if path else None
    expected_form = _form_of(kind)
    hint = f"write `{path[-1]}: {example_of(field)}`" if path and isinstance(path[-1], str) else ""
    return Diagnostic("SPC111", f"`{name}` takes {expected_form}, found {describe(given)}", at_value, path, hint)


def _path_in_file(location: tuple[int | str, ...], document: Document) -> KeyPath:
    """A pydantic location without the tags of unions, which are not keys of the file."""
    path: KeyPath = ()
    for step in location:
        longer = (*path, step)
        if longer in document.values or step == location[-1]:
            if longer not in document.values and isinstance(step, str) and step.startswith("["):
                continue
            path = longer
    return path if path in document.values or len(path) < 2 else _known(path, document)


def _known(path: KeyPath, document: Document) -> KeyPath:
    """The path itself when its parent is in the file, else as much of it as is."""
    while len(path) > 1 and path[:-1] not in document.values:
        path = (*path[:-2], path[-1])
    return path


def _form_of(kind: str) -> str:
    forms = {
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
    return forms.get(kind, "another form")


def _did_you_mean(key: str, known: Mapping[str, FieldInfo]) -> str:
    close = difflib.get_close_matches(key.lower(), known, 1, 0.55)
    if close:
        return f"did you mean `{close[0]}`?"
    return f"keys here: {', '.join(known)}" if known else "delete it"


def fields_at(model: type[BaseModel], path: KeyPath, data: object) -> Mapping[str, FieldInfo]:
    """The fields, by their keys in the file, of the model that describes the mapping at `path`."""
    current: type[BaseModel] | None = model
    node = data
    annotation: Any = model
    for step in path:
        node = _child(node, step)
        if isinstance(step, int):
            annotation = _item_of(annotation)
        elif current is not None:
            field = _by_key(current).get(step)
            annotation = field.annotation if field else None
        current = _model_of(annotation, node)
    return _by_key(current) if current is not None else {}


def _child(node: object, step: str | int) -> object:
    if isinstance(node, dict):
        return node.get(step)
    if isinstance(node, list) and isinstance(step, int) and step < len(node):
        return node[step]
    return None


def _by_key(model: type[BaseModel]) -> dict[str, FieldInfo]:
    return {field.alias or name: field for name, field in model.model_fields.items()}


def _options(annotation: Any) -> list[Any]:
    """The members of a union, through Annotated."""
    origin = get_origin(annotation)
    if hasattr(annotation, "__metadata__"):
        return _options(get_args(annotation)[0])
    if origin in (Union, UnionType):
        return [option for part in get_args(annotation) for option in _options(part)]
    return [annotation]


def _item_of(annotation: Any) -> Any:
    for option in _options(annotation):
        if get_origin(option) in (tuple, list):
            return get_args(option)[0]
    return None


def _model_of(annotation: Any, node: object) -> type[BaseModel] | None:
    """The model among the options of an annotation; of several, the one whose `type` the data names."""
    models = [option for option in _options(annotation) if isinstance(option, type) and issubclass(option, BaseModel)]
    named = node.get("type") if isinstance(node, dict) else None
    for model in models:
        if "type" in model.model_fields and named in get_args(model.model_fields["type"].annotation):
            return model
    return models[0] if models else None


def example_of(field: FieldInfo | None) -> str:
    """A value that can be copied behind a key."""
    if field is None:
        return "..."
    for part in (*field.metadata, *_metadata(field.annotation)):
        if isinstance(part, Measure):
            return part.quantity.example
    if int in _options(field.annotation):
        return "1"
    literals = [value for option in _options(field.annotation) for value in get_args(option) if isinstance(value, str)]
    if literals:
        return literals[0]
    model = _model_of(field.annotation, None)
    if model is not None:
        needed = [f"{key}: {example_of(inner)}" for key, inner in _by_key(model).items() if inner.is_required()]
        return "{" + ", ".join(needed) + "}"
    return "..."


def _metadata(annotation: Any) -> list[Any]:
    found = list(getattr(annotation, "__metadata__", ()))
    if get_origin(annotation) in (Union, UnionType):
        found += [part for option in get_args(annotation) for part in _metadata(option)]
    return found


def _open_key_problems(kind: AnyKind, data: Mapping[str, Any], document: Document) -> list[Diagnostic]:
    """Keys that only the kind knows: names of effects, and codes of checks."""
    problems = []
    effects = [effect.name for effect in kind.effects]
    given = data.get("effects")
    for name in given if isinstance(given, dict) else ():
        if name not in effects:
            close = difflib.get_close_matches(name, effects, 1)
            hint = f"did you mean `{close[0]}`?" if close else f"effects of a {kind.name}: {', '.join(effects)}"
            path = ("effects", name)
            problems.append(Diagnostic("SPC104", f"unknown effect `{name}`", document.key_span(path), path, hint))
    codes = [check.code for check in kind.checks]
    for key in _unknown_checks(kind, data):
        path = ("checks", key)
        if _CHECK_CODE.fullmatch(key):
            reason, hint = f"no check has the code `{key}`", f"codes of a {kind.name}: {', '.join(codes)}"
        else:
            reason = f"unknown key `{dotted(path)}`"
            hint = _did_you_mean(key, fields_at(kind.spec, ("checks",), data))
        problems.append(Diagnostic("SPC104", reason, document.key_span(path), path, hint))
    return problems


def _unknown_checks(kind: AnyKind, data: Any) -> list[str]:
    """Keys of the `checks:` block that are neither a setting nor the code of a check of this kind."""
    settings = data.get("checks")
    known = {check.code for check in kind.checks} | set(fields_at(kind.spec, ("checks",), data))
    return [key for key in settings if key not in known] if isinstance(settings, dict) else []


def _scene_name_problems(spec: MachineSpec, document: Document) -> list[Diagnostic]:
    """Scenes are told apart by their names."""
    problems, seen = [], set()
    for index, scene in enumerate(spec.all_scenes):
        if scene.label in seen:
            path = ("scenes", index)
            problems.append(
                Diagnostic(
                    "SPC113",
                    f"two scenes are called `{scene.label}`",
                    document.value_span(path),
                    path,
                    "give this one a `name:` of its own",
                )
            )
        seen.add(scene.label)
    return problems


def measure_at(spec: MachineSpec, path: KeyPath) -> Measure | None:
    """Quantity and range of the number at `path`, or None when no number with a quantity stands there."""
    *parent, key = path
    node: Any = spec.value_at(tuple(parent))
    if not isinstance(node, BaseModel):
        return None
    field = _by_key(type(node)).get(str(key))
    parts = [*field.metadata, *_metadata(field.annotation)] if field else []
    return next((part for part in parts if isinstance(part, Measure)), None)
