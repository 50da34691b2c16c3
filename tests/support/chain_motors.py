"""Seeded chains with random drives: conveyors and two shafts, a motor on the mains or with starting gear, and the
design file of each. A driven tail is synchronised: both sprockets are one mass. Imports nothing from `ptmcalc`.
"""

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from support.chain_fem import Strand
from support.chain_motor_fem import SYNCHRONOUS, Coupled, Gear, Plant, Seen, Teeth, imposed, start

SEED = 2911
KINDS = ("direct", "star_delta", "soft", "coupling", "kloss", "linear", "profile")
G = 9.81
SLACK_SAG = 0.02


@dataclass(frozen=True)
class Machine:
    """A plant, its motors, and its design file."""

    plant: Plant
    gear: Gear
    data: dict[str, Any]
    speed: float

    def pull(self, time: float, speed: float, delta: bool) -> float:
        """Torque of the motors at the chain [N]."""
        return self.gear.torque(time, speed * self.plant.turns, delta) * self.plant.turns

    @property
    def arm(self) -> float:
        """z p/(2 pi) [m]."""
        return float(self.data["sprocket"]["teeth"]) * float(self.data["chain"]["pitch"].split()[0]) / (2 * math.pi)


def random_machine(index: int) -> Machine:
    rng = np.random.default_rng((SEED, index))
    kind, shafts = KINDS[index % len(KINDS)], index % 4 == 3
    return _between_shafts(rng, kind) if shafts else _conveyor(rng, kind)


def with_driven_tail(index: int) -> Machine:
    """A conveyor whose tail takes a share of the pull at the speed of the driving sprocket."""
    share = float(np.random.default_rng((SEED, 11, index)).uniform(0.0, 0.7))
    return _conveyor(np.random.default_rng((SEED, index)), KINDS[index % (len(KINDS) - 1)], share)


def _between(rng: np.random.Generator, low: float, high: float) -> float:
    """Evenly distributed over decades."""
    return float(np.exp(rng.uniform(math.log(low), math.log(high))))


def _conveyor(rng: np.random.Generator, kind: str, share: float | None = None) -> Machine:
    pitch, teeth, length = float(rng.choice([0.1, 0.16, 0.25])), int(rng.integers(6, 13)), _between(rng, 10, 80)
    chain, load, lift = _between(rng, 10, 60), _between(rng, 5, 200), float(rng.uniform(-0.1, 0.3)) * length
    rubs, grown, speed = float(rng.uniform(0.1, 0.35)), float(rng.uniform(1.0, 1.4)), float(rng.uniform(0.2, 1.0))
    stiffness, fixed = _between(rng, 8e6, 1e8), bool(rng.random() < 0.4)
    level = math.sqrt(length**2 - lift**2)
    back = 1.1 * grown * rubs * chain * G * level - chain * G * lift
    on = 1.1 * grown * rubs * (chain + load) * G * level + (chain + load) * G * lift
    weight = G * length * ((2 * chain + load) * rubs + chain * abs(lift) / length)
    tension = weight * float(rng.uniform(3, 5))
    taken = (share or 0.0) * (back + on)  # off the chain at the tail
    leaving = tension - (back / 2 + back - taken + on / 2) / 2 if fixed else tension
    arm = pitch * teeth / (2 * math.pi)
    tail = float(rng.uniform(0.1, 2)) * chain * pitch**2 * teeth
    strands = Strand(length, chain + load, stiffness), Strand(length, chain, stiffness)
    ends = leaving + back - taken + on, leaving + back - taken, leaving + back, leaving
    moving = length * (2 * chain + load) + tail / arm**2
    layout = {
        "type": "conveyor",
        "length": f"{length!r} m",
        "lift": f"{lift!r} m",
        "load": f"{load!r} kg/m",
        "resistance": {"coefficient": rubs, "load_coefficient": rubs, "turn_factor": 1.1, "start_factor": grown},
        "takeup": {"type": "screw" if fixed else "gravity", "tension": f"{tension!r} N"},
        "tail": {"teeth": teeth, "inertia": f"{tail!r} kg*m^2"}
        | ({} if share is None else {"driven": "on", "share": share, "synchronised": "on"}),
    }
    travel = length * (math.sqrt((chain + load) / stiffness) + math.sqrt(chain / stiffness))
    sizes = _Sizes(pitch, teeth, chain, stiffness, speed, moving, back + on, travel)
    found = _driven(rng, kind, sizes, layout, strands, tail / arm**2, fixed, ends)
    return found if share is None else replace(found, plant=Coupled(**vars(found.plant)))


def _between_shafts(rng: np.random.Generator, kind: str) -> Machine:
    pitch, teeth, driven = 0.0254 * float(rng.choice([1, 1.5, 2])), int(rng.integers(17, 26)), int(rng.integers(25, 60))
    chain, stiffness = _between(rng, 3, 15), _between(rng, 1e7, 1e8)
    distance = pitch * float(rng.uniform(35, 70))
    small, large = (pitch / (2 * math.sin(math.pi / z)) for z in (teeth, driven))
    length, speed = math.sqrt(distance**2 - (large - small) ** 2), float(rng.uniform(0.5, 3.0))
    pull = _between(rng, 2e3, 2e4)
    tail = pull * float(rng.uniform(0.5, 4))  # the mass of the driven machine at the chain
    slack = chain * G * length / (8 * SLACK_SAG)
    other = pitch * driven / (2 * math.pi)
    layout = {
        "type": "drive",
        "centre_distance": f"{distance!r} m",
        "driven": {"teeth": driven, "inertia": f"{tail * other**2!r} kg*m^2"},
        "torque": f"{pull * other!r} N*m",
        "slack_sag": SLACK_SAG,
    }
    strand = (Strand(length, chain, stiffness),)
    sizes = _Sizes(
        pitch, teeth, chain, stiffness, speed, tail + 2 * chain * length, pull, math.sqrt(tail * length / stiffness)
    )
    return _driven(rng, kind, sizes, layout, strand, tail, False, (slack + pull, slack + pull))


@dataclass(frozen=True)
class _Sizes:
    pitch: float
    teeth: int
    chain: float
    stiffness: float
    speed: float
    moving: float
    resistance: float
    travel: float


def _driven(
    rng: np.random.Generator, kind: str, sizes: _Sizes, layout: dict[str, Any], strands: tuple[Strand, ...],
    tail: float, fixed: bool, ends: tuple[float, ...],
) -> Machine:  # fmt: skip
    """The machine with a drive that starts it in one to some seconds."""
    eta, slip = float(rng.uniform(0.85, 0.97)), float(rng.uniform(0.01, 0.04))
    locked, breakdown = float(rng.uniform(1.8, 2.4)), float(rng.uniform(2.5, 3.1))
    arm = sizes.pitch * sizes.teeth / (2 * math.pi)
    ratio = (1 - slip) * SYNCHRONOUS / sizes.speed * arm
    turns = ratio / arm
    strong = {"star_delta": 2.4, "linear": 1.6, "kloss": 3.2}.get(kind, 1.0)
    needed = max(sizes.resistance, 0.0) + sizes.moving * float(rng.uniform(0.1, 0.5))
    rated = strong * needed / eta / turns * float(rng.uniform(0.8, 1.2))
    rotor = sizes.moving * _between(rng, 0.3, 10) / turns**2
    if kind == "coupling":
        rated *= 1.2
    gear = Gear(kind, rated, slip, locked, breakdown, more=0.03, limit=1.6, time=float(rng.uniform(3, 8)))
    sprocket = float(rng.uniform(0.0, 0.1)) * sizes.moving
    damped = float(rng.uniform(0.01, 0.1)) * 2 * sizes.travel / (math.pi / 2)
    plant = Plant(strands, tail, fixed, sprocket, rotor * turns**2, eta, turns, ends, sizes.resistance, damped)
    drive: dict[str, Any] = {
        "motor": _motor(gear, rotor),
        "coupling_inertia": "0 kg*m^2",
        "gear": {"ratio": ratio, "efficiency": eta},
    }
    if kind == "star_delta":
        drive["starter"] = {"type": "star_delta", "switch_over": gear.switch}
    elif kind == "soft":
        drive["starter"] = {"type": "soft", "initial_voltage": 0.5, "time": f"{gear.time!r} s"}
    elif kind == "coupling":
        drive["coupling_inertia"], drive["motor"]["inertia"] = drive["motor"]["inertia"], "1 kg*m^2"
        drive["fluid_coupling"] = {"torque_limit": gear.limit, "slip": gear.more, "rise_time": f"{gear.time!r} s"}
    profile = {"profile": {"shape": "cosine", "time": f"{gear.time!r} s"}} if kind == "profile" else {}
    data = {
        "kind": "chain_drive",
        "accuracy": "2 %",
        "layout": layout,
        "chain": {
            "pitch": f"{sizes.pitch!r} m",
            "mass": f"{sizes.chain!r} kg/m",
            "stiffness": f"{sizes.stiffness!r} N",
            "breaking_load": f"{20 * max(ends)!r} N",
            "damping": {"law": "kelvin_voigt", "time": f"{damped!r} s"},
        },
        "sprocket": {"teeth": sizes.teeth, "inertia": f"{sprocket * arm**2!r} kg*m^2"},
        "speed": f"{sizes.speed!r} m/s",
        "drive": drive,
        "torque_limiter": {"torque": f"{20 * max(ends) * arm!r} N*m", "tolerance": "10 %"},
        "effects": {"tooth_passing": "off"},
        "scenes": [{"type": "start", **profile}],
    }
    return Machine(plant, gear, data, sizes.speed)


def _motor(gear: Gear, rotor: float) -> dict[str, Any]:
    inertia = f"{rotor!r} kg*m^2"
    rated_speed = (1 - gear.slip) * SYNCHRONOUS
    if gear.kind == "kloss":
        curve: dict[str, Any] = {
            "type": "induction",
            "power": f"{gear.rated * rated_speed!r} W",
            "speed": f"{rated_speed!r} rad/s",
            "synchronous_speed": f"{SYNCHRONOUS!r} rad/s",
            "overload": gear.breakdown,
            "formula": "simplified",
        }
        return {"inertia": inertia, "curve": curve}
    if gear.kind == "linear":
        torque = f"{gear.rated * gear.locked!r} N*m"
        return {"inertia": inertia, "curve": {"type": "linear", "starting_torque": torque, "no_load_speed": "1500 rpm"}}
    return {
        "power": f"{gear.rated * rated_speed!r} W",
        "speed": f"{rated_speed!r} rad/s",
        "inertia": inertia,
        "locked_rotor_ratio": gear.locked,
        "breakdown_ratio": gear.breakdown,
        "no_load_speed": "1500 rpm",
    }


def moved(machine: Machine, window: float, pieces: int, dt: float, teeth: Teeth | None = None) -> Seen:
    """The start in finite elements."""
    if machine.gear.kind == "profile":
        time, speed = machine.gear.time, machine.speed

        def acceleration(t: float) -> float:
            return speed * math.pi / 2 / time * math.sin(math.pi * t / time) if t < time else 0.0

        return imposed(machine.plant, acceleration, window, pieces, dt)
    switch = machine.gear.switch * SYNCHRONOUS / machine.plant.turns if machine.gear.kind == "star_delta" else 0.0
    return start(machine.plant, machine.pull, switch, window, pieces, dt, teeth)


def extremes(machine: Machine, seen: Seen) -> dict[str, float]:
    found = {
        "tension_dynamic_start": seen.entering,
        "tension_start": machine.plant.static[0] + seen.entering,
        "tension_min": min(seen.smallest, machine.plant.static[-1] - machine.plant.resistance)
        if len(machine.plant.static) == 2
        else seen.smallest,
    }
    if machine.gear.kind != "profile":
        found["limiter_torque"] = max(seen.most, -seen.least) * machine.arm
    return found
