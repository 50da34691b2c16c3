"""What a file announces for later than the window of a start or stop: blows, torques over time and position, slack."""

import math
from dataclasses import dataclass

from ptmcalc.machines.drivetrain import motion
from ptmcalc.machines.drivetrain.model import REACHED, Case
from ptmcalc.numerics.train.modes import frequencies
from ptmcalc.numerics.train.parts import Governed, Spring, Straight
from ptmcalc.numerics.train.signals import Signal

_PERIODS = 10
"""Periods of the lowest frequency that are computed after a change, as at the end of a start."""
_FADED = 20.0
"""Time constants after which a decay is below 1e-8 of its beginning."""
_LONGER = 1.2
"""Time computed to a contact or a place, over that at the last speed."""
_REST = 1e-9
"""Speed that counts as none, over the largest of a run."""


@dataclass(frozen=True, slots=True)
class Ahead:
    """What acts later than a run, and how long a run contains it [s]."""

    until: float
    what: str = ""


def signals_of(case: Case) -> list[Signal]:
    """All that depends on the time in a case."""
    train = case.train
    found = [drive.gate for drive in train.drives]
    found += [grip.capacity for grip in train.grips]
    found += [guide.acceleration for guide in train.guides]
    laws = [stage.law for drive in train.drives if drive.name != REACHED for stage in drive.stages]
    found += [law for law in laws if isinstance(law, Signal)]
    return found + [law.reference for law in laws if isinstance(law, Governed)]


def last_of(signal: Signal) -> float:
    """Time of the last change of a signal; of a sine that of its first period [s]."""
    periods = [2 * math.pi / sine.frequency for sine in signal.sines if sine.frequency > 0]
    faded = signal.decay_start + _FADED * signal.decay_time if signal.decay else 0.0
    return max([signal.times[-1], faded, *periods])


def over_time(case: Case) -> Ahead:
    """The last of the changes over time that a file announces, with what rings after it.

    **Range** starts and stops without a `duration`.
    **Error** none: the times are those of the file.
    **Source** the file; ten periods of the lowest frequency as in every window.
    """
    train = case.train
    stages = [(drive.name, stage) for drive in train.drives for stage in drive.stages]
    times = [
        *((impulse.time, f"impulse on `{case.bodies[impulse.body]}`") for impulse in train.impulses),
        *((stage.until_time, f"`{name}`") for name, stage in stages if stage.until_time is not None),
        *((last_of(signal), "a torque over time") for signal in signals_of(case)),
    ]
    last, what = max(times, default=(0.0, ""))
    return Ahead(last + _ringing(case), what) if last > 0 else Ahead(0.0)


def over_motion(case: Case, course: motion.Course) -> Ahead:
    """What the train reaches as it moves on after a run: the rest of a torque over position, the end of slack or play
    that no run has taken up yet.

    **Range** the last speed of the run is kept.
    **Error** the time is an estimate; a longer run is looked at again.
    **Source** way over speed.
    """
    end = course.record.time
    found = [Ahead(0.0)]
    for drive in case.train.drives:
        for stage in drive.stages:
            if isinstance(stage.law, Straight) and stage.law.on == "position":
                way = _way_left(case, course, drive.body, stage.law)
                found.append(_after(course, end, case, drive.body, None, way, f"`{drive.name}`"))
    found += [_contact(case, course, end, spring) for spring in case.train.springs if spring.play > 0]
    return max(found, key=lambda one: one.until)


def _ringing(case: Case) -> float:
    lowest = float(frequencies(case.train).min(initial=math.inf))
    return _PERIODS * 2 * math.pi / lowest if math.isfinite(lowest) else 0.0


def _last(course: motion.Course, what: str, body: int) -> float:
    index = course.index(what, course.case.bodies[body])
    assert index is not None
    return float(course.record.last[index])


def _way_left(case: Case, course: motion.Course, body: int, law: Straight) -> float:
    """Way in the sense of the motion until the torque has taken all its values [rad or m]."""
    here, speed = _last(course, "position", body), _last(course, "speed", body)
    index = course.index("position", case.bodies[body])
    assert index is not None
    if law.period > 0:
        travelled = float(course.record.top.values[index] - course.record.bottom.values[index])
        return max(law.period - travelled, 0.0)
    knots = [knot for knot in law.knots if (knot > here if speed > 0 else knot < here)]
    return max((abs(knot - here) for knot in knots), default=0.0)


def _after(
    course: motion.Course, end: float, case: Case, first: int, second: int | None, way: float, what: str
) -> Ahead:
    """When a way is behind the train at its last speed; never where it rests."""
    speed = _last(course, "speed", first) - (_last(course, "speed", second) if second is not None else 0.0)
    fastest = max(abs(_last(course, "speed", body)) for body in range(len(case.bodies)))
    if way <= 0 or abs(speed) <= _REST * fastest:
        return Ahead(0.0)
    return Ahead(end + _LONGER * way / abs(speed) + _ringing(case), what)


def _contact(case: Case, course: motion.Course, end: float, spring: Spring) -> Ahead:
    """When a link that has carried nothing so far comes into contact."""
    index = course.torque(spring.name)
    if index is None or course.largest(index)[0] != 0:
        return Ahead(0.0)
    apart = _last(course, "position", spring.first) - spring.rest
    speed = _last(course, "speed", spring.first)
    if spring.second is not None:
        apart -= _last(course, "position", spring.second)
        speed -= _last(course, "speed", spring.second)
    side = math.copysign(1.0, speed)
    if spring.side and side != spring.side:
        return Ahead(0.0)
    way = spring.play / 2 - side * apart
    return _after(course, end, case, spring.first, spring.second, way, f"contact of `{spring.name}`")
