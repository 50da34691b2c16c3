"""The step table of the textbook: shown beside the exact tachogram, never judged."""

import math
from collections.abc import Callable

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, History, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.shaft.machine.cases import machine_in
from ptmcalc.machines.shaft.machine.model import Machine
from ptmcalc.machines.shaft.machine.spec import RunOut, RunUp, Shaft
from ptmcalc.machines.shaft.speed_changes import run_up_bounds
from ptmcalc.machines.shaft.speed_changes.cases import departure, target_speed
from ptmcalc.numerics.steps import Table, step_table

Scene = RunUp | RunOut

_TURN_SHARE, _RATE_SHARE = 0.02, 0.1
"""Time step as a share of a turn at the largest speed, and of the time constant of motor and shaft [1]; lecture notes
Kramatorsk, chapter 6, section on accuracy. Smaller values reduce the first-order error and raise the number of steps.
The table decides no verdict."""
_MOST_STEPS = 1500
"""Steps of the table [1] above which it is not computed. A numerical choice: a smaller value omits the table of slow
machines, a larger one allows longer runs. No verdict depends on it."""


def run(spec: Shaft, scene: Scene, carried: frozenset[str], level: int) -> Result:
    """Time and angle of a run-up or a stop by steps of constant acceleration (6.1).

        w_(i+1) = w_i + eps_i dt,   phi_(i+1) = phi_i + w_i dt + eps_i dt^2/2

    with dt = min(0.02 2 pi/w, 0.1 J/|dM/dw|) at the maximum speed and the steepest decrease of the motor curve.

    **Range** any machine that reaches the end of its motion in 1500 steps.
    **Error** first order: the difference to steps of twice the length (Richardson) is shown as its bar; it is no bound
    and never decides.
    **Source** lecture notes Kramatorsk, chapter 6; step size from its section on accuracy.
    """
    if isinstance(scene, RunUp):
        machine, names = machine_in(spec, scene), ("run_up_time", "run_up_angle")
        begin, speed, until = scene.start, 0.0, target_speed(spec, scene)
    else:
        start, names = departure(spec, scene), ("run_out_time", "run_out_angle")
        machine = start.machine
        begin = start.largest_energy()[1] if start.angle is None else start.angle
        speed, until = start.cycle.speed_at(begin), 0.0
    rate = acceleration(machine, driven=isinstance(scene, RunUp))
    step = step_size(machine, max(speed, until))
    fine, coarse = (step_table(rate, begin, speed, until, dt, _MOST_STEPS) for dt in (step, 2 * step))
    if not fine.reached or not coarse.reached:
        raise NumericsError("NUM103", f"the step table does not end within {_MOST_STEPS} steps")
    loads = {name: _found(fine, coarse, k) for k, name in enumerate(names)}
    work = fine.steps + coarse.steps
    return Result(loads, work=work, window=(0.0, fine.time), histories=lambda: _histories(fine, names))


def _histories(table: Table, names: tuple[str, str]) -> dict[str, History]:
    """The tachogram by the lines of the table: speed and angle over time."""
    times, angles, speeds = (list(column) for column in zip(*table.lines, strict=True))
    return {
        names[0]: History(units.ANGULAR_SPEED, times, speeds),
        names[1]: History(units.ANGLE, times, angles),
    }


def _found(fine: Table, coarse: Table, which: int) -> Found:
    value, rough = ((table.time, table.angle)[which] for table in (fine, coarse))
    return Found(Estimate.within(value, abs(value - rough)))


def acceleration(machine: Machine, *, driven: bool) -> Callable[[float, float, float], float]:
    """The acceleration at a time, an angle and a speed, with the motor on or the brake [rad/s^2]."""
    corners, drive = machine.corners, machine.drive

    def rate(time: float, angle: float, speed: float) -> float:
        place = np.array([angle % machine.period])
        cell = min(int(np.searchsorted(corners, place[0] + 1e-12, side="right")) - 1, len(corners) - 2)
        inertia, slope, static = machine.fields(place, corners[cell], corners[cell + 1])
        w, at = np.array([speed]), np.array([time])
        resistance = static + machine.viscous * w + slope * w**2 / 2
        if driven:
            torque = drive.torque(run_up_bounds.stage_at_speed(machine, speed), w, at)
        else:
            torque, resistance = np.zeros(1), resistance + machine.brake_torque(at)
        factor = drive.factor(torque, inertia, resistance)
        net = drive.ratio * factor * torque - resistance
        return float((net / machine.total_inertia(inertia, factor))[0])

    return rate


def step_size(machine: Machine, speed: float) -> float:
    """The step the textbook asks for [s]."""
    drive = machine.drive
    w = np.linspace(0.0, speed, 65)
    slopes = [np.abs(drive.slope(k, w)).max() for k in range(len(drive.stages))]
    steepest = drive.ratio * drive.efficiency * float(max(slopes)) + machine.viscous
    inertia = machine.survey.inertia_mean + drive.ratio**2 * drive.motor_inertia
    by_rate = _RATE_SHARE * inertia / steepest if steepest > 0 else math.inf
    return min(_TURN_SHARE * 2 * math.pi / speed, by_rate)


def valid(spec: Shaft, scene: Scene) -> Criterion:
    """Number of steps over what the table may have, as far as the mean torque tells.

    **Range** any machine; a motor that stalls, or whose torque depends on the time, is beyond it.
    **Error** an estimate from the mean values.
    **Source** the step of the textbook.
    """
    machine = machine_in(spec, scene)
    survey, drive = machine.survey, machine.drive
    inertia = survey.inertia_mean + drive.ratio**2 * drive.motor_inertia
    ratio = math.inf
    if isinstance(scene, RunOut) and not _departs(spec, scene):
        return Criterion("n", ratio, 1.0, "number of steps / maximum number of steps", "step of the textbook")
    if isinstance(scene, RunUp):
        target = target_speed(spec, scene)
        if not drive.time_dependent:
            time, _ = run_up_bounds.start_integrals(machine, target, inertia, survey.static_mean, 0.0)
            ratio = time / step_size(machine, target) / _MOST_STEPS
    else:
        speed = next(iter(machine.working_speeds), None) or drive.free_speed
        torque = survey.static_mean + (machine.brake_torque(np.array([math.inf]))[0] if scene.brake != "off" else 0.0)
        delay = machine.brake.delay + machine.brake.rise if machine.brake else 0.0
        if speed and torque > 0:
            ratio = (inertia * speed / torque + delay) / step_size(machine, speed) / _MOST_STEPS
    return Criterion("n", ratio, 1.0, "number of steps / maximum number of steps", "step of the textbook")


def _departs(spec: Shaft, scene: RunOut) -> bool:
    """Whether there is a steady cycle a run-out can begin in."""
    try:
        departure(spec, scene)
    except NumericsError:
        return False
    return True


STEP_TABLE: Solver[Shaft, Scene] = Solver(
    name="step_table",
    title="textbook step table",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({RunUp, RunOut}),
    represents=frozenset({"varying_inertia"}),
    gives=frozenset({"run_up_time", "run_up_angle", "run_out_time", "run_out_angle"}),
    run=run,
    cost=lambda spec, scene, carried, level: 5e-3,
    source="lecture notes Kramatorsk, chapter 6",
    valid=valid,
    decides=False,
)
