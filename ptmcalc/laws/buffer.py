"""Running into an obstacle or a buffer: force and path from the energy of what moves.

Source of the collision with an obstacle: N. Yu. Dorokhov, "Dynamics of hoisting and conveying machines", lecture notes,
Kramatorsk 2007 (stacker cranes). A stacker crane is the trolley m_1 on top, the lower end m_2 of its column and the
stiffness c of the column between them; it is the lower end that strikes.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

TIP_STOPPED, WHOLE = "tip_stopped", "whole"


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


def orifice_buffer_speed(path: ArrayLike, mass: float, coefficient: float, speed: float) -> FloatArray:
    """Speed along the stroke of a hydraulic buffer with one fixed orifice.

        v = v_0 exp(-k x/m)

    Args:
        path: x, from first contact [m].
        mass: m; a freely hanging load does not count, a rigidly guided one does [kg].
        coefficient: k, force over the square of the speed [kg/m].
        speed: v_0, at first contact [m/s].

    Returns:
        v; it never becomes 0, the end of the stroke meets what is left [m/s].

    **Range** drive off, turbulent flow, no return spring.
    **Error** exact for that buffer.
    **Source** derived: m v dv/dx = -k v^2.
    """
    return np.asarray(speed * np.exp(-coefficient * np.asarray(path, float) / mass))


def orifice_buffer_force(path: ArrayLike, mass: float, coefficient: float, speed: float) -> FloatArray:
    """Force along the stroke of a hydraulic buffer with one fixed orifice.

        F = k v^2 = k v_0^2 exp(-2 k x/m)

    Args:
        path: x, from first contact [m].
        mass: m; a freely hanging load does not count, a rigidly guided one does [kg].
        coefficient: k, force over the square of the speed [kg/m].
        speed: v_0, at first contact [m/s].

    Returns:
        F, largest at first contact [N].

    **Range** drive off, turbulent flow, no return spring.
    **Error** exact for that buffer.
    **Source** derived: as `orifice_buffer_speed`.
    """
    return coefficient * orifice_buffer_speed(path, mass, coefficient, speed) ** 2


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


def buffer_factor(energy_share: float) -> float:
    """Dynamic factor phi_7 of buffer forces, by the shape of the buffer's curve.

        phi_7 = 1.25 for xi <= 0.5,   1.25 + 0.7 (xi - 0.5) above

    Args:
        energy_share: xi, energy taken up over largest force times stroke: 0.5 linear, 1 constant force [1].

    Returns:
        phi_7 [1].

    **Range** 0 <= xi <= 1.
    **Error** none: a convention of the standard.
    **Source** EN 13001-2 and ISO 8686-1, buffer forces; to be compared with the edition in force.

    Raises:
        ValueError: for a share outside 0 to 1.
    """
    if not 0 <= energy_share <= 1:
        raise ValueError("the energy of a buffer lies between 0 and 1 of its largest force times its stroke")
    return 1.25 + 0.7 * max(energy_share - 0.5, 0.0)
