"""Laws of the main shaft against integrations, quadratures and each other's inverses that share nothing with them."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

from ptmcalc.laws import brake, shaft


class TestMotion:
    @pytest.mark.parametrize("speed", [0.0, 3.0, 40.0])
    def test_the_acceleration_conserves_energy(self, speed: float) -> None:
        """Without a torque J(phi) w^2 stays what it is while J goes from 2 + cos 0 to 2 + cos 1."""

        def rates(t: float, y: list[float]) -> list[float]:
            inertia, slope = 2 + math.cos(y[0]), -math.sin(y[0])
            return [y[1], float(shaft.acceleration(0.0, inertia, slope, y[1]))]

        done = solve_ivp(rates, (0, 1 / max(speed, 1)), [0.0, speed], rtol=1e-11, atol=1e-12)
        phi, w = done.y[:, -1]
        assert (2 + math.cos(phi)) * w**2 == pytest.approx(3 * speed**2, rel=1e-9)

    def test_torque_and_acceleration_are_inverses(self) -> None:
        eps = shaft.acceleration(90.0, 30.0, -8.0, 12.0)
        assert shaft.torque_of_motion(30.0, -8.0, 12.0, eps) == pytest.approx(90.0, rel=1e-14)

    def test_at_rest_only_torque_and_inertia_count(self) -> None:
        """(6.8): eps_0 = (M_start u eta - M_res)/J, of the worked case."""
        assert shaft.acceleration(321.0878 - 35, 30.0, 5.0, 0.0) == pytest.approx(9.53626, rel=1e-5)

    def test_speed_after_work_is_the_integral_of_the_motion(self) -> None:
        """J = 2 + cos phi, constant torque 1 from rest: w^2 = 2 M phi/J."""
        w = shaft.speed_after_work(3.0, 0.0, math.pi, 1.0)
        assert w == pytest.approx(2.5066282746310007, rel=1e-15)

        def rates(phi: float, y: list[float]) -> list[float]:
            return [(1 + math.sin(phi) * y[0] ** 2 / 2) / (2 + math.cos(phi)) / y[0]]

        low = 1e-3  # w^2 = 2 phi/3 at first
        done = solve_ivp(rates, (low, math.pi), [math.sqrt(2 * low / 3)], rtol=1e-11, atol=1e-13)
        assert done.y[0, -1] == pytest.approx(float(w), rel=1e-4)

    def test_work_that_takes_all_there_is_stops_the_shaft(self) -> None:
        assert shaft.speed_after_work(10.0, 100.0, -50000.00000000001, 10.0) == 0.0
        assert shaft.speed_after_work(10.0, 100.0, -50001.0, 10.0) == 0.0
        assert shaft.speed_after_work(10.0, 100.0, -49999.0, 10.0) == pytest.approx(math.sqrt(0.2), rel=1e-9)


class TestGear:
    @pytest.mark.parametrize("motor", [-60.0, -1.0, 0.0, 4.0, 60.0])
    @pytest.mark.parametrize("resistance", [-300.0, 0.0, 300.0])
    @pytest.mark.parametrize("rotor", [0.0, 0.3])
    def test_the_factor_agrees_with_the_torque_it_makes(self, motor: float, resistance: float, rotor: float) -> None:
        """Both shafts solved with the factor give a torque through the gear of the sign it belongs to."""
        u, eta, back, inertia = 12.0, 0.94, 0.8, 30.0
        f = float(shaft.gear_factor(motor, rotor, inertia, u, resistance, eta, back))
        # rotor: J_m u e = M - N;   shaft: J e = u f N - R
        matrix = np.array([[rotor * u, 1.0], [inertia, -u * f]])
        _, through = np.linalg.solve(matrix, [motor, -resistance])
        assert f == pytest.approx(eta if through >= 0 else 1 / back)

    def test_without_losses_there_is_nothing_to_decide(self) -> None:
        factors = shaft.gear_factor(np.array([-5.0, 5.0]), 0.2, 30.0, 12.0, 90.0, 1.0, 1.0)
        assert factors.tolist() == [1.0, 1.0]


class TestCycle:
    def test_irregularity_by_its_definition(self) -> None:
        speeds = 10 + 0.3 * np.sin(np.linspace(0, 2 * np.pi, 1001))
        assert shaft.irregularity(speeds.max(), speeds.min()) == pytest.approx(0.06, rel=1e-4)

    @pytest.mark.parametrize("wanted", [0.05, 0.01, 0.002])
    def test_the_flywheel_gives_the_irregularity_it_is_for(self, wanted: float) -> None:
        """Constant motor torque, load 600 sin^2: the speed integrated with the flywheel swings by as much as wanted."""
        swing = 150.0  # integral of 300 cos(2 phi)
        added = float(shaft.flywheel_inertia(2 * swing, wanted, 10.0, 4.0))
        phi = np.linspace(0, 2 * np.pi, 4001)
        energy = (4 + added) * 100 / 2 + swing * np.sin(2 * phi)
        w = np.sqrt(2 * energy / (4 + added))
        assert (w.max() - w.min()) / ((w.max() + w.min()) / 2) == pytest.approx(wanted, rel=wanted**2 + 1e-6)

    def test_the_worked_case(self) -> None:
        """C23, with the mean speed of the cycle and the constant part of the inertia."""
        lost = 35 * 2 * math.pi
        useful = 900 * (6.28319 - 4.71239)
        mean = (lost + useful) / (2 * math.pi)
        swing = (935 - mean) * (6.28319 - 4.71239)
        assert shaft.flywheel_inertia(swing, 0.02, 12.9821, 30.0) == pytest.approx(284.561, rel=5e-5)
        assert shaft.cycle_efficiency(useful, lost) == pytest.approx(0.865385, rel=1e-6)
        assert shaft.loss_factor(useful, lost) == pytest.approx(0.134615, rel=4e-6)

    def test_efficiency_and_loss_factor_are_one_together(self) -> None:
        useful, lost = np.array([0.0, 3.0, 9.0]), np.array([2.0, 2.0, 0.0])
        assert (shaft.cycle_efficiency(useful, lost) + shaft.loss_factor(useful, lost)).tolist() == [1.0, 1.0, 1.0]
        assert shaft.cycle_efficiency(0.0, 0.0) + shaft.loss_factor(0.0, 0.0) == 1.0

    def test_the_criteria(self) -> None:
        """The largest J' of 34 - 4 cos(2 phi) is 8; a shaft with k w against it forgets in J/k."""
        assert shaft.inertia_criterion(-8.0, 12.0, 260.0) == pytest.approx(8 * 144 / 520)
        assert shaft.inertia_criterion(8.0, 12.0, 0.0) == math.inf
        assert shaft.inertia_criterion(0.0, 12.0, 0.0) == 0.0
        decay = solve_ivp(lambda t, y: [-820 / 34 * y[0]], (0, 0.48), [1.0], rtol=1e-10, atol=1e-12).y[0, -1]
        assert math.exp(-float(shaft.slope_criterion(0.48, 820.0, 34.0))) == pytest.approx(decay, rel=1e-6)


def stopped(
    inertia: float, speed: float, loss: float, viscous: float, torque: float, delay: float, rise: float
) -> tuple[float, float]:
    """Time and angle to rest by integration from corner to corner."""
    time, state = 0.0, [0.0, speed]
    for until in (delay, delay + rise, 1e6):
        if until <= time:
            continue
        middle = (time + min(until, time + 1)) / 2

        def rates(t: float, y: list[float], middle: float = middle) -> list[float]:
            share = 0.0 if middle < delay else (t - delay) / rise if middle < delay + rise else 1.0
            return [y[1], -(loss + viscous * y[1] + share * torque) / inertia]

        def rest(t: float, y: list[float]) -> float:
            return y[1]

        rest.terminal = True  # type: ignore[attr-defined]
        done = solve_ivp(rates, (time, until), state, method="DOP853", rtol=1e-12, atol=1e-13, events=rest)
        time, state = float(done.t[-1]), done.y[:, -1].tolist()
        if len(done.t_events[0]):
            break
    return time, state[0]


STOPS = [
    (30.0, 12.0, 35.0, 0.0, 300.0, 0.1, 0.2),
    (30.0, 12.0, 35.0, 5.0, 300.0, 0.1, 0.2),
    (30.0, 12.0, 35.0, 5.0, 300.0, 0.1, 0.0),
    (30.0, 12.0, 0.0, 0.5, 30.0, 0.1, 9.0),
    (30.0, 12.0, 5.0, 0.0, 0.0, 0.1, 0.2),
    (30.0, 12.0, 500.0, 1.0, 300.0, 0.9, 0.2),
    (30.0, 12.0, 400.0, 1.0, 300.0, 0.1, 3.0),
    (30.0, 12.0, -50.0, 1.0, 300.0, 0.1, 0.4),
    (30.0, 12.0, -50.0, 0.0, 51.0, 0.1, 0.0),
    (30.0, 12.0, 35.0, 80.0, 300.0, 0.1, 0.2),
    (30.0, 12.0, 35.0, 1e-9, 300.0, 0.1, 0.2),
]


class TestRunOut:
    @pytest.mark.parametrize("given", STOPS)
    def test_a_braked_stop_is_the_integral_of_its_motion(self, given: tuple[float, ...]) -> None:
        assert shaft.braked_stop(*given) == pytest.approx(stopped(*given), rel=1e-9)

    @pytest.mark.parametrize("x", [0.0, 1e-9, 0.4, 1.0, 1.0001, 3.0, 40.0])
    def test_weights_of_a_fading_motion(self, x: float) -> None:
        """Integrals of exp(-x (1 - u)) times 1, u and u^2/2 over u from 0 to 1."""
        parts: list[Callable[[float], float]] = [lambda u: 1.0, lambda u: u, lambda u: u * u / 2]
        expected = [quad(lambda u, part=part: math.exp(-x * (1 - u)) * part(u), 0, 1)[0] for part in parts]
        assert shaft._phi(x) == pytest.approx(expected, rel=1e-9)

    def test_without_viscous_losses_it_is_the_stop_of_a_brake(self) -> None:
        """The same stop by a law of another module."""
        time, angle = shaft.braked_stop(3.2, 104.0, 40.0, 0.0, 700.0, 0.1, 0.3)
        other = brake.brake_stop(3.2, 104.0, 700.0, -40.0, 0.1, 0.3, "linear")
        assert (time, angle) == pytest.approx(other[:2], rel=1e-12)

    def test_constant_torques_by_energy_and_momentum(self) -> None:
        assert shaft.braked_stop(30.0, 12.0, 35.0, 0.0, 300.0, 0.0, 0.0) == pytest.approx(
            (float(shaft.run_out_time(30.0, 12.0, 335.0)), float(shaft.run_out_angle(30.0, 12.0, 335.0))), rel=1e-14
        )

    @pytest.mark.parametrize(
        ("loss", "viscous", "torque", "delay"),
        [(0.0, 0.0, 0.0, 0.1), (0.0, 4.0, 0.0, 0.1), (-9.0, 4.0, 9.0, 0.1), (0.0, 4.0, 9.0, math.inf)],
    )
    def test_what_nothing_stops_goes_on_for_ever(
        self, loss: float, viscous: float, torque: float, delay: float
    ) -> None:
        assert shaft.braked_stop(30.0, 12.0, loss, viscous, torque, delay, 0.2) == (math.inf, math.inf)

    def test_a_shaft_at_rest_stays_there(self) -> None:
        assert shaft.braked_stop(30.0, 0.0, 0.0, 0.0, 0.0, 0.1, 0.2) == (0.0, 0.0)
        assert shaft.run_out_angle(30.0, 0.0, 0.0) == 0.0

    def test_only_the_inertia_at_the_beginning_counts(self) -> None:
        """Torque 20 on J = 2 + cos phi from w = 9 at phi = 0: J w dw = -(20 + J' w^2/2) dphi."""

        def rates(phi: float, y: list[float]) -> list[float]:
            return [-(20 - math.sin(phi) * y[0]) / (2 + math.cos(phi))]  # y = w^2/2

        def rest(phi: float, y: list[float]) -> float:
            return y[0]

        rest.terminal = True  # type: ignore[attr-defined]
        done = solve_ivp(rates, (0, 50), [40.5], events=rest, rtol=1e-11, atol=1e-12)
        assert done.t[-1] == pytest.approx(float(shaft.run_out_angle(3.0, 9.0, 20.0)), rel=1e-9)

    @pytest.mark.parametrize("angle", [0.3, 2.0, 6.80656])
    def test_the_brake_for_an_angle_stops_in_it(self, angle: float) -> None:
        torque = float(shaft.brake_torque_for_angle(30.0, 12.3294, angle, 35.0))
        assert shaft.run_out_angle(30.0, 12.3294, torque + 35) == pytest.approx(angle, rel=1e-13)
        assert torque == pytest.approx(
            brentq(lambda m: shaft.braked_stop(30.0, 12.3294, 35.0, 0.0, m, 0.0, 0.0)[1] - angle, 1, 1e5), rel=1e-9
        )

    def test_losses_that_are_enough_need_no_brake(self) -> None:
        assert shaft.brake_torque_for_angle(30.0, 12.0, 100.0, 35.0) == 0.0

    def test_what_can_be_recovered_is_the_work_of_the_brake(self) -> None:
        """300 of 335 N m over the way to rest, through a gear of 0.94."""
        angle = float(shaft.run_out_angle(30.0, 12.3294, 335.0))
        work = quad(lambda phi: 300.0, 0, angle)[0]
        energy = 30 * 12.3294**2 / 2
        assert shaft.recoverable_energy(energy, 35 * angle, 0.94) == pytest.approx(0.94 * work, rel=1e-12)
        assert shaft.recoverable_energy(energy, energy + 1, 0.94) == 0.0
