"""The worked cases of a stacker's column through laws and design files: C10 (masses), C11 (trolley stopped), C12
(obstacle), C26 (ramp), C28 (weight)."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.machines import changed, load_of, loaded, report_of, scene_of
from support.stacker_masts import OVERHEAD

from ptmcalc.contract.report import LoadReport
from ptmcalc.laws import buffer, mast, mast_compliance, mast_modes
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.mast.modal import COLLISION_MODAL, MAST_MODAL

PRINTED = 1e-5
"""Six digits."""


def found(data: dict[str, Any], load: str) -> LoadReport:
    return load_of(scene_of(report_of(data)), load)


class TestC10:
    """Shares of a clamped column that move with its tip."""

    def test_integrals(self) -> None:
        m11, m12, m22 = mast.consistent_masses(0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
        assert (m11, m12, m22) == pytest.approx((0.485714, 0.139286, 0.235714), rel=PRINTED)
        assert mast.mean_shape(0.0, 0.0) == 0.375
        assert mast.mass_coefficient(1.0, 0.0) == pytest.approx(1 / 3, rel=PRINTED)
        assert mast.mass_coefficient(0.25, 0.0) == pytest.approx(0.256548, rel=PRINTED)
        assert mast.mass_coefficient(0.5, 0.0) == pytest.approx(0.279762, rel=PRINTED)
        assert mast.mass_coefficient(0.0, 0.5) == pytest.approx(0.496429, rel=PRINTED)
        assert mast.mass_coefficient(0.746665, 0.0) == pytest.approx(0.305, rel=PRINTED)

    @pytest.mark.parametrize(("ratio", "frequency"), [(0.25, 2.47669), (1.0, 1.5573), (4.0, 0.841546)])
    def test_exact_frequencies(self, ratio: float, frequency: float) -> None:
        assert mast_modes.clamped_beam_root(ratio, 1) ** 2 == pytest.approx(frequency, rel=PRINTED)

    @pytest.mark.parametrize(("b", "frequency"), [(0.25, 1.33738), (0.747, 0.76287)])
    def test_a_root_that_turns(self, b: float, frequency: float) -> None:
        """In units of the beam, tip mass as heavy as it; the share b of the tip's deflection by the root."""
        one = mast_modes.Mast(1.0, 1.0, 1.0, math.inf, 1.0, root_rotation=b / (1 - b) / 3)
        assert mast_modes.mast_frequency(one, 1) == pytest.approx(frequency, rel=2e-3 if b > 0.5 else 2e-5)

    @pytest.mark.parametrize(
        ("ratio", "root"), [(0.0, 1.8751), (0.2, 1.6164), (0.5, 1.42), (1.0, 1.2479), (2.0, 1.0762), (5.0, 0.87)]
    )
    def test_roots_of_the_standards_list(self, ratio: float, root: float) -> None:
        assert mast_modes.clamped_beam_root(ratio, 1) == pytest.approx(root, abs=5.1e-5)


class TestC11:
    """A trolley of 4 t with 1.8 t at the tip of a column of 1.2 t, stopped by 9 kN from 1 m/s."""

    def test_frequency(self) -> None:
        frequency = found(OVERHEAD, "natural_frequency[1]")
        assert frequency.estimate.low == pytest.approx(21.0059, rel=3e-6)  # its weight only makes it stiffer
        assert frequency.formula is not None
        assert frequency.formula.value == pytest.approx(20.9289, rel=3e-6)
        masses = mast.consistent_masses(4000.0, 1800.0, 1200.0, 0.0, 0.0, 0.0, 1.0)
        assert mast.consistent_frequency(6e5, *masses) == pytest.approx(21.007, rel=3e-6)

    def test_deflection_and_force(self) -> None:
        swing = found(OVERHEAD, "mast_deflection_max")
        assert swing.solver == "mast_two_mass"
        assert swing.estimate.value == pytest.approx(0.00964286, rel=PRINTED)
        assert swing.estimate.low <= 0.00964556 <= swing.estimate.high  # finite elements
        assert swing.formula is not None
        assert swing.formula.value == pytest.approx(0.0102735, rel=PRINTED)
        force = found(OVERHEAD, "mast_force_max")
        assert force.estimate.value == pytest.approx(5785.71, rel=PRINTED)
        assert force.formula is not None
        assert force.formula.value == pytest.approx(6164.12, rel=PRINTED)

    def test_the_modes_give_what_finite_elements_gave(self) -> None:
        spec = loaded(OVERHEAD).spec
        assert isinstance(spec, Stacker)
        run = MAST_MODAL.run(spec, spec.all_scenes[0], MAST_MODAL.always, 0)
        assert run.loads["mast_deflection_max"].estimate.value == pytest.approx(0.00964556, rel=2e-5)

    def test_balanced_lumping_of_the_case_by_the_laws(self) -> None:
        m1, m2 = 4916.8, 2083.2
        omega = mast.consistent_frequency(6e5, m1, 0.0, m2)
        assert omega == pytest.approx(20.2497, rel=PRINTED)
        most = 2 * mast.static_lag(9000.0, 6e5, m1, 0.0, m2)
        assert most == pytest.approx(0.008928, rel=PRINTED)
        damping = mast.two_mass_damping(6e5, m1, m2, 0.15)  # the case takes the undamped period for the damped one
        assert damping * math.hypot(1.0, 0.15 / 2 / math.pi) == pytest.approx(1414.73, rel=PRINTED)

    def test_damped_run_and_stop_of_the_balanced_lumping(self) -> None:
        lumped = changed(
            OVERHEAD,
            trolley__mass="4916.8 kg",
            load="1283.2 kg",
            column__mass="1 kg",
            column__log_decrement=0.15,
            effects={"mast_gravity": "off"},
        )
        spec = loaded(lumped).spec
        assert isinstance(spec, Stacker)
        run = MAST_MODAL.run(spec, spec.all_scenes[0], MAST_MODAL.always, 0)
        assert run.loads["mast_deflection_max"].estimate.value == pytest.approx(0.00860536, rel=2e-4)
        assert run.loads["brake_time"].estimate.value == pytest.approx(0.778533, rel=2e-4)


C12: dict[str, Any] = changed(
    OVERHEAD,
    trolley__mass="5 t",
    load="1500 kg",
    cab=None,
    column__mass="1 g",
    trolley_travel={"speed": "0.8 m/s", "braking_force": "4 kN"},
    obstacle={"contact": "elastic", "stiffness": "30 MN/m"},
    scenes=[{"type": "obstacle", "mechanism": "trolley"}],
    effects={"mast_gravity": "off"},
)


class TestC12:
    """5 t on top and 2.1 t at the far end of a column of 600 kN/m, run into an obstacle at 0.8 m/s, brake on 4 kN."""

    def test_column_force(self) -> None:
        force = found(C12, "collision_force")
        assert force.estimate.value == pytest.approx(46302.6, rel=2e-4)
        assert force.estimate.high <= 0.8 * math.sqrt(6e5 * 7100)
        assert force.formula is not None
        assert force.formula.value == pytest.approx(48367.9, rel=PRINTED)

    def test_contact_force(self) -> None:
        force = found(C12, "contact_force")
        assert force.estimate.value == pytest.approx(275804, rel=2e-3)
        assert force.formula is not None
        assert force.formula.value == pytest.approx(0.8 * math.sqrt(3e7 * 2100), rel=1e-6)

    def test_a_tip_that_stops_dead(self) -> None:
        """The case's contact is a damper: 0.4 % below the closed form, which is exact for a tip that stays."""
        spec = loaded(changed(C12, obstacle={"contact": "plastic"}, column__mass="20 kg")).spec
        assert isinstance(spec, Stacker)
        run = COLLISION_MODAL.run(spec, spec.all_scenes[0], COLLISION_MODAL.always, 0)
        force = run.loads["collision_force"].estimate.value
        assert force == pytest.approx(40000.0, rel=5e-3)
        assert force == pytest.approx(39835.3, rel=1e-2)
        assert buffer.collision_force(5e3, 2.1e3, 6e5, 0.8, 4e3, "tip_stopped") == pytest.approx(40000.0, rel=1e-12)

    def test_a_buffer_at_the_tip(self) -> None:
        stiffness = buffer.series_stiffness(6e5, 3e5)
        force = buffer.collision_force(5e3, 2.1e3, stiffness, 0.8, 4e3, "tip_stopped")
        assert force == pytest.approx(21612.5, rel=PRINTED)


class TestC26:
    """A column whose base keeps to a ramp: 3/8 of it bends it, and a force that rises swings it less than twice."""

    def test_distributed_inertia(self) -> None:
        data = changed(
            OVERHEAD,
            trolley_travel={"speed": "2 m/s", "deceleration": "0.5 m/s^2"},
            effects={"mast_gravity": "off"},
        )
        swing = found(data, "mast_deflection_max")
        assert swing.estimate.value == pytest.approx(2 * 0.5 * (1800 + 3 / 8 * 1200) / 6e5, rel=1e-9)

    @pytest.mark.parametrize("turns", [0.3, 0.8, 1.6])
    def test_a_force_that_rises(self, turns: float) -> None:
        masses = mast.consistent_masses(4000.0, 1800.0, 1200.0, 0.0, 0.0, 0.0, 1.0)
        period = 2 * math.pi / mast.consistent_frequency(6e5, *masses)
        data = changed(
            OVERHEAD,
            trolley_travel={"speed": "3 m/s", "braking_force": "9 kN", "braking_rise": f"{turns * period:.9g} s"},
            effects={"mast_gravity": "off"},
        )
        lag = mast.static_lag(9000.0, 6e5, *masses)
        found_swing = found(data, "mast_deflection_max").estimate
        assert found_swing.value == pytest.approx(lag * float(mast.rise_factor(turns)), rel=1e-6)


class TestC28:
    """Weight on a clamped column: 6 P/(5 l) and 3 G/(8 l)."""

    def test_first_order(self) -> None:
        assert mast.gravity_stiffness(1000.0, 0.0, 6.0, 0.0, 0.0, "hanging") == pytest.approx(1.2 * 1000 / 6)
        assert mast.gravity_stiffness(0.0, 1000.0, 6.0, 0.0, 0.0, "standing") == pytest.approx(-0.375 * 1000 / 6)

    @pytest.mark.parametrize(("attitude", "sign"), [("hanging", 1.0), ("standing", -1.0)])
    def test_the_beam_under_axial_force_by_its_equation(self, attitude: str, sign: float) -> None:
        """E J y'' = (l - x) +- P (Y - y): shot from the root to where the tip is at Y."""
        length, bending, weight = 6.0, 4.2e7, 2e5

        def tip(top: float) -> float:
            run = solve_ivp(
                lambda x, y: [y[1], ((length - x) - sign * weight * (top - y[0])) / bending],
                (0, length),
                [0.0, 0.0],
                method="DOP853",
                rtol=1e-11,
                atol=1e-16,
            )
            return float(run.y[0, -1]) - top

        offsets = np.array([tip(0.0), tip(1e-6)])
        expected = -offsets[0] * 1e-6 / (offsets[1] - offsets[0])
        assert mast_compliance.weighted_tip_compliance(length, bending, math.inf, weight, attitude) == pytest.approx(
            expected, rel=1e-7
        )
