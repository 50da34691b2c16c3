"""How far the load hangs behind and outwards by textbook formulas, beside the simulation."""

import math

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import pendulum
from ptmcalc.machines.crane.slewing.machine import model
from ptmcalc.machines.crane.slewing.machine.spec import Slew, SlewingCrane, SlewingScene
from ptmcalc.machines.crane.slewing.sway.slew import hangs


def run(spec: SlewingCrane, scene: SlewingScene, carried: frozenset[str], level: int) -> Result:
    """Tangential sway of a load at rest under a sudden jib acceleration, and its radial angle in steady slewing.

        theta_t = 2 atan(a/g),   a = R w/t of start or stop, the shorter;   tan(theta_r) = w^2 (R + L sin(theta_r))/g

    **Range** a start or a stop longer than half a sway period, with the load at rest before.
    **Error** no bound: a stop may add to the residual sway of the start, and the radial sway may reach several times
    the steady angle.
    **Source** `laws.pendulum.largest_lean`, `laws.pendulum.slewing_lean`.
    """
    load = spec.load
    assert load is not None
    assert load.rope_length is not None
    shortest = min(model.start_of(spec, scene)[0], (model.stop(spec, scene) or model.allowed_stop(spec))[0])
    out = pendulum.slewing_lean(spec.speed, load.radius, load.rope_length, spec.gravity)
    loads = {"sway_radial_max": out}
    if shortest > 0 and math.isfinite(shortest):
        behind = pendulum.largest_lean(load.radius * spec.speed / shortest, spec.gravity)
        loads["sway_tangential_max"] = float(behind)
    return Result({name: Found(Estimate.unknown(value)) for name, value in loads.items()}, work=1)


LEANS: Solver[SlewingCrane, SlewingScene] = Solver(
    name="leans",
    title="textbook sway and centrifugal angle of the load",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Slew}),
    represents=frozenset(),
    gives=frozenset({"sway_radial_max", "sway_tangential_max"}),
    run=run,
    cost=lambda spec, scene, carried, level: 5e-5,
    source="pendulum under a constant acceleration; conical pendulum",
    valid=hangs,
    decides=False,
)
