"""The worked case of a main shaft with J(phi): run-up, steady cycle, run-out, flywheel (case C23).

Printed values of the case with six digits. Its steady cycle was computed with the gear's efficiency as a factor while
the motor brakes too, which happens over a third of its cycle: that is `braking: multiplies`. The exact rule
divides by it; its values stand beside, from an integration of their own.
"""

import math

import pytest
from support.machines import changed, load_of, report_of, scene_of
from support.shafts import C23, Reference

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import SceneReport
from ptmcalc.laws import motor, shaft

AS_PRINTED = changed(C23, drive__gear__braking="multiplies", accuracy="0.001 %")
EXACT = changed(C23, accuracy="0.001 %")
SIX_DIGITS = 6e-6


def scene(data: dict, name: str) -> SceneReport:  # type: ignore[type-arg]
    return scene_of(report_of(data), name)


def value(report: SceneReport, name: str) -> float:
    return load_of(report, name).estimate.value


@pytest.fixture(scope="module")
def printed() -> dict[str, SceneReport]:
    return {one.name: one for one in report_of(AS_PRINTED).scenes}


@pytest.fixture(scope="module")
def reference() -> Reference:
    return Reference(AS_PRINTED)


@pytest.mark.parametrize(
    ("stage", "name", "wanted", "tolerance"),
    [
        ("run_up", "torque_starting", 321.088, SIX_DIGITS),
        ("run_up", "acceleration_starting", 9.53626, SIX_DIGITS),
        ("run_up", "run_up_time", 0.882493, SIX_DIGITS),
        ("run_up", "run_up_angle", 4.75784, SIX_DIGITS),
        ("steady", "speed_min", 12.3294, SIX_DIGITS),
        ("steady", "speed_max", 13.6348, SIX_DIGITS),
        ("steady", "speed_mean", 12.9821, SIX_DIGITS),
        ("steady", "irregularity", 0.100557, SIX_DIGITS),
        ("steady", "work_drive", 1633.63, SIX_DIGITS),
        ("steady", "work_useful", 1413.72, SIX_DIGITS),
        ("steady", "work_loss", 219.911, SIX_DIGITS),
        ("steady", "cycle_efficiency", 0.865385, SIX_DIGITS),
        ("steady", "loss_factor", 0.134615, SIX_DIGITS),
        ("steady", "flywheel_inertia", 280.111, SIX_DIGITS),
        ("run_out", "speed_run_out", 12.3294, SIX_DIGITS),
        ("run_out", "run_out_time", 1.15839, SIX_DIGITS),
        ("run_out", "run_out_angle", 6.80656, SIX_DIGITS),
    ],
)
def test_the_printed_values(
    printed: dict[str, SceneReport], stage: str, name: str, wanted: float, tolerance: float
) -> None:
    load = load_of(printed[stage], name)
    assert load.estimate.value == pytest.approx(wanted, rel=tolerance)
    assert load.estimate.bar <= 1e-5 * wanted


def test_the_motor_of_the_case() -> None:
    rated = motor.rated_torque(5500.0, 1440 * math.pi / 30)
    slip = motor.breakdown_slip(0.04, 2.3)
    assert (rated, slip, 2.3 * rated) == pytest.approx((36.473, 0.174849, 83.8879), rel=SIX_DIGITS)
    torque = float(motor.kloss(1.0, 2.3 * rated, slip))
    assert shaft.acceleration(12 * 0.94 * torque - 35, 30.0, 0.0, 0.0) == pytest.approx(9.53626, rel=SIX_DIGITS)


def test_the_textbook_stands_beside_the_exact_flywheel(printed: dict[str, SceneReport]) -> None:
    flywheel = load_of(printed["steady"], "flywheel_inertia")
    assert flywheel.formula is not None
    assert flywheel.formula.value == pytest.approx(284.561, rel=1e-5)
    assert flywheel.formula.value == pytest.approx(flywheel.estimate.value, rel=0.35)
    assert flywheel.solver == "closed_cycle"


def test_the_balances_of_the_case(printed: dict[str, SceneReport]) -> None:
    steady, out = printed["steady"], printed["run_out"]
    assert value(steady, "cycle_efficiency") + value(steady, "loss_factor") == pytest.approx(1.0, rel=1e-12)
    energy = value(out, "kinetic_energy")
    assert value(out, "run_out_angle") == pytest.approx(energy / 335, rel=1e-9)
    assert value(out, "energy_recoverable") == pytest.approx(0.94 * 300 * energy / 335, rel=1e-6)
    for report in printed.values():
        assert report.health["energy_residual"] < 1e-9


def test_the_textbook_table_of_the_run_up(printed: dict[str, SceneReport]) -> None:
    """0.883 s with 1 ms, which is 0.06 % too long; the step of the textbook's own rule is longer."""
    formula = load_of(printed["run_up"], "run_up_time").formula
    assert formula is not None
    assert formula.name == "step_table"
    assert formula.value == pytest.approx(0.882493, rel=5e-3)


def test_the_printed_cycle_by_an_integration_of_its_own(reference: Reference) -> None:
    found = reference.cycle()
    assert (found["speed_max"], found["irregularity"]) == pytest.approx((13.6348, 0.100557), rel=SIX_DIGITS)
    assert reference.flywheel(0.02) == pytest.approx(280.111, rel=SIX_DIGITS)


def test_with_the_power_flowing_back_through_the_gear_the_cycle_is_more_even() -> None:
    steady = scene(EXACT, "steady")
    found = Reference(EXACT).cycle()
    for name in ("speed_min", "speed_max", "speed_mean", "irregularity", "torque_motor_rms"):
        assert value(steady, name) == pytest.approx(found[name], rel=1e-8), name
    assert value(steady, "speed_max") == pytest.approx(13.59577, rel=1e-6)
    assert value(steady, "irregularity") == pytest.approx(0.0977312, rel=1e-6)


def test_the_verdicts_of_the_case() -> None:
    report = report_of(C23)
    verdicts = {judgement.code: judgement.verdict for _, judgement in report.judgements}
    assert verdicts == {
        "SHF101": Verdict.PASS,
        "SHF102": Verdict.FAIL,
        "SHF103": Verdict.PASS,
        "SHF104": Verdict.PASS,
        "SHF105": Verdict.PASS,
        "SHF106": Verdict.PASS,
        "SHF107": Verdict.PASS,
    }
