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
    groups = Groups.among(train)
    inertia = groups.inertias(train)
    fixed = {groups.of[guide.body] for guide in train.guides}
    springs = [spring for spring in train.springs if spring.law != RIGID]
    free = [group for group in range(groups.count) if group not in fixed]
    if not springs or not free:
        return np.empty(0)
    rows = np.array([groups.link(spring) for spring in springs])[:, free]
    stiffness = np.sqrt([spring.stiffness for spring in springs])
    values = np.linalg.svd(rows / np.sqrt(inertia[free]) * stiffness[:, None], compute_uv=False)
    travels = 0 if fixed else Coordinates.of(Train(train.bodies, train.meshes, tuple(springs)), groups).travels
    if fixed:
        travels = len(free) - int(np.linalg.matrix_rank(rows))
    count = min(len(values), len(free) - travels)
    return np.sort(values)[::-1][:count][::-1].copy()
