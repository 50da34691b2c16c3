"""Motors of a conveyor or chain in steady running: the most they pull and hold, and the torque each of them has."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.components.motor import AnyMotor, InductionBase
from ptmcalc.components.motor_torque import overhauled_torque

FloatArray = NDArray[np.float64]
Forces = Sequence[FloatArray]

SPEED_KEPT = 0.9
"""Part of the rated speed of the machine that the motors must keep under load; an engineering choice. Rated slips of
small induction motors come to 7 %."""
_LOOKS = 2001
_PARTS, _ROUNDS = 32, 14
"""Parts of an interval of speed in which a force is searched, and rounds [1]; numerical choices. 32^14 parts resolve
any interval to its rounding."""


@dataclass(frozen=True, slots=True)
class Motors:
    """Equal motors with one curve on one gear: their force at the pulley or sprocket.

    F = n M i eta/R (driving),   n M i/(eta R) (braking)
    """

    curve: AnyMotor
    count: int
    turns: float
    """turn of the motor shaft per travel, i/R [rad/m]"""
    efficiency: float

    def force(self, speed: FloatArray) -> FloatArray:
        """Force of all motors at a speed of belt or chain, once their start is over [N]."""
        torque = self.count * self.turns * self.curve.stages[-1].torque(speed * self.turns)
        return np.asarray(np.where(torque > 0, torque * self.efficiency, torque / self.efficiency))

    def torque(self, force: float) -> float:
        """Torque of one motor for a force of all [N*m]."""
        return force / (self.efficiency if force > 0 else 1 / self.efficiency) / (self.count * self.turns)

    @property
    def marks(self) -> list[float]:
        """Speeds of belt or chain between which the torque only rises or only falls [m/s]."""
        curve = self.curve
        if isinstance(curve, InductionBase):
            slips = (curve.breakdown_slip, 0.0, -curve.breakdown_slip)
            return [(1 - slip) * curve.synchronous_speed / self.turns for slip in slips]
        return [speed / self.turns for speed, _ in curve.stages[-1].pieces or ()]


def steady_reserve(drives: Sequence[Motors], resistance: float, speed: float) -> float:
    """The most all drives together pull (or hold, where the load drives) over the resistance in steady running [1].

        max over v >= 0.9 V of sum F(v) / W   (W > 0),      max over v of -sum F(v) / -W   (W < 0)

    Args:
        drives: motors of every drive.
        resistance: W, of the whole machine at the pulley; negative where the load drives it [N].
        speed: V, rated speed of belt or chain [m/s].

    Returns:
        Reserve; infinite where nothing resists, or where the braking torque grows without end (`linear`) [1].

    **Range** all drives turn at one speed of the belt or chain, and have finished their start.
    **Error** exact for drives of one curve; of several curves, one part in a million.
    **Source** derived: equilibrium on the torque curves.
    """
    if resistance == 0 or (resistance < 0 and any(math.isinf(overhauled_torque(one.curve)) for one in drives)):
        return math.inf
    if resistance > 0:
        return _most(drives, 1, SPEED_KEPT * speed) / resistance
    return _most(drives, -1, 0.0) / -resistance


def shared_forces(
    drives: Sequence[Motors], resistance: float, speed: float, forces: Callable[[FloatArray], Forces] | None = None
) -> list[float]:
    """Force of each drive in steady running [N].

        sum F(v) = W   on the branch on which the torque falls with the speed

    Args:
        drives: motors of every drive.
        resistance: W, of the whole machine at the pulley; negative where the load drives it [N].
        speed: V, rated speed of belt or chain [m/s].
        forces: force of each drive over the speed of the unloaded belt, where the belt does not have the same speed at
            every drive; that of each drive at one common speed when left out.

    Returns:
        The forces, in the order of the drives; negative where the motors brake. Drives that cannot carry W share it
        as they share their largest force.

    **Range** as `steady_reserve`.
    **Error** exact for drives of one curve and gear at one speed; of others, the rounding of the interval search.
    **Source** derived: equilibrium on the torque curves.
    """
    if forces is None and len({repr(one) for one in drives}) == 1:
        return [resistance / len(drives) for _ in drives]
    at = forces or _all(drives)
    found = [float(force) for force in at(np.array(steady_speed(drives, resistance, speed, at)))]
    scale = resistance / sum(found) if sum(found) else 0.0
    return [scale * force for force in found]


def steady_speed(
    drives: Sequence[Motors], resistance: float, speed: float, forces: Callable[[FloatArray], Forces] | None = None
) -> float:
    """Speed of the unloaded belt at which the drives carry the resistance [m/s].

    Arguments, range, error and source as of `shared_forces`; the speed of the largest force where they cannot carry it.
    """
    at = forces or _all(drives)
    marks = [mark for one in drives for mark in one.marks]
    high = 4 * max(*marks, speed)
    most = _speed_of_most(at, marks, 1, 0.0)
    start = most if resistance > 0 else _crossing(at, 0.0, most, high)
    end = high if resistance > 0 else _speed_of_most(at, marks, -1, 0.0)
    return _crossing(at, resistance, start, end)


def _all(drives: Sequence[Motors]) -> Callable[[FloatArray], Forces]:
    return lambda speeds: [one.force(speeds) for one in drives]


def _most(drives: Sequence[Motors], sign: int, least: float) -> float:
    """The most all drives pull (1) or hold (-1) at a speed or above [N]."""
    forces = _all(drives)
    at = _speed_of_most(forces, [mark for one in drives for mark in one.marks], sign, least)
    return sign * float(np.sum(forces(np.array(at)), axis=0))


def _speed_of_most(forces: Callable[[FloatArray], Forces], marks: Sequence[float], sign: int, least: float) -> float:
    """The speed there, of all marks of the curves and even steps between, looked at twice [m/s]."""
    marks = [max(mark, least) for mark in marks]
    low, high = least, max(2 * least, *marks) * 1.5 + 1e-9
    best = low
    for _ in range(2):
        speeds = np.unique(np.concatenate([np.linspace(low, high, _LOOKS), marks, [best]]))
        best = float(speeds[int(np.argmax(sign * np.sum(forces(speeds), axis=0)))])
        step = (high - low) / (_LOOKS - 1)
        low, high = max(least, best - step), best + step
        marks = [mark for mark in marks if low <= mark <= high]
    return best


def _crossing(forces: Callable[[FloatArray], Forces], force: float, low: float, high: float) -> float:
    """Where the force of all drives falls to a value between two speeds, by parts of the interval; the nearest end
    where it does not [m/s]."""
    for _ in range(_ROUNDS):
        speeds = np.linspace(low, high, _PARTS + 1)
        above = np.flatnonzero(np.sum(forces(speeds), axis=0) > force)
        at = int(above[-1]) if len(above) else 0
        low, high = float(speeds[at]), float(speeds[min(at + 1, _PARTS)])
        if not low < (low + high) / 2 < high:
            break
    return (low + high) / 2
