"""The loads a stacker crane can report."""

from collections.abc import Iterable, Iterator

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.machines.crane.stacking.machine.spec import Stacker

OF_THE_HOIST = (
    LoadInfo("roller_reaction", "guide roller set reaction, maximum", units.FORCE, governing=True),
    LoadInfo("roller_load", "guide roller load, maximum", units.FORCE),
    LoadInfo("carriage_resistance", "carriage guide friction force", units.FORCE),
    LoadInfo("jamming", "guide friction / weight", units.RATIO),
    LoadInfo("rope_force", "rope pull at drum, maximum", units.FORCE, governing=True),
    LoadInfo("rope_safety", "rope safety factor", units.RATIO),
)
OF_THE_COLUMN = (
    LoadInfo("column_stiffness", "mast stiffness at mast tip", units.STIFFNESS),
    LoadInfo("natural_frequency", "mast natural frequency", units.ANGULAR_FREQUENCY),
    LoadInfo("period", "period of first mast mode", units.TIME),
)
OF_STANDING = (
    LoadInfo("total_weight", "total weight of crane and load", units.FORCE, governing=True),
    LoadInfo("starts_ratio", "starts per hour / permitted starts", units.RATIO),
)
OF_MOTION = (
    LoadInfo("start_time", "starting time", units.TIME, governing=True),
    LoadInfo("brake_time", "stopping time", units.TIME, governing=True),
    LoadInfo("mast_deflection_max", "dynamic mast tip deflection, maximum", units.LENGTH, governing=True),
    LoadInfo("mast_force_max", "dynamic mast force, maximum", units.FORCE, governing=True),
    LoadInfo("mast_moment_max", "mast root moment, maximum", units.TORQUE),
    LoadInfo("rest_deflection", "static mast tip deflection", units.LENGTH),
    LoadInfo("settling_time", "mast settling time to tolerance", units.TIME, governing=True),
)
OF_THE_OBSTACLE = (
    LoadInfo("collision_force", "mast force in collision, maximum", units.FORCE, governing=True),
    LoadInfo("collision_deflection", "mast deflection, collision, maximum", units.LENGTH),
    LoadInfo("collision_speed", "collision speed", units.SPEED),
    LoadInfo("contact_force", "obstacle contact force, maximum", units.FORCE, governing=True),
)
OF_THE_BUFFERS = (
    LoadInfo("buffer_force", "force per buffer", units.FORCE, governing=True),
    LoadInfo("buffer_stroke", "buffer compression", units.LENGTH, governing=True),
    LoadInfo("buffer_speed_left", "residual speed, end of buffer stroke", units.SPEED),
    LoadInfo("buffer_deceleration", "deceleration at buffers, maximum", units.ACCELERATION),
    LoadInfo("phi7", "phi7, buffer forces", units.RATIO, governing=True),
)
OF_THE_FORK = (
    LoadInfo("fork_push_force", "fork thrust on rack", units.FORCE, governing=True),
    LoadInfo("fork_caught_factor", "rope force / weight, fork snagged", units.RATIO, governing=True),
    LoadInfo("rope_force_caught", "total rope force, fork snagged", units.FORCE, governing=True),
    LoadInfo("rack_force", "uplift on rack beam, fork snagged", units.FORCE, governing=True),
    LoadInfo("limiter_reserve", "limiter trip reserve", units.RATIO),
)
OF_THE_RAIL = (
    LoadInfo("phi4", "phi4, travelling on uneven surface", units.RATIO, governing=True),
    LoadInfo("rail_contact", "minimum / static wheel load", units.RATIO),
    LoadInfo("wheel_force", "wheel load on uneven rail, maximum", units.FORCE, governing=True),
    LoadInfo("rail_detuning", "rail wave separation from resonance", units.RATIO),
)
OF_THE_SAFETY_GEAR = (
    LoadInfo("safety_gear_force", "safety gear braking force", units.FORCE, governing=True),
    LoadInfo("safety_gear_distance", "safety gear stopping distance", units.LENGTH, governing=True),
    LoadInfo("safety_gear_factor", "safety gear force / suspended weight", units.RATIO),
    LoadInfo("safety_gear_deceleration", "carriage deceleration in safety gear", units.ACCELERATION),
    LoadInfo("safety_gear_speed", "speed at safety gear engagement", units.SPEED),
    LoadInfo("safety_gear_drop", "free fall before engagement", units.LENGTH),
    LoadInfo("safety_gear_moment", "mast moment from safety gear", units.TORQUE),
    LoadInfo("safety_gear_shock", "axial force at mast foot", units.FORCE),
)
OF_STRENGTH = (
    LoadInfo("column_stress", "mast stress, maximum", units.STRESS, governing=True),
    LoadInfo("bridge_stress", "girder stress, maximum", units.STRESS, governing=True),
    LoadInfo("stability_reserve", "stability ratio (resisting/tipping)", units.RATIO, governing=True),
)
OF_THE_TABLES = (LoadInfo("combination_force", "leading load of the combination", units.FORCE, headline=False),)

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


def parts_of(loads: Iterable[LoadInfo], spec: Stacker) -> Iterator[LoadInfo]:
    """Some loads of one machine: its modes, both directions of its stability, the combinations of its table."""
    for info in loads:
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
