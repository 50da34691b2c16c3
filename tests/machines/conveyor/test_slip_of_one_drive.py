"""A plain start names the loads of its only drive, and its slip is 0 exactly where the drum holds."""

from typing import Any

import pytest
from support.machines import changed, check_of, load_of, report_of, scene_of, template

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import SceneReport

START = changed(template(), scenes=[{"type": "start"}], checks={"slip_heat": "100 kJ"})
FAMILIES = ("tension_run_on_max", "tension_run_off_min", "slip_utilisation_max", "slip_reserve_min")


def started(**changes: Any) -> SceneReport:
    return scene_of(report_of(changed(START, **changes)))


@pytest.mark.parametrize("sag", ["auto", "off"])
@pytest.mark.parametrize("tension", ["300 kN", "20 kN"])
def test_the_only_drive_has_the_loads_of_the_belt(tension: str, sag: str) -> None:
    scene = started(takeup__tension=tension, effects={"sag": sag, "takeup_mass": "off"})
    for name in FAMILIES:
        of_drive, of_belt = load_of(scene, f"{name}[head]"), load_of(scene, name)
        assert (of_drive.estimate, of_drive.at) == (of_belt.estimate, of_belt.at), name


def test_a_drum_that_surely_holds_burns_nothing_and_no_wave_is_simulated_for_it() -> None:
    scene = started(takeup__tension="300 kN", checks__slip_heat="1 J")
    for name in ("slip_distance[head]", "slip_heat[head]"):
        assert (load_of(scene, name).estimate.low, load_of(scene, name).estimate.high) == (0.0, 0.0)
    assert check_of(scene, "CNV111").verdict is Verdict.PASS


def test_a_drum_that_slips_burns_more_than_allowed() -> None:
    scene = started(takeup__tension="20 kN", effects={"sag": "off", "takeup_mass": "off"})
    heat, way = (load_of(scene, name).estimate for name in ("slip_heat[head]", "slip_distance[head]"))
    assert way.low > 1
    assert heat.low > 100e3
    assert check_of(scene, "CNV111").verdict is Verdict.FAIL


@pytest.mark.parametrize("changes", [{"drives": "one"}, {"drives": "primary"}], ids=lambda value: value["drives"])
def test_the_drive_has_the_name_the_file_gives_it(changes: dict[str, str]) -> None:
    scene = started(drive=None, drives={changes["drives"]: START["drive"]})
    assert load_of(scene, f"slip_heat[{changes['drives']}]").estimate.value >= 0


def test_without_friction_nothing_is_said_of_slip() -> None:
    scene = started(drive__drum__friction=None)
    names = {load.info.name for load in scene.loads}
    assert "tension_run_on_max[head]" in names
    assert not any(name.startswith("slip") for name in names - {"slip"}), names
