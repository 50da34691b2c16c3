"""The safety gear: the fall and the catch integrated, and a mast under a sudden force."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from ptmcalc.laws import safety_gear

GRAVITY = 9.81
SEEDS = range(8)


def fallen(speed: float, until: float) -> tuple[float, float]:
    """Time and way of a free fall until a speed."""

    def reached(_: float, y: np.ndarray) -> float:
        return float(y[1] - until)

    reached.terminal = True  # type: ignore[attr-defined]
    run = solve_ivp(lambda t, y: [y[1], GRAVITY], (0, 10), [0, speed], rtol=1e-11, atol=1e-13, events=reached)
    return float(run.t[-1]), float(run.y[0, -1])


def caught(mass: float, speed: float, constant: float, stiffness: float) -> tuple[float, float]:
    """Way until rest, and the force there, against a constant force and a spring."""

    def rests(_: float, y: np.ndarray) -> float:
        return float(y[1])

    rests.terminal, rests.direction = True, -1  # type: ignore[attr-defined]

    def rate(_: float, y: np.ndarray) -> list[float]:
        return [y[1], GRAVITY - (constant + stiffness * y[0]) / mass]

    run = solve_ivp(rate, (0, 100), [0, speed], method="DOP853", rtol=1e-11, atol=1e-14, events=rests)
    return float(run.y[0, -1]), constant + stiffness * float(run.y[0, -1])


@pytest.mark.parametrize("seed", SEEDS)
def test_fall_and_catch(seed: int) -> None:
    rng = np.random.default_rng(seed)
    mass, speed, ratio, reaction = (
        rng.uniform(300, 5e3),
        rng.uniform(0.1, 2),
        rng.uniform(1.2, 1.5),
        rng.uniform(0, 0.2),
    )
    time, _ = fallen(speed, ratio * speed)
    assert safety_gear.trip_speed(speed, ratio) == ratio * speed
    assert safety_gear.trip_time(speed, ratio, GRAVITY) == pytest.approx(time, rel=1e-8)
    caught_at = safety_gear.catch_speed(speed, ratio, reaction, GRAVITY)
    time, way = fallen(speed, caught_at)
    assert time == pytest.approx(safety_gear.trip_time(speed, ratio, GRAVITY) + reaction, rel=1e-8)
    assert safety_gear.fall_before_catch(speed, caught_at, GRAVITY) == pytest.approx(way, rel=1e-8)

    force = mass * GRAVITY * rng.uniform(1.2, 4)
    stroke, _ = caught(mass, caught_at, force, 0.0)
    assert safety_gear.progressive_distance(force, mass, caught_at, GRAVITY) == pytest.approx(stroke, rel=1e-8)
    assert safety_gear.gear_force_needed(mass, caught_at, stroke, GRAVITY) == pytest.approx(force, rel=1e-8)
    stiffness = 10 ** rng.uniform(5, 8)
    _, most = caught(mass, caught_at, 0.0, stiffness)
    assert safety_gear.instantaneous_force(mass, stiffness, caught_at, GRAVITY) == pytest.approx(most, rel=1e-8)


@pytest.mark.parametrize("share", [0.25, 0.5, 0.99, 1.0, 3.0])
@pytest.mark.parametrize("factor", [0.5, 1.0, 1.8])
def test_what_is_left_at_the_end_of_the_stroke(share: float, factor: float) -> None:
    mass, speed, stroke = 1600.0, 1.9, 0.18
    force = factor * mass * GRAVITY
    slows = safety_gear.progressive_deceleration(force, mass, GRAVITY)
    whole = safety_gear.progressive_distance(force, mass, speed, GRAVITY)
    stroke = share * (whole if math.isfinite(whole) else stroke)
    left = safety_gear.gear_speed_left(force, mass, speed, stroke, GRAVITY)
    energy = mass * speed**2 / 2 - mass * slows * stroke
    assert mass * left**2 / 2 == pytest.approx(max(energy, 0.0), rel=1e-9, abs=1e-9 * mass)


def test_a_gear_that_does_not_hold_never_stops() -> None:
    assert math.isinf(safety_gear.progressive_distance(1600.0 * GRAVITY, 1600.0, 1.9, GRAVITY))


def test_an_instantaneous_gear_is_never_below_twice_the_weight() -> None:
    assert safety_gear.instantaneous_force(1600.0, 4e6, 0.0, GRAVITY) == pytest.approx(2 * 1600.0 * GRAVITY)


def test_moment() -> None:
    assert safety_gear.eccentric_moment(3e4, 0.9) == pytest.approx(27e3)


@pytest.mark.parametrize("place", [0.35, 0.7, 1.0])
def test_axial_shock(place: float) -> None:
    """Modes of a rod under a sudden force, by Fejer's means, which do not overshoot at a wave front."""
    n = 2000
    k = np.arange(n)[:, None]
    b = (k + 0.5) * np.pi
    times = np.linspace(0, 6, 1500)
    foot = ((1 - k / n) * 2 / b * np.sin(b * place) * (1 - np.cos(b * times))).sum(axis=0)
    assert safety_gear.axial_shock(1.0) == pytest.approx(foot.max(), rel=2e-3)
