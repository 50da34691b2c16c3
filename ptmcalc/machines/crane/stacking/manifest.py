"""How both types of stacker crane are put together from what they have in common."""

from collections.abc import Iterable
from typing import Any, TypeVar

from ptmcalc.contract.check import AnyCheck
from ptmcalc.contract.effect import AnyEffect
from ptmcalc.contract.example import symbols_in
from ptmcalc.contract.machine import MachineKind, template_in, witnesses_in
from ptmcalc.contract.solver import AnySolver
from ptmcalc.machines.crane.stacking.assumptions import assumptions
from ptmcalc.machines.crane.stacking.collision.checks import CHECKS_OF_BUFFERS
from ptmcalc.machines.crane.stacking.figures import FIGURES
from ptmcalc.machines.crane.stacking.fork.checks import CHECKS_OF_THE_FORK
from ptmcalc.machines.crane.stacking.fork.effects import EFFECTS_OF_THE_FORK
from ptmcalc.machines.crane.stacking.loads import LOADS, parts
from ptmcalc.machines.crane.stacking.mast.checks import CHECKS_OF_MAST
from ptmcalc.machines.crane.stacking.mast.effects import EFFECTS_OF_MAST
from ptmcalc.machines.crane.stacking.mechanisms.checks import CHECKS_OF_STATICS
from ptmcalc.machines.crane.stacking.rail.checks import CHECKS_OF_THE_RAIL
from ptmcalc.machines.crane.stacking.rail.effects import EFFECTS_OF_THE_RAIL
from ptmcalc.machines.crane.stacking.relations import relations_of
from ptmcalc.machines.crane.stacking.safety_gear.checks import CHECKS_OF_THE_SAFETY_GEAR
from ptmcalc.machines.crane.stacking.safety_gear.effects import EFFECTS_OF_THE_SAFETY_GEAR
from ptmcalc.machines.crane.stacking.solvers import SOLVERS
from ptmcalc.machines.crane.stacking.spec import Stacker
from ptmcalc.machines.crane.stacking.strength.checks import CHECKS_OF_STRENGTH
from ptmcalc.machines.crane.stacking.strength.combinations import tables
from ptmcalc.spec.scene import Scene

EFFECTS = (*EFFECTS_OF_MAST, *EFFECTS_OF_THE_FORK, *EFFECTS_OF_THE_RAIL, *EFFECTS_OF_THE_SAFETY_GEAR)
CHECKS = (
    *CHECKS_OF_STATICS,
    *CHECKS_OF_STRENGTH,
    *CHECKS_OF_MAST,
    *CHECKS_OF_BUFFERS,
    *CHECKS_OF_THE_FORK,
    *CHECKS_OF_THE_SAFETY_GEAR,
    *CHECKS_OF_THE_RAIL,
)

Piece = TypeVar("Piece", AnyEffect, AnySolver, AnyCheck)


def stacker(
    package: str, word: str, title: str, spec: type[Stacker], scenes: frozenset[type[Scene]]
) -> MachineKind[Any]:
    """The manifest of a type: of all effects, solvers and checks those that a scene of this type may call for."""

    def of_its_scenes(pieces: Iterable[Piece]) -> tuple[Piece, ...]:
        return tuple(piece for piece in pieces if piece.scenes & scenes)

    words = {scene.model_fields["type"].default for scene in scenes}
    return MachineKind(
        name="crane",
        type=word,
        title=title,
        spec=spec,
        loads=LOADS,
        effects=of_its_scenes(EFFECTS),
        solvers=of_its_scenes(SOLVERS),
        checks=of_its_scenes(CHECKS),
        figures=tuple(figure for figure in FIGURES if not words.isdisjoint(figure.scenes)),
        starting=template_in(package),
        symbols=symbols_in(__package__),
        assumed=assumptions,
        relations=tuple(relation for relation in relations_of(word) if relation.scenes & scenes),
        parts=parts,
        tables=tables,
        seconding=lambda: of_its_scenes(witnesses_in(__package__)()),
    )
