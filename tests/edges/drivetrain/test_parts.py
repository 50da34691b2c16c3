"""Each part of a train is judged: second motors, clutches that slip, parts behind a clutch in a stop."""

import math

import pytest
from support.drivetrains import data_of
from support.machines import check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import Judgement, SceneReport

TWO = """
kind: drivetrain
inertias: {{motor: {{inertia: 0.3 kg*m^2}}, mill: {{inertia: 6 kg*m^2}}}}
motors:
  main: {{at: motor, motor: {{type: linear, starting_torque: 100 N*m, no_load_speed: 150 rad/s}}}}
  second: {{at: mill, motor: {{type: linear, starting_torque: {torque} N*m, no_load_speed: 150 rad/s}}}}
resistances: {{r: {{at: mill, coulomb: {friction} N*m, static_ratio: 1.2}}}}
checks: {{start_time: {limit} s}}
scenes: [{{type: start{more}}}]
"""


def two(torque: float = 250, friction: float = 0, limit: float = 20, more: str = "") -> SceneReport:
    return scene_of(report_of(data_of(TWO.format(torque=torque, friction=friction, limit=limit, more=more))))


def of_part(scene: SceneReport, code: str) -> dict[str, Judgement]:
    return {one.element: one for one in scene.checks if one.code == code}


@pytest.mark.parametrize(("friction", "verdict"), [(210, Verdict.FAIL), (8, Verdict.PASS)])
def test_a_second_motor_that_stalls_fails(friction: float, verdict: Verdict) -> None:
    """Breakaway 252 against 250 N*m; 8 N*m leave 4.5 N*m at 95 % of the speed."""
    found = of_part(two(friction=friction), "DRV109")
    assert found["motor"].verdict is Verdict.PASS
    assert found["mill"].verdict is verdict
    assert ("`mill` stays at rest" in found["mill"].reason) is (verdict is Verdict.FAIL)


@pytest.mark.parametrize(("limit", "verdict"), [(10.7, Verdict.FAIL), (10.9, Verdict.PASS)])
def test_the_start_time_holds_for_each_motor(limit: float, verdict: Verdict) -> None:
    """J w_0/M_0 ln 20 = 10.785 s for the mill, 1.348 s for the first motor."""
    scene = two(limit=limit)
    right = 6 * 150 / 250 * math.log(20)
    assert load_of(scene, "part_start_time[mill]").estimate.value == pytest.approx(right, rel=1e-6)
    found = of_part(scene, "DRV102")
    assert (found["motor"].verdict, found["mill"].verdict) == (Verdict.PASS, verdict)


def test_a_motor_that_stalls_has_no_start_time() -> None:
    found = of_part(two(friction=210), "DRV102")
    assert (found["motor"].verdict, found["mill"].verdict) == (Verdict.PASS, Verdict.FAIL)
    assert math.isinf(load_of(two(friction=210), "part_start_time[mill]").estimate.value)


def test_the_failure_of_the_main_part_is_its_own() -> None:
    found = of_part(two(friction=210, more=", of: mill"), "DRV109")
    assert {name: one.verdict for name, one in found.items()} == {"mill": Verdict.FAIL, "motor": Verdict.PASS}


@pytest.mark.parametrize(
    "tie",
    ["gears: {g: {from: motor, to: mill, ratio: 1}}", "links: {g: {between: [motor, mill], stiffness: 1 MN*m/rad}}"],
)
def test_motors_on_one_shaft_are_one_part(tie: str) -> None:
    scene = scene_of(report_of(data_of(TWO.format(torque=250, friction=0, limit=20, more="") + tie)))
    assert [one.element for one in scene.checks if one.code in ("DRV102", "DRV109")] == ["", ""]


def test_a_short_duration_leaves_the_second_motor_undecided() -> None:
    assert of_part(two(more=", duration: 2 s"), "DRV109")["mill"].verdict is Verdict.UNDECIDED


CLUTCH = """
kind: drivetrain
inertias: {{motor: {{inertia: 0.5 kg*m^2}}, fan: {{inertia: 2 kg*m^2}}}}
motors: {{main: {{at: motor, motor: {{type: linear, starting_torque: 100 N*m, no_load_speed: 150 rad/s}}}}}}
brakes:
  clutch: {{at: motor, against: fan, torque: {torque} N*m, applied: always, delay: 0 s, rise_time: 0 s}}
torques:
  air:
    at: fan
    type: over_speed
    points: [{{speed: 0 rad/s, torque: 0 N*m}}, {{speed: 200 rad/s, torque: -100 N*m}}]
scenes: [{{type: start, until: 80 rad/s{more}}}]
"""


@pytest.mark.parametrize(("torque", "verdict"), [(42, Verdict.FAIL), (43.5, Verdict.PASS), (60, Verdict.PASS)])
def test_a_clutch_that_never_locks_fails(torque: float, verdict: Verdict) -> None:
    """Locked, 100 (1 - w/150) = w/2 at 85.7 rad/s: the clutch carries 42.86 N*m."""
    one = check_of(scene_of(report_of(data_of(CLUTCH.format(torque=torque, more="")))), "DRV112")
    assert one.verdict is verdict
    assert one.element == "clutch"
    assert ("slips permanently" in one.reason) is (verdict is Verdict.FAIL)


def test_the_clutch_torque_that_locks_is_found() -> None:
    report = report_of(data_of(CLUTCH.format(torque=30, more="")), repairs=True)
    one = check_of(scene_of(report), "DRV112")
    assert one.blame.path == ("brakes", "clutch", "torque")
    assert one.repair is not None
    assert one.repair.value == pytest.approx(300 / 7, rel=0.02)


def test_a_clutch_that_may_lock_after_the_duration_is_undecided() -> None:
    one = check_of(scene_of(report_of(data_of(CLUTCH.format(torque=60, more=", duration: 1 s")))), "DRV112")
    assert one.verdict is Verdict.UNDECIDED
    assert "the clutch may lock after 1 s" in one.reason


STOP = """
kind: drivetrain
inertias: {{motor: {{inertia: 0.3 kg*m^2}}, drum: {{inertia: 20 kg*m^2{own}}}}}
brakes:
  service: {{at: motor, torque: 300 N*m, delay: 0 s, rise_time: 0 s}}
  clutch: {{at: motor, against: drum, torque: {torque} N*m, applied: {applied}, delay: 0 s, rise_time: 0 s}}
{more}
checks: {{stop_time: 10 s}}
scenes: [{{type: stop, speed: 100 rad/s}}]
"""


def stop(torque: float, own: str = "", applied: str = "always", more: str = "") -> SceneReport:
    return scene_of(report_of(data_of(STOP.format(torque=torque, own=own, applied=applied, more=more))))


@pytest.mark.parametrize("own", ["", ", speed: 100 rad/s"])
@pytest.mark.parametrize(("torque", "verdict"), [(10, Verdict.FAIL), (190, Verdict.FAIL), (210, Verdict.PASS)])
def test_the_part_behind_a_clutch_stops_in_time_too(own: str, torque: float, verdict: Verdict) -> None:
    """20 kg*m^2 at 100 rad/s, the speed of the scene: 2000/T s by the clutch."""
    scene = stop(torque, own)
    assert load_of(scene, "part_stop_time[drum]").estimate.value == pytest.approx(2000 / torque)
    found = of_part(scene, "DRV103")
    assert (found["motor"].verdict, found["drum"].verdict) == (Verdict.PASS, verdict)
    assert found["drum"].blame.path == ("brakes", "clutch", "torque")


@pytest.mark.parametrize(("weight", "verdict"), [(9, Verdict.PASS), (11, Verdict.FAIL)])
def test_a_load_that_turns_on_behind_a_clutch_fails(weight: float, verdict: Verdict) -> None:
    load = f"torques: {{weight: {{at: drum, type: constant, torque: {weight} N*m}}}}"
    found = of_part(stop(10, more=load), "DRV110")
    assert (found["motor"].verdict, found["drum"].verdict) == (Verdict.PASS, verdict)


def test_an_open_clutch_ties_nothing() -> None:
    assert list(of_part(stop(10, applied="never"), "DRV103")) == [""]
