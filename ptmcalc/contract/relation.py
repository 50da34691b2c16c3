"""A relation between loads of one scene that applies to every machine, such as "maximum anywhere >= at the pulley".

Every report is tested against the relations of its kind. Intervals are intersected where a relation allows it, which
narrows error bars; loads that contradict each other make every check that reads them undecided.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import product
from typing import Any

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.spec.scene import Scene

Bounds = Mapping[str, Interval]
"""By the name of a load, the interval that must contain it."""


@dataclass(frozen=True, slots=True)
class Relation:
    """A relation between loads.

    `loads` are the loads it needs; it applies to scenes of `scenes` in which all of them are known. `bounds` returns,
    from their estimates, the interval in which each of them must be. Loads may be families: the relation then holds
    for each part of the machine that has all of them. `why` states the relation in one sentence.
    """

    loads: tuple[str, ...]
    scenes: frozenset[type[Scene]]
    bounds: Callable[[Any, Any, Mapping[str, Estimate]], Bounds]
    why: str


def ordered(larger: str, smaller: str, scenes: frozenset[type[Scene]], why: str) -> Relation:
    """The relation `larger >= smaller`."""

    def bounds(spec: MachineSpec, scene: Scene, loads: Mapping[str, Estimate]) -> Bounds:
        return {
            larger: Interval(loads[smaller].low, float("inf")),
            smaller: Interval(-float("inf"), loads[larger].high),
        }

    return Relation((larger, smaller), scenes, bounds, why)


def computed(
    load: str,
    of: tuple[str, ...],
    value: Callable[[Any, Any, Mapping[str, float]], float],
    scenes: frozenset[type[Scene]],
    why: str,
) -> Relation:
    """The relation `load = value(others)`, of a value that is monotonic in each of the others.

    It bounds the load only. The extremes of a monotonic function are at corners of the box of the intervals.
    """

    def bounds(spec: MachineSpec, scene: Scene, loads: Mapping[str, Estimate]) -> Bounds:
        corners = product(*({loads[name].low, loads[name].high} for name in of))
        found = [value(spec, scene, dict(zip(of, corner, strict=True))) for corner in corners]
        return {load: Interval(min(found), max(found))}

    return Relation((load, *of), scenes, bounds, why)
