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

import numpy as np

from ptmcalc.numerics import energy
from ptmcalc.numerics.exponential_step import ExponentialStep
from ptmcalc.numerics.loop import BACKWARD, Drive, FloatArray, Grid, Loop, Motion, at_end, steps_of
from ptmcalc.numerics.panel_interpolation import between
from ptmcalc.numerics.strand_delays import ENDING, Delays
from ptmcalc.numerics.strand_drum import Drum


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


class _Marched:
    """A loop carried through the window: the histories, from which the answer is made."""

    def __init__(self, loop: Loop, drive: Drive, window: float, grid: Grid) -> None:
        self.loop, self.grid = loop, grid
        self.steps, self.last_share = steps_of(window, grid)
        self.interior = Delays(loop, grid, self.steps, self.last_share)
        times = np.arange(len(self.interior.tail_speed), dtype=np.float64) * grid.step
        self.times = times[: self.steps + 1]
        self.drum = Drum(loop, drive, times, grid)
        self.tail = ExponentialStep(loop.tail_mass, sum(loop.impedances), grid.step, grid.panel)
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
            tail=min(self.grid.back, ENDING),
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
    drum: Drum,
    tail_speed: float,
    interior: Delays,
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
