"""A run-out with constant inertia under losses and a brake that comes up in a straight line: closed form."""

import math

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.shaft.machine.spec import RunOut, Shaft
from ptmcalc.machines.shaft.speed_changes import run_out_bounds
from ptmcalc.machines.shaft.speed_changes.cases import departure, is_braked, stop_case
from ptmcalc.machines.shaft.speed_changes.loads import OF_RUN_OUT

_MEANING = "0 if the power flows from the rotor throughout and the brake holds at any angle, otherwise 1"


def run(spec: Shaft, scene: RunOut, carried: frozenset[str], level: int) -> Result:
    """Time and angle of a stop with the mean inertia, from the kinetic energy of the steady cycle.

        J w' = -(M_l + b w + M_b(t))   (`laws.shaft.braked_stop`)

    Without an angle in the file, the stop begins with the maximum kinetic energy of the cycle and is the longest
    possible stop.

    **Range** power flow from the rotor throughout; the initial state is that of the exact cycle.
    **Error** the error bar covers torques anywhere between their extremes over the angle; infinite if nothing stops the
    shaft.
    **Source** `laws.shaft.braked_stop`.
    """
    start = departure(spec, scene)
    stop, wanted = stop_case(spec, scene)
    ranges = run_out_bounds.run_out_ranges(stop, changing=False, wanted=wanted)
    ranges["energy_recoverable"] = run_out_bounds.recoverable(stop, ranges, changing=False)
    time, turned = stop.ended(0, changing=False)
    middle = (ranges["energy_recoverable"].low + ranges["energy_recoverable"].high) / 2
    values = {"run_out_time": time, "run_out_angle": turned, "energy_recoverable": middle}
    if wanted:
        values["brake_torque_needed"] = run_out_bounds.torque_needed(stop, wanted, 0, changing=False)
    beginning = start.beginning()
    at = beginning["kinetic_energy"].at
    found = {name: Found(_between(value, ranges[name]), at) for name, value in values.items()}
    return Result(found | beginning, work=start.cycle.work)


def _between(value: float, held: Interval) -> Estimate:
    if not math.isfinite(value):
        return Estimate(value, held.low, held.high) if held.low == held.high else Estimate.unknown(value)
    rounding = 1e-9 * value
    low, high = held.low - rounding, held.high + rounding
    spread = max(high - value, value - low) if held.bounded else math.inf
    return Estimate(min(max(value, low), high), low, high, rounding, spread)


def valid(spec: Shaft, scene: RunOut) -> Criterion:
    """Whether the run-out begins in a steady cycle, power goes through the gear from the rotor throughout, and losses
    and brake hold the shaft wherever it stops.

    **Range** any machine.
    **Error** none: a yes or no.
    **Source** sign of the torque through the gear (`laws.shaft.gear_factor`).
    """
    try:
        stop, _ = stop_case(spec, scene)
    except NumericsError:  # the motion itself says so
        return Criterion("g", 1.0, 0.5, _MEANING, "laws.shaft.gear_factor")
    value = (
        0.0
        if run_out_bounds.coasts_forward(stop) and (not is_braked(spec, scene) or run_out_bounds.holds(stop.machine))
        else 1.0
    )
    return Criterion("g", value, 0.5, _MEANING, "laws.shaft.gear_factor")


STOP_FORMULA: Solver[Shaft, RunOut] = Solver(
    name="stop_formula",
    title="stop, closed form for constant inertia",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({RunOut}),
    represents=frozenset(),
    gives=OF_RUN_OUT,
    run=run,
    cost=lambda spec, scene, carried, level: 2e-3,
    source="laws.shaft.braked_stop; bounds derived in ptmcalc.machines.shaft.speed_changes.run_out_bounds",
    valid=valid,
)
