"""What can be said about a start without its waves: the rigid body's loads, and intervals that hold the truth.

At every section and time the tension of a linear chain lies within a b(s) x stray of its quasi-static value, phase by
phase of the start (`laws.loop_bounds`). Internal damping takes nothing of that away: no damped mode strays further than
an undamped one. At the run-on with a constant tension at the run-off it is never below the static one under a torque.
"""

from collections.abc import Mapping

import numpy as np

from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.laws.start_profile import Phase
from ptmcalc.machines.chain_drive.machine import loops, strength
from ptmcalc.machines.chain_drive.machine.loops import HeldStrands
from ptmcalc.machines.chain_drive.machine.model import FloatArray
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive
from ptmcalc.machines.chain_drive.starting.motion import StartCase, Swinging

_X = np.linspace(0.0, 1.0, 129)
"""Points of a strand as fractions of its length [1] at which tensions are bounded; a numerical choice. The bound adds
the curvature between two points. More points narrow it and take longer."""
_STRANDS = (RETURN, CARRY)
TENSIONS = ("tension_start", "tension_dynamic_start", "tension_min", "safety_start")
"""Loads of a start that depend on how the chain swings."""


def static_at(case: Swinging, strand: int, x: FloatArray) -> FloatArray:
    """Static tension before anything swings, at shares of a strand [N]."""
    part = case.line.back if strand == RETURN else case.line.working
    return part.begin + x * (part.end - part.begin)


def rigid_tensions(case: StartCase) -> tuple[float, float, float]:
    """Of the rigid body: largest run-on tension, its dynamic part, smallest tension anywhere [N]."""
    swing = case.acceleration * float(loops.quasi_static(case.masses, CARRY, 1.0))
    lows = []
    for strand in _STRANDS:
        moved = case.acceleration * loops.quasi_static(case.masses, strand, _X)
        lows.append(float((static_at(case, strand, _X) + np.minimum(moved, 0)).min()))
    return case.line.run_on + max(swing, 0.0), max(swing, 0.0), min(lows)


def enclosed(case: StartCase) -> dict[str, Interval]:
    """Intervals that hold the largest dynamic run-on tension and the smallest tension anywhere [N]."""
    lowest = loops.lowest_frequency_bound(case.masses)
    phases = case.phases(lowest)
    r = float(loops.quasi_static(case.masses, CARRY, 1.0))
    b = float(loops.stray(case.masses, CARRY, 1.0))
    high = max(max(phase.low * r, phase.high * r, 0.0) + phase.stray * b for phase in phases)
    least = np.inf
    for strand in _STRANDS:
        band = _lowest(case, strand, phases)
        bend = _between_nodes(band)
        if isinstance(case.masses, HeldStrands):  # the stray has a corner in the middle of a strand
            bend = np.maximum(bend, np.maximum(np.roll(bend, 1), np.roll(bend, -1)))
        least = min(least, float((band - bend).min()))
    static = min(float(static_at(case, strand, _X[[0, -1]]).min()) for strand in _STRANDS)
    return {
        "tension_dynamic_start": Interval(0.0, case.acceleration * high),
        "tension_min": Interval(least, static),
    }


def _lowest(case: StartCase, strand: int, phases: tuple[Phase, ...]) -> FloatArray:
    r, b = loops.quasi_static(case.masses, strand, _X), loops.stray(case.masses, strand, _X)
    low = np.zeros_like(_X)
    for phase in phases:
        low = np.minimum(low, np.minimum(phase.low * r, phase.high * r) - phase.stray * b)
    return static_at(case, strand, _X) + case.acceleration * low


def _between_nodes(values: FloatArray) -> FloatArray:
    """How far a smooth function can fall below its nodes: an eighth of the second difference."""
    bend = np.zeros_like(values)
    bend[1:-1] = np.abs(values[2:] - 2 * values[1:-1] + values[:-2]) / 8
    bend[0], bend[-1] = bend[1], bend[-2]
    return bend


def stray_ratio(case: StartCase) -> float:
    """Largest stray of the tension from its quasi-static value over the static tension, over all sections."""
    factor = max(phase.stray for phase in case.phases(loops.lowest_frequency_bound(case.masses)))
    ratio = 0.0
    for strand in _STRANDS:
        swing = case.acceleration * loops.stray(case.masses, strand, _X) * factor
        static = static_at(case, strand, _X)
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = max(ratio, float(np.max(np.where(static > 0, swing / static, np.where(swing > 0, np.inf, 0)))))
    return ratio


# -- loads ----------------------------------------------------------------------------------------------------------


def safety(spec: ChainDrive, case: StartCase, tension: float) -> float:
    """Breaking load of a strand over a tension and the centrifugal one of full speed, of the most loaded chain [1]."""
    return strength.safety(spec, tension + case.line.centrifugal)


def loads_of(spec: ChainDrive, case: StartCase, dynamic: Estimate, smallest: Estimate | None) -> dict[str, Estimate]:
    """The loads that follow from the dynamic run-on tension and the smallest tension."""
    static = case.line.run_on
    tension = Estimate(
        static + dynamic.value, static + dynamic.low, static + dynamic.high, dynamic.numerical, dynamic.model
    )
    middle, low, high = (safety(spec, case, one) for one in (tension.value, tension.high, tension.low))
    slope = middle / (tension.value + case.line.centrifugal) if tension.value + case.line.centrifugal > 0 else 0.0
    found = {
        "tension_dynamic_start": dynamic,
        "tension_start": tension,
        "safety_start": Estimate(middle, low, high, dynamic.numerical * slope),
    }
    return found if smallest is None else found | {"tension_min": smallest}


def offsets(
    spec: ChainDrive, case: StartCase, intervals: Mapping[str, Interval], loads: Mapping[str, Estimate]
) -> dict[str, Interval]:
    """Offsets that widen loads to intervals of the dynamic run-on tension and the smallest tension."""
    found = {}
    dynamic = intervals.get("tension_dynamic_start", ANYTHING)
    for name, load in loads.items():
        if name == "tension_dynamic_start":
            ends = dynamic
        elif name == "tension_start":
            ends = Interval(case.line.run_on + dynamic.low, case.line.run_on + dynamic.high)
        elif name == "safety_start":
            lasts = [
                safety(spec, case, case.line.run_on + end) if np.isfinite(end) else 0.0
                for end in (dynamic.high, dynamic.low)
            ]
            ends = Interval(lasts[0], lasts[1] if np.isfinite(dynamic.low) else np.inf)
        elif name == "tension_min":
            ends = intervals.get("tension_min", ANYTHING)
        else:
            continue
        found[name] = Interval(min(ends.low - load.low, 0.0), max(ends.high - load.high, 0.0))
    return found


def spread(
    spec: ChainDrive, case: StartCase, less: float, more: float, loads: Mapping[str, Estimate]
) -> dict[str, Interval]:
    """Offsets when every dynamic tension may be lower by `less` and higher by `more` [N]."""
    known = loads.get("tension_dynamic_start")
    found: dict[str, Interval] = {}
    if known is not None:
        wide = {"tension_dynamic_start": Interval(known.low - less, known.high + more)}
        names = {name: load for name, load in loads.items() if name != "tension_min"}
        found = offsets(spec, case, wide, names)
    if "tension_min" in loads:
        found["tension_min"] = Interval(-more, less) if less == more else Interval(-max(less, more), max(less, more))
    return found
