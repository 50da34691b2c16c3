"""Numbers that know their error: the interval never loses a value it held."""

import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from ptmcalc.base.estimate import ANYTHING, NOTHING, Estimate, Interval

NUMBERS = st.floats(-1e12, 1e12)
WIDTHS = st.floats(0, 1e12)
OFFSETS = st.builds(Interval, WIDTHS.map(lambda width: -width), WIDTHS)
ESTIMATES = st.builds(Estimate.within, NUMBERS, WIDTHS)


def test_an_exact_number_has_no_bar() -> None:
    number = Estimate.exact(3.5)
    assert (number.value, number.low, number.high) == (3.5, 3.5, 3.5)
    assert (number.numerical, number.model, number.bar) == (0.0, 0.0, 0.0)
    assert number.bounded


def test_an_infinite_load_is_exact_but_not_bounded() -> None:
    number = Estimate.exact(math.inf)
    assert number.bar == 0.0
    assert not number.bounded


@given(value=NUMBERS, numerical=WIDTHS)
def test_within_puts_the_bar_on_either_side_and_calls_it_numerical(value: float, numerical: float) -> None:
    number = Estimate.within(value, numerical)
    assert (number.low, number.value, number.high) == (value - numerical, value, value + numerical)
    assert (number.numerical, number.model) == (numerical, 0.0)
    assert number.bar == pytest.approx(numerical, rel=1e-12, abs=1e-3)  # abs: rounding of value +- bar


def test_an_unknown_number_may_be_anything() -> None:
    number = Estimate.unknown(7.0)
    assert (number.value, number.low, number.high) == (7.0, -math.inf, math.inf)
    assert (number.bar, number.model) == (math.inf, math.inf)
    assert not number.bounded


def test_an_unknown_number_need_not_have_a_value() -> None:
    assert math.isnan(Estimate.unknown().value)
    assert not Estimate.unknown().bounded
    assert Estimate.unknown().bar == math.inf


@given(number=ESTIMATES)
def test_widening_by_nothing_changes_nothing(number: Estimate) -> None:
    assert number.widened(NOTHING) == number


@given(number=ESTIMATES, offset=OFFSETS)
def test_widening_moves_each_end_by_its_own_side(number: Estimate, offset: Interval) -> None:
    wide = number.widened(offset)
    assert wide.value == number.value
    assert wide.low == number.low + offset.low
    assert wide.high == number.high + offset.high
    assert wide.low <= number.low <= number.high <= wide.high


@given(number=ESTIMATES, offset=OFFSETS)
def test_widening_is_model_error_by_its_larger_side(number: Estimate, offset: Interval) -> None:
    wide = number.widened(offset)
    assert wide.numerical == number.numerical
    assert wide.model == number.model + max(abs(offset.low), abs(offset.high))


@given(number=ESTIMATES, first=OFFSETS, second=OFFSETS)
def test_widening_twice_is_widening_by_the_sum(number: Estimate, first: Interval, second: Interval) -> None:
    twice, once = number.widened(first).widened(second), number.widened(first + second)
    assert (twice.low, twice.high) == (pytest.approx(once.low, abs=1e-3), pytest.approx(once.high, abs=1e-3))
    assert twice.model >= once.model - 1e-3  # two one-sided offsets may lie on different sides


@pytest.mark.parametrize("value", [math.inf, -math.inf])
def test_an_infinite_number_widened_by_anything_is_anything(value: float) -> None:
    wide = Estimate.exact(value).widened(ANYTHING)
    assert (wide.value, wide.low, wide.high) == (value, -math.inf, math.inf)


def test_a_number_widened_by_anything_is_not_bounded() -> None:
    wide = Estimate.within(5.0, 0.1).widened(ANYTHING)
    assert (wide.low, wide.high) == (-math.inf, math.inf)
    assert (wide.bar, wide.model) == (math.inf, math.inf)
    assert not wide.bounded


@pytest.mark.parametrize("offset", [Interval(0.0, math.inf), Interval(-math.inf, 0.0)])
def test_a_number_open_to_one_side_is_not_bounded(offset: Interval) -> None:
    wide = Estimate.exact(5.0).widened(offset)
    assert wide.bar == math.inf
    assert not wide.bounded


@given(value=NUMBERS, below=WIDTHS, above=WIDTHS)
def test_the_bar_is_the_larger_side(value: float, below: float, above: float) -> None:
    assume(value - below < value + above)
    number = Estimate(value, value - below, value + above)
    assert number.bar == pytest.approx(max(below, above), rel=1e-12, abs=1e-3)  # abs: rounding of value +- bar


def test_the_bar_of_a_one_sided_number_is_not_halved() -> None:
    assert Estimate.exact(134.2).widened(Interval(0.0, 134.2)).bar == pytest.approx(134.2)


@given(first=OFFSETS, second=OFFSETS)
def test_offsets_add_end_by_end(first: Interval, second: Interval) -> None:
    total = first + second
    assert (total.low, total.high) == (first.low + second.low, first.high + second.high)
    assert total == second + first
    assert total.width == pytest.approx(first.width + second.width)


@pytest.mark.parametrize(
    ("interval", "bounded", "width"),
    [
        (NOTHING, True, 0.0),
        (Interval(-1.0, 3.0), True, 4.0),
        (Interval(0.0, math.inf), False, math.inf),
        (Interval(-math.inf, 0.0), False, math.inf),
        (ANYTHING, False, math.inf),
    ],
)
def test_an_interval_is_bounded_when_both_ends_are(interval: Interval, bounded: bool, width: float) -> None:
    assert interval.bounded is bounded
    assert interval.width == width


def test_nothing_and_anything_under_addition() -> None:
    some = Interval(-1.0, 2.0)
    assert some + NOTHING == some
    assert some + ANYTHING == ANYTHING


def test_a_number_is_frozen() -> None:
    with pytest.raises(AttributeError):
        Estimate.exact(1.0).value = 2.0  # type: ignore[misc]
