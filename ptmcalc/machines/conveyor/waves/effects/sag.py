"""Belt sag between idlers."""

import math

from ptmcalc.contract.effect import Criterion, Effect
from ptmcalc.laws import sag
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.machine.drives import running
from ptmcalc.machines.conveyor.machine.model import BeltLine, belt_line
from ptmcalc.machines.conveyor.machine.motion import moving
from ptmcalc.machines.conveyor.machine.plain_start import delay_lines_do
from ptmcalc.machines.conveyor.machine.scenes import IN_MOTION, ConveyorScene, Start
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.machine.start_case import start_case
from ptmcalc.machines.conveyor.waves import load_errors, start_intervals
from ptmcalc.machines.conveyor.waves.effects.shared import Loads, Offsets, anything, grown, moved_by

SAG_THRESHOLD = 0.05
"""Softening of the belt by sag, relative to its compliance [1], from which on sag is simulated. An engineering choice.
Below it the error bar is 2 % of the wave amplitude at most, times (1 + n)^(1/2) for n contour times."""
_SAG_FACTOR = 0.4
"""Change of tension of a plain start relative to softening times wave amplitude [1]. Calibrated: the largest value of
the coverage sample was 0.17. A smaller value loses the safety of the bound; a larger one widens it."""
_SCENE_SAG_FACTOR = 1.0
"""The same of any other scene, relative to softening times half the range of the tension [1]. Calibrated: the largest
value of 218 stops and starts was 0.45. A smaller value loses the safety of the bound; a larger one widens it."""
_GENTLE_SAG = 0.5
"""Softening at the lowest tension up to which that bound applies [1]. An engineering choice. A larger value applies the
calibrated factor to deeper sag; a smaller one leaves more scenes without a bound."""


def sag_criterion(spec: Conveyor, scene: ConveyorScene) -> Criterion | None:
    """Softening of the belt by sag at the lowest tension of the waves.

        f = EA (w l)^2/(12 S_low^3)

    S_low is the lower end of the wave bound in a start, and the minimum static tension in a stop or a jam.

    **Range** given idler pitches; infinite if the belt can lose its tension.
    **Error** in a start an upper bound.
    **Source** Ernst (`laws.sag.softening`); the threshold of 5 % is an engineering choice.
    """
    if isinstance(scene, Start):
        value = start_intervals.largest_softening(start_case(spec, scene))
    else:
        line = running(spec, scene)
        value = _softening(line, float(min((*line.static_ends(RETURN), *line.static_ends(CARRY)))))
    if value is None:
        return None
    return Criterion(
        "f", value, SAG_THRESHOLD, "compliance of the sagging spans / compliance of the belt", "laws.sag.softening"
    )


def _softening(line: BeltLine, lowest: float) -> float | None:
    """Softening of the belt by sag at a tension; None without idler pitches."""
    spans = [span for span in (line.back.span_weight, line.carry.span_weight) if span]
    if not spans:
        return None
    return max(float(sag.softening(line.stiffness, span, lowest)) for span in spans)


def sag_bound(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """Change of any tension if the sag of the spans is neglected.

        d = min(0.4 f sqrt(1 + n), 2) a b_max g,   f at the lowest tension the run found       start
        d = min(1.0 f sqrt(1 + n), 2) (S_max - S_min)/2                                        any other scene

    **Range** f below 0.05 (a plain start, for which another solver simulates sag) or 0.5 at the lowest tension of the
    run; unbounded above, and if the run does not state it.
    **Error** calibrated: the maximum of the sample was 0.17 instead of 0.4; of 218 stops and starts of a relaxed belt,
    nonlinear elements with Ernst spans against the same without, 0.45 instead of 1.0 (second largest 0.27).
    **Source** perturbation of the compliance; coverage samples.
    """
    lowest = loads["tension_min"].low if "tension_min" in loads else -math.inf
    line = belt_line(spec, scene)
    softest = _softening(line, lowest)
    if softest is None:
        return {}
    plain = isinstance(scene, Start) and delay_lines_do(spec, scene)
    if softest >= (SAG_THRESHOLD if plain else _GENTLE_SAG) or "tension_max" not in loads:
        return anything(spec, scene, loads)
    if isinstance(scene, Start) and plain:
        case = start_case(spec, scene)
        return load_errors.spread(case, loads, grown(case, _SAG_FACTOR * softest))
    contours = moving(spec, scene).window / line.contour_time
    swing = (loads["tension_max"].value - loads["tension_min"].value) / 2
    return moved_by(spec, scene, line, loads, min(_SCENE_SAG_FACTOR * softest * math.sqrt(1 + contours), 2.0) * swing)


SAG = Effect(
    "sag",
    "belt sag between idlers",
    IN_MOTION,
    sag_criterion,
    sag_bound,
    part_of="belt_wave",
    calibrated=True,
)
