"""Reeving of a hoist: losses of its sheaves, pulls of its falls, length and speed of its rope.

A tackle of m falls: the rope comes from the drum as the first fall, turns at m - 1 sheaves, and is held at its end.
Every sheave costs a share of the pull; hauled, the drum feels the largest pull, lowered the smallest.
"""

import math

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def tackle_efficiency(falls: int, sheave_efficiency: float) -> float:
    """Efficiency of a tackle whose drum hauls: mean pull of the falls over the pull at the drum.

        eta_r = (1 - eta^m)/(m (1 - eta))

    Args:
        falls: m, parts of one rope that carry the load.
        sheave_efficiency: eta, of a sheave [1].

    Returns:
        eta_r [1].

    **Range** one rope, as many sheaves as falls but one; equal sheaves; a rope without weight.
    **Error** exact for that model; sheaves: 0.98 to 0.985 on rolling bearings, 0.95 to 0.97 on plain ones.
    **Source** W = S (1 + eta + ... + eta^(m - 1)); usual in handbooks of hoists, ISO 4308-1:2003.
    """
    return math.fsum(sheave_efficiency**k for k in range(falls)) / falls


def lowering_tackle_efficiency(falls: int, sheave_efficiency: float) -> float:
    """Efficiency of a tackle that lowers: pull at the drum over the mean pull of the falls.

        eta_l = m (1/eta - 1)/(eta^-m - 1)

    Args:
        falls: m, parts of one rope that carry the load.
        sheave_efficiency: eta, of a sheave [1].

    Returns:
        eta_l, a little below `tackle_efficiency`: 0.05 % at 4 falls of 0.98, 1.1 % at 12 falls of 0.97 [1].

    **Range** as `tackle_efficiency`.
    **Error** exact for that model.
    **Source** W = S (1 + 1/eta + ... + 1/eta^(m - 1)).
    """
    return falls / math.fsum(sheave_efficiency**-k for k in range(falls))


def fall_pulls(load: float, falls: int, sheave_efficiency: float, fall_weight: float, hauling: bool) -> FloatArray:
    """Pulls at the upper ends of the falls of one rope, that of the drum first.

        L_(k+1) = L_k eta at a lower sheave, U_(k+1) = U_k eta at an upper one, U = L + w, sum L = W

    with 1/eta for eta while the load is lowered. The rope comes down from the drum: the first sheave is a lower one.

    Args:
        load: W, that the falls of this rope carry at their lower ends [N].
        falls: m, parts of one rope that carry the load.
        sheave_efficiency: eta, of a sheave [1].
        fall_weight: w, of a fall of rope [N].
        hauling: whether the drum hauls.

    Returns:
        U, shape (falls,); below w where a fall would have to push at its lower end: the load is too light to keep the
        rope taut [N].

    **Range** vertical falls of equal length; a rope that moves evenly.
    **Error** exact for that model; the sheaves' own inertia and the rope's bending are in eta.
    **Source** derived: balance at every sheave. Without weight U_1 = W/(m eta_r) of `tackle_efficiency`.
    """
    loss = sheave_efficiency if hauling else 1 / sheave_efficiency
    share, offset = np.empty(falls), np.empty(falls)  # L_k = share L_1 + offset w
    share[0], offset[0] = 1.0, 0.0
    for k in range(1, falls):
        share[k] = share[k - 1] * loss
        offset[k] = offset[k - 1] * loss if k % 2 else (offset[k - 1] + 1) * loss - 1
    first = (load - float(offset.sum()) * fall_weight) / float(share.sum())
    return np.asarray(share * first + (offset + 1) * fall_weight)


def rope_speed(hook_speed: float, falls: int, ropes: int) -> float:
    """Speed of the rope at the drum.

        v_r = v m/n

    Args:
        hook_speed: v [m/s].
        falls: m, parts of rope the load hangs on.
        ropes: n, parts of rope that run onto the drum.

    Returns:
        v_r [m/s].

    **Range** vertical falls.
    **Error** exact.
    **Source** length of the rope.
    """
    return hook_speed * (falls / ropes)


def rope_between_drum_and_end(fall_length: float, falls: int, ropes: int, lead_length: float) -> float:
    """Length of one rope between the drum and its fixed end or the equalising sheave.

        l = m H/n + l_0

    Args:
        fall_length: H, of a fall [m].
        falls: m, parts of rope the load hangs on.
        ropes: n, parts of rope that run onto the drum.
        lead_length: l_0, between drum and tackle [m].

    Returns:
        l [m].

    **Range** vertical falls of equal length; the rope that lies on sheaves is left out.
    **Error** half a turn of each sheave.
    **Source** geometry.
    """
    return fall_length * (falls / ropes) + lead_length
