"""A run-up or a run-out of a main shaft as numbers: where it begins, and where it ends."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found
from ptmcalc.machines.shaft.machine.cases import cycle_of, machine_for, machine_in
from ptmcalc.machines.shaft.machine.mechanism import filled
from ptmcalc.machines.shaft.machine.model import Machine
from ptmcalc.machines.shaft.machine.spec import RunOut, RunUp, Shaft, ShaftScene, Steady
from ptmcalc.machines.shaft.machine.steady import Cycle
from ptmcalc.machines.shaft.speed_changes import run_out_bounds, run_up_bounds

FloatArray = NDArray[np.float64]
_RUN_UP_SHARE = 0.95
"""Share [1] of the no-load speed at which a run-up ends without `to`. An engineering choice, stated with the key: at 1
the motor torque vanishes and the time is infinite. A larger value lengthens the run-up."""
_NARROWINGS = 5
"""Search steps for the largest kinetic energy, each with a spacing 1/20 of the last [1]. A numerical choice: five steps
locate the angle to below 1e-6 rad and the energy to rounding. Fewer leave an error of the energy; more only cost
time."""
_SAMPLES = np.linspace(0.0, 1.0, 41)


def target_speed(spec: Shaft, scene: RunUp) -> float:
    """Speed of the main shaft at which a run-up ends [rad/s]."""
    if scene.to is not None:
        return scene.to
    return _RUN_UP_SHARE * filled(spec.drive.motor.no_load_speed) / spec.drive.gear.ratio


def is_braked(spec: Shaft, scene: RunOut) -> bool:
    """Whether the brake is applied in a run-out."""
    return spec.brake is not None and scene.brake != "off"


def mean_torque(spec: Shaft, scene: ShaftScene) -> tuple[float, float]:
    """Speed [rad/s] and mean torque on the main shaft [N*m] that the change of the inertia is compared with; no torque
    where the motor does not carry the mean load."""
    machine = machine_in(spec, scene)
    drive = machine.drive
    if isinstance(scene, RunUp):
        speed = target_speed(spec, scene)
        w = np.linspace(0.0, speed, 201)
        torques = [drive.torque(run_up_bounds.stage_at_speed(machine, one), np.array([one]))[0] for one in w.tolist()]
        return speed, drive.efficiency * drive.ratio * float(np.mean(torques))
    if isinstance(scene, Steady):
        found = next(iter(machine.working_speeds), None)
        if found is None:
            return drive.free_speed or 1.0, 0.0
        return found, machine.survey.static_mean + machine.viscous * found
    assert isinstance(scene, RunOut)
    found = next(iter(machine_for(spec, scene.after).working_speeds), None) or drive.free_speed or 1.0
    torque = machine.survey.static_mean + machine.viscous * found
    if is_braked(spec, scene) and spec.brake is not None:
        torque += spec.brake.torque
    return found, torque


@dataclass(frozen=True)
class Departure:
    """Where a run-out may begin: the cycle it comes from, and the angle if the file states one."""

    machine: Machine
    cycle: Cycle
    angle: float | None
    mean: bool = False
    """whether the inertia is at its mean from then on"""

    def energies(self, angles: FloatArray) -> FloatArray:
        """Kinetic energy at angles as the gear passes it on in the run-out [J]."""
        machine = self.machine
        within = angles % machine.period
        side = machine.drive.efficiency * machine.drive.ratio**2 * machine.drive.motor_inertia
        return np.asarray((machine.mechanism(within)[0] + side) * self.cycle.orbit.at(within))

    def with_mean_inertia(self) -> "Departure":
        """The same state, from where the inertia stays at its mean."""
        return replace(self, machine=self.machine.with_mean_inertia(), mean=True)

    def largest_energy(self) -> tuple[float, float]:
        """The largest such energy over the cycle [J] and its angle [rad], narrowed down around the best of samples."""
        if self.mean in self.cycle.known:
            return self.cycle.known[self.mean]
        edges = self.cycle.orbit.grid.edges
        angles = (edges[:-1, None] + np.diff(edges)[:, None] * _SAMPLES).ravel()
        for _ in range(_NARROWINGS):
            energies = self.energies(angles)
            top = int(np.argmax(energies))
            low, high = angles[max(top - 1, 0)], angles[min(top + 1, len(angles) - 1)]
            angles = np.linspace(low, high, len(_SAMPLES))
        self.cycle.known[self.mean] = float(energies[top]), float(angles[0] + (angles[-1] - angles[0]) / 2)
        return self.cycle.known[self.mean]

    def beginning(self) -> dict[str, Found]:
        """Kinetic energy and speed at the angle of the file, or at the one with the largest energy."""
        angle = self.largest_energy()[1] if self.angle is None else self.angle % self.machine.period
        speed = self.cycle.speed_at(angle)
        energy = self.machine.kinetic_energy(angle, speed)
        at = {"angle": angle}
        return {
            "kinetic_energy": Found(Estimate.within(energy, 1e-9 * energy), at),
            "speed_run_out": Found(Estimate.within(speed, 1e-9 * speed), at),
        }


def departure(spec: Shaft, scene: RunOut) -> Departure:
    """Where a run-out begins.

    Raises:
        NumericsError: there is no steady cycle to begin in.
    """
    machine = machine_in(spec, scene)
    if not is_braked(spec, scene):
        machine = machine.without_brake()
    cycle = cycle_of(spec, scene.after)
    if cycle is None:
        raise NumericsError("NUM102", "the motor stalls: there is no steady cycle from which a stop could start")
    return Departure(machine, cycle, scene.start)


def wanted_stop(spec: Shaft, scene: RunOut) -> dict[str, float]:
    """The limits of the file for the time and the angle of a braked run-out."""
    if not is_braked(spec, scene):
        return {}
    limits = {"time": spec.checks.stop_time, "angle": spec.checks.stop_angle}
    return {name: limit for name, limit in limits.items() if limit is not None}


def stop_case(spec: Shaft, scene: RunOut) -> tuple[run_out_bounds.Stop, dict[str, float]]:
    """A run-out as closed forms take it, from the angle of the file or from the largest energy of the cycle.

    Raises:
        NumericsError: there is no steady cycle to begin in.
    """
    start = departure(spec, scene)
    at_angle = None if start.angle is None else float(start.energies(np.array([start.angle]))[0])
    energy = start.largest_energy()[0] if at_angle is None else at_angle
    return run_out_bounds.Stop(start.machine, energy, is_braked(spec, scene), at_angle is None), wanted_stop(
        spec, scene
    )
