"""The effects a chain that changes its speed may call for."""

import math
from collections.abc import Mapping

import numpy as np

from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.contract.effect import AnyEffect, Criterion, Effect
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.chain_drive.machine import loops
from ptmcalc.machines.chain_drive.machine.loops import HeldStrands
from ptmcalc.machines.chain_drive.machine.model import chain_line, shares_torque
from ptmcalc.machines.chain_drive.machine.spec import (
    ChainDrive,
    ChainScene,
    Coast,
    EmergencyStop,
    SpeedRange,
    Start,
    Stop,
)
from ptmcalc.machines.chain_drive.machine.strength import safety
from ptmcalc.machines.chain_drive.speed_change.teeth import curve_teeth, range_passing, start_passing
from ptmcalc.machines.chain_drive.speed_change.tooth_passes import range_loads
from ptmcalc.machines.chain_drive.starting import bounds as start_bounds
from ptmcalc.machines.chain_drive.starting.bounds import TENSIONS
from ptmcalc.machines.chain_drive.starting.motion import StartCase, start_case, swinging_loop
from ptmcalc.machines.chain_drive.starting.motor_force import stands_still
from ptmcalc.machines.chain_drive.starting.rigid_curve import rigid_start
from ptmcalc.machines.chain_drive.starting.waves import natural_frequencies
from ptmcalc.machines.chain_drive.stopping.formulas import OF_STOP
from ptmcalc.machines.chain_drive.stopping.motion import StopCase, extremes, stop_case
from ptmcalc.spec.scene import Scene

Loads = Mapping[str, Estimate]
Offsets = Mapping[str, Interval]

ELASTIC_THRESHOLD = 0.05
"""Bound of the tension that waves add, relative to the static tension [1], from which on chain elasticity is simulated.
An engineering choice. Below it the rigid chain is used, and its error bar in a start is at most 5 % of the static
tension."""
MODES_THRESHOLD = 0.05
"""Share of the modes above the first in the starting tension [1] from which on they are simulated. An engineering
choice. Below it the error bar is at most 5 % of the dynamic tension times the deviations of both modes."""
TEETH_THRESHOLD = 0.05
"""Bound of the tension that passing teeth add, relative to the static tension [1], from which on they are simulated. An
engineering choice. Below it the error bar of a start is at most 5 % of the static tension at the drive."""
STICKING_THRESHOLD = 0.1
"""Resistance of a relaxed chain relative to its inertia force [1] from which on stick-slip of the load is simulated. An
engineering choice. Below it the error is not bounded, and the loads have no error bar."""


def _anything(loads: Loads) -> Offsets:
    """No bound for any load that the swing of the chain can change."""
    return {name: ANYTHING for name in loads if name in TENSIONS}


# -- chain elasticity -----------------------------------------------------------------------------------------------


def elastic_criterion(spec: ChainDrive, scene: ChainScene) -> Criterion:
    """Maximum deviation of the tension from that of the rigid body, relative to the static tension of the same section.

        E = max over the chain of a b(s) g/S_static(s)             start
        E = (S_rigid,min - S_low)/S_static,min                     stop

    a b(s) is the bound for a torque step (`laws.loop_bounds.stray`), g the share that remains with the profile. S_low
    is the bound of the minimum tension in a stop.

    **Range** any start and any stop; infinite if a section has no static tension, for a start on a motor curve, and for
    a torque that two drives share (driven tail).
    **Error** an upper bound of the ratio.
    **Source** derived in `laws.loop_bounds`; the threshold of 5 % is an engineering choice.
    """
    if isinstance(scene, Start):
        case = start_case(spec, scene)
        value = start_bounds.stray_ratio(case)
        if case.follows_curve or _apart(spec, case):
            value = math.inf if _moves(spec, case) else 0.0
    else:
        stop = stop_case(spec, scene)
        found, least = extremes(spec, stop), min(stop.line.ends)
        known = least > 0 and not shares_torque(spec)
        value = (found.smallest - found.lowest) / least if known else math.inf
    meaning = "maximum tension added by chain waves / static tension"
    return Criterion("E", value, ELASTIC_THRESHOLD, meaning, "laws.loop_bounds")


def elastic_bound(spec: ChainDrive, scene: ChainScene, loads: Loads) -> Offsets:
    """Interval of every load of the rigid body that contains all waves of the chain.

        start: S_static + a r - a b g <= S <= S_static + a r + a b g,   phase by phase
        stop:  S_static + min(0, -a r) - b sum |da| <= S <= S_static + max(0, -a r) + b sum |da|
               S_ov <= 2 m a with a constant leaving tension, a (|r| + b) at either end of a fixed loop

    **Range** a taut chain that slides forward, any tail mass and jump of impedance, any internal damping; a take-up
    without mass. If the interval reaches below 0, the chain may go slack and no bound exists. No bound exists for a
    start on a motor curve. A driven tail has the speed of the driving sprocket (`laws.held_strands`): by the profile
    of a start, or in any start and stop where it is synchronised. Without that, torques and stops have no bound.
    **Error** a bound; it is attained at the entering strand with a constant tension of the leaving strand and without
    damping.
    **Source** derived in `laws.loop_bounds` (completeness of the modes, Cauchy-Schwarz, Dunkerley); a damped mode never
    deviates more than an undamped one.
    """
    if not isinstance(scene, Start):
        return _of_stop(spec, scene, loads)
    case = start_case(spec, scene)
    if not _moves(spec, case):
        return {}
    if case.follows_curve or _apart(spec, case):
        return _anything(loads)
    intervals = start_bounds.enclosed(case)
    found = start_bounds.offsets(spec, case, intervals, loads)
    return found if intervals["tension_min"].low >= 0 else _unless_taut(found, loads)


def _moves(spec: ChainDrive, case: StartCase) -> bool:
    """Whether the drive moves the chain: at mean torque, or on its curve at standstill."""
    return not stands_still(spec, case) if case.follows_curve else case.moves


def _apart(spec: ChainDrive, case: StartCase) -> bool:
    """Whether a start turns the sprockets of a driven tail by torques, each at a speed of its own."""
    return shares_torque(spec) and not case.imposed_speed


def _of_stop(spec: ChainDrive, scene: ChainScene, loads: Loads) -> Offsets:
    """`elastic_bound` of a stop."""
    case = stop_case(spec, scene)
    if shares_torque(spec):
        return {name: ANYTHING for name in loads if name in OF_STOP}
    given, found = extremes(spec, case), dict[str, Interval]()
    if "tension_min" in loads:
        top, known = min(case.line.ends), loads["tension_min"]
        low = given.lowest - known.low if given.lowest >= 0 else -math.inf  # slack, and caught again
        found["tension_min"] = Interval(low, top - known.high)
    if "safety_start" in loads:
        centrifugal, before = case.line.centrifugal, loads["safety_start"]
        least = safety(spec, given.highest + centrifugal) if given.lowest >= 0 else -math.inf
        most = safety(spec, max(case.line.ends) + centrifugal)
        found["safety_start"] = Interval(min(least - before.low, 0.0), max(most - before.high, 0.0))
    if "tension_overload_braking" in loads:
        found["tension_overload_braking"] = _overload(spec, case, loads["tension_overload_braking"])
    return found


def _overload(spec: ChainDrive, case: StopCase, load: Estimate) -> Interval:
    """What waves make of the tension that braking adds at the drive."""
    if not case.line.fixed_length and not isinstance(case.masses(1.0), HeldStrands):
        return Interval(0.0, load.high)
    a = load.value / case.line.moving_mass
    least, most = 0.0, 0.0
    for losses in (case.efficiency, 1 / case.efficiency):
        loop = swinging_loop(spec, case.masses(losses))
        for end in ((CARRY, 1.0), (RETURN, 0.0)):
            r = abs(float(loops.quasi_static(loop, *end)))
            least, most = max(least, r), max(most, r + float(loops.stray(loop, *end)))
    return Interval(min(a * least - load.low, 0.0), max(a * most - load.high, 0.0))


def _unless_taut(found: Offsets, loads: Loads) -> Offsets:
    """A chain that may go slack and be caught again: how low it surely comes stays known."""
    least = found.get("tension_min")
    return {**_anything(loads), **({} if least is None else {"tension_min": Interval(-math.inf, least.high)})}


# -- higher modes ---------------------------------------------------------------------------------------------------


def modes_criterion(spec: ChainDrive, scene: Start) -> Criterion:
    """Part of the dynamic tension of the entering strand that is not in the first mode.

        n = sum_(k>1) |M_k|/sum M_k

    **Range** any start; infinite if the entering strand has no quasi-static tension.
    **Error** an upper bound of the part.
    **Source** `chain_resonance.modal_rest`; the threshold of 5 % is an engineering choice.
    """
    case = start_case(spec, scene)
    rest, _ = _behind_the_first(case)
    whole = abs(float(loops.quasi_static(case.masses, CARRY, 1.0)))
    value = rest / whole if whole > 0 else math.inf
    meaning = "share of higher modes in the starting tension"
    return Criterion("n", value, MODES_THRESHOLD, meaning, "laws.chain_resonance")


def _behind_the_first(case: StartCase) -> tuple[float, float]:
    """Bound of the parts of all modes but the first at the run-on [kg], and the second frequency [rad/s]."""
    w = natural_frequencies(case, _COUNTED)
    gains = loops.modal_tensions(case.masses, w, CARRY, np.ones(1))[:, 0]
    rest = float(loops.modal_rest(case.masses, w, CARRY, np.ones(1))[0])
    return float(np.abs(gains[1:]).sum()) + rest, float(w[1])


_COUNTED = 12
"""Modes whose tensions are summed one by one; a numerical choice. The rest is bounded as a whole, so that the bound
applies to any number. More modes narrow it and take longer."""


def modes_bound(spec: ChainDrive, scene: Start, loads: Loads) -> Offsets:
    """Change of the dynamic tension if the first mode alone is assumed.

        |dS| <= a R (g_1 + g_2),   R = sum_(k>1) |M_k|

    g_1 and g_2 bound the deviation of the first mode and of the modes above the second frequency from the rigid body
    (`start_profile.phases`). With a constant tension of the leaving strand all modes have the same sign. The peak then
    rises by at most a R (1 + g_2), less the part of R that the peak contains already.

    **Range** as the waves; a taut chain with the tensions of steady running at the start.
    **Error** a bound.
    **Source** sums over modes; derived.
    """
    case = start_case(spec, scene)
    if not case.moves or "tension_dynamic_start" not in loads or scene.chain == "relaxed" or _apart(spec, case):
        return _anything(loads)
    rest, second = _behind_the_first(case)
    first = float(natural_frequencies(case, 1)[0])
    strays = [one.stray + other.stray for one, other in zip(case.phases(first), case.phases(second), strict=True)]
    less = more = case.acceleration * rest * max(strays)
    if not case.line.fixed_length:
        whole = float(loops.quasi_static(case.masses, CARRY, 1.0)) * case.acceleration
        reached = loads["tension_dynamic_start"].value / whole if whole > 0 else 0.0
        most = max(phase.high + phase.stray for phase in case.phases(second))
        more = min(more, case.acceleration * rest * max(most - reached, 0.0))
    found = start_bounds.spread(spec, case, less, more, loads)
    return found if start_bounds.enclosed(case)["tension_min"].low >= 0 else _anything(loads)


# -- a load that sticks ---------------------------------------------------------------------------------------------


def sticking_criterion(spec: ChainDrive, scene: Start) -> Criterion:
    """Ratio of the resistance of a relaxed chain to the accelerating force.

        W/(m a);   0 for a start with the running tensions

    **Range** any start. A chain that starts with its running tensions slides forward from the beginning.
    **Error** exact.
    **Source** force balance of a moving front; the threshold of 10 % is an engineering choice.
    """
    case = start_case(spec, scene)
    pulled = case.line.moving_mass * case.acceleration
    value = 0.0
    if scene.chain == "relaxed":
        value = abs(case.line.static_resistance) / pulled if pulled > 0 else math.inf
    return Criterion("W/(m a)", value, STICKING_THRESHOLD, "resistance / inertia force of the chain", "Newton's law")


def sticking_bound(spec: ChainDrive, scene: Start, loads: Loads) -> Offsets:
    """Zero for a chain with its running tensions; no bound for a relaxed chain.

        the drive tightens the chain before its load breaks away: no superposition of modes describes this

    **Range** any start.
    **Error** exact for the first case, none for the second.
    **Source** two masses, `numerics.two_mass_start`, show the possible size.
    """
    return _anything(loads) if scene.chain == "relaxed" else {}


# -- inertia of the take-up weight ----------------------------------------------------------------------------------


def weight_criterion(spec: ChainDrive, scene: Start) -> Criterion:
    """Influence of the inertia of the take-up weight on the tension of the leaving strand.

        max(kappa/0.1, (a_0/g)/0.03),   kappa = M w_1/(4 Z_2),   a_0 = F/m_drive;   0 without `takeup.mass`

    a_0 is the acceleration of the drive alone, w_1 the lowest frequency, Z_2 the impedance of the return strand. On a
    motor curve F is half of the total variation of the force: a step that begins and ends has the same.

    **Range** a gravity take-up; without a mass in the file the tension is constant.
    **Error** an estimate.
    **Source** take-up weight on two falls; thresholds are an engineering choice.
    """
    kappa, drive = _weight_numbers(spec, scene, start_case(spec, scene))
    value = max(kappa / 0.1, drive / 0.03)
    return Criterion("kappa", value, 1.0, "inertia of the take-up weight", "take-up weight on two falls")


def _weight_numbers(spec: ChainDrive, scene: Start, case: StartCase) -> tuple[float, float]:
    """kappa, and the acceleration of the drive alone over that of gravity [1]."""
    mass = case.line.takeup_mass
    if mass == 0 or not _moves(spec, case):
        return 0.0, 0.0
    impedance = math.sqrt(case.line.back.line_mass * case.line.back.stiffness)
    lowest = float(natural_frequencies(case, 1)[0])
    if isinstance(case.masses, HeldStrands):  # of the return strand, which alone moves the weight
        lowest = math.pi / 2 / case.masses.travel_time(RETURN)
    kappa = mass / 4 * lowest / impedance
    alone = _acceleration(spec, scene, case)
    alone *= 1 if case.imposed_speed else case.whole_mass / case.masses.drive_mass
    return kappa, alone / spec.gravity


def _acceleration(spec: ChainDrive, scene: Start, case: StartCase) -> float:
    """Of the rigid chain by a step of force that varies as much as the force of the start [m/s^2]: on a motor curve by
    half of its total variation, infinite where that is not known."""
    if not case.follows_curve:
        return case.acceleration
    found = rigid_start(spec, scene)
    return math.inf if found is None else found.swing / case.whole_mass


def weight_bound(spec: ChainDrive, scene: Start, loads: Loads) -> Offsets:
    """Change of any tension if the inertia of the take-up weight is neglected.

        entering tension, by its dynamic part:  d = 3 (M a_0/4 + kappa a M_chain)
        any other:                    d = T_0 (3.4 a_0/(2 g) + kappa)

    The motion is linear; the change due to the weight is proportional to the starting force.

    **Range** below the threshold; unbounded above.
    **Error** calibrated: on 431 seeded chains started by a step the change of the entering tension was at most 2.1 of
    the bracket, 0.15 in the median; on belts, which have the same loop, the maximum drop of the leaving tension was T_0
    3.4 a_0/(2 g) at small kappa.
    **Source** take-up weight on two falls; coverage samples of belts and chains.
    """
    case = start_case(spec, scene)
    if case.line.takeup_mass == 0:
        return {}
    if weight_criterion(spec, scene).exceeded:
        return _anything(loads)
    kappa, drive = _weight_numbers(spec, scene, case)
    change = case.line.run_off * (3.4 * drive / 2 + kappa)
    pushed = (
        case.line.takeup_mass / 4 * drive * spec.gravity
        + kappa * _acceleration(spec, scene, case) * case.masses.belt_mass
    )
    others = _unless_slack(spec, case, change, loads)
    if not all(one.bounded for one in others.values()):
        return others
    at_drive = start_bounds.spread(spec, case, 3 * pushed, 3 * pushed, loads)
    return {**others, **{name: one for name, one in at_drive.items() if name != "tension_min"}}


def _unless_slack(spec: ChainDrive, case: StartCase, change: float, loads: Loads) -> Offsets:
    """Offsets when every dynamic tension may be off by so much [N]; anything where the chain may go slack by it."""
    found = start_bounds.spread(spec, case, change, change, loads)
    lowest = loads["tension_min"].low if "tension_min" in loads else start_bounds.enclosed(case)["tension_min"].low
    if lowest - change >= 0:
        return found
    return {**_anything(loads), **{name: found[name] for name in ("tension_min",) if name in found}}


# -- teeth that pass ------------------------------------------------------------------------------------------------


def teeth_criterion(spec: ChainDrive, scene: Start | SpeedRange) -> Criterion:
    """Upper bound of the tension added to the entering strand by the teeth during a speed change, relative to the
    static tension.

        P/S_static,   P of `passing.Passing.teeth_bound`;   infinite if the entering strand has no tension

    **Range** any start and any range of speeds, which both sprockets of a driven tail keep; infinite under torques of
    sprockets that are not synchronised.
    **Error** an upper bound.
    **Source** derived in `chain_start.passing_bound`; the threshold of 5 % is an engineering choice.
    """
    static = chain_line(spec, scene).run_on
    value = _teeth(spec, scene) / static if static > 0 else math.inf
    meaning = "maximum tension added by tooth engagement / static tension"
    return Criterion("P/S", value, TEETH_THRESHOLD, meaning, "laws.chain_start.passing_bound")


def _teeth(spec: ChainDrive, scene: Start | SpeedRange) -> float:
    """The bound of either scene [N]; unbounded for a driven tail under shared torques."""
    if isinstance(scene, SpeedRange):
        return range_passing(spec, scene).teeth_bound(spec)
    case = start_case(spec, scene)
    if _apart(spec, case):
        return math.inf
    if not _moves(spec, case):
        return 0.0
    return curve_teeth(spec, scene) if case.follows_curve else start_passing(spec, scene).teeth_bound(spec)


def teeth_bound(spec: ChainDrive, scene: Start | SpeedRange, loads: Loads) -> Offsets:
    """Change of any tension of a start due to the teeth, and the total dynamic tension of a speed sweep.

        start: |dS| <= P      range of speeds: 0 <= S <= P + m |e| R

    On a motor curve P is the sum of the bounds for a drive whose torque does not depend on its speed, and for a drive
    whose speed does not change (`teeth.curve_teeth`).

    **Range** a taut chain and a sprocket speed that only rises or only falls, that of both sprockets of a driven tail;
    unbounded under torques of sprockets that are not synchronised.
    **Error** a bound; see `chain_start.passing_bound`.
    **Source** variation of the input of every mode, derived.
    """
    most = _teeth(spec, scene)
    if not math.isfinite(most):
        return {name: ANYTHING for name in loads if name in TENSIONS or name == "tension_speed_range"}
    if isinstance(scene, Start):
        return _unless_slack(spec, start_case(spec, scene), most, loads)
    passing = range_passing(spec, scene)
    most += 2 * passing.masses.belt_mass * passing.sharpest
    found = {}
    for name, ends in range_loads(spec, scene, Estimate(0.0, 0.0, most)).items():
        if name in loads:
            found[name] = Interval(min(ends.low - loads[name].low, 0.0), max(ends.high - loads[name].high, 0.0))
    return found


_STARTS: frozenset[type[Scene]] = frozenset({Start})
_STOPS: frozenset[type[Scene]] = frozenset({Stop, EmergencyStop, Coast})
_TOOTHED: frozenset[type[Scene]] = frozenset((Start, SpeedRange))

EFFECTS_OF_MOTION: tuple[AnyEffect, ...] = (
    Effect("chain_elasticity", "chain elasticity", _STARTS | _STOPS, elastic_criterion, elastic_bound),
    Effect(
        "higher_modes",
        "higher longitudinal modes of the strands",
        _STARTS,
        modes_criterion,
        modes_bound,
        part_of="chain_elasticity",
    ),
    Effect("chain_sticking", "stick-slip of the load", _STARTS, sticking_criterion, sticking_bound),
    Effect(
        "tooth_passing",
        "polygon excitation during a speed change",
        _TOOTHED,
        teeth_criterion,
        teeth_bound,
    ),
    Effect(
        "takeup_weight",
        "inertia of the take-up weight",
        _STARTS,
        weight_criterion,
        weight_bound,
        calibrated=True,
    ),
)
