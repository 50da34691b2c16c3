"""What is filled in where a design file leaves it out, and how wrong that may be."""

from collections.abc import Iterator, Mapping

from ptmcalc.base import units
from ptmcalc.base.estimate import Interval
from ptmcalc.components.travel_drive import TravelDrive
from ptmcalc.contract.machine import Assumption, Use
from ptmcalc.machines.crane.stacking.machine.keys.drives import ROPE_MODULUS, Travel
from ptmcalc.machines.crane.stacking.machine.overhead import OverheadStacker
from ptmcalc.machines.crane.stacking.machine.rack import RackStacker
from ptmcalc.machines.crane.stacking.machine.scenes import (
    Brake,
    ForkCaught,
    HoistScene,
    ObstacleScene,
    RailScene,
    StackerScene,
    Start,
)
from ptmcalc.machines.crane.stacking.machine.spec import Stacker

_OF_ARMS = Use(
    loads=frozenset(
        {
            "bridge_stress",
            "column_stress",
            "jamming",
            "rest_deflection",
            "roller_load",
            "rope_safety",
            "stability_reserve",
        }
    )
)
"""Loads that depend on the places of carriage, cab and load beside the mast."""
USES: Mapping[str, Use] = {
    **dict.fromkeys(
        ("cab.arm", "cab.arm_across", "carriage.own_arm", "carriage.own_arm_across", "carriage.load_arm_across"),
        _OF_ARMS,
    ),
    "carriage.rollers.lever_arm": Use(scenes=frozenset({HoistScene})),
    "carriage.rollers.pin_friction": Use(scenes=frozenset({HoistScene})),
    "base.height": Use(loads=frozenset({"stability_reserve"})),
}


def assumptions(spec: Stacker) -> Iterator[Assumption[Stacker]]:
    """What is assumed of ropes, rail and drives."""
    if spec.hoisting.rope.efficiency is None:
        yield Assumption(
            ("hoisting", "rope", "sheave_efficiency"),
            units.RATIO,
            lambda spec: 0.98,
            lambda spec: Interval(0.97, 0.985),
            "sheaves on rolling bearings 0.98 to 0.985, on plain bearings 0.95 to 0.97",
            Use(scenes=frozenset({HoistScene, ForkCaught})),
        )
    if isinstance(spec, RackStacker) and any(scene.type == "rail" for scene in spec.all_scenes):
        yield Assumption(
            ("rail", "frequency"),
            units.FREQUENCY,
            lambda spec: 10.0,
            lambda spec: Interval(5.0, 20.0),
            "cranes on wheels and rails oscillate vertically at 5 to 20 Hz",
            Use(scenes=frozenset({RailScene})),
        )
    yield from _of_the_hoist(spec)
    yield from _of_the_column(spec)
    yield from _foot(spec)
    if isinstance(spec, RackStacker):
        yield from _of_the_base(spec)
    for key in ("bridge_travel", "trolley_travel", "travel"):
        block = getattr(spec, key, None)
        if isinstance(block, Travel):
            if block.drive is not None:
                yield from _of_a_drive(key, block.drive)
            if block.drive is not None or block.driving_force is not None:
                yield _resistance(spec, key)
            if block.braking_force is not None:
                yield Assumption(
                    (key, "braking_delay"),
                    units.TIME,
                    lambda spec: 0.0,
                    lambda spec: Interval(0.0, 0.4),
                    "brakes released by a thruster close within 0.2 to 0.4 s",
                    Use(scenes=frozenset({Brake})),
                )
    if isinstance(spec, OverheadStacker) and spec.rotation is not None:
        tenth = 0.1 * spec.rotation.driving_torque
        yield Assumption(
            ("rotation", "resistance"),
            units.TORQUE,
            lambda spec: 0.0,
            lambda spec: Interval(0.0, tenth),
            "bearings of a rotating mast consume up to 10 % of the driving torque",
        )


def _resistance(spec: Stacker, key: str) -> Assumption[Stacker]:
    """None is the worst case of a stop, the upper end that of a start."""
    mass = spec.column.mass + spec.carriage.mass + (spec.cab.mass if spec.cab is not None else 0.0) + spec.load
    if isinstance(spec, RackStacker):
        mass += spec.base.mass
    elif isinstance(spec, OverheadStacker):
        mass += spec.trolley.mass + (spec.bridge.mass if key == "bridge_travel" else 0.0)
    weight = mass * spec.gravity
    return Assumption(
        (key, "resistance"),
        units.FORCE,
        lambda spec: 0.0,
        lambda spec: Interval(0.0, 0.01 * weight),
        "resistance of steel wheels with rolling bearings: 0.5 to 1 % of the weight",
        Use(scenes=frozenset({Start, Brake, ObstacleScene})),
    )


def _of_the_hoist(spec: Stacker) -> Iterator[Assumption[Stacker]]:
    """The ropes give, and the motor goes on pulling, where a fork is caught."""
    rope, drive = spec.hoisting.rope, spec.hoisting.drive
    if rope.area is not None:
        yield Assumption(
            ("hoisting", "rope", "modulus"),
            units.STRESS,
            lambda spec: ROPE_MODULUS,
            lambda spec: Interval(90e9, 120e9),
            "six-strand ropes on their metallic area: 90 GPa new, 120 GPa after some time (EN 12385)",
            Use(scenes=frozenset({ForkCaught})),
        )
    if drive is not None and drive.inertia is not None:
        yield Assumption(
            ("hoisting", "drive", "gear_efficiency"),
            units.RATIO,
            lambda spec: 0.94,
            lambda spec: Interval(0.85, 0.97),
            "two to three stages of helical or bevel gears",
        )
    if drive is not None and drive.slope is None and spec.hoisting.catches:
        cab = spec.cab.mass if spec.cab is not None else 0.0
        weight = (spec.load + spec.carriage.mass + cab) * spec.gravity
        yield Assumption(
            ("hoisting", "drive", "largest_force"),
            units.FORCE,
            lambda spec: weight,
            lambda spec: Interval(weight, 2.5 * weight),
            "the stall force of hoist motors is 1 to 2.5 times the force of the rated load",
            Use(scenes=frozenset({ForkCaught})),
        )


def _of_the_column(spec: Stacker) -> Iterator[Assumption[Stacker]]:
    """What is no number of the file but of its section."""
    column = spec.column
    second, modulus = column.second_moment, column.section_modulus
    bends_across = isinstance(spec, OverheadStacker) and spec.trolley_travel is not None
    if second is not None and (bends_across or spec.fork is not None):
        yield Assumption(
            ("column", "second_moment_across"),
            units.SECOND_MOMENT,
            lambda spec: second,
            lambda spec: Interval(second / 2, second),
            "box and frame masts: stiffness across the aisle 0.5 to 1 times that along the aisle",
        )
    if modulus is not None:
        yield Assumption(
            ("column", "section_modulus_across"),
            units.SECTION_MODULUS,
            lambda spec: modulus,
            lambda spec: Interval(modulus / 2, modulus),
            "box and frame masts: strength across the aisle 0.5 to 1 times that along the aisle",
            Use(loads=frozenset({"column_stress"})),
        )
    if modulus is not None and second is not None:
        least = modulus**2 / second  # of two flanges, all of their area at the outer edges
        yield Assumption(
            ("column", "area"),
            units.AREA,
            lambda spec: 1.6 * least,
            lambda spec: Interval(least, 3 * least),
            "W^2/J is the minimum area of a section with both; 1.6 times that area for a box, 3 times for a plate",
            Use(loads=frozenset({"column_stress"})),
        )


def _of_the_base(spec: RackStacker) -> Iterator[Assumption[Stacker]]:
    """Where things stand on it."""
    long = spec.base.wheel_base
    for key in ("column", "centre"):
        yield Assumption(
            ("base", key),
            units.SPAN,
            lambda spec: long / 2,
            lambda spec: Interval(0.45 * long, 0.55 * long),
            "mast and drives are in the middle of the base, within 5 % of the wheel base",
            Use(loads=frozenset({"stability_reserve", "phi4", "rail_contact", "wheel_force"})),
        )


def _foot(spec: Stacker) -> Iterator[Assumption[Stacker]]:
    """How high the lower end of the column is, below all places that the file names."""
    heights = [one.height for one in spec.all_scenes if isinstance(one, StackerScene) and one.height is not None]
    heights += [place for place in (spec.carriage.lowest, spec.carriage.highest) if place is not None]
    highest = min([0.5, *heights])
    if highest > 0:
        yield Assumption(
            ("column", "foot"),
            units.SPAN,
            lambda spec: 0.0,
            lambda spec: Interval(0.0, highest),
            "the mast starts, or ends, up to 0.5 m above the rail or floor",
        )


def _of_a_drive(key: str, drive: TravelDrive) -> Iterator[Assumption[Stacker]]:
    ratio, rotor = drive.gear.ratio, drive.motor.inertia
    yield Assumption(
        (key, "drive", "gear", "efficiency"),
        units.RATIO,
        lambda spec: 0.9,
        lambda spec: Interval(1.0, 1.0) if ratio == 1 else Interval(0.85, 0.95),
        "two to three stages of helical or bevel gears",
    )
    yield Assumption(
        (key, "drive", "gear", "reverse_efficiency"),
        units.RATIO,
        lambda spec: _drive_of(spec, key).reverse_range[0],
        lambda spec: Interval(*_drive_of(spec, key).reverse_range),
        "2 - 1/efficiency with equal losses in both directions; as large as the efficiency at most",
    )
    yield Assumption(
        (key, "drive", "motor", "coupling_inertia"),
        units.INERTIA,
        lambda spec: 0.15 * rotor,
        lambda spec: Interval(0.10 * rotor, 0.25 * rotor),
        "couplings and gear increase the rotor inertia by a factor of 1.1 to 1.25 (lecture notes, Kramatorsk 2007)",
    )


def _drive_of(spec: Stacker, key: str) -> TravelDrive:
    drive = getattr(spec, key).drive
    assert isinstance(drive, TravelDrive)
    return drive
