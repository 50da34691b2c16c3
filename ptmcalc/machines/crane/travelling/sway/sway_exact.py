"""A sudden ramp of speed with a load of any angle: closed form."""

import math

from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.crane.travelling.machine.loads import MOVING
from ptmcalc.machines.crane.travelling.machine.scenes import Moving
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.sway.effects import IN_PLANE, LARGE, MOVING_SCENES, SWAY
from ptmcalc.machines.crane.travelling.sway.finite import exact_course, regular
from ptmcalc.machines.crane.travelling.sway.moving import motion_of
from ptmcalc.machines.crane.travelling.sway.reading import failures_of, findings_of, loads_of


def run(spec: Travelling, scene: Moving, carried: frozenset[str], level: int) -> Result:
    """Loads of a speed ramp from or to standstill by the elliptic functions of the pendulum in tilted gravity.

        theta_max = 2 atan(a/g) if the ramp lasts at least half a period,   sin(A/2) = ((a/(2 g)) sin theta_1)^(1/2)
        T = M (3 g cos theta + 3 a sin theta - 2 g)

    **Range** a drive that follows its ramp; ropes of constant length; no wind on the load, no slope; a below g.
    **Error** exact for times and angles; loads that depend on rope force and wheel load at one instant are bounded by
    the extremes of both.
    **Source** `laws.pendulum.ramp_swing`.
    """
    motion = motion_of(spec, scene)
    loads = loads_of(spec, scene, exact_course(motion))
    return Result(loads, work=1, findings=findings_of(spec, scene, loads), failures=failures_of(spec, scene, loads))


def valid(spec: Travelling, scene: Moving) -> Criterion:
    """Whether the scene is a sudden ramp with ropes of constant length, no wind or slope at the load.

    **Range** every start and stop.
    **Error** none: the scene tells.
    **Source** the range of `laws.pendulum.ramp_swing`.
    """
    fits = regular(motion_of(spec, scene))
    return Criterion("ramp", 0.0 if fits else math.inf, 1.0, "whether the scene is a sudden ramp", "scene")


SWAY_EXACT: Solver[Travelling, Moving] = Solver(
    name="sway_exact",
    title="finite-angle sway under a speed ramp, elliptic functions",
    fidelity=Fidelity.FORMULA,
    scenes=MOVING_SCENES,
    represents=IN_PLANE | {LARGE},
    gives=MOVING,
    run=run,
    cost=lambda spec, scene, carried, level: 3e-3,
    source="pendulum in tilted gravity, Jacobi's elliptic functions; derived in ptmcalc.laws.pendulum",
    valid=valid,
    always=frozenset({SWAY, LARGE}),
)
