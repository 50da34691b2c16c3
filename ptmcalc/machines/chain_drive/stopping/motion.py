"""A chain that comes to rest as numbers: what brakes it over time, and the rigid body under it.

The chain runs at its speed with the lowest resistance there can be; the motors let go at time 0. What the gear passes
on goes by the direction of the power through it: a brake on the motor shaft is helped by the losses, a rotor that
drives the chain on is held back by them.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ptmcalc.laws.loop_bounds import CARRY, RETURN, LoopMasses
from ptmcalc.machines.chain_drive.machine import loops
from ptmcalc.machines.chain_drive.machine.layout import ConveyorLayout
from ptmcalc.machines.chain_drive.machine.model import (
    ChainLine,
    chain_line,
    drive_of,
    filled,
    mean_arm,
    motor_side_inertia,
)
from ptmcalc.machines.chain_drive.machine.spec import (
    Brake,
    ChainDrive,
    ChainScene,
    Coast,
    EmergencyStop,
    Stop,
    Stopping,
)
from ptmcalc.machines.chain_drive.starting.motion import sprocket_mass, swinging_loop
from ptmcalc.numerics.mode_sum import Course

_SECTIONS = 65
"""Points of each strand at which tensions are bounded, both ends among them; a numerical choice. The bound adds the
curvature between two points. More points narrow it and take longer."""


def stop_factor(spec: ChainDrive) -> float:
    """Lowest resistance over that in motion [1]."""
    return filled(spec.layout.resistance.stop_factor) if isinstance(spec.layout, ConveyorLayout) else 1.0


def acting_brake(spec: ChainDrive, scene: ChainScene) -> Brake | None:
    """The brake, where it acts in a scene."""
    acts = isinstance(scene, EmergencyStop) or (isinstance(scene, Stop) and scene.brake == "on")
    return spec.brake if acts else None


def allowed_way(spec: ChainDrive, scene: Stopping) -> float | None:
    """Longest way of the file for a kind of stop [m]."""
    if isinstance(scene, Coast):
        return None
    limits = spec.checks
    if isinstance(scene, EmergencyStop) and limits.emergency_stop_distance is not None:
        return limits.emergency_stop_distance
    return limits.stop_distance


@dataclass(frozen=True, slots=True)
class StopCase:
    """A stop as numbers: the line with its lowest resistance, what moves with the chain [kg], the motor shaft's inertia
    [kg*m^2], the gear, the brake's torque on either shaft over time."""

    line: ChainLine
    mass: float
    rotor: float
    ratio: float
    efficiency: float
    arm: float
    brake: Brake | None

    def on_motor(self, time: float) -> float:
        """Torque of a brake on the motor shaft [N*m]."""
        return self._torque(time) if self.brake is not None and self.brake.shaft == "motor" else 0.0

    def on_chain(self, time: float) -> float:
        """What resists at the chain, a brake on the sprocket shaft too [N]."""
        own = self._torque(time) / self.arm if self.brake is not None and self.brake.shaft == "sprocket" else 0.0
        return self.line.static_resistance + own

    def _torque(self, time: float) -> float:
        brake = self.brake
        assert brake is not None
        since = time - brake.delay
        if since < 0:
            return 0.0
        return brake.torque * (min(since / brake.rise_time, 1.0) if brake.rise_time > 0 else 1.0)

    def losses(self, torque: float, resistance: float) -> float:
        """What the gear makes of a torque: eta where the chain drives the brake, 1/eta where the rotor drives it on."""
        balanced = self.rotor * (resistance / self.mass) * (self.ratio / self.arm)
        return self.efficiency if torque >= balanced else 1 / self.efficiency

    def deceleration(self, torque: float, resistance: float) -> float:
        """Of the rigid body [m/s^2]; negative where it is driven on.

        a = (M + W R e/i)/(m R e/i + J i/R)
        """
        arm = self.arm / self.ratio * self.losses(torque, resistance)
        return (torque + resistance * arm) / (self.mass * arm + self.rotor * self.ratio / self.arm)

    @property
    def marks(self) -> list[float]:
        """Times at which the brake changes its law."""
        if self.brake is None:
            return [0.0]
        brake = self.brake
        marks = {0.0, brake.delay, brake.delay + brake.rise_time}
        crossing = self._crossing()
        return sorted(marks | ({crossing} if crossing is not None else set()))

    def _crossing(self) -> float | None:
        """When a rising torque turns the direction of the power in the gear."""
        brake = self.brake
        assert brake is not None
        if brake.rise_time <= 0:
            return None
        full = brake.delay + brake.rise_time

        def over(time: float) -> float:
            return self.on_motor(time) - self.rotor * (self.on_chain(time) / self.mass) * (self.ratio / self.arm)

        first, last = over(brake.delay), over(full)
        if first * last >= 0:
            return None
        return brake.delay + brake.rise_time * first / (first - last)

    def rest(self) -> tuple[float, float]:
        """Time and way to rest; infinite where nothing stops it [s, m]."""
        speed, way, marks = self.line.speed, 0.0, self.marks
        for begin, end in zip(marks, [*marks[1:], math.inf], strict=True):
            span = end - begin
            inside = begin + (span if math.isfinite(span) else 1.0) / 2
            middle = self.deceleration(self.on_motor(inside), self.on_chain(inside))
            near = begin + (span if math.isfinite(span) else 1.0) * 1e-9
            first = self.deceleration(self.on_motor(near), self.on_chain(near))
            rate = (middle - first) / (inside - near) if math.isfinite(span) else 0.0
            stops = _first_rest(speed, first, rate)
            length = min(stops, span)
            if math.isinf(length):
                return math.inf, math.inf
            way += speed * length - first * length**2 / 2 - rate * length**3 / 6
            if stops <= span:
                return begin + stops, way
            speed -= first * length + rate * length**2 / 2
        return math.inf, math.inf

    @property
    def hardest(self) -> float:
        """Largest deceleration of the rigid body in its stop [m/s^2]; 0 where it only speeds up."""
        full = (self.brake.delay + self.brake.rise_time if self.brake is not None else 0.0) + 1.0
        return max(self.deceleration(self.on_motor(t), self.on_chain(t)) for t in (0.0, full))

    def masses(self, losses: float) -> LoopMasses:
        """The loop with its drive as the gear's losses let it be felt."""
        drive = losses * self.rotor * (self.ratio / self.arm) ** 2
        return self.line.masses(drive + self.own, imposed_speed=False)

    @property
    def own(self) -> float:
        """What belongs to the drive and not to the loop: the driving sprocket [kg]."""
        return self.mass - self.line.moving_mass


@dataclass(frozen=True, slots=True)
class StopSwing:
    """A stop as its modes see it, the drive felt through one direction of the gear's losses."""

    line: ChainLine
    masses: LoopMasses
    acceleration: float
    course: Course
    window: float
    held: float = 0.0


def swings(spec: ChainDrive, case: StopCase) -> Iterator[StopSwing]:
    """The stop with its drive as a brake feels it and as a rotor that drives the chain on, up to its rest."""
    time, _ = case.rest()
    marks = [mark for mark in case.marks if mark < time]
    begins, values, slopes = [], [], []
    for mark, end in zip(marks, [*marks[1:], time], strict=True):
        near, far = mark + 1e-9 * (end - mark), end - 1e-9 * (end - mark)
        first, last = (case.deceleration(case.on_motor(t), case.on_chain(t)) for t in (near, far))
        begins.append(mark)
        values.append(-first)
        slopes.append((first - last) / (end - mark) if math.isfinite(end) else 0.0)
    most = max(max(map(abs, values)), max(abs(v + s * (e - b)) if s else 0.0 for v, s, b, e in zip(
        values, slopes, begins, [*begins[1:], time], strict=True)))  # fmt: skip
    zero = np.zeros(len(begins))
    course = Course(np.array(begins), np.array(values) / most, np.array(slopes) / most, zero, zero, zero)
    for losses in (case.efficiency, 1 / case.efficiency):
        loop = swinging_loop(spec, case.masses(losses))
        yield StopSwing(case.line, loop, most, course, time)


def stop_case(spec: ChainDrive, scene: ChainScene) -> StopCase:
    """A stop of this chain drive."""
    line, gear = chain_line(spec, scene, stop_factor(spec)), drive_of(spec).gear
    return StopCase(
        line=line,
        mass=line.moving_mass + sprocket_mass(spec),
        rotor=motor_side_inertia(spec),
        ratio=gear.ratio,
        efficiency=filled(gear.efficiency),
        arm=mean_arm(spec),
        brake=acting_brake(spec, scene),
    )


def _first_rest(speed: float, deceleration: float, rate: float) -> float:
    """Smallest t > 0 with a t + r t^2/2 = v."""
    if abs(rate) * speed <= 1e-14 * deceleration**2:
        return speed / deceleration if deceleration > 0 else math.inf
    root = deceleration**2 + 2 * rate * speed
    if root < 0:
        return math.inf
    bottom = deceleration + math.sqrt(root)
    return 2 * speed / bottom if bottom > 0 else math.inf


@dataclass(frozen=True, slots=True)
class Extremes:
    """Smallest and largest tension of the rigid chain in a stop, and what waves surely do not bring it beyond [N]."""

    smallest: float
    lowest: float
    largest: float
    highest: float


def extremes(spec: ChainDrive, case: StopCase) -> Extremes:
    """Tensions of a stop.

    The drive's pull goes at once and the brake's comes: the rim force falls in parts, each of which changes a section
    by r(s) of its acceleration and lets it stray by b(s) of it at most, however the brake rises.
    """
    x = np.linspace(0.0, 1.0, _SECTIONS)
    coasting = case.deceleration(0.0, case.line.static_resistance)
    hardest = case.hardest
    changes = abs(coasting) + abs(hardest - coasting)
    found = Extremes(math.inf, math.inf, -math.inf, -math.inf)
    for losses in (case.efficiency, 1 / case.efficiency):
        loop = swinging_loop(spec, case.masses(losses))
        for strand, part in ((RETURN, case.line.back), (CARRY, case.line.working)):
            static = part.begin + x * (part.end - part.begin)
            r, stray = loops.quasi_static(loop, strand, x), changes * loops.stray(loop, strand, x)
            levels = static + np.array([0.0 * r, -r * hardest, -r * coasting])
            low, high = levels.min(axis=0), levels.max(axis=0)
            bend = float(np.abs(np.diff(stray, 2)).max()) / 8 + float(np.abs(np.diff(levels, 2)).max()) / 8
            found = Extremes(
                min(found.smallest, float(low.min())),
                min(found.lowest, float((low - stray).min()) - bend),
                max(found.largest, float(high.max())),
                max(found.highest, float((high + stray).max()) + bend),
            )
    return found
