"""What needs no motion: natural frequencies, their distance from excitations, worn teeth."""

import math

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result, of
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import backlash
from ptmcalc.machines.drivetrain.links.loads import WEAR
from ptmcalc.machines.drivetrain.machine.keys.torques import SineTorque
from ptmcalc.machines.drivetrain.machine.model import case_of
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain, Run, Start, Stop, TrainScene
from ptmcalc.machines.drivetrain.motion.by_terms import time_by_terms
from ptmcalc.machines.drivetrain.motion.loads import START_BY_TERMS, STOP_BY_TERMS
from ptmcalc.machines.drivetrain.motors.loads import BRAKING
from ptmcalc.machines.drivetrain.motors.overhauling import braking_reserve
from ptmcalc.machines.drivetrain.vibration.loads import LOADS_OF_VIBRATION
from ptmcalc.numerics.train.modes import frequencies

_GIVEN = (*LOADS_OF_VIBRATION, WEAR, START_BY_TERMS, STOP_BY_TERMS, BRAKING)


def run(spec: Drivetrain, scene: TrainScene, carried: frozenset[str], level: int) -> Result:
    """Natural frequencies of the train with closed backlash and without slip, and loads that require no simulation.

        det(K - w^2 M) = 0        distance = min_k |W/w_k - 1|        wear share = w/(pi m/2)

    Starting and stopping times by the textbook reduction, with an efficiency per term, have no bound and are shown only
    (`machines.drivetrain.motion.by_terms`).

    **Range** links in contact; damping below a tenth of critical damping changes a frequency by less than 0.5 %.
    **Error** rounding.
    **Source** linear vibration; zero frequencies of rigid-body motion are counted, not computed.
    """
    found = frequencies(case_of(spec, scene, backlash=False).train)
    loads = {of("natural_frequency", str(k)): Found(Estimate.exact(float(w))) for k, w in enumerate(found, 1)}
    for name, torque in spec.torques.items():
        if isinstance(torque, SineTorque):
            apart = min((abs(torque.omega / float(w) - 1) for w in found), default=math.inf)
            loads[of("resonance_separation", name)] = Found(Estimate.exact(apart))
    for name, link in spec.links.items():
        if link.clearance is not None:
            given = link.clearance
            share = backlash.wear_share(given.wear or 0.0, given.module) if given.module else 0.0
            loads[of("wear_share", name)] = Found(Estimate.exact(share))
    if isinstance(scene, Start | Stop):
        time = time_by_terms(spec, scene)
        if time is not None:
            name = "stop_time_by_terms" if isinstance(scene, Stop) else "start_time_by_terms"
            loads[name] = Found(Estimate.unknown(time))
    loads |= braking_reserve(spec, scene)
    return Result(loads, work=1)


MODAL: Solver[Drivetrain, TrainScene] = Solver(
    name="modal_train",
    title="natural frequencies of the drivetrain",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Run, Start, Stop}),
    represents=frozenset(),
    gives=frozenset(info.name for info in _GIVEN),
    run=run,
    cost=lambda spec, scene, carried, level: 2e-3,
    source="linear vibration",
)
