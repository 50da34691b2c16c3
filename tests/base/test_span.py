"""Names of keys: `scenes[0].profile.time` and back."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ptmcalc.base.span import KeyPath, Span, dotted, key_path

WORDS = st.text("abcdefghijklmnopqrstuvwxyz_0123456789éß", min_size=1, max_size=8)
PATHS = st.tuples(WORDS, st.lists(WORDS | st.integers(0, 99), max_size=5)).map(lambda parts: (parts[0], *parts[1]))


@pytest.mark.parametrize(
    ("path", "text"),
    [
        ((), ""),
        (("speed",), "speed"),
        (("drive", "motor", "inertia"), "drive.motor.inertia"),
        (("scenes", 0, "profile", "time"), "scenes[0].profile.time"),
        (("a", 1, 2), "a[1][2]"),
    ],
)
def test_a_path_is_written_with_dots_and_brackets(path: KeyPath, text: str) -> None:
    assert dotted(path) == text
    assert key_path(text) == path


@given(PATHS)
def test_a_written_path_is_read_back(path: KeyPath) -> None:
    assert key_path(dotted(path)) == path


def test_places_sort_by_line_then_column() -> None:
    assert sorted([Span(2, 1), Span(1, 9), Span(1, 2)]) == [Span(1, 2), Span(1, 9), Span(2, 1)]
