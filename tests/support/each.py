"""One test over many things: every one is looked at, and all that break the rule are named."""

from collections.abc import Callable, Iterable, Mapping
from functools import wraps
from typing import Any


def over(subjects: Mapping[str, Any] | Iterable[str]) -> Callable[[Callable[..., None]], Callable[[], None]]:
    """Makes one test of a test of one subject; of a tuple, each part is an argument."""
    named = subjects if isinstance(subjects, Mapping) else {name: name for name in subjects}

    def made(test: Callable[..., None]) -> Callable[[], None]:
        @wraps(test)
        def whole() -> None:
            assert named
            broken = []
            for name, subject in named.items():
                try:
                    test(*(subject if isinstance(subject, tuple) else (subject,)))
                except Exception as error:
                    broken.append(f"{name}: {error!r}")
            assert not broken, "\n".join(broken)

        del whole.__wrapped__  # type: ignore[attr-defined]  # pytest would ask for its arguments
        return whole

    return made
