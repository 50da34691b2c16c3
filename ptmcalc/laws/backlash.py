"""Clearance of gears and couplings, and the blow when a motor runs through it.

Source of the clearances: N. Yu. Dorokhov, "Dynamics of hoisting and conveying machines", lecture notes, Kramatorsk
2007 (the chapter on backlash); the blow is the two-mass model of `two_mass.takeup` on shafts.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.laws.two_mass import takeup

FloatArray = NDArray[np.float64]

CLASS_FACTORS = {2: 50.0, 3: 80.0, 4: 130.0}
"""a of `new_clearance` by accuracy class of the old standard, clearance in micrometres for a distance in mm."""


def new_clearance(centre_distance: float, accuracy_class: int) -> float:
    """Least side clearance of new spur gears.

        c_n = a A^(1/3)      c_n in micrometres, A in millimetres, a = 50, 80, 130 for class 2, 3, 4

    Args:
        centre_distance: A [m].
        accuracy_class: 2, 3 or 4 of the old standard, not a modern grade.

    Returns:
        c_n, along the pitch circle [m].

    **Range** new spur gears of classes 2 to 4.
    **Error** none bound: empirical, and read from the three factors alone; at A = 250 mm it gives 0.315, 0.504 and
    0.819 mm, a generous value for gears of today. A measured clearance is better.
    **Source** lecture notes Kramatorsk 2007, where only A and a are left; the power 1/3 is recovered, not confirmed:
    with it a is 100, 160 and 260 times the tolerance unit 0.5 A^(1/3) of the old standard.

    Raises:
        ValueError: for another class.
    """
    if accuracy_class not in CLASS_FACTORS:
        raise ValueError(f"an accuracy class is one of {sorted(CLASS_FACTORS)}")
    return 1e-6 * CLASS_FACTORS[accuracy_class] * math.cbrt(1e3 * centre_distance)


def wear_share(thickness_loss: float, module: float) -> float:
    """Wear of a tooth as a share of its thickness.

        w = s / (pi m_n/2)

    Args:
        thickness_loss: s, wear of a tooth along the pitch circle [m].
        module: m_n [m].

    Returns:
        w; usual limits are 0.15 to 0.25 for gearboxes and gear couplings, 0.40 for open gears [1].

    **Range** teeth as thick as the gaps when new.
    **Error** exact for that tooth.
    **Source** tooth thickness pi m_n/2 on the pitch circle; limits from the lecture notes Kramatorsk 2007.
    """
    return thickness_loss / (math.pi * module / 2)


def worn_clearance(clearance: float, wear: float, module: float, both_gears: bool) -> float:
    """Side clearance of worn gears.

        c = c_n + w (pi m_n/2)      twice the second term where the teeth of both gears are worn

    Args:
        clearance: c_n, when new [m].
        wear: w, share of the tooth thickness of `wear_share` [1].
        module: m_n [m].
        both_gears: whether the teeth of both gears have lost that share.

    Returns:
        c, along the pitch circle [m].

    **Range** wear of the flanks that carry the load.
    **Error** exact for that wear.
    **Source** derived: the gap grows by what the teeth lose.
    """
    return clearance + (2 if both_gears else 1) * wear * math.pi * module / 2


def clearance_angle(clearance: float, pitch_radius: float, pressure_angle: float = 0.0) -> float:
    """Angle a shaft turns through a side clearance.

        Delta = c / (r_p cos(alpha))

    Args:
        clearance: c, along the pitch circle (then alpha = 0) or normal to the flanks [m].
        pitch_radius: r_p, of the gear on this shaft [m].
        pressure_angle: alpha, 0 for a clearance along the pitch circle [rad].

    Returns:
        Delta [rad].

    **Range** spur gears; c small against r_p.
    **Error** exact to first order in c/r_p.
    **Source** definition of the angle; normal clearance is the circumferential one times cos(alpha).
    """
    return clearance / (pitch_radius * math.cos(pressure_angle))


def clearance_on_motor_shaft(angles: FloatArray, ratios: FloatArray) -> float:
    """Angle the motor shaft turns through the clearances of all stages.

        Delta = sum Delta_i u_1i

    Args:
        angles: Delta_i, of each stage on one of its shafts, shape (n,) [rad].
        ratios: u_1i, motor speed over speed of that shaft, shape (n,) [1].

    Returns:
        Delta [rad].

    **Range** all gaps open to the same side: the most the motor can be free.
    **Error** exact.
    **Source** kinematics of the train.
    """
    return float(np.sum(np.asarray(angles, float) * np.asarray(ratios, float)))


def gap_closing(torque: float, gap: float, inertia: float, no_load_speed: float = math.inf) -> tuple[float, float]:
    """Speed and time at which a motor that starts from rest has run through a gap.

        omega_c = (2 M Delta/J_1)^(1/2),   t_c = (2 J_1 Delta/M)^(1/2)

    A motor that reaches its no-load speed before goes on at that speed: t_c = Delta/omega_0 + J_1 omega_0/(2 M).

    Args:
        torque: M, of the motor, constant [N*m].
        gap: Delta, on the shaft of the motor [rad].
        inertia: J_1, in front of the gap [kg*m^2].
        no_load_speed: omega_0, or infinity for none [rad/s].

    Returns:
        (omega_c [rad/s], t_c [s]).

    **Range** constant torque from rest at the open end of the gap, M > 0.
    **Error** exact for that model; the torque of a real motor falls towards its no-load speed.
    **Source** derived: uniform acceleration.
    """
    closing = math.sqrt(2 * torque / inertia * gap)
    if closing <= no_load_speed:
        return closing, math.sqrt(2 * inertia / torque * gap)
    return no_load_speed, gap / no_load_speed + inertia * no_load_speed / (2 * torque)


def backlash_number(torque: float, gap: float, stiffness: float, motor_inertia: float, load_inertia: float) -> float:
    """How much a gap adds to the peak torque of a start: the number that decides whether it matters.

        Pi = (2 C Delta/M) (J_1 + J_2)/J_2

    Args:
        torque: M, of the motor, constant [N*m].
        gap: Delta, on the shaft of the motor [rad].
        stiffness: C, behind the gap [N*m/rad].
        motor_inertia: J_1, in front of the gap [kg*m^2].
        load_inertia: J_2, behind it, on the same shaft [kg*m^2].

    Returns:
        Pi; below 0.1 the gap adds less than 2.5 % to the peak, above 1 or with torques that change sign simulate [1].

    **Range** as `gap_closing` without a no-load speed.
    **Error** exact for the undamped two-mass train without static load.
    **Source** derived: `two_mass.takeup` with no static load.
    """
    return 2 * stiffness * gap / torque * (motor_inertia / load_inertia + 1)


def backlash_peak_ratio(number: ArrayLike) -> FloatArray:
    """Peak torque of a start through a gap over the peak without the gap.

        (1 + (1 + Pi)^(1/2)) / 2

    Args:
        number: Pi of `backlash_number` [1].

    Returns:
        ratio [1].

    **Range** as `backlash_number`; with a static torque behind the gap it is an upper bound.
    **Error** exact without static load.
    **Source** derived: `two_mass.takeup` with no static load.
    """
    return np.asarray((1 + np.sqrt(1 + np.asarray(number, float))) / 2)


def backlash_peak_torque(
    torque: float,
    gap: float,
    stiffness: float,
    motor_inertia: float,
    load_inertia: float,
    static_torque: float,
    no_load_speed: float = math.inf,
) -> float:
    """Peak torque of the shaft behind a gap when a motor starts through it.

        as `two_mass.takeup`:  m_1, M, K, P, Q, v_0  =  J_1, J_2, C, M, M_s, omega_c of `gap_closing`

    Args:
        torque: M, of the motor, constant [N*m].
        gap: Delta, on the shaft of the motor [rad].
        stiffness: C, behind the gap [N*m/rad].
        motor_inertia: J_1, in front of the gap [kg*m^2].
        load_inertia: J_2, behind it, on the same shaft [kg*m^2].
        static_torque: M_s, that holds the load until the shaft brings as much [N*m].
        no_load_speed: omega_0, the most the motor reaches in the gap, or infinity [rad/s].

    Returns:
        peak torque; of the motor against the held load where it never moves [N*m].

    **Range** first contact, undamped, constant torque; after a rebound or a torque that changes sign simulate.
    **Error** exact for that model; damping as in `two_mass.takeup`.
    **Source** derived: energy and phase plane of the two-mass train.
    """
    speed, _ = gap_closing(torque, gap, motor_inertia, no_load_speed)
    return takeup(motor_inertia, load_inertia, stiffness, torque, static_torque, speed).peak_force


def impact_loss(inertia_one: float, inertia_two: float, speed: float, restitution: float) -> float:
    """Energy two rigid bodies lose when one strikes the other.

        dE = J_1 J_2/(J_1 + J_2) (1 - e^2) omega^2/2

    Args:
        inertia_one: J_1 [kg*m^2].
        inertia_two: J_2, on the same shaft [kg*m^2].
        speed: omega, of one relative to the other before the impact [rad/s].
        restitution: e, relative speed after over before: 0 plastic, 1 elastic [1].

    Returns:
        dE [J].

    **Range** impact short against every vibration of the train.
    **Error** exact for that model.
    **Source** I. Newton: law of restitution; momentum balance.
    """
    reduced = inertia_one * (inertia_two / (inertia_one + inertia_two))
    return reduced * (1 - restitution) * (1 + restitution) * speed**2 / 2
