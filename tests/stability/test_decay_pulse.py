"""Pulse on an oscillator beside its removable singularities: the hard cases, and decimal arithmetic."""

import math
from collections.abc import Callable
from decimal import Decimal, localcontext

import numpy as np
import pytest

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.decay_pulse import DecayPulse

NEAR = [0.0, 1e-16, 1e-12, 1e-9, 1e-6, 1e-3, 0.1]


def precise(compute: Callable[[], Decimal]) -> float:
    """A number computed with 300 digits, of which a turn of 300 rad takes 120, and rounded once."""
    with localcontext() as context:
        context.prec = 300
        context.Emin, context.Emax = -9999, 9999
        return float(compute())


def cosine_and_sine(angle: Decimal) -> tuple[Decimal, Decimal]:
    c, s, term, k = Decimal(0), Decimal(0), Decimal(1), 0
    while k < 2000 and (abs(term) > Decimal("1e-310") or k < 4):
        if k % 2 == 0:
            c += term if k % 4 == 0 else -term
        else:
            s += term if k % 4 == 1 else -term
        k += 1
        term *= angle / k
    return c, s


def undamped(k: float, slow: float, fast: float, time: float) -> Callable[[], Decimal]:
    """Partial fractions."""

    def compute() -> Decimal:
        w, t = Decimal(k), Decimal(time)
        c, s = cosine_and_sine(w * t)
        total = Decimal(0)
        for a, sign in ((Decimal(slow), 1), (Decimal(fast), -1)):
            total += sign * ((-a * t).exp() - c + a / w * s) / (a * a + w * w)
        return total

    return compute


class TestKeepsItsDigits:
    @pytest.mark.parametrize("time", [1e-9, 1e-5, 1e-2, 0.09, 0.11, 0.4, 3.0])
    @pytest.mark.parametrize("natural", [1e-9, 1e-3, 0.3, 5.47, 94.0])
    def test_from_soft_to_stiff(self, natural: float, time: float) -> None:
        found = float(DecayPulse(natural, 0.0, 3.0, 96.0, 1.0, 5.0).at(time)[0])
        assert found == pytest.approx(precise(undamped(natural, 3.0, 96.0, time)), rel=1e-12, abs=1e-15)

    @pytest.mark.parametrize("beside", NEAR[1:])
    @pytest.mark.parametrize("time", [1e-9, 1e-3, 0.4, 3.0])
    def test_nearly_equal_decays(self, beside: float, time: float) -> None:
        """Relative to a pulse that vanishes with the distance of its decays."""
        slow = 3.0
        fast = slow * (1 + beside)
        found = float(DecayPulse(5.47, 0.0, slow, fast, 1.0, 5.0).at(time)[0])
        expected = precise(undamped(5.47, slow, fast, time)) if fast > slow else 0.0
        assert found == pytest.approx(expected, rel=1e-10, abs=0)

    @pytest.mark.parametrize("beside", [*NEAR, *(-x for x in NEAR[2:])])
    @pytest.mark.parametrize("time", [1e-9, 1e-3, 0.4, 3.0])
    def test_critical_damping_at_a_decay(self, beside: float, time: float) -> None:
        """All but the fast exponent meet: b, b, b (1 + e)."""
        b, slow, fast = 3.0, 3.0 * (1 + beside), 96.0

        def exactly() -> Decimal:
            w, t = Decimal(b), Decimal(time)
            total = Decimal(0)
            for a, sign in ((Decimal(slow), 1), (Decimal(fast), -1)):
                gap = w - a
                if gap == 0:
                    total += sign * (-w * t).exp() * t * t / 2
                else:
                    total += sign * ((-a * t).exp() - (-w * t).exp() * (1 + gap * t)) / (gap * gap)
            return total

        found = float(DecayPulse(b, 1.0, slow, fast, 1.0, 5.0).at(time)[0])
        assert found == pytest.approx(precise(exactly), rel=1e-12, abs=0)

    @pytest.mark.parametrize("scale", [1e-100, 1e-30, 1e30, 1e100])
    def test_does_not_know_its_units(self, scale: float) -> None:
        """Time in other units: x grows with the square of its unit."""
        plain = DecayPulse(5.47, 0.02, 3.0, 96.0, 1.0, 5.0)
        other = DecayPulse(5.47 / scale, 0.02, 3.0 / scale, 96.0 / scale, 1.0 / scale**2, 5.0 * scale)
        x, v = plain.at([0.1, 2.0, 6.0])
        y, u = other.at(np.array([0.1, 2.0, 6.0]) * scale)
        assert y == pytest.approx(x, rel=1e-12)
        assert u * scale == pytest.approx(v, rel=1e-12)
        assert other.largest().value == pytest.approx(plain.largest().value, rel=1e-10)

    @pytest.mark.parametrize("seed", range(40))
    def test_any_summit_is_finite_or_refused(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        natural, slow, fast, duration = (float(10 ** rng.uniform(-12, 12)) for _ in range(4))
        zeta = float(rng.choice([0.0, 1e-9, 0.05, 1.0, 1e6]))
        pulse = DecayPulse(natural, zeta, slow, fast, 1.0, duration)
        try:
            summit = pulse.largest()
        except NumericsError:
            return
        assert all(map(math.isfinite, (summit.value, summit.time, summit.error)))
        x = pulse.at(np.geomspace(1e-14, 1e2, 400) * (duration + 1 / natural))[0]
        assert np.abs(x).max() <= abs(summit.value) * (1 + 1e-9) + summit.error
