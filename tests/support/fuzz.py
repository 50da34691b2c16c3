"""Hostile design files: made from sound ones and from nothing, and what must be said about whatever comes out.

Every input has a number from which alone it is made, so a finding is made again by its number.
"""

import copy
import json
import random
import re
import signal
import string
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from types import FrameType, UnionType
from typing import Any, Union, get_args, get_origin

import yaml

from ptmcalc.base.diagnostic import BROKEN, Severity, Verdict
from ptmcalc.base.units import UNITS
from ptmcalc.contract.report import FileReport, exit_status
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.files import design_files
from ptmcalc.engine.load import load_text
from ptmcalc.engine.registry import kind_names, load_kind
from ptmcalc.report import Format, render
from ptmcalc.report.json import part_of
from ptmcalc.spec.shape import inner, keys_of, models_of, words_of
from ptmcalc.text.document import parse
from support.command import ROOT

HUNG = 20.0
"""Seconds of this process after which an input counts as hung: it ends the test, no assertion looks at it. Absurd sizes
may cost some seconds (a column that rings a thousand times before its base rests, at both ends of each assumption)."""
BUDGET = 2e-4
"""Predicted seconds that a scene may take: what decides by closed forms does, and the first rung of the others."""
LINE = re.compile(rf"fuzz\.yaml:([1-9][0-9]*):([1-9][0-9]*): ({'|'.join((*Severity, *Verdict))}) .+")
TABLE = re.compile(r"fuzz\.yaml: .+")
"""A line of a kind's own table, which is about the whole file."""


class HungError(Exception):
    """An input that takes far longer than the largest sound one."""


@contextmanager
def watched(seconds: float) -> Iterator[None]:
    """Ends what does not end by itself."""

    def stop(number: int, frame: FrameType | None) -> None:
        raise HungError

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


# -- what must hold -------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Said:
    """What is said about an input: the status, whether it was a machine at all, and its codes."""

    status: int
    valid: bool
    codes: tuple[str, ...]


def said(raw: bytes, turn: int = 0, budget: float = BUDGET) -> Said:
    """Read an input, plan and run one scene of it where it is a machine, and hold what comes back to what must hold."""
    with watched(HUNG), warnings.catch_warnings():
        warnings.simplefilter("ignore")  # as in a process of its own, where they do not become errors
        loaded = load_text(raw, "fuzz.yaml")
        if loaded.spec is None or str(loaded.document.data) in _unchanged():
            report = FileReport("fuzz.yaml", diagnostics=loaded.diagnostics)
        else:
            scenes = [scene.label for scene in loaded.spec.all_scenes]
            chosen = (scenes[turn % len(scenes)],)
            report = check(loaded, Options(chosen, budget=budget, repairs=False))
            for scene in report.scenes:
                deciding = [one.predicted_seconds for one in scene.solvers if one.decides]
                assert sum(deciding) <= budget, "the budget of predicted work holds"
        printed = render(Format.PLAIN, [report])
        document = json.loads("{" + part_of(report), parse_constant=_no_number)
    status = exit_status((report,))
    codes = tuple(d.code for d in report.diagnostics)
    assert BROKEN not in codes
    assert status in (0, 1, 2, 3)
    assert (status == 2) == (loaded.spec is None) == (document["verdict"] == "invalid")
    if loaded.spec is None:
        assert any(d.severity is Severity.ERROR for d in report.diagnostics), "what is refused is told why"
    ends = line_ends(raw)
    *lines, _ = printed.split("\n")[:-1]
    for line in lines:
        match = LINE.fullmatch(line)
        assert match or (loaded.spec is not None and TABLE.fullmatch(line)), line
        assert line.isprintable(), line
        if match:
            row, column = int(match[1]), int(match[2])
            assert row <= len(ends), line
            assert column <= ends[row - 1] + 1, line
    return Said(status, loaded.spec is not None, codes)


def _no_number(text: str) -> float:
    raise AssertionError(f"{text} is no JSON")


def line_ends(raw: bytes) -> list[int]:
    """The number of characters of each line, as an editor counts."""
    text = raw.removeprefix(b"\xef\xbb\xbf").decode("utf-8", "replace")
    return [len(line) for line in re.split(r"\r\n?|\n", text)]


# -- sound files as trees -------------------------------------------------------------------------------------------


class Word(str):
    """A scalar that is written as it stands."""


Entry = tuple[str, Any]
"""A key and what stands behind it; in a list of a mapping's entries a key may stand twice."""


class Entries(list[Entry]):
    """A mapping in which a key may stand twice."""


@cache
def sound() -> tuple[tuple[str, bytes], ...]:
    """Names and texts of the files that come with the project, and of the templates of all kinds."""
    texts = [(path.relative_to(ROOT).as_posix(), path.read_bytes()) for path in design_files(ROOT / "specs")]
    for name in kind_names():
        texts += [(f"template of {one.label}", one.template.encode()) for one in load_kind(name).manifests]
    return tuple(texts)


@cache
def _unchanged() -> frozenset[str]:
    """What the sound files say: of a comment or a line end that is another one, no more need be seen."""
    return frozenset(str(parse(raw, name).data) for name, raw in sound())


@cache
def trees() -> tuple[Entries, ...]:
    """The sound files as trees."""
    return tuple(_tree(yaml.load(raw, yaml.BaseLoader)) for _, raw in sound())


def _tree(node: Any) -> Any:
    if isinstance(node, dict):
        return Entries((key, _tree(value)) for key, value in node.items())
    if isinstance(node, list):
        return [_tree(value) for value in node]
    return node


def _copied(node: Any) -> Any:
    if isinstance(node, Entries):
        return Entries((key, _copied(value)) for key, value in node)
    return [_copied(value) for value in node] if isinstance(node, list) else node


def written(tree: Any) -> bytes:
    """A tree as a file."""
    lines: list[str] = []
    _write(tree, 0, "", lines)
    return ("\n".join(lines) + "\n").encode("utf-8", "surrogatepass")


def _write(node: Any, indent: int, before: str, lines: list[str]) -> None:
    space = " " * indent
    if isinstance(node, Entries) and node:
        if before:
            lines.append(before)
        for key, value in node:
            _write(value, indent + 2, f"{space}{_scalar(key)}:", lines)
    elif isinstance(node, list) and node:
        if before:
            lines.append(before)
        for value in node:
            if isinstance(value, Entries | list) and value:
                lines.append(f"{space}-")
                _write(value, indent + 2, "", lines)
            else:
                lines.append(f"{space}- {_leaf(value)}")
    else:
        lines.append(f"{before} {_leaf(node)}" if before else space + _leaf(node))


_PLAIN = re.compile(r"[\w°%./+*^()][\w°%./+*^() -]*(?<! )")


def _scalar(text: str) -> str:
    if isinstance(text, Word) or _PLAIN.fullmatch(text):
        return text
    return json.dumps(text)


def _leaf(node: Any) -> str:
    if isinstance(node, Entries | list):
        return "{}" if isinstance(node, Entries) else "[]"
    return _scalar(node) if isinstance(node, str) else json.dumps(node)


# -- changes of a tree ----------------------------------------------------------------------------------------------

Place = tuple[Any, int]
"""A list, or the entries of a mapping, and an index."""
Change = Callable[[random.Random, Entries], None]


def _places(node: Any) -> Iterator[Place]:
    if isinstance(node, Entries | list):
        for index, item in enumerate(node):
            yield node, index
            yield from _places(item[1] if isinstance(node, Entries) else item)


def _get(place: Place) -> Any:
    node, index = place
    return node[index][1] if isinstance(node, Entries) else node[index]


def _put(place: Place, value: Any) -> None:
    node, index = place
    node[index] = (node[index][0], value) if isinstance(node, Entries) else value


def _any(rng: random.Random, tree: Entries) -> Place | None:
    places = list(_places(tree))
    return rng.choice(places) if places else None


_NUMBER = re.compile(r"\s*([-+]?[0-9]*\.?[0-9]+(?:[eE][-+]?[0-9]+)?)(.*)", re.DOTALL)


def _number(rng: random.Random, tree: Entries) -> tuple[Place, str, str] | None:
    found = [(p, m) for p in _places(tree) if isinstance(v := _get(p), str) and (m := _NUMBER.fullmatch(v))]
    if not found:
        return None
    place, match = rng.choice(found)
    return place, match[1], match[2]


def scaled(rng: random.Random, tree: Entries) -> None:
    """A value over decades."""
    if found := _number(rng, tree):
        place, number, unit = found
        reach = rng.choice((0.3, 1.0, 1.0, 3.0, 3.0, 16.0, 400.0))
        power = rng.uniform(-reach, reach)
        value = float(number) * 10.0 ** max(min(power, 300), -320)
        _put(place, f"{value:.6g}{unit}".replace("inf", "1e999"))


ODD_NUMBERS = (
    *("0", "-0.0", "nan", ".nan", "inf", "-.inf", "1e400", "-1e400", "1e-400", "9" * 400, "0x10", "0o7", "1_000", "1e"),
    *("1,5", "1.000,5", "1 000", "٣", "１２", "½", "+", "-", ".", "1..2", "--1", "1e+", "1/2", "5e-324", "1.8e308"),
    *("", " ", "null", "true", "~", "=1+1", "1e15", "1e-12", "1.0000001e15", "-1", "0.1", "3", "2147483648", "1e308"),
)
ODD_UNITS = (
    *("", " ", "m m", "kg**2", "m^99", "m^-9", "m^9*s^9*kg^9", "/s", "m/", "m/s/s", "N·m", "m²", "M", "µm", "Ω", "K"),
    *(
        "mm^1000000",
        "*",
        "kg*",
        "rpm*rpm",
        "%",
        "%%",
        "°",
        "°C",
        "ft",
        "ton",
        "m" * 500,
        "m\u200b",
        "\u212b",
        "1",
        "11",
    ),
)


def odd_number(rng: random.Random, tree: Entries) -> None:
    """A number that is none, or none that a machine has."""
    if found := _number(rng, tree):
        place, _, unit = found
        _put(place, rng.choice((str, Word))(rng.choice(ODD_NUMBERS) + unit))


def other_unit(rng: random.Random, tree: Entries) -> None:
    """A value in another unit, or in none."""
    if found := _number(rng, tree):
        place, number, _ = found
        _put(place, f"{number} {rng.choice((*UNITS, *ODD_UNITS))}")


def other_type(rng: random.Random, tree: Entries) -> None:
    """A value of another form."""
    if place := _any(rng, tree):
        value = _get(place)
        forms = (None, True, False, 0, -1, 10**400, 1.5, "", "x", [], [value], [value] * 3, Entries(), Word(".nan"))
        nested: Any = value
        for _ in range(rng.choice((1, 5, 30, 200))):
            nested = [nested] if rng.random() < 0.5 else Entries([("x", nested)])
        forms = (*forms, Entries([("type", value)]), nested, Word("2026-11-23"), Word("[1, 2"), Word("'x"), Word("*x"))
        _put(place, rng.choice(forms))


def deleted(rng: random.Random, tree: Entries) -> None:
    """A key or an item less."""
    if place := _any(rng, tree):
        del place[0][place[1]]


def doubled(rng: random.Random, tree: Entries) -> None:
    """A key or an item again, or many times."""
    if place := _any(rng, tree):
        node, index = place
        times = rng.choice((1, 1, 2, 10, 300)) if isinstance(_get(place), str) else rng.choice((1, 1, 2, 10))
        node[index:index] = [_copied_item(node[index]) for _ in range(times)]


def _copied_item(item: Any) -> Any:
    return (item[0], _copied(item[1])) if isinstance(item, tuple) else _copied(item)


def moved(rng: random.Random, tree: Entries) -> None:
    """A value elsewhere, of this machine or of another."""
    one = _any(rng, tree)
    other = _any(rng, rng.choice(trees()) if rng.random() < 0.5 else tree)
    if one and other:
        value = _copied(_get(other))
        if isinstance(one[0], Entries) and isinstance(other[0], Entries) and rng.random() < 0.5:
            one[0].insert(one[1], (other[0][other[1]][0], value))
        else:
            _put(one, value)


ODD_KEYS = (
    *("", " ", "<<", "=", "~", "null", "true", "1", "-1", "0.5", "a" * 5000, "ключ", "重", "\x1b[31m", "a\nb", "a.b"),
    *(
        "[0]",
        "__class__",
        "__init__",
        "model_config",
        "type",
        "kind",
        "name",
        "=cmd",
        "x: y",
        "#",
        "&a",
        "*a",
        "!x",
        "%",
    ),
    *("\u202e", "\u00e9", "e\u0301", "{x}", "{0}", "%s", "${x}", "../x", "CNV101", "self", "cls", "schema", "copy"),
)


def renamed(rng: random.Random, tree: Entries) -> None:
    """A key by another name."""
    places = [place for place in _places(tree) if isinstance(place[0], Entries)]
    if places:
        node, index = rng.choice(places)
        key, value = node[index]
        cut = rng.randrange(len(key) + 1)
        slips = (key[:cut] + key[cut + 1 :], key[:cut] + rng.choice(string.ascii_lowercase) + key[cut:], key.upper())
        node[index] = (rng.choice((*slips, *slips, rng.choice(ODD_KEYS))), value)


@cache
def _words() -> tuple[tuple[str, ...], tuple[str, ...], tuple[str, ...]]:
    kinds = [one for name in kind_names() for one in load_kind(name).manifests]
    scenes = {s.model_fields["type"].default for kind in kinds for check in kind.checks for s in check.scenes}
    codes = {check.code for kind in kinds for check in kind.checks}
    return tuple(sorted(scenes)), tuple(sorted(codes)), tuple(sorted({e.name for k in kinds for e in k.effects}))


def added(rng: random.Random, tree: Entries) -> None:
    """What any file may say besides its machine: scenes, checks off, waivers, effects, an accuracy."""
    scenes, codes, effects = _words()
    code = rng.choice((*codes, "CNV999", "x", "\x1b[0m", "", "TXT101"))
    until = rng.choice(("2027-06-30", "2020-01-01", "2026-02-30", "9999-12-31", "0000-00-00", "tomorrow", ""))
    waiver = Entries([("check", code), ("reason", rng.choice(("because", "", "a\nb", "::error::x"))), ("until", until)])
    found: Entry = rng.choice(
        (
            ("scenes", [Entries([("type", rng.choice(scenes))]) for _ in range(rng.choice((1, 2, 5)))]),
            ("scenes", [Entries([("type", rng.choice(scenes)), ("name", rng.choice(ODD_KEYS))])]),
            ("checks", Entries([(code, Entries([("off", rng.choice(("why", "", "\x00")))]))])),
            ("waive", [waiver] * rng.choice((1, 2))),
            ("effects", Entries([(rng.choice((*effects, "x")), rng.choice(("on", "off", "auto", "maybe", "")))])),
            ("accuracy", rng.choice(("1 %", "0.1", "0", "1e-9", "2", "-1", "nan", "1 m"))),
            ("gravity", rng.choice(("9.81 m/s^2", "0 m/s^2", "1e-9 m/s^2", "1e9 m/s^2", "9.81"))),
            ("tolerances", Entries([(rng.choice(("speed", "load.mass", "..", "")), rng.choice(("1 %", "x", "")))])),
            ("name", rng.choice(("=cmd|' /C calc'!A0", "\x1b[2J", "a\r\n::error::b", "[red]x[/red]", "x" * 300))),
            ("type", rng.choice(("slewing", "travelling", "rack_stacker", "", "x"))),
            ("kind", rng.choice((*kind_names(), "", "os", "__init__", "../conveyor", "Conveyor"))),
        )
    )
    where = [index for index, (key, _) in enumerate(tree) if key == found[0]]
    if where and rng.random() < 0.9:
        tree[where[0]] = found
    else:
        tree.insert(rng.randrange(len(tree) + 1), found)


def swapped(rng: random.Random, tree: Entries) -> None:
    """Two values in each other's place."""
    one, other = _any(rng, tree), _any(rng, tree)
    if one and other and isinstance(_get(one), str) and isinstance(_get(other), str):
        first, second = _get(one), _get(other)
        _put(one, second)
        _put(other, first)


CHANGES: tuple[Change, ...] = (
    *(scaled, scaled, scaled, scaled, scaled, odd_number, odd_number, other_unit, other_type, other_type),
    *(deleted, doubled, moved, renamed, added, added, swapped),
)


def from_tree(number: int) -> bytes:
    """A sound file with a few of its parts changed."""
    rng = random.Random(f"tree {number}")
    tree = _copied(rng.choice(trees()))
    for _ in range(rng.choice((1, 1, 1, 2, 3, 6))):
        if tree:
            rng.choice(CHANGES)(rng, tree)
    return written(tree)


# -- changes of bytes -----------------------------------------------------------------------------------------------

TOKENS = (
    *(
        b"\t",
        b"\x00",
        b"\xef\xbb\xbf",
        b"\r",
        b"\r\n",
        b"\n",
        b"\xe2\x80\xa8",
        b"\xc2\x85",
        b"\xff\xfe",
        b"\xc3",
        b"\x1b[",
    ),
    *(
        b"&a ",
        b"*a",
        b"!!python/object:x ",
        b"! ",
        b"!<x> ",
        b"? ",
        b": ",
        b"- ",
        b"-",
        b"# ",
        b"|\n",
        b">-\n",
        b"%YAML 9.9\n",
    ),
    *(
        b"---\n",
        b"...\n",
        b"{",
        b"}",
        b"[",
        b"]",
        b",",
        b"'",
        b'"',
        b"`",
        b"@",
        b"<<: *a",
        b"<<: [*a, *b]",
        b"\\",
        b'"\\x',
    ),
    *(b"\xf0\x9f\x98\x80", b"1e999", b".nan", b"kind: ", b"  ", b"    ", b"\xed\xa0\x80", b"\xf4\x90\x80\x80", b"\x7f"),
    *(b'"\\ud800"', b'"\\0"', b"{a: &a [*a]}", b"[" * 120, b"{x: " * 60, b"- " * 110, b"a" * 70_000, b"? " * 110),
)


def from_bytes(number: int) -> bytes:
    """A sound file with a few of its bytes changed."""
    rng = random.Random(f"bytes {number}")
    raw = bytearray(rng.choice(sound())[1])
    for _ in range(rng.choice((1, 1, 1, 2, 3, 8))):
        at = rng.randrange(len(raw) + 1)
        match rng.randrange(9):
            case 0 if raw:
                raw[at - 1] ^= 1 << rng.randrange(8)
            case 1:
                raw.insert(at, rng.randrange(256))
            case 2:
                del raw[at : at + rng.choice((1, 1, 3, 20, 400))]
            case 3:
                raw[at:at] = raw[at : at + rng.choice((1, 5, 40, 400))]
            case 4 | 5:
                raw[at:at] = rng.choice(TOKENS)
            case 6:
                raw[at : at + 1] = bytes([rng.choice(string.printable.encode())])
            case 7:
                raw = raw[: rng.randrange(len(raw) + 1)] if rng.random() < 0.3 else raw.replace(b"\n", b"\r\n", at % 5)
            case _:
                other = rng.choice(sound())[1]
                raw[at:] = other[rng.randrange(len(other)) :]
    if rng.random() < 0.01:
        coding = rng.choice(("utf-16", "utf-32", "latin-1", "cp037", "utf-7"))
        return bytes(raw).decode("utf-8", "ignore").encode(coding, "ignore")
    return bytes(raw)


# -- from nothing ---------------------------------------------------------------------------------------------------


def from_grammar(number: int) -> bytes:
    """Any YAML, of keys that machines have and of words that none has, with anchors, merges and block scalars."""
    rng = random.Random(f"grammar {number}")
    anchors: list[str] = []

    def flow(depth: int) -> str:
        begin = ""
        if rng.random() < 0.08:
            if anchors and rng.random() < 0.6:
                return f"*{rng.choice(anchors)} "
            name = rng.choice("abc")
            begin = f"&{name} "
            anchors.append(name)
        if depth > 4 or rng.random() < 0.5:
            return begin + _scalar(rng.choice((*ODD_NUMBERS, *ODD_KEYS, *_grammar_words(), f"{rng.gauss(0, 9):.3g} m")))
        items = [flow(depth + 1) for _ in range(rng.randrange(4))]
        if rng.random() < 0.4:
            return begin + f"[{', '.join(items)}]"
        keys = [rng.choice((*_grammar_words(), "<<", rng.choice(ODD_KEYS))) for _ in items]
        return begin + f"{{{', '.join(f'{_scalar(k)}: {v}' for k, v in zip(keys, items, strict=True))}}}"

    lines = [f"kind: {rng.choice(kind_names())}"] * (rng.random() < 0.8)
    for _ in range(rng.randrange(12)):
        key = rng.choice(_grammar_words())
        match rng.randrange(6):
            case 0:
                lines += [f"{key}: {rng.choice('|>')}{rng.choice(('', '+', '-', '2', '9-'))}", "  text", "   more"]
            case 1:
                lines += [f"{key}:", *(f"  - {flow(2)}" for _ in range(rng.randrange(4)))]
            case 2:
                lines += [f"{key}:", *(f"  {rng.choice(_grammar_words())}: {flow(2)}" for _ in range(rng.randrange(4)))]
            case _:
                lines.append(f"{key}: {flow(1)}")
    return ("\n".join(lines) + "\n").encode("utf-8", "surrogatepass")


@cache
def _grammar_words() -> tuple[str, ...]:
    keys = {node[index][0] for tree in trees() for node, index in _places(tree) if isinstance(node, Entries)}
    return tuple(sorted(keys))


MAKERS: tuple[Callable[[int], bytes], ...] = (from_tree, from_tree, from_bytes, from_bytes, from_grammar)


def made(number: int) -> bytes:
    """The input of a number."""
    return MAKERS[number % len(MAKERS)](number)


def failures(numbers: Iterable[int]) -> list[str]:
    """What is wrong with the answers to some inputs: number, error, and the lines that differ from any sound file."""
    found = []
    for number in numbers:
        raw = made(number)
        try:
            said(raw, number)
        except Exception as error:
            where = _innermost(error)
            found.append(f"made({number}): {type(error).__name__} in {where}: {error}\n{_telling(raw)}")
            if len(found) >= 20:
                break
    return found


def _innermost(error: BaseException) -> str:
    frames = error.__traceback__
    last = ""
    while frames is not None:
        code = frames.tb_frame.f_code
        last = f"{code.co_filename.rpartition('/')[2]}:{frames.tb_lineno} {code.co_name}"
        frames = frames.tb_next
    return last


def _telling(raw: bytes) -> str:
    known = {line for _, text in sound() for line in text.splitlines()}
    lines = [line[:200] for line in raw.splitlines() if line not in known]
    return "\n".join(f"    {line!r}" for line in lines[:12])


# -- every key in every wrong form ----------------------------------------------------------------------------------

FORMS: tuple[Any, ...] = (
    *(None, True, 0, -1, 1.5, 10**30, "", "x", "nan", "-4 m", "1e15 kg", [], {}, ["x"], [{}], [[]], {"x": {}}),
    *([None, 1, {"type": []}], {"type": {}}, {"type": "x"}, {"x y": {"at": []}}, ["x"] * 3),
)
_DEEPEST = 6


Marks = dict[tuple[str | int, ...], str]
"""What must stand elsewhere for a key to be read: the `type` of the blocks it is in."""


@cache
def slots() -> tuple[tuple[str, tuple[str | int, ...], Marks], ...]:
    """Every key that a model of any kind has, once for each kind: template, path, marks."""
    found = []
    for one in (one for name in kind_names() for one in load_kind(name).manifests):
        met: set[tuple[str, str]] = set()
        for model, path, marks in _slots(one.spec, (), {}):
            if (model, str(path[-1])) not in met:
                met.add((model, str(path[-1])))
                found.append((one.template, path, marks))
    return tuple(found)


def _slots(annotation: Any, path: tuple[str | int, ...], marks: Marks) -> Iterator[tuple[str, Any, Marks]]:
    models = models_of(annotation)
    for model in models:
        words = words_of(keys_of(model)["type"].annotation) if len(models) > 1 else []
        marked = marks | {(*path, "type"): words[0]} if words else marks
        for key, field in keys_of(model).items():
            if not (words and key == "type"):
                yield f"{model.__module__}.{model.__qualname__}", (*path, key), marked
            if len(path) < _DEEPEST:
                yield from _slots(field.annotation, (*path, key), marked)
    held = inner(annotation, 0, None) if not models else None
    if held is not None:
        step = "part" if any(get_origin(one) is dict for one in _options(annotation)) else 0
        yield from _slots(held, (*path, step), marks)


def _options(annotation: Any) -> list[Any]:
    if hasattr(annotation, "__metadata__"):
        return _options(get_args(annotation)[0])
    if get_origin(annotation) in (Union, UnionType):
        return [option for part in get_args(annotation) for option in _options(part)]
    return [annotation]


def in_wrong_forms(slot: tuple[str, tuple[str | int, ...], Marks], forms: tuple[Any, ...] = FORMS) -> Iterator[bytes]:
    """The template of a kind with one key in every form that it may or may not take."""
    template, path, marks = slot
    for form in forms:
        data = copy.deepcopy(_data_of(template))
        for place, word in marks.items():
            _set(data, place, word)
        _set(data, path, form)
        yield json.dumps(data).encode()


@cache
def _data_of(template: str) -> Any:
    return parse(template.encode(), "template").data


def _set(data: Any, path: tuple[str | int, ...], value: object) -> None:
    """A value in data, with whatever is missing on the way."""
    node = data
    for step, following in zip(path, (*path[1:], None), strict=True):
        below: Any = copy.deepcopy(value) if following is None else [] if isinstance(following, int) else {}
        if isinstance(node, list):
            if not node:
                node.append(below)
        elif following is None or not isinstance(node.get(step), type(below)):
            node[step] = below
        if following is None:
            node[0 if isinstance(node, list) else step] = below
            return
        node = node[0 if isinstance(node, list) else step]
        if not isinstance(node, dict | list):
            return


def left_out() -> Iterator[bytes]:
    """Every sound file without one of its keys or entries."""
    for tree in trees():
        for path in _paths(tree):
            shortened = _copied(tree)
            node = shortened
            for step in path[:-1]:
                node = node[step][1] if isinstance(node, Entries) else node[step]
            del node[path[-1]]
            yield written(shortened)


def _paths(node: Any, at: tuple[int, ...] = ()) -> Iterator[tuple[int, ...]]:
    """The place of everything in a tree: numbers of entries, from the outermost on."""
    if isinstance(node, list):
        for index, item in enumerate(node):
            yield (*at, index)
            yield from _paths(item[1] if isinstance(node, Entries) else item, (*at, index))
