"""Way and heat of slip of the one drum of a plain start, from its histories on grids of halved step.

    s = integral |v_d - v_b| dt        Q = integral (S_on - S_off)(v_d - v_b) dt

**Bar from the grids.** The integrals of two histories differ by at most the integral of what the histories differ by.
That one, D = integral | |u_f| - |u_c| | dt with the coarse history straight between its samples, never vanishes by
chance as the difference of two ways can, and holds what the trapezium leaves out. Slip comes and goes between samples,
so the error is of first order: that of the finer of two grids is D, and the bar is twice that; of three grids it is
what is still to come (`characteristics`).

**Slip within the bars.** What the tensions may be off by, b_t and b_s, all grids may share: travel times that do not
quite match. Where the drum sticks with its tensions that near to the limit of its grip, it may slip in truth; where
it slips, faster or slower. With X what the tight side may exceed the grip by, in newtons at the slack side, the belt
lags behind by w more until friction holds with equality, and the drum, rid of that force, runs away by d:

    X = q (S_t + b_t - l) - (S_s - b_s - l),   q = exp(-mu alpha)
    q (S_t - Z_t w) = S_s + Z_s w   =>   w = X/(q Z_t + Z_s),      m d' = (Z_t + Z_s) w,      u = w + d >= 0

It is over where u comes back to 0; an imposed speed leaves d at 0. Twice this slip is added for the echoes of the
change, which this leaves out.
"""

import itertools
import math
from collections.abc import Callable

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, of
from ptmcalc.laws import slip_heat
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.machine.model import FloatArray
from ptmcalc.machines.conveyor.machine.start_case import StartCase
from ptmcalc.numerics.loop import Motion

_MARGIN = 2.0
"""Safety factor on the difference of two grids at first order, and on slip within the error bars of the tensions [1]. A
numerical choice for echoes that the estimate neglects. A smaller value loses the safety of the bar; a larger one widens
it."""
_THREE, _SECOND_ORDER, _SLOWEST = 3.0, 0.25, 0.9
"""Error bar from three grids; numerical choices, as in `characteristics`. `_THREE`: safety factor on the sum of the
differences still to come [1]. `_SECOND_ORDER`: minimum ratio of two differences, 1/4 at second order, as two grids may
agree by chance. `_SLOWEST`: maximum ratio. Larger values widen the bar."""
_ALL_GRIP = 460.0
"""Upper limit of the exponent mu alpha [1]. Resolution of the floating point: e^460 exceeds any ratio of tensions. A
smaller value limits strong traction; a larger one may overflow."""


def slip_loads(
    case: StartCase, drive: str, exponent: float, motions: list[Motion], bars: tuple[float, float]
) -> dict[str, Found]:
    """Way [m] and heat [J] of the slip of a drive; `bars` are those of run-on and run-off [N]."""
    fine = motions[-1]
    pull = fine.run_on - fine.run_off
    way = slip_heat.slip_distance(fine.times, fine.drum_speed, fine.belt_speed)
    heat = slip_heat.slip_heat(fine.times, pull, fine.drum_speed, fine.belt_speed)
    hidden = _within(case, exponent, fine, bars)
    found = {}
    for name, value, of_motion, more in (
        ("slip_distance", way, _sliding, hidden),
        ("slip_heat", heat, _burning, hidden * (np.abs(pull) + sum(bars))),
    ):
        bar = _bar(motions, of_motion) + _MARGIN * float(np.trapezoid(more, fine.times))
        found[of(name, drive)] = Found(Estimate(value, max(value - bar, 0.0), value + bar, numerical=bar))
    return found


def _sliding(motion: Motion) -> FloatArray:
    """How fast the rim slides under the belt [m/s]."""
    return np.abs(motion.drum_speed - motion.belt_speed)


def _burning(motion: Motion) -> FloatArray:
    """Power of its friction [W]."""
    return np.abs(motion.run_on - motion.run_off) * _sliding(motion)


def _bar(motions: list[Motion], history: Callable[[Motion], FloatArray]) -> float:
    """Bar of the integral of a history of the last grid, from two grids or three."""
    apart = [_between(coarse, fine, history) for coarse, fine in itertools.pairwise(motions)]
    if len(apart) == 1:
        return _MARGIN * apart[0]
    before, last = apart
    last = max(last, _SECOND_ORDER * before)
    ratio = min(last / before, _SLOWEST) if before > 0 else _SECOND_ORDER
    return _THREE * last * ratio / (1 - ratio)


def _between(coarse: Motion, fine: Motion, history: Callable[[Motion], FloatArray]) -> float:
    """Integral of what the histories of two grids differ by."""
    again = np.interp(fine.times, coarse.times, history(coarse))
    return float(np.trapezoid(np.abs(history(fine) - again), fine.times))


def _within(case: StartCase, exponent: float, motion: Motion, bars: tuple[float, float]) -> FloatArray:
    """Slip speed that the bars of the tensions leave open [m/s]."""
    line, squeeze = case.line, math.exp(-min(exponent, _ALL_GRIP))
    carry, back = line.impedance(CARRY), line.impedance(RETURN) if line.fixed_length else 0.0
    lift = line.belt_line_mass * motion.belt_speed**2
    on, off = motion.run_on - lift, motion.run_off - lift
    found = np.zeros_like(on)
    for tight, slack, (tight_bar, slack_bar), (ahead, behind) in (
        (on, off, bars, (carry, back)),
        (off, on, bars[::-1], (back, carry)),
    ):
        lags = (squeeze * (tight + tight_bar) - (slack - slack_bar)) / (squeeze * ahead + behind)
        mass = math.inf if case.imposed_speed else line.drive_mass
        free = motion.drum_speed < line.speed  # else the motor holds the drum, whatever the belt does
        found += _runs_away(lags, np.where(free, (carry + back) / mass, 0.0), motion.grid.step)
    return found


def _runs_away(lags: FloatArray, rates: FloatArray, step: float) -> FloatArray:
    """u = w + d with d' = rate w, from where w rises above 0 until u is back at 0."""
    found = np.zeros_like(lags)
    if not (lags > 0).any():
        return found
    ahead = 0.0
    for k, (lag, rate) in enumerate(zip(lags.tolist(), rates.tolist(), strict=True)):
        if ahead + lag > 0:
            found[k] = ahead + lag
            ahead += step * rate * lag
        else:
            ahead = 0.0
    return found
