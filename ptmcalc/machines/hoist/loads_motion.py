"""The loads of a hoist that starts, lifts, stops or lets go."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo

MOTION = (
    LoadInfo("lift_off_factor", "largest rope force over the weight, lifting off", units.RATIO, governing=True),
    LoadInfo("lowering_brake_factor", "largest rope force over the weight, braking", units.RATIO, governing=True),
    LoadInfo("start_factor", "largest rope force over the weight, starting", units.RATIO, governing=True),
    LoadInfo("stop_factor", "largest rope force over the weight, stopping", units.RATIO, governing=True),
    LoadInfo("release_factor", "smallest rope force over the weight before", units.RATIO, governing=True),
    LoadInfo("bridge_factor", "largest force on the structure over the weight", units.RATIO),
    LoadInfo("rope_force_max", "largest rope force, at the hook", units.FORCE, governing=True),
    LoadInfo("rope_force_min", "smallest rope force, at the hook", units.FORCE),
    LoadInfo("rope_force_share", "smallest rope force over the weight", units.RATIO),
    LoadInfo("bridge_force_max", "largest force on the structure", units.FORCE, governing=True),
    LoadInfo("bridge_force_min", "smallest force on the structure", units.FORCE),
    LoadInfo("backlash_torque_peak", "largest torque of the gear, drum shaft", units.TORQUE, governing=True),
    LoadInfo("gear_impact_factor", "largest gear torque over that of the even motion", units.RATIO),
    LoadInfo("stop_distance_lowering", "way of the lowered load to its stop", units.LENGTH, governing=True),
    LoadInfo("stop_distance", "way of the hoisted load to its stop", units.LENGTH),
    LoadInfo("stop_time", "time to the stop", units.TIME),
    LoadInfo("lift_off_speed", "speed of the drive at lift-off, at the hook", units.SPEED),
    LoadInfo("lift_off_time", "time of lift-off", units.TIME),
    LoadInfo("tension_time", "time in which the rope tightens", units.TIME),
    LoadInfo("natural_frequency", "lowest natural frequency", units.ANGULAR_FREQUENCY),
    LoadInfo("energy_residual", "energy the ledger leaves over", units.RATIO, headline=False),
)
MOVING = frozenset(info.name for info in MOTION)
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
