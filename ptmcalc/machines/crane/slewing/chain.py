"""The chain of a rotation: times, shares, torques of its phases, and what they are worth."""

from collections.abc import Mapping

from ptmcalc.laws import brake, slewing
from ptmcalc.machines.crane.slewing import model
from ptmcalc.machines.crane.slewing.spec import SlewingCrane, SlewingScene

GIVEN = frozenset(
    {
        "slew_inertia",
        "start_time",
        "start_angle",
        "steady_time",
        "steady_angle",
        "brake_time",
        "brake_angle",
        "cycle_time",
        "share_start",
        "share_steady",
        "share_brake",
        "torque_start",
        "torque_steady",
        "torque_inertia_brake",
        "torque_brake",
        "torque_equivalent",
        "torque_pinion",
        "torque_worm",
        "power_gearbox",
    }
)
"""Loads of the chain."""


def start_time(spec: SlewingCrane, scene: SlewingScene, rule: str = "eta") -> float:
    """Time of a start with the motor's mean torque; infinite where it stalls [s]."""
    torque = model.motor_torque(spec)
    assert torque is not None
    total = model.slew_inertia(spec, scene) + model.rotor_at_column(spec, rule)
    at_column, resistance = model.at_column(spec, torque), model.steady_torque(spec, scene)
    return float(slewing.uniform_start_time(total, spec.speed, at_column, resistance))


def start_torque(spec: SlewingCrane, scene: SlewingScene, time: float, rule: str = "eta") -> float:
    """Torque at the column that a start of a given time takes [N*m]."""
    total = model.slew_inertia(spec, scene) + model.rotor_at_column(spec, rule)
    return float(slewing.torque_for_start(total, spec.speed, time, model.steady_torque(spec, scene)))


def of_rotation(
    spec: SlewingCrane,
    scene: SlewingScene,
    *,
    start_time: float,
    torque_start: float,
    rule: str = "eta",
    rounded: bool = False,
) -> Mapping[str, float]:
    """Times, shares and torques of a rotation whose start takes so long with such a torque at the column."""
    speed, cycle = spec.speed, spec.cycle
    brake_time = brake.uniform_stop_time(cycle.brake_angle, speed)
    start_angle = speed * start_time / 2
    steady_angle = max(cycle.rotation - start_angle - cycle.brake_angle, 0.0)
    steady_time = steady_angle / speed
    whole = start_time + steady_time + brake_time
    shares = [time / whole for time in (start_time, steady_time, brake_time)]
    if rounded:
        shares = [round(share, 3) for share in shares]
    total = model.slew_inertia(spec, scene) + model.rotor_at_column(spec, rule)
    inertia_torque = float(slewing.torque_for_start(total, speed, brake_time, 0.0))
    torque_brake = inertia_torque + model.driving_wind(spec, scene) - spec.friction
    torques = [torque_start, model.steady_torque(spec, scene), torque_brake]
    equivalent = slewing.fatigue_torque(shares, torques, cycle.exponent)
    worm = equivalent / (spec.gear.ratio * spec.gear.efficiency)
    loads = {
        "slew_inertia": model.slew_inertia(spec, scene),
        "start_time": start_time,
        "start_angle": start_angle,
        "steady_time": steady_time,
        "steady_angle": steady_angle,
        "brake_time": brake_time,
        "brake_angle": cycle.brake_angle,
        "cycle_time": whole,
        "share_start": shares[0],
        "share_steady": shares[1],
        "share_brake": shares[2],
        "torque_start": torque_start,
        "torque_steady": torques[1],
        "torque_inertia_brake": inertia_torque,
        "torque_brake": torque_brake,
        "torque_equivalent": equivalent,
        "torque_worm": worm,
        "power_gearbox": worm * spec.gear.ratio * speed,
    }
    if spec.gear.open is not None:
        loads["torque_pinion"] = equivalent / (spec.gear.open.ratio * spec.gear.open.efficiency)
    return loads
