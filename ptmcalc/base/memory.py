"""What is remembered between two runs, and how to forget it: a run is only timed fairly when it starts from zero.

And how much memory a run may take.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import lru_cache, wraps
from pathlib import Path
from typing import ParamSpec, TypeVar

try:
    import resource
except ImportError:  # Windows has no such limit
    resource = None  # type: ignore[assignment]

P = ParamSpec("P")
T = TypeVar("T")

MEMORY_BUDGET = 2 << 30
"""Bytes that a run may take besides what the program has when it begins."""
_TAKEN = Path("/proc/self/statm")
_DATA = 5
"""Field of the pages of data."""

_FORGETTERS: list[Callable[[], object]] = []


def remembered(size: int) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """What a function last made of the machines it was given, so many of them, until `forget`."""

    def keep(function: Callable[P, T]) -> Callable[P, T]:
        kept = lru_cache(maxsize=size)(function)
        forgotten_with(kept.cache_clear)

        @wraps(function)
        def call(*args: P.args, **kwargs: P.kwargs) -> T:
            return kept(*args, **kwargs)  # type: ignore[arg-type]

        return call

    return keep


def kept_for(size: int) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """What a function last made of the very objects it was given, so many times, until `forget`.

    For functions of immutable machines that are asked again and again in one report: comparing two machines takes
    longer than what they do. The objects are held as long as what was made of them, so no other has their identity.
    """

    def keep(function: Callable[P, T]) -> Callable[P, T]:
        kept: dict[tuple[int, ...], tuple[tuple[object, ...], T]] = {}
        forgotten_with(kept.clear)

        @wraps(function)
        def call(*args: P.args, **kwargs: P.kwargs) -> T:
            if kwargs:
                return function(*args, **kwargs)
            key = tuple(map(id, args))
            found = kept.get(key)
            if found is not None:
                return found[1]
            made = function(*args)  # type: ignore[call-arg]
            if len(kept) >= size:
                del kept[next(iter(kept))]
            kept[key] = args, made
            return made

        return call

    return keep


def forgotten_with(forgetter: Callable[[], object]) -> None:
    """Have something forgotten too, whenever all is."""
    _FORGETTERS.append(forgetter)


def forget() -> None:
    """Forget all that was made of machines; tables that belong to no machine stay."""
    for forgetter in _FORGETTERS:
        forgetter()


@contextmanager
def limited(most: int | None = None) -> Iterator[None]:
    """What is done in it takes at most so many bytes more than the program has now, `MEMORY_BUDGET` when left out.

    Beyond that Python and numpy raise a MemoryError. Where the system tells or limits nothing, there is no limit.
    """
    taken = _taken()
    if resource is None or taken is None:
        yield
        return
    before, hard = resource.getrlimit(resource.RLIMIT_DATA)
    allowed = taken + (MEMORY_BUDGET if most is None else most)
    lower = allowed if before == resource.RLIM_INFINITY else min(before, allowed)
    resource.setrlimit(resource.RLIMIT_DATA, (lower, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_DATA, (before, hard))


def _taken() -> int | None:
    """Bytes of data that the program has now."""
    try:
        return int(_TAKEN.read_text("ascii").split()[_DATA]) * resource.getpagesize()
    except (OSError, ValueError, IndexError, AttributeError):
        return None
