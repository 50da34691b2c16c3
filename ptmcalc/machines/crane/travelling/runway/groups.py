"""Groups of loads of EN 1991-3:2006, table 2.2, as data."""

from dataclasses import dataclass

EDITION = "EN 1991-3:2006"
ONE, REMAINING, DYNAMIC_TEST, STATIC_TEST = "1", "eta", "phi6 of the dynamic test", "1 of the static test"
"""Factors of a group other than the phi of that name."""


@dataclass(frozen=True, slots=True)
class Group:
    """One group of loads: its factors, by name, on crane and hoist load, and the other actions that it contains."""

    name: str
    crane: str
    hoist: str | None
    """without a hoist load: None"""
    drives: str = ""
    """with drive forces: the factor on the hoist load in the load shares of H_T"""
    skewing: bool = False
    trolley: bool = False
    wind: str = ""
    """`in service`, `out of service`, or none"""
    buffers: bool = False
    tilting: bool = False


IN_SERVICE, OUT_OF_SERVICE = "in service", "out of service"
GROUPS = (
    Group("1", "phi1", "phi2", drives="phi2", wind=IN_SERVICE),
    Group("2", "phi1", "phi3", drives="phi2", wind=IN_SERVICE),
    Group("3", ONE, None, drives=ONE, wind=IN_SERVICE),
    Group("4", "phi4", "phi4", drives="phi4", wind=IN_SERVICE),
    Group("5", "phi4", "phi4", skewing=True, wind=IN_SERVICE),
    Group("6", "phi4", "phi4", trolley=True),
    Group("7", ONE, REMAINING, wind=OUT_OF_SERVICE),
    Group("8 dynamic", "phi1", DYNAMIC_TEST, drives=DYNAMIC_TEST, wind=IN_SERVICE),
    Group("8 static", "phi1", STATIC_TEST),
    Group("9", ONE, ONE, buffers=True),
    Group("10", ONE, ONE, tilting=True),
)
"""Columns 1 to 10 of the table. Columns 1 to 5 agree with an open program (github.com/pmav99/crane_loads), 6 to 10 are
quoted from memory: `TO_COMPARE`. Group 8 has two rows, since the static test has no drive forces. Load shares of H_T
are those of a hanging load, as in that program: of group 1 in group 2, of the loaded crane in group 3."""
NAMES = tuple(group.name for group in GROUPS)
TO_COMPARE = frozenset({"6", "7", "8 dynamic", "8 static", "9", "10"})
"""Groups whose factors are to be compared with the standard."""
LIGHT, LOADED = "light rail", "loaded rail"
"""Rails of the front guide: the one with the smaller sum of wheel loads, and the other one."""
PAIRS = tuple(f"{rail}, {number}" for rail in (LIGHT, LOADED) for number in (1, 2))
FRONT = tuple(f"{rail}, 1" for rail in (LIGHT, LOADED))
