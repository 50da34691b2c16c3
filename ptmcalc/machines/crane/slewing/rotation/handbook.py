"""The handbook's chain of a rotation, as course projects print it."""

import math

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.crane.slewing.machine import model
from ptmcalc.machines.crane.slewing.machine.spec import Slew, SlewingCrane, SlewingScene
from ptmcalc.machines.crane.slewing.rotation import chain


def run(spec: SlewingCrane, scene: SlewingScene, carried: frozenset[str], level: int) -> Result:
    """Slewing cycle with given starting time and given starting torque, which may contradict each other.

        t_b = 2 beta/w,   beta_st = beta - w t_s/2 - beta_b,   M_start = M_m u eta,   M_steady = M_fr + M_w,
        M_brake = (J + gamma J_1 u^2 eta) w/t_b + M_w,max - M_fr,   M_eq = (sum lambda_i M_i^m)^(1/m),
        M_pinion = M_eq/(u_o eta_o),   M_worm = M_eq/(u eta)

    The starting time is that of `handbook`, otherwise that of `cycle`, otherwise that of the torque.

    **Range** a rigid crane; shares rounded to three digits and not renormalised unless `handbook: {shares: exact}`.
    **Error** no bound: in the stop, the rotor inertia and the worm torque include the gear losses as for a driving
    motor; both are too large. Time and torque of the start may contradict each other.
    **Source** design of slewing cranes on a fixed column, course notes (3.5.2.2 to 3.5.2.13), missing formulas
    reconstructed.
    """
    given, torque = spec.handbook, model.motor_torque(spec, scene)
    start = model.start_time_of(given.start_time, given.start_angle, spec.speed)
    if start is None:
        start = model.start_time_of(spec.cycle.start_time, spec.cycle.start_angle, spec.speed)
    if start is None:
        start = model.start_time(spec, scene, given.rotor_eta_rule)
    if not math.isfinite(start):
        return Result({}, work=1)
    if torque is not None:
        at_column = model.at_column(spec, torque)
    else:
        at_column = model.start_torque(spec, scene, start, given.rotor_eta_rule)
    times = model.phases(spec, (start, spec.speed * start / 2), model.allowed_stop(spec))
    at = model.phase_torques(spec, scene, at_column, given.rotor_eta_rule, by_direction=False)
    loads = chain.loads(spec, scene, times, at, rounded=given.shares == "rounded", even=True)
    return Result({name: Found(Estimate.unknown(value)) for name, value in loads.items()}, work=1)


HANDBOOK: Solver[SlewingCrane, SlewingScene] = Solver(
    name="handbook",
    title="handbook slewing cycle",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Slew}),
    represents=frozenset(),
    gives=chain.GIVEN,
    run=run,
    cost=lambda spec, scene, carried, level: 5e-5,
    source="course notes on the slewing crane on a fixed column",
    decides=False,
)
