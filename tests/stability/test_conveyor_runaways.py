"""Motions that ran away to 1e150 m/s: a held drum let go, and a drum that slips under a belt that presses no more."""

import math
from typing import Any

import pytest
from support.belt_steps import velocity
from support.machines import spec_of

from ptmcalc.machines.conveyor.waves import network


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
    "route": {"length": "21.333839489802205 m", "lift": "-3.886635041933422 m"},
    "belt": {"mass": "32.76261265006132 kg/m", "stiffness": "38853752.32217525 N"},
    "idlers": {"carry": {"line_mass": "34.16606371662035 kg/m"}, "return": {"line_mass": "9.780693103783953 kg/m"}},
    "load": {"mass": "2.5236164488601958 kg/m"},
    "resistance": {
        "coefficient": 0.033275389643701025,
        "secondary": 1.8,
        "start_factor": 1.3414874425453076,
        "speed_share": 0.09710547252380194,
    },
    "speed": "0.7237660401623984 m/s",
    "drive": {
        "motor": {"count": 3, "inertia": "0.01564321463375733 kg*m^2", "mean_starting_torque": "8.302972423758887 N*m"},
        "gear": {"ratio": 20.524639695652944},
        "drum": {"diameter": "0.3 m", "wrap": "171.79182493798294 deg", "friction": 0.47027015147817197},
    },
    "takeup": {"type": "rigid", "tension": "2607.9392746718154 N"},
    "scenes": [{"type": "start"}],
}


CARRIED = frozenset({"belt_wave", "tail_jump", "tail_mass", "coulomb_idlers", "slip"})


@pytest.mark.parametrize("data", [UPHILL, LOOSE], ids=["held drums let go", "a belt that presses no more"])
def test_no_motion_runs_away(data: dict[str, Any]) -> None:
    """No tension comes to a thousand times the running ones, and no load is beyond its bar."""
    spec = spec_of(data)
    for name, found in network.run(spec, spec.all_scenes[0], CARRIED, 0).loads.items():
        one = found.estimate
        assert not any(map(math.isnan, (one.value, one.low, one.high))), name
        assert one.low <= one.value <= one.high, name
        if name.startswith("tension") and math.isfinite(one.value):
            assert abs(one.value) < 1e8, name


def test_a_belt_lost_by_its_slipping_drum_is_told_up_to_then() -> None:
    spec = spec_of(LOOSE)
    (said,) = network.run(spec, spec.all_scenes[0], CARRIED, 0).findings
    assert said.code == "NUM102"
    assert "loses its tension on a slipping pulley" in said.message
    assert "are reliable" in said.message
    assert said.path == ("takeup", "tension")


@pytest.mark.parametrize("hold", [1e3, 1e30])
def test_a_drum_at_rest_that_is_let_go_within_a_step_does_not_fly_back(hold: float) -> None:
    """Held by more than it is pulled with at the start, pulled forward and free at the end: it moves forward, if at
    all, and by no more than the pull can bring about."""
    mass, pull, step = 500.0, 2e5, 0.3
    speed = velocity(0.0, mass, 0.0, (hold, 0.0), (-100.0, pull), step)
    assert 0 <= speed <= pull / mass * step
