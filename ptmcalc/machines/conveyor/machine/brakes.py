"""Brakes: which act in a scene, where, and with what force at the rim over time."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.machines.conveyor.machine.keys.drives import Brake
from ptmcalc.machines.conveyor.machine.resistances import filled
from ptmcalc.machines.conveyor.machine.scenes import ControlledStop, ConveyorScene, EmergencyStop, Stop
from ptmcalc.machines.conveyor.machine.spec import Conveyor

FloatArray = NDArray[np.float64]


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

    def over(self, times: FloatArray) -> FloatArray:
        """Capacity over time [N]."""
        since = times - self.delay
        part = np.clip(since / self.rise, 0.0, 1.0) if self.rise > 0 else np.ones_like(since)
        return np.where(since > 0, self.force * part, 0.0)


def brakes_of(spec: Conveyor, scene: ConveyorScene) -> dict[str, Brake]:
    """The brakes that act in a scene; in a controlled stop they close at standstill."""
    if isinstance(scene, ControlledStop):
        return {name: one.model_copy(update={"delay": scene.time + one.delay}) for name, one in spec.brakes.items()}
    acts = isinstance(scene, EmergencyStop) or (isinstance(scene, Stop) and scene.brakes == "on")
    return dict(spec.brakes) if acts else {}


def braking(spec: Conveyor, brake: Brake) -> Braking:
    """A brake at the rim: a brake on the motor shaft is driven through the gear, whose losses add to it.

    F = M/R   (drum shaft)        F = M i/(eta R)   (motor shaft)

    It acts on the last drive there; at a tail without one, on the tail drum.
    """
    name = _drive_of(spec, brake)
    if name is None:
        diameter = spec.tail_drum.diameter or spec.main_drive.drum.diameter
        return Braking(brake.torque * 2 / diameter, brake.delay, brake.rise_time)
    drive = spec.all_drives[name]
    force = brake.torque * 2 / drive.drum.diameter
    if brake.shaft == "motor":
        force *= drive.gear.ratio / filled(drive.gear.efficiency)
    return Braking(force, brake.delay, brake.rise_time)


def braking_at_shaft(spec: Conveyor, brake: Brake) -> Braking:
    """A brake with its own torque at the rim, without the losses of a gear: what heats it."""
    name = _drive_of(spec, brake)
    if name is None or brake.shaft != "motor":
        return braking(spec, brake)
    drive = spec.all_drives[name]
    return Braking(brake.torque * drive.gear.ratio * 2 / drive.drum.diameter, brake.delay, brake.rise_time)


def _drive_of(spec: Conveyor, brake: Brake) -> str | None:
    """The drive a brake acts on; none at a drum that is not driven."""
    there = [name for name, drive in spec.all_drives.items() if drive.at == brake.at]
    return there[-1] if there else None


def braked_shafts(spec: Conveyor, scene: ConveyorScene) -> set[str | None]:
    """Drives whose gears the belt drives: with a brake on the motor shaft that acts in a scene; all of them where the
    motors brake the belt."""
    if isinstance(scene, ControlledStop):
        return set(spec.all_drives)
    return {_drive_of(spec, brake) for brake in brakes_of(spec, scene).values() if brake.shaft == "motor"}


def brakes_on_motors(spec: Conveyor, scene: ConveyorScene, name: str) -> list[Braking]:
    """Brakes on the motor shaft of a drive that act in a scene, at the pulley surface without losses of the gear."""
    drive = spec.all_drives[name]
    at_surface = drive.gear.ratio * 2 / drive.drum.diameter
    return [
        Braking(brake.torque * at_surface, brake.delay, brake.rise_time)
        for brake in brakes_of(spec, scene).values()
        if brake.shaft == "motor" and _drive_of(spec, brake) == name
    ]
