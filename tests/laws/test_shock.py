"""Dynamic factors against the response by superposition of sampled impulses, and energy."""

import math
from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from ptmcalc.laws import shock

OMEGA = 2 * math.pi  # a period of one second


def largest(force: Callable[[float], float], breaks: list[float], until: float, zeta: float = 0.0) -> float:
    """Largest deflection over the static one, integrated from break to break of the force; samples refined."""
    state, top = np.zeros(2), 0.0
    edges = [0.0, *[b for b in breaks if 0 < b < until], until]
    for start, end in pairwise(edges):
        inside = np.nextafter(start, end), np.nextafter(end, start)

        def rate(t: float, y: np.ndarray, inside: tuple[float, float] = inside) -> list[float]:
            push = force(float(np.clip(t, *inside)))
            return [y[1], OMEGA**2 * (push - y[0]) - 2 * zeta * OMEGA * y[1]]

        run = solve_ivp(rate, (start, end), state, rtol=1e-10, atol=1e-12, dense_output=True, max_step=0.05)
        times = np.linspace(start, end, 4001)
        x = run.sol(times)[0]
        k = int(np.argmax(x))
        near = np.linspace(times[max(k - 1, 0)], times[min(k + 1, 4000)], 2001)
        top = max(top, float(run.sol(near)[0].max()))
        state = run.y[:, -1]
    return top


class TestFactors:
    @pytest.mark.parametrize("zeta", [0.0, 0.0397573, 0.3, 0.9])
    def test_step(self, zeta: float) -> None:
        found = largest(lambda t: 1.0, [], 3.0, zeta)
        assert float(shock.step_factor(zeta)) == pytest.approx(found, rel=1e-7)

    def test_step_with_critical_damping_does_not_overshoot(self) -> None:
        assert shock.step_factor(np.array([1.0, 2.0])).tolist() == [1.0, 1.0]

    @pytest.mark.parametrize("rise", [0.01, 0.3, 0.7, 1.0, 1.5, 2.3])
    def test_ramp(self, rise: float) -> None:
        found = largest(lambda t: min(t / rise, 1.0), [rise], rise + 1.5)
        assert float(shock.ramp_factor(rise)) == pytest.approx(found, rel=1e-6)

    def test_a_ramp_of_no_time_is_a_step(self) -> None:
        assert float(shock.ramp_factor(0.0)) == float(shock.step_factor(0.0)) == 2.0

    @pytest.mark.parametrize("duration", [0.01, 0.2, 0.49, 0.5, 0.8, 3.0])
    def test_rectangular_pulse(self, duration: float) -> None:
        found = largest(lambda t: 1.0 if t < duration else 0.0, [duration], duration + 1.2)
        assert float(shock.rectangular_pulse_factor(duration)) == pytest.approx(found, rel=1e-6)

    @pytest.mark.parametrize(
        "duration", [0.02, 0.3, 0.49, 0.5, 0.504, 0.51, 0.81, 1.0, 1.49, 1.51, 2.0, 2.49, 2.52, 2.7, 6.3, 6.52]
    )
    def test_half_sine_pulse(self, duration: float) -> None:
        def force(t: float) -> float:
            return math.sin(math.pi * t / duration) if t < duration else 0.0

        found = largest(force, [duration], duration + 1.2)
        assert float(shock.half_sine_pulse_factor(duration)) == pytest.approx(found, rel=1e-6)


class TestBlows:
    def test_a_short_impulse_is_the_limit_of_a_short_pulse(self) -> None:
        mass, stiffness, impulse = 3.0, 3.0 * OMEGA**2, 0.7
        for duration in (0.02, 0.005):
            static = impulse / duration / stiffness
            pulse = static * largest(lambda t, d=duration: 1.0 if t < d else 0.0, [duration], 1.2)
            limit = shock.impulse_displacement(impulse, stiffness, mass)
            assert limit / pulse - 1 == pytest.approx((math.pi * duration) ** 2 / 6, rel=0.02)

    @pytest.mark.parametrize("speed", [0.0, 0.2, 4.0])
    def test_impact_by_energy(self, speed: float) -> None:
        """The largest root of c x^2/2 - Q x - m v^2/2, and of the swing about equilibrium."""
        weight, stiffness, mass = 500.0, 2e4, 50.0
        compression = max(np.roots([stiffness / 2, -weight, -mass * speed**2 / 2]).real)
        found = shock.impact_force_unloaded(weight, stiffness, mass, speed)
        assert found == pytest.approx(stiffness * compression, rel=1e-12)
        rest = weight / stiffness
        energy = stiffness * rest**2 / 2 - weight * rest + mass * speed**2 / 2
        compression = max(np.roots([stiffness / 2, -weight, -energy]).real)
        found = shock.impact_force_preloaded(weight, stiffness, mass, speed)
        assert found == pytest.approx(stiffness * compression, rel=1e-6 if speed == 0 else 1e-12)
