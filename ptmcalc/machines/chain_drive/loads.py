"""The loads a chain drive can report."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.machines.chain_drive.spec import ChainDrive

LOADS = (
    LoadInfo("chain_speed", "mean speed of the chain", units.SPEED, headline=False),
    LoadInfo("sprocket_speed", "speed of the driving sprocket", units.ANGULAR_SPEED),
    LoadInfo("speed_max", "largest speed of the chain", units.SPEED, headline=False),
    LoadInfo("speed_ripple", "unevenness of the chain's speed", units.SHARE),
    LoadInfo("acceleration_polygon_max", "polygon acceleration", units.ACCELERATION),
    LoadInfo("static_resistance", "pull of the drive", units.FORCE, governing=True),
    LoadInfo("power_drive", "power at the drive shaft", units.POWER, governing=True),
    LoadInfo("tension_static", "chain tension, static, largest", units.FORCE, governing=True),
    LoadInfo("tension_run_off", "tension at the run-off, static", units.FORCE),
    LoadInfo("tension_centrifugal", "centrifugal tension", units.FORCE, headline=False),
    LoadInfo("tension_polygon_bound", "polygon tension, bound", units.FORCE, headline=False),
    LoadInfo("tension_dynamic_polygon", "polygon tension, largest", units.FORCE, governing=True),
    LoadInfo("tension_dynamic_polygon_min", "polygon tension, smallest", units.FORCE),
    LoadInfo("tension_dynamic_polygon_far", "polygon tension at the far end, largest", units.FORCE, headline=False),
    LoadInfo("tension_design", "chain tension, largest", units.FORCE, governing=True),
    LoadInfo("tension_min", "chain tension, smallest", units.FORCE, governing=True),
    LoadInfo("tension_start", "chain tension in the start, largest", units.FORCE, governing=True),
    LoadInfo("tension_dynamic_start", "dynamic part of it", units.FORCE),
    LoadInfo("starting_force", "mean starting force at the chain", units.FORCE),
    LoadInfo("starting_reserve", "starting force over what it must overcome", units.RATIO, governing=True),
    LoadInfo("start_time", "start time", units.TIME, governing=True),
    LoadInfo("acceleration_motor", "angular acceleration of the motor", units.ANGULAR_ACCELERATION, headline=False),
    LoadInfo("reduced_inertia", "inertia on the motor shaft", units.INERTIA, headline=False),
    LoadInfo("tension_speed_range", "polygon tension through the range of speeds", units.FORCE, governing=True),
    LoadInfo("stop_time", "time to come to rest", units.TIME, governing=True),
    LoadInfo("stop_distance", "way to come to rest", units.SPAN, governing=True),
    LoadInfo("coast_distance", "way without brakes", units.SPAN, governing=True),
    LoadInfo("brake_torque_required", "brake torque for the allowed way, motor shaft", units.TORQUE, governing=True),
    LoadInfo("tension_overload_braking", "tension that braking adds", units.FORCE, governing=True),
    LoadInfo("backstop_torque", "torque that runs it back, sprocket shaft", units.TORQUE, governing=True),
    LoadInfo(
        "resistance_coefficient_identified", "resistance coefficient of the measured way", units.RATIO, governing=True
    ),
    LoadInfo("wave_speed", "wave speed, working strand", units.SPEED, headline=False),
    LoadInfo("wave_travel_time", "travel time of a wave along what vibrates", units.TIME, headline=False),
    LoadInfo("natural_frequency", "natural frequency of the chain", units.ANGULAR_FREQUENCY, headline=False),
    LoadInfo("resonance_speed", "resonance speed of harmonic, mode", units.SPEED, headline=False),
    LoadInfo("resonance_speed_first", "resonance speed of the first mode", units.SPEED),
    LoadInfo("frequency_ratio", "tooth frequency over first natural frequency", units.RATIO, governing=True),
    LoadInfo("resonance_distance", "speed from the nearest resonance", units.SHARE, governing=True),
    LoadInfo("safe_speed_below", "nearest safe speed below", units.SPEED),
    LoadInfo("safe_speed_above", "nearest safe speed above", units.SPEED),
    LoadInfo("resonance_factor_textbook", "K of the textbook for this modulus", units.RATIO, headline=False),
    LoadInfo("safe_window_low", "lower end of a safe range of speed", units.SPEED, headline=False),
    LoadInfo("safe_window_high", "upper end of a safe range of speed", units.SPEED, headline=False),
    LoadInfo("safety_static", "safety against breaking, static", units.RATIO, governing=True),
    LoadInfo("safety_dynamic", "safety against breaking", units.RATIO, governing=True),
    LoadInfo("safety_start", "safety against breaking, start or stop", units.RATIO, governing=True),
    LoadInfo("joint_pressure", "pressure in the joints", units.PRESSURE, governing=True),
    LoadInfo("shaft_load", "pull of the chain on the drive shaft", units.FORCE),
    LoadInfo("engagement_speed", "speed at which a joint meets its tooth", units.SPEED, headline=False),
    LoadInfo("engagement_energy", "energy of the blow of a joint", units.ENERGY),
    LoadInfo("transverse_travel", "travel of the strand's end across it", units.LENGTH, headline=False),
    LoadInfo("transverse_speed", "speed of the strand's end across it", units.SPEED, headline=False),
    LoadInfo("equalising_ratio", "equalising drive: largest over smallest speed", units.RATIO, headline=False),
    LoadInfo("equalising_torque", "equalising drive: torque that its own inertia takes", units.TORQUE, headline=False),
    LoadInfo("wear_per_revolution", "growth of the pitch in a revolution of the chain", units.THICKNESS),
    LoadInfo("life", "life by wear", units.RUNNING_TIME, governing=True),
    LoadInfo("stress_amplitude", "stress amplitude of the plates", units.STRESS),
    LoadInfo("fatigue_utilisation", "use of the fatigue limit", units.SHARE, governing=True),
    LoadInfo("tooth_passes", "tooth passes in the wanted life", units.RATIO, headline=False),
    LoadInfo("wrap", "wrap of the smaller sprocket", units.ANGLE, headline=False),
    LoadInfo("teeth_least", "teeth of the smaller sprocket", units.RATIO, headline=False),
    LoadInfo("ratio", "ratio of the teeth", units.RATIO, headline=False),
    LoadInfo("pitches", "length of the chain in pitches", units.RATIO),
    LoadInfo("centre_distance", "distance of the shafts", units.SPAN, headline=False),
    LoadInfo("centre_distance_fitted", "distance of the shafts that fits the chain", units.SPAN, headline=False),
    LoadInfo("centre_distance_pitches", "distance of the shafts in pitches", units.RATIO, headline=False),
    LoadInfo("design_power", "design power of one chain on 19 teeth", units.POWER, governing=True),
)


def parts(spec: ChainDrive) -> Iterator[LoadInfo]:
    """The loads of one chain drive; `resonance_speed[n,k]` of the harmonic n with the mode k."""
    for info in LOADS:
        if info.name == "natural_frequency":
            yield from (info.of(str(mode)) for mode in range(1, FREQUENCIES + 1))
        elif info.name == "resonance_speed":
            yield from (
                info.of(f"{order},{mode}") for order in range(1, ORDERS + 1) for mode in range(1, FREQUENCIES + 1)
            )
        elif info.name in ("safe_window_low", "safe_window_high"):
            yield from (info.of(str(window)) for window in range(1, WINDOWS + 1))
        else:
            yield info


FREQUENCIES, ORDERS, WINDOWS = 3, 6, 8
"""How many natural frequencies, harmonics of the teeth and safe ranges of speed are reported."""
