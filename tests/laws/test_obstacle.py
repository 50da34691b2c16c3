"""Contact of a column's end with an obstacle, against its equation of motion."""

import math

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

from ptmcalc.laws import buffer, obstacle


def contact(v: float, m: float, force: float, x_r: float, n: float, damping: float) -> tuple[float, float]:
    """Largest force and indentation by the equation of motion."""

    def push(x: float, u: float) -> float:
        return force * (max(x, 0) / x_r) ** n * (1 + 1.5 * damping * u)

    def out(t: float, s: np.ndarray) -> float:
        return float(s[1])

    out.terminal, out.direction = True, -1  # type: ignore[attr-defined]
    span = 20 * math.sqrt(m * x_r / force)
    run = solve_ivp(
        lambda t, s: [s[1], -push(*s) / m], (0, span), [0, v], method="DOP853", rtol=1e-12, atol=1e-16, events=out,
        dense_output=True,
    )  # fmt: skip
    t = np.linspace(0, run.t[-1], 20001)
    x, u = run.sol(t)
    return max(push(a, b) for a, b in zip(x, u, strict=True)), float(run.y[0, -1])


@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.5])
@pytest.mark.parametrize("damping", [0.0, 0.02, 0.4, 5.0])
@pytest.mark.parametrize("speed", [0.2, 1.5])
def test_a_contact_with_damping(exponent: float, damping: float, speed: float) -> None:
    found = obstacle.damped_contact(speed, 2100.0, 3e5, 0.01, exponent, damping)
    assert found == pytest.approx(contact(speed, 2100.0, 3e5, 0.01, exponent, damping), rel=1e-7)


def test_without_damping_a_linear_one_is_a_spring() -> None:
    force, way = obstacle.damped_contact(0.8, 2100.0, 3e5, 0.01, 1.0, 0.0)
    assert force == pytest.approx(obstacle.elastic_contact_force(0.8, 3e7, 2100.0), rel=1e-14)
    assert way == pytest.approx(force / 3e7, rel=1e-14)


def test_the_series_of_weak_damping_meets_the_logarithm() -> None:
    below, above = (obstacle.damped_contact(1.0, 2100.0, 3e5, 0.01, 1.5, 0.05 / 1.5 * s) for s in (1 - 1e-9, 1 + 1e-9))
    assert below == pytest.approx(above, rel=1e-8)


class TestBound:
    def most(self, m1: float, m2: float, c: float, v: float, push: float, k: float) -> float:
        """Largest c x of a trolley on a spring over a mass that runs onto a spring, drive on, until the trolley stops
        for the first time."""

        def rates(t: float, s: np.ndarray) -> list[float]:
            u1, v1, u2, v2 = s
            x = u1 - u2
            return [v1, (push - c * x) / m1, v2, (c * x - k * max(u2, 0)) / m2]

        def stopped(t: float, s: np.ndarray) -> float:
            return float(s[1])

        stopped.terminal, stopped.direction = True, -1  # type: ignore[attr-defined]
        run = solve_ivp(rates, (0, 50), [0, v, 0, v], method="LSODA", rtol=1e-9, atol=1e-11, events=stopped,
                        max_step=0.02)  # fmt: skip
        return float(np.max(c * (run.y[0] - run.y[2])))

    def test_holds_over_a_sample_and_is_nearly_reached(self) -> None:
        rng = np.random.default_rng(7)
        nearest = 0.0
        for _ in range(60):
            m1, m2, c = 5e3 * rng.uniform(0.2, 3), 2e3 * rng.uniform(0.05, 2), 6e5 * 10 ** rng.uniform(-1, 1)
            v, k = rng.uniform(0.05, 1.0), c * 10 ** rng.uniform(-0.5, 2.5)
            push = rng.choice([0.0, 1.0]) * 2e4 * rng.uniform(0, 2)
            most = obstacle.column_force_bound(m1 + m2, c, v, push, k * 0.01, 0.01, 1.0)
            found = self.most(m1, m2, c, v, push, k)
            assert found <= most * (1 + 1e-6)
            nearest = max(nearest, found / most)
        assert nearest > 0.9

    def test_the_bound_without_indentation_is_exceeded_by_a_drive_on_a_soft_contact(self) -> None:
        """Theory 5.6: P + (P^2 + c (m_1 + m_2) v^2)^(1/2) is a bound for an obstacle that does not give."""
        m1, m2, c, v, push, k = 1374.2, 1e3, 1e5, 0.0044081, 238.387, 8.2397e5
        old = buffer.collision_force_bound(m1, m2, c, v, push)
        found = self.most(m1, m2, c, v, push, k)
        assert found > 1.01 * old
        assert found <= obstacle.column_force_bound(m1 + m2, c, v, push, k * 0.01, 0.01, 1.0)

    @pytest.mark.parametrize("exponent", [1.0, 1.5, 2.0])
    def test_what_the_indentation_adds_is_the_work_on_the_way_in(self, exponent: float) -> None:
        """P goes in by x where the contact pushes back as much, and what it does not store of P x is over."""
        push, force, deep = 4e3, 3e5, 0.01
        x = brentq(lambda x: force * (x / deep) ** exponent - push, 0.0, 2 * deep, xtol=1e-16, rtol=1e-14)
        over = push * x - quad(lambda u: force * (u / deep) ** exponent, 0, x)[0]
        most = push + math.sqrt(push**2 + 6e5 * (7.1e3 * 0.8**2 + 2 * over))
        found = obstacle.column_force_bound(7.1e3, 6e5, 0.8, push, force, deep, exponent)
        assert found == pytest.approx(most, rel=1e-9)

    def test_a_rigid_obstacle_and_a_drive_that_is_off(self) -> None:
        same = buffer.collision_force_bound(5e3, 2.1e3, 6e5, 0.8, 4e3)
        assert obstacle.column_force_bound(7.1e3, 6e5, 0.8, 4e3, 1.0, 0.0, 1.0) == pytest.approx(same, rel=1e-14)
        assert obstacle.column_force_bound(7.1e3, 6e5, 0.8, 0.0, 3e5, 0.01, 1.5) == pytest.approx(
            0.8 * math.sqrt(6e5 * 7.1e3), rel=1e-14
        )
