"""The unit table against Pint, and what is refused instead of guessed.

Pint knows nothing of ours. Its definitions are read with one line changed, `radian = [angle]`, so that angle is
a dimension there too and revolutions per minute and hertz differ in both.
"""

import math
import re
from fractions import Fraction
from pathlib import Path
from typing import Any

import pint
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from ptmcalc.base import units
from ptmcalc.base.units import (
    ANGLE,
    ANGULAR_SPEED,
    FLOW,
    FORCE,
    FREQUENCY,
    IMPEDANCE,
    INERTIA,
    LENGTH,
    LINE_FORCE,
    LINE_MASS,
    LINE_STIFFNESS,
    MASS,
    POWER,
    RATIO,
    SHARE,
    SPAN,
    SPEED,
    STRESS,
    TIME,
    TORQUE,
    UNITS,
    Quantity,
    UnitError,
    display_unit,
    read,
    show,
    unit_of,
)

QUANTITIES = [value for value in vars(units).values() if isinstance(value, Quantity)]
PINT_NAMES = {"1": "dimensionless", "%": "percent", "t": "metric_ton", "rev": "revolution", "°": "degree"}
BASE = ("[mass]", "[length]", "[time]", "[angle]", "[temperature]")


@pytest.fixture(scope="module")
def registry(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Pint's own definitions with angle as a dimension."""
    shipped = Path(pint.__file__).parent
    folder = tmp_path_factory.mktemp("pint")
    text = (shipped / "default_en.txt").read_text("utf-8")
    assert text.count("radian = []") == 1
    (folder / "default_en.txt").write_text(text.replace("radian = []", "radian = [angle]"), "utf-8")
    (folder / "constants_en.txt").write_text((shipped / "constants_en.txt").read_text("utf-8"), "utf-8")
    return pint.UnitRegistry(str(folder / "default_en.txt"))


def si(quantity: Any) -> tuple[float, tuple[int, ...]]:
    """Magnitude in base units and exponents of mass, length, time and angle of a Pint quantity."""
    assert set(quantity.dimensionality) <= set(BASE)
    return quantity.to_base_units().magnitude, tuple(int(quantity.dimensionality.get(base, 0)) for base in BASE)


def error_of(text: str, quantity: Quantity) -> UnitError:
    with pytest.raises(UnitError) as caught:
        read(text, quantity)
    return caught.value


def outcome(text: str, quantity: Quantity) -> float | UnitError:
    try:
        return read(text, quantity)
    except UnitError as error:
        return error


def copyable(hint: str) -> list[str]:
    """What a hint shows between backticks."""
    return re.findall(r"`([^`]+)`", hint)


# --- the table -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", UNITS)
def test_every_unit_is_what_pint_says(name: str, registry: Any) -> None:
    factor, dimension = si(registry.Quantity(1.0, PINT_NAMES.get(name, name)))
    assert unit_of(name) == (pytest.approx(factor, rel=1e-15), dimension)


@pytest.mark.parametrize(
    ("text", "same"),
    [
        ("kg*m^2", "kg*m**2"),
        ("kg*m2", "kg*m**2"),
        ("kg·m²", "kg*m**2"),
        ("kg×m²", "kg*m**2"),
        ("N*s/m", "N*s/m"),
        ("kN*s/m", "kN*s/m"),
        ("N/mm2", "N/mm**2"),
        ("N/mm²", "N/mm**2"),
        ("N/mm^2", "N/mm**2"),
        ("t/h", "metric_ton/hour"),
        ("m/s^2", "m/s**2"),
        ("s^-1", "1/s"),
        ("s^−1", "1/s"),  # the minus sign U+2212
        ("1/min", "1/minute"),
        ("rev/min", "revolution/minute"),
        ("deg/s", "degree/second"),
        ("kN/m", "kN/m"),
        ("MN/m", "MN/m"),
        ("kN*m", "kN*m"),
        ("kg/m^3", "kg/m**3"),
        ("mm^4", "mm**4"),
        ("W/kg*s", "W/(kg*s)"),  # all that follows the slash is below it
        ("kN * m", "kN*m"),
        ("kg / m", "kg/m"),
    ],
)
def test_products_powers_and_one_slash(text: str, same: str, registry: Any) -> None:
    factor, dimension = si(registry.Quantity(1.0, registry.parse_units(same)))
    assert unit_of(text) == (pytest.approx(factor, rel=1e-14), dimension)


FACTORS = st.lists(st.tuples(st.sampled_from(sorted(UNITS)), st.integers(-3, 3)), min_size=1, max_size=3)


def written(factors: list[tuple[str, int]]) -> str:
    return "*".join(name if power == 1 else f"{name}^{power}" for name, power in factors)


@settings(deadline=None)
@given(above=FACTORS, below=st.just([]) | FACTORS)
def test_any_product_of_units_is_what_pint_says(
    registry: Any, above: list[tuple[str, int]], below: list[tuple[str, int]]
) -> None:
    same = registry.Quantity(1.0)
    for factors, sign in ((above, 1), (below, -1)):
        for name, power in factors:
            same = same * registry.Quantity(1.0, PINT_NAMES.get(name, name)) ** (sign * power)
    factor, dimension = si(same)
    text = written(above) + ("/" + written(below) if below else "")
    assert unit_of(text) == (pytest.approx(factor, rel=1e-12), dimension)


@pytest.mark.parametrize("text", ["N/m/s", "N//m", "kg/m/s^2"])
def test_a_second_slash_is_refused(text: str) -> None:
    with pytest.raises(UnitError) as caught:
        unit_of(text)
    assert caught.value.code == "unit"
    assert "more than one slash" in caught.value.reason


@pytest.mark.parametrize(
    "text", ["", "*m", "m*", "N/", "/s", "m**2", "m^", "m^1.5", "m^10", "N/(m*s)", "R", "psi", "C", "m_s", "2*m"]
)
def test_what_is_not_in_the_table_is_refused(text: str) -> None:
    with pytest.raises(UnitError) as caught:
        unit_of(text)
    assert caught.value.code == "unit"


# --- quantities ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("quantity", QUANTITIES, ids=lambda quantity: quantity.name)
def test_the_units_a_quantity_is_shown_in_are_its_own_and_grow(quantity: Quantity) -> None:
    assert unit_of(quantity.si)[0] == 1.0
    factors = [unit_of(unit)[0] for unit in quantity.display]
    assert {unit_of(unit)[1] for unit in quantity.display} == {quantity.dimension}
    assert factors == sorted(set(factors))


@pytest.mark.parametrize("quantity", QUANTITIES, ids=lambda quantity: quantity.name)
def test_the_example_of_a_quantity_can_be_read(quantity: Quantity) -> None:
    assert read(quantity.example, quantity) > 0


@pytest.mark.parametrize(
    ("text", "quantity", "value"),
    [
        ("1200 mm", LENGTH, Fraction(6, 5)),
        ("1200mm", LENGTH, Fraction(6, 5)),
        ("  1200   mm  ", LENGTH, Fraction(6, 5)),
        ("+3.15 m/s", SPEED, Fraction(63, 20)),
        ("-18 m", SPAN, -18),
        (".5 m", SPAN, Fraction(1, 2)),
        ("5. m", SPAN, 5),
        ("1.5e3 kg", MASS, 1500),
        ("1.5E+3 kg", MASS, 1500),
        ("1e-3 t", MASS, 1),
        ("1500 t/h", FLOW, Fraction(1500, 3) / Fraction(6, 5)),
        ("1600 N/mm", LINE_FORCE, 1_600_000),
        ("210 N/mm2", STRESS, 210_000_000),
        ("4.2 kg*m^2", INERTIA, Fraction(21, 5)),
        ("0.94", RATIO, Fraction(47, 50)),
        ("94 %", RATIO, Fraction(47, 50)),
        ("94%", RATIO, Fraction(47, 50)),
        ("2 rev", ANGLE, 4 * Fraction(math.pi)),
        ("180°", ANGLE, Fraction(math.pi)),
        ("60 rpm", ANGULAR_SPEED, 2 * Fraction(math.pi)),
        ("60 rev/min", ANGULAR_SPEED, 2 * Fraction(math.pi)),
        ("30 1/min", FREQUENCY, Fraction(1, 2)),
    ],
)
def test_text_to_si(text: str, quantity: Quantity, value: Fraction) -> None:
    assert read(text, quantity) == pytest.approx(float(value), rel=1e-15)


MAGNITUDES = st.floats(1e-250, 1e250) | st.floats(-1e250, -1e-250) | st.floats(1e-3, 1e9)


@settings(max_examples=500, deadline=None)
@given(value=MAGNITUDES, quantity=st.sampled_from(QUANTITIES), significant=st.integers(1, 15))
@example(value=999.96, quantity=FORCE, significant=4)
@example(value=9.9999e6, quantity=RATIO, significant=4)
@example(value=1.0, quantity=RATIO, significant=4)
@example(value=0.001, quantity=SHARE, significant=1)
def test_what_is_shown_reads_back_within_the_digits_shown(value: float, quantity: Quantity, significant: int) -> None:
    again = read(show(value, quantity, significant), quantity)
    assert again == pytest.approx(value, rel=0.5 * 10.0 ** (1 - significant) + 1e-14)


@pytest.mark.parametrize("quantity", QUANTITIES, ids=lambda quantity: quantity.name)
def test_zero_is_shown_without_sign_and_reads_back(quantity: Quantity) -> None:
    assert read(show(-0.0, quantity), quantity) == 0.0
    assert show(-0.0, quantity).split()[0] == "0"


@pytest.mark.parametrize(
    ("value", "quantity", "text"),
    [
        (189504.0, FORCE, "189.5 kN"),
        (-189504.0, FORCE, "-189.5 kN"),
        (999.0, FORCE, "999 N"),
        (1000.0, FORCE, "1 kN"),
        (2.5e6, FORCE, "2.5 MN"),
        (0.25, FORCE, "0.25 N"),
        (0.85, LENGTH, "850 mm"),
        (1.2, LENGTH, "1.2 m"),
        (0.0058, SHARE, "0.58 %"),
        (1.2, RATIO, "1.2"),
        (1.0, RATIO, "1"),
        (155.50883635269474, ANGULAR_SPEED, "1485 rpm"),
        (1234.5678, SPAN, "1235 m"),
        (1.5e9, SPAN, "1.500e+09 m"),
        (0.00001, SPAN, "1.000e-05 m"),
    ],
)
def test_a_value_is_shown_in_the_largest_unit_that_keeps_it_at_one_or_above(
    value: float, quantity: Quantity, text: str
) -> None:
    assert show(value, quantity) == text


@given(value=st.floats(1e-6, 1e12), quantity=st.sampled_from(QUANTITIES))
def test_the_unit_shown_does_not_depend_on_the_sign(value: float, quantity: Quantity) -> None:
    assert display_unit(value, quantity) == display_unit(-value, quantity)


# --- what is refused -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", UNITS)
def test_a_unit_of_another_dimension_is_refused(name: str) -> None:
    for quantity in QUANTITIES:
        if unit_of(name)[1] == quantity.dimension:
            assert read(f"5 {name}", quantity) == pytest.approx(5 * unit_of(name)[0])
        else:
            assert error_of(f"5 {name}", quantity).code == "dimension"


def test_a_wrong_dimension_is_named_beside_the_right_one() -> None:
    error = error_of("15 kg", LINE_MASS)
    assert error.reason == "`15 kg` is a mass, not a mass per length"
    assert copyable(error.hint) == ["24 kg/m"]


def test_angle_is_a_dimension() -> None:
    assert error_of("5 rad", RATIO).code == "dimension"
    assert error_of("0.5", ANGLE).code == "bare"
    assert error_of("3 rad/s", FREQUENCY).code == "dimension"


@pytest.mark.parametrize("text", ["10 Hz", "1485 1/min", "1485 min^-1", "24.7 1/s"])
def test_a_frequency_is_not_a_rotational_speed(text: str) -> None:
    error = error_of(text, ANGULAR_SPEED)
    assert error.code == "dimension"
    assert "rpm" in error.hint


@pytest.mark.parametrize("text", ["60 rpm", "60 rev/min", "6.3 rad/s", "360 deg/s"])
def test_a_rotational_speed_is_not_a_frequency(text: str) -> None:
    error = error_of(text, FREQUENCY)
    assert error.code == "dimension"
    assert "Hz" in error.hint


@pytest.mark.parametrize(
    "quantity", [quantity for quantity in QUANTITIES if quantity.dimension != RATIO.dimension], ids=lambda q: q.name
)
def test_a_bare_number_is_refused_and_the_hint_gives_it_a_unit(quantity: Quantity) -> None:
    error = error_of("5", quantity)
    assert error.code == "bare"
    assert [read(text, quantity) for text in copyable(error.hint)] == [
        pytest.approx(5 * unit_of(unit)[0]) for unit in quantity.display
    ]


@pytest.mark.parametrize(
    ("text", "quantity", "value"),
    [
        ("3,5 m", SPAN, 3.5),
        ("-3,5 m", SPAN, -3.5),
        ("3,5m", SPAN, 3.5),
        ("0,35", RATIO, 0.35),
        ("1,5 %", RATIO, 0.015),
        ("1,5e3 kg", MASS, 1500.0),
        (" 12,5 kN ", FORCE, 12_500.0),
    ],
)
def test_a_decimal_comma_is_refused_and_the_hint_has_a_point(text: str, quantity: Quantity, value: float) -> None:
    error = error_of(text, quantity)
    assert error.code == "comma"
    assert [read(fixed, quantity) for fixed in copyable(error.hint)] == [pytest.approx(value)]


@pytest.mark.parametrize(
    ("text", "quantity", "value"),
    [
        ("1 200 mm", LENGTH, 1.2),
        ("1'200 mm", LENGTH, 1.2),
        ("1_200 mm", LENGTH, 1.2),
        ("12 500 000 N", FORCE, 12.5e6),
        ("1 200.5 kg", MASS, 1200.5),
        ("2 880 t/h", FLOW, 800.0),
        ("1 000", RATIO, 1000.0),
        ("1 150 mm", LENGTH, 1.15),
        ("2 100 m", SPAN, 2100.0),
        ("1 100", RATIO, 1100.0),
    ],
)
def test_grouped_digits_are_refused_and_the_hint_joins_them(text: str, quantity: Quantity, value: float) -> None:
    error = error_of(text, quantity)
    assert error.code == "number"
    assert [read(fixed, quantity) for fixed in copyable(error.hint)] == [pytest.approx(value)]


@pytest.mark.parametrize(
    ("text", "quantity"), [("1,200,000 N", FORCE), ("1.200,5 m", SPAN), ("1 200,5 mm", LENGTH), ("1.200.000 N", FORCE)]
)
def test_groups_and_commas_together_get_a_hint_that_can_be_copied(text: str, quantity: Quantity) -> None:
    shown = copyable(error_of(text, quantity).hint)
    assert shown
    assert all(math.isfinite(read(fixed, quantity)) for fixed in shown)


@pytest.mark.parametrize(
    ("text", "quantity", "readings"),
    [
        ("30,000 N", FORCE, [30.0, 30_000.0]),
        ("-1,200 m", SPAN, [-1.2, -1200.0]),
        ("0,022", RATIO, [0.022]),
        ("1200,125 m", SPAN, [1200.125]),
    ],
)
def test_a_comma_before_three_digits_is_not_guessed_to_be_either(
    text: str, quantity: Quantity, readings: list[float]
) -> None:
    error = error_of(text, quantity)
    assert error.code == "comma"
    assert [read(shown, quantity) for shown in copyable(error.hint)] == [pytest.approx(value) for value in readings]


@pytest.mark.parametrize("text", ["1\u00a0200 mm", "1\u202f200 mm", "1\u2009200 mm"])
def test_a_blank_that_does_not_break_groups_digits_too(text: str) -> None:
    assert copyable(error_of(text, LENGTH).hint) == ["1200 mm"]


@pytest.mark.parametrize("text", ["nan", ".nan", "NaN", "inf", "-inf", ".inf", "+.INF", "infinity", "1e400", "-1e400"])
@pytest.mark.parametrize("unit", ["", " m"])
def test_nan_and_infinity_are_refused(text: str, unit: str) -> None:
    assert error_of(text + unit, SPAN).code == "finite"
    assert error_of(text, RATIO).code == "finite"


def test_a_number_that_overflows_only_in_si_is_refused() -> None:
    assert read("1e305 m", SPAN) == 1e305
    assert error_of("1e306 km", SPAN).code == "finite"


@pytest.mark.parametrize(
    "text",
    ["", " ", "m", "abc", "--5 m", "5;3 m", "1/2 m", "~5 m", "> 5 m", "5 ± 1 m", "1.5.2 m", "٣ m", "5 / m", "m 5"],
)
def test_what_is_no_number_is_refused(text: str) -> None:
    error = error_of(text, SPAN)
    assert error.code == "number"
    assert [read(shown, SPAN) for shown in copyable(error.hint)] == [850.0]


@pytest.mark.parametrize(
    ("text", "quantity"),
    [
        ("24 13", RATIO),  # two numbers are no ratio of 24
        ("0.9 14", RATIO),
        ("5 m m", LENGTH),  # a product in SI notation, not millimetres
        ("5 m s", TIME),
        ("12 k N", FORCE),
        ("5 11", RATIO),
        ("5 1x", RATIO),
    ],
)
def test_a_blank_inside_a_unit_is_not_guessed_away(text: str, quantity: Quantity) -> None:
    assert error_of(text, quantity).code in ("unit", "number")


@pytest.mark.parametrize(
    ("wrong", "quantity", "right"),
    [
        ("ton", MASS, "t"),
        ("tons", MASS, "t"),
        ("tonne", MASS, "t"),
        ("mt", MASS, "t"),
        ("ton/h", FLOW, "t"),
        ("lb", MASS, "kg"),
        ("Kg", MASS, "kg"),
        ("U/min", ANGULAR_SPEED, "rpm"),
        ("RPM", ANGULAR_SPEED, "rpm"),
        ("kgf", FORCE, "N"),
        ("kp", FORCE, "N"),
        ("tf", FORCE, "kN"),
        ("lbf", FORCE, "N"),
        ("KN", FORCE, "kN"),
        ("kgm2", INERTIA, "kg*m^2"),
        ("kg m^2", INERTIA, "kg*m^2"),
        ("Nm", TORQUE, "N*m"),
        ("N m", TORQUE, "N*m"),
        ("kNm", TORQUE, "kN*m"),
        ("Nmm", TORQUE, "N*m"),
        ("sec", TIME, "s"),
        ("grad", ANGLE, "deg"),
        ("degrees", ANGLE, "deg"),
        ("hp", POWER, "kW"),
        ("PS", POWER, "kW"),
        ("ft", SPAN, "m"),
        ("in", LENGTH, "mm"),
        ("MM", LENGTH, "mm"),
        ("fpm", SPEED, "m/s"),
        ("Mpa", STRESS, "MPa"),
        ("kN*sec/m", IMPEDANCE, "kN*s/m"),
        ("mN", FORCE, "N"),
        ("mPa", STRESS, "Pa"),
        ("mW", POWER, "W"),
        ("lb/m", LINE_MASS, "kg/m"),
        ("lb/ft", LINE_MASS, "kg/m"),
        ("°C", ANGLE, "deg"),
        ("k N", FORCE, "kN"),
        ("kN s / m", IMPEDANCE, "kN*s/m"),
    ],
)
def test_a_foreign_unit_gets_the_one_to_write_instead(wrong: str, quantity: Quantity, right: str) -> None:
    error = error_of(f"5 {wrong}", quantity)
    assert error.code == "unit"
    assert wrong in error.reason
    assert copyable(error.hint)[0] == right


def test_a_milli_unit_is_not_taken_for_a_mega_unit() -> None:
    assert "MN" not in error_of("5 mN", FORCE).hint
    assert "0.001 N" in error_of("5 mN", FORCE).hint


def test_two_readings_of_a_blank_are_both_shown() -> None:
    assert copyable(error_of("5 m m", LENGTH).hint) == ["m*m", "mm"]


def test_a_ton_is_not_taken_for_a_tonne() -> None:
    hint = error_of("5 ton", MASS).hint
    assert "1000 kg" in hint
    assert "907 kg" in hint
    assert "1016 kg" in hint


CONVERTED = {
    "kgf": ("kilogram_force", FORCE),
    "kp": ("kilogram_force", FORCE),
    "tf": ("metric_ton_force", FORCE),
    "hp": ("horsepower", POWER),
    "PS": ("metric_horsepower", POWER),
    "ft": ("foot", SPAN),
    "in": ("inch", LENGTH),
    "lb": ("pound", MASS),
    "lbf": ("pound_force", FORCE),
    "lb/m": ("pound/meter", LINE_MASS),
    "lb/ft": ("pound/foot", LINE_MASS),
    "fpm": ("foot/minute", SPEED),
}


@pytest.mark.parametrize("wrong", CONVERTED)
def test_the_conversion_in_a_hint_is_right(wrong: str, registry: Any) -> None:
    name, quantity = CONVERTED[wrong]
    hint = error_of(f"5 {wrong}", quantity).hint
    factor, dimension = si(registry.Quantity(1.0, registry.parse_units(name)))
    stated = re.search(r"1 \S+ = ([0-9.]+ \S+?)(?:,|$)", hint)
    assert stated is not None
    assert dimension == quantity.dimension
    assert read(stated[1], quantity) == pytest.approx(factor, rel=1e-4)


@pytest.mark.parametrize("quantity", QUANTITIES, ids=lambda quantity: quantity.name)
def test_an_article_fits_its_noun(quantity: Quantity) -> None:
    other = SPAN if quantity.dimension != SPAN.dimension else MASS
    texts = [error_of("many", quantity).reason, error_of("many", quantity).hint]
    texts += [error_of(quantity.example, other).reason, error_of(other.example, quantity).reason]
    if quantity.dimension != RATIO.dimension:
        texts.append(error_of("5", quantity).reason)
    assert not [text for text in texts if re.search(r"\ba [aeio]", text)]


@pytest.mark.parametrize(
    "text",
    [
        "1 m" + " " * 500_000 + "x",
        "1" + " " * 500_000 + "x",
        " " * 500_000,
        "9" * 500_000 + ",",
        "1" + ",000" * 200_000 + "x",
        "1 " + "m*" * 50_000,
        "1 " + "q" * 500_000,
        "1 m/" + "mm^9*" * 50 + "mm^9",  # below the slash a factor of 0
    ],
)
def test_a_long_value_is_refused_at_once(text: str) -> None:
    """Reading by a pattern that tries every split of such a text would not end while anyone waits."""
    assert len(error_of(text, SPAN).reason) < 200


@settings(max_examples=300)
@given(text=st.text(max_size=30) | st.text("0123456789.,eE+-_ 'kgNmt/h*^°%²1in", max_size=20))
def test_any_text_is_a_finite_number_or_an_error_with_reason_and_hint(text: str) -> None:
    for quantity in (RATIO, SPAN, INERTIA):
        found = outcome(text, quantity)
        if isinstance(found, UnitError):
            assert found.code in {"comma", "number", "bare", "unit", "dimension", "finite"}
            assert found.reason
            assert found.hint
        else:
            assert math.isfinite(found)


@given(value=st.floats(allow_nan=False, allow_infinity=False), unit=st.sampled_from(["mm", "m", "km"]))
def test_a_number_python_writes_is_read_to_the_last_bit(value: float, unit: str) -> None:
    assume(math.isfinite(value * unit_of(unit)[0]))
    assert read(f"{value!r} {unit}", SPAN) == value * unit_of(unit)[0]


def test_stiffness_per_width_has_the_dimension_of_force_per_length() -> None:
    assert read("72000 N/mm", LINE_STIFFNESS) == read("72 MN/m", LINE_FORCE) == pytest.approx(72e6)
