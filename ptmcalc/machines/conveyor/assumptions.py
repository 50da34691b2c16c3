"""What is filled in where a design file leaves it out, and how wrong that may be."""

from ptmcalc.base import units
from ptmcalc.base.estimate import Interval
from ptmcalc.contract.machine import Assumption
from ptmcalc.laws import resistance
from ptmcalc.machines.conveyor.model import load_line_mass
from ptmcalc.machines.conveyor.spec import Conveyor

_ROUGH_DRUM_SHARE = 0.05
_ROUGH_TAIL_SHARE = 0.01


def _motor_side_inertia(spec: Conveyor) -> float:
    return spec.drive.motor.count * spec.drive.motor.inertia * spec.drive.gear.ratio**2


def _secondary(spec: Conveyor) -> float | None:
    if spec.resistance.secondary_force is not None:
        return None
    return resistance.length_factor(spec.route.length)


def _secondary_interval(spec: Conveyor) -> Interval:
    extra = resistance.length_factor(spec.route.length) - 1
    return Interval(1 + 0.75 * extra, 1 + 1.25 * extra)


def _moving_mass(spec: Conveyor) -> float:
    per_length = (
        2 * spec.belt.mass
        + spec.idlers.carry.rotating_line_mass
        + spec.idlers.back.rotating_line_mass
        + load_line_mass(spec)
    )
    return per_length * spec.route.length


ASSUMPTIONS: tuple[Assumption[Conveyor], ...] = (
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
    Assumption(
        ("drive", "gear", "efficiency"),
        units.RATIO,
        lambda spec: 0.94,
        lambda spec: Interval(0.90, 0.97),
        "two to three stages of helical or bevel gears, 0.98 to 0.99 each",
    ),
    Assumption(
        ("drive", "coupling_inertia"),
        units.INERTIA,
        lambda spec: 0.15 * spec.drive.motor.inertia,
        lambda spec: Interval(0.10 * spec.drive.motor.inertia, 0.25 * spec.drive.motor.inertia),
        "couplings and gear take 1.1 to 1.25 times the rotor's inertia (lecture notes, Kramatorsk 2007)",
    ),
    Assumption(
        ("drive", "drum", "inertia"),
        units.INERTIA,
        lambda spec: 0.0,
        lambda spec: Interval(0.0, _ROUGH_DRUM_SHARE * _motor_side_inertia(spec)),
        "left out; a shell drum is seldom above 5 % of the motors' inertia on the same shaft",
    ),
    Assumption(
        ("tail_drum", "inertia"),
        units.INERTIA,
        lambda spec: 0.0,
        lambda spec: Interval(
            0.0,
            _ROUGH_TAIL_SHARE * _moving_mass(spec) * (spec.tail_drum.diameter or spec.drive.drum.diameter) ** 2 / 4,
        ),
        "left out; seldom above 1 % of belt and load at the rim",
    ),
)
