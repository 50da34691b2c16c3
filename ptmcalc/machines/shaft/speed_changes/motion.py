"""Run-up and run-out of a shaft in time, from event to event: the tachogram.

A phase ends at a break of the angle, a time of motor or brake, a stage of the motor, a corner of its curve or of the
gear, at the speed asked for, or at rest. Angles are counted within a cycle, so that none loses digits after many turns.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.components.motor import ConverterMotor
from ptmcalc.machines.shaft.model import Machine
from ptmcalc.machines.shaft.speed_changes.skipping import FEWEST, Skipped, skip
from ptmcalc.machines.shaft.steady import Law, first_grid, rate, refined
from ptmcalc.numerics.collocation import radau
from ptmcalc.numerics.cycle import Grid, Orbit, solve
from ptmcalc.numerics.passage import ANGLE, TIME, Phase, State, Step, follow

FloatArray = NDArray[np.float64]

ORDERS = ((11, 1e-11), (7, 1e-7))
"""Nodes and tolerance of the run that is reported and of the one its bar is read from."""
MOST_CYCLES = 200_000
"""Cycles [1] up to which a motion is skipped at once. A numerical choice: longer motions are simulated cycle by cycle
and refused after `_FOLLOWED`. A larger value accepts slower motions and costs time in proportion."""
_FOLLOWED = 400  # cycles one by one
_TRIED_AGAIN = 25
"""Cycles simulated one by one [1] after a failed skip until the next attempt. A numerical choice: an attempt costs up
to 17 cycles. Fewer repeat failed attempts; more delay the skip."""
_MOST_KEPT = 40
"""Stretches of a cycle [1] from which the next cycle begins with a new grid. A numerical choice: a smaller value
repeats refinements, a larger one keeps stretches that are no longer needed. The accuracy does not depend on it."""
_POINTS = 7  # of the course of a step or stretch
_JUST_BEFORE = 1e-15
"""Share [1] of the end time of a phase by which the brake torque is evaluated earlier. Derived from the resolution of
floating-point numbers, 2.2e-16: a few units before the end. A smaller value reads the torque behind a jump; a larger
one falsifies a rising torque."""
_NEAR_REST = 0.3  # part of the energy a whole cycle must leave
_SETTLED = 1e-12
"""Relative change of speed in a cycle [1] up to which a motion has settled and never reaches its end. A numerical
choice: it is above rounding and near the tolerance of a run, 1e-11. A larger value ends slow motions too early; a
smaller one may never apply."""
_AT_REST = 1e-13  # rounding of a speed, over that at the beginning


@dataclass(frozen=True)
class Part:
    """The steps of one phase between two breaks, or a whole cycle over the angle; in which stage of the motor (None:
    switched off)."""

    steps: tuple[Step, ...]
    stage: int | None
    low: float
    high: float
    orbit: Orbit | None = None
    skipped: Skipped | None = None
    """many cycles at once"""
    begins: float = 0.0
    """time at which the cycle begins [s]"""

    @property
    def cycles(self) -> int:
        """Cycles it ends."""
        if self.skipped is not None:
            return self.skipped.cycles
        return int(self.orbit is not None or self.steps[-1].end.angle == self.high)


@dataclass(frozen=True)
class Run:
    """A run-up or a run-out. It ends at the speed asked for, at rest, or where it would go on for ever."""

    machine: Machine
    parts: tuple[Part, ...]
    begin: State
    end: State
    turns: int
    finished: bool
    """whether it came to the speed asked for, or to rest in a run-out; else it never does"""
    work: int
    run_up: bool

    def course(self) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """The tachogram: times [s], angles turned [rad], speeds [rad/s] and accelerations [rad/s^2]."""
        columns: list[list[FloatArray]] = [[], [], [], []]
        turned, before = 0.0, self.begin.angle
        for part in self.parts:
            for found in _course(part, self.machine.period):
                time, angle, speed, acceleration = found
                for column, values in zip(columns, (time, turned + angle - before, speed, acceleration), strict=True):
                    column.append(values)
            if part.high == self.machine.period:
                turned += part.cycles * self.machine.period
        time, angle, speed, acceleration = (np.concatenate(column) for column in columns)
        return time, angle, speed, acceleration

    @property
    def time(self) -> float:
        """Duration [s]."""
        return self.end.time if self.finished else math.inf

    @property
    def angle(self) -> float:
        """Angle turned [rad]."""
        if not self.finished:
            return math.inf
        return self.turns * self.machine.period + self.end.angle - self.begin.angle


def _course(part: Part, period: float) -> Iterator[tuple[FloatArray, FloatArray, FloatArray, FloatArray]]:
    """Times, angles from the beginning of the cycle, speeds and accelerations of a part."""
    if part.skipped is not None:
        time, turns, e = (np.array(column, float) for column in zip(*part.skipped.trace, strict=True))
        rates = np.gradient(e, turns * period) if len(e) > 1 else np.zeros(len(e))
        yield part.begins + time, turns * period, np.sqrt(2 * e), rates
    places = np.linspace(0.0, 1.0, _POINTS)
    for step in part.steps:
        rule = radau(len(step.coefficients))
        yield (*step.at(places), rule.evaluate(step.coefficients, places))
    if part.orbit is not None:
        orbit = part.orbit
        low, lengths = orbit.grid.edges[:-1, None], orbit.grid.lengths[:, None]
        angle, speed = (low + lengths * places).ravel(), np.sqrt(2 * orbit.within(places)).ravel()
        rates = radau(orbit.grid.order).evaluate(orbit.slopes, places).ravel()
        time = np.concatenate([[0.0], np.cumsum(np.diff(angle) * 2 / (speed[1:] + speed[:-1]))])
        yield part.begins + time, angle, speed, rates


@dataclass(frozen=True)
class _Setting:
    """What holds in a phase: the stage of the motor (None: off), the angles it lies between, the time it ends at."""

    stage: int | None
    low: float
    high: float
    until: float

    def brake_torque(self, machine: Machine, time: FloatArray) -> FloatArray:
        """Torque of the brake, which may jump at the end of the phase but not in it."""
        return machine.brake_torque(np.minimum(time, self.until * (1 - _JUST_BEFORE)))


def _net(machine: Machine, setting: _Setting) -> Callable[[FloatArray, FloatArray, FloatArray], FloatArray]:
    """The acceleration in a phase."""
    drive, ratio = machine.drive, machine.drive.ratio

    def acceleration(time: FloatArray, angle: FloatArray, speed: FloatArray) -> FloatArray:
        inertia, slope, static = machine.fields(angle, setting.low, setting.high)
        resistance = static + speed * (machine.viscous + slope * speed / 2)
        if setting.stage is None:
            torque = np.zeros(np.shape(speed))
            resistance = resistance + setting.brake_torque(machine, time)
        else:
            torque = drive.torque(setting.stage, speed, time)
        factor = drive.factor(torque, inertia, resistance)
        return np.asarray((ratio * factor * torque - resistance) / machine.total_inertia(inertia, factor))

    return acceleration


def _marks(
    machine: Machine, setting: _Setting, target: float | None
) -> Callable[[FloatArray, FloatArray, FloatArray], FloatArray]:
    """Values whose change of sign ends a phase: standstill first, then speed asked for, stage, corners."""
    drive, stage = machine.drive, setting.stage
    until = drive.stages[stage].until_speed if stage is not None else None
    knots = drive.knots(stage) if stage is not None else np.zeros(0)
    through = drive.lossy_both_ways and (stage is not None or drive.motor_inertia > 0)

    def marks(time: FloatArray, angle: FloatArray, speed: FloatArray) -> FloatArray:
        rows = [speed]
        rows.append(np.full(speed.shape, 1.0) if target is None else target - speed)
        rows.append(np.full(speed.shape, 1.0) if until is None else until - drive.ratio * speed)
        lag = drive.lag(time) / drive.ratio if len(knots) else 0.0
        rows += [speed + lag - knot for knot in knots]
        if through:
            inertia, slope, static = machine.fields(angle, setting.low, setting.high)
            resistance = static + speed * (machine.viscous + slope * speed / 2)
            torque = np.zeros(speed.shape)
            if stage is None:
                resistance = resistance + setting.brake_torque(machine, time)
            else:
                torque = drive.torque(stage, speed, time)
            rows.append(torque + drive.motor_inertia * drive.ratio / inertia * resistance)
        return np.array(rows)

    return marks


_REST, _TARGET, _STAGE = 0, 1, 2
"""Rows of `_marks` [1]: standstill, target speed, end of the motor stage. Derived from the order of the rows; another
value assigns the wrong event."""


def _times(machine: Machine, driven: bool) -> list[float]:
    """Times at which torques change their law: of the brake after the command, of the motor after the start [s]."""
    if not driven:
        brake = machine.brake
        return sorted({brake.delay, brake.delay + brake.rise}) if brake else []
    motor = machine.drive.motor
    ramp = [motor.ramp_time] if isinstance(motor, ConverterMotor) else []
    return sorted({*ramp, *(s.until_time for s in machine.drive.stages if s.until_time is not None)})


def _stage_at(machine: Machine, time: float, speed: float, stage: int) -> int:
    """The stage of the motor at a time and a speed of the main shaft; it never goes back."""
    stages = machine.drive.stages
    while stage < len(stages) - 1:
        here = stages[stage]
        by_time = here.until_time is not None and time >= here.until_time
        by_speed = here.until_speed is not None and machine.drive.ratio * speed >= here.until_speed
        if not (by_time or by_speed):
            break
        stage += 1
    return stage


def run_up(machine: Machine, angle: float, target: float, setting: tuple[int, float] = ORDERS[0]) -> Run:
    """The run-up from rest at an angle to a speed."""
    if not machine.sound:
        raise NumericsError("NUM102", "the inertia is not above 0 at every angle")
    begin = State(0.0, angle % machine.period, 0.0)
    start = _released(machine, begin)
    if start is None:
        return Run(machine, (), begin, begin, 0, False, 1, True)
    return _march(machine, begin, start, True, target, setting)


def run_out(machine: Machine, angle: float, speed: float, setting: tuple[int, float] = ORDERS[0]) -> Run:
    """The run-out from a speed at an angle, the drive switched off."""
    begin = State(0.0, angle % machine.period, speed)
    if speed > 0 and _never_rests(machine):
        return Run(machine, (), begin, begin, 0, False, 1, False)
    return _march(machine, begin, begin, False, None, setting)


def _never_rests(machine: Machine) -> bool:
    """Whether nothing acts at rest: a shaft that is slowed by its speed alone never stops."""
    full = machine.brake.torque if machine.brake else 0.0
    survey = machine.survey
    return full == 0 and survey.static_low == 0 == survey.static_high


def _released(machine: Machine, begin: State) -> State | None:
    """When the motor's torque first exceeds what holds the shaft at rest; None if it never does."""
    corners = machine.corners
    low, high = _between(corners, begin.angle)

    def excess(time: float) -> float:
        stage = _stage_at(machine, time, 0.0, 0)
        here = (np.array([part]) for part in (time, begin.angle, 0.0))
        return float(_net(machine, _Setting(stage, low, high, math.inf))(*here)[0])

    if excess(0.0) > 0:
        return begin
    before = 0.0
    for time in _times(machine, True):
        if excess(time) > 0:
            late, early = time, before
            if excess(math.nextafter(time, 0.0)) > 0:
                for _ in range(200):
                    middle = (early + late) / 2
                    if not early < middle < late:
                        break
                    early, late = (early, middle) if excess(middle) > 0 else (middle, late)
            return State(late, begin.angle, 0.0)
        before = time
    return None


def _gone_on(followed: int, driven: bool) -> bool:
    """Whether a motion has gone on for so long that it is given up."""
    if followed >= _FOLLOWED:
        what = "run-up" if driven else "run-out"
        raise NumericsError("NUM103", f"the {what} takes more cycles than are followed one by one")
    return False


def _between(corners: FloatArray, angle: float) -> tuple[float, float]:
    """The breaks around an angle; of an angle on one, it and the next."""
    k = int(np.clip(np.searchsorted(corners, angle + 1e-12, side="right") - 1, 0, len(corners) - 2))
    return float(corners[k]), float(corners[k + 1])


def _many_cycles(
    once: Callable[[float], tuple[Orbit, float] | None],
    machine: Machine,
    state: State,
    stage: int | None,
    target: float | None,
    order: int,
) -> Skipped | None:
    """As many cycles as change the energy by a factor of 2 or take it near to that of the speed asked for."""
    e = state.speed**2 / 2
    first = once(e)
    if first is None:
        return None
    change = float(first[0].within([1.0])[-1, 0]) - e
    nodes, tolerance = (16, 1e-11) if order == ORDERS[0][0] else (12, 1e-8)
    if change < 0:
        return skip(once, e, e / 2, MOST_CYCLES, nodes, tolerance) if FEWEST * -change < e / 2 else None
    until = machine.drive.stages[stage].until_speed if stage is not None else None
    limits = [limit for limit in (target, until and until / machine.drive.ratio) if limit is not None]
    peak = float(first[0].nodes.max()) - e
    end = min([2 * e, *((limit**2 / 2) * (1 - 2e-3) - 2 * peak for limit in limits)])
    return skip(once, e, end, MOST_CYCLES, nodes, tolerance) if FEWEST * change < end - e else None


def _whole_cycle(
    machine: Machine, stage: int | None, target: float | None, order: int, e: float, before: Grid | None = None
) -> tuple[Orbit, float] | None:
    """A cycle from its beginning to its end over the angle at once, with its duration; None where it ends on the way or
    comes near to rest, so that it is to be followed in time. `before` are the stretches of the cycle before."""
    law = Law(stage, machine.brake_most if stage is None else 0.0)
    grid = first_grid(machine, order + 1) if before is None else before
    orbit = solve(grid, rate(machine, grid, law), np.full(grid.angles.shape, e), start=e)
    if orbit is None:
        return None
    nodes = orbit.nodes
    until = machine.drive.stages[stage].until_speed if stage is not None else None
    limits = [limit for limit in (target, until and until / machine.drive.ratio) if limit is not None]
    if limits and float(nodes.max()) >= min(limits) ** 2 / 2 * (1 - 1e-3):
        return None
    if float(nodes.min()) < _NEAR_REST * e:
        return None
    found = refined(machine, law, orbit, e)
    if found is None:
        return None
    _, sampled, weights = found[0].sample(18)
    return found[0], float(np.sum(weights / np.sqrt(2 * sampled)))


def _march(
    machine: Machine, begin: State, state: State, driven: bool, target: float | None, setting: tuple[int, float]
) -> Run:
    order, tolerance = setting
    times = _times(machine, driven)
    stage = 0 if driven else None
    parts: list[Part] = []
    turns = work = 0
    before = -1.0
    finished = False
    grid: Grid | None = None
    skipping, since, followed = True, 0, 0
    while True:
        low, high = _between(machine.corners, state.angle)
        if stage is not None:
            stage = _stage_at(machine, state.time, state.speed, stage)
        until = next((time for time in times if time > state.time), math.inf)
        here = _Setting(stage, low, high, until)
        if state.angle == 0.0 and until == math.inf and state.speed > 0:
            once = partial(_whole_cycle, machine, stage, target, order)
            many = _many_cycles(once, machine, state, stage, target, order) if skipping else None
            skipping = many is not None
            if many is not None:
                parts.append(Part((), stage, 0.0, machine.period, None, many, state.time))
                work += 50 * len(many.orbits) * many.orbits[0].grid.angles.size
                turns += many.cycles
                state = State(state.time + many.duration, 0.0, math.sqrt(2 * many.energy))
                before = -1.0
                continue
            whole = once(state.speed**2 / 2, grid)
            if whole is not None:
                orbit, lasted = whole
                grid = orbit.grid if len(orbit.start) < _MOST_KEPT else None
                parts.append(Part((), stage, 0.0, machine.period, orbit, None, state.time))
                since += 1
                if since >= _TRIED_AGAIN:
                    skipping, since = True, 0
                work += 5 * orbit.grid.angles.size
                speed = math.sqrt(2 * float(orbit.within([1.0])[-1, 0]))
                turns, followed = turns + 1, followed + 1
                if _gone_on(followed, driven) or abs(speed - state.speed) <= _SETTLED * speed:
                    break
                state = State(state.time + lasted, 0.0, speed)
                before = speed
                continue
        phase = Phase(_net(machine, here), _marks(machine, here, target), until, high)
        done = follow(phase, state, order, tolerance)
        parts.append(Part(done.steps, stage, low, high))
        work += done.evaluations
        state = done.end
        if done.reason == TIME:
            state = State(until, state.angle, state.speed)
            if not driven and state.speed <= _AT_REST * begin.speed:  # it stops at the very moment the brake changes
                state, finished = State(until, state.angle, 0.0), True
                break
        elif done.reason == ANGLE and high == machine.period:
            state, turns, followed = State(state.time, 0.0, state.speed), turns + 1, followed + 1
            settled = abs(state.speed - before) <= _SETTLED * state.speed and until == math.inf
            if settled or _gone_on(followed, driven):
                break
            before = state.speed
        elif done.reason == _REST:
            state, finished = State(state.time, state.angle, 0.0), not driven
            break
        elif done.reason == _TARGET:
            state, finished = State(state.time, state.angle, float(target or 0.0)), True
            break
        elif done.reason == _STAGE and stage is not None:
            stage += 1
    return Run(machine, tuple(parts), begin, state, turns, finished, work, driven)
