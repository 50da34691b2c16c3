"""Loads read from runs of a column and its base: deflection, moment, times, with their error bars."""

import math
from dataclasses import dataclass, replace

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.memory import kept_for
from ptmcalc.contract.result import Found
from ptmcalc.machines.crane.stacking.machine.scenes import Brake, StackerScene, Start
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.mast.march import Happening
from ptmcalc.machines.crane.stacking.mast.resting import at_rest
from ptmcalc.numerics.mast.modes import Mast, left_out, moment_left_out
from ptmcalc.numerics.mast.run import Course

_MARGIN = 3.0
"""Factor [1] on the difference of the fine and the coarse run, in the error bar. A numerical choice: a larger value
widens the bar and leaves more verdicts undecided. Below 1 the bar may exclude the coarse run."""
_UNSEEN = 1e-10
"""Share of a reading that the march may miss of it."""


@dataclass(frozen=True, slots=True)
class Played:
    """A run, and the place and stiffness its deflections are read with."""

    moves: Happening
    course: Course
    nudged: tuple[Course | None, Course | None] = (None, None)
    """runs of a base that has a little less speed to win or to lose, and a little more: by what the modes left out may
    add to it; None for one that has none to lose, and of a base that keeps to its path"""

    @property
    def place(self) -> float:
        """The far end [m]."""
        return self.moves.column.column.length


def _bar(fine: float, coarse: float, more: float = 0.0) -> Estimate:
    """A reading with its bar: from the run beside it, and what is known of the modes left out."""
    return Estimate.within(fine, _MARGIN * abs(fine - coarse) + _UNSEEN * abs(fine) + more)


def _deflection(fine: Played, coarse: Played) -> Found:
    moves, course = fine.moves, fine.course
    value, time = course.largest("deflection")
    other = coarse.course.largest("deflection")[0]
    mast, kept = course.case.mast, course.system.count
    rest = left_out(mast, moves.rolling, fine.place, kept, moves.rise, moves.jump)
    known = _bar(value, other, rest + _nudge(fine, "deflection", value) + _beats(fine)[0])
    return Found(_ringing(fine, "deflection", known), {"time": time})


def _ringing(fine: Played, what: str, known: Estimate) -> Estimate:
    """A largest value of a column that rings on: without damping its modes meet in phase some time after the run."""
    if not fine.course.stays:
        return known
    most = fine.course.most_later(what) + known.high - known.value
    return replace(known, high=most, model=most - known.high) if most > known.high else known


def _times(one: Found, factor: float) -> Found:
    e = one.estimate
    ends = e.low * factor, e.high * factor
    return Found(Estimate(e.value * factor, *ends, e.numerical * factor, e.model * factor), one.at)


def _moment(fine: Played, coarse: Played) -> Found:
    moves, course = fine.moves, fine.course
    value, time = course.largest("moment")
    rest = moment_left_out(course.case.mast, moves.rolling, course.system.count, moves.rise, moves.jump)
    rest += _nudge(fine, "moment", value) + _beats(fine)[1]
    known = _bar(value, coarse.course.largest("moment")[0], rest)
    return Found(_ringing(fine, "moment", known), {"time": time})


def swing_loads(scene: StackerScene, fine: Played, coarse: Played) -> dict[str, Found]:
    deflection = _deflection(fine, coarse)
    found = {
        "mast_deflection_max": deflection,
        "mast_force_max": _times(deflection, fine.moves.column.stiffness),
        "mast_moment_max": _moment(fine, coarse),
    }
    name = "start_time" if isinstance(scene, Start) else "brake_time"
    if fine.moves.follows:
        found[name] = Found(Estimate.exact(fine.moves.lasts))
        return found
    if not isinstance(scene, Start):
        found[name] = _standstill(fine, coarse)
        return found
    time, other = (one.course.first("base", "at speed") for one in (fine, coarse))
    if math.isfinite(time) and math.isfinite(other):
        found[name] = Found(_first_time(fine, "at speed", time, other))
    elif math.isinf(time) and math.isinf(other):
        found[name] = Found(Estimate.exact(math.inf))
    else:
        found[name] = Found(Estimate.unknown(time))
    return found


def _standstill(fine: Played, coarse: Played) -> Found:
    """When the base stands for good: with its first standstill, or where the column pulls it through its brake again
    with the last one.

    The last one of a base that slips again lies where the runs beside it put it too, and has no later end where
    something may still wake it: a column without damping pulls for ever. Before its first standstill it does not stand.
    """
    first, other = (one.course.first("base", "at rest") for one in (fine, coarse))
    if math.isinf(first) or math.isinf(other):
        return Found(Estimate.exact(math.inf) if first == other else Estimate.unknown(first))
    begun = _first_time(fine, "at rest", first, other)
    runs = [fine.course, coarse.course, *(one for one in fine.nudged if one is not None)]
    lasts = [one.held_since for one in runs]
    if all(one.stays and stands_at_once(one) for one in runs):
        return Found(begun)
    if math.isinf(lasts[0]):
        note = f"by {fine.course.record.time:.3g} s the base is not permanently at standstill"
        return Found(Estimate(math.inf, begun.low, math.inf, model=math.inf), note=note)
    apart = _MARGIN * abs(lasts[0] - lasts[1])
    low = max(begun.low, min(*lasts, lasts[0] - apart))
    high = max(begun.high, *lasts, lasts[0] + apart) if all(one.stays for one in runs) else math.inf
    note = "the mast pulls the base through its brake after the first standstill"
    if math.isinf(high):
        return Found(Estimate(lasts[0], low, high, model=math.inf), note=f"{note}, and may do so again")
    return Found(Estimate(lasts[0], low, high, numerical=max(lasts[0] - low, high - lasts[0])), note=note)


def stands_at_once(course: Course) -> bool:
    """Whether the first standstill of a base is its last."""
    return course.held_since <= course.first("base", "at rest") * (1 + 1e-9)


def _first_time(fine: Played, word: str, time: float, other: float) -> Estimate:
    """When the base first has its speed, or first stands.

    What the modes left out may add to its speed is at most V (`speed_left_out`): it is there no sooner than a base that
    has V less to go, and no later than one that has V more. Two runs more tell when those are; they count beside the
    difference to half as many modes, which by chance may be nothing.
    """
    known = _bar(time, other)
    low, high = (0.0 if one is None else one.first("base", word) for one in fine.nudged)
    low, high = known.low - max(time - low, 0.0), known.high + max(high - time, 0.0)
    return Estimate(time, max(low, 0.0), high, numerical=max(time - low, high - time))


@kept_for(16)
def _beats(fine: Played) -> tuple[float, float]:
    """What deflection and moment may be off by as modes that ring on meet in other phases than they would.

        sum_k |g_k| s_k min(2, |w_k - w_k'| T)

    with g_k what a mode takes of the load that comes up, s_k = min(1, 2/(w_k t_r)), w_k its frequency of twice as many
    elements and w_k' that of the modes kept, in a run of the time T. Two runs may agree on a largest value by chance.
    """
    moves, course = fine.moves, fine.course
    if moves.obstacle is not None:
        return 0.0, 0.0
    mast, kept = course.case.mast, course.system.count
    exact = Mast.of(moves.column.column, 2 * (len(mast.elements.places) - 1), (fine.place,))
    built, base = exact.elements, moves.rolling
    held = mast.frequencies[:kept]
    if math.isinf(base):
        values, shapes, own, per = exact.frequencies, exact.shapes, held, 1.0
    else:
        values, shapes = exact.rolling(base)
        total = base + mast.elements.total
        pull = mast.participation[:kept]
        inverse = (np.eye(kept) - np.outer(pull, pull) / total) / np.outer(held, held)
        own = 1 / np.sqrt(np.linalg.eigvalsh(inverse)[::-1])
        per = 1 / total
    count = min(kept, len(values))
    values, shapes, own = values[:count], shapes[:, :count], own[:count]
    pushed = built.carried @ shapes * per
    inertia = built.turned @ shapes
    if math.isfinite(base):
        inertia = inertia - built.moment * pushed
    meets = np.minimum(2.0, np.abs(values - own) * course.record.time) * abs(moves.jump)
    if moves.rise > 0:
        meets = meets * np.minimum(1.0, 2 / (values * moves.rise))
    gains = (
        built.row(fine.place) @ shapes * pushed / values**2,
        inertia * pushed - built.righted @ shapes * pushed / values**2,
    )
    shift, turn = (float(np.abs(one) @ meets) for one in gains)
    return shift, turn


def _nudge(fine: Played, what: str, value: float) -> float:
    """What a little more or less speed of the base makes of a largest value."""
    return max((abs(one.largest(what)[0] - value) for one in fine.nudged if one is not None), default=0.0)


def blow_loads(fine: Played, coarse: Played) -> dict[str, Found]:
    deflection = _deflection(fine, coarse)
    found = {
        "collision_force": _times(deflection, fine.moves.column.stiffness),
        "collision_deflection": deflection,
        "mast_moment_max": _moment(fine, coarse),
    }
    obstacle = fine.moves.obstacle
    assert obstacle is not None
    value, time = fine.course.top("contact")
    if math.isinf(obstacle.stiffness):
        note = "the impact on a rigid obstacle has a finite impulse only, no finite force"
        found["contact_force"] = Found(Estimate.unknown(math.inf), {"time": 0.0}, note)
    elif obstacle.damping:
        note = (
            "a dashpot force at first contact is proportional to the speed: the maximum force is specific to this model"
        )
        found["contact_force"] = Found(Estimate.unknown(value), {"time": time}, note)
    else:
        found["contact_force"] = Found(_bar(value, coarse.course.top("contact")[0]), {"time": time})
    return found


def settling(spec: Stacker, scene: StackerScene, fine: Played, coarse: Played) -> dict[str, Found]:
    """From the standstill of the base until the far end stays in the window."""
    window = spec.settling.window
    if window is None or spec.column.log_decrement is None or not isinstance(scene, Brake):
        return {}
    if not fine.course.stays:
        return {"settling_time": Found(Estimate.unknown(math.inf), note="the base is not yet held permanently")}
    apart = abs(fine.course.largest("deflection")[0] - coarse.course.largest("deflection")[0])
    found = at_rest(spec, scene, fine.course, window, min(_MARGIN * apart, window))
    late = _drift(fine, coarse, window, found.time)
    if late:
        found = at_rest(spec, scene, fine.course, window, min(_MARGIN * apart + late, window))
    if math.isinf(found.time):
        return {"settling_time": Found(Estimate.exact(math.inf), note=found.reason)}
    bar = found.high - found.time
    low = min(found.low, found.time)
    numerical = max(bar, found.time - low) if math.isfinite(bar) else found.time - low
    return {"settling_time": Found(Estimate(found.time, low, found.high, numerical=numerical))}


def _drift(fine: Played, coarse: Played, window: float, time: float) -> float:
    """What the phase of the lowest mode may be wrong by until a time, as a deflection at the size of the window [m]."""
    if not math.isfinite(time):
        return 0.0
    values = (one.course.case.mast.frequencies[0] for one in (fine, coarse))
    first, second = values
    return window * abs(float(first - second)) * time
