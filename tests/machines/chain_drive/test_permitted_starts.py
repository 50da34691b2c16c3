"""Permitted starts per hour of chain motors: the rule of manufacturers by hand, a run-up by an ODE solver."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.chain_starts import scraper
from support.machines import changed, check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import SceneReport

FAST = 1500 * math.pi / 30
Z0, LOSSES = 500.0, 0.3
RATIO, ETA, ROTOR = 42.0, 0.93, 0.35
ARM = 8 * 0.16 / (2 * math.pi)
SPEED = 0.75
STIFF = {"chain": scraper()["chain"] | {"stiffness": "1e6 MN"}, "effects": {"tooth_passing": "off"}}
"""A chain without elongation: the sprocket has the speed of the rigid chain."""


def resistance(factor: float) -> float:
    """Of the chain in a start with a factor, as the program gives it: its formula has a test of its own [N]."""
    data = changed(scraper(), layout__resistance__start_factor=factor)
    return load_of(scene_of(report_of(data)), "static_resistance").estimate.value


def started(asked: float | None = 10.0, **motor: Any) -> SceneReport:
    data = scraper(speed=f"{SPEED} m/s", **STIFF)
    if asked is not None:
        data["starts_per_hour"] = asked
    plate = {"power": "30 kW", "speed": f"{0.98 * FAST} rad/s", "no_load_speed": f"{FAST} rad/s"}
    permitted = {"no_load_starts": Z0, "constant_losses": LOSSES}
    motor = data["drive"]["motor"] | plate | permitted | motor
    data["drive"]["motor"] = {key: one for key, one in motor.items() if one is not None}
    return scene_of(report_of(data))


def load_factor(load: float) -> float:
    """Heat that running leaves for starts, over that of half an hour without load and half an hour at rest."""
    running = LOSSES + (1 - LOSSES) * load**2
    return max(1 - running, 0.0) / (0.5 * (1 - LOSSES) + 0.5 * 0.5)


def running_load() -> float:
    """Torque of steady running over the rated torque."""
    return resistance(1.0) * ARM / RATIO / ETA / (30e3 / (0.98 * FAST))


@pytest.mark.parametrize("torque", [260.0, 420.0])
def test_a_constant_torque_gives_the_rule_of_manufacturers(torque: float) -> None:
    """Z = Z_0 J/(J + J_X) (1 - M_L/M_H) k_P, but for the slip at rated speed."""
    report = started(mean_starting_torque=f"{torque} N*m")
    whole = load_of(report, "reduced_inertia").estimate.value
    counter = 1 - resistance(1.2) * ARM / RATIO / ETA / torque
    part = SPEED / ARM * RATIO / FAST  # the start ends at the speed of the chain: (w_0 - w/2) w instead of w_0^2/2
    right = Z0 * ROTOR / whole * counter * load_factor(running_load()) / (part * (2 - part))
    found = load_of(report, "starts_permitted").estimate
    assert found.value == pytest.approx(right, rel=2e-3)
    assert found.low <= right <= found.high


@pytest.mark.parametrize(("locked", "most"), [(2.0, 2.5), (1.6, 2.8)])
def test_starts_along_a_curve_by_an_ode_solver(locked: float, most: float) -> None:
    """Heat of the rotor along locked-rotor, pull-up and breakdown torque, up to 99 % of the steady speed."""
    slip, rated = 0.02, 30e3 / (0.98 * FAST)
    at = slip * (most + math.sqrt(most**2 - 1))
    knots = np.array([0.0, min(FAST / 3, (1 - at) * FAST / 2), (1 - at) * FAST])

    def torque(speed: float) -> float:
        if speed >= knots[-1]:
            one = 1 - speed / FAST
            return float(rated * 2 * most / (one / at + at / one)) if one else 0.0
        return float(rated * np.interp(speed, knots, [locked, 0.85 * locked, most]))

    report = started(mean_starting_torque=None, locked_rotor_ratio=locked, breakdown_ratio=most)
    whole, turns = load_of(report, "reduced_inertia").estimate.value, RATIO / ARM
    counter = resistance(1.2) / turns / ETA

    def rate(time: float, state: np.ndarray) -> list[float]:
        return [(torque(state[0]) - counter) / whole, torque(state[0]) * (FAST - state[0])]

    run = solve_ivp(rate, (0, 60), [0.0, 0.0], rtol=1e-10, atol=1e-8, max_step=0.01)
    last = int(np.argmax(run.y[0] >= 0.99 * run.y[0].max()))
    right = Z0 * load_factor(running_load()) * ROTOR * FAST**2 / 2 / run.y[1, last]
    found = load_of(report, "starts_permitted").estimate
    assert found.value == pytest.approx(right, rel=5e-3)


def test_more_starts_than_permitted_fail() -> None:
    most = load_of(started(), "starts_permitted").estimate
    assert check_of(started(0.9 * most.low), "CHN137").verdict is Verdict.PASS
    failed = check_of(started(1.1 * most.high), "CHN137")
    assert failed.verdict is Verdict.FAIL
    assert failed.blame.path == ("starts_per_hour",)


def test_an_elastic_chain_has_a_wider_bar_around_the_same_value() -> None:
    stiff = load_of(started(), "starts_permitted").estimate
    data = scraper(speed=f"{SPEED} m/s", starts_per_hour=10)
    data["drive"]["motor"] |= {"power": "30 kW", "speed": f"{0.98 * FAST} rad/s", "no_load_speed": f"{FAST} rad/s"}
    data["drive"]["motor"] |= {"no_load_starts": Z0, "constant_losses": LOSSES}
    soft = load_of(scene_of(report_of(data)), "starts_permitted").estimate
    assert soft.low < stiff.value < soft.high
    assert soft.high - soft.low > stiff.high - stiff.low


def test_a_motor_that_does_not_start_permits_no_start() -> None:
    scene = started(mean_starting_torque="100 N*m")
    assert load_of(scene, "starts_permitted").estimate.value == 0.0
    assert check_of(scene, "CHN137").verdict is Verdict.FAIL


def test_starts_of_the_manufacturer_hold_as_they_are() -> None:
    given = {"no_load_starts": None, "constant_losses": None, "starts_per_hour": 4}
    assert check_of(started(4, **given), "CHN137").verdict is Verdict.PASS
    assert check_of(started(5, **given), "CHN137").verdict is Verdict.FAIL
    assert check_of(started(None, **given), "CHN137").verdict is Verdict.NOT_CHECKED


def test_assumed_losses_are_tried_at_both_ends() -> None:
    value = load_of(started(constant_losses=None), "starts_permitted").estimate.value
    assert check_of(started(value, constant_losses=None), "CHN137").verdict is Verdict.UNDECIDED
