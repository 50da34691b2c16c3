"""A closed belt loop as masses on a line: its quasi-static tensions, and bounds on how far waves stray from them.

The coordinate runs with the belt: drive run-off, return strand, tail drum, carry strand, drive run-on. A section
is named by the strand it lies on and its fraction x of that strand's length. All tensions are changes from the
state before the event.

**The bound.** Write the undamped answer to a step in the loop's own modes: the tension of a section s is
S(t) = sum c_n (1 - cos w_n t). Its mean is the quasi-static value a r(s), and it strays by at most sum |c_n|.
With mass-normalised mode shapes phi_n and a step of rim force F, c_n = F phi_n(0) psi_n(s)/w_n, where
psi_n = EA phi_n'/w_n is the tension shape. Two sums are known without any mode:

    sum phi_n(0)^2     = 1/m - 1/M        completeness at the drum of mass m; M is the whole mass, whose rigid
                                          motion is left out
    sum psi_n^2/w_n^2  = G(s)             Green's function of tension: the tension at s when the loop is opened
                                          there with unit relative acceleration

and Cauchy and Schwarz give sum |c_n| <= F sqrt((1/m - 1/M) G(s)). For imposed drum acceleration a the drum is
clamped in the modes, c_n = a Gamma_n psi_n/w_n with sum Gamma_n^2 = M_belt, so sum |c_n| <= a sqrt(M_belt G(s)).
At the run-on of a gravity take-up the bound is attained with equal signs, c_n >= 0 and sum c_n = a M_belt: the
dynamic tension lies between 0 and twice its quasi-static value. The trace of the same Green's function bounds the
lowest frequency: sum 1/w_n^2 = integral G ds/EA, so w_1 >= (integral G ds/EA)^(-1/2) (Dunkerley).

The speed of a section differs from that of the rigid body by sum F phi_n(0) phi_n(s)/w_n sin w_n t, and

    sum phi_n^2/w_n^2      = C(s)         Green's function of displacement: how far s gives way under a unit force
                                          there, less the motion of the whole

gives |v - V| <= F sqrt((1/m - 1/M) C(s)) in the same way.

Stiffness and its distribution enter only the weights of a fixed loop and the frequency; a tail mass and any jump
of impedance are inside.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

RETURN, CARRY = 0, 1
_LEAD_X = np.linspace(0.0, 1.0, 65)
"""Fractions of a strand between which a lead is integrated; a numerical choice. More reduce its error."""
_GAUSS_X, _GAUSS_W = np.polynomial.legendre.leggauss(4)


@dataclass(frozen=True, slots=True)
class LoopMasses:
    """A two-strand loop: masses [kg], compliances L/EA [m/N], its take-up and what the drive imposes."""

    return_mass: float
    carry_mass: float
    tail_mass: float
    drive_mass: float
    return_compliance: float
    carry_compliance: float
    fixed_length: bool
    imposed_speed: bool

    @property
    def belt_mass(self) -> float:
        """Everything the drum accelerates: both strands and the tail drum [kg]."""
        return self.return_mass + self.tail_mass + self.carry_mass

    @property
    def total_mass(self) -> float:
        """Belt, tail drum and reduced drive [kg]."""
        return self.belt_mass + self.drive_mass

    @property
    def _shares(self) -> tuple[float, float]:
        whole = self.return_compliance + self.carry_compliance
        return self.return_compliance / whole, self.carry_compliance / whole


def mass_behind(loop: LoopMasses, strand: int, x: ArrayLike) -> FloatArray:
    """Mass between the run-off of the drum and a section, which the section pulls.

        m(s) = m2 x on the return strand,  m2 + m_t + m1 x on the carry strand

    Args:
        loop: the loop.
        strand: RETURN or CARRY.
        x: fraction of the strand's length, from its upstream end [1].

    Returns:
        m(s) [kg].

    **Range** 0 <= x <= 1.
    **Error** exact.
    **Source** definition.
    """
    fraction = np.asarray(x, float)
    if strand == RETURN:
        return np.asarray(loop.return_mass * fraction)
    return np.asarray(loop.return_mass + loop.tail_mass + loop.carry_mass * fraction)


def quasi_static(loop: LoopMasses, strand: int, x: ArrayLike) -> FloatArray:
    """Change of tension per unit of rigid-body acceleration.

        gravity take-up: r(s) = m(s)
        fixed length:    r(s) = m(s) - mean of m over the loop, weighted by compliance

    The second keeps the total elongation: for equal strands the run-off drops by (3 m2 + m1)/4 and the run-on
    rises by (m2 + 3 m1)/4.

    Args:
        loop: the loop.
        strand: RETURN or CARRY.
        x: fraction of the strand's length [1].

    Returns:
        r(s) [kg].

    **Range** 0 <= x <= 1; stiffness constant along each strand.
    **Error** exact.
    **Source** equilibrium; the fixed loop from constant total elongation.
    """
    mass = mass_behind(loop, strand, x)
    return mass - _mean_mass(loop) if loop.fixed_length else mass


def _mean_mass(loop: LoopMasses) -> float:
    of_return, of_carry = loop._shares
    m2, mt, m1 = loop.return_mass, loop.tail_mass, loop.carry_mass
    return of_return * m2 / 2 + of_carry * (m2 + mt + m1 / 2)


def drive_lead(loop: LoopMasses, acceleration: float) -> float:
    """How far the drive is ahead of the mean of all that moves when the loop is stretched quasi-statically.

        d = (1/M) integral of dm(s) integral from s to the drive of a r/EA

    Args:
        loop: the loop.
        acceleration: a, of the rigid body [m/s^2].

    Returns:
        d [m].

    **Range** a drive that pulls the carry strand.
    **Error** 1e-4 of d, by the trapezoidal rule.
    **Source** derived: equilibrium and Hooke's law.
    """
    behind = {strand: acceleration * quasi_static(loop, strand, _LEAD_X) for strand in (RETURN, CARRY)}
    carry = loop.carry_compliance * _to_the_end(behind[CARRY])
    back = carry[0] + loop.return_compliance * _to_the_end(behind[RETURN])
    moment = loop.carry_mass * np.trapezoid(carry, _LEAD_X) + loop.return_mass * np.trapezoid(back, _LEAD_X)
    return float(moment + loop.tail_mass * carry[0]) / loop.total_mass


def _to_the_end(values: FloatArray) -> FloatArray:
    """Integral over a strand from each fraction of it to its end."""
    steps = (values[1:] + values[:-1]) / 2 * np.diff(_LEAD_X)
    return np.concatenate([np.cumsum(steps[::-1])[::-1], [0.0]])


def tension_green(loop: LoopMasses, strand: int, x: ArrayLike) -> FloatArray:
    """Tension at a section when the loop is opened there with unit relative acceleration.

        gravity take-up: G = m m'/M, the two free parts pulled together, m' = M - m; m alone when the speed is imposed
        fixed length:    G = integral A^2 dm,  A = a0 + gamma(s) - H(s - s0)

    In a fixed loop the opening is shared by a uniform stretch, gamma the share of compliance behind s, and a0 keeps
    the momentum of the loop (0 when the speed is imposed): A is the acceleration, and its kinetic power is the work
    of the opening.

    Args:
        loop: the loop.
        strand: RETURN or CARRY.
        x: fraction of the strand's length [1].

    Returns:
        G, tension per unit of relative acceleration [kg].

    **Range** 0 <= x <= 1; stiffness constant along each strand.
    **Error** exact; a sum of squares, so that masses may differ by any number of decades.
    **Source** derived here; checked against a finite-element solution and against sums over modes.
    """
    if not loop.fixed_length:
        behind = mass_behind(loop, strand, x)
        if loop.imposed_speed:
            return behind
        return np.asarray(behind * ((_belt_ahead(loop, strand, x) + loop.drive_mass) / loop.total_mass))
    masses, first, last = _accelerations(loop, strand, np.asarray(x, float))
    if loop.imposed_speed:
        return _square(masses, first, last)
    start = -np.sum(masses * (first + last) / 2, axis=0) / loop.total_mass
    return np.asarray(_square(masses, first + start, last + start) + loop.drive_mass * start**2)


def _square(parts: FloatArray, first: FloatArray, last: FloatArray) -> FloatArray:
    """Integral of the square of what is linear over each part."""
    return np.asarray(np.sum(parts * (first**2 + first * last + last**2) / 3, axis=0))


def _belt_ahead(loop: LoopMasses, strand: int, x: ArrayLike) -> FloatArray:
    """Mass between a section and the run-on of the drum [kg]."""
    left = 1 - np.asarray(x, float)
    if strand == CARRY:
        return np.asarray(loop.carry_mass * left)
    return np.asarray(loop.return_mass * left + loop.tail_mass + loop.carry_mass)


def _accelerations(loop: LoopMasses, strand: int, x: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """gamma - H of a fixed loop opened at a section, piece by piece from the run-off on: masses [kg] and the values at
    both ends of each, all of shape (4, *x.shape)."""
    g2, g1 = (np.full_like(x, share) for share in loop._shares)
    none, m2, mt, m1 = np.zeros_like(x), loop.return_mass, loop.tail_mass, loop.carry_mass
    if strand == RETURN:
        pieces = [
            (m2 * x, none, g2 * x),
            (m2 * (1 - x), -(g1 + g2 * (1 - x)), -g1),
            (none + mt, -g1, -g1),
            (none + m1, -g1, none),
        ]
    else:
        pieces = [
            (none + m2, none, g2),
            (none + mt, g2, g2),
            (m1 * x, g2, g2 + g1 * x),
            (m1 * (1 - x), -g1 * (1 - x), none),
        ]
    masses, first, last = (np.array(part) for part in zip(*pieces, strict=True))
    return masses, first, last


def stray(loop: LoopMasses, strand: int, x: ArrayLike) -> FloatArray:
    """Most by which the undamped answer to a step strays from the quasi-static tension, per unit acceleration.

        step of rim force:     b = M sqrt((1/m - 1/M) G)
        step of acceleration:  b = sqrt(M_belt G)

    so that a r - a b <= S <= a r + a b at all times, a = F/M or the imposed acceleration.

    Args:
        loop: the loop.
        strand: RETURN or CARRY.
        x: fraction of the strand's length [1].

    Returns:
        b(s) [kg].

    **Range** linear undamped strands, any tail mass and jump of impedance; no slip. Not for a drive without mass,
    where b is infinite except at the run-on of a gravity take-up, where it is M_belt.
    **Error** a bound; exact at the run-on of a gravity take-up. In 25 periods the worst section of a loop comes to
    over 90 % of it; a section near the free end of a gravity loop, or half way round a fixed one, to much less.
    **Source** derived here (module docstring).
    """
    green = tension_green(loop, strand, x)
    if loop.imposed_speed:
        return np.asarray(np.sqrt(loop.belt_mass * green))
    # gravity: M_belt m0 (m + ahead)/m, which stays finite at the run-on for m -> 0
    if not loop.fixed_length:
        ahead = _belt_ahead(loop, strand, x)
        return np.asarray(np.sqrt(loop.belt_mass * mass_behind(loop, strand, x) * (1 + ahead / loop.drive_mass)))
    return np.asarray(np.sqrt(loop.belt_mass * loop.total_mass / loop.drive_mass * green))


def give(loop: LoopMasses, strand: int, x: ArrayLike) -> FloatArray:
    """How far a section gives way under a unit force there, less the motion of the whole loop.

        C = integral N^2 ds/EA,   N(s') = N_0 + m(s')/M - H(s' - s)

    N is the tension under the force and what it accelerates. N_0 is 0 at a gravity take-up; in a fixed loop it keeps
    the total elongation. With the speed imposed the drum stands still, and m/M is left out.

    Args:
        loop: the loop.
        strand: RETURN or CARRY.
        x: fraction of the strand's length [1].

    Returns:
        C [m/N].

    **Range** 0 <= x <= 1; stiffness constant along each strand.
    **Error** exact; a sum of squares.
    **Source** derived here: the strain energy of a force that is in balance with what it accelerates; checked against
    sums over modes of finite elements.
    """
    compliances, first, last = _tensions(loop, strand, np.asarray(x, float))
    if loop.fixed_length:
        held = -np.sum(compliances * (first + last) / 2, axis=0) / (loop.return_compliance + loop.carry_compliance)
        first, last = first + held, last + held
    return _square(compliances, first, last)


def _tensions(loop: LoopMasses, strand: int, x: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """m/M - H under a unit force at a section, piece by piece from the run-off on: compliances [m/N] and the values at
    both ends of each, all of shape (3, *x.shape)."""
    whole = np.inf if loop.imposed_speed else loop.total_mass
    none = np.zeros_like(x)
    c2, c1 = loop.return_compliance, loop.carry_compliance
    before = loop.return_mass, loop.return_mass + loop.tail_mass, loop.belt_mass
    back, tail, all_of_it = (none + mass / whole for mass in before)
    here = mass_behind(loop, strand, x) / whole
    if strand == RETURN:
        pieces = [
            (c2 * x, none, here),
            (c2 * (1 - x), here - 1, back - 1),
            (none + c1, tail - 1, all_of_it - 1),
        ]
    else:
        pieces = [
            (none + c2, none, back),
            (c1 * x, tail, here),
            (c1 * (1 - x), here - 1, all_of_it - 1),
        ]
    compliances, first, last = (np.array(part) for part in zip(*pieces, strict=True))
    return compliances, first, last


def speed_stray(loop: LoopMasses, strand: int, x: ArrayLike) -> FloatArray:
    """Most by which the speed of a section differs from that of the rigid body after a step, per unit acceleration.

        step of rim force:     e = M sqrt((1/m - 1/M) C)
        step of acceleration:  e = sqrt(M_belt C)

    so that |v - V| <= a e at all times, a = F/M or the imposed acceleration.

    Args:
        loop: the loop.
        strand: RETURN or CARRY.
        x: fraction of the strand's length [1].

    Returns:
        e(s) [s].

    **Range** linear undamped strands, any tail mass and jump of impedance; no slip. Not for a drive without mass.
    **Error** a bound; exact at the free end of a uniform gravity loop behind a drum of imposed speed, where it is the
    time of a wave round the belt.
    **Source** derived here (module docstring).
    """
    pushed = loop.belt_mass if loop.imposed_speed else loop.belt_mass * loop.total_mass / loop.drive_mass
    return np.asarray(np.sqrt(pushed * give(loop, strand, x)))


def held_swing(loop: LoopMasses, strand: int, x: ArrayLike, energy: ArrayLike) -> FloatArray:
    """Most dynamic tension at a section once the drum is held at its speed, by the energy of the rates of the waves.

        |S(s)| <= integral |v'| dm <= sqrt(2 E m(s)),    E = 1/2 integral v'^2 dm + 1/2 integral S'^2 ds/EA

    The rates v' and S' obey the equations of the waves themselves, and a drum of constant speed and a take-up of
    constant tension do no work on them: E never grows. Of a fixed loop the tension is that of the running belt at some
    section, but at an unknown one: m(s) is then the larger of the masses on both sides.

    Args:
        loop: the loop.
        strand: RETURN or CARRY.
        x: fraction of the strand's length [1].
        energy: E, of belt and tail drum [J/s^2].

    Returns:
        largest deviation from the tension of the evenly running belt [N].

    **Range** linear strands whose resistance does not change; damping only lowers E; no slip.
    **Error** a bound; exact at the run-on where all of the belt is braked from one acceleration.
    **Source** Schwarz's inequality; derived here, checked against masses on springs.
    """
    mass = mass_behind(loop, strand, x)
    if loop.fixed_length:
        mass = np.maximum(mass, loop.belt_mass - mass)
    return np.asarray(np.sqrt(2 * np.asarray(energy, float) * mass))


def energy_of_rates(loop: LoopMasses, share: float) -> float:
    """Largest energy of the rates of belt and tail drum in a start by a force, per unit of its acceleration squared.

        2 E <= M (1 + p^2 (M/m - 1)),    2 E <= (sqrt(M_belt) + p sqrt(M (M/m - 1)))^2

    The rigid body gives M a^2; the waves of a step give F^2 (1/m - 1/M), those of a force that rises a share p of their
    amplitude. The first counts the drum, the second adds both parts as if they were in step everywhere.

    Args:
        loop: the loop.
        share: p, amplitude of the waves relative to those of a step [1].

    Returns:
        E/a^2, to be multiplied by the acceleration squared for `held_swing` [kg].

    **Range** p from 0 to 1; infinite for a drive without mass and p > 0.
    **Error** a bound.
    **Source** derived here: completeness at the drum, sum phi_n(0)^2 = 1/m - 1/M.
    """
    whole = loop.total_mass
    if loop.drive_mass <= 0:
        return float("inf") if share > 0 else loop.belt_mass / 2
    waves = share**2 * whole * (whole / loop.drive_mass - 1)
    return float(min(whole + waves, (np.sqrt(loop.belt_mass) + np.sqrt(waves)) ** 2)) / 2


def lowest_frequency_bound(loop: LoopMasses) -> float:
    """A lower bound of every natural frequency of the loop.

        w_1 >= (integral G ds/EA)^(-1/2)

    Args:
        loop: the loop; the drum is clamped when the speed is imposed.

    Returns:
        bound [rad/s].

    **Range** linear undamped strands.
    **Error** 10 % below the quarter-wave of a uniform loop with gravity take-up, 22 % for a loop clamped at both
    ends, 45 % for a fixed one with a light drive, whose frequencies come in pairs; never above the true frequency.
    **Source** S. Dunkerley (1894); the trace of the Green's function is the sum of 1/w_n^2.
    """
    total = 0.0
    for strand, compliance in ((RETURN, loop.return_compliance), (CARRY, loop.carry_compliance)):
        green = tension_green(loop, strand, (_GAUSS_X + 1) / 2)
        total += compliance * float(np.dot(_GAUSS_W, green)) / 2
    return float(total**-0.5)


def window_leak(lowest_frequency: float, window: float) -> float:
    """How much of the swing a half-sine average over the window can still see.

    The average with weight (pi/2T) sin(pi t/T) sees a mode of frequency w as cos(wT/2)^2/(1 - (wT/pi)^2) times its
    amplitude (with any phase: |cos(wT/2)|/|1 - (wT/pi)^2|). For w T > pi that is at most 1/((w T/pi)^2 - 1), and
    for modes that start with the step it is never positive: their average never falls below the quasi-static
    value, so neither does their maximum.

    Args:
        lowest_frequency: w, a lower bound of the natural frequencies [rad/s].
        window: T, length of the window [s].

    Returns:
        share of the swing, at most 1 [1].

    **Range** any window; 1 where it is shorter than half the longest period.
    **Error** a bound.
    **Source** derived here: cosine transform of the half sine.
    """
    ratio = (lowest_frequency * window / np.pi) ** 2
    return float(1 / max(1.0, ratio - 1))
