"""The column as a spring: what gives under a force across it, in the direction of a scene, at any place along it."""

from ptmcalc.laws import mast
from ptmcalc.machines.crane.stacking import model
from ptmcalc.machines.crane.stacking.model import Direction
from ptmcalc.machines.crane.stacking.overhead import OverheadStacker
from ptmcalc.machines.crane.stacking.scenes import StackerScene
from ptmcalc.machines.crane.stacking.spec import Stacker


def second_moment(spec: Stacker, way: Direction) -> float | None:
    """Of area, of all masts, for bending along or across; None where the file gives the whole stiffness [m^4]."""
    column = spec.column
    if column.second_moment is None:
        return None
    across = column.second_moment_across
    return column.count * (across if way == "across" and across is not None else column.second_moment)


def flexural_stiffness(spec: Stacker, way: Direction) -> float:
    """E J of all masts; of a file that gives the whole stiffness, that of the column with a rigid root [N*m^2]."""
    column, moment = spec.column, second_moment(spec, way)
    if moment is None:
        return model.filled(column.stiffness) * column.length**3 / 3
    return column.elasticity * moment


def compliance(spec: Stacker, scene: StackerScene, place: float | None = None) -> mast.Compliance:
    """Displacement per force so far from the root, at the far end when left out, in the direction of the scene [m/N].

    The whole stiffness of a file counts as that of a column with a rigid root. A guide at the head is not in it.
    """
    column, way = spec.column, model.direction(spec, scene)
    at = column.length if place is None else place
    moment = second_moment(spec, way)
    if moment is None:
        return mast.Compliance(at**3 / (3 * flexural_stiffness(spec, way)), 0.0, 0.0)
    held = _of_girders(spec, way, at, moment) if isinstance(spec, OverheadStacker) else None
    bends = mast.column_bending(at, column.elasticity, moment)
    turns = held.rotation if held else 0.0
    if column.root_stiffness is not None:
        turns += at**2 / column.root_stiffness
    return mast.Compliance(bends, turns, held.translation if held else 0.0)


def _of_girders(spec: OverheadStacker, way: Direction, at: float, moment: float) -> mast.Compliance:
    """Of column and girders, whose second moments count as of the column's material."""
    bridge, trolley, material = spec.bridge, spec.trolley, spec.column.elasticity
    vertical = model.filled(bridge.girder_vertical) * bridge.elasticity / material
    place = model.trolley_place(spec)
    if way == "across":
        return mast.trolley_travel_compliance(at, material, moment, bridge.span, vertical, place, bridge.ends)
    horizontal = model.filled(bridge.girder_horizontal) * bridge.elasticity / material
    return mast.bridge_travel_compliance(
        at,
        material,
        moment,
        bridge.span,
        vertical,
        horizontal,
        trolley.gauge,
        place,
        bridge.ends,
        trolley.wheels,
    )


def attitude(spec: Stacker) -> str:
    """Whether the column hangs or stands."""
    return mast.HANGING if model.hangs(spec) else mast.STANDING


def stiffness(spec: Stacker, scene: StackerScene) -> float:
    """At the far end, in the direction of the scene, without weight [N/m]."""
    return compliance(spec, scene).stiffness


def weight_stiffness(spec: Stacker, scene: StackerScene) -> float:
    """What weights add to the stiffness at the far end, or take from it, all of the climbing mass there [N/m]."""
    given = compliance(spec, scene)
    return mast.gravity_stiffness(
        model.weight(spec, scene),
        spec.column.mass * spec.gravity,
        spec.column.length,
        given.rotation_share,
        given.translation_share,
        attitude(spec),
    )
