"""Two masses on one spring: a drive that takes up the slack of a rope or a shaft and pulls a load along.

Written for a hoist: drive mass m_1 (at the hook, in the direction of the power), load M of weight Q, stiffness K, all
brought to the hook. Read torque for force, moment of inertia for mass and angle for path for a shaft.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


def two_mass_frequency(stiffness: float, mass_one: float, mass_two: float) -> float:
    """Natural frequency of two free masses on a spring.

        w = (K (1/m_1 + 1/m_2))^(1/2)

    Args:
        stiffness: K [N/m].
        mass_one: m_1 [kg].
        mass_two: m_2 [kg].

    Returns:
        w, of the relative motion [rad/s].

    **Range** both masses move; one that is held counts as infinite.
    **Error** exact; the rigid motion is left out analytically, so no ratio of the masses is too large.
    **Source** derived: equation of the relative motion, reduced mass m_1 m_2/(m_1 + m_2).
    """
    return math.sqrt(stiffness / mass_one + stiffness / mass_two)


@dataclass(frozen=True, slots=True)
class Takeup:
    """How a slack rope comes tight: speed of the drive as the load leaves the ground, peak of the force, when the load
    leaves (or the force peaks, if it never does), and whether it is lifted at all."""

    lift_off_speed: float
    peak_force: float
    time: float
    lifted: bool


def takeup(
    drive_mass: float, load_mass: float, stiffness: float, drive_force: float, weight: float, speed: float
) -> Takeup:
    """Peak force when a drive runs the slack out of a rope and lifts a load off the ground.

        v_1^2 = v_0^2 + Q (2 P - Q)/(K m_1)                                  lift-off at F = Q
        F_max = F_eq + ((F_eq - Q)^2 + K mu v_1^2)^(1/2)
        F_eq = Q + (P - Q) M/(m_1 + M),   mu = m_1 M/(m_1 + M)
        stall, v_1^2 < 0 or v_1 = 0 < Q:  F_max = P + (P^2 + K m_1 v_0^2)^(1/2)

    Args:
        drive_mass: m_1 [kg].
        load_mass: M [kg].
        stiffness: K [N/m].
        drive_force: P, of the motor, constant [N].
        weight: Q, that holds the load until the rope brings as much [N].
        speed: v_0, of the drive as the rope comes tight [m/s].

    Returns:
        lift-off speed, 0 if stalled [m/s], peak force [N], time of lift-off or of the peak if stalled [s], lifted [1].

    **Range** constant drive force, no damping, P >= 0; until the rope goes slack again.
    **Error** exact for that model; damping lowers the dynamic part, after lift-off and for P >= Q by a quarter (impact)
    to a half (step of force) of its logarithmic decrement.
    **Source** derived: energy until lift-off, phase plane of the relative motion after it.
    """
    tension = speed * math.sqrt(stiffness * drive_mass)  # a force: what the speed alone can stretch
    left = tension**2 + weight * (2 * drive_force - weight)
    period = math.sqrt(drive_mass / stiffness)  # over 2 pi
    if left < 0 or (left == 0 and weight > 0):
        peak = drive_force + math.hypot(drive_force, tension)
        return Takeup(0.0, peak, period * math.atan2(tension, -drive_force), False)
    kept = math.sqrt(left)
    share = load_mass / (drive_mass + load_mass)
    shift = (drive_force - weight) * share
    peak = weight + shift + math.hypot(shift, kept * math.sqrt(share))
    # the angle between both states in the phase plane, its sine freed of the difference kept - tension
    sine = weight * (tension + drive_force * ((2 * drive_force - weight) / (kept + tension))) if weight > 0 else 0.0
    angle = math.atan2(sine, tension * kept - drive_force * (weight - drive_force))
    return Takeup(kept / math.sqrt(stiffness * drive_mass), peak, period * angle, True)


def hanging_start_force(drive_force: float, weight: float, drive_mass: float, load_mass: float) -> float:
    """Extreme rope force when a drive force steps onto a load that already hangs.

        F = Q + 2 (P - Q) M/(m_1 + M)

    Args:
        drive_force: P, after the step [N].
        weight: Q, the force before it [N].
        drive_mass: m_1 [kg].
        load_mass: M [kg].

    Returns:
        F, the largest for P > Q, the smallest for P < Q [N].

    **Range** a step of constant force, no damping; the rope taut, F >= 0.
    **Error** exact for that model; a force that rises in longer than a period has no factor 2.
    **Source** derived: step response of the relative motion.
    """
    return weight + 2 * (drive_force - weight) * (load_mass / (drive_mass + load_mass))


def speed_step_force(speed: float, stiffness: float, mass: float, weight: float) -> float:
    """Largest rope force when the end of a rope under a load changes its speed at once.

        F = Q + v (K M)^(1/2)

    Args:
        speed: v, change of the hook's speed: a drive of unlimited mass catching the load at v, or stopping it [m/s].
        stiffness: K, of the rope at the hook [N/m].
        mass: M [kg].
        weight: Q [N].

    Returns:
        F [N].

    **Range** lift-off by a speed-controlled drive, v the speed at lift-off; an instantaneous stop while lowering.
    **Error** exact for that model; an upper bound for a drive that stops from that speed without speeding up first.
    **Source** derived: `takeup` for m_1 -> infinity; F/Q = 1 + v/(g delta)^(1/2), delta the static stretch.
    """
    return weight + speed * math.sqrt(stiffness * mass)


def lowering_brake_force(
    brake_force: ArrayLike,
    weight: ArrayLike,
    delay: ArrayLike,
    drive_mass: float,
    load_mass: float,
    stiffness: float,
) -> FloatArray:
    """Largest rope force when a brake catches a load being lowered, some time after the motor is off.

        F = Q + M/(m_1 + M) (P_b - Q + (Q^2 + P_b^2 - 2 Q P_b cos(w t_d))^(1/2))

    Without motor and brake the load turns the drive and swings; the brake meets it in that swing. w is that of
    `two_mass_frequency`.

    Args:
        brake_force: P_b, constant [N].
        weight: Q, the force in steady lowering [N].
        delay: t_d, between motor off and brake on [s].
        drive_mass: m_1 [kg].
        load_mass: M [kg].
        stiffness: K [N/m].

    Returns:
        F while the drive moves; at t_d = 0 Q + 2 (P_b - Q) M/(m_1 + M), at worst Q + 2 P_b M/(m_1 + M) [N].

    **Range** the drive still moves at the peak (it stops later than half a period after the brake is on) and the rope
    stays taut, 2 M/(m_1 + M) < 1; the swing after the stop comes on its own.
    **Error** exact for that model, no damping.
    **Source** derived: phase plane of the relative motion in the delay and under the brake.
    """
    brake, load = np.asarray(brake_force, float), np.asarray(weight, float)
    half = two_mass_frequency(stiffness, drive_mass, load_mass) * np.asarray(delay, float) / 2
    swing = np.hypot(brake - load, 2 * np.sqrt(brake) * np.sqrt(load) * np.sin(half))
    return np.asarray(load + load_mass / (drive_mass + load_mass) * (brake - load + swing))


def hoisting_stop_force(
    speed: float, brake_force: float, weight: float, drive_mass: float, load_mass: float, stiffness: float
) -> float:
    """Smallest rope force when a brake stops a load being hoisted.

        F = Q - min(v (K M)^(1/2), 2 (P_b + Q) M/(m_1 + M))

    Args:
        speed: v, of the hook [m/s].
        brake_force: P_b, constant, without delay [N].
        weight: Q [N].
        drive_mass: m_1 [kg].
        load_mass: M [kg].
        stiffness: K [N/m].

    Returns:
        F; below 0 the rope goes slack and the load falls back into it: simulate [N].

    **Range** motor off and brake on at the same time; a brake that then holds, P_b above Q + v (K M)^(1/2).
    **Error** a lower bound while it is above 0, attained by an instantaneous stop and by one longer than half a period.
    **Source** derived: a falling drive speed turns into at most v (K M)^(1/2); step response of the relative motion.
    """
    step = 2 * (brake_force + weight) * (load_mass / (drive_mass + load_mass))
    return weight - min(speed * math.sqrt(stiffness * load_mass), step)
