"""The whole belt in cells beside finite elements with general solvers: counts are gates, seconds only a table.

P1: 4 km of belt under a step of force, waves that go round for a minute; and the friction wave of a 2 km belt that
starts from rest on its idlers. `python -m pytest tests/bench/test_belt_cells.py --benchmark-enable -s -n 0` prints the
table of times and errors against scipy's solvers on finite elements of the same problems, and a line for scale.
"""

import math
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support import echoes
from support.meshes import Line, Mesh

from ptmcalc.numerics.belt.course import Reach, lay_out
from ptmcalc.numerics.belt.march import Drawn, march, place_at
from ptmcalc.numerics.belt.station import Drum, Station, TakeUp

Lengths = tuple[tuple[float, float, float], ...]
"""Length [m], mass per length [kg/m], friction [N/m] of return and carry strand."""
Case = tuple[Lengths, float, float, Callable[[float], float], float, float]
"""Strands, stiffness, drum, force, take-up tension, window."""

P1: Case = (((2000.0, 235.0, 0.0), (2000.0, 235.0, 0.0)), 1.4e8, 12_000.0, lambda t: 60e3, 0.0, 60.0)
RUBBING: Case = (
    ((1000.0, 38.0, 9.3195), (1000.0, 245.0, 60.0863)), 138e6, 45_120.0, lambda t: 200e3 * min(t / 0.5, 1.0), 1e5, 8.0,
)  # fmt: skip
FINE = 3200
METHODS = ("DOP853", "LSODA", "Radau")


def cells(case: Case, count: int) -> Drawn:
    strands, stiffness, drum, force, tension, window = case
    course = lay_out(tuple(Reach.even(length, rho, stiffness, w) for length, rho, w in strands), 1, count)
    head = Station(
        place_at(course, 0, 0.0), [Drum("drive", drum, lambda t, speed: (force(t), 0.0))], TakeUp(tension)
    )  # fmt: skip
    tail = Station(place_at(course, course.tail, 0.0), ())
    return march(course, head, tail, np.full(course.cells, tension), 0.0, window)


def run_on(drawn: Drawn, when: np.ndarray) -> np.ndarray:
    return np.interp(when, drawn.times, [seen.tensions[0] for seen in drawn.head])


def samples(case: Case) -> np.ndarray:
    return np.linspace(0.0, case[-1], 2001)


def truth(case: Case) -> np.ndarray:
    """The series of echoes for the uniform belt without friction, a very fine grid for the other."""
    strands, stiffness, drum, force, _, _ = case
    if strands[0][2]:
        return run_on(cells(case, FINE), samples(case))
    length, rho, _ = strands[0]
    z, transit = math.sqrt(rho * stiffness), length * math.sqrt(rho / stiffness)
    return echoes.run_on(force(0.0), (z, z), drum, (transit, transit), samples(case))


def errors(found: np.ndarray, true: np.ndarray) -> tuple[float, float]:
    """Largest deviation and that of the largest value, over the largest value."""
    return float(np.abs(found - true).max() / true.max()), float(abs(found.max() / true.max() - 1))


def elements(case: Case, count: int) -> Mesh:
    """Lumped masses and springs; friction is smoothed over 1 mm/s."""
    strands, stiffness, drum, force, _, _ = case
    lines = [Line(length, rho, w) for length, rho, w in strands]
    return Mesh(lines, stiffness, drum, lambda t, v: force(t), count, soft=1e-3)


# -- gates ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("count", "updates"), [(600, 4_400_000)])
def test_p1_to_a_hundredth_within_its_work(count: int, updates: int, benchmark: Any) -> None:
    drawn = benchmark.pedantic(cells, (P1, count), rounds=1)
    largest, peak = errors(run_on(drawn, samples(P1)), truth(P1))
    assert drawn.updates <= updates
    assert largest < 1e-2
    assert peak < 1e-3


@pytest.mark.parametrize(("count", "updates"), [(100, 70_000)])
def test_the_friction_wave_of_2_km_to_a_hundredth_within_its_work(count: int, updates: int, benchmark: Any) -> None:
    drawn = benchmark.pedantic(cells, (RUBBING, count), rounds=1)
    largest, peak = errors(run_on(drawn, samples(RUBBING)), truth(RUBBING))
    assert drawn.updates <= updates
    assert largest < 1e-2
    assert peak < 1e-3


@pytest.mark.parametrize("case", [P1, RUBBING], ids=["P1", "friction wave"])
def test_twice_the_cells_are_four_times_the_updates_and_twice_the_steps(case: Case) -> None:
    one, two = cells(case, 100), cells(case, 200)
    assert two.updates == pytest.approx(4 * one.updates, rel=0.25)
    assert len(two.times) == pytest.approx(2 * len(one.times), rel=0.2)
    for drawn in (one, two):
        assert drawn.updates == (len(drawn.times) - 1) * round(drawn.updates / (len(drawn.times) - 1))


# -- against general solvers, in one run -----------------------------------------------------------------------------


@pytest.mark.parametrize("case", [P1, RUBBING], ids=["P1", "friction wave"])
def test_beside_finite_elements_with_general_solvers(case: Case, request: pytest.FixtureRequest) -> None:
    """A mesh of 60 must come near; whether a solver gets below 1e-2, and when, is printed where benchmarks are on."""
    timed = bool(request.config.getoption("--benchmark-enable", default=False))
    clock: Callable[[], float] = time.perf_counter if timed else lambda: 0.0
    when, true, rows = samples(case), truth(case), []
    for count in (100, 200, 400, 800):
        start = clock()
        found = run_on(cells(case, count), when)
        largest, peak = errors(found, true)
        rows.append(
            f"cells    {count:5d}  {1e3 * (clock() - start):10.1f} ms  error {largest:8.1e}, of the peak {peak:8.1e}"
        )
    for method in METHODS if timed else METHODS[:1]:
        for count in ((60, 240) if method == "Radau" else (60, 240, 960)) if timed else (60,):
            mesh = elements(case, count)
            start = clock()
            answer = mesh.run_on(method, when, 1e-5)
            largest, peak = errors(case[4] + answer.readings[1], true)
            rows.append(
                f"{method:>7}  {count:5d}  {1e3 * (clock() - start):10.1f} ms  error {largest:8.1e},"
                f" of the peak {peak:8.1e}, {answer.evaluations} evaluations"
            )
            assert answer.evaluations > 0
            assert peak < 0.2
            assert largest < 0.6
    if timed:
        start = clock()
        solve_ivp(lambda t, y: [y[1], -y[0]], (0.0, 100.0), [1.0, 0.0], "RK45", rtol=1e-6)
        rows.append(f"for scale: RK45 on x'' = -x over 100 s  {1e3 * (clock() - start):.1f} ms")
        print("", f"run-on tension, {len(case[0])} strands, {case[-1]:g} s", *rows, sep="\n")
