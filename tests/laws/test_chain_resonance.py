"""Modes of a chain on its sprocket against finite elements; bands and windows against their definition."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import eigh
from support import chain_fem

from ptmcalc.laws import belt_modes, chain_resonance, chain_start, loop_bounds
from ptmcalc.laws.loop_bounds import CARRY, RETURN, LoopMasses

steady = settings(derandomize=True, database=None, deadline=None, max_examples=80)
EA, L = 3.2e8, 40.0
LOOP = LoopMasses(80 * L, 200 * L, 900.0, 1.0, L / EA, 1.3 * L / EA, fixed_length=False, imposed_speed=True)


def elements(loop: LoopMasses, pieces: int) -> tuple[np.ndarray, ...]:
    """Frequencies and masses at run-on and run-off of the modes of a mesh with the sprocket held."""
    strands = (
        chain_fem.Strand(1.0, loop.carry_mass, 1 / loop.carry_compliance),
        chain_fem.Strand(1.0, loop.return_mass, 1 / loop.return_compliance),
    )
    mass, stiff = chain_fem.matrices(chain_fem.Chain(strands, loop.tail_mass), pieces, lumped=True)
    held = slice(1, -1) if loop.fixed_length else slice(1, None)
    squares, shapes = eigh(stiff[held, held], mass[held, held])
    share = shapes.T @ np.diag(mass)[held]
    on = -(stiff[0, held] @ shapes) * share / squares
    off = stiff[-1, held] @ shapes * share / squares if loop.fixed_length else np.zeros(len(squares))
    return np.sqrt(squares), on, off


class TestModalMasses:
    @pytest.mark.parametrize("fixed", [False, True])
    @pytest.mark.parametrize("tail", [0.0, 900.0, 3e4])
    def test_are_those_of_finite_elements(self, fixed: bool, tail: float) -> None:
        loop = replace(LOOP, fixed_length=fixed, tail_mass=tail)
        w = belt_modes.natural_frequencies(loop, 0.0, 6)
        found = chain_resonance.modal_masses(loop, w)
        coarse, fine = (elements(loop, pieces) for pieces in (150, 300))
        for k in (0, 1):
            expected = (4 * fine[k + 1][:6] - coarse[k + 1][:6]) / 3
            assert found[k] == pytest.approx(expected, rel=1e-4, abs=1e-4 * loop.belt_mass)

    @pytest.mark.parametrize("fixed", [False, True])
    def test_sum_up_to_the_quasi_static_tensions(self, fixed: bool) -> None:
        loop = replace(LOOP, fixed_length=fixed)
        on, off = chain_resonance.modal_masses(loop, belt_modes.natural_frequencies(loop, 0.0, 2000))
        rest = 2e-3 * loop.belt_mass
        assert on.sum() == pytest.approx(float(loop_bounds.quasi_static(loop, CARRY, 1.0)), abs=rest)
        assert off.sum() == pytest.approx(float(loop_bounds.quasi_static(loop, RETURN, 0.0)), abs=rest)
        assert np.all(on - off > -1e-9 * loop.belt_mass)

    def test_of_a_uniform_strand(self) -> None:
        loop = LoopMasses(500.0, 500.0, 0.0, 1.0, 1e-7, 1e-7, fixed_length=False, imposed_speed=True)
        w = belt_modes.natural_frequencies(loop, 0.0, 5)
        on, _ = chain_resonance.modal_masses(loop, w)
        odd = 2 * np.arange(1, 6) - 1
        assert w == pytest.approx(odd * math.pi / 2 / math.sqrt(1e3 * 2e-7), rel=1e-12)
        assert on == pytest.approx(8e3 / (math.pi * odd) ** 2, rel=1e-10)


def drive_and_elements(loop: LoopMasses, pieces: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Mass and stiffness with the drive at the rim, and rows that give the tensions at run-on and run-off."""
    strands = (
        chain_fem.Strand(1.0, loop.carry_mass, 1 / loop.carry_compliance),
        chain_fem.Strand(1.0, loop.return_mass, 1 / loop.return_compliance),
    )
    mass, stiff = chain_fem.matrices(chain_fem.Chain(strands, loop.tail_mass), pieces, lumped=True)
    tensions = np.zeros((2, len(mass)))
    tensions[0, :2] = stiff[0, 1] * np.array([-1, 1])
    tensions[1, -2:] = stiff[-1, -2] * np.array([-1, 1])
    mass[0, 0] += loop.drive_mass
    if loop.fixed_length:
        join = np.eye(len(mass), len(mass) - 1)
        join[-1, 0] = 1.0
        mass, stiff, tensions = join.T @ mass @ join, join.T @ stiff @ join, tensions @ join
    return mass, stiff, tensions[0], tensions[1]


class TestStartShares:
    @pytest.mark.parametrize("fixed", [False, True])
    @pytest.mark.parametrize("drive", [2e3, 5e4])
    @pytest.mark.parametrize("tail", [0.0, 3e4])
    def test_are_those_of_finite_elements(self, fixed: bool, drive: float, tail: float) -> None:
        loop = replace(LOOP, fixed_length=fixed, imposed_speed=False, drive_mass=drive, tail_mass=tail)
        w = belt_modes.natural_frequencies(loop, 0.0, 5)
        found = chain_resonance.start_shares(loop, w)
        meshes = []
        for pieces in (150, 300):
            mass, stiff, on, off = drive_and_elements(loop, pieces)
            squares, shapes = eigh(stiff, mass, subset_by_index=[1, 5])
            meshes.append([shapes[0] * (row @ shapes) / squares for row in (on, off)])
        for k in (0, 1):
            expected = 2 * meshes[1][k] - meshes[0][k]  # the tension of an element stands in its middle
            assert found[k] == pytest.approx(expected if k == 0 or fixed else 0.0, rel=3e-4, abs=3e-4)

    @pytest.mark.parametrize("fixed", [False, True])
    def test_sum_up_to_the_quasi_static_tensions(self, fixed: bool) -> None:
        loop = replace(LOOP, fixed_length=fixed, imposed_speed=False, drive_mass=9e3)
        on, off = chain_resonance.start_shares(loop, belt_modes.natural_frequencies(loop, 0.0, 2000))
        assert on.sum() == pytest.approx(float(loop_bounds.quasi_static(loop, CARRY, 1.0)) / loop.total_mass, abs=1e-3)
        assert off.sum() == pytest.approx(
            float(loop_bounds.quasi_static(loop, RETURN, 0.0)) / loop.total_mass, abs=1e-3
        )
        assert np.all(on - off >= -1e-12)


class TestStartSeries:
    def test_of_worked_belt(self) -> None:
        """Peak of the damped step of acceleration of a uniform loop at 2.4 % in the first mode: 1.8057 rho L a."""
        zeta, w1 = 0.024, 1.0
        odd = 2 * np.arange(1.0, 4001.0) - 1
        amplitudes, w = 8 / (math.pi * odd) ** 2, odd * w1
        t = np.linspace(0.9 * math.pi, 1.3 * math.pi, 401)
        peak = max(float(chain_start.start_series(amplitudes, w, zeta * odd, at)) for at in t)
        assert peak == pytest.approx(1.8057, abs=2e-3)

    @pytest.mark.parametrize("mu", [0.3, 1.0, 4.0])
    def test_of_a_torque_step_is_the_wave_and_its_first_echo(self, mu: float) -> None:
        """m v' + Z v = F - echo of a uniform loop: 1 - e^-t, then - 2 x e^-x more, in units of F and m/Z."""
        drive = 1e3
        loop = LoopMasses(
            mu * drive / 2, mu * drive / 2, 0.0, drive, 1e-6, 1e-6, fixed_length=False, imposed_speed=False
        )
        tau = drive / math.sqrt(mu * drive / 2e-6)  # m/Z
        echo = 2 * math.sqrt(mu * drive * 2e-6) / tau
        w = belt_modes.natural_frequencies(loop, 0.0, 1500)
        shares, _ = chain_resonance.start_shares(loop, w)
        t = np.array([0.1, 0.5, 0.9, 1.2, 1.7]) * echo
        x = np.maximum(t - echo, 0.0)
        expected = -np.expm1(-t) - 2 * x * np.exp(-x)
        found = chain_start.start_series(shares, w, np.zeros_like(w), t * tau)
        left_out = chain_start.start_series_tail(shares, mu / (1 + mu))
        assert np.max(np.abs(found - expected)) <= left_out + 1e-12
        assert left_out < 2e-3

    @pytest.mark.parametrize("retardation", [0.0, 2e-3, 0.2])
    def test_is_the_motion_of_finite_elements(self, retardation: float) -> None:
        """M y'' + C y' + K y = -M a, from rest, by the exponential of its first-order form."""
        from scipy.linalg import expm

        pieces, a = 40, 0.3
        chain = chain_fem.Chain((chain_fem.Strand(30.0, 150.0, 2e8),))
        mass, stiff = chain_fem.matrices(chain, pieces, lumped=True)
        m, k = np.diag(mass)[1:], stiff[1:, 1:]
        n = len(m)
        rate = np.zeros((2 * n + 1, 2 * n + 1))
        rate[:n, n : 2 * n] = np.eye(n)
        rate[n : 2 * n, :n], rate[n : 2 * n, n : 2 * n] = -k / m[:, None], -retardation * k / m[:, None]
        rate[n : 2 * n, -1] = -a
        w, effective, _ = chain_fem.modes(chain, pieces)
        for t in (0.003, 0.02, 0.11):
            state = expm(rate * t)[:, -1]
            force = -(k @ (state[:n] + retardation * state[n : 2 * n])).sum()
            found = chain_start.start_series(effective * a, w, retardation * w / 2, t)
            assert float(found) == pytest.approx(force, rel=1e-8)

    def test_the_tail_is_a_bound(self) -> None:
        odd = 2 * np.arange(1.0, 2001.0) - 1
        amplitudes, w = 0.3 * 8 / (math.pi * odd) ** 2, odd
        t = np.linspace(0.0, 12.0, 300)
        whole = chain_start.start_series(amplitudes, w, np.zeros_like(w), t)
        for count in (1, 3, 20):
            part = chain_start.start_series(amplitudes[:count], w[:count], np.zeros(count), t)
            bound = chain_start.start_series_tail(amplitudes[:count], 0.3)
            assert np.max(np.abs(whole - part)) <= bound

    def test_critical_damping_is_no_gap(self) -> None:
        t = np.linspace(0.0, 5.0, 7)
        found = [chain_start.start_series(np.ones(1), np.ones(1), np.array([z]), t) for z in (1 - 1e-9, 1, 1 + 1e-9)]
        assert found[0] == pytest.approx(found[1], abs=1e-8)
        assert found[2] == pytest.approx(found[1], abs=1e-8)
        assert found[1] == pytest.approx(1 - np.exp(-t) * (1 - t), rel=1e-14)  # h' of t exp(-t)


class TestBandsAndWindows:
    @given(st.lists(st.tuples(st.floats(0.1, 5.0), st.floats(0.01, 0.4)), max_size=8), st.floats(0.05, 6.0))
    @steady
    def test_a_speed_is_in_a_window_or_in_a_band(self, resonances: list[tuple[float, float]], speed: float) -> None:
        values, widths = np.array([r[0] for r in resonances]), np.array([r[1] for r in resonances])
        bands = chain_resonance.exclusion_bands(values, widths)
        assert np.all(bands[1:, 0] > bands[:-1, 1])
        near = bool(np.any((values * (1 - widths) < speed) & (speed < values * (1 + widths))))
        assert near == bool(np.any((bands[:, 0] < speed) & (speed < bands[:, 1])))
        below, above = chain_resonance.nearest_safe_speeds(speed, bands)
        assert (below == speed == above) == (not near)
        windows = chain_resonance.safe_windows(bands, 0.05, 6.0)
        inside = bool(np.any((windows[:, 0] <= speed) & (speed <= windows[:, 1])))
        on_an_end = speed in bands
        assert inside == (not near) or on_an_end
        for candidate in (below, above):
            assert not np.any((bands[:, 0] < candidate) & (candidate < bands[:, 1]))

    def test_touching_bands_are_one(self) -> None:
        bands = chain_resonance.exclusion_bands(np.array([2.0, 1.0, 1.25]), np.array([0.1, 0.1, 0.2]))
        assert bands == pytest.approx(np.array([[0.9, 1.5], [1.8, 2.2]]))
        assert chain_resonance.safe_windows(bands, 1.0, 2.0) == pytest.approx(np.array([[1.5, 1.8]]))
        assert chain_resonance.safe_windows(bands, 1.1, 1.2).shape == (0, 2)
        assert chain_resonance.nearest_safe_speeds(1.3, bands) == pytest.approx((0.9, 1.5))

    def test_without_a_resonance_the_whole_range_is_safe(self) -> None:
        bands = chain_resonance.exclusion_bands(np.zeros(0), np.zeros(0))
        assert bands.shape == (0, 2)
        assert chain_resonance.safe_windows(bands, 0.0, 2.0).tolist() == [[0.0, 2.0]]

    def test_a_band_from_rest(self) -> None:
        bands = chain_resonance.exclusion_bands(np.array([1.0]), np.array([1.4]))
        assert chain_resonance.nearest_safe_speeds(0.3, bands) == pytest.approx((0.0, 2.4))

    def test_weights(self) -> None:
        found = chain_resonance.resonance_weights(np.array([1.0, 2.0]), np.array([0.05, 0.0]), np.array([0.81, -0.1]))
        assert found[:, 0] == pytest.approx([2 / math.pi * 8.1, 8.1 / math.pi])
        assert np.all(np.isinf(found[:, 1]))
        assert chain_resonance.resonance_weights(np.ones(1), np.zeros(1), np.zeros(1)) == 0.0, "a mode nothing excites"
        assert chain_resonance.exclusion_half_widths(np.array([0.05, 0.2]), 0.15) == pytest.approx([0.15, 0.4])


class TestTransverse:
    @pytest.mark.parametrize("speed", [0.0, 9.0, 20.0])
    def test_is_the_period_of_a_moving_string(self, speed: float) -> None:
        """A wave goes down the span with c + V and comes back with c - V; k periods of the k-th mode last that long."""
        span, tension, line_mass = 0.9, 4e3, 3.8
        c = math.sqrt(tension / line_mass)
        round_trip = span / (c + speed) + span / (c - speed)
        for k in (1, 2, 5):
            found = float(chain_resonance.transverse_frequencies(span, tension, line_mass, speed, k))
            assert found * round_trip == pytest.approx(2 * math.pi * k, rel=1e-12)

    def test_vanishes_with_the_stiffness(self) -> None:
        assert float(chain_resonance.transverse_frequencies(0.9, 4e3, 3.8, 33.0, 1)) == 0.0


class TestTextbookFactor:
    def test_factor_speed_and_modulus_fit(self) -> None:
        modulus, line_mass, section, pitch, length, g = 1.1e11, 150.0, 9e-4, 0.25, 30.0, 9.81
        c = math.sqrt(modulus * section / line_mass)
        for wave, part in (("quarter", 4), ("half", 2), ("full", 1)):
            factor = chain_resonance.textbook_resonance_factor(modulus, g, wave)
            speed = chain_resonance.textbook_resonance_speed(factor, pitch, length, section, line_mass * g)
            assert speed == pytest.approx(pitch * c / (part * length), rel=1e-13)
            assert chain_resonance.textbook_resonance_modulus(factor, g, wave) == pytest.approx(modulus, rel=1e-13)

    def test_speeds(self) -> None:
        found = chain_resonance.resonance_speeds(np.array([10.0, 30.0]), np.array([1.0, 2.0, 3.0]), 0.3)
        assert found.shape == (3, 2)
        assert found[1, 1] == pytest.approx(0.3 * 30 / (2 * math.pi) / 2)
