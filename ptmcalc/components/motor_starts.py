"""Starts per hour that a motor permits: given by the manufacturer, or no-load starts of the catalogue reduced by
inertia, load torque and load."""

import math
from collections.abc import Iterator
from typing import Annotated, Any, Literal

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.base.span import KeyPath
from ptmcalc.components.plate_motor import PlateMotor
from ptmcalc.contract.machine import Assumption, Use
from ptmcalc.laws import duty
from ptmcalc.spec.fields import Fraction, HourlyRate
from ptmcalc.spec.fragment import Conflict, Given, together
from ptmcalc.spec.optional import Assumed, Limit


class StartingMotor(PlateMotor):
    """The drive motors, one of several equal ones: a starting torque, a torque curve, or the rating plate of a cage
    motor (`power` with `speed` or `poles`), from which a curve of typical motors follows."""

    starts_per_hour: Annotated[HourlyRate | None, Limit()] = None
    """permitted starts per hour of the manufacturer, for the load of this machine; or give `no_load_starts`"""
    no_load_starts: Annotated[HourlyRate | None, Limit()] = None
    """permitted no-load starts per hour Z_0 of the catalogue, at 50 % duty factor; inertia, load torque and load of the
    machine reduce them"""
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


def constant_losses(path: KeyPath, use: Use) -> Assumption[Any]:
    """The assumed part of the rated losses that the load does not change, of the motor at a path."""
    return Assumption(
        (*path, "constant_losses"),
        units.RATIO,
        lambda spec: 0.4,
        lambda spec: Interval(0.25, 0.5),
        "losses of cage motors by IEC 60034-2-1: a quarter to half in iron, friction and magnetising current",
        use,
    )


def no_load_speed(motor: PlateMotor) -> float | None:
    """Speed of a motor without load, as far as the file gives it [rad/s]."""
    if motor.no_load_speed is not None:
        return motor.no_load_speed
    curve = motor.running_curve
    return curve.no_load_speed if curve is not None else None


def missing_keys(motor: StartingMotor, path: KeyPath, coupled: bool) -> tuple[KeyPath, ...]:
    """Keys of a motor at a path without which its permitted starts are unknown; `coupled` by a fluid coupling, behind
    which no-load starts of the catalogue say nothing."""
    if motor.starts_per_hour is not None:
        return ()
    if motor.no_load_starts is None or coupled:
        return ((*path, "starts_per_hour"),)
    keys = () if no_load_speed(motor) is not None else ((*path, "no_load_speed"),)
    return keys if motor.rated_torque is not None else (*keys, *_rating_keys(motor, path))


def _rating_keys(motor: StartingMotor, path: KeyPath) -> tuple[KeyPath, ...]:
    """Missing keys of the rated torque of a motor without a rating plate."""
    if motor.curve is not None:
        return ((*path, "curve", "rated_torque"),)
    return tuple((*path, key) for key in ("power", "speed") if getattr(motor, key) is None)


def reduced_starts(motor: StartingMotor, load: float, heat: Estimate) -> Estimate:
    """No-load starts of a motor reduced to the starts and the running of a machine.

        Z = Z_0 k_P (J w_0^2/2)/Q

    Args:
        motor: the motor, with `no_load_starts`.
        load: torque in the running that follows a start, relative to the rated torque [1].
        heat: Q, rotor heat of a start [J].

    Returns:
        Z; 0 where the motor does not start, or running leaves nothing for starts [1/h].

    **Range** cage motors on the mains; starts at equal intervals, many in the time constant of the motor.
    **Error** the bar of the rotor heat; catalogues read k_P from a chart.
    **Source** SEW-EURODRIVE, Manual Gear Units and Gearmotors, chapter Starting frequency; Bonfiglioli, catalogue A,
    section 5.6; k_P by `laws.duty.load_factor`.
    """
    fast, starts, losses, rotor = no_load_speed(motor), motor.no_load_starts, motor.constant_losses, motor.inertia
    assert fast is not None
    assert starts is not None
    assert losses is not None
    assert rotor is not None
    factor, alone = duty.load_factor(load, losses, duty.REST_COOLING[motor.cooling]), rotor * fast**2 / 2
    if not math.isfinite(heat.value) or factor == 0:
        return Estimate.exact(0.0)
    low, value, high = (starts * factor * alone / max(one, alone) for one in (heat.high, heat.value, heat.low))
    return Estimate(value, low, high, model=max(high - value, value - low))
