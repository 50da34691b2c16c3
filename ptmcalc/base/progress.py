"""What a long computation does at the moment, for those who want to show it."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

_followers: list[Callable[[str], None]] = []


def step(text: str) -> None:
    """Say what is computed now."""
    for follower in _followers:
        follower(text)


@contextmanager
def followed(follower: Callable[[str], None]) -> Iterator[None]:
    """Have every step said to a function."""
    _followers.append(follower)
    try:
        yield
    finally:
        _followers.remove(follower)
