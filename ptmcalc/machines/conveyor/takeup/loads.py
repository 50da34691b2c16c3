"""Loads of the take-up over all scenes."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.machines.conveyor.machine.loads import TAKEUP_CLEARANCES, TAKEUP_TOTAL
from ptmcalc.machines.conveyor.machine.spec import Conveyor

UPPER, LOWER = TAKEUP_CLEARANCES

LOADS = (
    LoadInfo(TAKEUP_TOTAL, "required take-up travel, all shares", units.LENGTH),
    LoadInfo("takeup_travel_elastic", "take-up travel, elastic elongation", units.LENGTH),
    LoadInfo("takeup_travel_thermal", "take-up travel, thermal elongation", units.LENGTH),
    LoadInfo("takeup_travel_permanent", "take-up travel, permanent elongation", units.LENGTH),
    LoadInfo("takeup_travel_installation", "take-up travel, installation and splice", units.LENGTH),
    LoadInfo(UPPER, "take-up weight distance from upper stop, minimum", units.LENGTH),
    LoadInfo(LOWER, "take-up weight distance from lower stop, minimum", units.LENGTH),
)

SHARES = tuple(info.name for info in LOADS[1:5])
"""Shares of the take-up travel that are equal in all scenes."""


def loads_of(spec: Conveyor) -> Iterator[LoadInfo]:
    """Those of them that a conveyor has."""
    if spec.takeup.budgeted:
        yield from (info for info in LOADS if spec.takeup.type == "gravity" or info.name not in TAKEUP_CLEARANCES)
