"""What standards ask of ropes, drums, sheaves and brakes by the group of the mechanism (`classification`).

ISO 4308-1:2003 (ropes). Tables are quoted from secondary sources; those of drums,
sheaves and brakes are to be confirmed against the text of the standard before they are called normative: every one of
them can be set in the file of a machine.
"""

from collections.abc import Mapping
from types import MappingProxyType

Table = Mapping[str, float]


def _by_group(*values: float) -> Table:
    return MappingProxyType({f"M{number}": value for number, value in enumerate(values, 1)})


ROPE_SAFETY = _by_group(3.15, 3.35, 3.55, 4.0, 4.5, 5.6, 7.1, 9.0)
"""Z_p of running ropes on drums of one layer (ISO 4308-1:2003, GOST 33710-2015; confirmed in public sources)."""
ROPE_SAFETY_LAYERS = _by_group(3.55, 3.55, 3.55, 4.0, 4.5, 5.6)
"""Z_p of ropes wound in several layers (ISO 4308-1:2003); not foreseen in the groups M7 and M8."""
DRUM_RATIO = _by_group(11.2, 12.5, 14.0, 16.0, 18.0, 20.0, 22.4, 25.0)
"""h_1, drum over rope diameter, to the middle of the rope (ISO 4308-1:2003; to be confirmed)."""
SHEAVE_RATIO = _by_group(12.5, 14.0, 16.0, 18.0, 20.0, 22.4, 25.0, 28.0)
"""h_2, sheave over rope diameter, to the middle of the rope (ISO 4308-1:2003; to be confirmed)."""
EQUALISER_RATIO = _by_group(11.2, 12.5, 12.5, 14.0, 14.0, 16.0, 16.0, 18.0)
"""h_3, equalising sheave over rope diameter (ISO 4308-1:2003; to be confirmed)."""
BRAKE_RESERVE = _by_group(1.5, 1.5, 1.5, 1.5, 1.75, 2.0, 2.5, 2.5)
"""Brake torque over that of the load: light, medium, heavy and very heavy duty (rules for cranes in the east of Europe,
quoted from handbooks; to be confirmed)."""


def rope_safety_of_group(group: str, layers: int, dangerous: bool = False) -> float:
    """Z_p that a group asks of a running rope.

        Z_p = `ROPE_SAFETY`, for several layers `ROPE_SAFETY_LAYERS`; 1.25 of it, 9 at most, for dangerous loads

    Args:
        group: M1 to M8.
        layers: of rope on the drum.
        dangerous: whether the load is molten metal or as dangerous: M5 at least.

    Returns:
        Z_p [1].

    Raises:
        ValueError: for several layers in the groups M7 and M8, which the standard does not foresee.

    **Range** wire ropes of cranes.
    **Error** none: a table.
    **Source** ISO 4308-1:2003 and GOST 33710-2015; quoted from secondary sources.
    """
    asked = max(group, "M5") if dangerous else group
    table = ROPE_SAFETY if layers == 1 else ROPE_SAFETY_LAYERS
    if asked not in table:
        raise ValueError("ropes of the groups M7 and M8 are not wound in several layers")
    return min(1.25 * table[asked], 9.0) if dangerous else table[asked]
