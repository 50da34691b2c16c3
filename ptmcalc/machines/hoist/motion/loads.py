"""The loads of a hoist that starts, lifts, stops or lets go."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo

LOADS_OF_MOTION = (
    LoadInfo("lift_off_factor", "lift-off factor F_max/Q", units.RATIO, governing=True),
    LoadInfo("lowering_brake_factor", "dynamic factor, lowering stop", units.RATIO, governing=True),
    LoadInfo("start_factor", "dynamic factor, start", units.RATIO, governing=True),
    LoadInfo("stop_factor", "dynamic factor, hoisting stop", units.RATIO, governing=True),
    LoadInfo("release_factor", "release factor F_min/Q", units.RATIO, governing=True),
    LoadInfo("bridge_factor", "structure force factor F_max/Q", units.RATIO),
    LoadInfo("rope_force_max", "total rope force at hook, maximum", units.FORCE, governing=True),
    LoadInfo("rope_force_min", "total rope force at hook, minimum", units.FORCE),
    LoadInfo("rope_force_share", "minimum rope force ratio F_min/Q", units.RATIO),
    LoadInfo("bridge_force_max", "force on structure, maximum", units.FORCE, governing=True),
    LoadInfo("bridge_force_min", "force on structure, minimum", units.FORCE),
    LoadInfo("backlash_torque_peak", "gear torque at drum shaft, maximum", units.TORQUE, governing=True),
    LoadInfo("gear_impact_factor", "gear dynamic torque factor", units.RATIO),
    LoadInfo("stop_distance_lowering", "lowering stopping distance, maximum", units.LENGTH, governing=True),
    LoadInfo("stop_distance", "hoisting stopping distance, maximum", units.LENGTH),
    LoadInfo("stop_time", "time to first rest of brake shaft", units.TIME),
    LoadInfo("lift_off_speed", "drive speed at lift-off, at hook", units.SPEED),
    LoadInfo("lift_off_time", "time to lift-off", units.TIME),
    LoadInfo("tension_time", "rope tensioning time to lift-off", units.TIME),
    LoadInfo("natural_frequency", "lowest natural frequency", units.ANGULAR_FREQUENCY),
    LoadInfo("energy_residual", "energy balance error", units.RATIO, headline=False),
)
MOVING = frozenset(info.name for info in LOADS_OF_MOTION)
FORCES = frozenset(
    {
        "lift_off_factor",
        "lowering_brake_factor",
        "start_factor",
        "stop_factor",
        "release_factor",
        "bridge_factor",
        "rope_force_max",
        "rope_force_min",
        "rope_force_share",
        "bridge_force_max",
        "bridge_force_min",
        "backlash_torque_peak",
        "gear_impact_factor",
    }
)
"""Loads that go with a force."""
