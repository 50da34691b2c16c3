"""Hoists whose means, defaults or warnings once hid a failure, with the right values."""

import math

import pytest
from support.edges import codes, judged, load, report_on, verdict

from ptmcalc.base.diagnostic import Verdict


def test_a_motor_that_lowers_the_load_it_lifts_fails() -> None:
    """25.1 N m at standstill against 37.4 N m of the load; the mean over the curve would be 1.581 times that."""
    found = report_on("hoist/hoist-sinks")
    one = judged(found, "HST114")
    assert one.verdict is Verdict.FAIL
    assert one.value is not None
    assert one.value.value == pytest.approx(25.1 / 37.4, rel=2e-3)
    assert "the load descends" in one.reason
    assert "NUM110" not in codes(found)


def test_a_rope_that_goes_slack_after_a_release_fails() -> None:
    """Of 70 % let off at once the rope force would go to m g (1 - 2 x 0.7) < 0."""
    found = report_on("hoist/release-slack")
    one = judged(found, "HST126", "quick")
    assert one.verdict is Verdict.FAIL
    assert "slack" in one.reason
    assert verdict(found, "HST126", "slow") is Verdict.UNDECIDED


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ((), math.hypot(2.0, 1.0905)),
        ((("delay: 0 s", "delay: 0.5 s"), ("rise_time: 0 s", "rise_time: 0.2 s")), 3.0),
    ],
)
def test_a_load_that_is_lowered_already_drops_faster(changes: tuple[tuple[str, str], ...], expected: float) -> None:
    """v^2 = v_0^2 + 2 a h, with what it gains until the brake acts."""
    found = report_on("hoist/drop_speed", *changes)
    speed = load(found, "drop_speed").value
    assert speed == pytest.approx(expected, rel=2e-4 if not changes else 0.1)


def test_the_rope_takes_part_in_the_oscillation_of_the_load() -> None:
    """B tan B = m_r/M, solved by bisection here: 3.5185 rad/s."""
    found = report_on("hoist/run_frequency_heavy_rope")
    stiffness, massless = load(found, "rope_stiffness", "run").value, 3.836
    mass = stiffness / massless**2
    ratio = 0.55
    low, high = 0.0, math.pi / 2
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if middle * math.tan(middle) < ratio else (low, middle)
    expected = low * math.sqrt(stiffness / (ratio * mass))
    assert load(found, "natural_frequency", "run").value == pytest.approx(3.5185, abs=5e-5)
    assert expected == pytest.approx(3.5185, rel=5e-3)


def test_a_drum_that_takes_in_most_of_the_rope_is_computed() -> None:
    found = report_on("hoist/winding_three_quarters")
    assert not any("more rope than is free" in one.message for one in found.diagnostics)


@pytest.mark.parametrize("time", [1.0, 5.0])
def test_the_start_takes_the_time_of_its_profile(time: float) -> None:
    """By its formula: no simulation is waited for."""
    found = report_on("hoist/hoist-start-time", ("time: 1 s", f"time: {time:g} s"), budget=0.2)
    assert load(found, "start_time").value == pytest.approx(time, rel=1e-9)


def test_a_limiter_that_stops_an_overload_works_as_it_should() -> None:
    found = report_on("hoist/limiter")
    assert all(one.code != "HST121" for _, one in found.judgements)
    assert "NUM110" not in codes(found)
    assert "NUM113" in codes(found)


def test_effects_that_cannot_be_simulated_together_are_refused() -> None:
    found = report_on("hoist/huge-drum")
    assert found.verdict == "invalid"
    assert {one.code for one in found.diagnostics if one.severity.rank == 2} == {"SPC205"}


def test_an_absurd_drum_is_an_answer() -> None:
    found = report_on("hoist/huge-drum", ("  drive_motion: on", "  drive_motion: auto"))
    assert found.scenes
