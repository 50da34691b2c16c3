"""Loads of two runs of different tolerance, with error bars by their difference."""

import math
from collections.abc import Mapping

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found

_MARGIN = 3.0
_ROUNDING = 1e-9


def compared(coarse: Mapping[str, float], fine: Mapping[str, float]) -> dict[str, Found]:
    """Loads that both of two runs tell, by the finer one, each with three times what it differs by from the coarser."""
    return {name: Found(estimate(coarse[name], value)) for name, value in fine.items() if name in coarse}


def estimate(coarse: float, fine: float, margin: float = _MARGIN) -> Estimate:
    """A load of the finer of two runs, with some times what they differ by, and rounding."""
    if not math.isfinite(fine):
        return Estimate.exact(fine) if coarse == fine else Estimate.unknown(fine)
    if not math.isfinite(coarse):
        return Estimate.unknown(fine)
    return Estimate.within(fine, margin * abs(fine - coarse) + _ROUNDING * abs(fine))
