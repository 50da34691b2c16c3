"""Error bars of a start by characteristics, from two grids or three."""

import math
from dataclasses import dataclass

import numpy as np

from ptmcalc.machines.conveyor.machine.model import FloatArray
from ptmcalc.machines.conveyor.machine.start_case import StartCase
from ptmcalc.numerics import loop, peaks

_MARGIN, _SLIP_MARGIN, _SAGGING_MARGIN = 1.5, 2.0, 3.0
"""Safety factors on errors estimated from grids [1]; numerical choices. `_MARGIN`: at second order. `_SLIP_MARGIN`:
with slip, where the order is lost. `_SAGGING_MARGIN`: with sag, whose fronts are steep. Smaller values lose the safety
of the bar; larger ones widen it."""
_SHIFT_STEPS = 2
"""Coarse steps by which a steep front may be displaced between two grids without a gap [1]. A numerical choice. A
larger value hides real gaps; a smaller one reports the height of a displaced front as an error."""
_SECOND_ORDER, _SLOWEST = 0.25, 0.9
"""Limits of the ratio of the differences of three grids [1]; numerical choices. `_SECOND_ORDER`: minimum, 1/4 at second
order, as two grids may agree by chance. `_SLOWEST`: maximum, of grids that converge slowly. Larger values widen the
error bar."""


@dataclass(frozen=True, slots=True)
class Bars:
    """Numerical error of tensions at the drum's run-on and run-off [N], and of the extremes inside the strands in the
    order of `inside_extremes`."""

    on: float
    off: float
    inside: tuple[float, ...]


def straight_bars(case: StartCase, coarse: loop.Motion, fine: loop.Motion) -> Bars:
    """Bars of a grid and its refinement, from the waves all tensions are sums of and from the extremes themselves.

    Histories that differ by at most d have extremes that differ by at most d, and every tension is half a sum of the
    waves that leave drum, tail and take-up. With d the largest difference of those waves on both grids, a third of it
    is the error of the finer grid at second order, and 1.5 times that is the bar. Where slip begins between grid
    lines the order is lost: the bar is twice d, and what corners between samples may hide inside the strands
    (`Extreme.missed`). No bar is below the difference of the extreme itself on both grids. The mismatch of the travel
    times shifts every echo by at most that part of the elapsed time: that shift times the steepest slope is added.
    """
    waves = _wave_error(coarse, fine) * (_SLIP_MARGIN if fine.slipped else _MARGIN / 3)
    waves += _shift_error(fine, case.window)
    on, off = (max(waves, *_end_errors(coarse, fine, end)) for end in ("run_on", "run_off"))
    apart = _inside_errors(coarse, fine)
    missed = [waves + extreme.missed * fine.slipped for extreme in inside_extremes(fine)]
    inside = tuple(max(on, off, *both) for both in zip(apart, missed, strict=True))
    return Bars(on, off if case.line.fixed_length else 0.0, inside)


def _end_errors(coarse: loop.Motion, fine: loop.Motion, end: str) -> list[float]:
    """Differences of the extremes at one end of the drum as they are reported, on both grids [N]."""
    one, other = getattr(coarse, end), getattr(fine, end)
    top, bottom = coarse.largest(one)[0] - fine.largest(other)[0], coarse.smallest(one)[0] - fine.smallest(other)[0]
    return [abs(top), abs(bottom)]


def _inside_errors(coarse: loop.Motion, fine: loop.Motion) -> list[float]:
    """Differences of the extremes inside the strands on both grids [N]."""
    return [
        abs(one.value - other.value) for one, other in zip(inside_extremes(coarse), inside_extremes(fine), strict=True)
    ]


def sagging_bars(case: StartCase, coarsest: loop.Motion, coarse: loop.Motion, fine: loop.Motion) -> Bars:
    """Bars of a grid and its refinements where fronts are steep.

    The extremes of all three grids are compared: with d the last difference and r its ratio to the one before, the
    differences still to come sum up to d r/(1 - r). The bar of an extreme is three times that, with r not taken below
    1/4 (second order; two grids may agree by chance) nor above 0.9, and inside the strands no less than at the drum.

    At the drum, whose history decides about slip at every moment, two more hold. A steep front that moves a little
    differs by its whole height, which no extreme does: every value of one history is looked for among the values of
    the other within a few steps, and one and a half times the largest gap is the bar. It is never below what the
    history bends between two samples at its extremes.
    """
    reach = math.ceil(_SHIFT_STEPS * coarse.grid.step / fine.grid.step)

    def still_to_come(before: float, last: float) -> float:
        last = max(last, _SECOND_ORDER * before)
        ratio = min(last / before, _SLOWEST) if before > 0 else _SECOND_ORDER
        return _SAGGING_MARGIN * last * ratio / (1 - ratio)

    def end(name: str) -> float:
        one, other = getattr(coarse, name), getattr(fine, name)
        again = np.interp(fine.times, coarse.times, one)
        apart = max(peaks.gap(other, again, reach), peaks.gap(again, other, reach))
        errors = map(still_to_come, _end_errors(coarsest, coarse, name), _end_errors(coarse, fine, name))
        return max(_MARGIN * apart, *errors)

    least = _bend(fine.run_on)
    on, off = max(end("run_on"), least), end("run_off")
    off = max(off, least) if case.line.fixed_length else 0.0
    inside = map(still_to_come, _inside_errors(coarsest, coarse), _inside_errors(coarse, fine))
    return Bars(on, off, tuple(max(error, on, off) for error in inside))


def _bend(history: FloatArray) -> float:
    """What a history does between the samples next to its extremes: an eighth of the second difference."""
    second = np.abs(np.diff(history, 2)) / 8
    near = [abs(second[max(top - 2, 0) : top + 2]).max(initial=0.0) for top in (history.argmax(), history.argmin())]
    return float(max(near))


def inside_extremes(motion: loop.Motion) -> tuple[loop.Extreme, ...]:
    return motion.carry_max, motion.carry_min, motion.back_max, motion.back_min


def _wave_error(coarse: loop.Motion, fine: loop.Motion) -> float:
    """Largest difference of a tension on a grid and on its refinement [N]."""
    n = min(coarse.waves.shape[1], (fine.waves.shape[1] + 1) // 2)
    both = np.abs(fine.waves[:, : 2 * n - 1 : 2] - coarse.waves[:, :n]).max(axis=1)
    pairs = (both[0] + both[1], both[2] + both[3])  # a tension is half the sum of the two waves of its strand
    return float(max(pairs)) / 2


def _shift_error(motion: loop.Motion, window: float) -> float:
    """Mismatch of the travel times, as a time shift of all echoes, times the steepest slope of the waves [N]."""
    slope = np.abs(np.diff(motion.waves, axis=1)).max(axis=1) / motion.grid.step
    return float(max(slope[0] + slope[1], slope[2] + slope[3])) / 2 * motion.grid.mismatch * window
