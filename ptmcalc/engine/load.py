"""Document -> spec: validation with every problem at its place, and assumptions filled in."""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import chain, islice
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ValidationError

from ptmcalc.base.diagnostic import Diagnostic, Severity
from ptmcalc.base.errors import UsageError
from ptmcalc.base.estimate import Interval
from ptmcalc.base.span import KeyPath, dotted
from ptmcalc.base.units import RATIO, Quantity
from ptmcalc.base.words import quote
from ptmcalc.contract.machine import EVERYWHERE, AnyKind, Use
from ptmcalc.contract.report import AssumedReport
from ptmcalc.contract.result import Finding
from ptmcalc.engine.registry import is_kind, kind_names, load_kind, load_type
from ptmcalc.spec.alias import said_as_written, with_keys
from ptmcalc.spec.fields import Measure, describe
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.spec.optional import constants_of
from ptmcalc.spec.scene import type_of
from ptmcalc.spec.shape import did_you_mean, keys_at, keys_of, meant, measure_of, unknown_key
from ptmcalc.text.document import MAX_BYTES, MAX_FAULTS, Document, Unread, parse
from ptmcalc.text.source import beginning_of

_LIKE_A_CODE = re.compile(r"[A-Za-z]{3}[0-9][0-9A-Za-z]*")


@dataclass(frozen=True, slots=True)
class Loaded:
    """A design file as far as it could be read: the kind and the filled-in spec, or the problems."""

    document: Document
    kind: AnyKind | None = None
    spec: MachineSpec | None = None
    assumed: tuple[AssumedReport, ...] = ()
    diagnostics: tuple[Diagnostic, ...] = ()
    asked: Mapping[str, Any] = field(default_factory=dict)
    """what the command line says instead of the file, by its key there"""


def load_file(path: Path, name: str, effects: Mapping[str, str] | None = None, accuracy: str = "") -> Loaded:
    """Read one design file; `effects` and `accuracy` replace what the file says of them."""
    try:
        raw = beginning_of(path, MAX_BYTES + 1)
    except OSError as error:
        reason = error.strerror or str(error)
        problem = Diagnostic("TXT101", f"the file cannot be read: {reason}", hint="check the path and its permissions")
        return Loaded(Document(name, None), diagnostics=(problem,))
    return load_text(raw, name, effects, accuracy)


def load_text(raw: bytes, name: str, effects: Mapping[str, str] | None = None, accuracy: str = "") -> Loaded:
    """Read a design file from its bytes."""
    document = parse(raw, name)
    asked = _asked(document, effects or {}, accuracy)
    document, kind, spec, problems = _read(document, asked)
    problems = _in_file_order([*document.problems, *(said_as_written(one, document) for one in problems)])
    if kind is None or spec is None or problems:
        return Loaded(document, kind, diagnostics=tuple(problems))
    spec, assumed = fill(kind, spec)
    notes = tuple(
        Diagnostic(
            finding.code,
            _with_lines(finding, document),
            document.value_span(finding.path),
            finding.path,
            finding.hint,
            Severity.WARNING,
        )
        for finding in kind.inspect(spec)
    )
    notes = tuple(said_as_written(note, document) for note in notes)
    return Loaded(document, kind, spec, assumed, notes, asked)


def keys_as_known(document: Document) -> Document:
    """A document whose keys have the names that the program knows them by."""
    return _read(document, {})[0]


def changed(loaded: Loaded, path: KeyPath, value: float) -> Loaded:
    """The machine as it is read where the file says another number (SI) at one key; without a spec where that would
    not be a valid file. What was assumed is assumed anew; a key that the file does not write is simply given."""
    kind, spec = loaded.kind, loaded.spec
    if kind is None or spec is None:
        return loaded
    if not loaded.document.holds(path):
        others = tuple(one for one in loaded.assumed if one.path != path)
        return replace(loaded, spec=spec.with_value(path, value), assumed=others)
    measure = measure_at(spec, path)
    data = with_key(loaded.document.data, path, written(value, measure.quantity) if measure else value)
    document = replace(loaded.document, data=data)
    try:
        spec, assumed = fill(kind, kind.spec.model_validate({**data, **loaded.asked}))
    except ValidationError:
        return replace(loaded, document=document, spec=None)
    return replace(loaded, document=document, spec=spec, assumed=assumed)


def with_key(node: Any, path: KeyPath, value: object) -> Any:
    """A copy of plain data with another value at a path; blocks that are not there are made."""
    if not path:
        return value
    step, rest = path[0], path[1:]
    if isinstance(node, list) and isinstance(step, int):
        return [with_key(one, rest, value) if index == step else one for index, one in enumerate(node)]
    block = node if isinstance(node, dict) else {}
    return {**block, step: with_key(block.get(step), rest, value)}


def written(value: float, quantity: Quantity) -> str | float:
    """A value as a design file writes it, to the last digit."""
    return value if quantity.dimension == RATIO.dimension else f"{value!r} {quantity.si}"


def _with_lines(finding: Finding, document: Document) -> str:
    """What a finding says; of one about two keys, with the lines they stand in."""
    if not finding.other:
        return finding.message
    lines = [document.key_span(path).line for path in (finding.path, finding.other)]
    keys = [quote(dotted(path)) for path in (finding.path, finding.other)]
    return f"{finding.message} ({keys[0]} in line {lines[0]}, {keys[1]} in line {lines[1]})"


def _asked(document: Document, effects: Mapping[str, str], accuracy: str) -> Mapping[str, Any]:
    """Keys of the file that the command line replaces."""
    own = document.data.get("effects", {}) if isinstance(document.data, dict) else {}
    asked: dict[str, Any] = {"accuracy": accuracy} if accuracy else {}
    return asked | {"effects": {**own, **effects}} if effects and isinstance(own, dict) else asked


def _read(
    document: Document, asked: Mapping[str, Any]
) -> tuple[Document, AnyKind | None, MachineSpec | None, list[Diagnostic]]:
    """The machine as the file alone describes it, with the document by its keys, and what is wrong with it."""
    if not isinstance(document.data, dict):
        return document, None, None, []
    data = {**document.data, **asked}
    kind, problems = _kind_of(document, data)
    if kind is not None and kind.types:
        kind, problems = _type_of(kind, document, data)
    if kind is None:
        return document, None, None, problems
    document = with_keys(document, kind.spec)
    assert isinstance(document.data, dict)
    data = {**document.data, **asked}
    open_problems = list(islice(_open_key_problems(kind, data, document), MAX_FAULTS + 1))
    open_keys = {found.path for found in open_problems}
    others = (_unknown_waivers(kind, data, document), _tolerance_problems(kind, data, document))
    found: Iterator[Diagnostic] = chain(open_problems, *others)
    spec = None
    try:
        spec = kind.spec.model_validate(data)
    except ValidationError as error:
        from ptmcalc.spec.problems import problems_of

        faults = problems_of(error, kind.spec, document)
        found = chain(found, (fault for fault in faults if fault.path[:2] not in open_keys))
    return document, kind, spec, list(_as_many_as_are_read(found))


def _as_many_as_are_read(found: Iterator[Diagnostic]) -> Iterator[Diagnostic]:
    """The first faults; a hint for each of fifty thousand would take longer than any check."""
    told = None
    for told in islice(found, MAX_FAULTS):
        yield told
    if told is not None and next(found, None) is not None:
        reason = f"the file has more than {MAX_FAULTS} faults in addition to those of its text"
        yield Diagnostic("TXT108", reason, told.span, hint="correct the reported ones first")


def fill(kind: AnyKind, spec: MachineSpec) -> tuple[MachineSpec, tuple[AssumedReport, ...]]:
    """The spec with every assumption in place, and the list of them."""
    assumed = []
    for path, declared, measure in constants_of(spec):
        interval = Interval(declared.low, declared.high)
        use = kind.uses.get(dotted(path), EVERYWHERE)
        assumed.append(_report(path, declared.value, measure.quantity, interval, declared.source, use))
        spec = spec.with_value(path, declared.value)
    for assumption in kind.assumptions_of(spec):
        if spec.value_at(assumption.path) is not None:
            continue
        value = assumption.value(spec)
        if value is not None:
            interval = assumption.interval(spec)
            stated = (assumption.path, value, assumption.quantity, interval, assumption.source)
            assumed.append(_report(*stated, assumption.use))
            spec = spec.with_value(assumption.path, value)
    return spec, tuple(assumed)


def _report(
    path: KeyPath, value: float, quantity: Quantity, interval: Interval, source: str, use: Use
) -> AssumedReport:
    scenes = frozenset(map(type_of, use.scenes))
    return AssumedReport(path, value, quantity, interval, source, scenes, use.loads, use.limits_only)


def _kind_of(document: Document, data: Mapping[str, Any]) -> tuple[AnyKind | None, list[Diagnostic]]:
    if "kind" not in data:
        names = kind_names()
        slip = next((key for key in data if meant(key, ("kind",))), "")
        hint = f"is {quote(slip)} meant for it? " * bool(slip) + f"add `kind: ...`; kinds: {', '.join(names)}"
        return None, [Diagnostic("SPC101", "`kind` is missing", document.value_span(()), (), hint)]
    named, place = data["kind"], document.value_span(("kind",))
    if named is Unread.VALUE:
        return None, []
    if not is_kind(named):
        names = kind_names()
        reason = f"`kind` is {describe(named)}: unknown machine kind"
        hint = did_you_mean(named if isinstance(named, str) else "", names, "kinds: ")
        return None, [Diagnostic("SPC102", reason, place, ("kind",), hint)]
    try:
        return load_type(named, data.get("type")) or load_kind(named), []
    except UsageError as error:
        return None, [Diagnostic("SPC102", error.message, place, ("kind",), error.hint)]


def _type_of(kind: AnyKind, document: Document, data: Mapping[str, Any]) -> tuple[AnyKind | None, list[Diagnostic]]:
    """The manifest of the type a file names, of a kind that has several."""
    types = {one.type: one for one in kind.types}
    named, place = data.get("type"), document.value_span(("type",))
    if named is Unread.VALUE:
        return None, []
    choice = ", ".join(f"`{name}`" for name in types)
    if "type" not in data:
        slip = next((key for key in data if meant(key, ("type",))), "")
        hint = f"is {quote(slip)} meant for it? " * bool(slip) + f"add `type: {next(iter(types))}`"
        reason = f"`type` is missing: a {kind.name} is one of {choice}"
        return None, [Diagnostic("SPC103", reason, document.key_span(("kind",)), ("type",), hint)]
    if named not in tuple(types):
        reason = f"`type` is {describe(named)}, not one of {choice}"
        hint = did_you_mean(named if isinstance(named, str) else "", types, "write one of ")
        return None, [Diagnostic("SPC112", reason, place, ("type",), hint)]
    return types[named], []


def _in_file_order(problems: Iterable[Diagnostic]) -> list[Diagnostic]:
    unique = {(p.code, p.span, p.path, p.message): p for p in problems}
    return sorted(unique.values(), key=lambda p: (p.span.line if p.span else 0, p.span.column if p.span else 0, p.code))


def _open_key_problems(kind: AnyKind, data: Mapping[str, Any], document: Document) -> Iterator[Diagnostic]:
    """Keys that only the kind knows: names of effects, and codes of checks."""
    effects = [effect.name for effect in kind.effects]
    for name in _keys(data, "effects"):
        if name not in effects:
            hint = did_you_mean(name, effects, f"effects of a {kind.label}: ")
            path = ("effects", name)
            yield Diagnostic("SPC104", f"unknown effect {quote(name)}", document.key_span(path), path, hint)
    codes, limits = [check.code for check in kind.checks], keys_at(kind.spec, ("checks",), data)
    for key in _keys(data, "checks"):
        if key not in codes and key not in limits:
            path = ("checks", key)
            if _LIKE_A_CODE.fullmatch(key):
                reason, hint = f"no check has the code {quote(key)}", f"codes of a {kind.label}: {', '.join(codes)}"
            else:
                reason = f"unknown key {quote(dotted(path))}"
                hint = unknown_key(key, limits, kind.spec, "keys here: the codes of checks, ")
            yield Diagnostic("SPC104", reason, document.key_span(path), path, hint)


def _tolerance_problems(kind: AnyKind, data: Mapping[str, Any], document: Document) -> Iterator[Diagnostic]:
    if "tolerances" in data:
        from ptmcalc.engine.spread import tolerance_problems  # for files that have them

        yield from tolerance_problems(kind.spec, data, document)


def _unknown_waivers(kind: AnyKind, data: Mapping[str, Any], document: Document) -> Iterator[Diagnostic]:
    """Waivers of checks the kind does not have."""
    codes = [check.code for check in kind.checks]
    waivers = data.get("waive")
    for index, waiver in enumerate(waivers if isinstance(waivers, list) else ()):
        code = waiver.get("check") if isinstance(waiver, dict) else None
        if isinstance(code, str) and code not in codes:
            path = ("waive", index, "check")
            reason, hint = f"no check has the code {quote(code)}", did_you_mean(code, codes, "codes: ")
            yield Diagnostic("SPC112", reason, document.value_span(path), path, hint)


def _keys(data: Mapping[str, Any], block: str) -> Iterable[str]:
    return data[block] if isinstance(data.get(block), dict) else ()


def measure_at(spec: MachineSpec, path: KeyPath) -> Measure | None:
    """Quantity and range of the number at `path`, or None when no number with a quantity stands there."""
    node = spec.value_at(path[:-1])
    field = keys_of(type(node)).get(str(path[-1])) if path and isinstance(node, BaseModel) else None
    measure = measure_of(field) if field else None
    if measure is None or measure.or_else is None:
        return measure
    return replace(measure, quantity=spec.quantity_at(path, measure), or_else=None)
