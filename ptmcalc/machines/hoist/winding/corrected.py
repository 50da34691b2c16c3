"""The paper's pulse put right: the tackle in the stiffness, the rope's modulus, the jump of speed of the layer."""

import math

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Finding, Found, History, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import winding
from ptmcalc.machines.hoist.machine.model import filled
from ptmcalc.machines.hoist.machine.spec import Hoist, WindUp
from ptmcalc.machines.hoist.winding import paper as winding_paper
from ptmcalc.machines.hoist.winding.climb import climb, crossover_ratios, detuning, histories, place_of_the_climb
from ptmcalc.machines.hoist.winding.loads import OF_THE_PAPER, OF_THE_WINDING
from ptmcalc.numerics.decay_pulse import DecayPulse

CLAIMED = (0.07, 0.18)
"""Dynamic stress relative to mean stress that the paper states [1]: lowest and highest value. It is printed in a
message; no load depends on it."""
OF_PAPER = {
    "winding_displacement_max": "winding_displacement_paper",
    "winding_stress_max": "winding_stress_paper",
}
"""Loads of the paper that are drawn over time beside ours, as in its figures."""


def run(spec: Hoist, scene: WindUp, carried: frozenset[str], level: int) -> Result:
    """Elongation and stress of the rope for a layer change with the shape of the paper and the impulse of the rope
    speed jump.

        k = (K/M)^(1/2),   q'' + 2 zeta k q' + k^2 q = B w^2 dR (exp(-p f) - exp(-r f)) for a turn, f = w t
        s_dyn/s_mean = C B w^2 dR n/(m g),   C = k^2 q_max/(B w^2 dR)

    **Range** one layer change, a load initially at rest, a rope of constant length.
    **Error** exact for the assumed shape: the bound of the effect `layer_map` covers any other shape and the
    crossovers. The frequency is that of the loaded length, too low by half the static strain.
    **Source** `laws.winding`, `numerics.decay_pulse`.
    """
    case, modulus = climb(spec, scene), filled(spec.rope.modulus)
    pulse = _pulse(spec, scene)
    summit = pulse.largest()
    stretch = Estimate.within(abs(summit.value), summit.error)
    per_stretch = float(winding.stretch_stress(modulus, 1.0, case.length))
    stress, ratio = (_times(stretch, per_stretch / by) for by in (1.0, case.mean_stress))
    at = {"time": summit.time}
    loads = {
        "winding_frequency": Found(Estimate.exact(case.frequency)),
        "winding_displacement_max": Found(stretch, at),
        "winding_stress_max": Found(stress, at),
        "winding_stress_ratio": Found(ratio, at),
        "winding_crossover_ratio": Found(Estimate.exact(crossover_ratios(spec, scene)[1])),
        "winding_detuning": Found(Estimate.exact(detuning(spec, scene))),
    }
    paper = winding_paper.run(spec, scene, carried, level)
    loads |= {of_paper: paper.loads[name] for name, of_paper in OF_PAPER.items()}
    claim = _claim(scene, paper.loads["winding_stress_ratio"].estimate.value, ratio.value)

    def courses() -> dict[str, History]:
        own = histories(
            2 * pulse.duration, case.frequency, lambda t: (q := pulse.at(t)[0], q * per_stretch), case.mean_stress
        )
        printed = paper.histories()
        return own | {of_paper: printed[name] for name, of_paper in OF_PAPER.items()}

    return Result(
        loads,
        work=2,
        window=(0.0, 2 * pulse.duration),
        findings=(claim, *place_of_the_climb(spec, scene)),
        histories=courses,
    )


def _pulse(spec: Hoist, scene: WindUp) -> DecayPulse:
    case = climb(spec, scene)
    return DecayPulse(
        case.frequency,
        spec.rope.damping,
        *winding.climb_rates(case.drum_speed),
        winding.climb_amplitude(case.drum_speed, case.step),
        2 * math.pi / case.drum_speed,
    )


def _times(estimate: Estimate, factor: float) -> Estimate:
    return Estimate.within(estimate.value * factor, estimate.numerical * factor)


def _claim(scene: WindUp, of_paper: float, ratio: float) -> Finding:
    """What the paper claims, what its own equations give, and what follows with its errors put right."""
    low, high, own, right = (units.show(share, units.SHARE) for share in (*CLAIMED, of_paper, ratio))
    message = (
        f"scene `{scene.label}`: published dynamic stresses of {low} to {high} of the mean stress in multilayer winding"
        f" are not confirmed: the published equations give {own} here, the corrected ones {right}"
    )
    return Finding("NUM107", message, ("scenes",))


WINDING_CORRECTED: Solver[Hoist, WindUp] = Solver(
    name="winding_corrected",
    title="one layer change, corrected closed form",
    fidelity=Fidelity.MODAL,
    scenes=frozenset({WindUp}),
    represents=frozenset(),
    gives=frozenset(info.name for info in (*OF_THE_WINDING, *OF_THE_PAPER)),
    run=run,
    cost=lambda spec, scene, carried, level: 3.5e-3,
    source="derived in ptmcalc.laws.winding and ptmcalc.numerics.decay_pulse",
)
