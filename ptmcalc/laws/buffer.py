"""Running into an obstacle or a buffer: force and path from the energy of what moves.

Source of the collision with an obstacle: N. Yu. Dorokhov, "Dynamics of hoisting and conveying machines", lecture notes,
Kramatorsk 2007 (stacker cranes). A stacker crane is the trolley m_1 on top, the lower end m_2 of its column and the
stiffness c of the column between them; it is the lower end that strikes.
"""

import math
from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

TIP_STOPPED, WHOLE = "tip_stopped", "whole"
LINE, TWO_VALUES = "line", "two_values"
"""Editions of phi_7: a line from 1.25 to 1.6 over the shape of the buffer's curve (ISO 8686-1, EN 13001-2, EN 1991-3;
recommended), or only its ends, as older rules have it for springs and for hydraulic buffers."""
COLLISION_SPEED: Mapping[str, float] = MappingProxyType({"full": 1.0, "en_1991_3": 0.7, "snip": 0.5})
"""Speed at the buffer over the rated one [1]: without any slowing down; of EN 1991-3, and of EN 13001-2 where
something slows the crane down; of SNiP 2.01.07-85. Quoted from secondary sources; to be confirmed."""
_STEPS = 200
"""More than Newton's method on a convex function takes from a start at most twice too far."""


def _stopping_force(push: float, tension: float) -> float:
    """P + (P^2 + S^2)^(1/2), also for a push P far below 0."""
    root = math.hypot(push, tension)
    if push >= 0:
        return push + root
    return tension * (tension / (root - push))


# --- collision of a two-mass crane ------------------------------------------------------------------------------


def collision_force(
    trolley_mass: float, tip_mass: float, stiffness: float, speed: float, resistance: float, reading: str
) -> float:
    """Force in a column whose lower end strikes a rigid obstacle, by the energy of what moves.

        F = -W + (W^2 + c m v^2)^(1/2)      path F/c
        tip_stopped: m = m_1      whole: m = m_1 + m_2

    `tip_stopped`: the lower end stops dead and loses its energy in the contact (recommended for a plastic contact);
    `whole`: all kinetic energy goes into the column, the letter of the textbook.

    Args:
        trolley_mass: m_1, with everything that travels with it [kg].
        tip_mass: m_2, at the lower end of the column [kg].
        stiffness: c, of the column, in series with a buffer at its end if there is one [N/m].
        speed: v [m/s].
        resistance: W, braking and rolling resistance of the trolley; less than 0 where the drive still pushes [N].
        reading: `tip_stopped` or `whole`.

    Returns:
        F [N].

    **Range** constant resistance; masses lumped.
    **Error** neither reading is a bound, since a tip that rebounds shortens the path of the resistance: the column
    force simulated with a plastic contact was 0.4 % below the first, with an elastic one 4 % below the second.
    **Source** lecture notes Kramatorsk 2007: m v^2/2 = W x + c x^2/2, both readings of "the masses of the crane".

    Raises:
        ValueError: for another reading.
    """
    if reading not in (TIP_STOPPED, WHOLE):
        raise ValueError(f"a reading of the mass is {TIP_STOPPED} or {WHOLE}")
    mass = trolley_mass if reading == TIP_STOPPED else trolley_mass + tip_mass
    return _stopping_force(-resistance, speed * math.sqrt(stiffness * mass))


def collision_force_bound(
    trolley_mass: float, tip_mass: float, stiffness: float, speed: float, drive_force: float
) -> float:
    """Most a column can get when its lower end strikes a rigid obstacle, whatever the contact.

        F <= v (c (m_1 + m_2))^(1/2)      drive on: P + (P^2 + c (m_1 + m_2) v^2)^(1/2)

    Args:
        trolley_mass: m_1, with everything that travels with it [kg].
        tip_mass: m_2, at the lower end of the column [kg].
        stiffness: c, of the column [N/m].
        speed: v [m/s].
        drive_force: P, of a drive that is still on, at least 0 [N].

    Returns:
        F [N].

    **Range** an obstacle that does not give, so that the lower end never passes it.
    **Error** a bound; attained as m_2 -> 0 without resistance.
    **Source** derived: the energy in the column is at most the kinetic energy and the work of P over its deflection.
    """
    return _stopping_force(drive_force, speed * math.sqrt(stiffness * (trolley_mass + tip_mass)))


def series_stiffness(stiffness_one: float, stiffness_two: float) -> float:
    """Stiffness of two springs one behind the other: a column and the buffer at its end.

        c = c_1 c_2 / (c_1 + c_2)

    Args:
        stiffness_one: c_1 [N/m].
        stiffness_two: c_2 [N/m].

    Returns:
        c [N/m].

    **Range** no mass between them that matters.
    **Error** exact.
    **Source** one force, paths added.
    """
    return stiffness_one * (stiffness_two / (stiffness_one + stiffness_two))


# --- buffers ----------------------------------------------------------------------------------------------------


def linear_buffer(mass: float, stiffness: float, speed: float) -> tuple[float, float]:
    """Largest force and stroke of a spring buffer.

        F = v (c m)^(1/2),   u = v (m/c)^(1/2)

    Args:
        mass: m; a freely hanging load does not count, a rigidly guided one does [kg].
        stiffness: c [N/m].
        speed: v, at first contact [m/s].

    Returns:
        (F [N], u [m]).

    **Range** drive off, no resistance.
    **Error** exact for a linear spring.
    **Source** energy m v^2 = c u^2.
    """
    return speed * math.sqrt(stiffness * mass), speed * math.sqrt(mass / stiffness)


def constant_force_buffer(mass: float, stroke: float, speed: float) -> float:
    """Force of a buffer that brakes with the same force all along its stroke.

        F = m v^2 / (2 s)

    Args:
        mass: m; a freely hanging load does not count, a rigidly guided one does [kg].
        stroke: s, over which it stops [m].
        speed: v, at first contact [m/s].

    Returns:
        F [N].

    **Range** drive off; friction buffers, hydraulic ones of ideal orifices.
    **Error** exact for that buffer; no buffer of this stroke has a smaller largest force.
    **Source** energy m v^2/2 = F s.
    """
    return mass * speed**2 / (2 * stroke)


def driven_buffer(drive_force: float, mass: float, stiffness: float, speed: float) -> tuple[float, float]:
    """Largest force and stroke of a spring buffer that a crane runs onto with its drive on.

        F = P + (P^2 + c m v^2)^(1/2),   u = F/c

    Args:
        drive_force: P, constant; below 0 for a brake [N].
        mass: m; a freely hanging load does not count, a rigidly guided one does [kg].
        stiffness: c [N/m].
        speed: v, at first contact [m/s].

    Returns:
        (F [N], u [m]).

    **Range** constant drive force until the crane stops.
    **Error** exact for a linear spring.
    **Source** energy m v^2/2 + P u = c u^2/2.
    """
    force = _stopping_force(drive_force, speed * math.sqrt(stiffness * mass))
    return force, force / stiffness


def constant_force_stroke(push: float, force: float, mass: float, speed: float) -> float:
    """Stroke of a buffer of constant force that a crane runs onto with its drive on.

        s = m v^2 / (2 (F - P))

    Args:
        push: P, of the drive, constant; below 0 for a brake [N].
        force: F, of the buffer [N].
        mass: m, of `collision_mass` [kg].
        speed: v, at first contact [m/s].

    Returns:
        s; infinite for P >= F, a drive that pushes the buffer through [m].

    **Range** friction buffers, hydraulic ones of ideal orifices.
    **Error** exact for that buffer.
    **Source** energy m v^2/2 + P s = F s.
    """
    return mass * speed * speed / (2 * (force - push)) if force > push else math.inf


def progressive_buffer(
    push: float, mass: float, speed: float, end_force: float, stroke: float, power: float
) -> tuple[float, float]:
    """Largest force and stroke of a buffer whose force grows as a power of its stroke: rubber, cellular plastic.

        F = F_e (u/s)^p,   m v^2/2 + P u = F_e s/(p + 1) (u/s)^(p + 1)

    Args:
        push: P, of the drive, constant; below 0 for a brake [N].
        mass: m, of `collision_mass` [kg].
        speed: v, at first contact [m/s].
        end_force: F_e, at the end of the stroke [N].
        stroke: s [m].
        power: p, above 0: 1 for a spring, 2 to 3 for cellular plastic [1].

    Returns:
        (F [N], u [m]); where u is more than s the buffer bottoms out, with `speed_left`.

    **Range** a buffer without damping; its curve continued beyond its end.
    **Error** exact for that curve.
    **Source** energy; Newton's method on a convex function, from beyond its root.
    """
    energy, push_share = mass * speed / (end_force * stroke) * speed / 2, push / end_force
    if energy == 0 and push <= 0:
        return 0.0, 0.0
    x = (2 * (power + 1) * energy) ** (1 / (power + 1))
    if push > 0:
        x = max(x, (2 * (power + 1) * push_share) ** (1 / power))
    for _ in range(_STEPS):
        curve = x**power
        step = (x * curve / (power + 1) - push_share * x - energy) / (curve - push_share)
        if not 0 < x - step < x:
            break
        x -= step
    return end_force * x**power, stroke * x


def speed_left(push: float, mass: float, speed: float, energy: float, stroke: float) -> float:
    """Speed at which a crane meets the end of a buffer that is too weak for it.

        v_1 = (v^2 + 2 (P s - E)/m)^(1/2)

    Args:
        push: P, of the drive, constant; below 0 for a brake [N].
        mass: m, of `collision_mass` [kg].
        speed: v, at first contact [m/s].
        energy: E, the buffer takes over its whole stroke: c s^2/2, F s, F_e s/(p + 1) [J].
        stroke: s [m].

    Returns:
        v_1; 0 where the crane stops before the end [m/s].

    **Range** a buffer whose force goes by its stroke and does not fall; for orifices `orifice_buffer_speed`.
    **Error** exact.
    **Source** energy.
    """
    return math.sqrt(max(speed * speed + 2 * (push * stroke - energy) / mass, 0.0))


def collision_mass(crane: float, load: float, guidance: float) -> float:
    """Mass that a buffer has to stop.

        m = m_c + k m_l

    Args:
        crane: m_c, of all that is stiff, with rotating parts that stay in gear: J u^2/r^2 [kg].
        load: m_l [kg].
        guidance: k, 0 for a load that hangs and swings on, 1 for a guided one, between for rope pyramids [1].

    Returns:
        m [kg].

    **Range** a stroke much shorter than a period of the pendulum.
    **Error** exact for k = 1; a hanging load still pulls with the horizontal part of its rope's force.
    **Source** SNiP 2.01.07-85 and EN 13001-2: hanging loads do not count, guided ones do.
    """
    return crane + guidance * load


def meeting(
    mass_one: float, mass_two: float, speed_one: float, speed_two: float, push_one: float, push_two: float
) -> tuple[float, float, float]:
    """Two cranes that run into each other, as one mass that runs into the buffers between them.

        m = m_1 m_2/(m_1 + m_2),   v = v_1 + v_2,   P = (P_1 m_2 + P_2 m_1)/(m_1 + m_2)

    Args:
        mass_one: m_1, of the first crane, of `collision_mass` [kg].
        mass_two: m_2, of the second one [kg].
        speed_one: v_1, towards the other [m/s].
        speed_two: v_2, towards the first; below 0 where it runs away from it [m/s].
        push_one: P_1, of the first drive, towards the other [N].
        push_two: P_2, of the second drive, towards the first [N].

    Returns:
        (m [kg], v [m/s], P [N]) for the laws of one crane; springs between them by `series_stiffness`, constant
        forces by the weaker one, orifices by `series_orifice`.

    **Range** free cranes; one against a wall is the limit of a second mass without end.
    **Error** exact.
    **Source** derived: motion of both relative to each other.
    """
    total = mass_one + mass_two
    reduced = mass_one * (mass_two / total)
    return reduced, speed_one + speed_two, push_one * (mass_two / total) + push_two * (mass_one / total)


def series_orifice(coefficient_one: float, coefficient_two: float) -> float:
    """Two hydraulic buffers with fixed orifices one against the other.

        k = (k_1^(-1/2) + k_2^(-1/2))^-2

    Args:
        coefficient_one: k_1, force over the square of the speed [kg/m].
        coefficient_two: k_2 [kg/m].

    Returns:
        k, for the speed of both together [kg/m].

    **Range** no mass between them that matters.
    **Error** exact.
    **Source** derived: one force k_i v_i^2, speeds added.
    """
    low, high = sorted((coefficient_one, coefficient_two))
    return low / (1 + math.sqrt(low / high)) ** 2


def orifice_buffer_speed(
    path: ArrayLike, mass: float, coefficient: float, speed: float, push: float = 0.0
) -> FloatArray:
    """Speed along the stroke of a hydraulic buffer with one fixed orifice.

        v^2 = v_0^2 q + (P/k) (1 - q),   q = exp(-2 k x/m)

    Args:
        path: x, from first contact [m].
        mass: m; a freely hanging load does not count, a rigidly guided one does [kg].
        coefficient: k, force over the square of the speed [kg/m].
        speed: v_0, at first contact [m/s].
        push: P, of a drive that is still on; below 0 for a brake [N].

    Returns:
        v; without a brake it never becomes 0, the end of the stroke meets what is left; with a brake 0 from where the
        crane stops [m/s].

    **Range** turbulent flow, no return spring, a constant push.
    **Error** exact for that buffer.
    **Source** derived: m v dv/dx = P - k v^2.
    """
    rate = -2 * coefficient * np.asarray(path, float) / mass
    return np.asarray(np.sqrt(np.maximum(speed**2 * np.exp(rate) - push / coefficient * np.expm1(rate), 0.0)))


def orifice_buffer_force(
    path: ArrayLike, mass: float, coefficient: float, speed: float, push: float = 0.0
) -> FloatArray:
    """Force along the stroke of a hydraulic buffer with one fixed orifice.

        F = k v^2,   v of `orifice_buffer_speed`

    Args:
        path: x, from first contact [m].
        mass: m; a freely hanging load does not count, a rigidly guided one does [kg].
        coefficient: k, force over the square of the speed [kg/m].
        speed: v_0, at first contact [m/s].
        push: P, of a drive that is still on; below 0 for a brake [N].

    Returns:
        F, largest at first contact unless the push is more; it tends to the push [N].

    **Range** turbulent flow, no return spring, a constant push.
    **Error** exact for that buffer.
    **Source** derived: as `orifice_buffer_speed`.
    """
    return coefficient * orifice_buffer_speed(path, mass, coefficient, speed, push) ** 2


def orifice_buffer_path(time: ArrayLike, mass: float, coefficient: float, speed: float) -> FloatArray:
    """Path over time in a hydraulic buffer with one fixed orifice.

        x = (m/k) ln(1 + k v_0 t/m)

    Args:
        time: t, from first contact [s].
        mass: m; a freely hanging load does not count, a rigidly guided one does [kg].
        coefficient: k, force over the square of the speed [kg/m].
        speed: v_0, at first contact [m/s].

    Returns:
        x [m].

    **Range** drive off, turbulent flow, no return spring.
    **Error** exact for that buffer.
    **Source** derived: as `orifice_buffer_speed`.
    """
    return np.asarray(mass / coefficient * np.log1p(coefficient * speed / mass * np.asarray(time, float)))


def energy_share(forces: FloatArray, paths: FloatArray) -> float:
    """Shape of a buffer's curve: the energy it takes over largest force times stroke.

        xi = integral F du/(F_max u_max)

    Args:
        forces: F, at points of the curve, from first contact to the end, shape (n,) [N].
        paths: u, rising from 0, shape (n,) [m].

    Returns:
        xi: 1/2 for a spring, 1 for a constant force, 1/(p + 1) for a force as u^p [1].

    **Range** the curve of a collision, straight between the points.
    **Error** exact for such a curve.
    **Source** EN 13001-2, ISO 8686-1.
    """
    F, u = np.asarray(forces, float), np.asarray(paths, float)
    return float(np.sum((F[1:] + F[:-1]) / np.max(F) * (np.diff(u) / u[-1])) / 2)


def orifice_energy_share(mass: float, coefficient: float, stroke: float) -> float:
    """Shape of the curve of a hydraulic buffer with one fixed orifice.

        xi = (1 - exp(-z))/z,   z = 2 k s/m

    Args:
        mass: m [kg].
        coefficient: k, force over the square of the speed [kg/m].
        stroke: s [m].

    Returns:
        xi, whatever the speed [1].

    **Range** drive off.
    **Error** exact for that buffer; one with many orifices comes near 1.
    **Source** derived: integral of `orifice_buffer_force`.
    """
    z = 2 * coefficient * (stroke / mass)
    return -math.expm1(-z) / z


def buffer_factor(energy_share: float, edition: str = LINE) -> float:
    """Dynamic factor phi_7 of buffer forces, by the shape of the buffer's curve.

        line:       phi_7 = 1.25 for xi <= 0.5,   1.25 + 0.7 (xi - 0.5) above
        two_values: phi_7 = 1.25 for xi <= 0.5,   1.6 above

    Args:
        energy_share: xi, energy taken up over largest force times stroke: 0.5 linear, 1 constant force [1].
        edition: `line` or `two_values`.

    Returns:
        phi_7 [1].

    **Range** 0 <= xi <= 1.
    **Error** none: a convention of the standard.
    **Source** EN 13001-2, ISO 8686-1 and EN 1991-3, buffer forces; two values as older rules for springs and hydraulic
    buffers are quoted; to be compared with the edition in force.

    Raises:
        ValueError: for a share outside 0 to 1 or another edition.
    """
    if not 0 <= energy_share <= 1:
        raise ValueError("the energy of a buffer is between 0 and 1 of its largest force times its stroke")
    if edition not in (LINE, TWO_VALUES):
        raise ValueError(f"phi_7 follows `{LINE}` or `{TWO_VALUES}`")
    if edition == TWO_VALUES:
        return 1.25 if energy_share <= 0.5 else 1.6
    return 1.25 + 0.7 * max(energy_share - 0.5, 0.0)
