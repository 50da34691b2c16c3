"""Speed at the end of a step of m v' + Z v + R sgn v = g, with dry friction."""

import math

from ptmcalc.base.errors import NumericsError

_STEEPEST = 100.0
"""Time constants of growth in one step, where a drive pulls harder the faster it turns."""


def velocity(
    old: float,
    mass: float,
    against: float,
    friction: tuple[float, float],
    forcing: tuple[float, float],
    step: float,
) -> float:
    """Speed at the end of a step of m v' + Z v + R sgn v = g, with R and g linear over the step.

    Without mass it is that of balance at the end.

    Raises:
        NumericsError: NUM101 when nothing but mass could keep the speed finite, and there is none, or so little that
            the speed would grow beyond all measure within the step.
    """
    if mass <= 0:
        rest = abs(forcing[1]) - friction[1]
        if rest <= 0:
            return 0.0
        if against <= 0:
            raise NumericsError("NUM101", "a drum without mass is driven by more than can hold it at any speed")
        return math.copysign(rest / against, forcing[1])
    if step == 0 or (not old and friction[1] and abs(forcing[1]) <= friction[1]):
        return old
    way = math.copysign(1.0, old or forcing[1])
    begins, ends = forcing[0] - way * friction[0], forcing[1] - way * friction[1]
    if not old and any(friction) and way * begins < 0:  # it breaks loose within the step
        begins = 0.0
    constants = against / mass * step
    if constants < -_STEEPEST:
        raise NumericsError("NUM101", "a drive's force rises with speed far too steeply for its drum and the step")
    decay, early, late = _exponential(constants)
    new = decay * old + (early * begins + late * ends) * step / mass
    if new * way >= 0 or not friction[1]:
        return new
    stops = old / (old - new)  # there friction holds it, or it turns back
    there = [first + stops * (last - first) for first, last in (friction, forcing)]
    return velocity(0.0, mass, against, (there[0], friction[1]), (there[1], forcing[1]), (1 - stops) * step)


def _exponential(x: float) -> tuple[float, float, float]:
    """exp(-x), and by what the forcing at the start and the end of a step counts in m v/dt; a drive whose force rises
    with speed makes x negative."""
    grown = 1 - x / 2 * (1 - x / 3 * (1 - x / 4)) if abs(x) < 1e-3 else -math.expm1(-x) / x
    late = 1 / 2 - x / 6 * (1 - x / 4 * (1 - x / 5)) if abs(x) < 1e-3 else (1 - grown) / x
    return math.exp(-x), grown - late, late
