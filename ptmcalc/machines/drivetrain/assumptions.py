"""Values that a design file leaves out, and the interval each of them may be in."""

import math
from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.base.estimate import Interval
from ptmcalc.components.motor import AnyMotor, InductionBase
from ptmcalc.contract.machine import Assumption
from ptmcalc.machines.drivetrain.machine.keys.gears import Gear
from ptmcalc.machines.drivetrain.machine.keys.links import Link
from ptmcalc.machines.drivetrain.machine.model import turning_with
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain, Stop

_WORN = 0.15
"""Upper limit of wear that the file omits, relative to the tooth [1]: the earliest renewal of lecture notes Kramatorsk,
15 to 25 %. A larger value widens the error bars."""
_SLIP = 0.05
"""Slip of a motor whose rated speed is not known [1], as a start ends at 95 % of its speed. An engineering choice. A
larger value increases the overspeed of a driven motor."""
_RIGID_RESTITUTION = 0.5
"""Upper limit of the coefficient of restitution of steel parts with lubricant [1]. An engineering choice. A larger
value widens the error bars of trains with impacts."""


def assumed(spec: Drivetrain) -> Iterator[Assumption[Drivetrain]]:
    """Assumptions of each part: losses of a gear driven back, wear of a clearance, rebound, speed before a stop."""
    for name, gear in spec.gears.items():
        if gear.efficiency < 1:
            yield _driven_back(name, gear)
    for name, link in spec.links.items():
        if link.clearance is not None and link.clearance.module is not None:
            yield _wear(name, link.clearance.module)
        if link.law == "rigid":
            yield _rebound(name, link)
    for index, scene in enumerate(spec.all_scenes):
        if isinstance(scene, Stop) and not _moves(spec):
            yield from _stopped_from(spec, index, scene)


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
        "from a new gear to 15 % of the tooth, the earliest wear limit of gears",
    )


def _rebound(name: str, link: Link) -> Assumption[Drivetrain]:
    return Assumption(
        ("links", name, "restitution"),
        units.RATIO,
        lambda spec: 0.0,
        lambda spec: Interval(0.0, _RIGID_RESTITUTION),
        "steel on steel with lubricant: 0 to 0.5",
    )


def _moves(spec: Drivetrain) -> bool:
    """Whether the file gives the speed of a part at the start."""
    return any(body.speed is not None for body in spec.inertias.values()) or bool(spec.motions)


def _stopped_from(spec: Drivetrain, index: int, scene: Stop) -> Iterator[Assumption[Drivetrain]]:
    """The no-load speed of the first motor that has one, on the shaft of the scene; none without such a motor."""
    main = spec.main(scene)
    speeds = _motor_speeds(spec, main)
    if speeds is None:
        return
    speed, most = speeds
    yield Assumption(
        ("scenes", index, "speed"),
        units.ANGULAR_SPEED if spec.turns(main) else units.SPEED,
        lambda spec: speed,
        lambda spec: Interval(-most, most),
        "no-load speed of the motor; in either direction, up to the speed at which the load drives it with its rated"
        " slip",
    )


def _motor_speeds(spec: Drivetrain, main: str) -> tuple[float, float] | None:
    """Speed of the main inertia at the no-load speed of its motor, and at that of the motor driven by the load."""
    names = list(spec.inertias)
    for one in spec.motors.values():
        no_load = one.motor.no_load_speed
        found = turning_with(spec, {names.index(one.at): 1.0}, together=True).get(names.index(main))
        if no_load is not None and found is not None:
            return found * no_load, abs(found) * _fastest(one.motor, no_load)
    return None


def _fastest(curve: AnyMotor, no_load: float) -> float:
    """Speed of a motor that is driven with its rated slip [rad/s]."""
    return 2 * no_load - curve.speed if isinstance(curve, InductionBase) else (1 + _SLIP) * no_load
