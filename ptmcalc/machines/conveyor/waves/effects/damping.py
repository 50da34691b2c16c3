"""Internal damping of the belt."""

import math

from ptmcalc.contract.effect import Criterion, Effect
from ptmcalc.machines.conveyor.machine.drives import running
from ptmcalc.machines.conveyor.machine.model import BeltLine, belt_line
from ptmcalc.machines.conveyor.machine.motion import moving
from ptmcalc.machines.conveyor.machine.plain_start import delay_lines_do
from ptmcalc.machines.conveyor.machine.scenes import IN_MOTION, ConveyorScene, Jam, Start
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.machine.start_case import start_case
from ptmcalc.machines.conveyor.waves.effects.shared import Loads, Offsets, anything, moved_by
from ptmcalc.machines.conveyor.waves.load_errors import Change

_DAMPING_FACTOR, _DAMPING_OF_GRIP = 6.0, 3.0
"""Changes of tension by damping, relative to the width of a front times the amplitude [1]: anywhere, and at a pulley
while its traction is worst. Calibrated: the largest values of 360 machines were 4.9 for `_DAMPING_FACTOR` and 2.0 for
`_DAMPING_OF_GRIP`. Smaller values lose the safety of the bound; larger ones widen it."""
_DAMPING_OF_SLOPES = 1.0
"""The same for a rise longer than a contour time, relative to contour time over rise [1]. Calibrated: the largest value
of 360 machines was 0.55. A smaller value loses the safety of the bound; a larger one widens it."""
DAMPING_THRESHOLD = 0.001
"""Change of the complex frequency of the slowest wave [1] from which on damping is simulated. An engineering choice: an
oscillation loses 0.3 %, the fifth echo 3 %. Below it the error bar is at most 19 % of the amplitude times (1 + n)^(1/2)
for n contour times."""


def damping_change(spec: Conveyor, line: BeltLine) -> float:
    """Change by damping of the frequency of a wave as slow as the slowest of a uniform loop, w = pi/(2 T)."""
    return spec.belt.damping.change(math.pi / (2 * line.contour_time)) if spec.belt.damping else 0.0


def damping_criterion(spec: Conveyor, scene: ConveyorScene) -> Criterion | None:
    """Frequency shift of the slowest wave due to the belt damping.

        d = |EA*/EA - 1|/2 at w = pi/(2 T);   infinite in a jam, whose front contains every frequency

    **Range** a file that gives `belt.damping`; not an instantaneous jam of a Kelvin-Voigt belt, whose response to a
    speed jump is an infinite force.
    **Error** an estimate: the slowest wave of a uniform loop represents any loop.
    **Source** `laws.belt_damping`; the threshold of 0.1 % is an engineering choice: an oscillation then loses 0.3 %,
    the fifth echo 3 %.
    """
    if spec.belt.damping is None or jumps(spec, scene):
        return None
    value = math.inf if isinstance(scene, Jam) else damping_change(spec, belt_line(spec, scene))
    return Criterion(
        "d", value, DAMPING_THRESHOLD, "frequency shift of the slowest wave by damping", "laws.belt_damping"
    )


def jumps(spec: Conveyor, scene: ConveyorScene) -> bool:
    """Whether a Kelvin-Voigt belt is stopped from one moment to the next."""
    damping = spec.belt.damping
    return isinstance(scene, Jam) and not scene.time and damping is not None and damping.model == "kelvin_voigt"


def damping_bound(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """Change of any tension if the belt is assumed undamped.

        c = min(k sqrt(d (1 + n)), 2) (S_max - S_min)/2,   n wave circuits in the window
        k = T/t_r a start of a running profile that rises over t_r, at least one wave circuit T; else 6, and 3
            at a pulley at its worst traction

    After n circuits a front is about sqrt(d n) of the loop wide, and peaks result from fronts that meet. A rise of one
    wave circuit or longer produces no front but a slope; damping rounds its corners only, by the rise relative to the
    width of a front.

    **Range** d below 0.001; unbounded above, and in a jam.
    **Error** calibrated: the maximum of the sample was 3.8 in place of 6; of 360 others 4.9, 2.0 in place of 3, and
    0.55 in place of 1.
    **Source** width of a front in a Kelvin-Voigt belt, sqrt(2 t_r t); coverage sample.
    """
    criterion = damping_criterion(spec, scene)
    if criterion is None:
        return {}
    if criterion.exceeded or "tension_max" not in loads or "tension_min" not in loads:
        return anything(spec, scene, loads)
    line = running(spec, scene)
    contours = moving(spec, scene).window / line.contour_time
    swing = (loads["tension_max"].value - loads["tension_min"].value) / 2
    factor, of_grip = _DAMPING_FACTOR, _DAMPING_OF_GRIP
    if isinstance(scene, Start) and scene.belt == "frozen" and delay_lines_do(spec, scene):
        rise = start_case(spec, scene).rise_time or 0.0
        if rise >= line.contour_time:
            factor = of_grip = _DAMPING_OF_SLOPES * line.contour_time / rise
    width = math.sqrt(criterion.value * (1 + contours))
    change, at_grip = (min(one * width, 2.0) * swing for one in (factor, of_grip))
    return moved_by(spec, scene, line, loads, Change(change, change, at_grip))


BELT_DAMPING = Effect(
    "belt_damping",
    "internal damping of the belt",
    IN_MOTION,
    damping_criterion,
    damping_bound,
    part_of="belt_wave",
    calibrated=True,
)
