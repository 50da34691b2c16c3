"""A load on a rope taken in by an uneven drum: against DOP853 on the full equations, strain and length coupled.

Reference: s' = -V/(1 + eps), M y'' = m EA (eps + damping) - M g, eps = m H/s - 1, restarted at every corner of the map.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.hauling import Map, Rope, haul, largest_possible

SPEED, MASS, FALLS, GRAVITY = 0.4 * math.pi, 5000.0, 4, 9.81
TENSILE = 1.05e11 * 114e-6
STATIC = MASS * GRAVITY / FALLS / TENSILE
ROUNDED = 5e-13
"""What the reference loses where it takes the strain from two lengths."""
ROPE = Rope(160.0 / (1 + STATIC), FALLS**2 * TENSILE / MASS, STATIC, 0.0)


def layer_map(turns: int, arc: float = math.pi / 3, bump: float = 2.34e-3, low: float = 0.15875) -> Map:
    """A climb of 15 mm, then two bumps a turn."""
    high = low + 0.015155
    angles, radii = [0.0, 0.5, 0.5 + arc], [low, low, high]
    for k in range(1, 2 * turns):
        begin = 0.5 + k * math.pi
        angles += [begin, begin + arc / 2, begin + arc]
        radii += [high, high + bump, high]
    return Map(np.array([*angles, angles[-1] + 1.0]), np.array([*radii, high]))


def random_map(seed: int) -> Map:
    rng = np.random.default_rng(seed)
    angles = np.concatenate([[0.0], np.cumsum(rng.uniform(0.02, 2.0, 12))])
    return Map(angles, 0.15 + rng.uniform(0, 0.02, 13))


def reference(radius: Map, rope: Rope, per_stretch: int) -> tuple[np.ndarray, np.ndarray]:
    """Times and dynamic forces over E A."""
    length = rope.length * (1 + rope.static_strain)
    state = np.array([rope.length, length / FALLS, SPEED * radius.radii[0] / FALLS])
    found_times, found = [], []

    def speed(t: np.ndarray) -> np.ndarray:
        return SPEED * np.interp(SPEED * t, radius.angles, radius.radii)

    def parts(t: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        strain = FALLS * y[1] / y[0] - 1
        rate = (speed(t) - FALLS * y[2]) / y[0]
        return strain, strain + 2 * rope.damping_ratio * rate / np.sqrt(rope.rate / y[0])

    def slope(t: float, y: np.ndarray) -> list[float]:
        strain, force = parts(t, y)
        return [-speed(t) / (1 + strain), -y[2], FALLS * TENSILE * force / MASS - GRAVITY]

    for begin, end in zip(radius.angles[:-1] / SPEED, radius.angles[1:] / SPEED, strict=True):
        run = solve_ivp(slope, (begin, end), state, "DOP853", rtol=1e-12, atol=1e-14, dense_output=True, max_step=0.02)
        state, times = run.y[:, -1], np.linspace(begin, end, per_stretch)
        found_times.append(times)
        found.append(parts(times, run.sol(times))[1] - STATIC)
    return np.concatenate(found_times), np.concatenate(found)


class TestMotion:
    @pytest.mark.parametrize("damping", [0.0, 0.03, 0.3])
    @pytest.mark.parametrize("length", [160.0, 12.0])
    def test_of_a_climb_and_its_crossovers(self, length: float, damping: float) -> None:
        rope = replace(ROPE, length=length, damping_ratio=damping)
        motion = haul(layer_map(2), SPEED, rope)
        times, forces = reference(layer_map(2), rope, 1500)
        most, least = motion.extremes()
        assert np.all(np.abs(motion.at(times)[1] - forces) <= motion.bar(times) + ROUNDED)
        assert most.error <= (1e-4 + 4 * damping * 8 / length) * most.value
        step = 1e-4
        assert forces.max() - most.error <= most.value <= forces.max() + most.error + step * most.value
        assert forces.min() + least.error >= least.value >= forces.min() - least.error - step * most.value

    @pytest.mark.parametrize("seed", range(6))
    def test_of_any_map(self, seed: int) -> None:
        radius = random_map(seed)
        rope = replace(ROPE, length=20.0, damping_ratio=0.02 * (seed % 3))
        motion = haul(radius, SPEED, rope)
        times, forces = reference(radius, rope, 60)
        most, least = motion.extremes()
        assert np.all(np.abs(motion.at(times)[1] - forces) <= motion.bar(times) + ROUNDED)
        assert max(most.error, least.error) <= 0.05 * most.value
        assert most.value >= forces.max() - most.error
        assert least.value <= forces.min() + least.error

    def test_without_damping_strain_and_force_are_one(self) -> None:
        motion = haul(layer_map(2), SPEED, ROPE)
        strain, force = motion.at(np.linspace(0, motion.times[-1], 300))
        assert np.array_equal(strain, force)

    @pytest.mark.parametrize("seed", range(3))
    def test_what_is_taken_in_is_the_way_of_the_drum(self, seed: int) -> None:
        radius = random_map(seed)
        motion = haul(radius, SPEED, replace(ROPE, length=20.0))
        for time in np.linspace(0, motion.times[-1], 31):
            corners = [0.0, *(one for one in radius.angles[1:-1] / SPEED if one < time), time]
            at = np.array(corners)
            speeds = SPEED * np.interp(SPEED * at, radius.angles, radius.radii)
            taken = np.trapezoid(speeds, at) / (1 + STATIC)
            assert motion.rope_length(time) == pytest.approx(20.0 - taken, rel=1e-13)

    def test_an_extreme_at_the_end_has_the_bar_of_the_end(self) -> None:
        """A climb of half a swing: the force is largest where it ends."""
        motion = haul(Map(np.array([0.0, 0.5, 0.6]), np.array([0.15, 0.15, 0.165])), SPEED, ROPE)
        most = motion.extremes()[0]
        assert most.time == motion.times[-1]
        assert most.error == pytest.approx(float(motion.bar(most.time)), rel=1e-12)
        assert most.error > 2 * float(motion.bar(0.0))

    def test_an_even_drum_does_nothing(self) -> None:
        motion = haul(Map(np.array([0.0, 5.0]), np.array([0.15, 0.15])), SPEED, ROPE)
        most, least = motion.extremes()
        assert most.value == least.value == 0.0
        assert motion.rope_length(motion.times[-1]) == pytest.approx(ROPE.length - 0.75 / (1 + STATIC), rel=1e-14)

    def test_hauling_multiplies_a_swing_by_the_fourth_root_of_the_lengths(self) -> None:
        """From 120 to 15 m: 8^(1/4) = 1.68, the force of an undamped swing (C17)."""
        angles = np.array([0.0, 0.3, 0.5, 300.5, 500.5, 105.0 / 0.16 + 0.5])
        radius = Map(angles, np.array([0.15, 0.15, 0.16, 0.16, 0.16, 0.16]))
        rope = replace(ROPE, length=(105.0 + 0.15 * 0.3 + 0.155 * 0.2) / (1 + STATIC) + 15.0)
        motion = haul(radius, SPEED, rope)
        early = motion.at(motion.times[2] + np.linspace(0, 2, 2001))[1].max()
        late = motion.at(motion.times[-1] - np.linspace(0, 2, 2001))[1].max()
        start = float(motion.rope_length(motion.times[2]))
        assert late / early == pytest.approx((start / 15.0) ** 0.25, rel=3e-3)

    def test_a_sudden_step_is_bounded_by_its_jump_of_speed(self) -> None:
        """k DV/(m g) of the weight: reached where the climb is short against a period."""
        step = 0.015155
        radius = Map(np.array([0.0, 1.0, 1.001, 6.0]), np.array([0.15, 0.15, 0.15 + step, 0.15 + step]))
        ratio = haul(radius, SPEED, ROPE).extremes()[0].value / STATIC
        k = math.sqrt(ROPE.rate / ROPE.length)
        assert ratio == pytest.approx(SPEED * step * k / (FALLS * GRAVITY), rel=2e-3)


class TestBound:
    @pytest.mark.parametrize("seed", range(20))
    def test_holds_the_motion(self, seed: int) -> None:
        rope = replace(ROPE, length=20.0 + 10 * seed, damping_ratio=0.01 * (seed % 4))
        radius = random_map(seed) if seed % 2 else layer_map(1 + seed // 2, bump=1e-3 * seed)
        most, least = haul(radius, SPEED, rope).extremes()
        assert max(most.value + most.error, -least.value + least.error) <= largest_possible(radius, SPEED, rope)

    def test_is_not_far_away(self) -> None:
        """Bumps half a period apart, and long against one: all phases add up."""
        k = math.sqrt(ROPE.rate / ROPE.length)
        half = SPEED * math.pi / k
        angles = np.arange(0, 9) * half
        radius = Map(angles, 0.15 + 0.001 * (np.arange(9) % 2))
        found = haul(radius, SPEED, ROPE).extremes()[0].value
        assert largest_possible(radius, SPEED, ROPE) <= 1.2 * found


@pytest.mark.parametrize("share", [0.05, 0.7495, 0.7505, 0.999, 1 - 1e-11])
def test_takes_in_any_share_of_the_rope(share: float) -> None:
    """An even drum takes in u a second: theta = int k dt = 2 kappa^(1/2) (s_0^(1/2) - s_1^(1/2))/u."""
    even = Map(np.array([0.0, share * 160.0 / 0.15]), np.array([0.15, 0.15]))
    motion = haul(even, 0.05, ROPE)
    left, u = (1 - share) * ROPE.length, 0.05 * 0.15 / (1 + STATIC)
    assert motion.lengths[-1] == pytest.approx(left, rel=1e-12, abs=1e-14 * ROPE.length)
    phase = 2 * math.sqrt(ROPE.rate) * (math.sqrt(ROPE.length) - math.sqrt(left)) / u
    # where nearly no rope is left, its length has the rounding of what was taken in: d theta = k ds/u
    rounding = math.sqrt(ROPE.rate / left) * 1e-14 * ROPE.length / u
    assert motion.phases[-1] == pytest.approx(phase, rel=1e-11, abs=rounding)


@pytest.mark.parametrize("share", [1 - 1e-13, 1 - 1e-15, 1.0, 1.0005])
def test_takes_in_no_more_than_the_rope(share: float) -> None:
    even = Map(np.array([0.0, share * 160.0 / 0.15]), np.array([0.15, 0.15]))
    with pytest.raises(NumericsError, match="more rope than is free"):
        haul(even, 0.05, ROPE)


@pytest.mark.parametrize("damping", [1.0, 1.5, 30.0])
def test_refuses_a_load_that_does_not_swing(damping: float) -> None:
    with pytest.raises(NumericsError, match="does not swing") as told:
        haul(layer_map(1), SPEED, replace(ROPE, damping_ratio=damping))
    assert told.value.code == "NUM102"


def test_refuses_to_take_in_more_rope_than_there_is() -> None:
    with pytest.raises(NumericsError, match="more rope than is free"):
        haul(layer_map(3), SPEED, replace(ROPE, length=2.0))
    even = Map(np.array([0.0, 1.0]), np.array([1e-9, 1e-9]))
    speed = math.sqrt(ROPE.rate / ROPE.length) / (2 * math.pi * 1e6)
    assert haul(even, 1.004 * speed, ROPE).extremes()[0].value == 0.0
    with pytest.raises(NumericsError, match="swings"):
        haul(even, 0.996 * speed, ROPE)
    with pytest.raises(NumericsError, match="swings"):
        haul(Map(np.array([0.0, 1.0]), np.array([1e-9, 1e-9])), 1e-6, ROPE)


@pytest.mark.parametrize("damping", [0.03, 0.3, 0.6])
class TestBars:
    """Of the force from that of the motion: e + 2 z e', where (Y, Y') is wrong by no more than a length."""

    CLIMB = Map(np.array([0.0, 2.0, 14.0]), np.array([0.15, 0.15, 0.162]))

    def test_of_the_force_hold_the_worst_phase_and_little_more(self, damping: float) -> None:
        motion = haul(self.CLIMB, SPEED, replace(ROPE, length=40.0, damping_ratio=damping))
        size = (ROPE.rate * float(motion.lengths[-1])) ** 0.25
        drift = SPEED * 0.162 / (1 + STATIC) / 4 / size**2
        phases = np.linspace(0, 2 * math.pi, 4001)
        worst = np.abs(np.cos(phases) + 2 * damping * (np.sin(phases) + drift * np.cos(phases))).max() / size
        told = float(motion.bar(motion.times[-1])) / float(motion.error[-1])
        assert worst <= told <= worst * (1 + damping) * (1 + 1e-5)

    def test_of_a_bound_are_a_jump_of_the_offset_in_the_worst_phase(self, damping: float) -> None:
        """Nothing swings before the climb, so it sets off a swing of its offset: cos and sin of a damped one, at most
        as large as it begins with, and its force."""
        slow = 0.02 * SPEED
        rope = replace(ROPE, length=400.0, damping_ratio=damping)
        motion, bound = haul(self.CLIMB, slow, rope), largest_possible(self.CLIMB, slow, rope)
        rise = slow * slow * 0.012 / 12.0 / ROPE.rate
        assert float(motion.offsets[-1]) == pytest.approx(rise, rel=1e-12)
        swing = math.hypot(1, damping / math.sqrt(1 - damping**2)) * math.hypot(1, 2 * damping)
        fourth_root = (float(motion.lengths[1]) / float(motion.lengths[2])) ** 0.25
        assert bound == pytest.approx(rise * (1 + swing * fourth_root) + float(motion.bar(motion.times[-1])), rel=3e-4)
        assert motion.extremes()[0].value <= bound


@pytest.mark.parametrize("damping", [0.0, 0.003, 0.012, 0.2, 0.7])
@pytest.mark.parametrize("lengths", [(30.0, 9.0), (30.0, 28.5), (9.0, 8.7)])
def test_extremes_are_those_between_the_corners_whichever_crest_is_largest(
    lengths: tuple[float, float], damping: float
) -> None:
    """A climb and a long even pull: crests grow as the rope gets shorter, or fade; each by looks ever closer."""
    even = (lengths[0] - lengths[1]) / 0.16
    radius = Map(np.array([0.0, 0.4, 0.5, 0.5 + even]), np.array([0.15, 0.15, 0.16, 0.16]))
    rope = replace(ROPE, length=(lengths[0] + 0.0755) / (1 + STATIC), damping_ratio=damping)
    motion = haul(radius, SPEED, rope)
    for sign, extreme in zip((1, -1), motion.extremes(), strict=True):
        assert sign * extreme.value == pytest.approx(sign * float(motion.at(extreme.time)[1]), rel=1e-13)
        end = float(motion.times[-1])
        near = (motion.times[:, None] + np.linspace(-0.8, 0.8, 6001)).ravel()  # a few swings beside each corner
        times = np.unique(np.clip(np.concatenate([motion.times, near, np.linspace(0.0, end, 2001)]), 0.0, end))
        for _ in range(3):
            forces = sign * motion.at(times)[1]
            top = int(forces.argmax())
            times = np.linspace(times[max(top - 1, 0)], times[min(top + 1, len(times) - 1)], 401)
        assert sign * extreme.value == pytest.approx(float(forces.max()), rel=1e-11)
        bars = motion.bar(np.array([extreme.time, float(motion.times[-1])]))
        assert float(bars[0]) * (1 - 1e-12) <= extreme.error


def test_each_corner_hands_on_what_it_leaves_uncertain() -> None:
    """The bound of a stretch: with q = int |r| + theta d/(2 s), E_(j+1) = E_j + (|Y| + E_j)(e^q - 1).

    d = int |e| |s'| dt, what the dynamic strain changes of the unstrained length: s' = -V/(1 + e_0 + e) is -V/(1 + e_0)
    (1 - e) but for e^2 and e e_0. With the largest |e| of each stretch it is at most the sum of |e|_i (s_i - s_(i+1)),
    and k = (kappa/s)^(1/2) changes by k d/(2 s).
    """
    rope = replace(ROPE, length=14.0, damping_ratio=0.02)
    radius = random_map(3)
    motion = haul(radius, SPEED, rope)
    s, v, theta = motion.lengths, motion.speeds, np.diff(motion.phases)
    size = (ROPE.rate * s) ** 0.25
    error, taken = 0.0, 0.0
    for j, offset in enumerate(motion.offsets):
        c = motion.amplitudes[j]
        turn = math.sqrt(1 - 0.02**2)
        norm = math.hypot(c.real, 0.02 * c.real + turn * c.imag)
        g = max(v[j], v[j + 1]) / (1 + STATIC) / 4 / math.sqrt(ROPE.rate * s[j + 1])
        taken += (abs(offset) + (norm + error) / size[j + 1]) * (s[j] - s[j + 1])
        q = (g**2 + abs(offset) / 4 + 2 * 0.02 * g + taken / s[j + 1] / 2) * theta[j]
        error += (norm + error) * math.expm1(q)
        assert motion.error[j] == pytest.approx(error, rel=1e-10)


@pytest.mark.parametrize(("exponent", "told"), [(28.4, True), (30.01, False)])
def test_a_bar_that_grows_by_e_to_the_thirtieth_is_none(exponent: float, told: bool) -> None:
    """An even drum takes the rope in from s_0 to s_1 at the rate u. With g = u/(4 (kappa s)^(1/2)), dtheta = k ds/u,

    int g^2 dtheta = u/(8 kappa^(1/2)) (s_1^(-1/2) - s_0^(-1/2))

    The bound takes the largest g of a stretch, which leaves 0.9 of its length: 1 to 0.9^(-1/2) = 1.054 of the integral.
    """
    s0, s1 = ROPE.length, 0.4 * ROPE.length
    u = exponent * 8 * math.sqrt(ROPE.rate) / (1 / math.sqrt(s1) - 1 / math.sqrt(s0))
    even = Map(np.array([0.0, (s0 - s1) * (1 + STATIC) / 0.15]), np.array([0.15, 0.15]))
    speed = u * (1 + STATIC) / 0.15
    if told:
        assert haul(even, speed, ROPE).lengths[-1] == pytest.approx(s1, rel=1e-12)
        return
    with pytest.raises(NumericsError, match="faster than the load oscillates"):
        haul(even, speed, ROPE)
