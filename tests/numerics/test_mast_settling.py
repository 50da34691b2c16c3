"""When a swing stays in its window: closed forms, dense looks, ties, and windows that are never kept."""

import math

import numpy as np
import pytest
from scipy.linalg import expm
from support.mast_fem import Reference

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.mast.base import Base, Grip, Guide, Signal
from ptmcalc.numerics.mast.case import Case
from ptmcalc.numerics.mast.modes import Mast
from ptmcalc.numerics.mast.parts import Column, Lump, Segment
from ptmcalc.numerics.mast.run import _swing, play, ring_of, settled
from ptmcalc.numerics.mast.settling import Ring, settling

ONE = np.ones(1)


def ring(amplitude: float = 1.0, w: float = 10.0, ratio: float = 0.02) -> Ring:
    """A swing let go at rest."""
    return Ring.of(ONE, w * ONE, ratio * ONE, amplitude * ONE, 0 * ONE)


def crossing(w: float, ratio: float, window: float) -> float:
    """Last time |x| = window of a swing let go at 1, by every half swing and Newton's method in it."""
    turning, last = w * math.sqrt(1 - ratio**2), 0.0

    def x(t: float) -> float:
        return math.exp(-ratio * w * t) * (math.cos(turning * t) + ratio * w / turning * math.sin(turning * t))

    for k in range(100_000):
        top = k * math.pi / turning  # all extremes are here
        if abs(x(top)) < window:
            break
        low, high = top, (k + 1) * math.pi / turning
        sign = math.copysign(1.0, x(top))
        high = low + next(s for s in np.linspace(0, high - low, 41) if sign * x(low + s) < window)
        for _ in range(200):
            middle = (low + high) / 2
            low, high = (middle, high) if sign * x(middle) >= window else (low, middle)
        last = low
    return last


class TestOneMode:
    @pytest.mark.parametrize("window", [0.9, 0.5, 0.1, 0.01, 1e-4])
    @pytest.mark.parametrize("ratio", [0.002, 0.02, 0.3])
    def test_last_crossing(self, window: float, ratio: float) -> None:
        found = settling(ring(ratio=ratio), window)
        assert found.time == pytest.approx(crossing(10.0, ratio, window), rel=1e-9)
        assert found.high - found.low <= 1e-9 * found.time

    @pytest.mark.parametrize("ratio", [1e-7, 1e-10, 1e-13])
    def test_a_swing_that_hardly_fades_is_told_between_two_numbers(self, ratio: float) -> None:
        """By its envelope: it leaves the window within half a swing before that for the last time."""
        end = math.log(10) / (10 * ratio)
        found = settling(ring(ratio=ratio), 0.1)
        assert found.low <= end * (1 + 1e-12)
        assert found.high >= (end - math.pi / 10) * (1 - 1e-12)
        assert found.high == pytest.approx(end, rel=1e-6)

    def test_halving_that_finds_no_end_keeps_what_it_has_not_looked_at(self) -> None:
        """Hundreds of swings that all but touch the window from within."""
        many = settling(ring(ratio=1e-9), math.exp(-1e-9 * 10 * 1e6), doubt=0.0)
        assert many.low <= 1e6 <= many.high * (1 + 1e-6)

    def test_it_was_never_outside(self) -> None:
        assert settling(ring(), 1.5).time == 0.0

    def test_an_edge_that_a_summit_just_touches(self) -> None:
        """As wide as the third summit to the last digit: the time is that summit's or the half swing's before; the bar
        holds both as soon as the swing is in doubt."""
        turning = 10 * math.sqrt(1 - 0.02**2)
        window = abs(ring().at(2 * math.pi / turning))
        found = settling(ring(), window, doubt=1e-9)
        assert found.low < 1.6 * math.pi / turning
        assert found.high == pytest.approx(2 * math.pi / turning, rel=1e-3)

    def test_doubt_of_the_swing_widens_the_time(self) -> None:
        sharp, vague = settling(ring(), 0.1), settling(ring(), 0.1, doubt=0.01)
        assert vague.low <= settling(ring(), 0.11).low
        assert vague.high >= settling(ring(), 0.09).high
        assert vague.time == sharp.time


class TestNever:
    def test_without_damping(self) -> None:
        found = settling(ring(ratio=0.0), 0.1)
        assert math.isinf(found.time)
        assert "damping" in found.reason

    def test_without_damping_but_small(self) -> None:
        assert settling(ring(0.05, ratio=0.0), 0.1).time == 0.0

    def test_rest_outside_the_window(self) -> None:
        found = settling(ring(), 0.01, lean=0.02)
        assert math.isinf(found.time)
        assert "at rest already outside" in found.reason

    def test_rest_beside_the_middle_takes_longer(self) -> None:
        assert settling(ring(), 0.1, lean=0.05).time > settling(ring(), 0.1).time

    def test_a_doubt_as_wide_as_the_window(self) -> None:
        found = settling(ring(), 0.1, doubt=0.2)
        assert math.isfinite(found.time)
        assert math.isinf(found.high)

    @pytest.mark.parametrize("window", [0.0, -1.0, math.nan])
    def test_what_is_no_window(self, window: float) -> None:
        with pytest.raises(NumericsError):
            settling(ring(), window)


class TestManyModes:
    def test_against_dense_looks(self) -> None:
        """Of 60 random sums no sample after the answer lies outside, and one just before it does."""
        rng = np.random.default_rng(3)
        for _ in range(60):
            count = int(rng.integers(1, 6))
            w = np.sort(10 ** rng.uniform(0, 2, count))
            ratios = np.full(count, rng.uniform(0.003, 0.1))
            one = Ring.of(np.ones(count), w, ratios, rng.normal(size=count), rng.normal(size=count) * w)
            window = one.envelope(0.0) * 10 ** rng.uniform(-2, -0.1)
            lean = window * rng.uniform(-0.7, 0.7)
            found = settling(one, window, lean)
            assert found.high - found.low <= 1e-8 * max(found.time, 1e-3)
            times = found.time + np.linspace(1e-9 / w[0], 3 / w[0], 20_001)
            later = (one.amplitudes[:, None] * np.exp(one.rates[:, None] * times)).real.sum(axis=0) + lean
            assert np.abs(later).max() <= window * (1 + 1e-12)
            if found.time:
                just = max(found.low * (1 - 1e-7) - 1e-9, 0.0)
                assert abs(one.at(found.low) + lean) >= window * (1 - 1e-6) or abs(one.at(just) + lean) > window


def braked(ratio: float, guide: Guide | None = None) -> Case:
    column = Column((Segment(6.0, 600e3 * 72, 200.0),), (Lump(6.0, 1800.0),))
    mast = Mast.of(column, 8)
    base = Base(4000.0, 1.0, grips=(Grip("brake", Signal.constant(9000.0)),))
    return Case(mast, np.full(6, ratio), base, (6.0,), guide=guide)


class TestMast:
    @pytest.mark.parametrize("window", [4e-3, 1e-3, 1e-4])
    def test_after_a_stop_against_dense_looks_of_another_hand(self, window: float) -> None:
        """The reference goes on from its own elements: exp(A t) of the held mast, looked at 10 000 times."""
        ratio = 0.02
        course = play(braked(ratio), 1.5)
        found = settled(course, 6.0, window)
        other = Reference(4000.0, 6.0, 600e3 * 72, 1200.0, 1800.0, 8, held_ratio=ratio)
        n, inverse = other.size, np.linalg.inv(other.m)
        rate = np.block([[np.zeros((n, n)), np.eye(n)], [-inverse @ other.k, -inverse @ other.c]])
        drive = np.zeros((2 * n + 1, 2 * n + 1))
        drive[: 2 * n, : 2 * n] = rate
        drive[n : 2 * n, -1] = -9000.0 * inverse[:, 0]
        start = np.zeros(2 * n + 1)
        start[n] = start[-1] = 1.0
        start[n + 1 : 2 * n : 2] = 1.0  # every shift of a node
        low, high = 0.7, 0.9
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if (expm(drive * middle) @ start)[n] > 0 else (low, middle)
        assert course.held_since == pytest.approx(high, rel=1e-6)
        state = (expm(drive * high) @ start)[: 2 * n]
        hold = np.delete(np.delete(np.arange(2 * n), n), 0)
        inner = np.linalg.inv(other.m[1:, 1:])
        size = n - 1
        held = np.block([[np.zeros((size, size)), np.eye(size)], [-inner @ other.k[1:, 1:], -inner @ other.c[1:, 1:]]])
        swing = state[hold]
        swing[:size:2] -= state[0]
        step = 1.2 * found.time / 10_000
        turn, last = expm(held * step), 0.0
        for k in range(10_001):
            if abs(swing[other.tip - 1]) > window:
                last = k * step
            swing = turn @ swing
        assert found.low - 2 * step <= last + step
        assert last <= found.high
        assert found.time == pytest.approx(last, abs=2 * step + (found.high - found.low))

    def test_a_guide_that_is_touched_after_the_stop(self) -> None:
        """The window is kept long after the last touch, or found to be by the time the run ends."""
        case = braked(0.02, Guide(6.0, 1e6, 0.004))
        course = play(case, 6.0)
        found = settled(course, 6.0, 1e-3)
        kept = play(case, 12.0, keep=True)
        times, tips = kept.over_time("deflection")
        last = times[np.abs(tips) > 1e-3].max() - course.held_since
        assert found.low - 0.01 <= last <= found.high  # the last look outside is before the last crossing
        assert found.time == pytest.approx(last, abs=0.01)

    @pytest.mark.parametrize("window", [3e-3, 2e-3, 1e-3])
    def test_a_run_that_ends_before_it_settles_tells_both_ends(self, window: float) -> None:
        """After the last touch of the guide; the reference is where a longer run was outside for the last time."""
        case = braked(0.02, Guide(6.0, 1e6, 0.004))
        found = settled(play(case, 2.0), 6.0, window)
        assert 0 < found.high - found.low < 1e-5
        assert found.low <= found.time <= found.high
        kept = play(case, 6.5, keep=True)
        times, tips = kept.over_time("deflection")
        outside = times[np.abs(tips) > window].max() - kept.held_since
        assert found.low - 2e-3 <= outside <= found.high

    def test_a_run_that_ends_after_it_has_settled_tells_the_end_alone(self) -> None:
        course = play(braked(0.02, Guide(6.0, 1e6, 0.004)), 4.0)
        found = settled(course, 6.0, 3e-3)
        assert (found.low, found.time, found.high) == (0.0, 4.0 - course.held_since, 4.0 - course.held_since)

    def test_a_base_that_still_slips_has_not_settled(self) -> None:
        with pytest.raises(NumericsError, match="not yet held"):
            settled(play(braked(0.02), 0.2), 6.0, 1e-3)

    def test_it_is_counted_from_the_stop_whenever_one_looks(self) -> None:
        """A state 1 ms after the stop, told by a run that ends there, settles 1 ms sooner."""
        course, later = play(braked(0.02), 1.5), 1e-3
        after = play(braked(0.02), course.held_since + later)
        ring = ring_of(after.system, after.record.state, after.case.mast.at(6.0)[: after.system.count])
        for window in (4e-3, 1e-4):
            found = settling(ring, window).time + later
            assert found == pytest.approx(settled(course, 6.0, window).time, rel=1e-9)


@pytest.mark.parametrize("ratio", [0.0, 0.02, 0.6])
@pytest.mark.parametrize("place", [0, 1, 4])
def test_what_a_swing_asks_for_at_most(ratio: float, place: int) -> None:
    """Of one mode, c q or c q': the swing around its envelope from now on, and the frequency times that. The envelope
    is told by two states a quarter of a turn apart; more modes and both of them add up."""
    course = play(Case(braked(0.0).mast, np.full(6, ratio), braked(0.0).base, (6.0,)), 0.3)
    system, n = course.system, course.system.count
    w = float(system.w[place])
    quarter = math.pi / 2 / (w * math.sqrt(1 - ratio**2))
    turn = expm(np.array([[0.0, 1.0], [-(w**2), -2 * ratio * w]]) * quarter)
    z = course.record.state.copy()
    z[2 + place], z[2 + n + place] = 3.0, 0.7 * w
    later = float((turn @ [3.0, 0.7 * w])[0]) * math.exp(ratio * w * quarter)
    size = math.hypot(3.0, later)
    shift, speed = np.zeros((2, len(z)))
    shift[2 + place], speed[2 + n + place] = -5.0, 2.0
    assert _swing(system, z, shift) == pytest.approx(5 * size, rel=1e-12)
    assert _swing(system, z, speed) == pytest.approx(2 * w * size, rel=1e-12)
    other = (place + 1) % n
    shift[2 + other] = 1.0
    more = _swing(system, z, shift) - 5 * size
    assert _swing(system, z, shift + speed) == pytest.approx((5 + 2 * w) * size + more, rel=1e-12)
    assert more > 0
