"""Wheel loads against equilibria and stiffness matrices written anew."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import minimize

from ptmcalc.laws import wheel_loads

SPAN, BASE = 22.5, 4.2
G = np.array([180e3, 60e3, 245e3])  # bridge, trolley, load
Y = np.array([11.25, 3.0, 3.2])
X = np.array([0.1, 0.3, -0.2])
H = np.array([0.8, 1.9, 2.4])
FX, FY = np.array([-9e3, -3e3, 14e3]), np.array([2e3, 4e3, -11e3])
RNG = np.random.default_rng(19)


def moments(corners: np.ndarray) -> tuple[float, float, float]:
    """Sum, moment about rail 0 and moment about the middle of the wheel base of what the rails carry."""
    return (
        float(np.sum(corners)),
        float(np.sum(corners[1]) * SPAN),
        float((np.sum(corners[:, 1]) - np.sum(corners[:, 0])) * BASE / 2),
    )


class TestCorners:
    @pytest.mark.parametrize("frame", [wheel_loads.HINGED, wheel_loads.RIGID])
    def test_the_rails_hold_what_stands_on_them(self, frame: str) -> None:
        corners = wheel_loads.corner_loads(G, Y, X, FX, FY, H, SPAN, BASE, frame)
        about_rail = sum(g * y + f * h for g, y, f, h in zip(G, Y, FY, H, strict=True))
        about_middle = sum(g * x + f * h for g, x, f, h in zip(G, X, FX, H, strict=True))
        assert moments(corners) == pytest.approx((sum(G), about_rail, about_middle), rel=1e-13)

    def test_hinged_girders_are_two_beams_on_two_beams(self) -> None:
        """Free bodies: a trolley's two axles stand on two girders, each girder on both carriages, those on wheels."""
        gauge, weight, at = 2.0, 300e3, 5.5
        girders = [weight / 2 * (0.5 - 0.15 / gauge) * 2, weight / 2 * (0.5 + 0.15 / gauge) * 2]  # along: 0.15 forward
        corners = np.zeros((2, 2))
        for pull, place in zip(girders, (-gauge / 2, gauge / 2), strict=True):
            for rail, end_pull in enumerate((pull * (SPAN - at) / SPAN, pull * at / SPAN)):
                corners[rail] += [end_pull * (BASE / 2 - place) / BASE, end_pull * (BASE / 2 + place) / BASE]
        one = [np.array([v]) for v in (weight, at, 0.15, 0.0, 0.0, 1.0)]
        assert wheel_loads.corner_loads(*one, SPAN, BASE) == pytest.approx(corners, rel=1e-13)

    def test_a_rigid_frame_is_a_plate_on_four_springs(self) -> None:
        """Stiffness matrix of heave, roll and pitch on four equal springs, solved."""
        at = np.array([(y, x) for y in (0.0, SPAN) for x in (-BASE / 2, BASE / 2)])
        shape = np.column_stack([np.ones(4), at])  # sinking of a corner for heave, roll and pitch
        load = np.array([np.sum(G), np.sum(G * Y + FY * H), np.sum(G * X + FX * H)])
        sunk = np.linalg.solve(shape.T @ shape, load)
        corners = wheel_loads.corner_loads(G, Y, X, FX, FY, H, SPAN, BASE, wheel_loads.RIGID)
        assert corners.ravel() == pytest.approx(shape @ sunk, rel=1e-12)

    def test_both_frames_stray_by_a_warp(self) -> None:
        hinged, rigid = (
            wheel_loads.corner_loads(G, Y, X, FX, FY, H, SPAN, BASE, frame)
            for frame in (wheel_loads.HINGED, wheel_loads.RIGID)
        )
        warp = hinged - rigid
        assert warp == pytest.approx(warp[0, 0] * np.array([[1.0, -1.0], [-1.0, 1.0]]), rel=1e-9)
        assert abs(warp[0, 0]) > 100  # N

    def test_the_far_corner_of_a_cantilever_lifts_off(self) -> None:
        one = [np.array([v]) for v in (300e3, -4.0, 0.0, 0.0, 0.0, 0.0)]
        corners = wheel_loads.corner_loads(*one, SPAN, BASE)
        assert np.all(corners[1] < 0)
        assert np.sum(corners) == pytest.approx(300e3)


class TestRange:
    @pytest.mark.parametrize("frame", [wheel_loads.HINGED, wheel_loads.RIGID])
    def test_nothing_between_is_beyond_the_ends(self, frame: str) -> None:
        low, high = np.array([11.25, 1.2, 1.3]), np.array([11.25, 20.9, 21.1])
        given = (X, FX, FY, H, SPAN, BASE, frame)
        least, greatest = wheel_loads.corner_load_range(G, low, high, *given)
        seen = []
        for _ in range(400):
            place, along, across = RNG.uniform(0, 1), RNG.uniform(-1, 1), RNG.uniform(-1, 1)
            at = low + place * (high - low)
            seen.append(wheel_loads.corner_loads(G, at, X, along * FX, across * FY, H, SPAN, BASE, frame))
        assert np.all(least <= np.min(seen, axis=0) + 1e-6)
        assert np.all(greatest >= np.max(seen, axis=0) - 1e-6)
        assert np.max(greatest - np.max(seen, axis=0)) < 0.1 * np.max(greatest)  # and not far beyond


class TestWheels:
    POSITIONS = np.array([-2.6, -1.6, 1.5, 2.5])

    def test_balance_beams_share_evenly(self) -> None:
        wheels = wheel_loads.wheels_of_rail(60e3, 100e3, self.POSITIONS)
        assert wheels.tolist() == [30e3, 30e3, 50e3, 50e3]

    def test_a_stiff_carriage_takes_the_least_energy(self) -> None:
        """Of all loads in equilibrium those of equal springs have the least sum of squares."""
        middles = np.array([-2.1, 2.0])
        load = np.array([60e3, 100e3])
        wheels = wheel_loads.wheels_of_rail(*load, self.POSITIONS, wheel_loads.RIGID)
        found = minimize(
            lambda n: float(np.sum(n**2)),
            np.full(4, 0.4),
            constraints=[
                {"type": "eq", "fun": lambda n: np.sum(n) - np.sum(load) / 1e5},
                {"type": "eq", "fun": lambda n: n @ self.POSITIONS - load @ middles / 1e5},
            ],
            tol=1e-14,
        )
        assert wheels == pytest.approx(found.x * 1e5, rel=1e-5)
        assert np.max(wheels) > 50e3  # worse than balance beams

    def test_two_wheels_leave_no_choice(self) -> None:
        both = [
            wheel_loads.wheels_of_rail(6e4, 1e5, np.array([-2.0, 2.5]), carriage).tolist()
            for carriage in (wheel_loads.EQUALISED, wheel_loads.RIGID)
        ]
        assert both[0] == pytest.approx(both[1], rel=1e-14)


class TestSpectra:
    def test_mean_load_beside_the_cubic_mean_of_evenly_spread_loads(self) -> None:
        for ratio in np.linspace(0, 1, 41):
            cubic = quad(lambda s, r=ratio: (r + (1 - r) * s) ** 3, 0, 1)[0] ** (1 / 3)
            over = wheel_loads.mean_wheel_load(ratio, 1.0) / cubic
            assert 1 - 1e-12 <= over <= 1.08355

    @pytest.mark.parametrize("ratio", [0.0, 0.2, 0.9, 1 - 1e-9, 1.0])
    @pytest.mark.parametrize("exponent", [3.0, wheel_loads.ROLLING_CONTACT_SLOPE])
    def test_even_travel_is_an_integral(self, ratio: float, exponent: float) -> None:
        mean = quad(lambda s: (ratio + (1 - ratio) * s) ** exponent, 0, 1)[0]
        assert wheel_loads.even_travel_factor(ratio, exponent) == pytest.approx(mean, rel=1e-7)

    def test_many_places_of_the_trolley_come_near_even_travel(self) -> None:
        loads = np.linspace(40e3, 160e3, 2001)
        found = wheel_loads.wheel_spectrum_factor(loads, np.full(2001, 3.0))
        assert found == pytest.approx(wheel_loads.even_travel_factor(0.25), rel=1e-3)

    def test_a_wheel_that_always_carries_the_same_has_factor_one(self) -> None:
        assert wheel_loads.wheel_spectrum_factor(np.full(3, 7e4), np.array([1.0, 2.0, 3.0])) == 1.0
        assert wheel_loads.wheel_spectrum_factor(np.zeros(3), np.ones(3)) == 0.0

    def test_rolling_contact_by_hand(self) -> None:
        """Half the way with the full load, half with half of it."""
        k = wheel_loads.wheel_spectrum_factor(np.array([1e5, 5e4]), np.array([1.0, 1.0]))
        assert k == pytest.approx((1 + math.pow(2, -10 / 3)) / 2, rel=1e-14)
