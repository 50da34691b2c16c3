"""What `ptmcalc merge` does: reports or stores of the parts of a run become one."""

import json as reader
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from ptmcalc.base.diagnostic import BROKEN, Severity, Verdict
from ptmcalc.base.errors import UsageError
from ptmcalc.cli.batch import write
from ptmcalc.cli.output import say
from ptmcalc.contract.check import Sense
from ptmcalc.contract.report import Tally, status_at, total
from ptmcalc.engine.files import by_path
from ptmcalc.engine.store import Store, is_store
from ptmcalc.report import json

_MALFORMED = (ValueError, KeyError, TypeError, AttributeError, IndexError, RecursionError, OverflowError)
"""What can go wrong where JSON is read as something it is not."""
_ROUNDING = 1e-9
"""Relative difference of a value and its limit that decides nothing."""


def united(parts: Sequence[str], output: str) -> int:
    """Unite reports, or stores; the exit status."""
    stores = [is_store(Path(part)) for part in parts]
    if all(stores):
        _stores(parts, output)
        return 0
    if any(stores):
        raise UsageError("stores and reports do not mix", "merge either JSON reports or stores")
    return _reports(parts, output)


def _stores(parts: Sequence[str], output: str) -> None:
    if not output:
        raise UsageError("a store is not printed", "name the store to make: --output FILE")
    with Store(Path(output)) as whole:
        for part in parts:
            if Path(part).resolve() == Path(output).resolve():
                continue
            with Store(Path(part)) as one:
                some = []
                for item in one.items():
                    some.append(item)
                    if len(some) == 100:
                        whole.add(some)
                        some = []
                whole.add(some)


def _reports(parts: Sequence[str], output: str) -> int:
    documents = {part: read_report(Path(part)) for part in parts}
    run = _run_of(parts, documents)
    files: dict[str, tuple[dict[str, Any], str]] = {}
    for part, document in documents.items():
        _agrees(part, document)
        for entry in document["files"]:
            path = entry["path"]
            if path in files:
                other = files[path][1]
                where = f"`{part}` twice" if other == part else f"`{other}` and in `{part}`"
                raise UsageError(f"`{path}` is in {where}", "merge parts of one run, each once")
            files[path] = entry, part
    entries = [files[path][0] for path in sorted(files, key=by_path)]
    tallies = [_tally(entry) for entry in entries]
    try:
        texts = [(e["path"], json.part({key: value for key, value in e.items() if key != "path"})) for e in entries]
    except _MALFORMED:
        raise UsageError("a report holds what JSON of ptmcalc never does", "write the parts anew") from None
    pieces = json.pieces(total(tallies), texts, run)
    if output:
        write(Path(output), pieces)
    else:
        for piece in pieces:
            say(piece)
    return status_at(tallies, Severity(run.fail_level))


def _run_of(parts: Sequence[str], documents: dict[str, dict[str, Any]]) -> json.RunInfo:
    """What the united report says of its run.

    Raises:
        UsageError: the reports are not the parts of one run, each of them once.
    """
    again = "`check --shard I/N -o json=FILE` writes the parts"
    names = list(map(str, map(Path, parts)))
    for name in names:
        if names.count(name) > 1:
            raise UsageError(f"`{name}` is named twice", "name each part once")
    infos: dict[str, json.RunInfo] = {}
    for part, document in documents.items():
        infos[part] = info = _info(part, document)
        if not info.complete:
            raise UsageError(f"the run of `{part}` was interrupted", "run it to its end")
    first, *_ = infos.values()
    for part, info in infos.items():
        if info.fail_level != first.fail_level:
            reason = f"`{part}` has --fail-level {info.fail_level}, `{parts[0]}` has {first.fail_level}"
            raise UsageError(reason, "merge parts of one run")
    shards = {part: info.shard for part, info in infos.items()}
    if not any(shards.values()):
        for part, info in infos.items():
            _has_all(f"`{part}`", len(documents[part]["files"]), info.files)
        left_out, files = (sum(getattr(info, name) for info in infos.values()) for name in ("left_out", "files"))
        return replace(first, left_out=left_out, files=files)
    numbers = {(shard or "1/1").partition("/")[2] for shard in shards.values()}
    if len(numbers) > 1:
        raise UsageError(f"the reports are parts of different runs: {', '.join(map(_said, shards.items()))}", again)
    number = int(numbers.pop())
    found: dict[int, str] = {}
    for part, shard in shards.items():
        index = int((shard or "1/1").partition("/")[0])
        if index in found:
            raise UsageError(f"`{found[index]}` and `{part}` are both part {index}/{number}", "name each part once")
        found[index] = part
    if number > 1 and len(found) < number:
        missing = [f"{index}/{number}" for index in range(1, number + 1) if index not in found][:_NAMED]
        more = number - len(found) - len(missing)
        raise UsageError(
            f"part{'s' if len(missing) > 1 else ''} {', '.join(missing)}{f' and {more} more' * bool(more)}"
            f" of the run {'are' if len(missing) > 1 else 'is'} missing",
            again,
        )
    for part, info in infos.items():
        if info.files != first.files:
            reason = f"`{part}` is part of a run over {info.files} files, `{parts[0]}` of one over {first.files}"
            raise UsageError(reason, again)
    _has_all("all parts together", sum(len(document["files"]) for document in documents.values()), first.files)
    return replace(first, shard=None)


def _has_all(what: str, there: int, all_of_them: int) -> None:
    if there != all_of_them:
        raise UsageError(f"{what}: {there} files of a run over {all_of_them}", "write the parts anew")


_NAMED = 5
"""Missing parts that are named."""


def _said(item: tuple[str, str | None]) -> str:
    return f"`{item[0]}` is {f'part {item[1]}' if item[1] else 'a whole run'}"


def _info(part: str, document: dict[str, Any]) -> json.RunInfo:
    """What a report says of its run."""
    run: Any = document.get("run")
    try:
        info = json.RunInfo(**run)
        index, _, number = ("1/1" if info.shard is None else info.shard).partition("/")
        sound = (
            1 <= int(index) <= int(number)
            and Severity(info.fail_level) is not None
            and isinstance(info.left_out, int)
            and isinstance(info.files, int)
            and isinstance(info.complete, bool)
        )
    except _MALFORMED:
        sound = False
    if not sound:
        reason = f"`{part}` does not state which part of a run it is"
        raise UsageError(reason, "write it anew with this version of ptmcalc")
    return info


def _agrees(part: str, document: dict[str, Any]) -> None:
    """Refuse a report whose verdicts contradict what they are made of.

    Raises:
        UsageError: one does.
    """
    hint = "it was changed after it was written; write it anew"
    for entry in document["files"]:
        verdict = _verdict(entry)
        if entry["verdict"] != verdict:
            reason = f"`{part}`: `{entry['path']}` is called `{entry['verdict']}`, and by its checks is `{verdict}`"
            raise UsageError(reason, hint)
        for scene in entry["scenes"]:
            for check in scene["checks"]:
                if _contradicts(check):
                    where = f"{check['code']} in scene `{scene['name']}` of `{entry['path']}`"
                    raise UsageError(f"`{part}`: {where} is called `pass`, with its value beyond the limit", hint)
    counted = total(map(_tally, document["files"]))
    if document["summary"] != counted:
        differs = next((key for key in counted if document["summary"].get(key) != counted[key]), "summary")
        reason = f"`{part}`: the summary counts {document['summary'].get(differs)} of `{differs}`"
        raise UsageError(f"{reason}, its files make {counted.get(differs)}", hint)


def _verdict(entry: dict[str, Any]) -> str:
    """The verdict of a file by its checks and findings, as `FileReport.verdict` has it."""
    if any(one["severity"] == Severity.ERROR for one in entry["diagnostics"]):
        return "invalid"
    found = {check["verdict"] for scene in entry["scenes"] for check in scene["checks"]}
    if Verdict.FAIL in found:
        return "fail"
    if found & {Verdict.UNDECIDED.value, Verdict.NOT_CHECKED.value}:
        return "undecided"
    return "pass" if found - {Verdict.OFF.value} or entry.get("computed") is False else "undecided"


def _contradicts(check: dict[str, Any]) -> bool:
    """Whether a check is said to pass, and its value lies beyond its limit."""
    value, limit = check["value"], check["limit"]
    if check["verdict"] != Verdict.PASS or value is None or limit is None:
        return False
    beyond = limit - value if check["sense"] == Sense.AT_LEAST else value - limit
    return bool(beyond > _ROUNDING * max(abs(value), abs(limit)))


def read_report(path: Path) -> dict[str, Any]:
    """A JSON report of `check`.

    Raises:
        UsageError: it cannot be read, or is none.
    """
    hint = "`check -o json=FILE` writes one"
    try:
        document: Any = reader.loads(path.read_text("utf-8"), parse_constant=_refuse)
        sound = (
            document["tool"]["name"] == "ptmcalc"
            and document["schema_version"] == json.SCHEMA_VERSION
            and isinstance(document["summary"], dict)
            and isinstance(document["files"], list)
            and all(map(_is_entry, document["files"]))
        )
    except OSError as error:
        raise UsageError(f"the report `{path}` cannot be read: {error.strerror}", hint) from None
    except _MALFORMED:
        sound = False
    if not sound:
        raise UsageError(f"`{path}` is not a JSON report of ptmcalc", hint)
    found: dict[str, Any] = document
    return found


def _refuse(word: str) -> float:
    raise ValueError(f"`{word}` is no JSON")


def _is_entry(entry: Any) -> bool:
    """Whether something has the form of the part of a report about a file."""
    _tally(entry)
    texts = (entry["path"], entry["verdict"], entry["kind"], entry["name"])
    lists = (entry["diagnostics"], entry["scenes"], entry["assumed"])
    checks = [check for scene in entry["scenes"] for check in scene["checks"]]
    return (
        all(isinstance(text, str) for text in texts)
        and entry["verdict"] in ("pass", "fail", "undecided", "invalid")
        and all(isinstance(one, list) for one in lists)
        and all(isinstance(scene["name"], str) and isinstance(scene["checks"], list) for scene in entry["scenes"])
        and all(isinstance(one["code"], str) and Severity(one["severity"]) for one in entry["diagnostics"])
        and all(
            isinstance(check["code"], str) and Sense(check["sense"]) and isinstance(_contradicts(check), bool)
            for check in checks
        )
    )


def _tally(entry: dict[str, Any]) -> Tally:
    counts = {verdict.value: 0 for verdict in Verdict}
    for scene in entry["scenes"]:
        for check in scene["checks"]:
            counts[check["verdict"]] += 1
    judged = sum(counts.values()) - counts[Verdict.OFF.value]
    ignored, without = (_count(entry.get(key, 0)) for key in ("ignored", "ignored_checks"))
    is_invalid = entry["verdict"] == "invalid"
    counts |= {"invalid": int(is_invalid), "ignored": ignored}
    severities = [Severity(one["severity"]) for one in entry["diagnostics"]]
    loudest = max(severities, key=lambda one: one.rank).value if severities else ""
    broken = any(one["code"] == BROKEN for one in entry["diagnostics"])
    return Tally(entry["verdict"], counts, loudest, broken, not is_invalid and not judged and without > 0)


def _count(number: Any) -> int:
    if not isinstance(number, int) or isinstance(number, bool) or number < 0:
        raise ValueError("no count")
    return number
