"""A sprocket that speeds up through a resonance, against DOP853 stopped at every engagement and constant speed."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from ptmcalc.numerics.passes import Passes, Wave, oscillators
from ptmcalc.numerics.run_through import Run, run_through

TEETH, PITCH = 12, 0.1
HALF = math.pi / TEETH
RADIUS = PITCH / 2 / math.sin(HALF)
STRETCHES = 20
PLACES = np.linspace(0.0, 1.0, STRETCHES + 1)


class Ramp:
    """Angular speed w + e t from an engagement on."""

    def __init__(self, w: float, e: float, passes: int) -> None:
        self.w, self.e = w, e
        turned = 2 * HALF * np.arange(passes + 1)
        self.edges = turned / w if e == 0 else (np.sqrt(w**2 + 2 * e * turned) - w) / e
        self.speeds = w + e * self.edges

    def acceleration(self, inside: np.ndarray) -> np.ndarray:
        w = self.speeds[:-1, None]
        phi = w * inside + self.e * inside**2 / 2 - HALF
        return RADIUS * (self.e * np.cos(phi) - (w + self.e * inside) ** 2 * np.sin(phi))


def by_dop853(ramp: Ramp, w: float, zeta: float) -> tuple[np.ndarray, np.ndarray]:
    """Deflection and speed at the places."""
    state, seen = np.zeros(2), []
    for k, period in enumerate(np.diff(ramp.edges)):

        def rate(t: float, y: np.ndarray, pass_speed: float = float(ramp.speeds[k])) -> list[float]:
            phi = pass_speed * t + ramp.e * t * t / 2 - HALF
            base = RADIUS * (ramp.e * math.cos(phi) - (pass_speed + ramp.e * t) ** 2 * math.sin(phi))
            return [y[1], -base - 2 * zeta * w * y[1] - w * w * y[0]]

        run = solve_ivp(rate, (0, period), state, "DOP853", PLACES * period, rtol=1e-12, atol=1e-15)
        seen.append(run.y)
        state = run.y[:, -1]
    return np.array(seen)[:, 0], np.array(seen)[:, 1]


@pytest.mark.parametrize(("w", "zeta"), [(24.0, 0.0), (24.0, 0.02), (50.0, 1.0), (100.0, 2.0)])
@pytest.mark.parametrize("e", [0.08, -0.03, 0.0])
def test_agrees_with_dop853(w: float, zeta: float, e: float) -> None:
    ramp = Ramp(1.6 if e > 0 else 2.2, e, 40)
    run = run_through(ramp.edges, ramp.acceleration, [w], [zeta], STRETCHES)
    deflection, speed = by_dop853(ramp, w, zeta)
    size = np.abs(w * deflection).max()
    assert w * run.displacement[:, :, 0] == pytest.approx(w * deflection, abs=1e-9 * size)
    assert run.speed[:, :, 0] == pytest.approx(speed, abs=1e-9 * size)
    assert run.times == pytest.approx(ramp.edges[:-1, None] + np.diff(ramp.edges)[:, None] * PLACES)


def test_goes_on_from_where_another_run_ended() -> None:
    whole = Ramp(1.6, 0.08, 40)
    once = run_through(whole.edges, whole.acceleration, [24.0, 70.0], [0.02, 0.05], STRETCHES)
    part = Ramp(1.6, 0.08, 15)
    first = run_through(part.edges, part.acceleration, [24.0, 70.0], [0.02, 0.05], STRETCHES)
    late = Ramp(float(whole.speeds[15]), 0.08, 25)
    second = run_through(late.edges, late.acceleration, [24.0, 70.0], [0.02, 0.05], STRETCHES, first.end)
    assert second.displacement == pytest.approx(once.displacement[15:], abs=1e-13)
    assert second.speed == pytest.approx(once.speed[15:], abs=1e-11)


def test_every_mode_may_have_a_base_of_its_own() -> None:
    ramp = Ramp(1.6, 0.08, 12)
    alone = [run_through(ramp.edges, ramp.acceleration, [w], [0.02], STRETCHES) for w in (24.0, 70.0)]
    shares = np.array([1.0, -0.5])
    both = run_through(
        ramp.edges, lambda t: ramp.acceleration(t)[:, :, None] * shares, [24.0, 70.0], [0.02, 0.02], STRETCHES
    )
    for k in range(2):
        assert both.displacement[:, :, k] == pytest.approx(shares[k] * alone[k].displacement[:, :, 0], abs=1e-14)
    assert both.force([1.0, 0.0]) == pytest.approx(alone[0].force([1.0]), rel=1e-12)


def test_error_is_told() -> None:
    """Stretches too long for a fast mode: the run says so, and is not worse than it says."""
    ramp = Ramp(1.6, 0.1, 30)
    fine = run_through(ramp.edges, ramp.acceleration, [24.0, 600.0], [0.01, 0.01], 64)
    coarse = run_through(ramp.edges, ramp.acceleration, [24.0, 600.0], [0.01, 0.01], 8)
    away = np.abs(coarse.displacement - fine.displacement[:, ::8]).max(axis=(0, 1)) * np.array([24.0, 600.0])
    assert np.all(away <= coarse.error + 1e-13)
    assert coarse.error[0] < 1e-13
    assert coarse.error[1] > 1e-9
    assert fine.error[1] < coarse.error[1] * 1e-3


@pytest.mark.parametrize("stretches", [1, 3])
def test_the_error_told_is_that_of_gauss_with_eight_nodes(stretches: int) -> None:
    """Exact up to a power of 15; of the next one n!^4/((2 n + 1) (2 n)!^2) is missed in the speed of a free mass."""

    def told(power: int) -> float:
        edges = np.array([0.0, 1.0 * stretches, 2.0 * stretches])
        run = run_through(edges, lambda t: np.mod(t, 1.0) ** power, [1e-9], [0.0], stretches)
        return float(run.error[0])

    missed = math.factorial(8) ** 4 / (17 * math.factorial(16) ** 2)
    assert told(15) <= 1e-5 * missed
    assert told(16) == pytest.approx(2 * stretches * missed, rel=1e-5)


def test_constant_speed_is_the_affine_map() -> None:
    w, zeta = np.array([24.0, 77.0, 130.0]), np.array([0.01, 0.05, 1.3])
    ramp = Ramp(2.0, 0.0, 200)
    run = run_through(ramp.edges, ramp.acceleration, w, zeta, STRETCHES)
    rate, gain = oscillators(w, zeta)
    found = Passes(rate, -4 * RADIUS * gain, Wave(2.0, -HALF, HALF), 200).at(PLACES, np.eye(6))
    assert run.displacement == pytest.approx(found[:, :, :3], abs=1e-12)
    assert run.speed == pytest.approx(found[:, :, 3:], abs=1e-10)


def passing(stretches: int) -> Run:
    """Two modes of a chain, run through the first."""
    ramp = Ramp(1.6, 0.02, 200)
    return run_through(ramp.edges, ramp.acceleration, [24.0, 72.0], [0.02, 0.06], stretches)


class TestForce:
    MASSES = np.array([800.0, 90.0])

    def test_is_that_of_springs_and_dampers(self) -> None:
        run = passing(STRETCHES)
        expected = sum(
            -m * (w * w * run.displacement[:, :, k] + 2 * z * w * run.speed[:, :, k])
            for k, (m, w, z) in enumerate(zip(self.MASSES, (24.0, 72.0), (0.02, 0.06), strict=True))
        )
        assert run.force(self.MASSES) == pytest.approx(expected, rel=1e-12)

    def test_largest_comes_after_the_resonance(self) -> None:
        """In passing, the peak comes late; it is about (2/pi) m a_max/(2 zeta) of steady running at most."""
        run = passing(STRETCHES)
        force = run.force(self.MASSES)
        largest, time = force.max(), run.times.ravel()[force.argmax()]
        ramp_speed = 1.6 + 0.02 * time
        assert 2.0 < ramp_speed < 2.2
        steady = 2 / math.pi * 800.0 * 2.0**2 * PITCH / 2 / (2 * 0.02)
        assert 0.5 * steady < largest < steady * 1.15


@pytest.mark.parametrize("zeta", [0.0, 1 - 1e-12, 1.0, 1 + 1e-12, 1e6])
@pytest.mark.parametrize("w", [1e-9, 1.0, 1e4])
def test_no_damping_and_no_frequency_is_special(w: float, zeta: float) -> None:
    ramp = Ramp(1.0, 0.1, 20)
    run = run_through(ramp.edges, ramp.acceleration, [w], [zeta], STRETCHES)
    assert np.all(np.isfinite(run.displacement))
    base = ramp.acceleration(run.times - ramp.edges[:-1, None])
    assert np.abs(run.speed).max() <= np.abs(base).max() * ramp.edges[-1]
