"""A rack stacker for tests of its events: what a reference knows of it, as a design file."""

from typing import Any

from ptmcalc.contract.report import LoadReport, SceneReport
from ptmcalc.contract.result import Result
from ptmcalc.machines.crane.stacking.machine.rack import RackStacker
from support.machines import changed, load_of, loaded, report_of, scene_of
from support.stacker_ode import Caught

RACK: dict[str, Any] = {
    "kind": "crane",
    "type": "rack_stacker",
    "load": "1 t",
    "base": {"mass": "2.5 t", "wheel_base": "4 m", "wheel_diameter": "400 mm"},
    "column": {"length": "12 m", "foot": "0.5 m", "mass": "1800 kg", "second_moment": "40000 cm^4"},
    "carriage": {
        "mass": "600 kg",
        "load_arm": "0.2 m",
        "load_arm_across": "1.1 m",
        "rollers": {"distance": "1.2 m", "diameter": "160 mm", "axle_diameter": "50 mm"},
    },
    "hoisting": {
        "speed": "0.3 m/s",
        "acceleration": "0.4 m/s^2",
        "rope": {"falls": 2, "stiffness": "900 kN/m", "breaking_force": "120 kN"},
        "drive": {"reduced_mass": "9 t"},
    },
    "travel": {
        "speed": "2 m/s",
        "acceleration": "0.4 m/s^2",
        "deceleration": "0.4 m/s^2",
        "buffers": {"stiffness": "200 kN/m", "stroke": "400 mm", "rating": "60 kN"},
    },
    "rail": {"step": "1 mm", "frequency": "10 Hz"},
    "rack": {"stiffness_vertical": "2.5 MN/m", "stiffness_push": "500 kN/m", "rating_push": "12 kN"},
    "fork": {"mass": "400 kg", "speed": "0.3 m/s", "motor_force": "3 kN"},
    "safety_gear": {"type": "progressive", "force": "31.392 kN", "stroke": "300 mm"},
    "scenes": [{"type": "fork_caught"}],
}
"""A carriage of 1600 kg with its load, hoist and rack of the worked case C20."""


def machine(data: dict[str, Any]) -> RackStacker:
    spec = loaded(data).spec
    assert isinstance(spec, RackStacker)
    return spec


def of_case(one: Caught) -> dict[str, Any]:
    """A design file of a caught fork."""
    drive: dict[str, Any] = {"reduced_mass": f"{one.drive!r} kg", "largest_force": f"{one.force!r} N"}
    if one.slope:
        drive["slope"] = f"{one.slope!r} N*s/m"
    limiter = None
    if one.trips < float("inf"):
        limiter = {
            "force": f"{one.trips!r} N",
            "reaction": f"{one.reaction!r} s",
            "braking_force": f"{one.brake!r} N",
        }
    data = changed(
        RACK,
        load=f"{one.carriage - 600!r} kg",
        gravity=f"{one.weight / one.carriage!r} m/s^2",
        hoisting__speed=f"{one.speed!r} m/s",
        hoisting__rope__stiffness=f"{one.rope!r} N/m",
        hoisting__drive=drive,
        rack__stiffness_vertical=f"{one.rack!r} N/m",
    )
    return changed(data, hoisting__limiter=limiter) if limiter else data


def run(solver: Any, data: dict[str, Any], *without: str) -> Result:
    """One solver on the first scene of a file, with all its effects but some."""
    spec = machine(data)
    scene = spec.all_scenes[0]
    assert solver.usable_for(spec, scene)
    result = solver.run(spec, scene, solver.represents - set(without), 0)
    assert isinstance(result, Result)
    return result


def value(result: Result, name: str) -> float:
    return result.loads[name].estimate.value


def scene_report(data: dict[str, Any], scene: str = "") -> SceneReport:
    report = report_of(data)
    return scene_of(report, scene) if scene else report.scenes[0]


def load(data: dict[str, Any], name: str) -> LoadReport:
    return load_of(scene_report(data), name)
