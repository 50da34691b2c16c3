"""Hostile design files made by hand: why each is one, its bytes, and the codes it must be refused with.

A file with no code is a machine for all that: what looks hostile about it means nothing.
"""

from typing import NamedTuple

from support.command import ROOT

BASE = """\
kind: conveyor
name: corpus
description: a sound one
route: {length: 1000 m, lift: 60 m}
belt:
  mass: 20 kg/m
  stiffness: 138 MN
idlers:
  carry: {line_mass: 25 kg/m}
  return: {line_mass: 18 kg/m}
load: {mass: 200 kg/m}
resistance: {coefficient: 0.025}
speed: 4 m/s
drive:
  motor: {count: 3, inertia: 6 kg*m^2, mean_starting_torque: 3000 N*m}
  gear: {ratio: 20, efficiency: 0.94}
  drum: {diameter: 1 m, wrap: 210 deg, friction: 0.3}
takeup: {type: gravity, tension: 240 kN}
scenes:
  - {type: run}
  - {type: start}
"""


class Case(NamedTuple):
    """An input; `codes` are those of its errors, each once, in the order of the file."""

    reason: str
    raw: bytes
    codes: tuple[str, ...] = ()


def put(old: str, new: str) -> bytes:
    """The sound machine with some words replaced."""
    assert BASE.count(old) == 1, f"{old!r} is {BASE.count(old)} times in the sound machine"
    return BASE.replace(old, new).encode("utf-8", "surrogatepass")


def more(text: str) -> bytes:
    """The sound machine with lines behind it."""
    return (BASE + text).encode("utf-8", "surrogatepass")


def speed(text: str) -> bytes:
    """The sound machine with another speed."""
    return put("speed: 4 m/s", f"speed: {text}")


def ratio(text: str) -> bytes:
    """The sound machine with another gear ratio, which is a number without a unit."""
    return put("ratio: 20,", f"ratio: {text},")


def scenes(text: str) -> bytes:
    """The sound machine with other scenes."""
    return BASE.partition("scenes:")[0].encode() + f"scenes: {text}\n".encode()


def bomb(levels: int, width: int = 10) -> str:
    """Anchors of which each stands for several of the one before."""
    lines = ["a0: &a0 [x]"]
    lines += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * width)}]" for n in range(1, levels)]
    return "\n".join(lines) + "\n"


SOUND = BASE.encode()

TEXT = [
    Case("no bytes at all", b"", ("TXT104",)),
    Case("one NUL byte", b"\0", ("TXT105",)),
    Case("a thousand NUL bytes", b"\0" * 1000, ("TXT105",)),
    Case("blanks and line ends only", b"  \n\n \n", ("TXT104",)),
    Case("a tab alone", b"\t", ("TXT104",)),
    Case("a tab in front of the first key", b"\t" + SOUND, ("TXT105",)),
    Case("a mark of byte order and nothing else", b"\xef\xbb\xbf", ("TXT104",)),
    Case("a mark of byte order before a sound file", b"\xef\xbb\xbf" + SOUND),
    Case("two marks of byte order, of which YAML takes the second", b"\xef\xbb\xbf\xef\xbb\xbf" + SOUND),
    Case("a mark of byte order in the middle", put("speed", "\ufeffspeed"), ("TXT105",)),
    Case("UTF-16 with its mark", BASE.encode("utf-16"), ("TXT103",)),
    Case("UTF-16 without its mark", BASE.encode("utf-16-le"), ("TXT105",)),
    Case("UTF-32", BASE.encode("utf-32"), ("TXT103",)),
    Case("EBCDIC", BASE.encode("cp037"), ("TXT103",)),
    Case("Latin-1 letters", put("corpus", "Förderer").decode().encode("latin-1"), ("TXT103",)),
    Case(
        "an overlong slash, which old decoders took for a path",
        put("corpus", "x").replace(b"x", b"\xc0\xaf"),
        ("TXT103",),
    ),
    Case("half of a pair of surrogates in UTF-8", put("corpus", "\ud800"), ("TXT103",)),
    Case("a code point beyond Unicode", put("corpus", "x").replace(b"name: x", b"name: \xf4\x90\x80\x80"), ("TXT103",)),
    Case("a cut UTF-8 sequence at the end", SOUND + b"# \xe2\x82", ("TXT103",)),
    Case("an escape of a terminal in the text", put("corpus", "\x1b[2J"), ("TXT105",)),
    Case("the escape that sets a terminal's title", put("corpus", "\x1b]0;x\x07"), ("TXT105",)),
    Case("a C1 control character", put("corpus", "\x9b31m"), ("TXT105",)),
    Case("DEL", put("corpus", "\x7f"), ("TXT105",)),
    Case("a backspace that hides a word", put("corpus", "ok\x08\x08no"), ("TXT105",)),
    Case("a form feed", put("corpus", "a\x0cb"), ("TXT105",)),
    Case("a vertical tab", put("corpus", "a\x0bb"), ("TXT105",)),
    Case("U+FFFE", put("corpus", "\ufffe"), ("TXT105",)),
    Case("U+0085 as a line end", put("corpus", "a\x85b"), ("TXT105",)),
    Case("U+2028 as a line end", put("corpus", "a\u2028b"), ("TXT105",)),
    Case("CR line ends", SOUND.replace(b"\n", b"\r")),
    Case("CRLF line ends", SOUND.replace(b"\n", b"\r\n")),
    Case("all three line ends", SOUND.replace(b"\n", b"\r\n", 3).replace(b"\nbelt", b"\rbelt")),
    Case("LF CR line ends, which double every line", SOUND.replace(b"\n", b"\n\r")),
    Case("no line end behind the last line", SOUND.rstrip()),
    Case("a file of comments", b"# kind: conveyor\n" * 100, ("TXT104",)),
    Case("a comment of a hundred thousand characters", SOUND + b"#" + b"x" * 100_000),
    Case("a shell script", b"#!/bin/sh\nrm -rf .\n", ("TXT112",)),
    Case("a page of HTML", b"<html><script>alert(1)</script></html>\n", ("TXT112",)),
    Case(
        "XML with an entity that names a file",
        b'<!DOCTYPE a [<!ENTITY x SYSTEM "file:///etc/passwd">]><a>&x;</a>',
        ("TXT112",),
    ),
    Case("an ELF program", b"\x7fELF\x02\x01\x01" + bytes(100), ("TXT105",)),
    Case("a PNG image", b"\x89PNG\r\n\x1a\n" + bytes(50), ("TXT103",)),
    Case("a zip archive", b"PK\x03\x04" + bytes(50), ("TXT105",)),
    Case("gzip", b"\x1f\x8b\x08\x00" + bytes(20), ("TXT103",)),
    Case("a Python pickle", b"\x80\x04\x95\x10cos\nsystem\n(S'id'\ntR.", ("TXT103",)),
    Case("JSON of the same machine", b'{"kind": "conveyor", "speed": "4 m/s"}', ("SPC103", "SPC113")),
    Case("JSON with a comma too much", b'{"kind": "conveyor",}', ("SPC103", "SPC113")),
    Case("one byte more than a mebibyte", b"#" + b"x" * (1 << 20), ("TXT108",)),
    Case("a mebibyte of one scalar", b"kind: " + b"x" * ((1 << 20) - 6), ("TXT108",)),
    Case("a mebibyte of digits", b"kind: " + b"9" * ((1 << 20) - 6), ("TXT108",)),
    Case("a key longer than a mark of a simple key may be", b"a" * 2000 + b": 1\n", ("TXT105",)),
    Case("a quoted key of ten thousand characters", b'"' + b"a" * 10_000 + b'" : 1\n', ("TXT105",)),
    Case("a line of seventy thousand characters", more("x: " + "y" * 70_000 + "\n"), ("TXT108",)),
]

YAML = [
    Case("a tag that calls a function", put("corpus", "!!python/object/apply:os.system [id]"), ("SPC111", "TXT107")),
    Case("a tag that imports a module", put("corpus", "!!python/module:antigravity x"), ("TXT107",)),
    Case("a tag that builds a class", put("speed: 4 m/s", "speed: !!python/object/new:type [x]"), ("SPC111", "TXT107")),
    Case("a tag on the whole document", b"!!python/object:os.system\n" + SOUND, ("TXT107",)),
    Case("a tag on a key", put("speed", "!!str speed"), ("TXT107",)),
    Case("the tag of binary data", put("corpus", "!!binary aGFsbG8="), ("TXT107",)),
    Case("the tag of an ordered mapping", put("corpus", "!!omap [a: 1]"), ("SPC111", "TXT107")),
    Case("a tag that includes a file elsewhere", put("corpus", "!include /etc/passwd"), ("TXT107",)),
    Case("a tag that reads the environment", put("corpus", "!ENV ${HOME}"), ("TXT107",)),
    Case("a verbatim tag", put("corpus", "!<tag:yaml.org,2002:str> x"), ("TXT107",)),
    Case("a tag directive", b"%TAG ! tag:evil,2026:\n---\n" + SOUND),
    Case("a directive that YAML does not know", b"%EVIL 1\n---\n" + SOUND, ("TXT105",)),
    Case("a YAML version to come", b"%YAML 3.0\n---\n" + SOUND, ("TXT105",)),
    Case("two documents", SOUND + b"---\n" + SOUND, ("TXT109",)),
    Case("a thousand documents", b"---\na: 1\n" * 1000, ("TXT109",)),
    Case("an end of the document and rubbish behind it", SOUND + b"...\n]]]\n", ("TXT105",)),
    Case("an alias bomb of a thousand million", more(bomb(10)), ("TXT108",)),
    Case(
        "a bomb in keys of mappings",
        b"a: &a {x: y}\n" + b"".join(b"b%d: &a {x: *a, z: *a}\n" % n for n in range(40)),
        ("TXT108",),
    ),
    Case(
        "merge keys that double each time",
        b"a: &a {k: v}\n" + b"".join(b"b%d: &a {<<: *a, k%d: *a}\n" % (n, n) for n in range(40)),
        ("TXT108",),
    ),
    Case("an alias to what it stands in", more("x: &x [*x]\n"), ("SPC104", "TXT110")),
    Case("an alias to the document", b"&x\n" + SOUND + b"y: *x\n", ("TXT110",)),
    Case("an alias of nothing", speed("*nothing"), ("TXT110",)),
    Case("an alias as a key", more("x: &k kind\n*k : 1\n"), ("SPC104", "TXT111")),
    Case("an anchor that is written twice", speed("&a 4 m/s") + b"notes: &a x\n", ("SPC104",)),
    Case("an anchor on each value, never used", put("mass: 20 kg/m", "mass: &m 20 kg/m")),
    Case(
        "an alias for a number",
        put("mass: 20 kg/m\n", "mass: &m 20 kg/m\n").replace(b"{line_mass: 25 kg/m}", b"{line_mass: *m}"),
    ),
    Case("a merge of a scalar", more("<<: x\n"), ("TXT110",)),
    Case("a merge of a list of scalars", put("gear: {", "gear: {<<: [1, 2], "), ("TXT110",)),
    Case("a merge of a mapping that stands there", put("gear: {ratio: 20,", "gear: {<<: {ratio: 20},")),
    Case("a merge into itself", more("x: &x {<<: *x}\n"), ("TXT110",)),
    Case("two merges in one mapping", put("gear: {ratio: 20,", "gear: {<<: {ratio: 20}, <<: {ratio: 30},")),
    Case("a quoted `<<`, which merges nothing", more("'<<': {speed: 5 m/s}\n"), ("SPC104",)),
    Case("a hundred levels of lists", more(f"x: {'[' * 100}{']' * 100}\n"), ("TXT108",)),
    Case("a hundred thousand levels of lists", b"x: " + b"[" * 100_000, ("TXT108",)),
    Case("a hundred thousand levels of mappings", b"{x: " * 100_000, ("TXT108",)),
    Case("a hundred thousand dashes", b"- " * 100_000, ("TXT108",)),
    Case("levels by indentation", "".join(f"{' ' * n}x:\n" for n in range(120)).encode(), ("TXT108",)),
    Case("keys in keys", b"? " * 50_000, ("TXT111", "TXT108")),
    Case("sixty thousand items", more(f"x: [{'1,' * 60_000}]\n"), ("TXT108",)),
    Case("sixty thousand keys", b"".join(b"k%d: 1\n" % n for n in range(60_000)), ("TXT108",)),
    Case(
        "twenty thousand unknown keys", SOUND + b"".join(b"k%d: 1\n" % n for n in range(20_000)), ("SPC104", "TXT108")
    ),
    Case("a thousand times the same key", SOUND + b"speed: 4 m/s\n" * 1000, ("TXT106",)),
    Case("a key twice, the second harmless to the eye", more("speed: 40 m/s\n"), ("TXT106",)),
    Case("a key twice by an escape", more('"sp\\x65ed": 40 m/s\n'), ("TXT106",)),
    Case("`kind` twice", more("kind: shaft\n"), ("TXT106",)),
    Case("a key that looks like another by a Cyrillic letter", more("sрeed: 40 m/s\n"), ("SPC104",)),
    Case("a key with a combining accent", more("cafe\u0301: 1\n"), ("SPC104",)),
    Case("a key of right-to-left override", more('"\\u202edeeps": 1\n'), ("SPC104",)),
    Case("a key with an escape of a terminal", more('"\\e[31mred": 1\n'), ("SPC104",)),
    Case("a key with a line end", more('"a\\nb: error SPC000 all is well": 1\n'), ("SPC104",)),
    Case("a key with a NUL", more('"a\\0b": 1\n'), ("SPC104",)),
    Case("half a pair of surrogates by an escape", more('"\\ud800": 1\n'), ("TXT105",)),
    Case("an empty key", more('"": 1\n'), ("TXT111",)),
    Case("a list as a key", more("? [a, b]\n: 1\n"), ("TXT111",)),
    Case("a mapping as a key", more("{a: b}: 1\n"), ("TXT111",)),
    Case("null as a key", more("~: 1\n"), ("SPC104",)),
    Case("a number as a key", more("12: 1\n"), ("SPC104",)),
    Case("`__class__` as a key", more("__class__: {__init__: {__globals__: x}}\n"), ("SPC104",)),
    Case("`model_config` as a key", more("model_config: {extra: allow}\n"), ("SPC104",)),
    Case("the name of a method as a key", more("with_value: 1\nmodel_copy: 1\n"), ("SPC104",)),
    Case("a template in a key", more('"{0.__class__}": "%(x)s ${HOME} {{7*7}}"\n'), ("SPC104",)),
    Case("an open quote", speed('"4 m/s'), ("TXT105",)),
    Case("an open bracket", speed("[4 m/s"), ("TXT105",)),
    Case("a bracket that closes nothing", speed("]"), ("TXT105",)),
    Case("a wrong bracket", put("{length: 1000 m, lift: 60 m}", "{length: 1000 m, lift: 60 m]"), ("TXT105",)),
    Case("a key without its blank", put("speed: 4", "speed:4"), ("TXT105",)),
    Case("two colons", speed("4 m/s: x"), ("TXT105",)),
    Case("tabs as indentation", put("  mass: 20", "\tmass: 20"), ("TXT105",)),
    Case("indentation that goes back halfway", put("  stiffness", " stiffness"), ("TXT105",)),
    Case("an escape that YAML does not know", speed(r'"4 \q"'), ("TXT105",)),
    Case("an escape of a code point beyond Unicode", speed(r'"\UFFFFFFFF"'), ("TXT105",)),
    Case("a plain scalar that begins with a backtick", speed("`id`"), ("TXT105",)),
    Case("a plain scalar that begins with `@`", speed("@x"), ("TXT105",)),
    Case("a block scalar as a number", speed("|\n  4 m/s")),
    Case("a folded scalar as a number, over two lines", speed(">\n  4\n  m/s")),
    Case("a block scalar with a wrong mark", speed("|99\n  4 m/s"), ("TXT105",)),
    Case("a scalar over several lines", speed("4\n  m/s")),
    Case("a comment stuck to a value", speed("4 m/s#fast"), ("SPC108",)),
    Case("a list where the document should be", b"- kind: conveyor\n", ("TXT112",)),
    Case("a number where the document should be", b"42\n", ("TXT112",)),
    Case("null where the document should be", b"~\n", ("TXT104",)),
    Case("an empty mapping", b"{}\n", ("SPC101",)),
    Case("a mapping of one null", b"? \n", ("SPC101", "TXT111")),
]

KINDS = [
    Case("no kind", put("kind: conveyor\n", ""), ("SPC101",)),
    Case("a kind of nothing", put("kind: conveyor", "kind:"), ("SPC102",)),
    Case("a kind that is a number", put("kind: conveyor", "kind: 1"), ("SPC102",)),
    Case("a kind that is a list", put("kind: conveyor", "kind: [conveyor]"), ("SPC102",)),
    Case("a kind that is a mapping", put("kind: conveyor", "kind: {conveyor: 1}"), ("SPC102",)),
    Case("a kind that is true", put("kind: conveyor", "kind: true"), ("SPC102",)),
    Case("a kind in capitals", put("kind: conveyor", "kind: CONVEYOR"), ("SPC102",)),
    Case("a kind with a blank", put("kind: conveyor", "kind: 'conveyor '"), ("SPC102",)),
    Case("a kind that is a module of Python", put("kind: conveyor", "kind: os"), ("SPC102",)),
    Case("a kind that is a path", put("kind: conveyor", "kind: ../../../etc/passwd"), ("SPC102",)),
    Case("a kind that is a dotted name", put("kind: conveyor", "kind: conveyor.spec"), ("SPC102",)),
    Case("a kind that is a private name", put("kind: conveyor", "kind: __pycache__"), ("SPC102",)),
    Case("a kind that is the package", put("kind: conveyor", "kind: __init__"), ("SPC102",)),
    Case("a kind of ten thousand letters", put("kind: conveyor", "kind: " + "x" * 10_000), ("SPC102",)),
    Case("a kind that means another", put("kind: conveyor", "kind: conveyer"), ("SPC102",)),
    Case("a kind with several types and none named", b"kind: crane\n", ("SPC103",)),
    Case("a type that is a list", b"kind: crane\ntype: [slewing]\n", ("SPC112",)),
    Case("a type that is a path", b"kind: crane\ntype: ../hoist\n", ("SPC112",)),
    Case("a type that is null", b"kind: crane\ntype:\n", ("SPC112",)),
    Case("the keys of another kind", put("kind: conveyor", "kind: shaft"), ("SPC103", "SPC104", "SPC105", "SPC112")),
    Case("nothing but a kind", b"kind: hoist\n", ("SPC103",)),
    Case(
        "every value null",
        b"kind: conveyor\nroute:\nbelt:\nspeed:\ndrive:\ntakeup:\nscenes:\n",
        ("SPC103", "SPC113", "SPC111"),
    ),
    Case(
        "every value a list",
        b"kind: conveyor\nroute: []\nbelt: []\nspeed: []\ndrive: []\nscenes: {}\n",
        ("SPC103", "SPC111"),
    ),
    Case(
        "every value a mapping", b"kind: chain_drive\nchain: {}\nspeed: {}\nname: {}\n", ("SPC103", "SPC113", "SPC111")
    ),
]

NUMBERS = [
    *(
        Case(f"a speed of `{text}`", speed(text), codes)
        for text, codes in {
            "0 m/s": ("SPC110",),
            "-4 m/s": ("SPC110",),
            "-0.0 m/s": ("SPC110",),
            "nan m/s": ("SPC109",),
            "NaN": ("SPC109",),
            ".nan": ("SPC109",),
            ".inf": ("SPC109",),
            "-.inf": ("SPC109",),
            "inf m/s": ("SPC109",),
            "Infinity m/s": ("SPC109",),
            "1e400 m/s": ("SPC109",),
            "-1e400 m/s": ("SPC109",),
            "1e400": ("SPC109",),
            "1e308 km/h": ("SPC110",),
            "1e308 km/ms": ("SPC109",),
            "1e16 m/s": ("SPC110",),
            "1e-13 m/s": ("SPC110",),
            "1e-400 m/s": ("SPC110",),
            "5e-324 m/s": ("SPC110",),
            "4": ("SPC106",),
            "'4'": ("SPC106",),
            "4.": ("SPC106",),
            "true": ("SPC111",),
            "~": ("SPC111",),
            "''": ("SPC114",),
            "' '": ("SPC114",),
            "[4 m/s]": ("SPC111",),
            "{4 m/s}": ("SPC111",),
            "{value: 4, unit: m/s}": ("SPC111",),
            "m/s": ("SPC114",),
            "4 m s": ("SPC108",),
            "4 m/s/s": ("SPC108",),
            "4 m/s^2": ("SPC105",),
            "4 m": ("SPC105",),
            "4 kg": ("SPC105",),
            "4 Hz": ("SPC105",),
            "4 rpm": ("SPC105",),
            "4 m/": ("SPC108",),
            "4 /s": ("SPC114",),
            "4 m^99/s": ("SPC108",),
            "4 m^9*s^9*kg^9*N^9": ("SPC105",),
            "4 km^9*km^9*km^9*km^9/s": ("SPC105",),
            "4 mm^9/km^9": ("SPC105",),
            "4 m//s": ("SPC108",),
            "4 m*m/s/m": ("SPC108",),
            "4 ft/s": ("SPC108",),
            "4 mph": ("SPC108",),
            "4 M/S": ("SPC108",),
            "4 µm/s": ("SPC108",),
            "4 m/s; rm -rf": ("SPC108",),
            "4,5 m/s": ("SPC107",),
            "4.5,0 m/s": ("SPC114",),
            "1,000 m/s": ("SPC107",),
            "1.000,5 m/s": ("SPC114",),
            "1 000 m/s": ("SPC114",),
            "1_000 m/s": ("SPC114",),
            "0x10 m/s": ("SPC108",),
            "0x10": ("SPC106",),
            "0o17": ("SPC106",),
            "1e m/s": ("SPC108",),
            "1e+ m/s": ("SPC108",),
            "--4 m/s": ("SPC114",),
            "+4 m/s": (),
            "4.m/s": (),
            ".4e1m/s": (),
            "4\u00a0m/s": (),
            "4\u2009m/s": (),
            "٤ m/s": ("SPC114",),
            "４ m/s": ("SPC114",),
            "½ m/s": ("SPC114",),
            "−4 m/s": ("SPC114",),
            "4 m∕s": ("SPC108",),
            "4 m/s\u200b": ("SPC108",),
            "=4+1": ("SPC114",),
            "4 m/s # fast": (),
            "'4 m/s\\n'": ("SPC108",),
            "12:30": ("SPC114",),
            "2026-11-23": ("SPC114",),
            "{{ speed }}": ("SPC111", "TXT111"),
            "${SPEED}": ("SPC114",),
            "$(id)": ("SPC114",),
            "__import__('os').system('id')": ("SPC114",),
            "4 m/s" + " " * 5000: (),
        }.items()
    ),
    Case("a number of a thousand digits", speed("9" * 1000 + " m/s"), ("SPC109",)),
    Case("a fraction of nine thousand digits", speed("4." + "0" * 9000 + " m/s")),
    Case("a number of nine thousand zeros", speed("0" * 9000 + "4 m/s")),
    Case("a unit of sixty thousand letters", speed("4 " + "m" * 60_000), ("TXT108",)),
    Case("a unit of four thousand factors", speed("4 m" + "*m" * 4000), ("SPC105",)),
    Case("digits in two thousand groups", speed("1" + ",000" * 2000 + " m/s"), ("SPC114",)),
    Case("digits with four thousand commas", speed("1," * 4000 + "1 m/s"), ("SPC114",)),
    *(
        Case(f"a ratio of `{text}`", ratio(text), codes)
        for text, codes in {
            "0": ("SPC110",),
            "-20": ("SPC110",),
            ".nan": ("SPC109",),
            ".inf": ("SPC109",),
            "1e999": ("SPC109",),
            "9" * 400: ("SPC109",),
            "9" * 5000: ("SPC109",),
            "0x" + "f" * 80: ("SPC110",),
            "0x" + "f" * 400: ("SPC108",),
            "true": ("SPC111",),
            "yes": ("SPC114",),
            "20 m": ("SPC105",),
            "2000 %": (),
            "20:1": ("SPC114",),
            "1e15": (),
            "1e-12": (),
            "1.01e15": ("SPC110",),
        }.items()
    ),
    Case("an efficiency above one", put("efficiency: 0.94", "efficiency: 1.0000001"), ("SPC110",)),
    Case("an efficiency of nothing", put("efficiency: 0.94", "efficiency: 0"), ("SPC110",)),
    Case("minus two motors", put("count: 3", "count: -2"), ("SPC110",)),
    Case("ten to the eighteenth motors", put("count: 3", "count: 1000000000000000000"), ("SPC110",)),
    Case("as many motors as no number of a machine holds", put("count: 3", "count: " + "9" * 400), ("SPC111",)),
    Case("as many digits as Python converts no longer", put("count: 3", "count: " + "9" * 5000), ("SPC111",)),
    Case("two and a half motors", put("count: 3", "count: 2.5"), ("SPC111",)),
    Case("motors by a word", put("count: 3", "count: three"), ("SPC111",)),
    Case("motors that are true", put("count: 3", "count: true"), ("SPC111",)),
    Case("a wrap of a million turns", put("wrap: 210 deg", "wrap: 1e6 rev")),
    Case("a friction of a thousand million", put("friction: 0.3", "friction: 1e9")),
    Case("a friction of nothing", put("friction: 0.3", "friction: 0"), ("SPC110",)),
    Case("a conveyor as long as the solar system", put("length: 1000 m", "length: 1e13 m")),
    Case("a conveyor of a micrometre", put("length: 1000 m, lift: 60 m", "length: 0.001 mm, lift: 0 m"), ("SPC113",)),
    Case("a lift above its length", put("lift: 60 m", "lift: 6000 m"), ("SPC113",)),
    Case("a belt of nothing", put("mass: 20 kg/m\n", "mass: 0 kg/m\n"), ("SPC110",)),
    Case("a belt as stiff as no material", put("138 MN", "1e15 N")),
    Case("a belt as soft as nothing", put("138 MN", "1e-12 N")),
    Case("everything very large", SOUND.replace(b" m", b"e9 m").replace(b" kg", b"e9 kg"), ("TXT105",)),
]

SCENES = [
    Case("no scene", scenes("[]"), ("SPC110",)),
    Case("scenes that are null", scenes("")),
    Case("scenes that are a word", scenes("run"), ("SPC111",)),
    Case("scenes that are a mapping", scenes("{type: run}"), ("SPC111",)),
    Case("a scene that is null", scenes("[~]"), ("SPC111",)),
    Case("a scene that is a number", scenes("[1]"), ("SPC111",)),
    Case("a scene without a type", scenes("[{load: empty}]"), ("SPC103",)),
    Case("a scene of no type of conveyors", scenes("[{type: slew}]"), ("SPC112",)),
    Case("a scene whose type is a list", scenes("[{type: [run]}]"), ("SPC112",)),
    Case("a scene whose type is a mapping", scenes("[{type: {run: 1}}]"), ("SPC112",)),
    Case("a scene whose type is null", scenes("[{type: }]"), ("SPC112",)),
    Case("a scene whose type is a very long word", scenes(f"[{{type: {'x' * 5000}}}]"), ("SPC112",)),
    Case("a scene by a name with markup", scenes('[{type: run, name: "[red]x"}]'), ("SPC111",)),
    Case("a scene by a name with an escape", scenes('[{type: run, name: "\\e[2J"}]'), ("SPC111",)),
    Case("a scene by a name that is a path", scenes("[{type: run, name: ../../x}]"), ("SPC111",)),
    Case("a scene by a name of a hundred letters", scenes(f"[{{type: run, name: {'x' * 100}}}]"), ("SPC110",)),
    Case("a scene by a name that is a number", scenes("[{type: run, name: 1}]"), ("SPC111",)),
    Case("two scenes of one name", scenes("[{type: run, name: a}, {type: start, name: a}]"), ("SPC113",)),
    Case("the same scene twice", scenes("[{type: run}, {type: run}]"), ("SPC113",)),
    Case("a start in no time", scenes("[{type: start, profile: {shape: ramp, time: 0 s}}]"), ("SPC110",)),
    Case("a start of a thousand years", scenes("[{type: start, profile: {shape: ramp, time: 1e7 h}}]")),
    Case("a start in a picosecond", scenes("[{type: start, profile: {shape: ramp, time: 1e-12 s}}]")),
    Case("a start of no shape", scenes("[{type: start, profile: {shape: jolt, time: 1 s}}]"), ("SPC112",)),
    Case("a hundred thousand scenes", scenes("[" + "{type: run}," * 100_000 + "]"), ("TXT108",)),
    Case("a thousand scenes by alias", scenes("[&s {type: run}" + ", *s" * 999 + "]"), ("SPC110", "SPC113")),
]

SETTINGS = [
    Case("an effect that nobody knows", more("effects: {magic: on}\n"), ("SPC104",)),
    Case("an effect that is true", more("effects: {belt_wave: true}\n"), ("SPC112",)),
    Case("an effect that is a list", more("effects: {belt_wave: [on]}\n"), ("SPC112",)),
    Case("effects that are a list", more("effects: [belt_wave]\n"), ("SPC111",)),
    Case("effects that are null", more("effects:\n"), ("SPC111",)),
    Case("an effect forced on", more("effects: {belt_wave: on}\n")),
    Case("an accuracy of nothing", more("accuracy: 0\n"), ("SPC110",)),
    Case("an accuracy below nothing", more("accuracy: -1 %\n"), ("SPC110",)),
    Case("an accuracy above one", more("accuracy: 200 %\n"), ("SPC110",)),
    Case("an accuracy that no solver reaches", more("accuracy: 1e-11\n")),
    Case("an accuracy in metres", more("accuracy: 1 mm\n"), ("SPC105",)),
    Case("no gravity", more("gravity: 0 m/s^2\n"), ("SPC110",)),
    Case("gravity upwards", more("gravity: -9.81 m/s^2\n"), ("SPC110",)),
    Case("the gravity of a black hole", more("gravity: 1e12 m/s^2\n")),
    Case("a check switched off by its name", more("checks: {CNV101: {off: tested}}\n")),
    Case("a check switched off without a reason", more('checks: {CNV101: {off: ""}}\n'), ("SPC110",)),
    Case("a check switched off by null", more("checks: {CNV101: {off: }}\n"), ("SPC111",)),
    Case("a check switched off by a word", more("checks: {CNV101: off}\n"), ("SPC111",)),
    Case("a check switched off by true", more("checks: {CNV101: {off: true}}\n"), ("SPC111",)),
    Case("a check of another kind switched off", more("checks: {HST101: {off: x}}\n"), ("SPC104",)),
    Case("checks that are a list", more("checks: [CNV101]\n"), ("SPC111",)),
    Case("a reason that is a command of GitHub", more('checks: {CNV101: {off: "\\n::error::x"}}\n')),
    Case("a reason of nine thousand letters", more(f"checks: {{CNV101: {{off: {'x' * 9000}}}}}\n")),
    Case("a reason of eleven thousand letters", more(f"checks: {{CNV101: {{off: {'x' * 11_000}}}}}\n"), ("TXT108",)),
    Case("a waiver", more("waive: [{check: CNV101, reason: tested, until: 2099-01-01}]\n")),
    Case("a waiver of nothing known", more("waive: [{check: CNV999, reason: x, until: 2099-01-01}]\n"), ("SPC112",)),
    Case(
        "a waiver of a code that is a list",
        more("waive: [{check: [CNV101], reason: x, until: 2099-01-01}]\n"),
        ("SPC111",),
    ),
    Case("a waiver without a reason", more("waive: [{check: CNV101, until: 2099-01-01}]\n"), ("SPC103",)),
    Case(
        "a waiver with an empty reason", more("waive: [{check: CNV101, reason: '', until: 2099-01-01}]\n"), ("SPC110",)
    ),
    Case("a waiver without its day", more("waive: [{check: CNV101, reason: x}]\n"), ("SPC103",)),
    Case(
        "a waiver until a day that is none",
        more("waive: [{check: CNV101, reason: x, until: 2026-02-30}]\n"),
        ("SPC111",),
    ),
    Case(
        "a waiver until a moment", more("waive: [{check: CNV101, reason: x, until: 2026-02-20 10:00}]\n"), ("SPC111",)
    ),
    Case("a waiver until a number", more("waive: [{check: CNV101, reason: x, until: 20990101}]\n"), ("SPC111",)),
    Case(
        "a waiver until a day in other digits",
        more("waive: [{check: CNV101, reason: x, until: ２０９９-01-01}]\n"),
        ("SPC111",),
    ),
    Case("a waiver until the last day there is", more("waive: [{check: CNV101, reason: x, until: 9999-12-31}]\n")),
    Case("a waiver until the first day there is", more("waive: [{check: CNV101, reason: x, until: 0001-01-01}]\n")),
    Case(
        "a waiver until the year nought", more("waive: [{check: CNV101, reason: x, until: 0000-01-01}]\n"), ("SPC111",)
    ),
    Case(
        "two waivers of one check",
        more("waive:\n" + "  - {check: CNV101, reason: x, until: 2099-01-01}\n" * 2),
        ("SPC113",),
    ),
    Case("waivers that are a mapping", more("waive: {check: CNV101}\n"), ("SPC111",)),
    Case("a waiver that is a word", more("waive: [CNV101]\n"), ("SPC111",)),
    Case(
        "a waiver with a key too much",
        more("waive: [{check: CNV101, reason: x, until: 2099-01-01, all: true}]\n"),
        ("SPC104",),
    ),
    Case("a name that is a formula of a spreadsheet", put("corpus", "\"=cmd|' /C calc'!A0\"")),
    Case("a name that is a list", put("corpus", "[a]"), ("SPC111",)),
    Case("a name that is a number", put("corpus", "12"), ("SPC111",)),
    Case("a name of a thousand letters", put("corpus", "x" * 1000), ("SPC110",)),
    Case("a name with markup of a terminal", put("corpus", '"[red]x[/] [link=file:///etc/passwd]y"')),
    Case("a name with escapes of a terminal", put("corpus", '"\\e]8;;file:///etc/passwd\\e\\\\x"')),
    Case("a name that is a command of GitHub", put("corpus", '"\\n::add-mask::x\\r::set-output name=x::y"')),
    Case("a name that is a secret, told nobody in a message", put("corpus", "[ghp_0123456789]"), ("SPC111",)),
    Case("a description of half a megabyte", put("a sound one", "x" * 500_000), ("TXT108",)),
    Case("a key that asks for a file", more("include: ../secrets.yaml\n"), ("SPC104",)),
    Case("a key that asks for a device", more("record: /dev/zero\n"), ("SPC104",)),
    Case("a value that names a file", speed("file:///etc/passwd"), ("SPC114",)),
    Case("a value that names a page", speed("http://169.254.169.254/latest"), ("SPC114",)),
    Case("a block that names a file", put("load: {mass: 200 kg/m}", "load: load.yaml"), ("SPC111",)),
    Case(
        "a reference as JSON Schema writes it",
        put("load: {mass: 200 kg/m}", "load: {$ref: /etc/passwd}"),
        ("SPC113", "SPC104"),
    ),
]


STACKER = (ROOT / "specs" / "crane_overhead_stacker.yaml").read_text("utf-8")


def stacker(*edits: tuple[str, str]) -> bytes:
    """The overhead stacker of the project with some words replaced."""
    text = STACKER
    for old, new in edits:
        assert text.count(old) == 1
        text = text.replace(old, new)
    return text.encode()


def stacker_that(scene: str) -> bytes:
    """The overhead stacker with one scene."""
    return f"{STACKER.partition('scenes:')[0]}scenes: [{scene}]\n".encode()


FOUND = [
    Case("a mechanism that is a mapping", stacker_that("{type: start, mechanism: {}}"), ("SPC112",)),
    Case("a mechanism that is a list, which no set holds", stacker_that("{type: brake, mechanism: []}"), ("SPC112",)),
    Case(
        "a mast shorter than an atom, so stiff that rounding hides its root",
        stacker(("length: 6 m  ", "length: 1e-8 m  "), ("  lowest: 0.5 m\n  highest: 5 m\n", "")),
    ),
]
"""What the made inputs found."""

CASES = [*TEXT, *YAML, *KINDS, *NUMBERS, *SCENES, *SETTINGS, *FOUND]
