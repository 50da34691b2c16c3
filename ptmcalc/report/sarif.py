"""SARIF 2.1.0: findings for code scanning, each in its region, with a fingerprint that survives edits.

**Source** OASIS, Static Analysis Results Interchange Format (SARIF) Version 2.1.0, 2020. Its `kind` of a result: a
verdict the numbers leave open asks for a `review`, a check without its input is `open`; only what fails has a level.
"""

import os
from collections import Counter
from collections.abc import Iterator
from pathlib import PurePath
from typing import Any
from urllib.parse import quote

from ptmcalc import __version__
from ptmcalc.base.diagnostic import CODES, Severity, Verdict
from ptmcalc.base.span import dotted
from ptmcalc.contract.report import FileReport, count
from ptmcalc.report.entries import Entry, entries
from ptmcalc.report.json import dump

SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
_KINDS: dict[Severity | Verdict, tuple[str, str]] = {
    Severity.ERROR: ("fail", "error"),
    Severity.WARNING: ("fail", "warning"),
    Severity.NOTE: ("fail", "note"),
    Verdict.FAIL: ("fail", "error"),
    Verdict.UNDECIDED: ("review", "none"),
    Verdict.NOT_CHECKED: ("open", "none"),
    Verdict.WAIVED: ("fail", "error"),
    Verdict.PASS: ("pass", "none"),
    Verdict.OFF: ("notApplicable", "none"),
}


def render(reports: tuple[FileReport, ...], *, width: int, color: bool, verbose: bool = False) -> str:
    """The log, of one run."""
    found = [(report.path, entry) for report in reports for entry in entries(report)]
    rules = {entry.code: _title(entry) for _, entry in found}
    numbers = {code: index for index, code in enumerate(rules)}
    driver = {
        "name": "ptmcalc",
        "version": __version__,
        "rules": [_rule(code, title) for code, title in rules.items()],
    }
    run = {
        "tool": {"driver": driver},
        "columnKind": "unicodeCodePoints",
        "results": [
            _result(path, entry, numbers[entry.code], fingerprint)
            for (path, entry), fingerprint in zip(found, _fingerprints(found), strict=True)
        ],
        "properties": {"summary": count(reports)},
    }
    return dump({"$schema": SCHEMA, "version": "2.1.0", "runs": [run]})


def _fingerprints(found: list[tuple[str, Entry]]) -> Iterator[str]:
    """That of every entry, with its number among those of its file that share it."""
    met: Counter[tuple[str, str]] = Counter()
    for path, entry in found:
        met[path, entry.fingerprint] += 1
        yield f"{entry.fingerprint}:{met[path, entry.fingerprint]}"


def _title(entry: Entry) -> str:
    """Of the rule: without the part of the machine that one check of it is about."""
    return entry.title.removesuffix(f": {entry.element}") if entry.element else entry.title


def _rule(code: str, title: str) -> dict[str, Any]:
    rule: dict[str, Any] = {"id": code, "shortDescription": {"text": title}}
    if code in CODES:
        rule |= {"fullDescription": {"text": CODES[code].why}, "help": {"text": CODES[code].fix}}
    else:
        rule["help"] = {"text": f"ptmcalc explain {code}"}
    return rule


def _result(path: str, entry: Entry, rule: int, fingerprint: str) -> dict[str, Any]:
    kind, level = _KINDS[entry.state]
    place: dict[str, Any] = {"artifactLocation": {"uri": _uri(path)}}
    if entry.span:
        place["region"] = {"startLine": entry.span.line, "startColumn": entry.span.column}
        if entry.span.end:
            place["region"] |= {"endLine": entry.span.line, "endColumn": entry.span.end}
    location: dict[str, Any] = {"physicalLocation": place}
    if entry.path:
        location["logicalLocations"] = [{"fullyQualifiedName": dotted(entry.path), "kind": "member"}]
    about = f"{entry.title} [{entry.scene}]: " if entry.scene else ""
    result: dict[str, Any] = {
        "ruleId": entry.code,
        "ruleIndex": rule,
        "kind": kind,
        "level": level,
        "message": {"text": (about + entry.message).replace("](", "]\\(")},  # a link is none of ours
        "locations": [location],
        "partialFingerprints": {"ptmcalc/v1": fingerprint},
    }
    if entry.state is Verdict.WAIVED:
        result["suppressions"] = [
            {"kind": "external" if entry.baseline else "inSource", "justification": entry.message}
        ]
    if entry.scene:
        result["properties"] = {"scene": entry.scene}
    return result


def _uri(path: str) -> str:
    """A relative reference, or that of an absolute path."""
    pure = PurePath(path)
    return pure.as_uri() if pure.is_absolute() else quote(os.fsencode(pure.as_posix()))
