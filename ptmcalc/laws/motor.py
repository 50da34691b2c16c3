"""Motor torque at the start."""


def mean_starting_torque(largest: float, smallest: float) -> float:
    """Mean torque of a stepped (rheostat) or soft start.

        M = (M_max + M_min) / 2

    Args:
        largest: M_max, torque after each switching step [N*m].
        smallest: M_min, torque before each switching step [N*m].

    Returns:
        M [N*m].

    **Range** steps of equal height; for a motor curve take its mean over the speed range.
    **Error** none bound: the mean stands for the real torque history.
    **Source** lecture notes Kramatorsk 2007.
    """
    return (largest + smallest) / 2


def rim_force(torque: float, ratio: float, efficiency: float, drum_radius: float) -> float:
    """Force of a motor torque at the rim of the drum.

        F = M i eta / R

    Args:
        torque: M, of all motors, on the motor shaft [N*m].
        ratio: i, motor speed over drum speed [1].
        efficiency: eta, of the gear from motor to drum [1].
        drum_radius: R, drum radius [m].

    Returns:
        F [N].

    **Range** power flows from motor to drum.
    **Error** exact for a gear of constant efficiency.
    **Source** lecture notes Kramatorsk 2007.
    """
    return torque * ratio * efficiency / drum_radius
