"""YAML to plain data with the line and column of every key and value.

Built on the parser's events, not on a loader: nothing can construct an object, depth and size are known before any
recursion and any expansion (composing 100 000 nested lists overflows the C stack of libyaml's composer), and each
event carries its place. Scalars are resolved by the core schema of YAML 1.2, so `no`, `12:30` and `010` mean what
they say.
"""

import codecs
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from enum import Enum
from functools import lru_cache
from types import MappingProxyType
from typing import Any, TypeGuard

import yaml

from ptmcalc.base.diagnostic import Diagnostic
from ptmcalc.base.span import AliasedKey, KeyPath, Span, dotted
from ptmcalc.base.units import without_commas
from ptmcalc.base.words import quote

MAX_BYTES = 1 << 20
MAX_NODES = 50_000
MAX_DEPTH = 100
MAX_SCALAR = 10_000
"""Characters of a key or a value: reasons go into every report, and no number has as many digits."""
MAX_FAULTS = 1000
"""Faults of one form that are told of a file: who has a thousand to mend does not read the next one."""

_Loader = yaml.CBaseLoader if yaml.__with_libyaml__ else yaml.BaseLoader

_CONSTANTS: Mapping[str, bool | None] = MappingProxyType(
    {"": None, "~": None, "null": None, "Null": None, "NULL": None}
    | {"true": True, "True": True, "TRUE": True, "false": False, "False": False, "FALSE": False}
)
_INT = re.compile(r"[-+]?[0-9]{1,300}|0o[0-7]{1,100}|0x[0-9a-fA-F]{1,80}")
_FLOAT = re.compile(r"[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?")
_SPECIAL = re.compile(r"[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN)")
_LINE_BREAK = re.compile(r"\r\n?|\n")
_REFUSED = re.compile("[\0-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff\ufffe\uffff]")
"""What YAML does not allow, and its line breaks that no editor counts as such: they would shift every line below. Said
by what is refused: of what is allowed `re` would lay out a map of all characters, a fiftieth of the start of a check.
"""


class Unread(Enum):
    """Stands in the data for a value that could not be read; a problem already says why."""

    VALUE = "unread"


@dataclass(frozen=True, slots=True)
class Document:
    """A design file as data: `keys` and `values` say where each key and each value stands."""

    name: str
    data: object
    keys: Mapping[KeyPath, Span] = field(default_factory=dict)
    values: Mapping[KeyPath, Span] = field(default_factory=dict)
    problems: tuple[Diagnostic, ...] = ()
    merged: frozenset[KeyPath] = frozenset()
    """keys that `<<` brings into a mapping"""
    aliased: Mapping[KeyPath, str] = field(default_factory=dict)
    """names that the file writes for keys of `data` that have several"""

    def as_written(self, path: KeyPath) -> KeyPath:
        """A path whose keys are shown by the names that the file writes."""
        if not self.aliased:
            return path
        steps = ((path[: length + 1], step) for length, step in enumerate(path))
        return tuple(AliasedKey(str(step), self.aliased[one]) if one in self.aliased else step for one, step in steps)

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


@dataclass(slots=True)
class _Scalar:
    span: Span
    value: object
    levels: int = 1


@dataclass(slots=True)
class _Sequence:
    span: Span
    items: "list[_Node]"
    levels: int


@dataclass(slots=True)
class _Mapping:
    span: Span
    entries: "dict[str, _Entry]"
    levels: int
    merged: frozenset[str] = frozenset()


_Node = _Scalar | _Sequence | _Mapping
_Entry = tuple[Span, _Node]
"""A value with the place of its key."""


class _UnreadableError(Exception):
    """The rest of the file cannot be read; the problem says why."""

    def __init__(self, code: str, reason: str, span: Span, hint: str) -> None:
        super().__init__(reason)
        self.problem = Diagnostic(code, reason, span, hint=hint)


def parse(raw: bytes, name: str) -> Document:
    """Read one design file; what is wrong with its text comes back in `problems`, nothing is raised."""
    problems: list[Diagnostic] = []
    try:
        node = _Reader(problems).document(_decode(raw))
    except _UnreadableError as stop:
        return Document(name, None, problems=(*problems, stop.problem))
    keys: dict[KeyPath, Span] = {}
    values: dict[KeyPath, Span] = {}
    merged: set[KeyPath] = set()
    data = _flatten(node, (), keys, values, merged)
    if not isinstance(data, dict | Unread):
        form = "a list" if isinstance(data, list) else "a single value"
        reason, hint = f"the document is {form}, not a mapping", "start with `kind: conveyor`"
        problems.append(Diagnostic("TXT112", reason, node.span, hint=hint))
    own = data if isinstance(data, dict) else None
    return Document(name, own, keys, values, tuple(problems), frozenset(merged))


def _decode(raw: bytes) -> str:
    if len(raw) > MAX_BYTES:
        raise _UnreadableError("TXT108", "the file has more than 1 MiB", Span(1, 1), "split the file")
    raw = raw.removeprefix(codecs.BOM_UTF8)
    try:
        text = raw.decode()
    except UnicodeDecodeError as error:
        reason, place = f"byte 0x{raw[error.start]:02x} is not UTF-8", _end_of(raw[: error.start].decode())
        raise _UnreadableError("TXT103", reason, place, "save the file as UTF-8") from None
    if refused := _REFUSED.search(text):
        reason = f"character U+{ord(refused[0]):04X} is not allowed in a design file"
        hint = f"delete it, or write `{refused[0].encode('unicode_escape').decode()}` between double quotes"
        raise _UnreadableError("TXT105", reason, _end_of(text[: refused.start()]), hint)
    if not text.strip():
        raise _UnreadableError("TXT104", "the file is empty", Span(1, 1), "`ptmcalc new conveyor` prints a template")
    return text


def _end_of(text: str) -> Span:
    """The place behind a text."""
    lines = _LINE_BREAK.split(text)
    return Span(len(lines), len(lines[-1]) + 1)


class _Reader:
    """Composes the parser's events into nodes, within the budgets.

    An alias costs as many nodes and levels as what it stands for, so nothing that is expanded later can exceed them.
    """

    def __init__(self, problems: list[Diagnostic]) -> None:
        self.problems = problems
        self.anchors: dict[str, tuple[_Node, int]] = {}
        self.nodes = 0

    def document(self, text: str) -> _Node:
        try:
            return self._single(iter(_Loader(text).get_event, None))
        except yaml.MarkedYAMLError as error:
            raise _syntax_error(error, _LINE_BREAK.split(text)) from None

    def _single(self, events: Iterator[yaml.Event]) -> _Node:
        root: _Node | None = None
        for event in events:
            if isinstance(event, yaml.DocumentStartEvent):
                if root is not None:
                    hint = "put each machine into a file of its own"
                    raise _UnreadableError("TXT109", "a second document starts here", _span(event), hint)
                root = self._node(next(events), events, ())
        if root is None or (isinstance(root, _Scalar) and root.value is None):
            hint = "`ptmcalc new conveyor` prints a template"
            raise _UnreadableError("TXT104", "the file holds no data", Span(1, 1), hint)
        return root

    def _spend(self, nodes: int, path: KeyPath, levels: int, span: Span) -> None:
        self.nodes += nodes
        if self.nodes > MAX_NODES:
            reason, hint = f"with this the file has more than {MAX_NODES} nodes", "split the file, or use fewer aliases"
            raise _UnreadableError("TXT108", reason, span, hint)
        if len(path) + levels > MAX_DEPTH:
            raise _UnreadableError("TXT108", f"more than {MAX_DEPTH} levels are nested here", span, _NEST_LESS)

    def _say(self, code: str, reason: str, span: Span, path: KeyPath, hint: str) -> None:
        if len(self.problems) >= MAX_FAULTS:
            reason, hint = f"the file has more than {MAX_FAULTS} faults of its text", "correct those above first"
            raise _UnreadableError("TXT108", reason, span, hint)
        self.problems.append(Diagnostic(code, reason, span, path, hint))

    def _node(self, event: yaml.Event, events: Iterator[yaml.Event], path: KeyPath) -> _Node:
        span = _span(event)
        if isinstance(event, yaml.AliasEvent):
            return self._alias(event, span, path)
        assert isinstance(event, yaml.NodeEvent)
        before = self.nodes
        self._spend(1, path, 1, span)
        tag = getattr(event, "tag", None)
        if tag is not None:
            self._say("TXT107", f"the tag {quote(tag)} is refused", span, path, "delete it: a design file is data")
        node: _Node
        if isinstance(event, yaml.ScalarEvent):
            _measure(event, span)
            node = _Scalar(span, resolve(event.value) if _plain(event) else event.value)
        elif isinstance(event, yaml.SequenceStartEvent):
            node = self._sequence(span, events, path)
        else:
            node = self._mapping(span, events, path)
        if event.anchor:
            self.anchors[event.anchor] = node, self.nodes - before
        return node

    def _alias(self, event: yaml.AliasEvent, span: Span, path: KeyPath) -> _Node:
        name = str(event.anchor)
        if name not in self.anchors:
            reason, hint = f"no anchor {quote(f'&{name}')} is finished before this alias", quote(f"&{name}")
            self._say("TXT110", reason, span, path, f"write {hint} in front of the value it stands for")
            return _Scalar(span, Unread.VALUE)
        node, nodes = self.anchors[name]
        self._spend(nodes, path, node.levels, span)
        return node

    def _sequence(self, span: Span, events: Iterator[yaml.Event], path: KeyPath) -> _Sequence:
        items: list[_Node] = []
        while not isinstance(event := next(events), yaml.SequenceEndEvent):
            items.append(self._node(event, events, (*path, len(items))))
        return _Sequence(span, items, _levels(items))

    def _mapping(self, span: Span, events: Iterator[yaml.Event], path: KeyPath) -> _Node:
        entries: dict[str, _Entry] = {}
        merges: list[_Entry] = []
        cut: dict[str, str] = {}
        last: _Written | None = None
        while not isinstance(event := next(events), yaml.MappingEndEvent):
            key, where = self._key(event, events, path)
            value = next(events)
            node = self._node(value, events, (*path, key or "?"))
            if last and _goes_on(last, event, value):
                last = last[0], f"{last[1]},{key}", event
                cut[last[0]] = last[1]
                continue
            last = None
            if key == "<<" and _plain(event):
                merges.append((where, node))
            elif key in entries:
                name, first = quote(dotted((*path, key))), entries[key][0].line
                reason = f"{name} is written twice, first in line {first}"
                self._say("TXT106", reason, where, (*path, key), "delete one of them")
            elif key:
                entries[key] = where, node
                last = (key, value.value, value) if _plain(value) else None
        for key, text in cut.items():
            where, node = entries[key]
            self._say_cut(text, node.span, (*path, key))
            entries[key] = where, _Scalar(node.span, Unread.VALUE)
        own = len(entries)
        if not self._merge(merges, entries, path):
            return _Scalar(span, Unread.VALUE)
        merged = frozenset(list(entries)[own:]) if merges else frozenset()
        return _Mapping(span, entries, _levels(node for _, node in entries.values()), merged)

    def _key(self, event: yaml.Event, events: Iterator[yaml.Event], path: KeyPath) -> tuple[str, Span]:
        """A key and its place; an empty text for one that is no word."""
        key, span = "", _span(event)
        if isinstance(event, yaml.ScalarEvent):
            key = event.value
            if key and event.tag is None and event.anchor is None:
                _measure(event, span)
                self._spend(1, path, 2, span)
                return key, span
        if not key:
            self._say("TXT111", "this key is not a word", span, path, "write `key: value`")
        self._node(event, events, (*path, key or "?"))
        return key, span

    def _say_cut(self, text: str, span: Span, path: KeyPath) -> None:
        plain = without_commas(text)
        hint = f"write {plain}" if plain else "put the text in quotes"
        reason = f"{quote(dotted(path))}: between braces a comma ends a value and splits {quote(text)}"
        self._say("SPC107", reason, span, path, hint)

    def _merge(self, merges: list[_Entry], entries: dict[str, _Entry], path: KeyPath) -> bool:
        """Adds what `<<` brings and the mapping does not write itself; whether all of it could be read."""
        readable = True
        for span, node in merges:
            for source in node.items if isinstance(node, _Sequence) else [node]:
                if isinstance(source, _Mapping):
                    for key, entry in source.entries.items():
                        entries.setdefault(key, entry)
                    continue
                readable = False
                if not (isinstance(source, _Scalar) and source.value is Unread.VALUE):
                    reason = "`<<` merges a mapping or a list of mappings"
                    self._say("TXT110", reason, span, path, "write `<<: *anchor`")
        return readable


def _measure(event: yaml.ScalarEvent, span: Span) -> None:
    """Refuse a key or a value of too many letters."""
    if len(event.value) > MAX_SCALAR:
        reason = f"this has {len(event.value)} characters, more than {MAX_SCALAR}"
        raise _UnreadableError("TXT108", reason, span, "shorten it")


_Written = tuple[str, str, yaml.Event]
"""A key, the words behind it, and the event that ends them."""


def _goes_on(last: _Written, key: yaml.Event, value: yaml.Event) -> bool:
    """Whether a key is the rest of the value before it, cut by a comma between braces: `{lift: 18,5 m}`."""
    if not (_plain(value) and not value.value and _plain(key)):
        return False
    _, text, before = last
    end = _place(before.end_mark)
    return text[-1:].isdigit() and key.value[:1].isdigit() and _span(key) == Span(end.line, end.column + 1)


def _plain(event: yaml.Event) -> TypeGuard[yaml.ScalarEvent]:
    """Whether an event is a scalar without quotes."""
    return isinstance(event, yaml.ScalarEvent) and event.style in ("", None)


def _levels(nodes: Iterable[_Node]) -> int:
    return 1 + max((node.levels for node in nodes), default=0)


def _flatten(
    node: _Node, path: KeyPath, keys: dict[KeyPath, Span], values: dict[KeyPath, Span], merged: set[KeyPath]
) -> object:
    """Plain data with aliases expanded, and every place noted."""
    values[path] = node.span
    if isinstance(node, _Sequence):
        return [_flatten(item, (*path, index), keys, values, merged) for index, item in enumerate(node.items)]
    if isinstance(node, _Scalar):
        return node.value
    data = {}
    merged.update((*path, key) for key in node.merged)
    for key, (span, value) in node.entries.items():
        keys[*path, key] = span
        data[key] = _flatten(value, (*path, key), keys, values, merged)
    return data


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


def _span(event: yaml.Event) -> Span:
    start, end = event.start_mark, event.end_mark
    if start and end and end.line == start.line and isinstance(event, yaml.ScalarEvent):
        return _at(start.line + 1, start.column + 1, end.column + 1)
    return _place(start)


def _place(mark: Any) -> Span:
    return _at(mark.line + 1, mark.column + 1) if mark else _at(1, 1)


_at = lru_cache(maxsize=1 << 14)(Span)


_NEST_LESS = "nest less deeply"
_OWN_DEPTH = "nesting depth"
"""In the parser's own words for more than 1000 levels. It reads ahead of its events by up to a line, so PyYAML from
6.0.4 refuses an endless row of brackets before the 101st of them reaches the count here."""
_SYNTAX_HINTS = (
    ("end of stream", "close the quote"),
    ("document indicator", "close the quote"),
    ("document separator", "close the quote"),
    ("Unicode character escape", "write the character itself (from Python: `json.dumps(..., ensure_ascii=False)`)"),
    ("flow", "close the bracket or brace, and put commas between what is in it"),
)


def _syntax_error(error: yaml.MarkedYAMLError, lines: list[str]) -> _UnreadableError:
    """What the parser stumbled over, where the fault is.

    What is never closed is noticed at the end of the file, and a key without its colon in the next line: then the
    fault is where the quote, the bracket or the key begins.
    """
    reason = " ".join(part for part in (error.context, error.problem) if part)
    mark = error.problem_mark or error.context_mark
    if _OWN_DEPTH in reason:
        return _UnreadableError("TXT108", f"more than {MAX_DEPTH} levels are nested here", _place(mark), _NEST_LESS)
    begun = error.context in ("while scanning a quoted scalar", "while scanning a simple key")
    if mark and error.context_mark and (begun or not any(_behind(mark, lines))):
        mark = error.context_mark
    line, column = (mark.line, mark.column) if mark else (0, 0)
    if line >= len(lines):
        line, column = len(lines) - 1, len(lines[-1])
    hint = next((hint for words, hint in _SYNTAX_HINTS if words in reason), "")
    if "\t" in lines[line][: column + 1]:
        hint = "indent with spaces, not with tabs"
    hint = hint or "check the indentation and the space behind each colon"
    return _UnreadableError("TXT105", f"not YAML: {reason}", Span(line + 1, column + 1), hint)


def _behind(mark: yaml.Mark, lines: list[str]) -> Iterator[str]:
    """What the lines still hold behind a mark."""
    yield "".join(lines[mark.line : mark.line + 1])[mark.column :].strip()
    yield from (line.strip() for line in lines[mark.line + 1 :])
