"""What can be said about a start without simulating it: the rigid body's loads, and intervals that hold the truth.

The intervals rest on `laws.loop_bounds.stray`: at every section and time the tension of a linear undamped loop lies
within a b(s) x stray of its quasi-static value, phase by phase of the start. At the run-on of a gravity take-up
under a torque the dynamic tension is never negative either.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.estimate import ANYTHING, NOTHING, Estimate, Interval
from ptmcalc.base.memory import kept_for, remembered
from ptmcalc.contract.result import family
from ptmcalc.laws import capstan, loop_bounds, sag, start_profile, wave
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.loads import (
    CHANGED_BY_MOTION,
    DRIVE,
    GRIP,
    LOWEST,
    OF_STOP,
    SLIPS,
    TENSIONS,
    WAYS_OF_STOP,
)
from ptmcalc.machines.conveyor.model import BeltLine, StartCase, lowest_frequency, start_duration
from ptmcalc.machines.conveyor.traction.bounds import moved_grip
from ptmcalc.numerics.lanes import value

FloatArray = NDArray[np.float64]

_X = np.linspace(0.0, 1.0, 129)
"""Points of a strand as fractions of its length [1] at which tensions are bounded; a numerical choice. The bound adds
the curvature between two points. More points narrow it and take longer."""
_SAME = 1e-9
"""Relative tolerance at which two tensions count as equal [1], far above the resolution 2e-16 of the floating point. It
decides whether a strand takes part in the lower bound of the sag. A smaller value loses strands to rounding and narrows
the bound."""
OF_GRIP = frozenset(GRIP).union(SLIPS)
"""Loads of a pulley that say how much of its grip is in use, and how it slips."""
_STRANDS = (RETURN, CARRY)


@dataclass(frozen=True, slots=True)
class Sides:
    """Tensions at the drum that slip is judged by [N]: run-on, run-off, centrifugal."""

    on: float
    off: float
    lift: float


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


def rigid_tension(case: StartCase, strand: int) -> tuple[FloatArray, FloatArray]:
    """Smallest and largest tension of the rigid body at both ends of a strand [N]."""
    part, ends = along(case), (strand, [0, -1])
    static, swing = part.static[ends], case.acceleration * part.rigid[ends]
    return static + np.minimum(swing, 0), static + np.maximum(swing, 0)


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


def rigid_loads(case: StartCase) -> dict[str, float]:
    """Loads of the rigid body during a start, SI."""
    line = case.line
    ranges = [rigid_tension(case, strand) for strand in _STRANDS]
    on, off = float(ranges[CARRY][1][1]), float(ranges[RETURN][0][0])
    loads = {
        "tension_dynamic_run_on_max": on - line.run_on,
        "tension_run_on_max": on,
        "tension_run_off_min": off,
        "tension_max": float(max(high.max() for _, high in ranges)),
        "tension_min": float(min(low.min() for low, _ in ranges)),
    }
    loads |= drive_loads(case, case.line.static_resistance + (case.excess if case.imposed_speed else 0.0))
    loads |= derived_loads(
        line,
        tension_max=loads["tension_max"],
        smallest=(float(ranges[RETURN][0].min()), float(ranges[CARRY][0].min())),
    )
    if line.grip_exponent is not None:
        worst = [Sides(on, off, line.centrifugal_at_speed), Sides(line.run_on, line.run_off, 0.0)]
        loads |= slip_loads(line.grip_exponent, worst)
    return loads


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


def drive_loads(case: StartCase, needed: float) -> dict[str, float]:
    """Force the drive must give to start, and how far the available one exceeds it."""
    reserve = case.available_force / needed if needed > 0 else np.inf
    if not case.moves:
        reserve = min(reserve, float(np.nextafter(1, 0)))  # equal forces do not start anything
    return {"starting_force_needed": needed, "starting_reserve": reserve}


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


def slip_loads(exponent: float, states: list[Sides]) -> dict[str, float]:
    """Worst utilisation and reserve of grip over some states of the drum, in whichever sense it is loaded."""
    sides = [(max(state.on, state.off), min(state.on, state.off), state.lift) for state in states]
    return {
        "slip_utilisation_max": max(
            value(capstan.slip_utilisation, tight, slack, lift, exponent) for tight, slack, lift in sides
        ),
        "slip_reserve_min": min(value(capstan.slip_reserve_force, tight, slack, exponent) for tight, slack, _ in sides),
    }


def derived_loads(line: BeltLine, tension_max: float, smallest: tuple[float, ...]) -> dict[str, float]:
    """Belt safety, sag and distance from slack that follow from the extreme tensions; `smallest` of return and
    carry strand [N]."""
    spans = (line.back.span_weight, line.carry.span_weight)
    loads = {"slack_margin_min": min(low - limit for limit, low in zip(slack_limits(line), smallest, strict=True))}
    if line.breaking_force is not None:
        loads["belt_safety_min"] = line.breaking_force / tension_max if tension_max > 0 else np.inf
    sags = [value(sag.sag_ratio, span, low) for span, low in zip(spans, smallest, strict=True) if span is not None]
    if len(sags) == len(spans):
        loads["sag_relative_max"] = max(sags)
    return loads


def slack_limits(line: BeltLine) -> tuple[float, float]:
    """Tension below which the return and the carry strand are slack [N]; 0 where the idlers' pitch is not given."""
    back, carry = (
        sag.tension_at_sag(span, line.slack_sag) if span is not None else 0.0
        for span in (line.back.span_weight, line.carry.span_weight)
    )
    return back, carry


def even_loads(line: BeltLine) -> dict[str, float]:
    """Loads of a belt that runs evenly: those a stop or a jam begins with, and only makes worse."""
    ends = [line.static_ends(which) for which in _STRANDS]
    loads = {
        "tension_run_on_max": line.run_on,
        "tension_dynamic_run_on_max": 0.0,
        "tension_run_off_min": line.run_off,
        "tension_max": max(map(max, ends)),
        "tension_min": min(map(min, ends)),
    }
    return loads | derived_loads(line, loads["tension_max"], tuple(map(min, ends)))


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
            found[name] = Interval(_less(interval.low, load.value), _less(interval.high, load.value))
    return found


def anything(name: str, load: Estimate) -> Interval:
    """No bound; but slip is never negative."""
    return Interval(-load.low, np.inf) if family(name) in SLIPS and np.isfinite(load.low) else ANYTHING


def _less(end: float, value: float) -> float:
    return 0.0 if end == value else end - value


def spread(
    case: StartCase, loads: Mapping[str, Estimate], change: float, at_grip: float = math.inf
) -> dict[str, Interval]:
    """How far each load of a run may be off when every tension may be off by `change` [N] at any time, and by `at_grip`
    at a drum while its grip is worst, if that is less.

    The grip follows from the tensions at the drum (`traction.bounds`). The loads of the only drive move as those of the
    belt do.
    """
    line = case.line
    moved = {name: Interval(-change, change) for name in TENSIONS if name in loads}
    if line.fixed_length and "tension_run_off_min" in loads:
        moved["tension_run_off_min"] = Interval(-change, change)
    if case.imposed_speed and "starting_force_needed" in loads:
        needed = loads["starting_force_needed"].value
        ends = [drive_loads(case, needed + part)["starting_reserve"] for part in (2 * change, -2 * change)]
        moved["starting_force_needed"] = Interval(-2 * change, 2 * change)
        moved["starting_reserve"] = around(loads["starting_reserve"].value, ends)
    moved |= moved_safety(line, loads, change)
    if "sag_relative_max" in loads:
        moved["sag_relative_max"] = moved_sag(line, loads, change)
    if "slip_utilisation_max" in loads and line.grip_exponent is not None:
        there = min(change, at_grip) if _grips("slip_utilisation_max", loads) else change
        off = there if line.fixed_length else 0.0
        for name in GRIP:
            if name in loads:
                drum = {name: line.grip_exponent}
                moved[name] = moved_grip(name, loads, line.centrifugal_at_speed, drum, there, off)
        used = loads["slip_utilisation_max"].high + moved["slip_utilisation_max"].high
        if used >= 1:  # else nothing slips, neither here nor in truth
            moved |= {name: anything(name, load) for name, load in loads.items() if family(name) in SLIPS}
    return moved | {name: moved[family(name)] for name in loads if family(name) in moved}


@dataclass(frozen=True, slots=True)
class Change:
    """By how much tensions may be off [N]: their largest values, their smallest ones, and those at a drum while its
    grip is worst."""

    largest: float
    smallest: float
    at_grip: float

    @classmethod
    def any_time(cls, change: float) -> "Change":
        """Every tension, at any time."""
        return cls(change, change, change)

    def of(self, load: str) -> float:
        """Of a tension."""
        return self.smallest if family(load) in LOWEST else self.largest


def moved(
    line: BeltLine,
    loads: Mapping[str, Estimate],
    change: Change,
    slowing: float,
    grips: Mapping[str, float],
    off: bool = False,
    asked: int = 0,
) -> dict[str, Interval]:
    """How far loads may be off when tensions may be off by `change`, of any scene and any number of drives.

    The run-off tension of a constant take-up does not move unless `off` says so. Grip follows from the tensions at its
    drum (`traction.bounds`), `grips` being mu alpha; where it still holds, nothing slips. An imposed speed asks of the
    drives at `asked` ends of the belt a force that both tensions there enter. The mean of all that moves follows
    Newton's law whatever the waves are, so the head's way is off by no more than the belt is stretched, and its time to
    rest by what a wave of that size makes of its speed; a belt that slips on its braked pulley has neither bound:

        ds <= change L_loop/EA        dt <= 2 change/(Z |a|),   a the `slowing` of the rigid body [m/s^2]
    """
    found: dict[str, Interval] = {}
    fixed = line.fixed_length or off
    most = max(change.largest, change.smallest)
    stretch = most * (line.back.length + line.carry.length) / line.stiffness
    least = min(line.impedance(RETURN), line.impedance(CARRY))
    delay = 2 * most / (least * slowing) if slowing > 0 else np.inf
    several = sum(name.startswith("tension_run_off_min[") for name in loads) > 1
    slips = any(family(name) == "slip_utilisation_max" and one.value > 1 for name, one in loads.items())

    def grip(name: str) -> Interval:
        there = change.at_grip if _grips(name, loads) else max(most, change.at_grip)
        off = there if fixed or several else 0.0
        return moved_grip(name, loads, line.centrifugal_at_speed, grips, there, off)

    def holds(name: str) -> bool:
        """Whether the drum of a load of slip keeps its grip."""
        used = name.replace(family(name), "slip_utilisation_max", 1)
        return used in loads and loads[used].high + grip(used).high < 1

    for name, estimate in loads.items():
        kind, value = family(name), estimate.value
        if kind in OF_STOP and value == np.inf:
            continue  # a belt that never stops does so whatever its waves are
        if kind in OF_STOP and slips:
            found[name] = anything(name, estimate)  # its brakes hold with what the tension at the pulley allows
            continue
        if kind in TENSIONS:
            found[name] = Interval(-change.of(name), change.of(name))
        elif kind == "tension_run_off_min":
            moves = fixed or ("[" in name and several)
            found[name] = Interval(-change.smallest, change.smallest) if moves else NOTHING
        elif kind == "belt_safety_min" and line.breaking_force is not None:
            found |= moved_safety(line, loads, change.largest)
        elif kind in GRIP:
            found[name] = grip(name)
        elif kind == "sag_relative_max":
            found[name] = moved_sag(line, loads, change.smallest)
        elif kind in DRIVE and asked:
            found[name] = moved_drive(loads, 2 * asked * most)[kind]
        elif kind in WAYS_OF_STOP or kind == "takeup_movement":
            found[name] = Interval(-stretch, stretch)
        elif kind == "stop_time":
            found[name] = Interval(-delay, delay)
        elif kind in CHANGED_BY_MOTION and not (kind in SLIPS and holds(name)):
            found[name] = anything(name, estimate)
    return found


def _grips(name: str, loads: Mapping[str, Estimate]) -> bool:
    """Whether the drum of a load of grip does not slip: else its grip is worst with hardly any tension on one side, at
    any time."""
    used = loads.get(name.replace(family(name), "slip_utilisation_max", 1))
    return used is not None and used.high < 1


def moved_drive(loads: Mapping[str, Estimate], change: float) -> dict[str, Interval]:
    """The force an imposed speed asks for, and the reserve of the available one over it."""
    needed, reserve = loads["starting_force_needed"].value, loads["starting_reserve"].value
    if not np.isfinite(reserve):
        return {"starting_force_needed": Interval(-change, change), "starting_reserve": ANYTHING}
    available = reserve * needed
    ends = [available / (needed + change), available / (needed - change) if needed > change else np.inf]
    return {"starting_force_needed": Interval(-change, change), "starting_reserve": around(reserve, ends)}


def moved_safety(line: BeltLine, loads: Mapping[str, Estimate], change: float) -> dict[str, Interval]:
    """The belt safety of a largest tension that is off by `change` [N]; nothing of a belt without a breaking force."""
    if line.breaking_force is None or "belt_safety_min" not in loads:
        return {}
    if not change:
        return {"belt_safety_min": NOTHING}
    value = loads["belt_safety_min"].value
    tension = line.breaking_force / value
    weakest = line.breaking_force / (tension - change) if tension > change else np.inf
    return {"belt_safety_min": around(value, [line.breaking_force / (tension + change), weakest])}


def moved_sag(line: BeltLine, loads: Mapping[str, Estimate], change: float) -> Interval:
    """The largest sag is that of one strand at its lowest tension; the other one has no less tension than it takes for
    as much sag, nor less than the lowest of all."""
    ratio = loads["sag_relative_max"].value
    lowest = loads["tension_min"].value if "tension_min" in loads else -np.inf
    highs, lows = [], []
    for span in (line.back.span_weight, line.carry.span_weight):
        if span:
            tension = float(sag.tension_at_sag(span, ratio))
            highs.append(float(sag.sag_ratio(span, max(tension, lowest) - change)))
            if tension >= lowest * (1 - _SAME):
                lows.append(float(sag.sag_ratio(span, tension + change)))
    return around(ratio, [max(highs), min(lows, default=0.0)])


def around(value: float, ends: list[float]) -> Interval:
    """The offsets of some values from one that lies among them."""
    return Interval(min([_less(end, value) for end in ends] + [0.0]), max([_less(end, value) for end in ends] + [0.0]))


def scalar_loads(case: StartCase) -> dict[str, float]:
    """Closed forms of a start that no wave can change."""
    line = case.line
    return {
        "wave_speed_carry": line.wave_speed(CARRY),
        "wave_speed_return": line.wave_speed(RETURN),
        "impedance_carry": line.impedance(CARRY),
        "impedance_return": line.impedance(RETURN),
        "reduced_drive_mass": line.drive_mass,
        "static_resistance": line.static_resistance,
        "starting_force": case.available_force,
        "rim_force_excess": case.excess if case.moves else case.available_force - line.static_resistance,
        "acceleration_rigid": case.acceleration,
        "start_time_rigid": start_duration(case),
        "first_wave_time_max": wave.first_wave_time(line.transit(CARRY), line.transit(RETURN)),
    }
