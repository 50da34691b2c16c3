"""The last motions of a solver: the next setting begins with grids that the one before ended with, and the search for
a repair changes keys that no motion depends on."""

from collections import deque
from collections.abc import Callable
from typing import Generic, TypeVar

T = TypeVar("T")
_MOST = 8


class Kept(Generic[T]):
    """What was made last, by all that it depends on."""

    def __init__(self) -> None:
        self._last: deque[tuple[object, T]] = deque(maxlen=_MOST)

    def of(self, causes: object, make: Callable[[], T]) -> T:
        """What was made of equal causes, or is made now."""
        for known, made in self._last:
            if known == causes:
                return made
        made = make()
        self._last.append((causes, made))
        return made
