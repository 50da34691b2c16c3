"""Equations of a load hauled on a rope between two events: forces, derivatives of the states, guards.

The derivation is that of `numerics.rope.march`.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ptmcalc.numerics.rope.parts import Haul

FloatArray = NDArray[np.float64]
W, X, Z, ZD, V, U, S = range(7)
"""States: speed and way of the drum's end of the rope, sag of the structure and its rate, speed and height of the
load, unstrained rope that the drum has taken in."""
_CRUSHED = 1e-3
"""Strained over unstrained rope below which only a step that does not converge leads: the rope is slack long before."""


@dataclass(frozen=True, slots=True)
class Rod:
    """A rope with mass: stiffness K and mass m_r at the hook."""

    stiffness: float
    mass: float

    @property
    def impedance(self) -> float:
        """Z = (K m_r)^(1/2) [N*s/m]."""
        return math.sqrt(self.stiffness * self.mass)

    @property
    def transit(self) -> float:
        """Of a wave from end to end [s]."""
        return math.sqrt(self.mass / self.stiffness)


@dataclass(frozen=True, slots=True)
class Hauled:
    """A rope without mass that the drum takes in: K l of the hook, its length, a dashpot, the strain it is wound
    with."""

    extensional: float
    length: float
    damping: float
    wound_strain: float


class Mode(NamedTuple):
    """What slides, sticks, holds and touches. `turn` is the direction of the drive, 0 at rest; `power` 1 where it
    flows through the gear in that direction; `follows` the set speed, else `pushing` with all it has."""

    turn: int
    power: int
    follows: bool
    pushing: int
    ground: bool
    taut: bool
    stage: int
    piece: int
    trip: float


class Equations:
    """Forces, derivatives and guards of a load on a rope in each mode."""

    def __init__(self, haul: Haul, rope: Rod | Hauled) -> None:
        self.haul, self.rope = haul, rope
        self.rod = rope if isinstance(rope, Rod) else None
        self.hauled = rope if isinstance(rope, Hauled) else None
        bridge = haul.structure
        self.soft = bridge if bridge is not None and bridge.mass == 0 else None
        self.heavy = bridge if bridge is not None and bridge.mass > 0 else None

    # -- forces -------------------------------------------------------------------------------------------------

    def ends_of(self, y: FloatArray, down: FloatArray, up: FloatArray, mode: Mode) -> tuple[FloatArray, FloatArray]:
        """Forces of the rope at the drum and at the load; `down` and `up` are what comes in at the load and at the
        drum."""
        if not mode.taut:
            return np.zeros(len(y)), np.zeros(len(y))
        if self.rod is not None:
            z = self.rod.impedance
            bottom = 2 * down - z * y[:, V]
            if self.soft is not None:
                return self.soft.stiffness * y[:, Z], bottom
            return z * (y[:, W] - y[:, ZD]) + 2 * up, bottom
        assert self.hauled is not None
        pull = self.hauled.extensional * self.strain(y) + self.hauled.damping * self._stretching(y)
        return pull, pull

    def strain(self, y: FloatArray) -> FloatArray:
        """Of a rope that is hauled in."""
        assert self.hauled is not None
        apart, s, c = y[:, S] - y[:, U], self.hauled.length - y[:, S], self.hauled.extensional
        if self.soft is not None:
            return np.asarray(self.soft.stiffness * apart / (self.soft.stiffness * s + c))
        return np.asarray((apart - y[:, Z]) / s)

    def _stretching(self, y: FloatArray) -> FloatArray:
        return np.asarray(y[:, W] - y[:, V] - (y[:, ZD] if self.heavy is not None else 0.0))

    def _pull(self, mode: Mode, begin: float, t: FloatArray, y: FloatArray) -> FloatArray:
        """Force of a drive that does not keep its set speed."""
        haul = self.haul
        if haul.set_speed is not None:
            return mode.pushing * self._limit(mode, begin, t)
        if not haul.stages:
            return np.zeros(len(t))
        law = haul.stages[mode.stage].law
        return haul.gate.at(mode.trip, begin, t) * law.force(mode.piece, begin, t, y[:, W])

    def _limit(self, mode: Mode, begin: float, t: FloatArray) -> FloatArray:
        """Largest force of a drive that keeps a set speed."""
        return self.haul.capacity.at(begin, t) * self.haul.gate.at(mode.trip, begin, t)

    def _brakes(self, mode: Mode, begin: float, t: FloatArray) -> tuple[FloatArray, FloatArray]:
        haul = self.haul
        return haul.motor_brake.at(mode.trip, begin, t), haul.drum_brake.at(mode.trip, begin, t)

    def _behind(self, force: FloatArray, drum: FloatArray, turn: int) -> FloatArray:
        """Y: what rope and brake put on the drum, against its positive direction, as it turns that way."""
        forward, back = self.haul.tackle
        return np.asarray((force / forward if turn > 0 else force * back) + drum * turn)

    def _gear(self, positive: bool) -> float:
        """k: force on the motor's side of the gear over that on the drum's, by the direction of power."""
        forward, back = self.haul.gear
        return 1 / forward if positive else back

    def rate(
        self, y: FloatArray, t: FloatArray, begin: float, mode: Mode, down: FloatArray, up: FloatArray
    ) -> FloatArray:
        """Derivatives of the states at all nodes."""
        haul, out = self.haul, np.zeros_like(y)
        top, bottom = self.ends_of(y, down, up, mode)
        if mode.follows:
            assert haul.set_speed is not None
            out[:, W] = self._set_rate(begin)
        elif mode.turn:
            on_motor, on_drum = self._brakes(mode, begin, t)
            k = self._gear(mode.power > 0)
            push = self._pull(mode, begin, t, y) - on_motor * mode.turn
            behind = self._behind(top, on_drum, mode.turn)
            out[:, W] = (push - k * behind) / (haul.motor_mass + k * haul.drum_mass)
        out[:, X] = y[:, W]
        if self.heavy is not None:
            out[:, Z] = y[:, ZD]
            held = self.heavy.stiffness * y[:, Z] + self.heavy.damping * y[:, ZD]
            out[:, ZD] = (top - held) / self.heavy.mass
        elif self.soft is not None and self.rod is not None and mode.taut:
            out[:, Z] = y[:, W] - (self.soft.stiffness * y[:, Z] - 2 * up) / self.rod.impedance
        if not mode.ground:
            out[:, V] = (bottom - haul.weight) / haul.load_mass
            out[:, U] = y[:, V]
        if self.hauled is not None:
            out[:, S] = y[:, W] * self._taken(y, mode)
        return out

    def _taken(self, y: FloatArray, mode: Mode) -> FloatArray:
        """Unstrained rope over strained rope where it meets the drum."""
        assert self.hauled is not None
        if mode.turn < 0:
            return np.full(len(y), 1 / (1 + self.hauled.wound_strain))
        return np.asarray(1 / np.maximum(1 + self._pulling(y, mode), _CRUSHED))

    def _pulling(self, y: FloatArray, mode: Mode) -> FloatArray:
        """Strain of a rope that is hauled in, 0 where it is slack."""
        return self.strain(y) if mode.taut else np.maximum(self.strain(y), 0.0)

    def _set_rate(self, begin: float) -> float:
        course = self.haul.set_speed
        assert course is not None
        pair = course.at(begin, np.array([0.0, 1.0]))
        return float(pair[1] - pair[0])

    def needed(self, y: FloatArray, t: FloatArray, begin: float, mode: Mode, top: FloatArray) -> FloatArray:
        """Force of the drive that keeps the set speed."""
        haul, a = self.haul, self._set_rate(begin)
        on_motor, on_drum = self._brakes(mode, begin, t)
        behind = self._behind(top, on_drum, mode.turn)
        k = self._gear(mode.power > 0)
        return np.asarray(haul.motor_mass * a + k * (haul.drum_mass * a + behind) + on_motor * mode.turn)

    # -- guards -------------------------------------------------------------------------------------------------

    def guards(
        self, y: FloatArray, t: FloatArray, begin: float, mode: Mode, down: FloatArray, up: FloatArray
    ) -> list[tuple[str, FloatArray, float]]:
        """What keeps the mode: name, values at the nodes, size of rounding in them."""
        haul = self.haul
        top, bottom = self.ends_of(y, down, up, mode)
        on_motor, on_drum = self._brakes(mode, begin, t)
        force = haul.weight
        speed = max(abs(haul.speed), float(np.abs(y[:, [W, V]]).max()), 1e-9)
        found: list[tuple[str, FloatArray, float]] = []
        if mode.follows:
            assert haul.set_speed is not None
            cap, need = self._limit(mode, begin, t), self.needed(y, t, begin, mode, top)
            size = force + float(cap[0])
            found += [("up to its limit", cap - need, size), ("down to its limit", cap + need, size)]
            through = haul.drum_mass * self._set_rate(begin) + self._behind(top, on_drum, mode.turn)
            found.append(("power", mode.power * mode.turn * through, force))
        else:
            pull = self._pull(mode, begin, t, y)
            size = force + float(np.abs(pull).max()) + float(on_motor.max() + on_drum.max())
            if mode.turn:
                push, behind = pull - on_motor * mode.turn, self._behind(top, on_drum, mode.turn)
                found.append(("rest", mode.turn * y[:, W], speed))
                through = haul.drum_mass * push + haul.motor_mass * behind
                weight = haul.drum_mass + haul.motor_mass
                found.append(("power", mode.power * mode.turn * through / weight, size))
            else:
                up_, down_ = self._break_away(top, pull, on_motor, on_drum)
                found += [("up", up_, size), ("down", down_, size)]
            if haul.set_speed is not None:
                found.append(("catches up", mode.pushing * (haul.set_speed.at(begin, t) - y[:, W]), speed))
            elif haul.stages:
                stage = haul.stages[mode.stage]
                if stage.until is not None and mode.stage + 1 < len(haul.stages):
                    found.append(("stage", stage.until - y[:, W], speed))
                found += [
                    (f"knot {piece}", values, max(float(np.abs(values).max()), 1e-9))
                    for _, values, piece in stage.law.guards(mode.piece, begin, t, y[:, W])
                ]
        if mode.ground:
            found.append(("lift", force - bottom, force))
        elif haul.lifts:
            found.append(("land", y[:, U], max(float(np.abs(y[:, U]).max()), 1e-9)))
        found += self._rope_guards(y, mode, top, bottom, force)
        if math.isinf(mode.trip) and math.isfinite(haul.level):
            found.append(("trip", haul.level - top, force))
        return found

    def _rope_guards(
        self, y: FloatArray, mode: Mode, top: FloatArray, bottom: FloatArray, force: float
    ) -> list[tuple[str, FloatArray, float]]:
        if self.rod is not None:
            if not mode.taut:
                return [("taut", self.haul.slack - y[:, X], max(self.haul.slack, 1e-9))]
            noise = 1e3 * force  # a rope at rest carries nothing but rounding
            return [("slack", top, noise), ("slack", bottom, noise)]
        assert self.hauled is not None
        c = self.hauled.extensional
        if mode.taut:
            return [("slack", top, force)]
        pull = c * self.strain(y)
        whole = pull + self.hauled.damping * self._stretching(y)
        return [("taut", -np.minimum(pull, whole), force)]

    def _break_away(
        self, top: FloatArray, pull: FloatArray, on_motor: FloatArray, on_drum: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """What is missing to break the drive away upward and downward."""
        forward, back = self.haul.gear
        above = self._behind(top, on_drum, 1)
        below = self._behind(top, on_drum, -1)
        turned = np.where(below > 0, below * back, below / forward)
        return above / forward + on_motor - pull, pull + on_motor - turned

    def _through(
        self, y: FloatArray, t: FloatArray, begin: float, mode: Mode, top: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Force through the gear on the drum's side, at rest without losses, as they have no direction there; what is
        put in, and lost in gear, tackle, brakes, dashpots and by the strain that is wound onto the drum [W]."""
        haul, w = self.haul, y[:, W]
        put_in = np.zeros(len(t)) if mode.ground else -haul.weight * y[:, V]
        lost = np.zeros(len(t))
        if self.heavy is not None:
            lost = lost + self.heavy.damping * y[:, ZD] ** 2
        if self.hauled is not None:
            strain, taken = self._pulling(y, mode), self._taken(y, mode)
            elastic = self.hauled.extensional * strain
            lost = lost + (top - elastic) * self._stretching(y)
            lost = lost + elastic * w * (strain * taken / 2 + 1 - (1 + strain) * taken)
        on_motor, on_drum = self._brakes(mode, begin, t)
        if not mode.turn:
            return top * (on_drum == 0), np.stack([put_in, lost], axis=1)
        behind, k = self._behind(top, on_drum, mode.turn), self._gear(mode.power > 0)
        if mode.follows:
            pull, a = self.needed(y, t, begin, mode, top), np.full(len(t), self._set_rate(begin))
        else:
            pull = self._pull(mode, begin, t, y)
            a = (pull - on_motor * mode.turn - k * behind) / (haul.motor_mass + k * haul.drum_mass)
        through = haul.drum_mass * a + behind
        lost = lost + ((k - 1) * through + (behind - top) + on_motor * mode.turn) * w
        return through, np.stack([put_in + pull * w, lost], axis=1)
