"""Strands without sag as pure delays: their waves, extremes, energy and the belt at the end."""

import math

import numpy as np

from ptmcalc.numerics import energy
from ptmcalc.numerics.exponential_step import ExponentialStep
from ptmcalc.numerics.free_waves import Row
from ptmcalc.numerics.loop import Extreme, FloatArray, Grid, Loop, Strand, at_end
from ptmcalc.numerics.strand_drum import Drum

ENDING = 64
"""Stretches of a strand by which the waves at the end are told."""


class Delays:
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

    def run(self, drum: Drum, tail: ExponentialStep) -> None:
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
            nodes = np.unique(np.rint(np.linspace(0, cells, min(cells, ENDING) + 1)).astype(int))
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
