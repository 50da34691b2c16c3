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
    """An effect in a scene: its number (None where an input is missing), and what the file wishes: auto, on or off."""

    effect: AnyEffect
    criterion: Criterion | None
    wish: str

    @property
    def active(self) -> bool:
        """Whether it belongs to the scene; the others may be left out as long as their bound allows."""
        return not self.excluded and (self.wish == "on" or (self.criterion is not None and self.criterion.exceeded))

    @property
    def excluded(self) -> bool:
        """Whether it is never computed: forced off, or an input it needs is missing."""
        return self.wish == "off" or self.criterion is None

    @property
    def absent(self) -> bool:
        """Whether there is none of it in the scene, such as the curve of a motor in a stop: its number is exactly 0."""
        return self.criterion is not None and self.criterion.value == 0

    @property
    def forced(self) -> bool:
        """Whether the file decides, not the number."""
        return self.wish != "auto"

    @property
    def forced_off(self) -> bool:
        """Whether the file leaves it out."""
        return self.wish == "off"

    @property
    def must_run(self) -> bool:
        """Whether the file insists on simulating it."""
        return self.forced and not self.excluded


RungKey = tuple[str, frozenset[str], int]
"""Solver, effects and level of a run."""


@dataclass(frozen=True, slots=True)
class Rung:
    """One possible run: a solver, the effects it carries, its refinement, and its predicted seconds."""

    solver: AnySolver
    carried: frozenset[str]
    level: int
    seconds: float

    @property
    def key(self) -> RungKey:
        """Equal for equal runs of a scene."""
        return self.solver.name, self.carried, self.level


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

    @property
    def withheld(self) -> frozenset[str]:
        """Names of excluded effects that are present: no solver that always simulates one of them may run."""
        return frozenset(one.effect.name for one in self.effects if one.excluded and not one.absent)


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
    exclude, at each of its refinements. A part of an effect is excluded with it. A solver that always simulates an
    excluded effect is offered all the same where there is none of it in the scene.
    """
    effects = tuple(
        PlannedEffect(effect, effect.criterion(spec, scene), spec.effects.get(effect.name, "auto"))
        for effect in kind.effects
        if effect.applies_to(scene)
    )
    out = {planned.effect.name for planned in effects if planned.excluded}
    allowed = frozenset(p.effect.name for p in effects if p.effect.name not in out and p.effect.part_of not in out)
    absent = out.intersection(planned.effect.name for planned in effects if planned.absent)
    active = allowed.intersection(planned.effect.name for planned in effects if planned.active)
    rungs: list[Rung] = []
    formulas = []
    for solver in kind.solvers:
        if not (solver.always - absent <= allowed and solver.usable_for(spec, scene)):
            continue
        if not solver.decides:
            formulas.append(solver)
            continue
        needed = _whole(active & solver.represents, effects) | (solver.always - absent)
        for carried in dict.fromkeys((needed, allowed & solver.represents)):
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
    return carried | frozenset(p.effect.name for p in effects if p.effect.name in wholes)
