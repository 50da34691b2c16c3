"""The matrix exponential against rational arithmetic, closed forms and scipy's Pade approximants."""

import math
from fractions import Fraction

import numpy as np
import pytest
from scipy.linalg import expm as pade

from ptmcalc.numerics import expm


def rational(matrix: np.ndarray, terms: int = 60) -> np.ndarray:
    """exp(A) by its Taylor series in fractions, rounded once."""
    n = len(matrix)
    exact = [[Fraction(float(x)) for x in row] for row in matrix]
    term = [[Fraction(int(i == j)) for j in range(n)] for i in range(n)]
    total = [row[:] for row in term]
    for k in range(1, terms):
        term = [[sum(term[i][m] * exact[m][j] for m in range(n)) / k for j in range(n)] for i in range(n)]
        total = [[total[i][j] + term[i][j] for j in range(n)] for i in range(n)]
    return np.array([[float(x) for x in row] for row in total])


class TestBalance:
    def test_gives_powers_of_two(self) -> None:
        rng = np.random.default_rng(3)
        matrix = rng.normal(size=(6, 6)) * 10.0 ** rng.integers(-8, 8, (6, 6))
        scale = expm.balance(matrix)
        assert np.array_equal(np.log2(scale), np.round(np.log2(scale)))
        for one_way in (np.triu(matrix, 1), np.tril(matrix, -1)):
            scale = expm.balance(one_way)
            assert np.array_equal(np.log2(scale), np.round(np.log2(scale)))

    def test_evens_out_a_matrix_scaled_by_hand(self) -> None:
        rng = np.random.default_rng(4)
        matrix, by_hand = rng.normal(size=(5, 5)), 2.0 ** np.array([-30, 0, 12, 25, -7])
        skewed = matrix * by_hand[:, None] / by_hand
        scale = expm.balance(skewed, sweeps=20)
        evened = skewed * scale / scale[:, None]
        assert np.abs(evened).max() < 8 * np.abs(matrix).max()

    def test_an_oscillator_is_left_with_its_frequency(self) -> None:
        """Cost is squarings: omega = 1.2e4, not omega^2 = 1.4e8."""
        matrix = np.array([[0.0, 1.0], [-1.44e8, 0.0]])
        scale = expm.balance(matrix)
        assert np.abs(matrix * scale / scale[:, None]).max() <= 2 * 1.2e4

    @pytest.mark.parametrize("power", [-400, -161, -7, 0, 6, 160, 300])
    def test_two_that_feed_each_other_meet_in_the_middle(self, power: int) -> None:
        """The root of their ratio to the last power of 2, however far apart they are."""
        scale = expm.balance(np.array([[0.0, 2.0**power], [2.0**-power, 0.0]]))
        assert scale.tolist() == [2.0**power, 1.0]

    def test_what_only_feeds_on_others_is_scaled_too(self) -> None:
        """No cycle, so Osborne's ratio has a zero in it."""
        matrix = np.array([[0.0, 1e8], [0.0, -1.0]])
        scale = expm.balance(matrix)
        assert np.abs(matrix * scale / scale[:, None]).max() <= 2.0

    @pytest.mark.parametrize("matrix", [np.zeros((3, 3)), np.eye(2), np.empty((0, 0))])
    def test_leaves_what_has_nothing_to_scale(self, matrix: np.ndarray) -> None:
        assert np.array_equal(expm.balance(matrix), np.ones(len(matrix)))


class TestExpm:
    @pytest.mark.parametrize("seed", range(12))
    def test_against_fractions(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        matrix = rng.normal(size=(3, 3)) * 2.0 ** rng.integers(-3, 2, (3, 3))
        exact = rational(matrix)
        assert np.abs(expm.expm(matrix) - exact).max() <= 2e-14 * np.abs(exact).max()

    @pytest.mark.parametrize("seed", range(6))
    def test_of_badly_scaled_variables_keeps_every_entry(self, seed: int) -> None:
        """Every entry of its own size, not only the largest."""
        rng = np.random.default_rng(seed)
        matrix, by_hand = rng.normal(size=(3, 3)) / 2, 2.0 ** rng.integers(-40, 40, 3)
        exact = rational(matrix) * by_hand[:, None] / by_hand
        found = expm.expm(matrix * by_hand[:, None] / by_hand)
        assert found == pytest.approx(exact, rel=1e-12, abs=0)

    @pytest.mark.parametrize("seed", range(6))
    @pytest.mark.parametrize("size", [1, 2, 7, 16])
    def test_against_pade(self, seed: int, size: int) -> None:
        rng = np.random.default_rng(seed)
        matrix = rng.normal(size=(size, size)) * 3
        exact = pade(matrix)
        assert np.abs(expm.expm(matrix) - exact).max() <= 1e-12 * np.abs(exact).max()

    def test_of_a_rotation_far_round(self) -> None:
        found = expm.expm(np.array([[0.0, 300.0], [-300.0, 0.0]]))
        c, s = math.cos(300.0), math.sin(300.0)
        assert found == pytest.approx(np.array([[c, s], [-s, c]]), abs=2e-13)

    def test_of_free_flight_is_a_polynomial(self) -> None:
        """No eigenvectors exist."""
        found = expm.expm(np.diag(np.full(4, 0.25), 1))
        exact = [[0.25 ** (j - i) / math.factorial(j - i) if j >= i else 0.0 for j in range(5)] for i in range(5)]
        assert found == pytest.approx(np.array(exact), rel=1e-15, abs=0)

    @pytest.mark.parametrize("decay", [1.0, 30.0, 600.0])
    def test_of_a_strong_decay_stays_small(self, decay: float) -> None:
        """Terms of size e^decay must not be added up; what has faded leaves no more than the last digit of 1."""
        found = expm.expm(np.array([[-decay, 0.3 * decay], [0.0, -decay]]))
        exact = math.exp(-decay) * np.array([[1.0, 0.3 * decay], [0.0, 1.0]])
        assert found == pytest.approx(exact, rel=1e-14, abs=2.0**-52)

    @pytest.mark.parametrize("fast", [1e3, 1e6, 1e9, 1e12])
    def test_slow_beside_faded_keeps_its_digits(self, fast: float) -> None:
        """(I + small) squared 2^s times would lose 2^s units: 4e-9 at 1e9."""
        found = expm.expm(np.diag([-math.log(2.0), -fast]))
        assert found[0, 0] == pytest.approx(0.5, rel=4e-15)
        assert abs(found[1, 1]) <= 2.0**-52

    def test_of_a_chain_fed_by_its_last(self) -> None:
        """x' = 1e9 y, y' = z, z' = 0: what comes back nowhere sets no step."""
        found = expm.expm(np.array([[0.0, 1e9, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]]))
        assert found[0] == pytest.approx([1.0, 1e9, 0.5e9], rel=1e-15)


class TestSeveralTimes:
    def test_are_those_of_one_at_a_time(self) -> None:
        rng = np.random.default_rng(8)
        matrix, times = rng.normal(size=(4, 4)), np.array([0.0, 1e-9, 0.3, -0.7, 5.0])
        powers = expm.Powers(matrix)
        found, norm = powers.at(times), powers.norm
        for time, one in zip(times, found, strict=True):
            exact = pade(matrix * time)
            assert np.abs(one - exact).max() <= 2e-14 * np.abs(exact).max() * max(1.0, norm * abs(time))

    @pytest.mark.parametrize("unit", [1e-9, 1.0, 1e9])
    def test_take_as_many_squarings_as_the_longest_asks_for(self, unit: float, monkeypatch: pytest.MonkeyPatch) -> None:
        """The power of two above the size of the matrix, in any unit of time."""
        took: list[int] = []
        squared = expm._squared
        monkeypatch.setattr(expm, "_squared", lambda change, times: (took.append(times), squared(change, times))[1])
        turns = expm.Powers(np.array([[0.0, 1.0], [-1.0, 0.0]]) / unit)
        for longest, expected in ((0.3, 0), (1.0, 0), (3.9, 2), (1000.0, 10)):
            turns.changes(unit * longest * np.array([0.2, 1.0, 0.7]))
            turns.change(unit * longest)
            assert took == [expected, expected]
            took.clear()

    def test_no_time_is_the_unit_matrix(self) -> None:
        found = expm.Powers(np.full((2, 2), 7.0)).at(np.zeros(3))
        assert np.array_equal(found, np.broadcast_to(np.eye(2), (3, 2, 2)))

    @pytest.mark.parametrize("time", [0.0, 1e-9, 0.3, -0.7, 5.0])
    def test_the_change_at_one_time_is_what_is_beyond_the_unit_matrix(self, time: float) -> None:
        powers = expm.Powers(np.random.default_rng(9).normal(size=(4, 4)))
        whole = powers.at(np.array([time]))[0]
        assert np.abs(np.eye(4) + powers.change(time) - whole).max() <= 1e-15 * np.abs(whole).max()

    def test_a_small_change_keeps_its_digits(self) -> None:
        """exp(-1e-20) - 1, of which the whole shows nothing."""
        assert expm.Powers(np.array([[-1e-5]])).change(1e-15)[0, 0] == pytest.approx(-1e-20, rel=1e-15)

    def test_large_entries_do_not_overflow(self) -> None:
        found = expm.Powers(np.array([[0.0, 1e200], [0.0, 0.0]])).at(np.array([1e-190]))
        assert found[0].tolist() == [[1.0, pytest.approx(1e10, rel=1e-15)], [0.0, 1.0]]


@pytest.mark.parametrize("size", [1e-12, 1e12])
@pytest.mark.parametrize("turned", [False, True], ids=["feeds on the rest", "feeds the rest"])
def test_what_only_feeds_or_is_fed_is_made_no_larger_than_the_rest(size: float, turned: bool) -> None:
    """A state outside every loop: its entries add up to the largest of the others, 3 here, within a factor of 4."""
    matrix = np.array([[0.0, size, size], [0.0, -1.0, 2.0], [0.0, -3.0, -1.0]])
    matrix = matrix.T.copy() if turned else matrix
    scale = expm.balance(matrix)
    balanced = np.abs(matrix * scale / scale[:, None])
    beside = balanced[1:, 0].sum() if turned else balanced[0, 1:].sum()
    assert 3 / 4 <= beside <= 2 * 3
