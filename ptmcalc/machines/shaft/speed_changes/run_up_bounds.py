"""Closed forms of a run-up, and intervals that hold the true one.

From J w' = D(w) - R(phi) - J' w^2/2 and the extremes of J, R and J' over the angle.
"""

import math
from collections.abc import Callable
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.estimate import Interval
from ptmcalc.machines.shaft.machine.model import Machine

FloatArray = NDArray[np.float64]
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
