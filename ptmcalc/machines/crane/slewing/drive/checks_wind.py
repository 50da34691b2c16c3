"""Checks of motor and brake against wind and slope."""

import math

from ptmcalc.base.span import KeyPath
from ptmcalc.components.motor_rating import braking_number_at
from ptmcalc.contract.check import Check, LimitState, Sense, at, blames, needs, no_needs, only
from ptmcalc.contract.limits import fixed, key
from ptmcalc.machines.crane.slewing.drive import reserves
from ptmcalc.machines.crane.slewing.machine import model
from ptmcalc.machines.crane.slewing.machine.judging import SLEWING, OneCheck, torque_repair
from ptmcalc.machines.crane.slewing.machine.spec import SlewingCrane, SlewingScene

_HOLDING = key(
    "checks.holding_reserve",
    meaning="Minimum ratio of the torque to that of the maximum in-service wind, 1 by default",
    valid="in-service wind; out of service the crane slews freely or is locked",
    error="none: an engineering rule",
    source="handbooks of lifting machines; FEM 1.001 and EN 13001-2 for the wind itself",
)


def _blown(spec: SlewingCrane, scene: SlewingScene) -> bool:
    return model.driving_wind(spec, scene) > 0


def _wind_key(spec: SlewingCrane) -> KeyPath:
    gusty = spec.wind.gust_torque > 0 and spec.wind.maximum_torque == spec.wind.steady_torque + spec.wind.gust_torque
    keys = ("gust", "gust_pressure") if gusty else ("maximum", "maximum_pressure")
    for name in (*keys, "steady", "steady_pressure"):
        if getattr(spec.wind, name) is not None:
            return ("wind", name)
    return ("slope",)


WIND_MOTOR: OneCheck = only(_blown)(
    Check(
        code="CRN112",
        title="slewing motor reserve against wind",
        question="Can the starting torque turn the crane against the maximum in-service wind?",
        failure="motor reserve against in-service wind is too small",
        limit_state=LimitState("slewing motor cannot turn against the in-service wind", 1),
        scenes=SLEWING,
        loads=("wind_reserve_motor",),
        sense=Sense.AT_LEAST,
        limit=_HOLDING,
        needs=no_needs,
        blame=lambda spec, scene, loads: _wind_key(spec),
        repair=torque_repair,
        what="The starting torque is at least the required multiple of the torque of friction and maximum in-service"
        " wind. It is the minimum torque of the motor curve up to full speed, or the mean starting torque where no"
        " curve is given.",
        why="A crane that the wind turns while its motor is on is out of the operator's control.",
        formula="M_m u eta/(M_fr + M_w,max) >= 1",
        source="balance of torques about the slewing axis",
    )
)


def _driven(spec: SlewingCrane, scene: SlewingScene) -> bool:
    """Whether wind or slope, stronger than the friction, drive motors with a curve."""
    reserve = reserves.braking_reserve(spec, scene)
    return reserve is not None and math.isfinite(reserve)


def _braking_repair(spec: SlewingCrane, scene: SlewingScene) -> KeyPath:
    return braking_number_at(("motor", "curve"), spec.motor.curve, rated=spec.motor.power is not None)


OVERHAULED: OneCheck = only(_driven)(
    Check(
        code="CRN120",
        hazard=True,
        title="motor braking torque reserve",
        question="Does the motor hold the crane at its speed in the maximum in-service wind?",
        failure="wind or slope overcomes the braking torque of the motor",
        scenes=SLEWING,
        loads=("overhauling_reserve",),
        sense=Sense.AT_LEAST,
        limit=fixed(
            1.0,
            meaning="1: the braking torque of the motors is at least the overhauling torque of wind and slope",
            valid="motors with a curve in the file",
            error="none: an equilibrium",
            source="balance of torques about the slewing axis",
        ),
        needs=no_needs,
        blame=blames("motor", "curve"),
        repair=_braking_repair,
        what="The maximum braking torque of the motor curve above its no-load speed is at least the overhauling torque"
        " of maximum in-service wind and slope on the motor shaft. Friction and gear losses reduce the overhauling"
        " torque.",
        why="A crane that exceeds the braking torque of its motor accelerates without limit. The rotor overspeeds, and"
        " the stopping angle grows with the square of the speed.",
        formula="n M_b/((M_w,max - M_fr) eta_r/u) >= 1",
        source="balance of torques about the slewing axis",
    )
)
WIND_BRAKE: OneCheck = only(_blown)(
    Check(
        code="CRN113",
        hazard=True,
        title="slewing brake reserve against wind",
        question="Can the brake hold the crane against the maximum in-service wind?",
        failure="brake reserve against in-service wind is too small",
        limit_state=LimitState("slewing brake cannot hold against the in-service wind", 1),
        scenes=SLEWING,
        loads=("wind_reserve_brake",),
        sense=Sense.AT_LEAST,
        limit=_HOLDING,
        needs=needs(("brake",)),
        blame=blames("brake", "torque"),
        repair=at("brake", "torque"),
        what="The torque of the closed brake and the bearing friction are together at least the required multiple of"
        " the torque of the maximum in-service wind. Gear losses are neglected.",
        why="A jib that the wind turns against the closed brake hits adjacent objects.",
        formula="(M_B u + M_fr)/M_w,max >= 1, losses of the gear left out",
        source="balance of torques about the slewing axis",
    )
)

CHECKS_OF_WIND = (WIND_MOTOR, OVERHAULED, WIND_BRAKE)
