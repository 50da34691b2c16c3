"""Intervals and correlations against scipy, against their definition, and against what they promise."""

import math

import numpy as np
import pytest
from scipy import stats

from ptmcalc.numerics.statistics import beta_share, quantile_interval, rank_correlation, ranks, share_interval


@pytest.mark.parametrize("a", [0.5, 1.0, 3.0, 250.0, 1e5])
@pytest.mark.parametrize("b", [0.5, 2.0, 40.0, 9e5])
def test_the_beta_function_is_that_of_scipy(a: float, b: float) -> None:
    mean, spread = stats.beta.mean(a, b), stats.beta.std(a, b)
    for x in np.clip([mean - 4 * spread, mean - spread, mean, mean + spread, mean + 4 * spread, 0.0, 1.0], 0, 1):
        assert beta_share(float(x), a, b) == pytest.approx(float(stats.beta.cdf(x, a, b)), rel=1e-8, abs=1e-15)


@pytest.mark.parametrize(
    ("hits", "size"),
    [(0, 1), (1, 1), (0, 10), (1, 10), (10, 10), (3, 17), (5, 100_000), (1770, 100_000), (99_999, 100_000), (5, 10**6)],
)
@pytest.mark.parametrize("confidence", [0.5, 0.9, 0.95, 0.999])
def test_the_interval_of_a_share_is_that_of_clopper_and_pearson(hits: int, size: int, confidence: float) -> None:
    expected = stats.binomtest(hits, size).proportion_ci(confidence, method="exact")
    assert share_interval(hits, size, confidence) == pytest.approx((expected.low, expected.high), rel=1e-7, abs=1e-12)


@pytest.mark.parametrize("size", [1, 6, 13])
def test_small_samples_to_their_last_digits(size: int) -> None:
    """I_x(k, n - k + 1) is a sum of binomials; and the ends of an interval leave out what they say."""

    def at_least(hits: int, p: float) -> float:
        return math.fsum(math.comb(size, k) * p**k * (1 - p) ** (size - k) for k in range(hits, size + 1))

    for hits in range(1, size + 1):
        for p in (0.003, 0.2, 0.47, 0.9):
            assert beta_share(p, hits, size - hits + 1) == pytest.approx(at_least(hits, p), rel=3e-13)
        low, high = share_interval(hits, size, 0.9)
        assert at_least(hits, low) == pytest.approx(0.05, rel=1e-10)
        assert 1 - at_least(hits + 1, high) == pytest.approx(0.05 if hits < size else 1.0, rel=1e-10)


def test_an_interval_of_a_share_holds_it_as_often_as_it_says() -> None:
    """Summed over all numbers of hits, for many probabilities: never less often. Wilson's does, somewhere."""
    size, hits = 30, np.arange(31)
    ends = np.array([share_interval(int(k), size, 0.9) for k in hits])
    wilson = np.array([stats.binomtest(int(k), size).proportion_ci(0.9, method="wilson") for k in hits])

    def least(these: np.ndarray) -> float:
        inside = [(p, (these[:, 0] <= p) & (p <= these[:, 1])) for p in np.linspace(0.01, 0.99, 99)]
        return float(min(stats.binom.pmf(hits, size, p)[held].sum() for p, held in inside))

    assert least(wilson) < 0.9 <= least(ends)


@pytest.mark.parametrize("share", [0.001, 0.05, 0.5, 0.9])
@pytest.mark.parametrize("size", [1, 7, 40, 300])
def test_order_statistics_around_a_quantile_are_those_of_the_definition(share: float, size: int) -> None:
    values = np.random.default_rng(size).permutation(np.arange(1.0, size + 1))
    number, low, high = quantile_interval(values, share, 0.89)
    assert number == min(k for k in range(1, size + 1) if k >= size * share - 1e-9)
    below = [r for r in range(1, size + 1) if stats.binom.cdf(r - 1, size, share) <= 0.055]
    above = [s for s in range(1, size + 1) if stats.binom.sf(s - 1, size, share) <= 0.055]
    assert low == (max(below) if below else -math.inf)
    assert high == (min(above) if above else math.inf)


def test_an_interval_of_a_quantile_holds_it_as_often_as_it_says() -> None:
    chance, held = np.random.default_rng(11), 0
    for _ in range(400):
        _, low, high = quantile_interval(chance.exponential(size=120), 0.1, 0.9)
        held += low <= -math.log(0.9) <= high
    assert stats.binomtest(held, 400, 0.9, alternative="less").pvalue > 0.01


def test_ranks_and_their_correlation_are_those_of_scipy() -> None:
    chance = np.random.default_rng(3)
    x = chance.normal(size=500)
    y = np.round(x**3 + chance.normal(size=500), 1)
    np.testing.assert_array_equal(ranks(y), stats.rankdata(y))
    assert rank_correlation(ranks(x), ranks(y)) == pytest.approx(stats.spearmanr(x, y)[0], abs=1e-12)
    assert rank_correlation(ranks(x), ranks(np.exp(x))) == pytest.approx(1)
    assert rank_correlation(ranks(x), ranks(-x)) == pytest.approx(-1)
    assert rank_correlation(ranks(x), ranks(np.ones(500))) == 0
    assert ranks([math.inf, 1.0, -math.inf]).tolist() == [3, 2, 1]
