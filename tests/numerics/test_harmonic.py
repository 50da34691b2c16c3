"""Strands under periodic motion against finite elements in frequency and in time, closed forms, and finer runs.

The finite elements in the time domain know neither Fourier series nor complex moduli; those in the frequency domain
know no travelling wave.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support import chain_fem

from ptmcalc.numerics.harmonic.parts import Chain, Damping, Excitation, Line
from ptmcalc.numerics.harmonic.response import polygon_response
from ptmcalc.numerics.harmonic.waves import Waves, dynamic_stiffness, ratios_of

steady = settings(derandomize=True, database=None, deadline=None, max_examples=60)

WORKING, EMPTY = Line(40.0, 200.0, 3e8), Line(44.0, 80.0, 3e8)
DAMPINGS = {
    "kelvin_voigt": Damping("kelvin_voigt", time=2e-3),
    "hysteretic": Damping("hysteretic", share=0.04),
    "zener": Damping("zener", time=0.02, share=0.3),
}
LOSSLESS = Damping("kelvin_voigt")
CHAINS = [
    Chain((WORKING,), LOSSLESS),
    Chain((WORKING, EMPTY), LOSSLESS, joint_mass=900.0),
    Chain((WORKING, EMPTY), LOSSLESS, joint_mass=900.0, far_mass=1500.0),
    Chain((WORKING,), LOSSLESS, far_mass=4e4),
    Chain((WORKING,), LOSSLESS, far="held"),
    Chain((WORKING, EMPTY), LOSSLESS, far="held", joint_mass=900.0),
    Chain((WORKING, EMPTY), LOSSLESS, far="on_sprocket", joint_mass=900.0),
]
PITCH, TEETH = 0.32, 8


def modulus(damping: Damping, w: float) -> complex:
    """From the differential equations of spring and damper."""
    if damping.law == "kelvin_voigt":
        return 1 + 1j * w * damping.time
    if damping.law == "hysteretic":
        return complex(1, damping.share)
    return 1 + damping.share / (1 + 1 / (1j * w * damping.time))


def meshed(chain: Chain) -> chain_fem.Chain:
    strands = tuple(chain_fem.Strand(line.length, line.line_mass, line.stiffness) for line in chain.lines)
    return chain_fem.Chain(strands, chain.joint_mass, chain.far_mass, chain.drive_mass, chain.far)


def harmonics(speed: float, count: int, teeth: int = TEETH) -> np.ndarray:
    """Of the acceleration of a chain, by the integral of sin(phi) sin(2 pi n x)."""
    n, half = np.arange(1, count + 1), math.pi / teeth
    omega = 2 * half * speed / PITCH
    radius = PITCH / (2 * math.sin(half))
    turn = 2 * np.pi * n
    integral = 0.5 * (np.sin(half - turn / 2) / (2 * half - turn) - np.sin(half + turn / 2) / (2 * half + turn))
    return -(omega**2) * radius * 4 * integral


def first_frequency(chain: Chain) -> float:
    return float(chain_fem.modes(meshed(chain), 200)[0][0])


class TestOneFrequency:
    @pytest.mark.parametrize("drive", [math.inf, 9000.0])
    @pytest.mark.parametrize("law", DAMPINGS)
    @pytest.mark.parametrize("case", range(len(CHAINS)))
    def test_forces_are_those_of_finite_elements(self, case: int, law: str, drive: float) -> None:
        """Both ends moved with a phase, through a series of one harmonic: largest force and its place."""
        chain = replace(CHAINS[case], damping=DAMPINGS[law], drive_mass=drive)
        moved = chain.far != "free" or chain.far_mass > 0
        for w in (3.0, 61.0, 140.0):
            near, far = Excitation(np.array([0.7, 0.0])), Excitation(np.array([0.4, 0.0]), place=0.3)
            u = [-0.7 / w**2 + 0j, -0.4 / w**2 * np.exp(-2j * np.pi * 0.3)]
            expected = chain_fem.forces(meshed(chain), modulus(chain.damping, w), w, u[0], u[1] if moved else 0.0)
            for end in (0, 1) if moved else (0,):
                peaks = polygon_response(chain, w, near, far if moved else None, at_far_end=bool(end))
                size = abs(expected[end])
                assert float(peaks.largest) == pytest.approx(size, rel=2e-4)
                assert float(peaks.smallest) == pytest.approx(-size, rel=2e-4)
                place = (math.pi / 2 - np.angle(expected[end])) / (2 * math.pi)
                away = float(peaks.largest_place) - place
                assert abs(away - round(away)) < 1e-4
                assert float(peaks.bound) == pytest.approx(size, rel=2e-4) or moved
                assert float(peaks.largest_high - peaks.largest_low) < 1e-4 * size

    @pytest.mark.parametrize("law", DAMPINGS)
    @pytest.mark.parametrize("case", range(len(CHAINS)))
    def test_dynamic_stiffness(self, case: int, law: str) -> None:
        chain = replace(CHAINS[case], damping=DAMPINGS[law])
        for w in (0.5, 17.0, 83.0):
            ends = (1.0, 1.0 if chain.far == "on_sprocket" else 0.0)
            expected = chain_fem.forces(meshed(chain), modulus(chain.damping, w), w, *ends)[0]
            assert complex(dynamic_stiffness(chain, w)) == pytest.approx(expected, rel=2e-4)

    def test_closed_form_of_one_strand(self) -> None:
        w = np.array([1e-6, 0.3, 20.0, 70.0])
        theta, z = w * WORKING.transit, w * WORKING.impedance
        assert dynamic_stiffness(CHAINS[0], w) == pytest.approx(-z * np.tan(theta), rel=1e-13)
        assert dynamic_stiffness(CHAINS[4], w) == pytest.approx(z / np.tan(theta), rel=1e-12)

    @pytest.mark.parametrize("far", ["free", "held"])
    def test_two_strands_of_one_kind_are_one(self, far: str) -> None:
        """Where they meet there is no mass, if none is named."""
        whole = Chain((Line(100.0, 200.0, 3e8),), DAMPINGS["hysteretic"], far)
        parts = Chain((Line(60.0, 200.0, 3e8), Line(40.0, 200.0, 3e8)), DAMPINGS["hysteretic"], far)
        w = np.array([0.3, 20.0, 70.0, 500.0])
        assert dynamic_stiffness(parts, w) == pytest.approx(dynamic_stiffness(whole, w), rel=1e-11, abs=0)

    @pytest.mark.parametrize("drive", [math.inf, 9000.0, 1.0, 1e-3])
    @pytest.mark.parametrize("case", range(6))
    def test_a_denominator_is_no_larger_than_what_it_adds_up(self, case: int, drive: float) -> None:
        """Told in units of the rounding of all its parts, be the drive ever so light."""
        chain = replace(CHAINS[case], damping=DAMPINGS["hysteretic"], drive_mass=drive)
        w = np.geomspace(0.1, 500.0, 40)
        waves = Waves(chain, w)
        share = ratios_of(chain, waves, w).sound * np.finfo(float).eps * (1 + waves.angle)
        assert share.max() <= 1 + 1e-9

    def test_slow_motion_moves_the_whole_mass(self) -> None:
        """k h down to 1e-12: a rigid body, a static spring, without loss of digits."""
        for w in (1e-4, 1e-7, 1e-10):
            whole = 200.0 * 40 + 80.0 * 44 + 900.0
            assert complex(dynamic_stiffness(CHAINS[1], w)) == pytest.approx(-whole * w**2, rel=1e-9, abs=0)
            spring = 1 / (40 / 3e8 + 44 / 3e8)
            assert complex(dynamic_stiffness(CHAINS[5], w)) == pytest.approx(spring, rel=1e-9, abs=0)
            moved = self.quasi_static_ring(CHAINS[6])
            assert complex(dynamic_stiffness(CHAINS[6], w)) == pytest.approx(-moved * w**2, rel=1e-9, abs=0)

    def test_a_drive_that_gives_way_moves_the_ring_as_a_whole(self) -> None:
        """Both runs excited alike, so slowly that nothing stretches: the drive takes its share of the acceleration."""
        ring, push = replace(CHAINS[6], drive_mass=5e3), Excitation(np.array([1.0, 0.0]))
        whole = 200.0 * 40 + 80.0 * 44 + 900.0
        expected = self.quasi_static_ring(ring) * 5e3 / (whole + 5e3)
        for w in (0.3, 0.03, 0.003):
            found = polygon_response(ring, w, push, push)
            assert float(found.largest) == pytest.approx(expected, rel=1e-2 * w)

    @staticmethod
    def quasi_static_ring(ring: Chain) -> float:
        """Tension at the run-on per acceleration of a loop of fixed length: what pulls evens out over the stretch."""
        one, two = ring.lines
        masses = [line.length * line.line_mass for line in (one, two)]
        soft = np.array([line.length / line.stiffness for line in (one, two)])
        behind = np.array([masses[1] + ring.joint_mass + masses[0] / 2, masses[1] / 2])
        run_off = -(behind @ soft) / soft.sum()
        return float(run_off + sum(masses) + ring.joint_mass)

    @pytest.mark.parametrize("law", DAMPINGS)
    def test_many_waves_fade_without_overflow(self, law: str) -> None:
        """From so many waves on a damped strand is endless: i z."""
        line = Line(1e7, 200.0, 3e8)
        w = 300.0
        root = np.sqrt(modulus(DAMPINGS[law], w))
        found = complex(dynamic_stiffness(Chain((line, line), DAMPINGS[law], joint_mass=0.0), w))
        assert found == pytest.approx(1j * w * line.impedance * root, rel=1e-9)


class TestPeriodicRegime:
    RATIOS = (0.05, 0.1, 0.2, 0.25, 1 / 3, 0.4, 0.5, 0.7, 0.9, 1.0, 1.1, 1.5, 2.0, 3.0)

    @pytest.mark.parametrize("zeta", [0.01, 0.05])
    def test_one_strand_from_a_twentieth_to_three_times_the_first_frequency(self, zeta: float) -> None:
        chain = Chain((WORKING,), LOSSLESS)
        self.compare(chain, zeta, self.RATIOS, 200)

    @pytest.mark.parametrize("joint", [0.0, 2500.0])
    def test_two_strands_and_a_tail(self, joint: float) -> None:
        chain = Chain((WORKING, EMPTY), LOSSLESS, joint_mass=joint)
        self.compare(chain, 0.03, (0.05, 0.21, 0.5, 1.0, 1.4, 2.3, 3.0), 120)

    def compare(self, chain: Chain, zeta: float, ratios: tuple[float, ...], pieces: int) -> None:
        """To 0.5 % of both peaks."""
        w1 = first_frequency(chain)
        damped = replace(chain, damping=Damping("kelvin_voigt", time=2 * zeta / w1))
        places = np.linspace(0.0, 1.0, 1001)
        speeds = np.array([r * w1 * PITCH / (2 * math.pi) for r in ratios])
        acceleration = np.array([harmonics(v, 1024) for v in speeds])
        peaks = polygon_response(damped, 2 * math.pi * speeds / PITCH, Excitation(acceleration))
        for k, speed in enumerate(speeds):
            sprocket = chain_fem.Sprocket(PITCH, TEETH, float(speed))
            force = chain_fem.periodic_force(meshed(chain), sprocket, damped.damping.time, places, pieces)
            assert peaks.largest[k] == pytest.approx(force.max(), rel=5e-3)
            assert peaks.smallest[k] == pytest.approx(force.min(), rel=5e-3)
            assert peaks.largest_low[k] <= peaks.largest[k] <= peaks.largest_high[k] <= peaks.bound[k] * (1 + 1e-12)
            assert -peaks.bound[k] * (1 + 1e-12) <= peaks.smallest_low[k] <= peaks.smallest_high[k]

    def test_a_sweep_gives_what_single_speeds_give(self) -> None:
        chain = Chain((WORKING, EMPTY), DAMPINGS["hysteretic"], joint_mass=900.0, drive_mass=9e3)
        speeds = np.linspace(0.1, 4.0, 200)
        acceleration = np.array([harmonics(v, 256) for v in speeds])
        w = 2 * math.pi * speeds / PITCH
        sweep = polygon_response(chain, w, Excitation(acceleration))
        assert sweep.largest.shape == (200,)
        for k in (0, 16, 77, 199):
            one = polygon_response(chain, float(w[k]), Excitation(acceleration[k]))
            assert one.largest.shape == ()
            for field in ("largest", "largest_place", "largest_low", "largest_high", "smallest", "bound"):
                assert float(getattr(one, field)) == pytest.approx(getattr(sweep, field)[k], rel=1e-12, abs=1e-12)


class TestErrorsAreBounds:
    """A run with few harmonics lies as near to one with many as it says."""

    @pytest.mark.parametrize("law", ["kelvin_voigt", "hysteretic", "zener"])
    @pytest.mark.parametrize("far", ["free", "driven", "held", "on_sprocket"])
    @pytest.mark.parametrize("strands", [1, 2])
    def test_of_random_chains(self, law: str, far: str, strands: int) -> None:
        rng = np.random.default_rng(hash_of(law, far, strands))
        told = np.zeros(2, int)
        for k in range(12):
            lines = tuple(Line(*(10 ** rng.uniform([1, 1.5, 7.5], [2, 2.5, 8.5])).tolist()) for _ in range(strands))
            transit = sum(line.transit for line in lines)
            zeta = 10 ** rng.uniform(-2, -0.5)
            damping = {
                "kelvin_voigt": Damping(law, time=zeta * transit),
                "hysteretic": Damping(law, share=2 * zeta),
                "zener": Damping(law, time=transit * 10 ** rng.uniform(-1, 1), share=10 ** rng.uniform(-1, 1)),
            }[law]
            drive = float(rng.choice([math.inf, 10 ** rng.uniform(2, 5)]))
            joint = float(rng.choice([0.0, 10 ** rng.uniform(1, 4)]))
            end = 10 ** rng.uniform(2, 5) if far == "driven" else 0.0
            chain = Chain(lines, damping, far.replace("driven", "free"), joint, end, drive)
            speed = rng.uniform(0.1, 3.0) * PITCH / (4 * transit)
            w = 2 * math.pi * speed / PITCH
            counts = (127 + k % 2, 8192)
            moved = [Excitation(harmonics(speed, count), place=0.37) for count in counts]
            near = [Excitation(harmonics(speed, count, 6)) for count in counts]
            far_end = far != "free" and bool(rng.integers(2))
            few, many = (
                polygon_response(chain, w, a, b if far != "free" else None, at_far_end=far_end)
                for a, b in zip(near, moved, strict=True)
            )
            assert few.largest_low <= many.largest_high
            assert many.largest_low <= few.largest_high
            assert few.smallest_low <= many.smallest_high
            assert few.largest_low <= many.largest <= few.largest_high
            assert few.smallest_low <= many.smallest <= few.smallest_high
            assert many.largest <= few.bound
            told += np.isfinite([few.largest_high, many.largest_high])
        assert told[0] >= 8
        assert told[1] >= 11

    @pytest.mark.parametrize("at_far_end", [False, True])
    @pytest.mark.parametrize("law", DAMPINGS)
    def test_the_corner_of_an_engagement_does_not_depend_on_the_last_harmonic(self, law: str, at_far_end: bool) -> None:
        """Even or odd: the smallest force at the run-on, or the largest at a held far end whose motion alone acts."""
        chain = replace(CHAINS[5], damping=DAMPINGS[law])
        w, values = 25.0, []
        for count in (100, 101, 3000):
            b, nothing = harmonics(1.3, count), np.zeros(count)
            if at_far_end:
                peaks = polygon_response(chain, w, Excitation(nothing), Excitation(b), at_far_end=True)
                values.append(float(peaks.largest))
            else:
                values.append(float(polygon_response(chain, w, Excitation(b)).smallest))
        left = 4e-4 if law == "zener" else 1e-4  # its echoes never fade, each has a corner of its own
        assert values[:2] == pytest.approx([values[2]] * 2, rel=left)
        assert (values[2] > 0) == at_far_end

    def test_a_summit_between_two_samples_is_not_overlooked(self) -> None:
        """A few high harmonics have many summits nearly as high; the highest need not lie beside the highest sample."""
        rng = np.random.default_rng(5)
        chain = Chain((Line(1.0, 1.0, 1.0),), Damping("hysteretic", share=0.02))
        x, overlooked = np.arange(2**16) / 2**16, 0
        for _ in range(40):
            b = np.zeros(250)
            orders = rng.choice(np.arange(200, 250), 4, replace=False)
            b[orders - 1] = orders**2 * rng.uniform(0.5, 1.0, 4)
            b[-1] = 0.0
            w = float(rng.uniform(0.5, 1.5))
            spectrum = np.zeros(2**15 + 1, complex)
            for n in orders[orders < 250]:
                spectrum[n] = complex(dynamic_stiffness(chain, n * w)) * -b[n - 1] / (n * w) ** 2 * -1j * 2**15
            force = np.fft.irfft(spectrum, len(x))
            peaks = polygon_response(chain, w, Excitation(b))
            assert peaks.largest_low <= force.max() * (1 + 1e-4)  # of the samples taken here
            assert force.max() <= peaks.largest_high
            overlooked += force.max() > float(peaks.largest) * (1 + 1e-9)
        assert overlooked > 0  # or the case would not try what it is for

    @pytest.mark.parametrize("zeta", [0.005, 0.05])
    def test_a_thousand_harmonics_are_enough(self, zeta: float) -> None:
        ratios = np.array([0.02, 0.05, 0.1, 0.3, 1.0, 1.5, 3.0])
        chain = Chain((Line(1.0, 1.0, 1.0),), Damping("kelvin_voigt", time=2 * zeta / (math.pi / 2)))
        peaks = polygon_response(chain, ratios * math.pi / 2, Excitation(harmonics(1.0, 1024)))
        assert np.all(peaks.largest_high - peaks.largest_low < 6e-3 * peaks.largest)

    @pytest.mark.parametrize("r", [0.07, 0.5, 1.0, 1.7])
    def test_the_largest_is_the_largest_sample_of_a_fine_grid(self, r: float) -> None:
        chain = replace(CHAINS[1], damping=DAMPINGS["kelvin_voigt"])
        w1 = first_frequency(CHAINS[1])
        speed = r * w1 * PITCH / (2 * math.pi)
        w, count = r * w1, 64
        b = harmonics(speed, count)
        terms = np.array(
            [complex(dynamic_stiffness(chain, n * w)) * -b[n - 1] / (n * w) ** 2 for n in range(1, count + 1)]
        )
        x = np.arange(40000) / 40000
        force = np.zeros(len(x))
        for n in range(1, count + 1):
            force += np.imag(terms[n - 1] * np.exp(2j * np.pi * n * x))
        peaks = polygon_response(chain, w, Excitation(b))
        assert float(peaks.largest) == pytest.approx(force.max(), rel=1e-6)
        assert float(peaks.largest) >= force.max() - 1e-12 * abs(force.max())
        assert float(peaks.largest_high) >= force.max()
        assert np.abs(terms).sum() <= float(peaks.bound)


def hash_of(*parts: object) -> int:
    return sum(ord(c) * 31**k for k, c in enumerate("".join(map(str, parts)))) % 2**32


class TestWithoutDamping:
    @pytest.mark.parametrize("ratio", [1.0, 1 / 2, 1 / 3, 1 / 5, 3.0, 1.5, 0.05])
    def test_a_resonance_is_unbounded(self, ratio: float) -> None:
        """n f_z = (2 k - 1) f_1 for some tooth harmonic."""
        chain = Chain((Line(1.0, 1.0, 1.0),), LOSSLESS)
        w = ratio * math.pi / 2
        peaks = polygon_response(chain, w, Excitation(harmonics(1.0, 64)))
        assert float(peaks.largest) == math.inf
        assert float(peaks.smallest) == -math.inf
        assert float(peaks.bound) == math.inf
        assert (float(peaks.largest_low), float(peaks.largest_high)) == (math.inf, math.inf)
        assert (float(peaks.smallest_low), float(peaks.smallest_high)) == (-math.inf, -math.inf)
        assert (float(peaks.largest_place), float(peaks.smallest_place)) == (0.0, 0.0)
        if ratio == 1.0:
            assert dynamic_stiffness(chain, w) == math.inf

    def test_a_harmonic_without_amplitude_excites_nothing(self) -> None:
        chain = Chain((Line(1.0, 1.0, 1.0),), LOSSLESS)
        b = np.array([0.3, 0.0, 0.0])
        peaks = polygon_response(chain, math.pi / 6, Excitation(b))  # the third meets the first mode
        assert float(peaks.largest) == pytest.approx(0.3 * math.tan(math.pi / 6) / (math.pi / 6), rel=1e-12)
        assert float(peaks.largest_high) == pytest.approx(float(peaks.largest), rel=1e-3)

    @pytest.mark.parametrize("ratio", [2.0, 4.0, 6.0])
    def test_quiet_speeds(self, ratio: float) -> None:
        """T_tooth is an integer part of 2 L/c: the echoes cancel. What lies behind the last harmonic has no bound."""
        chain = Chain((Line(1.0, 1.0, 1.0),), LOSSLESS)
        peaks = polygon_response(chain, ratio * math.pi / 2, Excitation(harmonics(1.0, 64)))
        assert abs(float(peaks.largest)) < 1e-13
        assert float(peaks.largest_high) == math.inf

    def test_damping_too_light_for_the_digits_counts_as_none(self) -> None:
        chain = Chain((Line(1.0, 1.0, 1.0),), Damping("kelvin_voigt", time=1e-18))
        assert float(polygon_response(chain, math.pi / 2, Excitation(harmonics(1.0, 8))).largest) == math.inf

    def test_near_a_resonance_the_first_mode_leads(self) -> None:
        """8/pi^2 of the mass on 1 - r^2, to what the other modes add; down to 1e-9 from it."""
        chain = Chain((Line(1.0, 1.0, 1.0),), LOSSLESS)
        for off in (1e-3, 1e-6, 1e-9):
            w = math.pi / 2 * (1 - off)
            peaks = polygon_response(chain, w, Excitation(np.array([1.0, 0.0])))
            assert float(peaks.largest) == pytest.approx(8 / math.pi**2 / (2 * off), rel=5 * off + 1e-6)
            assert float(peaks.largest_low) <= float(peaks.largest) <= float(peaks.largest_high)


class TestAtResonance:
    @pytest.mark.parametrize("n", [1, 2, 3])
    def test_height_falls_with_the_damping(self, n: int) -> None:
        """(2/(pi n)) (8/pi^2)/(2 zeta) m a_max, from 1e-2 to 1e-8."""
        line = Line(1.0, 1.0, 1.0)
        w1, count = math.pi / 2, 64
        speed = w1 / n * PITCH / (2 * math.pi)
        a_max = 2 * (math.pi * speed / TEETH) ** 2 / PITCH
        for zeta in (1e-4, 1e-6, 1e-8):
            chain = Chain((line,), Damping("hysteretic", share=2 * zeta))
            peaks = polygon_response(chain, w1 / n, Excitation(harmonics(speed, count)))
            one_term = 2 / (math.pi * n) * 8 / math.pi**2 / (2 * zeta) * a_max / (1 - 1 / (n * TEETH) ** 2)
            # all odd multiples of n meet a mode: their sum, weighted with 1/(j (2 k - 1)^2) = 1/j^3
            terms = range(1, count // n + 1, 2)
            assert float(peaks.bound) >= one_term
            assert float(peaks.largest) == pytest.approx(one_term, rel=0.1)
            assert float(peaks.largest) <= one_term * sum(1 / j**3 for j in terms) * 1.02

    @given(st.floats(-9.0, -1.0), st.floats(0.02, 5.0))
    @steady
    def test_no_warning_and_no_nan_anywhere(self, damping: float, r: float) -> None:
        chain = Chain(
            (Line(1.0, 1.0, 1.0), Line(1.0, 0.3, 1.0)), Damping("kelvin_voigt", time=10**damping), joint_mass=0.2
        )
        peaks = polygon_response(chain, r, Excitation(harmonics(r, 32)))
        for field in ("largest", "largest_low", "largest_high", "smallest", "smallest_low", "smallest_high", "bound"):
            assert not np.isnan(getattr(peaks, field))
        assert peaks.largest_low <= peaks.largest <= peaks.largest_high


class TestExtremes:
    @pytest.mark.parametrize("teeth", [3, 10**6])
    @pytest.mark.parametrize("scale", [1e-9, 1.0, 1e9])
    def test_sizes_do_not_matter(self, teeth: int, scale: float) -> None:
        """Length and time in other units give the same force over m a_max."""
        line = Line(scale, 1.0, 1.0)
        chain = Chain((line,), Damping("kelvin_voigt", time=0.05 * scale))
        unit = polygon_response(
            Chain((Line(1.0, 1.0, 1.0),), Damping("kelvin_voigt", time=0.05)),
            0.9,
            Excitation(harmonics(1.0, 32, teeth)),
        )
        scaled = polygon_response(chain, 0.9 / scale, Excitation(harmonics(1.0, 32, teeth) / scale))
        assert float(scaled.largest) == pytest.approx(float(unit.largest), rel=1e-9)
        assert float(scaled.largest_high) == pytest.approx(float(unit.largest_high), rel=1e-9)

    def test_a_light_drive_gives_way(self) -> None:
        """Hardly any mass at the rim: the force falls with it to m_d times the acceleration."""
        b = np.array([1.0, 0.0])
        chain = Chain((WORKING,), DAMPINGS["kelvin_voigt"], drive_mass=1e-3)
        assert float(polygon_response(chain, 5.0, Excitation(b)).largest) == pytest.approx(1e-3, rel=1e-3)

    def test_what_is_refused(self) -> None:
        with pytest.raises(ValueError, match="no damping is called"):
            Damping("viscous")
        with pytest.raises(ValueError, match="neither its time nor its share"):
            Damping("zener", time=-1.0)
        with pytest.raises(ValueError, match="one or two strands"):
            Chain((), LOSSLESS)
        with pytest.raises(ValueError, match="no end is called"):
            Chain((WORKING,), LOSSLESS, far="loose")
        push = Excitation(np.ones(2))
        for far, at_far_end in ((push, False), (None, True)):
            with pytest.raises(ValueError, match="a free end without mass"):
                polygon_response(CHAINS[0], 1.0, push, far, at_far_end=at_far_end)
        with pytest.raises(ValueError, match="the same number of harmonics"):
            polygon_response(CHAINS[5], 1.0, push, Excitation(np.ones(3)))


def test_what_is_not_told_of_a_chain_is_not_there() -> None:
    w = np.array([0.3, 70.0])
    for law in DAMPINGS:
        assert Damping(law).modulus(w).tolist() == [1.0, 1.0]
    assert Damping("kelvin_voigt", share=0.04).modulus(w).tolist() == [1.0, 1.0]
    assert Damping("zener", share=0.04).modulus(w).tolist() == [1.0, 1.0]
    assert Damping("zener", time=2e-3).modulus(w).tolist() == [1.0, 1.0]
    bare = Chain((WORKING, EMPTY), DAMPINGS["hysteretic"])
    told = Chain((WORKING, EMPTY), DAMPINGS["hysteretic"], "free", 0.0, 0.0, math.inf)
    assert bare == told
    assert Excitation(np.ones(2)).place == 0.0
