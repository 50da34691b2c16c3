"""The slope of the motor's curve as an effect of the steady cycle: criterion and bound."""

from ptmcalc.base.estimate import ANYTHING, Interval
from ptmcalc.contract.effect import Criterion, Effect
from ptmcalc.laws import shaft as law
from ptmcalc.machines.shaft.cycle import bounds
from ptmcalc.machines.shaft.cycle.loads import OF_CYCLE
from ptmcalc.machines.shaft.machine.cases import machine_in
from ptmcalc.machines.shaft.machine.offsets import Loads, Offsets, offsets, unknown
from ptmcalc.machines.shaft.machine.spec import Shaft, Steady

SLOPE_THRESHOLD = 1.0
"""Period of the load relative to the time constant of motor and shaft [1]; lecture notes Kramatorsk, section on the
flywheel. Well below 1 the motor torque stays near its mean; `slope_bound` adds the error of a constant torque to the
bar. From 1 on the error is unbounded and a run must simulate the slope. A larger value widens the range of the
bound."""


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
    **Source** derived in `machines.shaft.cycle.bounds`: a function without a mean and with a range L has an integral
    that swings by no more than L Theta/4; the torque's mean over the angle is that of the load.
    """
    machine = machine_in(spec, scene)
    cycle = bounds.held(machine)
    if slope_criterion(spec, scene).exceeded or cycle is None or "irregularity" not in loads:
        return unknown(OF_CYCLE, loads)
    if not machine.changing or spec.effects.get("varying_inertia") == "off":
        cycle = cycle.with_mean_inertia()
    known = loads["irregularity"]
    found = bounds.with_working_motor(cycle, Interval(max(known.low, 0.0), known.high))
    if found is None:
        return unknown(OF_CYCLE, loads)
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
    return offsets(ranges, loads)


MOTOR_SLOPE = Effect(
    "motor_slope",
    "motor torque-speed slope within the cycle",
    frozenset({Steady}),
    slope_criterion,
    slope_bound,
)
