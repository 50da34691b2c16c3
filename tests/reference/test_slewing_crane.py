"""Slewing cranes of the worked cases, by their design files: values to the digits they are printed with."""

import math

import pytest
from support.machines import changed, load_of, report_of, scene_of
from support.slewing import COURSE, NOTES

from ptmcalc.laws import classification

HANDBOOK = {
    "brake_time": (2.5, 1e-9),
    "start_time": (8.0, 1e-9),
    "start_angle": (math.radians(48), 1e-9),
    "steady_angle": (math.radians(117), 1e-9),
    "steady_time": (9.75, 1e-9),
    "cycle_time": (20.25, 1e-9),
    "share_start": (0.395, 1e-9),
    "share_steady": (0.481, 1e-9),
    "share_brake": (0.123, 1e-9),
    "torque_start": (10360.0, 1e-9),
    "torque_steady": (3168.2, 1e-9),
    "torque_inertia_brake": (5481.0, 1e-5),
    "torque_brake": (7617.8, 1e-5),
    "torque_equivalent": (7983.7, 1e-5),
    "torque_pinion": (840.394, 1e-5),
    "torque_worm": (28.5134, 1e-5),
    "power_gearbox": (2388.73, 1e-5),
}
"""Case C07: printed in the course project, or rebuilt from it where the print has lost the formula."""


@pytest.mark.parametrize("load", HANDBOOK)
def test_the_handbook_gives_what_the_course_project_prints(load: str) -> None:
    found = load_of(scene_of(report_of(COURSE)), load).formula
    assert found is not None
    assert found.name == "handbook"
    value, tolerance = HANDBOOK[load]
    assert found.value == pytest.approx(value, rel=tolerance)


def test_exact_shares_give_the_other_equivalent_torque() -> None:
    """C07: 7983.7 N*m belong to shares of three digits, 7985.24 N*m to exact ones."""
    data = changed(COURSE, handbook__shares="exact", inertia="60826.5 kg*m^2")
    found = load_of(scene_of(report_of(data)), "torque_equivalent").formula
    assert found is not None
    assert found.value == pytest.approx(7985.24, rel=1e-6)


@pytest.mark.parametrize(
    ("rule", "factor", "inertia"),
    [
        ("eta", 1.1, 61026.4),
        ("one", 1.1, 59141.4),
        ("inverse", 1.1, 56448.6),
        ("eta", 1.2, 60626.5),
        ("one", 1.2, 58570.2),
        ("inverse", 1.2, 55632.6),
    ],
)
def test_every_reading_of_the_rotor_has_its_inertia(rule: str, factor: float, inertia: float) -> None:
    """C07: the printed 5481 N*m fix the whole inertia, and with the rule of the rotor what is left for the crane."""
    data = changed(COURSE, handbook__rotor_eta_rule=rule, gear__rotating_factor=factor, inertia=f"{inertia} kg*m^2")
    found = load_of(scene_of(report_of(data)), "torque_inertia_brake").formula
    assert found is not None
    assert found.value == pytest.approx(5481.0, rel=1e-6)


def test_torque_or_time_of_the_start_is_derived() -> None:
    """C07: 37 N*m start the crane in 1.905 s; 8 s need 17.43 N*m."""
    by_torque = load_of(scene_of(report_of(COURSE)), "start_time")
    assert by_torque.estimate.value == pytest.approx(1.90529, rel=1e-5)
    assert by_torque.note == "derived from the motor's torque"
    by_time = changed(COURSE, motor__mean_starting_torque=None, cycle__start_time="8 s")
    scene = scene_of(report_of(by_time))
    assert load_of(scene, "torque_motor_start").estimate.value == pytest.approx(17.4322, rel=1e-5)
    assert load_of(scene, "torque_start").note == "derived from the start time"


def test_the_warning_names_both_lines_and_both_consistent_values() -> None:
    (warning,) = (d for d in report_of(COURSE).diagnostics if d.code == "SPC201")
    for part in ("37 N*m and 8 s contradict each other", "1.905 s", "17.43 N*m", "5.954 kN*m", "4.871 kN*m"):
        assert part in warning.message
    assert "`motor.mean_starting_torque` in line" in warning.message
    assert "`handbook.start_time` in line" in warning.message


def test_the_consistent_equivalent_torque() -> None:
    """C07: 5953.86 N*m with the torque."""
    report = report_of(COURSE)
    assert load_of(scene_of(report), "torque_equivalent").estimate.value == pytest.approx(5953.86, rel=1e-5)


def test_inertia_start_and_brake_of_the_lecture_notes() -> None:
    """C05: masses as points, a start of 5 s, a stop of 5 s: 22.5 deg at 0.15708 rad/s."""
    scene = scene_of(report_of(NOTES))
    assert load_of(scene, "slew_inertia").estimate.value == pytest.approx(424000.0, rel=1e-9)
    assert load_of(scene, "torque_motor_start").estimate.value == pytest.approx(34.9023, rel=1e-5)
    assert load_of(scene, "brake_time").estimate.value == pytest.approx(5.0, rel=1e-5)
    assert load_of(scene, "torque_brake_required").estimate.value == pytest.approx(7.74217, rel=1e-4)


def test_the_group_of_a_load_spectrum() -> None:
    """C27: 20 000 full, 30 000 at 0.6 and 50 000 at 0.3 of the load: 0.2783, U3, Q3, A4."""
    spectrum = [{"share": 0.2, "load": 1.0}, {"share": 0.3, "load": 0.6}, {"share": 0.5, "load": 0.3}]
    data = COURSE | {"class": {"cycles": 100000, "load_spectrum": spectrum, "group": "A4"}}
    scene = scene_of(report_of(data))
    assert load_of(scene, "spectrum_factor").estimate.value == pytest.approx(0.2783, rel=1e-9)
    assert load_of(scene, "crane_group").estimate.value == 4
    assert classification.use_of_cycles(1e5) == 3
    assert classification.load_class(0.2783) == 3
    assert classification.equivalent_load(0.2783) == pytest.approx(0.652887, rel=1e-6)
