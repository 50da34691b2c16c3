"""The chain of a rotation whose start has either its torque or its time, and the other follows."""

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.crane.slewing import chain, model
from ptmcalc.machines.crane.slewing.spec import Slew, SlewingCrane, SlewingScene


def run(spec: SlewingCrane, scene: SlewingScene, carried: frozenset[str], level: int) -> Result:
    """The chain of a rotation: the start time follows from the motor's torque, or its torque from the time.

        t_s = (J + gamma J_1 u^2 eta) w/(M_m u eta - M_steady), or M_m u eta = (J + ...) w/t_s + M_steady

    **Range** a rigid crane under constant torques.
    **Error** exact for that model.
    **Source** change of angular momentum; course notes on the slewing crane on a fixed column.
    """
    torque = model.motor_torque(spec)
    given = model.start_time_of(spec.cycle.start_time, spec.cycle.start_angle, spec.speed)
    if torque is not None:
        start, at_column = chain.start_time(spec, scene), model.at_column(spec, torque)
        derived = "start_time"
    else:
        assert given is not None
        start, at_column = given, chain.start_torque(spec, scene, given)
        derived = "torque_start"
    loads = chain.of_rotation(spec, scene, start_time=start, torque_start=at_column)
    loads = dict(loads) | {
        "starting_reserve": at_column / model.steady_torque(spec, scene),
        "torque_motor_start": at_column / (spec.gear.ratio * spec.gear.efficiency),
    }
    found = {name: Found(Estimate.exact(value)) for name, value in loads.items()}
    known = "the start time" if derived == "torque_start" else "the motor's torque"
    found[derived] = Found(Estimate.exact(loads[derived]), note=f"derived from {known}")
    return Result(found, work=1)


CONSISTENT: Solver[SlewingCrane, SlewingScene] = Solver(
    name="consistent",
    title="the chain of a rotation, torque and time of its start fitting each other",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Slew}),
    represents=frozenset(),
    gives=chain.GIVEN | {"starting_reserve", "torque_motor_start"},
    run=run,
    cost=lambda spec, scene, carried, level: 1e-4,
    source="change of angular momentum",
)
