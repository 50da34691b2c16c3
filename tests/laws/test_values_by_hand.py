"""Laws of one line that other tests only use: their values at arguments that are no round numbers, by hand."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from ptmcalc.laws import (
    buffer,
    carriage,
    chain_selection,
    chain_start,
    chain_wear,
    hoisting,
    mast_compliance,
    mast_modes,
    polygon,
    reeving,
    shaft,
    similarity,
    skew,
    slewing,
)


def test_a_roller_turns_on_its_pin_and_rolls() -> None:
    """Powers: F w v = mu F (d/2) omega + F f omega, v = omega D/2."""
    found = float(carriage.roller_coefficient(0.09, 0.034, 0.0007, 0.21))
    assert found == pytest.approx((0.09 * 0.017 + 0.0007) / 0.105, rel=1e-14)


def test_a_start_by_the_textbook_gathers_its_speed_and_its_force() -> None:
    """J eps = M_p - M_s, eps t = w, and m (eps/i) R of the chain on a sprocket that turns i times slower."""
    rate = chain_start.start_acceleration(131.0, 47.0, 1.7)
    assert 1.7 * rate == pytest.approx(84.0, rel=1e-15)
    assert rate * chain_start.start_time(131.0, 47.0, 1.7, 97.0) == pytest.approx(97.0, rel=1e-14)
    assert chain_start.start_time(47.0, 47.0, 1.7, 97.0) == math.inf
    assert chain_start.start_time(47.0, 131.0, 1.7, 97.0) == math.inf
    assert chain_start.start_time(1e-3, 1e-4, 1.7, 97.0) == pytest.approx(1.7 * 97.0 / 9e-4, rel=1e-12)
    assert chain_start.start_force(4100.0, rate, 0.31, 23.0) == pytest.approx(
        4100.0 * 84.0 / 1.7 / 23.0 * 0.31, rel=1e-14
    )


@pytest.mark.parametrize("teeth", [6, 23])
def test_a_joint_on_a_sprocket_rubs_over_the_angle_of_a_tooth(teeth: int) -> None:
    """All joints of one turn: the circumference of the pin."""
    assert teeth * chain_wear.sprocket_path(0.0147, teeth) == pytest.approx(math.pi * 0.0147, rel=1e-15)


def test_ropes_pull_at_the_rim_of_a_drum() -> None:
    assert hoisting.drum_torque(13_100.0, 2, 0.163) == pytest.approx(13_100.0 * 0.326, rel=1e-15)


def test_shares_of_what_gives() -> None:
    gives = mast_compliance.Compliance(3.1e-7, 1.7e-7, 0.9e-7)
    assert gives.total == pytest.approx(5.7e-7, rel=1e-15)
    assert gives.stiffness == pytest.approx(1 / 5.7e-7, rel=1e-15)
    assert gives.rotation_share == pytest.approx(17 / 57, rel=1e-14)
    assert gives.translation_share == pytest.approx(9 / 57, rel=1e-14)


@pytest.mark.parametrize(("mode", "bare"), [(1, 1.875104068711961), (2, 4.694091132974175), (3, 7.854757438237613)])
@pytest.mark.parametrize("ratio", [0.0, 0.013, 0.7, 41.0])
def test_a_clamped_beam_with_a_mass_at_its_tip(mode: int, bare: float, ratio: float) -> None:
    """The frequency equation itself passes 0 there, and roots are counted from that of the bare beam."""
    found = mast_modes.clamped_beam_root(ratio, mode)

    def equation(b: float) -> float:
        return 1 / math.cosh(b) + math.cos(b) + ratio * b * (math.cos(b) * math.tanh(b) - math.sin(b))

    if ratio == 0:
        assert found == pytest.approx(bare, rel=1e-14)
    else:
        assert (bare + mode * math.pi - math.pi / 2 - 2) / 2 - 2 < found < bare
        assert equation(found * (1 - 1e-13)) * equation(found * (1 + 1e-13)) < 0


def test_what_swings_by_the_textbook_is_the_load_and_a_share_of_the_strand() -> None:
    assert polygon.textbook_mass(71.0, 23.0, 37.0, 1.5) == pytest.approx((71.0 + 34.5) * 37.0, rel=1e-15)


def test_rope_between_drum_and_end_goes_along_the_falls_of_its_half() -> None:
    assert reeving.rope_between_drum_and_end(12.3, 6, 2, 3.1) == pytest.approx(3 * 12.3 + 3.1, rel=1e-15)


def test_ballast_is_told_where_there_is_some() -> None:
    """A model of half the length of the same material: half of its mass is ballast; of the full weight none is."""
    some = similarity.distortions(similarity.BALLAST, 0.5)
    assert some[0].startswith("0.5 of the mass is ballast")
    assert "1.414 times too fast" in some[1]
    none = similarity.distortions(similarity.BALLAST, 0.5, density=2.0)
    assert len(none) == len(some) - 2
    assert not any("ballast" in one for one in none)
    assert len(similarity.distortions(similarity.GEOMETRIC, 0.5)) == len(none) + 3
    assert len(similarity.distortions(similarity.GEOMETRIC, 0.5, density=2.0)) == len(none)


def test_scales_fit_to_rounding_or_not_at_all() -> None:
    assert similarity.scales(similarity.FULL, 0.5, density=2.0 * (1 + 1e-10)).force == pytest.approx(0.25, rel=1e-9)
    with pytest.raises(ValueError, match="needs"):
        similarity.scales(similarity.FULL, 0.5, density=2.0 * (1 + 1e-7))


def test_how_far_a_slewing_load_can_swing_out() -> None:
    """2 g L (1 - cos t) = w^2 ((R + L sin t)^2 + J/m): the first angle, or any by a fast drive."""
    inertia, mass, radius, rope, gravity = 4e4, 1.1e3, 5.3, 6.7, 9.81
    for speed in (0.03, 0.21, 0.4):

        def spare(t: float, speed: float = speed) -> float:
            reach = radius + rope * math.sin(t)
            return 2 * gravity * rope * (1 - math.cos(t)) - speed**2 * (reach**2 + inertia / mass)

        angle = brentq(spare, 0.0, 1.4, xtol=1e-14)
        reach, lean = slewing.swing_reach(inertia, mass, radius, rope, speed, gravity)
        assert angle <= lean <= angle * (1 + 2e-9) + 2e-9
        assert radius + rope * math.sin(angle) <= reach <= (radius + rope * math.sin(angle)) * (1 + 3e-9)
    assert slewing.swing_reach(inertia, mass, radius, rope, 3.0, gravity) == (pytest.approx(12.0, rel=1e-14), math.pi)


def test_the_sense_of_power_in_a_gear_goes_by_both_inertias_however_small() -> None:
    """N has the sign of M J + u J_m R: of a light shaft that a load drives, the load decides."""
    for unit in (1e-6, 1.0, 1e6):
        for resistance, factor in ((-0.09, 0.9), (-0.11, 1 / 0.7), (5.0, 0.9)):
            found = shaft.gear_factor(1.0 * unit, 0.01 * unit, 0.01 * unit, 10.0, resistance * unit, 0.9, 0.7)
            assert float(found) == pytest.approx(factor, rel=1e-15)


def test_phi_7_by_two_values_changes_at_one_half() -> None:
    for share, factor in ((0.0, 1.25), (0.5, 1.25), (0.5001, 1.6), (1.0, 1.6)):
        assert buffer.buffer_factor(share, buffer.TWO_VALUES) == factor
    for share, factor in ((0.3, 1.25), (0.5, 1.25), (0.7, 1.39), (1.0, 1.6)):
        assert buffer.buffer_factor(share) == pytest.approx(factor, rel=1e-15)


@pytest.mark.parametrize("angle", [1e-7, 3.5e-5, 3e-3])
def test_a_skewing_crane_is_in_balance_at_any_angle(angle: float) -> None:
    """Coupled pairs: nothing along in all, and the forces across turn the crane as those along rail 2 do."""
    distances, weights = np.array([0.3, 2.9, 4.7]), np.array([8e4, 1.3e5, 6e4])
    across_one, across_two, along_one, along_two = skew.skew_equilibrium(
        0.3, angle, distances, np.ones(3), weights, 0.37, 22.5, skew.FIXED
    )
    size = float(np.abs(across_one).sum() + np.abs(across_two).sum())
    assert np.sum(along_one) + np.sum(along_two) == pytest.approx(0.0, abs=1e-7 * size)
    turning = float(distances @ (across_one + across_two))
    assert turning == pytest.approx(22.5 * float(np.sum(along_two)), rel=0, abs=1e-6 * size)
    if angle < 1e-6:
        assert size == pytest.approx(0.3 * 250 * angle * 2.7e5, rel=0.5)


def test_a_chain_that_just_reaches_round_two_equal_sprockets() -> None:
    """Half of what it has beyond one of them, pitch by pitch; one that has nothing beyond is refused."""
    for beyond in (1e-3, 0.6, 30.0):
        found = chain_selection.centre_distance(20 + beyond, 0.0254, 20, 20)
        assert found == pytest.approx(0.0254 * beyond / 2, rel=1e-11)
    with pytest.raises(ValueError, match="do not reach"):
        chain_selection.centre_distance(20.0, 0.0254, 20, 20)
