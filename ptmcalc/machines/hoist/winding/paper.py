"""The winding paper's formulas, with its frequency. Shown beside the computed loads, never judged."""

import math

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import winding
from ptmcalc.machines.hoist.machine import model
from ptmcalc.machines.hoist.machine.spec import Hoist, WindUp
from ptmcalc.machines.hoist.winding.climb import climb, histories
from ptmcalc.numerics.decay_pulse import DecayPulse

WIRE = 2.1e11
"""Modulus of wire that the paper takes for that of the rope [Pa]. The stress by the paper is proportional to it;
`paper_modulus` of the file replaces it."""


def run(spec: Hoist, scene: WindUp, carried: frozenset[str], level: int) -> Result:
    """Frequency, elongation and stress of the rope by the paper.

        k = (E F g/(P l))^(1/2),   q'' + k^2 q = A (exp(-3 t) - exp(-96 t)) for a turn of the drum,   s = E q/l

    with A = w^2 d and the mean stress P/F.

    **Range** a single-fall rope, a drum at 12 rpm.
    **Error** no bound: on m falls the frequency is m times too small, the modulus is that of wire, and the impulse of
    the forcing is not the rope speed jump. The formula never decides a verdict.
    **Source** N. Fidrovska, O. Varchenko (`laws.winding`); misprints corrected in `numerics.decay_pulse`.
    """
    pulse, modulus = _pulse(spec, scene), _modulus(spec)
    length, mean = climb(spec, scene).length, _mean(spec, scene)
    summit = abs(pulse.largest().value)
    stress = float(winding.stretch_stress(modulus, summit, length))
    loads = {
        "winding_frequency": pulse.natural_frequency,
        "winding_displacement_max": summit,
        "winding_stress_max": stress,
        "winding_stress_ratio": stress / mean,
    }
    return Result(
        {name: Found(Estimate.unknown(value)) for name, value in loads.items()},
        work=1,
        histories=lambda: histories(
            2 * pulse.duration,
            pulse.natural_frequency,
            lambda t: (q := pulse.at(t)[0], winding.stretch_stress(modulus, q, length)),
            mean,
        ),
    )


def _modulus(spec: Hoist) -> float:
    return spec.winding.paper_modulus if spec.winding.paper_modulus is not None else WIRE


def _mean(spec: Hoist, scene: WindUp) -> float:
    return winding.fall_stress(model.hook_mass(spec, scene) * spec.gravity, 1, model.metallic_area(spec))


def _pulse(spec: Hoist, scene: WindUp) -> DecayPulse:
    speed, load = model.drum_speed(spec), model.hook_mass(spec, scene) * spec.gravity
    length = climb(spec, scene).length
    return DecayPulse(
        winding.paper_frequency(_modulus(spec), model.metallic_area(spec), load, length, spec.gravity),
        0.0,
        winding.PAPER_SLOW,
        winding.PAPER_FAST,
        winding.paper_amplitude(speed, spec.rope.diameter),
        2 * math.pi / speed,
    )


WINDING_PAPER: Solver[Hoist, WindUp] = Solver(
    name="winding_paper",
    title="published formulas for multilayer winding",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({WindUp}),
    represents=frozenset(),
    gives=frozenset({"winding_frequency", "winding_displacement_max", "winding_stress_max", "winding_stress_ratio"}),
    run=run,
    cost=lambda spec, scene, carried, level: 2e-3,
    source="N. Fidrovska, O. Varchenko: dynamics of multilayer winding",
    decides=False,
)
