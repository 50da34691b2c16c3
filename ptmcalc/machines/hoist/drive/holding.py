"""Holding torque of the brake by a named rule: CMAA 70, OSHA 1910.179, FEM 1.001 or EN 14492-2."""

import math

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.check import Check, LimitState, Sense, at, blames, no_needs, only
from ptmcalc.contract.result import Found, LoadInfo, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.contract.topic import Topic
from ptmcalc.laws import brake, hoisting
from ptmcalc.machines.hoist.drive import torques
from ptmcalc.machines.hoist.machine import model
from ptmcalc.machines.hoist.machine.keys.drive import Brake, Holding
from ptmcalc.machines.hoist.machine.model import loaded
from ptmcalc.machines.hoist.machine.spec import Hoist, HoistScene, Run

TORQUE, RESERVE = "holding_load_torque", "holding_torque_ratio"
LOADS = (
    LoadInfo(TORQUE, "load torque at brake shaft by the named rule", units.TORQUE, headline=False),
    LoadInfo(RESERVE, "torque of one brake / load torque by the named rule", units.RATIO),
)
_ONE, _TWO_EACH = 1.6, 1.25
"""Brake torque over load torque of FEM 1.001 and EN 14492-2 [1]: of one brake (`_ONE`), of each of two brakes for
hazardous loads (`_TWO_EACH`). Quoted from engineering knowledge, to be compared with the edition of the file."""
_ELECTRIC, _MECHANICAL = 1.25, 1.0
"""Brake torque over full-load hoisting torque of CMAA 70 and OSHA 1910.179 [1]: with control braking other than
mechanical (`_ELECTRIC`); with mechanical control braking, and of each of two holding brakes (`_MECHANICAL`)."""
AMERICAN = ("cmaa_70", "osha_1910_179")
NAMES = {
    "cmaa_70": "CMAA 70",
    "osha_1910_179": "OSHA 1910.179",
    "fem_1_001": "FEM 1.001",
    "en_14492_2": "EN 14492-2",
}


def required(holding: Holding) -> float:
    """Torque of one brake over the load torque that a rule requires [1]."""
    if holding.factor is not None:
        return holding.factor
    if holding.rule in AMERICAN:
        return _MECHANICAL if holding.control_braking == "mechanical" or holding.brakes == 2 else _ELECTRIC
    return _TWO_EACH if holding.brakes == 2 else _ONE


def basis(holding: Holding) -> str:
    """Which torque of the load the rule refers to: hoisting with losses, or without them, or that which is held."""
    if holding.load_torque is not None:
        return holding.load_torque
    return "hoisting" if holding.rule in AMERICAN else "without_losses"


def load_torque(spec: Hoist, given: Brake, which: str) -> float:
    """Torque of the rated load on the shaft of the brake, at the worst hook position [N*m].

        hoisting: M_up/(u eta),   without losses: M_0/u,   holding: M_down eta_r/u

    **Range** M_up, M_0 and M_down with losses of the sheaves against, without and with the load; u = 1 on the drum.
    **Error** exact for that model.
    **Source** power balance of reeving and gearbox.
    """
    mass, on_motor = spec.hook_block + spec.load, given.shaft == torques.MOTOR_SHAFT
    ratio = torques.gearbox_of(spec).ratio if on_motor else 1.0
    if which == "without_losses":
        free = spec.with_value(("reeving", "sheave_efficiency"), 1.0)
        free = free.with_value(("reeving", "deflection_efficiency"), 1.0)
        return model.drum_torque(free, mass, None, hauling=True) / ratio
    up = which == "hoisting"
    on_drum = model.drum_torque(spec, mass, None, hauling=up)
    if up:
        return hoisting.hoisting_torque(on_drum, ratio, model.efficiency(spec) if on_motor else 1.0)
    return hoisting.lowering_torque(on_drum, ratio, model.reverse_efficiency(spec) if on_motor else 1.0)


def run(spec: Hoist, scene: HoistScene, carried: frozenset[str], level: int) -> Result:
    """Torque of one brake relative to the load torque, as the named rule defines it.

        k = M_B (1 - v)/(n M_L),   M_L = M_up/(u eta), M_0/u or M_down eta_r/u

    **Range** steady load, the worst hook position; equal brakes.
    **Error** exact for that model.
    **Source** power balance of reeving and gearbox; the rule of the file.
    """
    given = spec.brake
    if given is None or given.holding is None:
        return Result({}, work=1)
    holding = given.holding
    load = load_torque(spec, given, basis(holding))
    kept = given.torque * (1 - holding.torque_loss) / holding.brakes
    note = f"{NAMES[holding.rule]}, {holding.edition}, load torque: {basis(holding).replace('_', ' ')}"
    if holding.factor is None:
        note += f"; {required(holding):.3g} to be compared with the rule"
    found = {
        TORQUE: Found(Estimate.exact(load)),
        RESERVE: Found(Estimate.exact(brake.brake_reserve(kept, load)), note=note),
    }
    return Result(found, work=1)


SOLVER: Solver[Hoist, HoistScene] = Solver(
    name="holding_by_rule",
    title="brake holding torque by a named rule",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Run}),
    represents=frozenset(),
    gives=frozenset(info.name for info in LOADS),
    run=run,
    cost=lambda spec, scene, carried, level: 2e-4,
    source="power balance of reeving and gearbox; the rule of the file",
)


def _wanted(spec: Hoist, scene: HoistScene) -> bool:
    return loaded(spec, scene) and spec.brake is not None and spec.brake.holding is not None


def _limit(spec: Hoist, scene: Run) -> Estimate:
    """Required torque of one brake relative to the load torque, by the rule or from the file.

    CMAA 70 and OSHA 1910.179: 1.25 with control braking other than mechanical, 1 with mechanical control braking, 1 of
    each of two brakes. FEM 1.001 and EN 14492-2: 1.6, each of two brakes for hazardous loads 1.25.

    **Range** holding brakes of hoists.
    **Error** none: a rule, to be compared with its edition.
    **Source** CMAA 70 and OSHA 1910.179 by public regulations; FEM 1.001 and EN 14492-2 quoted from engineering
    knowledge.
    """
    holding = spec.brake.holding if spec.brake is not None else None
    return Estimate.exact(math.inf if holding is None else required(holding))


HOLDS: Check[Hoist, Run] = only(_wanted)(
    Check(
        code="HST161",
        hazard=True,
        title="brake holding torque by the named rule",
        question="Does each brake have the torque that the named rule requires?",
        failure="holding torque of the brake is below that of the named rule",
        limit_state=LimitState("brake does not hold the load", 1),
        scenes=frozenset({Run}),
        loads=(RESERVE,),
        sense=Sense.AT_LEAST,
        limit=_limit,
        needs=no_needs,
        blame=blames("brake", "torque"),
        repair=at("brake", "torque"),
        what="The torque of each brake, less its loss by wear, is at least the factor of the rule times the load torque"
        " of the rule.",
        why="The rules differ by the torque to which they refer: the hoisting torque with losses is larger than the"
        " torque that the brake holds.",
        formula="M_B (1 - v)/(n M_L) >= k_B",
        source="CMAA 70, OSHA 1910.179, FEM 1.001, EN 14492-2; to be compared with the edition of the file",
    )
)

HOLDING_RULE: Topic[Hoist] = Topic(
    loads=LOADS,
    solvers=(SOLVER,),
    checks=(HOLDS,),
    symbols="""\
M_B: torque of all brakes [N*m]
    HST161 holding_by_rule
v: loss of the brake torque by wear [1]
    HST161 holding_by_rule
n: number of brakes [1]
    HST161 holding_by_rule
M_L: load torque of the rule on the shaft of the brake [N*m]
    HST161 holding_by_rule
k_B: factor of the rule [1]
    HST161
k: torque of one brake relative to the load torque [1]
    holding_by_rule
M_up: torque of the load on the drum, hoisting [N*m]
    holding_by_rule
M_0: torque of the load on the drum, without losses [N*m]
    holding_by_rule
M_down: torque of the load on the drum, lowering [N*m]
    holding_by_rule
u: ratio of the gear between brake and drum [1]
    holding_by_rule
eta: efficiency of the gear, hoisting [1]
    holding_by_rule
eta_r: efficiency of the gear, lowering [1]
    holding_by_rule
""",
)
