"""The checks of a rope that climbs to its next layer."""

from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, Sense, no_needs
from ptmcalc.contract.limits import key
from ptmcalc.machines.hoist.machine.spec import Hoist, WindUp

WINDING = frozenset({WindUp})


def _speed_key(spec: Hoist, scene: WindUp) -> KeyPath:
    return ("speed", "drum" if spec.speed.drum is not None else "main")


WINDING_STRESS: Check[Hoist, WindUp] = Check(
    code="HST140",
    title="dynamic rope stress ratio, layer change",
    question="Is the dynamic rope stress of a layer change within its limit?",
    failure="layer change stresses the rope too much",
    scenes=WINDING,
    loads=("winding_stress_ratio",),
    sense=Sense.AT_MOST,
    limit=key(
        "checks.winding_stress_ratio",
        meaning="Maximum ratio of dynamic to mean rope stress, `checks: {winding_stress_ratio: ...}`",
        valid="any rope",
        error="none: a given value",
        source="an engineering choice of 10 %: covered by rope safety factors for static force",
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: _speed_key(spec, scene),
    repair=_speed_key,
    what="The maximum dynamic rope stress, relative to the mean stress, is at most the limit. It covers the layer"
    " change and the crossovers on the new layer.",
    why="The rope speed changes abruptly with the radius of the drum, and the load oscillates on its rope. The safety"
    " factor of the rope covers static forces only.",
    formula="s_dyn/s_mean <= limit;   for a sudden layer change w dR k n/(m g)",
    source="Fidrovska and Varchenko, corrected; the limit an engineering choice",
)
CROSSOVER_RESONANCE: Check[Hoist, WindUp] = Check(
    code="HST141",
    title="crossover separation from load resonance",
    question="Is the crossover frequency far enough from the load's natural frequency?",
    failure="rope crossovers excite the suspended load",
    scenes=WINDING,
    loads=("winding_detuning",),
    sense=Sense.AT_LEAST,
    limit=key(
        "checks.crossover_detuning",
        meaning="Minimum separation of the crossovers from resonance, `checks: {crossover_detuning: ...}`",
        valid="light damping",
        error="none: a given value",
        source="an engineering choice of 20 %, at which an undamped oscillation is magnified three times",
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: _speed_key(spec, scene),
    repair=_speed_key,
    what="While a layer is wound, the relative distance of the crossover frequency from the load's natural frequency"
    " is at least the limit. The natural frequency is that of the load on its rope.",
    why="Crossovers occur at constant time intervals. Near resonance, the oscillation grows from wrap to wrap, because"
    " a rope provides little damping.",
    formula="|n w/k - 1| >= limit for all lengths of the rope on the layer",
    source="resonance of an oscillator; the limit an engineering choice",
)
CHECKS_OF_WINDING: tuple[AnyCheck, ...] = (WINDING_STRESS, CROSSOVER_RESONANCE)
