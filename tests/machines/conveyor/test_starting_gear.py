"""Starters and fluid couplings: the start of a stiff belt by an integration of its own."""

import math
from collections.abc import Callable
from typing import Any

import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from support.machines import check_of, load_of, loaded, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.engine.load import load_text

G, LENGTH, BELT, CARRY, BACK, LOAD, F = 9.81, 400.0, 18.0, 20.0, 10.0, 90.0, 0.022
RATIO, RADIUS, EFFICIENCY, ROTOR, TURBINE, SPEED = 20.0, 0.4, 0.95, 1.1, 0.3, 3.1
RATED_SPEED, SYNCHRONOUS, LOCKED, BREAKDOWN = 1480 * math.pi / 30, 1500 * math.pi / 30, 2.0, 2.4
RATED = 75e3 / RATED_SPEED
RESISTANCE = 1.2 * F * G * (2 * BELT + CARRY + BACK + LOAD) * LENGTH
MASS = (2 * BELT + CARRY + BACK + LOAD) * LENGTH
SLIP = 1 - RATED_SPEED / SYNCHRONOUS


def conveyor(**drive: Any) -> dict[str, Any]:
    return {
        "kind": "conveyor",
        "route": {"length": f"{LENGTH} m"},
        "belt": {"mass": f"{BELT} kg/m", "stiffness": "20000 MN", "breaking_force": "3 MN"},
        "idlers": {"carry": {"line_mass": f"{CARRY} kg/m"}, "return": {"line_mass": f"{BACK} kg/m"}},
        "load": {"mass": f"{LOAD} kg/m"},
        "resistance": {"coefficient": F, "secondary": 1, "start_factor": 1.2},
        "speed": f"{SPEED} m/s",
        "drive": {
            "motor": {
                "power": "75 kW", "speed": "1480 rpm", "inertia": f"{ROTOR} kg*m^2", "locked_rotor_ratio": LOCKED,
                "breakdown_ratio": BREAKDOWN,
            },
            "coupling_inertia": f"{TURBINE} kg*m^2",
            "gear": {"ratio": RATIO, "efficiency": EFFICIENCY},
            "drum": {"diameter": f"{2 * RADIUS} m", "wrap": "200 deg", "inertia": "0 kg*m^2"},
            **drive,
        },
        "takeup": {"type": "gravity", "tension": "90 kN"},
        "tail_drum": {"inertia": "0 kg*m^2"},
        "scenes": [{"type": "start"}],
    }  # fmt: skip


def cage(turning: float) -> float:
    """Torque of the motor: straight lines to the breakdown torque, and the formula of Kloss above it."""
    at_breakdown = SLIP * (BREAKDOWN + math.sqrt(BREAKDOWN**2 - 1))
    top = (1 - at_breakdown) * SYNCHRONOUS
    slip = 1 - turning / SYNCHRONOUS
    if turning >= top:
        return 2 * BREAKDOWN * RATED * slip * at_breakdown / (slip**2 + at_breakdown**2)
    pull_up, third = 0.85 * LOCKED, SYNCHRONOUS / 3
    if turning < third:
        return RATED * (LOCKED + (pull_up - LOCKED) * turning / third)
    return RATED * (pull_up + (BREAKDOWN - pull_up) * (turning - third) / (top - third))


def star(time: float, turning: float) -> float:
    return cage(turning) / (3 if turning < 0.85 * SYNCHRONOUS else 1)


def soft(time: float, turning: float) -> float:
    return cage(turning) * (0.5 + 0.5 * min(time / 6, 1)) ** 2


def coupled(time: float, turning: float) -> float:
    return RATED * min(1.5, (1 - turning / SYNCHRONOUS) / (SLIP + 0.03)) * (1 - math.exp(-3 * time / 7))


CASES: dict[str, tuple[dict[str, Any], Callable[[float, float], float], float]] = {
    "direct": ({}, lambda time, turning: cage(turning), ROTOR + TURBINE),
    "star": ({"starter": {"type": "star_delta", "switch_over": 0.85}}, star, ROTOR + TURBINE),
    "soft": ({"starter": {"type": "soft", "initial_voltage": 0.5, "time": "6 s"}}, soft, ROTOR + TURBINE),
    "coupling": (
        {"fluid_coupling": {"torque_limit": 1.5, "slip": 0.03, "rise_time": "7 s", "start_heat": "9 MJ"}},
        coupled,
        TURBINE,
    ),
}


def integrated(torque: Callable[[float, float], float], inertia: float, end: float) -> tuple[float, float]:
    """Time to a speed [s], and heat of the slip until then [J]."""
    turns = RATIO / RADIUS
    mass = MASS + inertia * turns**2 * EFFICIENCY

    def rate(time: float, state: list[float]) -> list[float]:
        found = torque(time, state[0] * turns)
        net = found * turns * EFFICIENCY - RESISTANCE
        moves = net > 0 or state[0] > 0
        return [net / mass if moves else 0.0, found * (SYNCHRONOUS - state[0] * turns)]

    def reached(time: float, state: list[float]) -> float:
        return state[0] - end

    reached.terminal = True  # type: ignore[attr-defined]
    found = solve_ivp(rate, (0, 200), [0.0, 0.0], events=reached, rtol=1e-8, atol=1e-8, max_step=0.01)
    return float(found.t[-1]), float(found.y[1, -1])


@pytest.mark.parametrize("name", [name for name in CASES if name != "star"])
def test_a_stiff_belt_starts_as_one_mass_on_the_curve(name: str) -> None:
    keys, torque, inertia = CASES[name]
    scene = scene_of(report_of(conveyor(**keys)))
    turns = RATIO / RADIUS
    settles = brentq(
        lambda speed: torque(1e9, speed * turns) * turns * EFFICIENCY - RESISTANCE, 0.8 * SPEED, 1.1 * SPEED
    )
    time, heat = integrated(torque, inertia, SPEED if settles > SPEED else 0.98 * settles)
    assert load_of(scene, "start_time_rigid").estimate.value == pytest.approx(time, rel=0.02)
    if name == "coupling":
        found = load_of(scene, "coupling_start_heat[head]").estimate
        assert found.value == pytest.approx(heat, rel=0.02)
        assert check_of(scene, "CNV123").verdict is Verdict.PASS


def test_a_star_delta_starter_that_is_too_weak_fails() -> None:
    """A third of the pull-up torque against the resistance."""
    keys, _, _ = CASES["star"]
    scene = scene_of(report_of(conveyor(**keys)))
    reserve = RATED * 0.85 * LOCKED / 3 * RATIO / RADIUS * EFFICIENCY / RESISTANCE
    assert load_of(scene, "starting_reserve").estimate.value == pytest.approx(reserve, rel=1e-3)
    assert (check_of(scene, "CNV104").verdict is Verdict.PASS) == (reserve >= 1)


def test_the_heat_of_a_coupling_may_be_too_large() -> None:
    keys = {"fluid_coupling": {**CASES["coupling"][0]["fluid_coupling"], "start_heat": "100 kJ"}}
    assert check_of(scene_of(report_of(conveyor(**keys))), "CNV123").verdict is Verdict.FAIL


def test_a_coupling_shares_the_load_more_evenly_than_the_motors_alone() -> None:
    """Slip of the coupling in series with that of the motor: pulleys of 1000 mm and 990 mm."""

    def shares(**coupling: Any) -> float:
        data = conveyor(**coupling)
        one = data.pop("drive")
        small = {**one, "drum": {**one["drum"], "diameter": "0.798 m"}}
        data |= {"drives": {"a": one, "b": small}, "scenes": [{"type": "run"}]}
        scene = scene_of(report_of(data))
        used = [load_of(scene, f"motor_utilisation[{name}]").estimate.value for name in ("a", "b")]
        return used[0] - used[1]

    assert 0 < shares(fluid_coupling={}) < 0.5 * shares()


def test_what_is_not_given_of_a_coupling_is_assumed() -> None:
    assumed = {one.path[-1] for one in loaded(conveyor(fluid_coupling={})).assumed}
    assert {"torque_limit", "slip", "rise_time"} <= assumed


def test_a_coupling_needs_a_cage_motor() -> None:
    text = """
kind: conveyor
route: {length: 300 m}
belt: {mass: 15 kg/m, stiffness: 7 MN}
idlers: {carry: {line_mass: 18 kg/m}, return: {line_mass: 6 kg/m}}
load: {mass: 100 kg/m}
resistance: {secondary: 1.3}
speed: 2.5 m/s
drive:
  motor: {inertia: 1 kg*m^2, mean_starting_torque: 700 N*m}
  gear: {ratio: 24}
  drum: {diameter: 800 mm, wrap: 200 deg}
  fluid_coupling: {}
takeup: {type: gravity, tension: 60 kN}
"""
    found = load_text(text.encode(), "case.yaml").diagnostics
    assert [one.hint for one in found] == ["add `power: 90 kW` and `poles: 4` to `motor`"]
