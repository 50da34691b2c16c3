"""A check: comparison of a load with a limit, and the text of its failure."""

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Any, Generic, TypeVar

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.base.units import Quantity
from ptmcalc.contract.effect import C, S
from ptmcalc.contract.result import of
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.spec.scene import Scene


class Sense(StrEnum):
    """Permissible side of the limit."""

    AT_LEAST = "at_least"
    AT_MOST = "at_most"


@dataclass(frozen=True, slots=True)
class LimitState:
    """Physical limit state of a check, such as belt slip, and the value at which it is reached.

    That value is 1 for a reserve, 0 for a tension, infinite for a time or distance of a motion that never ends.
    """

    text: str
    at: float = math.inf

    def reached(self, value: Estimate, limit: Estimate, sense: Sense) -> bool:
        """True if the whole error bar of the value is at or beyond this state, or an upper limit is 0."""
        if sense is Sense.AT_LEAST:
            return value.high <= self.at
        return value.low >= self.at or limit.high <= 0


@dataclass(frozen=True, slots=True)
class Check(Generic[S, C]):
    """One design check.

    `title` is a noun phrase that names the reported quantity: it is printed after `pass` and `fail`. `question` states
    the check as a question; `failure` states what a failed check means, and `limit_state` its meaning if the physical
    limit itself is reached.

    `loads` are the loads that the check uses, `value` is computed from them (default: the first one), and
    `limit` is compared with it: `ptmcalc.contract.limits` has that of a key and that of a constant. `needs` are the
    optional keys without which it is not checked. `blame` names the key that governs a bad verdict, from the loads
    found; `repair` the key that `solve` may vary, or an empty path; with `repairs_blame` it is the key that `blame`
    names from the loads. A check of every part of a machine gives with `each` the checks of the parts, made by `of`;
    its own `loads` are then families.
    """

    code: str
    title: str
    question: str
    failure: str
    scenes: frozenset[type[Scene]]
    loads: tuple[str, ...]
    sense: Sense
    limit: Callable[[S, C], Estimate]
    needs: Callable[[S, C], tuple[KeyPath, ...]]
    blame: Callable[[S, C, Mapping[str, Estimate]], KeyPath]
    repair: Callable[[S, C], KeyPath]
    what: str
    why: str
    formula: str
    source: str
    limit_state: LimitState | None = None
    value: Callable[[S, C, Mapping[str, Estimate]], Estimate] | None = None
    each: "Callable[[S, C], Iterable[Check[S, C]]] | None" = None
    element: str = ""
    repairs_blame: bool = False
    forbids_band: bool = False
    """True if values of the repair key on both sides of the failing interval pass"""
    quantity: Quantity | None = None
    """quantity of the value; that of the first load when left out"""
    types: frozenset[str] = frozenset()
    """types of the kind that the check applies to; empty for all types with one of its scenes"""
    hazard: bool = False
    """True if a failed check means that a part breaks or tips, a load drops, or the machine slips, goes slack, runs
    back or does not stop in time; reports list it before what heats, wears, sways or takes long"""

    def applies_to(self, scene: Scene) -> bool:
        """True if the check applies to this type of scene."""
        return type(scene) in self.scenes

    def on(self, spec: S, scene: C) -> "Iterable[Check[S, C]]":
        """The checks of a machine: the check itself, or one for each part."""
        return (self,) if self.each is None else self.each(spec, scene)

    def of(
        self,
        element: str,
        limit: Callable[[S, C], Estimate],
        blame: KeyPath,
        needs: tuple[KeyPath, ...] = (),
        repair: KeyPath = (),
    ) -> "Check[S, C]":
        """The check of one part."""
        return replace(
            self,
            element=element,
            loads=tuple(of(family, element) for family in self.loads),
            limit=limit,
            needs=lambda spec, scene: needs,
            blame=lambda spec, scene, loads: blame,
            repair=lambda spec, scene: repair,
            each=None,
        )

    def is_of(self, other: "Check[S, C]") -> bool:
        """True if it is the other check, or the same check of a part of the machine."""
        return self.code == other.code and other.element in ("", self.element)

    def meaning(self, value: Estimate | None, limit: Estimate | None) -> str:
        """Meaning of a failed check, by its value."""
        state = self.limit_state
        if state is not None and value is not None and limit is not None and state.reached(value, limit, self.sense):
            return state.text
        return self.failure

    def read(self, spec: S, scene: C, loads: Mapping[str, Estimate]) -> Estimate:
        """The value that is compared with the limit."""
        return self.value(spec, scene, loads) if self.value else loads[self.loads[0]]


AnyCheck = Check[Any, Any]
K = TypeVar("K", bound=AnyCheck)


def only(wanted: Callable[[Any, Any], bool]) -> Callable[[K], K]:
    """Restrict a check to the machines and scenes for which `wanted(spec, scene)` is true."""

    def of(check: K) -> K:
        def each(spec: Any, scene: Any) -> Iterable[AnyCheck]:
            return (check,) if wanted(spec, scene) else ()

        return replace(check, each=each)

    return of


def at(*path: str | int) -> Callable[[MachineSpec, Scene], KeyPath]:
    """The same key for every machine."""
    return lambda spec, scene: path


def blames(*path: str | int) -> Callable[[MachineSpec, Scene, Mapping[str, Estimate]], KeyPath]:
    """A governing key independent of the loads."""
    return lambda spec, scene, loads: path


def needs(*paths: KeyPath) -> Callable[[MachineSpec, Scene], tuple[KeyPath, ...]]:
    """Keys that the limit requires."""
    return lambda spec, scene: paths


def no_needs(spec: MachineSpec, scene: Scene) -> tuple[KeyPath, ...]:
    """For a check without required keys."""
    return ()


def no_repair(spec: MachineSpec, scene: Scene) -> KeyPath:
    """For a check that no single key can repair."""
    return ()
