"""Worked cases CH-01 ... CH-08, ST-01 and ST-02 of chain drives and of stopping, printed to six digits.

The cases carry numbers recovered from the lecture notes (N. Yu. Dorokhov, Kramatorsk 2007) or derived, each checked
before by an independent method; the tolerance is that of the printed digits unless the case states a wider one.
"""

import math

import numpy as np
import pytest
from support import chain_fem

from ptmcalc.laws import (
    belt_modes,
    chain_resonance,
    chain_start,
    chain_wear,
    equalising,
    inertia,
    polygon,
    sprocket,
    stopping,
    wave,
)
from ptmcalc.laws.loop_bounds import LoopMasses
from ptmcalc.numerics.harmonic.parts import Chain, Damping, Excitation, Line
from ptmcalc.numerics.harmonic.response import Peaks, polygon_response
from ptmcalc.numerics.loop import Strand
from ptmcalc.numerics.run_through import run_through

PRINTED = 6e-6
G = 9.81


class TestCH01:
    """Start: acceleration, reduced inertia, time, force."""

    RATIO, ETA, DIAMETER, ROTOR, MASS = 40.0, 0.9, 0.65, 0.35, 42000.0
    STARTING, STATIC, SPEED = 160.0, 90.0, 980 * math.pi / 30

    def test_start(self) -> None:
        radius = self.DIAMETER / 2
        whole = self.ROTOR + inertia.mass_on_motor_shaft(self.MASS, radius, 1.0, self.RATIO, self.ETA, "drive")
        acceleration = chain_start.start_acceleration(self.STARTING, self.STATIC, whole)
        assert (whole, acceleration, self.SPEED) == pytest.approx((3.43073, 20.4038, 102.625), rel=PRINTED)
        assert chain_start.start_time(self.STARTING, self.STATIC, whole, self.SPEED) == pytest.approx(
            5.02971, rel=PRINTED
        )
        force = chain_start.start_force(self.MASS, acceleration, radius, self.RATIO)
        assert force == pytest.approx(6962.81, rel=PRINTED)
        assert (acceleration * radius / self.RATIO, self.SPEED * radius / self.RATIO) == pytest.approx(
            (0.165781, 0.833831), rel=PRINTED
        )

    def test_masses_at_the_rim_give_the_same_force(self) -> None:
        """The efficiency goes with the rim force and with the reduced drive: the other way round as above."""
        radius = self.DIAMETER / 2
        drive = inertia.reduced_drive_mass(self.ROTOR, self.RATIO, self.ETA, 0.0, radius)
        rim = (self.STARTING - self.STATIC) * self.RATIO * self.ETA / radius
        assert rim * self.MASS / (drive + self.MASS) == pytest.approx(6962.81, rel=PRINTED)


class TestCH02:
    """Polygon kinematics of 8 teeth, 320 mm, at 0.5 m/s."""

    TEETH, PITCH, SPEED = 8, 0.32, 0.5

    def test_sprocket(self) -> None:
        omega = sprocket.sprocket_speed(self.SPEED, self.PITCH, self.TEETH)
        found = (sprocket.pitch_radius(self.PITCH, self.TEETH), omega, omega * 30 / math.pi)
        assert found == pytest.approx((0.4181, 1.22718, 11.7188), rel=3e-5)
        slowest, fastest = sprocket.speed_extremes(self.SPEED, self.TEETH)
        assert (fastest, slowest) == pytest.approx((0.513086, 0.47403), rel=PRINTED)
        assert sprocket.speed_ripple(self.TEETH, "mean") == pytest.approx(0.0781127, rel=PRINTED)
        assert math.pi**2 / (2 * self.TEETH**2) == pytest.approx(0.0771063, rel=PRINTED)  # as its docstring names it
        assert sprocket.engagement_speed(self.SPEED, self.TEETH, "translating") == pytest.approx(0.392699, rel=PRINTED)
        assert sprocket.engagement_speed(self.SPEED, self.TEETH, "guided") == pytest.approx(0.19635, rel=PRINTED)
        assert sprocket.transverse_speed(self.SPEED, self.TEETH) == pytest.approx(0.19635, rel=PRINTED)

    def test_acceleration(self) -> None:
        peak = float(polygon.peak_acceleration(self.SPEED, self.PITCH, self.TEETH))
        assert peak == pytest.approx(0.240957, rel=PRINTED)
        after, before = polygon.polygon_acceleration([0.5, 0.5 - 1e-12], self.SPEED, self.PITCH, self.TEETH)
        assert after - before == pytest.approx(0.481914, rel=PRINTED)
        found = polygon.acceleration_harmonics(np.arange(1.0, 5.0), self.SPEED, self.PITCH, self.TEETH)
        assert found == pytest.approx([-0.155833, 0.0769998, -0.0512216, 0.038387], rel=8e-6)


@pytest.mark.parametrize(
    ("length", "share", "mass", "force"),
    [
        (20.0, 2.0, 5600.0, 4048.08),
        (25.0, 2.0, 7000.0, 5060.1),
        (40.0, 1.5, 9600.0, 6939.57),
        (60.0, 1.0, 12000.0, 8674.46),
        (80.0, 1.0, 16000.0, 11565.9),
    ],
)
def test_ch03_textbook_polygon_force(length: float, share: float, mass: float, force: float) -> None:
    peak = float(polygon.peak_acceleration(0.5, 0.32, 8))
    assert polygon.return_share(length) == share
    swinging = polygon.textbook_mass(120.0, 80.0, length, share)
    assert swinging == pytest.approx(mass, rel=1e-12)
    assert polygon.textbook_polygon_force(swinging, peak) == pytest.approx(force, rel=PRINTED)


@pytest.mark.parametrize(("threshold", "percent"), [(25.0, -14.2857), (60.0, -16.6667)])
def test_ch03_jumps_of_the_table(threshold: float, percent: float) -> None:
    above, below = math.nextafter(threshold, 99.0), math.nextafter(threshold, 0.0)
    masses = [polygon.textbook_mass(120.0, 80.0, threshold, polygon.return_share(x)) for x in (below, above)]
    assert 100 * (masses[1] / masses[0] - 1) == pytest.approx(percent, rel=PRINTED)
    assert polygon.nearest_threshold(1.04 * threshold) == pytest.approx((threshold, 0.04))


def test_ch04_waves() -> None:
    stiffness = 1.2e11 * 0.0016
    assert stiffness == pytest.approx(1.92e8)
    assert wave.wave_speed(stiffness, 80.0) == pytest.approx(1549.19, rel=PRINTED)
    assert wave.wave_speed(stiffness, 200.0) == pytest.approx(979.796, rel=PRINTED)
    empty, loaded = (Strand(40.0, m, stiffness, 0.0, 0.0) for m in (80.0, 200.0))
    assert empty.transit + empty.transit == pytest.approx(0.0516398, rel=PRINTED)
    assert empty.transit + loaded.transit == pytest.approx(0.0666447, rel=PRINTED)


class TestCH05:
    """Resonance speeds, and the units of K."""

    STEEL, PITCH, LENGTH, SECTION = 2.06e11, 0.32, 40.0, 16e-4

    def test_of_a_uniform_strand(self) -> None:
        c = wave.wave_speed(self.STEEL * self.SECTION, 200.0)
        assert c == pytest.approx(1283.74, rel=PRINTED)
        quarter = math.pi * c / (2 * self.LENGTH) * np.array([1.0, 3.0, 5.0])
        found = chain_resonance.resonance_speeds(quarter, np.arange(1.0, 5.0), self.PITCH)
        assert found[0] == pytest.approx([2.56749, 7.70247, 12.8374], rel=PRINTED)
        assert found[:, 0] == pytest.approx([2.56749, 1.28374, 0.85583, 0.641872], rel=PRINTED)

    def test_of_two_strands(self) -> None:
        compliance = self.LENGTH / (self.STEEL * self.SECTION)
        loop = LoopMasses(
            80.0 * 40, 200.0 * 40, 0.0, 1.0, compliance, compliance, fixed_length=False, imposed_speed=True
        )
        w = belt_modes.natural_frequencies(loop, 0.0, 3)
        assert w[0] == pytest.approx(34.987, rel=PRINTED)
        assert w / (2 * math.pi) == pytest.approx([5.56835, 14.3844, 24.4429], rel=PRINTED)
        speeds = chain_resonance.resonance_speeds(w, np.ones(1), self.PITCH)[0]
        assert speeds == pytest.approx([1.78187, 4.603, 7.82173], rel=PRINTED)
        assert 2.56749 / speeds[0] - 1 == pytest.approx(0.44, abs=0.005)

    @pytest.mark.parametrize(("wave_", "factor"), [("quarter", 3553.92), ("half", 7107.85), ("full", 14215.7)])
    def test_factor_for_square_centimetres_and_newtons(self, wave_: str, factor: float) -> None:
        assert chain_resonance.textbook_resonance_factor(self.STEEL, G, wave_) == pytest.approx(factor, rel=PRINTED)

    @pytest.mark.parametrize(
        ("factor", "wave_", "gravity", "modulus"),
        [
            (3000.0, "quarter", G, 1.46789e11),
            (4000.0, "quarter", G, 2.60958e11),
            (3000.0, "half", G, 3.66972e10),
            (4000.0, "half", G, 6.52396e10),
            (3000.0, "full", 1.0, 9e10),  # q in kgf/m is the mass per length
            (4000.0, "full", 1.0, 1.6e11),
        ],
    )
    def test_modulus_behind_the_printed_range(self, factor: float, wave_: str, gravity: float, modulus: float) -> None:
        assert chain_resonance.textbook_resonance_modulus(factor, gravity, wave_) == pytest.approx(modulus, rel=PRINTED)

    @pytest.mark.parametrize(("factor", "speed"), [(3000.0, 2.16731), (4000.0, 2.88975), (3553.92, 2.56749)])
    def test_textbook_speed(self, factor: float, speed: float) -> None:
        found = chain_resonance.textbook_resonance_speed(factor, self.PITCH, self.LENGTH, self.SECTION, 200.0 * G)
        assert found == pytest.approx(speed, rel=PRINTED)


class TestCH06:
    """One strand under polygon excitation, in units of m a_max; printed from 3000 harmonics at sampled places.

    The smallest force lies in the corner of an engagement, where so few harmonics are up to 0.3 % short of their limit:
    -1.00609 is printed for -1.00305 at r = 0.05. Finite elements in time say the same as the limit.
    """

    ROWS = (
        (0.05, 2.39475, -1.00609), (0.1, 2.40838, -1.07547), (0.15, 2.19622, -1.04373), (0.2, 2.61729, -1.4281),
        (0.25, 2.75904, -1.64831), (0.3, 1.94044, -1.31815), (1 / 3, 3.0163, -2.04032), (0.4, 1.63329, -1.21226),
        (0.5, 3.56598, -2.86741), (0.6, 1.4022, -1.12477), (0.7, 1.30137, -1.15232), (0.8, 1.56895, -1.5039),
        (0.9, 2.60946, -2.53876), (1.0, 5.32063, -5.48959), (1.1, 2.10726, -2.02937), (1.25, 0.832997, -0.70699),
        (1.5, 0.378363, -0.359301), (2.0, 0.0429551, -0.217458), (2.5, 0.148411, -0.232493), (3.0, 0.209058, -0.33968),
        (4.0, 0.0722758, -0.185657), (6.0, 0.0602642, -0.143772),
    )  # fmt: skip
    DAMPED = (
        (0.01, (3.3239, 4.44892, 8.02837, 14.1131, 26.5787, 0.784182, 0.00963707)),
        (0.02, (2.72902, 3.15371, 4.74101, 7.52927, 13.285, 0.528303, 0.0180625)),
        (0.05, (2.39475, 2.40838, 2.75904, 3.56598, 5.32063, 0.378363, 0.0429551)),
        (0.1, (2.17198, 2.12926, 2.09617, 2.24042, 2.69128, 0.347538, 0.0869028)),
        (0.2, (1.88399, 1.84181, 1.72046, 1.57871, 1.43027, 0.368707, 0.161066)),
    )
    AT = (0.05, 0.1, 0.25, 0.5, 1.0, 1.5, 2.0)

    def peaks(self, ratios: tuple[float, ...], damping: Damping) -> Peaks:
        """Of a strand of mass 1, length 1 and wave speed 1, under an acceleration of amplitude 1."""
        frequencies = np.array(ratios) * math.pi / 2
        speed = 0.32 * math.sqrt(64 / (2 * math.pi**2 * 0.32))  # a_max = 1 for 8 teeth and 0.32 m
        b = polygon.acceleration_harmonics(np.arange(1.0, 4097.0), speed, 0.32, 8) / float(
            polygon.peak_acceleration(speed, 0.32, 8)
        )
        return polygon_response(Chain((Line(1.0, 1.0, 1.0),), damping), frequencies, Excitation(b))

    def kelvin_voigt(self, zeta: float) -> Damping:
        """Of this damping ratio in the first mode."""
        return Damping("kelvin_voigt", time=2 * zeta / (math.pi / 2))

    def test_over_the_speed(self) -> None:
        found = self.peaks(tuple(row[0] for row in self.ROWS), self.kelvin_voigt(0.05))
        assert found.largest == pytest.approx([row[1] for row in self.ROWS], rel=2e-5)
        assert found.smallest == pytest.approx([row[2] for row in self.ROWS], rel=4e-3)
        printed = np.array([row[1] for row in self.ROWS])
        assert np.all(found.largest_low - 1e-5 * printed <= printed)
        assert np.all(printed <= found.largest_high + 1e-5 * printed)

    @pytest.mark.parametrize("r", [0.05, 0.2, 1.0, 1.5, 2.0])
    def test_smallest_force_by_finite_elements(self, r: float) -> None:
        damping = self.kelvin_voigt(0.05)
        sprocket_ = chain_fem.Sprocket(1.0, 8, r / 4)  # r quarter waves of 1 m/s pass a strand of 1 m
        meshed = chain_fem.Chain((chain_fem.Strand(1.0, 1.0, 1.0),))
        force = chain_fem.periodic_force(
            meshed, sprocket_, damping.time, np.array([0.0, *np.linspace(0.9, 1.0, 41)]), 300
        )
        smallest = force.min() / (2 * (math.pi / 8 * r / 4) ** 2)
        found = self.peaks((r,), damping)
        assert float(found.smallest[0]) == pytest.approx(smallest, rel=1e-3)
        assert float(found.smallest_high[0] - found.smallest[0]) < 1e-6
        assert float(found.smallest_low[0]) < smallest

    @pytest.mark.parametrize(("zeta", "printed"), DAMPED)
    def test_over_the_damping(self, zeta: float, printed: tuple[float, ...]) -> None:
        assert self.peaks(self.AT, self.kelvin_voigt(zeta)).largest == pytest.approx(printed, rel=3e-5)

    def test_the_textbook_is_unsafe_in_resonance_and_far_off_above_it(self) -> None:
        """3 m a_max: exceeded at 1, 1/2 and 1/3 with 1 % of damping; 7 times too much at 1.5 with 5 %."""
        light = self.peaks((1.0, 0.5, 1 / 3), self.kelvin_voigt(0.01)).largest
        assert np.all(light > [26.0, 14.0, 9.9])
        above = float(self.peaks((1.5,), self.kelvin_voigt(0.05)).largest[0])
        assert 3 / above > 7

    def test_hysteretic_damping_spares_no_higher_mode(self) -> None:
        found = self.peaks((1.5, 3.0), Damping("hysteretic", share=0.02)).largest
        assert found == pytest.approx([1.84, 3.06], abs=0.01)

    def test_below_the_resonance_the_textbook_is_no_bound(self) -> None:
        found = self.peaks((0.05, 0.1), self.kelvin_voigt(0.01))
        assert np.all(found.largest > 3)
        assert np.all(found.bound >= found.largest_high)


def test_ch07_equalising_drive() -> None:
    teeth, pitch, speed = 6, 0.4, 0.8
    radius = sprocket.pitch_radius(pitch, teeth)
    assert (radius, pitch / speed) == pytest.approx((0.4, 0.5), rel=PRINTED)
    slowest, fastest = equalising.equalising_speed([0.0, 0.5], speed, pitch, teeth)
    assert (slowest, fastest) == pytest.approx((2.0, 2.3094), rel=PRINTED)
    assert equalising.equalising_ratio(teeth) == pytest.approx(1.1547, rel=PRINTED)
    assert sprocket.sprocket_speed(speed, pitch, teeth) == pytest.approx(2.0944, rel=PRINTED)
    assert equalising.equalising_acceleration(speed, pitch, teeth) == pytest.approx(3.0792, rel=PRINTED)
    assert float(polygon.peak_acceleration(speed, pitch, teeth)) == pytest.approx(0.877298, rel=PRINTED)
    assert abs(float(equalising.equalising_angle(0.5, teeth))) == pytest.approx(0.523599, rel=PRINTED)


def test_ch08_life() -> None:
    path = chain_wear.sprocket_path(0.03, 8)
    time = chain_wear.contact_time(0.32, 0.5)
    assert (path, time) == pytest.approx((0.011781, 0.64), rel=PRINTED)
    given = (np.array([60e3, 14e3]), np.array([8e3, 15e3]), np.full(2, path), np.full(2, time), np.full(2, 2.5e-12))
    wear = chain_wear.wear_per_revolution(*given, "sum")
    assert wear == pytest.approx(1.82841e-9, rel=PRINTED)
    allowed = chain_wear.allowed_growth(0.32, 0.04)
    assert allowed == pytest.approx(0.0128)
    assert float(chain_wear.chain_life(allowed, wear, 82.0, 0.5)) / 3600 == pytest.approx(318918.0, rel=PRINTED)
    mean = chain_wear.wear_per_revolution(*given, "mean")
    assert float(chain_wear.chain_life(allowed, mean, 82.0, 0.5)) / 3600 == pytest.approx(637835.0, rel=PRINTED)


def test_st01_backstop_of_a_chain_conveyor() -> None:
    load, strand, slope = 1500.0 / G, 800.0 / G, math.radians(20)
    force = stopping.rollback_force(60.0, slope, load, strand, 0.08, G)
    torque = stopping.backstop_torque(force, 0.65, 1.0)
    assert float(torque) == pytest.approx(5459.74, rel=PRINTED)
    assert float(stopping.torque_on_motor_shaft(torque, 40.0, 0.9)) == pytest.approx(122.844, rel=PRINTED)
    assert float(stopping.critical_coefficient(slope, load, strand)) == pytest.approx(0.176115, rel=PRINTED)
    held = math.atan(0.08 * (load + 2 * strand) / load)
    assert math.degrees(held) == pytest.approx(9.38798, rel=PRINTED)
    assert float(stopping.moving_resistance(60.0, slope, load, strand, 0.08, G)) == pytest.approx(44764.4, rel=PRINTED)


class TestST02:
    """Braking within 0.1 m, 12 degrees down and up."""

    LOAD, STRAND, LENGTH = 1500.0 / G, 800.0 / G, 60.0
    MASS = LENGTH * (LOAD + 2 * STRAND)

    @pytest.mark.parametrize(
        ("degrees", "resistance", "torque"), [(-12.0, -9615.28, 297.466), (12.0, 27808.8, 16.7554)]
    )
    def test_brake_torque(self, degrees: float, resistance: float, torque: float) -> None:
        slope = math.radians(degrees)
        w = float(stopping.moving_resistance(self.LENGTH, slope, self.LOAD, self.STRAND, 0.05, G))
        assert (self.MASS, w) == pytest.approx((18960.2, resistance), rel=PRINTED)
        found = stopping.brake_torque_for_distance(self.MASS, w, 0.5, 0.1, 0.65, 40.0, 0.9, 0.35, "signed")
        assert found == pytest.approx(torque, rel=PRINTED)
        assert stopping.stopping_distance(self.MASS, w, 0.5, found, 0.65, 40.0, 0.9, 0.35) == pytest.approx(
            0.1, rel=1e-12
        )

    def test_textbook_form_downhill(self) -> None:
        w = float(stopping.moving_resistance(self.LENGTH, math.radians(-12), self.LOAD, self.STRAND, 0.05, G))
        found = stopping.brake_torque_for_distance(self.MASS, w, 0.5, 0.1, 0.65, 40.0, 0.9, 0.0, "notes")
        assert found == pytest.approx(243.62, rel=PRINTED)

    def test_forces_in_the_chain(self) -> None:
        assert float(stopping.braking_force(self.MASS, 0.5, 0.1)) == pytest.approx(23700.3, rel=PRINTED)
        drop, rise = stopping.fixed_loop_braking(
            self.LENGTH * (self.LOAD + self.STRAND), self.LENGTH * self.STRAND, 1.25
        )
        assert sorted(map(abs, (drop, rise))) == pytest.approx([8983.18, 14717.1], rel=PRINTED)

    def test_coasting_uphill(self) -> None:
        distance, _ = stopping.coasting(self.MASS, 27808.8, 0.0, 0.5)
        assert distance == pytest.approx(0.0852258, rel=PRINTED)


class TestTwoWaysToOneForce:
    """The modes of two strands pass by pass in time, and the dynamic stiffness harmonic by harmonic."""

    PITCH, TEETH, STIFFNESS = 0.32, 8, 3.2e8
    LOOP = LoopMasses(80.0 * 40, 200.0 * 40, 900.0, 1.0, 40 / 3.2e8, 40 / 3.2e8, fixed_length=False, imposed_speed=True)

    @pytest.mark.parametrize("ratio", [0.37, 0.5, 1.0])
    def test_agree_with_what_the_higher_modes_do_at_once(self, ratio: float) -> None:
        w = belt_modes.natural_frequencies(self.LOOP, 0.0, 10)
        masses, _ = chain_resonance.modal_masses(self.LOOP, w)
        retardation = 2 * 0.06 / w[0]
        speed = ratio * w[0] * self.PITCH / (2 * math.pi)
        edges = self.PITCH / speed * np.arange(41)

        def acceleration(inside: np.ndarray) -> np.ndarray:
            return polygon.polygon_acceleration(inside * speed / self.PITCH - 0.5, speed, self.PITCH, self.TEETH)

        run = run_through(edges, acceleration, w, retardation * w / 2, 320)
        rest = self.LOOP.belt_mass - masses.sum()
        lines = (Line(40.0, 200.0, self.STIFFNESS), Line(40.0, 80.0, self.STIFFNESS))
        chain = Chain(lines, Damping("kelvin_voigt", time=retardation), joint_mass=900.0)
        b = polygon.acceleration_harmonics(np.arange(1.0, 1025.0), speed, self.PITCH, self.TEETH)
        peaks = polygon_response(chain, 2 * math.pi * speed / self.PITCH, Excitation(b))
        left_out = rest * float(polygon.peak_acceleration(speed, self.PITCH, self.TEETH))
        late = run.force(masses)[-1, :-1] + rest * acceleration(run.times[-1, :-1] - edges[-2])
        before = float(run.force(masses)[-1, 0]) - left_out  # where the acceleration has not jumped yet
        assert late.max() == pytest.approx(float(peaks.largest), abs=0.1 * left_out)
        assert min(before, late.min()) == pytest.approx(float(peaks.smallest), abs=0.1 * left_out)
        assert left_out < 0.05 * float(peaks.largest)
