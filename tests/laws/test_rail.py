"""Rail steps and gaps: a mass on a spring over a wheel that climbs, integrated."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import eigh

from ptmcalc.laws import rail

GRAVITY = 9.81
NUMBERS = [0.03, 0.3, 0.5, 0.7, 0.95, 1.0, 1.02, 1.1, 1.2, 1.27, 1.4, 1.5, 1.9, 2.0, 2.3, 3.0, 3.4, 4.0, 5.0, 7.7, 12.3]


def integrated(number: float, sign: float, waves: float) -> tuple[float, float]:
    """Largest and smallest relative answer of the mass in the pulse and in two periods after it."""

    def rate(t: float, y: np.ndarray) -> list[float]:
        push = sign * math.cos(t) if t <= waves * math.pi else 0.0
        return [y[1], number**2 * (push - y[0])]

    found = []
    start, y = 0.0, np.zeros(2)
    for end in (waves * math.pi, waves * math.pi + 4 * math.pi / number):
        t = np.linspace(start, end, 40001)
        run = solve_ivp(rate, (start, end), y, t_eval=t, rtol=1e-11, atol=1e-13, method="DOP853")
        found += [np.max(run.y[0]), np.min(run.y[0])]
        # the force may jump at the end: the second piece starts with it gone
        start, y = np.nextafter(end, 99), run.y[:, -1]
    return max(found), -min(found)


class TestPulses:
    @pytest.mark.parametrize("number", NUMBERS)
    def test_step(self, number: float) -> None:
        assert rail.step_extremes(number) == pytest.approx(integrated(number, 1.0, 1.0), rel=1e-6)

    @pytest.mark.parametrize("number", NUMBERS)
    def test_gap(self, number: float) -> None:
        assert rail.gap_extremes(number) == pytest.approx(integrated(number, -1.0, 2.0), rel=1e-6)

    @pytest.mark.parametrize("number", NUMBERS)
    def test_what_is_left_is_as_the_standard_prints_it(self, number: float) -> None:
        if number == 1.0:
            step, gap = math.pi / 2, math.pi
        else:
            share = number**2 / abs(1 - number**2)
            step = share * math.sqrt(2 + 2 * math.cos(math.pi * number))
            gap = 2 * share * abs(math.sin(math.pi * number))
        assert rail.residual_step(number) == pytest.approx(step, rel=1e-9, abs=1e-6)
        assert rail.residual_gap(number) == pytest.approx(gap, rel=1e-9, abs=1e-12)

    def test_no_turn_is_missed_between_the_numbers(self) -> None:
        """A dense sample of the closed answer in the pulse never passes the extremes, which it comes near."""
        for number in np.linspace(0.01, 9, 500):
            for extremes, waves, sign in ((rail.step_extremes, 1, 1.0), (rail.gap_extremes, 2, -1.0)):
                x = np.linspace(0, waves * math.pi, 4001)
                inside = x * np.sin(x) / 2 if number == 1 else (np.cos(x) - np.cos(number * x)) / (1 - number**-2)
                left = rail.residual_step(number) if waves == 1 else rail.residual_gap(number)
                more, less = extremes(float(number))
                assert more == pytest.approx(max(np.max(sign * inside), float(left)), rel=1e-4)
                assert less == pytest.approx(max(np.max(-sign * inside), float(left)), rel=1e-4)

    def test_the_swing_behind_may_vanish_while_the_mass_has_felt_twice_the_push(self) -> None:
        assert rail.residual_step(3.0) == pytest.approx(0.0, abs=1e-15)
        assert rail.step_extremes(3.0)[0] > 1.6
        assert rail.gap_extremes(20.0)[0] == pytest.approx(2.0, rel=0.05)

    def test_the_worst_of_all_speeds(self) -> None:
        """2.75 behind a step, 3.96 behind a gap; the swing in the pulse tends to 2 for a stiff mount."""
        numbers = np.linspace(0.01, 6, 1500)
        assert max(max(rail.step_extremes(float(a))) for a in numbers) == pytest.approx(2.7514, rel=1e-4)
        assert max(max(rail.gap_extremes(float(a))) for a in numbers) == pytest.approx(3.9641, rel=1e-4)
        assert rail.step_extremes(1e5) == pytest.approx((2.0, 2.0), rel=1e-4)
        assert rail.gap_extremes(1e5) == pytest.approx((2.0, 2.0), rel=1e-4)


class TestTwoMasses:
    CASES = [(3e4, 1.2e4, 2e7, 4e5), (2e4, 2e4, 8e6, 8e6), (1e4, 5e4, 3e7, 1e6), (2e4, 1.0, 8e6, 1e9)]

    @pytest.mark.parametrize("given", CASES)
    def test_modes_by_linear_algebra(self, given: tuple[float, float, float, float]) -> None:
        m1, m2, c1, c2 = given
        masses, stiffness = np.array([m1, m2]), np.array([[c1 + c2, -c2], [-c2, c2]])
        squares, vectors = eigh(stiffness, np.diag(masses))
        effective = (vectors.T @ masses) ** 2
        w1, w2, p1, p2 = rail.wheel_modes(*given)
        assert (w1, w2) == pytest.approx(np.sqrt(squares), rel=1e-9)
        assert (p1, p2) == pytest.approx(effective / (m1 + m2), rel=1e-6, abs=1e-9)
        assert p1 + p2 == pytest.approx(1.0, rel=1e-14)

    @pytest.mark.parametrize("given", CASES[:3])
    @pytest.mark.parametrize("climb", [0.01, 0.05, 0.2])
    def test_no_load_at_the_wheels_is_beyond_the_sum_of_both(
        self, given: tuple[float, float, float, float], climb: float
    ) -> None:
        """Both masses integrated over a step climbed in that time."""
        m1, m2, c1, c2 = given
        turn = math.pi / climb  # per second
        w1, w2, p1, p2 = rail.wheel_modes(*given)

        def rate(t: float, y: np.ndarray) -> list[float]:
            push = math.cos(turn * t) if t <= climb else 0.0  # acceleration of the wheel; paths seen from the wheel
            link = c2 * (y[0] - y[1])
            return [y[2], y[3], (-c1 * y[0] - link) / m1 - push, link / m2 - push]

        state, pulls = np.zeros(4), []
        for start, end in ((0.0, climb), (np.nextafter(climb, 9), climb + 40 * math.pi / w1)):
            t = np.linspace(start, end, 20001)
            run = solve_ivp(rate, (start, end), state, t_eval=t, rtol=1e-9, atol=1e-14, max_step=climb)
            state = run.y[:, -1]
            pulls.append(-c1 * run.y[0] / (m1 + m2))
        seen = np.concatenate(pulls)
        extremes = [rail.step_extremes(w * climb / math.pi) for w in (w1, w2)]
        more, less = (p1 * extremes[0][k] + p2 * extremes[1][k] for k in (0, 1))
        assert np.max(seen) <= more * (1 + 1e-6)
        assert -np.min(seen) <= less * (1 + 1e-6)
        assert np.max(seen) > 0.75 * more  # and near to it


class TestNumbers:
    def test_the_path_of_the_wheel(self) -> None:
        """Half a cosine over the climb (2 h r)^(1/2), a whole one of depth e^2/(8 r) over the gap: one acceleration."""
        v, r, h, e = 1.4, 0.315, 0.002, 0.03
        climb = math.sqrt(2 * h * r)
        t = np.linspace(0, 1, 3) * 1e-6  # the acceleration at the start, by differences
        step = h / 2 * (1 - np.cos(math.pi * v * t / climb))
        gap = e**2 / (16 * r) * (1 - np.cos(2 * math.pi * v * t / e))
        for path in (step, gap):
            assert np.diff(path, 2)[0] / t[1] ** 2 == pytest.approx(rail.rail_acceleration(v, r), rel=1e-3)
        f = 4.2
        assert rail.step_number(2 * math.pi * f, v, r, h) == pytest.approx(2 * f * climb / v, rel=1e-12)
        assert rail.gap_number(2 * math.pi * f, v, e) == pytest.approx(f * e / v, rel=1e-12)

    def test_factor(self) -> None:
        more, less = rail.step_extremes(1.6)
        a = rail.rail_acceleration(1.0, 0.4)
        assert rail.rail_factor(1.0, 0.4, GRAVITY, more) == pytest.approx(1 + more * a / GRAVITY)
        assert rail.rail_factor(2.5, 0.2, GRAVITY, -less) < 0  # the wheel leaves the rail

    def test_waviness(self) -> None:
        v, wave, height = 1.7, 0.6, 0.004
        t = np.linspace(0, wave / v, 20001)
        bend = np.gradient(np.gradient(height / 2 * np.sin(2 * math.pi * v * t / wave), t), t)
        assert rail.waviness_acceleration(v, wave, height) == pytest.approx(np.max(np.abs(bend[5:-5])), rel=1e-6)


def test_tilt_and_resonance() -> None:
    assert rail.tilt_way(0.002, 8.0, 3.2) == pytest.approx(8.0 * math.sin(0.002 / 3.2), rel=1e-6)
    speed = rail.resonance_speed(7.0, 1.2)
    assert 2 * math.pi * speed / 1.2 == pytest.approx(7.0, rel=1e-14)
