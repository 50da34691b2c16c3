"""Collisions and buffers against integrated equations of motion."""

import math

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from ptmcalc.laws import buffer

M1, M2, C, W, V = 5000.0, 2100.0, 6e5, 4000.0, 0.8


def stop(mass: float, stiffness: float, push: float, speed: float) -> tuple[float, float]:
    """Force and path of a spring where a mass under a constant push comes to rest, by integration."""

    def rate(t: float, y: np.ndarray) -> list[float]:
        return [y[1], (push - stiffness * y[0]) / mass]

    def rest(t: float, y: np.ndarray) -> float:
        return float(y[1])

    rest.terminal, rest.direction = True, -1.0  # type: ignore[attr-defined]
    run = solve_ivp(rate, (0, 100), [0.0, speed], events=rest, rtol=1e-11, atol=1e-13)
    return stiffness * run.y[0, -1], run.y[0, -1]


def column_force(contact: float, restitution: bool, push: float) -> float:
    """Largest column force of trolley, column and lower end that strikes a wall of stiffness `contact`."""
    damper = 0.0 if restitution else 2 * math.sqrt(contact * M2)

    def rate(t: float, y: np.ndarray) -> list[float]:
        column = C * (y[0] - y[1])
        wall = max(contact * y[1] + damper * y[3], 0.0) if y[1] > 0 else 0.0
        held = push if push > 0 or y[2] > 0 else 0.0
        return [y[2], y[3], (held - column) / M1, (column - wall) / M2]

    run = solve_ivp(rate, (0, 0.35), [0.0, 0.0, V, V], rtol=1e-9, atol=1e-11, dense_output=True, max_step=2e-4)
    y = run.sol(np.linspace(0, 0.35, 20001))
    return float(np.max(C * (y[0] - y[1])))


class TestCollision:
    @pytest.mark.parametrize("resistance", [0.0, 4000.0, 60000.0, -9000.0])
    @pytest.mark.parametrize(("reading", "mass"), [(buffer.TIP_STOPPED, M1), (buffer.WHOLE, M1 + M2)])
    def test_energy_by_integration(self, resistance: float, reading: str, mass: float) -> None:
        force, _ = stop(mass, C, -resistance, V)
        assert buffer.collision_force(M1, M2, C, V, resistance, reading) == pytest.approx(force, rel=1e-9)

    @pytest.mark.parametrize("push", [-4000.0, 0.0, 9000.0])
    @pytest.mark.parametrize("restitution", [False, True], ids=["plastic", "elastic"])
    def test_no_contact_takes_the_column_beyond_its_bound(self, push: float, restitution: bool) -> None:
        found = column_force(3e8, restitution, push)
        assert found <= buffer.collision_force_bound(M1, M2, C, V, max(push, 0.0)) * (
            1 + 1e-3
        )  # the wall gives a little

    def test_a_plastic_contact_is_close_to_the_first_reading(self) -> None:
        found = column_force(3e8, False, -W)
        assert buffer.collision_force(M1, M2, C, V, W, buffer.TIP_STOPPED) == pytest.approx(found, rel=0.02)

    def test_the_bound_is_attained_by_a_tip_without_mass(self) -> None:
        bound = buffer.collision_force_bound(M1, 0.0, C, V, 0.0)
        assert buffer.collision_force(M1, 0.0, C, V, 0.0, buffer.WHOLE) == pytest.approx(bound, rel=1e-14)

    def test_column_and_buffer_share_the_force(self) -> None:
        springs = np.array([[1 / C, 0.0], [0.0, 1 / 3e5]])
        shared = 1.0 / (np.ones(2) @ springs @ np.ones(2))
        assert buffer.series_stiffness(C, 3e5) == pytest.approx(shared, rel=1e-14)


class TestBuffers:
    def test_linear_and_driven(self) -> None:
        assert buffer.linear_buffer(M1, C, V) == pytest.approx(stop(M1, C, 0.0, V), rel=1e-9)
        for push in (-3e4, 5e3, 8e4):
            assert buffer.driven_buffer(push, M1, C, V) == pytest.approx(stop(M1, C, push, V), rel=1e-9)

    def test_constant_force_takes_the_energy_over_its_stroke(self) -> None:
        force = buffer.constant_force_buffer(M1, 0.15, V)
        done = solve_ivp(
            lambda t, y: [y[1], -force / M1], (0, M1 * V / force), [0.0, V], rtol=1e-11, atol=1e-13
        )  # to rest
        assert done.y[:, -1] == pytest.approx([0.15, 0.0], abs=1e-9)

    def test_orifice(self) -> None:
        k = 9e3

        def rate(t: float, y: np.ndarray) -> list[float]:
            return [y[1], -k * y[1] ** 2 / M1]

        times = np.linspace(0, 4, 9)
        y = solve_ivp(rate, (0, 4), [0.0, V], t_eval=times, rtol=1e-11, atol=1e-13).y
        assert buffer.orifice_buffer_path(times, M1, k, V) == pytest.approx(y[0], rel=1e-8, abs=1e-12)
        assert buffer.orifice_buffer_speed(y[0], M1, k, V) == pytest.approx(y[1], rel=1e-8)
        assert buffer.orifice_buffer_force(y[0], M1, k, V) == pytest.approx(k * y[1] ** 2, rel=1e-8)
        work = quad(lambda x: float(buffer.orifice_buffer_force(x, M1, k, V)), 0, float(y[0, -1]), epsrel=1e-12)[0]
        assert work == pytest.approx(M1 * (V**2 - y[1, -1] ** 2) / 2, rel=1e-8)


class TestFactor:
    @pytest.mark.parametrize(("share", "factor"), [(0.0, 1.25), (0.3, 1.25), (0.5, 1.25), (0.7, 1.39), (1.0, 1.6)])
    def test_of_the_standard(self, share: float, factor: float) -> None:
        assert buffer.buffer_factor(share) == pytest.approx(factor, rel=1e-14)

    def test_of_the_usual_buffers(self) -> None:
        """Share of the energy from the curve itself: linear, constant, one orifice over two e-folds of the speed."""
        curves = [lambda u: u, lambda u: 1.0, lambda u: math.exp(-4 * u)]
        shares = [quad(curve, 0, 1)[0] for curve in curves]
        assert [buffer.buffer_factor(min(share, 1.0)) for share in shares] == pytest.approx([1.25, 1.6, 1.25], rel=1e-9)
