"""The carriage of a stacker crane, and what keeps a machine upright: against plain systems of equations."""

import math

import numpy as np
import pytest

from ptmcalc.laws import carriage, overturning, reeving

W = float(carriage.roller_coefficient(0.015, 0.05, 5e-4, 0.16))


@pytest.mark.parametrize("factor", [1.0, 1.0 + 0.3 / 9.81])
def test_the_reaction_and_the_pull_solve_the_balance_of_the_carriage(factor: float) -> None:
    """Unknown: pull of the ropes, upper and lower rollers. Forces across, upwards, moments about the lower roller."""
    load, own, height = 9810.0, 5886.0, 1.2
    sides = np.array([[0.0, 1.0, -1.0], [1.0, -W, -W], [0.0, height, 0.0]])
    pull, upper, lower = np.linalg.solve(sides, factor * np.array([0.0, load + own, load * 0.9 + own * 0.35]))
    reaction = float(carriage.roller_reaction(load * 0.9 + own * 0.35, height, factor))
    assert reaction == pytest.approx(upper, rel=1e-12) == pytest.approx(lower, rel=1e-12)
    resistance = carriage.guide_resistance(reaction, W)
    assert float(carriage.rope_pull(load + own, factor, resistance, 1, 1.0, True)) == pytest.approx(pull, rel=1e-12)


def test_without_an_acceleration_the_weights_are_what_they_are() -> None:
    assert carriage.roller_reaction([1.2e4, -1.2e4], 1.5).tolist() == [8e3, 8e3]


def test_the_ratio_of_jamming_is_1_where_the_rope_goes_slack() -> None:
    weight, height = 15e3, 1.2
    arm = height / (2 * 0.3)
    assert float(carriage.jamming_ratio(weight * arm, weight, height, 0.3)) == pytest.approx(1.0, rel=1e-12)
    for share, slack in ((0.99, False), (1.01, True)):
        moment = share * weight * arm
        resistance = carriage.guide_resistance(carriage.roller_reaction(moment, height), 0.3)
        assert (float(carriage.rope_pull(weight, 1.0, resistance, 2, 0.97, False)) == 0.0) is slack


def test_a_carriage_comes_down_easier_than_it_goes_up() -> None:
    up = float(carriage.rope_pull(15e3, 1.0, 200.0, 4, reeving.tackle_efficiency(4, 0.98), True))
    down = float(carriage.rope_pull(15e3, 1.0, 200.0, 4, reeving.lowering_tackle_efficiency(4, 0.98), False))
    assert down < 15e3 / 4 < up
    lowered = 14.8e3 / sum(0.98**-k for k in range(4))  # each sheave makes the next fall heavier
    assert down == pytest.approx(lowered, rel=1e-12)


@pytest.mark.parametrize("falls", [2, 4, 12])
def test_the_sheaves_of_a_tackle_give_its_efficiency_back(falls: int) -> None:
    sheave = carriage.sheave_of_tackle(falls, 0.93)
    assert reeving.tackle_efficiency(falls, sheave) == pytest.approx(0.93, rel=1e-12)
    assert carriage.sheave_of_tackle(2, 0.501) == pytest.approx(0.002, rel=1e-12), "of two falls, (1 + eta)/2"
    assert carriage.sheave_of_tackle(1, 0.97) == 0.97
    assert carriage.sheave_of_tackle(4, 0.25) == 0.25


def test_what_holds_over_what_tips() -> None:
    held = overturning.holding_moment([3e4, 1e4], [1.0, -0.5])
    assert held == pytest.approx(2.5e4)
    assert float(
        overturning.stability_reserve(held, overturning.tipping_moment(1e4, 2e3, 1.0, 1e3, 0.5))
    ) == pytest.approx(2)
    assert overturning.stability_reserve([1.0, 0.0, -1.0], 0.0).tolist() == [math.inf, 0.0, -math.inf]
