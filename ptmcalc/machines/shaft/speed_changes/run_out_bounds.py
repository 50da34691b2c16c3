"""Closed forms of a run-out, and intervals that hold the true one.

With dphi = v ds, v = sqrt(2 T/J_m) the shaft is one of constant inertia J_m in a time s that runs at a rate ds/dt
between sqrt(J_m/J_high) and sqrt(J_m/J_low); a brake that comes up in time comes up in s between these rates.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from ptmcalc.base.estimate import ANYTHING, Interval
from ptmcalc.laws import shaft as law
from ptmcalc.machines.shaft.machine.model import Machine

_PLACES = 1441
"""Angles at which weights and springs are looked at."""
_BETWEEN = 1.01
"""For a torque that is larger between two of them; terms of order 60 come to less."""


@dataclass(frozen=True)
class Stop:
    """A run-out as numbers: the energy it begins with [J] and the brake that acts."""

    machine: Machine
    energy: float
    """kinetic energy as the gear passes it on [J]"""
    braked: bool
    largest: bool = False
    """whether that is the largest of the cycle, and the angle it begins at any one"""

    def ended(self, side: int, *, changing: bool, brake: float | None = None) -> tuple[float, float]:
        """Time [s] and angle [rad] of the run-out: the shortest it can be (-1), of the means (0), the longest (1)."""
        machine, survey = self.machine, self.machine.survey
        motor_side = machine.drive.efficiency * machine.drive.ratio**2 * machine.drive.motor_inertia
        inertia = survey.inertia_mean + motor_side
        slow = fast = 1.0
        if changing:
            slow, fast = (math.sqrt((one + motor_side) / inertia) for one in (survey.inertia_low, survey.inertia_high))
        rate, other = {-1: (fast, slow), 0: (1.0, 1.0), 1: (slow, fast)}[side]
        loss = {-1: survey.static_high, 0: survey.static_mean, 1: survey.static_low}[side]
        given = machine.brake if self.braked else None
        torque = 0.0 if given is None else given.torque if brake is None else brake
        delay, rise = (given.delay, given.rise) if given else (0.0, 0.0)
        speed = math.sqrt(2 * self.energy / inertia)
        time, angle = law.braked_stop(inertia, speed, loss, machine.viscous / other, torque, delay / rate, rise / rate)
        return time * {-1: slow, 0: 1.0, 1: fast}[side], angle


def coasts_forward(stop: Stop) -> bool:
    """Whether in a run-out the rotor pushes the shaft through the gear all the time, and never the shaft the rotor."""
    machine = stop.machine
    if machine.drive.motor_inertia == 0 or not machine.drive.lossy_both_ways:
        return True
    survey = machine.survey
    square = 2 * stop.energy / survey.inertia_low
    return survey.static_low + min(survey.slope_low, 0.0) * square / 2 > 0


def holds(machine: Machine) -> bool:
    """Whether losses and brake outweigh weights and springs at any angle, so that a shaft at rest stays there."""
    place = np.linspace(0.0, machine.period, _PLACES)
    turns = np.abs(machine.potential_torque(place % machine.period))
    held = machine.friction + float(machine.brake_torque(np.array([math.inf]))[0])
    return float(turns.max()) * _BETWEEN <= held


def run_out_ranges(stop: Stop, *, changing: bool, wanted: Mapping[str, float]) -> dict[str, Interval]:
    """Intervals of the loads of a run-out whatever way torques and, if `changing`, inertia vary with the angle."""
    if stop.machine.survey.inertia_low <= 0:
        return dict.fromkeys(("run_out_time", "run_out_angle", *["brake_torque_needed"] * bool(wanted)), ANYTHING)
    ends = [stop.ended(side, changing=changing) for side in (-1, 1)]
    found = {name: Interval(ends[0][k], ends[1][k]) for k, name in enumerate(("run_out_time", "run_out_angle"))}
    if wanted:
        needed = [torque_needed(stop, wanted, side, changing=changing) for side in (-1, 1)]
        found["brake_torque_needed"] = Interval(needed[0], needed[1])
    return found


def torque_needed(stop: Stop, wanted: Mapping[str, float], side: int, *, changing: bool) -> float:
    """Brake torque with which a run-out keeps the wanted time and angle, by bisection; infinite where none does."""

    def keeps(torque: float) -> bool:
        time, angle = stop.ended(side, changing=changing, brake=torque)
        return time <= wanted.get("time", math.inf) and angle <= wanted.get("angle", math.inf)

    if keeps(0.0):
        return 0.0
    low, high = 0.0, max(stop.machine.brake.torque if stop.machine.brake else 0.0, 1e-6)
    for _ in range(200):
        if keeps(high):
            break
        low, high = high, 4 * high
        if high > 1e18:
            return math.inf
    for _ in range(100):
        middle = (low + high) / 2
        if not low < middle < high:
            break
        low, high = (low, middle) if keeps(middle) else (middle, high)
    return high


def recoverable(stop: Stop, ranges: Mapping[str, Interval], *, changing: bool) -> Interval:
    """Interval of what could be recovered: the energy less the least and the most the losses can take [J]."""
    machine, angle = stop.machine, ranges["run_out_angle"]
    survey, reverse = machine.survey, machine.drive.reverse_efficiency
    if not stop.braked:
        return Interval(0.0, 0.0)
    if not angle.bounded:
        return Interval(0.0, stop.energy * reverse)
    fastest = math.sqrt(2 * stop.energy / (survey.inertia_low if changing else survey.inertia_mean))
    most = (survey.static_high + machine.viscous * fastest) * angle.high
    least = survey.static_low * angle.low
    smallest = _least_energy(stop, angle.low, changing=changing) if stop.largest else stop.energy
    ends = zip((smallest, stop.energy), (most, least), strict=True)
    return Interval(*(float(law.recoverable_energy(energy, lost, reverse)) for energy, lost in ends))


def _least_energy(stop: Stop, turned: float, *, changing: bool) -> float:
    """The least energy a run-out that turns so far can have begun with, by bisection on the longest one."""
    low, high = 0.0, stop.energy
    for _ in range(60):
        middle = (low + high) / 2
        farther = replace(stop, energy=middle).ended(1, changing=changing)[1] >= turned
        low, high = (low, middle) if farther else (middle, high)
    return low
