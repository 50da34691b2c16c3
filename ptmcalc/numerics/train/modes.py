"""Natural frequencies of a train with every play closed, nothing slipping and no torque over speed."""

import numpy as np

from ptmcalc.numerics.train.parts import RIGID, Train
from ptmcalc.numerics.train.signals import FloatArray
from ptmcalc.numerics.train.tree import Coordinates, Groups


def frequencies(train: Train) -> FloatArray:
    """Natural frequencies [rad/s], rising, without the zeros of what can travel.

        w_k: singular values of M^(-1/2) D^T K^(1/2)

    D maps the groups' travel to the links' extensions. The squares are the eigenvalues of M^-1 D^T K D; taken as
    singular values the lowest keeps its digits beside a link a million million times as stiff. How many are zero is
    counted from the links, not judged from small numbers; a prescribed body counts as fixed.

    **Error** 1e-15 of the highest frequency.
    """
    return damped(train)[0]


def damped(train: Train) -> tuple[FloatArray, FloatArray]:
    """Natural frequencies [rad/s], rising, as `frequencies` gives them, and how fast each fades by its links [1/s].

        d_k = w_k^2/2 sum_l (c_l/k_l) u_lk^2

    u_k is the left singular vector: the share of each link in the elastic energy of the mode.

    **Error** of d: of the order of (d/w)^2, and what modes of one frequency give each other; it serves predictions.
    """
    groups = Groups.among(train)
    inertia = groups.inertias(train)
    fixed = {groups.of[guide.body] for guide in train.guides}
    springs = [spring for spring in train.springs if spring.law != RIGID]
    free = [group for group in range(groups.count) if group not in fixed]
    if not springs or not free:
        return np.empty(0), np.empty(0)
    rows = np.array([groups.link(spring) for spring in springs])[:, free]
    stiffness = np.sqrt([spring.stiffness for spring in springs])
    shares, values, _ = np.linalg.svd(rows / np.sqrt(inertia[free]) * stiffness[:, None], full_matrices=False)
    if fixed:
        travels = len(free) - int(np.linalg.matrix_rank(rows))
    else:
        travels = Coordinates.of(Train(train.bodies, train.meshes, tuple(springs)), groups).travels
    count = min(len(values), len(free) - travels)
    times = np.array([spring.damping for spring in springs]) / stiffness**2
    rising = slice(count - 1, None, -1) if count else slice(0, 0)
    fading = values**2 / 2 * (times @ shares**2)
    return values[rising].copy(), fading[rising].copy()
