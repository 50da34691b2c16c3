"""What a march keeps of its way: when it is read, what it counts, and that no unit changes what it finds."""

import math

import numpy as np
import pytest
from support.modes import Modes, Part, turning

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics import record as records
from ptmcalc.numerics.flow import Flow
from ptmcalc.numerics.piecewise import march
from ptmcalc.numerics.record import Record

SLOW, FAST = 1.0, 0.3
SPEED = 300.0


def swings(size: float = 1.0) -> tuple[Modes, np.ndarray]:
    """x'' = -x beside y'' = -(300)^2 y, watched together; both begin at rest, at 1 and 0.3 of a size."""
    rate = np.zeros((5, 5))
    rate[:2, :2], rate[2:4, 2:4] = turning(1.0), [[0.0, SPEED], [-SPEED, 0.0]]
    system = Modes({"swing": Part(rate)}, np.array([[1.0, 0, 1.0, 0, 0]]), 4, products=((0, 0),), sizes=(1.0,) * 5)
    return system, np.array([SLOW * size, 0.0, FAST * size, 0.0, 1.0])


def fresh(products: int = 0) -> Record:
    return Record.starting(np.array([3.0, -4.0]), np.zeros((products, 2), dtype=np.intp), keep=False)


def test_nothing_has_happened_at_the_start() -> None:
    record = fresh(products=3)
    assert (record.steps, record.long, record.crossings, record.looks, record.work) == (0, 0, 0, 0, 0)
    assert (record.time, record.lost, record.events, record.finished) == (0.0, 0.0, [], False)
    assert (record.state.size, record.unsought.size) == (0, 0)
    assert record.last.tolist() == [3.0, -4.0]
    assert record.sizes().tolist() == [3.0, 4.0]
    assert record.integrals.tolist() == [0.0, 0.0, 0.0]


def test_a_long_panel_takes_as_long_as_fifteen_and_a_crossing_as_sixty() -> None:
    record = fresh()
    record.steps, record.long, record.crossings = 10, 3, 2
    assert record.work == 7 + 3 * 15 + 2 * 60


def test_panels_are_read_when_many_have_come_and_their_sizes_at_once() -> None:
    """x' = -100 x from 5, by panels of ten microseconds."""
    flow = Flow(np.array([[-100.0]]), np.zeros((0, 1)), np.array([[1.0], [-2.0]]), 1)
    record = fresh()
    read = []
    for k in range(100):
        states = 5.0 * np.exp(-1e-3 * (4.0 * k + np.arange(4.0)))[:, None]
        record.see(flow, 4e-5 * k, 1e-5, states)
        assert record.sizes() == pytest.approx([5.0, 10.0], rel=1e-15)
        read.append(record.steps)
    assert 0 < sum(steps == 0 for steps in read) < 100
    assert np.count_nonzero(np.diff(read)) < 10, "many at once"
    assert read[-1] > 0
    record.close()


def test_sizes_are_of_all_that_has_come_however_seldom_they_are_asked_for() -> None:
    """What stays as it is, x' = 0, at another place in each panel: ever farther in every second one."""
    flow = Flow(np.zeros((1, 1)), np.zeros((0, 1)), np.array([[1.0], [-2.0]]), 1)
    for every in (1, 2, 3, 64):
        record = fresh()
        for k in range(400):
            record.see(flow, 1e-5 * k, 1e-5, np.array([[10.0 + k if k % 2 == 0 else 1.0]]))
            if k % every == every - 1:
                most = 10.0 + k - k % 2
                assert record.sizes() == pytest.approx([most, 2 * most], rel=1e-15)


def test_the_end_is_that_of_what_ends_last_whenever_it_is_read() -> None:
    """x' = -100 x from 5: a long panel, one that ends before it does, and one that goes on from there."""
    flow = Flow(np.array([[-100.0]]), np.zeros((0, 1)), np.array([[1.0], [-2.0]]), 1)
    record = fresh()
    for start, panel, end in ((0.0, 8e-3, 8e-3), (5e-3, 1e-3, 8e-3), (8e-3, 1e-3, 9e-3)):
        record.see(flow, start, panel, np.array([[5.0 * math.exp(-100 * start)]]))
        record.settle()
        assert record.last == pytest.approx(np.array([5.0, -10.0]) * math.exp(-100 * end), rel=1e-12)


@pytest.mark.parametrize("size", [1e-9, 1e-5, 1e7])
def test_the_unit_of_a_signal_does_not_matter(size: float) -> None:
    """Both summits and the work, of a motion that only long panels can pass over and only looks between them read."""
    system, start = swings(size)
    found = march(system, "swing", start, 10.0)
    assert found.long > 0
    fine = np.linspace(math.pi - 0.05, math.pi + 0.05, 200_001)
    both = SLOW * np.cos(fine) + FAST * np.cos(SPEED * fine)
    assert found.top.values[0] / size == pytest.approx(SLOW + FAST, rel=1e-11)
    assert found.bottom.values[0] / size == pytest.approx(both.min(), rel=1e-8)

    def half(w: float) -> float:
        return math.sin(10.0 * w) / w

    squares = SLOW**2 * (5.0 + half(2.0) / 2) + FAST**2 * (5.0 + half(2 * SPEED) / 2)
    mixed = SLOW * FAST * (half(SPEED + 1) + half(SPEED - 1))
    assert found.integrals[0] / size**2 == pytest.approx(squares + mixed, rel=1e-11)


def test_looks_are_few_and_given_up_where_they_are_too_many(monkeypatch: pytest.MonkeyPatch) -> None:
    """A round of looks counts as forty of them."""
    rounds = 0
    divided = records._divided

    def counted(panels: list) -> object:
        nonlocal rounds
        rounds += 1
        return divided(panels)

    monkeypatch.setattr(records, "_divided", counted)
    system, start = swings()
    found = march(system, "swing", start, 10.0)
    asked = found.looks + 40 * rounds
    assert 0 < found.looks < 200
    assert march(system, "swing", start, 10.0, most_looks=asked).looks == found.looks
    with pytest.raises(NumericsError, match="cannot be separated"):
        march(system, "swing", start, 10.0, most_looks=asked - 1)


def test_long_panels_are_read_when_many_have_come(monkeypatch: pytest.MonkeyPatch) -> None:
    """They cost the same one by one and together, but for some twenty calls each time."""
    read: list[int] = []
    look = Record._look

    def counted(record: Record) -> None:
        read.append(sum(len(one.starts) for one in record._passed))
        look(record)

    monkeypatch.setattr(Record, "_look", counted)
    system, start = swings()
    found = march(system, "swing", start, 3000.0)
    assert found.long > 5000
    assert min(read[:20]) > 100, "those that follow are looks again"


def test_a_march_that_is_given_up_says_what_it_took() -> None:
    """Some microseconds a panel."""
    system, start = swings()
    with pytest.raises(NumericsError, match="given up") as raised:
        march(system, "swing", start, 1e6, most_work=1000.0)
    assert 1e-4 < raised.value.spent < 0.1
