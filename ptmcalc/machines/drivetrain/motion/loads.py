"""Loads of start and stop, and of the motion as a whole."""

from collections.abc import Iterator
from dataclasses import replace

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.machines.drivetrain.links.loads import DYNAMIC_FACTOR, TORQUE_PEAK, TORQUE_STEADY
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain
from ptmcalc.machines.drivetrain.machine.wiring import GROUND
from ptmcalc.machines.drivetrain.motors.loads import LOADS_OF_MOTORS

START_TIME = LoadInfo("start_time", "starting time", units.TIME, governing=True)
START_BY_TERMS = LoadInfo("start_time_by_terms", "starting time, efficiency per term", units.TIME)
START_SHARE = LoadInfo("start_share", "final speed / target speed", units.SHARE, governing=True)
STOP_TIME = LoadInfo("stop_time", "stopping time", units.TIME, governing=True)
STOP_BY_TERMS = LoadInfo("stop_time_by_terms", "stopping time, efficiency per term", units.TIME)
STOP_SHARE = LoadInfo("stop_speed_share", "residual speed / initial speed", units.SHARE, governing=True)
STOP_ANGLE = LoadInfo("stop_angle", "stopping angle or distance", units.ANGLE, governing=True)
PART_START_TIME = LoadInfo("part_start_time", "starting time", units.TIME, governing=True)
PART_START_SHARE = LoadInfo("part_start_share", "final speed / target speed", units.SHARE, governing=True)
PART_STOP_TIME = LoadInfo("part_stop_time", "stopping time", units.TIME, governing=True)
PART_STOP_SHARE = LoadInfo("part_stop_speed_share", "residual speed / maximum speed", units.SHARE, governing=True)
CLUTCH_SLIP = LoadInfo("clutch_slip", "clutch slip speed / speed of the faster side", units.SHARE, governing=True)
SPEED_MAX = LoadInfo("speed_max", "speed, maximum", units.ANGULAR_SPEED)
SPEED_END = LoadInfo("speed_end", "final speed", units.ANGULAR_SPEED)
SPEED_MIN = LoadInfo("speed_min", "speed, minimum", units.ANGULAR_SPEED, headline=False)
ANGLE_END = LoadInfo("angle_end", "final angle", units.ANGLE, headline=False)
RESIDUAL = LoadInfo("energy_residual", "energy balance error", units.RATIO, headline=False)

LOADS_OF_MOTION = (
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
    SPEED_MAX,
    SPEED_END,
    SPEED_MIN,
    ANGLE_END,
    RESIDUAL,
)
_SIMULATED = (
    TORQUE_PEAK,
    TORQUE_STEADY,
    DYNAMIC_FACTOR,
    *(info for info in LOADS_OF_MOTION if info not in (START_BY_TERMS, STOP_BY_TERMS)),
    *LOADS_OF_MOTORS,
)
MOVING = frozenset(info.name for info in _SIMULATED)
"""What a motion of the train gives, elastic or rigid."""


def parts(spec: Drivetrain) -> Iterator[LoadInfo]:
    """The loads of the motion of one train."""
    for info in LOADS_OF_MOTION:
        if info in (PART_START_TIME, PART_START_SHARE, PART_STOP_TIME, PART_STOP_SHARE):
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
        elif info is STOP_ANGLE:
            turns = spec.turns(spec.stopped)
            yield info if turns else replace(info, quantity=units.LENGTH)
        else:
            yield info
