"""The effect of an uneven rail."""

import math
from collections.abc import Mapping

from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.contract.effect import Criterion, Effect
from ptmcalc.laws import rail
from ptmcalc.machines.crane.travelling.machine import model
from ptmcalc.machines.crane.travelling.machine.scenes import RailStep
from ptmcalc.machines.crane.travelling.machine.spec import Travelling

Loads = Mapping[str, Estimate]
Offsets = Mapping[str, Interval]

RAIL = "rail_unevenness"
RAIL_THRESHOLD = 0.02
"""Change of the wheel loads by a step or gap, relative to gravity [1]. An engineering choice: below 2 % the wheel loads
change by less than 2 %. Every run simulates the rail, so no error depends on the value. It affects the list of
sensitive effects."""


def rail_criterion(spec: Travelling, scene: RailStep) -> Criterion:
    """Change of the wheel loads at a step or gap of the rail, relative to gravity.

        (pi/2)^2 v^2/(g r) max(more, less)   of the extremes on a step or gap and after it

    **Range** steps and gaps small relative to the wheel; 0 for a smooth rail.
    **Error** exact for one undamped mode: the oscillation may vanish after a step although it does not vanish on the
    step.
    **Source** `laws.rail.step_extremes`, `gap_extremes`; EN 13001-2 considers only the oscillation after the step.
    """
    radius, speed = model.radius(spec), scene.speed_share * spec.speed
    frequency = 2 * math.pi * model.filled(spec.rail.frequency)
    answers = [0.0]
    if spec.rail.step:
        number = rail.step_number(frequency, speed, radius, spec.rail.step)
        answers += rail.step_extremes(number)
    if spec.rail.gap:
        number = rail.gap_number(frequency, speed, spec.rail.gap)
        answers += rail.gap_extremes(number)
    value = rail.rail_acceleration(speed, radius) / spec.gravity * max(answers)
    return Criterion("a_w/g", value, RAIL_THRESHOLD, "wheel load added by the rail", "laws.rail")


def rail_bound(spec: Travelling, scene: RailStep, loads: Loads) -> Offsets:
    """No bound: a step cannot be computed without this effect.

    **Range** phi4 and the contact of the wheels.
    **Error** unbounded.
    **Source** no run neglects this effect.
    """
    return dict.fromkeys(loads, ANYTHING)


RAIL_EFFECT: Effect[Travelling, RailStep] = Effect(
    RAIL, "rail steps and gaps", frozenset({RailStep}), rail_criterion, rail_bound
)
