"""Largest torque through the limiter in a stop."""

import math

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.base.memory import kept_for
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.chain_drive.limiter.torque import Through, extremes, larger, modes_through, negative, of_pull
from ptmcalc.machines.chain_drive.limiter.trips import fitted, tripped
from ptmcalc.machines.chain_drive.machine.model import has_driven_tail, mean_arm
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Coast, EmergencyStop, Stop, Stopping
from ptmcalc.machines.chain_drive.starting.waves import felt
from ptmcalc.machines.chain_drive.stopping import motion
from ptmcalc.machines.chain_drive.stopping.formulas import waves, waves_valid
from ptmcalc.machines.chain_drive.stopping.motion import StopCase, StopSwing, stop_case, swings
from ptmcalc.numerics.mode_sum import mode_sum
from ptmcalc.spec.scene import Scene

_MODES = 24
"""Modes at the coarsest level; four times as many at the finer one. A numerical choice: the rest is bounded and added.
More narrow the error bar and take longer."""
STOPS: frozenset[type[Scene]] = frozenset({Stop, EmergencyStop, Coast})


@kept_for(64)
def stop_torque(spec: ChainDrive, scene: Stopping, level: int) -> Estimate:
    """Largest torque through the limiter in a stop as if it held, in either direction [N*m]."""
    case = stop_case(spec, scene)
    if has_driven_tail(spec):
        return Estimate.unknown(mean_arm(spec) * abs(_rigid(case)))
    if spec.effects.get("chain_elasticity") == "off":
        leaving = Interval(case.line.run_off, case.line.run_off)
        return of_pull(spec, Estimate.exact(abs(_rigid(case))), leaving)
    if waves_valid(spec, scene).exceeded or _may_go_slack(spec, scene, case):
        return Estimate.unknown(mean_arm(spec) * abs(_rigid(case)))
    leaving = Interval(0.0, motion.extremes(spec, case).highest if case.line.fixed_length else case.line.run_off)
    found = None
    for swing in swings(spec, case):
        most, least = _through(spec, scene, case, swing, level)
        torque = larger(of_pull(spec, most, leaving), of_pull(spec, negative(least), leaving))
        found = torque if found is None else _both(found, torque)
    assert found is not None, "a stop swings in both directions of the gear losses"
    return found


def _both(one: Estimate, other: Estimate) -> Estimate:
    """A torque that lies in either of two intervals."""
    top = one if one.value >= other.value else other
    low, high = min(one.low, other.low), max(one.high, other.high)
    return Estimate(top.value, low, high, top.numerical, top.model + max(top.low - low, high - top.high))


def _braked_behind(case: StopCase) -> bool:
    """Whether a brake on the sprocket shaft acts: behind the limiter."""
    return case.brake is not None and case.brake.shaft == "sprocket"


def _through(
    spec: ChainDrive, scene: Stopping, case: StopCase, swing: StopSwing, level: int
) -> tuple[Estimate, Estimate]:
    """Largest and smallest force through the limiter for one direction of the gear losses [N]."""
    masses = swing.masses
    rotor = 1 - case.own / masses.drive_mass
    behind = _braked_behind(case)
    through = Through(rotor, (-rotor if behind else 1 - rotor) * masses.total_mass)
    modes = modes_through(spec, scene, swing, felt(spec, scene, swing, _MODES << (2 * level)), through)
    peaks = mode_sum(modes, swing.course, swing.window)
    still = case.line.static_resistance
    most, least = extremes(peaks, swing.acceleration, 0.0 if behind else still, 0.0)
    before = Estimate.exact(still)  # the chain runs until the motors are switched off
    return larger(most, before), negative(larger(negative(least), negative(before)))


def _may_go_slack(spec: ChainDrive, scene: Stopping, case: StopCase) -> bool:
    """Whether the chain may go slack: by the bound, else by its modes."""
    if motion.extremes(spec, case).lowest >= 0:
        return False
    return waves(spec, scene, frozenset(), 0).loads["tension_min"].estimate.low < 0


def _rigid(case: StopCase) -> float:
    """Force through the limiter of the rigid body at full torque of the brake [N]."""
    hardest = case.hardest
    if _braked_behind(case):
        return (case.masses(1.0).drive_mass - case.own) * hardest
    return case.line.static_resistance - case.mass * hardest


def run(spec: ChainDrive, scene: Stopping, carried: frozenset[str], level: int) -> Result:
    """Largest torque that the limiter transmits in a stop without tripping, in either direction.

        M = R |F_l|,   F_l = S_on - S_off + m_s a_s        brake on the motor shaft, or none
                       F_l = -(m_d - m_s) a_s              brake on the sprocket shaft, behind the limiter

    a_s is the acceleration of the sprocket, m_d the reduced mass of drive and sprocket, m_s the part of the sprocket.
    Both directions of the gear losses are computed, and the error bar contains both.

    **Range** a taut chain until standstill, within 1000 periods of its lowest mode; passing teeth neglected.
    **Error** bounded: samples, neglected modes, arms, direction of the gear losses; no bound where the chain may go
    slack, does not stop or has a driven tail.
    **Source** equilibrium of the sprocket; sums over modes, derived in `numerics.mode_sum` and `chain_resonance`.
    """
    torque = stop_torque(spec, scene, level)
    return Result({"limiter_torque": Found(torque)}, work=1, findings=tripped(spec, torque))


def _cost(spec: ChainDrive, scene: Stopping, carried: frozenset[str], level: int) -> float:
    return 5e-2 * 8**level if math.isfinite(stop_case(spec, scene).rest()[0]) else 1e-3


LIMITER_STOP: Solver[ChainDrive, Stopping] = Solver(
    name="limiter_stop",
    title="torque of the torque limiter, stop",
    fidelity=Fidelity.MODAL,
    scenes=STOPS,
    represents=frozenset(),
    gives=frozenset({"limiter_torque"}),
    run=run,
    cost=_cost,
    source="equilibrium of the sprocket; sums over modes",
    valid=fitted,
    levels=2,
    method="sums over modes",
)
