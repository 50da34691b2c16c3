"""Work done on a shaft in a motion, by a quadrature of its own: the reference of the energy balance.

Gauss nodes between the collocation nodes; the torque through the gear is taken from the acceleration of the motion, so
that no inertia of the motor's side is counted with one gear factor here and with another there.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.laws import duty
from ptmcalc.machines.shaft.machine.model import Machine
from ptmcalc.numerics import energy
from ptmcalc.numerics.cycle import Orbit

FloatArray = NDArray[np.float64]

ORDER = 18
"""Gauss nodes of a step or stretch in the energy balance [1]. A numerical choice: the rule is exact to degree 35 and
differs from the collocation nodes, 12 at most. Fewer raise the residual of a correct run; more cost time."""
TOLERANCE = 1e-9
"""Relative residual a balance may leave; above ten times that a run is not trusted."""


@dataclass(frozen=True)
class Ledger:
    """Works of a motion [J], integrals of the motor torque, and what the balance of the works leaves over."""

    drive: float
    useful: float
    loss: float
    brake: float
    motor_rms: float
    """root of the mean square of the motor torque over the time [N*m]"""
    motor_most: float
    """largest motor torque at the nodes, either way [N*m]"""
    residual: float

    @property
    def trusted(self) -> bool:
        """Whether the balance closes well enough."""
        return self.residual <= 10 * TOLERANCE


@dataclass(frozen=True)
class Nodes:
    """A motion at the nodes of its quadrature: angle, speed, acceleration, duration of a node, torques."""

    angle: FloatArray
    low: ArrayLike
    high: ArrayLike
    speed: FloatArray
    acceleration: FloatArray
    time_weight: FloatArray
    motor: FloatArray
    brake: FloatArray


def booked(machine: Machine, nodes: list[Nodes], stored: float) -> Ledger:
    """The works over the nodes of a motion that stores so much energy [J]."""
    drive, friction = machine.drive, machine.friction
    sums = np.zeros(5)
    turned_over = 0.0
    for n in nodes:
        useful = machine.useful_torque(n.angle, n.low, n.high)
        lost = friction + machine.viscous * n.speed + machine.share * np.abs(useful)
        inertia, slope, static = machine.fields(n.angle, n.low, n.high)
        resistance = static + machine.viscous * n.speed + slope * n.speed**2 / 2 + n.brake
        factor = drive.factor(n.motor, inertia, resistance)
        through = n.motor - drive.motor_inertia * drive.ratio * n.acceleration
        power = n.speed * n.time_weight
        torques = (drive.ratio * factor * through, useful, lost, n.brake, machine.potential_torque(n.angle))
        sums += [float(np.sum(torque * power)) for torque in torques]
        turned_over += sum(float(np.sum(np.abs(torque) * power)) for torque in torques)
    gained, useful_work, lost_work, braked, potential = sums.tolist()
    residual = energy.residual(gained, useful_work + lost_work + braked + potential, stored, turned_over)
    motor, times = (np.concatenate([getattr(n, part).ravel() for n in nodes]) for part in ("motor", "time_weight"))
    rms, most = duty.rms_torque(motor, times), float(np.abs(motor).max())
    return Ledger(gained, useful_work, lost_work, braked, rms, most, residual)


def over_angle(machine: Machine, orbit: Orbit, stage: int | None) -> Nodes:
    """A motion over the angle, long after the start or the command to stop."""
    angle, e, weight = orbit.sample(ORDER)
    speed = np.sqrt(2 * e)
    low, high = orbit.grid.edges[:-1, None], orbit.grid.edges[1:, None]
    motor, brake = np.zeros(angle.shape), np.zeros(angle.shape)
    if stage is None:
        brake = brake + machine.brake_most
    else:
        motor = machine.drive.torque(stage, speed)
    return Nodes(angle, low, high, speed, orbit.derivative(ORDER), weight / speed, motor, brake)
