"""Oscillator under a pulse that ends: against the matrix exponential, quadrature, and dense samples of both.

Reference: z' = A z, z = (x, v, two force states), by scipy's expm during the pulse and of the oscillator alone after
it.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.linalg import expm
from scipy.optimize import brentq, minimize_scalar

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.decay_pulse import DecayPulse, Summit, _spread

PAPER = DecayPulse(5.47, 0.0, 3.0, 96.0, 1.0, 5.0)
SHORT = DecayPulse(5.47, 0.0, 3.0, 96.0, 1.0, 0.2)


def reference(pulse: DecayPulse, time: float) -> np.ndarray:
    w, zeta, slow, fast = pulse.natural_frequency, pulse.damping_ratio, pulse.slow, pulse.fast
    system = np.zeros((4, 4))
    system[0, 1], system[1] = 1.0, (-w * w, -2 * zeta * w, pulse.acceleration, 0.0)
    system[2, 2], system[2, 3], system[3, 3] = -slow, fast - slow, -fast
    state = expm(system * min(time, pulse.duration)) @ [0.0, 0.0, 0.0, 1.0]
    return np.asarray(expm(system[:2, :2] * max(0.0, time - pulse.duration)) @ state[:2])


class TestMotion:
    @pytest.mark.parametrize("zeta", [0.0, 0.02, 0.7, 1 - 1e-9, 1.0, 1 + 1e-9, 3.0])
    @pytest.mark.parametrize(("slow", "fast"), [(3.0, 96.0), (3.0, 3.0 + 1e-7), (5.0, 5.0), (0.0, 2.0), (96.0, 3.0)])
    @pytest.mark.parametrize("natural", [0.0, 1e-6, 5.0, 60.0])
    def test_is_that_of_the_matrix_exponential(self, natural: float, zeta: float, slow: float, fast: float) -> None:
        pulse = DecayPulse(natural, zeta, slow, fast, 2.0, 1.1)
        times = np.array([0.0, 1e-4, 0.03, 0.4, 1.1, 1.3, 2.9])
        x, v = pulse.at(times)
        expected = np.array([reference(pulse, t) for t in times])
        for found, column in ((x, expected[:, 0]), (v, expected[:, 1])):
            assert np.abs(found - column).max() <= 1e-12 * np.abs(column).max() + 1e-300

    @pytest.mark.parametrize("zeta", [0.0, 0.04, 1.3, 3.0])
    @pytest.mark.parametrize(("slow", "fast"), [(3.0, 96.0), (96.0, 3.0), (0.0, 20.0)])
    @pytest.mark.parametrize("end", [3.0, 6.0])
    def test_many_times_are_as_few(self, zeta: float, slow: float, fast: float, end: float) -> None:
        """Partial fractions, from where they lose nothing on, beside the divided differences of the motion to come."""
        pulse = DecayPulse(5.0, zeta, slow, fast, 2.0, end)
        times = np.linspace(0.0, 6.0, 1001)
        few = np.concatenate([pulse.at(times[k : k + 100]) for k in range(0, 1001, 100)], axis=1)
        to_come = np.maximum.accumulate(np.abs(few)[:, ::-1], axis=1)[:, ::-1]
        assert np.all(np.abs(np.array(pulse.at(times)) - few) <= 3e-13 * to_come)

    @pytest.mark.parametrize("unit", [2.0**-330, 2.0**-20, 2.0**20, 2.0**330])
    def test_the_unit_of_time_changes_no_digit_of_many(self, unit: float) -> None:
        times = np.linspace(0.0, 6.0, 1001)
        x, v = DecayPulse(5.0, 0.04, 3.0, 96.0, 2.0, 5.0).at(times)
        y, u = DecayPulse(5.0 / unit, 0.04, 3.0 / unit, 96.0 / unit, 2.0 / unit / unit, 5.0 * unit).at(times * unit)
        assert np.array_equal(x, y)
        assert np.array_equal(v, u * unit)

    def test_times_in_any_order_and_shape(self) -> None:
        times = np.random.default_rng(1).uniform(0, 8, (7, 11))
        x, v = PAPER.at(times)
        again = [PAPER.at(t) for t in times.ravel()]
        assert x.ravel() == pytest.approx([float(one[0]) for one in again], rel=1e-12, abs=1e-16)
        assert v.ravel() == pytest.approx([float(one[1]) for one in again], rel=1e-12, abs=1e-15)

    def test_falling_times_give_the_reverse_of_rising_ones(self) -> None:
        """Through the end of the pulse, one of them the end itself."""
        times = np.linspace(0.0, 2 * SHORT.duration, 9)
        assert times[4] == SHORT.duration
        for found, rising in zip(SHORT.at(times[::-1]), SHORT.at(times), strict=True):
            assert np.array_equal(found[::-1], rising)

    def test_joins_its_free_branch_with_its_speed(self) -> None:
        """The printed branch has the wrong sign before the end of the pulse: a jump of 2 exp(-3 tau)/k^2 or so."""
        for pulse in (PAPER, SHORT):
            (before, after), (v_before, v_after) = pulse.at(
                [pulse.duration, np.nextafter(pulse.duration, 10 * pulse.duration)]
            )
            assert after == pytest.approx(before, rel=1e-14)
            assert v_after == pytest.approx(v_before, rel=1e-13)

    def test_the_free_branch_is_the_printed_sum_with_its_sign_put_right(self) -> None:
        k, tau = SHORT.natural_frequency, SHORT.duration
        for t in (0.21, 0.6, 3.0):
            total = 0.0
            for a, sign in ((3.0, 1), (96.0, -1)):
                swing = a * math.sin(k * t) - k * math.cos(k * t)
                late = a * math.sin(k * (t - tau)) - k * math.cos(k * (t - tau))
                total += sign * (swing - math.exp(-a * tau) * late) / (a * a + k * k)
            assert float(SHORT.at(t)[0]) == pytest.approx(total / k, rel=1e-12)

    def test_the_force_is_its_difference(self) -> None:
        t = np.linspace(0, 5, 41)
        assert PAPER.force(t) == pytest.approx(np.exp(-3 * t) - np.exp(-96 * t), abs=1e-15)
        assert PAPER.force([5.1, -1.0]).tolist() == [0.0, 0.0]
        swapped = replace(PAPER, slow=96.0, fast=3.0)
        assert np.array_equal(swapped.force(t), -PAPER.force(t))
        assert swapped.largest().value == pytest.approx(-PAPER.largest().value, rel=1e-12)

    def test_impulse_of_a_rigid_mass(self) -> None:
        impulse = quad(lambda t: math.exp(-3 * t) - math.exp(-96 * t), 0, 5, points=[0.05, 0.2, 1], epsabs=1e-15)[0]
        assert float(DecayPulse(0.0, 0.0, 3.0, 96.0, 1.0, 5.0).at(7.0)[1]) == pytest.approx(impulse, rel=1e-12)


class TestLargest:
    @pytest.mark.parametrize("seed", range(25))
    def test_is_the_summit_of_dense_samples(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        natural, slow = 10 ** rng.uniform(-1, 2.5), 10 ** rng.uniform(-1, 1.5)
        fast = slow * 10 ** rng.uniform(0, 3)
        zeta = float(rng.choice([0.0, 0.01, 0.3, 1.0, 4.0]))
        duration, sign = 10 ** rng.uniform(-2, 1), float(rng.choice([-1.0, 1.0]))
        pulse = DecayPulse(natural, zeta, slow, fast, sign, duration)
        summit = pulse.largest()
        reach = duration + 2 * math.pi / natural * max(1.0, 4 * zeta)
        times = np.union1d(np.linspace(0, reach, 20_001), np.geomspace(1e-6, 1, 2001) * reach)
        x = pulse.at(times)[0]
        top = int(np.argmax(np.abs(x)))
        ends = times[max(0, top - 1)], times[min(len(times) - 1, top + 1)]
        near = minimize_scalar(
            lambda t: -abs(float(pulse.at(t)[0])), bounds=ends, method="bounded", options={"xatol": 1e-12}
        )
        expected = max(abs(x[top]), -near.fun)
        assert abs(summit.value) >= expected * (1 - 1e-12)
        assert abs(summit.value) - expected <= 1e-9 * expected + summit.error
        assert summit.error <= 1e-9 * expected
        assert float(pulse.at(summit.time)[0]) == pytest.approx(summit.value, rel=1e-9)

    @pytest.mark.parametrize("seed", range(10))
    @pytest.mark.parametrize("unit", [2.0**-30, 2.0**30])
    def test_no_unit_of_time_changes_the_summit(self, seed: int, unit: float) -> None:
        rng = np.random.default_rng(seed)
        natural, slow, zeta = rng.uniform(1, 100), rng.uniform(0.1, 10), float(rng.choice([0.0, 0.3, 3.0]))
        fast, duration = slow * rng.uniform(1.1, 30), rng.uniform(0.05, 2)
        one = DecayPulse(natural, zeta, slow, fast, 1.0, duration).largest()
        other = DecayPulse(natural / unit, zeta, slow / unit, fast / unit, 1 / unit**2, duration * unit).largest()
        assert other.value == pytest.approx(one.value, rel=1e-12)
        assert other.time / unit == pytest.approx(one.time, rel=1e-6)

    def test_a_stiff_spring_follows_the_force(self) -> None:
        """Ripples of the jump in the slope stand on the quasi-static deflection: (l_2 - l_1)/k^3 of each sign."""
        k = 2e4
        summit = DecayPulse(k, 0.0, 3.0, 96.0, 1.0, 5.0).largest()
        top = (1 - 3 / 96) * (3 / 96) ** (3 / 93)
        assert summit.value * k * k == pytest.approx(top + 93 / k, rel=1e-5)
        assert summit.value * k * k > top + 92 / k
        assert summit.error <= 1e-6 * summit.value

    @pytest.mark.parametrize("natural", [0.05, 0.3])
    def test_a_soft_spring_turns_the_impulse(self, natural: float) -> None:
        """Long after the pulse: v/k of its impulse, but for a phase."""
        summit = DecayPulse(natural, 0.0, 3.0, 96.0, 1.0, 5.0).largest()
        transform = abs(1 / (3 + 1j * natural) - 1 / (96 + 1j * natural))
        assert abs(summit.value) == pytest.approx(transform / natural, rel=1e-6)
        assert summit.time > 5.0

    @pytest.mark.parametrize("natural", [0.7, 9.3, 170.0])
    def test_of_equal_ones_the_first_counts(self, natural: float) -> None:
        """A force that comes and stays, no damping: x = a/w^2 - (what comes back every period), f = a (1 - exp(-l t)).

        x = a (1/w^2 - exp(-l t)/(w^2 + l^2) - r cos(w t - p)/w),   r = l/(w^2 + l^2)^(1/2)/w,   tan p = w/l
        """
        rate = 40 * natural
        pulse = DecayPulse(natural, 0.0, 0.0, rate, 2.0, 800.0 / natural)
        summit = pulse.largest()
        whole = natural**2 + rate**2
        top = 2.0 * (1 / natural**2 + rate / math.sqrt(whole) / natural**2)
        assert summit.value == pytest.approx(top, rel=1e-13)
        assert natural * summit.time == pytest.approx(math.pi + math.atan(natural / rate), rel=1e-9)
        assert summit.error <= 1e-10 * top
        assert DecayPulse(natural, 0.0, 0.0, rate, -2.0, 800.0 / natural).largest() == replace(
            summit, value=-summit.value
        )

    @pytest.mark.parametrize("rate", [0.02, 0.0268, 0.08])
    @pytest.mark.parametrize("end", [2000.0, 400.0])
    def test_a_summit_many_waves_after_the_jump_is_found(self, rate: float, end: float) -> None:
        """A force that comes and stays, f = 1 - exp(-l t): what follows it still rises by l exp(-l t) where its waves
        fade by z l exp(-z w t), so the highest wave is the one beside w t = ln(1/z)/(l/w - z), here the 58th,
        the 43rd or the 14th."""
        zeta = 1e-3
        pulse = DecayPulse(1.0, zeta, 0.0, rate, 1.0, end)
        summit = pulse.largest()
        late = math.log(1 / zeta) / (rate - zeta)
        assert summit.time == pytest.approx(late, abs=2 * math.pi)
        settles = 1 / (1 - 2 * zeta * rate + rate * rate)  # of exp(-l t)
        slow, damped = zeta, math.sqrt(1 - zeta * zeta)
        # x = 1 - c exp(-l t) + exp(-z t) (p cos(d t) + q sin(d t)), from rest
        p = settles - 1
        q = (slow * p - rate * settles) / damped
        times = np.linspace(late - 7, late + 7, 200_001)
        waves = np.exp(-slow * times) * (p * np.cos(damped * times) + q * np.sin(damped * times))
        expected = float((1 - settles * np.exp(-rate * times) + waves).max())
        assert summit.value == pytest.approx(expected, rel=1e-9)
        for natural in (1e-3, 1e5):  # the same in other units of time
            other = DecayPulse(natural, zeta, 0.0, rate * natural, natural**2, end / natural).largest()
            assert other.value == pytest.approx(summit.value, rel=1e-9)

    @pytest.mark.parametrize("zeta", [1.3, 4.0])
    @pytest.mark.parametrize("natural", [1e-4, 1.0, 1e3])
    def test_an_overdamped_soft_spring_turns_the_impulse(self, natural: float, zeta: float) -> None:
        """Long after a short pulse: x = A exp(-r t) - B exp(-s t), whose crest is where A r exp(-r t) = B s exp(-s t).

        A (s - r) = int f exp(r t) dt over the pulse, and B with s.
        """
        slow, fast, end = 300 * natural, 9000 * natural, 0.02 / natural
        summit = DecayPulse(natural, zeta, slow, fast, 2.0, end).largest()
        root = math.sqrt(zeta * zeta - 1)
        r, s = natural / (zeta + root), natural * (zeta + root)

        def pulled(rate: float) -> float:
            return 2.0 * sum(
                sign * math.expm1((rate - decay) * end) / (rate - decay) for sign, decay in ((1, slow), (-1, fast))
            )

        a, b = pulled(r) / (s - r), pulled(s) / (s - r)
        time = math.log(b * s / (a * r)) / (s - r)
        assert summit.time == pytest.approx(time, rel=1e-6)
        assert summit.value == pytest.approx(a * math.exp(-r * time) - b * math.exp(-s * time), rel=1e-10)

    def test_a_summit_takes_few_looks(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """Newton's method from the middle of a sixteenth of a period doubles its digits; 28 times the time in which an
        overdamped mass comes back are one look."""
        looks: list[int] = []
        whole = DecayPulse.at
        monkeypatch.setattr(DecayPulse, "at", lambda self, time: (looks.append(1), whole(self, time))[1])
        for natural, zeta, slow, end, most in (
            (5.47, 0.0, 3.0, 5.0, 8), (60.0, 0.05, 3.0, 5.0, 8), (20.0, 0.7, 3.0, 5.0, 8), (20.0, 3.0, 3.0, 5.0, 8),
            (2.0, 3.0, 0.0, 81.6, 20), (20.0, 3.0, 0.0, 8.16, 20),
        ):  # fmt: skip
            looks.clear()
            DecayPulse(natural, zeta, slow, 96.0, 1.0, end).largest()
            assert len(looks) <= most

    def test_the_summit_beside_a_late_crest_of_the_force_has_its_ripple(self) -> None:
        """x = f/w^2 - f'(0) sin(w t)/w^3 of a slow force without damping: a ten-thousandth here, 15 000 periods on."""
        w, slow, fast = 1.0, 1e-5, 1.1e-5
        crest = math.log(1.1) / (fast - slow)
        force, slope = math.exp(-slow * crest) - math.exp(-fast * crest), fast - slow
        for sign in (1.0, -1.0):
            summit = DecayPulse(w, 0.0, slow, fast, sign, 1e5).largest()
            assert sign * summit.value == pytest.approx(force + slope, rel=1e-9)
            assert summit.time == pytest.approx(crest, abs=4.0)

    @pytest.mark.parametrize("sign", [1.0, -1.0])
    @pytest.mark.parametrize("zeta", [0.0, 0.2, 0.7])
    @pytest.mark.parametrize("w", [0.5, 1.0, 30.0])
    def test_where_the_search_stops_the_bound_at_any_time_is_told(self, w: float, zeta: float, sign: float) -> None:
        """w^2 |x| <= max f + 4 (1 + 4 z) |f'(0)|/w, 15 000 periods on, less what was found."""
        slow, fast = 1e-5 * w, 1.1e-5 * w
        crest = math.log(1.1) / (fast - slow)
        most = math.exp(-slow * crest) - math.exp(-fast * crest)
        bound = (most + 4 * (1 + 4 * zeta) * (fast - slow) / w) / w**2
        for one in (DecayPulse(w, zeta, slow, fast, sign, 1e5 / w), DecayPulse(w, zeta, fast, slow, -sign, 1e5 / w)):
            summit = one.largest()
            assert summit.error == pytest.approx(bound - sign * summit.value, rel=1e-4)

    @pytest.mark.parametrize("zeta", [30.0, 1e4])
    @pytest.mark.parametrize(("slow", "fast"), [(3.0, 96.0), (500.0, 4e3)])
    @pytest.mark.parametrize("duration", [300.0, 1e6])
    def test_a_summit_long_before_an_overdamped_mass_has_come_back(
        self, zeta: float, duration: float, slow: float, fast: float
    ) -> None:
        """By a matrix exponential, from looks over five decades."""
        pulse = DecayPulse(1.0, zeta, slow, fast, 1.0, duration)
        summit = pulse.largest()
        times = np.geomspace(3e-3, 300.0, 41)
        at = [float(reference(pulse, t)[0]) for t in times]
        top = int(np.argmax(at))
        time = brentq(lambda t: float(reference(pulse, t)[1]), times[top - 1], times[top + 1], rtol=1e-14)
        assert summit.value == pytest.approx(float(reference(pulse, time)[0]), rel=1e-11)
        assert summit.time == pytest.approx(time, abs=2e-9 * zeta), "a billionth of the time of the way back, 2 z"

    @pytest.mark.parametrize("zeta", [0.1, 4.0])
    def test_a_mass_that_turns_just_after_the_pulse_is_seen(self, zeta: float) -> None:
        """A thousandth of a second before it would have turned by itself the force is gone."""
        pulse = DecayPulse(0.1, zeta, 0.3, 9.0, 1.0, 500.0)
        turns = pulse.largest().time
        short = replace(pulse, duration=turns - 1e-3)
        time = brentq(lambda t: float(reference(short, t)[1]), short.duration, turns, xtol=1e-12)
        summit = short.largest()
        assert summit.time == pytest.approx(time, abs=1e-6)
        assert summit.value == pytest.approx(float(reference(short, time)[0]), rel=1e-12)
        assert short.duration < summit.time < turns

    def test_places_over_decades_are_eight_in_each_or_more(self) -> None:
        for first, last in ((1e-30, 1e10), (1e-12, 1e30), (1.0, 10.0)):
            steps = np.diff(np.log10(_spread(first, last)))
            assert 0 < steps.min() <= steps.max() <= 1 / 8 * (1 + 1e-2)
            assert _spread(first, last)[[0, -1]] == pytest.approx([first, last], rel=1e-14)

    def test_rounding_of_a_late_summit_grows_with_its_phase(self) -> None:
        """A million radians of a stiff spring: each may be off by a last digit."""
        summit = DecayPulse(1000.0, 0.02, 0.001, 0.0011, 1.0, 2000.0).largest()
        phase = 1000.0 * summit.time
        assert phase > 9e5
        assert summit.error >= 1e-12 * summit.value
        late = DecayPulse(1000.0, 0.02, 1e-6, 1.1e-6, 1.0, 2e6).largest()
        assert late.error >= np.finfo(float).eps * 1000.0 * late.time * late.value > 1e-11 * late.value
        assert late.error <= 1e-5 * late.value

    @pytest.mark.parametrize(("natural", "zeta"), [(5.0, 0.0), (60.0, 0.1), (20.0, 0.3)])
    def test_what_is_behind_a_time_is_bounded(self, natural: float, zeta: float) -> None:
        """From the inflection of the force on, after twice the time of its crest."""
        pulse = DecayPulse(natural, zeta, 3.0, 96.0, 2.0, 5.0)
        inflection = 2 * math.log(96 / 3) / 93
        assert pulse._most_behind(inflection * 0.999) == math.inf
        for time in (inflection * 1.001, 0.2, 0.45):
            for sign in (1.0, -1.0):
                bound = replace(pulse, acceleration=2.0 * sign)._most_behind(time)
                behind = float(np.abs(pulse.at(time + np.linspace(0, 4, 20_001))[0]).max())
                assert behind <= bound
        for time in (inflection * 1.001, 0.2, 0.45):  # f + what swings about f/w^2, its speed, and 2 zeta f
            x, v = (float(one) for one in pulse.at(time))
            f, slope = (
                2 * (math.exp(-3 * time) - math.exp(-96 * time)),
                2 * (96 * math.exp(-96 * time) - 3 * math.exp(-3 * time)),
            )
            energy = math.hypot(natural**2 * x - f, (natural**2 * v - slope) / natural)
            expected = (f * (1 + 2 * zeta) + energy + abs(slope) / natural) / natural**2
            assert pulse._most_behind(time) == pytest.approx(expected, rel=1e-12)

    @pytest.mark.parametrize("natural", [0.3, 40.0])
    @pytest.mark.parametrize("zeta", [0.0, 0.2, 0.7, 0.998, 0.9999, 1.0, 1.3, 5.0])
    def test_a_stretch_is_a_wave_or_the_time_of_a_way_back(self, natural: float, zeta: float) -> None:
        """By the eigenvalues of the free motion; a wave nearly critically damped counts as twenty undamped ones."""
        roots = np.linalg.eigvals([[0.0, 1.0], [-natural * natural, -2 * zeta * natural]])
        damped = float(np.abs(roots.imag).max())
        wave = 2 * math.pi / max(damped, natural / 20)
        expected = wave if zeta < 1 else -1 / float(roots.real.max())
        assert replace(PAPER, natural_frequency=natural, damping_ratio=zeta)._stretch == pytest.approx(
            expected, rel=1e-6
        )

    def test_of_nothing_is_nothing(self) -> None:
        """Of no force, of one that takes itself back, of no time; a second is some."""
        for nothing in (replace(PAPER, acceleration=0.0), replace(PAPER, fast=3.0), replace(PAPER, duration=0.0)):
            assert nothing.largest() == Summit(0.0, 0.0, 0.0)
        assert replace(PAPER, duration=1.0).largest().value == pytest.approx(PAPER.largest().value, rel=1e-12)

    def test_says_where_it_cannot_be_trusted(self) -> None:
        with pytest.raises(NumericsError, match="no largest deflection"):
            DecayPulse(0.0, 0.0, 3.0, 96.0, 1.0, 5.0).largest()
        with pytest.raises(NumericsError, match="lost its fraction"):
            DecayPulse(2.002e14, 0.0, 3.0, 96.0, 1.0, 5.0).largest()
        assert DecayPulse(1.998e14, 0.0, 3.0, 96.0, 1.0, 5.0).largest().value > 0

    def test_of_the_paper_against_a_general_solver(self) -> None:
        def turn(_: float, y: np.ndarray) -> float:
            return float(y[1])

        run = solve_ivp(
            lambda t, y: [y[1], math.exp(-3 * t) - math.exp(-96 * t) - 5.47**2 * y[0]],
            (0, 1), [0.0, 0.0], "DOP853", rtol=1e-12, atol=1e-16, events=turn,
        )  # fmt: skip
        summit = PAPER.largest()
        assert summit.value == pytest.approx(max(y[0] for y in run.y_events[0]), rel=1e-10)
