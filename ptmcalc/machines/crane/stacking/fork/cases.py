"""A fork caught by the rack and a fork that pushes against it: what a design file and a scene come to."""

import math

from ptmcalc.laws import fork
from ptmcalc.machines.crane.stacking.fork.masses import Catch, Limit, Push
from ptmcalc.machines.crane.stacking.machine import columns, model
from ptmcalc.machines.crane.stacking.machine.scenes import ForkCaught, ForkPush
from ptmcalc.machines.crane.stacking.machine.spec import Stacker


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
