"""The lifting carriage of a stacker crane: what its guide rollers bear and resist, and what its ropes pull.

Source of the formulas: N. Yu. Dorokhov, "Dynamics of hoisting and conveying machines", lecture notes, Kramatorsk 2007
(stacker cranes), whose equations are lost and recovered from their legends.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

_HALVINGS = 80


def roller_reaction(moment: ArrayLike, distance: ArrayLike, factor: ArrayLike = 1.0) -> FloatArray:
    """Reaction of the upper, and of the lower, guide rollers in one plane.

        R = psi |Q a + G b|/h

    The legend of the source says nothing of inertia; R grows with all of it.

    Args:
        moment: Q a + G b, of load and carriage about the line of the ropes [N*m].
        distance: h, from the upper to the lower rollers [m].
        factor: psi = 1 + a/g, of the acceleration upwards on the weights [1].

    Returns:
        R [N].

    **Range** vertical ropes in one line; rollers that touch without play.
    **Error** exact for that model.
    **Source** balance of moments; lecture notes Kramatorsk 2007 (recovered).
    """
    return np.asarray(np.abs(np.asarray(moment, float)) * np.asarray(factor, float) / distance)


def roller_coefficient(
    pin_friction: ArrayLike, axle_diameter: ArrayLike, lever_arm: ArrayLike, diameter: ArrayLike
) -> FloatArray:
    """Resistance of a guide roller over the force it bears.

        w = (mu d + 2 f)/D

    Args:
        pin_friction: mu, of its bearing; rolling bearings 0.015, plain bearings 0.08 to 0.1 [1].
        axle_diameter: d [m].
        lever_arm: f, of rolling, a length: old books print it in cm or mm [m].
        diameter: D, of the roller [m].

    Returns:
        w [1].

    **Range** rollers that roll.
    **Error** that of its coefficients.
    **Source** lecture notes Kramatorsk 2007 (recovered); usual in handbooks of lifting machines.
    """
    return np.asarray((np.asarray(pin_friction, float) * axle_diameter + 2 * np.asarray(lever_arm, float)) / diameter)


def guide_resistance(reaction: ArrayLike, coefficient: ArrayLike) -> FloatArray:
    """Resistance of a carriage whose upper and lower rollers both bear a reaction.

        W = 2 R w

    Args:
        reaction: R, of the upper or of the lower rollers [N].
        coefficient: w, of a roller or a shoe [1].

    Returns:
        W [N].

    **Range** as `roller_reaction`.
    **Error** exact for that model.
    **Source** lecture notes Kramatorsk 2007 (recovered).
    """
    return np.asarray(2 * np.asarray(reaction, float) * coefficient)


def jamming_ratio(moment: ArrayLike, weight: ArrayLike, distance: ArrayLike, coefficient: ArrayLike) -> FloatArray:
    """Resistance of the guide over the weight that has to overcome it on the way down.

        W/(Q + G) = 2 w |Q a + G b|/(h (Q + G))

    At 1 the carriage no longer comes down by its weight, as a drawer that is pulled at one side: its rope goes slack.
    Acceleration does not count: it is in both.

    Args:
        moment: Q a + G b, of load and carriage about the line of the ropes [N*m].
        weight: Q + G [N].
        distance: h, from the upper to the lower rollers [m].
        coefficient: w, of a roller or a shoe [1].

    Returns:
        Ratio, below 1 for a carriage that sinks [1].

    **Range** as `roller_reaction`.
    **Error** exact for that model.
    **Source** derived: balance of the carriage.
    """
    return np.asarray(2 * np.abs(np.asarray(moment, float)) * coefficient / (np.asarray(distance, float) * weight))


def rope_pull(
    weight: ArrayLike, factor: ArrayLike, resistance: ArrayLike, falls: int, efficiency: ArrayLike, hauling: bool
) -> FloatArray:
    """Pull of a rope at the drum from a carriage that goes up or down.

        up:   S = (psi (Q + G) + W)/(m eta_r)
        down: S = (psi (Q + G) - W) eta_l/m, not below 0: the rope goes slack

    Args:
        weight: Q + G, of load, carriage and cab [N].
        factor: psi = 1 + a/g, of the acceleration upwards on the weights [1].
        resistance: W, of the guide, with the same acceleration [N].
        falls: m, parts of rope the carriage hangs on.
        efficiency: up eta_r, how the tackle hauls; down eta_l, how it lowers [1].
        hauling: whether the carriage goes up.

    Returns:
        S, of one part of rope at the drum [N].

    **Range** vertical ropes without weight.
    **Error** exact for that model; the combination of the source that asks for this force leaves dynamic loads out, and
    its formula has them in: they are taken.
    **Source** lecture notes Kramatorsk 2007 (recovered); balance of the carriage.
    """
    carried, resists = np.asarray(weight, float) * factor, np.asarray(resistance, float)
    if hauling:
        return np.asarray((carried + resists) / (falls * np.asarray(efficiency, float)))
    return np.asarray(np.maximum(carried - resists, 0.0) * efficiency / falls)


def sheave_of_tackle(falls: int, efficiency: float) -> float:
    """Efficiency of the equal sheaves of a tackle that is known as a whole.

        (1 - eta^m)/(m (1 - eta)) = eta_r

    Args:
        falls: m, parts of one rope that carry the load.
        efficiency: eta_r, of the tackle while it hauls [1].

    Returns:
        eta [1]; that of the tackle where it has no sheave (m = 1), or less than its first fall alone would leave.

    **Range** as `laws.reeving.tackle_efficiency`.
    **Error** rounding.
    **Source** `laws.reeving.tackle_efficiency`, whose sum of powers rises with eta.
    """
    if falls == 1 or efficiency * falls <= 1:
        return efficiency
    low, high = 0.0, 1.0
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        total = sum(middle**k for k in range(falls))
        low, high = (middle, high) if total < falls * efficiency else (low, middle)
    return (low + high) / 2
