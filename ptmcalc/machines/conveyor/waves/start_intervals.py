"""Intervals that hold the loads of a start, from those that hold its tensions."""

from collections.abc import Mapping

import numpy as np

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.base.memory import kept_for, remembered
from ptmcalc.contract.result import family
from ptmcalc.laws import sag
from ptmcalc.machines.conveyor.machine.model import BeltLine
from ptmcalc.machines.conveyor.machine.start_case import StartCase, drive_loads
from ptmcalc.machines.conveyor.machine.tension_loads import Sides, derived_loads, slip_loads
from ptmcalc.machines.conveyor.waves.load_errors import offset
from ptmcalc.machines.conveyor.waves.start_enclosure import Enclosure, enclose


@kept_for(64)
def enclosed_loads(case: StartCase, enclosure: Enclosure) -> dict[str, Interval]:
    """Intervals of the loads of a start."""
    line = case.line
    loads = {
        "tension_run_on_max": enclosure.run_on.largest,
        "tension_run_off_min": enclosure.run_off.smallest,
        "tension_dynamic_run_on_max": Interval(
            enclosure.run_on.largest.low - line.run_on, enclosure.run_on.largest.high - line.run_on
        ),
        "tension_max": Interval(
            max(part.largest.low for part in enclosure.strands),
            max(part.largest.high for part in enclosure.strands),
        ),
        "tension_min": Interval(
            min(part.smallest.low for part in enclosure.strands),
            min(part.smallest.high for part in enclosure.strands),
        ),
    }
    ends = [
        derived_loads(line, tension_max=tension_max, smallest=smallest)
        for tension_max, smallest in (
            (loads["tension_max"].low, tuple(part.smallest.high for part in enclosure.strands)),
            (loads["tension_max"].high, tuple(part.smallest.low for part in enclosure.strands)),
        )
    ]
    loads |= {name: Interval(min(e[name] for e in ends), max(e[name] for e in ends)) for name in ends[0]}
    loads |= _enclosed_drive(case, enclosure)
    if line.grip_exponent is not None:
        loads |= _enclosed_slip(line, enclosure)
    return loads


def _enclosed_drive(case: StartCase, enclosure: Enclosure) -> dict[str, Interval]:
    """A torque must exceed the static resistance; an imposed speed takes the drive's own inertia and the belt's
    pull, m a + S_on - S_off."""
    low = high = case.line.static_resistance
    if case.imposed_speed:
        inertia = case.line.drive_mass * case.acceleration
        high = inertia + enclosure.run_on.largest.high - enclosure.run_off.smallest.low
        low = max(low, inertia + enclosure.together[0] - enclosure.together[1])
    ends = [drive_loads(case, low), drive_loads(case, high)]
    return {name: Interval(min(e[name] for e in ends), max(e[name] for e in ends)) for name in ends[0]}


def _enclosed_slip(line: BeltLine, enclosure: Enclosure) -> dict[str, Interval]:
    """Slip is worst at the highest tight, the lowest slack and the fastest belt, if they came together; and it is
    surely as bad as at standstill, at the run-on surely reached over a run-off that cannot be above its static
    value then, and on average."""
    assert line.grip_exponent is not None
    lift = line.belt_line_mass * enclosure.belt_speed**2
    worst = [
        Sides(enclosure.run_on.largest.high, enclosure.run_off.smallest.low, lift),
        Sides(enclosure.run_on.smallest.low, enclosure.run_off.largest.high, lift),
    ]
    surely = [Sides(line.run_on, line.run_off, 0.0)]
    reached = [enclosure.together]
    if not line.fixed_length:
        reached.append((enclosure.run_on.largest.low, line.run_off))
    surely += [Sides(on, off, 0.0) for on, off in reached if on > off]  # else either may be the tight side
    high, low = slip_loads(line.grip_exponent, worst), slip_loads(line.grip_exponent, surely)
    return {name: Interval(min(high[name], low[name]), max(high[name], low[name])) for name in high}


@remembered(64)
def largest_softening(case: StartCase) -> float | None:
    """Largest softening by sag anywhere in a start, at the lowest tension the waves can bring; None without idler
    pitches. A belt that can lose its tension is infinitely soft."""
    line = case.line
    spans = (line.back.span_weight, line.carry.span_weight)
    if None in spans:
        return None
    worst = 0.0
    for _ in range(8):  # a softer belt swings more slowly and farther, which softens it further
        enclosure = enclose(case, worst)
        found = max(
            float(sag.softening(line.stiffness, span, part.smallest.low))
            for span, part in zip(spans, enclosure.strands, strict=True)
            if span is not None
        )
        if found <= worst * (1 + 1e-9) or not np.isfinite(found):
            return max(found, worst)
        worst = found
    return float(np.inf)


def offsets(case: StartCase, enclosure: Enclosure, loads: Mapping[str, Estimate]) -> dict[str, Interval]:
    """How far each load may lie from the rigid body's: the enclosure less the value. What is the only drive's own is
    what it is of the belt."""
    held = enclosed_loads(case, enclosure)
    found = {}
    for name, load in loads.items():
        if family(name) in held:
            interval = held[family(name)]
            found[name] = Interval(offset(interval.low, load.value), offset(interval.high, load.value))
    return found
