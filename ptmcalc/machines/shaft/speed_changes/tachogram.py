"""The exact tachogram of run-up and run-out, from event to event."""

import math
from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Failure, Finding, Found, History, Result
from ptmcalc.contract.solver import Fidelity, Solver, always_valid
from ptmcalc.machines.shaft.machine.cases import cycle_of, inertia_forced_off, machine_in
from ptmcalc.machines.shaft.machine.model import Machine
from ptmcalc.machines.shaft.machine.results import bar, result_of
from ptmcalc.machines.shaft.machine.spec import RunOut, RunUp, Shaft
from ptmcalc.machines.shaft.speed_changes import motion, speed_quadrature, worst
from ptmcalc.machines.shaft.speed_changes.cases import (
    Departure,
    departure,
    is_braked,
    mean_torque,
    target_speed,
    wanted_stop,
)
from ptmcalc.machines.shaft.speed_changes.failures import never_up, not_held
from ptmcalc.machines.shaft.speed_changes.loads import ANGULAR_ACCELERATION, OF_RUN_OUT, OF_RUN_UP
from ptmcalc.machines.shaft.speed_changes.works import works_of

_SEPARATE = 150
"""Cycles [1] assumed to be simulated one by one in the predicted time; of more, most are skipped. A numerical choice:
it affects the predicted time only, hence the order of the runs. No load depends on it."""
_SLACK = 1e-3
"""Share of what holds a shaft by which weights have to exceed it: runs from some angles end at one known as closely."""

# -- run-up ---------------------------------------------------------------------------------------------------------


def run_up(spec: Shaft, scene: RunUp, carried: frozenset[str], level: int) -> Result:
    """Time and angle of a run-up from the equation of motion.

        phi' = w,   w' = (D(w, t) - R(phi) - b w - J' w^2/2)/J(phi)

    Radau collocation with 11 nodes in time, divided at every discontinuity of the angle, time and stage of the motor,
    corner of its curve or of the gear, and at the target speed; whole cycles in one step over the angle if the time has
    no influence.

    **Range** rigid links, one degree of freedom, rotation in one sense.
    **Error** twice the difference to the same run with 7 nodes and a tolerance ten thousand times wider, and 1e-10 for
    rounding. If the work balance, by a separate quadrature, has an error above 1e-8, there is no result.
    **Source** Radau IIA: Hairer and Wanner, Solving ordinary differential equations II; derived in `numerics.passage`.
    """
    machine, target = machine_in(spec, scene), target_speed(spec, scene)
    if "varying_inertia" not in carried:
        machine = machine.with_mean_inertia()
    loads = {
        name: Found(Estimate.exact(value)) for name, value in speed_quadrature.at_rest(machine, scene.start).items()
    }
    if _settles_below(spec, scene, machine, target, mean_inertia="varying_inertia" not in carried):
        never = {name: Found(Estimate.exact(math.inf)) for name in ("run_up_time", "run_up_angle")}
        return Result(loads | never, work=1, failures=never_up(spec, machine, target))
    fine, rough = (motion.run_up(machine, scene.start, target, setting) for setting in motion.ORDERS)
    for name in ("run_up_time", "run_up_angle"):
        value, other = (getattr(one, name.removeprefix("run_up_")) for one in (fine, rough))
        loads[name] = Found(bar(value, other))
    steps = sum(len(part.steps) for part in fine.parts)
    books = works_of(fine) if fine.parts else None
    window = fine.time if fine.finished else None
    result = result_of(loads, books, fine.work + rough.work, steps, window, lambda: _histories(fine, "run_up"))
    if fine.finished or rough.finished:
        return result
    return replace(result, failures=never_up(spec, machine, target))


def _settles_below(spec: Shaft, scene: RunUp, machine: Machine, target: float, *, mean_inertia: bool) -> bool:
    """Whether the steady cycle under the load of the run-up stays below the speed asked for: motions over the angle do
    not cross, so the one from rest never comes above it."""
    if len(machine.drive.stages) > 1:
        return False
    try:
        cycle = cycle_of(spec, scene.load, mean_inertia=mean_inertia)
    except NumericsError:
        return False
    return cycle is not None and math.sqrt(2 * cycle.orbit.extremes()[1][0]) < target * (1 - 1e-9)


# -- run-out --------------------------------------------------------------------------------------------------------


def run_out(spec: Shaft, scene: RunOut, carried: frozenset[str], level: int) -> Result:
    """Time and angle of a stop, and the required brake torque, from the equation of motion.

        phi' = w,   w' = -(R(phi) + b w + M_b(t) + J' w^2/2)/J(phi)

    The stop begins in the exact steady cycle, at the angle of the file or at the worst one (`machines.shaft.worst`).
    Radau collocation as in a run-up, divided at the times of the brake and at standstill. The brake torque for the
    required stop is a root of the same runs.

    **Range** rigid links, one degree of freedom, rotation in one sense: the run ends at standstill.
    **Error** twice the difference to the same run with 7 nodes and a tolerance ten thousand times wider, and 1e-10 for
    rounding; for the worst angle, the error between the sampled angles. If the work balance, by a separate quadrature,
    has an error above 1e-8, there is no result.
    **Source** Radau IIA: Hairer and Wanner, Solving ordinary differential equations II; derived in `numerics.passage`.
    """
    start, braked = departure(spec, scene), is_braked(spec, scene)
    if "varying_inertia" not in carried:
        start = start.with_mean_inertia()
    loads: dict[str, Found] = {}
    work, search = start.cycle.work, None
    if scene.start is not None or not braked:
        angle = start.largest_energy()[1] if scene.start is None else scene.start
        speed = start.cycle.speed_at(angle)
        fine, rough = (motion.run_out(start.machine, angle, speed, setting) for setting in motion.ORDERS)
        for name in ("run_out_time", "run_out_angle"):
            value, other = (getattr(one, name.removeprefix("run_out_")) for one in (fine, rough))
            loads[name] = Found(bar(value, other), {"angle": angle})
        work += fine.work + rough.work
        governing = fine
    else:
        search = worst.Search(start)
        longest, farthest = search.worst(worst.TIME), search.worst(worst.ANGLE)
        loads["run_out_time"] = Found(longest.value, {"angle": longest.angle})
        loads["run_out_angle"] = Found(farthest.value, {"angle": farthest.angle})
        governing, angle = farthest.run, farthest.angle
    unsure = loads["run_out_angle"].estimate
    loads |= _energies(start, governing, (unsure.high - unsure.value) / unsure.value if unsure.bounded else 0.0)
    wanted = wanted_stop(spec, scene)
    if wanted:
        needed, used = worst.torque_needed(start, wanted, scene.start, search)
        loads["brake_torque_needed"] = Found(needed)
        work += used
    work += search.work if search else 0
    books = works_of(governing) if governing.parts else None
    steps = sum(len(part.steps) for part in governing.parts)
    window = governing.time if governing.finished else None
    result = result_of(loads, books, work, steps, window, lambda: _histories(governing, "run_out"))
    remarks, failures = _turned_again(spec, scene, [governing, *(search.runs if search else ())])
    return replace(result, findings=(*result.findings, *remarks), failures=tuple(failures))


def _histories(run: motion.Run, stage: str) -> dict[str, History]:
    """The tachogram: angle, speed and acceleration over time."""
    if not run.parts:
        return {}
    time, angle, speed, acceleration = (values.tolist() for values in run.course())
    found = {
        f"{stage}_time": History(units.ANGULAR_SPEED, time, speed),
        f"{stage}_angle": History(units.ANGLE, time, angle),
    }
    if stage == "run_up":
        found["acceleration_starting"] = History(ANGULAR_ACCELERATION, time, acceleration)
    return found


def _energies(start: Departure, run: motion.Run, unsure: float) -> dict[str, Found]:
    """Kinetic energy and speed at the beginning, and what the brake takes in a run, through the gear; `unsure` is the
    share by which the run may not be the worst."""
    loads = start.beginning()
    if run.finished and run.parts:
        value = works_of(run).brake * start.machine.drive.reverse_efficiency
        loads["energy_recoverable"] = Found(
            Estimate.within(value, (1e-9 + unsure) * abs(value)), {"angle": run.begin.angle}
        )
    return loads


def _rolls_back(run: motion.Run) -> tuple[float, float]:
    """Torque of weights and springs where a shaft has come to rest, and what losses and brake hold there [N*m]."""
    machine = run.machine
    if not run.finished or not run.parts:
        return 0.0, 0.0
    held = machine.friction + float(machine.brake_torque(np.array([math.inf]))[0])
    return abs(float(machine.potential_torque(np.array([run.end.angle]))[0])), held


def _turned_again(spec: Shaft, scene: RunOut, runs: Iterable[motion.Run]) -> tuple[list[Finding], list[Failure]]:
    """A shaft that weights and springs turn again from where it has come to rest: the brake fails, and losses alone are
    a remark."""
    turns, held = max((_rolls_back(run) for run in runs), key=lambda pair: pair[0] - pair[1])
    if turns <= held * (1 + _SLACK):
        return [], []
    if not is_braked(spec, scene):
        message = "the losses do not hold the stopped shaft: weights and springs drive it again"
        return [Finding("NUM104", message, ("losses", "torque"))], []
    return [], not_held(spec, turns, held)


def run_up_cost(spec: Shaft, scene: RunUp, carried: frozenset[str], level: int) -> float:
    """Predicted seconds: one and a half milliseconds for a step in time, three for a whole cycle, both runs."""
    machine, target = machine_in(spec, scene), target_speed(spec, scene)
    _, torque = mean_torque(spec, scene)
    net = torque - machine.survey.static_mean
    turned = machine.kinetic_energy(0.0, target) / net if net > 0 else 0.0
    return _seconds(machine, turned)


def run_out_cost(spec: Shaft, scene: RunOut, carried: frozenset[str], level: int) -> float:
    """Predicted seconds: as of a run-up; some twenty runs to find the worst angle, ten to find the brake."""
    machine = machine_in(spec, scene)
    speed, torque = mean_torque(spec, scene)
    one = _seconds(machine, machine.kinetic_energy(0.0, speed) / torque if torque > 0 else 0.0)
    many = is_braked(spec, scene) and scene.start is None
    return one * (1 + 10 * many + 5 * bool(wanted_stop(spec, scene)))


def _seconds(machine: Machine, turned: float) -> float:
    cycles = min(turned / machine.period, _SEPARATE)  # of more, most are skipped
    return 1.5e-3 * (len(machine.corners) + 6) + 6e-3 * cycles


def _solver(name: str, title: str, scene: type[RunUp] | type[RunOut], *, mean: bool) -> Solver[Shaft, Any]:
    """The motion of one of the two scenes, with the inertia as it is or at its mean."""
    up = scene is RunUp
    return Solver(
        name=name,
        title=title,
        fidelity=Fidelity.TRANSIENT,
        scenes=frozenset({scene}),
        represents=frozenset() if mean else frozenset({"varying_inertia"}),
        gives=OF_RUN_UP if up else OF_RUN_OUT,
        run=run_up if up else run_out,
        cost=run_up_cost if up else run_out_cost,
        source="Radau collocation; derived in ptmcalc.numerics.passage",
        valid=inertia_forced_off if mean else always_valid,
    )


RUN_UP = _solver("tachogram_up", "run-up, time integration", RunUp, mean=False)
RUN_OUT = _solver("tachogram_out", "stop, time integration", RunOut, mean=False)
MEAN_RUN_UP = _solver("mean_tachogram_up", "run-up, time integration, mean inertia", RunUp, mean=True)
MEAN_RUN_OUT = _solver("mean_tachogram_out", "stop, time integration, mean inertia", RunOut, mean=True)
