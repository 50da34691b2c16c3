"""Second methods for a travelling crane, of other coordinates and other steps than its solvers; no plan offers them.

Shared with the solvers: what the file comes to (`model`, `moving`), and how loads are read from the states a crane goes
through (`reading`). Equations, gear, brakes, rests and limits are of their own (`cartesian`).
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.components.motor import ConverterMotor
from ptmcalc.components.motor_stage import Stage
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.crane.travelling.machine import model
from ptmcalc.machines.crane.travelling.machine.loads import MOVING
from ptmcalc.machines.crane.travelling.machine.model import filled
from ptmcalc.machines.crane.travelling.machine.scenes import Moving
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.reference_events import OF_EVENTS
from ptmcalc.machines.crane.travelling.sway import cartesian
from ptmcalc.machines.crane.travelling.sway.cartesian import Force, Journey, Mode, Numbers, Seen, no_force
from ptmcalc.machines.crane.travelling.sway.course import Course, Reading, Worst
from ptmcalc.machines.crane.travelling.sway.effects import CURVE, IN_PLANE, LARGE, MOVING_SCENES, SWAY
from ptmcalc.machines.crane.travelling.sway.moving import Motion, motion_of, stalls
from ptmcalc.machines.crane.travelling.sway.reading import loads_of
from ptmcalc.machines.crane.travelling.sway.simulated import turns
from ptmcalc.reference import lumped, two_runs

_AFTER = 1.2
"""Periods of the swing that are looked at after the start or stop."""
_LONGEST = 12.0
"""Times as long as with a load that does not swing a start or stop may take."""
_SLOWEST = 1e-6
"""Least speed over sqrt(g L): tolerances are shares of the rope's length."""


@dataclass(frozen=True, slots=True)
class _Course(Course):
    """A course whose extremes are looked up in what was seen."""

    seen: Seen | None = None
    wind: float = 0.0

    def extreme(self, of: Reading, largest: bool) -> Worst:
        assert self.seen is not None
        sign = 1 if largest else -1
        value, _, rows = self.seen.top(lambda rows: sign * np.asarray(of(cartesian.state_of(rows, self.wind)), float))
        return Worst(Estimate.exact(sign * value), "", cartesian.state_of(rows[:, None], self.wind))


def run(spec: Travelling, scene: Moving, carried: frozenset[str], level: int) -> Result:
    """A complete start or stop with the load in Cartesian coordinates, computed twice.

        d'' = g + f/M - x'' e + lambda d,   (m + k m_r) x'' = k F - W - M (lambda d).e

    **Range** as the simulated start: a taut massless rope, one plane, wheels without slip.
    **Error** three times the difference of two runs, the second with a hundredth of the tolerance of the first and
    shorter steps; extremes by refined sampling around the maximum of 17 samples per step.
    **Source** the load's equation with the rope as a constraint; Hairer, Nørsett and Wanner, Solving Ordinary
    Differential Equations I, 2nd ed.
    """
    found, steps, end = [], 0, 0.0
    for tolerance in lumped.TOLERANCES[level : level + 2]:
        course = _travelled(spec, scene, CURVE in carried, tolerance)
        found.append({name: one.estimate.value for name, one in loads_of(spec, scene, course).items()})
        assert course.seen is not None
        journey = course.seen.journey
        steps, end = steps + len(journey.steps), journey.time
    return Result(two_runs.compared(*found), work=steps, window=(0.0, end))


def _travelled(spec: Travelling, scene: Moving, curve: bool, tolerance: float) -> _Course:
    motion = motion_of(spec, scene)
    journey = Journey(_numbers(spec, scene, motion), tolerance, 0.0 if motion.starts else motion.speed)
    most = _LONGEST * (motion.rigid_time + motion.rising + motion.delay + motion.rise)
    limited = _limited(spec, motion) if curve else None
    if motion.ramp is not None:
        ramp = motion.ramp if motion.starts else -motion.ramp
        journey.go(Mode(ramp, no_force, 1), motion.speed / motion.ramp)
        there = True
    elif not motion.starts:
        there = journey.freely(no_force, most, rest_ends=True)
    elif limited is not None:
        there = journey.following(motion.speed, *limited, most, full_ends=True)
    else:
        there = False
        for force, speed, until in _forces(spec, motion, curve):
            there = journey.freely(force, min(until, most), speed) and speed == motion.speed
            if there:
                break
    if not there:
        raise NumericsError("NUM103", f"the crane does not reach its speed or standstill by {most:.3g} s")
    reached, way = journey.time, float(journey.state[0])
    begins = max(reached, motion.hoist_time)
    left = 0.0
    for until in (begins, begins + _AFTER * 2 * math.pi * math.sqrt(_last_length(motion) / motion.gravity)):
        if motion.ramp is None and not motion.starts:
            journey.freely(no_force, until)
        elif limited is not None:
            journey.following(motion.speed, *limited, until, full_ends=False)
        else:
            journey.state[1] = motion.speed if motion.starts else 0.0
            journey.go(Mode(0.0, no_force, int(motion.starts)), until)
        left = cartesian.amplitude(journey) if until == begins else left
    seen = Seen.of(journey)
    hangs = float(motion.load > 0)
    if motion.wind_on_load:
        ahead = seen.top(lambda rows: rows[cartesian.ANGLE], begins)[0]
        left = (ahead + seen.top(lambda rows: -rows[cartesian.ANGLE], begins)[0]) / 2
    return _Course(
        Estimate.exact(reached),
        Estimate.exact(way),
        Estimate.exact(hangs * seen.top(lambda rows: np.abs(rows[cartesian.ANGLE]))[0]),
        Estimate.exact(hangs * left),
        (),
        len(journey.steps),
        seen=seen,
        wind=motion.wind,
    )


def _last_length(motion: Motion) -> float:
    return motion.length - motion.hoisting * motion.hoist_time


def _numbers(spec: Travelling, scene: Moving, motion: Motion) -> Numbers:
    """What the file comes to, for the equations."""
    drive, ratio = spec.drive, model.rim_ratio(spec)
    slope = motion.slope
    own = sum(body.mass for body in model.bodies(spec, 0.0))
    blown = motion.wind_on_load / motion.load if motion.load else 0.0
    brake = drive.brake if not motion.starts and motion.ramp is None else None
    return Numbers(
        body=motion.body,
        turning=motion.body + model.driven_wheels(spec) * filled(spec.wheels.inertia) / model.radius(spec) ** 2,
        rotor=drive.inertia * ratio**2,
        forward=drive.efficiency,
        reverse=drive.reverse_efficiency,
        rolling=motion.rolling,
        outside=motion.wind_on_body + own * motion.gravity * math.sin(slope),
        load=motion.load,
        down=(-motion.gravity * math.sin(slope) - blown, -motion.gravity * math.cos(slope)),
        plumb=-slope,
        gravity=motion.gravity,
        length=motion.length,
        hoisting=motion.hoisting,
        hoisted=motion.hoist_time,
        brake=brake.torque * ratio if brake is not None else 0.0,
        delay=brake.delay if brake is not None else 0.0,
        rise=brake.rise_time if brake is not None else 0.0,
    )


def _limited(spec: Travelling, motion: Motion) -> tuple[float, float] | None:
    """Of a converter that starts the crane: how long its reference rises, and the limit of the force."""
    curve = spec.drive.motor.curve
    if motion.ramp is not None or not motion.starts or not isinstance(curve, ConverterMotor):
        return None
    return curve.ramp_time, spec.drive.motor.count * curve.limit * model.rim_ratio(spec)


def _forces(spec: Travelling, motion: Motion, curve: bool) -> Iterator[tuple[Force, float, float]]:
    """Forces of the motors in front of the gear over the speed, and the speed or time at which each of them ends."""
    motor, ratio = spec.drive.motor, model.rim_ratio(spec)
    if motor.curve is None or not curve:
        mean = spec.drive.torque * ratio
        yield lambda speed: mean, motion.speed, math.inf
        return
    for stage in motor.curve.stages:
        until = math.inf if stage.until_time is None else stage.until_time
        over = math.inf if stage.until_speed is None else stage.until_speed / ratio
        yield _law(stage, motor.count * ratio, ratio), min(over, motion.speed), until
        if over >= motion.speed and stage.until_time is None:
            return


def _law(stage: Stage, many: float, ratio: float) -> Force:
    return lambda speed: many * float(stage.torque(np.array([speed * ratio]))[0])


def cost(spec: Travelling, scene: Moving, carried: frozenset[str], level: int) -> float:
    """Seconds predicted from the swings of the load in the time that is looked at."""
    return 0.04 + 1.5e-3 * (1 + level) * min(turns(spec, scene), 1e6)


def comes_about(spec: Travelling, scene: Moving) -> Criterion | None:
    """Whether the start or stop comes about, with rope left, fast enough to be told from steps along the rope.

        1 where motors or brakes are too weak, or all rope is hoisted;   1e-6 sqrt(g L)/v else

    **Range** any crane.
    **Error** none.
    **Source** the file.
    """
    motion = motion_of(spec, scene)
    weak = motion.ramp is None and motion.starts and motion.least_force <= motion.rolling + motion.outside
    if stalls(motion) or weak:
        return Criterion("stall", 1.0, 1.0, "a start or stop that never ends", "balance of forces")
    if not motion.hoist_time < math.inf or _last_length(motion) <= 0:
        return Criterion("rope", 1.0, 1.0, "no rope left at the end of hoisting", "the file")
    slow = _SLOWEST * math.sqrt(motion.gravity * motion.length) / motion.speed
    return Criterion("speed", slow, 1.0, "speed limit of steps along the rope / crane speed", "cost")


SWAY_CARTESIAN: Solver[Travelling, Moving] = Solver(
    name="sway_cartesian",
    title="start or stop, Cartesian load, Runge-Kutta (reference)",
    fidelity=Fidelity.TRANSIENT,
    scenes=MOVING_SCENES,
    represents=IN_PLANE | {LARGE, CURVE},
    gives=MOVING,
    run=run,
    cost=cost,
    source="rope as a constraint force; Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I",
    valid=comes_about,
    always=frozenset({SWAY, LARGE, CURVE}),
    levels=2,
)

REFERENCE_METHODS: tuple[Solver[Travelling, Any], ...] = (SWAY_CARTESIAN, *OF_EVENTS)
