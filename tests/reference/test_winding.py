"""Worked case C24: forcing and response of the winding paper (N. Fidrovska, O. Varchenko), to the digits stored."""

import math

import pytest
from scipy.integrate import quad

from ptmcalc.laws import winding
from ptmcalc.numerics.decay_pulse import DecayPulse

FREQUENCIES = [5.47037, 5.84808, 6.31664, 6.91954, 4.98059, 4.49583, 4.00156]
FACTORS = [1.02903, 1.06186, 1.09937, 1.14304, 0.982505, 0.931433, 0.873339]
ROPES = [(160, 114), (140, 114), (120, 114), (100, 114), (160, 94.5), (160, 77), (160, 61)]
STORED = 6e-6
SPEED, D = 0.4 * math.pi, 0.0175


def response(k: float) -> float:
    """C = k^2 q_max/A."""
    return k * k * DecayPulse(k, 0.0, winding.PAPER_SLOW, winding.PAPER_FAST, 1.0, 5.0).largest().value


@pytest.mark.parametrize(("rope", "frequency", "factor"), [*zip(ROPES, FREQUENCIES, FACTORS, strict=True)])
def test_frequency_and_response(rope: tuple[float, float], frequency: float, factor: float) -> None:
    length, area = rope
    k = winding.paper_frequency(2.1e11, area * 1e-6, 49050.0, length, 9.81)
    assert k == pytest.approx(frequency, rel=STORED)
    assert response(k) == pytest.approx(factor, rel=STORED)
    assert response(k) < 2


def test_forcing() -> None:
    pulse = DecayPulse(1.0, 0.0, winding.PAPER_SLOW, winding.PAPER_FAST, 1.0, 5.0)
    impulse = quad(lambda t: float(pulse.force(t)), 0, 5, points=[0.04, 0.3, 1], epsabs=1e-13)[0]
    assert impulse == pytest.approx(0.322917, rel=STORED)
    assert float(pulse.force(0.037266)) == pytest.approx(0.86628, rel=STORED)
    assert float(pulse.force(0.036)) < 0.86628 > float(pulse.force(0.0385))


def test_at_a_time() -> None:
    """The stored value against the equation of motion at 1.7 s."""
    k = winding.paper_frequency(2.1e11, 114e-6, 49050.0, 160, 9.81)
    found = float(DecayPulse(k, 0.0, 3.0, 96.0, 1.0, 5.0).at(1.7)[0])
    assert found == pytest.approx(0.0270604, rel=STORED)


@pytest.mark.parametrize(
    ("amplitude", "stretch", "ratio", "per_fall"),
    [
        (0.0276349, 0.000950277, 0.00289878, 0.0115951),
        (0.0552698, 0.00190055, 0.00579756, 0.0231903),
        (0.0681016, 0.0023418, 0.00714357, 0.0285743),
        (0.0589777, 0.00202806, 0.00618651, 0.024746),
    ],
    ids=["w^2 d", "2 w^2 d", "climb of d", "climb of 0.866 d"],
)
def test_readings_of_the_amplitude(amplitude: float, stretch: float, ratio: float, per_fall: float) -> None:
    k = winding.paper_frequency(2.1e11, 114e-6, 49050.0, 160, 9.81)
    factor = response(k)
    assert factor * amplitude / k**2 == pytest.approx(stretch, rel=STORED)
    assert winding.stress_ratio(factor, amplitude, 1, 1, 9.81) == pytest.approx(ratio, rel=STORED)
    stress = float(winding.stretch_stress(2.1e11, factor * amplitude / k**2, 160.0))
    assert stress / winding.fall_stress(49050.0, 4, 114e-6) == pytest.approx(per_fall, rel=STORED)


def test_amplitudes_are_those_of_the_laws() -> None:
    assert winding.paper_amplitude(SPEED, D) == pytest.approx(0.0276349, rel=STORED)
    assert winding.climb_amplitude(SPEED, D) == pytest.approx(0.0681016, rel=STORED)
    assert winding.climb_amplitude(SPEED, D * math.sqrt(3) / 2) == pytest.approx(0.0589777, rel=STORED)


def test_with_the_tackle() -> None:
    k = 4 * winding.paper_frequency(2.1e11, 114e-6, 49050.0, 160, 9.81)
    assert k == pytest.approx(21.8815, rel=STORED)
    assert response(k) == pytest.approx(1.57023, rel=STORED)
    step = D * math.sqrt(3) / 2
    assert winding.stress_ratio(response(k), winding.climb_amplitude(SPEED, step), 4, 1, 9.81) == pytest.approx(
        0.00236005, rel=STORED
    )
    assert winding.sudden_ratio(SPEED, step, k, 4, 1, 9.81) == pytest.approx(0.0106201, rel=STORED)


@pytest.mark.parametrize(("share", "height"), [(0.07, 0.920698), (0.18, 0.139241)])
def test_height_at_which_a_sudden_climb_gives_what_the_paper_claims(share: float, height: float) -> None:
    k = 4 * winding.paper_frequency(2.1e11, 114e-6, 49050.0, 4 * height, 9.81)
    assert winding.sudden_ratio(SPEED, D * math.sqrt(3) / 2, k, 4, 1, 9.81) == pytest.approx(share, rel=STORED)


def test_misprints() -> None:
    """The branch after the pulse, with the sign as printed, jumps at its end."""
    k, tau = 5.47, 5.0  # as printed
    printed = 0.0
    for a, sign in ((3.0, 1), (96.0, -1)):
        swing = a * math.sin(k * tau) - k * math.cos(k * tau)
        printed += sign * (swing + math.exp(-a * tau) * -k) / (a * a + k * k) / k
    right = float(DecayPulse(k, 0.0, 3.0, 96.0, 1.0, tau).at(math.nextafter(tau, 6.0))[0])
    assert printed - right == pytest.approx(-1.57192e-8, rel=STORED)
