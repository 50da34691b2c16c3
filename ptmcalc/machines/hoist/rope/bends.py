"""Bendings of the worst piece of rope in one lift, from the places of sheaves and drum along the rope."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

from ptmcalc.machines.hoist.machine import model
from ptmcalc.machines.hoist.machine.spec import Hoist


@dataclass(frozen=True, slots=True)
class Bends:
    """What one piece of rope passes while the hook is lifted over its whole height."""

    sheaves: int
    drum: int
    """1 where the piece is wound on the drum, else 0"""


def passages(spec: Hoist) -> tuple[list[tuple[float, float]], tuple[float, float]]:
    """Pieces of a rope that pass each of its sheaves in a lift, and that which the drum takes up.

    Places are lengths along the rope from its fixed end or the equalising sheave [m]. With falls of the length H the
    k-th sheave from there is at k H, the drum at m H + l_0. H falls from H_0 to H_1 in the lift:

        sheave k: k H_1 to k H_0,   deflection sheaves: m H_1 to m H_0 + l_0,   drum: m H_1 + l_0 to m H_0 + l_0

    **Range** vertical falls of equal length, lifts over the whole height. The place of a deflection sheave on the lead
    is not known: it may be anywhere on it, which is on the safe side.
    **Error** half a turn of each sheave.
    **Source** length of the rope.
    """
    falls, lead = model.falls_of_a_rope(spec), spec.reeving.lead_length
    long, short = (model.fall_length(spec, height) for height in (0.0, spec.height))
    places = [(k * short, k * long) for k in range(1, falls)]
    places += [(falls * short, falls * long + lead)] * spec.reeving.deflection_sheaves
    return places, (falls * short + lead, falls * long + lead)


def worst(spec: Hoist, weight: Callable[[Bends], float]) -> Bends:
    """The bendings of the piece of rope with the largest weight.

    Args:
        spec: the hoist.
        weight: damage or count of the bendings of a piece; more bendings, more weight.

    **Range** as `passages`.
    **Error** exact: between neighbouring ends of the pieces nothing changes.
    **Source** `passages`.
    """
    sheaves, drum = passages(spec)
    ends = sorted({end for piece in (*sheaves, drum) for end in piece})
    found = {Bends(0, 1)}
    for low, high in pairwise(ends):
        middle = (low + high) / 2
        over = sum(begin < middle < end for begin, end in sheaves)
        found.add(Bends(over, int(drum[0] < middle < drum[1])))
    return max(sorted(found, key=lambda one: (one.sheaves, one.drum)), key=weight)


def smallest_ratio(spec: Hoist) -> float | None:
    """Smallest D/d of drum and running sheaves, D to the rope centre; None where sheaves have no diameter [1]."""
    ratio = sheave_ratio(spec)
    if runs_over_sheaves(spec) and ratio is None:
        return None
    return min(drum_ratio(spec), ratio) if ratio is not None else drum_ratio(spec)


def runs_over_sheaves(spec: Hoist) -> bool:
    """Whether the rope passes a sheave at all."""
    return model.falls_of_a_rope(spec) > 1 or spec.reeving.deflection_sheaves > 0


def drum_ratio(spec: Hoist) -> float:
    """D/d of the drum, D to the centre of the rope [1]."""
    return spec.drum.diameter / spec.rope.diameter + 1


def sheave_ratio(spec: Hoist) -> float | None:
    """D/d of the running sheaves, D to the centre of the rope; None without sheaves or their diameter [1]."""
    size = spec.reeving.sheave_diameter
    return size / spec.rope.diameter + 1 if size is not None and runs_over_sheaves(spec) else None
