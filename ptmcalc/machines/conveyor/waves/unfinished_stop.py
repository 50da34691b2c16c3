"""A stop whose belt still runs at the end of the simulated window: the time left, and what is known."""

import math
from collections.abc import Iterator, Mapping, Sequence

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Failure, Found
from ptmcalc.machines.conveyor.machine.brakes import brakes_of, braking
from ptmcalc.machines.conveyor.machine.drives import moving_mass
from ptmcalc.machines.conveyor.machine.loads import ways_of
from ptmcalc.machines.conveyor.machine.motion import Moving
from ptmcalc.machines.conveyor.waves import deep_sag
from ptmcalc.machines.conveyor.waves.cells import Set
from ptmcalc.numerics.belt.march import Drawn

_HOUR = 3600.0
"""Time in which a belt must come to standstill to count as stopped [s], as in the check of the stopping time; an
engineering choice. A smaller value reports slow stops as endless."""


def unfinished(case: Moving, drawn: Drawn) -> bool:
    """Whether the belt of a stop that comes to an end as a rigid body still runs at the end of a march."""
    rests = case.brings_to_rest and math.isfinite(case.rigid_time)
    return rests and not (drawn.head.belt <= 0).any()


def _mean_speed(case: Moving, drawn: Drawn, until: float = 1.0) -> float:
    """Mean speed of the belt at the head over a contour time that ends at a part of the window [m/s]: waves that go
    round have that period."""
    belt = drawn.head.belt
    end = max(round(until * len(belt)), 1)
    many = max(round(case.line.contour_time / float(drawn.times[1])), 1)
    return float(belt[max(end - many, 0) : end].mean())


def time_to_rest(case: Moving, drawn: Drawn) -> float:
    """Time that a belt which still runs at the end of a march takes to come to rest [s]; infinite where it never does.

        t = M v/(W + T_2 (1 - exp(-mu alpha)) + B_tail)     a pulley that slips, T_2 kept by the take-up
        t = v_2 (t_2 - t_1)/(v_1 - v_2)                      otherwise, by the means in mid-window and at its end

    **Range** a stop whose brakes act fully: what is left is a constant force.
    **Error** that of the mean speeds; centrifugal tension at the present speed.
    **Source** Newton's law for the whole belt; Euler-Eytelwein.
    """
    speed = _mean_speed(case, drawn)
    force = _force_of_grip(case, drawn, speed)
    if force is not None:
        mass = moving_mass(case.line) - case.line.drive_mass  # the braked pulley stands
        return mass * speed / force if force > 0 else math.inf
    slows = _mean_speed(case, drawn, 0.5) - speed
    return speed * float(drawn.times[-1]) / 2 / slows if slows > 0 else math.inf


def _force_of_grip(case: Moving, drawn: Drawn, speed: float) -> float | None:
    """Force that slows a belt down which slips on the only pulley at the head [N]; None where that is not known."""
    line, slips = case.line, drawn.head[-1].slips
    if not line.keeps_run_off or line.grip_exponent is None or len(slips) != 1 or not slips[0]:
        return None
    tight = line.takeup_tension - line.belt_line_mass * speed**2
    acting = brakes_of(case.spec, case.scene).values()
    at_tail = sum(braking(case.spec, brake).force for brake in acting if brake.at == "tail")
    return line.static_resistance + line.tail_pull - tight * math.expm1(-line.grip_exponent) + at_tail


def _never_rests(case: Moving, drawn: Drawn) -> bool:
    """Whether a belt slips on its braked pulley until an hour is over: grip does not exceed the pull of the load."""
    force = _force_of_grip(case, drawn, _mean_speed(case, drawn))
    return force is not None and time_to_rest(case, drawn) > _HOUR


def loads_so_far(case: Moving, loads: Mapping[str, Found], grids: Sequence[Drawn]) -> dict[str, Found]:
    """Loads of a stop that is simulated up to a time at which the belt still runs: at least as bad as by then."""
    drawn = grids[-1]
    window = float(drawn.times[-1])
    found = deep_sag.certain(case, loads, loads, window)
    least = min(_way_so_far(one) for one in grids)
    left = math.inf if _never_rests(case, drawn) else time_to_rest(case, drawn)
    rest = {"stop_time": (window, window + left)} | dict.fromkeys(
        ways_of(case.scene), (least, least + _mean_speed(case, drawn) * left / 2)
    )
    for name, (low, value) in rest.items():
        endless = Estimate.exact(math.inf)
        found[name] = Found(endless if math.isinf(left) else Estimate(value, low, math.inf, numerical=math.inf))
    return found


def _way_so_far(drawn: Drawn) -> float:
    """Distance of the belt at the head in the window [m]."""
    belt = drawn.head.belt
    return float((belt[1:] + belt[:-1]).sum()) / 2 * float(drawn.times[1])


def open_end(case: Moving, drawn: Drawn) -> str:
    """How a stop stands whose window ends before its motion does."""
    if not unfinished(case, drawn):
        return ""
    how = ", a pulley slips" if any(drawn.head[-1].slips) else ""
    return f"belt at {drawn.head[-1].belt:.3g} of {case.line.speed:.3g} m/s{how}"


def failures_of(case: Moving, drawn: Drawn, ready: Set) -> Iterator[Failure]:
    """A stop that never comes to an end: the grip of the braked pulley does not exceed the pull of the load."""
    if not unfinished(case, drawn) or not _never_rests(case, drawn):
        return
    belt, time = drawn.head[-1].belt, float(drawn.times[-1])
    (drum,) = ready.head.drums
    reason = f"the belt slips on the braked pulley `{drum.name}` and does not stop: {belt:.3g} m/s after {time:.3g} s"
    for code in ("CNV101", "CNV106", "CNV107"):
        yield Failure(
            code, reason, ("takeup", "tension"), "increase the take-up tension, or add a brake on a second pulley"
        )
