"""What a measured speed record tells of a shaft: the curve of its motor, its losses, its brake."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base import units
from ptmcalc.base.errors import UsageError
from ptmcalc.base.units import Quantity
from ptmcalc.machines.shaft.machine.model import Machine
from ptmcalc.machines.shaft.records import slowing
from ptmcalc.numerics import decode

FloatArray = NDArray[np.float64]

PHASES = ("run_up", "run_out", "brake")
_ROWS = 25
"""Rows of the reported torque table at most [1]. An engineering choice: more rows lengthen the report. The summary
values do not depend on it."""
_TIMES = 2.6
"""Standard deviations in an uncertainty: 99 % of normally distributed errors."""
_SHORTEST, _SLOWEST = 1e-6, 1e-6
"""Least length [s] and largest speed [rad/s] of a record: no shaft is measured below them, and squares underflow."""
_PART, _SURE = 5, 5.0
"""Part of the record, the fifth at either end, whose mean speeds are compared, and the deviations that decide."""
_LARGEST = 1e15
"""Seconds and rad/s, as of every number of a design file: no record has more, and squares would overflow."""


@dataclass(frozen=True, slots=True)
class Row:
    """One line of what was found: time [s], speed [rad/s], torque [N*m] and its uncertainty [N*m]."""

    time: float
    speed: float
    torque: float
    uncertainty: float


@dataclass(frozen=True, slots=True)
class Value:
    """One number that sums a record up, with its uncertainty."""

    name: str
    title: str
    value: float
    uncertainty: float
    quantity: Quantity


@dataclass(frozen=True, slots=True)
class Decoded:
    """The torque of a record over its time, and the numbers that sum it up. `shaft` names the one they are on."""

    phase: str
    shaft: str
    rows: tuple[Row, ...]
    values: tuple[Value, ...]
    noise: float
    """standard deviation of a sample [rad/s]"""
    window: float
    """length of the stretches that were fitted [s]"""


def decoded(
    machine: Machine, phase: str, time: FloatArray, speed: FloatArray, angle: float, window: float | None
) -> Decoded:
    """The torque behind a record of the speed of the main shaft that begins at an angle, the machine without its load.

        run_up:   M_m = (J eps + w^2 J'/2 + M_loss)/(u eta) + J_m u eps     over the speed of the motor
        run_out:  M_loss = a + b w,   from J eps + w^2 J'/2 = -M_loss - M_weights
        brake:    M_b,   from J eps + w^2 J'/2 = -M_b s(t) - M_weights - M_loss

    In a run-out and under a brake the model is fitted to the whole record (`machines.shaft.slowing`); in a run-up, and
    for the torques over a `window`, polynomials to stretches of it. The losses in run-up and braking are those of the
    file. In a run-out the rotor drives the shaft through the gear.

    Raises:
        UsageError: the record is too short for a fit, or does not show the phase.
    """
    if len(time) < decode.FEWEST:
        raise UsageError(f"the record has {len(time)} samples, too few for a fit", f"at least {decode.FEWEST}")
    _sized(time, speed)
    samples = None if window is None else max(round(window / float(np.median(np.diff(time)))) + 1, 5)
    with np.errstate(all="ignore"):
        fitted = decode.fit(time, speed, samples)
    if phase == "brake" and machine.brake and time[-1] - time[0] <= machine.brake.delay + machine.brake.rise:
        hint = "a longer record, or a shorter `delay` and `rise` of the brake in the file"
        raise UsageError("the record ends before the brake is on with its full torque", hint)
    _moving(phase, fitted, speed)
    if phase == "run_up":
        total, deviation, known, _ = _on_shaft(machine, fitted, angle)
        rows, values = _run_up(machine, fitted, total + known, deviation)
        length = float(np.median(time[fitted.last] - time[fitted.first]))
        return _finite(Decoded(phase, "motor", rows, values, fitted.noise, length))
    most = slowing.too_long(machine, float(fitted.angle[-1]))
    if most or not math.isfinite(float(fitted.angle[-1])):
        turned, limit = (units.show(one, units.ANGLE) for one in (float(fitted.angle[-1]), most))
        raise UsageError(f"the shaft turns by {turned} in the record, more than {limit}", "select a part of the record")
    with np.errstate(all="ignore"):
        found = (slowing.run_out if phase == "run_out" else slowing.braked)(machine, time, speed, angle)
    values = _losses(found, float(np.median(speed))) if phase == "run_out" else _brake(found)
    if window is None:
        rows = _rows(time, found.parameters.fitted, found.torque, found.deviation)
        length = float(time[-1] - time[0])
    else:
        total, deviation, known, potential = _on_shaft(machine, fitted, angle)
        rows = _rows(time, fitted.speed, -total - (potential if phase == "run_out" else known), deviation)
        length = float(np.median(time[fitted.last] - time[fitted.first]))
    return _finite(Decoded(phase, "main", rows, values, found.parameters.noise, length))


def _sized(time: FloatArray, speed: FloatArray) -> None:
    """A record of times and speeds that a machine can have."""
    longest, fastest = float(np.abs(time).max()), float(np.abs(speed).max())
    if max(longest, fastest) > _LARGEST:
        raise UsageError(f"the record has a time or speed above {_LARGEST:.0e}", "check the units of its columns")
    span = float(time[-1] - time[0])
    if span < _SHORTEST:
        raise UsageError(f"the record lasts {span:.2g} s, less than {_SHORTEST:g} s", "check the unit of `time`")
    if fastest < _SLOWEST:
        reason = f"the largest speed of the record is {fastest:.2g} rad/s: the shaft is at standstill"
        raise UsageError(reason, "check the unit of `speed`")


def _moving(phase: str, fitted: decode.Fitted, speed: FloatArray) -> None:
    """The shaft turns forward, and speeds up in a run-up, slows down else."""
    if float(np.median(speed)) < 0:
        raise UsageError("the shaft rotates backward in the record", "change the sign of the speeds")
    part = max(len(speed) // _PART, 3)
    first, last = float(np.mean(speed[:part])), float(np.mean(speed[-part:]))
    unsure = _SURE * fitted.noise * math.sqrt(2 / part)
    shown = f"from {units.show(first, units.ANGULAR_SPEED)} to {units.show(last, units.ANGULAR_SPEED)}"
    if phase == "run_up" and last < first - unsure:
        raise UsageError(
            f"the speed decreases {shown}: the record shows no run-up", "write `--phase run_out` or `brake`"
        )
    if phase != "run_up" and last > first + unsure:
        name = "run-out" if phase == "run_out" else "braking"
        raise UsageError(f"the speed increases {shown}: the record shows no {name}", "write `--phase run_up`")


def _finite(found: Decoded) -> Decoded:
    """What was decoded, if it is numbers."""
    numbers = [number for row in found.rows for number in (row.torque, row.uncertainty)]
    numbers += [number for one in found.values for number in (one.value, one.uncertainty)]
    if not all(map(math.isfinite, numbers)):
        reason = "the model does not fit the record for any finite torque"
        raise UsageError(reason, "check the units of its columns and the phase")
    return found


def _on_shaft(
    machine: Machine, fitted: decode.Fitted, angle: float
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Sum of all torques over the record with its deviation, all that the file knows of it, and the weights alone."""
    place = (angle + fitted.angle) % machine.period
    low, high = np.zeros(place.shape), np.full(place.shape, machine.period)
    mechanism, slope, static = machine.fields(place, low, high)
    side = machine.drive.efficiency * machine.drive.ratio**2 * machine.drive.motor_inertia
    total, deviation = decode.torque(fitted, mechanism + side, slope)
    return total, deviation, static + machine.viscous * fitted.speed, machine.potential_torque(place)


def _rows(time: FloatArray, speed: FloatArray, torque: FloatArray, deviation: FloatArray) -> tuple[Row, ...]:
    """So many lines, spread over the record."""
    picked = np.unique(np.linspace(0, len(torque) - 1, _ROWS).round().astype(int))
    columns = (time[picked], speed[picked], torque[picked], _TIMES * deviation[picked])
    return tuple(Row(*map(float, line)) for line in zip(*columns, strict=True))


def _run_up(
    machine: Machine, fitted: decode.Fitted, on_shaft: FloatArray, deviation: FloatArray
) -> tuple[tuple[Row, ...], tuple[Value, ...]]:
    drive = machine.drive
    torque, spread = on_shaft / (drive.ratio * drive.efficiency), deviation / (drive.ratio * drive.efficiency)
    rows = _rows(fitted.time, drive.ratio * fitted.speed, torque, spread)
    most = int(np.argmax(torque))
    ends = (("torque_first", "torque at the beginning", 0), ("torque_most", "largest torque", most))
    return rows, tuple(
        Value(name, title, float(torque[k]), _TIMES * float(spread[k]), units.TORQUE) for name, title, k in ends
    )


def _losses(found: slowing.Slowing, speed: float) -> tuple[Value, ...]:
    """Constant and viscous losses, and both at the median speed of the record, which is known best."""
    _, friction, viscous = found.parameters.values.tolist()
    covariance = found.parameters.covariance
    mean = friction + viscous * speed
    variance = covariance[1, 1] + 2 * speed * covariance[1, 2] + speed**2 * covariance[2, 2]
    unsure = _TIMES * math.sqrt(max(float(variance), 0.0))
    if not unsure < abs(mean) and math.isfinite(unsure):
        raise UsageError(
            f"the record is too short for its noise: losses of {units.show(mean, units.TORQUE)} ±"
            f" {units.show(unsure, units.TORQUE, 2)}",
            "a longer record, or one with less noise",
        )
    if mean < 0:
        reason = f"the shaft gains {units.show(-mean, units.TORQUE)}: the record shows no coasting"
        raise UsageError(reason, "check `inertia`, `potential` and `--from`")
    one, other = (_TIMES * math.sqrt(max(float(covariance[k, k]), 0.0)) for k in (1, 2))
    return (
        Value("friction", "constant losses", friction, one, units.TORQUE),
        Value("viscous", "losses per speed", viscous, other, units.TORQUE_SLOPE),
        Value("losses", f"losses at {units.show(speed, units.ANGULAR_SPEED)}", mean, unsure, units.TORQUE),
    )


def _brake(found: slowing.Slowing) -> tuple[Value, ...]:
    """The full torque."""
    value, variance = float(found.parameters.values[1]), float(found.parameters.covariance[1, 1])
    unsure = _TIMES * math.sqrt(max(variance, 0.0))
    if value + unsure < 0:
        reason = f"the shaft gains {units.show(-value, units.TORQUE)}: the record shows no braking"
        raise UsageError(reason, "check `inertia`, `losses` and `--from`")
    return (Value("brake", "full torque of the brake", value, unsure, units.TORQUE),)
