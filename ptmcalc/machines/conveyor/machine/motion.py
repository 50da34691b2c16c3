"""A scene in which the belt moves: its window, and what sets it in motion or stops it over time."""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from ptmcalc.base.memory import kept_for
from ptmcalc.laws import capstan, start_profile
from ptmcalc.machines.conveyor.machine.drives import (
    CONVERTER_STEPS,
    along_curve,
    at_rest,
    lowered_by_converter,
    moving_mass,
    on_converter,
    pull,
    rigid_curve_start,
    rigid_start,
    running,
)
from ptmcalc.machines.conveyor.machine.keys.converter import leaders
from ptmcalc.machines.conveyor.machine.keys.drives import PlacedDrive
from ptmcalc.machines.conveyor.machine.load_sharing import (
    creep_of,
    motors_of,
    starting_shares,
    steady_forces,
    steady_motor_speeds,
)
from ptmcalc.machines.conveyor.machine.model import BeltLine, FloatArray, drive_force
from ptmcalc.machines.conveyor.machine.rigid_stop import deceleration, rigid_stop
from ptmcalc.machines.conveyor.machine.scenes import ControlledStop, ConveyorScene, Jam, Start, Stopping
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.numerics.belt.curve import MotorForce

_CONTOURS = 2.0
"""Contour times after standstill that belong to a stop [1]. A numerical choice. More take longer; fewer may omit a late
extreme."""
_AFTER_JAM = 4.0
"""Contour times after a pulley has jammed [1]: one period of the lowest mode of a uniform loop, after which friction
damps. More take longer; fewer may omit a late extreme."""
AFTER_START = 2.0
"""Contour times after the pulley has its speed [1]: half a period of the lowest mode of a uniform loop. More take
longer; fewer may omit a late extreme."""
MOST_ROUNDS = 1000.0
"""Contour times of a scene from which on it is not simulated [1]. A numerical choice: the run then takes a minute. A
larger value allows longer runs; a smaller one leaves more scenes without a simulation."""
_LATE = 1.25
"""Time to standstill of the belt relative to the rigid body for which the window is sufficient [1]. A numerical choice.
A larger value takes longer; a smaller one repeats more runs with a longer window."""


@dataclass(frozen=True, slots=True)
class Moving:
    """A scene in numbers: the belt, its window, and what sets it in motion or stops it.

    `forces` gives the rim force of every drive over time [N], `imposed` the speed of all drums where the drives
    control it.
    """

    spec: Conveyor
    scene: ConveyorScene
    line: BeltLine
    pulls: dict[str, Callable[[FloatArray], FloatArray]]
    imposed: Callable[[FloatArray], FloatArray] | None
    speed: float
    window: float
    rigid_time: float
    """when the rigid body reaches rated speed, or rest [s]"""
    rigid_way: float
    """what it goes by then [m]"""
    curves: Mapping[str, MotorForce] = field(default_factory=dict)
    """rim forces of drives that follow their motors' curves"""

    @property
    def begins_loose(self) -> bool:
        """Whether the belt lies without friction in it at the start."""
        return isinstance(self.scene, Start) and self.scene.belt == "relaxed"

    @property
    def brings_to_rest(self) -> bool:
        """Whether the scene ends with a belt at rest."""
        return isinstance(self.scene, Stopping)


def moving(spec: Conveyor, scene: ConveyorScene) -> Moving:
    """A scene of this conveyor in motion, over its window."""
    case = _usual(spec, scene)
    factor: float = getattr(scene, "window_factor", 1.0)
    return case if factor == 1 else replace(case, window=case.window * factor)


@kept_for(64)
def _usual(spec: Conveyor, scene: ConveyorScene) -> Moving:
    """The same over the usual window."""
    line = running(spec, scene)
    names = list(spec.all_drives)
    if isinstance(scene, Start):
        return _start(spec, scene, line)
    if isinstance(scene, Jam):
        held = steady_forces(spec, line)
        there = [name for name in names if spec.all_drives[name].at != scene.at]
        pulls = {name: _constant(held[name] if name in there else 0.0) for name in names}
        return Moving(
            spec, scene, line, pulls, None, spec.speed, scene.duration or _AFTER_JAM * line.contour_time, 0, 0
        )
    if isinstance(scene, ControlledStop):
        return _controlled_stop(spec, scene, line)
    assert isinstance(scene, Stopping)
    time, way = rigid_stop(spec, scene, line)
    window = (_LATE * time if math.isfinite(time) else 2 * line.contour_time) + _CONTOURS * line.contour_time
    return Moving(spec, scene, line, {name: _constant(0.0) for name in names}, None, spec.speed, window, time, way)


def _controlled_stop(spec: Conveyor, scene: ControlledStop, line: BeltLine) -> Moving:
    """The converters hold the speed of the pulleys; with drives at both ends, the frequencies of the motors."""
    time, way = rigid_stop(spec, scene, line)
    window, pulls = time + _CONTOURS * line.contour_time, {name: _constant(0.0) for name in spec.all_drives}
    if _slips(spec) and motors_of(spec):
        creep, steady = creep_of(spec, line), steady_motor_speeds(spec, line)
        curves = {
            name: lowered_by_converter(scene, drive, creep[first], line.speed, steady[first] * drive.turns / turns)
            for name, drive, first, turns in _with_leaders(spec)
        }
        return Moving(spec, scene, line, pulls, None, line.speed, window, time, way, curves)

    def imposed(times: FloatArray) -> FloatArray:
        return line.speed * (1 - start_profile.rise(scene.shape, scene.time, times))

    return Moving(spec, scene, line, pulls, imposed, line.speed, window, time, way)


def _with_leaders(spec: Conveyor) -> Iterator[tuple[str, PlacedDrive, str, float]]:
    """Drives by name, with the drive whose torque each follows, itself in the first place, and its turns [rad/m]."""
    followed = leaders(spec.all_drives)
    for name, drive in spec.all_drives.items():
        first = followed.get(name, name)
        yield name, drive, first, spec.all_drives[first].turns


def _slips(spec: Conveyor) -> bool:
    """Whether the slip of the motors decides: drives at both ends, or converters with droop and torque limit."""
    drives = spec.all_drives.values()
    return len({drive.at for drive in drives}) > 1 or any(drive.converter is not None for drive in drives)


def rounds(spec: Conveyor, scene: ConveyorScene) -> float:
    """How often a wave goes round the belt in the time of a scene."""
    case = moving(spec, scene)
    return case.window / case.line.contour_time


def on_slip_lines(spec: Conveyor, scene: Start) -> bool:
    """Whether the converters of a start hold the frequencies of their motors and not the speeds of the pulleys.

    Equal speeds of pulleys at both ends would share the load by the creep of the belt alone, ever more unequally: the
    slip of the motors decides there. Motors that are switched off hold no speed. Converters with a torque limit do not
    hold it either where the limit is reached.
    """
    lines = _slips(spec) or scene.aborted is not None
    return scene.profile.imposes_speed and lines and bool(motors_of(spec))


def _start(spec: Conveyor, scene: Start, line: BeltLine) -> Moving:
    profile = scene.profile
    rise = profile.rise_time
    if profile.imposes_speed:
        window = rise + 4 * line.contour_time
        if on_slip_lines(spec, scene):
            creep = creep_of(spec, line)
            curves = {name: on_converter(scene, drive, creep[first]) for name, drive, first, _ in _with_leaders(spec)}
            pulls = {name: at_rest(curve) for name, curve in curves.items()}
            aborted = scene.aborted
            latest = max(drive.delay for drive in spec.all_drives.values())
            latest += aborted.run + aborted.pause if aborted else 0.0
            steady = 0.0 if aborted else _until_steady(line, rigid_curve_start(line, curves, CONVERTER_STEPS)[2])
            window = max(latest + window, steady)  # a torque limit or the slip of the motors may delay the belt
            return Moving(spec, scene, line, pulls, None, 0.0, window, latest + rise, math.nan, curves)

        def imposed(times: FloatArray) -> FloatArray:
            return line.speed * start_profile.rise(profile.rise, rise, times)

        pulls = {name: _constant(0.0) for name in spec.all_drives}
        return Moving(spec, scene, line, pulls, imposed, 0.0, window, rise, math.nan)
    pulls = {name: pull(scene, drive, rise) for name, drive in spec.all_drives.items()}
    if profile.shape == "curve":
        creep = creep_of(spec, line)
        curves = {name: along_curve(scene, drive, creep[first]) for name, drive, first, _ in _with_leaders(spec)}
        pulls = {name: at_rest(curve) for name, curve in curves.items()}
        time, way, steady = rigid_curve_start(line, curves)
        return Moving(spec, scene, line, pulls, None, 0.0, _until_steady(line, steady), time, way, curves)
    time, way = rigid_start(spec, scene, line, pulls)
    return Moving(spec, scene, line, pulls, None, 0.0, _until_steady(line, time), time, way)


def _until_steady(line: BeltLine, time: float) -> float:
    """Window of a start whose rigid body has its speed at a time [s]: the torque falls there, and the waves of that
    fall go round; 0 where the belt never moves."""
    return time + AFTER_START * line.contour_time if time > 0 else 0.0


def _constant(force: float) -> Callable[[FloatArray], FloatArray]:
    return lambda times: np.full(np.shape(times), force)


def rough_utilisation(spec: Conveyor, scene: ConveyorScene) -> float:
    """Most of any drum's grip in use by the rigid body's tensions, the dynamic part taken twice.

    From the slack side on, every drum of the head adds its own drive's force (start) or takes its share of what the
    belt gives (stop); a jammed drum takes all of it.
    """
    line = running(spec, scene)
    if isinstance(scene, Jam):
        return math.inf
    forces, braked = steady_forces(spec, line), 2 * deceleration(spec, scene, line)
    belt = line.carry.line_mass * line.carry.length + line.back.line_mass * line.back.length
    behind, worst = line.run_off, 0.0
    if line.weight_at_tail and isinstance(scene, Start):  # the return strand is accelerated by the slack side alone
        accelerates = max(sum(map(drive_force, spec.all_drives.values())) - sum(forces.values()), 0.0) / moving_mass(
            line
        )
        behind -= 2 * line.back.line_mass * line.back.length * accelerates
    for name, drive in reversed(list(spec.all_drives.items())):
        if drive.at == "tail":
            continue
        added = (
            drive_force(drive)
            if isinstance(scene, Start)
            else forces[name] - starting_shares(spec)[name] * belt * braked
        )
        above = behind + added
        if drive.drum.friction is not None:
            tight, slack = max(above, behind), min(above, behind)
            exponent = drive.drum.friction * drive.drum.wrap
            worst = max(worst, float(capstan.slip_utilisation(tight, slack, line.centrifugal_at_speed, exponent)))
        behind = above
    return worst
