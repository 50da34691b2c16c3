"""The loads a chain drive can report."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.machines.chain_drive.spec import ChainDrive

LOADS = (
    LoadInfo("chain_speed", "mean chain speed", units.SPEED, headline=False),
    LoadInfo("sprocket_speed", "drive sprocket speed", units.ANGULAR_SPEED),
    LoadInfo("speed_max", "chain speed, maximum", units.SPEED, headline=False),
    LoadInfo("speed_ripple", "chain speed ripple (polygon effect)", units.SHARE),
    LoadInfo("acceleration_polygon_max", "polygon-effect acceleration, maximum", units.ACCELERATION),
    LoadInfo("static_resistance", "effective chain pull", units.FORCE, governing=True),
    LoadInfo("power_drive", "power at drive shaft", units.POWER, governing=True),
    LoadInfo("tension_static", "static chain tension, maximum", units.FORCE, governing=True),
    LoadInfo("tension_run_off", "static tension leaving sprocket", units.FORCE),
    LoadInfo("tension_centrifugal", "centrifugal tension", units.FORCE, headline=False),
    LoadInfo("tension_polygon_bound", "polygon-effect tension, upper bound", units.FORCE, headline=False),
    LoadInfo("tension_dynamic_polygon", "polygon-effect tension, maximum", units.FORCE, governing=True),
    LoadInfo("tension_dynamic_polygon_min", "polygon-effect tension, minimum", units.FORCE),
    LoadInfo("tension_dynamic_polygon_far", "polygon-effect tension at far end, maximum", units.FORCE, headline=False),
    LoadInfo("tension_design", "total chain tension, maximum", units.FORCE, governing=True),
    LoadInfo("tension_min", "total chain tension, minimum", units.FORCE, governing=True),
    LoadInfo("tension_start", "chain tension during start, maximum", units.FORCE, governing=True),
    LoadInfo("tension_dynamic_start", "dynamic component, start", units.FORCE),
    LoadInfo("starting_force", "mean starting force at the chain", units.FORCE),
    LoadInfo("starting_reserve", "starting force reserve", units.RATIO, governing=True),
    LoadInfo("start_time", "starting time", units.TIME, governing=True),
    LoadInfo("steady_reserve", "motor torque reserve, steady running", units.RATIO),
    LoadInfo("motor_utilisation", "motor torque / rated torque, steady running", units.SHARE, headline=False),
    LoadInfo("acceleration_motor", "motor angular acceleration", units.ANGULAR_ACCELERATION, headline=False),
    LoadInfo("reduced_inertia", "equivalent inertia at motor shaft", units.INERTIA, headline=False),
    LoadInfo("tension_speed_range", "polygon tension over speed sweep, maximum", units.FORCE, governing=True),
    LoadInfo("stop_time", "stopping time", units.TIME, governing=True),
    LoadInfo("stop_distance", "stopping distance", units.SPAN, governing=True),
    LoadInfo("coast_distance", "coasting distance, no brake", units.SPAN, governing=True),
    LoadInfo("brake_torque_required", "required brake torque, motor shaft", units.TORQUE, governing=True),
    LoadInfo("tension_overload_braking", "chain tension added by braking", units.FORCE, governing=True),
    LoadInfo("backstop_torque", "rollback torque, sprocket shaft", units.TORQUE, governing=True),
    LoadInfo("resistance_coefficient_identified", "resistance coefficient from coasting", units.RATIO, governing=True),
    LoadInfo("wave_speed", "wave speed, loaded strand", units.SPEED, headline=False),
    LoadInfo("wave_travel_time", "wave transit time, vibrating strands", units.TIME, headline=False),
    LoadInfo("natural_frequency", "longitudinal natural frequency", units.ANGULAR_FREQUENCY, headline=False),
    LoadInfo("resonance_speed", "resonance speed (harmonic, mode)", units.SPEED, headline=False),
    LoadInfo("resonance_speed_first", "resonance speed, first mode", units.SPEED),
    LoadInfo("frequency_ratio", "tooth / first natural frequency", units.RATIO, governing=True),
    LoadInfo("resonance_distance", "separation from nearest resonance", units.SHARE, governing=True),
    LoadInfo("safe_speed_below", "next safe speed below", units.SPEED),
    LoadInfo("safe_speed_above", "next safe speed above", units.SPEED),
    LoadInfo("resonance_factor_textbook", "textbook resonance factor K", units.RATIO, headline=False),
    LoadInfo("safe_window_low", "safe speed range, lower end", units.SPEED, headline=False),
    LoadInfo("safe_window_high", "safe speed range, upper end", units.SPEED, headline=False),
    LoadInfo("safety_static", "safety factor, static", units.RATIO, governing=True),
    LoadInfo("safety_dynamic", "safety factor, steady running", units.RATIO, governing=True),
    LoadInfo("safety_start", "safety factor, start or stop", units.RATIO, governing=True),
    LoadInfo("joint_pressure", "pin/bush bearing pressure", units.PRESSURE, governing=True),
    LoadInfo("shaft_load", "radial load on drive shaft", units.FORCE),
    LoadInfo("engagement_speed", "roller/tooth impact speed", units.SPEED, headline=False),
    LoadInfo("engagement_energy", "roller/tooth impact energy", units.ENERGY),
    LoadInfo("transverse_travel", "transverse displacement of strand end", units.LENGTH, headline=False),
    LoadInfo("transverse_speed", "transverse speed of strand end", units.SPEED, headline=False),
    LoadInfo("equalising_ratio", "equalising drive, speed ratio max/min", units.RATIO, headline=False),
    LoadInfo("equalising_torque", "equalising drive, inertia torque", units.TORQUE, headline=False),
    LoadInfo("wear_per_revolution", "pitch elongation per chain circuit", units.THICKNESS),
    LoadInfo("life", "wear life", units.RUNNING_TIME, governing=True),
    LoadInfo("stress_amplitude", "link plate stress amplitude", units.STRESS),
    LoadInfo("fatigue_utilisation", "fatigue utilisation of link plates", units.SHARE, governing=True),
    LoadInfo("tooth_passes", "tooth engagements in required life", units.RATIO, headline=False),
    LoadInfo("wrap", "wrap angle, smaller sprocket", units.ANGLE, headline=False),
    LoadInfo("teeth_least", "number of teeth, smaller sprocket", units.RATIO, headline=False),
    LoadInfo("ratio", "transmission ratio z2/z1", units.RATIO, headline=False),
    LoadInfo("pitches", "chain length in pitches", units.RATIO),
    LoadInfo("centre_distance", "centre distance", units.SPAN, headline=False),
    LoadInfo("centre_distance_fitted", "centre distance fitted to chain length", units.SPAN, headline=False),
    LoadInfo("centre_distance_pitches", "centre distance in pitches, C/p", units.RATIO, headline=False),
    LoadInfo("design_power", "design power per chain, 19 teeth", units.POWER, governing=True),
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
