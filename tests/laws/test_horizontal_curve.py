"""Horizontal curves: a ribbon of many strips that takes its lowest energy, and a published example."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import quad
from scipy.optimize import minimize_scalar

from ptmcalc.laws import horizontal_curve

STRIPS = 200_001


def heights(s: NDArray[np.float64], middle: float, angle: float, banking: float) -> tuple[NDArray[np.float64], ...]:
    """Horizontal place, positive inward, and height of points along the profile of banked rolls."""
    wing = np.sign(s) * np.maximum(np.abs(s) - middle / 2, 0.0)
    x = np.clip(s, -middle / 2, middle / 2) + wing * math.cos(angle)
    z = np.abs(wing) * math.sin(angle)
    return x * math.cos(banking) - z * math.sin(banking), x * math.sin(banking) + z * math.cos(banking)


def depth(x: float, half_top: float, level: float, middle: float, angle: float, surcharge: float) -> float:
    """Depth of the load over a horizontal place of the level trough."""
    floor = max(abs(x) - middle / 2, 0.0) * math.tan(angle)
    heap = math.tan(surcharge) * (half_top**2 - x**2) / (2 * half_top)
    return max(level - floor, 0.0) + max(heap, 0.0)


def lowest(belt: tuple[float, float, float, float], weights: tuple[float, float], pulls: tuple[float, float],
           load: NDArray[np.float64] | None = None) -> float:  # fmt: skip
    """Drift of least energy of strips that slide along the profile: weight lifts, the pull goes inward."""
    width, middle, angle, banking = belt
    s = np.linspace(-width / 2, width / 2, STRIPS)
    shares = [np.full(STRIPS, 1 / STRIPS)] + ([load / load.sum()] if load is not None else [])

    def energy(y: float) -> float:
        x, z = heights(s + y, middle, angle, banking)
        each = zip(shares, weights, pulls, strict=False)
        return float(sum((share * (weight * z - pull * x)).sum() for share, weight, pull in each))

    found = minimize_scalar(energy, bounds=(-width / 2, width / 2), method="bounded", options={"xatol": 1e-10})
    return float(found.x)


@pytest.mark.parametrize("seed", range(12))
def test_a_ribbon_takes_its_lowest_energy(seed: int) -> None:
    rng = np.random.default_rng(seed)
    width = rng.uniform(0.65, 2.0)
    middle = width * rng.uniform(0.0, 0.45)
    angle, banking, surcharge = (math.radians(rng.uniform(*ends)) for ends in ((15, 45), (0, 10), (5, 25)))
    belt_weight, pull, push = rng.uniform(80, 500), rng.uniform(-20, 80), rng.uniform(0, 5)
    side = rng.uniform(0.3, 0.9) * (width - middle) / 2
    half_top, level = middle / 2 + side * math.cos(angle), side * math.sin(angle)
    args = half_top, level, middle, angle, surcharge
    area = quad(depth, -half_top, half_top, args=args, points=[-middle / 2, middle / 2], epsabs=1e-12)[0]
    assert horizontal_curve.bed_width(middle, angle, area, surcharge) == pytest.approx(middle + 2 * side, rel=1e-9)
    load_weight = 1600 * 9.81 * area
    s = np.linspace(-width / 2, width / 2, STRIPS)
    x, _ = heights(s, middle, angle, 0.0)
    slopes = np.where(np.abs(s) > middle / 2, math.cos(angle), 1.0)
    load = np.array([depth(float(one), *args) if abs(one) <= half_top else 0.0 for one in x]) * slopes
    sides = width, middle, angle, banking
    for weight, carried in ((load_weight, load), (0.0, None)):
        found = horizontal_curve.drift(
            width, middle, angle, banking, belt_weight, weight, area, surcharge, pull, push, "ribbon"
        )
        expected = lowest(sides, (belt_weight, weight), (pull, -push), carried)
        assert found == pytest.approx(expected, abs=2e-5 * width)


def test_an_empty_ribbon_leans_by_the_angle_of_its_force() -> None:
    """By hand: y = (l + 2 e cos(lambda))/(2 sin(lambda)) tan(phi - beta), tan(phi) = p/W."""
    width, middle, angle, banking = 1.2, 0.465, math.radians(35), math.radians(5)
    pull = horizontal_curve.inward_force(50e3, 20.0, 4.0, 1500.0)
    assert pull == pytest.approx((50e3 - 320) / 1500)
    y = (0.465 + 0.735 * math.cos(angle)) / (2 * math.sin(angle)) * math.tan(math.atan(pull / 196.2) - banking)
    found = horizontal_curve.drift(width, middle, angle, banking, 196.2, 0.0, 0.0, 0.0, pull, 0.0, "ribbon")
    assert found == pytest.approx(y, rel=1e-12)


def test_the_published_example_of_grimmer_and_kessler() -> None:
    """B 800 mm, l 315 mm, 30 deg, banked by 1.46 deg, 156.71475 N of belt, drifted by 60 mm: part I finds 13.5633795 N
    outward; part II 34.0194977 and 18.7886810 N on the wings with 1.1, 1.4149991 N in the middle with 0.9."""
    belt = 0.8, 0.315, math.radians(30), math.radians(1.46), 156.71475, 0.0, 0.0, 0.0
    second = (34.0194976531535 - 18.7886810270471) / 1.1 + 1.41499913142688 / 0.9
    for rule, force in (("part_1", 13.5633795467688), ("part_2", second)):
        assert horizontal_curve.drift(*belt, force, 0.0, rule) == pytest.approx(0.06, rel=1e-11)


def test_rules_part_in_their_order_and_nothing_holds_a_flat_belt() -> None:
    belt = 1.2, 0.465, math.radians(35), math.radians(3), 200.0, 0.0, 0.0, 0.0
    least, middle, most = (horizontal_curve.drift(*belt, 40.0, 0.0, rule) for rule in ("ribbon", "part_2", "part_1"))
    assert 0 < least < middle < most
    flat = 1.2, 1.2, 0.0, math.radians(3), 200.0, 0.0, 0.0, 0.0
    assert horizontal_curve.drift(*flat, 40.0, 0.0, "ribbon") == pytest.approx(1.2)
    assert horizontal_curve.drift(*flat, 5.0, 0.0, "ribbon") == pytest.approx(-1.2)


def test_the_outer_edge_runs_on_a_longer_arc() -> None:
    side, angle, radius = 0.3675, math.radians(35), 1500.0
    outer = 0.465 / 2 + side * math.cos(angle)
    arcs = [(radius + one) * 0.01 for one in (0.0, outer)]
    assert horizontal_curve.edge_strain(0.465, side, angle, radius) == pytest.approx(arcs[1] / arcs[0] - 1, rel=1e-9)
