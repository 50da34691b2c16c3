"""Findings about a scene after its runs: contradictions, short windows, missed accuracy, an exceeded budget."""

import math
from collections.abc import Iterator

from ptmcalc.base.units import SHARE, show
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.result import Finding
from ptmcalc.engine.next_run import can_help, wanted_loads
from ptmcalc.engine.plan import Rung
from ptmcalc.engine.settled import Settled, bar_within, inaccurate
from ptmcalc.spec.machine import MachineSpec

_NAMED = 3
"""Loads that a message names; the rest is counted. An engineering choice: the message stays short."""


def contradictions(settled: Settled) -> Iterator[Finding]:
    """Loads that contradict each other, each relation once."""
    for why in dict.fromkeys((settled.broken | settled.disjoint).values()):
        yield Finding("NUM111", f"scene `{settled.plan.scene.label}`: loads contradict each other: {why}")


def open_ends(settled: Settled) -> Iterator[Finding]:
    """Windows that end before the motion is steady, of the runs behind the loads that can still change."""
    open_ones = (best for name, best in settled.loads.items() if name in best.result.beyond and best.result.open_end)
    for end in dict.fromkeys(best.open_end for best in open_ones):
        yield Finding("NUM112", f"scene `{settled.plan.scene.label}`: {end}")


def unreached(kind: AnyKind, spec: MachineSpec, settled: Settled) -> list[Finding]:
    """What to say where nothing is left to run and a governing load is still not as accurate as asked."""
    names = inaccurate(kind, spec, settled)
    if not names or spec.accuracy is None:
        return []
    label = settled.plan.scene.label
    reason = f"nothing that is left to run brings {_closest(spec.accuracy, settled, names)}"
    return [Finding("NUM105", f"scene `{label}`: {reason}", ("accuracy",))]


def _closest(asked: float, settled: Settled, names: list[str]) -> str:
    """Loads that are not as accurate as asked, and how close the one stands that is known least closely."""
    known = [(settled.loads[name].estimate.value, bar_within(settled.loads[name], name)) for name in names]
    wide = max(bar / abs(value) if value else math.inf for value, bar in known)
    how = f"the widest bar is {show(wide, SHARE, 2)}" if math.isfinite(wide) else "one load has no error bound"
    more = f" and {len(names) - _NAMED} more" if len(names) > _NAMED else ""
    return f"{', '.join(f'`{name}`' for name in names[:_NAMED])}{more} to {show(asked, SHARE)}: {how}"


def beyond_budget(
    kind: AnyKind, spec: MachineSpec, settled: Settled, waiting: list[Rung], budget: float, *, whole: bool
) -> Finding:
    """What to say where the next run is beyond the budget: its price, that of all that may help, and what is open."""
    following = settled.next_rung
    assert following is not None
    wanted = wanted_loads(kind, spec, settled, whole=whole)
    helpful = [rung for rung in waiting if any(can_help(settled, spec, rung, name, 0.0) for name in wanted)]
    said = (
        f"scene `{settled.plan.scene.label}`: the next run ({following.solver.name}) is predicted to take"
        f" {following.seconds:.3g} s, beyond the budget of {budget:.3g} s"
    )
    if len(helpful) > 1:
        said += f"; all {len(helpful)} that may help would take {sum(rung.seconds for rung in helpful):.3g} s"
    names = inaccurate(kind, spec, settled)
    if names and spec.accuracy is not None:
        said += f"; it may bring {_closest(spec.accuracy, settled, names)}"
    return Finding("NUM103", said)
