"""Seeded random conveyors for the scenes of the whole belt: routes by sections, several drives, brakes, take-ups."""

from typing import Any

import numpy as np

SCENES = ("stop", "coast", "jam", "relaxed", "aborted", "emergency_stop")


def _drive(rng: np.random.Generator, count: int) -> dict[str, Any]:
    return {
        "motor": {
            "count": count,
            "inertia": f"{rng.uniform(1, 8):.3f} kg*m^2",
            "mean_starting_torque": f"{rng.uniform(600, 3000):.1f} N*m",
        },
        "coupling_inertia": f"{rng.uniform(0.2, 3):.3f} kg*m^2",
        "gear": {"ratio": round(float(rng.uniform(12, 30)), 2), "efficiency": 0.94},
        "drum": {
            "diameter": "1000 mm",
            "wrap": f"{rng.uniform(180, 220):.1f} deg",
            "friction": round(float(rng.uniform(0.25, 0.4)), 3),
            "inertia": f"{rng.uniform(50, 500):.1f} kg*m^2",
        },
    }


def _scene(rng: np.random.Generator, kind: str) -> dict[str, Any]:
    if kind == "jam":
        return {"type": "jam", "at": str(rng.choice(["head", "tail"]))}
    if kind == "relaxed":
        return {"type": "start", "belt": "relaxed"}
    if kind == "aborted":
        return {
            "type": "start",
            "aborted": {"run": f"{rng.uniform(1, 4):.2f} s", "pause": f"{rng.uniform(0, 2):.2f} s"},
            "profile": {"shape": "ramp", "control": "torque", "time": f"{rng.uniform(1, 6):.2f} s"},
        }
    if kind == "emergency_stop":
        return {"type": kind, "load": str(rng.choice(["full", "empty", "uphill"]))}
    return {"type": kind}


def random_scene(seed: int, kind: str = "") -> dict[str, Any]:
    """One machine in one scene, of the kind asked or drawn, as the data of a design file."""
    rng = np.random.default_rng(seed)
    sections = [
        {"length": f"{rng.uniform(80, 600):.1f} m", "lift": f"{rng.uniform(-12, 25):.2f} m"}
        for _ in range(int(rng.integers(1, 4)))
    ]
    tension = rng.uniform(40, 300)
    data: dict[str, Any] = {
        "kind": "conveyor",
        "route": {"sections": sections},
        "belt": {"mass": f"{rng.uniform(10, 30):.2f} kg/m", "stiffness": f"{rng.uniform(8, 120):.2f} MN"},
        "idlers": {
            "carry": {"line_mass": f"{rng.uniform(10, 30):.2f} kg/m"},
            "return": {"line_mass": f"{rng.uniform(4, 15):.2f} kg/m"},
        },
        "load": {"mass": f"{rng.uniform(30, 220):.2f} kg/m"},
        "resistance": {
            "coefficient": round(float(rng.uniform(0.015, 0.035)), 4),
            "secondary": 1.2,
            "start_factor": 1.1,
        },
        "speed": f"{rng.uniform(1.5, 5):.2f} m/s",
        "tail_drum": {"inertia": f"{rng.uniform(10, 300):.1f} kg*m^2", "diameter": "800 mm"},
    }
    if rng.random() < 0.4:
        data["drives"] = {"one": _drive(rng, 2), "two": _drive(rng, 1)}
        if rng.random() < 0.3:
            data["drives"]["three"] = _drive(rng, 1) | {"at": "tail"}
    else:
        data["drive"] = _drive(rng, 2)
    if rng.random() < 0.7:
        data["takeup"] = {"type": "gravity", "tension": f"{tension:.2f} kN"}
        if rng.random() < 0.5:
            data["takeup"]["mass"] = f"{2 * tension / 9.81:.3f} t"
        else:
            data["effects"] = {"takeup_mass": "off"}
    else:
        data["takeup"] = {"type": "rigid", "tension": f"{2 * tension:.2f} kN"}
    data["brakes"] = {
        "disc": {
            "torque": f"{rng.uniform(3, 40):.2f} kN*m",
            "delay": f"{rng.uniform(0, 1):.2f} s",
            "rise_time": f"{rng.uniform(0, 2):.2f} s",
        }
    }
    data["scenes"] = [_scene(rng, kind or SCENES[int(rng.integers(len(SCENES)))])]
    return data
