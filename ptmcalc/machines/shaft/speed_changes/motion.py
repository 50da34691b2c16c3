"""Run-up and run-out of a shaft in time, from event to event: the tachogram.

A phase ends at a break of the angle, a time of motor or brake, a stage of the motor, a corner of its curve or of the
gear, at the speed asked for, or at rest. Angles are counted within a cycle, so that none loses digits after many turns.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.components.motor import ConverterMotor
from ptmcalc.machines.shaft.machine.model import Machine
from ptmcalc.machines.shaft.machine.steady import Law, first_grid, rate, refined
from ptmcalc.machines.shaft.speed_changes.skipping import FEWEST, Skipped, skip
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
    return _March(machine, begin, start, True, target, *setting, stage=0).run()


def run_out(machine: Machine, angle: float, speed: float, setting: tuple[int, float] = ORDERS[0]) -> Run:
    """The run-out from a speed at an angle, the drive switched off."""
    begin = State(0.0, angle % machine.period, speed)
    if speed > 0 and _never_rests(machine):
        return Run(machine, (), begin, begin, 0, False, 1, False)
    return _March(machine, begin, begin, False, None, *setting, stage=None).run()


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


@dataclass
class _March:
    """A motion on its way: where it is, and what it has passed."""

    machine: Machine
    begin: State
    state: State
    driven: bool
    target: float | None
    order: int
    tolerance: float
    stage: int | None
    """of the motor, None while it is off"""
    parts: list[Part] = field(default_factory=list)
    turns: int = 0
    work: int = 0
    before: float = -1.0
    """speed at the beginning of the cycle, below 0 where it is not one that was followed"""
    ended: bool = False
    finished: bool = False
    grid: Grid | None = None
    """stretches of the cycle before"""
    skipping: bool = True
    """whether many cycles at once are tried"""
    since: int = 0
    """cycles since they last were"""
    followed: int = 0
    """cycles one by one"""

    def run(self) -> Run:
        """The motion to its end."""
        times = _times(self.machine, self.driven)
        while not self.ended:
            if self.stage is not None:
                self.stage = _stage_at(self.machine, self.state.time, self.state.speed, self.stage)
            until = next((time for time in times if time > self.state.time), math.inf)
            cycle_begins = self.state.angle == 0.0 and until == math.inf and self.state.speed > 0
            if not (cycle_begins and self._whole_cycles()):
                self._phase(until)
        parts = tuple(self.parts)
        return Run(self.machine, parts, self.begin, self.state, self.turns, self.finished, self.work, self.driven)

    def _whole_cycles(self) -> bool:
        """Goes on over the angle by many cycles, or by one; False where the next one is to be followed in time."""
        once = partial(_whole_cycle, self.machine, self.stage, self.target, self.order)
        if self.skipping:
            many = _many_cycles(once, self.machine, self.state, self.stage, self.target, self.order)
            if many is not None:
                self._skip(many)
                return True
            self.skipping = False
        whole = once(self.state.speed**2 / 2, self.grid)
        if whole is None:
            return False
        self._pass(*whole)
        return True

    def _skip(self, many: Skipped) -> None:
        """Goes on by many cycles at once."""
        self.parts.append(Part((), self.stage, 0.0, self.machine.period, None, many, self.state.time))
        self.work += 50 * len(many.orbits) * many.orbits[0].grid.angles.size
        self.turns += many.cycles
        self.state = State(self.state.time + many.duration, 0.0, math.sqrt(2 * many.energy))
        self.before = -1.0

    def _pass(self, orbit: Orbit, lasted: float) -> None:
        """Goes on by one cycle; one that does not change the speed is the last."""
        self.grid = orbit.grid if len(orbit.start) < _MOST_KEPT else None
        self.parts.append(Part((), self.stage, 0.0, self.machine.period, orbit, None, self.state.time))
        self.since += 1
        if self.since >= _TRIED_AGAIN:
            self.skipping, self.since = True, 0
        self.work += 5 * orbit.grid.angles.size
        speed = math.sqrt(2 * float(orbit.within([1.0])[-1, 0]))
        self.turns, self.followed = self.turns + 1, self.followed + 1
        if _gone_on(self.followed, self.driven) or abs(speed - self.state.speed) <= _SETTLED * speed:
            self.ended = True
            return
        self.state = State(self.state.time + lasted, 0.0, speed)
        self.before = speed

    def _phase(self, until: float) -> None:
        """Goes on in time to the end of the phase."""
        machine = self.machine
        low, high = _between(machine.corners, self.state.angle)
        here = _Setting(self.stage, low, high, until)
        phase = Phase(_net(machine, here), _marks(machine, here, self.target), until, high)
        done = follow(phase, self.state, self.order, self.tolerance)
        self.parts.append(Part(done.steps, self.stage, low, high))
        self.work += done.evaluations
        end = self.state = done.end
        if done.reason == TIME:
            self.state = State(until, end.angle, end.speed)
            # it may stop at the very moment the brake changes
            if not self.driven and end.speed <= _AT_REST * self.begin.speed:
                self._end(State(until, end.angle, 0.0), finished=True)
        elif done.reason == ANGLE and high == machine.period:
            self._next_cycle(until)
        elif done.reason == _REST:
            self._end(State(end.time, end.angle, 0.0), finished=not self.driven)
        elif done.reason == _TARGET:
            self._end(State(end.time, end.angle, float(self.target or 0.0)), finished=True)
        elif done.reason == _STAGE and self.stage is not None:
            self.stage += 1

    def _next_cycle(self, until: float) -> None:
        """Counts a cycle that was followed in time; one that does not change the speed is the last."""
        self.state = State(self.state.time, 0.0, self.state.speed)
        self.turns, self.followed = self.turns + 1, self.followed + 1
        settled = abs(self.state.speed - self.before) <= _SETTLED * self.state.speed and until == math.inf
        if settled or _gone_on(self.followed, self.driven):
            self.ended = True
            return
        self.before = self.state.speed

    def _end(self, state: State, *, finished: bool) -> None:
        self.state, self.finished, self.ended = state, finished, True
