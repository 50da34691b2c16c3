"""Worked cases of belt waves, printed to six digits.

The cases carry the numbers of the lecture notes' models as recovered and checked by independent methods (closed
form, characteristics, finite elements); the tolerance is that of the printed digits unless a comment says more.
"""

import numpy as np
import pytest
from support import echoes, fem
from support.machines import BW_02, changed, load_of, report_of, scene_of, spec_of

from ptmcalc.laws import loop_bounds, sag, wave
from ptmcalc.laws.loop_bounds import CARRY, RETURN, LoopMasses
from ptmcalc.machines.conveyor.machine.start_case import start_case
from ptmcalc.numerics import loop, strand

PRINTED = 1e-5
EA, RHO_CARRY, RHO_RETURN, LENGTH = 1.38e8, 245.0, 38.0, 1000.0
DRIVE_MASS, EXCESS = 45120.0, 155635.85


def numeric_loop(rigid: bool) -> loop.Loop:
    return loop.Loop(
        carry=loop.Strand(LENGTH, RHO_CARRY, EA, 0.0, 0.0),
        back=loop.Strand(LENGTH, RHO_RETURN, EA, 0.0, 0.0),
        drum_mass=DRIVE_MASS,
        tail_mass=0.0,
        fixed_length=rigid,
    )


def step(force: float) -> loop.Drive:
    return loop.Drive(force=lambda t: np.full_like(t, force))


class TestBW01:
    """Wave speeds, impedances, travel times, reflection at the tail."""

    def test_speeds_and_impedances(self) -> None:
        assert wave.wave_speed(EA, RHO_CARRY) == pytest.approx(750.510, rel=PRINTED)
        assert wave.wave_speed(EA, RHO_RETURN) == pytest.approx(1905.67, rel=PRINTED)
        assert wave.impedance(EA, RHO_CARRY) == pytest.approx(183875, rel=PRINTED)
        assert wave.impedance(EA, RHO_RETURN) == pytest.approx(72415.5, rel=PRINTED)

    def test_wave_speed_from_modulus_and_density_is_the_same(self) -> None:
        modulus, section = 2.0e9, 0.069
        density = RHO_CARRY / section
        assert np.sqrt(modulus / density) == pytest.approx(wave.wave_speed(EA, RHO_CARRY), rel=1e-9)

    def test_times(self) -> None:
        carry, back = LENGTH / wave.wave_speed(EA, RHO_CARRY), LENGTH / wave.wave_speed(EA, RHO_RETURN)
        assert (carry, back) == pytest.approx((1.33243, 0.52475), rel=PRINTED)
        assert 2 * carry == pytest.approx(2.66485, rel=PRINTED)
        assert wave.first_wave_time(carry, back) == pytest.approx(3.71435, rel=PRINTED)

    def test_reflection(self) -> None:
        z = wave.impedance(EA, RHO_CARRY), wave.impedance(EA, RHO_RETURN)
        r = wave.reflection(*z)
        assert r == pytest.approx(-0.434895, rel=PRINTED)
        assert 1 + r == pytest.approx(0.565105, rel=PRINTED)
        assert 4 * z[0] * z[1] / sum(z) ** 2 == pytest.approx(0.810866, rel=PRINTED)

    def test_echo_at_a_held_drum(self) -> None:
        """A drum pushed to v0 at once and held sends a front; its echo comes back as 2 r Z1 v0 on top of Z1 v0."""
        speed = 0.1
        loop_ = numeric_loop(rigid=False)
        grid = loop.match(loop_.carry.transit, loop_.back.transit, 100, 1e-6)
        motion = strand.march(loop_, loop.Drive(speed=lambda t: np.full_like(t, speed)), 3.0, grid)
        z, r = wave.impedance(EA, RHO_CARRY), -0.434895
        after_echo = np.searchsorted(motion.times, 2 * loop_.carry.transit + 0.05)
        before = np.searchsorted(motion.times, 1.0)
        assert motion.run_on[after_echo] - motion.run_on[before] == pytest.approx(2 * r * z * speed, rel=1e-5)
        assert 2 * r * z * speed == pytest.approx(-15993.3, rel=PRINTED)


class TestBW02:
    """Closed form of the textbook and the whole start, gravity take-up."""

    def test_machine(self) -> None:
        case = start_case(spec_of(BW_02), spec_of(BW_02).all_scenes[0])
        assert case.line.drive_mass == pytest.approx(45120.0, rel=1e-9)
        assert case.line.static_resistance == pytest.approx(187126, rel=PRINTED)
        assert case.available_force == pytest.approx(342762, rel=PRINTED)
        assert case.excess == pytest.approx(155636, rel=PRINTED)
        assert case.acceleration == pytest.approx(0.474326, rel=PRINTED)
        assert case.window == pytest.approx(8.43302, rel=PRINTED)

    @pytest.mark.parametrize(("time", "speed", "force"), [(0.2, 0.471781, 86748.6), (1.0, 0.832043, 152992)])
    def test_first_wave(self, time: float, speed: float, force: float) -> None:
        z = wave.impedance(EA, RHO_CARRY)
        assert wave.first_wave_speed(EXCESS, z, DRIVE_MASS, time) == pytest.approx(speed, rel=PRINTED)
        assert wave.first_wave_force(EXCESS, z, DRIVE_MASS, time) == pytest.approx(force, rel=PRINTED)

    def test_textbook_peak(self) -> None:
        peak = wave.first_wave_peak(EXCESS, wave.impedance(EA, RHO_CARRY), DRIVE_MASS, 3.71435)
        assert peak == pytest.approx(155636, rel=PRINTED)

    def test_characteristics_before_the_first_echo(self) -> None:
        grid = loop.match(numeric_loop(False).carry.transit, numeric_loop(False).back.transit, 400, 1e-6)
        motion = strand.march(numeric_loop(False), step(EXCESS), 2.5, grid)
        early = motion.times < 2.6
        exact = wave.first_wave_force(EXCESS, wave.impedance(EA, RHO_CARRY), DRIVE_MASS, motion.times)
        assert np.max(np.abs(motion.run_on - exact)[early]) < 1e-9 * EXCESS

    def test_whole_start_against_the_print_the_echo_series_and_finite_elements(self) -> None:
        scene = scene_of(report_of(changed(BW_02, accuracy="0.1 %")))
        load = load_of(scene, "tension_dynamic_run_on_max")
        assert load.estimate.value == pytest.approx(189504, rel=1e-5)
        assert load.at["time"] == pytest.approx(5.04436, abs=2e-3)
        assert load.formula is not None
        assert load.formula.value == pytest.approx(155636, rel=PRINTED)
        assert load.formula.ratio == pytest.approx(189504 / 155636, rel=2e-5)
        z = wave.impedance(EA, RHO_CARRY), wave.impedance(EA, RHO_RETURN)
        transit = LENGTH / wave.wave_speed(EA, RHO_CARRY), LENGTH / wave.wave_speed(EA, RHO_RETURN)
        series = echoes.run_on(EXCESS, z, DRIVE_MASS, transit, np.linspace(5.0, 5.1, 4001))
        assert load.estimate.low <= series.max() <= load.estimate.high
        belt = fem.Belt((LENGTH, LENGTH), (RHO_CARRY, RHO_RETURN), EA, DRIVE_MASS, 0.0, rigid_takeup=False)
        mesh = fem.step_response(belt, (500, 200), EXCESS, np.linspace(0, 8.43302, 3001))
        assert load.estimate.value == pytest.approx(mesh["run_on"].max(), rel=3e-3)

    def test_drum_speed_at_the_end(self) -> None:
        loop_ = numeric_loop(False)
        motion = strand.march(loop_, step(EXCESS), 8.43302, loop.match(1.33243, 0.52475, 400, 1e-6))
        assert motion.drum_speed[-1] == pytest.approx(4.39282, rel=1e-3)
        assert motion.drum_speed.max() == pytest.approx(4.39282, rel=1e-3)

    def test_smallest_tension_after_the_first_echo(self) -> None:
        loop_ = numeric_loop(False)
        motion = strand.march(
            loop_, step(EXCESS), 8.43302, loop.match(loop_.carry.transit, loop_.back.transit, 400, 1e-6)
        )
        late = motion.times > 2.67
        assert motion.run_on[late].min() == pytest.approx(59086.7, rel=1e-3)

    def test_reference_spec_names_every_load(self) -> None:
        scene = scene_of(report_of(BW_02))
        named = {load.info.name for load in scene.loads}
        assert named >= {
            "wave_speed_carry", "wave_speed_return", "impedance_carry", "impedance_return", "reduced_drive_mass",
            "static_resistance", "rim_force_excess", "first_wave_time_max", "tension_dynamic_run_on_max",
            "tension_run_on_max", "tension_run_off_min", "start_time_rigid", "acceleration_rigid",
        }  # fmt: skip


class TestBW03:
    """Uniform loop, gravity take-up: the exact two-interval law, characteristics and finite elements."""

    RHO, SPEED, TOTAL, MASS, FORCE = 100.0, 1200.0, 1200.0, 120000.0, 60000.0
    VALUES = ((1.0, 37927.2), (2.0, 51879.9), (2.5, 18683.1), (3.5, 18024.7))

    @property
    def stiffness(self) -> float:
        return self.RHO * self.SPEED**2

    def loop(self) -> loop.Loop:
        half = loop.Strand(self.TOTAL / 2, self.RHO, self.stiffness, 0.0, 0.0)
        return loop.Loop(half, half, self.MASS, 0.0, fixed_length=False)

    @pytest.mark.parametrize(("time", "printed"), VALUES)
    def test_two_interval_law(self, time: float, printed: float) -> None:
        tau = self.MASS / wave.impedance(self.stiffness, self.RHO)
        value = wave.two_interval_force(self.FORCE, 2 * self.TOTAL / self.SPEED, tau, time)
        assert value == pytest.approx(printed, rel=PRINTED)

    @pytest.mark.parametrize(("time", "printed"), VALUES)
    def test_characteristics(self, time: float, printed: float) -> None:
        motion = strand.march(self.loop(), step(self.FORCE), 4.0, loop.match(0.5, 0.5, 200, 1e-9))
        assert np.interp(time, motion.times, motion.run_on) == pytest.approx(printed, rel=2e-4)

    @pytest.mark.parametrize(("time", "printed"), VALUES)
    def test_finite_elements_agree(self, time: float, printed: float) -> None:
        belt = fem.Belt((600, 600), (self.RHO, self.RHO), self.stiffness, self.MASS, 0.0, rigid_takeup=False)
        value = fem.step_response(belt, (350, 350), self.FORCE, np.array([time]))["run_on"][0]
        assert value == pytest.approx(printed, rel=5e-3)

    def test_first_peak(self) -> None:
        peak, when = wave.two_interval_peak(self.FORCE, 2.0, 1.0, 4.0)
        assert (peak, when) == pytest.approx((51879.9, 2.0), rel=PRINTED)
        rigid = self.FORCE / 2
        assert peak / rigid == pytest.approx(1.72933, rel=PRINTED)
        assert peak / rigid == pytest.approx((1 + 1) / 1 * (1 - np.exp(-2)), rel=1e-12)

    def test_later_peaks_are_higher(self) -> None:
        motion = strand.march(self.loop(), step(self.FORCE), 40.0, loop.match(0.5, 0.5, 200, 1e-9))
        value, when = motion.largest(motion.run_on)
        assert value == pytest.approx(56842.7, rel=2e-4)
        assert when == pytest.approx(26.3, abs=0.02)
        assert motion.run_on.min() >= -1e-6 * self.FORCE


class TestBW05:
    """Rigid take-up: closed form before the first echo, characteristics and finite elements after it."""

    @pytest.mark.parametrize(("time", "on", "off"), [(0.3, 91328.1, -35967.7), (0.9, 110986, -43709.8)])
    def test_before_the_first_echo(self, time: float, on: float, off: float) -> None:
        z1, z2 = wave.impedance(EA, RHO_CARRY), wave.impedance(EA, RHO_RETURN)
        speed = float(wave.first_wave_speed(EXCESS, z1 + z2, DRIVE_MASS, time))
        assert (z1 * speed, -z2 * speed) == pytest.approx((on, off), rel=2e-4)
        loop_ = numeric_loop(rigid=True)
        motion = strand.march(loop_, step(EXCESS), 1.0, loop.match(loop_.carry.transit, loop_.back.transit, 200, 1e-6))
        assert np.interp(time, motion.times, motion.run_on) == pytest.approx(on, rel=2e-4)
        assert np.interp(time, motion.times, motion.run_off) == pytest.approx(off, rel=2e-4)

    def test_extremes_over_12_seconds(self) -> None:
        loop_ = numeric_loop(rigid=True)
        motion = strand.march(loop_, step(EXCESS), 12.0, loop.match(loop_.carry.transit, loop_.back.transit, 800, 1e-6))
        rise, rise_at = motion.largest(motion.run_on)
        drop, drop_at = motion.smallest(motion.run_off)
        assert (rise, drop) == pytest.approx((147283, -93073.8), rel=2e-4)
        assert (rise_at, drop_at) == pytest.approx((11.0221, 3.76755), abs=2e-3)  # flat extremes
        assert motion.run_off.mean() == pytest.approx(-42570.8, rel=0.15)

    def test_finite_elements_agree(self) -> None:
        loop_ = numeric_loop(rigid=True)
        motion = strand.march(loop_, step(EXCESS), 6.0, loop.match(loop_.carry.transit, loop_.back.transit, 400, 1e-6))
        belt = fem.Belt((LENGTH, LENGTH), (RHO_CARRY, RHO_RETURN), EA, DRIVE_MASS, 0.0, rigid_takeup=True)
        times = np.array([2.0, 4.0, 5.5])
        mesh = fem.step_response(belt, (500, 200), EXCESS, times)
        assert np.interp(times, motion.times, motion.drum_speed) == pytest.approx(mesh["drum_speed"], rel=5e-3)
        assert mesh["drum_speed"] == pytest.approx([0.654603, 1.59259, 2.99702], rel=5e-3)

    def test_quasi_static_split(self) -> None:
        masses = LoopMasses(
            38e3, 245e3, 0.0, DRIVE_MASS, LENGTH / EA, LENGTH / EA, fixed_length=True, imposed_speed=False
        )
        acceleration = EXCESS / masses.total_mass
        drop = acceleration * float(loop_bounds.quasi_static(masses, RETURN, 0.0))
        rise = acceleration * float(loop_bounds.quasi_static(masses, CARRY, 1.0))
        assert (drop, rise) == pytest.approx((-42570.8, 91663.5), rel=PRINTED)
        assert rise - drop == pytest.approx(134234, rel=PRINTED)

    def test_bounds_hold_and_are_close_to_the_sum_over_modes(self) -> None:
        """The sums over 1182 modes give a drop of 121.95 kN and a rise of 182.9 kN; the closed forms must not be
        below them and not much above."""
        masses = LoopMasses(
            38e3, 245e3, 0.0, DRIVE_MASS, LENGTH / EA, LENGTH / EA, fixed_length=True, imposed_speed=False
        )
        a = EXCESS / masses.total_mass
        drop = a * float(loop_bounds.stray(masses, RETURN, 0.0) - loop_bounds.quasi_static(masses, RETURN, 0.0))
        rise = a * float(loop_bounds.stray(masses, CARRY, 1.0) + loop_bounds.quasi_static(masses, CARRY, 1.0))
        assert 121.95e3 <= drop <= 1.15 * 121.95e3
        assert 182.9e3 <= rise <= 1.2 * 182.9e3


class TestBW12:
    """Sag and the moving belt."""

    CARRY_SPAN, RETURN_SPAN = 2256.3 * 1.2, 294.3 * 3.0

    @pytest.mark.parametrize(
        ("tension", "carry", "back", "speed", "sag_carry", "sag_return"),
        [
            (20e3, 10.5381, 1.12055, 220.947, 0.0169222, 0.00551813),
            (50e3, 0.674441, 0.0717151, 579.991, 0.0067689, 0.00220725),
            (100e3, 0.0843051, 0.00896439, 720.744, 0.00338445, 0.00110363),
        ],
    )
    def test_sag(
        self, tension: float, carry: float, back: float, speed: float, sag_carry: float, sag_return: float
    ) -> None:
        softening = float(sag.softening(EA, self.CARRY_SPAN, tension))
        assert softening == pytest.approx(carry, rel=PRINTED)
        assert sag.softening(EA, self.RETURN_SPAN, tension) == pytest.approx(back, rel=PRINTED)
        assert wave.wave_speed(EA / (1 + softening), RHO_CARRY) == pytest.approx(speed, rel=PRINTED)
        assert sag.sag_ratio(self.CARRY_SPAN, tension) == pytest.approx(sag_carry, rel=PRINTED)
        assert sag.sag_ratio(self.RETURN_SPAN, tension) == pytest.approx(sag_return, rel=PRINTED)

    def test_stiffness_by_finite_difference_of_the_chord(self) -> None:
        def stretch(tension: float) -> float:
            return tension / EA - self.CARRY_SPAN**2 / (24 * tension**2)

        h = 1.0
        by_difference = 2 * h / (stretch(50e3 + h) - stretch(50e3 - h))
        assert by_difference == pytest.approx(82415600, rel=1e-6)
        assert EA / (1 + float(sag.softening(EA, self.CARRY_SPAN, 50e3))) == pytest.approx(by_difference, rel=1e-6)

    def test_moving_belt_is_negligible(self) -> None:
        c1, c2, v = 750.510, 1905.67, 4.0
        still = 2 * LENGTH * (1 / c1 + 1 / c2)
        moving = LENGTH * (1 / (c1 - v) + 1 / (c1 + v) + 1 / (c2 - v) + 1 / (c2 + v))
        assert moving / still - 1 == pytest.approx(2.16251e-5, rel=1e-3)
