"""A start of the elastic chain by its modes: one of them as two masses on a spring, or many as waves."""

import math
from dataclasses import replace

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Failure, Finding, Found, History, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.chain_drive.machine import loops
from ptmcalc.machines.chain_drive.machine.model import FloatArray, has_driven_tail, of_loop, shares_torque, tension_key
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, ChainScene, Start
from ptmcalc.machines.chain_drive.starting.bounds import TENSIONS, loads_of, static_at
from ptmcalc.machines.chain_drive.starting.motion import StartCase, Swinging, ratios, start_case
from ptmcalc.numerics.mode_sum import Modes, Peaks, kicks, mode_sum, sampled

_FEWEST = 24
"""Modes at the coarsest level; four times as many at each finer one. A numerical choice: the rest is bounded and added.
More narrow the error bar and take longer."""
_SECTIONS = 24
"""Modes for the sections along the chain; twice as many at each finer level. A numerical choice: the rest is bounded
and added. More narrow the error bar and take longer."""
_FAR_BEYOND = 4.0
"""Damping ratio above which a mode counts with the neglected ones [1]: it follows the force at once. A numerical
choice. A larger value computes more modes; a smaller one widens the error bar."""
_ANGLE = 0.5
"""Angle by which the fastest mode turns from one section, or sample of the cost, to the next [rad]. A numerical choice.
A smaller value narrows the error bar along the chain and takes longer."""
_A_PERIOD, _FEWEST_SEEN, _MOST_SEEN = 40, 400, 4000
"""Samples of a history; numerical choices. `_A_PERIOD`: in a period of the lowest mode. `_FEWEST_SEEN` and
`_MOST_SEEN`: limits of the total. More draw the history more smoothly and need memory; no load depends on them."""
_SECONDS = 6e-8
"""Predicted seconds per mode, sample and section; measured once. Only its ratio to those of other solvers matters: a
wrong value changes their order, no load."""


def natural_frequencies(case: Swinging, count: int) -> FloatArray:
    """Of the loop that swings, drive and all, or with its sprocket held [rad/s]."""
    return np.array(of_loop(case.masses, 0.0, count))


def felt(spec: ChainDrive, scene: ChainScene, case: Swinging, count: int) -> int:
    """So many of the lowest modes, without those far beyond critical damping, which follow at once."""
    over = ratios(spec, scene, natural_frequencies(case, count)) > _FAR_BEYOND
    return max(int(np.argmax(over)) if np.any(over) else count, 1)


def _require_motion(case: StartCase) -> None:
    if not case.moves or case.acceleration <= 0:
        raise NumericsError("NUM102", "the drive does not move the chain: there is no motion to compute")


# -- one mode -------------------------------------------------------------------------------------------------------


def one_mode(spec: ChainDrive, scene: Start, carried: frozenset[str], level: int) -> Result:
    """Dynamic entering tension of two masses on a spring: the drive and all masses that it moves.

        x'' + 2 zeta w x' + w^2 x = w^2 q + 2 zeta w q',   S = a r x,   w the first natural frequency of the chain

    The spring stiffness gives both masses the first natural frequency of the chain; the damper has the damping of that
    mode. For an imposed speed the drive mass is infinite. Closed form between the kinks of the profile.

    **Range** a taut chain that slides forward; a constant tension of the leaving strand or a loop of fixed length.
    **Error** sampling error; the bound of the effect `higher_modes` covers the higher modes.
    **Source** reduced system of two masses; derived in `numerics.mode_sum`.
    """
    case = start_case(spec, scene)
    _require_motion(case)
    w = natural_frequencies(case, 1)
    whole = loops.quasi_static(case.masses, CARRY, np.ones(1))
    modes = Modes(w, ratios(spec, scene, w), whole[None, :], whole, np.zeros(1))
    peaks = mode_sum(modes, case.course, case.window)
    dynamic = _ever(_largest(case, peaks, 0), later(case, modes))
    at = {"time": case.held + float(peaks.largest_time[0])}
    loads = loads_of(spec, case, dynamic, None)
    return Result(
        {name: Found(load, at) for name, load in loads.items()},
        work=peaks.samples,
        window=(0.0, case.held + case.window),
        histories=lambda: {"tension_start": course_of(case, modes, case.line.run_on, at["time"])},
    )


def later(case: StartCase, modes: Modes) -> FloatArray:
    """Most by which what still swings at the end of the window moves the tension at each place ever after [N].

        a (sum |M_k| g_k d_k + rest g),   d = exp(-zeta w t)/sqrt(1 - zeta^2) of the start, at most 1

    g_k are all kicks of the course (`mode_sum.kicks`), t the time since the last one, after which nothing drives the
    modes. One near critical damping or beyond it falls as (1 + s t) exp(-s t), s = w/(2 zeta).
    """
    jumps, variation = kicks(case.course, case.window)
    w, zeta, since = modes.frequencies, modes.damping_ratios, case.window - float(case.course.times[-1])
    slow = w * since / (2 * np.maximum(zeta, _NEARLY_CRITICAL))
    swings = np.minimum(zeta, _NEARLY_CRITICAL)
    decay = np.where(
        zeta < _NEARLY_CRITICAL,
        np.minimum(np.exp(-swings * w * since) / np.sqrt(1 - swings**2), 1.0),
        (1 + slow) * np.exp(-slow),
    )
    left = np.abs(modes.gains).T @ (decay * (jumps + variation / w))
    return np.asarray(case.acceleration * (left + modes.left_out * (jumps + variation / w[-1])))


_NEARLY_CRITICAL = 0.9
"""Damping ratio above which the envelope of a critically damped mode is used [1]. A numerical choice: the factor 1/(1 -
zeta^2)^(1/2) of the oscillation grows without limit towards 1. Other values widen the bound of the rest."""


def _ever(dynamic: Estimate, after: FloatArray) -> Estimate:
    """A largest dynamic tension with what may still come behind the window."""
    more = max(float(after.max()) - dynamic.high, 0.0)
    return replace(dynamic, high=dynamic.high + more, model=dynamic.model + more)


def _never_below(smallest: Estimate, after: float) -> Estimate:
    """A smallest tension with what may still come behind the window."""
    less = max(smallest.low - after, 0.0)
    return replace(smallest, low=smallest.low - less, model=smallest.model + less)


def _largest(case: StartCase, peaks: Peaks, place: int) -> Estimate:
    """A largest dynamic tension with its numerical bar [N]."""
    value, low, high = (
        case.acceleration * float(part[place]) for part in (peaks.largest, peaks.largest_low, peaks.largest_high)
    )
    return Estimate(value, low, high, numerical=max(value - low, high - value))


def _one_mode_cost(spec: ChainDrive, scene: Start, carried: frozenset[str], level: int) -> float:
    case = start_case(spec, scene)
    return 1.2e-2 + 1e-6 * _samples(case, 1)


def _samples(case: StartCase, count: int) -> float:
    """Samples in the window, or until damping has ended the swing of the first mode."""
    w = natural_frequencies(case, count)
    return float(w[-1]) * case.window / _ANGLE if case.moves else 0.0


# -- waves ----------------------------------------------------------------------------------------------------------


def waves(spec: ChainDrive, scene: Start, carried: frozenset[str], level: int) -> Result:
    """Tensions of a start by superposition of many modes of both strands, equivalent to waves and their echoes.

        S(s) = a (r(s) q + sum M_k(s) (x_k - q))

    M_k(s) are the parts of the modes (`chain_resonance.modal_tensions`), with the internal damping of the file at each
    frequency. The entering strand uses more modes than the sections along both strands. A driven tail has the speed
    of the other sprocket, by the profile or as it is synchronised: each strand swings on its own, held at both ends,
    the return strand free at a gravity take-up (`laws.held_strands`).

    **Range** a taut chain that slides forward; hysteretic and Zener damping by the ratio of each mode; with a driven
    tail a profile of speed, or synchronised sprockets.
    **Error** bounded: samples, sections and neglected modes.
    **Source** sums over modes, derived in `numerics.mode_sum` and `chain_resonance`; equal to d'Alembert's waves with
    all of them.
    """
    case = start_case(spec, scene)
    _require_motion(case)
    many = felt(spec, scene, case, _FEWEST << (2 * level))
    at_end = ((CARRY, np.ones(1)),)
    at_drive = peaks_at(spec, scene, case, many, at_end)
    count = felt(spec, scene, case, _SECTIONS << level)
    sections = sections_of(case, count)
    along = peaks_at(spec, scene, case, count, sections)
    dynamic = _ever(_largest(case, at_drive, 0), later(case, modes_at(spec, scene, case, many, at_end)))
    smallest, where, which = extreme_anywhere(case, along, sections, count)
    after = later(case, modes_at(spec, scene, case, count, sections))
    static = np.concatenate([static_at(case, strand, x) for strand, x in sections])
    smallest = _never_below(smallest, float((static - after).min()) - case.acceleration * _between_sections(
        case, sections, count))  # fmt: skip
    at = {"time": case.held + float(at_drive.largest_time[0])}
    loads = {name: Found(load, at) for name, load in loads_of(spec, case, dynamic, None).items()}
    loads["tension_min"] = Found(smallest, where)
    found = Result(
        loads,
        work=at_drive.samples + along.samples,
        window=(0.0, case.held + case.window),
        health={"modes": float(many), "sections": float(len(along.smallest))},
        histories=lambda: {
            "tension_start": course_of(case, modes_at(spec, scene, case, many, at_end), case.line.run_on, at["time"]),
            "tension_min": course_at(spec, scene, case, count, one_section(sections, which), where["time"]),
        },
    )
    return beyond_slack(spec, found, "CHN123")


def beyond_slack(spec: ChainDrive, result: Result, check: str) -> Result:
    """The result, or what is left of it where the chain may go slack: how low it would come, and a failure of a check
    (without one, a finding) where it surely does. What a chain does that is caught again is not known."""
    low = result.loads["tension_min"]
    if low.estimate.low >= 0:
        return result
    loads = {
        name: found if name == "tension_min" else replace(found, estimate=Estimate.unknown(found.estimate.value))
        for name, found in result.loads.items()
    }
    if low.estimate.high >= 0:
        return replace(result, loads=loads)
    where = tension_key(spec)
    message = (
        f"the chain goes slack: its tension is lowest at {low.at['time']:.3g} s,"
        f" {low.at['position']:.4g} m behind the drive"
        " sprocket"
    )
    hint = f"a {'higher' if where[-1] == 'tension' else 'smaller'} `{where[-1]}` keeps it taut"
    if not check:
        return replace(result, loads=loads, findings=(Finding("NUM102", message, where, hint),))
    return replace(result, loads=loads, failures=(Failure(check, message, where, hint),))


Sections = tuple[tuple[int, FloatArray], ...]


def sections_of(case: Swinging, count: int) -> Sections:
    """Shares of both strands, close enough for the fastest mode; a strand without mass has its ends."""
    fastest = float(natural_frequencies(case, count)[-1])
    found = []
    for strand, mass, compliance in (
        (RETURN, case.masses.return_mass, case.masses.return_compliance),
        (CARRY, case.masses.carry_mass, case.masses.carry_compliance),
    ):
        angle = fastest * math.sqrt(mass * compliance)
        found.append((strand, np.linspace(0.0, 1.0, math.ceil(angle / _ANGLE) + 2)))
    return tuple(found)


def course_of(case: Swinging, modes: Modes, static: float, at: float) -> History:
    """Tension over time at the one place of the modes; one sample is that at a time `at`, which is of a peak."""
    times = _seen_at(case, float(modes.frequencies[0]), at)
    after = times > case.held  # at the very first moment the state before
    moved = np.zeros(len(times))
    moved[after] = sampled(modes, case.course, times[after] - case.held)[:, 0]
    return History(units.FORCE, times.tolist(), (static + case.acceleration * moved).tolist())


def course_at(
    spec: ChainDrive, scene: ChainScene, case: Swinging, count: int, place: tuple[int, FloatArray], at: float
) -> History:
    """Tension over time at one section; one sample is that at a time `at`, which is of a peak."""
    return course_of(case, modes_at(spec, scene, case, count, (place,)), float(static_at(case, *place)[0]), at)


def _seen_at(case: Swinging, frequency: float, at: float) -> FloatArray:
    """Times at which a course is seen: so many in a period, at each kink of the drive, and at a time of a peak [s]."""
    periods = case.window * frequency / (2 * math.pi)
    count = int(np.clip(_A_PERIOD * periods, _FEWEST_SEEN, _MOST_SEEN))
    even = np.linspace(0.0, case.window, count)
    kinks = case.course.times[case.course.times <= case.window]
    times = case.held + np.concatenate([even, kinks])
    return np.unique(np.concatenate([[0.0], times, [min(max(at, 0.0), case.held + case.window)]]))


def modes_at(spec: ChainDrive, scene: ChainScene, case: Swinging, count: int, sections: Sections) -> Modes:
    """The modes of a start at sections."""
    w = natural_frequencies(case, count)
    masses = case.masses
    gains = np.concatenate([loops.modal_tensions(masses, w, *one) for one in sections], axis=1)
    whole = np.concatenate([loops.quasi_static(masses, *one) for one in sections])
    rest = np.concatenate([loops.modal_rest(masses, w, *one) for one in sections])
    return Modes(w, ratios(spec, scene, w), gains, whole, rest)


def peaks_at(spec: ChainDrive, scene: ChainScene, case: Swinging, count: int, sections: Sections) -> Peaks:
    return mode_sum(modes_at(spec, scene, case, count, sections), case.course, case.window)


def extreme_anywhere(
    case: Swinging, peaks: Peaks, sections: Sections, count: int, sign: int = -1
) -> tuple[Estimate, dict[str, float], int]:
    """Smallest (or with sign 1 the largest) tension anywhere with its bar, where and when it is [N, m, s], and its
    section."""
    a, static = case.acceleration, np.concatenate([static_at(case, strand, x) for strand, x in sections])
    found = (peaks.smallest, peaks.smallest_low, peaks.smallest_high, peaks.smallest_time)
    if sign > 0:
        found = (-peaks.largest, -peaks.largest_high, -peaks.largest_low, peaks.largest_time)
    value, low, high = (a * part - sign * static for part in found[:3])
    which = int(value.argmin())
    least = float(low.min()) - a * _between_sections(case, sections, count)
    most = max(float(high.min()), float(value[which]))
    middle, bar = float(value[which]), max(float(value[which]) - least, most - float(value[which]))
    ends = (least, most) if sign < 0 else (-most, -least)
    at = {"time": case.held + float(found[3][which]), "position": position_of(case, sections, which)}
    return Estimate(-sign * middle, ends[0], ends[1], numerical=bar), at, which


def one_section(sections: Sections, which: int) -> tuple[int, FloatArray]:
    """The strand and the share of a section by its number."""
    strands = np.concatenate([np.full(len(x), strand) for strand, x in sections])
    shares = np.concatenate([x for _, x in sections])
    return int(strands[which]), shares[which : which + 1]


def position_of(case: Swinging, sections: Sections, which: int) -> float:
    """Where a section lies, from the run-off on [m]."""
    back, working = case.line.back.length, case.line.working.length
    places = [x * back if strand == RETURN else back + x * working for strand, x in sections]
    return float(np.concatenate(places)[which])


def travel_time(case: Swinging, strand: int) -> float:
    """Of a wave along a strand of the loop that swings [s]."""
    loop = case.masses
    if strand == RETURN:
        return math.sqrt(loop.return_mass * loop.return_compliance)
    return math.sqrt(loop.carry_mass * loop.carry_compliance)


def _between_sections(case: Swinging, sections: Sections, count: int) -> float:
    """What the modes taken can do between two sections, per acceleration: an eighth of their bend [kg].

    |M_k''| <= (w t)^2 |M_k|, t the travel time of the strand; a mode strays by its kicks at most
    """
    w = natural_frequencies(case, count)
    jumps, variation = kicks(case.course, case.window)
    stray = jumps + variation / w
    worst = 0.0
    for strand, x in sections:
        gains = np.abs(loops.modal_tensions(case.masses, w, strand, x)).max(axis=1)
        bend = (w * travel_time(case, strand) * float(x[1])) ** 2 / 8
        worst = max(worst, float(np.sum(bend * gains * stray)))
    return worst


def _waves_cost(spec: ChainDrive, scene: Start, carried: frozenset[str], level: int) -> float:
    case = start_case(spec, scene)
    if not case.moves:
        return 0.0
    count, along = (felt(spec, scene, case, one) for one in (_FEWEST << (2 * level), _SECTIONS << level))
    sections = sum(len(x) for _, x in sections_of(case, along))
    return 5e-3 + 1e-7 * _samples(case, count) * count + _SECONDS / 20 * _samples(case, along) * along * sections


TORQUE_SHARED = Criterion(
    "n", 1.0, 1.0, "driven tail that is not synchronised: how both drives share the torque is not known", "count"
)
"""Why a start by torque, or a stop, is not followed where both sprockets may turn apart."""


def valid(spec: ChainDrive, scene: Start) -> Criterion:
    """Whether the modes of a start are known: something moves, and nothing but torque or speed over time drives.

        n = 1 for a drive too weak, + 1 for a motor's curve, or 1 for a torque shared with a drive of the tail

    **Range** any start.
    **Error** exact: a count.
    **Source** Newton's law; a torque that goes with the speed damps and drives the modes.
    """
    case = start_case(spec, scene)
    if shares_torque(spec) and not case.imposed_speed:
        return TORQUE_SHARED
    count = (not case.moves) + case.follows_curve
    return Criterion("n", float(count), 1.0, "insufficient drive force, motor curve: none of them", "count")


def one_mode_valid(spec: ChainDrive, scene: Start) -> Criterion:
    """Whether two masses stand for a start: as `valid`, and one loop swings, not each strand on its own.

        n of `valid`, + 1 for a tail with a drive of its own

    **Range** any start.
    **Error** exact: a count.
    **Source** two strands that are held at the tail have no common first mode.
    """
    if has_driven_tail(spec):
        return Criterion("n", 1.0, 1.0, "driven tail: each strand swings on its own", "count")
    return valid(spec, scene)


ONE_MODE: Solver[ChainDrive, Start] = Solver(
    name="chain_one_mode",
    title="start, two-mass model of the first mode",
    fidelity=Fidelity.MODAL,
    scenes=frozenset({Start}),
    represents=frozenset({"chain_elasticity"}),
    gives=frozenset(TENSIONS) - {"tension_min"},
    run=one_mode,
    cost=_one_mode_cost,
    source="reduced system of two masses",
    valid=one_mode_valid,
    always=frozenset({"chain_elasticity"}),
    method="sums over modes",
)
WAVES: Solver[ChainDrive, Start] = Solver(
    name="chain_start_waves",
    title="start, modal superposition of both strands",
    fidelity=Fidelity.MODAL,
    scenes=frozenset({Start}),
    represents=frozenset({"chain_elasticity", "higher_modes"}),
    gives=frozenset(TENSIONS),
    run=waves,
    cost=_waves_cost,
    source="sums over modes; derived in ptmcalc.numerics.mode_sum",
    valid=valid,
    always=frozenset({"chain_elasticity", "higher_modes"}),
    levels=3,
    method="sums over modes",
)
