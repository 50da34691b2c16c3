"""A scene of a hoist on a rope with mass or of changing length, played through, and the loads read from it."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Event, Failure, Finding, Found, History, Result
from ptmcalc.machines.hoist.machine.spec import Hoist, Lift, Release
from ptmcalc.machines.hoist.motion import rope_case, scene_failures
from ptmcalc.machines.hoist.motion import scene as motion
from ptmcalc.machines.hoist.motion.reduced import travel
from ptmcalc.machines.hoist.motion.train import Case, Moving
from ptmcalc.numerics.rope import rule
from ptmcalc.numerics.rope.equations import ZD, Hauled, Rod, U, W, Z
from ptmcalc.numerics.rope.march import March, Panel, Played, energy
from ptmcalc.numerics.rope.parts import Haul
from ptmcalc.numerics.rope.rule import FloatArray

FINENESS = (1.0,)
"""Number of time steps by level, relative to the usual one [1]. A numerical choice: there is one level. A larger value
narrows the error bar and takes longer."""
_COMPARED = 1.37
"""Number of time steps of the second run relative to the first [1]. A numerical choice: their difference gives the
error bar. A value near 1 compares runs whose errors agree; a larger one takes longer."""
_UNSEEN = 1e-10
"""Error of a reading between the nodes, relative to the largest value [1]. A numerical choice: a larger value widens
the error bars."""
_CLOSES, _NOTHING = 1e-9, 1e-6
"""Numerical choices [1]. `_CLOSES`: residual of the energy balance above which NUM101 is reported; a larger value
accepts wrong runs. `_NOTHING`: rope force below 0, relative to the weight, that counts as rounding; a larger value
ignores short slack, a smaller one reports rounding as slack (NUM104)."""
_LONGER = 4
"""Doublings of the window in which a brake may bring the drive to rest; a numerical choice. The last window is 16 times
the first. More follow late stops and take longer."""
_SECONDS = 8e-4
"""Predicted seconds per panel; rate of a measurement of which no record is kept. A wrong value changes the order of the
solvers, no load."""
_EVENTS = 12
"""Corners that travel along a rope with mass, in a prediction. A numerical choice: a larger number predicts a longer
run."""
_LEAST_PANELS, _MOST_TIMES = 200, 5.0
"""Limit of the work of a run; numerical choices. `_LEAST_PANELS`: panels that any run may take. `_MOST_TIMES`: panels
beyond, relative to those predicted [1]. Larger values allow long runs; smaller ones refuse runs that the prediction
underestimates."""


@dataclass(frozen=True, slots=True)
class Course:
    """One run."""

    haul: Haul
    rope: Rod | Hauled
    arm: float
    """way of the hook for a radian of the drum [m]"""
    played: Played
    residual: float

    def first(self, event: str) -> float:
        """When something first happened; infinite where it never did [s]."""
        return next((time for time, what in self.played.events if what == event), math.inf)

    def top(self, values: np.ndarray) -> tuple[float, float]:
        """Largest value of a signal of all panels and its time."""
        value, panel, place = rule.largest(values)
        one = self.played.panels[panel]
        return value, one.start + place * one.length

    def bottom(self, values: np.ndarray) -> tuple[float, float]:
        """Smallest value of a signal of all panels and its time."""
        value, time = self.top(-values)
        return -value, time

    def largest(self, values: np.ndarray) -> tuple[float, float]:
        """Largest magnitude and its time."""
        return max(self.top(values), self.top(-values))


def play(
    spec: Hoist, scene: Moving, rope: Rod | Hauled, window: float, finer: float, coarser: Case | None = None
) -> Course:
    """One run over a window."""
    haul = rope_case.haul(spec, scene, coarser)
    march = March(haul, rope, finer)
    played = march.play(window, _LEAST_PANELS + _MOST_TIMES * _panels(march, window))
    if not played.panels:
        raise NumericsError(
            "NUM102", f"the motion of drive and rope ends where it begins; its window is {window:.3g} s"
        )
    left, scale = energy(march, played)
    return Course(haul, rope, travel(spec, scene), played, left / scale)


# -- what is read ---------------------------------------------------------------------------------------------------


def _rope_forces(course: Course) -> Iterator[tuple[tuple[float, float], tuple[float, float]]]:
    """(smallest, largest) force with their times, at both ends and inside the rope.

    Inside it F = f + g of waves that left the ends at times no further apart than two transits: an extreme there is
    one of either by itself.
    """
    played = course.played
    for what in ("top", "bottom"):
        values = played.stack(what)
        yield course.bottom(values), course.top(values)
    if isinstance(course.rope, Rod):
        for sign in (1, -1):
            inside = _inside(played.panels, course.rope.transit, sign)
            if inside is not None:
                yield (inside, inside)


def _inside(panels: list[Panel], transit: float, sign: int) -> tuple[float, float] | None:
    """Largest (sign 1) or smallest sum of an extreme of either wave that meet inside the rope, and the time."""
    (down, leaving), (up, gone) = (_turns(panels, what, sign) for what in ("down", "up"))
    first = np.searchsorted(gone, leaving - transit, "right")
    last = np.searchsorted(gone, leaving + transit, "left")
    best: tuple[float, float] | None = None
    for value, time, low, high in zip(down, leaving, first, last, strict=True):
        if low >= high:
            continue
        place = int(low) + int(up[low:high].argmax())
        total = sign * float(value + up[place])
        if best is None or sign * total > sign * best[0]:
            best = total, float(time + gone[place] + transit) / 2
    return best


def _turns(panels: list[Panel], what: str, sign: int) -> tuple[FloatArray, FloatArray]:
    """Local extremes of a wave times the sign, in panels and at their ends, and their times."""
    values = sign * np.array([getattr(panel, what) for panel in panels]) @ rule.DENSE.T
    starts, lengths = (np.array([getattr(panel, one) for panel in panels]) for one in ("start", "length"))
    times = (starts[:, None] + lengths[:, None] * rule.PLACES).ravel()
    flat = values.ravel()
    before, after = np.append(-np.inf, flat[:-1]), np.append(flat[1:], -np.inf)
    places = np.flatnonzero((flat >= before) & (flat >= after))
    return flat[places], times[places]


def readings(scene: Moving, case: Case, course: Course) -> motion.Readings:
    """The loads of a run."""
    played, haul = course.played, course.haul
    lows, highs = zip(*_rope_forces(course), strict=True)
    found: motion.Readings = {"rope_force_max": max(highs)}
    at_top = played.stack("top")
    if haul.structure is not None and haul.structure.mass > 0:
        states = played.stack("states")
        on_it = haul.structure.stiffness * states[:, :, Z] + haul.structure.damping * states[:, :, ZD]
    else:
        on_it = at_top
    found["bridge_force_max"] = course.top(on_it)
    if isinstance(scene, Lift):
        lifted = course.first("lift")
        if not math.isfinite(lifted) or case.weak:
            found |= {
                "lift_off_speed": (0.0, None),
                "lift_off_time": (math.inf, None),
                "tension_time": (math.inf, None),
            }
        else:
            taut = course.first("taut")
            panel = next(one for one in played.panels if one.start + one.length >= lifted * (1 - 1e-12))
            found |= {
                "lift_off_speed": (float(panel.states[-1, W]), lifted),
                "lift_off_time": (lifted, None),
                "tension_time": (lifted - (taut if taut <= lifted else 0.0), None),
            }
    else:
        found["rope_force_min"] = min(lows)
        found["bridge_force_min"] = course.bottom(on_it)
    peak, time = course.largest(played.stack("gear"))
    found |= {
        "backlash_torque_peak": (peak * course.arm, time),
        "gear_impact_factor": (peak * course.arm / case.even_torque, time),
    }
    if case.stops:
        at_rest = played.mode.turn == 0 and played.rests
        heights = played.stack("states")[:, :, U]
        edge = course.bottom(heights) if case.lowers else course.top(heights)
        found["stop_time"] = (played.rests[0], None) if at_rest else (math.inf, None)
        name = "stop_distance_lowering" if case.lowers else "stop_distance"
        found[name] = (abs(edge[0]), edge[1]) if at_rest else (math.inf, None)
    return found


def _slack_at(course: Course) -> float:
    """When a rope with mass first carries less than nothing, at an end or inside; infinite where it never does [s]."""
    if not isinstance(course.rope, Rod) or math.isfinite(course.played.slack_at):
        return course.played.slack_at
    least, time = min(low for low, _ in _rope_forces(course))
    return time if least < -_NOTHING * course.haul.weight else math.inf


# -- a whole solver run ---------------------------------------------------------------------------------------------


def _until_settled(spec: Hoist, scene: Moving, rope: Rod | Hauled, case: Case, finer: float) -> tuple[Course, float]:
    """A run until the brake holds or the load has lifted off, and its window [s]."""
    window = case.window
    course = play(spec, scene, rope, window, finer)
    for _ in range(_LONGER if case.holds else 0):
        if course.played.mode.turn == 0 or math.isfinite(course.played.slack_at):
            break
        window *= 2
        course = play(spec, scene, rope, window, finer)
    while isinstance(scene, Lift) and not math.isfinite(course.played.slack_at):
        longer = motion.until_lifted(replace(case, window=window), course.first("lift"))
        if not longer or math.isfinite(course.first("trip")):
            break
        window = longer
        course = play(spec, scene, rope, window, finer)
    return course, window


def result(spec: Hoist, scene: Moving, rope: Rod | Hauled, level: int) -> Result:
    """Loads, findings and histories of a scene."""
    case, finer = rope_case.case(spec, scene), FINENESS[level]
    course, window = _until_settled(spec, scene, rope, case, finer)
    case = replace(case, window=window)
    other = play(spec, scene, rope, window, _COMPARED * finer)
    own, beside = readings(scene, case, course), readings(scene, case, other)
    chords = None
    if case.coarser:
        chords = readings(scene, case.coarser, play(spec, scene, rope, window, finer, case.coarser))
    found = motion.with_bars(scene, case, own, [beside], chords, _UNSEEN)
    if isinstance(scene, Lift) and not case.weak and not math.isfinite(course.first("lift")):
        # a strong drive that has not lifted yet: what a longer look would show is not known
        forces = {name for name, one in found.items() if math.isfinite(one.estimate.value)}
        found |= {name: Found(Estimate.unknown(found[name].estimate.value), found[name].at) for name in forces}
    findings, remarks = [], _remarks(scene, case, course)
    slack, residual = _slack_at(course), max(course.residual, other.residual)
    if math.isfinite(slack):
        findings.append(
            Finding(
                "NUM104",
                f"scene `{scene.label}`: the rope goes slack at {slack:.4g} s; a slack rope with mass is not simulated",
            )
        )
    if residual > _CLOSES:
        findings.append(
            Finding(
                "NUM101",
                f"scene `{scene.label}`: the energy balance has a residual of {residual:.1e},"
                f" more than {_CLOSES:.0e}; the"
                " numbers are not reliable",
            )
        )
    if findings:
        found = {name: Found(Estimate.unknown(one.estimate.value), one.at) for name, one in found.items()}
    if math.isfinite(slack) and residual <= _CLOSES and not isinstance(scene, Lift):  # so much is sure: nothing pulls
        none = Found(Estimate.exact(0.0), {"time": slack})
        found |= {"rope_force_min": none, "rope_force_share": none}
    if isinstance(rope, Rod):
        found["natural_frequency"] = Found(rope_case.frequency(spec, scene))
    found["energy_residual"] = Found(Estimate.exact(course.residual))
    return Result(
        found,
        work=len(course.played.panels) + len(other.played.panels),
        window=(0.0, course.played.time),
        health={"energy_residual": course.residual, "steps": float(len(course.played.panels))},
        findings=(*remarks, *findings),
        failures=tuple(_failures(scene, case, course, own)),
        events=tuple(Event(time, "drive and load", "", what) for time, what in course.played.events),
        histories=lambda: histories(course),
    )


def _remarks(scene: Moving, case: Case, course: Course) -> list[Finding]:
    """What happened on the way that a reader must know."""
    said = []
    if isinstance(scene, Lift) and not math.isfinite(course.first("lift")):
        said += scene_failures.not_seen(scene, case)
    tripped = course.first("trip")
    if math.isfinite(tripped):
        said.append(scene_failures.tripped(scene, tripped))
    return said


def _failures(scene: Moving, case: Case, course: Course, own: motion.Readings) -> list[Failure]:
    """What the run found to fail, as far as the rope stays taut."""
    slack = course.played.slack_at
    if isinstance(scene, Release):
        return scene_failures.gone_slack(slack) if scene.manner == "quick" else []
    if math.isfinite(slack):
        return []
    if isinstance(scene, Lift):
        lifted = math.isfinite(course.first("lift"))
        if math.isfinite(course.first("trip")) and not lifted:
            return scene_failures.tripped_early(scene)
        return scene_failures.stalls(case, lifted, own["rope_force_max"])
    return scene_failures.not_held(case) if case.stops and not math.isfinite(own["stop_time"][0]) else []


def histories(course: Course) -> Mapping[str, History]:
    """Forces over time."""
    played = course.played
    times = np.maximum.accumulate(np.concatenate([one.start + one.length * rule.NODES for one in played.panels]))
    signals = {"rope_force_max": played.stack("bottom"), "bridge_force_max": played.stack("top")}
    return {name: History(units.FORCE, times.tolist(), values.ravel().tolist()) for name, values in signals.items()}


def cost(spec: Hoist, scene: Moving, rope: Rod | Hauled, level: int) -> float:
    """Seconds predicted: the panels of two runs, each as long as approximation or the corners of a rod allow, which go
    to and fro for ever, those of the drive's own course from both ends."""
    march = March(rope_case.haul(spec, scene), rope, FINENESS[level])
    return 1e-3 + _SECONDS * _panels(march, rope_case.case(spec, scene).window) * (1 + _COMPARED)


def _panels(march: March, window: float) -> float:
    """Panels predicted of one run."""
    corners = _EVENTS + 2 * len(march.haul.breaks) if isinstance(march.rope, Rod) else 1
    return window / march.longest * corners
