"""The carriage in statics with inertia: rollers, guide, ropes."""

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.crane.stacking.machine.loads import OF_THE_HOIST, names
from ptmcalc.machines.crane.stacking.machine.scenes import HoistScene
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.mechanisms import climbing, starts


def run(spec: Stacker, scene: HoistScene, carried: frozenset[str], level: int) -> Result:
    """Forces of a carriage that starts upwards, or stops during lowering.

        R = (1 + a/g) |Q e + G b|/h,   W = 2 R (mu d + 2 f)/D,   S = ((1 + a/g)(Q + G) +- W)/(m eta^+-1)

    **Range** vertical ropes; the acceleration of the file, with an inextensible rope.
    **Error** the error bar covers the unknown combination of the rollers of both planes.
    **Source** lecture notes Kramatorsk 2007 (`laws.carriage`).
    """
    found = climbing.loads(spec, scene)
    ratio = starts.of_the_hoist(spec)
    if ratio is not None and scene.direction == "up":
        found["starts_ratio"] = Found(Estimate.exact(ratio))
    return Result(found, work=1)


CARRIAGE_STATICS: Solver[Stacker, HoistScene] = Solver(
    name="carriage_statics",
    title="carriage rollers, guides and ropes, inertia included",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({HoistScene}),
    represents=frozenset(),
    gives=names(OF_THE_HOIST) | {"starts_ratio"},
    run=run,
    cost=lambda spec, scene, carried, level: 1e-4,
    source="N. Yu. Dorokhov, lecture notes, Kramatorsk 2007; balance of the carriage",
)
