"""The motor of a machine: what a file says of it, and its torque over speed and time."""

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike
from pydantic import Field
from pydantic_core import PydanticCustomError

from ptmcalc.base import units
from ptmcalc.components.motor_stage import FloatArray, Stage
from ptmcalc.laws import motor
from ptmcalc.spec.fields import (
    Measure,
    PositiveAngularSpeed,
    PositivePower,
    PositiveRatio,
    PositiveTime,
    PositiveTorque,
    PositiveTorqueSlope,
    SignedAngularSpeed,
    SignedTorque,
    Time,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given, exactly_one
from ptmcalc.spec.optional import Limit, OneOf, Setting

if TYPE_CHECKING:
    from ptmcalc.numerics.belt.curve import CurveStage

_ABOVE_ONE, _DURATION = Measure(units.OVERLOAD, above=1), Measure(units.TIME, above=0)
RatioAboveOne = Annotated[float, _ABOVE_ONE]
RatedSlip = Annotated[float, Measure(units.SLIP, above=0, at_most=1)]


class Motor(Fragment):
    """What every motor has: a torque over speed and time, and a rating."""

    size_key: ClassVar[str] = ""
    """the number that all its torques grow with, where there is one"""

    largest_torque: Annotated[PositiveTorque | None, Limit()] = None
    """permissible short-time torque (overload limit); needed to check it"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """A motor may be loaded with its rated torque at least."""
        largest, rated = given.number("largest_torque"), cls.rated_by(given)
        if largest is not None and rated is not None and largest < rated:
            reason = f"it is below the rated torque, {units.show(rated, units.TORQUE)}"
            yield Conflict(("largest_torque",), reason, f"write `largest_torque: {_above(rated)}` or more")

    @classmethod
    def rated_by(cls, given: Given) -> float | None:
        """The rated torque the file gives, as far as it can be read."""
        return given.number("rated_torque")

    @property
    def stages(self) -> tuple[Stage, ...]:
        """The torque curves of the start, one after the other."""
        raise TypeError(f"{type(self).__name__} defines no stages")

    @property
    def curve_stages(self) -> "tuple[CurveStage, ...]":
        """The same as numbers."""
        from ptmcalc.numerics.belt.curve import CurveStage, Kloss

        return tuple(
            CurveStage(
                stage.pieces or stage.knots,
                stage.extends,
                None if stage.kloss is None else Kloss(*stage.kloss),
                math.inf if stage.until_speed is None else stage.until_speed,
                math.inf if stage.until_time is None else stage.until_time,
            )
            for stage in self.stages
        )

    def torque(self, speed: ArrayLike, time: ArrayLike = 0.0) -> FloatArray:
        """Torque at a speed so long after the start; where stages end by speed, on the way up [N*m]."""
        at, since = np.broadcast_arrays(np.asarray(speed, float), np.asarray(time, float))
        *before, last = self.stages
        torque = last.torque(at)
        for stage in reversed(before):
            over = at >= stage.until_speed if stage.until_speed is not None else since >= (stage.until_time or 0.0)
            torque = np.where(over, torque, stage.torque(at))
        return torque


class RatedMotor(Motor):
    """A motor whose rated torque is given as such."""

    rated_torque: Annotated[PositiveTorque | None, Limit()] = None
    """the permissible torque of the motor in its rated duty; needed to check its heating"""

    @property
    def rated(self) -> float | None:
        """Rated torque [N*m]."""
        return self.rated_torque


class ConstantMotor(RatedMotor):
    """A motor with the same torque at every speed."""

    size_key: ClassVar[str] = "torque"
    type: Literal["constant"]
    constant: PositiveTorque = Field(alias="torque")
    """the torque"""

    @property
    def no_load_speed(self) -> None:
        """There is none: the torque is never 0."""
        return None

    @property
    def stages(self) -> tuple[Stage, ...]:
        return (Stage(pieces=((0.0, self.constant),)),)


class LinearMotor(RatedMotor):
    """A motor with a torque that decreases linearly with its speed, as a DC motor, also outside the given range."""

    size_key: ClassVar[str] = "starting_torque"
    type: Literal["linear"]
    starting_torque: PositiveTorque
    """torque at standstill"""
    no_load_speed: PositiveAngularSpeed
    """speed at which the torque is 0; above it the motor brakes"""

    @property
    def stages(self) -> tuple[Stage, ...]:
        return (Stage(pieces=((0.0, self.starting_torque), (self.no_load_speed, 0.0)), extends=True),)


class InductionBase(Motor):
    """What a cage motor and a slip-ring motor share: rating, and the natural curve of Kloss."""

    size_key: ClassVar[str] = "power"
    power: PositivePower
    """rated power on the shaft"""
    speed: PositiveAngularSpeed
    """rated speed, below the synchronous one"""
    synchronous_speed: PositiveAngularSpeed
    """speed of the field: 3000, 1500, 1000, 750 rpm ... at 50 Hz"""
    overload: RatioAboveOne
    """breakdown torque / rated torque"""
    formula: Literal["simplified", "full"] = "simplified"
    """the formula of Kloss without (`simplified`) or with (`full`) the resistance of the stator"""
    stator_ratio: Annotated[PositiveRatio | None, Setting("the full formula of Kloss: equal resistances")] = None
    """stator resistance / rotor resistance referred to the stator, in the full formula; 1 when left out"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The rated slip is above 0, and slip, overload and stator resistance are those of one motor."""
        yield from super().conflicts(given)
        speed, synchronous = given.number("speed"), given.number("synchronous_speed")
        overload, full = given.number("overload"), given.word("formula") == "full"
        if "stator_ratio" in given and given.word("formula") == "simplified":
            hint = "delete `stator_ratio`, or write `formula: full`"
            yield Conflict(("stator_ratio",), "the simplified formula does not contain the stator resistance", hint)
        if speed is None or synchronous is None:
            return
        if speed >= synchronous:
            reason = "the rated speed of an induction motor is below the synchronous speed"
            below = units.show(0.97 * synchronous, units.ANGULAR_SPEED)
            hint = "swap them" if speed > synchronous else f"write the speed of the rating plate, e.g. `speed: {below}`"
            yield Conflict(("speed",), reason, hint)
        elif full and overload is not None and overload > 1:
            ratio = given.number("stator_ratio") if "stator_ratio" in given else 1.0
            most = motor.largest_stator_ratio(float(motor.slip(speed, synchronous)), overload)
            if ratio is not None and ratio >= most:
                reason = f"no motor with this slip and overload has a stator ratio of {most:.3g} or more"
                hint = f"write `stator_ratio: {_below(most)}` or less, or `formula: simplified`"
                yield Conflict(("stator_ratio",) if "stator_ratio" in given else ("formula",), reason, hint)

    @classmethod
    def rated_by(cls, given: Given) -> float | None:
        power, speed = given.number("power"), given.number("speed")
        return None if power is None or speed is None else motor.rated_torque(power, speed)

    @property
    def rated(self) -> float:
        """Rated torque [N*m]."""
        return motor.rated_torque(self.power, self.speed)

    @property
    def no_load_speed(self) -> float:
        """Speed at which the torque is 0 [rad/s]."""
        return self.synchronous_speed

    @property
    def breakdown_torque(self) -> float:
        """Largest torque of the natural curve and of every rheostat stage [N*m]."""
        return self.overload * self.rated

    @property
    def breakdown_slip(self) -> float:
        """Slip at which the natural curve has its largest torque."""
        rated_slip = float(motor.slip(self.speed, self.synchronous_speed))
        return motor.breakdown_slip(rated_slip, self.overload, self._stator_ratio)

    def speed_at(self, torque: float) -> float:
        """Speed at which the natural curve steadily carries a torque; ValueError beyond breakdown [rad/s]."""
        return float(motor.switching_speed(1.0, self._slip_at(torque), self.synchronous_speed))

    def _slip_at(self, torque: float) -> float:
        return float(motor.kloss_slip(torque, self.breakdown_torque, self.breakdown_slip, self._stator_ratio))

    @property
    def _stator_ratio(self) -> float:
        if self.formula == "simplified":
            return 0.0
        return 1.0 if self.stator_ratio is None else self.stator_ratio

    def _stage(self, factor: float = 1.0, until_speed: float | None = None, until_time: float | None = None) -> Stage:
        """The curve with so many times the rotor's own resistance in the rotor circuit."""
        synchronous = self.synchronous_speed
        slip_of_most = motor.stage_breakdown_slip(self.breakdown_slip, factor)
        curve = (self.breakdown_torque, slip_of_most, self._stator_ratio / factor)
        return Stage(
            formula=lambda speed: motor.kloss(motor.slip(speed, synchronous), *curve),
            slope=lambda speed: -motor.kloss_slope(motor.slip(speed, synchronous), *curve) / synchronous,
            kloss=(self.breakdown_torque, slip_of_most, self._stator_ratio / factor * slip_of_most, synchronous),
            until_speed=until_speed,
            until_time=until_time,
        )


class InductionMotor(InductionBase):
    """An induction motor switched on directly."""

    type: Literal["induction"]

    @property
    def stages(self) -> tuple[Stage, ...]:
        return (self._stage(),)


class RheostatMotor(InductionBase):
    """A slip-ring motor with rotor resistances that are cut out step by step."""

    type: Literal["rheostat"]
    steps: Annotated[tuple[RatioAboveOne, ...], Field(min_length=1, max_length=30)]
    """resistance of the rotor circuit / rotor resistance, per step, descending; the last step is the rotor alone"""
    smallest_torque: Annotated[PositiveTorque | None, OneOf("switch_times")] = None
    """torque at which a step is cut out, or give `switch_times`"""
    switch_times: Annotated[
        Annotated[tuple[PositiveTime, ...], Field(min_length=1, max_length=30)] | None, OneOf("smallest_torque")
    ] = None
    """times after the start at which the steps are cut out, one for each"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The steps fall, and each is cut out in one way, at a torque it passes."""
        yield from super().conflicts(given)
        yield from exactly_one(given, "smallest_torque", "switch_times")
        steps, times = _numbers(given, "steps", _ABOVE_ONE), _numbers(given, "switch_times", _DURATION)
        if index := _out_of_order([None if step is None else -step for step in steps]):
            yield Conflict(
                ("steps", index), "the resistances do not decrease from step to step", "sort them, largest first"
            )
        if index := _out_of_order(times):
            yield Conflict(("switch_times", index), "the times do not increase from step to step", "sort them")
        if steps and times and len(steps) != len(times):
            reason = f"{len(steps)} steps are cut out at {len(steps)} times, not at {len(times)}"
            yield Conflict(("switch_times",), reason, "give one time for each of the `steps`")
        yield from cls._unreachable(given, steps)

    @classmethod
    def _unreachable(cls, given: Given, steps: Sequence[float | None]) -> Iterator[Conflict]:
        """The smallest torque is one that every step falls to on the way up."""
        smallest, natural = given.number("smallest_torque"), _natural_curve(given)
        if smallest is None or natural is None:
            return
        most, slip_of_most, ratio = natural
        if smallest >= most:
            reason = f"no step reaches more than the breakdown torque, {units.show(most, units.TORQUE)}"
            yield Conflict(("smallest_torque",), reason, f"write less, e.g. `{units.show(most / 2, units.TORQUE)}`")
            return
        slip = float(motor.kloss_slip(smallest, *natural))
        for index, step in enumerate(steps):
            if step is not None and step * slip >= 1:
                at_rest = float(motor.kloss(1.0, most, motor.stage_breakdown_slip(slip_of_most, step), ratio / step))
                reason = f"its starting torque is {units.show(at_rest, units.TORQUE)}, at most `smallest_torque`"
                yield Conflict(("steps", index), reason, f"write a number below {_below(1 / slip)}")

    @property
    def stages(self) -> tuple[Stage, ...]:
        if self.switch_times is not None:
            started = [self._stage(f, until_time=t) for f, t in zip(self.steps, self.switch_times, strict=True)]
        else:
            assert self.smallest_torque is not None
            slip = self._slip_at(self.smallest_torque)
            speeds = motor.switching_speed(self.steps, slip, self.synchronous_speed).tolist()
            started = [self._stage(f, until_speed=speed) for f, speed in zip(self.steps, speeds, strict=True)]
        return (*started, self._stage())


class ConverterMotor(RatedMotor):
    """A motor on a frequency converter: it follows a speed ramp with slip, up to a torque limit."""

    size_key: ClassVar[str] = "torque_limit"
    type: Literal["converter"]
    power: Annotated[PositivePower | None, OneOf("rated_torque")] = None
    """rated power on the shaft, or give `rated_torque`"""
    speed: PositiveAngularSpeed
    """required speed"""
    rated_speed: Annotated[PositiveAngularSpeed | None, OneOf("speed")] = None
    """speed at which the motor has its rated `power` and `slip`; `speed` when left out"""
    ramp_time: Time
    """time in which the reference rises from 0 to `speed`; 0 s is a step"""
    torque_limit: PositiveTorque
    """torque limit of the converter, driving and braking"""
    slip: Annotated[RatedSlip | None, OneOf("stiffness")] = None
    """relative slip at rated torque, or give `stiffness`"""
    own_stiffness: Annotated[PositiveTorqueSlope | None, OneOf("slip")] = Field(default=None, alias="stiffness")
    """torque per speed difference, instead of `slip`"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Rating and stiffness are given in one way, and the limit leaves the rated torque."""
        yield from super().conflicts(given)
        yield from exactly_one(given, "power", "rated_torque")
        yield from exactly_one(given, "slip", "stiffness")
        if "rated_speed" in given and "power" not in given and "slip" not in given:
            reason = "it is unused: it belongs to `power` and `slip`"
            yield Conflict(("rated_speed",), reason, "delete `rated_speed`")
        limit, rated = given.number("torque_limit"), cls.rated_by(given)
        if limit is not None and rated is not None and limit < rated:
            reason = f"the motor could not reach its rated torque, {units.show(rated, units.TORQUE)}"
            yield Conflict(("torque_limit",), reason, f"write e.g. `{units.show(1.5 * rated, units.TORQUE)}`")

    @classmethod
    def rated_by(cls, given: Given) -> float | None:
        power, speed = given.number("power"), given.number("rated_speed" if "rated_speed" in given else "speed")
        if power is None:
            return given.number("rated_torque")
        return None if speed is None else motor.rated_torque(power, speed)

    @property
    def rated(self) -> float:
        """Rated torque [N*m]."""
        if self.power is not None:
            return motor.rated_torque(self.power, self._rated_speed)
        assert self.rated_torque is not None
        return self.rated_torque

    @property
    def _rated_speed(self) -> float:
        return self.speed if self.rated_speed is None else self.rated_speed

    @property
    def no_load_speed(self) -> float:
        """Speed at which the torque is 0 once the reference has arrived [rad/s]."""
        return self.speed

    @property
    def stiffness(self) -> float:
        """Torque per shortfall of speed below the limit [N*m*s/rad]."""
        if self.own_stiffness is not None:
            return self.own_stiffness
        assert self.slip is not None
        return self.rated / (self.slip * self._rated_speed)

    @property
    def limit(self) -> float:
        """The largest torque either way [N*m]."""
        return self.torque_limit

    def reference(self, time: ArrayLike) -> FloatArray:
        """Speed asked for so long after the start [rad/s]."""
        return motor.converter_reference(time, self.speed, self.ramp_time)

    def torque(self, speed: ArrayLike, time: ArrayLike = 0.0) -> FloatArray:
        return motor.converter_torque(speed, self.reference(time), self.stiffness, self.limit)

    @property
    def stages(self) -> tuple[Stage, ...]:
        """The curve once the reference has arrived; until then it is moved down by what the reference lacks."""
        width = self.limit / self.stiffness
        return (Stage(pieces=((self.speed - width, self.limit), (self.speed + width, -self.limit))),)


class TorquePoint(Fragment):
    """One point of a torque curve."""

    speed: SignedAngularSpeed
    """of the motor shaft"""
    torque: SignedTorque
    """motor torque; negative for braking"""


class TableMotor(RatedMotor):
    """A motor with a curve of points, linear between them; the end values apply outside."""

    type: Literal["table"]
    points: Annotated[tuple[TorquePoint, ...], Field(min_length=2, max_length=500)]
    """the points, in ascending speed"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Each speed has one torque."""
        yield from super().conflicts(given)
        speeds = [point.number("speed") if point else None for point in given.blocks("points")]
        if index := _out_of_order(speeds):
            reason = "the speed is not above that of the point before"
            yield Conflict(("points", index, "speed"), reason, "sort the points by speed, and give each speed once")

    @property
    def no_load_speed(self) -> float | None:
        """Lowest speed at which the torque falls to 0, None where it never does [rad/s]."""
        before: TorquePoint | None = None
        for point in self.points:
            if before is not None and before.torque > 0 >= point.torque:
                share = before.torque / (before.torque - point.torque)
                return before.speed + share * (point.speed - before.speed)
            before = point
        return None

    @property
    def stages(self) -> tuple[Stage, ...]:
        return (Stage(pieces=tuple((point.speed, point.torque) for point in self.points)),)


AnyMotor = Annotated[
    ConstantMotor | LinearMotor | InductionMotor | RheostatMotor | ConverterMotor | TableMotor,
    Field(discriminator="type"),
]
"""A motor, told by its `type`."""


def _natural_curve(given: Given) -> tuple[float, float, float] | None:
    """Breakdown torque, breakdown slip and stator ratio the file gives, if it gives those of one motor."""
    speed, synchronous = given.number("speed"), given.number("synchronous_speed")
    rated, overload = InductionBase.rated_by(given), given.number("overload")
    ratio = given.number("stator_ratio") if "stator_ratio" in given else 1.0
    if given.word("formula") == "simplified":
        ratio = 0.0
    if speed is None or synchronous is None or rated is None or overload is None or ratio is None:
        return None
    if not speed < synchronous:
        return None
    slip = float(motor.slip(speed, synchronous))
    if ratio >= motor.largest_stator_ratio(slip, overload):
        return None
    return overload * rated, motor.breakdown_slip(slip, overload, ratio), ratio


def _numbers(given: Given, key: str, measure: Measure) -> list[float | None]:
    """The SI values of a list of numbers, None for a faulty one."""
    raw = given.raw.get(key)
    return [_number(value, measure) for value in raw] if isinstance(raw, list) else []


def _number(value: object, measure: Measure) -> float | None:
    try:
        return measure.read(value)
    except PydanticCustomError:
        return None


def _out_of_order(values: Sequence[float | None]) -> int:
    """Index of the first value that is not above the one before; 0 where all rise or are not known."""
    for index in range(1, len(values)):
        here, before = values[index], values[index - 1]
        if here is not None and before is not None and here <= before:
            return index
    return 0


def _above(torque: float) -> str:
    """A torque a little above a limit, to be copied."""
    return units.show(1.01 * torque, units.TORQUE, 3)


def _below(limit: float) -> str:
    """A number a little below a limit, to be copied."""
    return units.digits(0.99 * limit, 3)
