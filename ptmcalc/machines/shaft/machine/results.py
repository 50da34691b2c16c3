"""What a solver of the shaft hands back: bars from two runs, health from the balance of works."""

import math
from collections.abc import Callable, Mapping

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Finding, Found, History, Result
from ptmcalc.machines.shaft.machine.ledger import Ledger

MARGIN = 2.0
"""On the difference of a run to a rougher one."""
FLOOR = 1e-10
"""Rounding of a run, relative."""


def bar(value: float, rough: float) -> Estimate:
    """A value with the difference to that of a rougher run as its bar."""
    if not (math.isfinite(value) and math.isfinite(rough)):
        return Estimate.exact(value)
    return Estimate.within(value, MARGIN * abs(value - rough) + FLOOR * abs(value))


def result_of(
    loads: Mapping[str, Found],
    books: Ledger | None,
    work: int,
    steps: int,
    window: float | None,
    histories: Callable[[], Mapping[str, History]] = dict,
) -> Result:
    """The result with its health; where the balance of works does not close, no bar is left, and a remark says so."""
    findings: tuple[Finding, ...] = ()
    health = {"steps": float(steps)}
    if books is not None:
        health["energy_residual"] = books.residual
        if not books.trusted:
            message = f"the balance of works leaves {books.residual:.2g} of the converted work"
            findings = (Finding("NUM101", message),)
            loads = {name: Found(Estimate.unknown(one.estimate.value), one.at) for name, one in loads.items()}
    covered = (0.0, window) if window is not None else None
    return Result(loads, work, covered, health, findings, histories=histories)
