"""Grip of driven wheels, wheel by wheel: a mean over the wheels passes where the wheel with the least load slips.

A wheel grips while the force it hands to the rail stays below mu N. Its share of the force is a matter of the drive:
motors of their own push alike whatever their wheel carries. Its load changes with the acceleration (`wheel_loads`).
"""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

ADHESION: Mapping[str, float] = MappingProxyType({"indoor": 0.2, "outdoor": 0.12, "sanded": 0.25})
"""Usual adhesion of wheels on rails [1]: dry indoors, outdoors, with sand; quoted from handbooks, to be confirmed."""


def wheel_grip(
    torque: ArrayLike, radius: float, load: ArrayLike, own_resistance: float, inertia: float, acceleration: float
) -> FloatArray:
    """Force that a driven wheel hands to the rail.

        F = M/r - w N - J a/r^2

    What the wheel's own bearings, its rolling and its inertia take never reaches the rail. With w = 0 the resistance
    of the driven wheels counts as if the rail had to carry it: the usual, careful way (`driven_forces`).

    Args:
        torque: M, on the wheel, behind the gear [N*m].
        radius: r [m].
        load: N, of the wheel [N].
        own_resistance: w, bearings and rolling of this wheel, without its flanges, of `travel.rolling_coefficient` [1].
        inertia: J, of the wheel and what is fixed to it behind the gear [kg*m^2].
        acceleration: a, of the crane [m/s^2].

    Returns:
        F, positive in the direction of a positive torque [N].

    **Range** rolling forwards without slip; braking: negative torque and acceleration.
    **Error** exact for those parts.
    **Source** derived: moments about the axle of the wheel.
    """
    M, N = np.asarray(torque, float), np.asarray(load, float)
    return M / radius - own_resistance * N - inertia * (acceleration / radius) / radius


def driven_forces(mass: float, acceleration: float, resistance: float, shares: FloatArray) -> FloatArray:
    """Forces that the driven wheels hand to the rail for a motion of the crane.

        F_k = s_k (m a + W)

    Args:
        mass: m, of all that travels; with J/r^2 of the wheels that are not driven [kg].
        acceleration: a, below 0 for braking [m/s^2].
        resistance: W, positive against the motion: all of it (careful), or what the driven wheels do not take
            themselves (`wheel_grip`) [N].
        shares: s_k, of the drives' force, that add up to 1, shape (n,) [1].

    Returns:
        F_k, shape (n,), below 0 where they brake [N].

    **Range** no wheel slips; shares of a line shaft through several wheels hang on their radii: the worst is one wheel.
    **Error** exact; with all of W in it too large by s_k times the driven wheels' own resistance.
    **Source** equilibrium along the rail.
    """
    return np.asarray(shares, float) * (mass * acceleration + resistance)


def skid_reserve(friction: float, load: ArrayLike, force: ArrayLike) -> FloatArray:
    """Grip of a wheel over what it needs.

        k = mu N/|F|

    Args:
        friction: mu, adhesion of wheel and rail [1].
        load: N, of the wheel, with what the acceleration takes off; a wheel that lifts off has no grip [N].
        force: F, of `driven_forces` or `wheel_grip` [N].

    Returns:
        k; infinite for a wheel that needs none [1].

    **Range** one direction of slip; lateral forces of skewing take their part of the grip.
    **Error** exact for the adhesion given.
    **Source** Coulomb; reserve 1.2 in handbooks of crane drives.
    """
    N, F = np.broadcast_arrays(np.maximum(np.asarray(load, float), 0.0), np.abs(np.asarray(force, float)))
    needed = F > 0
    return np.where(needed, friction * N / np.where(needed, F, 1.0), np.inf)


def slip_accelerations(
    mass: float,
    resistance: float,
    friction: float,
    shares: FloatArray,
    loads: FloatArray,
    transfers: FloatArray,
) -> FloatArray:
    """Acceleration at which each driven wheel begins to slip; the crane slips at the least of them.

        s_k (m a + W) = mu (N_k + n_k a):   a_k = (mu N_k - s_k W)/(s_k m - mu n_k)

    Args:
        mass: m, of all that travels; with J/r^2 of the wheels that are not driven [kg].
        resistance: W, against the motion; for braking its opposite, since it helps [N].
        friction: mu [1].
        shares: s_k, of the drives' force, above 0, shape (n,) [1].
        loads: N_k, of the wheels without acceleration, shape (n,) [N].
        transfers: n_k, change of the load per acceleration; for braking its opposite, shape (n,) [kg].

    Returns:
        a_k, at least 0, shape (n,): 0 where it slips before the crane moves evenly, infinite where it never does
        [m/s^2].

    **Range** a >= 0: the size of an acceleration or, with the signs told above, of a deceleration.
    **Error** exact; on the safe side by the driven wheels' own resistance where W holds it.
    **Source** derived: force at the rail equal to the grip.
    """
    s, n = np.asarray(shares, float), np.asarray(transfers, float)
    spare = friction * np.asarray(loads, float) - s * resistance
    rise = s * mass - friction * n
    ends = (spare > 0) & (rise > 0)
    return np.where(spare <= 0, 0.0, np.where(ends, spare / np.where(ends, rise, 1.0), np.inf))


def rail_force(
    acceleration: ArrayLike, push: float, rotating_mass: float, friction: float, load: float, transfer: float
) -> FloatArray:
    """Force that the wheel of a motor hands to the rail, gripping or slipping.

        F = P - m a,   not beyond -+ mu N,   N = N_0 + n a, at least 0

    Args:
        acceleration: a, of the crane [m/s^2].
        push: P, of the motor at the rim, below 0 for a brake [N].
        rotating_mass: m, of motor, gear and wheel at the rim [kg].
        friction: mu, at any speed of slip [1].
        load: N_0, of the wheel without acceleration [N].
        transfer: n, change of the load per acceleration [kg].

    Returns:
        F, positive in the direction of travel [N].

    **Range** as `slipping_acceleration`.
    **Error** exact for that friction.
    **Source** derived: inertia of the drive at the rim; Coulomb.
    """
    a = np.asarray(acceleration, float)
    grip = friction * np.maximum(load + transfer * a, 0.0)
    return np.clip(push - rotating_mass * a, -grip, grip)


def slipping_acceleration(
    pushes: FloatArray,
    rotating_masses: FloatArray,
    mass: float,
    resistance: float,
    friction: float,
    loads: FloatArray,
    transfers: FloatArray,
) -> float:
    """Acceleration of a crane whose motors or brakes push as they do, some wheels gripping and some slipping.

        m a + W = sum F_k(a),   F_k of `rail_force`

    Args:
        pushes: P_k, of motors at the rims of their wheels, below 0 for brakes, shape (n,) [N].
        rotating_masses: m_k, of motor, gear and wheel at the rim, shape (n,) [kg].
        mass: m, of all that travels; with J/r^2 of the wheels that are not driven [kg].
        resistance: W, positive against the motion [N].
        friction: mu, at any speed of slip [1].
        loads: N_k, of the driven wheels without acceleration, shape (n,) [N].
        transfers: n_k, change of their loads per acceleration, shape (n,) [kg].

    Returns:
        a; below 0 where the forces do not overcome the resistance [m/s^2].

    **Range** mu times the sum of |n_k| less than the mass moved: the centre of mass lower than the wheel base over mu.
    **Error** exact.
    **Source** derived: the forces less inertia fall in straight pieces as a grows; the piece where they meet is solved.
    """
    P, inertial = np.asarray(pushes, float), np.asarray(rotating_masses, float)
    N, n = np.asarray(loads, float), np.asarray(transfers, float)
    grip, more = friction * N, friction * n
    with np.errstate(divide="ignore", invalid="ignore"):
        corners = np.concatenate([(P - grip) / (inertial + more), (P + grip) / (inertial - more), -N / n])
    corners = np.unique(corners[np.isfinite(corners)])

    def surplus(a: float) -> float:
        grips = friction * np.maximum(N + n * a, 0.0)
        return float(np.sum(np.clip(P - inertial * a, -grips, grips))) - resistance - mass * a

    below = [a for a in corners if surplus(a) > 0]
    above = corners[len(below) :]
    start = below[-1] if below else above[0] - 1 - abs(above[0]) if len(above) else 0.0
    end = above[0] if len(above) else start + 1 + abs(start)
    inside = start + (end - start) / 2
    # the same straight piece everywhere between two corners: its intercept and slope, wheel by wheel
    loaded = N + n * inside > 0
    up = P - inertial * inside > friction * np.maximum(N + n * inside, 0.0)
    down = P - inertial * inside < -friction * np.maximum(N + n * inside, 0.0)
    slips = (up.astype(float) - down) * loaded
    force, slope = np.where(up | down, slips * grip, P), np.where(up | down, slips * more, -inertial)
    return float((np.sum(force) - resistance) / (mass - np.sum(slope)))


def slip_motor_torque(
    acceleration: float, reduced_mass: float, resistance: float, radius: float, ratio: float, efficiency: float
) -> float:
    """Motor torque at which the wheels of a drive begin to slip.

        M = (m_red a + W) r/(u eta)

    Args:
        acceleration: a, the least of `slip_accelerations` [m/s^2].
        reduced_mass: m_red, mass that travels and the drive at the rim, of `inertia.reduced_drive_mass` [kg].
        resistance: W [N].
        radius: r, of the wheel [m].
        ratio: u, motor speed over wheel speed [1].
        efficiency: eta, of the gear [1].

    Returns:
        M, of all motors together [N*m].

    **Range** motors that drive; all push alike.
    **Error** exact for a constant efficiency.
    **Source** equilibrium at the rim.
    """
    return (reduced_mass * acceleration + resistance) * radius / (ratio * efficiency)
