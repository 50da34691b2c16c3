"""How long starts and stops of mechanisms take, and how often they may be."""

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.crane.stacking.machine import model
from ptmcalc.machines.crane.stacking.machine.scenes import Brake, Braked, Start
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.mechanisms import starts


def run(spec: Stacker, scene: Braked, carried: frozenset[str], level: int) -> Result:
    """Starting or stopping time from the momentum of the travelling masses; ratio of starts per hour to permitted
    starts.

        t = v/a + t_r  of a ramp,   M v = integral of P  of a force

    **Range** as `starts.time`.
    **Error** the error bar bounds the mast oscillation.
    **Source** momentum (`starts.time`).
    """
    name = "brake_time" if isinstance(scene, Brake) else "start_time"
    note = (
        "the start follows the motor curve, and the mast oscillation changes the motor torque"
        if model.uneven(spec, scene)
        else ""
    )
    found = {name: Found(starts.time(spec, scene), note=note)}
    ratio = starts.of_the_mechanism(spec, scene)
    if ratio is not None:
        found["starts_ratio"] = Found(Estimate.exact(ratio))
    return Result(found, work=1)


DRIVE_TIMES: Solver[Stacker, Braked] = Solver(
    name="drive_times",
    title="starting and stopping times by momentum balance",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Start, Brake}),
    represents=frozenset(),
    gives=frozenset({"start_time", "brake_time", "starts_ratio"}),
    run=run,
    cost=lambda spec, scene, carried, level: 1e-4,
    source="momentum of the travelling masses; bound of the oscillation derived by Cauchy",
)
