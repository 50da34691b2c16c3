"""Finite elements of a chain on a sprocket: the independent reference. Imports nothing from `ptmcalc`.

Node 0 is the run-on, the last one the far end; displacements are positive in the direction of travel. The tension at
the run-on is the force with which the sprocket pulls node 0 ahead, that at the far end is what holds the last one back.
"""

import math
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import product

import numpy as np
from scipy.linalg import eigh


@dataclass(frozen=True)
class Strand:
    """Length, mass per length, stiffness."""

    length: float
    line_mass: float
    stiffness: float


@dataclass(frozen=True)
class Chain:
    """Strands from the run-on on, tail mass between them, mass at a free far end, drive at the rim."""

    strands: tuple[Strand, ...]
    joint_mass: float = 0.0
    far_mass: float = 0.0
    drive_mass: float = math.inf
    far: str = "free"


def matrices(chain: Chain, pieces: int, *, lumped: bool) -> tuple[np.ndarray, np.ndarray]:
    """Mass and stiffness; so many elements per strand."""
    count = pieces * len(chain.strands) + 1
    mass, stiff = np.zeros((count, count)), np.zeros((count, count))
    whole = np.array([[3.0, 0.0], [0.0, 3.0]]) if lumped else np.array([[2.0, 1.0], [1.0, 2.0]])
    for k, strand in enumerate(chain.strands):
        h = strand.length / pieces
        near = np.arange(k * pieces, (k + 1) * pieces)
        for one, other in product((0, 1), (0, 1)):
            stiff[near + one, near + other] += strand.stiffness / h * (1 if one == other else -1)
            mass[near + one, near + other] += strand.line_mass * h / 6 * whole[one, other]
    if len(chain.strands) > 1:
        mass[pieces, pieces] += chain.joint_mass
    mass[-1, -1] += chain.far_mass
    return mass, stiff


def _forces(chain: Chain, pieces: int, modulus: complex, w: float, near: complex, far: complex) -> np.ndarray:
    """Complex tensions at both ends under harmonic displacements of them, the drive giving way; a free far end moves
    against its mass."""
    mass, stiff = matrices(replace(chain, far_mass=0.0), pieces, lumped=False)
    dynamic = stiff * modulus - w**2 * mass
    count = len(mass)
    moved = np.zeros(count, complex)
    moved[0], moved[-1] = near, far
    # columns: what may move, the drive last
    inner = slice(1, count if chain.far == "free" else count - 1)
    ends = [0, -1] if chain.far == "on_sprocket" else [0]

    def gathered(rows: np.ndarray) -> np.ndarray:
        return np.concatenate([rows[inner], rows[ends].sum(axis=0, keepdims=True)])

    whole = gathered(gathered(dynamic).T).T
    whole[-1, -1] -= w**2 * chain.drive_mass if math.isfinite(chain.drive_mass) else 0.0
    if chain.far == "free":
        whole[-2, -2] -= w**2 * chain.far_mass
    kept = slice(None) if math.isfinite(chain.drive_mass) else slice(None, -1)
    found = np.zeros(len(whole), complex)
    found[kept] = np.linalg.solve(whole[kept, kept], -gathered(dynamic @ moved)[kept])
    u = moved.copy()
    u[inner] += found[:-1]
    u[ends] += found[-1]
    force = dynamic @ u
    return np.array([force[0], -force[-1]])


def forces(chain: Chain, modulus: complex, w: float, near: complex, far: complex = 0.0, pieces: int = 30) -> np.ndarray:
    """The same from two meshes, with the error of second order taken out."""
    coarse, fine = (_forces(chain, n, modulus, w, near, far) for n in (pieces, 2 * pieces))
    return np.asarray((4 * fine - coarse) / 3)


@dataclass(frozen=True)
class Sprocket:
    """Pitch, teeth and mean speed of the chain."""

    pitch: float
    teeth: int
    speed: float

    @property
    def period(self) -> float:
        return self.pitch / self.speed

    @property
    def angular(self) -> float:
        return 2 * math.pi * self.speed / (self.teeth * self.pitch)

    def acceleration(self, time: np.ndarray) -> np.ndarray:
        """Of the chain, from an engagement on."""
        radius = self.pitch / (2 * math.sin(math.pi / self.teeth))
        return -(self.angular**2) * radius * np.sin(self.angular * (time % self.period) - math.pi / self.teeth)


@lru_cache(maxsize=4)
def modes(chain: Chain, pieces: int) -> tuple[np.ndarray, np.ndarray, float]:
    """Frequencies, effective masses of the modes of a chain held at the run-on, and the mass of its node."""
    mass, stiff = matrices(chain, pieces, lumped=True)
    squares, shapes = eigh(stiff[1:, 1:], mass[1:, 1:])
    share = shapes.T @ np.diag(mass)[1:]
    return np.sqrt(squares), share**2, float(mass[0, 0])


def periodic_force(chain: Chain, sprocket: Sprocket, retardation: float, places: np.ndarray, pieces: int) -> np.ndarray:
    """Tension at the run-on in the periodic regime, at fractions of a pitch after an engagement: every mode of the
    mesh between two engagements in closed form, its free part such that it ends as it began."""
    w, effective, node = modes(chain, pieces)
    zeta = retardation * w / 2
    root = w * np.sqrt((zeta - 1).astype(complex)) * np.sqrt(zeta + 1)
    poles = np.stack([-(w**2) / (zeta * w + root), -(zeta * w + root)])  # no difference of large numbers
    omega, half, period = sprocket.angular, math.pi / sprocket.teeth, sprocket.period
    radius = sprocket.pitch / (2 * math.sin(half))
    gain = omega**2 * radius / (w**2 - omega**2 + 2j * zeta * w * omega)  # q'' + ... = -a

    def forced(time: np.ndarray, derivative: int) -> np.ndarray:
        turn = np.exp(1j * (omega * time[:, None] - half)) * (1j * omega) ** derivative
        return np.imag(gain * turn)

    ends = np.array([0.0, period])
    jump = np.stack([np.diff(forced(ends, d), axis=0)[0] for d in (0, 1)])  # forced part gained over the pass
    lost = -np.expm1(poles * period)
    # c1 lost1 + c2 lost2 = jump of q, poles times it = jump of q'
    rhs = np.stack([jump[0], jump[1]]).astype(complex)
    det = poles[1] - poles[0]
    c1 = (rhs[0] * poles[1] - rhs[1]) / det / lost[0]
    c2 = (rhs[1] - rhs[0] * poles[0]) / det / lost[1]
    times = places * period
    decay = np.exp(poles[:, None, :] * times[:, None])
    q = forced(times, 0) + np.real(c1 * decay[0] + c2 * decay[1])
    v = forced(times, 1) + np.real(c1 * poles[0] * decay[0] + c2 * poles[1] * decay[1])
    share = np.sqrt(effective)
    pull = (w**2 * q + 2 * zeta * w * v) @ (share * share)
    return np.asarray(node * sprocket.acceleration(times * (1 - 1e-15)) - pull)
