"""Motions that ran away to 1e150 m/s: a held drum let go, and a drum that slips under a belt that presses no more."""

import math
from typing import Any

import pytest
from support.machines import report_of, scene_of

from ptmcalc.contract.report import FileReport
from ptmcalc.numerics.belt import station


def _drive(torque: str, inertia: str, ratio: float, drum: dict[str, Any], **more: Any) -> dict[str, Any]:
    motor = {"count": 2, "inertia": inertia, "mean_starting_torque": torque}
    return {"motor": motor, "gear": {"ratio": ratio}, "drum": drum} | more


UPHILL: dict[str, Any] = {
    "kind": "conveyor",
    "route": {"sections": [{"length": "3190 m", "lift": "-114 m"}, {"length": "8120 m", "lift": "1183 m"}]},
    "belt": {"mass": "14.8 kg/m", "stiffness": "96 MN"},
    "idlers": {"carry": {"line_mass": "15 kg/m"}, "return": {"line_mass": "6 kg/m"}},
    "load": {"mass": "130 kg/m"},
    "resistance": {"coefficient": 0.0155, "secondary": 1.055},
    "speed": "2.77 m/s",
    "drives": {
        "d0": _drive(
            "14 kN*m",
            "1 kg*m^2",
            19,
            {"diameter": "0.5 m", "wrap": "153 deg", "friction": 0.25, "inertia": "0.3 kg*m^2"},
        ),
        "d1": _drive(
            "24 kN*m",
            "0.066 kg*m^2",
            30.6,
            {"diameter": "1.4 m", "wrap": "229 deg", "friction": 0.46, "inertia": "0.2 kg*m^2"},
            delay="2.46 s",
        ),
    },
    "takeup": {"type": "gravity", "tension": "354 kN"},
    "scenes": [{"type": "start", "profile": {"shape": "cosine", "time": "3.73 s", "control": "torque"}}],
}
LOOSE: dict[str, Any] = {
    "kind": "conveyor",
    "route": {"length": "21.33 m", "lift": "-3.887 m"},
    "belt": {"mass": "32.76 kg/m", "stiffness": "38.85 MN"},
    "idlers": {"carry": {"line_mass": "20 kg/m"}, "return": {"line_mass": "9 kg/m"}},
    "load": {"mass": "40 kg/m"},
    "resistance": {"coefficient": 0.0333, "secondary": 1.8, "start_factor": 1.34, "speed_share": 0.1},
    "speed": "0.724 m/s",
    "drive": {
        "motor": {"count": 3, "inertia": "0.0156 kg*m^2", "mean_starting_torque": "8.3 N*m"},
        "gear": {"ratio": 20.5},
        "drum": {"diameter": "0.3 m", "wrap": "172 deg", "friction": 0.47},
    },
    "takeup": {"type": "rigid", "tension": "2.6 kN"},
    "scenes": [{"type": "start"}],
}


def sizes(report: FileReport) -> dict[str, float]:
    """Values of the tensions, which no motion of such a belt makes a thousand times the running ones."""
    return {
        load.info.name: load.estimate.value
        for load in scene_of(report).loads
        if load.info.name.startswith("tension") and math.isfinite(load.estimate.value)
    }


@pytest.mark.parametrize("data", [UPHILL, LOOSE], ids=["held drums let go", "a belt that presses no more"])
def test_no_motion_runs_away(data: dict[str, Any]) -> None:
    report = report_of(data)
    assert max(map(abs, sizes(report).values())) < 1e8
    for load in scene_of(report).loads:
        one = load.estimate
        assert not any(map(math.isnan, (one.value, one.low, one.high)))
        assert one.low <= one.value <= one.high


def test_a_belt_lost_by_its_slipping_drum_is_told_up_to_then() -> None:
    (said,) = [d for d in report_of(LOOSE).diagnostics if d.code == "NUM102"]
    assert "loses its tension on a slipping drum" in said.message
    assert "is certain" in said.message
    assert said.path == ("takeup", "tension")


@pytest.mark.parametrize("hold", [1e3, 1e30])
def test_a_drum_at_rest_that_is_let_go_within_a_step_does_not_fly_back(hold: float) -> None:
    """Held by more than it is pulled with at the start, pulled forward and free at the end: it moves forward, if at
    all, and by no more than the pull can bring about."""
    mass, pull, step = 500.0, 2e5, 0.3
    speed = station._velocity(0.0, mass, 0.0, (hold, 0.0), (-100.0, pull), step)
    assert 0 <= speed <= pull / mass * step
