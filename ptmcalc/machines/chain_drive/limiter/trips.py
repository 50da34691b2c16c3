"""A limiter that trips: what it makes of the loads of a scene."""

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Finding
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, ChainScene, TorqueLimiter

ACTS = {"slip_clutch": "slips", "shear_pin": "breaks"}
"""What a limiter does at its torque, by its type, in texts for users."""


def fitted(spec: ChainDrive, scene: ChainScene) -> Criterion:
    """Whether the machine has a torque limiter: 0 where it has, else 1.

    **Range** any machine.
    **Error** exact.
    **Source** the file.
    """
    lacks = float(spec.torque_limiter is None)
    return Criterion("limiter", lacks, 1.0, "0 where the file gives a torque limiter, else 1", "the file")


def limiter_of(spec: ChainDrive) -> TorqueLimiter:
    """The torque limiter, without which no load of it is computed."""
    assert spec.torque_limiter is not None, "solvers of the torque limiter run only where the file gives it"
    return spec.torque_limiter


def least(spec: ChainDrive) -> float:
    """Lowest trip torque [N*m]."""
    return limiter_of(spec).least


def may_trip(spec: ChainDrive, torque: Estimate) -> bool:
    """Whether a torque may reach the lowest trip torque."""
    return torque.high >= least(spec)


def tripped(spec: ChainDrive, torque: Estimate) -> tuple[Finding, ...]:
    """The remark that the motion of a scene is not the true one where the limiter trips."""
    if torque.low < least(spec):
        return ()
    acts, show = ACTS[limiter_of(spec).type], units.show
    message = (
        f"the torque limiter {acts}: {show(torque.value, units.TORQUE)} would be transmitted, it may trip from"
        f" {show(least(spec), units.TORQUE)} on; the motion of the scene is computed as if it held, and its loads have"
        " no bound"
    )
    return (Finding("NUM102", message, ("torque_limiter", "torque"), "see CHN134"),)
