"""Checks of buffers."""

from collections.abc import Callable

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, Sense, no_needs, only
from ptmcalc.machines.crane.stacking.machine import model
from ptmcalc.machines.crane.stacking.machine.judging import OneCheck, given
from ptmcalc.machines.crane.stacking.machine.scenes import (
    BufferScene,
    StackerScene,
)
from ptmcalc.machines.crane.stacking.machine.spec import MECHANISMS, Stacker
from ptmcalc.spec.scene import Scene

Path = Callable[[Stacker, StackerScene], KeyPath]
HITS: frozenset[type[Scene]] = frozenset({BufferScene})


def _of_buffers(*rest: str) -> Path:
    """A key of the buffers of what travels."""
    return lambda spec, scene: (MECHANISMS[model.mechanism(spec, scene)], "buffers", *rest)


def _stroke_limit(spec: Stacker, scene: StackerScene) -> Estimate:
    """Buffer stroke given in the file.

    **Range** any buffer.
    **Error** none: a limit of the file.
    **Source** the manufacturer of the buffer.
    """
    buffers = model.travel(spec, scene).buffers
    return given(buffers.stroke if buffers is not None else None)


STROKE: OneCheck = Check(
    code="CRN281",
    hazard=True,
    title="stacker buffer stroke",
    question="Do the buffers stop the machine within their stroke?",
    failure="buffer bottoms out",
    scenes=HITS,
    loads=("buffer_stroke",),
    sense=Sense.AT_MOST,
    limit=_stroke_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: _of_buffers("stroke")(spec, scene),
    repair=_of_buffers("stroke"),
    what="The buffers stop the crane with its guided load within their stroke. Otherwise, the report states the"
    " remaining speed.",
    why="The end stop, the mast and persons in the cab absorb the remaining energy within a few millimetres.",
    formula="E(u) = m v^2/2 + P u,   u <= s",
    source="energy; EN 13001-2, FEM 9.311",
)


def _force_limit(spec: Stacker, scene: StackerScene) -> Estimate:
    """Permissible force of a buffer, or of its end stop.

    **Range** any buffer.
    **Error** none: a limit of the file.
    **Source** the manufacturer of the buffer, the calculation of the end stop.
    """
    buffers = model.travel(spec, scene).buffers
    return given(buffers.rating if buffers is not None else None)


FORCE: OneCheck = Check(
    code="CRN282",
    hazard=True,
    title="stacker buffer force",
    question="Is the buffer force within the rating of buffer and end stop?",
    failure="buffer force exceeds its rating",
    scenes=HITS,
    loads=("buffer_force",),
    sense=Sense.AT_MOST,
    limit=_force_limit,
    needs=lambda spec, scene: (_of_buffers("rating")(spec, scene),),
    blame=lambda spec, scene, loads: _of_buffers("rating")(spec, scene),
    repair=_of_buffers("rating"),
    what="The force of each buffer is at most its rating or the rating of the end stop.",
    why="A buffer that is too stiff breaks the parts it protects. It makes the mast oscillate.",
    formula="F = (P + (P^2 + c m v^2)^(1/2))/n <= F_max, by the type of buffer",
    source="energy; EN 13001-2, FEM 9.311",
)


def _largest_speed(spec: Stacker, scene: StackerScene) -> float | None:
    limits = _speed_limits(spec, scene)
    return min(limits.values()) if limits else None


def _speed_limits(spec: Stacker, scene: StackerScene) -> dict[KeyPath, float]:
    """What the file allows, and what the maker of the buffers: neither sets the other aside."""
    buffers = model.travel(spec, scene).buffers
    own: dict[KeyPath, float | None] = {("checks", "collision_speed"): spec.checks.collision_speed}
    own[_of_buffers("largest_speed")(spec, scene)] = buffers.largest_speed if buffers is not None else None
    return {key: speed for key, speed in own.items() if speed is not None}


def _speed_limit(spec: Stacker, scene: StackerScene) -> Estimate:
    """Permissible impact speed of the buffers.

    **Range** any buffer.
    **Error** none: a limit of the file or of the buffer manufacturer.
    **Source** the file.
    """
    return given(_largest_speed(spec, scene))


def _speed_key(spec: Stacker, scene: StackerScene) -> KeyPath:
    limits = _speed_limits(spec, scene)
    return min(limits, key=limits.__getitem__)


SPEED: OneCheck = only(lambda spec, scene: _largest_speed(spec, scene) is not None)(
    Check(
        code="CRN283",
        hazard=True,
        title="stacker buffer impact speed",
        question="Is the impact speed within the limit of buffer and plant rules?",
        failure="buffer impact speed is too high",
        scenes=HITS,
        loads=("collision_speed",),
        sense=Sense.AT_MOST,
        limit=_speed_limit,
        needs=no_needs,
        blame=lambda spec, scene, loads: _speed_key(spec, scene),
        repair=lambda spec, scene: (MECHANISMS[model.mechanism(spec, scene)], "speed"),
        what="The impact speed of the crane is at most the limit of the buffers or of the plant rules.",
        why="The stiffness of rubber and cellular buffers increases with the compression speed. Load and driver are"
        " not restrained.",
        formula="share of v <= v_max",
        source="the manufacturer of the buffer",
    ),
)

CHECKS_OF_BUFFERS: tuple[AnyCheck, ...] = (STROKE, FORCE, SPEED)
