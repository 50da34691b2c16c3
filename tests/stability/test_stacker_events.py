"""Hard stacker cranes: racks like walls, gaps like hairs, limiters that trip at once; never a silent number."""

import math
from typing import Any

import pytest
from support.machines import changed, report_of
from support.stacker_events import RACK

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
