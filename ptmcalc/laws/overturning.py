"""What keeps a machine on its wheels upright, and what tips it."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


def holding_moment(weights: Sequence[float], distances: Sequence[float]) -> float:
    """Moment of weights that holds a machine down on the side of a tipping edge.

        M_h = sum G_i d_i

    Args:
        weights: G_i [N].
        distances: d_i, from the edge inwards; below 0 beyond it [m].

    Returns:
        M_h [N*m].

    **Range** a rigid machine.
    **Error** exact.
    **Source** balance of moments.
    """
    return math.fsum(weight * distance for weight, distance in zip(weights, distances, strict=True))


def tipping_moment(
    root_moment: ArrayLike, root_force: ArrayLike, root_height: ArrayLike, base_force: ArrayLike, base_height: ArrayLike
) -> FloatArray:
    """Moment about the rail of the inertia of a machine: of its column through the root, and of its base.

        M_t = M_0 + F_0 z_0 + F_b z_b

    Args:
        root_moment: M_0, of the column on what holds it [N*m].
        root_force: F_0, of the column on what holds it [N].
        root_height: z_0, of that place above the rail [m].
        base_force: F_b, of inertia of what is below [N].
        base_height: z_b, of its centre of mass above the rail [m].

    Returns:
        M_t [N*m].

    **Range** all of it at the same moment, towards the same side: the most there can be.
    **Error** exact for that model.
    **Source** balance of moments.
    """
    return np.asarray(
        np.asarray(root_moment, float)
        + np.asarray(root_force, float) * root_height
        + np.asarray(base_force, float) * base_height
    )


def stability_reserve(holding: ArrayLike, tipping: ArrayLike) -> FloatArray:
    """What holds over what tips.

        k = M_h/M_t; infinite where nothing tips

    Args:
        holding: M_h [N*m].
        tipping: M_t [N*m].

    Returns:
        k, above 1 for a machine that stands [1].

    **Range** any.
    **Error** a definition.
    **Source** usual in rules for cranes; how much they ask differs.
    """
    held, tips = np.asarray(holding, float), np.asarray(tipping, float)
    # where held is below 0 the machine tips by its own weights
    beyond = np.where(held > 0, np.inf, np.where(held < 0, -np.inf, 0.0))
    return np.asarray(np.where(tips > 0, held / np.where(tips > 0, tips, 1.0), beyond))
