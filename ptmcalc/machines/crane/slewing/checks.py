"""The checks of a slewing crane."""

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, Sense, no_needs
from ptmcalc.machines.crane.slewing.spec import Slew, SlewingCrane, SlewingScene


def _reserve_limit(spec: SlewingCrane, scene: SlewingScene) -> Estimate:
    """Least mean starting torque over that of steady slewing, 1.1 by default.

    **Range** motors that start against friction and the steady wind.
    **Error** none: an engineering rule.
    **Source** handbooks of lifting machines.
    """
    return Estimate.exact(spec.checks.starting_reserve)


def _torque_key(spec: SlewingCrane, scene: SlewingScene) -> KeyPath:
    """What says how strongly it starts."""
    if spec.motor.mean_torque(1.0) is not None:
        return ("motor", spec.motor.torque_key)
    return ("cycle", "start_time" if spec.cycle.start_time is not None else "start_angle")


CHECKS: tuple[AnyCheck, ...] = (
    Check(
        code="CRN101",
        title="a motor that stalls: a start torque below friction",
        scenes=frozenset({Slew}),
        loads=("starting_reserve",),
        sense=Sense.AT_LEAST,
        limit=_reserve_limit,
        needs=no_needs,
        blame=lambda spec, scene, loads: _torque_key(spec, scene),
        repair=lambda spec, scene: key if (key := _torque_key(spec, scene))[-1] == "mean_starting_torque" else (),
        what="The mean starting torque, carried to the slewing axis, exceeds friction, steady wind and slope by the"
        " reserve asked.",
        why="A motor below the resistance does not turn the crane: it stalls and burns.",
        formula="M_m u eta/(M_fr + M_w) >= 1.1",
        source="balance of torques about the slewing axis; handbooks of lifting machines",
    ),
)
