"""Damped modes of a body under the force of a drive that depends on time and on the speed of the driven point.

    M V' = f,   y_k'' + 2 zeta_k w_k y_k' + w_k^2 y_k = f,   v = V + sum g_k y_k',   f = F(stage, t, v) + c G^(-)
    S_i = r_i f + sum M_ik d_k,   d_k = -y_k''

V is the rigid motion, g_k the mobilities of the modes at the driven point, S_i a quantity of interest. G = G_0 + f -
m_g v' is the force behind an inertia m_g of the drive; where it changes its sign, a gear loses the other share.

**Steps.** The force is linear over a step, and each mode then moves exactly (`free_motion`). The force at the end of a
step follows from one scalar equation, because the speed there is linear in it:

    f = F(t, v_0 + b f) + c (G_0' + q f)^(-)

b > 0, so that the right side falls with f wherever the torque falls with the speed; elsewhere steps are short enough
for b F_v < 1. A step ends where the drive changes over to its next stage, and at every kink over time.

**Extremes.** Between two nodes d_k is a free motion, because f is linear. Samples are at most half a unit of angle of
the fastest mode apart, and |d''| <= w^2 (1 + 2 zeta) (d^2 + d'^2/w^2)^(1/2) bounds what lies between them. A mode that
is left out follows at once but for the kicks of the force: jumps, and changes of slope over its frequency.

**End.** Let E = (M V'^2 + sum g_k (y_k''^2 + w_k^2 y_k'^2))/2 be the energy of the rates. The rates obey the same
equations with the force F_v v' + F_t, so E never grows where the torque falls with the speed, but for F_t:

    d(2E)^(1/2)/dt <= |F_t|/m_d^(1/2),   |S_i| <= (2 E m_i)^(1/2)

m_d is the mass at the driven point, m_i the mass that accelerates through a section i (`loop_bounds.held_swing`). The
speed stays within (2H/m_d)^(1/2) of the operating speed, H the energy of the deviation from it. The march ends where E
no longer raises an extreme, or where it is below a given share.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.driven_body import Body, Drive, Followed, Gear, Places, Plan
from ptmcalc.numerics.free_motion import free_motion

FloatArray = NDArray[np.float64]

_TURN = 0.5
"""Angle of the fastest mode from one sample to the next [rad]."""
_CHUNK = 256
"""Steps between two looks at what is left of the motion."""
_ITERATIONS = 60
"""Steps of Newton's rule and of bisections; both end far earlier."""
_CLOSE = 1e-12
"""Change of the force at which Newton's rule ends, relative to the force [1]."""
_LOOKS = 65
"""Speeds at which the torque is verified to fall with the speed."""
_MISSED = 0.1
"""What may lie between two samples relative to what may be left at the end [1]; it is in the bounds."""
_ROUNDED = 1e-6
"""Share of a step by which times differ that are one [1]: rounding."""
_SAME = 1e-9
"""The same for kinks of the force [1]."""
_CRITICAL = 0.9
"""Damping ratio above which the envelope of a critically damped mode is used [1]."""


def follow(body: Body, gear: Gear, drive: Drive, places: Places, plan: Plan) -> Followed:
    """March from standstill until the drive runs steadily.

    Args:
        body: mass and modes.
        gear: inertia and losses of the drive.
        drive: force by stage, time and speed.
        places: quantities of interest.
        plan: beginning, step, end.

    Returns:
        extremes, the state before the beginning included; `after` bounds what comes behind the end.

    **Error** second order in the step; samples, modes left out and the time after the end are in the bounds.
    **Source** module docstring.

    Raises:
        NumericsError: NUM101 where the march needs more than `plan.most` steps and what comes after is not bounded.
    """
    return March(body, gear, drive, places, plan).go()


@dataclass(frozen=True, slots=True)
class Step:
    """Maps of a step: of (y, y', f) to what the state, the speed and the elastic acceleration are without the new
    force, and what this adds."""

    length: float
    free: FloatArray
    new: FloatArray
    speed: float
    acceleration: float


class March:
    def __init__(self, body: Body, gear: Gear, drive: Drive, places: Places, plan: Plan) -> None:
        self.body, self.gear, self.drive, self.places, self.plan = body, gear, drive, places, plan
        self.w, self.zeta = body.frequencies, body.damping_ratios
        self.felt = np.where(np.arange(len(self.w)) < plan.felt, body.mobilities, 0.0)
        self.light = 1 / body.mass + float(self.felt.sum())  # what a force accelerates at once
        self.state = np.zeros(2 * len(self.w) + 1)  # y, y', f
        self.time, self.rigid, self.stage = plan.begin, 0.0, 0
        self.steps: dict[float, Step] = {}
        count = len(places.whole)
        self.found = Followed.of(count, len(self.w), len(plan.marks) + 1)
        self.total = self.decaying = self.slope = 0.0
        self.fastest = float(self.w[-1]) if len(self.w) else math.inf
        zeta = float(self.zeta[-1]) if len(self.w) else 0.0
        slow = self.fastest / (4 * max(zeta, _CRITICAL))
        self.rate = min(zeta * self.fastest, slow) if len(self.w) else 0.0
        self.envelope = math.sqrt((1 + _CRITICAL) / (1 - _CRITICAL))

    def go(self) -> Followed:
        self._enter()
        found, until = self.found, math.inf
        while True:
            step = self._longest()
            marks = [mark for mark in self.plan.marks if mark > self.time + _ROUNDED * step]
            length = min([self._next() - self.time, _CHUNK * step, max(until - self.time, 0.0)])
            length = min([length, *(mark - self.time for mark in marks)])
            count = max(math.ceil(length / step * (1 - 1e-12)), 1)
            found.steps += self._chunk(count, length / count)
            if found.steps > self.plan.most:
                found.after, found.end = self._after(), self.time
                if math.isfinite(float(found.after.max(initial=0.0))):
                    return found
                raise NumericsError("NUM101", f"{found.steps} steps up to {self.time:.4g} s, the motion is not steady")
            late = self.time >= self.plan.latest
            if math.isinf(until):
                found.after = self._after()
                if late or self._cannot_raise():
                    found.steady = self._cannot_raise()
                    until = self.plan.begin + (self.time - self.plan.begin) * self.plan.longer
            if self.time >= until * (1 - 1e-12):
                break
        found.after, found.end = self._after(), self.time
        return found

    # -- steps ------------------------------------------------------------------------------------------------------

    def _next(self) -> float:
        """Next time at which the force or its slope jumps."""
        ahead = [kink for kink in self.drive.kinks if kink > self.time + _SAME * self.plan.step]
        return min([*ahead, self.drive.until(self.stage)[1]])

    def _longest(self) -> float:
        """Longest step of the stage [s]."""
        steep = self.drive.steepest(self.stage)
        return min(self.plan.step, self.plan.response * self.body.drive_mass / steep) if steep > 0 else self.plan.step

    def _map(self, length: float) -> Step:
        """The maps of a step, which are kept: most steps are equally long."""
        found = self.steps.get(length)
        if found is None:
            found = self._mapped(length)
            if len(self.steps) > 8:
                self.steps.clear()
            self.steps[length] = found
        return found

    def _mapped(self, h: float) -> Step:
        w, zeta, k = self.w, self.zeta, len(self.w)
        e = free_motion(w, zeta, np.array([h]))
        # the motion that a force keeps up: ((f - 2 zeta f'/w)/w^2, f'/w^2)
        rise = np.array([[-1.0], [1.0]]) / h
        held = np.stack([-2 * zeta / w**3 * rise, rise / w**2], axis=-1)  # (old and new force, k, 2)
        first, last = held.copy(), held.copy()
        first[0, :, 0] += 1 / w**2
        last[1, :, 0] += 1 / w**2
        forced = last - np.einsum("kij,fkj->fki", e, first)
        free = np.zeros((2 * k + 2, 2 * k + 1))
        index = np.arange(k)
        for i in (0, 1):
            for j in (0, 1):
                free[index + i * k, index + j * k] = e[:, i, j]
            free[index + i * k, 2 * k] = forced[0, :, i]
        new = np.concatenate([forced[1, :, 0], forced[1, :, 1]])
        held_back = np.concatenate([self.felt * w**2, 2 * self.felt * zeta * w])
        free[2 * k] = self.felt @ free[k : 2 * k]
        free[2 * k, 2 * k] += h / 2 / self.body.mass
        free[2 * k + 1] = -held_back @ free[: 2 * k]
        speed = h / 2 / self.body.mass + float(self.felt @ new[k:])
        return Step(h, free, new, speed, self.light - float(held_back @ new))

    def _solve(
        self, time: float, speed: float, gain: float, acceleration: float, more: float, near: float | None = None
    ) -> float:
        """The force that fits the speed `speed + gain f` and the acceleration `acceleration + more f` [N]."""
        gear, force = self.gear, float(self.state[-1]) if near is None else near
        base, through = gear.static - gear.mass * acceleration, 1 - gear.mass * more

        def off(f: float) -> tuple[float, float]:
            pull, slope = self.drive.force(self.stage, time, speed + gain * f)
            forward = base + through * f
            turned = gear.extra * through if gear.more(forward) else 0.0
            return f - pull - gear.more(forward), 1 - gain * slope - turned

        low, high = -math.inf, math.inf
        for _ in range(_ITERATIONS):
            value, slope = off(force)
            low, high = (force, high) if value < 0 else (low, force)
            better = force - value / slope if slope > 0 else force - value
            if not low < better < high:
                better = (low + high) / 2 if math.isfinite(low) and math.isfinite(high) else force - value
            if abs(better - force) <= _CLOSE * (abs(better) + abs(gear.static)):
                return better
            force = better
        return force

    def _enter(self) -> None:
        """The force that acts from now on in this stage; its jump kicks the modes left out."""
        k = len(self.w)
        y, rate = self.state[:k], self.state[k : 2 * k]
        speed = self.rigid + float(self.felt @ rate)
        back = -float(self.felt @ (self.w**2 * y + 2 * self.zeta * self.w * rate))
        before = float(self.state[-1])
        self.state[-1] = self._solve(self.time, speed, 0.0, back, self.light)
        self._node(self.time, speed)
        jump = abs(float(self.state[-1]) - before)
        self.total += jump
        self.decaying += jump

    def _chunk(self, count: int, length: float) -> int:
        """March so many steps, or up to where the next stage begins."""
        step, k = self._map(length), len(self.w)
        states, strays = np.empty((count + 1, 2 * k + 1)), np.empty(count)
        states[0] = self.state
        begin, switch = self.time, self.drive.until(self.stage)
        decay, crossed, made = math.exp(-self.rate * length), False, 0
        inverse, state = length / 2 / self.body.mass, self.state
        for j in range(1, count + 1):
            out = step.free @ state
            time, old = begin + j * length, float(state[-1])
            free = self.rigid + float(out[2 * k])
            force = self._solve(time, free, step.speed, float(out[2 * k + 1]), step.acceleration)
            speed = free + step.speed * force
            if speed >= switch[0]:
                crossed = True
                break
            state = out[: 2 * k + 1]
            state[: 2 * k] += step.new * force
            state[-1] = force
            self.rigid += inverse * (old + force)
            self._kick((force - old) / length, decay)
            states[j], strays[j - 1], made = state, min(self.total, self.envelope * self.decaying), j
            self.state = state
            self._node(time, speed)
        self.time = begin + made * length
        if made:
            self._see(begin, length, states[: made + 1], strays[:made])
        if crossed:
            self._switch(length, switch[0])
        elif self.time >= switch[1] * (1 - 1e-12):
            self.stage += 1
            self._enter()
        elif any(abs(kink - self.time) <= _SAME * self.plan.step for kink in self.drive.kinks):
            self._enter()
        return made + 1

    def _node(self, time: float, speed: float) -> None:
        self.found.times.append(time)
        self.found.speeds.append(speed)
        self.found.forces.append(float(self.state[-1]))

    def _kick(self, slope: float, decay: float) -> None:
        """A change of slope kicks the modes left out."""
        kick = abs(slope - self.slope) / self.fastest
        self.total += kick
        self.decaying = (self.decaying + kick) * decay if decay < 1 else self.decaying + kick
        self.slope = slope

    def _switch(self, length: float, speed: float) -> None:
        """The part of a step up to the speed at which the next stage begins, and the force behind it."""
        k, before = len(self.w), self.state.copy()

        def reached(part: float) -> tuple[float, float, FloatArray, Step]:
            step = self._mapped(part)
            out = step.free @ before
            free = self.rigid + float(out[2 * k])
            force = self._solve(self.time + part, free, step.speed, float(out[2 * k + 1]), step.acceleration)
            return free + step.speed * force - speed, force, out, step

        low, high = 0.0, length
        for _ in range(_ITERATIONS):
            middle = (low + high) / 2
            low, high = (middle, high) if reached(middle)[0] < 0 else (low, middle)
            if high - low <= 1e-9 * length:
                break
        _, force, out, step = reached(high)
        state = out[: 2 * k + 1].copy()
        state[: 2 * k] += step.new * force
        state[-1] = force
        self.rigid += high / 2 / self.body.mass * (float(before[-1]) + force)
        self._kick((force - float(before[-1])) / high, 1.0)
        self._see(
            self.time, high, np.stack([before, state]), np.array([min(self.total, self.envelope * self.decaying)])
        )
        self.state, self.time, self.stage = state, self.time + high, self.stage + 1
        self._node(self.time, speed)
        self._enter()

    # -- extremes ---------------------------------------------------------------------------------------------------

    def _see(self, begin: float, length: float, states: FloatArray, strays: FloatArray) -> None:
        """Take in the samples of steps."""
        places, w, zeta, k = self.places, self.w, self.zeta, len(self.w)
        if not len(places.whole):
            return
        y, rate, force = states[:-1, :k], states[:-1, k : 2 * k], states[:, -1]
        slope = np.diff(force)[:, None] / length
        d = 2 * zeta * w * rate + w**2 * y - force[:-1, None]
        d_rate = w**2 * rate - slope - 2 * zeta * w * d
        swings = np.hypot(d, d_rate / w)
        np.maximum(self.found.swings, swings.max(axis=0), out=self.found.swings)
        bends = (swings * (w**2 * (1 + 2 * zeta))) @ np.abs(places.gains) / 8
        subs = self._samples(length, float(bends.max()))
        missed = bends * (length / subs) ** 2
        neglected = strays[:, None] * places.left_out
        tops, lows = np.full_like(missed, -math.inf), np.full_like(missed, math.inf)
        for sub in range(subs + 1):
            since = length * sub / subs
            maps = free_motion(w, zeta, np.array([since]))
            sums = (d * maps[:, 0, 0] + d_rate * maps[:, 0, 1]) @ places.gains
            sums += (force[:-1, None] + slope * since) * places.whole
            self._best(sums, begin + since, length)
            np.maximum(tops, sums, out=tops)
            np.minimum(lows, sums, out=lows)
            if self.plan.keep and sub < subs:
                at = begin + since + length * np.arange(len(sums))
                self.found.samples.append(np.stack([at, sums[:, 0]], axis=1))
        found = self.found
        np.maximum(found.largest_low, (tops - neglected).max(axis=0), out=found.largest_low)
        np.minimum(found.smallest_high, (lows + neglected).min(axis=0), out=found.smallest_high)
        missed += neglected
        high, low = (tops + missed).max(axis=0), (lows - missed).min(axis=0)
        np.maximum(found.largest_high, high, out=found.largest_high)
        np.minimum(found.smallest_low, low, out=found.smallest_low)
        part = sum(mark <= begin + _ROUNDED * length for mark in self.plan.marks)
        np.maximum(found.parts_high[part], high, out=found.parts_high[part])
        np.minimum(found.parts_low[part], low, out=found.parts_low[part])

    def _samples(self, length: float, bend: float) -> int:
        """Samples of a step: half a unit of angle of the fastest mode apart, or so close that nothing is missed."""
        wanted = _TURN / self.fastest if len(self.w) else math.inf
        if bend > 0:
            wanted = max(wanted, math.sqrt(_MISSED * self.plan.tolerance / bend))
            return max(math.ceil(length / wanted), 1)
        return 1

    def _best(self, sums: FloatArray, first: float, length: float) -> None:
        found, columns = self.found, np.arange(sums.shape[1])
        where = sums.argmax(axis=0)
        better = sums[where, columns] > found.largest
        found.largest[better] = sums[where, columns][better]
        found.largest_time[better] = first + length * where[better]
        where = sums.argmin(axis=0)
        better = sums[where, columns] < found.smallest
        found.smallest[better] = sums[where, columns][better]
        found.smallest_time[better] = first + length * where[better]

    # -- end --------------------------------------------------------------------------------------------------------

    def _cannot_raise(self) -> bool:
        """Whether nothing to come is an extreme of any place, or more than the tolerance."""
        found, after = self.found, self.found.after
        enough = self.plan.tolerance
        return bool(
            np.all(after <= np.maximum(found.largest, enough)) and np.all(after <= np.maximum(-found.smallest, enough))
        )

    def _after(self) -> FloatArray:
        """Bound of every place from now on; infinite where the torque may rise with the speed."""
        places, body, k = self.places, self.body, len(self.w)
        none = np.full(len(places.whole), math.inf)
        to_come = self.drive.to_come(self.time)
        if not math.isfinite(to_come) or not self._stays_on_falling_torque():
            return none
        y, rate, force = self.state[:k], self.state[k : 2 * k], float(self.state[-1])
        bent = force - 2 * self.zeta * self.w * rate - self.w**2 * y
        twice = force**2 / body.mass + float(body.mobilities @ (bent**2 + self.w**2 * rate**2))
        stray = min(self.total, self.envelope * self.decaying)
        twice += 2 * body.left_out * stray**2
        swung = force / body.mass + float(body.mobilities @ bent)
        twice += body.spare * swung**2
        root = math.sqrt(twice) + to_come / math.sqrt(body.drive_mass)
        return np.sqrt(places.masses) * root

    def _stays_on_falling_torque(self) -> bool:
        """Whether the speed stays where the torque falls with it."""
        k, body = len(self.w), self.body
        y, rate = self.state[:k], self.state[k : 2 * k]
        speed = self.rigid + float(self.felt @ rate)
        settles = self._operating_speed(speed)
        if settles is None:
            return False
        twice = (body.mass + body.spare) * (self.rigid - settles) ** 2
        twice += float(body.mobilities @ (rate**2 + self.w**2 * y**2)) + body.spare * (speed - settles) ** 2
        reach = math.sqrt(twice / body.drive_mass)
        if self.drive.until(self.stage)[0] <= settles + reach or math.isfinite(self._next()):
            return False
        looks = np.linspace(settles - reach, settles + reach, _LOOKS)
        pulls = np.array([self.drive.force(self.stage, self.time, float(one))[0] for one in looks])
        return bool(np.all(np.diff(pulls) <= 0))

    def _operating_speed(self, speed: float) -> float | None:
        """Nearest speed at which the force of the drive is the resistance [m/s]."""
        ahead = 1.0 if self.drive.force(self.stage, self.time, speed)[0] > 0 else -1.0
        near, width = speed, 1e-6 * max(abs(speed), 1e-9)
        for _ in range(_ITERATIONS):
            far = near + ahead * width
            if self.drive.force(self.stage, self.time, far)[0] * ahead <= 0:
                break
            near, width = far, 2 * width
        else:
            return None
        for _ in range(_ITERATIONS):
            middle = (near + far) / 2
            if self.drive.force(self.stage, self.time, middle)[0] * ahead > 0:
                near = middle
            else:
                far = middle
        return far
