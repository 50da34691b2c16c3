"""The second method for a main shaft: Runge-Kutta steps, the cycle from the root of its map; no plan offers it.

    phi' = w,   w' = (u k M - R - b w - J' w^2/2)/(J + k u^2 J_m),   k by the direction of the power through the gear

Shared with the solvers: the numbers of the machine (`model.Machine`: inertia, torques over the angle, curve of the
motor, brake over time) and a first guess of the speed. Equations, breaks, the cycle, its flywheel and the worst angle
of a stop are its own.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.shaft.cases import is_braked, machine_for, machine_in, target_speed
from ptmcalc.machines.shaft.model import FloatArray, Machine
from ptmcalc.machines.shaft.spec import RunOut, RunUp, Shaft, Steady
from ptmcalc.witness import lumped

_FIRST, _SECOND = 1e-7, 1e-9
"""Relative tolerance of the coarse and of the fine run [1]; three times their difference is the error bar. A numerical
choice: smaller values narrow the bar and take more steps. Their ratio of 100 makes the coarse run dominate the
difference."""
_SAMPLES = 24
"""Samples of the speed in a step [1]; a parabola through three of them refines the extremes. A numerical choice: more
samples reduce the error of the extremes and cost time in proportion."""
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
Readings = dict[str, float]


@dataclass(frozen=True, slots=True)
class _Law:
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


def _stretches(machine: Machine) -> list[tuple[float, float]]:
    return list(pairwise(machine.corners.tolist()))


# -- the steady cycle ------------------------------------------------------------------------------------------------


def _round(machine: Machine, speed: float, tolerance: float) -> tuple[float, list[tuple[float, float, Any]]]:
    """Speed a cycle later, and the stretches on the way: (e, time, integral of M^2 over time, of w over the angle).

    Raises:
        NumericsError: the shaft stalls.
    """
    from scipy.integrate import solve_ivp

    law = _Law(machine, len(machine.drive.stages) - 1)
    found = []
    for low, high in _stretches(machine):

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


def _closed(machine: Machine, guess: float, tolerance: float) -> tuple[float, list[tuple[float, float, Any]]]:
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
                into.append(sign * lumped.summit(sign * e[top - 1 : top + 2]))
                into.append(sign * float((sign * e).max()))
    return math.sqrt(2 * min(lows)), math.sqrt(2 * max(highs))


def _of_cycle(machine: Machine, guess: float, tolerance: float) -> tuple[Readings, int]:
    _, pieces = _closed(machine, guess, tolerance)
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
        _, pieces = _closed(machine.with_flywheel(added), guess, tolerance)
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
    machine, wanted = _machine(spec, scene, carried), spec.checks.irregularity
    guess = next(iter(machine.working_speeds), None)
    if guess is None:
        raise NumericsError("NUM102", "the motor does not drive the mean load: there is no initial cycle")
    found, steps = [], 0
    for tolerance in (_FIRST, _SECOND):
        loads, used = _of_cycle(machine, guess, tolerance)
        if wanted is not None:
            loads["flywheel_inertia"] = _flywheel(machine, guess, wanted, loads["irregularity"], tolerance)
        found.append(loads)
        steps += used
    known = lumped.compared(*found)
    uneven, fast, slow = (known[name].estimate for name in ("irregularity", "speed_max", "speed_min"))
    bar = 2 * (fast.bar + slow.bar) / (fast.value + slow.value)  # a small difference of both
    known["irregularity"] = Found(Estimate.within(uneven.value, bar))
    return Result(known, work=steps)


# -- run-up ----------------------------------------------------------------------------------------------------------


def run_up(spec: Shaft, scene: RunUp, carried: frozenset[str], level: int) -> Result:
    """Time and angle of a run-up, by time steps between discontinuities.

    **Range** rigid links, rotation in one sense, at most about sixty cycles.
    **Error** as `steady`.
    **Source** as `steady`.
    """
    machine, target = _machine(spec, scene, carried), target_speed(spec, scene)
    found, steps = [], 0
    for tolerance in (_FIRST, _SECOND):
        time, angle, used = _up(machine, scene.start, target, tolerance)
        found.append({"run_up_time": time, "run_up_angle": angle})
        steps += used
    return Result(lumped.compared(*found), work=steps)


def _up(machine: Machine, start: float, target: float, tolerance: float) -> tuple[float, float, int]:
    from scipy.integrate import solve_ivp

    time, angle, w, steps, stage = 0.0, start, 0.0, 0, 0
    drive, stretches = machine.drive, _stretches(machine)
    while True:
        stage = _stage(machine, stage, time, w)
        law, this = _Law(machine, stage), drive.stages[stage]
        turn = math.floor(angle / machine.period + 1e-12) * machine.period
        low, high = next(part for part in stretches if angle - turn < part[1] - 1e-12 * machine.period)
        most = target if this.until_speed is None else min(target, this.until_speed / drive.ratio)
        until = this.until_time if this.until_time is not None and stage + 1 < len(drive.stages) else 1e4

        def rate(t: float, y: FloatArray, law: _Law = law, turn: float = turn, ends: Any = (low, high)) -> list[float]:
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


# -- run-out ---------------------------------------------------------------------------------------------------------


def run_out(spec: Shaft, scene: RunOut, carried: frozenset[str], level: int) -> Result:
    """Time and angle of a stop from the steady cycle: from a given angle, or from the worst of many angles.

    **Range** rigid links, no useful load; the worst angle by refinement around the worst of 32 angles.
    **Error** three times the difference of two runs with one step and half of it, plus three times the change by the
    last refinement.
    **Source** the classical Runge-Kutta method; Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I.
    """
    machine, braked = _machine(spec, scene, carried), is_braked(spec, scene)
    before = machine_for(spec, scene.after)
    guess = next(iter(before.working_speeds), None)
    if guess is None:
        raise NumericsError("NUM102", "the motor does not drive the mean load: there is no initial cycle")
    _, pieces = _closed(before, guess, _SECOND)
    law, steps = _Law(machine, None, braked), 0
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


def _worst(law: _Law, before: Machine, pieces: list[tuple[float, float, Any]], index: int) -> tuple[float, float, int]:
    """The largest time (0) or angle (1) over all angles to begin at, with its bar."""
    period, steps = before.period, 0
    angles = np.linspace(0.0, period, _ANGLES, endpoint=False)
    tops: list[float] = []
    for _ in range(_NARROWINGS + 1):
        found = _out(law, angles, _speeds(before, pieces, angles), _STEPS[1])
        values, steps = found[0] if index == 0 else found[1], steps + found[2]
        top = int(values.argmax())
        inner = min(max(top, 1), len(values) - 2)
        tops.append(max(float(values[top]), lumped.summit(values[inner - 1 : inner + 2])))
        apart = float(angles[1] - angles[0])
        centre = float(angles[top])
        angles = np.linspace(centre - apart, centre + apart, _ANGLES)
    again = _out(law, angles, _speeds(before, pieces, angles), _STEPS[0])
    same = _out(law, angles, _speeds(before, pieces, angles), _STEPS[1])
    times, ways = (np.abs(one - two).max() for one, two in ((again[0], same[0]), (again[1], same[1])))
    off = float(times if index == 0 else ways)
    bar = 3 * off + 3 * abs(tops[-1] - tops[-2]) + 1e-9 * abs(tops[-1])
    return max(tops), bar, steps + again[2] + same[2]


def _out(law: _Law, angles: FloatArray, speeds: FloatArray, count: int) -> tuple[FloatArray, FloatArray, int]:
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


def _brake_times(law: _Law) -> Iterator[float]:
    brake = law.machine.brake
    if law.braked and brake is not None:
        yield brake.delay
        yield brake.delay + brake.rise


def _classical(
    law: _Law, phi: FloatArray, w: FloatArray, now: float, h: float, inside: float
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
    law: _Law, phi: FloatArray, w: FloatArray, now: float, h: float, inside: float
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


# -- what it costs, and where it holds -------------------------------------------------------------------------------


def _machine(spec: Shaft, scene: RunUp | Steady | RunOut, carried: frozenset[str]) -> Machine:
    machine = machine_in(spec, scene)
    if isinstance(scene, RunOut) and not is_braked(spec, scene):
        machine = machine.without_brake()
    return machine if "varying_inertia" in carried else machine.with_mean_inertia()


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
WITNESSES: tuple[Solver[Shaft, Any], ...] = (
    _solver("runge_kutta_up", RunUp, run_up, dict.fromkeys(("run_up_time", "run_up_angle"))),
    _solver("runge_kutta_cycle", Steady, steady, dict.fromkeys(_CYCLE)),
    _solver("runge_kutta_out", RunOut, run_out, dict.fromkeys(("run_out_time", "run_out_angle"))),
)
