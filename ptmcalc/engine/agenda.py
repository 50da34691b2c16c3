"""What is left of a batch, in which order it goes out, and what all of it is predicted to take.

Nobody plans a file before it goes out, for that would be half of the work of a quick one, done by one process alone.
Files go out as they are, those of a kind that nobody has seen first; who gets one does it, unless its plan foresees a
long run. Such a one comes back with the seconds it will take, and goes out again on its own, the longest first. As long
as there are files that nobody has looked at, some of them are under way, so that the longest of all is found early.
"""

import math
from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass, field
from heapq import heappop, heappush
from random import Random

CHUNK = 0.5
"""Predicted seconds of a portion of files, and of a file from which on it is a portion of its own. A numerical choice:
a larger value saves transfers; a smaller one distributes the work more uniformly."""
MOST_IN_CHUNK = 500
"""Files of a portion. A numerical choice: it limits portions of files below 1 ms each. A larger number saves transfers;
a smaller one distributes the files more uniformly."""
_SHARES = 4
"""Portions that each worker takes at least of the remaining files. A numerical choice: towards the end portions become
small. A larger number distributes the work more uniformly with more transfers."""
_UNSEEN = 0.1
"""Predicted seconds of a file of a kind of which no file has been computed. A numerical choice: a larger value makes
first portions small; a smaller one may give a worker too much."""
_LEAST = 1e-4
"""Minimum of the predicted seconds of a file. A numerical choice: it keeps portions finite. A larger value makes
portions smaller."""
_LOOK = 0.05
"""Seconds in which a file is planned that is then queued on its own. A numerical choice: a larger value makes portions
of its kind smaller."""


@dataclass(slots=True)
class _Kind:
    """The files of a kind that nobody has looked at, and what was learnt from those that somebody has."""

    new: deque[int] = field(default_factory=deque)
    left: int = 0
    """those that are not heard of yet, under way or not"""
    seen: int = 0
    seconds: float = 0.0
    looks: float = 0.0

    @property
    def look(self) -> float:
        """Mean seconds of the first time that a file goes out."""
        return max(self.looks / self.seen, _LEAST) if self.seen else _UNSEEN


@dataclass(frozen=True, slots=True)
class Portion:
    """Files that go out together; those that would take longer than `patience` come back."""

    files: tuple[int, ...]
    patience: float


class Agenda:
    """The files of a batch by their numbers, from the kind of each."""

    def __init__(self, kinds: Mapping[int, bytes]) -> None:
        self._kind_of = dict(kinds)
        self._kinds: dict[bytes, _Kind] = {}
        order = list(kinds)
        Random(0).shuffle(order)  # neighbours in a folder are like each other: the long ones may all be at its end
        for index in order:
            kind = self._kinds.setdefault(kinds[index], _Kind())
            kind.new.append(index)
            kind.left += 1
        self._long: list[tuple[float, int]] = []
        self._foreseen: dict[int, float] = {}
        self.done = 0.0
        """predicted seconds of what is done"""

    @property
    def kinds(self) -> tuple[bytes, ...]:
        """The names of the kinds there are."""
        return tuple(self._kinds)

    @property
    def expected(self) -> float:
        """Predicted seconds of all, done or not, by what is known so far; nothing as long as nothing is known."""
        seen = sum(kind.seen for kind in self._kinds.values())
        mean = sum(kind.seconds for kind in self._kinds.values()) / seen if seen else 0.0
        rest = sum(k.left * (k.seconds / k.seen if k.seen else mean) for k in self._kinds.values())
        return self.done + sum(self._foreseen.values()) + rest

    def next(self, jobs: int, *, looking: bool = False) -> Portion | None:
        """What goes out next to one of so many workers; None where nothing is left, or all of it is under way.

        `looking` says that new files are under way already.
        """
        kind = max((k for k in self._kinds.values() if k.new), key=lambda k: (not k.seen, k.look), default=None)
        if self._long and (looking or kind is None):
            return Portion((heappop(self._long)[1],), math.inf)
        if kind is None:
            return None
        rest = sum(len(one.new) * one.look for one in self._kinds.values())
        number = int(min(CHUNK, rest / (_SHARES * jobs)) / kind.look)
        number = max(1, min(number, MOST_IN_CHUNK, len(kind.new)))
        return Portion(tuple(kind.new.popleft() for _ in range(number)), CHUNK)

    def came_back(self, index: int, seconds: float) -> None:
        """A file would take so long that it goes out on its own."""
        self._heard_of(index, seconds, _LOOK)
        self._foreseen[index] = seconds
        heappush(self._long, (-seconds, index))

    def is_done(self, index: int, seconds: float) -> None:
        """A file is done; it was predicted to take so long."""
        if self._foreseen.pop(index, None) is None:
            self._heard_of(index, seconds, seconds)
        self.done += seconds

    def _heard_of(self, index: int, seconds: float, look: float) -> None:
        kind = self._kinds[self._kind_of.pop(index)]
        kind.left -= 1
        kind.seen += 1
        kind.seconds += seconds
        kind.looks += look
