"""The rigid conveyor under its brakes."""

import math

from ptmcalc.laws import start_profile
from ptmcalc.machines.conveyor.machine.brakes import brakes_of, braking
from ptmcalc.machines.conveyor.machine.drives import moving_mass
from ptmcalc.machines.conveyor.machine.model import BeltLine
from ptmcalc.machines.conveyor.machine.scenes import ControlledStop, ConveyorScene
from ptmcalc.machines.conveyor.machine.spec import Conveyor


def rigid_stop(spec: Conveyor, scene: ConveyorScene, line: BeltLine, until: float = 0.0) -> tuple[float, float]:
    """Time and way of the rigid body from full speed to rest, or to another speed; infinite where nothing stops it.

    M v' = -(W + sum B(t)), brakes with delay and straight rise: pieces of constant or linear force, solved piece by
    piece. In a controlled stop the speed is that of the converters, v = V (1 - p(t)).
    """
    if isinstance(scene, ControlledStop):
        return _controlled(scene, line, until / line.speed)
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


def _controlled(scene: ControlledStop, line: BeltLine, share: float) -> tuple[float, float]:
    """Time and way until the converters have a share of the rated speed."""
    time = float(start_profile.time_of_share(scene.shape, scene.time, 1 - share))
    return time, line.speed * (time - float(start_profile.rise_integral(scene.shape, scene.time, time)))


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
    """Largest deceleration of the rigid body with all brakes of the scene, or by its converters [m/s^2]."""
    if isinstance(scene, ControlledStop):
        return line.speed * start_profile.peak_rate(scene.shape, scene.time)
    brakes = sum(braking(spec, brake).force for brake in brakes_of(spec, scene).values())
    return abs(line.static_resistance + line.tail_pull + brakes) / moving_mass(line)
