"""What is filled in where a design file leaves it out, and how wrong that may be."""

import math
from collections.abc import Iterator
from dataclasses import replace

from ptmcalc.base import units
from ptmcalc.base.estimate import Interval
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.machine import Assumption
from ptmcalc.laws import resistance
from ptmcalc.machines.conveyor.model import load_line_mass
from ptmcalc.machines.conveyor.spec import Conveyor, Drive
from ptmcalc.numerics.lanes import value

_ROUGH_DRUM_SHARE = 0.05
_ROUGH_TAIL_SHARE = 0.01


_TABLE_ENDS = 2000.0  # m, of C(L)


def _secondary(spec: Conveyor) -> float | None:
    if spec.resistance.secondary_force is not None or spec.resistance.cema is not None:
        return None
    return value(resistance.length_factor, spec.route.span)


def _secondary_interval(spec: Conveyor) -> Interval:
    """Beyond the table C - 1 falls as 1/L when the secondary resistances stay what they are."""
    extra = value(resistance.length_factor, spec.route.span) - 1
    return Interval(1 + 0.75 * extra * min(_TABLE_ENDS / spec.route.span, 1.0), 1 + 1.25 * extra)


def _moving_mass(spec: Conveyor) -> float:
    per_length = (
        2 * spec.belt.mass
        + spec.idlers.carry.rotating_line_mass
        + spec.idlers.back.rotating_line_mass
        + load_line_mass(spec)
    )
    return per_length * spec.route.span


_OF_THE_BELT: tuple[Assumption[Conveyor], ...] = (
    Assumption(
        ("resistance", "coefficient"),
        units.RATIO,
        lambda spec: 0.020 if spec.resistance.cema is None else None,
        lambda spec: Interval(0.017, 0.030),
        "ISO 5048 and DIN 22101: 0.020 in normal conditions, 0.017 to 0.030",
    ),
    Assumption(
        ("resistance", "secondary"),
        units.RATIO,
        _secondary,
        _secondary_interval,
        "length factor C(L) of DIN 22101 and ISO 5048; a quarter of C - 1 either way",
    ),
    Assumption(
        ("resistance", "start_factor"),
        units.RATIO,
        lambda spec: 1.2,
        lambda spec: Interval(1.0, 1.5),
        "common practice: 1.2 to 1.5 times the running resistance",
    ),
)

_OF_THE_TAIL: tuple[Assumption[Conveyor], ...] = (
    Assumption(
        ("tail_drum", "inertia"),
        units.INERTIA,
        lambda spec: 0.0,
        lambda spec: Interval(
            0.0,
            _ROUGH_TAIL_SHARE
            * _moving_mass(spec)
            * (spec.tail_drum.diameter or spec.main_drive.drum.diameter) ** 2
            / 4,
        ),
        "left out; seldom above 1 % of belt and load at the rim",
    ),
)


_OF_THE_LOAD: tuple[Assumption[Conveyor], ...] = (
    Assumption(
        ("resistance", "cema", "flexure"),
        units.RATIO,
        lambda spec: 0.03 if spec.resistance.cema is not None else None,
        lambda spec: Interval(0.016, 0.035),
        "CEMA: K_y of its table lies between 0.016 and 0.035; 0.03 for a first estimate",
    ),
    Assumption(
        ("load", "surcharge_angle"),
        units.ANGLE,
        lambda spec: math.radians(15) if spec.load.density is not None else None,
        lambda spec: Interval(math.radians(10), math.radians(20)),
        "ISO 5048 and CEMA: 10 to 20 deg for most materials in motion, 5 deg for free-flowing ones",
    ),
)


def _rubbing(spec: Conveyor) -> Iterator[Assumption[Conveyor]]:
    """Friction at skirt plates and scrapers."""
    for name, force in spec.resistance.forces.items():
        what = "skirt" if force.skirt is not None else "scraper"
        if force.skirt is None and force.scraper is None:
            continue
        yield Assumption(
            ("resistance", "forces", name, what, "friction"),
            units.RATIO,
            lambda spec: 0.6,
            lambda spec: Interval(0.5, 0.7),
            "ISO 5048: 0.5 to 0.7 at skirt plates and belt cleaners",
        )


def assumptions(spec: Conveyor) -> Iterator[Assumption[Conveyor]]:
    """What is assumed of the belt, of what it carries, of every drive, and of the tail drum."""
    for assumed in _OF_THE_BELT:
        beyond = assumed.path[-1] == "secondary" and spec.route.span > _TABLE_ENDS
        yield replace(assumed, source=f"{assumed.source}; the table ends at 2000 m") if beyond else assumed
    yield from _OF_THE_LOAD
    yield from _rubbing(spec)
    for name, drive in spec.all_drives.items():
        yield from _of_a_drive(spec.drive_path(name), drive)
    yield from _OF_THE_TAIL


def _of_a_drive(path: KeyPath, drive: Drive) -> Iterator[Assumption[Conveyor]]:
    rotor = drive.motor.inertia
    on_drum = drive.motor.count * rotor * drive.gear.ratio**2
    yield Assumption(
        (*path, "gear", "efficiency"),
        units.RATIO,
        lambda spec: 0.94,
        lambda spec: Interval(0.90, 0.97),
        "two to three stages of helical or bevel gears, 0.98 to 0.99 each",
    )
    yield Assumption(
        (*path, "coupling_inertia"),
        units.INERTIA,
        lambda spec: 0.15 * rotor,
        lambda spec: Interval(0.10 * rotor, 0.25 * rotor),
        "couplings and gear take 1.1 to 1.25 times the rotor's inertia (lecture notes, Kramatorsk 2007)",
    )
    yield Assumption(
        (*path, "drum", "inertia"),
        units.INERTIA,
        lambda spec: 0.0,
        lambda spec: Interval(0.0, _ROUGH_DRUM_SHARE * on_drum),
        "left out; a shell drum is seldom above 5 % of the motors' inertia on the same shaft",
    )
