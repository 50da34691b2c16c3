"""Tensions along a route against idlers and weights one by one, and worst fillings against all fillings."""

import itertools
import math

import numpy as np
import pytest

from ptmcalc.laws import strand_tension

G = 9.81
LENGTH = np.array([200.0, 150.0, 80.0, 80.0, 150.0, 200.0])
LIFT = np.array([4.0, -12.0, 0.0, 0.0, 12.0, -4.0])
BELT = np.full(6, 18.0)
LOAD = np.array([0.0, 0.0, 0.0, 160.0, 160.0, 160.0])
IDLERS = np.array([7.0, 7.0, 7.0, 20.0, 20.0, 20.0])


def pulls(load: np.ndarray) -> np.ndarray:
    return strand_tension.section_pull(LENGTH, LIFT, BELT, load, IDLERS, 0.022, G)


class TestTensions:
    def test_weight_by_weight(self) -> None:
        """Pieces of 5 cm, each held by its neighbours: friction of what presses on the idlers, and weight along."""
        tension, pieces = 30e3, 4000
        found = strand_tension.strand_tensions(30e3, pulls(LOAD))
        assert found[0] == 30e3
        for k, (run, h, b, q, r) in enumerate(zip(LENGTH, LIFT, BELT, LOAD, IDLERS, strict=True)):
            slope = math.asin(h / run)
            for _ in range(pieces):
                weight = (b + q) * G * run / pieces
                tension += 0.022 * (weight * math.cos(slope) + r * G * run / pieces) + weight * math.sin(slope)
            assert found[k + 1] == pytest.approx(tension, rel=1e-10)

    @pytest.mark.parametrize("size", [1e-3, 0.5, 1e3])
    def test_a_section_of_any_size_pulls_in_proportion(self, size: float) -> None:
        """Of 5 up on 13 along: the idlers bear 12/13 of the weight."""
        pull = strand_tension.section_pull(13 * size, 5 * size, 18.0, 160.0, 20.0, 0.022, G)
        assert pull == pytest.approx(size * G * (0.022 * (178.0 * 12 + 20.0 * 13) + 178.0 * 5), rel=1e-12)
        load = strand_tension.load_pull(13 * size, 5 * size, 160.0, 0.022, G)
        assert load == pytest.approx(size * G * 160.0 * (0.022 * 12 + 5), rel=1e-12)

    def test_a_closed_route_lifts_the_load_only(self) -> None:
        """The belt comes back to where it was: without friction only the load's own height is left."""
        lossless = strand_tension.section_pull(LENGTH, LIFT, BELT, LOAD, IDLERS, 0.0, G)
        assert math.fsum(lossless) == pytest.approx(G * 160.0 * 8.0, rel=1e-12)

    def test_static_resistance_of_a_worked_case(self) -> None:
        """W of case BW-02: f 0.025, 1 km, 60 m lift, load 200 kg/m; f acts on all moving masses of 245 and 38 kg/m."""
        f, h, length = 0.025, 60.0, 1000.0
        carry = strand_tension.section_pull(length, h, 45.0, 200.0, 0.0, f, G)
        back = strand_tension.section_pull(length, -h, 38.0, 0.0, 0.0, f, G)
        cosine = math.sqrt(1 - 0.06**2)
        whole = carry + back + 7.0 * G * (-h)  # the idlers' 7 kg/m of the carry strand are not lifted
        friction = f * G * 283 * length
        assert whole == pytest.approx(friction * cosine + 200 * G * h, rel=1e-12)
        assert friction + 200 * G * h == pytest.approx(187126.0, rel=1e-5)
        assert float(whole) == pytest.approx(187126.0, rel=2e-3)

    def test_extremes(self) -> None:
        tensions = strand_tension.strand_tensions(30e3, pulls(LOAD))
        low, at_low, high, at_high = strand_tension.tension_extremes(tensions)
        assert (low, high) == (min(tensions), max(tensions))
        assert (tensions[int(at_low)], tensions[int(at_high)]) == (low, high)
        assert strand_tension.tension_extremes(np.array([2.0, 2.0])) == (2.0, 0.0, 2.0, 0.0)

    def test_a_section_cannot_be_steeper_than_upright(self) -> None:
        assert strand_tension.section_pull(5.0, 5.0, 2.0, 0.0, 0.0, 0.02, G) == pytest.approx(10 * G)
        with pytest.raises(ValueError, match="rise more"):
            strand_tension.section_pull(5.0, -5.1, 2.0, 0.0, 0.0, 0.02, G)
        with pytest.raises(ValueError, match="rise more"):
            strand_tension.load_pull(5.0, 5.1, 2.0, 0.02, G)

    def test_a_point_of_a_route_has_no_length(self) -> None:
        assert strand_tension.section_pull(0.0, 0.0, 2.0, 3.0, 4.0, 0.02, G) == 0.0


class TestLoadings:
    LIFTS = np.array([6.0, -0.5, -9.0, 3.0, -2.0, 14.0, -30.0, 1.0])
    """A descent of 0.5 m in 100 m is flatter than f, one of 9 m is not."""

    def added(self) -> np.ndarray:
        return strand_tension.load_pull(100.0, self.LIFTS, 160.0, 0.02, G)

    def test_linear_in_the_load(self) -> None:
        full, empty, half = (
            strand_tension.section_pull(100.0, self.LIFTS, 18.0, q, 20.0, 0.02, G) for q in (160.0, 0.0, 80.0)
        )
        assert self.added() == pytest.approx(full - empty, rel=1e-12)
        assert half == pytest.approx((full + empty) / 2, rel=1e-12)

    def test_all_two_hundred_and_fifty_six(self) -> None:
        added = self.added()
        sums = [float(np.dot(x, added)) for x in itertools.product((0.0, 1.0), repeat=8)]
        most, least = (strand_tension.worst_loading(added, sense) for sense in ("most", "least"))
        assert np.dot(most, added) == pytest.approx(max(sums), rel=1e-13)
        assert np.dot(least, added) == pytest.approx(min(sums), rel=1e-13)
        assert most[1] == 1.0  # downhill, and yet it pulls

    def test_partly_filled_sections_are_not_worse(self) -> None:
        added, rng = self.added(), np.random.default_rng(4)
        most = np.dot(strand_tension.worst_loading(added, "most"), added)
        least = np.dot(strand_tension.worst_loading(added, "least"), added)
        shares = rng.uniform(0, 1, (400, 8))
        assert np.all(shares @ added <= most)
        assert np.all(shares @ added >= least)

    @pytest.mark.parametrize("seed", range(20))
    @pytest.mark.parametrize(("sense", "sign"), [("most", 1), ("least", -1)])
    def test_all_stretches(self, seed: int, sense: str, sign: int) -> None:
        added = np.random.default_rng(seed).normal(size=9)
        best = max(sign * float(added[i:j].sum()) for i in range(10) for j in range(i, 10))
        stretch = strand_tension.worst_stretch(added, sense)
        assert sign * np.dot(stretch, added) == pytest.approx(max(best, 0.0), abs=1e-12)
        assert np.abs(np.diff(stretch, prepend=0, append=0)).sum() in (0.0, 2.0)

    def test_a_hill_of_one_crest(self) -> None:
        lift = np.array([3.0, 5.0, 4.0, -6.0, -7.0])
        added = strand_tension.load_pull(100.0, lift, 160.0, 0.02, G)
        for sense, filled in (("most", [1, 1, 1, 0, 0]), ("least", [0, 0, 0, 1, 1])):
            assert strand_tension.slope_loading(lift, sense).tolist() == filled
            assert strand_tension.worst_stretch(added, sense).tolist() == filled
            assert strand_tension.worst_loading(added, sense).tolist() == filled

    def test_where_load_only_helps_or_does_nothing_the_belt_is_empty(self) -> None:
        for pulls in (np.array([-1.0, -2.0, -0.5]), np.zeros(3)):
            assert strand_tension.worst_stretch(pulls, "most").tolist() == [0.0] * 3
            assert strand_tension.worst_stretch(-pulls, "least").tolist() == [0.0] * 3

    def test_envelope_is_attained_at_every_point_and_never_left(self) -> None:
        empty = strand_tension.section_pull(100.0, self.LIFTS, 18.0, 0.0, 20.0, 0.02, G)
        added = self.added()
        least, most = strand_tension.loading_envelope(2e4, empty, added)
        every = np.array(
            [[2e4, *(2e4 + np.cumsum(empty + np.array(x) * added))] for x in itertools.product((0.0, 1.0), repeat=8)]
        )
        assert every.min(axis=0) == pytest.approx(least, rel=1e-13)
        assert every.max(axis=0) == pytest.approx(most, rel=1e-13)

    def test_refuses_another_sense(self) -> None:
        for law in (strand_tension.worst_loading, strand_tension.worst_stretch, strand_tension.slope_loading):
            with pytest.raises(ValueError, match="most or least"):
                law(self.LIFTS, "worst")
