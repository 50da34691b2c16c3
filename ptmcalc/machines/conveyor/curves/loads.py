"""Tensions of the belt in horizontal curves, by strand and by what the curve carries."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo, of
from ptmcalc.machines.conveyor.machine.keys.route import Bend
from ptmcalc.machines.conveyor.machine.loading import choices, filling_of, in_operation, load_line_mass, pieces
from ptmcalc.machines.conveyor.machine.scenes import ConveyorScene, Run
from ptmcalc.machines.conveyor.machine.spec import Conveyor

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
    return (f"{name}_full" if any(_on_it(spec, bend, scene)) else f"{name}_empty",)


def loads_on(spec: Conveyor, bend: Bend, state: str, scene: ConveyorScene) -> list[float]:
    """Loads per length that the carrying strand may have in a state of a curve [kg/m]."""
    if not state.endswith("full"):
        return [0.0]
    found = [load_line_mass(spec, names) for names in _on_it(spec, bend, scene) if names]
    if isinstance(scene, Run):
        before = [piece.points for piece in pieces(spec) if piece.section == bend.number - 1][-1]
        feeding = in_operation(spec, scene)
        some = choices(tuple(name for name in before if name in feeding))
        found = [load_line_mass(spec, names) for names in some if names]
    return found or [0.0]


def _on_it(spec: Conveyor, bend: Bend, scene: ConveyorScene) -> list[tuple[str, ...]]:
    """The loading points whose material lies on the lengths of a curve in a scene."""
    loaded = zip(pieces(spec), filling_of(spec, scene), strict=True)
    return [names for piece, names in loaded if piece.section == bend.number - 1]


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
