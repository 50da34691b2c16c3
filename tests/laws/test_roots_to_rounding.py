"""Roots that are said to be good to rounding, over many decades: bisection in longer floats, or a closed form.

Where Newton's method begins and what it takes for its slope must not show in a root, however far the arguments lie
apart; a method that crawls or stops early does.
"""

import math
from collections.abc import Callable

import numpy as np
import pytest

from ptmcalc.laws import buffer, mast_modes, pendulum, rope_rod, slewing

Long = np.longdouble
PI = 4 * np.arctan(Long(1))
FEW_EPS = 6 * float(np.finfo(float).eps)


def bisected(falls: Callable[[np.longdouble], np.longdouble], low: np.longdouble, high: np.longdouble) -> np.longdouble:
    """Where a falling function passes 0, to the last of 64 digits."""
    while True:
        middle = np.sqrt(low) * np.sqrt(high) if high > 2 * low else (low + high) / 2
        if not low < middle < high:
            return high
        low, high = (middle, high) if falls(middle) > 0 else (low, middle)


def decades(seed: int, count: int, low: float, high: float) -> list[float]:
    return (10 ** np.random.default_rng(seed).uniform(low, high, count)).tolist()


class TestRods:
    @pytest.mark.parametrize("mode", [1, 2, 3, 9])
    def test_held_at_one_end(self, mode: int) -> None:
        base = (mode - 1) * PI
        for ratio in [1.9899975254526419, *decades(mode, 25, -8, 8)]:
            x = bisected(lambda x, r=ratio: r * np.cos(x) - (base + x) * np.sin(x), Long(1e-12), PI / 2)
            assert rope_rod.rod_root(ratio, mode) == pytest.approx(float(base + x), rel=FEW_EPS), ratio

    def test_with_a_mass_at_either_end(self) -> None:
        for drive, load in [(88356.48, 1.98999), *zip(decades(1, 60, -8, 8), decades(2, 60, -8, 8), strict=True)]:
            root = bisected(
                lambda x, a=drive, b=load: np.arctan2(Long(1), a * x) + np.arctan2(Long(1), b * x) - x, Long(1e-12), PI
            )
            assert rope_rod.free_rod_root(drive, load) == pytest.approx(float(root), rel=FEW_EPS), (drive, load)
        assert rope_rod.free_rod_root(0.0, 0.0) == pytest.approx(math.pi, rel=FEW_EPS)

    def test_on_a_structure_that_gives(self) -> None:
        """Of any size, the spring alone and the mass with it; the lowest root, from the equation as it is printed."""
        for k in range(40):
            rope, drive, frame, beside = (one[k] for one in (decades(s, 40, -3, 3) for s in (3, 4, 5, 6)))
            beside = beside if k % 3 else 0.0
            z = np.sqrt(Long(rope))  # stiffness 1, load 1

            def gap(w: np.longdouble, z=z, drive=drive, frame=frame, beside=beside) -> np.longdouble:  # type: ignore[no-untyped-def]
                give = 1 / (drive * w * w) - 1 / (frame - beside * w * w)
                return np.arctan(z / w) + np.arctan(z * w * give) - w * z

            top = np.sqrt(Long(frame) / beside) * (1 - Long(1e-18)) if beside else Long(1e6)
            expected = float(bisected(gap, Long(1e-9), top))
            found = rope_rod.framed_rod_frequency(1.0, rope, drive, 1.0, frame, beside)
            assert found == pytest.approx(expected, rel=4 * FEW_EPS), (rope, drive, frame, beside)


class TestBuffers:
    @pytest.mark.parametrize("power", [0.5, 1.0, 2.5])
    @pytest.mark.parametrize("speed", [1e-40, 1e-17, 1e-6, 0.9, 30.0])
    def test_without_a_push_the_energy_is_that_of_the_curve(self, power: float, speed: float) -> None:
        force, path = buffer.progressive_buffer(0.0, 9e3, speed, 4e4, 0.07, power)
        share = (9e3 * speed / (4e4 * 0.07) * speed / 2 * (power + 1)) ** (1 / (power + 1))
        assert path == pytest.approx(0.07 * share, rel=4 * FEW_EPS)
        assert force == pytest.approx(4e4 * share**power, rel=8 * FEW_EPS)

    @pytest.mark.parametrize("push", [-2e4, -10.0, 10.0, 1e5])
    @pytest.mark.parametrize("power", [0.5, 1.7, 3.0])
    def test_with_a_push_the_works_add_up(self, push: float, power: float) -> None:
        for speed in decades(7, 12, -4, 1):
            force, path = buffer.progressive_buffer(push, 9e3, speed, 4e4, 0.07, power)
            taken = force * path / (power + 1)
            given = 9e3 * speed**2 / 2 + push * path
            assert force == pytest.approx(4e4 * (path / 0.07) ** power, rel=1e-13)
            assert taken == pytest.approx(given, rel=0, abs=1e-13 * (taken + 9e3 * speed**2 + abs(push * path)))
            assert path > 0
            assert force > push


@pytest.mark.parametrize("size", [1e-150, 1e-5, 1.0, 1e100])
def test_a_mean_of_torques_has_their_unit(size: float) -> None:
    shares, torques = [0.21, 0.47, 0.32], [9.7, 4.1, -7.3]
    mean = sum(share * abs(torque) ** 3 for share, torque in zip(shares, torques, strict=True)) ** (1 / 3)
    found = slewing.fatigue_torque(shares, [torque * size for torque in torques], 3.0)
    assert found == pytest.approx(mean * size, rel=1e-14)


@pytest.mark.parametrize("seed", range(12))
def test_what_small_angles_leave_out_is_the_smaller_root_of_its_cubic(seed: int) -> None:
    """E = phase H^3/6 + push H^2/2, H = A + E, up to where both roots meet and none is left."""
    rng = np.random.default_rng(seed)
    angle, phase, push = 10 ** rng.uniform(-3, -0.7), 10 ** rng.uniform(-1, 1), 10 ** rng.uniform(-2, 0)

    def beyond(error: np.longdouble) -> np.longdouble:
        return phase * (angle + error) ** 3 / 6 + push * (angle + error) ** 2 / 2 - error

    found = pendulum.small_angle_error(angle, phase, push)
    slope = -push + math.sqrt(push**2 + 2 * phase)
    lowest = Long(slope / phase - angle)  # where the rest is least
    if lowest <= 0 or beyond(lowest) > 0:
        assert found == math.inf
    else:
        root = bisected(beyond, Long(1e-30), lowest)
        assert found == pytest.approx(float(root), rel=1e-12)


class TestColumns:
    @pytest.mark.parametrize("root_mass", [0.0, 0.4, 2.0, 7.0])
    def test_a_column_without_mass_is_a_spring_between_two(self, root_mass: float) -> None:
        """Where nothing shifts the root is part of the base: w^2 = 3 E J/l^3 (1/(m_1 + m_r) + 1/m_2)."""
        mast = mast_modes.Mast(3.1, 7.3e4, 0.0, 1.0, 3.0, root_mass=root_mass)
        stiffness = 3 * 7.3e4 / 3.1**3
        expected = math.sqrt(stiffness * (1 / (1.0 + root_mass) + 1 / 3.0))
        assert mast_modes.mast_frequency(mast, 1) == pytest.approx(expected, rel=1e-12)
        assert mast_modes.mast_frequency(mast, 2) == math.inf

    @pytest.mark.parametrize("unlike", [1.0, 1e3, 1e7])
    def test_a_shape_is_found_in_any_units(self, unlike: float) -> None:
        """Rows and columns of very different sizes: the vector that nothing is left of, but for rounding."""
        rng = np.random.default_rng(5)
        part = rng.normal(size=(4, 3))
        matrix = part @ part.T
        null = np.linalg.svd(matrix)[2][-1]
        sizes = unlike ** np.array([-1.0, 0.0, 0.5, 1.0])
        found = mast_modes._null_vector(matrix * sizes[:, None] * sizes)
        expected = null / sizes
        expected = expected / np.abs(expected).max()
        assert found * np.sign(found @ expected) == pytest.approx(expected, rel=1e-7)
