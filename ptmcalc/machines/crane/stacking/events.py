"""The events of a stacker crane in numbers: what a design file and a scene come to at buffers, rack, rail and guide."""

import math
from dataclasses import dataclass

from ptmcalc.laws import buffer, fork, rail, safety_gear
from ptmcalc.machines.crane.stacking import model
from ptmcalc.machines.crane.stacking.catching import Catch, Limit, Push
from ptmcalc.machines.crane.stacking.model import filled
from ptmcalc.machines.crane.stacking.rack import RackStacker
from ptmcalc.machines.crane.stacking.scenes import BufferScene, ForkCaught, ForkPush, RailScene, SafetyGearScene
from ptmcalc.machines.crane.stacking.spec import Stacker

_TIP_SHARE = 33 / 140
"""Of a clamped column's mass that swings with its end: of the square of its static shape."""
_TILT_SHARE = 11 / 40
"""Of a clamped column's mass that a tilt of its foot drives: of its static shape times the height."""

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
    length = column.length
    if column.stiffness is not None:
        bends = (place / length) ** 3 / column.stiffness
    else:
        second = column.second_moment_across or filled(column.second_moment)
        rigidity = 3 * column.elasticity * column.count * second
        bends = place**3 / rigidity
        if column.top_guide is not None:
            bends = (place * (length - place)) ** 2 / (rigidity * length)
        elif column.root_stiffness is not None:
            bends += place**2 / column.root_stiffness
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
    """The column's first mode with the carriage on it, its shape that of a force at the carriage.

        f = x^2 (3 z - x)/(2 z^3) below the carriage, straight on above it;   w^2 = c/(m_2 + m_c/l int f^2)

    None where a guide at its head holds it along the aisle.
    """
    column, place = spec.column, model.carriage_place(spec, scene)
    if place <= 0 or (column.top_guide is not None and column.top_guide.stiffness is not None):
        return None
    if column.stiffness is not None:
        compliance = (place / column.length) ** 3 / column.stiffness
    else:
        compliance = place**3 / (3 * column.elasticity * column.count * filled(column.second_moment))
    above, line, mass = column.length - place, column.mass / column.length, model.climbing_mass(spec, scene)
    head = 1 + 1.5 * above / place
    squares = _TIP_SHARE * place + above * (1 + head + head**2) / 3
    lever = _TILT_SHARE * place**2 + above * (place * (1 + head) / 2 + above * (1 + 2 * head) / 6)
    swings = mass + line * squares
    return Swinger(1 / math.sqrt(compliance * swings), (mass * place + line * lever) / swings, head)


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
