"""Checks of buffers."""

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, Sense, at, blames, needs, no_needs, only
from ptmcalc.contract.limits import key
from ptmcalc.machines.crane.travelling.machine.judging import HITS, OneCheck, rating
from ptmcalc.machines.crane.travelling.machine.scenes import TravelScene
from ptmcalc.machines.crane.travelling.machine.spec import Travelling

STROKE: OneCheck = Check(
    code="CRN170",
    hazard=True,
    title="buffer stroke",
    question="Do the buffers stop the crane within their stroke?",
    failure="buffer bottoms out",
    scenes=HITS,
    loads=("buffer_stroke",),
    sense=Sense.AT_MOST,
    limit=key(
        "buffers.stroke",
        meaning="Buffer stroke given in the file",
        valid="any buffer",
        error="none: a limit of the file",
        source="the manufacturer of the buffer",
    ),
    needs=no_needs,
    blame=blames("buffers", "stroke"),
    repair=at("buffers", "stroke"),
    what="The buffers stop the crane within their stroke. Otherwise, the report states the remaining speed at the end"
    " of the stroke.",
    why="The end stop, the crane and the load absorb the remaining energy within a few millimetres.",
    formula="E(u) = m v^2/2 + P u,   u <= s;   left: v_1 = (v^2 + 2 (P s - E(s))/m)^(1/2)",
    source="energy; EN 13001-2, FEM 1.001",
)


FORCE: OneCheck = Check(
    code="CRN171",
    hazard=True,
    title="buffer force",
    question="Is the buffer force within the rating of buffer and end stop?",
    failure="buffer force exceeds its rating",
    scenes=HITS,
    loads=("buffer_force",),
    sense=Sense.AT_MOST,
    limit=key(
        "buffers.rating",
        meaning="Permissible force of a buffer, or of its end stop",
        valid="any buffer",
        error="none: a limit of the file",
        source="the manufacturer of the buffer, the calculation of the end stop",
    ),
    needs=needs(("buffers", "rating")),
    blame=blames("buffers", "rating"),
    repair=at("buffers", "rating"),
    what="The force of each buffer is at most its rating or the rating of the end stop.",
    why="A buffer that is too stiff breaks the parts it protects.",
    formula="F = (P + (P^2 + c m v^2)^(1/2))/n <= F_max, by the type of buffer",
    source="energy; EN 13001-2, FEM 1.001",
)


def _speed_limit(spec: Travelling, scene: TravelScene) -> Estimate:
    """Permissible impact speed of a buffer.

    **Range** any buffer.
    **Error** none: a limit of the file or of the buffer manufacturer.
    **Source** the file.
    """
    own = spec.buffers.largest_speed if spec.buffers is not None else None
    return rating(spec.checks.collision_speed if spec.checks.collision_speed is not None else own)


def _speed_key(spec: Travelling, scene: TravelScene) -> KeyPath:
    return ("checks", "collision_speed") if spec.checks.collision_speed is not None else ("buffers", "largest_speed")


def _has_speed(spec: Travelling, scene: TravelScene) -> bool:
    own = spec.buffers.largest_speed if spec.buffers is not None else None
    return spec.checks.collision_speed is not None or own is not None


HIT: OneCheck = only(_has_speed)(
    Check(
        code="CRN172",
        hazard=True,
        title="buffer impact speed",
        question="Is the impact speed within the limit of buffer and plant rules?",
        failure="buffer impact speed is too high",
        scenes=HITS,
        loads=("collision_speed",),
        sense=Sense.AT_MOST,
        limit=_speed_limit,
        needs=no_needs,
        blame=lambda spec, scene, loads: _speed_key(spec, scene),
        repair=at("speed"),
        what="The impact speed of the crane is at most the limit of the buffers or of the plant rules.",
        why="The stiffness of rubber and cellular buffers increases with the compression speed. Load and driver are"
        " not restrained.",
        formula="share of v <= v_max",
        source="the manufacturer of the buffer",
    )
)

CHECKS_OF_BUFFERS: tuple[AnyCheck, ...] = (STROKE, FORCE, HIT)
