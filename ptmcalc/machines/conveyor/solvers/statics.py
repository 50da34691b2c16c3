"""Steady running: tensions strand by strand."""

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor import bounds
from ptmcalc.machines.conveyor.loads import OF_BELT
from ptmcalc.machines.conveyor.model import belt_line
from ptmcalc.machines.conveyor.spec import Conveyor, Run


def run(spec: Conveyor, scene: Run, carried: frozenset[str], level: int) -> Result:
    """Tensions of a steadily running belt from the drum's run-off round the loop.

        S(s) = S_off + integral of (resistance + gradient) ds;   S_on = S_off + W

    with S_off the take-up's (gravity) or such that the mean round the loop is the mounting tension (rigid: the
    total elongation of the belt does not change when it runs).

    **Range** one drive drum at the head; take-up beside it; friction independent of speed.
    **Error** exact for that model: a sum of the given resistances.
    **Source** ISO 5048:1989; DIN 22101; mean tension of a fixed loop derived from constant elongation.
    """
    line = belt_line(spec, scene)
    ends = line.static_ends(RETURN) + line.static_ends(CARRY)
    loads = {
        "static_resistance": line.static_resistance,
        "tension_run_on_max": line.run_on,
        "tension_run_off_min": line.run_off,
        "tension_max": max(ends),
        "tension_min": min(ends),
    }
    loads |= bounds.derived_loads(line, max(ends), (min(line.static_ends(RETURN)), min(line.static_ends(CARRY))))
    if line.grip_exponent is not None:
        loads |= bounds.slip_loads(
            line.grip_exponent, [bounds.Sides(line.run_on, line.run_off, line.centrifugal_at_speed)]
        )
    position = np.array([0.0, line.back.length, line.back.length, line.back.length + line.carry.length])
    places = {
        "tension_max": {"position": float(position[int(np.argmax(ends))])},
        "tension_min": {"position": float(position[int(np.argmin(ends))])},
    }
    return Result({name: Found(Estimate.exact(value), places.get(name, {})) for name, value in loads.items()}, work=1)


STATICS: Solver[Conveyor, Run] = Solver(
    name="statics",
    title="strand tensions of steady running",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Run}),
    represents=frozenset(),
    gives=OF_BELT - {"tension_dynamic_run_on_max"} | {"static_resistance"},
    run=run,
    cost=lambda spec, scene, carried, level: 5e-5,
    source="ISO 5048:1989; DIN 22101",
)
