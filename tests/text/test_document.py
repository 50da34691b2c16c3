"""Text to data: every key and value at its place, and nothing guessed, constructed or lost on the way.

Lines and columns are written down as an editor shows them: from 1, in characters.
"""

import json
import math
import re
from typing import Any

import pytest
import yaml
from hypothesis import example, given, settings
from hypothesis import strategies as st

from ptmcalc.base.diagnostic import CODES, Diagnostic
from ptmcalc.base.span import KeyPath, Span
from ptmcalc.text.document import (
    MAX_BYTES,
    MAX_DEPTH,
    MAX_FAULTS,
    MAX_NODES,
    MAX_SCALAR,
    Document,
    Unread,
    parse,
    resolve,
)


def read(text: str) -> Document:
    return parse(text.encode(), "case.yaml")


def data_of(text: str) -> Any:
    document = read(text)
    assert document.problems == ()
    return document.data


def problem_of(raw: str | bytes) -> Diagnostic:
    """The one problem of a text."""
    document = parse(raw if isinstance(raw, bytes) else raw.encode(), "case.yaml")
    assert len(document.problems) == 1, document.problems
    return document.problems[0]


def places(raw: str | bytes) -> list[tuple[str, int, int]]:
    """Code, line and column of every problem of a text."""
    document = parse(raw if isinstance(raw, bytes) else raw.encode(), "case.yaml")
    return [(p.code, p.span.line, p.span.column) for p in document.problems if p.span]


# --- places ----------------------------------------------------------------------------------------------------------

MACHINE = """\
# a comment on top
kind: conveyor

belt:
  mass: 15 kg/m   # bare
  "width" :   1000 mm
idlers:
- {pitch: 1.2 m, sets: [22 kg, {mass: 30 kg}]}
-   - 1
    - [2,
       3]
text: |
  two
  lines
last: 'x'
"""


@pytest.mark.parametrize(
    ("path", "key", "value"),
    [
        ((), None, (2, 1)),
        (("kind",), (2, 1), (2, 7)),
        (("belt",), (4, 1), (5, 3)),
        (("belt", "mass"), (5, 3), (5, 9)),
        (("belt", "width"), (6, 3), (6, 15)),
        (("idlers",), (7, 1), (8, 1)),
        (("idlers", 0), None, (8, 3)),
        (("idlers", 0, "pitch"), (8, 4), (8, 11)),
        (("idlers", 0, "sets"), (8, 18), (8, 24)),
        (("idlers", 0, "sets", 0), None, (8, 25)),
        (("idlers", 0, "sets", 1), None, (8, 32)),
        (("idlers", 0, "sets", 1, "mass"), (8, 33), (8, 39)),
        (("idlers", 1), None, (9, 5)),
        (("idlers", 1, 0), None, (9, 7)),
        (("idlers", 1, 1), None, (10, 7)),
        (("idlers", 1, 1, 0), None, (10, 8)),
        (("idlers", 1, 1, 1), None, (11, 8)),
        (("text",), (12, 1), (12, 7)),
        (("last",), (15, 1), (15, 7)),
    ],
)
def test_every_key_and_value_has_its_place(path: KeyPath, key: tuple[int, int] | None, value: tuple[int, int]) -> None:
    document = read(MACHINE)
    assert document.problems == ()
    assert document.values[path] == Span(*value)
    assert document.keys.get(path) == (Span(*key) if key else None)


def test_every_node_of_the_data_has_a_place_and_no_other() -> None:
    document = read(MACHINE)
    paths = set(walk(document.data, ()))
    assert set(document.values) == paths
    assert set(document.keys) == {path for path in paths if path and isinstance(path[-1], str)}


def walk(node: Any, path: KeyPath) -> list[KeyPath]:
    inner = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    return [path, *(found for step, value in inner for found in walk(value, (*path, step)))]


@pytest.mark.parametrize(
    ("line", "key", "value"),
    [
        ("müßig: 5 kg", 1, 8),
        ("重量: 5 kg", 1, 5),
        ("{質: ü, k: 5 kg}", 8, 11),
        ("{'𝛼𝛽': 1, k: 5 kg}", 11, 14),
        ("{😀: 1, k: 5 kg}", 8, 11),
        ("{e\u0301: 1, k: 5 kg}", 9, 12),  # a combining accent is a character of its own
    ],
)
def test_columns_count_characters_not_bytes(line: str, key: int, value: int) -> None:
    document = read(f"# größer ≥ 5\n{line}\n")
    assert document.problems == ()
    *_, last = document.keys
    assert document.keys[last] == Span(2, key)
    assert document.values[last] == Span(2, value)


def test_a_byte_order_mark_takes_no_column() -> None:
    with_mark, without = parse(b"\xef\xbb\xbfkind: x\nb: 2\n", "a"), parse(b"kind: x\nb: 2\n", "a")
    assert with_mark.data == {"kind": "x", "b": 2}
    assert (with_mark.keys, with_mark.values) == (without.keys, without.values)


def test_windows_line_ends_count_once() -> None:
    document = read("a: 1\r\nb:\r\n  c: 2\r\n")
    assert document.data == {"a": 1, "b": {"c": 2}}
    assert document.keys["b", "c"] == Span(3, 3)
    assert document.values["b", "c"] == Span(3, 6)


def test_an_empty_value_stands_behind_its_colon() -> None:
    document = read("a:\nb: 1\n")
    assert document.data == {"a": None, "b": 1}
    assert document.values["a",] == Span(1, 3)


def test_an_aliased_value_stands_where_it_is_written() -> None:
    document = read("a: &x 15 kg\nb: {mass: *x}\n")
    assert document.data == {"a": "15 kg", "b": {"mass": "15 kg"}}
    assert document.keys["b", "mass"] == Span(2, 5)
    assert document.values["b", "mass"].line == 1


def test_a_merged_key_stands_where_it_is_written() -> None:
    document = read("base: &base {mass: 1, width: 2}\nbelt:\n  <<: *base\n  width: 3\n")
    assert document.keys["belt", "mass"] == Span(1, 14)
    assert document.values["belt", "mass"] == Span(1, 20)
    assert document.keys["belt", "width"] == Span(4, 3)


def test_a_key_that_is_not_written_is_looked_for_at_its_parent() -> None:
    document = read("kind: x\nbelt:\n  mass: 1\nlist: [{a: 1}]\n")
    assert document.key_span(("belt", "width")) == Span(2, 1)
    assert document.key_span(("belt", "deep", "er")) == Span(2, 1)
    assert document.value_span(("belt", "mass", "x")) == Span(3, 3)
    assert document.key_span(("list", 0, "b")) == Span(4, 8)
    assert document.value_span(("other",)) == Span(1, 1)
    assert document.holds(("belt", "mass"))
    assert not document.holds(("belt", "width"))


LEAVES = {"x": "x", "'it''s'": "it's", '"ü\\n"': "ü\n", "12": 12, "-0.5": -0.5, "~": None, "true": True, "重 5": "重 5"}
KEYS = ["a", "key", "größe", "重量", "😀", "'q k'"]
TREES = st.recursive(
    st.sampled_from(list(LEAVES)),
    lambda inner: (
        st.tuples(st.booleans(), st.lists(inner, max_size=3))
        | st.tuples(st.booleans(), st.dictionaries(st.sampled_from(KEYS), inner, max_size=3))
    ),
    max_leaves=12,
)


class Writer:
    """Writes a tree as YAML, in block or flow style, and notes the place of everything it writes."""

    def __init__(self) -> None:
        self.lines = [""]
        self.keys: dict[KeyPath, Span] = {}
        self.values: dict[KeyPath, Span] = {}

    @property
    def here(self) -> Span:
        return Span(len(self.lines), len(self.lines[-1]) + 1)

    def put(self, text: str) -> None:
        self.lines[-1] += text

    def value(self, tree: Any, path: KeyPath, indent: int, *, flow: bool) -> Any:
        """Writes behind a colon, a dash or a comma; gives back the plain data."""
        if isinstance(tree, str):
            self.values[path] = self.here
            self.put(tree)
            return LEAVES[tree]
        own_flow, children = tree
        if flow or own_flow or not children:
            return self.flow(children, path)
        if path:
            self.lines.append(" " * indent)
        return self.block(children, path, indent)

    def flow(self, children: Any, path: KeyPath) -> Any:
        self.values[path] = self.here
        self.put("{ " if isinstance(children, dict) else "[")
        data = self.children(children, path, lambda first: self.put("" if first else ", "), 0, flow=True)
        self.put(" }" if isinstance(children, dict) else "]")
        return data

    def block(self, children: Any, path: KeyPath, indent: int) -> Any:
        self.values[path] = self.here
        return self.children(
            children, path, lambda first: None if first else self.lines.append(" " * indent), indent + 2, flow=False
        )

    def children(self, children: Any, path: KeyPath, between: Any, indent: int, *, flow: bool) -> Any:
        mapping = isinstance(children, dict)
        data: Any = {} if mapping else []
        for index, step in enumerate(children):
            between(index == 0)
            if mapping:
                name = step.strip("'")
                self.keys[*path, name] = self.here
                self.put(f"{step}: ")
                data[name] = self.value(children[step], (*path, name), indent, flow=flow)
            else:
                self.put("" if flow else "- ")
                data.append(self.value(step, (*path, index), indent, flow=flow))
        return data


@settings(max_examples=300, deadline=None)
@given(children=st.dictionaries(st.sampled_from(KEYS), TREES, min_size=1, max_size=4), comment=st.booleans())
def test_places_of_any_tree_are_those_it_was_written_at(children: dict[str, Any], comment: bool) -> None:
    writer = Writer()
    if comment:
        writer.lines = ["# größer ≥ 重", "", ""]
    data = writer.value((False, children), (), 0, flow=False)
    document = read("\n".join(writer.lines) + "\n")
    assert document.problems == ()
    assert document.data == data
    assert document.keys == writer.keys
    assert document.values == writer.values


@pytest.mark.parametrize(
    "text", [MACHINE, "ü: {重: *x}\nü: !t 1\n? []\n: 1\n", "a: 1\n---\nb: 1\n", "# ü\na: x\x01\n", "ü: [1, 2}\n"]
)
def test_pyyaml_without_its_c_library_says_the_same(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    with_library = read(text)
    monkeypatch.setattr("ptmcalc.text.document._Loader", yaml.BaseLoader)
    without = read(text)
    assert without.data == with_library.data
    assert (without.keys, without.values) == (with_library.keys, with_library.values)
    assert [(p.code, p.span) for p in without.problems] == [(p.code, p.span) for p in with_library.problems]


# --- scalars ---------------------------------------------------------------------------------------------------------

SCALARS: dict[str, object] = {
    "no": "no",
    "yes": "yes",
    "on": "on",
    "off": "off",
    "y": "y",
    "true": True,
    "True": True,
    "TRUE": True,
    "false": False,
    "tRue": "tRue",
    "~": None,
    "null": None,
    "Null": None,
    "nULL": "nULL",
    "12": 12,
    "+12": 12,
    "-7": -7,
    "010": 10,
    "0o10": 8,
    "0o8": "0o8",
    "0x1F": 31,
    "-0x1F": "-0x1F",
    "0b11": "0b11",
    "1_000": "1_000",
    "12:30": "12:30",
    "1:2:3": "1:2:3",
    "2026-11-21": "2026-11-21",
    "1e3": 1000.0,
    "1E-3": 0.001,
    "1.": 1.0,
    ".5": 0.5,
    "+.5e+1": 5.0,
    "-0.25": -0.25,
    "1e": "1e",
    ".": ".",
    ".inf": math.inf,
    "+.Inf": math.inf,
    "-.INF": -math.inf,
    "inf": "inf",
    "nan": "nan",
    "1e400": math.inf,
    "9007199254740993": 9007199254740993,
    "1.2.3": "1.2.3",
    "5 kg": "5 kg",
    "3,5": "3,5",
    "=": "=",
}


@pytest.mark.parametrize("text", SCALARS)
def test_a_plain_scalar_is_read_by_yaml_1_2(text: str) -> None:
    found = data_of(f"a: {text}\n")["a"]
    assert found == SCALARS[text]
    assert type(found) is type(SCALARS[text])


@pytest.mark.parametrize("text", [".nan", ".NaN", ".NAN"])
def test_nan_is_a_float(text: str) -> None:
    assert math.isnan(data_of(f"a: {text}\n")["a"])


@pytest.mark.parametrize("text", SCALARS)
def test_a_quoted_scalar_is_text(text: str) -> None:
    assert data_of(f"a: '{text}'\nb: \"{text}\"\n") == {"a": text, "b": text}


def test_a_block_scalar_is_text() -> None:
    assert data_of("a: |\n  12\nb: >-\n  no\n") == {"a": "12\n", "b": "no"}


@pytest.mark.parametrize("key", ["12", "no", "~", "1e3", "12:30"])
def test_a_key_is_the_word_that_is_written(key: str) -> None:
    assert data_of(f"{key}: 1\n") == {key: 1}


@given(st.integers(-(10**300) + 1, 10**300 - 1))
def test_an_integer_keeps_every_digit(value: int) -> None:
    assert resolve(str(value)) == value


@given(st.floats(allow_nan=False))
def test_a_float_keeps_every_digit(value: float) -> None:
    assert float(resolve(repr(value).replace("inf", ".inf"))) == value  # type: ignore[arg-type]


def test_a_number_of_ten_thousand_digits_is_read() -> None:
    assert data_of(f"a: {'9' * MAX_SCALAR}\n") == {"a": math.inf}


@pytest.mark.parametrize("text", ["a: {}\n", "a: '{}'\n", "a: |\n  {}\n", "a: [1, {}]\n"])
@pytest.mark.parametrize("letter", ["9", "x", "重"])
def test_a_longer_value_is_refused_at_its_place(text: str, letter: str) -> None:
    (problem,) = read(text.format(letter * (MAX_SCALAR + 1))).problems
    assert (problem.code, problem.span) == ("TXT108", Span(1, 8 if "1," in text else 4))
    assert "10001 characters" in problem.message or "10002 characters" in problem.message


def test_of_very_many_faults_the_first_are_told() -> None:
    found = read("a: 1\n" * (MAX_FAULTS + 5)).problems
    assert [problem.code for problem in found] == ["TXT106"] * MAX_FAULTS + ["TXT108"]
    assert found[-1].span == Span(MAX_FAULTS + 2, 1)


# --- problems at their places ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("a: 1\nb: 2\na: 3\n", [("TXT106", 3, 1)]),
        ("a: 1\na: 2\na: 3\n", [("TXT106", 2, 1), ("TXT106", 3, 1)]),
        ("a: {b: 1, 'b': 2}\n", [("TXT106", 1, 11)]),
        ("x:\n  - b: 1\n    c: 2\n    b: 1\n", [("TXT106", 4, 5)]),
        ("größe: 1\ngröße: 2\n", [("TXT106", 2, 1)]),
    ],
)
def test_a_duplicate_key_is_an_error_at_the_later_one(text: str, found: list[tuple[str, int, int]]) -> None:
    assert places(text) == found


def test_a_duplicate_key_names_the_line_of_the_first_and_keeps_its_value() -> None:
    document = read("a: 1\nb:\n  c: 2\n  c: 3\n")
    assert "`b.c`" in document.problems[0].message
    assert "line 3" in document.problems[0].message
    assert document.data == {"a": 1, "b": {"c": 2}}


@pytest.mark.parametrize(
    ("text", "line", "column"),
    [
        ("a: !!str 5\n", 1, 4),
        ("a: ! 5\n", 1, 4),
        ("a: !mine {b: 1}\n", 1, 4),
        ("a: [1, !!int '2']\n", 1, 8),
        ("a: 1\n!!str b: 2\n", 2, 1),
        ("!!map\na: 1\n", 1, 1),
        ("a: &x !!str 5\n", 1, 4),
        ("ü: !!python/object/apply:os.system ['true']\n", 1, 4),
        ("%TAG !e! tag:example.com,2026:\n---\na: !e!x 5\n", 3, 4),
    ],
)
def test_an_explicit_tag_is_refused_at_its_place(text: str, line: int, column: int) -> None:
    assert places(text) == [("TXT107", line, column)]


def test_long_words_of_the_file_are_cut_in_messages() -> None:
    text = f"a: !{'t' * 5000} 1\nb: *{'x' * 5000}\n{'k' * 900}: 1\n{'k' * 900}: 2\n"
    assert [len(problem.message) < 200 and len(problem.hint) < 200 for problem in read(text).problems] == [True] * 3


def test_a_tag_is_named_in_the_message_and_constructs_nothing() -> None:
    document = read("a: !!python/object/apply:math.sqrt [4]\n")
    assert "math.sqrt" in document.problems[0].message
    assert document.data == {"a": [4]}


@pytest.mark.parametrize(
    ("text", "line", "column"),
    [
        ("a: 1\nb: *x\n", 2, 4),
        ("a: *x\nb: &x 1\n", 1, 4),
        ("a: &x [1, *x]\n", 1, 11),
        ("b: {<<: 5}\n", 1, 5),
        ("a: &x {k: 1}\nb:\n  <<: [*x, 5]\n", 3, 3),
    ],
)
def test_an_alias_or_merge_that_leads_nowhere_is_refused(text: str, line: int, column: int) -> None:
    assert places(text) == [("TXT110", line, column)]


@pytest.mark.parametrize(
    ("text", "line", "column"),
    [("? [a]\n: 1\n", 1, 3), ("b: {? {a: 1} : 2}\n", 1, 7), ("'': 1\n", 1, 1), ("a: &x k\n*x : 1\n", 2, 1)],
)
def test_a_key_that_is_no_word_is_refused(text: str, line: int, column: int) -> None:
    assert places(text) == [("TXT111", line, column)]


@pytest.mark.parametrize(
    ("raw", "line", "column"),
    [
        (b"\xff\xfek\x00", 1, 1),
        (b"kind: x\xff\n", 1, 8),
        (b"kind: x\nname: F\xf6rderband\n", 2, 8),
        ("größe: ü\nname: ".encode() + b"\xe4\n", 2, 7),
        ("größe: ".encode() + b"\xe4\n", 1, 8),
        (b"a: 1\r\nb: \x80\r\n", 2, 4),
        (b"a: \xed\xa0\x80\n", 1, 4),  # a surrogate, encoded
        (b"\xef\xbb\xbfkind: \xff\n", 1, 7),
    ],
)
def test_a_byte_that_is_not_utf8_is_refused_at_its_place(raw: bytes, line: int, column: int) -> None:
    assert places(raw) == [("TXT103", line, column)]


def test_the_byte_named_is_the_wrong_one_also_behind_a_byte_order_mark() -> None:
    assert "0xff" in problem_of(b"kind: \xff\n").message
    assert "0xff" in problem_of(b"\xef\xbb\xbfkind: \xff\n").message


@pytest.mark.parametrize(
    ("text", "line", "column"),
    [
        ("a: x\x01y\n", 1, 5),
        ("a: 1\nb: x\x07\n", 2, 5),
        ("a: 'ééé'\nb: x\x07\n", 2, 5),
        ("ü: x\x1b[31m\n", 1, 5),
        ("# 重量\na: \x00\n", 2, 4),
    ],
)
def test_a_control_character_is_refused_at_its_place(text: str, line: int, column: int) -> None:
    assert places(text) == [("TXT105", line, column)]
    assert f"U+{ord(text.splitlines()[line - 1][column - 1]):04X}" in problem_of(text).message


@pytest.mark.parametrize(("char", "escape"), [("\x85", "\\x85"), ("\u2028", "\\u2028"), ("\u2029", "\\u2029")])
@pytest.mark.parametrize("text", ["a: 1\nb: x{}\nc: [\n", "a: 1\nb: 'x{}'\nc: [\n", "a: 1\n# # {}\nc: [\n"])
def test_a_line_break_that_no_editor_counts_is_refused(text: str, char: str, escape: str) -> None:
    """YAML 1.1 breaks the line there, and every place below would be one line off."""
    problem = problem_of(text.format(char))
    assert (problem.code, problem.span) == ("TXT105", Span(2, text.splitlines()[1].index("{") + 1))
    assert f"`{escape}`" in problem.hint
    assert data_of(f'a: "x{escape}y"\n') == {"a": f"x{char}y"}


def test_lines_end_as_the_parser_ends_them() -> None:
    assert places("a: 1\rb: x\x01\r") == [("TXT105", 2, 5)]
    assert places("a: 1\rb: [}\r") == [("TXT105", 2, 5)]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("a: 'open\n", "close the quote"),
        ("a: [1, 2\nb: 3\n", "close the bracket"),
        ("a: {b: 1\n", "close the bracket"),
        ("a:\n  lift:18 m\n  b: 1\n", "space behind each colon"),
        (json.dumps({"a": "\U0001f600"}), "ensure_ascii=False"),
    ],
)
def test_a_syntax_error_comes_with_its_usual_cause(text: str, words: str) -> None:
    assert words in problem_of(text).hint


@pytest.mark.parametrize("text", ["a: [1\n\n", "a: [1\n# end\n", "a: {b: 1, c: [2]\n"])
def test_a_bracket_that_is_never_closed_is_blamed_itself(text: str) -> None:
    assert places(text) == [("TXT105", 1, 4)]


@pytest.mark.parametrize(
    ("text", "line", "column"),
    [
        ("a: b: c\n", 1, 5),
        ("a: 1\n b: 2\n", 2, 3),
        ("a: 1\n- b\n", 2, 1),
        ("a: [1, 2}\n", 1, 9),
        ("ü: [1, 2}\n", 1, 9),
        ("a: @x\n", 1, 4),
        ("a: 1\nb: `x`\n", 2, 4),
        ('a: "\\q"\n', 1, 5),
        ("a: 'open\nb: 2\n", 1, 4),  # the quote that is never closed, not the end of the file
        ('a: 1\nb: "open\nc: 2\n', 2, 4),
    ],
)
def test_a_syntax_error_is_reported_at_its_place(text: str, line: int, column: int) -> None:
    assert places(text) == [("TXT105", line, column)]


@pytest.mark.parametrize("text", ["[", "a: [1", "a: {b: 1", "-\n.", "a: 1\nb: 'x"])
def test_a_place_is_a_line_of_the_file(text: str) -> None:
    """Editors and code hosts refuse a remark behind the last line."""
    span = problem_of(text).span
    assert span is not None
    assert span.line <= text.count("\n") + 1


@pytest.mark.parametrize(("text", "line"), [("a:\n\tb: 1\n", 2), ("a:\n  b: 1\n\tc: 2\n", 3), ("a: 1\n\tb: 2\n", 2)])
def test_a_tab_in_the_indentation_is_reported_at_the_tab_and_called_a_tab(text: str, line: int) -> None:
    assert places(text) == [("TXT105", line, 1)]
    assert "tab" in problem_of(text).hint


@pytest.mark.parametrize(
    ("text", "code", "line"),
    [
        ("", "TXT104", 1),
        ("\ufeff", "TXT104", 1),
        (" \n\n", "TXT104", 1),
        ("# only\n# comments\n", "TXT104", 1),
        ("---\n", "TXT104", 1),
        ("---\n...\n", "TXT104", 1),
        ("~\n", "TXT104", 1),
        ("- a\n- b\n", "TXT112", 1),
        ("# c\n\n[a, b]\n", "TXT112", 3),
        ("conveyor\n", "TXT112", 1),
        ("# c\n5\n", "TXT112", 2),
        ("'kind: x'\n", "TXT112", 1),
        ("a: 1\n---\nb: 2\n", "TXT109", 2),
        ("a: 1\n...\n---\nb: 2\n", "TXT109", 3),
        ("---\na: 1\n--- {b: 2}\n", "TXT109", 3),
        ("a: 1\n---\n", "TXT109", 2),
    ],
)
def test_a_file_that_is_not_one_mapping_is_refused(text: str, code: str, line: int) -> None:
    assert places(text) == [(code, line, 1)]
    assert read(text).data is None


@pytest.mark.parametrize("text", ["---\na: 1\n", "--- {a: 1}\n", "a: 1\n...\n", "%YAML 1.2\n---\na: 1\n", "{a: 1}"])
def test_marks_around_one_document_are_allowed(text: str) -> None:
    assert data_of(text) == {"a": 1}


def test_several_problems_come_at_once() -> None:
    text = "a: !x 1\nb: 2\nc: *nowhere\nb: 3\n? [k]\n: 4\nd: {e: 1, e: 2}\n"
    assert sorted(places(text), key=lambda place: place[1]) == [
        ("TXT107", 1, 4),
        ("TXT110", 3, 4),
        ("TXT106", 4, 1),
        ("TXT111", 5, 3),
        ("TXT106", 7, 11),
    ]


def test_problems_before_a_syntax_error_are_kept() -> None:
    assert places("a: !x 1\nb: [}\n") == [("TXT107", 1, 4), ("TXT105", 2, 5)]


HOPELESS = {
    "byte": b"\xff",
    "empty": b"",
    "comment": b"# c\n",
    "list": b"[]\n",
    "syntax": b"a: [}\n",
    "control": b"a: \x01\n",
    "tag": b"a: !x 1\n",
    "duplicate": b"a: 1\na: 1\n",
    "documents": b"a: 1\n---\nb: 1\n",
    "alias": b"a: *x\n",
    "merge": b"a: {<<: 1}\n",
    "key": b"? []\n: 1\n",
    "bytes": b"#" * (MAX_BYTES + 1),
    "nodes": b"a: [" + b"1," * MAX_NODES + b"]",
    "depth": b"[" * 200,
    "bomb": b"a: &a [" + b"1," * 300 + b"]\nb: [" + b"*a," * 300 + b"]\n",
}


@pytest.mark.parametrize("fault", HOPELESS)
def test_every_problem_has_a_place_a_reason_and_a_hint(fault: str) -> None:
    problem = problem_of(HOPELESS[fault])
    assert problem.code in CODES
    assert problem.span is not None
    assert problem.message
    assert problem.hint


# --- anchors, aliases, merges ----------------------------------------------------------------------------------------


def test_anchors_and_aliases_repeat_values() -> None:
    assert data_of("a: &x [1, {b: 2}]\nc: *x\nd: {e: *x}\n") == {
        "a": [1, {"b": 2}],
        "c": [1, {"b": 2}],
        "d": {"e": [1, {"b": 2}]},
    }


def test_an_alias_means_the_anchor_last_written_before_it() -> None:
    assert data_of("a: &x 1\nb: *x\nc: &x 2\nd: *x\n") == {"a": 1, "b": 1, "c": 2, "d": 2}


@pytest.mark.parametrize(
    ("merge", "merged"),
    [
        ("<<: *x", {"k": 1, "l": 1}),
        ("<<: *x\n  k: 9", {"k": 9, "l": 1}),
        ("k: 9\n  <<: *x", {"k": 9, "l": 1}),
        ("<<: [*x, *y]", {"k": 1, "l": 1, "m": 2}),  # the earlier of two wins
        ("<<: [*y, *x]", {"k": 2, "l": 1, "m": 2}),
        ("<<: *z", {"k": 1, "l": 1, "n": 3}),  # merges of merges
        ("<<: {k: 5}", {"k": 5}),
    ],
)
def test_a_merge_fills_in_what_the_mapping_does_not_write(merge: str, merged: dict[str, int]) -> None:
    anchors = "x: &x {k: 1, l: 1}\ny: &y {k: 2, m: 2}\nz: &z {<<: *x, n: 3}\n"
    assert data_of(f"{anchors}here:\n  {merge}\n")["here"] == merged


def test_a_quoted_merge_sign_is_a_key_like_any_other() -> None:
    assert data_of("'<<': 1\n") == {"<<": 1}


def test_merging_what_pyyaml_merges_gives_the_same() -> None:
    text = "a: &a {p: 1, q: 2}\nb: &b {q: 3, r: 4}\nc: &c {<<: [*a, *b], s: 5}\nd: {r: 0, <<: *c}\n"
    assert data_of(text) == yaml.safe_load(text)


def test_a_mapping_that_is_merged_keeps_its_own_keys_before_those_it_merges() -> None:
    assert data_of("x: &x {k: 1}\ny: &y {<<: *x, k: 2}\nz: {<<: *y}\n")["z"] == {"k": 2}


# --- values that could not be read: said once, and marked ------------------------------------------------------------


@pytest.mark.parametrize("text", ["a: {b: *x}\n", "a: {b: {<<: *x, c: 1}}\n", "a: {b: {<<: 5}}\n", "a: {b: 1,5 m}\n"])
def test_a_value_that_could_not_be_read_is_marked(text: str) -> None:
    document = read(text)
    assert len(document.problems) == 1
    assert document.data == {"a": {"b": Unread.VALUE}}
    sound(document)


def test_a_document_that_merges_nothing_is_said_once() -> None:
    document = read("<<: *x\nk: 1\n")
    assert [problem.code for problem in document.problems] == ["TXT110"]
    assert document.data is None


@pytest.mark.parametrize(
    ("text", "column", "fixed"),
    [
        ("a: {b: 18,5 m}\n", 8, "`18.5 m`"),
        ("a: {b: 18,5}\n", 8, "`18.5`"),
        ("a: {b:  -18,5 m, c: 1}\n", 9, "`-18.5 m`"),
        ("a: {b: 1,200,000 N, c: 1}\n", 8, "`1200000 N`"),
        ("a: {b: 30,000 N}\n", 8, "`30000 N`"),
        ("a: {b: about 2,5 m}\n", 8, "quotes"),
    ],
)
def test_a_comma_between_braces_that_cuts_a_value_is_said_at_the_value(text: str, column: int, fixed: str) -> None:
    problem = problem_of(text)
    assert (problem.code, problem.span, problem.path) == ("SPC107", Span(1, column), ("a", "b"))
    assert fixed in problem.hint


@pytest.mark.parametrize(
    "text", ["{a: 1, 5: }", "{a: 1, 5: 2}", "{a: x,b}", "{a: '1',5}", "{a: 1,'5'}", "[1,5]", "{a: [1,5]}"]
)
def test_a_comma_between_two_values_is_none_in_a_number(text: str) -> None:
    assert "SPC107" not in [problem.code for problem in read(text).problems]


# --- budgets ---------------------------------------------------------------------------------------------------------


# A bomb that is not refused within the budget never ends: no clock is needed to notice it.


def bomb(levels: int) -> str:
    """Each level holds the one before nine times."""
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x]"]
    lines += [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 9)}]" for i in range(1, levels)]
    return "\n".join(lines) + "\n"


def test_aliases_within_the_budget_are_allowed() -> None:
    data = data_of(bomb(4))
    assert data["a3"][8][8][8][8] == "x"


def test_an_alias_bomb_is_refused_at_once() -> None:
    assert [problem.code for problem in read(bomb(40)).problems] == ["TXT108"]


def test_an_alias_bomb_is_reported_where_the_budget_ends() -> None:
    """Levels of 10, 91, 820, 7381 and 66430 nodes: the fifth is too much, the first line is innocent."""
    problem = problem_of(bomb(9))
    assert problem.span is not None
    assert problem.span.line == 5


def test_a_mapping_bomb_is_refused_at_once() -> None:
    lines = ["a0: &a0 {x: 1}"] + [f"a{i}: &a{i} {{p: *a{i - 1}, q: *a{i - 1}}}" for i in range(1, 60)]
    assert [problem.code for problem in read("\n".join(lines)).problems] == ["TXT108"]


def test_a_bomb_of_merges_is_refused_at_once() -> None:
    """Each level merges the one inside it twice: 2^n steps without a single node too many in the text."""
    inner = "{x: 1}"
    for level in range(45):
        inner = f"{{<<: [&a{level} {inner}, *a{level}]}}"
    assert [problem.code for problem in read(f"z: {inner}\n").problems] == ["TXT108"]


def test_merges_within_the_budget_are_allowed() -> None:
    lines = ["a0: &a0 {x: 1}"] + [f"a{i}: &a{i} {{<<: *a{i - 1}, k{i}: {i}}}" for i in range(1, 60)]
    assert len(data_of("\n".join(lines))["a59"]) == 60


def test_a_long_chain_of_merges_is_no_recursion_without_end() -> None:
    """The chain stands in a value that is dropped as a duplicate, so that no other budget sees it first."""
    chain = "".join(f", &a{i} {{<<: *a{i - 1}}}" for i in range(1, 2000))
    document = read(f"k: 1\nk: [&a0 {{x: 1}}{chain}]\nz: {{<<: *a1999}}\n")
    assert {problem.code for problem in document.problems} <= {"TXT106", "TXT108"}


def test_a_chain_of_aliases_is_as_deep_as_what_it_expands_to() -> None:
    lines = ["a0: &a0 [x]"] + [f"a{i}: &a{i} [*a{i - 1}]" for i in range(1, 150)]
    assert [code for code, *_ in places("\n".join(lines))] == ["TXT108"]


@pytest.mark.parametrize(("open_", "close"), [("[", "]"), ("{a: ", "}")])
def test_a_hundred_levels_are_allowed_and_one_more_is_not(open_: str, close: str) -> None:
    """The top mapping is the first level, the innermost value the last."""
    inner = MAX_DEPTH - 2
    assert read(f"a: {open_ * inner}1{close * inner}\n").problems == ()
    column = len("a: ") + len(open_) * inner + len(open_[0]) + 1  # the first thing inside the hundredth level
    assert places(f"a: {open_ * (inner + 1)}1{close * (inner + 1)}\n") == [("TXT108", 1, column)]


@pytest.mark.parametrize("open_", ["[", "{a: ", "[{a: ", "- "])
def test_a_hundred_thousand_levels_are_refused_at_once(open_: str) -> None:
    assert [problem.code for problem in read(open_ * 100_000).problems] == ["TXT108"]


def test_levels_that_the_parser_itself_refuses_have_the_same_code(monkeypatch: pytest.MonkeyPatch) -> None:
    """PyYAML from 6.0.4 refuses 1000 levels before it hands out the first event; others never do."""

    class Refusing:
        def __init__(self, text: str) -> None: ...

        def get_event(self) -> yaml.Event:
            mark = yaml.Mark("a", 3, 0, 3, None, None)
            raise yaml.scanner.ScannerError("while increasing flow level", mark, "exceeded maximum nesting depth", mark)

    monkeypatch.setattr("ptmcalc.text.document._Loader", Refusing)
    assert places("a: [[[[") == [("TXT108", 1, 4)]


def test_a_mebibyte_is_allowed_and_a_byte_more_is_not() -> None:
    end = b"\na: 1\n"
    largest = b"#" * (MAX_BYTES - len(end)) + end
    assert parse(largest, "a").data == {"a": 1}
    assert places(b"#" + largest) == [("TXT108", 1, 1)]


def test_as_many_nodes_as_the_budget_are_allowed_and_one_more_is_not() -> None:
    """The top mapping, a key, its list and the items are nodes."""
    items = "1," * (MAX_NODES - 3)
    assert read(f"a: [{items}]").problems == ()
    assert places(f"a: [{items}x]") == [("TXT108", 1, len(f"a: [{items}") + 1)]


@pytest.mark.parametrize(
    "unit", ["a: ", "? ", "- ", "'", '"', "!", "&a ", "*a ", "{", "[", "a,", "\n", " ", "x: 1\n", "#", "|\n", "é", "\\"]
)
def test_a_mebibyte_of_anything_is_read_or_refused(unit: str) -> None:
    document = read(unit * (MAX_BYTES // len(unit.encode())))
    assert document.problems or document.data is not None


# --- any text at all -------------------------------------------------------------------------------------------------

TOKENS = st.sampled_from(
    [
        *("a", "b: ", ": ", ":", " ", "  ", "\n", "\r\n", "- ", "? ", "[", "]", "{", "}", ", ", "'", '"', "#"),
        *("|\n", ">\n", "&x ", "*x", "<<: ", "!t ", "!!int ", "---\n", "...\n", "%YAML 1.2\n", "~", "1e3", "\\"),
        *("a: &x {b: 1}\n", "c: {<<: *x}\n", "\t", "é", "😀", "\ufeff", "\x00", "\x85", "\u2028"),
    ]
)


def sound(document: Document) -> None:
    """What holds for every document: problems or data, each problem with a code, a place and a reason."""
    assert document.problems or isinstance(document.data, dict)
    for problem in document.problems:
        assert problem.code in CODES
        assert problem.message
        assert problem.span is not None
        assert problem.span >= Span(1, 1)
    if document.data is not None:
        assert set(document.values) == set(walk(document.data, ()))


@settings(max_examples=400, deadline=None)
@given(st.text() | st.lists(TOKENS, max_size=25).map("".join))
@example("a: &x [*x]")
@example("{? ? a : b}")
@example("%")
def test_any_text_gives_problems_or_data(text: str) -> None:
    sound(read(text))


@settings(max_examples=300, deadline=None)
@given(st.binary(max_size=60))
def test_any_bytes_give_problems_or_data(raw: bytes) -> None:
    sound(parse(raw, "a"))


# PyYAML writes by YAML 1.1, where `1e3`, `089` and `0o7` are words without quotes: such words are not its to write.
NUMBER_1_2 = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?|0o[0-7]+")
LINE_BREAKS_1_1 = "\x85\u2028\u2029"
WORDS = st.text(st.characters(codec="utf-8", exclude_characters=LINE_BREAKS_1_1), max_size=12).filter(
    lambda word: not (NUMBER_1_2.fullmatch(word) and isinstance(yaml.safe_load(word), str))
)
PRINTABLE = st.text(st.characters(exclude_categories=["Cc", "Cs", "Cn", "Zl", "Zp"]), max_size=12)
FLOATS = st.floats(allow_nan=False, allow_infinity=False)


def mappings(words: Any, leaves: Any, size: int) -> Any:
    """Nested plain data with a mapping on top; an empty key and a merge sign are refused, and tested above."""
    keys = words.filter(lambda word: word not in ("", "<<"))
    plain = st.recursive(
        leaves | words,
        lambda inner: st.lists(inner, max_size=4) | st.dictionaries(keys, inner, max_size=4),
        max_leaves=12,
    )
    return st.dictionaries(keys, plain, max_size=size)


@settings(max_examples=200, deadline=None)
@given(
    data=mappings(WORDS, st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False), 5),
    flow=st.sampled_from([None, True, False]),
    allow_unicode=st.booleans(),
)
@example(data={"no": "no", "n": None, "t": "12:30", "z": "010", "y": "yes"}, flow=None, allow_unicode=True)
@example(data={"x\ny": "a\n b\n", "é": " ", "#": "- a", "'": '"'}, flow=False, allow_unicode=True)
def test_what_pyyaml_writes_is_read_back(data: dict[str, Any], flow: bool | None, allow_unicode: bool) -> None:
    # in one line: where PyYAML folds a line it may double a backslash, and reads its own text back differently
    text = yaml.safe_dump(data, default_flow_style=flow, allow_unicode=allow_unicode, width=math.inf)
    document = read(text)
    assert document.problems == ()
    assert document.data == data
    assert set(document.values) == set(walk(data, ()))


@settings(max_examples=100, deadline=None)
@given(data=mappings(PRINTABLE, st.none() | st.booleans() | st.integers() | FLOATS, 3))
def test_json_is_read_as_json(data: dict[str, Any]) -> None:
    document = read(json.dumps(data, ensure_ascii=False))
    assert document.problems == ()
    assert document.data == data
