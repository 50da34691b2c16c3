"""Stacker cranes whose column starts and stops: two machines, and a seeded sample of them."""

import math
from typing import Any

import numpy as np

OVERHEAD: dict[str, Any] = {
    "kind": "crane",
    "type": "overhead_stacker",
    "load": "1 t",
    "bridge": {"mass": "3 t", "span": "16.5 m"},
    "trolley": {"mass": "4 t", "gauge": "2 m"},
    "column": {"length": "6 m", "mass": "1200 kg", "stiffness": "600 kN/m"},
    "carriage": {
        "mass": "600 kg",
        "rollers": {"distance": "1.2 m", "diameter": "160 mm", "axle_diameter": "50 mm"},
    },
    "cab": {"mass": "200 kg"},
    "hoisting": {"speed": "0.2 m/s", "acceleration": "0.3 m/s^2", "rope": {"falls": 2}},
    "trolley_travel": {
        "speed": "1 m/s",
        "driving_force": "6 kN",
        "braking_force": "9 kN",
        "braking_delay": "0 s",
        "resistance": "0 N",
    },
    "scenes": [{"type": "brake", "mechanism": "trolley"}],
}
"""The trolley of C11."""

RACK: dict[str, Any] = {
    "kind": "crane",
    "type": "rack_stacker",
    "load": "1 t",
    "base": {"mass": "2.5 t", "wheel_base": "3.2 m", "wheel_diameter": "400 mm"},
    "column": {"length": "12 m", "mass": "1500 kg", "second_moment": "60000 cm^4", "root_stiffness": "400 MN*m/rad"},
    "carriage": {
        "mass": "500 kg",
        "rollers": {"distance": "1.2 m", "diameter": "160 mm", "axle_diameter": "50 mm"},
    },
    "hoisting": {"speed": "0.5 m/s", "acceleration": "0.5 m/s^2", "rope": {"falls": 2}},
    "travel": {
        "speed": "2 m/s",
        "driving_force": "4 kN",
        "braking_force": "5 kN",
        "braking_delay": "0 s",
        "resistance": "0 N",
    },
    "scenes": [{"type": "brake"}],
}


def random_stacker(rng: np.random.Generator) -> dict[str, Any]:
    """A start or stop by a force or along a ramp, load and base from a quarter to four times the column's mass."""
    column = float(10 ** rng.uniform(2.5, 3.7))
    load, base = (column * float(4 ** rng.uniform(-1, 1)) for _ in range(2))
    length = float(rng.uniform(3, 20))
    stiff = float(10 ** rng.uniform(4.3, 6.0))
    bent = float(rng.choice([1.0, rng.uniform(0.2, 1.0)]))
    flexural = stiff * length**3 / 3 / bent
    root = {} if bent == 1 else {"root_stiffness": f"{stiff * length**2 / (1 - bent):.6g} N*m/rad"}
    moving = load + base + column
    period = 2 * math.pi * math.sqrt(0.5 * load / stiff)
    acceleration = float(10 ** rng.uniform(-0.9, 0.2))
    rise = float(rng.choice([0.0, period * rng.uniform(0.1, 1.5)]))
    speed = acceleration * period * float(10 ** rng.uniform(-0.5, 1.0)) + acceleration * rise
    travel: dict[str, Any] = {"speed": f"{speed:.6g} m/s"}
    starts = bool(rng.integers(2))
    if rng.random() < 0.7:
        travel |= {"driving_force": f"{moving * acceleration:.6g} N", "braking_force": f"{moving * acceleration:.6g} N"}
        travel |= {"driving_rise" if starts else "braking_rise": f"{rise:.6g} s"} if rise else {}
    else:
        travel |= {"acceleration": f"{acceleration:.6g} m/s^2", "deceleration": f"{acceleration:.6g} m/s^2"}
        travel |= {"ramp_rise": f"{rise:.6g} s"} if rise else {}
    given: dict[str, Any] = RACK | {
        "load": f"{0.6 * load:.6g} kg",
        "base": {"mass": f"{base:.6g} kg", "wheel_base": "3.2 m", "wheel_diameter": "400 mm"},
        "column": {
            "length": f"{length:.6g} m",
            "mass": f"{column:.6g} kg",
            "second_moment": f"{flexural / 210e9:.8g} m^4",
        }
        | root,
        "carriage": RACK["carriage"] | {"mass": f"{0.4 * load:.6g} kg"},
        "travel": travel,
        "scenes": [{"type": "start" if starts else "brake"}],
    }
    if rng.random() < 0.6:
        given["column"]["log_decrement"] = float(rng.uniform(0.03, 0.3))
        given["settling"] = {"window": f"{acceleration * load / stiff * float(rng.uniform(0.1, 1.0)):.6g} m"}
    return given
