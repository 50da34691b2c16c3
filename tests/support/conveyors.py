"""Seeded random conveyors for coverage tests: plausible machines over two decades of size, both take-ups."""

from typing import Any

import numpy as np


def text(value: float, unit: str) -> str:
    return f"{value:.17g} {unit}"


def random_conveyor(rng: np.random.Generator, **fixed: Any) -> dict[str, Any]:
    """One machine as the data of a design file. `fixed` sets `takeup`, `profile` or `load` instead of drawing it."""
    length = float(np.exp(rng.uniform(np.log(40), np.log(4000))))
    slope = rng.uniform(-0.03, 0.2)
    width = rng.choice([0.65, 0.8, 1.0, 1.2, 1.4, 1.6])
    steel = length > 800 or rng.random() < 0.3
    strength = float(rng.choice([1000, 1600, 2500, 4000] if steel else [315, 500, 800, 1250])) * 1e3  # N/m
    stiffness = strength * (rng.uniform(55, 75) if steel else rng.uniform(8, 14)) * width
    belt = width * rng.uniform(9, 16) + (strength / 1e6 * 6 * width if steel else 0)
    speed = float(rng.choice([1.0, 1.6, 2.5, 3.15, 4.0, 5.2]))
    load = float(rng.uniform(0.2, 1.0) * 130 * width**2)
    pitch_carry, pitch_return = float(rng.choice([0.9, 1.0, 1.2, 1.5])), float(rng.choice([2.4, 3.0]))
    set_carry, set_return = width * rng.uniform(12, 30), width * rng.uniform(10, 26)
    f, g = rng.uniform(0.018, 0.03), 9.81
    masses = (set_carry / pitch_carry + belt + load, set_return / pitch_return + belt)
    secondary = 1.05 + 55 / length
    resistance = secondary * f * g * length * sum(masses) + load * g * slope * length
    force = max(abs(resistance), 0.1 * f * g * length * sum(masses)) * rng.uniform(1.25, 1.9)
    force = max(force, resistance * 1.2)
    ratio, radius, efficiency = rng.uniform(10, 40), rng.uniform(0.25, 0.7), rng.uniform(0.9, 0.97)
    inertia_mass = sum(masses) * length * float(np.exp(rng.uniform(np.log(0.05), np.log(2.0))))
    rotor = inertia_mass * radius**2 / (ratio**2 * efficiency)
    takeup = fixed.get("takeup") or rng.choice(["gravity", "rigid"])
    grip = np.expm1(0.3 * np.radians(210))
    tension = force * rng.uniform(0.5, 2.5) / grip
    if takeup == "rigid":
        tension += max(resistance, 0) / 2 + force * rng.uniform(0, 1.0)
    tension = max(tension, 6 * (belt + load) * g * pitch_carry) + max(slope, 0) * belt * g * length
    shape = fixed.get("profile") or rng.choice(["step", "step", "ramp", "cosine", "torque_ramp", "torque_cosine"])
    profile: dict[str, Any] = {"shape": shape.removeprefix("torque_")}
    if shape != "step":
        contour = 2 * length / np.sqrt(stiffness / max(masses))
        profile["time"] = text(contour * float(np.exp(rng.uniform(np.log(1.0), np.log(60)))), "s")
        if shape.startswith("torque_"):
            profile["control"] = "torque"
    tail = rng.choice([0.0, 0.003, 0.02, 0.06]) * sum(masses) * length
    return {
        "kind": "conveyor",
        "route": {"length": text(length, "m"), "lift": text(slope * length, "m")},
        "belt": {
            "mass": text(belt, "kg/m"),
            "width": text(float(width), "m"),
            "stiffness": text(stiffness, "N"),
            "strength": text(strength, "N/m"),
            "carcass": "steel_cord" if steel else "textile",
        },
        "idlers": {
            "carry": {"pitch": text(pitch_carry, "m"), "set_mass": text(set_carry, "kg")},
            "return": {"pitch": text(pitch_return, "m"), "set_mass": text(set_return, "kg")},
        },
        "load": {"mass": text(load, "kg/m")},
        "resistance": {"coefficient": f, "secondary": secondary, "start_factor": 1.0},
        "speed": text(speed, "m/s"),
        "drive": {
            "motor": {
                "count": 1,
                "inertia": text(rotor, "kg*m^2"),
                "mean_starting_torque": text(force * radius / (ratio * efficiency), "N*m"),
            },
            "coupling_inertia": "0 kg*m^2",
            "gear": {"ratio": ratio, "efficiency": efficiency},
            "drum": {
                "diameter": text(2 * radius, "m"),
                "wrap": "210 deg",
                "friction": 0.3,
                "inertia": "0 kg*m^2",
            },
        },
        "takeup": {"type": str(takeup), "tension": text(tension, "N")},
        "effects": {"takeup_mass": "off"} if takeup == "gravity" else {},
        "tail_drum": {"inertia": text(tail * 0.16, "kg*m^2"), "diameter": "0.8 m"},
        "scenes": [
            {
                "type": "start",
                "load": fixed.get("load") or str(rng.choice(["full", "empty"])),
                "profile": profile,
            }
        ],
    }
