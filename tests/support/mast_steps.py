"""The elements of `mast_fem` marched in even steps by matrix exponentials: all modes of theirs, no step too long.

A base is pushed to a speed by a force that rises in a straight line, or stopped by one, and held there as long as the
force suffices; a guide holds the far end against the base beyond its play. Between two changes the equations are
linear, and a change is found by halving within its step.
"""

import math
from dataclasses import dataclass, field

import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq

from support.mast_fem import Array, Reference

Phase = tuple[int, int, bool]
"""Which way the base is pushed, 0 where it is held; the side on which the guide is touched; whether the force rises."""


@dataclass
class Seen:
    """Largest swing of the far end beside the base [m], when the base first had the wanted speed, and since when it
    has it up to the end [s]."""

    swing: float = 0.0
    first: float = math.inf
    last: float = math.inf


@dataclass
class March:
    """A start from rest or a stop from a speed, by a force [N] that comes up in `rise` [s]."""

    mast: Reference
    begins: float
    wanted: float
    size: float
    rise: float
    stiffness: float = 0.0
    """of a guide with play [N/m]"""
    play: float = math.inf
    _rates: dict[Phase, tuple[Array, Array]] = field(default_factory=dict)
    _steps: dict[Phase, Array] = field(default_factory=dict)

    def rates(self, phase: Phase) -> tuple[Array, Array]:
        """The matrix of z' = A z, z the shifts, the speeds, 1 and the time, and the row of the force that holds."""
        if phase not in self._rates:
            slips, side, rises = phase
            n, one, time = self.mast.size, -2, -1
            force = np.zeros((n, 2 * n + 2))
            force[:, :n], force[:, n : 2 * n] = -self.mast.k, -self.mast.c
            force[0, time if rises else one] += slips * (self.size / self.rise if rises else self.size)
            if side:
                force[:, :n] -= self.stiffness * np.outer(self.mast.beside, self.mast.beside)
                force[:, one] += side * self.stiffness * self.play * self.mast.beside
            inverse = np.linalg.inv(self.mast.m)
            a = inverse @ force
            holds = np.zeros(2 * n + 2)
            if not slips:
                holds = -a[0] / inverse[0, 0]
                a = a + np.outer(inverse[:, 0], holds)
            rate = np.zeros((2 * n + 2, 2 * n + 2))
            rate[:n, n : 2 * n], rate[n : 2 * n], rate[time, one] = np.eye(n), a, 1.0
            self._rates[phase] = rate, holds
        return self._rates[phase]

    def guards(self, phase: Phase, z: Array) -> list[float]:
        """What stays above 0 as long as a phase lasts."""
        n = self.mast.size
        slips, side, rises = phase
        capacity = self.size * (z[-1] / self.rise if rises else 1.0)
        way = float(self.mast.beside @ z[:n])
        base = slips * (self.wanted - z[n]) if slips else capacity - abs(float(self.rates(phase)[1] @ z))
        return [float(base), side * way - self.play if side else self.play - abs(way)]

    def after(self, phase: Phase, z: Array, which: int) -> Phase:
        """The phase behind a guard that has come to 0."""
        slips, side, rises = phase
        if which == 1:
            return slips, 0 if side else int(np.sign(self.mast.beside @ z[: self.mast.size])), rises
        if slips == 0:  # what would be needed is more than there is: it is pushed the way of that
            return int(np.sign(self.rates(phase)[1] @ z)), side, rises
        held = self.rates((0, side, rises))[1]
        capacity = self.size * (z[-1] / self.rise if rises else 1.0)
        needed = float(held @ z)
        return (0 if abs(needed) <= capacity else int(np.sign(needed))), side, rises

    def run(self, end: float, count: int) -> Seen:
        """Until a time, in so many steps."""
        n, step = self.mast.size, end / count
        z = np.zeros(2 * n + 2)
        z[n : 2 * n] = self.begins * _all_at_once(self.mast)
        z[-2] = 1.0
        seen, phase = Seen(), (1 if self.wanted > self.begins else -1, 0, self.rise > 0)
        while z[-1] < end * (1 - 1e-12):
            until = self.rise if phase[2] else end
            whole = step <= until - z[-1]
            if whole and phase not in self._steps:
                self._steps[phase] = expm(self.rates(phase)[0] * step)
            lasts = step if whole else until - z[-1]
            new = (self._steps[phase] if whole else expm(self.rates(phase)[0] * lasts)) @ z
            fired = [k for k, value in enumerate(self.guards(phase, new)) if value < -1e-13 * max(1.0, self.size * k)]
            if fired:
                lasts, which = min((self._root(phase, z, lasts, k), k) for k in fired)
                new = expm(self.rates(phase)[0] * lasts) @ z
            self._look(seen, z, new, lasts)
            z = new
            if fired:
                if which == 0 and phase[0]:
                    z[n], seen.first = self.wanted, min(seen.first, float(z[-1]))
                slipped, phase = phase[0], self.after(phase, z, which)
                if which == 0 and bool(slipped) != bool(phase[0]):
                    seen.last = math.inf if phase[0] else float(z[-1])
            if phase[2] and z[-1] >= self.rise * (1 - 1e-12):
                phase = (phase[0], phase[1], False)
        return seen

    def _root(self, phase: Phase, z: Array, lasts: float, which: int) -> float:
        """When a guard comes to 0 within a step."""
        rate = self.rates(phase)[0]

        def value(time: float) -> float:
            return self.guards(phase, expm(rate * time) @ z)[which]

        return 0.0 if value(0.0) <= 0 else float(brentq(value, 0.0, lasts, xtol=1e-13, rtol=1e-13))

    def _look(self, seen: Seen, z: Array, new: Array, lasts: float) -> None:
        """The swing at the end of a step, and where it turns within it by a cubic."""
        n = self.mast.size
        ends = [float(self.mast.beside @ one[:n]) for one in (z, new)]
        rates = [float(self.mast.beside @ one[n : 2 * n]) * lasts for one in (z, new)]
        found = [abs(ends[1])]
        if rates[0] * rates[1] < 0:
            a, b = 2 * (ends[0] - ends[1]) + sum(rates), 3 * (ends[1] - ends[0]) - 2 * rates[0] - rates[1]
            turns = [s.real for s in np.roots([3 * a, 2 * b, rates[0]]) if abs(s.imag) < 1e-9 and 0 < s.real < 1]
            found += [abs(((a * s + b) * s + rates[0]) * s + ends[0]) for s in turns]
        seen.swing = max(seen.swing, *found)


def _all_at_once(mast: Reference) -> Array:
    """The shift of all unknowns as the base moves by 1 and nothing bends."""
    found = np.ones(mast.size)
    found[1:] = np.linalg.solve(mast.k[1:, 1:], -mast.k[1:, 0])
    return found
