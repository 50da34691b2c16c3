"""The loads that a start or a stop comes to."""

import math
from collections.abc import Mapping
from functools import partial

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Failure, Finding, Found, of
from ptmcalc.laws import pendulum
from ptmcalc.machines.crane.travelling.machine import model, stability
from ptmcalc.machines.crane.travelling.machine.judging import rate_key
from ptmcalc.machines.crane.travelling.machine.model import FloatArray, State
from ptmcalc.machines.crane.travelling.machine.scenes import Moving
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.machine.wheels import Wheels, driven_corners
from ptmcalc.machines.crane.travelling.sway.course import Course, extreme
from ptmcalc.machines.crane.travelling.sway.moving import motion_of

STALL = "stall: the motors do not bring the crane to full speed against friction, wind and slope"
RUNAWAY = "the brakes do not stop the crane against wind and slope"
GRIP = "reduce acceleration and deceleration, drive more wheels, or correct `rail.adhesion`"
SLIDES = "driven wheels slip: times, sway and wheel loads are those without slip and decide no verdict"


def findings_of(spec: Travelling, scene: Moving, loads: Mapping[str, Found]) -> tuple[Finding, ...]:
    """What a start or stop says of itself: that it does not come about, or leaves what is reckoned with."""
    if math.isinf(loads["start_time" if model.starts(scene) else "brake_time"].estimate.value):
        why, hint = (
            (STALL, "increase the motor torque") if model.starts(scene) else (RUNAWAY, "increase the brake torque")
        )
        return (Finding("NUM110", why, rate_key(spec, scene), hint),)
    if loads["skid_reserve_min"].estimate.low < 1:
        return (Finding("NUM102", SLIDES, rate_key(spec, scene), GRIP),)
    return ()


def failures_of(spec: Travelling, scene: Moving, loads: Mapping[str, Found]) -> tuple[Failure, ...]:
    """What a start or a stop fails by, whatever limit the file sets: driven or braked wheels that slide.

    It is asked of starts and stops that come about: what stalls is told by its endless time.
    """
    time = loads["start_time" if model.starts(scene) else "brake_time"].estimate.value
    grip = loads["skid_reserve_min"].estimate
    if math.isinf(time) or not grip.high < 1:
        return ()
    what = "start" if model.starts(scene) else "stop"
    message = f"driven wheels slip in the {what}: their adhesion is {grip.high:.3g} times the required one"
    return (Failure("CRN155", message, rate_key(spec, scene), GRIP),)


def loads_of(spec: Travelling, scene: Moving, course: Course) -> dict[str, Found]:
    """All loads of a start or a stop."""
    starts, wheels = model.starts(scene), Wheels.of(spec, scene)
    found = {
        "start_time" if starts else "brake_time": course.time,
        "start_distance" if starts else "brake_distance": course.distance,
        "acceleration_max": course.extreme(lambda state: np.abs(state.acceleration), largest=True).estimate,
        "sway_angle_max": course.sway,
        "sway_residual": course.residual,
        "horizontal_force": course.extreme(lambda state: np.abs(state.pull), largest=True).estimate,
        "traction_max": course.extreme(lambda state: np.abs(state.traction), largest=True).estimate,
    }
    if model.commanded(spec, scene) is not None:
        asked = course.extreme(
            lambda state: np.abs(model.motor_torque(spec, state.traction, state.acceleration)), largest=True
        ).estimate
        found["torque_motor_max"] = asked
        found["drive_utilisation"] = scaled(asked, 1 / spec.drive.torque)
    grips = {
        corner: course.extreme(partial(_grip, wheels, corner), largest=False).estimate
        for corner in driven_corners(spec)
    }
    found |= {of("skid_reserve", corner): grip for corner, grip in grips.items()}
    loads = {name: Found(estimate) for name, estimate in found.items()}
    if math.isinf(course.time.value):
        name = "start_time" if starts else "brake_time"
        loads[name] = Found(course.time, note=STALL if starts else RUNAWAY)
    least = min(grips, key=lambda corner: grips[corner].value)
    loads["skid_reserve_min"] = Found(extreme(grips.values(), largest=False), note=f"wheels of corner {least}")
    for name, largest in (("wheel_load_max", True), ("wheel_load_min", False)):
        worst = course.extreme(partial(_wheel, wheels, largest), largest)
        loads[name] = Found(worst.estimate, note=f"{wheels.where(worst.state, largest)}, {worst.phase}")
    tips = course.extreme(partial(stability.reserve, spec, scene), largest=False).estimate
    loads["stability_reserve"] = Found(tips)
    if model.hanging(spec, scene):
        period = 2 * math.pi * math.sqrt(model.rope_length(spec, scene) / spec.gravity)
        loads["sway_period"] = Found(Estimate.exact(period))
        rigid = motion_of(spec, scene).rigid_time
        if math.isfinite(rigid):
            free = pendulum.cancelling_ramp(spec.speed, spec.speed / rigid, period)
            loads["sway_free_ramp"] = Found(Estimate.exact(free))
    return loads


def scaled(estimate: Estimate, factor: float) -> Estimate:
    """Many times as much."""
    return Estimate(
        estimate.value * factor,
        estimate.low * factor,
        estimate.high * factor,
        estimate.numerical * factor,
        estimate.model * factor,
    )


def _grip(wheels: Wheels, corner: str, state: State) -> FloatArray:
    return wheels.grip(state, corner)


def _wheel(wheels: Wheels, largest: bool, state: State) -> FloatArray:
    return wheels.extreme(state, largest)
