"""What ends a mode: guards that stay at 0 or above as long as it holds, and where the first of them crosses."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.numerics import panels
from ptmcalc.numerics.pendulum.equations import HIGH, KEEP, LAW, LOW, POSITION, SPEED, Leg
from ptmcalc.numerics.pendulum.parts import LINEAR, Push, Straight
from ptmcalc.numerics.pendulum.track import HALVES, PLACES, Step

FloatArray = NDArray[np.float64]

NOISE = 1e-11
"""Share of its size below which a guard is not below 0."""
_NEAR = 1e-5
"""Share of a step by which the panels may place a root wrongly."""
_SECANTS, _FALSE = 4, 14
_NEXT = 2.0**-52
"""How near two places of a step are told apart."""


@dataclass(frozen=True, slots=True)
class Guards:
    """What a guard is small against, and the sense in which the drive nears the speed it will keep."""

    position: float
    speed: float
    force: float
    weight: float
    approach: int

    def first(self, step: Step) -> tuple[float, str] | None:
        """Share of a step at which the first guard crosses, and which one."""
        names, values = self.values(step.leg, step.start + step.length * PLACES, step.looked_at())
        noise = NOISE * np.maximum(np.abs(values).max(axis=1), self._sizes(names))
        by_panel = values.reshape(len(names), HALVES, panels.COUNT)
        low = (by_panel @ panels.TO_BERNSTEIN.T < -noise[:, None, None]).any(axis=2)
        if not low.any():
            return None
        for half in range(HALVES):
            found = []
            for k in np.flatnonzero(low[:, half]).tolist():
                place = panels.crossing(by_panel[k, half], float(noise[k]))
                if place is not None:
                    share = self._polished(step, k, (half + place) / HALVES, values[k], float(noise[k]))
                    found.append((share, names[k]))
            if found:
                share, name = min(found)
                return share, name
        return None

    def _polished(self, step: Step, k: int, share: float, values: FloatArray, noise: float) -> float:
        """A root of a guard on the step's polynomial itself, by the secant rule from that of the panel; a guard with a
        corner, which the panel misplaces, by false position between the places where its sign changes."""

        def value(x: float) -> float:
            at = np.array([x])
            return float(self.values(step.leg, step.start + step.length * at, step.states(at))[1][k, 0])

        one, two = max(share - _NEAR, 0.0), share
        if one == two:
            return share
        f_one, f_two = value(one), value(two)
        for _ in range(_SECANTS):
            if f_two == f_one:
                break
            following = two - f_two * (two - one) / (f_two - f_one)
            if not abs(following - share) <= _NEAR:
                break
            one, f_one, two = two, f_two, min(max(following, 0.0), 1.0)
            if two == one:
                break
            f_two = value(two)
        below = np.flatnonzero(values < -noise)
        if abs(f_two) <= noise or not len(below) or below[0] == 0 or not values[below[0] - 1] > 0:
            return two
        return _bracketed(value, float(PLACES[below[0] - 1]), float(PLACES[below[0]]), noise)

    def values(self, leg: Leg, time: FloatArray, z: FloatArray) -> tuple[list[str], FloatArray]:
        """What stays at 0 or above as long as the mode holds."""
        mode, axis = leg.mode, leg.case.axis
        now = leg.now(time, z)
        v, s = z[SPEED], z[POSITION]
        found: dict[str, FloatArray] = {"tension": leg.tension(now, z)}
        if mode.drive == KEEP:
            geared = mode.side != 0 and leg.lossy
            if geared or math.isfinite(leg.limit):
                drive, motor, _ = leg.forces(time, z, now)
                if math.isfinite(leg.limit):
                    found["high"], found["low"] = leg.limit - motor, leg.limit + motor
                if geared:
                    found["gear"] = drive * mode.side if mode.forward else -drive * mode.side
            if mode.side:
                found["stop"] = mode.side * v
        else:
            if mode.side:
                if leg.sided:
                    found["stop"] = mode.side * v
                if leg.lossy:
                    into = leg.into_gear(time, z, now) * mode.side
                    found["gear"] = into if mode.forward else -into
            else:
                found["ahead"], found["back"] = leg.margins(time, z)
            if mode.drive in (HIGH, LOW):
                assert leg.kept is not None
                found["met"] = (leg.kept(time) - v) * (1 if mode.drive == HIGH else -1)
            elif mode.drive == LAW and isinstance(axis.drive, Push):
                if axis.drive.reaches is not None:
                    found["reached"] = (axis.drive.reaches - v) * self.approach
                if isinstance(axis.drive.law, Straight):
                    knots = axis.drive.law.knots
                    if mode.piece >= 0:
                        found["knot_down"] = v - knots[mode.piece]
                    if mode.piece + 1 < len(knots):
                        found["knot_up"] = knots[mode.piece + 1] - v
        for k, (buffer, met) in enumerate(zip(axis.buffers, mode.contacts, strict=True)):
            way = buffer.side * (s - leg.places[k])
            if not met:
                found[f"buffer {k}"] = -way
            else:
                if buffer.law == LINEAR:
                    found[f"buffer {k}"] = way
                if math.isfinite(buffer.stroke):
                    found["solid"] = buffer.stroke - buffer.side * (s - buffer.place)
        return list(found), np.stack([np.zeros_like(v) + one for one in found.values()])

    def _sizes(self, names: list[str]) -> FloatArray:
        """What a guard is small against."""
        of = {"tension": self.weight, "stop": self.speed, "met": self.speed, "reached": self.speed,
              "knot_down": self.speed, "knot_up": self.speed}  # fmt: skip
        return np.array([of.get(name, self.position if name[:6] == "buffer" else self.force) for name in names])


def _bracketed(value: Callable[[float], float], left: float, right: float, noise: float) -> float:
    """A root between a place where a function is above 0 and one where it is below.

    A smooth function takes a few steps of false position (Illinois). At a root on a corner they hardly move where the
    slopes differ much: what is left after them is halved, down to two neighbouring places.
    """
    above, below = value(left), value(right)
    side, looks = 0, 0
    while right - left > _NEXT:
        looks += 1
        middle = right - below * (right - left) / (below - above) if looks <= _FALSE else (left + right) / 2
        found = value(middle)
        if abs(found) <= noise:
            return middle
        if found > 0:
            left, above = middle, found
            below = below / 2 if side > 0 else below
            side = 1
        else:
            right, below = middle, found
            above = above / 2 if side < 0 else above
            side = -1
    return right
