"""Classes and groups of cranes and mechanisms: case C27, the standard's table cell by cell, edges."""

import numpy as np
import pytest

from ptmcalc.laws import classification


class TestClasses:
    def test_case_c27(self) -> None:
        cycles = np.array([2e4, 3e4, 5e4])
        factor = classification.spectrum_factor(cycles / cycles.sum(), [1.0, 0.6, 0.3])
        assert factor == pytest.approx(0.2783, rel=1e-9)
        assert classification.equivalent_load(factor) == pytest.approx(0.652887, rel=1e-5)
        use, load = classification.use_of_cycles(cycles.sum()), classification.load_class(factor)
        assert (use, load, classification.group(use, load)) == (3, 3, 4)  # U3, Q3, A4

    def test_cycle_by_cycle(self) -> None:
        loads = np.repeat([1.0, 0.6, 0.3], [2, 3, 5])
        assert classification.spectrum_factor([0.2, 0.3, 0.5], [1.0, 0.6, 0.3]) == pytest.approx(np.mean(loads**3))

    def test_the_diagonals_of_the_standard(self) -> None:
        """ISO 4301-1: U4 and Q2 are A4, U9 and Q4 A8; T5 and L3 are M6."""
        assert classification.group(4, 2) == 4
        assert (classification.group(0, 1), classification.group(9, 4)) == (1, 8)
        assert classification.group(classification.use_of_hours(6300), 3) == 6

    @pytest.mark.parametrize(("cycles", "use"), [(16e3, 0), (16001, 1), (63e3, 2), (4e6, 8), (4.1e6, 9)])
    def test_classes_of_use(self, cycles: float, use: int) -> None:
        assert classification.use_of_cycles(cycles) == use

    def test_spectra_at_their_limits(self) -> None:
        assert [classification.load_class(k) for k in (0.1, 0.125, 0.13, 0.5, 0.51, 1.0)] == [1, 1, 2, 3, 4, 4]

    def test_every_cell_of_the_table(self) -> None:
        """ISO 4301-1, groups of cranes as printed: rows Q1 to Q4, columns U0 to U9."""
        table = ["1112345678", "1123456788", "1234567888", "2345678888"]
        found = [[classification.group(use, load) for use in range(10)] for load in range(1, 5)]
        assert found == [[int(cell) for cell in row] for row in table]

    def test_limits_rise(self) -> None:
        for limits in (
            classification.USE_CYCLES,
            classification.USE_HOURS,
            classification.SPECTRA,
            classification.SPECTRA_EN_13001,
        ):
            assert tuple(sorted(limits)) == limits

    def test_a_limit_belongs_to_its_class_also_after_arithmetic(self) -> None:
        hours = 6300.0
        seconds = np.nextafter(hours * 3600, np.inf)
        assert seconds / 3600 > hours
        assert classification.use_of_hours(seconds / 3600) == classification.use_of_hours(hours) == 5
        assert classification.use_of_cycles(np.nextafter(16e3, np.inf)) == 0
        assert classification.load_class(sum([0.1 * 5**3 / 1000] * 10)) == 1  # 0.125, in ten parts

    def test_ends(self) -> None:
        assert classification.use_of_cycles(0.0) == 0
        assert classification.use_of_cycles(1e12) == 9
        assert classification.use_of_hours(1e12) == 9
        assert classification.load_class(0.0) == 1
        assert classification.load_class_en_13001(0.0) == 0
        assert (classification.load_class(1.2), classification.load_class_en_13001(1.2)) == (4, 5)

    def test_both_standards_number_the_same_spectra(self) -> None:
        for k in np.linspace(0.07, 1.0, 94):
            assert classification.load_class_en_13001(k) == classification.load_class(k) + 1 or k <= 0.125
        assert [classification.load_class_en_13001(k) for k in (0.03, 0.06, 0.12)] == [0, 1, 2]


def test_a_class_holds_its_limit_to_the_last_digits_and_no_more() -> None:
    for classify, limits, first in (
        (classification.use_of_cycles, classification.USE_CYCLES, 0),
        (classification.use_of_hours, classification.USE_HOURS, 0),
        (classification.load_class_en_13001, classification.SPECTRA_EN_13001[:-1], 0),
        (classification.load_class, classification.SPECTRA[:-1], 1),
    ):
        for number, limit in enumerate(limits, first):
            assert classify(limit * (1 + 3e-14)) == number
            assert classify(limit * (1 + 1e-10)) == number + 1
