"""Skewing: a rigid crane that slips on its wheels, put in equilibrium anew, and the formulas as they are printed."""

import math

import numpy as np
import pytest
from scipy.optimize import root

from ptmcalc.laws import skew

SPAN, FRICTION = 22.5, 0.24
LAYOUTS = {
    "two_pairs": np.array([0.0, 4.2]),
    "rollers_before": np.array([0.6, 4.8]),
    "four_pairs": np.array([0.0, 0.9, 5.1, 6.0]),
}
COUPLINGS = {"C": 1.0, "I": 0.0}


def equilibrium(
    distances: np.ndarray, coupled: np.ndarray, weights: np.ndarray, centre: float, rail_two: str
) -> tuple[float, float, np.ndarray]:
    """Pole, guide force and wheel forces (across 1, across 2, along 1, along 2) of a rigid body on slipping wheels.

    Slip over skew angle at a place (d behind the guide, y from rail 1): across 1 - turn d, along turn (y - off).
    """

    on_rail = np.array([weights * (1 - centre), weights * centre])

    def forces(turn: float, drift: float) -> np.ndarray:  # drift: turn times the place of the pole across
        across = FRICTION * on_rail * (1 - turn * distances)
        if rail_two == skew.MOVABLE:
            across[1] = 0.0
        along = [FRICTION * n * coupled * (turn * y - drift) for n, y in zip(on_rail, (0.0, SPAN), strict=True)]
        return np.array([*across, *along])

    def unbalanced(state: np.ndarray) -> np.ndarray:
        turn, drift, guide = state
        f = forces(turn, drift)
        about_guide = np.sum(f[:2] * distances) - np.sum(f[3]) * SPAN
        slide = np.sum(f[2:]) if np.any(coupled) else drift
        return np.array([slide, np.sum(f[:2]) - guide, about_guide])

    still = unbalanced(np.zeros(3))  # the balances are linear: their columns one by one
    columns = np.column_stack([unbalanced(e) - still for e in np.eye(3)])
    turn, drift, guide = np.linalg.solve(columns, -still)
    assert unbalanced(np.array([turn, drift, guide])) == pytest.approx(np.zeros(3), abs=1e-6)
    return 1 / turn, float(guide), forces(turn, drift)


class TestEquilibrium:
    @pytest.mark.parametrize("rail_two", [skew.FIXED, skew.MOVABLE])
    @pytest.mark.parametrize("coupling", COUPLINGS)
    @pytest.mark.parametrize("layout", LAYOUTS)
    @pytest.mark.parametrize("centre", [0.15, 0.5, 0.8])
    def test_a_rigid_crane_slips_about_the_pole(self, centre: float, layout: str, coupling: str, rail_two: str) -> None:
        d = LAYOUTS[layout]
        weights, coupled = np.linspace(150e3, 240e3, len(d)), np.full(len(d), COUPLINGS[coupling])
        pole, guide, wheels = equilibrium(d, coupled, weights, centre, rail_two)
        assert skew.slip_pole(d, coupled, weights, centre, SPAN, rail_two) == pytest.approx(pole, rel=1e-8)
        found = skew.skew_forces(FRICTION, d, coupled, weights, centre, SPAN, rail_two)
        assert found[:2] == pytest.approx(wheels[:2], abs=1e-3)
        assert found[2] == pytest.approx(wheels[3], abs=1e-3)
        assert -found[2] == pytest.approx(wheels[2], abs=1e-3)
        assert np.sum(found[:2]) == pytest.approx(guide, rel=1e-8)

    def test_one_coupled_pair_of_two(self) -> None:
        d, weights, coupled = np.array([0.0, 4.2]), np.array([200e3, 160e3]), np.array([0.0, 1.0])
        pole, _, wheels = equilibrium(d, coupled, weights, 0.3, skew.FIXED)
        found = skew.skew_forces(FRICTION, d, coupled, weights, 0.3, SPAN)
        assert skew.slip_pole(d, coupled, weights, 0.3, SPAN) == pytest.approx(pole, rel=1e-8)
        assert found[2] == pytest.approx(wheels[3], abs=1e-3)
        assert found[2, 0] == 0.0


class TestCurve:
    """The standard's curve of friction at every wheel, in equilibrium by another root finder."""

    @staticmethod
    def crane(seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, float, float, str]:
        rng = np.random.default_rng(seed)
        pairs, base = int(rng.choice([2, 3, 4])), rng.uniform(2, 9)
        d = np.sort([0.0, *rng.uniform(0, base, pairs - 2), base]) + rng.choice([0, 0.7])
        coupled = np.full(pairs, float(rng.choice([0, 1])))
        rail_two = str(rng.choice([skew.FIXED, skew.MOVABLE]))
        return d, coupled, rng.uniform(1e5, 3e5, pairs), rng.uniform(0.1, 0.9), rng.uniform(5, 40), rail_two

    @pytest.mark.parametrize("seed", range(30))
    def test_against_a_root_of_the_balances(self, seed: int) -> None:
        d, coupled, weights, centre, span, rail_two = self.crane(seed)
        angle = [0.0008, 0.004, 0.012][seed % 3]

        def wheels(turn: float, off: float) -> np.ndarray:
            rows = []
            for load, y in ((weights * (1 - centre), 0.0), (weights * centre, span)):
                across = angle * (1 - turn * d) * (0.0 if y and rail_two == skew.MOVABLE else 1.0)
                along = angle * coupled * (turn * y - off)
                slip = np.hypot(across, along)
                size = load * 0.3 * (1 - np.exp(-250 * slip)) / np.maximum(slip, 1e-300)
                rows += [size * across, size * along]
            return np.array([rows[0], rows[2], rows[1], rows[3]])

        def balance(state: np.ndarray) -> list[float]:
            f = wheels(*state)
            slide = np.sum(f[2:]) / np.sum(weights) if np.any(coupled) else state[1]
            return [slide, (np.sum(f[:2] * d) - span * np.sum(f[3])) / np.sum(weights) / span]

        pole = skew.slip_pole(d, coupled, weights, centre, span, rail_two)
        found = root(balance, [1 / pole, centre * span / pole], tol=1e-13)
        law = skew.skew_equilibrium(0.3, angle, d, coupled, weights, centre, span, rail_two)
        assert law == pytest.approx(wheels(*found.x), abs=1e-6 * np.sum(weights))

    def test_newton_takes_few_rounds(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """Its matrix is the exact one: digits double, down to where the work falls no more."""
        rounds: list[int] = []
        solve = np.linalg.lstsq

        def counted(*given: object, **options: object) -> object:
            rounds[-1] += 1
            return solve(*given, **options)  # type: ignore[call-overload]

        monkeypatch.setattr(np.linalg, "lstsq", counted)
        for seed in range(60):
            rounds.append(0)
            skew.skew_equilibrium(0.3, [0.0008, 0.004, 0.012][seed % 3], *self.crane(seed))
        assert max(rounds) <= 8
        assert sum(rounds) <= 270

    def test_the_linear_forces_are_those_of_a_small_angle(self) -> None:
        d, coupled, weights, centre, span, rail_two = self.crane(4)
        linear = skew.skew_forces(float(skew.skew_friction(1e-8, 0.3)), d, coupled, weights, centre, span, rail_two)
        law = skew.skew_equilibrium(0.3, 1e-8, d, coupled, weights, centre, span, rail_two)
        assert law[[0, 1, 3]] == pytest.approx(linear, rel=1e-5, abs=1e-9)

    def test_the_guide_gets_other_forces_than_the_linear_ones(self) -> None:
        ratios = []
        for seed in range(400):
            given = self.crane(1000 + seed)
            angle = np.random.default_rng(seed).uniform(0.0005, 0.015)
            law = skew.skew_equilibrium(0.3, angle, *given)
            linear = skew.skew_forces(float(skew.skew_friction(angle, 0.3)), *given)
            ratios.append(np.sum(law[:2]) / np.sum(linear[:2]))
        assert min(ratios) == pytest.approx(0.934, abs=2e-3)
        assert max(ratios) == pytest.approx(1.464, abs=2e-3)


class TestPrinted:
    @pytest.mark.parametrize("coupling", COUPLINGS)
    @pytest.mark.parametrize("rail_two", [skew.FIXED, skew.MOVABLE])
    @pytest.mark.parametrize("layout", LAYOUTS)
    def test_factors_of_the_eurocode(self, layout: str, coupling: str, rail_two: str) -> None:
        """EN 1991-3, tables 2.8 and 2.9: CFF, IFF, CFM, IFM."""
        e, xi1 = LAYOUTS[layout], 0.35
        xi2, n, total = 1 - xi1, len(e), 400e3
        m = n if coupling == "C" else 0
        h = (m * xi1 * (xi2 if rail_two == skew.FIXED else 1) * SPAN**2 + sum(e**2)) / sum(e)
        guide = (1 - sum(e) / (n * h)) * (1 if rail_two == skew.FIXED else xi2)
        one = xi2 / n * (1 - e / h)
        two = xi1 / n * (1 - e / h) if rail_two == skew.FIXED else 0 * e
        along = np.full(n, xi1 * xi2 * SPAN / (n * h) if coupling == "C" else 0.0)
        coupled = np.full(n, COUPLINGS[coupling])
        found = skew.skew_forces(FRICTION, e, coupled, np.full(n, total / n), xi1, SPAN, rail_two)
        assert found == pytest.approx(FRICTION * total * np.array([one, two, along]), rel=1e-12)
        assert np.sum(found[:2]) == pytest.approx(FRICTION * total * guide, rel=1e-12)

    def test_two_free_pairs_turn_about_the_rear_axle(self) -> None:
        """The rear wheels do not slip, the guide holds half the friction."""
        d = np.array([0.0, 4.2])
        found = skew.skew_forces(0.3, d, np.zeros(2), np.full(2, 2e5), 0.5, SPAN)
        assert skew.slip_pole(d, np.zeros(2), np.full(2, 2e5), 0.5, SPAN) == pytest.approx(4.2)
        assert found[:, 1].tolist() == [0.0, 0.0, 0.0]
        assert np.sum(found[:2]) == pytest.approx(0.3 * 2e5)

    @pytest.mark.parametrize(
        ("angle", "friction"), [(0.0, 0.0), (0.001, 0.0663598), (0.005, 0.2140486), (0.015, 0.2929446)]
    )
    def test_friction(self, angle: float, friction: float) -> None:
        assert skew.skew_friction(angle, 0.3) == pytest.approx(friction, rel=1e-6)
        assert skew.skew_friction(angle, 0.2) == pytest.approx(friction * 2 / 3, rel=1e-6)


class TestAngle:
    def test_by_hand(self) -> None:
        """20 mm of play at flanges 4 m apart, a rail head of 60 mm: 3.75 + 1.5 + 1 mrad."""
        wear = skew.WEAR_SHARE["flanges"] * 0.06
        for edition in (skew.EN_13001_2, skew.EN_1991_3):
            angle = skew.skew_angle(0.02, wear, 4.0, skew.LEAST_PLAY["flanges"], edition=edition)
            assert angle == pytest.approx(3.75e-3 + 1.5e-3 + 1e-3, rel=1e-12)

    def test_editions_differ_for_little_play_only(self) -> None:
        by = {
            edition: [skew.skew_angle(x, 0.0, 1.0, 0.01, 0.0, edition) for x in (0.008, 0.012, 0.01325, 0.0134, 0.04)]
            for edition in (skew.FULL_PLAY, skew.EN_13001_2, skew.EN_1991_3)
        }
        assert by[skew.FULL_PLAY] == pytest.approx([0.008, 0.012, 0.01325, 0.0134, 0.04])
        assert by[skew.EN_13001_2] == pytest.approx([0.008, 0.012, 0.01325, 0.01005, 0.03])
        assert by[skew.EN_1991_3] == pytest.approx([0.01, 0.01, 0.01, 0.01005, 0.03])


class TestStart:
    def test_a_bridge_with_its_load_at_one_end_is_held_from_turning(self) -> None:
        """Free body in plan: drives at both rails alike, inertia at the centre of mass, couples at the wheels."""
        force, centre, base = 12e3, 0.2, 4.0
        one, two = skew.start_side_forces(force, centre, SPAN, base)
        inertia_about_rail = force * centre * SPAN
        drives_about_rail = force / 2 * SPAN
        assert (one + two) * base == pytest.approx(inertia_about_rail - drives_about_rail, rel=1e-12)
        assert one / two == pytest.approx((1 - centre) / centre)  # as the wheel loads

    def test_nothing_in_the_middle(self) -> None:
        assert skew.start_side_forces(12e3, 0.5, SPAN, 4.0) == (0.0, 0.0)
        assert not math.copysign(1, skew.start_side_forces(12e3, 0.7, SPAN, 4.0)[0]) < 0
