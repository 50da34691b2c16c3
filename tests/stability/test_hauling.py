"""Loads hauled on uneven drums far from any hoist: a finite answer with a bar that its bound holds, or a refusal."""

import math

import numpy as np
import pytest

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.hauling import Map, Rope, haul, largest_possible


@pytest.mark.parametrize("seed", range(60))
def test_any_machine_is_computed_or_refused(seed: int) -> None:
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 12))
    angles = np.concatenate([[0.0], np.cumsum(10 ** rng.uniform(-6, 2, count))])
    radii = 10 ** rng.uniform(-3, 1) * (1 + 10 ** rng.uniform(-9, 0.5) * rng.uniform(0, 1, count + 1))
    damping = float(rng.choice([0.0, 1e-12, 0.02, 0.9999, 1.0]))
    rope = Rope(10 ** rng.uniform(-2, 5), 10 ** rng.uniform(-3, 8), 10 ** rng.uniform(-8, -1), damping)
    speed = 10 ** rng.uniform(-5, 4)
    try:
        motion = haul(Map(angles, radii), speed, rope)
    except NumericsError:
        return
    most, least = motion.extremes()
    assert all(map(math.isfinite, (most.value, most.time, most.error, least.value, least.time, least.error)))
    assert most.error >= 0 <= least.error
    times = np.linspace(0, motion.times[-1], 3001)
    force, bar = motion.at(times)[1], motion.bar(times)
    assert np.all(force <= (most.value + most.error) * (1 + 1e-9) + 1e-300)
    assert np.all(force >= (least.value - least.error) * (1 + 1e-9) - 1e-300)
    assert np.all(np.abs(force) - bar <= largest_possible(Map(angles, radii), speed, rope) * (1 + 1e-9))


def test_no_share_of_the_answer_is_lost_in_a_small_climb() -> None:
    """A climb 1e-9 of the radius: the strain follows it with all its digits, as it is linear."""
    angles = np.array([0.0, 1.0, 2.0, 9.0])
    rope = Rope(1e4, 4e4, 1e-3, 0.0)
    found = [
        haul(Map(angles, np.array([1.0, 1.0, 1.0 + climb, 1.0 + climb])), 1.0, rope).extremes()[0].value / climb
        for climb in (2.0**-30, 2.0**-12)
    ]
    assert found[0] == pytest.approx(found[1], rel=1e-3)
