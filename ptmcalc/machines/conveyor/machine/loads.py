"""Names of loads by what they depend on, and the families of a machine with several drives."""

from collections.abc import Iterable, Iterator
from dataclasses import replace

from ptmcalc.contract.result import LoadInfo
from ptmcalc.machines.conveyor.machine.scenes import ConveyorScene, Start
from ptmcalc.machines.conveyor.machine.spec import Conveyor

TENSIONS = (
    "tension_run_on_max",
    "tension_dynamic_run_on_max",
    "tension_max",
    "tension_min",
    "tension_curve_max",
    "tension_bend_max",
    "tension_bend_min",
    "slack_margin_min",
)
"""Loads that move with the tension somewhere on the belt, newton by newton."""

LOWEST = ("tension_run_off_min", "tension_min", "tension_bend_min", "slack_margin_min")
"""Tensions at their lowest."""

GRIP = ("slip_utilisation_max", "slip_reserve_min")
"""Loads of the drive drum's grip."""

DRIVE = ("starting_force_needed", "starting_reserve")
"""What a start asks of the drive."""

BRAKING_FORCE, BRAKING_RESERVE, BRAKING_POWER = "braking_force_needed", "braking_force_reserve", "braking_power_max"
"""What a controlled stop requires of the drives."""
DRIVE_OF_STOP = frozenset({BRAKING_FORCE, BRAKING_RESERVE, BRAKING_POWER})

BRAKE_HEAT, BRAKE_POWER = "brake_heat", "brake_power_mean"
"""Families: heat of each brake in a stop, and its mean power."""
OF_BRAKES = frozenset({BRAKE_HEAT, BRAKE_POWER})

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

TAKEUP_TOTAL = "takeup_travel_total"
"""Take-up travel of a scene with its movement."""
TAKEUP_CLEARANCES = ("takeup_clearance_upper_min", "takeup_clearance_lower_min")
"""Distances of the take-up weight from its stops."""
TAKEUP_WAYS = frozenset({"takeup_movement", TAKEUP_TOTAL, *TAKEUP_CLEARANCES})
"""Loads that move with the take-up, metre by metre."""

RUN_BACK_DISTANCE, RUN_BACK_SPEED = "run_back_distance", "run_back_speed"
"""Backward motion of the belt at the drives in an aborted start."""

BELT_SPEED, MOTOR_SPEED = "belt_speed_max", "motor_speed_max"
"""Families: largest speed of the belt at head and tail, and of the motors of each drive."""
ENDS = ("head", "tail")
"""Places at which speeds of the belt are reported."""

OF_SPEED = frozenset({RUN_BACK_DISTANCE, RUN_BACK_SPEED, BELT_SPEED, MOTOR_SPEED})
"""Speeds of belt and motors, and the run-back distance."""

OF_NETWORK = OF_BELT.union(OF_STOP, TAKEUP_WAYS, OF_BRAKES, OF_SPEED)
"""Loads that a march over the whole belt gives, besides those of each drive."""

CHANGED_BY_MOTION = OF_NETWORK | PER_DRIVE
"""Loads, and families of them, that depend on how the belt moves."""

FREQUENCIES = 3
"""Natural frequencies that are reported. An engineering choice: more lengthen the report. A different number changes
the names of the loads."""


def parts_of(loads: Iterable[LoadInfo], spec: Conveyor) -> Iterator[LoadInfo]:
    """Some loads of one conveyor: those of the belt, and of each drive; in the table a single drive is not named."""
    several = len(spec.all_drives) > 1
    for info in loads:
        if info.name == "natural_frequency":
            yield from (info.of(str(number)) for number in range(1, FREQUENCIES + 1))
            continue
        if info.name == BELT_SPEED:
            yield from (info.of(place) for place in ENDS)
            continue
        if info.name in ("motor_utilisation", MOTOR_SPEED):
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


def may_run_back(spec: Conveyor, scene: Start) -> bool:
    """Whether a start is aborted and no backstop holds all drive pulleys."""
    held = spec.backstop is not None and all(drive.at == "head" for drive in spec.all_drives.values())
    return scene.aborted is not None and not held
