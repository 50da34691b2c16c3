"""Steady running on motor curves, against a search on the sum of the curves under sums of forces of their own."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq
from support import chain_starts
from support.bars import MACHINES, Trial, claim_of, known_to, misses, numbers, opposites, tried, verdicts
from support.conveyor_statics import Statics, drawn
from support.machines import loaded

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.chain_drive.running.motor_torque import STEADY_DRIVE as OF_CHAIN
from ptmcalc.machines.conveyor.running.motor_torque import STEADY_DRIVE as OF_BELT

WITHOUT_BARS = {"conveyor": ("steady_drive",), "chain_drive": ("chain_steady_drive",)}
CONVEYOR = load_kind("conveyor")
SEED, ALWAYS, CLIMBED = 1931, 60, 20
REFERENCE = 1e-6


class Curve:
    """An induction motor by its plate, with gear and pulley: force over belt or chain speed by the formula of Kloss."""

    def __init__(self, rng: np.random.Generator, power: float, turns: float, efficiency: float, speed: float) -> None:
        self.synchronous = float(rng.uniform(1.01, 1.04)) * speed * turns
        self.rated_slip = float(rng.uniform(0.008, 0.06))
        self.overload, self.turns, self.efficiency = float(rng.uniform(1.6, 3.2)), turns, efficiency
        self.rated = power / ((1 - self.rated_slip) * self.synchronous)
        self.data = {
            "type": "induction",
            "power": f"{power!r} W",
            "speed": f"{(1 - self.rated_slip) * self.synchronous!r} rad/s",
            "synchronous_speed": f"{self.synchronous!r} rad/s",
            "overload": self.overload,
        }

    def torque(self, speed: Any) -> Any:
        slip = 1 - speed * self.turns / self.synchronous
        most = self.rated_slip * (self.overload + math.sqrt(self.overload**2 - 1))
        return 2 * self.overload * self.rated * slip * most / (slip**2 + most**2)

    def force(self, speed: Any) -> Any:
        torque = self.torque(speed)
        return self.turns * torque * np.where(torque > 0, self.efficiency, 1 / self.efficiency)

    def used(self, force: float) -> float:
        """Torque over the rated one, of a force at the belt or chain."""
        return abs(force) / self.turns * (1 / self.efficiency if force > 0 else self.efficiency) / self.rated


Forces = Callable[[np.ndarray], dict[str, np.ndarray]]
"""Force of each drive over the speed of the belt without tension."""


def at_one_speed(curves: dict[str, Curve]) -> Forces:
    return lambda speeds: {name: one.force(speeds) for name, one in curves.items()}


def with_creep(machine: Statics, curves: dict[str, Curve], at_tail: float) -> Forces:
    """Each pulley has the speed of the belt that enters it, which its tension stretches; `at_tail` is what the drives
    at the tail pull, as far as the mean tension of a fixed loop depends on it."""
    rig = machine.rig
    in_order = [name for place in ("tail", "head") for name, drive in rig.drives.items() if drive.at == place]
    back, carry, _ = machine.courses(at_tail)

    def forces(speeds: np.ndarray) -> dict[str, np.ndarray]:
        found: dict[str, np.ndarray] = {}
        tensions = {"tail": back[-1], "head": carry[-1] + at_tail}
        for name in in_order:
            place = rig.drives[name].at
            found[name] = curves[name].force(speeds * (1 + tensions[place] / rig.stiffness))
            tensions["head"] = tensions["head"] - found[name]
            if place == "tail":
                tensions["tail"] = tensions["tail"] - found[name]
        return found

    return forces


def on_curves(curves: dict[str, Curve], resistance: float, forces: Forces) -> dict[str, float]:
    """Forces where they balance the resistance, at the highest speed that does (the lowest, where the load drives)."""
    free = [one.synchronous / one.turns for one in curves.values()]
    sign = 1 if resistance > 0 else -1
    ends = (0.3 * min(free), 1.05 * max(free)) if sign > 0 else (0.8 * min(free), 2 * max(free))
    grid = np.linspace(*ends, 20_001)
    surplus = sum(forces(grid).values()) - resistance
    crossings = np.flatnonzero((surplus[:-1] > 0) & (surplus[1:] <= 0))
    if crossings.size == 0:
        return {}
    k = crossings[-1 if sign > 0 else 0]
    at = brentq(lambda v: float(sum(forces(v).values())) - resistance, grid[k], grid[k + 1], xtol=1e-15, rtol=1e-14)
    return {name: float(force) for name, force in forces(at).items()}


def crept(machine: Statics, curves: dict[str, Curve], resistance: float) -> dict[str, float]:
    """The forces with the creep of the belt, once what the tail pulls is what its drives pull."""
    at_tail = 0.0
    for _ in range(100):
        found = on_curves(curves, resistance, with_creep(machine, curves, at_tail))
        pulled = sum(force for name, force in found.items() if machine.rig.drives[name].at == "tail")
        if abs(pulled - at_tail) <= 1e-12 * abs(resistance):
            return found
        at_tail = pulled
    raise AssertionError("what the tail pulls does not settle")


def right(
    curves: dict[str, Curve], resistance: float, speed: float, forces: Callable[[], dict[str, float]]
) -> dict[str, float]:
    """Reserve and use of each motor, of drives that carry the load."""

    def total(speeds: np.ndarray) -> np.ndarray:
        return np.sum([one.force(speeds) for one in curves.values()], axis=0)

    sign = 1 if resistance > 0 else -1
    places = np.linspace(0.9 * speed, 2 * speed, 40_001)
    top = int(np.argmax(sign * total(places)))
    near = np.linspace(places[max(top - 1, 0)], places[min(top + 1, places.size - 1)], 4001)
    most = float(np.max(sign * total(near)))
    loads = {"steady_reserve": most / abs(resistance)}
    if most > 1.001 * abs(resistance):
        loads |= {f"motor_utilisation[{name}]": curves[name].used(force) for name, force in forces().items()}
    return loads


def power_of(rng: np.random.Generator, force: float, speed: float, drives: int) -> float:
    return abs(force) * speed / drives * float(np.exp(rng.uniform(math.log(0.4), math.log(2.5))))


def belt_trial(number: int) -> Trial:
    rng = np.random.default_rng((SEED, number))
    machine = drawn(rng)
    data: dict[str, Any] = machine.running()
    force, speed = machine.run()["effective_tension"], machine.rig.speed
    drives = data["drives"] if "drives" in data else {"head": data["drive"]}
    curves = {
        name: Curve(
            rng, power_of(rng, force, speed, len(drives)), rig.ratio / (rig.diameter / 2), rig.efficiency, speed
        )
        for name, rig in machine.rig.drives.items()
    }
    for name, drive in drives.items():
        drive["motor"] |= {"curve": curves[name].data, "count": 1}
    spec = loaded(data).spec
    assert spec is not None
    (scene,) = spec.all_scenes
    truth = {
        name: known_to(REFERENCE, value)
        for name, value in right(curves, force, speed, lambda: crept(machine, curves, force)).items()
    }
    claims = {"steady_drive": claim_of(plan_scene(CONVEYOR, spec, scene), spec, OF_BELT)}
    return tried(number, rng, CONVEYOR, spec, scene, claims, truth, climbs=number % CLIMBED == 0)


def chain_trial(number: int) -> Trial:
    rng = np.random.default_rng((SEED, 1, number))
    data = chain_starts.random_chain(rng)
    data["layout"]["resistance"] |= {"turn_factor": 1.0}
    data["scenes"] = [{"type": "run"}]
    length, lift, load = (float(str(data["layout"][key]).split()[0]) for key in ("length", "lift", "load"))
    mass, speed = float(data["chain"]["mass"].split()[0]), float(data["speed"].split()[0])
    level = math.sqrt(length**2 - lift**2)
    force = 9.81 * (data["layout"]["resistance"]["coefficient"] * level * (2 * mass + load) + load * lift)
    arm = float(data["chain"]["pitch"].split()[0]) * data["sprocket"]["teeth"] / (2 * math.pi)
    gear = data["drive"]["gear"]
    curve = Curve(rng, power_of(rng, force, speed, 1), gear["ratio"] / arm, gear["efficiency"], speed)
    data["drive"]["motor"] |= {"curve": curve.data}
    spec = chain_starts.built(data)
    (scene,) = spec.all_scenes
    one = {"": curve}
    found = {
        name.partition("[")[0]: value
        for name, value in right(one, force, speed, lambda: on_curves(one, force, at_one_speed(one))).items()
    }
    truth = {name: known_to(REFERENCE, value) for name, value in found.items()}
    claims = {"chain_steady_drive": claim_of(plan_scene(chain_starts.KIND, spec, scene), spec, OF_CHAIN)}
    return tried(number, rng, chain_starts.KIND, spec, scene, claims, truth, climbs=number % CLIMBED == 0)


WAYS: dict[str, Callable[[int], Trial]] = {"steady_drive": belt_trial, "chain_steady_drive": chain_trial}


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("machines", numbers(ALWAYS, MACHINES))
def test_the_motors_have_the_torque_that_the_curves_say(way: str, machines: range) -> None:
    trials = [WAYS[way](number) for number in machines]
    assert misses(trials, way) == []
    assert opposites(trials) == []
    said = verdicts(trials, "CNV121", "CNV122", "CHN130", "CHN131")
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.1 * len(said)
