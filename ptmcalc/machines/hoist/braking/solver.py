"""Emergency stop of the rigid drive: the worst height of the hook, where the scene gives none."""

import math
from typing import TYPE_CHECKING

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.hoist.braking.loads import (
    DESCENT,
    HEAT,
    LOADS,
    ONE_STOP,
    REPEATED,
    RISE,
    SPEED,
    SPEED_RATIO,
    STOPS,
    TIME,
    TRAVEL,
)
from ptmcalc.machines.hoist.drive import torques
from ptmcalc.machines.hoist.drive.solver import overspeed_note
from ptmcalc.machines.hoist.machine import model
from ptmcalc.machines.hoist.machine.model import filled
from ptmcalc.machines.hoist.machine.spec import EmergencyStop, Hoist

if TYPE_CHECKING:
    from ptmcalc.machines.hoist.braking.motion import Train

_HEIGHTS = 12
"""Heights of the hook at which a stop is evaluated where the scene gives none: the lowest, and one above the begin of
each layer, of more layers as many in even steps with the last. A numerical choice; more heights take longer."""
_ONTO = 1 + 1e-9
"""Height relative to that at which a layer begins [1], as in `drive.solver`: at 1 the layer below is evaluated."""


def train_at(spec: Hoist, mass: float, height: float) -> "tuple[Train, float]":
    """The drive with a mass on the hook at a height, and the travel of the hook per motor angle [m/rad]."""
    gear = torques.gearbox_of(spec)
    arm = model.wound(spec, height).radius / model.falls_of_a_rope(spec)
    from ptmcalc.machines.hoist.braking.motion import Train  # for the scenes that call for one

    up, down = (model.drum_torque(spec, mass, height, hauling=way) for way in (True, False))
    train = Train(
        model.motor_side_inertia(spec),
        spec.drum.inertia or 0.0,
        up * arm / spec.gravity,
        down * arm / spec.gravity,
        up,
        down,
        gear.ratio,
        model.efficiency(spec),
        model.reverse_efficiency(spec),
    )
    return train, arm / gear.ratio


def heights(spec: Hoist, scene: EmergencyStop) -> list[float]:
    """Heights of the hook at which the stop is evaluated [m]."""
    if scene.hook_height is not None:
        return [scene.hook_height]
    begins = [min(height * _ONTO, spec.height) for height in model.layer_heights(spec)]
    if len(begins) > _HEIGHTS:
        begins = [begins[round(place)] for place in np.linspace(0, len(begins) - 1, _HEIGHTS)]
    return sorted({0.0, *begins})


def initial_speed(spec: Hoist, scene: EmergencyStop) -> float:
    """Of the motor shaft when the power is lost [rad/s]."""
    if scene.motor_speed is not None:
        return scene.motor_speed
    if scene.speed == "main":
        mass, lifts = model.hook_mass(spec, scene), scene.direction == "up"
        speed = torques.curve_speed(spec, mass, scene.hook_height, lifts)
        if speed and math.isfinite(speed):
            return speed
    return model.drum_speed(spec, scene.speed) * torques.gearbox_of(spec).ratio


def motions(spec: Hoist, scene: EmergencyStop) -> list[dict[str, Estimate]]:
    """Loads of the stop at each height."""
    from ptmcalc.machines.hoist.braking.bars import with_bars  # for the scenes that call for one
    from ptmcalc.machines.hoist.braking.motion import Brake

    given = spec.brake
    assert given is not None, "a scene that brakes has a brake"
    on_drum = given.shaft != torques.MOTOR_SHAFT
    brake = Brake(given.torque, given.delay, given.rise_time, given.rise, on_drum)
    mass, speed, lifts = model.hook_mass(spec, scene), initial_speed(spec, scene), scene.direction == "up"
    found = []
    for height in heights(spec, scene):
        train, arm = train_at(spec, mass, height)
        stop = with_bars(train, brake, speed, lifts, model.load_frequency(spec, mass, height))
        loads = {SPEED: stop.speed_max, TIME: stop.time, TRAVEL: stop.travel, HEAT: stop.heat}
        loads |= {DESCENT: _scaled(stop.down, arm)} | ({RISE: _scaled(stop.up, arm)} if lifts else {})
        found.append(loads)
    return found


def run(spec: Hoist, scene: EmergencyStop, carried: frozenset[str], level: int) -> Result:
    """Loads of a stop by the brake from the loss of power, at the worst height of the hook if the scene gives none.

        J w' = M_L - M_B(t),   J = J_1 + J_2 eta_r/u^2,   M_L = M_d eta_r/u      while a load is lowered
        w_max = w_0 + (M_L/J) (t_d + t_r M_L/(2 M_B)),   Q = integral of M_B w dt = J w_0^2/2 + M_L phi
        dT = Q/(m c),   dT_max = dT/(1 - exp(-t_c/tau)),   t_c = 3600/z

    A load that is hoisted slows the drive down. It sinks before the brake closes if t_d > w_0 J/M_L.

    **Range** the motor has no torque from the begin. Discs of one temperature, cooling in proportion to it; stops at
    equal intervals.
    **Error** the values are those of a rigid train. The error bar covers the oscillation of the load (`braking.bars`);
    it is unbounded where the rope may go slack.
    **Source** Newton's law, piece by piece; energy balance of the stop; a geometric series of equal stops. The cooling
    is an engineering value, to be compared with the data sheet.
    """
    stops = motions(spec, scene)
    shaft = {name: _largest([one[name] for one in stops]) for name in stops[0]}
    found = {name: Found(one) for name, one in shaft.items()}
    found[SPEED] = Found(shaft[SPEED], note=overspeed_note(spec))
    field = torques.field_speed(spec.motor) if spec.motor is not None else None
    if field is not None:
        found[SPEED_RATIO] = Found(_scaled(shaft[SPEED], 1 / field))
    return Result(found | _of_the_disc(spec, shaft[HEAT]), work=1)


def _largest(of: list[Estimate]) -> Estimate:
    """The largest of several values."""
    return Estimate(
        max(one.value for one in of),
        max(one.low for one in of),
        max(one.high for one in of),
        max(one.numerical for one in of),
        max(one.model for one in of),
    )


def _of_the_disc(spec: Hoist, heat: Estimate) -> dict[str, Found]:
    """Temperatures and wear, as far as the file gives the data."""
    brake = spec.brake
    assert brake is not None
    found: dict[str, Found] = {}
    if brake.disc_mass is not None:
        one = 1 / (brake.disc_mass * filled(brake.specific_heat))
        found[ONE_STOP] = Found(_scaled(heat, one))
        if brake.stops_per_hour is not None:
            kept = -math.expm1(-3600 / brake.stops_per_hour / filled(brake.cooling_time))
            found[REPEATED] = Found(_scaled(heat, one / kept))
    if brake.friction_work is not None:
        low, value, high = (
            brake.friction_work / one if one > 0 else math.inf for one in (heat.high, heat.value, heat.low)
        )
        found[STOPS] = Found(Estimate(value, low, high, model=max(high - value, value - low) if value < high else 0.0))
    return found


def _scaled(one: Estimate, by: float) -> Estimate:
    """A value times a positive number."""
    return Estimate(one.value * by, one.low * by, one.high * by, one.numerical * by, one.model * by)


EMERGENCY: Solver[Hoist, EmergencyStop] = Solver(
    name="emergency_stop",
    title="emergency stop of the rigid drive, heat of the brake",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({EmergencyStop}),
    represents=frozenset(),
    gives=frozenset(info.name for info in LOADS),
    run=run,
    cost=lambda spec, scene, carried, level: 5e-3,
    source="Newton's law, piece by piece; energy balance of the stop",
)
