"""Side of the gear losses during a stop."""

import math

from ptmcalc.base.estimate import Interval
from ptmcalc.base.memory import kept_for
from ptmcalc.contract.effect import Criterion, Effect
from ptmcalc.contract.result import family
from ptmcalc.machines.conveyor.machine.drives import running
from ptmcalc.machines.conveyor.machine.loads import OF_STOP
from ptmcalc.machines.conveyor.machine.scenes import Coast, ConveyorScene, EmergencyStop, Stop
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.stopping.gear_losses import GearChange, changing_sides
from ptmcalc.machines.conveyor.waves import load_errors
from ptmcalc.machines.conveyor.waves.effects.shared import Loads, Offsets, moved_by

GEAR_THRESHOLD = 0.001
"""Change of the stopping time by the side of the gear losses [1] from which on it is reported. An engineering choice.
Below it the error bar of the stopping time is at most 0.12 %."""
_GEAR_WAVES, _GEAR_MARGIN = 2.0, 1.2
"""Factors of a change of force [1]. `_GEAR_WAVES`: wave of a force that appears at once, at most twice its size;
derived. `_GEAR_MARGIN`: change of stopping time and distance relative to the rigid body; an engineering choice, the
belt at the head deviates by less than a fifth. Larger values widen the error bars."""


def gear_criterion(spec: Conveyor, scene: ConveyorScene) -> Criterion:
    """Relative change of the stopping time if the losses of each gear act on the driven side.

        |t_changing - t_fixed|/t_fixed   of the rigid conveyor

    **Range** any stop; 0 if the belt does not stop.
    **Error** that of the integration, below 1e-4.
    **Source** power through a gear: losses are on the driven side (`stopping.gear_losses.changing_sides`).
    """
    meaning = "change of the stopping time by the side of the gear losses"
    return Criterion("dt/t", _gear_change(spec, scene).relative, GEAR_THRESHOLD, meaning, "gear losses")


@kept_for(64)
def _gear_change(spec: Conveyor, scene: ConveyorScene) -> GearChange:
    return changing_sides(spec, scene, running(spec, scene))


def gear_bound(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """Change of the loads of a stop if the gear losses change their side during the stop.

        dS = 2 dF,   dF the maximum difference of the gear force;   dt, ds: 1.2 times those of the rigid conveyor

    A pulley that already slips keeps its traction.

    **Range** any stop.
    **Error** a bound of the waves; the belt speed at the head follows the rigid body within a fifth of the change.
    **Source** `stopping.gear_losses.changing_sides`.
    """
    change = _gear_change(spec, scene)
    if not change.force:
        return {}
    line = running(spec, scene)
    found = dict(moved_by(spec, scene, line, loads, _GEAR_WAVES * change.force))
    for name, load in loads.items():
        kind = family(name)
        used = loads.get(name.replace(kind, "slip_utilisation_max", 1))
        if kind in load_errors.OF_GRIP and used is not None and used.low >= 1:
            found.pop(name, None)
        if kind in OF_STOP and math.isfinite(load.value):
            by = _GEAR_MARGIN * (change.time if kind == "stop_time" else change.way)
            found[name] = Interval(min(by, 0.0), max(by, 0.0))
    return found


GEAR_LOSSES = Effect(
    "gear_losses",
    "direction of the gear losses during a stop",
    frozenset({Stop, EmergencyStop, Coast}),
    gear_criterion,
    gear_bound,
)
