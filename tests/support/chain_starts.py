"""Seeded chain drives for starts, stops and speed ranges, as a design file would describe them."""

from typing import Any

import numpy as np

from ptmcalc.contract.machine import AnyKind
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive

KIND: AnyKind = load_kind("chain_drive")


def text(value: float, unit: str) -> str:
    return f"{value:.12g} {unit}"


def scraper(**changed: Any) -> dict[str, Any]:
    """A scraper conveyor of middling size."""
    return {
        "kind": "chain_drive",
        "layout": {
            "type": "conveyor",
            "length": "40 m",
            "lift": "5 m",
            "load": "90 kg/m",
            "resistance": {"coefficient": 0.25, "load_coefficient": 0.4, "turn_factor": 1.1, "start_factor": 1.2,
                           "stop_factor": 0.8},
            "takeup": {"type": "gravity", "tension": "12 kN"},
            "tail": {"teeth": 8, "inertia": "12 kg*m^2"},
        },
        "chain": {
            "pitch": "160 mm",
            "mass": "22 kg/m",
            "count": 2,
            "unevenness": 1.2,
            "breaking_load": "350 kN",
            "stiffness": "32 MN",
            "damping": {"ratio": 0.05},
        },
        "sprocket": {"teeth": 8, "inertia": "15 kg*m^2"},
        "speed": "0.5 m/s",
        "drive": {
            "motor": {"inertia": "0.35 kg*m^2", "mean_starting_torque": "300 N*m"},
            "coupling_inertia": "0.05 kg*m^2",
            "gear": {"ratio": 42, "efficiency": 0.93},
        },
        "scenes": [{"type": "start"}],
    } | changed  # fmt: skip


def random_chain(rng: np.random.Generator, **scene: Any) -> dict[str, Any]:
    """A conveyor, level, rising or falling, or two shafts; its drive strong enough to start it."""
    data = scraper()
    pitch, teeth = float(rng.choice([0.1, 0.16, 0.2, 0.315])), int(rng.integers(6, 17))
    length, chain, load = (float(np.exp(rng.uniform(*np.log(ends)))) for ends in ((8, 150), (8, 90), (5, 400)))
    coefficient, lift = float(rng.uniform(0.05, 0.35)), float(rng.uniform(-0.05, 0.25) * length)
    takeup = str(rng.choice(["gravity", "screw"]))
    weight = 9.81 * length * ((2 * chain + load) * coefficient + chain * abs(lift) / length)
    data["layout"] |= {
        "length": text(length, "m"),
        "lift": text(lift, "m"),
        "load": text(load, "kg/m"),
        "resistance": {"coefficient": coefficient, "turn_factor": 1.1, "start_factor": float(rng.uniform(1, 1.4)),
                       "stop_factor": float(rng.uniform(0.7, 1.0))},
        "takeup": {"type": takeup, "tension": text(weight * float(rng.uniform(0.7, 3)), "N")},
        "tail": {"teeth": teeth, "inertia": text(float(rng.uniform(0.1, 3)) * chain * pitch**2 * teeth, "kg*m^2")},
    }  # fmt: skip
    data["chain"] |= {
        "pitch": text(pitch, "m"),
        "mass": text(chain, "kg/m"),
        "stiffness": text(float(np.exp(rng.uniform(*np.log((8e6, 2e8))))), "N"),
        "damping": {"law": str(rng.choice(["kelvin_voigt", "hysteretic"])), "ratio": float(rng.uniform(0.0, 0.1))},
    }
    data["sprocket"] = {"teeth": teeth, "inertia": text(float(rng.uniform(0, 30)), "kg*m^2")}
    data["speed"] = text(float(rng.uniform(0.1, 1.2)), "m/s")
    arm, ratio = pitch * teeth / 6.283185307179586, float(rng.uniform(15, 80))
    mass = length * (2 * chain + load)
    drive = mass * float(np.exp(rng.uniform(np.log(0.2), np.log(20))))
    needed = 1.5 * weight + 9.81 * load * max(lift, 0)
    pull = needed + mass * float(rng.uniform(0.02, 0.4))
    data["drive"] = {
        "motor": {
            "inertia": text(drive * (arm / ratio) ** 2, "kg*m^2"),
            "mean_starting_torque": text(pull * arm / ratio, "N*m"),
        },
        "coupling_inertia": "0 kg*m^2",
        "gear": {"ratio": ratio, "efficiency": float(rng.uniform(0.85, 0.97))},
    }
    data["scenes"] = [{"type": "start", **scene}]
    return data


def profile(rng: np.random.Generator) -> dict[str, Any]:
    """A step of torque, or a rise of torque or speed of any shape."""
    shape = str(rng.choice(["step", "ramp", "cosine", "parabolic"]))
    if shape == "step":
        return {"shape": shape}
    time = float(np.exp(rng.uniform(np.log(0.1), np.log(4))))
    return {"shape": shape, "time": text(time, "s"), "control": str(rng.choice(["torque", "speed"]))}


def built(data: dict[str, Any]) -> ChainDrive:
    """The machine, with what the file leaves out filled in as `check` does."""
    spec: ChainDrive = KIND.spec.model_validate(data)
    for one in KIND.assumptions_of(spec):
        if spec.value_at(one.path) is None and (value := one.value(spec)) is not None:
            spec = spec.with_value(one.path, value)
    return spec
