"""Inertia of a drive reduced to the rim of its drum."""


def reduced_drive_mass(
    motor_side_inertia: float, ratio: float, efficiency: float, drum_inertia: float, drum_radius: float
) -> float:
    """Mass at the rim that stands for motors, couplings and drum while the motors drive.

        m = J i^2 eta / R^2 + J_drum / R^2

    From the motor's balance (M - J e) i eta / R = F: the efficiency enters with the same power as in the rim
    force M i eta / R, so it is never put in one of them only. The drum sits behind the gear.

    Args:
        motor_side_inertia: J, rotors and couplings of all motors on the motor shaft [kg*m^2].
        ratio: i, motor speed over drum speed [1].
        efficiency: eta, of the gear from motor to drum [1].
        drum_inertia: J_drum, drum on its own shaft [kg*m^2].
        drum_radius: R, drum radius [m].

    Returns:
        m [kg].

    **Range** power flows from motor to drum; when the load drives the motor, eta divides instead.
    **Error** exact for a gear of constant efficiency.
    **Source** lecture notes Kramatorsk 2007, reduction of inertia in power mode.
    """
    return (motor_side_inertia * ratio**2 * efficiency + drum_inertia) / drum_radius**2
