"""A climb of the rope to its next layer as numbers: the load on its rope, the radius of the drum over its angle."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base import units
from ptmcalc.contract.result import Finding, History
from ptmcalc.laws import rope_drum, vibration, winding
from ptmcalc.machines.hoist.machine import model
from ptmcalc.machines.hoist.machine.model import filled
from ptmcalc.machines.hoist.machine.spec import Hoist, WindUp
from ptmcalc.numerics.hauling import Map, Rope

FloatArray = NDArray[np.float64]

PER_PERIOD, MOST_SAMPLES = 24, 6001
"""Samples of a history; numerical choices. `PER_PERIOD`: in a period of the rope's vibration. `MOST_SAMPLES`: maximum.
More draw the history more smoothly and need memory."""


@dataclass(frozen=True, slots=True)
class Climb:
    """The load on its rope as the rope climbs."""

    drum_speed: float
    """rad/s"""
    mass: float
    """on the tackle [kg]"""
    length: float
    """of one rope, drum to end, at the beginning [m]"""
    frequency: float
    """of the load on its rope [rad/s]"""
    step: float
    """by which the rope climbs [m]"""
    mean_stress: float
    """of the rope at rest [N/m^2]"""


def climb(spec: Hoist, scene: WindUp) -> Climb:
    """The climb of a scene."""
    height, mass = model.hook_height(scene), model.hook_mass(spec, scene)
    return Climb(
        drum_speed=model.drum_speed(spec),
        mass=mass,
        length=model.rope_length(spec, height),
        frequency=vibration.natural_frequency(model.hook_stiffness(spec, height), mass),
        step=model.layer_step(spec),
        mean_stress=winding.fall_stress(mass * spec.gravity, spec.reeving.falls, model.metallic_area(spec)),
    )


def sudden_ratio(spec: Hoist, scene: WindUp) -> float:
    """Dynamic over mean stress if the rope climbed at once [1]."""
    case = climb(spec, scene)
    falls, ropes = spec.reeving.falls, spec.reeving.ropes
    return winding.sudden_ratio(case.drum_speed, case.step, case.frequency, falls, ropes, spec.gravity)


# -- the drum -------------------------------------------------------------------------------------------------------


def turns(spec: Hoist, scene: WindUp) -> float:
    """Turns from the climb until the layer is full or the hook is up; a whole number of crossovers, one at least."""
    room = rope_drum.turns_in_layer(model.layer_turns(spec), spec.winding.packing, scene.layer)
    turn = 2 * math.pi * model.layer_radius(spec, scene.layer)
    left = (spec.height - model.hook_height(scene)) * model.falls_of_a_rope(spec) / turn - 1
    crossovers = spec.winding.crossovers
    return max(1, math.floor(min(room, left) * crossovers)) / crossovers


def radius_map(spec: Hoist, scene: WindUp) -> Map:
    """Radius of the rope over the angle of the drum, from half a crossover before the climb."""
    step = model.layer_step(spec)
    corners = winding.winding_radius(
        model.layer_radius(spec, scene.layer - 1),
        step,
        winding.crossover_rise(spec.rope.diameter, step),
        spec.winding.crossovers,
        filled(spec.winding.crossover),
        turns(spec, scene),
    )
    return Map(corners[:, 0], corners[:, 1])


def rope(spec: Hoist, scene: WindUp) -> Rope:
    """The rope and its load, for the motion over the map."""
    case = climb(spec, scene)
    strain = case.mean_stress / filled(spec.rope.modulus)
    return Rope(
        length=case.length / (1 + strain),
        rate=case.frequency**2 * case.length,
        static_strain=strain,
        damping_ratio=spec.rope.damping,
    )


# -- resonance ------------------------------------------------------------------------------------------------------


def crossover_ratios(spec: Hoist, scene: WindUp) -> tuple[float, float]:
    """Frequency of the crossovers over that of the load: with the rope at its shortest on the layer, and longest."""
    case = climb(spec, scene)
    longest = winding.crossover_ratio(spec.winding.crossovers, case.drum_speed, case.frequency)
    wound = 2 * math.pi * model.layer_radius(spec, scene.layer) * turns(spec, scene)
    return longest * math.sqrt(max(1 - wound / case.length, 0.0)), longest


def detuning(spec: Hoist, scene: WindUp) -> float:
    """Least distance of the crossovers from resonance while the layer is wound; 0 where they pass through it [1]."""
    low, high = crossover_ratios(spec, scene)
    return max(low - 1, 1 - high, 0.0)


# -- what is said of it ---------------------------------------------------------------------------------------------


def place_of_the_climb(spec: Hoist, scene: WindUp) -> tuple[Finding, ...]:
    """Where on the way of the hook the rope really climbs, for a scene that does not say it."""
    heights = model.layer_heights(spec)
    if scene.hook_height is not None or (scene.layer <= len(heights) and heights[scene.layer - 1] <= 0):
        return ()
    assumes = f"scene `{scene.label}` assumes the lowest hook position (longest rope);"
    if scene.layer > len(heights):
        message = f"{assumes} the rope never reaches layer {scene.layer} on this drum"
        hint = f"write `layer: {len(heights)}`" if len(heights) > 1 else "delete the scene"
        return (Finding("NUM104", message, ("scenes",), hint),)
    said = units.show(heights[scene.layer - 1], units.SPAN)
    message = f"{assumes} layer {scene.layer} starts at hook height {said}"
    return (Finding("NUM104", message, ("scenes",), f"write `hook_height: {said}`"),)


def histories(
    end: float, frequency: float, stretch_and_stress: Callable[[FloatArray], tuple[FloatArray, FloatArray]], mean: float
) -> dict[str, History]:
    """Stretch, stress and its ratio to the mean over time from 0."""
    count = min(MOST_SAMPLES, 201 + math.ceil(end * frequency / (2 * math.pi) * PER_PERIOD))
    times = np.linspace(0.0, end, count)
    stretch, stress = stretch_and_stress(times)
    moments: Sequence[float] = times.tolist()
    return {
        "winding_displacement_max": History(units.LENGTH, moments, stretch.tolist()),
        "winding_stress_max": History(units.STRESS, moments, stress.tolist()),
        "winding_stress_ratio": History(units.RATIO, moments, (stress / mean).tolist()),
    }
