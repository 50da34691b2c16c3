"""Permitted starts per hour: the rule of manufacturers by hand, a run-up by an ODE solver, verdicts that turn."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.belt_scenes import Drive, Rig
from support.machines import changed, check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import SceneReport

FAST = 1500 * math.pi / 30
Z0, LOSSES, REST = 80.0, 0.3, {"self_ventilated_closed": 0.5, "separately_ventilated": 1.0}
STIFF = Rig(
    sections=((300.0, 12.0), (200.0, 6.0)), stiffness=4e12, start_factor=1.2, drives={"head": Drive(torque=4000.0)}
)
"""A belt without elongation: the drum has the speed of the rigid conveyor."""
STILL = {"checks": {code: {"off": "not of starts"} for code in ("CNV101", "CNV104", "CNV105", "CNV118", "CNV121")}}
FULL = {"type": "start", "profile": {"shape": "step"}}
SHORT = 0.5
"""Predicted seconds: the permitted starts are those of the rigid conveyor, no simulation of the belt changes them."""


def started(rig: Rig, power: float, asked: float | None = 3.0, **motor: Any) -> SceneReport:
    data = rig.data(FULL, **STILL)
    if asked is not None:
        data["starts_per_hour"] = asked
    rated = 0.99 * FAST
    permitted = {"no_load_starts": Z0, "constant_losses": LOSSES} | motor
    for drive in data["drives"].values() if "drives" in data else [data["drive"]]:
        drive["motor"] |= {"power": f"{power} W", "speed": f"{rated} rad/s", "no_load_speed": f"{FAST} rad/s"}
        drive["motor"] |= {"breakdown_ratio": 2.4} | {key: one for key, one in permitted.items() if one is not None}
    return scene_of(report_of(data, budget=SHORT))


def load_factor(load: float, cooling: str = "self_ventilated_closed") -> float:
    """Heat that running leaves for starts, over that of half an hour without load and half an hour at rest."""
    running = LOSSES + (1 - LOSSES) * load**2
    return max(1 - running, 0.0) / (0.5 * (1 - LOSSES) + 0.5 * REST[cooling])


@pytest.mark.parametrize("cooling", [None, "separately_ventilated"])
@pytest.mark.parametrize("torque", [3200.0, 4500.0])
def test_a_constant_torque_gives_the_rule_of_manufacturers(torque: float, cooling: str | None) -> None:
    """Z = Z_0 J/(J + J_X) (1 - M_L/M_H) k_P, but for the slip at rated speed."""
    rig, drive, power = STIFF, replace(STIFF.drives["head"], torque=torque), 560e3
    rig = replace(rig, drives={"head": drive})
    one, turns = power / (0.99 * FAST), drive.ratio * 2 / drive.diameter
    moved = rig.mass() / (turns**2 * drive.efficiency)  # J + J_X, the losses of the gear in it
    inertia, counter = drive.rotor / moved, 1 - rig.resistance(factor=1.2) / (drive.force)
    load = rig.resistance() / (turns * drive.efficiency * one)
    part = rig.speed * turns / FAST  # the start ends at the speed of the belt: (w_0 - w/2) w instead of w_0^2/2
    right = Z0 * inertia * counter * load_factor(load, cooling or "self_ventilated_closed") / (part * (2 - part))
    found = load_of(started(rig, power, cooling=cooling), "starts_permitted[head]").estimate
    assert found.value == pytest.approx(right, rel=2e-3)
    assert found.low <= right * (1 + 1e-4)


@pytest.mark.parametrize("seed", range(6))
def test_starts_along_a_curve_by_an_ode_solver(seed: int) -> None:
    """Heat of the rotor along locked-rotor, pull-up and breakdown torque, of random belts and motors."""
    rng = np.random.default_rng([seed, 129])
    slip, locked, most = rng.uniform(0.01, 0.03), rng.uniform(1.8, 2.6), rng.uniform(2.2, 3.0)
    drive = Drive(rotor=rng.uniform(3, 9), ratio=rng.uniform(18, 24), efficiency=rng.uniform(0.9, 0.97))
    rig = Rig(sections=((rng.uniform(200, 600), rng.uniform(0, 9)),), stiffness=4e12, load=rng.uniform(60, 150))
    turns, resistance = drive.ratio * 2 / drive.diameter, rig.resistance()
    rated = resistance / (turns * drive.efficiency) * rng.uniform(1.1, 1.6)
    rig = replace(rig, drives={"head": replace(drive, torque=rated)}, speed=0.97 * FAST / turns)
    power, at = rated * (1 - slip) * FAST, slip * (most + math.sqrt(most**2 - 1))
    knots = np.array([0.0, min(FAST / 3, (1 - at) * FAST / 2), (1 - at) * FAST])

    def torque(speed: float) -> float:
        if speed >= knots[-1]:
            one = 1 - speed / FAST
            return float(rated * 2 * most / (one / at + at / one))
        return float(rated * np.interp(speed, knots, [locked, 0.85 * locked, most]))

    def rate(time: float, state: np.ndarray) -> list[float]:
        pull = turns * drive.efficiency * torque(state[0] * turns)
        return [(pull - resistance) / rig.mass(), torque(state[0] * turns) * (FAST - state[0] * turns)]

    def full(time: float, state: np.ndarray) -> float:
        return float(state[0] - rig.speed)

    full.terminal = True  # type: ignore[attr-defined]
    heat = solve_ivp(rate, (0, 600), [0.0, 0.0], events=full, rtol=1e-10, atol=1e-8, max_step=0.05).y[1, -1]
    load = resistance / (turns * drive.efficiency) / rated
    right = Z0 * load_factor(load) * drive.rotor * FAST**2 / 2 / heat
    motor = {"mean_starting_torque": None, "locked_rotor_ratio": locked, "breakdown_ratio": most}
    data = changed(rig.data({"type": "start"}, **STILL), starts_per_hour=1)
    data["drive"]["motor"] |= {"power": f"{power!r} W", "speed": f"{(1 - slip) * FAST!r} rad/s"}
    data["drive"]["motor"] |= {"no_load_starts": Z0, "constant_losses": LOSSES} | motor
    del data["drive"]["motor"]["mean_starting_torque"]
    found = load_of(scene_of(report_of(data)), "starts_permitted[head]").estimate
    assert found.value == pytest.approx(right, rel=3e-3)


def test_more_starts_than_permitted_fail() -> None:
    most = load_of(started(STIFF, 560e3), "starts_permitted[head]").estimate
    assert check_of(started(STIFF, 560e3, 0.9 * most.low), "CNV129").verdict is Verdict.PASS
    failed = check_of(started(STIFF, 560e3, 1.1 * most.high), "CNV129")
    assert failed.verdict is Verdict.FAIL
    assert failed.blame.path == ("starts_per_hour",)


def test_starts_of_the_manufacturer_hold_as_they_are() -> None:
    given = {"no_load_starts": None, "constant_losses": None, "starts_per_hour": 4}
    assert check_of(started(STIFF, 560e3, 4, **given), "CNV129").verdict is Verdict.PASS
    assert check_of(started(STIFF, 560e3, 5, **given), "CNV129").verdict is Verdict.FAIL
    assert check_of(started(STIFF, 560e3, None, **given), "CNV129").verdict is Verdict.NOT_CHECKED


def test_running_at_the_rating_leaves_nothing_for_starts() -> None:
    drive = STIFF.drives["head"]
    rated = STIFF.resistance() * drive.diameter / 2 / drive.ratio / drive.efficiency
    scene = started(STIFF, 0.999 * rated * 0.99 * FAST)
    assert load_of(scene, "starts_permitted[head]").estimate.value == 0.0
    assert check_of(scene, "CNV129").verdict is Verdict.FAIL


def test_assumed_losses_are_tried_at_both_ends() -> None:
    scene = started(STIFF, 560e3, constant_losses=None)
    value = load_of(scene, "starts_permitted[head]").estimate.value
    assert check_of(started(STIFF, 560e3, value, constant_losses=None), "CNV129").verdict is Verdict.UNDECIDED


def test_without_a_limit_of_the_motor_the_check_names_its_key() -> None:
    scene = started(STIFF, 560e3, 3, no_load_starts=None, constant_losses=None)
    assert check_of(scene, "CNV129").verdict is Verdict.NOT_CHECKED


def test_one_limit_of_the_motor() -> None:
    with pytest.raises(AssertionError, match="given by `starts_per_hour` already"):
        started(STIFF, 560e3, starts_per_hour=5)
    with pytest.raises(AssertionError, match="belongs to the no-load starts"):
        started(STIFF, 560e3, no_load_starts=None)
