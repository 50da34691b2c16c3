"""Questions that designers ask in public, each answered by one file of this folder; docs/questions.md has the answers.

The numbers here are computed by hand, or bounded by a simpler model.
"""

import math
from functools import partial
from pathlib import Path

import pytest
from scipy.optimize import brentq
from support import edges
from support.edges import judged, load

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import Judgement

G = 9.80665
RPM = math.pi / 30


report_on = partial(edges.report_on, folder=Path(__file__).parent)


def value_of(one: Judgement) -> float:
    assert one.value is not None
    return one.value.value


def test_the_backstop_of_an_inclined_conveyor_holds_the_stalled_motor() -> None:
    """Breakdown torque through the gear; without that case the lift less half of the friction."""
    motor = 2.6 * 132e3 / (1485 * RPM) * 31.5 * 0.94
    one = judged(report_on("backstop_size"), "CNV109")
    assert one.verdict is Verdict.FAIL
    assert value_of(one) == pytest.approx(motor, rel=1e-3)
    lift = 110 * G * 30
    friction = 1.3 * 0.022 * G * 200 * (2 * 18 + 110 + 22 / 1.2 + 18 / 3)
    other = judged(report_on("backstop_size", ("stalled_motor: on", "stalled_motor: off")), "CNV109")
    assert other.verdict is Verdict.PASS
    assert value_of(other) == pytest.approx((lift - friction / 2) * 0.4, rel=0.02)


def test_the_take_up_travel_is_the_sum_of_its_shares() -> None:
    """Installation, permanent and thermal elongation over the length of the conveyor; start and stop add to it."""
    slow = 1.5 + 0.008 * 400 + 40 * 4e-5 * 400
    report = report_on("takeup_travel")
    running, starting, stopping = (
        value_of(judged(report, "CNV140", scene)) for scene in ("run_loaded", "start_loaded", "stop_loaded")
    )
    stretch = 400 * (1.2 * 0.022 * G * 400 * (2 * 18 + 100 + 22 / 1.2 + 20 / 3)) / 8e6
    assert slow < running < slow + stretch
    assert running < stopping < starting
    assert judged(report, "CNV140", "start_loaded").verdict is Verdict.FAIL
    assert judged(report, "CNV140", "run_loaded").verdict is Verdict.PASS


def test_the_tail_of_a_long_conveyor_runs_on_until_the_wave_of_the_brake_arrives() -> None:
    """At full speed for the travel time of the wave along the loaded strand."""
    report = report_on("tail_runs_on")
    head, most = load(report, "stop_distance").value, load(report, "stop_distance_max").value
    carried = 1500 / 3.6 / 3 + 20 + 20 / 1.2
    wave = math.sqrt(9000e3 * 1.2 / carried)
    assert most - head == pytest.approx(3 * 1500 / wave, rel=0.1)
    assert judged(report, "CNV106").verdict is Verdict.FAIL
    assert value_of(judged(report, "CNV106")) == most


def test_a_level_conveyor_runs_backward_by_its_stretch() -> None:
    """No more than the stretch of the belt at the tension of steady running; a backstop prevents it."""
    one = judged(report_on("level_belt_runs_back"), "CNV124")
    stretch = 900 * 1.1 * 0.022 * G * 900 * (2 * 18 + 100 + 22 / 1.2 + 20 / 3) / 8e6
    assert one.verdict is Verdict.FAIL
    assert 0.1 < value_of(one) < stretch
    held = report_on("level_belt_runs_back", ("scenes:", "backstop: {torque: 30 kN*m}\nscenes:"))
    assert "CNV124" not in {one.code for _, one in held.judgements if one.verdict is Verdict.FAIL}


def test_pulleys_of_1000_and_990_mm_share_the_load_by_the_slip_of_their_motors() -> None:
    """Kloss's formula for each motor, the belt slower behind the first pulley by its stretch."""
    carried = 2400 / 3.6 / 4
    friction = 1.09 * 0.022 * G * 800 * (2 * 20 + carried + 26 + 40 / 3)
    force, rated = friction + carried * G * 40, 400e3 / (1480 * RPM)
    slip = 20 / 1500
    breakdown = slip * (2.4 + math.sqrt(2.4**2 - 1))

    def pull(speed: float, radius: float) -> float:
        at = 1 - speed * 20 / radius / (1500 * RPM)
        return 2 * 2.4 * rated / (at / breakdown + breakdown / at) * 20 * 0.94 / radius

    def both(speed: float) -> tuple[float, float]:
        first = pull(speed, 0.5)
        return first, pull(speed * (1 - first / 90e6), 0.495)

    speed = brentq(lambda one: sum(both(one)) - force, 3.8, 3.92)
    shares = [one * radius / (20 * 0.94 * rated) for one, radius in zip(both(speed), (0.5, 0.495), strict=True)]
    report = report_on("unequal_pulleys")
    for name, share in zip(("primary", "secondary"), shares, strict=True):
        assert value_of(judged(report, "CNV122", element=name)) == pytest.approx(share, rel=0.02)


def test_a_decline_belt_slips_on_its_brake() -> None:
    """What the load pulls exceeds the most that the belt transmits to the braked pulley, T2 (1 - exp(-mu alpha))."""
    one = judged(report_on("decline_belt_slips"), "CNV106")
    assert one.verdict is Verdict.FAIL
    assert "slips on the braked pulley `head` and does not stop" in one.reason
    carried, most = 1500 / 3.6 / 2.5, 60e3 * (1 - math.exp(-0.35 * math.radians(210)))
    friction = 1.2 * 0.02 * G * 400 * (2 * 18 + carried + 22 / 1.2 + 18 / 3)
    assert carried * G * 40 - friction > most


def test_a_chain_is_chosen_by_its_number() -> None:
    """Design power by ISO 10823: 1.4 for moderate shocks behind a smooth drive, (19/21)^1.08 for the teeth."""
    report = report_on("chain_by_number")
    assert value_of(judged(report, "CHN113")) == pytest.approx(3e3 * 1.4 * (19 / 21) ** 1.08, rel=1e-3)
    assert {one.verdict for _, one in report.judgements} == {Verdict.PASS}


def test_a_slack_span_whips_when_the_shaft_turns_at_its_first_mode() -> None:
    """A string at a sag of 2 %: f = (g/(8 l 0.02))^(1/2)/2; the drive shaft turns v/(z p) times a second."""
    report = report_on("chain_whips")
    first, shaft = math.sqrt(G / (8 * 0.78 * 0.02)) / 2, 2.2 / (21 * 0.0254)
    assert abs(first / shaft - 1) < 0.15
    assert judged(report, "CHN132").verdict is Verdict.FAIL
    slower = report_on("chain_whips", ("speed: 2.2 m/s", "speed: 1.5 m/s"))
    assert judged(slower, "CHN132").verdict is Verdict.PASS


def test_an_aborted_start_of_a_converter_is_repeated_without_slack() -> None:
    """The backstop holds the belt in the pause; the second start raises no more tension than the belt bears."""
    report = report_on("aborted_converter_start")
    for code in ("CNV101", "CNV102", "CNV104", "CNV105", "CNV109"):
        assert judged(report, code).verdict is Verdict.PASS, code


def test_a_weight_at_the_tail_leaves_less_tension_at_the_drive_pulley() -> None:
    """Less by what a start takes for friction and acceleration of the return strand."""
    at_tail = report_on("takeup_at_tail")
    assert judged(at_tail, "CNV101", "start_loaded").verdict is Verdict.FAIL
    at_head = report_on("takeup_at_tail", ("at: tail, ", ""))
    assert judged(at_head, "CNV101", "start_loaded").verdict is Verdict.PASS
    enough = report_on("takeup_at_tail", ("tension: 25 kN, mass: 5.1 t", "tension: 32 kN, mass: 6.53 t"))
    assert judged(enough, "CNV101", "start_loaded").verdict is Verdict.PASS
