"""Where a shaft stands exactly on an edge: it stops as its brake comes, or nears its speed for ever."""

import math
from typing import Any

import pytest
from support.machines import load_of, report_of, scene_of

DATA: dict[str, Any] = {
    "kind": "shaft",
    "inertia": {"type": "constant", "value": "2 kg*m^2"},
    "drive": {
        "motor": {
            "type": "linear",
            "starting_torque": "100 N*m",
            "no_load_speed": "10 rad/s",
            "rated_torque": "50 N*m",
            "largest_torque": "90 N*m",
        },
        "gear": {"ratio": 1, "efficiency": 1},
    },
}


@pytest.mark.parametrize("friction", [0.5, 1.0, 3.0, 7.0])
@pytest.mark.parametrize("beside", [0.0, 1e-16, -1e-16, 1e-12, -1e-12, 1e-6, -1e-6])
@pytest.mark.parametrize("rise", [0.0, 0.3])
def test_a_shaft_that_stops_as_its_brake_comes(friction: float, beside: float, rise: float) -> None:
    """J w/R after friction alone, whichever of the two is first by a rounding."""
    speed = 10 * (1 - friction / 100)
    time = 2 * speed / friction
    data = DATA | {
        "losses": {"torque": f"{friction!r} N*m"},
        "brake": {"torque": "50 N*m", "delay": f"{time * (1 + beside)!r} s", "rise": f"{rise!r} s"},
        "scenes": [{"type": "run_out", "from": "0 rad"}],
    }
    scene = scene_of(report_of(data))
    assert load_of(scene, "run_out_time").estimate.value == pytest.approx(time, rel=max(1e-9, 2 * abs(beside)))
    assert load_of(scene, "run_out_angle").estimate.value == pytest.approx(time * speed / 2, rel=1e-9)


def test_a_speed_that_is_neared_for_ever_takes_an_infinite_time_with_no_bar() -> None:
    data = DATA | {"scenes": [{"type": "run_up", "to": "10 rad/s"}], "checks": {"run_up_time": "1 h"}}
    scene = scene_of(report_of(data))
    for name in ("run_up_time", "run_up_angle"):
        one = load_of(scene, name).estimate
        assert (one.value, one.low, one.high, one.model) == (math.inf, math.inf, math.inf, 0.0)
