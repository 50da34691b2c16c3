"""The checks of a hoist that moves evenly."""

from collections.abc import Mapping

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, Sense, no_needs
from ptmcalc.machines.hoist.spec import Hoist, Run

Loads = Mapping[str, Estimate]
RUNNING = frozenset({Run})


def _room(spec: Hoist, scene: Run) -> Estimate:
    """Length of the wound part of the drum.

    **Range** any drum.
    **Error** none: a given value.
    **Source** the file.
    """
    return Estimate.exact(spec.drum.length)


def _length_key(spec: Hoist, scene: Run) -> KeyPath:
    return ("drum", "length")


CAPACITY: Check[Hoist, Run] = Check(
    code="HST104",
    title="too little room for the rope on the drum",
    scenes=RUNNING,
    loads=("drum_length_required",),
    sense=Sense.AT_MOST,
    limit=_room,
    needs=no_needs,
    blame=lambda spec, scene, loads: ("drum", "length"),
    repair=_length_key,
    what="The rope of the whole lifting height and the turns that stay lie on the drum in the layers of the file.",
    why="Rope that finds no room climbs over the flange, or piles up and is crushed.",
    formula="p (l/(2 pi) + lost)/sum R_k <= L",
    source="geometry of the drum",
)

CHECKS: tuple[AnyCheck, ...] = (CAPACITY,)
"""Loads of statics are judged here; those of motion stand with their scenes."""
