"""Hard stacker cranes: racks like walls, gaps like hairs, limiters that trip at once; never a silent number."""

import math
from typing import Any

import pytest
import yaml
from support.command import ROOT
from support.machines import changed, report_of
from support.stacker_events import RACK

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.errors import NumericsError
from ptmcalc.machines.crane.stacking.mast import two_mass
from ptmcalc.numerics.mast.run import Course

SCENES = [{"type": name} for name in ("fork_caught", "fork_push", "rail", "safety_gear", "buffer")]
HARD: dict[str, dict[str, Any]] = {
    "a rack like a wall": {"rack__stiffness_vertical": "1e12 N/m", "rack__stiffness_push": "1e12 N/m"},
    "a rack like a cloth": {"rack__stiffness_vertical": "10 N/m", "rack__stiffness_push": "10 N/m"},
    "a limiter below the weight": {"hoisting__limiter": {"force": "1 kN", "reaction": "0 s"}},
    "a limiter that sleeps": {"hoisting__limiter": {"force": "16 kN", "reaction": "100 s"}},
    "a motor weaker than the load": {"hoisting__drive__largest_force": "1 N", "hoisting__drive__slope": "1 N*s/m"},
    "a motor without mass": {"hoisting__drive__reduced_mass": "1e-6 kg"},
    "a hoist that creeps": {"hoisting__speed": "1e-9 m/s"},
    "a gap like a hair": {"rail__gap": "1e-9 m"},
    "a step like a wall": {"rail__step": "199 mm"},
    "a wheel like a hill": {"base__wheel_diameter": "20 km"},
    "a machine that creeps": {"travel__speed": "1e-9 m/s"},
    "a gear that only just holds": {"safety_gear__force": "15.6960001 kN"},
    "a fork without mass": {"fork__mass": "1e-9 kg"},
    "a column like a tower": {"column__second_moment": "1e6 m^4"},
    "a column like a reed": {"column__second_moment": "1e-12 m^4"},
    "a carriage at the foot": {"carriage__highest": "1 m"},
}


@pytest.mark.parametrize("changes", HARD.values(), ids=HARD)
def test_a_hard_machine_is_told_or_computed(changes: dict[str, Any]) -> None:
    report = report_of(changed(RACK, scenes=SCENES, **changes))
    assert len(report.scenes) == len(SCENES)
    for scene in report.scenes:
        assert scene.loads
        for load in scene.loads:
            one = load.estimate
            assert not math.isnan(one.value), load.info.name
            assert one.low <= one.value <= one.high, load.info.name
        assert scene.health.get("energy_residual", 0.0) < 1e-9 or any(
            item.code == "NUM101" for item in report.diagnostics
        )


# --- work, and what rounding leaves ----------------------------------------------------------------------------------


def spec_data(name: str) -> dict[str, Any]:
    data: dict[str, Any] = yaml.safe_load((ROOT / "specs" / f"{name}.yaml").read_text("utf-8"))
    return data


def test_places_that_nearly_meet_are_said_to_be_lost() -> None:
    """The load's lowest place is 25 um above the foot: such an element is too stiff beside the column to be told."""
    data = changed(spec_data("crane_overhead_stacker"), column__foot="0.499975 m")
    report = report_of(data, budget=0.5)
    lost = [one for one in report.diagnostics if one.code == "NUM102" and "too close to each other" in one.message]
    assert lost
    checks = [one for scene in report.scenes for one in scene.checks]
    assert {one.verdict for one in checks} == {Verdict.PASS, Verdict.UNDECIDED}


def test_a_start_of_an_hour_and_a_half_costs_a_bound_no_more_than_others(monkeypatch: pytest.MonkeyPatch) -> None:
    """Seven thousand swings of the column while its base comes to speed: nobody looks at each of them for a bound."""
    steps, ours = [], two_mass.play

    def counted(*given: Any, **named: Any) -> Course:
        try:
            found = ours(*given, **named)
        except NumericsError:
            steps.append(two_mass._MOST_WORK)
            raise
        steps.append(found.record.work)
        return found

    monkeypatch.setattr(two_mass, "play", counted)
    report = report_of(changed(spec_data("crane_rack_stacker"), travel__acceleration="0.4 mm/s^2"), budget=2e-4)
    assert any(one.code == "NUM103" for one in report.diagnostics)
    assert 0 < sum(steps) <= 1e5
