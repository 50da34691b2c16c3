"""Tensions of the belt in horizontal curves, by strand and by what the curve carries."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo, of
from ptmcalc.machines.conveyor.keys.route import Bend
from ptmcalc.machines.conveyor.model import filling_of
from ptmcalc.machines.conveyor.spec import Conveyor, ConveyorScene, Run

LEAST, MOST = "tension_bend_min", "tension_bend_max"

LOADS = (
    LoadInfo(LEAST, "belt tension in horizontal curve, minimum", units.FORCE, headline=False),
    LoadInfo(MOST, "belt tension in horizontal curve, maximum", units.FORCE, headline=False),
)

STRANDS = ("carry", "return")


def states(spec: Conveyor, bend: Bend, strand: str, scene: ConveyorScene | None = None) -> tuple[str, ...]:
    """Names of the states of a curve: the loaded and the empty carrying strand in steady running, one of them in any
    other scene; the return strand has one."""
    name = f"{bend.number}_{strand}"
    if strand == "return":
        return (name,)
    if scene is None or isinstance(scene, Run):
        return (f"{name}_full", f"{name}_empty")
    return (f"{name}_full" if filling_of(spec, scene)[bend.number - 1] else f"{name}_empty",)


def bend_names(spec: Conveyor, scene: ConveyorScene | None = None) -> Iterator[tuple[str, str, str, Bend]]:
    """Names of the least and of the largest tension, strand and curve, for each state of each curve."""
    for bend in spec.route.bends:
        for strand in STRANDS:
            for state in states(spec, bend, strand, scene):
                yield of(LEAST, state), of(MOST, state), strand, bend


def loads_of(spec: Conveyor) -> Iterator[LoadInfo]:
    """Those loads of a conveyor."""
    for info in LOADS:
        for bend in spec.route.bends:
            for strand in STRANDS:
                yield from (info.of(state) for state in states(spec, bend, strand))
