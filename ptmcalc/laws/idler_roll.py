"""Rolls of belt idlers: speed, load and life of their bearings."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

_MILLION = 1e6  # revolutions of the basic rating life of ISO 281


def roll_speed(speed: ArrayLike, diameter: ArrayLike) -> FloatArray:
    """Rotational speed of a roll.

        omega = 2 v/d,   n = v/(pi d)

    Args:
        speed: v, of the belt [m/s].
        diameter: d, of the roll [m].

    Returns:
        omega [rad/s].

    **Range** a roll without slip.
    **Error** exact.
    **Source** kinematics of rolling.
    """
    return np.asarray(2 * np.asarray(speed, float) / np.asarray(diameter, float))


def roll_load(
    share: ArrayLike, span_weight: ArrayLike, dynamic_factor: ArrayLike, curve_force: ArrayLike, own_weight: ArrayLike
) -> FloatArray:
    """Load of the most loaded roll of an idler set.

        F = phi (k_d w a + S a/R) + G

    Args:
        share: phi, part of the set load on that roll [1].
        span_weight: w a, weight of belt and load on one idler pitch [N].
        dynamic_factor: k_d, of belt and load that pass the idler [1].
        curve_force: S a/R, of the belt tension in a convex curve; 0 on a straight section [N].
        own_weight: G, of the rotating parts of the roll [N].

    Returns:
        F [N].

    **Range** idlers in line; phi = 0.65 to 0.7 on the middle roll of three, 1 on a single roll.
    **Error** that of phi and k_d.
    **Source** equilibrium of the belt on one idler pitch; phi and k_d as in handbooks of idler manufacturers [R].
    """
    passing = np.asarray(dynamic_factor, float) * np.asarray(span_weight, float) + np.asarray(curve_force, float)
    return np.asarray(np.asarray(share, float) * passing + np.asarray(own_weight, float))


def bearing_life(rating: ArrayLike, load: ArrayLike, speed: ArrayLike) -> FloatArray:
    """Basic rating life of the two ball bearings of a roll, each with half of its load.

        L_10h = 1e6/n (C/P)^3,   P = F/2,   n = omega/(2 pi)

    Args:
        rating: C, dynamic load rating of one bearing [N].
        load: F, load of the roll [N].
        speed: omega, of the roll [rad/s].

    Returns:
        L_10h, reached by 90 % of such bearings [s].

    **Range** deep groove ball bearings under radial load; clean and lubricated. Dirt shortens the life.
    **Error** a statistical life; the two bearings of a roll together reach less.
    **Source** ISO 281:2007, basic rating life with the exponent 3 of ball bearings.
    """
    per_bearing, turns = np.asarray(load, float) / 2, np.asarray(speed, float) / (2 * np.pi)
    return np.asarray(_MILLION / turns * (np.asarray(rating, float) / per_bearing) ** 3)
