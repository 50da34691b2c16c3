"""Loads with and without an effect whose criterion is near its threshold."""

from collections.abc import Mapping

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Result
from ptmcalc.engine.settled import Settled
from ptmcalc.spec.machine import MachineSpec


def without(
    settled: Settled, spec: MachineSpec, name: str
) -> tuple[Mapping[str, Estimate], Mapping[str, Estimate]] | None:
    """The loads of a run of all that was carried, and of the same again with one effect and its parts left out, or None
    when that cannot be made.

    It is the coarsest of those runs: its errors are much the same with the effect and without it, and finer runs are
    made for verdicts. A solver that cannot leave the effect out gives way to the best run that did without it.
    """
    gone = {p.effect.name for p in settled.plan.effects if name in (p.effect.name, p.effect.part_of)}
    richest = max(settled.runs, key=lambda run: (len(run.rung.carried), run.rung.level))
    solver, carried = richest.rung.solver, richest.rung.carried
    if name not in carried:
        return None
    if gone & solver.always:
        spared = [run for run in settled.runs if not gone & run.rung.carried]
        return (richest.estimates, _loads_of(spared[-1].result)) if spared else None
    alike = (run for run in settled.runs if run.rung.solver is solver and run.rung.carried == carried)
    coarsest = min(alike, key=lambda run: run.rung.level)
    try:
        result = solver.run(spec, settled.plan.scene, carried - gone, coarsest.rung.level)
    except (NumericsError, MemoryError):
        return None
    return coarsest.estimates, _loads_of(result)


def _loads_of(result: Result) -> dict[str, Estimate]:
    return {load: found.estimate for load, found in result.loads.items()}
