"""The tail pulley: reflection of waves, and its mass."""

from ptmcalc.contract.effect import Criterion, Effect
from ptmcalc.laws import wave
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.machine.model import (
    belt_line,
)
from ptmcalc.machines.conveyor.machine.scenes import IN_MOTION, ConveyorScene
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.waves.effects.shared import Loads, Offsets, belt_mass, small_change

JUMP_THRESHOLD = 0.02
"""Reflection coefficient of the tail pulley [1] from which on the change of impedance is simulated. An engineering
choice. Below it the error bar of a start has two parts: 2 % of the accelerating force of the belt, and 5 % of the wave
amplitude times (1 + n)^(1/2) for n contour times. In other scenes there is none."""
TAIL_MASS_THRESHOLD = 0.01
"""Mass of the tail pulley relative to belt and load [1] from which on it is simulated. An engineering choice. Below it
the error bar of a start has two parts: 1 % of the accelerating force of the belt, and 5 % of the wave amplitude times
(1 + n)^(1/2) for n contour times. In other scenes there is none."""
_JUMP_FACTOR = 2.5
"""Change of tension relative to reflection coefficient times wave amplitude [1]. Calibrated: the largest value of the
coverage sample was 1.6. A smaller value loses the safety of the bound; a larger one widens it."""
_TAIL_MASS_FACTOR = 5.0
"""Change of tension relative to mass ratio times wave amplitude [1]. Calibrated: the largest value of the coverage
sample was 3.4. A smaller value loses the safety of the bound; a larger one widens it."""


def jump_criterion(spec: Conveyor, scene: ConveyorScene) -> Criterion:
    """Part of a wave that the tail reflects because carrying and return strand differ.

        r = |Z1 - Z2|/(Z1 + Z2)

    **Range** any belt.
    **Error** exact.
    **Source** `laws.wave.reflection`; the threshold of 2 % is an engineering choice.
    """
    line = belt_line(spec, scene)
    value = abs(wave.reflection(line.impedance(CARRY), line.impedance(RETURN)))
    return Criterion("r", value, JUMP_THRESHOLD, "reflected part of a wave at the tail", "laws.wave.reflection")


def jump_bound(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """Change of any tension if the return strand is assumed to have the impedance of the carrying strand.

        d = r a M_belt + min(2.5 r sqrt(1 + n), 2) a b_max g

    The first term is the change of the return strand's mass (2 r of it); the second grows with the number n of wave
    circuits in the window and is limited by the deviation of both motions.

    **Range** r below 0.02; unbounded above.
    **Error** calibrated: the maximum of the sample was 1.6 instead of 2.5.
    **Source** perturbation of the reflected waves; coverage sample.
    """
    r = jump_criterion(spec, scene).value
    return small_change(spec, scene, loads, r, r < JUMP_THRESHOLD, _JUMP_FACTOR)


def tail_mass_criterion(spec: Conveyor, scene: ConveyorScene) -> Criterion:
    """Ratio of the tail pulley mass to the mass of belt and load.

        m_t/m_belt

    **Range** any belt.
    **Error** exact.
    **Source** the threshold of 1 % is an engineering choice.
    """
    line = belt_line(spec, scene)
    value = line.tail_mass / belt_mass(line)
    return Criterion("m_t/m_b", value, TAIL_MASS_THRESHOLD, "tail pulley mass / mass of belt and load", "Newton's law")


def tail_mass_bound(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """Change of any tension if the mass of the tail pulley is neglected.

        d = e a M_belt + min(5 e sqrt(1 + n), 2) a b_max g,   e = m_t/m_belt

    The first term is the inertia force of the pulley; the second is as in `jump_bound`.

    **Range** m_t/m_belt below 0.01; unbounded above.
    **Error** calibrated: the maximum of the sample was 3.4 instead of 5.
    **Source** perturbation of the tail's equation of motion; coverage sample.
    """
    share = tail_mass_criterion(spec, scene).value
    return small_change(spec, scene, loads, share, share < TAIL_MASS_THRESHOLD, _TAIL_MASS_FACTOR)


TAIL_JUMP = Effect(
    "tail_jump",
    "wave reflection at the tail pulley",
    IN_MOTION,
    jump_criterion,
    jump_bound,
    part_of="belt_wave",
    calibrated=True,
)

TAIL_MASS = Effect(
    "tail_mass",
    "mass of the tail pulley",
    IN_MOTION,
    tail_mass_criterion,
    tail_mass_bound,
    part_of="belt_wave",
    calibrated=True,
)
