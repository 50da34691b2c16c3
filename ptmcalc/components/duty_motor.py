"""A drive motor with its rating: what its heating and its starts are checked against."""

from collections.abc import Iterator
from typing import Annotated, Literal

from ptmcalc.base.span import KeyPath
from ptmcalc.components import drive
from ptmcalc.components.motor_rating import rated_torque_of, rating_key
from ptmcalc.spec.fields import HourlyRate, Inertia, PositivePower, PositiveShare, PositiveTorque
from ptmcalc.spec.fragment import Conflict, Given, at_most_one, together
from ptmcalc.spec.optional import Assumed, Limit


class DutyMotor(drive.Motor):
    """The motors of a crane motion, one of several equal ones."""

    coupling_inertia: Annotated[Inertia | None, Assumed()] = None
    """coupling and brake disc of one motor, on the motor shaft; 15 % of the rotor is assumed when left out"""
    rated_torque: Annotated[PositiveTorque | None, Limit()] = None
    """of one motor, or give `power` and `speed`; needed to check its heating"""
    power: Annotated[PositivePower | None, Limit()] = None
    """rated power of one motor"""
    rated_duty: Annotated[PositiveShare, Limit()] = 1.0
    """duty factor of the rating, e.g. `40 %`; continuous when left out"""
    starts_per_hour: Annotated[HourlyRate | None, Limit()] = None
    """permitted starts per hour of the manufacturer; needed to check the starts"""
    cooling: Literal["self_ventilated", "self_ventilated_closed", "unventilated", "separately_ventilated"] = (
        "self_ventilated"
    )
    """cooling at standstill"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The rating is given in one way."""
        yield from super().conflicts(given)
        yield from at_most_one(given, "rated_torque", "power")
        yield from together(given, "power", "speed", "the rated torque is power over speed")

    @property
    def rated(self) -> float | None:
        """Rated torque of one motor [N*m], of its `curve` where the file does not give it besides."""
        if self.power is not None and self.speed is not None:
            return self.power / self.speed
        return rated_torque_of(self.rated_torque, self.curve)

    @property
    def rating_key(self) -> KeyPath:
        """The key that states its rating."""
        return rating_key(self.power, self.rated_torque, self.curve)
