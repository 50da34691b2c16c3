"""The travel drive as numbers: torques of even travel, reserves, heat over the duty."""

import math

from ptmcalc.components.motor_torque import overhauling_reserve
from ptmcalc.laws import duty
from ptmcalc.machines.crane.travelling.machine import model
from ptmcalc.machines.crane.travelling.machine.model import filled
from ptmcalc.machines.crane.travelling.machine.scenes import HoistWhileTravelling, Run, Start, TravelScene
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.statics import resisting

COUNTING = ("S4", "S5")


def even_torque(spec: Travelling, scene: TravelScene, pressure: float | None) -> float:
    """Of all motors in even travel against the wind and up the slope [N*m]."""
    return model.even_motor_torque(spec, resisting.even(spec, scene, pressure))


def starting_reserve(spec: Travelling, scene: TravelScene) -> float:
    """Least starting torque up to full speed over that of even travel against the wind in which it works [1]."""
    asked = even_torque(spec, scene, model.working_pressure(spec))
    return model.least_torque(spec) / asked if asked > 0 else math.inf


def wind_reserve(spec: Travelling, scene: TravelScene) -> float:
    """Force of the motors at the rims over the resistance in the largest wind in service [1]."""
    resistance = resisting.even(spec, scene, model.largest_pressure(spec))
    return model.driving_force(spec, model.least_torque(spec)) / resistance if resistance > 0 else math.inf


def braking_reserve(spec: Travelling, scene: TravelScene) -> float | None:
    """Largest braking torque of the motors over that with which wind and slope drive them in even travel; None where
    the file gives no curve [1].

        reserve = n M_b/((F_w + G sin(alpha) - W) r eta_r/u)

    Even travel takes the largest wind in service from behind and the slope down; a start those of its scene.

    **Range** steady travel; infinite where the wheels resist more than wind and slope push.
    **Error** exact for the curve.
    **Source** balance of forces (`components.motor.overhauling_reserve`).
    """
    motor = spec.drive.motor
    if motor.curve is None:
        return None
    if isinstance(scene, Start | HoistWhileTravelling):
        resistance = resisting.rolling(spec, scene) + model.outside(spec, scene).total
    else:
        resistance = resisting.even(spec, scene, model.largest_pressure(spec), against=False)
    return overhauling_reserve(motor.curve, motor.count, -model.even_motor_torque(spec, resistance))


# -- duty -----------------------------------------------------------------------------------------------------------


def spectrum(spec: Travelling) -> list[tuple[float, float]]:
    """Share of the cycles and load over the rated one; the rated load always, where the file has no spectrum."""
    points = spec.duty.load_spectrum if spec.duty is not None else None
    return [(point.share, point.load) for point in points] if points is not None else [(1.0, 1.0)]


def duty_factor(spec: Travelling) -> float:
    """Share of a cycle in which the motors are on [1]."""
    assert spec.duty is not None
    return 1.0 if spec.duty.type == "S1" else filled(spec.duty.factor)


def rms_torque(spec: Travelling) -> float:
    """Torque that heats the motors as much as travelling against and with the wind, over the time they are on [N*m].

    Where the duty type counts starts, each of them takes the torque and the time of a rigid start.
    """
    assert spec.duty is not None
    counted = spec.duty.type in COUNTING
    on = 3600 * duty_factor(spec) / filled(spec.duty.starts_per_hour) if counted else 1.0
    torques: list[float] = []
    times: list[float] = []
    for share, load in spectrum(spec):
        part = spec.model_copy(update={"load": max(load, 1e-12) * spec.load})
        for against in (True, False):
            resistance = resisting.even(part, Run(), model.working_pressure(part), against=against)
            even = model.even_motor_torque(part, resistance)
            begin, torque = _rigid_start(part, resistance) if counted else (0.0, 0.0)
            begin = min(begin, on)
            torques += [torque, even]
            times += [share * begin, share * (on - begin)]
    return duty.rms_torque(torques, times)


def _rigid_start(spec: Travelling, resistance: float) -> tuple[float, float]:
    """Time and torque of a start whose load does not swing; a start that stalls takes all the time [s, N*m]."""
    mass = model.travelling_mass(spec) + model.hanging(spec, Run())
    ramp = model.commanded(spec, Start())
    if ramp is not None:
        return spec.speed / ramp, float(model.motor_torque(spec, mass * ramp + resistance, ramp))
    net = model.driving_force(spec, spec.drive.torque) - resistance
    whole = mass + model.rotor_mass(spec, braking=False)
    return (spec.speed * whole / net if net > 0 else math.inf), spec.drive.torque


def permissible_torque(spec: Travelling) -> float | None:
    """Torque all motors bear at the duty factor of the file; None where their rating is not known [N*m]."""
    motor = spec.drive.motor
    if motor.rated is None:
        return None
    cooling = duty.REST_COOLING[motor.cooling]
    borne = duty.permissible_torque(motor.rated, motor.rated_duty, duty_factor(spec), rest_cooling=cooling)
    return motor.count * borne
