"""Components of a motion that an input drives at its own frequency or rate: they are not told apart."""

import math
from decimal import Decimal, localcontext

import numpy as np
import pytest
from support.machines import load_of, report_of, scene_of

from ptmcalc.numerics.components import components

OSCILLATOR = np.array([[0.0, 1.0], [-576.0, 0.0]])


def driven(input_rates: np.ndarray) -> np.ndarray:
    """x'' + 576 x = first input."""
    n = len(input_rates)
    rate = np.zeros((2 + n, 2 + n))
    rate[:2, :2], rate[2:, 2:], rate[1, 2] = OSCILLATOR, input_rates, 1.0
    return rate


@pytest.mark.parametrize(("beside", "alike"), [(0.0, True), (1e-15, True), (1e-9, True), (1e-3, False), (0.5, False)])
def test_an_oscillator_beside_the_frequency_of_its_input(beside: float, alike: bool) -> None:
    w = 24.0 * (1 + beside)
    found = components(driven(np.array([[0.0, w], [-w, 0.0]])), np.eye(4), 2)
    assert found.posed.tolist() == [not alike], "of a number and its conjugate, one"
    slowest, fastest = found.span(np.array([1.0, 0.0, 1.0, 0.0]), 1e-11, np.zeros(0))
    assert (slowest, fastest) == pytest.approx((24.0, 24.0))


def test_a_decay_at_the_rate_of_its_input() -> None:
    rate = np.array([[-3.0, 1.0], [0.0, -3.0]])
    assert not components(rate, np.eye(2), 1).posed.any()


@pytest.mark.parametrize("cycles", [50, 400, 1000])
def test_a_long_resonance_through_the_whole_check(cycles: int) -> None:
    """x = F/(2 w^2) (sin w t - w t cos w t), over as many radians as ask whether something has faded."""
    time = 2 * math.pi * cycles / 24
    data = {
        "kind": "drivetrain",
        "inertias": {"body": {"inertia": "1 kg*m^2"}},
        "links": {"spring": {"between": ["body", "ground"], "stiffness": "576 N*m/rad"}},
        "torques": {"t": {"at": "body", "type": "sine", "amplitude": "1 N*m", "angular_frequency": "24 rad/s"}},
        "scenes": [{"type": "run", "duration": f"{time!r} s"}],
    }
    one = load_of(scene_of(report_of(data)), "angle_end[body]").estimate
    assert one.value == pytest.approx(-time / 2 / 24, rel=1e-9)
    assert one.low <= -time / 2 / 24 * (1 - 1e-12)
    assert one.high >= -time / 2 / 24 * (1 + 1e-12)


def dashpot_on_a_column(damping: float) -> np.ndarray:
    """M w'' + C w' + K w = 0, w the way of a base of 5 t and the lowest mode of its column, C of a dashpot between the
    column's far end and a wall; the state is w, w'."""
    masses, far = np.array([[5000.0, 70.0], [70.0, 1.0]]), np.array([1.0, 0.03])
    springs = np.diag([1.0, 5e5])
    rate = np.zeros((4, 4))
    rate[:2, 2:] = np.eye(2)
    rate[2:, :2] = -np.linalg.solve(masses, springs)
    rate[2:, 2:] = -np.linalg.solve(masses, damping * np.outer(far, far))
    return rate


def dominant(matrix: np.ndarray) -> list[Decimal]:
    """The eigenvector of the largest eigenvalue by the power method in sixty digits."""
    rows = [[Decimal(entry) for entry in row] for row in matrix.tolist()]
    vector = [Decimal(1)] * len(rows)
    for _ in range(40):
        vector = [sum((a * x for a, x in zip(row, vector, strict=True)), Decimal(0)) for row in rows]
        largest = max(vector, key=abs)
        vector = [x / largest for x in vector]
    return vector


@pytest.mark.parametrize("damping", [1e6, 1e9, 1e12])
def test_a_dashpot_that_has_faded_is_not_seen_in_a_motion_of_hundreds_of_metres(damping: float) -> None:
    """Its left eigenvector has entries of 1 and of 1e-12, and those count as well: times hundreds of metres."""
    rate = dashpot_on_a_column(damping)
    with localcontext(prec=60):
        left, right = dominant(rate.T), dominant(rate)
        state = [Decimal(one) for one in (358.5, -358.3, 2.6e-3, -1.4)]
        share = sum(w * z for w, z in zip(left, state, strict=True))
        share /= sum(w * v for w, v in zip(left, right, strict=True))
        slow = np.array([float(z - share * v) for z, v in zip(state, right, strict=True)])
        there = np.array([float(z + v) for z, v in zip(state, right, strict=True)])
    found = components(rate, np.eye(4), 4)
    fastest = int(found.speeds.argmax())
    assert found.posed[fastest]
    assert found.amplitudes(slow)[fastest] == 0
    assert found.amplitudes(there)[fastest] != 0
