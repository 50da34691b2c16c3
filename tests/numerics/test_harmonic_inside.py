"""The force where two strands meet, against finite elements harmonic by harmonic, and in time."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import solve
from support import chain_fem

from ptmcalc.numerics.harmonic.inside import joint_forces, joint_response
from ptmcalc.numerics.harmonic.parts import Chain, Damping, Excitation, Line

WORKING, EMPTY = Line(40.0, 200.0, 3e8), Line(44.0, 80.0, 3e8)
DAMPINGS = {
    "kelvin_voigt": Damping("kelvin_voigt", time=2e-3),
    "hysteretic": Damping("hysteretic", share=0.04),
    "zener": Damping("zener", time=0.02, share=0.3),
}
LOSSLESS = Damping("kelvin_voigt")
CHAINS = [
    Chain((WORKING, EMPTY), LOSSLESS),
    Chain((WORKING, EMPTY), LOSSLESS, joint_mass=900.0),
    Chain((WORKING, EMPTY), LOSSLESS, joint_mass=900.0, far_mass=1500.0),
    Chain((WORKING, EMPTY), LOSSLESS, far="on_sprocket", joint_mass=900.0),
    Chain((WORKING, EMPTY), LOSSLESS, far="held", joint_mass=900.0),
]


def modulus(damping: Damping, w: float) -> complex:
    """From the differential equations of spring and damper."""
    if damping.law == "kelvin_voigt":
        return 1 + 1j * w * damping.time
    if damping.law == "hysteretic":
        return complex(1, damping.share)
    return 1 + damping.share / (1 + 1 / (1j * w * damping.time))


def at_joint(chain: Chain, w: float, near: complex, far: complex, pieces: int) -> np.ndarray:
    """Forces of both strands at the joint, all nodes of a mesh solved at one frequency."""
    strands = [chain_fem.Strand(line.length, line.line_mass, line.stiffness) for line in chain.lines]
    single = [chain_fem.matrices(chain_fem.Chain((one,)), pieces, lumped=False) for one in strands]
    k = modulus(chain.damping, w)
    own = [stiff * k - w**2 * mass for mass, stiff in single]
    count = 2 * pieces + 1
    whole = np.zeros((count, count), complex)
    whole[: pieces + 1, : pieces + 1] += own[0]
    whole[pieces:, pieces:] += own[1]
    whole[pieces, pieces] -= w**2 * chain.joint_mass
    moved = np.zeros(count, complex)
    moved[0], moved[-1] = near, far
    loose = [np.eye(1, count, node)[0] for node in range(1, count - 1)]
    masses = [0.0] * len(loose)
    load = np.zeros(count, complex)
    if chain.far == "free":  # the mass moves with the last node less what its own polygon does
        whole[-1, -1] -= w**2 * chain.far_mass
        load[-1] = -(w**2) * chain.far_mass * far
        moved[-1] = 0
        loose.append(np.eye(1, count, count - 1)[0])
        masses.append(0.0)
    if math.isfinite(chain.drive_mass):  # the sprocket stands on it, on both sides where the chain comes back to it
        ends = np.eye(1, count, 0)[0]
        ends[-1] = chain.far == "on_sprocket"
        loose.append(ends)
        masses.append(chain.drive_mass)
    free = np.array(loose)
    balance = free @ whole @ free.T - w**2 * np.diag(masses)
    u = moved + free.T @ solve(balance, free @ (load - whole @ moved))
    return np.array([-(own[0] @ u[: pieces + 1])[-1], (own[1] @ u[pieces:])[0]])


@pytest.mark.parametrize("law", DAMPINGS)
@pytest.mark.parametrize("case", range(len(CHAINS)))
def test_one_harmonic_is_that_of_finite_elements(case: int, law: str) -> None:
    chain = replace(CHAINS[case], damping=DAMPINGS[law])
    moved = chain.far != "free" or chain.far_mass > 0
    for w in (3.0, 35.0, 61.0, 140.0):
        near, far = Excitation(np.array([0.7, 0.0])), Excitation(np.array([0.4, 0.0]), place=0.3)
        u = -0.7 / w**2 + 0j, (-0.4 / w**2 * np.exp(-2j * np.pi * 0.3) if moved else 0j)
        coarse, fine = (at_joint(chain, w, *u, pieces) for pieces in (40, 80))
        expected = np.abs((4 * fine - coarse) / 3)
        found = joint_response(chain, w, near, far if moved else None)
        for one, size in zip(found, expected, strict=True):
            assert float(one.largest[0]) == pytest.approx(size, rel=5e-4)
            assert float(one.smallest[0]) == pytest.approx(-size, rel=5e-4)


@pytest.mark.parametrize("law", DAMPINGS)
@pytest.mark.parametrize("drive", [math.inf, 6e3])
@pytest.mark.parametrize("case", range(len(CHAINS)))
def test_each_harmonic_is_that_of_finite_elements_with_its_phase(case: int, drive: float, law: str) -> None:
    """The run-on and the far end move at unlike places of the pitch, which turns harmonic n by 2 pi n times that."""
    chain = replace(CHAINS[case], damping=DAMPINGS[law], drive_mass=drive)
    moved = chain.far != "free" or chain.far_mass > 0
    own, other, place, speed = (0.7, -0.3, 0.2), (0.4, 0.5, -0.6), 0.3, 21.0
    near, far = Excitation(np.array(own), place=0.1), Excitation(np.array(other), place=place)
    found = joint_forces(chain, np.array([speed]), near, far if moved else None)[:2]
    for n in (1, 2, 3):
        w = n * speed
        u = [-b / w**2 * np.exp(-2j * np.pi * n * at) for b, at in ((own[n - 1], 0.1), (other[n - 1], place))]
        coarse, fine = (at_joint(chain, w, u[0], u[1] if moved else 0j, pieces) for pieces in (40, 80))
        for one, value in zip(found, (4 * fine - coarse) / 3, strict=True):
            assert abs(one[0, n - 1] - value) <= 5e-4 * abs(value)


def test_a_drive_that_gives_way_moves_less() -> None:
    """A drive as heavy as the chain, slowly: the joint pulls what is behind it, with the share of the acceleration that
    is left."""
    chain = Chain((WORKING, EMPTY), Damping("kelvin_voigt", time=1e-4), joint_mass=900.0)
    whole = 200.0 * 40 + 80.0 * 44 + 900.0
    push = Excitation(np.array([1.0, 0.0]))
    working, back = joint_response(replace(chain, drive_mass=whole), 0.01, push)
    assert float(back.largest[0]) == pytest.approx(80.0 * 44 / 2, rel=1e-4)
    assert float(working.largest[0]) == pytest.approx((80.0 * 44 + 900) / 2, rel=1e-4)


@pytest.mark.parametrize("count", [512, 1024])
def test_the_told_error_holds_what_more_harmonics_find(count: int) -> None:
    chain = replace(CHAINS[1], damping=Damping("hysteretic", share=0.02))
    first = math.pi / 2 / (WORKING.transit + EMPTY.transit)
    speeds = first * np.array([0.05, 0.3, 0.9, 1.4])

    def at(n: int) -> Excitation:
        orders = np.arange(1, n + 1)
        return Excitation((-1.0) ** orders * 2 / np.pi / orders / (1 - (8.0 * orders) ** -2))

    finest = joint_response(chain, speeds, at(8192))
    for rough, exact in zip(joint_response(chain, speeds, at(count)), finest, strict=True):
        assert np.all(np.abs(rough.largest - exact.largest) <= rough.error + exact.error)
        assert np.all(np.abs(rough.smallest - exact.smallest) <= rough.error + exact.error)
        assert np.all(np.maximum(exact.largest, -exact.smallest) <= rough.bound)
        assert np.all(rough.error[1:] < 0.02 * exact.largest[1:])


@pytest.mark.parametrize("law", DAMPINGS)
@pytest.mark.parametrize("count", [100, 128, 130])
def test_errors_are_told_as_derived(law: str, count: int) -> None:
    """Behind the last harmonic N the joint's motion is no more than |b_N| N/(n^3 w_1^2), a wave of it no more than z w
    (2/(1 - q))^2 X_1 in force, and with the root of the frequency by which z may grow the sum no more than twice its
    integral. Between samples h apart a sum of sines stays within (h/2)^2/2 of its second derivative."""
    chain = replace(CHAINS[1], damping=DAMPINGS[law])
    orders = np.arange(1, count + 1)
    near, far = Excitation(0.7 * (-1.0) ** orders / orders), Excitation(-0.3 / orders**1.5, place=0.3)
    speeds = np.array([20.0, 55.0])
    for second in (None, far):
        first, back, left = joint_forces(chain, speeds, near, second)
        told = joint_response(chain, speeds, near, second)
        for k, speed in enumerate(speeds.tolist()):
            root = complex(np.sqrt(modulus(chain.damping, speed * count)))
            fades = [
                abs(np.exp(-1j * speed * count * line.length * math.sqrt(line.line_mass / line.stiffness) / root))
                for line in chain.lines
            ]
            stiffest = max(math.sqrt(line.line_mass * line.stiffness) for line in chain.lines)
            wave = stiffest * abs(root) * (2 / (1 - max(fades) ** 2)) ** 2 * fades[0]
            last = abs(near.harmonics[-1]) + (abs(far.harmonics[-1]) if second else 0.0)
            assert left[k] == pytest.approx(2 * wave * last / speed, rel=1e-12)
            samples = max(1024, 2 ** math.ceil(math.log2(8 * count)))
            for forces, one in zip((first, back), told, strict=True):
                curved = sum(abs(forces[k]) * (2 * math.pi * orders) ** 2) * (0.5 / samples) ** 2 / 2
                assert one.error[k] == pytest.approx(left[k] + curved, rel=1e-12)
                assert one.bound[k] == pytest.approx(left[k] + sum(abs(forces[k])), rel=1e-12)


@pytest.mark.parametrize("law", DAMPINGS)
def test_largest_and_smallest_are_those_of_the_sum_over_a_pitch(law: str) -> None:
    """A force that is steep one way and flat the other: its summit is not its trough turned over."""
    chain, near = replace(CHAINS[1], damping=DAMPINGS[law]), Excitation(np.array([0.7, 0.5, -0.3, 0.0]))
    x = np.arange(2048) / 2048
    forces = joint_forces(chain, np.array([21.0]), near)[:2]
    for one, told in zip(forces, joint_response(chain, 21.0, near), strict=True):
        course = sum((one[0, n - 1] * np.exp(2j * np.pi * n * x)).imag for n in range(1, 5))
        assert float(told.largest[0]) == pytest.approx(course.max(), rel=1e-4)
        assert float(told.smallest[0]) == pytest.approx(course.min(), rel=1e-4)
        assert abs(course.max() + course.min()) > 1e-2 * course.max()


def test_a_strand_that_hardly_fades_bounds_nothing() -> None:
    light = replace(CHAINS[1], damping=Damping("hysteretic", share=1e-19))
    assert math.isinf(joint_forces(light, np.array([20.0]), Excitation(np.ones(3)))[2][0])


def test_a_resonance_without_damping_has_no_bound() -> None:
    found = joint_response(CHAINS[0], 30.0, Excitation(np.array([1.0, -0.5])))
    assert np.all(np.isinf([one.error[0] for one in found]))


def test_one_strand_has_no_joint() -> None:
    with pytest.raises(ValueError, match="joint"):
        joint_response(Chain((WORKING,), LOSSLESS), 1.0, Excitation(np.array([1.0])))
