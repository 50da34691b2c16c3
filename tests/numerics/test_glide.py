"""Long panels over fast components: nothing is lost of events, summits and works, however fast they are.

Reference methods are sums of damped sines evaluated as such, and runs that resolve every period.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.modes import Modes, Part, turning

from ptmcalc.numerics import piecewise
from ptmcalc.numerics.flow import RESOLVED, Flow
from ptmcalc.numerics.glide import Bands, Glide
from ptmcalc.numerics.piecewise import march
from ptmcalc.numerics.record import Record

SLOW, FAST = 1.0, 0.3
"""Amplitudes of the slow swing and of the fast one that is put onto it."""


def two_swings(fast: float, damping: float, *guards: tuple[np.ndarray, str]) -> Modes:
    """x'' = -x beside y'' = -w^2 y - 2 d w y': state (x, x', y, y'/w, 1); watched: x + y, and y'/w, the rate of y."""
    quick = np.array([[0.0, fast], [-fast, -2 * damping * fast]])
    rate = np.zeros((5, 5))
    rate[:4, :4] = np.block([[turning(1.0), np.zeros((2, 2))], [np.zeros((2, 2)), quick]])
    parts = {"swing": Part(rate, guards)} | ({"stopped": Part(np.zeros((5, 5)))} if guards else {})
    watch = np.array([[1.0, 0, 1, 0, 0], [0, 0, 0, 1, 0]])
    return Modes(parts, watch, 4, products=((0, 0), (1, 1)), ends="stopped", sizes=(1.0,) * 5)


def sum_at(times: np.ndarray, fast: float, damping: float) -> np.ndarray:
    """x + y from x = 1, y = FAST at rest."""
    turn = math.sqrt(1 - damping**2)
    quick = np.exp(-damping * fast * times) * (
        np.cos(turn * fast * times) + damping / turn * np.sin(turn * fast * times)
    )
    return SLOW * np.cos(times) + FAST * quick


START = np.array([SLOW, 0.0, FAST, 0.0, 1.0])


def whole(system: Modes, start: np.ndarray, end: float, monkeypatch: pytest.MonkeyPatch) -> Record:
    """The same run with every period resolved."""
    with monkeypatch.context() as patch:
        patch.setattr(piecewise, "_GLIDES", math.inf)
        return march(system, "swing", start, end)


class TestSums:
    @pytest.mark.parametrize("damping", [0.0, 1e-4, 0.02, 0.3])
    @pytest.mark.parametrize("fast", [300.0, 1e4])
    def test_extremes_are_those_of_the_closed_form(self, fast: float, damping: float) -> None:
        """The top is at the start; the bottom, near half a slow period, is found by every period of the closed form."""
        found = march(two_swings(fast, damping), "swing", START, 10.0)
        times = np.linspace(0, 10, 4_000_001) if fast < 1e3 else math.pi + np.linspace(-0.1, 0.1, 4_000_001)
        if damping and fast > 1e3:
            times = np.concatenate([times, 3 * math.pi + np.linspace(-0.1, 0.1, 1_000_001)])
        values = sum_at(times, fast, damping)
        assert found.top.values[0] == pytest.approx(SLOW + FAST, rel=1e-11)
        assert found.bottom.values[0] == pytest.approx(values.min(), rel=2e-7)  # between samples
        assert found.bottom.values[0] <= values.min() + 1e-11
        assert sum_at(np.array([found.bottom.at[0]]), fast, damping)[0] == pytest.approx(
            found.bottom.values[0], abs=1e-11
        )

    @pytest.mark.parametrize("damping", [0.0, 0.02])
    def test_works_are_those_of_the_closed_form(self, damping: float) -> None:
        """int (y'/w)^2 dt of a damped swing is what its energy lost: (y^2 + y'^2/w^2)/2 = 2 d w int (y'/w)^2."""
        fast = 1e5
        found = march(two_swings(fast, damping), "swing", START, 10.0)
        left = found.state[2] ** 2 + found.state[3] ** 2
        if damping:
            assert found.integrals[1] == pytest.approx((FAST**2 - left) / (4 * damping * fast), rel=1e-11)
        else:
            swept = 10.0 / 2 - math.sin(2 * fast * 10.0) / (4 * fast)
            assert found.integrals[1] == pytest.approx(FAST**2 * swept, rel=1e-9)
        assert found.last[0] == pytest.approx(sum_at(np.array([10.0]), fast, damping)[0], abs=1e-8)

    @pytest.mark.parametrize("seed", range(12))
    def test_runs_that_resolve_every_period_find_the_same(self, seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
        random = np.random.default_rng(seed)
        fast, damping = 10 ** random.uniform(2.5, 3.5), random.choice([0.0, 1e-3, 0.02, 0.2])
        start = np.array([*random.normal(size=2), *(10 ** random.uniform(-9, 0) * random.normal(size=2)), 1.0])
        system = two_swings(fast, damping)
        long, short = march(system, "swing", start, 20.0), whole(system, start, 20.0, monkeypatch)
        assert long.top.values == pytest.approx(short.top.values, rel=1e-10)
        assert long.bottom.values == pytest.approx(short.bottom.values, rel=1e-10)
        assert long.integrals == pytest.approx(short.integrals, rel=1e-10)
        assert long.steps < max(short.steps / 4, 600)


class TestEvents:
    @pytest.mark.parametrize("level", [-1.0, -1.2, -1.25, -1.2999])
    def test_a_guard_inside_the_envelope_is_crossed_when_it_is(
        self, level: float, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        """x + y > level: crossed by the fast swing alone, near where the slow one is lowest."""
        guard = np.array([1.0, 0.0, 1.0, 0.0, -level])
        system = two_swings(2000.0, 0.0, (guard, "stopped"))
        long, short = march(system, "swing", START, 10.0), whole(system, START, 10.0, monkeypatch)
        assert [event.time for event in long.events] == pytest.approx([event.time for event in short.events], abs=1e-11)
        assert len(long.events) == 1
        times = np.linspace(0, long.events[0].time, 1_000_001)[:-1]
        assert sum_at(times, 2000.0, 0.0).min() >= level - 1e-9
        assert sum_at(np.array([long.events[0].time]), 2000.0, 0.0)[0] == pytest.approx(level, abs=1e-10)

    def test_a_guard_out_of_reach_is_not_crossed(self) -> None:
        guard = np.array([1.0, 0.0, 1.0, 0.0, 1.301])
        found = march(two_swings(1e6, 0.0, (guard, "stopped")), "swing", START, 10.0)
        assert not found.events
        assert found.steps < 3000


class TestCost:
    def test_it_does_not_depend_on_how_fast_it_rings(self) -> None:
        """With damping: the ring fades within some radians, however few seconds those are."""
        steps = [march(two_swings(fast, 0.02), "swing", START, 10.0).steps for fast in (1e4, 1e6, 1e8, 1e10)]
        assert max(steps) <= 600

    def test_a_swing_without_damping_is_passed_over_too(self) -> None:
        """Its envelope never fades; the guard keeps away from it, the summit is where both have theirs."""
        guard = np.array([1.0, 0.0, 1.0, 0.0, 2.0])
        found = march(two_swings(1e7, 0.0, (guard, "stopped")), "swing", START, 30.0)
        assert found.steps <= 1500
        assert found.bottom.values[0] == pytest.approx(-SLOW - FAST, rel=3e8 * 2.3e-16)  # rounding of every radian

    @pytest.mark.parametrize("size", [1e-5, 1.0, 1e5])
    def test_a_curve_over_time_shows_what_rings(self, size: float) -> None:
        start, scale = START * [size, size, size, size, 1.0], (size, size, size, size, 1.0)
        system = replace(two_swings(500.0, 0.0), sizes=scale)
        found = march(system, "swing", start, 10.0, keep=True)
        assert found.samples is not None
        times = np.concatenate(found.samples.times)
        assert np.diff(times).max() <= 0.8 / 500.0  # not one of its radians is left out
        seen_faintly = replace(system, watch=system.watch[:1], products=())
        faint = march(seen_faintly, "swing", np.array([size, 0, 1e-6 * size, 0, 1.0]), 10.0, keep=True)
        assert faint.steps < found.steps / 4


class TestLongestPanel:
    """What is resolved is the radians that a component turns by in a panel; one part in 1e9 is rounding of them."""

    PANEL = 0.25

    def bands(self, own: int, share: float, refined: float = 1.0) -> Bands | None:
        """A slow and a fast swing, the fast one turning by a share of what is resolved; own or an input."""
        fast = share * RESOLVED * refined / self.PANEL
        rate = np.block([[turning(1e-3), np.zeros((2, 2))], [np.zeros((2, 2)), turning(fast)]])
        watch = np.array([[1.0, 0.0, 1.0, 0.0]])
        flow = Flow(rate, np.zeros((0, 4)), watch, own, 0.0 if own == 4 else fast, resolved=RESOLVED * refined)
        return Glide(flow).bands(self.PANEL, np.array([[1.0, 0.0, 0.3, 0.0]]))

    @pytest.mark.parametrize("refined", [1.0, 0.5])
    def test_resolves_every_input(self, refined: float) -> None:
        assert self.bands(2, 1 + 1e-8, refined) is None
        assert self.bands(2, 1 + 1e-10, refined) is not None
        assert self.bands(2, 1.6, refined) is None

    @pytest.mark.parametrize("refined", [1.0, 0.5])
    def test_what_it_does_not_resolve_is_an_envelope(self, refined: float) -> None:
        """All of the fast swing, 0.3, and nothing where it is resolved."""
        for share, envelope in ((1 + 1e-8, 0.3), (1.6, 0.3), (1 + 1e-10, 0.0), (0.5, 0.0)):
            bands = self.bands(4, share, refined)
            assert bands is not None
            assert bands.envelope[0, 0] == pytest.approx(envelope, rel=1e-9)
