"""What a start or stop leaves behind: motors that do not come to speed, clutches that slip for good."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from ptmcalc.base import units
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Failure, Found, of
from ptmcalc.machines.drivetrain import motion
from ptmcalc.machines.drivetrain.model import Case, case_of, rigid, same_shaft
from ptmcalc.machines.drivetrain.spec import Drivetrain, Run, Start, TrainScene
from ptmcalc.numerics.train.parts import Grip

_LOCKED = 1e-9
"""Relative speed of a clutch that counts as none, over the largest speed of the train."""
_LOOKS = 8
_PROGRESS = 1e-3
"""Least share of the slip that a clutch that locks loses while the time doubles."""
_TOLERANCE = 1e-6


@dataclass(frozen=True, slots=True)
class Left:
    """Failures found, and loads they decide."""

    failures: tuple[Failure, ...] = ()
    loads: Mapping[str, Found] = field(default_factory=dict)


def of_motors(
    spec: Drivetrain, scene: TrainScene, end: float, goes_on: Callable[[Case, float], tuple[float, float | None]]
) -> Left:
    """Motors on other shafts than the one the start is about, which do not come to their speed.

    `goes_on` tells of a rigid train when it is at speed, and the speed that it keeps for good.

    **Range** starts; motors with a rated or no-load speed.
    **Error** the links are taken to be rigid.
    **Source** `ending`: the rigid train from the end of the window on.
    """
    if not isinstance(scene, Start):
        return Left()
    failures, unknown, done = [], False, [spec.main(scene)]
    for name, one in spec.motors.items():
        if any(same_shaft(case_of(spec, scene), one.at, other) for other in done):
            continue
        done.append(one.at)
        case = rigid(case_of(spec, scene.model_copy(update={"of": one.at, "until": None}), backlash=False))
        if case.until is None:
            continue
        at_speed, kept = goes_on(case, end)
        unknown = unknown or (kept is None and not math.isfinite(at_speed))
        if kept is not None:
            wanted, now = (units.show(abs(speed), units.ANGULAR_SPEED) for speed in (case.until, kept))
            how = f"stays at {now}" if kept else "stays at rest"
            message = f"`{one.at}` {how} and never reaches {wanted}"
            cure = "more torque of this motor, or less load and resistance"
            failures.append(Failure("DRV109", message, ("motors", name), cure))
    share = Estimate(1.0, 0.0, 1.0, model=1.0)
    return Left(tuple(failures), {"start_share": Found(share)} if unknown and not failures else {})


def of_clutches(spec: Drivetrain, scene: TrainScene, course: motion.Course) -> Left:
    """Clutches that slip at the end: in a start for good, or not known for how long; in a stop behind what rests.

        clutch_slip = |w_1 - w_2|/max |w|

    **Range** starts and stops; a clutch that slips for a while and locks is no failure.
    **Error** 0 is exact; the slip itself goes on to change.
    **Source** the run; the rigid train over doubled times.
    """
    if isinstance(scene, Run):
        return Left()
    failures: list[Failure] = []
    loads: dict[str, Found] = {}
    for grip in course.case.train.grips:
        if grip.second is None:
            continue
        slip, locks = _slip(course, grip), True
        if slip > 0:
            never = course.case.stopping or _slips_for_good(spec, scene, course, grip)
            if never is not False:
                locks = False
                loads[of("clutch_slip", grip.name)] = Found(Estimate(slip, 0.0, math.inf, model=math.inf))
            if never:
                failures.append(_slipping(course, grip))
        if locks:
            loads[of("clutch_slip", grip.name)] = Found(Estimate.exact(0.0))
    return Left(tuple(failures), loads)


def _slip(course: motion.Course, grip: Grip) -> float:
    """Relative speed of a clutch at the end of a run, over the largest speed there; 0 where it is locked."""
    assert grip.second is not None
    speeds = [abs(motion.speeds(course, body)[0]) for body in range(len(course.case.bodies))]
    apart = abs(motion.speeds(course, grip.first)[0] - motion.speeds(course, grip.second)[0])
    return apart / max(speeds) if apart > _LOCKED * max(speeds) else 0.0


def _slips_for_good(spec: Drivetrain, scene: TrainScene, course: motion.Course, grip: Grip) -> bool | None:
    """Whether a clutch slips for good; None where that is not known."""
    case, end = rigid(case_of(spec, scene, backlash=False)), course.record.time
    before = math.inf
    for _ in range(_LOOKS):
        if motion.seconds(case, end) > motion.BESIDE:
            return None
        try:
            now = _slip(motion.run(case, end, _TOLERANCE, most_work=motion.most_work(case, end)), grip)
        except NumericsError:
            return None
        if now == 0:
            return False
        if before - now <= _PROGRESS * before < math.inf:
            return True
        end, before = 2 * end, now
    return None


def _slipping(course: motion.Course, grip: Grip) -> Failure:
    assert grip.second is not None
    told = [
        f"`{course.case.bodies[body]}` {units.show(abs(motion.speeds(course, body)[0]), units.ANGULAR_SPEED)}"
        for body in (grip.first, grip.second)
    ]
    when = "at the end of the stop" if course.case.stopping else "for good"
    message = f"the clutch slips {when}: {told[0]}, {told[1]}"
    return Failure("DRV112", message, ("brakes", grip.name, "torque"), "more clutch torque", element=grip.name)
