"""Loads that follow from the tensions of the belt: traction, safety, sag, and those of a belt that runs evenly."""

from dataclasses import dataclass

import numpy as np

from ptmcalc.laws import capstan, sag
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.machine.model import BeltLine, FloatArray
from ptmcalc.numerics.lanes import value

_STRANDS = (RETURN, CARRY)


@dataclass(frozen=True, slots=True)
class Sides:
    """Tensions at the drum that slip is judged by [N]: run-on, run-off, centrifugal."""

    on: float
    off: float
    lift: float


def slip_loads(exponent: float, states: list[Sides]) -> dict[str, float]:
    """Worst utilisation and reserve of grip over some states of the drum, in whichever sense it is loaded."""
    sides = [(max(state.on, state.off), min(state.on, state.off), state.lift) for state in states]
    return {
        "slip_utilisation_max": max(
            value(capstan.slip_utilisation, tight, slack, lift, exponent) for tight, slack, lift in sides
        ),
        "slip_reserve_min": min(value(capstan.slip_reserve_force, tight, slack, exponent) for tight, slack, _ in sides),
    }


Spans = list[tuple[float, float]]
"""Weight on one idler pitch and the lowest tension of some lengths of the belt [N]."""


def spans_at(line: BeltLine, tensions: tuple[tuple[FloatArray, FloatArray], ...]) -> Spans:
    """Every length of both strands with its lowest tension, of places from the upstream end of the return and of the
    carrying strand [m] and the lowest tensions there [N]; nothing without idler pitches, or where one load lies on the
    whole belt."""
    strands = (line.back, line.carry)
    if not line.by_length or not all(strand.span_weights for strand in strands):
        return []
    found: Spans = []
    for strand, (places, lowest) in zip(strands, tensions, strict=True):
        at_marks = np.interp(strand.marks, places, lowest)
        for k, span in enumerate(strand.span_weights):
            within = lowest[(places >= strand.marks[k]) & (places <= strand.marks[k + 1])]
            found.append((span, float(min(at_marks[k], at_marks[k + 1], within.min(initial=np.inf)))))
    return found


def derived_loads(
    line: BeltLine, tension_max: float, smallest: tuple[float, ...], lengths: Spans | None = None
) -> dict[str, float]:
    """Belt safety, sag and distance from slack that follow from the extreme tensions; `smallest` of return and
    carry strand [N], and where it is known of every length."""
    spans = (line.back.span_weight, line.carry.span_weight)
    loads = {"slack_margin_min": min(low - limit for limit, low in zip(slack_limits(line), smallest, strict=True))}
    if line.breaking_force is not None:
        loads["belt_safety_min"] = line.breaking_force / tension_max if tension_max > 0 else np.inf
    sags = [value(sag.sag_ratio, span, low) for span, low in zip(spans, smallest, strict=True) if span is not None]
    if len(sags) == len(spans):
        loads["sag_relative_max"] = max(sags)
    if lengths:
        loads["sag_relative_max"] = max(value(sag.sag_ratio, span, low) for span, low in lengths)
        loads["slack_margin_min"] = min(low - value(sag.tension_at_sag, span, line.slack_sag) for span, low in lengths)
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
    ends: list[tuple[float, ...]] = [line.static_ends(which) for which in _STRANDS]
    if line.by_length:
        ends = [tuple((line.static_ends(which)[0] + line.strand(which).rises).tolist()) for which in _STRANDS]
    courses = [(np.array(line.strand(which).marks), np.array(ends[which])) for which in _STRANDS if line.by_length]
    loads = {
        "tension_run_on_max": line.run_on,
        "tension_dynamic_run_on_max": 0.0,
        "tension_run_off_min": line.run_off,
        "tension_max": max(map(max, ends)),
        "tension_min": min(map(min, ends)),
    }
    lengths = spans_at(line, tuple(courses)) if courses else None
    return loads | derived_loads(line, loads["tension_max"], tuple(map(min, ends)), lengths)
