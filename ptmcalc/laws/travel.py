"""Resistance to travel on rails: friction that always opposes the motion, slope and wind that do not ask for it.

Forces are positive against the positive direction of travel: a resistance below 0 drives the crane on.
"""

import math
from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

BEARING_FRICTION: Mapping[str, float] = MappingProxyType({"rolling": 0.015, "plain": 0.08})
"""Usual friction in the bearings of a wheel [1], quoted from handbooks; to be confirmed."""
AIR_DENSITY = 1.25
"""Density of air in EN 13001-2 and ISO 4302 [kg/m^3]."""


def rolling_coefficient(
    bearing_friction: float, axle_diameter: float, rolling_arm: float, wheel_diameter: float, flange_factor: float
) -> float:
    """Resistance of a wheel over its load.

        w = k (mu d + 2 f)/D

    Args:
        bearing_friction: mu, 0.015 in rolling bearings, 0.08 to 0.1 in plain ones [1].
        axle_diameter: d, where the bearing rubs: mean diameter of a rolling one [m].
        rolling_arm: f, of the rolling friction, 0.0003 to 0.0008 m on rails; a length, not a coefficient [m].
        wheel_diameter: D, of the tread [m].
        flange_factor: k, friction of flanges and hubs, 1 for guide rollers, 1.2 to 2.5 for flanges [1].

    Returns:
        w [1].

    **Range** steel wheels on rails; the flange factor is a handbook's allowance for skewing.
    **Error** none bound: every factor is empirical; EN 15011 leaves it to the maker.
    **Source** moments about the axle; handbooks of crane drives.
    """
    return flange_factor * (bearing_friction * axle_diameter + 2 * rolling_arm) / wheel_diameter


def wind_pressure(speed: ArrayLike, density: float = AIR_DENSITY) -> FloatArray:
    """Dynamic pressure of wind.

        q = rho v^2/2

    Args:
        speed: v, of the wind at the height of the crane [m/s].
        density: rho, of the air [kg/m^3].

    Returns:
        q [N/m^2].

    **Range** the mean over the time the standard names (3 s in EN 13001-2: 20 m/s in service give 250 Pa).
    **Error** exact.
    **Source** Bernoulli; EN 13001-2, ISO 4302.
    """
    return density * np.asarray(speed, float) ** 2 / 2


def wind_force(pressure: ArrayLike, area: float, shape: float) -> FloatArray:
    """Force of wind on a body.

        F = q c A

    Args:
        pressure: q, of `wind_pressure` [N/m^2].
        area: A, across the wind [m^2].
        shape: c, force coefficient, with shielding: 1.2 to 2 [1].

    Returns:
        F [N].

    **Range** a stiff body; a vibration excited by gusts is left out.
    **Error** exact for the coefficient given.
    **Source** EN 13001-2, ISO 4302.
    """
    return np.asarray(pressure, float) * (shape * area)


def travel_resistance(
    speed: ArrayLike, weight: float, coefficient: float, slope: float, wind_force: float
) -> FloatArray:
    """Resistance to travel at a speed.

        W = w G cos(alpha) sgn(v) + G sin(alpha) + F_w

    Args:
        speed: v, or the direction of the motion to come; friction at rest is whatever keeps it there [m/s].
        weight: G, of all that travels [N].
        coefficient: w, of `rolling_coefficient` [1].
        slope: alpha, of the rail, positive uphill in the positive direction [rad].
        wind_force: F_w, positive against the positive direction [N].

    Returns:
        W, positive against the positive direction [N].

    **Range** friction that does not grow with the speed.
    **Error** exact for its coefficients.
    **Source** equilibrium along the rail.
    """
    friction = coefficient * weight * math.cos(slope)
    return np.asarray(friction * np.sign(np.asarray(speed, float)) + (weight * math.sin(slope) + wind_force))


def holding_force(weight: float, coefficient: float, slope: float, wind_force: float) -> float:
    """Force that keeps a crane at rest against slope and wind, with the help of its own friction.

        F = |G sin(alpha) + F_w| - w G cos(alpha), at least 0

    Args:
        weight: G, of all that rests on the wheels [N].
        coefficient: w, without the flange factor: a crane that does not skew has none [1].
        slope: alpha, of the rail [rad].
        wind_force: F_w, along the rail, either sign as `slope` [N].

    Returns:
        F, of brakes or storm locks at the rail [N].

    **Range** at rest; every wheel that is not braked turns.
    **Error** exact for its coefficients.
    **Source** equilibrium along the rail.
    """
    return max(abs(weight * math.sin(slope) + wind_force) - coefficient * weight * math.cos(slope), 0.0)
