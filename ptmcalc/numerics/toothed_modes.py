"""A body as in `numerics.driven_modes` whose driven point runs ahead of its drive, tooth after tooth.

    x = x_d + u(x_d),   x = X + sum g_k y_k,   m_d (x'' - u'') = f - reaction

x is the driven point, x_d the drive of mass m_d, u what the teeth let the point run ahead. The modes are those of body
and drive, and Newton's law of the drive makes the teeth a force on them:

    M X'' = F,   y_k'' + 2 zeta_k w_k y_k' + w_k^2 y_k = F,   F = f(t, v_d) + m_d u''
    v_d = x'/(1 + u_x),   u'' = (u_x x'' + u_xx v_d^2)/(1 + u_x)

The force of the drive follows v_d, and its gear feels x'' - u''. u and u_x are continuous where a tooth engages, u_xx
jumps: F jumps by m_d [u_xx] v_d^2. Steps end there. Between two engagements u'' is nearly straight over the place in
the pitch, so that F is linear over a step as in `numerics.driven_modes`, and each mode moves exactly.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.numerics.driven_body import Body, Drive, Followed, Gear, Places, Plan
from ptmcalc.numerics.driven_modes import March, Step

FloatArray = NDArray[np.float64]

_ITERATIONS = 40
"""Rounds until force and teeth fit each other, and until an engagement is found; both end far earlier."""
_CLOSE = 1e-8
"""Change of the force at which the rounds end, relative to the forces [1]: far below the error of the step."""
_AT = 1e-12
"""Pitches to which the travel of the drive is found [1]."""
_BEYOND = 1e-6
"""Pitches behind an engagement at which the next tooth counts [1]: a point that hesitates there does not change teeth
all the time."""
_AT_ONCE = 1e-6
"""Share of a step within which an event counts as at its beginning [1]: far below the error of the step."""
_FOUND = 1e-9
"""Share of a step to which an event is found [1]."""


@dataclass(frozen=True, slots=True)
class Teeth:
    """Mass of the drive [kg], pitch [m], how far the first joint is behind its engagement [pitches], and how far the
    driven point is ahead with its first two derivatives over the travel of the drive [m, 1, 1/m], by the place in the
    pitch from -1/2 to 1/2."""

    mass: float
    pitch: float
    lead: float
    ahead: Callable[[float], tuple[float, float, float]]


def follow(body: Body, gear: Gear, drive: Drive, places: Places, plan: Plan, teeth: Teeth) -> Followed:
    """March from standstill up to `plan.latest`.

    Args:
        body: mass and modes, the drive in them.
        gear: inertia and losses of the drive.
        drive: force by stage, time and speed of the drive.
        places: quantities of interest.
        plan: beginning, step, end.
        teeth: between drive and driven point.

    Returns:
        extremes up to the end; nothing bounds what comes behind it, since teeth never end.

    **Range** a drive that moves forward; within a pitch it may also move back.
    **Error** second order in the step; samples and modes left out of the places are in the bounds.
    **Source** module docstring.

    Raises:
        NumericsError: NUM101 where the march needs more than `plan.most` steps.
    """
    return _Toothed(body, gear, drive, places, plan, teeth).go()


@dataclass(frozen=True, slots=True)
class _Node:
    """End of a step: force on the modes and its part from the motors [N], speed and travel of the drive, place in the
    pitch."""

    force: float
    pull: float
    speed: float
    travel: float
    place: float


class _Toothed(March):
    def __init__(self, body: Body, gear: Gear, drive: Drive, places: Places, plan: Plan, teeth: Teeth) -> None:
        super().__init__(body, gear, drive, places, plan)
        self.teeth, self.tooth = teeth, 0
        self.moved = self.travel = self.pull = 0.0  # X, x_d, f
        self.first = teeth.ahead(teeth.lead - 0.5)[0]

    def _next(self) -> float:
        ahead = super()._next()
        return min(ahead, self.plan.latest) if self.plan.latest > self.time else ahead

    def _after(self) -> FloatArray:
        return np.full(len(self.places.whole), math.inf)

    def _place(self, travel: float) -> float:
        return travel / self.teeth.pitch + self.teeth.lead - self.tooth - 0.5

    def _drive_at(self, point: float) -> tuple[float, float, float]:
        """Travel of the drive where the driven point is at `point`, u_x and u_xx there."""
        travel, slope, bend = self.travel, 0.0, 0.0
        for _ in range(_ITERATIONS):
            by, slope, bend = self.teeth.ahead(self._place(travel))
            off = travel + by - self.first - point
            travel -= off / (1 + slope)
            if abs(off) <= _AT * self.teeth.pitch:
                break
        return travel, slope, bend

    def _fitted(
        self, time: float, speed: tuple[float, float], point: tuple[float, float], rate: tuple[float, float]
    ) -> _Node:
        """The force on the modes that fits speed, place and acceleration of the driven point, each the value without
        this force and what it adds per unit."""
        mass, force, pull = self.teeth.mass, float(self.state[-1]), self.pull
        travel = went = 0.0
        for _ in range(_ITERATIONS):
            travel, slope, bend = self._drive_at(point[0] + point[1] * force)
            went = (speed[0] + speed[1] * force) / (1 + slope)
            jerked = (slope * (rate[0] + rate[1] * force) + bend * went**2) / (1 + slope)  # u''
            more = mass * jerked
            pull = self._solve(
                time,
                (speed[0] + speed[1] * more) / (1 + slope),
                speed[1] / (1 + slope),
                rate[0] + rate[1] * more - jerked,
                rate[1],
                pull,
            )
            before, force = force, pull + more
            if abs(force - before) <= _CLOSE * (abs(force) + abs(pull) + abs(self.gear.static)):
                break
        return _Node(force, pull, went, travel, self._place(travel))

    def _end(self, step: Step, out: FloatArray, time: float) -> _Node:
        """End of a step from the state so far."""
        k, h, old = len(self.w), step.length, float(self.state[-1])
        rigid = self.moved + h * (self.rigid + h * old / 3 / self.body.mass)
        return self._fitted(
            time,
            (self.rigid + float(out[2 * k]), step.speed),
            (
                rigid + float(self.felt @ out[:k]),
                h**2 / 6 / self.body.mass + float(self.felt @ step.new[:k]),
            ),
            (float(out[2 * k + 1]), step.acceleration),
        )

    def _take(self, step: Step, out: FloatArray, node: _Node) -> None:
        """Make a step."""
        k, h, old = len(self.w), step.length, float(self.state[-1])
        state = out[: 2 * k + 1].copy()
        state[: 2 * k] += step.new * node.force
        state[-1] = node.force
        self.moved += h * (self.rigid + h * (old / 3 + node.force / 6) / self.body.mass)
        self.rigid += h / 2 / self.body.mass * (old + node.force)
        self.travel, self.pull, self.state = node.travel, node.pull, state

    def _enter(self) -> None:
        k = len(self.w)
        y, rate = self.state[:k], self.state[k : 2 * k]
        back = -float(self.felt @ (self.w**2 * y + 2 * self.zeta * self.w * rate))
        node = self._fitted(
            self.time,
            (self.rigid + float(self.felt @ rate), 0.0),
            (self.moved + float(self.felt @ y), 0.0),
            (back, self.light),
        )
        jump = abs(node.force - float(self.state[-1]))
        self.state = self.state.copy()
        self.state[-1], self.travel, self.pull = node.force, node.travel, node.pull
        self._node(self.time, node.speed)
        self.total += jump
        self.decaying += jump

    def _chunk(self, count: int, length: float) -> int:
        """March so many steps, or up to the next tooth or stage."""
        step, k = self._map(length), len(self.w)
        states, strays = np.empty((count + 1, 2 * k + 1)), np.empty(count)
        states[0] = self.state
        begin, switch = self.time, self.drive.until(self.stage)
        decay, due, made = math.exp(-self.rate * length), False, 0
        for j in range(1, count + 1):
            out, old = step.free @ self.state, float(self.state[-1])
            node = self._end(step, out, begin + j * length)
            due = self._excess(node, switch[0]) >= 0
            if due:
                break
            self._take(step, out, node)
            self._kick((node.force - old) / length, decay)
            states[j], strays[j - 1], made = self.state, min(self.total, self.envelope * self.decaying), j
            self._node(begin + j * length, node.speed)
        self.time = begin + made * length
        if abs(self.time - self.plan.latest) <= _FOUND * self.plan.step:
            self.time = self.plan.latest
        if made:
            self._see(begin, length, states[: made + 1], strays[:made])
        if due:
            self._event(length, switch[0])
        elif self.time >= switch[1] * (1 - 1e-12):
            self.stage += 1
            self._enter()
        elif any(abs(kink - self.time) <= _FOUND * self.plan.step for kink in self.drive.kinks):
            self._enter()
        return made + 1

    @staticmethod
    def _excess(node: _Node, switch: float) -> float:
        """Below 0 within a tooth and a stage; continuous."""
        stage = node.speed / switch - 1 if math.isfinite(switch) and switch > 0 else -1.0
        return max(abs(node.place) - 0.5 - _BEYOND, stage)

    def _event(self, length: float, switch: float) -> None:
        """The part of a step up to the next tooth or stage, and what acts behind it."""
        part = self._when(length, switch)
        if part > _AT_ONCE * length:
            before, old = self.state.copy(), float(self.state[-1])
            step = self._mapped(part)
            out = step.free @ self.state
            node = self._end(step, out, self.time + part)
            self._take(step, out, node)
            self._kick((node.force - old) / part, 1.0)
            stray = np.array([min(self.total, self.envelope * self.decaying)])
            self._see(self.time, part, np.stack([before, self.state]), stray)
            self.time += part
        else:
            step = self._mapped(length)
            node = self._end(step, step.free @ self.state, self.time + length)
        if abs(node.place) >= 0.5:
            self.tooth += 1 if node.place > 0 else -1
        else:
            self.stage += 1
        self._enter()

    def _when(self, length: float, switch: float) -> float:
        """The part of a step at which the excess is 0, from just above, by the rule of Illinois."""

        def excess(part: float) -> float:
            step = self._mapped(part)
            return self._excess(self._end(step, step.free @ self.state, self.time + part), switch)

        low, high = _AT_ONCE * length, length
        below, above = excess(low), excess(high)
        if below >= 0:
            return 0.0
        side = 0
        for _ in range(_ITERATIONS):
            part = (low * above - high * below) / (above - below)
            found = excess(part)
            if found >= 0:
                high, above = part, found
                below, side = below / 2 if side > 0 else below, 1
            else:
                low, below = part, found
                above, side = above / 2 if side < 0 else above, -1
            if high - low <= _FOUND * length or 0 <= found <= _FOUND:
                break
        return high
