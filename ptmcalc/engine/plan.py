"""Spec -> plan: which effects each scene calls for, and the ladder of solver runs that can compute it."""

from collections.abc import Sequence
from dataclasses import dataclass

from ptmcalc.contract.effect import AnyEffect, Criterion
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.solver import AnySolver
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.spec.scene import Scene


@dataclass(frozen=True, slots=True)
class PlannedEffect:
    """An effect in a scene: its number, and what the file or the number decided.

    `active` effects belong to the scene; the others may be left out as long as their bound allows. `excluded`
    ones are never computed: forced off, or not computable because an input is missing.
    """

    effect: AnyEffect
    criterion: Criterion | None
    active: bool
    excluded: bool
    forced: bool

    @property
    def must_run(self) -> bool:
        """Whether the file insists on simulating it."""
        return self.forced and not self.excluded


@dataclass(frozen=True, slots=True)
class Rung:
    """One possible run: a solver, the effects it carries, its refinement, and its predicted seconds."""

    solver: AnySolver
    carried: frozenset[str]
    level: int
    seconds: float


@dataclass(frozen=True, slots=True)
class ScenePlan:
    """The plan of one scene: its effects, the rungs from cheap to dear, and the formulas to show beside them."""

    scene: Scene
    effects: tuple[PlannedEffect, ...]
    rungs: tuple[Rung, ...]
    formulas: tuple[AnySolver, ...]

    @property
    def excluded(self) -> frozenset[str]:
        """Names of effects that no run carries and no bar covers."""
        return frozenset(planned.effect.name for planned in self.effects if planned.excluded)


@dataclass(frozen=True, slots=True)
class Plan:
    """What will be computed for one machine."""

    kind: AnyKind
    spec: MachineSpec
    scenes: tuple[ScenePlan, ...]


def plan(kind: AnyKind, spec: MachineSpec, scenes: Sequence[Scene] | None = None) -> Plan:
    """The plan of a machine for all its scenes, or for some of them."""
    return Plan(kind, spec, tuple(plan_scene(kind, spec, scene) for scene in scenes or spec.all_scenes))


def plan_scene(kind: AnyKind, spec: MachineSpec, scene: Scene) -> ScenePlan:
    """The plan of one scene.

    A solver is offered with the active effects it can carry, and with all that it can carry and the file does not
    exclude, at each of its refinements.
    """
    effects = tuple(_planned(effect, spec, scene) for effect in kind.effects if effect.applies_to(scene))
    allowed = frozenset(planned.effect.name for planned in effects if not planned.excluded)
    active = frozenset(planned.effect.name for planned in effects if planned.active)
    rungs: list[Rung] = []
    formulas = []
    for solver in kind.solvers:
        if not solver.usable_for(spec, scene):
            continue
        if not solver.decides:
            formulas.append(solver)
            continue
        for carried in dict.fromkeys((_whole(active & solver.represents, effects), allowed & solver.represents)):
            if carried or not solver.represents:
                rungs += [
                    Rung(solver, carried, level, solver.cost(spec, scene, carried, level))
                    for level in range(solver.levels)
                ]
    rungs.sort(key=lambda rung: rung.seconds)
    return ScenePlan(scene, effects, tuple(rungs), tuple(formulas))


def _whole(carried: frozenset[str], effects: tuple[PlannedEffect, ...]) -> frozenset[str]:
    """The effects with those they are part of: a part cannot be carried without its whole."""
    wholes = {p.effect.part_of for p in effects if p.effect.name in carried and p.effect.part_of}
    return carried | frozenset(p.effect.name for p in effects if p.effect.name in wholes and not p.excluded)


def _planned(effect: AnyEffect, spec: MachineSpec, scene: Scene) -> PlannedEffect:
    criterion = effect.criterion(spec, scene)
    wish = spec.effects.get(effect.name, "auto")
    return PlannedEffect(
        effect=effect,
        criterion=criterion,
        active=wish == "on" or (wish == "auto" and criterion is not None and criterion.exceeded),
        excluded=wish == "off" or criterion is None,
        forced=wish != "auto",
    )
