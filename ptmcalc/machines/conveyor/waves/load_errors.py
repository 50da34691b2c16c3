"""How far loads may be off when the tensions they follow from may be."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ptmcalc.base.estimate import ANYTHING, NOTHING, Estimate, Interval
from ptmcalc.contract.result import family, of
from ptmcalc.laws import sag
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.machine.loads import (
    BELT_SPEED,
    BRAKING_FORCE,
    BRAKING_POWER,
    BRAKING_RESERVE,
    CHANGED_BY_MOTION,
    DRIVE,
    DRIVE_OF_STOP,
    GRIP,
    LOWEST,
    MOTOR_SPEED,
    OF_BRAKES,
    OF_STOP,
    RUN_BACK_DISTANCE,
    RUN_BACK_SPEED,
    SLIPS,
    TAKEUP_WAYS,
    TENSIONS,
    WAYS_OF_STOP,
)
from ptmcalc.machines.conveyor.machine.model import BeltLine, grips, turns
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.machine.start_case import StartCase, drive_loads
from ptmcalc.machines.conveyor.stopping.brake_heat import moved_heat
from ptmcalc.machines.conveyor.traction.bounds import moved_grip

_SAME = 1e-9
"""Relative tolerance at which two tensions count as equal [1], far above the resolution 2e-16 of the floating point. It
decides whether a strand takes part in the lower bound of the sag. A smaller value loses strands to rounding and narrows
the bound."""
OF_GRIP = frozenset(GRIP).union(SLIPS)
"""Loads of a pulley that say how much of its grip is in use, and how it slips."""


def anything(name: str, load: Estimate) -> Interval:
    """No bound; but slip is never negative."""
    return Interval(-load.low, np.inf) if family(name) in SLIPS and np.isfinite(load.low) else ANYTHING


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
    spec: Conveyor,
    line: BeltLine,
    loads: Mapping[str, Estimate],
    change: Change,
    slowing: float,
    off: bool = False,
    asked: int = 0,
) -> dict[str, Interval]:
    """How far loads may be off when tensions may be off by `change`, of any scene and any number of drives.

    The run-off tension of a constant take-up does not move unless `off` says so. Grip follows from the tensions at its
    drum (`traction.bounds`); where it still holds, nothing slips. An imposed speed asks of the
    drives at `asked` ends of the belt a force that both tensions there enter. The mean of all that moves follows
    Newton's law whatever the waves are, so the head's way is off by no more than the belt is stretched, and its time to
    rest by what a wave of that size makes of its speed; a belt that slips on its braked pulley has neither bound:

        ds <= change L_loop/EA        dt <= 2 change/(Z |a|),   a the `slowing` of the rigid body [m/s^2]

    The speed of a wave of that size is 2 change/Z at most.
    """
    found: dict[str, Interval] = {}
    exponents = grips(spec)
    turning = {of(MOTOR_SPEED, name): turns(drive) for name, drive in spec.all_drives.items()}
    fixed = off or not line.keeps_run_off
    most = max(change.largest, change.smallest)
    stretch = most * (line.back.length + line.carry.length) / line.stiffness
    least = min(line.impedance(RETURN), line.impedance(CARRY))
    delay = 2 * most / (least * slowing) if slowing > 0 else np.inf
    several = sum(name.startswith("tension_run_off_min[") for name in loads) > 1
    slips = any(family(name) == "slip_utilisation_max" and one.value > 1 for name, one in loads.items())

    def grip(name: str) -> Interval:
        there = change.at_grip if _grips(name, loads) else max(most, change.at_grip)
        off = there if fixed or several else 0.0
        return moved_grip(name, loads, line.centrifugal_at_speed, exponents, there, off)

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
        elif kind in DRIVE_OF_STOP and asked:
            found[name] = moved_braking(line, loads, 2 * asked * most)[kind]
        elif kind in OF_BRAKES:
            found[name] = anything(name, estimate) if slips else moved_heat(spec, name, stretch)
        elif kind in WAYS_OF_STOP or kind in TAKEUP_WAYS or kind == RUN_BACK_DISTANCE:
            found[name] = Interval(-stretch, stretch)
        elif kind in (RUN_BACK_SPEED, BELT_SPEED):
            found[name] = Interval(-2 * most / least, 2 * most / least)
        elif kind == MOTOR_SPEED:
            found[name] = Interval(-2 * most / least * turning[name], 2 * most / least * turning[name])
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


def moved_braking(line: BeltLine, loads: Mapping[str, Estimate], change: float) -> dict[str, Interval]:
    """The force with which the drives of a controlled stop hold the belt, the reserve of the available one over it, and
    the power that comes back: at most that of the force at the speed of the belt."""
    needed, reserve = loads[BRAKING_FORCE].value, loads[BRAKING_RESERVE].value
    either = Interval(-change, change)
    found = {BRAKING_FORCE: either, BRAKING_POWER: Interval(-change * line.speed, change * line.speed)}
    if not np.isfinite(reserve):
        return found | {BRAKING_RESERVE: NOTHING if needed + change <= 0 else ANYTHING}
    available = reserve * needed
    ends = [available / (needed + change), available / (needed - change) if needed > change else np.inf]
    return found | {BRAKING_RESERVE: around(reserve, ends)}


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
    """The largest sag is that of one strand, or of one length with its own load, at its lowest tension; the others have
    no less tension than it takes for as much sag, nor less than the lowest of all."""
    ratio = loads["sag_relative_max"].value
    lowest = loads["tension_min"].value if "tension_min" in loads else -np.inf
    highs, lows = [], []
    spans = (line.back.span_weight, line.carry.span_weight)
    for span in {*line.back.span_weights, *line.carry.span_weights} if line.by_length else spans:
        if span:
            tension = float(sag.tension_at_sag(span, ratio))
            highs.append(float(sag.sag_ratio(span, max(tension, lowest) - change)))
            if tension >= lowest * (1 - _SAME):
                lows.append(float(sag.sag_ratio(span, tension + change)))
    return around(ratio, [max(highs), min(lows, default=0.0)])


def around(value: float, ends: list[float]) -> Interval:
    """The offsets of some values from one that lies among them."""
    return Interval(
        min([offset(end, value) for end in ends] + [0.0]), max([offset(end, value) for end in ends] + [0.0])
    )


def offset(end: float, value: float) -> float:
    """How far an end of an interval lies from a value in it; 0 of equal ones, infinite ones too."""
    return 0.0 if end == value else end - value
