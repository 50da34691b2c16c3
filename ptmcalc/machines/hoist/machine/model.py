"""A hoist as numbers: its tackle, its rope as a spring, its drum layer by layer, its drive reduced to a shaft."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.laws import gearing, hoisting, lift_off_standard, reeving, rope_drum, rope_rod, wire_rope
from ptmcalc.machines.hoist.machine.spec import Hoist, HoistScene
from ptmcalc.numerics.distinct import distinct

FloatArray = NDArray[np.float64]

MOST_LAYERS = 10_000
"""Layers that are evaluated one by one; a numerical choice. Of more layers some are taken together, on the safe side.
More take longer."""


def filled(value: float | None) -> float:
    """A value the file or an assumption has given by now."""
    assert value is not None, "assumptions are filled in before anything is computed"
    return value


# -- load and tackle ------------------------------------------------------------------------------------------------


def hook_mass(spec: Hoist, scene: HoistScene) -> float:
    """What hangs on the hook block, the block in it [kg]."""
    return spec.hook_block + (spec.load if scene.load == "full" else 0.0)


def loaded(spec: Hoist, scene: HoistScene) -> bool:
    """Whether the rated load hangs on the hook: what an empty hook does not ask is not asked of it."""
    return scene.load == "full"


def fall_length(spec: Hoist, hook_height: float) -> float:
    """Of a fall with the hook so high above its lowest position [m]."""
    return spec.least_fall + spec.height - hook_height


def hook_height(scene: HoistScene) -> float:
    """Of the hook above its lowest position [m]."""
    return scene.hook_height if scene.hook_height is not None else 0.0


def deflection_efficiency(spec: Hoist) -> float:
    """Of all sheaves between drum and tackle [1]."""
    given = spec.reeving
    one = given.deflection_efficiency if given.deflection_efficiency is not None else filled(given.sheave_efficiency)
    return one**given.deflection_sheaves


def falls_of_a_rope(spec: Hoist) -> int:
    """Falls of one of the ropes that run onto the drum."""
    return spec.reeving.falls // spec.reeving.ropes


@dataclass(frozen=True, slots=True)
class Pulls:
    """Pulls of one rope while the hook moves evenly [N]."""

    drum: float
    """at the drum"""
    least: float
    """smallest of all falls, at its lower end"""


def fall_weight(spec: Hoist, hook_height: float) -> float:
    """Of the rope in a fall [N]."""
    return filled(spec.rope.mass) * fall_length(spec, hook_height) * spec.gravity


def fall_pulls(spec: Hoist, mass: float, hook_height: float, hauling: bool) -> FloatArray:
    """Pulls at the upper ends of the falls of one rope, that of the drum first [N]."""
    load, efficiency = mass * spec.gravity / spec.reeving.ropes, filled(spec.reeving.sheave_efficiency)
    return reeving.fall_pulls(load, falls_of_a_rope(spec), efficiency, fall_weight(spec, hook_height), hauling)


def pulls(spec: Hoist, mass: float, hook_height: float, hauling: bool) -> Pulls:
    """Pulls of one rope with a mass on the hook, the rope's own weight in it."""
    ends, weight = fall_pulls(spec, mass, hook_height, hauling), fall_weight(spec, hook_height)
    lost = deflection_efficiency(spec)
    at_drum = float(ends[0]) / lost if hauling else float(ends[0]) * lost
    return Pulls(at_drum, float(ends.min()) - weight)


# -- rope -----------------------------------------------------------------------------------------------------------


def metallic_area(spec: Hoist) -> float:
    """Of one rope [m^2]."""
    rope = spec.rope
    return rope.area if rope.area is not None else wire_rope.metallic_area(rope.diameter, filled(rope.fill_factor))


def rope_length(spec: Hoist, hook_height: float) -> float:
    """Of one rope between drum and fixed end or equalising sheave [m]."""
    given = spec.reeving
    return reeving.rope_between_drum_and_end(
        fall_length(spec, hook_height), given.falls, given.ropes, given.lead_length
    )


def hook_stiffness(spec: Hoist, hook_height: float) -> float:
    """Of all ropes at the hook [N/m]."""
    given = spec.reeving
    return wire_rope.hook_stiffness(
        filled(spec.rope.modulus), metallic_area(spec), given.falls, given.ropes, rope_length(spec, hook_height)
    )


def load_frequency(spec: Hoist, mass: float, hook_height: float) -> float:
    """Lowest natural frequency of a mass on the hook, the drum held [rad/s].

    The rope is a rod with its own mass, unless the file leaves that out.
    """
    under, stiffness = spec.structure, hook_stiffness(spec, hook_height)
    off = spec.effects.get("rope_mass") == "off"
    rope = 0.0 if off else filled(spec.rope.mass) * fall_length(spec, hook_height) * spec.reeving.falls
    if under is None:
        return rope_rod.rod_frequency(stiffness, rope, mass, 1)
    if not rope:
        return hoisting.load_frequency(stiffness, mass, under.stiffness, under.mass)
    return rope_rod.framed_rod_frequency(stiffness, rope, math.inf, mass, under.stiffness, under.mass)


# -- drum -----------------------------------------------------------------------------------------------------------


def pitch(spec: Hoist) -> float:
    """From turn to turn of the rope on the drum [m]."""
    return spec.rope.diameter if spec.drum.surface == "smooth" and spec.drum.pitch is None else filled(spec.drum.pitch)


def layer_step(spec: Hoist) -> float:
    """What a layer adds to the radius [m]."""
    return rope_drum.layer_step(spec.rope.diameter, pitch(spec), spec.winding.packing)


def layer_radius(spec: Hoist, layer: int) -> float:
    """Of the centre of the rope in a layer, from 1 [m]."""
    return rope_drum.layer_radius(spec.drum.diameter, spec.rope.diameter, layer_step(spec), layer)


def layer_turns(spec: Hoist) -> float:
    """Turns of the first layer [1]."""
    return spec.drum.length / pitch(spec)


@dataclass(frozen=True, slots=True)
class Wound:
    """A rope on its drum: turns, layers, and the radius of the centre of the outermost layer [m]."""

    length: float
    turns: float
    layers: int
    radius: float


def dead_length(spec: Hoist) -> float:
    """Rope that stays on the drum [m]."""
    return spec.drum.dead_wraps * 2 * math.pi * layer_radius(spec, 1)


def wound(spec: Hoist, hook_height: float) -> Wound:
    """One rope on the drum with the hook so high."""
    length = dead_length(spec) + hook_height * falls_of_a_rope(spec)
    turns, layers = rope_drum.turns_for_length(
        length,
        spec.drum.diameter,
        spec.rope.diameter,
        layer_turns(spec),
        layer_step(spec),
        spec.winding.packing,
    )
    return Wound(length, turns, layers, layer_radius(spec, layers))


# -- speed ----------------------------------------------------------------------------------------------------------


def drum_speed(spec: Hoist, which: str = "main") -> float:
    """Of the drum at the main or the creep speed [rad/s]."""
    given = spec.speed
    if which == "main" and given.drum is not None:
        return given.drum
    hook = filled(given.main if which == "main" else given.creep)
    return reeving.rope_speed(hook, spec.reeving.falls, spec.reeving.ropes) / layer_radius(spec, 1)


def hook_speed(spec: Hoist, which: str = "main", layer: int = 1) -> float:
    """Of the hook with the rope on a layer, the drum at the main or the creep speed [m/s]."""
    return drum_speed(spec, which) * layer_radius(spec, layer) / falls_of_a_rope(spec)


def class_factor(spec: Hoist, edition: str | None = None) -> float | None:
    """phi_2 of the hoisting class, in an edition or that of the file; None where the file does not give the class."""
    classes = spec.classes
    if classes.hoisting is None:
        return None
    return standard_factor(spec, classes.hoisting, edition)


def standard_factor(spec: Hoist, hoisting: str, edition: str | None = None) -> float:
    """phi_2 of a hoisting class with the drive class of the file."""
    classes, main = spec.classes, hook_speed(spec)
    creep = hook_speed(spec, "creep") if spec.speed.creep is not None else main
    speed = lift_off_standard.class_lift_off_speed(classes.drive, classes.combination, main, creep)
    return lift_off_standard.standard_lift_off_factor(hoisting, classes.drive, speed, edition or classes.edition)


# -- drive ----------------------------------------------------------------------------------------------------------


def efficiency(spec: Hoist) -> float:
    """Of the gearbox, from motor to drum; 1 without one [1]."""
    return filled(spec.gearbox.efficiency) if spec.gearbox is not None else 1.0


def reverse_efficiency(spec: Hoist) -> float:
    """Of the gearbox from drum to motor; negative where it locks itself [1]."""
    if spec.gearbox is not None and spec.gearbox.reverse_efficiency is not None:
        return spec.gearbox.reverse_efficiency
    return gearing.reverse_efficiency(efficiency(spec))


def motor_side_inertia(spec: Hoist) -> float:
    """Rotors and couplings of all motors on the motor shaft [kg*m^2]; 0 without motors."""
    if spec.motor is None:
        return 0.0
    return spec.motor.count * (spec.motor.inertia + filled(spec.motor.coupling_inertia))


def drum_torque(spec: Hoist, mass: float, hook_height: float | None, hauling: bool) -> float:
    """Torque of all ropes on the drum with the hook so high, or the largest of all heights [N*m].

    The pull falls evenly as the rope shortens, the radius grows with every layer: the torque is largest where a layer
    begins. Of more layers than `MOST_LAYERS` some are taken together, on the safe side.
    """
    if hook_height is not None:
        at_drum, radius = pulls(spec, mass, hook_height, hauling).drum, wound(spec, hook_height).radius
        return hoisting.drum_torque(at_drum, spec.reeving.ropes, radius)
    last = wound(spec, spec.height).layers
    layers = np.asarray(distinct(np.round(np.linspace(1, last, min(last, MOST_LAYERS)))))
    begins = _begins(spec, layers)
    lowest, highest = (pulls(spec, mass, height, hauling).drum for height in (0.0, spec.height))
    course = lowest + (highest - lowest) * (begins / spec.height)
    lasts = np.append(layers[1:] - 1, last)
    radii = layer_radius(spec, 1) + (lasts - 1) * layer_step(spec)
    return hoisting.drum_torque(float(np.max(course * radii)), spec.reeving.ropes, 1.0)


def layer_heights(spec: Hoist) -> list[float]:
    """Heights of the hook at which the layers of its rope begin, of `MOST_LAYERS` at most [m]."""
    last = min(wound(spec, spec.height).layers, MOST_LAYERS)
    return [float(height) for height in _begins(spec, np.arange(1.0, last + 1))]


def _begins(spec: Hoist, layers: FloatArray) -> FloatArray:
    """Heights of the hook at which layers begin [m]."""
    below = rope_drum.length_below(
        layers, spec.drum.diameter, spec.rope.diameter, layer_turns(spec), layer_step(spec), spec.winding.packing
    )
    return np.asarray(np.clip((below - dead_length(spec)) / falls_of_a_rope(spec), 0.0, spec.height))


def capacity(spec: Hoist, layers: int, packing: str) -> float:
    """Rope that so many layers of the drum take [m]."""
    step = rope_drum.layer_step(spec.rope.diameter, pitch(spec), packing)
    return rope_drum.drum_capacity(spec.drum.diameter, spec.rope.diameter, layer_turns(spec), layers, step, packing)


def load_inertia(spec: Hoist, mass: float) -> float:
    """Drum, and a mass on the hook with the rope on the first layer, on the drum shaft [kg*m^2]."""
    return (spec.drum.inertia or 0.0) + mass * (layer_radius(spec, 1) / falls_of_a_rope(spec)) ** 2


def layer_factor(spec: Hoist) -> float | None:
    """Hoop stress of the shell under all layers over that of one; None where nothing is known of it."""
    if spec.checks.layer_factor is not None:
        return spec.checks.layer_factor
    layers = wound(spec, spec.height).layers
    return rope_drum.layer_factor(layers) if layers <= MOST_LAYERS_KNOWN else None


MOST_LAYERS_KNOWN = 2
"""Layers for which the hoop stress of a drum shell is computed without an input (`rope_drum.layer_factor`, DNV
2.22:2011). Of more layers the file must give the factor, or the check is not made."""


def fleet_angle(spec: Hoist) -> float | None:
    """Largest angle of a rope at the drum; None where the distance of its first sheave is not known [rad].

    A rope that falls straight to the hook block has it near when it is wound up and far when it is not.
    """
    given, top = spec.reeving, wound(spec, spec.height)
    one_layer = top.layers == 1
    travel = (top.turns - spec.drum.dead_wraps) * pitch(spec) if one_layer else spec.drum.length
    if given.lead_length > 0:
        return rope_drum.fleet_angle(travel, given.lead_offset, given.lead_length)
    if spec.least_fall == 0:
        return None
    if not one_layer:
        return rope_drum.fleet_angle(travel, given.lead_offset, spec.least_fall)
    highest = rope_drum.fleet_angle(0.0, abs(travel / 2 - given.lead_offset), spec.least_fall)
    lowest = rope_drum.fleet_angle(travel, given.lead_offset, fall_length(spec, 0.0))
    return max(highest, lowest)
