"""Laws of one line that other tests only use: their values at arguments that are no round numbers, by hand."""

import math

import pytest

from ptmcalc.laws import carriage, chain_start, chain_wear, hoisting, mast, mast_modes, polygon, reeving, similarity


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
    gives = mast.Compliance(3.1e-7, 1.7e-7, 0.9e-7)
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
