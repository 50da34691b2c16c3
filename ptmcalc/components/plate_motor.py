"""Drive motors by a starting torque, a torque curve or a rating plate, and what is assumed of a plate."""

from collections.abc import Iterator, Mapping
from typing import Annotated, ClassVar, Literal, TypeVar

from ptmcalc.base import units
from ptmcalc.base.estimate import Interval
from ptmcalc.base.span import KeyPath
from ptmcalc.base.units import Quantity
from ptmcalc.components.drive import MotorBase
from ptmcalc.components.motor import AnyMotor, RatioAboveOne
from ptmcalc.components.rating_plate import (
    POLES,
    Typical,
    plate_motor,
    poles_at,
    speed_of_poles,
    synchronous_speed,
    typical,
)
from ptmcalc.contract.machine import EVERYWHERE, Assumption, Use
from ptmcalc.laws import motor
from ptmcalc.spec.fields import PositiveAngularSpeed, PositiveInertia, PositivePower, PositiveRatio
from ptmcalc.spec.fragment import Conflict, Given, together
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.spec.optional import Assumed, Checked, OneOf


class PlateMotor(MotorBase):
    """The drive motors, one of several equal ones: a starting torque, a torque curve, or the rating plate of a cage
    motor (`power` with `speed` or `poles`), from which a curve of typical motors follows."""

    CURVE_KEYS: ClassVar[tuple[str, ...]] = ("curve", "power")

    inertia: Annotated[PositiveInertia | None, Assumed()] = None
    """rotor of one motor; that of typical motors is assumed where only the rating plate is given"""
    power: Annotated[PositivePower | None, Checked()] = None
    """rated power of one motor; with `speed` or `poles` the rating plate of a cage motor, which gives its curve"""
    speed: Annotated[PositiveAngularSpeed | None, Assumed()] = None
    """rated speed; compared with machine speed, ratio and pulley, drum or sprocket; that of typical motors is assumed
    where only `power` and `poles` are given"""
    poles: Annotated[Literal[4, 6] | None, OneOf("speed")] = None
    """number of poles at 50 Hz, with `power`"""
    locked_rotor_ratio: Annotated[PositiveRatio | None, Assumed()] = None
    """locked-rotor torque / rated torque, with `power`; that of typical motors is assumed when left out"""
    breakdown_ratio: Annotated[RatioAboveOne | None, Assumed()] = None
    """breakdown torque / rated torque, with `power`; that of typical motors is assumed when left out"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """A rating plate is complete, and of one motor."""
        yield from super().conflicts(given)
        yield from _plate_conflicts(given)

    @property
    def has_plate(self) -> bool:
        """Whether the file gives no curve, but the rating plate of a cage motor."""
        return self.curve is None and self.power is not None and (self.speed or self.poles) is not None

    @property
    def starts_on_curve(self) -> bool:
        """Whether starts follow a curve: one is given, or a rating plate without a starting torque."""
        by_torque = self.mean_starting_torque is not None or self.largest_starting_torque is not None
        return self.curve is not None or (self.has_plate and not by_torque)

    @property
    def synchronous(self) -> float | None:
        """Synchronous speed of the motor of a rating plate [rad/s]."""
        if self.no_load_speed is not None:
            return self.no_load_speed
        if self.poles is not None:
            return speed_of_poles(self.poles)
        return synchronous_speed(self.speed) if self.speed is not None else None

    @property
    def typical(self) -> Typical | None:
        """Typical values of the motor of a rating plate."""
        synchronous = self.synchronous if self.has_plate else None
        poles = poles_at(synchronous) if synchronous is not None else 0
        return typical(poles, self.power) if self.power is not None and poles in POLES else None

    @property
    def running_curve(self) -> AnyMotor | None:
        """Curve of steady running: the given one, or that of the rating plate."""
        if not self.has_plate:
            return self.curve
        assert self.power is not None
        assert self.speed is not None
        assert self.synchronous is not None
        assert self.breakdown_ratio is not None
        at_rest = self.breakdown_ratio if self.locked_rotor_ratio is None else self.locked_rotor_ratio
        return plate_motor(self.power, self.speed, self.synchronous, at_rest, self.breakdown_ratio)

    @property
    def start_curve(self) -> AnyMotor | None:
        """Curve that starts follow, where they follow one."""
        return self.running_curve if self.starts_on_curve else None

    @property
    def rated_torque(self) -> float | None:
        """Rated torque of one motor, of its plate or its curve [N*m]."""
        if self.power is not None and self.speed is not None:
            return motor.rated_torque(self.power, self.speed)
        return self.curve.rated if self.curve is not None else None

    @property
    def curve_key(self) -> str:
        """The key that the curve comes from."""
        return "power" if self.has_plate else "curve"

    @property
    def starting_key(self) -> str:
        """The key that the starting torque comes from."""
        keys = ("mean_starting_torque", "largest_starting_torque")
        return next((key for key in keys if getattr(self, key) is not None), self.curve_key)

    @property
    def mean_torque(self) -> float:
        """Mean starting torque of one motor [N*m]: as given, between its steps, or of its curve up to rated speed."""
        if self.curve is None and (curve := self.start_curve) is not None:
            return self.mean_of(curve)
        return super().mean_torque


def gives_curve(motor: Mapping[str, object]) -> bool:
    """Whether a motor as the file writes it has a curve that a start can follow."""
    return "curve" in motor or ("power" in motor and not any("starting_torque" in key for key in motor))


def _plate_conflicts(given: Given) -> Iterator[Conflict]:
    """What a rating plate needs, and what needs it."""
    for key in ("poles", "locked_rotor_ratio", "breakdown_ratio"):
        yield from together(given, key, "power", f"`{key}` belongs to the rating plate of the motor")
    if "power" not in given or "curve" in given:
        if "inertia" not in given:
            yield given.missing("inertia", "the rotor of the motor")
        return
    if "speed" not in given and "poles" not in given:
        if "mean_starting_torque" not in given and "largest_starting_torque" not in given:
            yield Conflict((), "the curve of the motor needs its rated speed", "add `speed: 1485 rpm` or `poles: 4`")
        if "inertia" not in given:
            yield given.missing("inertia", "the rotor of the motor")
        return
    speed, most, poles = given.number("speed"), given.number("no_load_speed"), given.raw.get("poles")
    synchronous = most or (speed_of_poles(poles) if poles in POLES else synchronous_speed(speed) if speed else None)
    if speed is not None and synchronous is None:
        reason = "no synchronous speed at 50 or 60 Hz is a little above the rated speed"
        yield Conflict(("speed",), reason, "give the synchronous speed: `no_load_speed: 1500 rpm`")
    elif speed is not None and synchronous is not None and speed >= synchronous:
        reason = f"the rated speed of a cage motor is below its synchronous speed, {_shown(synchronous)}"
        yield Conflict(("speed",), reason, f"write e.g. `speed: {_shown(0.99 * synchronous)}`")
    elif synchronous is not None and poles_at(synchronous) not in POLES:
        missing = [key for key in ("inertia", "locked_rotor_ratio", "breakdown_ratio") if key not in given]
        for key in missing:
            yield given.missing(key, "typical values are known of motors with 4 and 6 poles only")


def _shown(speed: float) -> str:
    return units.show(speed, units.ANGULAR_SPEED)


S = TypeVar("S", bound=MachineSpec)
_MOTORS = "typical cage motors of this power and number of poles (catalogues; IEC 60034-12, design N)"


def of_the_plate(path: KeyPath, motor: PlateMotor, starts: Use) -> Iterator[Assumption[S]]:
    """Rated speed, starting torques and inertia of typical motors.

    Args:
        path: where the motor stands in the file.
        motor: as the file gives it.
        starts: scenes that follow the torque at rest.
    """
    typical = motor.typical
    if typical is None:
        return
    synchronous = motor.synchronous or 0.0
    usual, slip = typical.slip
    speeds = Interval((1 - slip.high) * synchronous, (1 - slip.low) * synchronous)
    yield _assumed((*path, "speed"), units.ANGULAR_SPEED, (1 - usual) * synchronous, speeds)
    if motor.starts_on_curve:
        yield _assumed((*path, "locked_rotor_ratio"), units.RATIO, *typical.locked_rotor, use=starts)
    yield _assumed((*path, "breakdown_ratio"), units.OVERLOAD, *typical.breakdown)
    yield _assumed((*path, "inertia"), units.INERTIA, *typical.inertia)


def _assumed(
    path: KeyPath, quantity: Quantity, value: float, interval: Interval, use: Use = EVERYWHERE
) -> Assumption[S]:
    return Assumption(path, quantity, lambda spec: value, lambda spec: interval, _MOTORS, use)
