"""Lanes: the numbers a plain float would give, lane by lane, whichever branch each takes; and nothing in silence."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from ptmcalc.numerics import lanes
from ptmcalc.numerics.lanes import Lanes, LanesError, SplitError, parted

X = np.array([-2.5, -1.0, -0.0, 0.5, 1.0, 3.0])
Y = np.array([1.5, -1.0, 2.0, -0.5, 4.0, 3.0])


@pytest.mark.parametrize(
    "formula",
    [
        lambda x, y: x + y - 2 * x * y / 3,
        lambda x, y: 1 / (x * x + y**2 + 1) - (-x) + abs(y),
        lambda x, y: 2**x + (4 - x) * (1 + +y),
        lambda x, y: np.maximum(x, 0.25) * np.exp(-y) + np.sin(x),
        lambda x, y: lanes.exp(x) + lanes.expm1(y) + lanes.sqrt(x * x) + lanes.cos(x) + lanes.tan(y) + lanes.sin(x),
        lambda x, y: lanes.asin(x / 10) + lanes.number(y),
        lambda x, y: np.sum(np.array([x, 2.0, y]) * np.array([1.0, 2.0, 3.0])),
        lambda x, y: (np.array([1.0, 2.0]) * x + np.add((x, 1.0), (y, y)) - y / np.array([2.0, 4.0]))[1],
        lambda x, y: np.array([1.0, 2.0, 3.0]) @ np.array([x, y, x * y]),
        lambda x, y: np.add(x, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0])[2] + y,
        lambda x, y: lanes.value(lambda a, b: np.where(np.asarray(a) > 0, b, a), x, y),
    ],
)
def test_arithmetic_is_that_of_every_lane(formula: Callable[[Any, Any], Any]) -> None:
    found = formula(Lanes(X), Lanes(Y))
    expected = [float(formula(x, y)) for x, y in zip(X.tolist(), Y.tolist(), strict=True)]
    assert isinstance(found, Lanes)
    np.testing.assert_allclose(found.values, expected, rtol=1e-15, atol=1e-15)


def stick_or_slide(x: Any, y: Any) -> Any:
    """Branches, extremes of Python and of numpy, a loop that ends when it likes."""
    marks = np.array([0.0, x, y + 5.0])
    if x > y:
        return max(x, 2 * y, 0.5) + lanes.interpolated(np.asarray([x]), [-3.0, 0.0, 3.0], np.array([0.0, y, 1.0]))[0]
    steps = 0.0
    while y > 0:
        y, steps = y - 1, steps + 1
    return steps + min(x, y) + int(np.argmax(marks)) + marks.max() + (x or 7.0) + (1 if lanes.alike([x, y]) else 0)


def test_every_lane_goes_the_way_of_its_own_numbers() -> None:
    chance = np.random.default_rng(5)
    x, y = chance.normal(size=300).round(1), chance.normal(size=300).round(1) * 3
    found, runs = np.full(300, math.nan), []

    def compute(where: Any) -> Any:
        runs.append(where.size)
        return lanes.of(stick_or_slide(Lanes(x[where]), Lanes(y[where])), where.size)

    for where, values in parted(np.arange(300), compute, 10_000):
        assert np.isnan(found[where]).all(), "no lane is computed twice"
        found[where] = values
    expected = [stick_or_slide(a, b) for a, b in zip(x.tolist(), y.tolist(), strict=True)]
    np.testing.assert_allclose(found, expected, rtol=1e-14)
    assert 10 < len(runs) < 200, "parts, not lanes"


def test_after_so_many_runs_the_rest_is_left() -> None:
    parts = list(parted(np.arange(8), lambda where: bool(Lanes(X[where % 6]) > 0) or where.size, 2))
    assert sorted(int(k) for where, _ in parts for k in where) == list(range(8))
    assert [found for _, found in parts].count(None) >= 1
    assert list(parted(np.arange(0), lambda where: where, 3)) == []


def test_lanes_that_do_not_agree_part_and_those_that_do_answer() -> None:
    assert bool(Lanes(X) < 10)
    assert not bool(Lanes(X) > 10)
    with pytest.raises(SplitError) as split:
        bool(Lanes(X) > 0.75)
    np.testing.assert_array_equal(split.value.holds, X > 0.75)


@pytest.mark.parametrize(
    "ask",
    [
        float,
        int,
        hash,
        list,
        len,
        range,
        math.exp,
        math.isfinite,
        lambda x: {x: 1},
        lambda x: {x},
        lambda x: np.asarray(x, float),
        lambda x: np.array([x, 1.0], dtype=float),
        lambda x: np.interp(x, [0.0, 1.0], [0.0, 1.0]),
        lambda x: np.exp(np.array([x, x])),
        lambda x: np.add.reduce(x),
        lambda x: np.add(x, 1.0, out=np.zeros(6)),
        lambda x: np.hypot(np.ones(6), np.ones(6), where=x),
        lambda x: f"{x:.3f}",
        lambda x: x + "m",
        lambda x: lanes.value(np.add, x, np.ones(6)),
        lambda x: x.__setitem__(0, 1.0),
    ],
)
def test_what_cannot_be_done_lane_by_lane_is_refused(ask: Callable[[Any], Any]) -> None:
    """In no case one number, or an array in which lanes and elements are mixed up."""
    with pytest.raises((LanesError, TypeError, AttributeError, ValueError)):
        ask(Lanes(X))


def test_floats_stay_what_they_are() -> None:
    assert lanes.exp(0.3) == math.exp(0.3)
    assert lanes.number(np.float64(2.5)) == 2.5
    assert type(lanes.number(np.float64(2.5))) is float
    assert type(lanes.value(np.add, 1.0, 2.0)) is float
    np.testing.assert_array_equal(lanes.of(2.0, 3), [2.0, 2.0, 2.0])
    with pytest.raises(ValueError, match=r"."):
        lanes.sqrt(-1.0)
