"""The loads a conveyor can report."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo

LOADS = (
    LoadInfo("tension_run_on_max", "run-on tension, largest", units.FORCE),
    LoadInfo("tension_dynamic_run_on_max", "dynamic part of it", units.FORCE),
    LoadInfo("tension_run_off_min", "run-off tension, smallest", units.FORCE),
    LoadInfo("tension_max", "belt tension, largest anywhere", units.FORCE),
    LoadInfo("tension_min", "belt tension, smallest anywhere", units.FORCE),
    LoadInfo("slack_margin_min", "tension above slack, smallest", units.FORCE),
    LoadInfo("slip_utilisation_max", "grip used at the drum", units.SHARE),
    LoadInfo("slip_reserve_min", "reserve of grip", units.RATIO),
    LoadInfo("belt_safety_min", "belt safety", units.RATIO),
    LoadInfo("sag_relative_max", "sag over idler pitch", units.SHARE),
    LoadInfo("static_resistance", "static resistance at the rim", units.FORCE),
    LoadInfo("starting_force", "mean starting force at the rim", units.FORCE),
    LoadInfo("starting_force_needed", "force needed at the rim to start", units.FORCE),
    LoadInfo("starting_reserve", "available over needed force", units.RATIO),
    LoadInfo("rim_force_excess", "force over the static resistance", units.FORCE),
    LoadInfo("acceleration_rigid", "acceleration, rigid body", units.ACCELERATION),
    LoadInfo("start_time_rigid", "start time, rigid body", units.TIME),
    LoadInfo("first_wave_time_max", "time of the textbook peak", units.TIME, headline=False),
    LoadInfo("reduced_drive_mass", "drive reduced to the rim", units.MASS),
    LoadInfo("wave_speed_carry", "wave speed, carry strand", units.SPEED, headline=False),
    LoadInfo("wave_speed_return", "wave speed, return strand", units.SPEED, headline=False),
    LoadInfo("impedance_carry", "impedance, carry strand", units.IMPEDANCE, headline=False),
    LoadInfo("impedance_return", "impedance, return strand", units.IMPEDANCE, headline=False),
)

TENSIONS = (
    "tension_run_on_max",
    "tension_dynamic_run_on_max",
    "tension_max",
    "tension_min",
    "slack_margin_min",
)
"""Loads that move with the tension somewhere on the belt, newton by newton."""

GRIP = ("slip_utilisation_max", "slip_reserve_min")
"""Loads of the drive drum's grip."""

DRIVE = ("starting_force_needed", "starting_reserve")
"""What a start asks of the drive."""

AT_DRUM = frozenset({"tension_run_on_max", "tension_dynamic_run_on_max", "tension_run_off_min", *GRIP})
"""Loads known from the two tensions at the drive drum."""

OF_BELT = AT_DRUM.union(TENSIONS, {"belt_safety_min", "sag_relative_max"})
"""Loads that depend on how the belt moves."""
