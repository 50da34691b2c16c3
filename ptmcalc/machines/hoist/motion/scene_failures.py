"""What a run of a hoist found to fail, and remarks on what happened on the way."""

import math

from ptmcalc.base import units
from ptmcalc.contract.result import Failure, Finding
from ptmcalc.machines.hoist.machine.spec import Lift, Release, Start
from ptmcalc.machines.hoist.motion.course import Course, first_event, lift_off_time, stopped
from ptmcalc.machines.hoist.motion.train import DRIVE, LONGEST, MOTOR, ROPE, Case, Moving
from ptmcalc.numerics.piecewise import JAMMED


def remarks(scene: Moving, course: Course) -> list[Finding]:
    """What happened on the way that a reader must know."""
    said = []
    label, case = scene.label, course.case
    if isinstance(scene, Lift) and not math.isfinite(lift_off_time(course)):
        said += not_seen(scene, case)
    time = first_event(course, DRIVE, "started")
    if math.isfinite(time):
        said.append(tripped(scene, time))
    said += [
        Finding(
            "NUM104",
            f"scene `{label}`: {event.element} locks at {event.time:.4g} s: a self-locking gear cannot be braked from"
            " its motor's side against this load inertia; an immediate stop is assumed",
            ("gearbox",),
        )
        for event in course.record.events
        if event.after == JAMMED
    ]
    return said


def failures(scene: Moving, course: Course) -> list[Failure]:
    """What the run found to fail: a motor that stalls or lowers the load it lifts, a brake that does not hold it."""
    case, found = course.case, []
    trips = math.isfinite(first_event(course, DRIVE, "started"))
    if isinstance(scene, Lift):
        rope = case.named("link", ROPE)
        assert rope is not None
        lifted = math.isfinite(lift_off_time(course))
        found += tripped_early(scene) if trips and not lifted else stalls(case, lifted, course.top("link", rope))
    if isinstance(scene, Start) and not case.lowers and _sinks(course):
        reason = "the motor stalls under the suspended load: the load descends and drives the motor"
        found.append(Failure("HST114", reason, _TORQUE, "a stronger motor, a larger gear ratio, or less load"))
    if case.stops and math.isinf(stopped(course)):
        found += not_held(case)
    if isinstance(scene, Release) and scene.manner == "quick":
        found += gone_slack(first_event(course, ROPE, "open"))
    return found


def gone_slack(time: float) -> list[Failure]:
    """A rope that goes slack at a time, after a part of the load has come off."""
    if not math.isfinite(time):
        return []
    return [
        Failure(
            "HST126",
            f"the rope goes slack at {time:.3g} s",
            (),
            "release a smaller part of the load, or release it slowly",
        )
    ]


_TORQUE = ("motor",)


def not_held(case: Case) -> list[Failure]:
    """A load that its brake does not hold, or not for long."""
    way = units.show(case.drop, units.SPAN)
    reason = f"the brake does not hold the load: it descends to the ground, or to the end of the rope, by up to {way}"
    if case.holds:
        reason = "the load rebounds on its rope, and the brake slips each time the rope becomes taut"
    return [Failure(code, reason, ("brake", "torque"), "a stronger brake") for code in ("HST118", "HST122")]


def tripped(scene: Moving, time: float) -> Finding:
    """A limiter that has tripped: it works as it should."""
    return Finding("NUM113", f"scene `{scene.label}`: the limiter trips at {time:.3g} s and stops the hoist")


def tripped_early(scene: Moving) -> list[Failure]:
    """A limiter that trips before the load leaves the ground."""
    reason, hint = "the limiter trips before the load leaves the ground", "a larger factor or delay of the limiter"
    return [Failure("HST121", reason, ("limiter", "factor"), hint)]


def outlasts(case: Case) -> bool:
    """Whether a lift by a drive that is strong enough may take longer than anything is looked at."""
    return case.window >= LONGEST and not case.weak


def not_seen(scene: Lift, case: Case) -> list[Finding]:
    """A lift that takes longer than is computed."""
    if not outlasts(case):
        return []
    reason = f"the load is still on the ground at the end of the longest window, {case.window:.3g} s"
    return [Finding("NUM103", f"scene `{scene.label}`: {reason}", ("speed",), "increase the speed")]


def stalls(case: Case, lifted: bool, largest: tuple[float, float | None]) -> list[Failure]:
    """A drive that stalls in a lift, with its phase; `largest` is the largest force of the rope and its time."""
    if (lifted and not case.weak) or (not lifted and outlasts(case)):
        return []
    force, time = largest[0], largest[1] or 0.0
    phase = "taking up the slack" if force <= 0 else "tensioning the rope"
    if lifted:
        phase = "holding the load, which only its oscillation lifted off the ground"
    reached = units.show(force, units.FORCE)
    weight = units.show(case.weight, units.FORCE)
    reason = (
        f"the motor stalls while {phase}: the rope force reaches {reached} at {time:.3g} s, the load weighs {weight}"
    )
    return [Failure("HST121", reason, _TORQUE, "a stronger motor, a larger gear ratio, or less load")]


def _sinks(course: Course) -> bool:
    """Whether the drum of a start upward turns down in the end."""
    motor = course.case.named("body", MOTOR)
    assert motor is not None
    return float(course.record.last[course.system.watched["speed", motor]]) < 0
