"""Laws of ropes and drums against numbers worked out by hand."""

import math

import numpy as np
import pytest

from ptmcalc.laws import drum_shell, rope_life, rope_proof

FEYRER = rope_life.Constants(1.3, 1.29, 8.149, -3.635)


class TestNumberOfBendings:
    """8 x 19 with a fibre core, 16 mm, D/d 25, 100 N/mm^2, wires of 1770 N/mm^2."""

    def test_number(self) -> None:
        """lg N = 1.3 + (1.29 - 3.635 x 1.39794) x 2 + 8.149 x 1.39794 = 5.10877."""
        found = rope_life.bending_number(25600.0, 0.016, 25.0, 1770e6, FEYRER, 1.0)
        assert math.log10(found) == pytest.approx(5.10877, abs=2e-5)

    def test_exponent_of_the_force(self) -> None:
        """q = -(b1 + b3 lg(D/d)) = 3.7915."""
        light, heavy = (rope_life.bending_number(force, 0.016, 25.0, 1770e6, FEYRER, 1.0) for force in (1e4, 2e4))
        assert math.log2(light / heavy) == pytest.approx(3.7915, abs=1e-4)

    def test_factors_are_one_at_their_reference(self) -> None:
        assert rope_life.diameter_factor(0.016) == pytest.approx(1.0, rel=1e-12)
        assert rope_life.length_factor(0.96, 0.016) == pytest.approx(1.0, rel=1e-12)
        assert rope_life.CORE_FACTOR["IWRC"][6] == 0.81

    def test_wire_breaks(self) -> None:
        """18 - 1.74 - (1550 + 260)/625 = 13.364; the force with so many breaks is that force."""
        assert rope_life.wire_breaks(25600.0, 0.016, 25.0, "FC-8x19") == pytest.approx(13.364, abs=1e-3)
        assert rope_life.discard_force(0.016, 25.0, "FC-8x19", 13.364) == pytest.approx(25600.0, rel=1e-6)
        assert rope_life.discard_force(0.016, 25.0, "FC-8x19", 20.0) == 0.0

    def test_reverse_bendings(self) -> None:
        """9.026 x 100 000^0.618 = 11 104."""
        assert rope_life.reversed_number(1e5, 9.026, 0.618) == pytest.approx(11104, abs=1)
        assert rope_life.reversed_number(math.inf, 9.026, 0.618) == math.inf


class TestProofOfCompetence:
    """EN 13001-3-2:2014."""

    def test_resistance_of_bent_ropes(self) -> None:
        """The minimum of 2.07 begins at D/d = 20, where the formula gives 2.066; 11.2 gives 3.07."""
        assert rope_proof.static_resistance(20.0) == 2.07
        assert rope_proof.static_resistance(11.2) == pytest.approx(3.07, abs=0.005)
        assert rope_proof.static_resistance(5.6) == math.inf

    def test_history(self) -> None:
        """0.2 + 0.4 x 0.6^3 + 0.4 x 0.2^3 = 0.2896; 250 000 bendings of 500 000: 0.1448."""
        assert rope_proof.history([0.2, 0.4, 0.4], [1, 0.6, 0.2], 2.5e5, 5e5) == pytest.approx(0.1448, rel=1e-12)

    def test_fatigue(self) -> None:
        """160.2 kN x 0.9/(7 x 0.125^(1/3)) = 41.19 kN."""
        assert rope_proof.fatigue_resistance(160.2e3, 0.9, 7.0, 0.125) == pytest.approx(41194.3, abs=0.1)


class TestDrumShell:
    """A drum of 400 mm with a wall of 20 mm, rope pull 40 kN; numbers of finite differences in brackets."""

    def test_layers(self) -> None:
        """kappa = 0.144: 1.87, 2.65 and 3.99 for two, three and five layers; 0.57 of the pull is left under five."""
        found = drum_shell.layer_pressures(5, 0.144)
        assert [found[1], found[2], found[4]] == pytest.approx([1.874, 2.651, 3.983], abs=1e-3)
        assert drum_shell.pull_left(5, 0.144) == pytest.approx(0.57, abs=0.001)

    def test_edge_of_the_winding(self) -> None:
        """Hoop stress of one half at the edge (0.498), bending of 0.293 at pi/4 (0.293)."""
        hoop, bending = drum_shell.edge_of_winding(np.array([0.0, math.pi / 4]))
        assert hoop[0] == pytest.approx(0.5, abs=1e-12)
        assert bending[1] == pytest.approx(0.293, abs=5e-4)

    def test_one_wrap(self) -> None:
        """Bending of 1.65 F/(sqrt(D) t^1.5) (1.64); D = 380 mm to the middle of the wall."""
        unit = 40e3 / math.sqrt(0.38) / 0.02**1.5
        hoop, bending = drum_shell.single_wrap(40e3, 0.19, 0.02)
        assert bending / unit == pytest.approx(1.65, abs=0.005)
        assert hoop / unit == pytest.approx(0.909, abs=0.001)

    def test_flange(self) -> None:
        """1 MPa from 0.2 m to 0.25 m: T = 56.25 kN/m, M = (0.25^3 - 0.2^3)/3 - 0.1 (0.25^2 - 0.2^2) over 0.2 m."""
        thrust, moment = drum_shell.flange_loads([1e6], [0.2, 0.25], 0.2)
        assert thrust == pytest.approx(56250.0, rel=1e-12)
        assert moment == pytest.approx(1458.333, abs=1e-3)

    def test_steels(self) -> None:
        assert drum_shell.yield_strength("S355", 0.02) == 345e6
        assert drum_shell.yield_strength("S235", 0.2) is None
