"""Starts of a chain whose motors follow their own formulas, by finite elements. Imports nothing from `ptmcalc`.

Lumped masses along both strands, Kelvin-Voigt damping, the exponential of the first-order form over a step, the force
of the motors straight over a step and corrected until it fits the speed of the sprocket. The gear loses its share by
the direction of the force that it transmits: two systems, whose drive has a different mass at the chain.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.linalg import expm

from support import chain_fem

SYNCHRONOUS = 1500 * math.pi / 30


@dataclass(frozen=True)
class Gear:
    """Motors with what is between them and the mains: torque of one over time and speed [N*m, rad/s]."""

    kind: str
    rated: float
    slip: float
    locked: float
    breakdown: float
    more: float = 0.0
    limit: float = math.inf
    time: float = 1.0
    switch: float = 0.85

    def cage(self, speed: float) -> float:
        """Straight lines through locked-rotor, pull-up and breakdown torque; Kloss above."""
        at = self.slip * (self.breakdown + math.sqrt(self.breakdown**2 - 1))
        slip, top = 1 - speed / SYNCHRONOUS, (1 - at) * SYNCHRONOUS
        if speed >= top:
            return self.rated * 2 * self.breakdown * slip * at / (slip**2 + at**2)
        third, pull_up = SYNCHRONOUS / 3, 0.85 * self.locked
        if speed < third:
            return self.rated * (self.locked + (pull_up - self.locked) * max(speed, 0.0) / third)
        return self.rated * (pull_up + (self.breakdown - pull_up) * (speed - third) / (top - third))

    def torque(self, time: float, speed: float, delta: bool) -> float:
        if self.kind == "coupling":
            share = (1 - speed / SYNCHRONOUS) / (self.slip + self.more)
            return self.rated * float(np.clip(share, -self.limit, self.limit)) * -math.expm1(-3 * time / self.time)
        if self.kind == "kloss":
            slip, at = 1 - speed / SYNCHRONOUS, self.slip * (self.breakdown + math.sqrt(self.breakdown**2 - 1))
            return self.rated * 2 * self.breakdown * slip * at / (slip**2 + at**2)
        if self.kind == "linear":
            return self.rated * self.locked * (1 - speed / SYNCHRONOUS)
        found = self.cage(speed)
        if self.kind == "soft":
            found *= (0.5 + 0.5 * min(time / self.time, 1.0)) ** 2
        return found / 3 if self.kind == "star_delta" and not delta else found


@dataclass(frozen=True)
class Plant:
    """Strands from the run-on on, tail mass, whether the loop has a fixed length, sprocket and motors as masses at the
    chain, efficiency, speed of the motor per speed of the chain, static tensions at the four ends from the run-on on,
    resistance, retardation; a strand without mass behind the tail where `slack`."""

    strands: tuple[chain_fem.Strand, ...]
    tail_mass: float
    fixed: bool
    sprocket: float
    rotor: float
    efficiency: float
    turns: float
    static: tuple[float, ...]
    resistance: float
    retardation: float

    def system(self, pieces: int, losses: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Masses, stiffness, and rows of the tensions of the elements, those at the ends extrapolated to them."""
        ends = self.strands
        if len(ends) == 1:
            mass, stiff = chain_fem.matrices(chain_fem.Chain(ends, 0.0, self.tail_mass), pieces, lumped=True)
        else:
            mass, stiff = chain_fem.matrices(chain_fem.Chain(ends, self.tail_mass), pieces, lumped=True)
        count = len(mass)
        rows = np.zeros((count - 1, count))
        for k in range(count - 1):
            rows[k, [k, k + 1]] = stiff[k, k + 1] * np.array([-1.0, 1.0])
        beyond = []
        for first in range(0, count - 1, pieces):
            last = first + pieces - 1
            beyond += [(3 * rows[first] - rows[first + 1]) / 2, (3 * rows[last] - rows[last - 1]) / 2]
        if not self.fixed and len(ends) == 2:
            beyond[-1] = np.zeros(count)
        rows = np.concatenate([rows, np.array(beyond)])
        mass[0, 0] += self.sprocket + losses * self.rotor
        if self.fixed:
            join = np.eye(count, count - 1)
            join[-1, 0] = 1.0
            mass, stiff, rows = join.T @ mass @ join, join.T @ stiff @ join, rows @ join
        return np.diag(mass).copy(), stiff, rows

    def statics(self, pieces: int) -> np.ndarray:
        """Static tensions of the elements and at the ends of the strands."""
        middles = (np.arange(pieces) + 0.5) / pieces
        inner = [one + middles * (two - one) for one, two in zip(self.static[::2], self.static[1::2], strict=True)]
        return np.concatenate([*inner, np.array(self.static)])


@dataclass(frozen=True)
class Coupled(Plant):
    """A conveyor whose tail sprocket has the speed of the driving one: node 0 is both, and each strand hangs on it at
    both ends, the return strand free at the run-off unless `fixed`."""

    def system(self, pieces: int, losses: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """As `Plant.system`, the working strand first, each from its end in the direction of the travel."""
        inner = pieces - 1
        working = [0, *range(1, inner + 1), 0]
        back = [0, *range(inner + 1, 2 * inner + 1), 0 if self.fixed else 2 * inner + 1]
        count = 2 * inner + (1 if self.fixed else 2)
        mass, stiff, rows = np.zeros(count), np.zeros((count, count)), []
        for strand, nodes in zip(self.strands, (working, back), strict=True):
            h = strand.length / pieces
            for ahead, behind in pairwise(nodes):
                row = np.zeros(count)
                row[ahead] += strand.stiffness / h
                row[behind] -= strand.stiffness / h
                stiff[ahead] += row
                stiff[behind] -= row
                mass[ahead] += strand.line_mass * h / 2
                mass[behind] += strand.line_mass * h / 2
                rows.append(row)
        beyond = []
        for first in (0, pieces):
            last = first + inner
            beyond += [(3 * rows[first] - rows[first + 1]) / 2, (3 * rows[last] - rows[last - 1]) / 2]
        if not self.fixed:
            beyond[-1] = np.zeros(count)
        mass[0] += self.sprocket + losses * self.rotor + self.tail_mass
        return mass, stiff, np.array([*rows, *beyond])


@dataclass
class Seen:
    """Largest dynamic tension at the run-on, smallest tension anywhere, largest and smallest force through the shaft
    of the sprocket, last speed."""

    entering: float
    smallest: float
    most: float
    least: float
    speed: float


@dataclass(frozen=True)
class Teeth:
    """Pitch and teeth of the driving sprocket, and how far the first joint is behind its engagement, in pitches."""

    pitch: float
    count: int
    lead: float

    def ahead(self, travel: float) -> tuple[float, float]:
        """How far the entering chain is ahead of the mean motion, and its slope over the travel."""
        half = math.pi / self.count
        radius = self.pitch / (2 * math.sin(half))
        place = (travel / self.pitch + self.lead) % 1.0 - 0.5
        angle = 2 * half * place
        return radius * math.sin(angle) - self.pitch * place, radius * math.cos(angle) * 2 * half / self.pitch - 1


def _maps(
    plant: Plant, pieces: int, losses: float, dt: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    mass, stiff, rows = plant.system(pieces, losses)
    n = len(mass)
    rate = np.zeros((2 * n + 4, 2 * n + 4))
    rate[:n, n : 2 * n] = np.eye(n)
    rate[n : 2 * n, :n] = -stiff / mass[:, None]
    rate[n : 2 * n, n : 2 * n] = -plant.retardation * stiff / mass[:, None]
    rate[n, 2 * n] = 1 / mass[0]
    rate[n : 2 * n, 2 * n + 2] = -stiff[:, 0] / mass
    rate[2 * n, 2 * n + 1] = rate[2 * n + 2, 2 * n + 3] = 1.0
    step = expm(rate * dt)
    held, risen = step[: 2 * n, [2 * n, 2 * n + 2]], step[: 2 * n, [2 * n + 1, 2 * n + 3]] / dt
    old, new = held - risen, risen
    return step[: 2 * n, : 2 * n], old[:, 0], new[:, 0], mass, stiff[0], rows, old[:, 1], new[:, 1]


def start(plant: Plant, pull: Callable[[float, float, bool], float], switch: float, window: float, pieces: int,
          dt: float, teeth: Teeth | None = None) -> Seen:  # fmt: skip
    """A start; `pull` is the torque of all motors at the chain [N] by time, speed, and whether the starter has switched
    over, which it does at the speed `switch`. Held until the motors pull more than the chain resists."""
    eta, w, lag = plant.efficiency, plant.resistance, plant.retardation
    made = {losses: _maps(plant, pieces, losses, dt) for losses in (eta, 1 / eta)}
    n = len(made[eta][3])
    statics = plant.statics(pieces)
    state, time, delta, ahead = np.zeros(2 * n), 0.0, switch <= 0, 0.0
    seen = Seen(0.0, float(statics.min()), w, w, 0.0)
    losses = eta if w >= 0 else 1 / eta
    standing = losses * pull(0.0, 0.0, delta)
    while time < window and losses * pull(time, 0.0, delta) <= w:
        standing = max(standing, losses * pull(time, 0.0, delta))
        time += dt
    if time >= window and standing <= w:  # held by friction, brake or backstop
        return Seen(0.0, float(statics.min()), standing, standing, 0.0)
    kept: list[np.ndarray] = []
    first = teeth.ahead(0.0)[0] if teeth is not None else 0.0

    def gone_ahead(here: np.ndarray) -> float:
        """Elongation of the chain by the polygon, with its share of the damping."""
        if teeth is None:
            return 0.0
        by, slope = teeth.ahead(float(here[0]))
        return by - first + lag * slope * float(here[n])

    def through(force: float, here: np.ndarray, by: float, ahead: float) -> float:
        """Force that the gear passes on, by the motion of its motors."""
        mass, row = made[by][3], made[by][4]
        swung = (force - float(row @ (here[:n] + lag * here[n:])) - row[0] * ahead) / mass[0]
        return by * (pull(time, float(here[n]), delta) - plant.rotor * swung)

    if through(losses * pull(time, 0.0, delta) - w, state, losses, 0.0) * (1 if losses == eta else -1) < 0:
        losses = 1 / eta if losses == eta else eta
    while time < window:
        free, old, new, _, _, rows, old_ahead, new_ahead = made[losses]
        before = losses * pull(time, float(state[n]), delta) - w
        moved, after, then = free @ state + old * before + old_ahead * ahead, before, ahead
        for _ in range(4):
            guess = moved + new * after + new_ahead * then
            after = losses * pull(time + dt, float(guess[n]), delta) - w
            then = gone_ahead(guess)
        state, time, ahead = moved + new * after + new_ahead * then, time + dt, then
        if not delta and state[n] >= switch:
            delta = True
            after = losses * pull(time, float(state[n]), delta) - w
        passed = through(after, state, losses, ahead)
        seen.most, seen.least = max(seen.most, passed), min(seen.least, passed)
        if passed * (1 if losses == eta else -1) < 0:
            losses = 1 / eta if losses == eta else eta
        both = state[:n] + lag * state[n:]
        both[0] += ahead
        kept.append(both)
        if len(kept) == 500 or time >= window:
            tensions = np.array(kept) @ rows.T
            entering = tensions[:, len(statics) - len(plant.static)]
            seen.entering = max(seen.entering, float(entering.max()))
            seen.smallest = min(seen.smallest, float((statics + tensions).min()))
            kept = []
    seen.speed = float(state[n])
    return seen


def imposed(plant: Plant, acceleration: Callable[[float], float], window: float, pieces: int, dt: float) -> Seen:
    """A start whose sprocket is accelerated as given: the elements relative to it."""
    mass, stiff, rows = plant.system(pieces, 1.0)
    n = len(mass) - 1
    m, k = mass[1:], stiff[1:, 1:]
    rate = np.zeros((2 * n + 2, 2 * n + 2))
    rate[:n, n : 2 * n] = np.eye(n)
    rate[n : 2 * n, :n], rate[n : 2 * n, n : 2 * n] = -k / m[:, None], -plant.retardation * k / m[:, None]
    rate[n : 2 * n, 2 * n] = -1.0
    rate[2 * n, 2 * n + 1] = 1.0
    step = expm(rate * dt)
    statics, state = plant.statics(pieces), np.zeros(2 * n)
    entering, smallest, kept = 0.0, float(statics.min()), []
    for j in range(math.ceil(window / dt)):
        first, last = acceleration(j * dt), acceleration((j + 1) * dt)
        state = (step @ np.concatenate([state, [first, (last - first) / dt]]))[: 2 * n]
        kept.append(state)
    both = np.array(kept)
    tensions = (both[:, :n] + plant.retardation * both[:, n:]) @ rows[:, 1:].T
    entering = max(entering, float(tensions[:, len(statics) - len(plant.static)].max()))
    smallest = min(smallest, float((statics + tensions).min()))
    return Seen(entering, smallest, 0.0, 0.0, 0.0)
