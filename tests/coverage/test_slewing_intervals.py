"""Bars of the rigid slewing crane, and of a simulation without gust or curve, against the whole simulation."""

import math
from collections.abc import Mapping
from functools import cache

import numpy as np
import pytest
from support.machines import loaded
from support.slewing_samples import random_crane

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.run import widen

TIGHTER = 1 / 3
_COUNT = 36


@cache
def cheap_and_true(seed: int) -> list[tuple[Mapping[str, Estimate], Mapping[str, Estimate]]]:
    """What every cheaper run says with its bars, beside the richest run's values."""
    read = loaded(random_crane(np.random.default_rng(seed)))
    assert read.kind is not None
    assert read.spec is not None
    planned = plan_scene(read.kind, read.spec, read.spec.all_scenes[0])
    *cheaper, richest = planned.rungs
    assert richest.solver.name == "slew"
    try:
        truth = richest.solver.run(read.spec, planned.scene, richest.carried, richest.level)
    except NumericsError:
        return []
    values = {name: found.estimate for name, found in truth.loads.items()}
    seen = []
    for rung in cheaper:
        result = rung.solver.run(read.spec, planned.scene, rung.carried, rung.level)
        seen.append((widen(planned, read.spec, rung, result), values))
    return seen


def outside(said: Estimate, truth: Estimate, share: float) -> bool:
    """Whether the truth lies outside so much of a bar, rounding aside."""
    slack = 1e-9 * (1 + abs(truth.value))
    low = said.value - share * (said.value - said.low)
    high = said.value + share * (said.high - said.value)
    return truth.high < low - slack or truth.low > high + slack


def sample() -> list[tuple[Mapping[str, Estimate], Mapping[str, Estimate]]]:
    """All of them. Made by the tests: what a module computes when it is read, every process of a run computes."""
    return [pair for seed in range(_COUNT) for pair in cheap_and_true(seed)]


def test_most_cranes_of_the_sample_move() -> None:
    assert sum(bool(cheap_and_true(seed)) for seed in range(_COUNT)) > 0.8 * _COUNT


@pytest.mark.parametrize("seed", range(_COUNT))
def test_every_bar_holds_the_simulation(seed: int) -> None:
    missed = {
        name: (said[name], truth[name])
        for said, truth in cheap_and_true(seed)
        for name in said.keys() & truth.keys()
        if outside(said[name], truth[name], 1.0)
    }
    assert missed == {}


@pytest.mark.parametrize("load", ["start_time", "start_angle", "brake_angle", "torque_worm", "brake_time"])
def test_a_third_of_the_bar_would_not_hold(load: str) -> None:
    """Start, stop and what the gear carries; the bars of the ring's axial force and moment are wider than that."""
    bounded = [(said[load], truth[load]) for said, truth in sample() if load in said and said[load].bounded]
    assert len(bounded) > 10
    assert any(outside(said, truth, TIGHTER) for said, truth in bounded)


def test_bars_are_finite_for_most_cranes() -> None:
    said = [pair[0]["brake_angle"] for pair in sample()]
    assert sum(math.isfinite(one.high) for one in said) > 0.5 * len(said)
