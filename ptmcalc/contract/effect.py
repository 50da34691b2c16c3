"""An effect: an ingredient of the physics that a scene may or may not call for."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, Generic, TypeVar

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.spec.scene import Scene

S = TypeVar("S", bound=MachineSpec)
C = TypeVar("C", bound=Scene)


@dataclass(frozen=True, slots=True)
class Criterion:
    """Does something matter here? One dimensionless number against a threshold, in one sentence."""

    symbol: str
    value: float
    threshold: float
    meaning: str
    source: str

    @property
    def exceeded(self) -> bool:
        """Whether the number reaches the threshold."""
        return self.value >= self.threshold

    @property
    def near(self) -> bool:
        """Whether the number is within a factor of 2 of the threshold."""
        return self.threshold / 2 <= self.value <= self.threshold * 2


class EffectState(StrEnum):
    """What became of an effect in a scene."""

    SKIPPED = "skipped"
    BOUNDED = "bounded"
    SIMULATED = "simulated"


@dataclass(frozen=True, slots=True)
class Effect(Generic[S, C]):
    """One ingredient of the physics.

    `criterion` says whether the scene calls for it, or None when an input it needs is not given.
    `bound` is the most that leaving it out can have changed each load of a run that found `loads`: an offset to
    the value, nothing for a load it does not name. It sees the run's own bars and those of the effects before it.
    `part_of` names the effect it lives inside: a run without that one needs only that one's bound.
    `calibrated` says that the bound rests on a seeded sample, not on a derivation alone.
    """

    name: str
    title: str
    scenes: frozenset[type[Scene]]
    criterion: Callable[[S, C], Criterion | None]
    bound: Callable[[S, C, Mapping[str, Estimate]], Mapping[str, Interval]]
    part_of: str = ""
    calibrated: bool = False

    def applies_to(self, scene: Scene) -> bool:
        """Whether a scene of this type can call for the effect at all."""
        return type(scene) in self.scenes


AnyEffect = Effect[Any, Any]
