"""A terminal of 80 x 24 or 120 x 40 shows the verdict of a machine and its reason without a turn of the wheel."""

import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from unittest import mock

import pytest
from support.command import ROOT
from support.turns import share_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.span import dotted
from ptmcalc.cli.batch import rendered
from ptmcalc.contract.report import FileReport
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text
from ptmcalc.report import Format, words

SCREENS = [(80, 24), (120, 40)]
TOO_WEAK = {
    "short_conveyor": ("tension: 13 kN", "tension: 9 kN", "takeup.tension"),
    "chain_drive": ("joint_pressure: 25 MPa", "joint_pressure: 9 MPa", "chain.pin_diameter"),
    "hoist": ("length: 640 mm", "length: 600 mm", "drum.flange_height"),
    "drivetrain": ("stop_time: 1.5 s", "stop_time: 0.55 s", "brakes.brake.torque"),
    "shaft": ("brake: {torque: 5.5 kN*m", "brake: {torque: 4 kN*m", "brake.torque"),
    "crane_slewing": ("sway: 15 deg", "sway: 10 deg", "speed"),
    "crane_travelling": ("stroke: 180 mm", "stroke: 120 mm", "buffers.stroke"),
    "crane_overhead_stacker": ("collision_speed: 1 m/s", "collision_speed: 0.8 m/s", "bridge_travel.speed"),
    "crane_rack_stacker": ("largest_speed: 2.2 m/s", "largest_speed: 1.8 m/s", "travel.speed"),
}
"""One machine of each kind and type, a change of one key that a check does not let pass, the key whose value would."""


@pytest.fixture(scope="module", params=share_of(3, list(TOO_WEAK)))
def machine(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(scope="module", params=[Verdict.PASS, Verdict.FAIL], ids=["passing", "failing"])
def report(request: pytest.FixtureRequest, machine: str) -> FileReport:
    text, (sound, weak, key) = (ROOT / "specs" / f"{machine}.yaml").read_text("utf-8"), TOO_WEAK[machine]
    assert text.count(sound) == 1
    made = text if request.param is Verdict.PASS else text.replace(sound, weak)
    found = check(load_text(made.encode(), f"specs/{machine}.yaml"), Options(courses=True))
    assert found.verdict == request.param.value
    repair = words.worst_first(found)[0][1].repair
    assert (dotted(repair.path) if repair else "") == (key if request.param is Verdict.FAIL else "")
    return found


@contextmanager
def _terminal(width: int, height: int) -> Iterator[None]:
    with mock.patch.dict(os.environ, {"COLUMNS": str(width), "LINES": str(height)}):
        yield


def _on_screen(report: FileReport, width: int, height: int) -> list[str]:
    """The lines as a terminal shows them, its colours taken away."""
    with _terminal(width, height):
        text = "".join(rendered(Format.TABLE, [report], verbose=False, to_terminal=True))
    return re.sub(r"\x1b\[[0-9;]*m", "", text).splitlines()


@pytest.mark.parametrize(("width", "height"), SCREENS)
def test_the_verdict_and_its_reason_stand_on_the_first_screen(report: FileReport, width: int, height: int) -> None:
    lines = _on_screen(report, width, height)
    first = " ".join(" ".join(lines[: height - 1]).split())  # the last line of a screen is the prompt
    scene, worst = words.worst_first(report)[0]
    assert worst.value is not None
    assert worst.limit is not None
    place = f"({report.path}:{words.place(worst.blame.span)})"
    told = [
        report.verdict.upper(),
        f"{worst.verdict.value} {worst.code} {words.subject(worst)}, {scene}:",
        f"{words.number(worst.value.value, worst.quantity).split()[0]}",
        f"limit {words.SIGN[worst.sense]} {words.amount(worst.limit, worst.quantity)}",
        *([f"margin {words.margin(worst)}"] if not (worst.reason and (worst.margin or 0) >= 0) else []),
        f"governing key: {dotted(worst.blame.path)} {place}",
    ]
    if worst.repair:
        value = words.number(worst.repair.value, worst.repair.quantity)
        told.append(f"passes with {dotted(worst.repair.path)} = {value}")
    where = 0
    for part in told:
        found = first.find(part, where)
        assert found >= 0, (part, first)
        where = found


@pytest.mark.parametrize(("width", "height"), SCREENS)
def test_nothing_is_wider_than_the_screen_or_cut(report: FileReport, width: int, height: int) -> None:
    lines = _on_screen(report, width, height)
    assert max(map(len, lines)) <= width
    assert not [line for line in lines if "…" in line]
    said = " ".join(" ".join(lines).split())
    for title in {words.subject(judgement).split()[0] for _, judgement in report.judgements}:
        assert title in said


@pytest.mark.parametrize(("width", "height"), SCREENS)
def test_no_number_of_a_check_is_parted_from_its_unit(report: FileReport, width: int, height: int) -> None:
    """`≤ 100` above `%` is read as another limit."""
    lines = _on_screen(report, width, height)
    begin = next(index for index, line in enumerate(lines) if line.startswith("Checks  "))
    table = lines[begin : lines.index("", begin)]
    start, end = table[0].index("limit"), table[0].index("margin")
    limits = [cell for line in table[2:] if (cell := line[start:end].strip())]
    assert limits
    assert all(re.fullmatch(r"[≤≥] \S.*", limit) for limit in limits), limits
    margins = [cell for line in table[2:] if (cell := line[end:].split("   ")[0].strip())]
    assert all(re.match(r"[+-]\d\S* \S+|[+-]\d\S*$|unlimited|none", margin) for margin in margins if margin), margins


def test_an_interval_is_not_shown_where_its_ends_are_the_number(report: FileReport) -> None:
    text = "\n".join(_on_screen(report, 120, 40))
    for middle, low, high in re.findall(r"(\S+)\s+\[(\S+), (\S+)\]", text):
        assert not middle == low == high
