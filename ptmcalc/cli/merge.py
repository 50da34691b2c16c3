"""What `ptmcalc merge` does: reports or stores of the parts of a run become one."""

import json as reader
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ptmcalc.base.diagnostic import BROKEN, Verdict
from ptmcalc.base.errors import UsageError
from ptmcalc.cli.batch import write
from ptmcalc.cli.output import say
from ptmcalc.contract.report import Tally, status_of, total
from ptmcalc.engine.files import by_path
from ptmcalc.engine.store import Store, is_store
from ptmcalc.report import json


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
    files: dict[str, tuple[dict[str, Any], str]] = {}
    for part in parts:
        for entry in read_report(Path(part))["files"]:
            path = entry["path"]
            if path in files and files[path][0] != entry:
                hint = "merge parts of one run over the same files"
                raise UsageError(f"`{path}` has different reports in `{files[path][1]}` and `{part}`", hint)
            files[path] = entry, part
    entries = [files[path][0] for path in sorted(files, key=by_path)]
    tallies = [_tally(entry) for entry in entries]
    texts = ((e["path"], json.part({key: value for key, value in e.items() if key != "path"})) for e in entries)
    pieces = json.pieces(total(tallies), texts)
    if output:
        write(Path(output), pieces)
    else:
        for piece in pieces:
            say(piece)
    return status_of(tallies)


def read_report(path: Path) -> dict[str, Any]:
    """A JSON report of `check`.

    Raises:
        UsageError: it cannot be read, or is none.
    """
    hint = "`check -o json=FILE` writes one"
    try:
        document: Any = reader.loads(path.read_text("utf-8"))
        sound = (
            document["tool"]["name"] == "ptmcalc"
            and document["schema_version"] == json.SCHEMA_VERSION
            and all(
                isinstance(entry["path"], str) and entry["verdict"] and _tally(entry) for entry in document["files"]
            )
        )
    except OSError as error:
        raise UsageError(f"the report `{path}` cannot be read: {error.strerror}", hint) from None
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        sound = False
    if not sound:
        raise UsageError(f"`{path}` is no JSON report of ptmcalc", hint)
    found: dict[str, Any] = document
    return found


def _tally(entry: dict[str, Any]) -> Tally:
    counts = {verdict.value: 0 for verdict in Verdict}
    for scene in entry["scenes"]:
        for check in scene["checks"]:
            counts[check["verdict"]] += 1
    counts |= {"invalid": int(entry["verdict"] == "invalid"), "ignored": entry.get("ignored", 0)}
    return Tally(entry["verdict"], counts, broken=any(one["code"] == BROKEN for one in entry["diagnostics"]))
