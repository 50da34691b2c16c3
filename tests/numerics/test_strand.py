"""Method of characteristics against finite elements, closed forms and brute force."""

import itertools
import math
import warnings
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from support import echoes, fem, slipping

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics import exponential_step, sagging, strand, strand_delays, strand_drum
from ptmcalc.numerics.loop import Drive, Grid, Grip, Loop, Motion, Strand, at_end, match, refined
from ptmcalc.numerics.strand import march

EA = 2.0e7
RHO = (120.0, 40.0)
LENGTHS = (400.0, 400.0)
Z = tuple(float(np.sqrt(EA * rho)) for rho in RHO)
TRANSIT = tuple(length * float(np.sqrt(rho / EA)) for length, rho in zip(LENGTHS, RHO, strict=True))


def loop(
    *,
    rigid: bool = False,
    drum: float = 20e3,
    tail: float = 0.0,
    on: float = 60e3,
    off: float = 30e3,
    tail_tension: float = 30e3,
    grip: Grip | None = None,
    spans: tuple[float, float] = (0.0, 0.0),
) -> Loop:
    return Loop(
        carry=Strand(LENGTHS[0], RHO[0], EA, tail_tension, on, spans[0]),
        back=Strand(LENGTHS[1], RHO[1], EA, off, tail_tension, spans[1]),
        drum_mass=drum,
        tail_mass=tail,
        fixed_length=rigid,
        grip=grip,
    )


def belt(*, rigid: bool = False, drum: float = 20e3, tail: float = 0.0) -> fem.Belt:
    return fem.Belt(LENGTHS, RHO, EA, drum, tail, rigid)


def step(force: float) -> Drive:
    return Drive(force=lambda t: np.full_like(t, force))


def grid(cells: int = 200, tolerance: float = 1e-6) -> Grid:
    return match(TRANSIT[0], TRANSIT[1], cells, tolerance)


@pytest.mark.parametrize("x", [1e-9, 1e-5, 5e-4, 9.99e-4, 1.001e-3, 0.03, 1.0, 30.0])
def test_weights_of_the_exponential_step(x: float) -> None:
    """Of a forcing that falls from 1 to 0, and of one that rises: x times int exp(-x (1 - u)) (1 - u or u) du."""
    terms = [(-x) ** k / math.factorial(k) for k in range(120)]
    new = -sum(term / (k + 1) for k, term in enumerate(terms[1:], 1)) if x <= 1 else 1 + math.expm1(-x) / x
    decay, old, rising = exponential_step.weights(x)
    assert decay == pytest.approx(math.exp(-x), rel=1e-14, abs=0)
    assert rising == pytest.approx(new, rel=3e-14 if x < 1e-3 else 2e-12, abs=0)
    assert old == pytest.approx(-math.expm1(-x) - new, rel=1e-11, abs=0)


def test_without_mass_a_step_is_over_at_once() -> None:
    assert exponential_step.weights(math.inf) == (0.0, 0.0, 1.0)


def test_inside_a_step_waves_forces_and_speeds_are_straight() -> None:
    cell = strand_drum._Cell((1.0, 3.0), (2.0, 7.0), (4.0, 10.0), (-1.0, 1.0))
    assert cell.waves(0.25) == (1.5, 3.25, 5.5)
    assert cell.speed(0.25) == -0.5


@pytest.mark.parametrize("share", [0.0, 0.3, 1.0])
def test_a_history_that_ends_inside_its_last_step(share: float) -> None:
    assert at_end(np.array([2.0, 5.0]), share) == pytest.approx(2 + 3 * share, rel=1e-14)
    places = np.array([-2.0, -1.0, 0.0, 1.0])
    parabola = np.polynomial.Polynomial([3.0, -1.0, 0.7])
    assert at_end(parabola(places), share) == pytest.approx(parabola(share), rel=1e-14)


@pytest.mark.parametrize("off", [0.0, 3e-5, -3e-5, 1e-3, 0.3, 20.0])
def test_tension_of_a_sagging_cell_is_a_root_of_its_cubic(off: float) -> None:
    """S^3 - target S^2 = lump, from wherever the last steps point."""
    target, lump = np.array([-4e3, 0.0, 900.0, 3e4]), np.array([2e11, 5e9, 3e8, 1e10])
    roots = np.array([max(np.roots([1.0, -t, 0.0, -c]).real) for t, c in zip(target, lump, strict=True)])
    last = roots * (1 + off)
    assert sagging._tension(target, lump, last, last) == pytest.approx(roots, rel=2e-13)


@pytest.mark.parametrize("share", [0.1, 0.5, 0.83])
@pytest.mark.parametrize("turn", [3.0, -0.7])
def test_what_a_corner_adds_to_the_samples_beside_it(share: float, turn: float) -> None:
    """A wave that changes its slope within a cell: a quarter of step times change, what one in the middle rises."""
    wave = 1.3 + 0.2 * np.arange(12.0) - turn * np.maximum(np.arange(12.0) - 5 - share, 0.0)
    for beside in (5, 6):
        assert strand_delays._bend(wave, beside) == pytest.approx(abs(turn) / 4, rel=1e-12)
    assert strand_delays._bend(wave, 2) == pytest.approx(0.0, abs=1e-14)
    assert strand_delays._bend(wave[4:], 1) == pytest.approx(abs(turn) / 4, rel=1e-12), "at the beginning as well"
    assert strand_delays._bend(wave[:3], 1) == 0.0


@pytest.mark.parametrize("power", [1, 2, 3, 9])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_an_event_inside_a_step_is_a_root(power: int, sign: float) -> None:
    places = []

    def distance(x: float) -> float:
        places.append(x)
        return sign * (x**power - 0.2)

    assert strand_drum._root(distance, 0.0, 1.0) == pytest.approx(0.2 ** (1 / power), rel=1e-12)
    assert len(places) <= 20, "and it is known when it is found"


def test_an_event_may_lie_on_a_place_that_is_tried_or_at_the_start() -> None:
    assert strand_drum._root(lambda x: x - 0.5, 0.0, 1.0) == 0.5
    for size in (1e-3, 1.0, 1e3):
        assert strand_drum._root(lambda x, size=size: size * (1.0 + x), 0.25, 1.0) == 0.25, (
            "it does not change its sign"
        )


class TestMatch:
    @pytest.mark.parametrize(("first", "second"), [(1.0, 0.5), (1.33243, 0.52475), (0.02, 0.31), (1.0, np.sqrt(2))])
    def test_divides_both_travel_times(self, first: float, second: float) -> None:
        found = match(first, second, 50, 1e-5)
        assert found.mismatch <= 1e-5
        assert found.carry * found.step == pytest.approx(first, rel=1e-5)
        assert found.back * found.step == pytest.approx(second, rel=1e-5)

    def test_keeps_the_whole_contour_exact(self) -> None:
        found = match(1.0, np.sqrt(2), 50, 1e-5)
        assert (found.carry + found.back) * found.step == pytest.approx(1 + np.sqrt(2), rel=1e-14)

    def test_says_how_far_it_is_when_no_grid_is_good_enough(self) -> None:
        found = match(1.0, np.pi, 10, 1e-12, at_most=20)
        assert found.mismatch > 1e-12


class TestAgainstClosedForms:
    def test_echo_series(self) -> None:
        window = 6.0
        motion = march(loop(), step(9e3), window, grid(800))
        exact = 60e3 + echoes.run_on(9e3, (Z[0], Z[1]), 20e3, (TRANSIT[0], TRANSIT[1]), motion.times)
        assert np.max(np.abs(motion.run_on - exact)) < 2e-5 * 9e3

    def test_uniform_ramp_of_speed_has_factor_two(self) -> None:
        """Linear ramp on a uniform loop: largest tension twice rho L a, for any ramp of at least half a period."""
        half = Strand(500.0, 100.0, 1e8, 0.0, 0.0)
        line = Loop(half, half, 1.0, 0.0, fixed_length=False)
        for periods in (0.5, 0.77, 1.0, 3.1):
            rise = 4.0 * periods
            drive = Drive(speed=lambda t, rise=rise: 4.0 * np.clip(t / rise, 0, 1))
            motion = march(line, drive, rise + 4.0, match(0.5, 0.5, 200, 1e-9))
            assert motion.largest(motion.run_on)[0] == pytest.approx(2 * 100 * 1000 * 4.0 / rise, rel=1e-3)

    def test_cosine_start_of_the_worked_case(self) -> None:
        """Uniform loop, 4 m/s, cosine over three periods: 59190.4 N by the image series."""
        half = Strand(500.0, 100.0, 1e8, 0.0, 0.0)
        line = Loop(half, half, 1.0, 0.0, fixed_length=False)
        drive = Drive(speed=lambda t: 4.0 * np.sin(np.pi / 2 * np.clip(t / 12.0, 0, 1)) ** 2)
        motion = march(line, drive, 16.0, match(0.5, 0.5, 200, 1e-9))
        assert motion.largest(motion.run_on)[0] == pytest.approx(59190.4, rel=1e-5)

    def test_massless_drum_does_not_ring(self) -> None:
        """With m -> 0 the rim force is the tension: no oscillation about it, whatever the step."""
        motion = march(loop(drum=1e-9), step(9e3), 0.9 * 2 * TRANSIT[0], grid(20, 1e-3))
        assert motion.run_on[1:] == pytest.approx(np.full(len(motion.times) - 1, 69e3), rel=1e-12)

    def test_drum_of_a_belt_without_mass_falls_freely(self) -> None:
        light = Loop(
            Strand(10.0, 1e-12, 1e3, 0.0, 0.0), Strand(10.0, 1e-12, 1e3, 0.0, 0.0), 12e3, 0.0, fixed_length=False
        )
        motion = march(light, step(6e4), 1e-6, match(1e-6 * np.sqrt(0.1), 1e-6 * np.sqrt(0.1), 16, 1e-6))
        assert motion.drum_speed[-1] == pytest.approx(6e4 / 12e3 * 1e-6, rel=1e-9)


class TestAgainstFiniteElements:
    @pytest.mark.parametrize("rigid", [False, True])
    @pytest.mark.parametrize("tail", [0.0, 3e3])
    def test_torque_step(self, rigid: bool, tail: float) -> None:
        window, force = 5.0, 9e3
        motion = march(loop(rigid=rigid, tail=tail), step(force), window, grid(400))
        times = np.linspace(0, window, 801)
        mesh = fem.step_response(belt(rigid=rigid, tail=tail), (400, 240), force, times)
        assert (
            np.max(np.abs(np.interp(times, motion.times, motion.run_on) - 60e3 - mesh["run_on"])) < 0.03 * force
        )  # of the mesh
        assert np.max(np.abs(np.interp(times, motion.times, motion.run_off) - 30e3 - mesh["run_off"])) < 0.03 * force
        speed = np.interp(times, motion.times, motion.drum_speed)
        assert np.max(np.abs(speed - mesh["drum_speed"])) < 2e-3 * speed.max()

    @pytest.mark.parametrize("rigid", [False, True])
    def test_extremes_anywhere_on_the_belt(self, rigid: bool) -> None:
        window, force = 5.0, 9e3
        motion = march(loop(rigid=rigid, on=0.0, off=0.0, tail_tension=0.0), step(force), window, grid(400))
        mesh = fem.step_response(belt(rigid=rigid), (400, 240), force, np.linspace(0, window, 1601))["all"]
        carry, back = mesh[:400], mesh[400:]
        assert motion.carry_max.value == pytest.approx(carry.max(), abs=0.02 * force)
        assert motion.carry_min.value == pytest.approx(carry.min(), abs=0.02 * force)
        assert motion.back_max.value == pytest.approx(back.max(), abs=0.02 * force)
        assert motion.back_min.value == pytest.approx(back.min(), abs=0.02 * force)
        line = loop(rigid=rigid, on=60e3, off=60e3, tail_tension=60e3)
        for other, static in (motion, 0.0), (sagging.march(line, step(force), window, sagging.grid_of(line, 60)), 60e3):
            for begin, tensions, found in (
                (LENGTHS[1], carry[::-1], (other.carry_max, other.carry_min)),
                (0.0, back[::-1], (other.back_max, other.back_min)),
            ):
                for extreme in found:  # they are where and when they are said to be
                    row = int((extreme.position - begin) / 400.0 * (len(tensions) - 1))
                    column = round(extreme.time / window * 1600)
                    near = tensions[max(row - 8, 0) : row + 9, max(column - 20, 0) : column + 21]
                    assert np.abs(near + static - extreme.value).min() < 0.02 * force, extreme

    @pytest.mark.parametrize("rigid", [False, True])
    def test_imposed_cosine(self, rigid: bool) -> None:
        speed, rise = 3.0, 2.5
        drive = Drive(speed=lambda t: speed * np.sin(np.pi / 2 * np.clip(t / rise, 0, 1)) ** 2)
        motion = march(loop(rigid=rigid, tail=2e3), drive, 5.0, grid(300))
        times = np.linspace(0, 5.0, 5001)
        rate = lambda t: speed * np.pi / (2 * rise) * np.sin(np.pi * t / rise) * (t < rise)  # noqa: E731
        mesh = fem.imposed_speed(belt(rigid=rigid, tail=2e3), (120, 72), rate, times)
        scale = np.abs(mesh["run_on"]).max()
        assert np.max(np.abs(np.interp(times, motion.times, motion.run_on) - 60e3 - mesh["run_on"])) < 0.01 * scale
        assert np.max(np.abs(np.interp(times, motion.times, motion.run_off) - 30e3 - mesh["run_off"])) < 0.01 * scale

    def test_without_the_impedance_jump_the_return_strand_echoes_later_only(self) -> None:
        plain = Loop(loop().carry, loop().back, 20e3, 0.0, fixed_length=False, impedance_jump=False)
        motion = march(plain, step(9e3), 2 * sum(TRANSIT) - 0.05, grid(400))
        a = Z[0] / 20e3
        inside = motion.times[:-1]
        assert motion.run_on[:-1] - 60e3 == pytest.approx(9e3 * -np.expm1(-a * inside), rel=1e-9, abs=1e-6)

    @pytest.mark.parametrize("rigid", [False, True])
    def test_sagging_belt(self, rigid: bool) -> None:
        """Softening up to 1.6, waves that grow into shocks: extremes against lumped masses, Kelvin-Voigt, DOP853."""
        spans, force, window = (900.0, 450.0), 9e3, 4.0
        on, off, tail = 12e3, 6e3, 6e3
        line = loop(rigid=rigid, on=on, off=off, tail_tension=tail, spans=spans)
        motion = sagging.march(line, step(force), window, sagging.grid_of(line, 120))
        count = (240, 138)
        carry = np.linspace(on, tail, count[0] + 1)[:-1] - (on - tail) / (2 * count[0])
        static = np.concatenate([carry, np.full(count[1], tail)])
        times = np.linspace(0, window, 801)
        cell = LENGTHS[0] / count[0] * np.sqrt(RHO[0] / EA)
        mesh = fem.sagging_step(belt(rigid=rigid), count, force, static, spans, times, 0.25 * cell)
        straight = march(loop(rigid=rigid, on=on, off=off, tail_tension=tail), step(force), window, grid(200, 1e-3))
        peak = motion.largest(motion.run_on)[0]
        assert abs(straight.largest(straight.run_on)[0] - peak) > 0.02 * force  # sag matters here
        assert motion.cell_updates == (motion.grid.carry + motion.grid.back) * (len(motion.times) - 1)
        assert peak == pytest.approx(mesh["run_on"].max(), rel=0.005)
        assert motion.back_min.value == pytest.approx(mesh["all"][count[0] :].min(), rel=0.03)
        assert motion.back_max.value == pytest.approx(mesh["all"][count[0] :].max(), rel=0.06)


class TestSag:
    @pytest.mark.parametrize("opens", [1e-4, 0.02, 3.0])
    def test_a_cell_that_is_stretched_pulls_more_by_what_its_waves_steepen(self, opens: float) -> None:
        """rho dc/dv dv^2 with c the speed of waves in a belt that sags, by differences of c over S, dS = rho c dv; at
        most a quarter of the impedance. A cell that closes does not."""
        line = loop(on=12e3, off=6e3, tail_tension=6e3, spans=(900.0, 450.0))
        cut = sagging.grid_of(line, 12)
        belt = sagging._Belt(line, cut)
        belt.speed = np.zeros(len(belt.speed))
        belt.speed[1::2] = opens * cut.step
        belt.stretch()
        weights = np.where(np.arange(len(belt.tension)) < cut.back, 450.0, 900.0)
        rho = np.where(np.arange(len(belt.tension)) < cut.back, RHO[1], RHO[0])

        def speed(tension: np.ndarray) -> np.ndarray:
            return np.sqrt(EA / (1 + weights**2 * EA / (12 * tension**3)) / rho)

        tension, dv = belt.tension, opens * cut.step
        steepens = (speed(tension * 1.00001) - speed(tension * 0.99999)) / (tension * 2e-5) * rho * speed(tension)
        expected = np.minimum(rho * steepens * dv**2, np.sqrt(EA * rho) * dv / 4)
        opening = np.diff(belt.speed) > 0
        assert belt.viscous[opening] == pytest.approx(expected[opening], rel=1e-6)
        assert not belt.viscous[~opening].any()

    def test_hangs_under_any_tension(self) -> None:
        """A toy belt of a millionth of a newton."""
        toy = loop(on=2e-6, off=1e-6, tail_tension=1e-6)
        assert sagging._Belt(toy, sagging.grid_of(toy, 4)).static.max() < 2e-6

    @pytest.mark.parametrize("fixed", [False, True])
    @pytest.mark.parametrize("sense", [1, -1])
    def test_grips_up_to_the_friction_of_what_is_left_by_the_centrifugal_tension(self, sense: int, fixed: bool) -> None:
        """At an acceleration and a speed of the belt: run-on and run-off less rho v^2, as exp(mu alpha)."""
        line = loop(rigid=fixed, on=50e3, off=50e3, tail_tension=50e3, grip=Grip(0.4, 300.0))
        cut = sagging.grid_of(line, 12)
        belt = sagging._Belt(line, cut)
        drum = sagging._Drum(line, step(0.0), cut, belt)
        belt.speed[-1] = 7.0
        halves = [RHO[0] * 400.0 / cut.carry / 2, RHO[1] * 400.0 / cut.back / 2 if fixed else 0.0]
        rate, off_cell = 1.7, 3e3 if fixed else 0.0
        off = 50e3 + off_cell - halves[1] * rate - 300.0 * 49.0
        on_cell = off * math.exp(sense * 0.4) - 50e3 - halves[0] * rate + 300.0 * 49.0
        assert drum._breaks(on_cell + sense * 1e-3, off_cell, rate) == sense
        assert drum._breaks(on_cell - sense * 1e-3, off_cell, rate) == 0

    @pytest.mark.parametrize("rigid", [False, True])
    def test_both_methods_agree_on_a_straight_belt(self, rigid: bool) -> None:
        """The staggered grid and the characteristics share no step; what they differ by falls with the step."""
        differences = []
        for cells in (50, 100, 200):
            cut = match(0.5, 0.25, cells, 1e-9)
            even = Loop(
                Strand(500.0, 40.0, 4e7, 60e3, 70e3),
                Strand(500.0, 10.0, 4e7, 60e3, 60e3),
                20e3,
                2e3,
                fixed_length=rigid,
            )
            one, other = (method(even, step(9e3), 4.0, cut) for method in (march, sagging.march))
            differences.append(np.max(np.abs(one.run_on - other.run_on)))
        assert differences[-1] < 3e-3 * 9e3
        assert np.log2(differences[0] / differences[2]) / 2 > 0.85  # at the corners; second order between them

    @pytest.mark.parametrize("tail", [0.0, 2e3])
    def test_all_waves_agree_to_second_order_where_nothing_has_a_corner(self, tail: float) -> None:
        """What leaves the drum, the tail on either side, and the run-off, of a straight belt by both methods."""
        even = Loop(
            Strand(500.0, 40.0, 4e7, 60e3, 70e3), Strand(500.0, 10.0, 4e7, 60e3, 60e3), 20e3, tail, fixed_length=True
        )
        smooth = Drive(force=lambda t: 9e3 * np.sin(np.pi / 4 * t) ** 4)
        apart = []
        for cells in (20, 40):
            cut = match(0.5, 0.25, cells, 1e-9)
            one, other = (method(even, smooth, 4.0, cut).waves for method in (march, sagging.march))
            apart.append(np.abs(one - other).max(axis=1) / np.abs(one).max(axis=1))
        assert np.all(apart[1] < 2e-3)
        assert np.all(np.log2(apart[0] / apart[1]) > 1.8)

    def test_extremes_are_told_at_nodes_and_at_the_ends(self) -> None:
        """The force of a start is highest where the carrying strand runs on, 400 m behind and 400 m ahead of that."""
        line = loop(on=12e3, off=6e3, tail_tension=6e3, spans=(900.0, 450.0))
        cut = sagging.grid_of(line, 60)
        motion = sagging.march(line, step(9e3), 2.0, cut)
        assert motion.carry_max.position == 800.0
        for one, cells, begins in (
            (motion.carry_max, cut.carry, 400.0), (motion.carry_min, cut.carry, 400.0),
            (motion.back_max, cut.back, 0.0), (motion.back_min, cut.back, 0.0),
        ):  # fmt: skip
            halves = (one.position - begins) / 400.0 * 2 * cells
            assert halves == pytest.approx(round(halves), abs=1e-9)
            assert 0 <= halves <= 2 * cells

    @pytest.mark.parametrize("rigid", [False, True])
    def test_shocks_converge(self, rigid: bool) -> None:
        """Halving the grid three times changes the run-on peak by less than a thousandth."""
        line = loop(rigid=rigid, on=12e3, off=6e3, tail_tension=6e3, spans=(900.0, 450.0))
        peaks = [
            motion.largest(motion.run_on)[0]
            for motion in (
                sagging.march(line, step(9e3), 4.0, sagging.grid_of(line, cells)) for cells in (30, 60, 120, 240)
            )
        ]
        assert peaks == pytest.approx([peaks[-1]] * 4, rel=1e-3)

    def test_tension_of_a_sagging_belt_stays_positive(self) -> None:
        """A straight belt would be pushed to -30 kN; a sagging one hangs deeper but keeps its pull."""
        low = {"rigid": True, "on": 12e3, "off": 3e3, "tail_tension": 3e3}
        straight = march(loop(**low), step(60e3), 4.0, grid(100, 1e-4))
        hanging_loop = loop(**low, spans=(900.0, 450.0))
        hanging = sagging.march(hanging_loop, step(60e3), 4.0, sagging.grid_of(hanging_loop, 60))
        assert straight.back_min.value < -10e3
        assert 0 < hanging.back_min.value < 3e3

    def test_refuses_a_static_state_without_tension(self) -> None:
        with pytest.raises(NumericsError, match="cannot hang without tension"):
            sagging.march(loop(off=-1e3, spans=(900.0, 450.0)), step(9e3), 1.0, grid(50, 1e-3))


class TestSlip:
    GRIP = Grip(0.9, 12.0)

    @pytest.mark.parametrize(("rigid", "force"), [(False, 25e3), (False, 40e3), (True, 14e3)])
    def test_brute_force_agrees(self, rigid: bool, force: float) -> None:
        bare = Grip(self.GRIP.exponent, 0.0)  # the brute force has no centrifugal tension
        motion = march(loop(rigid=rigid, grip=bare), step(force), 3.0, grid(300))
        other = slipping.start(belt(rigid=rigid), (300, 170), force, 60e3, 30e3, bare.exponent, 3.0)
        assert motion.slipped
        assert motion.belt_speed[-1] == pytest.approx(other.belt_speed, rel=0.01)
        assert motion.drum_speed[-1] == pytest.approx(other.drum_speed, rel=0.01)
        assert motion.largest(motion.run_on)[0] == pytest.approx(other.run_on_max, rel=0.01)
        slip = np.trapezoid(motion.drum_speed - motion.belt_speed, motion.times)
        assert slip == pytest.approx(other.slip_distance, rel=0.02, abs=1e-3)

    def test_run_on_is_capped_by_the_capstan_law(self) -> None:
        motion = march(loop(grip=self.GRIP), step(40e3), 3.0, grid(200))
        lift = self.GRIP.belt_line_mass * motion.belt_speed**2
        ratio = (motion.run_on - lift) / (motion.run_off - lift) * np.exp(-self.GRIP.exponent)
        assert ratio.max() <= 1 + 1e-9
        slides = motion.drum_speed > motion.belt_speed + 1e-9
        assert slides.any()
        assert ratio[slides] == pytest.approx(np.ones(slides.sum()), rel=1e-9)

    def test_enough_grip_changes_nothing(self) -> None:
        free = march(loop(), step(9e3), 4.0, grid(100, 1e-4))
        held = march(loop(grip=Grip(3.0, 12.0)), step(9e3), 4.0, grid(100, 1e-4))
        assert not held.slipped
        assert held.run_on == pytest.approx(free.run_on, rel=1e-12)

    def test_it_sticks_again(self) -> None:
        """A short surge of force makes the drum spin; when it is over, belt and drum come together and stay."""
        surge = Drive(force=lambda t: np.where(t < 0.5, 60e3, 2e3))
        motion = march(loop(grip=self.GRIP), surge, 6.0, grid(200))
        assert motion.slipped
        late = motion.times > 5.5
        assert np.max(np.abs(motion.drum_speed - motion.belt_speed)[late]) == 0.0

    @pytest.mark.parametrize("spans", [(0.0, 0.0), (60.0, 30.0)], ids=["straight", "taut"])
    def test_a_light_drum_in_elements_catches_the_belt_as_by_characteristics(self, spans: tuple[float, float]) -> None:
        """What drum and belt have when they meet they keep: the energy closes, and both methods meet at one speed."""
        surge = Drive(force=lambda t: np.where(t < 0.5, 60e3, 2e3))
        light = loop(grip=self.GRIP, spans=spans, drum=4e3)
        found = sagging.march(light, surge, 3.0, sagging.grid_of(light, 100))
        other = march(loop(grip=self.GRIP, drum=4e3), surge, 3.0, grid(200))
        met, at = (
            motion.times[1:][(np.diff(np.abs(motion.drum_speed - motion.belt_speed) > 0)) & (motion.times[1:] > 0.5)]
            for motion in (found, other)
        )
        assert len(met) == len(at) == 1
        assert met[0] == pytest.approx(at[0], abs=2 * found.grid.step)
        assert found.energy_residual < 3e-4
        assert found.drum_speed[-1] == pytest.approx(other.drum_speed[-1], rel=1e-3)

    def test_braking_sense(self) -> None:
        """A drum held back by a fast stop of its speed lets the belt run ahead: the run-off is the tight side."""
        drive = Drive(speed=lambda t: np.where(t < 1.0, 3.0 * t, np.maximum(3.0 - 30.0 * (t - 1.0), 0.0)))
        motion = march(loop(rigid=True, on=31e3, grip=Grip(0.5, 0.0)), drive, 3.0, grid(200))
        assert motion.slipped
        assert np.min(motion.drum_speed - motion.belt_speed) < -1e-3
        assert np.max(motion.run_off / motion.run_on) <= np.exp(0.5) * (1 + 1e-9)

    @pytest.mark.parametrize("back", [False, True])
    @pytest.mark.parametrize("rigid", [False, True])
    def test_the_unit_of_force_does_not_matter(self, rigid: bool, back: bool) -> None:
        """A toy belt, all its forces and masses a millionth: the same motion to the last digit, in both senses."""
        unit = 2.0**-20
        real = loop(rigid=rigid, on=31e3 if back else 60e3, drum=2e3, grip=Grip(0.5, 12.0))
        small = Loop(
            *(
                replace(
                    one,
                    line_mass=one.line_mass * unit,
                    stiffness=one.stiffness * unit,
                    static_start=one.static_start * unit,
                    static_end=one.static_end * unit,
                )
                for one in (real.carry, real.back)
            ),
            real.drum_mass * unit,
            0.0,
            rigid,
            Grip(0.5, 12.0 * unit),
        )

        def force(t: np.ndarray) -> np.ndarray:
            return np.where(t < 1.0, 10e3, -30e3 if back else 40e3)

        motions = [
            march(one, Drive(force=lambda t, k=k: force(t) * k), 2.0, grid(100, 1e-4))
            for one, k in ((real, 1.0), (small, unit))
        ]
        lead = motions[0].drum_speed - motions[0].belt_speed
        assert (lead.min() < -1e-3) if back else (lead.max() > 1e-3)
        assert np.array_equal(motions[0].belt_speed, motions[1].belt_speed)
        assert np.array_equal(motions[0].drum_speed, motions[1].drum_speed)
        assert np.array_equal(motions[0].run_on * unit, motions[1].run_on)

    def test_slip_from_the_start_holds_the_belt_back(self) -> None:
        """A static state beyond the grip: the belt is held by its idlers and never runs backward."""
        motion = march(loop(on=120e3, grip=self.GRIP), step(9e3), 2.0, grid(100, 1e-4))
        assert motion.slipped
        assert motion.belt_speed.min() >= 0.0
        assert motion.drum_speed[-1] > 0.0


@pytest.mark.parametrize("forward", [True, False])
@pytest.mark.parametrize("rigid", [False, True])
def test_slip_before_any_echo_by_hand(rigid: bool, forward: bool) -> None:
    """Forces that are straight from sample to sample. Stuck, m v' + Z v = F; slipping, the belt keeps the speed at
    which friction holds and m w' = F - Z v, until the drum is at that speed again. No step leaves anything out."""
    on, off, mass, step_size = 60e3 if forward else 15e3, 30e3, 2e3, 0.02
    grip = Grip(0.9 if forward else 0.5, 12.0)
    z_off = Z[1] if rigid else 0.0
    z = Z[0] + z_off
    corners = step_size * np.array([0.0, 11.0, 14.0, 26.0, 60.0])
    pulls = 1e3 * np.array([0.0, 45.0, 2.0, 2.0, 9.0] if forward else [5.0, 30.0, -20.0, 9.0, 9.0])

    def excess(v: float) -> float:
        """Of the tight side over what friction holds, both less the centrifugal tension."""
        ends = on + Z[0] * v - 12.0 * v * v, off - z_off * v - 12.0 * v * v
        tight, slack = ends if forward else ends[::-1]
        return tight - math.exp(grip.exponent) * slack

    def after(time: float, begin: float, v: float, w: float, slips: bool) -> tuple[float, float]:
        """Speeds of belt and drum some time after a sample."""
        force, end = np.interp([begin, begin + step_size], corners, pulls)
        slope = (end - force) / step_size
        if slips:
            return v, w + ((force - z * v) * time + slope * time**2 / 2) / mass
        late = (force + slope * (time - mass / z)) / z
        stuck = late + (v - (force - slope * mass / z) / z) * math.exp(-z / mass * time)
        return stuck, stuck

    def margin(speeds: tuple[float, float], slips: bool) -> float:
        """Above 0 where the state changes."""
        return (speeds[0] - speeds[1]) * (1 if forward else -1) if slips else excess(speeds[0])

    motion = march(
        loop(rigid=rigid, drum=mass, on=on, off=off, grip=grip),
        Drive(force=lambda t: np.interp(t, corners, pulls)),
        60 * step_size,
        Grid(step_size, 80, 80, 0.0),
    )
    v, w, slips, first, changed = 0.0, 0.0, False, 1, []
    if not forward:  # it slips from the start: the belt runs ahead at once
        v, w, slips, first = float(motion.belt_speed[1]), float(motion.drum_speed[1]), True, 2
        assert excess(v) == pytest.approx(0.0, abs=1e-9 * on)
        forces = np.interp([0.0, step_size], corners, pulls)
        assert w == pytest.approx((forces.sum() - z * v) * step_size / 2 / mass, rel=1e-12), "the belt was at rest"
    for k in range(first, 61):
        begin = (k - 1) * step_size
        ends = after(step_size, begin, v, w, slips)
        if margin(ends, slips) > 1e-9:
            state = v, w, slips
            at = brentq(
                lambda t, state=state, begin=begin: margin(after(t, begin, *state), state[2]), 0, step_size, xtol=1e-16
            )
            v, w = after(at, begin, v, w, slips)
            slips = not slips
            changed.append(k)
            # what is left of the step, by the force from there on
            force, end = np.interp([begin + at, begin + step_size], corners, pulls)
            left = step_size - at
            if slips:
                ends = v, w + (force + end - 2 * z * v) * left / 2 / mass
            else:
                slope = (end - force) / left
                late = (force - slope * mass / z) / z
                stuck = late + slope * left / z + (v - late) * math.exp(-z / mass * left)
                ends = stuck, stuck
        v, w = ends
        assert (motion.belt_speed[k], motion.drum_speed[k]) == pytest.approx((v, w), rel=1e-9), k
    assert len(changed) == (2 if forward else 3)
    assert min(np.diff(changed)) > 2


@pytest.mark.parametrize("rigid", [False, True])
@pytest.mark.parametrize("echo", [3e3, -2e3])
def test_a_drum_that_has_caught_the_belt_goes_on_with_the_waves_that_arrive(echo: float, rigid: bool) -> None:
    """It slips a little at first and is braked; then m v' + Z v = F - N + P, all on the right even."""
    mass, force, off_echo, step_size = 2e3, 5e3, 500.0 if rigid else 0.0, 0.02
    grip = Grip(0.9, 0.0)
    drum = strand_drum.Drum(
        loop(rigid=rigid, drum=mass, grip=grip), step(force), step_size * np.arange(4.0), Grid(step_size, 80, 80, 0.0)
    )
    z_off = Z[1] if rigid else 0.0
    tight, slack = 60e3 + echo, 30e3 + off_echo
    belt = (slack * math.exp(0.9) - tight) / (Z[0] + z_off * math.exp(0.9))  # friction is at its limit
    drum.slipping, drum.at, drum.arriving = 1, (belt, belt + 5e-4), (echo, off_echo)
    speeds = np.zeros((2, 3))
    drum._by_steps(1, np.full(3, echo), np.full(3, off_echo), speeds[0], speeds[1])
    assert not drum.slipping
    assert np.array_equal(*speeds)
    z = Z[0] + z_off
    late = (force - echo + off_echo) / z
    decay = math.exp(-z / mass * step_size)
    for before, after in itertools.pairwise(speeds[0].tolist()):
        assert after == pytest.approx(late + (before - late) * decay, rel=1e-12)


class TestEnergy:
    @pytest.mark.parametrize("rigid", [False, True])
    @pytest.mark.parametrize(
        ("grip", "spans", "tolerance"),
        [(None, (0.0, 0.0), 1e-6), (Grip(0.8, 12.0), (0.0, 0.0), 1e-4), (None, (300.0, 150.0), 1e-3)],
    )
    def test_balance_closes(self, rigid: bool, grip: Grip | None, spans: tuple[float, float], tolerance: float) -> None:
        line = loop(rigid=rigid, tail=2e3, grip=grip, spans=spans)
        if spans[0]:
            motion = sagging.march(line, step(20e3), 5.0, sagging.grid_of(line, 200))
        else:
            motion = march(line, step(20e3), 5.0, grid(400, 1e-5))
        assert motion.energy_residual < tolerance

    def test_balance_would_notice_an_error(self) -> None:
        """The residual is no identity: it falls with the square of the step, so it measures something."""
        coarse = march(loop(), step(20e3), 5.0, grid(50, 1e-4))
        fine = march(loop(), step(20e3), 5.0, refined(refined(grid(50, 1e-4))))
        assert coarse.energy_residual / fine.energy_residual == pytest.approx(16, rel=0.3)


class TestLimits:
    def test_too_many_steps_is_a_finding_not_a_hang(self) -> None:
        with pytest.raises(NumericsError, match="steps"):
            march(loop(), step(1.0), 1e6, grid(200))

    def test_work_is_counted(self) -> None:
        small, large = (march(loop(), step(9e3), window, grid(100, 1e-4)) for window in (2.0, 8.0))
        assert 0 < small.cell_updates < large.cell_updates
        assert isinstance(small.cell_updates, int)

    @pytest.mark.parametrize("drum", [1e-12, 1.0, 1e12])
    @pytest.mark.parametrize("tail", [0.0, 1e-12, 1e12])
    @pytest.mark.parametrize("rigid", [False, True])
    def test_masses_over_24_decades_stay_finite(self, drum: float, tail: float, rigid: bool) -> None:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            motion = march(loop(drum=drum, tail=tail, rigid=rigid), step(9e3), 3.0, grid(50, 1e-3))
        assert np.isfinite(motion.waves).all()
        assert motion.run_on.max() <= 60e3 + 2.5 * 9e3


def test_tail_mass_against_a_tight_ode() -> None:
    """Before any echo the tail drum follows m v' + (Z1 + Z2) v = P, integrated here by DOP853."""
    drive = Drive(speed=lambda t: 1.0 - np.exp(-3 * t))
    window = TRANSIT[0] + min(2 * TRANSIT[1], 2 * TRANSIT[0]) * 0.9
    motion = march(loop(tail=3e3), drive, window, grid(800, 1e-5))

    def rate(t: float, v: np.ndarray) -> np.ndarray:
        arriving = 2 * Z[0] * (1.0 - np.exp(-3 * max(t - TRANSIT[0], 0.0)))
        return (arriving - (Z[0] + Z[1]) * v) / 3e3

    exact = solve_ivp(rate, (0, window), [0.0], "DOP853", motion.times, rtol=1e-11, atol=1e-13, max_step=0.01).y[0]
    leaving = motion.waves[2] / (2 * Z[1])  # nothing has come back along the return strand yet
    assert np.max(np.abs(leaving - exact)[:-1]) < 2e-5


@pytest.mark.parametrize("method", [march, sagging.march], ids=["straight", "sagging"])
def test_a_belt_that_never_moves_keeps_its_energy_and_does_not_run_backward(method: Callable[..., Motion]) -> None:
    """The drum slips under a belt it cannot move: all that the belt exchanges is rounding, and is no error."""
    spans = (1373.4, 588.6) if method is sagging.march else (0.0, 0.0)
    held = Loop(
        carry=Strand(1e5, 160.0, 4e7, 861577.8988577351, 5177191.270861879, spans[0]),
        back=Strand(1e5, 28.0, 4e7, 150e3, 861577.8988577347, spans[1]),
        drum_mass=9824.0,
        tail_mass=0.0,
        fixed_length=False,
        grip=Grip(0.35 * np.radians(200), 20.0),
    )
    drive = Drive(speed=lambda t: 4.0 * np.minimum(t / 20.0, 1.0))
    cut = sagging.grid_of(held, 40) if method is sagging.march else match(200.0, 83.7, 40, 1e-3)
    motion = method(held, drive, 800.0, cut)
    assert motion.slipped
    assert motion.drum_speed[-1] == pytest.approx(4.0)
    assert np.abs(motion.belt_speed).max() < 1e-9
    assert 0 <= motion.energy_residual < 1e-6
    assert not motion.reversed


@pytest.mark.parametrize("cells", [3, 50])
@pytest.mark.parametrize("ratio", [0.25, 1.0, 2.999995, 3.0, 7.3])
def test_cells_of_a_sagging_belt_are_no_shorter_than_those_of_its_faster_strand(ratio: float, cells: int) -> None:
    """Which is cut into so many; a step is the travel time of that cell."""
    carry = Strand(600.0, 90.0, 4e7, 20e3, 60e3)
    found = sagging.grid_of(Loop(carry, replace(carry, length=600.0 * ratio), 12e3, 2e3, fixed_length=True), cells)
    fastest = min(ratio, 1.0) * carry.transit
    assert found.step == pytest.approx(fastest / cells, rel=1e-8)
    assert min(found.carry, found.back) == cells
    for many, transit in ((found.carry, carry.transit), (found.back, ratio * carry.transit)):
        assert many <= transit / found.step + 1e-6 < many + 1.0001
    assert (found.mismatch, found.panel) == (0.0, 1)


def test_a_cell_of_a_sagging_belt_has_the_tension_of_its_middle() -> None:
    strands = Strand(600.0, 90.0, 4e7, 20e3, 60e3, 300.0), Strand(600.0, 40.0, 4e7, 30e3, 20e3, 200.0)
    found = sagging._Belt(line := Loop(*strands, 12e3, 2e3, fixed_length=True), sagging.grid_of(line, 24))
    for part, one in zip(np.split(found.static, [found.split]), (line.back, line.carry), strict=True):
        assert part.mean() == pytest.approx((one.static_start + one.static_end) / 2, rel=1e-12)
        assert part[[0, -1]] + [-1, 1] * np.diff(part)[[0, -1]] / 2 == pytest.approx(
            [one.static_start, one.static_end], rel=1e-12
        )


@pytest.mark.parametrize("steps", [2, 3, 7, 40])
@pytest.mark.parametrize("grip", [None, Grip(math.log(1.51), 12.0)])
@pytest.mark.parametrize("speed", [False, True])
@pytest.mark.parametrize("fixed", [False, True])
def test_the_ledger_of_a_taut_loop_closes_however_few_steps_it_has(
    steps: int, grip: Grip | None, speed: bool, fixed: bool
) -> None:
    """Spans without weight do not sag: the scheme is linear, and its energy is that of the half steps on both sides.
    A drum that has next to no more grip than the belt at rest asks for slips at once."""
    strands = Strand(600.0, 90.0, 4e7, 20e3, 45e3), Strand(600.0, 40.0, 4e7, 30e3, 20e3)
    line = Loop(*strands, 12e3, 2e3, fixed_length=fixed, grip=grip)
    parts = sagging.grid_of(line, 24)
    drive = Drive(speed=lambda t: 0.3 * t) if speed else Drive(force=lambda t: np.full_like(t, 9e3))
    motion = sagging.march(line, drive, steps * parts.step, parts)
    assert len(motion.times) == steps + 1
    assert motion.energy_residual < 1e-9
    if speed:
        assert motion.drum_speed[1:] == pytest.approx(0.3 * motion.times[1:], rel=1e-12)
    if grip is not None and steps > 3:
        assert motion.slipped


@pytest.mark.parametrize("method", [strand.march, sagging.march])
def test_a_drum_that_slips_at_the_speed_of_its_motor_grips_the_belt_there(method: Callable[..., Motion]) -> None:
    """The belt comes to the held speed while the motor could pull much harder than friction holds: held, it asks for
    little, so that belt and drum go on as one."""
    part = Strand(200.0, 40.0, 20e6, 30e3, 30e3)
    line = Loop(carry=part, back=part, drum_mass=800.0, tail_mass=0.0, fixed_length=False, grip=Grip(0.5, 0.0))
    drive = Drive(force=lambda times: np.full_like(times, 60e3), hold=1.0)
    motion = method(line, drive, 40 * part.transit, match(part.transit, part.transit, 40, 1e-6, at_most=1000))
    apart = np.abs(motion.drum_speed - motion.belt_speed)
    assert motion.slipped
    assert float(motion.drum_speed.max()) == 1.0
    assert apart.max() > 0.3
    assert apart[len(apart) // 4 :].max() < 1e-9
    assert motion.drum_speed[len(apart) // 4 :] == pytest.approx(1.0, abs=1e-9)
