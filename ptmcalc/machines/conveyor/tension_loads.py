"""Loads that follow from the tensions of the belt: traction, safety, sag, and those of a belt that runs evenly."""

from dataclasses import dataclass

import numpy as np

from ptmcalc.laws import capstan, sag
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.model import BeltLine
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
