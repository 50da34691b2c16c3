"""Gears and drums of a train."""

from collections.abc import Iterator
from typing import Annotated

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.spec.fields import Efficiency, Measure, Ratio, ReverseEfficiency
from ptmcalc.spec.fragment import Conflict, Fragment, Given, exactly_one
from ptmcalc.spec.optional import Assumed, OneOf


class Gear(Fragment):
    """A rigid gear, or a drum that converts rotation into travel."""

    start: str = Field(alias="from")
    """the inertia on the motor's side"""
    end: str = Field(alias="to")
    """the inertia on the load's side"""
    ratio: Annotated[Ratio | None, OneOf("radius")] = None
    """speed of `from` / speed of `to`; negative if it reverses"""
    radius: Annotated[Annotated[float, Measure(units.LENGTH, above=0)] | None, OneOf("ratio")] = None
    """radius of the drum, wheel or pinion that moves `to`, instead of `ratio`"""
    efficiency: Annotated[
        Efficiency,
        Assumed(1.0, 0.94, 1.0, "one to three stages of gears in oil or drums on rolling bearings, 0.98 to 0.99 each"),
    ] = 1.0
    """while power flows from `from` to `to`"""
    reverse_efficiency: Annotated[ReverseEfficiency | None, Assumed()] = None
    """while it flows back; 2 - 1/efficiency when left out, negative for a self-locking gear"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """A ratio or a radius, and not the same inertia twice."""
        yield from exactly_one(given, "ratio", "radius")
        if given.number("ratio") == 0:
            yield Conflict(("ratio",), "a gear with ratio 0 transmits no motion", "write the speed ratio")

    @property
    def speed_ratio(self) -> float:
        """Speed of `from` over speed of `to` [1 or rad/m]."""
        if self.ratio is not None:
            return self.ratio
        assert self.radius is not None
        return 1 / self.radius

    @property
    def back(self) -> float:
        """Efficiency of power that flows back."""
        return self.reverse_efficiency if self.reverse_efficiency is not None else 2 - 1 / self.efficiency
