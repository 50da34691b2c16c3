"""What finite angles may make of a swing that was reckoned with small ones: proven bounds for a sudden ramp."""

import math
from collections.abc import Callable
from dataclasses import replace

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.laws import pendulum
from ptmcalc.machines.crane.travelling.sway.course import Course, Phase, between
from ptmcalc.machines.crane.travelling.sway.linear import linear_course
from ptmcalc.machines.crane.travelling.sway.moving import Motion

_SAMPLES = 200
"""Samples [1] of the sway angle between which the largest rope force is enclosed: enough for its single top and its
ends. A numerical choice; the top itself is found by `_REDUCTIONS`."""
_GOLDEN = (math.sqrt(5) - 1) / 2
_REDUCTIONS = 40
"""Golden sections [1] of the interval around a top. Derived: they leave 4e-9 of it, so that the value of a smooth top
is exact to rounding."""
_SMALL = 0.03
"""Value of x [1] up to which x - atan x is a series. Derived: at 0.03 the neglected term, 3 x^8/11, and the
cancellation of the closed form are both below 1e-12. A larger value raises the first error, a smaller one the
second."""


def far(x: float) -> float:
    """x - atan x, without loss of digits."""
    if abs(x) > _SMALL:
        return x - math.atan(x)
    return x**3 * (1 / 3 - x**2 * (1 / 5 - x**2 * (1 / 7 - x**2 / 9)))


def strays(motion: Motion, time: float) -> float:
    """Most by which (angle, rate/omega) of a swing under the ramp differ from the linear ones after a time [rad]."""
    assert motion.ramp is not None
    turned = math.sqrt(motion.gravity / motion.length) * time
    return far(motion.ramp / motion.gravity) * (2 * abs(math.sin(min(turned / 2, math.pi / 2))) + turned)


def regular(motion: Motion) -> bool:
    """Whether it is a ramp from rest or to rest, with ropes of constant length, no wind or slope at the load."""
    still = not motion.hoisting and not motion.on_load
    return bool(motion.load) and motion.ramp is not None and still and motion.ramp < motion.gravity


def exact_course(motion: Motion) -> Course:
    """A sudden ramp by the closed form of its swing: the pull goes with the angle, from rest and back.

    **Range** `regular` motions.
    **Error** exact; of loads that hang on pull and weight of the rope at one instant the extremes of both.
    **Source** `laws.pendulum.ramp_swing`; energy of the pendulum.
    """
    assert motion.ramp is not None
    lasts = motion.speed / motion.ramp
    top, left = pendulum.ramp_swing(motion.ramp, motion.gravity, motion.length, lasts)
    cap = 2 * math.atan(motion.ramp / motion.gravity)
    linear = linear_course(motion)
    # in the ramp itself the angle stays below the largest of all only where what is left swings farther
    inside = _largest_in_ramp(motion, lasts, cap, top, left)
    exactly = Interval(inside, inside)
    phases = tuple(_exactly(motion, phase, exactly, left) for phase in linear.phases)
    return replace(linear, sway=Estimate.exact(top), residual=Estimate.exact(left), phases=phases, work=1)


def _largest_in_ramp(motion: Motion, lasts: float, cap: float, top: float, left: float) -> float:
    """Largest angle while the ramp lasts: all of it once it lasts half a swing, else that at its end."""
    if top > left:
        return top
    # the swing left goes farther: its energy tells the angle theta_1 at the end of the ramp
    assert motion.ramp is not None
    sine = min(2 * motion.gravity / motion.ramp * math.sin(left / 2) ** 2, 1.0)
    return min(math.asin(sine), cap)


def _exactly(motion: Motion, phase: Phase, largest: Interval, left: float) -> Phase:
    """A phase with the pulls of the closed form."""
    wide = _widened(motion, phase, largest, Estimate.exact(left))
    if phase.name in ("start", "stop"):
        assert motion.ramp is not None
        most = _pull_of_ramp(motion.load, motion.gravity, motion.ramp, largest).high
    else:
        most = _pull_of_free(motion.load, motion.gravity, Estimate.exact(left)).high
    ends = tuple(
        Estimate.exact(math.copysign(most, one.value)) if abs(one.value) > 1e-9 * most else one for one in phase.pulls
    )
    return replace(wide, pulls=(ends[0], ends[1]))


def widened(motion: Motion, course: Course) -> Course:
    """A course under a sudden ramp with the bars of finite angles."""
    assert motion.ramp is not None
    gravity, ramp = motion.gravity, motion.ramp
    cap = 2 * math.atan(ramp / gravity)
    lasts = motion.speed / ramp
    slack = strays(motion, lasts)
    rho = course.residual
    residual = between(rho.value, max(rho.low - slack, 0.0), min(2 * math.asin(min((rho.high + slack) / 2, 1.0)), cap))
    swings = course.phases[0]
    ends = [abs(pull.value) / (motion.load * gravity) for pull in swings.pulls]
    linear = max(ends)
    largest = Interval(max(linear - slack, 0.0), min(linear + slack, cap))
    top = max(largest.high, residual.high)
    sway = between(min(max(course.sway.value, largest.low), top), max(largest.low, residual.low), top, 0.0)
    return replace(
        course,
        sway=sway,
        residual=residual,
        phases=tuple(_widened(motion, phase, largest, residual) for phase in course.phases),
    )


def _widened(motion: Motion, phase: Phase, largest: Interval, residual: Estimate) -> Phase:
    """A phase whose pulls have the bars of finite angles, and whose load weighs what its rope lets it."""
    gravity, mass = motion.gravity, motion.load
    if phase.name in ("start", "stop"):
        assert motion.ramp is not None
        bounds = _pull_of_ramp(mass, gravity, motion.ramp, largest)
        weight = _weight_of_ramp(mass, gravity, motion.ramp, largest.high)
    else:
        bounds = _pull_of_free(mass, gravity, residual)
        weight = Interval(
            mass * gravity * math.cos(residual.high) ** 2, mass * gravity * (3 - 2 * math.cos(residual.high))
        )
    return replace(phase, pulls=(_end(phase.pulls[0], bounds), _end(phase.pulls[1], bounds)), weight=weight)


def _end(pull: Estimate, bounds: Interval) -> Estimate:
    """An end of the pull: the one at rest stays what it is, the other lies between the bounds."""
    tiny = 1e-12 * bounds.high
    if abs(pull.value) <= tiny:
        return pull
    low, high = min(bounds.low, abs(pull.value)), max(bounds.high, abs(pull.value))
    if pull.value < 0:
        low, high = -high, -low
    return between(pull.value, min(low, pull.low), max(high, pull.high))


def _pull_of_ramp(mass: float, gravity: float, ramp: float, largest: Interval) -> Interval:
    """Largest horizontal pull of a load whose largest angle lies in an interval [N]."""

    def most(angle: float) -> float:
        return _largest(
            lambda psi: mass * (3 * gravity * math.cos(psi) + 3 * ramp * math.sin(psi) - 2 * gravity) * math.sin(psi),
            angle,
        )

    return Interval(most(largest.low), most(largest.high))


def _weight_of_ramp(mass: float, gravity: float, ramp: float, angle: float) -> Interval:
    """Range of the vertical pull of the rope [N]."""

    def pull(psi: float) -> float:
        return mass * (3 * gravity * math.cos(psi) + 3 * ramp * math.sin(psi) - 2 * gravity) * math.cos(psi)

    return Interval(-_largest(lambda psi: -pull(psi), angle), _largest(pull, angle))


def _pull_of_free(mass: float, gravity: float, amplitude: Estimate) -> Interval:
    """Largest horizontal pull of a load that swings freely in an angle [N]."""

    def most(angle: float) -> float:
        return _largest(lambda psi: mass * gravity * (3 * math.cos(psi) - 2 * math.cos(angle)) * math.sin(psi), angle)

    return Interval(most(amplitude.low), most(amplitude.high))


def _largest(of: Callable[[float], float], angle: float) -> float:
    """Largest value of a smooth function between 0 and an angle: at an end, or at a top enclosed by three samples."""
    samples = [angle * k / _SAMPLES for k in range(_SAMPLES + 1)]
    values = [of(psi) for psi in samples]
    best = values.index(max(values))
    if not 0 < best < _SAMPLES:
        return values[best]
    low, high = samples[best - 1], samples[best + 1]
    for _ in range(_REDUCTIONS):
        left, right = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
        low, high = (low, right) if of(left) > of(right) else (left, high)
    return max(values[best], of((low + high) / 2))
