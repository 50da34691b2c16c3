"""YAML to plain data with the line and column of every key and value.

Built on the parser's events, not on a loader: nothing can construct an object, the depth is known before any
recursion (composing 100 000 nested lists overflows the C stack of libyaml's composer), and each event carries
its place. Scalars are resolved by the core schema of YAML 1.2, so `no`, `12:30` and `010` mean what they say.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import yaml

from ptmcalc.base.diagnostic import Diagnostic
from ptmcalc.base.span import KeyPath, Span, dotted

MAX_BYTES = 1 << 20
MAX_NODES = 50_000
MAX_DEPTH = 100

_Loader = yaml.CBaseLoader if yaml.__with_libyaml__ else yaml.BaseLoader

_CONSTANTS: Mapping[str, bool | None] = MappingProxyType(
    {"": None, "~": None, "null": None, "Null": None, "NULL": None}
    | {"true": True, "True": True, "TRUE": True, "false": False, "False": False, "FALSE": False}
)
_INT = re.compile(r"[-+]?[0-9]{1,300}|0o[0-7]{1,100}|0x[0-9a-fA-F]{1,80}")
_FLOAT = re.compile(r"[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?")
_SPECIAL = re.compile(r"[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN)")


@dataclass(frozen=True, slots=True)
class Document:
    """A design file as data: `keys` and `values` say where each key and each value stands."""

    name: str
    data: object
    keys: Mapping[KeyPath, Span] = field(default_factory=dict)
    values: Mapping[KeyPath, Span] = field(default_factory=dict)
    problems: tuple[Diagnostic, ...] = ()

    def value_span(self, path: KeyPath) -> Span:
        """Where the value of `path` stands; for one the file does not write, the key of its parent."""
        return self._nearest(path, self.values, self.keys)

    def key_span(self, path: KeyPath) -> Span:
        """Where the key of `path` stands; for one the file does not write, the key of its parent."""
        return self._nearest(path, self.keys, self.values)

    def holds(self, path: KeyPath) -> bool:
        """Whether the file writes this key itself."""
        return path in self.values

    def _nearest(self, path: KeyPath, first: Mapping[KeyPath, Span], second: Mapping[KeyPath, Span]) -> Span:
        if span := first.get(path) or second.get(path):
            return span
        for length in range(len(path) - 1, 0, -1):
            if span := self.keys.get(path[:length]) or self.values.get(path[:length]):
                return span
        return Span(1, 1)


@dataclass(frozen=True, slots=True)
class _Scalar:
    span: Span
    value: object


@dataclass(frozen=True, slots=True)
class _Sequence:
    span: Span
    items: "list[_Node]"


@dataclass(frozen=True, slots=True)
class _Mapping:
    span: Span
    entries: "list[_Entry]"


_Node = _Scalar | _Sequence | _Mapping
_Entry = tuple[str, Span, _Node]


class _UnreadableError(Exception):
    """The rest of the file cannot be read; the problem says why."""

    def __init__(self, problem: Diagnostic) -> None:
        super().__init__(problem.message)
        self.problem = problem


def parse(raw: bytes, name: str) -> Document:
    """Read one design file; what is wrong with its text comes back in `problems`, nothing is raised."""
    problems: list[Diagnostic] = []
    reader = _Reader(problems)
    try:
        node = reader.document(_decode(raw))
        flat = _Flattener(problems)
        data = flat.flatten(node, (), None)
    except _UnreadableError as stop:
        return Document(name, None, problems=(*problems, stop.problem))
    if not isinstance(data, dict):
        form = "a list" if isinstance(data, list) else "a single value"
        problems.append(
            Diagnostic(
                "TXT112",
                f"the document is {form}, not a mapping",
                node.span,
                hint="start with `kind: conveyor`",
            )
        )
        data = None
    return Document(name, data, flat.keys, flat.values, tuple(problems))


def _decode(raw: bytes) -> str:
    if len(raw) > MAX_BYTES:
        raise _UnreadableError(Diagnostic("TXT108", f"the file has {len(raw)} bytes, more than 1 MiB", Span(1, 1)))
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        before = raw[: error.start].decode("utf-8", "replace")
        line = before.count("\n") + 1
        column = len(before) - (before.rfind("\n") + 1) + 1
        raise _UnreadableError(
            Diagnostic(
                "TXT103",
                f"byte 0x{raw[error.start]:02x} is not UTF-8",
                Span(line, column),
                hint="save the file as UTF-8",
            )
        ) from None
    if not text.strip():
        raise _UnreadableError(
            Diagnostic("TXT104", "the file is empty", Span(1, 1), hint="`ptmcalc new conveyor` prints a template")
        )
    return text


class _Reader:
    """Composes the parser's events into nodes, within the budgets."""

    def __init__(self, problems: list[Diagnostic]) -> None:
        self.problems = problems
        self.anchors: dict[str, _Node] = {}
        self.nodes = 0

    def document(self, text: str) -> _Node:
        try:
            return self._single(iter(yaml.parse(text, Loader=_Loader)))
        except yaml.reader.ReaderError as error:
            before = text[: error.position]
            place = Span(before.count("\n") + 1, len(before) - (before.rfind("\n") + 1) + 1)
            raise _UnreadableError(
                Diagnostic("TXT105", f"character U+{_code_point(error):04X} is not allowed in YAML", place)
            ) from None
        except yaml.MarkedYAMLError as error:
            raise _UnreadableError(_syntax_problem(error, text)) from None

    def _single(self, events: Iterator[yaml.Event]) -> _Node:
        root: _Node | None = None
        for event in events:
            if isinstance(event, yaml.DocumentStartEvent):
                if root is not None:
                    raise _UnreadableError(
                        Diagnostic(
                            "TXT109",
                            "a second document starts here",
                            _span(event),
                            hint="put each machine into a file of its own",
                        )
                    )
                root = self._node(next(events), events, 1)
        if root is None or (isinstance(root, _Scalar) and root.value is None):
            raise _UnreadableError(
                Diagnostic(
                    "TXT104",
                    "the file holds no data",
                    Span(1, 1),
                    hint="`ptmcalc new conveyor` prints a template",
                )
            )
        return root

    def _node(self, event: yaml.Event, events: Iterator[yaml.Event], depth: int) -> _Node:
        span = _span(event)
        self.nodes += 1
        if self.nodes > MAX_NODES:
            raise _UnreadableError(Diagnostic("TXT108", f"the file has more than {MAX_NODES} nodes", span))
        if depth > MAX_DEPTH:
            raise _UnreadableError(Diagnostic("TXT108", f"more than {MAX_DEPTH} levels are nested here", span))
        if isinstance(event, yaml.AliasEvent):
            return self._alias(event, span)
        assert isinstance(event, yaml.NodeEvent)
        tag = getattr(event, "tag", None)
        if tag is not None:
            self.problems.append(
                Diagnostic(
                    "TXT107",
                    f"the tag `{tag}` is refused",
                    span,
                    hint="delete it: a design file is data",
                )
            )
        node: _Node
        if isinstance(event, yaml.ScalarEvent):
            plain = event.style in ("", None)
            node = _Scalar(span, resolve(event.value) if plain else event.value)
        elif isinstance(event, yaml.SequenceStartEvent):
            node = _Sequence(span, self._items(events, depth))
        else:
            node = _Mapping(span, self._entries(events, depth))
        if event.anchor:
            self.anchors[event.anchor] = node
        return node

    def _alias(self, event: yaml.AliasEvent, span: Span) -> _Node:
        known = self.anchors.get(event.anchor or "")
        if known is None:
            self.problems.append(
                Diagnostic(
                    "TXT110",
                    f"no anchor `&{event.anchor}` is finished before this alias",
                    span,
                    hint=f"write `&{event.anchor}` in front of the value it stands for",
                )
            )
            return _Scalar(span, None)
        return known

    def _items(self, events: Iterator[yaml.Event], depth: int) -> list[_Node]:
        items = []
        while not isinstance(event := next(events), yaml.SequenceEndEvent):
            items.append(self._node(event, events, depth + 1))
        return items

    def _entries(self, events: Iterator[yaml.Event], depth: int) -> list[_Entry]:
        entries: list[_Entry] = []
        while not isinstance(event := next(events), yaml.MappingEndEvent):
            key = event.value if isinstance(event, yaml.ScalarEvent) else None
            span = _span(event)
            if key is None or not key:
                self.problems.append(Diagnostic("TXT111", "this key is not a word", span, hint="write `key: value`"))
            self._node(event, events, depth + 1)
            node = self._node(next(events), events, depth + 1)
            if key:
                entries.append((key, span, node))
        return entries


class _Flattener:
    """Turns nodes into plain data, expanding aliases and merges, and notes every place."""

    def __init__(self, problems: list[Diagnostic]) -> None:
        self.problems = problems
        self.keys: dict[KeyPath, Span] = {}
        self.values: dict[KeyPath, Span] = {}
        self.nodes = 0

    def flatten(self, node: _Node, path: KeyPath, key: Span | None) -> object:
        self.nodes += 1
        if self.nodes > MAX_NODES or len(path) > MAX_DEPTH:
            raise _UnreadableError(
                Diagnostic(
                    "TXT108",
                    f"with its aliases expanded the file has more than {MAX_NODES} nodes or {MAX_DEPTH} levels",
                    key or node.span,
                    hint="remove the nested aliases",
                )
            )
        self.values[path] = node.span
        if key is not None:
            self.keys[path] = key
        if isinstance(node, _Sequence):
            return [self.flatten(item, (*path, index), None) for index, item in enumerate(node.items)]
        if isinstance(node, _Mapping):
            return self._mapping(node.entries, path)
        return node.value

    def _mapping(self, entries: list[_Entry], path: KeyPath) -> dict[str, object]:
        chosen: dict[str, tuple[Span, _Node]] = {}
        merged: dict[str, tuple[Span, _Node]] = {}
        for key, span, node in entries:
            if key == "<<":
                for name, where, value in self._merge(span, node):
                    merged.setdefault(name, (where, value))
            elif key in chosen:
                first = chosen[key][0]
                self.problems.append(
                    Diagnostic(
                        "TXT106",
                        f"`{dotted((*path, key))}` is written twice, first in line {first.line}",
                        span,
                        (*path, key),
                        hint="delete one of them",
                    )
                )
            else:
                chosen[key] = (span, node)
        return {
            key: self.flatten(node, (*path, key), span)
            for key, (span, node) in (chosen | {k: v for k, v in merged.items() if k not in chosen}).items()
        }

    def _merge(self, span: Span, node: _Node) -> Iterator[_Entry]:
        for source in node.items if isinstance(node, _Sequence) else [node]:
            self.nodes += 1
            if not isinstance(source, _Mapping):
                self.problems.append(
                    Diagnostic("TXT110", "`<<` merges a mapping or a list of mappings", span, hint="`<<: *anchor`")
                )
                continue
            for key, where, value in source.entries:
                if key == "<<":
                    yield from self._merge(where, value)
                else:
                    yield key, where, value


def resolve(text: str) -> object:
    """A plain scalar by the YAML 1.2 core schema: null, bool, int, float or text."""
    if text in _CONSTANTS:
        return _CONSTANTS[text]
    if _INT.fullmatch(text):
        return int(text, 0) if text[:2] in ("0o", "0x") else int(text)
    if _FLOAT.fullmatch(text):
        return float(text)
    if _SPECIAL.fullmatch(text):
        return float(text.replace(".", ""))
    return text


def _code_point(error: yaml.reader.ReaderError) -> int:
    return error.character if isinstance(error.character, int) else ord(error.character)


def _span(event: yaml.Event) -> Span:
    mark = event.start_mark
    return Span(mark.line + 1, mark.column + 1) if mark else Span(1, 1)


def _syntax_problem(error: yaml.MarkedYAMLError, text: str) -> Diagnostic:
    mark = error.problem_mark or error.context_mark
    span = Span(mark.line + 1, mark.column + 1) if mark else Span(1, 1)
    reason = " ".join(part for part in (error.context, error.problem) if part)
    lines = text.splitlines()
    line = lines[span.line - 1] if span.line <= len(lines) else ""
    hint = "check the indentation and the space behind each colon"
    if line[: span.column].count("\t"):
        hint = "indent with spaces, not with tabs"
    return Diagnostic("TXT105", f"not YAML: {reason}", span, hint=hint)
