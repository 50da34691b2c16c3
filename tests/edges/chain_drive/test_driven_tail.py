"""Chains whose tail is driven: a share that the file does not state decides no verdict. Right values by hand."""

import math
from typing import Any

import pytest
from support.chain_starts import scraper
from support.machines import changed, check_of, load_of, loaded, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict

G = 9.81
LEVEL = math.sqrt(40**2 - 5**2)
BACK = 1.1 * 0.25 * 22 * G * LEVEL - 22 * G * 5
ON = 1.1 * (0.25 * 22 + 0.4 * 90) * G * LEVEL + 112 * G * 5
PLATES = {"count": 2, "power": "11 kW", "speed": "1460 rpm", "inertia": "0.1 kg*m^2"}


def driven(*scenes: dict[str, Any], share: float | None = None, **changes: Any) -> dict[str, Any]:
    tail = {"teeth": 8, "inertia": "12 kg*m^2", "driven": "on"} | ({} if share is None else {"share": share})
    data = changed(scraper(), layout__takeup__tension="15 kN", layout__tail=tail)
    return changed(data, scenes=list(scenes), **changes)


def verdict(data: dict[str, Any], code: str) -> Verdict:
    return check_of(scene_of(report_of(data)), code).verdict


RUN = {"type": "run"}
START = {"type": "start", "profile": {"shape": "cosine", "time": "6 s"}}
STOP = {"type": "stop"}
SYNCHRONISED = {"layout__tail__synchronised": "on", "brake": {"torque": "60 N*m"}}


@pytest.mark.parametrize(
    ("scene", "code", "changes", "low", "high"),
    [(RUN, "CHN105", {}, 0.3, 0.8), (START, "CHN123", {}, 0.2, 0.8), (STOP, "CHN127", SYNCHRONISED, 0.2, 0.9)],
)
def test_the_share_alone_decides(
    scene: dict[str, Any], code: str, changes: dict[str, Any], low: float, high: float
) -> None:
    """W = 24.5 kN: the beginning of the working strand has 15 kN + W_return - s W, below 0 from s = 0.66 on."""
    assert pytest.approx(24.5e3, rel=2e-3) == (BACK + ON)
    assert verdict(driven(scene, **changes), code) is Verdict.UNDECIDED
    assert verdict(driven(scene, share=low, **changes), code) is Verdict.PASS
    assert verdict(driven(scene, share=high, **changes), code) is Verdict.FAIL


def test_the_share_moves_the_smallest_tension_of_steady_running() -> None:
    off = {"effects": {"polygon": "off"}}
    for share in (0.3, 0.7):
        found = load_of(scene_of(report_of(driven(RUN, share=share, **off))), "tension_min").estimate
        assert found.value == pytest.approx(15e3 + BACK - share * (BACK + ON), rel=1e-9)


@pytest.mark.parametrize("effects", [{}, {"chain_elasticity": "off", "tooth_passing": "off"}])
@pytest.mark.parametrize("share", [0.2, 0.5])
@pytest.mark.parametrize("scene", [{"type": "start"}, STOP])
def test_torques_of_sprockets_that_turn_apart_decide_nothing(
    scene: dict[str, Any], share: float, effects: dict[str, str]
) -> None:
    data = driven(scene, share=share, brake={"torque": "60 N*m"}, effects=effects)
    codes = ("CHN122", "CHN123") if scene["type"] == "start" else ("CHN127", "CHN128")
    assert {verdict(data, code) for code in codes} == {Verdict.UNDECIDED}


ON_CURVE = {
    "power": "22 kW",
    "speed": "1460 rpm",
    "locked_rotor_ratio": 2.2,
    "breakdown_ratio": 2.6,
    "inertia": "0.35 kg*m^2",
}


@pytest.mark.parametrize(
    ("strength", "tail", "said"),
    [
        ("350 kN", "on", Verdict.PASS),
        ("90 kN", "on", Verdict.FAIL),
        ("350 kN", "off", Verdict.UNDECIDED),
        ("90 kN", "off", Verdict.UNDECIDED),
    ],
)
def test_motors_on_their_curve_start_sprockets_of_one_speed(strength: str, tail: str, said: Verdict) -> None:
    data = driven(
        {"type": "start"},
        share=0.2,
        layout__tail__synchronised=tail,
        layout__takeup__tension="20 kN",
        chain__breaking_load=strength,
        speed="0.3 m/s",
        drive__motor=ON_CURVE,
        drive__gear__ratio=104,
    )
    assert verdict(data, "CHN122") is said


def test_a_speed_range_moves_both_sprockets() -> None:
    sweep = {"type": "speed_range", "from": "0.1 m/s", "to": "0.4 m/s", "time": "5 s"}
    for strength, said in (("350 kN", Verdict.PASS), ("70 kN", Verdict.FAIL)):
        assert verdict(driven(sweep, share=0.2, chain__breaking_load=strength), "CHN128") is said


@pytest.mark.parametrize(
    ("changes", "low", "high"),
    [
        ({}, 0.7 / 2, 1.3 / 2),
        ({"drive__motor__count": 3}, 0.7 / 3.3, 2.6 / 3.3),
        ({"drive__motor__count": 1}, 0.0, 1.0),
        ({"layout__tail__teeth": 9}, 0.0, 1.0),
        ({"layout__tail__synchronised": "on"}, 0.0, 1.0),
        ({"drive__fluid_coupling": {"torque_limit": 1.6, "slip": "3 %", "rise_time": "8 s"}}, 0.0, 1.0),
        ({"scenes": [START]}, 0.0, 1.0),
        ({"drive__motor": {"inertia": "0.2 kg*m^2", "mean_starting_torque": "300 N*m", "count": 2}}, 0.0, 1.0),
    ],
)
def test_equal_motors_share_on_their_slip_lines(changes: dict[str, Any], low: float, high: float) -> None:
    """One motor with 30 % more slip against one with 30 % less: 1/1.3 against 1/0.7."""
    data = changed(driven(RUN, drive__motor=PLATES), **changes)
    (found,) = (one for one in loaded(data).assumed if one.path[-1] == "share")
    assert (found.value, found.interval.low, found.interval.high) == pytest.approx((0.5, low, high))


def test_a_share_that_overloads_one_of_two_motors_fails() -> None:
    """Both together have 144 N*m, and pull with 103 N*m; nine tenths of that are too much for one of them."""
    data = driven(RUN, share=0.5, drive__motor=PLATES, drive__gear={"ratio": 52, "efficiency": 0.93}, speed="0.6 m/s")
    arm, rated = 8 * 0.16 / (2 * math.pi), 11e3 / (1460 * math.pi / 30)
    torque = (BACK + ON) * arm / 52 / 0.93
    for share, most, expected in ((0.5, 0.5, Verdict.PASS), (0.9, 0.9, Verdict.FAIL), (0.1, 0.9, Verdict.FAIL)):
        one = changed(data, layout__tail__share=share)
        found = load_of(scene_of(report_of(one)), "motor_utilisation").estimate.value
        assert found == pytest.approx(most * torque / rated, rel=1e-9)
        assert verdict(one, "CHN131") is expected


def test_a_torque_limiter_feels_its_sprocket_alone() -> None:
    limiter = {"torque": "5 kN*m", "tolerance": "10 %", "type": "slip_clutch"}
    arm = 8 * 0.16 / (2 * math.pi)
    for share, expected in ((0.1, Verdict.FAIL), (0.4, Verdict.PASS)):
        data = driven(RUN, share=share, torque_limiter=limiter)
        found = load_of(scene_of(report_of(data)), "limiter_reserve").estimate.value
        assert found == pytest.approx(5e3 / ((1 - share) * (BACK + ON) * arm), rel=1e-9)
        assert verdict(data, "CHN136") is expected


def test_a_return_strand_is_moved_by_the_teeth_of_both_sprockets() -> None:
    """A screw holds it: the joints of both sprockets, half a pitch apart, stretch and relax it once a tooth, by twice
    R sin(pi/2z) - p/4. A tail that pulls all makes its end the most tensioned place of the chain."""
    screw = {"type": "screw", "tension": "40 kN"}
    data = driven(RUN, share=1.0, layout__takeup=screw, layout__tail__phase=0.5, speed="0.01 m/s", accuracy="1 %")
    found = scene_of(report_of(data))
    half = math.pi / 8
    added = 2 * (0.08 / math.sin(half) * math.sin(half / 2) - 0.04) * 64e6 / 40
    leaving = 40e3 - (3 * BACK - 2 * (BACK + ON) + ON) / 4
    assert load_of(found, "tension_run_off").estimate.value == pytest.approx(leaving, rel=1e-9)
    assert load_of(found, "tension_design").estimate.value == pytest.approx(leaving + BACK + added, abs=0.02 * added)
