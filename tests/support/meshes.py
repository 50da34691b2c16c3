"""A belt between its take-up and its drum in linear bar elements, as an ODE that general solvers can take.

Imports nothing from `ptmcalc`. The mass matrix is lumped, consistent, or the mean of both, which passes waves of four
elements' length almost without dispersion: the best that linear elements can do. Coulomb friction is tanh(v/v0), which
such solvers need. A gravity take-up holds the run-off at a constant tension.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import eigh, lapack
from scipy.sparse import lil_matrix

LUMPED, CONSISTENT, MEAN = 0.0, 1.0, 0.5
"""Share of the consistent mass matrix."""


@dataclass(frozen=True)
class Line:
    """A uniform length of belt: m, kg/m, and per length friction N/m and drag N*s/m^2."""

    length: float
    line_mass: float
    friction: float = 0.0
    drag: float = 0.0


@dataclass(frozen=True)
class Answer:
    """Run-on tension at the samples, read from the drum's acceleration and from the last spring, and evaluations."""

    readings: tuple[np.ndarray, np.ndarray]
    evaluations: int


class Mesh:
    """Elements from the take-up to the drum, of equal travel time in all."""

    def __init__(
        self,
        lines: Sequence[Line],
        stiffness: float,
        drum: float,
        force: Callable[[float, float], float],
        count: int,
        masses: float = LUMPED,
        soft: float = 1.0,
    ) -> None:
        self.drum, self.force, self.soft, self.lumped = drum, force, soft, masses == LUMPED
        transit = [line.length * math.sqrt(line.line_mass) for line in lines]
        parts = [max(round(count * one / sum(transit)), 1) for one in transit]

        def lumps(of: Callable[[Line], float]) -> np.ndarray:
            return np.concatenate([np.full(n, of(one) / n) for n, one in zip(parts, lines, strict=True)])

        def nodal(lump: np.ndarray) -> np.ndarray:
            return np.concatenate([lump, [0.0]]) / 2 + np.concatenate([[0.0], lump]) / 2

        mass = lumps(lambda line: line.length * line.line_mass)
        self.springs = stiffness / lumps(lambda line: line.length)
        self.friction = nodal(lumps(lambda line: line.length * line.friction))
        self.drag = nodal(lumps(lambda line: line.length * line.drag))
        self.off = masses * mass / 6
        self.diagonal = nodal(mass) * (1 - masses / 3)
        self.diagonal[-1] += drum
        self.factor = lapack.dpttrf(self.diagonal, self.off)[:2]
        self.nodes, self.evaluations = len(self.diagonal), 0
        self.rubs = any(line.friction or line.drag for line in lines)

    @property
    def unknowns(self) -> int:
        """Places and speeds."""
        return 2 * self.nodes

    def rates(self, t: float, y: np.ndarray) -> np.ndarray:
        """Places and speeds alternate in y, so that a Jacobian is a narrow band."""
        self.evaluations += 1
        u, v = y[0::2], y[1::2]
        pull = self.springs * (u[1:] - u[:-1])
        net = -self.drag * v - self.friction * np.tanh(v / self.soft) if self.rubs else np.zeros(self.nodes)
        net[:-1] += pull
        net[1:] -= pull
        net[-1] += self.force(t, float(v[-1]))
        found = np.empty_like(y)
        found[0::2] = v
        found[1::2] = net / self.diagonal if self.lumped else lapack.dpttrs(*self.factor, net)[0]
        return found

    def band(self) -> lil_matrix:
        """What the rates of lumped masses depend on."""
        places = 2 * np.arange(self.nodes)
        found = lil_matrix((self.unknowns, self.unknowns))
        found[places, places + 1] = found[places + 1, places] = found[places + 1, places + 1] = 1
        found[places[1:] + 1, places[:-1]] = found[places[:-1] + 1, places[1:]] = 1
        return found

    def run_on(self, method: str, when: np.ndarray, rtol: float) -> Answer:
        """By one of scipy's solvers, from rest; the Jacobian of lumped masses is sparse for Radau and BDF, for LSODA a
        band."""
        options: dict[str, Any] = {}
        if self.lumped:
            if method in ("Radau", "BDF"):
                options = {"jac_sparsity": self.band()}
            elif method == "LSODA":
                options = {"lband": 3, "uband": 1}
        self.evaluations = 0
        span = (0.0, float(when[-1]))
        found = solve_ivp(
            self.rates, span, np.zeros(self.unknowns), method, when, rtol=rtol, atol=1e-2 * rtol, **options
        )  # fmt: skip
        assert found.success, found.message
        evaluations = self.evaluations
        at_drum = [
            self.force(t, y[-1]) - self.drum * self.rates(t, y)[-1] for t, y in zip(when, found.y.T, strict=True)
        ]
        return Answer((np.array(at_drum), self.springs[-1] * (found.y[-2] - found.y[-4])), evaluations)

    def exact_run_on(self, when: np.ndarray) -> np.ndarray:
        """What a constant force causes without friction, exact in time by the modes of the mesh: no solver, however
        tight its tolerance, comes nearer to the belt than this."""
        pulls = np.zeros(self.nodes)
        pulls[:-1] += self.springs
        pulls[1:] += self.springs
        squares, modes = eigh(
            np.diag(pulls) - np.diag(self.springs, 1) - np.diag(self.springs, -1),
            np.diag(self.diagonal) + np.diag(self.off, 1) + np.diag(self.off, -1),
        )
        frequencies = np.sqrt(np.maximum(squares, 0.0))
        frequencies[0] = 0.0  # the whole belt moving
        force = self.force(0.0, 0.0)
        acceleration = np.zeros(len(when))
        for first in range(0, self.nodes, 256):
            part = slice(first, first + 256)
            acceleration += (modes[-1, part] ** 2 * force) @ np.cos(frequencies[part, None] * when)
        return force - self.drum * acceleration
