"""Stops and standstill of the rigid chain: way, time, brake torque, what braking adds, what runs back."""

import math
from collections.abc import Callable

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.components.run_back import runs_back
from ptmcalc.components.run_out import too_long_a_way
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Finding, Found, History, Result
from ptmcalc.contract.solver import AnySolver, Fidelity, Solver
from ptmcalc.laws import stopping
from ptmcalc.machines.chain_drive.holding.scenes import elsewhere
from ptmcalc.machines.chain_drive.machine.layout import ConveyorLayout
from ptmcalc.machines.chain_drive.machine.model import (
    ChainLine,
    FloatArray,
    chain_line,
    mean_arm,
    natural_frequencies,
    radius,
    shares_torque,
)
from ptmcalc.machines.chain_drive.machine.spec import (
    ChainDrive,
    ChainScene,
    Coast,
    EmergencyStop,
    Hold,
    Run,
    Start,
    Stop,
    Stopping,
)
from ptmcalc.machines.chain_drive.machine.strength import safety
from ptmcalc.machines.chain_drive.starting.motion import speed_over_time
from ptmcalc.machines.chain_drive.starting.waves import (
    TORQUE_SHARED,
    beyond_slack,
    course_at,
    extreme_anywhere,
    felt,
    one_section,
    peaks_at,
    sections_of,
)
from ptmcalc.machines.chain_drive.stopping.motion import (
    StopCase,
    StopSwing,
    allowed_way,
    extremes,
    stop_case,
    stop_factor,
    swings,
)
from ptmcalc.spec.scene import Scene

OF_STOP = frozenset({"tension_min", "safety_start", "tension_overload_braking"})
"""Loads of a stop that depend on how the chain swings."""


def run(spec: ChainDrive, scene: Stopping, carried: frozenset[str], level: int) -> Result:
    """Stopping distance, stopping time, brake torque and tensions of the rigid chain.

        a = (M_b + W' R e/i)/(m R e/i + J i/R),   W' = W + M_b,sprocket/R,   e = eta or 1/eta by the power in the gear
        M_T = F_b R e/i + J a i/R,  F_b = m a - W,  a = v^2/(2 s);   S_ov = m a

    m includes chain, load, tail and sprocket; W is the lowest possible resistance. The brake torque rises linearly
    after its delay. The tension added by braking is that of the permissible stopping distance, or that of the given
    brake torque.

    **Range** any stop; infinite if nothing stops the motion. With a driven tail the brake is that of both sprockets;
    the tensions are known where they are synchronised.
    **Error** none of its own; the bound of the wave effect covers the tensions added by waves.
    **Source** lecture notes Kramatorsk 2007 in the signed form (`laws.stopping`).
    """
    case = stop_case(spec, scene)
    time, way = case.rest()
    coasts = isinstance(scene, Coast)
    loads = {"stop_time": time, "coast_distance" if coasts else "stop_distance": way}
    allowed = allowed_way(spec, scene)
    chain = case.line.moving_mass
    if allowed is not None:
        loads["brake_torque_required"] = stopping.brake_torque_for_distance(
            case.mass, case.line.static_resistance, case.line.speed, allowed, 2 * case.arm, case.ratio,
            case.efficiency, case.rotor, stopping.SIGNED,
        )  # fmt: skip
        loads["tension_overload_braking"] = float(stopping.braking_force(chain, case.line.speed, allowed))
    elif not coasts:
        loads["tension_overload_braking"] = chain * max(case.hardest, 0.0)
    found = extremes(spec, case)
    loads["tension_min"] = found.smallest
    loads["safety_start"] = safety(spec, found.largest + case.line.centrifugal)
    findings: tuple[Finding, ...] = ()
    if isinstance(scene, Coast) and scene.measured_distance is not None:
        told = _identified(spec, scene, case.line, scene.measured_distance)
        loads |= told
        findings = tuple(
            finding
            for coefficient in told.values()
            for finding in too_long_a_way(spec.all_scenes, scene, scene.measured_distance, coefficient)
        )
    unknown = OF_STOP if shares_torque(spec) else frozenset[str]()
    exact = {
        name: Found(Estimate.unknown(value) if name in unknown else Estimate.exact(value))
        for name, value in loads.items()
    }
    return Result(exact, work=1, findings=findings, histories=lambda: _histories(spec, case))


def _histories(spec: ChainDrive, case: StopCase) -> dict[str, History]:
    """Speed of the rigid chain over time, where it comes to rest."""
    if math.isinf(case.rest()[0]):
        return {}
    times, lost = speed_over_time(next(swings(spec, case)))
    return {"stop_time": History(units.SPEED, times.tolist(), (case.line.speed + lost).tolist())}


def _identified(spec: ChainDrive, scene: Coast, line: ChainLine, way: float) -> dict[str, float]:
    """Resistance coefficient of the chain that a measured way tells, that of a dragged load in the same proportion."""
    if not isinstance(spec.layout, ConveyorLayout):
        return {}
    case, given = stop_case(spec, scene), spec.layout.resistance
    running = chain_line(spec, scene)
    friction = running.back.resistance + running.working.resistance
    rest = running.back.weight + running.working.weight + running.tail_force
    moving = case.mass + case.rotor * (case.ratio / case.arm) ** 2 * case.efficiency  # the rotor drives the chain
    per_one = friction / given.coefficient
    found, _ = stopping.coast_down_coefficient(moving, rest, per_one, 1.0, line.speed, way, 0.0, 0.0)
    return {"resistance_coefficient_identified": found}


def waves(spec: ChainDrive, scene: Stopping, carried: frozenset[str], level: int) -> Result:
    """Tensions of a stop by superposition of many modes of both strands, from the switch-off of the motors to
    standstill.

        S(s) = S_static(s) + a (r(s) q + sum M_k(s) (x_k - q)),   q = -a(t)/a

    The reduced drive mass depends on the direction of power in the gear: both directions are computed, and the error
    bar contains both.

    **Range** a taut chain that slides forward until standstill, within 1000 periods of its lowest mode; teeth
    neglected.
    **Error** bounded: samples, sections, neglected modes, direction of the gear losses.
    **Source** sums over modes, derived in `numerics.mode_sum` and `chain_resonance`.
    """
    case = stop_case(spec, scene)
    lows, highs, work = [], [], 0
    courses: list[tuple[StopSwing, int, tuple[int, FloatArray]]] = []
    for swing in swings(spec, case):
        count = felt(spec, scene, swing, _MODES << level)
        sections = sections_of(swing, count)
        peaks = peaks_at(spec, scene, swing, count, sections)
        least, at, which = extreme_anywhere(swing, peaks, sections, count)
        lows.append((least, at))
        highs.append(extreme_anywhere(swing, peaks, sections, count, 1)[:2])
        courses.append((swing, count, one_section(sections, which)))
        work += peaks.samples
    smallest, where = _held_together(lows, min)
    largest, when = _held_together(highs, max)
    centrifugal = case.line.centrifugal
    middle, low, high = (safety(spec, one + centrifugal) for one in (largest.value, largest.high, largest.low))
    slope = middle / (largest.value + centrifugal) if largest.value > 0 else 0.0
    loads = {
        "tension_min": Found(smallest, where),
        "safety_start": Found(Estimate(middle, low, high, largest.numerical * slope), when),
    }

    def histories() -> dict[str, History]:
        which = [one.value for one, _ in lows].index(smallest.value)
        return {"tension_min": course_at(spec, scene, *courses[which], where["time"])}

    check = (
        "CHN127" if isinstance(spec.layout, ConveyorLayout) else ""
    )  # the other strand takes over between two shafts
    return beyond_slack(spec, Result(loads, work=work, window=(0.0, case.rest()[0]), histories=histories), check)


_MODES = 24
"""Modes at the coarsest level; twice as many at each finer one. A numerical choice: the rest is bounded and added. More
narrow the error bar and take longer."""
At = dict[str, float]


def _held_together(found: list[tuple[Estimate, At]], of: Callable[..., float]) -> tuple[Estimate, At]:
    """One number that holds several, its value the most extreme of them."""
    values = [one.value for one, _ in found]
    value = of(values)
    low, high = min(one.low for one, _ in found), max(one.high for one, _ in found)
    bar = max(value - low, high - value)
    return Estimate(value, low, high, numerical=bar), found[values.index(value)][1]


def waves_valid(spec: ChainDrive, scene: Stopping) -> Criterion:
    """Whether there is a stop to compute: it ends, and not after ever so many swings.

        n = f_1 t/1000 for a time t to rest; 1 where nothing stops it, or where a driven tail is not synchronised

    **Range** any stop.
    **Error** exact.
    **Source** the waves of a stop are followed from the first moment to rest.
    """
    if shares_torque(spec):
        return TORQUE_SHARED
    time, _ = stop_case(spec, scene).rest()
    if math.isinf(time):
        return Criterion("n", 1.0, 1.0, "nothing stops the motion", "count")
    value = time * float(natural_frequencies(spec, scene)[0]) / (2e3 * math.pi)
    return Criterion("n", value, 1.0, "oscillations of the chain before standstill, in thousands", "count")


def _waves_cost(spec: ChainDrive, scene: Stopping, carried: frozenset[str], level: int) -> float:
    time, _ = stop_case(spec, scene).rest()
    if math.isinf(time):
        return 0.0
    count = felt(spec, scene, next(swings(spec, stop_case(spec, scene))), _MODES << level)
    samples = 2 * float(natural_frequencies(spec, scene)[0]) * 2 * count * time
    return 5e-2 + 2 * samples * count * 3e-7


def notes(spec: ChainDrive, scene: Stopping, carried: frozenset[str], level: int) -> Result:
    """Textbook stop: brake torque for the permissible distance, tension added by braking, coasting distance.

        M_T = (|W| + m v^2/(2 s)) R eta/i + J a i/R,   S_ov = m v^2/(2 s),   s = m v^2/(2 W)

    **Range** the lowest resistance of the file; R through the pins; coasting without the motors.
    **Error** no bound: uphill the formula adds the resistance to the brake force instead of subtracting it.
    **Source** lecture notes Kramatorsk 2007, M, M_st and M_T in turn.
    """
    case = stop_case(spec, scene)
    line, chain = case.line, case.line.moving_mass
    if isinstance(scene, Coast):
        way, time = stopping.coasting(chain, line.static_resistance, 0.0, line.speed)
        loads = {"coast_distance": way, "stop_time": time}
        return Result({name: Found(Estimate.exact(value)) for name, value in loads.items()}, work=1)
    allowed = allowed_way(spec, scene)
    if allowed is None:
        return Result({}, work=1)
    torque = stopping.brake_torque_for_distance(
        chain, line.static_resistance, line.speed, allowed, 2 * radius(spec), case.ratio, case.efficiency, case.rotor,
        stopping.NOTES,
    )  # fmt: skip
    loads = {
        "brake_torque_required": torque,
        "tension_overload_braking": float(stopping.braking_force(chain, line.speed, allowed)),
    }
    return Result({name: Found(Estimate.exact(value)) for name, value in loads.items()}, work=1)


def hold(spec: ChainDrive, scene: ChainScene, carried: frozenset[str], level: int) -> Result:
    """Rollback torque of a stopped, loaded conveyor on the sprocket shaft.

        M = (q_G H g - W_friction) R,   not below 0

    **Range** standstill, the whole working strand loaded or empty as in the scene, minimum friction; without the impact
    of a backstop that engages with backlash.
    **Error** exact except for the friction coefficient.
    **Source** lecture notes Kramatorsk 2007.
    """
    line = chain_line(spec, Hold(load=scene.load), stop_factor(spec))
    friction = line.back.resistance + line.working.resistance + stop_factor(spec) * line.tail_force
    force = line.back.weight + line.working.weight - friction
    torque = float(stopping.backstop_torque(force, 2 * mean_arm(spec), 1.0))
    loose = torque > 0 and spec.backstop is None and spec.brake is None
    failures = (runs_back("CHN129", "chain", torque),) if loose else ()
    return Result({"backstop_torque": Found(Estimate.exact(torque))}, work=1, failures=failures)


_SCENES: frozenset[type[Scene]] = frozenset({Stop, EmergencyStop, Coast})
_NOTES = "lecture notes Kramatorsk 2007"
STOPPED: Solver[ChainDrive, Stopping] = Solver(
    name="chain_stop",
    title="stop, rigid chain",
    fidelity=Fidelity.FORMULA,
    scenes=_SCENES,
    represents=frozenset(),
    gives=OF_STOP
    | {
        "stop_time",
        "stop_distance",
        "coast_distance",
        "brake_torque_required",
        "resistance_coefficient_identified",
    },
    run=run,
    cost=lambda spec, scene, carried, level: 5e-4,
    source=f"{_NOTES}, signed form",
)
STOP_NOTES: Solver[ChainDrive, Stopping] = Solver(
    name="chain_stop_notes",
    title="textbook stop",
    fidelity=Fidelity.FORMULA,
    scenes=_SCENES,
    represents=frozenset(),
    gives=frozenset({"brake_torque_required", "tension_overload_braking", "coast_distance", "stop_time"}),
    run=notes,
    cost=lambda spec, scene, carried, level: 5e-5,
    source=_NOTES,
    decides=False,
)
HELD: Solver[ChainDrive, ChainScene] = Solver(
    name="chain_hold",
    title="rollback torque of the stopped chain",
    fidelity=Fidelity.FORMULA,
    scenes=_SCENES | {Hold, Start, Run},
    represents=frozenset(),
    gives=frozenset({"backstop_torque"}),
    valid=elsewhere,
    run=hold,
    cost=lambda spec, scene, carried, level: 5e-5,
    source=_NOTES,
)
STOP_WAVES: Solver[ChainDrive, Stopping] = Solver(
    name="chain_stop_waves",
    title="stop, modal superposition of both strands",
    fidelity=Fidelity.MODAL,
    scenes=_SCENES,
    represents=frozenset({"chain_elasticity"}),
    gives=frozenset({"tension_min", "safety_start"}),
    run=waves,
    cost=_waves_cost,
    source="sums over modes; derived in ptmcalc.numerics.mode_sum",
    valid=waves_valid,
    always=frozenset({"chain_elasticity"}),
    levels=2,
)
SOLVERS_OF_STOPS: tuple[AnySolver, ...] = (STOPPED, STOP_NOTES, HELD, STOP_WAVES)
