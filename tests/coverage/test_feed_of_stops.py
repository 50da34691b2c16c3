"""Stops while material is fed: bars hold finite elements whose feed stops at once, and those whose feed continues.

The elements accelerate the feed with Q (v - v_k): a drag Q and a push Q v_k over the loading zone. They begin with the
tensions of steady running, where v is the rated speed.
"""

import math
from dataclasses import replace
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.bars import THIRD, Limit, Trial, claim, misses, near, opposites, tried, wide, widest
from support.belt_fem import Length, simulate
from support.belt_scenes import Brake, Drive, counts_of
from support.loading_points import Point, PointedRig
from support.machines import spec_of

from ptmcalc.base.estimate import Estimate
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.conveyor.waves.effects import feed
from ptmcalc.machines.conveyor.waves.network import NETWORK

ON_TRIAL = {"conveyor": ("feed",)}
KIND = load_kind("conveyor")
LIMITS = (Limit("stop_distance_max", ("checks", "stop_distance"), least=0.01),)
SEED, MACHINES, ELEMENTS = 20261128, 6, 160
LOADS = ("stop_time", "stop_distance", "stop_distance_max", "tension_max", "tension_min")
MODES = ("stops", "continues")


def drawn(index: int) -> PointedRig:
    """A random conveyor with two or three loading points and a brake."""
    rng = np.random.default_rng((SEED, index))
    length, speed = float(rng.uniform(150, 500)), float(rng.uniform(2.5, 5))
    points = [Point(0.0, float(rng.uniform(20, 100)))]
    places = (rng.uniform(0.05, 0.8, int(rng.integers(1, 3))) * length).tolist()
    points += [Point(place, float(rng.uniform(150, 500)), float(rng.uniform(-1, 0.8 * speed))) for place in places]
    rig = PointedRig(
        sections=((length, length * float(rng.uniform(-0.02, 0.06))),),
        points=tuple(points),
        speed=speed,
        stiffness=float(rng.uniform(10e6, 60e6)),
        belt=float(rng.uniform(15, 35)),
        drives={"head": Drive(torque=6000.0, rotor=float(rng.uniform(2, 8)), friction=None)},
        tail_inertia=float(rng.uniform(5, 60)),
    )
    pull = abs(rig.resistance())
    return replace(rig, tension=2.5 * pull + 40e3, brakes=(Brake(0.4 * pull, 0.0, 1.0),))


def lengths_of(rig: PointedRig, mode: str) -> tuple[Length, ...]:
    """The belt in the stop: friction without the feed, its drag and its push."""
    lengths, cuts = list(rig.lengths()), rig.cuts()
    half = len(lengths) // 2
    for number, (first, last) in enumerate(pairwise(cuts)):
        middle, one = (first + last) / 2, lengths[half + number]
        drag = push = 0.0
        for which, point in enumerate(rig.points):
            zone = min(rig.zone(which), rig.span - point.at)
            if rig.accelerates(which) and point.at < middle < point.at + zone:
                drag, push = drag + point.flow / zone, push + point.flow * point.speed / zone
        friction = one.friction - (drag * rig.speed - push)
        on = mode == "continues"
        lengths[half + number] = replace(one, friction=friction, drag=drag * on, climb=one.climb - push * on)
    return tuple(lengths)


def middles(lengths: tuple[Length, ...], elements: int) -> np.ndarray:
    """Tension by gravity and push in the middle of every element."""
    counts = counts_of(lengths, elements)
    rises = np.concatenate([np.full(n, one.climb * one.length / n) for one, n in zip(lengths, counts, strict=True)])
    found: np.ndarray = np.cumsum(rises) - rises / 2
    return found


@cache
def truth(index: int, mode: str, elements: int = ELEMENTS) -> dict[str, float]:
    rig = drawn(index)
    running, lengths = rig.lengths(), lengths_of(rig, mode)
    begins = rig.running(running, elements) + middles(running, elements) - middles(lengths, elements)
    window = 2 * rig.mass() * rig.speed / (rig.resistance() + rig.brakes[0].torque) + 3 * rig.contour() + 2
    motion = simulate(rig.plan(lengths, brakes=rig.brakes), elements, window, begins, rig.speed)
    belt, step = np.array(motion.head.belt), float(motion.times[1])
    rest = int(np.argmax(belt <= 0))
    assert rest > 0
    return {
        "stop_time": rest * step,
        "stop_distance": float(belt[:rest].sum()) * step,
        "stop_distance_max": float(motion.farthest.max()),
        "tension_max": float(motion.highest.max()),
        "tension_min": float(motion.lowest.min()),
    }


def trial_of(index: int, mode: str) -> Trial:
    """Loads of the belt in cells with the bound of the feed, and what the elements find."""
    rig = drawn(index)
    data = rig.data({"type": "stop"}, checks={"stop_distance": "1 km"})
    data["resistance"] |= {"start_factor": 1, "stop_factor": 1}
    spec = spec_of(data)
    (scene,) = spec.all_scenes
    claims = claim(KIND, spec, scene, NETWORK, NETWORK.always, 2)
    fine, coarse = truth(index, mode), truth(index, mode, ELEMENTS // 2)
    exact = {name: Estimate.within(one, abs(one - coarse[name]) + 1e-3 * abs(one)) for name, one in fine.items()}
    number = 2 * index + MODES.index(mode)
    return tried(number, np.random.default_rng((SEED, number)), KIND, spec, scene, {"feed": claims}, exact, LIMITS)


@pytest.fixture(scope="module")
def trials() -> list[Trial]:
    return [trial_of(index, mode) for index in range(MACHINES) for mode in MODES]


def test_bars_hold_the_finite_elements(trials: list[Trial]) -> None:
    assert misses(trials, "feed") == []
    assert opposites(trials) == []
    assert near(trials) >= 0.4
    assert wide(trials, "feed") <= widest("feed")
    assert all(one.claims["feed"][name].bounded for one in trials for name in LOADS)


def test_a_third_of_the_bars_does_not_suffice(trials: list[Trial]) -> None:
    assert misses(trials, "feed", THIRD) != []


@pytest.mark.parametrize("index", range(MACHINES))
def test_the_rigid_belt_stops_between_the_ends(index: int) -> None:
    """M v' = -(W + B(t) + F(v) - P) with F of every share of the feed, by an integrator."""
    rig = drawn(index)
    data = rig.data({"type": "stop"})
    data["resistance"] |= {"start_factor": 1, "stop_factor": 1}
    spec = spec_of(data)
    (scene,) = spec.all_scenes
    ends = sorted(way for _, way in feed._stopped(spec, scene))
    (brake,), radius = rig.brakes, rig.drives["head"].diameter / 2
    flows = [(one.flow, one.speed) for number, one in enumerate(rig.points) if rig.accelerates(number)]
    steady = sum(flow * (rig.speed - speed) for flow, speed in flows)
    for share in (0.0, 0.5, 1.0):

        def slows(time: float, state: np.ndarray, share: float = share) -> tuple[float, float]:
            fed = share * sum(flow * (state[1] - speed) for flow, speed in flows)
            braked = brake.torque / radius * min(time / brake.rise, 1.0)
            return state[1], -(rig.resistance() + braked + fed - steady) / rig.mass()

        def rests(time: float, state: np.ndarray) -> float:
            return float(state[1])

        rests.terminal = True  # type: ignore[attr-defined]
        done = solve_ivp(slows, (0, 1e3), (0.0, rig.speed), events=rests, rtol=1e-9, atol=1e-12, max_step=0.5)
        way = float(done.y[0, -1])
        assert ends[0] * (1 - 1e-6) <= way <= ends[-1] * (1 + 1e-6)
        assert math.isfinite(way)
