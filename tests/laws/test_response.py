"""Responses over time against the matrix exponential of the system with its force as further states.

Reference: z' = A z, z = (x, v, force states), solved by scipy's expm of A t; a sine takes two states, an exponential
one.
"""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.linalg import expm

from ptmcalc.laws import response

TIMES = [0.0, 1e-3, 0.2, 1.7, 6.0]
DAMPINGS = [0.0, 0.02, 0.6, 1 - 1e-9, 1.0, 1 + 1e-9, 1.7, 20.0]


def oscillator(natural: float, zeta: float, forces: int) -> np.ndarray:
    system = np.zeros((2 + forces, 2 + forces))
    system[0, 1] = 1.0
    system[1, :2] = -(natural**2), -2 * zeta * natural
    return system


class TestFree:
    @pytest.mark.parametrize("zeta", DAMPINGS)
    @pytest.mark.parametrize("start", [(0.01, 0.0), (0.0, 0.5), (-0.02, 0.7)])
    def test_displacement_and_speed(self, zeta: float, start: tuple[float, float]) -> None:
        natural = 5.0
        for t in TIMES:
            expected = expm(oscillator(natural, zeta, 0) * t) @ start
            assert float(response.free_response(natural, zeta, *start, t)) == pytest.approx(
                expected[0], rel=1e-8, abs=1e-12
            )
            assert float(response.free_speed(natural, zeta, *start, t)) == pytest.approx(
                expected[1], rel=1e-8, abs=1e-11
            )

    def test_without_spring_it_flies_on(self) -> None:
        assert response.free_response(0.0, 0.0, 2.0, 3.0, np.array([0.0, 4.0])).tolist() == [2.0, 14.0]
        assert response.free_response(0.0, 1.0, 2.0, 3.0, np.array([0.0, 4.0])).tolist() == [2.0, 14.0]

    @pytest.mark.parametrize("zeta", [0.01, 0.2, 0.8])
    def test_the_envelope_touches_the_decay(self, zeta: float) -> None:
        """A start in step with the decay: x = exp(-zeta w t) cos(w_d t)."""
        natural, times = 7.0, np.linspace(0, 3, 5001)
        x = response.free_response(natural, zeta, 1.0, -zeta * natural, times)
        envelope = response.decay_envelope(natural, zeta, 1.0, times)
        assert np.all(np.abs(x) <= envelope * (1 + 1e-12))
        turns = np.pi / (natural * np.sqrt(1 - zeta**2)) * np.arange(4)
        touched = np.abs(response.free_response(natural, zeta, 1.0, -zeta * natural, turns))
        assert touched == pytest.approx(response.decay_envelope(natural, zeta, 1.0, turns), rel=1e-12)


class TestSine:
    @pytest.mark.parametrize("frequency", [0.0, 0.3, 4.0, 5.0 - 1e-7, 5.0, 5.0 + 1e-3, 7.0, 60.0])
    @pytest.mark.parametrize("natural", [5.0, 0.4])
    def test_from_rest(self, natural: float, frequency: float) -> None:
        system = oscillator(natural, 0.0, 2)
        system[1, 2] = 3.0
        system[2, 3], system[3, 2] = frequency, -frequency
        for t in TIMES:
            expected = (expm(system * t) @ [0.0, 0.0, 0.0, 1.0])[0]
            assert float(response.sine_response(natural, frequency, 3.0, t)) == pytest.approx(
                expected, rel=1e-8, abs=1e-12
            )

    def test_without_spring_twice_the_integral(self) -> None:
        expected = quad(lambda u: (2.0 - u) * np.sin(3.0 * u), 0, 2.0, epsabs=1e-14)[0]
        assert float(response.sine_response(0.0, 3.0, 1.0, 2.0)) == pytest.approx(expected, rel=1e-12)

    def test_resonance_grows_with_time(self) -> None:
        """Half the time times the displacement at rest at the crests far out."""
        k = 6.0
        crests = np.pi / k * (np.arange(50, 55) * 2)
        assert response.sine_response(k, k, 1.0, crests) == pytest.approx(-crests / (2 * k), rel=1e-3)


class TestDecays:
    @pytest.mark.parametrize("zeta", DAMPINGS)
    @pytest.mark.parametrize("decay", [0.0, 0.5, 5.0, 5.0 + 1e-8, 96.0])
    def test_one(self, zeta: float, decay: float) -> None:
        natural = 5.0
        system = oscillator(natural, zeta, 1)
        system[1, 2], system[2, 2] = 3.0, -decay
        for t in TIMES:
            expected = (expm(system * t) @ [0.0, 0.0, 1.0])[0]
            found = float(response.decay_response(natural, zeta, decay, 3.0, t))
            assert found == pytest.approx(expected, rel=1e-7, abs=1e-12)

    @pytest.mark.parametrize("zeta", DAMPINGS)
    @pytest.mark.parametrize(("slow", "fast"), [(3.0, 96.0), (3.0, 3.0 + 1e-7), (5.0, 5.0), (0.0, 2.0), (0.0, 0.0)])
    def test_pulse(self, zeta: float, slow: float, fast: float) -> None:
        natural = 5.0
        system = oscillator(natural, zeta, 2)
        system[1, 2], system[2, 2], system[3, 3] = 1.0, -slow, -fast
        system[2, 3] = fast - slow  # the pulse is what the fast decay feeds into the slow one
        for t in TIMES:
            expected = (expm(system * t) @ [0.0, 0.0, 0.0, 1.0])[0]
            found = float(response.pulse_response(natural, zeta, slow, fast, 1.0, t))
            assert found == pytest.approx(expected, rel=1e-7, abs=1e-12)

    def test_a_pulse_is_the_difference_of_two_decays(self) -> None:
        times = np.linspace(0, 3, 40)
        both = [response.decay_response(5.47, 0.02, decay, 1.0, times) for decay in (3.0, 96.0)]
        found = response.pulse_response(5.47, 0.02, 3.0, 96.0, 1.0, times)
        assert found == pytest.approx(both[0] - both[1], abs=1e-13)

    def test_a_force_that_stays_is_a_step(self) -> None:
        """From rest it swings between 0 and twice the deflection at rest."""
        times = np.linspace(0, 2 * np.pi / 5, 101)
        x = response.decay_response(5.0, 0.0, 0.0, 25.0, times)
        assert x == pytest.approx(1 - np.exp(5j * times).real, abs=1e-13)
