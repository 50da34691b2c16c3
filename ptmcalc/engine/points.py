"""Many variants of one machine: by lanes where closed forms decide, else as design files of their own for a batch.

By lanes, the very code that checks one machine runs once for thousands of values (`numerics.lanes`); nothing of the
physics is written twice. Some of the points are checked as files of their own all the same, and where one differs no
lane of that scene counts. What the closed form leaves open is `open_points`: a batch may do it, nobody guesses it.
"""

import json
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.errors import UsageError
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.memory import forget
from ptmcalc.base.span import KeyPath, dotted, key_path
from ptmcalc.base.units import RATIO, Quantity, show
from ptmcalc.contract.check import AnyCheck
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.report import AssumedReport, FileReport
from ptmcalc.contract.result import LoadInfo
from ptmcalc.contract.study import FloatArray, LoadTrack, Points, Said, Track, VariedKey
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.judge import checks_of, sides
from ptmcalc.engine.load import Loaded, fill, load_text, measure_at, with_key, written
from ptmcalc.engine.plan import ScenePlan, plan_scene
from ptmcalc.engine.widen import widen
from ptmcalc.numerics import lanes
from ptmcalc.numerics.lanes import Lanes, LanesError, SplitError
from ptmcalc.spec.alias import key_of
from ptmcalc.spec.fields import Measure
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.spec.scene import Scene
from ptmcalc.spec.shape import did_you_mean, is_whole, keys_of, measure_of

BLOCK = 8192
"""Points computed at once. A numerical choice: their values stay in the cache of the processor. A larger number needs
more memory; a smaller one has more overhead."""
_MOST_RUNS = 256
"""Vectorised runs of one block, which divides at each branch; the remaining points are computed as files. A numerical
choice: more runs treat more branches and take longer where each has few points."""
_MOST_CORNERS = 256
"""Corners of the box of all points at which a file is validated. A numerical choice: 8 keys have all of theirs, more
keys a part. More corners find more refused combinations before the run and take longer."""
_VERIFIED = 24
"""Points of a scene that are verified as files of their own, in addition to one of each block. A numerical choice: more
find a difference more certainly and take longer."""
_SAME = 1e-9
"""Relative difference of a vectorised point from a file of its own [1] that counts as rounding: numpy and `math` differ
in the last digit. A larger value hides real differences; a smaller one reports rounding."""
_LEFT_OUT = ("waive", "tolerances", "description", "name", "project")
"""What a point has no use for: its verdict is that of the physics, on any day."""
_SAID = {
    Verdict.PASS: Said.PASS,
    Verdict.FAIL: Said.FAIL,
    Verdict.WAIVED: Said.FAIL,
    Verdict.UNDECIDED: Said.UNDECIDED,
    Verdict.NOT_CHECKED: Said.NOT_CHECKED,
}

Key = tuple[str, str, str]


# -- keys -----------------------------------------------------------------------------------------------------------


def numbers_of(spec: MachineSpec, *, whole: bool = False) -> list[str]:
    """The keys of a machine behind which a number with a quantity stands; also those of `whole` numbers."""
    return [dotted(path) for path in _numbers(spec, (), whole=whole)]


def _numbers(node: Any, path: KeyPath, *, whole: bool) -> Iterator[KeyPath]:
    if isinstance(node, BaseModel):
        for key, about in keys_of(type(node)).items():
            value = getattr(node, next(n for n, f in type(node).model_fields.items() if (f.alias or n) == key))
            if measure_of(about) is not None or (whole and is_whole(about)):
                if value is not None:
                    yield (*path, key)
            else:
                yield from _numbers(value, (*path, key), whole=whole)
    elif isinstance(node, Mapping):
        for key, value in node.items():
            yield from _numbers(value, (*path, key), whole=whole)
    elif isinstance(node, tuple | list):
        for index, value in enumerate(node):
            yield from _numbers(value, (*path, index), whole=whole)


def varied_key(loaded: Loaded, name: str) -> tuple[VariedKey, Measure]:
    """The key of that name, and what it takes.

    Raises:
        UsageError: no number stands there.
    """
    spec = loaded.spec
    assert spec is not None
    path = key_of(key_path(name), type(spec), loaded.document.data)
    whole = _is_whole(spec, path)
    measure = Measure(RATIO) if whole else measure_at(spec, path) if path else None
    present = spec.value_at(path)
    if measure is None or isinstance(present, bool) or not isinstance(present, int | float | None):
        known = numbers_of(spec, whole=True)
        raise UsageError(f"`{name}` is not a numerical key of this file", did_you_mean(name, known, "keys: "))
    span = loaded.document.value_span(path)
    return VariedKey(loaded.document.as_written(path), measure.quantity, present, span, whole), measure


def _is_whole(spec: MachineSpec, path: KeyPath) -> bool:
    """Whether a whole number stands at a path."""
    node = spec.value_at(path[:-1]) if path else None
    about = keys_of(type(node)).get(str(path[-1])) if isinstance(node, BaseModel) else None
    return about is not None and is_whole(about)


# -- studies --------------------------------------------------------------------------------------------------------


@dataclass(slots=True)
class Study:
    """A machine whose keys vary, over some points and scenes."""

    loaded: Loaded
    points: Points
    options: Options
    _kind: AnyKind = field(init=False)
    _spec: MachineSpec = field(init=False)
    """the machine as the file alone has it"""
    _open: dict[str, NDArray[np.bool_]] = field(init=False)
    _done: dict[str, NDArray[np.bool_]] = field(init=False)
    _sound: NDArray[np.intp] = field(init=False)
    """points at which the file is that of a machine"""
    by_lanes: int = 0
    """points times scenes that were computed by lanes"""

    def __post_init__(self) -> None:
        loaded = self.loaded
        assert loaded.kind is not None
        assert loaded.spec is not None
        self._kind, self._spec = loaded.kind, loaded.spec
        for assumed in loaded.assumed:
            self._spec = self._spec.with_value(assumed.path, None)
        labels = self.options.scenes or tuple(scene.label for scene in loaded.spec.all_scenes)
        self._open = {label: np.ones(len(self.points), bool) for label in labels}
        self._done = {label: np.zeros(len(self.points), bool) for label in labels}
        self.points.missing = np.ones(len(self.points), bool)
        self._sound = np.arange(len(self.points))

    # -- one point --

    def text_of(self, index: int) -> bytes:
        """The design file of a point."""
        return self._text(self.points.values[index])

    def _text(self, values: Iterable[float]) -> bytes:
        data: Any = self.loaded.document.data
        data = {key: value for key, value in data.items() if key not in _LEFT_OUT}
        for key, value in zip(self.points.keys, values, strict=True):
            data = with_key(data, key.path, int(value) if key.whole else written(float(value), key.quantity))
        return json.dumps(data, ensure_ascii=False).encode()

    def take(self, index: int, report: FileReport, labels: Iterable[str]) -> None:
        """What a file of its own says of a point."""
        for scene in report.scenes:
            for load in scene.loads:
                if self._shows(load.info):
                    found = load.estimate
                    self._load(scene.name, load.info, np.array([index]), (found.value, found.low, found.high))
            for one in scene.checks:
                if one.verdict is Verdict.OFF:
                    continue
                track = self._track(scene.name, one.code, one.element, one.title, one.sense, one.quantity)
                track.said[index] = _SAID[one.verdict]
                track.value[index] = one.value.value if one.value else math.nan
                track.limit[index] = one.limit.value if one.limit else math.nan
        if report.valid:
            for label in labels:
                self._open[label][index] = False
                self._done[label][index] = True
            self._count_missing()
        else:
            fault = next(one for one in report.diagnostics if one.severity.rank == 2)
            values = zip(self.points.keys, self.points.values[index], strict=True)
            at = ", ".join(f"{key.name}: {show(value, key.quantity)}" for key, value in values)
            self._note(f"no machine of this kind at {at}: {fault.message}")

    def open_points(self) -> list[tuple[tuple[str, ...], NDArray[np.intp]]]:
        """Points that are open in the same scenes: the scenes, and their numbers."""
        labels = list(self._open)
        state = np.stack([self._open[label] for label in labels], axis=1)
        found = []
        for pattern in np.unique(state, axis=0):
            if pattern.any():
                where = np.flatnonzero((state == pattern).all(axis=1))
                found.append((tuple(label for label, there in zip(labels, pattern, strict=True) if there), where))
        return found

    def _count_missing(self) -> None:
        self.points.missing = ~np.all(list(self._done.values()), axis=0)

    def _note(self, text: str) -> None:
        if text not in self.points.notes:
            self.points.notes.append(text)

    # -- what is found --

    def _shows(self, info: LoadInfo) -> bool:
        return info.governing

    def _track(self, scene: str, code: str, element: str, title: str, sense: Any, quantity: Quantity) -> Track:
        key = scene, code, element
        if key not in self.points.tracks:
            size = len(self.points)
            numbers = np.full(size, math.nan), np.full(size, math.nan)
            said = np.full(size, Said.NOT_COMPUTED, np.int8)
            self.points.tracks[key] = Track(scene, code, element, title, sense, quantity, said, *numbers)
        return self.points.tracks[key]

    def _load(self, scene: str, info: LoadInfo, where: NDArray[np.intp], numbers: Sequence[float]) -> None:
        key = scene, info.name
        if key not in self.points.loads:
            self.points.loads[key] = LoadTrack(scene, info, *(np.full(len(self.points), math.nan) for _ in range(3)))
        track = self.points.loads[key]
        for array, number in zip((track.value, track.low, track.high), numbers, strict=True):
            array[where] = lanes.of(number, where.size)

    # -- by lanes --

    def run_by_lanes(self) -> None:
        """All points, of every scene whose first solver takes lanes; what they leave open stays open."""
        if not self._leave_out_what_is_no_machine():
            return
        by_lanes = not any(key.whole for key in self.points.keys)  # how many parts there are is a branch
        for label in self._open if by_lanes else ():
            if self._takes_lanes(label):
                self._scene_by_lanes(label)
        self._count_missing()

    def _leave_out_what_is_no_machine(self) -> bool:
        """Leaves out points at which the file would be refused; whether any are left.

        The range of each key was looked at when it was read. What holds between keys is looked at in the corners of
        the box the points lie in; only where one is refused, point by point.
        """
        ends = np.stack([self.points.values.min(axis=0), self.points.values.max(axis=0)])
        count = len(self.points.keys)
        corners = 1 << count
        chosen = range(corners) if corners <= _MOST_CORNERS else range(0, corners, corners // _MOST_CORNERS | 1)
        if all(self._fault([ends[number >> bit & 1, bit] for bit in range(count)]) is None for number in chosen):
            return True
        faults = [self._fault(values) for values in self.points.values]
        refused = np.array([fault is not None for fault in faults])
        if refused.any():
            first = next(fault for fault in faults if fault is not None)
            self._note(f"{np.count_nonzero(refused)} points are no machines, the first since {first}")
        for state in self._open.values():
            state &= ~refused
        self._sound = np.flatnonzero(~refused)
        return bool(self._sound.size)

    def _fault(self, values: Iterable[float]) -> str | None:
        """What is wrong with the design file of some values."""
        loaded = load_text(self._text(map(float, values)), "", self.options.effects, self.options.accuracy)
        return None if loaded.spec is not None else loaded.diagnostics[0].message

    def _takes_lanes(self, label: str) -> bool:
        spec, _ = self._machine(self.points.values[self._sound[0]])
        first = next(iter(plan_scene(self._kind, spec, _scene(spec, label)).rungs), None)
        return first is not None and first.solver.by_lanes

    def _machine(self, values: Sequence[Any] | FloatArray) -> tuple[MachineSpec, tuple[AssumedReport, ...]]:
        spec = self._spec
        for key, value in zip(self.points.keys, values, strict=True):
            number = value if isinstance(value, Lanes) else int(value) if key.whole else float(value)
            spec = spec.with_value(key.path, number)
        return fill(self._kind, spec)

    def _scene_by_lanes(self, label: str) -> None:
        before = dict(self.points.tracks), dict(self.points.loads)
        verified = 0
        for first in range(0, self._sound.size, BLOCK):
            block = self._sound[first : first + BLOCK]
            parts = lanes.parted(block, partial(self._by_lanes, label), _MOST_RUNS)
            for number, (where, found) in enumerate(parts):
                forget()
                reason = found if isinstance(found, str) else ""
                if isinstance(found, _Found):
                    self._keep(label, where, found)
                    if number == 0 or verified < _VERIFIED:
                        verified += 1
                        reason = self._differs(label, int(where[where.size // 2]), found)
                if reason:
                    self.points.tracks, self.points.loads = before
                    self._open[label][self._sound], self._done[label][:] = True, False
                    self._note(f"scene `{label}` is computed point by point: {reason}")
                    return
        self.by_lanes += int(np.count_nonzero(self._done[label] & ~self._open[label]))

    def _by_lanes(self, label: str, where: NDArray[np.intp]) -> "_Found | str":
        """Loads and rulings of some points at once; why not, where it cannot be."""
        forget()
        try:
            spec, assumed = self._machine([Lanes(column) for column in self.points.values[where].T])
            found = self._ruled(spec, label, where.size)
            scene = _scene(spec, label)
            for value in assumed:
                if not value.read_in(scene) or not any(value.read_by(check) for check in found.checks.values()):
                    continue
                for end in (value.interval.low, value.interval.high):
                    other = self._ruled(spec.with_value(value.path, end), label, where.size)
                    for key, (said, *_) in found.rulings.items():
                        decided = (said == Said.PASS) | (said == Said.FAIL)
                        said[decided & (other.rulings[key][0] != said)] = Said.UNDECIDED
            return found
        except SplitError:
            raise
        except Exception as error:  # whatever cannot be done by lanes is done by files, where it is told
            return f"{type(error).__name__}: {error}"

    def _ruled(self, spec: MachineSpec, label: str, size: int) -> "_Found":
        scene = _scene(spec, label)
        made = plan_scene(self._kind, spec, scene)
        rung = made.rungs[0]
        if not rung.solver.by_lanes:
            raise LanesError(f"`{rung.solver.name}` takes one machine at a time")
        result = rung.solver.run(spec, scene, rung.carried, rung.level)
        if result.failures:
            raise LanesError(f"`{rung.solver.name}` found machines that fail")
        loads = widen(made, spec, rung, result)
        checks = {(one.code, one.element): one for one in checks_of(self._kind, spec, scene)}
        rulings = {key: _ruling(one, spec, scene, loads, size) for key, one in checks.items()}
        return _Found(spec, made, loads, checks, rulings)

    def _keep(self, label: str, where: NDArray[np.intp], found: "_Found") -> None:
        left = np.zeros(where.size, bool)
        for (code, element), (said, value, limit) in found.rulings.items():
            one = found.checks[code, element]
            quantity = self._kind.quantity_of(found.spec, one)
            track = self._track(label, code, element, one.title, one.sense, quantity)
            track.said[where], track.value[where], track.limit[where] = said, value, limit
            left |= said == Said.UNDECIDED
        for info in self._kind.loads_of(found.spec):
            if self._shows(info) and info.name in found.loads:
                one_load = found.loads[info.name]
                self._load(label, info, where, (one_load.value, one_load.low, one_load.high))
        self._open[label][where] = left & (len(found.made.rungs) > 1)
        self._done[label][where] = True

    def _differs(self, label: str, index: int, found: "_Found") -> str:
        """In what a file of its own differs from a point computed by lanes; empty where it does not."""
        options = replace(self.options, scenes=(label,), repairs=False)
        report = check(load_text(self.text_of(index), "", options.effects, options.accuracy), options)
        told = {(one.code, one.element): one for _, one in report.judgements if one.verdict is not Verdict.OFF}
        if set(told) != set(found.rulings):
            return "a file of its own has other checks there"
        for (code, element), one in told.items():
            track = self.points.tracks[label, code, element]
            numbers = (one.value.value if one.value else math.nan, one.limit.value if one.limit else math.nan)
            for mine, its in zip((track.value[index], track.limit[index]), numbers, strict=True):
                if not _alike(mine, its):
                    return f"{code} of a file of its own comes to {its:.9g}, by lanes to {mine:.9g}"
            exact = abs(track.margin[index]) <= _SAME * max(map(abs, numbers))
            if track.said[index] != _SAID[one.verdict] and not (exact or self._open[label][index]):
                return f"{code} is {one.verdict.value} in a file of its own"
        return ""


@dataclass(frozen=True, slots=True)
class _Found:
    """What a run by lanes found: verdict, value and limit of every check, lane by lane."""

    spec: MachineSpec
    made: ScenePlan
    loads: Mapping[str, Estimate]
    checks: Mapping[tuple[str, str], AnyCheck]
    rulings: Mapping[tuple[str, str], tuple[NDArray[np.int8], FloatArray, FloatArray]]


def _scene(spec: MachineSpec, label: str) -> Scene:
    return next(scene for scene in spec.all_scenes if scene.label == label)


def _ruling(
    one: AnyCheck, spec: MachineSpec, scene: Scene, loads: Mapping[str, Estimate], size: int
) -> tuple[NDArray[np.int8], FloatArray, FloatArray]:
    """`engine.judge.rule`, lane by lane: the same loads against the same limit."""
    said, nothing = np.full(size, Said.UNDECIDED, np.int8), np.full(size, math.nan)
    if any(spec.value_at(path) is None for path in one.needs(spec, scene)):
        return np.full(size, Said.NOT_CHECKED, np.int8), nothing, nothing
    limit = one.limit(spec, scene)
    if any(name not in loads for name in one.loads):
        return said, nothing, lanes.of(limit.value, size)
    value = one.read(spec, scene, loads)
    sound, bad = (lanes.of(side, size).astype(bool) for side in sides(value, limit, one.sense))
    said[bad], said[sound] = Said.FAIL, Said.PASS
    return said, lanes.of(value.value, size), lanes.of(limit.value, size)


def _alike(one: float, other: float) -> bool:
    """Whether two numbers are the same but for rounding, or both none."""
    return one == other or math.isclose(one, other, rel_tol=_SAME) or (math.isnan(one) and math.isnan(other))
