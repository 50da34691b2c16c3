"""Largest torque through the limiter in a start."""

import math
from collections.abc import Callable

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.base.memory import kept_for
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import loop_bounds
from ptmcalc.laws.loop_bounds import RETURN
from ptmcalc.machines.chain_drive.limiter.torque import (
    Through,
    extremes,
    larger,
    modes_through,
    negative,
    of_pull,
)
from ptmcalc.machines.chain_drive.limiter.trips import fitted, tripped
from ptmcalc.machines.chain_drive.machine.model import has_driven_tail, mean_arm
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Start
from ptmcalc.machines.chain_drive.speed_change.effects import weight_bound
from ptmcalc.machines.chain_drive.speed_change.motor_teeth import MOTOR_TEETH, curve_teeth_simulated
from ptmcalc.machines.chain_drive.speed_change.teeth import start_passing
from ptmcalc.machines.chain_drive.speed_change.tooth_passes import START_TEETH, TeethAlone
from ptmcalc.machines.chain_drive.starting.bounds import enclosed
from ptmcalc.machines.chain_drive.starting.motion import StartCase, sprocket_mass, start_case
from ptmcalc.machines.chain_drive.starting.motor_curve_waves import Judged, judged
from ptmcalc.machines.chain_drive.starting.motor_curve_waves import valid as curve_valid
from ptmcalc.machines.chain_drive.starting.motor_force import stands_still, start_force
from ptmcalc.machines.chain_drive.starting.waves import felt, later, valid, waves
from ptmcalc.numerics.mode_sum import mode_sum

_MODES = 24
"""Modes at the coarsest level; four times as many at each finer one. A numerical choice: the rest is bounded and added.
More narrow the error bar and take longer."""
_LEVELS = 2
"""Refinements of both solvers; a numerical choice. The arms of the teeth make up most of a refined error bar, which
more refinements do not narrow."""


@kept_for(64)
def start_torque(spec: ChainDrive, scene: Start, level: int) -> tuple[Estimate, float | None]:
    """Largest torque through the limiter in a start as if it held [N*m], and when it acts [s]."""
    case, arm = start_case(spec, scene), mean_arm(spec)
    leaving, own = Interval(case.line.run_off, case.line.run_off), sprocket_mass(spec)
    rigid = case.line.static_resistance + case.acceleration * (case.line.moving_mass + own)
    if has_driven_tail(spec):
        return Estimate.unknown(arm * rigid), None
    if not case.moves and not case.follows_curve:
        return of_pull(spec, Estimate.exact(case.available), leaving), None
    if spec.effects.get("chain_elasticity") == "off" and not case.follows_curve:
        return of_pull(spec, Estimate.exact(rigid), leaving), None
    if case.follows_curve and stands_still(spec, case):
        return of_pull(spec, Estimate.exact(start_force(spec, case).standing), leaving), None
    if case.follows_curve and not curve_valid(spec, scene).exceeded:
        return _on_curve(spec, scene, case, level)
    if valid(spec, scene).exceeded:
        return Estimate.unknown(arm * rigid), None
    share = 0.0 if case.imposed_speed else own / case.masses.drive_mass
    through = Through(1 - share, own if case.imposed_speed else share * case.masses.total_mass)
    modes = modes_through(spec, scene, case, felt(spec, scene, case, _MODES << (2 * level)), through)
    peaks = mode_sum(modes, case.course, case.window)
    after = float(later(case, modes).max())
    most, least = extremes(peaks, case.acceleration, case.line.static_resistance, after)
    beside, leaving = _beside(spec, scene, case, most)
    most, least = (one.widened(Interval(-beside, beside)) for one in (most, least))
    torque = larger(of_pull(spec, most, leaving), of_pull(spec, negative(least), leaving))
    return torque, case.held + float(peaks.largest_time[0])


def _on_curve(spec: ChainDrive, scene: Start, case: StartCase, level: int) -> tuple[Estimate, float | None]:
    """The same of a start that follows the curve of its motors: the force behind motors and gear."""
    try:
        found = judged(spec, scene, level)
        beside, leaving = _beside_curve(spec, scene, case, found)
    except NumericsError:
        return Estimate.unknown(mean_arm(spec) * case.available), None
    most, least = (one.widened(Interval(-beside, beside)) for one in (found.most, found.least))
    return larger(of_pull(spec, most, leaving), of_pull(spec, negative(least), leaving)), found.times[1]


def _beside_curve(spec: ChainDrive, scene: Start, case: StartCase, found: Judged) -> tuple[float, Interval]:
    """`_beside` of a start that follows the curve of its motors; its teeth are simulated."""
    if scene.chain == "relaxed" and spec.effects.get("chain_sticking") != "off":
        return math.inf, Interval(0.0, math.inf)
    teeth = TeethAlone(0.0, 0.0, 0.0, 0)
    if spec.effects.get("tooth_passing") != "off":
        teeth = curve_teeth_simulated(spec, scene, 0)[-1]
    weight = _of_weight(spec, scene, found.dynamic)
    if not found.smallest.low >= teeth.taken + weight:
        return math.inf, Interval(0.0, math.inf)
    bound = (2 if _moves_off(case) else 1) * (max(teeth.entering, teeth.added) + weight)
    return bound, Interval(0.0, found.leaving + bound)


def _beside(spec: ChainDrive, scene: Start, case: StartCase, most: Estimate) -> tuple[float, Interval]:
    """Bound of what the modes leave out [N], and the interval of the tension of the leaving chain [N].

    Each effect may change the tension of the entering chain, and that of the leaving one if its end is not free.
    """
    if scene.chain == "relaxed" and spec.effects.get("chain_sticking") != "off":
        return math.inf, Interval(0.0, math.inf)
    moved = _moves_off(case)
    teeth = 0.0 if spec.effects.get("tooth_passing") == "off" else start_passing(spec, scene).teeth_bound(spec)
    weight = _of_weight(spec, scene, most)
    if not _stays_taut(spec, scene, case, teeth + weight):
        return math.inf, Interval(0.0, math.inf)
    bound = (2 if moved else 1) * (teeth + weight)
    off = case.line.run_off + bound + (case.acceleration * _of_fixed_loop(case) if case.line.fixed_length else 0.0)
    return bound, Interval(0.0, off)


def _of_weight(spec: ChainDrive, scene: Start, most: Estimate) -> float:
    """Bound of the change of any tension by the inertia of the take-up weight [N]."""
    if spec.effects.get("takeup_weight") == "off":
        return 0.0
    taut = {"tension_dynamic_start": most, "tension_min": Estimate.exact(math.inf)}
    offsets = weight_bound(spec, scene, taut).values()
    return max((max(-one.low, one.high) for one in offsets), default=0.0)


def _stays_taut(spec: ChainDrive, scene: Start, case: StartCase, change: float) -> bool:
    """Whether the chain stays taut: by the bound of its waves, or by its modes."""
    if enclosed(case)["tension_min"].low - change >= 0:
        return True
    return waves(spec, scene, frozenset(), 0).loads["tension_min"].estimate.low - change >= 0


def _of_fixed_loop(case: StartCase) -> float:
    """Most by which the leaving tension of a loop of fixed length exceeds the static one, per acceleration [kg]."""
    return 2 * float(loop_bounds.stray(case.masses, RETURN, 0.0))


@kept_for(64)
def toothed_torque(spec: ChainDrive, scene: Start, level: int) -> tuple[Estimate, float | None]:
    """The same by the tensions of a start with every tooth."""
    case, own = start_case(spec, scene), sprocket_mass(spec)
    loads = START_TEETH.run(spec, scene, START_TEETH.always, level).loads
    found, least = loads["tension_dynamic_start"], loads["tension_min"].estimate
    weight = _of_weight(spec, scene, found.estimate)
    if scene.chain == "relaxed" or not found.estimate.bounded or least.low < weight:
        return Estimate.unknown(mean_arm(spec) * (case.line.static_resistance + found.estimate.value)), None
    still, off, lowest = case.line.static_resistance, case.line.run_off, least.low - weight
    share, beside = _of_sprocket(case, own)
    swing = found.estimate.widened(Interval(-weight, weight))
    least_off, most_off = (lowest, off + _rise_of_leaving(case, weight)) if _moves_off(case) else (off, off)
    low = (1 - share) * (still + swing.low + off - most_off) + beside.low
    high = (1 - share) * (still + swing.high + off - least_off) + beside.high
    middle = (1 - share) * (still + swing.value) + (beside.low + beside.high) / 2
    value = min(max(middle, low), high)
    pull = Estimate(value, low, high, found.estimate.numerical)
    back = (1 - share) * (most_off - lowest) - beside.low
    backward = Estimate(min(0.0, back), min(0.0, back), max(back, 0.0))
    leaving = Interval(lowest, most_off)
    return larger(of_pull(spec, pull, leaving), of_pull(spec, backward, leaving)), found.at.get("time")


def _moves_off(case: StartCase) -> bool:
    """Whether the tension of the leaving chain changes."""
    return case.line.fixed_length or case.line.takeup_mass > 0


def _rise_of_leaving(case: StartCase, weight: float) -> float:
    """Most by which the leaving tension exceeds the static one without teeth [N]."""
    return weight + (case.acceleration * _of_fixed_loop(case) if case.line.fixed_length else 0.0)


def _of_sprocket(case: StartCase, own: float) -> tuple[float, Interval]:
    """Share of the tensions that the inertia of the sprocket takes off the limiter [1], and what it adds [N].

    F_l = (1 - m_s/m_d) (S_on - S_off) + m_s/m_d F,   W <= F <= W + M a;   S_on - S_off + m_s a_s of a given speed
    """
    if case.imposed_speed:
        return 0.0, Interval(0.0, own * case.acceleration)
    share, still = own / case.masses.drive_mass, case.line.static_resistance
    return share, Interval(share * still, share * (still + case.acceleration * case.whole_mass))


def best_torque(spec: ChainDrive, scene: Start, decided: Callable[[Estimate], bool]) -> Estimate:
    """The torque as close as it takes to decide something: by modes, then with every tooth [N*m]."""
    best = start_torque(spec, scene, 0)[0]
    if decided(best) or toothed(spec, scene).exceeded:
        return best
    one = toothed_torque(spec, scene, 0)[0]
    return one if not best.bounded or one.high - one.low < best.high - best.low else best


def run(spec: ChainDrive, scene: Start, carried: frozenset[str], level: int) -> Result:
    """Largest torque that the limiter transmits in a start without tripping.

        M = R |F_l|,   F_l = S_on - S_off + m_s a_s,   m_d a_s = F - (S_on - S_off),   r cos(pi/z) <= R <= r

    F is the force of the drive at the sprocket pitch circle, m_d the reduced mass of drive and sprocket, and m_s the
    part of the sprocket. The tensions on both sides of the sprocket are sums over modes, as in `chain_start_waves`.
    The value has the mean arm z p/(2 pi); the error bar contains every arm over the passage of a tooth. In a start on
    a motor curve F_l is that of `chain_motor_waves`.

    **Range** a taut chain that slides forward. Starts with a driven tail, of a relaxed chain or of one that may go
    slack have no bound.
    **Error** bounded: samples, neglected modes, passing teeth, inertia of the take-up weight, arms.
    **Source** equilibrium of the sprocket; sums over modes, derived in `numerics.mode_sum` and `chain_resonance`.
    """
    torque, time = start_torque(spec, scene, level)
    found = Found(torque, {} if time is None else {"time": time})
    return Result({"limiter_torque": found}, work=1, findings=tripped(spec, torque))


def run_teeth(spec: ChainDrive, scene: Start, carried: frozenset[str], level: int) -> Result:
    """Largest torque that the limiter transmits in a start without tripping, with every tooth that passes.

        M = R |F_l|,   F_l = (1 - m_s/m_d) (S_on - S_off) + m_s/m_d F

    The tensions are those of `chain_start_teeth`; the other symbols are those of `limiter_start`. The part of the
    sprocket is bounded by the smallest and the largest force of the drive.

    **Range** as `chain_start_teeth`.
    **Error** bounded: samples, neglected modes, arms, part of the sprocket, inertia of the take-up weight; of a loop of
    fixed length also the tension of the leaving chain.
    **Source** equilibrium of the sprocket; `numerics.run_through`.
    """
    torque, time = toothed_torque(spec, scene, level)
    found = Found(torque, {} if time is None else {"time": time})
    return Result({"limiter_torque": found}, work=1, findings=tripped(spec, torque))


def toothed(spec: ChainDrive, scene: Start) -> Criterion:
    """Whether the machine has a torque limiter, no driven tail, and a start whose teeth are simulated: 0, else 1.

    **Range** any machine.
    **Error** exact.
    **Source** the file; range of `chain_start_teeth`.
    """
    lacks = spec.torque_limiter is None or spec.effects.get("tooth_passing") == "off"
    lacks = lacks or has_driven_tail(spec) or not START_TEETH.usable_for(spec, scene)
    meaning = "0 with a torque limiter, no driven tail, and where chain_start_teeth applies, else 1"
    return Criterion("limiter", float(lacks), 1.0, meaning, "the file")


def _cost(spec: ChainDrive, scene: Start, carried: frozenset[str], level: int) -> float:
    """Predicted seconds: of the modes, or of the start on the curve of the motors with its teeth."""
    whole = 3e-2 * 8.0**level
    if start_case(spec, scene).follows_curve:
        whole += float(MOTOR_TEETH.cost(spec, scene, carried, level))
    return whole


LIMITER_START: Solver[ChainDrive, Start] = Solver(
    name="limiter_start",
    title="torque of the torque limiter, start",
    fidelity=Fidelity.MODAL,
    scenes=frozenset({Start}),
    represents=frozenset(),
    gives=frozenset({"limiter_torque"}),
    run=run,
    cost=_cost,
    source="equilibrium of the sprocket; sums over modes",
    valid=fitted,
    levels=_LEVELS,
    method="sums over modes",
)
_SIMULATED = frozenset({"chain_elasticity", "higher_modes", "tooth_passing"})
LIMITER_TEETH: Solver[ChainDrive, Start] = Solver(
    name="limiter_start_teeth",
    title="torque of the torque limiter, start with every tooth",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({Start}),
    represents=_SIMULATED,
    gives=frozenset({"limiter_torque"}),
    run=run_teeth,
    cost=lambda spec, scene, carried, level: 2e-2 + START_TEETH.cost(spec, scene, carried, level),
    source="equilibrium of the sprocket; derived in ptmcalc.numerics.run_through",
    valid=toothed,
    always=_SIMULATED,
    levels=_LEVELS,
)
