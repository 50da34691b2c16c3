"""Speed changes that fail: a run-up that stays below its speed, and a brake that does not hold the stopped shaft."""

from ptmcalc.base import units
from ptmcalc.contract.result import Failure
from ptmcalc.machines.shaft.machine.model import Machine
from ptmcalc.machines.shaft.machine.motor_keys import motor_key
from ptmcalc.machines.shaft.machine.spec import Shaft


def never_up(spec: Shaft, machine: Machine, target: float) -> tuple[Failure, ...]:
    """A run-up that never comes to its speed: the motor stalls, does not pass a dead centre, or stays below."""
    most, passed = machine.survey.static_high, machine.drive.ratio * machine.drive.efficiency
    have, speed = passed * machine.largest_torque, units.show(target, units.ANGULAR_SPEED)
    message = (
        f"the shaft never reaches {speed}: load, losses and weights require up to {_torque(most)} on it, the motor"
        f" torque is at most {_torque(have)}"
    )
    hint = (
        f"a motor of more than {_torque(most / passed)} would be sufficient"
        if most > have
        else "more motor torque at each speed"
    )
    return (Failure("SHF103", message, motor_key(spec), hint),)


def not_held(spec: Shaft, turns: float, held: float) -> list[Failure]:
    """A shaft that weights and springs turn again where its brake has stopped it, by the checks of its stop."""
    message = (
        f"the brake does not hold the shaft: weights and springs drive it with {_torque(turns)}, {_torque(held)} hold"
    )
    assert spec.brake is not None
    hint = f"a brake of more than {_torque(spec.brake.torque + turns - held)}"
    return [Failure(code, message, ("brake", "torque"), hint) for code in ("SHF105", "SHF106")]


def _torque(value: float) -> str:
    return units.show(value, units.TORQUE)
