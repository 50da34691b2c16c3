"""What the checks of a stacker crane have in common."""

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import Any

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Check
from ptmcalc.machines.crane.stacking import model
from ptmcalc.machines.crane.stacking.scenes import StackerScene
from ptmcalc.machines.crane.stacking.spec import MECHANISMS, Stacker

Loads = Mapping[str, Estimate]
OneCheck = Check[Stacker, Any]


def only(wanted: Callable[[Any, Any], bool]) -> Callable[[OneCheck], OneCheck]:
    """A check that is made of some machines, and in some scenes, only."""

    def of(check: OneCheck) -> OneCheck:
        def each(spec: Stacker, scene: Any) -> Iterable[OneCheck]:
            return (check,) if wanted(spec, scene) else ()

        return replace(check, each=each)

    return of


def at(*path: str | int) -> Callable[[Stacker, StackerScene], KeyPath]:
    """A key that is the same for every machine."""
    return lambda spec, scene: path


def blames(*path: str | int) -> Callable[[Stacker, StackerScene, Loads], KeyPath]:
    """A key that governs, whatever the loads are."""
    return lambda spec, scene, loads: path


def needs(*path: str | int) -> Callable[[Stacker, StackerScene], tuple[KeyPath, ...]]:
    """A key without which there is nothing to hold the load against."""
    return lambda spec, scene: (path,)


def given(value: float | None) -> Estimate:
    """A limit of the file; none where the file has none, and then the check is not made."""
    return Estimate.exact(math.inf if value is None else value)


def block(spec: Stacker, scene: StackerScene) -> str:
    """Key of the mechanism of a scene."""
    return MECHANISMS[model.mechanism(spec, scene)]


def of_the_mechanism(key: str) -> Callable[[Stacker, StackerScene], KeyPath]:
    """A key of the mechanism of a scene."""
    return lambda spec, scene: (block(spec, scene), key)
