"""Loads that drive a motor above its no-load speed: its braking torque holds them, or the check fails (DRV111)."""

import math

import pytest
from support.drivetrains import data_of
from support.machines import check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import SceneReport

RATED = 3000 / (1430 * math.pi / 30)
"""Rated torque [N*m]: 20.03."""
INDUCTION = "type: induction, power: 3 kW, speed: 1430 rpm, synchronous_speed: 1500 rpm, overload: 2"
TABLE = (
    "type: table, points: [{speed: 0 rpm, torque: 60 N*m}, {speed: 1500 rpm, torque: 0 N*m},"
    " {speed: 1600 rpm, torque: -30 N*m}, {speed: 2000 rpm, torque: -10 N*m}]"
)
CONVERTER = (
    "type: converter, rated_torque: 30 N*m, speed: 1500 rpm, ramp_time: 1 s, torque_limit: 50 N*m,"
    " stiffness: 10 N*m*s/rad"
)
LINEAR = "type: linear, starting_torque: 60 N*m, no_load_speed: 1500 rpm"
TRAIN = """
kind: drivetrain
inertias: {{motor: {{inertia: 0.5 kg*m^2}}, drum: {{inertia: 20 kg*m^2}}}}
gears: {{box: {{from: motor, to: drum, ratio: {ratio}, efficiency: 0.9, reverse_efficiency: {reverse}}}}}
motors: {{main: {{at: motor, motor: {{{motor}}}, count: {count}}}{more}}}
torques: {{weight: {{at: drum, {torque}}}}}
checks: {{start_time: 20 s}}
"""


def found(
    motor: str = INDUCTION,
    torque: str = "type: constant, torque: 2 kN*m",
    *,
    ratio: float = 20,
    reverse: float = 0.9,
    count: int = 1,
    more: str = "",
    rest: str = "",
) -> SceneReport:
    text = TRAIN.format(motor=motor, torque=torque, ratio=ratio, reverse=reverse, count=count, more=more)
    return scene_of(report_of(data_of(text + rest), ends=False))


def reserve(scene: SceneReport) -> float:
    return load_of(scene, "braking_reserve[main]").estimate.value


def judged(scene: SceneReport) -> list[str]:
    return [one.element for one in scene.checks if one.code == "DRV111"]


@pytest.mark.parametrize(
    ("motor", "right"),
    [
        (INDUCTION, 2 * RATED / 90),
        (TABLE, 30 / 90),
        (CONVERTER, 50 / 90),
        ("type: constant, torque: 60 N*m", 0.0),
    ],
)
def test_the_reserve_is_the_braking_torque_over_that_of_the_load(motor: str, right: float) -> None:
    """2 kN*m behind 20 to 1, driven back with 0.9: 90 N*m."""
    rest = "scenes: [{type: start, until: 100 rad/s}]"
    scene = found(motor, rest=rest)
    one = check_of(scene, "DRV111")
    assert reserve(scene) == pytest.approx(right)
    assert one.verdict is Verdict.FAIL
    weak = found(motor, "type: constant, torque: 600 N*m", rest=rest)
    assert check_of(weak, "DRV111").verdict is (Verdict.PASS if right else Verdict.FAIL)


@pytest.mark.parametrize(
    ("motor", "ratio", "reverse"), [(LINEAR, 20, 0.9), (INDUCTION, -20, 0.9), (INDUCTION, 20, -0.2)]
)
def test_no_load_drives_these(motor: str, ratio: float, reverse: float) -> None:
    """A linear motor brakes without limit; a weight that resists; a self-locking gear."""
    text = "type: constant, torque: 300 N*m"
    assert judged(found(motor, text, ratio=ratio, reverse=reverse)) == []


@pytest.mark.parametrize(("share", "verdict"), [(0.98, Verdict.PASS), (1.02, Verdict.FAIL)])
def test_the_motion_agrees(share: float, verdict: Verdict) -> None:
    """Breakdown slip 0.0467 (2 + 3^(1/2)) = 0.174: the motor holds below 1761 rpm, or the load runs away."""
    scene = found(
        torque=f"type: constant, torque: {share * 2 * RATED * 20 / 0.9} N*m",
        rest="scenes: [{type: run, duration: 60 s}]",
    )
    assert check_of(scene, "DRV111").verdict is verdict
    fast = load_of(scene, "speed_max[motor]").estimate.value * 30 / math.pi
    assert (fast < 1761) is (verdict is Verdict.PASS)
    assert fast > 1650


def test_friction_and_a_fan_take_from_the_load() -> None:
    """90 N*m less 10 N*m of friction and a fan of 20 N*m at the no-load speed that grows to the point of breakdown."""
    friction = "resistances: {bearing: {at: motor, coulomb: 10 N*m, static_ratio: 1}}"
    assert reserve(found(rest=friction)) == pytest.approx(2 * RATED / 80)
    rated_slip = 70 / 1500
    slip = rated_slip * (2 + math.sqrt(3))
    rest = f"""
{friction}
torques:
  weight: {{at: drum, type: constant, torque: 2 kN*m}}
  fan:
    at: motor
    type: over_speed
    points: [{{speed: 0 rpm, torque: 0 N*m}}, {{speed: {1500 * (1 + slip)} rpm, torque: -40 N*m}}]
"""
    text = TRAIN.replace("torques: {{weight: {{at: drum, {torque}}}}}\n", "").format(
        motor=INDUCTION, ratio=20, reverse=0.9, count=1, more="", torque=""
    )
    scene = scene_of(report_of(data_of(text + rest)))
    assert reserve(scene) == pytest.approx(2 * RATED / 40, rel=1e-3)


def test_all_motors_brake_together() -> None:
    """Two on the shaft, and one on the drum behind the gear: its torque saves the gear's losses."""
    assert reserve(found(count=2)) == pytest.approx(4 * RATED / 90)
    slow = (
        "type: table, points: [{speed: 0 rpm, torque: 600 N*m}, {speed: 75 rpm, torque: 0 N*m},"
        " {speed: 88.05 rpm, torque: -500 N*m}]"
    )
    scene = found(more=f", second: {{at: drum, motor: {{{slow}}}}}")
    # s 2 M_N = (2000 - s 500) 0.9/20
    assert judged(scene) == ["main"]
    assert reserve(scene) == pytest.approx((2 * RATED + 500 * 0.9 / 20) / 90, rel=1e-2)


def test_a_rope_does_not_push_and_a_clutch_slips() -> None:
    text = """
    kind: drivetrain
    inertias: {{motor: {{inertia: 0.5 kg*m^2}}, drum: {{inertia: 20 kg*m^2}}}}
    {joint}
    motors: {{main: {{at: motor, motor: {{type: constant, torque: 60 N*m}}}}}}
    torques: {{weight: {{at: drum, type: constant, torque: 50 N*m}}}}
    checks: {{start_time: 20 s}}
    scenes: [{{type: start, until: 100 rad/s}}]
    """
    rope = "links: {{rope: {{between: [{ends}], stiffness: 1 kN*m/rad, slack: 1 rad}}}}"
    for ends, elements in (("motor, drum", []), ("drum, motor", ["main"])):
        assert judged(scene_of(report_of(data_of(text.format(joint=rope.format(ends=ends)))))) == elements
    induction = text.replace("type: constant, torque: 60 N*m", INDUCTION)
    clutch = "brakes: {clutch: {at: motor, against: drum, torque: 20 N*m, applied: always, delay: 0 s, rise_time: 0 s}}"
    assert reserve(scene_of(report_of(data_of(induction.format(joint=clutch))))) == pytest.approx(2 * RATED / 20)


@pytest.mark.parametrize(
    ("torque", "verdict"),
    [
        ("type: constant, torque: 2 kN*m, delay: 30 s", Verdict.FAIL),
        ("type: ramp, torque: 2 kN*m, time: 40 s", Verdict.FAIL),
        ("type: sine, amplitude: 2 kN*m, frequency: 0.05 Hz", Verdict.FAIL),
        ("type: sine, amplitude: 800 N*m, frequency: 0.05 Hz", Verdict.PASS),
        ("type: sine, amplitude: 1000 N*m, frequency: 5 Hz", Verdict.PASS),
        (
            "type: over_position, points: [{position: 0 rad, torque: 0 N*m}, {position: 100 rad, torque: 2 kN*m}]",
            Verdict.FAIL,
        ),
    ],
)
def test_the_worst_moment_decides(torque: str, verdict: Verdict) -> None:
    """Of 5 Hz, 45 N*m over 32 ms turn 0.545 kg*m^2 by less than 1 rad/s: the motor brakes less than its 40 N*m."""
    assert check_of(found(torque=torque), "DRV111").verdict is verdict


@pytest.mark.parametrize(
    ("seconds", "verdict"), [(0.31, Verdict.FAIL), (0.27, Verdict.UNDECIDED), (0.23, Verdict.PASS)]
)
def test_a_short_overload_fails_by_the_overspeed_that_it_leaves(seconds: float, verdict: Verdict) -> None:
    """90 N*m on 0.545 kg*m^2 against 40 N*m: 1761 rpm after 0.248 s, 1800 rpm after 0.292 s (Runge-Kutta)."""
    times = (5, 5.001, 5.001 + seconds, 5.002 + seconds)
    points = [f"{{time: {time} s, torque: {size} N*m}}" for time, size in zip(times, (0, 2000, 2000, 0), strict=True)]
    table = f"type: over_time, points: [{', '.join(points)}]"
    assert check_of(found(torque=table), "DRV111").verdict is verdict


def test_an_impulse_beyond_the_curve_fails() -> None:
    """30 N*m of load and 40.06 N*m of braking torque; beyond 3000 rpm, slip 1, the motor brakes with 13.5 N*m."""
    load = "type: constant, torque: 667 N*m"
    assert check_of(found(torque=load), "DRV111").verdict is Verdict.PASS
    one = check_of(found(torque=load, rest="impulses: {blow: {at: motor, time: 5 s, size: 100 N*m*s}}"), "DRV111")
    assert one.verdict is Verdict.FAIL
    assert "above the speed of the maximum braking torque" in one.reason


def test_a_stop_is_not_judged() -> None:
    assert judged(found(rest="scenes: [{type: stop, speed: 1400 rpm, duration: 1 s}]")) == []
