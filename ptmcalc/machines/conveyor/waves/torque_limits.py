"""Converters that reach their torque limit: the belt no longer follows the profile of the speed."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.span import KeyPath
from ptmcalc.contract.result import Failure
from ptmcalc.machines.conveyor.machine.loads import BRAKING_FORCE
from ptmcalc.machines.conveyor.machine.model import FloatArray, braking_force, starting_force
from ptmcalc.machines.conveyor.machine.motion import Moving
from ptmcalc.machines.conveyor.machine.scenes import ControlledStop, Start
from ptmcalc.machines.conveyor.machine.start_case import start_case
from ptmcalc.machines.conveyor.stopping.controlled import rigid_loads, time_key

_ROUNDING = 1e-9
"""Relative difference of a force from the limit below which both are equal [1], far above the resolution 2e-16 of the
floating point. A larger value reports forces near the limit as at the limit."""


class _Trace(Protocol):
    """A history in equal steps."""

    @property
    def values(self) -> FloatArray: ...

    @property
    def step(self) -> float: ...


def required(case: Moving, force: FloatArray, most: float) -> float:
    """Largest force that a profile of the speed requires of all drives together [N].

        max over t of sum F_i,   of a belt whose converters reach their torque limit at least W + M a_max

    `force` is the sum over time, positive in the sense in which the drives start or brake, `most` its maximum. At the
    limit the belt does not follow the profile, and the force is not that which the profile requires: the rigid belt on
    the profile is a lower estimate of it.
    """
    return max(most, _rigid(case)) if _reached(case, force).any() else most


def _reached(case: Moving, force: FloatArray) -> NDArray[np.bool_]:
    """Where the converters of all drives are at their torque limit."""
    if not case.curves or any(drive.converter is None for drive in case.spec.all_drives.values()):
        return np.zeros(len(force), bool)
    stops = isinstance(case.scene, ControlledStop)
    most = braking_force(case.spec) if stops else starting_force(case.spec)
    return np.asarray(force >= (1 - _ROUNDING) * most)


def _rigid(case: Moving) -> float:
    """Force of the rigid belt that follows the profile [N]."""
    if isinstance(case.scene, ControlledStop):
        return rigid_loads(case.spec, case.scene)[BRAKING_FORCE]
    assert isinstance(case.scene, Start)
    return case.line.static_resistance + case.line.tail_pull + start_case(case.spec, case.scene).excess


def failures(case: Moving, grids: Sequence[Mapping[str, _Trace]]) -> Iterator[Failure]:
    """A start or a controlled stop in which the converters of all drives are at their torque limit on every grid.

        sum F_i(t) = sum F_i,max

    The forces do not exceed the limit, whatever the profile requires. In an aborted start it may be the restart
    against a belt that still moves. `grids` are histories by the name of the load.

    **Range** converters with a torque limit on all drives.
    **Error** that of the forces; the relative tolerance is 1e-9.
    **Source** definition of the limit.
    """
    scene, name = case.scene, BRAKING_FORCE if isinstance(case.scene, ControlledStop) else "starting_force_needed"
    traces = [grid[name] for grid in grids if name in grid]
    at_limit = [_reached(case, trace.values) for trace in traces]
    if not at_limit or not all(where.any() for where in at_limit):
        return
    time = float(at_limit[-1].argmax()) * traces[-1].step
    if isinstance(scene, ControlledStop):
        code, path = "CNV125", time_key(case.spec, scene)
    else:
        code, path = "CNV104", _profile_key(case)
    reason = f"the converters reach their torque limit at {time:.3g} s: the belt does not follow the profile"
    yield Failure(code, reason, path, "a longer time of the profile, larger motors or a larger `torque_limit` pass")


def _profile_key(case: Moving) -> KeyPath:
    """Where the time of the profile of a start stands in the file."""
    scene = case.scene
    assert isinstance(scene, Start)
    return ("scenes", list(case.spec.all_scenes).index(scene), "profile", scene.profile.time_key)
