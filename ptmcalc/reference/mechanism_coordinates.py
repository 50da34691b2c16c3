"""Coordinates of a train of inertias: groups that gears tie together, and rows over travels, speeds and inputs."""

from bisect import bisect_right
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ptmcalc.numerics.train.parts import HUNT_CROSSLEY, Governed, Grip, Smooth, Spring, Train
from ptmcalc.numerics.train.signals import Signal

FloatArray = NDArray[np.float64]
Branch = tuple[str, int]
OPEN: Branch = ("open", 0)


class State(NamedTuple):
    """What touches, what turns which way (0 held, None free of friction), what slips, signs of the outer torques of
    lossy meshes, stage and piece of every drive, and when every signal with a trigger started."""

    branches: tuple[Branch, ...]
    turning: tuple[int | None, ...]
    slips: tuple[int, ...]
    meshes: tuple[int, ...]
    drives: tuple[tuple[int, int], ...]
    started: tuple[float | None, ...]


class Coordinates:
    """Groups of bodies that gears tie together, and rows over w = (q, v, u): places, speeds and signals."""

    def __init__(self, train: Train) -> None:
        self.train = train
        bodies = train.bodies
        self.count_bodies = len(bodies)
        self.of, self.ratio = self._groups()
        self.count = max(self.of) + 1
        self.inertia = np.array([body.inertia for body in bodies])
        self.origin = np.array([body.position for body in bodies])
        self.weights = np.zeros(self.count)
        np.add.at(self.weights, self.of, self.inertia * self.ratio**2)
        self.lossy = [k for k, mesh in enumerate(train.meshes) if mesh.lossy]
        self.clutches = [k for k, grip in enumerate(train.grips) if self._joins(grip)]
        self.guided = {self.of[guide.body]: k for k, guide in enumerate(train.guides)}
        self.rough = [self._is_rough(group) for group in range(self.count)]
        self.signals = tuple(dict.fromkeys(self._signals()))
        self.smooth = [k for k, drive in enumerate(train.drives) if _smooth(drive.stages)]
        self.hertz = [k for k, spring in enumerate(train.springs) if spring.law == HUNT_CROSSLEY]
        self.first_input = 2 * self.count
        self.width = self.first_input + 1 + len(self.signals) + len(self.smooth) + len(self.hertz)
        self.one = self._unit(self.first_input)
        self.rows = [self._row(spring) for spring in train.springs]
        self.start_extension = [self._extension(spring) for spring in train.springs]

    def _groups(self) -> tuple[list[int], FloatArray]:
        """Group of every body, and its speed over that of the group's first."""
        count = len(self.train.bodies)
        of, ratio = [-1] * count, np.ones(count)
        groups = 0
        for body in range(count):
            if of[body] >= 0:
                continue
            of[body], waiting = groups, [body]
            groups += 1
            while waiting:
                here = waiting.pop()
                for mesh in self.train.meshes:
                    for one, other, factor in (
                        (mesh.inner, mesh.outer, 1 / mesh.ratio),
                        (mesh.outer, mesh.inner, mesh.ratio),
                    ):
                        if one == here and of[other] < 0:
                            of[other], ratio[other] = of[here], ratio[here] * factor
                            waiting.append(other)
        return of, ratio

    def _joins(self, grip: Grip) -> bool:
        return grip.second is not None and self.of[grip.first] != self.of[grip.second]

    def _is_rough(self, group: int) -> bool:
        grips = (grip for k, grip in enumerate(self.train.grips) if k not in self.clutches)
        return any(self.of[grip.first] == group for grip in grips) or any(
            self.of[self.train.meshes[k].inner] == group for k in self.lossy
        )

    def _signals(self) -> Iterator[Signal]:
        for drive in self.train.drives:
            yield drive.gate
            for stage in drive.stages:
                if isinstance(stage.law, Signal):
                    yield stage.law
                elif isinstance(stage.law, Governed):
                    yield stage.law.reference
        for grip in self.train.grips:
            yield from (grip.capacity, grip.gate)
        for guide in self.train.guides:
            yield guide.acceleration

    # -- rows ------------------------------------------------------------------------------------------------------

    def _unit(self, index: int) -> FloatArray:
        row = np.zeros(self.width)
        row[index] = 1.0
        return row

    def group_row(self, first: int, second: int | None, over: int | None = None) -> FloatArray:
        """Relative speed of bodies as a row over the speeds of the groups."""
        row = np.zeros(self.count)
        row[self.of[first]] += self.ratio[first]
        for other in (second, over):
            if other is not None:
                row[self.of[other]] -= self.ratio[other]
        return row

    def _row(self, spring: Spring) -> FloatArray:
        return self.group_row(spring.first, spring.second, spring.over)

    def _extension(self, spring: Spring) -> float:
        found = self.origin[spring.first] - spring.rest
        for other in (spring.second, spring.over):
            found -= self.origin[other] if other is not None else 0.0
        return float(found)

    def extension(self, k: int) -> FloatArray:
        """Extension of a link."""
        row = self.start_extension[k] * self.one
        row[: self.count] = self.rows[k]
        return row

    def speed_of(self, groups: FloatArray) -> FloatArray:
        """A sum of speeds of groups."""
        row = np.zeros(self.width)
        row[self.count : 2 * self.count] = groups
        return row

    def body_speed(self, body: int) -> FloatArray:
        """Speed of a body."""
        return self.speed_of(self.group_row(body, None))

    def body_position(self, body: int) -> FloatArray:
        """Position of a body."""
        row: FloatArray = self.origin[body] * self.one
        row[self.of[body]] += self.ratio[body]
        return row

    def signal_row(self, signal: Signal) -> FloatArray:
        """A signal, an input of its own."""
        return self._unit(self.first_input + 1 + self.signals.index(signal))

    # -- inputs ----------------------------------------------------------------------------------------------------

    def breaks(self, state: State) -> Iterator[float]:
        """Times at which a signal changes its piece, a stage ends or an impulse strikes."""
        for signal, start in zip(self.signals, state.started, strict=True):
            if start is not None:
                yield from (start + time for time in signal.times[1:])
                if signal.decay:
                    yield start + signal.decay_start
        for drive, (stage, _) in zip(self.train.drives, state.drives, strict=True):
            until = drive.stages[stage].until_time
            if until is not None and stage + 1 < len(drive.stages):
                yield until
        yield from (impulse.time for impulse in self.train.impulses)

    def level(self, signal: Signal, state: State, inside: float) -> float:
        """A signal of steps within an interval without breaks."""
        return float(self.straight(signal, state, inside)[0])

    def straight(self, signal: Signal, state: State, inside: float) -> tuple[float, float]:
        """(a, b) of its straight line a + b t in the interval around a time."""
        start = state.started[self.signals.index(signal)]
        if start is None:
            return signal.before, 0.0
        piece = max(bisect_right(signal.times, inside - start) - 1, 0)
        slope = signal.slopes[piece]
        return signal.values[piece] - slope * (start + signal.times[piece]), slope


def _smooth(stages: tuple[object, ...]) -> bool:
    return any(isinstance(getattr(stage, "law", None), Smooth) for stage in stages)
