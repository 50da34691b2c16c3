"""A hoist in even motion: torques at drum and motor, power, the brake that holds, and what a weak brake lets go.

Torques of the load are positive when it pulls the drum down. The gearbox's efficiency goes by the direction of the
power (`gearing.input_torque`); a self-locking gear has a negative one backwards: its motor must push the load down.
"""

import math

from ptmcalc.laws import gearing


def drum_torque(pull: float, ropes: int, radius: float) -> float:
    """Torque of the ropes on a drum.

        M = n S R

    Args:
        pull: S, of one rope at the drum [N].
        ropes: n, parts of rope that run onto the drum.
        radius: R, of the centre of the rope [m].

    Returns:
        M [N*m].

    **Range** ropes that pull alike.
    **Error** exact; the drum's bearings are in the gearbox's efficiency.
    **Source** moments about the drum's axis.
    """
    return ropes * pull * radius


def hoisting_torque(drum_torque: float, ratio: float, efficiency: float) -> float:
    """Torque of the motor that hoists evenly.

        M = M_d/(u eta)

    Args:
        drum_torque: M_d [N*m].
        ratio: u, motor speed over drum speed [1].
        efficiency: eta, of the gearbox from motor to drum [1].

    Returns:
        M [N*m].

    **Range** power flows from the motor to the load.
    **Error** exact for a constant efficiency.
    **Source** power balance of the gearbox.
    """
    return float(gearing.input_torque(drum_torque, 1.0, ratio, efficiency, 1.0))


def lowering_torque(drum_torque: float, ratio: float, reverse_efficiency: float) -> float:
    """Torque of motor or brake on the motor shaft that lowers evenly.

        M = M_d eta_r/u

    Args:
        drum_torque: M_d, of the load lowered [N*m].
        ratio: u, motor speed over drum speed [1].
        reverse_efficiency: eta_r, of the gearbox from drum to motor [1].

    Returns:
        M, that holds the load back; negative where the motor must push it down [N*m].

    **Range** a load that drives, M_d >= 0.
    **Error** exact for a constant efficiency.
    **Source** power balance of the gearbox; eta_r of `gearing.reverse_efficiency`.
    """
    return float(gearing.input_torque(drum_torque, -1.0, ratio, 1.0, reverse_efficiency))


def sinking_acceleration(
    load_torque: float,
    brake_torque: float,
    motor_inertia: float,
    load_inertia: float,
    ratio: float,
    efficiency: float,
    reverse_efficiency: float,
) -> float:
    """Angular acceleration, of the motor shaft, at which a load sinks through a brake too weak to hold it.

        e = (M_L eta_r/u - M_b)/(J_1 + J_2 eta_r/u^2) while the load drives

    Args:
        load_torque: M_L, of the load on the drum shaft [N*m].
        brake_torque: M_b, on the motor shaft [N*m].
        motor_inertia: J_1, on the motor shaft [kg*m^2].
        load_inertia: J_2, drum and load on the drum shaft [kg*m^2].
        ratio: u, motor speed over drum speed [1].
        efficiency: eta, of the gearbox from motor to drum [1].
        reverse_efficiency: eta_r, from drum to motor [1].

    Returns:
        e, in the direction of lowering; 0 where the brake holds [rad/s^2].

    **Range** a rigid train; a brake whose torque does not fade.
    **Error** exact for that model.
    **Source** derived: `gearing.motor_acceleration` with the brake against the motion.
    """
    held = lowering_torque(load_torque, ratio, reverse_efficiency)
    if brake_torque >= held:
        return 0.0
    return -float(
        gearing.motor_acceleration(
            brake_torque, -1.0, load_torque, motor_inertia, load_inertia, ratio, efficiency, reverse_efficiency
        )
    )


def speed_after_drop(acceleration: float, way: float) -> float:
    """Speed of what sinks evenly faster, from rest.

        v = sqrt(2 a s)

    Args:
        acceleration: a [m/s^2].
        way: s [m].

    Returns:
        v [m/s].

    **Range** a >= 0.
    **Error** exact.
    **Source** kinematics.
    """
    return math.sqrt(2 * acceleration) * math.sqrt(way)


def hoist_start_time(
    mean_torque: float,
    load_torque: float,
    motor_inertia: float,
    load_inertia: float,
    motor_speed: float,
    ratio: float,
    efficiency: float,
    reverse_efficiency: float,
    hoisting: bool = True,
) -> float:
    """Time in which a mean torque brings a hanging load from rest to full speed.

        up:    t = w (J_1 + J_2/(u^2 eta))/(M - M_L/(u eta))
        down:  t = w (J_1 + J_2 eta'/u^2)/(M + M_L eta'/u),   eta' = eta_r or 1/eta by the total torque in the mesh

    Args:
        mean_torque: M, of all motors, in the direction of the motion [N*m].
        load_torque: M_L, of the load on the drum shaft [N*m].
        motor_inertia: J_1, on the motor shaft [kg*m^2].
        load_inertia: J_2, drum and load on the drum shaft [kg*m^2].
        motor_speed: w [rad/s].
        ratio: u, motor speed over drum speed [1].
        efficiency: eta, of the gearbox from motor to drum [1].
        reverse_efficiency: eta_r, from drum to motor [1].
        hoisting: whether the load goes up.

    Returns:
        t; infinite where the motor does not move the load [s].

    **Range** a rigid train, rope and all.
    **Error** exact for that model and a constant torque.
    **Source** derived: `gearing.motor_acceleration`; lecture notes Kramatorsk 2007 for the mean torque.
    """
    way = 1.0 if hoisting else -1.0
    acceleration = way * float(
        gearing.motor_acceleration(
            way * mean_torque, way, load_torque, motor_inertia, load_inertia, ratio, efficiency, reverse_efficiency
        )
    )
    return motor_speed / acceleration if acceleration > 0 else math.inf


def load_frequency(stiffness: float, mass: float, structure_stiffness: float, structure_mass: float) -> float:
    """Lowest natural frequency of a load on its rope under a structure that gives way, the drum held.

        det[ K_b + K - m_b w^2,  -K;  -K,  K - M w^2 ] = 0,   (K/M)^(1/2) under a rigid one

    Args:
        stiffness: K, of the rope at the hook [N/m].
        mass: M, on the hook [kg].
        structure_stiffness: K_b; infinite for a rigid one [N/m].
        structure_mass: m_b, that moves with it [kg].

    Returns:
        w [rad/s].

    **Range** a rope without mass, a structure of one mode; m_b = 0 puts both springs in series.
    **Error** exact for that model.
    **Source** derived: the smaller root, written without a difference.
    """
    ratio = stiffness / structure_stiffness
    own = ratio * structure_mass
    width = math.sqrt((own - mass) ** 2 + ratio * mass * (2 * own + ratio * mass + 2 * mass))
    return math.sqrt(2 * stiffness / (own + (1 + ratio) * mass + width))
