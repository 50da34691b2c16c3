"""Choice of the chain: static safety, wear life, geometry, rated power."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.contract.topic import Topic
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive
from ptmcalc.machines.chain_drive.selection.checks import (
    FAR_SHAFTS,
    LIFE,
    NEAR_SHAFTS,
    POWER,
    RATIO,
    STATIC_SAFETY,
    TEETH,
    WRAP,
)
from ptmcalc.machines.chain_drive.selection.solver import CHAIN_SELECTION

SELECTION: Topic[ChainDrive] = Topic(
    loads=(
        LoadInfo("safety_static", "safety factor, static", units.RATIO, governing=True),
        LoadInfo("shaft_load", "radial load on drive shaft", units.FORCE),
        LoadInfo("engagement_speed", "roller/tooth impact speed", units.SPEED, headline=False),
        LoadInfo("engagement_energy", "roller/tooth impact energy", units.ENERGY),
        LoadInfo("transverse_travel", "transverse displacement of strand end", units.LENGTH, headline=False),
        LoadInfo("transverse_speed", "transverse speed of strand end", units.SPEED, headline=False),
        LoadInfo("equalising_ratio", "equalising drive, speed ratio max/min", units.RATIO, headline=False),
        LoadInfo("equalising_torque", "equalising drive, inertia torque", units.TORQUE, headline=False),
        LoadInfo("wear_per_revolution", "pitch elongation per chain circuit", units.THICKNESS),
        LoadInfo("life", "wear life", units.RUNNING_TIME, governing=True),
        LoadInfo("tooth_passes", "tooth engagements in required life", units.RATIO, headline=False),
        LoadInfo("wrap", "wrap angle, smaller sprocket", units.ANGLE, headline=False),
        LoadInfo("teeth_least", "number of teeth, smaller sprocket", units.RATIO, headline=False),
        LoadInfo("ratio", "transmission ratio z2/z1", units.RATIO, headline=False),
        LoadInfo("pitches", "chain length in pitches", units.RATIO),
        LoadInfo("centre_distance", "centre distance", units.SPAN, headline=False),
        LoadInfo("centre_distance_fitted", "centre distance fitted to chain length", units.SPAN, headline=False),
        LoadInfo("centre_distance_pitches", "centre distance in pitches, C/p", units.RATIO, headline=False),
        LoadInfo("design_power", "design power per chain, 19 teeth", units.POWER, governing=True),
    ),
    solvers=(CHAIN_SELECTION,),
    checks=(STATIC_SAFETY, LIFE, WRAP, TEETH, RATIO, NEAR_SHAFTS, FAR_SHAFTS, POWER),
)
