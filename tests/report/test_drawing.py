"""Texts in lines: what belongs together stays in one."""

import pytest

from ptmcalc.report.drawing import paragraph, together

GLUED = "\xa0"


@pytest.mark.parametrize(
    ("text", "kept"),
    [
        ("from 12 kN up", "from 12~kN up"),
        ("0.5 s, then 3.15 m/s; 1600 N/mm.", "0.5~s, then 3.15~m/s; 1600~N/mm."),
        ("4.2 kg*m^2 (85 %)", "4.2~kg*m^2 (85~%)"),
        ("83.56 ±0.36 kN", "83.56~±0.36~kN"),
        ("margin ≥ 1.2 and ≤ -3 kN", "margin ≥~1.2 and ≤~-3~kN"),
        ("E = 0.663 ≥ 0.05", "E = 0.663 ≥~0.05"),
        ("in 20 cases", "in 20 cases"),  # no unit begins a word
        ("1 more, 2 masses, 3 bars, 4 1", "1 more, 2 masses, 3 bars, 4 1"),
    ],
)
def test_a_number_keeps_its_unit_and_its_bar(text: str, kept: str) -> None:
    assert together(text) == kept.replace("~", GLUED)


@pytest.mark.parametrize("width", range(16, 60))
def test_no_line_of_a_paragraph_ends_between_a_number_and_its_unit(width: int) -> None:
    text = "the belt slips from 12.5 kN on, at 3.15 m/s and 40 rad/s^2, where ≥ 1.2 kN is wanted; 97 % of 20 kg*m^2"
    lines = paragraph(text, width, " ", "   ")
    assert " ".join(line.strip() for line in lines) == text
    assert all(len(line) <= width for line in lines)
    assert not [line for line in lines if line[-1] in "≥0123456789" and line is not lines[-1]]
    assert all(line.startswith("   ") for line in lines[1:])
