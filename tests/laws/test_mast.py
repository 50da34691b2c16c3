"""The column of a stacker crane against frames and beams of finite elements of our own and its equations of motion."""

import math

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.linalg import eigh, expm
from support.beams import beam, frame_tip, masted

from ptmcalc.laws import mast, mast_compliance, mast_modes
from ptmcalc.laws.mast_modes import Mast

E = 210e9
HELD = math.inf


class TestCompliance:
    @pytest.mark.parametrize("place", [8.25, 5.0, 2.0])
    @pytest.mark.parametrize("ends", ["supported", "clamped"])
    @pytest.mark.parametrize("wheels", ["free", "braked"])
    def test_bridge_travel_against_a_space_frame(self, place: float, ends: str, wheels: str) -> None:
        found = mast_compliance.bridge_travel_compliance(6.0, E, 2e-4, 16.5, 1.2e-3, 1.6e-4, 2.0, place, ends, wheels)
        expected = frame_tip(6.0, 2e-4, 16.5, 1.2e-3, 1.6e-4, 2.0, place, ends, wheels, along="bridge")
        assert found.total == pytest.approx(expected, rel=1e-4)

    @pytest.mark.parametrize("place", [8.25, 5.0, 2.0])
    @pytest.mark.parametrize("ends", ["supported", "clamped"])
    def test_trolley_travel_against_a_space_frame(self, place: float, ends: str) -> None:
        found = mast_compliance.trolley_travel_compliance(6.0, E, 2e-4, 16.5, 1.2e-3, place, ends)
        expected = frame_tip(6.0, 2e-4, 16.5, 1.2e-3, 1.6e-4, 2.0, place, ends, "free", along="trolley")
        assert found.total == pytest.approx(expected, rel=1e-4)

    def test_a_braked_trolley_is_stiffer_by_some_percent_off_the_middle_alone(self) -> None:
        """The theory's 7.9 % of one case: where the bridge bends sideways askew."""

        def stiffness(place: float, wheels: str) -> float:
            return mast_compliance.bridge_travel_compliance(
                6.0, E, 2e-4, 16.5, 1.2e-3, 1.6e-4, 2.0, place, "supported", wheels
            ).stiffness

        assert stiffness(8.25, "braked") == pytest.approx(stiffness(8.25, "free"), rel=1e-14)
        assert 1.07 < stiffness(16.5 / 4, "braked") / stiffness(16.5 / 4, "free") < 1.085


def shape(s: np.ndarray | float, b: float, gamma: float) -> np.ndarray | float:
    return gamma + b * s + (1 - b - gamma) * (3 * s**2 - s**3) / 2


class TestMasses:
    @pytest.mark.parametrize("place", [1.0, 0.6])
    def test_deflection_of_the_tip_under_even_acceleration(self, place: float) -> None:
        """Statics of a beam of finite elements under the inertia of column and load."""
        stiffness, _ = beam(6.0, 4.2e7, 0.0, 20, root_rotation=3e-8)
        inertia = np.tile([60.0, 0.0], 21)[1:]  # an even load, its moments left over at both ends
        inertia[0], inertia[-2:] = 60 * 0.3 / 12, (30.0, -60 * 0.3 / 12)
        inertia[2 * round(20 * place) - 1] += 1800.0
        parts = (216 / 3 / 4.2e7, 36 * 3e-8)
        masses = mast.consistent_masses(4000.0, 1800.0, 1200.0, 0.0, parts[1] / sum(parts), 0.0, place)
        found = mast.static_lag(7000.0, 1 / sum(parts), *masses)  # an acceleration of 1
        assert found == pytest.approx(np.linalg.solve(stiffness, inertia)[-2], rel=1e-6)

    @pytest.mark.parametrize(("b", "gamma"), [(0.0, 0.0), (0.7467, 0.0), (0.3, 0.2), (0.683, 0.142)])
    def test_integrals_of_the_shape(self, b: float, gamma: float) -> None:
        assert mast.mean_shape(b, gamma) == pytest.approx(quad(lambda s: shape(s, b, gamma), 0, 1)[0], rel=1e-12)
        square = quad(lambda s: shape(s, b, gamma) ** 2, 0, 1)[0]
        assert mast.mass_coefficient(b, gamma) == pytest.approx(square, rel=1e-12)

    @pytest.mark.parametrize("place", [1.0, 0.7, 0.4])
    def test_consistent_masses_are_integrals_too_with_the_load_below_the_tip(self, place: float) -> None:
        b, gamma, column, root = 0.3, 0.1, 1200.0, 700.0

        def f(s: float) -> float:
            return float(shape(s, b, gamma))

        def integral(g: object) -> float:
            return float(quad(g, 0, 1)[0])  # type: ignore[call-overload]

        found = mast.consistent_masses(4000.0, 1800.0, column, root, b, gamma, place)
        assert found == pytest.approx(
            (
                4000
                + column * integral(lambda s: (1 - f(s)) ** 2)
                + root * (1 - gamma) ** 2
                + 1800 * (1 - f(place)) ** 2,
                column * integral(lambda s: f(s) * (1 - f(s)))
                + root * gamma * (1 - gamma)
                + 1800 * f(place) * (1 - f(place)),
                column * integral(lambda s: f(s) ** 2) + root * gamma**2 + 1800 * f(place) ** 2,
            ),
            rel=1e-10,
        )
        assert found[0] + 2 * found[1] + found[2] == pytest.approx(4000 + 1800 + column + root, rel=1e-14)


class TestExactModes:
    @pytest.mark.parametrize("base", [HELD, 300.0, 4800.0])
    @pytest.mark.parametrize("tip", [0.0, 300.0, 4800.0])
    @pytest.mark.parametrize(
        ("rotation", "translation", "place", "guide"),
        [(0.0, 0.0, 1.0, 0.0), (3e-8, 0.0, 1.0, 0.0), (3e-8, 4e-7, 0.6, 0.0), (1e-8, 0.0, 0.8, 4e5)],
    )
    def test_against_finite_elements(
        self, base: float, tip: float, rotation: float, translation: float, place: float, guide: float
    ) -> None:
        one = Mast(6.0, 4.2e7, 1200.0, base, tip, 500.0, rotation, translation, place, 80.0, guide)
        square, _ = eigh(*masted(one, 30)[:2])
        expected = np.sqrt(np.maximum(square, 0))
        elastic = expected[1:] if math.isfinite(base) and guide == 0 else expected
        found = [mast_modes.mast_frequency(one, k) for k in (1, 2, 3)]
        assert found == pytest.approx(elastic[:3].tolist(), rel=2e-5)

    @pytest.mark.parametrize("place", [1.0])
    def test_the_modes_add_up_to_the_deflection_at_rest(self, place: float) -> None:
        one = Mast(6.0, 4.2e7, 1200.0, 4000.0, 1800.0, 500.0, 3e-8, 4e-7, place)
        lengths = 6.0 * place
        parts = (lengths**3 / 3 / 4.2e7, lengths**2 * 3e-8, 4e-7)
        b, gamma = parts[1] / sum(parts), parts[2] / sum(parts)
        masses = mast.consistent_masses(4000.0, 1800.0, 1200.0, 500.0, b, gamma, place)
        modes = [mast_modes.mode_compliance(one, k, "base") for k in range(1, 12)]
        assert sum(modes) == pytest.approx(mast.static_lag(1.0, 1 / sum(parts), *masses), rel=2e-7)
        held = Mast(6.0, 4.2e7, 1200.0, HELD, 1800.0, 500.0, 3e-8, 4e-7, place)
        assert sum(mast_modes.mode_compliance(held, k, "load") for k in range(1, 12)) == pytest.approx(
            sum(parts), rel=1e-5
        )

    def test_a_column_without_mass_is_two_masses(self) -> None:
        one = Mast(6.0, 4.2e7, 0.0, 4000.0, 1800.0)
        c = 3 * 4.2e7 / 216
        assert mast_modes.mast_frequency(one, 1) == pytest.approx(math.sqrt(c / 4000 + c / 1800), rel=1e-13)
        assert math.isinf(mast_modes.mast_frequency(one, 2))

    @pytest.mark.parametrize("unit", [4.0, 1.0, 1e-3])
    @pytest.mark.parametrize(
        ("root", "slide", "tip", "place", "top"),
        [(0.0, 0.0, 1.0, 1.0, 0.0), (0.0, 0.0, 0.0, 1.0, 1.0), (0.0, 0.0, 1.0, 0.5, 1.0), (0.0, 0.0, 1.0, 1.0, 1.0),
         (1.0, 0.7, 1.0, 0.5, 1.0), (1.0, 0.7, 1.0, 1.0, 0.0), (1.0, 0.7, 0.0, 1.0, 1.0)],
    )  # fmt: skip
    def test_a_column_without_mass_by_its_flexibility(
        self, unit: float, root: float, slide: float, tip: float, place: float, top: float
    ) -> None:
        """Points on a cantilever whose root shifts: C = slide + a^2 (3 b - a)/6, 1/w^2 are the eigenvalues of C M."""
        masses: dict[float, float] = {}
        for at, mass in ((0.0, root), (place, tip), (1.0, top)):
            if mass:
                masses[at] = masses.get(at, 0.0) + mass * unit
        at = np.array(list(masses))
        low, high = np.minimum(at[:, None], at), np.maximum(at[:, None], at)
        flexible = slide + low**2 * (3 * high - low) / 6
        expected = np.sort(np.linalg.eigvals(flexible * np.array(list(masses.values()))).real)[::-1] ** -0.5
        one = Mast(1.0, 1.0, 0.0, HELD, tip * unit, root * unit, 0.0, slide, place, top * unit)
        found = [mast_modes.mast_frequency(one, k) for k in range(1, len(at) + 2)]
        assert found[:-1] == pytest.approx(expected, rel=1e-9)
        assert math.isinf(found[-1])

    @pytest.mark.parametrize("tip", [0.25, 0.5, 1.0, 2.0, 4.0])
    @pytest.mark.parametrize("base", [0.25, 0.5, 1.0, 2.0, 4.0, HELD])
    @pytest.mark.parametrize("b", [0.0, 0.25, 0.747])
    def test_the_consistent_masses_stay_within_four_tenths_of_a_percent(
        self, tip: float, base: float, b: float
    ) -> None:
        """Acceptance of the stackers: tip and trolley of a quarter to four times the column's mass."""
        bend = 1.0 - b
        one = Mast(1.0, 1 / (3 * bend), 1.0, base, tip, root_rotation=b)
        held = math.isinf(base)
        masses = mast.consistent_masses(1.0 if held else base, tip, 1.0, 0.0, b, 0.0, 1.0)
        found = 1 / math.sqrt(masses[2]) if held else mast.consistent_frequency(1.0, *masses)
        exact = mast_modes.mast_frequency(one, 1)
        assert exact * (1 - 1e-9) <= found <= exact * 1.004

    def test_where_the_consistent_masses_are_worst(self) -> None:
        """Theory: at a clamped root with a light tip, 0.35 %."""
        one = Mast(1.0, 1 / 3, 1.0, HELD, 0.25)
        found = 1 / math.sqrt(0.25 + 33 / 140)
        assert found / mast_modes.mast_frequency(one, 1) - 1 == pytest.approx(0.00345519, rel=1e-4)


class TestMotion:
    """Two masses by their equations of motion."""

    M1, M2, C, P = 4000.0, 2083.2, 6e5, 9000.0

    def braked(self, until: float, m1: float) -> tuple[np.ndarray, np.ndarray]:
        def rates(t: float, s: np.ndarray) -> list[float]:
            x, v = s
            return [v, self.P / m1 - self.C * x * (1 / m1 + 1 / self.M2)]

        times = np.linspace(0, until, 4001)
        run = solve_ivp(rates, (0, until), [0.0, 0.0], method="DOP853", rtol=1e-12, atol=1e-15, t_eval=times)
        return run.t, run.y

    def test_largest_deflection_of_the_notes(self) -> None:
        _, (x, _) = self.braked(0.4, self.M1)
        expected = mast.notes_deflection(self.P, self.C, self.M1, 1800.0, 1200.0, 0.236)
        assert x.max() == pytest.approx(expected, rel=1e-6)
        assert 2 * mast.static_lag(self.P, self.C, self.M1, 0.0, self.M2) == pytest.approx(expected, rel=1e-14)

    @pytest.mark.parametrize("m1", [900.0, 2083.2, 9000.0])
    @pytest.mark.parametrize("share", [0.2, 0.35, 0.5, 0.8])
    def test_swing_after_the_stop(self, m1: float, share: float) -> None:
        k = mast.consistent_frequency(self.C, m1, 0.0, self.M2)
        angle = share * 2 * math.pi
        _, (x, v) = self.braked(angle / k, m1)
        amplitude = math.hypot(x[-1], v[-1] / math.sqrt(self.C / self.M2))
        most = 2 * mast.static_lag(self.P, self.C, m1, 0.0, self.M2)
        r = self.M2 / m1
        assert mast.after_stop_ratio(angle, r) == pytest.approx(amplitude / most, rel=1e-8)
        angles = mast.after_stop_ratio(np.linspace(0, 2 * np.pi, 20001), r)
        assert angles.max() == pytest.approx((1 + r) / (2 * math.sqrt(r)) if r > 1 else 1.0, rel=1e-7)

    def test_a_brake_of_the_same_force_lets_go_of_a_light_trolley(self) -> None:
        """Theory 5.5 says "held": for m_2 > m_1 the column then asks more than the brake that stopped the trolley."""
        r = 3.0
        pull = self.C * 2 * mast.static_lag(self.P, self.C, self.M2 / r, 0.0, self.M2)
        assert pull * (1 + r) / (2 * r) == pytest.approx(self.P, rel=1e-12)
        assert float(np.max(mast.after_stop_ratio(np.linspace(0, 6.3, 999), r))) > (1 + r) / (2 * r)

    @pytest.mark.parametrize("turns", [0.0, 0.3, 1.0, 1.7, 2.5])
    def test_a_force_that_rises(self, turns: float) -> None:
        def rates(t: float, s: np.ndarray) -> list[float]:
            return [s[1], (2 * np.pi) ** 2 * (min(t / turns, 1.0) - s[0])]

        if turns == 0:
            assert mast.rise_factor(0.0) == 2.0
            return
        first = solve_ivp(rates, (0, turns), [0, 0], method="DOP853", rtol=1e-12, atol=1e-14)
        x, v = first.y[:, -1]
        assert mast.rise_factor(turns) == pytest.approx(1 + math.hypot(x - 1, v / 2 / np.pi), rel=1e-9)
        assert first.y[0].max() <= float(mast.rise_factor(turns)) * (1 + 1e-9)

    @pytest.mark.parametrize("base", [4000.0, HELD])
    def test_damping_makes_the_decrement_it_is_made_of(self, base: float) -> None:
        b = mast.two_mass_damping(self.C, base, self.M2, 0.15)
        reduced = self.M2 if math.isinf(base) else base * self.M2 / (base + self.M2)
        roots = np.roots([reduced, b, self.C])
        assert -2 * np.pi * roots[0].real / abs(roots[0].imag) == pytest.approx(0.15, rel=1e-12)

    def test_root_moment(self) -> None:
        """Inertia of load and column in even deceleration, doubled."""
        a = 9000 / 7000
        column = quad(lambda s: 1200 * 6 * s, 0, 1)[0]
        assert mast.root_moment(9000.0, 7000.0, 1800.0, 1200.0, 6.0) == pytest.approx(
            2 * a * (1800 * 6 + column), rel=1e-12
        )


class TestLeaning:
    @pytest.mark.parametrize("rotation", [0.0, 3e-8])
    @pytest.mark.parametrize("place", [1.0, 0.6])
    def test_against_finite_elements(self, rotation: float, place: float) -> None:
        stiffness, _ = beam(6.0, 4.2e7, 0.0, 10, root_rotation=rotation)
        turned = round(10 * place) * 2 + (0 if rotation else -1)
        expected = np.linalg.solve(stiffness, np.eye(len(stiffness))[:, turned] * 1e4)[-2]
        found = mast.leaning(1e4, 6.0, 4.2e7, 1 / rotation if rotation else math.inf, place)
        assert found == pytest.approx(expected, rel=1e-9)


class TestGravity:
    @pytest.mark.parametrize("attitude", ["hanging", "standing"])
    @pytest.mark.parametrize("rotation", [0.0, 5e-8])
    @pytest.mark.parametrize("weight", [10.0, 2e4, 1.5e5])
    def test_exact_compliance_against_geometric_stiffness(self, attitude: str, rotation: float, weight: float) -> None:
        sign = -1 if attitude == "standing" else 1
        stiffness, _ = beam(6.0, 4.2e7, 0.0, 60, axial=sign * weight, root_rotation=rotation)
        expected = np.linalg.solve(stiffness, np.eye(len(stiffness))[:, -2])[-2]
        found = mast_compliance.weighted_tip_compliance(
            6.0, 4.2e7, 1 / rotation if rotation else math.inf, weight, attitude
        )
        assert found == pytest.approx(expected, rel=1e-7)

    @pytest.mark.parametrize("z", [0.3, 0.49, 0.51, 1.2, 1.5, 6.0])
    def test_exact_compliance_against_the_equation_of_a_beam(self, z: float) -> None:
        """Fourth derivative +-z^2 times the second over a length of 1, a clamped root, a force of 1 at the tip."""
        for attitude, sign in (("hanging", 1.0), ("standing", -1.0)):
            if sign < 0 and z > math.pi / 2:
                continue
            rate = np.eye(4, k=1)
            rate[3, 2] = sign * z * z
            ends = expm(rate)[:, 2:]  # of the second and third derivative at the root
            tip = np.array([ends[2], ends[3] - sign * z * z * ends[1]])
            expected = ends[0] @ np.linalg.solve(tip, [0.0, -1.0])
            found = mast_compliance.weighted_tip_compliance(1.0, 1.0, math.inf, z * z, attitude)
            assert found == pytest.approx(expected, rel=1e-9)

    @pytest.mark.parametrize("attitude", ["hanging", "standing"])
    @pytest.mark.parametrize("rotation", [0.0, 5e-8])
    def test_the_first_order_is_its_derivative(self, attitude: str, rotation: float) -> None:
        parts = (216 / 3 / 4.2e7, 36 * rotation)
        c, b = 1 / sum(parts), parts[1] / sum(parts)
        found = mast.gravity_stiffness(20.0, 0.0, 6.0, b, 0.0, attitude)
        exact = (
            1
            / mast_compliance.weighted_tip_compliance(
                6.0, 4.2e7, 1 / rotation if rotation else math.inf, 20.0, attitude
            )
            - c
        )
        assert found == pytest.approx(exact, rel=1e-3)

    @pytest.mark.parametrize(("b", "gamma"), [(0.0, 0.0), (0.4, 0.1)])
    def test_own_weight(self, b: float, gamma: float) -> None:
        def slope(s: float) -> float:
            return b + (1 - b - gamma) * (3 * s - 1.5 * s * s)

        work = quad(lambda s: (1 - s) * slope(s) ** 2, 0, 1)[0]
        tip = quad(lambda s: slope(s) ** 2, 0, 1)[0]
        assert mast.gravity_stiffness(300.0, 900.0, 6.0, b, gamma, "hanging") == pytest.approx(
            (300 * tip + 900 * work) / 6, rel=1e-12
        )

    def test_a_weight_that_buckles_is_refused(self) -> None:
        critical = math.pi**2 * 4.2e7 / 4 / 36
        assert mast_compliance.weighted_tip_compliance(6.0, 4.2e7, math.inf, 0.999 * critical, "standing") > 0
        with pytest.raises(ValueError, match="buckles"):
            mast_compliance.weighted_tip_compliance(6.0, 4.2e7, math.inf, 1.001 * critical, "standing")


def test_a_column_so_stiff_that_rounding_hides_its_root_swings_below_any_frequency() -> None:
    """Its root alone would swing with 10 rad/s; (E J/l^3 over the mass)^(1/2) is 1e13 times as much."""
    hidden = Mast(4.5e-8, 4.2e7, 1200.0, math.inf, 1800.0, 4000.0, 1.9e-7, 1.4e-6, 1e-10)
    assert 0 <= mast_modes.mast_frequency(hidden, 1) < 10


@pytest.mark.parametrize("attitude", [mast.HANGING, mast.STANDING])
@pytest.mark.parametrize("root", [3e7, HELD])
def test_a_tip_without_weight_is_a_cantilever_on_its_root(root: float, attitude: str) -> None:
    """l^3/(3 E J) + l^2/k, and next to it for next to no weight."""
    bare = 16.5**3 / (3 * 8e7) + 16.5**2 / root
    assert mast_compliance.weighted_tip_compliance(16.5, 8e7, root, 0.0, attitude) == pytest.approx(bare, rel=1e-14)
    assert mast_compliance.weighted_tip_compliance(16.5, 8e7, root, 1e-9, attitude) == pytest.approx(bare, rel=1e-12)
