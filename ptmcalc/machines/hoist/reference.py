"""The second method for moving hoists: Runge-Kutta steps from event to event, which no plan offers; with the rope's
mass a chain of masses.

Shared with the solvers: the list of parts with its numbers, the window of a scene, the value of a smooth torque curve.
Equations, contact, friction, events and what is read of a run are its own.
"""

import math
from dataclasses import replace
from itertools import pairwise

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.hoist.machine.spec import Hoist, Lift, LowerBrake, Release, Start, Stop
from ptmcalc.machines.hoist.motion.cases import case_of
from ptmcalc.machines.hoist.motion.effects import ALWAYS, SCENES
from ptmcalc.machines.hoist.motion.loads import MOVING
from ptmcalc.machines.hoist.motion.reduced import rope_mass
from ptmcalc.machines.hoist.motion.train import (
    BRAKE,
    FLANK,
    GEARBOX,
    GROUND,
    HOOK,
    LEAST_LEFT,
    LOAD,
    ROPE,
    SHAFT,
    STRUCTURE,
    Case,
    Moving,
)
from ptmcalc.numerics.train.parts import LINEAR, Body, Train
from ptmcalc.reference import lumped, lumped_cost, two_runs
from ptmcalc.reference.lumped_history import History

_LONGER = 4
"""Doublings of the window in which a brake may bring the drive to rest; a numerical choice. The last window is 16 times
the first. More follow late stops and take longer."""
_SECTIONS = ((2, 4), (4, 8))
"""Sections of the rope in both runs by level. A numerical choice: the error falls with the square of the number. More
take longer."""
_STEPS = 1e-6
"""Relative tolerance of the Runge-Kutta steps of a rope in sections [1]. A numerical choice far below the error of the
sections. A smaller value takes more steps."""
_MARGIN = 3.0
"""Safety factor on the difference of two runs [1]. A numerical choice: of a quadratic series the rest is a third of the
difference. A smaller value weakens the reference; a larger one hides errors of the method it tests."""
Readings = dict[str, float]


def run(spec: Hoist, scene: Moving, carried: frozenset[str], level: int) -> Result:
    """Loads of a scene by eighth-order steps (DOP853) between events.

        J_1 w_1' = M_m - M_g/(u eta),   J_d w_d' = M_g - F R/eta_r,   M y'' = F - Q + N,   m_b z'' = F - K_b z - b_b z'

    **Range** a massless rope of constant length; the structure one mode.
    **Error** three times the difference of two runs, the second with a hundredth of the tolerance of the first.
    **Source** Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I, 2nd ed.
    """
    case = case_of(spec, scene, carried)
    tolerances = lumped.TOLERANCES[level : level + 2]
    return _compared(scene, *((case, tolerance) for tolerance in tolerances), margin=_MARGIN)


def run_chain(spec: Hoist, scene: Moving, carried: frozenset[str], level: int) -> Result:
    """The same with a rope of sections, half of the mass of each section at either end.

        (m_r/n) x_i'' = F_i - F_(i+1),   F_i = n K (x_(i-1) - x_i) + damping

    **Range** a rope that stays taut below its first section; rope inertia without rope weight, as in `rope_waves`.
    **Error** with n sections the waves of number k are slower by (k/n)^2/24; the error is three times the difference to
    half as many sections, of which the remainder of a quadratic series is a third.
    **Source** lumped masses: Timoshenko, Vibration Problems in Engineering.
    """
    case, mass = case_of(spec, scene, carried), rope_mass(spec, scene)
    cases = [replace(case, train=chained(case.train, mass, sections)) for sections in _SECTIONS[level]]
    return _compared(scene, *((one, _STEPS) for one in cases), margin=_MARGIN)


def chained(train: Train, mass: float, sections: int) -> Train:
    """A train with its rope in sections."""
    place = next(k for k, spring in enumerate(train.springs) if spring.name == ROPE)
    rope, bodies = train.springs[place], list(train.bodies)
    assert rope.second is not None
    hook, load = rope.first, rope.second
    for body in (hook, load):
        bodies[body] = replace(bodies[body], inertia=bodies[body].inertia + mass / sections / 2)
    inner = [len(bodies) + k for k in range(sections - 1)]
    taut = bodies[load].speed != 0
    bodies += [Body(f"{ROPE} {k}", mass / sections, 0.0, bodies[load].speed if taut else 0.0) for k in inner]
    above = 0.0 if rope.over is None else bodies[rope.over].position
    share = min(rope.rest + above, 0.0) / sections
    stiff = replace(rope, stiffness=sections * rope.stiffness, damping=sections * rope.damping)
    first = replace(stiff, second=inner[0], rest=rope.rest - (sections - 1) * share)
    ends = [*inner, load]
    others = [
        replace(stiff, name=f"{ROPE} {k}", first=one, second=two, law=LINEAR, side=0, rest=share, over=None)
        for k, (one, two) in enumerate(pairwise(ends))
    ]
    springs = (*train.springs[:place], first, *train.springs[place + 1 :], *others)
    return replace(train, bodies=tuple(bodies), springs=springs)


# -- what is read ----------------------------------------------------------------------------------------------------


def _compared(scene: Moving, *runs: tuple[Case, float], margin: float) -> Result:
    """The loads of the last of two runs, with bars from what they differ by."""
    found: list[Readings] = []
    steps, end = 0, 0.0
    for case, tolerance in runs:
        case, history = _played(case, tolerance)
        found.append(_readings(scene, case, history, tolerance))
        steps, end = steps + history.steps, history.time
    loads = {name: Found(two_runs.estimate(found[0][name], value, margin)) for name, value in found[1].items()}
    if found[1].get(_SLACK, 0.0) < 0:
        loads = {name: Found(Estimate.unknown(one.estimate.value)) for name, one in loads.items()}
    loads.pop(_SLACK, None)
    return Result(loads, work=steps, window=(0.0, end))


_SLACK = "tension below the first section"


def _played(case: Case, tolerance: float) -> tuple[Case, History]:
    history = lumped.simulate(case.train, case.window, tolerance)
    for _ in range(_LONGER if case.holds else 0):
        if history.turning[_braked(case, history)] == 0:
            break
        case = replace(case, window=2 * case.window)
        history = lumped.simulate(case.train, case.window, tolerance)
    return case, history


def _braked(case: Case, history: History) -> int:
    """What turns with the shaft of the brake."""
    brake = case.named("grip", BRAKE)
    return history.mechanism.of[case.train.grips[brake].first if brake is not None else 0]


def _readings(scene: Moving, case: Case, history: History, tolerance: float) -> Readings:
    """The loads of a run."""
    springs = case.train.springs
    ropes = [k for k, spring in enumerate(springs) if spring.name.startswith(ROPE)]
    most = max(history.highest["link", k] for k in ropes)
    least = min(history.lowest["link", k] for k in ropes)
    found = {"rope_force_max": most, "bridge_force_max": most}
    structure = case.named("link", STRUCTURE)
    if structure is not None:
        found["bridge_force_max"] = history.highest["link", structure]
    if isinstance(scene, Lift):
        found |= _of_the_lift(case, history, tolerance)
    else:
        found |= {"rope_force_min": least, "bridge_force_min": least}
        if structure is not None:
            found["bridge_force_min"] = history.lowest["link", structure]
        found["rope_force_share"] = least / case.weight
    if not isinstance(scene, Release):
        names = [(what, case.named(what, name)) for what, name in (("link", SHAFT), ("link", FLANK))]
        if names[0][1] is None:
            names = [("mesh", case.named("mesh", GEARBOX))]
        peak = max(history.largest(what, index) for what, index in names if index is not None)
        found |= {"backlash_torque_peak": peak, "gear_impact_factor": peak / case.even_torque}
    if case.stops:
        found |= _of_the_stop(case, history)
    found["bridge_factor"] = found["bridge_force_max"] / case.weight
    found[_factor(scene)] = (least if isinstance(scene, Release) else most) / case.weight
    lower = [history.lowest["link", k] for k in ropes[1:]]
    if lower:
        found[_SLACK] = min(0.0, min(lower) + 1e-6 * most)
    return found


def _factor(scene: Moving) -> str:
    """The name of the factor on the weight."""
    if isinstance(scene, Lift):
        return "lift_off_factor"
    if isinstance(scene, Release):
        return "release_factor"
    if isinstance(scene, Start):
        return "start_factor"
    down = isinstance(scene, LowerBrake) or scene.direction == "down"
    return "lowering_brake_factor" if down else "stop_factor"


def _of_the_lift(case: Case, history: History, tolerance: float) -> Readings:
    ground, rope, hook = case.named("link", GROUND), case.named("link", ROPE), case.named("body", HOOK)
    assert ground is not None
    assert rope is not None
    lifted = history.times("link", ground, lambda branch: branch[0] == "open")
    if not lifted or case.weak:
        return {"lift_off_speed": 0.0, "lift_off_time": math.inf, "tension_time": math.inf}
    taut = history.times("link", rope, lambda branch: branch[0] != "open")
    since = taut[0] if taut and taut[0] <= lifted[0] else 0.0
    until = lumped.simulate(case.train, lifted[0], tolerance)
    assert hook is not None
    return {
        "lift_off_speed": until.last["speed", hook],
        "lift_off_time": lifted[0],
        "tension_time": lifted[0] - since,
    }


def _of_the_stop(case: Case, history: History) -> Readings:
    load, group = case.named("body", LOAD), _braked(case, history)
    assert load is not None
    way = history.lowest["position", load] if case.lowers else history.highest["position", load]
    rests = history.times("turning", group, lambda turn: turn == 0)
    moves = any(body.speed for body in case.train.bodies)
    time = (rests[0] if rests and moves else 0.0) if history.turning[group] == 0 else math.inf
    name = "stop_distance_lowering" if case.lowers else "stop_distance"
    return {"stop_time": time, name: abs(way) if math.isfinite(time) else math.inf}


# -- what it costs, and where it holds -------------------------------------------------------------------------------


def cost(spec: Hoist, scene: Moving, carried: frozenset[str], level: int) -> float:
    """Seconds predicted: steps of the fastest component over the window, of two runs."""
    case = case_of(spec, scene, carried)
    return lumped_cost.seconds(case.train, case.window, lumped.TOLERANCES[level : level + 2])


def cost_chain(spec: Hoist, scene: Moving, carried: frozenset[str], level: int) -> float:
    """The same of the rope in sections."""
    case, mass = case_of(spec, scene, carried), rope_mass(spec, scene)
    trains = (chained(case.train, mass, sections) for sections in _SECTIONS[level])
    return sum(lumped_cost.seconds(train, case.window, (_STEPS,)) for train in trains)


def valid(spec: Hoist, scene: Moving) -> Criterion | None:
    """Not where what is left on the rope, or how quickly the load goes, is in doubt: those bars are intervals.

        1 for a release of everything, and for a slow one

    **Range** any scene in motion.
    **Error** exact.
    **Source** `machines.hoist.motion`.
    """
    if not isinstance(scene, Release):
        return None
    case = case_of(spec, scene, ALWAYS)
    if scene.manner == "slow" or case.left_weight <= LEAST_LEFT * case.weight:
        return Criterion("release", 1.0, 1.0, "a release known between two ends only", "machines.hoist.motion")
    return None


def valid_chain(spec: Hoist, scene: Moving) -> Criterion | None:
    """Where the rope has a mass and stays on the hook.

        1 for a rope without mass

    **Range** any scene in motion.
    **Error** exact.
    **Source** `machines.hoist.rope_case`.
    """
    if rope_mass(spec, scene) <= 0:
        return Criterion("m_r", 1.0, 1.0, "a rope without mass", "machines.hoist.rope_case")
    return valid(spec, scene)


DORMAND_PRINCE: Solver[Hoist, Moving] = Solver(
    name="dormand_prince",
    title="full hoist train, DOP853 (reference)",
    fidelity=Fidelity.TRANSIENT,
    scenes=SCENES,
    represents=ALWAYS | {"structure", "gear_elasticity", "gear_backlash"},
    gives=MOVING,
    run=run,
    cost=cost,
    source="Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I; derived in ptmcalc.reference",
    valid=valid,
    always=ALWAYS,
    levels=2,
)
ROPE_CHAIN: Solver[Hoist, Moving] = replace(
    DORMAND_PRINCE,
    name="rope_chain",
    title="full hoist train with a lumped-mass rope (reference)",
    scenes=frozenset({Lift, Start, Stop, LowerBrake}),
    represents=ALWAYS | {"structure", "gear_elasticity", "gear_backlash", "rope_mass"},
    run=run_chain,
    cost=cost_chain,
    valid=valid_chain,
    always=ALWAYS | {"rope_mass"},
    levels=len(_SECTIONS),
    method="chain of masses",
)
REFERENCE_METHODS = (DORMAND_PRINCE, ROPE_CHAIN)
