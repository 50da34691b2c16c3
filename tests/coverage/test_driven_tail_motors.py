"""Bars of starts on motor curves hold on random conveyors whose tail is driven and synchronised.

The reference is finite elements in which both sprockets and the motors are one mass, and the motors follow their own
formulas. Teeth move all four ends of the strands against their sprockets.
"""

import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from support.bars import MACHINES, WIDEST, Limit, Trial, claim_of, misses, near, numbers, opposites, tried, wide
from support.chain_motor_fem import SYNCHRONOUS
from support.chain_motors import Machine, extremes, moved, with_driven_tail
from support.chain_starts import KIND, built
from support.held_fem import Bar, Motion, pulled_on_one_shaft, teeth

from ptmcalc.base.estimate import Estimate
from ptmcalc.engine.plan import plan_scene
from ptmcalc.machines.chain_drive.machine.strength import safety
from ptmcalc.machines.chain_drive.speed_change.motor_teeth import MOTOR_TEETH
from ptmcalc.machines.chain_drive.starting.motor_curve_waves import MOTOR_WAVES
from ptmcalc.machines.chain_drive.starting.rigid_curve import rigid_start

SEED, ALWAYS, WITH_TEETH = 3107, 6, 3
MESHES = (16, 8e-4), (32, 4e-4)
COARSE = 12, 24
LATER, LEADS = 1.5, (0.0, 0.35, 0.7)
LIMIT = Limit("safety_start", ("checks", "safety_start"), least=1e-6)
LOADS = ("tension_dynamic_start", "tension_start", "safety_start", "tension_min")
WITHOUT = {"torque_limiter": None, "effects": {"tooth_passing": "off"}}


def with_safety(machine: Machine, spec: Any, fine: dict[str, float], coarse: dict[str, float]) -> dict[str, Estimate]:
    """Loads by finite elements with what two meshes say of them."""
    off = {name: 1.5 * abs(fine[name] - coarse[name]) + 1e-3 * machine.plant.static[0] for name in fine}
    truth = {name: Estimate.within(value, off[name]) for name, value in fine.items()}
    centrifugal = machine.plant.strands[1].line_mass * machine.speed**2
    ends = [safety(spec, fine["tension_start"] + sign * off["tension_start"] + centrifugal) for sign in (1, -1)]
    return truth | {"safety_start": Estimate(sum(ends) / 2, ends[0], ends[1])}


@cache
def trial(number: int) -> Trial:
    """A machine whose chain stays taut."""
    tries = 0
    while True:
        machine = with_driven_tail(1000 * (number + 1) + tries)
        tries += 1
        spec = built(machine.data | WITHOUT)
        (scene,) = spec.all_scenes
        if not MOTOR_WAVES.usable_for(spec, scene):
            continue
        plan = plan_scene(KIND, spec, scene)
        claims = claim_of(plan, spec, MOTOR_WAVES, MOTOR_WAVES.always, 0)
        if claims["tension_min"].low > 0 and claims["tension_start"].bounded:
            break
    window = MOTOR_WAVES.run(spec, scene, MOTOR_WAVES.always, 0).window
    assert window is not None
    coarse, fine = (
        {
            name: one
            for name, one in extremes(machine, moved(machine, LATER * window[1], *mesh)).items()
            if name in LOADS
        }
        for mesh in MESHES
    )
    rng = np.random.default_rng((SEED, number))
    claimed = {"waves": {name: claims[name] for name in LOADS}}
    return tried(number, rng, KIND, spec, scene, claimed, with_safety(machine, spec, fine, coarse), [LIMIT])


@pytest.fixture(scope="module", params=numbers(ALWAYS, MACHINES))
def some(request: pytest.FixtureRequest) -> list[Trial]:
    return [trial(number) for number in request.param]


def test_the_bar_of_a_start_on_a_curve_with_a_driven_tail_holds(some: list[Trial]) -> None:
    assert misses(some, "waves") == []
    assert wide(some, "waves") <= WIDEST
    assert opposites(some) == []
    assert near(some) >= 0.4


# -- teeth of both sprockets ------------------------------------------------------------------------------------------


def ridden(machine: Machine, window: float, pieces: int) -> dict[str, float]:
    """Loads of a start with the teeth of both sprockets, the worst of several places of the joints."""
    plant, pitch = machine.plant, float(machine.data["chain"]["pitch"].split()[0])
    count = int(machine.data["sprocket"]["teeth"])
    working, back = (Bar(one.length, one.line_mass, one.stiffness, plant.retardation) for one in plant.strands)
    mass = plant.sprocket + plant.rotor + plant.tail_mass
    dt = min(bar.length / pieces * math.sqrt(bar.line_mass / bar.stiffness) for bar in (back, working)) / 2
    steps = math.ceil(window / dt)

    def started() -> Any:
        """Force of the motors less the resistance, which holds the chain until they pull more."""
        seen = {"delta": machine.gear.kind != "star_delta", "free": False}

        def force(n: int, speed: float) -> float:
            seen["delta"] |= speed * plant.turns >= machine.gear.switch * SYNCHRONOUS
            net = machine.pull(n * dt, speed, seen["delta"]) - plant.resistance
            seen["free"] |= net > 0
            return net if seen["free"] else 0.0

        return force

    def followed(ahead: tuple[Motion | None, ...]) -> tuple[np.ndarray, Motion]:
        return pulled_on_one_shaft((back, working), not plant.fixed, mass, pieces, dt, steps, started(), ahead)

    _, mean = followed((None,) * 4)
    places = np.concatenate([[0.0], (np.arange(pieces) + 0.5) / pieces, [1.0]])
    at_rest = [one + places * (two - one) for one, two in zip(plant.static[::-2], plant.static[-2::-2], strict=True)]
    entering, low = 0.0, min(plant.static)
    for head in LEADS:
        for tail in LEADS:
            on, at_tail = teeth(mean, pitch, count, head), teeth(mean, pitch, count, tail)
            off = teeth(mean, pitch, count, head + (count / 2) % 1.0)
            found, _ = followed((off if plant.fixed else None, at_tail, at_tail, on))
            entering = max(entering, float(found[1][:, -1].max()))
            low = min(low, *(float((part.min(axis=0) + one).min()) for part, one in zip(found, at_rest, strict=True)))
    return {
        "tension_dynamic_start": entering,
        "tension_start": plant.static[0] + entering,
        "tension_min": low,
    }


@cache
def toothed(number: int) -> tuple[Any, dict[str, Estimate]]:
    """A machine whose chain stays taut, without losses in the gear, and its loads by elements."""
    tries = 0
    while True:
        machine = with_driven_tail(1000 * (number + 1) + tries)
        tries += 1
        gear = machine.data["drive"]["gear"] | {"efficiency": 1.0}
        data = machine.data | {"drive": machine.data["drive"] | {"gear": gear}, "torque_limiter": None, "effects": {}}
        machine = replace(machine, data=data, plant=replace(machine.plant, efficiency=1.0))
        spec = built(data)
        (scene,) = spec.all_scenes
        if not MOTOR_TEETH.usable_for(spec, scene) or rigid_start(spec, scene) is None:
            continue
        claims = claim_of(plan_scene(KIND, spec, scene), spec, MOTOR_TEETH, MOTOR_TEETH.always, 0)
        if claims["tension_min"].low > 0 and claims["tension_start"].bounded:
            break
    window = MOTOR_TEETH.run(spec, scene, MOTOR_TEETH.always, 0).window
    assert window is not None
    coarse, fine = (ridden(machine, LATER * window[1], pieces) for pieces in COARSE)
    return spec, with_safety(machine, spec, fine, coarse)


def of_teeth(number: int) -> Trial:
    spec, truth = toothed(number)
    (scene,) = spec.all_scenes
    plan = plan_scene(KIND, spec, scene)
    claimed = {
        way: {name: claim_of(plan, spec, solver, solver.always, level)[name] for name in LOADS}
        for way, solver, level in (("teeth", MOTOR_TEETH, 0), ("finer", MOTOR_TEETH, 1), ("bound", MOTOR_WAVES, 0))
    }
    return tried(number, np.random.default_rng((SEED, 1, number)), KIND, spec, scene, claimed, truth, [LIMIT])


@pytest.fixture(scope="module", params=numbers(WITH_TEETH, MACHINES // 5))
def toothed_ones(request: pytest.FixtureRequest) -> list[Trial]:
    return [of_teeth(number) for number in request.param]


@pytest.mark.parametrize("way", ["teeth", "finer", "bound"])
def test_the_bar_of_a_start_with_the_teeth_of_both_sprockets_holds(toothed_ones: list[Trial], way: str) -> None:
    assert misses(toothed_ones, way) == []
    assert opposites(toothed_ones) == []
    if way != "bound":
        assert wide(toothed_ones, way) <= WIDEST
