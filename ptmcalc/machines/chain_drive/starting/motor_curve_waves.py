"""A start of the elastic chain under motors whose torque depends on time and on the speed of the sprocket."""

import math
from dataclasses import dataclass, replace

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.memory import kept_for
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Finding, Found, History, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.chain_drive.machine import loops
from ptmcalc.machines.chain_drive.machine.alike import moving_alike
from ptmcalc.machines.chain_drive.machine.model import FloatArray, shares_torque
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Start
from ptmcalc.machines.chain_drive.starting.bounds import TENSIONS, loads_of, static_at
from ptmcalc.machines.chain_drive.starting.motion import StartCase, ratios, sprocket_mass, start_case
from ptmcalc.machines.chain_drive.starting.motor_force import StartForce, gear_of, stands_still, start_force
from ptmcalc.machines.chain_drive.starting.rigid_curve import rigid_start
from ptmcalc.machines.chain_drive.starting.waves import (
    TORQUE_SHARED,
    Sections,
    beyond_slack,
    felt,
    natural_frequencies,
    position_of,
    sections_of,
    travel_time,
)
from ptmcalc.numerics import driven_modes
from ptmcalc.numerics.driven_body import MOST_STEPS, Body, Followed, Gear, Places, Plan

_MODES = 24
"""Modes at the coarsest level, twice as many at each finer one. A numerical choice: the rest is bounded and added. More
narrow the error bar and take longer."""
_UNRESOLVED = 0.05
"""Share of the modes in the speed of the drive that turn by more than `_TURN` in the longest step at the coarsest level
[1]; a quarter of it at each finer one. A numerical choice: the difference from steps twice as long is in the error bar.
A smaller share takes more steps."""
_TURN = 0.5
"""That angle [rad]."""
RESPONSE = 1.0
"""Longest step relative to the time constant of drive mass and steepest torque of a stage [1]. A numerical choice:
longer steps ring about the operating point."""
LEFT = 1e-3
"""Tension that may be left to come at the end of a run, relative to the static tension at the entering strand [1]. A
numerical choice, in the error bar. A smaller value follows the chain longer."""
ORDERS = 0.5, 2.0
"""Observed orders of convergence on which the error of the step is judged; the theoretical one is 2."""
_SPEEDS = 0.2, 0.4, 0.6, 0.8
"""Shares of the largest speed of the rigid chain between which the extremes are kept apart [1]: teeth add little to
tensions at a low speed. A numerical choice: more narrow the error bar of a start with teeth."""
_START_TIMES = 3.0
"""Predicted time until a chain runs steadily relative to the start time at mean torque [1], for the predicted cost."""
_PERIODS = 3.0
"""Periods of the lowest mode in that time [1]."""
_SECONDS = 1.5e-5
"""Predicted seconds per step; measured once. Only its ratio to those of other solvers matters: a wrong value changes
their order, no load."""
_PER_SAMPLE = 1.5e-9
"""Predicted seconds per sample, mode and section; measured once, with the same use."""


@dataclass(frozen=True, slots=True)
class CurveStart:
    """A start on a curve as the march takes it: body, gear, force, longest step, times between which the extremes are
    kept apart: the rigid chain reaches shares of its speed there [s]."""

    case: StartCase
    force: StartForce
    body: Body
    gear: Gear
    step: float
    marks: tuple[float, ...]


def curve_start_of(spec: ChainDrive, scene: Start, level: int) -> CurveStart:
    """The start of this chain drive with the modes of a level."""
    case = start_case(spec, scene)
    force, loop = start_force(spec, case), case.masses
    w = natural_frequencies(case, felt(spec, scene, case, _MODES << level))
    shares, rest = loops.drive_mobilities(loop, w)
    gear = gear_of(spec, case)
    spare = max(gear.mass * (1 / (1 - gear.extra) - 1), 0.0)
    body = Body(loop.total_mass, w, ratios(spec, scene, w), shares, rest, spare)
    step = _TURN / _resolved(w, shares, _UNRESOLVED / 4**level)
    rises = [force.motors.fill, *force.kinks]
    step = min([step, *(rise / 16 for rise in rises if rise > 0)])
    rigid = rigid_start(spec, scene)
    return CurveStart(case, force, body, gear, step, () if rigid is None else rigid.reached(_SPEEDS))


def _resolved(w: FloatArray, shares: FloatArray, left: float) -> float:
    """The lowest frequency up to which the modes make up all of the speed of the drive but a share [rad/s]."""
    speeds = np.cumsum(shares / w)
    return float(w[min(int(np.searchsorted(speeds, (1 - left) * speeds[-1])), len(w) - 1)])


def _places(spec: ChainDrive, start: CurveStart, sections: Sections) -> Places:
    """Entering tension, force through the shaft of the sprocket, tensions at sections."""
    loop, w, case = start.case.masses, start.body.frequencies, start.case
    whole = loop.total_mass
    all_places: Sections = ((CARRY, np.ones(1)), *sections)
    gains = np.concatenate([loops.modal_tensions(loop, w, *one) for one in all_places], axis=1)
    quasi = np.concatenate([loops.quasi_static(loop, *one) for one in all_places])
    rest = np.concatenate([loops.modal_rest(loop, w, *one) for one in all_places])
    masses = np.concatenate([loops.swung_mass(loop, *one) for one in all_places])
    behind = start.gear.mass
    gains = np.concatenate(
        [gains[:, :1] / whole, behind * start.body.mobilities[:, None], gains[:, 1:] / whole], axis=1
    )
    return Places(
        gains,
        np.concatenate([quasi[:1] / whole, [1 - behind / whole], quasi[1:] / whole]),
        np.concatenate([rest[:1] / whole, [behind * start.body.left_out], rest[1:] / whole]),
        np.concatenate([masses[:1], [case.line.moving_mass + sprocket_mass(spec)], masses[1:]]),
    )


ON, SHAFT, ALONG = 0, 1, 2
"""Places of a march: entering tension, force through the sprocket shaft, first of the sections."""


@dataclass(frozen=True, slots=True)
class Judged:
    """A start with its bars: dynamic tension at the entering strand, largest and smallest force through the sprocket
    shaft, smallest tension anywhere, bound of the largest leaving tension [N]; ends of the parts of the start [s],
    bounds of the dynamic entering tension and of the smallest tension in each [N], what may come of both after the end;
    where and when they act."""

    dynamic: Estimate
    most: Estimate
    least: Estimate
    smallest: Estimate
    leaving: float
    parts: tuple[tuple[float, float, float], ...]
    late: tuple[float, float]
    times: tuple[float, float]
    where: dict[str, float]
    end: float
    steady: bool
    steps: int
    order: float
    sections: int


def judged(spec: ChainDrive, scene: Start, level: int) -> Judged:
    """The start at a level.

    Raises:
        NumericsError: NUM101 where it takes too many steps.
    """
    found = _judged(*moving_alike(spec, scene), level)
    if isinstance(found, NumericsError):
        raise found
    return found


@kept_for(16)
def _judged(spec: ChainDrive, scene: Start, level: int) -> Judged | NumericsError:
    """`judged`, or what it raises."""
    start = curve_start_of(spec, scene, level)
    steps = _steps(start)
    if steps > MOST_STEPS:
        return NumericsError("NUM101", f"{steps:.3g} steps until the chain runs steadily")
    try:
        return _marched(spec, scene, start)
    except NumericsError as error:
        return error


def _steps(start: CurveStart) -> float:
    """Predicted steps until the chain runs steadily."""
    case, force = start.case, start.force
    window = _START_TIMES * (case.end if math.isfinite(case.end) else 0.0)
    window += max([3 * force.motors.fill, *force.kinks]) + _PERIODS * 2 * math.pi / float(start.body.frequencies[0])
    steep = max(force.steepest(stage) for stage in range(len(force.motors.stages)))
    step = min(start.step, RESPONSE * start.body.drive_mass / steep) if steep > 0 else start.step
    return window / step


def _marched(spec: ChainDrive, scene: Start, start: CurveStart) -> Judged:
    """The start at a level: four marches, and what their differences and bounds make of the loads.

    The error of the step is the difference of the extremes from those of steps twice as long over 2^p - 1, p the
    observed order; that of the modes whose speed the drive does not follow is the difference from half as many, over
    the ratio of their mobilities.
    """
    case, count = start.case, len(start.body.frequencies)
    sections = sections_of(case, count)
    places = _places(spec, start, sections)
    left = LEFT * abs(case.line.run_on)
    plan = Plan(start.force.release, start.step, RESPONSE, left, count, scene.window_factor, marks=start.marks)
    fine = _follow(start, places, plan)
    short = replace(plan, latest=fine.end, longer=1.0)
    middle, coarse = (_follow(start, places, short.coarser(factor)) for factor in (2, 4))
    fewer = _follow(start, places, replace(short.coarser(4), felt=max(count // 2, 1)))
    first, second = _apart(fine, middle), _apart(middle, coarse)
    order = min(max(math.log2(second / first), ORDERS[0]), ORDERS[1]) if 0 < first < second else ORDERS[0]
    off = (first / (2**order - 1) if first else 0.0) + unfollowed(start.body, count // 2) * _apart(coarse, fewer)
    return _with_bars(start, sections, fine, off, order)


def _follow(start: CurveStart, places: Places, plan: Plan) -> Followed:
    return driven_modes.follow(start.body, start.gear, start.force, places, plan)


def _apart(one: Followed, other: Followed) -> float:
    """Largest difference of an extreme of two marches [N]."""
    return max(float(np.abs(one.largest - other.largest).max()), float(np.abs(one.smallest - other.smallest).max()))


def unfollowed(body: Body, half: int) -> float:
    """Share of the modes left out in the speed of the drive, relative to the upper half of those taken [1]."""
    taken = float(np.sum(body.mobilities[half:] / body.frequencies[half:]))
    return body.left_out / float(body.frequencies[-1]) / taken if taken > 0 else 1.0


def _with_bars(start: CurveStart, sections: Sections, found: Followed, off: float, order: float) -> Judged:
    """The loads of a march with all of their bars."""
    case, after = start.case, found.after

    def estimate(place: int, sign: int, base: float) -> Estimate:
        value = float(found.largest[place] if sign > 0 else -found.smallest[place])
        high = float(found.largest_high[place] if sign > 0 else -found.smallest_low[place])
        low = max(float(found.largest_low[place] if sign > 0 else -found.smallest_high[place]) - off, 0.0)
        numerical, late = max(high + off - value, value - low), float(after[place])
        more = max(late - high - off, 0.0)
        ends = base + sign * low, base + sign * (max(high, value) + off + more)
        return Estimate(base + sign * value, min(ends), max(ends), numerical, more)

    static = np.concatenate([static_at(case, strand, x) for strand, x in sections])
    values = static + found.smallest[ALONG:]
    which = int(values.argmin())
    between = between_sections(start, sections, found)
    lows = static + np.minimum(found.smallest_low[ALONG:] - between, 0.0)
    least, late = float(lows.min()) - off, float((static - after[ALONG:]).min())
    value = float(values[which])
    high = min(float((static + found.smallest_high[ALONG:]).min()) + off, float(static.min()))
    bar = max(value - least, high - value)
    smallest = Estimate(value, min(least, late), max(high, value), numerical=bar, model=max(least - late, 0.0))
    base = case.line.static_resistance
    return Judged(
        estimate(ON, 1, 0.0),
        estimate(SHAFT, 1, base),
        estimate(SHAFT, -1, base),
        smallest,
        case.line.run_off + float(max(found.largest_high[ALONG], after[ALONG])) + off,
        _by_parts(start, static, found, off, between),
        (float(after[ON]), float(after[ALONG:].max())),
        (float(found.largest_time[ON]), float(found.largest_time[SHAFT])),
        {"time": float(found.smallest_time[ALONG + which]), "position": position_of(case, sections, which)},
        found.end,
        found.steady,
        found.steps,
        order,
        len(static),
    )


def _by_parts(
    start: CurveStart, static: FloatArray, found: Followed, off: float, between: float
) -> tuple[tuple[float, float, float], ...]:
    """Bounds of the loads between the marks of a march, `Judged.parts`; the last part has no end."""
    ends = [*start.marks, math.inf]
    parts = []
    for j, end in enumerate(ends):
        late = found.after if j == len(ends) - 1 else np.zeros_like(found.after)
        high = float(max(found.parts_high[j][ON] + off, late[ON]))
        low = np.minimum(found.parts_low[j][ALONG:] - between - off, -late[ALONG:])
        parts.append((end, high, float((static + np.minimum(low, 0.0)).min())))
    return tuple(parts)


def between_sections(start: CurveStart, sections: Sections, found: Followed) -> float:
    """What a tension can fall between two sections: an eighth of its bend, |M_k''| <= (w t)^2 |M_k| [N]."""
    loop, w = start.case.masses, start.body.frequencies
    worst = 0.0
    for strand, x in sections:
        gains = np.abs(loops.modal_tensions(loop, w, strand, x)).max(axis=1) / loop.total_mass
        bend = (w * travel_time(start.case, strand) * float(x[1])) ** 2 / 8
        worst = max(worst, float(np.sum(bend * gains * found.swings)))
    return worst


def run(spec: ChainDrive, scene: Start, carried: frozenset[str], level: int) -> Result:
    """Tensions of a start whose motors follow their curve, by modes of the chain and the drive.

        m V' = f,   y_k'' + 2 zeta w y_k' + w^2 y_k = f,   v = V + sum g_k y_k',   f = e M(t, v) i/R - W
        S(s) = S_static(s) + (r(s) f - sum M_k(s) y_k'')/m

    v is the speed of the sprocket, M_k and r as in `chain_start_waves`, g_k of `chain_resonance.drive_mobilities`. The
    chain is held until the motors pull more than it resists. The gear loses e = eta or 1/eta by the sign of the force
    that it transmits. The chain is followed down the curve to the operating speed of the motors. Sprockets of a driven
    tail that are synchronised are one mass with the drive (`laws.held_strands`).

    **Range** a taut chain that slides forward; hysteretic and Zener damping by the ratio of each mode.
    **Error** samples, neglected modes, sections and the time after the end by bounds; steps by halving with the
    observed order, and the modes whose speed the drive does not follow by halving their number.
    **Source** derived in `numerics.driven_modes`; torque of the motors as in `chain_rigid_start`.
    """
    if valid(spec, scene).exceeded:
        raise NumericsError("NUM102", "the drive does not move the chain: there is no motion to compute")
    found, case = judged(spec, scene, level), start_case(spec, scene)
    at = {"time": found.times[0]}
    loads = {name: Found(load, at) for name, load in loads_of(spec, case, found.dynamic, None).items()}
    loads["tension_min"] = Found(found.smallest, found.where)
    findings: tuple[Finding, ...] = ()
    if not found.steady:
        message = f"the chain does not run steadily after {found.end:.4g} s: the error bar includes what may follow"
        findings = (Finding("NUM112", message),)
    result = Result(
        loads,
        work=found.steps,
        window=(0.0, found.end),
        health={"modes": float(_MODES << level), "sections": float(found.sections), "order": found.order},
        findings=findings,
        histories=lambda: histories(spec, scene, level),
    )
    return beyond_slack(spec, result, "CHN123")


def histories(spec: ChainDrive, scene: Start, level: int) -> dict[str, History]:
    """Entering tension and speed of the sprocket over time."""
    start = curve_start_of(spec, scene, level)
    count = len(start.body.frequencies)
    places = _places(spec, start, ((RETURN, np.zeros(1)),))
    left = LEFT * abs(start.case.line.run_on)
    plan = Plan(start.force.release, start.step, RESPONSE, left, count, keep=True)
    found = _follow(start, places, plan)
    seen = np.concatenate([np.zeros((1, 2)), *found.samples])
    peak = int(seen[:, 1].argmax())
    kept = np.unique(np.concatenate([np.arange(0, len(seen), max(len(seen) // SHOWN, 1)), [peak, len(seen) - 1]]))
    times, order = np.unique(seen[kept, 0], return_index=True)
    tensions = start.case.line.run_on + seen[kept, 1][order]
    return {"tension_start": History(units.FORCE, times.tolist(), tensions.tolist())}


SHOWN = 2000
"""Samples of a history; a numerical choice. More draw it more smoothly and need memory; no load depends on them."""


def valid(spec: ChainDrive, scene: Start) -> Criterion:
    """Whether the start follows the curve of motors that move the chain.

        n = 1 for a start without a curve, + 1 for motors that never pull more than the chain resists at standstill,
        or 1 for a torque shared with a drive of the tail

    **Range** any start.
    **Error** exact: a count.
    **Source** Newton's law.
    """
    case = start_case(spec, scene)
    if case.follows_curve and shares_torque(spec):
        return TORQUE_SHARED
    count = (not case.follows_curve) + (case.follows_curve and stands_still(spec, case))
    meaning = "no motor curve, insufficient torque at standstill: none of them"
    return Criterion("n", float(count), 1.0, meaning, "count")


def _cost(spec: ChainDrive, scene: Start, carried: frozenset[str], level: int) -> float:
    """Predicted seconds; a start that takes more steps than are allowed ends at once."""
    if valid(spec, scene).exceeded:
        return 0.0
    start = curve_start_of(spec, scene, level)
    count, case = len(start.body.frequencies), start.case
    steps = _steps(start)
    if steps > MOST_STEPS:
        return 2e-2
    fastest = float(start.body.frequencies[-1])
    samples = steps * max(start.step * fastest / _TURN, 1.0)
    sections = sum(len(x) for _, x in sections_of(case, count))
    return 2e-2 + 2 * (_SECONDS * steps + _PER_SAMPLE * samples * count * sections)


_CARRIED = frozenset({"chain_elasticity", "higher_modes"})
MOTOR_WAVES: Solver[ChainDrive, Start] = Solver(
    name="chain_motor_waves",
    title="start on the motor curve, modes of chain and drive",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({Start}),
    represents=_CARRIED,
    gives=frozenset(TENSIONS),
    run=run,
    cost=_cost,
    source="derived in ptmcalc.numerics.driven_modes",
    valid=valid,
    always=_CARRIED,
    levels=2,
)
