"""What is filled in where a design file leaves it out, and how wrong that may be."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.base.estimate import Interval
from ptmcalc.contract.machine import Assumption
from ptmcalc.machines.crane.slewing.machine.spec import SlewingCrane

_WIDE = 0.15
"""Radius of gyration of a part about its own centre, over the radius of the load, at most."""


def assumptions(spec: SlewingCrane) -> Iterator[Assumption[SlewingCrane]]:
    """What is assumed of masses, wind, ring and drive."""
    yield from _of_the_parts(spec)
    yield from _of_the_wind(spec)
    if spec.motor.coupling_inertia is None:
        yield Assumption(
            ("motor", "coupling_factor"),
            units.FACTOR,
            lambda spec: 1.7,
            lambda spec: Interval(1.4, 2.0),
            "rotor with coupling: 1.4 to 2 times the rotor inertia (course notes, slewing crane on a fixed column)",
        )
    back, forward = spec.gear.back, spec.gear.efficiency
    yield Assumption(
        ("gear", "reverse_efficiency"),
        units.RATIO,
        lambda spec: back if back > 0 else None,  # whether a gear locks itself is not left to an interval
        lambda spec: Interval(back, forward),
        "2 - 1/efficiency with equal losses in both directions; as large as the efficiency at most",
    )


def _of_the_parts(spec: SlewingCrane) -> Iterator[Assumption[SlewingCrane]]:
    load = spec.load
    if load is None:
        return
    if spec.inertia is None:
        yield Assumption(
            ("load", "hook_block"),
            units.MASS,
            lambda spec: 0.0,
            lambda spec: Interval(0.0, 0.03 * load.mass),
            "included in the load, or additionally 1 to 3 % of it",
        )
    for key in ("slewing_part", "counterweight"):
        part = getattr(spec, key)
        if part is not None:
            yield _of_a_part(key, part.mass * (_WIDE * load.radius) ** 2)
    if spec.ring.curve is not None:
        yield Assumption(
            ("ring", "head_height"),
            units.SPAN,
            lambda spec: 0.0,
            lambda spec: Interval(0.0, 0.5 * load.radius),
            "the jib head is at most half the jib radius above the ring",
        )
        if spec.ring.wind_force is not None:
            yield Assumption(
                ("ring", "wind_height"),
                units.SPAN,
                lambda spec: 0.0,
                lambda spec: Interval(0.0, 0.5 * load.radius),
                "the wind acts at half the height of the jib; the jib height is at most its radius",
            )


def _of_a_part(key: str, most: float) -> Assumption[SlewingCrane]:
    return Assumption(
        (key, "inertia"),
        units.INERTIA,
        lambda spec: 0.0,
        lambda spec: Interval(0.0, most),
        "a point load, or a load of a width of up to a seventh of the jib radius",
    )


def _of_the_wind(spec: SlewingCrane) -> Iterator[Assumption[SlewingCrane]]:
    wind = spec.wind
    least = wind.maximum_torque
    if least > 0 and wind.maximum_pressure is None:
        yield Assumption(
            ("wind", "maximum"),
            units.TORQUE,
            lambda spec: least,
            lambda spec: Interval(least, max(2 * wind.steady_torque, least) * 1.001),
            "EN 13001-2, ISO 4302: 125 Pa (light) and 250 Pa (normal) in-service wind",
        )
    if wind.gust_torque > 0:
        yield Assumption(
            ("wind", "gust_rise"),
            units.TIME,
            lambda spec: 2.0,
            lambda spec: Interval(0.5, 3.0),
            "gusts rise in 0.5 to 3 s",
        )
        yield Assumption(
            ("wind", "gust_time"),
            units.TIME,
            lambda spec: 5.0,
            lambda spec: Interval(3.0, 10.0),
            "gusts of wind last 3 to 10 s",
        )
