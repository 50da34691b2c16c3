"""Collisions and buffers against integrated equations of motion."""

import math
from collections.abc import Callable

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


def run_in(force: Callable[[float, float], float], mass: float, push: float, stroke: float) -> tuple[float, ...]:
    """Largest force, path and speed left of a crane that runs onto a buffer, to rest or to the end of the stroke."""

    def rate(t: float, y: np.ndarray) -> list[float]:
        return [y[1], (push - force(y[0], y[1])) / mass]

    def rest(t: float, y: np.ndarray) -> float:
        return float(y[1])

    def end(t: float, y: np.ndarray) -> float:
        return float(y[0] - stroke)

    rest.terminal = end.terminal = True  # type: ignore[attr-defined]
    rest.direction = -1.0  # type: ignore[attr-defined]
    run = solve_ivp(
        rate, (0, 1e3), [0.0, V], events=[rest, end], rtol=1e-11, atol=1e-13, method="DOP853", max_step=0.01
    )
    return max(force(*y) for y in run.y.T), run.y[0, -1], max(run.y[1, -1], 0.0)


class TestDriven:
    @pytest.mark.parametrize("push", [-9e3, 0.0, 6e3])
    @pytest.mark.parametrize("power", [0.5, 1.0, 2.0, 3.0])
    def test_progressive(self, push: float, power: float) -> None:
        end_force, stroke = 6e4, 0.12
        found = buffer.progressive_buffer(push, M1, V, end_force, stroke, power)
        seen = run_in(lambda u, v: end_force * max(u / stroke, 0.0) ** power, M1, push, 9.0)
        assert found == pytest.approx(seen[:2], rel=1e-8)
        if power == 1.0:
            assert found == pytest.approx(buffer.driven_buffer(push, M1, end_force / stroke, V), rel=1e-12)

    def test_a_drive_alone_presses_the_buffer_to_twice_its_force_and_nothing_to_none(self) -> None:
        assert buffer.progressive_buffer(5e3, M1, 0.0, 6e4, 0.12, 1.0)[0] == pytest.approx(1e4, rel=1e-12)
        assert buffer.progressive_buffer(-5e3, M1, 0.0, 6e4, 0.12, 1.0) == (0.0, 0.0)

    @pytest.mark.parametrize("power", [0.5, 1.0, 2.0, 3.0])
    @pytest.mark.parametrize("speed", [0.0, 1e-6])
    def test_a_steady_push_against_a_curve_of_a_power(self, power: float, speed: float) -> None:
        """At rest at first and last P u = F_e s/(p + 1) (u/s)^(p + 1), F = F_e (u/s)^p: F = (p + 1) P."""
        force, path = buffer.progressive_buffer(600.0, M1, speed, 6e4, 0.12, power)
        assert force == pytest.approx((power + 1) * 600.0, rel=1e-5)
        assert path == pytest.approx(0.12 * ((power + 1) * 0.01) ** (1 / power), rel=1e-5)

    @pytest.mark.parametrize("push", [-9e3, 0.0, 6e3, 9.9e3])
    def test_constant_force(self, push: float) -> None:
        stroke = buffer.constant_force_stroke(push, 1e4, M1, V)
        assert stroke == pytest.approx(run_in(lambda u, v: 1e4, M1, push, 1e3)[1], rel=1e-8)
        assert buffer.constant_force_stroke(1e4, 1e4, M1, V) == math.inf

    @pytest.mark.parametrize("push", [-9e3, -500.0, 0.0, 6e3, 3e4])
    def test_one_orifice(self, push: float) -> None:
        k, stroke = 9e3, 0.4
        force, path, left = run_in(lambda u, v: k * v * abs(v), M1, push, stroke)
        assert buffer.orifice_buffer_speed(path, M1, k, V, push) == pytest.approx(left, rel=1e-7, abs=1e-5)
        ends = buffer.orifice_buffer_force([0.0, path], M1, k, V, push)
        assert np.max(ends) == pytest.approx(force, rel=1e-9)
        if path < stroke - 1e-9:  # the brake stopped it on the way
            assert push < 0
            assert buffer.orifice_buffer_speed(stroke, M1, k, V, push) == 0.0

    @pytest.mark.parametrize("push", [-4e3, 0.0, 6e3])
    @pytest.mark.parametrize(
        ("curve", "energy"),
        [(lambda u, v: 4e4 * u, 4e4 * 0.15**2 / 2), (lambda u, v: 4e3, 4e3 * 0.15),
         (lambda u, v: 1e5 * max(u, 0.0) ** 2, 1e5 * 0.15**3 / 3)],
        ids=["spring", "constant", "square"],
    )  # fmt: skip
    def test_a_buffer_that_bottoms_out_leaves_a_speed(
        self, push: float, curve: Callable[[float, float], float], energy: float
    ) -> None:
        left = run_in(curve, M1, push, 0.15)[2]
        assert left > 0.1
        assert buffer.speed_left(push, M1, V, energy, 0.15) == pytest.approx(left, rel=1e-8)

    def test_one_that_is_strong_enough_leaves_none(self) -> None:
        assert buffer.speed_left(0.0, M1, V, M1 * V**2 / 2, 0.15) == 0.0
        assert buffer.speed_left(-9e3, M1, V, 1e4, 0.15) == 0.0


class TestTwoCranes:
    @pytest.mark.parametrize("pushes", [(0.0, 0.0), (4e3, -1e3), (-3e3, 5e3)])
    @pytest.mark.parametrize("speeds", [(0.8, 0.5), (1.2, -0.4)])
    def test_springs_between_two_bodies(self, pushes: tuple[float, float], speeds: tuple[float, float]) -> None:
        """Both cranes and both buffers integrated as they are."""
        masses, springs = (3e4, 5e4), (6e5, 3e5)
        c = buffer.series_stiffness(*springs)

        def rate(t: float, y: np.ndarray) -> list[float]:
            pressed = 1 / (1 / springs[0] + 1 / springs[1]) * (y[0] + y[1])  # both paths towards the other
            return [y[2], y[3], (pushes[0] - pressed) / masses[0], (pushes[1] - pressed) / masses[1]]

        t = np.linspace(0, 1.5, 40001)
        y = solve_ivp(rate, (0, 1.5), [0.0, 0.0, *speeds], t_eval=t, rtol=1e-10, atol=1e-12).y
        mass, speed, push = buffer.meeting(*masses, *speeds, *pushes)
        assert buffer.driven_buffer(push, mass, c, speed)[0] == pytest.approx(c * np.max(y[0] + y[1]), rel=1e-6)

    def test_against_a_wall(self) -> None:
        assert buffer.meeting(3e4, 1e20, 0.8, 0.0, 4e3, 0.0) == pytest.approx((3e4, 0.8, 4e3), rel=1e-12)

    def test_orifices_one_against_the_other(self) -> None:
        """Equal forces: k_1 v_1^2 = k_2 v_2^2, and both speeds make the speed of the cranes."""
        one, two, speed = 9e3, 4e4, 1.3
        first = speed / (1 + math.sqrt(one / two))
        force = one * first**2
        assert force == pytest.approx(two * (speed - first) ** 2)
        assert buffer.series_orifice(one, two) * speed**2 == pytest.approx(force, rel=1e-12)

    def test_a_hanging_load_does_not_count_and_a_guided_one_does(self) -> None:
        assert [buffer.collision_mass(2e4, 8e3, k) for k in (0.0, 0.5, 1.0)] == [2e4, 2.4e4, 2.8e4]


class TestShape:
    def test_of_a_curve_by_points(self) -> None:
        u = np.linspace(0, 0.2, 4001)
        for power in (0.0, 1.0, 2.5):
            assert buffer.energy_share(6e4 * u**power, u) == pytest.approx(1 / (1 + power), rel=1e-6)

    def test_of_one_orifice(self) -> None:
        u = np.linspace(0, 0.3, 20001)
        curve = buffer.orifice_buffer_force(u, M1, 9e3, V)
        assert buffer.orifice_energy_share(M1, 9e3, 0.3) == pytest.approx(buffer.energy_share(curve, u), rel=1e-7)


class TestFactor:
    @pytest.mark.parametrize(("share", "factor"), [(0.0, 1.25), (0.3, 1.25), (0.5, 1.25), (0.7, 1.39), (1.0, 1.6)])
    def test_of_the_standard(self, share: float, factor: float) -> None:
        assert buffer.buffer_factor(share) == pytest.approx(factor, rel=1e-14)

    def test_of_the_usual_buffers(self) -> None:
        """Share of the energy from the curve itself: linear, constant, one orifice over two e-folds of the speed."""
        curves = [lambda u: u, lambda u: 1.0, lambda u: math.exp(-4 * u)]
        shares = [quad(curve, 0, 1)[0] for curve in curves]
        assert [buffer.buffer_factor(min(share, 1.0)) for share in shares] == pytest.approx([1.25, 1.6, 1.25], rel=1e-9)

    def test_older_rules_know_springs_and_hydraulic_buffers(self) -> None:
        """Both editions agree at the ends; between them the older one asks for more."""
        old = [buffer.buffer_factor(xi, buffer.TWO_VALUES) for xi in (0.0, 0.5, 0.51, 1.0)]
        assert old == [1.25, 1.25, 1.6, 1.6]
        for xi in np.linspace(0, 1, 21):
            assert buffer.buffer_factor(xi) <= buffer.buffer_factor(xi, buffer.TWO_VALUES) + 1e-15
