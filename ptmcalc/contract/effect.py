"""An effect: a physical influence that a scene may require."""

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
    """Criterion of significance: one dimensionless number with a threshold and a meaning."""

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
    """State of an effect in a scene."""

    SKIPPED = "skipped"
    BOUNDED = "bounded"
    SIMULATED = "simulated"


@dataclass(frozen=True, slots=True)
class Effect(Generic[S, C]):
    """One physical influence.

    `criterion` states whether the scene requires it, or None if a required input is not given. `bound` is the maximum
    change of each load of a run with the results `loads` if the effect is neglected: an offset to the value, nothing
    for a load it does not name. It sees the run's own bars and those of the effects before it. `part_of` names the
    effect it lives inside: a run without that one needs only that one's bound. `calibrated` says that the bound rests
    on a seeded sample, not on a derivation alone.
    """

    name: str
    title: str
    scenes: frozenset[type[Scene]]
    criterion: Callable[[S, C], Criterion | None]
    bound: Callable[[S, C, Mapping[str, Estimate]], Mapping[str, Interval]]
    part_of: str = ""
    calibrated: bool = False

    def applies_to(self, scene: Scene) -> bool:
        """True if a scene of this type can require the effect."""
        return type(scene) in self.scenes


AnyEffect = Effect[Any, Any]
