"""Histories, events and findings of a belt in cells."""

from collections.abc import Iterator

import numpy as np

from ptmcalc.base import units
from ptmcalc.contract.result import Event, Finding, History, family, of
from ptmcalc.laws import capstan
from ptmcalc.machines.conveyor.machine.loads import MOTOR_SPEED
from ptmcalc.machines.conveyor.machine.model import FloatArray
from ptmcalc.machines.conveyor.machine.motion import Moving
from ptmcalc.machines.conveyor.waves.cell_loads import speeds_of
from ptmcalc.machines.conveyor.waves.cells import Set
from ptmcalc.machines.conveyor.waves.takeup_stops import sinking
from ptmcalc.numerics.belt.march import Drawn


def histories(case: Moving, drawn: Drawn, ready: Set) -> dict[str, History]:
    """Tensions, grip, speed and slip of every drive, speed of the belt and position of the take-up over time, and the
    extreme tensions over the way round the loop."""
    times = drawn.times.tolist()

    def over_time(values: FloatArray, quantity: units.Quantity = units.FORCE) -> History:
        return History(quantity, times, np.asarray(values, float).tolist())

    found = {
        "tension_run_on_max": over_time(drawn.head.tensions[:, 0]),
        "tension_run_off_min": over_time(drawn.head.tensions[:, -1]),
    }
    names, grips = case.spec.all_drives, []
    for station, history in ((ready.head, drawn.head), (ready.tail, drawn.tail)):
        for index, drum in enumerate(station.drums):
            if drum.name not in names:
                continue
            on, off = history.tensions[:, index], history.tensions[:, index + 1]
            found[of("tension_run_on_max", drum.name)] = over_time(on)
            found[of("tension_run_off_min", drum.name)] = over_time(off)
            apart = np.abs(history.drums[:, index] - history.belt) * (history.slips[:, index] != 0)
            slid = np.concatenate([[0.0], np.cumsum((apart[1:] + apart[:-1]) / 2)]) * float(drawn.times[1])
            found[of("slip_distance", drum.name)] = over_time(slid, units.SPAN)
            given = names[drum.name].drum
            if given.friction is not None:
                lift = case.line.belt_line_mass * history.belt**2
                used = capstan.slip_utilisation(
                    np.maximum(on, off), np.minimum(on, off), lift, given.friction * given.wrap
                )
                used = np.where(history.slips[:, index] != 0, np.maximum(used, 1.0), used)
                found[of("slip_utilisation_max", drum.name)] = over_time(used, units.RATIO)
                grips.append(used)
    if grips:
        found["slip_utilisation_max"] = over_time(np.max(grips, axis=0), units.RATIO)
    for name, speeds in speeds_of(case, drawn, ready).items():
        found[name] = over_time(speeds, units.ANGULAR_SPEED if family(name) == MOTOR_SPEED else units.SPEED)
    if not case.line.fixed_length:
        found["takeup_movement"] = over_time(sinking(case, drawn), units.LENGTH)
    middle = (ready.course.places[1:] + ready.course.places[:-1]) / 2
    found["tension_max"] = History(units.FORCE, middle.tolist(), drawn.highest.tolist(), units.SPAN)
    found["tension_min"] = History(units.FORCE, middle.tolist(), drawn.lowest.tolist(), units.SPAN)
    return found


def findings_of(case: Moving, drawn: Drawn) -> Iterator[Finding]:
    """A belt without idler pitches that goes slack; of one with them, the run with its spans tells more."""
    sags = case.spec.effects.get("sag") != "off"
    for low, strand in ((drawn.back_min, case.line.back), (drawn.carry_min, case.line.carry)):
        if low.value < 0 and not (sags and strand.span_weight):
            yield Finding(
                "NUM102",
                f"the belt goes slack at {low.time:.3g} s, {low.place:.4g} m after the drive pulley; the results of"
                " the time after that are not reliable",
                ("takeup", "tension"),
                "a higher `tension` keeps the belt taut",
            )


def events_of(drawn: Drawn, ready: Set) -> Iterator[Event]:
    """When the drums at head and tail begin and cease to slip."""
    words = {0: "sticks", 1: "slips, faster than the belt", -1: "slips, slower than the belt"}
    found = []
    for station, history in ((ready.head, drawn.head), (ready.tail, drawn.tail)):
        for index, drum in enumerate(station.drums):
            slips = np.concatenate([[0.0], history.slips[:, index]])
            for k in np.flatnonzero(np.diff(slips)).tolist():
                before, after = words[int(slips[k])], words[int(slips[k + 1])]
                found.append(Event(float(drawn.times[k]), drum.name, before, after))
    yield from sorted(found, key=lambda event: event.time)
