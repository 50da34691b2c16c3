"""The effects a main shaft may call for."""

from collections.abc import Mapping

from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.contract.effect import Criterion, Effect
from ptmcalc.laws import shaft as law
from ptmcalc.machines.shaft import bounds
from ptmcalc.machines.shaft.cases import machine_in, mean_torque, stop_case, target_speed
from ptmcalc.machines.shaft.loads import OF_CYCLE, OF_RUN_OUT, OF_RUN_UP
from ptmcalc.machines.shaft.spec import RunOut, RunUp, Shaft, ShaftScene, Steady

Loads = Mapping[str, Estimate]
Offsets = Mapping[str, Interval]

INERTIA_THRESHOLD = 0.05
"""Torque by the varying inertia relative to the mean torque [1]. An engineering choice: below 5 % it changes the torque
balance by less than 5 %. `inertia_bound` adds the resulting error to the bar below the threshold; from the threshold on
the error is unbounded and a run must simulate the effect. A larger value widens the range of the bound."""
SLOPE_THRESHOLD = 1.0
"""Period of the load relative to the time constant of motor and shaft [1]; lecture notes Kramatorsk, section on the
flywheel. Well below 1 the motor torque stays near its mean; `slope_bound` adds the error of a constant torque to the
bar. From 1 on the error is unbounded and a run must simulate the slope. A larger value widens the range of the
bound."""

_CLOSED = frozenset({"kinetic_energy", "speed_run_out", "torque_starting", "acceleration_starting"})
"""Loads that no effect changes: they are of the moment at which the motion begins."""


def _anything(names: frozenset[str], loads: Loads) -> Offsets:
    return {name: ANYTHING for name in names - _CLOSED if name in loads}


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
    **Source** derived in `machines.shaft.bounds`: comparison of first-order differential equations.
    """
    if inertia_criterion(spec, scene).exceeded:
        return _anything(OF_CYCLE if isinstance(scene, Steady) else OF_RUN_UP | OF_RUN_OUT, loads)
    machine = machine_in(spec, scene)
    if not machine.changing:
        return {}
    if isinstance(scene, RunUp):
        target = target_speed(spec, scene)
        if not bounds.drives_all_the_way(machine, target, machine.survey.slope_low):
            return _anything(OF_RUN_UP, loads)
        return bounds.offsets(bounds.run_up_ranges(machine, target, changing=True), loads)
    if isinstance(scene, RunOut):
        stop, wanted = stop_case(spec, scene)
        if not bounds.coasts_forward(stop):
            return _anything(OF_RUN_OUT, loads)
        ranges = bounds.run_out_ranges(stop, changing=True, wanted=wanted)
        ranges["energy_recoverable"] = bounds.recoverable(stop, ranges, changing=True)
        return bounds.offsets(ranges, loads)
    return _steady_inertia(spec, loads, machine_in(spec, scene))


def _steady_inertia(spec: Shaft, loads: Loads, machine) -> Offsets:  # type: ignore[no-untyped-def]
    cycle = bounds.held(machine)
    if cycle is None:
        return _anything(OF_CYCLE, loads)
    irregularity = bounds.with_changing_inertia(cycle)
    if not irregularity.bounded:
        return _anything(OF_CYCLE, loads)
    w = cycle.speed
    ranges = {
        "irregularity": irregularity,
        "speed_max": Interval(w * (1 + irregularity.low / 2), w * (1 + irregularity.high / 2)),
        "speed_min": Interval(w * (1 - irregularity.high / 2), w * (1 - irregularity.low / 2)),
    }
    wanted = spec.checks.irregularity
    if wanted is not None:
        ranges["flywheel_inertia"] = bounds.flywheel(cycle, wanted, bounds.with_changing_inertia)
    return bounds.offsets(ranges, loads)


def slope_criterion(spec: Shaft, scene: Steady) -> Criterion:
    """Ratio of the load period to the time constant of the motor for a speed change.

        h = t k/J

    t is the cycle time, k the decrease of the drive torque per speed at the mean load, J the mean inertia, all at the
    main shaft.

    **Range** any machine that its motor can drive; otherwise infinite.
    **Error** exact.
    **Source** `laws.shaft.slope_criterion`; the threshold of 1 from the lecture notes Kramatorsk, section on the
    flywheel.
    """
    machine = machine_in(spec, scene)
    cycle = bounds.held(machine)
    if cycle is None:
        value = float("inf")
    else:
        period = machine.period / cycle.speed
        value = float(law.slope_criterion(period, bounds.slope_at_balance(cycle), cycle.inertia))
    return Criterion(
        "h", value, SLOPE_THRESHOLD, "period of the load over the time constant of motor and shaft", "laws.shaft"
    )


def slope_bound(spec: Shaft, scene: Steady, loads: Loads) -> Offsets:
    """Interval of every load of a cycle with constant motor torque that covers a motor with torque-speed slope.

        |A - A_held| <= k dw Theta/4 except for a constant,  w = w_0 somewhere
        M_rms^2 <= M_0^2 + R^2/4 + M_high R dw/(2 w_low),  R = k_m dw,  M_rms >= M_0

    **Range** h below 1, a torque that decreases with the speed over the whole range, power flow from the motor
    throughout; otherwise unbounded.
    **Error** a bound.
    **Source** derived in `machines.shaft.bounds`: a function without a mean and with a range L has an integral with a
    range of at most L Theta/4; the mean torque over the angle is that of the load.
    """
    machine = machine_in(spec, scene)
    cycle = bounds.held(machine)
    if slope_criterion(spec, scene).exceeded or cycle is None or "irregularity" not in loads:
        return _anything(OF_CYCLE, loads)
    if not machine.changing or spec.effects.get("varying_inertia") == "off":
        cycle = cycle.with_mean_inertia()
    known = loads["irregularity"]
    found = bounds.with_working_motor(cycle, Interval(max(known.low, 0.0), known.high))
    if found is None:
        return _anything(OF_CYCLE, loads)
    ranges = {
        "irregularity": found.irregularity,
        "speed_mean": found.mean,
        "speed_max": found.highest,
        "speed_min": found.lowest,
        "torque_motor_rms": found.torque_rms,
        "torque_motor_max": Interval(loads["torque_motor_max"].low, found.torque.high),
    }
    if machine.viscous > 0:
        ranges |= bounds.works(machine, found.lowest.low, found.highest.high)
    wanted = spec.checks.irregularity
    if wanted is not None and "flywheel_inertia" in loads:

        def irregularity(of: bounds.Held) -> Interval:
            changed = of if of.inertia_low == of.inertia_high else None
            start = Interval(of.irregularity, of.irregularity) if changed else bounds.with_changing_inertia(of)
            working = bounds.with_working_motor(of, start)
            return working.irregularity if working else ANYTHING

        ranges["flywheel_inertia"] = bounds.flywheel(cycle, wanted, irregularity)
    return bounds.offsets(ranges, loads)


EFFECTS = (
    Effect(
        "varying_inertia",
        "angle-dependent inertia",
        frozenset({RunUp, Steady, RunOut}),
        inertia_criterion,
        inertia_bound,
    ),
    Effect(
        "motor_slope",
        "motor torque-speed slope within the cycle",
        frozenset({Steady}),
        slope_criterion,
        slope_bound,
    ),
)
