"""Trains by Runge-Kutta steps from event to event: against a state machine of the tests, and closed forms."""

import math

import pytest
from support import hybrid
from support.random_trains import machine
from support.trains import train_of

from ptmcalc.numerics.train.parts import Body, Drive, Grip, Mesh, Spring, Train
from ptmcalc.numerics.train.signals import Signal
from ptmcalc.reference import lumped, two_runs

SEEDS = [0, 3, 7, 10, 16, 22, 1001, *(pytest.param(seed, marks=pytest.mark.study) for seed in range(23, 83))]
"""Trains with springs, play, lossy gears, brakes and clutches; those above 1000 with curved contacts."""


@pytest.mark.parametrize("seed", SEEDS)
def test_extremes_are_those_of_the_state_machine(seed: int) -> None:
    chosen = machine(seed, curves=seed > 1000)
    other, found = hybrid.simulate(chosen, 1.0), lumped.simulate(train_of(chosen), 1.0, 1e-9)
    assert other.highest.keys() <= found.highest.keys()
    for name in other.highest:
        alike = [max(abs(other.highest[k]), abs(other.lowest[k])) for k in other.highest if k[0] == name[0]]
        size = max(1e-3, *alike)
        assert found.highest[name] == pytest.approx(other.highest[name], abs=1e-6 * size)
        assert found.lowest[name] == pytest.approx(other.lowest[name], abs=1e-6 * size)


def test_the_difference_of_two_runs_holds_the_error() -> None:
    """One inertia on a spring for fifty radians: the speed at the end is a cosine."""
    train = Train((Body("one", 2.0, 0.0, 3.0),), springs=(Spring("spring", 0, None, 8.0),))
    coarse, fine = lumped.twice(train, 25.0, 0)
    for name, exact in (("speed", 3 * math.cos(50.0)), ("position", 1.5 * math.sin(50.0))):
        told = two_runs.estimate(coarse.last[name, 0], fine.last[name, 0])
        assert told.low <= exact <= told.high
        assert told.bar < 1e-4


def test_friction_stops_a_body_and_holds_it() -> None:
    """1 kg at 2 m/s against 4 N: it stops after 0.5 s and 0.5 m, and a force of 3 N does not move it then."""
    pull = Signal((0.0, 1.0), (0.0, 3.0), (0.0, 0.0))
    train = Train((Body("one", 1.0, 0.0, 2.0),), grips=(Grip("k", 0, None, Signal.constant(4.0)),))
    held = Train(train.bodies, grips=train.grips, drives=(Drive.of("pull", 0, pull),))
    found = lumped.simulate(held, 2.0, 1e-8)
    assert found.times("turning", 0, lambda turn: turn == 0) == [pytest.approx(0.5, rel=1e-9)]
    assert found.last["position", 0] == pytest.approx(0.5, rel=1e-9)
    assert found.turning == (0,)


@pytest.mark.parametrize(("torque", "speed"), [(3.0, 1.4), (-3.0, -3.0)])
def test_a_lossy_gear_passes_on_less_either_way(torque: float, speed: float) -> None:
    """Forward 70 % of the torque reach the outer side; backward the file's other efficiency holds."""
    bodies = Body("inner", 1e-9), Body("outer", 1.5)
    drive = Drive.of("d", 0 if torque > 0 else 1, Signal.constant(torque))
    train = Train(bodies, (Mesh("gear", 0, 1, 1.0, 0.7, 0.5),), drives=(drive,))
    found = lumped.simulate(train, 1.0, 1e-8)
    assert found.last["speed", 1] == pytest.approx(torque * (0.7 if torque > 0 else 1.0) / 1.5, rel=1e-6)
    assert found.last["speed", 1] == pytest.approx(speed / (1.0 if torque > 0 else 1.5), rel=1e-6)


def test_a_bouncing_rope_goes_slack_and_catches() -> None:
    """Thrown up at v on a rope of stiffness k, a weight comes back at v and pulls with Q + (Q^2 + k m v^2)^(1/2)."""
    mass, stiffness, weight, speed = 10.0, 4000.0, 98.1, 2.0
    rope = Spring("rope", 0, None, stiffness, law="no_pull", side=-1)
    train = Train((Body("m", mass, 0.0, speed),), springs=(rope,), drives=(Drive.of("q", 0, Signal.constant(-weight)),))
    found = lumped.simulate(train, 1.0, 1e-9)
    most = weight + math.sqrt(weight**2 + stiffness * mass * speed**2)
    assert -found.lowest["link", 0] == pytest.approx(most, rel=1e-8)
