"""A slewing drive's cycle: what its torques are worth, and what they make of the turning crane."""

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
Numbers = Sequence[float] | FloatArray
"""One number for each phase of a cycle."""


def fatigue_torque(shares: Numbers, torques: Numbers, exponent: float = 3.0) -> float:
    """Torque that, always there, would tire the gear as much as the phases of a cycle.

        M = (sum lambda_i |M_i|^m)^(1/m)

    Args:
        shares: lambda_i, of the time of the cycle, shape (n,) [1].
        torques: M_i, in each phase, shape (n,) [N*m].
        exponent: m, slope of fatigue over the load: 3 for the contact of teeth, 6 to 9 for their bending [1].

    Returns:
        M [N*m].

    **Range** one slope of fatigue; shares that add up to 1, or to what rounding made of it.
    **Error** exact for that law of damage.
    **Source** Palmgren 1924, Miner 1945; design of slewing cranes on a fixed column, course notes (3.5.2.11), whose
    print has lost the third power and its root.
    """
    sizes = np.abs(np.asarray(torques, float))
    largest = float(np.max(sizes, initial=0.0))
    if largest == 0:
        return 0.0
    damage = np.sum(np.asarray(shares, float) * (sizes / largest) ** exponent)
    return largest * float(damage ** (1 / exponent))


def uniform_start_time(inertia: ArrayLike, speed: ArrayLike, torque: ArrayLike, resistance: ArrayLike) -> FloatArray:
    """Time in which a constant torque brings a rigid crane to its speed.

        t = J w/(M - M_r)

    Args:
        inertia: J, of all that is accelerated, about the slewing axis [kg*m^2].
        speed: w [rad/s].
        torque: M, of the motor, carried to the slewing axis [N*m].
        resistance: M_r, of friction and wind [N*m].

    Returns:
        t; infinite for M <= M_r, a motor that stalls [s].

    **Range** a rigid crane, constant torques.
    **Error** exact for that model; the load swings, see `momentum_share`.
    **Source** change of angular momentum.
    """
    free = np.asarray(torque, float) - np.asarray(resistance)
    momentum = np.asarray(inertia, float) * np.asarray(speed)
    return np.asarray(np.where(free > 0, momentum / np.where(free > 0, free, 1.0), math.inf))


def torque_for_start(inertia: ArrayLike, speed: ArrayLike, time: ArrayLike, resistance: ArrayLike) -> FloatArray:
    """Constant torque that brings a rigid crane to its speed in a time.

        M = J w/t + M_r

    Args:
        inertia: J, of all that is accelerated, about the slewing axis [kg*m^2].
        speed: w [rad/s].
        time: t [s].
        resistance: M_r, of friction and wind [N*m].

    Returns:
        M, about the slewing axis [N*m].

    **Range** as `uniform_start_time`.
    **Error** exact for that model.
    **Source** change of angular momentum.
    """
    return np.asarray(np.asarray(inertia, float) * np.asarray(speed) / np.asarray(time) + np.asarray(resistance))


def geared_stop(
    inertia: float,
    rotor: float,
    efficiency: float,
    reverse_efficiency: float,
    speed: float,
    motor_brake: float,
    crane_brake: float,
    resistance: float,
    delay: float,
    rise_time: float,
) -> tuple[float, float]:
    """Time and angle in which a brake with delay and rise stops a rigid crane through its gear.

        J w' = -M_c(t) - R - T,   T = (M_b(t) + J_r w') k,   k = 1/eta_r for T > 0, the load drives, else eta

    w' is a broken line over the torque of the brake, so w(t) is a row of parabolas.

    Args:
        inertia: J, of the crane without its drive, about the slewing axis [kg*m^2].
        rotor: J_r = J_1 u^2, of the drive, brought to the slewing axis by the ratio alone [kg*m^2].
        efficiency: eta, from motor to crane [1].
        reverse_efficiency: eta_r, from crane to motor; 0 or less where self-locking [1].
        speed: w_0, when the command is given [rad/s].
        motor_brake: M_b, of the closed brake on the motor shaft, times the ratio [N*m].
        crane_brake: M_c, of a closed brake on the slewing axis [N*m].
        resistance: R, friction less the wind that drives; below 0 the wind wins [N*m].
        delay: from the command until the brake acts; the motor is off [s].
        rise_time: from then to full torque, linear rise [s].

    Returns:
        (time since the command [s], angle [rad]); both infinite where the brake does not stop it. A self-locking gear
        that jams (`gearing.jams`) ends at once.

    **Range** a rigid crane; friction that stays as long as it turns.
    **Error** exact for that model.
    **Source** derived: power balance of the mesh (`gearing`), phase by phase.
    """

    def turns(share: float) -> float:
        """Above 0 where the load drives."""
        return motor_brake * share + rotor * (-crane_brake * share - resistance) / inertia

    def acceleration(share: float, *, back: bool) -> float:
        free, held = -crane_brake * share - resistance, motor_brake * share
        if not back:
            return (free - held * efficiency) / (inertia + rotor * efficiency)
        if reverse_efficiency == 0:
            return -held / rotor if rotor > 0 else -math.inf
        behind = inertia * reverse_efficiency + rotor
        return (free * reverse_efficiency - held) / behind if behind > 0 else -math.inf

    shares = [0.0, 1.0]
    if turns(0.0) * turns(1.0) < 0:
        shares.insert(1, turns(0.0) / (turns(0.0) - turns(1.0)))
    spans = [(delay, 0.0, 0.0), *((rise_time * (b - a), a, b) for a, b in pairwise(shares)), (math.inf, 1.0, 1.0)]
    time = angle = 0.0
    for span, first, last in spans:
        if span <= 0:
            continue
        back = turns((first + last) / 2) > 0
        a0, a1 = acceleration(first, back=back), acceleration(last, back=back)
        if a0 == -math.inf:
            return time, angle
        jerk = (a1 - a0) / span
        stop = _first_standstill(speed, a0, jerk)
        if stop <= span:
            angle += speed * stop + a0 * stop**2 / 2 + jerk * stop**3 / 6
            return (time + stop, angle) if math.isfinite(stop) else (math.inf, math.inf)
        angle += speed * span + a0 * span**2 / 2 + jerk * span**3 / 6
        speed += a0 * span + jerk * span**2 / 2
        time += span
    return math.inf, math.inf


def _first_standstill(speed: float, acceleration: float, jerk: float) -> float:
    """First time at which speed + acceleration t + jerk t^2/2 is 0, infinite where there is none [s]."""
    if speed <= 0:
        return 0.0
    below = acceleration**2 - 2 * jerk * speed
    if below < 0:
        return math.inf
    root = -acceleration + math.sqrt(below)
    return 2 * speed / root if root > 0 else math.inf


def swing_reach(
    inertia: float, mass: float, radius: float, rope: float, speed: float, gravity: float
) -> tuple[float, float]:
    """How far out and how inclined a load can hang that a jib has brought to its speed, however it was driven.

        2 g L (1 - cos(theta)) <= w^2 (rho^2 + J/m),   rho <= R + L sin(theta)

    In a frame that turns with w the work of the drive, at most w times the angular momentum it gives, cancels: what is
    left of the energy is that of the jib, J w^2/2, and w^2 rho^2/2 of the load.

    Args:
        inertia: J, of the jib with its drive, without the load, about the slewing axis [kg*m^2].
        mass: m, of the load [kg].
        radius: R, from the axis to the head of the jib [m].
        rope: L, from there to the load [m].
        speed: w, that the jib reaches and does not exceed [rad/s].
        gravity: g [m/s^2].

    Returns:
        (rho, largest distance of the load from the axis [m], theta, largest angle of the rope [rad]); theta is pi and
        rho R + L where the bound allows any angle.

    **Range** a start from rest under a drive that never pulls back, then steady slewing; a rope that stays taut.
    **Error** a bound, derived: never exceeded in that model.
    **Source** derived: Jacobi's integral of the load in the turning frame.
    """
    reach = radius
    for _ in range(200):
        share = speed**2 * (reach**2 + inertia / mass) / (2 * gravity * rope)
        if share >= 1:
            return radius + rope, math.pi
        angle = math.acos(1 - share)
        further = radius + rope * math.sin(angle)
        if further <= reach * (1 + 1e-12):
            return further * (1 + 1e-9), angle * (1 + 1e-9) + 1e-9
        reach = further
    return radius + rope, math.pi


def momentum_range(inertia: float, mass: float, reach: float, speed: float) -> tuple[float, float]:
    """Angular momentum of a swinging load about the slewing axis as its jib comes to the speed.

        h = m rho w (rho -+ (rho^2 + J/m)^(1/2))

    Args:
        inertia: J, of the jib with its drive, without the load, about the slewing axis [kg*m^2].
        mass: m, of the load [kg].
        reach: rho, its largest distance from the axis, of `swing_reach` [m].
        speed: w, of the jib [rad/s].

    Returns:
        (smallest, largest) [N*m*s].

    **Range** as `swing_reach`.
    **Error** a bound, derived.
    **Source** derived: the load's speed in the turning frame is at most w (rho^2 + J/m)^(1/2).
    """
    root = math.sqrt(reach**2 + inertia / mass)
    least = -speed * inertia * reach / (reach + root)  # rho (rho - root) without its cancellation
    return least, mass * reach * speed * (reach + root)
