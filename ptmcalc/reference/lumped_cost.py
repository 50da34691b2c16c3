"""Predicted seconds of runs of a train, by its eigenvalues."""

from collections.abc import Sequence

import numpy as np

from ptmcalc.numerics.train.parts import Governed, Train
from ptmcalc.reference.lumped import TOLERANCES
from ptmcalc.reference.mechanism import Mechanism

_A_STEP, _FOLLOWED, _STABLE, _FADES = 6e-4, 1.2, 5.0, 20.0
"""Seconds of a step with what is looked for in it; its largest product with an eigenvalue, as long as that component is
seen, and once it has faded; the time constants in which it fades."""


def seconds(train: Train, end: float, tolerances: Sequence[float]) -> float:
    """Predicted seconds of runs: steps follow every component until it has faded, and stay stable then."""
    steps = 20.0
    for value in eigenvalues(train):
        size, decay = abs(value), max(-value.real, 0.0)
        seen = min(end, _FADES / decay) if decay else end
        steps = max(steps, size * (seen / _FOLLOWED + (end - seen) / _STABLE))
    return 3e-2 + _A_STEP * steps * sum(map(_finer, tolerances))


def _finer(tolerance: float) -> float:
    """Steps over those of the coarsest tolerance, with the eighth root."""
    return float((TOLERANCES[0] / tolerance) ** (1 / 8))


def eigenvalues(train: Train) -> list[complex]:
    """Of the train with every play closed and nothing slipping [1/s]."""
    one = Mechanism(train)
    stiffness, damping = (np.zeros((one.count, one.count)) for _ in range(2))
    for row, spring in zip(one.rows, train.springs, strict=True):
        stiffness += spring.stiffness * np.outer(row, row)
        damping += spring.damping * np.outer(row, row)
    for drive in train.drives:
        row = one.group_row(drive.body, None)
        steep = max((stage.law.stiffness for stage in drive.stages if isinstance(stage.law, Governed)), default=0.0)
        damping += steep * np.outer(row, row)
    inverse = 1 / one.weights[:, None]
    matrix = np.block([[np.zeros_like(damping), np.eye(one.count)], [-inverse * stiffness, -inverse * damping]])
    return [complex(value) for value in np.linalg.eigvals(matrix)]
