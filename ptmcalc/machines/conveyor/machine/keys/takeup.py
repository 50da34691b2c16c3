"""Keys of the take-up."""

from collections.abc import Iterator
from typing import Annotated, Literal

from ptmcalc.spec.fields import (
    Fraction,
    Length,
    PositiveForce,
    PositiveLength,
    PositiveMass,
    PositiveThermalExpansion,
    Ratio,
    TemperatureDifference,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given
from ptmcalc.spec.optional import Assumed, Checked, Setting
from ptmcalc.spec.shape import Also

_OF_BUDGET = ("temperature_range", "installation", "position")


class TakeUp(Fragment):
    """Take-up of the belt."""

    type: Literal["gravity", "winch", "rigid"]
    """`gravity`: a weight keeps the belt tension at its place; `winch`: a winch keeps it in steady running, and the
    belt length in starts and stops; `rigid`: a screw or locked winch"""
    at: Literal["head", "tail"] = "head"
    """`head`: a weight or winch behind the head pulleys; `tail`: a weight that pulls the tail pulley; a screw may be
    anywhere"""
    tension: PositiveForce
    """belt tension: leaving tension (gravity at the head, winch), mean of both sides of the tail pulley (gravity at the
    tail), or the mean of the loop when it was set (rigid)"""
    mass: Annotated[PositiveMass | None, Assumed(), Also("counterweight_mass")] = None
    """of the take-up weight with its carriage (gravity, on two falls); 2 T/g is assumed when it is left out"""
    stroke: Annotated[PositiveLength | None, Checked(), Also("travel")] = None
    """available take-up travel; needed to check it"""
    dead_band: Annotated[Fraction | None, Setting("without it, `deviation` has the interval of usual winches")] = None
    """largest deviation of the tension, relative to `tension`, at which the winch does not act; 5 to 10 % is usual"""
    deviation: Annotated[Ratio | None, Assumed()] = None
    """deviation of the tension relative to `tension` when a scene begins (winch); assumed 0 within `dead_band`"""
    permanent_elongation: Annotated[Fraction | None, Assumed()] = None
    """of the belt over its life, as a share of its length; adds to the required take-up travel"""
    temperature_range: Annotated[TemperatureDifference | None, Assumed()] = None
    """from the coldest to the warmest belt; with it the travel of every scene is checked against `stroke`"""
    thermal_expansion: Annotated[PositiveThermalExpansion | None, Assumed()] = None
    """linear expansion coefficient of the belt; assumed by its carcass when left out"""
    installation: Annotated[Length | None, Assumed()] = None
    """travel reserved for mounting and one new splice; with it the travel of every scene is checked against `stroke`"""
    position: Annotated[Length | None, Assumed()] = None
    """distance of the weight from its upper stop when a scene begins (gravity); mid-travel is assumed when left out"""

    @property
    def budgeted(self) -> bool:
        """True if the file gives a share of the travel besides the stroke: all scenes are then checked against it."""
        return self.stroke is not None and any(getattr(self, key) is not None for key in _OF_BUDGET)

    @property
    def pulls_tail(self) -> bool:
        """True if a weight pulls the tail pulley."""
        return self.type == "gravity" and self.at == "tail"

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Only a weight has a mass and a position; shares of the travel are compared with the stroke."""
        if given.word("type") == "winch" and given.word("at") == "tail":
            reason = "`tension` of a winch is the leaving tension of the drive pulley"
            yield Conflict(("at",), reason, "write `at: head`, or `type: gravity`")
        for key in ("dead_band", "deviation"):
            if key in given and given.word("type") in ("gravity", "rigid"):
                yield Conflict((key,), "only a winch has it", f"delete `{key}`, or write `type: winch`")
        if given.word("type") in ("rigid", "winch"):
            if "mass" in given:
                yield Conflict(("mass",), "a fixed take-up does not move", "delete `mass`, or write `type: gravity`")
            if "position" in given:
                hint = "delete `position`, or write `type: gravity`"
                yield Conflict(("position",), "a fixed take-up has no weight with a position", hint)
        for key in (*_OF_BUDGET, "thermal_expansion"):
            if key in given and "stroke" not in given:
                yield Conflict((key,), "the available travel it counts against is missing", "add `stroke: 6 m`")
        stroke, position = given.number("stroke"), given.number("position")
        if stroke is not None and position is not None and position > stroke:
            reason = f"the weight is at {position:.4g} m of a travel of {stroke:.4g} m"
            yield Conflict(("position",), reason, f"write `position: {stroke / 2:.4g} m`")
