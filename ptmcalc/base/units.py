"""Units: text with a unit in, SI floats inside, readable text out.

The table is closed: a unit that is not in it is an error, never a guess. Angle is a dimension of its own,
so revolutions per minute (angle/time) and hertz (1/time) cannot be mistaken for each other.

A unit is a product of factors with at most one slash: `kg*m^2`, `N*s/m`, `t/h`, `N/mm2`. Blanks stand round a `*`
or a `/`, not inside: `m m` may mean a product or a millimetre.
"""

import difflib
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from types import MappingProxyType

from ptmcalc.base.words import quote, with_article

Dimension = tuple[int, int, int, int, int]
"""Exponents of mass, length, time, angle, temperature."""

_PURE: Dimension = (0, 0, 0, 0, 0)
_FORCE: Dimension = (1, 1, -2, 0, 0)
_PRESSURE: Dimension = (1, -1, -2, 0, 0)
_ENERGY: Dimension = (1, 2, -2, 0, 0)
_POWER: Dimension = (1, 2, -3, 0, 0)

UNITS: Mapping[str, tuple[float, Dimension]] = MappingProxyType(
    {
        "1": (1.0, _PURE),
        "%": (1e-2, _PURE),
        "kg": (1.0, (1, 0, 0, 0, 0)),
        "g": (1e-3, (1, 0, 0, 0, 0)),
        "t": (1e3, (1, 0, 0, 0, 0)),
        "m": (1.0, (0, 1, 0, 0, 0)),
        "mm": (1e-3, (0, 1, 0, 0, 0)),
        "cm": (1e-2, (0, 1, 0, 0, 0)),
        "km": (1e3, (0, 1, 0, 0, 0)),
        "s": (1.0, (0, 0, 1, 0, 0)),
        "ms": (1e-3, (0, 0, 1, 0, 0)),
        "min": (60.0, (0, 0, 1, 0, 0)),
        "h": (3600.0, (0, 0, 1, 0, 0)),
        "Hz": (1.0, (0, 0, -1, 0, 0)),
        "rad": (1.0, (0, 0, 0, 1, 0)),
        "mrad": (1e-3, (0, 0, 0, 1, 0)),
        "deg": (math.pi / 180, (0, 0, 0, 1, 0)),
        "°": (math.pi / 180, (0, 0, 0, 1, 0)),
        "rev": (2 * math.pi, (0, 0, 0, 1, 0)),
        "rpm": (2 * math.pi / 60, (0, 0, -1, 1, 0)),
        "N": (1.0, _FORCE),
        "kN": (1e3, _FORCE),
        "MN": (1e6, _FORCE),
        "Pa": (1.0, _PRESSURE),
        "kPa": (1e3, _PRESSURE),
        "MPa": (1e6, _PRESSURE),
        "GPa": (1e9, _PRESSURE),
        "bar": (1e5, _PRESSURE),
        "J": (1.0, _ENERGY),
        "kJ": (1e3, _ENERGY),
        "MJ": (1e6, _ENERGY),
        "kWh": (3.6e6, _ENERGY),
        "W": (1.0, _POWER),
        "kW": (1e3, _POWER),
        "MW": (1e6, _POWER),
        "K": (1.0, (0, 0, 0, 0, 1)),
    }
)

_HINTS: Mapping[str, str] = MappingProxyType(
    {
        "ton": "a tonne is `t` (1000 kg); a US ton (907 kg) or a UK ton (1016 kg) must be converted",
        "tons": "a tonne is `t` (1000 kg); a US ton (907 kg) or a UK ton (1016 kg) must be converted",
        "tonne": "write `t`",
        "mt": "a tonne is `t`",
        "U/min": "write `rpm`",
        "kgf": "a force is `N`: 1 kgf = 9.80665 N",
        "kp": "a force is `N`: 1 kp = 9.80665 N",
        "tf": "a force is `kN`: 1 tf = 9.80665 kN",
        "kgm2": "write `kg*m^2`",
        "Nm": "write `N*m`",
        "kNm": "write `kN*m`",
        "Nmm": "write the torque in `N*m`",
        "sec": "write `s`",
        "grad": "write `deg` (a gon is 0.9 deg)",
        "degree": "write `deg`",
        "degrees": "write `deg`",
        "hp": "write `kW`: 1 hp = 0.7457 kW, 1 metric horsepower = 0.7355 kW",
        "PS": "write `kW`: 1 PS = 0.7355 kW",
        "ft": "write `m`: 1 ft = 0.3048 m",
        "in": "write `mm`: 1 in = 25.4 mm",
        "lb": "write `kg`: 1 lb = 0.45359 kg",
        "lbf": "write `N`: 1 lbf = 4.44822 N",
        "lb/m": "write `kg/m`: 1 lb/m = 0.45359 kg/m",
        "lb/ft": "write `kg/m`: 1 lb/ft = 1.48816 kg/m",
        "fpm": "write `m/s`: 1 ft/min = 0.00508 m/s",
        "J/(kg*K)": "write `J/kg*K`",
        "°C": "an angle is in `deg`, a temperature difference in `K`",
    }
)


class UnitError(ValueError):
    """A quantity that cannot be read: `reason` says why, `hint` what to write instead, `code` which kind."""

    def __init__(self, code: str, reason: str, hint: str = "") -> None:
        super().__init__(reason)
        self.code, self.reason, self.hint = code, reason, hint


@dataclass(frozen=True, slots=True)
class Quantity:
    """A physical quantity as the field uses it: its SI unit, the units it is shown in, an example to copy.

    `display` is ordered from small to large; the largest unit that keeps the number at 1 or above is shown.
    """

    name: str
    si: str
    display: tuple[str, ...]
    example: str
    aside: tuple[str, float] | None = None
    """a second unit to show in brackets, and what the SI value is multiplied with for it"""

    @property
    def dimension(self) -> Dimension:
        return unit_of(self.si)[1]


def _quantity(name: str, si: str, *display: str, example: str) -> Quantity:
    return Quantity(name, si, display or (si,), example)


RATIO = _quantity("ratio", "1", example="0.94")
FACTOR = _quantity("ratio", "1", example="1.2")
SHARE = _quantity("ratio", "1", "%", example="1 %")
OVERLOAD = _quantity("ratio", "1", example="2.5")
SLIP = _quantity("slip", "1", "%", example="0.03")
MASS = _quantity("mass", "kg", "kg", "t", example="1200 kg")
LENGTH = _quantity("length", "m", "mm", "m", example="1200 mm")
SPAN = _quantity("distance", "m", "m", example="850 m")
TIME = _quantity("time", "s", "ms", "s", example="12 s")
ANGLE = _quantity("angle", "rad", "deg", example="210 deg")
SLOPE = _quantity("angle", "rad", "deg", example="35 deg")
TURN = _quantity("angle", "rad", "rev", example="12 rev")
TILT = _quantity("angle", "rad", "deg", example="5 deg")
SPEED = _quantity("speed", "m/s", "m/s", example="3.15 m/s")
ACCELERATION = _quantity("acceleration", "m/s^2", example="0.3 m/s^2")
ANGULAR_SPEED = _quantity("rotational speed", "rad/s", "rpm", example="1485 rpm")
FREQUENCY = _quantity("frequency", "Hz", example="0.8 Hz")
FORCE = _quantity("force", "N", "N", "kN", "MN", example="12 kN")
LINE_MASS = _quantity("mass per length", "kg/m", example="24 kg/m")
LINE_FORCE = _quantity("force per length", "N/m", "N/mm", example="1600 N/mm")
LINE_STIFFNESS = _quantity("stiffness per width", "N/m", "N/mm", example="72000 N/mm")
FLOW = _quantity("mass flow", "kg/s", "t/h", example="1500 t/h")
TORQUE = _quantity("torque", "N*m", "N*m", "kN*m", example="3000 N*m")
ANGULAR_FREQUENCY = Quantity("angular frequency", "rad/s", ("rad/s",), "15 rad/s", ("Hz", 1 / (2 * math.pi)))
ANGULAR_ACCELERATION = _quantity("angular acceleration", "rad/s^2", example="40 rad/s^2")
TORSIONAL_STIFFNESS = _quantity("torsional stiffness", "N*m/rad", "N*m/rad", "kN*m/rad", example="20 kN*m/rad")
STIFFNESS = _quantity("stiffness", "N/m", "N/m", "kN/m", "MN/m", example="2 MN/m")
TORSIONAL_DAMPING = _quantity("torsional damping", "N*m*s/rad", example="15 N*m*s/rad")
DAMPING = _quantity("damping", "N*s/m", "N*s/m", "kN*s/m", example="6 kN*s/m")
ANGULAR_IMPULSE = _quantity("angular impulse", "N*m*s", example="12 N*m*s")
IMPULSE = _quantity("impulse", "N*s", "N*s", "kN*s", example="2 kN*s")
DENSITY = _quantity("density", "kg/m^3", example="7850 kg/m^3")
TORQUE_SLOPE = _quantity("torque per rotational speed", "N*m*s/rad", example="40 N*m*s/rad")
INERTIA = _quantity("moment of inertia", "kg*m^2", example="4.2 kg*m^2")
IMPEDANCE = _quantity("mechanical impedance", "N*s/m", "N*s/m", "kN*s/m", example="180 kN*s/m")
ENERGY = _quantity("energy", "J", "J", "kJ", "MJ", example="25 kJ")
POWER = _quantity("power", "W", "W", "kW", example="250 kW")
STRESS = _quantity("stress", "Pa", "MPa", example="210 MPa")
AREA = _quantity("area", "m^2", "mm^2", "cm^2", example="1600 mm^2")
FACE = _quantity("area", "m^2", example="60 m^2")
RUNNING_TIME = _quantity("running time", "s", "h", example="20000 h")
WEAR_RATE = _quantity("wear coefficient", "Hz/N", "Hz/MN", example="0.00006 Hz/MN")
WEAR_DEPTH = _quantity("depth of wear over pressure and path", "m^2/N", "mm^2/MN", example="0.0004 mm^2/MN")
THICKNESS = _quantity("length", "m", "mm", example="0.02 mm")
PRESSURE = _quantity("pressure", "Pa", "kPa", "MPa", example="50 kPa")
SECOND_MOMENT = _quantity("second moment of area", "m^4", "cm^4", example="20000 cm^4")
TEMPERATURE_DIFFERENCE = _quantity("temperature difference", "K", example="40 K")
THERMAL_EXPANSION = _quantity("thermal expansion coefficient", "1/K", example="0.000012 1/K")
SPECIFIC_HEAT = _quantity("specific heat", "J/kg*K", example="500 J/kg*K")
SECTION_MODULUS = _quantity("section modulus", "m^3", "cm^3", example="1600 cm^3")

_NUMBER = r"[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
_VALUE = re.compile(rf"((?>{_NUMBER}))\s*((?:[^\W\d_]|[°%]|1(?![0-9])).*|)", re.DOTALL)
_NOT_FINITE = re.compile(r"[-+]?\.?(?:inf|infinity|nan)\b.*", re.IGNORECASE | re.DOTALL)
_COMMA = re.compile(r"([-+]?[0-9]+),((?>[0-9]+))(?!\s?[0-9]|[.,'_][0-9])(.*)", re.DOTALL)
_GROUPS = re.compile(
    r"([-+]?[0-9]{1,3}([\s'_.,])[0-9]{3}(?:\2[0-9]{3})*)(?:(?!\2)[.,]([0-9]+))?(?![0-9])(.*)", re.DOTALL
)
_FACTOR = re.compile(r"([A-Za-z°%]+)(?:\^?([-+]?[0-9]))?|(1)(?:\^([-+]?[0-9]))?")
_SUPERSCRIPT = str.maketrans({"²": "^2", "³": "^3", "⁴": "^4", "·": "*", "×": "*", "−": "-"})


@lru_cache(maxsize=256)
def unit_of(text: str) -> tuple[float, Dimension]:
    """Factor to SI and dimension of a unit: products, one slash, powers.

    Raises UnitError for a unit that is not in the table or is not of that form.
    """
    known = UNITS.get(text)
    if known:
        return known
    plain = _plain(text)
    numerator, slash, denominator = plain.partition("/")
    if "/" in denominator:
        raise UnitError("unit", f"the unit {quote(text)} has more than one slash", "write it with one: `N*s/m`")
    factor, dimension = _product(text, numerator)
    if slash:
        below, of_below = _product(text, denominator)
        factor = factor / below if below else math.inf
        dimension = _combine(dimension, of_below, -1)
    return factor, dimension


def _plain(text: str) -> str:
    """A unit in ASCII, without blanks round its signs."""
    plain = text.translate(_SUPERSCRIPT)
    for sign in "*/" if " " in plain else "":
        plain = sign.join(part.strip() for part in plain.split(sign))
    return plain


def _product(text: str, factors: str) -> tuple[float, Dimension]:
    factor, dimension = 1.0, _PURE
    for part in factors.split("*"):
        match = _FACTOR.fullmatch(part)
        known = UNITS.get(match[1] or match[3]) if match else None
        if match is None or known is None:
            raise UnitError("unit", f"{quote(text)} is an unknown unit", _suggest(_plain(text), part))
        power = int(match[2] or match[4] or 1)
        factor *= known[0] ** power
        dimension = _combine(dimension, known[1], power)
    return factor, dimension


def _combine(a: Dimension, b: Dimension, power: int) -> Dimension:
    return (
        a[0] + power * b[0],
        a[1] + power * b[1],
        a[2] + power * b[2],
        a[3] + power * b[3],
        a[4] + power * b[4],
    )


def _suggest(text: str, part: str) -> str:
    if text in _HINTS:
        return _HINTS[text]
    if text != part and (whole := _converted(text)):
        return whole
    if part in _HINTS:
        return _HINTS[part]
    if without_blanks := [joined for sign in ("*", "") if _is_unit(joined := sign.join(text.split()))]:
        return f"write {' or '.join(f'`{unit}`' for unit in without_blanks)}"
    if part[:1] == "m" and part[1:] in UNITS:  # in lower case: `mN` is no slip of `MN`
        return f"write `{part[1:]}`: 1 {part} = 0.001 {part[1:]}"
    folded = {name.lower(): name for name in UNITS if name != "1"}
    name = re.sub(r"[\^0-9+-]", "", part)
    close = folded.get(name.lower()) or next(iter(difflib.get_close_matches(name, folded.values(), 1)), None)
    if close:
        return f"did you mean `{close}`?"
    return "permitted units: " + " ".join(name for name in UNITS if name not in {"1", "°"})


_FOREIGN: Mapping[str, tuple[str, float]] = MappingProxyType(
    {
        "lb": ("kg", 0.45359237),
        "lbf": ("N", 4.4482216152605),
        "kgf": ("N", 9.80665),
        "kp": ("N", 9.80665),
        "ft": ("m", 0.3048),
        "in": ("m", 0.0254),
        "hp": ("kW", 0.74569987),
        "sec": ("s", 1.0),
    }
)
"""Units outside the table inside a compound one: the unit of the table, and how many of it they are."""


def _converted(text: str) -> str:
    """How a compound unit with parts outside the table is written, with its factor; empty where that is not known."""
    factor, found = 1.0, ""
    above = 1
    for part in re.split(r"([*/])", text):
        if part in ("*", "/"):
            above = -1 if part == "/" else above
            found += part
            continue
        match = _FACTOR.fullmatch(part)
        name = (match[1] or "") if match else ""
        if name in UNITS or part == "1":
            found += part
        elif match and name in _FOREIGN:
            unit, size = _FOREIGN[name]
            power = int(match[2] or 1)
            factor *= size ** (above * power)
            found += unit if power == 1 else f"{unit}^{power}"
        else:
            return ""
    return f"write `{found}`: 1 {text} = {factor:.6g} {found}" if _is_unit(found) else ""


def _is_unit(text: str) -> bool:
    factors = [_FACTOR.fullmatch(part) for part in re.split(r"[*/]", text)]
    return all(match and (match[1] or match[3]) in UNITS for match in factors)


def read(text: str, quantity: Quantity) -> float:
    """SI value of `text`, e.g. `read("1200 mm", LENGTH)` is 1.2.

    Raises UnitError with a code: `comma` (decimal comma), `number` (no number in front), `bare` (unit missing),
    `unit` (unknown unit), `dimension` (unit of something else), `finite` (NaN or infinite).
    """
    text = text.strip()
    match = _VALUE.fullmatch(text)
    if match is None:
        raise _not_a_number(text, quantity)
    number, unit = float(match[1]), match[2]
    if not math.isfinite(number):
        raise not_finite(text, quantity)
    if not unit:
        if quantity.dimension == _PURE:
            return number
        raise bare_number(match[1], quantity)
    factor, dimension = unit_of(unit)
    if dimension != quantity.dimension:
        wanted = with_article(quantity.name)
        raise UnitError(
            "dimension",
            f"{quote(text)} is {with_article(_name_of(dimension))}, not {wanted}",
            f"write {wanted}, e.g. `{quantity.example}`",
        )
    if not math.isfinite(number * factor):
        raise not_finite(text, quantity)
    return number * factor


def is_of(text: str, quantity: Quantity) -> bool:
    """Whether a text is a number of this quantity."""
    try:
        read(text, quantity)
    except UnitError:
        return False
    return True


def bare_number(number: object, quantity: Quantity) -> UnitError:
    """The error for a number without its unit, with the units that would do."""
    units = " or ".join(quote(f"{number} {unit}") for unit in quantity.display)
    reason = f"{quote(str(number))} has no unit: {with_article(quantity.name)} needs one"
    return UnitError("bare", reason, f"write {units}")


def not_finite(text: str, quantity: Quantity) -> UnitError:
    """The error for NaN and infinity, and for a number too large for a float."""
    return UnitError("finite", f"{quote(text)} is not a finite number", f"write a number, e.g. `{quantity.example}`")


def _not_a_number(text: str, quantity: Quantity) -> UnitError:
    if _NOT_FINITE.fullmatch(text):
        return not_finite(text, quantity)
    if plain := without_commas(text):
        if _COMMA.fullmatch(text):
            return UnitError("comma", f"{quote(text)} has a decimal comma", f"write a decimal point: {plain}")
        return UnitError("number", f"{quote(text)} groups its digits", f"write them together: {plain}")
    return UnitError(
        "number",
        f"{quote(text)} is not {with_article(quantity.name)}",
        f"write a number with a unit, e.g. `{quantity.example}`",
    )


def without_commas(text: str) -> str:
    """How a number with a decimal comma or with grouped digits is to be written, to be copied; empty for any other.

    One comma in front of three digits may be either: both readings are shown, a factor of 1000 is not guessed.
    """
    if match := _COMMA.fullmatch(text):
        plain = quote(f"{match[1]}.{match[2]}{match[3]}")
        if len(match[2]) == 3 and match[1].lstrip("+-") in map(str, range(1, 1000)):
            return f"{plain}, or {quote(f'{match[1]}{match[2]}{match[3]}')} if the comma groups digits"
        return plain
    if match := _GROUPS.fullmatch(text):
        number = re.sub(r"[\s'_.,]", "", match[1]) + (f".{match[3]}" if match[3] else "")
        return quote(f"{number} {match[4].strip()}".strip())
    return ""


def _name_of(dimension: Dimension) -> str:
    for quantity in (value for value in globals().values() if isinstance(value, Quantity)):
        if quantity.dimension == dimension:
            return quantity.name
    return "quantity of another dimension"


def digits(value: float, significant: int = 4) -> str:
    """A number with so many significant digits, without an exponent where a reader would not expect one."""
    if value == 0 or not math.isfinite(value):
        return "0" if value == 0 else str(value)
    exponent = math.floor(math.log10(abs(value)))
    if -4 <= exponent < 7:
        text = f"{value:.{max(significant - 1 - exponent, 0)}f}"
        return text.rstrip("0").rstrip(".") if "." in text else text
    return f"{value:.{significant - 1}e}"


def display_unit(value: float, quantity: Quantity) -> str:
    """The unit in which a value of this quantity reads best."""
    fitting = [unit for unit in quantity.display if abs(value) / unit_of(unit)[0] >= 1]
    return max(fitting or quantity.display[:1], key=lambda unit: unit_of(unit)[0])


def show(value: float, quantity: Quantity, significant: int = 4) -> str:
    """Readable text of an SI value: `show(189504.0, FORCE)` is `189.5 kN`."""
    unit = display_unit(value, quantity)
    return f"{digits(value / unit_of(unit)[0], significant)} {unit}".removesuffix(" 1")
