"""Waves of a belt against chains of masses, finite elements and delay differential equations.

Reference methods: a chain of masses and springs (speed and impedance), the two conditions at a junction solved as
linear equations (reflection), the drum's differential equation (first wave), and the delay differential equation of a
uniform loop, integrated interval by interval (two contour times).
"""

import math
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp
from scipy.linalg import eigh_tridiagonal
from support import fem

from ptmcalc.laws import wave

steady = settings(derandomize=True, database=None, deadline=None, max_examples=100)
positive = st.floats(1e-3, 1e6)


class Chain:
    """Half-infinite belt as masses on springs, at rest, long enough that nothing comes back from its end."""

    def __init__(self, stiffness: float, line_mass: float, pitch: float, count: int) -> None:
        self.spring, self.mass = stiffness / pitch, line_mass * pitch
        self.pitch, self.count = pitch, count
        diagonal = np.full(count, 2.0)
        diagonal[-1] = 1.0
        values, self.modes = eigh_tridiagonal(diagonal, np.full(count - 1, -1.0))
        self.frequencies = np.sqrt(np.maximum(values, 0) * self.spring / self.mass)

    def pulled(self, speed: float, times: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Speeds of all masses and force at the end that moves with a constant speed from t = 0 on."""
        w = self.frequencies[:, None]
        # the last spring pulls with k s t; each mode answers q'' + w^2 q = k s t phi_0/m
        load = self.spring * speed / self.mass * self.modes[0][:, None]
        position = load * (times - np.sin(w * times) / w) / w**2
        rate = load * (1 - np.cos(w * times)) / w**2
        force = self.spring * (speed * times - self.modes[0] @ position)
        return self.modes @ rate, force


class TestSpeedAndImpedance:
    STIFFNESS, LINE_MASS, SPEED = 2.4e7, 73.0, 0.6

    def chain(self) -> tuple[Chain, np.ndarray, np.ndarray, np.ndarray]:
        chain = Chain(self.STIFFNESS, self.LINE_MASS, 1.0, 500)
        times = np.linspace(0.2, 0.8, 81)
        return chain, times, *chain.pulled(self.SPEED, times)

    def test_the_front_travels_at_the_wave_speed(self) -> None:
        """Momentum of the chain over the momentum of a metre that moves: the length the wave has reached."""
        chain, times, speeds, _ = self.chain()
        reached = chain.mass * speeds.sum(axis=0) / (self.LINE_MASS * self.SPEED)
        travelled = np.polyfit(times, reached, 1)[0]
        assert wave.wave_speed(self.STIFFNESS, self.LINE_MASS) == pytest.approx(travelled, rel=1e-5)

    def test_the_end_is_held_back_by_the_impedance(self) -> None:
        _, _, _, force = self.chain()
        pull = float(force.mean())  # the front of a chain rings about its mean
        assert wave.impedance(self.STIFFNESS, self.LINE_MASS) * self.SPEED == pytest.approx(pull, rel=1e-4)

    def test_power_at_the_end_fills_the_belt_behind_the_front_with_energy(self) -> None:
        """Z v^2 goes in; per metre rho v^2/2 of motion and EA (v/c)^2/2 of strain stay behind."""
        stiffness, line_mass, v = self.STIFFNESS, self.LINE_MASS, self.SPEED
        c = wave.wave_speed(stiffness, line_mass)
        stored = (line_mass * v**2 / 2 + stiffness * (v / c) ** 2 / 2) * c
        assert wave.impedance(stiffness, line_mass) * v**2 == pytest.approx(stored, rel=1e-13)

    @pytest.mark.parametrize(
        ("modulus", "density", "printed"), [(200e9, 7850.0, 5048.0), (69e9, 2700.0, 5055.0), (3.3e9, 1190.0, 1665.0)]
    )
    def test_thin_rods_of_the_tables(self, modulus: float, density: float, printed: float) -> None:
        """Steel, aluminium, acrylic: bar speed sqrt(E/rho) by hand, four digits; the section cancels."""
        section = 3.7e-4
        assert wave.wave_speed(modulus * section, density * section) == pytest.approx(printed, rel=3e-4)

    def test_a_clamped_rod_rings_at_a_quarter_wave(self) -> None:
        """Lowest frequency of finite elements is c/(4 L)."""
        belt = fem.Belt((300.0, 300.0), (50.0, 50.0), 3e7, 1.0, 0.0, rigid_takeup=False)
        lowest = fem.natural_frequencies(belt, (60, 60), clamped_drum=True, how_many=1)[0]
        assert 2 * math.pi * wave.wave_speed(3e7, 50.0) / (4 * 600.0) == pytest.approx(lowest, rel=1e-4)


class TestReflection:
    @staticmethod
    def junction(z_from: float, z_to: float) -> tuple[float, float]:
        """Reflected and transmitted tension of a unit wave: same tension and same speed on both sides."""
        system = np.array([[1.0, -1.0], [1 / z_from, 1 / z_to]])  # -r + t = 1; (1 - r)/Za = t/Zb
        reflected, transmitted = np.linalg.solve(system, [-1.0, 1 / z_from])
        return float(reflected), float(transmitted)

    @given(positive, positive)
    @steady
    def test_from_equal_tension_and_speed(self, z_from: float, z_to: float) -> None:
        reflected, _ = self.junction(z_from, z_to)
        assert wave.reflection(z_from, z_to) == pytest.approx(reflected, rel=1e-9, abs=1e-9)

    @given(positive, positive)
    @steady
    def test_no_power_is_lost(self, z_from: float, z_to: float) -> None:
        """Power of a tension wave is S^2/Z; what goes on has the tension 1 + r."""
        r = wave.reflection(z_from, z_to)
        assert r**2 / z_from + (1 + r) ** 2 / z_to == pytest.approx(1 / z_from, rel=1e-9)

    @given(positive, positive)
    @steady
    def test_turns_its_sign_with_the_direction(self, z_from: float, z_to: float) -> None:
        assert wave.reflection(z_from, z_to) == -wave.reflection(z_to, z_from)
        assert abs(wave.reflection(z_from, z_to)) <= 1

    def test_ends(self) -> None:
        assert wave.reflection(5.0, 0.0) == -1.0
        assert wave.reflection(5.0, 5.0) == 0.0
        assert wave.reflection(5.0, 1e12) == pytest.approx(1 - 1e-11, rel=1e-14)


class TestFirstWave:
    FORCE, IMPEDANCE, MASS = 9e3, 4.2e4, 2.1e4

    def test_speed_and_force_solve_the_equation_of_the_drum(self) -> None:
        times = np.linspace(0, 3, 61)
        motion = solve_ivp(
            lambda t, v: (self.FORCE - self.IMPEDANCE * v) / self.MASS,
            (0, 3), [0.0], method="DOP853", t_eval=times, rtol=1e-12, atol=1e-14,
        ).y[0]  # fmt: skip
        given_ = self.FORCE, self.IMPEDANCE, self.MASS, times
        assert wave.first_wave_speed(*given_) == pytest.approx(motion, rel=1e-10, abs=1e-12)
        assert wave.first_wave_force(*given_) == pytest.approx(self.IMPEDANCE * motion, rel=1e-10, abs=1e-8)

    @given(positive, positive, positive, st.floats(1e-3, 1e3))
    @steady
    def test_work_of_the_force_is_motion_and_radiated_wave(
        self, force: float, impedance: float, mass: float, time_constants: float
    ) -> None:
        end = min(time_constants, 30.0) * mass / impedance
        spread = {"epsabs": 0.0, "epsrel": 1e-11}
        way = quad(lambda t: wave.first_wave_speed(force, impedance, mass, t), 0, end, **spread)[0]
        sent = quad(lambda t: impedance * wave.first_wave_speed(force, impedance, mass, t) ** 2, 0, end, **spread)[0]
        motion = mass * float(wave.first_wave_speed(force, impedance, mass, end)) ** 2 / 2
        assert force * way == pytest.approx(motion + sent, rel=1e-8)

    def test_a_massless_belt_is_no_resistance(self) -> None:
        times = np.array([0.0, 1.0, 7.0])
        assert wave.first_wave_speed(600.0, 0.0, 30.0, times) == pytest.approx(20.0 * times, rel=1e-15)
        nearly = wave.first_wave_speed(600.0, 1e-9, 30.0, times)
        assert nearly == pytest.approx(20.0 * times, rel=1e-9)
        assert wave.first_wave_force(600.0, 0.0, 30.0, times).tolist() == [0.0, 0.0, 0.0]

    @pytest.mark.parametrize(
        ("lengths", "line_masses"), [((500.0, 500.0), (80.0, 80.0)), ((300.0, 420.0), (80.0, 30.0))]
    )
    def test_is_exact_until_the_first_echo_and_not_after(
        self, lengths: tuple[float, float], line_masses: tuple[float, float]
    ) -> None:
        """Finite elements: with a jump at the tail the first echo comes from there, without one from the take-up."""
        stiffness, mass = 2e7, 6e4
        belt = fem.Belt(lengths, line_masses, stiffness, mass, 0.0, rigid_takeup=False)
        transit = [x * math.sqrt(rho / stiffness) for x, rho in zip(lengths, line_masses, strict=True)]
        echo = 2 * (sum(transit) if line_masses[0] == line_masses[1] else transit[0])
        times = np.linspace(0.05, 1.4, 28) * echo
        run_on = fem.step_response(belt, (110, 110), 1e4, times)["run_on"]
        first = wave.first_wave_force(1e4, math.sqrt(stiffness * line_masses[0]), mass, times)
        error = np.abs(run_on - first) / 1e4
        assert error[times < 0.97 * echo].max() < 0.01
        assert error[times > 1.25 * echo].min() > 0.05

    def test_time_of_the_textbook_is_a_way_round_and_back(self) -> None:
        """Carry strand, return strand to the take-up, and both again on the way back, leg by leg."""
        carry, back = 1.33243, 0.52475
        clock = 0.0
        for leg in (carry, back, back, carry):
            clock += leg
        assert wave.first_wave_time(carry, back) == pytest.approx(clock, rel=1e-15)

    @pytest.mark.parametrize("mass", [5e4, 1.5e5])
    def test_peak_of_the_textbook_is_that_of_a_uniform_loop(self, mass: float) -> None:
        """Within its range, equal impedances and one echo, finite elements have their first peak there."""
        stiffness, line_mass, length = 2e7, 80.0, 400.0
        belt = fem.Belt((length, length), (line_mass, line_mass), stiffness, mass, 0.0, rigid_takeup=False)
        transit = length * math.sqrt(line_mass / stiffness)
        latest = wave.first_wave_time(transit, transit)
        run_on = fem.step_response(belt, (130, 130), 1e4, np.linspace(0, 1.5 * latest, 600))["run_on"]
        peak = wave.first_wave_peak(1e4, math.sqrt(stiffness * line_mass), mass, latest)
        assert peak == pytest.approx(float(run_on.max()), rel=0.01)


# --- two contour times ------------------------------------------------------------------------------------------


def delayed(force: float, contour: float, tau: float) -> Callable[[np.ndarray], np.ndarray]:
    """Run-on tension of a uniform loop by the method of steps, each step by an ODE solver.

    Per impedance: tau v' = F - N - v with N the wave that arrives. It left the drum one contour time ago as N + 2 v
    and came back from the end of constant tension with the opposite sign; before that it is 0. S = N + v.
    """
    settings_ = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-13 * force, "dense_output": True}
    first = solve_ivp(lambda t, v: (force - v) / tau, (0, contour), [0.0], **settings_)

    def echo(t: float | np.ndarray) -> np.ndarray:
        return -2 * first.sol(np.clip(np.asarray(t) - contour, 0, contour))[0]

    second = solve_ivp(lambda t, v: (force - echo(t) - v) / tau, (contour, 2 * contour), [first.y[0, -1]], **settings_)

    def tension(t: np.ndarray) -> np.ndarray:
        early = first.sol(np.minimum(t, contour))[0]
        late = echo(t) + second.sol(np.maximum(t, contour))[0]
        return np.where(t <= contour, early, late)

    return tension


LOOPS = [(6e4, 2.0, 1.0), (1.0, 1.0, 20.0), (3e3, 5.0, 0.4), (250.0, 0.7, 0.7)]
"""Force, contour time, time constant: mass ratios from a heavy drive to a light one."""


class TestTwoIntervals:
    @pytest.mark.parametrize(("force", "contour", "tau"), LOOPS)
    def test_solves_the_delay_equation(self, force: float, contour: float, tau: float) -> None:
        times = np.linspace(0, 2 * contour, 401)
        exact = delayed(force, contour, tau)(times)
        assert wave.two_interval_force(force, contour, tau, times) == pytest.approx(exact, abs=1e-9 * force)

    def test_has_the_first_wave_before_the_echo(self) -> None:
        """Until the first contour time nothing tells a loop from an endless belt."""
        times = np.linspace(0, 2.0, 50)
        motion = solve_ivp(lambda t, v: 50.0 - v, (0, 2), [0.0], t_eval=times, rtol=1e-11, atol=1e-11)
        assert wave.two_interval_force(50.0, 2.0, 1.0, times) == pytest.approx(motion.y[0], abs=1e-8)

    def test_mean_of_a_heavy_drive_is_the_rigid_body(self) -> None:
        """A heavy drive accelerates evenly: the tension rises from 0 to twice rho L a and falls again."""
        tau, contour, force = 1e4, 1.0, 1e5
        rigid = force / (1 + 2 * tau / contour)  # belt mass over the whole: T/(2 tau) of the drive
        times = np.linspace(0, 2 * contour, 2001)
        tension = wave.two_interval_force(force, contour, tau, times)
        assert float(tension.max()) == pytest.approx(2 * rigid, rel=1e-3)
        assert np.trapezoid(tension, times) / (2 * contour) == pytest.approx(rigid, rel=1e-3)

    @pytest.mark.parametrize(("force", "contour", "tau"), LOOPS)
    @pytest.mark.parametrize("window", [0.3, 1.0, 1.2, 2.0])
    def test_peak_is_that_of_a_dense_sample(self, force: float, contour: float, tau: float, window: float) -> None:
        end = window * contour
        times = np.append(np.linspace(0, end, 40001), min(contour, end))
        dense = delayed(force, contour, tau)(times)
        high, high_at = wave.two_interval_peak(force, contour, tau, end)
        assert high == pytest.approx(float(dense.max()), abs=1e-8 * force)
        assert delayed(force, contour, tau)(np.array([high_at])) == pytest.approx([high], abs=1e-9 * force)
        assert 0 <= high_at <= end

    @given(st.floats(1.0, 1e5), st.floats(0.1, 10.0), st.floats(0.05, 50.0), st.floats(0.05, 2.0))
    @steady
    def test_no_sample_lies_above_the_peak_or_below_the_start(
        self, force: float, contour: float, ratio: float, window: float
    ) -> None:
        tau, end = ratio * contour, window * contour
        high, _ = wave.two_interval_peak(force, contour, tau, end)
        tension = wave.two_interval_force(force, contour, tau, np.linspace(0, end, 1001))
        assert np.all(tension <= high + 1e-9 * force)
        assert np.all(tension >= -1e-9 * force)

    def test_later_turn_of_a_light_drive_is_a_smallest_value_inside_the_window(self) -> None:
        """A light drive falls after the echo and rises again: over the second contour time alone the smallest value
        lies inside it, where the derivative of the delay equation's solution has its root."""
        force, contour, tau = 1e3, 5.0, 0.5
        times = np.linspace(contour, 2 * contour, 200001)
        dense = delayed(force, contour, tau)(times)
        turn = float(times[np.argmin(dense)])
        assert contour < turn < 2 * contour
        around = wave.two_interval_force(force, contour, tau, np.array([turn - 0.01, turn, turn + 0.01]))
        assert around[1] < min(around[0], around[2])
        assert around[1] == pytest.approx(float(dense.min()), abs=1e-8 * force)
