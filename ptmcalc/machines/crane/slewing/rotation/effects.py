"""Effects of the rigid crane on its rotation: losses by the direction of the power, motor curve, gust."""

import math

from ptmcalc.base.estimate import Interval
from ptmcalc.contract.effect import AnyEffect, Criterion, Effect
from ptmcalc.machines.crane.slewing.machine import model
from ptmcalc.machines.crane.slewing.machine.spec import Slew, SlewingCrane, SlewingScene
from ptmcalc.machines.crane.slewing.rotation import bounds
from ptmcalc.machines.crane.slewing.rotation.bounds import Loads, Offsets
from ptmcalc.machines.crane.slewing.rotation.consistent import found_of
from ptmcalc.spec.scene import Scene

_SCENES: frozenset[type[Scene]] = frozenset({Slew})
DIRECTION_THRESHOLD = 0.01
"""Losses of the inertia torque in the gear, relative to the steady torque [1]. An engineering choice: below 1 % the
neglected losses stay below 1 % of the steady torque. `direction_bound` adds the exact difference to the error bar at
any value. A smaller value requests the effect in more scenes."""
CURVE_THRESHOLD = 0.05
"""Spread of the starting torque relative to its mean [1]. An engineering choice: below 5 % the torque differs from its
mean by less than 5 %. `curve_bound` adds the range of start times to the error bar and is unbounded with load sway. A
smaller value requests the motor curve in more scenes."""
GUST_THRESHOLD = 0.02
"""Gust torque relative to the accelerating torque [1]. An engineering choice: below 2 % the gust extends the start by
at most 2.1 %, 1/(1 - 0.02). `gust_bound` adds the extension to the error bar and is unbounded with load sway. A smaller
value requests the gust in more scenes."""
_BY_DIRECTION = (
    "torque_inertia_brake",
    "torque_brake",
    "torque_equivalent",
    "torque_pinion",
    "torque_worm",
    "power_gearbox",
)


def direction_criterion(spec: SlewingCrane, scene: SlewingScene) -> Criterion:
    """Influence of the direction of power on the gear torques in the stop.

        (1 - eta) M_in/M_steady

    **Range** every rotation.
    **Error** an engineering measure.
    **Source** theory of reduction: the efficiency depends on the direction of the power flow through the gear.
    """
    inertia = model.slew_inertia(spec, scene) * spec.speed / model.allowed_stop(spec)[0]
    steady = model.steady_torque(spec, scene)
    value = (1 - spec.gear.efficiency) * (inertia / steady if steady > 0 else math.inf)
    return Criterion(
        "(1-η) M_in/M_st", min(value, 1e9), DIRECTION_THRESHOLD, "gear loss times inertia torque / resistance torque",
        "power balance of the mesh",
    )  # fmt: skip


def direction_bound(spec: SlewingCrane, scene: SlewingScene, loads: Loads) -> Offsets:
    """Change of the torques of the stop if the brake acts on the rotor and the losses help: the exact difference.

        M_brake: less gamma J_1 u^2 eta w/t_b;   M_worm of the stop: M eta_r/u instead of M/(u eta)

    **Range** torques of a uniform stop over the permissible angle.
    **Error** exact: both cases are computed.
    **Source** power balance of the mesh; `laws.gearing`.
    """
    start, at_column, _ = model.start_of(spec, scene)
    stop = model.stop(spec, scene) or model.allowed_stop(spec)
    times = model.phases(spec, (start, spec.speed * start / 2), stop)
    one, other = (
        found_of(spec, scene, times, model.phase_torques(spec, scene, at_column, by_direction=by))
        for by in (False, True)
    )
    return {
        name: Interval(min(other[name] - one[name], 0.0), max(other[name] - one[name], 0.0))
        for name in _BY_DIRECTION
        if name in loads and name in one
    }


def curve_criterion(spec: SlewingCrane, scene: SlewingScene) -> Criterion:
    """Relative range of the motor torque up to full speed.

        (M_max - M_min)/M_mean

    **Range** motors with a `curve`; 0 for a given mean torque.
    **Error** an engineering measure.
    **Source** the threshold of 5 % is an engineering choice.
    """
    spread = model.torque_range(spec, scene)
    value = (spread[1] - spread[0]) / spread[2] if spread is not None else 0.0
    return Criterion(
        "ΔM/M", value, CURVE_THRESHOLD, "range of the starting torque / mean starting torque", "the motor's curve"
    )


def curve_bound(spec: SlewingCrane, scene: SlewingScene, loads: Loads) -> Offsets:
    """The starting time is between those with the minimum and with the maximum torque of the curve.

        J w/(M_max - M_r) <= t_s <= J w/(M_min - M_r)

    **Range** the starting time of the rigid crane; unbounded if the minimum torque does not turn the crane, and for a
    run with load sway: a different start leaves a different sway for the stop.
    **Error** a bound: the angular momentum increases faster than with M_min and more slowly than with M_max.
    **Source** change of angular momentum.
    """
    spread = model.torque_range(spec, scene)
    if spread is None:
        return {}
    steady = model.steady_torque(spec, scene)
    least, most = (model.at_column(spec, torque) - steady for torque in spread[:2])
    momentum = (model.slew_inertia(spec, scene) + model.rotor_at_column(spec)) * spec.speed
    wide = Interval(momentum / most if most > 0 else math.inf, momentum / least if least > 0 else math.inf)
    if not bounds.OF_SWAY.isdisjoint(loads):
        return bounds.unknown(loads, bounds.OF_SWAY)
    return bounds.of_times(spec, scene, loads, wide, None)


def gust_criterion(spec: SlewingCrane, scene: SlewingScene) -> Criterion:
    """Share of the accelerating torque that a gust consumes.

        M_gust/(M_start - M_steady)

    **Range** every rotation; 0 without a gust.
    **Error** an engineering measure.
    **Source** the threshold of 2 % is an engineering choice.
    """
    free = model.start_of(spec, scene)[1] - model.steady_torque(spec, scene)
    gust = spec.wind.gust_torque
    value = 0.0 if gust == 0 else gust / free if free > 0 else 1e9
    return Criterion("M_g/M_a", value, GUST_THRESHOLD, "gust torque / accelerating torque", "balance of torques")


def gust_bound(spec: SlewingCrane, scene: SlewingScene, loads: Loads) -> Offsets:
    """A gust delays the start at most as much as a steady wind of its strength.

        t_s <= J w/(M_start - M_steady - M_gust)

    **Range** the starting time of the rigid crane; unbounded if the gust stops the crane, and for a run with load sway:
    a different start leaves a different sway for the stop.
    **Error** a bound: the gust is never stronger and never helps.
    **Source** change of angular momentum.
    """
    gust = spec.wind.gust_torque
    if gust == 0 or "start_time" not in loads:
        return {}
    momentum = (model.slew_inertia(spec, scene) + model.rotor_at_column(spec)) * spec.speed
    known = loads["start_time"]
    left = momentum / known.high - gust if known.high > 0 else -1.0
    spread = model.torque_range(spec, scene)
    if spread is not None:  # what is left where the motor is weakest
        left = min(left, model.at_column(spec, spread[0]) - model.steady_torque(spec, scene) - gust)
    wide = Interval(known.low, momentum / left if left > 0 else math.inf)
    if not bounds.OF_SWAY.isdisjoint(loads):
        return bounds.unknown(loads, bounds.OF_SWAY)
    return bounds.of_times(spec, scene, loads, wide, None)


EFFECTS_OF_ROTATION: tuple[AnyEffect, ...] = (
    Effect(
        "efficiency_direction",
        "gear losses by direction of power flow",
        _SCENES,
        direction_criterion,
        direction_bound,
    ),
    Effect("slewing_motor_curve", "motor torque-speed curve", _SCENES, curve_criterion, curve_bound),
    Effect("wind_gust", "wind gust during the start", _SCENES, gust_criterion, gust_bound),
)
