"""Natural frequencies of belt loops against finite elements, closed forms and the worked case BW-06."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from scipy import linalg

from ptmcalc.laws import belt_modes, loop_bounds
from ptmcalc.laws.loop_bounds import LoopMasses

EA, L = 138e6, 1000.0
WORKED = LoopMasses(38 * L, 245 * L, 1500.0, 45120.0, L / EA, L / EA, fixed_length=False, imposed_speed=False)
"""BW-06."""
KINDS = list(itertools.product((False, True), (False, True)))


def elements(loop: LoopMasses, takeup_mass: float, pieces: int) -> tuple[np.ndarray, np.ndarray]:
    """Stiffness and mass of two-node elements: nodes from the return start over the tail to the drive, the last one."""
    n = 2 * pieces + 1
    stiffness, mass = np.zeros((n, n)), np.zeros((n, n))
    for first, strand_mass, compliance in (
        (0, loop.return_mass, loop.return_compliance),
        (pieces, loop.carry_mass, loop.carry_compliance),
    ):
        near = np.arange(first, first + pieces)
        for one, other in itertools.product((0, 1), (0, 1)):
            stiffness[near + one, near + other] += pieces / compliance * (1 if one == other else -1)
            mass[near + one, near + other] += strand_mass / pieces / 6 * (2 if one == other else 1)
    mass[pieces, pieces] += loop.tail_mass
    mass[-1, -1] += loop.drive_mass
    if loop.fixed_length:
        join = np.eye(n, n - 1)  # the return starts where the carry strand ends
        join[-1, 0] = 1.0
        stiffness, mass = join.T @ stiffness @ join, join.T @ mass @ join
        free = slice(1, None) if loop.imposed_speed else slice(None)
    else:
        ends = np.ix_([0, n - 1], [0, n - 1])
        mass[ends] += takeup_mass / 4 * np.array([[1, -1], [-1, 1]])
        free = slice(None, -1) if loop.imposed_speed else slice(None)
    return stiffness[free, free], mass[free, free]


def by_elements(loop: LoopMasses, takeup_mass: float, count: int) -> np.ndarray:
    """From two grids, with the error of second order taken out."""
    skip = 0 if loop.imposed_speed else 1
    coarse, fine = (
        linalg.eigh(*elements(loop, takeup_mass, pieces), eigvals_only=True, subset_by_index=(skip, count + skip - 1))
        for pieces in (50, 100)
    )
    return np.asarray(np.sqrt((4 * fine - coarse) / 3))


class TestWorkedCase:
    @pytest.mark.parametrize(
        ("fixed_length", "imposed_speed", "takeup", "printed"),
        [
            (False, True, 0.0, [1.00404, 2.66634, 3.97587, 5.87577]),
            (False, False, 0.0, [1.70807, 3.02541, 4.38637, 6.24925]),
            (False, False, 12000.0, [1.63214, 2.97549, 4.24154, 6.2365]),
            (True, False, 0.0, [2.57866, 3.63595, 6.05825, 6.56724]),
        ],
    )
    def test_frequencies(self, fixed_length: bool, imposed_speed: bool, takeup: float, printed: list[float]) -> None:
        loop = replace(WORKED, fixed_length=fixed_length, imposed_speed=imposed_speed)
        assert belt_modes.natural_frequencies(loop, takeup, 4) == pytest.approx(printed, rel=6e-6)


class TestFiniteElements:
    @pytest.mark.parametrize(("fixed_length", "imposed_speed"), KINDS)
    @pytest.mark.parametrize("takeup", [0.0, 700.0, 9e4])
    @pytest.mark.parametrize("seed", range(4))
    def test_random_loops(self, fixed_length: bool, imposed_speed: bool, takeup: float, seed: int) -> None:
        """Masses and compliances over two decades."""
        numbers = 10 ** np.random.default_rng(seed).uniform([3.5, 3.5, 1, 2, -5.5, -5.5], [5, 5, 5, 5, -4.5, -4.5])
        loop = LoopMasses(*numbers.tolist(), fixed_length=fixed_length, imposed_speed=imposed_speed)
        expected = by_elements(loop, takeup, 9)
        found = belt_modes.natural_frequencies(loop, takeup, 9)
        assert found == pytest.approx(expected, rel=2e-5)
        between = (expected[:-1] + expected[1:]) / 2
        clear = np.diff(expected) > 1e-3 * expected[1:]
        counts = belt_modes.modes_below(loop, takeup, between)
        assert np.all(counts[clear] == np.arange(1, 9)[clear])

    @pytest.mark.parametrize(("fixed_length", "imposed_speed"), KINDS)
    @pytest.mark.parametrize("tail", [0.0, 3e3])
    @pytest.mark.parametrize("takeup", [0.0, 2e4])
    def test_mirrored_strands(self, fixed_length: bool, imposed_speed: bool, tail: float, takeup: float) -> None:
        """Equal strands: modes in which the drum rests coincide with those of the clamped drum."""
        loop = LoopMasses(5e4, 5e4, tail, 2e4, 1e-5, 1e-5, fixed_length=fixed_length, imposed_speed=imposed_speed)
        assert belt_modes.natural_frequencies(loop, takeup, 9) == pytest.approx(by_elements(loop, takeup, 9), rel=1e-5)


class TestClosedForms:
    SPEED, LENGTH, MASS = 1200.0, 900.0, 9e4

    def loop(self, share: float, drive: float, fixed_length: bool, imposed_speed: bool) -> LoopMasses:
        """A uniform loop divided at a share of its length; EA = m c^2/L."""
        stiffness = self.MASS * self.SPEED**2 / self.LENGTH
        of = np.array([share, 1 - share])
        parts = (*(self.MASS * of).tolist(), 0.0, drive, *(self.LENGTH / stiffness * of).tolist())
        return LoopMasses(*parts, fixed_length=fixed_length, imposed_speed=imposed_speed)

    @pytest.mark.parametrize("share", [0.5, 0.3, 0.25, 0.999])
    def test_uniform(self, share: float) -> None:
        """Quarter waves from the driven drum to a constant tension, half waves in a held loop, double whole waves in
        a free ring, half waves in a belt without a drive."""
        unit, n = np.pi * self.SPEED / self.LENGTH, np.arange(1, 8)
        for fixed, imposed, expected in (
            (False, True, (n - 0.5) * unit),
            (True, True, n * unit),
            (True, False, 2 * np.ceil(n / 2) * unit),
            (False, False, n * unit),
        ):
            loop = self.loop(share, 0.0, fixed, imposed)
            assert belt_modes.natural_frequencies(loop, 0.0, 7) == pytest.approx(expected, rel=1e-12)

    def test_a_thousand_modes_are_all_there(self) -> None:
        loop = self.loop(0.37, 0.0, False, True)
        unit = np.pi * self.SPEED / self.LENGTH
        assert belt_modes.natural_frequencies(loop, 0.0, 1000) == pytest.approx(
            (np.arange(1000) + 0.5) * unit, rel=1e-12
        )

    def test_heavy_drum_on_a_light_belt(self) -> None:
        """Two masses on springs: tail against drum in a ring, both strands pulling."""
        loop = LoopMasses(1e-6, 1e-6, 300.0, 700.0, 1e-5, 3e-5, fixed_length=True, imposed_speed=False)
        stiffness = 1e5 + 1e5 / 3
        expected = math.sqrt(stiffness * (1 / 300 + 1 / 700))
        assert belt_modes.natural_frequencies(loop, 0.0, 1) == pytest.approx([expected], rel=1e-6)

    def test_heavy_takeup_on_a_light_belt(self) -> None:
        """The drum held: M/4 on both strands in series, the tail free to follow."""
        loop = LoopMasses(1e-6, 1e-6, 1e-9, 700.0, 1e-5, 3e-5, fixed_length=False, imposed_speed=True)
        expected = math.sqrt(1 / 4e-5 / (800.0 / 4))
        assert belt_modes.natural_frequencies(loop, 800.0, 1) == pytest.approx([expected], rel=1e-6)

    @pytest.mark.parametrize("imposed_speed", [False, True])
    def test_a_very_heavy_takeup_is_a_fixed_length(self, imposed_speed: bool) -> None:
        """But for the slow swing of the weight itself."""
        gravity = replace(WORKED, imposed_speed=imposed_speed)
        heavy = belt_modes.natural_frequencies(gravity, 1e13, 6)
        assert heavy[0] < 1e-3
        fixed = belt_modes.natural_frequencies(replace(gravity, fixed_length=True), 0.0, 5)
        assert heavy[1:] == pytest.approx(fixed, rel=1e-6)

    def test_chain_of_a_worked_case(self) -> None:
        """CH-05: 40 m of 200 and 80 kg/m, EA of 1600 mm2 of steel, the sprocket imposing the speed."""
        compliance = 40.0 / (206e9 * 1600e-6)
        loop = LoopMasses(3200.0, 8000.0, 0.0, 0.0, compliance, compliance, fixed_length=False, imposed_speed=True)
        found = belt_modes.natural_frequencies(loop, 0.0, 3) / (2 * np.pi)
        assert found == pytest.approx([5.56835, 14.3844, 24.4429], rel=3e-6)


class TestTrace:
    @pytest.mark.parametrize(("fixed_length", "imposed_speed"), KINDS)
    def test_none_of_two_thousand_is_missing_and_none_is_too_many(
        self, fixed_length: bool, imposed_speed: bool
    ) -> None:
        """sum 1/w_n^2 is the trace of Green's function, known without any mode; the rest beyond n modes is
        (T/pi)^2/n, T the travel time round the loop."""
        for seed in range(20):
            numbers = 10 ** np.random.default_rng(seed).uniform(-2, 2, 6)
            loop = LoopMasses(*numbers.tolist(), fixed_length=fixed_length, imposed_speed=imposed_speed)
            frequencies = belt_modes.natural_frequencies(loop, 0.0, 2000)
            assert np.all(np.diff(frequencies) >= 0)
            around = math.sqrt(loop.carry_mass * loop.carry_compliance) + math.sqrt(
                loop.return_mass * loop.return_compliance
            )
            trace = float(np.sum(frequencies**-2)) + (around / math.pi) ** 2 / 2000
            assert trace == pytest.approx(loop_bounds.lowest_frequency_bound(loop) ** -2, rel=1e-6)


class TestOrder:
    @pytest.mark.parametrize(("fixed_length", "imposed_speed"), KINDS)
    def test_lower_bound(self, fixed_length: bool, imposed_speed: bool) -> None:
        for seed in range(50):
            numbers = 10 ** np.random.default_rng(seed).uniform(-3, 3, 6)
            loop = LoopMasses(*numbers.tolist(), fixed_length=fixed_length, imposed_speed=imposed_speed)
            first = belt_modes.natural_frequencies(loop, 0.0, 1)[0]
            assert loop_bounds.lowest_frequency_bound(loop) <= first * (1 + 1e-12)

    def test_more_mass_is_slower_and_a_held_drum_lies_between(self) -> None:
        base = belt_modes.natural_frequencies(WORKED, 0.0, 8)
        for heavier in (replace(WORKED, tail_mass=9e3), replace(WORKED, drive_mass=9e4)):
            assert np.all(belt_modes.natural_frequencies(heavier, 0.0, 8) < base)
        assert np.all(belt_modes.natural_frequencies(WORKED, 5e3, 8) < base)
        held = belt_modes.natural_frequencies(replace(WORKED, imposed_speed=True), 0.0, 8)
        assert np.all(held < base)
        assert np.all(base[:-1] < held[1:])

    def test_nothing_at_rest(self) -> None:
        assert belt_modes.modes_below(WORKED, 0.0, 1e-6) == 0.0
        assert belt_modes.natural_frequencies(WORKED, 0.0, 0).shape == (0,)


class TestDamping:
    @pytest.mark.parametrize(("eta", "k"), [(0.02, 0.0), (0.0, 15.0), (0.03, 8.0)])
    def test_complex_eigenvalues(self, eta: float, k: float) -> None:
        """M u'' + (eta K + k/rho M) u' + K u = 0 as a first-order system."""
        rho, length = 120.0, 900.0
        loop = LoopMasses(
            rho * length / 3, rho * length * 2 / 3, 0.0, 0.0, 2e-6, 4e-6, fixed_length=False, imposed_speed=True
        )
        stiffness, mass = elements(loop, 0.0, 80)
        n = len(mass)
        inverse = np.linalg.inv(mass)
        damping = inverse @ (eta * stiffness) + k / rho * np.eye(n)
        system = np.block([[np.zeros((n, n)), np.eye(n)], [-inverse @ stiffness, -damping]])
        values = np.linalg.eigvals(system)
        slow = sorted((v for v in values if v.imag > 0), key=abs)[:3]
        frequencies = belt_modes.natural_frequencies(loop, 0.0, 3)
        ratios = belt_modes.modal_damping(frequencies, eta, k, rho)
        assert ratios == pytest.approx([-v.real / abs(v) for v in slow], rel=2e-4)
        assert frequencies == pytest.approx([abs(v) for v in slow], rel=2e-4)
