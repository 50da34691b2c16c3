"""Tensions of a belt along its route, section by section, and the filling of the belt that makes them worst.

The route is walked with the belt: from the run-off of the drive over the return strand, the tail and the carry
strand back to the run-on. A section has one slope, one load and one set of idlers. Its pull is what the tension
gains from its upstream to its downstream end.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.laws.resistance import main_resistance_per_length

FloatArray = NDArray[np.float64]

MOST, LEAST = "most", "least"


def section_pull(
    length: ArrayLike,
    lift: ArrayLike,
    belt_line_mass: ArrayLike,
    load_line_mass: ArrayLike,
    idler_line_mass: ArrayLike,
    coefficient: ArrayLike,
    gravity: float,
) -> FloatArray:
    """What the tension gains over a section: main resistance and lift.

        F = f g (q_R l + (q_B + q_G) l cos(delta)) + g (q_B + q_G) h,   l cos(delta) = sqrt(l^2 - h^2)

    Args:
        length: l, along the belt [m].
        lift: h, height gained in the direction of travel; negative downhill [m].
        belt_line_mass: q_B [kg/m].
        load_line_mass: q_G; 0 on an empty section [kg/m].
        idler_line_mass: q_R, rotating mass of the idlers; they are not lifted [kg/m].
        coefficient: f, fictitious friction coefficient; with the factor C, f C [1].
        gravity: g [m/s^2].

    Returns:
        F; negative where a descent drives [N].

    **Range** steady running at any speed, |h| <= l; a vertical curve is a row of short sections.
    **Error** exact but for f, an empirical mean.
    **Source** ISO 5048:1989 and DIN 22101, main and gradient resistance of a section.

    Raises:
        ValueError: for a section that rises more than it is long.
    """
    l, q = np.asarray(length, float), np.add(belt_line_mass, load_line_mass)  # noqa: E741
    main = main_resistance_per_length(coefficient, gravity, q, idler_line_mass, _cosine(l, lift))  # type: ignore[arg-type]
    return np.asarray(main * l + gravity * q * np.asarray(lift, float))


def load_pull(
    length: ArrayLike, lift: ArrayLike, load_line_mass: ArrayLike, coefficient: ArrayLike, gravity: float
) -> FloatArray:
    """What the load of a section adds to its pull.

        dF = g q_G (f l cos(delta) + h)

    Args:
        length: l, along the belt [m].
        lift: h, height gained in the direction of travel [m].
        load_line_mass: q_G, when the section is full [kg/m].
        coefficient: f [1].
        gravity: g [m/s^2].

    Returns:
        dF; negative where the load drives, on a descent steeper than f [N].

    **Range** as `section_pull`.
    **Error** as `section_pull`.
    **Source** `section_pull` with the load less `section_pull` without it; linear in q_G.

    Raises:
        ValueError: for a section that rises more than it is long.
    """
    l, h = np.asarray(length, float), np.asarray(lift, float)  # noqa: E741
    level = np.asarray(coefficient, float) * (_cosine(l, h) * l)
    return np.asarray(gravity * np.asarray(load_line_mass, float) * (level + h))


def _cosine(length: FloatArray, lift: ArrayLike) -> FloatArray:
    with np.errstate(divide="ignore", invalid="ignore"):
        slope = np.where(length > 0, np.asarray(lift, float) / length, 0.0)
    if np.any(np.abs(lift) > length):
        raise ValueError("a section cannot rise more than it is long")
    return np.asarray(np.sqrt((1 - slope) * (1 + slope)))


def strand_tensions(run_off_tension: float, pulls: FloatArray) -> FloatArray:
    """Tension at the ends of all sections.

        S_0 = S_off,   S_k = S_(k-1) + F_k

    Args:
        run_off_tension: S_off, behind the drive [N].
        pulls: F_k, of the sections in the direction of travel, with forces at single points as sections of their
            own; the driving force of a second drive is negative [N].

    Returns:
        S_0 ... S_n; the last one is the run-on tension [N].

    **Range** steady running; tension changes linearly inside a section, so that its ends are its extremes.
    **Error** exact.
    **Source** equilibrium of each section.
    """
    return np.concatenate(([run_off_tension], run_off_tension + np.cumsum(np.asarray(pulls, float))))


def tension_extremes(tensions: FloatArray) -> tuple[float, float, float, float]:
    """Smallest and largest tension of the route, and where they are.

        low = min S_k,   high = max S_k,   each with its k

    Args:
        tensions: S_0 ... S_n, of `strand_tensions` [N].

    Returns:
        (smallest [N], number of its point [1], largest [N], number of its point [1]); the first point of equal ones.

    **Range** steady running.
    **Error** exact.
    **Source** definition.
    """
    low, high = int(np.argmin(tensions)), int(np.argmax(tensions))
    return float(tensions[low]), float(low), float(tensions[high]), float(high)


def worst_loading(load_pulls: FloatArray, sense: str) -> FloatArray:
    """The filling of the belt with the largest (or smallest) effective tension of all fillings.

        most: x_k = 1 where dF_k > 0, else 0      least: x_k = 1 where dF_k < 0, else 0

    Let x_k in [0, 1] be how full section k is. The pull of the route is F(x) = F_empty + sum x_k dF_k, because every
    resistance and every lift is proportional to the load on it. For any x, F(x) <= F_empty + sum max(dF_k, 0), each
    term by itself, and x_k = [dF_k > 0] attains it. So no filling, in whatever pattern, pulls more, and none of the
    2^n sets of full sections has to be tried. The same holds for the tension at any single point, with the sections
    upstream of it only (`loading_envelope`). For an uneven f the rule goes by the sign of f cos + sin, not by the
    slope alone: a descent flatter than f still belongs to the worst filling of `most`.

    Args:
        load_pulls: dF_k, of `load_pull` [N].
        sense: `most` or `least`.

    Returns:
        x_k, 1 for a full section and 0 for an empty one [1].

    **Range** resistances proportional to the load; C and f as for the full belt.
    **Error** exact; a filling that the loading points cannot make is among those covered, so it bounds all real ones.
    **Source** derived: a linear function on a cube has its extreme at a corner, coordinate by coordinate.

    Raises:
        ValueError: for another sense.
    """
    return np.asarray((_signed(load_pulls, sense) > 0).astype(float))


def worst_stretch(load_pulls: FloatArray, sense: str) -> FloatArray:
    """The worst filling with one unbroken stretch of load.

        x_k = 1 for i <= k <= j, with the largest (smallest) sum of dF_k from i to j

    What a conveyor shows with one loading point while it fills or runs empty. Every j has its best beginning i: where
    the running sum began after it last fell below 0 (a prefix of negative sum only takes away). A hill of one crest
    gives the uphill part alone for `most` and the downhill part alone for `least`.

    Args:
        load_pulls: dF_k, of `load_pull`, in the direction of travel [N].
        sense: `most` or `least`.

    Returns:
        x_k, 1 for a full section and 0 for an empty one; all 0 where load only helps [1].

    **Range** as `worst_loading`; stretches begin and end between sections.
    **Error** exact over stretches of whole sections.
    **Source** J. Kadane's rule for the largest sum of neighbours; J. Bentley, "Programming Pearls" (1984).

    Raises:
        ValueError: for another sense.
    """
    most, stretch = 0.0, slice(0)
    run, begin = 0.0, 0
    signed = _signed(load_pulls, sense)
    for k, pull in enumerate(signed.tolist()):
        if run <= 0:
            run, begin = 0.0, k
        run += pull
        if run > most:
            most, stretch = run, slice(begin, k + 1)
    share = np.zeros(len(signed))
    share[stretch] = 1.0
    return share


def slope_loading(lift: FloatArray, sense: str) -> FloatArray:
    """The filling of all uphill (or all downhill) sections only.

        most: x_k = 1 where h_k > 0      least: x_k = 1 where h_k < 0

    Args:
        lift: h_k, height gained over each section in the direction of travel [m].
        sense: `most` for uphill, `least` for downhill.

    Returns:
        x_k [1].

    **Range** the partial loads a standard asks for; `worst_loading` is at least as bad.
    **Error** exact.
    **Source** DIN 22101, loading conditions of conveyors with ascents and descents.

    Raises:
        ValueError: for another sense.
    """
    return np.asarray((_signed(lift, sense) > 0).astype(float))


def loading_envelope(
    run_off_tension: float, empty_pulls: FloatArray, load_pulls: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Least and most tension at every point over all fillings of the belt.

        S_k = S_off + sum_(j<=k) (F_j + min(dF_j, 0))   ...   S_off + sum_(j<=k) (F_j + max(dF_j, 0))

    Args:
        run_off_tension: S_off, held by the take-up [N].
        empty_pulls: F_k, of the empty sections [N].
        load_pulls: dF_k, of `load_pull`; 0 on the return strand [N].

    Returns:
        (least, most) tension at the points 0 ... n [N].

    **Range** a take-up that holds S_off; steady running.
    **Error** exact at each point; the fillings of two points differ.
    **Source** `worst_loading` applied to the sections upstream of each point.
    """
    empty, more = np.asarray(empty_pulls, float), np.asarray(load_pulls, float)
    least = strand_tensions(run_off_tension, empty + np.minimum(more, 0))
    return least, strand_tensions(run_off_tension, empty + np.maximum(more, 0))


def _signed(values: FloatArray, sense: str) -> FloatArray:
    if sense not in (MOST, LEAST):
        raise ValueError(f"the sense of a loading is {MOST} or {LEAST}")
    return np.asarray(values) * (1.0 if sense == MOST else -1.0)
