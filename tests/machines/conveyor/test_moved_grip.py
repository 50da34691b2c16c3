"""How far the grip of a drum may be off: tensions moved by all they may be, against what is told of it."""

import math

import numpy as np
import pytest

from ptmcalc.base.estimate import ANYTHING, NOTHING, Estimate
from ptmcalc.machines.conveyor.traction.bounds import moved_grip

CASES = 300


def worst_grip(on: np.ndarray, off: np.ndarray, lift: float, exponent: float) -> float:
    """The grip used, over that of Euler and Eytelwein."""
    one, other = on - lift, off - lift
    return float(np.max(np.maximum(one, other) / np.minimum(one, other)) * math.exp(-exponent))


def worst_reserve(on: np.ndarray, off: np.ndarray, exponent: float) -> float:
    """Friction force that the slack side allows over the one that is transmitted."""
    allowed = np.minimum(on, off) * math.expm1(exponent)
    return float(np.min(allowed / np.abs(on - off)))


@pytest.mark.parametrize("takeup", ["constant", "free"])
def test_no_grip_of_tensions_that_are_off_lies_outside(takeup: str) -> None:
    rng = np.random.default_rng(20261124)
    nearest = {"slip_utilisation_max": 0.0, "slip_reserve_min": 0.0}
    for _ in range(CASES):
        exponent, lift = rng.uniform(0.8, 2.5), rng.uniform(0.0, 3.0)
        off = np.full(40, rng.uniform(20, 60)) if takeup == "constant" else rng.uniform(20, 60, 40)
        on = off * rng.uniform(0.5, 1.0 + rng.uniform(0.1, 0.9) * (math.exp(exponent) - 1), 40)
        change = rng.uniform(0.1, 6.0)
        change_off = 0.0 if takeup == "constant" else change
        loads = {
            "slip_utilisation_max[head]": Estimate.exact(worst_grip(on, off, lift, exponent)),
            "slip_reserve_min[head]": Estimate.exact(worst_reserve(on, off, exponent)),
            "tension_run_off_min[head]": Estimate.exact(float(off.min())),
            "tension_min": Estimate.exact(float(min(on.min(), off.min()))),
            "tension_max": Estimate.exact(float(max(on.max(), off.max()))),
        }
        told = {
            name: loads[f"{name}[head]"].widened(
                moved_grip(f"{name}[head]", loads, lift, {"head": exponent}, change, change_off)
            )
            for name in nearest
        }
        moves = [(1.0, -1.0), (-1.0, 1.0), *rng.uniform(-1, 1, (6, 2))]
        for by_on, by_off in moves:
            there, slack = on + by_on * change, off + by_off * change_off
            found = worst_grip(there, slack, lift, exponent), worst_reserve(there, slack, exponent)
            for (name, one), value in zip(told.items(), found, strict=True):
                assert one.low * (1 - 1e-12) <= value <= one.high * (1 + 1e-12), name
                room = one.high - one.value if value > one.value else one.value - one.low
                nearest[name] = max(nearest[name], abs(value - one.value) / room if room else 0.0)
    assert min(nearest.values()) > 0.99  # no wider than what a tension may be


def test_what_transmits_nothing_stays_without_end_as_long_as_a_side_is_taut() -> None:
    """Four hundred turns hold whatever their tensions are; where only nothing is transmitted, a little may be."""
    loads = {
        "slip_reserve_min": Estimate.exact(math.inf),
        "tension_run_off_min": Estimate.exact(50.0),
        "tension_min": Estimate.exact(50.0),
        "tension_max": Estimate.exact(90.0),
    }
    assert moved_grip("slip_reserve_min", loads, 0.0, {"head": 880.0}, 4.0, 0.0) == NOTHING
    one = moved_grip("slip_reserve_min", loads, 0.0, {"head": 1.2}, 4.0, 0.0)
    assert (one.low, one.high) == (-math.inf, 0.0)
    slack = loads | {"slip_utilisation_max": Estimate.exact(math.inf)}
    assert moved_grip("slip_utilisation_max", slack, 0.0, {"head": 1.2}, 4.0, 0.0) == ANYTHING
