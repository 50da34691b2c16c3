"""Brakes, clutches and resistances of a train."""

from typing import Annotated, Literal

from ptmcalc.machines.drivetrain.machine.keys.quantities import AnySpeed, Damping, PositiveTorque, TorqueOrNone
from ptmcalc.spec.fields import FactorFromOne, Time
from ptmcalc.spec.fragment import Fragment
from ptmcalc.spec.optional import Absent, Assumed


class Brake(Fragment):
    """A brake against the ground, or a clutch between two inertias (Coulomb friction)."""

    at: str
    """the inertia it acts on"""
    against: str = "ground"
    """`ground`, or the inertia on the other side of a clutch"""
    torque: PositiveTorque
    """torque or force while it slips, fully applied"""
    static_ratio: Annotated[FactorFromOne, Absent("equal static and sliding torque is the minimum")] = 1.0
    """static torque / sliding torque"""
    delay: Annotated[Time, Assumed(0.0, 0.0, 0.1, "spring-applied brakes, AC or DC switching: up to 0.1 s")] = 0.0
    """from the command to the start of the braking torque"""
    rise_time: Annotated[
        Time, Assumed(0.0, 0.0, 0.1, "spring-applied brakes: up to 0.1 s from the first to the full torque")
    ] = 0.0
    """from then to full torque; the time constant of an exponential rise"""
    rise: Literal["linear", "exponential"] = "linear"
    """how it rises"""
    applied: Literal["when_stopping", "always", "never"] = "when_stopping"
    """in which scenes the command is given, at their start"""
    below: Annotated[AnySpeed | None, Absent("the brake acts at any speed")] = None
    """speed of `at` at or below which the command is given"""


class Resistance(Fragment):
    """Resistance to the motion of an inertia."""

    at: str
    """the inertia it acts on"""
    coulomb: Annotated[TorqueOrNone, Absent("no dry friction")] = 0.0
    """dry friction, against the motion at any speed"""
    static_ratio: Annotated[
        FactorFromOne,
        Assumed(1.0, 1.0, 1.5, "breakaway of bearings, seals and wheels: up to 1.5 times the value in motion"),
    ] = 1.0
    """breakaway value / sliding value"""
    viscous: Annotated[Damping, Absent("no friction that depends on the speed")] = 0.0
    """per speed"""
