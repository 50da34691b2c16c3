"""A shaft that slows down, as a model whose parameters a record tells: losses a + b w, or the torque of a brake."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.machines.shaft.machine.model import Machine
from ptmcalc.numerics import curve_fit

FloatArray = NDArray[np.float64]

_TABLE = 8192
"""Points of the tables of inertia and weights over a cycle: straight lines between them err by less than 1e-6."""
_TURN_OF_A_STEP = 0.1
"""Angle of an integration step [rad]: one of fourth order errs by less than 1e-6 of the speed."""
_FEWEST, _MOST = 400, 8_000
"""Steps of an integration: enough for the delay of a brake, and two seconds of work at most for all parameters."""
_WIDEST = 0.2
"""Largest angle of a step [rad]: it errs by less than 1e-5 of the speed."""


@dataclass(frozen=True, slots=True)
class Slowing:
    """What a record tells: the parameters in the order initial speed, then losses or brake torque; and at each sample
    the torque with its deviation."""

    parameters: curve_fit.Parameters
    torque: FloatArray
    deviation: FloatArray


def run_out(machine: Machine, time: FloatArray, speed: FloatArray, angle: float) -> Slowing:
    """Losses of a run-out, from the whole record.

        J w' + w^2 J'/2 = -(a + b w) - M_weights,   w(0) = w_0

    **Range** rotation in one sense; J, J' and the weights are those of the file.
    **Error** that of the fit (`numerics.curve_fit`); a step in angle of 0.1 rad.
    **Source** energy equation of the shaft; classical fourth-order Runge-Kutta method.
    """

    def losses(since: float, w: FloatArray, sets: FloatArray) -> FloatArray:
        return np.asarray(sets[:, 1] + sets[:, 2] * w)

    inertia, span, top = _size(machine), float(time[-1] - time[0]), float(np.abs(speed).max())
    slope = (float(speed[-1]) - float(speed[0])) / span
    begin = np.array([float(np.mean(speed[:3])), -inertia * slope, 0.0])
    scale = np.array([top, inertia * top / span, inertia / span])
    found = curve_fit.fit(_model(machine, time, angle, losses), begin, scale, speed)
    w = found.fitted
    gradient = np.stack([np.zeros(len(w)), np.ones(len(w)), w], axis=1)
    torque = found.values[1] + found.values[2] * w
    return Slowing(found, torque, _deviation(gradient, found))


def braked(machine: Machine, time: FloatArray, speed: FloatArray, angle: float) -> Slowing:
    """Torque of a brake over delay and rise of the file, from the whole record.

        J w' + w^2 J'/2 = -M_b s(t) - M_loss - M_weights,   w(0) = w_0

    **Range** rotation in one sense; losses, delay and rise are those of the file.
    **Error** as of `run_out`; of the losses that of the file, one to one.
    **Source** energy equation of the shaft; classical fourth-order Runge-Kutta method.
    """

    def torque(since: float, w: FloatArray, sets: FloatArray) -> FloatArray:
        return np.asarray(sets[:, 1] * _share(machine, since) + machine.friction + machine.viscous * w)

    inertia, span, top = _size(machine), float(time[-1] - time[0]), float(np.abs(speed).max())
    slope = (float(speed[-1]) - float(speed[0])) / span
    begin = np.array([float(np.mean(speed[:3])), max(-inertia * slope - machine.friction, 0.0)])
    found = curve_fit.fit(_model(machine, time, angle, torque), begin, np.array([top, inertia * top / span]), speed)
    shares = np.array([_share(machine, since) for since in (time - time[0]).tolist()])
    gradient = np.stack([np.zeros(len(shares)), shares], axis=1)
    return Slowing(found, found.values[1] * shares, _deviation(gradient, found))


def _deviation(gradient: FloatArray, found: curve_fit.Parameters) -> FloatArray:
    variance = np.einsum("ni,ij,nj->n", gradient, found.covariance, gradient)
    return np.asarray(np.sqrt(np.maximum(variance, 0.0)))


def _share(machine: Machine, since: float) -> float:
    """Torque of the brake so long after the command, relative to the full one."""
    brake = machine.brake
    if brake is None:
        return 1.0
    late = since - brake.delay
    return float(late >= 0) if brake.rise == 0 else min(max(late / brake.rise, 0.0), 1.0)


def _size(machine: Machine) -> float:
    drive = machine.drive
    return float(machine.survey.inertia_mean + drive.efficiency * drive.ratio**2 * drive.motor_inertia)


Torque = Callable[[float, FloatArray, FloatArray], FloatArray]


def _model(machine: Machine, time: FloatArray, angle: float, against: Torque) -> curve_fit.Model:
    """Speeds at the times of a record for many sets of parameters, of which the first is the initial speed."""
    since = time - time[0]
    fields = _tables(machine)

    def speeds(sets: FloatArray) -> FloatArray:
        grid = _grid(machine, float(since[-1]), float(np.abs(sets[:, 0]).max()))
        phi, w = np.full(len(sets), angle), sets[:, 0].copy()

        def rate(t: float, at: FloatArray, v: FloatArray) -> FloatArray:
            inertia, slope, weights = fields(at)
            found = -(against(t, v, sets) + weights + slope * v * v / 2) / inertia
            return np.where((v <= 0) & (found < 0), 0.0, found)

        start, slopes, ends, last = [np.empty((len(grid) - 1, len(sets))) for _ in range(4)]
        for k, (t, until) in enumerate(zip(grid[:-1].tolist(), grid[1:].tolist(), strict=True)):
            h = until - t
            inner, outer = t + 1e-9 * h, until - 1e-9 * h  # a brake that sets in at an edge does so outside of the step
            k1 = rate(inner, phi, w)
            w2 = w + h / 2 * k1
            k2 = rate((t + until) / 2, phi + h / 2 * w, w2)
            w3 = w + h / 2 * k2
            k3 = rate((t + until) / 2, phi + h / 2 * w2, w3)
            w4 = w + h * k3
            k4 = rate(outer, phi + h * w3, w4)
            after = w + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            start[k], slopes[k], ends[k], last[k] = w, k1, after, k4
            stops = (w > 0) & (w4 <= 0)
            ends[k] = np.where(stops, w + h * k1, after)
            last[k] = np.where(stops, k1, k4)
            phi = phi + h / 6 * (w + 2 * w2 + 2 * w3 + w4)
            w = np.maximum(ends[k], 0.0)
        return _between(grid, since, (start, slopes, ends, last))

    return speeds


def _grid(machine: Machine, end: float, speed: float) -> FloatArray:
    """Times of the integration steps, with those at which the brake begins and is on."""
    turned = speed * end / _TURN_OF_A_STEP if machine.changing or _weighs(machine) else 0.0
    count = int(min(max(turned, _FEWEST), _MOST))
    edges = [] if machine.brake is None else [machine.brake.delay, machine.brake.delay + machine.brake.rise]
    inside = [edge for edge in edges if 0 < edge < end]
    return np.unique(np.concatenate([np.linspace(0.0, end, count + 1), inside]))


def too_long(machine: Machine, turned: float) -> float:
    """Largest angle of a record that steps of 0.2 rad can follow, where it turns by more; else 0 [rad]."""
    most = _MOST * _WIDEST
    return most if turned > most and (machine.changing or _weighs(machine)) else 0.0


def _weighs(machine: Machine) -> bool:
    place = np.linspace(0.0, machine.period, 129)[:-1]
    return bool(np.any(machine.potential_torque(place) != 0))


def _between(grid: FloatArray, since: FloatArray, parts: tuple[FloatArray, ...]) -> FloatArray:
    """Speeds at some times by the cubic through the ends of each step and its slopes there, shape (k, n)."""
    at = np.clip(np.searchsorted(grid, since, side="right") - 1, 0, len(grid) - 2)
    h = (grid[at + 1] - grid[at])[:, None]
    x = ((since - grid[at]) / h[:, 0])[:, None]
    start, slope, end, last = (part[at] for part in parts)
    found = (
        start * (1 + 2 * x) * (1 - x) ** 2
        + slope * h * x * (1 - x) ** 2
        + end * x**2 * (3 - 2 * x)
        + last * h * x**2 * (x - 1)
    )
    return np.asarray(np.where(start > 0, np.maximum(found, 0.0), found).T)


def _tables(machine: Machine) -> Callable[[FloatArray], tuple[FloatArray, FloatArray, FloatArray]]:
    """Inertia with the motor's side, its slope and the torque of the weights, between points of a table."""
    place = np.linspace(0.0, machine.period, _TABLE + 1)
    mechanism, slope = machine.mechanism(place % machine.period)
    drive = machine.drive
    inertia = mechanism + drive.efficiency * drive.ratio**2 * drive.motor_inertia
    table = np.stack([inertia, slope, machine.potential_torque(place % machine.period)])
    rises = np.diff(table, axis=1)

    def fields(angle: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        x = (angle % machine.period) / machine.period * _TABLE
        k = np.minimum(np.maximum(x.astype(np.intp), 0), _TABLE - 1)  # `clip` and brackets take twice as long
        found = table.take(k, axis=1) + rises.take(k, axis=1) * (x - k)
        return found[0], found[1], found[2]

    return fields
