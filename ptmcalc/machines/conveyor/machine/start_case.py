"""A start as numbers: what its drives impose, its window, and the answer of the rigid body."""

import math
from dataclasses import dataclass

import numpy as np

from ptmcalc.base.memory import kept_for, remembered
from ptmcalc.laws import belt_modes, loop_bounds, start_profile
from ptmcalc.laws.loop_bounds import LoopMasses
from ptmcalc.machines.conveyor.machine.loads import FREQUENCIES
from ptmcalc.machines.conveyor.machine.model import BeltLine, FloatArray, Strand, belt_line, loop_masses, starting_force
from ptmcalc.machines.conveyor.machine.scenes import Start
from ptmcalc.machines.conveyor.machine.spec import Conveyor


@dataclass(frozen=True, slots=True)
class StartCase:
    """A start as numbers: the line, what the drive imposes, and the rigid body's answer.

    The drum is held (by friction, brake or backstop) until the drive's force exceeds the static resistance, so the
    force over it, `excess`, starts from 0 under a ramp and at once under a step.
    """

    line: BeltLine
    masses: LoopMasses
    shape: start_profile.Shape
    rise_time: float
    imposed_speed: bool
    available_force: float
    acceleration: float
    held: float
    window: float
    damped: bool = False
    """whether the belt damps: its waves are those of an elastic one at most, and may be less"""

    @property
    def rise(self) -> float:
        """How long force or speed still rise after the belt is released, within the window [s]."""
        return min(self.rise_time - self.held, self.window)

    @property
    def moves(self) -> bool:
        """Whether the drive can move the belt at all."""
        return self.imposed_speed or self.available_force > self.line.static_resistance

    @property
    def excess(self) -> float:
        """Largest force of the drive over the static resistance that comes to act [N], M a."""
        return self.acceleration * self.masses.total_mass

    def force(self, time: FloatArray) -> FloatArray:
        """Force over the static resistance at times after the belt is released [N]."""
        full = start_profile.rise(self.shape, self.rise_time, time + self.held)
        return np.maximum(self.available_force * full - self.line.static_resistance, 0.0)

    def drum_speed(self, time: FloatArray) -> FloatArray:
        """Imposed speed of the drum [m/s]."""
        return self.line.speed * start_profile.rise(self.shape, self.rise_time, time)

    def drum_acceleration(self, time: FloatArray) -> FloatArray:
        """Rate of the imposed speed of the drum [m/s^2]."""
        return self.line.speed * start_profile.rise_rate(self.shape, self.rise_time, time)

    def phases(self, lowest_frequency: float) -> tuple[start_profile.Phase, ...]:
        """Bounds on the answer of every mode of at least this frequency [rad/s], relative to the plateau's.

        Of a torque that rises through the static resistance only the part above it acts, and only until the rated
        speed is reached: a part of a ramp is a ramp, a part of anything else is only known to rise. A resistance that
        drives acts at once, as a step.
        """
        if not self.moves:
            return (start_profile.Phase(0.0, 0.0, 0.0),)
        if self.imposed_speed or self.shape == start_profile.STEP:
            return start_profile.phases(self.shape, self.imposed_speed, self.rise_time, lowest_frequency)
        if self.shape not in (start_profile.STEP, start_profile.RAMP) and self.rise < self.rise_time:
            return (start_profile.Phase(0.0, 1.0, 1.0),)
        at_once = max(-self.line.static_resistance / self.excess, 0.0)
        rising = start_profile.phases(self.shape, False, self.rise, lowest_frequency)
        return tuple(
            start_profile.Phase(
                at_once + (1 - at_once) * phase.low,
                at_once + (1 - at_once) * phase.high,
                at_once + (1 - at_once) * phase.stray,
            )
            for phase in rising
        )


@kept_for(64)
def start_case(spec: Conveyor, scene: Start) -> StartCase:
    """A start of this conveyor.

    The window of a torque start ends when the rigid body reaches the rated speed; that of an imposed speed four
    contour times after the end of the profile, which is a period of the lowest mode of a uniform loop.
    """
    line = belt_line(spec, scene)
    profile = scene.profile
    imposed = profile.imposes_speed
    masses = loop_masses(line, imposed)
    rise_time = profile.rise_time
    available = starting_force(spec)
    if imposed:
        acceleration = line.speed * start_profile.peak_rate(profile.rise, rise_time)
        window = rise_time + 4 * line.contour_time
        held = 0.0
    else:
        acceleration = held = window = 0.0
        if available > line.static_resistance:
            rise, resistance = profile.rise, line.static_resistance
            held = float(start_profile.time_of_share(rise, rise_time, resistance / available))
            needed = masses.total_mass * line.speed
            window = float(start_profile.time_to_momentum(rise, rise_time, available, resistance, held, needed))
            reached = available * float(start_profile.rise(profile.rise, rise_time, held + window))
            acceleration = (reached - line.static_resistance) / masses.total_mass
    damped = spec.belt.damping is not None and spec.effects.get("belt_damping") != "off"
    return StartCase(line, masses, profile.rise, rise_time, imposed, available, acceleration, held, window, damped)


@kept_for(64)
def lowest_frequency(case: StartCase) -> float:
    """Lower bound of every natural frequency of the belt in a start [rad/s]."""
    return loop_bounds.lowest_frequency_bound(case.masses)


@remembered(64)
def natural_frequencies(masses: LoopMasses, takeup_mass: float) -> tuple[float, ...]:
    """The lowest natural frequencies of a belt [rad/s], which no tension and no resistance changes."""
    return tuple(belt_modes.natural_frequencies(masses, takeup_mass, FREQUENCIES).tolist())


def frequencies_of(case: StartCase, takeup_mass: float) -> tuple[float, ...]:
    """The lowest natural frequencies of the belt in a start [rad/s], with the true mass of every length."""
    line = case.line
    if all(len(set(strand.masses)) == 1 for strand in (line.back, line.carry)):
        return natural_frequencies(case.masses, takeup_mass)
    back, carry = (_masses_and_compliances(strand, line.stiffness) for strand in (line.back, line.carry))
    return _of_lengths(case.masses, back, carry, takeup_mass)


Lengths = tuple[tuple[float, float], ...]


@remembered(64)
def _of_lengths(masses: LoopMasses, back: Lengths, carry: Lengths, takeup_mass: float) -> tuple[float, ...]:
    (m2, c2), (m1, c1) = (np.array(strand).T for strand in (back, carry))
    found = belt_modes.natural_frequencies_of_lengths(masses, m2, c2, m1, c1, takeup_mass, FREQUENCIES)
    return tuple(found.tolist())


def _masses_and_compliances(strand: Strand, stiffness: float) -> Lengths:
    """Mass [kg] and compliance [m/N] of every length of a strand."""
    lengths = np.diff(strand.marks).tolist()
    return tuple((mass * length, length / stiffness) for mass, length in zip(strand.masses, lengths, strict=True))


def start_duration(case: StartCase) -> float:
    """Duration of the start of the rigid body, from switching on [s]; infinite when it cannot move."""
    if case.imposed_speed:
        return case.rise_time
    return case.held + case.window if case.moves else math.inf


def drive_loads(case: StartCase, needed: float) -> dict[str, float]:
    """Force the drive must give to start, and how far the available one exceeds it."""
    reserve = case.available_force / needed if needed > 0 else np.inf
    if not case.moves:
        reserve = min(reserve, float(np.nextafter(1, 0)))  # equal forces do not start anything
    return {"starting_force_needed": needed, "starting_reserve": reserve}
