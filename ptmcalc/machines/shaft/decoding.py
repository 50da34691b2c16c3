"""What a measured speed record tells of a shaft: the curve of its motor, its losses, its brake."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base import units
from ptmcalc.base.errors import UsageError
from ptmcalc.base.units import Quantity
from ptmcalc.machines.shaft.model import Machine
from ptmcalc.numerics import decode

FloatArray = NDArray[np.float64]

PHASES = ("run_up", "run_out", "brake")
_ROWS = 25
_TWO = 2.0
"""Standard deviations in an uncertainty: 95 % of normally distributed errors."""
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
        run_out:  M_loss = -(J eps + w^2 J'/2) - M_weights                  on the main shaft, as a + b w
        brake:    M_b = -(J eps + w^2 J'/2) - M_weights - M_loss            on the main shaft

    The losses in run-up and braking are those of the file. In a run-out the rotor drives the shaft through the gear.

    Raises:
        UsageError: the record is too short for a fit, or the phase is not in it.
    """
    if len(time) < decode.FEWEST:
        raise UsageError(f"the record has {len(time)} samples, too few for a fit", f"at least {decode.FEWEST}")
    if max(float(np.abs(time).max()), float(np.abs(speed).max())) > _LARGEST:
        raise UsageError(f"the record has a time or speed above {_LARGEST:.0e}", "check the units of its columns")
    samples = None if window is None else max(round(window / float(np.median(np.diff(time)))) + 1, 5)
    fitted = decode.fit(time, speed, samples)
    total, deviation, known, potential = _on_shaft(machine, fitted, angle)
    length = float(np.median(time[fitted.last] - time[fitted.first]))
    if phase == "run_up":
        rows, values = _run_up(machine, fitted, total + known, deviation)
        return Decoded(phase, "motor", rows, values, fitted.noise, length)
    if phase == "run_out":
        torque = -total - potential
        shorter = decode.fit(
            time, speed, max(round(float(np.median(fitted.last - fitted.first)) / 2), decode.DEGREE + 2)
        )
        of_shorter, deviations, _, weights = _on_shaft(machine, shorter, angle)
        values = _losses(_line(fitted, torque, deviation), _line(shorter, -of_shorter - weights, deviations))
    else:
        torque = -total - known
        values = _brake(machine, fitted, torque, deviation)
    return Decoded(phase, "main", _rows(fitted, fitted.speed, torque, deviation), values, fitted.noise, length)


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


def _rows(fitted: decode.Fitted, speed: FloatArray, torque: FloatArray, deviation: FloatArray) -> tuple[Row, ...]:
    """So many lines, spread over the record."""
    picked = np.unique(np.linspace(0, len(torque) - 1, _ROWS).round().astype(int))
    columns = (fitted.time[picked], speed[picked], torque[picked], _TWO * deviation[picked])
    return tuple(Row(*map(float, line)) for line in zip(*columns, strict=True))


def _run_up(
    machine: Machine, fitted: decode.Fitted, on_shaft: FloatArray, deviation: FloatArray
) -> tuple[tuple[Row, ...], tuple[Value, ...]]:
    drive = machine.drive
    torque, spread = on_shaft / (drive.ratio * drive.efficiency), deviation / (drive.ratio * drive.efficiency)
    rows = _rows(fitted, drive.ratio * fitted.speed, torque, spread)
    most = int(np.argmax(torque))
    ends = (("torque_first", "torque at the beginning", 0), ("torque_most", "largest torque", most))
    return rows, tuple(
        Value(name, title, float(torque[k]), _TWO * float(spread[k]), units.TORQUE) for name, title, k in ends
    )


def _line(fitted: decode.Fitted, loss: FloatArray, deviation: FloatArray) -> decode.Line:
    picked = fitted.apart(0, len(loss) - 1)
    if len(picked) < 3:
        raise UsageError("the record is too short for its noise: no line can be put through the losses", "a longer one")
    return decode.line(fitted.speed[picked], loss[picked], deviation[picked])


def _losses(line: decode.Line, shorter: decode.Line) -> tuple[Value, ...]:
    """The line through the losses. What it differs by from that of stretches half as long is added to its uncertainty:
    a cubic that does not follow the motion errs the same way at every turn, which no scatter tells."""
    offset = _TWO * line.offset_deviation + abs(line.offset - shorter.offset)
    slope = _TWO * line.slope_deviation + abs(line.slope - shorter.slope)
    return (
        Value("friction", "constant losses", line.offset, offset, units.TORQUE),
        Value("viscous", "losses per speed", line.slope, slope, units.TORQUE_SLOPE),
    )


def _brake(machine: Machine, fitted: decode.Fitted, brake: FloatArray, deviation: FloatArray) -> tuple[Value, ...]:
    """The full torque: from stretches after delay and rise of the file."""
    since = fitted.time - fitted.time[0]
    begin = (machine.brake.delay + machine.brake.rise) if machine.brake else 0.0
    picked = fitted.apart(int(np.searchsorted(since, begin)), len(since) - 1)
    if not len(picked):
        hint = "a longer record, or a shorter `--window`"
        raise UsageError("the record ends before the brake is on with its full torque", hint)
    value, spread = decode.mean(brake[picked], deviation[picked])
    return (Value("brake", "full torque of the brake", value, _TWO * spread, units.TORQUE),)
