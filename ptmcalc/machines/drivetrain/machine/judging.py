"""What the checks of a drive train share: scenes and constant limits."""

import math
from collections.abc import Callable

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.check import Check
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain, Run, Start, Stop, TrainScene
from ptmcalc.spec.scene import Scene

ALL: frozenset[type[Scene]] = frozenset({Run, Start, Stop})
RUNNING: frozenset[type[Scene]] = frozenset({Run})
DRIVEN: frozenset[type[Scene]] = frozenset({Run, Start})
AnyCheck = Check[Drivetrain, TrainScene]


def exactly(value: float) -> Callable[[Drivetrain, TrainScene], Estimate]:
    """A limit that is the same in every scene."""
    return lambda spec, scene: Estimate.exact(value)


NO_LIMIT = exactly(math.inf)
