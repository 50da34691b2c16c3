"""The loads a stacker crane can report."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.machines.crane.stacking.spec import Stacker

OF_THE_HOIST = (
    LoadInfo("roller_reaction", "largest reaction of a set of guide rollers", units.FORCE, governing=True),
    LoadInfo("roller_load", "largest load of a roller", units.FORCE),
    LoadInfo("carriage_resistance", "resistance of the guide", units.FORCE),
    LoadInfo("jamming", "resistance of the guide over the weight", units.RATIO),
    LoadInfo("rope_force", "largest pull of a rope at the drum", units.FORCE, governing=True),
    LoadInfo("rope_safety", "breaking force over the pull of a rope", units.RATIO),
)
OF_THE_COLUMN = (
    LoadInfo("column_stiffness", "stiffness of the column at its far end", units.STIFFNESS),
    LoadInfo("natural_frequency", "natural frequency", units.ANGULAR_FREQUENCY),
    LoadInfo("period", "period of the first swing", units.TIME),
)
OF_STANDING = (
    LoadInfo("total_weight", "weight of crane and load", units.FORCE, governing=True),
    LoadInfo("starts_ratio", "starts per hour over the permitted ones", units.RATIO),
)
OF_MOTION = (
    LoadInfo("start_time", "start time", units.TIME, governing=True),
    LoadInfo("brake_time", "time of the stop", units.TIME, governing=True),
    LoadInfo("mast_deflection_max", "largest swing of the far end of the column", units.LENGTH, governing=True),
    LoadInfo("mast_force_max", "largest force of the column", units.FORCE, governing=True),
    LoadInfo("mast_moment_max", "largest moment at the root of the column", units.TORQUE),
    LoadInfo("rest_deflection", "lean of the far end at rest under weights beside its axis", units.LENGTH),
    LoadInfo("settling_time", "from standstill until the far end stays in the window", units.TIME, governing=True),
)
OF_THE_OBSTACLE = (
    LoadInfo("collision_force", "largest force of the column", units.FORCE, governing=True),
    LoadInfo("collision_deflection", "largest deflection of the column", units.LENGTH),
    LoadInfo("collision_speed", "speed of the collision", units.SPEED),
    LoadInfo("contact_force", "largest force between column and obstacle", units.FORCE, governing=True),
)
OF_THE_BUFFERS = (
    LoadInfo("buffer_force", "force of a buffer", units.FORCE, governing=True),
    LoadInfo("buffer_stroke", "stroke of a buffer", units.LENGTH, governing=True),
    LoadInfo("buffer_speed_left", "speed at which the buffer bottoms out", units.SPEED),
    LoadInfo("buffer_deceleration", "largest deceleration at the buffers", units.ACCELERATION),
    LoadInfo("phi7", "phi7, buffers", units.RATIO, governing=True),
)
OF_THE_FORK = (
    LoadInfo("fork_push_force", "force of the fork on the rack", units.FORCE, governing=True),
    LoadInfo("fork_caught_factor", "force of the ropes of a caught fork over the weight", units.RATIO, governing=True),
    LoadInfo("rope_force_caught", "force of all falls at the carriage, fork caught", units.FORCE, governing=True),
    LoadInfo("rack_force", "force of the caught fork on the rack", units.FORCE, governing=True),
    LoadInfo("limiter_reserve", "force of the limiter over that of a start upward", units.RATIO),
)
OF_THE_RAIL = (
    LoadInfo("phi4", "phi4, unevenness of the rail", units.RATIO, governing=True),
    LoadInfo("rail_contact", "least wheel load over the static one", units.RATIO),
    LoadInfo("wheel_force", "largest load of a wheel", units.FORCE, governing=True),
    LoadInfo("rail_detuning", "distance of the waves of the rail from resonance", units.RATIO),
)
OF_THE_SAFETY_GEAR = (
    LoadInfo("safety_gear_force", "force of the safety gear", units.FORCE, governing=True),
    LoadInfo("safety_gear_distance", "way of the safety gear", units.LENGTH, governing=True),
    LoadInfo("safety_gear_factor", "force of the safety gear over the weight", units.RATIO),
    LoadInfo("safety_gear_deceleration", "deceleration of the carriage", units.ACCELERATION),
    LoadInfo("safety_gear_speed", "speed at which the safety gear grips", units.SPEED),
    LoadInfo("safety_gear_drop", "free fall before it grips", units.LENGTH),
    LoadInfo("safety_gear_moment", "moment of the safety gear on the column", units.TORQUE),
    LoadInfo("safety_gear_shock", "force along the column at its foot", units.FORCE),
)
OF_STRENGTH = (
    LoadInfo("column_stress", "stress of the column", units.STRESS, governing=True),
    LoadInfo("bridge_stress", "stress of the girders", units.STRESS, governing=True),
    LoadInfo("stability_reserve", "moment that holds over the one that tips", units.RATIO, governing=True),
)
OF_THE_TABLES = (LoadInfo("combination_force", "load that marks the combination", units.FORCE, headline=False),)

LOADS = (
    *OF_THE_HOIST,
    *OF_THE_COLUMN,
    *OF_STANDING,
    *OF_MOTION,
    *OF_THE_OBSTACLE,
    *OF_THE_BUFFERS,
    *OF_THE_FORK,
    *OF_THE_RAIL,
    *OF_THE_SAFETY_GEAR,
    *OF_STRENGTH,
    *OF_THE_TABLES,
)
MODES = ("1", "2", "3")
"""Natural frequencies that are reported, from the lowest."""

SIDES = ("along", "across")
"""Along the rail, across the aisle."""

COMBINATIONS = {
    "overhead_stacker": tuple(f"11.1,{n}" for n in range(1, 7)),
    "rack_stacker": tuple(f"11.2,{n}" for n in range(1, 7)),
}
"""Combinations of each type's table, as loads name them: `combination_force[11.1,3]`."""


def names(*groups: tuple[LoadInfo, ...]) -> frozenset[str]:
    """Names of loads."""
    return frozenset(info.name for group in groups for info in group)


def parts(spec: Stacker) -> Iterator[LoadInfo]:
    """The loads of one machine: its modes, both directions of its stability, the combinations of its table."""
    for info in LOADS:
        if info.name == "natural_frequency":
            yield from (info.of(mode) for mode in MODES)
        elif info.name == "combination_force":
            yield from (info.of(number) for number in COMBINATIONS[spec.type])
        elif info.name == "stability_reserve":
            if spec.type == "rack_stacker":
                yield info
                yield from (info.of(side) for side in SIDES)
        else:
            yield info
