"""Stops and starts of a belt whose spans sag: an independent nonlinear reference. Imports nothing from `ptmcalc`.

Lumped masses and springs in equal steps of travel time, central differences. A spring has the strain of the belt and of
its parabolic spans, S/EA - (w l)^2/(24 S^2), or of the belt alone; everything else is the same in both, so what they
differ by is sag. Idlers and brakes hold or slide by the return map of `belt_fem`; the drum does not slip.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from support.belt_scenes import Rig, counts_of

_COURANT = 0.5


@dataclass(frozen=True)
class Swing:
    """Extremes of the tension of a scene [N], anywhere and at the run-on."""

    highest: float
    lowest: float
    run_on: float

    @property
    def amplitude(self) -> float:
        return (self.highest - self.lowest) / 2

    def apart(self, other: "Swing") -> float:
        """Largest difference of the same extreme [N]."""
        pairs = ((self.highest, other.highest), (self.lowest, other.lowest), (self.run_on, other.run_on))
        return max(abs(one - two) for one, two in pairs)


def softening(stiffness: float, span: float, tension: float) -> float:
    """Give of the spans over that of the belt (Ernst): EA (w l)^2/(12 S^3)."""
    return stiffness * span**2 / (12 * tension**3)


def _tension(strain: np.ndarray, stiffness: float, kappa: np.ndarray, guess: np.ndarray) -> np.ndarray:
    """S of S/EA - kappa/S^2 = strain, by Newton from above or below, kept positive."""
    s = guess
    for _ in range(50):
        new = s - (s / stiffness - kappa / s**2 - strain) / (1 / stiffness + 2 * kappa / s**3)
        new = np.maximum(new, 0.2 * s)
        if float(np.max(np.abs(new - s) / s)) < 1e-12:
            return new
        s = new
    return s


def swing(
    rig: Rig,
    pitches: tuple[float, float],
    window: float,
    elements: int,
    *,
    sags: bool,
    force: Callable[[float], float] | None = None,
    relaxed: bool = False,
    retardation: float = 0.0,
) -> Swing:
    """A stop from full speed, or with `force` (rim force over time [N]) a start from rest, of one drive at the head,
    which holds its drum at rated speed once it has it.

    With a retardation time the belt between the spans is of Kelvin and Voigt, S = EA (e + t e'): over a step its
    strain e = (S dt/EA + t e_old)/(dt + t), which makes it stiffer by t/dt for the step.
    """
    lengths = rig.lengths(factor=rig.start_factor if force else 1.0)
    counts = counts_of(lengths, elements)
    h = np.concatenate([np.full(n, one.length / n) for one, n in zip(lengths, counts, strict=True)])
    per = {
        key: np.concatenate([np.full(n, getattr(one, key)) for one, n in zip(lengths, counts, strict=True)])
        for key in ("line_mass", "friction", "climb")
    }
    tail = sum(counts[: len(counts) // 2])
    weight = np.where(np.arange(len(h)) < tail, rig.belt * pitches[1], (rig.belt + rig.load) * pitches[0]) * rig.gravity
    kappa = weight**2 / 24 if sags else np.zeros(len(h))
    m, w, c = (per[key] * h for key in ("line_mass", "friction", "climb"))
    mass, hold, pull = (np.concatenate([x, [0.0]]) / 2 + np.concatenate([[0.0], x]) / 2 for x in (m, w, c))
    drum = next(iter(rig.drives.values()))
    mass[tail] += rig.tail_mass
    if rig.rigid:  # one node closes the loop
        mass[-1] += mass[0]
        hold[-1] += hold[0]
        pull[-1] += pull[0]
    mass[-1] += drum.mass
    start = (rig.relaxed if relaxed else rig.running)(lengths, elements) + np.cumsum(c) - c / 2
    radius = drum.diameter / 2
    brakes = [brake.capacity(radius) for brake in rig.brakes] if force is None else []
    strain = start / rig.stiffness - kappa / start**2
    own = start / rig.stiffness
    dt = _COURANT * float(np.min(h * np.sqrt(per["line_mass"] / rig.stiffness)))
    dt = 2 * dt**2 / (retardation + math.hypot(retardation, 2 * dt))  # so much shorter for the stiffer step
    soft = dt / (dt + retardation)
    speed = 0.0 if force else rig.speed
    u, v, s = np.zeros(len(mass)), np.full(len(mass), speed), start.copy()
    held = pull[-1] + start[-1] - (start[0] if rig.rigid else rig.tension)
    high, low, on, loose, at_rated = -math.inf, math.inf, -math.inf, False, False
    for step in range(math.ceil(window / dt)):
        time = step * dt
        stretch = strain + np.diff(u) / h
        rest = (1 - soft) * own
        stiff = rig.stiffness / soft
        s = _tension(stretch - rest, stiff, kappa, s) if sags else (stretch - rest) * stiff
        own = s / stiff + rest
        high, low, on = max(high, float(s.max())), min(low, float(s.min())), max(on, float(s[-1]))
        net = np.empty_like(v)
        net[1:-1] = np.diff(s)
        net[0] = s[0] - rig.tension
        net[-1] = (s[0] if rig.rigid else rig.tension) - s[-1]
        net -= pull
        friction = hold.copy()
        if force is not None:
            given = force(time)
            loose = loose or given >= held
            net[-1] += given
            friction[-1] += 0.0 if loose else math.inf
        friction[-1] += sum(brake(time) for brake in brakes)
        free = v + dt / mass * net
        v = np.copysign(np.maximum(np.abs(free) - dt / mass * friction, 0.0), free)
        at_rated = force is not None and (at_rated or v[-1] >= rig.speed)
        if at_rated:
            v[-1] = rig.speed
        if rig.rigid:
            v[0] = v[-1]
        u = u + dt * v
    return Swing(high, low, on)
