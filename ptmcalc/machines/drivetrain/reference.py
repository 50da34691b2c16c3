"""The second method for drive trains: Runge-Kutta steps from event to event, which no plan offers.

Shared with the solvers: the list of parts with its numbers, the window of a scene, the value of a smooth torque curve.
Equations, contact, friction, events and what is read of a run are its own.
"""

import math

from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Result, of
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.drivetrain.machine.model import REACHED, Case, case_of, rigid
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain, Run, Start, Stop, TrainScene
from ptmcalc.machines.drivetrain.motion import simulation
from ptmcalc.machines.drivetrain.motion.loads import MOVING
from ptmcalc.reference import lumped, lumped_cost, two_runs
from ptmcalc.reference.lumped_history import History

_AS_GOOD_AS_STILL = 1e-6
"""Speed relative to the largest of the scene [1] that counts as nearly standstill. A numerical choice: the steps do not
decide whether it stops just before the end. A larger value omits more reference values."""


def run(spec: Drivetrain, scene: TrainScene, carried: frozenset[str], level: int) -> Result:
    """Loads of a scene with all links elastic, by eighth-order steps (DOP853) between events.

        J_i w_i' = sum of torques,   link torque by its law of contact,   friction set-valued

    **Range** as the elastic train; impacts of one rigid contact at a time.
    **Error** three times the difference of two runs, the second with a hundredth of the tolerance of the first.
    **Source** Dormand and Prince; Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I, 2nd ed.
    """
    case = case_of(spec, scene, "backlash" in carried)
    end = simulation.window(scene, case)
    stiff = rigid(case_of(spec, scene, False))
    plain = _peaks(spec, stiff, lumped.simulate(stiff.train, end, lumped.TOLERANCES[level + 1]))
    runs = lumped.twice(case.train, end, level)
    found = []
    for history in runs:
        loads, peaks = _readings(spec, case, history), _peaks(spec, case, history)
        loads |= {of("torque_peak", name): peak for name, peak in peaks.items()}
        loads |= {of("dynamic_factor", name): peak / plain[name] for name, peak in peaks.items() if plain.get(name)}
        found.append(loads)
    return Result(two_runs.compared(*found), work=sum(history.steps for history in runs), window=(0.0, runs[-1].time))


def _peaks(spec: Drivetrain, case: Case, history: History) -> dict[str, float]:
    """Largest torque of every link and gear; of a link the train has a rigid joint for, that of the joint."""
    train, found = case.train, {}
    for name in (*spec.links, *spec.gears):
        for what, parts in (("link", train.springs), ("mesh", train.meshes)):
            names = [part.name for part in parts]
            if name in names:
                found[name] = history.largest(what, names.index(name))
                break
    return found


def _readings(spec: Drivetrain, case: Case, history: History) -> dict[str, float]:
    found: dict[str, float] = {}
    for index, name in enumerate(spec.inertias):
        found[of("speed_max", name)] = history.highest["speed", index]
        found[of("speed_min", name)] = history.lowest["speed", index]
        found[of("speed_end", name)] = history.last["speed", index]
        found[of("angle_end", name)] = history.last["position", index]
    names = [drive.name for drive in case.train.drives]
    for name in spec.motors:
        if name in names:
            number = names.index(name)
            found[of("motor_torque_peak", name)] = history.largest("drive", number)
            time = spec.checks.cycle_time or history.time
            found[of("motor_torque_rms", name)] = math.sqrt(float(history.squares[number]) / time)
    if case.stopping:
        group = history.mechanism.of[case.main]
        rests = history.times("turning", group, lambda turn: turn == 0)
        stopped = history.turning[group] == 0
        nearly = abs(history.last["speed", case.main]) <= _AS_GOOD_AS_STILL * history.largest("speed", case.main)
        if not stopped and nearly:
            return found  # it comes to rest as the scene ends: these steps cannot tell whether just before
        found["stop_time"] = (rests[-1] if rests else 0.0) if stopped else math.inf
        way = abs(history.last["position", case.main] - history.first["position", case.main])
        found["stop_angle"] = way if stopped else math.inf
    elif case.until is not None:
        signals = history.mechanism.signals
        watched = case.train.drives[names.index(REACHED)].stages[0].law
        reached = [one.time for one in history.events if one.kind == "signal" and signals[one.index] is watched]
        found["start_time"] = reached[0] if reached else math.inf
    return found


def cost(spec: Drivetrain, scene: TrainScene, carried: frozenset[str], level: int) -> float:
    """Seconds predicted: steps of the fastest component over the window, of two runs."""
    case = case_of(spec, scene, "backlash" in carried)
    return 0.1 + lumped_cost.seconds(case.train, simulation.window(scene, case), lumped.TOLERANCES[level : level + 2])


def valid(spec: Drivetrain, scene: TrainScene) -> Criterion | None:
    """Any train."""
    return None


DORMAND_PRINCE: Solver[Drivetrain, TrainScene] = Solver(
    name="dormand_prince",
    title="elastic train with backlash, DOP853 (reference)",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({Run, Start, Stop}),
    represents=frozenset({"elasticity", "backlash"}),
    gives=MOVING,
    run=run,
    cost=cost,
    source="Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I; derived in ptmcalc.reference",
    valid=valid,
    always=frozenset({"elasticity"}),
    levels=2,
)

REFERENCE_METHODS = (DORMAND_PRINCE,)
