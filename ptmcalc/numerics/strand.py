"""Method of characteristics for a closed loop of two elastic strands round a drive drum.

Coordinate along the belt: drum run-off -> return strand -> tail -> carry strand -> drum run-on. With dynamic
tension S, speed v, wave speed c and impedance Z of a strand, P = S + Z v travels against the belt and N = S - Z v
with it, both unchanged at speed c. The time step divides both travel times, so transport is exact: a strand is a
pure delay, and only the drum, the tail and the take-up compute.

Drum of mass m (force imposed)    m v' + (Z_1 + Z_2) v = F + P_off - N_on        fixed loop length
                                  m v' + Z_1 v = F - N_on                        constant tension at the run-off
Tail of mass m_t                  m_t v' + (Z_1 + Z_2) v = P_carry - N_return
Constant-tension take-up          N_off = -P_off (dynamic), it travels with half the speed difference

Each is a first-order equation advanced by the exponential step for a forcing that is a polynomial over a panel of one
step or several, which is exact for m -> 0 (a trapezoidal step would ring); for one step it is of second order. Echoes
arrive on the grid, so the corners of the solution are samples of it, and ends of panels where the drive has none.

What arrives within twice the travel time of the shorter strand is known before: over such a block each equation is
y_k = d y_(k-1) + u_k with given u, advanced as a whole (`Fading`). Only where the belt slips it goes step by step.

**Grip.** With a friction exponent mu alpha given, the belt sticks to the drum while the tight side is below
exp(mu alpha) times the slack side (both less rho v^2). Slip begins and ends at the root of that condition inside
a step; while slipping the belt speed follows from the friction law and the drum moves on its own.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache, cached_property, partial
from typing import TypeVar

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics import energy
from ptmcalc.numerics.collocation import gauss
from ptmcalc.numerics.free_waves import Row
from ptmcalc.numerics.loop import BACKWARD, Drive, Extreme, FloatArray, Grid, Loop, Motion, Strand, at_end, steps_of

_EVENTS_PER_STEP = 8
_ROOT_STEPS = 60
_STRETCH, _AT_ONCE = 32, 128
_READ = 8192
"""Times that are read at once: as many as the cache holds."""
_Values = TypeVar("_Values", float, FloatArray)
_GAUSS, _FADED = 32, 40.0
_SHOWN = 60
"""Stretches of a strand whose ends are shown."""
_ENDING = 64
"""Stretches of a strand by which the waves at the end are told."""


def march(loop: Loop, drive: Drive, window: float, grid: Grid) -> Motion:
    """Carry the loop from its static state through the window [s].

    Raises:
        NumericsError: NUM101 when the window needs more steps than MOST_STEPS, when slip and stick alternate
            without end inside a step, or when the belt lifts off the drum by its own centrifugal force.
    """
    return _Marched(loop, drive, window, grid).motion()


def run_on(loop: Loop, drive: Drive, window: float, grid: Grid, when: FloatArray) -> FloatArray:
    """Run-on tension at the times `when` [N], no later than the window, without anything else `march` answers.

    Between the samples it is the polynomial that the waves were advanced with.
    """
    marched = _Marched(loop, drive, window, grid)
    return loop.carry.static_end + between(marched.run_on(), grid, when)


def between(history: FloatArray, grid: Grid, when: FloatArray) -> FloatArray:
    """A history of samples at the times `when`, by the polynomials through the samples of every panel."""
    many = grid.panel
    panels = np.lib.stride_tricks.sliding_window_view(history, many + 1)[::many]
    coefficients = _to_chebyshev(many) @ panels.T
    found = np.empty(len(when))
    for begin in range(0, len(when), _READ):
        part = slice(begin, begin + _READ)
        found[part] = _summed(coefficients, when[part] / (grid.step * many))
    return found


def _summed(coefficients: FloatArray, place: FloatArray) -> FloatArray:
    """Sums of Chebyshev polynomials at places counted in panels, by the recurrence of Clenshaw."""
    which = np.minimum(place, coefficients.shape[1] - 1).astype(np.intp)
    twice, newer, older = 4 * (place - which) - 2, np.zeros(len(place)), np.zeros(len(place))
    spare = np.empty(len(place))
    for one in coefficients[:0:-1]:
        np.subtract(one.take(which), older, out=older)
        older += np.multiply(twice, newer, out=spare)
        newer, older = older, newer
    twice *= newer / 2
    return np.asarray(coefficients[0].take(which) - older + twice)


@cache
def _to_chebyshev(many: int) -> FloatArray:
    """Chebyshev coefficients of the polynomial through the samples of a panel of so many steps."""
    at_samples = np.polynomial.chebyshev.chebvander(np.linspace(-1.0, 1.0, many + 1), many)
    found: FloatArray = np.asarray(np.linalg.inv(at_samples), float)
    found.setflags(write=False)
    return found


class _Node:
    """m v' + Z v = g(t) by the exponential step for g a polynomial through the samples of a panel of steps."""

    def __init__(self, mass: float, impedance: float, step: float, panel: int = 1) -> None:
        self.impedance = impedance
        self.rate = impedance / mass if mass > 0 else math.inf
        self.full = weights(self.rate * step)
        self.step_size = step
        self.panel = panel
        fading = self.full[0] ** np.arange(1, panel + 1)
        self.kernel = np.concatenate([panel_weights(self.rate * step, panel).T / impedance, fading[None]])
        self.ends = Fading(float(fading[-1]))
        self.speed = 0.0
        self.forcing = 0.0

    def block(self, forcing: FloatArray) -> FloatArray:
        """Speeds at the samples after the present one, at which the forcing is given: whole panels of them."""
        if math.isinf(self.rate):
            speeds = forcing / self.impedance
            self.go_on(float(speeds[-1]), float(forcing[-1]))
            return speeds
        panels = forcing.reshape(-1, self.panel)
        inputs = np.empty((len(panels), self.panel + 2))  # of each: forcing at start and samples, speed at the start
        inputs[:, 1:-1] = panels
        inputs[0, 0], inputs[1:, 0] = self.forcing, panels[:-1, -1]
        ends = self.ends.run(self.speed, inputs[:, :-1] @ self.kernel[:-1, -1])
        inputs[0, -1], inputs[1:, -1] = self.speed, ends[:-1]
        self.go_on(float(ends[-1]), float(forcing[-1]))
        return np.asarray((inputs @ self.kernel).ravel())

    def go_on(self, speed: float, forcing: float) -> None:
        """Take this as the present sample."""
        self.speed, self.forcing = speed, forcing

    def part(self, speed: float, before: float, after: float, share: float) -> float:
        """Speed after a share of a step from `speed`, with the forcing going from `before` to `after`."""
        decay, old, new = weights(self.rate * self.step_size * share)
        return decay * speed + (old * before + new * after) / self.impedance


def weights(x: float) -> tuple[float, float, float]:
    """exp(-x) and the weights of the forcing at the start and the end of a step of x time constants."""
    if math.isinf(x):
        return 0.0, 0.0, 1.0
    grown = -math.expm1(-x)
    slope = x / 2 - x * x / 6 + x**3 / 24 - x**4 / 120 if x < 1e-3 else 1 - grown / x
    return math.exp(-x), grown - slope, slope


class Fading:
    """y_k = d y_(k-1) + u_k for many k at once: a convolution with the powers of d; for very many the same powers over
    stretches, and from one of these to the next the same rule with the power of d over a whole one."""

    def __init__(self, decay: float) -> None:
        self.powers = decay ** np.arange(_AT_ONCE + 1.0)
        self.fading = self.powers[1 : _STRETCH + 1]
        self.decay = decay
        self.longer: Fading | None = None

    @cached_property
    def within(self) -> FloatArray:
        """What is given at one place of a stretch, at each of them."""
        ahead = np.concatenate([np.zeros(_STRETCH - 1), self.powers[:_STRETCH]])
        return np.lib.stride_tricks.sliding_window_view(ahead, _STRETCH)[::-1].copy()

    def run(self, start: float, given: FloatArray) -> FloatArray:
        """y_1 ... y_n from y_0 = `start`."""
        n = len(given)
        if n <= _AT_ONCE:
            return np.convolve(np.concatenate([[start], given]), self.powers[: n + 1])[1 : n + 1]
        whole = -(-n // _STRETCH)
        padded = np.zeros((whole, _STRETCH))
        padded.ravel()[:n] = given
        if self.longer is None:
            self.longer = Fading(float(self.fading[-1]))
        found: FloatArray = padded @ self.within
        starts = np.empty(whole)
        starts[0], starts[1:] = start, self.longer.run(start, found[:-1, -1])
        found += starts[:, None] * self.fading
        return np.asarray(found.ravel()[:n])


def _lagrange(count: int, x: FloatArray) -> list[FloatArray]:
    """The polynomials that are 1 at one of the nodes 0 ... count and 0 at the others, at x."""
    found = [np.full_like(x, (-1.0) ** count / math.factorial(count))]
    for k in range(1, count + 1):
        found.append(found[-1] * ((x - (k - 1)) * ((k - 1 - count) / k)))
    above = np.ones_like(x)
    for k in range(count, -1, -1):
        found[k] *= above
        above *= x - k
    return found


@cache
def panel_weights(x: float, panel: int) -> FloatArray:
    """Weights of the forcing at the nodes of a panel, of steps of x time constants, on the answer after every step:
    shape (panel, panel + 1).

        W_ij = int_0^i x e^(-x (i - s)) l_j(s) ds

    with l_j the polynomials of Lagrange: exact for a forcing that is one of so high a degree.
    """
    if panel == 1:
        return np.array([weights(x)[1:]])
    nodes, shares = gauss(_GAUSS)
    reach = min(_FADED / x, 1.0)  # before that, nothing is left of the forcing at the end of the step
    sharp = min(x, _FADED)
    starts = np.arange(panel)[:, None]
    inputs = np.array(_lagrange(panel, starts + 1 - reach * nodes))
    steps: FloatArray = np.einsum("jiq,q->ij", inputs, shares * sharp * np.exp(-sharp * nodes))
    for i in range(1, panel):
        steps[i] += math.exp(-x) * steps[i - 1]
    steps.setflags(write=False)
    return steps


class _Drum:
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
        self.node = _Node(loop.drum_mass, self.z_carry + self.z_off, step, grid.panel)
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


class _Delays:
    """Strands without sag: pure delays. Waves leaving drum, tail and run-off are kept as histories, each behind the
    rest of a strand that nothing has entered yet: what is `cells` samples old comes out at the other end."""

    def __init__(self, loop: Loop, grid: Grid, steps: int, last_share: float) -> None:
        self.loop, self.grid, self.steps, self.last_share = loop, grid, steps, last_share
        n = -(-steps // grid.panel) * grid.panel + 1
        self.cells = grid.carry, grid.back
        self.cell_updates = n - 1
        self.carry = np.zeros((2, grid.carry + n))  # P from the drum, N from the tail
        self.back = np.zeros((2, grid.back + n))  # P from the tail, N from the run-off
        self.tail_speed = np.zeros(n)

    def run(self, drum: _Drum, tail: _Node) -> None:
        """The drum's waves come back no sooner than after twice the shorter strand, by way of the tail: over so long a
        block all that arrives at it is known, once the tail has been carried to the middle of that block."""
        z_carry, z_back = self.loop.impedances
        fixed, carry, back = self.loop.fixed_length, self.grid.carry, self.grid.back
        from_drum, into_carry = self.carry
        into_back, from_off = self.back
        last, shorter = len(self.tail_speed), min(carry, back)

        def at_tail(first: int, end: int) -> None:
            p_tail, n_tail = from_drum[first:end], from_off[first:end]
            v_tail = self.tail_speed[first:end] = tail.block(p_tail - n_tail)
            np.subtract(p_tail, 2 * z_carry * v_tail, out=into_carry[carry + first : carry + end])
            np.add(n_tail, 2 * z_back * v_tail, out=into_back[back + first : back + end])

        def at_drum(first: int, end: int) -> None:
            n_on, p_off = into_carry[first:end], into_back[first:end]
            belt = drum.block(first, n_on, p_off)
            np.add(n_on, 2 * z_carry * belt, out=from_drum[carry + first : carry + end])
            from_off[back + first : back + end] = p_off - 2 * z_back * belt if fixed else -p_off

        at_tail(1, min(1 + shorter, last))
        for first in range(1, last, 2 * shorter):
            middle, end = first + shorter, min(first + 2 * shorter, last)
            at_drum(first, end)
            if middle < last:
                at_tail(middle, min(middle + 2 * shorter, last))

    def waves(self) -> FloatArray:
        """What leaves drum, tail, tail and run-off, at the samples of the window."""
        return np.concatenate([self.carry[:, self.grid.carry :], self.back[:, self.grid.back :]])[:, : self.steps + 1]

    def extremes(self, strand: Strand, carry: bool) -> tuple[Extreme, Extreme]:
        """Largest and smallest tension of a strand, over every pair of samples of its two waves.

        A sample of P and one of N meet at a node at a sample of time, or in the middle of a cell half a step later;
        between them the waves are linear, so no other place holds an extreme of the sampled waves. Sample u of P and
        sample v of N meet u - v half cells from the middle of the strand, and the static tension is linear along it:
        the tension is a number of u and one of v, and u meets a stretch of the v.
        """
        cells = self.cells[0 if carry else 1]
        p, n = (self.carry if carry else self.back)[:, : cells + self.steps + 1]
        static = strand.static(np.arange(2 * cells + 1) / (2 * cells))
        along = (static[-1] - static[0]) / (2 * cells) * (np.arange(len(p)) - self.steps / 2)
        last = 2 * self.steps - 2 + (self.last_share >= 0.5)
        recent = range(max(self.steps - 2, 0), self.steps + 1)
        rows = [static[::2] + (p[i : i + cells + 1] + n[i : i + cells + 1][::-1]) / 2 for i in recent]
        final = at_end(np.array(rows), self.last_share)
        steady = 8 * np.finfo(float).eps * max(np.abs(p).max(), np.abs(n).max(), *np.abs(static[[0, -1]]))

        def tension(u: int, v: int) -> float:
            return float(static[u - v + cells] + (p[u] + n[v]) / 2)

        found = []
        for sign in (1, -1):
            best, at = -math.inf, (0, 0)
            for early, late in ((p, n[cells:]), (n, p[cells:])):  # both ends, which win what is equal inside
                i = int((sign * (early[: len(late) - 1] + late[:-1])).argmax())
                pair = (i, i + cells) if early is p else (i + cells, i)
                if sign * tension(*pair) > best:
                    best, at = sign * tension(*pair), pair
            pair = best_pair(sign * (p / 2 + along), sign * (n / 2 - along), cells, last)
            if sign * tension(*pair) > best + steady:
                best, at = sign * tension(*pair), pair
            place = int((sign * final).argmax())
            if sign * final[place] > best + steady:
                best, at = sign * float(final[place]), (self.steps + place, self.steps + cells - place)
            u, v = self._first(sign * (p / 2), sign * (n / 2), at, last, steady)
            missed = (_bend(p, u) + _bend(n, v)) / 2
            time, position = (u + v - cells) / 2 * self.grid.step, (u - v + cells) / (2 * cells) * strand.length
            found.append(Extreme(sign * best, time, position, missed))
            self.cell_updates += len(p) * cells.bit_length()
        return found[0], found[1]

    def _first(self, p: FloatArray, n: FloatArray, at: tuple[int, int], last: int, steady: float) -> tuple[int, int]:
        """The first pair at the place of another one that comes as high: a tension that rests does so from then on."""
        u, v = at
        past = min(u, v, (u + v - len(p) + self.steps + 1) // 2)
        if u + v - len(p) + self.steps + 1 > last:
            return at
        before = p[u - past : u + 1] + n[v - past : v + 1]
        back = past - int((before >= before[-1] - steady).argmax())
        return u - back, v - back

    def stored(self) -> float:
        """Kinetic and elastic energy of the waves on both strands at the end [J]."""
        total = 0.0
        for waves, cells, z in zip((self.carry, self.back), self.cells, self.loop.impedances, strict=True):
            for one in waves[:, self.steps : self.steps + cells + 1]:
                total += energy.work(one**2, self.grid.step) / (4 * z)
        return total

    def ending(self, masses_rates: float, drum: float) -> Row:
        """The belt at the end as a row of masses: `masses_rates` is the energy of the rates of tail and drum [J/s^2],
        `drum` the speed that both ends of the belt have there [m/s]."""
        loop, rates = self.loop, masses_rates
        masses, compliances, speeds, pulls = [0.0], [], [], []
        strands = ((self.back, self.cells[1], 0), (self.carry, self.cells[0], 1))
        for (towards_start, towards_end), cells, which in strands:
            z = loop.impedances[1 - which]
            going = slice(self.steps, self.steps + cells + 1)
            p, n = towards_start[going], towards_end[going][::-1]
            for one in (p, n):
                rates += float((np.diff(one) ** 2).sum()) / self.grid.step / (4 * z)
            nodes = np.unique(np.rint(np.linspace(0, cells, min(cells, _ENDING) + 1)).astype(int))
            sums = np.concatenate([[0.0], np.cumsum((p[1:] + n[1:] + p[:-1] + n[:-1]) / 4)])
            part = np.diff(nodes)
            half = z * part * self.grid.step / 2
            masses[-1] += half[0] + loop.tail_mass * which
            masses += (half + np.append(half[1:], 0.0)).tolist()
            compliances += (part * self.grid.step / z).tolist()
            pulls += (np.diff(sums[nodes]) / part).tolist()
            speeds += ((p - n)[nodes[which:]] / (2 * z) - drum).tolist()
        held = (0, -1) if loop.fixed_length else (-1,)
        return Row(np.array(masses), np.array(compliances), np.array(speeds), np.array(pulls), held, rates)


def envelopes(loop: Loop, motion: Motion, window: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Places along the belt from the head's run-off [m], and the largest and the smallest tension there [N].

    Of strands that are pure delays: two waves that were sampled where they left meet at a place after their ways to it.
    The places are some tens on each strand, on the nodes of the grid, its ends among them.
    """
    steps, last_share = steps_of(window, motion.grid)
    from_drum, from_tail, into_back, from_off = motion.waves
    found = []
    for strand, cells, towards_start, towards_end, ahead in (
        (loop.back, motion.grid.back, into_back, from_off, 0.0),
        (loop.carry, motion.grid.carry, from_drum, from_tail, loop.back.length),
    ):
        nodes = np.unique(np.rint(np.linspace(0, cells, _SHOWN + 1)).astype(int))
        static = strand.static(nodes / cells)
        tops, lows = np.empty(len(nodes)), np.empty(len(nodes))
        for k, node in enumerate(nodes.tolist()):
            both = _arrived(towards_start, cells - node, steps) + _arrived(towards_end, node, steps)
            course = static[k] + both / 2
            course[-1] = at_end(course, last_share)
            tops[k], lows[k] = course.max(), course.min()
        found.append((ahead + nodes / cells * strand.length, tops, lows))
    places, highest, lowest = (np.concatenate(parts) for parts in zip(*found, strict=True))
    return places, highest, lowest


def _arrived(wave: FloatArray, late: int, steps: int) -> FloatArray:
    """What a wave is, so many steps after it left: nothing before it has come."""
    return np.concatenate([np.zeros(min(late, steps + 1)), wave[: max(steps + 1 - late, 0)]])


def _bend(wave: FloatArray, at: int) -> float:
    """What a wave with a corner next to a sample rises over the straight line between its samples, at most.

    A corner at the share x of a step h, where the slope changes by d, lies h x (1 - x) d <= h d / 4 from that line;
    the second differences at both ends of its cell sum up to h d.
    """
    second = np.abs(np.diff(wave[max(at - 2, 0) : at + 3], 2))
    return float((second[1:] + second[:-1]).max(initial=0.0)) / 4


def best_pair(one: FloatArray, other: FloatArray, cells: int, last: int) -> tuple[int, int]:
    """The u and v at which one[u] + other[v] is largest, with |u - v| <= cells and 0 <= u + v - cells <= last.

    For most u the v are a stretch of 2 cells + 1, whose largest is that of two stretches of a power of 2; such of the
    double length are had from the single ones. The first of both histories are those of a strand at rest: what
    pairs them with u + v < cells is what rests at u + v = cells, and is taken for it.
    """
    count, whole = last // 2 + 1, 2 * cells + 1
    u = np.arange(count, (cells + last + cells) // 2 + 1)
    low, lengths = u - cells, 2 * cells + last - 2 * u + 1
    levels = np.frexp(lengths)[1] - 1
    tables = np.concatenate([np.full(cells, -np.inf), other, np.full(cells, -np.inf)])
    late = np.full(len(u), -np.inf)
    for level in range(whole.bit_length()):
        if level:
            tables = np.maximum(tables[: -(1 << level - 1)], tables[1 << level - 1 :])
        mine = levels == level
        first = low[mine] + cells
        late[mine] = np.maximum(tables[first], tables[first + lengths[mine] - (1 << level)])
    rest = whole - (1 << whole.bit_length() - 1)
    early = np.maximum(tables[:count], tables[rest : rest + count])
    best = int((one[: count + len(u)] + np.concatenate([early, late])).argmax())
    start = max(best - cells, 0)
    stop = min(best + cells, cells + last - best) + 1
    found = start + int(other[start:stop].argmax())
    ahead = max(-(-(cells - best - found) // 2), 0)
    return best + ahead, found + ahead


class _Marched:
    """A loop carried through the window: the histories, from which the answer is made."""

    def __init__(self, loop: Loop, drive: Drive, window: float, grid: Grid) -> None:
        self.loop, self.grid = loop, grid
        self.steps, self.last_share = steps_of(window, grid)
        self.interior = _Delays(loop, grid, self.steps, self.last_share)
        times = np.arange(len(self.interior.tail_speed), dtype=np.float64) * grid.step
        self.times = times[: self.steps + 1]
        self.drum = _Drum(loop, drive, times, grid)
        self.tail = _Node(loop.tail_mass, sum(loop.impedances), grid.step, grid.panel)
        self.interior.run(self.drum, self.tail)

    def run_on(self) -> FloatArray:
        """Dynamic tension of the run-on at every sample."""
        belt = self.drum.belt
        tension = self.drum.z_carry * belt
        tension += self.interior.carry[1, : len(belt)]
        return tension

    def run_off(self) -> FloatArray:
        """Dynamic tension of the run-off at every sample."""
        belt = self.drum.belt
        if not self.loop.fixed_length:
            return np.zeros(len(belt))
        return np.asarray(self.interior.back[0, : len(belt)] - self.drum.z_off * belt)

    def motion(self) -> Motion:
        """What `march` answers."""
        loop, drum, interior = self.loop, self.drum, self.interior
        rim = drum.belt.copy() if drum.grip is None else drum.drum
        belt, rim, on, off = (one[: self.steps + 1] for one in (drum.belt, rim, self.run_on(), self.run_off()))
        carry_max, carry_min = interior.extremes(loop.carry, carry=True)
        back_max, back_min = interior.extremes(loop.back, carry=False)
        ahead = loop.back.length
        tail = interior.tail_speed[: self.steps + 1]
        residual = _balance(loop, drum, float(tail[-1]), interior, belt, rim, on, off, self.grid.step)
        for history in (self.times, belt, rim, on, off):
            history[-1] = at_end(history, self.last_share)
        return Motion(
            grid=self.grid,
            times=self.times,
            waves=interior.waves(),
            belt_speed=belt,
            drum_speed=rim,
            run_on=loop.carry.static_end + on,
            run_off=loop.back.static_start + off,
            carry_max=carry_max.moved(ahead),
            carry_min=carry_min.moved(ahead),
            back_max=back_max,
            back_min=back_min,
            slipped=drum.slipped,
            reversed=bool(min(belt.min(), tail.min()) < -BACKWARD * max(belt.max(), rim.max())),
            energy_residual=residual,
            cell_updates=interior.cell_updates,
            ending=interior.ending(self._masses_rates(), float(drum.belt[self.steps])),
            tail=min(self.grid.back, _ENDING),
        )

    def _masses_rates(self) -> float:
        """Energy of the rates of tail and drum at the end [J/s^2]."""
        before, last, step = self.steps - 1, self.steps, self.grid.step
        tail, drum = self.interior.tail_speed, self.drum
        total = self.loop.tail_mass * float((tail[last] - tail[before]) / step) ** 2
        if drum.speeds is None:
            total += self.loop.drum_mass * float((drum.drum[last] - drum.drum[before]) / step) ** 2
        return total / 2


def _balance(
    loop: Loop,
    drum: _Drum,
    tail_speed: float,
    interior: _Delays,
    belt: FloatArray,
    rim: FloatArray,
    on: FloatArray,
    off: FloatArray,
    step: float,
) -> float:
    """Work put in at the drum against energy of belt, tail and drum and the heat of slip, in dynamic quantities."""
    stored = interior.stored() + loop.tail_mass * tail_speed**2 / 2
    through = energy.work((on - off) * belt, step)
    scale = energy.work(np.abs((on - off) * belt), step) + loop.least_energy
    belt_part = energy.residual(through, 0.0, stored, scale)
    if drum.forces is None or drum.was_held:
        return belt_part
    put_in = energy.work(drum.forces[: len(rim)] * rim, step)
    heat = energy.work((on - off) * (rim - belt), step)
    drum_part = energy.residual(put_in, heat + through, loop.drum_mass * float(rim[-1]) ** 2 / 2, scale)
    return max(belt_part, drum_part)
