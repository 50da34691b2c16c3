"""The laws far outside a machine's numbers: twenty-four decades, zeros, huge exponents, tiny differences.

Warnings are errors in this suite, so a silent overflow or 0/0 fails a test by itself. Digits are checked against
rational and decimal arithmetic of the standard library (60 digits), written from the physics and not from the code.
"""

import math
from collections.abc import Callable
from dataclasses import astuple, replace
from decimal import Decimal, getcontext, localcontext
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from ptmcalc.laws import capstan, inertia, loop_bounds, motor, resistance, sag, start_profile, wave
from ptmcalc.laws.loop_bounds import CARRY, RETURN, LoopMasses

DIGITS = 60
PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494")
DECADES = (-12.0, 12.0)


def precise(compute: Callable[[], Decimal]) -> float:
    """A number computed with 60 digits and rounded once."""
    with localcontext() as context:
        context.prec = DIGITS
        context.Emin, context.Emax = -9999, 9999
        return float(compute())


def test_the_decimal_witness_has_its_digits() -> None:
    assert precise(lambda: Decimal(1).exp()) == math.e
    assert float(PI) == math.pi
    assert getcontext().prec < DIGITS  # only inside `precise`


def sine(angle: Decimal) -> Decimal:
    """Taylor series, for angles up to pi."""
    term = total = angle
    for k in range(1, 60):
        term *= -angle * angle / ((2 * k) * (2 * k + 1))
        total += term
    return total


# --- every law over twenty-four decades -------------------------------------------------------------------------


class Draw:
    """Random positive numbers, their decades spread evenly."""

    def __init__(self, seed: int, decades: tuple[float, float] = DECADES) -> None:
        self.rng, self.decades = np.random.default_rng(seed), decades

    def positive(self, count: int) -> list[float]:
        return [float(x) for x in 10 ** self.rng.uniform(*self.decades, count)]

    def share(self) -> float:
        """Between 0 and 1, both ends among them."""
        return float(self.rng.choice([0.0, 1.0, *self.rng.uniform(0, 1, 4)]))

    def loop(self, fixed_length: bool, imposed_speed: bool) -> LoopMasses:
        return LoopMasses(*self.positive(6), fixed_length=fixed_length, imposed_speed=imposed_speed)

    def shape(self, *among: str) -> str:
        return str(self.rng.choice(among))


def two_interval(draw: Draw) -> tuple[float, float, float, float]:
    force, contour, tau = draw.positive(3)
    return force, contour, tau, 2 * contour * draw.share()


def in_loop(fixed_length: bool) -> Callable[[Draw], tuple[LoopMasses, int, float]]:
    def arguments(draw: Draw) -> tuple[LoopMasses, int, float]:
        loop = draw.loop(fixed_length, bool(draw.rng.integers(2)))
        return loop, int(draw.rng.integers(2)), draw.share()

    return arguments


def whole_loop(fixed_length: bool) -> Callable[[Draw], tuple[LoopMasses]]:
    return lambda draw: in_loop(fixed_length)(draw)[:1]


def phase_numbers(shape: str, imposed_speed: bool, rise_time: float, frequency: float) -> list[tuple[float, ...]]:
    return [astuple(phase) for phase in start_profile.phases(shape, imposed_speed, rise_time, frequency)]


FINITE: dict[str, tuple[Callable[..., Any], Callable[[Draw], tuple[Any, ...]]]] = {
    "reduced_drive_mass": (inertia.reduced_drive_mass, lambda d: tuple(d.positive(5))),
    "mean_starting_torque": (motor.mean_starting_torque, lambda d: tuple(d.positive(2))),
    "rim_force": (motor.rim_force, lambda d: tuple(d.positive(4))),
    "main_resistance": (resistance.main_resistance_per_length, lambda d: tuple(d.positive(5))),
    "length_factor": (resistance.length_factor, lambda d: (80 * max(d.positive(1)[0], 1.0),)),
    "sag_ratio": (sag.sag_ratio, lambda d: tuple(d.positive(2))),
    "tension_at_sag": (sag.tension_at_sag, lambda d: tuple(d.positive(2))),
    "softening": (sag.softening, lambda d: tuple(d.positive(3))),
    "rise": (start_profile.rise, lambda d: (d.shape("step", "ramp", "cosine"), *d.positive(2))),
    "rise_integral": (start_profile.rise_integral, lambda d: (d.shape("step", "ramp", "cosine"), *d.positive(2))),
    "rise_rate": (start_profile.rise_rate, lambda d: (d.shape("ramp", "cosine"), *d.positive(2))),
    "peak_rate": (start_profile.peak_rate, lambda d: (d.shape("ramp", "cosine"), *d.positive(1))),
    "phases_torque": (phase_numbers, lambda d: (d.shape("step", "ramp", "cosine"), False, *d.positive(2))),
    "phases_speed": (phase_numbers, lambda d: (d.shape("ramp", "cosine"), True, *d.positive(2))),
    "wave_speed": (wave.wave_speed, lambda d: tuple(d.positive(2))),
    "impedance": (wave.impedance, lambda d: tuple(d.positive(2))),
    "reflection": (wave.reflection, lambda d: tuple(d.positive(2))),
    "first_wave_time": (wave.first_wave_time, lambda d: tuple(d.positive(2))),
    "first_wave_force": (wave.first_wave_force, lambda d: tuple(d.positive(4))),
    "first_wave_speed": (wave.first_wave_speed, lambda d: tuple(d.positive(4))),
    "first_wave_peak": (wave.first_wave_peak, lambda d: tuple(d.positive(4))),
    "two_interval_force": (wave.two_interval_force, two_interval),
    "two_interval_peak": (wave.two_interval_peak, two_interval),
    "window_leak": (loop_bounds.window_leak, lambda d: tuple(d.positive(2))),
    "mass_behind": (loop_bounds.mass_behind, in_loop(False)),
    "quasi_static_gravity": (loop_bounds.quasi_static, in_loop(False)),
    "quasi_static_fixed": (loop_bounds.quasi_static, in_loop(True)),
    "tension_green_gravity": (loop_bounds.tension_green, in_loop(False)),
    "tension_green_fixed": (loop_bounds.tension_green, in_loop(True)),
    "stray_gravity": (loop_bounds.stray, in_loop(False)),
    "stray_fixed": (loop_bounds.stray, in_loop(True)),
    "lowest_frequency_gravity": (loop_bounds.lowest_frequency_bound, whole_loop(False)),
    "lowest_frequency_fixed": (loop_bounds.lowest_frequency_bound, whole_loop(True)),
}
SIGNED = {"quasi_static_fixed", "reflection"}
"""Laws whose value may be negative."""
BELOW_ROUNDING = {"two_interval_force", "two_interval_peak", "rise_integral"}
"""Laws with a difference whose rounding may take it below 0; their digits are checked further down."""


@pytest.mark.parametrize("name", FINITE)
def test_no_law_overflows_or_loses_its_sign_over_twenty_four_decades(name: str) -> None:
    law, arguments = FINITE[name]
    draw = Draw(seed=2)
    for _ in range(300):
        given = arguments(draw)
        values = np.ravel(np.asarray(law(*given), float))
        assert np.all(np.isfinite(values)), given
        assert name in SIGNED | BELOW_ROUNDING or np.all(values >= 0), given


def test_grip_over_twenty_four_decades_is_finite_or_where_the_docstring_says_infinite() -> None:
    draw = Draw(seed=3)
    for _ in range(1000):
        slack, more, lift, exponent = draw.positive(4)
        tight = slack + more
        used = float(capstan.slip_utilisation(tight, slack, lift, exponent))
        assert math.isinf(used) == (slack <= lift)
        reserve = float(capstan.slip_reserve_force(tight, slack, exponent))
        nothing_transmitted = tight == slack  # the sum may round it away
        beyond_floats = exponent > 709 - math.log(max(slack / more, 1.0))
        assert reserve > 0
        assert not math.isinf(reserve) or nothing_transmitted or beyond_floats


# --- digits: exponentials ---------------------------------------------------------------------------------------

SMALL_TO_LARGE = [1e-12, 1e-9, 1e-5, 0.1, 1.0, 7.0, 50.0]


class TestGripKeepsItsDigits:
    @pytest.mark.parametrize("exponent", [*SMALL_TO_LARGE, 300.0, 700.0])
    def test_utilisation(self, exponent: float) -> None:
        tight, slack, lift = 7e4, 2e4, 3e3
        exact = precise(
            lambda: (Decimal(tight) - Decimal(lift)) / (Decimal(slack) - Decimal(lift)) * (-Decimal(exponent)).exp()
        )
        assert capstan.slip_utilisation(tight, slack, lift, exponent) == pytest.approx(exact, rel=1e-13, abs=0)

    @pytest.mark.parametrize("exponent", [*SMALL_TO_LARGE, 300.0, 690.0])
    def test_reserve(self, exponent: float) -> None:
        tight, slack = 7e4, 2e4
        exact = precise(lambda: Decimal(slack) * (Decimal(exponent).exp() - 1) / (Decimal(tight) - Decimal(slack)))
        assert capstan.slip_reserve_force(tight, slack, exponent) == pytest.approx(exact, rel=1e-13, abs=0)

    @pytest.mark.parametrize("exponent", SMALL_TO_LARGE)
    def test_reserve_of_a_ratio_and_back(self, exponent: float) -> None:
        ratio, reserve = 1.25, 1.4
        by_ratio = precise(lambda: (1 - (-Decimal(exponent)).exp()) / (Decimal(ratio) - (-Decimal(exponent)).exp()))
        by_reserve = precise(lambda: (-Decimal(exponent)).exp() + (1 - (-Decimal(exponent)).exp()) / Decimal(reserve))
        assert capstan.slip_reserve_ratio(ratio, exponent) == pytest.approx(by_ratio, rel=1e-13, abs=0)
        assert capstan.slip_ratio(reserve, exponent) == pytest.approx(by_reserve, rel=1e-13, abs=0)

    def test_four_hundred_turns(self) -> None:
        """A winch that nothing can make slip: no use of its grip, no end to its reserve, no overflow."""
        exponent = 0.4 * 2 * math.pi * 400
        assert capstan.slip_utilisation(5e5, 1.0, 0.0, exponent) == 0.0
        assert capstan.slip_reserve_force(5e5, 1.0, exponent) == math.inf
        assert capstan.slip_ratio(2.0, exponent) == pytest.approx(0.5, rel=1e-15)
        assert capstan.slip_reserve_ratio(0.5, exponent) == pytest.approx(2.0, rel=1e-15)

    def test_without_tension_and_without_wrap(self) -> None:
        assert capstan.slip_utilisation(0.0, 0.0, 0.0, 0.0) == math.inf
        assert capstan.slip_reserve_force(0.0, 0.0, 0.0) == 0.0
        assert capstan.slip_reserve_force(1.0, 1.0, 0.0) == math.inf
        assert capstan.slip_reserve_ratio(1.0, 0.0) == math.inf
        assert capstan.slip_ratio(2.0, 0.0) == 1.0


class TestFirstWaveKeepsItsDigits:
    @pytest.mark.parametrize("time", SMALL_TO_LARGE)
    def test_force_and_speed(self, time: float) -> None:
        force, impedance, mass = 3.0, 5.0, 7.0

        def grown() -> Decimal:
            return 1 - (-Decimal(impedance) * Decimal(time) / Decimal(mass)).exp()

        exact = precise(lambda: Decimal(force) * grown())
        assert wave.first_wave_force(force, impedance, mass, time) == pytest.approx(exact, rel=1e-14, abs=0)
        speed = precise(lambda: Decimal(force) / Decimal(impedance) * grown())
        assert wave.first_wave_speed(force, impedance, mass, time) == pytest.approx(speed, rel=1e-14, abs=0)

    @pytest.mark.parametrize("impedance", [1e-300, 1e-30, 1e-12])
    def test_speed_behind_a_belt_that_weighs_next_to_nothing(self, impedance: float) -> None:
        """The division by the impedance takes nothing away: F t/m, as with no belt at all."""
        with_belt = wave.first_wave_speed(12.0, impedance, 3.0, 5.0)
        assert with_belt == pytest.approx(20.0, rel=1e-11)
        assert wave.first_wave_speed(12.0, 0.0, 3.0, 5.0) == 20.0

    def test_no_force_and_no_time(self) -> None:
        times = np.array([0.0, 1.0])
        assert wave.first_wave_force(0.0, 5.0, 7.0, times).tolist() == [0.0, 0.0]
        assert wave.first_wave_speed(0.0, 5.0, 7.0, times).tolist() == [0.0, 0.0]
        assert wave.first_wave_force(3.0, 5.0, 7.0, 0.0) == 0.0


class TestTwoIntervalsKeepTheirDigits:
    """Against the delay equation's solution in decimals, over mass ratios of belt to drive of 5e-13 to 25."""

    @pytest.mark.parametrize("ratio", SMALL_TO_LARGE)
    @pytest.mark.parametrize("at", [0.25, 1.0, 1.25, 1.5])
    def test_error_is_small_against_the_peak(self, ratio: float, at: float) -> None:
        """T/tau = ratio. The peak F (1 - exp(-T/tau)) itself is small for a heavy drive."""
        contour, tau = ratio, 1.0
        time = at * contour

        def solution() -> Decimal:
            x = Decimal(time) - Decimal(contour)
            if x <= 0:
                return 1 - (-Decimal(time)).exp()
            return 1 - (2 * x + (-Decimal(contour)).exp()) * (-x).exp()

        peak = -math.expm1(-ratio)
        assert wave.two_interval_force(1.0, contour, tau, time) == pytest.approx(
            precise(solution), rel=0, abs=1e-12 * peak
        )

    @pytest.mark.parametrize("ratio", SMALL_TO_LARGE)
    def test_both_branches_meet_at_the_corner(self, ratio: float) -> None:
        """The peak is at the corner and is approached from both sides."""
        peak, when = wave.two_interval_peak(1.0, ratio, 1.0, 2 * ratio)
        assert when == ratio
        assert peak == pytest.approx(-math.expm1(-ratio), rel=1e-14)
        beside = wave.two_interval_force(1.0, ratio, 1.0, np.nextafter(ratio, 100))
        assert beside == pytest.approx(peak, rel=1e-12)


# --- digits: start profiles -------------------------------------------------------------------------------------

SHARES = [1e-9, 1e-6, 1e-3, 0.03, 0.4, 0.999]


class TestProfilesKeepTheirDigits:
    @pytest.mark.parametrize("share", SHARES)
    def test_cosine(self, share: float) -> None:
        rise_time = 8.0
        angle = PI * Decimal(share)

        def factor() -> Decimal:
            half = sine(angle / 2)
            return half * half

        time = share * rise_time  # exact: a power of two
        assert start_profile.rise("cosine", rise_time, time) == pytest.approx(precise(factor), rel=1e-13, abs=0)
        slope = precise(lambda: PI / 2 / 8 * sine(angle))
        assert start_profile.rise_rate("cosine", rise_time, time) == pytest.approx(slope, rel=1e-12, abs=0)

    @pytest.mark.parametrize("share", SHARES)
    def test_integral_of_the_cosine(self, share: float) -> None:
        """pi^2 t^3/(12 t_s^2) at first: the two terms of the closed form nearly cancel there."""
        rise_time = 8.0
        area = precise(lambda: Decimal(rise_time) / 2 * (Decimal(share) - sine(PI * Decimal(share)) / PI))
        found = start_profile.rise_integral("cosine", rise_time, share * rise_time)
        assert found == pytest.approx(area, rel=1e-9, abs=0)

    @pytest.mark.parametrize("share", SHARES)
    def test_ramp(self, share: float) -> None:
        rise_time = 8.0
        assert start_profile.rise("ramp", rise_time, share * rise_time) == pytest.approx(share, rel=1e-15, abs=0)
        area = float(Fraction(share) ** 2 * 4)
        assert start_profile.rise_integral("ramp", rise_time, share * rise_time) == pytest.approx(
            area, rel=1e-14, abs=0
        )

    def test_long_after_the_rise(self) -> None:
        for shape in ("ramp", "cosine"):
            assert start_profile.rise(shape, 1e-12, 1e12) == 1.0
            assert start_profile.rise_rate(shape, 1e-12, 1e12) == 0.0
            assert start_profile.rise_integral(shape, 1e-12, 1e12) == 1e12


class TestPhasesAtTheirEdges:
    @pytest.mark.parametrize("product", [1e2, 1e5, 1e9, 1e12])
    def test_of_a_very_slow_start_are_the_leading_terms(self, product: float) -> None:
        """Duhamel's integral by parts: the first jump that remains, in the slope or in the curvature of the load."""
        b = math.pi / product
        tolerance = 2 * b + 1e-12
        strays = {
            key: [phase.stray for phase in start_profile.phases(*key, 1.0, product)]
            for key in [("ramp", False), ("cosine", False), ("cosine", True)]
        }
        assert strays["ramp", False] == pytest.approx([1 / product, 2 / product], rel=tolerance)
        assert strays["cosine", False] == pytest.approx([b**2, b**2], rel=tolerance)
        assert strays["cosine", True] == pytest.approx([b, 2 * b], rel=tolerance)

    @pytest.mark.parametrize("times_pi", [0.0, 1e-12, 0.5, 1 - 1e-15, 1.0, 1 + 1e-15, 1 + 1e-9, 1.2])
    def test_at_resonance_with_the_rise_the_caps_hold(self, times_pi: float) -> None:
        """w t_s = pi divides by nothing: there the cap of a step by step answer holds, and beside it, too."""
        for shape in ("ramp", "cosine"):
            for imposed_speed, cap in ((False, 1.0), (True, 2.0)):
                for phase in start_profile.phases(shape, imposed_speed, 1.0, times_pi * math.pi):
                    assert 0 < phase.stray <= cap
        caps = [phase.stray for phase in start_profile.phases("cosine", True, 1.0, math.pi)]
        assert caps == [2.0, 2.0]


class TestWindowLeakAtItsEdges:
    @pytest.mark.parametrize(
        ("angle", "leak"),
        [
            (0.0, 1.0), (math.pi, 1.0), (math.nextafter(math.pi, 4), 1.0), (1.4 * math.pi, 1.0),
            (2 * math.pi, 1 / 3), (10 * math.pi, 1 / 99), (1e12 * math.pi, 1e-24),
        ],
    )  # fmt: skip
    def test_is_capped_where_the_average_could_see_everything(self, angle: float, leak: float) -> None:
        assert loop_bounds.window_leak(angle, 1.0) == pytest.approx(leak, rel=1e-12, abs=0)
        assert loop_bounds.window_leak(1.0, angle) == pytest.approx(leak, rel=1e-12, abs=0)


# --- digits: loops ----------------------------------------------------------------------------------------------


def exact_opening(loop: LoopMasses, strand: int, x: float | Fraction) -> Fraction:
    """G in rational numbers, as the power of the opening: the integral of the squared acceleration over all masses.

    The acceleration is 0 at the run-off and the drum, rises with the compliance passed (fixed loop) and drops by 1 at
    the section; a drum that is free to follow adds the same to all masses, so that no momentum is left over.
    """
    x = Fraction(x)
    back, tail, carry, drive = map(Fraction, (loop.return_mass, loop.tail_mass, loop.carry_mass, loop.drive_mass))
    whole = Fraction(loop.return_compliance) + Fraction(loop.carry_compliance)
    g = Fraction(loop.return_compliance) / whole
    one = Fraction(1)
    if not loop.fixed_length:
        g, rest = Fraction(0), Fraction(0)
    else:
        rest = 1 - g
    # (mass, acceleration at its two ends), linear between them
    if strand == RETURN:
        parts = [(back * x, Fraction(0), g * x), (back * (1 - x), g * x - 1, g - 1)]
        parts += [(tail, g - 1, g - 1), (carry, g - 1, g + rest - 1)]
    else:
        parts = [(back, Fraction(0), g), (tail, g, g), (carry * x, g, g + rest * x)]
        parts += [(carry * (1 - x), g + rest * x - 1, g + rest - 1)]
    drum = Fraction(0) if loop.fixed_length else -one
    if loop.imposed_speed:
        rigid = -drum
    else:
        parts.append((drive, drum, drum))
        rigid = -sum((m * (a + b) / 2 for m, a, b in parts), Fraction(0)) / sum((m for m, _, _ in parts), Fraction(0))
    return sum(
        (m * ((a + rigid) ** 2 + (a + rigid) * (b + rigid) + (b + rigid) ** 2) / 3 for m, a, b in parts), Fraction(0)
    )


BOOLE = [(Fraction(k, 4), Fraction(w, 90)) for k, w in enumerate((7, 32, 12, 32, 7))]
"""Exact for polynomials up to degree 5; G has degree 4 at most."""


def exact_frequency(loop: LoopMasses) -> float:
    total = sum(
        Fraction(compliance) * weight * exact_opening(loop, strand, x)
        for strand, compliance in ((RETURN, loop.return_compliance), (CARRY, loop.carry_compliance))
        for x, weight in BOOLE
    )
    return precise(lambda: 1 / (Decimal(total.numerator) / Decimal(total.denominator)).sqrt())


class TestLoopsKeepTheirDigits:
    """Masses and compliances drawn over so many decades each way; a belt conveyor knows two."""

    @pytest.mark.parametrize(("decades", "digits"), [(1, 1e-11), (2, 1e-9), (12, 1e-6)])
    @pytest.mark.parametrize("fixed_length", [False, True], ids=["gravity", "fixed"])
    @pytest.mark.parametrize("imposed_speed", [False, True], ids=["force", "speed"])
    def test_opening(self, decades: int, digits: float, fixed_length: bool, imposed_speed: bool) -> None:
        draw = Draw(seed=9, decades=(-decades, decades))
        for _ in range(80):
            loop = draw.loop(fixed_length, imposed_speed)
            for strand in (RETURN, CARRY):
                x = draw.share()
                exact = float(exact_opening(loop, strand, x))
                assert loop_bounds.tension_green(loop, strand, x) == pytest.approx(exact, rel=digits, abs=0)

    @pytest.mark.parametrize(("decades", "digits"), [(1, 1e-11), (2, 1e-9), (12, 1e-6)])
    @pytest.mark.parametrize("fixed_length", [False, True], ids=["gravity", "fixed"])
    @pytest.mark.parametrize("imposed_speed", [False, True], ids=["force", "speed"])
    def test_lowest_frequency(self, decades: int, digits: float, fixed_length: bool, imposed_speed: bool) -> None:
        draw = Draw(seed=10, decades=(-decades, decades))
        for _ in range(40):
            loop = draw.loop(fixed_length, imposed_speed)
            assert loop_bounds.lowest_frequency_bound(loop) == pytest.approx(exact_frequency(loop), rel=digits, abs=0)

    def test_stray_at_the_run_on_of_a_gravity_take_up_is_the_belt_down_to_no_drive(self) -> None:
        for drive in (1e12, 1.0, 1e-12, 1e-300):
            loop = LoopMasses(1e3, 3e3, 70.0, drive, 1e-5, 1e-5, fixed_length=False, imposed_speed=False)
            assert loop_bounds.stray(loop, CARRY, 1.0) == pytest.approx(4070.0, rel=1e-14)

    @pytest.mark.parametrize("fixed_length", [False, True])
    @pytest.mark.parametrize("without", ["return_mass", "carry_mass", "tail_mass"])
    @pytest.mark.parametrize("imposed_speed", [False, True])
    def test_a_part_without_mass(self, fixed_length: bool, imposed_speed: bool, without: str) -> None:
        loop = LoopMasses(1e3, 3e3, 70.0, 2e3, 1e-5, 3e-5, fixed_length=fixed_length, imposed_speed=imposed_speed)
        loop = replace(loop, **{without: 0.0})
        x = np.linspace(0, 1, 9)
        for strand in (RETURN, CARRY):
            exact = [float(exact_opening(loop, strand, float(at))) for at in x]
            assert loop_bounds.tension_green(loop, strand, x) == pytest.approx(exact, rel=1e-12, abs=1e-10)
            assert np.all(np.isfinite(loop_bounds.stray(loop, strand, x)))
        assert loop_bounds.lowest_frequency_bound(loop) == pytest.approx(exact_frequency(loop), rel=1e-12)

    @pytest.mark.parametrize("fixed_length", [False, True])
    def test_an_imposed_speed_asks_nothing_of_the_drive(self, fixed_length: bool) -> None:
        """The drum moves as told: its mass, even none, changes nothing."""
        base = LoopMasses(1e3, 3e3, 70.0, 0.0, 1e-5, 3e-5, fixed_length=fixed_length, imposed_speed=True)
        x = np.linspace(0, 1, 5)
        for strand in (RETURN, CARRY):
            strays = [loop_bounds.stray(replace(base, drive_mass=drive), strand, x) for drive in (0.0, 1.0, 1e12)]
            assert strays[0].tolist() == strays[1].tolist() == strays[2].tolist()


# --- zeros ------------------------------------------------------------------------------------------------------


class TestWithoutWeight:
    """A span that weighs nothing does not sag and does not soften; without tension both are infinite as documented,
    whatever it weighs."""

    TENSIONS = np.array([-1.0, 0.0, 1e-12, 1e12])

    @pytest.mark.parametrize("weight", [0.0, 50.0])
    def test_sag(self, weight: float) -> None:
        ratio = sag.sag_ratio(weight, self.TENSIONS)
        assert np.isinf(ratio).tolist() == [True, True, False, False]
        assert ratio[2:] == pytest.approx([weight / 8e-12, weight / 8e12], rel=1e-14)

    @pytest.mark.parametrize("weight", [0.0, 50.0])
    def test_softening(self, weight: float) -> None:
        f = sag.softening(1e8, weight, self.TENSIONS)
        assert np.isinf(f).tolist() == [True, True, False, False]
        assert f[2:] == pytest.approx([1e8 * weight**2 / 12e-36, 1e8 * weight**2 / 12e36], rel=1e-13)


def test_a_drive_without_rotor_drum_force_or_torque() -> None:
    assert inertia.reduced_drive_mass(0.0, 20.0, 0.9, 0.0, 0.4) == 0.0
    assert motor.mean_starting_torque(0.0, 0.0) == 0.0
    assert motor.rim_force(0.0, 20.0, 0.9, 0.4) == 0.0
    assert resistance.main_resistance_per_length(0.0, 9.81, 180.0, 15.0, 1.0) == 0.0


def test_reflection_at_nothing_and_at_everything() -> None:
    assert wave.reflection(1e-12, 0.0) == -1.0
    assert wave.reflection(0.0, 1e-12) == 1.0
    assert wave.reflection(1e12, 1e-12) == -1.0
    assert wave.reflection(1e12, math.nextafter(1e12, 2e12)) == pytest.approx(math.ulp(1e12) / 2e12, rel=1e-9)
