"""Rack stacker: a column that stands on a base in the aisle between racks."""

from ptmcalc.machines.crane.stacking.machine.rack import SCENES, RackStacker
from ptmcalc.machines.crane.stacking.manifest import stacker

RACK_STACKER = stacker(
    __name__, "rack_stacker", "rack stacker (storage/retrieval machine): base, mast", RackStacker, SCENES
)
