"""Distributions of values of a machine, by key."""

from collections.abc import Iterator
from typing import Annotated, Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, core_schema

from ptmcalc.spec.fields import describe, problem
from ptmcalc.spec.fragment import Conflict, Fragment, Given, exactly_one


class Written:
    """Annotation of a number whose quantity is that of another key: it is read when that is known."""

    def read(self, value: object) -> str | int | float:
        """The text or number as it is, or a pydantic error with our code, reason and hint."""
        if isinstance(value, str | int | float) and not isinstance(value, bool):
            return value
        raise problem("SPC111", f"expected a value of the key, found {describe(value)}", "write e.g. `2 kN`")

    def __get_pydantic_core_schema__(self, source: object, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        return {"type": ["string", "number"], "examples": ["2 kN"]}


Amount = Annotated[Any, Written()]


class Normal(Fragment):
    """Gaussian distribution."""

    sd: Amount
    """standard deviation"""
    mean: Amount | None = None
    """default: the value of the file"""
    min: Amount | None = None
    """lower limit; the distribution is truncated"""
    max: Amount | None = None
    """upper limit; the distribution is truncated"""


class Uniform(Fragment):
    """Uniform distribution between two values."""

    min: Amount
    """minimum"""
    max: Amount
    """maximum"""


class Tolerance(Fragment):
    """The distribution of one value."""

    normal: Normal | None = None
    """by its standard deviation; the tolerance of a drawing is often two or three standard deviations"""
    uniform: Uniform | None = None
    """between two values"""
    plus: Amount | None = None
    """above the value of the file, uniform distribution"""
    minus: Amount | None = None
    """below the value of the file"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """One distribution, said in one way."""
        if "plus" not in given and "minus" not in given:
            yield from exactly_one(given, "normal", "uniform")
            return
        for key in ("normal", "uniform"):
            if key in given:
                side = "plus" if "plus" in given else "minus"
                yield Conflict(
                    (key,), f"give it or `{side}`, not both: they state the same quantity", f"delete `{key}`"
                )
