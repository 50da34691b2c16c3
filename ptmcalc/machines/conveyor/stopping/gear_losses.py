"""Stop of the rigid conveyor whose gear losses change their side."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ptmcalc.machines.conveyor.machine.brakes import FloatArray, brakes_of, brakes_on_motors, braking
from ptmcalc.machines.conveyor.machine.drives import moving_mass
from ptmcalc.machines.conveyor.machine.model import BeltLine
from ptmcalc.machines.conveyor.machine.resistances import filled
from ptmcalc.machines.conveyor.machine.rigid_stop import rigid_stop
from ptmcalc.machines.conveyor.machine.scenes import ConveyorScene
from ptmcalc.machines.conveyor.machine.spec import Conveyor


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
_LONGEST = 4
"""Duration after which a stop with changing sides counts as endless, relative to that with fixed sides [1]; an
engineering choice."""


@dataclass(frozen=True, slots=True)
class _Geared:
    """A drive behind its gear, at the pulley surface: rotor [kg], efficiency, brakes on the motor shaft without losses
    over the steps of a stop [N], and the side on which the simulation keeps the losses."""

    rotor: float
    efficiency: float
    brakes: Sequence[float]
    driven: bool

    def share(self, driven: bool) -> float:
        """What the gear makes of a force behind it, which the belt drives or not [1]."""
        return 1 / self.efficiency if driven else self.efficiency

    def behind(self, step: int, acceleration: float) -> float:
        """Braking force behind the gear at a step [N]; above 0 the belt drives the rotor: its brakes take more than the
        rotor gives."""
        return self.brakes[step] + self.rotor * acceleration


def changing_sides(spec: Conveyor, scene: ConveyorScene, line: BeltLine) -> GearChange:
    """What a stop changes by when the losses of every gear are on the driven side at each moment.

        M_0 v' = -(W + B) - sum f_d,   f_d = q/eta where q > 0, else q eta,   q = B_motor + m_rotor v'

    **Range** a stop that comes to rest; no change otherwise.
    **Error** below 1/4000 of the stopping time.
    **Source** Newton's law; power through a gear.
    """
    fixed_time, fixed_way = rigid_stop(spec, scene, line)
    if not math.isfinite(fixed_time) or all(filled(one.gear.efficiency) == 1 for one in spec.all_drives.values()):
        return GearChange(0.0, 0.0, 0.0, 0.0)
    step = fixed_time / _STEPS
    times: FloatArray = step * np.arange(_LONGEST * _STEPS + 2.0)
    drives = _geared(spec, scene, times)
    acting = [braking(spec, brake) for brake in brakes_of(spec, scene).values() if brake.shaft != "motor"]
    rest = moving_mass(line) - sum(one.rotor * one.share(one.driven) for one in drives)
    resistance = line.static_resistance + line.tail_pull
    outside = (resistance + sum((one.over(times) for one in acting), np.zeros_like(times))).tolist()

    known: dict[tuple[float, ...], tuple[float, float]] = {}

    def rate(at: int) -> tuple[float, float]:
        """Acceleration at a step, and the difference of the gears' force to that of the fixed side; equal forces, as
        of brakes that are fully on, have one answer."""
        forces = (outside[at], *[one.brakes[at] for one in drives])
        if forces not in known:
            known[forces] = computed(at)
        return known[forces]

    def computed(at: int) -> tuple[float, float]:
        sides = [one.driven for one in drives]
        for _ in range(len(drives) + 2):
            speeds_up = _acceleration(rest, outside[at], drives, sides, at)
            found = [one.behind(at, speeds_up) > 0 for one in drives]
            if found == sides:
                break
            sides = found
        differs = sum(
            one.behind(at, speeds_up) * (one.share(side) - one.share(one.driven))
            for one, side in zip(drives, sides, strict=True)
            if side != one.driven
        )
        return speeds_up, abs(differs)

    at, time, speed, way, most = 0, 0.0, line.speed, 0.0, 0.0
    later = rate(0)
    while speed > 0 and at < _LONGEST * _STEPS:
        (first, differs), later = later, rate(at + 1)
        second, most = later[0], max(most, differs)
        change = (first + second) / 2 * step
        share = min(speed / -change, 1.0) if change < 0 else 1.0
        way += (speed + change * share / 2) * step * share
        at, time, speed = at + 1, time + step * share, speed + change * share if share == 1.0 else 0.0
    if speed > 0:
        return GearChange(0.0, 0.0, most, 0.0)
    return GearChange(time - fixed_time, way - fixed_way, most, abs(time / fixed_time - 1))


def _acceleration(rest: float, outside: float, drives: Sequence[_Geared], sides: Sequence[bool], at: int) -> float:
    """Acceleration at a step with the losses on given sides [m/s^2]."""
    mass, force = rest, outside
    for one, driven in zip(drives, sides, strict=True):
        share = one.share(driven)
        mass += one.rotor * share
        force += one.brakes[at] * share
    return -force / mass


def _geared(spec: Conveyor, scene: ConveyorScene, times: FloatArray) -> list[_Geared]:
    """The drives of a conveyor behind their gears, their brakes at times [s]."""
    found = []
    for name, drive in spec.all_drives.items():
        efficiency = filled(drive.gear.efficiency)
        on_motor = brakes_on_motors(spec, scene, name)
        rotor = drive.motor.count * (filled(drive.motor.inertia) + filled(drive.coupling_inertia))
        at_surface = rotor * (drive.gear.ratio * 2 / drive.drum.diameter) ** 2
        brakes = sum((one.over(times) for one in on_motor), np.zeros_like(times)).tolist()
        found.append(_Geared(at_surface, efficiency, brakes, bool(on_motor)))
    return found
