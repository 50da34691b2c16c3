"""The loads a travelling crane can report."""

from collections.abc import Iterable, Iterator

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.machines.crane.travelling.machine.model import CORNERS
from ptmcalc.machines.crane.travelling.machine.spec import Travelling

OF_THE_WHEELS = (
    LoadInfo("wheel_load_max", "wheel load, maximum", units.FORCE, governing=True),
    LoadInfo("wheel_load_min", "wheel load, minimum", units.FORCE, governing=True),
    LoadInfo("corner_load_max", "corner load, maximum", units.FORCE, headline=False),
    LoadInfo("corner_load_min", "corner load, minimum", units.FORCE, headline=False),
    LoadInfo("stability_reserve", "stability ratio, factored moments", units.RATIO, governing=True),
    LoadInfo("wheel_load_factored", "wheel load with phi1, phi2, maximum", units.FORCE),
    LoadInfo("wheel_load_mean", "mean wheel load (P_min + 2 P_max)/3", units.FORCE),
    LoadInfo("wheel_spectrum_factor", "wheel load spectrum factor", units.RATIO),
)
OF_TRAVEL = (
    LoadInfo("travel_resistance", "steady travel resistance", units.FORCE, governing=True),
    LoadInfo("travel_coefficient", "specific travel resistance of wheels", units.RATIO, headline=False),
    LoadInfo("motor_speed", "motor speed", units.ANGULAR_SPEED),
    LoadInfo("torque_motor_travel", "steady travel torque, all motors", units.TORQUE, governing=True),
    LoadInfo("power_travel", "steady travel power, all motors", units.POWER, governing=True),
    LoadInfo("starting_reserve", "starting torque reserve", units.RATIO, governing=True),
    LoadInfo("wind_reserve", "drive reserve against wind", units.RATIO, governing=True),
    LoadInfo("overhauling_reserve", "motor braking torque reserve", units.RATIO),
    LoadInfo("torque_motor_rms", "motor torque, rms, all motors", units.TORQUE),
    LoadInfo("heating_utilisation", "thermal utilisation (rms torque)", units.SHARE, governing=True),
    LoadInfo("starts_per_hour", "starts per hour", units.RATIO, headline=False),
)
OF_THE_CLASS = (
    LoadInfo("spectrum_factor", "load spectrum factor K_p", units.RATIO, headline=False),
    LoadInfo("crane_group", "required crane group, A", units.RATIO, headline=False),
    LoadInfo("mechanism_group", "required mechanism group, M", units.RATIO, headline=False),
)
FACTORS = (
    LoadInfo("phi1", "phi1, mass of the crane", units.RATIO, governing=True),
    LoadInfo("phi2", "phi2, lifting a grounded load", units.RATIO, governing=True),
    LoadInfo("phi3", "phi3, release of part of load", units.RATIO, governing=True),
    LoadInfo("phi4", "phi4, travelling on uneven surface", units.RATIO, governing=True),
    LoadInfo("phi5", "phi5, acceleration of drives", units.RATIO, governing=True),
    LoadInfo("phi6", "phi6, dynamic test load", units.RATIO, governing=True),
    LoadInfo("phi7", "phi7, buffer forces", units.RATIO, governing=True),
)
OF_MOTION = (
    LoadInfo("start_time", "starting time", units.TIME, governing=True),
    LoadInfo("start_distance", "starting distance", units.SPAN),
    LoadInfo("brake_time", "stopping time", units.TIME, governing=True),
    LoadInfo("brake_distance", "stopping distance", units.SPAN, governing=True),
    LoadInfo("acceleration_max", "crane acceleration, maximum", units.ACCELERATION),
    LoadInfo("sway_angle_max", "load sway angle, maximum", units.ANGLE, governing=True),
    LoadInfo("sway_residual", "residual sway amplitude", units.ANGLE, governing=True),
    LoadInfo("sway_period", "sway period", units.TIME),
    LoadInfo("sway_free_ramp", "shortest sway-free ramp time", units.TIME, headline=False),
    LoadInfo("horizontal_force", "horizontal force of load, maximum", units.FORCE, governing=True),
    LoadInfo("traction_max", "driven-wheel force on rails, maximum", units.FORCE),
    LoadInfo("torque_motor_max", "ramp torque of all motors, maximum", units.TORQUE),
    LoadInfo("drive_utilisation", "motor torque demand on ramp", units.SHARE),
    LoadInfo("skid_reserve_min", "adhesion reserve mu*N/F, minimum", units.RATIO, governing=True),
    LoadInfo("skid_reserve", "adhesion reserve mu*N/F, corner", units.RATIO, headline=False),
)
OF_THE_BUFFERS = (
    LoadInfo("collision_speed", "buffer impact speed", units.SPEED, governing=True),
    LoadInfo("collision_energy", "buffer impact energy", units.ENERGY),
    LoadInfo("buffer_force", "force per buffer", units.FORCE, governing=True),
    LoadInfo("buffer_stroke", "buffer compression", units.LENGTH, governing=True),
    LoadInfo("buffer_speed_left", "residual speed, end of buffer stroke", units.SPEED),
    LoadInfo("buffer_deceleration", "deceleration at buffers, maximum", units.ACCELERATION),
)
OF_THE_RAIL = (LoadInfo("rail_contact", "minimum / static wheel load", units.RATIO),)
OF_SKEWING = (
    LoadInfo("skew_angle", "skewing angle alpha", units.ANGLE),
    LoadInfo("skew_force", "skewing force on front guide", units.FORCE, governing=True),
    LoadInfo("skew_force_slip", "skewing force, slip per wheel", units.FORCE),
    LoadInfo("skew_share", "friction slip factor f(alpha)", units.RATIO, headline=False),
)
OF_THE_STORM = (
    LoadInfo("storm_force", "out-of-service wind and slope force", units.FORCE, governing=True),
    LoadInfo("holding_force", "holding force, brakes and clamps", units.FORCE),
    LoadInfo("storm_reserve", "holding reserve, out-of-service wind", units.RATIO, governing=True),
)
EVEN = (*OF_TRAVEL, *OF_THE_CLASS)

PER_CORNER = frozenset({"corner_load_max", "corner_load_min"})
PER_DRIVEN_CORNER = frozenset({"skid_reserve"})
MOVING = frozenset(info.name for info in OF_MOTION) | {"wheel_load_max", "wheel_load_min", "stability_reserve"}
"""What a start or a stop gives."""


def names(*groups: tuple[LoadInfo, ...]) -> frozenset[str]:
    """Names of loads."""
    return frozenset(info.name for group in groups for info in group)


def parts_of(loads: Iterable[LoadInfo], spec: Travelling) -> Iterator[LoadInfo]:
    """Some loads of one crane, corner by corner where they are of corners."""
    for info in loads:
        if info.name in PER_CORNER:
            yield from (info.of(corner) for corner in CORNERS)
        elif info.name in PER_DRIVEN_CORNER:
            yield from (info.of(corner) for corner in CORNERS if corner in spec.wheels.driven)
        else:
            yield info
