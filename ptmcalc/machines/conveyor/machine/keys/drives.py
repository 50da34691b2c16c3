"""What a file says of drives, brakes, backstop and tail pulley."""

from collections.abc import Iterator
from typing import Annotated, Literal

from ptmcalc.components.drive import Gear
from ptmcalc.components.motor import AnyMotor
from ptmcalc.components.motor_starts import StartingMotor
from ptmcalc.components.run_back import USUAL_RESERVE
from ptmcalc.components.starting_gear import AnyStarter, FluidCoupling, gear_without_curve
from ptmcalc.machines.conveyor.machine.keys.converter import DriveConverter
from ptmcalc.spec.fields import (
    FactorFromOne,
    HourlyRate,
    Inertia,
    Length,
    PositiveAngle,
    PositiveEnergy,
    PositiveLength,
    PositivePower,
    PositiveRatio,
    PositiveTorque,
    SignedLength,
    Time,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given
from ptmcalc.spec.optional import Absent, Assumed, Limit
from ptmcalc.spec.shape import Also

_HOUR = 3600.0
"""Seconds of an hour."""
_MOST_WEAR = 0.1
"""Largest deviation of a diameter, relative to it [1]; an engineering choice. More is another pulley."""


class DriveDrum(Fragment):
    """The drive pulley."""

    diameter: PositiveLength
    """of the pulley with its lagging"""
    tolerance: Annotated[Length | None, Absent("several drives: pulleys of exactly the given diameters")] = None
    """largest deviation of the diameter, by manufacture and wear of the lagging; drives at one belt then share the load
    unequally"""
    deviation: Annotated[SignedLength | None, Assumed()] = None
    """deviation of the diameter from `diameter`; assumed 0 within `tolerance` where that is given"""
    wrap: PositiveAngle
    """wrap angle of the belt"""
    friction: Annotated[PositiveRatio | None, Limit()] = None
    """friction coefficient between belt and pulley; needed to check the traction"""
    inertia: Annotated[Inertia | None, Assumed()] = None
    """of the pulley on its own shaft; assumed 0 when left out"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """A pulley is nearly as large as its diameter says."""
        yield from super().conflicts(given)
        diameter = given.number("diameter")
        for key in ("tolerance", "deviation"):
            value = given.number(key)
            if value is not None and diameter is not None and abs(value) > _MOST_WEAR * diameter:
                hint = f"write `{key}: 2 mm`, or another `diameter`"
                yield Conflict((key,), "it is more than a tenth of the diameter", hint)


class Drive(Fragment):
    """Motors, gear and pulley at the head."""

    motor: StartingMotor
    """the motors"""
    coupling_inertia: Annotated[Inertia | None, Assumed()] = None
    """coupling and brake disc of one motor, on the motor shaft; 15 % of the rotor is assumed when left out"""
    gear: Gear
    """the gear"""
    drum: Annotated[DriveDrum, Also("pulley")]
    """the drive pulley"""
    starter: AnyStarter | None = None
    """starter of a cage motor: `star_delta` or `soft`; switched on directly when left out"""
    fluid_coupling: FluidCoupling | None = None
    """fluid coupling between each motor and the gear"""
    converter: DriveConverter | None = None
    """frequency converter of each motor: droop and torque limit, or the drive whose torque it follows; starts with a
    `profile` of the speed and controlled stops need none without them"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Starter, fluid coupling and converter belong to a cage motor."""
        yield from super().conflicts(given)
        yield from gear_without_curve(given)

    @property
    def turns(self) -> float:
        """Turn of the motor shaft per travel of the belt, i/R with the diameter as it is [rad/m]."""
        return self.gear.ratio / ((self.drum.diameter + (self.drum.deviation or 0.0)) / 2)

    @property
    def running_curve(self) -> AnyMotor | None:
        """Torque on the input shaft of the gear in steady running, of one motor: that of the coupling or converter, if
        there is one."""
        curve, between = self.motor.running_curve, self.fluid_coupling or self.converter
        return curve if curve is None or between is None else between.behind(curve)

    @property
    def start_curve(self) -> AnyMotor | None:
        """The same in starts that follow a curve."""
        return self.running_curve if self.starts_on_curve else None

    @property
    def starts_on_curve(self) -> bool:
        """Whether starts follow a curve."""
        return self.motor.starts_on_curve

    @property
    def mean_torque(self) -> float:
        """Mean starting torque of one motor, on the input shaft of the gear [N*m]."""
        if self.fluid_coupling is not None and (curve := self.start_curve) is not None:
            return self.motor.mean_of(curve)
        if self.converter is not None and (rated := self.motor.rated_torque) is not None:
            return self.converter.largest(rated)
        return self.motor.mean_torque


class PlacedDrive(Drive):
    """One of several drives, each with its own pulley."""

    at: Literal["head", "tail"] = "head"
    """position of its pulley; head drives in the sequence of the belt, the first on the tight
    side"""
    delay: Annotated[Time, Absent("simultaneous switch-on of all drives results in the maximum tensions")] = 0.0
    """start delay relative to the first drive"""


class Brake(Fragment):
    """A brake on a pulley shaft or on the motor shaft of its drive."""

    at: Literal["head", "tail"] = "head"
    """position of the brake; on the last pulley there"""
    torque: PositiveTorque
    """braking torque when fully applied"""
    shaft: Literal["drum", "motor"] = "drum"
    """shaft of the brake; on the motor shaft, gear ratio and gear losses increase its effect"""
    delay: Annotated[Time, Assumed(0.0, 0.0, 0.4, "brakes released by a thruster close within 0.2 to 0.4 s")] = 0.0
    """from the command to the start of the braking torque; 0 is assumed when it is left out, and 0.4 s"""
    rise_time: Annotated[Time, Absent("the interval of the assumed `delay` includes the rise")] = 0.0
    """from then to full torque, linear rise"""
    stop_heat: Annotated[PositiveEnergy | None, Limit()] = None
    """heat that the brake takes in one stop, of the data sheet"""
    heat_power: Annotated[PositivePower | None, Limit()] = None
    """heat power that the brake dissipates on average, of the data sheet; with `stops_per_hour`"""
    stops_per_hour: Annotated[HourlyRate | None, Limit()] = None
    """stops per hour with this brake"""

    @property
    def stop_rate(self) -> float:
        """Stops per second; 0 where the file gives no number [1/s]."""
        return (self.stops_per_hour or 0.0) / _HOUR


class Backstop(Fragment):
    """Backstop (holdback) of a loaded inclined conveyor."""

    torque: PositiveTorque
    """rated torque, on the shaft of the head pulley"""
    reserve: Annotated[FactorFromOne, Limit()] = USUAL_RESERVE
    """rated torque / rollback torque; 1.25 to 1.75 in practice"""
    stalled_motor: Literal["on", "off"] = "off"
    """whether the backstop must hold what the motors at the head pull when a jammed belt stalls them"""


class TailDrum(Fragment):
    """The tail pulley."""

    inertia: Annotated[Inertia | None, Assumed()] = None
    """on its own shaft; assumed 0 when left out"""
    diameter: Annotated[PositiveLength | None, Assumed()] = None
    """default: that of the drive pulley"""
