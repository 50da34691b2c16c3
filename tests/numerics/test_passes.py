"""Tooth passes against scipy: exponentials pass by pass, DOP853 restarted at every engagement, other bases."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from ptmcalc.numerics.passes import Passes, Wave, iterates

steady = settings(derandomize=True, database=None, deadline=None, max_examples=60)
TEETH, PITCH, OMEGA = 12, 0.1, 2.0
HALF = math.pi / TEETH
RADIUS = PITCH / 2 / math.sin(HALF)
WAVE = Wave(OMEGA, -HALF, 2 * HALF / OMEGA)
GAIN = np.array([0.0, OMEGA**2 * RADIUS])
DEFLECTION = np.array([1.0, 0.0])


def oscillator(w: float, zeta: float) -> np.ndarray:
    return np.array([[0.0, 1.0], [-w * w, -2 * zeta * w]])


def restarted(w: float, zeta: float, passes: int, places: np.ndarray, rtol: float) -> np.ndarray:
    """q'' + 2 zeta w q' + w^2 q = -a by DOP853, stopped and started again at every engagement."""
    state, seen = np.zeros(2), []
    for _ in range(passes):
        run = solve_ivp(
            lambda t, y: [y[1], OMEGA**2 * RADIUS * math.sin(OMEGA * t - HALF) - 2 * zeta * w * y[1] - w * w * y[0]],
            (0, WAVE.period),
            state,
            method="DOP853",
            rtol=rtol,
            atol=rtol * 1e-2,
            t_eval=[*(places * WAVE.period), WAVE.period],
        )
        seen.append(run.y[0][:-1])
        state = run.y[:, -1]
    return np.array(seen)


@pytest.mark.parametrize(("w", "zeta"), [(24.0, 0.0), (24.0, 1e-3), (24.1, 0.05), (2.0, 0.0), (9.0, 1.0), (400.0, 3.0)])
def test_agrees_with_dop853_restarted_at_every_engagement(w: float, zeta: float) -> None:
    """At the tooth frequency, at the shaft's own, at critical damping and stiff beyond it."""
    places = np.arange(8) / 8
    found = Passes(oscillator(w, zeta), GAIN, WAVE, 40).at(places, DEFLECTION[None, :])[:, :, 0]
    expected = restarted(w, zeta, 40, places, 1e-12)
    assert found == pytest.approx(expected, abs=1e-9 * np.abs(expected).max())


def test_hard_case_of_a_thousand_passes() -> None:
    """Deflection after 1000 passes, 1e-6 beside the tooth frequency, from 80 digits."""
    passes = Passes(oscillator(24 * (1 + 1e-6), 1e-3), GAIN, WAVE, 1001)
    assert float(passes.starts[1000, 0]) == pytest.approx(0.11108916075191538, rel=1e-12)


def test_resonance_without_damping_grows_by_the_same_each_pass() -> None:
    """M = I: z_k = k g, to the last digits of the angle."""
    starts = Passes(oscillator(24.0, 0.0), GAIN, WAVE, 1001).starts
    away = starts[1000] - 1000 * starts[1]
    assert np.hypot(24.0 * away[0], away[1]) < 1e-11 * 24.0 * starts[1000, 0]


def test_settles_to_the_series_of_its_harmonics() -> None:
    """sum b_n H(n w_z) of the acceleration, after the start has faded."""
    w, zeta, places = 31.0, 0.2, np.arange(16) / 16
    passes = Passes(oscillator(w, zeta), GAIN, WAVE, 200)
    n = np.arange(1, 20001)
    b = (-1.0) ** n * OMEGA**2 * PITCH / 2 * 2 / (np.pi * n) / (1 - 1 / (n * TEETH) ** 2)
    s = n * 24.0
    terms = -b / (w**2 - s**2 + 2j * zeta * w * s)
    x = places - 0.5
    expected = np.imag(np.exp(2j * np.pi * x[:, None] * n) @ terms)
    found = passes.at(places, DEFLECTION[None, :])[-1, :, 0]
    assert found == pytest.approx(expected, abs=1e-9 * np.abs(expected).max())


def test_largest_is_a_root_of_the_slope() -> None:
    passes = Passes(oscillator(31.0, 0.02), GAIN, WAVE, 50)
    best, which, place = passes.largest(DEFLECTION)
    fine = passes.at(np.linspace(0, 1, 4001), np.eye(2))
    assert best == pytest.approx(fine[:, :, 0].max(), rel=1e-7)
    assert best >= fine[:, :, 0].max()
    slope = passes.at([place], np.array([[0.0, 1.0]]))[which, 0, 0]
    assert abs(slope) < 1e-9 * np.abs(fine[:, :, 1]).max()


@pytest.mark.parametrize("count", range(1, 9))
def test_largest_lies_within_the_passes(count: int) -> None:
    """A slow wave that is still rising where they end."""
    passes = Passes(oscillator(2.0, 0.02), GAIN, WAVE, count)
    for row in (DEFLECTION, -DEFLECTION):
        best, _, place = passes.largest(row)
        fine = passes.at(np.linspace(0, 1, 4001), row[None, :])
        assert best == pytest.approx(fine.max(), rel=1e-6)
        assert 0 <= place <= 1


@pytest.mark.parametrize("size", [2.0**-40, 2.0**40])
def test_the_answer_is_as_large_as_the_wave(size: float) -> None:
    """However the balance shares out what is so large or small beside the rates."""
    plain, other = (
        Passes(oscillator(31.0, 0.02), gain, WAVE, 9).at([0.0, 0.3], np.eye(2)) for gain in (GAIN, size * GAIN)
    )
    assert other == pytest.approx(size * plain, rel=1e-12, abs=1e-14 * size)


def test_several_modes_and_a_start() -> None:
    """Two coupled masses, from a state that is not rest: scipy's exponential, pass by pass."""
    rate = np.array([[0, 0, 1, 0], [0, 0, 0, 1], [-900, 400, -0.3, 0.1], [300, -500, 0.2, -0.9]], float)
    gain, start = np.array([0.0, 0.0, 1.5, -0.2]), np.array([1e-3, -2e-3, 0.05, 0.0])
    whole = np.zeros((6, 6))
    whole[:4, :4], whole[:4, 4], whole[4, 5], whole[5, 4] = rate, gain, OMEGA, -OMEGA
    driven = np.array([math.sin(-HALF), math.cos(-HALF)])
    passes = Passes(rate, gain, WAVE, 30, start)
    found = passes.at([0.0, 0.4], np.eye(4))
    state = start
    for k in range(30):
        assert found[k, 0] == pytest.approx(state, rel=1e-10, abs=1e-13)
        inside = expm(whole * 0.4 * WAVE.period) @ np.concatenate([state, driven])
        assert found[k, 1] == pytest.approx(inside[:4], rel=1e-10, abs=1e-13)
        state = (expm(whole * WAVE.period) @ np.concatenate([state, driven]))[:4]


class TestIterates:
    @given(st.integers(1, 70), st.integers(0, 10**6))
    @steady
    def test_one_after_the_other(self, count: int, seed: int) -> None:
        rng = np.random.default_rng(seed)
        matrix, offset, start = rng.normal(size=(3, 3)) / 3, rng.normal(size=3), rng.normal(size=3)
        state = start
        for found in iterates(matrix, offset, start, count):
            assert found == pytest.approx(state, rel=1e-9, abs=1e-10)
            state = matrix @ state + offset


@pytest.mark.parametrize("teeth", [3, 17, 10**5])
@pytest.mark.parametrize("zeta", [0.0, 1e-6, 0.3, 1.0, 40.0])
@pytest.mark.parametrize("ratio", [1e-6, 1.0, 1e3])
def test_no_number_of_teeth_and_no_damping_is_special(teeth: int, zeta: float, ratio: float) -> None:
    """Bounded by what a base motion can do: the acceleration jumps by 2 every pass, passes add up at most."""
    half = math.pi / teeth
    period, passes = 1.0, 64
    wave = Wave(2 * half / period, -half, period)
    w = ratio * 2 * math.pi / period
    gain = np.array([0.0, 1 / math.sin(half)])
    found = Passes(oscillator(w, zeta), gain, wave, passes).at(np.arange(5) / 5, np.eye(2))
    assert np.all(np.isfinite(found))
    assert np.abs(found[:, :, 1]).max() <= passes * period
    assert np.abs(found[:, :, 0]).max() <= min(passes * period / w, (passes * period) ** 2) * (1 + 1e-9)
