"""Cost of accuracy: every setting of every solver of a scene with its seconds, error bar and true error."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum

_ROUNDING = 1e-12


class Role(StrEnum):
    """Purpose of a setting."""

    LADDER = "ladder"
    """a check may run it"""
    FORMULA = "formula"
    """a textbook formula: shown for comparison, never decides"""
    REFERENCE = "witness"
    """reference method, used for comparison only; reports keep the word of schema version 1"""


class Outcome(StrEnum):
    """Outcome of a setting."""

    MEASURED = "measured"
    FAILED = "failed"
    NOT_RUN = "not_run"


class Held(StrEnum):
    """Whether a reported error bar covers the true error."""

    YES = "yes"
    NO = "no"
    OPEN = "open"
    """the reference is outside the bar, and its own bar is wider than the distance: undetermined"""


@dataclass(frozen=True, slots=True)
class LoadCost:
    """One governing load of a setting.

    `bar` is relative to the value, as `--accuracy` takes it, `error` and `resolution`, the bar of the reference itself,
    to the reference's value; each to a thousandth of the largest load of that quantity in the scene where the load is
    smaller than that. Without a reference of another method there is no error.
    """

    name: str
    value: float
    bar: float | None
    reference: str = ""
    reference_value: float | None = None
    error: float | None = None
    resolution: float | None = None
    held: Held | None = None

    @property
    def at_most(self) -> float | None:
        """Upper bound of the true error."""
        return None if self.error is None or self.resolution is None else self.error + self.resolution

    @property
    def resolved(self) -> bool:
        """Whether the reference is known more closely than the setting differs from it: else only the most that the
        error can be is known."""
        return self.error is not None and self.resolution is not None and self.resolution <= max(self.error, _ROUNDING)


@dataclass(frozen=True, slots=True)
class Setting:
    """A row: one solver with the effects it carries, at one refinement."""

    scene: str
    solver: str
    method: str
    fidelity: str
    role: Role
    effects: tuple[str, ...]
    level: int
    variant: str
    predicted_seconds: float
    outcome: Outcome
    seconds: float | None = None
    runs: int = 0
    work: int | None = None
    reason: str = ""
    loads: tuple[LoadCost, ...] = ()
    front_of_errors: bool = False
    front_of_bars: bool = False

    @property
    def name(self) -> str:
        """The solver with its refinement, and a mark that distinguishes two sets of effects."""
        return f"{self.solver} {self.level}{self.variant}"

    @property
    def bar(self) -> float | None:
        """The widest error bar of a governing load: infinite if one has no bound, None if there is no load."""
        bars = [math.inf if load.bar is None else load.bar for load in self.loads]
        return max(bars, default=None)

    @property
    def worst(self) -> LoadCost | None:
        """The load with the largest true error, of those with a reference."""
        compared = [load for load in self.loads if load.error is not None]
        return max(compared, key=lambda load: (load.at_most or 0.0, load.error or 0.0), default=None)

    @property
    def error_at_most(self) -> float | None:
        """Upper bound of the true error of all governing loads; None unless each has a reference."""
        bounds = [load.at_most for load in self.loads]
        return None if None in bounds else max((bound for bound in bounds if bound is not None), default=None)

    @property
    def held(self) -> Held | None:
        """Whether all error bars cover the errors: the worst of the loads. A formula without an error bar has no
        result."""
        said = [load.held for load in self.loads if load.held is not None]
        return next((one for one in (Held.NO, Held.OPEN, Held.YES) if one in said), None)

    @property
    def references(self) -> tuple[str, ...]:
        """The settings used as references, that of the worst load first."""
        first = (self.worst.reference,) if self.worst else ()
        return tuple(dict.fromkeys((*first, *(load.reference for load in self.loads if load.reference))))


@dataclass(frozen=True, slots=True)
class Choice:
    """The fastest settings that reach a target: an accuracy of all governing loads, or a verdict of every check."""

    scene: str
    target: str
    accuracy: float | None
    settings: tuple[str, ...]
    seconds: float | None
    missing: tuple[str, ...] = ()
    """loads or checks for which no setting reaches the target"""

    @property
    def reached(self) -> bool:
        """Whether there are such settings."""
        return not self.missing


@dataclass(frozen=True, slots=True)
class CostReport:
    """All settings of one machine, the recommended choice, and a summary sentence."""

    path: str
    kind: str
    settings: tuple[Setting, ...]
    choices: tuple[Choice, ...]
    closest: tuple[str, float] | None
    """code and relative margin of the check that is nearest to its limit"""
    seconds: float = 0.0
    """total measuring time, repetitions included"""

    @property
    def scenes(self) -> tuple[str, ...]:
        """Scenes in the order of the file."""
        return tuple(dict.fromkeys(one.scene for one in self.settings))

    def of_scene(self, scene: str) -> tuple[Setting, ...]:
        """The settings of a scene."""
        return tuple(one for one in self.settings if one.scene == scene)

    def chosen(self, target: str) -> tuple[Choice, ...]:
        """The choices for one target, scene by scene."""
        return tuple(one for one in self.choices if one.target == target)

    @property
    def targets(self) -> tuple[str, ...]:
        """The target."""
        return tuple(dict.fromkeys(one.target for one in self.choices))


def total(parts: Iterable[float | None]) -> float:
    """A sum of seconds; unknown values count as zero."""
    return sum(part for part in parts if part is not None)
