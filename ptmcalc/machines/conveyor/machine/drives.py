"""What the drives pull: in steady motion, over a start, and the rigid conveyor under it."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from ptmcalc.components.motor import ConverterMotor
from ptmcalc.components.starting_gear import SoftStarter, StarDelta, in_star
from ptmcalc.laws import start_profile
from ptmcalc.machines.conveyor.machine.keys.drives import PlacedDrive
from ptmcalc.machines.conveyor.machine.load_sharing import steady_forces
from ptmcalc.machines.conveyor.machine.loading import Filling
from ptmcalc.machines.conveyor.machine.model import (
    BeltLine,
    FloatArray,
    belt_line,
    belt_line_filled,
    drive_force,
    keeps_length,
    turns,
)
from ptmcalc.machines.conveyor.machine.resistances import filled
from ptmcalc.machines.conveyor.machine.scenes import ControlledStop, ConveyorScene, Start, steady
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.numerics.belt.compiled import forces, start_on_curves
from ptmcalc.numerics.belt.curve import CurveStage, MotorForce

_NEARLY, _LEAST_UP_TO = 0.98, 0.9
"""Speeds that end a start [1]; engineering choices. `_NEARLY`: relative to the speed at which the force falls to the
resistance, which is approached without end; a larger value gives a longer starting time. `_LEAST_UP_TO`: relative to
the rated speed; the minimum force is taken below it, as the motor torque falls to the load above."""
_SETTLED, _FASTEST, _LOOKS = 0.99, 4.0, 1201
"""`_SETTLED`: speed of a start on curves relative to its last speed [1] at which it counts as over; an engineering
choice: a larger value follows the start longer. `_FASTEST`, `_LOOKS`: range of that speed relative to the rated one [1]
and speeds tried in it; numerical choices: steps of a quarter of a per cent."""
_LATE_STAGE = 1e6
"""Time at which all stages that end by time, and all ramps, are over [s]. A numerical choice far beyond any start; a
value within a start evaluates the wrong stage."""
_CURVE_STEPS = 4000
"""Steps of the rigid start along a motor curve; a numerical choice. A step is 1/400 of the time at mean acceleration,
and the integration stops after 200 such times. Heun's rule has an error of second order: twice the number takes twice
the time and leaves a quarter of the error."""
CONVERTER_STEPS = 2000
"""The same of starts on converters, of which only the end of the window is taken; a numerical choice. Fewer steps are
unstable on steep slip lines."""


def running(spec: Conveyor, scene: ConveyorScene, filling: Filling | None = None) -> BeltLine:
    """The belt in steady motion: drives at the tail take their share of the resistance there."""
    line = belt_line_filled(spec, scene, filling) if filling else belt_line(spec, scene)
    at_tail = [name for name, drive in spec.all_drives.items() if drive.at == "tail"]
    if not at_tail:
        return line
    forces = steady_forces(spec, line)
    line = replace(line, tail_pull=sum(forces[name] for name in at_tail))
    if keeps_length(spec, scene):
        return replace(line, takeup_tension=running(spec, steady(scene), filling).mean_tension)
    return line


def moving_mass(line: BeltLine) -> float:
    """Everything that moves, at the rim [kg]."""
    belt = line.carry.line_mass * line.carry.length + line.back.line_mass * line.back.length
    return belt + line.tail_mass + line.drive_mass


def pull(scene: Start, drive: PlacedDrive, rise: float) -> Callable[[FloatArray], FloatArray]:
    """Rim force of a drive over a start [N]."""
    full, shape, delay = drive_force(drive), scene.profile.rise, drive.delay
    aborted = scene.aborted
    again = aborted.run + aborted.pause if aborted else 0.0

    def since(times: FloatArray) -> FloatArray:
        on = times >= 0
        return np.where(on, full * start_profile.rise(shape, rise, np.maximum(times, 0.0)), 0.0)

    def force(times: FloatArray) -> FloatArray:
        times = np.asarray(times, float)
        second = since(times - again - delay)
        if not aborted:
            return second
        return np.where(times < aborted.run, since(times - delay), second)

    return force


def rigid_start(
    spec: Conveyor, scene: Start, line: BeltLine, pulls: dict[str, Callable[[FloatArray], FloatArray]]
) -> tuple[float, float]:
    """When the mean speed of all that moves is the rated one, and the way by then, by the trapezium rule; of a start
    that is broken off, when it is that after the drives came back.

    v = x - min(x so far),  x = integral of (F - W)/M dt: the mean of all that moves, whatever waves there are
    """
    mass, resistance = moving_mass(line), line.static_resistance + line.tail_pull
    full = sum(drive_force(drive) for drive in spec.all_drives.values())
    if full <= resistance:
        return 0.0, 0.0
    latest = max(drive.delay for drive in spec.all_drives.values()) + scene.profile.rise_time
    again = (scene.aborted.run + scene.aborted.pause) if scene.aborted else 0.0
    latest += again
    end = latest + mass * line.speed / (full - resistance)
    times = np.linspace(0.0, end, 20_001)
    force = sum((pull(times) for pull in pulls.values()), np.zeros_like(times)) - resistance
    gained = np.concatenate([[0.0], np.cumsum(force[1:] + force[:-1])]) * (times[1] / 2 / mass)
    speed = gained - np.minimum.accumulate(gained)  # it never turns back: what would pull it back is held
    if again > 0:
        speed = _between(gained, line.speed)
    first = int(np.searchsorted(times, again))
    has_it = speed[first:] >= line.speed
    fast = (
        max(first + int(has_it.argmax()), 1) if has_it.any() else len(times) - 1
    )  # but for rounding it has at the end
    if speed[fast - 1] >= line.speed:  # it never lost its speed
        return float(times[fast]), float((speed[1 : fast + 1] + speed[:fast]).sum()) * times[1] / 2
    part = min((line.speed - speed[fast - 1]) / (speed[fast] - speed[fast - 1]), 1.0) * times[1]
    way = float((speed[1:fast] + speed[: fast - 1]).sum()) * times[1] / 2
    return float(times[fast - 1] + part), way + float((speed[fast - 1] + line.speed) / 2 * part)


def _between(gained: FloatArray, top: float) -> FloatArray:
    """Speed that gains so much, but stays at rest where it would fall below, and at the motors' where it would rise
    above."""
    speed = 0.0
    found = [speed]
    for more in np.diff(gained).tolist():
        speed = min(max(speed + more, 0.0), top)
        found.append(speed)
    return np.array(found)


def along_curve(scene: Start, drive: PlacedDrive, creep: float = 0.0) -> MotorForce:
    """Rim force of a drive and its slope over the rim's speed, by its motors' curve.

    F = n M(w, t) i eta/R driving,   n M i/(eta R) where the motors brake,   w = v (1 - creep) i/R

    `creep` is the part by which the pulley is slower than the belt that comes to the drives of its place [1].
    """
    curve, starter, coupling = drive.start_curve, drive.starter, drive.fluid_coupling
    assert curve is not None
    stages = curve.curve_stages
    if isinstance(starter, StarDelta):
        stages = in_star(stages, starter.switch_over * filled(curve.no_load_speed))
    return replace(
        _switched(scene, drive, stages, creep),
        reference=curve.speed if isinstance(curve, ConverterMotor) else 0.0,
        ramp=curve.ramp_time if isinstance(curve, ConverterMotor) else 0.0,
        fill=coupling.time_constant if coupling is not None else 0.0,
        soft_from=starter.initial_voltage if isinstance(starter, SoftStarter) else 1.0,
        soft_time=starter.time if isinstance(starter, SoftStarter) else 0.0,
    )


def on_converter(scene: Start, drive: PlacedDrive, creep: float = 0.0) -> MotorForce:
    """Rim force of a drive and its slope over the rim's speed, whose converter follows the profile of a start.

    F as in `along_curve` at the speed w + w_0 (1 - p(t))

    The converter keeps the ratio of voltage and frequency: the slip speed below the synchronous speed w_0 p(t) gives
    the torque. After an aborted start, the profile p(t) begins anew.

    **Range** motors with a curve; filled couplings; up to rated frequency, without a torque limit of the converter.
    **Error** none of its own; at low frequency the stator resistance reduces the real torque.
    **Source** derived: induction motor at constant flux.
    """
    curve = drive.running_curve
    assert curve is not None
    return replace(
        _switched(scene, drive, curve.curve_stages[-1:], creep),
        reference=filled(curve.no_load_speed),
        ramp=scene.profile.rise_time,
        shape=scene.profile.rise,
    )


def lowered_by_converter(
    scene: ControlledStop, drive: PlacedDrive, creep: float, speed: float, steady: float
) -> MotorForce:
    """Rim force of a drive and its slope over the rim's speed, whose converter lowers the speed of the belt to 0.

    F as in `along_curve` at the speed w + w_0 (1 - q (1 - p(t))),   w_0 (1 - q) = w_s - V (1 - creep) i/R

    q w_0 is the synchronous speed at which the belt runs at its rated speed V; at rated frequency its motors turn with
    w_s.

    Args:
        scene: the stop, with its profile p(t).
        drive: the drive; its motor has a curve.
        creep: part by which the pulley is slower than the belt that comes to the drives of its place [1].
        speed: V [m/s].
        steady: w_s [rad/s].

    **Range** motors with a curve; up to rated frequency, without a torque limit of the converter.
    **Error** none of its own; at low frequency the stator resistance reduces the real torque.
    **Source** derived: induction motor at constant flux.
    """
    curve = drive.running_curve
    assert curve is not None
    motors, no_load = _motors(drive, curve.curve_stages[-1:], creep), filled(curve.no_load_speed)
    return replace(
        motors,
        reference=no_load,
        ramp=scene.time,
        shape=scene.shape,
        falls_from=1 - (steady - speed * motors.turns) / no_load,
    )


def _switched(scene: Start, drive: PlacedDrive, stages: Sequence[CurveStage], creep: float) -> MotorForce:
    """The motors of a drive with the times at which a start switches them."""
    aborted = scene.aborted
    return replace(
        _motors(drive, stages, creep),
        delay=drive.delay,
        off=aborted.run if aborted else -math.inf,
        again=drive.delay + (aborted.run + aborted.pause if aborted else 0.0),
    )


def _motors(drive: PlacedDrive, stages: Sequence[CurveStage], creep: float) -> MotorForce:
    """The motors of a drive, switched on."""
    efficiency, per_metre = filled(drive.gear.efficiency), drive.motor.count * turns(drive)
    return MotorForce(stages, (1 - creep) * turns(drive), per_metre * efficiency, per_metre / efficiency)


def least_pull(spec: Conveyor, scene: Start) -> float:
    """Least force of all drives together on the way up to nine tenths of rated speed [N]."""
    curves = [along_curve(scene, drive) for drive in spec.all_drives.values()]
    top = _LEAST_UP_TO * spec.speed
    speeds = [
        *np.linspace(0.0, top, 181).tolist(),
        *(speed for curve in curves for speed in curve.marks if speed < top),
    ]
    return min(sum(curve(_LATE_STAGE, float(speed))[0] for curve in curves) for speed in speeds)


def at_rest(curve: MotorForce) -> Callable[[FloatArray], FloatArray]:
    """The force at standstill over time [N]."""
    return lambda times: forces(curve, times, np.zeros(np.shape(times)))


def rigid_curve_start(
    line: BeltLine, curves: Mapping[str, MotorForce], steps: int = _CURVE_STEPS
) -> tuple[float, float, float]:
    """When the rigid body reaches rated speed, or nearly the speed at which its motors' curves leave it, its way by
    then, and when it has nearly that last speed, by Heun's rule; zeros where it never gets away."""
    mass, resistance = moving_mass(line), line.static_resistance + line.tail_pull
    speeds = np.linspace(0.0, line.speed, 201)
    late = np.full(len(speeds), _LATE_STAGE)
    rates = (np.sum([forces(curve, late, speeds) for curve in curves.values()], axis=0) - resistance) / mass
    least = float(rates.min())
    settles = float(speeds[rates <= 0][0]) if least <= 0 else line.speed
    goal = line.speed if least > 0 else _NEARLY * settles
    if goal <= 0:
        return 0.0, 0.0, 0.0
    steady = goal if least <= 0 else max(_SETTLED * _steady_speed(line, curves, resistance), goal)
    typical = float(np.maximum(rates[speeds <= goal], 0.0).mean())
    step = goal / typical / (steps / 10)
    return start_on_curves(tuple(curves.values()), resistance, mass, goal, steady, step, 20 * steps)


def _steady_speed(line: BeltLine, curves: Mapping[str, MotorForce], resistance: float) -> float:
    """Highest speed at which the drives carry the resistance once their start is over [m/s]."""
    speeds = np.linspace(line.speed, _FASTEST * line.speed, _LOOKS)
    late = np.full(_LOOKS, _LATE_STAGE)
    carried = np.sum([forces(curve, late, speeds) for curve in curves.values()], axis=0) >= resistance
    return float(speeds[carried][-1]) if carried.any() else line.speed
