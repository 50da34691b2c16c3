"""A main shaft in one load state as SI numbers: inertia, torques over the angle, drive and brake.

Torques against the motion are positive but for the motor's. All angles are those of the main shaft, within one cycle.
"""

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.components.motor import AnyMotor, ConverterMotor, InductionBase, Stage
from ptmcalc.laws import shaft as law
from ptmcalc.laws import slider_crank
from ptmcalc.laws.slider_crank import Linkage
from ptmcalc.machines.shaft.spec import (
    FULL_TURN,
    Brake,
    EnergyTable,
    HarmonicInertia,
    PotentialHarmonic,
    SectorLoad,
    Shaft,
    SliderCrank,
    TableInertia,
    TableLoad,
    ToolLoad,
    ToolSpring,
    Unbalance,
)
from ptmcalc.numerics import spline
from ptmcalc.numerics.collocation import radau
from ptmcalc.numerics.cycle import Grid, Orbit
from ptmcalc.numerics.distinct import distinct

FloatArray = NDArray[np.float64]
OverAngle = Callable[[FloatArray], FloatArray]
ValueAndSlope = Callable[[FloatArray], tuple[FloatArray, FloatArray]]
Shape = Callable[[FloatArray], tuple[FloatArray, FloatArray, FloatArray | None]]
"""Inertia of the mechanism, its slope, and the torque of weights and springs, over the angle."""

_SAME_ANGLE = 1e-9
"""Distance [rad] up to which two breaks of the cycle count as one; for tool positions relative to the crank radius. A
numerical choice: it is above the rounding of an angle, about 1e-15. A larger value merges separate breaks; a smaller
one leaves stretches of rounding width."""
_INSIDE = 64 * np.finfo(float).eps


def filled(value: float | None) -> float:
    """A value the file or an assumption has given by now."""
    assert value is not None, "assumptions are filled in before anything is computed"
    return value


# -- drive ----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class DriveLine:
    """Motor and gear. `stages` are the torque curves of the start; a converter shifts its one by its reference."""

    motor: AnyMotor
    ratio: float
    efficiency: float
    reverse_efficiency: float
    reverses: bool
    """whether the efficiency divides while the motor brakes"""
    motor_inertia: float

    @cached_property
    def stages(self) -> tuple[Stage, ...]:
        """The torque curves of the start, one after the other."""
        return self.motor.stages

    @property
    def lossy_both_ways(self) -> bool:
        """Whether the torque on the main shaft has a corner where the power through the gear turns."""
        return self.reverses and (self.efficiency < 1 or self.reverse_efficiency < 1)

    @property
    def time_dependent(self) -> bool:
        """Whether the torque depends on the time since the start besides the speed."""
        ramp = isinstance(self.motor, ConverterMotor) and self.motor.ramp_time > 0
        return ramp or any(stage.until_time is not None for stage in self.stages)

    def lag(self, time: FloatArray) -> FloatArray:
        """By how much the curve of a converter lies at lower speeds than in the end, at a time [rad/s]."""
        if isinstance(self.motor, ConverterMotor):
            return np.asarray(self.motor.speed - self.motor.reference(time))
        return np.zeros(np.shape(time))

    def torque(self, stage: int, speed: FloatArray, time: FloatArray | None = None) -> FloatArray:
        """Motor torque at speeds of the main shaft; without a time long after the start [N*m]."""
        at = self.ratio * speed
        if time is not None and isinstance(self.motor, ConverterMotor):
            at = at + self.lag(time)
        return self.stages[stage].torque(at)

    def slope(self, stage: int, speed: FloatArray) -> FloatArray:
        """Change of the motor torque with the speed of the main shaft, long after the start [N*m*s/rad]."""
        curve, at = self.stages[stage], self.ratio * speed
        if curve.slope is not None:
            return self.ratio * curve.slope(at)
        assert curve.pieces is not None
        knots, values = np.array(curve.pieces).T
        if len(knots) == 1:
            return np.zeros(np.shape(at))
        rises = np.diff(values) / np.diff(knots)
        ends = (rises[0], rises[-1]) if curve.extends else (0.0, 0.0)
        rises = np.concatenate([ends[:1], rises, ends[1:]])
        return np.asarray(self.ratio * rises[np.searchsorted(knots, at)])

    def knots(self, stage: int) -> FloatArray:
        """Speeds of the main shaft at which the curve of a stage has a corner, once it no longer moves [rad/s]."""
        curve = self.stages[stage]
        if curve.pieces is None or (curve.extends and len(curve.pieces) <= 2):
            return np.zeros(0)
        return np.array([speed for speed, _ in curve.pieces]) / self.ratio

    def factor(self, motor_torque: FloatArray, inertia: FloatArray, resistance: FloatArray) -> FloatArray:
        """What the gear makes of the torque through it."""
        if not self.reverses:
            return np.full(np.shape(motor_torque), self.efficiency)
        if self.motor_inertia == 0:
            return np.where(motor_torque >= 0, self.efficiency, 1 / self.reverse_efficiency)
        return law.gear_factor(
            motor_torque,
            self.motor_inertia,
            inertia,
            self.ratio,
            resistance,
            self.efficiency,
            self.reverse_efficiency,
        )

    @property
    def free_speed(self) -> float | None:
        """Speed of the main shaft at which the motor gives no torque [rad/s]."""
        free = self.motor.no_load_speed
        return free / self.ratio if free else None

    @property
    def breakdown_torque(self) -> float | None:
        """The most the motor can give above its working range, None for one that has no such limit [N*m]."""
        return self.motor.breakdown_torque if isinstance(self.motor, InductionBase) else None


# -- machine --------------------------------------------------------------------------------------------------------


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
        inner = [angle for angle in self.breaks if _SAME_ANGLE < angle < self.period - _SAME_ANGLE]
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


# -- from the spec --------------------------------------------------------------------------------------------------


def machine_of(spec: Shaft, load: str) -> Machine:
    """The machine of a file with its useful load (`full`) or without it (`idle`)."""
    useful, load_breaks = _useful(spec) if load == "full" else (None, [])
    shape, shape_breaks = _shape(spec)
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
        if angle - last > _SAME_ANGLE:
            yield angle
            last = angle


def _shape(spec: Shaft) -> tuple[Shape, list[float]]:
    """Inertia, its slope and the torque of weights and springs over the angle, and where they are not smooth."""
    potential, breaks = _potential(spec)
    given = spec.inertia
    if isinstance(given, SliderCrank):
        return _crank(given, spec, potential), breaks
    if isinstance(given, TableInertia):
        curve = inertia_curve(given, spec.cycle_angle)
        return _with(curve, potential), [*breaks, *curve.knots[:-1].tolist()]
    if isinstance(given, HarmonicInertia):
        series = _series(given.mean, [(term.order, term.cosine, term.sine) for term in given.terms])
        return _with(series, potential), breaks
    value = given.value
    return _with(lambda angle: (np.full(angle.shape, value), np.zeros(angle.shape)), potential), breaks


def _with(inertia: ValueAndSlope, potential: OverAngle | None) -> Shape:
    return lambda angle: (*inertia(angle), None if potential is None else potential(angle))


def inertia_curve(table: TableInertia, period: float) -> spline.PeriodicSpline:
    """The closed curve through the points of a table."""
    return spline.through([p.angle for p in table.points], [p.inertia for p in table.points], period)


def _series(mean: float, terms: list[tuple[int, float, float]]) -> ValueAndSlope:
    def value_and_slope(angle: FloatArray) -> tuple[FloatArray, FloatArray]:
        value, slope = np.full(angle.shape, mean), np.zeros(angle.shape)
        for order, cosine, sine in terms:
            c, s = np.cos(order * angle), np.sin(order * angle)
            value = value + (cosine * c + sine * s)
            slope = slope + order * (sine * c - cosine * s)
        return value, slope

    return value_and_slope


def linkage_of(crank: SliderCrank) -> Linkage:
    """The linkage of a slider-crank."""
    return Linkage(crank.crank_radius, crank.rod_length, crank.offset)


def _crank(crank: SliderCrank, spec: Shaft, potential: OverAngle | None) -> Shape:
    """All of a slider-crank from one look at its linkage: masses, weights, springs at the tool."""
    linkage, far = (
        linkage_of(crank),
        slider_crank.dead_centre(crank.crank_radius, crank.rod_length, crank.offset, True)[0],
    )
    centre, rod_inertia = filled(crank.rod_centre), filled(crank.rod_inertia)
    masses = crank.slider_mass, crank.rod_mass, centre, rod_inertia
    tilt, g = crank.inclination, spec.gravity
    springs = [given for given in spec.potential if isinstance(given, ToolSpring)]
    plain = tilt is None and not springs

    def shape(angle: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray | None]:
        at = linkage.at(angle)
        value, slope = at.inertia(*masses)
        value = crank.crank_inertia + value
        torque = None if potential is None else potential(angle)
        if plain:
            return value, slope, torque
        whole = np.zeros(angle.shape) if torque is None else torque
        if tilt is not None:
            whole = whole + g * (crank.slider_mass * at.lift(1.0, tilt) + crank.rod_mass * at.lift(centre, tilt))
        for spring in springs:  # the pull towards the crank acts against the way out, dx/dphi > 0
            pull = spring.force - spring.stiffness * (far - at.along(1.0))
            whole = whole + pull * at.along_slope(1.0)
        return value, slope, whole

    return shape


def _useful(spec: Shaft) -> tuple[OverAngle | None, list[float]]:
    given = spec.load
    if given is None:
        return None, []
    if isinstance(given, SectorLoad):
        return _sectors(given, spec.cycle_angle)
    if isinstance(given, TableLoad):
        return _table(given, spec.cycle_angle)
    assert isinstance(spec.inertia, SliderCrank)
    return _tool(given, spec.inertia, max(round(spec.cycle_angle / FULL_TURN), 1))


def _sectors(load: SectorLoad, period: float) -> tuple[OverAngle, list[float]]:
    spans = []
    for sector in load.sectors:
        start = sector.start % period
        end = start + (sector.to - sector.start)
        spans += [(start, min(end, period), sector.torque), (0.0, end - period, sector.torque)]
    spans = [span for span in spans if span[1] > span[0]]
    edges = sorted({0.0, *(edge for low, high, _ in spans for edge in (low, high) if edge < period)})
    levels = np.array([sum(torque for low, high, torque in spans if low <= edge < high) for edge in edges])
    corners = np.array(edges)
    return lambda angle: levels[np.searchsorted(corners, angle % period, side="right") - 1], edges


def _table(load: TableLoad, period: float) -> tuple[OverAngle, list[float]]:
    angles, torques = [p.angle for p in load.points], [p.torque for p in load.points]
    return lambda angle: np.interp(angle, angles, torques, period=period), angles


def _tool(load: ToolLoad, crank: SliderCrank, turns: int) -> tuple[OverAngle, list[float]]:
    """Force times the arm dx/dphi, on the strokes in which it acts."""
    shape = crank.crank_radius, crank.rod_length, crank.offset
    linkage = linkage_of(crank)
    far = load.dead_centre == "far"
    centre, at = slider_crank.dead_centre(*shape, far)
    _, other = slider_crank.dead_centre(*shape, not far)
    outward = 1.0 if far else -1.0
    distances, forces = [p.distance for p in load.points], [p.force for p in load.points]
    end, start = distances[-1], distances[0]

    def torque(angle: FloatArray) -> FloatArray:
        position = linkage.at(angle)
        distance, arm = outward * (centre - position.along(1.0)), position.along_slope(1.0)
        slack = _SAME_ANGLE * crank.crank_radius
        acts = (distance >= start - slack) & (distance <= end + slack)
        if load.stroke != "both":
            acts &= outward * arm > 0 if load.stroke == "approach" else outward * arm < 0
        return np.where(acts, np.interp(distance, distances, forces), 0.0) * np.abs(arm)

    breaks = [at, other]
    for distance in distances:
        breaks += slider_crank.crank_angles(centre - outward * distance, *shape)
    return torque, [angle + turn * FULL_TURN for angle in breaks for turn in range(turns)]


def _potential(spec: Shaft) -> tuple[OverAngle | None, list[float]]:
    """Torque of weights and springs that act on the shaft itself, the slope of the energy they store, and the angles at
    which it is not smooth."""
    parts: list[OverAngle] = []
    breaks: list[float] = []
    for given in spec.potential:
        if isinstance(given, EnergyTable):
            curve = spline.through([p.angle for p in given.points], [p.energy for p in given.points], spec.cycle_angle)
            parts.append(partial(_slope_of, curve))
            breaks += curve.knots[:-1].tolist()
        elif isinstance(given, Unbalance):
            parts.append(partial(_unbalance, given.mass * spec.gravity * given.radius, given.top))
        elif isinstance(given, PotentialHarmonic):
            parts.append(partial(_harmonic, given.order, given.cosine, given.sine))
    if not parts:
        return None, []
    return lambda angle: np.asarray(sum(part(angle) for part in parts)), breaks


def _slope_of(curve: spline.PeriodicSpline, angle: FloatArray) -> FloatArray:
    return curve(angle)[1]


def _unbalance(weight: float, top: float, angle: FloatArray) -> FloatArray:
    return -weight * np.sin(angle - top)


def _harmonic(order: int, cosine: float, sine: float, angle: FloatArray) -> FloatArray:
    return np.asarray(cosine * np.cos(order * angle) + sine * np.sin(order * angle))
