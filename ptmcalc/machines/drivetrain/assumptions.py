"""Values that a design file leaves out, and the interval each of them may be in."""

import math
from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.base.estimate import Interval
from ptmcalc.contract.machine import Assumption
from ptmcalc.machines.drivetrain.model import at_rest, rated_speed
from ptmcalc.machines.drivetrain.spec import Drivetrain, Gear, Link, Stop

_WORN = 0.15
"""Wear at which gears are renewed at the earliest, relative to the tooth (lecture notes Kramatorsk: 15 to 25 %)."""
_RIGID_RESTITUTION = 0.5
"""Largest coefficient of restitution of steel parts with lubricant between them."""


def assumed(spec: Drivetrain) -> Iterator[Assumption[Drivetrain]]:
    """What is assumed of each part: losses of a gear driven back, wear of a clearance, rebound of a rigid
    contact, speed at which a stop begins."""
    for name, gear in spec.gears.items():
        if gear.efficiency < 1:
            yield _driven_back(name, gear)
    for name, link in spec.links.items():
        if link.clearance is not None and link.clearance.module is not None:
            yield _wear(name, link.clearance.module)
        if link.law == "rigid":
            yield _rebound(name, link)
    if not at_rest(spec):
        return
    for index, scene in enumerate(spec.scenes or ()):
        motor = next((one.motor for one in spec.motors.values() if one.at == spec.main(scene)), None)
        rated = motor and rated_speed(motor)
        if isinstance(scene, Stop) and motor is not None and rated:
            yield _stop_speed(index, rated, motor.no_load_speed or rated, spec.turns(spec.main(scene)))


def _stop_speed(index: int, rated: float, highest: float, turns: bool) -> Assumption[Drivetrain]:
    return Assumption(
        ("scenes", index, "speed"),
        units.ANGULAR_SPEED if turns else units.SPEED,
        lambda spec: rated,
        lambda spec: Interval(min(rated, highest), max(rated, highest)),
        "a stop begins at the motor's rated speed, without load at its no-load speed",
    )


def _driven_back(name: str, gear: Gear) -> Assumption[Drivetrain]:
    """Equal lost torque both ways, to equal efficiency both ways; a self-locking gear stays one."""
    equal_loss = 2 - 1 / gear.efficiency
    return Assumption(
        ("gears", name, "reverse_efficiency"),
        units.RATIO,
        lambda spec: equal_loss,
        lambda spec: Interval(equal_loss, gear.efficiency if equal_loss > 0 else equal_loss),
        "from 2 - 1/efficiency (equal lost torque) to the efficiency itself",
    )


def _wear(name: str, module: float) -> Assumption[Drivetrain]:
    most = _WORN * math.pi * module / 2
    return Assumption(
        ("links", name, "clearance", "wear"),
        units.LENGTH,
        lambda spec: 0.0,
        lambda spec: Interval(0.0, most),
        "from a new gear to 15 % of the tooth, the wear at which gears are renewed at the earliest",
    )


def _rebound(name: str, link: Link) -> Assumption[Drivetrain]:
    return Assumption(
        ("links", name, "restitution"),
        units.RATIO,
        lambda spec: 0.0,
        lambda spec: Interval(0.0, _RIGID_RESTITUTION),
        "steel on steel with lubricant: 0 to 0.5",
    )
