"""What is between the mains and the gear when a motor starts: star-delta starter, soft starter, fluid coupling."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.components.motor import AnyMotor, InductionBase, RatedSlip, TableMotor, TorquePoint
from ptmcalc.numerics.belt.curve import CurveStage
from ptmcalc.spec.fields import Fraction, PositiveEnergy, PositiveRatio, PositiveTime
from ptmcalc.spec.fragment import Conflict, Fragment, Given
from ptmcalc.spec.optional import Absent, Assumed, Limit

STAR = 1 / 3
"""Torque in star connection relative to that in delta [1]: each winding has 1/sqrt(3) of the voltage."""
_TIME_CONSTANTS = 3.0
"""Time constants in which a first-order rise comes to 95 % [1]."""


class StarDelta(Fragment):
    """A star-delta starter: a third of the torque until the motor is switched over."""

    type: Literal["star_delta"]
    switch_over: Annotated[Fraction, Assumed(0.9, 0.8, 0.95, "starters switch over at 0.8 to 0.95 of the speed")] = 0.9
    """speed at which it switches to delta, relative to the synchronous speed; 0.9 is assumed, 0.8 to 0.95"""


class SoftStarter(Fragment):
    """A soft starter: the voltage rises linearly, and the torque with its square."""

    type: Literal["soft"]
    initial_voltage: Annotated[Fraction, Assumed(0.4, 0.3, 0.5, "soft starters begin at 0.3 to 0.5 of the voltage")] = (
        0.4
    )
    """voltage at the beginning relative to the rated voltage; 0.4 is assumed, 0.3 to 0.5"""
    time: PositiveTime
    """in which the voltage rises to the rated voltage"""


AnyStarter = Annotated[StarDelta | SoftStarter, Field(discriminator="type")]


class UnratedCoupling(Fragment):
    """A fluid coupling with constant filling, or filled with delay, between the motor and the gear."""

    torque_limit: Annotated[
        PositiveRatio,
        Assumed(
            1.6, 1.3, 2.0, "fluid couplings: 1.4 to 1.8 with a delay chamber, 1.8 to 2.2 without, 1.3 if controlled"
        ),
    ] = 1.6
    """largest torque of the full coupling relative to the rated torque of the motor; 1.6 is assumed, 1.3 to 2"""
    slip: Annotated[RatedSlip, Assumed(0.03, 0.02, 0.04, "fluid couplings: rated slip 2 to 4 %")] = 0.03
    """slip of the coupling at the rated torque; 3 % is assumed, 2 % to 4 %"""
    rise_time: Annotated[
        PositiveTime, Assumed(8.0, 3.0, 20.0, "couplings with a delay chamber or a controlled filling: 3 to 20 s")
    ] = 8.0
    """in which the torque rises to 95 % of its limit while the coupling fills; 8 s is assumed, 3 s to 20 s"""

    @property
    def time_constant(self) -> float:
        """Time constant of the filling [s]."""
        return self.rise_time / _TIME_CONSTANTS

    def behind(self, motor: AnyMotor) -> TableMotor:
        """The torque at the turbine wheel over its speed, of the full coupling behind a motor.

            M = M_n min(s/(s_m + s_c), lambda),   s = 1 - w/w_0

        Slips of motor and coupling are in series. The motor has run up while the coupling fills.

        **Range** a cage motor that carries the limit torque of the coupling.
        **Error** slip lines are taken to be straight.
        **Source** derived: series of two slip lines.
        """
        top, rated = motor.no_load_speed, motor.rated
        assert top is not None
        assert rated is not None
        return _slip_line(motor, top, rated, self.slip, self.torque_limit)


class FluidCoupling(UnratedCoupling):
    """A fluid coupling with constant filling, or filled with delay, between the motor and the gear."""

    start_heat: Annotated[PositiveEnergy | None, Limit()] = None
    """permissible heat of the coupling per start, from its data sheet; needed to check the start"""


class Converter(Fragment):
    """A frequency converter between the mains and each motor of a drive."""

    droop: Annotated[Fraction, Absent("converters without droop hold their frequency")] = 0.0
    """fall of the frequency at the rated torque, relative to the rated frequency; drives then share the load more
    equally"""
    torque_limit: Annotated[
        PositiveRatio, Assumed(1.5, 1.2, 1.8, "converters give 1.5 times the rated torque for 60 s, 1.2 to 1.8 by size")
    ] = 1.5
    """largest torque relative to the rated torque of the motor, driving and braking; 1.5 is assumed, 1.2 to 1.8"""

    def largest(self, rated: float) -> float:
        """The largest torque of a motor with a rated one [N*m]."""
        return self.torque_limit * rated

    def behind(self, motor: AnyMotor) -> TableMotor:
        """The torque of a motor over its speed at the rated frequency of its converter.

            M = M_n min(s/(s_n + k), lambda),   s = 1 - w/w_0

        The droop k adds to the rated slip s_n of the motor.

        **Range** a torque limit below the breakdown torque.
        **Error** slip lines are taken to be straight.
        **Source** derived: the frequency falls in proportion to the torque.
        """
        top, rated = motor.no_load_speed, motor.rated
        assert top is not None
        assert rated is not None
        return _slip_line(motor, top, rated, self.droop, self.torque_limit)


def _slip_line(motor: AnyMotor, top: float, rated: float, slip: float, limit: float) -> TableMotor:
    """Straight slip line of a motor with more slip, up to a limit of the torque relative to the rated one."""
    own = (motor.synchronous_speed - motor.speed) / motor.synchronous_speed if isinstance(motor, InductionBase) else 0.0
    width, most = (own + slip) * limit * top, limit * rated
    knots = (top - width, most), (top + width, -most)
    points = tuple(TorquePoint.model_construct(speed=speed, torque=torque) for speed, torque in knots)
    return TableMotor.model_construct(type="table", points=points, rated_torque=rated, largest_torque=None)


def gear_without_curve(given: Given) -> Iterator[Conflict]:
    """Starter, fluid coupling and converter: one of them, with a cage motor."""
    keys = [key for key in ("starter", "fluid_coupling", "converter") if key in given]
    for key in keys[1:]:
        yield Conflict((key,), f"the drive has a `{keys[0]}` already", f"delete `{keys[0]}` or `{key}`")
    motor = given.raw.get("motor")
    if not isinstance(motor, dict) or "power" in motor:
        return
    curve = motor.get("curve")
    if isinstance(curve, dict) and curve.get("type") == "induction":
        return
    for key in keys:
        yield Conflict((key,), "it requires the curve of a cage motor", "add `power: 90 kW` and `poles: 4` to `motor`")


def in_star(stages: Sequence[CurveStage], switch_over: float) -> tuple[CurveStage, ...]:
    """Stages of a motor with a star-delta starter that switches over at a speed [rad/s]."""
    first = stages[0]
    knots = tuple((speed, STAR * torque) for speed, torque in first.knots)
    kloss = None if first.kloss is None else replace(first.kloss, torque=STAR * first.kloss.torque)
    return (replace(first, knots=knots, kloss=kloss, until_speed=switch_over, until_time=math.inf), *stages)
