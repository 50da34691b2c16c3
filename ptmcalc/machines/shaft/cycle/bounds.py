"""Closed forms of the steady cycle, and intervals that hold the true one.

With the motor's torque held at its mean the kinetic energy follows the work of the load alone. A working motor adds
D(w) - D(w_0), which has no mean over the cycle and a range of no more than k dw, so its work swings by no more than
k dw Theta/4; and somewhere the speed is w_0, at which the drive carries the mean load. The mean of its torque is that
of the load, so its root mean square differs from it by terms of second order alone.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ptmcalc.base.estimate import ANYTHING, Interval
from ptmcalc.laws import shaft as law
from ptmcalc.machines.shaft.machine.model import Machine


@dataclass(frozen=True)
class Held:
    """A steady cycle with the motor's torque held at its mean: where the motor works, and how the work swings."""

    machine: Machine
    speed: float
    """w_0, at which the motor carries the mean of all torques [rad/s]"""
    swing: float
    """largest less smallest work of the torques over the cycle [J]"""
    inertia: float
    inertia_low: float
    inertia_high: float
    """mean, smallest and largest inertia, the motor's side included [kg*m^2]"""

    def with_mean_inertia(self) -> "Held":
        """The same without the change of the inertia."""
        return Held(self.machine, self.speed, self.swing, self.inertia, self.inertia, self.inertia)

    def with_flywheel(self, added: float) -> "Held":
        """The same with more inertia."""
        parts = (self.inertia + added, self.inertia_low + added, self.inertia_high + added)
        return Held(self.machine, self.speed, self.swing, *parts)

    @property
    def irregularity(self) -> float:
        """Irregularity with the mean inertia: dw = Delta_A/(J w_0)."""
        return self.swing / self.inertia / self.speed**2

    @property
    def drive_torque(self) -> float:
        """Torque of the drive on the main shaft [N*m]."""
        return self.machine.survey.static_mean + self.machine.viscous * self.speed

    def motor_torque(self, speed: float) -> float:
        """Torque of the motor at a speed of the main shaft [N*m]."""
        drive = self.machine.drive
        return float(drive.torque(len(drive.stages) - 1, np.array([speed]))[0])


def held(machine: Machine) -> Held | None:
    """The cycle with the motor's torque held, None where the motor does not carry the mean load or has to brake."""
    speed = next(iter(machine.working_speeds), None)
    if speed is None or not machine.sound:
        return None
    survey, drive = machine.survey, machine.drive
    motor_side = drive.efficiency * drive.ratio**2 * drive.motor_inertia
    parts = (survey.inertia_mean, survey.inertia_low, survey.inertia_high)
    found = Held(machine, speed, survey.work_swing, *(part + motor_side for part in parts))
    return found if found.motor_torque(speed) > 0 or not drive.lossy_both_ways else None


def with_changing_inertia(cycle: Held) -> Interval:
    """Interval of the irregularity with the motor's torque held, whatever way the inertia changes between its extremes.

    x = w^2 = 2 T/J,  (w_max + w_min)/2 = w_0,  delta = (x_max - x_min)/(2 w_0^2)
    """
    w, low, high = cycle.speed, cycle.inertia_low, cycle.inertia_high
    ends = []
    for inertia in (low, high):
        rest = w - cycle.swing / inertia / w / 2
        if rest <= 0:
            return ANYTHING
        ends.append(inertia * rest**2 / 2)
    lowest, highest = ends
    apart = 1 / low - 1 / high
    most = 2 * cycle.swing / low + 2 * highest * apart
    differences = [2 * cycle.swing / high - 2 * energy * apart for energy in (lowest, highest)]
    least = 0.0 if min(differences) <= 0 <= max(differences) else min(abs(one) for one in differences)
    return Interval(least / w**2 / 2, most / w**2 / 2)


@dataclass(frozen=True)
class Working:
    """What a working motor makes of a cycle: ranges of irregularity, speeds [rad/s] and motor torque [N*m]."""

    irregularity: Interval
    mean: Interval
    highest: Interval
    lowest: Interval
    torque: Interval
    torque_rms: Interval


def with_working_motor(cycle: Held, irregularity: Interval) -> Working | None:
    """Ranges of the true cycle from that with the motor's torque held, None where nothing can be said.

    `irregularity` holds that of the motor held. The range dw of the speed is the least number that is not below what it
    allows itself; a motor held that is let go bit by bit never comes beyond it.
    """
    w, low, high = cycle.speed, cycle.inertia_low, cycle.inertia_high
    if not irregularity.bounded:
        return None
    d = irregularity.high * w
    swing_high = 2 * irregularity.high * w**2
    reach = d
    for _ in range(200):
        falls = _falls(cycle, w - reach, w + reach)
        if falls is None or reach >= w / 2:
            return None
        extra = falls.high * reach * cycle.machine.period / 4
        level = high * d / 4 * (2 * w + d / 2) + extra
        spread = 2 * extra / low + 2 * level * (1 / low - 1 / high)
        wider = (swing_high + spread) / (2 * (w - reach / 2))
        if wider <= reach * (1 + 1e-9):
            break
        reach = wider * (1 + 1e-6)
    else:
        return None
    least = max(2 * irregularity.low * w**2 - spread, 0.0)
    torques = sorted(cycle.motor_torque(speed) for speed in (w - reach, w + reach))
    if cycle.machine.drive.lossy_both_ways and not _always_drives(cycle, torques[0]):
        return None
    return Working(
        Interval(least / (2 * (w + reach / 2) ** 2), (swing_high + spread) / (2 * (w - reach / 2) ** 2)),
        Interval(w - reach / 2, w + reach / 2),
        Interval(w, w + reach),
        Interval(w - reach, w),
        Interval(torques[0], torques[1]),
        _rms_torque(cycle, reach, falls),
    )


def _rms_torque(cycle: Held, reach: float, falls: Interval) -> Interval:
    """Range of the root mean square over time of the motor's torque, for speeds within a range dw about w_0.

    The drive's torque D, which falls by `falls` with the speed, has the mean of all torques as its mean over the angle,
    so the motor's has M_0 but for what viscous friction makes of the mean speed:

        |<M> - M_0| <= d (k_max - k_min)/(k_max + k_min) dw/(eta i)

    Over time an angle counts as 1/w. A covariance is no more than a quarter of the product of the ranges, R and
    dw/w_low (Gruess; Popoviciu for the variance), and not below 0 of two that both fall with the speed, as M does where
    it is not viscous friction alone that makes D fall.

        <M> <= <M>_t <= <M> + R dw/w_low/4
        <M>_t^2 <= M_rms^2 <= <M>^2 + R^2/4 + 2 M_high R dw/w_low/4
    """
    drive, machine, slowest = cycle.machine.drive, cycle.machine, cycle.speed - reach
    passed = drive.efficiency * drive.ratio
    unlike = (falls.high - falls.low) / (falls.high + falls.low)
    off = machine.viscous * unlike * reach / passed
    torque = cycle.motor_torque(cycle.speed)
    spread = max(falls.high - machine.viscous, machine.viscous - falls.low) * reach / passed
    turned = spread * reach / slowest / 4
    least, most = torque - off, torque + off
    highest = max(abs(cycle.motor_torque(speed)) for speed in (slowest, cycle.speed + reach))
    square = max(abs(least), abs(most)) ** 2 + spread**2 / 4 + 2 * highest * turned
    lost = turned if falls.low < machine.viscous else 0.0
    return Interval(max(least - lost, -(most + turned), 0.0), math.sqrt(square))


def _always_drives(cycle: Held, torque: float) -> bool:
    """Whether power goes through the gear from the motor at every moment, if the motor gives so much at least."""
    if torque <= 0:
        return False
    drive, survey = cycle.machine.drive, cycle.machine.survey
    if drive.motor_inertia == 0:
        return True
    resistance = survey.static_low + survey.slope_low * (2 * cycle.speed) ** 2 / 2
    return torque * survey.inertia_low + drive.ratio * drive.motor_inertia * min(resistance, 0.0) > 0


def _falls(cycle: Held, low: float, high: float) -> Interval | None:
    """Least and largest fall of the drive's torque between two speeds, with the speed on the main shaft [N*m*s/rad];
    None where it does not fall all the way."""
    machine = cycle.machine
    drive, last = machine.drive, len(machine.drive.stages) - 1
    speeds = np.linspace(low, high, 65)
    knots = [knot for knot in drive.knots(last) if low < knot < high]
    speeds = np.sort(np.concatenate([speeds, [knot * (1 + side) for knot in knots for side in (-1e-9, 1e-9)]]))
    falls = machine.viscous - drive.efficiency * drive.ratio * drive.slope(last, speeds)
    bend = float(np.abs(np.diff(falls, 2)).max(initial=0.0))
    if not knots:
        falls = np.concatenate([falls - bend / 4, falls + bend / 4])
    return Interval(float(falls.min()), float(falls.max())) if falls.min() > 0 else None


def slope_at_balance(cycle: Held) -> float:
    """Fall of the drive's torque with the speed on the main shaft where it carries the mean load [N*m*s/rad]."""
    drive = cycle.machine.drive
    slope = float(drive.slope(len(drive.stages) - 1, np.array([cycle.speed]))[0])
    return max(-drive.efficiency * drive.ratio * slope, 0.0)


def flywheel(cycle: Held, wanted: float, irregularity: Callable[[Held], Interval]) -> Interval:
    """Interval of the inertia to be added, from that of the irregularity at every inertia, by bisection."""

    def needed(end: Callable[[Interval], float]) -> float:
        low, high = 0.0, cycle.inertia
        if end(irregularity(cycle)) <= wanted:
            return 0.0
        for _ in range(60):
            if end(irregularity(cycle.with_flywheel(high))) <= wanted:
                break
            low, high = high, 4 * high
        else:
            return math.inf
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (low, middle) if end(irregularity(cycle.with_flywheel(middle))) <= wanted else (middle, high)
        return high

    return Interval(needed(lambda found: found.low), needed(lambda found: found.high))


def works(machine: Machine, slowest: float, fastest: float) -> dict[str, Interval]:
    """Intervals of the works of a cycle and of what follows from them, for speeds in a range."""
    survey = machine.survey
    constant = machine.friction * machine.period + survey.share_work
    lost = [constant + machine.viscous * speed * machine.period for speed in (slowest, fastest)]
    useful = survey.useful_work
    found = {"work_loss": Interval(*lost), "work_drive": Interval(useful + lost[0], useful + lost[1])}
    shares = [cycle_shares(useful, one) for one in lost]
    found["cycle_efficiency"] = Interval(*sorted(efficiency for efficiency, _ in shares))
    found["loss_factor"] = Interval(*sorted(factor for _, factor in shares))
    return found


def cycle_shares(useful: float, lost: float) -> tuple[float, float]:
    """Efficiency and loss factor of a cycle; a load that drives the machine leaves nothing to be compared with: minus
    and plus infinity."""
    if useful >= 0:
        return float(law.cycle_efficiency(useful, lost)), float(law.loss_factor(useful, lost))
    drive = useful + lost
    return (useful / drive, lost / drive) if drive > 0 else (-math.inf, math.inf)
