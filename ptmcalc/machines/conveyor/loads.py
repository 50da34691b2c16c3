"""The loads a conveyor can report."""

from collections.abc import Iterator
from dataclasses import replace

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.machines.conveyor.spec import Conveyor, ConveyorScene

LOADS = (
    LoadInfo("tension_run_on_max", "T1 entering drive pulley, maximum", units.FORCE, governing=True),
    LoadInfo("tension_dynamic_run_on_max", "T1 dynamic component, maximum", units.FORCE, governing=True),
    LoadInfo("tension_run_off_min", "T2 leaving drive pulley, minimum", units.FORCE),
    LoadInfo("tension_max", "belt tension, maximum", units.FORCE, governing=True),
    LoadInfo("tension_min", "belt tension, minimum", units.FORCE, governing=True),
    LoadInfo("slack_margin_min", "tension above slack limit, minimum", units.FORCE, governing=True),
    LoadInfo("slip_utilisation_max", "traction used (T1/T2)/e^(mu*alpha)", units.SHARE, governing=True),
    LoadInfo("slip_reserve_min", "traction reserve, minimum", units.RATIO, governing=True),
    LoadInfo("belt_safety_min", "belt safety factor, minimum", units.RATIO, governing=True),
    LoadInfo("sag_relative_max", "belt sag ratio h/a, maximum", units.SHARE, governing=True),
    LoadInfo("slip_distance", "slip distance at drive pulley", units.SPAN),
    LoadInfo("slip_heat", "slip heat at drive pulley", units.ENERGY),
    LoadInfo("stop_time", "stopping time", units.TIME, governing=True),
    LoadInfo("stop_distance", "stopping distance", units.SPAN, governing=True),
    LoadInfo("stop_distance_max", "stopping distance, maximum of all points", units.SPAN, governing=True),
    LoadInfo("coast_distance", "coasting distance, no brakes", units.SPAN, governing=True),
    LoadInfo("brake_torque_required", "required brake torque, pulley shaft", units.TORQUE, governing=True),
    LoadInfo("tension_overload_braking", "belt tension added by braking", units.FORCE),
    LoadInfo("resistance_coefficient_identified", "friction factor f from coasting test", units.RATIO, governing=True),
    LoadInfo("backstop_torque", "rollback torque, drive pulley shaft", units.TORQUE, governing=True),
    LoadInfo("effective_tension", "effective tension T_e (F_U)", units.FORCE, governing=True),
    LoadInfo("effective_tension_worst", "T_e, worst partial loading", units.FORCE, headline=False),
    LoadInfo("power_drive_running", "power at drive pulley shafts", units.POWER, governing=True),
    LoadInfo("power_drive_empty", "power at drive pulley shafts, empty belt", units.POWER, headline=False),
    LoadInfo("power_motor_running", "power at motor shafts", units.POWER, headline=False),
    LoadInfo("steady_reserve", "motor torque reserve, steady running", units.RATIO),
    LoadInfo("motor_utilisation", "motor torque / rated torque, steady running", units.SHARE, headline=False),
    LoadInfo("sag_tension_required", "tension required by sag limit", units.FORCE, headline=False),
    LoadInfo("slack_side_tension_required", "slack-side tension required for traction", units.FORCE, headline=False),
    LoadInfo("takeup_travel", "required take-up travel", units.LENGTH, headline=False),
    LoadInfo("takeup_movement", "take-up movement range in the scene", units.LENGTH, headline=False),
    LoadInfo("takeup_mass", "gravity take-up mass, two belt strands", units.MASS, headline=False),
    LoadInfo("belt_cycle_time", "belt circuit time", units.TIME, headline=False),
    LoadInfo("natural_frequency", "longitudinal natural frequency of belt", units.ANGULAR_FREQUENCY, headline=False),
    LoadInfo("static_resistance", "static resistance at pulley", units.FORCE),
    LoadInfo("starting_force", "mean starting force at pulley", units.FORCE),
    LoadInfo("starting_force_needed", "required starting force at pulley", units.FORCE),
    LoadInfo("starting_reserve", "starting force reserve", units.RATIO, governing=True),
    LoadInfo("rim_force_excess", "accelerating force at pulley", units.FORCE),
    LoadInfo("acceleration_rigid", "acceleration, rigid-belt model", units.ACCELERATION),
    LoadInfo("start_time", "starting time", units.TIME, headline=False),
    LoadInfo("start_time_rigid", "starting time, rigid-belt model", units.TIME, governing=True),
    LoadInfo("first_wave_time_max", "time of first-wave peak, textbook", units.TIME, headline=False),
    LoadInfo("reduced_drive_mass", "equivalent drive mass at pulley", units.MASS),
    LoadInfo("wave_speed_carry", "wave speed, carrying strand", units.SPEED, headline=False),
    LoadInfo("wave_speed_return", "wave speed, return strand", units.SPEED, headline=False),
    LoadInfo("impedance_carry", "wave impedance, carrying strand", units.IMPEDANCE, headline=False),
    LoadInfo("impedance_return", "wave impedance, return strand", units.IMPEDANCE, headline=False),
)

TENSIONS = (
    "tension_run_on_max",
    "tension_dynamic_run_on_max",
    "tension_max",
    "tension_min",
    "tension_curve_max",
    "slack_margin_min",
)
"""Loads that move with the tension somewhere on the belt, newton by newton."""

LOWEST = ("tension_run_off_min", "tension_min", "slack_margin_min")
"""Tensions at their lowest."""

GRIP = ("slip_utilisation_max", "slip_reserve_min")
"""Loads of the drive drum's grip."""

DRIVE = ("starting_force_needed", "starting_reserve")
"""What a start asks of the drive."""

AT_DRUM = frozenset({"tension_run_on_max", "tension_dynamic_run_on_max", "tension_run_off_min", *GRIP})
"""Loads known from the two tensions at the drive drum."""

OF_BELT = AT_DRUM.union(TENSIONS, {"belt_safety_min", "sag_relative_max"})
"""Loads that depend on how the belt moves."""

PER_DRIVE = frozenset(
    {
        "tension_run_on_max",
        "tension_run_off_min",
        "slip_utilisation_max",
        "slip_reserve_min",
        "slip_distance",
        "slip_heat",
    }
)
"""Families: loads that each drive has."""

SLIPS = frozenset({"slip_distance", "slip_heat"})
"""Families of slip, which are never negative."""

OF_STOP = frozenset({"stop_time", "stop_distance", "stop_distance_max", "coast_distance"})
"""Loads of a belt that comes to rest."""

WAYS_OF_STOP = frozenset({"stop_distance", "stop_distance_max", "coast_distance"})
"""Distances of a belt that comes to rest."""


def ways_of(scene: ConveyorScene) -> tuple[str, ...]:
    """The distances that a stop of this type reports: at the head, and the longest anywhere."""
    return ("coast_distance",) if scene.type == "coast" else ("stop_distance", "stop_distance_max")


OF_START = frozenset(
    {
        "natural_frequency",
        "static_resistance",
        "starting_force",
        "rim_force_excess",
        "acceleration_rigid",
        "start_time",
        "start_time_rigid",
        "first_wave_time_max",
        "reduced_drive_mass",
        "wave_speed_carry",
        "wave_speed_return",
        "impedance_carry",
        "impedance_return",
    }
)
"""Closed forms of a start."""

OF_NETWORK = OF_BELT.union(OF_STOP, {"takeup_movement"})
"""Loads that a march over the whole belt gives, besides those of each drive."""

CHANGED_BY_MOTION = OF_NETWORK | PER_DRIVE
"""Loads, and families of them, that depend on how the belt moves."""

FREQUENCIES = 3
"""How many natural frequencies are reported."""


def parts(spec: Conveyor) -> Iterator[LoadInfo]:
    """The loads of one conveyor: those of the belt, and of each drive; in the table a single drive is not named."""
    several = len(spec.all_drives) > 1
    for info in LOADS:
        if info.name == "natural_frequency":
            yield from (info.of(str(number)) for number in range(1, FREQUENCIES + 1))
            continue
        if info.name == "motor_utilisation":
            yield from (info.of(name) for name in spec.all_drives)
            continue
        if info.name not in SLIPS:
            yield info
        if info.name in PER_DRIVE:
            for name in spec.all_drives:
                one = info.of(name)
                yield one if several or info.name in SLIPS else quiet(one)


def quiet(info: LoadInfo) -> LoadInfo:
    """The same load, not in the table."""
    return replace(info, headline=False)
