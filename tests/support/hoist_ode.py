"""Hoists integrated by themselves: a chain of masses for the rope, or a rope that gets shorter; DOP853 between events.

Nothing of ours is used. All forces are at the hook; the drive is a mass with a straight line of torque over speed, or
a brake; losses go by the direction of power, hauling while the drum turns up, reverse while the load turns it.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import eigh

G = 9.81
OPTIONS = {"method": "DOP853", "rtol": 1e-8, "atol": 1e-10}
SEEN = 20_001


@dataclass(frozen=True)
class Machine:
    """A hoist in SI. `starting` and `free` are the torque at rest and the speed without load of the motor."""

    load: float
    stiffness: float
    length: float
    rope: float
    arm: float
    ratio: float
    motor: float
    drum: float
    gear: float
    tackle: float
    lowering: float
    speed: float
    starting: float
    free: float
    brake: float
    delay: float
    rise: float
    structure: tuple[float, float] | None

    @property
    def weight(self) -> float:
        return self.load * G

    @property
    def back(self) -> float:
        return 2 - 1 / self.gear


def natural_frequency(one: Machine, pieces: int) -> float:
    """Lowest frequency but that of travel, with the rope as a chain, drive free, structure elastic."""
    drive = one.motor * (one.ratio / one.arm) ** 2 + one.drum / one.arm**2
    mass = [drive, *[one.rope / pieces] * (pieces - 1), one.load]
    mass += [one.structure[1]] if one.structure is not None else []
    stiff = np.zeros((len(mass), len(mass)))
    for k in range(pieces):
        row = np.zeros(len(mass))
        row[k], row[k + 1] = 1.0, -1.0
        if k == 0 and one.structure is not None:
            row[-1] = -1.0
        stiff += one.stiffness * pieces * np.outer(row, row)
    if one.structure is not None:
        stiff[-1, -1] += one.structure[0]
    return math.sqrt(eigh(stiff, np.diag(mass), eigvals_only=True)[1])


def drive_mass(one: Machine, hauling: bool) -> float:
    """Motor and drum at the hook, so that mass times acceleration is the drive's force less that of the rope."""
    if hauling:
        return (one.motor * one.ratio**2 * one.gear + one.drum) * one.tackle / one.arm**2
    return (one.motor * one.ratio**2 / one.back + one.drum) / one.lowering / one.arm**2


@dataclass
class Seen:
    """What a run has shown: forces of the rope (largest and smallest of all sections) and of the structure."""

    most: float = 0.0
    least: float = math.inf
    bridge: float = 0.0
    lowest: float = 0.0
    lifted: float = math.inf
    speed: float = 0.0
    stopped: float = math.inf
    slips: bool = False
    """whether the load pulls the drum through the closed brake once more, which is not followed"""


class Chain:
    """Hook end of the drum, masses of the rope, load, structure; of one piece it is a rope without mass.

    A rope that is taken up has the state s, its unstretched length: s' = -v/(1 + e), F = K l_0 e.
    """

    def __init__(self, one: Machine, pieces: int, shortens: bool) -> None:
        self.one, self.pieces, self.shortens = one, pieces, shortens
        self.count = pieces + 1

    def forces(self, y: np.ndarray) -> np.ndarray:
        one, x = self.one, y[: self.count]
        sag = y[2 * self.count] if one.structure is not None else 0.0
        if self.shortens:
            s = y[-1]
            strain = (one.length - x[-1] - sag - s) / s
            return np.maximum(np.atleast_1d(one.stiffness * one.length * strain), 0.0)
        pull = one.stiffness * self.pieces * (x[:-1] - x[1:])
        pull[0] -= one.stiffness * self.pieces * sag
        return np.maximum(pull, 0.0)

    def rate(self, y: np.ndarray, push: float, mass: float, on_ground: bool, held: bool) -> np.ndarray:
        one, n = self.one, self.count
        pull, out = self.forces(y), np.zeros_like(y)
        out[:n] = y[n : 2 * n]
        out[n] = 0.0 if held else (push - pull[0]) / mass
        if n > 2:
            out[n + 1 : 2 * n - 1] = (pull[:-1] - pull[1:]) / (one.rope / self.pieces)
        out[2 * n - 1] = 0.0 if on_ground else (pull[-1] - one.weight) / one.load
        if one.structure is not None:
            out[2 * n] = y[2 * n + 1]
            out[2 * n + 1] = (pull[0] - one.structure[0] * y[2 * n]) / one.structure[1]
        if self.shortens:
            strain = pull[0] / (one.stiffness * one.length)
            out[-1] = -y[n] / (1 + strain)
        return out

    def start(self, speed: float, stretch: float, hangs: bool) -> np.ndarray:
        one, n = self.one, self.count
        sag = one.weight / one.structure[0] if one.structure is not None and hangs else 0.0
        x = np.linspace(stretch, 0.0, n) + np.where(np.arange(n) == 0, sag, 0.0)
        v = np.full(n, speed) if hangs else np.where(np.arange(n) == 0, speed, 0.0)
        parts = [x, v, *([[sag, 0.0]] if one.structure is not None else [])]
        if self.shortens:
            parts.append([(one.length - sag) / (1 + stretch / one.length)])
        return np.concatenate([np.asarray(part, float) for part in parts])

    def look(self, seen: Seen, run, first: float, last: float) -> None:  # type: ignore[no-untyped-def]
        y = run.sol(np.linspace(first, last, SEEN))
        pull = self.forces(y)
        seen.most, seen.least = max(seen.most, float(pull.max())), min(seen.least, float(pull.min()))
        if self.one.structure is not None:
            seen.bridge = max(seen.bridge, self.one.structure[0] * float(y[2 * self.count].max()))
        seen.lowest = min(seen.lowest, float(y[self.count - 1].min()))


def lift(one: Machine, end: float, pieces: int = 1, shortens: bool = False) -> Seen:
    """A load lifted off the ground by a motor that runs at its no-load speed as the rope comes taut."""
    chain, seen = Chain(one, pieces, shortens), Seen()
    mass, gain = drive_mass(one, hauling=True), one.ratio * one.gear * one.tackle / one.arm

    def push(y: np.ndarray) -> float:
        return one.starting * (1 - y[chain.count] / one.arm * one.ratio / one.free) * gain

    def off(t: float, y: np.ndarray) -> float:
        return float(chain.forces(y)[-1] - one.weight)

    off.terminal, off.direction = True, 1  # type: ignore[attr-defined]
    y = chain.start(one.free / one.ratio * one.arm, 0.0, hangs=False)
    first = solve_ivp(
        lambda t, y: chain.rate(y, push(y), mass, True, False), (0, end), y, dense_output=True, events=off, **OPTIONS
    )
    chain.look(seen, first, 0.0, first.t[-1])
    if not len(first.t_events[0]):
        return seen
    seen.lifted, seen.speed = float(first.t[-1]), float(first.y[chain.count, -1])
    second = solve_ivp(
        lambda t, y: chain.rate(y, push(y), mass, False, False), (seen.lifted, end), first.y[:, -1],
        dense_output=True, **OPTIONS,
    )  # fmt: skip
    chain.look(seen, second, seen.lifted, end)
    return seen


def lower(one: Machine, end: float, pieces: int = 1, shortens: bool = False) -> Seen:
    """A lowered load that a brake stops and holds."""
    chain, seen = Chain(one, pieces, shortens), Seen()
    mass, gain = drive_mass(one, hauling=False), one.ratio / (one.arm * one.back * one.lowering)

    def stands(t: float, y: np.ndarray) -> float:
        return float(y[chain.count])

    stands.terminal, stands.direction = True, 1  # type: ignore[attr-defined]
    y, time = chain.start(-one.speed, one.weight / one.stiffness, hangs=True), 0.0
    for until in (one.delay, one.delay + one.rise, end):
        if until <= time or math.isfinite(seen.stopped):
            continue

        def closing(t: float, last: float = until) -> float:
            if last <= one.delay:
                return 0.0
            return one.brake * min(max((t - one.delay) / one.rise, 0.0), 1.0) if one.rise else one.brake

        run = solve_ivp(
            lambda t, y, c=closing: chain.rate(y, c(t) * gain, mass, False, False),  # type: ignore[misc]
            (time, until), y, dense_output=True, events=stands, **OPTIONS,
        )  # fmt: skip
        chain.look(seen, run, time, run.t[-1])
        y, time = run.y[:, -1], float(run.t[-1])
        if len(run.t_events[0]):
            seen.stopped = time
    if math.isfinite(seen.stopped):
        y[chain.count] = 0.0
        held = solve_ivp(
            lambda t, y: chain.rate(y, 0.0, mass, False, True), (time, end), y, dense_output=True, **OPTIONS
        )
        chain.look(seen, held, time, end)
        seen.slips = float(chain.forces(held.sol(np.linspace(time, end, SEEN)))[0].max()) * gain**-1 > one.brake
    return seen
