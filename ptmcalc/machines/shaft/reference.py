"""The second method for a main shaft: Runge-Kutta steps, the cycle from the root of its map; no plan offers it.

    phi' = w,   w' = (u k M - R - b w - J' w^2/2)/(J + k u^2 J_m),   k by the direction of the power through the gear

Shared with the solvers: the numbers of the machine (`model.Machine`: inertia, torques over the angle, curve of the
motor, brake over time) and a first guess of the speed. Equations, breaks, the cycle, its flywheel and the worst angle
of a stop are its own.
"""

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.shaft.machine.cases import machine_for, machine_in
from ptmcalc.machines.shaft.machine.mechanism import FloatArray
from ptmcalc.machines.shaft.machine.model import Machine
from ptmcalc.machines.shaft.machine.spec import RunOut, RunUp, Shaft, Steady
from ptmcalc.machines.shaft.reference_cycle import (
    FIRST,
    SECOND,
    Law,
    closed_cycle,
    simulated_machine,
    steady,
    stretches,
)
from ptmcalc.machines.shaft.speed_changes.cases import is_braked, target_speed
from ptmcalc.reference import lumped_history, two_runs

_ANGLES, _NARROWINGS = 32, 2
"""Starting angles of a batch of stops, and further batches around the worst one [1]. A numerical choice: fewer angles
may miss the worst peak, fewer batches widen the error bar. More cost time in proportion."""
_STEPS = (45, 90)
"""Steps of a turn in the runs of a stop from many angles at once."""
_MOST_CYCLES = 60.0
"""Cycles of a motion [1] from which the reference method is not used. A numerical choice: a smaller value refuses slow
machines, a larger one allows longer runs."""
_A_CYCLE, _A_STEP = 0.03, 7e-4
"""Predicted time [s] of a cycle by adaptive steps and of a step of a batch. An engineering choice: the values decide
only whether the reference method fits into the available time. No load depends on them."""


def run_up(spec: Shaft, scene: RunUp, carried: frozenset[str], level: int) -> Result:
    """Time and angle of a run-up, by time steps between discontinuities.

    **Range** rigid links, rotation in one sense, at most about sixty cycles.
    **Error** as `steady`.
    **Source** as `steady`.
    """
    machine, target = simulated_machine(spec, scene, carried), target_speed(spec, scene)
    found, steps = [], 0
    for tolerance in (FIRST, SECOND):
        time, angle, used = _up(machine, scene.start, target, tolerance)
        found.append({"run_up_time": time, "run_up_angle": angle})
        steps += used
    return Result(two_runs.compared(*found), work=steps)


def _up(machine: Machine, start: float, target: float, tolerance: float) -> tuple[float, float, int]:
    from scipy.integrate import solve_ivp

    time, angle, w, steps, stage = 0.0, start, 0.0, 0, 0
    drive, ranges = machine.drive, stretches(machine)
    while True:
        stage = _stage(machine, stage, time, w)
        law, this = Law(machine, stage), drive.stages[stage]
        turn = math.floor(angle / machine.period + 1e-12) * machine.period
        low, high = next(part for part in ranges if angle - turn < part[1] - 1e-12 * machine.period)
        most = target if this.until_speed is None else min(target, this.until_speed / drive.ratio)
        until = this.until_time if this.until_time is not None and stage + 1 < len(drive.stages) else 1e4

        def rate(t: float, y: FloatArray, law: Law = law, turn: float = turn, ends: Any = (low, high)) -> list[float]:
            return [y[1], float(law.acceleration(np.array([y[0] - turn]), np.array([y[1]]), t, *ends)[0])]

        def fast(t: float, y: FloatArray, most: float = most) -> float:
            return float(y[1] - most)

        def edge(t: float, y: FloatArray, at: float = turn + high) -> float:
            return float(y[0] - at)

        def stuck(t: float, y: FloatArray) -> float:
            return float(y[1])

        for event, way in ((fast, 1), (edge, 1), (stuck, -1)):
            event.terminal, event.direction = True, way  # type: ignore[attr-defined]
        run: Any = solve_ivp(
            rate, (time, until), [angle, w], "DOP853", rtol=tolerance, atol=1e-2 * tolerance * np.array([1.0, target]),
            events=(fast, edge, stuck),
        )  # fmt: skip
        steps += len(run.t)
        time, angle, w = float(run.t[-1]), float(run.y[0, -1]), float(run.y[1, -1])
        if len(run.t_events[1]):
            angle = turn + high
        if len(run.t_events[0]) and most == target:
            return time, angle - start, steps
        if len(run.t_events[0]):
            w = most * (1 + 1e-15)
        if len(run.t_events[2]) or angle - start > 2 * _MOST_CYCLES * machine.period or time >= 1e4:
            raise NumericsError("NUM102", "the shaft does not run up in the second method")


def _stage(machine: Machine, stage: int, time: float, w: float) -> int:
    stages = machine.drive.stages
    while stage + 1 < len(stages):
        one = stages[stage]
        over = one.until_speed is not None and machine.drive.ratio * w >= one.until_speed
        if not over and (one.until_time is None or time < one.until_time):
            return stage
        stage += 1
    return stage


def run_out(spec: Shaft, scene: RunOut, carried: frozenset[str], level: int) -> Result:
    """Time and angle of a stop from the steady cycle: from a given angle, or from the worst of many angles.

    **Range** rigid links, no useful load; the worst angle by refinement around the worst of 32 angles.
    **Error** three times the difference of two runs with one step and half of it, plus three times the change by the
    last refinement.
    **Source** the classical Runge-Kutta method; Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I.
    """
    machine, braked = simulated_machine(spec, scene, carried), is_braked(spec, scene)
    before = machine_for(spec, scene.after)
    guess = next(iter(before.working_speeds), None)
    if guess is None:
        raise NumericsError("NUM102", "the motor does not drive the mean load: there is no initial cycle")
    _, pieces = closed_cycle(before, guess, SECOND)
    law, steps = Law(machine, None, braked), 0
    if scene.start is not None or not braked:
        angles = np.array([scene.start if scene.start is not None else _strongest(machine, pieces)])
        coarse, fine = (_out(law, angles, _speeds(before, pieces, angles), count) for count in _STEPS)
        loads = {
            name: Found(Estimate.within(float(one[0]), 3 * abs(float(one[0] - two[0])) + 1e-9 * abs(float(one[0]))))
            for name, one, two in zip(("run_out_time", "run_out_angle"), fine[:2], coarse[:2], strict=True)
        }
        return Result(loads, work=coarse[2] + fine[2])
    found = {}
    for index, name in enumerate(("run_out_time", "run_out_angle")):
        value, bar, used = _worst(law, before, pieces, index)
        found[name] = Found(Estimate.within(value, bar))
        steps += used
    return Result(found, work=steps)


def _strongest(machine: Machine, pieces: list[tuple[float, float, Any]]) -> float:
    """The angle at which the kinetic energy is the largest, as the gear passes it on in the run-out."""
    best, at = -math.inf, 0.0
    side = machine.drive.efficiency * machine.drive.ratio**2 * machine.drive.motor_inertia
    for low, high, run in pieces:
        angles = np.linspace(low, high, 401)
        for _ in range(6):
            energies = (machine.mechanism(angles)[0] + side) * run.sol(angles)[0]
            top = int(energies.argmax())
            if energies[top] > best:
                best, at = float(energies[top]), float(angles[top])
            angles = np.linspace(angles[max(top - 1, 0)], angles[min(top + 1, 400)], 401)
    return at


def _speeds(machine: Machine, pieces: list[tuple[float, float, Any]], angles: FloatArray) -> FloatArray:
    """Speeds of the cycle at angles."""
    within = angles % machine.period
    found = np.empty_like(within)
    for low, high, run in pieces:
        inside = (within >= low) & (within <= high)
        if inside.any():
            found[inside] = np.sqrt(2 * run.sol(within[inside])[0])
    return found


def _worst(law: Law, before: Machine, pieces: list[tuple[float, float, Any]], index: int) -> tuple[float, float, int]:
    """The largest time (0) or angle (1) over all angles to begin at, with its bar."""
    period, steps = before.period, 0
    angles = np.linspace(0.0, period, _ANGLES, endpoint=False)
    tops: list[float] = []
    for _ in range(_NARROWINGS + 1):
        found = _out(law, angles, _speeds(before, pieces, angles), _STEPS[1])
        values, steps = found[0] if index == 0 else found[1], steps + found[2]
        top = int(values.argmax())
        inner = min(max(top, 1), len(values) - 2)
        tops.append(max(float(values[top]), lumped_history.summit(values[inner - 1 : inner + 2])))
        apart = float(angles[1] - angles[0])
        centre = float(angles[top])
        angles = np.linspace(centre - apart, centre + apart, _ANGLES)
    again = _out(law, angles, _speeds(before, pieces, angles), _STEPS[0])
    same = _out(law, angles, _speeds(before, pieces, angles), _STEPS[1])
    times, ways = (np.abs(one - two).max() for one, two in ((again[0], same[0]), (again[1], same[1])))
    off = float(times if index == 0 else ways)
    bar = 3 * off + 3 * abs(tops[-1] - tops[-2]) + 1e-9 * abs(tops[-1])
    return max(tops), bar, steps + again[2] + same[2]


def _out(law: Law, angles: FloatArray, speeds: FloatArray, count: int) -> tuple[FloatArray, FloatArray, int]:
    """Time and angle to rest from many angles at once, by classical steps of the fastest turn's so many parts.

    Raises:
        NumericsError: not all come to rest within the cycles that are looked at.
    """
    machine = law.machine
    step = machine.period / float(speeds.max()) / count
    phi, w = angles.copy(), speeds.copy()
    time, ended = np.full(len(phi), math.nan), phi.copy()
    now, steps = 0.0, 0
    for until in (*_brake_times(law), math.inf):
        while now < until and np.isnan(time).any():
            h = min(step, until - now)
            if until - now < 1.5 * step and until - now > step:
                h = (until - now) / 2
            inside = now + h / 2
            k, v = _classical(law, phi, w, now, h, inside)
            new_phi, new_w = phi + k, w + v
            stops = np.isnan(time) & (new_w <= 0)
            if stops.any():
                part, way = _rest(law, phi[stops], w[stops], now, h, inside)
                time[stops], ended[stops] = now + part, phi[stops] + way
            phi, w = new_phi, np.where(new_w > 0, new_w, 0.0)
            now, steps = now + h, steps + 1
            if steps > 40 * count * _MOST_CYCLES:
                raise NumericsError("NUM102", "the shaft does not come to rest in the second method")
    return time, ended - angles, steps


def _brake_times(law: Law) -> Iterator[float]:
    brake = law.machine.brake
    if law.braked and brake is not None:
        yield brake.delay
        yield brake.delay + brake.rise


def _classical(
    law: Law, phi: FloatArray, w: FloatArray, now: float, h: float, inside: float
) -> tuple[FloatArray, FloatArray]:
    """What angle and speed gain in a step; times stay inside the piece of the brake's course."""

    def rate(angle: FloatArray, speed: FloatArray, share: float) -> FloatArray:
        t = min(max(now + share * h, inside - 0.499999 * h), inside + 0.499999 * h)
        period = law.machine.period
        return law.acceleration(angle % period, speed, t)

    a1 = rate(phi, w, 0.0)
    w2 = w + h / 2 * a1
    a2 = rate(phi + h / 2 * w, w2, 0.5)
    w3 = w + h / 2 * a2
    a3 = rate(phi + h / 2 * w2, w3, 0.5)
    w4 = w + h * a3
    a4 = rate(phi + h * w3, w4, 1.0)
    return h / 6 * (w + 2 * w2 + 2 * w3 + w4), h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)


def _rest(
    law: Law, phi: FloatArray, w: FloatArray, now: float, h: float, inside: float
) -> tuple[FloatArray, FloatArray]:
    """Time into a step, and way, until the speed is 0: by the secant over steps of their own."""
    low, high = np.zeros(len(phi)), np.full(len(phi), h)
    at_low, at_high = w.copy(), np.empty(len(phi))
    for k in range(len(phi)):
        at_high[k] = (w[k : k + 1] + _classical(law, phi[k : k + 1], w[k : k + 1], now, h, inside)[1])[0]
    way = np.zeros(len(phi))
    for k in range(len(phi)):
        here = slice(k, k + 1)
        part = high[k]
        for _ in range(40):
            part = float(high[k] - at_high[k] * (high[k] - low[k]) / (at_high[k] - at_low[k]))
            gained, slowed = _classical(law, phi[here], w[here], now, part, now + part / 2)
            left = float(w[k] + slowed[0])
            way[k] = float(gained[0])
            if abs(left) <= 1e-13 * float(w[k]):
                break
            if left > 0:
                low[k], at_low[k], at_high[k] = part, left, at_high[k] / 2
            else:
                high[k], at_high[k], at_low[k] = part, left, at_low[k] / 2
        high[k] = part
    return high, way


def _turned(spec: Shaft, scene: RunUp | RunOut) -> float:
    """Cycles of a run-up or run-out of the rigid shaft with the mean torques."""
    machine = machine_in(spec, scene)
    if isinstance(scene, RunUp):
        speed, drive = target_speed(spec, scene), machine.drive
        torques = drive.torque(len(drive.stages) - 1, np.linspace(0.0, speed, 101))
        net = drive.efficiency * drive.ratio * float(np.mean(torques)) - machine.survey.static_mean
    else:
        speed = next(iter(machine_for(spec, scene.after).working_speeds), None) or machine.drive.free_speed or 1.0
        net = machine.survey.static_mean + machine.viscous * speed / 2
        if is_braked(spec, scene) and spec.brake is not None:
            net += spec.brake.torque
            return (machine.kinetic_energy(0.0, speed) / net + speed * spec.brake.delay) / machine.period
    return machine.kinetic_energy(0.0, speed) / net / machine.period if net > 0 else math.inf


def cost(spec: Shaft, scene: RunUp | Steady | RunOut, carried: frozenset[str], level: int) -> float:
    """Seconds predicted from the cycles, and how often they are run."""
    if isinstance(scene, Steady):
        return _A_CYCLE * (10 + (30 if spec.checks.irregularity is not None else 0))
    cycles = _turned(spec, scene)
    if isinstance(scene, RunUp):
        return 0.1 + 2 * _A_CYCLE * cycles
    many = 2 * (_NARROWINGS + 2) if is_braked(spec, scene) and scene.start is None else 1
    return _A_CYCLE * 6 + _A_STEP * (2 * cycles + 2) * sum(_STEPS) * many


def valid(spec: Shaft, scene: RunUp | Steady | RunOut) -> Criterion | None:
    """Whether a motion takes no more than sixty cycles, and a run-out no useful load.

        n, cycles of the rigid shaft under the mean torques

    **Range** any machine.
    **Error** an estimate, and a limit of the work.
    **Source** energy.
    """
    if isinstance(scene, Steady):
        return None
    if isinstance(scene, RunOut) and machine_in(spec, scene).useful is not None:
        return Criterion("load", 1.0, 1.0, "a useful load in the stop", "the file")
    return Criterion("n", _turned(spec, scene), _MOST_CYCLES, "cycles of the motion: too much work", "energy")


def _solver(name: str, scene: type[RunUp] | type[Steady] | type[RunOut], run: Any, gives: Mapping[str, None]) -> Any:
    return Solver(
        name=name,
        title="motion of a shaft by Runge-Kutta steps",
        fidelity=Fidelity.TRANSIENT,
        scenes=frozenset({scene}),
        represents=frozenset({"varying_inertia", "motor_slope"}),
        gives=frozenset(gives),
        run=run,
        cost=cost,
        source="Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I",
        valid=valid,
        method="Runge-Kutta",
    )


_CYCLE = (
    "speed_max", "speed_min", "speed_mean", "irregularity", "torque_motor_rms", "torque_motor_max", "work_useful",
    "work_loss", "work_drive", "cycle_efficiency", "loss_factor", "flywheel_inertia",
)  # fmt: skip
REFERENCE_METHODS: tuple[Solver[Shaft, Any], ...] = (
    _solver("runge_kutta_up", RunUp, run_up, dict.fromkeys(("run_up_time", "run_up_angle"))),
    _solver("runge_kutta_cycle", Steady, steady, dict.fromkeys(_CYCLE)),
    _solver("runge_kutta_out", RunOut, run_out, dict.fromkeys(("run_out_time", "run_out_angle"))),
)
