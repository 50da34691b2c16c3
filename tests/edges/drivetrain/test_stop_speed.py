"""A stop whose speed the file leaves out begins at the speed of the motor, and never at standstill unseen."""

import pytest
from support.drivetrains import data_of
from support.machines import check_of, load_of, loaded, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict

TRAIN = """
kind: drivetrain
inertias: {{motor: {{inertia: 2 kg*m^2}}, drum: {{inertia: 0 kg*m^2}}}}
gears: {{box: {{from: motor, to: drum, ratio: -20, efficiency: 1}}}}
motors: {{main: {{at: motor, motor: {{type: linear, starting_torque: 50 N*m, no_load_speed: 100 rad/s}}}}}}
brakes: {{b: {{at: motor, torque: 100 N*m, delay: 0 s, rise_time: 0 s}}}}
checks: {{stop_time: {limit} s, stop_angle: 1000 rad}}
scenes: [{{type: stop{more}}}]
"""
WITHOUT_MOTOR = TRAIN.replace(
    "motors: {{main: {{at: motor, motor: {{type: linear, starting_torque: 50 N*m, no_load_speed: 100 rad/s}}}}}}\n", ""
)
WEIGHT = "\ntorques: {{weight: {{at: motor, type: constant, torque: {torque} N*m}}}}"


@pytest.mark.parametrize(("limit", "verdict"), [(1.9, Verdict.FAIL), (2.05, Verdict.UNDECIDED), (2.11, Verdict.PASS)])
def test_the_speed_of_the_motor_is_assumed(limit: float, verdict: Verdict) -> None:
    """2 kg*m^2 from 100 rad/s with 100 N*m: 2 s; from 105 rad/s, driven by the load: 2.1 s."""
    data = data_of(TRAIN.format(limit=limit, more=""))
    (assumed,) = loaded(data).assumed
    assert assumed.path == ("scenes", 0, "speed")
    assert (assumed.value, assumed.interval.low, assumed.interval.high) == pytest.approx((100.0, -105.0, 105.0))
    scene = scene_of(report_of(data))
    assert load_of(scene, "stop_time").estimate.value == pytest.approx(2.0)
    assert check_of(scene, "DRV103").verdict is verdict


def test_the_assumed_speed_is_that_of_the_shaft_of_the_scene() -> None:
    (assumed,) = loaded(data_of(TRAIN.format(limit=3, more=", of: drum"))).assumed
    assert (assumed.value, assumed.interval.low, assumed.interval.high) == pytest.approx((-5.0, -5.25, 5.25))


@pytest.mark.parametrize(("torque", "verdict"), [(-90, Verdict.UNDECIDED), (-10, Verdict.PASS)])
def test_the_load_may_drive_in_the_other_direction(torque: float, verdict: Verdict) -> None:
    """Forward the weight helps: 2*100/190 s. Backward 10 or 90 N*m brake 105 rad/s: 21 or 2.33 s."""
    text = TRAIN.format(limit=3, more="") + WEIGHT.format(torque=torque)
    assert check_of(scene_of(report_of(data_of(text))), "DRV103").verdict is verdict


def test_without_a_motor_no_check_of_the_stop_is_made() -> None:
    scene = scene_of(report_of(data_of(WITHOUT_MOTOR.format(limit=3, more=""))))
    for code in ("DRV103", "DRV104", "DRV110"):
        one = check_of(scene, code)
        assert one.verdict is Verdict.NOT_CHECKED
        assert "`scenes[0].speed` is not given" in one.reason


def test_a_speed_of_a_part_is_no_standstill() -> None:
    text = WITHOUT_MOTOR.format(limit=3, more="").replace("2 kg*m^2", "2 kg*m^2, speed: 100 rad/s")
    data = data_of(text)
    assert not loaded(data).assumed
    assert check_of(scene_of(report_of(data)), "DRV103").verdict is Verdict.PASS


@pytest.mark.parametrize(("torque", "verdict"), [(99, Verdict.PASS), (101, Verdict.FAIL)])
def test_a_stop_that_the_file_begins_at_standstill_judges_the_holding_brake_alone(
    torque: float, verdict: Verdict
) -> None:
    text = TRAIN.format(limit=3, more=", speed: 0 rpm") + WEIGHT.format(torque=torque)
    scene = scene_of(report_of(data_of(text)))
    assert [one.code for one in scene.checks] == ["DRV110"]
    assert check_of(scene, "DRV110").verdict is verdict
