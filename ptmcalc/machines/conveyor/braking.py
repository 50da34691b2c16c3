"""What brings the belt to rest: brakes at the rim over time, and the rigid conveyor under them."""

import math
from dataclasses import dataclass

from ptmcalc.machines.conveyor.driving import moving_mass
from ptmcalc.machines.conveyor.forces import filled
from ptmcalc.machines.conveyor.model import BeltLine
from ptmcalc.machines.conveyor.spec import Brake, Conveyor, ConveyorScene, EmergencyStop, Stop


@dataclass(frozen=True, slots=True)
class Braking:
    """What a brake does at the rim over time: full force [N], delay and rise [s]."""

    force: float
    delay: float
    rise: float

    def at(self, time: float) -> float:
        """Capacity at a time [N]."""
        if time <= self.delay:
            return 0.0
        return self.force * (min((time - self.delay) / self.rise, 1.0) if self.rise > 0 else 1.0)


def brakes_of(spec: Conveyor, scene: ConveyorScene) -> dict[str, Brake]:
    """The brakes that act in a scene."""
    acts = isinstance(scene, EmergencyStop) or (isinstance(scene, Stop) and scene.brakes == "on")
    return dict(spec.brakes) if acts else {}


def braking(spec: Conveyor, brake: Brake) -> Braking:
    """A brake at the rim: a brake on the motor shaft is driven through the gear, whose losses add to it.

    F = M/R   (drum shaft)        F = M i/(eta R)   (motor shaft)

    It acts on the last drive there; at a tail without one, on the tail drum.
    """
    there = [drive for drive in spec.all_drives.values() if drive.at == brake.at]
    if not there:
        diameter = spec.tail_drum.diameter or spec.main_drive.drum.diameter
        return Braking(brake.torque * 2 / diameter, brake.delay, brake.rise_time)
    drive = there[-1]
    force = brake.torque * 2 / drive.drum.diameter
    if brake.shaft == "motor":
        force *= drive.gear.ratio / filled(drive.gear.efficiency)
    return Braking(force, brake.delay, brake.rise_time)


def rigid_stop(spec: Conveyor, scene: ConveyorScene, line: BeltLine, until: float = 0.0) -> tuple[float, float]:
    """Time and way of the rigid body from full speed to rest, or to another speed; infinite where nothing stops it.

    M v' = -(W + sum B(t)), brakes with delay and straight rise: pieces of constant or linear force, solved piece by
    piece.
    """
    mass, resistance = moving_mass(line), line.static_resistance + line.tail_pull
    brakes = [braking(spec, brake) for brake in brakes_of(spec, scene).values()]
    marks = sorted({0.0, *(b.delay for b in brakes), *(b.delay + b.rise for b in brakes)})
    speed, way = line.speed, 0.0
    for begin, end in zip(marks, [*marks[1:], math.inf], strict=True):
        # force over the piece: r0 + r1 t
        middle = begin + (1.0 if math.isinf(end) else (end - begin) / 2)
        r0 = resistance + sum(b.at(begin + 1e-12 * max(begin, 1.0)) if b.rise <= 0 else b.at(begin) for b in brakes)
        r1 = (resistance + sum(b.at(middle) for b in brakes) - r0) / (middle - begin)
        rest = _first_rest(mass * (speed - until), r0, r1)
        length = min(rest, end - begin)
        if math.isinf(length):
            return math.inf, math.inf
        way += speed * length - (r0 * length**2 / 2 + r1 * length**3 / 6) / mass
        if rest <= end - begin:
            return begin + rest, way
        speed -= (r0 * length + r1 * length**2 / 2) / mass
    return math.inf, math.inf


def _first_rest(momentum: float, force: float, rate: float) -> float:
    """Smallest t > 0 with force t + rate t^2/2 = momentum."""
    if abs(rate) * momentum <= 1e-14 * force**2:
        return momentum / force if force > 0 else math.inf
    root = force**2 + 2 * rate * momentum
    if root < 0:
        return math.inf
    bottom = force + math.sqrt(root)
    return 2 * momentum / bottom if bottom > 0 else math.inf


def deceleration(spec: Conveyor, scene: ConveyorScene, line: BeltLine) -> float:
    """Largest deceleration of the rigid body with all brakes of the scene [m/s^2]."""
    brakes = sum(braking(spec, brake).force for brake in brakes_of(spec, scene).values())
    return abs(line.static_resistance + line.tail_pull + brakes) / moving_mass(line)
