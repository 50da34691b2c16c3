"""Classes of cranes and mechanisms: how often they work, how hard, and the group both make.

ISO 4301-1:1986 (classes and groups by cycles and hours) and EN 13001-1 (load spectra of its own numbers).
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Numbers = Sequence[float] | FloatArray
"""One number for each part of a spectrum."""

_AT_LIMIT = 1 + 1e-12
"""A class holds its limit, also where arithmetic has moved it by a last digit."""

USE_CYCLES = (16e3, 32e3, 63e3, 125e3, 250e3, 500e3, 1e6, 2e6, 4e6)
"""Most cycles of the classes of use U0 to U8 of ISO 4301-1; U9 has more."""
USE_HOURS = (200.0, 400.0, 800.0, 1600.0, 3200.0, 6300.0, 12500.0, 25000.0, 50000.0)
"""Most hours in motion of the classes of use T0 to T8 of ISO 4301-1; T9 has more."""
SPECTRA = (0.125, 0.25, 0.5, 1.0)
"""Largest spectrum factors of Q1 to Q4 (cranes) and L1 to L4 (mechanisms) of ISO 4301-1."""
SPECTRA_EN_13001 = (0.0313, 0.0625, 0.125, 0.25, 0.5, 1.0)
"""Largest spectrum factors of Q0 to Q5 of EN 13001-1, one more than those of ISO; to be confirmed."""


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
    return sum(cycles > most * _AT_LIMIT for most in USE_CYCLES)


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
    return sum(hours > most * _AT_LIMIT for most in USE_HOURS)


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
    return min(1 + sum(spectrum_factor > most * _AT_LIMIT for most in SPECTRA), 4)


def load_class_en_13001(spectrum_factor: float) -> int:
    """Class of the load spectrum of a crane by EN 13001-1, Q0 to Q5.

        Q = number of limits of `SPECTRA_EN_13001` that k exceeds

    Args:
        spectrum_factor: k, of `spectrum_factor` [1].

    Returns:
        0 to 5 [1].

    **Range** k up to 1; not for `group`, which goes by the classes of ISO 4301-1.
    **Error** none: a class; Q2 to Q5 are Q1 to Q4 of ISO 4301-1.
    **Source** EN 13001-1; quoted from memory, to be confirmed.
    """
    return min(sum(spectrum_factor > most * _AT_LIMIT for most in SPECTRA_EN_13001), 5)


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
