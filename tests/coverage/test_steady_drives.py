"""Steady running on motor curves, against a search on the sum of the curves under sums of forces of their own."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq
from support import chain_starts
from support.bars import MACHINES, Trial, claim_of, known_to, misses, numbers, opposites, tried, verdicts
from support.conveyor_statics import drawn
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

    def torque(self, speed: float) -> float:
        slip = 1 - speed * self.turns / self.synchronous
        most = self.rated_slip * (self.overload + math.sqrt(self.overload**2 - 1))
        return 2 * self.overload * self.rated * slip * most / (slip**2 + most**2)

    def force(self, speed: float) -> float:
        torque = self.torque(speed)
        return self.turns * torque * (self.efficiency if torque > 0 else 1 / self.efficiency)


def right(curves: dict[str, Curve], resistance: float, speed: float) -> dict[str, float]:
    """Reserve and use of each motor, of drives that carry the load."""

    def total(v: float) -> float:
        return sum(one.force(v) for one in curves.values())

    sign = 1 if resistance > 0 else -1
    places = np.linspace(0.9 * speed, 2 * speed, 40_001)
    found = np.array([sign * total(place) for place in places])
    top = int(np.argmax(found))
    near = np.linspace(places[max(top - 1, 0)], places[min(top + 1, found.size - 1)], 4001)
    most = max(sign * total(place) for place in near)
    loads = {"steady_reserve": most / abs(resistance)}
    if most > 1.001 * abs(resistance):
        free = [one.synchronous / one.turns for one in curves.values()]
        ends = (places[top], max(free)) if sign > 0 else (min(free), places[top])
        at = brentq(lambda v: total(v) - resistance, *ends, xtol=1e-15, rtol=1e-14)
        loads |= {f"motor_utilisation[{name}]": abs(one.torque(at)) / one.rated for name, one in curves.items()}
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
    truth = {name: known_to(REFERENCE, value) for name, value in right(curves, force, speed).items()}
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
    found = {name.partition("[")[0]: value for name, value in right({"": curve}, force, speed).items()}
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
