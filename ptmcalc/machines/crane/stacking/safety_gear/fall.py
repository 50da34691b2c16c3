"""A carriage whose ropes have failed: its fall and its catch by the safety gear."""

import math
from dataclasses import dataclass

from ptmcalc.laws import safety_gear
from ptmcalc.machines.crane.stacking.machine import model
from ptmcalc.machines.crane.stacking.machine.model import filled
from ptmcalc.machines.crane.stacking.machine.scenes import SafetyGearScene
from ptmcalc.machines.crane.stacking.machine.spec import Stacker


@dataclass(frozen=True, slots=True)
class Fall:
    """A carriage whose ropes have failed: SI."""

    mass: float
    speed: float
    """at which the gear begins to hold"""
    drop: float
    """of free fall before"""
    force: float
    distance: float
    """infinite where the gear does not hold"""
    stroke: float
    deceleration: float
    left: float
    """speed at the end of the stroke"""


def fall_of(spec: Stacker, scene: SafetyGearScene) -> Fall:
    """The fall and the catch."""
    gear, gravity = spec.safety_gear, spec.gravity
    assert gear is not None, "the scene has a safety gear"
    mass, speed = model.climbing_mass(spec, scene), spec.hoisting.speed
    catch = safety_gear.catch_speed(speed, gear.trip_ratio, gear.reaction_time, gravity)
    drop = safety_gear.fall_before_catch(speed, catch, gravity)
    if gear.type == "progressive":
        force = filled(gear.force)
        distance = safety_gear.progressive_distance(force, mass, catch, gravity)
        slows = safety_gear.progressive_deceleration(force, mass, gravity)
        left = safety_gear.gear_speed_left(force, mass, catch, gear.stroke, gravity)
        return Fall(mass, catch, drop, force, distance, gear.stroke, slows, left)
    stiffness = filled(gear.stiffness)
    force = safety_gear.instantaneous_force(mass, stiffness, catch, gravity)
    slows = safety_gear.progressive_deceleration(force, mass, gravity)
    kinetic = mass * catch**2 / 2 + (mass * gravity - stiffness * gear.stroke / 2) * gear.stroke
    left = math.sqrt(2 * kinetic / mass) if force / stiffness > gear.stroke else 0.0
    return Fall(mass, catch, drop, force, force / stiffness, gear.stroke, slows, left)
