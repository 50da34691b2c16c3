"""Loads with bars, from several runs that divide time otherwise."""

import math
from collections.abc import Iterable

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, family, of
from ptmcalc.machines.drivetrain.machine.model import Case
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain
from ptmcalc.machines.drivetrain.motion import simulation
from ptmcalc.machines.drivetrain.motion.course import Course
from ptmcalc.machines.drivetrain.motion.simulation import Readings, part_of
from ptmcalc.numerics.flow import FADED
from ptmcalc.numerics.train.parts import Smooth

_COMPARED = (0.7, 0.85)
"""Length of intervals and panels of the compared runs, relative to the run that counts [1]. A numerical choice: the
difference gives the error bar. Values near 1 compare runs whose errors agree; smaller ones take longer."""
_MARGIN = 3.0
"""Safety factor on the difference of runs with other time steps [1]; a numerical choice. A smaller value loses the
safety of the error bar; a larger one widens it."""
_ALIKE = 1e-3
"""Size of a load relative to the largest of its kind [1] below which its relative difference is ignored. A numerical
choice: rounding of small parts would widen the error bars of all. A larger value narrows the bars of small loads."""
_POLYNOMIALS = 3e-12
"""Error of a signal between the nodes of its polynomials, relative to its largest value [1]. A numerical choice above
the resolution 2e-16 of the floating point. A larger value widens bars that are otherwise rounding."""
_UNSEEN = FADED + _POLYNOMIALS
"""What reading a signal may miss of it: components that have faded, and what lies between the nodes."""

_FACTS = frozenset({"start_share", "stop_speed_share", "part_start_share", "part_stop_speed_share", "clutch_slip"})
"""Loads that say whether a start or stop is over, which all runs agree on; what is left of the speed where it is not is
read from runs that are no closer than their bars."""


def played(case: Case, end: float, tolerance: float) -> tuple[Course, ...]:
    """The run that counts, and those it is compared with: one, or two with a nonlinear torque."""
    most = simulation.most_work(case, end)
    course = simulation.run(case, end, tolerance, most_work=most)
    compared = _COMPARED if course.smooth else _COMPARED[:1]
    return (course, *(simulation.run(case, end, tolerance, refined, most_work=2 * most) for refined in compared))


def loads(spec: Drivetrain, course: Course, *others: Course) -> dict[str, Found]:
    """The loads of a run, with bars from others.

        bar = e |x|,   e = 3 max |x - x'|/|x|   over the loads of one kind and over the other runs

    Without a nonlinear torque all runs are exact, and what differs is rounding. With one each run has an error of its
    own: that of a stretch goes with the ninth power of its length, so stretches 0.7 and 0.85 times as long, or such
    multiples of two of it, have errors at least 25 and 4 times as large or as small, and two runs differ by nearly the
    larger error; 3 leaves room for errors of many stretches that add and cancel. Where a load agrees by chance, others
    of its kind do not: those of forces, or those of motion. Added is what reading a signal may miss; where a motor
    gives less torque than it could, as at its synchronous speed, forces miss as much as they would beside all of it,
    for they are read from a speed that is known no better. What is largest at the start is what the file says.
    """
    own = simulation.readings(spec, course)
    compared = [simulation.readings(spec, other) for other in others]
    sizes = _sizes(own)
    apart = {name: max(differences) for name in own if (differences := _differences(name, own, compared))}
    shares = {force: _share(apart, sizes, force) for force in (True, False)}
    idle = _idle(course, sizes)
    found = {}
    for name, (value, time) in own.items():
        at = {"time": time} if time is not None else {}
        if name not in apart or family(name) in _FACTS:
            same = all(_as_good(name, value, other[name][0]) for other in compared)
            told = Estimate.exact(value) if same else Estimate.unknown(value)
            # a share of a speed that is known no better; without end where the speed at the start is 0
            if same and family(name) in _FACTS and value not in (0.0, 1.0, math.inf):
                told = Estimate.within(value, (_MARGIN * shares[False] + _UNSEEN) * abs(value))
            found[name] = Found(told, at)
            continue
        size = sizes[part_of(name)]
        bar = _MARGIN * apart[name]
        if time != 0:
            bar = (
                max(bar, _MARGIN * shares[_is_force(name)] * size) + _UNSEEN * (idle if _is_force(name) else 1.0) * size
            )
        found[name] = Found(Estimate.within(value, bar), at)
    found["energy_residual"] = Found(Estimate.exact(course.ledger.residual))
    return found


def _as_good(name: str, value: float, other: float) -> bool:
    """Whether two runs say the same; of shares of a speed, whether both or neither are at their limit."""
    if family(name) not in _FACTS:
        return value == other
    over = 1.0 if family(name) in ("start_share", "part_start_share") else 0.0
    return (value == over) == (other == over)


def at_end(spec: Drivetrain, name: str, course: Course, *others: Course) -> Estimate:
    """Torque in a link or gear at the end of a run, with a bar as in `loads`."""
    index = course.torque(name)
    assert index is not None
    values = [abs(float(one.record.last[index])) for one in (course, *others)]
    apart = max(abs(value - values[0]) for value in values)
    idle = _idle(course, _sizes(simulation.readings(spec, course))) if course.smooth else 1.0
    return Estimate.within(values[0], _MARGIN * apart + _UNSEEN * idle * max(course.largest(index)[0], values[0]))


def _sizes(own: Readings) -> dict[tuple[str, str], float]:
    """Largest magnitude of what is read of each part."""
    sizes: dict[tuple[str, str], float] = {}
    for name, (value, _) in own.items():
        if math.isfinite(value):
            sizes[part_of(name)] = max(sizes.get(part_of(name), 0.0), abs(value))
    return sizes


def _idle(course: Course, sizes: dict[tuple[str, str], float]) -> float:
    """What the torque curves of the motors could give over what they gave at most, at least 1."""
    could = {
        drive.name: stage.law.size
        for drive in course.case.train.drives
        for stage in drive.stages
        if isinstance(stage.law, Smooth)
    }
    gave = {name: sizes.get(part_of(of("motor_torque_peak", name)), 0.0) for name in could}
    return max([1.0, *(could[name] / gave[name] for name in could if gave[name] > 0)])


def _differences(name: str, own: Readings, others: Iterable[Readings]) -> list[float]:
    """How far a load lies from that of each other run; none where one of them is not finite."""
    values = [other[name][0] for other in others]
    value = own[name][0]
    return [abs(value - other) for other in values] if all(map(math.isfinite, (value, *values))) else []


def _share(apart: dict[str, float], sizes: dict[tuple[str, str], float], force: bool) -> float:
    """Largest difference of loads of one kind, over their sizes; of parts that hardly take part none counts."""
    kind = {name: sizes[part_of(name)] for name in apart if _is_force(name) is force}
    least = _ALIKE * max(kind.values(), default=0.0)
    return max((apart[name] / size for name, size in kind.items() if size > least), default=0.0)


def _is_force(name: str) -> bool:
    return "torque" in name
