"""A solver: one method to compute a scene, with the effects that it can simulate together."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, Generic

from ptmcalc.contract.effect import C, Criterion, S
from ptmcalc.contract.result import Result
from ptmcalc.spec.scene import Scene


class Fidelity(StrEnum):
    """How a solver works."""

    FORMULA = "formula"
    MODAL = "modal"
    TRANSIENT = "transient"


def always_valid(spec: object, scene: object) -> None:
    """A solver without a range of its own."""


@dataclass(frozen=True, slots=True)
class Solver(Generic[S, C]):
    """One method to compute a scene.

    `run(spec, scene, carried, level)` simulates the effects `carried` at refinement `level` (0 is the coarsest); `cost`
    predicts its seconds. `valid` gives the criterion that must not be exceeded. `always` names effects that are in
    every run of it, asked for or not: it is not used where one is excluded. A solver that does not decide is a textbook
    formula: shown beside the reported load, never judged. `method` names the code it computes by where several solvers
    share one: they are no references of each other.
    """

    name: str
    title: str
    fidelity: Fidelity
    scenes: frozenset[type[Scene]]
    represents: frozenset[str]
    gives: frozenset[str]
    run: Callable[[S, C, frozenset[str], int], Result]
    cost: Callable[[S, C, frozenset[str], int], float]
    source: str
    valid: Callable[[S, C], Criterion | None] = always_valid
    always: frozenset[str] = frozenset()
    levels: int = 1
    decides: bool = True
    method: str = ""
    by_lanes: bool = False
    """True if it computes many machines at once (`numerics.lanes`)"""

    @property
    def way(self) -> str:
        """The method of the solver; its own name if no other solver shares the method."""
        return self.method or self.name

    def usable_for(self, spec: S, scene: C) -> bool:
        """True if it computes this type of scene and the machine is within its range."""
        if type(scene) not in self.scenes:
            return False
        criterion = self.valid(spec, scene)
        return criterion is None or not criterion.exceeded


AnySolver = Solver[Any, Any]
