"""A main shaft in one load state as SI numbers: inertia, torques over the angle, drive and brake.

Torques against the motion are positive but for the motor's. All angles are those of the main shaft, within one cycle.
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from ptmcalc.machines.shaft.machine.drive_line import DriveLine
from ptmcalc.machines.shaft.machine.mechanism import SAME_ANGLE, FloatArray, OverAngle, Shape, filled, shape_of
from ptmcalc.machines.shaft.machine.spec import FULL_TURN, Brake, Shaft
from ptmcalc.machines.shaft.machine.useful_load import useful_load
from ptmcalc.numerics.collocation import radau
from ptmcalc.numerics.cycle import Grid, Orbit
from ptmcalc.numerics.distinct import distinct

_INSIDE = 64 * np.finfo(float).eps


@dataclass(frozen=True)
class Machine:
    """A main shaft in one load state. `breaks` are the angles within a cycle at which something is not smooth."""

    period: float
    shape: Shape
    useful: OverAngle | None
    friction: float
    viscous: float
    share: float
    drive: DriveLine
    brake: Brake | None
    breaks: tuple[float, ...]
    added: float = 0.0
    """inertia of a flywheel that is tried on the main shaft [kg*m^2]"""

    def with_flywheel(self, inertia: float) -> "Machine":
        """The same shaft with more inertia on it."""
        return replace(self, added=inertia)

    def with_brake_torque(self, torque: float) -> "Machine":
        """The same shaft with a brake of another torque."""
        assert self.brake is not None
        return self._with_brake(self.brake.model_copy(update={"torque": torque}))

    def _with_brake(self, brake: Brake | None) -> "Machine":
        changed = replace(self, brake=brake)
        for known in ("survey", "working_speeds"):  # they know no brake
            changed.__dict__[known] = getattr(self, known)
        return changed

    @property
    def brake_most(self) -> float:
        """Full torque of the brake [N*m]."""
        return self.brake.torque if self.brake else 0.0

    def without_brake(self) -> "Machine":
        """The same shaft with its brake left open."""
        return self._with_brake(None)

    @property
    def sound(self) -> bool:
        """Whether the inertia is above 0 at every angle."""
        return self.survey.inertia_least > 0

    @property
    def changing(self) -> bool:
        """Whether the inertia changes with the angle."""
        return self.survey.slope_low < 0 or self.survey.slope_high > 0

    def with_mean_inertia(self) -> "Machine":
        """The same shaft with its mean inertia at every angle."""
        mean, shape = self.survey.inertia_mean - self.added, self.shape
        return replace(self, shape=lambda angle: (np.full(angle.shape, mean), np.zeros(angle.shape), shape(angle)[2]))

    def mechanism(self, angle: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Inertia of all that turns on the main shaft's side of the gear, and its slope over the angle."""
        value, slope, _ = self.shape(angle)
        return value + self.added, slope

    def fields(self, angle: FloatArray, low: ArrayLike, high: ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Inertia, its slope, and the torque against the motion that depends on the angle alone, friction included.

        Angles beyond the breaks `low` and `high` see the useful load at them: a step that overshoots meets nothing new.
        """
        value, slope, potential = self.shape(angle)
        rest = self.friction if potential is None else potential + self.friction
        if self.useful is None:
            static = np.full(angle.shape, rest) if potential is None else np.asarray(rest)
        else:
            load = self.useful(self.within(angle, low, high))
            static = np.asarray(load + self.share * np.abs(load) + rest)
        return value + self.added, slope, static

    def static(self, angle: FloatArray, low: ArrayLike, high: ArrayLike) -> FloatArray:
        """The last of the fields [N*m]."""
        return self.fields(angle, low, high)[2]

    def useful_torque(self, angle: FloatArray, low: ArrayLike, high: ArrayLike) -> FloatArray:
        """The useful part of it [N*m]."""
        return np.zeros(angle.shape) if self.useful is None else self.useful(self.within(angle, low, high))

    def potential_torque(self, angle: FloatArray) -> FloatArray:
        """The part of weights and springs [N*m]."""
        found = self.shape(angle)[2]
        return np.zeros(angle.shape) if found is None else found

    def within(self, angle: FloatArray, low: ArrayLike, high: ArrayLike) -> FloatArray:
        """Angles moved into an open interval between two breaks, so that nothing beyond them is seen."""
        nudge = _INSIDE * self.period
        return np.clip(angle, np.add(low, nudge), np.subtract(high, nudge))

    @cached_property
    def corners(self) -> FloatArray:
        """The breaks with both ends of the cycle."""
        inner = [angle for angle in self.breaks if SAME_ANGLE < angle < self.period - SAME_ANGLE]
        return np.array([0.0, *inner, self.period])

    @cached_property
    def survey(self) -> "Survey":
        """Means and extremes over a cycle."""
        return Survey.of(self)

    @property
    def inertia_mean(self) -> float:
        """Mean inertia of the mechanism over the angle of a cycle [kg*m^2]."""
        return self.survey.inertia_mean

    @cached_property
    def tried_speeds(self) -> FloatArray:
        """Speeds at which torques are compared: dense where the torque of a motor changes fast, over twenty decades."""
        free = self.drive.free_speed
        knots = np.concatenate([self.drive.knots(k) for k in range(len(self.drive.stages))])
        knots = knots[knots > 0]
        scale = free or (float(knots.max()) if knots.size else 1.0)
        near = np.geomspace(1e-7, 0.99, 120)
        tried = np.concatenate([scale * (1 - near), scale * (1 + near), scale * np.geomspace(1e-15, 1e5, 280), knots])
        return distinct(tried[tried > 0])

    def surplus(self, speed: FloatArray) -> FloatArray:
        """Mean torque left over a cycle if the speed stayed the same, long after the start [N*m]."""
        drive, survey = self.drive, self.survey
        torque = drive.torque(len(drive.stages) - 1, speed)
        resistance = survey.static_mean + self.viscous * speed
        factor = drive.factor(torque, np.full(speed.shape, survey.inertia_mean), resistance)
        return np.asarray(drive.ratio * factor * torque - resistance)

    @cached_property
    def working_speeds(self) -> tuple[float, ...]:
        """Speeds at which the motor carries the mean of all torques, stably, the largest first [rad/s]."""
        speeds = self.tried_speeds
        surplus = self.surplus(speeds)
        found = []
        for index in np.flatnonzero((surplus[:-1] > 0) & (surplus[1:] <= 0))[::-1]:
            low, high = float(speeds[index]), float(speeds[index + 1])
            for _ in range(200):
                middle = (low + high) / 2
                if not low < middle < high:
                    break
                more = float(self.surplus(np.array([middle]))[0]) > 0
                low, high = (middle, high) if more else (low, middle)
            found.append(low if low > 0 else high)
        return tuple(found)

    @property
    def races(self) -> bool:
        """Whether the drive, or the load, exceeds all that resists and no speed carries it stably."""
        return not self.working_speeds and float(self.surplus(self.tried_speeds[-1:])[0]) > 0

    @property
    def largest_torque(self) -> float:
        """Largest torque of the motor in its last stage, at any speed tried or at breakdown [N*m]."""
        drive = self.drive
        torques = drive.torque(len(drive.stages) - 1, np.append(self.tried_speeds, 0.0))
        return max(float(np.max(torques)), drive.breakdown_torque or 0.0, 0.0)

    def total_inertia(self, mechanism: FloatArray, factor: FloatArray) -> FloatArray:
        """Inertia with the motor's side, which the gear's loss makes smaller or larger [kg*m^2]."""
        return np.asarray(mechanism + factor * self.drive.ratio**2 * self.drive.motor_inertia)

    def kinetic_energy(self, angle: float, speed: float) -> float:
        """Kinetic energy of everything that turns, the motor's side included [J]."""
        mechanism = float(self.mechanism(np.array([angle]))[0][0])
        return (mechanism + self.drive.ratio**2 * self.drive.motor_inertia) * speed**2 / 2

    def brake_torque(self, time: FloatArray) -> FloatArray:
        """Torque of the brake so long after the command [N*m]."""
        if self.brake is None:
            return np.zeros(np.shape(time))
        late = np.asarray(time, float) - self.brake.delay
        if self.brake.rise == 0:
            return np.where(late >= 0, self.brake.torque, 0.0)
        return np.asarray(self.brake.torque * np.clip(late / self.brake.rise, 0.0, 1.0))


@dataclass(frozen=True)
class Survey:
    """Means and extremes of a machine over the angle of a cycle. Torques in N*m, inertias in kg*m^2, works in J."""

    inertia_mean: float
    inertia_least: float
    """smallest of samples; the bounds that follow lie beyond what can be between them"""
    inertia_low: float
    inertia_high: float
    slope_low: float
    slope_high: float
    static_mean: float
    static_low: float
    static_high: float
    useful_work: float
    share_work: float
    work_swing: float
    """largest less smallest work over the angle, of the mean torque less that which depends on the angle"""

    @classmethod
    def of(cls, machine: Machine) -> "Survey":
        """By Gauss quadrature between the breaks, extremes by samples and what the curves can do between them."""
        nodes, weights = np.polynomial.legendre.leggauss(24)
        edges = split(machine.corners, FULL_TURN / 12)
        low, high = edges[:-1, None], edges[1:, None]
        angles = (low + high) / 2 + (high - low) / 2 * nodes
        weight = (high - low) / 2 * weights
        inertia, _ = machine.mechanism(angles)
        static, useful = machine.static(angles, low, high), machine.useful_torque(angles, low, high)
        inside = low + (high - low) * np.linspace(0.0, 1.0, 33)
        inertia_low, inertia_high = _extremes(machine.mechanism(inside)[0])
        slope_low, slope_high = _extremes(machine.mechanism(inside)[1])
        static_low, static_high = _extremes(machine.static(inside, low, high))
        static_mean = min(max(float(np.sum(static * weight)) / machine.period, static_low), static_high)
        return cls(
            inertia_mean=float(np.sum(inertia * weight)) / machine.period,
            inertia_least=float(machine.mechanism(inside)[0].min()),
            inertia_low=max(inertia_low, 0.0),
            inertia_high=inertia_high,
            slope_low=slope_low,
            slope_high=slope_high,
            static_mean=static_mean,
            static_low=static_low,
            static_high=static_high,
            useful_work=float(np.sum(useful * weight)),
            share_work=machine.share * float(np.sum(np.abs(useful) * weight)),
            work_swing=_work_swing(machine, edges, static_mean),
        )


def _work_swing(machine: Machine, edges: FloatArray, mean: float) -> float:
    """Largest less smallest integral of the mean torque less the static one."""
    rule, grid = radau(12), Grid(edges, 12)
    torque = mean - machine.static(grid.angles, edges[:-1, None], edges[1:, None])
    gained = grid.lengths * (torque @ rule.integral[-1])
    before = np.concatenate([[0.0], np.cumsum(gained[:-1])])
    (lowest, _), (highest, _) = Orbit(grid, before, torque @ rule.to_legendre.T, 0.0).extremes()
    return highest - lowest


def _extremes(values: FloatArray) -> tuple[float, float]:
    """Smallest and largest value of smooth pieces from samples: between them at most a quarter of the second difference
    farther (an eighth where it stays the same)."""
    bend = np.abs(np.diff(values, 2, axis=1)).max(axis=1) / 4
    return float((values.min(axis=1) - bend).min()), float((values.max(axis=1) + bend).max())


def split(edges: FloatArray, longest: float) -> FloatArray:
    """Edges with every stretch divided into equal ones no longer than that."""
    pieces = [
        np.linspace(low, high, max(math.ceil((high - low) / longest - 1e-9), 1), endpoint=False)
        for low, high in pairwise(edges)
    ]
    return np.append(np.concatenate(pieces), edges[-1])


def machine_of(spec: Shaft, load: str) -> Machine:
    """The machine of a file with its useful load (`full`) or without it (`idle`)."""
    useful, load_breaks = useful_load(spec) if load == "full" else (None, [])
    shape, shape_breaks = shape_of(spec)
    gear = spec.drive.gear
    efficiency = filled(gear.efficiency)
    breaks = sorted(angle % spec.cycle_angle for angle in [*load_breaks, *shape_breaks])
    return Machine(
        period=spec.cycle_angle,
        shape=shape,
        useful=useful,
        friction=spec.losses.torque,
        viscous=spec.losses.viscous,
        share=spec.losses.share,
        drive=DriveLine(
            motor=spec.drive.motor,
            ratio=gear.ratio,
            efficiency=efficiency,
            reverse_efficiency=efficiency if gear.reverse_efficiency is None else gear.reverse_efficiency,
            reverses=gear.braking == "divides",
            motor_inertia=spec.drive.motor_inertia,
        ),
        brake=spec.brake,
        breaks=tuple(_distinct(breaks)),
    )


def _distinct(angles: Iterable[float]) -> Iterator[float]:
    last = -math.inf
    for angle in angles:
        if angle - last > SAME_ANGLE:
            yield angle
            last = angle
