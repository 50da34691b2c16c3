"""Why a load that a check reads is not known, or has no bound: the effects and solvers that are to blame, in words."""

import math
from collections.abc import Iterable, Iterator

from ptmcalc.base.estimate import NOTHING
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.result import family
from ptmcalc.contract.solver import AnySolver
from ptmcalc.engine.settled import Best, Settled
from ptmcalc.spec.machine import MachineSpec

_NAMED = 3
"""Reasons that a message names. An engineering choice: the message stays short, and further reasons are omitted."""


def why_open(kind: AnyKind, spec: MachineSpec, settled: Settled, names: Iterable[str]) -> str:
    """What keeps loads from being known: effects left out without a bound, or solvers out of their range.

    Nothing where all of them are bounded.
    """
    said: dict[str, list[str]] = {}
    shared: dict[str, None] = {}
    for name in names:
        known = settled.loads.get(name)
        if known is not None and known.estimate.bounded:
            continue
        reason, *others = (
            _of_nothing(kind, spec, settled, name) if known is None else _of_best(kind, spec, settled, known, name)
        )
        said.setdefault(reason, []).append(name)
        shared |= dict.fromkeys(others)
    return "; ".join([*(f"{_list(names)}: {reason}" for reason, names in said.items()), *shared])


def _of_nothing(kind: AnyKind, spec: MachineSpec, settled: Settled, name: str) -> Iterator[str]:
    """A load that no run has given."""
    givers = [one for one in _deciding(kind, settled) if family(name) in one.gives]
    if not givers:
        yield "no solver computes it in this scene"
        return
    yield "not computed"
    yield from _out_of_range(spec, settled, givers)


def _of_best(kind: AnyKind, spec: MachineSpec, settled: Settled, known: Best, name: str) -> Iterator[str]:
    """A load of a run without a bound."""
    solver, found = known.rung.solver, known.result.loads[name]
    if name in known.result.beyond and known.open_end:
        yield f"can still change: {known.open_end}"
        return
    if not found.estimate.bounded:
        yield f"no error bound in `{solver.name}`" + (f": {found.note}" if found.note else "")
        others = (one for one in _deciding(kind, settled) if family(name) in one.gives)
        yield from _out_of_range(spec, settled, others)
        return
    endless = list(_endless(spec, settled, known, name))
    yield f"no error bound, `{solver.name}` neglects {_list(endless)}"
    yield from _out_of_range(
        spec, settled, [one for one in _deciding(kind, settled) if one.represents.intersection(endless)]
    )


def _endless(spec: MachineSpec, settled: Settled, known: Best, name: str) -> Iterator[str]:
    """Effects that the run behind a load leaves out and that may change it by anything, as `run.widen` adds them."""
    estimates = {one: found.estimate for one, found in known.result.loads.items()}
    for planned in settled.plan.effects:
        effect = planned.effect
        if planned.excluded or effect.name in known.rung.carried:
            continue
        if effect.part_of and effect.part_of not in known.rung.carried:
            continue
        offsets = effect.bound(spec, settled.plan.scene, estimates)
        offset = offsets.get(name, NOTHING)
        if not (math.isfinite(offset.low) and math.isfinite(offset.high)):
            yield effect.name
        estimates = {one: estimate.widened(offsets.get(one, NOTHING)) for one, estimate in estimates.items()}


def _deciding(kind: AnyKind, settled: Settled) -> list[AnySolver]:
    """Solvers that decide on scenes like this one."""
    return [one for one in kind.solvers if one.decides and type(settled.plan.scene) in one.scenes]


def _out_of_range(spec: MachineSpec, settled: Settled, solvers: Iterable[AnySolver]) -> Iterator[str]:
    """What keeps solvers from being used, each reason once; those that were run have findings of their own."""
    said: dict[str, str] = {}
    for solver in solvers:
        off = sorted(solver.always & settled.plan.withheld)
        if off:
            said.setdefault(f"it always simulates {_list(off)}, forced off in the file", solver.name)
            continue
        criterion = solver.valid(spec, settled.plan.scene)
        if criterion is not None and criterion.exceeded:
            said.setdefault(criterion.meaning, solver.name)
    for meaning, name in list(said.items())[:_NAMED]:
        yield f"`{name}` cannot be used: {meaning}"


def _list(names: Iterable[str]) -> str:
    return ", ".join(f"`{name}`" for name in names)
