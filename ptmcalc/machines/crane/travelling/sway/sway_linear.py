"""A start or a stop with the load swinging in small angles, exact piece by piece."""

from ptmcalc.base import units
from ptmcalc.contract.result import History, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.crane.travelling.machine.loads import MOVING
from ptmcalc.machines.crane.travelling.machine.scenes import Moving
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.sway.effects import IN_PLANE, MOVING_SCENES, SWAY
from ptmcalc.machines.crane.travelling.sway.linear import linear_course, over_time
from ptmcalc.machines.crane.travelling.sway.moving import Motion, motion_of, stalls
from ptmcalc.machines.crane.travelling.sway.reading import failures_of, findings_of, loads_of


def run(spec: Travelling, scene: Moving, carried: frozenset[str], level: int) -> Result:
    """Loads of a start or stop with small sway angles.

        L u'' + g u = -L x''        with  x'' imposed by a ramp,   or  m x'' = F - W - M g u/L (against the drive)

    Motors deliver their mean starting torque until full speed and then keep the speed; brakes act after their delay
    with a linear rise. The rope length decreases linearly while the load is hoisted.

    **Range** angles of a few degrees; a motor whose torque does not depend on its speed; one plane.
    **Error** exact between events, with the rounding bound of `numerics.pendulum.linear`; the effect `large_sway`
    covers finite angles, the effect `torque_curve` a motor curve.
    **Source** pendulum under a moved pivot; `numerics.pendulum.linear`.
    """
    motion = motion_of(spec, scene)
    course = linear_course(motion)
    loads = loads_of(spec, scene, course)
    findings = findings_of(spec, scene, loads)
    return Result(
        loads,
        work=course.work,
        findings=findings,
        histories=lambda: _histories(motion),
        failures=failures_of(spec, scene, loads),
    )


def _histories(motion: Motion) -> dict[str, History]:
    """Angle and pull of the load over time."""
    if stalls(motion) or not motion.load:
        return {}
    times, angles, pulls = (values.tolist() for values in over_time(motion))
    return {
        "sway_angle_max": History(units.ANGLE, times, angles),
        "horizontal_force": History(units.FORCE, times, pulls),
    }


SWAY_LINEAR: Solver[Travelling, Moving] = Solver(
    name="sway_linear",
    title="small-angle sway, event-driven exact solution",
    fidelity=Fidelity.MODAL,
    scenes=MOVING_SCENES,
    represents=IN_PLANE,
    gives=MOVING,
    run=run,
    cost=lambda spec, scene, carried, level: 2e-3,
    source="small-angle sway under a moved or pushed pivot; derived in ptmcalc.numerics.pendulum.linear",
    always=frozenset({SWAY}),
)
