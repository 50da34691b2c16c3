"""A start on the motor curve with the teeth that pass during it."""

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Interval
from ptmcalc.base.memory import kept_for
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.chain_drive.spec import ChainDrive, Start
from ptmcalc.machines.chain_drive.speed_change.teeth import curve_passings
from ptmcalc.machines.chain_drive.speed_change.tooth_passes import MODES_OF_TEETH, cost_of_teeth, teeth_alone
from ptmcalc.machines.chain_drive.starting.bounds import TENSIONS, loads_of
from ptmcalc.machines.chain_drive.starting.motion import start_case
from ptmcalc.machines.chain_drive.starting.motor_curve_waves import MOTOR_WAVES, histories, judged, valid
from ptmcalc.machines.chain_drive.starting.waves import beyond_slack

_ALONG = 80
"""Sections for the predicted cost; a numerical choice. No load depends on it."""


@kept_for(16)
def curve_teeth_simulated(spec: ChainDrive, scene: Start, level: int) -> tuple[float, float, int]:
    """Most that the teeth of a start on a motor curve add to the entering tension and take from any tension [N], and
    the work.

    Raises:
        NumericsError: NUM102 where the rigid chain is not followed.
    """
    passings = curve_passings(spec, scene, MODES_OF_TEETH << level)
    if not passings:
        raise NumericsError("NUM102", "the motors do not bring the rigid chain to a steady speed")
    return teeth_alone(spec, passings, start_case(spec, scene), level)


def run(spec: ChainDrive, scene: Start, carried: frozenset[str], level: int) -> Result:
    """Tensions of a start on the motor curve, with every tooth that passes.

        S = S_motor +- (|S_m| + |S_v|)

    S_motor is the tension of `chain_motor_waves`. S_m and S_v are the tensions that the teeth add, tooth after tooth as
    in `chain_start_teeth`, for a torque that does not depend on the speed and for a constant speed: the tension of
    motors in between does not exceed their sum (`teeth.curve_teeth`). The sprocket turns as that of the rigid chain.

    **Range** as `chain_motor_waves`.
    **Error** that of `chain_motor_waves`, and the sum of both.
    **Source** `chain_motor_waves`; `numerics.run_through`; derived in `teeth.curve_teeth`.
    """
    found, case = judged(spec, scene, level), start_case(spec, scene)
    more, less, work = curve_teeth_simulated(spec, scene, level)
    dynamic = found.dynamic.widened(Interval(-min(more, found.dynamic.low), more))
    smallest = found.smallest.widened(Interval(-less, max(min(case.line.ends) - found.smallest.high, 0.0)))
    at = {"time": found.times[0]}
    loads = {name: Found(load, at) for name, load in loads_of(spec, case, dynamic, None).items()}
    loads["tension_min"] = Found(smallest, found.where)
    result = Result(
        loads,
        work=found.steps + work,
        window=(0.0, found.end),
        histories=lambda: histories(spec, scene, level),
    )
    return beyond_slack(spec, result, "CHN123")


def _cost(spec: ChainDrive, scene: Start, carried: frozenset[str], level: int) -> float:
    whole = MOTOR_WAVES.cost(spec, scene, carried, level)
    for one in curve_passings(spec, scene, MODES_OF_TEETH << level):
        whole += cost_of_teeth(spec, one, _ALONG, level)
    return whole


_CARRIED = frozenset({"chain_elasticity", "higher_modes", "tooth_passing"})
MOTOR_TEETH: Solver[ChainDrive, Start] = Solver(
    name="chain_motor_teeth",
    title="start on the motor curve, modes of chain and drive with polygon excitation",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({Start}),
    represents=_CARRIED,
    gives=frozenset(TENSIONS),
    run=run,
    cost=_cost,
    source="derived in ptmcalc.numerics.driven_modes and ptmcalc.numerics.run_through",
    valid=valid,
    always=_CARRIED,
    levels=2,
)
