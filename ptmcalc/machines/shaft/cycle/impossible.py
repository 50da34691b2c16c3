"""Cycles that are impossible: a motor that stalls, and one that the load and the losses never hold."""

import math

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.components.motor import InductionBase
from ptmcalc.contract.result import Failure, Found, Result
from ptmcalc.machines.shaft.machine.cases import machine_in
from ptmcalc.machines.shaft.machine.model import Machine
from ptmcalc.machines.shaft.machine.motor_keys import motor_key
from ptmcalc.machines.shaft.machine.spec import Shaft, Steady

_ROUND_UP = 1.01
"""Margin on a torque that is named as a cure, so that its rounded value still does."""


def stalls(spec: Shaft, scene: Steady) -> Result:
    """A cycle that the motor does not carry: nothing is useful, and the check of it fails.

        missing work = Theta M_mean - eta u Theta max M

    **Range** any motor; where its largest torque would do over a cycle, the load is too large in a part of it.
    **Error** none for the works.
    **Source** work balance of a cycle (6.10).
    """
    machine = machine_in(spec, scene)
    most, needed = machine.largest_torque, machine.survey.static_mean
    period, passed = machine.period, machine.drive.ratio * machine.drive.efficiency
    have, ask = passed * most * period, needed * period
    if have <= ask:
        message = (
            f"the motor does at most {_work(have)} in a cycle, load and losses require {_work(ask)}:"
            f" {_work(ask - have)} are missing and the shaft stalls"
        )
        hint = f"a motor of more than {_torque(needed / passed)} would be sufficient"
    else:
        message = (
            f"the motor could do {_work(have)} in a cycle, load and losses require {_work(ask)}, but their torque of up"
            f" to {_torque(machine.survey.static_high)} stalls the shaft within the cycle"
        )
        hint = (
            f"a larger flywheel, or a motor of {_torque(_ROUND_UP * machine.survey.static_high / passed)}, would be"
            " sufficient"
            if machine.survey.static_high > passed * most
            else "more motor torque at every speed of the cycle would be sufficient"
        )
    return Result(stalled(machine), work=1, health={"steps": 0.0}, failures=_failures(spec, message, hint))


def races(spec: Shaft, scene: Steady) -> Result:
    """A cycle that never comes: the motor does more work than load and losses take at any speed.

    **Range** motors whose torque does not fall to 0 with the speed.
    **Error** none for the works.
    **Source** work balance of a cycle (6.10).
    """
    machine = machine_in(spec, scene)
    excess = float(machine.surplus(machine.tried_speeds[-1:])[0])
    ask = machine.survey.static_mean * machine.period
    message = (
        f"the drive does {_work(excess * machine.period)} more in each cycle than load and losses take at any speed"
        f" ({_work(ask)} without viscous friction): the shaft accelerates without limit"
    )
    hint = (
        f"a motor whose torque falls with the speed (`type: induction` or `linear`), or {_torque(excess)} more load or"
        " losses would be sufficient"
    )
    return Result({}, work=1, failures=_failures(spec, message, hint))


def stalled(machine: Machine) -> dict[str, Found]:
    """Loads of a machine that its motor cannot drive: nothing is useful, and the work asked for, all of it lost, is
    related to the most that the motor could do."""
    have = machine.drive.ratio * machine.drive.efficiency * machine.largest_torque
    lost = max(machine.survey.static_mean / have, 1.0) if have > 0 else math.inf
    values = {"loss_factor": lost, "cycle_efficiency": 0.0, "speed_min": 0.0}
    return {name: Found(Estimate.exact(value)) for name, value in values.items()}


def _failures(spec: Shaft, message: str, hint: str) -> tuple[Failure, ...]:
    """The failure of the cycle, and of the checks whose limits the file gives: without a cycle none of them holds."""
    path, motor = motor_key(spec), spec.drive.motor
    also = {
        "SHF102": spec.checks.irregularity is not None,
        "SHF104": motor.rated is not None,
        "SHF107": motor.largest_torque is not None or isinstance(motor, InductionBase),
    }
    cause = "there is no steady cycle (SHF101)"
    return (
        Failure("SHF101", message, path, hint),
        *(Failure(code, cause, path) for code, given in also.items() if given),
    )


def _work(value: float) -> str:
    return units.show(value, units.ENERGY)


def _torque(value: float) -> str:
    return units.show(value, units.TORQUE)
