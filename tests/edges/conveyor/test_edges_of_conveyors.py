"""Belts whose defaults, windows or means once decided silently, with the right values."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.belt_scenes import Drive, Rig
from support.edges import codes, judged, load, report_on, verdict

from ptmcalc.base.diagnostic import Verdict

G = 9.81


PLANT = Rig(
    sections=((240.0, 18.0),),
    belt=15.0,
    stiffness=7e6,
    carry_idlers=22 / 1.2,
    back_idlers=18 / 3,
    load=900 / 3.6 / 2.5,
    friction=0.022,
    secondary=1.4,
    start_factor=1.2,
    speed=2.5,
    drives={
        "head": Drive(
            torque=900.0, rotor=1.65, ratio=24.8, efficiency=0.95, diameter=0.8, wrap=math.radians(200), drum=60.0
        )
    },
    tension=30e3,
    tail_inertia=25.0,
    tail_diameter=0.63,
)
"""`takeup-mass` as finite elements"""


def reserve_left(rig: Rig, window: float, elements: int) -> float:
    """Least of what grip allows over what it carries, at any moment of a start by a step of torque."""
    drive = rig.drives["head"]
    assert drive.friction is not None
    ends = np.array(rig.started(lambda time: 1.0, window, elements).head.between)
    tight, slack = ends.max(axis=1), ends.min(axis=1)
    return float(np.min(math.expm1(drive.friction * drive.wrap) / (tight / slack - 1)))


def test_a_gravity_take_up_without_mass_has_the_weight_of_its_tension() -> None:
    """Finite elements with a weight of 2 T/g; without its inertia they leave 1.248."""
    found = report_on("conveyor/takeup-mass", ("  mass: 6116 kg\n", ""))
    (assumed,) = (one for one in found.assumed if one.path == ("takeup", "mass"))
    assert assumed.value == pytest.approx(2 * 30e3 / G, rel=1e-9)
    one = judged(found, "CNV101", "start_loaded")
    assert one.verdict is Verdict.FAIL
    assert one.value is not None
    (start,) = (scene for scene in found.scenes if scene.name == "start_loaded")
    (window,) = (load.window for load in start.loads if load.info.name == "slip_reserve_min")
    assert window is not None
    heavy = replace(PLANT, weight=2 * 30e3 / G)
    coarse, fine = (reserve_left(heavy, window[1], elements) for elements in (200, 400))
    own = 2 * abs(fine - coarse)
    assert own < 0.02
    assert one.value.low - own <= fine <= one.value.high + own
    assert one.value.value == pytest.approx(fine, rel=0.02)
    assert reserve_left(PLANT, window[1], 200) > 1.05 * one.value.high


def test_half_of_the_resistance_holds_a_stopped_belt() -> None:
    """f C g L (2 m_B + idlers + load)/2 against the climb of the load, by hand: 4.90 kN m on the head pulley."""
    found = report_on("conveyor/no-backstop")
    load_line, length = 1500 / 3.6 / 2.5, 400.0
    one = judged(found, "CNV109")
    assert one.verdict is Verdict.FAIL
    assert one.value is not None
    climb = load_line * G * 16
    friction = 2 * (climb - one.value.value / 0.4)
    plain = 0.025 * G * length * (2 * 18 + 22 / 1.2 + 18 / 3 + load_line)
    assert 1.2 < friction / plain < 1.3, "the factor C of a belt of 400 m"
    assert one.value.value == pytest.approx(4901, rel=1e-3)


def test_closed_brakes_hold_a_stopped_belt() -> None:
    """Through the gear with its ratio alone: at standstill its losses are not guaranteed."""
    one = judged(report_on("conveyor/brake-hold"), "CNV109")
    assert one.verdict is Verdict.PASS
    assert one.limit is not None
    assert one.limit.value == pytest.approx(3000 * 25 / 1.25, rel=1e-9)


def test_losses_of_a_gear_hold_no_stopped_belt() -> None:
    """10.44 kN m pull back: 440 N m through a ratio of 28 hold 9.86 kN m with the reserve, 11.6 kN m with losses."""
    brake = ("brakes:", "scenes: [{type: backstop}]\nbrakes:")
    one = judged(report_on("conveyor/standing-uphill", brake), "CNV109")
    assert one.verdict is Verdict.FAIL
    assert one.value is not None
    assert one.value.value == pytest.approx(10435, rel=1e-3)
    enough = report_on("conveyor/standing-uphill", brake, ("torque: 440 N*m", "torque: 467 N*m"))
    assert judged(enough, "CNV109").verdict is Verdict.PASS


def test_a_belt_runs_back_after_a_controlled_stop_too() -> None:
    stop = ("brakes: {disc: {torque: 440 N*m, shaft: motor}}", "scenes: [{type: controlled_stop, time: 10 s}]")
    one = judged(report_on("conveyor/standing-uphill", stop), "CNV109")
    assert one.verdict is Verdict.FAIL
    assert "neither a backstop nor a brake holds it" in one.reason


def test_a_loaded_belt_that_stands_runs_forward_by_its_slope() -> None:
    """300 m down 45 m with 101 kg/m: 44.6 kN less half of the friction, 15.9 kN m on the head pulley."""
    load, friction = 800 / 3.6 / 2.2, 1.3 * 0.016 * G * 300
    slope = math.sqrt(1 - 0.15**2)
    rubs = friction * ((2 * 16 + load) * slope + 22 / 1.2 + 18 / 3)
    pull = (load * G * 45 - rubs / 2) * 0.4
    down = ("{length: 150 m, lift: 30 m}", "{length: 300 m, lift: -45 m}")
    down_at = ("coefficient: 0.022, secondary: 1.45", "coefficient: 0.016, secondary: 1.3")
    stands = ("brakes:", "backstop: {torque: 60 kN*m}\nscenes: [{type: backstop}]\nbrakes:")
    found = report_on("conveyor/standing-uphill", down, down_at, stands)
    assert judged(found, "CNV109").verdict is Verdict.PASS
    one = judged(found, "CNV135")
    assert one.verdict is Verdict.FAIL
    assert one.value is not None
    assert one.value.value == pytest.approx(pull, rel=1e-3)
    assert one.limit is not None
    assert one.limit.value == pytest.approx(440 * 28 / 1.25)
    at_tail = ("torque: 440 N*m, shaft: motor", "at: tail, torque: 21 kN*m, shaft: drum")
    assert (
        judged(report_on("conveyor/standing-uphill", down, down_at, stands, at_tail), "CNV135").verdict is Verdict.PASS
    )


def test_the_stopping_distance_limits_an_emergency_stop_too() -> None:
    one = judged(report_on("conveyor/emergency-way"), "CNV106")
    assert one.verdict is Verdict.FAIL
    assert one.limit is not None
    assert one.limit.value == 20


@pytest.mark.parametrize(
    ("name", "given"),
    [
        ("conveyor/decline-slips", ("rest_factor: 0.5", "rest_factor: 0.5, secondary: 1.2")),
        ("conveyor/recursion", None),
    ],
)
def test_a_belt_that_slips_and_never_stops_fails_with_its_cure(name: str, given: tuple[str, str] | None) -> None:
    found = report_on(name, *[given] if given else [])
    for code in ("CNV106", "CNV107"):
        one = judged(found, code)
        assert one.verdict is Verdict.FAIL
        assert one.value is not None
        assert one.value.value == math.inf
        assert "does not stop" in one.reason
        assert "increase the take-up tension" in one.reason
        assert one.blame.path == ("takeup", "tension")


def test_the_stopping_time_is_undecided_where_an_assumed_resistance_stops_the_belt() -> None:
    """With 1.31 for the secondary resistances the belt stops after 140 s, with the assumed 1.2 it does not."""
    one = judged(report_on("conveyor/decline-slips"), "CNV107")
    assert one.verdict is Verdict.UNDECIDED
    assert "`resistance.secondary`" in one.reason


def test_more_take_up_tension_stops_it() -> None:
    found = report_on("conveyor/decline-slips", ("tension: 60 kN", "tension: 120 kN"))
    way = load(found, "stop_distance", "stop_loaded")
    assert math.isfinite(way.value)
    assert verdict(found, "CNV107") is Verdict.PASS


def test_gear_losses_may_change_their_side_during_a_stop() -> None:
    """Integrated with the losses on the driven side at each moment: 9.792 s."""
    time = load(report_on("conveyor/gear-flip-downhill"), "stop_time")
    assert time.low <= 9.792 <= time.high
    assert time.high - time.low < 0.02 * time.value


def test_the_largest_tension_anywhere_is_at_least_that_at_the_pulley() -> None:
    found = report_on("conveyor/largest-anywhere")
    assert load(found, "tension_max").low >= load(found, "tension_run_on_max").low * (1 - 1e-9)


def test_waves_left_out_leave_the_rigid_stop() -> None:
    found = report_on("conveyor/stop-wave-off")
    assert load(found, "stop_time", "st").value == pytest.approx(6.0, rel=1e-3)
    assert {one.verdict for _, one in found.judgements} <= {Verdict.PASS, Verdict.FAIL, Verdict.NOT_CHECKED}


def test_a_belt_that_goes_slack_fails() -> None:
    assert verdict(report_on("conveyor/slack-undecided"), "CNV105") is Verdict.FAIL


def test_a_motor_curve_in_the_file_is_followed() -> None:
    """Locked-rotor torque over what the loaded belt requires: 0.5139; the mean over the curve would be 1.427."""
    one = judged(report_on("conveyor/curve-replaced"), "CNV104", "start_loaded")
    assert one.verdict is Verdict.FAIL
    assert one.value is not None
    assert one.value.value == pytest.approx(0.5139, abs=5e-5)


def test_slip_is_followed_until_the_belt_grips() -> None:
    """The rigid start ends at 4.67 s with 0.84 MJ; the belt grips at 11.8 s, with about 1.43 MJ."""
    one = judged(report_on("conveyor/slip-window"), "CNV111")
    assert one.verdict is Verdict.FAIL
    assert one.value is not None
    assert 1.3e6 < one.value.value < 1.5e6


def test_slip_that_goes_on_has_no_bound_and_says_so() -> None:
    found = report_on("conveyor/wet-runaway")
    slip = load(found, "slip_distance[head]", "start_loaded")
    assert slip.high == math.inf
    assert "NUM112" in codes(found)
    assert verdict(found, "CNV101", "start_loaded") is Verdict.FAIL


def test_a_longer_window_is_a_key_of_the_scene() -> None:
    twice = report_on("conveyor/slack-undecided", ("type: start", "type: start, window_factor: 2"))
    assert verdict(twice, "CNV105") is Verdict.FAIL
