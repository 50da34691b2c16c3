"""Start of a chain: balances, sums over modes against finite elements, the bound of tooth passes against DOP853."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import eigh, expm
from support import chain_fem

from ptmcalc.laws import belt_modes, chain_resonance, chain_start, loop_bounds
from ptmcalc.laws.loop_bounds import CARRY, RETURN, LoopMasses

LOOP = LoopMasses(3e3, 9e3, 400.0, 5e3, 2e-7, 1e-7, fixed_length=False, imposed_speed=True)


class TestRigidAcceleration:
    @pytest.mark.parametrize("resistance", [-3e4, -1.2e4, -9e3, 0.0, 4e3, 2e4])
    @pytest.mark.parametrize("torque", [0.0, 30.0, 160.0])
    def test_balances_motor_and_sprocket(self, resistance: float, torque: float) -> None:
        """Torque left by the rotor, through the gear, is what chain and resistance take."""
        inertia, ratio, eta, radius, mass = 0.35, 40.0, 0.9, 0.325, 18e3
        a, losses = chain_start.rigid_acceleration(torque, inertia, ratio, eta, radius, mass, resistance)
        through = torque - inertia * a * ratio / radius
        assert mass * a + resistance == pytest.approx(losses * through * ratio / radius, rel=1e-12, abs=1e-9)
        assert losses == (eta if through >= 0 else 1 / eta)

    def test_of_the_worked_case(self) -> None:
        """CH-01: resistance reduced to the motor through the efficiency."""
        resistance = 90.0 * 40.0 * 0.9 / 0.325
        a, losses = chain_start.rigid_acceleration(160.0, 0.35, 40.0, 0.9, 0.325, 42e3, resistance)
        assert losses == 0.9
        assert a == pytest.approx(0.165781, rel=1e-5)
        assert a / 0.325 * 40.0 == pytest.approx(20.4038, rel=1e-5)


def test_what_is_left_of_a_series_is_reached_by_cosines_at_their_lowest() -> None:
    """sum S_k (1 - cos) over the modes left out, every cosine at -1."""
    parts = np.array([3.0, 2.0, 1.0, 0.5, 0.25])
    most = float(np.sum(parts[2:] * (1 - math.cos(math.pi))))
    assert chain_start.start_series_tail(parts[:2], float(parts.sum())) == pytest.approx(most, rel=1e-14)
    assert chain_start.start_series_tail(-parts[:2], -float(parts.sum())) == pytest.approx(most, rel=1e-14)


def elements(loop: LoopMasses, pieces: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Mass and stiffness of the whole chain from the run-on on; rows are the tensions of its elements."""
    strands = (
        chain_fem.Strand(1.0, loop.carry_mass, 1 / loop.carry_compliance),
        chain_fem.Strand(1.0, loop.return_mass, 1 / loop.return_compliance),
    )
    mass, stiff = chain_fem.matrices(chain_fem.Chain(strands, loop.tail_mass), pieces, lumped=True)
    count = len(mass)
    tensions = np.zeros((count - 1, count))
    for k in range(count - 1):
        tensions[k, [k, k + 1]] = stiff[k, k + 1] * np.array([-1, 1])
    mass[0, 0] += loop.drive_mass
    if loop.fixed_length:
        join = np.eye(count, count - 1)
        join[-1, 0] = 1.0
        mass, stiff, tensions = join.T @ mass @ join, join.T @ stiff @ join, tensions @ join
    return mass, stiff, tensions


def by_elements(loop: LoopMasses, pieces: int, modes: int) -> np.ndarray:
    """Parts of the tension of every element with which modes follow an acceleration, shape (modes, elements)."""
    mass, stiff, tensions = elements(loop, pieces)
    if loop.imposed_speed:
        squares, shapes = eigh(stiff[1:, 1:], mass[1:, 1:], subset_by_index=[0, modes - 1])
        share = shapes.T @ mass[1:, 1:].sum(axis=1)
        return -share[:, None] * (tensions[:, 1:] @ shapes).T / squares[:, None]
    squares, shapes = eigh(stiff, mass, subset_by_index=[1, modes])
    return loop.total_mass * shapes[0][:, None] * (tensions @ shapes).T / squares[:, None]


class TestModalTensions:
    @pytest.mark.parametrize("fixed", [False, True])
    @pytest.mark.parametrize("imposed", [False, True])
    def test_are_those_of_finite_elements(self, fixed: bool, imposed: bool) -> None:
        loop = replace(LOOP, fixed_length=fixed, imposed_speed=imposed)
        pieces, modes = 200, 5
        w = belt_modes.natural_frequencies(loop, 0.0, modes)
        found = by_elements(loop, pieces, modes)
        middles = (np.arange(pieces) + 0.5) / pieces
        for strand, columns in ((CARRY, found[:, :pieces]), (RETURN, found[:, pieces:])):
            expected = chain_resonance.modal_tensions(loop, w, strand, 1 - middles)
            size = np.abs(expected).max(axis=1)
            assert np.all(np.abs(columns - expected).max(axis=1) <= 2e-3 * size)

    @pytest.mark.parametrize("fixed", [False, True])
    @pytest.mark.parametrize("imposed", [False, True])
    def test_sum_up_to_the_quasi_static_tension_within_the_rest(self, fixed: bool, imposed: bool) -> None:
        loop = replace(LOOP, fixed_length=fixed, imposed_speed=imposed)
        x = np.array([0.0, 0.2, 0.7, 1.0])
        for count in (1, 4, 60):
            w = belt_modes.natural_frequencies(loop, 0.0, count)
            for strand in (RETURN, CARRY):
                whole = loop_bounds.quasi_static(loop, strand, x)
                left = whole - chain_resonance.modal_tensions(loop, w, strand, x).sum(axis=0)
                rest = chain_resonance.modal_rest(loop, w, strand, x)
                assert np.all(np.abs(left) <= rest * (1 + 1e-6) + 1e-4 * loop.belt_mass)

    def test_the_rest_bounds_every_mode_behind(self) -> None:
        for fixed in (False, True):
            for imposed in (False, True):
                loop = replace(LOOP, fixed_length=fixed, imposed_speed=imposed)
                w = belt_modes.natural_frequencies(loop, 0.0, 400)
                x = np.array([0.0, 0.5, 1.0])
                for strand in (RETURN, CARRY):
                    behind = np.abs(chain_resonance.modal_tensions(loop, w, strand, x)[3:]).sum(axis=0)
                    rest = chain_resonance.modal_rest(loop, w[:3], strand, x)
                    assert np.all(behind <= rest + 1e-4 * loop.belt_mass)
                    assert np.all(behind >= 0.4 * rest - 1e-3 * loop.belt_mass)

    @pytest.mark.parametrize("fixed", [False, True])
    @pytest.mark.parametrize("imposed", [False, True])
    def test_are_made_of_the_shapes(self, fixed: bool, imposed: bool) -> None:
        loop = replace(LOOP, fixed_length=fixed, imposed_speed=imposed)
        w = belt_modes.natural_frequencies(loop, 0.0, 7)
        x = np.array([0.0, 0.4, 1.0])
        on = chain_resonance.modal_shapes(loop, w, CARRY, np.ones(1))
        off = chain_resonance.modal_shapes(loop, w, RETURN, np.zeros(1))
        share = 1.0 if imposed else loop.total_mass / loop.drive_mass
        for strand in (RETURN, CARRY):
            found = chain_resonance.modal_shapes(loop, w, strand, x) * (on - off) * share / loop.belt_mass
            expected = chain_resonance.modal_tensions(loop, w, strand, x)
            assert found == pytest.approx(expected, rel=1e-6, abs=1e-6 * loop.belt_mass)

    def test_at_the_ends_they_are_those_already_known(self) -> None:
        loop = replace(LOOP, fixed_length=True)
        w = belt_modes.natural_frequencies(loop, 0.0, 6)
        on, off = chain_resonance.modal_masses(loop, w)
        assert chain_resonance.modal_tensions(loop, w, CARRY, np.ones(1))[:, 0] == pytest.approx(on, rel=1e-9)
        assert chain_resonance.modal_tensions(loop, w, RETURN, np.zeros(1))[:, 0] == pytest.approx(off, rel=1e-9)


class TestPassingBound:
    @staticmethod
    def peak(w: float, zeta: float, top: float, passes: int, pitch: float, teeth: int) -> float:
        """Largest |x| while a sprocket comes up to speed evenly, the mean acceleration left out: by DOP853."""
        half = math.pi / teeth
        radius = pitch / 2 / math.sin(half)
        e = top**2 / (2 * passes * 2 * half)
        state, begun, worst = np.zeros(2), 0.0, 0.0
        for k in range(passes):
            ends = math.sqrt(2 * (k + 1) * 2 * half / e)
            speed = e * begun

            def base(t: float, speed: float = speed) -> float:
                phi = speed * t + e * t * t / 2 - half
                return radius * (e * (math.cos(phi) - math.sin(half) / half) - (speed + e * t) ** 2 * math.sin(phi))

            run = solve_ivp(
                lambda t, y, base=base: [y[1], -base(t) - 2 * zeta * w * y[1] - w * w * y[0]],
                (0, ends - begun), state, "DOP853", rtol=1e-8, atol=1e-12, max_step=0.4 / w,
            )  # fmt: skip
            worst = max(worst, float(np.abs(w * w * run.y[0] + 2 * zeta * w * run.y[1]).max()))
            state, begun = run.y[:, -1], ends
        return worst

    @pytest.mark.parametrize("seed", range(16))
    def test_holds_run_ups(self, seed: int) -> None:
        """Below, through and far above a resonance."""
        rng = np.random.default_rng(seed)
        teeth, zeta = int(rng.integers(5, 20)), float(10 ** rng.uniform(-2, 0.3))
        ratio = float(rng.uniform(0.3, 2.5) if seed < 10 else rng.uniform(4, 15))
        passes, w = int(rng.integers(3, 60)), 30.0
        top = ratio * w / teeth
        e = top**2 / (2 * passes * 2 * math.pi / teeth)
        found = self.peak(w, zeta, top, passes, 0.2, teeth)
        arguments = np.array([w]), np.array([zeta]), top, e, 0.2, teeth
        bound = chain_start.passing_bound(*arguments, passes)[0]
        assert found <= bound
        assert bound <= chain_start.passing_bound(*arguments, math.inf)[0]

    def test_a_third_of_it_does_not_hold_them(self) -> None:
        top, e = 0.5 * 30.0 / 16, (0.5 * 30.0 / 16) ** 2 / (2 * 300 * 2 * math.pi / 16)
        bound = chain_start.passing_bound(np.array([30.0]), np.array([0.0108]), top, e, 0.2, 16, 300)[0]
        assert self.peak(30.0, 0.0108, top, 300, 0.2, 16) > bound / 3

    @pytest.mark.parametrize("zeta", [0.02, 0.5, 3.0])
    @pytest.mark.parametrize("teeth", [6, 17, 5000])
    @pytest.mark.parametrize("w", [1e-4, 0.3])
    def test_a_slow_mode_is_moved_by_what_a_tooth_moves(self, w: float, teeth: int, zeta: float) -> None:
        """A single engagement and a mode so slow that the ways count: w^2 (1 + 2 zeta) E(0) (8 u + dv/w), with the
        largest way u and the jump of the speed dv read off a polygon that rolls, and E(0) = |(-1, 2 zeta)|."""
        speed, pitch = 2.0, 0.2
        half = math.pi / teeth
        radius = pitch / 2 / math.sin(half)
        phi = half * np.linspace(-1.0, 1.0, 20_001)
        chord = (phi + half) / (2 * half) * pitch
        u = np.abs(radius * (np.sin(phi) + math.sin(half)) - chord).max()
        jump = speed * (radius - radius * math.cos(half))  # cos(phi) turns from falling to rising at a tooth
        bound = chain_start.passing_bound(np.array([w]), np.array([zeta]), speed, 0.0, pitch, teeth, 1)[0]
        assert bound == pytest.approx(w * w * (1 + 2 * zeta) * math.hypot(1, 2 * zeta) * (8 * u + jump / w), rel=1e-5)

    @pytest.mark.parametrize("passes", [1, 2, 9, 65, 66, 300, math.inf])
    @pytest.mark.parametrize(
        ("w", "zeta"), [(40.0, z) for z in (0.01, 0.3, 1.0, 1.9, 2.1, 9.0)] + [(4000.0, 1e-4), (4000.0, 1.9)]
    )
    def test_a_fast_mode_by_what_is_left_of_every_jump(self, w: float, zeta: float, passes: float) -> None:
        """Jumps in a mode far above the teeth, faded by a matrix exponential of (d, d'/w): the first 64 one by one,
        behind them as often as they come what the last left, or every 64 by the norm of the map over their time."""
        speed, e, pitch, teeth = 1.5, 0.3, 0.2, 7
        h = math.pi / teeth
        radius = pitch / 2 / math.sin(h)
        a = radius * (speed**2 * math.sin(h) + e * (1 - math.cos(h)))
        v = radius * (2 * speed**3 * (2 - math.cos(h)) + 6 * e * speed * (2 * math.sin(h) + h))
        count = int(min(passes - 1, 64))
        fade = expm(2 * h / speed * w * np.array([[0.0, 1.0], [-1.0, -2 * zeta]]))
        states = [np.array([-1.0, 2 * zeta])]
        for _ in range(count):
            states.append(fade @ states[-1])
        left = [float(np.linalg.norm(state)) for state in states[1:]]
        total = sum(left)
        if passes > 65:
            map_of_all = float(np.linalg.norm(np.linalg.matrix_power(fade, 64), 2))
            total += min((passes - 65) * left[-1] if left[-1] else 0.0, total * map_of_all / (1 - map_of_all))
        expected = 7 * a + (2 * a + min(2 * a, v / w)) * total
        bound = chain_start.passing_bound(np.array([w]), np.array([zeta]), speed, e, pitch, teeth, passes)[0]
        assert bound == pytest.approx(expected, rel=1e-10)

    def test_many_small_teeth_about_as_fast_as_the_mode(self) -> None:
        """Half angles h below a thousandth: ways (phi^3 - h^2 phi) R/6 count beside jumps of speed w_s R h^2/2."""
        speed, pitch, teeth = 2.0, 0.2, 4000
        h = math.pi / teeth
        radius, w = pitch / (2 * h), speed / h
        phi = h * np.linspace(-1.0, 1.0, 20_001)
        u = radius * np.abs(phi**3 - h**2 * phi).max() / 6
        bound = chain_start.passing_bound(np.array([w]), np.array([0.0]), speed, 0.0, pitch, teeth, 1)[0]
        assert bound == pytest.approx(w * w * (8 * u + speed * radius * h * h / 2 / w), rel=1e-5)

    def test_nothing_bounds_endless_passes_without_damping(self) -> None:
        bound = chain_start.passing_bound(np.array([30.0]), np.array([0.0]), 1.0, 0.0, 0.2, 12, math.inf)
        assert bound[0] == math.inf
        assert math.isfinite(chain_start.passing_bound(np.array([30.0]), np.array([0.0]), 1.0, 0.0, 0.2, 12, 1e6)[0])


@pytest.mark.parametrize("zeta", [0.0, 0.3, 0.999, 1.0, 1.7, 2.0, 2.005, 2.3, 30.0])
def test_what_a_jump_of_the_input_leaves_of_its_energy(zeta: float) -> None:
    """d'' + 2 zeta w d' + w^2 d = 0 from d = -1, d' = 2 zeta w, by the matrix exponential."""
    w = 13.0
    times = np.array([1e-3, 0.02, 0.31, 1.7])
    matrix = np.array([[0.0, 1.0], [-w * w, -2 * zeta * w]])
    states = [expm(matrix * t) @ [-1.0, 2 * zeta * w] for t in times]
    expected = [math.hypot(d, v / w) for d, v in states]
    found = chain_start._left_energy(np.array([w]), np.array([zeta]), times[:, None])[:, 0]
    assert found == pytest.approx(expected, rel=1e-9, abs=1e-14)
