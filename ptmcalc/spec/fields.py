"""Field types of machine descriptions: text with a unit in the file, an SI float in the model.

`Measure` reads the text, checks the dimension and the range, and describes itself to JSON Schema, so that an
editor shows the unit and an example while the file is written.
"""

import math
import re
from dataclasses import dataclass
from datetime import date
from typing import Annotated, Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from ptmcalc.base import units
from ptmcalc.base.units import Quantity, UnitError
from ptmcalc.base.words import quote, with_article

_CODES = {
    "bare": "SPC106",
    "comma": "SPC107",
    "unit": "SPC108",
    "dimension": "SPC105",
    "finite": "SPC109",
    "number": "SPC114",
}
_DAY = re.compile("[0-9]{4}-[0-9]{2}-[0-9]{2}")
_LEAST, _MOST = 1e-12, 1e15  # in SI units: no machine has a value outside, and formulas overflow there


@dataclass(frozen=True, slots=True)
class Measure:
    """Annotation of a float field: its quantity and the range of a valid machine."""

    quantity: Quantity
    above: float | None = None
    at_least: float | None = None
    at_most: float | None = None
    or_else: Quantity | None = None
    """the alternative quantity, chosen by the machine: a torque or a force"""
    smallest: float = _LEAST
    """size in SI units below which no machine has a value but 0"""

    def read(self, value: object) -> float:
        """The SI value of what the file says, or a pydantic error with our code, reason and hint."""
        try:
            number = self._number(value)
        except UnitError as error:
            raise problem(_CODES[error.code], error.reason, error.hint) from None
        if broken := self.broken_by(number):
            raise out_of_range(value, broken)
        return number

    def broken_by(self, number: float) -> str:
        """The limit a number does not keep, in words, or an empty text."""
        if self.above is not None and not number > self.above:
            return f"greater than {units.show(self.above, self.quantity)}"
        if self.at_least is not None and not number >= self.at_least:
            return f"at least {units.show(self.at_least, self.quantity)}"
        if self.at_most is not None and not number <= self.at_most:
            return f"at most {units.show(self.at_most, self.quantity)}"
        if abs(number) > _MOST:
            return f"at most {units.show(_MOST, self.quantity)}" + " in size" * (number < 0)
        if 0 < abs(number) < self.smallest:
            return f"at least {units.show(self.smallest, self.quantity)} in size"
        return ""

    def quantity_of(self, value: object) -> Quantity:
        """The one of its quantities that a text is of; the first where it is of neither."""
        if self.or_else is not None and isinstance(value, str):
            try:
                units.read(value, self.quantity)
            except UnitError as error:
                if error.code == "dimension" and units.is_of(value, self.or_else):
                    return self.or_else
        return self.quantity

    def _number(self, value: object) -> float:
        if isinstance(value, str):
            return units.read(value, self.quantity_of(value))
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise problem(
                "SPC111",
                f"expected {with_article(self.quantity.name)}, found {describe(value)}",
                f"write e.g. `{self.quantity.example}`",
            )
        try:
            number = float(value)
        except OverflowError:
            number = math.inf
        if not math.isfinite(number):
            raise units.not_finite(_written(value), self.quantity)
        if self.quantity.dimension != units.RATIO.dimension:
            raise units.bare_number(value, self.quantity)
        return number

    def __get_pydantic_core_schema__(self, source: object, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        form: dict[str, Any] = {"type": "string", "examples": [self.quantity.example]}
        if self.quantity.dimension == units.RATIO.dimension:
            example = units.read(self.quantity.example, self.quantity)
            form = {"type": ["number", "string"], "examples": [example, f"{100 * example:g} %"]}
        form["x-quantity"] = self.quantity.name
        form["x-units"] = list(self.quantity.display)
        if self.or_else is not None:
            form["examples"].append(self.or_else.example)
            form["x-quantity"] += f" or {self.or_else.name}"
            form["x-units"] += list(self.or_else.display)
        for key, limit in (
            ("x-above", self.above),
            ("x-at-least", self.at_least),
            ("x-at-most", self.at_most),
        ):
            if limit is not None:
                form[key] = units.show(limit, self.quantity)
        return form


class Day:
    """Annotation of a date field, written `2027-06-30`."""

    EXAMPLE = "2027-06-30"

    def read(self, value: object) -> date:
        """The day, or a pydantic error with our code, reason and hint."""
        if isinstance(value, str) and _DAY.fullmatch(value):
            try:
                return date.fromisoformat(value)
            except ValueError:
                pass
        raise problem("SPC111", f"expected a day, found {describe(value)}", f"write e.g. `{self.EXAMPLE}`")

    def __get_pydantic_core_schema__(self, source: object, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        return {"type": "string", "format": "date", "pattern": f"^{_DAY.pattern}$", "examples": [self.EXAMPLE]}


def problem(code: str, reason: str, hint: str = "") -> PydanticCustomError:
    """A validation error with a code and a copyable fix."""
    return PydanticCustomError("ptmcalc", "{reason}", {"code": code, "reason": reason, "hint": hint})


def out_of_range(value: object, limit: str) -> PydanticCustomError:
    """The error for a value beyond a limit, which is given in words."""
    return problem("SPC110", f"{describe(value)} is out of range: it must be {limit}", f"write a value {limit}")


def describe(value: object) -> str:
    """Description of a value in the words of the file."""
    if isinstance(value, dict):
        return "a mapping"
    if isinstance(value, list):
        return "a list"
    return "nothing" if value is None else quote(_written(value))


def _written(value: object) -> str:
    """A scalar as YAML writes it."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float) and not math.isfinite(value):
        return ".nan" if math.isnan(value) else ".inf" if value > 0 else "-.inf"
    return str(value)


# A plain name takes numbers from 0 on, `Positive...` those above it, `Signed...`, `Ratio` and `Angle` any.
Ratio = Annotated[float, Measure(units.RATIO)]
PositiveRatio = Annotated[float, Measure(units.RATIO, above=0)]
Fraction = Annotated[float, Measure(units.RATIO, at_least=0, at_most=1)]
PositiveFraction = Annotated[float, Measure(units.RATIO, above=0, at_most=1)]
Efficiency = PositiveFraction
ReverseEfficiency = Annotated[float, Measure(units.RATIO, at_most=1)]
PositiveShare = Annotated[float, Measure(units.SHARE, above=0, at_most=1)]
Share = Annotated[float, Measure(units.SHARE, at_least=0, at_most=1)]
FactorFromOne = Annotated[float, Measure(units.FACTOR, at_least=1)]
HourlyRate = Annotated[float, Measure(units.FACTOR, above=0, at_most=3600)]
Mass = Annotated[float, Measure(units.MASS, at_least=0)]
PositiveMass = Annotated[float, Measure(units.MASS, above=0)]
Length = Annotated[float, Measure(units.LENGTH, at_least=0)]
SignedLength = Annotated[float, Measure(units.LENGTH)]
PositiveLength = Annotated[float, Measure(units.LENGTH, above=0)]
PositiveSpan = Annotated[float, Measure(units.SPAN, above=0)]
Span = Annotated[float, Measure(units.SPAN, at_least=0)]
SignedSpan = Annotated[float, Measure(units.SPAN)]
Time = Annotated[float, Measure(units.TIME, at_least=0)]
PositiveTime = Annotated[float, Measure(units.TIME, above=0)]
Angle = Annotated[float, Measure(units.ANGLE)]
PositiveAngle = Annotated[float, Measure(units.ANGLE, above=0)]
PositiveSpeed = Annotated[float, Measure(units.SPEED, above=0)]
PositiveAngularSpeed = Annotated[float, Measure(units.ANGULAR_SPEED, above=0)]
PositiveAcceleration = Annotated[float, Measure(units.ACCELERATION, above=0)]
Force = Annotated[float, Measure(units.FORCE, at_least=0)]
PositiveForce = Annotated[float, Measure(units.FORCE, above=0)]
SignedForce = Annotated[float, Measure(units.FORCE)]
SignedSpeed = Annotated[float, Measure(units.SPEED)]
LineMass = Annotated[float, Measure(units.LINE_MASS, at_least=0)]
PositiveArea = Annotated[float, Measure(units.AREA, above=0)]
PositiveStress = Annotated[float, Measure(units.STRESS, above=0)]
PositivePressure = Annotated[float, Measure(units.PRESSURE, above=0)]
RunningTime = Annotated[float, Measure(units.RUNNING_TIME, above=0)]
PositiveLineMass = Annotated[float, Measure(units.LINE_MASS, above=0)]
PositiveDensity = Annotated[float, Measure(units.DENSITY, above=0)]
PositiveLineForce = Annotated[float, Measure(units.LINE_FORCE, above=0)]
PositiveStiffness = Annotated[float, Measure(units.STIFFNESS, above=0)]
PositiveLineStiffness = Annotated[float, Measure(units.LINE_STIFFNESS, above=0)]
MassFlow = Annotated[float, Measure(units.FLOW, at_least=0)]
PositiveTorque = Annotated[float, Measure(units.TORQUE, above=0)]
Torque = Annotated[float, Measure(units.TORQUE, at_least=0)]
SignedTorque = Annotated[float, Measure(units.TORQUE)]
PositiveFrequency = Annotated[float, Measure(units.FREQUENCY, above=0)]
SignedAngularSpeed = Annotated[float, Measure(units.ANGULAR_SPEED)]
PositiveTorqueSlope = Annotated[float, Measure(units.TORQUE_SLOPE, above=0)]
PositiveEnergy = Annotated[float, Measure(units.ENERGY, above=0)]
Power = Annotated[float, Measure(units.POWER, at_least=0)]
PositivePower = Annotated[float, Measure(units.POWER, above=0)]
TemperatureDifference = Annotated[float, Measure(units.TEMPERATURE_DIFFERENCE, at_least=0)]
PositiveThermalExpansion = Annotated[float, Measure(units.THERMAL_EXPANSION, above=0)]
Inertia = Annotated[float, Measure(units.INERTIA, at_least=0)]
PositiveInertia = Annotated[float, Measure(units.INERTIA, above=0)]
