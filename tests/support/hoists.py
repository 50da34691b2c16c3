"""Hoists for tests, and what a reference knows of them: pure numbers, no law of ours."""

import math
from typing import Any

import numpy as np

from ptmcalc.contract.report import SceneReport
from ptmcalc.machines.hoist.machine.spec import Hoist
from support.machines import load_of, loaded, report_of, scene_of

PAPER: dict[str, Any] = {
    "kind": "hoist",
    "load": "5 t",
    "height": "40 m",
    "speed": {"drum": "12 rpm"},
    "reeving": {"falls": 4, "sheave_efficiency": 0.98, "sheave_diameter": "340 mm"},
    "rope": {
        "diameter": "17.5 mm",
        "area": "114 mm^2",
        "modulus": "105 GPa",
        "mass": "1.1 kg/m",
        "breaking_force": "168 kN",
    },
    "drum": {
        "diameter": "300 mm",
        "length": "640 mm",
        "pitch": "17.5 mm",
        "layers": 4,
        "dead_wraps": 3,
        "flange_height": "95 mm",
        "inertia": "9 kg*m^2",
    },
    "gearbox": {"ratio": 80, "efficiency": 0.92},
    "motor": {"inertia": "0.035 kg*m^2", "coupling_inertia": "0.01 kg*m^2", "mean_starting_torque": "75 N*m"},
    "brake": {"torque": "70 N*m"},
    "class": {"mechanism": "M5"},
    "scenes": [{"type": "run"}],
}
"""The machine of the paper on multilayer winding, with a drive: one rope, four falls, four layers."""

CRANE: dict[str, Any] = {
    "kind": "hoist",
    "load": "12.5 t",
    "hook_block": "350 kg",
    "height": "12 m",
    "least_fall": "1.1 m",
    "speed": {"main": "0.133 m/s", "creep": "0.0133 m/s"},
    "reeving": {
        "falls": 4,
        "ropes": 2,
        "sheave_efficiency": 0.985,
        "sheave_diameter": "315 mm",
        "equaliser_diameter": "250 mm",
        "lead_offset": "0.12 m",
    },
    "rope": {
        "diameter": "16 mm",
        "area": "118 mm^2",
        "modulus": "110 GPa",
        "mass": "1.05 kg/m",
        "breaking_force": "178 kN",
    },
    "drum": {
        "diameter": "355 mm",
        "length": "460 mm",
        "pitch": "18 mm",
        "dead_wraps": 3,
        "shell_thickness": "14 mm",
        "inertia": "14 kg*m^2",
    },
    "gearbox": {"ratio": 106, "efficiency": 0.93},
    "motor": {
        "inertia": "0.13 kg*m^2",
        "coupling_inertia": "0.03 kg*m^2",
        "speed": "1460 rpm",
        "power": "22 kW",
        "rated_duty": "40 %",
        "mean_starting_torque": "240 N*m",
        "starts_per_hour": 240,
    },
    "brake": {"torque": "250 N*m", "delay": "0.1 s", "rise_time": "0.1 s"},
    "class": {"mechanism": "M5", "hoisting": "HC2", "drive": "HD2"},
    "duty": {"type": "S3", "factor": "40 %", "starts_per_hour": 180},
    "checks": {"hoop_stress": "150 MPa"},
    "scenes": [{"type": "run"}],
}
"""The hoist of an overhead crane: two ropes, two falls of each, one layer."""


def hoist_of(data: dict[str, Any]) -> Hoist:
    """The filled-in spec of a hoist."""
    spec = loaded(data).spec
    assert isinstance(spec, Hoist)
    return spec


def hoist_scene(data: dict[str, Any], name: str = "", *, repairs: bool = False) -> SceneReport:
    """The only scene of a hoist, or one by name; repairs are looked for where a test asks for them."""
    return scene_of(report_of(data, repairs=repairs), name)


def value(scene: SceneReport, name: str) -> float:
    """The value of a load."""
    return load_of(scene, name).estimate.value


def balanced_falls(load: float, falls: int, efficiency: float, weight: float, hauling: bool) -> np.ndarray:
    """Pulls at both ends of every fall by the balance of all sheaves at once, shape (2, falls): lower, upper [N]."""
    loss = efficiency if hauling else 1 / efficiency
    matrix, right = np.zeros((2 * falls, 2 * falls)), np.zeros(2 * falls)
    row = 0
    for k in range(falls):  # upper = lower + weight
        matrix[row, falls + k], matrix[row, k], right[row] = 1.0, -1.0, weight
        row += 1
    for k in range(falls - 1):  # sheaves, the first one on the hook block, for the rope comes down from the drum
        ends = falls if k % 2 else 0
        matrix[row, ends + k + 1], matrix[row, ends + k] = 1.0, -loss
        row += 1
    matrix[row, :falls], right[row] = 1.0, load
    return np.linalg.solve(matrix, right).reshape(2, falls)


def layers_turn_by_turn(length: float, first: float, step: float, turns: int, nested: bool) -> tuple[float, int]:
    """Turns and layers of a rope laid turn by turn on a drum of whole turns."""
    layer, done, rest = 1, 0.0, length
    while True:
        room = turns - (nested and layer % 2 == 0)
        turn = 2 * math.pi * (first + (layer - 1) * step)
        for _ in range(room):
            if rest <= turn:
                return done + rest / turn, layer
            rest, done = rest - turn, done + 1
        layer += 1
