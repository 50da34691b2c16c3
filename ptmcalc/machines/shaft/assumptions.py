"""What is filled in where a design file leaves it out, and how wrong that may be."""

from ptmcalc.base import units
from ptmcalc.base.estimate import Interval
from ptmcalc.contract.machine import Assumption
from ptmcalc.machines.shaft.spec import Shaft, SliderCrank


def _efficiency(spec: Shaft) -> float:
    return 1.0 if spec.drive.gear.ratio == 1 else 0.94


def _efficiency_interval(spec: Shaft) -> Interval:
    return Interval(1.0, 1.0) if spec.drive.gear.ratio == 1 else Interval(0.90, 0.97)


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
        "a uniform bar, m l^2/12; the masses of a rod lie between 0.06 and 0.16 m l^2",
    ),
)
