"""What is filled in where a design file leaves it out, and how wrong that may be."""

import math
from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.base.estimate import Interval
from ptmcalc.contract.machine import Assumption, Use
from ptmcalc.laws.duty import DUTY_TYPES
from ptmcalc.machines.hoist.braking.loads import ONE_STOP, REPEATED
from ptmcalc.machines.hoist.machine.spec import EmergencyStop, Hoist, WindUp

_MASS_FACTOR, _LIGHT, _HEAVY = 3800.0, 3400.0, 4300.0
"""Mass per length of a rope relative to the square of its diameter [kg/m^3], EN 12385-4. `_MASS_FACTOR`: default.
`_LIGHT` and `_HEAVY`: limits of the interval, 0.34 to 0.43 kg/(100 m mm^2). Rope mass is proportional to the default;
wider limits widen the error bars."""
_PITCH, _NARROW, _WIDE = 1.12, 1.06, 1.18
"""Pitch of a groove relative to the rope diameter [1]; drums have 1.1 to 1.15. `_PITCH`: default. `_NARROW` and
`_WIDE`: limits of the interval, an engineering choice. Wraps and fleet angle depend on it; wider limits widen their
error bars."""


def _pitch(spec: Hoist) -> float | None:
    return _PITCH * spec.rope.diameter if spec.drum.surface == "grooved" else None


def _deflected(spec: Hoist) -> float | None:
    """Efficiency of a deflection sheave: that of the sheaves of the tackle."""
    return (spec.reeving.sheave_efficiency or 0.98) if spec.reeving.deflection_sheaves else None


_DRUM_SHARE = 0.05
"""Upper limit of the inertia of a drum that the file omits, relative to the rotors on the same shaft [1]. An
engineering choice. A larger value widens the error bars; a smaller one excludes heavy drums."""


def _reversed(spec: Hoist) -> float | None:
    """Reverse efficiency of the gearbox with the losses of the forward one, 2 - 1/eta."""
    gear = spec.gearbox
    return None if gear is None or gear.efficiency is None else 2 - 1 / gear.efficiency


def _either_way(spec: Hoist) -> Interval:
    """Reverse efficiency of the gearbox: losses as forward, or the forward efficiency."""
    least = _reversed(spec)
    assert least is not None
    return Interval(least, max(least, 1 / (2 - least)))


def _drum_inertia(spec: Hoist) -> Interval:
    if spec.gearbox is None or spec.motor is None:
        return Interval(0.0, 0.0)
    return Interval(0.0, _DRUM_SHARE * spec.motor.count * spec.motor.inertia * spec.gearbox.ratio**2)


_OF_THE_TACKLE: tuple[Assumption[Hoist], ...] = (
    Assumption(
        ("reeving", "sheave_efficiency"),
        units.RATIO,
        lambda spec: 0.98,
        lambda spec: Interval(0.97, 0.985),
        "sheaves on rolling bearings 0.98 to 0.985, on plain bearings 0.95 to 0.97",
    ),
    Assumption(
        ("reeving", "deflection_efficiency"),
        units.RATIO,
        _deflected,
        lambda spec: Interval(min(0.97, _deflected(spec) or 1.0), max(0.985, _deflected(spec) or 0.0)),
        "equal to the sheaves of the reeving; on rolling bearings 0.97 to 0.985",
    ),
    Assumption(
        ("drum", "inertia"),
        units.INERTIA,
        lambda spec: 0.0 if spec.gearbox is not None and spec.motor is not None else None,
        _drum_inertia,
        "neglected; seldom above 5 % of the rotor inertia at the drum shaft",
    ),
    Assumption(
        ("rope", "fill_factor"),
        units.RATIO,
        lambda spec: 0.5 if spec.rope.area is None else None,
        lambda spec: Interval(0.4, 0.6),
        "0.4 with a fibre core to 0.6 with a steel core, more for compacted ropes; see the manufacturer's catalogue",
    ),
    Assumption(
        ("rope", "modulus"),
        units.STRESS,
        lambda spec: 1.05e11,
        lambda spec: Interval(0.9e11, 1.3e11),
        "wire ropes on their metallic area: 90 GPa new to 130 GPa run in, half of the wire modulus; measure it",
    ),
    Assumption(
        ("rope", "mass"),
        units.LINE_MASS,
        lambda spec: _MASS_FACTOR * spec.rope.diameter**2,
        lambda spec: Interval(_LIGHT * spec.rope.diameter**2, _HEAVY * spec.rope.diameter**2),
        "EN 12385-4: 0.34 to 0.43 kg/(100 m mm^2) times the square of the diameter",
    ),
    Assumption(
        ("drum", "pitch"),
        units.LENGTH,
        _pitch,
        lambda spec: Interval(_NARROW * spec.rope.diameter, _WIDE * spec.rope.diameter),
        "grooves of hoist drums: 1.1 to 1.15 rope diameters apart",
    ),
)


_SPECIFIC_HEAT, _LEAST_HEAT, _MOST_HEAT = 500.0, 460.0, 540.0
"""Specific heat of brake discs [J/(kg K)]: steel 490 to 500, grey iron 500 to 540, some steels 460. The temperature
rise of a stop is inversely proportional to it; wider limits widen its range."""
_COOLING, _FAST, _SLOW = 2400.0, 1200.0, 3600.0
"""Time constant of the cooling of brake discs [s]: an engineering range of 20 to 60 min. The temperature of many stops
is nearly proportional to it; wider limits widen its range."""


def _of_the_brake() -> Iterator[Assumption[Hoist]]:
    """What is assumed of the heat of the brake, where the file gives its discs."""
    yield Assumption(
        ("brake", "specific_heat"),
        units.SPECIFIC_HEAT,
        lambda spec: _SPECIFIC_HEAT,
        lambda spec: Interval(_LEAST_HEAT, _MOST_HEAT),
        "steel 490 to 500 J/(kg K), grey iron 500 to 540; some steels 460",
        Use(frozenset({EmergencyStop}), frozenset({ONE_STOP, REPEATED})),
    )
    yield Assumption(
        ("brake", "cooling_time"),
        units.TIME,
        lambda spec: _COOLING if spec.brake is not None and spec.brake.stops_per_hour is not None else None,
        lambda spec: Interval(_FAST, _SLOW),
        "engineering range of 20 to 60 min, to be compared with the data sheet of the brake",
        Use(frozenset({EmergencyStop}), frozenset({REPEATED})),
    )


def assumptions(spec: Hoist) -> Iterator[Assumption[Hoist]]:
    """What is assumed of tackle, rope and drum, and of the drive where the file has one."""
    yield from _OF_THE_TACKLE
    if spec.gearbox is not None:
        ratio = spec.gearbox.ratio
        yield Assumption(
            ("gearbox", "efficiency"),
            units.RATIO,
            lambda spec: 0.94,
            lambda spec: Interval(1.0, 1.0) if ratio == 1 else Interval(0.90, 0.97),
            "two to three stages of helical or bevel gears, 0.98 to 0.99 each",
        )
        yield Assumption(
            ("gearbox", "reverse_efficiency"),
            units.RATIO,
            _reversed,
            _either_way,
            "2 - 1/eta (equal losses in both directions), or the forward efficiency",
        )
    if spec.duty is not None and DUTY_TYPES[spec.duty.type].at_rest:
        yield Assumption(
            ("duty", "factor"),
            units.SHARE,
            lambda spec: 0.4,
            lambda spec: Interval(0.25, 0.6),
            "rated duty factors of hoist motors are 25, 40 and 60 %",
        )
    if spec.motor is not None:
        rotor = spec.motor.inertia
        yield Assumption(
            ("motor", "coupling_inertia"),
            units.INERTIA,
            lambda spec: 0.15 * rotor,
            lambda spec: Interval(0.10 * rotor, 0.25 * rotor),
            "couplings and gear increase the rotor inertia by a factor of 1.1 to 1.25 (lecture notes, Kramatorsk 2007)",
        )
    if spec.brake is not None and spec.brake.disc_mass is not None:
        yield from _of_the_brake()
    if any(scene.type == "winding" for scene in spec.all_scenes):
        yield Assumption(
            ("winding", "crossover"),
            units.ANGLE,
            lambda spec: math.radians(60),
            lambda spec: Interval(math.radians(45), math.radians(75)),
            "crossovers of drums with parallel grooves extend over 60 to 70 deg; measure them",
            Use(scenes=frozenset({WindUp})),
        )
