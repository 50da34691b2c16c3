"""The drive drum between two strands: it sticks to the belt, or slips on it."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import TypeVar

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.exponential_step import ExponentialStep
from ptmcalc.numerics.loop import Drive, FloatArray, Grid, Loop

_EVENTS_PER_STEP = 8
_ROOT_STEPS = 60
_Values = TypeVar("_Values", float, FloatArray)


class Drum:
    """The drive drum: sticks to the belt, or slips on it."""

    def __init__(self, loop: Loop, drive: Drive, times: FloatArray, grid: Grid) -> None:
        self.z_carry, self.z_back = loop.impedances
        self.fixed = loop.fixed_length
        self.z_off = self.z_back if self.fixed else 0.0
        self.mass = loop.drum_mass
        self.step_size = step = grid.step
        self.on_static, self.off_static = loop.carry.static_end, loop.back.static_start
        self.forces = drive.force(times) if drive.force else None
        self.speeds = drive.speed(times) if drive.speed else None
        self.node = ExponentialStep(loop.drum_mass, self.z_carry + self.z_off, step, grid.panel)
        self.squeeze = math.exp(-loop.grip.exponent) if loop.grip else 0.0
        self.slipping = 0  # +1: the drum runs ahead of the belt, -1: the belt ahead of the drum
        self.slipped = False
        self.hold, self.was_held = drive.hold, False
        self.grip = loop.grip
        self.belt = np.zeros(len(times))
        self.drum = self.belt if self.grip is None else np.zeros(len(times))
        self.arriving = (0.0, 0.0)  # N at the run-on, P at the run-off, at the last sample
        self.at = (0.0, 0.0)  # belt and drum speed there
        self.force: list[float] | None = None
        self.imposed: list[float] | None = None
        if self.forces is not None:
            self.node.forcing = float(self.forces[0])
        if self.grip:
            self.slipping = self._breaks(0.0, 0.0, 0.0)
            self.slipped = bool(self.slipping)

    def block(self, first: int, n_on: FloatArray, p_off: FloatArray) -> FloatArray:
        """Belt speeds at the samples from `first` on, where the waves n_on and p_off arrive.

        A belt that sticks is advanced as a whole and its grip looked at afterwards; from the sample on where it breaks
        the block goes on step by step.
        """
        here = slice(first, first + len(n_on))
        belt, drum = self.belt[here], self.drum[here]
        if not self.grip:
            self._stuck(here, n_on, p_off, belt)
            return belt
        kept = 0
        if not self.slipping:
            kept = self._stuck(here, n_on, p_off, belt)
            drum[:kept] = belt[:kept]
            if kept:
                self.arriving, self.at = (float(n_on[kept - 1]), float(p_off[kept - 1])), (float(belt[kept - 1]),) * 2
        if kept < len(belt):
            self._by_steps(first + kept, n_on[kept:], p_off[kept:], belt[kept:], drum[kept:])
        return belt

    def _stuck(self, here: slice, n_on: FloatArray, p_off: FloatArray, belt: FloatArray) -> int:
        """Speeds of a belt that sticks, into `belt`; for how many samples it does."""
        before, free = self.node.speed, self.speeds is None
        forcing = -n_on
        if self.speeds is not None:
            belt[:] = self.speeds[here]
        else:
            assert self.forces is not None
            forcing += self.forces[here]
            if self.fixed:
                forcing += p_off
            start = self.node.forcing
            belt[:] = self.node.block(forcing)
            fast = belt > self.hold
            if fast.any():  # from there on the motor holds its own speed
                self.was_held, self.speeds = True, np.full(len(self.belt), self.hold)
                belt[int(fast.argmax()) :] = self.hold
        if not self.grip:
            return len(belt)
        on, off = self._sides(n_on, p_off, belt)
        breaks = (on * self.squeeze > off) | (off * self.squeeze > on)
        if not breaks.any():
            return len(belt)
        kept = int(breaks.argmax())
        if free and bool((belt[:kept] < self.hold).all()):
            self.speeds = None  # it slips before it has the speed of its motor
        if self.speeds is None:
            self.node.go_on(*((float(belt[kept - 1]), float(forcing[kept - 1])) if kept else (before, start)))
        return kept

    def _by_steps(self, first: int, n_on: FloatArray, p_off: FloatArray, belt: FloatArray, drum: FloatArray) -> None:
        """Speeds of belt and drum, into `belt` and `drum`, where grip may change at any of the samples."""
        if self.force is None and self.forces is not None and self.speeds is None:
            self.force = self.forces.tolist()
        if self.imposed is None and self.speeds is not None:
            self.imposed = self.speeds.tolist()
        found = []
        for k, waves in enumerate(zip(n_on.tolist(), p_off.tolist(), strict=True), first):
            self.at = self._gripped(k, *waves)
            self.arriving = waves
            found.append(self.at)
        belt[:], drum[:] = np.transpose(found)

    def _gripped(self, k: int, n_on: float, p_off: float) -> tuple[float, float]:
        """One step of a drum that sticks, slips, or goes from one to the other; most steps see no change."""
        if self.slipping:
            force = (self.force[k - 1], self.force[k]) if self.force else (0.0, 0.0)
            pushed = force[0] + force[1] - self._pull(*self.arriving, self.at[0])
            belt = self._slip_speed(n_on, p_off)
            if self.imposed:
                drum = self.imposed[k]
            else:
                drum = self.at[1] + self.step_size * (pushed - self._pull(n_on, p_off, belt)) / (2 * self.mass)
                drum = self._held(drum)
            if self.slipping * (drum - belt) >= 0:
                return belt, drum
        else:
            node = self.node
            forcing = (self.force[k] if self.force else 0.0) - n_on + (p_off if self.fixed else 0.0)
            if self.imposed:
                speed = self.imposed[k]
            else:
                decay, old, new = node.full
                speed = decay * self.at[1] + (old * node.forcing + new * forcing) / node.impedance
            if speed > self.hold:
                speed = self._held(speed)
                self._holds()
            if not self._breaks(n_on, p_off, speed):
                node.speed, node.forcing = speed, forcing
                return speed, speed
        return self._changed(k, n_on, p_off)

    def _changed(self, k: int, n_on: float, p_off: float) -> tuple[float, float]:
        """One step with slip and stick located inside it; `at` runs from 0 to 1 through the step."""
        forces = (self.force[k - 1], self.force[k]) if self.force else (0.0, 0.0)
        speeds = (self.imposed[k - 1], self.imposed[k]) if self.imposed else (0.0, 0.0)
        cell = _Cell((self.arriving[0], n_on), (self.arriving[1], p_off), forces, speeds)
        belt, drum, at = *self.at, 0.0
        for _ in range(_EVENTS_PER_STEP):
            if not self.slipping:
                if drum >= self.hold and not self.imposed:  # the belt has come to the speed that the motor holds
                    cell = replace(cell, imposed=self._holds())
                stuck, end = partial(self._stuck_at, cell, at, drum), 1.0
                speed = stuck(end)
                if speed > self.hold and not self.imposed:
                    end, speed = _root(partial(self._over_hold, stuck), at, 1.0), self.hold
                sense = self._breaks(*cell.waves(end)[:2], speed)
                if not sense and end < 1:
                    belt, drum, at = self.hold, self.hold, end
                    continue
                if not sense:
                    self.node.speed = speed
                    self.node.forcing = forces[1] - n_on + (p_off if self.fixed else 0.0)
                    return speed, speed
                breaks = _root(partial(self._excess_at, cell, stuck, sense), at, end)
                belt = drum = stuck(breaks) if breaks > at else drum
                at, self.slipping, self.slipped = breaks, sense, True
            slid = partial(self._slid_at, cell, at, belt, drum)
            belt_end, drum_end = slid(1.0)
            if self.slipping * (drum_end - belt_end) >= 0:
                return belt_end, drum_end
            at = _root(partial(_lead, slid), at, 1.0)
            _, drum = slid(at)
            belt, self.slipping = drum, 0
        raise NumericsError("NUM101", f"stick and slip at the drum alternate without end at {k * self.step_size:.4g} s")

    def _stuck_at(self, cell: "_Cell", at: float, drum: float, x: float) -> float:
        """Common speed at x of a step in which belt and drum stick together from `at` on."""
        if self.imposed:
            return cell.speed(x)
        n0, p0, f0 = cell.waves(at)
        n1, p1, f1 = cell.waves(x)
        off0, off1 = (p0, p1) if self.fixed else (0.0, 0.0)
        return self.node.part(drum, f0 - n0 + off0, f1 - n1 + off1, x - at)

    def _slid_at(self, cell: "_Cell", at: float, belt: float, drum: float, x: float) -> tuple[float, float]:
        """Speeds of belt and drum at x of a step in which the belt slips from `at` on."""
        n1, p1, f1 = cell.waves(x)
        slipping = self._slip_speed(n1, p1)
        if self.imposed:
            return slipping, cell.speed(x)
        n0, p0, f0 = cell.waves(at)
        push = f0 + f1 - self._pull(n0, p0, belt) - self._pull(n1, p1, slipping)
        return slipping, self._held(drum + (x - at) * self.step_size * push / (2 * self.mass))

    def _holds(self) -> tuple[float, float]:
        """The motor holds its own speed from now on: that speed, at both ends of a step."""
        self.was_held, self.speeds = True, np.full(len(self.belt), self.hold)
        self.imposed = self.speeds.tolist()
        return self.hold, self.hold

    def _held(self, drum: float) -> float:
        """Speed of a slipping drum whose motor turns it no faster than its own speed."""
        if drum <= self.hold:
            return drum
        self.was_held = True
        return self.hold

    def _over_hold(self, stuck: Callable[[float], float], x: float) -> float:
        return stuck(x) - self.hold

    def _excess_at(self, cell: "_Cell", stuck: Callable[[float], float], sense: int, x: float) -> float:
        n_on, p_off, _ = cell.waves(x)
        return self._excess(n_on, p_off, stuck(x), sense)

    def _pull(self, n_on: float, p_off: float, belt: float) -> float:
        """Dynamic force the belt takes from the drum."""
        return n_on + self.z_carry * belt - (p_off - self.z_off * belt if self.fixed else 0.0)

    def _sides(self, n_on: _Values, p_off: _Values, belt: _Values) -> tuple[_Values, _Values]:
        """Whole tensions of run-on and run-off, less the centrifugal one."""
        assert self.grip is not None
        lift = self.grip.belt_line_mass * belt * belt
        on = self.on_static + n_on + self.z_carry * belt - lift
        return on, self.off_static + (p_off - self.z_off * belt if self.fixed else 0.0) - lift

    def _excess(self, n_on: float, p_off: float, belt: float, sense: int) -> float:
        """How far the tight side exceeds what friction holds; positive means slip in that sense."""
        on, off = self._sides(n_on, p_off, belt)
        return on * self.squeeze - off if sense > 0 else off * self.squeeze - on

    def _breaks(self, n_on: float, p_off: float, belt: float) -> int:
        on, off = self._sides(n_on, p_off, belt)
        if on * self.squeeze - off > 0:
            return 1
        return -1 if off * self.squeeze - on > 0 else 0

    def _slip_speed(self, n_on: float, p_off: float) -> float:
        """Belt speed at which the friction law holds with equality; a belt that would run back is held."""
        assert self.grip is not None
        on, off = self.on_static + n_on, self.off_static + (p_off if self.fixed else 0.0)
        lift = (1 - self.squeeze) * self.grip.belt_line_mass
        if self.slipping > 0:
            a, b, c = lift, self.squeeze * self.z_carry + self.z_off, self.squeeze * on - off
        else:
            a, b, c = -lift, self.z_carry + self.squeeze * self.z_off, on - self.squeeze * off
        root = b * b - 4 * a * c
        if root < 0:
            raise NumericsError("NUM101", "the belt lifts off the drum by its own centrifugal force")
        return max(-2 * c / (b + math.sqrt(root)), 0.0)


@dataclass(frozen=True, slots=True)
class _Cell:
    """One step of the drum: arriving waves, force and imposed speed at its start and end, linear in between."""

    n_on: tuple[float, float]
    p_off: tuple[float, float]
    force: tuple[float, float]
    imposed: tuple[float, float]

    def waves(self, x: float) -> tuple[float, float, float]:
        """Waves arriving at run-on and run-off, and the force, at x between 0 and 1."""
        (n0, n1), (p0, p1), (f0, f1) = self.n_on, self.p_off, self.force
        return n0 + (n1 - n0) * x, p0 + (p1 - p0) * x, f0 + (f1 - f0) * x

    def speed(self, x: float) -> float:
        """Imposed speed of the drum at x."""
        return self.imposed[0] + (self.imposed[1] - self.imposed[0]) * x


def _lead(slid: Callable[[float], tuple[float, float]], x: float) -> float:
    """How much faster the drum is than the belt."""
    belt, drum = slid(x)
    return drum - belt


def _root(function: Callable[[float], float], low: float, high: float) -> float:
    """A root of a function between two places where it differs in sign, by the Illinois rule; `low` if it does
    not change sign because the event lies at the start."""
    f_low, f_high = function(low), function(high)
    if f_low * f_high >= 0:
        return low
    side = 0
    for _ in range(_ROOT_STEPS):
        middle = (low * f_high - high * f_low) / (f_high - f_low)
        f_middle = function(middle)
        if f_middle == 0 or high - low < 1e-13:
            return middle
        if f_middle * f_high > 0:
            high, f_high = middle, f_middle
            if side == 1:
                f_low /= 2
            side = 1
        else:
            low, f_low = middle, f_middle
            if side == -1:
                f_high /= 2
            side = -1
    return (low + high) / 2
