"""The second method for the polygon effect: modes of a finite element mesh between two engagements; no plan offers it.

Shared with the solvers: lengths, masses, stiffness and damping of the strands (`model.vibrating`). The mesh, the motion
of the sprocket, the closed form between two engagements and its extremes are its own.
"""

import math
from collections.abc import Sequence

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.chain_drive.excitation import POLYGON, excites_far, residual, undamped
from ptmcalc.machines.chain_drive.model import FloatArray, vibrating
from ptmcalc.machines.chain_drive.spec import ChainDrive, Run
from ptmcalc.numerics.harmonic.parts import FREE, KELVIN_VOIGT, Chain, Line

_PIECES = (30, 60, 120)
"""Elements of a strand in the three meshes."""
_PLACES = 2001
_MARGIN = 3.0


def _matrices(chain: Chain, pieces: int) -> tuple[FloatArray, FloatArray]:
    """Lumped mass and stiffness of a mesh, node 0 at the run-on; so many elements per strand."""
    count = pieces * len(chain.lines) + 1
    mass, stiff = np.zeros(count), np.zeros((count, count))
    lines: Sequence[Line] = chain.lines
    for k, line in enumerate(lines):
        near = np.arange(k * pieces, (k + 1) * pieces)
        h = line.length / pieces
        for one in (0, 1):
            mass[near + one] += line.line_mass * h / 2
            for other in (0, 1):
                stiff[near + one, near + other] += line.stiffness / h * (1 if one == other else -1)
    if len(lines) > 1:
        mass[pieces] += chain.joint_mass
    mass[-1] += chain.far_mass
    return mass, stiff


def _tension(spec: ChainDrive, chain: Chain, pieces: int) -> FloatArray:
    """Dynamic tension at the run-on over a pitch: every mode of the mesh between two engagements in closed form, its
    free part such that it ends as it began."""
    from scipy.linalg import eigh

    mass, stiff = _matrices(chain, pieces)
    squares, shapes = eigh(stiff[1:, 1:], np.diag(mass[1:]))
    w, share = np.sqrt(squares), shapes.T @ mass[1:]
    half = math.pi / spec.sprocket.teeth
    radius = spec.chain.pitch / (2 * math.sin(half))
    period, omega = spec.chain.pitch / spec.speed, 2 * half * spec.speed / spec.chain.pitch
    zeta = chain.damping.time * w / 2
    root = w * np.sqrt((zeta - 1).astype(complex)) * np.sqrt(zeta + 1)
    poles = np.stack([-(w**2) / (zeta * w + root), -(zeta * w + root)])  # no difference of large numbers
    gain = omega**2 * radius / (w**2 - omega**2 + 2j * zeta * w * omega)  # q'' + ... = -a

    def forced(time: FloatArray, derivative: int) -> FloatArray:
        turn = np.exp(1j * (omega * time[:, None] - half)) * (1j * omega) ** derivative
        return np.asarray(np.imag(gain * turn))

    ends = np.array([0.0, period])
    jump = [np.diff(forced(ends, derivative), axis=0)[0] for derivative in (0, 1)]
    lost, apart = -np.expm1(poles * period), poles[1] - poles[0]
    parts = (jump[0] * poles[1] - jump[1]) / apart / lost[0], (jump[1] - jump[0] * poles[0]) / apart / lost[1]
    times = np.linspace(0.0, period, _PLACES)
    pull = np.zeros(len(times))
    q, v = forced(times, 0), forced(times, 1)
    for pole, part in zip(poles, parts, strict=True):
        free = part * np.exp(pole * times[:, None])
        q, v = q + np.real(free), v + np.real(pole * free)
    pull = (w**2 * q + 2 * zeta * w * v) @ share**2
    acceleration = -(omega**2) * radius * np.sin(omega * times - half)
    return np.asarray(mass[0] * acceleration - pull)


def run(spec: ChainDrive, scene: Run, carried: frozenset[str], level: int) -> Result:
    """Largest and smallest dynamic tension at the run-on of steady running.

        q_k'' + 2 z_k w_k q_k' + w_k^2 q_k = -e_k a(t),   a = -Omega^2 R sin(Omega t - pi/z) over every pitch

    **Range** strands that end in a constant tension, damped by Kelvin and Voigt, on a sprocket of even speed.
    **Error** three times what a mesh differs by from one with half as many elements, or half of what that differs by
    from the one before: a jump of the acceleration is of the first order in a mesh.
    **Source** lumped elements; Timoshenko, Vibration Problems in Engineering; N. Yu. Dorokhov, lecture notes,
    Kramatorsk 2007, for the motion of the sprocket.
    """
    chain, share = vibrating(spec, scene), residual(spec)
    courses = [share * _tension(spec, chain, pieces) for pieces in _PIECES]
    loads = {}
    for name, extreme in (("tension_dynamic_polygon", np.max), ("tension_dynamic_polygon_min", np.min)):
        one, two, three = (float(extreme(course)) for course in courses)
        bar = _MARGIN * max(abs(three - two), abs(two - one) / 2)
        loads[name] = Found(Estimate.within(three, bar))
    return Result(loads, work=sum(_PIECES))


def valid(spec: ChainDrive, scene: Run) -> Criterion | None:
    """A chain whose far end hangs on a constant tension, damped by Kelvin and Voigt.

        1 for any other

    **Range** any chain.
    **Error** exact.
    **Source** the file.
    """
    chain = vibrating(spec, scene)
    if chain.far != FREE or excites_far(spec, chain):
        return Criterion("far end", 1.0, 1.0, "a far end that is held or moved", "the file")
    if chain.damping.law != KELVIN_VOIGT or undamped(spec, scene):
        return Criterion("damping", 1.0, 1.0, "a damping that is not Kelvin and Voigt's", "the file")
    return None


MESH: Solver[ChainDrive, Run] = Solver(
    name="mesh",
    title="polygon effect by the modes of finite elements",
    fidelity=Fidelity.MODAL,
    scenes=frozenset({Run}),
    represents=frozenset({POLYGON}),
    gives=frozenset({"tension_dynamic_polygon", "tension_dynamic_polygon_min"}),
    run=run,
    cost=lambda spec, scene, carried, level: 1.0,
    source="finite elements between two engagements; derived in ptmcalc.machines.chain_drive.witness",
    valid=valid,
    always=frozenset({POLYGON}),
)

WITNESSES = (MESH,)
