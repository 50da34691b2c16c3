"""A conveyor that rises after its second loading point: that point turns verdicts."""

import pytest
from support.edges import judged, load, report_on, verdict

from ptmcalc.base.diagnostic import Verdict

NAME = "conveyor/rises-after-second-point"
TAIL_ALONE = (
    ("- {type: run}", "- {type: run, loading_points: [tail_hopper]}"),
    ("- {type: backstop}", "- {type: backstop, loading_points: [tail_hopper]}"),
)
F_C_G = 0.02 * 1.2 * 9.81
G = 9.81


def test_tensions_are_those_computed_by_hand() -> None:
    """The case of `docs/theory.md`: 34.93 kN of both points, 25.51 kN of the side belt alone."""
    both, side = F_C_G * (28 * 600 + 65 * 300 + 115 * 300) + 75 * G * 24 + 600, F_C_G * (28 * 600 + 40 * 300 + 90 * 300)
    side += 50 * G * 24 + 600
    assert both == pytest.approx(34_927, abs=1)
    assert side == pytest.approx(25_510, abs=1)
    assert load(report_on(NAME), "effective_tension").value == pytest.approx(both, rel=1e-12)
    found = report_on(NAME, ("- {type: run}", "- {type: run, loading_points: [side_belt]}"))
    assert load(found, "effective_tension").value == pytest.approx(side, rel=1e-12)
    assert load(found, "tension_run_on_max").value == pytest.approx(50e3 + side, rel=1e-12)


def test_the_second_point_turns_the_backstop() -> None:
    """24 m 9.81 (25 or 75) kg/m less half the friction, over 0.5 m: 0.1 kN*m and 5.1 kN*m, of 5 kN*m/1.25."""
    friction = F_C_G * (28 * 600 + 40 * 300)
    for changes, load_on, expected in ((TAIL_ALONE, 25, Verdict.PASS), ((), 75, Verdict.FAIL)):
        found = report_on(NAME, *changes)
        held = 24 * G * load_on - 0.5 * (friction + F_C_G * (40 + load_on) * 300)
        assert load(found, "backstop_torque").value == pytest.approx(held / 2, rel=1e-12)
        assert verdict(found, "CNV109") is expected


def test_a_scene_without_a_backstop_scene_asks_for_the_worst_of_all_scenes() -> None:
    """A stop of the tail hopper alone, next to a run of both points."""
    found = report_on(NAME, ("- {type: backstop}", "- {type: coast, loading_points: [tail_hopper]}"))
    assert load(found, "backstop_torque").value == load(report_on(NAME), "backstop_torque").value


def test_the_second_point_turns_the_sag() -> None:
    """95 kg/m behind the side belt sag more than 45 kg/m at the tail, although the belt is tighter there."""
    alone = report_on(NAME, *TAIL_ALONE)
    tail = 50e3 + F_C_G * 28 * 600 - 20 * G * 24
    joint = tail + F_C_G * 65 * 300
    sags = {"tail": 45 * G * 1.2 / 8 / tail, "both": 95 * G * 1.2 / 8 / joint}
    assert sags["tail"] < 0.0025 < sags["both"]
    assert load(alone, "sag_strand_max[carry]").value == pytest.approx(sags["tail"], rel=1e-9)
    assert judged(alone, "CNV131", element="carry").verdict is Verdict.PASS
    found = report_on(NAME)
    assert load(found, "sag_strand_max[carry]").value == pytest.approx(sags["both"], rel=1e-9)
    assert judged(found, "CNV131", element="carry").verdict is Verdict.FAIL


def test_points_without_operation_of_one_are_a_belt_with_the_other() -> None:
    """The tail hopper alone, and a file with nothing but its capacity."""
    alone = report_on(NAME, *TAIL_ALONE)
    plain = report_on(
        NAME,
        ("  loading_points:\n", "  capacity: 100 kg/s\n"),
        ("    tail_hopper: {at: 0 m, capacity: 100 kg/s}\n", ""),
        ("    side_belt: {at: 300 m, capacity: 200 kg/s, speed: 1 m/s}\n", ""),
    )
    for name in ("tension_run_on_max", "effective_tension", "sag_relative_max", "backstop_torque"):
        assert load(alone, name).value == pytest.approx(load(plain, name).value, rel=1e-12)
