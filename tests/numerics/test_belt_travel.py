"""A belt that runs so fast that its waves go faster with it than against it: echoes, and the equations on other nodes.

The reference solves the two equations of a moving string by finite differences on a staggered grid with an adaptive
rule in time, and imports nothing of the belt in cells.
"""

import math
from dataclasses import dataclass

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from ptmcalc.numerics.belt.course import Course, Reach, lay_out
from ptmcalc.numerics.belt.give import Give, Rubber
from ptmcalc.numerics.belt.march import Drawn, march, place_at
from ptmcalc.numerics.belt.station import Drum, Station, TakeUp
from ptmcalc.numerics.belt.travel import Travel

EA, LENGTH, OFF, DRUM = 1e6, 100.0, 4e4, 1e3
MASSES = 40.0, 90.0
SPEED = 5.0  # 4.7 % of the speed of a wave in the carry strand
PULL, RISE, WINDOW = 2e4, 0.4, 10.0


def force(time: float) -> float:
    return PULL * math.sin(math.pi / 2 * min(time / RISE, 1.0)) ** 2


@dataclass(frozen=True)
class Loop:
    """Two strands, a drum driven at the head."""

    fixed: bool = False
    goes: float = 1.0
    climb: float = 0.0
    """tension that gravity asks for along the carry strand, and gives back along the return strand [N]"""
    tail: float = 0.0
    """mass of the tail drum [kg]"""
    rubber: tuple[float, float] = (0.0, 1.0)
    """how much stiffer the belt is for short times, and its relaxation time [s]"""

    def course(self, cells: int) -> Course:
        ends = np.array([0.0, 1.0])
        short = EA * (1 + self.rubber[0])
        reaches = tuple(
            Reach(rho, short, LENGTH * ends, 0 * ends, 0 * ends, climb * ends, goes=self.goes)
            for rho, climb in zip(MASSES, (-self.climb, self.climb), strict=True)
        )
        return lay_out(reaches, 1, cells)

    def run(
        self, cells: int, speed: float = SPEED, moves: bool = True, pull: bool = True, window: float = WINDOW
    ) -> Drawn:
        course = self.course(cells)
        drum = Drum("drive", DRUM, (lambda t, v: (force(t), 0.0)) if pull else (lambda t, v: (0.0, 0.0)))
        tail_drums = [Drum("tail", self.tail)] if self.tail else []
        takeup = None if self.fixed else TakeUp(OFF)
        head, tail = (
            Station(place_at(course, 0, 0.0), [drum], takeup),
            Station(place_at(course, course.tail, 0.0), tail_drums),
        )
        travel = Travel(course, EA, speed) if moves else None
        give = Give(course, Rubber(*self.rubber), EA) if self.rubber[0] else None
        return march(course, head, tail, np.full(course.cells, OFF), speed, window, give=give, travel=travel)

    def reference(self, elements: int, speed: float = SPEED, moves: float = 1.0) -> tuple[np.ndarray, np.ndarray]:
        """Times, and tensions before and behind the drum: speeds at nodes, tensions between them; `moves` is 0 for a
        belt that does not carry its state along."""
        n, dx = elements, LENGTH / elements
        mass = np.repeat(MASSES, n)
        rise = np.repeat((-self.climb, self.climb), n) / n
        base = OFF + np.cumsum(rise) - rise / 2  # at rest
        stiffer, slow = self.rubber[0], self.rubber[1] * (1 + self.rubber[0])
        settled = stiffer / (1 + stiffer) / EA
        start = np.concatenate([np.full(2 * n + 1, speed), base, settled * base])
        start[: 2 * n + 1] *= 1 + moves * (np.concatenate([[OFF], OFF + np.cumsum(rise)]) - OFF) / EA

        def speeds(state: np.ndarray) -> np.ndarray:
            w = state[: 2 * n + 1].copy()
            if self.fixed:
                s = state[2 * n + 1 : 4 * n + 1]
                w[0] = w[-1] * (1 + moves * (1.5 * s[0] - 0.5 * s[1] - 1.5 * s[-1] + 0.5 * s[-2]) / EA)
            return w

        def carried(values: np.ndarray) -> np.ndarray:
            """Slope along the belt, strand by strand."""
            between = (values[1:] - values[:-1]) / dx
            found = np.empty(2 * n)
            found[1:-1] = (between[1:] + between[:-1]) / 2
            found[0], found[-1] = between[0], between[-1]
            found[n - 1], found[n] = between[n - 2], between[n]
            return found

        def slope(time: float, state: np.ndarray) -> np.ndarray:
            w, s, strain = speeds(state), state[2 * n + 1 : 4 * n + 1], state[4 * n + 1 :]
            stretch = np.diff(w) / dx
            middle = (w[1:] + w[:-1]) / 2
            yields = (settled * s - strain) / slow
            ds = EA * (1 + stiffer) * (stretch - yields) - moves * middle * carried(s)
            de = yields - moves * middle * carried(strain)
            dw = np.zeros(2 * n + 1)
            lumps = (mass[1:] + mass[:-1]) / 2
            pulls = s[1:] - s[:-1] - (rise[1:] + rise[:-1]) / 2
            dw[1:-1] = pulls / dx / lumps
            bend = (stretch[1:] + stretch[:-1]) / 2
            bend[n - 1] = (mass[n - 1] * stretch[n - 1] + mass[n] * stretch[n]) / (mass[n - 1] + mass[n])
            dw[1:-1] -= moves * self.goes * w[1:-1] * bend
            heavy = DRUM + mass[-1] * dx / 2
            if self.fixed:
                heavy += mass[0] * dx / 2
                behind = s[0] - rise[0] / 2
            else:
                behind = OFF
                dw[0] = (s[0] - rise[0] / 2 - OFF) / (mass[0] * dx / 2) - moves * self.goes * w[0] * stretch[0]
            dw[-1] = (force(time) + behind - s[-1] - rise[-1] / 2) / heavy
            return np.concatenate([dw, ds, de])

        times = np.linspace(0.0, WINDOW, 600)
        found = solve_ivp(slope, (0, WINDOW), start, method="DOP853", t_eval=times, rtol=1e-7, atol=1e-6)
        s = found.y[2 * n + 1 : 4 * n + 1]
        return times, np.array([1.5 * s[-1] - 0.5 * s[-2], 1.5 * s[0] - 0.5 * s[1]])


def heads(drawn: Drawn, times: np.ndarray) -> np.ndarray:
    return np.array([np.interp(times, drawn.times, [seen.tensions[end] for seen in drawn.head]) for end in (0, -1)])


LOOPS = {
    "constant tension behind": Loop(),
    "fixed length": Loop(fixed=True),
    "heavy idlers": Loop(goes=0.5),
    "uphill": Loop(climb=1e4),
    "Zener belt": Loop(climb=1e4, rubber=(0.3, 2.0)),
}


@pytest.mark.parametrize("name", LOOPS)
def test_finite_differences_come_to_the_same_tensions(name: str) -> None:
    loop = LOOPS[name]
    times, true = loop.reference(300)
    _, still = loop.reference(300, moves=0.0)
    ends = slice(0, 2) if loop.fixed else slice(0, 1)
    off = np.abs(heads(loop.run(600), times) - true)[ends].max()
    changed = np.abs(still - true)[ends].max()
    assert changed > 0.03 * PULL, "it counts"
    assert off < 0.08 * changed


def test_waves_run_faster_with_the_belt_than_against_it() -> None:
    """A drum that pulls a little harder sends a wave against the belt, and in a fixed loop one with it: they are at the
    tail after L/(c - w) and L/(c + w)."""
    fast, slow = (math.sqrt(EA / rho) for rho in MASSES)
    loop = Loop(fixed=True)
    with_it, against = (_arrivals(loop, moves) for moves in (False, True))
    step = loop.course(400).step
    assert with_it[0] - against[0] == pytest.approx(LENGTH / fast - LENGTH / (fast + SPEED), abs=step)
    assert with_it[1] - against[1] == pytest.approx(LENGTH / slow - LENGTH / (slow - SPEED), abs=step)


def _arrivals(loop: Loop, moves: bool) -> tuple[float, float]:
    """When the tail is slackened by so much, and when it is tight again."""
    course = loop.course(400)
    drum = Drum("drive", DRUM, lambda t, v: (PULL / 100, 0.0))
    head, tail = Station(place_at(course, 0, 0.0), [drum], None), Station(place_at(course, course.tail, 0.0), [])
    travel = Travel(course, EA, SPEED) if moves else None
    drawn = march(course, head, tail, np.full(course.cells, OFF), SPEED, 1.4, travel=travel)
    history = np.array([seen.tensions[0] for seen in drawn.tail]) - OFF
    low = int(np.argmin(history[drawn.times < 0.95]))
    level = history[low] / 2
    first, again = int(np.argmax(history < level)), low + int(np.argmax(history[low:] > level))

    def crossing(k: int) -> float:
        part = (level - history[k - 1]) / (history[k] - history[k - 1])
        return float(drawn.times[k - 1] + part * (drawn.times[k] - drawn.times[k - 1]))

    return crossing(first), crossing(again)


def test_a_belt_that_runs_evenly_uphill_goes_on_so() -> None:
    """Its speed falls along with its tension: without that, and without its creep at the drum, waves of w/c times the
    climb would rise; what it begins with is even but for (w/c)^2."""
    loop = Loop(fixed=True, climb=1e4)
    drawn = loop.run(200, pull=False)
    on, off = heads(drawn, drawn.times)
    second = loop.climb * SPEED**2 * MASSES[1] / EA
    assert np.abs(on - on[0]).max() < 2 * second
    assert np.abs(off - off[0]).max() < 2 * second
    assert drawn.energy_residual < 1e-6


def test_what_one_strand_gives_the_other_takes() -> None:
    """A loop of fixed length keeps its length while it runs, but for what is of second order in the strain."""
    drawn = Loop(fixed=True).run(400)
    swing = (drawn.carry_max.value - drawn.carry_min.value) / EA * LENGTH
    assert abs(drawn.stretched) < 0.05 * swing


def test_the_ledger_of_energy_closes() -> None:
    for loop in (*LOOPS.values(), Loop(tail=2e3), Loop(fixed=True, tail=2e3)):
        assert loop.run(200).energy_residual < 1e-6


def test_a_belt_that_runs_back_carries_its_state_back() -> None:
    """The same loop, its strands exchanged and all turned round, has the same tensions, but for the drum: it goes with
    the belt on one side of it, in the mirror with that on the other."""
    there, back = (_turned(forward) for forward in (True, False))
    assert there == pytest.approx(back, rel=5e-3)


def _turned(forward: bool) -> list[float]:
    """Extremes of both strands of an even loop whose drum is pushed: forward, or as in a mirror."""
    ends, sense = np.array([0.0, 1.0]), 1.0 if forward else -1.0
    masses = MASSES if forward else MASSES[::-1]
    course = lay_out(tuple(Reach(rho, EA, LENGTH * ends, 0 * ends, 0 * ends, 0 * ends) for rho in masses), 1, 300)
    drum = Drum("drive", DRUM, lambda t, v: (sense * force(t), 0.0))
    head, tail = Station(place_at(course, 0, 0.0), [drum], None), Station(place_at(course, course.tail, 0.0), [])
    travel = Travel(course, EA, SPEED)
    drawn = march(course, head, tail, np.full(course.cells, OFF), sense * SPEED, 3.0, travel=travel)
    one, other = (drawn.carry_max, drawn.carry_min), (drawn.back_max, drawn.back_min)
    if not forward:
        one, other = other, one
    return [part.value for part in (*one, *other)]
