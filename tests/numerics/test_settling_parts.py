"""Settling: the time the envelopes fit, how far a stretch reaches, and both ends of the answer."""

import math
from fractions import Fraction

import numpy as np
import pytest
from scipy.optimize import brentq

from ptmcalc.numerics.mast import settling as module
from ptmcalc.numerics.mast.settling import Ring, settling


def ring(seed: int, count: int = 3) -> Ring:
    rng = np.random.default_rng(seed)
    rates = -(10 ** rng.uniform(-2, 0, count)) + 1j * 10 ** rng.uniform(-0.5, 1.5, count)
    return Ring(rng.normal(size=count) + 1j * rng.normal(size=count), rates)


@pytest.mark.parametrize("seed", range(6))
class TestParts:
    def test_a_ring_of_modes_is_their_free_motion(self, seed: int) -> None:
        """q'' + 2 z w q' + w^2 q = 0: value and slope at the start, and the equation later on."""
        rng = np.random.default_rng(seed)
        w, z, gains, q, v = rng.uniform(1, 9, 2), rng.uniform(0, 0.9, 2), *rng.normal(size=(3, 2))
        for k in range(2):
            one = Ring.of(gains[k : k + 1], w[k : k + 1], z[k : k + 1], q[k : k + 1], v[k : k + 1])
            h = 1e-4
            assert one.at(0.0) == pytest.approx(gains[k] * q[k], rel=1e-13)
            assert (one.at(h) - one.at(-h)) / 2 / h == pytest.approx(gains[k] * v[k], abs=1e-5 * 100)
            before, here, after = (one.at(0.7 + d) for d in (-h, 0.0, h))
            bend, slope = (after - 2 * here + before) / h**2, (after - before) / 2 / h
            assert bend + 2 * z[k] * w[k] * slope + w[k] ** 2 * here == pytest.approx(0.0, abs=1e-4)
        both = Ring.of(gains, w, z, q, v)
        parts = [Ring.of(gains[k : k + 1], w[k : k + 1], z[k : k + 1], q[k : k + 1], v[k : k + 1]) for k in range(2)]
        assert both.at(0.4) == pytest.approx(sum(one.at(0.4) for one in parts), rel=1e-12)
        assert both.envelope(0.4) == pytest.approx(sum(one.envelope(0.4) for one in parts), rel=1e-12)
        slope = (both.at(1e-6) - both.at(-1e-6)) / 2e-6
        assert slope == pytest.approx(float(gains @ v), rel=1e-6, abs=1e-6)

    def test_the_time_the_envelopes_fit(self, seed: int) -> None:
        one = ring(seed)
        for share in (0.5, 0.05, 1e-6):
            room = share * one.envelope(0.0)
            found = module._inside(one, room)
            assert found is not None
            assert found == pytest.approx(brentq(lambda t, room=room: one.envelope(t) - room, 0, 1e5), rel=1e-9)
            assert one.envelope(found) < room
            for pace in (2.0**40, 2.0**-40):
                assert module._inside(Ring(one.amplitudes, one.rates * pace), room) == found / pace
        assert module._inside(one, 1.01 * one.envelope(0.0)) == 0.0
        lasting = Ring(np.append(one.amplitudes, 0.3), np.append(one.rates, 4j))
        assert module._inside(lasting, 0.299) is None
        assert module._inside(lasting, 0.301) is not None

    def test_a_stretch_reaches_no_further_and_not_much_less(self, seed: int) -> None:
        """Slow parts by tangent and curvature, fast ones by what they are: one of them alone is told by hand."""
        one = ring(seed)
        for begins, ends in ((0.0, 0.01), (0.3, 0.5), (1.0, 4.0)):
            middle, half = (begins + ends) / 2, (ends - begins) / 2
            value, reach = module._reach(one, begins, ends, middle)
            course = np.array([one.at(t) for t in np.linspace(begins, ends, 401)])
            assert value == pytest.approx(one.at(middle), rel=1e-13, abs=1e-14)
            assert np.abs(course - value).max() <= reach * (1 + 1e-12)
            expected = slope = curved = 0.0
            for c, rate in zip(one.amplitudes, one.rates, strict=True):
                size, part = abs(c) * math.exp(rate.real * begins), c * np.exp(rate * middle)
                if abs(rate) * half <= 1.0:
                    slope += (part * rate).real
                    curved += size * abs(rate) ** 2 * half**2 / 2
                else:
                    expected += min(size * abs(rate) * half, size + abs(part.real))
            assert reach == pytest.approx(expected + abs(slope) * half + curved, rel=1e-12)

    @pytest.mark.parametrize("lean", [0.0, 0.2, -0.2])
    def test_the_last_time_outside(self, seed: int, lean: float) -> None:
        one = ring(seed)
        window = 0.3 * one.envelope(0.0) + abs(lean)
        found = settling(one, window, lean)
        times = np.linspace(0, max(2 * found.time, 1.0), 40_001)
        parts = one.amplitudes[:, None] * np.exp(one.rates[:, None] * times)
        outside = times[np.abs(parts.real.sum(axis=0) + lean) >= window]
        last = float(outside[-1]) if len(outside) else 0.0
        assert found.low - 1e-9 <= found.time <= found.high
        assert last <= found.high + 1e-12
        assert found.low <= last + 2 * float(times[1])
        assert found.high - found.low <= 1e-9 * max(found.time, 1e-3)
        if last > 0:
            assert abs(abs(one.at(found.time) + lean) - window) <= 1e-7 * window


def test_what_never_leaves_has_settled_at_once_and_told_so() -> None:
    for size in (0.5, 0.99):
        found = settling(Ring(np.array([size + 0j]), np.array([-0.1 + 3j])), 1.0)
        assert (found.time, found.low, found.high) == (0.0, 0.0, 0.0)
    quiet = settling(Ring(np.array([1.05j]), np.array([-0.4 + 3j])), 1.0)  # its envelope does not fit, it does
    assert (quiet.time, quiet.low, quiet.high) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("amplitudes", "damped", "low"),
    [
        ((0.4,), (), math.inf),  # its own peak again and again
        ((0.4,), (0.3, 0.2), math.inf),
        ((0.4, 0.0), (), math.inf),
        ((0.3, 0.2), (), 0.0),  # two peaks may never meet
        ((0.3, 0.2), (0.3,), 0.0),
    ],
)
def test_without_damping_it_never_settles_and_one_mode_surely(
    amplitudes: tuple[float, ...], damped: tuple[float, ...], low: float
) -> None:
    sizes = np.array([*amplitudes, *damped], complex)
    rates = np.array([3j * (k + 1) for k in range(len(amplitudes))] + [-0.5 + 7j] * len(damped))
    found = settling(Ring(sizes, rates), 0.35)
    assert (found.time, found.low, found.high) == (math.inf, low, math.inf)
    assert "damping" in found.reason


def test_a_doubt_as_wide_as_what_the_lean_leaves_is_no_answer_from_above() -> None:
    one = Ring(np.array([1.0 + 0j]), np.array([-0.4 + 3j]))
    for lean, doubt in ((0.0, 0.3), (0.1, 0.2), (0.1, 0.25), (-0.25, 0.06)):
        found = settling(one, 0.3, lean, doubt)
        assert math.isfinite(found.time)
        assert found.low <= found.time
        assert math.isinf(found.high)


@pytest.mark.parametrize("ratio", [0.02, 1e-5, 1e-10, 1e-15])
def test_no_unit_of_time_or_length_changes_what_is_told(ratio: float) -> None:
    """Frequencies and sizes times powers of 2, so that rounding is the same: of swings that hardly fade too."""
    rates, sizes = np.array([-ratio + 1j, -3 * ratio + 2.7j]), np.array([1.0 + 0.2j, 0.3j])
    one = settling(Ring(sizes, rates), 0.1, 0.02, 1e-3)
    assert (one.low > 0) == (ratio > 1e-15), "in the end no swing is told from the next"
    for pace, size in ((2.0**60, 1.0), (2.0**-60, 2.0**10), (1.0, 2.0**-22), (1.0, 2.0**30)):
        other = settling(Ring(sizes * size, rates * pace), 0.1 * size, 0.02 * size, 1e-3 * size)
        assert (other.time * pace, other.low * pace, other.high * pace) == (one.time, one.low, one.high)


PI = Fraction(314159265358979323846264338327950288419716939937510, 10**50)


def exactly(amplitudes: list[float], rates: list[complex], time: float) -> float:
    """A sum of damped cosines, its phases to 1e-16 however many radians they are."""
    total = 0.0
    for size, rate in zip(amplitudes, rates, strict=True):
        phase = float(Fraction(rate.imag) * Fraction(time) % (2 * PI))
        total += size * math.exp(rate.real * time) * math.cos(phase)
    return total


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("side", [-1, 1])
def test_a_summit_that_all_but_touches_is_in_doubt_by_the_rounding_of_its_phase(
    seed: int, size: float, side: int
) -> None:
    """After 1e7 radians of two swings a phase is off by 1e-9; a summit nearer to the edge than that may be outside or
    not. Whether it is, is told by its phase in exact numbers."""
    rng = np.random.default_rng(seed)
    w = rng.uniform(1, 9, 2)
    amplitudes, rates = (size * np.array([1.0, 0.7])).tolist(), (-1e-7 * w + 1j * w).tolist()
    one = Ring(np.array(amplitudes, complex), np.array(rates))
    about = settling(one, 0.6 * size).time
    times = np.linspace(about, about + 3.0, 3001)
    near = float(times[np.argmax([abs(exactly(amplitudes, rates, t)) for t in times])])
    step = 1e-3
    for _ in range(60):  # up to the summit
        best = max((near - step, near, near + step), key=lambda t: abs(exactly(amplitudes, rates, t)))
        near, step = best, step / 2
    window = abs(exactly(amplitudes, rates, near)) + side * 1e-10 * size
    found = settling(one, window)
    later = settling(one, window - 1e-8 * size)
    assert found.low <= near * (1 + 1e-12)
    assert later.high >= near
    if side < 0:
        assert found.high >= near * (1 - 1e-12)


def test_at_rest_on_the_edge_is_told_from_outside() -> None:
    one = Ring(np.array([0.01 + 0j]), np.array([-0.4 + 3j]))
    for lean, word in (
        (0.3, "on the edge"),
        (-0.3, "on the edge"),
        (0.31, "already outside"),
        (-0.31, "already outside"),
    ):
        found = settling(one, 0.3, lean)
        assert found.low == math.inf
        assert word in found.reason
    assert settling(one, 0.3, 0.25).reason == ""


@pytest.mark.parametrize("rate", [-0.9 + 0.4j, -0.1 + 3j, -0.5 + 0.1j])
def test_no_stretch_is_looked_at_below_a_share_of_the_whole_time(
    rate: complex, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Halving ends at 1e-13 of the time from which on the envelope fits, ln(A/window)/sigma."""
    looks = []
    reach = module._reach

    def counted(one: Ring, begins: float, ends: float, middle: float) -> tuple[float, float]:
        looks.append(ends - begins)
        return reach(one, begins, ends, middle)

    monkeypatch.setattr(module, "_reach", counted)
    found = settling(Ring(np.array([1.0 + 0j]), np.array([rate])), 0.4)
    assert found.low < found.time == found.high
    assert 0.49e-13 <= min(looks) / (math.log(0.4) / rate.real) <= 1e-13
    assert len(looks) < 80


@pytest.mark.parametrize(("ratio", "sharp"), [(1e-6, True), (3e-7, True), (1e-7, False), (1e-9, False)])
def test_a_swing_is_told_from_the_next_as_long_as_rounding_allows(ratio: float, sharp: bool) -> None:
    """Rounding of the phase, 5e-16 ln(10)/ratio of the swing, against the 2 pi ratio that it fades by in one period;
    what is no longer told lies up to where the envelope fits."""
    found = settling(Ring(np.array([1.0 + 0j]), np.array([-ratio + 1j])), 0.1)
    fits = math.log(10) / ratio
    assert fits - 2 * math.pi <= found.high <= fits * (1 + 1e-14)
    if sharp:
        assert found.high - found.low < 0.1
    else:
        assert 2 * math.pi < found.high - found.low < fits * min(1e-13 / ratio**2, 1.0)
