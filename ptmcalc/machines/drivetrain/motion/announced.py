"""Events that a design file announces: those with a time, and those at a place that the motion still approaches."""

import math
from collections.abc import Iterator
from itertools import pairwise

from ptmcalc.machines.drivetrain.machine.model import REACHED, Case
from ptmcalc.machines.drivetrain.motion.course import Course
from ptmcalc.numerics.train.parts import Drive, Governed, Spring, Straight
from ptmcalc.numerics.train.signals import Signal

_STILL = 1e-9
"""Speed relative to the largest of the train [1] that counts as standstill: rounding of a body at rest. A numerical
choice. A larger value stops slow bodies; a smaller one reports rounding as motion."""
_TOUCHES = 1e-9
"""Distance from contact relative to the backlash [1] that counts as contact: rounding of a link that starts in contact.
A numerical choice. A larger value closes small gaps; a smaller one reports rounding as a gap."""


def times(case: Case) -> dict[str, float]:
    """Time until which each part acts differently, after the start of the scene [s].

    An impulse has one time, a torque over time its last point, a delay its end, a sine the end of its first period.
    """
    train = case.train
    found = {name: one.time for name, one in zip(case.impulses, train.impulses, strict=True)}
    for drive in train.drives:
        if not drive.name.startswith(REACHED):
            found[drive.name] = max(_times_of_drive(drive))
    found |= {guide.name: _last(guide.acceleration) for guide in train.guides}
    found |= {grip.name: max(_last(grip.capacity), _last(grip.gate)) for grip in train.grips}
    return {name: time for name, time in found.items() if time > 0}


def _times_of_drive(drive: Drive) -> Iterator[float]:
    yield _last(drive.gate)
    for stage in drive.stages:
        yield stage.until_time or 0.0
        if isinstance(stage.law, Governed):
            yield _last(stage.law.reference)
        elif isinstance(stage.law, Signal):
            yield _last(stage.law)


def _last(signal: Signal) -> float:
    """Time of the last point of a signal, or the end of the first period of its slowest sine [s]."""
    periods = (2 * math.pi / sine.frequency for sine in signal.sines if sine.size)
    return max([signal.times[-1], signal.decay_start if signal.decay else 0.0, *periods])


def approached(course: Course) -> dict[str, float]:
    """Time at which the motion reaches each place that the file announces and the run has not reached [s].

    Such a place is a point of a torque over the position ahead of the body, or the contact of a link that has never
    touched. The body keeps its speed at the end of the run.
    """
    found = {name: course.record.time + time for name, time in _tables(course)}
    return found | {name: course.record.time + time for name, time in _contacts(course)}


def _tables(course: Course) -> Iterator[tuple[str, float]]:
    for drive in course.case.train.drives:
        law = drive.stages[0].law
        if isinstance(law, Straight) and law.on == "position":
            name = course.case.bodies[drive.body]
            speed, index = _last_of(course, "speed", name), course.index("position", name)
            assert index is not None
            low, high = float(course.record.bottom.values[index]), float(course.record.top.values[index])
            left = _left_of_table(law, low, high, forward=speed > 0)
            if left > 0 and abs(speed) > _still(course):
                yield drive.name, left / abs(speed)


def _left_of_table(law: Straight, low: float, high: float, *, forward: bool) -> float:
    """Distance from the positions of a run to the last point ahead at which the torque changes; 0 without one."""
    if law.period:
        return max(law.period - (high - low), 0.0)
    points = list(zip(law.knots, law.values, strict=True))
    if not forward:
        points, high = [(-knot, value) for knot, value in reversed(points)], -low
    changing = [knot for (_, before), (knot, value) in pairwise(points) if value != before]
    return max(max(changing, default=high) - high, 0.0)


def _contacts(course: Course) -> Iterator[tuple[str, float]]:
    for spring in course.case.train.springs:
        index = course.torque(spring.name)
        if not spring.play or index is None or course.largest(index)[0] > 0:
            continue
        left, rate = _left_of_play(course, spring)
        if left > _TOUCHES * spring.play and rate > _still(course):
            yield spring.name, left / rate


def _left_of_play(course: Course, spring: Spring) -> tuple[float, float]:
    """Distance of an open link from the contact that it approaches, and its closing speed."""
    names = course.case.bodies
    apart, rate = (_last_of(course, what, names[spring.first]) for what in ("position", "speed"))
    if spring.second is not None:
        apart -= _last_of(course, "position", names[spring.second])
        rate -= _last_of(course, "speed", names[spring.second])
    side = spring.side or math.copysign(1.0, rate)
    return spring.play / 2 - side * (apart - spring.rest), side * rate


def _last_of(course: Course, what: str, name: str) -> float:
    index = course.index(what, name)
    assert index is not None
    return float(course.record.last[index])


def _still(course: Course) -> float:
    """Speed below which a body counts as at rest."""
    record, largest = course.record, 0.0
    for name in course.case.bodies:
        index = course.index("speed", name)
        assert index is not None
        largest = max(largest, abs(float(record.top.values[index])), abs(float(record.bottom.values[index])))
    return _STILL * largest
