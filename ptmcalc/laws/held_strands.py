"""A chain whose tail sprocket keeps the speed of the driving one: each strand on its own, both its ends moved alike.

The coordinate x of a strand runs with the travel, from 0 to 1. Against the motion of its ends the working strand, and
the return strand of a screw take-up, is a bar held at both ends under the even load -m a/L; the middle keeps its
tension, and either half is a bar with a free end there. The return strand behind a gravity take-up is free where it
leaves the driving sprocket, and held at the tail. All tensions are changes from the state before the event.

With mode shapes u_k, masses G_k and force amplitudes N_k w_k, a mode follows an acceleration of the ends by A_k =
(N_k(1) - N_k(0))/(w_k G_k^(1/2)), and it is felt at a section by B_k = N_k/(w_k G_k^(1/2)). Completeness gives sum
A_k^2 = m, and the Green's function of tension sum B_k^2 = G(x); Cauchy and Schwarz bound the rest as in
`laws.loop_bounds`.

Where a torque is imposed, both sprockets with the drive are one mass m_s on which all strands hang. Only the modes that
are even about the middle of a strand held at both ends move it, A_k = M u_s/G_k^(1/2), sum A_k^2 = M (M - m_s)/m_s.
An end that is moved relative to its sprocket, as by teeth, excites the others too: the odd modes of a strand held at
both ends, and strands of one frequency that pull the sprockets with equal and opposite forces.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.laws.loop_bounds import CARRY, RETURN, LoopMasses

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int_]
_EPS = float(np.finfo(float).eps)


@dataclass(frozen=True, slots=True)
class HeldStrands(LoopMasses):
    """The strands of a chain whose tail sprocket keeps the speed of the driving one."""

    def mass_of(self, strand: int) -> float:
        """Of a strand [kg]."""
        return self.return_mass if strand == RETURN else self.carry_mass

    def stiffness_of(self, strand: int) -> float:
        """EA/L of a strand that is held at both ends; 0 where one of them is free [N/m]."""
        if self.free_end(strand):
            return 0.0
        return 1 / (self.return_compliance if strand == RETURN else self.carry_compliance)

    def free_end(self, strand: int) -> bool:
        """Whether a gravity take-up keeps the tension at the beginning of a strand."""
        return strand == RETURN and not self.fixed_length

    def travel_time(self, strand: int) -> float:
        """Of a wave along a strand [s]."""
        compliance = self.return_compliance if strand == RETURN else self.carry_compliance
        return float(np.sqrt(self.mass_of(strand) * compliance))


def quasi_static(loop: HeldStrands, strand: int, x: ArrayLike) -> FloatArray:
    """Change of tension per unit of acceleration of both sprockets.

        held at both ends: r = m (x - 1/2)      free at its beginning: r = m x

    Args:
        loop: the strands.
        strand: RETURN or CARRY.
        x: fraction of the strand's length [1].

    Returns:
        r [kg].

    **Range** 0 <= x <= 1; even mass and stiffness along the strand.
    **Error** exact.
    **Source** equilibrium S' = m a/L with constant length of the strand, or with constant tension at x = 0.
    """
    mass, at = loop.mass_of(strand), np.asarray(x, float)
    return np.asarray(mass * at if loop.free_end(strand) else mass * (at - 0.5))


def tension_green(loop: HeldStrands, strand: int, x: ArrayLike) -> FloatArray:
    """Tension at a section when the strand is opened there with unit relative acceleration, its ends at rest, or on the
    sprockets that yield where a torque is imposed.

        held at both ends: G = m (x^3 + (1 - x)^3)/3      free at its beginning: G = m x
        torque imposed:    less (m (x - 1/2))^2/M         less (m x)^2/M

    Args:
        loop: the strands.
        strand: RETURN or CARRY.
        x: fraction of the strand's length [1].

    Returns:
        G [kg].

    **Range** 0 <= x <= 1.
    **Error** exact.
    **Source** kinetic power of the field x - H(x - s), as in `loop_bounds.tension_green`, less that of its momentum.
    """
    mass, at = loop.mass_of(strand), np.asarray(x, float)
    held = mass * at if loop.free_end(strand) else mass * (at**3 + (1 - at) ** 3) / 3
    return np.asarray(held if loop.imposed_speed else held - quasi_static(loop, strand, at) ** 2 / loop.total_mass)


def stray(loop: HeldStrands, strand: int, x: ArrayLike) -> FloatArray:
    """Most by which the undamped answer to a step strays from the quasi-static tension, per unit acceleration.

        speed imposed:   b = (m/2) |2 x - 1|^(1/2) held at both ends,    b = m x^(1/2) free at its beginning
        torque imposed:  b = f ((m_1 + m_2)/m_s y (M - y))^(1/2),   y = m |2 x - 1|, f = 1/2     y = m x, f = 1

    m_s are both sprockets with the drive, M = m_s + m_1 + m_2. Only what is even about the middle of a strand held at
    both ends is moved: both halves together are one bar of the mass m, whose tension is shared by both sprockets.

    Args:
        loop: the strands.
        strand: RETURN or CARRY.
        x: fraction of the strand's length [1].

    Returns:
        b [kg].

    **Range** linear undamped strands; sprockets coupled to one speed.
    **Error** a bound; attained at the ends that are held, with the speed imposed.
    **Source** `laws.loop_bounds` for either half of the strand.
    """
    at, half = np.asarray(x, float), 1.0 if loop.free_end(strand) else 0.5
    share = at if loop.free_end(strand) else np.abs(2 * at - 1)
    pulled = loop.mass_of(strand) * share
    if loop.imposed_speed:
        return np.asarray(half * loop.mass_of(strand) * np.sqrt(share))
    strands = loop.return_mass + loop.carry_mass
    return np.asarray(half * np.sqrt(strands / (loop.total_mass - strands) * pulled * (loop.total_mass - pulled)))


def lowest_frequency(loop: HeldStrands) -> float:
    """A lower bound of every natural frequency above 0 that the motion of the sprockets excites.

        w = min(pi/t_1, pi/t_2), pi/(2 t_2) where the return strand has a free end

    Args:
        loop: the strands.

    Returns:
        w [rad/s].

    **Range** t is the travel time of a wave along a strand.
    **Error** exact with the speed imposed. With the torque imposed the frequencies lie above those of held sprockets.
    **Source** standing waves; interlacing of the frequencies when a constraint is removed (Rayleigh).
    """
    back = np.pi / loop.travel_time(RETURN)
    return float(min(np.pi / loop.travel_time(CARRY), back / 2 if loop.free_end(RETURN) else back))


def natural_frequencies(loop: HeldStrands, count: int) -> FloatArray:
    """The lowest natural frequencies of both strands, with their sprockets at rest or coupled to one mass.

        speed imposed:   w = k pi/t held at both ends,    (k - 1/2) pi/t free at its beginning
        torque imposed:  m_s w + sum 2 z tan(w t/2) + z tan(w t) = 0, the last term of a strand with a free end

    Args:
        loop: the strands.
        count: how many.

    Returns:
        w in rising order, shape (count,) [rad/s].

    **Range** z = (m EA/L)^(1/2) is the impedance of a strand. With the torque imposed only modes that move the
    sprockets, without the rigid motion.
    **Error** rounding.
    **Source** standing waves; equilibrium of the sprockets. One root lies between two neighbours of the frequencies
    that held sprockets excite.
    """
    return _modes(loop, count)[0] if loop.imposed_speed else _coupled(loop, count)


def modal_tensions(loop: HeldStrands, frequencies: FloatArray, strand: int, x: FloatArray) -> FloatArray:
    """Parts of the tension at sections with which the modes follow an acceleration of both sprockets.

        M_k = -(4 m/(k pi)^2) cos(k pi x), k odd, 0 for even k     held at both ends
        M_k = (2 m/q^2) sin(q) sin(q x),   q = (k - 1/2) pi           free at its beginning
        torque imposed: M_k = -M z u_s^2 sin(q (2 x - 1))/(w G cos(q)), q = w t/2, or sin(q x), q = w t with a free end

    Args:
        loop: the strands.
        frequencies: the lowest ones, of `natural_frequencies`, shape (k,) [rad/s].
        strand: RETURN or CARRY.
        x: fractions of the strand's length, shape (n,) [1].

    Returns:
        M_k, 0 for the modes of the other strand, shape (k, n) [kg].

    **Range** u_s is the amplitude of the sprockets, G the mass of the mode.
    **Error** rounding.
    **Source** module docstring; over all modes they sum up to `quasi_static`.
    """
    moved, felt = _moved_and_felt(loop, frequencies, strand, np.asarray(x, float))
    return np.asarray(moved[:, None] * felt)


def modal_shapes(loop: HeldStrands, frequencies: FloatArray, strand: int, x: FloatArray) -> FloatArray:
    """Tensions of the modes at sections as masses: B_k times the root of the moved mass.

        B_k = ((2 m)^(1/2)/q) cos(q x), q = k pi,    -((2 m)^(1/2)/q) sin(q x), q = (k - 1/2) pi
        torque imposed: B_k of `modal_tensions` where the sprockets move, else that of a strand held at both ends, or of
        both strands with equal and opposite forces

    Args:
        loop: the strands.
        frequencies: the lowest ones, of `natural_frequencies`, of `all_frequencies` where the torque is imposed, shape
            (k,) [rad/s].
        strand: RETURN or CARRY.
        x: fractions of the strand's length, shape (n,) [1].

    Returns:
        B_k M_belt^(1/2), shape (k, n) [kg].

    **Range** 0 <= x <= 1.
    **Error** rounding.
    **Source** module docstring; as in `chain_resonance.modal_shapes`.
    """
    places, count = np.asarray(x, float), len(frequencies)
    if loop.imposed_speed:
        return np.asarray(_felt(loop, count, strand, places) * np.sqrt(loop.belt_mass))
    moved, odd, opposed = _coupled(loop, count), _odd(loop, count), _opposed(loop, count)
    felt = np.concatenate(
        [
            _moved_and_felt(loop, moved, strand, places)[1],
            _felt_odd(loop, odd, strand, places),
            _felt_opposed(loop, opposed, strand, places),
        ]
    )
    order = np.argsort(np.concatenate([moved, odd[:, 0], opposed]), kind="stable")[:count]
    return np.asarray(felt[order] * np.sqrt(loop.belt_mass))


def all_frequencies(loop: HeldStrands, count: int) -> FloatArray:
    """The lowest natural frequencies with the torque imposed, those of modes that leave the sprockets at rest included.

        w of `natural_frequencies`;    k pi/t, k even, of a strand held at both ends;    the poles of both strands where
        they are equal

    Args:
        loop: the strands, torque imposed.
        count: how many.

    Returns:
        w in rising order, shape (count,) [rad/s].

    **Range** the torque imposed.
    **Error** rounding; poles of both strands within 1e-9 count as equal.
    **Source** module docstring.
    """
    every = [_coupled(loop, count), _odd(loop, count)[:, 0], _opposed(loop, count)]
    return np.sort(np.concatenate(every))[:count]


def modal_rest(loop: HeldStrands, frequencies: FloatArray, strand: int, x: FloatArray) -> FloatArray:
    """Most that the parts of all modes left out of `modal_tensions` can add up to, whatever their signs.

        ((A - sum A_k^2)(b^2/A - sum B_k^2))^(1/2) over the modes of the strand that are moved, b of `stray`
        speed imposed: A = m      torque imposed: A = M (M - m_s)/m_s

    Args:
        loop: the strands.
        frequencies: of the modes taken, the lowest ones, shape (k,) [rad/s].
        strand: RETURN or CARRY.
        x: fractions of the strand's length, shape (n,) [1].

    Returns:
        the bound, shape (n,) [kg].

    **Range** linear undamped strands.
    **Error** a bound; exact at the ends that are held, with the speed imposed.
    **Source** completeness, Cauchy and Schwarz, as in `chain_resonance.modal_rest`.
    """
    places, whole = np.asarray(x, float), loop.mass_of(strand)
    moved, felt = _moved_and_felt(loop, frequencies, strand, places)
    if loop.imposed_speed:
        moved = np.where(_modes(loop, len(frequencies))[1] == strand, moved, 0.0)
    else:
        strands = loop.return_mass + loop.carry_mass
        whole = loop.total_mass * strands / (loop.total_mass - strands)
    felt = felt[moved != 0]
    green = stray(loop, strand, places) ** 2 / whole
    left = max(whole - float(moved @ moved), 8 * _EPS * whole)
    return np.asarray(np.sqrt(left * np.maximum(green - np.sum(felt**2, axis=0), 8 * _EPS * green)))


def drive_mobilities(loop: HeldStrands, frequencies: FloatArray) -> tuple[FloatArray, float]:
    """Shares of the modes of both strands and the drive in the motion of the sprockets under a force at them.

        g_k = u_s^2/G,   sum over all modes = 1/m_s - 1/M

    A force F at the sprockets accelerates them by F/M + sum g_k y_k'', with y_k'' + 2 zeta w y_k' + w^2 y_k = F.

    Args:
        loop: the strands, torque imposed.
        frequencies: w, of the lowest modes, as in `modal_tensions`, shape (k,) [rad/s].

    Returns:
        g_k, shape (k,), and the sum of those of all other modes [1/kg].

    **Range** the torque imposed; u_s is the amplitude of the sprockets, G the mass of the mode.
    **Error** rounding of the frequencies.
    **Source** derived: completeness of the modes at the sprockets, as in `chain_resonance.drive_mobilities`.
    """
    moved, _ = _moved_and_felt(loop, frequencies, CARRY, np.ones(1))
    shares, strands = (moved / loop.total_mass) ** 2, loop.return_mass + loop.carry_mass
    whole = strands / (loop.total_mass - strands) / loop.total_mass
    return np.asarray(shares), max(whole - float(shares.sum()), 0.0)


def swung_mass(loop: HeldStrands, strand: int, x: ArrayLike) -> FloatArray:
    """Mass through which the energy of the accelerations bounds the tension of a section.

        |S| <= (2 E m(s))^(1/2),   E = integral of a^2/2 over all masses
        m(s) = m |2 x - 1|/4 held at both ends,    m x free at its beginning

    Args:
        loop: the strands.
        strand: RETURN or CARRY.
        x: fraction of the strand's length [1].

    Returns:
        m(s) [kg].

    **Range** accelerations that are even about the middle of a strand held at both ends, which a force at the sprockets
    excites alone; 0 <= x <= 1.
    **Error** a bound.
    **Source** S is the integral of m a from where the tension does not change; Cauchy and Schwarz, and half of the
    energy of the strand is on either side of its middle.
    """
    mass, at = loop.mass_of(strand), np.asarray(x, float)
    return np.asarray(mass * at if loop.free_end(strand) else mass * np.abs(2 * at - 1) / 4)


def _moved_and_felt(
    loop: HeldStrands, frequencies: FloatArray, strand: int, x: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """A_k, shape (k,), and B_k, shape (k, n)."""
    if loop.imposed_speed:
        return _moved(loop, len(frequencies)), _felt(loop, len(frequencies), strand, x)
    w = np.asarray(frequencies, float)
    mass = np.full_like(w, loop.total_mass - loop.return_mass - loop.carry_mass)
    for one in (RETURN, CARRY):
        angle = w * _turned(loop, one)
        mass = mass + loop.mass_of(one) * (1 + np.sin(2 * angle) / (2 * angle)) / (2 * np.cos(angle) ** 2)
    angle, root = (w * _turned(loop, strand))[:, None], np.sqrt(mass)
    places = x if loop.free_end(strand) else 2 * x - 1
    felt = -_impedance(loop, strand) * np.sin(angle * places) / np.cos(angle) / (w * root)[:, None]
    return np.asarray(loop.total_mass / root), np.asarray(felt)


def _turned(loop: HeldStrands, strand: int) -> float:
    """Time of a wave from where the tension of a strand does not change to its held end [s]."""
    return loop.travel_time(strand) * (1.0 if loop.free_end(strand) else 0.5)


def _impedance(loop: HeldStrands, strand: int) -> float:
    """Of a strand [N*s/m]."""
    return loop.mass_of(strand) / loop.travel_time(strand)


def _poles(loop: HeldStrands, count: int) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Frequencies that held sprockets excite, in rising order, and whether each is lower than the next one."""
    order = np.arange(count + 2) + 0.5
    poles = np.sort(np.concatenate([order * np.pi / _turned(loop, strand) for strand in (RETURN, CARRY)]))
    return poles, np.diff(poles) > _APART * poles[:-1]


def _opposed(loop: HeldStrands, count: int) -> FloatArray:
    """Frequencies at which both strands swing against each other and leave the sprockets at rest."""
    poles, apart = _poles(loop, count)
    return poles[:-1][~apart][:count]


def _odd(loop: HeldStrands, count: int) -> FloatArray:
    """Frequencies of the odd modes of strands held at both ends and their strands, shape (n, 2)."""
    found = [
        [2 * k * np.pi / loop.travel_time(strand), strand]
        for strand in (RETURN, CARRY)
        if not loop.free_end(strand)
        for k in range(1, count + 1)
    ]
    return np.array(sorted(found)[:count])


def _felt_odd(loop: HeldStrands, odd: FloatArray, strand: int, x: FloatArray) -> FloatArray:
    """B_k of the modes of `_odd`, shape (k, n)."""
    return np.where((odd[:, 1] == strand)[:, None], _felt_alone(loop, odd[:, 0], strand, x), 0.0)


def _felt_opposed(loop: HeldStrands, w: FloatArray, strand: int, x: FloatArray) -> FloatArray:
    """B_k of the modes of `_opposed`, shape (k, n): the shares of both strands are as the pulls of the other one."""
    ends = np.array([0.0, 1.0])
    back, working = (-np.diff(_felt_alone(loop, w, one, ends), axis=1) for one in (RETURN, CARRY))
    share = (back if strand == CARRY else -working) / np.hypot(back, working)
    return np.asarray(share * _felt_alone(loop, w, strand, x))


def _felt_alone(loop: HeldStrands, w: FloatArray, strand: int, x: FloatArray) -> FloatArray:
    """B_k of modes of one strand whose sprockets are at rest, shape (k, n)."""
    angle = (w * loop.travel_time(strand))[:, None]
    shape = -np.sin(angle * x) if loop.free_end(strand) else np.cos(angle * x)
    return np.asarray(np.sqrt(2 * loop.mass_of(strand)) / angle * shape)


def _coupled(loop: HeldStrands, count: int) -> FloatArray:
    """Frequencies of the modes that move the coupled sprockets: between two neighbours of their poles each."""
    poles, apart = _poles(loop, count)
    low, high = poles[:-1][apart][:count], poles[1:][apart][:count]
    mass = loop.total_mass - loop.return_mass - loop.carry_mass
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        pull = mass * middle
        for strand in (RETURN, CARRY):
            falls = 1.0 if loop.free_end(strand) else 2.0
            pull = pull + falls * _impedance(loop, strand) * np.tan(middle * _turned(loop, strand))
        low, high = np.where(pull < 0, middle, low), np.where(pull < 0, high, middle)
    return np.asarray((low + high) / 2)


_APART = 1e-9
"""Share by which two poles differ [1], from which on a mode lies between them; a numerical choice. Closer ones belong
to strands that swing against each other and leave the sprockets at rest."""
_HALVINGS = 60
"""Bisections of a frequency; a numerical choice, up to rounding."""


def _modes(loop: HeldStrands, count: int) -> tuple[FloatArray, IntArray, FloatArray]:
    """Frequencies of the lowest modes, the strand of each, and its angle along the strand."""
    angles = {CARRY: np.pi * np.arange(1, count + 1), RETURN: np.pi * np.arange(1, count + 1)}
    if loop.free_end(RETURN):
        angles[RETURN] = angles[RETURN] - np.pi / 2
    angle = np.concatenate([angles[RETURN], angles[CARRY]])
    strand = np.repeat([RETURN, CARRY], count)
    w = angle / np.repeat([loop.travel_time(RETURN), loop.travel_time(CARRY)], count)
    lowest = np.argsort(w, kind="stable")[:count]
    return w[lowest], strand[lowest], angle[lowest]


def _moved(loop: HeldStrands, count: int) -> FloatArray:
    """A_k, shape (k,)."""
    _, strand, angle = _modes(loop, count)
    root = np.sqrt(2 * np.where(strand == RETURN, loop.return_mass, loop.carry_mass)) / angle
    held, free = np.round(np.cos(angle)) - 1, -np.round(np.sin(angle))
    return np.asarray(root * np.where((strand == RETURN) & loop.free_end(RETURN), free, held))


def _felt(loop: HeldStrands, count: int, strand: int, x: FloatArray) -> FloatArray:
    """B_k, shape (k, n); 0 for the modes of the other strand."""
    _, strands, angle = _modes(loop, count)
    phase = angle[:, None] * x
    shape = -np.sin(phase) if loop.free_end(strand) else np.cos(phase)
    mine = (strands == strand)[:, None]
    return np.asarray(np.where(mine, np.sqrt(2 * loop.mass_of(strand)) / angle[:, None] * shape, 0.0))
