"""What is filled in where a design file leaves it out, and how wrong that may be."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.base.estimate import Interval
from ptmcalc.contract.machine import Assumption
from ptmcalc.machines.crane.travelling.spec import Travelling


def assumptions(spec: Travelling) -> Iterator[Assumption[Travelling]]:
    """What is assumed of rails, wheels and drive."""
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
    if any(scene.type == "rail_step" for scene in spec.all_scenes):
        yield Assumption(
            ("rail", "frequency"),
            units.FREQUENCY,
            lambda spec: 10.0,
            lambda spec: Interval(5.0, 20.0),
            "cranes on their wheels and rails swing vertically at 5 to 20 Hz; bridges of large span below",
        )
    ratio = spec.drive.gear.ratio
    yield Assumption(
        ("drive", "gear", "efficiency"),
        units.RATIO,
        lambda spec: 0.9,
        lambda spec: Interval(1.0, 1.0) if ratio == 1 else Interval(0.85, 0.95),
        "two to three stages of helical or bevel gears, an open one perhaps among them",
    )
    rotor = spec.drive.motor.inertia
    yield Assumption(
        ("drive", "motor", "coupling_inertia"),
        units.INERTIA,
        lambda spec: 0.15 * rotor,
        lambda spec: Interval(0.10 * rotor, 0.25 * rotor),
        "couplings and gear take 1.1 to 1.25 times the rotor's inertia (lecture notes, Kramatorsk 2007)",
    )
    if spec.duty is not None and spec.duty.type != "S1":
        yield Assumption(
            ("duty", "factor"),
            units.SHARE,
            lambda spec: 0.4,
            lambda spec: Interval(0.25, 0.6),
            "rated duty factors of crane motors are 25, 40 and 60 %",
        )
