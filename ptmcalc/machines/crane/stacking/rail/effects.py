"""Effects of an uneven rail."""

from collections.abc import Mapping

from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.contract.effect import AnyEffect, Criterion, Effect
from ptmcalc.machines.crane.stacking.machine.rack import RackStacker
from ptmcalc.machines.crane.stacking.machine.scenes import RailScene
from ptmcalc.machines.crane.stacking.rail.base import roll_of
from ptmcalc.machines.crane.stacking.rail.rolling import wave_share
from ptmcalc.spec.scene import Scene

Loads = Mapping[str, Estimate]
Offsets = Mapping[str, Interval]
UNEVEN, JUMPING = "aisle_rail", "wheel_lift"
ROLLS: frozenset[type[Scene]] = frozenset({RailScene})
UNEVEN_THRESHOLD = 0.02
"""Change of the wheel loads by the rail, relative to gravity [1]. An engineering choice: below 2 % the wheel loads
change by less than 2 %. Every run simulates the rail, so no error depends on the value. It affects the list of
sensitive effects."""
JUMPING_THRESHOLD = 1.0
"""Share of its load that a wheel loses on the rail [1]. Derived: at 1 the wheel load is zero; below, one undamped mode
stays on the rail and the neglect of lift-off has no error. A larger value would keep a wheel on the rail by a pull."""


def _anything(loads: Loads) -> Offsets:
    return dict.fromkeys(loads, ANYTHING)


def uneven_criterion(spec: RackStacker, scene: RailScene) -> Criterion:
    """Change of the wheel loads by the rail, relative to gravity.

        max( (pi/2)^2 v^2/(g r) max u,  T (h/2) (2 pi v/lambda)^2/g )

    **Range** steps and gaps small relative to the wheel; uniform waves.
    **Error** exact for one undamped mode.
    **Source** `laws.rail`.
    """
    roll = roll_of(spec, scene)
    answers = [max(pair) for pair in roll.pulses(roll.frequency)]
    value = max([wave_share(roll)] + [roll.acceleration / roll.gravity * one for one in answers])
    return Criterion("a_w/g", value, UNEVEN_THRESHOLD, "wheel load added by the rail", "laws.rail")


def uneven_bound(spec: RackStacker, scene: RailScene, loads: Loads) -> Offsets:
    """No bound: an uneven rail cannot be computed without this effect.

    **Range** every load of a rail.
    **Error** unbounded.
    **Source** no run neglects this effect.
    """
    return _anything(loads)


def jump_criterion(spec: RackStacker, scene: RailScene) -> Criterion:
    """Relative unloading of a wheel on the rail: at 1 the wheel leaves the rail.

        max( (pi/2)^2 v^2/(g r) max(-u),  T (h/2) (2 pi v/lambda)^2/g )

    **Range** as `uneven_criterion`.
    **Error** exact for one undamped mode.
    **Source** `laws.rail`.
    """
    roll = roll_of(spec, scene)
    answers = [less for _, less in roll.pulses(roll.frequency)]
    value = max([wave_share(roll)] + [roll.acceleration / roll.gravity * one for one in answers])
    return Criterion("a_l/g", value, JUMPING_THRESHOLD, "wheel load reduction by the rail", "laws.rail")


def jump_bound(spec: RackStacker, scene: RailScene, loads: Loads) -> Offsets:
    """Zero while the wheels stay on the rail; a wheel that leaves the rail lands with an impact.

    **Range** every load of a rail.
    **Error** exact while the minimum wheel load is above 0; otherwise unbounded, and a contact force is not below 0.
    **Source** a wheel transmits no tension.
    """
    contact = loads.get("rail_contact")
    if contact is None or contact.low >= 0:
        return {}
    touched = {"phi4", "wheel_force", "combination_force[11.2,5]"}
    return {name: ANYTHING for name in loads if name in touched}


EFFECTS_OF_THE_RAIL: tuple[AnyEffect, ...] = (
    Effect(UNEVEN, "rail steps, gaps and waviness", ROLLS, uneven_criterion, uneven_bound),
    Effect(JUMPING, "wheel lift-off from the rail", ROLLS, jump_criterion, jump_bound),
)
