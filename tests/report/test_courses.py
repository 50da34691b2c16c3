"""Curves one line high beside the loads, and the signs of a table where only ASCII can be shown."""

import math

import pytest
from support.command import ROOT, environment, ptmcalc, python

from ptmcalc.base.units import FORCE
from ptmcalc.cli.output import PLAIN
from ptmcalc.contract.result import History
from ptmcalc.report.words import sparkline


def history(times: list[float], values: list[float]) -> History:
    return History(FORCE, times, values)


def test_a_course_keeps_the_peak_of_each_part_however_short_it_is() -> None:
    times = [k / 1000 for k in range(1001)]
    values = [100.0 if k == 437 else -50.0 if k == 812 else 0.0 for k in range(1001)]
    assert history(times, values).course(10) == (0, 0, 0, 0, 100.0, 0, 0, 0, -50.0, 0)


def test_parts_without_a_sample_keep_the_value_before() -> None:
    assert history([0.0, 0.1, 10.0], [1.0, 2.0, 5.0]).course(5) == (1.0, 1.0, 1.0, 1.0, 5.0)


@pytest.mark.parametrize("values", [[], [3.0, 3.0, 3.0], [math.nan, math.nan], [math.inf, 2.0]])
def test_what_does_not_move_has_no_course(values: list[float]) -> None:
    assert history([float(k) for k in range(len(values))], values).course(8) == ()


def test_times_in_any_order_and_one_sample_break_nothing() -> None:
    assert history([2.0, 1.0, 0.0], [3.0, 2.0, 1.0]).course(3) == (1.0, 2.0, 3.0)
    assert history([1.0], [3.0]).course(3) == ()


def test_a_line_goes_from_the_least_to_the_largest() -> None:
    assert sparkline((0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0)) == "▁▂▃▄▅▆▇██"
    assert sparkline((5.0, -5.0, 0.0)) == "█▁▅"
    assert sparkline(()) == ""


TABLE = ("check", str(ROOT / "specs" / "hoist.yaml"), "--scene", "lift_loaded", "--format", "table")


def test_the_table_of_one_file_shows_courses_and_one_of_a_folder_does_not() -> None:
    shown = ptmcalc(*TABLE).out
    assert "over time" in shown
    assert "█" in shown
    winding = ptmcalc("check", str(ROOT / "specs" / "hoist"), "--format", "table", "--exclude", "crane_*").out
    assert "over time" not in winding


def test_on_a_terminal_of_ascii_the_signs_of_a_table_have_others_and_no_column_shifts() -> None:
    signs = ptmcalc(*TABLE).out.splitlines()
    run = python("-m", "ptmcalc", *TABLE, cwd=ROOT, env=environment(ROOT, PYTHONIOENCODING="ascii"))
    plain = run.out.splitlines()
    assert run.out.isascii()
    assert [len(line) for line in plain] == [len(line) for line in signs]
    assert any(">=" in line or "<=" in line for line in plain)
    assert any("+-" in line for line in plain)


def test_each_sign_has_another_of_its_width() -> None:
    assert all(len(sign) == len(other) and other.isascii() for sign, other in PLAIN)
