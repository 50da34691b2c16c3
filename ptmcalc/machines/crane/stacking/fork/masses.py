"""A fork caught by the rack, and a fork pushed against it, as two masses: what the closed forms and the run work with.

Both are one picture. A drive of mass m, reduced to the way of the fork or the carriage, runs at the speed v and pulls
or pushes through a spring K (the rope; the rack) on the carriage M, which leans on another spring (the rack; the
column). Caught, the carriage runs along at v and the rope bears its weight; pushing, it stands.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from ptmcalc.laws import fork
from ptmcalc.machines.crane.stacking.machine.marching import Played, Reading, slowest
from ptmcalc.numerics.train.parts import LINEAR, NO_PULL, Body, Drive, Grip, Guide, Spring, Straight, Train
from ptmcalc.numerics.train.signals import ONE, Signal, Trigger

DRIVE, CARRIAGE, MOTOR = "drive", "carriage", "motor"
ROPE, RACK, COLUMN, BRAKE, CLUTCH = "rope", "rack", "column", "brake", "slip clutch"
_PERIODS = 6
"""Of the slowest vibration that a run is looked at: the peak lies in the first, or, behind a rack that throws the
carriage back, soon after."""


@dataclass(frozen=True, slots=True)
class Limit:
    """What switches the hoist off: at a force of the rope, some time later, and a brake then [N, s, N]."""

    force: float
    reaction: float
    brake: float


@dataclass(frozen=True, slots=True)
class Catch:
    """A hoist whose fork is caught, at the carriage: SI."""

    drive_mass: float
    carriage_mass: float
    weight: float
    rope: float
    rack: float
    """infinite where the carriage stops dead"""
    speed: float
    force: float
    """of the motor at standstill"""
    cap: float
    """largest of the motor, which runs backward with no more; infinite for a line without end"""
    slope: float
    """by which its force falls with the speed; 0 for a constant force"""
    limit: Limit | None

    def without(self, *, slope: bool = False, limit: bool = False, rack: bool = False) -> "Catch":
        """The same without some of it."""
        return Catch(
            self.drive_mass,
            self.carriage_mass,
            self.weight,
            self.rope,
            math.inf if rack else self.rack,
            self.speed,
            self.force,
            self.cap,
            0.0 if slope else self.slope,
            None if limit else self.limit,
        )

    # -- closed forms -------------------------------------------------------------------------------------------

    @property
    def stopped_force(self) -> float:
        """Of the rope, the carriage stopped dead, the motor at its force of standstill [N]."""
        return fork.caught_force(self.force, self.weight, self.rope, self.drive_mass, self.speed)

    @property
    def weight_force(self) -> float:
        """Of the rope, the carriage stopped dead, the motor no stronger than the weight [N]."""
        return fork.caught_force(self.weight, self.weight, self.rope, self.drive_mass, self.speed)

    @property
    def most(self) -> float:
        """Bound of the rope's force, however the rack gives [N]."""
        given = (self.weight, self.rope, self.rack, self.drive_mass, self.carriage_mass, self.speed)
        return fork.caught_bound(self.force, *given)

    @property
    def most_of_rack(self) -> float:
        """Bound of the force on the rack; infinite for a rigid one [N]."""
        if math.isinf(self.rack):
            return math.inf
        given = (self.weight, self.rope, self.rack, self.drive_mass, self.carriage_mass, self.speed)
        return fork.rack_bound(self.force, *given)

    # -- the run ------------------------------------------------------------------------------------------------

    @property
    def rigid(self) -> bool:
        return math.isinf(self.rack)

    def train(self) -> Train:
        """Drive, rope, carriage and rack; the carriage is the ground where the rack stops it dead."""
        bodies = [Body(DRIVE, self.drive_mass, 0.0, self.speed)]
        rope = Spring(ROPE, 0, None, self.rope, law=NO_PULL, side=1, rest=-self.weight / self.rope)
        springs, drives = [rope], [self._motor()]
        if not self.rigid:
            bodies.append(Body(CARRIAGE, self.carriage_mass, 0.0, self.speed))
            springs = [
                Spring(ROPE, 0, 1, self.rope, law=NO_PULL, side=1, rest=-self.weight / self.rope),
                Spring(RACK, 1, None, self.rack, law=NO_PULL, side=1),
            ]
            drives.append(Drive.of("weight", 1, Signal.constant(-self.weight)))
        return Train(tuple(bodies), springs=tuple(springs), grips=tuple(self._brake()), drives=tuple(drives))

    def _motor(self) -> Drive:
        gate = ONE
        if self.limit is not None:
            trip, reaction = self._trip(self.limit), self.limit.reaction
            if reaction:
                gate = Signal((0.0, reaction), (1.0, 0.0), (0.0, 0.0), trigger=trip, before=1.0)
            else:
                gate = Signal(values=(0.0,), trigger=trip, before=1.0)
        if not self.slope:
            law: Signal | Straight = Signal.constant(self.force)
            if gate is not ONE:  # steps of a gate go with a law over the speed
                law = Straight("speed", (0.0,), (self.force,))
            return Drive.of(MOTOR, 0, law, gate)
        return Drive.of(MOTOR, 0, Straight("speed", *self._line(), extends=True), gate)

    def _line(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Speeds and forces of the motor's line: the weight at the speed of hoisting, `cap` where that is more."""
        beyond = self.weight - self.slope * self.speed
        if math.isinf(self.cap):
            return (0.0, self.speed), (self.weight + self.slope * self.speed, self.weight)
        full = self.speed - (self.cap - self.weight) / self.slope
        if full >= self.speed:
            return (0.0, self.speed, 2 * self.speed), (self.weight, self.weight, beyond)
        return (full - self.speed, full, self.speed), (self.cap, self.cap, self.weight)

    def _brake(self) -> Iterator[Grip]:
        if self.limit is not None:
            trip, reaction, full = self._trip(self.limit), self.limit.reaction, self.limit.brake
            if reaction:
                yield Grip(BRAKE, 0, None, Signal((0.0, reaction), (0.0, full), (0.0, 0.0), trigger=trip))
            else:
                yield Grip(BRAKE, 0, None, Signal(values=(full,), trigger=trip))

    @staticmethod
    def _trip(limit: Limit) -> Trigger:
        return Trigger(0, "force", limit.force, rising=True)

    def window(self) -> float:
        """How long it is looked at [s]."""
        return _PERIODS * slowest(self.train()) + (2 * self.limit.reaction if self.limit else 0.0)

    def readings(self, played: Played) -> dict[str, Reading]:
        """Largest forces of rope and rack."""
        found = {"rope_force_caught": played.top("link", played.link(ROPE))}
        if not self.rigid:
            found["rack_force"] = played.top("link", played.link(RACK))
        return found


@dataclass(frozen=True, slots=True)
class Push:
    """A fork that pushes against the rack, its carriage on a column that gives: SI."""

    mass: float
    speed: float
    force: float
    """of the motor, or at which the clutch slips"""
    clutch: bool
    rack: float
    """infinite for a rigid one"""
    support: float
    """of the column at the fork; infinite where nothing gives"""
    carriage_mass: float

    @property
    def series(self) -> float:
        """Stiffness of rack and column, one behind the other [N/m]."""
        return 1 / (1 / self.rack + 1 / self.support)

    def formula(self, stiffness: float) -> float:
        """Largest force on a spring, without the mass of the carriage [N]."""
        law = fork.clutch_push if self.clutch else fork.push_force
        return law(self.force, stiffness, self.mass, self.speed)

    @property
    def most(self) -> float:
        """Bound of the force, whatever the carriage weighs [N]."""
        return fork.push_bound(self.force, self.rack, self.support, self.mass, self.speed)

    @property
    def least(self) -> float:
        """What the largest force reaches in any case; only that of the clutch where one slips [N]."""
        if self.clutch:
            return self.force
        return fork.push_least(self.force, self.rack, self.support, self.mass, self.carriage_mass, self.speed)

    def train(self) -> Train:
        """Drive, rack and carriage on its column; with a slip clutch the motor keeps its speed before it."""
        bodies = [Body(DRIVE, self.mass, 0.0, self.speed), Body(CARRIAGE, self.carriage_mass)]
        springs = [
            Spring(RACK, 0, 1, self.rack, law=NO_PULL, side=1),
            Spring(COLUMN, 1, None, self.support, law=LINEAR),
        ]
        if not self.clutch:
            return Train(tuple(bodies), springs=tuple(springs), drives=(self._motor(),))
        bodies.append(Body(MOTOR, 1.0, 0.0, self.speed))
        grip = Grip(CLUTCH, 0, 2, Signal.constant(self.force))
        return Train(tuple(bodies), springs=tuple(springs), grips=(grip,), guides=(Guide(MOTOR, 2),))

    def _motor(self) -> Drive:
        return Drive.of(MOTOR, 0, Signal.constant(self.force))

    def window(self) -> float:
        """How long it is looked at [s]."""
        return _PERIODS * slowest(self.train())

    def readings(self, played: Played) -> dict[str, Reading]:
        """Largest force of the fork on the rack."""
        return {"fork_push_force": played.top("link", played.link(RACK))}
