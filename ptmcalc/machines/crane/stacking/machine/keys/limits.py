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
    """maximum starting time of a mechanism"""
    brake_time: Annotated[PositiveTime, Limit()] = 10.0
    """maximum stopping time of a mechanism"""
    rope_safety: Annotated[PositiveRatio | None, Limit()] = None
    """breaking force / maximum rope force; default: value of the hoist `group` (ISO 4308-1)"""
    self_jamming: Annotated[PositiveRatio, Limit()] = 1.0
    """maximum guide friction / weight: at 1 the carriage does not descend"""
    stability: Annotated[PositiveRatio, Limit()] = 1.0
    """minimum stabilising moment / tipping moment of a rack stacker; standards and manufacturers require more than 1"""
    column_stress: Annotated[PositiveStress | None, Limit()] = None
    """permissible mast stress"""
    bridge_stress: Annotated[PositiveStress | None, Limit()] = None
    """permissible girder stress"""
    mast_deflection: Annotated[PositiveLength | None, Limit()] = None
    """maximum dynamic deflection of the mast tip; no default, because no formula is known"""
    column_force: Annotated[PositiveForce | None, Limit()] = None
    """maximum mast force on its support"""
    collision_speed: Annotated[PositiveSpeed | None, Limit()] = None
    """maximum impact speed at obstacle or buffer; for buffers the lower of it and the buffer data"""
    contact_force: Annotated[PositiveForce | None, Limit()] = None
    """maximum contact force between mast and obstacle"""
    fork_caught_factor: Annotated[PositiveRatio | None, Limit()] = None
    """maximum rope force of a snagged fork / weight"""
    catch_deceleration: Annotated[PositiveAcceleration | None, Limit()] = None
    """maximum deceleration of the carriage in the safety gear; 9.81 m/s^2 is usual for a cab with a driver"""
    rail_detuning: Annotated[PositiveRatio, Limit()] = 0.2
    """minimum separation of the rail waves from resonance, relative to the frequency of wheels and mast"""
