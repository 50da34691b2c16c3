"""The effect of the drum's layer map on the load."""

from collections.abc import Mapping

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.contract.effect import Criterion, Effect
from ptmcalc.machines.hoist.machine.model import filled
from ptmcalc.machines.hoist.machine.spec import Hoist, WindUp
from ptmcalc.machines.hoist.winding.climb import climb, radius_map, rope, sudden_ratio
from ptmcalc.numerics.hauling import largest_possible

LAYER_MAP_THRESHOLD = 0.02
"""Dynamic stress of a sudden layer change relative to the mean stress [1] from which on the layer map is simulated. An
engineering choice. Below it one layer change adds at most 2 %; crossovers can add up to more, which the error bar
includes."""
CHANGED = ("winding_displacement_max", "winding_stress_max", "winding_stress_ratio")
"""Loads that the layer map changes."""


def layer_map_criterion(spec: Hoist, scene: WindUp) -> Criterion:
    """Ratio of dynamic to mean stress for a sudden layer change.

        w dR k n/(m g)

    **Range** any multilayer drum.
    **Error** an upper bound for one layer change; crossovers on the layer may add up to more.
    **Source** `laws.winding.sudden_ratio`; the threshold of 2 % is an engineering choice.
    """
    value = sudden_ratio(spec, scene)
    meaning = "dynamic / mean stress of a sudden layer change"
    return Criterion("ωΔr k/(m g)", value, LAYER_MAP_THRESHOLD, meaning, "laws.winding")


def layer_map_bound(spec: Hoist, scene: WindUp, loads: Mapping[str, Estimate]) -> Mapping[str, Interval]:
    """From zero to the sum of the layer change and all crossovers of the layer, each at the worst phase of the
    oscillation.

        |C_j| <= |C_(j-1)| exp(-zeta theta) + S^(1/2) |e_p - e_p'| ...   (`numerics.hauling.largest_possible`)

    **Range** a load at rest before the layer change; unbounded if the drum winds the whole rope.
    **Error** a bound; without damping it grows with the number of crossovers.
    **Source** derived in `numerics.hauling`.
    """
    try:
        strain = largest_possible(radius_map(spec, scene), climb(spec, scene).drum_speed, rope(spec, scene))
    except NumericsError:
        return dict.fromkeys(CHANGED, ANYTHING)
    case = climb(spec, scene)
    stress = strain * filled(spec.rope.modulus)
    most = dict(zip(CHANGED, (strain * case.length, stress, stress / case.mean_stress), strict=True))
    return {
        name: Interval(min(-loads[name].low, 0.0), max(most[name] - loads[name].high, 0.0))
        for name in CHANGED
        if name in loads
    }


LAYER_MAP: Effect[Hoist, WindUp] = Effect(
    name="layer_map",
    title="layer change and crossovers of the rope",
    scenes=frozenset({WindUp}),
    criterion=layer_map_criterion,
    bound=layer_map_bound,
)
