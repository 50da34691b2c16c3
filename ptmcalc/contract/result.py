"""What a solver hands back."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.units import Quantity


@dataclass(frozen=True, slots=True)
class LoadInfo:
    """A load a kind can report: its name in JSON, its title in a table, its quantity."""

    name: str
    title: str
    quantity: Quantity
    headline: bool = True
    """whether the summary table shows it; the JSON always does"""


@dataclass(frozen=True, slots=True)
class Found:
    """A load as a solver found it: the number with its bar, and where and when it occurs."""

    estimate: Estimate
    at: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Finding:
    """Something a solver has to say about its own numbers, or a kind about its input."""

    code: str
    message: str
    path: tuple[str | int, ...] = ()
    hint: str = ""


@dataclass(frozen=True, slots=True)
class Result:
    """Loads of one solver run. `work` counts what the run evaluated; `window` is the time it covers, in s."""

    loads: Mapping[str, Found]
    work: int = 0
    window: tuple[float, float] | None = None
    health: Mapping[str, float] = field(default_factory=dict)
    findings: tuple[Finding, ...] = ()
