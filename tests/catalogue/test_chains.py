"""The table of roller chains: values known from elsewhere, and rules that every line keeps."""

import re

import pytest

from ptmcalc.catalogue.chains import nearest, roller_chain
from ptmcalc.catalogue.table import rows

INCH, POUND = 25.4e-3, 4.4482216
NUMBERS = [row["standard"] for row in rows("chains_iso606")]


@pytest.mark.parametrize(
    ("number", "pitch", "pin", "strength"),
    [
        ("08B-1", 12.7, 4.45, 17.8),
        ("10B-1", 15.875, 5.08, 22.2),
        ("16B-1", 25.4, 8.28, 60.0),
        ("16B-2", 25.4, 8.28, 106.0),
        ("16B-3", 25.4, 8.28, 160.0),
        ("20B-1", 31.75, 10.19, 95.0),
        ("08A-1", 12.7, 3.98, 13.9),
        ("16A-1", 25.4, 7.94, 55.6),
    ],
)
def test_values_of_handbooks(number: str, pitch: float, pin: float, strength: float) -> None:
    chain = roller_chain(number)
    assert chain is not None
    assert (chain.pitch, chain.pin_diameter, chain.breaking_load) == pytest.approx(
        (pitch / 1e3, pin / 1e3, strength * 1e3)
    )


@pytest.mark.parametrize("number", NUMBERS)
def test_the_number_states_pitch_and_rows(number: str) -> None:
    """Sixteenths of an inch, and the suffix."""
    chain = roller_chain(number)
    assert chain is not None
    size, strands = (int(part) for part in re.findall(r"\d+", number))
    assert chain.pitch == pytest.approx(size / 16 * INCH)
    assert chain.rows == strands
    assert chain.mass_low <= chain.mass <= chain.mass_high


@pytest.mark.parametrize("number", [one for one in NUMBERS if "A" in one])
def test_the_strength_of_the_a_series(number: str) -> None:
    """ASME B29.1: 12 500 lbf times the square of the pitch in inches for each row."""
    chain = roller_chain(number)
    assert chain is not None
    rule = 12_500 * POUND * (chain.pitch / INCH) ** 2 * chain.rows
    assert chain.breaking_load == pytest.approx(rule, rel=0.01)


@pytest.mark.parametrize(
    ("number", "area"),
    [("08B-1", 0.50), ("10B-1", 0.67), ("12B-1", 0.89), ("16B-1", 2.10), ("20B-1", 2.96), ("24B-1", 5.54),
     ("08A-1", 0.44), ("10A-1", 0.70), ("12A-1", 1.05), ("16A-1", 1.79), ("20A-1", 2.61), ("24A-1", 3.92)],
)  # fmt: skip
def test_the_bearing_area(number: str, area: float) -> None:
    """Bearing areas of handbooks [cm^2], pin times bush."""
    chain = roller_chain(number)
    assert chain is not None
    assert chain.pin_diameter * chain.pin_length * 1e4 == pytest.approx(area, rel=0.02)


def test_names() -> None:
    for name in ("16A-1", "16a", "ANSI 80", "80-1", "ansi 80-1", " 80 "):
        chain = roller_chain(name)
        assert chain is not None
        assert chain.number == "16A-1", name
    duplex = roller_chain("ANSI 80-2")
    assert duplex is not None
    assert (duplex.number, duplex.title) == ("16A-2", "16A-2 (ANSI 80)")
    assert [roller_chain(name) for name in ("", "16C-1", "16B-4", "ANSI 85", "chain", "16B-1 x")] == 6 * [None]


def test_the_nearest_numbers() -> None:
    assert nearest("17B-1")[0] == "16B-1"
    assert nearest("18B-2")[0] in ("16B-2", "20B-2")
    assert nearest("16B-4")[0] == "16B-3"
    assert nearest("ANSI 85")[0] == "80-1"
    assert len(nearest("no chain")) == 3
    for name in ("17B-1", "16B-4", "ANSI 85", "16C-1", "no chain", ""):
        assert all(roller_chain(one) for one in nearest(name)), name
