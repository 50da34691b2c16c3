"""The simulated rotation against an integration of its own, and what it must keep whatever the crane."""

import math
from typing import Any

import pytest
from support.machines import changed, load_of, loaded, report_of, scene_of
from support.slewing import COURSE, YARD
from support.slewing_ode import Crane, rotate

from ptmcalc.laws import slewing
from ptmcalc.machines.crane.slewing.machine.spec import SlewingCrane
from ptmcalc.machines.crane.slewing.sway.simulated_rotation import rotation

WHOLE = changed(
    COURSE,
    load={"mass": "1 t", "radius": "5 m", "rope_length": "6 m"},
    brake={"torque": "16 N*m", "delay": "0.1 s", "rise_time": "0.1 s"},
    gear__reverse_efficiency=2 - 1 / 0.7,
)
KNOWN = changed(
    YARD, gear__rotating_factor=1.15, gear__reverse_efficiency=2 - 1 / 0.72, counterweight__inertia="0 kg*m^2"
)
"""With the values that the program would assume: none of its tests is about them."""


def reference(mass: float, radius: float, rope: float, brake: float, delay: float, rise: float) -> Crane:
    rotor = 1.15 * 1.7 * 0.021 * 400**2
    return Crane(
        60826 - mass * radius**2, rotor, mass, radius, rope, 0.7, 2 - 1 / 0.7, 983.8, 2184.4, 3120.6, 37.0 * 400,
        brake * 400, delay, rise, 2 * math.pi / 30, math.pi,
    )  # fmt: skip


@pytest.mark.parametrize(
    ("mass", "radius", "rope", "brake", "delay", "rise"),
    [(1000.0, 5.0, 6.0, 16.0, 0.1, 0.1), (4000.0, 3.0, 2.0, 14.0, 0.3, 0.0), (300.0, 11.0, 15.0, 25.0, 0.0, 0.6)],
)
def test_the_rotation_is_that_of_an_integration_of_its_own(
    mass: float, radius: float, rope: float, brake: float, delay: float, rise: float
) -> None:
    """Times, angles and swing to 1e-6, with Cartesian coordinates and DOP853 of scipy."""
    one = reference(mass, radius, rope, brake, delay, rise)
    data = changed(
        COURSE,
        load={"mass": f"{mass} kg", "radius": f"{radius} m", "rope_length": f"{rope} m"},
        brake={"torque": f"{brake} N*m", "delay": f"{delay} s", "rise_time": f"{rise} s"},
    )
    spec = loaded(data).spec
    assert isinstance(spec, SlewingCrane)
    moved = rotation(spec, spec.all_scenes[0], curve=True, gust=True)
    stop = slewing.geared_stop(
        60826, one.rotor, 0.7, one.back, one.speed, one.brake, 0.0, one.friction - one.most_wind, delay, rise
    )
    seen = rotate(one, stop[1])
    assert moved.phases.start == pytest.approx((seen.start_time, seen.start_angle), rel=1e-6)
    assert moved.phases.brake[0] == pytest.approx(seen.brake_time, rel=1e-6)
    until = moved.pieces[-1].begins + seen.brake_time
    for signal, largest in (("across", seen.radial), ("along", seen.tangential)):
        found = max(
            abs(piece.motion.farthest(signal, 0.0, min(piece.lasts, until - piece.begins)).value)
            for piece in moved.pieces
        )
        assert found == pytest.approx(largest, abs=1e-6), signal


def test_the_energy_balance_closes() -> None:
    scene = scene_of(report_of(WHOLE | {"checks": {"sway": "20 deg"}}))
    assert scene.health["energy_residual"] < 1e-9


def test_a_light_load_turns_like_a_rigid_one() -> None:
    """Without a load to speak of the simulation is the rigid crane, start and stop."""
    data = changed(WHOLE, load__mass="1 kg")
    spec = loaded(data).spec
    assert isinstance(spec, SlewingCrane)
    moved = rotation(spec, spec.all_scenes[0], curve=True, gust=True)
    rotor = 1.15 * 1.7 * 0.021 * 400**2
    start = (60826 + 0.7 * rotor) * 0.20943951 / (37 * 280 - 3168.2)
    assert moved.phases.start[0] == pytest.approx(start, rel=1e-3)
    stop = slewing.geared_stop(60826, rotor, 0.7, 2 - 1 / 0.7, math.pi / 15, 16 * 400, 0.0, 983.8 - 3120.6, 0.1, 0.1)
    assert moved.phases.brake[0] == pytest.approx(stop[0], rel=1e-3)
    assert moved.phases.brake[1] == pytest.approx(stop[1], rel=1e-3)


@pytest.mark.parametrize(
    "curve",
    [
        {"type": "linear", "starting_torque": "25 N*m", "no_load_speed": "1500 rpm"},
        {"type": "induction", "power": "1.5 kW", "speed": "900 rpm", "synchronous_speed": "1000 rpm", "overload": 2.2},
        {
            "type": "rheostat", "power": "1.5 kW", "speed": "900 rpm", "synchronous_speed": "1000 rpm",
            "overload": 2.2, "steps": [5, 3, 1.8], "smallest_torque": "18 N*m",
        },
        {
            "type": "converter", "speed": "900 rpm", "ramp_time": "4 s", "torque_limit": "30 N*m",
            "rated_torque": "15 N*m", "slip": 0.03,
        },
        {
            "type": "table",
            "points": [
                {"speed": "0 rpm", "torque": "30 N*m"},
                {"speed": "500 rpm", "torque": "25 N*m"},
                {"speed": "900 rpm", "torque": "9 N*m"},
            ],
        },
    ],
    ids=lambda curve: curve["type"],
)  # fmt: skip
def test_motors_of_all_types_bring_the_crane_to_its_speed(curve: dict[str, Any]) -> None:
    data = changed(KNOWN, motor__mean_starting_torque=None, motor__curve=curve)
    scene = scene_of(report_of(data))
    assert all(judgement.verdict.value in ("pass", "fail") for judgement in scene.checks)
    start = load_of(scene, "start_time").estimate
    assert 1 < start.value < 10
    if curve["type"] == "converter":
        assert start.value == pytest.approx(4.0, rel=1e-6)


def test_a_gust_holds_the_start_up() -> None:
    calm = load_of(scene_of(report_of(KNOWN | {"accuracy": "1 %"})), "start_time").estimate.value
    blown = report_of(changed(KNOWN, wind__gust="3 kN*m") | {"accuracy": "1 %"})
    assert load_of(scene_of(blown), "start_time").estimate.low > calm


def test_a_gust_above_the_largest_wind_is_held_like_it() -> None:
    """Steady wind and gust are 1.5 + 6 kN*m, motor and brake 9.72 and 10.8 kN*m, friction 2 kN*m."""
    scene = scene_of(report_of(changed(KNOWN, wind__gust="6 kN*m")))
    assert load_of(scene, "wind_reserve_motor").estimate.value == pytest.approx(9720 / 9500)
    assert load_of(scene, "wind_reserve_brake").estimate.value == pytest.approx(12800 / 7500)
    quiet = scene_of(report_of(changed(KNOWN, wind__gust="1 kN*m")))
    assert load_of(quiet, "wind_reserve_brake").estimate.value == pytest.approx(12800 / 4000)


def test_the_ring_bears_the_crane_without_its_load_too() -> None:
    """A counterweight that wins: -230 kN*m alone, next to nothing with 1.25 times the load."""
    moment = 230e3 / 9.81 + 8000 * 0.3 + 1200 * 4
    heavy = changed(KNOWN, counterweight={"mass": f"{moment / 2.6} kg", "radius": "2.6 m"})
    heavy["ring"] = {"curve": [{"axial": "0 kN", "moment": "200 kN*m"}, {"axial": "900 kN", "moment": "200 kN*m"}]}
    scene = scene_of(report_of(heavy))
    assert load_of(scene, "ring_utilisation").estimate.value == pytest.approx(230 / 200)
    assert load_of(scene, "ring_moment").estimate.value < 20e3


def test_the_radial_force_of_the_ring_has_the_inertia_of_what_stands_above_it() -> None:
    """A brake that locks: 17.8 t m behind the axis lose 1 rpm in the time of the stop, evenly at best."""
    scene = scene_of(report_of(changed(KNOWN, brake__torque="300 N*m", counterweight__radius="5 m")))
    stop = load_of(scene, "brake_time").estimate.value - 0.1
    dragged = (5000 * 5 - 8000 * 0.3 - 1200 * 4) * 0.9 * 2 * math.pi / 60 / stop
    assert load_of(scene, "ring_force_radial").estimate.high > dragged > 20e3
    assert load_of(scene, "ring_force_radial").estimate.high < 3 * dragged


@pytest.mark.parametrize("start", [{"cycle__start_time": "10 s"}, {"cycle__start_angle": "30 deg"}])
def test_a_given_start_at_the_limit_is_decided(start: dict[str, str]) -> None:
    """30 deg at 1 rpm are 10 s, the longest start allowed: no computation can make another time of it."""
    report = report_of(changed(KNOWN, motor__mean_starting_torque=None, **start))
    (judgement,) = (one for _, one in report.judgements if one.code == "CRN102")
    assert judgement.verdict.value == "pass"
    assert load_of(scene_of(report), "start_time").estimate.value == pytest.approx(10.0, abs=1e-12)


def test_a_curve_that_ends_below_the_speed_leaves_nothing_undecided() -> None:
    """The mean would start the crane, and the curve does not bring it to its speed: that is the verdict."""
    curve = {"type": "linear", "starting_torque": "40 N*m", "no_load_speed": "880 rpm"}
    report = report_of(changed(KNOWN, motor__mean_starting_torque=None, motor__curve=curve))
    verdicts = {judgement.code: judgement.verdict.value for _, judgement in report.judgements}
    assert verdicts["CRN118"] == "fail"
    assert verdicts["CRN101"] == "fail"
    assert "undecided" not in verdicts.values()


def test_a_gust_decides_a_verdict() -> None:
    """Without the gust the start is short enough, with it the crane takes too long."""
    assert report_of(KNOWN).verdict == "pass"
    report = report_of(changed(KNOWN, wind__gust="6 kN*m", wind__gust_time="9 s"))
    failed = {judgement.code for _, judgement in report.judgements if judgement.verdict.value == "fail"}
    assert failed == {"CRN102"}
    gust = next(effect for effect in scene_of(report).effects if effect.name == "wind_gust")
    assert gust.state.value == "simulated"


def test_a_slow_crane_needs_no_simulation_of_its_start() -> None:
    """Below their thresholds swing and lean are skipped, and their bounds are finite."""
    data = changed(
        KNOWN, speed="0.05 rpm", motor__speed=None, motor__power=None, motor__rated_torque="16 N*m",
        motor__mean_starting_torque="6.2 N*m", wind={"steady": "1.5 kN*m"}, brake={"torque": "1 N*m"},
    )  # fmt: skip
    scene = scene_of(report_of(data))
    states = {effect.name: effect.criterion for effect in scene.effects}
    swing = states["load_swing"]
    assert swing is not None
    assert swing.value < 0.02
    assert load_of(scene, "brake_angle").estimate.bounded


def test_what_the_ring_bears_is_more_with_a_swinging_load() -> None:
    data = changed(KNOWN, effects={"load_swing": "on"}, accuracy="1 %")
    scene = scene_of(report_of(data))
    still = (3060 + 8000 + 5000 + 1200) * 9.81
    assert load_of(scene, "ring_force_axial").estimate.low >= still * (1 - 1e-9)
    moment = abs(3060 * 8 + 8000 * 0.3 - 5000 * 2.6 + 1200 * 4) * 9.81
    assert load_of(scene, "ring_moment").estimate.high >= moment


def test_a_load_given_by_its_parts_or_by_the_inertia_turns_alike() -> None:
    inertia = 3060 * 64 + 8000 * 0.09 + 9000 + 5000 * 2.6**2 + 1200 * 64 / 3
    by_parts, by_inertia = (
        scene_of(report_of(data))
        for data in (
            KNOWN,
            changed(KNOWN, slewing_part=None, counterweight=None, jib=None, inertia=f"{inertia!r} kg*m^2"),
        )
    )
    for name in ("slew_inertia", "start_time", "brake_angle", "sway_radial_max", "torque_worm"):
        one, other = (load_of(scene, name).estimate.value for scene in (by_parts, by_inertia))
        assert one == pytest.approx(other, rel=1e-8), name
