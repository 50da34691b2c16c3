"""Numerically hard cases of one and two masses: the right digits where the textbook form has none.

Expected values were computed with 80 digits or by exact algebra; each case says what its naive form does. Below them
the same laws are held to decimal and rational arithmetic of the standard library next to their removable singularities.
"""

import math
from collections.abc import Callable
from decimal import Decimal, localcontext
from fractions import Fraction

import numpy as np
import pytest
from scipy.optimize import brentq

from ptmcalc.laws import brake, buffer, coulomb, gearing, response, shock, two_mass, vibration

NEAR = [1e-16, 1e-12, 1e-9, 1e-6, 1e-3, 0.1]


def precise(compute: Callable[[], Decimal]) -> float:
    """A number computed with 60 digits and rounded once."""
    with localcontext() as context:
        context.prec = 60
        context.Emin, context.Emax = -9999, 9999
        return float(compute())


def rational(value: Fraction) -> Decimal:
    return Decimal(value.numerator) / Decimal(value.denominator)


def sine(angle: Decimal) -> Decimal:
    """Taylor series, for angles up to 10."""
    term = total = angle
    for k in range(1, 60):
        term *= -angle * angle / ((2 * k) * (2 * k + 1))
        total += term
    return total


def cosine(angle: Decimal) -> Decimal:
    return 1 - 2 * sine(angle / 2) ** 2


class TestHardCases:
    @pytest.mark.parametrize(
        ("frequency", "expected"), [(24.000000024000002, -2.0510151335827818), (24.0, -2.0510146949404664)]
    )
    def test_resonance(self, frequency: float, expected: float) -> None:
        """(sin wt - w/k sin kt)/(k^2 - w^2): seven digits gone beside resonance, 0/0 in it."""
        assert float(response.sine_response(24.0, frequency, 1.0, 100.0)) == pytest.approx(expected, rel=1e-11, abs=0)

    @pytest.mark.parametrize(
        ("natural", "time", "expected", "digits"),
        [(0.0, 5.0, 1.5035807631558133, 1e-13), (5.47, 1e-7, 1.5499961637573492e-20, 1e-12)],
        ids=["duhamel-k-to-0", "duhamel-small-time"],
    )
    def test_pulse(self, natural: float, time: float, expected: float, digits: float) -> None:
        """sin(kt)/k is 0/0 without a spring; terms of order 1 cancel to 1e-20 in the first sample."""
        found = response.pulse_response(natural, 0.0, 3.0, 96.0, 1.0, time)
        assert float(found) == pytest.approx(expected, rel=digits, abs=0)

    def test_duhamel_triple_coincidence(self) -> None:
        """Partial fractions divide by 0, eigenvectors of the critical system do not exist."""
        assert float(response.decay_response(3.0, 1.0, 3.0, 1.0, 0.7)) == pytest.approx(
            0.030001824921980568, rel=1e-13, abs=0
        )

    def test_denormal_tail(self) -> None:
        tail = response.decay_envelope(1.0, 1.0, 1.0, np.array([744.4, 746.0]))
        assert tail == pytest.approx([5e-324, 0.0], rel=0, abs=5e-324)

    def test_energy_drift(self) -> None:
        """Ten thousand radians: a fixed step gains or loses energy with each, the closed form has no step."""
        x = float(response.free_response(1.0, 0.0, 1.0, 0.0, 1e4))
        v = float(response.free_speed(1.0, 0.0, 1.0, 0.0, 1e4))
        assert (x**2 + v**2) / 2 == pytest.approx(0.5, rel=1e-10)

    def test_coulomb_stop_time(self) -> None:
        """Sign(v) chatters about rest, tanh(v) never stops."""
        assert float(coulomb.coulomb_slide(100.0, 50.0, 0.0, 1.0, 5.0)) == pytest.approx(1.0, rel=1e-12)

    def test_coulomb_hold(self) -> None:
        """Smoothed friction creeps half a kilometre in a day."""
        assert float(coulomb.coulomb_slide(100.0, 50.0, 49.999, 0.0, 1e5)) == 0.0

    def test_mass_ratio(self) -> None:
        """The eigenvalues of M^-1 K carry the rigid motion's rounding into the frequency."""
        assert two_mass.two_mass_frequency(1e6, 1e12, 1.0) == pytest.approx(1000.0000000005, rel=1e-14, abs=0)

    def test_double_zero_free_flight(self) -> None:
        """Neither spring nor damper: a defective matrix, and a plain polynomial."""
        thrown = response.free_response(0.0, 0.0, 0.0, 0.25, 1e-4)
        falling = response.decay_response(0.0, 0.0, 0.0, -9.81, 1e-4)
        assert float(thrown + falling) == pytest.approx(2.4950950000000002e-05, rel=1e-15, abs=0)

    def test_damped_contact_release(self) -> None:
        """Exactly critical: the overlap never returns to 0, the force of spring and damper does."""
        natural = vibration.natural_frequency(1e6, 100.0)
        zeta = vibration.damping_ratio(2e4, 1e6, 100.0)

        def force(t: float) -> float:
            x, v = (float(law(natural, zeta, 0.0, 1.0, t)) for law in (response.free_response, response.free_speed))
            return 1e6 * x + 2e4 * v

        assert brentq(force, 0.01, 0.03, xtol=1e-16, rtol=1e-14) == pytest.approx(0.02, rel=1e-12)


class TestResponsesKeepTheirDigits:
    @pytest.mark.parametrize("beside", [0.0, *NEAR, *(-x for x in NEAR)])
    @pytest.mark.parametrize("turn", [1e-9, 1e-3, 0.3, 0.999, 1.001, 3.0])
    def test_sine_about_resonance(self, beside: float, turn: float) -> None:
        natural, frequency = 2.0, 2.0 * (1 + beside)
        time = turn / natural

        def exactly() -> Decimal:
            k, w, t = map(Decimal, (natural, frequency, time))
            if k == w:
                return (sine(k * t) - k * t * cosine(k * t)) / (2 * k * k)
            return (sine(w * t) - w / k * sine(k * t)) / (k * k - w * w)

        found = float(response.sine_response(natural, frequency, 1.0, time))
        assert found == pytest.approx(precise(exactly), rel=1e-13, abs=0)

    @pytest.mark.parametrize("beside", [*NEAR[2:], 1.0, 1e3, 1e9])
    @pytest.mark.parametrize("time", [1e-9, 1e-3, 0.4, 3.0])
    def test_overdamped_free_response(self, beside: float, time: float) -> None:
        """From just above critical damping, where the roots coincide, to where one of them has left the machine."""
        natural, zeta = 2.0, 1 + beside

        def exactly() -> Decimal:
            w, z, t = map(Decimal, (natural, zeta, time))
            root = (z * z - 1).sqrt()
            slow, fast = w * (z - root), w * (z + root)
            return ((3 + fast) * (-slow * t).exp() - (3 + slow) * (-fast * t).exp()) / (fast - slow)

        found = float(response.free_response(natural, zeta, 1.0, 3.0, time))
        assert found == pytest.approx(precise(exactly), rel=1e-12, abs=0)

    @pytest.mark.parametrize("beside", [0.0, *NEAR, 5.0])
    @pytest.mark.parametrize("time", [1e-9, 1e-3, 0.4, 9.0, 1e3])
    def test_pulse_of_nearly_equal_decays_without_a_spring(self, beside: float, time: float) -> None:
        slow, fast = 1.0, 1.0 + beside

        def exactly() -> Decimal:
            l1, l2, t = map(Decimal, (slow, fast, time))

            def twice(decay: Decimal) -> Decimal:
                return ((-decay * t).exp() - 1 + decay * t) / decay**2

            return twice(l1) - twice(l2)

        found = float(response.pulse_response(0.0, 0.0, slow, fast, 1.0, time))
        assert found == pytest.approx(precise(exactly), rel=1e-12, abs=0)


class TestFactorsKeepTheirDigits:
    @pytest.mark.parametrize("beside", [0.0, *NEAR])
    def test_half_sine_about_half_a_period(self, beside: float) -> None:
        """4 x cos(pi x)/(1 - 4 x^2) from below, 0/0 at 1/2, another formula from above: pi/2 with slope pi/2."""
        near = np.array([0.5 - beside, 0.5 + beside])
        tolerance = 1e-15 + 4 * beside**2
        expected = math.pi / 2 * (1 + (near - 0.5))
        assert shock.half_sine_pulse_factor(near) == pytest.approx(expected, rel=tolerance)

    @pytest.mark.parametrize("beside", NEAR)
    def test_amplification_beside_resonance(self, beside: float) -> None:
        for r in (1 + beside, 1 - beside):
            if r != 1:
                exact = abs(1 / (1 - Fraction(r) ** 2))
                assert float(vibration.amplification(r, 0.0)) == pytest.approx(float(exact), rel=1e-14)

    @pytest.mark.parametrize("beside", NEAR)
    def test_decrement_next_to_critical_damping(self, beside: float) -> None:
        zeta = 1 - beside
        if zeta < 1:
            exact = precise(lambda: 1 / rational(1 - Fraction(zeta) ** 2).sqrt())
            assert float(vibration.decrement_of_damping_ratio(zeta)) / (2 * math.pi * zeta) == pytest.approx(
                exact, rel=1e-14
            )


class TestForcesKeepTheirDigits:
    @pytest.mark.parametrize("resistance", [1.0, 1e4, 1e8, 1e15, 1e200])
    def test_collision_against_a_strong_brake(self, resistance: float) -> None:
        """-W + (W^2 + c m v^2)^(1/2) is 0 in floats long before it is."""
        square, root = Decimal("1.92e9"), (Decimal(resistance) ** 2 + Decimal("1.92e9")).sqrt
        exact = precise(lambda: square / (root() + Decimal(resistance)))
        found = buffer.collision_force(5000.0, 0.0, 6e5, 0.8, resistance, buffer.WHOLE)
        assert found == pytest.approx(exact, rel=1e-13, abs=0)

    @pytest.mark.parametrize("weight", [1e-12, 1e-3, 1.0])
    def test_time_to_lift_a_feather(self, weight: float) -> None:
        """A small angle between two states of the phase plane: t = Q/(K v_0) at first."""
        found = two_mass.takeup(1e4, 1.0, 1e6, 5e4, weight, 0.3)
        assert found.time == pytest.approx(weight / (1e6 * 0.3), rel=1e-4)

    def test_delay_of_whole_periods_changes_nothing(self) -> None:
        """Q^2 + P^2 - 2 Q P cos(w t) loses its digits for a brake just as strong as the load."""
        angle = 1e-7
        delay = angle / two_mass.two_mass_frequency(1e6, 1e4, 1e4)
        found = float(two_mass.lowering_brake_force(5e4, 5e4, delay, 1e4, 1e4, 1e6))
        assert found - 5e4 == pytest.approx(2 * 5e4 * math.sin(angle / 2) / 2, rel=1e-7)

    @pytest.mark.parametrize("load", [1e-12, 1e-6, 1.0, 1e6])
    def test_acceleration_of_a_train_next_to_its_balance(self, load: float) -> None:
        """Rational arithmetic on both shafts, the motor a trifle stronger than the load."""
        torque = load / 40.0 / 0.85 * (1 + 1e-9)
        found = float(gearing.motor_acceleration(torque, 1.0, load, 0.9, 400.0, 40.0, 0.85, 0.8))
        m, u, eta = Fraction(torque), Fraction(40), Fraction(0.85)
        exact = (m - Fraction(load) / (u * eta)) / (Fraction(0.9) + Fraction(400) / (u * u * eta))
        assert found == pytest.approx(float(exact), rel=1e-6)


class TestStopsKeepTheirDigits:
    @pytest.mark.parametrize("speed", [1e-12, 1e-6, 1e-2, 1.0, 1e3, 1e9])
    @pytest.mark.parametrize("shape", [brake.LINEAR, brake.EXPONENTIAL])
    def test_of_a_body_without_load(self, speed: float, shape: str) -> None:
        """Early in the rise the torque grows as t: w = M t^2/(2 J t_r). Late, the rise costs its mean."""
        time, angle = brake.brake_stop(1.0, speed, 1.0, 0.0, 0.0, 1.0, shape)
        if shape == brake.LINEAR:
            expected = math.sqrt(2 * speed) if speed <= 0.5 else speed + 0.5
            turned = expected**3 / 3 if speed <= 0.5 else speed * expected - expected**2 / 2 + expected / 2 - 1 / 6
            assert time == pytest.approx(expected, rel=1e-14)
            assert angle == pytest.approx(turned, rel=1e-9)
        else:
            left = precise(lambda: Decimal(speed) - Decimal(time) + 1 - (-Decimal(time)).exp())
            assert abs(left) <= 4e-16 * speed + 4e-16 * time**2  # a float's spacing in t
            turned = precise(
                lambda: (
                    Decimal(speed) * Decimal(time)
                    - Decimal(time) ** 2 / 2
                    + Decimal(time)
                    - (1 - (-Decimal(time)).exp())
                )
            )
            assert angle == pytest.approx(turned, rel=1e-12)

    @pytest.mark.parametrize("other", [-1e6, -1.0, -1e-6, 1e-6, 0.4])
    @pytest.mark.parametrize("speed", [1e-12, 1e-6, 1e-3])
    def test_of_a_body_that_friction_nearly_stops_before_the_brake(self, other: float, speed: float) -> None:
        """The root of a quadratic whose other form takes two nearly equal numbers from each other."""

        time, _ = brake.brake_stop(1.0, speed, 1.0, other, 0.0, 2.0, brake.LINEAR)

        def exactly() -> Decimal:  # M t^2/(2 t_r) - M_o t - J w = 0 with M = J = 1, t_r = 2
            o, w = Decimal(other), Decimal(speed)
            return 2 * (o + (o * o + w).sqrt())

        assert time == pytest.approx(precise(exactly), rel=1e-14, abs=0)

    @pytest.mark.parametrize("rise", [0.0, 5e-324, 1e-300, 1e-30, 1e-12])
    @pytest.mark.parametrize("shape", [brake.LINEAR, brake.EXPONENTIAL])
    def test_of_a_brake_that_closes_in_no_time(self, rise: float, shape: str) -> None:
        assert brake.brake_stop(3.0, 8.0, 6.0, 2.0, 0.0, rise, shape) == pytest.approx((6.0, 24.0), rel=1e-11)
        assert brake.brake_torque_for_time(3.0, 8.0, 6.0, 2.0, 0.0, rise, shape) == pytest.approx(6.0, rel=1e-11)
