"""Intervals that hold the tensions of a start without a simulation.

The intervals rest on `laws.loop_bounds.stray`: at every section and time the tension of a linear undamped loop lies
within a b(s) x stray of its quasi-static value, phase by phase of the start. At the run-on of a gravity take-up
under a torque the dynamic tension is never negative either.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.estimate import Interval
from ptmcalc.base.memory import kept_for, remembered
from ptmcalc.laws import loop_bounds, start_profile, wave
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.machine.start_case import StartCase, lowest_frequency

FloatArray = NDArray[np.float64]

_X = np.linspace(0.0, 1.0, 129)
"""Points of a strand as fractions of its length [1] at which tensions are bounded; a numerical choice. The bound adds
the curvature between two points. More points narrow it and take longer."""
_STRANDS = (RETURN, CARRY)


@dataclass(frozen=True, slots=True)
class Range:
    """Interval of a largest value over time, and of a smallest one [N]."""

    largest: Interval
    smallest: Interval


@dataclass(frozen=True, slots=True)
class Enclosure:
    """Intervals that hold the tensions of a start: at the drum and over each strand.

    At one moment the run-on is at least `together[0]` and the run-off at most `together[1]` (or on one average).
    """

    run_on: Range
    run_off: Range
    strands: tuple[Range, Range]
    together: tuple[float, float]
    belt_speed: float


@dataclass(frozen=True, slots=True)
class Along:
    """Both strands from end to end, at the places `_X`, shape (2, n): the static tension [N], and per unit of the
    start's acceleration what the rigid body adds to it and the most that waves stray from that [kg]."""

    static: FloatArray
    rigid: FloatArray
    stray: FloatArray


@kept_for(64)
def along(case: StartCase) -> Along:
    """The strands of a start."""
    static = [case.line.static(strand, _X) for strand in _STRANDS]
    rigid = [loop_bounds.quasi_static(case.masses, strand, _X) for strand in _STRANDS]
    stray = [loop_bounds.stray(case.masses, strand, _X) for strand in _STRANDS]
    return Along(np.array(static), np.array(rigid), np.array(stray))


@remembered(256)
def enclose(case: StartCase, softening: float) -> Enclosure:
    """Intervals of a start for a belt whose stiffness is nowhere below EA/(1 + softening)."""
    slowest = lowest_frequency(case) / math.sqrt(1 + softening)
    leak = 1.0
    phases = case.phases(slowest)
    steady = case.window - _ahead(case, phases, softening) - case.rise
    if not case.imposed_speed and steady > 0 and not case.damped:
        leak = loop_bounds.window_leak(slowest, steady)
    near = _nearness(phases, leak) if case.imposed_speed or steady >= 0 else math.inf
    reach = _reach(case, phases, near, softening)
    on, on_together = _at_run_on(case, reach, leak, softening, slowest)
    off, off_together = _at_run_off(reach)
    over = case.acceleration * (case.masses.total_mass / case.masses.drive_mass - 1) / slowest
    return Enclosure(
        run_on=on,
        run_off=off,
        strands=_over_strands(reach),
        together=(on_together, off_together),
        belt_speed=case.line.speed + (0.0 if case.imposed_speed else over),
    )


def _amplitude(phases: tuple[start_profile.Phase, ...]) -> float:
    """Largest amplitude of the rates of waves relative to those of a step [1]: while a force still rises, twice what
    the tension strays by."""
    return min(1.0, 2 * max(phase.stray for phase in phases))


def _ahead(case: StartCase, phases: tuple[start_profile.Phase, ...], softening: float) -> float:
    """How much earlier than the rigid body the drum may have its speed [s]: it runs ahead of the belt it stretches."""
    if case.imposed_speed or not case.moves or case.masses.drive_mass <= 0:
        return 0.0 if case.imposed_speed or not case.moves else math.inf
    stray = float(loop_bounds.speed_stray(case.masses, CARRY, 1.0)) * math.sqrt(1 + softening)
    return stray * max(phase.stray for phase in phases)


@kept_for(64)
def largest_stray(case: StartCase) -> float:
    """Largest stray of the tension from its quasi-static value anywhere [N]."""
    factor = max(phase.stray for phase in case.phases(lowest_frequency(case)))
    return case.acceleration * float(along(case).stray.max()) * factor


def stray_ratio(case: StartCase) -> float:
    """Largest stray of the tension from its quasi-static value over the static tension, over all sections."""
    factor = max(phase.stray for phase in case.phases(lowest_frequency(case)))
    part = along(case)
    swing = case.acceleration * part.stray * factor
    with np.errstate(divide="ignore", invalid="ignore"):
        return float(np.max(np.where(part.static > 0, swing / part.static, np.where(swing > 0, np.inf, 0))))


@dataclass(frozen=True, slots=True)
class _Reach:
    """Tensions over a whole start, of both strands at the places `_X`, shape (2, n) [N]: the lowest and the highest
    there can be, values the smallest is surely not above and the largest surely not below, and the plateau with the
    slack it is reached within."""

    low: FloatArray
    high: FloatArray
    surest_low: FloatArray
    surest_high: FloatArray
    plateau: FloatArray
    slack: FloatArray


def _reach(case: StartCase, phases: tuple[start_profile.Phase, ...], near: float, softening: float) -> _Reach:
    """How far the tensions go. Surely reached are the static value, and what the plateau leaves within the
    stray that every section comes `near` it."""
    part, shift = along(case), _softened_shift(case, softening)
    low = high = np.zeros_like(part.rigid)  # the static state itself, before the start
    for phase in phases:
        first, last, waves = phase.low * part.rigid, phase.high * part.rigid, part.stray * phase.stray
        low = np.minimum(low, np.minimum(first, last) - waves)
        high = np.maximum(high, np.maximum(first, last) + waves)
    swing = np.array([once_held(case, phases, strand, _X) for strand in _STRANDS])
    low, high = np.minimum(low, -swing), np.maximum(high, swing)
    plateau = part.static + case.acceleration * part.rigid
    strays = case.acceleration * part.stray
    slack = np.where(strays > 0, near, 0.0) * strays + shift
    return _Reach(
        low=part.static + case.acceleration * low - shift,
        high=part.static + case.acceleration * high + shift,
        surest_low=np.minimum(part.static, plateau + slack),
        surest_high=np.maximum(part.static, plateau - slack),
        plateau=plateau,
        slack=slack,
    )


def once_held(case: StartCase, phases: tuple[start_profile.Phase, ...], strand: int, x: FloatArray) -> FloatArray:
    """Most that waves can change the tension after the force has fallen at the drum's speed, per unit of the start's
    acceleration, at fractions x of a strand [kg]; nothing falls at the end of an imposed speed."""
    if case.imposed_speed or not case.moves:
        return np.zeros_like(x)
    energy = loop_bounds.energy_of_rates(case.masses, _amplitude(phases))
    return loop_bounds.held_swing(case.masses, strand, x, energy)


def _softened_shift(case: StartCase, softening: float) -> float:
    """How far uneven softening can move the mean tension of a fixed loop [N].

    Weights of the compliance between 1 and 1 + f move the mean of m(s) by at most f times its mean absolute
    deviation over two, which is at most f M_belt/4.
    """
    return case.acceleration * case.masses.belt_mass * softening / 4 if case.line.fixed_length else 0.0


def _over_strands(reach: _Reach) -> tuple[Range, Range]:
    over, under = (reach.high + _between_nodes(reach.high)).max(axis=1), reach.surest_high.max(axis=1)
    least, surely = (reach.low - _between_nodes(reach.low)).min(axis=1), reach.surest_low.min(axis=1)
    back, carry = (
        Range(
            largest=Interval(float(under[one]), float(over[one])),
            smallest=Interval(float(least[one]), float(surely[one])),
        )
        for one in _STRANDS
    )
    return back, carry


def _between_nodes(values: FloatArray) -> FloatArray:
    """How far a smooth function can rise above its nodes, along each row: an eighth of the second difference."""
    bend = np.empty_like(values)
    bend[:, 1:-1] = np.abs(values[:, 2:] - 2 * values[:, 1:-1] + values[:, :-2]) / 8
    bend[:, 0], bend[:, -1] = bend[:, 1], bend[:, -2]
    return bend


def _nearness(phases: tuple[start_profile.Phase, ...], leak: float) -> float:
    """Share of the stray within which every section surely comes to its plateau, all sections together: at the
    end of the rise within the stray of that phase, on an average over the window within its leak."""
    return min([leak] + [phase.stray for phase in phases if phase.high == 1.0])


def _at_run_off(reach: _Reach) -> tuple[Range, float]:
    """Range of the tension at the run-off of the drum, and an upper bound of what it comes to together with the
    run-on."""
    at = RETURN, 0
    ends = Range(
        largest=Interval(float(reach.surest_high[at]), float(reach.high[at])),
        smallest=Interval(float(reach.low[at]), float(reach.surest_low[at])),
    )
    return ends, float(reach.plateau[at] + reach.slack[at])


def _at_run_on(case: StartCase, reach: _Reach, leak: float, softening: float, slowest: float) -> tuple[Range, float]:
    """Range of the tension at the run-on of the drum, and a lower bound of what it comes to together with the
    run-off."""
    at = CARRY, -1
    static = float(along(case).static[at])
    low, high = float(reach.low[at]), float(reach.high[at])
    below, above = float(reach.surest_low[at]), float(reach.surest_high[at])
    if not case.line.fixed_length and not case.imposed_speed:
        # driving point: every mode starts with the force, none pulls against it until the drum is held
        fall = once_held(case, case.phases(slowest), CARRY, np.ones(1))
        low = static - case.acceleration * float(fall[0])
        if case.shape == "step" and leak < 1:
            above = max(above, float(reach.plateau[at]))
    above = min(max(above, static + _first_wave_reached(case, softening)), high)
    return Range(Interval(above, high), Interval(low, max(below, low))), float(reach.plateau[at] - reach.slack[at])


def _first_wave_reached(case: StartCase, softening: float) -> float:
    """Dynamic run-on tension that a torque step surely reaches before the first echo is back [N]; a belt that sags
    resists it less, Z/sqrt(1 + f), and its echoes are later."""
    if case.shape != "step" or case.imposed_speed or case.damped:
        return 0.0
    line = case.line
    quiet = 2 * line.transit(CARRY)
    slower = float(np.sqrt(1 + softening))
    against = line.impedance(CARRY) / slower
    share = 1.0
    if line.fixed_length:
        quiet = min(quiet, 2 * line.transit(RETURN), line.contour_time)
        share = against / (against + line.impedance(RETURN))
        against += line.impedance(RETURN) / slower
    reached = wave.first_wave_force(case.excess, against, line.drive_mass, min(quiet, case.window))
    return share * min(float(reached), against * line.speed)  # the drum is held at its speed
