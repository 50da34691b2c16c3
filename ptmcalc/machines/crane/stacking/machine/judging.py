"""What the checks of a stacker crane have in common."""

import math
from collections.abc import Callable, Mapping
from typing import Any

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Check
from ptmcalc.machines.crane.stacking.machine import model
from ptmcalc.machines.crane.stacking.machine.scenes import StackerScene
from ptmcalc.machines.crane.stacking.machine.spec import MECHANISMS, Stacker

Loads = Mapping[str, Estimate]
OneCheck = Check[Stacker, Any]


def given(value: float | None) -> Estimate:
    """A limit of the file; none where the file has none, and then the check is not made."""
    return Estimate.exact(math.inf if value is None else value)


def block(spec: Stacker, scene: StackerScene) -> str:
    """Key of the mechanism of a scene."""
    return MECHANISMS[model.mechanism(spec, scene)]


def of_the_mechanism(key: str) -> Callable[[Stacker, StackerScene], KeyPath]:
    """A key of the mechanism of a scene."""
    return lambda spec, scene: (block(spec, scene), key)
