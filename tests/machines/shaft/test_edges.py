"""Where a shaft stands exactly on an edge: it stops as its brake comes, or nears its speed for ever."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.machines import load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict

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


def _kloss(speed: float) -> float:
    """Torque of an induction motor of 4 kW, 1420 of 1500 rpm, overload 2 [N*m]."""
    synchronous, rated = 1500 * math.pi / 30, 4000 / (1420 * math.pi / 30)
    slip, rated_slip = 1 - speed / synchronous, 80 / 1500
    most = rated_slip * (2 + math.sqrt(3))
    return 4 * rated / (slip / most + most / slip) if slip else 0.0


@pytest.mark.parametrize("load", [1600.0, 300.0])
def test_an_induction_motor_holds_a_load_that_drives_the_shaft(load: float) -> None:
    """Mean torque of the load above the losses, below what the motor brakes with above its synchronous speed."""
    ratio, efficiency, loss = 24, 0.92, 120.0
    data = {
        "kind": "shaft",
        "inertia": {"type": "constant", "value": "400 kg*m^2"},
        "drive": {
            "motor": {
                "type": "induction", "power": "4 kW", "speed": "1420 rpm", "synchronous_speed": "1500 rpm",
                "overload": 2,
            },
            "motor_inertia": "0.09 kg*m^2",
            "gear": {"ratio": ratio, "efficiency": efficiency},
        },
        "load": {
            "type": "table",
            "points": [{"angle": "0 deg", "torque": "0 N*m"}, {"angle": "180 deg", "torque": f"{-load} N*m"}],
        },
        "losses": {"torque": f"{loss} N*m"},
        "checks": {"irregularity": "25 %"},
        "scenes": [{"type": "steady"}],
    }  # fmt: skip

    def rate(angle: float, state: list[float]) -> list[float]:
        speed = math.sqrt(2 * state[0])
        torque = ratio * _kloss(ratio * speed)
        driven = load * (1 - abs(angle % (2 * math.pi) / math.pi - 1)) - loss
        # the gear loses its share of whichever side gives power: a rotor that is slowed down drives it too
        for factor in (efficiency, 1 / efficiency):
            gain = (factor * torque + driven) / (400 + factor * 0.09 * ratio**2)
            if (torque - 0.09 * ratio**2 * gain >= 0) == (factor < 1):
                return [gain]
        return [0.0]

    start = 0.5 * (1505 * math.pi / 30 / ratio) ** 2
    turns = 30
    found = solve_ivp(rate, (0, 2 * math.pi * turns), [start], rtol=1e-9, atol=1e-12, max_step=0.02, dense_output=True)
    angles = np.linspace(2 * math.pi * (turns - 1), 2 * math.pi * turns, 20_001)
    speeds = np.sqrt(2 * found.sol(angles)[0])
    scene = scene_of(report_of(data))
    for name, value in (
        ("speed_max", speeds.max()),
        ("speed_min", speeds.min()),
        ("irregularity", 2 * (speeds.max() - speeds.min()) / (speeds.max() + speeds.min())),
        ("torque_motor_max", max(abs(_kloss(ratio * float(speed))) for speed in speeds[::50])),
    ):
        assert load_of(scene, name).estimate.value == pytest.approx(value, rel=2e-5), name
    assert {one.verdict for one in scene.checks if one.code == "SHF101"} == {Verdict.PASS}
