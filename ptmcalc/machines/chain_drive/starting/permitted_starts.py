"""Permitted starts per hour of the motors: given by the manufacturer, or no-load starts of the catalogue reduced by
inertia, load torque and load."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import replace

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.components import motor_starts
from ptmcalc.contract.check import AnyCheck, Check, Sense, blames, no_repair
from ptmcalc.contract.limits import key
from ptmcalc.contract.result import LoadInfo
from ptmcalc.laws import loop_bounds, slip_heat, start_profile
from ptmcalc.machines.chain_drive.machine.model import FloatArray, chain_line, drive_of, filled, mean_arm
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Run, Start
from ptmcalc.machines.chain_drive.starting.motion import StartCase, speed_over_time
from ptmcalc.machines.chain_drive.starting.motor_force import start_force
from ptmcalc.machines.chain_drive.starting.rigid_curve import rigid_start

PERMITTED = LoadInfo("starts_permitted", "permitted starts per hour of the motor", units.RATIO, headline=False)
_AT_SPEED = 0.99
"""Share of the largest speed at which a start along a curve is over [1]; an engineering choice. The slip of steady
running is part of the running load."""


def permitted_parts(spec: ChainDrive) -> Iterator[LoadInfo]:
    """The load, where the file gives the starts of the chain or those that its motors permit."""
    if _counts(spec):
        yield PERMITTED


def _counts(spec: ChainDrive) -> bool:
    if spec.drive is None:
        return False
    motor = spec.drive.motor
    return any(one is not None for one in (spec.starts_per_hour, motor.starts_per_hour, motor.no_load_starts))


def _missing(spec: ChainDrive) -> tuple[KeyPath, ...]:
    drive = drive_of(spec)
    return motor_starts.missing_keys(drive.motor, ("drive", "motor"), drive.fluid_coupling is not None)


def permitted_starts(spec: ChainDrive, scene: Start, case: StartCase) -> dict[str, Estimate]:
    """Permitted starts per hour of one motor on the mains, for starts of a scene.

        Z = Z_0 k_P (J w_0^2/2)/Q,   Q = integral M (w_0 - w) dt

    Q is the rotor heat of the start, J w_0^2/2 that of the rotor alone. For a constant torque M_H of the motor and
    M_L of the load this is the rule of manufacturers:

        Z = Z_0 k_J k_M k_P,   k_J = J/(J + J_X),   k_M = 1 - M_L/M_H

    J_X: inertia of all that the motor moves besides its rotor, at its shaft.

    **Range** cage motors on the mains; starts at equal intervals, many in the time constant of the motor; the chain
    runs on between them.
    **Error** of the heat: the largest torque times twice the angle by which the stretch of the chain leads the motor;
    catalogues read k_P from a chart.
    **Source** `components.motor_starts.reduced_starts`.
    """
    motor = drive_of(spec).motor
    if scene.profile.imposes_speed or not _counts(spec):
        return {}
    if motor.starts_per_hour is not None:
        return {PERMITTED.name: Estimate.exact(motor.starts_per_hour)}
    if _missing(spec):
        return {}
    return {PERMITTED.name: motor_starts.reduced_starts(motor, _running_load(spec, scene), _heat(spec, scene, case))}


def _running_load(spec: ChainDrive, scene: Start) -> float:
    """Torque of one motor in the running that follows a start, relative to its rated torque [1]."""
    drive = drive_of(spec)
    force, efficiency = chain_line(spec, Run(load=scene.load)).static_resistance, filled(drive.gear.efficiency)
    torque = force * (efficiency if force < 0 else 1 / efficiency) / (drive.motor.count * _turns(spec))
    return abs(torque) / filled(drive.motor.rated_torque)


def _turns(spec: ChainDrive) -> float:
    """Angle of the motor shaft per travel of the chain [rad/m]."""
    return drive_of(spec).gear.ratio / mean_arm(spec)


def _heat(spec: ChainDrive, scene: Start, case: StartCase) -> Estimate:
    """Heat of one rotor in a start of the rigid chain, with what its stretch may change [J]; infinite where the motors
    do not move it."""
    course = _along_the_curve(spec, scene, case) if case.follows_curve else _by_torque(spec, case)
    if course is None:
        return Estimate.exact(math.inf)
    times, torque, speed, sharpest = course
    fast, turns = filled(motor_starts.no_load_speed(drive_of(spec).motor)), _turns(spec)
    heat = slip_heat.slip_heat(times, torque, np.full_like(times, fast), np.minimum(speed * turns, fast))
    lead = 2 * float(np.abs(torque).max()) * turns * loop_bounds.drive_lead(case.masses, sharpest)
    return Estimate(heat, max(heat - lead, 0.0), heat + lead, model=lead)


Course = tuple[FloatArray, FloatArray, FloatArray, float]
"""Times [s], torque of one motor [N*m] and speed of the rigid chain [m/s] until it is at speed, and its largest
acceleration [m/s^2]."""


def _by_torque(spec: ChainDrive, case: StartCase) -> Course | None:
    if not case.moves:
        return None
    times, speeds = speed_over_time(case)
    times, speeds = times[times <= case.duration], speeds[: int((times <= case.duration).sum())]
    rises = start_profile.rise(case.shape, case.rise_time, times)
    return times, drive_of(spec).mean_torque * np.asarray(rises), speeds, case.acceleration


def _along_the_curve(spec: ChainDrive, scene: Start, case: StartCase) -> Course | None:
    found = rigid_start(spec, scene)
    if found is None:
        return None
    last = int(np.argmax(found.speeds >= _AT_SPEED * found.fastest)) + 1
    times, speeds = found.times[:last], found.speeds[:last]
    motors = start_force(spec, case).motors
    pulls = [motors(found.release + time, speed)[0] for time, speed in zip(times, speeds, strict=True)]
    return times, np.array(pulls) / drive_of(spec).motor.count, speeds, found.sharpest


def _checked(spec: ChainDrive, scene: Start) -> Iterable[AnyCheck]:
    """On the mains, where the file gives the starts of the chain or those of the motors."""
    return (replace(STARTS, each=None),) if _counts(spec) and not scene.profile.imposes_speed else ()


def _needs(spec: ChainDrive, scene: Start) -> tuple[KeyPath, ...]:
    given = () if spec.starts_per_hour is not None else (("starts_per_hour",),)
    return (*given, *_missing(spec))


STARTS: Check[ChainDrive, Start] = Check(
    code="CHN137",
    title="motor starts per hour, permitted",
    question="Do the motors permit the number of starts per hour?",
    failure="motor starts too often",
    scenes=frozenset({Start}),
    loads=(PERMITTED.name,),
    sense=Sense.AT_LEAST,
    limit=key(
        "starts_per_hour",
        meaning="Starts per hour of the chain",
        valid="any start on the mains",
        error="none: a given value",
    ),
    needs=_needs,
    blame=blames("starts_per_hour"),
    repair=no_repair,
    each=_checked,
    what="The permitted starts per hour of each mains-fed motor are at least those of the chain. No-load starts of the"
    " catalogue are reduced by inertia, load torque and load.",
    why="Each start heats rotor and winding. Starts that follow before the motor has cooled overheat its insulation.",
    formula="Z_0 k_P (J w_0^2/2)/Q >= n",
    source="SEW-EURODRIVE, Manual Gear Units and Gearmotors, Starting frequency; Bonfiglioli, catalogue A, 5.6",
)
