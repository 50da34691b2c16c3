"""What was asked of the chain drive: worked cases through a design file, resonance against the textbook, sweeps."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from support.chains import CH_05, FIRST, ROLLER, Reference, chain_of
from support.command import ROOT, environment, ptmcalc, python
from support.machines import changed, check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import FileReport, LoadReport
from ptmcalc.machines.chain_drive.polygon.distributed_strand import SWEEP, sweep_speeds
from ptmcalc.report import table

PRINTED = 1e-5


def one(report: FileReport, name: str) -> LoadReport:
    return load_of(scene_of(report), name)


def at(ratio: float, damping: float, **changes: Any) -> dict[str, Any]:
    """The conveyor of CH-05 with its teeth at so many times the first natural frequency."""
    speed = ratio * Reference(CH_05).first * 0.32 / (2 * math.pi)
    return changed(CH_05, speed=f"{speed!r} m/s", chain__damping={"ratio": damping}, **changes)


# --- worked cases ----------------------------------------------------------------------------------------------------


def test_ch02_kinematics() -> None:
    report = report_of(CH_05)
    expected = {
        "sprocket_speed": 1.22718,
        "speed_max": 0.513086,
        "acceleration_polygon_max": 0.240957,
        "engagement_speed": 0.392699,
        "transverse_speed": 0.19635,
    }
    for name, value in expected.items():
        assert one(report, name).estimate.value == pytest.approx(value, rel=PRINTED), name
    assert one(report, "speed_ripple").estimate.value == pytest.approx(1 - math.cos(math.pi / 8), rel=1e-12)
    assert one(report, "transverse_travel").estimate.value == pytest.approx(0.16 * math.tan(math.pi / 16), rel=1e-12)


@pytest.mark.parametrize(
    ("length", "force"), [(20.0, 4048.08), (25.0, 5060.1), (40.0, 6939.57), (60.0, 8674.46), (80.0, 11565.9)]
)
def test_ch03_the_textbook_stands_beside_the_computed_force(length: float, force: float) -> None:
    report = report_of(changed(CH_05, layout__length=f"{length} m"))
    formula = one(report, "tension_dynamic_polygon").formula
    assert formula is not None
    assert formula.name == "chain_textbook"
    assert formula.value == pytest.approx(force, rel=PRINTED)
    near = [d for d in report.diagnostics if d.code == "NUM108"]
    assert len(near) == (length in (25.0, 60.0))


def test_ch04_waves() -> None:
    report = report_of(changed(CH_05, chain__modulus="120 GPa"))
    assert one(report, "wave_speed").estimate.value == pytest.approx(979.796, rel=PRINTED)
    assert one(report, "wave_travel_time").estimate.value == pytest.approx(0.0666447, rel=PRINTED)


def test_ch05_resonance_speeds_and_the_units_of_k() -> None:
    report = report_of(CH_05)
    assert one(report, "resonance_speed_first").estimate.value == pytest.approx(FIRST, rel=PRINTED)
    for mode, speed in enumerate((1.78187, 4.603, 7.82173), 1):
        for order in (1, 2, 5):
            found = one(report, f"resonance_speed[{order},{mode}]").estimate.value
            assert found == pytest.approx(speed / order, rel=PRINTED)
    assert one(report, "frequency_ratio").estimate.value == pytest.approx(0.5 / FIRST, rel=PRINTED)
    factor = one(report, "resonance_factor_textbook")
    assert factor.estimate.value == pytest.approx(3553.92, rel=PRINTED)
    for words in ("cm2", "N/m", "3000 to 4000", "3500", "MPa"):
        assert words in factor.note
    formula = one(report, "resonance_speed_first").formula
    assert formula is not None
    assert formula.value == pytest.approx(3500 / 3553.92 * 2.56749, rel=PRINTED)


def test_ch07_an_equalising_drive_leaves_what_its_law_misses() -> None:
    data = changed(CH_05, sprocket__teeth=6, chain__pitch="400 mm", speed="0.8 m/s", sprocket__inertia="15 kg*m^2")
    plain, part, none = (
        report_of(changed(data, equalising={"residual": share}) if share is not None else data)
        for share in (None, 0.1, 0)
    )
    assert one(part, "equalising_ratio").estimate.value == pytest.approx(1.1547, rel=PRINTED)
    assert one(part, "equalising_torque").estimate.value == pytest.approx(15 * 3.0792, rel=PRINTED)
    assert one(plain, "acceleration_polygon_max").estimate.value == pytest.approx(0.877298, rel=PRINTED)
    whole = one(plain, "tension_dynamic_polygon").estimate.value
    assert one(part, "tension_dynamic_polygon").estimate.value == pytest.approx(0.1 * whole, rel=1e-9)
    assert one(none, "tension_dynamic_polygon").estimate.value == 0
    assert math.isinf(one(none, "resonance_distance").estimate.value)


def test_ch08_life() -> None:
    """60 kN and 8 kN at the drive, 14 kN and 15 kN at the tail, 8 teeth, 0.5 m/s, 82 m of chain: by the file's own
    tensions here, so that life times wear is what is compared."""
    data = changed(
        CH_05,
        chain__pin_diameter="30 mm",
        wear={"coefficient": "2.5e-12 Hz/N", "elongation": "4 %"},
        checks={"life": "1000 h"},
    )
    report = report_of(data)
    ends = (20e3, 20e3 + 0.1 * 80 * 9.81 * 40, 20e3 + 0.1 * 80 * 9.81 * 40, 20e3 + 0.1 * 280 * 9.81 * 40)
    pairs = sum(end + 80 * 0.5**2 for end in ends)
    wear = pairs * (math.pi * 0.03 / 8) * 2.5e-12 * (0.32 / 0.5)
    assert one(report, "wear_per_revolution").estimate.value == pytest.approx(wear, rel=1e-12)
    length = 80 + 8 * 0.32
    assert one(report, "life").estimate.value == pytest.approx(0.04 * 0.32 / wear * length / 0.5, rel=1e-12)
    mean = report_of(changed(data, wear__tensions="mean"))
    assert one(mean, "life").estimate.value == pytest.approx(2 * one(report, "life").estimate.value, rel=1e-12)
    assert "sum" in one(report, "life").note
    assert "mean" in one(mean, "life").note
    assert "wear life" in (shown := table.render((report,), width=120, color=False))
    assert f" {one(report, 'life').estimate.value / 3600:.0f}" in shown


# --- finite elements over the speed ----------------------------------------------------------------------------------


@pytest.mark.parametrize("ratio", [0.05, 0.1, 0.2, 1 / 3, 0.5, 0.7, 0.9, 1.0, 1.1, 1.5, 2.0, 3.0])
@pytest.mark.parametrize("damping", [0.05, 0.02])
def test_the_polygon_tension_is_that_of_finite_elements(ratio: float, damping: float) -> None:
    """To 0.5 % of the largest swing, over r = 0.05 ... 3."""
    data = at(ratio, damping, accuracy="0.5 %")
    report, force = report_of(data), Reference(data).force
    swing = max(force.max(), -force.min())
    assert one(report, "tension_dynamic_polygon").estimate.value == pytest.approx(force.max(), abs=5e-3 * swing)
    assert one(report, "tension_dynamic_polygon_min").estimate.value == pytest.approx(force.min(), abs=5e-3 * swing)


# --- resonance against the textbook ----------------------------------------------------------------------------------


@pytest.mark.parametrize("order", [1, 2, 3])
def test_in_resonance_it_fails_what_the_textbook_would_pass(order: int) -> None:
    """With 1 % of damping; the verdict blames the speed, and the safe speeds on either side are safe."""
    plain = at(1 / order, 0.01)
    load = one(report_of(plain), "tension_dynamic_polygon")
    static = one(report_of(plain), "tension_static").estimate.value + 80 * (FIRST / order) ** 2
    assert load.formula is not None
    assert load.formula.ratio is not None
    assert load.formula.ratio > 2.2
    between = 7 * math.sqrt((static + load.formula.value) * (static + load.estimate.value))
    data = changed(plain, chain__breaking_load=f"{between} N")
    report = report_of(data, repairs=True)
    assert between / (static + load.formula.value) > 7
    for code in ("CHN101", "CHN102"):
        judgement = check_of(scene_of(report), code)
        assert judgement.verdict is Verdict.FAIL
        assert judgement.blame.path == ("speed",)
    below, above = (one(report, f"safe_speed_{side}").estimate.value for side in ("below", "above"))
    assert check_of(scene_of(report), "CHN102").repair is None  # a stronger chain is no way out
    speeds = check_of(scene_of(report), "CHN101").repair
    assert speeds is not None
    assert speeds.path == ("speed",)
    assert speeds.other is not None
    low, high = sorted((speeds.value, speeds.other))
    assert low == pytest.approx(below, rel=1e-3)
    assert high == pytest.approx(above, rel=1e-3)
    assert below < FIRST / order < above
    warning = next(d for d in report.diagnostics if d.code == "NUM109")
    assert warning.path == ("speed",)
    assert f"{math.floor(below * 100) / 100:.2f}" in warning.message
    for speed in (0.999 * below, 1.001 * above):
        beside = report_of(changed(data, speed=f"{speed} m/s"))
        assert check_of(scene_of(beside), "CHN101").verdict is Verdict.PASS


def test_above_the_resonance_it_says_how_far_the_textbook_overestimates() -> None:
    report = report_of(at(1.5, 0.05))
    formula = one(report, "tension_dynamic_polygon").formula
    assert formula is not None
    assert formula.ratio is not None
    assert formula.ratio < 0.25
    note = next(d for d in report.diagnostics if d.code == "NUM107")
    assert "polygon-effect tension, maximum" in note.message
    assert "chain_textbook" in note.message


@pytest.mark.parametrize("law", ["kelvin_voigt", "hysteretic"])
def test_an_undamped_exact_resonance_is_a_fail_without_a_number(law: str, tmp_path: Path) -> None:
    data = changed(CH_05, speed=f"{FIRST} m/s", chain__damping={"ratio": 0, "law": law})
    report = report_of(data)
    assert math.isinf(one(report, "tension_dynamic_polygon").estimate.value)
    for code in ("CHN101", "CHN102", "CHN105"):
        judgement = check_of(scene_of(report), code)
        assert judgement.verdict is Verdict.FAIL
        assert judgement.blame.path == ("speed",)
    file = tmp_path / "undamped.yaml"
    file.write_text(yaml.safe_dump(data), encoding="utf-8")
    done = ptmcalc("check", file, "--format", "json")
    assert done.status == 1
    loads = {load["name"]: load for load in json.loads(done.out)["files"][0]["scenes"][0]["loads"]}
    assert loads["tension_dynamic_polygon"]["value"] is None
    assert loads["tension_dynamic_polygon"]["unbounded"] is True


def test_away_from_a_resonance_a_chain_without_damping_is_undecided_not_sound() -> None:
    report = report_of(at(0.56, 0.0))
    assert check_of(scene_of(report), "CHN102").verdict is Verdict.UNDECIDED
    assert [d.path for d in report.diagnostics if d.code == "NUM102"] == [("chain", "damping")]


# --- sweep -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("data", [CH_05, changed(CH_05, layout__takeup__type="screw", sprocket__teeth=9), ROLLER])
def test_a_sweep_has_the_peaks_of_single_checks(data: dict[str, Any]) -> None:
    data = changed(data, operating={"lowest": "0.3 m/s", "highest": "2.4 m/s"})
    course = one(report_of(data, histories=True), "tension_dynamic_polygon").history
    assert course is not None
    assert (course.over.name, course.quantity.si, len(course.times)) == ("speed", "N", SWEEP)
    assert list(course.times) == sweep_speeds(chain_of(data)).tolist()
    for index in (0, 57, 120, SWEEP - 1):
        alone = report_of(changed(data, speed=f"{course.times[index]!r} m/s"))
        assert course.values[index] == pytest.approx(
            one(alone, "tension_dynamic_polygon").estimate.value, rel=1e-12, abs=1e-12
        )
    here = course.times.index(float(data["speed"].split()[0]))
    found = one(report_of(data), "tension_dynamic_polygon").estimate.value
    assert course.values[here] == pytest.approx(found, rel=1e-12)


def test_the_sweep_in_json_is_over_the_speed_and_imports_no_scipy(tmp_path: Path) -> None:
    file = tmp_path / "chain.yaml"
    file.write_text(yaml.safe_dump(CH_05), encoding="utf-8")
    code = (
        "import sys; from ptmcalc.cli.main import main\n"
        f"sys.argv = ['ptmcalc', 'check', {str(file)!r}, '--history', '--format', 'json']\n"
        "try: main()\nexcept SystemExit: pass\n"
        "print([name for name in sys.modules if name.split('.')[0] in ('scipy', 'matplotlib')], file=sys.stderr)"
    )
    done = python("-c", code, env=environment(ROOT))
    assert done.err.strip().splitlines()[-1] == "[]"
    loads = {load["name"]: load for load in json.loads(done.out)["files"][0]["scenes"][0]["loads"]}
    course = loads["tension_dynamic_polygon"]["history"]
    assert len(course["speed"]) == len(course["value"]) == SWEEP
    assert (course["speed_unit"], course["unit"]) == ("m/s", "N")
    peak = int(np.argmax(course["value"]))
    assert course["speed"][peak] < FIRST
    assert "cm2" in loads["resonance_factor_textbook"]["note"]
    assert "note" not in loads["tension_static"]


def test_the_sweep_in_a_file_says_what_it_is_over(tmp_path: Path) -> None:
    file, target = tmp_path / "chain.yaml", tmp_path / "sweep.csv"
    file.write_text(yaml.safe_dump(CH_05), encoding="utf-8")
    assert ptmcalc("check", file, "--history", target).status == 1
    heading, *rows = target.read_text("utf-8").splitlines()
    assert heading.endswith(",time,value,over")
    assert len(rows) == SWEEP
    assert all(row.endswith(",speed") for row in rows)


# --- commands --------------------------------------------------------------------------------------------------------


def test_the_json_names_the_loads_of_steady_running() -> None:
    names = {load.info.name for load in scene_of(report_of(CH_05)).loads}
    wanted = {
        "sprocket_speed", "speed_max", "speed_ripple", "acceleration_polygon_max", "tension_static",
        "tension_dynamic_polygon", "tension_design", "wave_speed", "wave_travel_time", "resonance_speed[1,1]",
        "resonance_speed[6,3]", "resonance_speed_first", "frequency_ratio", "safety_static", "safety_dynamic",
    }  # fmt: skip
    assert wanted <= names


def test_plan_and_explain() -> None:
    spec = ROOT / "specs" / "chain_drive.yaml"
    planned = ptmcalc("plan", spec)
    assert planned.status == 0
    for effect in ("polygon", "weak_drive"):
        assert effect in planned.out
    assert "far_polygon" not in planned.out, "a take-up weight: the far end does not move the chain"
    for effect in ("polygon", "far_polygon", "weak_drive"):
        assert ptmcalc("explain", effect).status == 0
    assert "safe_speed_below" in ptmcalc("explain", "CHN101").out


def test_a_weak_chain_away_from_resonances_is_told_how_strong_it_must_be() -> None:
    report = report_of(changed(CH_05, speed="1.3 m/s", chain__breaking_load="300 kN"), repairs=True)
    judgement = check_of(scene_of(report), "CHN102")
    assert judgement.blame.path == ("chain", "breaking_load")
    assert judgement.repair is not None
    design = one(report, "tension_design").estimate.value
    assert 7 * design <= judgement.repair.value <= 1.2 * 7 * design  # what a bound alone is sure of
    stronger = report_of(changed(CH_05, speed="1.3 m/s", chain__breaking_load=f"{judgement.repair.value} N"))
    assert check_of(scene_of(stronger), "CHN102").verdict is Verdict.PASS
