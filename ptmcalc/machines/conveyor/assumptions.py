"""What is filled in where a design file leaves it out, and how wrong that may be."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.base.estimate import Interval
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.machine import Assumption
from ptmcalc.laws import resistance
from ptmcalc.machines.conveyor.model import load_line_mass
from ptmcalc.machines.conveyor.spec import Conveyor, Drive

_ROUGH_DRUM_SHARE = 0.05
_ROUGH_TAIL_SHARE = 0.01


def _secondary(spec: Conveyor) -> float | None:
    if spec.resistance.secondary_force is not None:
        return None
    return resistance.length_factor(spec.route.span)


def _secondary_interval(spec: Conveyor) -> Interval:
    extra = resistance.length_factor(spec.route.span) - 1
    return Interval(1 + 0.75 * extra, 1 + 1.25 * extra)


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
        lambda spec: 0.020,
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


def assumptions(spec: Conveyor) -> Iterator[Assumption[Conveyor]]:
    """What is assumed of the belt, of every drive, and of the tail drum."""
    yield from _OF_THE_BELT
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
