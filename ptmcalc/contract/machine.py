"""The manifest of a machine kind: the interface of a kind to the rest of the program."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any, Generic, TypeVar

from ptmcalc.base.estimate import Interval
from ptmcalc.base.memory import kept_for
from ptmcalc.base.span import KeyPath
from ptmcalc.base.units import Quantity
from ptmcalc.contract.check import AnyCheck
from ptmcalc.contract.effect import AnyEffect, S
from ptmcalc.contract.example import Example, Symbols, no_examples, no_symbols
from ptmcalc.contract.figure import Figure
from ptmcalc.contract.relation import Relation
from ptmcalc.contract.report import SceneReport, TableReport
from ptmcalc.contract.result import Finding, LoadInfo
from ptmcalc.contract.solver import AnySolver
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.spec.scene import Scene

Piece = TypeVar("Piece")


@dataclass(frozen=True, slots=True)
class Use:
    """Where an assumed value is used: its ends are tried only there."""

    scenes: frozenset[type[Scene]] = frozenset()
    """types of the scenes; empty for all"""
    loads: frozenset[str] = frozenset()
    """families of the loads; empty for all"""
    limits_only: bool = False
    """only the limits of checks of those loads depend on it, no load does"""


EVERYWHERE = Use()


@dataclass(frozen=True, slots=True)
class Assumption(Generic[S]):
    """A value that is filled in if the file does not give it, with the interval that contains the actual value.

    `value` is None if the machine does not require it. Verdicts are evaluated at both ends of `interval`.
    """

    path: KeyPath
    quantity: Quantity
    value: Callable[[S], float | None]
    interval: Callable[[S], Interval]
    source: str
    use: Use = EVERYWHERE


def nothing_to_say(spec: MachineSpec) -> Iterable[Finding]:
    """For a kind without comparisons between values of the file."""
    return ()


def no_reference_methods() -> tuple[AnySolver, ...]:
    """For a kind without reference methods."""
    return ()


@dataclass(frozen=True, slots=True)
class MachineKind(Generic[S]):
    """A kind of machine: its spec, its loads, and the effects, solvers and checks that work on it.

    `starting` reads a commented design file that passes `check`. `inspect` notes values that disagree. What no check
    needs is read when somebody asks for it, `starting`, `seconding`, `symbols` and `examples`: a process
    that checks a file imports none of it.
    """

    name: str
    title: str
    spec: type[S]
    loads: tuple[LoadInfo, ...]
    effects: tuple[AnyEffect, ...]
    solvers: tuple[AnySolver, ...]
    checks: tuple[AnyCheck, ...]
    starting: Callable[[], str]
    assumptions: tuple[Assumption[S], ...] = ()
    relations: tuple[Relation, ...] = ()
    """relations between the loads of a scene; every report is verified against them"""

    inspect: Callable[[S], Iterable[Finding]] = nothing_to_say
    tables: Callable[[S, Sequence[SceneReport]], Iterable[TableReport]] | None = None
    """for a kind with tables of its own: their contents for the scenes of a machine"""

    figures: tuple[Figure, ...] = ()
    """figures of the scenes"""

    parts: Callable[[S], Iterable[LoadInfo]] | None = None
    """for a kind whose loads are families: the loads of the parts of a machine, in the order of `loads`"""

    assumed: Callable[[S], Iterable[Assumption[S]]] | None = None
    """for a kind with parts that a machine has several times: the assumptions of one machine, instead of the list"""

    uses: Mapping[str, Use] = field(default_factory=dict, hash=False)
    """by key, as `base.column`: where the constant that its declaration assumes is used; everywhere if not named"""

    levers: tuple[str, ...] = ()
    """keys that `improve` may change beside those that the checks name as repair, as `drive.drum.wrap`; one as
    `scenes[*].profile.time` has one value in all scenes that write it"""

    seconding: Callable[[], tuple[AnySolver, ...]] = no_reference_methods
    """reads solvers of another method that no plan offers: `cost` holds what the planned ones find against theirs"""

    type: str = ""
    """for the manifest of one of several types of a kind: the word its files write behind `type`"""

    types: "tuple[MachineKind[Any], ...]" = ()
    """for a kind with several types: their manifests, of which a file's `type` chooses one"""

    symbols: Callable[[], Symbols] = no_symbols
    """reads what the letters of its formulas mean"""

    examples: Callable[[], Mapping[str, Example]] = no_examples
    """reads an example of each of its checks, effects, solvers and loads, by name"""

    @property
    def manifests(self) -> "tuple[MachineKind[Any], ...]":
        """What describes one machine each: the types of the kind, or the kind itself."""
        return self.types or (self,)

    @property
    def template(self) -> str:
        """The commented template of a design file."""
        return self.starting()

    @property
    def reference_methods(self) -> tuple[AnySolver, ...]:
        """Reference methods, which no plan contains."""
        return self.seconding()

    @property
    def label(self) -> str:
        """The kind in words, with its type."""
        return f"{self.name} {self.type}".strip()

    def assumptions_of(self, spec: S) -> Iterable[Assumption[S]]:
        """The possible assumptions of a machine."""
        return self.assumed(spec) if self.assumed else self.assumptions

    def loads_of(self, spec: S) -> tuple[LoadInfo, ...]:
        """The loads of a machine."""
        return _loads(self.parts, spec) if self.parts else self.loads

    def tables_of(self, spec: S, scenes: Sequence[SceneReport]) -> tuple[TableReport, ...]:
        """The tables that a kind adds to the report of a machine."""
        return tuple(self.tables(spec, scenes)) if self.tables else ()

    def quantity_of(self, spec: S, check: AnyCheck) -> Quantity:
        """The quantity of the value of a check."""
        return check.quantity or self.load_info(spec, check.loads[0]).quantity

    def load_info(self, spec: S, name: str) -> LoadInfo:
        """What is known of a load of a machine, or of a family, as a check that is switched off names it."""
        known = (info for infos in (self.loads_of(spec), self.loads) for info in infos if info.name == name)
        return next(known)


@kept_for(64)
def _loads(parts: Callable[[S], Iterable[LoadInfo]], spec: S) -> tuple[LoadInfo, ...]:
    return tuple(parts(spec))


AnyKind = MachineKind[Any]


def template_in(package: str) -> Callable[[], str]:
    """The `template.yaml` in the folder of a kind, read when somebody asks for it: no check of a file does."""

    def read() -> str:
        from importlib import resources

        return resources.files(package).joinpath("template.yaml").read_text("utf-8")

    return read


def reference_methods_in(package: str) -> Callable[[], tuple[AnySolver, ...]]:
    """The `REFERENCE_METHODS` in the module `reference` of a kind, read when `cost` asks."""
    return lambda: import_module(f"{package}.reference").REFERENCE_METHODS


def of_types(
    name: str, title: str, *types: AnyKind, examples: Callable[[], Mapping[str, Example]] = no_examples
) -> AnyKind:
    """A kind whose files choose one of several types of machine, each with a manifest of its own.

    What the types have in common by name is one load; effects, solvers and checks are those of all types.
    """
    loads = {load.name: load for one in reversed(types) for load in reversed(one.loads)}
    return MachineKind(
        name=name,
        title=title,
        spec=MachineSpec,
        loads=tuple(reversed(loads.values())),
        effects=_once(effect for one in types for effect in one.effects),
        solvers=_once(solver for one in types for solver in one.solvers),
        checks=_once(check for one in types for check in one.checks),
        starting=types[0].starting,
        figures=_once(figure for one in types for figure in one.figures),
        types=types,
        examples=examples,
    )


def _once(pieces: "Iterable[Piece]") -> "tuple[Piece, ...]":
    """Pieces in their order, what two types have in common once."""
    return tuple({id(piece): piece for piece in pieces}.values())
