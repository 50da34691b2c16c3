"""The polygon effect by the sum of its absolute harmonics: no dynamic tension is larger, whatever the phases."""

import math

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.chain_drive.machine.layout import TwoShafts
from ptmcalc.machines.chain_drive.machine.model import chain_line, has_driven_tail
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Run
from ptmcalc.machines.chain_drive.machine.strength import OF_TENSION, QUIET, STILL, Answer, Tail, loads_of_tension
from ptmcalc.machines.chain_drive.polygon.answers import answer_bound
from ptmcalc.machines.chain_drive.polygon.excitation import FAR, POLYGON, WEAK


def run(spec: ChainDrive, scene: Run, carried: frozenset[str], level: int) -> Result:
    """Upper bound of the tension added by the polygon effect.

        S <= sum |D(w_n)| |b_n|/w_n^2,   w_n = 2 pi n V/p,   plus the remainder after the last harmonic

    **Range** linear taut strands with any end conditions; infinite at a resonance without damping.
    **Error** a bound: up to twice the maximum tension near a resonance and several times that tension between two
    resonances.
    **Source** triangle inequality on the Fourier series; remainder in `numerics.harmonic.rest`.
    """
    bound = answer_bound(spec, scene, carried, near=True)
    most = Estimate(bound, 0.0, bound, bound) if math.isfinite(bound) else Estimate.unknown(bound)
    least = Estimate(-bound, -bound, 0.0, bound) if math.isfinite(bound) else Estimate.unknown(-bound)
    tail = QUIET if isinstance(spec.layout, TwoShafts) else Tail(most, least, most, least)
    off = (most, least) if has_driven_tail(spec) else (STILL, STILL)
    loads = loads_of_tension(spec, chain_line(spec, scene), Answer(most, least, most, least, tail, bound, None, *off))
    loads["tension_polygon_bound"] = most  # its rest behind the last harmonic is bounded, too
    return Result({name: Found(one) for name, one in loads.items()}, work=1024)


POLYGON_BOUND: Solver[ChainDrive, Run] = Solver(
    name="polygon_bound",
    title="upper bound of the polygon effect (sum of harmonics)",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Run}),
    represents=frozenset({POLYGON, FAR, WEAK}),
    gives=OF_TENSION | {"tension_polygon_bound"},
    run=run,
    cost=lambda spec, scene, carried, level: 6.3e-3,
    source="Fourier series of the polygon acceleration; dynamic stiffness of the strands",
    always=frozenset({POLYGON}),
)
