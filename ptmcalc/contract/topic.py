"""A topic of a kind of machine: one question of an engineer with its loads, effects, solvers and checks."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import Any, Generic

from ptmcalc.contract.check import AnyCheck
from ptmcalc.contract.effect import AnyEffect, S
from ptmcalc.contract.result import LoadInfo
from ptmcalc.contract.solver import AnySolver


@dataclass(frozen=True, slots=True)
class Topic(Generic[S]):
    """Contents of a topic. A load belongs to the topic that introduces it; other topics may also return it.

    `parts` expands the families among its loads for one machine, in their order.
    """

    loads: tuple[LoadInfo, ...] = ()
    effects: tuple[AnyEffect, ...] = ()
    solvers: tuple[AnySolver, ...] = ()
    """from the fastest to the most complete"""
    checks: tuple[AnyCheck, ...] = ()
    parts: Callable[[S], Iterable[LoadInfo]] | None = None
    symbols: str = ""
    """symbols of its formulas, written as in `symbols.txt`; for a topic of one file"""

    def loads_of(self, spec: S) -> Iterable[LoadInfo]:
        """Its loads of one machine."""
        return self.parts(spec) if self.parts else self.loads


def of_topics(topics: Sequence[Topic[S]]) -> Mapping[str, Any]:
    """The fields of a `MachineKind` that its topics fill, in the order of the topics; checks in that of their codes."""

    def all_of(field: str) -> tuple[Any, ...]:
        return tuple(chain.from_iterable(getattr(topic, field) for topic in topics))

    fields = {field: all_of(field) for field in ("loads", "effects", "solvers")}
    checks = tuple(sorted(all_of("checks"), key=lambda check: check.code))
    return fields | {
        "checks": checks,
        "parts": lambda spec: chain.from_iterable(topic.loads_of(spec) for topic in topics),
    }
