"""The last motions of a solver: the next setting begins with grids that the one before ended with, the search for a
repair changes keys that no motion depends on, and an assumed value that goes to its ends is one of a scene or two."""

from collections import deque
from collections.abc import Callable
from typing import Generic, TypeVar

from ptmcalc.base.memory import forgotten_with

T = TypeVar("T")
_MOST_SAMPLES = 150_000
"""Time samples of all motions kept, some hundred megabytes. A numerical choice: more save repeated runs and need
memory; fewer repeat runs of the same motion."""


class Kept(Generic[T]):
    """What was made last, by all that it depends on.

    Args:
        size: of a thing made, in samples.
    """

    def __init__(self, size: Callable[[T], int]) -> None:
        self._size = size
        self._last: deque[tuple[object, T]] = deque()
        self._samples = 0
        forgotten_with(self.forget)

    def of(self, causes: object, make: Callable[[], T]) -> T:
        """What was made of equal causes, or is made now; what was not asked for the longest goes first."""
        for at, (known, made) in enumerate(self._last):
            if known == causes:
                del self._last[at]
                self._last.append((known, made))
                return made
        made = make()
        self._last.append((causes, made))
        self._samples += self._size(made)
        while self._samples > _MOST_SAMPLES and len(self._last) > 1:
            self._samples -= self._size(self._last.popleft()[1])
        return made

    def forget(self) -> None:
        """Keep nothing of what was made so far."""
        self._last.clear()
        self._samples = 0
