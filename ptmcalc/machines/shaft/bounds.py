"""What can be said about a shaft without integrating its motion: closed forms, and intervals that hold the truth.

Steady cycle. With the motor's torque held at its mean the kinetic energy follows the work of the load alone. A working
motor adds D(w) - D(w_0), which has no mean over the cycle and a range of no more than k dw, so its work swings by no
more than k dw Theta/4; and somewhere the speed is w_0, at which the drive carries the mean load. The mean of its torque
is that of the load, so its root mean square differs from it by terms of second order alone.

Run-up. From J w' = D(w) - R(phi) - J' w^2/2 and the extremes of J, R and J' over the angle.

Run-out. With dphi = v ds, v = sqrt(2 T/J_m) the shaft is one of constant inertia J_m in a time s that runs at a rate
ds/dt between sqrt(J_m/J_high) and sqrt(J_m/J_low); a brake that comes up in time comes up in s between these rates.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.laws import shaft as law
from ptmcalc.machines.shaft.model import Machine

FloatArray = NDArray[np.float64]

_PLACES = 1441
"""Angles at which weights and springs are looked at."""
_BETWEEN = 1.01
"""For a torque that is larger between two of them; terms of order 60 come to less."""


# -- steady cycle ---------------------------------------------------------------------------------------------------


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


# -- run-up ---------------------------------------------------------------------------------------------------------

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(12)
_HALVINGS, _MOST_PANELS = 50, 1000
"""Refinement steps of the run-up integrals, and panels open at once above which the refinement ends [1]. A numerical
choice: 2^-50 of a speed range is near the resolution of floating-point numbers. Smaller values end the refinement
before the tolerance of 1e-12; larger ones only refine rounding."""


def start_integrals(
    machine: Machine, target: float, inertia: float, resistance: float, slope: float
) -> tuple[float, float]:
    """Time [s] and angle [rad] of a run-up with constant inertia and resistance; infinite where the motor stalls.

        t = integral of J dw/(D(w) - R - J' w^2/2),   phi = integral of w dt

    Panels between the corners of the motor's curves, halved until both integrals over each stand still: next to a speed
    that the motor does not exceed they are as short as it takes.
    """
    drive = machine.drive
    corners = {0.0, target}
    for k, stage in enumerate(drive.stages):
        corners |= {knot for knot in drive.knots(k).tolist() if 0 < knot < target}
        if stage.until_speed is not None and 0 < stage.until_speed / drive.ratio < target:
            corners.add(stage.until_speed / drive.ratio)
    edges = np.array(sorted(corners))
    time = angle = 0.0
    for low, high in pairwise(edges):
        number = stage_at_speed(machine, (low + high) / 2)

        def net(w: FloatArray, number: int = number) -> FloatArray:
            torque = drive.ratio * drive.efficiency * drive.torque(number, w)
            return np.asarray(torque - machine.viscous * w - resistance - slope * w**2 / 2)

        turned, revolved = _integrals(net, low, high)
        time, angle = time + inertia * turned, angle + inertia * revolved
    return time, angle


def _integrals(net: Callable[[FloatArray], FloatArray], low: float, high: float) -> tuple[float, float]:
    """Integrals of 1/net and w/net between two speeds; infinite where the net torque is not above 0 all the way."""
    ends = np.linspace(low, high, 9)
    begin, end = ends[:-1], ends[1:]
    known = np.zeros(2)
    for _ in range(_HALVINGS):
        middle = (begin + end) / 2
        if not np.all(net(np.concatenate([begin, middle, end])) > 0):
            return math.inf, math.inf
        whole, halves = _panels(net, begin, end), _panels(net, begin, middle) + _panels(net, middle, end)
        if not np.all(np.isfinite(halves)):
            return math.inf, math.inf
        off = np.any(np.abs(whole - halves) > 1e-12 * np.abs(halves) + 1e-16 * known[:, None], axis=0)
        known += halves[:, ~off].sum(axis=1)
        if not off.any():
            break
        if len(off) > _MOST_PANELS:  # what is left is rounding of the net torque
            known += halves[:, off].sum(axis=1)
            break
        begin, end = np.concatenate([begin[off], middle[off]]), np.concatenate([middle[off], end[off]])
    else:
        known += halves[:, off].sum(axis=1)
    return float(known[0]), float(known[1])


def _panels(net: Callable[[FloatArray], FloatArray], begin: FloatArray, end: FloatArray) -> FloatArray:
    """The two integrals over panels by Gauss's rule, shape (2, panels); infinite where the net torque is not > 0."""
    half = (end - begin)[:, None] / 2
    w = (end + begin)[:, None] / 2 + half * _NODES
    torque = net(w)
    dt = np.where(torque > 0, half * _WEIGHTS / np.where(torque > 0, torque, 1.0), np.inf)
    return np.array([dt.sum(axis=1), np.sum(w * dt, axis=1)])


def stage_at_speed(machine: Machine, speed: float) -> int:
    """The stage of the motor at a speed on the way up."""
    stages = machine.drive.stages
    for k, stage in enumerate(stages[:-1]):
        if stage.until_speed is None or machine.drive.ratio * speed < stage.until_speed:
            return k
    return len(stages) - 1


def drives_all_the_way(machine: Machine, target: float, slope_low: float) -> bool:
    """Whether power goes through the gear from the motor at every speed up to the one asked for."""
    drive, survey = machine.drive, machine.survey
    if not drive.lossy_both_ways:
        return True
    w = np.linspace(0.0, target, 257)
    torque = np.min([drive.torque(k, w) for k in range(len(drive.stages))], axis=0)
    resistance = survey.static_low + np.minimum(slope_low, 0.0) * w**2 / 2
    share = drive.ratio * drive.motor_inertia / max(survey.inertia_low, 1e-300)
    return bool(np.all(torque + share * np.minimum(resistance, 0.0) > 0))


def run_up_ranges(machine: Machine, target: float, *, changing: bool) -> dict[str, Interval]:
    """Intervals of time and angle of a run-up whatever way load and, if `changing`, inertia vary with the angle."""
    survey, drive = machine.survey, machine.drive
    side = drive.efficiency * drive.ratio**2 * drive.motor_inertia
    inertias, slopes = (survey.inertia_mean,) * 2, (0.0, 0.0)
    if changing:
        inertias, slopes = (survey.inertia_low, survey.inertia_high), (survey.slope_low, survey.slope_high)
    resistances = survey.static_low, survey.static_high
    ends = [
        start_integrals(machine, target, inertia + side, resistance, slope)
        for inertia, resistance, slope in zip(inertias, resistances, slopes, strict=True)
    ]
    return {name: Interval(ends[0][k], ends[1][k]) for k, name in enumerate(("run_up_time", "run_up_angle"))}


# -- run-out --------------------------------------------------------------------------------------------------------


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


# -- offsets --------------------------------------------------------------------------------------------------------


def offsets(held_in: Mapping[str, Interval], loads: Mapping[str, Estimate]) -> dict[str, Interval]:
    """How far the ends of each load's bar must move to hold an interval."""
    return {
        name: Interval(_less(interval.low, loads[name].low, -1), _less(interval.high, loads[name].high, 1))
        for name, interval in held_in.items()
        if name in loads
    }


def _less(end: float, bar: float, side: int) -> float:
    if end == bar or not math.isfinite(bar):
        return 0.0
    moved = end - bar
    return max(moved, 0.0) if side > 0 else min(moved, 0.0)
