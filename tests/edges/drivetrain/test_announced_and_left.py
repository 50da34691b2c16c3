"""Drive trains that passed though the file announces worse for later, or though a part of them never gets there."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.edges import judged, load, report_on, verdict

from ptmcalc.base.diagnostic import Verdict

SYNCHRONOUS = 1500 * math.pi / 30


def kloss(power: float, rated: float, overload: float, speed: float) -> float:
    """Torque of an induction motor at 1500 rpm synchronous speed; the rated speed in rpm [N*m]."""
    slip, rated_slip = 1 - speed / SYNCHRONOUS, 1 - rated / 1500
    most = rated_slip * (overload + math.sqrt(overload**2 - 1))
    return 2 * overload * power / (rated * math.pi / 30) * slip * most / (slip**2 + most**2)


def test_an_impulse_long_after_the_start_counts() -> None:
    """Motor and mill on a damped shaft, 60 N*m*s on the mill at 30 s, integrated here."""
    found = report_on("drivetrain/late-impulse")

    def rate(_: float, y: list[float]) -> list[float]:
        torque = 8000 * y[0] + 5 * (y[1] - y[2])
        return [y[1] - y[2], (kloss(30e3, 1470, 2.5, y[1]) - torque) / 0.5, torque / 3]

    steady = solve_ivp(rate, (0, 30), [0, 0, 0], rtol=1e-9, atol=1e-9).y[:, -1]
    after = solve_ivp(rate, (0, 2), steady - [0, 0, 20], rtol=1e-10, atol=1e-10, max_step=1e-3).y
    peak = float(np.abs(8000 * after[0] + 5 * (after[1] - after[2])).max())
    assert load(found, "torque_peak[c]").value == pytest.approx(peak, rel=1e-3)
    assert verdict(found, "DRV101") is Verdict.FAIL


@pytest.mark.parametrize(
    "late",
    [
        "work: {at: mill, type: constant, torque: -900 N*m, delay: 30 s}",
        "work: {at: mill, type: over_time, points: [{time: 0 s, torque: 0 N*m}, {time: 40 s, torque: 0 N*m},"
        " {time: 41 s, torque: -900 N*m}]}",
        "work: {at: mill, type: over_position, points: [{position: 0 rad, torque: 0 N*m}, {position: 4000 rad,"
        " torque: 0 N*m}, {position: 4001 rad, torque: -900 N*m}]}",
        "work: {at: mill, type: sine, amplitude: 900 N*m, frequency: 0.005 Hz}",
    ],
)
def test_a_torque_long_after_the_start_never_passes(late: str) -> None:
    """The start alone takes 419 N*m, each of these more than 500."""
    blow = "impulses:\n  blow: {at: mill, time: 30 s, size: -60 N*m*s}\n"
    found = report_on("drivetrain/late-impulse", (blow, f"torques:\n  {late}\n"), ("limit: 700", "limit: 450"))
    assert verdict(found, "DRV101") in (Verdict.FAIL, Verdict.UNDECIDED)


def test_a_rope_with_much_slack_is_followed_until_it_is_taut() -> None:
    """Drum and load integrated here: the motor drives through the gear, the load sticks until friction gives way."""
    found = report_on("drivetrain/long-slack")

    def rate(_: float, y: list[float]) -> list[float]:
        rope = 900e3 * max(y[0] - y[2] - 20, 0.0)
        torque = kloss(30e3, 1470, 2.5, y[1] / 0.3 * 30)
        drum = (torque * 30 * 0.95 / 0.3 - rope) / ((4 + 0.5 * 30**2 * 0.95) / 0.3**2 + 5)
        return [y[1], drum, y[3], (rope - 2000) / 3000 if rope > 2400 or y[3] > 1e-6 else 0.0]

    course = solve_ivp(rate, (0, 16), [0, 0, 0, 0], rtol=1e-8, max_step=1e-3).y
    peak = 900e3 * float(np.max(course[0] - course[2] - 20))
    assert load(found, "torque_peak[rope]").value == pytest.approx(peak, rel=1e-2)
    assert verdict(found, "DRV101") is Verdict.FAIL


def test_a_gust_after_the_stop_moves_a_crane_that_its_brake_does_not_hold() -> None:
    found = report_on("drivetrain/late-gust")
    held = 100 * 25 / 0.25 / 0.92 + 1.2e3  # brake through the gear, rolling resistance
    assert held < 16e3
    assert verdict(found, "DRV110") is Verdict.FAIL
    assert verdict(found, "DRV103") is Verdict.FAIL


def test_a_stop_without_speed_begins_at_that_of_the_motor() -> None:
    found = report_on("drivetrain/stop-without-speed")
    assert verdict(found, "DRV103") is Verdict.FAIL
    assert load(found, "stop_time").value == pytest.approx(18.81, abs=0.01)
    assert [".".join(map(str, one.path)) for one in found.assumed if one.path[-1] == "speed"] == ["scenes.1.speed"]


def test_a_stop_without_speed_and_motor_is_not_checked() -> None:
    found = report_on("drivetrain/stop-without-speed", ("  - {type: stop}", "  - {type: stop, of: drum}"))
    assert verdict(found, "DRV110") is Verdict.NOT_CHECKED
    assert "speed` is not given" in judged(found, "DRV110").reason


def test_a_load_that_drives_the_motor_beyond_its_breakdown_torque() -> None:
    """2 kN*m behind i = 20 with losses of a tenth: 90 N*m on the motor shaft, 40.1 N*m hold."""
    found = report_on("drivetrain/overhauled")
    assert judged(found, "DRV111").verdict is Verdict.FAIL
    assert judged(found, "DRV111").limit.value == pytest.approx(1.2 * SYNCHRONOUS)
    strong = report_on("drivetrain/overhauled", ("power: 3 kW", "power: 9 kW"))
    assert verdict(strong, "DRV111") is Verdict.PASS
    settled = load(strong, "speed_max[motor]").value
    assert -kloss(9e3, 1430, 2, settled) == pytest.approx(90, rel=0.05)


def test_a_motor_that_never_brakes_holds_no_load() -> None:
    table = "motor: {type: table, points: [{speed: 0 rpm, torque: 40 N*m}, {speed: 1500 rpm, torque: 0 N*m}]}"
    plate = "motor: {type: induction, power: 3 kW, speed: 1430 rpm, synchronous_speed: 1500 rpm, overload: 2}"
    assert verdict(report_on("drivetrain/overhauled", (plate, table)), "DRV111") is Verdict.FAIL


def test_a_second_motor_that_stalls_fails_the_start() -> None:
    """At rest it gives 92 N*m against 360 N*m of breakaway."""
    found = report_on("drivetrain/second-motor-stalls")
    assert kloss(30e3, 1470, 2.5, 0.0) < 360
    fault = judged(found, "DRV109")
    assert fault.verdict is Verdict.FAIL
    assert "`motor2` stays at rest" in fault.reason
    free = report_on("drivetrain/second-motor-stalls", ("coulomb: 300 N*m", "coulomb: 40 N*m"))
    assert verdict(free, "DRV109") is Verdict.PASS


def test_a_clutch_that_slips_for_good_fails_and_one_that_locks_passes() -> None:
    """60 N*m carry the fan to 1083 rpm of its line, the motor turns at 1472 rpm; 120 N*m carry it all."""
    found = report_on("drivetrain/clutch-slips")
    assert verdict(found, "DRV112") is Verdict.FAIL
    assert "slips for good" in judged(found, "DRV112").reason
    locked = report_on("drivetrain/clutch-slips", ("torque: 60 N*m, applied", "torque: 120 N*m, applied"))
    assert verdict(locked, "DRV112") is Verdict.PASS
    assert load(locked, "clutch_slip[clutch]").value == 0


def test_a_part_that_turns_on_behind_its_clutch_has_not_stopped() -> None:
    """The clutch needs J w/M = 20 x 147/10 = 293 s."""
    found = report_on("drivetrain/clutch-slips-in-stop")
    assert verdict(found, "DRV112") is Verdict.FAIL
    assert "slips at the end of the stop" in judged(found, "DRV112").reason
