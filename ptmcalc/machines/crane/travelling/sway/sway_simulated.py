"""A start or a stop simulated with the load at any angle."""

from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.crane.travelling.machine.loads import MOVING
from ptmcalc.machines.crane.travelling.machine.scenes import Moving
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.sway.effects import (
    CURVE,
    IN_PLANE,
    LARGE,
    MOVING_SCENES,
    REACTION,
    SWAY,
    follows_curve,
)
from ptmcalc.machines.crane.travelling.sway.moving import motion_of
from ptmcalc.machines.crane.travelling.sway.reading import failures_of, findings_of, loads_of
from ptmcalc.machines.crane.travelling.sway.simulated import simulate, turns

TOLERANCES = (1e-9, 1e-12)
"""Largest error of a step at each level, as an angle [rad]. A numerical choice: the error bar follows from two runs. A
smaller value narrows it and takes more steps; the second level is near the resolution of floating-point numbers."""


def run(spec: Travelling, scene: Moving, carried: frozenset[str], level: int) -> Result:
    """Loads of a start or stop from the equations of motion of crane and load at any angle, event-driven.

        L theta'' + 2 L' theta' + g sin theta = -x'' cos theta,   (m + m_r) x'' = F - W + T sin theta

    Gear losses depend on the direction of power at each instant; a motor follows its curve, stage by stage; brakes act
    through the gear and hold the crane at standstill up to their torque.

    **Range** a taut massless rope, one plane, wheels without slip.
    **Error** the difference of two runs with other steps and orders, plus the sampling error.
    **Source** `numerics.pendulum.swing`.
    """
    done = simulate(spec, scene, TOLERANCES[level])
    loads = loads_of(spec, scene, done.course)
    return Result(
        loads,
        work=max(done.course.work, 1),
        window=done.window,
        health={"energy_residual": done.energy},
        findings=(*done.findings, *findings_of(spec, scene, loads)),
        events=done.events,
        histories=done.histories,
        failures=failures_of(spec, scene, loads),
    )


def valid(spec: Travelling, scene: Moving) -> Criterion | None:
    """Out of range where the file leaves out the pull of the load on a crane that a torque drives; and of a crane with
    nothing on its rope whose motor has a curve: what swings is simulated, and nothing does.

    **Range** every start and stop.
    **Error** none: the file tells.
    **Source** the equations of crane and load, which have that pull.
    """
    motion = motion_of(spec, scene)
    if not motion.load and follows_curve(spec, scene):
        return Criterion("m/m_t", 1.0, 1.0, "no load is suspended: give the mass of the hook block", "the file")
    if motion.reacts or motion.ramp is not None or not motion.load:
        return None
    return Criterion("M/m_t", 1.0, 1.0, f"it always simulates `{REACTION}`, forced off in the file", "the file")


SWAY_SIMULATED: Solver[Travelling, Moving] = Solver(
    name="sway_simulated",
    title="finite-angle sway with motor curve and gear, time integration",
    fidelity=Fidelity.TRANSIENT,
    scenes=MOVING_SCENES,
    represents=IN_PLANE | {LARGE, CURVE},
    gives=MOVING,
    run=run,
    cost=lambda spec, scene, carried, level: 0.01 + 2e-3 * min(turns(spec, scene), 1e6) * (1 + level),
    source="plane pendulum under a driven crane; Radau collocation, ptmcalc.numerics.pendulum.swing",
    valid=valid,
    always=frozenset({SWAY, LARGE, CURVE}),
    levels=len(TOLERANCES),
)
