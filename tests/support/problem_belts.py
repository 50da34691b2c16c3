"""Two belts of the performance study, as our numerics take them and in finite elements.

P1: 2 km from drum to tail, a step of force, waves that go round for a minute. P2: 2 km of belt whose idlers rub,
started along a motor's curve.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from ptmcalc.numerics import loop, strand
from ptmcalc.numerics.belt.course import Reach, lay_out
from ptmcalc.numerics.belt.march import march, place_at
from ptmcalc.numerics.belt.station import Drum, Station, TakeUp
from support import echoes
from support.meshes import Line, Mesh

STIFFNESS, DRUM = 1.4e8, 12_000.0


@dataclass(frozen=True)
class Ours:
    """Run-on tension at the samples; values of waves that were advanced, and with the extremes of every cell."""

    run_on: np.ndarray
    advanced: int
    updates: int


@dataclass(frozen=True)
class Problem:
    """What is solved, when it is sampled, the truth and ours; `soft` are the speeds v0 of tanh(v/v0) for peers."""

    name: str
    lines: tuple[Line, ...]
    force: Callable[[float, float], float]
    when: np.ndarray
    truth: Callable[[], np.ndarray]
    ours: Callable[[int], Ours]
    soft: tuple[float, ...] = (1.0,)

    def mesh(self, count: int, masses: float, soft: float = 1.0) -> Mesh:
        return Mesh(self.lines, STIFFNESS, DRUM, self.force, count, masses, soft)

    def error(self, *readings: np.ndarray) -> float:
        true = self.truth()
        return min(float(np.abs(one - true).max() / true.max()) for one in readings)

    def peak_error(self, reading: np.ndarray) -> float:
        return float(abs(reading.max() / self.truth().max() - 1))


# -- P1 -------------------------------------------------------------------------------------------------------------

P1_HALF, P1_MASS, P1_FORCE, P1_WHEN = 2000.0, 235.0, 60e3, np.linspace(0.0, 60.0, 6001)


@cache
def p1_truth() -> np.ndarray:
    z, transit = math.sqrt(P1_MASS * STIFFNESS), P1_HALF * math.sqrt(P1_MASS / STIFFNESS)
    return echoes.run_on(P1_FORCE, (z, z), DRUM, (transit, transit), P1_WHEN)


P1_PANEL = 12
"""Steps a panel, over which the waves are polynomials of that degree."""


def p1_ours(panels: int) -> Ours:
    """Delay lines of so many panels a strand, and of all they answer the history that is asked for."""
    one = loop.Strand(P1_HALF, P1_MASS, STIFFNESS, 0.0, 0.0)
    grid = loop.panelled(loop.match(one.transit, one.transit, panels, 1e-6), P1_PANEL)
    drive = loop.Drive(force=lambda t: np.full_like(t, P1_FORCE))
    history = strand.run_on(loop.Loop(one, one, DRUM, 0.0, False), drive, P1_WHEN[-1], grid, P1_WHEN)
    advanced = 4 * (loop.steps_of(P1_WHEN[-1], grid)[0] + 1)
    return Ours(history, advanced, advanced)


P1 = Problem("P1", (Line(2 * P1_HALF, P1_MASS),), lambda t, v: P1_FORCE, P1_WHEN, p1_truth, p1_ours)

# -- P2 -------------------------------------------------------------------------------------------------------------

P2_WHEN = np.linspace(0.0, 30.0, 3001)
P2_LINES = (Line(1000.0, STIFFNESS / 2000.0**2, 6.9, 1.0), Line(1000.0, STIFFNESS / 800.0**2, 42.9, 4.0))
P2_FINE = 700
"""Cells of the truth: 2e-4 from that of four times as many."""


def kloss(time: float, speed: float) -> tuple[float, float]:
    slip = 1 - speed / 3.2
    bottom = slip**2 + 0.12**2
    return 2 * 320e3 * 0.12 * slip / bottom, -2 * 320e3 * 0.12 * (0.12**2 - slip**2) / bottom**2 / 3.2


def p2_ours(cells: int) -> Ours:
    ends = np.array([0.0, 1000.0])
    course = lay_out(
        tuple(
            Reach(one.line_mass, STIFFNESS, ends, one.friction * ends, one.drag * ends, 0 * ends) for one in P2_LINES
        ),
        1,
        cells,
    )
    head = Station(place_at(course, 0, 0.0), [Drum("drive", DRUM, kloss)], TakeUp(0.0))
    tail = Station(place_at(course, course.tail, 0.0), ())
    drawn = march(course, head, tail, np.zeros(course.cells), 0.0, P2_WHEN[-1])
    history = np.interp(P2_WHEN, drawn.times, [seen.tensions[0] for seen in drawn.head])
    return Ours(history, 2 * drawn.updates, 2 * drawn.updates)


@cache
def p2_truth() -> np.ndarray:
    return p2_ours(P2_FINE).run_on


P2 = Problem(
    "P2", P2_LINES, lambda t, v: kloss(t, v)[0], P2_WHEN, p2_truth, p2_ours, (1e-2, 1e-3, 1e-4)
)  # fmt: skip
