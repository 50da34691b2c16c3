"""A brake that acts after a delay and takes time to close: its torque, the stop, the torque it needs, its heat.

Everything is on the brake's shaft. The body turns at first with a positive speed; the other torque M_o is what acts
besides the brake, positive in the direction of motion (a load being lowered), negative against it (friction, a load
being hoisted). Rise `linear`: full torque after the rise time; `exponential`: 1 - exp(-t/t_r).
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

LINEAR, EXPONENTIAL = "linear", "exponential"
_STEPS = 20
"""More than Newton's method, started from the bound below, takes over twenty-four decades of every argument (7)."""


def _check(rise: str) -> None:
    if rise not in (LINEAR, EXPONENTIAL):
        raise ValueError(f"the rise of a brake is {LINEAR} or {EXPONENTIAL}")


def braking_torque(time: ArrayLike, torque: float, delay: float, rise_time: float, rise: str) -> FloatArray:
    """Torque of a brake over time.

        linear: M min((t - t_d)/t_r, 1)      exponential: M (1 - exp(-(t - t_d)/t_r))      0 before t_d

    Args:
        time: t, since the command [s].
        torque: M, when closed [N*m].
        delay: t_d, before anything happens [s].
        rise_time: t_r; 0 for a brake that closes at once [s].
        rise: `linear` or `exponential`.

    Returns:
        torque [N*m].

    **Range** while the shaft turns; at rest a brake holds with what it is asked for, up to M.
    **Error** the two shapes of rise stand for a spring brake and a thruster or a coil with a time constant.
    **Source** usual model of industrial brakes.

    Raises:
        ValueError: for another rise.
    """
    _check(rise)
    since = np.asarray(time, float) - delay
    if rise_time == 0:
        return np.where(since >= 0, torque, 0.0)
    share = np.maximum(since, 0.0) / rise_time
    return np.asarray(torque * (np.minimum(share, 1.0) if rise == LINEAR else -np.expm1(-share)))


def brake_stop(
    inertia: float, speed: float, torque: float, other_torque: float, delay: float, rise_time: float, rise: str
) -> tuple[float, float]:
    """Time and angle in which a brake with delay and rise stops a rigid body.

        J w' = M_o - M_b(t),  w(0) = w_0;   stop at w = 0, angle = integral of w

    Closed form in the delay, in a linear rise (root of a quadratic) and after it; in an exponential rise the root of

        J w_1 + (M_o - M) s + M t_r (1 - exp(-s/t_r)) = 0

    Args:
        inertia: J, everything that turns, on the shaft of the brake [kg*m^2].
        speed: w_0, when the command is given [rad/s].
        torque: M, of the closed brake [N*m].
        other_torque: M_o, constant, positive in the direction of motion [N*m].
        delay: t_d [s].
        rise_time: t_r; 0 for a brake that closes at once [s].
        rise: `linear` or `exponential`.

    Returns:
        (time since the command [s], angle [rad]); both infinite for M <= M_o, a brake that does not hold.

    **Range** a rigid drive train, w_0 >= 0; the motor off at the command.
    **Error** exact for that model.
    **Source** derived: integration phase by phase; the exponential rise by Newton's method from above on a concave
    function, which cannot miss.

    Raises:
        ValueError: for another rise.
    """
    _check(rise)
    coast = -inertia * speed / other_torque if other_torque < 0 else math.inf
    if coast <= delay:
        return coast, speed * coast / 2
    if torque <= other_torque:
        return math.inf, math.inf
    momentum = max(inertia * speed + other_torque * delay, 0.0)
    turned = delay * (speed + other_torque * delay / inertia / 2)
    if rise_time > 0 and rise == EXPONENTIAL:
        time, work = _exponential_stop(momentum, torque, other_torque, rise_time)
    else:
        time, work = _linear_stop(momentum, torque, other_torque, rise_time)
    return delay + time, turned + work / inertia


def _linear_stop(momentum: float, torque: float, other: float, rise: float) -> tuple[float, float]:
    """Time and J times angle from the end of the delay; every term of the angle is a sum."""
    left = momentum + (other - torque / 2) * rise
    if rise > 0 and left <= 0:
        start = momentum / rise
        root = math.hypot(other, math.sqrt(2 * torque) * math.sqrt(start))
        y = (other + root) / torque if other > 0 else 2 * start / (root - other) if start > 0 else 0.0
        return rise * y, rise * rise * y * (torque * y * y / 12 + start / 2)
    done = (momentum + left) * rise / 2 + torque * rise * rise / 12  # trapezium and what bulges over it
    time = left / (torque - other)
    return rise + time, done + left * time / 2


def _exponential_stop(momentum: float, torque: float, other: float, rise: float) -> tuple[float, float]:
    """As `_linear_stop`, y = s/t_r, from y - 1 + exp(-y) >= y^2/(2 + y) above the root."""
    if momentum > 0 and momentum + torque * rise == momentum:  # a rise too short to be felt
        return _linear_stop(momentum, torque, other, 0.0)
    start = momentum / rise
    net, slope = torque - other, start + 2 * other
    root = math.hypot(slope, math.sqrt(8 * net) * math.sqrt(start))
    y = (slope + root) / (2 * net) if slope >= 0 else 4 * start / (root - slope)
    for _ in range(_STEPS if y > 0 else 0):
        step = (start + other * y - torque * _bend(y)) / (other + torque * math.expm1(-y))
        if not y - step < y:
            break
        y -= step
    return rise * y, rise * rise * (start * y + other * y * y / 2 - torque * _bulge(y))


def _bend(y: float) -> float:
    """y - 1 + exp(-y)."""
    if y < 0.5:
        return sum(y * y * (-y) ** k / math.factorial(k + 2) for k in range(14))
    return y + math.expm1(-y)


def _bulge(y: float) -> float:
    """y^2/2 - y + 1 - exp(-y)."""
    if y < 0.5:
        return sum(y * y * y * (-y) ** k / math.factorial(k + 3) for k in range(14))
    return y * (y / 2 - 1) - math.expm1(-y)


def brake_torque_for_time(
    inertia: float, speed: float, time: float, other_torque: float, delay: float, rise_time: float, rise: str
) -> float:
    """Torque a brake needs to stop a body in a given time.

        M = (J w_0 + M_o t) / s,   s = integral of the share of the torque from the command to t
        linear: s = (t - t_d)^2/(2 t_r) up to the end of the rise, t - t_d - t_r/2 after it

    Args:
        inertia: J, everything that turns, on the shaft of the brake [kg*m^2].
        speed: w_0, when the command is given [rad/s].
        time: t, wanted from command to rest [s].
        other_torque: M_o, constant, positive in the direction of motion [N*m].
        delay: t_d [s].
        rise_time: t_r; 0 for a brake that closes at once [s].
        rise: `linear` or `exponential`.

    Returns:
        M; 0 where the body stops in time by itself, infinite where the time is over before the brake acts [N*m].

    **Range** as `brake_stop`.
    **Error** exact for that model.
    **Source** derived: angular momentum.

    Raises:
        ValueError: for another rise.
    """
    _check(rise)
    momentum = inertia * speed + other_torque * time
    if momentum <= 0:
        return 0.0
    acting = time - delay
    if acting <= 0:
        return math.inf
    y = acting / rise_time if rise_time > 0 else math.inf
    if math.isinf(y):
        share = 1.0
    elif rise == EXPONENTIAL:
        share = _bend(y) / y
    else:
        share = y / 2 if y <= 1 else 1 - 1 / (2 * y)
    return momentum / acting / share


def uniform_stop_time(angle: float, speed: float) -> float:
    """Time of a uniform stop over an angle: the allowed brake angle of a slewing crane.

        t = 2 beta / w

    Args:
        angle: beta [rad].
        speed: w, at the start of braking [rad/s].

    Returns:
        t [s].

    **Range** uniform deceleration.
    **Error** exact.
    **Source** design of slewing cranes on a fixed column, course notes: t = 60 beta/(pi n).
    """
    return 2 * angle / speed


def brake_reserve(torque: float, static_torque: float) -> float:
    """Reserve of a brake over the torque it has to hold.

        k = M / M_st

    Args:
        torque: M, of the closed brake [N*m].
        static_torque: M_st, of the load on the shaft of the brake, less the losses that help [N*m].

    Returns:
        k; infinite where nothing has to be held [1].

    **Range** M_st >= 0; the value asked for depends on duty group and country and is an input of the check.
    **Error** exact.
    **Source** definition.
    """
    return torque / static_torque if static_torque > 0 else math.inf


def stop_heat(inertia: float, speed: float, other_torque: float, angle: float) -> float:
    """Heat a brake takes up in one stop.

        E = J w_0^2/2 + M_o phi

    Args:
        inertia: J, everything that turns, on the shaft of the brake [kg*m^2].
        speed: w_0, when the command is given [rad/s].
        other_torque: M_o, constant, positive in the direction of motion [N*m].
        angle: phi, from the command to rest, of `brake_stop` [rad].

    Returns:
        E [J].

    **Range** all of the braking torque is friction in the brake; losses elsewhere belong into M_o.
    **Error** exact for that model.
    **Source** derived: energy balance of the stop.
    """
    return inertia * speed**2 / 2 + other_torque * angle
