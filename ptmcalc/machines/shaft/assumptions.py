"""What is filled in where a design file leaves it out, and how wrong that may be."""

from ptmcalc.base import units
from ptmcalc.base.estimate import Interval
from ptmcalc.contract.machine import Assumption
from ptmcalc.machines.shaft.machine.spec import SectorLoad, Shaft, SliderCrank, TableLoad


def _efficiency(spec: Shaft) -> float:
    return 1.0 if spec.drive.gear.ratio == 1 else 0.94


def _efficiency_interval(spec: Shaft) -> Interval:
    return Interval(1.0, 1.0) if spec.drive.gear.ratio == 1 else Interval(0.90, 0.97)


def _reverse(spec: Shaft) -> float | None:
    """The efficiency of the gear, where the load may drive the motor: at some angle, or by a changing inertia."""
    gear = spec.drive.gear
    if gear.ratio == 1 or gear.braking == "multiplies" or not _may_brake(spec):
        return None
    return gear.efficiency if gear.efficiency is not None else _efficiency(spec)


def _may_brake(spec: Shaft) -> bool:
    return bool(spec.potential) or spec.inertia.type != "constant" or _load_drives(spec)


def _load_drives(spec: Shaft) -> bool:
    load = spec.load
    if isinstance(load, SectorLoad):
        return any(sector.torque < 0 for sector in load.sectors)
    return isinstance(load, TableLoad) and any(point.torque < 0 for point in load.points)


def _reverse_interval(spec: Shaft) -> Interval:
    forward = _reverse(spec) or 1.0
    return Interval(max(2 - 1 / forward, 0.05), forward)


def _rod(spec: Shaft) -> SliderCrank | None:
    return spec.inertia if isinstance(spec.inertia, SliderCrank) else None


def _rod_centre(spec: Shaft) -> float | None:
    return 0.3 if _rod(spec) else None


def _rod_centre_interval(spec: Shaft) -> Interval:
    rod = _rod(spec)
    return Interval(0.2, 0.45) if rod and rod.rod_mass > 0 else Interval(0.3, 0.3)


def _bar_inertia(spec: Shaft, share: float) -> float:
    rod = _rod(spec)
    return rod.rod_mass * rod.rod_length**2 * share if rod else 0.0


ASSUMPTIONS: tuple[Assumption[Shaft], ...] = (
    Assumption(
        ("drive", "gear", "efficiency"),
        units.RATIO,
        _efficiency,
        _efficiency_interval,
        "two to three stages of helical or bevel gears, 0.98 to 0.99 each",
    ),
    Assumption(
        ("drive", "gear", "reverse_efficiency"),
        units.RATIO,
        _reverse,
        _reverse_interval,
        "from 2 - 1/efficiency (equal lost torque) to the efficiency itself",
    ),
    Assumption(
        ("inertia", "rod_centre"),
        units.RATIO,
        _rod_centre,
        _rod_centre_interval,
        "connecting rods with a heavy big end: 0.2 to 0.45 of the length from the crank pin",
    ),
    Assumption(
        ("inertia", "rod_inertia"),
        units.INERTIA,
        lambda spec: _bar_inertia(spec, 1 / 12) if _rod(spec) else None,
        lambda spec: Interval(_bar_inertia(spec, 0.06), _bar_inertia(spec, 0.16)),
        "a uniform bar, m l^2/12; connecting rods: 0.06 to 0.16 m l^2",
    ),
)
