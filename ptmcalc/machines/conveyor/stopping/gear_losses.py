"""Stop of the rigid conveyor whose gear losses change their side."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from ptmcalc.machines.conveyor.brakes import Braking, brakes_of, brakes_on_motors, braking
from ptmcalc.machines.conveyor.drives import moving_mass
from ptmcalc.machines.conveyor.model import BeltLine
from ptmcalc.machines.conveyor.resistances import filled
from ptmcalc.machines.conveyor.rigid_stop import rigid_stop
from ptmcalc.machines.conveyor.spec import Conveyor, ConveyorScene


@dataclass(frozen=True, slots=True)
class GearChange:
    """Stop of the rigid conveyor whose gear losses change their side, compared with the fixed side: time [s], distance
    [m], largest difference of the force of all gears at the pulley surface [N], change of the time, relative."""

    time: float
    way: float
    force: float
    relative: float


_STEPS = 4000
"""Steps of a stop; a numerical choice. Heun's rule then has an error of 1e-6, except in the step in which a gear side
changes, 1/4000 of the time. More steps take longer."""


@dataclass(frozen=True, slots=True)
class _Geared:
    """A drive behind its gear, at the pulley surface: rotor [kg], efficiency, brake on the motor shaft without losses
    [N], and the side on which the simulation keeps the losses."""

    rotor: float
    efficiency: float
    brakes: tuple[Braking, ...]
    driven: bool

    def force(self, time: float, acceleration: float, driven: bool) -> float:
        """Braking force at the pulley surface [N]."""
        through = self._mesh(time, acceleration)
        return through / self.efficiency if driven else through * self.efficiency

    def is_driven(self, time: float, acceleration: float) -> bool:
        """Whether the belt drives the rotor: its brake takes more than the rotor gives."""
        return self._mesh(time, acceleration) > 0

    def _mesh(self, time: float, acceleration: float) -> float:
        return sum(brake.at(time) for brake in self.brakes) + self.rotor * acceleration


def changing_sides(spec: Conveyor, scene: ConveyorScene, line: BeltLine) -> GearChange:
    """What a stop changes by when the losses of every gear are on the driven side at each moment.

        M_0 v' = -(W + B) - sum f_d,   f_d = q/eta where q > 0, else q eta,   q = B_motor + m_rotor v'

    **Range** a stop that comes to rest; no change otherwise.
    **Error** below 1/4000 of the stopping time.
    **Source** Newton's law; power through a gear.
    """
    fixed_time, fixed_way = rigid_stop(spec, scene, line)
    drives = _geared(spec, scene)
    if not math.isfinite(fixed_time) or not drives or all(one.efficiency == 1 for one in drives):
        return GearChange(0.0, 0.0, 0.0, 0.0)
    acting = [braking(spec, brake) for brake in brakes_of(spec, scene).values() if brake.shaft != "motor"]
    rest = moving_mass(line) - sum(one.rotor * (1 / one.efficiency if one.driven else one.efficiency) for one in drives)
    resistance = line.static_resistance + line.tail_pull

    def rate(time: float) -> tuple[float, float]:
        """Acceleration, and the difference of the gears' force to that of the fixed side."""
        sides = [one.driven for one in drives]
        outside = resistance + sum(brake.at(time) for brake in acting)
        for _ in range(len(drives) + 2):
            speeds_up = _acceleration(rest, outside, drives, sides, time)
            found = [one.is_driven(time, speeds_up) for one in drives]
            if found == sides:
                break
            sides = found
        differs = sum(
            one.force(time, speeds_up, side) - one.force(time, speeds_up, one.driven)
            for one, side in zip(drives, sides, strict=True)
        )
        return speeds_up, abs(differs)

    step = fixed_time / _STEPS
    time, speed, way, most = 0.0, line.speed, 0.0, 0.0
    later = rate(time)
    while speed > 0 and time < 4 * fixed_time:
        (first, differs), later = later, rate(time + step)
        second, most = later[0], max(most, differs)
        change = (first + second) / 2 * step
        share = min(speed / -change, 1.0) if change < 0 else 1.0
        way += (speed + change * share / 2) * step * share
        time, speed = time + step * share, speed + change * share if share == 1.0 else 0.0
    if speed > 0:
        return GearChange(0.0, 0.0, most, 0.0)
    return GearChange(time - fixed_time, way - fixed_way, most, abs(time / fixed_time - 1))


def _acceleration(rest: float, outside: float, drives: Sequence[_Geared], sides: Sequence[bool], time: float) -> float:
    """Acceleration with the losses on given sides [m/s^2]."""
    mass, force = rest, outside
    for one, driven in zip(drives, sides, strict=True):
        factor = 1 / one.efficiency if driven else one.efficiency
        mass += one.rotor * factor
        force += one.force(time, 0.0, driven)
    return -force / mass


def _geared(spec: Conveyor, scene: ConveyorScene) -> list[_Geared]:
    """The drives of a conveyor behind their gears."""
    found = []
    for name, drive in spec.all_drives.items():
        efficiency = filled(drive.gear.efficiency)
        on_motor = brakes_on_motors(spec, scene, name)
        rotor = drive.motor.count * (filled(drive.motor.inertia) + filled(drive.coupling_inertia))
        at_surface = rotor * (drive.gear.ratio * 2 / drive.drum.diameter) ** 2
        found.append(_Geared(at_surface, efficiency, tuple(on_motor), bool(on_motor)))
    return found
