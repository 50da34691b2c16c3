"""Runs of the whole belt in cells on three grids, each until its scene is over."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.result import Found, family
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.machine.loads import OF_STOP, SLIPS
from ptmcalc.machines.conveyor.machine.motion import Moving
from ptmcalc.machines.conveyor.machine.scenes import ConveyorScene, Jam, Start
from ptmcalc.machines.conveyor.waves import cell_bars
from ptmcalc.machines.conveyor.waves.cell_loads import OneGrid, Values, loads_of
from ptmcalc.machines.conveyor.waves.cells import Set, rubber_of, set_up
from ptmcalc.machines.conveyor.waves.last_motions import Kept
from ptmcalc.machines.conveyor.waves.unfinished_stop import time_to_rest, unfinished
from ptmcalc.numerics.belt.march import Drawn, Until, march
from ptmcalc.numerics.belt.station import Seen

_CELLS, _CELLS_OF_JUMP = 60, 240
"""Cells of the whole belt on the coarsest of three grids at the first level; numerical choices. `_CELLS_OF_JUMP`: for a
pulley that stops at once, whose window is short and whose fronts are steps. `_CELLS`: for any other scene. Time grows
with the square; the error bar falls with the order 0.6 or more."""
_LONGEST = 8.0
"""Windows of a start in which a slipping pulley may stick again [1]. A numerical choice: the run ends as soon as no
pulley slips. A larger value follows longer slip and takes longer."""
_MORE = 1.25
"""Minimum growth of a window that was too short [1]. A numerical choice: a larger value takes fewer but longer runs."""
_CONTOURS_AT_REST = 3.0
"""Contour times after the predicted standstill [1]: the run ends two after it, and the prediction is a mean over one. A
larger value takes longer; a smaller one repeats more runs."""
_MOST_SECONDS = 0.5
"""Predicted seconds of the finest grid up to which a window is made longer; a numerical choice. A larger value follows
longer stops and takes longer; a smaller one leaves more loads without an error bar."""
_SECONDS = {"straight": (3e-6, 5e-9), "giving": (3e-6, 3.7e-8)}
"""Predicted seconds per step, and per step and cell, without and with sag or damping: medians of 1800 runs of 124
random conveyors, evaluation of the loads included. Wrong values change the order of the solvers and the length of
windows."""
_PER_RUN = 2e-3
"""Predicted seconds of a run in addition to its steps; measured with `_SECONDS`."""


def grids_of(scene: ConveyorScene, level: int) -> tuple[int, int, int]:
    """Cells of the three grids; a jam is short, and its steps ask for more."""
    coarsest = (_CELLS_OF_JUMP if _jumps(scene) else _CELLS) << level
    return coarsest, 2 * coarsest, 4 * coarsest


def _jumps(scene: ConveyorScene) -> bool:
    """Whether a drum stops from one moment to the next."""
    return isinstance(scene, Jam) and not scene.time


class GripLostError(Exception):
    """A drum slips under a belt that presses on it no more: friction has no meaning there."""

    def __init__(self, time: float) -> None:
        super().__init__(time)
        self.time = time


@dataclass(frozen=True, slots=True)
class CellRun:
    """A march on one grid: its loads, what the belt did, and how many cells that took."""

    loads: OneGrid
    drawn: Drawn
    ready: Set
    work: int

    @property
    def values(self) -> Values:
        return self.loads.values


_KEPT = Kept[tuple[Drawn, Set, int]](lambda made: len(made[0].times))


def _causes(case: Moving) -> tuple[object, ...]:
    """All that the motion of a belt depends on."""
    spec, line = case.spec, replace(case.line, breaking_force=None, slack_sag=0.0)
    parts = spec.all_drives, spec.brakes, spec.backstop, spec.takeup_weight, spec.tail_drum, spec.belt.damping
    return line, case.scene, case.speed, case.window, *parts


def grid_loads(
    case: Moving, carried: frozenset[str], level: int, whole: bool = True
) -> tuple[dict[str, Found], list[CellRun]]:
    """Loads from three grids with their bars, and what the belt did on each."""
    grids = grids_of(case.scene, level)
    runs: list[CellRun] = []
    for cells in grids:
        runs.append(marched(case, carried, cells, whole, grids[-1]))
        if whole and unfinished(case, runs[-1].drawn):  # all three up to the time known of this one
            case = replace(case, window=float(runs[-1].drawn.times[-1]))
            runs = [marched(case, carried, one, False, grids[-1]) for one in grids]
            break
    coarsest, coarse, fine = runs
    front = cell_bars.front_at(fine.drawn) if _jumps(case.scene) else 0.0
    rest = cell_bars.rest_of(fine.drawn) if case.brings_to_rest else cell_bars.CERTAIN
    bars = cell_bars.bars(case, (coarsest.loads, coarse.loads, fine.loads), front, rest)
    found = {name: Found(_estimate(name, value, bars[name]), place) for name, (value, place) in fine.values.items()}
    return found, runs


def marched(case: Moving, carried: frozenset[str], cells: int, whole: bool, most: int) -> CellRun:
    """The march on one grid, made now or kept from before; the finest grid of its kind has `most` cells."""
    causes = cells, carried, whole, *_causes(case)
    drawn, ready, work = _KEPT.of(causes, lambda: _once(case, carried, cells, whole, most))
    return CellRun(loads_of(case, drawn, ready), drawn, ready, work)


def _once(case: Moving, carried: frozenset[str], cells: int, whole: bool, most: int) -> tuple[Drawn, Set, int]:
    """A march on one grid; of the `whole` scene until a belt that comes to rest has done so, whatever slips, until it
    is known that it never does, or until the finest grid would take more work than a scene may cost."""
    work = 0
    starts = isinstance(case.scene, Start) and case.imposed is None and "slip" in carried
    usual = case.window
    if starts and whole:
        case = replace(case, window=_LONGEST * usual)  # ends when no drum slips any more
    while True:
        ready = set_up(case, carried, cells)
        parts = ready.course, ready.head, ready.tail, ready.tension
        until = _until(case, usual if starts and whole else math.inf)
        drawn = march(*parts, case.speed, case.window, until, ready.give, ready.travel)
        if drawn.lost_grip:
            raise GripLostError(float(drawn.times[-1]))
        work += drawn.updates
        if not whole or not unfinished(case, drawn):
            return drawn, ready, work
        left = time_to_rest(case, drawn)
        longer = max(_MORE * case.window, case.window + left + _CONTOURS_AT_REST * case.line.contour_time)
        if math.isinf(longer) or predicted_seconds(longer, case, carried, most) > _MOST_SECONDS:
            return drawn, ready, work
        case = replace(case, window=longer)


def _until(case: Moving, grips_from: float) -> Until:
    """What ends a march: rest, at a time after the first pulley at the head came to rest; of a start its usual window
    [s], once no pulley at the head slips; a slipping pulley at the head that the belt pushes harder than it ever pulled
    while it ran evenly, since grip below 0 would drive it, faster and faster."""
    lowest = -max(map(abs, (*case.line.static_ends(RETURN), *case.line.static_ends(CARRY))))
    rests_for = 2 * case.line.contour_time if case.brings_to_rest and math.isinf(grips_from) else math.inf
    return Until(rests_for, grips_from, lowest)


def slips_on(case: Moving, drawn: Drawn) -> bool:
    """Whether a start ends with a drum that slips."""
    return isinstance(case.scene, Start) and _slides(drawn.head[-1])


def _slides(seen: Seen) -> bool:
    """Whether a drum turns at another speed than the belt; one that gives all its grip at the belt's speed does not."""
    return any(sense and drum != seen.belt for sense, drum in zip(seen.slips, seen.drums, strict=True))


def _estimate(name: str, value: float, sides: Interval) -> Estimate:
    least = 0.0 if family(name) in SLIPS | OF_STOP else -math.inf
    bar = max(-sides.low, sides.high)
    if not math.isfinite(value):
        return Estimate.exact(value) if math.isfinite(bar) else Estimate(value, least, math.inf, numerical=math.inf)
    return Estimate(value, max(value + sides.low, least), value + sides.high, numerical=bar)


def spent_seconds(case: Moving, carried: frozenset[str], runs: Sequence[CellRun]) -> float:
    """Seconds that the steps of these marches come to, those of windows that were too short included."""
    per_step, per_cell = _rates(case, carried)
    return sum(_PER_RUN + run.work * (per_cell + per_step / run.ready.course.cells) for run in runs)


def _rates(case: Moving, carried: frozenset[str]) -> tuple[float, float]:
    gives = "sag" in carried or ("belt_damping" in carried and case.spec.belt.damping is not None)
    return _SECONDS["giving" if gives else "straight"]


def predicted_seconds(window: float, case: Moving, carried: frozenset[str], cells: int) -> float:
    """Seconds predicted of a march on one grid."""
    per_step, per_cell = _rates(case, carried)
    rubber = rubber_of(case, cells) if "belt_damping" in carried else None
    steps = window / case.line.contour_time * cells * math.sqrt(1 + (rubber.stiffer if rubber else 0.0))
    return _PER_RUN + steps * (per_step + cells * per_cell)
