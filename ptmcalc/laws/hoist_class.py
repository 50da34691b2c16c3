"""Classes of hoists: groups by use and load, and what standards ask of ropes, drums and brakes by group.

ISO 4301-1:1986 and :2016 (groups), ISO 4308-1:2003 (ropes). Tables are quoted from secondary sources; those of drums,
sheaves and brakes are to be confirmed against the text of the standard before they are called normative: every one of
them can be set in the file of a machine.
"""

from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Numbers = Sequence[float] | FloatArray
"""One number for each part of a spectrum."""

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

USE_CYCLES = (16e3, 32e3, 63e3, 125e3, 250e3, 500e3, 1e6, 2e6, 4e6)
"""Most cycles of the classes of use U0 to U8 of ISO 4301-1; U9 has more."""
USE_HOURS = (200.0, 400.0, 800.0, 1600.0, 3200.0, 6300.0, 12500.0, 25000.0, 50000.0)
"""Most hours in motion of the classes of use T0 to T8 of ISO 4301-1; T9 has more."""
SPECTRA = (0.125, 0.25, 0.5, 1.0)
"""Largest spectrum factors of Q1 to Q4 (cranes) and L1 to L4 (mechanisms) of ISO 4301-1."""


def spectrum_factor(shares: Numbers, loads: Numbers, exponent: float = 3.0) -> float:
    """Spectrum factor of the loads of a life.

        k = sum (C_i/C_T) (P_i/P_max)^m

    Args:
        shares: C_i/C_T, of all cycles (k_p, cranes) or of the time in motion (k_m, mechanisms), shape (n,) [1].
        loads: P_i/P_max, over the rated load, shape (n,) [1].
        exponent: m; 3 by the standard, for other slopes of fatigue theirs [1].

    Returns:
        k [1].

    **Range** shares that add up to 1.
    **Error** exact.
    **Source** ISO 4301-1:1986.
    """
    scale = np.asarray(shares, float)
    return float(np.sum(scale * np.asarray(loads, float) ** exponent))


def equivalent_load(spectrum_factor: float, exponent: float = 3.0) -> float:
    """Load that, always there, would tire as much as the spectrum.

        P/P_max = k^(1/m)

    Args:
        spectrum_factor: k, of `spectrum_factor` [1].
        exponent: m [1].

    Returns:
        P over the rated load [1].

    **Range** one slope of fatigue.
    **Error** exact.
    **Source** Palmgren 1924, Miner 1945: damages add up.
    """
    return float(spectrum_factor ** (1 / exponent))


def use_of_cycles(cycles: float) -> int:
    """Class of use of a crane, U0 to U9.

        U = number of limits of `USE_CYCLES` that the cycles exceed

    Args:
        cycles: hoisting cycles of the life [1].

    Returns:
        0 to 9 [1].

    **Range** any.
    **Error** none: a class.
    **Source** ISO 4301-1:1986.
    """
    return sum(cycles > most for most in USE_CYCLES)


def use_of_hours(hours: float) -> int:
    """Class of use of a mechanism, T0 to T9.

        T = number of limits of `USE_HOURS` that the hours exceed

    Args:
        hours: in motion over the life, in hours [1].

    Returns:
        0 to 9 [1].

    **Range** any.
    **Error** none: a class.
    **Source** ISO 4301-1:1986.
    """
    return sum(hours > most for most in USE_HOURS)


def load_class(spectrum_factor: float) -> int:
    """Class of the load spectrum, Q1 to Q4 or L1 to L4.

        Q = 1 + number of limits of `SPECTRA` that k exceeds

    Args:
        spectrum_factor: k, of `spectrum_factor` [1].

    Returns:
        1 to 4 [1].

    **Range** k up to 1.
    **Error** none: a class.
    **Source** ISO 4301-1:1986.
    """
    return min(1 + sum(spectrum_factor > most * (1 + 1e-12) for most in SPECTRA), 4)


def group(use: int, load_class: int) -> int:
    """Group of a crane (A) or a mechanism (M).

        A = U + Q - 2, M = T + L - 2, from 1 to 8

    Args:
        use: U or T, 0 to 9.
        load_class: Q or L, 1 to 4.

    Returns:
        1 to 8 [1].

    **Range** as the standard's table: diagonals of equal group.
    **Error** none: a class; beyond both ends the nearest group.
    **Source** ISO 4301-1:1986.
    """
    return min(max(use + load_class - 2, 1), 8)


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
