"""Figures of a scene: courses of loads as its kind declares them, with what is told of them."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import TypeGuard

import numpy as np

from ptmcalc.contract.figure import Course, Curve, Figure, FigureReport, Marks, Moment, Spot, Threshold, Told
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.report import LoadReport, SceneReport
from ptmcalc.contract.result import History, family
from ptmcalc.contract.solver import Fidelity
from ptmcalc.spec.machine import MachineSpec

_CELLS = 240
"""Intervals of a history in a figure, each with its ends, maximum and minimum. A numerical choice: more are not visible
and enlarge the file; fewer draw coarse curves."""
_ALIKE = 8.0
"""Largest ratio of two curves on the same axes [1]. An engineering choice: a larger value draws small curves that are
not visible; a smaller one makes more figures."""
_NEAR = 0.05
"""Difference of a load from the magnitude of the lowest value of its history, relative to the load [1]. Up to it the
load is marked there with the other sign. An engineering choice. A larger value marks loads that belong to no point of
the history; a smaller one omits extremes between samples."""
_SAME = 1e-3
"""Relative difference of the extreme of a history from a load [1] up to which it is marked there. A numerical choice,
as solvers find extremes between samples. A larger value may mark the wrong point; a smaller one omits marks."""
_OF_PLACE: Mapping[str, tuple[str, ...]] = {"time": ("time",), "distance": ("position", "place")}
"""Where a load says at which value of an axis it occurs."""


def figures_of(
    kind: AnyKind,
    scene: SceneReport,
    spec: MachineSpec,
    histories: Mapping[str, History],
    textbooks: Mapping[str, Mapping[str, History]],
) -> Iterator[FigureReport]:
    """The figures that a kind declares for a type of scene, in its order; loads of another quantity beside them.

    `histories` are the courses of loads, `textbooks` those that textbooks' solvers have of them, by solver.
    """
    for figure in kind.figures:
        if scene.type in figure.scenes:
            yield from _of_figure(figure, scene, spec, histories, textbooks)


def _of_figure(
    figure: Figure,
    scene: SceneReport,
    spec: MachineSpec,
    histories: Mapping[str, History],
    textbooks: Mapping[str, Mapping[str, History]],
) -> Iterator[FigureReport]:
    groups: list[list[Curve]] = []
    for course in figure.courses:
        for load in _with_course(scene, course.load, [histories, *textbooks.values()]):
            name = load.info.name
            element = name.partition("[")[2].removesuffix("]")
            title = ", ".join(filter(None, (course.title, element))) if course.title else load.info.title
            if _fits(own := histories.get(name), figure):
                _join(groups, Curve(title, thinned(own), tuple(_told(scene, course, load, own))))
            for solver, known in textbooks.items():
                if _fits(history := known.get(name), figure):
                    told = () if own else tuple(_told(scene, course, load, history))
                    _join(groups, Curve(f"{title}, textbook: {solver}", thinned(history), told))
    words = figure.name, figure.title, figure.upright, figure.across
    if not groups:
        yield FigureReport(*words, missing=_why(figure, scene))
        return
    for number, found in enumerate(groups):
        marks = figure.marks(spec, scene) if figure.marks is not None and not number else Marks()
        title = f"{figure.title}: {_about(found)}" if len(groups) > 1 else figure.title
        marks = _with_loads(marks, figure, scene, found)
        yield FigureReport(figure.name, title, figure.upright, figure.across, tuple(found), marks)


def _about(curves: Sequence[Curve]) -> str:
    """What the curves of one of several pictures are of: parts of the machine, else a quantity."""
    names = [told.load for curve in curves for told in curve.told[:1]]
    elements = [name.partition("[")[2].removesuffix("]") for name in names if "[" in name]
    return ", ".join(dict.fromkeys(elements)) or curves[0].history.quantity.name


def _fits(history: History | None, figure: Figure) -> TypeGuard[History]:
    """Whether there is a course, over what the figure draws."""
    return history is not None and len(history.times) > 1 and history.over == figure.over


def _join(groups: list[list[Curve]], new: Curve) -> None:
    """One more curve, beside those of its quantity and of about its size; of the same course as another one only what
    is told of it."""
    for curves in groups:
        for index, known in enumerate(curves):
            if known.history == new.history:
                curves[index] = replace(known, told=(*known.told, *new.told))
                return
    size = _size(new)
    for curves in groups:
        sizes = [_size(curve) for curve in curves]
        alike = curves[0].history.quantity == new.history.quantity
        if alike and max(*sizes, size) <= _ALIKE * max(min(*sizes, size), 0.0):
            curves.append(new)
            return
    groups.append([new])


def _size(curve: Curve) -> float:
    return max((abs(value) for value in curve.history.values), default=0.0)


def _with_course(scene: SceneReport, name: str, known: Sequence[Mapping[str, History]]) -> Iterator[LoadReport]:
    """The load of that name; where it has no course those of its parts, which may have."""
    own = [load for load in scene.loads if load.info.name == name]
    has = any(name in courses for courses in known)
    yield from own if has else (load for load in scene.loads if family(load.info.name) == name)


def _members(scene: SceneReport, name: str) -> Iterator[LoadReport]:
    """The load of that name; without one those of its family."""
    own = [load for load in scene.loads if load.info.name == name]
    yield from own or (load for load in scene.loads if family(load.info.name) == name)


def _told(scene: SceneReport, course: Course, load: LoadReport, history: History) -> Iterator[Told]:
    """What is known of a course: its load, and others of the same one."""
    levels = {one.name: one.fidelity for one in scene.solvers}
    beside = [one for name in course.also for one in _members(scene, name)]
    for one in (load, *beside):
        level = levels.get(one.solver, Fidelity.FORMULA.value)
        info = one.info
        found = Told(info.name, info.title, info.quantity, one.estimate, one.solver, level, one.source, dict(one.at))
        yield replace(found, mirrored=_mirrored(one.estimate.value, history))


def _mirrored(value: float, history: History) -> bool:
    """Whether a load is the size of the lowest value of its course."""
    lowest, highest = min(history.values), max(history.values)
    off = min(abs(value - lowest), abs(value - highest))
    return value > 0 > lowest and abs(value + lowest) < min(off, _NEAR * value)


def _why(figure: Figure, scene: SceneReport) -> str:
    """Why there is nothing to draw."""
    found = [load for course in figure.courses for load in _members(scene, course.load)]
    if not found:
        return "None of the loads of this figure was computed in this scene."
    levels = {one.name: one.fidelity for one in scene.solvers}
    by = dict.fromkeys((load.solver, levels.get(load.solver, "")) for load in found)
    solvers = ", ".join(f"{name} ({level})" if level else name for name, level in by)
    return f"The values exist, their curve does not: {solvers} computed them without a curve over {figure.across}."


def _with_loads(marks: Marks, figure: Figure, scene: SceneReport, curves: Sequence[Curve]) -> Marks:
    """What is drawn besides: what the kind says, where the told loads occur, what checks hold them against, when what
    happens."""
    told = [(curve, one) for curve in curves for one in curve.told if one.quantity.si == curve.history.quantity.si]
    spots = [spot for curve, one in told if (spot := _spot(figure, curve, one)) is not None]
    loads = {load.info.name: load.estimate.value for load in scene.loads}
    moments = [Moment(loads[name], title) for name, title in figure.moments if math.isfinite(loads.get(name, math.nan))]
    return Marks(
        marks.bands,
        (*marks.thresholds, *_limits(scene, [one for _, one in told], len(curves) > 1)),
        (*marks.moments, *moments),
        (*marks.spots, *spots),
    )


def _spot(figure: Figure, curve: Curve, told: Told) -> Spot | None:
    """Where a load occurs: as it says itself, else where its course has that value at an end."""
    value = told.value
    if not math.isfinite(value):
        return None
    names = _OF_PLACE.get(figure.over.name, (figure.over.name,))
    at = next((told.at[name] for name in names if name in told.at), None)
    if at is not None:
        return Spot(at, value, told.title)
    values = np.asarray(curve.history.values, float)
    for index in (int(np.nanargmax(values)), int(np.nanargmin(values))):
        if math.isclose(values[index], value, rel_tol=_SAME):
            return Spot(float(curve.history.times[index]), value, told.title)
    return None


def _limits(scene: SceneReport, told: Iterable[Told], several: bool) -> Iterator[Threshold]:
    """What checks hold these very loads against, once each; with the load where there are several curves."""
    names = {one.load: one for one in told}
    limits: dict[tuple[float, str], list[str]] = {}
    for check in scene.checks:
        for name in (name for name in check.loads if name in names):
            held, limit = check.value, check.limit
            if held is not None and limit is not None and held == names[name].estimate and math.isfinite(limit.value):
                of_load = f" ({names[name].title})" if several else ""
                side = -limit.value if names[name].mirrored else limit.value
                limits.setdefault((side, of_load), []).append(check.code)
    for (value, of_load), codes in limits.items():
        yield Threshold(value, f"limit of {', '.join(dict.fromkeys(codes))}{of_load}")


def thinned(history: History) -> History:
    """A course with no more samples than can be seen: of each stretch its ends and its extremes, as they stand."""
    times, values = np.asarray(history.times, float), np.asarray(history.values, float)
    sound = np.isfinite(times) & np.isfinite(values)
    times, values = times[sound], values[sound]
    if len(times) > 4 * _CELLS:
        edges = np.linspace(times[0], times[-1], _CELLS + 1)
        starts = np.unique(np.clip(np.searchsorted(times, edges), 0, len(times)))
        kept: set[int] = set()
        for first, last in pairwise(starts.tolist()):
            part = values[first:last]
            kept |= {first, last - 1, int(first + part.argmax()), int(first + part.argmin())}
        chosen = sorted(kept | {len(times) - 1})
        times, values = times[chosen], values[chosen]
    return History(history.quantity, times.tolist(), values.tolist(), history.over)
