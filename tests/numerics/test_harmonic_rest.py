"""What lies behind the last harmonic: every bound against its formula by hand, and the search that counts with it."""

import cmath
import math

import numpy as np
import pytest

from ptmcalc.numerics.harmonic.parts import Chain, Damping, Excitation, Line
from ptmcalc.numerics.harmonic.rest import Rest, rest_of
from ptmcalc.numerics.harmonic.search import Search

ONE, TWO = Line(40.0, 200.0, 3e8), Line(44.0, 80.0, 3e8)
DAMPINGS = [
    Damping("kelvin_voigt", time=4e-5),
    Damping("hysteretic", share=0.04),
    Damping("zener", time=0.02, share=0.3),
]
SPEED, COUNT = 55.0, 12


def modulus(damping: Damping, w: float) -> complex:
    """From the differential equations of spring and damper."""
    if damping.law == "kelvin_voigt":
        return 1 + 1j * w * damping.time
    if damping.law == "hysteretic":
        return complex(1, damping.share)
    return 1 + damping.share / (1 + 1 / (1j * w * damping.time))


def by_hand(
    chain: Chain, b: np.ndarray, speed: float, crossed: bool, at_far_end: bool, apart: bool
) -> dict[str, float]:
    """The module's reasoning, one number after the other."""
    n = len(b)
    w = speed * (n + 1)
    k = cmath.sqrt(modulus(chain.damping, w))
    stiffest = {"kelvin_voigt": abs(k), "hysteretic": abs(k), "zener": math.sqrt(1 + chain.damping.share)}
    size = stiffest[chain.damping.law]  # most of |k| over that of the first left out, which frequency takes out again
    grows = 2.0 if chain.damping.law == "kelvin_voigt" else 1.0  # sum of n^(1/2)/n^3 instead of 1/n^3 behind N
    ends = chain.lines[0], chain.lines[-1]
    once = [
        abs(cmath.exp(-1j * w * line.length * math.sqrt(line.line_mass / line.stiffness) / k)) for line in chain.lines
    ]
    z = [math.sqrt(line.line_mass * line.stiffness) * size for line in ends]
    stray = [z[0] * 2 * once[0] ** 2 / (1 - once[0] ** 2), z[1] * 2 * once[-1] ** 2 / (1 - once[-1] ** 2)]
    through = 2 * math.sqrt(z[0] * z[1]) * math.prod(once) / (1 - max(once[0], once[-1]) ** 2) if apart else 0.0
    force = int(at_far_end)
    motion = force if not crossed else 1 - force
    drive, tail = 1 / (chain.drive_mass * w), 0.0
    if chain.far == "on_sprocket":
        felt = drive * (z[force] + stray[force] + through)
        give = drive * (z[0] + stray[0] + z[1] + stray[1] + 2 * through)
    else:
        if chain.far == "free" and apart:
            tail = 1 / (chain.far_mass * w)
        at = [z[end] + stray[end] if end == force else through for end in (0, 1)]
        felt = max(drive * at[0], tail * at[1] if tail else 0.0)
        give = max(drive * (z[0] + stray[0] + through), tail * (z[1] + stray[1] + through) if tail else 0.0)
    back = felt / (1 - give) if give < 1 else math.inf
    fed = back * (z[motion] + stray[motion] + through) if back else 0.0
    first = abs(b[-1]) * n / speed
    echoes = grows * first / n * ((through if crossed else stray[force]) + fed)
    if crossed:
        return {"whole": echoes, "variation": 0.0, "echoes": echoes, "corner": 0.0, "unsure": echoes}
    steady = first * z[force]
    # the sum of all 1/s^2 k(s) behind N + 1/2 with s = t^-2 (N + 1/2), by many trapezia
    t = (np.arange(20000) + 0.5) / 20000
    real = [cmath.sqrt(modulus(chain.damping, speed * (n + 0.5) / one**2)).real for one in t]
    reach = 2 / (n + 0.5) * float(np.mean(np.array(real) * t))
    sign = (1.0 if at_far_end else -1.0) * math.copysign(1.0, b[-1]) * (-1) ** n
    line = ends[force]
    corner = sign * first * math.sqrt(line.line_mass * line.stiffness) * reach
    settled = abs(abs(b[n - 2]) * (n - 1) / speed - first) * n + first / n**2
    return {
        "whole": grows * steady / n + echoes,
        "variation": (1 + math.pi / 2) * steady / (n + 1) ** 2,
        "echoes": echoes,
        "corner": corner,
        "unsure": echoes + settled * grows * z[force] / n,
    }


CASES = [
    Chain((ONE,), DAMPINGS[0]),
    Chain((ONE, TWO), DAMPINGS[0], joint_mass=900.0, far_mass=4e4),
    Chain((ONE, TWO), DAMPINGS[0], far="held", drive_mass=3e4),
    Chain((ONE, TWO), DAMPINGS[0], far="on_sprocket", drive_mass=9e4),
    Chain((ONE, TWO), DAMPINGS[0], far="free", far_mass=6e4, drive_mass=3e4),
    Chain((ONE, TWO), DAMPINGS[0], far="held", drive_mass=10.0),
]
B = (-1.0) ** np.arange(1, COUNT + 1) / np.arange(1, COUNT + 1) * (1 + 0.2 / np.arange(1, COUNT + 1) ** 2)


@pytest.mark.parametrize("damping", DAMPINGS, ids=lambda one: one.law)
@pytest.mark.parametrize("case", range(len(CASES)))
@pytest.mark.parametrize("crossed", [False, True])
@pytest.mark.parametrize("at_far_end", [False, True])
def test_bounds_are_those_by_hand(case: int, damping: Damping, crossed: bool, at_far_end: bool) -> None:
    chain = CASES[case]
    chain = Chain(chain.lines, damping, chain.far, chain.joint_mass, chain.far_mass, chain.drive_mass)
    apart = case > 0
    speeds = np.array([SPEED, 3 * SPEED])
    b = np.stack([B, -0.7 * B])
    found = rest_of(chain, speeds, Excitation(b), crossed=crossed, at_far_end=at_far_end, apart=apart)
    for k, speed in enumerate(speeds):
        expected = by_hand(chain, b[k], speed, crossed, at_far_end, apart)
        for name, value in expected.items():
            # the integral by trapezia of the test is good to 1e-8 of it
            assert getattr(found, name)[k] == pytest.approx(value, rel=1e-7 if name == "corner" else 1e-12), name


def test_without_damping_nothing_is_bounded_and_one_harmonic_has_none_before_it() -> None:
    chain = Chain((ONE,), Damping("hysteretic"))
    found = rest_of(chain, np.array([SPEED]), Excitation(np.ones((1, 1))), crossed=False, at_far_end=False, apart=False)
    assert (found.whole[0], found.echoes[0]) == (math.inf, math.inf)
    z = math.sqrt(ONE.line_mass * ONE.stiffness)
    assert found.variation[0] == pytest.approx((1 + math.pi / 2) * z / SPEED / 4)
    assert found.corner[0] == pytest.approx(z / SPEED * 2 / 1.5 / 2)  # one term, downward for a positive harmonic
    light = Damping("hysteretic", share=1e-19)
    assert math.isinf(rest_of(Chain((ONE,), light), np.array([SPEED]), Excitation(np.ones((1, 1))), crossed=False,
                              at_far_end=False, apart=False).whole[0])  # fmt: skip


def nothing(rows: int) -> Rest:
    return Rest(*(np.zeros(rows) for _ in range(5)))


class TestSearch:
    TERMS = np.array([[0.3 - 0.1j, 0.0, 1.1 + 0.4j, 0.0, -0.2 + 0.6j], [1.0 + 0j, 0.5j, 0.0, 0.0, 0.0]])

    def series(self, x: np.ndarray) -> np.ndarray:
        n = np.arange(1, 6)
        return np.asarray((self.TERMS[:, None, :] * np.exp(2j * np.pi * n * x[:, None])).imag.sum(axis=-1))

    @pytest.mark.parametrize("sign", [1.0, -1.0])
    def test_the_largest_is_a_root_of_the_slope(self, sign: float) -> None:
        """To all digits, from 1024 samples: to 1e-5 of a place by them alone."""
        search = Search([self.TERMS], [0.2], [nothing(2)], np.zeros(2))
        value, place, low, high = search.largest(sign)
        n = np.arange(1, 6)
        for k in range(2):
            row = self.TERMS[k]
            dense = sign * self.series(np.arange(2**14) / 2**14)[k]
            slope = float((row * n * np.exp(2j * np.pi * n * place[k])).real.sum())
            assert abs(slope) < 1e-12
            assert value[k] == pytest.approx(dense.max(), abs=1e-6)
            assert value[k] >= dense.max() - 1e-12
            assert low[k] == value[k] <= high[k]
            assert 0 <= place[k] < 1

    def test_between_samples_it_rises_by_its_curvature_and_what_was_left_out(self) -> None:
        """Half a step from a sample at most: |S''| (pi/1024)^2/2, absolutely or by the change of its terms."""
        rest = Rest(np.array([0.7, 0.7]), np.array([0.01, 0.3]), np.array([0.05, 0.02]), np.zeros(2), np.zeros(2))
        rounding = np.array([1e-3, 2e-3])
        search = Search([self.TERMS], [0.2], [rest], rounding)
        n = np.arange(1, 6)
        assert search._stray.shape == (2, 1024)
        for row, k in ((0, 3), (0, 400), (1, 716), (1, 717), (0, 718), (1, 1000)):
            bent = self.TERMS[row] * n**2 * np.exp(2j * np.pi * n * 0.7)
            change = sum(abs(b - a) for a, b in zip(bent, [*bent[1:], 0.0], strict=True))
            apart = abs(k / 1024 - 0.7)
            apart = min(apart, 1 - apart)
            sine = max(math.sin(math.pi * max(apart - 0.5 / 1024, 0.0)), 1e-12)
            curve = min(change / sine, sum(map(abs, bent)))
            left = min(rest.variation[row] / sine + rest.echoes[row], 0.7)
            expected = rounding[row] + (math.pi / 1024) ** 2 / 2 * curve + left
            assert search._stray[row, k] == pytest.approx(expected, rel=1e-9)

    @pytest.mark.parametrize("place", [0.2, 0.83])
    def test_away_from_its_corner_a_series_bends_by_the_change_of_its_terms(self, place: float) -> None:
        """Terms 1/n^2 that are all in phase at the engagement: of n^2 of them only the last one counts."""
        n = np.arange(1, 41)
        terms = np.exp(-2j * np.pi * n * (place + 0.5)) / n**2
        search = Search([terms[None]], [place], [nothing(1)], np.zeros(1))
        for k in (100, 333, 512, 900):
            apart = abs((k / 1024 - place - 0.5 + 0.5) % 1 - 0.5) - 0.5 / 1024
            expected = (math.pi / 1024) ** 2 / 2 * min(1 / math.sin(math.pi * apart), 40.0)
            assert search._stray[0, k] == pytest.approx(expected, rel=1e-9)

    @pytest.mark.parametrize(("count", "samples"), [(5, 1024), (256, 1024), (257, 2048), (1000, 4096)])
    def test_four_samples_of_every_harmonic_at_least(self, count: int, samples: int) -> None:
        search = Search([np.ones((1, count), complex)], [0.0], [nothing(1)], np.zeros(1))
        assert search._values.shape == (1, samples)

    def test_a_corner_counts_where_it_is_surely_higher(self) -> None:
        """Two engagements: at each the steady rest of its own, less what is unsure and what the other leaves out."""
        rests = [
            Rest(np.full(2, 9.0), np.full(2, 0.02), np.full(2, 0.01), np.array([5.0, -5.0]), np.array([0.3, 0.3])),
            Rest(np.full(2, 9.0), np.full(2, 0.03), np.full(2, 0.02), np.array([0.1, 0.1]), np.array([0.2, 0.2])),
        ]
        rounding = np.array([1e-3, 1e-3])
        search = Search([0.5 * self.TERMS, 0.5 * self.TERMS], [0.2, 0.45], rests, rounding)
        for sign, row in ((1.0, 0), (-1.0, 1)):
            value, place, low, _ = search.largest(sign)
            expected = sign * float(self.series(np.array([0.7]))[row, 0]) + 5.0
            assert value[row] == pytest.approx(expected)
            assert place[row] == pytest.approx(0.7)
            other = 0.03 / math.sin(math.pi * 0.25) + 0.02
            assert low[row] == pytest.approx(expected - 0.3 - rounding[row] - other)
        free = Search([0.5 * self.TERMS, 0.5 * self.TERMS], [0.2, 0.45], [nothing(2)] * 2, np.zeros(2))
        value, place, low, _ = search.largest(1.0)
        best, at, _, _ = free.largest(1.0)
        assert (value[1], place[1]) == (pytest.approx(best[1]), pytest.approx(at[1]))
        left = sum(
            one.variation[1] / math.sin(math.pi * min(abs(at[1] - p), 1 - abs(at[1] - p))) + one.echoes[1]
            for one, p in zip(rests, (0.7, 0.95), strict=True)
        )
        assert low[1] == pytest.approx(best[1] - left - 1e-3)
