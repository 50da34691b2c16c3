"""The simulated starts and stops of a travelling crane and their second method: one value for every kind of drive.

Below them what the second method has found wrong, each by a closed form of its own.
"""

from typing import Any

import numpy as np
import pytest
from support.machines import changed, load_of
from support.travelling import BRIDGE, crane_of, scene_report

from ptmcalc.base.estimate import Estimate
from ptmcalc.machines.crane.travelling.machine.model import State
from ptmcalc.machines.crane.travelling.reference import SWAY_CARTESIAN
from ptmcalc.machines.crane.travelling.sway.simulated import Simulated
from ptmcalc.machines.crane.travelling.sway.sway_simulated import SWAY_SIMULATED

CAGE = {"power": "5 kW", "speed": "1400 rpm", "synchronous_speed": "1500 rpm", "overload": 2.4}
CURVES: dict[str, dict[str, Any]] = {
    "linear": {"type": "linear", "starting_torque": "45 N*m", "no_load_speed": "200 rad/s"},
    "cage": {"type": "induction", **CAGE},
    "by_torque": {"type": "rheostat", **CAGE, "steps": [8, 4, 2], "smallest_torque": "40 N*m"},
    "by_time": {"type": "rheostat", **CAGE, "steps": [8, 4, 2], "switch_times": ["1 s", "2 s", "3 s"]},
    "table": {
        "type": "table",
        "points": [
            {"speed": "0 rad/s", "torque": "40 N*m"},
            {"speed": "70 rad/s", "torque": "52 N*m"},
            {"speed": "170 rad/s", "torque": "25 N*m"},
        ],
    },
}
CONVERTER = {"type": "converter", "rated_torque": "10 N*m", "slip": "3 %", "speed": "146.7 rad/s"}
CURVES["at_its_limit"] = {**CONVERTER, "ramp_time": "2 s", "torque_limit": "40 N*m"}
CURVES["on_its_ramp"] = {**CONVERTER, "ramp_time": "4 s", "torque_limit": "200 N*m"}
CURVES["at_once"] = {**CONVERTER, "ramp_time": "0 s", "torque_limit": "40 N*m"}
ROTOR = {"count": 2, "inertia": "0.02 kg*m^2", "coupling_inertia": "0.01 kg*m^2"}
WIND = {"area": "20 m^2", "load_area": "8 m^2", "pressure": "100 Pa"}
BREEZE = {"area": "20 m^2", "load_area": "8 m^2", "pressure": "30 Pa"}
HOIST = {"suspension__hoist_speed": "0.13 m/s"}
CASES: dict[str, dict[str, Any]] = {
    **{f"start_{name}": {"drive__motor": {**ROTOR, "curve": curve}} for name, curve in CURVES.items()},
    "start_mean": {},
    "start_uphill": {"rail__slope": 0.01, "wind": BREEZE, "wheels__inertia": "5 kg*m^2"},
    "hoist_up": {**HOIST, "scenes": [{"type": "hoist_while_travelling", "time": "2 s"}]},
    "hoist_down": {**HOIST, "scenes": [{"type": "hoist_while_travelling", "hoist": "down", "time": "9 s"}]},
    "stop": {"drive__brake__delay": "0.3 s", "drive__brake__rise_time": "0.5 s", "scenes": [{"type": "brake"}]},
    "stop_downhill": {
        "rail__slope": 0.005,
        "wheels__inertia": "5 kg*m^2",
        "drive__brake__torque": "30 N*m",
        "scenes": [{"type": "brake"}],
    },
    "stop_against": {
        "wind": WIND,
        "load": "30 t",
        "drive__brake": {"torque": "8 N*m", "delay": "0.1 s", "rise_time": "2 s"},
        "scenes": [{"type": "brake", "wind": "against"}],
    },
}


def by_torque(**changes: Any) -> dict[str, Any]:
    """The bridge crane started by torque and stopped by its brakes, with wheels that never slide."""
    return changed(
        BRIDGE, **{"drive__acceleration": None, "drive__deceleration": None, "rail__adhesion": 0.9} | changes
    )


@pytest.mark.parametrize("case", CASES)
def test_both_methods_hold_one_value_for_every_drive(case: str) -> None:
    spec = crane_of(by_torque(**CASES[case]))
    (scene,) = spec.all_scenes
    assert SWAY_CARTESIAN.usable_for(spec, scene)  # type: ignore[arg-type]
    first = SWAY_SIMULATED.run(spec, scene, SWAY_SIMULATED.represents, 0)  # type: ignore[arg-type]
    second = SWAY_CARTESIAN.run(spec, scene, SWAY_CARTESIAN.represents, 0)  # type: ignore[arg-type]
    assert set(first.loads) == set(second.loads)
    for name, found in second.loads.items():
        one, two = first.loads[name].estimate, found.estimate
        slack = 1e-9 * abs(one.value)
        assert one.low - slack <= two.high, name
        assert two.low <= one.high + slack, name
        assert two.bar <= 1e-3 * abs(two.value) + 1e-9, name


# -- what it has found -------------------------------------------------------------------------------------------------


def test_a_converter_within_its_limit_has_its_speed_when_its_ramp_ends() -> None:
    data = by_torque(drive__motor={**ROTOR, "curve": CURVES["on_its_ramp"]})
    assert load_of(scene_report(data), "start_time").estimate.value == pytest.approx(4.0, rel=1e-9)


def test_a_step_of_resistance_is_cut_out_at_its_time() -> None:
    """At once: what is left is the motor alone. Late: the first step goes all the way, and takes another time."""

    def time(curve: dict[str, Any]) -> float:
        return load_of(scene_report(by_torque(drive__motor={**ROTOR, "curve": curve})), "start_time").estimate.value

    steps = {"type": "rheostat", **CAGE, "steps": [5, 3]}
    alone = time({"type": "induction", **CAGE})
    early = time({**steps, "switch_times": ["1 ms", "2 ms"]})
    assert early == pytest.approx(alone, rel=2e-3)
    assert time({**steps, "switch_times": ["60 s", "90 s"]}) != pytest.approx(alone, rel=2e-2)


def test_a_slope_pulls_at_masses_and_not_at_what_turns() -> None:
    """A stop with 1 kg on the hook is that of a rigid crane: v (m + J/r^2)/(F + W - m g sin(alpha))."""
    data = by_torque(
        hook_block="1 kg",
        rail__slope=0.005,
        wheels__inertia="50 kg*m^2",
        drive__gear={"ratio": 22, "efficiency": 1.0},
        drive__motor={"inertia": "1e-6 kg*m^2", "coupling_inertia": "0 kg*m^2", "mean_starting_torque": "60 N*m"},
        drive__brake__torque="16 N*m",
        scenes=[{"type": "brake", "load": "empty"}],
    )
    mass, turning, rim = 15201.0, 4 * 50 / 0.1575**2, 22 / 0.1575
    alpha = np.arctan(0.005)
    force = 16 * rim + 0.01 * mass * 9.81 - mass * 9.81 * np.sin(alpha)
    expected = 1.05 * (mass + turning + 1e-6 * rim**2) / force
    spec = crane_of(data)
    (scene,) = spec.all_scenes
    found = SWAY_SIMULATED.run(spec, scene, SWAY_SIMULATED.represents, 0)  # type: ignore[arg-type]
    assert found.loads["brake_time"].estimate.value == pytest.approx(expected, rel=1e-4)


def test_the_bar_of_a_top_between_two_looks_of_one_height_holds_it() -> None:
    """1 - (t - 1/2)^2 looked at in whole seconds from the event at 0 on: its top of 1 is seen as 3/4 only."""
    times = np.arange(6.0)
    zero = np.zeros(6)
    seen = State(1 - (times - 0.5) ** 2, zero, zero, zero, zero)
    nothing = Estimate.exact(0.0)
    course = Simulated(
        nothing, nothing, nothing, nothing, (), times=times, seen=seen, breaks=(-1e-9,), phases_of=((0.0, "start"),)
    )
    found = course.extreme(lambda state: np.asarray(state.acceleration), largest=True).estimate
    assert found.value == 0.75
    assert found.high >= 1.0
