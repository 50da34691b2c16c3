"""Torques read from the curve of a motor: up to a speed, and above the no-load speed."""

import math

import numpy as np

from ptmcalc.components.motor import AnyMotor, ConverterMotor, InductionBase
from ptmcalc.components.motor_stage import FloatArray

_LOOKS = 1025
"""Even steps of the speed at which a curve is looked at, from rest on."""


def torques_up_to(curve: AnyMotor, speed: float) -> FloatArray:
    """Torque of a motor over even steps from rest to a speed [rad/s], shape (n,) [N*m].

    Where stages are switched by time, the best of them at each speed: which one it is, a run tells. Of a converter its
    limit, which it gives at any speed.
    """
    if isinstance(curve, ConverterMotor):
        return np.full(_LOOKS, curve.limit)
    speeds = np.linspace(0.0, speed, _LOOKS)
    if any(stage.until_time is not None for stage in curve.stages):
        return np.asarray(np.max([stage.torque(speeds) for stage in curve.stages], axis=0))
    return curve.torque(speeds, np.inf)


def range_up_to(curve: AnyMotor, speed: float) -> tuple[float, float]:
    """Smallest and largest torque of a motor that starts up to a speed [rad/s], bounds to either side [N*m].

    Each stage at any speed up to that at which it ends: a swinging load may slow the motor down again. Between two
    steps of the speed a torque differs from theirs by no more than they differ from each other.
    """
    least, most = math.inf, -math.inf
    for stage in curve.stages:
        until = speed if stage.until_speed is None else min(stage.until_speed, speed)
        torques = stage.torque(np.linspace(0.0, until, _LOOKS))
        between = float(np.max(np.abs(np.diff(torques))))
        least, most = min(least, float(np.min(torques)) - between), max(most, float(np.max(torques)) + between)
        if until == speed and stage.until_time is None:
            break
    return least, most


def overhauled_torque(curve: AnyMotor) -> float:
    """The most with which a motor brakes a load that drives it above its no-load speed, once its start is over [N*m].

    Infinite where the torque grows with the speed without end (`linear`), 0 where the motor never brakes.
    """
    if isinstance(curve, ConverterMotor):
        return curve.limit
    last = curve.stages[-1]
    if isinstance(curve, InductionBase):
        slip = np.array([-curve.breakdown_slip])
        return -float(last.torque((1 - slip) * curve.synchronous_speed)[0])
    assert last.pieces is not None
    if last.extends:
        return np.inf
    return max(0.0, -min(torque for speed, torque in last.pieces if speed >= 0 or torque >= 0))


def overhauling_reserve(curve: AnyMotor, count: int, torque: float) -> float:
    """Largest braking torque of equal motors above their no-load speed over the torque of a load that drives them.

        reserve = n M_b/M_o,   infinite where the load does not drive the motors (M_o <= 0)

    Args:
        curve: of one motor.
        count: n, the number of motors.
        torque: M_o, of the load on the motor shaft, losses of the gear taken off [N*m].

    Returns:
        The reserve [1].

    **Range** steady motion; a motor whose start is over.
    **Error** exact for the curve. Below 1 no speed exists at which the motors hold the load.
    **Source** balance of torques on the motor shaft.
    """
    return count * overhauled_torque(curve) / torque if torque > 0 else math.inf


_HALVINGS = 200
"""Halvings of the interval of a speed. A numerical choice: more than the resolution of the floating point has."""


def carrying_speed(curve: AnyMotor, torque: float) -> float | None:
    """Speed at which a motor steadily carries a torque, negative where a load drives it, once its start is over
    [rad/s].

        M(w) = M_o   on the branch through the no-load speed

    Args:
        curve: of one motor.
        torque: M_o, of one motor [N*m].

    Returns:
        w; infinite where the load overcomes the braking torque, 0 where the motor stalls, None for a converter, which
        holds its own speed, and for a motor without a no-load speed.

    **Range** steady motion on the last stage of the curve.
    **Error** rounding, by halving the interval.
    **Source** balance of torques on the motor shaft; Kloss for slip below 0 where the curve is one of an induction
    motor.
    """
    idle = curve.no_load_speed
    if isinstance(curve, ConverterMotor) or idle is None:
        return None
    last = curve.stages[-1]
    low, high = _branch(curve, idle)
    low, high = (low, idle) if torque >= 0 else (idle, high)
    while last.extends and float(last.torque(high)) > torque:
        high *= 2
    if float(last.torque(high)) > torque:
        return math.inf
    if float(last.torque(low)) < torque:
        return 0.0
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if float(last.torque(middle)) > torque else (low, middle)
    return (low + high) / 2


def _branch(curve: AnyMotor, idle: float) -> tuple[float, float]:
    """Speeds of the largest and the smallest torque on the branch through the no-load speed [rad/s]."""
    last = curve.stages[-1]
    if isinstance(curve, InductionBase):
        return (1 - curve.breakdown_slip) * idle, (1 + curve.breakdown_slip) * idle
    assert last.pieces is not None
    below = [knot for knot in last.pieces if knot[0] <= idle] or [(0.0, 0.0)]
    above = [knot for knot in last.pieces if knot[0] >= idle] or [(idle, 0.0)]
    return max(below, key=lambda knot: knot[1])[0], min(above, key=lambda knot: knot[1])[0]
