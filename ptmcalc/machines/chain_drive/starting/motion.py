"""A start of a chain as numbers: what the motors pull, the rigid body, and the input of its modes.

The chain starts with the tensions of its running in it, resistance as at the start: every part of it slides forward
from the first moment on. It is held (by friction, brake or backstop) until the motors pull harder than it resists.
"""

import math
from dataclasses import dataclass, fields, replace
from typing import Protocol

import numpy as np

from ptmcalc.laws import chain_start, start_profile
from ptmcalc.laws.loop_bounds import LoopMasses
from ptmcalc.machines.chain_drive.machine import loops
from ptmcalc.machines.chain_drive.machine.layout import ConveyorLayout, TwoShafts
from ptmcalc.machines.chain_drive.machine.loops import HeldStrands
from ptmcalc.machines.chain_drive.machine.model import (
    ChainLine,
    FloatArray,
    chain_line,
    damping,
    damping_ratios,
    drive_of,
    filled,
    gear_side_inertia,
    has_driven_tail,
    mean_arm,
    sprocket_inertia,
)
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, ChainScene, Start
from ptmcalc.numerics.mode_sum import Course

_LIGHT = 1e-12
"""Mass of the slack strand between two shafts relative to the tight one [1]: the strand is an elastic spring without
mass. A numerical choice, as 0 would divide by 0. A larger value adds inertia that does not exist."""
_PERIODS = 1.5
"""Periods of the lowest mode in the window after the end of a speed profile, or after a torque has accelerated the
chain [1]. A numerical choice. More take longer; fewer may omit the peak."""
_SEEN = 200
"""Samples of a speed over time. A numerical choice: more find a steep section more closely and take longer."""
UP_TO = 0.9
"""Share of the rated speed up to which the motors must exceed the resistance [1]. An engineering choice: above it the
torque curve falls to the resistance. A larger value reports stalls of drives that reach their speed."""
_CURVE = 2000
"""Speed steps along a torque curve. A numerical choice: more reduce the error of time and travel and take longer."""


def start_factor(spec: ChainDrive) -> float:
    """Resistance at the start over that in motion [1]."""
    return filled(spec.layout.resistance.start_factor) if isinstance(spec.layout, ConveyorLayout) else 1.0


def motor_torque(spec: ChainDrive) -> float:
    """Mean starting torque of all motors [N*m]."""
    return drive_of(spec).motor.count * drive_of(spec).mean_torque


def sprocket_mass(spec: ChainDrive) -> float:
    """The driving sprocket as a mass that moves with the chain [kg]."""
    return sprocket_inertia(spec) / mean_arm(spec) ** 2


def swinging_loop(spec: ChainDrive, loop: LoopMasses) -> LoopMasses:
    """The loop that swings: between two shafts only the tight strand, with the driven machine at its end; each strand
    on its own where a driven tail keeps the speed of the drive."""
    if has_driven_tail(spec):
        return HeldStrands(**{one.name: getattr(loop, one.name) for one in fields(loop)})
    if not isinstance(spec.layout, TwoShafts):
        return loop
    return replace(loop, return_mass=loop.carry_mass * _LIGHT, return_compliance=loop.carry_compliance)


def rigid_acceleration(spec: ChainDrive, line: ChainLine, torque: float) -> tuple[float, float]:
    """Acceleration of the rigid chain under a torque of all motors, and the factor of the gear's losses."""
    gear = drive_of(spec).gear
    return chain_start.rigid_acceleration(
        torque,
        gear_side_inertia(spec),
        gear.ratio,
        filled(gear.efficiency),
        mean_arm(spec),
        line.moving_mass + sprocket_mass(spec),
        line.static_resistance,
    )


class Swinging(Protocol):
    """A chain that is accelerated: its line, the loop that swings, the largest acceleration of the rigid body, its
    course from the release on, when that is and how long it is looked at."""

    @property
    def line(self) -> ChainLine: ...
    @property
    def masses(self) -> LoopMasses: ...
    @property
    def acceleration(self) -> float: ...
    @property
    def course(self) -> Course: ...
    @property
    def held(self) -> float: ...
    @property
    def window(self) -> float: ...


@dataclass(frozen=True, slots=True)
class StartCase:
    """A start as numbers: the line, the loop that swings, what the drive imposes, the rigid body's answer.

    `losses` is the factor by which the gear passes torque on: its efficiency, or over 1 where the chain drives.
    """

    line: ChainLine
    masses: LoopMasses
    shape: start_profile.Shape
    rise_time: float
    imposed_speed: bool
    available: float
    losses: float
    acceleration: float
    held: float
    end: float
    """from the release until the rigid body has the rated speed; from then on the drive pulls what the chain resists"""
    window: float
    follows_curve: bool

    @property
    def moves(self) -> bool:
        """Whether the drive can move the chain at all."""
        return self.imposed_speed or self.available > self.line.static_resistance

    @property
    def whole_mass(self) -> float:
        """Chain, load, tail and drive, at the chain [kg]."""
        return self.line.moving_mass + self.masses.drive_mass

    @property
    def duration(self) -> float:
        """Of the start of the rigid body, from switching on [s]; infinite where it cannot move."""
        if not self.moves:
            return math.inf
        return self.rise_time if self.imposed_speed else self.held + self.end

    def phases(self, lowest_frequency: float) -> tuple[start_profile.Phase, ...]:
        """Bounds on the answer of every mode of at least this frequency [rad/s], relative to that of the rigid body.

        Of a torque that rises through the resistance only the part above it acts, and only until the rated speed is
        reached: a part of a ramp is a ramp, a part of anything else is only known to rise. A resistance that drives
        acts at once. When the chain has its speed the part above the resistance ends at once: a mode then swings freely
        by no more than it strayed before and the share that ends.
        """
        if not self.moves:
            return (start_profile.Phase(0.0, 0.0, 0.0),)
        if self.imposed_speed:
            return start_profile.phases(self.shape, True, self.rise_time, lowest_frequency)
        before = self._before_the_end(lowest_frequency)
        return (*before, start_profile.Phase(0.0, 0.0, 1.0 + max(min(phase.stray, 1.0) for phase in before)))

    def _before_the_end(self, lowest_frequency: float) -> tuple[start_profile.Phase, ...]:
        """The phases of a torque until the chain has its speed."""
        if self.shape == start_profile.STEP:
            return start_profile.phases(self.shape, False, self.rise_time, lowest_frequency)
        rising = min(self.rise_time - self.held, self.end)
        if self.shape != start_profile.RAMP:
            if self.held > 0 or self.line.static_resistance < 0 or rising < self.rise_time:
                return (start_profile.Phase(0.0, 1.0, 1.0),)
            return start_profile.phases(self.shape, False, self.rise_time, lowest_frequency)
        at_once = max(-self.line.static_resistance / (self.acceleration * self.whole_mass), 0.0)
        return tuple(
            start_profile.Phase(
                at_once + (1 - at_once) * phase.low,
                at_once + (1 - at_once) * phase.high,
                at_once + (1 - at_once) * phase.stray,
            )
            for phase in start_profile.phases(start_profile.RAMP, False, rising, lowest_frequency)
        )

    @property
    def course(self) -> Course:
        """The acceleration that its modes follow, over the largest of the rigid body, from the release on."""
        if self.imposed_speed:
            return _of_speed(self.shape, self.rise_time)
        return _ended(_of_torque(self), self.end)


def start_case(spec: ChainDrive, scene: Start) -> StartCase:
    """A start of this chain drive.

    The window ends one and a half periods of the lowest mode behind the end of a profile of speed, or behind the moment
    at which a torque has brought the rigid body to the rated speed; `window_factor` of the scene makes it longer.
    """
    line, profile, gear = chain_line(spec, scene, start_factor(spec)), scene.profile, drive_of(spec).gear
    arm = mean_arm(spec)
    plateau, losses = rigid_acceleration(spec, line, motor_torque(spec))
    drive = losses * gear_side_inertia(spec) * (gear.ratio / arm) ** 2 + sprocket_mass(spec)
    imposed = profile.imposes_speed
    loop = swinging_loop(spec, line.masses(0.0 if imposed else drive, imposed))
    available = losses * motor_torque(spec) * gear.ratio / arm
    shape, rise_time = profile.rise, profile.rise_time
    acceleration = held = end = window = 0.0
    after = _PERIODS * 2 * math.pi / loops.lowest_frequency_bound(loop)
    if imposed:
        acceleration = line.speed * start_profile.peak_rate(shape, rise_time)
        end, window = rise_time, scene.window_factor * (rise_time + after)
    elif plateau > 0:
        mass = line.moving_mass + drive
        resistance = line.static_resistance
        held = float(start_profile.time_of_share(shape, rise_time, resistance / available))
        needed = mass * line.speed
        end = float(start_profile.time_to_momentum(shape, rise_time, available, resistance, held, needed))
        window = scene.window_factor * (end + after)
        reached = available * float(start_profile.rise(shape, rise_time, held + end))
        acceleration = (reached - line.static_resistance) / mass
    follows = profile.shape == "curve"
    return StartCase(line, loop, shape, rise_time, imposed, available, losses, acceleration, held, end, window, follows)


def ratios(spec: ChainDrive, scene: ChainScene, frequencies: FloatArray) -> FloatArray:
    """Damping ratios of modes; the law of the file read at each frequency [1]."""
    return damping_ratios(damping(spec, scene), frequencies)


def speed_over_time(case: Swinging) -> tuple[FloatArray, FloatArray]:
    """Speed that the rigid body gains, up to the end of the window: the integral of its course [s, m/s].

    **Error** that of Simpson's rule between its samples, nothing where the course is of parabolas.
    """
    course = case.course
    kinks = course.times[course.times < case.window]
    edges = np.unique(np.concatenate([np.linspace(0.0, case.window, _SEEN), kinks]))
    widths = np.diff(edges)
    piece = np.maximum(np.searchsorted(course.times, edges[:-1], "right") - 1, 0)
    gains = [
        width
        / 6
        * course.at(int(k), edge - course.times[k] + width * np.array([0.0, 0.5, 1.0]))
        @ np.array([1.0, 4.0, 1.0])
        for k, edge, width in zip(piece, edges[:-1], widths, strict=True)
    ]
    times, speeds = case.held + edges, case.acceleration * np.concatenate([[0.0], np.cumsum(gains)])
    return (np.concatenate([[0.0], times]), np.concatenate([[0.0], speeds])) if case.held > 0 else (times, speeds)


# -- what the modes follow ------------------------------------------------------------------------------------------


def _of_speed(shape: start_profile.Shape, rise_time: float) -> Course:
    """Slope of a profile of speed over its steepest."""
    t = rise_time
    if isinstance(shape, tuple):
        shares, factors = np.array(shape, float).T
        slopes = np.append(np.diff(factors) / np.diff(shares), 0.0)
        return _pieces(t * shares, slopes / slopes.max())
    if shape == start_profile.COSINE:
        return _pieces([0, t], [0, 0], swings=[1, 0], frequency=math.pi / t)
    if shape == start_profile.PARABOLIC:
        return _pieces([0, t / 2, t], [0, 1, 0], slopes=[2 / t, -2 / t, 0])
    return _pieces([0, t], [1, 0])


def _of_torque(case: StartCase) -> Course:
    """Force over the resistance, over the largest of it that comes to act, from the release on."""
    shape, t = case.shape, case.rise_time
    most = case.acceleration * case.whole_mass
    less, gain = case.line.static_resistance / most, case.available / most
    if shape == start_profile.STEP:
        return _pieces([0], [1])
    if isinstance(shape, tuple):
        shares, factors = np.array(shape, float).T
        return _released(case.held, Course.straight(t * shares, gain * factors - less))
    if shape == start_profile.COSINE:
        whole = _pieces(
            [0, t],
            [gain / 2 - less, gain - less],
            swings=[gain / 2, 0],
            phases=[-math.pi / 2] * 2,
            frequency=math.pi / t,
        )
    elif shape == start_profile.PARABOLIC:
        bend = 4 * gain / t**2
        whole = _pieces(
            [0, t / 2, t], [-less, gain / 2 - less, gain - less], slopes=[0, 2 * gain / t, 0], bends=[bend, -bend, 0]
        )
    else:
        whole = _pieces([0, t], [-less, gain - less], slopes=[gain / t, 0])
    return _released(case.held, whole)


def _pieces(
    times: FloatArray | list[float],
    values: FloatArray | list[float],
    slopes: list[float] | None = None,
    bends: list[float] | None = None,
    swings: list[float] | None = None,
    phases: list[float] | None = None,
    frequency: float = 0.0,
) -> Course:
    none = np.zeros(len(times))
    slope, bend, swing, phase = (
        none if part is None else np.asarray(part, float) for part in (slopes, bends, swings, phases)
    )
    return Course(np.asarray(times, float), np.asarray(values, float), slope, bend, swing, phase, frequency)


def _ended(course: Course, end: float) -> Course:
    """A course that ends at once."""
    kept = course.times < end

    def cut(part: FloatArray) -> FloatArray:
        return np.append(part[kept], 0.0)

    return Course(
        np.append(course.times[kept], end),
        cut(course.values),
        cut(course.slopes),
        cut(course.bends),
        cut(course.swings),
        cut(course.phases),
        course.frequency,
    )


def _released(held: float, course: Course) -> Course:
    """A course from the release on; until then nothing acts."""
    first = max(int(np.searchsorted(course.times, held, "right")) - 1, 0)
    since = np.maximum(held - course.times[first:], 0.0)
    begins = np.maximum(course.times[first:] - held, 0.0)
    slopes, bends = course.slopes[first:], course.bends[first:]
    values = course.values[first:] + since * (slopes + since * bends / 2)
    phases = course.phases[first:] + course.frequency * since
    return Course(begins, values, slopes + bends * since, bends, course.swings[first:], phases, course.frequency)


# -- a motor's curve ------------------------------------------------------------------------------------------------


def curve_start(spec: ChainDrive, scene: Start) -> tuple[float, float]:
    """Start time of the rigid body along the curve of its motors, and how far a coarser quadrature is off [s].

    t = integral of dv/a(v),   up to nine tenths of the speed where the motors do not exceed the resistance of a start
    beyond it, and infinite where they do not even there
    """
    curve, gear = drive_of(spec).start_curve, drive_of(spec).gear
    assert curve is not None
    line, count = chain_line(spec, scene, start_factor(spec)), drive_of(spec).motor.count
    speeds = np.linspace(0.0, line.speed, _CURVE + 1)
    torques = count * curve.torque(speeds / mean_arm(spec) * gear.ratio, np.inf)
    rates = np.array([rigid_acceleration(spec, line, float(torque))[0] for torque in torques])
    if rates.min() <= 0:
        most = round(UP_TO * _CURVE / 2) * 2
        if rates[: most + 1].min() <= 0:
            return math.inf, 0.0
        return _simpson(1 / rates[: most + 1], speeds[1]), math.inf
    fine, coarse = _simpson(1 / rates, speeds[1]), _simpson(1 / rates[::2], speeds[2])
    return fine, abs(fine - coarse)


def _simpson(values: FloatArray, step: float) -> float:
    return float(step / 3 * (values[0] + values[-1] + 4 * values[1:-1:2].sum() + 2 * values[2:-1:2].sum()))
