"""Values that no belt conveyor has: a wrong unit or a lost decimal point. Each is warned of, with the key as example.

The ranges are those of conveyors that were built, with a margin on either side: belts of 0.2 to 3.2 m at up to 8.5 m/s,
single flights of up to 30 km, idler sets of up to 150 kg, loads of up to 40 000 t/h.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from ptmcalc.base import units
from ptmcalc.base.span import KeyPath
from ptmcalc.base.units import Quantity
from ptmcalc.contract.result import Finding
from ptmcalc.machines.conveyor.machine.keys.drives import PlacedDrive
from ptmcalc.machines.conveyor.machine.loading import load_line_mass, points_of
from ptmcalc.machines.conveyor.machine.spec import Conveyor

_LEAST_LOAD = 0.02
"""Load per length relative to the mass of the belt [1] below which SPC201 is reported. An engineering choice: light
goods on light belts have 0.1. A larger value reports valid conveyors; a smaller one accepts wrong units."""
_SLOWEST_MOTOR = 100.0
"""Time in which a motor accelerates its own rotor [s] above which SPC201 is reported. An engineering choice: motors
take 0.05 to 5 s. A smaller value reports valid motors; a larger one accepts wrong units."""


@dataclass(frozen=True, slots=True)
class _Range:
    """Values of a key that conveyors have, SI, and the key with a usual one."""

    path: KeyPath
    quantity: Quantity
    least: float
    most: float
    example: str

    def finding(self, value: float | None) -> Iterator[Finding]:
        """A warning where the value is outside the range."""
        if value is None or self.least <= value <= self.most:
            return
        key, shown = self.path[-1], units.show(value, self.quantity)
        least, most = (units.show(one, self.quantity) for one in (self.least, self.most))
        reason = f"`{key}` is {shown}: belt conveyors have {least} to {most}"
        yield Finding("SPC201", reason, self.path, f"check number and unit; a usual value is `{key}: {self.example}`")


_OF_THE_BELT = (
    _Range(("belt", "width"), units.LENGTH, 0.1, 5.0, "1000 mm"),
    _Range(("belt", "mass"), units.LINE_MASS, 0.1, 500.0, "15 kg/m"),
    _Range(("idlers", "carry", "pitch"), units.LENGTH, 0.05, 15.0, "1.2 m"),
    _Range(("idlers", "return", "pitch"), units.LENGTH, 0.05, 30.0, "3 m"),
    _Range(("idlers", "carry", "set_mass"), units.MASS, 0.0, 500.0, "22 kg"),
    _Range(("idlers", "return", "set_mass"), units.MASS, 0.0, 500.0, "18 kg"),
    _Range(("idlers", "carry", "line_mass"), units.LINE_MASS, 0.0, 500.0, "18 kg/m"),
    _Range(("idlers", "return", "line_mass"), units.LINE_MASS, 0.0, 500.0, "6 kg/m"),
    _Range(("idlers", "carry", "roll", "diameter"), units.LENGTH, 0.03, 0.5, "133 mm"),
    _Range(("idlers", "return", "roll", "diameter"), units.LENGTH, 0.03, 0.5, "133 mm"),
    _Range(("load", "density"), units.DENSITY, 10.0, 10_000.0, "1600 kg/m^3"),
    _Range(("resistance", "coefficient"), units.RATIO, 0.003, 0.8, "0.022"),
    _Range(("resistance", "secondary"), units.RATIO, 1.0, 30.0, "1.4"),
    _Range(("resistance", "start_factor"), units.RATIO, 1.0, 4.0, "1.3"),
    _Range(("resistance", "stop_factor"), units.RATIO, 0.1, 3.0, "0.8"),
    _Range(("resistance", "rest_factor"), units.RATIO, 0.01, 3.0, "0.5"),
    _Range(("speed",), units.SPEED, 0.005, 20.0, "2.5 m/s"),
    _Range(("tail_drum", "diameter"), units.LENGTH, 0.03, 5.0, "630 mm"),
)


def _of_a_drive(path: KeyPath, drive: PlacedDrive) -> Iterator[Finding]:
    drum, motor = (*path, "drum"), drive.motor
    ranges = (
        (_Range((*drum, "diameter"), units.LENGTH, 0.03, 5.0, "800 mm"), drive.drum.diameter),
        (_Range((*drum, "wrap"), units.ANGLE, 1.0, 4 * math.pi, "200 deg"), drive.drum.wrap),
        (_Range((*path, "gear", "ratio"), units.RATIO, 0.1, 10_000.0, "24.8"), drive.gear.ratio),
    )
    for one, value in ranges:
        yield from one.finding(value)
    spin = (motor.inertia or 0.0) * (motor.speed or 0.0)
    if spin > 0 and spin > _SLOWEST_MOTOR * motor.mean_torque:
        time = units.show(spin / motor.mean_torque, units.TIME)
        reason = f"the motor requires {time} to accelerate its own rotor; usual motors require 0.05 s to 5 s"
        yield Finding("SPC201", reason, (*path, "motor", "inertia"), "check `inertia` and the starting torque")


def implausible(spec: Conveyor) -> Iterator[Finding]:
    """Values outside what belt conveyors have."""
    for one in _OF_THE_BELT:
        yield from one.finding(spec.value_at(one.path))
    for index, part in enumerate(spec.route.parts):
        path: KeyPath = ("route", "length") if spec.route.sections is None else ("route", "sections", index, "length")
        yield from _Range(path, units.SPAN, 0.1, 1e5, "240 m").finding(part.length)
    for name, drive in spec.all_drives.items():
        yield from _of_a_drive(spec.drive_path(name), drive)
    for name, brake in spec.brakes.items():
        for key, value, most in (("delay", brake.delay, 60.0), ("rise_time", brake.rise_time, 600.0)):
            yield from _Range(("brakes", name, key), units.TIME, 0.0, most, "0.3 s").finding(value)
    yield from _of_the_load(spec)


def _of_the_load(spec: Conveyor) -> Iterator[Finding]:
    """A load per length that is lost beside the belt, or more than any belt carries."""
    key = "mass" if spec.load.mass is not None else "capacity"
    hint = f"check number and unit; a usual value is `{key}: {'100 kg/m' if key == 'mass' else '900 t/h'}`"
    loads: list[tuple[KeyPath, float]] = [
        (("load", "loading_points", name, key), load_line_mass(spec, (name,))) for name in points_of(spec)
    ]
    for path, mass in loads or [(("load", key), load_line_mass(spec))]:
        share = mass / spec.belt.mass
        if share < _LEAST_LOAD:
            reason = f"the load of {units.show(mass, units.LINE_MASS)} is {100 * share:.2g} % of the mass of the belt"
            yield Finding("SPC201", reason, path, hint)
        elif mass > _MOST_LOAD:
            reason = f"the load is {units.show(mass, units.LINE_MASS)}: belts carry up to 1500 kg/m"
            yield Finding("SPC201", reason, path, hint)


_MOST_LOAD = 10_000.0
"""Load per length [kg/m] above which SPC201 is reported. An engineering choice: the largest belts carry 1500 kg/m, slow
feeders under silos several times that. A smaller value reports valid feeders; a larger one accepts wrong units."""
