"""Scales against a model and its prototype, both computed from their own dimensions."""

import math
import re
from collections.abc import Callable

import numpy as np
import pytest

from ptmcalc.laws import similarity
from ptmcalc.laws.similarity import BALLAST, FULL, GEOMETRIC

G = 9.81
CASES = [
    (FULL, 0.1, 0.1, 1.0, 1.0), (FULL, 0.2, 0.3, 0.5, 3.0), (FULL, 0.05, 1.0, 1.0, 20.0),
    (GEOMETRIC, 0.1, 1.0, 1.0, 1.0), (GEOMETRIC, 0.25, 0.015, 0.15, 1.0),
    (BALLAST, 0.1, 1.0, 1.0, 1.0), (BALLAST, 0.25, 0.5, 0.15, 2.0),
]  # fmt: skip


class Girder:
    """A simply supported girder with a lumped mass at midspan: what it does, from its own dimensions."""

    def __init__(
        self, span: float = 20.0, modulus: float = 2.1e11, density: float = 7850.0, gravity: float = G,
        force: float = 5e4, added: float = 8000.0,
    ) -> None:  # fmt: skip
        self.span, self.modulus, self.gravity, self.force = span, modulus, gravity, force
        self.depth, width = span / 20, span / 50
        self.section = self.depth * width
        self.second_moment = self.section * self.depth**2 / 12
        self.own = density * self.section * span
        self.mass = 17 / 35 * self.own + added
        self.stiffness = 48 * modulus * self.second_moment / span**3
        self.frequency = math.sqrt(self.stiffness / self.mass)
        self.moment = force * span / 4
        self.stress = self.moment * self.depth / 2 / self.second_moment
        self.deflection = force / self.stiffness
        self.own_stress = density * self.section * gravity * span**2 / 8 * self.depth / 2 / self.second_moment


def model_of(law: str, length: float, modulus: float, density: float, gravity: float) -> tuple[Girder, Girder]:
    """Prototype, and a model built by the rule of the law: copy everything, ballast to the mass that gravity asks."""
    prototype = Girder()
    force = 5e4 * modulus * length**2
    copy = Girder(20 * length, 2.1e11 * modulus, 7850 * density, G * gravity, force, 8000 * density * length**3)
    if law != BALLAST:
        return prototype, copy
    needed = prototype.mass * modulus * length**2 / gravity
    return prototype, Girder(
        20 * length, 2.1e11 * modulus, 7850 * density, G * gravity, force,
        8000 * density * length**3 + needed - copy.mass,
    )  # fmt: skip


@pytest.mark.parametrize("case", CASES, ids=str)
class TestScalesOfAGirder:
    def test_statics_and_frequency(self, case: tuple[str, float, float, float, float]) -> None:
        prototype, model = model_of(*case)
        of = similarity.scales(*case)
        for name, value in {
            "displacement": "deflection", "force": "force", "stress": "stress", "mass": "mass",
            "stiffness": "stiffness", "frequency": "frequency", "moment": "moment",
        }.items():  # fmt: skip
            ratio = getattr(model, value) / getattr(prototype, value)
            assert getattr(of, name) == pytest.approx(ratio, rel=1e-12), name

    def test_motion(self, case: tuple[str, float, float, float, float]) -> None:
        """A swing of the same strain: amplitudes, speeds and accelerations of both girders."""
        prototype, model = model_of(*case)
        of = similarity.scales(*case)
        swings = [(girder.deflection, girder.frequency) for girder in (prototype, model)]
        ratios = [math.prod((swings[1][0] / swings[0][0], (swings[1][1] / swings[0][1]) ** k)) for k in (1, 2)]
        assert of.velocity == pytest.approx(ratios[0], rel=1e-12)
        assert of.acceleration == pytest.approx(ratios[1], rel=1e-12)
        assert of.time == pytest.approx(swings[0][1] / swings[1][1], rel=1e-12)
        assert of.damping == pytest.approx(of.force / of.velocity, rel=1e-12)
        assert of.inertia == pytest.approx(of.moment * of.time**2, rel=1e-12)  # M = J times 1/s^2
        assert of.torsion == pytest.approx(of.moment, rel=1e-12)  # angles keep their size

    def test_gravity_is_wrong_by_what_is_said(self, case: tuple[str, float, float, float, float]) -> None:
        prototype, model = model_of(*case)
        of = similarity.scales(*case)
        own = model.own_stress / prototype.own_stress / of.stress  # of the structure's own weight
        froude = of.velocity**2 / (case[4] * of.length)
        said = similarity.distortions(*case)
        numbers = [float(x) for line in said for x in re.findall(r"(?<![\w^])\d[\d.e+-]*", line)]
        if case[0] == FULL:
            assert own == pytest.approx(1, rel=1e-12)
            assert froude == pytest.approx(1, rel=1e-12)
            assert len(said) == 3
        elif case[0] == GEOMETRIC:
            sway = case[1] ** 0.5 / case[4] ** 0.5 / of.time
            assert numbers[0] == pytest.approx(own, rel=1e-3)
            assert numbers[1:3] == pytest.approx([froude, sway], rel=1e-3)
            assert froude == pytest.approx(1 / own, rel=1e-12)
        else:
            assert froude == pytest.approx(1, rel=1e-12)
            assert numbers[0] == pytest.approx(1 - own, rel=1e-3)  # the rest of the weight is ballast
            bare = math.sqrt(case[2] / case[3]) / case[1]  # frequency of a member by its own mass
            assert numbers[1] == pytest.approx(bare / of.frequency, rel=1e-3)

    def test_damping_and_motor_slope_are_said(self, case: tuple[str, float, float, float, float]) -> None:
        of = similarity.scales(*case)
        said = " ".join(similarity.distortions(*case))
        assert f"{of.damping:.4g}" in said
        assert f"{of.force / of.velocity:.4g}" in said


@pytest.mark.parametrize(("weight", "lines"), [(1.0, 0), (1 + 1e-12, 0), (1 + 1e-7, 3), (2.0, 3), (0.5, 3)])
def test_own_weight_is_told_where_it_is_wrong(weight: float, lines: int) -> None:
    """A geometric model, tenfold gravity in a centrifuge makes up for its size: it bears its weight as it should."""
    said = [line for line in similarity.distortions(GEOMETRIC, 0.1, gravity=10 * weight) if "what they should" in line]
    assert len(said) == (2 if lines else 0)


def test_the_same_material_is_the_default() -> None:
    assert similarity.scales(GEOMETRIC, 0.1) == similarity.scales(GEOMETRIC, 0.1, 1.0, 1.0, 1.0)
    assert similarity.distortions(BALLAST, 0.1) == similarity.distortions(BALLAST, 0.1, 1.0, 1.0, 1.0)


def test_a_refusal_of_full_similarity_names_the_density_that_would_do() -> None:
    with pytest.raises(ValueError, match="10, not 1"):
        similarity.scales(FULL, 0.1)
    assert similarity.scales(FULL, 0.1, 1.0, 10.0).frequency == pytest.approx(math.sqrt(10), rel=1e-12)


class TestSections:
    @pytest.mark.parametrize("seed", range(5))
    def test_of_beams_and_bars_with_sections_of_their_own(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        length, modulus, area, second, section, force, mass = map(float, 10 ** rng.uniform(-1, 1, 7))

        def deflection(L: float, E: float, inertia: float, F: float) -> float:
            return F * L**3 / (3 * E * inertia)  # cantilever

        def ratio(law: Callable[..., float], *values: tuple[float, float]) -> float:
            return law(*(a * b for a, b in values)) / law(*(a for a, _ in values))

        of = similarity.section_scales(length, modulus, area, second, section, force, mass)
        beam = (5.0, length), (2e11, modulus), (4e-6, second), (700.0, force)
        assert of.displacement == pytest.approx(ratio(deflection, *beam), rel=1e-12)
        assert of.bending_stress == pytest.approx(
            ratio(lambda F, L, W: F * L / W, (700.0, force), (5.0, length), (1e-5, section)), rel=1e-12
        )
        assert of.axial_stress == pytest.approx(ratio(lambda F, A: F / A, (700.0, force), (1e-3, area)), rel=1e-12)
        bar = (700.0, force), (5.0, length), (2e11, modulus), (1e-3, area)
        assert of.axial_displacement == pytest.approx(ratio(lambda F, L, E, A: F * L / (E * A), *bar), rel=1e-12)
        assert of.stiffness == pytest.approx(of_force := force / of.displacement, rel=1e-12)
        assert of.frequency == pytest.approx(math.sqrt(of_force / mass), rel=1e-12)

    def test_a_geometric_copy_is_the_special_case(self) -> None:
        c = 0.2
        copy, own = similarity.scales(GEOMETRIC, c), similarity.section_scales(c, 1.0, c**2, c**4, c**3, c**2, c**3)
        assert own.displacement == pytest.approx(copy.displacement, rel=1e-12)
        assert own.axial_displacement == pytest.approx(copy.displacement, rel=1e-12)
        assert (own.bending_stress, own.axial_stress) == pytest.approx((copy.stress, copy.stress), rel=1e-12)
        assert (own.stiffness, own.frequency) == pytest.approx((copy.stiffness, copy.frequency), rel=1e-12)


def test_self_weight_strain_of_a_full_rectangle() -> None:
    girder = Girder()
    strain = girder.own_stress / girder.modulus
    estimate = similarity.self_weight_strain(7850.0, G, girder.span, girder.modulus, girder.depth)
    assert strain / estimate == pytest.approx(0.75, rel=1e-12)
