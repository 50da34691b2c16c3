"""What is filled in where a design file leaves it out, and how wrong that may be."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.base.estimate import Interval
from ptmcalc.components.travel_drive import TravelDrive
from ptmcalc.contract.machine import Assumption
from ptmcalc.machines.crane.stacking.drives import Travel
from ptmcalc.machines.crane.stacking.rack import RackStacker
from ptmcalc.machines.crane.stacking.spec import Stacker


def assumptions(spec: Stacker) -> Iterator[Assumption[Stacker]]:
    """What is assumed of ropes, rail and drives."""
    if spec.hoisting.rope.efficiency is None:
        yield Assumption(
            ("hoisting", "rope", "sheave_efficiency"),
            units.RATIO,
            lambda spec: 0.98,
            lambda spec: Interval(0.97, 0.985),
            "sheaves on rolling bearings: 0.98 to 0.985; plain ones 0.95 to 0.97",
        )
    if isinstance(spec, RackStacker) and any(scene.type == "rail" for scene in spec.all_scenes):
        yield Assumption(
            ("rail", "frequency"),
            units.FREQUENCY,
            lambda spec: 10.0,
            lambda spec: Interval(5.0, 20.0),
            "cranes on their wheels and rails swing vertically at 5 to 20 Hz",
        )
    for key in ("bridge_travel", "trolley_travel", "travel"):
        block = getattr(spec, key, None)
        if isinstance(block, Travel) and block.drive is not None:
            yield from _of_a_drive(key, block.drive)


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
        "2 - 1/efficiency with equal losses both ways; as large as the efficiency at most",
    )
    yield Assumption(
        (key, "drive", "motor", "coupling_inertia"),
        units.INERTIA,
        lambda spec: 0.15 * rotor,
        lambda spec: Interval(0.10 * rotor, 0.25 * rotor),
        "couplings and gear take 1.1 to 1.25 times the rotor's inertia (lecture notes, Kramatorsk 2007)",
    )


def _drive_of(spec: Stacker, key: str) -> TravelDrive:
    drive = getattr(spec, key).drive
    assert isinstance(drive, TravelDrive)
    return drive
