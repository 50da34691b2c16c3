"""A problem of the performance study: ours and scipy's general solvers on the same work in one run.

Imports nothing from `ptmcalc`. What an answer is (a history, a state at the end) the problem says; its error is the
largest deviation from the truth over the truth's largest value. A peer is held against the cheapest of our settings
that is no less accurate than it: the ratio at equal error. Times are in units of RK45 on x'' = -x over 100 rad at rtol
1e-6, which takes turns with what is timed; such a unit is 16 ms on the machine the targets were written for.
"""

import math
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

METHODS = ("RK45", "DOP853", "LSODA", "Radau", "BDF")
REFERENCE_UNIT = 16e-3
"""Seconds of a unit on the machine of the targets."""
REPEATS = 9
_LEAST = 2e-3
"""Seconds below which a work is repeated within one reading of the clock."""


@dataclass(frozen=True)
class Played:
    """What a peer answers, and how often it evaluated the rates."""

    answer: np.ndarray
    evaluations: int


@dataclass(frozen=True)
class Problem:
    """What is solved.

    Args:
        name: P1 ... P6.
        title: in words.
        target: milliseconds on the machine of the targets; infinite where none is set.
        settings: ours, from the cheapest on: a word for each, and what it answers.
        truth: the exact answer.
        peer: the answer by a solver of scipy with a relative tolerance.
        tolerances: those of peers, loosest first; the first that is as accurate as asked is shown, else the best.
        asked: error that is asked of peers.
    """

    name: str
    title: str
    target: float
    settings: tuple[tuple[str, Callable[[], np.ndarray]], ...]
    truth: Callable[[], np.ndarray]
    peer: Callable[[str, float], Played]
    tolerances: tuple[float, ...]
    asked: float

    def error(self, answer: np.ndarray) -> float:
        true = self.truth()
        return float(np.abs(answer - true).max() / np.abs(true).max())


@dataclass(frozen=True)
class Ours:
    """One of our settings: its error and its time in units."""

    word: str
    error: float
    units: float


@dataclass(frozen=True)
class Peer:
    """A peer: its error, its time in units, its evaluations."""

    method: str
    error: float
    units: float
    evaluations: int


def unit() -> None:
    """The unit of time."""
    solve_ivp(lambda t, y: [y[1], -y[0]], (0.0, 100.0), [1.0, 0.0], "RK45", rtol=1e-6)


def seconds(work: Callable[[], object]) -> float:
    """Processor time of one run; of short work the mean of so many that the clock can tell."""
    count = 1
    while True:
        start = time.process_time()
        for _ in range(count):
            work()
        spent = time.process_time() - start
        if spent >= _LEAST or count > 1_000:
            return spent / count
        count *= 4


def in_units(work: Callable[[], object], repeats: int = REPEATS) -> tuple[float, float]:
    """Least time of a work in units and a unit in seconds, measured in turns."""
    spans = [(seconds(unit), seconds(work)) for _ in range(repeats)]
    one, own = (min(column) for column in zip(*spans, strict=True))
    return own / one, one


def ours(problem: Problem, repeats: int = REPEATS) -> Iterator[Ours]:
    """All of our settings."""
    for word, work in problem.settings:
        error = problem.error(work())  # the first run is not timed
        yield Ours(word, error, in_units(work, repeats)[0])


def peer(problem: Problem, method: str) -> Peer:
    """A peer with the loosest tolerance that does what is asked, or the one that comes nearest; where it breaks down,
    an infinite error."""
    found = Peer(method, math.inf, math.inf, 0)
    for rtol in problem.tolerances:
        unit_now = min(seconds(unit) for _ in range(3))
        start = time.process_time()
        try:
            played = problem.peer(method, rtol)
        except (RuntimeError, ValueError, ArithmeticError):
            continue
        spent = time.process_time() - start
        error = problem.error(played.answer)
        if error < found.error:
            found = Peer(method, error, spent / unit_now, played.evaluations)
        if found.error <= problem.asked:
            break
    return found


def ratio(peer_found: Peer, own: list[Ours]) -> float | None:
    """Time of a peer over that of the cheapest of our settings which is no less accurate; None where none is."""
    equal = [one.units for one in own if one.error <= peer_found.error]
    return peer_found.units / min(equal) if equal and math.isfinite(peer_found.error) else None


COLUMNS = ("problem", "ptmcalc", "error", "units", "ms at 16 ms a unit", "target", *METHODS)


def rows(problem: Problem, repeats: int = REPEATS) -> list[list[str]]:
    """The rows of a problem: one for each of our settings, the last one with the peers."""
    own = list(ours(problem, repeats))
    found = [peer(problem, method) for method in METHODS]
    made = []
    for one in own:
        cells = [f"{problem.name} {problem.title}", one.word, f"{one.error:.0e}", f"{one.units:.3g}"]
        target = f"{problem.target:g} ms" if math.isfinite(problem.target) else "-"
        cells += [f"{float(f'{1e3 * REFERENCE_UNIT * one.units:.2g}'):g} ms", target]
        made.append([*cells, *("" for _ in METHODS)])
    made[-1][-len(METHODS) :] = [told(one, ratio(one, own)) for one in found]
    return made


def told(found: Peer, over: float | None) -> str:
    """A peer as a cell: its ratio at equal error and that error; one that is wrong by as much as it computes breaks
    down."""
    if not found.error < 1:
        return "breaks down"
    size = "-" if over is None else f"{over:,.0f} times" if over >= 10 else f"{over:.1f} times"
    return f"{size} at {found.error:.0e}"


def table(all_rows: list[list[str]]) -> str:
    """In markdown."""
    lines = [COLUMNS, ["---"] * len(COLUMNS), *all_rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)
