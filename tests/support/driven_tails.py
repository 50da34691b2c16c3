"""Seeded conveyors whose tail is driven, with tensions at rest worked out from the numbers of their design file."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from support.chain_starts import scraper
from support.held_fem import Bar, Motion

SEED, G = 4711, 9.81


@dataclass(frozen=True)
class Machine:
    """A conveyor with a driven tail: both strands, tensions at rest at their ends, what both drives pull in steady
    motion, teeth, and its design file."""

    back: Bar
    working: Bar
    static: tuple[tuple[float, float], tuple[float, float]]
    pull: float
    fixed: bool
    pitch: float
    teeth: tuple[int, int]
    speed: float
    shape: str
    time: float
    data: dict[str, Any]

    @property
    def bars(self) -> tuple[Bar, Bar]:
        return self.back, self.working

    def resting(self, strand: int, pieces: int) -> np.ndarray:
        """Tension at rest at the beginning, the middle of each element, and the end of a strand [N]."""
        places = np.concatenate([[0.0], (np.arange(pieces) + 0.5) / pieces, [1.0]])
        begin, end = self.static[strand]
        return begin + places * (end - begin)


def between(rng: np.random.Generator, low: float, high: float) -> float:
    """Evenly distributed over decades."""
    return float(np.exp(rng.uniform(math.log(low), math.log(high))))


def random_machine(index: int, grown: float = 1.0, synchronised: bool = False, **scene: Any) -> Machine:
    """A conveyor with a driven tail; `grown` is the factor on its resistance in the scene."""
    rng = np.random.default_rng((SEED, index))
    pitch, z, tail = float(rng.choice([0.1, 0.16, 0.25])), int(rng.integers(7, 14)), int(rng.integers(7, 14))
    length, chain, load = between(rng, 8, 80), between(rng, 10, 60), between(rng, 5, 200)
    lift, rubs = float(rng.uniform(-0.05, 0.2)) * length, float(rng.uniform(0.1, 0.35))
    stiffness, fixed, ratio = between(rng, 1e7, 1e8), bool(rng.random() < 0.5), float(rng.uniform(0.02, 0.15))
    speed, shape = float(rng.uniform(0.1, 0.5)), str(rng.choice(["ramp", "cosine", "parabolic"]))
    level = math.sqrt(length**2 - lift**2)
    back = 1.1 * grown * rubs * chain * G * level - chain * G * lift
    on = 1.1 * grown * rubs * (chain + load) * G * level + (chain + load) * G * lift
    weight = G * length * ((2 * chain + load) * rubs + chain * abs(lift) / length)
    tension = weight * float(rng.uniform(1.5, 4))
    share = float(np.random.default_rng((SEED, 11, index)).uniform(0.0, 1.0))
    behind = -share * (back + on)  # the tail takes its share of the pull off the chain
    leaving = tension - (back / 2 + back + behind + on / 2) / 2 if fixed else tension
    transit = length * math.sqrt((chain + load) / stiffness)
    time = transit * between(rng, 0.5, 60)
    damping = 2 * ratio * transit / math.pi
    data = scraper()
    data["layout"] |= {
        "length": f"{length!r} m",
        "lift": f"{lift!r} m",
        "load": f"{load!r} kg/m",
        "resistance": {
            "coefficient": rubs, "load_coefficient": rubs, "turn_factor": 1.1, "start_factor": max(grown, 1.0),
            "stop_factor": min(grown, 1.0),
        },
        "takeup": {"type": "screw" if fixed else "gravity", "tension": f"{tension!r} N"},
        "tail": {
            "teeth": tail, "inertia": f"{between(rng, 1, 30)!r} kg*m^2", "driven": "on",
            "share": share, "synchronised": "on" if synchronised else "off",
        },
    }  # fmt: skip
    data["chain"] |= {
        "pitch": f"{pitch!r} m", "mass": f"{chain!r} kg/m", "count": 1, "unevenness": 1.0,
        "stiffness": f"{stiffness!r} N", "damping": {"law": "kelvin_voigt", "ratio": ratio},
        "breaking_load": f"{10 * tension!r} N",
    }  # fmt: skip
    data["sprocket"] = {"teeth": z, "inertia": "10 kg*m^2"}
    data["speed"] = f"{speed!r} m/s"
    data["drive"]["gear"] = {"ratio": 40, "efficiency": 1.0}
    start = {"type": "start", "profile": {"shape": shape, "time": f"{time!r} s"}}
    data["scenes"] = [scene or start]
    turned = leaving + back  # by the tail
    static = (leaving, turned), (turned + behind, turned + behind + on)
    bars = Bar(length, chain, stiffness, damping), Bar(length, chain + load, stiffness, damping)
    return Machine(*bars, static, back + on, fixed, pitch, (z, tail), speed, shape, time, data)


def stacked(parts: list[Motion]) -> Motion:
    """Motions side by side, as columns."""
    way, speed, rate = (np.stack([one[which] for one in parts], axis=1) for which in range(3))
    return way, speed, rate


def total(one: Motion, other: Motion) -> Motion:
    return one[0] + other[0], one[1] + other[1], one[2] + other[2]
