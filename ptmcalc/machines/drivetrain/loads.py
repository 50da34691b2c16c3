"""The loads a drive train can report: most of them once for each of its parts."""

from collections.abc import Iterator
from dataclasses import replace

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.machines.drivetrain.spec import Drivetrain
from ptmcalc.machines.drivetrain.wiring import GROUND

TORQUE_PEAK = LoadInfo("torque_peak", "peak link torque or force", units.TORQUE, governing=True)
TORQUE_STEADY = LoadInfo("torque_steady", "final link torque, rigid-train model", units.TORQUE)
DYNAMIC_FACTOR = LoadInfo("dynamic_factor", "dynamic factor, peak / rigid train", units.RATIO)
SPEED_MAX = LoadInfo("speed_max", "speed, maximum", units.ANGULAR_SPEED)
SPEED_MIN = LoadInfo("speed_min", "speed, minimum", units.ANGULAR_SPEED, headline=False)
SPEED_END = LoadInfo("speed_end", "final speed", units.ANGULAR_SPEED)
ANGLE_END = LoadInfo("angle_end", "final angle", units.ANGLE, headline=False)
START_TIME = LoadInfo("start_time", "starting time", units.TIME, governing=True)
STOP_TIME = LoadInfo("stop_time", "stopping time", units.TIME, governing=True)
STOP_ANGLE = LoadInfo("stop_angle", "stopping angle or distance", units.ANGLE, governing=True)
START_SHARE = LoadInfo("start_share", "final speed / target speed", units.SHARE, governing=True)
STOP_SHARE = LoadInfo("stop_speed_share", "residual speed / initial speed", units.SHARE, governing=True)
PART_START_TIME = LoadInfo("part_start_time", "starting time", units.TIME, governing=True)
PART_START_SHARE = LoadInfo("part_start_share", "final speed / target speed", units.SHARE, governing=True)
PART_STOP_TIME = LoadInfo("part_stop_time", "stopping time", units.TIME, governing=True)
PART_STOP_SHARE = LoadInfo("part_stop_speed_share", "residual speed / maximum speed", units.SHARE, governing=True)
CLUTCH_SLIP = LoadInfo("clutch_slip", "clutch slip speed / speed of the faster side", units.SHARE, governing=True)
START_BY_TERMS = LoadInfo("start_time_by_terms", "starting time, efficiency per term", units.TIME)
STOP_BY_TERMS = LoadInfo("stop_time_by_terms", "stopping time, efficiency per term", units.TIME)
MOTOR_PEAK = LoadInfo("motor_torque_peak", "motor torque, maximum", units.TORQUE, governing=True)
BRAKING = LoadInfo("braking_reserve", "motor braking torque / overhauling torque", units.RATIO, governing=True)
MOTOR_RMS = LoadInfo("motor_torque_rms", "motor torque, rms", units.TORQUE, governing=True)
FREQUENCY = LoadInfo("natural_frequency", "natural frequency", units.ANGULAR_FREQUENCY)
SEPARATION = LoadInfo("resonance_separation", "excitation separation from resonance", units.SHARE, governing=True)
WEAR = LoadInfo("wear_share", "tooth wear / tooth thickness", units.SHARE, governing=True)
RESIDUAL = LoadInfo("energy_residual", "energy balance error", units.RATIO, headline=False)

LOADS = (
    TORQUE_PEAK,
    TORQUE_STEADY,
    DYNAMIC_FACTOR,
    START_TIME,
    START_BY_TERMS,
    START_SHARE,
    STOP_TIME,
    STOP_BY_TERMS,
    STOP_SHARE,
    STOP_ANGLE,
    PART_START_TIME,
    PART_START_SHARE,
    PART_STOP_TIME,
    PART_STOP_SHARE,
    CLUTCH_SLIP,
    MOTOR_PEAK,
    MOTOR_RMS,
    BRAKING,
    SPEED_MAX,
    SPEED_END,
    SPEED_MIN,
    ANGLE_END,
    SEPARATION,
    WEAR,
    FREQUENCY,
    RESIDUAL,
)
FAMILIES = frozenset(info.name for info in LOADS)
MOVING = FAMILIES - {info.name for info in (FREQUENCY, SEPARATION, WEAR, START_BY_TERMS, STOP_BY_TERMS)}
"""What a motion of the train gives, elastic or rigid."""


def parts(spec: Drivetrain) -> Iterator[LoadInfo]:
    """The loads of one train."""
    ends = {name: link.body for name, link in spec.links.items()}
    ends |= {name: gear.end for name, gear in spec.gears.items()}
    for info in LOADS:
        if info in (TORQUE_PEAK, TORQUE_STEADY, DYNAMIC_FACTOR):
            for name, end in ends.items():
                force = info.quantity is units.TORQUE and not spec.turns(end)
                yield info.of(name, units.FORCE if force else None)
        elif info in (PART_START_TIME, PART_START_SHARE, PART_STOP_TIME, PART_STOP_SHARE):
            for name in spec.inertias:
                yield info.of(name)
        elif info is CLUTCH_SLIP:
            for name, brake in spec.brakes.items():
                if brake.against != GROUND:
                    yield info.of(name)
        elif info in (SPEED_MAX, SPEED_END, SPEED_MIN, ANGLE_END):
            other = units.LENGTH if info is ANGLE_END else units.SPEED
            for name in spec.inertias:
                yield info.of(name, None if spec.turns(name) else other)
        elif info in (MOTOR_PEAK, MOTOR_RMS, BRAKING):
            for name in spec.motors:
                yield info.of(name)
        elif info is WEAR:
            for name, link in spec.links.items():
                if link.clearance is not None:
                    yield info.of(name)
        elif info is FREQUENCY:
            for number in range(1, len(spec.inertias) + len(spec.links) + 1):
                yield info.of(str(number))
        elif info is SEPARATION:
            for name, torque in spec.torques.items():
                if torque.type == "sine":
                    yield info.of(name)
        elif info is STOP_ANGLE:
            turns = spec.turns(spec.stopped)
            yield info if turns else replace(info, quantity=units.LENGTH)
        else:
            yield info
