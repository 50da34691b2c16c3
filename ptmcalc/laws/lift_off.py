"""Lifting a load off the ground and letting it go: factors on the weight, and the numbers that decide what matters.

The motion itself is in `two_mass` (slack taken up, hanging start, brake while lowering, stop). Everything is at the
hook: drive mass m_1, load M, weight Q = M g, rope stiffness K.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


def speed_source_factor(speed: ArrayLike, deflection: float, gravity: float) -> FloatArray:
    """Dynamic factor of a load lifted off the ground, or stopped, by a drive that keeps its speed.

        psi = 1 + v/(g delta)^(1/2),   delta = Q/K

    Args:
        speed: v, of the hook at lift-off; a drive that is not held to it gains speed while the rope tightens [m/s].
        deflection: delta, static stretch of rope and structure under the load [m].
        gravity: g [m/s^2].

    Returns:
        psi, largest rope force over the weight [1].

    **Range** drive of unlimited mass, rigid or massless structure, no damping.
    **Error** exact for that model.
    **Source** derived: `two_mass.speed_step_force` over Q.
    """
    return np.asarray(1 + np.asarray(speed, float) / (math.sqrt(gravity) * math.sqrt(deflection)))


def elasticity_number(
    lift_off_speed: float, drive_force: float, weight: float, drive_mass: float, load_mass: float, stiffness: float
) -> float:
    """How much the elastic rope adds to the weight: the number that decides whether it matters.

        max( v_1 (K M)^(1/2)/Q,  2 |P/Q - 1| M/(m_1 + M) )

    Args:
        lift_off_speed: v_1 of `two_mass.takeup`, not the speed before the rope tightens [m/s].
        drive_force: P [N].
        weight: Q [N].
        drive_mass: m_1 [kg].
        load_mass: M [kg].
        stiffness: K [N/m].

    Returns:
        number; below 0.05 the load is lifted as if by hand, above 0.3 simulate [1].

    **Range** as `two_mass.takeup`.
    **Error** the first is the dynamic part for a drive of unlimited mass, the second that of a step of force.
    **Source** derived: `two_mass.speed_step_force` and `two_mass.hanging_start_force`.
    """
    step = 2 * abs(drive_force / weight - 1) * (load_mass / (drive_mass + load_mass))
    return max(lift_off_speed * math.sqrt(stiffness) * math.sqrt(load_mass) / weight, step)


def drive_mass_number(
    drive_force: float, weight: float, drive_mass: float, load_mass: float, stiffness: float, speed: float
) -> float:
    """How far a drive of finite mass departs from one that keeps its speed.

        M/m_1 max(1, (2 P/Q - 1)/Pi^2),   Pi = v_0 (K M)^(1/2)/Q

    Args:
        drive_force: P [N].
        weight: Q [N].
        drive_mass: m_1 [kg].
        load_mass: M [kg].
        stiffness: K [N/m].
        speed: v_0, of the hook as the rope comes tight [m/s].

    Returns:
        number; below 0.05 the speed source does, above 1 simulate [1].

    **Range** as `two_mass.takeup`, a drive that is not held to its speed.
    **Error** v_1^2/v_0^2 - 1 = (M/m_1) (2 P/Q - 1)/Pi^2 is exact.
    **Source** derived: energy of the drive until lift-off.
    """
    tension = speed * math.sqrt(stiffness) * math.sqrt(load_mass)
    gain = (2 * drive_force - weight) / tension * (weight / tension) if tension > 0 else math.inf
    return load_mass / drive_mass * max(1.0, gain)


def motor_slope_number(slope: float, stiffness: float, drive_mass: float, load_mass: float) -> float:
    """Damping ratio that the falling torque curve of a motor gives the swing of the load.

        h/(2 (K mu)^(1/2)),   mu = m_1 M/(m_1 + M)

    Args:
        slope: h, fall of the drive force over the speed of the hook [N*s/m].
        stiffness: K [N/m].
        drive_mass: m_1 [kg].
        load_mass: M [kg].

    Returns:
        number; below 0.05 a constant force does, above 0.3 simulate [1].

    **Range** a straight piece of the motor's curve.
    **Error** an engineering measure, not a bound: the damper acts on the drive alone.
    **Source** derived: damping ratio of the relative motion.
    """
    return slope / 2 / (math.sqrt(stiffness) * math.sqrt(load_mass)) * math.sqrt(1 + load_mass / drive_mass)


def structure_number(rope: float, structure: float, structure_mass: float, load_mass: float) -> tuple[float, float]:
    """How far the structure under the drum takes part: by its compliance and by its mass.

        K/K_b,   m_b/M

    Args:
        rope: K, stiffness at the hook [N/m].
        structure: K_b [N/m].
        structure_mass: m_b, that moves with the drum [kg].
        load_mass: M [kg].

    Returns:
        (K/K_b, m_b/M); a structure stands still where the first is below 0.1, springs in series do where the second
        is; the first alone misses forces in the structure up to 1.8 times those in the rope [1].

    **Range** a structure of one mode.
    **Error** an engineering measure.
    **Source** derived; both are needed, as a heavy structure swings by itself once the load hangs.
    """
    return rope / structure, structure_mass / load_mass


def held_swing_force(force: float, weight: float, speed: float, stiffness: float, mass: float) -> float:
    """Largest rope force of a load that goes on swinging under a drum that now stands.

        F_max = Q + ((F - Q)^2 + K M v^2)^(1/2)

    Args:
        force: F, in the rope as the drum stops [N].
        weight: Q [N].
        speed: v, of the load then, up or down [m/s].
        stiffness: K [N/m].
        mass: M [kg].

    Returns:
        F_max; 2 Q - F_max is the smallest, below 0 the rope goes slack [N].

    **Range** a brake that holds, no damping, a taut rope.
    **Error** exact for that model.
    **Source** derived: energy about the equilibrium.
    """
    return weight + math.hypot(force - weight, speed * math.sqrt(stiffness) * math.sqrt(mass))


def release_factor(dropped_share: ArrayLike, quickness: float) -> FloatArray:
    """Dynamic factor of a part of the load that is let go.

        phi_3 = 1 - (dm/m) (1 + beta_3)

    Args:
        dropped_share: dm/m, part of the load that drops [1].
        quickness: beta_3, 0.5 for a slow release (grab), 1 for a quick one (magnet) [1].

    Returns:
        phi_3, smallest force over the weight before; below 0 the structure is pulled upward [1].

    **Range** 0 <= dm/m <= 1.
    **Error** for beta_3 = 1 exact for one undamped mode whose force cannot be one-sided; a rope goes slack at 0.
    **Source** EN 13001-2 and ISO 8686-1, load factor phi_3.
    """
    return np.asarray(1 - np.asarray(dropped_share, float) * (1 + quickness))
