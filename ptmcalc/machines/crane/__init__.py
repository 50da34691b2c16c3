"""Crane: what turns, travels or stacks. A file's `type` says which; each type has a manifest in a folder of its own.

A new type is one folder with a manifest and one name in the list below.
"""

from ptmcalc.contract.machine import of_types
from ptmcalc.machines.crane.overhead_stacker import OVERHEAD_STACKER
from ptmcalc.machines.crane.rack_stacker import RACK_STACKER
from ptmcalc.machines.crane.slewing import SLEWING
from ptmcalc.machines.crane.travelling import TRAVELLING

KIND = of_types(
    "crane", "crane: what slews, what travels, what stacks", SLEWING, TRAVELLING, OVERHEAD_STACKER, RACK_STACKER
)
