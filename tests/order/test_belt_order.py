"""Observed order of the belt in cells: 2 while all of the belt slides (or nothing rubs), 1 on fronts of sticking.

Both strands take travel times in the ratio 1:2 here, so that grids of 99, 198, ... cells fit them without mismatch and
differ by nothing but their step.
"""

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import pytest
from support import echoes
from support.belt_fem import Length, Plan, Roller, simulate

from ptmcalc.numerics.belt.course import Reach, lay_out
from ptmcalc.numerics.belt.march import Drawn, march, place_at
from ptmcalc.numerics.belt.station import Drum, Station, TakeUp, Torque

EA, BACK, CARRY, MASS = 138e6, 38.0, 245.0, 45_120.0
LENGTHS = 1000.0, 2000.0 * math.sqrt(BACK / CARRY)
WEIGHTS = 9.3195, 60.0863
ENDS = np.array([0.0, 1.0])
GRIDS = 99, 198, 396, 792


def rising(force: float, time: float) -> Callable[[float], float]:
    """From 0 without a corner: F sin^2(pi t/2T), then F."""
    return lambda t: force * math.sin(math.pi / 2 * min(t / time, 1.0)) ** 2


def pull(force: float, time: float) -> Torque:
    rise = rising(force, time)
    return lambda t, speed: (rise(t), 0.0)


def kloss(time: float, speed: float) -> tuple[float, float]:
    slip = 1 - speed / 3.2
    bottom = slip**2 + 0.12**2
    return 2 * 320e3 * 0.12 * slip / bottom, -2 * 320e3 * 0.12 * (0.12**2 - slip**2) / bottom**2 / 3.2


@dataclass(frozen=True)
class Scene:
    head: Drum
    takeup: TakeUp | None
    off: float
    speed: float = 0.0
    rubs: bool = True
    frozen: bool = True
    drag: tuple[float, float] = (0.0, 0.0)
    tail: tuple[Drum, ...] = field(default=())
    window: float = 6.0

    def run(self, cells: int) -> tuple[Drawn, Station]:
        weights = WEIGHTS if self.rubs else (0.0, 0.0)
        back, carry = (
            Reach(rho, EA, length * ENDS, w * length * ENDS, k * length * ENDS, 0 * ENDS)
            for rho, length, w, k in zip((BACK, CARRY), LENGTHS, weights, self.drag, strict=True)
        )  # fmt: skip
        course = lay_out((back, carry), 1, cells)
        assert course.cells == cells
        assert course.mismatch < 1e-12
        ends = np.cumsum([0.0, *LENGTHS])
        sums = np.cumsum([0.0, *(w * length for w, length in zip(weights, LENGTHS, strict=True))])
        tension = np.full(cells, self.off) + (np.interp(course.middles, ends, sums) if self.frozen else 0.0)
        head = Station(place_at(course, 0, 0.0), [self.head], self.takeup)
        tail = Station(place_at(course, course.tail, 0.0), self.tail)
        return march(course, head, tail, tension, self.speed, self.window), head

    def run_on(self, cells: int) -> np.ndarray:
        drawn, _ = self.run(cells)
        return np.interp(self.when, drawn.times, [seen.tensions[0] for seen in drawn.head])

    @property
    def when(self) -> np.ndarray:
        return np.linspace(0.05, 0.95, 300) * self.window

    def gaps(self) -> list[float]:
        """Root mean squares of the differences between neighbouring grids."""
        found = [self.run_on(cells) for cells in GRIDS]
        return [float(np.sqrt(np.mean((one - two) ** 2))) for one, two in itertools.pairwise(found)]


DRIVE = Drum("drive", MASS, pull(2e5, 3.0))
SLIDING = {
    "no friction": Scene(DRIVE, TakeUp(1e5), 1e5, rubs=False),
    "no friction, fixed loop": Scene(DRIVE, None, 1e5, rubs=False),
    "no friction, massive take-up": Scene(DRIVE, TakeUp(1e5, 2e4), 1e5, rubs=False),
    "all slides": Scene(Drum("drive", MASS, pull(1e5, 3.0)), TakeUp(2e5, 2e4), 2e5, 3.0),
    "drag": Scene(Drum("drive", MASS, pull(1e5, 3.0)), TakeUp(2e5, 2e4), 2e5, 3.0, drag=(1.0, 4.0)),
    "motor curve": Scene(Drum("drive", MASS, kloss), TakeUp(2e5), 2e5, 2.0),
    "drive at the tail": Scene(
        Drum("drive", MASS, pull(1e5, 3.0)), TakeUp(2e5, 2e4), 2e5, 3.0, tail=(Drum("tail", 8e3, pull(5e4, 2.0)),)
    ),
    "brake": Scene(Drum("drive", MASS, brake=rising(5e4, 3.0)), TakeUp(2e5, 2e4), 2e5, 3.0, window=3.0),
    "slip": Scene(Drum("drive", MASS, pull(3e5, 2.0), exponent=0.9), TakeUp(1e5), 1e5, 3.0),
}
FRONTS = {
    "start of a relaxed belt": Scene(Drum("drive", MASS, pull(2e5, 2.0)), TakeUp(1e5), 1e5, frozen=False),
    "start of a frozen belt": Scene(Drum("drive", MASS, pull(2e5, 2.0)), TakeUp(1e5), 1e5),
    "stop": Scene(Drum("drive", MASS, brake=rising(1e5, 2.0)), TakeUp(3e5, 2e4), 3e5, 3.0, window=9.0),
}


@pytest.mark.parametrize("name", SLIDING)
def test_second_order_while_all_slides(name: str) -> None:
    gaps = SLIDING[name].gaps()
    overall = math.log2(gaps[0] / gaps[-1]) / (len(gaps) - 1)
    assert 1.65 < overall < (3.3 if name == "slip" else 2.3), gaps
    assert gaps[-1] < 1e-4 * 2e5


@pytest.mark.parametrize("name", FRONTS)
def test_first_order_on_fronts(name: str) -> None:
    gaps = FRONTS[name].gaps()
    overall = math.log2(gaps[0] / gaps[-1]) / (len(gaps) - 1)
    assert 0.75 < overall < 1.4, gaps
    assert gaps[-1] < 5e-4 * 2e5


@pytest.mark.parametrize("name", ["no friction", "all slides", "start of a relaxed belt"])
def test_the_difference_of_two_grids_says_how_far_the_truth_is(name: str) -> None:
    """Order 2: a third of the last difference is still to come; order 1: no more than all of it, since errors of
    fronts change their sign from node to node. A grid of 3168 cells stands for the truth."""
    scene = (SLIDING | FRONTS)[name]
    order = 1 if name in FRONTS else 2
    coarse, fine, true = (scene.run_on(cells) for cells in (198, 396, 3168))
    said = np.sqrt(np.mean((fine - coarse) ** 2)) / (2**order - 1)
    off = np.sqrt(np.mean((fine - true) ** 2))
    assert 0.3 < off / said < 1.3


def test_finite_elements_come_to_the_same_belt() -> None:
    """The reference approaches the finest grid as its own mesh is refined."""
    scene = FRONTS["start of a relaxed belt"]
    true = scene.run_on(3168)
    rise = rising(2e5, 2.0)
    lengths = tuple(Length(length, rho, EA, w) for length, rho, w in zip(LENGTHS, (BACK, CARRY), WEIGHTS, strict=True))
    plan = Plan(lengths, 1, (Roller(MASS, lambda time, speed: rise(time)),), takeup=(1e5, 0.0))
    off = []
    for elements in (198, 396, 792):
        mesh = simulate(plan, elements, scene.window, 1e5)
        off.append(float(np.sqrt(np.mean((np.interp(scene.when, mesh.times, mesh.head.on) - true) ** 2))))
    assert off[2] < 1e-3 * 2e5
    assert off[0] > 1.6 * off[1] > 2.5 * off[2]


def test_slip_and_its_heat_come_in_first_order_or_better() -> None:
    scene = SLIDING["slip"]
    heads = [scene.run(cells)[1] for cells in (99, 198, 396, 1584)]
    for of in ("slid", "heat"):
        found = [getattr(head, of)[0] for head in heads]
        off = [abs(value / found[-1] - 1) for value in found[:-1]]
        assert off[2] < 2e-3
        assert off[0] > 2.5 * off[2]


def test_second_order_against_the_echo_series() -> None:
    """A step of force on two strands with an echo at the tail: a closed form without grid."""
    z = math.sqrt(EA * CARRY), math.sqrt(EA * BACK)
    transit = LENGTHS[1] * math.sqrt(CARRY / EA), LENGTHS[0] * math.sqrt(BACK / EA)
    step = Drum("drive", MASS, lambda time, speed: (155_636.0, 0.0))
    scene = Scene(step, TakeUp(0.0), 0.0, rubs=False, window=9.0)
    off = []
    for cells in (198, 396, 792):
        drawn, _ = scene.run(cells)
        exact = echoes.run_on(155_636.0, z, MASS, transit, drawn.times)
        off.append(float(np.abs(np.array([seen.tensions[0] for seen in drawn.head]) - exact).max()))
    assert off[-1] < 2e-4 * 155_636
    assert all(3.4 < one / two < 4.6 for one, two in itertools.pairwise(off))
