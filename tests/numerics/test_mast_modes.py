"""Modes and statics of a mast against closed forms and against finite elements of another hand."""

import math

import numpy as np
import pytest
from support.mast_fem import Reference, clamped_root

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.mast.modes import Mast, frequencies, left_out, wanted
from ptmcalc.numerics.mast.parts import Column, Lump, Prop, Segment


def column(
    bending: float = 1.0, mass: float = 1.0, load: float = 0.0, length: float = 1.0, place: float | None = None, **more
) -> Column:
    lumps = (Lump(length if place is None else place, load),) if load else ()
    return Column((Segment(length, bending, mass / length),), lumps, **more)


C11 = column(bending=600e3 * 6**3 / 3, mass=1200.0, load=1800.0, length=6.0)
"""Column of the worked case of a braked trolley."""


class TestFrequencies:
    @pytest.mark.parametrize("ratio", [0.0, 0.25, 1.0, 4.0, 100.0])
    @pytest.mark.parametrize("mode", [1, 2, 3])
    def test_of_a_clamped_beam_with_a_mass(self, ratio: float, mode: int) -> None:
        found = frequencies(column(load=ratio), 3)
        exact = clamped_root(ratio, mode) ** 2
        assert found.values[mode - 1] >= exact * (1 - 1e-8)
        assert abs(found.values[mode - 1] - exact) <= found.bars[mode - 1]
        assert found.bars[mode - 1] < 1e-4 * exact

    @pytest.mark.parametrize(("ratio", "printed"), [(0.25, 2.47669), (1.0, 1.5573), (4.0, 0.841546)])
    def test_printed_in_c10(self, ratio: float, printed: float) -> None:
        assert frequencies(column(load=ratio), 1).values[0] == pytest.approx(printed, rel=3e-6)

    @pytest.mark.parametrize(("share", "printed"), [(0.25, 1.33738), (0.746665, 0.76287)])
    def test_of_a_clamp_that_turns(self, share: float, printed: float) -> None:
        """C10: the root turns by a share of the tip's deflection; mass ratio 1."""
        turn = 1 / ((1 / 3) * share / (1 - share))
        found = frequencies(column(load=1.0, root_rotation=turn), 1).values[0]
        assert found == pytest.approx(printed, rel=1e-4)

    def test_over_a_base_that_rolls_c11(self) -> None:
        assert frequencies(C11, 1, 4000.0).values[0] == pytest.approx(21.0059, rel=3e-6)

    @pytest.mark.parametrize("bending", [1e6, 1e12, 1e24])
    @pytest.mark.parametrize("count", [4, 32])
    def test_of_a_rigid_column_on_a_root_as_soft_as_a_feather(self, bending: float, count: int) -> None:
        """It shifts and turns as a rigid body: m w^2 - k, m l/2 w^2; m l/2 w^2, m l^2/3 w^2 - k_t have no determinant.

        The stiffness against bending, a trillion times that of the root, once took all digits of it.
        """
        mine = column(bending=bending, mass=3.0, length=2.0, root_translation=1e-3, root_rotation=2e-3)
        mass, spring = np.array([[3.0, 3.0], [3.0, 4.0]]), np.diag([1e-3, 2e-3])
        exact = np.sqrt(np.linalg.eigvals(np.linalg.solve(mass, spring)).real)
        assert Mast.of(mine, count).frequencies[:2] == pytest.approx(np.sort(exact), rel=2e-8)
        assert Mast.of(mine, count).gives(2.0, 2.0) == pytest.approx(1 / 1e-3 + 2.0**2 / 2e-3, rel=1e-5)

    @pytest.mark.parametrize("base", [1e-3, 1.0, 1e3])
    @pytest.mark.parametrize("pull", [0.0, 9.81, -9.81])
    def test_against_elements_of_another_hand(self, base: float, pull: float) -> None:
        """Every part there is: load below the head, a root that turns and shifts, weights."""
        mine = column(
            bending=300.0, mass=2.0, load=3.0, length=2.0, place=1.5, pull=pull, root_rotation=900.0,
            root_translation=5e3, root_mass=0.7,
        )  # fmt: skip
        other = Reference(base, 2.0, 300.0, 2.0, 3.0, 8, load_node=6, pull=pull, turn=900.0, shift=5e3, root=0.7)
        mast = Mast.of(mine, 8)
        assert mast.frequencies == pytest.approx(other.held(), rel=1e-8)
        assert mast.rolling(base)[0] == pytest.approx(other.rolling(), rel=1e-7)
        assert 1 / mast.gives(2.0, 2.0) == pytest.approx(other.tip_stiffness(), rel=1e-9)

    def test_a_column_without_mass(self) -> None:
        found = frequencies(column(bending=3.0, mass=0.0, load=4.0), 3)
        assert found.values == pytest.approx([1.5], rel=1e-8)

    @pytest.mark.parametrize("stiff", [1e20, 1e30, math.inf])
    def test_a_root_like_a_wall(self, stiff: float) -> None:
        found = frequencies(column(load=1.0, root_rotation=stiff, root_translation=stiff), 2)
        assert found.values == pytest.approx(frequencies(column(load=1.0), 2).values, rel=1e-8)

    def test_a_prop_at_the_head(self) -> None:
        """A stiff one makes it a clamped and propped beam: B = 3.926602."""
        found = frequencies(column(props=(Prop(1.0, 1e12),)), 1)
        assert found.values[0] == pytest.approx(3.92660231**2, rel=1e-6)

    def test_two_segments_of_one_kind_are_one(self) -> None:
        halves = Column((Segment(0.5, 1.0, 1.0), Segment(0.5, 1.0, 1.0)), (Lump(1.0, 1.0),))
        assert frequencies(halves, 3).values == pytest.approx(frequencies(column(load=1.0), 3).values, rel=1e-8)

    def test_rotary_inertia_of_the_load(self) -> None:
        with_it = Column((Segment(1.0, 1.0, 1.0),), (Lump(1.0, 1.0, 0.3),))
        other = Reference(1.0, 1.0, 1.0, 1.0, 1.0, 8, inertia=0.3)
        assert Mast.of(with_it, 8).frequencies == pytest.approx(other.held(), rel=1e-8)

    def test_fourth_order_of_the_elements(self) -> None:
        exact = clamped_root(1.0, 3) ** 2
        errors = [float(Mast.of(column(load=1.0), count).frequencies[2]) - exact for count in (4, 8, 16)]
        orders = [math.log2(errors[k] / errors[k + 1]) for k in range(2)]
        assert orders == pytest.approx([4.0, 4.0], abs=0.3)


class TestStatics:
    @pytest.mark.parametrize("load", [10.0, 1e3, 2e4])
    def test_weight_at_the_tip(self, load: float) -> None:
        """Hanging P/(l - tanh(kl)/k), standing P/(tan(kl)/k - l), k = (P/EJ)^(1/2)."""
        bending, length, weight = 3e5, 6.0, load * 9.81 / 10
        k = math.sqrt(weight / bending)
        for pull, exact in (
            (1.0, weight / (length - math.tanh(k * length) / k)),
            (-1.0, weight / (math.tan(k * length) / k - length)),
        ):
            mast = Mast.of(column(bending, 0.0, weight, length, pull=pull), 16)
            assert 1 / mast.gives(length, length) == pytest.approx(exact, rel=1e-5)

    def test_own_weight(self) -> None:
        """0.375 m_c g/l for a light column."""
        stiffness = [1 / Mast.of(column(1e6, 10.0, pull=pull), 8).gives(1.0, 1.0) for pull in (9.81, 0.0)]
        assert stiffness[0] - stiffness[1] == pytest.approx(0.375 * 10 * 9.81, rel=1e-3)

    def test_a_column_that_buckles_is_refused(self) -> None:
        weight = math.pi**2 / 4 * 1.001
        with pytest.raises(NumericsError, match="buckles"):
            Mast.of(column(1.0, 0.0, weight, pull=-1.0), 16)
        assert 1 / Mast.of(column(1.0, 0.0, weight / 1.003, pull=-1.0), 16).gives(1.0, 1.0) > 0

    def test_lag_behind_a_base_that_speeds_up(self) -> None:
        """l^3/(3 E J) (m_2 + 3/8 m_c)."""
        mast = Mast.of(C11, 6)
        lag = float(mast.elements.row(6.0) @ mast.flexibility @ mast.elements.carried)
        assert lag == pytest.approx((1800 + 3 / 8 * 1200) / 600e3, rel=1e-9)


class TestLeftOut:
    def test_bounds_what_a_step_excites_beyond_the_modes_kept(self) -> None:
        """All modes follow a step: each adds at most twice its static share, of which one is kept."""
        mast, base, force = Mast.of(C11, 16), 4000.0, 9000.0
        values, shapes = mast.rolling(base)
        gains = mast.elements.row(6.0) @ shapes * (mast.elements.carried @ shapes) / values**2 * force / 7000
        times = np.linspace(0, 0.6, 6001)
        whole = (gains[:, None] * (1 - np.cos(values[:, None] * times))).sum(axis=0)
        for kept in (1, 2, 3):
            part = (gains[:kept, None] * (1 - np.cos(values[:kept, None] * times))).sum(axis=0) + gains[kept:].sum()
            missed = np.abs(whole - part).max()
            bound = left_out(mast, base, 6.0, kept, 0.0, force)
            assert missed <= bound
            assert missed > bound / 3

    def test_a_slow_rise_leaves_less(self) -> None:
        mast = Mast.of(C11, 8)
        assert left_out(mast, 4000.0, 6.0, 1, 1.0, 9e3) < 0.02 * left_out(mast, 4000.0, 6.0, 1, 0.0, 9e3)

    @pytest.mark.parametrize(("rise", "count"), [(0.0, 4), (1e-3, 4), (0.05, 2), (0.5, 2), (3600.0, 2)])
    def test_modes_that_a_rise_asks_for(self, rise: float, count: int) -> None:
        """Up to 5/rise in Hz, and two at least: 100 Hz takes in 34 Hz and no more of 2.7, 33, 104, 217."""
        assert wanted(frequencies(C11, 4).values, rise) == count


class TestRefused:
    @pytest.mark.parametrize(
        "parts",
        [
            {"bending": 0.0},
            {"bending": math.nan},
            {"length": -1.0},
            {"load": math.inf},
            {"mass": -1.0},
            {"load": 1.0, "place": 1.5},
            {"root_rotation": 0.0},
            {"pull": math.nan},
        ],
    )
    def test_what_is_no_column(self, parts: dict[str, float]) -> None:
        with pytest.raises(NumericsError):
            column(**parts)

    def test_no_mass_at_all(self) -> None:
        with pytest.raises(NumericsError, match="massless mast"):
            frequencies(column(mass=0.0), 1)

    def test_a_base_without_mass(self) -> None:
        with pytest.raises(NumericsError, match="base"):
            Mast.of(C11, 4).rolling(0.0)
