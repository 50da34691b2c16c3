"""Seeded random slewing cranes: sound ones, and ones of any size that a file can hold."""

import math
from typing import Any

import numpy as np


def _even(rng: np.random.Generator, low: float, high: float) -> float:
    return float(np.exp(rng.uniform(math.log(low), math.log(high))))


def random_crane(rng: np.random.Generator) -> dict[str, Any]:
    """A crane by chance that starts and stops, most of the numbers a designer would write."""
    mass, radius, rope = _even(rng, 300, 3e4), _even(rng, 3, 30), _even(rng, 2, 20)
    crane = mass * radius**2 * _even(rng, 0.3, 30)
    speed = _even(rng, 0.02, 0.25)
    ratio, efficiency = _even(rng, 200, 1500), float(rng.uniform(0.55, 0.95))
    whole = crane + mass * radius**2
    start = _even(rng, 1, 15)
    rotor = float(rng.uniform(0.02, 0.3)) * whole / ratio**2
    inertia = whole * speed / start
    friction, wind = float(rng.uniform(0.05, 0.5)) * inertia, float(rng.uniform(0, 0.5)) * inertia
    most = wind * float(rng.uniform(1, 1.5))
    torque = (inertia * (1 + rotor * ratio**2 * efficiency / whole) + friction + wind) / ratio / efficiency
    data: dict[str, Any] = {
        "kind": "crane",
        "type": "slewing",
        "inertia": f"{whole!r} kg*m^2",
        "load": {"mass": f"{mass!r} kg", "radius": f"{radius!r} m", "rope_length": f"{rope!r} m"},
        "speed": f"{speed!r} rad/s",
        "friction": f"{friction!r} N*m",
        "wind": {"steady": f"{wind!r} N*m", "maximum": f"{most!r} N*m"},
        "motor": {"inertia": f"{rotor!r} kg*m^2", "coupling_factor": 1, "rated_torque": f"{torque!r} N*m"},
        "gear": {
            "ratio": ratio,
            "efficiency": efficiency,
            "rotating_factor": 1,
            "open": {"ratio": 8, "efficiency": 1},
        },
        "brake": {
            "torque": f"{torque * float(rng.uniform(0.8, 2))!r} N*m",
            "delay": f"{float(rng.choice([0, 0.2]))!r} s",
            "rise_time": f"{float(rng.choice([0, 0.3]))!r} s",
            "shaft": "motor",
        },
        "cycle": {"rotation": "270 deg", "brake_angle": "20 deg"},
        "ring": {
            "mass_above": f"{3 * mass!r} kg",
            "unbalance": f"{-float(rng.uniform(0, 1)) * mass * 9.81 * radius!r} N*m",
            "head_height": f"{radius / 2!r} m",
        },
    }
    if rng.random() < 0.3:
        data["brake"] |= {"shaft": "crane", "torque": f"{1.5 * torque * ratio!r} N*m"}
    motor = data["motor"]
    if rng.random() < 0.4:
        motor["curve"] = {
            "type": "linear",
            "starting_torque": f"{1.3 * torque!r} N*m",
            "no_load_speed": f"{speed * ratio * float(rng.uniform(3, 12))!r} rad/s",
        }
    else:
        motor["mean_starting_torque"] = f"{torque!r} N*m"
    if rng.random() < 0.4:
        data["wind"]["gust"] = f"{float(rng.uniform(0.05, 0.6)) * inertia!r} N*m"
    return data


def absurd_crane(rng: np.random.Generator) -> dict[str, Any]:
    """Sizes over many decades. They need not be sound."""
    data: dict[str, Any] = {
        "kind": "crane",
        "type": "slewing",
        "load": {
            "mass": f"{_even(rng, 1e-6, 1e9)!r} kg",
            "radius": f"{_even(rng, 1e-3, 1e4)!r} m",
            "rope_length": f"{_even(rng, 1e-3, 1e4)!r} m",
        },
        "slewing_part": {
            "mass": f"{_even(rng, 1e-6, 1e9)!r} kg",
            "radius": f"{_even(rng, 1e-3, 1e3)!r} m",
            "inertia": f"{_even(rng, 1e-6, 1e12)!r} kg*m^2",
        },
        "speed": f"{_even(rng, 1e-6, 1e3)!r} rad/s",
        "friction": f"{_even(rng, 1e-6, 1e9)!r} N*m",
        "wind": {"steady": f"{_even(rng, 1e-6, 1e6)!r} N*m", "gust": f"{_even(rng, 1e-6, 1e6)!r} N*m"},
        "motor": {
            "inertia": f"{_even(rng, 1e-9, 1e6)!r} kg*m^2",
            "mean_starting_torque": f"{_even(rng, 1e-6, 1e9)!r} N*m",
            "rated_torque": f"{_even(rng, 1e-6, 1e9)!r} N*m",
        },
        "gear": {"ratio": _even(rng, 1e-3, 1e6), "efficiency": _even(rng, 0.2, 1)},
        "brake": {"torque": f"{_even(rng, 1e-6, 1e9)!r} N*m", "shaft": str(rng.choice(["motor", "crane"]))},
        "cycle": {"brake_angle": f"{_even(rng, 1e-3, 3)!r} rad"},
    }
    return data
