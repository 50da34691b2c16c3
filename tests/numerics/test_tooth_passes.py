"""Sums of modes under passing teeth: engagements, kinks and groups, against DOP853 stopped at every edge."""

import itertools
import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics import tooth_passes as module
from ptmcalc.numerics.tooth_passes import engagements, passes, tooth_passes

W, ZETA = np.array([9.0, 31.0, 70.0]), np.array([0.02, 0.05, 1.4])
GAINS = np.array([[1.0, 0.4], [0.3, -0.2], [0.1, 0.1]])
SHARES = np.array([1.0, 0.5, -0.7])
WINDOW = 4.0


def pitches(t: np.ndarray) -> np.ndarray:
    return np.asarray(0.4 * t + 0.9 * t**2)


def place(times: np.ndarray, middles: np.ndarray) -> np.ndarray:
    return np.asarray(pitches(times) - np.floor(pitches(middles))[:, None] - 0.5)


def inputs(times: np.ndarray, middles: np.ndarray) -> np.ndarray:
    """A saw with a jump at every whole pitch, differently strong in every mode."""
    return np.asarray((-np.sin(place(times, middles)) * (1 + times))[:, :, None] * SHARES)


def direct(times: np.ndarray, middles: np.ndarray) -> np.ndarray:
    return np.asarray(np.stack([0.05 * times, np.zeros_like(times)], axis=-1))


def edges() -> np.ndarray:
    return passes(WINDOW, engagements(pitches, WINDOW, 0.0), np.array([1.7]))


def by_dop853() -> np.ndarray:
    """Both sums, densely."""
    state, found, marks = np.zeros(6), [], edges()
    for low, high in itertools.pairwise(marks.tolist()):
        middle = np.array([(low + high) / 2])

        def motion(t: float, y: np.ndarray, middle: np.ndarray = middle) -> np.ndarray:
            a = inputs(np.array([[t]]), middle)[0, 0]
            return np.concatenate([y[3:], -a - 2 * ZETA * W * y[3:] - W**2 * y[:3]])

        times = np.linspace(low, high, 400)
        run = solve_ivp(motion, (low, high), state, "DOP853", times, rtol=1e-11, atol=1e-13)
        x = -(W[:, None] ** 2 * run.y[:3] + 2 * (ZETA * W)[:, None] * run.y[3:])
        found.append(GAINS.T @ x + np.stack([0.05 * times, np.zeros_like(times)]))
        state = run.y[:, -1]
    return np.concatenate(found, axis=1)


def test_engagements_are_where_the_way_is_whole() -> None:
    times = engagements(pitches, WINDOW, 0.3)
    assert pitches(times) + 0.3 == pytest.approx(np.arange(1, len(times) + 1), rel=1e-12)
    assert len(times) == math.floor(0.4 * 4 + 0.9 * 16 + 0.3)


def test_passes_end_at_engagements_kinks_and_window() -> None:
    found = edges()
    assert found[0] == 0
    assert found[-1] == WINDOW
    assert 1.7 in found
    assert np.all(np.diff(found) > 0)
    assert len(found) == len(engagements(pitches, WINDOW, 0.0)) + 2, "the last joint engages as the window ends"


@pytest.mark.parametrize("group", [200_000, 500])
def test_extremes_are_those_of_dop853(group: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever the passes are grouped into."""
    monkeypatch.setattr(module, "_GROUP", group)
    found, expected = tooth_passes(edges(), inputs, W, ZETA, GAINS, direct), by_dop853()
    for value, time, extreme in (
        (found.largest, found.largest_time, expected.max(axis=1)),
        (found.smallest, found.smallest_time, expected.min(axis=1)),
    ):
        assert np.all(np.abs(value - extreme) <= found.error + 1e-6)
        assert value == pytest.approx(extreme, rel=1e-2)
        assert np.all((time > 0) & (time <= WINDOW))
    assert np.all(found.error < 0.06 * found.largest)


def test_a_sum_never_rises_above_what_its_modes_followed() -> None:
    found = tooth_passes(edges(), inputs, W, ZETA, GAINS)
    assert np.all(found.largest <= np.abs(GAINS).T @ found.followed + 1e-12)


@pytest.mark.parametrize("group", [200_000, 500])
def test_the_work_is_the_places_looked_at_of_every_mode(group: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "_GROUP", group)
    looked, inside = [], []

    def seen(times: np.ndarray, middles: np.ndarray) -> np.ndarray:
        looked.append(times.size)
        inside.extend(middles.tolist())
        return direct(times, middles)

    found = tooth_passes(edges(), inputs, W, ZETA, GAINS, seen)
    assert found.work == len(W) * sum(looked)
    assert (len(looked) > 1) == (group == 500)
    assert inside == pytest.approx((edges()[1:] + edges()[:-1]) / 2, rel=1e-14)


@pytest.mark.parametrize(("turn", "stretches"), [(3.0, 8), (15.9, 8), (16.1, 9), (100.0, 50), (100.1, 51)])
@pytest.mark.parametrize("zeta", [0.02, 1.5])
@pytest.mark.parametrize("time", [1e-4, 1.0, 1e4])
def test_the_fastest_mode_turns_or_fades_by_2_over_a_stretch_and_eight_are_the_fewest(
    time: float, turn: float, stretches: int, zeta: float
) -> None:
    """Told by the work: the places looked at of both modes, whatever the time of a pass."""
    w = np.array([turn / max(1.0, 2 * zeta), 0.1]) / time
    one = tooth_passes(np.array([0.0, time]), lambda t, _: np.ones((*t.shape, 2)), w, np.array([zeta, 0.0]), np.eye(2))
    assert one.work == 2 * (stretches + 1)


def test_the_error_told_is_that_of_gauss_with_six_nodes() -> None:
    """Exact up to a power of 11; of the next one n!^4/((2 n + 1) (2 n)!^2) is missed in the speed of a free mass."""

    def told(power: int) -> float:
        one = tooth_passes(
            np.array([0.0, 8.0, 16.0]), lambda t, _: np.mod(t, 1.0)[..., None] ** power, np.array([1e-9]), np.zeros(1),
            np.array([[3.0]]),
        )  # fmt: skip
        return float(one.error[0])

    missed = 3 * math.factorial(6) ** 4 / (13 * math.factorial(12) ** 2)
    assert told(11) <= 1e-5 * missed
    assert told(12) == pytest.approx(16 * missed, rel=1e-5)


def test_what_may_rise_above_a_sample_is_twice_what_a_parabola_does() -> None:
    """That rises by a quarter of its bend where its summit lies half way between two of them; at the ends of a pass the
    bend is that of the samples beside."""
    x = np.arange(9.0)
    bends = np.array([0.7, 3.0])
    sums = np.stack([-bends * (x[:, None] - 4.5) ** 2, 5 - bends * (x[:, None] - 4.5) ** 2])
    for where in (np.array([4, 5]), np.array([9 + 4, 9 + 5]), np.array([0, 17])):
        assert module._risen(sums, where) == pytest.approx(2 * bends * 0.5**2, rel=1e-12)
    cubic = np.stack([(x[:, None] - 1.0) ** 3] * 2)  # bends by 6 (x - 1)
    for where, beside in ((0, 1), (1, 1), (2, 2), (6, 6), (7, 7), (8, 7), (9, 1), (16, 7), (17, 7)):
        assert module._risen(cubic, np.array([where])) == pytest.approx(6 * (beside - 1) / 4)


def test_kinks_that_are_one_but_for_rounding_are_one() -> None:
    assert len(passes(4.0, np.array([1.0, 1.0 + 1e-11, 3.0]))) == 5
    assert len(passes(4.0, np.array([1.0, 1.0 + 1e-13, 3.0]))) == 4
    assert passes(4.0, np.array([-1.0, 5.0])).tolist() == [0.0, 4.0]


def test_twenty_thousand_teeth_are_the_most() -> None:
    assert len(engagements(lambda t: 2000.0 * t, 10.0, 0.0)) == 20_000
    with pytest.raises(NumericsError, match="20001 tooth passes"):
        engagements(lambda t: 2000.0 * t, 10.0, 1.0)


def test_too_many_teeth_say_so() -> None:
    with pytest.raises(NumericsError, match="tooth passes"):
        engagements(lambda t: 1e9 * t, 10.0, 0.0)
