"""Where verdicts change along the keys of a grid: every stretch of one verdict, also of what is open."""

from pathlib import Path

import numpy as np
import pytest

from ptmcalc.base.errors import UsageError
from ptmcalc.base.span import Span
from ptmcalc.base.units import FORCE, RATIO, SPEED
from ptmcalc.contract.check import Sense
from ptmcalc.contract.study import Points, Said, Track, VariedKey
from ptmcalc.engine.load import load_file
from ptmcalc.engine.sweep import Axis, axis, grid, hypercube, turnings
from ptmcalc.report.study import sweep_table

SPEED_KEY = VariedKey(("speed",), SPEED, 1.0, Span(1, 1))
LAYERS = VariedKey(("drum", "layers"), RATIO, 1, Span(2, 1), whole=True)
P, F, U, N = Said.PASS, Said.FAIL, Said.UNDECIDED, Said.NOT_COMPUTED
HOIST = load_file(Path(__file__).parents[1] / "edges" / "tools" / "solve-layers.yaml", "hoist.yaml")


def swept(given: list[Axis], said: list[Said], margin: list[float] | None = None) -> Points:
    points = Points([one.key for one in given], grid(given))
    values = np.array(margin if margin is not None else [{P: 1.0, F: -1.0}.get(one, np.nan) for one in said])
    track = Track("run", "TOY101", "", "a pull", Sense.AT_LEAST, FORCE, np.array(said, np.int8), values, 0 * values)
    points.tracks["run", "TOY101", ""] = track
    return points


def stretches(
    given: list[Axis], said: list[Said], margin: list[float] | None = None
) -> list[tuple[Said, float, float]]:
    (one,) = turnings(swept(given, said, margin), given)
    return [(stretch.said, stretch.low, stretch.high) for stretch in one.stretches]


def test_every_window_is_listed_and_ends_where_the_margin_is_0() -> None:
    line = [Axis(SPEED_KEY, 0.0, 4.0, 5, log=False)]
    found = stretches(line, [P, F, P, P, F], [3.0, -1.0, 1.0, 1.0, -3.0])
    assert found == [
        (P, 0.0, pytest.approx(0.75)),
        (F, pytest.approx(0.75), pytest.approx(1.5)),
        (P, pytest.approx(1.5), pytest.approx(3.25)),
        (F, pytest.approx(3.25), 4.0),
    ]


def test_what_is_open_is_a_stretch_of_its_own() -> None:
    line = [Axis(SPEED_KEY, 0.0, 4.0, 5, log=False)]
    points = swept(line, [F, U, U, P, N])
    (one,) = turnings(points, line)
    assert [(s.said, s.low, s.high) for s in one.stretches] == [(F, 0, 0.5), (U, 0.5, 2.5), (P, 2.5, 3.5), (N, 3.5, 4)]
    assert (one.above, one.below, one.least, one.most) == (1, 0, 0.5, 3.5)
    table = sweep_table("a.yaml", points, [], [one], 200)
    assert (
        "passes 2.5 m/s to 3.5 m/s; fails 0 m/s to 0.5 m/s; undecided 0.5 m/s to 2.5 m/s; not computed 3.5 m/s to 4 m/s"
    ) in table


def test_a_verdict_that_only_becomes_undecided_is_told_too() -> None:
    line = [Axis(SPEED_KEY, 0.0, 1.0, 2, log=False)]
    (one,) = turnings(swept(line, [P, U]), line)
    assert (one.above, one.below, one.least, one.most) == (0, 0, 0.5, 0.5)
    assert turnings(swept(line, [U, U]), line) == []


def test_a_range_that_falls_is_told_by_rising_values() -> None:
    line = [Axis(SPEED_KEY, 4.0, 0.0, 5, log=False)]
    points = swept(line, [P, P, P, F, F])
    (one,) = turnings(points, line)
    assert [(s.said, s.low, s.high) for s in one.stretches] == [(F, 0, 1.5), (P, 1.5, 4)]
    assert (one.above, one.below) == (1, 0)
    assert "passes from 1.5 m/s" in sweep_table("a.yaml", points, [], [one], 200)


def test_equal_ratios_end_in_their_middle() -> None:
    line = [Axis(SPEED_KEY, 1.0, 16.0, 3, log=True)]
    assert [high for _, _, high in stretches(line, [P, P, F])] == [pytest.approx(8.0), pytest.approx(16.0)]


def test_each_line_of_a_grid_has_its_stretches() -> None:
    given = [Axis(SPEED_KEY, 0.0, 1.0, 2, log=False), Axis(LAYERS, 1.0, 3.0, 3, log=False)]
    points = swept(given, [F, P, P, P, P, F])
    by_key = {one.key.name: one for one in turnings(points, given)}
    assert [(s.said, s.low, s.high, s.others) for s in by_key["drum.layers"].stretches] == [
        (F, 1, 1, (0.0,)),
        (P, 2, 3, (0.0,)),
        (P, 1, 2, (1.0,)),
        (F, 3, 3, (1.0,)),
    ]
    assert (by_key["drum.layers"].above, by_key["drum.layers"].below) == (1, 1)
    assert [(s.line, s.others) for s in by_key["speed"].stretches] == [(0, (1.0,))] * 2 + [(2, (3.0,))] * 2
    table = sweep_table("a.yaml", points, [], list(by_key.values()), 200)
    assert "pass, fail: changes at 2   (on 2 of 2 lines; --format json has each)" in table
    assert "pass, fail: changes at 0.5 m/s   (on 2 of 3 lines; --format json has each)" in table


def test_a_key_of_whole_numbers_varies_by_whole_numbers() -> None:
    one = axis(HOIST, "drum.layers=1:4:4", counted=True)
    assert grid([one])[:, 0].tolist() == [1, 2, 3, 4]
    assert grid([axis(HOIST, "drum.layers=1:9:3", counted=True)])[:, 0].tolist() == [1, 5, 9]
    drawn = hypercube([axis(HOIST, "drum.layers=1:4", counted=False)], 400, 0)[:, 0]
    assert {int(number): int(np.count_nonzero(drawn == number)) for number in drawn} == dict.fromkeys((1, 2, 3, 4), 100)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("drum.layers=1:4:3", "takes whole numbers, and some of these values are not whole numbers"),
        ("drum.layers=1:4:4:log", "takes whole numbers, and some of these values are not whole numbers"),
        ("drum.layers=1.5:4:4", "and `1.5` is not one"),
        ("drum.layer=1:4:4", "is not a numerical key"),
    ],
)
def test_what_is_no_whole_number_is_refused(text: str, reason: str) -> None:
    with pytest.raises(UsageError, match=reason):
        axis(HOIST, text, counted=True)
