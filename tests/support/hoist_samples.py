"""Seeded random hoists of any sizes that a file can hold. They need not be sound."""

import math
from typing import Any

import numpy as np


def _even(rng: np.random.Generator, low: float, high: float) -> float:
    return float(np.exp(rng.uniform(math.log(low), math.log(high))))


def absurd_hoist(rng: np.random.Generator) -> dict[str, Any]:
    """Sizes over many decades; rope, drum and flanges fit each other, as every file's must."""
    ropes = int(rng.integers(1, 3))
    d = _even(rng, 1e-5, 1e2)
    layers = int(rng.integers(1, 21))
    data: dict[str, Any] = {
        "kind": "hoist",
        "load": f"{_even(rng, 1e-6, 1e9)!r} kg",
        "hook_block": f"{_even(rng, 1e-6, 1e6)!r} kg",
        "height": f"{_even(rng, 1e-3, 1e4)!r} m",
        "least_fall": f"{_even(rng, 1e-3, 1e3)!r} m",
        "speed": {"main": f"{_even(rng, 1e-6, 1e4)!r} m/s"},
        "reeving": {
            "falls": ropes * int(rng.integers(1, 33)),
            "ropes": ropes,
            "sheave_efficiency": _even(rng, 0.3, 1),
            "deflection_sheaves": int(rng.integers(0, 40)),
            "lead_length": f"{int(rng.integers(2)) * _even(rng, 1e-3, 1e4)!r} m",
        },
        "rope": {
            "diameter": f"{d!r} m",
            "area": f"{_even(rng, 1e-9, 1e3)!r} m^2",
            "modulus": f"{_even(rng, 1e-3, 1e9)!r} MPa",
            "mass": f"{_even(rng, 1e-9, 1e6)!r} kg/m",
            "breaking_force": f"{_even(rng, 1e-6, 1e12)!r} N",
        },
        "drum": {
            "diameter": f"{d * _even(rng, 1.01, 1e4)!r} m",
            "length": f"{d * _even(rng, 6, 1e4)!r} m",
            "pitch": f"{d * rng.uniform(1, 1.7)!r} m",
            "layers": layers,
            "flange_height": f"{d * (layers + 3)!r} m",
            "dead_wraps": float(rng.integers(0, 101)),
            "shell_thickness": f"{_even(rng, 1e-6, 1e2)!r} m",
        },
        "winding": {"packing": str(rng.choice(["nested", "square"]))},
        "gearbox": {"ratio": _even(rng, 1e-3, 1e6), "efficiency": _even(rng, 0.2, 1)},
        "motor": {
            "inertia": f"{_even(rng, 1e-9, 1e6)!r} kg*m^2",
            "coupling_inertia": "0 kg*m^2",
            "mean_starting_torque": f"{_even(rng, 1e-6, 1e9)!r} N*m",
            "rated_torque": f"{_even(rng, 1e-6, 1e9)!r} N*m",
            "rated_duty": _even(rng, 0.01, 1),
        },
        "brake": {
            "torque": f"{_even(rng, 1e-6, 1e9)!r} N*m",
            "shaft": str(rng.choice(["motor", "drum"])),
        },
        "class": {"mechanism": f"M{rng.integers(1, 9)}"},
        "duty": {
            "type": str(rng.choice(["S3", "S4", "S5"])),
            "factor": _even(rng, 0.01, 1),
            "starts_per_hour": _even(rng, 0.1, 3600),
            "hours": f"{_even(rng, 1, 1e6)!r} h",
            "cycles": _even(rng, 1, 1e8),
        },
        "checks": {"hoop_stress": "150 MPa"},
        "scenes": [{"type": "run"}, {"type": "run", "load": "empty"}],
    }
    return data
