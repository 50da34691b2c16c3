"""The column of a stacker crane through design files: effects on both sides of their thresholds, and what a file that
asks for the impossible is told."""

import math
from typing import Any

import numpy as np
import pytest
from support.bars import claim_of
from support.machines import changed, load_of, loaded, report_of, scene_of
from support.stacker_masts import OVERHEAD, RACK
from support.stopped_mast import stop, stopped

from ptmcalc.contract.report import SceneReport
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.laws.mast_modes import Mast, mast_frequency
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.mast.modal import COLLISION_MODAL, MAST_MODAL

TYPES = {one.type: one for one in load_kind("crane").types}


def criterion(data: dict[str, Any], effect: str) -> tuple[float, bool]:
    """The number of an effect in the first scene, and whether it calls for it."""
    spec = loaded(data).spec
    assert spec is not None
    plan = plan_scene(TYPES[data["type"]], spec, spec.all_scenes[0])
    planned = next(one for one in plan.effects if one.effect.name == effect)
    assert planned.criterion is not None
    return planned.criterion.value, planned.criterion.exceeded


def verdict(data: dict[str, Any], code: str) -> str:
    scene: SceneReport = scene_of(report_of(data), "")
    return next(one.verdict for one in scene.checks if one.code == code)


HIT = changed(
    OVERHEAD,
    obstacle={"contact": "elastic", "stiffness": "10 MN/m"},
    scenes=[{"type": "obstacle", "mechanism": "trolley"}],
)


class TestThresholds:
    @pytest.mark.parametrize(
        ("effect", "below", "above"),
        [
            ("mast_flexibility", {"trolley_travel__braking_rise": "2.5 s"}, {"trolley_travel__braking_rise": "1.5 s"}),
            ("column_mass", {"column__mass": "80 kg"}, {"column__mass": "100 kg"}),
            ("column_modes", {"trolley_travel__braking_rise": "0.2 s"}, {"trolley_travel__braking_rise": "0.1 s"}),
            ("mast_gravity", {"column__stiffness": "110 kN/m"}, {"column__stiffness": "90 kN/m"}),
            ("brake_sticking", {"trolley__mass": "2 t"}, {"trolley__mass": "1.1 t"}),
        ],
    )
    def test_a_stop_on_both_sides(self, effect: str, below: dict[str, Any], above: dict[str, Any]) -> None:
        assert not criterion(changed(OVERHEAD, **below), effect)[1]
        assert criterion(changed(OVERHEAD, **above), effect)[1]

    def test_a_guide_on_both_sides(self) -> None:
        assert criterion(RACK, "top_guide") == (0.0, False)
        weak, stiff = ({"column__top_guide": {"stiffness": f"{k} kN/m"}} for k in (10, 100))
        assert not criterion(changed(RACK, **weak), "top_guide")[1]
        assert criterion(changed(RACK, **stiff), "top_guide")[1]

    def test_a_contact_on_both_sides(self) -> None:
        assert criterion(HIT, "obstacle_contact")[1]
        creeping = changed(HIT, scenes=[{"type": "obstacle", "mechanism": "trolley", "speed_share": 0.01}])
        assert not criterion(creeping, "obstacle_contact")[1]
        pushed = changed(HIT, scenes=[{"type": "obstacle", "mechanism": "trolley", "drive": "on"}])
        assert math.isinf(criterion(pushed, "obstacle_contact")[0])


class TestVerdicts:
    """Limits between a run with an effect and one without it."""

    def test_column_modes(self) -> None:
        tight = changed(OVERHEAD, checks={"mast_deflection": "9.644 mm"}, effects={"mast_gravity": "off"})
        assert verdict(tight, "CRN251") == "fail"  # 9.6456 mm; two masses make 9.6429
        assert verdict(changed(tight, effects__column_modes="off"), "CRN251") == "pass"

    def test_weights(self) -> None:
        with_them, without = (
            load_of(
                scene_of(report_of(changed(RACK, effects={"mast_gravity": word}, accuracy="0.1 %")), ""),
                "mast_deflection_max",
            )
            for word in ("on", "off")
        )
        assert with_them.estimate.low > without.estimate.high  # a column that stands is softer
        limit = (with_them.estimate.low + without.estimate.high) / 2
        tight = changed(RACK, checks={"mast_deflection": f"{limit * 1e3:.9g} mm"})
        assert verdict(tight, "CRN251") == "fail"
        assert verdict(changed(tight, effects={"mast_gravity": "off"}), "CRN251") == "pass"

    def test_a_head_that_is_guided(self) -> None:
        free = load_of(scene_of(report_of(RACK), ""), "mast_deflection_max").estimate
        tight = changed(RACK, checks={"mast_deflection": f"{free.low / 2 * 1e3:.9g} mm"})
        assert verdict(tight, "CRN251") == "fail"
        guided = changed(tight, column__top_guide={"stiffness": "2 MN/m"})
        assert verdict(guided, "CRN251") == "pass"


class TestReference:
    """A trolley that is stopped and held, without damping, by finite elements and modes of another hand."""

    MASSES = ((4000.0, 1800.0, 1200.0), (2500.0, 600.0, 1500.0), (6000.0, 3000.0, 900.0))

    @staticmethod
    def machine(base: float, load: float, column: float) -> dict[str, Any]:
        return changed(
            OVERHEAD,
            trolley__mass=f"{base} kg",
            load=f"{load - 100} kg",
            cab=None,
            carriage__mass="100 kg",
            column__mass=f"{column} kg",
            effects={"mast_gravity": "off"},
        )

    @pytest.mark.parametrize("masses", MASSES)
    def test_two_masses_are_two_masses(self, masses: tuple[float, float, float]) -> None:
        """The consistent matrix written out by hand from 33/140 and 3/8."""
        _, load, column = masses
        square, mean = 33 / 140 * column, 3 / 8 * column
        mass = np.array([[sum(masses), load + mean], [load + mean, load + square]])
        stiffness = np.diag([0.0, 6e5])
        mass = np.array([[1.0, 0.0], [-1.0, 1.0]]).T @ mass @ np.array([[1.0, 0.0], [-1.0, 1.0]])
        stiffness = np.array([[1.0, 0.0], [-1.0, 1.0]]).T @ stiffness @ np.array([[1.0, 0.0], [-1.0, 1.0]])
        expected = stop(stiffness, mass, 0, 1, 9000.0, 1.0)
        swing = load_of(scene_of(report_of(self.machine(*masses)), ""), "mast_deflection_max")
        assert swing.solver == "mast_two_mass"
        assert swing.estimate.value == pytest.approx(expected.deflection, rel=1e-6)

    @pytest.mark.parametrize("masses", MASSES)
    def test_elements_lie_in_the_bar_of_two_masses_and_meet_the_modes(self, masses: tuple[float, float, float]) -> None:
        base, load, column = masses
        one = Mast(6.0, 6e5 * 72, column, base, load)
        expected = stopped(one, 9000.0, 1.0, 12)
        data = self.machine(*masses)
        swing = load_of(scene_of(report_of(data), ""), "mast_deflection_max").estimate
        assert swing.low <= expected.deflection <= swing.high
        spec = loaded(data).spec
        assert isinstance(spec, Stacker)
        run = MAST_MODAL.run(spec, spec.all_scenes[0], MAST_MODAL.always, 0).loads
        assert run["mast_deflection_max"].estimate.value == pytest.approx(expected.deflection, rel=3e-4)
        assert run["brake_time"].estimate.value == pytest.approx(expected.time, rel=1e-5)


class TestSettling:
    STILL: dict[str, Any] = changed(OVERHEAD, column__log_decrement=0.15, settling={"window": "5 mm", "wait": "3 s"})

    def test_a_window_narrower_than_the_lean_at_rest_fails_with_the_reason(self) -> None:
        """1 t at 0.9 m: M l^2/(2 E J), E J = c l^3/3."""
        data = changed(self.STILL, carriage__load_arm_across="0.9 m", settling__window="1 mm")
        scene = scene_of(report_of(data), "")
        told = next(one for one in scene.checks if one.code == "CRN254")
        assert told.verdict == "fail"
        assert load_of(scene, "rest_deflection").estimate.value == pytest.approx(
            1000 * 9.81 * 0.9 * 36 / 2 / (6e5 * 72), rel=1e-9
        )
        assert "narrower than the static deflection" in _why("CRN254")

    def test_without_damping_nothing_is_told_of_it(self) -> None:
        assert verdict(changed(self.STILL, column__log_decrement=None), "CRN253") == "not_checked"

    def test_the_time_is_counted_from_the_standstill(self) -> None:
        """The swing of a held column of one shape, by its logarithm, after the stop."""
        scene = scene_of(report_of(changed(self.STILL, effects={"mast_gravity": "off"})), "")
        time = load_of(scene, "settling_time").estimate
        assert 0 < time.low <= time.value <= time.high < 3


def _why(code: str) -> str:
    return next(check.why for check in TYPES["overhead_stacker"].checks if check.code == code)


class TestCollision:
    def test_the_bound_stands_below_the_simulation(self) -> None:
        scene = scene_of(report_of(HIT), "")
        force = load_of(scene, "collision_force")
        most = 1.0 * math.sqrt(6e5 * 7000)
        assert force.solver == "collision_modal"
        assert 0.5 * most < force.estimate.value < most
        assert force.formula is not None
        assert force.formula.name == "obstacle_energy"

    def test_both_readings_of_the_notes_stand_beside_it(self) -> None:
        """They differ by the energy of the load and of 3/8 of the column, 9 kN of brake in both."""
        force = load_of(scene_of(report_of(HIT), ""), "collision_force")
        dead, whole = force.formulas
        assert (dead.name, whole.name) == ("obstacle_tip_stopped", "obstacle_energy")
        squares = [(one.value + 9000.0) ** 2 - 9000.0**2 for one in (dead, whole)]
        assert squares[1] - squares[0] == pytest.approx(6e5 * 1.0**2 * (1800 + 0.375 * 1200), rel=1e-9)

    def test_a_limit_inside_the_bar_of_the_weights_is_told_by_a_run_with_them(self) -> None:
        spec = loaded(HIT).spec
        assert isinstance(spec, Stacker)
        plan = plan_scene(
            next(one for one in load_kind("crane").types if one.type == "overhead_stacker"), spec, spec.all_scenes[0]
        )
        plain = claim_of(plan, spec, COLLISION_MODAL, COLLISION_MODAL.always)["collision_force"]
        assert plain.bar > 5e-3 * plain.value
        inside = f"{plain.value * 1.002:.7g} N"
        scene = scene_of(report_of(changed(HIT, checks={"column_force": inside})), "")
        assert next(one.verdict for one in scene.checks if one.code == "CRN255") == "pass"
        assert load_of(scene, "collision_force").estimate.bar < 1e-3 * plain.value

    def test_a_limit_above_the_bound_needs_no_simulation_of_it(self) -> None:
        most = 1.0 * math.sqrt(6e5 * 7000)
        data = changed(HIT, checks={"column_force": f"{1.02 * most:.6g} N"})
        assert verdict(data, "CRN255") == "pass"


class TestEdges:
    def test_a_carriage_at_the_root_swings_with_the_base(self) -> None:
        data = changed(RACK, scenes=[{"type": "brake", "height": "0 m"}], effects={"mast_gravity": "off"})
        one = Mast(12.0, 210e9 * 6e-4, 1500.0, 2500.0 + 1500.0, 0.0, root_rotation=1 / 4e8)
        found = load_of(scene_of(report_of(data), ""), "natural_frequency[1]").estimate.value
        assert found == pytest.approx(mast_frequency(one, 1), rel=1e-9)
        beside = changed(data, scenes=[{"type": "brake", "height": "1 mm"}])
        near = load_of(scene_of(report_of(beside), ""), "natural_frequency[1]").estimate.value
        assert near == pytest.approx(found, rel=1e-4)

    def test_a_drive_that_stalls_bends_nothing(self) -> None:
        travel = {"speed": "1 m/s", "driving_force": "0.5 kN", "braking_force": "9 kN", "resistance": "1 kN"}
        data = changed(OVERHEAD, trolley_travel=travel, scenes=[{"type": "start", "mechanism": "trolley"}])
        scene = scene_of(report_of(data), "")
        assert not any(load.info.name.startswith("mast_") for load in scene.loads)
        assert load_of(scene, "start_time").estimate.value == math.inf

    def test_a_column_its_weights_buckle_is_undecided(self) -> None:
        report = report_of(changed(RACK, load="3000 t", checks={"mast_deflection": "100 mm"}))
        assert report.verdict in ("undecided", "fail")
        assert any("buckles" in one.message for one in report.diagnostics)


class TestNotes:
    def test_the_tool_says_when_the_coefficients_of_the_notes_are_wrong_by_more_than_five_percent(self) -> None:
        said = [one.message for one in report_of(OVERHEAD).diagnostics if "share 0.236" in one.message]
        assert len(said) == 1
        assert "deflection 6.5% too large" in said[0]
        light = changed(OVERHEAD, column__mass="200 kg")
        assert not any("share 0.236" in one.message for one in report_of(light).diagnostics)
