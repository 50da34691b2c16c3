"""Finite elements of a belt: against the impedance of a wave, and the way of a braked body."""

import math

import numpy as np
import pytest

from ptmcalc.reference.belt import Length, Plan, Roller, shared_out, simulate

BELT = (Length(400.0, 30.0, 20e6), Length(400.0, 120.0, 20e6))


def test_a_drum_that_is_held_meets_the_impedance_of_both_strands() -> None:
    """What runs on pushes with v (K m)^(1/2) of its strand, what runs off pulls with that of the other."""
    count = sum(shared_out(BELT, 200))
    plan = Plan(BELT, 1, (Roller(500.0),), (Roller(1e-3),), head_speed=lambda time: 0.0)
    found = simulate(plan, 200, 0.2, np.full(count, 150e3), 2.0)
    back, carry = (math.sqrt(one.stiffness * one.line_mass) for one in BELT)
    assert np.median(found.head.on[1:]) == pytest.approx(150e3 - 2.0 * carry, abs=0.01 * 2.0 * carry)
    assert np.median(found.head.off[1:]) == pytest.approx(150e3 + 2.0 * back, abs=0.01 * 2.0 * back)


def test_a_belt_that_runs_out_goes_as_far_as_its_friction_lets_it() -> None:
    """v^2/(2 a) with the friction of all its length, within a wave's swing."""
    rubbed = tuple(Length(one.length, one.line_mass, one.stiffness, friction=one.line_mass * 0.5) for one in BELT)
    counts = shared_out(rubbed, 100)
    friction = np.concatenate(
        [np.full(n, one.friction * one.length / n) for one, n in zip(rubbed, counts, strict=True)]
    )
    tension = 150e3 + np.cumsum(friction) - friction / 2
    found = simulate(Plan(rubbed, 1, (Roller(10.0),), (Roller(10.0),), (150e3, 0.0)), 100, 12.0, tension, 4.0)
    belt = np.array(found.head.belt)
    way = float(belt[belt > 0].sum() * found.times[1])
    assert way == pytest.approx(4.0**2 / (2 * 0.5), rel=0.05)


@pytest.mark.parametrize("sense", [1, -1], ids=["ahead", "behind"])
def test_a_drum_that_slips_passes_on_e_times_the_tension_and_does_not_chatter(sense: int) -> None:
    """S_above = e S_behind with what both strands take to move: v = S (e - 1)/(Z_on + e Z_off), until an echo comes."""
    exponent, tension = 1.16, 150e3
    count = sum(shared_out(BELT, 200))
    plan = Plan(BELT, 1, (Roller(100.0, lambda time, speed: sense * 1e6, exponent=exponent),), (Roller(1e-3),))
    found = simulate(plan, 200, 0.4, np.full(count, tension))
    back, carry = (math.sqrt(one.stiffness * one.line_mass) for one in BELT)
    e = math.exp(sense * exponent)
    belt = tension * (e - 1) / (carry + e * back)
    late = found.times > 0.05
    for history, exact in (
        (found.head.belt, belt),
        (found.head.on, tension + carry * belt),
        (found.head.off, tension - back * belt),
    ):
        assert np.array(history)[late] == pytest.approx(exact, rel=0.01)
    assert {slips for slips, counts in zip(found.head.slips, late, strict=True) if counts} == {(sense,)}
