"""Torque through a lossy gear: the efficiency goes by the direction of the power through the mesh at that instant.

Signs: speeds and accelerations are those of the motor shaft; a torque is positive in the direction of positive speed
on the motor side and against it on the load side, so that a load being lifted has positive torque and positive speed,
one being lowered positive torque and negative speed. At standstill give the direction of the motion to come.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


def reverse_efficiency(efficiency: float) -> float:
    """Efficiency of a gear driven from its slow side, by equal loss of torque.

        eta_r = 2 - 1/eta

    Args:
        efficiency: eta, driven from the fast side [1].

    Returns:
        eta_r; negative below eta = 1/2: a self-locking gear, whose motor must push the load down [1].

    **Range** a worm or a gear whose loss is friction under the same tooth force.
    **Error** none bound: the loss torque may differ between both directions; a measured value is better.
    **Source** loss torque T_in - T_out/u the same in both directions; usual in handbooks of worm gears.
    """
    return 2 - 1 / efficiency


def input_torque(
    output_torque: ArrayLike, speed: ArrayLike, ratio: float, efficiency: float, reverse_efficiency: float
) -> FloatArray:
    """Torque on the fast side of a gear for the whole torque on its slow side.

        T_in = T_out/(u eta)      where T_out omega >= 0, the motor drives
        T_in = T_out eta_r/u      where T_out omega < 0, the load drives

    Args:
        output_torque: T_out, static and inertia torque together [N*m].
        speed: omega, of either shaft, or the direction of the motion to come [rad/s].
        ratio: u, fast speed over slow speed [1].
        efficiency: eta, driven from the fast side [1].
        reverse_efficiency: eta_r, driven from the slow side; negative where self-locking [1].

    Returns:
        T_in; for eta_r < 0 in the direction of the motion while the load drives [N*m].

    **Range** constant efficiencies; at standstill under load friction may hold any torque between both values.
    **Error** exact for constant efficiencies; those of a lightly loaded gear are lower.
    **Source** derived: power balance of the mesh.
    """
    torque = np.asarray(output_torque, float)
    drives = torque * np.sign(speed) >= 0
    return np.asarray(np.where(drives, torque / efficiency, torque * reverse_efficiency) / ratio)


def motor_torque(
    acceleration: ArrayLike,
    speed: ArrayLike,
    load_torque: ArrayLike,
    motor_inertia: float,
    load_inertia: float,
    ratio: float,
    efficiency: float,
    reverse_efficiency: float,
) -> FloatArray:
    """Motor torque for an acceleration, the efficiency by the total torque through the mesh.

        M = J_1 e + T_in(T_out),   T_out = M_L + J_2 e/u,   T_in of `input_torque`

    Args:
        acceleration: e, of the motor shaft [rad/s^2].
        speed: omega, of the motor shaft, or the direction of the motion to come [rad/s].
        load_torque: M_L, static torque on the slow shaft, positive against positive speed [N*m].
        motor_inertia: J_1, on the motor shaft [kg*m^2].
        load_inertia: J_2, on the slow shaft [kg*m^2].
        ratio: u, motor speed over speed of the slow shaft [1].
        efficiency: eta, driven from the motor [1].
        reverse_efficiency: eta_r, driven from the load [1].

    Returns:
        M, positive in the direction of positive speed [N*m].

    **Range** a rigid drive train; constant efficiencies.
    **Error** exact for that model.
    **Source** derived: balance of both shafts with the loss of the mesh.
    """
    accelerations = np.asarray(acceleration, float)
    output = np.asarray(load_torque, float) + load_inertia * accelerations / ratio
    return motor_inertia * accelerations + input_torque(output, speed, ratio, efficiency, reverse_efficiency)


def motor_torque_seed_rule(
    acceleration: ArrayLike,
    speed: ArrayLike,
    load_torque: ArrayLike,
    motor_inertia: float,
    load_inertia: float,
    ratio: float,
    efficiency: float,
    reverse_efficiency: float,
) -> FloatArray:
    """Motor torque for an acceleration by the handbook: the efficiency of each torque by its own sign.

        M = J_1 e + T_in(M_L) + T_in(J_2 e/u)

    Args:
        acceleration: e, of the motor shaft [rad/s^2].
        speed: omega, of the motor shaft, or the direction of the motion to come [rad/s].
        load_torque: M_L, static torque on the slow shaft, positive against positive speed [N*m].
        motor_inertia: J_1, on the motor shaft [kg*m^2].
        load_inertia: J_2, on the slow shaft [kg*m^2].
        ratio: u, motor speed over speed of the slow shaft [1].
        efficiency: eta, driven from the motor [1].
        reverse_efficiency: eta_r, driven from the load [1].

    Returns:
        M, positive in the direction of positive speed [N*m].

    **Range** shown beside `motor_torque`, which is the rule; both agree where load and inertia have one sign
    (hoisting start, braking while lowering) or only one of them acts.
    **Error** (1/eta - eta_r)/u times the smaller of both torques where their signs differ: about 1 % of the motor
    torque in a usual hoist, more as inertia comes near the static load.
    **Source** lecture notes Kramatorsk 2007, reduction of inertia in power mode and in braking.
    """
    accelerations = np.asarray(acceleration, float)
    static = input_torque(load_torque, speed, ratio, efficiency, reverse_efficiency)
    inertia = input_torque(load_inertia * accelerations / ratio, speed, ratio, efficiency, reverse_efficiency)
    return motor_inertia * accelerations + static + inertia


def motor_acceleration(
    torque: ArrayLike,
    speed: ArrayLike,
    load_torque: ArrayLike,
    motor_inertia: float,
    load_inertia: float,
    ratio: float,
    efficiency: float,
    reverse_efficiency: float,
) -> FloatArray:
    """Acceleration of the motor shaft under a motor torque: `motor_torque` solved for it.

        e = (M - M_L/(u eta)) / (J_1 + J_2/(u^2 eta))      where (M J_2 + M_L u J_1) omega >= 0
        e = (M - M_L eta_r/u) / (J_1 + J_2 eta_r/u^2)      elsewhere

    The torque through the mesh has the sign of M J_2 + M_L u J_1, with losses and without.

    Args:
        torque: M, of the motor or a brake on its shaft, positive in the direction of positive speed [N*m].
        speed: omega, of the motor shaft, or the direction of the motion to come [rad/s].
        load_torque: M_L, static torque on the slow shaft, positive against positive speed [N*m].
        motor_inertia: J_1, on the motor shaft [kg*m^2].
        load_inertia: J_2, on the slow shaft [kg*m^2].
        ratio: u, motor speed over speed of the slow shaft [1].
        efficiency: eta, driven from the motor [1].
        reverse_efficiency: eta_r, driven from the load [1].

    Returns:
        e; infinite against the motion where the gear jams (`jams`) [rad/s^2].

    **Range** a rigid drive train in motion; at standstill the answer counts only if it has the direction given.
    **Error** exact for that model.
    **Source** derived: `motor_torque` is monotone in e unless the gear jams.
    """
    motor, load = np.asarray(torque, float), np.asarray(load_torque, float)
    way = np.sign(speed)
    forward = (motor * load_inertia + load * ratio * motor_inertia) * way >= 0
    driven = motor_inertia + load_inertia / ratio**2 / efficiency
    driving = motor_inertia + load_inertia / ratio**2 * reverse_efficiency
    ahead = (motor - load / efficiency / ratio) / driven
    back = (motor - load * reverse_efficiency / ratio) / driving if driving > 0 else np.copysign(np.inf, -way)
    return np.asarray(np.where(forward, ahead, back))


def jams(motor_inertia: float, load_inertia: float, ratio: float, reverse_efficiency: float) -> bool:
    """Whether a gear driven by its load's inertia locks up when it is braked on the motor shaft.

        J_1 <= -eta_r J_2/u^2      with eta_r = 2 - 1/eta:  J_1 <= (1/eta - 2) J_2/u^2

    Args:
        motor_inertia: J_1, on the motor shaft [kg*m^2].
        load_inertia: J_2, on the slow shaft [kg*m^2].
        ratio: u, motor speed over speed of the slow shaft [1].
        reverse_efficiency: eta_r, driven from the load [1].

    Returns:
        True where a brake on the motor shaft that lets the load drive stops the train at once [1].

    **Range** J_1 > 0; it can happen to self-locking gears only, eta_r < 0.
    **Error** exact for a rigid train of constant efficiencies; in truth elasticity bounds the blow: simulate.
    **Source** derived: the inertia of `motor_acceleration` with the load driving is no longer positive.
    """
    return bool(motor_inertia + load_inertia / ratio**2 * reverse_efficiency <= 0)
