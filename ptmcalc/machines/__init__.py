"""Floor 5: machine kinds, one folder each, independent of each other.

A kind is a package here that defines `KIND`, or an entry point of the group `ptmcalc.machines`. Kinds are found by
listing and imported only when named.
"""

from collections.abc import Mapping
from types import MappingProxyType

PREFIXES: Mapping[str, str] = MappingProxyType(
    {
        "chain_drive": "CHN",
        "conveyor": "CNV",
        "crane": "CRN",
        "drivetrain": "DRV",
        "hoist": "HST",
        "shaft": "SHF",
    }
)
"""How the codes of a kind's checks begin, so that one is found by its code without importing all. A kind that is not
here is imported where no other has the code."""
