"""Stretches of a mode with a smooth curve: against tight integrations, in variables of unlike size.

Reference: DOP853 on x'' = -9 x - 0.4 x' - 2 x^3 + 5 u (and a second curve of two arguments), restarted at every
stretch.
"""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from numpy.polynomial import Chebyshev
from scipy.integrate import solve_ivp

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.flow import RESOLVED
from ptmcalc.numerics.motion import Curve, Motion
from ptmcalc.numerics.panels import NODES
from ptmcalc.numerics.stretch import Piece

SCALE = np.array([0.02, 7.0, 1.0])
TOLERANCE = 1e-9
FACTORIALS = np.cumprod([1.0, *range(1, NODES.size)])
MONOMIALS = np.linalg.inv(NODES[:, None] ** np.arange(NODES.size) / FACTORIALS)
CUBE = Curve(np.array([[1.0, 0.0, 0.0]]), lambda y: -2 * y[0] ** 3, lambda y: -6 * float(y[0]) ** 2, 2.0, 0.25)
DRAG = Curve(
    np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]), lambda y: -0.1 * y[0] * y[1] ** 2,
    lambda y: -0.1 * float(y[1]) ** 2, 0.3, 0.125,
)  # fmt: skip


def rates(z: np.ndarray, curves: tuple[Curve, ...]) -> np.ndarray:
    found = np.array([z[1], -9 * z[0] - 0.4 * z[1] + 5 * z[2], 0.0])
    found[1] += sum(float(curve.value((curve.rows @ z)[:, None])[0]) for curve in curves)
    return found


def piece_of(*curves: Curve, resolved: float = RESOLVED) -> Piece:
    rate = np.array([[0.0, 1.0, 0.0], [-9.0, -0.4, 5.0], [0.0, 0.0, 0.0]])
    gain = np.zeros((3, len(curves)))
    gain[1] = 1.0
    watch = np.zeros((2, 3 + len(curves)))
    watch[0, 0], watch[1, 1], watch[1, 3:] = 1.0, 0.5, 1.0
    guards = np.zeros((1, 3 + len(curves)))
    guards[0, 2:4] = 4.0, 1.0
    system = SimpleNamespace(scale=SCALE, own=2, input_speed=0.0)
    return Piece(Motion(rate, gain, guards, watch, curves), system, resolved)  # type: ignore[arg-type]


def moved(z: np.ndarray, time: float, curves: tuple[Curve, ...]) -> np.ndarray:
    return np.asarray(solve_ivp(
        lambda t, y: rates(y, curves), (0, time), z, "DOP853", rtol=1e-12, atol=1e-14).y[:, -1])  # fmt: skip


STATES = [np.array(z) for z in ([0.4, -1.0, 0.0], [1.3, 0.2, 1.0], [-0.9, 2.0, -0.4], [0.01, 0.0, 1.0])]


@pytest.mark.parametrize("curves", [(CUBE,), (CUBE, DRAG)])
@pytest.mark.parametrize("z", STATES)
class TestStretch:
    def test_carries_the_curves_along(self, z: np.ndarray, curves: tuple[Curve, ...]) -> None:
        """State, guards and signals at any time of a stretch are those of the nonlinear equation."""
        piece = piece_of(*curves)
        flow, wide, span = piece.stretch(z / SCALE, math.inf, 0.3, TOLERANCE)
        assert span <= 0.5
        for share in (0.0, 0.37, 1.0):
            there = flow.moved(wide, share * span)
            expected = moved(z, share * span, curves) if share else z
            assert there[:3] * SCALE == pytest.approx(expected, abs=3e-8)
            n = [float(curve.value((curve.rows @ expected)[:, None])[0]) for curve in curves]
            assert flow.watch @ there == pytest.approx([expected[0], 0.5 * expected[1] + sum(n)], abs=3e-8)
            assert flow.guards @ there == pytest.approx([4 * expected[2] + n[0]], abs=3e-8)
        assert piece.now(z) == pytest.approx(flow.watch @ wide, abs=3e-9)

    def test_is_as_long_as_its_tail_allows(self, z: np.ndarray, curves: tuple[Curve, ...]) -> None:
        """The last two coefficients of what a curve has beyond its slope, over its size, are the tail: a power of two
        that keeps to the tolerance, while the double one does not; the next may be longer by the eighth root."""

        def tail(span: float) -> float:
            times = span * NODES
            run = solve_ivp(lambda t, y: rates(y, curves), (0, span), z, "DOP853", times, rtol=1e-12, atol=1e-14)
            worst = 0.0
            for curve in curves:
                y = curve.rows @ run.y
                grain = curve.grain
                slope = round(curve.slope(curve.rows @ z) / grain) * grain
                last = Chebyshev.fit(NODES, curve.value(y) - slope * y[0], 8, domain=[0, 1]).coef[-2:]
                worst = max(worst, float(np.abs(last).max()) / curve.size)
            return worst

        for tolerance in (1e-5, 1e-8):
            piece = piece_of(*curves)
            _, _, span = piece.stretch(z / SCALE, math.inf, 100.0, tolerance)
            assert math.log2(span) == round(math.log2(span))
            assert tail(span) <= tolerance * 1.01
            doublings = -math.log2(tail(span) / tolerance) / 8
            if abs(doublings - round(doublings)) > 0.01:
                assert piece.reach == span * 2.0 ** math.floor(doublings)
            if span < 1:
                assert tail(2 * span) > tolerance * 0.99

    def test_is_no_longer_than_it_is_asked_for(self, z: np.ndarray, curves: tuple[Curve, ...]) -> None:
        for longest, power in ((0.01, -6), (1 / 64, -6), (0.02, -5), (1e-4, -13)):
            assert piece_of(*curves).stretch(z / SCALE, math.inf, longest, 1e-7)[2] == 2.0**power
        assert piece_of(*curves).stretch(z / SCALE, 1 / 256, 0.02, 1e-7)[2] == 1 / 256
        finer = piece_of(*curves, resolved=0.75 * RESOLVED).stretch(z / SCALE, math.inf, 0.01, 1e-7)[2]
        assert finer == pytest.approx(0.75 / 64, rel=1e-14)


def test_looks_at_the_curve_a_few_times() -> None:
    """One at the start, one at the first guess, one after a correction by the slopes there: quadratic from then on."""
    calls = []
    curve = Curve(CUBE.rows, lambda y: (calls.append(y.shape[1]), CUBE.value(y))[1], CUBE.slope, CUBE.size, CUBE.grain)
    for longest in (1 / 32, 1 / 256):
        calls.clear()
        piece_of(curve).stretch(STATES[1] / SCALE, math.inf, longest, 1e-7)
        assert calls[0] == 1
        assert calls[1:] == [9] * (len(calls) - 1)
        assert len(calls) <= 4


def test_a_stretch_that_is_too_long_is_given_up_early() -> None:
    calls = []
    curve = Curve(CUBE.rows, lambda y: (calls.append(y.shape[1]), CUBE.value(y))[1], CUBE.slope, CUBE.size, CUBE.grain)
    _, _, span = piece_of(curve).stretch(STATES[1] / SCALE, math.inf, 60.0, 1e-9)
    halvings = math.log2(64 / span)
    assert halvings >= 4
    assert len(calls) <= 3.4 * halvings


def test_what_no_stretch_resolves_is_said() -> None:
    rough = Curve(CUBE.rows, lambda y: np.where(y[0] > 0.4, 1.0, -1.0) + 0 * y[0], lambda y: 0.0, 1.0, 1.0)
    with pytest.raises(NumericsError, match="could not be resolved"):
        piece_of(rough).stretch(np.array([0.4 + 1e-14, -1e5, 0.0]) / SCALE, math.inf, 0.1, 1e-9)


def test_a_large_constant_leaves_no_rounding_in_what_changes() -> None:
    """Of a torque that stands, no power of the time is left; of one that changes by its last digits, no more than they
    are."""
    piece = piece_of(CUBE)
    flow, _, span = piece.stretch(STATES[0] / SCALE, math.inf, 0.3, TOLERANCE)
    (one,) = (found for (_, length), found in piece._stretches.items() if length == span)
    assert one.flow is flow
    steady = one.coefficients(np.full((1, NODES.size), 3140.625))
    assert steady[0, 0] == 3140.625
    assert np.all(steady[0, 1:] == 0)
    values = 3140.625 + 2.0**-30 * NODES
    found = one.coefficients(values[None, :])
    ticks = span * one.monomials[1].max() / MONOMIALS[1].max()
    powers = (NODES[:, None] * span / ticks) ** np.arange(NODES.size) / FACTORIALS
    assert np.abs(powers @ found[0] - values).max() <= 4 * np.spacing(3140.625)
