"""The bound of sag in scenes that the belt in cells carries without it: nonlinear elements with and without sag.

The bound is d = min(g f sqrt(1 + n), 2) (S_max - S_min)/2 with f the softening at the lowest tension and n the contour
times of the window; g is calibrated here, and the largest value of the sample is what `effects` says it is.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest
from support.belt_scenes import Brake, Drive, Rig
from support.sagging_scenes import softening, swing

from ptmcalc.machines.conveyor.waves.effects import sag

MESHES = (120, 240)
LARGEST = 0.5
"""Softening from which on nothing is claimed."""


@dataclass(frozen=True)
class Seen:
    """What sag changed in a scene, over what the bound is made of."""

    seed: int
    kind: str
    softening: float
    contours: float
    change: float
    """what is sure of it: less what both meshes differ by"""
    amplitude: float

    @property
    def factor(self) -> float:
        """The least factor that holds this scene."""
        return self.change / (self.softening * math.sqrt(1 + self.contours) * self.amplitude)

    @property
    def bound(self) -> float:
        share = sag._SCENE_SAG_FACTOR * self.softening * math.sqrt(1 + self.contours)
        return min(share, 2.0) * self.amplitude


def _rig(rng: np.random.Generator, tension: float, rigid: bool) -> Rig:
    length = float(rng.uniform(150, 900))
    return Rig(
        sections=((length, float(rng.uniform(-0.01, 0.06)) * length),),
        belt=float(rng.uniform(10, 30)),
        stiffness=float(rng.uniform(8e6, 80e6)),
        load=float(rng.uniform(40, 200)),
        friction=float(rng.uniform(0.015, 0.03)),
        speed=float(rng.uniform(1.5, 4.5)),
        drives={"head": Drive(torque=float(rng.uniform(1000, 4000)), rotor=float(rng.uniform(2, 10)))},
        brakes=(Brake(float(rng.uniform(1e3, 10e3)), float(rng.uniform(0, 1)), float(rng.uniform(0, 2))),),
        tension=tension,
        rigid=rigid,
    )


def seen(seed: int) -> Seen | None:
    """One scene, with the take-up tension at which the belt sags by a softening drawn up to the largest one."""
    rng = np.random.default_rng(seed)
    kind = ("stop", "relaxed")[seed % 2]
    pitches = (float(rng.choice([1.0, 1.2, 1.5])), 3.0)
    rig = _rig(rng, 100e3, rigid=bool(rng.random() < 0.3))
    wanted = float(np.exp(rng.uniform(math.log(0.01), math.log(LARGEST))))
    span = max(rig.belt * pitches[1], (rig.belt + rig.load) * pitches[0]) * rig.gravity
    lowest = (rig.stiffness * span**2 / (12 * wanted)) ** (1 / 3)
    force = None
    pull = rig.drives["head"].force
    if kind == "relaxed":
        if pull < 1.15 * rig.resistance(factor=rig.start_factor):
            return None
        window = rig.mass() * rig.speed / (pull - rig.resistance())

        def force(time: float) -> float:
            return pull

    else:
        slowing = rig.resistance() + sum(brake.torque * 2 for brake in rig.brakes)
        if rig.resistance() < 0.2 * slowing:
            return None
        window = 1.25 * (rig.mass() * rig.speed / slowing + 1.0) + 2 * rig.contour()
    window = min(window, 14 * rig.contour())
    stiff = swing(rig, pitches, window, MESHES[0], sags=False, force=force, relaxed=kind == "relaxed")
    rig = replace(rig, tension=rig.tension + lowest - stiff.lowest)  # the linear belt's swing does not depend on it
    if rig.tension <= 0:
        return None
    changes = []
    for elements in MESHES:
        straight, sagging = (
            swing(rig, pitches, window, elements, sags=sags, force=force, relaxed=kind == "relaxed")
            for sags in (False, True)
        )
        if straight.lowest <= 0:
            return None
        changes.append(straight.apart(sagging))
    soft = softening(rig.stiffness, span, straight.lowest)
    if not soft < LARGEST:
        return None
    sure = max(changes[1] - abs(changes[1] - changes[0]), 0.0)
    return Seen(seed, kind, soft, window / rig.contour(), sure, straight.amplitude)


def sample(seeds: range) -> list[Seen]:
    return [one for one in map(seen, seeds) if one is not None]


@pytest.fixture(scope="module")
def cases() -> list[Seen]:
    return sample(range(12))


def test_the_sample_has_stops_and_starts_and_belts_that_sag(cases: list[Seen]) -> None:
    assert {case.kind for case in cases} == {"stop", "relaxed"}
    assert len(cases) >= 8
    assert max(case.softening for case in cases) > 0.1


def test_the_bound_holds_what_sag_changes(cases: list[Seen]) -> None:
    assert [case for case in cases if case.change > case.bound] == []


@pytest.mark.study
def test_the_bound_holds_on_a_larger_sample_and_is_no_empty_claim() -> None:
    cases = sample(range(100, 340))
    assert [case for case in cases if case.change > case.bound] == []
    assert any(case.change > case.bound / 4 for case in cases)
