"""Machines that passed although steady running, or a stop on a climb, overwhelms their drive: right values by hand."""

import math

import pytest
from support.edges import judged, load, report_on, verdict

from ptmcalc.base.diagnostic import Verdict

G = 9.81
_RAMP = "  - {{type: start, profile: {{shape: ramp, time: 5 s, control: {}}}}}\n"


def kloss(power: float, rated: float, synchronous: float, overload: float) -> tuple[float, float, float]:
    """Rated torque, breakdown torque and breakdown slip of an induction motor; speeds in rpm."""
    torque = power / (rated * math.pi / 30)
    slip = 1 - rated / synchronous
    return torque, overload * torque, slip * (overload + math.sqrt(overload**2 - 1))


def test_a_belt_that_drives_its_motor_beyond_breakdown_fails() -> None:
    """F_U by DIN 22101: 2 x 1.3 x friction of idlers and belt against the fall of belt and load."""
    found = report_on("conveyor/overhauled")
    rated, breakdown, _ = kloss(75e3, 1480, 1500, 1.6)
    friction = 0.0
    for length, lift in ((60.0, 3.0), (300.0, -70.0)):
        flat = math.sqrt(length**2 - lift**2) if lift else length
        friction += 0.018 * G * ((22 + 150) * flat + 24 / 1.2 * length + 22 * flat + 20 / 3 * length)
    force = load(found, "effective_tension", "run_loaded").value
    assert force == pytest.approx(1.3 * friction - 67 * 150 * G, rel=2e-2)
    shaft = -force * 0.4 / 23.84 * 0.94
    assert judged(found, "CNV121", "run_loaded").value.value == pytest.approx(breakdown / shaft, rel=1e-9)
    assert judged(found, "CNV122", "run_loaded").value.value == pytest.approx(shaft / rated, rel=1e-9)
    assert verdict(found, "CNV121", "run_loaded") is Verdict.FAIL
    assert judged(found, "CNV121", "run_loaded").meaning.endswith("the belt runs away")
    assert verdict(found, "CNV122", "run_loaded") is Verdict.FAIL


def test_a_belt_that_overloads_its_motor_in_steady_running_fails() -> None:
    found = report_on("conveyor/overloaded")
    rated, breakdown, slip = kloss(30e3, 1460, 1500, 2.5)
    force = load(found, "effective_tension", "run_loaded").value
    at = 1 - 0.9 * 2.5 / 0.4 * 24.46 / (1500 * math.pi / 30)  # slip at nine tenths of the belt speed
    most = breakdown if slip < at else 2 * breakdown / (at / slip + slip / at)
    assert judged(found, "CNV121", "run_loaded").value.value == pytest.approx(
        most * 24.46 * 0.95 / 0.4 / force, rel=1e-9
    )
    assert judged(found, "CNV122", "run_loaded").value.value == pytest.approx(
        force * 0.4 / 24.46 / 0.95 / rated, rel=1e-9
    )
    assert verdict(found, "CNV121", "run_loaded") is Verdict.FAIL
    assert judged(found, "CNV121", "run_loaded").meaning.endswith("the belt runs too slowly")
    assert verdict(found, "CNV121", "start_empty") is Verdict.PASS
    assert load(found, "power_motor_running", "run_loaded").value > 130e3


def test_a_chain_that_drives_its_motor_beyond_breakdown_fails() -> None:
    found = report_on("chain_drive/overhauled")
    rated, breakdown, _ = kloss(4e3, 1470, 1500, 1.8)
    force = -load(found, "static_resistance", "run_loaded").value
    assert force > 0
    arm = 8 * 0.16 / (2 * math.pi)
    shaft = force * arm / 63.96 * 0.93
    assert judged(found, "CHN130", "run_loaded").value.value == pytest.approx(breakdown / shaft, rel=1e-9)
    assert judged(found, "CHN131", "run_loaded").value.value == pytest.approx(shaft / rated, rel=1e-9)
    assert verdict(found, "CHN130", "run_loaded") is Verdict.FAIL


@pytest.mark.parametrize(
    ("file", "code"), [("conveyor/stop-runs-back", "CNV109"), ("chain_drive/stop-runs-back", "CHN129")]
)
def test_a_climb_without_backstop_and_brake_runs_back_after_its_stop(file: str, code: str) -> None:
    found = report_on(file)
    fault = judged(found, code, "stop_loaded")
    assert fault.verdict is Verdict.FAIL
    assert "runs back" in fault.reason
    assert "add `backstop: {torque: " in fault.reason


@pytest.mark.parametrize(
    ("change", "where"),
    [
        (("  - {type: stop}\n", ""), ""),
        (("  - {type: stop}\n", "  - {type: coast}\n"), "coast_loaded"),
        (("  - {type: stop}\n", "  - {type: stop, load: empty}\n"), ""),
        (("  - {type: stop}\n  - {type: start}\n", _RAMP.format("torque")), "start_loaded"),
        (("  - {type: stop}\n  - {type: start}\n", _RAMP.format("speed")), ""),
        (("scenes:\n  - {type: run}\n  - {type: stop}\n  - {type: start}\n", ""), "run_loaded"),
        (("lift: 45 m", "lift: 0 m"), ""),
    ],
)
def test_scenes_in_which_a_belt_may_run_back(change: tuple[str, str], where: str) -> None:
    found = report_on("conveyor/stop-runs-back", change)
    assert [scene.name for scene, one in found.judgements if one.code == "CNV109"] == [where] * bool(where)


@pytest.mark.parametrize(("kind", "code"), [("conveyor", "CNV109"), ("chain_drive", "CHN129")])
def test_with_a_standstill_in_the_file_it_is_checked_there(kind: str, code: str) -> None:
    change = ("  - {type: stop}\n", "  - {type: stop}\n  - {type: backstop, name: hold}\n")
    found = report_on(f"{kind}/stop-runs-back", change)
    assert [scene.name for scene, one in found.judgements if one.code == code] == ["hold"]
