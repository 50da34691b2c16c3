"""What resists even travel: the wheels, wind and slope."""

import math

from ptmcalc.laws import travel
from ptmcalc.machines.crane.travelling.machine import model
from ptmcalc.machines.crane.travelling.machine.model import filled
from ptmcalc.machines.crane.travelling.machine.scenes import TravelScene
from ptmcalc.machines.crane.travelling.machine.spec import Travelling


def coefficient(spec: Travelling) -> float:
    """Resistance of the wheels over the weight [1]."""
    given = spec.rolling
    if given.coefficient is not None:
        return given.coefficient
    return travel.rolling_coefficient(
        filled(given.bearing_friction),
        filled(given.axle_diameter),
        filled(given.lever_arm),
        spec.wheels.diameter,
        filled(given.flange_factor),
    )


def slope_angle(spec: Travelling) -> float:
    """Of the rails [rad]."""
    return math.atan(spec.rail.slope)


def rolling(spec: Travelling, scene: TravelScene) -> float:
    """Of the wheels, with what a scene has on the hook [N]."""
    return float(travel.travel_resistance(1.0, model.weight(spec, scene), coefficient(spec), 0.0, 0.0))


def even(spec: Travelling, scene: TravelScene, pressure: float | None, *, against: bool = True) -> float:
    """All that resists even travel against the wind and up the slope, or with the wind and down [N]."""
    wind = model.wind_force(spec, pressure) + model.wind_on_load(spec, scene, pressure)
    sign = 1 if against else -1
    weight = model.weight(spec, scene)
    return float(travel.travel_resistance(1.0, weight, coefficient(spec), sign * slope_angle(spec), sign * wind))
