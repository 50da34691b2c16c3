"""Inertia of the take-up weight."""

from ptmcalc.contract.effect import Criterion, Effect
from ptmcalc.machines.conveyor.machine.drives import moving_mass, running
from ptmcalc.machines.conveyor.machine.model import BeltLine
from ptmcalc.machines.conveyor.machine.plain_start import inertia_of_weight, takeup_numbers
from ptmcalc.machines.conveyor.machine.rigid_stop import deceleration
from ptmcalc.machines.conveyor.machine.scenes import IN_MOTION, ConveyorScene, Start
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.machine.start_case import start_case
from ptmcalc.machines.conveyor.waves.effects.shared import Loads, Offsets, anything, moved_by, slides_first
from ptmcalc.machines.conveyor.waves.load_errors import Change

_TAKEUP_FACTOR, _TAKEUP_OF_GRIP = 9.0, 3.0
"""Changes of tension by the inertia of the take-up weight, relative to T_0 a_0/(2 g) [1]: anywhere, and at a pulley
while its traction is worst. Calibrated: the largest value for `_TAKEUP_FACTOR` was 6.5 of 300 machines, for
`_TAKEUP_OF_GRIP` 1.7 of 240. Smaller values lose the safety of the bound; larger ones widen it."""


def takeup_criterion(spec: Conveyor, scene: ConveyorScene) -> Criterion:
    """Influence of the inertia of the take-up weight on the tension of the leaving strand.

        max(kappa/0.1, (a_0/g)/0.03),   kappa = T_0 w_1/(2 g Z_2),   a_0 = |F|/m_drive;   0 for a fixed take-up

    a_0 is the acceleration of the pulley alone, w_1 a lower bound of the lowest frequency.

    **Range** a gravity take-up.
    **Error** an estimate.
    **Source** take-up weight on two falls; thresholds are an engineering choice.
    """
    value = 0.0
    if spec.takeup_weight:
        line = running(spec, scene)
        value = inertia_of_weight(spec, line, _force_on_drum(spec, scene, line))
    return Criterion("kappa", value, 1.0, "inertia of the take-up weight", "take-up weight on two falls")


def _force_on_drum(spec: Conveyor, scene: ConveyorScene, line: BeltLine) -> float:
    """Largest force that sets the belt in motion or stops it [N]."""
    if isinstance(scene, Start):
        return start_case(spec, scene).excess
    return deceleration(spec, scene, line) * moving_mass(line)


def takeup_bound(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """Change of any tension if the inertia of the take-up weight is neglected.

        d = k T_0 a_0/(2 g),   k = 9, and 3 at a pulley at its worst traction

    The weight moves by half of the displacement difference of the belt ends at the take-up. Its inertia force is
    proportional to its acceleration, which in a linear belt is proportional to that of the pulley alone, a_0. Echoes
    add to it; below the threshold of kappa, the weight is too light to reflect them. The traction is worst when the
    entering tension is highest; the leaving tension is lowest at another time.

    **Range** below the threshold; unbounded above, and if the belt slips on its pulley before it starts.
    **Error** calibrated: over 300 starts and stops the maximum was 6.5 instead of 9, the second largest 3.5; over 240
    others, 1.7 instead of 3.
    **Source** take-up weight on two falls; coverage sample.
    """
    if not spec.takeup_weight:
        return {}
    if takeup_criterion(spec, scene).exceeded or slides_first(spec, scene):
        return anything(spec, scene, loads)
    line = running(spec, scene)
    _, drum = takeup_numbers(spec, line, _force_on_drum(spec, scene, line))
    unit = line.takeup_tension * drum / (2 * spec.gravity)
    change = Change(_TAKEUP_FACTOR * unit, _TAKEUP_FACTOR * unit, _TAKEUP_OF_GRIP * unit)
    return moved_by(spec, scene, line, loads, change, off=True)


TAKEUP_MASS = Effect(
    "takeup_mass",
    "inertia of the take-up weight",
    IN_MOTION,
    takeup_criterion,
    takeup_bound,
    part_of="belt_wave",
    calibrated=True,
)
