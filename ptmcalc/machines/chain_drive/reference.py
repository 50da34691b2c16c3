"""The second methods for the polygon effect: modes of a finite element mesh, between two engagements or harmonic by
harmonic of the teeth; no plan offers them.

Shared with the solvers: lengths, masses, stiffness and damping of the strands (`model.vibrating`), and what tensions do
to a chain (`strength`). The mesh, the motion of the sprockets, the answers of the modes and their extremes are its own.
"""

import math
from collections.abc import Sequence

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.chain_drive.machine.model import FloatArray, chain_line, ends_at_tail, tail_teeth, vibrating
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Run
from ptmcalc.machines.chain_drive.machine.strength import OF_TENSION, QUIET, Answer, Tail, loads_of_tension
from ptmcalc.machines.chain_drive.polygon.excitation import (
    FAR,
    POLYGON,
    WEAK,
    excites_far,
    far_place,
    mass_of_drive,
    residual,
    undamped,
)
from ptmcalc.machines.chain_drive.polygon.return_strand import return_chain, return_place
from ptmcalc.numerics.harmonic.parts import FREE, KELVIN_VOIGT, ON_SPROCKET, Chain, Line

_PIECES = (30, 60, 120)
"""Elements of a strand in three meshes. A numerical choice: their differences give the error bar. More narrow it; time
grows with the cube."""
_PLACES = 2001
"""Points of a pitch at which the motion is evaluated; a numerical choice. Every second of them gives the error bar of
the rest. More points narrow the bar and take longer."""
_MARGIN = 3.0
"""Safety factor on the differences of meshes, points and harmonics [1]. A numerical choice: at first order the rest is
no larger than the difference. A smaller value weakens the reference; a larger one hides errors of the method it
tests."""
_HARMONICS = 2048
"""Tooth harmonics of the Fourier series; a numerical choice. Half of them give the error bar of the rest. More narrow
the bar; time grows with the number."""
_STILL = Estimate.exact(0.0)


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
    return mass, stiff


def _beyond(chain: Chain, mass: FloatArray, pieces: int) -> FloatArray:
    """What each node weighs beyond the run-on and, of two strands, beyond the end of the first and the beginning of the
    second, shape (places, nodes)."""
    if len(chain.lines) == 1:
        return mass[None, :]
    second = np.where(np.arange(len(mass)) > pieces, mass, 0.0)
    second[pieces] = chain.lines[1].line_mass * chain.lines[1].length / pieces / 2
    first = second.copy()
    first[pieces] += chain.joint_mass
    return np.stack([mass, first, second])


def _tensions(spec: ChainDrive, chain: Chain, pieces: int) -> FloatArray:
    """Dynamic tension over a pitch at the run-on and at both sides of the tail, shape (places, times): every mode of
    the mesh between two engagements in closed form, its free part such that it ends as it began.

    Nodes move relative to what the sprocket forces on the chain. That of the run-on moves where the drive gives way, a
    mass that the polygon does not move; the mode in which nothing is stretched then answers with all of it.
    """
    from scipy.linalg import eigh

    mass, stiff = _matrices(chain, pieces)
    whole, held = mass.copy(), 1
    if math.isfinite(chain.drive_mass):
        whole[0] += chain.drive_mass
        held = 0
    squares, shapes = eigh(stiff[held:, held:], np.diag(whole[held:]))
    share, swinging = shapes.T @ mass[held:], slice(1 - held, None)
    w = np.sqrt(squares[swinging])
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
    q, v = forced(times, 0), forced(times, 1)
    for pole, part in zip(poles, parts, strict=True):
        free = part * np.exp(pole * times[:, None])
        q, v = q + np.real(free), v + np.real(pole * free)
    moved = -(omega**2) * radius * np.sin(omega * times - half)
    answers = np.repeat(-moved[:, None], len(squares), axis=1)
    answers[:, swinging] -= w**2 * q + 2 * zeta * w * v
    beyond = _beyond(chain, mass, pieces)
    return np.asarray(beyond.sum(axis=1)[:, None] * moved + beyond[:, held:] @ shapes @ (share * answers).T)


def _extremes(
    courses: Sequence[FloatArray], coarser: Sequence[FloatArray], largest: bool
) -> tuple[FloatArray, FloatArray]:
    """The extremes of what three meshes found, and what they are good for: by the meshes, and by what else is coarser
    in the last one."""

    def extremes(course: FloatArray) -> FloatArray:
        return np.asarray(course.max(axis=-1) if largest else course.min(axis=-1))

    one, two, three = map(extremes, courses)
    off = np.maximum(np.abs(three - two), np.abs(two - one) / 2)
    return three, _MARGIN * sum((np.abs(three - extremes(course)) for course in coarser), off)


Sides = Sequence[Sequence[Estimate]]
"""Largest, then smallest tensions at the places of a chain."""


def _loads(spec: ChainDrive, scene: Run, sides: Sides, back: Sides | None = None) -> dict[str, Found]:
    """What follows of the extremes at the run-on, the far end, and both sides of a tail where there is one; or of those
    of the return strand by itself, at the tail and at the run-off."""
    most, least = sides
    tail = Tail(most[2], least[2], most[3], least[3]) if len(most) > 2 else QUIET
    off = _STILL, _STILL
    if back is not None:
        tail, off = Tail(_STILL, _STILL, back[0][0], back[1][0]), (back[0][1], back[1][1])
    answer = Answer(most[0], least[0], most[1], least[1], tail, math.inf, None, *off)
    loads = loads_of_tension(spec, chain_line(spec, scene), answer)
    loads["tension_dynamic_polygon"], loads["tension_dynamic_polygon_min"] = most[0], least[0]
    loads["tension_dynamic_polygon_far"] = most[1]
    return {name: Found(one) for name, one in loads.items()}


def run(spec: ChainDrive, scene: Run, carried: frozenset[str], level: int) -> Result:
    """Maximum and minimum dynamic tension of steady running at the entering strand and at the tail, and the loads
    derived from them.

        q_k'' + 2 z_k w_k q_k' + w_k^2 q_k = -e_k a(t),   a = -Omega^2 R sin(Omega t - pi/z) over every pitch
        S = sum_i m_i (a + sum_k phi_ik q_k'')   over all that is beyond

    **Range** strands that end in a constant tension, damped by Kelvin and Voigt, on a sprocket of constant speed or of
    a compliant drive.
    **Error** three times the difference to a mesh with half as many elements, or half of the difference of the two
    coarser meshes: a jump of the acceleration converges with the first order. The sampling error is added.
    **Source** lumped elements; Timoshenko, Vibration Problems in Engineering; N. Yu. Dorokhov, lecture notes,
    Kramatorsk 2007, for the motion of the sprocket.
    """
    chain, share = vibrating(spec, scene, mass_of_drive(spec, carried)), residual(spec)
    courses = [share * _tensions(spec, chain, pieces) for pieces in _PIECES]
    sides = []
    for largest in (True, False):
        known = [
            Estimate.within(*map(float, one))
            for one in zip(*_extremes(courses, [courses[-1][:, ::2]], largest), strict=True)
        ]
        sides.append([known[0], _STILL, *known[1:]])
    return Result(_loads(spec, scene, sides), work=sum(_PIECES))


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
    title="polygon effect, finite-element modes (reference)",
    fidelity=Fidelity.MODAL,
    scenes=frozenset({Run}),
    represents=frozenset({POLYGON, WEAK}),
    gives=OF_TENSION | {"tension_dynamic_polygon", "tension_dynamic_polygon_min", "tension_dynamic_polygon_far"},
    run=run,
    cost=lambda spec, scene, carried, level: 1.0,
    source="finite elements between two engagements; derived in ptmcalc.machines.chain_drive.reference",
    valid=valid,
    always=frozenset({POLYGON}),
)


def _independent(chain: Chain, mass: FloatArray) -> tuple[FloatArray, FloatArray]:
    """What moves by itself, in columns of the nodes that move with it, and its masses: the drive where it gives way,
    with the run-off that is on it, the inner nodes, and a far end that nothing holds."""
    last, columns, masses = len(mass) - 1, [], []
    if math.isfinite(chain.drive_mass):
        drive = np.zeros(len(mass))
        drive[[0, last] if chain.far == ON_SPROCKET else [0]] = 1.0
        columns.append(drive)
        masses.append(chain.drive_mass + mass @ drive)
    for node in range(1, last + (chain.far == FREE)):
        columns.append(np.eye(1, len(mass), node)[0])
        masses.append(mass[node] + (chain.far_mass if node == last else 0.0))
    return np.array(columns).T, np.array(masses)


def _motion(spec: ChainDrive, teeth: int, place: float) -> np.ndarray:
    """Harmonics of the way a sprocket forces on a chain, beside the even one: s = Im(s_n e^(i w_n t)) [m].

    s_n = -b_n/w_n^2 e^(-2 pi i n x),   b_n = (2/T) int a sin(w_n t) dt = 2 Omega^2 V w_n/(w_n^2 - Omega^2)
    """
    w = 2 * math.pi * np.arange(1, _HARMONICS + 1) * spec.speed / spec.chain.pitch
    omega = 2 * math.pi / teeth * spec.speed / spec.chain.pitch
    turns = np.exp(-2j * math.pi * place * np.arange(1, _HARMONICS + 1))
    return np.asarray(-2 * omega**2 * spec.speed / (w * (w**2 - omega**2)) * turns)


def _forces(spec: ChainDrive, chain: Chain, pieces: int, motions: Sequence[np.ndarray]) -> np.ndarray:
    """Harmonics of the dynamic tension at the run-on, the far end, and both sides of a tail, for the motion of the
    run-on alone and that of the far end alone, shape (motions, places, harmonics)."""
    from scipy.linalg import eigh

    mass, stiff = _matrices(chain, pieces)
    columns, masses = _independent(chain, mass)
    squares, shapes = eigh(columns.T @ stiff @ columns, np.diag(masses))
    shapes = columns @ shapes
    w = 2 * math.pi * np.arange(1, _HARMONICS + 1) * spec.speed / spec.chain.pitch
    modulus = chain.damping.modulus(np.asarray(w))
    last = len(mass) - 1
    pulls = [(0, mass[0], stiff[0], 1), (last, mass[last], stiff[last], -1)]
    if len(chain.lines) == 2:
        before, behind = np.zeros((2, len(mass)))
        one, two = (line.stiffness * pieces / line.length for line in chain.lines)
        before[[pieces - 1, pieces]], behind[[pieces, pieces + 1]] = (-one, one), (two, -two)
        halves = [line.line_mass * line.length / pieces / 2 for line in chain.lines]
        pulls += [(pieces, halves[0], before, -1), (pieces, halves[1], behind, 1)]
    found = np.zeros((len(motions), len(pulls), _HARMONICS), complex)
    for k, motion in enumerate(motions):
        node = (0, last)[k]
        held = np.eye(1, len(mass), node)[0]
        push = w[:, None] ** 2 * (mass[node] * shapes[node]) - modulus[:, None] * (stiff[node] @ shapes)
        swung = push * motion[:, None] / (modulus[:, None] * squares - w[:, None] ** 2)
        for place, (at, weight, row, sign) in enumerate(pulls):
            inertia = -(w**2) * weight * (swung @ shapes[at] + motion * held[at])
            found[k, place] = sign * (inertia + modulus * (swung @ (row @ shapes) + motion * (row @ held)))
    return found


def _course(forces: np.ndarray) -> FloatArray:
    """Im sum_n F_n e^(2 pi i n x) over a pitch."""
    looks = 4 * _HARMONICS
    padded = np.zeros((*forces.shape[:-1], looks), complex)
    padded[..., 1 : forces.shape[-1] + 1] = forces
    return np.asarray(np.imag(looks * np.fft.ifft(padded)))


def run_harmonics(spec: ChainDrive, scene: Run, carried: frozenset[str], level: int) -> Result:
    """Maximum and minimum dynamic tension of steady running at both ends and at the tail, and the loads derived from
    them.

        (mu_n K - w_n^2 M) z_n = (w_n^2 M - mu_n K) s_n,   S = m u'' + mu K u at a node,   mu the complex modulus

    A far end with an unknown phase of its link joints is assessed at the worst phase: the extremes of both ends add up.
    The return strand in front of a driven tail is a mesh of its own.

    **Range** linear strands that stay taut, damped by any complex modulus.
    **Error** as that of the mesh between two engagements, and four times the change by half of the harmonics.
    **Source** lumped elements; Timoshenko, Vibration Problems in Engineering; N. Yu. Dorokhov, lecture notes,
    Kramatorsk 2007, for the motion of the sprocket.
    """
    chain = vibrating(spec, scene, mass_of_drive(spec, carried))
    motions = [residual(spec) * _motion(spec, spec.sprocket.teeth, 0.0)]
    place = far_place(spec)
    if FAR in carried and excites_far(spec, chain):
        on_tail = ends_at_tail(spec)
        motions.append((1.0 if on_tail else residual(spec)) * _motion(
            spec, tail_teeth(spec) if on_tail else spec.sprocket.teeth, place or 0.0
        ))  # fmt: skip
    sides = _sides(spec, chain, motions, place)
    return Result(_loads(spec, scene, sides, _of_return(spec, scene, carried)), work=sum(_PIECES))


def _of_return(spec: ChainDrive, scene: Run, carried: frozenset[str]) -> Sides | None:
    """Of the return strand in front of a driven tail, which moves its first end; None without one."""
    chain = return_chain(spec, scene)
    if chain is None:
        return None
    place = return_place(spec)
    motions = [(FAR in carried) * _motion(spec, tail_teeth(spec), 0.0)]
    if excites_far(spec, chain):
        motions.append(residual(spec) * _motion(spec, spec.sprocket.teeth, place or 0.0))
    return _sides(spec, chain, motions, place)


def _sides(spec: ChainDrive, chain: Chain, motions: Sequence[np.ndarray], place: float | None) -> Sides:
    """Extremes of a chain by three meshes and half of the harmonics; the sum of both motions at a known place."""
    forces = [_forces(spec, chain, pieces, motions) for pieces in _PIECES]
    if place is not None:
        forces = [one.sum(axis=0, keepdims=True) for one in forces]
    courses = [_course(one) for one in forces]
    coarser = [courses[-1][..., ::2], _course(forces[-1][..., : _HARMONICS // 2])]
    sides = []
    for largest in (True, False):
        values, bars = (part.sum(axis=0) for part in _extremes(courses, coarser, largest))
        sides.append([Estimate.within(float(value), float(bar)) for value, bar in zip(values, bars, strict=True)])
        if not excites_far(spec, chain):
            sides[-1][1] = _STILL
    return sides


def valid_harmonics(spec: ChainDrive, scene: Run) -> Criterion | None:
    """What the mesh between two engagements cannot do, and damped.

        1 for any other

    **Range** any chain.
    **Error** exact.
    **Source** the file.
    """
    if undamped(spec, scene):
        return Criterion("damping", 1.0, 1.0, "a chain without damping", "the file")
    beyond = valid(spec, scene)
    if beyond is None:
        return Criterion("mesh", 1.0, 1.0, "a chain whose modes are known between two engagements", "the file")
    return None


MESH_HARMONICS: Solver[ChainDrive, Run] = Solver(
    name="mesh_harmonics",
    title="polygon effect, finite elements by harmonics (reference)",
    fidelity=Fidelity.MODAL,
    scenes=frozenset({Run}),
    represents=frozenset({POLYGON, FAR, WEAK}),
    gives=MESH.gives,
    run=run_harmonics,
    cost=lambda spec, scene, carried, level: 0.6,
    source="finite elements under the harmonics of the teeth; derived in ptmcalc.machines.chain_drive.reference",
    valid=valid_harmonics,
    always=frozenset({POLYGON}),
)

REFERENCE_METHODS = (MESH, MESH_HARMONICS)
