"""Limits of the checks of a stacker crane. What no standard fixes has no default."""

from typing import Annotated

from ptmcalc.spec.fields import (
    PositiveAcceleration,
    PositiveForce,
    PositiveLength,
    PositiveRatio,
    PositiveSpeed,
    PositiveStress,
    PositiveTime,
)
from ptmcalc.spec.machine import CheckSettings
from ptmcalc.spec.optional import Limit


class StackerChecks(CheckSettings):
    """Limits of the checks of a stacker crane; needed for the check where it has no default."""

    start_time: Annotated[PositiveTime, Limit()] = 10.0
    """longest start of a mechanism"""
    brake_time: Annotated[PositiveTime, Limit()] = 10.0
    """longest stop of a mechanism"""
    rope_safety: Annotated[PositiveRatio | None, Limit()] = None
    """breaking force over the largest pull in a rope; that of the hoist's `group` (ISO 4308-1) when left out"""
    self_jamming: Annotated[PositiveRatio, Limit()] = 1.0
    """largest resistance of the guide over the weight that has to overcome it: at 1 the carriage no longer sinks"""
    stability: Annotated[PositiveRatio, Limit()] = 1.0
    """least moment that holds a rack stacker over that which tips it; standards and makers ask more than this 1"""
    column_stress: Annotated[PositiveStress | None, Limit()] = None
    """largest stress of the column"""
    bridge_stress: Annotated[PositiveStress | None, Limit()] = None
    """largest stress of the girders"""
    mast_deflection: Annotated[PositiveLength | None, Limit()] = None
    """largest swing of the far end of the column; the formula of the source is lost and no other is known"""
    column_force: Annotated[PositiveForce | None, Limit()] = None
    """largest force of the column on what holds it"""
    collision_speed: Annotated[PositiveSpeed | None, Limit()] = None
    """largest speed at which obstacle or buffer may be met; of buffers the lower of it and that of their own data"""
    contact_force: Annotated[PositiveForce | None, Limit()] = None
    """largest force between the column and an obstacle"""
    fork_caught_factor: Annotated[PositiveRatio | None, Limit()] = None
    """largest rope force of a caught fork over the weight"""
    catch_deceleration: Annotated[PositiveAcceleration | None, Limit()] = None
    """largest deceleration of a carriage its safety gear catches; 9.81 m/s^2 is usual for a cab with a driver"""
    rail_detuning: Annotated[PositiveRatio, Limit()] = 0.2
    """least distance of the waves of the rail from resonance, as a share of the frequency of wheels and column"""
