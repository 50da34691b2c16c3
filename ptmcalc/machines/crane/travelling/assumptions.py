"""What is filled in where a design file leaves it out, and how wrong that may be."""

import math
from collections.abc import Iterator, Mapping

from ptmcalc.base import units
from ptmcalc.base.estimate import Interval
from ptmcalc.contract.machine import Assumption, Use
from ptmcalc.laws import skew
from ptmcalc.machines.crane.travelling.machine.scenes import Runway, Skew
from ptmcalc.machines.crane.travelling.machine.spec import Travelling

_HEAD = 0.05
"""Of a rail of which the file says nothing, the narrowest usual one of cranes [m]."""
_WIDE = 1.5
"""Wear that is reckoned with at most, over that of the standards."""
_STEEL = 7850.0  # kg/m^3
_OF_SKEWING = Use(frozenset({Skew, Runway}), frozenset({"skew_force", "runway_skew_angle"}))
_OF_TRAVEL = Use(
    loads=frozenset(
        {
            "brake_distance",
            "brake_time",
            "drive_utilisation",
            "heating_utilisation",
            "horizontal_force",
            "overhauling_reserve",
            "skid_reserve",
            "skid_reserve_min",
            "stability_reserve",
            "start_distance",
            "start_time",
            "starting_reserve",
            "storm_reserve",
            "sway_angle_max",
            "sway_residual",
            "torque_motor_max",
            "wheel_load_factored",
            "wheel_load_max",
            "wheel_load_min",
            "wind_reserve",
        }
    )
)
"""Resistance, losses and wind change the travel motion; buffers, rail steps and skewing have rules of their own."""
USES: Mapping[str, Use] = {
    "guide.tolerance": _OF_SKEWING,
    "guide.wear": _OF_SKEWING,
    "rail.slope": _OF_TRAVEL,
    "wind.load_shape": _OF_TRAVEL,
}


def assumptions(spec: Travelling) -> Iterator[Assumption[Travelling]]:
    """What is assumed of masses, rails, wheels and drive."""
    yield from _of_the_masses(spec)
    yield from _of_the_rails(spec)
    yield from _of_the_drive(spec)
    if spec.duty is not None and spec.duty.type != "S1":
        yield Assumption(
            ("duty", "factor"),
            units.SHARE,
            lambda spec: 0.4,
            lambda spec: Interval(0.25, 0.6),
            "rated duty factors of crane motors are 25, 40 and 60 %",
        )


def _of_the_masses(spec: Travelling) -> Iterator[Assumption[Travelling]]:
    load = spec.load
    yield Assumption(
        ("hook_block",),
        units.MASS,
        lambda spec: 0.0,
        lambda spec: Interval(0.0, 0.03 * load),
        "included in the load, or additionally 1 to 3 % of it",
    )
    if spec.bridge is not None:
        span, legs = spec.bridge.span, spec.travels == "gantry"
        yield Assumption(
            ("bridge", "height"),
            units.SPAN,
            lambda spec: 0.0,
            lambda spec: Interval(0.0, (0.5 if legs else 0.05) * span),
            "girder height about span/15; portal height about half the span",
        )
    gauge, portal = spec.gauge, spec.travels == "gantry"
    yield Assumption(
        ("trolley", "height"),
        units.SPAN,
        lambda spec: 0.0,
        lambda spec: Interval(0.0, (0.6 if portal else 0.1 if spec.bridge is not None else 0.5) * gauge),
        "trolleys run on the girders; the centre of gravity of a trolley is at most half its gauge above its rails",
    )
    diameter = spec.wheels.diameter
    disc = 0.5 * _STEEL * math.pi * (diameter / 2) ** 4 * 0.25 * diameter
    yield Assumption(
        ("wheels", "inertia"),
        units.INERTIA,
        lambda spec: 0.0,
        lambda spec: Interval(0.0, 1.2 * disc),
        "steel discs with a width of a quarter of their diameter, with axle and gear wheel",
    )
    if spec.wind is not None:
        area = 1.2 * (load / 1000) ** (2 / 3)
        yield Assumption(
            ("wind", "load_area"),
            units.FACE,
            lambda spec: 0.0,
            lambda spec: Interval(0.0, 1.5 * area),
            "a cube of water: 1 m^2 for 1 t; crane rules require 1.2 m^2/t for small loads, less for large loads",
        )
        pressure = spec.wind.pressure
        yield Assumption(
            ("wind", "pressure_max"),
            units.PRESSURE,
            lambda spec: pressure,
            lambda spec: Interval(pressure, max(1.5 * pressure, 250.0)),
            "EN 13001-2, ISO 4302: 125 Pa (light) and 250 Pa (normal) in-service wind",
        )


def _of_the_rails(spec: Travelling) -> Iterator[Assumption[Travelling]]:
    yield Assumption(
        ("rail", "adhesion"),
        units.RATIO,
        lambda spec: 0.14,
        lambda spec: Interval(0.12, 0.2),
        "steel wheels: 0.2 dry indoors, 0.12 outdoors, 0.25 with sand (handbooks of lifting machines)",
    )
    if spec.rolling.lever_arm is not None:
        diameter = spec.wheels.diameter
        yield Assumption(
            ("rolling", "axle_diameter"),
            units.LENGTH,
            lambda spec: 0.25 * diameter,
            lambda spec: Interval(0.2 * diameter, 0.3 * diameter),
            "axles of crane wheels: 0.2 to 0.3 of the wheel",
        )
        yield Assumption(
            ("rolling", "bearing_friction"),
            units.RATIO,
            lambda spec: 0.015,
            lambda spec: Interval(0.01, 0.02),
            "wheels on rolling bearings 0.015 to 0.02, on plain bearings 0.08 to 0.1",
            _OF_TRAVEL,
        )
        yield Assumption(
            ("rolling", "flange_factor"),
            units.RATIO,
            lambda spec: 1.5,
            lambda spec: Interval(1.2, 1.8),
            "flanged cylindrical wheels on rolling bearings 1.5, conical wheels 1.2; plain bearings up to 2.5",
            _OF_TRAVEL,
        )
    of_runway = spec.runway is not None and spec.runway.phi4 is None and (spec.rail.step > 0 or spec.rail.gap > 0)
    if of_runway or any(scene.type == "rail_step" for scene in spec.all_scenes):
        yield Assumption(
            ("rail", "frequency"),
            units.FREQUENCY,
            lambda spec: 10.0,
            lambda spec: Interval(5.0, 20.0),
            "cranes on wheels and rails oscillate vertically at 5 to 20 Hz; lower for bridges of large span",
        )
    if spec.guide is not None:
        share, head = skew.WEAR_SHARE[spec.guide.type], spec.rail.head
        wide = Interval(0.9 * share * _HEAD, 2 * share * _HEAD)
        yield Assumption(
            ("guide", "wear"),
            units.LENGTH,
            lambda spec: share * (head or _HEAD),
            lambda spec: Interval(share * head, _WIDE * share * head) if head is not None else wide,
            "EN 13001-2, EN 1991-3: at least 0.1 of the rail head width with flanges, 0.03 with rollers;"
            " rail heads are 45 to 100 mm wide",
            _OF_SKEWING,
        )


def _of_the_drive(spec: Travelling) -> Iterator[Assumption[Travelling]]:
    ratio = spec.drive.gear.ratio
    yield Assumption(
        ("drive", "gear", "efficiency"),
        units.RATIO,
        lambda spec: 0.9,
        lambda spec: Interval(1.0, 1.0) if ratio == 1 else Interval(0.85, 0.95),
        "two to three stages of helical or bevel gears, possibly one open stage",
    )
    yield Assumption(
        ("drive", "gear", "reverse_efficiency"),
        units.RATIO,
        lambda spec: spec.drive.reverse_range[0],
        lambda spec: Interval(*spec.drive.reverse_range),
        "2 - 1/efficiency with equal losses in both directions; as large as the efficiency at most",
        _OF_TRAVEL,
    )
    rotor = spec.drive.motor.inertia
    yield Assumption(
        ("drive", "motor", "coupling_inertia"),
        units.INERTIA,
        lambda spec: 0.15 * rotor,
        lambda spec: Interval(0.10 * rotor, 0.25 * rotor),
        "couplings and gear increase the rotor inertia by a factor of 1.1 to 1.25 (lecture notes, Kramatorsk 2007)",
    )
