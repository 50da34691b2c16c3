"""What is remembered between two runs, and how to forget it: a run is only timed fairly when it starts from nothing."""

from collections.abc import Callable
from functools import lru_cache, wraps
from typing import ParamSpec, TypeVar

P = ParamSpec("P")
T = TypeVar("T")

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


def forgotten_with(forgetter: Callable[[], object]) -> None:
    """Have something forgotten too, whenever all is."""
    _FORGETTERS.append(forgetter)


def forget() -> None:
    """Forget all that was made of machines; tables that belong to no machine stay."""
    for forgetter in _FORGETTERS:
        forgetter()
