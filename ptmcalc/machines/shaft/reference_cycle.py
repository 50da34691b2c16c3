"""The second method for the steady cycle of a main shaft: Runge-Kutta steps, the cycle from the root of its map.

Beside it what the second methods of a shaft share: the equation of motion, the breaks, the tolerances.
"""

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result
from ptmcalc.machines.shaft.machine.cases import machine_in
from ptmcalc.machines.shaft.machine.mechanism import FloatArray
from ptmcalc.machines.shaft.machine.model import Machine
from ptmcalc.machines.shaft.machine.spec import RunOut, RunUp, Shaft, Steady
from ptmcalc.machines.shaft.speed_changes.cases import is_braked
from ptmcalc.reference import lumped_history, two_runs

FIRST, SECOND = 1e-7, 1e-9
"""Relative tolerance of the coarse and of the fine run [1]; three times their difference is the error bar. A numerical
choice: smaller values narrow the bar and take more steps. Their ratio of 100 makes the coarse run dominate the
difference."""
_SAMPLES = 24
"""Samples of the speed in a step [1]; a parabola through three of them refines the extremes. A numerical choice: more
samples reduce the error of the extremes and cost time in proportion."""
Readings = dict[str, float]


@dataclass(frozen=True, slots=True)
class Law:
    """What drives and brakes: a stage of the motor or none, and whether the brake is on."""

    machine: Machine
    stage: int | None
    braked: bool = False

    def acceleration(
        self, angle: FloatArray, w: FloatArray, t: float, low: float = -math.inf, high: float = math.inf
    ) -> FloatArray:
        """w' at angles between two breaks of the cycle."""
        machine, drive = self.machine, self.machine.drive
        inertia, slope, static = machine.fields(angle, low, high)
        resists = static + w * (machine.viscous + slope * w / 2)
        if self.braked:
            resists = resists + float(machine.brake_torque(np.array([t]))[0])
        times = np.full(np.shape(w), t)
        motor = drive.torque(self.stage, w, times) if self.stage is not None else np.zeros(np.shape(w))
        u, rotor = drive.ratio, drive.motor_inertia

        def by(factor: float) -> FloatArray:
            return np.asarray((u * factor * motor - resists) / (inertia + factor * u * u * rotor), float)

        forward = by(drive.efficiency)
        if not drive.reverses:
            return forward
        return np.where(motor - rotor * u * forward >= 0, forward, by(1 / drive.reverse_efficiency))


def stretches(machine: Machine) -> list[tuple[float, float]]:
    """The stretches between the breaks of the cycle [rad]."""
    return list(pairwise(machine.corners.tolist()))


def _round(machine: Machine, speed: float, tolerance: float) -> tuple[float, list[tuple[float, float, Any]]]:
    """Speed a cycle later, and the stretches on the way: (e, time, integral of M^2 over time, of w over the angle).

    Raises:
        NumericsError: the shaft stalls.
    """
    from scipy.integrate import solve_ivp

    law = Law(machine, len(machine.drive.stages) - 1)
    found = []
    for low, high in stretches(machine):

        def rate(angle: float, y: FloatArray, low: float = low, high: float = high) -> list[float]:
            w = math.sqrt(2 * max(y[0], 1e-300))
            at = np.array([w])
            motor = float(machine.drive.torque(len(machine.drive.stages) - 1, at)[0])
            turning = float(law.acceleration(np.array([angle]), at, math.inf, low, high)[0])
            return [turning, 1 / w, motor**2 / w, w]

        e = speed**2 / 2
        size = tolerance * np.array([e, machine.period / speed, 1.0, machine.period * speed])
        size[2] = tolerance * machine.period / speed * float(machine.drive.torque(0, np.zeros(1))[0]) ** 2 + 1e-300
        run: Any = solve_ivp(
            rate, (low, high), [e, 0.0, 0.0, 0.0], "DOP853", rtol=tolerance, atol=1e-2 * size, dense_output=True
        )
        if not run.success or run.y[0, -1] <= 0:
            raise NumericsError("NUM102", "the shaft stalls in the second method")
        speed = math.sqrt(2 * float(run.y[0, -1]))
        found.append((low, high, run))
    return speed, found


def closed_cycle(machine: Machine, guess: float, tolerance: float) -> tuple[float, list[tuple[float, float, Any]]]:
    """The cycle that closes, by the secant of P(w) - w."""
    before, at = guess, _round(machine, guess, tolerance)[0] - guess
    speed = guess + at
    for _ in range(30):
        after, pieces = _round(machine, speed, tolerance)
        gap = after - speed
        if abs(gap) <= 10 * tolerance * speed or gap == at:
            return speed, pieces
        before, at, speed = speed, gap, speed - gap * (speed - before) / (gap - at)
        if not 0 < speed < 10 * guess:
            break
    raise NumericsError("NUM101", "the second method finds no steady cycle")


def _extremes(pieces: list[tuple[float, float, Any]]) -> tuple[float, float]:
    """Smallest and largest speed of a cycle, by parabolas through the ends of close samples."""
    lows: list[float] = []
    highs: list[float] = []
    for _, _, run in pieces:
        for start, stop in zip(run.t[:-1], run.t[1:], strict=True):
            e = run.sol(np.linspace(start, stop, _SAMPLES))[0]
            for sign, into in ((-1.0, lows), (1.0, highs)):
                top = min(max(int((sign * e).argmax()), 1), len(e) - 2)
                into.append(sign * lumped_history.summit(sign * e[top - 1 : top + 2]))
                into.append(sign * float((sign * e).max()))
    return math.sqrt(2 * min(lows)), math.sqrt(2 * max(highs))


def _of_cycle(machine: Machine, guess: float, tolerance: float) -> tuple[Readings, int]:
    _, pieces = closed_cycle(machine, guess, tolerance)
    slow, fast = _extremes(pieces)
    time, square, swept = (sum(float(run.y[k, -1]) for *_, run in pieces) for k in (1, 2, 3))
    useful, rubbed = 0.0, machine.friction * machine.period + machine.viscous * swept
    for low, high, _ in pieces:  # Gauss on every stretch
        nodes, weights = np.polynomial.legendre.leggauss(40)
        angles = (low + high) / 2 + (high - low) / 2 * nodes
        load = machine.useful_torque(angles, low, high)
        useful += float(weights @ load) * (high - low) / 2
        rubbed += machine.share * float(weights @ np.abs(load)) * (high - low) / 2
    speeds = [np.sqrt(2 * run.sol(np.linspace(low, high, 400))[0]) for low, high, run in pieces]
    motor = [np.abs(machine.drive.torque(len(machine.drive.stages) - 1, one)).max() for one in speeds]
    ends = np.abs(machine.drive.torque(len(machine.drive.stages) - 1, np.array([slow, fast])))
    found = {
        "speed_max": fast,
        "speed_min": slow,
        "speed_mean": (fast + slow) / 2,
        "irregularity": (fast - slow) / ((fast + slow) / 2),
        "torque_motor_rms": math.sqrt(square / time),
        "torque_motor_max": max(float(max(motor)), float(ends.max())),
        "work_useful": useful,
        "work_loss": rubbed,
        "work_drive": useful + rubbed,
    }
    if useful + rubbed > 0:
        found["cycle_efficiency"] = useful / (useful + rubbed)
        found["loss_factor"] = rubbed / (useful + rubbed)
    return found, sum(len(run.t) for *_, run in pieces)


def _flywheel(machine: Machine, guess: float, wanted: float, present: float, tolerance: float) -> float:
    """Inertia to be added for an irregularity, by the secant of its inverse."""

    def over(added: float) -> float:
        _, pieces = closed_cycle(machine.with_flywheel(added), guess, tolerance)
        slow, fast = _extremes(pieces)
        return wanted * (fast + slow) / 2 / (fast - slow) - 1

    if present <= wanted:
        return 0.0
    before, at = 0.0, wanted / present - 1
    added = machine.inertia_mean * (present / wanted - 1)
    for _ in range(20):
        gap = over(added)
        if abs(gap) <= 30 * tolerance or gap == at:
            return added
        before, at, added = added, gap, max(added - gap * (added - before) / (gap - at), added / 8)
    raise NumericsError("NUM101", "the second method finds no flywheel")


def steady(spec: Shaft, scene: Steady, carried: frozenset[str], level: int) -> Result:
    """Loads of the steady cycle.

        de/dphi = w'(phi, w),  e = w^2/2,   P(w) = w by the secant

    **Range** rigid links; a motor that does not stall.
    **Error** three times the difference of two runs, the second with a hundredth of the tolerance of the first.
    **Source** Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I, 2nd ed.
    """
    machine, wanted = simulated_machine(spec, scene, carried), spec.checks.irregularity
    guess = next(iter(machine.working_speeds), None)
    if guess is None:
        raise NumericsError("NUM102", "the motor does not drive the mean load: there is no initial cycle")
    found, steps = [], 0
    for tolerance in (FIRST, SECOND):
        loads, used = _of_cycle(machine, guess, tolerance)
        if wanted is not None:
            loads["flywheel_inertia"] = _flywheel(machine, guess, wanted, loads["irregularity"], tolerance)
        found.append(loads)
        steps += used
    known = two_runs.compared(*found)
    uneven, fast, slow = (known[name].estimate for name in ("irregularity", "speed_max", "speed_min"))
    bar = 2 * (fast.bar + slow.bar) / (fast.value + slow.value)  # a small difference of both
    known["irregularity"] = Found(Estimate.within(uneven.value, bar))
    return Result(known, work=steps)


def simulated_machine(spec: Shaft, scene: RunUp | Steady | RunOut, carried: frozenset[str]) -> Machine:
    """The machine in the load state of a scene, with the effects that are simulated."""
    machine = machine_in(spec, scene)
    if isinstance(scene, RunOut) and not is_braked(spec, scene):
        machine = machine.without_brake()
    return machine if "varying_inertia" in carried else machine.with_mean_inertia()
