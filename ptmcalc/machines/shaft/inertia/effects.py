"""The change of the inertia with the angle as an effect: criterion and bound."""

from ptmcalc.base.estimate import Interval
from ptmcalc.contract.effect import Criterion, Effect
from ptmcalc.laws import shaft as law
from ptmcalc.machines.shaft.cycle import bounds
from ptmcalc.machines.shaft.cycle.loads import OF_CYCLE
from ptmcalc.machines.shaft.machine.cases import machine_in
from ptmcalc.machines.shaft.machine.model import Machine
from ptmcalc.machines.shaft.machine.offsets import Loads, Offsets, offsets, unknown
from ptmcalc.machines.shaft.machine.spec import RunOut, RunUp, Shaft, ShaftScene, Steady
from ptmcalc.machines.shaft.speed_changes import run_out_bounds, run_up_bounds
from ptmcalc.machines.shaft.speed_changes.cases import mean_torque, stop_case, target_speed
from ptmcalc.machines.shaft.speed_changes.loads import OF_RUN_OUT, OF_RUN_UP

INERTIA_THRESHOLD = 0.05
"""Torque by the varying inertia relative to the mean torque [1]. An engineering choice: below 5 % it changes the torque
balance by less than 5 %. `inertia_bound` adds the resulting error to the bar below the threshold; from the threshold on
the error is unbounded and a run must simulate the effect. A larger value widens the range of the bound."""


def inertia_criterion(spec: Shaft, scene: ShaftScene) -> Criterion:
    """Ratio of the torque due to the change of inertia to the torque on the main shaft.

        q = max |J'| w^2/(2 |M|)

    w is the speed at which the motor drives the mean load (steady cycle), the target speed (run-up) or the initial
    speed (stop); M is the mean drive torque, in a stop the torque of losses and brake.

    **Range** any shaft; infinite if the motor cannot drive the mean load, or nothing stops the shaft.
    **Error** exact for the stated torques.
    **Source** `laws.shaft.inertia_criterion`; the threshold of 5 % is an engineering choice.
    """
    machine = machine_in(spec, scene)
    survey = machine.survey
    steepest = max(abs(survey.slope_low), abs(survey.slope_high)) if machine.changing else 0.0
    speed, torque = mean_torque(spec, scene)
    value = float(law.inertia_criterion(steepest, speed, torque))
    return Criterion("q", value, INERTIA_THRESHOLD, "torque of the varying inertia / torque on the shaft", "laws.shaft")


def inertia_bound(spec: Shaft, scene: ShaftScene, loads: Loads) -> Offsets:
    """Interval of every load of the shaft with mean inertia that covers any variation between the extremes of J.

        steady:   delta from x = 2 T/J with T and J anywhere in their ranges, (w_max + w_min)/2 = w_0
        run-up:   J_low/(D - R_low - J'_low w^2/2) <= dt/dw <= J_high/(D - R_high - J'_high w^2/2)
        stop:     delay, rise and viscous torque at both ends of the rate of the reduced time

    **Range** q below 0.05; unbounded above, and if the power flow through the gear may reverse.
    **Error** a bound.
    **Source** derived in the bounds of cycle, run-up and run-out: comparison of first-order differential equations.
    """
    if inertia_criterion(spec, scene).exceeded:
        return unknown(OF_CYCLE if isinstance(scene, Steady) else OF_RUN_UP | OF_RUN_OUT, loads)
    machine = machine_in(spec, scene)
    if not machine.changing:
        return {}
    if isinstance(scene, RunUp):
        target = target_speed(spec, scene)
        if not run_up_bounds.drives_all_the_way(machine, target, machine.survey.slope_low):
            return unknown(OF_RUN_UP, loads)
        return offsets(run_up_bounds.run_up_ranges(machine, target, changing=True), loads)
    if isinstance(scene, RunOut):
        stop, wanted = stop_case(spec, scene)
        if not run_out_bounds.coasts_forward(stop):
            return unknown(OF_RUN_OUT, loads)
        ranges = run_out_bounds.run_out_ranges(stop, changing=True, wanted=wanted)
        ranges["energy_recoverable"] = run_out_bounds.recoverable(stop, ranges, changing=True)
        return offsets(ranges, loads)
    return _steady_inertia(spec, loads, machine_in(spec, scene))


def _steady_inertia(spec: Shaft, loads: Loads, machine: Machine) -> Offsets:
    cycle = bounds.held(machine)
    if cycle is None:
        return unknown(OF_CYCLE, loads)
    irregularity = bounds.with_changing_inertia(cycle)
    if not irregularity.bounded:
        return unknown(OF_CYCLE, loads)
    w = cycle.speed
    ranges = {
        "irregularity": irregularity,
        "speed_max": Interval(w * (1 + irregularity.low / 2), w * (1 + irregularity.high / 2)),
        "speed_min": Interval(w * (1 - irregularity.high / 2), w * (1 - irregularity.low / 2)),
    }
    wanted = spec.checks.irregularity
    if wanted is not None:
        ranges["flywheel_inertia"] = bounds.flywheel(cycle, wanted, bounds.with_changing_inertia)
    return offsets(ranges, loads)


VARYING_INERTIA = Effect(
    "varying_inertia",
    "angle-dependent inertia",
    frozenset({RunUp, Steady, RunOut}),
    inertia_criterion,
    inertia_bound,
)
