"""Teeth in a start on the curve of a motor decide checks that the start without them passes."""

from typing import Any

import numpy as np
import pytest
from support.chain_starts import built
from support.machines import check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.machines.chain_drive.speed_change.coupled_teeth import coupled_teeth, entering
from ptmcalc.machines.chain_drive.speed_change.motor_teeth import MOTOR_TEETH

SCRAPER: dict[str, Any] = {
    "kind": "chain_drive",
    "layout": {
        "type": "conveyor",
        "length": "32 m",
        "lift": "4 m",
        "load": "90 kg/m",
        "resistance": {"coefficient": 0.25, "load_coefficient": 0.5, "turn_factor": 1.1, "start_factor": 1.2},
        "takeup": {"type": "gravity", "tension": "6 kN"},
        "tail": {"teeth": 8, "inertia": "12 kg*m^2"},
    },
    "chain": {
        "pitch": "160 mm",
        "mass": "22 kg/m",
        "count": 2,
        "unevenness": 1.2,
        "breaking_load": "250 kN",
        "stiffness": "32 MN",
        "damping": {"ratio": 0.05},
    },
    "sprocket": {"teeth": 8, "inertia": "15 kg*m^2"},
    "speed": "0.787 m/s",
    "drive": {
        "motor": {
            "power": "18.5 kW",
            "poles": 4,
            "inertia": "0.12 kg*m^2",
            "speed": "1470 rpm",
            "locked_rotor_ratio": 2.2,
            "breakdown_ratio": 2.6,
        },
        "coupling_inertia": "0.01 kg*m^2",
        "gear": {"ratio": 40, "efficiency": 0.95},
    },
    "scenes": [{"type": "start"}],
}


def verdict(code: str, safety: float = 5.0, tension: str = "6 kN", teeth: str = "auto") -> Verdict:
    layout = SCRAPER["layout"] | {"takeup": {"type": "gravity", "tension": tension}}
    data = SCRAPER | {"layout": layout, "checks": {"safety_start": safety}, "effects": {"tooth_passing": teeth}}
    return check_of(scene_of(report_of(data)), code).verdict


@pytest.mark.parametrize(("safety", "teeth", "said"), [
    (7.0, "auto", Verdict.PASS),
    (8.45, "auto", Verdict.FAIL),
    (8.45, "off", Verdict.PASS),
])  # fmt: skip
def test_teeth_take_from_the_safety_of_a_start(safety: float, teeth: str, said: Verdict) -> None:
    assert verdict("CHN122", safety, teeth=teeth) is said


@pytest.mark.parametrize(("tension", "teeth", "said"), [
    ("6 kN", "auto", Verdict.PASS),
    ("3 kN", "auto", Verdict.FAIL),
    ("3 kN", "off", Verdict.PASS),
])  # fmt: skip
def test_teeth_let_a_chain_go_slack(tension: str, teeth: str, said: Verdict) -> None:
    assert verdict("CHN123", tension=tension, teeth=teeth) is said


def test_the_run_is_within_the_bound_of_both_limiting_drives() -> None:
    """The first level is the bound where it is finite: the chain stays taut by it."""
    spec = built(SCRAPER | {"layout": SCRAPER["layout"] | {"takeup": {"type": "gravity", "tension": "30 kN"}}})
    (scene,) = spec.all_scenes
    wide, close, closer = (
        MOTOR_TEETH.run(spec, scene, MOTOR_TEETH.always, level).loads["tension_dynamic_start"].estimate
        for level in range(3)
    )
    assert wide.low < close.low < close.high < wide.high
    assert closer.high - closer.low < (close.high - close.low) / 2
    assert close.low <= closer.high
    assert closer.low <= close.high


def test_a_bound_that_allows_slack_is_no_result() -> None:
    """A check on its own, as a search for a repair asks it, is decided by the run."""
    spec = built(SCRAPER)
    (scene,) = spec.all_scenes
    first, second = (MOTOR_TEETH.run(spec, scene, MOTOR_TEETH.always, level).loads for level in (0, 1))
    assert {name: one.estimate for name, one in first.items()} == {name: one.estimate for name, one in second.items()}
    data = SCRAPER | {"chain": SCRAPER["chain"] | {"breaking_load": "90 kN"}}
    one = check_of(scene_of(report_of(data, repairs=True)), "CHN122")
    assert one.repair is not None
    assert one.repair.path == ("chain", "breaking_load")
    assert 150e3 < one.repair.value < 156e3


def test_its_course_has_the_largest_tension() -> None:
    spec = built(SCRAPER)
    (scene,) = spec.all_scenes
    found = coupled_teeth(spec, scene, 0)
    assert found is not None
    times, tensions = entering(spec, scene, 0, found.lead)
    assert tensions.max() == pytest.approx(found.largest.value, rel=1e-3)
    assert times[int(np.argmax(tensions))] == pytest.approx(found.time, abs=1e-3)


def test_a_screw_takeup_keeps_the_bound() -> None:
    layout = SCRAPER["layout"] | {"takeup": {"type": "screw", "tension": "30 kN"}}
    spec = built(SCRAPER | {"layout": layout})
    (scene,) = spec.all_scenes
    assert coupled_teeth(spec, scene, 0) is None
    first, second = (
        MOTOR_TEETH.run(spec, scene, MOTOR_TEETH.always, level).loads["tension_dynamic_start"].estimate
        for level in (0, 1)
    )
    assert second.high <= first.high * 1.02
    assert load_of(scene_of(report_of(SCRAPER | {"layout": layout})), "tension_start").estimate.bounded
