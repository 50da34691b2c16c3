"""Keys of the motors of a conveyor: what they permit besides the keys of every rating plate."""

from collections.abc import Iterator
from typing import Annotated, Literal

from ptmcalc.components.plate_motor import PlateMotor
from ptmcalc.spec.fields import Fraction, HourlyRate
from ptmcalc.spec.fragment import Conflict, Given, together
from ptmcalc.spec.optional import Assumed, Limit


class ConveyorMotor(PlateMotor):
    """The drive motors, one of several equal ones: a starting torque, a torque curve, or the rating plate of a cage
    motor (`power` with `speed` or `poles`), from which a curve of typical motors follows."""

    starts_per_hour: Annotated[HourlyRate | None, Limit()] = None
    """permitted starts per hour of the manufacturer, for the load of this conveyor; or give `no_load_starts`"""
    no_load_starts: Annotated[HourlyRate | None, Limit()] = None
    """permitted no-load starts per hour Z_0 of the catalogue, at 50 % duty factor; inertia, load torque and load of the
    conveyor reduce them"""
    constant_losses: Annotated[Fraction | None, Assumed()] = None
    """part of the rated losses that the load does not change, with `no_load_starts`; 0.4 is assumed, 0.25 to 0.5"""
    cooling: Literal["self_ventilated", "self_ventilated_closed", "unventilated", "separately_ventilated"] = (
        "self_ventilated_closed"
    )
    """cooling at standstill, with `no_load_starts`"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The permitted starts are given in one way."""
        yield from super().conflicts(given)
        if "starts_per_hour" in given and "no_load_starts" in given:
            reason = "the permitted starts are given by `starts_per_hour` already"
            yield Conflict(("no_load_starts",), reason, "delete one of them")
        for key in ("constant_losses", "cooling"):
            yield from together(given, key, "no_load_starts", f"`{key}` belongs to the no-load starts of the motor")
