"""Method of characteristics for a closed loop of two elastic strands round a drive drum.

Coordinate along the belt: drum run-off -> return strand -> tail -> carry strand -> drum run-on. With dynamic
tension S, speed v, wave speed c and impedance Z of a strand, P = S + Z v travels against the belt and N = S - Z v
with it, both unchanged at speed c. The time step divides both travel times, so transport is exact: a strand is a
pure delay, and only the drum, the tail and the take-up compute.

Drum of mass m (force imposed)    m v' + (Z_1 + Z_2) v = F + P_off - N_on        fixed loop length
                                  m v' + Z_1 v = F - N_on                        constant tension at the run-off
Tail of mass m_t                  m_t v' + (Z_1 + Z_2) v = P_carry - N_return
Constant-tension take-up          N_off = -P_off (dynamic), it travels with half the speed difference

Each is a first-order equation advanced by the exponential step for a forcing that is linear over the step, which
is exact for m -> 0 (a trapezoidal step would ring) and second order otherwise. Echoes arrive on the grid, so the
corners of the solution are samples of it.

**Grip.** With a friction exponent mu alpha given, the belt sticks to the drum while the tight side is below
exp(mu alpha) times the slack side (both less rho v^2). Slip begins and ends at the root of that condition inside
a step; while slipping the belt speed follows from the friction law and the drum moves on its own.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics import energy
from ptmcalc.numerics.loop import BACKWARD, Drive, Extreme, FloatArray, Grid, Loop, Motion, Strand, at_end, steps_of

_EVENTS_PER_STEP = 8
_ROOT_STEPS = 60
_Peak = tuple[float, int]
"""A value, with its sign turned where the smallest is wanted, and the sample it occurs at."""


def march(loop: Loop, drive: Drive, window: float, grid: Grid) -> Motion:
    """Carry the loop from its static state through the window [s].

    Raises:
        NumericsError: NUM101 when the window needs more steps than MOST_STEPS, when slip and stick alternate
            without end inside a step, or when the belt lifts off the drum by its own centrifugal force.
    """
    steps, last_share = steps_of(window, grid)
    times = np.arange(steps + 1, dtype=np.float64) * grid.step
    drum = _Drum(loop, drive, times, grid.step)
    tail = _Node(loop.tail_mass, sum(loop.impedances), grid.step)
    interior = _Delays(loop, grid, steps, last_share)
    interior.run(drum, tail)
    return _motion(loop, grid, times, last_share, drum, tail, interior)


class _Node:
    """m v' + Z v = g(t) by the exponential step for g linear over the step."""

    def __init__(self, mass: float, impedance: float, step: float) -> None:
        self.impedance = impedance
        self.rate = impedance / mass if mass > 0 else math.inf
        self.full = weights(self.rate * step)
        self.step_size = step
        self.speed = 0.0
        self.forcing = 0.0

    def step(self, forcing: float) -> float:
        """Speed at the end of the step, at which the forcing is `forcing`."""
        decay, old, new = self.full
        self.speed = decay * self.speed + (old * self.forcing + new * forcing) / self.impedance
        self.forcing = forcing
        return self.speed

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


class _Drum:
    """The drive drum: sticks to the belt, or slips on it."""

    def __init__(self, loop: Loop, drive: Drive, times: FloatArray, step: float) -> None:
        self.z_carry, self.z_back = loop.impedances
        self.fixed = loop.fixed_length
        self.z_off = self.z_back if self.fixed else 0.0
        self.mass = loop.drum_mass
        self.step_size = step
        self.on_static, self.off_static = loop.carry.static_end, loop.back.static_start
        self.force = drive.force(times).tolist() if drive.force else None
        self.imposed = drive.speed(times).tolist() if drive.speed else None
        self.node = _Node(loop.drum_mass, self.z_carry + self.z_off, step)
        self.grip = loop.grip
        self.squeeze = math.exp(-loop.grip.exponent) if loop.grip else 0.0
        self.slipping = 0  # +1: the drum runs ahead of the belt, -1: the belt ahead of the drum
        self.slipped = False
        n = len(times)
        self.belt = [0.0] * n
        self.drum = [0.0] * n
        self.on = [0.0] * n
        self.off = [0.0] * n
        self.arriving = (0.0, 0.0)  # N at the run-on, P at the run-off, at the last sample
        if self.force:
            self.node.forcing = self.force[0]
        if self.grip:
            self.slipping = self._breaks(0.0, 0.0, 0.0)
            self.slipped = bool(self.slipping)

    def step(self, k: int, n_on: float, p_off: float) -> float:
        """Belt speed at sample k, where the waves n_on and p_off arrive."""
        if not self.grip:
            belt = drum = self._stuck(k, n_on, p_off)
        else:
            belt, drum = self._gripped(k, n_on, p_off)
        self.arriving = (n_on, p_off)
        self.belt[k], self.drum[k] = belt, drum
        self.on[k] = n_on + self.z_carry * belt
        self.off[k] = p_off - self.z_off * belt if self.fixed else 0.0
        return belt

    def _stuck(self, k: int, n_on: float, p_off: float) -> float:
        if self.imposed:
            return float(self.imposed[k])
        assert self.force is not None
        return self.node.step(self.force[k] - n_on + (p_off if self.fixed else 0.0))

    def _gripped(self, k: int, n_on: float, p_off: float) -> tuple[float, float]:
        """One step of a drum that sticks, slips, or goes from one to the other; most steps see no change."""
        if self.slipping:
            force = (self.force[k - 1], self.force[k]) if self.force else (0.0, 0.0)
            pushed = force[0] + force[1] - self._pull(*self.arriving, self.belt[k - 1])
            belt = self._slip_speed(n_on, p_off)
            if self.imposed:
                drum = self.imposed[k]
            else:
                drum = self.drum[k - 1] + self.step_size * (pushed - self._pull(n_on, p_off, belt)) / (2 * self.mass)
            if self.slipping * (drum - belt) >= 0:
                return belt, drum
        else:
            node = self.node
            forcing = (self.force[k] if self.force else 0.0) - n_on + (p_off if self.fixed else 0.0)
            if self.imposed:
                speed = self.imposed[k]
            else:
                decay, old, new = node.full
                speed = decay * self.drum[k - 1] + (old * node.forcing + new * forcing) / node.impedance
            if not self._breaks(n_on, p_off, speed):
                node.speed, node.forcing = speed, forcing
                return speed, speed
        return self._changed(k, n_on, p_off)

    def _changed(self, k: int, n_on: float, p_off: float) -> tuple[float, float]:
        """One step with slip and stick located inside it; `at` runs from 0 to 1 through the step."""
        forces = (self.force[k - 1], self.force[k]) if self.force else (0.0, 0.0)
        speeds = (self.imposed[k - 1], self.imposed[k]) if self.imposed else (0.0, 0.0)
        cell = _Cell((self.arriving[0], n_on), (self.arriving[1], p_off), forces, speeds)
        belt, drum, at = self.belt[k - 1], self.drum[k - 1], 0.0
        for _ in range(_EVENTS_PER_STEP):
            if not self.slipping:
                stuck = partial(self._stuck_at, cell, at, drum)
                speed = stuck(1.0)
                sense = self._breaks(n_on, p_off, speed)
                if not sense:
                    self.node.speed = speed
                    self.node.forcing = forces[1] - n_on + (p_off if self.fixed else 0.0)
                    return speed, speed
                breaks = _root(partial(self._excess_at, cell, stuck, sense), at, 1.0)
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
        return slipping, drum + (x - at) * self.step_size * push / (2 * self.mass)

    def _excess_at(self, cell: "_Cell", stuck: Callable[[float], float], sense: int, x: float) -> float:
        n_on, p_off, _ = cell.waves(x)
        return self._excess(n_on, p_off, stuck(x), sense)

    def _pull(self, n_on: float, p_off: float, belt: float) -> float:
        """Dynamic force the belt takes from the drum."""
        return n_on + self.z_carry * belt - (p_off - self.z_off * belt if self.fixed else 0.0)

    def _sides(self, n_on: float, p_off: float, belt: float) -> tuple[float, float]:
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
    """Strands without sag: pure delays. Waves leaving drum, tail and run-off are kept as histories."""

    def __init__(self, loop: Loop, grid: Grid, steps: int, last_share: float) -> None:
        self.loop, self.grid, self.steps, self.last_share = loop, grid, steps, last_share
        n = steps + 1
        self.cell_updates = steps
        self.from_drum = [0.0] * n  # P into the carry strand
        self.into_carry = [0.0] * n  # N from the tail
        self.into_back = [0.0] * n  # P from the tail
        self.from_off = [0.0] * n  # N into the return strand
        self.tail_speed = [0.0] * n

    def run(self, drum: _Drum, tail: _Node) -> None:
        z_carry, z_back = self.loop.impedances
        fixed, carry, back = self.loop.fixed_length, self.grid.carry, self.grid.back
        from_drum, into_carry, into_back, from_off = (
            self.from_drum,
            self.into_carry,
            self.into_back,
            self.from_off,
        )
        for k in range(1, self.steps + 1):
            n_on = into_carry[k - carry] if k >= carry else 0.0
            p_off = into_back[k - back] if k >= back else 0.0
            p_tail = from_drum[k - carry] if k >= carry else 0.0
            n_tail = from_off[k - back] if k >= back else 0.0
            belt = drum.step(k, n_on, p_off)
            from_drum[k] = n_on + 2 * z_carry * belt
            from_off[k] = p_off - 2 * z_back * belt if fixed else -p_off
            v_tail = tail.step(p_tail - n_tail)
            self.tail_speed[k] = v_tail
            into_carry[k] = p_tail - 2 * z_carry * v_tail
            into_back[k] = n_tail + 2 * z_back * v_tail

    def extremes(self, strand: Strand, carry: bool) -> tuple[Extreme, Extreme]:
        """Largest and smallest tension of a strand, over every pair of samples of its two waves.

        A sample of P and one of N meet at a node at a sample of time, or in the middle of a cell half a step later;
        between them the waves are linear, so no other place holds an extreme of the sampled waves. From one such
        place to the next the extreme over time changes by no more than the steepest step of a wave and of the static
        tension, so only stretches that could still hold a better place are looked into.
        """
        cells = self.grid.carry if carry else self.grid.back
        down, up = (self.from_drum, self.into_carry) if carry else (self.into_back, self.from_off)
        pause = np.zeros(cells)
        p, n = np.concatenate([pause, down]), np.concatenate([pause, up])
        static = strand.static(np.arange(2 * cells + 1) / (2 * cells))
        steepest = max(np.abs(np.diff(p)).max(), np.abs(np.diff(n)).max()) / 2 + abs(static[1] - static[0])
        seen: dict[int, tuple[_Peak, _Peak]] = {}

        def place(side: int, j: int) -> _Peak:
            """Extremes over time after j half cells, and the samples they occur at."""
            if j not in seen:
                middle = j % 2
                length = self.steps + 1 - (middle if self.last_share >= middle / 2 else 2)
                tension = static[j] + (p[(j + 1) // 2 :][:length] + n[cells - j // 2 :][:length]) / 2
                if not middle:
                    tension[-1] = at_end(tension, self.last_share)
                if not len(tension):  # a window of less than half a step never comes to the middle of a cell
                    return -math.inf, 0
                top, bottom = int(tension.argmax()), int(tension.argmin())
                seen[j] = (float(tension[top]), top), (-float(tension[bottom]), bottom)
                self.cell_updates += len(tension)
            return seen[j][side]

        found = []
        for side, sign in enumerate((1, -1)):
            j = _best_place(partial(place, side), 2 * cells, float(steepest))
            value, sample = place(side, j)
            missed = (_bend(p, sample + (j + 1) // 2) + _bend(n, sample + cells - j // 2)) / 2
            time, position = (sample + j % 2 / 2) * self.grid.step, j / (2 * cells) * strand.length
            found.append(Extreme(sign * value, time, position, missed))
        return found[0], found[1]

    def stored(self) -> float:
        """Kinetic and elastic energy of the waves on both strands at the end [J]."""
        total = 0.0
        for strand, cells, down, up in (
            (self.loop.carry, self.grid.carry, self.from_drum, self.into_carry),
            (self.loop.back, self.grid.back, self.into_back, self.from_off),
        ):
            z = self.loop.impedances[0 if strand is self.loop.carry else 1]
            for waves in (down, up):
                held = np.zeros(cells + 1)
                recent = np.asarray(waves[-(cells + 1) :])
                held[len(held) - len(recent) :] = recent
                total += energy.work(held**2, self.grid.step) / (4 * z)
        return total


def _bend(wave: FloatArray, at: int) -> float:
    """What a wave with a corner next to a sample rises over the straight line between its samples, at most.

    A corner at the share x of a step h, where the slope changes by d, lies h x (1 - x) d <= h d / 4 from that line;
    the second differences at both ends of its cell sum up to h d.
    """
    second = np.abs(np.diff(wave[max(at - 2, 0) : at + 3], 2))
    return float((second[1:] + second[:-1]).max(initial=0.0)) / 4


def _best_place(value: Callable[[int], _Peak], last: int, steepest: float) -> int:
    """The place of the largest value, by halving the stretches whose ends and slope allow a larger one."""
    best = max((0, last), key=lambda j: value(j)[0])
    stretches = [(0, last)]
    while stretches:
        low, high = stretches.pop()
        reach = (value(low)[0] + value(high)[0] + steepest * (high - low)) / 2
        if high - low < 2 or reach <= value(best)[0]:
            continue
        middle = (low + high) // 2
        if value(middle)[0] > value(best)[0]:
            best = middle
        stretches += [(low, middle), (middle, high)]
    return best


def _motion(
    loop: Loop,
    grid: Grid,
    times: FloatArray,
    last_share: float,
    drum: _Drum,
    tail: _Node,
    interior: _Delays,
) -> Motion:
    belt, rim = np.asarray(drum.belt), np.asarray(drum.drum)
    on, off = np.asarray(drum.on), np.asarray(drum.off)
    carry_max, carry_min = interior.extremes(loop.carry, carry=True)
    back_max, back_min = interior.extremes(loop.back, carry=False)
    ahead = loop.back.length
    residual = _balance(loop, drum, tail, interior, belt, rim, on, off, grid.step)
    for history in (times, belt, rim, on, off):
        history[-1] = at_end(history, last_share)
    return Motion(
        grid=grid,
        times=times,
        waves=np.array([interior.from_drum, interior.into_carry, interior.into_back, interior.from_off]),
        belt_speed=belt,
        drum_speed=rim,
        run_on=loop.carry.static_end + on,
        run_off=loop.back.static_start + off,
        carry_max=carry_max.moved(ahead),
        carry_min=carry_min.moved(ahead),
        back_max=back_max,
        back_min=back_min,
        slipped=drum.slipped,
        reversed=bool(min(belt.min(), *interior.tail_speed) < -BACKWARD * max(belt.max(), rim.max())),
        energy_residual=residual,
        cell_updates=interior.cell_updates,
    )


def _balance(
    loop: Loop,
    drum: _Drum,
    tail: _Node,
    interior: _Delays,
    belt: FloatArray,
    rim: FloatArray,
    on: FloatArray,
    off: FloatArray,
    step: float,
) -> float:
    """Work put in at the drum against energy of belt, tail and drum and the heat of slip, in dynamic quantities."""
    stored = interior.stored() + loop.tail_mass * tail.speed**2 / 2
    through = energy.work((on - off) * belt, step)
    scale = energy.work(np.abs((on - off) * belt), step) + loop.least_energy
    belt_part = energy.residual(through, 0.0, stored, scale)
    if drum.force is None:
        return belt_part
    put_in = energy.work(np.asarray(drum.force) * rim, step)
    heat = energy.work((on - off) * (rim - belt), step)
    drum_part = energy.residual(put_in, heat + through, loop.drum_mass * float(rim[-1]) ** 2 / 2, scale)
    return max(belt_part, drum_part)
