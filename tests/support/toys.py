"""Toy machines for tests of the engine: the hook of `toy_kind` with solvers and effects that do as they are told.

Every toy bears 10 kN; its solvers say what pull they find, its effects what they may change.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import yaml

from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.contract.effect import AnyEffect, Criterion, Effect
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.report import EffectReport, FileReport, Judgement
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import AnySolver, Fidelity, Solver
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import Loaded, fill
from ptmcalc.engine.plan import PlannedEffect, ScenePlan, plan
from ptmcalc.text.document import parse
from support.toy_kind import KIND, Hang

KN = 1e3
LIMIT = 10 * KN

Pull = Callable[[frozenset[str], int], Estimate | Mapping[str, Estimate]]
Ran = tuple[str, frozenset[str], int]


@dataclass
class Log:
    """Every run that was made: solver, effects carried, level."""

    runs: list[Ran] = field(default_factory=list)

    @property
    def names(self) -> list[str]:
        return [name for name, _, _ in self.runs]


def pull(low: float, high: float | None = None, *, value: float | None = None) -> Estimate:
    """A pull in kN with a numerical bar from `low` to `high`."""
    high = low if high is None else high
    middle = (low + high) / 2 if value is None else value
    return Estimate(middle * KN, low * KN, high * KN, numerical=(high - low) / 2 * KN)


def solver(
    name: str,
    finds: Pull | Estimate,
    *,
    carries: Iterable[str] = (),
    seconds: float | None = None,
    levels: int = 1,
    gives: Iterable[str] = ("pull",),
    log: Log | None = None,
    valid: bool = True,
    **parts: Any,
) -> AnySolver:
    """A solver that finds what it is told; each level costs ten times the one before, each effect a little more."""
    price = 1e-3 if seconds is None else seconds

    def run(spec: Any, scene: Any, carried: frozenset[str], level: int) -> Result:
        if log is not None:
            log.runs.append((name, carried, level))
        found = finds if isinstance(finds, Estimate) else finds(carried, level)
        loads = {"pull": found} if isinstance(found, Estimate) else found
        return Result({load: Found(estimate) for load, estimate in loads.items()}, work=1)

    whole: dict[str, Any] = {
        "fidelity": Fidelity.TRANSIENT,
        "scenes": frozenset({Hang}),
        "cost": lambda spec, scene, carried, level: price * 10**level * (1 + 0.1 * len(carried)),
        "source": "told so",
        "valid": lambda spec, scene: Criterion("x", 0.0 if valid else 1.0, 0.5, "0 inside the range, else 1", "told"),
    }
    return Solver(
        name=name,
        title=f"the solver {name}",
        represents=frozenset(carries),
        gives=frozenset(gives),
        run=run,
        levels=levels,
        **whole | parts,
    )


def effect(
    name: str,
    number: float | None = 1.0,
    bound: Interval = ANYTHING,
    *,
    threshold: float = 0.1,
    part_of: str = "",
    loads: Iterable[str] = ("pull",),
) -> AnyEffect:
    """An effect whose number is far above its threshold unless another is given; None when it lacks an input."""
    criterion = None if number is None else Criterion("x", number, threshold, "a number", "told so")
    return Effect(
        name,
        f"the effect {name}",
        frozenset({Hang}),
        lambda spec, scene: criterion,
        lambda spec, scene, found: dict.fromkeys(loads, bound),
        part_of,
    )


def kind_of(*solvers: AnySolver, effects: Iterable[AnyEffect] = (), **parts: Any) -> AnyKind:
    """The toy kind with other solvers and effects, which assumes nothing unless told to."""
    return replace(KIND, solvers=solvers, effects=tuple(effects), **{"assumptions": ()} | parts)


def loaded(kind: AnyKind, **data: Any) -> Loaded:
    """A toy through parser, spec and assumptions, as the loader does it for a kind that is installed."""
    text = yaml.safe_dump({"kind": "toy", "load": "8 kN", "strength": "10 kN"} | data, sort_keys=False)
    document = parse(text.encode(), "toy.yaml")
    spec, assumed = fill(kind, kind.spec.model_validate(document.data))
    return Loaded(document, kind, spec, assumed)


def report(kind: AnyKind, **data: Any) -> FileReport:
    """The whole report of a toy."""
    return check(loaded(kind, **data), Options(ledger=True))


def judgement(found: FileReport) -> Judgement:
    """The only verdict of a report."""
    ((_, only),) = found.judgements
    return only


def effect_of(found: FileReport, name: str) -> EffectReport:
    """A line of the ledger of the only scene."""
    (scene,) = found.scenes
    return next(one for one in scene.effects if one.name == name)


def scene_plan(kind: AnyKind, **data: Any) -> ScenePlan:
    """The plan of the only scene of a toy."""
    made = loaded(kind, **data)
    assert made.spec is not None
    (scene,) = plan(kind, made.spec).scenes
    return scene


def planned(scene: ScenePlan, name: str) -> PlannedEffect:
    """An effect of a plan."""
    return next(one for one in scene.effects if one.effect.name == name)
