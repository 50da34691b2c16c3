"""Overhead stacker: a column that hangs from the trolley of a bridge."""

from ptmcalc.machines.crane.stacking.machine.overhead import SCENES, OverheadStacker
from ptmcalc.machines.crane.stacking.manifest import stacker

OVERHEAD_STACKER = stacker(
    __name__, "overhead_stacker", "overhead stacker: bridge, trolley, suspended mast", OverheadStacker, SCENES
)
