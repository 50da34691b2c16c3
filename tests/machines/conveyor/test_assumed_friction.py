"""The friction factor that a file leaves out: by the operating conditions, and lower downhill."""

from typing import Any

import pytest
from support.machines import changed, check_of, scene_of, spec_of
from support.machines import report_of as whole_report_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.engine.registry import load_kind

KIND = load_kind("conveyor")
LEVEL: dict[str, Any] = {
    "kind": "conveyor",
    "route": {"length": "400 m"},
    "belt": {"width": "1000 mm", "mass": "18 kg/m", "stiffness": "8 MN", "strength": "800 N/mm", "carcass": "textile"},
    "idlers": {
        "carry": {"pitch": "1.2 m", "set_mass": "22 kg"},
        "return": {"pitch": "3 m", "set_mass": "20 kg"},
    },
    "load": {"mass": "100 kg/m"},
    "resistance": {"secondary": 1.25},
    "speed": "2.5 m/s",
    "drive": {
        "motor": {"inertia": "2 kg*m^2", "power": "45 kW", "speed": "1480 rpm", "mean_starting_torque": "700 N*m"},
        "gear": {"ratio": 25, "efficiency": 0.95},
        "pulley": {"diameter": "800 mm", "wrap": "210 deg", "friction": 0.35, "inertia": "100 kg*m^2"},
    },
    "takeup": {"type": "gravity", "tension": "35 kN"},
    "scenes": [{"type": "run"}],
}
CASES = {
    None: (0.020, 0.017, 0.030),
    "good": (0.017, 0.017, 0.019),
    "normal": (0.020, 0.018, 0.023),
    "poor": (0.027, 0.023, 0.030),
}


def assumed(data: dict[str, Any]) -> tuple[float, float, float]:
    spec = spec_of(data)
    (one,) = [one for one in KIND.manifests[0].assumptions_of(spec) if one.path == ("resistance", "coefficient")]
    value, interval = one.value(spec), one.interval(spec)
    assert value is not None
    return value, interval.low, interval.high


@pytest.mark.parametrize("conditions", CASES)
def test_conditions_give_the_factor_and_its_interval(conditions: str | None) -> None:
    given = {"conditions": conditions} if conditions else {}
    assert assumed(changed(LEVEL, resistance=LEVEL["resistance"] | given)) == CASES[conditions]


@pytest.mark.parametrize("conditions", CASES)
def test_a_decline_may_run_lighter_than_any_of_them(conditions: str | None) -> None:
    given = {"conditions": conditions} if conditions else {}
    data = changed(LEVEL, resistance=LEVEL["resistance"] | given, route={"length": "400 m", "lift": "-30 m"})
    value, _, high = CASES[conditions]
    assert assumed(data) == (value, 0.012, high)


def test_a_motor_that_is_enough_in_good_conditions_is_too_weak_in_poor_ones() -> None:
    """45 kW for 1.25 f g L (2 m_b + m_l + m_r) v/eta: 35 kW with f = 0.017, 56 kW with 0.027."""
    verdicts = {
        conditions: check_of(
            scene_of(whole_report_of(changed(LEVEL, resistance={"secondary": 1.25, "conditions": conditions}))),
            "CNV122",
        ).verdict
        for conditions in ("good", "poor")
    }
    assert verdicts == {"good": Verdict.PASS, "poor": Verdict.FAIL}
