"""Stiffness and natural frequencies of the column by the exact equation of its beam."""

import math

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Finding, Found, Result, of
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import mast_modes
from ptmcalc.laws.mast_modes import Mast
from ptmcalc.machines.crane.stacking.machine.columns import rest_deflection, standing, swinging
from ptmcalc.machines.crane.stacking.machine.loads import MODES
from ptmcalc.machines.crane.stacking.machine.scenes import Brake, DrivenScene, StackerScene, Stand, Start
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.machine.travelling import push_of, travels
from ptmcalc.machines.crane.stacking.mast.handbook import remarks

_DIGITS = 64 * float(np.finfo(float).eps)
"""Rounding of a dynamic stiffness whose terms are a dozen times E J/l^3, as a share of that."""
_UNSEEN = 1e-9
"""Share of the square of a frequency below which its rounding is not told."""


def run(spec: Stacker, scene: StackerScene, carried: frozenset[str], level: int) -> Result:
    """Stiffness of the mast at its tip, and its natural frequencies with a fixed base or a base free to roll.

        c = 1/(d_1 + d_2 + d_3),   det K(w) = 0

    **Range** a uniform slender mast with the load at one place; a base at standstill or on a speed ramp is fixed.
    **Error** exact for that mast without the effect of gravity on its stiffness.
    **Source** `laws.mast`, `laws.mast_modes`.
    """
    said: tuple[Finding, ...] = ()
    if isinstance(scene, Stand):
        one, stiffness = standing(spec, scene), swinging(spec, scene).stiffness
    else:
        assert isinstance(scene, DrivenScene)
        push = push_of(spec, scene)
        moving = swinging(spec, scene, push.rotors)
        said = remarks(moving, scene, push.kind == "ramp")
        one, stiffness = (moving.exact if push.kind == "force" else moving.held), moving.stiffness
    frequencies = [mast_modes.mast_frequency(one, k + 1) for k in range(len(MODES))]
    loads = {of("natural_frequency", mode): _told(one, w) for mode, w in zip(MODES, frequencies, strict=True)}
    loads |= {"column_stiffness": Estimate.exact(stiffness), "period": _period(_told(one, frequencies[0]))}
    if not isinstance(scene, Stand):
        loads["rest_deflection"] = Estimate.exact(rest_deflection(spec, scene))
    return Result({name: Found(told) for name, told in loads.items()}, work=len(MODES), findings=said)


def _told(one: Mast, frequency: float) -> Estimate:
    """A frequency, which the determinant says but for rounding of E J/l^3 over the mass, of the shorter stretch beside
    the load: a stiff column on a soft root swings with much less than that."""
    heavy = one.column_mass + one.tip_mass + one.root_mass + one.top_mass
    short = one.length * mast_modes.shortest_part(one)
    lost = _DIGITS * one.flexural_stiffness / short**3 / heavy
    if not math.isfinite(frequency) or lost <= _UNSEEN * frequency**2:
        return Estimate.exact(frequency)
    low, high = math.sqrt(max(frequency**2 - lost, 0.0)), math.sqrt(frequency**2 + lost)
    return Estimate(frequency, low, high, numerical=max(frequency - low, high - frequency))


def _period(frequency: Estimate) -> Estimate:
    """Of a swing with that frequency."""
    ends = [2 * math.pi / one if one else math.inf for one in (frequency.value, frequency.high, frequency.low)]
    value, low, high = ends
    return Estimate(value, low, high, numerical=max(high - value, value - low) if frequency.bar else 0.0)


MAST_BEAM: Solver[Stacker, StackerScene] = Solver(
    name="mast_beam",
    title="mast stiffness and frequencies, beam theory",
    fidelity=Fidelity.MODAL,
    scenes=frozenset({Stand, Start, Brake}),
    represents=frozenset(),
    gives=frozenset({"column_stiffness", "natural_frequency", "period", "rest_deflection"}),
    run=run,
    cost=lambda spec, scene, carried, level: 5e-3,
    valid=travels,
    source="W. H. Wittrick, F. W. Williams 1971; beam of Euler and Bernoulli",
)
