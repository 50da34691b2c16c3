"""Loads of the take-up over all scenes."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.machines.conveyor.loads import TAKEUP_CLEARANCES, TAKEUP_TOTAL
from ptmcalc.machines.conveyor.spec import Conveyor

SHARES = (
    "takeup_travel_elastic",
    "takeup_travel_thermal",
    "takeup_travel_permanent",
    "takeup_travel_installation",
)
"""Shares of the take-up travel that are equal in all scenes."""
UPPER, LOWER = TAKEUP_CLEARANCES

LOADS = (
    LoadInfo(TAKEUP_TOTAL, "required take-up travel, all shares", units.LENGTH),
    LoadInfo(SHARES[0], "take-up travel, elastic elongation", units.LENGTH),
    LoadInfo(SHARES[1], "take-up travel, thermal elongation", units.LENGTH),
    LoadInfo(SHARES[2], "take-up travel, permanent elongation", units.LENGTH),
    LoadInfo(SHARES[3], "take-up travel, installation and splice", units.LENGTH),
    LoadInfo(UPPER, "take-up weight distance from upper stop, minimum", units.LENGTH),
    LoadInfo(LOWER, "take-up weight distance from lower stop, minimum", units.LENGTH),
)


def loads_of(spec: Conveyor) -> Iterator[LoadInfo]:
    """Those of them that a conveyor has."""
    if spec.takeup.budgeted:
        yield from (info for info in LOADS if spec.takeup.type == "gravity" or info.name not in TAKEUP_CLEARANCES)
