"""A chain that changes its speed under its teeth: the rigid body's answer, and every mode tooth after tooth."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.memory import kept_for
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, History, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import polygon, sprocket
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.chain_drive.machine import loops
from ptmcalc.machines.chain_drive.machine.layout import TwoShafts
from ptmcalc.machines.chain_drive.machine.loops import HeldStrands
from ptmcalc.machines.chain_drive.machine.model import (
    FloatArray,
    chain_line,
    has_driven_tail,
    shares_torque,
    tail_teeth,
)
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, SpeedRange, Start
from ptmcalc.machines.chain_drive.machine.strength import safety
from ptmcalc.machines.chain_drive.polygon.excitation import far_place, residual
from ptmcalc.machines.chain_drive.speed_change.teeth import (
    Passing,
    range_passing,
    start_passing,
)
from ptmcalc.machines.chain_drive.starting.bounds import TENSIONS, loads_of, static_at
from ptmcalc.machines.chain_drive.starting.motion import StartCase, start_case
from ptmcalc.machines.chain_drive.starting.waves import (
    TORQUE_SHARED,
    Sections,
    beyond_slack,
    one_section,
    position_of,
    sections_of,
    travel_time,
)
from ptmcalc.numerics import tooth_passes

_LEADS = 2
"""Positions of the first joint within the pitch at the coarsest level; twice as many at each finer one. A numerical
choice: the difference from half as many is in the error bar. More narrow it and take longer."""
_LEADS_HELD = 8
"""The same where each strand is held at both sprockets: every place of a joint stretches it. A numerical choice as
`_LEADS`."""
_MODES = 6
"""Modes that the teeth excite one by one at the coarsest level; twice as many at each finer one. A numerical choice:
the rest is bounded and added. More narrow the error bar and take longer."""
_SECONDS = 4e-6
"""Predicted seconds per place and mode; measured once. Only its ratio to those of other solvers matters: a wrong value
changes their order, no load."""
_PER_SECTION = 1.5e-8
"""Predicted seconds per place, mode and section of the chain; measured once. Only its ratio to those of other solvers
matters: a wrong value changes their order, no load."""


def range_loads(spec: ChainDrive, scene: SpeedRange, dynamic: Estimate) -> dict[str, Estimate]:
    """The loads of a range of speeds, from the largest dynamic tension at the run-on."""
    line = chain_line(spec, scene)
    most, least, value = (line.run_on + one + line.centrifugal for one in (dynamic.high, dynamic.low, dynamic.value))
    middle, low, high = (safety(spec, one) if math.isfinite(one) else 0.0 for one in (value, most, least))
    slope = middle / value if value > 0 else 0.0
    return {"tension_speed_range": dynamic, "safety_start": Estimate(middle, low, high, dynamic.numerical * slope)}


def range_notes(spec: ChainDrive, scene: SpeedRange, carried: frozenset[str], level: int) -> Result:
    """Textbook polygon force at the highest speed of a range.

        S_D = 3 m a_max,   m = (m_G + lambda m_K) L

    **Range** tooth frequencies far below the first natural frequency.
    **Error** no bound: see `polygon.textbook_polygon_force`; it contains no resonance of the range.
    **Source** lecture notes Kramatorsk 2007.
    """
    line = chain_line(spec, scene)
    fastest, working, back = max(scene.start, scene.end), line.working, line.back
    peak = float(polygon.peak_acceleration(fastest, spec.chain.pitch, spec.sprocket.teeth))
    load, share = working.line_mass - back.line_mass, polygon.return_share(working.length)
    mass = polygon.textbook_mass(load, back.line_mass, working.length, share)
    force = polygon.textbook_polygon_force(mass, peak)
    return Result({"tension_speed_range": Found(Estimate.exact(force))}, work=1)


@dataclass(frozen=True, slots=True)
class _Found:
    """Dynamic tensions: the largest at the run-on with its bar and its time, the smallest at every section with its bar
    and its time; what every mode followed at most; the places in time looked at; the leads of the first joint behind
    the largest, and behind the smallest at every section."""

    largest: Estimate
    time: float
    smallest: FloatArray
    smallest_bar: FloatArray
    smallest_time: FloatArray
    followed: FloatArray
    work: int
    lead: float
    smallest_lead: FloatArray
    risen: float
    fallen: float


@dataclass(frozen=True, slots=True)
class TeethAlone:
    """Most that the teeth add to the entering tension or take from it, add to the tension of any section, and take from
    it, each the sum over several motions of a drive [N]; and the work."""

    entering: float
    added: float
    taken: float
    work: int


def teeth_alone(spec: ChainDrive, passings: tuple[Passing, ...], case: StartCase, level: int) -> TeethAlone:
    """The teeth without the mean acceleration of the start, see `teeth.curve_teeth`."""
    entering, added, taken, work = 0.0, 0.0, 0.0, 0
    for one in passings:
        sections = sections_of(case, len(one.frequencies))
        found = _passed(spec, one, sections, level)
        between = 0.0
        for strand, x in sections:
            shapes = np.abs(one.shapes(strand, x)).max(axis=1) / one.masses.belt_mass
            bend = (one.frequencies * travel_time(case, strand) * float(x[1])) ** 2 / 8
            between = max(between, float(np.sum(bend * shapes * found.followed)))
        entering += max(found.largest.high, found.fallen)
        added += found.risen + between
        taken += float((found.smallest_bar - found.smallest).max()) + between
        work += found.work
    return TeethAlone(entering, added, taken, work)


def _leads(passing: Passing) -> int:
    """Positions of the first joint at the coarsest level."""
    return _LEADS_HELD if isinstance(passing.masses, HeldStrands) else _LEADS


def driven_teeth_alone(spec: ChainDrive, passings: tuple[Passing, ...], case: StartCase) -> TeethAlone:
    """The same of the teeth of the driven one of two sprockets; none of a conveyor."""
    if not isinstance(spec.layout, TwoShafts):
        return TeethAlone(0.0, 0.0, 0.0, 0)
    entering, anywhere = 0.0, 0.0
    for one in passings:
        sections = sections_of(case, len(one.frequencies))
        found = _by_the_driven(spec, one, sections)
        found = found + np.concatenate([one.driven_left_out(spec, strand, x) for strand, x in (_RUN_ON, *sections)])
        entering += float(found[0])
        anywhere += float(found[1:].max())
    return TeethAlone(entering, anywhere, anywhere, 0)


def _passed(spec: ChainDrive, passing: Passing, sections: Sections, level: int) -> _Found:
    """Every mode through the passes of the teeth at both ends, for several places of the first joint.

    The joints may stand anywhere when the change begins: the largest counts, and what it differs from that of half as
    many places is in the bar, with what the quadrature, the modes left out and the teeth of a driven sprocket may miss.
    """
    count = _leads(passing) << level
    found = [_ridden(spec, passing, sections, k / count) for k in range(count)]
    tops, lows = (np.array([getattr(one, name) for one in found]) for name in ("largest", "smallest"))
    errors = np.max([one.error for one in found], axis=0)
    errors += np.concatenate([passing.left_out(spec, strand, x) for strand, x in (_RUN_ON, *sections)])
    if isinstance(spec.layout, TwoShafts):
        errors += _by_the_driven(spec, passing, sections)
    if isinstance(passing.masses, HeldStrands):
        errors += _worst_of_the_tail(spec, passing, sections, count)
    high, which = tops[:, 0].max(), int(tops[:, 0].argmax())
    apart = high - min(tops[::2, 0].max(), tops[1::2, 0].max())
    bar = float(errors[0] + apart)
    rows, columns = lows.argmin(axis=0), np.arange(lows.shape[1])
    low_apart = np.maximum(lows[::2].min(axis=0), lows[1::2].min(axis=0)) - lows.min(axis=0)
    return _Found(
        Estimate(float(high), max(float(high) - bar, 0.0), float(high) + bar, numerical=bar),
        float(found[which].largest_time[0]),
        lows[rows, columns][1:],
        (errors + low_apart)[1:],
        np.array([one.smallest_time for one in found])[rows, columns][1:],
        np.max([one.followed for one in found], axis=0),
        sum(one.work for one in found),
        which / count,
        (rows / count)[1:],
        float((tops.max(axis=0) + errors)[1:].max()) if sections else 0.0,
        float((errors - lows.min(axis=0))[0]),
    )


_RUN_ON = CARRY, np.ones(1)


Watch = Callable[[FloatArray, FloatArray], None]


@kept_for(8)
def _shapes_of(
    passing: Passing, sections: Sections
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]:
    """What excites each mode: the mean acceleration, the entering and the leaving chain at the driving sprocket, the
    chain at a driven tail; and what the modes add to the tension at the run-on and at sections."""
    on, off = passing.shapes(*_RUN_ON)[:, 0], passing.shapes(RETURN, np.zeros(1))[:, 0]
    far = passing.shapes(RETURN, np.ones(1))[:, 0] - passing.shapes(CARRY, np.zeros(1))[:, 0]
    gains = np.concatenate([passing.shapes(strand, x) for strand, x in (_RUN_ON, *sections)], axis=1)
    return passing.excited_by_start, on, off, far, gains / passing.masses.belt_mass


def _ridden(
    spec: ChainDrive, passing: Passing, sections: Sections, lead: float, watch: Watch | None = None
) -> tooth_passes.Passing:
    """All passes when the first joint is a lead behind its engagement."""
    share, teeth = residual(spec), spec.sprocket.teeth
    begun, on, off, _, gains = _shapes_of(passing, sections)
    behind = np.concatenate([loops.quasi_static(passing.masses, *one) for one in (_RUN_ON, *sections)])
    behind = (
        behind * passing.started - begun @ gains
    )  # what the modes left out take of the mean acceleration, followed at once
    fixed = passing.masses.fixed_length
    stiffness = [share * one for one in _stretched(passing, sections)]
    leads = (lead, (lead + _leaving_place(spec)) % 1.0) if fixed else (lead,)

    def moved(times: FloatArray, middles: FloatArray) -> FloatArray:
        found = passing.acceleration(times)[:, :, None] * begun
        for shape, one in zip((on, -off), leads, strict=False):
            places = passing.places(spec, times, middles, one)
            found = found + share * passing.polygon(spec, times, places, teeth)[:, :, None] * shape
        return np.asarray(found)

    def followed(times: FloatArray, middles: FloatArray) -> FloatArray:
        found = passing.acceleration(times)[:, :, None] * behind
        for sign, springs, one in zip((1, -1), stiffness, leads, strict=False):
            if np.any(springs):
                places = passing.places(spec, times, middles, one)
                ahead = passing.stretch(spec, times, places, spec.sprocket.teeth)
                found = found + sign * ahead[:, :, None] * springs
        return np.asarray(found)

    return tooth_passes.tooth_passes(
        passing.edges(spec, *leads),
        moved,
        passing.frequencies,
        passing.damping_ratios,
        gains,
        followed,
        watch,
    )


def _leaving_place(spec: ChainDrive) -> float:
    """Place of the joints that leave the driving sprocket, against those that enter it [1]."""
    if has_driven_tail(spec):
        return sprocket.pitch_fraction(spec.sprocket.teeth / 2, 1.0)
    return far_place(spec) or 0.0


def _stretched(passing: Passing, sections: Sections) -> tuple[FloatArray, FloatArray]:
    """Tension at the run-on and at sections per way by which the entering, and the leaving, chain runs ahead of the
    driving sprocket [N/m]: of the loop by either, or of the strand that the end belongs to."""
    strands = np.concatenate([np.full(len(x), strand) for strand, x in (_RUN_ON, *sections)])
    held = passing.masses
    if isinstance(held, HeldStrands):
        on, off = (np.where(strands == one, held.stiffness_of(one), 0.0) for one in (CARRY, RETURN))
        return on, off
    return np.full(len(strands), passing.stiffness), np.full(len(strands), passing.stiffness)


def _worst_of_the_tail(spec: ChainDrive, passing: Passing, sections: Sections, count: int) -> FloatArray:
    """Most that the teeth of a driven tail add at the run-on and at sections for so many places of its first joint, and
    what it differs from that of half as many [N]."""
    found = np.array([_by_the_tail(spec, passing, sections, k / count) for k in range(count)])
    most = found.max(axis=0)
    return np.asarray(2 * most - np.minimum(found[::2].max(axis=0), found[1::2].max(axis=0)))


def _by_the_tail(spec: ChainDrive, passing: Passing, sections: Sections, lead: float) -> FloatArray:
    """Most that the teeth of a driven tail add at the run-on and at sections, on their own, with the first joint a lead
    behind its engagement: nobody knows where they stand against those of the driving sprocket [N].

    The tail moves the end of one strand and the beginning of the other: B_k(1) of the return, -B_k(0) of the working
    strand, and the elongation of what it holds.
    """
    teeth, held = tail_teeth(spec), passing.masses
    assert isinstance(held, HeldStrands)
    _, _, _, far, gains = _shapes_of(passing, sections)
    places = (_RUN_ON, *sections)
    springs = np.concatenate(
        [np.full(len(x), held.stiffness_of(strand) * (1 if strand == RETURN else -1)) for strand, x in places]
    )

    def moved(times: FloatArray, middles: FloatArray) -> FloatArray:
        at = passing.places(spec, times, middles, lead)
        return np.asarray(passing.polygon(spec, times, at, teeth)[:, :, None] * far)

    def followed(times: FloatArray, middles: FloatArray) -> FloatArray:
        at = passing.places(spec, times, middles, lead)
        return np.asarray(passing.stretch(spec, times, at, teeth)[:, :, None] * springs)

    found = tooth_passes.tooth_passes(
        passing.edges(spec, lead),
        moved,
        passing.frequencies,
        passing.damping_ratios,
        gains,
        followed,
    )
    return np.asarray(np.maximum(found.largest, -found.smallest) + found.error)


def _seen(spec: ChainDrive, passing: Passing, sections: Sections, lead: float) -> tuple[FloatArray, FloatArray]:
    """Times, and the dynamic tension at the last of the places, at the run-on where there is no section."""
    parts: list[tuple[FloatArray, FloatArray]] = []
    _ridden(spec, passing, sections, lead, lambda times, sums: parts.append((times, sums[:, -1])))
    times, tensions = (np.concatenate(one) for one in zip(*parts, strict=True))
    order = np.argsort(times, kind="stable")
    return times[order], tensions[order]


def _by_the_driven(spec: ChainDrive, passing: Passing, sections: Sections) -> FloatArray:
    """Most that the teeth of the driven sprocket add at the run-on and at sections, on their own: nobody knows where
    they stand against those of the driver [N]."""
    teeth, far = tail_teeth(spec), passing.shapes(CARRY, np.zeros(1))[:, 0]
    gains = np.concatenate([passing.shapes(strand, x) for strand, x in (_RUN_ON, *sections)], axis=1)

    def moved(times: FloatArray, middles: FloatArray) -> FloatArray:
        places = passing.places(spec, times, middles, 0.0)
        return np.asarray(passing.polygon(spec, times, places, teeth)[:, :, None] * far)

    found = tooth_passes.tooth_passes(
        passing.edges(spec, 0.0), moved, passing.frequencies, passing.damping_ratios, gains / passing.masses.belt_mass
    )
    return np.asarray(np.maximum(found.largest, -found.smallest) + found.error)


def through(spec: ChainDrive, scene: SpeedRange, carried: frozenset[str], level: int) -> Result:
    """Dynamic tension during a speed sweep, resonances included.

        S = sum M_k x_k,   x_k'' + 2 zeta_k w_k x_k' + w_k^2 x_k = w_k^2 a + 2 zeta_k w_k a'
        a = e R cos(phi) - w^2 R sin(phi)

    Every tooth engagement has its own state transition, so that slow and sharp resonances are resolved. A driven tail
    keeps the speed of the sprocket; its teeth are in the error bar.

    **Range** a sprocket with a linear speed change that the chain does not influence; modes at standstill at the
    beginning of the range; in a loop of fixed length the damping of the elongation by the teeth is neglected.
    **Error** bounded: quadrature, neglected modes, and the initial positions of the link joints.
    **Source** derived in `numerics.run_through`; kinematics of the polygon.
    """
    found = _passed(spec, range_passing(spec, scene, _MODES << level), (), level)
    loads = range_loads(spec, scene, found.largest)
    return Result(
        {name: Found(load, {"time": found.time}) for name, load in loads.items()},
        work=found.work,
        window=(0.0, scene.time),
    )


def started(spec: ChainDrive, scene: Start, carried: frozenset[str], level: int) -> Result:
    """Dynamic entering tension of a start with mean acceleration and polygon effect in one run.

        S(s) = sum B_k(s) x_k,   x_k follows A_k a_rigid + B_k(on) a_on - B_k(off) a_off
        a_on = e R cos(phi) - w^2 R sin(phi) - a_rigid

    The teeth act between the chain and its drive: a light drive yields to them. With a screw take-up the teeth of the
    leaving strand act too, and the difference of both elongates the loop. With a driven tail the teeth of both
    sprockets act on either strand; those of the tail are in the error bar.

    **Range** a speed or a torque over time, with the angle of the sprocket that of the rigid body.
    **Error** bounded as in `through`.
    **Source** derived in `numerics.run_through`.
    """
    case, passing = start_case(spec, scene), start_passing(spec, scene, _MODES << level)
    if case.acceleration <= 0:
        raise NumericsError("NUM102", "the drive does not move the chain: there is no motion to compute")
    sections = sections_of(case, len(passing.frequencies))
    found = _passed(spec, passing, sections, level)
    smallest, at, which = _lowest(case, passing, found, sections)
    loads = {
        name: Found(load, {"time": case.held + found.time})
        for name, load in loads_of(spec, case, found.largest, None).items()
    }
    loads["tension_min"] = Found(smallest, at)

    def histories() -> dict[str, History]:
        place = one_section(sections, which)
        seen = {
            "tension_start": (case.line.run_on, _seen(spec, passing, (), found.lead)),
            "tension_min": (
                float(static_at(case, *place)[0]),
                _seen(spec, passing, (place,), float(found.smallest_lead[which])),
            ),
        }
        return {
            name: History(
                units.FORCE,
                [0.0, *(case.held + times).tolist()],
                [static, *(static + tensions).tolist()],
            )
            for name, (static, (times, tensions)) in seen.items()
        }

    window = (0.0, case.held + case.window)
    return beyond_slack(spec, Result(loads, work=found.work, window=window, histories=histories), "CHN123")


def _lowest(
    case: StartCase, passing: Passing, found: _Found, sections: Sections
) -> tuple[Estimate, dict[str, float], int]:
    """Smallest tension anywhere, with what the modes can do between two sections in its bar; its section.

    |B_k(s)''| <= (w t)^2 |B_k|, t the travel time of the strand; an eighth of it times the square of the distance
    """
    static = np.concatenate([static_at(case, strand, x) for strand, x in sections])
    between = 0.0
    for strand, x in sections:
        transit = travel_time(case, strand)
        shapes = np.abs(passing.shapes(strand, x)).max(axis=1) / passing.masses.belt_mass
        bend = (passing.frequencies * transit * float(x[1])) ** 2 / 8
        between = max(between, float(np.sum(bend * shapes * found.followed)))
    values = static + np.minimum(found.smallest, 0.0)
    lows, which = values - found.smallest_bar - between, int(values.argmin())
    high = min(float((values + found.smallest_bar).min()), float(static.min()))
    value = float(values[which])
    bar = max(value - float(lows.min()), high - value)
    at = {"time": case.held + float(found.smallest_time[which]), "position": position_of(case, sections, which)}
    return Estimate(value, float(lows.min()), max(high, value), numerical=bar), at, which


def cost_of_teeth(spec: ChainDrive, passing: Passing, sections: int, level: int) -> float:
    """Predicted seconds of all passes [s]."""
    if not 0 < passing.window < math.inf:
        return 0.0
    fastest = float(np.max(passing.frequencies * np.maximum(1.0, 2 * passing.damping_ratios)))
    places = fastest * passing.window / 2 + 10 * float(passing.way(np.array([passing.window]))[0]) / spec.chain.pitch
    return 5e-3 + (_leads(passing) << level) * places * len(passing.frequencies) * (_SECONDS + _PER_SECTION * sections)


def start_valid(spec: ChainDrive, scene: Start) -> Criterion:
    """Whether the speed of a start is known over time.

        n = 1 for a torque shared with a drive of the tail, + 1 for a motor's curve or no motion

    **Range** any start.
    **Error** exact: a count.
    **Source** polygon effect at both ends; a torque that goes with the speed damps and drives the modes.
    """
    case = start_case(spec, scene)
    unknown = case.follows_curve or not case.moves
    if shares_torque(spec) and not case.imposed_speed:
        return TORQUE_SHARED
    return Criterion("n", float(unknown), 1.0, "motor curves: none", "count")


RANGE_NOTES: Solver[ChainDrive, SpeedRange] = Solver(
    name="chain_range_notes",
    title="textbook polygon force at the highest speed",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({SpeedRange}),
    represents=frozenset(),
    gives=frozenset({"tension_speed_range"}),
    run=range_notes,
    cost=lambda spec, scene, carried, level: 5e-5,
    source="lecture notes Kramatorsk 2007",
    decides=False,
)
RANGE: Solver[ChainDrive, SpeedRange] = Solver(
    name="chain_run_through",
    title="speed sweep, modal superposition with polygon excitation",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({SpeedRange}),
    represents=frozenset({"tooth_passing"}),
    gives=frozenset({"tension_speed_range", "safety_start"}),
    run=through,
    cost=lambda spec, scene, carried, level: cost_of_teeth(spec, range_passing(spec, scene, _MODES << level), 1, level),
    source="derived in ptmcalc.numerics.run_through",
    always=frozenset({"tooth_passing"}),
    levels=3,
)
START_TEETH: Solver[ChainDrive, Start] = Solver(
    name="chain_start_teeth",
    title="start, modal superposition with polygon excitation",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({Start}),
    represents=frozenset({"chain_elasticity", "higher_modes", "tooth_passing"}),
    gives=frozenset(TENSIONS),
    run=started,
    cost=lambda spec, scene, carried, level: cost_of_teeth(
        spec, start_passing(spec, scene, _MODES << level), 80, level
    ),
    source="derived in ptmcalc.numerics.run_through",
    valid=start_valid,
    always=frozenset({"chain_elasticity", "higher_modes", "tooth_passing"}),
    levels=3,
)
