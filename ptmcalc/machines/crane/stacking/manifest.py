"""How both types of stacker crane are put together from what they have in common."""

from collections.abc import Iterable
from typing import Any, TypeVar

from ptmcalc.contract.check import AnyCheck
from ptmcalc.contract.effect import AnyEffect
from ptmcalc.contract.example import symbols_in
from ptmcalc.contract.machine import MachineKind, reference_methods_in, template_in
from ptmcalc.contract.solver import AnySolver
from ptmcalc.contract.topic import of_topics
from ptmcalc.machines.crane.stacking.assumptions import USES, assumptions
from ptmcalc.machines.crane.stacking.collision.topic import COLLISION
from ptmcalc.machines.crane.stacking.figures import FIGURES
from ptmcalc.machines.crane.stacking.fork.topic import FORK
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.mast.topic import MAST
from ptmcalc.machines.crane.stacking.mechanisms.topic import MECHANISMS
from ptmcalc.machines.crane.stacking.rail.topic import RAIL
from ptmcalc.machines.crane.stacking.relations import relations_of
from ptmcalc.machines.crane.stacking.safety_gear.topic import SAFETY_GEAR
from ptmcalc.machines.crane.stacking.strength.combinations import tables
from ptmcalc.machines.crane.stacking.strength.topic import STRENGTH
from ptmcalc.spec.scene import Scene

TOPICS = (MECHANISMS, MAST, COLLISION, FORK, RAIL, SAFETY_GEAR, STRENGTH)

Piece = TypeVar("Piece", AnyEffect, AnySolver, AnyCheck)


def stacker(
    package: str, word: str, title: str, spec: type[Stacker], scenes: frozenset[type[Scene]]
) -> MachineKind[Any]:
    """The manifest of a type: of all effects, solvers and checks those that a scene of this type may call for."""

    def of_its_scenes(pieces: Iterable[Piece]) -> tuple[Piece, ...]:
        return tuple(piece for piece in pieces if piece.scenes & scenes)

    offered = of_topics(TOPICS)
    words = {scene.model_fields["type"].default for scene in scenes}
    return MachineKind(
        name="crane",
        type=word,
        title=title,
        spec=spec,
        loads=offered["loads"],
        effects=of_its_scenes(offered["effects"]),
        solvers=of_its_scenes(offered["solvers"]),
        checks=of_its_scenes(offered["checks"]),
        figures=tuple(figure for figure in FIGURES if not words.isdisjoint(figure.scenes)),
        starting=template_in(package),
        symbols=symbols_in(__package__, TOPICS),
        assumed=assumptions,
        uses=USES,
        relations=tuple(relation for relation in relations_of(word) if relation.scenes & scenes),
        parts=offered["parts"],
        tables=tables,
        seconding=lambda: of_its_scenes(reference_methods_in(__package__)()),
    )
