"""Snapshots of every format: what a reader sees changes only on purpose.

The files stand in `tests/golden/`. To write them anew, and then to read the difference before it is committed:

    python tests/update.py golden

Numbers may differ as far as another processor or mathematical library makes them: floats of the JSON by 1e-6 of
their value, decimals of a text by one unit of their last digit.
"""

import csv
import itertools
import json
import os
import re
from decimal import Decimal
from pathlib import Path
from typing import Any

import pytest
from support.command import ROOT, report_of_file

from ptmcalc.report import Format, render

GOLDEN = ROOT / "tests" / "golden"
MACHINES = {"conveyor": "specs/conveyor.yaml", "slipping": "tests/cli/specs/slipping.yaml"}
SIMULATED = {
    "crane_slewing": "specs/crane_slewing.yaml",
    "crane_runway": "specs/crane/bridge_crane_runway.yaml",
    "two_loading_points": "specs/conveyor/two_loading_points.yaml",
}
"""Their verdicts alone are stored: steps of a simulation, and what its energy balance leaves over, are rounding's."""
IN_CI = (Format.JUNIT, Format.SARIF, Format.GITHUB, Format.MARKDOWN, Format.SUMMARY)
"""Formats of continuous integration and of many files, stored of the machine that fails."""
VIEWS = {"table": (Format.TABLE, False), "table.verbose": (Format.TABLE, True), "plain": (Format.PLAIN, False)} | {
    form.value: (form, False) for form in IN_CI
}
OF_ALL = ("table", "table.verbose", "plain")
CLOSE = 1e-6
STORED_DIGITS = 9  # more than are compared, so that rounding cannot make two close numbers differ
NOISE = ("energy_residual", "grid_mismatch")  # differences of large numbers: only their size means something
DECIMAL = re.compile(r"[-+]?[0-9]+\.[0-9]+(?:e[-+][0-9]+)?")


def golden(path: Path, text: str) -> str:
    """The snapshot, written first when asked for."""
    if os.environ.get("PTMCALC_UPDATE"):
        path.write_text(text, encoding="utf-8")
    return path.read_text("utf-8")


def rounded(node: Any) -> Any:
    """A document with as many digits as are worth storing, and without the version, which changes on its own."""
    if isinstance(node, dict):
        return {key: "..." if key == "version" else rounded(value) for key, value in node.items()}
    if isinstance(node, list):
        return [rounded(item) for item in node]
    return float(f"{node:.{STORED_DIGITS}g}") if isinstance(node, float) else node


def own(document: Any) -> Any:
    """A document without the effects that its machine does not have: the JSON lists each effect of the kind, so that
    a further one of another machine would change it. The files of other machines hold those."""
    for scene in (scene for file in document["files"] for scene in file["scenes"]):
        absent = {effect["name"] for effect in scene["effects"] if effect.get("absent")}
        scene["effects"] = [effect for effect in scene["effects"] if effect["name"] not in absent]
        for solver in scene["solvers"]:
            solver["effects"] = [name for name in solver["effects"] if name not in absent]
    return document


def assert_close(found: Any, stored: Any, place: str = "") -> None:
    if isinstance(stored, dict):
        assert list(found) == list(stored), place
        for key in stored:
            assert_close(found[key], stored[key], f"{place}.{key}")
    elif isinstance(stored, list):
        assert len(found) == len(stored), place
        for index, (one, other) in enumerate(zip(found, stored, strict=True)):
            assert_close(one, other, f"{place}[{index}]")
    elif place.endswith(NOISE):
        assert found == pytest.approx(stored, rel=1.0, abs=1e-9), place
    elif isinstance(stored, float) and isinstance(found, float):
        assert found == pytest.approx(stored, rel=CLOSE, abs=1e-9), place
    else:
        assert found == stored, place


@pytest.mark.parametrize("name", MACHINES)
def test_json(name: str) -> None:
    found = rounded(own(json.loads(render(Format.JSON, [report_of_file(MACHINES[name])]))))
    text = json.dumps(found, indent=2, ensure_ascii=False) + "\n"
    assert_close(found, json.loads(golden(GOLDEN / f"{name}.json", text)))


@pytest.mark.parametrize(
    ("name", "view"),
    [
        *itertools.product(MACHINES, OF_ALL),
        *itertools.product(("slipping",), (form.value for form in IN_CI)),
        *((name, "plain") for name in SIMULATED),
    ],
)
def test_text(name: str, view: str) -> None:
    form, verbose = VIEWS[view]
    found = render(form, [report_of_file((MACHINES | SIMULATED)[name])], verbose=verbose)
    stored = golden(GOLDEN / f"{name}.{view}.txt", found)
    assert DECIMAL.sub("0.0", found) == DECIMAL.sub("0.0", stored)
    for one, other in zip(DECIMAL.findall(found), DECIMAL.findall(stored), strict=True):
        last_digit = max(Decimal(1).scaleb(int(Decimal(number).as_tuple().exponent)) for number in (one, other))
        assert abs(Decimal(one) - Decimal(other)) <= last_digit, f"{one} where {other} is stored"


def test_csv() -> None:
    found = render(Format.CSV, [report_of_file(MACHINES["slipping"])])
    lines, stored = (list(csv.reader(text.splitlines())) for text in (found, golden(GOLDEN / "slipping.csv", found)))
    assert [len(line) for line in lines] == [len(line) for line in stored]
    for one, other in zip(itertools.chain(*lines), itertools.chain(*stored), strict=True):
        if DECIMAL.fullmatch(other):
            assert float(one) == pytest.approx(float(other), rel=CLOSE, abs=1e-9)
        else:
            assert one == other


def test_every_snapshot_belongs_to_a_test() -> None:
    expected = {f"{name}.json" for name in MACHINES}
    expected |= {f"{name}.{view}.txt" for name in MACHINES for view in OF_ALL}
    expected |= {f"slipping.{form.value}.txt" for form in IN_CI}
    expected |= {f"{name}.plain.txt" for name in SIMULATED} | {"slipping.csv"}
    assert {path.name for path in GOLDEN.iterdir()} == expected


def test_every_format_has_snapshots() -> None:
    assert {form for form, _ in VIEWS.values()} | {Format.JSON, Format.CSV} == set(Format)
