"""Laws of slewing against sums and integrations of their own."""

import itertools
import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from ptmcalc.laws import slewing


def test_a_cubic_mean_weighs_the_largest_torque_most() -> None:
    shares, torques = [0.2, 0.5, 0.3], [10.0, 4.0, -7.0]
    mean = sum(share * abs(torque) ** 3 for share, torque in zip(shares, torques, strict=True)) ** (1 / 3)
    assert slewing.fatigue_torque(shares, torques) == pytest.approx(mean)
    assert slewing.fatigue_torque(shares, torques, 60.0) == pytest.approx(10.0 * 0.2 ** (1 / 60))
    assert slewing.fatigue_torque(shares, [0.0, 0.0, 0.0]) == 0.0


def test_torque_and_time_of_a_start_belong_together() -> None:
    time = float(slewing.uniform_start_time(6e4, 0.2, 9e3, 3e3))
    assert time == pytest.approx(2.0)
    assert float(slewing.torque_for_start(6e4, 0.2, time, 3e3)) == pytest.approx(9e3)
    assert float(slewing.uniform_start_time(6e4, 0.2, 3e3, 3e3)) == math.inf


def integrated(
    jib: float, rotor: float, eta: float, back: float, speed: float, motor: float, crane: float, against: float,
    delay: float, rise: float,
) -> tuple[float, float]:  # fmt: skip
    """The stop by DOP853: at each moment the direction of the power is the one that fits its own acceleration."""

    def slows(t: float) -> float:
        share = 0.0 if t < delay else min((t - delay) / rise, 1.0) if rise else 1.0
        held, free = motor * share, -crane * share - against
        driven = (free - held / back) / (jib + rotor / back)
        return driven if held + rotor * driven > 0 else (free - held * eta) / (jib + rotor * eta)

    def stands(t: float, y: np.ndarray) -> float:
        return float(y[1])

    stands.terminal = True  # type: ignore[attr-defined]
    stands.direction = -1  # type: ignore[attr-defined]
    state, since = np.array([0.0, speed]), 0.0
    for until in (delay, delay + rise, 1e4):
        if until <= since:
            continue
        inside = 1e-9 * (until - since)
        run = solve_ivp(
            lambda t, y, low=since + inside, high=until - inside: [y[1], slows(min(max(t, low), high))],
            (since, until), state, "DOP853", events=stands, rtol=1e-11, atol=1e-14, max_step=(until - since) / 50,
        )  # fmt: skip
        state, since = run.y[:, -1], float(run.t[-1])
        if run.status == 1:
            return since, float(state[0])
    return math.inf, math.inf


@pytest.mark.parametrize(
    ("back", "brakes", "against", "delay", "rise"),
    list(itertools.product((0.55, 0.9, 1.0), ((5e3, 0.0), (0.0, 8e3)), (1.5e3, -2e3), (0.0, 0.3), (0.0, 0.7, 7.0))),
)
def test_a_stop_through_the_gear_is_that_of_an_integration(
    back: float, brakes: tuple[float, float], against: float, delay: float, rise: float
) -> None:
    case = (6e4, 9e3, 0.7, back, 0.2, *brakes, against, delay, rise)
    assert slewing.geared_stop(*case) == pytest.approx(integrated(*case), rel=1e-6)


def test_a_crane_stops_by_itself_before_its_brake_acts() -> None:
    """The rotor drives through the gear: J + J_r eta under friction alone."""
    time, angle = slewing.geared_stop(6e4, 9e3, 0.7, 0.55, 0.1, 5e3, 0.0, 3e3, 100.0, 1.0)
    assert time == pytest.approx((6e4 + 9e3 * 0.7) * 0.1 / 3e3)
    assert angle == pytest.approx(0.1 * time / 2)


def test_a_brake_below_the_wind_never_stops_the_crane() -> None:
    assert slewing.geared_stop(6e4, 9e3, 0.7, 0.55, 0.1, 5e2, 0.0, -3e3, 0.1, 0.1) == (math.inf, math.inf)


def test_a_self_locking_gear_with_a_light_rotor_jams_as_the_brake_closes() -> None:
    """Under friction the rotor drives on; the brake slows it until the crane would have to drive it: then it jams. A
    wind that drives the crane jams it as soon as the motor is off."""
    time, angle = slewing.geared_stop(6e4, 9e3, 0.4, -0.5, 0.1, 5e3, 0.0, 3e2, 0.2, 0.1)
    assert 0.2 < time < 0.3
    assert 0.1 * 0.9 * time < angle < 0.1 * time
    assert slewing.geared_stop(6e4, 9e3, 0.4, -0.5, 0.1, 5e3, 0.0, -3e2, 0.2, 0.1) == (0.0, 0.0)


@pytest.mark.parametrize("wind", [-3e2, -2e3])
def test_a_gear_just_self_locking_is_the_limit_of_one_that_lets_back(wind: float) -> None:
    """At eta_r = 0 the motor brake stops its own rotor and nothing of the crane comes back to it."""
    case = (6e4, 9e3, 0.5)
    rest = (0.1, 5e3, 0.0, wind, 0.0, 0.3)
    found, near = slewing.geared_stop(*case, 0.0, *rest), slewing.geared_stop(*case, 1e-10, *rest)
    assert found == pytest.approx(near, rel=1e-6)
    assert found[0] == pytest.approx(0.15 + 0.1 * 9e3 / 5e3, rel=1e-12)  # half of the rise is lost


@pytest.mark.parametrize("seed", range(20))
def test_no_start_throws_a_load_beyond_its_reach(seed: int) -> None:
    """The bound is one of energy: a load that has it all, in a frame that turns with the crane, is just there."""
    rng = np.random.default_rng(seed)
    jib, mass, radius, rope, speed = (10 ** rng.uniform(a, b) for a, b in ((3, 6), (2, 4), (0, 1), (0, 1), (-2, 0)))
    reach, angle = slewing.swing_reach(jib, mass, radius, rope, speed, 9.81)
    if angle == math.pi:
        assert reach == radius + rope
        return
    if speed**2 * ((radius + rope) ** 2 + jib / mass) < 2 * 9.81 * rope:

        def beyond(r: float) -> float:
            return radius + rope * math.sin(math.acos(1 - speed**2 * (r**2 + jib / mass) / (2 * 9.81 * rope))) - r

        furthest = brentq(beyond, radius, radius + rope, xtol=1e-14, rtol=1e-14)
        assert furthest * (1 - 1e-12) <= reach <= furthest * (1 + 1e-8)
        steepest = math.acos(1 - speed**2 * (furthest**2 + jib / mass) / (2 * 9.81 * rope))
        assert steepest * (1 - 1e-12) <= angle <= steepest * (1 + 1e-7) + 1e-8
    assert reach >= radius + rope * math.sin(angle) * (1 - 1e-6)
    left = speed**2 * (reach**2 + jib / mass) / 2 - 9.81 * rope * (1 - math.cos(angle))
    assert left <= 1e-6 * speed**2 * (reach**2 + jib / mass)
    least, most = slewing.momentum_range(jib, mass, reach, speed)
    assert least < 0 < mass * reach**2 * speed < most
    assert least + most == pytest.approx(2 * mass * reach**2 * speed)
