"""When a column is still beside the place its fork has to meet."""

from ptmcalc.machines.crane.stacking.machine.columns import rest_deflection
from ptmcalc.machines.crane.stacking.machine.scenes import StackerScene
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.numerics.mast.run import Course, settled
from ptmcalc.numerics.mast.settling import Settled


def at_rest(spec: Stacker, scene: StackerScene, course: Course, window: float, doubt: float = 0.0) -> Settled:
    """From the standstill until the far end stays in the window about the place it has without weights beside its axis.

    It comes to rest beside that by its lean: on the side it swings to or on the other, as the machine travels forward
    or back; the later of both times.
    """
    lean = rest_deflection(spec, scene)
    found = [settled(course, spec.column.length, window, side, doubt) for side in ((lean, -lean) if lean else (0.0,))]
    latest = max(found, key=lambda one: one.time)
    return Settled(latest.time, max(one.low for one in found), max(one.high for one in found), latest.reason)
