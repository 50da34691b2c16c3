"""A stacker crane that stands: its weight, how stiff its column is, what weights alone stress."""

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.crane.stacking.machine import columns, model
from ptmcalc.machines.crane.stacking.machine.scenes import Stand
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.strength.derived import DERIVED, with_derived


def run(spec: Stacker, scene: Stand, carried: frozenset[str], level: int) -> Result:
    """Weight of crane and load, mast stiffness at the tip, and loads that follow from weights alone.

        c = 1/(d_column + d_rotation + d_shift),   G = g sum m

    **Range** a weightless mast without a top guide, small deflections.
    **Error** exact for that model.
    **Source** lecture notes Kramatorsk 2007 (`laws.mast`); balance.
    """
    stiffness = columns.compliance(spec, "along").stiffness
    found = {
        "total_weight": Found(Estimate.exact(model.total_mass(spec, scene) * spec.gravity)),
        "column_stiffness": Found(Estimate.exact(stiffness)),
    }
    return Result(with_derived(spec, scene, found), work=1)


WEIGHTS: Solver[Stacker, Stand] = Solver(
    name="weights",
    title="weights, mast stiffness and static stress",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Stand}),
    represents=frozenset(),
    gives=frozenset({"total_weight", "column_stiffness"}) | DERIVED,
    run=run,
    cost=lambda spec, scene, carried, level: 1e-4,
    source="balance of weights; N. Yu. Dorokhov, lecture notes, Kramatorsk 2007",
)
