"""Progress of a long computation: the current step, for a display."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

_followers: list[Callable[[str], None]] = []


def step(text: str) -> None:
    """Report the current step of the computation."""
    for follower in _followers:
        follower(text)


@contextmanager
def followed(follower: Callable[[str], None]) -> Iterator[None]:
    """Call a function with the text of each step."""
    _followers.append(follower)
    try:
        yield
    finally:
        _followers.remove(follower)
