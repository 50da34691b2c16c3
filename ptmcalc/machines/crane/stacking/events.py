"""The events of a stacker crane in numbers: what a design file and a scene come to at buffers, rack, rail and guide."""

import math
from dataclasses import dataclass

import numpy as np

from ptmcalc.laws import buffer, fork, rail, safety_gear
from ptmcalc.machines.crane.stacking import model
from ptmcalc.machines.crane.stacking.fork.masses import Catch, Limit, Push
from ptmcalc.machines.crane.stacking.mast import columns
from ptmcalc.machines.crane.stacking.model import filled
from ptmcalc.machines.crane.stacking.rack import RackStacker
from ptmcalc.machines.crane.stacking.scenes import BufferScene, ForkCaught, ForkPush, RailScene, SafetyGearScene
from ptmcalc.machines.crane.stacking.spec import Stacker

_NODES = 5
"""Of the quadrature of a column's shape: exact for its polynomials."""

# -- the fork -------------------------------------------------------------------------------------------------------


def catch_of(spec: Stacker, scene: ForkCaught) -> Catch:
    """A fork caught while the carriage is hoisted; a motor that lifts the weight pulls with no less than it."""
    drive, limiter = spec.hoisting.drive, spec.hoisting.limiter
    assert drive is not None, "the scene has a drive"
    mass, speed = model.climbing_mass(spec, scene), scene.speed_share * spec.hoisting.speed
    weight = mass * spec.gravity
    cap = max(drive.largest_force, weight) if drive.largest_force is not None else math.inf
    force = cap if drive.slope is None else min(cap, fork.stall_force(weight, drive.slope, speed))
    if math.isinf(force):
        force = cap = weight
    limit = None
    if limiter is not None:
        brake = limiter.braking_force if limiter.braking_force is not None else weight
        limit = Limit(limiter.force, limiter.reaction, brake)
    rack = spec.rack.stiffness_vertical
    return Catch(
        model.hoist_mass(spec),
        mass,
        weight,
        model.rope_stiffness(spec),
        math.inf if rack is None else rack,
        speed,
        force,
        cap,
        drive.slope or 0.0,
        limit,
    )


def side_compliance(spec: Stacker, scene: ForkPush) -> float:
    """Of the column across the aisle at the fork [m/N]: clamped at its foot, or with a guide across at its head held at
    both ends; with the twist of a fork beside its axis.

        z^3/(3 E I),   z^2 (l - z)^2/(3 E I l);   + a^2/C
    """
    place, column, telescope = model.carriage_place(spec, scene), spec.column, spec.fork
    assert telescope is not None, "the scene has a fork"
    length, rigidity = column.length, 3 * columns.flexural_stiffness(spec, "across")
    if column.top_guide is not None:
        bends = (place * (length - place)) ** 2 / (rigidity * length)
    else:
        root = 1 / column.root_stiffness if column.root_stiffness is not None else 0.0
        bends = place**3 / rigidity + place**2 * root
    stiff = telescope.torsion_stiffness
    twists = telescope.arm**2 / stiff if stiff is not None else 0.0
    return bends + twists


def push_of(spec: Stacker, scene: ForkPush) -> Push:
    """A fork that pushes against the rack."""
    telescope, rack = spec.fork, spec.rack.stiffness_push
    assert telescope is not None, "the scene has a fork"
    compliance = side_compliance(spec, scene)
    slips = telescope.clutch_force is not None and telescope.clutch_force < telescope.motor_force
    force = telescope.clutch_force if slips and telescope.clutch_force is not None else telescope.motor_force
    return Push(
        telescope.mass,
        telescope.speed,
        force,
        slips,
        math.inf if rack is None else rack,
        1 / compliance if compliance else math.inf,
        model.climbing_mass(spec, scene),
    )


# -- the safety gear ------------------------------------------------------------------------------------------------


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


# -- the rail -------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Swinger:
    """The column over a base that tilts, as one mode at the carriage: SI."""

    frequency: float
    """[rad/s]"""
    driven: float
    """acceleration of the mode over that of the tilt [m]"""
    outreach: float
    """deflection of the head over that at the carriage [1]"""
    mass: float = 1.0
    """that swings, at the carriage [kg]"""
    stiffness: float = 1.0
    """at the carriage [N/m]"""


@dataclass(frozen=True, slots=True)
class Roll:
    """A base that runs over what is uneven in its rail: SI."""

    speed: float
    radius: float
    gravity: float
    frequency: float
    """of the machine on its wheels [rad/s]"""
    damping: float
    step: float
    gap: float
    wave_height: float
    wave_length: float
    base: float
    column: Swinger | None

    @property
    def acceleration(self) -> float:
        """Of a wheel over a step or gap [m/s^2]."""
        return rail.rail_acceleration(self.speed, self.radius)

    def pulses(self, frequency: float) -> list[tuple[float, float]]:
        """(more, less) of a mode over the wheel's acceleration, of step and gap, either way over the step."""
        found = []
        if self.step:
            number = rail.step_number(frequency, self.speed, self.radius, self.step)
            up = max(rail.step_extremes(number))
            found.append((up, up))
        if self.gap:
            found.append(rail.gap_extremes(rail.gap_number(frequency, self.speed, self.gap)))
        return found

    @property
    def wave_rate(self) -> float:
        """Of the waves of the rail, 0 without them [rad/s]."""
        return 2 * math.pi * self.speed / self.wave_length if self.wave_length else 0.0


def swinger(spec: RackStacker, scene: RailScene) -> Swinger | None:
    """The column as one mode with the carriage on it, its shape that of a force at the carriage.

        f = alpha x^2 (3 z - x)/(2 z^3) + beta x/z below the carriage, straight on above it
        w^2 = c/(m_2 + m_c/l int f^2),   alpha and beta the shares of bending and of the root

    None where a guide at its head holds it along the aisle.
    """
    column, z = spec.column, model.carriage_place(spec, scene)
    if z <= 0 or (column.top_guide is not None and column.top_guide.stiffness is not None):
        return None
    gives, line, mass = (
        columns.compliance(spec, scene, z),
        column.mass / column.length,
        model.climbing_mass(spec, scene),
    )
    beta = gives.rotation_share
    slope = (1.5 * (1 - beta) + beta) / z
    nodes, weights = np.polynomial.legendre.leggauss(_NODES)
    below, above = (nodes + 1) * z / 2, z + (nodes + 1) * (column.length - z) / 2
    shapes = (1 - beta) * below**2 * (3 * z - below) / (2 * z**3) + beta * below / z, 1 + slope * (above - z)
    spans = z / 2, (column.length - z) / 2
    both = list(zip((below, above), shapes, spans, strict=True))
    swings = mass + line * sum(float(weights @ shape**2) * half for _, shape, half in both)
    lever = mass * z + line * sum(float(weights @ (shape * x)) * half for x, shape, half in both)
    return Swinger(
        math.sqrt(gives.stiffness / swings), lever / swings, 1 + slope * (column.length - z), swings, gives.stiffness
    )


def roll_of(spec: RackStacker, scene: RailScene) -> Roll:
    """A base on an uneven rail."""
    given, waves = spec.rail, spec.rail.waviness
    return Roll(
        scene.speed_share * spec.travel.speed,
        spec.base.wheel_diameter / 2,
        spec.gravity,
        2 * math.pi * filled(given.frequency),
        given.damping,
        given.step,
        given.gap,
        waves.height if waves is not None else 0.0,
        waves.length if waves is not None else 0.0,
        spec.base.wheel_base,
        swinger(spec, scene),
    )


def wheel_load(spec: RackStacker, scene: RailScene) -> float:
    """Largest static load of a wheel: two on one rail, four on two [N]."""
    base, carriage, length = spec.base, spec.carriage, spec.base.wheel_base
    foot = base.column if base.column is not None else length / 2
    weights = [
        (base.mass, base.centre if base.centre is not None else length / 2),
        (spec.column.mass, foot),
        (model.payload(spec, scene), foot + carriage.load_arm),
        (carriage.mass, foot + carriage.own_arm),
    ]
    if spec.cab is not None:
        weights.append((spec.cab.mass, foot + spec.cab.arm))
    whole = sum(mass for mass, _ in weights) * spec.gravity
    front = sum(mass * place for mass, place in weights) * spec.gravity / length
    return max(front, whole - front) / (2 if base.gauge is not None else 1)


# -- buffers --------------------------------------------------------------------------------------------------------


def struck(spec: Stacker, scene: BufferScene) -> tuple[float, float, float]:
    """(mass [kg], speed [m/s], push of the drive [N]) of what runs onto the buffers, the guided load with it."""
    block = model.travel(spec, scene)
    crane = model.carrying_mass(spec, scene) + spec.column.mass + model.climbing_mass(spec, scene)
    crane += model.rotors(block, braking=False) - model.payload(spec, scene)
    mass = buffer.collision_mass(crane, model.payload(spec, scene), 1.0)
    push = 0.0
    if scene.drive == "on":
        drives = model.driving(spec, scene)
        push = drives.size if drives.kind == "force" else drives.size * mass
    return mass, model.speed(spec, scene), push
