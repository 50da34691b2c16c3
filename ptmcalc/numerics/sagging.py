"""A loop of two strands whose spans sag: staggered grid, exact tension law in every cell.

A span of weight w l that hangs under the tension S is shorter than its belt, so the strain of a strand is

    eps(S) = S/EA - (w l)^2/(24 S^2)        d eps/dS = (1 + f)/EA,  f the softening of Ernst

which inverts to exactly one positive tension: a sagging belt never loses it. Speeds live at nodes and half steps,
tensions in cells and at whole steps:

    m_i (v_i^{n+1/2} - v_i^{n-1/2})/dt = S_ahead^n - S_behind^n          eps^{n+1} = eps^n + dt (v_{i+1} - v_i)/ds

The step is the travel time of the straight belt through the shortest cell, which transports waves there exactly;
as sag only slows them down, the scheme is stable for any sag. Grip and slip at the drum follow the same laws as in
`ptmcalc.numerics.strand`; the state changes at whole steps.

**Shocks.** A sagging belt stiffens as it is stretched, so a wave of rising tension overtakes itself and becomes a
shock, which dissipates energy; a scheme that conserves it rings instead and does not converge. A cell that is
being stretched therefore pulls more by

    q = rho (dc/dv) dv^2,    dc/dv = 3 f EA/(2 S (1 + f)^2),    dv = v_{i+1} - v_i

(J. von Neumann and R. Richtmyer, J. Appl. Phys. 21 (1950), with the belt's own rate of steepening for the gas's).
It spreads a shock over a few cells and vanishes where waves do not steepen: for a straight belt, and as the grid
is refined in every smooth wave. What it takes is counted in the energy balance.
"""

import math
from dataclasses import dataclass

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics import energy
from ptmcalc.numerics.free_waves import Row
from ptmcalc.numerics.loop import (
    BACKWARD,
    Drive,
    Extreme,
    FloatArray,
    Grid,
    Grip,
    Loop,
    Motion,
    Strand,
    at_end,
    steps_of,
)

_BLOCK = 128
_MOST_STEPS = 60
_LEAST = -0.75
_NEAR, _CLOSE = 1e-2, 1e-8
"""Squares of the relative change from which on Halley's rule is taken, and after which it is at its end."""
_STABLE = 0.25  # of the wave speed: keeps the viscous term inside the stable step


def grid_of(loop: Loop, cells: int) -> Grid:
    """Cells of about equal travel time, at least so many in the faster strand; the step is that of the shortest."""
    transits = (loop.carry.transit, loop.back.transit)
    fastest = min(transits) / cells
    carry, back = (int(transit / fastest * (1 + 1e-9)) for transit in transits)
    return Grid(min(transits[0] / carry, transits[1] / back), carry, back, 0.0)


def march(loop: Loop, drive: Drive, window: float, grid: Grid) -> Motion:
    """Carry the loop from its static state through the window [s].

    Raises:
        NumericsError: NUM101 when the window needs too many steps or the tension law does not converge; NUM102 when
            the static tension is not positive everywhere, where a sagging belt cannot hang.
    """
    steps, last_share = steps_of(window, grid)
    belt = _Belt(loop, grid)
    drum = _Drum(loop, drive, grid, belt)
    times = np.arange(steps + 1, dtype=np.float64) * grid.step
    forces = drive.force(times) if drive.force else np.zeros(steps + 1)
    half_speeds = drive.speed(times + grid.step / 2) if drive.speed else np.zeros(steps + 1)
    history = _History(steps + 1, belt)
    for n in range(steps + 1):
        share = 0.5 if n == 0 else 1.0  # the first step starts from rest at a whole step
        history.note_cells(n, belt.tension if n < steps else belt.last + last_share * (belt.tension - belt.last))
        pull = belt.tension + belt.viscous - belt.static
        speed_before, drum_before = belt.speed.copy(), drum.speed
        on, off = drum.advance(float(forces[n]), float(half_speeds[n]), pull, share)
        belt.advance(pull, share)
        history.note_ends(n, belt, drum, pull, on, off, (speed_before, drum_before) if n else None)
        if n < steps:
            belt.stretch()
    return _motion(loop, grid, times, last_share, belt, drum, forces, history)


class _Belt:
    """Nodes from the run-off (first) over the tail to the run-on (last), and the cells between them."""

    def __init__(self, loop: Loop, grid: Grid) -> None:
        self.split = grid.back
        counts = (grid.back, grid.carry)
        z_carry, z_back = loop.impedances
        self.step = grid.step
        stiffness, lump, static, size, half = [], [], [], [], []
        for strand, count, z in zip((loop.back, loop.carry), counts, (z_back, z_carry), strict=True):
            scale = z * strand.speed / strand.stiffness  # 1, unless the impedance jump is left out
            stiffness.append(np.full(count, strand.stiffness * scale))
            lump.append(np.full(count, strand.stiffness * scale * strand.span_weight**2 / 24))
            static.append(strand.static((np.arange(count) + 0.5) / count))
            size.append(np.full(count, strand.length / count))
            half.append(strand.line_mass * scale * strand.length / count / 2)
        self.half = (half[0], half[1])  # half a cell's mass of either strand
        self.stiffness, self.lump = np.concatenate(stiffness), np.concatenate(lump)
        self.static, self.size = np.concatenate(static), np.concatenate(size)
        if (self.static <= 0).any():
            raise NumericsError(
                "NUM102", "a sagging belt cannot hang without tension: its static tension is not positive"
            )
        node = np.concatenate([np.full(count, half) for count, half in zip(counts, self.half, strict=True)])
        self.mass = np.append(node, 0.0)
        self.mass[1:] += node
        self.mass[self.split] += loop.tail_mass
        self.speed = np.zeros(len(node) + 1)
        self.tension = self.last = self.static
        self.straight = self.static - self.lump / self.static**2  # tension of a belt so long that did not sag
        self.pulls = self.step * self.stiffness / self.size
        self.twice_lump = 2 * self.lump
        line_mass = 2 * node / self.size
        self.steepens = 1.5 * line_mass * self.stiffness
        self.most_viscous = _STABLE * np.sqrt(self.stiffness * line_mass)
        self.viscous = self.apart = np.zeros(len(node))
        self.dissipated = 0.0

    def advance(self, pull: FloatArray, share: float) -> None:
        """New speeds of all nodes but the ends, which the drum has set."""
        self.speed[1:-1] += share * self.step * (pull[1:] - pull[:-1]) / self.mass[1:-1]

    def stretch(self) -> None:
        """New tensions of all cells."""
        apart = self.speed[1:] - self.speed[:-1]
        self.dissipated += self.step * float(np.dot(self.viscous, apart + self.apart)) / 2
        self.straight += self.pulls * apart
        new = _tension(self.straight, self.lump, self.tension, self.last)
        self.last, self.tension = self.tension, new
        softening = self.twice_lump / (new * new * new)
        stiffer = 1 + softening
        steepening = self.steepens * softening / (new * stiffer * stiffer)
        self.apart, opening = apart, np.maximum(apart, 0.0)
        self.viscous = opening * np.minimum(steepening * opening, self.most_viscous)

    def kinetic(self, before: FloatArray, after: FloatArray) -> float:
        """Kinetic energy at a sample, from the speeds half a step before and after [J]."""
        return float(self.mass @ (before**2 + after**2)) / 4

    def stored(self, before: FloatArray, after: FloatArray) -> float:
        """Kinetic and elastic energy of the belt and of the sagging spans [J], from the speeds half a step before and
        after a sample: what the work by the trapezoidal rule adds up to, to the last digit for a straight belt.

            sum m (v-^2 + v+^2)/4 + elastic + dt/4 sum swing (dv+ - dv-)

        The square of the mean speed would leave a share over that falls with the square of the number of steps: of a
        run of two steps a sixteenth.
        """
        swing = self.tension - self.static
        elastic = swing**2 / 2 + self.lump * swing**2 / (self.tension**2 * self.static)
        opens = self.step / 4 * float(swing @ np.diff(after - before))
        return float(np.sum(self.size / self.stiffness * elastic)) + self.kinetic(before, after) + opens


def _tension(target: FloatArray, lump: FloatArray, last: FloatArray, before: FloatArray) -> FloatArray:
    """The positive root S of S - lump/S^2 = target, cell by cell, from the extrapolated tension.

    The left side rises from -infinity and is concave: Newton's steps from below the root approach it from below, a
    step from above it lands below; one that would leave the positive side is cut to a quarter. Near the root Halley's
    rule triples the digits. With r = (lump/S^2)/(S + 2 lump/S^2), 0 to 1/2, and Newton's step c as a share of S, its
    step is c/(1 - 3 r c) and leaves (9 r^2 - 4 r) c^3 of S: less than 0.45 c^3.
    """
    tension: FloatArray = np.maximum(2 * last - before, last / 2)
    for _ in range(_MOST_STEPS):
        give = lump / (tension * tension)
        slope = tension + 2 * give
        change = (target - tension + give) / slope
        size = float(change @ change)  # no less than the square of the largest
        if size <= _NEAR:
            tension = tension * (1 + change / (1 - 3 * give / slope * change))
            if size <= _CLOSE:
                return tension
        else:
            tension = tension * (1 + np.maximum(change, _LEAST))
    raise NumericsError("NUM101", "the tension of the sagging belt did not converge")


class _Drum:
    """The drum with the belt's end nodes: they stick together, or the belt slips."""

    def __init__(self, loop: Loop, drive: Drive, grid: Grid, belt: _Belt) -> None:
        self.belt, self.step, self.fixed = belt, grid.step, loop.fixed_length
        self.imposed = drive.speed is not None
        self.mass = loop.drum_mass
        self.on_half, self.off_half = belt.half[1], belt.half[0] if loop.fixed_length else 0.0
        self.on_static, self.off_static = loop.carry.static_end, loop.back.static_start
        self.grip: Grip | None = loop.grip
        self.squeeze = math.exp(-loop.grip.exponent) if loop.grip else 0.0
        self.speed = 0.0
        self.slipping = 0
        self.slipped = False
        self.hold, self.was_held = drive.hold, False
        self.keeps = False  # the belt has come to the speed that the motor holds

    def advance(self, force: float, half_speed: float, pull: FloatArray, share: float) -> tuple[float, float]:
        """Move drum and end nodes on by a share of a step; dynamic tensions at run-on and run-off."""
        step, belt = share * self.step, self.belt
        on_cell, off_cell = float(pull[-1]), float(pull[0]) if self.fixed else 0.0
        ends = self.on_half + self.off_half
        if self.keeps:
            half_speed = self.hold
        if self.imposed or self.keeps:
            together = (half_speed - self.speed) / step
        else:
            together = (force + off_cell - on_cell) / (self.mass + ends)
        reaches = self.speed + step * together > self.hold
        if reaches:
            together = (self.hold - self.speed) / step
        if not self.slipping:
            self.slipping = self._breaks(on_cell, off_cell, together)
            self.slipped |= bool(self.slipping)
        if reaches and not self.slipping:
            self.keeps = self.was_held = True
        rate = self._dragged(on_cell, off_cell, step) if self.slipping else together
        on, off = on_cell + self.on_half * rate, off_cell - self.off_half * rate
        if self.imposed or (self.keeps and self.slipping):
            self.speed = half_speed
        elif self.slipping:
            self.speed += step * (force - on + off) / self.mass
            if self.speed > self.hold:
                self.speed, self.was_held = self.hold, True
        else:
            self.speed += step * together
        end = float(belt.speed[-1]) + step * rate
        if self.slipping and self.slipping * (self.speed - end) < 0:
            self.slipping = 0
            end = self.speed = end if self.mass == 0 and not self.keeps else self._common(end, ends)
        belt.speed[-1] = end if self.slipping else self.speed
        belt.speed[0] = belt.speed[-1] if self.fixed else belt.speed[0] + step * float(pull[0]) / belt.mass[0]
        return on, off

    def _common(self, end: float, ends: float) -> float:
        """Speed after drum and belt have caught each other."""
        if self.imposed or self.keeps:
            return self.speed
        return min((self.mass * self.speed + ends * end) / (self.mass + ends), self.hold)

    def _lift(self) -> float:
        assert self.grip is not None
        return self.grip.belt_line_mass * float(self.belt.speed[-1]) ** 2

    def _breaks(self, on_cell: float, off_cell: float, rate: float) -> int:
        """The sense in which the belt would slip if it were held to the drum at this acceleration."""
        if self.grip is None:
            return 0
        lift = self._lift()
        on = self.on_static + on_cell + self.on_half * rate - lift
        off = self.off_static + off_cell - self.off_half * rate - lift
        return 1 if on * self.squeeze > off else -1 if off * self.squeeze > on else 0

    def _dragged(self, on_cell: float, off_cell: float, step: float) -> float:
        """Acceleration of the belt's end nodes under the friction limit; a belt that would run back is held."""
        lift, held = self._lift(), -float(self.belt.speed[-1]) / step
        on, off = self.on_static + on_cell - lift, self.off_static + off_cell - lift
        if self.slipping > 0:
            return max((off - self.squeeze * on) / (self.squeeze * self.on_half + self.off_half), held)
        return max((self.squeeze * off - on) / (self.on_half + self.squeeze * self.off_half), held)


@dataclass(frozen=True, slots=True)
class _Seen:
    """An extreme of the cells of a strand: value with its sign turned where the smallest is wanted, sample, cell."""

    value: float
    sample: int
    cell: int


@dataclass(frozen=True, slots=True)
class _Speeds:
    """Of the nodes and of the drum, half a step before a sample and half a step after it; before the first sample, at
    which all is at rest, those after it with the other sign."""

    before: FloatArray
    after: FloatArray
    drum_before: float
    drum_after: float

    def drum_energy(self, mass: float) -> float:
        """Of a drum of that mass [J], as `_Belt.stored`."""
        return mass * (self.drum_before**2 + self.drum_after**2) / 4


class _History:
    """Samples of both ends and the tail, and extremes of all cells gathered in blocks."""

    def __init__(self, samples: int, belt: _Belt) -> None:
        self.on, self.off = np.zeros(samples), np.zeros(samples)
        self.belt_speed, self.drum_speed, self.tail_speed = np.zeros(samples), np.zeros(samples), np.zeros(samples)
        self.off_speed = np.zeros(samples)
        self.tail_back, self.tail_carry = np.zeros(samples), np.zeros(samples)
        self.split = belt.split
        self.block = np.empty((_BLOCK, len(belt.static)))
        self.rows: list[int] = []
        nothing = _Seen(-math.inf, 0, 0)
        self.back, self.carry = [nothing, nothing], [nothing, nothing]
        self.first: _Speeds
        self.last: _Speeds

    def note_cells(self, n: int, tension: FloatArray) -> None:
        """Take in the tensions of sample n."""
        self.block[len(self.rows)] = tension
        self.rows.append(n)
        if len(self.rows) == _BLOCK:
            self.flush()

    def flush(self) -> None:
        """Bring the extremes of the cells up to date."""
        held = self.block[: len(self.rows)]
        if not self.rows:
            return
        for part, best in ((held[:, : self.split], self.back), (held[:, self.split :], self.carry)):
            for side, sign in enumerate((1, -1)):
                row, cell = divmod(int(np.argmax(sign * part)), part.shape[1])
                if sign * part[row, cell] > best[side].value:
                    best[side] = _Seen(sign * float(part[row, cell]), self.rows[row], cell)
        self.rows = []

    def note_ends(
        self,
        n: int,
        belt: _Belt,
        drum: _Drum,
        pull: FloatArray,
        on: float,
        off: float,
        before: tuple[FloatArray, float] | None,
    ) -> None:
        """Take in sample n of ends and tail; speeds at whole steps are means of those half a step off."""
        self.on[n], self.off[n] = (on, off) if before else (0.0, 0.0)  # nothing has moved at the first sample
        mean = (before[0] + belt.speed) / 2 if before else np.zeros_like(belt.speed)
        self.belt_speed[n], self.off_speed[n], self.tail_speed[n] = mean[-1], mean[0], mean[belt.split]
        self.drum_speed[n] = (before[1] + drum.speed) / 2 if before else 0.0
        rate = (pull[belt.split] - pull[belt.split - 1]) / belt.mass[belt.split]
        self.tail_back[n] = pull[belt.split - 1] + belt.half[0] * rate
        self.tail_carry[n] = pull[belt.split] - belt.half[1] * rate
        after = belt.speed.copy()
        self.last = (
            _Speeds(before[0], after, before[1], drum.speed)
            if before
            else _Speeds(-after, after, -drum.speed, drum.speed)
        )
        if before is None:
            self.first = self.last

    def extremes(self, strand: Strand, carry: bool, grid: Grid) -> tuple[Extreme, Extreme]:
        """Largest and smallest tension of a strand: any cell, and its two ends."""
        cells = grid.carry if carry else grid.back
        ends = (self.tail_carry, self.on) if carry else (self.off, self.tail_back)
        statics = (strand.static_start, strand.static_end)
        found = []
        for sign, seen in zip((1, -1), self.carry if carry else self.back, strict=True):
            best = (seen.value, seen.sample, (seen.cell + 0.5) / cells)
            for history, static, x in zip(ends, statics, (0.0, 1.0), strict=True):
                sample = int(np.argmax(sign * history))
                best = max(best, (sign * (static + float(history[sample])), sample, x))
            found.append(Extreme(sign * best[0], best[1] * grid.step, best[2] * strand.length))
        return found[0], found[1]


def _motion(
    loop: Loop,
    grid: Grid,
    times: FloatArray,
    last_share: float,
    belt: _Belt,
    drum: _Drum,
    forces: FloatArray,
    history: _History,
) -> Motion:
    history.flush()
    residual = _balance(loop, grid.step, belt, drum, forces, history)
    for samples in (
        times,
        history.belt_speed,
        history.drum_speed,
        history.on,
        history.off,
        history.tail_carry,
        history.tail_back,
    ):
        samples[-1] = at_end(samples, last_share)
    carry_max, carry_min = history.extremes(loop.carry, True, grid)
    back_max, back_min = history.extremes(loop.back, False, grid)
    ahead = loop.back.length
    z_carry, z_back = loop.impedances
    waves = np.array(
        [
            history.on + z_carry * history.belt_speed,
            history.tail_carry - z_carry * history.tail_speed,
            history.tail_back + z_back * history.tail_speed,
            history.off - z_back * history.off_speed,
        ]
    )
    slowest = min(float(history.belt_speed.min()), float(history.tail_speed.min()))
    fastest = max(float(history.belt_speed.max()), float(history.drum_speed.max()))
    return Motion(
        grid=grid,
        times=times,
        waves=waves,
        belt_speed=history.belt_speed,
        drum_speed=history.drum_speed,
        run_on=loop.carry.static_end + history.on,
        run_off=loop.back.static_start + history.off,
        carry_max=carry_max.moved(ahead),
        carry_min=carry_min.moved(ahead),
        back_max=back_max,
        back_min=back_min,
        slipped=drum.slipped,
        reversed=slowest < -BACKWARD * fastest,
        energy_residual=residual,
        cell_updates=len(belt.static) * (len(times) - 1),
        ending=_ending(loop, grid.step, belt, drum, history.last),
        tail=belt.split,
    )


def _ending(loop: Loop, step: float, belt: _Belt, drum: _Drum, last: _Speeds) -> Row:
    """The belt at the last sample as a row of masses, with the compliance of its spans as they hang then."""
    masses, rates = belt.mass.copy(), (last.after - last.before) / step
    free = not (drum.imposed or drum.was_held)
    masses[-1] = belt.half[1] + loop.drum_mass * free
    held = (0, -1) if loop.fixed_length else (-1,)
    gives = (1 + belt.twice_lump / belt.tension**3) * belt.size / belt.stiffness
    pulls = (belt.tension - belt.last) / step
    moving = masses.copy()
    if not free:
        moving[list(held)] = 0.0
    rate_energy = float(moving @ rates**2 + gives @ pulls**2) / 2
    speeds = (last.before + last.after) / 2
    return Row(masses, gives, speeds - speeds[-1], belt.tension - belt.static, held, rate_energy)


def _balance(loop: Loop, step: float, belt: _Belt, drum: _Drum, forces: FloatArray, history: _History) -> float:
    """Work put in at the drum against energy of belt, tail and drum and the heat of slip and shocks, dynamic parts."""
    first, last = history.first, history.last
    stored = belt.stored(last.before, last.after) - belt.kinetic(first.before, first.after)
    through = (history.on - history.off) * history.belt_speed
    scale = energy.work(np.abs(through), step) + loop.least_energy
    belt_part = energy.residual(energy.work(through, step), belt.dissipated, stored, scale)
    if drum.imposed or drum.was_held:
        return belt_part
    put_in = energy.work(forces * history.drum_speed, step)
    heat = energy.work((history.on - history.off) * (history.drum_speed - history.belt_speed), step)
    kinetic = last.drum_energy(loop.drum_mass) - first.drum_energy(loop.drum_mass)
    return max(belt_part, energy.residual(put_in, heat + energy.work(through, step), kinetic, scale))
