"""Roller chains of ISO 606 by their number."""

import difflib
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

from ptmcalc.catalogue.table import rows

_NAME = re.compile(r"(?:ANSI|ISO|DIN)?\s*(?:NO\.?|#)?\s*(\d+)\s*([AB]?)(?:\s*-\s*(\d+))?", re.IGNORECASE)
_NEAREST = 3
"""Numbers that a message offers for an unknown one [1]. A larger value lengthens the message."""

_USUAL = ("16B-1", "12B-1", "16A-1")
"""Numbers that it offers for a text that resembles none."""


@dataclass(frozen=True, slots=True)
class RollerChain:
    """A short-pitch roller chain of ISO 606, all its rows together, SI.

    `pin_length` is the bearing length of pin and bush of all rows: rows times the width over the inner link.
    """

    number: str
    ansi: str
    rows: int
    pitch: float
    pin_diameter: float
    pin_length: float
    mass: float
    mass_low: float
    mass_high: float
    breaking_load: float
    edition: str

    @property
    def title(self) -> str:
        """Number by ISO 606 and, for the A series, by ASME B29.1."""
        return f"{self.number} (ANSI {self.ansi})" if self.ansi else self.number


def roller_chain(name: str) -> RollerChain | None:
    """The chain of a number such as `16B-1`, `16A-2`, `ANSI 80` or `80-2`; without a suffix a chain of one row.

    Args:
        name: the number, in upper or lower case.

    Returns:
        The chain, or None where the table has none of this number.
    """
    found = _NAME.fullmatch(name.strip())
    if found is None:
        return None
    size, series, strands = found[1], found[2].upper(), found[3] or "1"
    return _chains().get(f"{size}{series}-{strands}")


def nearest(name: str) -> tuple[str, ...]:
    """Numbers of the table that resemble an unknown one most, most similar first."""
    known = tuple(_chains())
    found = _NAME.fullmatch(name.strip())
    if found is None:
        return tuple(difflib.get_close_matches(name.upper(), known, _NEAREST, 0.5)) or _USUAL
    size, series, strands = int(found[1]), found[2].upper(), int(found[3] or 1)
    alike = [one for one in known if _series(one) == series]
    same = [one for one in alike if _rows(one) == strands]
    nearby = sorted(same or alike, key=lambda one: (abs(_size(one) - size), abs(_rows(one) - strands)))
    return tuple(nearby[:_NEAREST])


def _series(number: str) -> str:
    return "".join(letter for letter in number if letter in "AB")


def _size(number: str) -> int:
    return int(re.split(r"\D", number)[0])


def _rows(number: str) -> int:
    return int(number.rpartition("-")[2])


@cache
def _chains() -> Mapping[str, RollerChain]:
    """Every chain by its ISO number and its ANSI number."""
    found = {}
    for row in rows("chains_iso606"):
        chain = _chain(row)
        found[chain.number] = chain
        if chain.ansi:
            found[f"{chain.ansi}-{chain.rows}"] = chain
    return found


def _chain(row: Mapping[str, str]) -> RollerChain:
    count = int(row["strands"])
    return RollerChain(
        number=row["standard"],
        ansi=row["ansi"],
        rows=count,
        pitch=float(row["pitch"]),
        pin_diameter=float(row["pin_diameter"]),
        pin_length=count * float(row["bush_length"]),
        mass=float(row["mass"]),
        mass_low=float(row["mass_low"]),
        mass_high=float(row["mass_high"]),
        breaking_load=float(row["breaking_load"]),
        edition=row["edition"],
    )
