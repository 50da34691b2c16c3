"""Overhead stacker: a column that hangs from the trolley of a bridge."""

from ptmcalc.machines.crane.stacking.manifest import stacker
from ptmcalc.machines.crane.stacking.overhead import SCENES, OverheadStacker

OVERHEAD_STACKER = stacker(
    __name__, "overhead_stacker", "overhead stacker: bridge, trolley, suspended mast", OverheadStacker, SCENES
)
