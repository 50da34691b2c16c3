"""Seeded random conveyors over all that a file can say: from a metre to 20 km, every scene, one to three drives.

They need not be sound: drives too weak, belts too slack, brakes too strong are among them.
"""

import math
from typing import Any

import numpy as np


def _even(rng: np.random.Generator, low: float, high: float) -> float:
    return float(np.exp(rng.uniform(math.log(low), math.log(high))))


def _drive(rng: np.random.Generator, force: float) -> dict[str, Any]:
    ratio, diameter = float(rng.uniform(8, 40)), float(rng.choice([0.3, 0.5, 0.8, 1.0, 1.4]))
    count = int(rng.integers(1, 4))
    motor: dict[str, Any] = {"count": count, "inertia": f"{_even(rng, 0.005, 20)} kg*m^2"}
    torque = force * diameter / 2 / ratio / 0.94 / count
    if rng.random() < 0.7:
        motor["mean_starting_torque"] = f"{torque} N*m"
    else:
        motor["largest_starting_torque"], motor["smallest_starting_torque"] = (
            f"{1.3 * torque} N*m",
            f"{0.7 * torque} N*m",
        )
    drum: dict[str, Any] = {"diameter": f"{diameter} m", "wrap": f"{rng.uniform(150, 230)} deg"}
    drive: dict[str, Any] = {"motor": motor, "gear": {"ratio": ratio}, "drum": drum}
    if rng.random() < 0.85:
        drum["friction"] = float(rng.uniform(0.1, 0.5))
    if rng.random() < 0.5:
        drum["inertia"] = f"{_even(rng, 0.1, 1000)} kg*m^2"
    if rng.random() < 0.5:
        drive["coupling_inertia"] = f"{_even(rng, 0.001, 5)} kg*m^2"
    return drive


def _route(rng: np.random.Generator, length: float) -> list[tuple[float, float]]:
    count = int(rng.integers(1, 5)) if rng.random() < 0.5 else 1
    parts = np.maximum(rng.dirichlet(np.ones(count)) * length, 1e-3)
    steep = 1.0 if length < 2000 or rng.random() < 0.7 else 0.2
    return [(float(part), float(part) * math.sin(math.radians(rng.uniform(-18, 18) * steep))) for part in parts]


def _scenes(rng: np.random.Generator) -> list[dict[str, Any]]:
    time = f"{_even(rng, 0.5, 30)} s"

    def start(**more: Any) -> dict[str, Any]:
        return {"type": "start"} | more

    def profile(**more: Any) -> dict[str, Any]:
        return {"shape": str(rng.choice(["ramp", "cosine", "parabolic"])), "time": time} | more

    pool = [
        {"type": "run"},
        {"type": "run", "load": "empty"},
        {"type": "stop"},
        {"type": "stop", "brakes": "off", "load": "empty"},
        {"type": "emergency_stop"},
        {"type": "coast", "measured_distance": f"{_even(rng, 1, 200)} m"},
        {"type": "jam", "at": "head"},
        {"type": "jam", "at": "tail"},
        {"type": "backstop"},
        start(),
        start(load="empty"),
        start(belt="relaxed"),
        start(profile=profile()),
        start(profile=profile(control="torque")),
        start(aborted={"run": f"{rng.uniform(0.5, 4)} s", "pause": f"{rng.uniform(0, 2)} s"}),
        start(load="uphill"),
        start(load="downhill"),
    ]
    return [pool[k] | {"name": f"s{k}"} for k in rng.permutation(len(pool))[:3]]


def any_conveyor(seed: int) -> dict[str, Any]:
    """One machine with three scenes as the data of a design file."""
    rng = np.random.default_rng(seed)
    length, g = _even(rng, 1, 20000), 9.81
    parts = _route(rng, length)
    width = float(rng.choice([0.4, 0.65, 1.0, 1.4, 2.0]))
    belt, load, speed = width * float(rng.uniform(6, 40)), _even(rng, 0.5, 400) * width, _even(rng, 0.05, 8)
    friction, secondary = float(rng.uniform(0.012, 0.035)), 1.05 + 60 / max(length, 80)
    carry, back = width * float(rng.uniform(8, 25)), width * float(rng.uniform(3, 10))
    pull = abs(sum(lift for _, lift in parts)) * load * g
    pull += friction * g * secondary * length * (2 * belt + load + carry + back)
    force = pull * float(rng.uniform(0.9, 2.2))
    tension = pull * _even(rng, 0.1, 2) + 6 * (belt + load) * g
    rigid = bool(rng.random() < 0.35)
    sections = [{"length": f"{part} m", "lift": f"{lift} m"} for part, lift in parts]
    data: dict[str, Any] = {
        "kind": "conveyor",
        "route": {"sections": sections} if len(sections) > 1 else sections[0],
        "belt": {
            "mass": f"{belt} kg/m",
            "stiffness": f"{_even(rng, 1e6, 2e8) * width} N",
            "breaking_force": f"{tension * _even(rng, 3, 60)} N",
            "carcass": str(rng.choice(["textile", "steel_cord"])),
        },
        "idlers": {"carry": {"line_mass": f"{carry} kg/m"}, "return": {"line_mass": f"{back} kg/m"}},
        "load": {"mass": f"{load} kg/m"},
        "resistance": {"coefficient": friction, "secondary": secondary},
        "speed": f"{speed} m/s",
        "takeup": {"type": "rigid" if rigid else "gravity", "tension": f"{tension} N"},
    }
    if rng.random() < 0.7:
        data["idlers"]["carry"]["pitch"] = f"{rng.uniform(0.8, 1.5)} m"
        data["idlers"]["return"]["pitch"] = f"{rng.uniform(2, 4)} m"
    for key, share, low, high in (
        ("start_factor", 0.5, 1, 1.5),
        ("speed_share", 0.2, 0, 0.6),
        ("stop_factor", 0.2, 0.4, 1),
    ):
        if rng.random() < share:
            data["resistance"][key] = float(rng.uniform(low, high))
    if not rigid and rng.random() < 0.4:
        data["takeup"]["mass"] = f"{2 * tension / g} kg"
    count = int(rng.choice([1, 1, 1, 2, 3]))
    if count == 1:
        data["drive"] = _drive(rng, force)
    else:
        data["drives"] = {f"d{number}": _drive(rng, force / count) for number in range(count)}
        for number in range(1, count):
            if rng.random() < 0.3:
                data["drives"][f"d{number}"]["at"] = "tail"
            if rng.random() < 0.3:
                data["drives"][f"d{number}"]["delay"] = f"{rng.uniform(0, 3)} s"
    if rng.random() < 0.6:
        data["brakes"] = {
            f"b{number}": {
                "torque": f"{pull * _even(rng, 0.01, 2)} N*m",
                "delay": f"{rng.uniform(0, 2)} s",
                "rise_time": f"{rng.uniform(0, 2)} s",
                "at": str(rng.choice(["head", "head", "tail"])),
            }
            for number in range(int(rng.integers(1, 3)))
        }
    if rng.random() < 0.3:
        data["backstop"] = {"torque": f"{pull * _even(rng, 0.1, 3)} N*m"}
    if rng.random() < 0.6:
        data["tail_drum"] = {"inertia": f"{_even(rng, 0.01, 1000)} kg*m^2", "diameter": "0.6 m"}
    data["checks"] = {
        "stop_distance": f"{_even(rng, 0.1, 200)} m",
        "emergency_stop_distance": f"{_even(rng, 0.1, 100)} m",
        "stop_time": f"{_even(rng, 0.5, 100)} s",
        "slip_heat": f"{_even(rng, 1, 1e6)} J",
    }
    data["scenes"] = _scenes(rng)
    return data
