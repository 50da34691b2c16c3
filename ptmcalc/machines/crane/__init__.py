"""Crane: what turns, travels or stacks. A file's `type` says which; each type has a manifest in a folder of its own.

A new type is one folder with a manifest and one line in the list below. A file of one type imports no other: the whole
kind, of which `new`, `explain` and the lists speak, is put together when it is asked for.
"""

from functools import cache
from importlib import import_module

from ptmcalc.contract.example import examples_in
from ptmcalc.contract.machine import AnyKind, of_types

TYPES = {
    "slewing": "ptmcalc.machines.crane.slewing:SLEWING",
    "travelling": "ptmcalc.machines.crane.travelling:TRAVELLING",
    "overhead_stacker": "ptmcalc.machines.crane.overhead_stacker:OVERHEAD_STACKER",
    "rack_stacker": "ptmcalc.machines.crane.rack_stacker:RACK_STACKER",
}
"""Where the manifest of each type is."""


def __getattr__(name: str) -> AnyKind:
    if name == "KIND":
        return _whole()
    raise AttributeError(name)


@cache
def _whole() -> AnyKind:
    places = (place.split(":") for place in TYPES.values())
    types = [getattr(import_module(module), attribute) for module, attribute in places]
    title = "cranes: slewing, travelling and stacker cranes"
    return of_types("crane", title, *types, examples=examples_in(__package__))
