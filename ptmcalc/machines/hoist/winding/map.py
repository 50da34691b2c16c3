"""The load on its rope over the map of the drum: the climb, every crossover of the layer, the rope ever shorter."""

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Failure, Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.hoist.machine.model import filled
from ptmcalc.machines.hoist.machine.spec import Hoist, WindUp
from ptmcalc.machines.hoist.winding.climb import (
    FloatArray,
    climb,
    crossover_ratios,
    detuning,
    histories,
    radius_map,
    rope,
    turns,
)
from ptmcalc.machines.hoist.winding.loads import OF_THE_WINDING
from ptmcalc.numerics.hauling import haul


def run(spec: Hoist, scene: WindUp, carried: frozenset[str], level: int) -> Result:
    """Elongation and stress of the rope from the layer change to the end of the layer, or to the highest hook position.

        (s e')' + 2 zeta (kappa s)^(1/2) e' + kappa e = V',   V = w R(f),   s' = -V/(1 + e_0)

    R is linear between the corners of `laws.winding.winding_radius`.

    **Range** a load at rest before the layer change, constant drum speed, a taut massless rope.
    **Error** stated in `numerics.hauling`.
    **Source** `numerics.hauling`.

    Raises:
        NumericsError: for a rope that the drum takes in whole, or an error bound that includes a slack rope.
    """
    case, modulus = climb(spec, scene), filled(spec.rope.modulus)
    hanging = rope(spec, scene)
    motion = haul(radius_map(spec, scene), case.drum_speed, hanging)
    most, least = motion.extremes()
    if least.value + least.error <= -hanging.static_strain:
        reason = f"the rope goes slack {least.time:.3g} s after the layer change begins"
        hint = "a lower drum speed, or one layer of rope"
        return Result({}, work=len(motion.offsets), failures=(Failure("HST140", reason, ("speed",), hint),))
    if least.value - least.error <= -hanging.static_strain:
        raise NumericsError(
            "NUM103",
            f"the error bound of the rope motion reaches {least.error / hanging.static_strain:.2g} of the static"
            " strain, and includes a slack rope",
        )
    length = float(motion.rope_length(most.time)) * (1 + hanging.static_strain)
    at = {"time": most.time}
    factors = {
        "winding_displacement_max": length,
        "winding_stress_max": modulus,
        "winding_stress_ratio": modulus / case.mean_stress,
    }
    strain = Estimate.within(most.value, most.error)
    loads = {name: Found(Estimate.within(strain.value * by, strain.numerical * by), at) for name, by in factors.items()}
    loads |= {
        "winding_frequency": Found(Estimate.exact(case.frequency)),
        "winding_crossover_ratio": Found(Estimate.exact(crossover_ratios(spec, scene)[1])),
        "winding_detuning": Found(Estimate.exact(detuning(spec, scene))),
    }

    def stretch_and_stress(time: FloatArray) -> tuple[FloatArray, FloatArray]:
        force = motion.at(time)[1]
        return force * motion.rope_length(time) * (1 + hanging.static_strain), force * modulus

    end = float(motion.times[-1])
    return Result(
        loads,
        work=len(motion.offsets),
        window=(0.0, end),
        histories=lambda: histories(end, case.frequency, stretch_and_stress, case.mean_stress),
    )


def cost(spec: Hoist, scene: WindUp, carried: frozenset[str], level: int) -> float:
    """Predicted seconds: three stretches a crossover."""
    return 4e-3 + 2.5e-5 * turns(spec, scene) * spec.winding.crossovers


WINDING_MAP: Solver[Hoist, WindUp] = Solver(
    name="winding_map",
    title="layer change and crossovers on a rope of varying length",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({WindUp}),
    represents=frozenset({"layer_map"}),
    gives=frozenset(info.name for info in OF_THE_WINDING),
    run=run,
    cost=cost,
    source="derived in ptmcalc.numerics.hauling",
    always=frozenset({"layer_map"}),
)
