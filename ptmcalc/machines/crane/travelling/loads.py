"""The loads a travelling crane can report."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.machines.crane.travelling.model import CORNERS
from ptmcalc.machines.crane.travelling.spec import Travelling

OF_THE_WHEELS = (
    LoadInfo("wheel_load_max", "largest load of a wheel", units.FORCE, governing=True),
    LoadInfo("wheel_load_min", "smallest load of a wheel", units.FORCE, governing=True),
    LoadInfo("corner_load_max", "largest load of a corner", units.FORCE, headline=False),
    LoadInfo("corner_load_min", "smallest load of a corner", units.FORCE, headline=False),
    LoadInfo("stability_reserve", "moments that hold over those that tip, factored", units.RATIO, governing=True),
    LoadInfo("wheel_load_factored", "largest load of a wheel with phi1 and phi2", units.FORCE),
    LoadInfo("wheel_load_mean", "load for which the wheel is chosen, (min + 2 max)/3", units.FORCE),
    LoadInfo("wheel_spectrum_factor", "spectrum factor of a wheel over the trolley's way", units.RATIO),
)
OF_TRAVEL = (
    LoadInfo("travel_resistance", "resistance to even travel", units.FORCE, governing=True),
    LoadInfo("travel_coefficient", "resistance of the wheels over the weight", units.RATIO, headline=False),
    LoadInfo("motor_speed", "speed of the motors", units.ANGULAR_SPEED),
    LoadInfo("torque_motor_travel", "torque of all motors, even travel", units.TORQUE, governing=True),
    LoadInfo("power_travel", "power of all motors, even travel", units.POWER, governing=True),
    LoadInfo("starting_reserve", "least starting torque over that of even travel", units.RATIO, governing=True),
    LoadInfo("wind_reserve", "driving force over the largest resistance in service", units.RATIO, governing=True),
    LoadInfo("torque_motor_rms", "heating torque of all motors (rms)", units.TORQUE),
    LoadInfo("heating_utilisation", "heating torque over what the duty allows", units.SHARE, governing=True),
    LoadInfo("starts_per_hour", "starts per hour", units.RATIO, headline=False),
)
OF_THE_CLASS = (
    LoadInfo("spectrum_factor", "factor of the load spectrum", units.RATIO, headline=False),
    LoadInfo("crane_group", "group of the crane that its use asks (A)", units.RATIO, headline=False),
    LoadInfo("mechanism_group", "group of the mechanism that its use asks (M)", units.RATIO, headline=False),
)
FACTORS = (
    LoadInfo("phi1", "phi1, weight of the crane", units.RATIO, governing=True),
    LoadInfo("phi2", "phi2, lifting off the ground", units.RATIO, governing=True),
    LoadInfo("phi3", "phi3, release of a part of the load", units.RATIO, governing=True),
    LoadInfo("phi4", "phi4, steps and gaps of the rail", units.RATIO, governing=True),
    LoadInfo("phi5", "phi5, change of drive forces", units.RATIO, governing=True),
    LoadInfo("phi6", "phi6, dynamic test", units.RATIO, governing=True),
    LoadInfo("phi7", "phi7, buffers", units.RATIO, governing=True),
)
OF_MOTION = (
    LoadInfo("start_time", "start time", units.TIME, governing=True),
    LoadInfo("start_distance", "way of the start", units.SPAN),
    LoadInfo("brake_time", "time of the stop", units.TIME, governing=True),
    LoadInfo("brake_distance", "way of the stop", units.SPAN, governing=True),
    LoadInfo("acceleration_max", "largest acceleration of the crane", units.ACCELERATION),
    LoadInfo("sway_angle_max", "largest angle of the load", units.ANGLE, governing=True),
    LoadInfo("sway_residual", "angle in which the load swings on", units.ANGLE, governing=True),
    LoadInfo("sway_period", "period of the load", units.TIME),
    LoadInfo("sway_free_ramp", "shortest ramp, no steeper, that leaves no swing", units.TIME, headline=False),
    LoadInfo("horizontal_force", "largest horizontal force of the load on the crane", units.FORCE, governing=True),
    LoadInfo("traction_max", "largest force of the driven wheels on the rails", units.FORCE),
    LoadInfo("torque_motor_max", "largest torque of all motors along the ramp", units.TORQUE),
    LoadInfo("drive_utilisation", "torque the ramp asks over what the motors give", units.SHARE),
    LoadInfo("skid_reserve_min", "least adhesion over what is asked, any driven wheel", units.RATIO, governing=True),
    LoadInfo("skid_reserve", "least adhesion over what is asked, corner", units.RATIO, headline=False),
)
OF_THE_BUFFERS = (
    LoadInfo("collision_speed", "speed at which the buffers are hit", units.SPEED, governing=True),
    LoadInfo("collision_energy", "energy of what hits the buffers", units.ENERGY),
    LoadInfo("buffer_force", "force of a buffer", units.FORCE, governing=True),
    LoadInfo("buffer_stroke", "stroke of a buffer", units.LENGTH, governing=True),
    LoadInfo("buffer_speed_left", "speed at which the buffer bottoms out", units.SPEED),
    LoadInfo("buffer_deceleration", "largest deceleration", units.ACCELERATION),
)
OF_THE_RAIL = (
    LoadInfo("rail_contact", "least wheel load over the static one", units.RATIO),
    LoadInfo("skew_angle", "angle of skewing", units.ANGLE),
    LoadInfo("skew_force", "force of the rail on the foremost guide", units.FORCE, governing=True),
    LoadInfo("skew_force_slip", "the same with the curve of friction at every wheel", units.FORCE),
    LoadInfo("skew_share", "share of the weight that is friction of skewing", units.RATIO, headline=False),
)
OF_THE_STORM = (
    LoadInfo("storm_force", "wind and slope out of service", units.FORCE, governing=True),
    LoadInfo("holding_force", "what brakes and clamps hold at the rails", units.FORCE),
    LoadInfo("storm_reserve", "what holds the crane over the wind out of service", units.RATIO, governing=True),
)
EVEN = (*OF_TRAVEL, *OF_THE_CLASS)

LOADS = (
    *OF_THE_WHEELS,
    *OF_TRAVEL,
    *OF_MOTION,
    *OF_THE_BUFFERS,
    *OF_THE_RAIL,
    *OF_THE_STORM,
    *FACTORS,
    *OF_THE_CLASS,
)

PER_CORNER = frozenset({"corner_load_max", "corner_load_min"})
PER_DRIVEN_CORNER = frozenset({"skid_reserve"})
MOVING = frozenset(info.name for info in OF_MOTION) | {"wheel_load_max", "wheel_load_min", "stability_reserve"}
"""What a start or a stop gives."""


def names(*groups: tuple[LoadInfo, ...]) -> frozenset[str]:
    """Names of loads."""
    return frozenset(info.name for group in groups for info in group)


def parts(spec: Travelling) -> Iterator[LoadInfo]:
    """The loads of one crane, corner by corner where they are of corners."""
    for info in LOADS:
        if info.name in PER_CORNER:
            yield from (info.of(corner) for corner in CORNERS)
        elif info.name in PER_DRIVEN_CORNER:
            yield from (info.of(corner) for corner in CORNERS if corner in spec.wheels.driven)
        else:
            yield info
