"""Travelling cranes for tests: a bridge crane, changed here and there, and what a reference knows of it."""

from typing import Any

import yaml

from ptmcalc.contract.report import LoadReport, SceneReport
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from support.machines import changed, load_of, loaded, report_of, scene_of
from support.travel_ode import Machine

BRIDGE: dict[str, Any] = {
    "kind": "crane",
    "type": "travelling",
    "travels": "bridge",
    "load": "10 t",
    "hook_block": "250 kg",
    "bridge": {"mass": "13 t", "span": "22.5 m", "height": "0.6 m"},
    "trolley": {"mass": "2.2 t", "nearest": "1.1 m", "farthest": "21.2 m", "height": "1.1 m"},
    "wheels": {"diameter": "315 mm", "base": "3.6 m", "driven": ["A1", "B1"], "rating": "120 kN"},
    "rolling": {"coefficient": 0.01},
    "rail": {"adhesion": 0.14},
    "speed": "1.05 m/s",
    "drive": {
        "motor": {
            "count": 2,
            "inertia": "0.006 kg*m^2",
            "coupling_inertia": "0.002 kg*m^2",
            "mean_starting_torque": "32 N*m",
        },
        "gear": {"ratio": 22, "efficiency": 0.9},
        "brake": {"torque": "16 N*m"},
        "acceleration": "0.13 m/s^2",
        "deceleration": "0.15 m/s^2",
    },
    "suspension": {"length": "8 m"},
    "scenes": [{"type": "start"}],
}


def crane(**changes: Any) -> dict[str, Any]:
    """The bridge crane with values set by paths."""
    return changed(BRIDGE, **changes)


def crane_of(data: dict[str, Any]) -> Travelling:
    """The filled-in spec."""
    spec = loaded(data).spec
    assert isinstance(spec, Travelling)
    return spec


def scene_report(data: dict[str, Any], name: str = "", **options: Any) -> SceneReport:
    """One scene of a crane."""
    return scene_of(report_of(data, **options), name)


def found(data: dict[str, Any], load: str, name: str = "") -> LoadReport:
    """A load of a scene of a crane."""
    return load_of(scene_report(data, name), load)


def value(data: dict[str, Any], load: str, name: str = "") -> float:
    """A number of a scene of a crane."""
    return found(data, load, name).estimate.value


def text_report(data: dict[str, Any]) -> Any:
    """The report of a file that may be faulty."""
    return check(load_text(yaml.safe_dump(data, sort_keys=False).encode(), "case.yaml"), Options(repairs=False))


def as_file(one: Machine) -> dict[str, Any]:
    """A reference's machine as a file says it: all driven wheels at the front, nothing that turns but the rotor."""
    rim = 20 / 0.2
    data: dict[str, Any] = {
        "kind": "crane",
        "type": "travelling",
        "travels": "bridge",
        "load": f"{one.load!r} kg",
        "bridge": {"mass": f"{one.body - 1000!r} kg", "span": "20 m", "height": "1 m"},
        "trolley": {"mass": "1000 kg", "nearest": "1 m", "height": "1.5 m"},
        "wheels": {"diameter": "0.4 m", "base": "4 m", "driven": ["A1", "A2", "B1", "B2"], "rating": "1 MN"},
        "rolling": {"coefficient": one.rolling / ((one.body + one.load) * 9.81)},
        "rail": {"adhesion": 0.5},
        "speed": f"{one.speed!r} m/s",
        "drive": {
            "motor": {
                "inertia": f"{max(one.rotor / rim**2, 1e-9)!r} kg*m^2",
                "coupling_inertia": "0 kg*m^2",
                "mean_starting_torque": f"{max(one.force, 1.0) / rim!r} N*m",
            },
            "gear": {"ratio": 20, "efficiency": 1.0},
            "brake": {
                "torque": f"{max(one.force, 1.0) / rim!r} N*m",
                "delay": f"{one.delay!r} s",
                "rise_time": f"{one.rise!r} s",
            },
        },
        "suspension": {"length": f"{one.length!r} m"},
    }
    kind = "start" if one.starts else "brake"
    if one.ramp is not None:
        data["drive"]["acceleration" if one.starts else "deceleration"] = f"{one.ramp!r} m/s^2"
    scene: dict[str, Any] = {"type": kind}
    if one.wind or one.wind_on_load:
        data["wind"] = {
            "area": f"{abs(one.wind) / 100!r} m^2",
            "shape": 1,
            "load_area": f"{abs(one.wind_on_load) / 100!r} m^2",
            "load_shape": 1,
            "pressure": "100 Pa",
        }
        scene["wind"] = "against" if one.wind + one.wind_on_load > 0 else "with"
    if one.hoisting:
        scene = {**scene, "type": "hoist_while_travelling", "hoist": "up" if one.hoisting > 0 else "down"}
        data["suspension"]["hoist_speed"] = f"{abs(one.hoisting)!r} m/s"
    data["scenes"] = [scene]
    return data
