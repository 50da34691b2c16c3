"""The bound of damping in scenes that the belt carries without it: finite elements with and without dashpots.

The bound is c = min(g sqrt(d (1 + n)), 2) (S_max - S_min)/2 with d the change of the slowest wave's frequency and n the
contour times of the window; g is calibrated here, and the largest value of the sample is what `effects` says it is.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest
from support.belt_scenes import Brake, Drive, Rig
from support.sagging_scenes import swing

from ptmcalc.machines.conveyor.waves.effects import damping
from ptmcalc.machines.conveyor.waves.effects.damping import DAMPING_THRESHOLD

ELEMENTS = 160
PITCHES = (1.2, 3.0)


@dataclass(frozen=True)
class Seen:
    """What damping changed in a scene, over what the bound is made of."""

    seed: int
    damping: float
    contours: float
    change: float
    amplitude: float

    @property
    def bound(self) -> float:
        share = damping._DAMPING_FACTOR * math.sqrt(self.damping * (1 + self.contours))
        return min(share, 2.0) * self.amplitude


def seen(seed: int) -> Seen:
    """A stop or a start of a relaxed belt, with damping drawn up to the threshold."""
    rng = np.random.default_rng(seed)
    length = float(rng.uniform(150, 900))
    rig = Rig(
        sections=((length, float(rng.uniform(-0.01, 0.06)) * length),),
        belt=float(rng.uniform(10, 30)),
        stiffness=float(rng.uniform(8e6, 80e6)),
        load=float(rng.uniform(40, 200)),
        friction=float(rng.uniform(0.015, 0.03)),
        speed=float(rng.uniform(1.5, 4.5)),
        drives={"head": Drive(torque=float(rng.uniform(1000, 4000)), rotor=float(rng.uniform(2, 10)))},
        brakes=(Brake(float(rng.uniform(1e3, 10e3)), float(rng.uniform(0, 1)), float(rng.uniform(0, 1))),),
        tension=300e3,
        rigid=bool(rng.random() < 0.3),
    )
    damping = float(np.exp(rng.uniform(math.log(0.05), 0.0))) * DAMPING_THRESHOLD
    relaxed = seed % 2 == 1
    rig = replace(rig, tension=rig.tension + abs(rig.resistance()))
    pull = rig.resistance(factor=rig.start_factor) * 1.6 + 20e3

    def force(time: float) -> float:
        return pull

    contour = rig.contour()
    window = float(rng.uniform(3, 9)) * contour
    given = {"sags": False, "force": force if relaxed else None, "relaxed": relaxed}
    elastic = swing(rig, PITCHES, window, ELEMENTS, **given)
    damped = swing(rig, PITCHES, window, ELEMENTS, **given, retardation=4 * damping * contour / math.pi)
    return Seen(seed, damping, window / contour, elastic.apart(damped), elastic.amplitude)


@pytest.fixture(scope="module")
def cases() -> list[Seen]:
    return [seen(seed) for seed in range(16)]


def test_the_bound_holds_what_damping_changes(cases: list[Seen]) -> None:
    assert [case for case in cases if case.change > case.bound] == []


def test_damping_does_change_something(cases: list[Seen]) -> None:
    assert max(case.change / case.amplitude for case in cases) > 0.01


@pytest.mark.study
def test_the_bound_holds_on_a_larger_sample_and_is_no_empty_claim() -> None:
    cases = [seen(seed) for seed in range(100, 300)]
    assert [case for case in cases if case.change > case.bound] == []
    assert any(case.change > case.bound / 6 for case in cases)
