"""Seeded random chain drives: of usual sizes, or of any that a file can hold. They need not be sound."""

import math
from typing import Any

import numpy as np


def _even(rng: np.random.Generator, low: float, high: float) -> float:
    return float(np.exp(rng.uniform(math.log(low), math.log(high))))


def _damping(rng: np.random.Generator, low: float, high: float) -> dict[str, Any]:
    law = str(rng.choice(["kelvin_voigt", "kelvin_voigt", "hysteretic", "zener"]))
    if law == "zener":
        return {"law": law, "time": f"{_even(rng, 1e-3, 1e-1)!r} s", "stiffening": _even(rng, 2 * low, 4 * high)}
    return {"law": law, "ratio": _even(rng, low, high)}


def _drive(rng: np.random.Generator) -> dict[str, Any]:
    return {
        "motor": {"inertia": f"{_even(rng, 0.01, 5)!r} kg*m^2", "mean_starting_torque": "200 N*m"},
        "coupling_inertia": "0.01 kg*m^2",
        "gear": {"ratio": _even(rng, 5, 100), "efficiency": 0.93},
    }


def usual_chain(rng: np.random.Generator) -> dict[str, Any]:
    """A conveyor or a drive as it may be built, its teeth between a fifth and twice its first natural frequency."""
    conveyor = rng.random() < 0.7
    teeth = int(rng.integers(6, 14)) if conveyor else int(rng.integers(15, 30))
    pitch = _even(rng, 0.1, 0.4) if conveyor else _even(rng, 0.0127, 0.05)
    stiffness, own = _even(rng, 2e7, 4e8), _even(rng, 10, 80) if conveyor else _even(rng, 1, 8)
    chain: dict[str, Any] = {
        "pitch": f"{pitch!r} m",
        "mass": f"{own!r} kg/m",
        "damping": _damping(rng, 0.01, 0.1),
        "stiffness": f"{stiffness!r} N",
    }
    length = _even(rng, 10, 120) if conveyor else 45 * pitch
    load = own * _even(rng, 0.2, 4) if conveyor else 0.0
    pull = (own + load) * 9.81 * length * 0.25 if conveyor else _even(rng, 1e3, 2e4)
    if conveyor:
        first = math.pi / 2 / (length * (math.sqrt((own + load) / stiffness) + math.sqrt(own / stiffness)))
        kind = str(rng.choice(["gravity", "gravity", "mass", "screw", "driven"]))
        takeup: dict[str, Any] = {"type": "screw" if kind == "screw" else "gravity", "tension": f"{pull!r} N"}
        if kind == "mass":
            takeup["mass"] = f"{2 * pull / 9.81!r} kg"
        tail: dict[str, Any] = {"teeth": int(rng.integers(6, 14)), "inertia": f"{_even(rng, 1, 100)!r} kg*m^2"}
        if kind == "driven":
            tail["driven"] = "on"
            if rng.random() < 0.5:
                tail["phase"] = float(rng.random())
        layout: dict[str, Any] = {
            "type": "conveyor",
            "length": f"{length!r} m",
            "lift": f"{length * rng.uniform(-0.2, 0.3)!r} m",
            "load": f"{load!r} kg/m",
            "resistance": {"coefficient": 0.2, "turn_factor": 1.1},
            "takeup": takeup,
            "tail": tail,
        }
    else:
        layout = {
            "type": "drive",
            "driven": {"teeth": int(rng.integers(15, 60)), "inertia": f"{_even(rng, 0.1, 30)!r} kg*m^2"},
            "centre_distance": f"{length!r} m",
            "torque": f"{pull / 10!r} N*m",
            "service_factor": 1.4,
        }
        if rng.random() < 0.5:
            layout["driven"]["phase"] = float(rng.random())
        arm = layout["driven"]["teeth"] * pitch / (2 * math.pi)
        mass = float(layout["driven"]["inertia"].split()[0]) / arm**2
        first = math.sqrt(stiffness / length / (mass + own * length / 3))
    chain["breaking_load"] = f"{20 * pull!r} N"
    speed = _even(rng, 0.2, 2.0) * first * pitch / (2 * math.pi)
    data = {
        "kind": "chain_drive",
        "layout": layout,
        "chain": chain,
        "sprocket": {"teeth": teeth, "inertia": "1 kg*m^2"},
        "speed": f"{speed!r} m/s",
        "scenes": [{"type": "run"}],
    }
    if rng.random() < 0.5:
        data["drive"] = _drive(rng)
    return data


def absurd_chain(rng: np.random.Generator) -> dict[str, Any]:
    """The same with every size anywhere between absurdly small and absurdly large."""
    data = usual_chain(rng)
    layout, chain = data["layout"], data["chain"]
    if layout["type"] == "conveyor":
        pitch, teeth = float(chain["pitch"].split()[0]), data["sprocket"]["teeth"] + layout["tail"]["teeth"]
        length = max(_even(rng, 1e-3, 1e6), 0.2 * pitch * teeth)  # shorter ones are refused: their sprockets touch
        layout["length"] = f"{length!r} m"
        layout["lift"] = f"{length * rng.uniform(-1, 1)!r} m"
        layout["load"] = f"{_even(rng, 1e-6, 1e6)!r} kg/m"
        layout["takeup"] = {"type": str(rng.choice(["gravity", "screw"])), "tension": f"{_even(rng, 1e-3, 1e9)!r} N"}
        layout["tail"]["inertia"] = f"{_even(rng, 1e-9, 1e9)!r} kg*m^2"
    else:
        layout["driven"]["inertia"] = f"{_even(rng, 1e-9, 1e9)!r} kg*m^2"
        layout["torque"] = f"{_even(rng, 1e-6, 1e9)!r} N*m"
    chain["mass"] = f"{_even(rng, 1e-6, 1e6)!r} kg/m"
    chain["stiffness"] = f"{_even(rng, 1e-3, 1e13)!r} N"
    chain["breaking_load"] = f"{_even(rng, 1e-3, 1e12)!r} N"
    chain["damping"] = {
        "law": str(rng.choice(["kelvin_voigt", "hysteretic"])),
        "ratio": float(rng.choice([0.0, 1e-9, 0.05, 1.0])),
    }
    data["speed"] = f"{_even(rng, 1e-9, 1e5)!r} m/s"
    if "drive" in data:
        data["drive"]["motor"]["inertia"] = f"{_even(rng, 1e-9, 1e9)!r} kg*m^2"
    return data
