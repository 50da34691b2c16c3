"""Exact frequencies and modes of the column of a stacker crane: an even beam with masses and springs at its ends.

A base that drives along or is held, a root that shifts and turns on springs, the beam, the load at any height of it, a
guide at its far end. The beam's own equation is solved exactly, so that no number of elements stands behind a number.
The count of W. H. Wittrick and F. W. Williams tells how many frequencies lie below any other, so none can be missed.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Rows = list[list[float]]

BASE, LOAD = "base", "load"

_SERIES_BELOW = 2.0
_TERMS = 14
"""Of series in (b^4)/(4 k)! for b below 2: the next term is below rounding."""
_INVERSE_FACTORIALS = tuple(
    tuple(1 / math.factorial(4 * n + first) for n in reversed(range(_TERMS))) for first in range(5)
)
"""1/(4 n + first)! of those series, the last term first."""
_HALVINGS = 2200
_LEAST, _MOST = 1e-100, 1e100
"""Frequencies in units of (E J/l^3 over the mass)^(1/2) beyond which none is looked for. A root so soft beside its
column that rounding hides it swings below any: what comes out is as good as none, and the rounding is told with it."""
_ROUNDING = 4 * float(np.finfo(float).eps)
_STUB = 3e-3
"""Share of the column up to which what is beyond the load moves as if it were rigid: there rounding would take as much
of the whole, 12 eps/s^3, as its own bending does, (b s)^4/8 of the third frequency."""
_STEP = 1e-5
"""Relative change of the square of a frequency from which a modal mass is taken."""


@dataclass(frozen=True, slots=True)
class Mast:
    """A column with what it hangs from or stands on, and what it carries.

    length l [m]; flexural_stiffness E J [N*m^2]; column_mass m_c [kg]; base_mass m_1, infinite for one that is held
    [kg]; tip_mass m_2, of the load [kg]; root_mass, apart from the base where the root shifts [kg]; root_rotation, of
    the root per moment [rad/N/m]; root_translation, against the base per force [m/N]; place, of the load from the root
    over l, above 0 [1]; top_mass, at the far end [kg]; guide_stiffness, of what holds the far end to the building
    [N/m].
    """

    length: float
    flexural_stiffness: float
    column_mass: float
    base_mass: float
    tip_mass: float
    root_mass: float = 0.0
    root_rotation: float = 0.0
    root_translation: float = 0.0
    place: float = 1.0
    top_mass: float = 0.0
    guide_stiffness: float = 0.0


def clamped_beam_root(mass_ratio: float, mode: int) -> float:
    """Root of the frequency equation of a clamped beam with a mass at its tip.

        1 + cos(B) cosh(B) + mu B (cos(B) sinh(B) - sin(B) cosh(B)) = 0,   w = B^2 (E J/(m_c l^3))^(1/2)

    Args:
        mass_ratio: mu, tip mass over that of the beam [1].
        mode: k, 1 for the lowest.

    Returns:
        B; 1.8751 for a bare beam [1].

    **Range** mu >= 0.
    **Error** rounding.
    **Source** S. Timoshenko, Vibration problems in engineering; found by the count of Wittrick and Williams.
    """
    unit = Mast(1.0, 1.0, 1.0, math.inf, mass_ratio)
    return math.sqrt(mast_frequency(unit, mode))


def mast_frequency(mast: Mast, mode: int) -> float:
    """Natural frequency of a column with its masses and springs.

        det K(w) = 0

    Frequencies below w are as many as the dynamic stiffness K(w) has negative pivots, and as the parts of the column
    have with their ends held; w is closed in by halving.

    Args:
        mast: what swings.
        mode: k, 1 for the lowest that deforms the column: free travel is none.

    Returns:
        w; infinite where a column without mass has no more [rad/s].

    **Range** an even slender beam, small deflections, no axial force; any masses and springs, none among them.
    **Error** rounding, of the third power of l over `shortest_part`; and 1e-7 of the third frequency, less of a lower
    one, where the load is within 0.3 % of the far end, beyond which nothing bends then.
    **Source** W. H. Wittrick, F. W. Williams, A general algorithm for computing natural frequencies of elastic
    structures, 1971; beam of Euler and Bernoulli.
    """
    wanted = mode + (1 if _travels(mast) else 0)
    if mast.column_mass == 0 and wanted > _moving_masses(mast):
        return math.inf
    heavy = mast.column_mass + mast.tip_mass + mast.root_mass + mast.top_mass
    scale = math.sqrt(_unit_stiffness(mast)) / math.sqrt(heavy)
    low = high = 1.0
    while _count(mast, high * scale) < wanted:
        if high > _MOST:
            return math.inf
        low, high = high, 2 * high
    while low == high or (low > _LEAST and _count(mast, low * scale) >= wanted):
        low, high = low / 2, low
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        if not low < middle < high or high - low <= _ROUNDING * high:
            break
        low, high = (low, middle) if _count(mast, middle * scale) >= wanted else (middle, high)
    return (low + high) / 2 * scale


def mode_compliance(mast: Mast, mode: int, pushed: str) -> float:
    """What one mode has in the deflection of the load against the base, per force that rests.

        X_k = (phi_load - phi_base) phi_pushed/(M_k w_k^2),   M_k = -phi^T dK/d(w^2) phi

    Args:
        mast: what swings.
        mode: k, 1 for the lowest.
        pushed: where the force is: `base`, against which the load lags, or `load`.

    Returns:
        X_k: their sum over all modes is the deflection under the force, evenly accelerated where the base is free
        [m/N].

    **Range** as `mast_frequency`; a base that is held cannot be pushed.
    **Error** 1e-9 of the largest: the modal mass is a difference of two stiffnesses.
    **Source** modal analysis; the modal mass by the derivative of the dynamic stiffness.

    Raises:
        ValueError: for another place of the force.
    """
    if pushed not in (BASE, LOAD):
        raise ValueError(f"a force is at the {BASE} or at the {LOAD}")
    frequency = mast_frequency(mast, mode)
    if math.isinf(frequency):
        return 0.0
    unit, square = _unit_stiffness(mast), frequency * frequency
    shape = _null_vector(np.array(_dynamic_stiffness(mast, frequency)))
    above, below = (np.array(_dynamic_stiffness(mast, math.sqrt(square * (1 + s)))) for s in (_STEP, -_STEP))
    energy = -float(shape @ (above - below) @ shape) / (2 * _STEP) * unit  # M w^2
    base, load = _places(mast)
    at_base = 0.0 if base is None else float(shape[base])
    relative = float(shape[load]) - at_base
    return relative * (float(shape[load]) if pushed == LOAD else -at_base) / energy


# --- dynamic stiffness ------------------------------------------------------------------------------------------


def _travels(mast: Mast) -> bool:
    return math.isfinite(mast.base_mass) and mast.guide_stiffness == 0


def _moving_masses(mast: Mast) -> int:
    """Of a column without mass: as many frequencies there are."""
    base = math.isfinite(mast.base_mass) and mast.base_mass + (0 if mast.root_translation else mast.root_mass) > 0
    root = mast.root_mass > 0 and mast.root_translation > 0
    top = mast.top_mass > 0 and (mast.place < 1 or mast.tip_mass == 0)
    return int(base) + int(root) + int(mast.tip_mass > 0) + int(top)


def _unit_stiffness(mast: Mast) -> float:
    """E J/l^3, in which stiffnesses are counted."""
    return mast.flexural_stiffness / mast.length / mast.length / mast.length


def _series(x: float, first: int) -> float:
    """Sum of x^n/(4 n + first)!."""
    found = 0.0
    for one in _INVERSE_FACTORIALS[first]:
        found = found * x + one
    return found


def _beam(b: float) -> tuple[float, float, float, float, float, float]:
    """Dynamic stiffness of a beam of unit length and stiffness, b^4 = w^2 m l^3/(E J): force at an end per shift and
    turn of it, moment per turn of it, then force and moment there per shift and turn of the other end."""
    if b < _SERIES_BELOW:
        r = b**4
        q = -4 * r
        pole = 4 * _series(q, 4)  # (1 - cos cosh)/b^4
        sine_sum = 2 * _series(q, 1)  # (sin cosh + cos sinh)/b
        sine_gap = 4 * _series(q, 3)  # (sin cosh - cos sinh)/b^3
        product = 2 * _series(q, 2)  # sin sinh/b^2
        far_sum = 2 * _series(r, 1)  # (sinh + sin)/b
        far_gap = 2 * _series(r, 3)  # (sinh - sin)/b^3
        far_cosine = 2 * _series(r, 2)  # (cosh - cos)/b^2
        return (
            sine_sum / pole,
            product / pole,
            sine_gap / pole,
            -far_sum / pole,
            far_cosine / pole,
            far_gap / pole,
        )
    sine, cosine, tangent = math.sin(b), math.cos(b), math.tanh(b)
    small = 1 / math.cosh(b) if b < 700 else 0.0
    pole = small - cosine  # (1 - cos cosh)/cosh
    pole = pole if pole != 0 else small * 1e-16 + 1e-300
    return (
        b**3 * (cosine * tangent + sine) / pole,
        b**2 * sine * tangent / pole,
        b * (sine - cosine * tangent) / pole,
        -(b**3) * (tangent + sine * small) / pole,
        b**2 * (1 - cosine * small) / pole,
        b * (tangent - sine * small) / pole,
    )


def _clamped_count(b: float) -> int:
    """Frequencies of a beam with both ends held that lie below b."""
    if b < 4:  # the first is at 4.73
        return 0
    whole = int(b / math.pi)
    pole = (1 / math.cosh(b) if b < 700 else 0.0) - math.cos(b)
    falls = pole < 0 if whole % 2 == 0 else pole > 0
    return whole - int(falls)


def _stub(mast: Mast) -> float:
    """Share of the column beyond a load close to its end, which moves as if it were rigid: of what bends in it the load
    feels the fourth power of that share, while a beam so short takes its third power of all digits."""
    return 1 - mast.place if 1 - mast.place < _STUB and mast.top_mass == 0 else 0.0


def _parts(mast: Mast) -> tuple[float, ...]:
    return (mast.place, 1 - mast.place) if mast.place < 1 and not _stub(mast) else (mast.place,)


def shortest_part(mast: Mast) -> float:
    """Length of the shorter stretch beside the load, over that of the column: its stiffnesses are as large as the third
    power of its inverse, and so is what rounding leaves of the whole.

    Args:
        mast: what swings.

    Returns:
        The share; that of the load's place where the stretch beyond it is taken to be rigid [1].

    **Range** as `mast_frequency`.
    **Error** rounding.
    **Source** bending of beams.
    """
    return min(_parts(mast))


def _wave_number(mast: Mast, frequency: float) -> float:
    """b of the whole column."""
    return math.sqrt(frequency * math.sqrt(mast.column_mass) / math.sqrt(_unit_stiffness(mast)))


def _places(mast: Mast) -> tuple[int | None, int]:
    """Rows of base and load in the dynamic stiffness."""
    free, shifts, turns = math.isfinite(mast.base_mass), mast.root_translation > 0, mast.root_rotation > 0
    root = int(free) + int(shifts) + int(turns)
    return (0 if free else None), root


def _dynamic_stiffness(mast: Mast, frequency: float) -> Rows:
    """Forces and moments over shifts and turns, in units of E J/l^3 and l; base, root, load, far end."""
    unit, length = _unit_stiffness(mast), mast.length
    square = frequency * frequency / unit
    free, shifts, turns = math.isfinite(mast.base_mass), mast.root_translation > 0, mast.root_rotation > 0
    base = 0 if free else None
    root: int | None = int(free) if shifts else base
    turn: int | None = int(free) + int(shifts) if turns else None
    size = int(free) + int(shifts) + int(turns) + 2 * len(_parts(mast))
    rows = [[0.0] * size for _ in range(size)]

    def add(i: int | None, j: int | None, value: float) -> None:
        if i is not None and j is not None:
            rows[i][j] += value

    add(base, base, -square * mast.base_mass if free else 0.0)
    add(root, root, -square * mast.root_mass)
    if shifts:
        spring = 1 / (mast.root_translation * unit)
        for i, j, sign in ((base, base, 1), (root, root, 1), (base, root, -1), (root, base, -1)):
            add(i, j, sign * spring)
    if turns:
        add(turn, turn, 1 / (mast.root_rotation * unit * length) / length)
    whole = _wave_number(mast, frequency)
    ends: list[tuple[int | None, int | None]] = [(root, turn)]
    first = int(free) + int(shifts) + int(turns)
    ends += [(first + 2 * k, first + 2 * k + 1) for k in range(len(_parts(mast)))]
    for k, part in enumerate(_parts(mast)):
        own, shift_turn, turn_own, far, far_turn, turn_far = _beam(whole * part)
        cube, square_part = part**3, part**2
        (u, a), (v, c) = ends[k], ends[k + 1]
        add(u, u, own / cube)
        add(v, v, own / cube)
        add(a, a, turn_own / part)
        add(c, c, turn_own / part)
        for i, j, value in (
            (u, a, shift_turn / square_part),
            (v, c, -shift_turn / square_part),
            (u, v, far / cube),
            (u, c, far_turn / square_part),
            (v, a, -far_turn / square_part),
            (a, c, turn_far / part),
        ):
            add(i, j, value)
            add(j, i, value)
    (load, lean), top, stub = ends[1], ends[-1][0], _stub(mast)
    add(load, load, -square * mast.tip_mass)
    held, beyond = mast.guide_stiffness / unit, square * mast.column_mass * stub
    held /= 1 + held * stub**3 / 3  # a guide on the end of a stub that bends
    add(top, top, held - beyond - square * mast.top_mass)
    if stub:
        for i, j in ((load, lean), (lean, load)):
            add(i, j, (held - beyond / 2) * stub)
        add(lean, lean, (held - beyond / 3) * stub**2)
    return rows


def _count(mast: Mast, frequency: float) -> int:
    """Frequencies below one, free travel among them."""
    rows = _dynamic_stiffness(mast, frequency)
    whole = _wave_number(mast, frequency)
    below = sum(_clamped_count(whole * part) for part in _parts(mast))
    for k, row in enumerate(rows):
        pivot = row[k]
        below += pivot < 0
        if pivot == 0:
            continue
        for other in rows[k + 1 :]:
            share = other[k] / pivot
            if share:
                for j in range(k + 1, len(row)):
                    other[j] -= share * row[j]
    return below


def _null_vector(matrix: FloatArray) -> FloatArray:
    """Of a symmetric matrix that is singular but for rounding, by its smallest eigenvalue, rows made alike first."""
    scale = 1 / np.sqrt(np.max(np.abs(matrix), axis=1))
    values, vectors = np.linalg.eigh(matrix * scale[:, None] * scale)
    shape = vectors[:, int(np.argmin(np.abs(values)))] * scale
    return np.asarray(shape / np.max(np.abs(shape)))
