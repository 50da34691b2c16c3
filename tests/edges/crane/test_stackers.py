"""Faults seen in stacker cranes, each with the right value by a closed form, or as it was integrated elsewhere."""

import math
from pathlib import Path
from typing import Any

import pytest
import yaml
from support.bars import claim_of
from support.command import ROOT
from support.machines import changed, load_of, loaded, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import FileReport
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.run import settle
from ptmcalc.machines.crane.stacking.machine import model
from ptmcalc.machines.crane.stacking.machine.scenes import Stand
from ptmcalc.machines.crane.stacking.mechanisms.drive_times import DRIVE_TIMES
from ptmcalc.numerics import record

HERE = Path(__file__).parent
RACK = yaml.safe_load((ROOT / "specs" / "crane_rack_stacker.yaml").read_text("utf-8"))


def _file(name: str) -> dict[str, Any]:
    data = yaml.safe_load((HERE / f"{name}.yaml").read_text("utf-8"))
    assert isinstance(data, dict)
    return data


def _verdicts(report: FileReport, code: str) -> dict[str, str]:
    return {scene.name: str(one.verdict) for scene in report.scenes for one in scene.checks if one.code == code}


def _checked(data: dict[str, Any], *, repairs: bool = False) -> FileReport:
    return check(load_text(yaml.safe_dump(data, sort_keys=False).encode(), "case.yaml"), Options(repairs=repairs))


class TestEmptyCarriage:
    """A gear of even force stops the empty carriage hardest: 35 kN/550 kg - g, and loaded 35 kN/1550 kg - g."""

    DATA = changed(RACK, safety_gear__force="35 kN", checks__catch_deceleration="15 m/s^2")

    def test_it_is_stopped_four_times_as_hard_as_the_loaded_one(self) -> None:
        report = report_of(self.DATA)
        for name, mass in (("loaded", 1550.0), ("empty", 550.0)):
            load = load_of(scene_of(report, f"safety_gear_{name}"), "safety_gear_deceleration")
            assert load.estimate.value == pytest.approx(35e3 / mass - 9.81, rel=1e-12)

    def test_a_limit_between_fails_it_alone_and_by_default(self) -> None:
        assert _verdicts(report_of(self.DATA), "CRN292") == {"safety_gear_loaded": "pass", "safety_gear_empty": "fail"}

    def test_line_6_of_the_table_shows_runs_one_by_one(self) -> None:
        report = report_of(self.DATA)
        table = report.tables[1]
        keys = [column.key for column in table.columns]
        rows = [dict(zip(keys, row, strict=True)) for row in table.rows]
        for row in rows:
            loads = {load.info.name: load.estimate for load in scene_of(report, row["scene"]).loads}
            assert row["force"].estimate == loads[f"combination_force[{row['combination']}]"]
            assert row["column_stress"].estimate == loads["column_stress"]


def test_default_scenes_hold_the_empty_machine_where_it_may_be_worse() -> None:
    names = {scene.name for scene in report_of(RACK).scenes}
    for what in ("hoist_down", "stand", "start", "brake", "fork_push", "fork_caught", "rail", "safety_gear"):
        assert {f"{what}_loaded", f"{what}_empty"} <= names


def test_a_caught_fork_is_held_against_the_weight_the_hoist_is_built_for() -> None:
    """The ropes of an empty carriage pull less, though it is more of its own weight."""
    report = report_of(RACK)
    for name in ("fork_caught_loaded", "fork_caught_empty"):
        scene = scene_of(report, name)
        one = next(one for one in scene.checks if one.code == "CRN284")
        pull = load_of(scene, "rope_force_caught").estimate.value
        assert one.value.value == pytest.approx(pull / (1550 * 9.81), rel=1e-12)


@pytest.mark.parametrize("word", ["on", "auto"])
def test_weights_make_a_standing_column_softer(word: str) -> None:
    """A beam column under an end load P: 1/c = (tan(k l)/k - l)/P, k^2 = P/(E J); 13 069 N/m instead of 15 625."""
    data = changed(_file("gravity_not_in_stiffness"), effects__mast_gravity=word)
    weight, rigidity, length = 2600 * 9.81, 210e9 * 4285.714285714285e-8, 12.0
    k = math.sqrt(weight / rigidity)
    right = weight / (math.tan(k * length) / k - length)
    assert right == pytest.approx(13069, rel=1e-4)
    found = load_of(scene_of(report_of(data), ""), "column_stiffness").estimate
    assert found.low <= right <= found.high
    assert found.low < found.high


def test_modes_that_beat_are_in_the_bar() -> None:
    """The largest of many beats, 5.495814 mm by 32 modes: two runs with fewer modes agree on another by chance."""
    bars = []
    for accuracy in ("5 %", "1 %", "0.1 %"):
        report = report_of(changed(_file("modal_bar"), accuracy=accuracy, effects__mast_gravity="off"), ends=False)
        scene = scene_of(report, "")
        found = load_of(scene, "mast_deflection_max").estimate
        assert found.low <= 5.495814e-3 <= found.high
        bars.append(found)
    assert max(one.low for one in bars) <= min(one.high for one in bars)


class TestRepair:
    def test_the_wait_and_the_window_stay(self) -> None:
        report = _checked(_file("mast-repair"), repairs=True)
        (one,) = [one for scene in report.scenes for one in scene.checks if one.code == "CRN253" and one.repair]
        assert one.repair is not None
        assert one.repair.path == ("travel", "ramp_rise")

    @pytest.mark.parametrize("rise", [0.74, 0.76])
    def test_a_rise_of_one_period_leaves_hardly_any_swing(self, rise: float) -> None:
        """The acceleration comes up in one period of the loaded column, about 0.75 s: the swing it leaves goes to 0."""
        data = changed(_file("mast-repair"), travel__ramp_rise=f"{rise} s", carriage__own_arm="0 m")
        assert _verdicts(report_of(data), "CRN253")["brake_loaded"] == "pass"


class TestMemory:
    def test_a_ramp_of_fourteen_hours_is_told_as_ours_and_judged_as_far_as_it_can_be(self) -> None:
        report = _checked(_file("memory-hog"))
        assert _verdicts(report, "CRN204") == {"start_loaded": "fail", "start_empty": "fail"}
        assert _verdicts(report, "CRN207")["start_loaded"] == "undecided"
        assert any(one.code == "NUM103" and "memory" in one.message for one in report.diagnostics)

    def test_a_record_gives_up_beyond_its_budget(self, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setattr(record, "MOST_KEPT", 10)
        report = _checked(
            changed(_file("memory-hog"), travel__speed="200 m/s", scenes=[{"type": "brake"}], accuracy="1 %")
        )
        assert any(one.code == "NUM103" and "memory" in one.message for one in report.diagnostics)


class TestPulledThroughItsBrake:
    """The base first stands at 3.25 s; the column pulls it through its brake again until some 9 s."""

    DATA = changed(_file("modal_bar"), effects__mast_gravity="off", trolley_travel__braking_delay="0 s")

    def test_a_stop_of_five_seconds_is_not_kept(self) -> None:
        """A run with modes finds it; one by momentum, at the ends of assumed values, does not: never a pass."""
        report = _checked(changed(self.DATA, checks={"brake_time": "5 s"}), repairs=False)
        assert set(_verdicts(report, "CRN205").values()) == {"fail"}

    def test_momentum_alone_lets_no_stop_pass(self) -> None:
        """Asked for this check alone, as a repair is: the column is followed all the same."""
        data = loaded(changed(self.DATA, checks={"brake_time": "5 s"}))
        assert data.kind is not None
        assert data.spec is not None
        (check,) = (one for one in data.kind.checks if one.code == "CRN205")
        scene = plan_scene(data.kind, data.spec, data.spec.all_scenes[0])
        (ruling,) = settle(data.kind, data.spec, scene, only=check).rulings
        assert ruling.verdict is Verdict.FAIL
        momentum = claim_of(scene, data.spec, DRIVE_TIMES)["brake_time"]
        assert momentum.low < 3.25 < momentum.high == math.inf

    def test_without_damping_no_stop_is_the_last(self) -> None:
        """It has not pulled for some swings, but a column without damping swings for ever."""
        report = _checked(changed(self.DATA, checks={"brake_time": "30 s"}), repairs=False)
        assert set(_verdicts(report, "CRN205").values()) == {"undecided"}
        assert any(one.code == "NUM110" and "column.log_decrement" in one.hint for one in report.diagnostics)

    def test_with_damping_it_stands_at_once(self) -> None:
        report = _checked(changed(self.DATA, checks={"brake_time": "5 s"}, column__log_decrement=0.05), repairs=False)
        assert set(_verdicts(report, "CRN205").values()) == {"pass"}

    def test_a_light_column_never_wakes_its_base(self) -> None:
        """What swings, 1.5 t, is lighter than the 1.6 t that are braked: momentum is enough."""
        data = loaded(changed(self.DATA, trolley__mass="1600 kg", column__mass="500 kg"))
        assert data.kind is not None
        assert data.spec is not None
        scene = plan_scene(data.kind, data.spec, data.spec.all_scenes[0])
        assert claim_of(scene, data.spec, DRIVE_TIMES)["brake_time"].bounded


class TestMotorCurve:
    """A stacker that starts along a motor's curve: its mean decides nothing."""

    def _data(self, *torques: str, **changes: Any) -> dict[str, Any]:
        points = [{"speed": f"{700 * k} rpm", "torque": torque} for k, torque in enumerate(torques)]
        motor = {"inertia": "0.02 kg*m^2", "speed": "1400 rpm", "curve": {"type": "table", "points": points}}
        drive = {"motor": motor, "gear": {"ratio": 14, "efficiency": 0.9}, "brake": {"torque": "40 N*m"}}
        travel = {"speed": "2 m/s", "drive": drive, "wheel_diameter": "400 mm", "resistance": "400 N"}
        return changed({**RACK, "travel": travel}, scenes=[{"type": "start"}], settling=None, **changes)

    def test_one_below_the_resistance_stalls(self) -> None:
        """400 N at the rims are 400 x 0.2/(14 x 0.9) = 6.35 N*m; the mean is six times that."""
        assert _verdicts(report_of(self._data("70 N*m", "6.3 N*m", "80 N*m")), "CRN204") == {"start_loaded": "fail"}
        assert _verdicts(report_of(self._data("70 N*m", "6.4 N*m", "80 N*m")), "CRN204") != {"start_loaded": "fail"}

    def test_one_that_changes_passes_nothing_that_swings(self) -> None:
        (scene,) = report_of(self._data("60 N*m", "45 N*m", "40 N*m")).scenes
        found = {one.code: one.verdict for one in scene.checks}
        assert {found[code] for code in ("CRN204", "CRN207", "CRN209")} == {Verdict.UNDECIDED}
        assert any("follows a motor curve" in one.reason for one in scene.checks)

    def test_a_drive_that_pushes_on_has_the_largest_torque_of_its_curve(self) -> None:
        spec = loaded(self._data("60 N*m", "20 N*m", "40 N*m")).spec
        assert spec is not None
        (start,) = spec.all_scenes
        stand = Stand()
        even, most = (model.driving(spec, scene).size + 400 for scene in (start, stand))  # type: ignore[arg-type]
        assert most == pytest.approx(60 * 14 * 0.9 / 0.2, rel=1e-12)
        assert even == pytest.approx(35 * 14 * 0.9 / 0.2, rel=1e-2), "the mean, which textbooks start with"
