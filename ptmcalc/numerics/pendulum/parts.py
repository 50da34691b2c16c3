"""What swings, and what moves the pivot it hangs from, in numbers.

The pivot has one way to go, its axis: a trolley on a `Rail` (position, speed and forces in m, m/s, N) or a `Jib` that
slews (rad, rad/s, N*m). Angles of the load are told in the frame of the pivot and from the plumb line: `along` the way
it goes (of a jib: tangential, ahead positive), `across` it (of a jib: radial, outward positive).

Signals of a motion (`Swing.at`, `largest`, `smallest`, `farthest`):

    position, speed, acceleration      of the axis
    along, across                      angles of the load [rad], atan2 of its offset over its depth below the pivot
    sway                               angle between rope and plumb line [rad], never below 0
    along_rate, across_rate            rates of these angles in the frame of the pivot [rad/s]
    tension                            of the rope [N]
    pull_along, pull_across            horizontal force of the rope on the pivot [N]
    drive                              force or torque of the drive on the axis, behind the gear
    motor                              the same in front of the gear, brought to the axis by the ratio
    grip                               friction and outer brake, as it acts on the axis
    buffer                             of all buffers, as it acts on the axis
    amplitude                          largest sway of the free swing that would follow if the pivot went on steadily
                                       without turning and the length stayed [rad]
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.numerics.pendulum.pieces import Pieces

FloatArray = NDArray[np.float64]
Field = Callable[[FloatArray, FloatArray, FloatArray], FloatArray]
"""A smooth force or torque on the axis over time, position and speed, arrays alike."""

ZERO = Pieces.constant(0.0)
LINEAR, CONSTANT, ORIFICE = "linear", "constant", "orifice"


@dataclass(frozen=True, slots=True)
class Peak:
    """An extreme value, its time, and the most by which the computation may be wrong."""

    value: float
    time: float
    bar: float


@dataclass(frozen=True, slots=True)
class Load:
    """A point mass on a rope without mass.

    Args:
        mass: M, above 0 [kg].
        length: L, from the pivot to the middle of the load, over time, without jumps [m].
        along: angle at the start, in the direction of the axis [rad].
        across: angle at the start, across it [rad].
        along_rate: its rate in the frame of the pivot [rad/s].
        across_rate: its rate in the frame of the pivot [rad/s].
        wind_along: force of the wind on the load, in the frame of the pivot [N].
        wind_across: the same across [N].
    """

    mass: float
    length: Pieces
    along: float = 0.0
    across: float = 0.0
    along_rate: float = 0.0
    across_rate: float = 0.0
    wind_along: Pieces = ZERO
    wind_across: Pieces = ZERO


@dataclass(frozen=True, slots=True)
class Rail:
    """A straight rail.

    Args:
        slope: upward in the direction of the axis [rad].
    """

    slope: float = 0.0


@dataclass(frozen=True, slots=True)
class Jib:
    """A jib that turns about an axis; the pivot is at its radius, which a trolley or luffing may change.

    Args:
        radius: R over time, without jumps [m].
        tilt: of the axis from the plumb line [rad].
        downhill: position of the axis at which the jib points down the tilt [rad].
        unbalance: mass times radius of what slews without the load, in the direction of the jib [kg*m].
    """

    radius: Pieces
    tilt: float = 0.0
    downhill: float = 0.0
    unbalance: float = 0.0


@dataclass(frozen=True, slots=True)
class Straight:
    """A force over the speed in straight pieces, constant beyond the first and last knot.

    Args:
        knots: speeds of the axis, rising.
        values: forces or torques on the axis in front of the gear.
    """

    knots: tuple[float, ...]
    values: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Smooth:
    """A smooth force over the speed of the axis (a motor's curve), arrays alike.

    Args:
        value: force or torque on the axis in front of the gear.
        size: of it, for the scales [N or N*m].
    """

    value: Callable[[FloatArray], FloatArray]
    size: float


@dataclass(frozen=True, slots=True)
class Follow:
    """A drive that keeps the axis at a speed given over time, as long as its force suffices.

    Beyond the limit it pushes with the limit until the speed is met again. Without a limit the motion is imposed.

    Args:
        speed: without jumps where the drive has no limit.
        limit: largest force or torque in front of the gear.
        until: when it is switched off [s].
    """

    speed: Pieces
    limit: float = math.inf
    until: float = math.inf


@dataclass(frozen=True, slots=True)
class Push:
    """A drive with a force of its own.

    Args:
        law: force over the speed, or a constant one.
        gate: factor over time, such as a ramp, or 0 when it is off; steps or straight lines.
        reaches: speed at which it goes over to keeping that speed; None for never.
        limit: largest force in front of the gear while it keeps it; 0 coasts, then and for good.
        until: when it is switched off [s].
    """

    law: Straight | Smooth | float
    gate: Pieces = Pieces.constant(1.0)  # noqa: RUF009 - frozen
    reaches: float | None = None
    limit: float = math.inf
    until: float = math.inf


@dataclass(frozen=True, slots=True)
class Gear:
    """What lies between motor and axis; all inertia and forces brought to the axis by the ratio alone.

    A force f in front of it gives forward f on the axis while power flows to the axis, f/reverse while it flows back.

    Args:
        rotor: inertia in front of it, J u^2.
        forward: efficiency, above 0.
        reverse: efficiency the other way, above 0: a gear that locks itself does not swing.
        brake: what a brake in front of the gear holds over time, in units of the axis.
    """

    rotor: float = 0.0
    forward: float = 1.0
    reverse: float = 1.0
    brake: Pieces = ZERO


@dataclass(frozen=True, slots=True)
class Buffer:
    """A one-sided stop on the way of the axis.

        linear    k u, and back; constant    F while it is pressed; orifice    c v^2 while it is pressed

    A constant or orifice buffer does not push back and stays where it was pressed to.

    Args:
        place: position of first contact.
        law: `linear`, `constant` or `orifice`.
        size: k, F or c in units of the axis.
        stroke: after which it is solid: the motion ends there and tells the speed that is left.
        side: 1 where it is met going forward, -1 going backward.
    """

    place: float
    law: str
    size: float
    stroke: float = math.inf
    side: int = 1


@dataclass(frozen=True, slots=True)
class Axis:
    """The way the pivot goes and what acts on it; positive forces in the positive direction.

    Args:
        inertia: mass or moment of inertia behind the gear, without the load.
        drive: what moves it; None coasts.
        friction: Coulomb friction, the same at rest and moving.
        brake: what a brake behind the gear can hold over time.
        outer: force over time: wind, gusts.
        field: another smooth one of time, position and speed.
        gear: between motor and axis.
        buffers: stops.
        position: at the start.
        speed: at the start.
    """

    inertia: float
    drive: Follow | Push | None = None
    friction: float = 0.0
    brake: Pieces = ZERO
    outer: Pieces = ZERO
    field: Field | None = None
    gear: Gear = Gear()
    buffers: tuple[Buffer, ...] = ()
    position: float = 0.0
    speed: float = 0.0


@dataclass(frozen=True, slots=True)
class Case:
    """All of it: `swing.swing(case, end)` moves it.

    Args:
        gravity: g, above 0 [m/s^2].
        pivot: a rail or a jib.
        axis: its way and what acts on it.
        load: what hangs on it.
    """

    gravity: float
    pivot: Rail | Jib
    axis: Axis
    load: Load
